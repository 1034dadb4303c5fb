/* SPDX-License-Identifier: MIT
 *
 * classic_read - reads ClassicLadder projects: containers, packed ones, folders, bare rungs.
 *
 * Each member goes to its reader; then the lists are sorted and checked against one another.
 * After one error there is no project.
 */
#include "engine/exchange/classic/classic_read.h"

#include "engine/base/ascii.h"
#include "engine/base/file.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"
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

void classic_lost(struct classic_reader *reader, const char *text)
{
	report_add(reader->report, (struct report_line){
			.kind = REPORT_LOST, .member = reader->member->name,
			.line = reader->line_number }, "%s",
		   report_said(reader->report, text));
}

struct classic_place classic_here(const struct classic_reader *reader)
{
	return (struct classic_place){ reader->member->name, reader->line_number };
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r';
}

/* @text: without blanks around it. */
static bool classic_fail_at(struct classic_reader *reader, enum diag_id id,
			    struct classic_place place, const char *text, size_t len)
{
	struct diag diag = { .id = id, .file = reader->project->file,
			     .line = place.line };
	int shown;

	while (len && is_blank(text[len - 1]))
		len--;
	while (len && is_blank(*text)) {
		text++;
		len--;
	}
	shown = len > LIMIT_ARG ? LIMIT_ARG : (int)len;
	if (diag_severity(id) == SEVERITY_ERROR)
		reader->good = false;
	if (!place.member || !*place.member)
		return diag_add(reader->diags, diag, "%.*s", shown, text);
	return diag_add(reader->diags, diag, "%.40s%s%.*s", place.member,
			len ? ": " : "", shown, text);
}

bool classic_fail(struct classic_reader *reader, enum diag_id id, const char *text,
		  size_t len)
{
	return classic_fail_at(reader, id, classic_here(reader), text, len);
}

bool classic_in_range(struct classic_reader *reader, int number, int low, int high)
{
	char text[16];

	if (number >= low && number <= high)
		return true;
	snprintf(text, sizeof(text), "%d", number);
	return classic_fail(reader, DIAG_IMPORT_RANGE, text, strlen(text));
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
		classic_lost(reader, "this member is not known");
	}
}

/* The only number of a register's line is its mode. */
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
	for (int i = 0; i < project->members; i++) {
		const struct classic_member *member = &project->member[i];

		if (memchr(member->text, 0, member->len))
			classic_fail_at(reader, DIAG_BAD_BYTE,
					(struct classic_place){ member->name, 0 }, "", 0);
		else
			read_member(reader, member);
	}
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

static const char begins[] = "_FILE-";
static const char last[] = "_/FILES_CLASSICLADDER";

struct lines {
	const char *at, *end;
	const char *line;
	size_t len;              /* without its end                            */
	int number;
};

static bool next_line(struct lines *lines)
{
	size_t left = (size_t)(lines->end - lines->at);
	const char *newline;

	if (!left)
		return false;
	newline = memchr(lines->at, '\n', left);
	lines->line = lines->at;
	lines->len = newline ? (size_t)(newline - lines->at) : left;
	lines->at += lines->len + (newline ? 1 : 0);
	lines->number++;
	while (lines->len && (lines->line[lines->len - 1] == '\r' ||
			      lines->line[lines->len - 1] == ' '))
		lines->len--;
	return true;
}

static bool begins_with(const struct lines *lines, const char *word)
{
	size_t len = strlen(word);

	return lines->len >= len && memcmp(lines->line, word, len) == 0;
}
static const char ends[] = "_/FILE-";

