/* SPDX-License-Identifier: MIT
 *
 * diff_rung - which rungs of two POUs belong together, and how those differ.
 *
 * Rungs that are the same in order come first; then the same rung elsewhere,
 * the same label, and a rung of much the same content in the same gap.
 */
#include "engine/compare/diff.h"
#include "engine/model/args.h"
#include "engine/text/text.h"

#include <stdio.h>
#include <string.h>

struct pairing {
	struct diff *diff;
	const struct pou *a, *b;
	int *to_b, *to_a;     /* partner of each rung, -1: none               */
	int *gap_a, *gap_b;   /* last partner in order before it, by b; -1 */
	uint32_t *id_a, *id_b;
	bool *moved;          /* of rungs of a                                */
};

static const struct cell nothing;

static const struct cell *cell_or_nothing(const struct rung *rung, int row,
					  int col)
{
	return row < rung->rows && col < rung->cols ? rung_at(rung, row, col) :
						      &nothing;
}

static bool is_nothing(const struct cell *cell)
{
	return memcmp(cell, &nothing, sizeof(nothing)) == 0;
}

/* ---- a rung as comparable bytes ---- */

static void put_number(const struct sink *sink, uint32_t number)
{
	sink_write(sink, (const char *)&number, sizeof(number));
}

static void put_text(const struct sink *sink, const struct project *project,
		     uint32_t id)
{
	size_t len = names_len(&project->names, id);

	put_number(sink, (uint32_t)len);
	sink_write(sink, names_text(&project->names, id), len);
}

static uint32_t rung_id(struct diff *diff, const struct project *project,
			const struct rung *rung)
{
	struct sink sink = sink_to_memory(&diff->bytes);

	diff->bytes.len = 0;
	put_text(&sink, project, rung->label);
	put_text(&sink, project, rung->title);
	put_text(&sink, project, rung->comment);
	put_number(&sink, rung->off);
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			const struct cell *cell = rung_at(rung, row, col);

			if (is_nothing(cell))
				continue;
			put_number(&sink, (uint32_t)(row << 16 | col));
			put_number(&sink, (uint32_t)(cell->word << 1 |
						     (cell->link != 0)));
			put_text(&sink, project, cell->operand);
			put_text(&sink, project, cell->args);
			put_text(&sink, project, cell->comment);
		}
	return diff_id(diff, diff->bytes.text, diff->bytes.len);
}

/* ---- what belongs together ---- */

static int *new_numbers(struct diff *diff, int count, int value)
{
	int *numbers = arena_alloc(&diff->arena,
				   (size_t)(count + 1) * sizeof(int));

	if (!numbers)
		diff->failed = true;
	for (int i = 0; numbers && i < count; i++)
		numbers[i] = value;
	return numbers;
}

static uint32_t *ids_of(struct diff *diff, const struct project *project,
			const struct pou *pou)
{
	uint32_t *id = arena_alloc(&diff->arena, (size_t)(pou->rung_count + 1) *
						 sizeof(*id));

	if (!id)
		diff->failed = true;
	for (int i = 0; id && i < pou->rung_count; i++)
		id[i] = rung_id(diff, project, pou->rung[i]);
	return id;
}

static bool pairing_start(struct pairing *pairs)
{
	struct diff *diff = pairs->diff;
	int a_count = pairs->a->rung_count, b_count = pairs->b->rung_count;

	pairs->to_b = new_numbers(diff, a_count, -1);
	pairs->to_a = new_numbers(diff, b_count, -1);
	pairs->gap_a = new_numbers(diff, a_count, -1);
	pairs->gap_b = new_numbers(diff, b_count, -1);
	pairs->moved = arena_alloc(&diff->arena, (size_t)a_count + 1);
	pairs->id_a = ids_of(diff, diff->a, pairs->a);
	pairs->id_b = ids_of(diff, diff->b, pairs->b);
	if (!pairs->moved)
		diff->failed = true;
	return !diff->failed;
}

static bool pair_in_order(struct pairing *pairs)
{
	int gap = -1;

	if (!diff_match(&pairs->diff->arena, pairs->id_a, pairs->a->rung_count,
			pairs->id_b, pairs->b->rung_count, pairs->to_b))
		return false;
	for (int i = 0; i < pairs->a->rung_count; i++) {
		if (pairs->to_b[i] >= 0) {
			gap = pairs->to_b[i];
			pairs->to_a[gap] = i;
		}
		pairs->gap_a[i] = gap;
	}
	gap = -1;
	for (int j = 0; j < pairs->b->rung_count; j++) {
		if (pairs->to_a[j] >= 0)
			gap = j;
		pairs->gap_b[j] = gap;
	}
	return true;
}

