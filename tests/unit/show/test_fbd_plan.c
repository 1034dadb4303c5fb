/* SPDX-License-Identifier: MIT
 *
 * test_fbd_plan - thousands of random networks: boxes do not overlap, no wire runs through a box, a text or
 * along another wire, each wire joins its pins, and the same network is always laid out the same.
 */
#include "engine/show/fbd_plan.h"
#include "tests/tap.h"

#include <time.h>

enum { BOXES = 200, PINS = 3000 };

static struct fbd_box boxes[BOXES];
static struct fbd_pin pins[PINS];
static struct fbd_wire wires[PINS];
static struct fbd_graph graph = { .box = boxes, .pin = pins, .wire = wires };
static char why[200];

/* ---- networks ---- */

static unsigned int seed;

static int chance(int of)
{
	seed = seed * 1664525u + 1013904223u;
	return (int)(seed >> 8) % of;
}

static int add_pin(int box, bool output)
{
	pins[graph.pin_count] = (struct fbd_pin){ .name = output ? "Q" : "IN", .output = output, .box = box,
						  .wire = -1, .open = true };
	boxes[box].pins++;
	return graph.pin_count++;
}

static int add_box(enum fbd_box_kind kind, int inputs, int outputs)
{
	const int box = graph.box_count++;

	boxes[box] = (struct fbd_box){ .kind = kind, .type = "", .first_pin = graph.pin_count };
	if (kind == FBD_STORE)
		boxes[box].target = "Target";
	else if (kind == FBD_BLOCK)
		boxes[box].instance = "Instance";
	for (int i = 0; i < inputs; i++)
		add_pin(box, false);
	for (int i = 0; i < outputs; i++)
		add_pin(box, true);
	return box;
}

static void join(int output, int input)
{
	if (pins[output].wire < 0) {
		wires[graph.wire_count] = (struct fbd_wire){ .from_pin = output, .item = -1,
							     .name = chance(4) ? NULL : "Wire" };
		pins[output].wire = graph.wire_count++;
	}
	pins[input].wire = pins[output].wire;
	pins[input].open = pins[output].open = false;
}

/* An output of a box before @before; -1: there is none. */
static int any_output(int before)
{
	int found = -1, count = 0;

	for (int i = 0; i < graph.pin_count; i++)
		if (pins[i].output && pins[i].box < before && chance(++count) == 0)
			found = i;
	return found;
}

static void clear(void)
{
	graph.box_count = graph.pin_count = graph.wire_count = 0;
}

static void random_network(unsigned int number)
{
	const int least = 2, count = least + chance(59);
	const int feedback = chance(3) ? 40 : 6, local = chance(2) ? 6 : 60;

	seed = number * 7919u + 1;
	clear();
	for (int i = 0; i < count; i++) {
		const int kind = chance(6);
		const int box = kind == 0 ? add_box(FBD_STORE, 1, 0) :
				kind == 1 ? add_box(FBD_VALUE, 1, 1) :
				add_box(kind == 2 ? FBD_BLOCK : FBD_FUNCTION, chance(5), 1 + chance(3));

		if (chance(12) == 0)
			boxes[box].at_column = 1 + chance(6);
		if (chance(12) == 0)
			boxes[box].at_row = 1 + chance(40);
		for (int k = boxes[box].first_pin; k < boxes[box].first_pin + boxes[box].pins; k++) {
			int from = any_output(box);

			if (pins[k].output)
				continue;
			if (from >= 0 && box - pins[from].box > local)
				from = any_output(box);
			if (from >= 0 && chance(3))
				join(from, k);
			else if (chance(2))
				pins[k].operand = "Operand";
			pins[k].negated = chance(5) == 0;
		}
	}
	for (int i = 0; i < graph.pin_count; i++) {
		const int from = any_output(graph.box_count);

		if (pins[i].output || pins[i].wire >= 0 || pins[i].operand || chance(feedback) || from < 0)
			continue;
		join(from, i);
		pins[i].previous = true;
	}
}

/* ---- what holds for each plan ---- */

static float measure(void *context, enum fbd_text kind, const char *text)
{
	(void)context;
	(void)kind;
	return 7 * (float)strlen(text);
}

static const struct fbd_metrics pixels = { measure, NULL, 2, 1, 1, 1, 0, 7, 14, 60, 80, 14, 8, 20, 12, 9 };
static const struct fbd_metrics letters = { measure, NULL, 1, 1, 1, 0, 0, 1, 2, 5, 3, 2, 1, 1, 1, 2 };

static bool fail(const char *what, int a, int b)
{
	snprintf(why, sizeof(why), "%s: %d, %d", what, a, b);
	return false;
}

static bool apart(const struct fbd_plan *plan)
{
	for (int a = 0; a < graph.box_count; a++)
		for (int b = 0; b < a; b++) {
			const struct fbd_at *x = &plan->box[a], *y = &plan->box[b];

			if (x->x < y->x + y->width && y->x < x->x + x->width && x->top <= y->bottom &&
			    y->top <= x->bottom)
				return fail("boxes overlap", a, b);
			if (x->column != y->column && x->x < y->x + y->width && y->x < x->x + x->width)
				return fail("columns overlap", a, b);
		}
	return true;
}

