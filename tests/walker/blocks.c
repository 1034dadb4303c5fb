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

static int64_t get(const struct block *block, const char *name)
{
	return block->pin[block_pin(block, name)].i;
}

static void set(struct block *block, const char *name, int64_t value)
{
	block->pin[block_pin(block, name)].i = value;
}

/* A level that was FALSE in the call before. */
static bool rises(bool now, bool *was)
{
	bool rising = now && !*was;

	*was = now;
	return rising;
}

/* A time before now cannot be waited for. */
static int64_t preset(const struct block *block)
{
	return get(block, "PT") > 0 ? get(block, "PT") : 0;
}

static void call_ton(struct block *block, int64_t now_ns)
{
	int64_t pt = preset(block), et;

	if (!get(block, "IN")) {
		block->busy = false;
		set(block, "Q", 0);
		set(block, "ET", 0);
		return;
	}
	if (!block->busy) {
		block->busy = true;
		block->start_ns = now_ns;
	}
	et = now_ns - block->start_ns;
	set(block, "Q", et >= pt);
	set(block, "ET", et >= pt ? pt : et);
}

static void call_tof(struct block *block, int64_t now_ns)
{
	int64_t pt = preset(block), et;
	bool in = get(block, "IN");

	if (in) {
		block->busy = false;
		set(block, "Q", 1);
		set(block, "ET", 0);
	} else if (block->was) {
		block->busy = true;
		block->start_ns = now_ns;
	}
	if (!in && block->busy) {
		et = now_ns - block->start_ns;
		set(block, "Q", et < pt);
		set(block, "ET", et < pt ? et : pt);
		if (et >= pt)
			block->busy = false;
	}
	block->was = in;
}

static void call_tp(struct block *block, int64_t now_ns)
{
	int64_t pt = preset(block), et;
	bool in = get(block, "IN");

	if (!block->busy && !block->spent && in) {
		block->busy = true;
		block->start_ns = now_ns;
	}
	if (block->busy) {
		et = now_ns - block->start_ns;
		set(block, "Q", et < pt);
		set(block, "ET", et < pt ? et : pt);
		if (et >= pt) {
			block->busy = false;
			block->spent = true;
		}
	}
	if (!block->busy && !in) {
		block->spent = false;
		set(block, "ET", 0);
	}
}

static void call_ctu(struct block *block)
{
	bool up = rises(get(block, "CU"), &block->was);

	if (get(block, "R"))
		set(block, "CV", 0);
	else if (up && get(block, "CV") < INT16_MAX)
		set(block, "CV", get(block, "CV") + 1);
	set(block, "Q", get(block, "CV") >= get(block, "PV"));
}

static void call_ctd(struct block *block)
{
	bool down = rises(get(block, "CD"), &block->was);

	if (get(block, "LD"))
		set(block, "CV", get(block, "PV"));
	else if (down && get(block, "CV") > INT16_MIN)
		set(block, "CV", get(block, "CV") - 1);
	set(block, "Q", get(block, "CV") <= 0);
}

static void call_ctud(struct block *block)
{
	bool up = rises(get(block, "CU"), &block->was);
	bool down = rises(get(block, "CD"), &block->was_too);
	int64_t cv = get(block, "CV");

	if (get(block, "R"))
		cv = 0;
	else if (get(block, "LD"))
		cv = get(block, "PV");
	else if (up && !down && cv < INT16_MAX)
		cv++;
	else if (down && !up && cv > INT16_MIN)
		cv--;
	set(block, "CV", cv);
	set(block, "QU", cv >= get(block, "PV"));
	set(block, "QD", cv <= 0);
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
	else if (strcmp(word, "CTU") == 0)
		call_ctu(block);
	else if (strcmp(word, "CTD") == 0)
		call_ctd(block);
	else if (strcmp(word, "CTUD") == 0)
		call_ctud(block);
	else if (strcmp(word, "SR") == 0)
		set(block, "Q1", get(block, "S1") ||
		    (get(block, "Q1") && !get(block, "R")));
	else if (strcmp(word, "RS") == 0)
		set(block, "Q1", !get(block, "R1") &&
		    (get(block, "S") || get(block, "Q1")));
	else if (strcmp(word, "R_TRIG") == 0)
		set(block, "Q", rises(get(block, "CLK"), &block->was));
	else if (strcmp(word, "F_TRIG") == 0) {
		set(block, "Q", block->was && !get(block, "CLK"));
		block->was = get(block, "CLK");
	}
}
