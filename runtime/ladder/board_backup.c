/* SPDX-License-Identifier: MIT
 *
 * board_backup - `ladder board WHERE backup` and `restore`: all of a board in one archive, or its
 * retained values alone as text.
 *
 * The archive is a tar file, so that other tools can open it: board.txt, retain.txt, board.io,
 * program.rungc and the sources.
 */
#include "ladder/foreign.h"
#include "ladder/remote.h"
#include "ladder/tar.h"
#include "ladder/values_text.h"

#include "engine/base/digest.h"
#include "engine/base/file.h"
#include "engine/scan/carry.h"
#include "engine/scan/retain.h"
#include "engine/scan/resource.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define HEAD      "RUNGBOARD BACKUP 1\n"
#define SOURCES   "sources/"
#define TRIES     300          /* of a board that begins again … */
#define TRY_NS    100000000    /* … so often                     */

/* ---- what a board has ---- */

/* All retained values as text. @keeps: whether the board stores them. */
static enum status read_values(struct remote *remote, struct bytes *payload, bool *keeps)
{
	uint32_t size;

	do {
		struct wire_writer out = desk_ask(&remote->desk, SERVICE_RETAIN);
		struct wire_reader in;
		enum desk_end end;
		size_t len;

		wire_put_u8(&out, 0);
		wire_put_u32(&out, (uint32_t)payload->len);
		end = desk_call(&remote->desk, &out, &in);
		if (end != DESK_GOOD)
			return remote_fail(remote, end);
		*keeps = wire_u8(&in);
		size = wire_u32(&in);
		len = wire_left(&in);
		if (in.failed || size > LIMIT_RETAIN || !len || len > size - payload->len)
			return remote_fail(remote, DESK_NONSENSE);
		bytes_add(payload, wire_bytes(&in, len), len);
		if (payload->failed)
			return report_no_memory(remote->where);
	} while (payload->len < size);
	return retain_is_well_formed(payload->at, size) ? STATUS_GOOD :
							   remote_fail(remote, DESK_NONSENSE);
}

static enum status values_to_text(struct remote *remote, struct bytes *text, bool *keeps)
{
	struct bytes payload = { .at = NULL };
	enum status status = read_values(remote, &payload, keeps);

	if (status == STATUS_GOOD)
		values_print(payload.at, (uint32_t)payload.len, text);
	bytes_free(&payload);
	return status == STATUS_GOOD && text->failed ? report_no_memory(remote->where) : status;
}

/* Mode, program and the settings that a desk has stored. */
static enum status describe(struct remote *remote, const struct board_status *now,
			    struct bytes *text)
{
	struct board_settings settings;
	const enum status status = remote_settings(remote, &settings);
	char program[65], line[300];

	if (status != STATUS_GOOD)
		return status;
	digest_hex(now->program, sizeof(now->program), program);
	bytes_add(text, line, (size_t)snprintf(line, sizeof(line), HEAD "mode %s\nprogram %s\n",
					       mode_word(now->mode), program));
	for (int i = 0; i < settings.count; i++)
		if (settings.at[i].stored)
			bytes_add(text, line, (size_t)snprintf(line, sizeof(line), "set %s %s\n",
							       settings.at[i].key, settings.at[i].next));
	return STATUS_GOOD;
}

static bool add_sources(struct bytes *archive, const struct stored *stored)
{
	struct wire_reader in;
	const uint16_t count = stored_sources(stored, &in);
	struct stored_source source;

	for (uint16_t i = 0; i < count; i++) {
		char name[sizeof(SOURCES) + WIRE_TEXT_MOST];

		if (!stored_take_source(&in, &source))
			return false;
		snprintf(name, sizeof(name), SOURCES "%.*s", (int)source.name_len, source.name);
		tar_add(archive, name, source.bytes, source.len);
	}
	return true;
}