/* Pairs the rungs left over that have the same key; key 0 pairs with none. */
static bool pair_by_key(struct pairing *pairs, const uint32_t *key_a,
			const uint32_t *key_b)
{
	int *first = new_numbers(pairs->diff, pairs->diff->names.count + 1, -1);
	int *next = new_numbers(pairs->diff, pairs->b->rung_count, -1);

	if (!first || !next)
		return false;
	for (int j = pairs->b->rung_count - 1; j >= 0; j--)
		if (pairs->to_a[j] < 0 && key_b[j]) {
			next[j] = first[key_b[j]];
			first[key_b[j]] = j;
		}
	for (int i = 0; i < pairs->a->rung_count; i++) {
		int j = pairs->to_b[i] < 0 && key_a[i] ? first[key_a[i]] : -1;

		if (j < 0)
			continue;
		first[key_a[i]] = next[j];
		pairs->to_b[i] = j;
		pairs->to_a[j] = i;
		pairs->moved[i] = pairs->gap_a[i] != pairs->gap_b[j];
	}
	return true;
}

static uint32_t *labels_of(struct diff *diff, const struct project *project,
			   const struct pou *pou)
{
	size_t size = (size_t)(pou->rung_count + 1) * sizeof(uint32_t);
	uint32_t *key = arena_alloc(&diff->arena, size);

	if (!key)
		diff->failed = true;
	for (int i = 0; key && i < pou->rung_count; i++)
		key[i] = diff_name(diff, project_text(project,
						      pou->rung[i]->label));
	return key;
}

/* Two thirds of a cell's weight is its operand, one third its word. */
static bool alike(const struct diff *diff, const struct rung *a,
		  const struct rung *b)
{
	int rows = a->rows > b->rows ? a->rows : b->rows;
	int cols = a->cols > b->cols ? a->cols : b->cols;
	int same = 0, all = 0;

	for (int row = 0; row < rows; row++)
		for (int col = 0; col < cols; col++) {
			const struct cell *x = cell_or_nothing(a, row, col);
			const struct cell *y = cell_or_nothing(b, row, col);

			if (x->word <= ELEM_WIRE && y->word <= ELEM_WIRE)
				continue;
			all += 3;
			same += x->word == y->word;
			same += 2 * !strcmp(project_text(diff->a, x->operand),
					    project_text(diff->b, y->operand));
		}
	return all > 0 && 2 * same >= all;
}

static void pair_by_likeness(struct pairing *pairs)
{
	for (int i = 0; i < pairs->a->rung_count; i++) {
		int begin = pairs->gap_a[i] + 1, looked = 0;

		if (pairs->to_b[i] >= 0)
			continue;
		for (int j = begin; j < pairs->b->rung_count &&
		     pairs->gap_b[j] == begin - 1 &&
		     looked < DIFF_CANDIDATES; j++) {
			if (pairs->to_a[j] >= 0)
				continue;
			looked++;
			if (!alike(pairs->diff, pairs->a->rung[i],
				   pairs->b->rung[j]))
				continue;
			pairs->to_b[i] = j;
			pairs->to_a[j] = i;
			break;
		}
	}
}

/* Inside a gap, what now stands before a rung it followed was moved. */
static void find_crossed(struct pairing *pairs)
{
	int last = -1;

	for (int i = 0; i < pairs->a->rung_count; i++) {
		int j = pairs->to_b[i];

		if (j < 0 || pairs->moved[i])
			continue;
		if (j < last)
			pairs->moved[i] = true;
		else
			last = j;
	}
}

/* ---- cells ---- */

static void write_cell(const struct project *project, const struct cell *cell,
		       char *out, size_t size)
{
	out[0] = '\0';
	if (cell->word != ELEM_EMPTY)
		text_write_cell(project, cell, out, size);
}

/* One parameter; @value NULL: it is not written there. */
static void value_text(const struct arg *arg, char *out, size_t size)
{
	out[0] = '\0';
	if (arg)
		snprintf(out, size, "%s%.*s",
			 arg->output ? "=> " : arg->inverse ? "/" : "",
			 (int)arg->value_len, arg->value);
}

static void compare_arg(struct diff *diff, struct difference what,
			const struct arg *a, const struct arg *b)
{
	const struct arg *pin = a ? a : b;

	snprintf(diff->pin, sizeof(diff->pin), "%.*s", (int)pin->pin_len,
		 pin->pin);
	value_text(a, diff->from, sizeof(diff->from));
	value_text(b, diff->to, sizeof(diff->to));
	diff_texts(diff, what, diff->pin, diff->from, diff->to);
}

static void compare_args(struct diff *diff, struct difference what,
			 const struct cell *a, const struct cell *b)
{
	const char *in_a = project_text(diff->a, a->args);
	const char *in_b = project_text(diff->b, b->args);
	const char *at = in_a;
	struct arg arg, other;
	int before = diff->count;

	snprintf(diff->subject, sizeof(diff->subject), "%s %s",
		 words_row(&diff->a->words, a->word)->word,
		 project_text(diff->a, a->operand));
	size_t end = strlen(diff->subject);
	if (end > 0 && diff->subject[end - 1] == ' ')
		diff->subject[end - 1] = '\0';
	what.subject = diff->subject;
	while (args_next(&at, &arg)) {
		bool found = args_find(in_b, arg.pin, arg.pin_len, &other);
		compare_arg(diff, what, &arg, found ? &other : NULL);
	}
	for (at = in_b; args_next(&at, &arg);)
		if (!args_find(in_a, arg.pin, arg.pin_len, &other))
			compare_arg(diff, what, NULL, &arg);
	if (diff->count == before && strcmp(in_a, in_b) != 0)
		diff_texts(diff, what, "parameters", in_a, in_b);
}