const char *classic_text(struct classic_reader *reader, const char *from, size_t len)
{
	bool latin = !utf8_valid(from, len, NULL);
	char *text, *to;

	while (len && is_blank(from[len - 1]))
		len--;
	while (len && is_blank(*from)) {
		from++;
		len--;
	}
	if (!len)
		return "";
	text = to = arena_alloc(reader->arena, len * 2 + 1);
	if (!text)
		return "";
	for (size_t i = 0; i < len; i++) {
		unsigned char byte = (unsigned char)from[i];

		if (byte == '\t')
			*to++ = ' ';
		else if (byte < ' ' || byte == 127 || (latin && byte > 127 && byte < 160))
			*to++ = '?';
		else if (byte < 128 || !latin) {
			*to++ = (char)byte;
		} else {
			*to++ = (char)(0xc0 | byte >> 6);
			*to++ = (char)(0x80 | (byte & 0x3f));
		}
	}
	return text;
}

/* The lines up to the end of the member that begins here. */
static bool take_member(struct classic_reader *reader, struct lines *lines)
{
	struct classic_project *project = reader->project;
	struct classic_place place = { "", lines->number };
	struct classic_member member = { 0 }, *added;

	member.name = classic_text(reader, lines->line + sizeof(begins) - 1,
				   lines->len - (sizeof(begins) - 1));
	member.text = lines->at;
	member.line = lines->number + 1;
	for (;;) {
		if (!next_line(lines) || begins_with(lines, begins) ||
		    begins_with(lines, last))
			return classic_fail_at(reader, DIAG_IMPORT_OPEN, place,
					       member.name, strlen(member.name));
		if (begins_with(lines, ends))
			break;
	}
	member.len = (size_t)(lines->line - member.text);
	if (project->members >= 2 * CLASSIC_LIMIT)
		return classic_fail_at(reader, DIAG_IMPORT_MANY, place, member.name,
				       strlen(member.name));
	added = arena_push(reader->arena, &project->member, &project->members,
			   sizeof(member));
	if (added)
		*added = member;
	return true;
}

/* Splits the text of a container into its members. false: reported. */
static bool classic_members(struct classic_reader *reader, const char *text, size_t len)
{
	struct lines lines = { text, text + len, text, 0, 0 };
	struct classic_place place = { "", 1 };
	bool closed = false;

	next_line(&lines);
	if (lines.len != sizeof(last) - 2) /* _FILES_… has no slash            */
		return classic_fail_at(reader, DIAG_NEWER_VERSION, place, lines.line,
				       lines.len);
	while (!closed && next_line(&lines)) {
		if (begins_with(&lines, last))
			closed = true;
		else if (begins_with(&lines, begins)) {
			if (!take_member(reader, &lines))
				return false;
		} else if (lines.len) {
			place.line = lines.number;
			return classic_fail_at(reader, DIAG_IMPORT_LINE, place,
					       lines.line, lines.len);
		}
	}
	place.line = lines.number;
	return closed || classic_fail_at(reader, DIAG_IMPORT_CUT, place, "", 0);
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
		return classic_fail_at(reader, DIAG_IS_PACKED, (struct classic_place){ "", 0 },
				       "gzip", 4);
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
	reader->project->period = CLASSIC_USUAL_PERIOD;
	reader->project->register_list = 500;
	return true;
}

void classic_twice(struct classic_reader *reader, struct classic_place place,
		   const char *what, int number)
{
	char text[40];

	snprintf(text, sizeof(text), "%s %d", what, number);
	classic_fail_at(reader, DIAG_IMPORT_TWICE, place, text, strlen(text));
}

/* How each entry of every numbered list begins. */
struct numbered { int number; struct classic_place place; };

static struct numbered numbered_at(const void *list, int at, size_t size)
{
	struct numbered entry;

	memcpy(&entry, (const char *)list + (size_t)at * size, sizeof(entry));
	return entry;
}

/* Sorts by number; two entries with one number are an error. */
static void order(struct classic_reader *reader, void *list, int count, size_t size,
		  const char *what)
{
	if (count > 1)
		qsort(list, (size_t)count, size, classic_by_number);
	for (int i = 1; i < count; i++) {
		const struct numbered entry = numbered_at(list, i, size);

		if (entry.number == numbered_at(list, i - 1, size).number)
			classic_twice(reader, entry.place, what, entry.number);
	}
}