/* The program must not change while its parts and its values are read. */
static enum status gather(struct remote *remote, struct bytes *archive)
{
	struct board_status *now = calloc(1, sizeof(*now));
	struct stored stored = { .bytes = NULL };
	struct bytes about = { .at = NULL }, values = { .at = NULL }, program = { .at = NULL };
	uint8_t before[32];
	bool keeps;
	enum status status = now ? remote_status(remote, now) : report_no_memory(remote->where);

	if (status == STATUS_GOOD)
		memcpy(before, now->program, sizeof(before));
	if (status == STATUS_GOOD)
		status = remote_receive(remote, &stored, &program);
	if (status == STATUS_GOOD)
		status = values_to_text(remote, &values, &keeps);
	if (status == STATUS_GOOD)
		status = describe(remote, now, &about);
	if (status == STATUS_GOOD)
		status = remote_status(remote, now);
	if (status == STATUS_GOOD && memcmp(before, now->program, sizeof(before)) != 0) {
		report_diag((struct diag){ .id = DIAG_LINK_CONFLICT, .file = remote->where }, "%s", "");
		status = STATUS_NO;
	}
	if (status == STATUS_GOOD) {
		tar_add(archive, "board.txt", about.at, about.len);
		tar_add(archive, "retain.txt", values.at, values.len);
		tar_add(archive, "board.io", stored_part(&stored, STORED_MAP), stored.len[STORED_MAP]);
		tar_add(archive, "program.rungc", stored_part(&stored, STORED_IMAGE),
			stored.len[STORED_IMAGE]);
		if (!add_sources(archive, &stored))
			status = remote_fail(remote, DESK_NONSENSE);
		tar_end(archive);
		if (archive->failed)
			status = report_no_memory(remote->where);
	}
	bytes_free(&about);
	bytes_free(&values);
	bytes_free(&program);
	free(now);
	return status;
}

enum status remote_backup(struct remote *remote)
{
	const char *path = call_option(remote->call, "-o");
	struct bytes bytes = { .at = NULL };
	struct diag_list *diags;
	bool keeps;
	enum status status;

	if (!path)
		return report_usage(remote->call, "backup needs -o FILE");
	status = call_flag(remote->call, "--values") ? values_to_text(remote, &bytes, &keeps) :
						       gather(remote, &bytes);
	diags = status == STATUS_GOOD ? report_list(path) : NULL;
	if (diags) {
		file_save(path, bytes.at, bytes.len, diags);
		status = report_end(diags) ? STATUS_GOOD : STATUS_WRONG;
	}
	if (status == STATUS_GOOD && remote->json)
		sink_printf(&remote->call->out, "{\"bytes\": %zu}\n", bytes.len);
	bytes_free(&bytes);
	return status;
}

/* ---- restore ---- */

struct backup {
	struct tar_file about, values, map, image;
	struct bytes sources;          /* as a download has them              */
	uint16_t source_count;
};

static enum status no_backup(const char *path, const char *why)
{
	report_diag((struct diag){ .id = DIAG_LINK_BACKUP, .file = path }, "%s", why);
	return STATUS_NO;
}

static void take_source(struct backup *backup, const struct tar_file *file)
{
	const size_t skip = sizeof(SOURCES) - 1, len = strlen(file->name) - skip;
	uint8_t head[4];
	struct wire_writer out = wire_write(head, sizeof(head));

	wire_put_u16(&out, (uint16_t)len);
	bytes_add(&backup->sources, head, 2);
	bytes_add(&backup->sources, file->name + skip, len);
	out = wire_write(head, sizeof(head));
	wire_put_u32(&out, (uint32_t)file->len);
	bytes_add(&backup->sources, head, 4);
	bytes_add(&backup->sources, file->bytes, file->len);
	backup->source_count++;
}

static enum status open_archive(const char *path, const uint8_t *bytes, size_t len,
				struct backup *backup)
{
	struct tar_file file;
	size_t at = 0;
	static const uint8_t none[2];

