/* SPDX-License-Identifier: MIT
 *
 * test_sfc_layout - thousands of random charts, valid and invalid: nothing crosses,
 * nothing overlaps, and the lines of the drawing connect what the chart connects.
 */
#include "engine/show/sfc_layout.h"
#include "tests/tap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST = 5000 };

static struct sfc_step steps[MOST];
static struct sfc_transition transitions[MOST];
static struct sfc_ref refs[8 * MOST];
static struct sfc_use uses[MOST];
static struct sfc sfc = { .step = steps, .transition = transitions, .ref = refs,
			    .use = uses };

/* ---- charts ---- */

static void clear(void)
{
	sfc.step_count = sfc.transition_count = sfc.ref_count = sfc.use_count = 0;
}

static int step(enum step_kind kind, int macro)
{
	steps[sfc.step_count] = (struct sfc_step){ .kind = kind, .macro = macro,
		.name = (uint32_t)sfc.step_count + 1 };
	return sfc.step_count++;
}

static void ref(int to)
{
	refs[sfc.ref_count++] = (struct sfc_ref){ .name = (uint32_t)to + 1,
						    .step = to };
}

static int way(int macro)
{
	transitions[sfc.transition_count] = (struct sfc_transition){ .macro = macro,
		.first_from = sfc.ref_count, .first_to = sfc.ref_count };
	return sfc.transition_count++;
}

static void from(int to)
{
	struct sfc_transition *t = &transitions[sfc.transition_count - 1];

	ref(to);
	t->from_count++;
	t->first_to = sfc.ref_count;
}

static void to(int to)
{
	ref(to);
	transitions[sfc.transition_count - 1].to_count++;
}

static void lead(int a, int b)
{
	way(steps[a].macro);
	from(a);
	to(b);
}

/* ---- rules for every layout ---- */

static const char *wrong;

static bool covers(const struct sfc_wire *wire, int lane, int row)
{
	return lane >= wire->lane && lane <= wire->end_lane && row >= wire->row &&
	       row <= wire->end_row;
}

static bool is_down(const struct sfc_wire *wire)
{
	return wire->lane == wire->end_lane;
}

/* The number of the shape at a place; -1: none. */
static int shape_at(const struct sfc_layout *layout, int lane, int row)
{
	for (int i = 0; i < layout->shape_count; i++)
		if (layout->shape[i].lane == lane && layout->shape[i].top <= row &&
		    layout->shape[i].bottom >= row)
			return i;
	return -1;
}

/* Boxes do not overlap; lines touch them only at their edges in their lane. */
static void check_boxes(const struct sfc_layout *layout)
{
	for (int i = 0; i < layout->shape_count; i++) {
		const struct sfc_shape *a = &layout->shape[i];

		if (a->lane < 0 || a->lane >= layout->lanes || a->top < 0 ||
		    a->bottom < a->top || a->bottom >= layout->rows)
			wrong = "a box lies outside the layout";
		if (shape_at(layout, a->lane, a->top) != i ||
		    shape_at(layout, a->lane, a->bottom) != i)
			wrong = "a box is not found at its place";
		for (int k = 0; k < i; k++) {
			const struct sfc_shape *b = &layout->shape[k];

			if (a->lane == b->lane && a->top <= b->bottom &&
			    b->top <= a->bottom)
				wrong = "boxes overlap";
		}
		for (int k = 0; k < layout->wire_count; k++) {
			const struct sfc_wire *wire = &layout->wire[k];

			if (a->lane < wire->lane || a->lane > wire->end_lane ||
			    wire->row > a->bottom || wire->end_row < a->top)
				continue;
			if (!is_down(wire) ||
			    (wire->end_row != a->top && wire->row != a->bottom))
				wrong = "a line crosses a box";
		}
	}
}

