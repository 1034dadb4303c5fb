/* SPDX-License-Identifier: MIT
 *
 * classic_read_rung - one rung of a ClassicLadder project, or a bare file of them.
 *
 * Cells as the file has them. The variable of a free cell or wire is left over from an
 * element that stood there, and is dropped. Rows of 10 columns stay as they were drawn:
 * ClassicLadder 0.9 moves their last elements to column 12, where links can be lost. Whether
 * elements have a meaning is checked by classic_grid.c.
 */
#include "engine/base/ascii.h"
#include "engine/exchange/classic/classic_read.h"

enum {
	OPERATE = 60, EMPTY_CELL = 0
};

/* The part of the variable of a cell that has a meaning: none, its number, or all of it. */
enum carries { NOTHING, NUMBER, VARIABLE };

static enum carries carries(int element)
{
	if ((element >= 1 && element <= 4) || (element >= 50 && element <= 53))
		return VARIABLE;
	if ((element >= 10 && element <= 14) || element == 20 || element == OPERATE ||
	    element == 54 || element == 55)
		return NUMBER;
	return NOTHING;
}

const char *classic_read_variable(const char *at, const char *end, char slash,
				  struct classic_variable *variable)
{
	*variable = (struct classic_variable){ .index_type = -1 };
	if (!classic_number(&at, end, &variable->type) || at == end ||
	    (*at != '/' && *at != slash))
		return NULL;
	at++;
	if (!classic_number(&at, end, &variable->number))
		return NULL;
	if (at == end || *at != '[')
		return at;
	at++;
	if (!classic_number(&at, end, &variable->index_type) || at == end || *at != '/')
		return NULL;
	at++;
	if (!classic_number(&at, end, &variable->index_number) || at == end || *at != ']')
		return NULL;
	at++;
	while (at < end && *at == ' ')
		at++;
	return at;
}

/* Drops what has no meaning; false: a number is out of range, reported. */
static bool keep_variable(struct classic_reader *reader, struct classic_cell *cell)
{
	struct classic_variable *variable = &cell->variable;
	enum carries kind = carries(cell->element);

	if (kind == NOTHING) {
		*variable = (struct classic_variable){ .index_type = -1 };
		return true;
	}
	if (!classic_in_range(reader, variable->number, 0, CLASSIC_LIMIT - 1))
		return false;
	if (kind == NUMBER) {
		*variable = (struct classic_variable){ .number = variable->number,
						       .index_type = -1 };
		return true;
	}
	return classic_in_range(reader, variable->type, 0, 999) &&
	       (variable->index_type < 0 ||
		(classic_in_range(reader, variable->index_type, 0, 999) &&
		 classic_in_range(reader, variable->index_number, 0, CLASSIC_LIMIT - 1)));
}

/* TYPE-TOP-VARTYPE/NUMBER up to a comma or the end; in a bare rung file (@slash '-') also up
 * to a blank. NULL: it is no cell. */
static const char *read_cell(const char *at, const char *end, char slash,
			     struct classic_cell *cell, int *top)
{
	if (!classic_number(&at, end, &cell->element) || at == end || *at++ != '-')
		return NULL;
	if (!classic_number(&at, end, top) || at == end || *at++ != '-')
		return NULL;
	at = classic_read_variable(at, end, slash, &cell->variable);
	return at && (at == end || *at == ',' ||
		      (slash == '-' && ascii_digit(*at) && !ascii_digit(at[-1]))) ? at : NULL;
}

static size_t until_comma(const char *at, const char *end)
{
	const char *comma = memchr(at, ',', (size_t)(end - at));

	return (size_t)((comma ? comma : end) - at);
}

