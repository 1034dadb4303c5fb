/* SPDX-License-Identifier: MIT
 *
 * blocks - the walker's own function blocks (docs/language.md).
 *
 * One function a block, on pins found by name. Written from the standard's
 * tables and the language document, not from the engine.
 */
#include "tests/walker/inside.h"

#include <string.h>
#include <strings.h>

int block_pin(const struct block *block, const char *name)
{
	const struct word_row *row = word_row(block->fb);

	for (int i = 0; i < row->pin_count; i++)
		if (strcasecmp(row->pin[i].name, name) == 0)
			return i;
	return -1;
}

int64_t block_get(const struct block *block, const char *name)
{
	return block->pin[block_pin(block, name)].i;
}

void block_set(struct block *block, const char *name, int64_t value)
{
	block->pin[block_pin(block, name)].i = value;
}

/* Whether the level was FALSE in the previous call. */
bool block_rises(bool now, bool *was)
{
	bool rising = now && !*was;

	*was = now;
	return rising;
}

/* A negative time counts as 0. */
static int64_t preset(const struct block *block)
{
	return block_get(block, "PT") > 0 ? block_get(block, "PT") : 0;
}

static void call_ton(struct block *block, int64_t now_ns)
{
	int64_t pt = preset(block), et;

	if (!block_get(block, "IN")) {
		block->busy = false;
		block_set(block, "Q", 0);
		block_set(block, "ET", 0);
		return;
	}
	if (!block->busy) {
		block->busy = true;
		block->start_ns = now_ns;
	}
	et = now_ns - block->start_ns;
	block_set(block, "Q", et >= pt);
	block_set(block, "ET", et >= pt ? pt : et);
}

static void call_tof(struct block *block, int64_t now_ns)
{
	int64_t pt = preset(block), et;
	bool in = block_get(block, "IN");

	if (in) {
		block->busy = false;
		block_set(block, "Q", 1);
		block_set(block, "ET", 0);
	} else if (block->was) {
		block->busy = true;
		block->start_ns = now_ns;
	}
	if (!in && block->busy) {
		et = now_ns - block->start_ns;
		block_set(block, "Q", et < pt);
		block_set(block, "ET", et < pt ? et : pt);
		if (et >= pt)
			block->busy = false;
	}
	block->was = in;
}

static void call_tp(struct block *block, int64_t now_ns)
{
	int64_t pt = preset(block), et;
	bool in = block_get(block, "IN");

	if (!block->busy && !block->spent && in) {
		block->busy = true;
		block->start_ns = now_ns;
	}
	if (block->busy) {
		et = now_ns - block->start_ns;
		block_set(block, "Q", et < pt);
		block_set(block, "ET", et < pt ? et : pt);
		if (et >= pt) {
			block->busy = false;
			block->spent = true;
		}
	}
	if (!block->busy && !in) {
		block->spent = false;
		block_set(block, "ET", 0);
	}
}

/* Whether @a is below @b in the type of CV. */
static bool is_below(const struct block *block, int64_t a, int64_t b)
{
	if (block->pin[block_pin(block, "CV")].type == IEC_ULINT)
		return (uint64_t)a < (uint64_t)b;
	return a < b;
}

/* One more or one less, up to the limit of CV's type. */
static int64_t counted(const struct block *block, bool up)
{
	enum iec_type type = block->pin[block_pin(block, "CV")].type;
	int64_t cv = block_get(block, "CV");
	int64_t end = up ? iec_type_row(type)->high : iec_type_row(type)->low;

	if (type == IEC_ULINT)
		end = up ? -1 : 0;
	return cv == end ? cv : (int64_t)((uint64_t)cv + (up ? 1u : UINT64_MAX));
}

static void call_counter(struct block *block, bool has_up, bool has_down)
{
	bool up = has_up && block_rises(block_get(block, "CU"), &block->was);
	bool down = has_down && block_rises(block_get(block, "CD"), &block->was_too);

	if (has_up && block_get(block, "R"))
		block_set(block, "CV", 0);
	else if (has_down && block_get(block, "LD"))
		block_set(block, "CV", block_get(block, "PV"));
	else if (up != down)
		block_set(block, "CV", counted(block, up));
	if (has_up)
		block_set(block, has_down ? "QU" : "Q",
			  !is_below(block, block_get(block, "CV"),
				    block_get(block, "PV")));
	if (has_down)
		block_set(block, has_up ? "QD" : "Q",
			  !is_below(block, 0, block_get(block, "CV")));
}

void block_call(struct block *block, int64_t now_ns)
{
	const char *word = word_row(block->fb)->word;

	if (strcmp(word, "TON") == 0)
		call_ton(block, now_ns);
	else if (strcmp(word, "TOF") == 0)
		call_tof(block, now_ns);
	else if (strcmp(word, "TP") == 0)
		call_tp(block, now_ns);
	else if (strncmp(word, "CTUD", 4) == 0)
		call_counter(block, true, true);
	else if (strncmp(word, "CTU", 3) == 0)
		call_counter(block, true, false);
	else if (strncmp(word, "CTD", 3) == 0)
		call_counter(block, false, true);
	else if (strcmp(word, "SR") == 0)
		block_set(block, "Q1", block_get(block, "S1") ||
		    (block_get(block, "Q1") && !block_get(block, "R")));
	else if (strcmp(word, "RS") == 0)
		block_set(block, "Q1", !block_get(block, "R1") &&
		    (block_get(block, "S") || block_get(block, "Q1")));
	else if (strcmp(word, "R_TRIG") == 0)
		block_set(block, "Q", block_rises(block_get(block, "CLK"), &block->was));
	else if (strcmp(word, "F_TRIG") == 0) {
		block_set(block, "Q", block->was && !block_get(block, "CLK"));
		block->was = block_get(block, "CLK");
	} else {
		block_call_more(block, now_ns);
	}
}