/* Does a segment enter the rectangle from @x1 to @x2 and @row1 to @row2? Its sides may be touched. */
static bool enters(const struct fbd_segment *s, float x1, float x2, int row1, int row2)
{
	return s->x1 < x2 && s->x2 > x1 && s->row1 <= row2 && s->row2 >= row1;
}

static bool free_ways(const struct fbd_plan *plan, const struct fbd_metrics *metrics)
{
	for (int i = 0; i < plan->segment_count; i++) {
		const struct fbd_segment *s = &plan->segment[i];

		for (int b = 0; b < graph.box_count; b++)
			if (enters(s, plan->box[b].x, plan->box[b].x + plan->box[b].width, plan->box[b].top,
				   plan->box[b].bottom))
				return fail("a wire runs through a box", i, b);
		for (int k = 0; k < graph.pin_count; k++) {
			const struct fbd_pin_at *at = &plan->pin[k];

			if (pins[k].operand && enters(s, at->x - metrics->stub - measure(NULL, 0, pins[k].operand),
						      at->x, at->row, at->row))
				return fail("a wire runs through an operand", i, k);
		}
		if (s->x1 != s->x2 && s->row1 != s->row2)
			return fail("a slanting wire", i, i);
		if (s->x1 < 0 || s->x2 > plan->width || s->row1 < 0 || s->row2 >= plan->rows)
			return fail("a wire outside", i, i);
	}
	return true;
}

static bool own_ways(const struct fbd_plan *plan)
{
	for (int i = 0; i < plan->segment_count; i++)
		for (int k = 0; k < i; k++) {
			const struct fbd_segment *a = &plan->segment[i], *b = &plan->segment[k];
			const bool level = a->row1 == a->row2, other = b->row1 == b->row2;

			if (a->pin == b->pin || level != other)
				continue;
			if (level && a->row1 == b->row1 && a->x1 < b->x2 && b->x1 < a->x2)
				return fail("wires along each other", i, k);
			if (!level && a->x1 == b->x1 && a->row1 <= b->row2 && b->row1 <= a->row2)
				return fail("upright wires along each other", i, k);
		}
	return true;
}

static bool touches(const struct fbd_segment *a, const struct fbd_segment *b)
{
	return a->pin == b->pin && a->x1 <= b->x2 && b->x1 <= a->x2 && a->row1 <= b->row2 && b->row1 <= a->row2;
}

static bool has_point(const struct fbd_segment *s, int row, float x)
{
	return s->row1 <= row && row <= s->row2 && s->x1 <= x && x <= s->x2;
}

static bool joined(const struct fbd_plan *plan)
{
	static int group[60000];
	bool changed = true;

	for (int i = 0; i < plan->segment_count; i++)
		group[i] = i;
	while (changed) {
		changed = false;
		for (int i = 0; i < plan->segment_count; i++)
			for (int k = 0; k < i; k++)
				if (group[i] != group[k] && touches(&plan->segment[i], &plan->segment[k])) {
					group[i] = group[k] = group[i] < group[k] ? group[i] : group[k];
					changed = true;
				}
	}
	for (int pin = 0; pin < graph.pin_count; pin++) {
		const int from = fbd_graph_source(&graph, pin);
		int here = -1, there = -2;

		if (from < 0)
			continue;
		for (int i = 0; i < plan->segment_count; i++) {
			if (plan->segment[i].pin != from)
				continue;
			if (has_point(&plan->segment[i], plan->pin[pin].row, plan->pin[pin].x))
				here = group[i];
			if (has_point(&plan->segment[i], plan->pin[from].row, plan->pin[from].x))
				there = group[i];
		}
		if (here != there)
			return fail("a wire does not join its pins", from, pin);
	}
	return true;
}

static bool same(const struct fbd_plan *a, const struct fbd_plan *b)
{
	return a->segment_count == b->segment_count && a->rows == b->rows && a->width == b->width &&
	       memcmp(a->box, b->box, (size_t)graph.box_count * sizeof(*a->box)) == 0 &&
	       (!a->segment_count ||
		memcmp(a->segment, b->segment, (size_t)a->segment_count * sizeof(*a->segment)) == 0);
}

static bool holds(const struct fbd_metrics *metrics)
{
	struct fbd_plan plan, again;
	bool good;

	if (!fbd_plan_make(&graph, metrics, &plan) || !fbd_plan_make(&graph, metrics, &again))
		return fail("no plan", 0, 0);
	good = apart(&plan) && free_ways(&plan, metrics) && own_ways(&plan) && joined(&plan);
	if (good && !same(&plan, &again))
		good = fail("not the same again", 0, 0);
	fbd_plan_free(&plan);
	fbd_plan_free(&again);
	return good;
}

