/* SPDX-License-Identifier: MIT
 *
 * grid_words - edits of a rung by words, for the tests of grid_edit.
 *
 * It plays lines such as `place 1 2 NO Stop` and says what is not right about a result
 * whatever the edit was.
 */
#ifndef TESTS_EDITOR_GRID_WORDS_H
#define TESTS_EDITOR_GRID_WORDS_H

#include "editor-gtk/edit/grid_edit.h"
#include "engine/base/diag.h"
#include "engine/ladder.h"
#include "engine/text/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GRID_TEXT 8000
#define GRID_COLUMNS 6

struct grid_bench {
	struct ladder *ladder;
	struct project *project;
	struct diag_list diags;
	struct rung *part;      /* the clipboard                               */
};

static inline bool grid_bench_open(struct grid_bench *bench)
{
	static const char text[] =
		"RUNGBOARD 1\nVAR\nA AT %IX0.0 : BOOL;\nLevel : INT;\nHeat : REAL;\n"
		"END_VAR\nPROGRAM Main LD\nRUNG\n| NO A | COIL Q0 |\nEND_PROGRAM\n";

	memset(bench, 0, sizeof(*bench));
	diag_init(&bench->diags);
	bench->ladder = ladder_new();
	if (!bench->ladder ||
	    !ladder_load_text(bench->ladder, "bench", text, strlen(text)))
		return false;
	bench->project = ladder_project(bench->ladder);
	return true;
}

static inline void grid_bench_close(struct grid_bench *bench)
{
	rung_free(bench->part);
	ladder_free(bench->ladder);
}

/* Without blanks at the begin of lines and double ones. */
static inline void grid_squeeze_text(const char *text, char *out, size_t size)
{
	size_t n = 0;
	char last = '\n';

	for (; *text && n + 1 < size; text++) {
		if (*text == ' ' && (last == ' ' || last == '\n'))
			continue;
		last = out[n++] = *text;
	}
	out[n] = '\0';
}

static inline struct rung *grid_read(struct grid_bench *bench, const char *rows)
{
	char text[GRID_TEXT + 8];
	struct rung *rung;

	snprintf(text, sizeof(text), "RUNG\n%.*s", GRID_TEXT, rows);
	diag_init(&bench->diags);
	rung = text_read_rung(bench->project, text, strlen(text), &bench->diags);
	if (rung && bench->diags.errors) {
		rung_free(rung);
		rung = NULL;
	}
	return rung;
}

static inline struct cell grid_read_cell(struct grid_bench *bench, const char *cell)
{
	char text[1000];
	struct cell none = { 0 };
	struct rung *rung;

	snprintf(text, sizeof(text), "| %s |\n", cell);
	rung = grid_read(bench, text);
	if (rung)
		none = rung->cell[0];
	rung_free(rung);
	return none;
}

static inline void grid_write(struct grid_bench *bench, const struct rung *rung,
			      char *out, size_t size)
{
	char *text = text_write_rung(bench->project, rung);

	grid_squeeze_text(text ? strchr(text, '\n') + 1 : "no memory", out, size);
	free(text);
}

/* The rule that a result breaks; NULL: none. */
static inline const char *grid_wrong(struct grid_bench *bench, const struct rung *rung)
{
	char text[GRID_TEXT * 4];
	const char *wrong = NULL;
	struct rung *again = grid_normalise(rung);
	char *written = text_write_rung(bench->project, rung);
	struct rung *read;

	for (int i = 0; i < rung->rows * rung->cols; i++)
		if (rung->cell[i].spare)
			wrong = "a mark is left";
	if (!again || !rung_equal(again, rung))
		wrong = "not in normal form";
	if (again && !grid_same(again, rung))
		wrong = "normal form is another circuit";
	diag_init(&bench->diags);
	snprintf(text, sizeof(text), "%s", written);
	read = text_read_rung(bench->project, text, strlen(text), &bench->diags);
	if (!read || bench->diags.errors || !grid_same(read, rung))
		wrong = "it does not read as it was";
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			struct grid_place place;
			int columns = grid_display_columns(rung, GRID_COLUMNS);
			int shown = grid_display_column(rung, columns, row, col);

			if (rung_at(rung, row, col)->word == ELEM_EMPTY)
				continue;
			if (grid_display_find(rung, columns, row, shown, &place) !=
				    GRID_SEEN_CELL || place.col != col)
				wrong = "a cell is shown elsewhere";
		}
	rung_free(read);
	rung_free(again);
	free(written);
	return wrong;
}

static inline struct rung *grid_play_drag(const struct rung *rung, struct grid_at *at,
					  const char *rest)
{
	struct grid_at to = *at;
	struct rung *source;
	struct rung *made;

	to.row = (int)strtol(rest, (char **)&rest, 10) - 1;
	to.col = (int)strtol(rest, NULL, 10) - 1;
	made = grid_move(rung, at, rung, &to, &source);
	*at = to;
	return made;
}

/* `draw 1 2 2 4 [along]`: bars count from 1, too, the left rail. */
static inline struct rung *grid_play_stroke(const struct rung *rung, struct grid_at *at,
					    const char *rest, bool erase)
{
	struct grid_end from = { at->row, at->col }, to;
	bool along;

	to.row = (int)strtol(rest, (char **)&rest, 10) - 1;
	to.bar = (int)strtol(rest, (char **)&rest, 10) - 1;
	along = strstr(rest, "along") != NULL;
	return erase ? grid_erase_wire(rung, at, from, to, along) :
		       grid_draw_wire(rung, at, from, to, along);
}