static void check_wires(const struct sfc_layout *layout)
{
	for (int i = 0; i < layout->wire_count; i++) {
		const struct sfc_wire *a = &layout->wire[i];

		if (a->end_row < a->row || a->end_lane < a->lane ||
		    (a->row != a->end_row && a->lane != a->end_lane))
			wrong = "a line has a negative size or is slanted";
		for (int k = 0; k < layout->wire_count; k++) {
			const struct sfc_wire *b = &layout->wire[k];

			if (i == k || a->lane > b->end_lane || b->lane > a->end_lane ||
			    a->row > b->end_row || b->row > a->end_row)
				continue;
			/* Two lines down may touch only at their ends. */
			if (!is_down(a) && !is_down(b))
				wrong = "two horizontal lines overlap";
			else if (is_down(a) && is_down(b) && a->end_row != b->row &&
				 b->end_row != a->row)
				wrong = "two vertical lines overlap";
			else if (is_down(a) && !is_down(b) && b->row != a->row &&
				 b->row != a->end_row)
				wrong = "two lines cross";
		}
	}
}

/* Adds the shapes that the lines from (lane, row) lead to. */
static int found[MOST], found_count;
static bool through[8 * MOST];

static void walk(const struct sfc_layout *layout, int lane, int row)
{
	static struct { int lane, row; } stack[8 * MOST];
	int depth = 0;

	found_count = 0;
	memset(through, 0, (size_t)layout->wire_count + 1);
	stack[depth].lane = lane;
	stack[depth++].row = row;
	while (depth > 0) {
		lane = stack[--depth].lane;
		row = stack[depth].row;
		for (int i = 0; i < layout->wire_count; i++) {
			const struct sfc_wire *wire = &layout->wire[i];
			int at;

			if (through[i] || !covers(wire, lane, row) ||
			    (is_down(wire) && wire->row != row))
				continue;
			through[i] = true;
			if (!is_down(wire)) {
				for (int l = wire->lane; l <= wire->end_lane; l++) {
					stack[depth].lane = l;
					stack[depth++].row = row;
				}
				continue;
			}
			at = shape_at(layout, lane, wire->end_row);
			if (at >= 0) {
				found[found_count++] = at;
			} else {
				stack[depth].lane = lane;
				stack[depth++].row = wire->end_row;
			}
		}
	}
}

/* Whether shape @at is the end of the line of @r. */
static bool is_end(const struct sfc_layout *layout, int at, int r, bool down_to_step,
		   int transition)
{
	const struct sfc_shape *shape = &layout->shape[at];

	if (shape->part == SFC_JUMP)
		return layout->jump[shape->index].ref == r;
	if (layout->apart[r])
		return false;
	return down_to_step ? shape->part == SFC_STEP && shape->index == refs[r].step :
			      shape->part == SFC_TRANSITION && shape->index == transition;
}

static bool is_found(const struct sfc_layout *layout, int r, bool down, int transition)
{
	for (int i = 0; i < found_count; i++)
		if (is_end(layout, found[i], r, down, transition))
			return true;
	return false;
}

/* Whether the list names this step earlier. */
static bool is_again(int first, int r)
{
	for (int i = first; i < r; i++)
		if (refs[i].step == refs[r].step && refs[r].step >= 0)
			return true;
	return false;
}

static void check_transition(const struct sfc_layout *layout, int t)
{
	const struct sfc_shape *shape = &layout->shape[layout->sfc->step_count + t];
	const struct sfc_transition *transition = &transitions[t];
	int wanted = 0;

	if (shape->part != SFC_TRANSITION || shape->index != t)
		wrong = "a transition has the box of another one";
	walk(layout, shape->lane, shape->bottom);
	for (int i = 0; i < transition->to_count; i++) {
		int r = transition->first_to + i;

		if (is_again(transition->first_to, r))
			continue;
		wanted++;
		if (!is_found(layout, r, true, t))
			wrong = "a transition does not lead to its step";
	}
	if (found_count != wanted)
		wrong = "a transition leads to a wrong number of steps";
}

