/* SPDX-License-Identifier: MIT
 *
 * classic_read - ClassicLadder projects: containers, packed ones, folders, bare rungs.
 *
 * Which reader gets which member, and what is found by its number afterwards. All or
 * nothing: with one error there is no project.
 */
#include "engine/base/ascii.h"
#include "engine/base/file.h"
#include "engine/exchange/classic/classic_read.h"
#include "engine/exchange/classic/inflate.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

static const char first_line[] = "_FILES_CLASSICLADDER";
static const char byte_order_mark[] = "\xef\xbb\xbf";

static bool is_container(const char *text, size_t len)
{
	return len >= sizeof(first_line) - 1 &&
	       memcmp(text, first_line, sizeof(first_line) - 1) == 0;
}

/* Bytes of a byte order mark, or 0. */
static size_t mark_length(const char *text, size_t len)
{
	return len >= 3 && memcmp(text, byte_order_mark, 3) == 0 ? 3 : 0;
}

bool classic_is(const void *bytes, size_t len)
{
	const char *text = bytes;
	size_t mark = mark_length(text, len);

	return inflate_is(bytes, len) || is_container(text + mark, len - mark) ||
	       classic_is_numeric(text + mark, len - mark);
}

/* ---- members ---- */

/* The number of rung_N.csv; -1: it is no such name. */
static int rung_number(const char *name)
{
	size_t len = strlen(name), at = ascii_prefix("rung_", name, len);
	int number = 0;

	if (!at || !ascii_digit(name[at]))
		return -1;
	for (; ascii_digit(name[at]); at++)
		if (number < CLASSIC_LIMIT)
			number = number * 10 + (name[at] - '0');
	return strcmp(name + at, ".csv") == 0 ? number : -1;
}

static bool is_kept(const char *name)
{
	static const char *const known[] = {
		"modbusioconf.csv", "config_events.csv", "modem_config.txt",
		"remote_alarms.txt", "spy_vars.csv" };

	for (size_t i = 0; i < sizeof(known) / sizeof(*known); i++)
		if (strcmp(name, known[i]) == 0)
			return true;
	return false;
}

static void read_member(struct classic_reader *reader, const struct classic_member *member)
{
	struct classic_project *project = reader->project;
	const char *name = member->name;
	int number = rung_number(name);

	reader->member = member;
	reader->line_number = member->line;
	if (number >= 0) {
		if (classic_in_range(reader, number, 0, CLASSIC_LIMIT - 1))
			classic_read_rung(reader, member, number);
	} else if (strcmp(name, "timers.csv") == 0) {
		classic_read_blocks(reader, member, &project->timer, "T", 2);
	} else if (strcmp(name, "monostables.csv") == 0) {
		classic_read_blocks(reader, member, &project->monostable, "M", 2);
	} else if (strcmp(name, "counters.csv") == 0) {
		classic_read_blocks(reader, member, &project->counter, "C", 1);
	} else if (strcmp(name, "timers_iec.csv") == 0) {
		classic_read_blocks(reader, member, &project->iec_timer, "TM", 3);
	} else if (strcmp(name, "registers.csv") == 0) {
		classic_read_blocks(reader, member, &project->reg, "R", 1);
	} else if (strcmp(name, "arithmetic_expressions.csv") == 0) {
		classic_read_expressions(reader, member);
	} else if (strcmp(name, "sections.csv") == 0) {
		classic_read_sections(reader, member);
	} else if (strcmp(name, "sequential.csv") == 0) {
		classic_read_sfc(reader, member);
	} else if (strcmp(name, "symbols.csv") == 0) {
		classic_read_symbols(reader, member);
	} else if (strcmp(name, "ioconf.csv") == 0) {
		classic_read_io(reader, member);
	} else if (strcmp(name, "general.txt") == 0 || strcmp(name, "com_params.txt") == 0 ||
		   strcmp(name, "project_infos.txt") == 0) {
		classic_read_settings(reader, member);
	} else if (!is_kept(name)) {
		classic_lost(reader, "a member that is not known");
	}
}

