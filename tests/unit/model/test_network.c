/* SPDX-License-Identifier: MIT
 *
 * test_network - nets, elements, pins, feeders and readers of drawn rungs, and of
 * the largest there are.
 */
#include "engine/model/network.h"
#include "tests/tap.h"

static struct arena arena;
static struct network network;

/* Two characters a cell: element and link. - wire, . empty, p pin with operand,
 * , pin without, B box, C coil, other letters contacts. Rows end with a slash. */
static enum word word_of(char c)
{
	switch (c) {
	case '-':
		return ELEM_WIRE;
	case '.':
		return ELEM_EMPTY;
	case 'p':
	case ',':
		return ELEM_PIN;
	case 'B':
		return FB_CTU;
	case 'X':
		return ELEM_COMPARE;
	case 'C':
		return ELEM_COIL;
	default:
		return ELEM_CONTACT_NO;
	}
}

static bool make(const char *drawing)
{
	int cols = (int)(strchr(drawing, '/') - drawing) / 2, rows = 0;
	struct rung *rung;
	bool made;

	for (const char *at = drawing; *at; at++)
		rows += *at == '/';
	rung = rung_new(rows, cols);
	for (int i = 0; i < rows * cols; i++) {
		const char *at = drawing + i / cols * (2 * cols + 1) +
				 i % cols * 2;

		rung->cell[i].word = (uint16_t)word_of(at[0]);
		rung->cell[i].link = at[1] == '^';
		rung->cell[i].operand = at[0] == ',' ? 0 : (uint32_t)at[0];
	}
	arena_reset(&arena);
	made = network_make(rung, &arena, &network);
	rung_free(rung);
	return made;
}

/* The net of each bar, one row after another. */
static const char *nets(const char *drawing)
{
	static char out[400];
	size_t used = 0;

	if (!make(drawing))
		return "failed";
	for (int row = 0; row < network.rows; row++) {
		for (int bar = 0; bar <= network.cols; bar++)
			used += (size_t)snprintf(out + used, sizeof(out) - used,
						 "%d",
						 network_net(&network, row, bar));
		used += (size_t)snprintf(out + used, sizeof(out) - used, "/");
	}
	return out;
}

static void numbers_nets(void)
{
	CHECK_TEXT(nets("a C /"), "012/");
	CHECK_TEXT(nets("- - C /"), "0001/");
	CHECK_TEXT(nets("a b C /c^. . /"), "0123/0145/");
	CHECK_TEXT(nets("a - C /c .^. /"), "0112/0314/");
	CHECK_TEXT(nets("a b C /.^c^. /"), "0123/0124/");
	CHECK_TEXT(nets("a b /c d /e^f^/"), "012/034/034/");
	CHECK_TEXT(nets("a^C /"), "012/");
	CHECK_TEXT(nets("-^a /-^b /"), "001/002/");
	CHECK_TEXT(nets("a - - /b .^. /c - -^/"), "0111/0213/0333/");
	CHECK_TEXT(nets("a b c /d .^-^/"), "0122/0322/");
	CHECK_TEXT(nets(". . /"), "012/");
	CHECK(network.net_count == 3 && network.element_count == 0);
	CHECK_TEXT(nets(". . /-^-^/"), "000/000/");
	CHECK_AS(network.net_count == 1, "a row of wires is one net with the rail");
}

static void lists_elements(void)
{
	const struct network_element *element;

	CHECK(make("a b C /.^c^. /"));
	CHECK(network.element_count == 4 && network.net_count == 5);
	element = network.element;
	CHECK(element[0].word == ELEM_CONTACT_NO && element[0].in == NET_RAIL &&
	      element[0].out == 1);
	CHECK(element[2].word == ELEM_COIL && element[2].row == 0 &&
	      element[2].col == 2 && element[2].in == 2 && element[2].out == 3);
	CHECK(element[3].row == 1 && element[3].col == 1 &&
	      element[3].in == 1 && element[3].out == 2);
	CHECK(network.reader_count[0] == 1);
	CHECK(network.reader_count[1] == 2);
	CHECK(network.reader_count[2] == 1);
	CHECK(network.reader_count[3] == 0);
	CHECK(network.first_feeder[0] == 0 && network.first_feeder[1] == 0);
	CHECK(network.first_feeder[2] == 1 && network.feeder[0] == 0);
	CHECK(network.first_feeder[3] == 3);
	CHECK_AS(network.feeder[1] == 1 && network.feeder[2] == 3,
		 "the feeders of a net are in reading order");
	CHECK(network.first_feeder[4] == 4 && network.first_feeder[5] == 4);
	CHECK(network.feeder[3] == 2);
}

static void finds_pins(void)
{
	CHECK(make("a B C /b p . /. , . /d p . /"));
	CHECK(network.element_count == 5 && network.pin_count == 2);
	CHECK(network.element[1].word == FB_CTU);
	CHECK(network.element[1].pins == 2 && network.element[1].first_pin == 0);
	CHECK(network.pin[0].row == 1 && network.pin[0].col == 1 &&
	      network.pin[0].operand == 'p');
	CHECK(network.pin[0].in == network_net(&network, 1, 1));
	CHECK(network.pin[1].row == 3);
	CHECK(network.pin[1].in == network_net(&network, 3, 1));
	CHECK(network.reader_count[network.pin[1].in] == 1);
	CHECK(make("B B /p p /p , /"));
	CHECK(network.pin_count == 3);
	CHECK(network.element[0].first_pin == 0 && network.element[0].pins == 2);
	CHECK_AS(network.pin[1].row == 2 && network.pin[1].col == 0,
		 "the pins of a box are listed together");
	CHECK(network.element[1].first_pin == 2 && network.element[1].pins == 1);
	CHECK(network.pin[0].in == NET_RAIL);
	CHECK_AS(network.reader_count[NET_RAIL] == 3,
		 "the rail feeds the box and its two pins");
	CHECK(make("X /p /"));
	CHECK(network.pin_count == 1);
	CHECK(make("p a B B B /p p . - a /. . p p p /"));
	CHECK_AS(network.pin_count == 0, "pins without a box are not listed");
	CHECK(network.element_count == 5);
}

