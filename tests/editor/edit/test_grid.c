/* SPDX-License-Identifier: MIT
 *
 * test_grid - edits of rungs: rung before, edits, rung after.
 *
 * Rows and columns are 1-based here, the sheet has six columns. A line of edits is `verb
 * row column [cell]`; a refusal is `! REFUSAL`. Blanks are ignored.
 */
#include "tests/editor/grid_words.h"
#include "tests/tap.h"

struct sample {
	const char *name, *before, *edits, *after;
};

static const struct sample samples[] = {
#include "tests/editor/grid_cases.def"
};

/* ---- places to drop an element ---- */

#define TAKES_ROWS 4

/* A line for each row of the sheet: x where it can be dropped. */
static const struct {
	const char *rung, *cell, *takes;
} takes[] = {
	/* Also in the row below the last one, but in none after it. */
	{ "| NO A | NC B | COIL Q |\n", "NO X", "xxxxx. xxxxx. ...... ......" },
	{ "| NO A | NC B | COIL Q |\n", "COIL X", ".....x .....x ...... ......" },
	{ "| NO A | NC B | COIL Q |\n", "CTU C1", "xxxxx. xxxxx. ...... ......" },
	{ "| NO A | NC B | COIL Q |\n", "---", "...... ...... ...... ......" },
	/* Not on the pins of a box. */
	{ "| NO A | CTU C1 | COIL Q |\n| NO B | .R |\n", "NO X", "xxxxx. x.xxx. xxxxx. ......" },
};

static void check_takes(struct grid_bench *bench, const char *rung_text, const char *cell,
			const char *want)
{
	struct rung *rung = grid_read(bench, rung_text);
	const enum word word = (enum word)grid_read_cell(bench, cell).word;
	bool all[TAKES_ROWS * GRID_COLUMNS] = { false }, alike = true;
	char got[TAKES_ROWS * (GRID_COLUMNS + 1)], *to = got;

	if (!CHECK(rung) || !CHECK(grid_takes(rung, GRID_COLUMNS, TAKES_ROWS, word, all)))
		return;
	for (int row = 0; row < TAKES_ROWS; row++) {
		for (int col = 0; col < GRID_COLUMNS; col++) {
			const bool one = all[row * GRID_COLUMNS + col];

			*to++ = one ? 'x' : '.';
			alike &= one == (grid_can_drop(rung, GRID_COLUMNS, row, col, word) !=
					 GRID_DROP_NOT);
		}
		*to++ = row + 1 < TAKES_ROWS ? ' ' : '\0';
	}
	CHECK_AS(alike, "grid_takes() and grid_can_drop() agree");
	if (!CHECK_AS(strcmp(got, want) == 0, cell))
		printf("# got:  %s\n# want: %s\n", got, want);
	rung_free(rung);
}

/* ---- places to end a wire ---- */

/* The wire begins at the left of the second row. A line for each row, x where it can end. */
static void check_ends(struct grid_bench *bench, const char *rung_text, const char *want)
{
	struct rung *rung = grid_read(bench, rung_text);
	const struct grid_end from = { 1, 0 };
	bool all[TAKES_ROWS * GRID_COLUMNS] = { false }, alike = true;
	char got[TAKES_ROWS * (GRID_COLUMNS + 1)], *to = got;

	if (!CHECK(rung))
		return;
	grid_wire_ends(rung, GRID_COLUMNS, from, TAKES_ROWS, all);
	for (int row = 0; row < TAKES_ROWS; row++) {
		for (int bar = 0; bar < GRID_COLUMNS; bar++) {
			const bool one = all[row * GRID_COLUMNS + bar];

			*to++ = one ? 'x' : '.';
			alike &= one == (grid_wire_course(rung, GRID_COLUMNS, from, (struct grid_end){ row, bar },
							  false) != GRID_NO_COURSE);
		}
		*to++ = row + 1 < TAKES_ROWS ? ' ' : '\0';
	}
	CHECK_AS(alike, "grid_wire_ends() and grid_wire_course() agree");
	if (!CHECK_AS(strcmp(got, want) == 0, "where a wire can end"))
		printf("# got:  %s\n# want: %s\n", got, want);
	rung_free(rung);
}

int main(void)
{
	struct grid_bench bench;

	if (!CHECK(grid_bench_open(&bench)))
		return tap_done();
	for (size_t i = 0; i < sizeof(samples) / sizeof(*samples); i++) {
		const struct sample *s = &samples[i];
		char got[GRID_TEXT], want[GRID_TEXT];

		grid_bench_play(&bench, s->before, s->edits, got, sizeof(got));
		grid_squeeze_text(s->after, want, sizeof(want));
		if (!CHECK_AS(!strcmp(got, want), s->name))
			printf("# got:\n%s# want:\n%s", got, want);
	}
	for (size_t i = 0; i < sizeof(takes) / sizeof(*takes); i++)
		check_takes(&bench, takes[i].rung, takes[i].cell, takes[i].takes);
	check_ends(&bench, "| NO A | NC B | COIL Q |\n", "xxxxxx .xxxxx ...... ......");
	/* Around the contact, below it. */
	check_ends(&bench, "| NO A | NC B | COIL Q |\n| NO C ^ | --- | --- |\n", "x..... .xxxxx xxxxxx ......");
	grid_bench_close(&bench);
	return tap_done();
}
