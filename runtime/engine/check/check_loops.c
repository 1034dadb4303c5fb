/* SPDX-License-Identifier: MIT
 *
 * check_loops - FOR and NEXT of a ladder: in pairs, each alone in its rung.
 *
 * What stands behind FOR is looked at with the operands.
 */
#include "engine/check/check.h"

struct loops {
	const struct project *project;
	const struct pou *pou;
	int first, end;        /* rungs, 0-based                              */
	uint8_t *bad;
	struct diag_list *diags;
	int open[LIMIT_LOOPS]; /* rungs of FORs without a NEXT, 1-based       */
	int depth;
	bool good;
};

/* @cell: index in the rung's cells. */
static void report(struct loops *c, enum diag_id id, int number, int cell)
{
	const struct rung *rung = c->pou->rung[number - 1];
	int row = cell / rung->cols, col = cell % rung->cols;
	struct diag place = {
		.id = id, .file = c->pou->file, .line = rung_line(rung, row + 1),
		.pou = project_text(c->project, c->pou->name),
		.rung = number, .row = row + 1, .col = col + 1,
	};

	diag_add(c->diags, place, "%s",
		 word_row((enum word)rung->cell[cell].word)->word);
	c->good = false;
}

static enum operand_kind kind_of(const struct rung *rung, int cell)
{
	return word_row((enum word)rung->cell[cell].word)->operand;
}

/* Other outputs beside it, or before a NEXT anything at all? */
static bool is_alone(const struct rung *rung, int cell)
{
	bool end = kind_of(rung, cell) == OPND_LOOP_END;

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct word_row *row =
			word_row((enum word)rung->cell[i].word);
		bool output = row->place == PLACE_LAST || row->place == PLACE_BOX;
		bool thing = row->place != PLACE_NONE && row->place != PLACE_WIRE;

		if (i != cell && (end ? thing : output))
			return false;
	}
	return true;
}

static void check_cell(struct loops *c, int number, int cell)
{
	const struct rung *rung = c->pou->rung[number - 1];
	bool end = kind_of(rung, cell) == OPND_LOOP_END;

	if (!is_alone(rung, cell))
		report(c, DIAG_LOOP_ALONE, number, cell);
	if (end && c->depth == 0)
		report(c, DIAG_LOOP_OPEN, number, cell);
	else if (end)
		c->depth--;
	else if (c->depth++ < LIMIT_LOOPS)
		c->open[c->depth - 1] = number;
	else if (c->depth == LIMIT_LOOPS + 1)
		report(c, DIAG_LOOP_DEPTH, number, cell);
}

/* The cell of the FOR in a rung. */
static int loop_cell(const struct rung *rung)
{
	int cell = 0;

	while (kind_of(rung, cell) != OPND_LOOP)
		cell++;
	return cell;
}

/* A loop without its other end is not translated: one mistake, one message. */
static void mark_bad(const struct loops *c)
{
	for (int i = c->first; c->bad && i < c->end; i++) {
		const struct rung *rung = c->pou->rung[i];

		for (int k = 0; k < rung->rows * rung->cols; k++)
			if (kind_of(rung, k) == OPND_LOOP ||
			    kind_of(rung, k) == OPND_LOOP_END)
				c->bad[i] = 1;
	}
}

bool check_loops(const struct project *project, const struct pou *pou, int first,
		 int count, uint8_t *bad, struct diag_list *diags)
{
	struct loops c = { .project = project, .pou = pou, .first = first,
			   .end = first + count, .bad = bad, .diags = diags,
			   .good = true };

	for (int number = first + 1; number <= c.end; number++) {
		const struct rung *rung = pou->rung[number - 1];

		for (int i = 0; !rung->off && i < rung->rows * rung->cols; i++) {
			enum operand_kind kind = kind_of(rung, i);

			if (kind == OPND_LOOP || kind == OPND_LOOP_END)
				check_cell(&c, number, i);
		}
	}
	while (c.good && c.depth > 0) {
		int number = c.open[--c.depth];

		report(&c, DIAG_LOOP_OPEN, number,
		       loop_cell(pou->rung[number - 1]));
	}
	if (!c.good)
		mark_bad(&c);
	return c.good;
}