static void order_blocks(struct classic_reader *reader, struct classic_blocks *blocks,
			 const char *what)
{
	order(reader, blocks->block, blocks->count, sizeof(*blocks->block), what);
}

static int by_rung(const void *a, const void *b)
{
	return classic_by_number(*(struct classic_rung *const *)a,
				 *(struct classic_rung *const *)b);
}

static void order_rungs(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;

	if (project->rungs > 1)
		qsort(project->rung, (size_t)project->rungs, sizeof(*project->rung), by_rung);
	for (int i = 1; i < project->rungs; i++)
		if (project->rung[i]->number == project->rung[i - 1]->number)
			classic_twice(reader, project->rung[i]->place, "rung",
				      project->rung[i]->number);
}

static void order_lists(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;

	order_rungs(reader);
	order(reader, project->expression, project->expressions, sizeof(*project->expression),
	      "expression");
	order(reader, project->section, project->sections, sizeof(*project->section),
	      "section");
	order(reader, project->step, project->steps, sizeof(*project->step), "step");
	order(reader, project->transition, project->transitions,
	      sizeof(*project->transition), "transition");
	order_blocks(reader, &project->timer, "timer");
	order_blocks(reader, &project->monostable, "monostable");
	order_blocks(reader, &project->counter, "counter");
	order_blocks(reader, &project->iec_timer, "IEC timer");
	order_blocks(reader, &project->reg, "register");
}

static bool has_step(const struct classic_project *project, int index)
{
	return project->steps && bsearch(&index, project->step, (size_t)project->steps,
					 sizeof(*project->step), classic_by_number);
}

static void check_links(struct classic_reader *reader,
			const struct classic_transition *transition, const int *link,
			int count)
{
	for (int i = 0; i < count; i++)
		if (!has_step(reader->project, link[i])) {
			reader->line_number = transition->place.line;
			classic_fail_at(reader, DIAG_IMPORT_NO_STEP, transition->place, "", 0);
			return;
		}
}

/* Follows the rungs of a section to its last one. Returns how many they are. */
static int check_chain(struct classic_reader *reader,
		       const struct classic_section *section)
{
	struct classic_project *project = reader->project;
	struct classic_place place = section->place;
	int number = section->first;

	for (int seen = 0; ; seen++) {
		const struct classic_rung *rung = classic_rung(project, number);
		char text[24];

		if (!rung) {
			snprintf(text, sizeof(text), "rung_%d", number);
			classic_fail_at(reader, DIAG_IMPORT_NO_RUNG, place, text, strlen(text));
			return seen;
		}
		if (number == section->last)
			return seen + 1;
		if (seen > project->rungs) {
			classic_fail_at(reader, DIAG_IMPORT_CIRCLE, place, section->name,
					strlen(section->name));
			return seen;
		}
		place = rung->place;
		number = rung->next;
		if (number < 0) {
			classic_fail_at(reader, DIAG_IMPORT_CHAIN, place, section->name,
					strlen(section->name));
			return seen + 1;
		}
	}
}

/* Sections can share rungs, though the editor never makes that. A bound on their sum keeps a
 * few lines from standing for millions of rungs. */
static void check_sections(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;
	int rungs = 0;

	for (int i = 0; i < project->sections && rungs <= CLASSIC_LIMIT; i++) {
		struct classic_section *section = &project->section[i];

		if (!section->sequential && section->first >= 0)
			rungs += check_chain(reader, section);
		if (rungs > CLASSIC_LIMIT)
			classic_fail_at(reader, DIAG_IMPORT_OVERLAP, section->place,
					section->name, strlen(section->name));
	}
}

