/* SPDX-License-Identifier: MIT
 *
 * board_record - record of `ladder board`: fetches what a board remembers of its last scans,
 * and the programs that ran them, into one file.
 */
#include "ladder/remote.h"

#include "engine/scan/recorder.h"
#include "engine/trial/record_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LAPS_MOST 8 /* times that the board may drop what is being fetched          */

struct fetched {
	struct record_parts parts;
	uint8_t *log;
	size_t room;
	uint8_t *image[RECORD_PROGRAMS];
};

static bool reserve(uint8_t **bytes, size_t *room, size_t len)
{
	uint8_t *more;

	if (len <= *room)
		return true;
	more = realloc(*bytes, 2 * len);
	if (!more)
		return false;
	*bytes = more;
	*room = 2 * len;
	return true;
}

static enum status ask_log(struct remote *remote, uint64_t from, struct recorder_part *part)
{
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_RECORD);
	struct wire_reader in;
	enum desk_end end;
	size_t len;

	wire_put_u8(&out, 0);
	wire_put_u64(&out, from);
	end = desk_call(&remote->desk, &out, &in);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	part->oldest = wire_u64(&in);
	part->end = wire_u64(&in);
	part->at = wire_u64(&in);
	len = wire_left(&in);
	part->len = (uint32_t)len;
	part->out = (uint8_t *)wire_bytes(&in, len);
	return !in.failed && part->at >= part->oldest && part->at + len <= part->end &&
	       (len || part->at == part->end) ? STATUS_GOOD : remote_fail(remote, DESK_NONSENSE);
}

/* All that the board has now. What it drops meanwhile is dropped here, too. */
static enum status fetch_log(struct remote *remote, struct fetched *fetched)
{
	uint64_t start = 0, from = 0, until = UINT64_MAX;
	int laps = 0;

	while (from < until) {
		struct recorder_part part = { .from = from };
		const enum status status = ask_log(remote, from, &part);

		if (status != STATUS_GOOD)
			return status;
		if (until == UINT64_MAX || part.at != from) {
			if (laps++ > LAPS_MOST) {
				report_diag((struct diag){ .id = DIAG_RECORD_SLOW,
							   .file = remote->where }, "%s", "");
				return STATUS_NO;
			}
			start = part.at;
			until = part.end;
		}
		from = part.at + part.len;
		if (from - start > RECORD_MOST)
			return remote_fail(remote, DESK_NONSENSE);
		if (!reserve(&fetched->log, &fetched->room, (size_t)(from - start)))
			return report_no_memory(remote->where);
		if (part.len)
			memcpy(fetched->log + (part.at - start), part.out, part.len);
	}
	fetched->parts.log = fetched->log;
	fetched->parts.len = (size_t)(until - start);
	return STATUS_GOOD;
}

/* A program that the board has forgotten is left out. */
static enum status fetch_program(struct remote *remote, struct record_program *program,
				 uint8_t **image)
{
	uint32_t len = 0, size;
	size_t room = 0;
	bool asked = false;

	do {
		struct wire_writer out = desk_ask(&remote->desk, SERVICE_RECORD);
		struct wire_reader in;
		enum desk_end end;
		size_t part;

		wire_put_u8(&out, 1);
		wire_put_bytes(&out, program->identity, 32);
		wire_put_u32(&out, len);
		end = desk_call(&remote->desk, &out, &in);
		if (end == DESK_REFUSED && remote->desk.refusal == REFUSAL_NO_IMAGE)
			return STATUS_GOOD;
		if (end == DESK_REFUSED && remote->desk.refusal == REFUSAL_PASSWORD && !asked) {
			const enum status status = remote_unlock(remote);

			if (status != STATUS_GOOD)
				return status;
			asked = true;
			size = UINT32_MAX;
			continue;
		}
		if (end != DESK_GOOD)
			return remote_fail(remote, end);
		size = wire_u32(&in);
		part = wire_left(&in);
		if (in.failed || size > RECORD_MOST || part > size - len || (!part && len < size))
			return remote_fail(remote, DESK_NONSENSE);
		if (!reserve(image, &room, size))
			return report_no_memory(remote->where);
		memcpy(*image + len, wire_bytes(&in, part), part);
		len += (uint32_t)part;
	} while (len < size);
	program->image = *image;
	program->len = len;
	return STATUS_GOOD;
}

static enum status fetch_programs(struct remote *remote, struct fetched *fetched)
{
	struct record_parts *parts = &fetched->parts;
	enum status status = STATUS_GOOD;

	if (!record_programs(parts))
		return remote_fail(remote, DESK_NONSENSE);
	for (uint32_t i = 0; i < parts->program_count && status == STATUS_GOOD; i++)
		status = fetch_program(remote, &parts->program[i], &fetched->image[i]);
	return status;
}

/* Opens the file once, so that a bad one is found now. */
static enum status tell(struct remote *remote, const char *path, const struct sink_memory *memory)
{
	const struct sink *out = &remote->call->out;
	enum diag_id why;
	size_t where;
	struct record_file *file = record_file_open(memory->text, memory->len, &why, &where);

	if (!file) {
		report_diag((struct diag){ .id = why, .file = path }, "byte %zu", where);
		return STATUS_NO;
	}
	sink_text(out, path);
	sink_printf(out, ": %llu scans\n", (unsigned long long)
		    (record_file_last(file) - record_file_first(file)));
	record_file_free(file);
	return STATUS_GOOD;
}

static enum status save(struct remote *remote, const struct fetched *fetched, const char *path)
{
	struct sink_memory memory;
	enum status status = STATUS_WRONG;
	struct sink sink;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	if (!record_write(&fetched->parts, &sink) || memory.failed)
		report_no_memory(path);
	else
		status = report_save(path, memory.text, memory.len);
	if (status == STATUS_GOOD)
		status = tell(remote, path, &memory);
	sink_memory_free(&memory);
	return status;
}

enum status remote_record(struct remote *remote)
{
	const char *path = call_option(remote->call, "-o");
	struct fetched *fetched = calloc(1, sizeof(*fetched));
	enum status status;

	if (!fetched)
		return report_no_memory(remote->where);
	fetched->parts.board = remote->desk.board;
	if (!path)
		status = report_usage(remote->call, "record needs -o FILE");
	else
		status = fetch_log(remote, fetched);
	if (status == STATUS_GOOD)
		status = fetch_programs(remote, fetched);
	if (status == STATUS_GOOD)
		status = save(remote, fetched, path);
	for (int i = 0; i < RECORD_PROGRAMS; i++)
		free(fetched->image[i]);
	free(fetched->log);
	free(fetched);
	return status;
}