static void compare_cells(struct diff *diff, struct difference what,
			  const struct cell *a, const struct cell *b)
{
	bool same = a->word == b->word &&
		    strcmp(project_text(diff->a, a->operand),
			   project_text(diff->b, b->operand)) == 0;

	if (!same) {
		write_cell(diff->a, a, diff->from, sizeof(diff->from));
		write_cell(diff->b, b, diff->to, sizeof(diff->to));
		diff_texts(diff, what, NULL, diff->from, diff->to);
	} else {
		compare_args(diff, what, a, b);
	}
	diff_texts(diff, what, "comment", project_text(diff->a, a->comment),
		   project_text(diff->b, b->comment));
	if (!a->link != !b->link) {
		what.property = "link";
		what.change = b->link ? "added" : "removed";
		diff_say(diff, what);
	}
}

static void say_changes(struct diff *diff, struct difference what,
			  const struct rung *a, const struct rung *b)
{
	int rows = a->rows > b->rows ? a->rows : b->rows;
	int cols = a->cols > b->cols ? a->cols : b->cols;

	diff_texts(diff, what, "label", project_text(diff->a, a->label),
		   project_text(diff->b, b->label));
	diff_texts(diff, what, "title", project_text(diff->a, a->title),
		   project_text(diff->b, b->title));
	diff_texts(diff, what, "comment", project_text(diff->a, a->comment),
		   project_text(diff->b, b->comment));
	if (!a->off != !b->off) {
		what.change = b->off ? "switched off" : "switched on";
		diff_say(diff, what);
		what.change = NULL;
	}
	for (what.row = 1; what.row <= rows; what.row++)
		for (what.col = 1; what.col <= cols; what.col++)
			compare_cells(diff, what,
				cell_or_nothing(a, what.row - 1, what.col - 1),
				cell_or_nothing(b, what.row - 1, what.col - 1));
}

/* ---- telling ---- */

static struct difference of_rung(const struct project *project,
				 const struct pou *pou, int index)
{
	return (struct difference){
		.pou = project_text(project, pou->name), .rung = index + 1,
		.label = project_text(project, pou->rung[index]->label),
	};
}

static void give(struct diff *diff, int rung_a, int rung_b, bool moved, bool changed)
{
	struct compare_pair pair = diff->pair;

	pair.rung_a = rung_a;
	pair.rung_b = rung_b;
	pair.moved = moved;
	pair.changed = changed;
	diff->take(diff->context, pair);
}

static int tell_added(const struct pairing *pairs, int from, int end)
{
	for (int j = from; j < end; j++)
		if (pairs->to_a[j] < 0 && pairs->diff->take) {
			give(pairs->diff, -1, j, false, true);
		} else if (pairs->to_a[j] < 0) {
			struct difference what = of_rung(pairs->diff->b,
							 pairs->b, j);
			what.change = "added";
			diff_say(pairs->diff, what);
		}
	return end > from ? end : from;
}

static void tell(const struct pairing *pairs, int i)
{
	struct diff *diff = pairs->diff;
	struct difference what = of_rung(diff->a, pairs->a, i);
	int j = pairs->to_b[i];
	bool changed = j < 0 || pairs->id_a[i] != pairs->id_b[j];
	char moved[40];

	if (diff->take) {
		give(diff, i, j, pairs->moved[i], changed);
		return;
	}
	if (j >= 0 && pairs->moved[i]) {
		snprintf(moved, sizeof(moved), "moved to rung %d", j + 1);
		what.change = moved;
		diff_say(diff, what);
		what.change = NULL;
	} else if (j < 0) {
		what.change = "removed";
		diff_say(diff, what);
	}
	if (j >= 0 && changed)
		say_changes(diff, what, pairs->a->rung[i], pairs->b->rung[j]);
}

void diff_rungs(struct diff *diff, const struct pou *a, const struct pou *b)
{
	struct pairing pairs = { .diff = diff, .a = a, .b = b };
	int told = 0;

	if (!pairing_start(&pairs))
		return;
	uint32_t *label_a = labels_of(diff, diff->a, a);
	uint32_t *label_b = labels_of(diff, diff->b, b);
	if (diff->failed || !pair_in_order(&pairs) ||
	    !pair_by_key(&pairs, pairs.id_a, pairs.id_b) ||
	    !pair_by_key(&pairs, label_a, label_b)) {
		diff->failed = true;
		return;
	}
	pair_by_likeness(&pairs);
	find_crossed(&pairs);
	for (int i = 0; i < a->rung_count; i++) {
		if (pairs.to_b[i] >= 0 && !pairs.moved[i])
			told = tell_added(&pairs, told, pairs.to_b[i]);
		tell(&pairs, i);
	}
	tell_added(&pairs, told, b->rung_count);
}