/* A register's line has its mode alone. */
static void registers_have_modes(struct classic_reader *reader)
{
	struct classic_blocks *blocks = &reader->project->reg;

	for (int i = 0; i < blocks->count; i++) {
		struct classic_block *block = &blocks->block[i];

		block->mode = block->preset;
		block->preset = 0;
		if (block->mode > 2)
			classic_fail_at(reader, DIAG_IMPORT_RANGE, block->place, "mode", 4);
	}
}

static int by_name(const void *a, const void *b)
{
	const struct classic_member *const *x = a, *const *y = b;
	int order = strcmp((*x)->name, (*y)->name);

	return order ? order : ((*x)->line > (*y)->line) - ((*x)->line < (*y)->line);
}

static void look_for_twice(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;
	size_t count = (size_t)project->members;
	const struct classic_member **sorted =
		arena_alloc(reader->arena, count * sizeof(*sorted));

	if (!sorted)
		return;
	for (size_t i = 0; i < count; i++)
		sorted[i] = &project->member[i];
	if (count > 1)
		qsort(sorted, count, sizeof(*sorted), by_name);
	for (size_t i = 1; i < count; i++)
		if (strcmp(sorted[i]->name, sorted[i - 1]->name) == 0)
			classic_fail_at(reader, DIAG_IMPORT_TWICE, (struct classic_place){
				sorted[i]->name, sorted[i]->line - 1 }, "", 0);
}

static bool read_members(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;

	look_for_twice(reader);
	for (int i = 0; i < project->members; i++)
		read_member(reader, &project->member[i]);
	registers_have_modes(reader);
	return true;
}

static void read_bare(struct classic_reader *reader, const char *text, size_t len)
{
	struct classic_project *project = reader->project;
	struct classic_member *member = arena_push(reader->arena, &project->member,
						   &project->members, sizeof(*member));

	project->dialect = CLASSIC_NUMERIC;
	if (!member)
		return;
	*member = (struct classic_member){ .name = "", .text = text, .len = len, .line = 1 };
	classic_read_numeric(reader, member);
}

static bool no_nul(struct classic_reader *reader, const char *text, size_t len)
{
	const char *nul = len ? memchr(text, 0, len) : NULL;
	struct classic_place place = { "", 1 };

	if (!nul)
		return true;
	for (const char *at = text; at < nul; at++)
		place.line += *at == '\n';
	return classic_fail_at(reader, DIAG_BAD_BYTE, place, "", 0);
}

static bool read_text(struct classic_reader *reader, const char *text, size_t len)
{
	struct classic_place whole = { "", 0 };
	size_t mark = mark_length(text, len);

	text += mark;
	len -= mark;
	if (!len)
		return classic_fail_at(reader, DIAG_EMPTY_FILE, whole, "", 0);
	if (len > CLASSIC_BYTES)
		return classic_fail_at(reader, DIAG_TOO_LARGE, whole, "", 0);
	if (!no_nul(reader, text, len))
		return false;
	if (is_container(text, len))
		return classic_members(reader, text, len) && read_members(reader);
	if (!classic_is_numeric(text, len))
		return classic_fail_at(reader, DIAG_IMPORT_LINE,
				       (struct classic_place){ "", 1 }, text,
				       strcspn(text, "\r\n"));
	read_bare(reader, text, len);
	return true;
}

static bool begin(struct classic_reader *reader, struct arena *arena, const char *file,
		  struct classic_report *report, struct diag_list *diags)
{
	*reader = (struct classic_reader){ .arena = arena, .report = report,
					   .diags = diags, .good = true };
	reader->project = arena_alloc(arena, sizeof(*reader->project));
	if (!reader->project) {
		diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = file }, "%s", "");
		return false;
	}
	reader->project->file = file;
	reader->project->period = 50;
	reader->project->register_list = 500;
	return true;
}

static struct classic_project *end(struct classic_reader *reader)
{
	if (!reader->arena->failed)
		classic_whole(reader);
	if (reader->arena->failed || reader->report->arena.failed)
		classic_fail_at(reader, DIAG_NO_MEMORY, (struct classic_place){ "", 0 },
				"", 0);
	return reader->good ? reader->project : NULL;
}