	bytes_add(&backup->sources, none, sizeof(none));
	while (tar_next(bytes, len, &at, &file)) {
		if (strcmp(file.name, "board.txt") == 0)
			backup->about = file;
		else if (strcmp(file.name, "retain.txt") == 0)
			backup->values = file;
		else if (strcmp(file.name, "board.io") == 0)
			backup->map = file;
		else if (strcmp(file.name, "program.rungc") == 0)
			backup->image = file;
		else if (strncmp(file.name, SOURCES, sizeof(SOURCES) - 1) == 0)
			take_source(backup, &file);
	}
	if (backup->sources.failed)
		return report_no_memory(path);
	backup->sources.at[0] = (uint8_t)backup->source_count;
	backup->sources.at[1] = (uint8_t)(backup->source_count >> 8);
	if (!tar_is_at_end(bytes, len, at))
		return no_backup(path, "its end is missing");
	if (!backup->about.bytes || !backup->values.bytes || !backup->map.bytes || !backup->image.bytes)
		return no_backup(path, "a file is missing in it");
	return backup->about.len > sizeof(HEAD) - 1 &&
	       memcmp(backup->about.bytes, HEAD, sizeof(HEAD) - 1) == 0 ? STATUS_GOOD :
	       no_backup(path, "board.txt");
}

static enum status send_values(struct remote *remote, const struct bytes *payload)
{
	for (size_t at = 0; at < payload->len;) {
		struct wire_writer out = desk_ask(&remote->desk, SERVICE_RETAIN);
		const size_t left = payload->len - at, len = left < STORED_BLOCK ? left : STORED_BLOCK;
		struct wire_reader in;
		enum desk_end end;

		wire_put_u8(&out, 1);
		wire_put_u32(&out, (uint32_t)payload->len);
		wire_put_u32(&out, (uint32_t)at);
		wire_put_bytes(&out, payload->at + at, len);
		end = desk_call(&remote->desk, &out, &in);
		if (end != DESK_GOOD)
			return remote_fail(remote, end);
		at += len;
	}
	return STATUS_GOOD;
}

static const char *misfit_text(uint8_t reason)
{
	return reason == CARRY_GONE ? "is no retained variable of the program on the board" :
	       reason == CARRY_NEW ? "has no value in the backup; it keeps its own" :
	       reason == CARRY_TYPE ? "has another type, or less room" : "does not fit";
}

struct restored {
	uint32_t values, lost;
};

/* @how: 0 lists what cannot be restored, 1 restores. */
static enum status put_values(struct remote *remote, uint8_t how, struct restored *restored)
{
	const struct sink *sink = &remote->call->out;
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_RETAIN);
	struct wire_reader in;
	enum desk_end end;
	uint32_t count, told;
	bool any = false;

	wire_put_u8(&out, 2);
	wire_put_expect(&out, &remote->expect);
	wire_put_u8(&out, how);
	end = desk_call(&remote->desk, &out, &in);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	restored->values = wire_u32(&in);
	count = wire_u32(&in);
	told = wire_u32(&in);
	restored->lost = count > told ? count - told : 0;
	if (how == 0 && remote->json)
		sink_text(sink, "{\"not_restored\": [");
	for (uint32_t i = 0; i < told && !in.failed; i++) {
		const uint8_t reason = wire_u8(&in);
		size_t len;
		const char *name = wire_text(&in, &len);

		restored->lost += reason != CARRY_NEW;
		if (how != 0)
			continue;
		if (remote->json) {
			sink_text(sink, any ? ", {\"name\": " : "{\"name\": ");
			sink_json_string(sink, name, len);
			report_json_field("why", misfit_text(reason), sink);
			sink_text(sink, "}");
		} else {
			foreign_write(sink, name, len);
			sink_printf(sink, " %s\n", misfit_text(reason));
		}
		any = true;
	}
	if (how == 0 && remote->json)
		sink_printf(sink, "], \"values\": %u}\n", (unsigned)restored->values);
	else if (how == 0 && count > told)
		sink_printf(sink, "and %u more\n", (unsigned)(count - told));
	return in.failed ? remote_fail(remote, DESK_NONSENSE) : STATUS_GOOD;
}