static void check_step(const struct sfc_layout *layout, int s)
{
	const struct sfc_shape *shape = sfc_layout_step(layout, s);
	int wanted = 0;

	if (shape->part != SFC_STEP || shape->index != s ||
	    shape->bottom - shape->top - 1 != sfc_step_rows(&sfc, s))
		wrong = "a step has the box of another one";
	walk(layout, shape->lane, shape->bottom);
	for (int t = 0; t < sfc.transition_count; t++) {
		const struct sfc_transition *transition = &transitions[t];

		for (int i = 0; i < transition->from_count; i++) {
			int r = transition->first_from + i;

			if (refs[r].step != s || is_again(transition->first_from, r) ||
			    steps[s].macro != transition->macro)
				continue;
			wanted++;
			if (!is_found(layout, r, false, t))
				wrong = "a step does not lead to its transition";
		}
	}
	if (found_count != wanted)
		wrong = "a step leads to a wrong number of transitions";
}

static bool is_good(void)
{
	struct sfc_layout *layout = sfc_layout_new(&sfc);

	wrong = layout ? NULL : "no memory";
	if (!layout)
		return false;
	if (layout->shape_count != sfc.step_count + sfc.transition_count +
				   layout->jump_count)
		wrong = "the number of boxes is wrong";
	check_boxes(layout);
	check_wires(layout);
	for (int i = 0; i < sfc.transition_count; i++)
		check_transition(layout, i);
	for (int i = 0; i < sfc.step_count; i++)
		check_step(layout, i);
	sfc_layout_free(layout);
	return !wrong;
}

/* ---- random charts ---- */

static uint32_t seed;

static int below(int count)
{
	seed = seed * 1664525u + 1013904223u;
	return count > 0 ? (int)((seed >> 8) % (uint32_t)count) : 0;
}

/* A typical chart: sequences and branches of both kinds, nested. */
static int grow(int at, int depth, int macro)
{
	int count = 1 + below(3), next;

	for (int i = 0; i < count; i++) {
		int kind = depth > 0 ? below(4) : 0;

		if (kind == 0 || kind == 3) {
			next = step(STEP_PLAIN, macro);
			steps[next].column = below(20) == 0 ? 1 + below(6) : 0;
			lead(at, next);
			if (below(5) == 0)
				lead(at, below(sfc.step_count));
			at = next;
		} else if (kind == 1) {
			int end[4], ways = 2 + below(3), last;

			for (int k = 0; k < ways; k++) {
				next = step(STEP_PLAIN, macro);
				lead(at, next);
				end[k] = grow(next, depth - 1, macro);
			}
			last = step(STEP_PLAIN, macro);
			for (int k = 0; k < ways; k++)
				if (below(5))
					lead(end[k], last);
				else
					lead(end[k], below(sfc.step_count));
			at = last;
		} else {
			int begin[4], end[4], ways = 2 + below(3);

			way(macro);
			from(at);
			for (int k = 0; k < ways; k++)
				to(begin[k] = step(STEP_PLAIN, macro));
			for (int k = 0; k < ways; k++)
				end[k] = grow(begin[k], depth - 1, macro);
			next = step(STEP_PLAIN, macro);
			way(macro);
			for (int k = 0; k < ways; k++)
				from(end[k]);
			to(next);
			at = next;
		}
	}
	return at;
}

static void random_sfc(uint32_t number)
{
	int first;

	seed = number;
	clear();
	first = step(STEP_INITIAL, -1);
	lead(grow(first, 1 + below(3), -1), first);
	for (int i = below(3); i > 0; i--) {
		int macro = below(sfc.step_count);

		steps[macro].kind = STEP_MACRO;
		grow(step(STEP_INITIAL, macro), 1, macro);
	}
	for (int i = 0; i < sfc.transition_count; i++)
		transitions[i].priority = below(4);
}