/* Each element feeds its own net once, and the counts add up. */
static bool is_whole(void)
{
	int readers = 0, wrong = 0;

	for (int net = 0; net < network.net_count; net++) {
		int first = network.first_feeder[net];
		int end = network.first_feeder[net + 1];

		readers += network.reader_count[net];
		for (int i = first; i < end; i++) {
			wrong += network.element[network.feeder[i]].out != net;
			wrong += i > first &&
				 network.feeder[i] <= network.feeder[i - 1];
		}
	}
	return wrong == 0 &&
	       readers == network.element_count + network.pin_count &&
	       network.first_feeder[network.net_count] == network.element_count;
}

static void largest(void)
{
	struct rung *rung = rung_new(LIMIT_ROWS, LIMIT_COLS);
	int cells = LIMIT_ROWS * LIMIT_COLS;

	for (int i = 0; i < cells; i++)
		rung->cell[i] = (struct cell){ .word = ELEM_CONTACT_NO,
					       .link = 1 };
	arena_reset(&arena);
	CHECK(network_make(rung, &arena, &network));
	CHECK(network.net_count == LIMIT_COLS + 1);
	CHECK(network.element_count == cells && is_whole());
	for (int i = 0; i < cells; i++)
		rung->cell[i].link = 0;
	arena_reset(&arena);
	CHECK(network_make(rung, &arena, &network));
	CHECK(network.net_count == cells + 1 && is_whole());
	for (int i = 0; i < cells; i++)
		rung->cell[i].word = i < LIMIT_COLS ? FN_ADD : ELEM_PIN;
	for (int i = 0; i < cells; i++)
		rung->cell[i].operand = 1;
	arena_reset(&arena);
	CHECK(network_make(rung, &arena, &network));
	CHECK(network.pin_count == cells - LIMIT_COLS && is_whole());
	CHECK(network.element[LIMIT_COLS - 1].pins == LIMIT_ROWS - 1);
	for (int i = 0; i < cells; i++)
		rung->cell[i].word = ELEM_WIRE;
	arena_reset(&arena);
	CHECK(network_make(rung, &arena, &network));
	CHECK(network.net_count == 1 && is_whole());
	rung_free(rung);
	rung = rung_new(1, 1);
	CHECK(network_make(rung, &arena, &network));
	CHECK(network.net_count == 2 && is_whole());
	rung_free(rung);
}

/* Two bars have one net exactly when wires and links lead from one to the other:
 * compared with labels spread until nothing changes. */
static void random_rungs(void)
{
	static const enum word some[] = {
		ELEM_EMPTY, ELEM_WIRE, ELEM_CONTACT_NO, ELEM_COIL, FB_TON,
		ELEM_PIN, ELEM_WIRE,
	};
	uint32_t seed = 1;
	int wrong = 0;

	for (int round = 0; round < 300; round++) {
		struct rung *rung = rung_new(1 + round % 7, 1 + round % 5);
		int width = rung->cols + 1, bars = rung->rows * width;
		int label[64];
		bool changed = true;

		for (int i = 0; i < rung->rows * rung->cols; i++) {
			seed = seed * 1664525u + 1013904223u;
			rung->cell[i].word =
				(uint16_t)some[(seed >> 16) % 7];
			rung->cell[i].link = seed >> 28 & 1;
			rung->cell[i].operand = seed >> 30;
		}
		for (int i = 0; i < bars; i++)
			label[i] = i % width ? i : 0;
		while (changed) {
			changed = false;
			for (int i = 0; i < bars; i++) {
				const struct cell *cell;
				int other[2] = { i, i }, low = label[i];

				if (i % width == 0)
					continue;
				cell = rung_at(rung, i / width, i % width - 1);
				if (cell->word == ELEM_WIRE)
					other[0] = i - 1;
				if (cell->link && i >= width)
					other[1] = i - width;
				for (int k = 0; k < 2; k++)
					if (label[other[k]] < low)
						low = label[other[k]];
				for (int k = 0; k < 2; k++) {
					changed |= label[other[k]] != low;
					label[other[k]] = low;
				}
				changed |= label[i] != low;
				label[i] = low;
			}
		}
		arena_reset(&arena);
		wrong += !network_make(rung, &arena, &network) || !is_whole();
		for (int i = 0; i < bars; i++)
			for (int k = 0; k < i; k++)
				wrong += (label[i] == label[k]) !=
					 (network.bar_net[i] ==
					  network.bar_net[k]);
		rung_free(rung);
	}
	CHECK(wrong == 0);
}

static void out_of_memory(void)
{
	struct rung *rung = rung_new(2, 2);

	arena.failed = true;
	CHECK(!network_make(rung, &arena, &network));
	arena.failed = false;
	rung_free(rung);
}

int main(void)
{
	arena_init(&arena);
	numbers_nets();
	lists_elements();
	finds_pins();
	largest();
	random_rungs();
	out_of_memory();
	arena_free(&arena);
	return tap_done();
}