/* Onto the program that runs. Nothing is done if something is lost and the person says no. */
static enum status restore_values(struct remote *remote, const struct bytes *payload)
{
	struct restored restored;
	enum status status = send_values(remote, payload);

	if (status == STATUS_GOOD)
		status = remote_expect(remote, false);
	if (status == STATUS_GOOD)
		status = put_values(remote, 0, &restored);
	if (status != STATUS_GOOD)
		return status;
	if (restored.lost && !remote_is_wanted(remote, "Restore the others?"))
		return STATUS_NO;
	return put_values(remote, 1, &restored);
}

/* A line of board.txt that begins with @word; its rest. NULL: no more. */
static const char *next_line(const struct backup *backup, const char *word, size_t *at, char *out,
			     size_t size)
{
	const char *text = (const char *)backup->about.bytes;
	const size_t word_len = strlen(word);

	while (*at < backup->about.len) {
		const char *line = text + *at;
		const char *stop = memchr(line, '\n', backup->about.len - *at);
		const size_t len = stop ? (size_t)(stop - line) : backup->about.len - *at;

		*at += len + 1;
		if (len <= word_len || strncmp(line, word, word_len) != 0 || len - word_len >= size)
			continue;
		memcpy(out, line + word_len, len - word_len);
		out[len - word_len] = '\0';
		return out;
	}
	return NULL;
}

/* The settings of the backup; those that it does not have get their defaults again. */
static enum status restore_settings(struct remote *remote, const struct backup *backup)
{
	struct board_settings settings;
	enum status status = remote_settings(remote, &settings);
	char line[128];
	size_t at = 0;
	bool later;

	while (status == STATUS_GOOD && next_line(backup, "set ", &at, line, sizeof(line))) {
		char *space = strchr(line, ' ');

		if (!space)
			continue;
		*space = '\0';
		for (int i = 0; i < settings.count; i++)
			if (strcmp(settings.at[i].key, line) == 0)
				settings.at[i].stored = false;
		status = remote_set(remote, line, space + 1, false, &later);
	}
	for (int i = 0; i < settings.count && status == STATUS_GOOD; i++)
		if (settings.at[i].stored)
			status = remote_set(remote, settings.at[i].key, "", false, &later);
	return status;
}

/* The board begins again: connects until it runs the program, in STOP. */
static enum status come_back(struct remote *remote, const uint8_t program[32])
{
	struct board_status *now = calloc(1, sizeof(*now));
	bool there = false;

	for (int i = 0; now && i < TRIES && !there; i++) {
		const struct timespec rest = { .tv_nsec = TRY_NS };

		nanosleep(&rest, NULL);
		there = remote_again(remote) && remote_peek(remote, now) &&
			memcmp(now->program, program, 32) == 0 && now->mode == STATE_STOP;
	}
	free(now);
	if (there)
		return STATUS_GOOD;
	return remote_fail(remote, DESK_LATE);
}

static enum status take_identity(const struct remote *remote, struct wire_reader *verified,
				 uint8_t program[32])
{
	const uint8_t *identity;

	wire_u8(verified);
	identity = wire_bytes(verified, 32);
	if (!identity)
		return remote_fail(remote, DESK_NONSENSE);
	memcpy(program, identity, 32);
	return STATUS_GOOD;
}