static void random_garbage(uint32_t number)
{
	int count, ways;

	seed = number;
	clear();
	count = below(24);
	ways = below(40);
	for (int i = 0; i < count; i++) {
		step((enum step_kind)below(3), below(6) ? -1 : below(count + 2) - 1);
		steps[i].column = below(3) ? 0 : below(200) - 20;
		steps[i].min = (uint32_t)below(2);
	}
	for (int i = 0; i < ways; i++) {
		way(below(6) ? -1 : below(count) - (count == 0));
		for (int k = below(below(4) ? 3 : 6); k > 0; k--)
			from(below(count + 1) - 1);
		for (int k = below(below(4) ? 3 : 6); k > 0; k--)
			to(below(count + 1) - 1);
		transitions[i].priority = below(5) - 1;
	}
	for (int i = 0; i < count; i++)
		steps[i].macro = steps[i].macro >= count ? -1 : steps[i].macro;
}

static void check_many(void (*make)(uint32_t number), int count, const char *what)
{
	int bad = 0, jumps = 0, most = 0;

	for (int i = 1; i <= count; i++) {
		make((uint32_t)i);
		if (!is_good() && bad++ == 0)
			printf("# %s %d: %s\n", what, i, wrong);
		jumps += sfc.ref_count > 0;
		most = sfc.step_count > most ? sfc.step_count : most;
	}
	printf("# %s: %d, of up to %d steps\n", what, count, most);
	CHECK_AS(bad == 0 && jumps > count / 2, what);
}

/* ---- fixed charts ---- */

static void check_sequence(void)
{
	struct sfc_layout *layout;

	clear();
	step(STEP_INITIAL, -1);
	step(STEP_PLAIN, -1);
	step(STEP_PLAIN, -1);
	lead(0, 1);
	lead(1, 2);
	lead(2, 0);
	steps[1].use_count = 3;
	CHECK(is_good());
	layout = sfc_layout_new(&sfc);
	CHECK(layout && layout->lanes == 1 && layout->jump_count == 1);
	CHECK(layout && layout->shape[1].top == 4 && layout->shape[1].bottom == 8);
	CHECK(layout && layout->jump[0].from == 2 && layout->jump[0].target == 0 &&
	      !layout->jump[0].to_transition);
	CHECK(layout && shape_at(layout, 0, 3) == 3 &&
	      shape_at(layout, 1, 3) == -1 && shape_at(layout, 0, 99) == -1);
	sfc_layout_free(layout);
}

/* From S2 to S3 or S4, both to S5; from there S6 and S7 together, to S8. */
static void check_reference(void)
{
	struct sfc_layout *layout;

	clear();
	for (int i = 0; i < 9; i++)
		step(i ? STEP_PLAIN : STEP_INITIAL, -1);
	lead(0, 1);
	lead(1, 2);
	lead(2, 3);
	lead(2, 4);
	lead(3, 5);
	lead(4, 5);
	way(-1);
	from(5);
	to(6);
	to(7);
	way(-1);
	from(6);
	from(7);
	to(8);
	lead(8, 0);
	CHECK(is_good());
	layout = sfc_layout_new(&sfc);
	CHECK(layout && layout->lanes == 2 && layout->jump_count == 1 &&
	      layout->frame_count == 1);
	CHECK(layout && layout->shape[3].lane == 0 && layout->shape[4].lane == 1 &&
	      layout->shape[3].top == layout->shape[4].top);
	CHECK(layout && layout->shape[6].lane == 0 && layout->shape[7].lane == 1);
	int twins = 0;
	for (int i = 0; layout && i < layout->wire_count; i++)
		twins += layout->wire[i].twin;
	CHECK(twins == 2);
	sfc_layout_free(layout);
	steps[4].column = 4;
	layout = sfc_layout_new(&sfc);
	CHECK_AS(layout && layout->shape[4].lane == 3,
		 "the given column of a step is used");
	sfc_layout_free(layout);
	steps[4].column = 0;
}