/* Projects from before there were sections: all rungs, by number. */
static void add_only_section(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;
	struct classic_section *section;
	const int final = project->rungs - 1;

	for (int i = 0; i < project->rungs; i++) {
		project->rung[i]->previous = i ? project->rung[i - 1]->number : -1;
		project->rung[i]->next = i < final ? project->rung[i + 1]->number : -1;
	}
	section = arena_push(reader->arena, &project->section, &project->sections,
			     sizeof(*section));
	if (!section)
		return;
	*section = (struct classic_section){ .place = { "", 0 }, .name = "", .subroutine = -1,
					     .first = -1, .last = -1 };
	if (final >= 0) {
		section->place = project->rung[0]->place;
		section->first = project->rung[0]->number;
		section->last = project->rung[final]->number;
	}
}

/* ---- the program that wrote it ---- */

static bool has_member(const struct classic_project *project, const char *name)
{
	for (int i = 0; i < project->members; i++)
		if (strcmp(project->member[i].name, name) == 0)
			return true;
	return false;
}

static bool wide(const struct classic_project *project)
{
	for (int i = 0; i < project->rungs; i++)
		if (project->rung[i]->columns > 10 || project->rung[i]->rows > 6)
			return true;
	return false;
}

/* Upstream writes members and sizes that LinuxCNC does not, and the other way round. A project
 * that both could have written counts as upstream's. */
static enum classic_dialect dialect_of(const struct classic_project *project)
{
	static const char *const upstream[] = {
		"project_infos.txt", "registers.csv", "config_events.csv", "modem_config.txt",
		"remote_alarms.txt", "spy_vars.csv" };

	for (size_t i = 0; i < sizeof(upstream) / sizeof(*upstream); i++)
		if (has_member(project, upstream[i]))
			return CLASSIC_UPSTREAM;
	if (wide(project))
		return CLASSIC_UPSTREAM;
	return classic_setting(project, "MODBUS_MAP_COIL_READ") ? CLASSIC_LINUXCNC :
								  CLASSIC_UPSTREAM;
}

enum { CALL = 55, DEEPEST = LIMIT_CALLS - 2, UNSEEN = 0, OPEN = -1 };

/* A section on the way of calls, and the next cell to look at. */
struct frame {
	int section;
	const struct classic_rung *rung; /* NULL: all have been looked at      */
	int cell;                        /* the next one                       */
	int depth;                       /* of the sections that it calls      */
};

struct calls {
	struct classic_reader *reader;
	int *target;   /* by number of a subroutine: its section, or -1        */
	int *depth;    /* by section: levels of calls; UNSEEN, OPEN            */
	struct frame *frame;
	int frames;
};

static void push(struct calls *calls, int section)
{
	const struct classic_project *project = calls->reader->project;
	struct frame *frame = &calls->frame[calls->frames++];

	calls->depth[section] = OPEN;
	*frame = (struct frame){ .section = section };
	if (!project->section[section].sequential)
		frame->rung = classic_rung(project, project->section[section].first);
}

static void fail(struct calls *calls, const struct frame *frame, int y)
{
	const struct classic_rung *rung = frame->rung;
	const char *name = calls->reader->project->section[frame->section].name;
	struct classic_place place = { rung->place.member, rung->row_line[y] };

	classic_fail_at(calls->reader, DIAG_IMPORT_CALLS, place, name, strlen(name));
}

/* The section that the next call of this frame leads to; -1: there is none. */
static int next_call(struct calls *calls, struct frame *frame, int *row)
{
	const struct classic_project *project = calls->reader->project;
	const struct classic_section *section = &project->section[frame->section];

	while (frame->rung) {
		while (frame->cell < CLASSIC_ROWS * CLASSIC_COLUMNS) {
			int y = frame->cell / CLASSIC_COLUMNS;
			const struct classic_cell *cell =
				&frame->rung->cell[y][frame->cell++ % CLASSIC_COLUMNS];

			*row = y;
			if (cell->element == CALL && calls->target[cell->variable.number] >= 0)
				return calls->target[cell->variable.number];
		}
		frame->rung = frame->rung->number == section->last ? NULL :
			      classic_rung(project, frame->rung->next);
		frame->cell = 0;
	}
	return -1;
}

