/* SPDX-License-Identifier: MIT
 *
 * boxed - the statements of EXECUTE boxes after an edit: from the texts of the cells, and back.
 *
 * An edit replaces rungs, which know the texts of their boxes. Cross references, and what else looks
 * at single statements, need them as items of the POU.
 */
#include "engine/text/reader.h"

#include <stdlib.h>
#include <string.h>

struct taking {
	struct diag_list *ignored;
	struct project *project;
	struct pou *pou;
	struct pou made;     /* gets items and boxes                          */
	bool failed;
};

/* @cell: 0-based. */
static struct boxed *add_box(struct taking *t, int rung, int cell, const struct cell *of)
{
	struct boxed *box = arena_push(&t->project->arena, &t->made.boxed, &t->made.boxed_count,
				       sizeof(*box));
	const int cols = t->pou->rung[rung]->cols;

	if (!box) {
		t->failed = true;
		return NULL;
	}
	*box = (struct boxed){ .rung = rung, .row = cell / cols, .col = cell % cols,
			       .name = of->operand, .text = of->args };
	return box;
}

/* The text of a cell behind a colon, as it stands in a file. Caller frees. */
static char *with_colon(const struct names *names, uint32_t text, size_t *len)
{
	char *whole;

	*len = names_len(names, text) + 1;
	whole = malloc(*len + 1);
	if (!whole)
		return NULL;
	whole[0] = ':';
	memcpy(whole + 1, names_text(names, text), *len);
	return whole;
}

/* Reads the text of a cell; its lines are counted from the rows of its rung on. */
static void read_cell(struct taking *t, int rung, struct boxed *box)
{
	struct reader *r = reader_new(t->project, "", t->ignored);
	const int first = t->made.st->count;
	size_t len;
	char *text = with_colon(&t->project->names, box->text, &len), *copy = NULL;

	t->failed |= !r || !text;
	if (!t->failed) {
		copy = reader_open(r, text, len);
		r->boxed = true;
		read_st_behind(r, &t->made);
		t->failed |= r->no_memory;
	}
	box->first = first;
	box->count = t->made.st->count - first;
	box->line = rung_line(t->pou->rung[rung], t->pou->rung[rung]->rows) + 1;
	for (int i = first; i < first + box->count; i++)
		t->made.st->item[i].line += box->line;
	free(copy);
	free(text);
	if (r)
		reader_free(r);
}

static void take_rungs(struct taking *t, int first, int count, bool read)
{
	for (int i = first; i < first + count; i++) {
		const struct rung *rung = t->pou->rung[i];

		for (int k = 0; k < rung->rows * rung->cols && !t->failed; k++) {
			struct boxed *box = rung->cell[k].word == ELEM_EXECUTE ?
					    add_box(t, i, k, &rung->cell[k]) : NULL;

			if (box && read)
				read_cell(t, i, box);
		}
	}
}

/* The statements of an action stay the same. */
static void copy_items(struct taking *t, struct sfc_body *body)
{
	const int first = t->made.st->count;

	for (int i = body->first; i < body->first + body->count; i++) {
		struct st_item *item = arena_push(&t->project->arena, &t->made.st->item,
						  &t->made.st->count, sizeof(*item));

		if (!item) {
			t->failed = true;
			return;
		}
		*item = t->pou->st->item[i];
	}
	body->first = first;
}

/* All bodies, in the order of the file. */
static void take_bodies(struct taking *t, bool read)
{
	struct sfc *sfc = t->pou->sfc;

	if (!sfc) {
		take_rungs(t, 0, t->pou->rung_count, read);
		return;
	}
	for (int i = 0; i < sfc->piece_count; i++) {
		const struct sfc_piece *piece = &sfc->piece[i];
		struct sfc_body *body = piece->kind == PIECE_TRANSITION ?
			&sfc->transition[piece->index].condition : piece->kind == PIECE_ACTION ?
			&sfc->action[piece->index].body : NULL;

		if (body && sfc_body_has_rungs(body))
			take_rungs(t, body->first, body->count, read);
		else if (body && body->kind == BODY_ST && read)
			copy_items(t, body);
	}
}

/* Are only the places of the boxes others? Then their statements stay. */
static bool only_moved(const struct taking *t)
{
	for (int i = 0; i < t->made.boxed_count; i++)
		if (i >= t->pou->boxed_count || t->made.boxed[i].text != t->pou->boxed[i].text)
			return false;
	return t->made.boxed_count == t->pou->boxed_count;
}

static void move_boxes(struct taking *t)
{
	for (int i = 0; i < t->made.boxed_count; i++) {
		struct boxed *box = &t->pou->boxed[i];

		box->rung = t->made.boxed[i].rung;
		box->row = t->made.boxed[i].row;
		box->col = t->made.boxed[i].col;
		box->name = t->made.boxed[i].name;
	}
}

bool text_take_boxes(struct project *project, struct pou *pou)
{
	struct taking t = { .ignored = malloc(sizeof(*t.ignored)), .project = project, .pou = pou };

	if (!t.ignored)
		return false;
	diag_init(t.ignored);
	take_bodies(&t, false);
	if (!t.failed && only_moved(&t)) {
		move_boxes(&t);
	} else if (!t.failed) {
		t.made = (struct pou){ .language = pou->language };
		t.made.st = arena_alloc(&project->arena, sizeof(*t.made.st));
		t.failed = !t.made.st;
		if (!t.failed)
			take_bodies(&t, true);
		if (!t.failed) {
			pou->st = t.made.st;
			pou->boxed = t.made.boxed;
			pou->boxed_count = t.made.boxed_count;
		}
	}
	free(t.ignored);
	return !t.failed;
}

bool text_give_boxes(struct project *project, bool (*give)(void *context, uint32_t *slot, uint32_t text),
		     void *context)
{
	for (int i = 0; i < project->pou_count; i++) {
		struct pou *pou = &project->pou[i];

		for (int k = 0; k < pou->boxed_count; k++) {
			const struct boxed *box = &pou->boxed[k];
			struct cell *cell = rung_cell(pou->rung[box->rung], box->row, box->col);
			const uint32_t text = text_statements(project, pou->st->item + box->first, box->count);

			if ((!text && box->count) ||
			    (text != cell->args && !give(context, &cell->args, text)))
				return false;
		}
	}
	return true;
}