static inline struct rung *grid_play(struct grid_bench *bench, const struct rung *rung,
				     const char *verb, struct grid_at *at,
				     const char *rest)
{
	struct cell cell = { 0 };
	struct grid_area area = { at->row, at->col, at->row, at->col };
	const struct pou *pou = &bench->project->pou[0];
	char *end;
	long number = strtol(rest, &end, 10);

	if (!strcmp(verb, "wire"))
		return grid_wire(rung, at, !strcmp(rest, "up") ? GRID_UP :
				 !strcmp(rest, "down") ? GRID_DOWN :
				 !strcmp(rest, "left") ? GRID_LEFT : GRID_RIGHT);
	if (!strcmp(verb, "move"))
		return grid_play_drag(rung, at, rest);
	if (!strcmp(verb, "draw") || !strcmp(verb, "erase"))
		return grid_play_stroke(rung, at, rest, verb[0] == 'e');
	if (end != rest && strchr("0123456789", rest[0])) {
		area.last_row = (int)number - 1;
		rest = end;
		area.last_col = (int)strtol(rest, &end, 10) - 1;
		rest = end + (*end == ' ');
	}
	if (!strcmp(verb, "copy")) {
		rung_free(bench->part);
		bench->part = grid_copy(rung, at->columns, &area);
		at->refusal = bench->part ? GRID_DONE : GRID_NOTHING;
		return bench->part ? rung_copy(rung) : NULL;
	}
	if (!strcmp(verb, "move-area")) {
		struct grid_at to = { .columns = at->columns };
		struct rung *source, *made;

		to.row = (int)strtol(rest, &end, 10) - 1;
		to.col = (int)strtol(end, NULL, 10) - 1;
		made = grid_move_area(rung, at, &area, rung, &to, false, &source);
		*at = to;
		return made;
	}
	if (!strcmp(verb, "paste") || !strcmp(verb, "paste-below"))
		return grid_paste(rung, at, bench->part, verb[5] != '\0');
	if (!strcmp(verb, "delete"))
		return grid_delete(rung, at);
	if (!strcmp(verb, "delete-area"))
		return grid_delete_area(rung, at, &area);
	if (!strcmp(verb, "delete-row"))
		return grid_delete_row(rung, at);
	if (!strcmp(verb, "delete-column"))
		return grid_delete_column(rung, at);
	if (!strcmp(verb, "insert-row"))
		return grid_insert_row(rung, at);
	if (!strcmp(verb, "insert-column"))
		return grid_insert_column(rung, at);
	if (!strcmp(verb, "open"))
		return grid_open_branch(rung, at);
	if (!strcmp(verb, "gaps"))
		return grid_close_gaps(rung, at);
	if (!strcmp(verb, "negate"))
		return grid_negate(rung, at, bench->project, pou);
	if (!strcmp(verb, "cycle"))
		return grid_cycle(rung, at);
	if (!strcmp(verb, "pin")) {
		const char *space = strchr(rest, ' ');
		size_t len = space ? (size_t)(space - rest) : strlen(rest);
		uint32_t pin = names_intern(&bench->project->names, rest, len);

		if (space)
			cell = grid_read_cell(bench, space + 1);
		return grid_add_pin(rung, at, bench->project, pin,
				    space ? &cell : NULL);
	}
	cell = grid_read_cell(bench, rest);
	if (!strcmp(verb, "place"))
		return grid_place(rung, at, cell, GRID_REPLACE);
	if (!strcmp(verb, "insert"))
		return grid_place(rung, at, cell, GRID_INSERT);
	if (!strcmp(verb, "below"))
		return grid_parallel(rung, at, NULL, cell);
	if (!strcmp(verb, "round"))
		return grid_parallel(rung, at, &area, cell);
	if (!strcmp(verb, "drop"))
		return grid_drop(rung, at, cell);
	if (!strcmp(verb, "set"))
		return grid_set(rung, at, cell);
	at->refusal = GRID_REFUSAL_COUNT;
	return NULL;
}

static const char *const grid_refusal_ids[] = {
#define REFUSAL(id, text) #id,
#include "editor-gtk/edit/grid_refusal.def"
};

/* Plays lines `verb row col rest`; gives the rows afterwards, or what went wrong. */
static inline void grid_bench_play(struct grid_bench *bench, const char *before,
				   const char *edits, char *out, size_t size)
{
	struct rung *rung = grid_read(bench, before);

	if (!rung) {
		snprintf(out, size, "cannot be read: %s\n", before);
		return;
	}
	while (*edits) {
		struct grid_at at = { .columns = grid_display_columns(rung, GRID_COLUMNS) };
		char line[200], verb[20] = "";
		size_t len = strcspn(edits, "\n"), word;
		const char *wrong = NULL;
		struct rung *made;
		char *rest;

		snprintf(line, sizeof(line), "%.*s", (int)len, edits);
		edits += len + (edits[len] == '\n');
		word = strcspn(line, " ");
		snprintf(verb, sizeof(verb), "%.*s", (int)word, line);
		at.row = (int)strtol(line + word, &rest, 10) - 1;
		at.col = (int)strtol(rest, &rest, 10) - 1;
		made = grid_play(bench, rung, verb, &at, rest + (*rest == ' '));
		if (made)
			wrong = grid_wrong(bench, made);
		else
			wrong = at.refusal < GRID_REFUSAL_COUNT ?
				grid_refusal_ids[at.refusal] : "no such verb";
		rung_free(rung);
		if (wrong) {
			snprintf(out, size, "! %s\n", wrong);
			rung_free(made);
			return;
		}
		rung = made;
	}
	grid_write(bench, rung, out, size);
	rung_free(rung);
}
#endif