/* Reads the cells of the line under the cursor; returns how many, -1: reported. */
static int read_row(struct classic_reader *reader, char slash, struct classic_cell *cell)
{
	const char *at = reader->line, *end = at + reader->len;
	int columns = 0;

	while (at < end) {
		struct classic_cell read = { 0 };
		const char *from = at;
		int top = 0;

		at = read_cell(at, end, slash, &read, &top);
		if (!at) {
			classic_fail(reader, DIAG_IMPORT_CELL, from, until_comma(from, end));
			return -1;
		}
		if (columns == CLASSIC_COLUMNS) {
			classic_fail(reader, DIAG_IMPORT_COLUMNS, "", 0);
			return -1;
		}
		if (!classic_in_range(reader, read.element, 0, 999) ||
		    !classic_in_range(reader, top, 0, 1) || !keep_variable(reader, &read))
			return -1;
		read.top = top;
		cell[columns++] = read;
		at += at < end && *at == ',';
	}
	return columns;
}

static void add_row(struct classic_reader *reader, struct classic_rung *rung, char slash)
{
	struct classic_cell beyond[CLASSIC_COLUMNS] = { { 0 } };
	bool fits = rung->rows < CLASSIC_ROWS;
	struct classic_cell *row = fits ? rung->cell[rung->rows] : beyond;
	int columns = read_row(reader, slash, row);

	if (columns < 0)
		return;
	if (columns > rung->columns)
		rung->columns = columns;
	if (fits)
		rung->row_line[rung->rows++] = reader->line_number;
	for (int x = 0; !fits && x < columns; x++)
		if (beyond[x].element != EMPTY_CELL) {
			classic_lost(reader, "row beyond ClassicLadder's eight");
			return;
		}
}

static struct classic_rung *new_rung(struct classic_reader *reader, int number)
{
	struct classic_project *project = reader->project;
	struct classic_rung *rung = arena_alloc(reader->arena, sizeof(*rung));
	struct classic_rung **added = !rung ? NULL :
		arena_push(reader->arena, &project->rung, &project->rungs, sizeof(rung));

	if (!added)
		return NULL;
	*added = rung;
	rung->number = number;
	rung->place = classic_here(reader);
	rung->label = rung->comment = "";
	rung->previous = rung->next = -1;
	for (int y = 0; y < CLASSIC_ROWS; y++)
		for (int x = 0; x < CLASSIC_COLUMNS; x++)
			rung->cell[y][x].variable.index_type = -1;
	return rung;
}

static void read_link(struct classic_reader *reader, const char *at, int *link)
{
	const char *end = reader->line + reader->len;

	if (!classic_number(&at, end, link))
		classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line, reader->len);
	else
		classic_in_range(reader, *link, -1, CLASSIC_LIMIT - 1);
}

static void read_directive(struct classic_reader *reader, struct classic_rung *rung)
{
	const char *end = reader->line + reader->len, *at;

	if ((at = classic_line_after(reader, "#LABEL=")))
		rung->label = classic_name(reader, at, (size_t)(end - at), 9);
	else if ((at = classic_line_after(reader, "#COMMENT_LONG=")))
		rung->comment = classic_text(reader, at, (size_t)(end - at));
	else if ((at = classic_line_after(reader, "#COMMENT=")))
		rung->comment = *rung->comment ? rung->comment :
				classic_text(reader, at, (size_t)(end - at));
	else if ((at = classic_line_after(reader, "#PREVRUNG=")))
		read_link(reader, at, &rung->previous);
	else if ((at = classic_line_after(reader, "#NEXTRUNG=")))
		read_link(reader, at, &rung->next);
	else if (classic_line_after(reader, "#VER="))
		classic_version(reader, 3);
	else if (!classic_line_after(reader, "#NBRLINES="))
		classic_lost(reader, "this directive is not known");
}

void classic_read_rung(struct classic_reader *reader, const struct classic_member *member,
		       int number)
{
	struct classic_rung *rung;

	classic_member_begin(reader, member);
	rung = new_rung(reader, number);
	if (!rung)
		return;
	rung->place.line = member->line;
	while (classic_line_told(reader)) {
		if (*reader->line == '#')
			read_directive(reader, rung);
		else
			add_row(reader, rung, '/');
	}
}