/* Finds the depth of a section and of all that it calls; each is looked at once. */
static bool look_from(struct calls *calls, int section)
{
	int row = 0;

	push(calls, section);
	while (calls->frames) {
		struct frame *frame = &calls->frame[calls->frames - 1];
		int to = next_call(calls, frame, &row);

		if (to >= 0 && calls->depth[to] == UNSEEN) {
			frame->cell--; /* again, when its depth is known           */
			if (calls->frames > DEEPEST) {
				fail(calls, frame, row);
				return false;
			}
			push(calls, to);
		} else if (to >= 0) {
			if (calls->depth[to] == OPEN || calls->depth[to] >= DEEPEST) {
				fail(calls, frame, row);
				return false;
			}
			if (calls->depth[to] > frame->depth)
				frame->depth = calls->depth[to];
		} else {
			calls->depth[frame->section] = frame->depth + 1;
			calls->frames--;
		}
	}
	return true;
}

/* Reports subroutines that call one another in a circle, or deeper than LIMIT_CALLS. Needs
 * sorted sections and good chains of rungs. */
static void classic_calls(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;
	size_t sections = (size_t)project->sections;
	struct calls calls = { .reader = reader };

	calls.target = arena_alloc(reader->arena, CLASSIC_LIMIT * sizeof(int));
	calls.depth = arena_alloc(reader->arena, (sections + 1) * sizeof(int));
	calls.frame = arena_alloc(reader->arena, (sections + 1) * sizeof(struct frame));
	if (!calls.target || !calls.depth || !calls.frame)
		return;
	memset(calls.target, -1, CLASSIC_LIMIT * sizeof(int));
	for (int i = project->sections - 1; i >= 0; i--)
		if (project->section[i].subroutine >= 0 && !project->section[i].sequential)
			calls.target[project->section[i].subroutine] = i;
	for (int i = 0; i < project->sections; i++)
		if (calls.depth[i] == UNSEEN && !look_from(&calls, i))
			return;
}

/* Sorts the lists and checks what refers to what: chains of rungs, steps, calls. */
static void classic_whole(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;

	order_lists(reader);
	if (project->dialect != CLASSIC_NUMERIC)
		project->dialect = dialect_of(project);
	if (!reader->good)
		return;
	/* A container of ClassicLadder can be empty; a folder can hold anything. */
	if (!project->rungs && !project->sections &&
	    (reader->folder || project->dialect == CLASSIC_NUMERIC)) {
		classic_fail_at(reader, DIAG_IMPORT_NOTHING, (struct classic_place){ "", 0 },
				"", 0);
		return;
	}
	if (!project->sections)
		add_only_section(reader);
	check_sections(reader);
	for (int i = 0; i < project->transitions; i++) {
		const struct classic_transition *transition = &project->transition[i];

		check_links(reader, transition, transition->activate, transition->activates);
		check_links(reader, transition, transition->deactivate,
			    transition->deactivates);
	}
	if (reader->good)
		classic_calls(reader);
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
		/* The project points into the text: a copy, with a NUL behind it. */
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

/* One file of the folder as a member. @left: bytes that may still be read. */
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

	if (!begin(&reader, arena, folder, report, diags))
		return NULL;
	reader.folder = true;
	if (!add_files(&reader, folder) && !arena->failed)
		return NULL;
	if (reader.project->members == 0 && !arena->failed) {
		classic_fail_at(&reader, DIAG_NOT_A_FILE, (struct classic_place){ "", 0 },
				"", 0);
		return NULL;
	}
	if (reader.project->members > 1)
		qsort(reader.project->member, (size_t)reader.project->members,
		      sizeof(*reader.project->member), member_order);
	read_members(&reader);
	return end(&reader);
}