struct classic_project *classic_read(struct arena *arena, const char *file,
				     const void *bytes, size_t len,
				     struct classic_report *report,
				     struct diag_list *diags)
{
	struct classic_reader reader;
	const char *text;
	enum diag_id why;

	if (!begin(&reader, arena, file, report, diags))
		return NULL;
	if (inflate_is(bytes, len)) {
		text = inflate_gzip(arena, bytes, len, CLASSIC_BYTES, &len, &why);
		if (!text) {
			diag_add(diags, (struct diag){ .id = why, .file = file }, "%s", "");
			return NULL;
		}
	} else {
		/* A NUL behind it, and it lives as long as what is made of it. */
		text = len > CLASSIC_BYTES ? bytes : arena_copy(arena, bytes, len);
	}
	if (!text) {
		diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = file }, "%s", "");
		return NULL;
	}
	return read_text(&reader, text, len) ? end(&reader) : NULL;
}

/* ---- folders ---- */

static bool is_ours(const char *name)
{
	size_t len = strlen(name);
	const char *end = len > 4 ? name + len - 4 : "";

	return strcmp(end, ".csv") == 0 || strcmp(end, ".txt") == 0;
}

static int member_order(const void *a, const void *b)
{
	const struct classic_member *x = a, *y = b;

	return strcmp(x->name, y->name);
}

/* One file of the folder as a member; @left: bytes that may still come. */
static bool add_file(struct classic_reader *reader, const char *folder, const char *name,
		     size_t *left)
{
	struct classic_project *project = reader->project;
	struct classic_member *member;
	size_t size = strlen(folder) + strlen(name) + 2, len = 0;
	char *path = arena_alloc(reader->arena, size);
	char *text;

	if (!path)
		return false;
	snprintf(path, size, "%s/%s", folder, name);
	text = file_read(path, *left, &len, reader->diags);
	if (!text)
		return false;
	*left -= len;
	member = arena_push(reader->arena, &project->member, &project->members,
			    sizeof(*member));
	if (member)
		*member = (struct classic_member){
			.name = arena_copy(reader->arena, name, strlen(name)),
			.text = arena_copy(reader->arena, text, len), .len = len, .line = 1 };
	free(text);
	return !reader->arena->failed;
}

static bool add_files(struct classic_reader *reader, const char *folder)
{
	size_t left = CLASSIC_BYTES;
	DIR *dir = opendir(folder);
	struct dirent *entry;
	bool good = true;

	if (!dir)
		return classic_fail_at(reader, DIAG_CANNOT_READ,
				       (struct classic_place){ "", 0 }, strerror(errno),
				       strlen(strerror(errno)));
	while (good && (entry = readdir(dir)))
		if (is_ours(entry->d_name) && *entry->d_name != '.')
			good = add_file(reader, folder, entry->d_name, &left);
	closedir(dir);
	return good;
}

struct classic_project *classic_read_folder(struct arena *arena, const char *folder,
					    struct classic_report *report,
					    struct diag_list *diags)
{
	struct classic_reader reader;

	if (!begin(&reader, arena, folder, report, diags) ||
	    (!add_files(&reader, folder) && !arena->failed))
		return NULL;
	if (reader.project->members == 0 && !arena->failed) {
		classic_fail_at(&reader, DIAG_NOT_A_FILE, (struct classic_place){ "", 0 },
				"", 0);
		return NULL;
	}
	if (reader.project->members > 1)
		qsort(reader.project->member, (size_t)reader.project->members,
		      sizeof(*reader.project->member), member_order);
	for (int i = 0; i < reader.project->members; i++) {
		const struct classic_member *member = &reader.project->member[i];

		if (memchr(member->text, 0, member->len))
			classic_fail_at(&reader, DIAG_BAD_BYTE,
					(struct classic_place){ member->name, 0 }, "", 0);
		else
			read_member(&reader, member);
	}
	registers_have_modes(&reader);
	return end(&reader);
}