static void random_networks(void)
{
	const int rounds = tap_rounds(2000);
	int bad = 0;

	for (int i = 0; i < rounds && bad < 5; i++) {
		random_network((unsigned int)i);
		for (int k = 0; k < 2; k++)
			if (!holds(k ? &letters : &pixels)) {
				printf("# network %d, %s: %s\n", i, k ? "letters" : "pixels", why);
				bad++;
			}
	}
	CHECK_AS(bad == 0, "random networks up to 60 boxes");
}

/* ---- what a person expects ---- */

static int out_of(int box)
{
	int pin = boxes[box].first_pin;

	while (!pins[pin].output)
		pin++;
	return pin;
}

static void is_straight(void)
{
	struct fbd_plan plan;
	int last = -1;

	clear();
	for (int i = 0; i < 5; i++) {
		const int box = add_box(i < 4 ? FBD_FUNCTION : FBD_STORE, i < 4 ? 2 : 1, i < 4);

		if (last >= 0)
			join(out_of(last), boxes[box].first_pin);
		last = box;
	}
	CHECK(fbd_plan_make(&graph, &pixels, &plan));
	CHECK(plan.segment_count == 4 && plan.columns == 5 && plan.crossing_count == 0);
	CHECK(plan.box[4].column == 4);
	fbd_plan_free(&plan);
}

/* Two sources whose readers stand the other way round: the order in the second column follows. */
static void crosses_nothing(void)
{
	struct fbd_plan plan;
	int a, b, c, d;

	clear();
	a = add_box(FBD_FUNCTION, 1, 1);
	b = add_box(FBD_FUNCTION, 1, 1);
	c = add_box(FBD_FUNCTION, 1, 1);
	d = add_box(FBD_FUNCTION, 1, 1);
	join(out_of(a), boxes[d].first_pin);
	join(out_of(b), boxes[c].first_pin);
	CHECK(fbd_plan_make(&graph, &pixels, &plan));
	CHECK(plan.crossing_count == 0 && plan.segment_count == 2);
	CHECK(plan.box[d].first < plan.box[c].first);
	fbd_plan_free(&plan);
}

static void follows_hints(void)
{
	struct fbd_plan plan;
	int a, b, c;

	clear();
	a = add_box(FBD_FUNCTION, 1, 1);
	b = add_box(FBD_FUNCTION, 1, 1);
	c = add_box(FBD_FUNCTION, 1, 1);
	boxes[a].at_column = 3;
	boxes[a].at_row = 9;
	boxes[b].at_row = 20;
	CHECK(fbd_plan_make(&graph, &pixels, &plan));
	CHECK(plan.box[a].column == 2 && plan.box[a].top == 8);
	CHECK(plan.box[b].top == 19 && plan.box[c].column == 0);
	fbd_plan_free(&plan);
	join(out_of(b), boxes[c].first_pin);
	boxes[c].at_column = 1; /* not left of what it reads */
	CHECK(fbd_plan_make(&graph, &pixels, &plan));
	CHECK(plan.box[c].column == 1);
	fbd_plan_free(&plan);
}

/* A feedback runs below all boxes, back to the left. */
static void leads_back(void)
{
	struct fbd_plan plan;
	int a, b, lane = 0;

	clear();
	a = add_box(FBD_FUNCTION, 2, 1);
	b = add_box(FBD_FUNCTION, 1, 1);
	join(out_of(a), boxes[b].first_pin);
	join(out_of(b), boxes[a].first_pin + 1);
	pins[boxes[a].first_pin + 1].previous = true;
	CHECK(fbd_plan_make(&graph, &pixels, &plan));
	CHECK(plan.box[a].column == 0 && plan.box[b].column == 1);
	for (int i = 0; i < plan.segment_count; i++)
		lane |= plan.segment[i].feedback && plan.segment[i].row1 > plan.box[a].bottom &&
			plan.segment[i].x1 < plan.box[a].x && plan.segment[i].x2 > plan.box[b].x + plan.box[b].width;
	CHECK(lane);
	fbd_plan_free(&plan);
}

static void is_empty(void)
{
	struct fbd_plan plan;

	clear();
	CHECK(fbd_plan_make(&graph, &pixels, &plan));
	CHECK(plan.rows == 0 && plan.segment_count == 0);
	fbd_plan_free(&plan);
}

/* Printed for people; no bound, as a machine may be busy. */
static void measure_time(void)
{
	struct timespec from, to;
	double best = 1e9;

	do
		random_network(++seed);
	while (graph.box_count != 60);
	for (int i = 0; i < 20; i++) {
		struct fbd_plan plan;
		double ms;

		clock_gettime(CLOCK_MONOTONIC, &from);
		if (fbd_plan_make(&graph, &pixels, &plan))
			fbd_plan_free(&plan);
		clock_gettime(CLOCK_MONOTONIC, &to);
		ms = (double)(to.tv_sec - from.tv_sec) * 1e3 + (double)(to.tv_nsec - from.tv_nsec) / 1e6;
		best = ms < best ? ms : best;
	}
	printf("# %d boxes, %d wires: %.3f ms\n", graph.box_count, graph.wire_count, best);
}

int main(void)
{
	is_empty();
	is_straight();
	crosses_nothing();
	follows_hints();
	leads_back();
	random_networks();
	measure_time();
	return tap_done();
}