void classic_member_begin(struct classic_reader *reader,
			  const struct classic_member *member)
{
	reader->member = member;
	reader->at = member->text;
	reader->end = member->text + member->len;
	reader->line_number = member->line - 1;
	reader->line = member->text;
	reader->len = 0;
}

bool classic_line_next(struct classic_reader *reader)
{
	/* Stops when there are more errors than the list keeps. */
	while (reader->at < reader->end && reader->diags->errors <= LIMIT_DIAGS) {
		const char *line = reader->at;
		size_t left = (size_t)(reader->end - line);
		const char *newline = memchr(line, '\n', left);
		size_t len = newline ? (size_t)(newline - line) : left;

		reader->at = line + len + (newline ? 1 : 0);
		reader->line_number++;
		while (len && is_blank(line[len - 1]))
			len--;
		while (len && is_blank(*line)) {
			line++;
			len--;
		}
		reader->line = line;
		reader->len = len;
		if (len <= CLASSIC_LINE)
			return true;
		classic_fail(reader, DIAG_IMPORT_LONG_LINE, line, 16);
	}
	return false;
}

bool classic_line_told(struct classic_reader *reader)
{
	while (classic_line_next(reader))
		if (reader->len && *reader->line != ';')
			return true;
	return false;
}

const char *classic_line_after(const struct classic_reader *reader, const char *key)
{
	size_t len = ascii_prefix(key, reader->line, reader->len);

	return len ? reader->line + len : NULL;
}

const char *classic_name(struct classic_reader *reader, const char *from, size_t len,
			 size_t usual)
{
	const char *text = classic_text(reader, from, len);
	size_t bytes = strlen(text);

	if (bytes > LIMIT_NAME) {
		classic_fail(reader, DIAG_NAME_TOO_LONG, text, bytes);
		return "";
	}
	if (usual && bytes > usual)
		classic_fail(reader, DIAG_IMPORT_LONG, text, bytes);
	return text;
}

bool classic_number(const char **at, const char *end, int *out)
{
	const char *p = *at;
	bool minus = false;
	int64_t value = 0;

	while (p < end && is_blank(*p))
		p++;
	if (p < end && (*p == '-' || *p == '+'))
		minus = *p++ == '-';
	if (p == end || !ascii_digit(*p))
		return false;
	for (; p < end && ascii_digit(*p); p++)
		if (value <= INT32_MAX)
			value = value * 10 + (*p - '0');
	while (p < end && is_blank(*p))
		p++;
	if (value > INT32_MAX)
		value = INT32_MAX;
	*out = (int)(minus ? -value : value);
	*at = p;
	return true;
}

bool classic_numbers(struct classic_reader *reader, const char *at, int *out, int least,
		     int max)
{
	const char *end = reader->line + reader->len;
	int count = 0;

	memset(out, 0, (size_t)max * sizeof(*out));
	while (at < end && count < max) {
		if (!classic_number(&at, end, &out[count]))
			break;
		count++;
		if (at == end)
			break;
		/* A bare rung file can have blanks alone between numbers. */
		if (*at == ',')
			at++;
		else if (reader->project->dialect != CLASSIC_NUMERIC || !ascii_digit(*at))
			return classic_fail(reader, DIAG_IMPORT_FIELDS, at,
					    (size_t)(end - at));
	}
	if (count < least || (at < end && count < max))
		return classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line, reader->len);
	return true;
}

bool classic_version(struct classic_reader *reader, int known)
{
	const char *at = classic_line_after(reader, "#VER=");
	int version;

	if (!at)
		return true;
	if (!classic_number(&at, reader->line + reader->len, &version))
		return classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line, reader->len);
	if (version > known)
		return classic_fail(reader, DIAG_NEWER_VERSION, reader->line, reader->len);
	return true;
}