/* Sixty steps, each with an exit, need two lanes. */
static void check_narrow(bool first)
{
	struct sfc_layout *layout;

	clear();
	for (int i = 0; i < 60; i++)
		step(i ? STEP_PLAIN : STEP_INITIAL, -1);
	for (int i = 0; i < 60; i++) {
		lead(i, first ? 0 : (i + 1) % 60);
		lead(i, first ? (i + 1) % 60 : 0);
	}
	CHECK(is_good());
	layout = sfc_layout_new(&sfc);
	CHECK(layout && layout->lanes == 2 && layout->jump_count == 61);
	sfc_layout_free(layout);
}

static void check_macro(void)
{
	struct sfc_layout *layout;

	clear();
	step(STEP_INITIAL, -1);
	step(STEP_MACRO, -1);
	step(STEP_INITIAL, 1);
	step(STEP_PLAIN, 1);
	lead(0, 1);
	lead(1, 0);
	lead(2, 3);
	CHECK(is_good());
	layout = sfc_layout_new(&sfc);
	CHECK(layout && layout->frame_count == 2 && layout->frame[1].macro == 1 &&
	      layout->frame[1].title > layout->frame[0].bottom &&
	      layout->shape[2].top == layout->frame[1].top);
	sfc_layout_free(layout);
	clear();
	layout = sfc_layout_new(&sfc);
	CHECK_AS(layout && layout->rows == 0 && layout->frame_count == 0,
		 "an empty chart has an empty layout");
	CHECK(layout && shape_at(layout, 0, 0) == -1);
	sfc_layout_free(layout);
}

/* ---- time ---- */

static double seconds(void (*make)(void))
{
	struct timespec a, b;

	make();
	clock_gettime(CLOCK_MONOTONIC, &a);
	struct sfc_layout *layout = sfc_layout_new(&sfc);
	clock_gettime(CLOCK_MONOTONIC, &b);
	printf("# %d steps, %d transitions: %d lanes, %d rows\n", sfc.step_count,
	       sfc.transition_count, layout->lanes, layout->rows);
	sfc_layout_free(layout);
	return (double)(b.tv_sec - a.tv_sec) + (double)(b.tv_nsec - a.tv_nsec) / 1e9;
}

static void thousand(void)
{
	clear();
	seed = 7;
	step(STEP_INITIAL, -1);
	for (int at = 0; sfc.step_count < 1000;)
		at = grow(at, 2, -1);
}

/* All steps but the first lead to the same step. */
static void stairs(int count)
{
	clear();
	for (int i = 0; i < count; i++)
		step(i ? STEP_PLAIN : STEP_INITIAL, -1);
	for (int i = 0; i < count - 2; i++) {
		if (i > 0)
			lead(i, count - 1);
		lead(i, i + 1);
	}
}

static void staircase(void)
{
	stairs(2400);
}

static void check_time(void)
{
	double a = seconds(thousand), b = seconds(staircase);

	printf("# %.1f ms, %.1f ms\n", a * 1e3, b * 1e3);
	CHECK_AS(a < 0.5 && b < 2, "layouts of large charts are fast enough");
}

int main(void)
{
	struct sfc_layout *layout;

	check_sequence();
	check_reference();
	check_narrow(false);
	check_narrow(true);
	stairs(60);
	CHECK_AS(is_good(), "the layout of 60 steps that lead to one step is correct");
	layout = sfc_layout_new(&sfc);
	printf("# %d lanes\n", layout ? layout->lanes : 0);
	CHECK(layout && layout->lanes < 8);
	sfc_layout_free(layout);
	check_macro();
	check_many(random_sfc, tap_rounds(2000),
		"the layouts of random charts are correct");
	check_many(random_garbage, tap_rounds(4000),
		"the layouts of random charts with errors are correct");
	check_time();
	return tap_done();
}
