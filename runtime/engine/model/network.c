/* SPDX-License-Identifier: MIT
 *
 * network - the power-flow graph of a rung.
 *
 * A union-find over the bars, then two counting passes: the time is linear in the
 * number of cells. Rungs with errors have graphs, too.
 */
#include "engine/model/network.h"

#include <string.h>

/* In both arrays the root is the smaller bar: the first bar of a net in reading order. */
static int lead_of(int *bar, int at)
{
	while (bar[at] != at) {
		bar[at] = bar[bar[at]];
		at = bar[at];
	}
	return at;
}

static void join(int *bar, int a, int b)
{
	a = lead_of(bar, a);
	b = lead_of(bar, b);
	if (a < b)
		bar[b] = a;
	else
		bar[a] = b;
}

/* Joins bars along wires and links; counts elements and pin rows. */
static void join_bars(const struct rung *rung, struct network *out)
{
	int width = rung->cols + 1, *bar = out->bar_net;
	const struct cell *cell = rung->cell;

	for (int row = 0; row < rung->rows; row++) {
		int at = row * width;

		for (int i = 0; i < width; i++)
			bar[at + i] = at + i;
		bar[at] = 0;
		for (int col = 0; col < rung->cols; col++, cell++) {
			int right = at + col + 1;

			if (cell->word == ELEM_WIRE)
				join(bar, right - 1, right);
			else if (cell->word == ELEM_PIN)
				out->pin_count++;
			else if (cell->word != ELEM_EMPTY)
				out->element_count++;
			if (cell->link && row > 0)
				join(bar, right, right - width);
		}
	}
}

/* The root of a bar comes before it, so it has its net number already. */
static void number_nets(struct network *out)
{
	int bars = out->rows * (out->cols + 1), *bar = out->bar_net;

	for (int i = 0; i < bars; i++)
		bar[i] = bar[i] == i ? out->net_count++ : bar[bar[i]];
}

static bool is_box(enum word word)
{
	const struct word_row *row = word_row(word);

	return row->place == PLACE_BOX || row->operand == OPND_EXPR;
}

/* Elements in reading order. A pin row belongs to the box above it in its column; this
 * counts the pins of each box. */
static void list_elements(const struct rung *rung, struct network *out)
{
	int box[LIMIT_COLS], count = 0;
	const struct cell *cell = rung->cell;

	memset(box, -1, sizeof(box));
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++, cell++) {
			struct network_element *element = &out->element[count];

			if (cell->word == ELEM_PIN) {
				if (box[col] >= 0 && cell->operand)
					out->element[box[col]].pins++;
				continue;
			}
			box[col] = -1;
			if (cell->word == ELEM_EMPTY || cell->word == ELEM_WIRE)
				continue;
			element->row = (uint16_t)row;
			element->col = (uint16_t)col;
			element->word = cell->word;
			element->in = network_net(out, row, col);
			element->out = network_net(out, row, col + 1);
			if (is_box((enum word)cell->word))
				box[col] = count;
			count++;
		}
}

/* Stores the pins of each box together, top first. */
static void list_pins(const struct rung *rung, struct network *out)
{
	int count = 0;

	for (int i = 0; i < out->element_count; i++) {
		struct network_element *element = &out->element[i];
		int row = element->row + 1, left = element->pins;

		element->first_pin = count;
		for (; left; row++) {
			const struct cell *cell =
				rung_at(rung, row, element->col);
			struct network_pin *pin = &out->pin[count];

			if (!cell->operand)
				continue;
			pin->row = (uint16_t)row;
			pin->col = element->col;
			pin->operand = cell->operand;
			pin->in = network_net(out, row, element->col);
			count++;
			left--;
		}
	}
	out->pin_count = count;
}

/* A counting sort by net keeps the reading order. */
static void list_feeders(struct network *out)
{
	int *first = out->first_feeder;

	for (int i = 0; i < out->element_count; i++) {
		first[out->element[i].out + 1]++;
		out->reader_count[out->element[i].in]++;
	}
	for (int i = 0; i < out->pin_count; i++)
		out->reader_count[out->pin[i].in]++;
	for (int net = 0; net < out->net_count; net++)
		first[net + 1] += first[net];
	for (int i = out->element_count; i-- > 0;)
		out->feeder[--first[out->element[i].out + 1]] = i;
	/* Each entry was counted down to the begin of its net: shift back by one. */
	for (int net = 0; net < out->net_count; net++)
		first[net] = first[net + 1];
	first[out->net_count] = out->element_count;
}

static void *make(struct arena *arena, int count, size_t size)
{
	return arena_alloc(arena, (size_t)count * size);
}

bool network_make(const struct rung *rung, struct arena *arena,
		  struct network *out)
{
	int bars = rung->rows * (rung->cols + 1);

	*out = (struct network){ .rows = rung->rows, .cols = rung->cols };
	out->bar_net = make(arena, bars, sizeof(int));
	if (!out->bar_net)
		return false;
	join_bars(rung, out);
	number_nets(out);
	out->element = make(arena, out->element_count, sizeof(*out->element));
	out->pin = make(arena, out->pin_count, sizeof(*out->pin));
	out->first_feeder = make(arena, out->net_count + 1, sizeof(int));
	out->feeder = make(arena, out->element_count, sizeof(int));
	out->reader_count = make(arena, out->net_count, sizeof(int));
	if (!out->element || !out->pin || !out->first_feeder || !out->feeder ||
	    !out->reader_count)
		return false;
	list_elements(rung, out);
	list_pins(rung, out);
	list_feeders(out);
	return true;
}

int network_net(const struct network *network, int row, int bar)
{
	return network->bar_net[row * (network->cols + 1) + bar];
}