static enum status restore_all(struct remote *remote, const struct backup *backup,
			       const struct bytes *payload, bool keeps)
{
	struct stored stored = { .len = { (uint32_t)backup->image.len, (uint32_t)backup->map.len,
					  (uint32_t)backup->sources.len } };
	struct bytes all = { .at = NULL };
	struct restored restored = { .lost = 0 };
	char mode[16];
	size_t at = 0;
	uint8_t program[32];
	struct wire_reader verified;
	enum status status;

	bytes_add(&all, backup->image.bytes, backup->image.len);
	bytes_add(&all, backup->map.bytes, backup->map.len);
	bytes_add(&all, backup->sources.at, backup->sources.len);
	stored.bytes = all.at;
	status = all.failed ? report_no_memory(remote->where) : remote_expect(remote, false);
	if (status == STATUS_GOOD)
		status = remote_send(remote, &stored, &verified);
	if (status == STATUS_GOOD)
		status = take_identity(remote, &verified, program);
	/* The old program must not run with the settings of the new one. */
	if (status == STATUS_GOOD)
		status = remote_stop(remote);
	if (status == STATUS_GOOD)
		status = remote_expect(remote, false);
	if (status == STATUS_GOOD)
		status = restore_settings(remote, backup);
	if (status == STATUS_GOOD)
		status = remote_commit(remote, COMMIT_STOPPED, 0);
	bytes_free(&all);
	if (status == STATUS_GOOD)
		status = come_back(remote, program);
	if (status == STATUS_GOOD && keeps)
		status = send_values(remote, payload);
	if (status == STATUS_GOOD)
		status = remote_expect(remote, false);
	if (status == STATUS_GOOD && keeps)
		status = put_values(remote, 0, &restored);
	if (status == STATUS_GOOD && restored.lost && !remote_is_wanted(remote, "Restore the others?")) {
		report_flush(remote->call);
		fputs("the board has the program of the backup, without its values; it stays in STOP\n",
		      stderr);
		status = STATUS_NO;
	}
	if (status == STATUS_GOOD && keeps)
		status = put_values(remote, 1, &restored);
	if (status == STATUS_GOOD && next_line(backup, "mode ", &at, mode, sizeof(mode)) &&
	    strcmp(mode, mode_word(STATE_RUN)) == 0)
		status = remote_mode(remote, MODE_WARM);
	return status;
}

/* All of the file is read before the board is asked to change anything. */
static enum status restore(struct remote *remote, const char *path, const uint8_t *bytes, size_t len)
{
	struct backup backup = { .source_count = 0 };
	struct bytes payload = { .at = NULL }, present = { .at = NULL };
	const bool alone = values_is_text(bytes, len);
	enum status status = alone ? STATUS_GOOD : open_archive(path, bytes, len, &backup);
	bool keeps = false;

	if (status == STATUS_GOOD && alone)
		status = values_parse(path, (const char *)bytes, len, &payload);
	else if (status == STATUS_GOOD)
		status = values_parse("retain.txt", (const char *)backup.values.bytes,
				      backup.values.len, &payload);
	if (status == STATUS_GOOD)
		status = read_values(remote, &present, &keeps);
	if (status == STATUS_GOOD && !keeps && (alone || payload.len > RETAIN_HEAD)) {
		report_diag((struct diag){ .id = DIAG_LINK_NO_RETAIN, .file = remote->where }, "%s", "");
		status = STATUS_NO;
	}
	if (status == STATUS_GOOD && alone)
		status = restore_values(remote, &payload);
	else if (status == STATUS_GOOD)
		status = remote_is_wanted(remote, "Replace program, lines, settings and values of the "
					  "board?") ?
			 restore_all(remote, &backup, &payload, keeps) : STATUS_NO;
	bytes_free(&backup.sources);
	bytes_free(&payload);
	bytes_free(&present);
	return status;
}

enum status remote_restore(struct remote *remote)
{
	const char *path = remote->call->arg[2];
	enum status status;
	char *bytes;
	size_t len;

	if (remote->call->arg_count != 3)
		return report_usage(remote->call, "restore needs FILE");
	bytes = report_read(path, &len);
	if (!bytes)
		return STATUS_WRONG;
	status = restore(remote, path, (const uint8_t *)bytes, len);
	free(bytes);
	return status;
}
