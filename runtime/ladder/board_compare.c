/* SPDX-License-Identifier: MIT
 *
 * board_compare - `ladder board WHERE compare FILE`: how a program differs from that of the
 * board.
 *
 * It compares with the sources that the board stores; without them only code and data.
 */
#include "ladder/remote.h"

#include <stdlib.h>
#include <string.h>

/* One of the files that a board stores; all are borrowed. */
struct source {
	const char *name;
	size_t name_len;
	const uint8_t *bytes;
	uint32_t len;
};

/* Takes the next one. False: the bytes are damaged. */
static bool take(struct wire_reader *in, struct source *out)
{
	out->name = wire_text(in, &out->name_len);
	out->len = wire_u32(in);
	out->bytes = wire_bytes(in, out->len);
	return !in->failed && out->bytes;
}

/* As load() of struct ladder_files. */
static char *load_source(void *context, const char *path, size_t *len)
{
	const struct stored *stored = context;
	struct wire_reader in = wire_read(stored_part(stored, STORED_SOURCES),
					  stored->len[STORED_SOURCES]);
	const uint16_t count = wire_u16(&in);
	struct source source;

	for (uint16_t i = 0; i < count && take(&in, &source); i++) {
		char *text;

		if (source.name_len != strlen(path) ||
		    memcmp(source.name, path, source.name_len) != 0)
			continue;
		text = malloc(source.len + 1);
		if (!text)
			return NULL;
		memcpy(text, source.bytes, source.len);
		text[source.len] = '\0';
		*len = source.len;
		return text;
	}
	return NULL;
}

/* The program of the board: from its sources, or from its image. @name: gets the name of the
 * program's file, which must stay while @ladder has it; others are named relative to it. */
static enum status load_board(struct remote *remote, struct ladder *ladder,
			      struct stored *stored, char *name, size_t size)
{
	const struct ladder_files files = { .load = load_source, .context = stored };
	struct wire_reader in = wire_read(stored_part(stored, STORED_SOURCES),
					  stored->len[STORED_SOURCES]);
	struct source source;
	bool good;

	if (stored->len[STORED_SOURCES] && wire_u16(&in)) {
		if (!take(&in, &source) || source.name_len >= size)
			return remote_fail(remote, DESK_NONSENSE);
		memcpy(name, source.name, source.name_len);
		name[source.name_len] = '\0';
		ladder_set_files(ladder, &files);
		good = ladder_load_text(ladder, name, source.bytes, source.len);
	} else {
		good = ladder_load_text(ladder, remote->where, stored_part(stored, STORED_IMAGE),
					stored->len[STORED_IMAGE]);
	}
	report_diags(ladder_diags(ladder));
	return good ? STATUS_GOOD : STATUS_WRONG;
}

enum status remote_compare(struct remote *remote)
{
	struct ladder *there = program_new(false), *here = program_new(false);
	struct stored stored = { .bytes = NULL };
	struct bytes bytes = { .at = NULL };
	char name[WIRE_TEXT_MOST + 1];
	enum status status = STATUS_WRONG;

	if (remote->call->arg_count != 3) {
		report_usage(remote->call, "compare needs a FILE");
	} else if (!there || !here) {
		report_no_memory(remote->where);
	} else {
		ladder_classic_task(here, true);
		status = report_load(here, remote->call->arg[2], false);
		if (status == STATUS_GOOD)
			status = remote_receive(remote, &stored, &bytes);
		if (status == STATUS_GOOD)
			status = load_board(remote, there, &stored, name, sizeof(name));
		/* Status 1 means that they differ, so an error is 2. */
		status = status == STATUS_GOOD ? diff_programs(remote->call, there, here) :
						 STATUS_WRONG;
	}
	ladder_free(there);
	ladder_free(here);
	free(bytes.at);
	return status;
}
