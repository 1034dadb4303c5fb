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

/* As load() of struct ladder_files. */
static char *load_source(void *context, const char *path, size_t *len)
{
	struct wire_reader in;
	const uint16_t count = stored_sources(context, &in);
	struct stored_source source;

	for (uint16_t i = 0; i < count && stored_take_source(&in, &source); i++) {
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

/* The names of its sources, for the ladder that reads them: one block, which the caller frees. */
static enum status name_sources(struct remote *remote, const struct stored *stored, char ***out, int *count)
{
	struct wire_reader in;
	struct stored_source source;
	char **name, *at;

	*count = stored_sources(stored, &in);
	*out = name = malloc((size_t)(*count + 1) * sizeof(*name) + stored->len[STORED_SOURCES]);
	if (!name)
		return report_no_memory(remote->where);
	at = (char *)(name + *count + 1);
	for (int i = 0; i < *count; i++) {
		if (!stored_take_source(&in, &source))
			return remote_fail(remote, DESK_NONSENSE);
		name[i] = at;
		memcpy(at, source.name, source.name_len);
		at[source.name_len] = '\0';
		at += source.name_len + 1;
	}
	return STATUS_GOOD;
}

/* The program of the board: from its sources, or from its image. @names: stay while @ladder has
 * them; the caller frees. */
static enum status load_board(struct remote *remote, struct ladder *ladder, struct stored *stored,
			      char ***names)
{
	const struct ladder_files files = { .load = load_source, .context = stored };
	int count;
	enum status status = name_sources(remote, stored, names, &count);
	bool good;

	if (status != STATUS_GOOD)
		return status;
	ladder_set_files(ladder, &files);
	good = count ? ladder_load_stored(ladder, (const char *const *)*names, count) :
	       ladder_load_text(ladder, remote->where, stored_part(stored, STORED_IMAGE),
				stored->len[STORED_IMAGE]);
	report_diags(ladder_diags(ladder));
	return good ? STATUS_GOOD : STATUS_WRONG;
}

enum status remote_compare(struct remote *remote)
{
	struct ladder *there = program_new(false), *here = program_new(false);
	struct stored stored = { .bytes = NULL };
	struct bytes bytes = { .at = NULL };
	char **names = NULL;
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
			status = load_board(remote, there, &stored, &names);
		/* Status 1 means that they differ, so an error is 2. */
		status = status == STATUS_GOOD ? diff_programs(remote->call, there, here) :
						 STATUS_WRONG;
	}
	ladder_free(there);
	ladder_free(here);
	free(names);
	free(bytes.at);
	return status;
}