/* ---- the numeric form ---- */

/* Does the line begin with ";WORD", with blanks anywhere? */
static bool is_heading(const char *line, size_t len, const char *word)
{
	size_t at = 0;

	for (size_t i = 0; i < len && word[at]; i++) {
		if (line[i] == ' ' || line[i] == '\t' || (line[i] == ';' && at == 0))
			continue;
		if (ascii_upper(line[i]) != ascii_upper(word[at]))
			return false;
		at++;
	}
	return !word[at];
}

static bool is_cell(const char *line, size_t len)
{
	struct classic_cell cell;
	int top;

	return read_cell(line, line + until_comma(line, line + len), '-', &cell, &top);
}

bool classic_is_numeric(const char *text, size_t len)
{
	const char *end = text + len;

	for (int lines = 0; text < end && lines < 40; lines++) {
		const char *newline = memchr(text, '\n', (size_t)(end - text));
		size_t size = (size_t)((newline ? newline : end) - text);
		const char *line = text;

		text += size + (newline ? 1 : 0);
		while (size && (*line == ' ' || *line == '\t' || *line == '\r')) {
			line++;
			size--;
		}
		while (size && (line[size - 1] == '\r' || line[size - 1] == ' '))
			size--;
		if (!size)
			continue;
		if (*line == ';' && (is_heading(line, size, "Rung") ||
				     is_heading(line, size, "Timers")))
			return true;
		if (ascii_prefix("#LABEL=", line, size) ||
		    ascii_prefix("#COMMENT=", line, size) || is_cell(line, size))
			return true;
		if (*line != ';' && *line != '#')
			return false;
	}
	return false;
}

/* "BASE,PRESET" of the next timer; or "Base=B" and "Preset=P", one line each. */
static void read_timer(struct classic_reader *reader, int *number)
{
	struct classic_blocks *timers = &reader->project->timer;
	const char *base = classic_line_after(reader, "Base=");
	const char *at = base ? base : classic_line_after(reader, "Preset=");
	int value;

	if (!at) {
		if (ascii_digit(*reader->line) || *reader->line == '-')
			classic_add_block(reader, timers, (*number)++, reader->line, 2);
		else if (*reader->line != '#')
			classic_fail(reader, DIAG_IMPORT_LINE, reader->line, reader->len);
		return;
	}
	if (base) {
		classic_add_block(reader, timers, (*number)++, base, 2);
	} else if (!classic_number(&at, reader->line + reader->len, &value)) {
		classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line, reader->len);
	} else if (timers->count == 0) {
		classic_fail(reader, DIAG_IMPORT_LINE, reader->line, reader->len);
	} else if (classic_in_range(reader, value, 0, CLASSIC_PRESET)) {
		timers->block[timers->count - 1].preset = value;
	}
}

/* Rungs, each below a heading; the first one may have none. */
void classic_read_numeric(struct classic_reader *reader,
			  const struct classic_member *member)
{
	struct classic_rung *rung = NULL;
	bool timers = false;
	int timer = 0;

	classic_member_begin(reader, member);
	while (classic_line_next(reader)) {
		bool comment = reader->len && *reader->line == ';';
		bool heading = comment && is_heading(reader->line, reader->len, "Rung");

		if (!reader->len)
			continue;
		if (comment && is_heading(reader->line, reader->len, "Timers"))
			timers = true;
		if (heading)
			timers = false;
		if (comment && !heading)
			continue;
		if (timers) {
			read_timer(reader, &timer);
			continue;
		}
		if ((heading || !rung) && reader->project->rungs < CLASSIC_LIMIT)
			rung = new_rung(reader, reader->project->rungs);
		if (!rung)
			return;
		if (*reader->line == '#')
			read_directive(reader, rung);
		else if (!heading)
			add_row(reader, rung, '-');
	}
}
