/* SPDX-License-Identifier: MIT
 *
 * duel - runs one program in the engine and in the walker.
 */
#include "tests/walker/duel.h"

#include "engine/ladder.h"
#include "tests/walker/walker.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COMPARED 1500 /* variables of one program                            */
#define WINDOW 16     /* bytes of I, Q and M that programs use               */
#define MARKS 24

struct side {
	struct resource resource;
	void *memory;
};

struct duel {
	struct ladder *ladder;
	struct walker *walker;
	struct side side[2];  /* plain; watched                              */
	struct location at[COMPARED];
	const struct duel_plan *plan;
	int scan;
	bool over;            /* a scan has failed on both sides              */
	char why[256];
};

static void differ(struct duel *duel, int side, const char *what, double engine,
		   double walker)
{
	snprintf(duel->why, sizeof(duel->why),
		 "scan %d%s: %s: engine %.17g, walker %.17g", duel->scan + 1,
		 side ? " (watched)" : "", what, engine, walker);
}

static bool same_value(struct duel *duel, int side, int index, struct value mine)
{
	const struct image *image = &duel->side[side].resource.image;
	union iec_value theirs = image_get(image, duel->at[index]);
	const char *name = walker_name(duel->walker, index);
	bool real = mine.type == IEC_REAL || mine.type == IEC_LREAL;
	double a = real ? theirs.r : (double)theirs.i;
	double b = mine.type == IEC_LREAL ? mine.d :
		   real ? (double)mine.r : (double)mine.i;

	if (mine.type == IEC_STRING) {
		if (theirs.s->length == mine.len &&
		    memcmp(theirs.s->text, mine.text, (size_t)mine.len) == 0)
			return true;
		differ(duel, side, name, theirs.s->length, mine.len);
		return false;
	}
	if (!(real ? a != b && (a == a || b == b) : theirs.i != mine.i))
		return true;
	differ(duel, side, name, a, b);
	return false;
}

static bool same_values(struct duel *duel)
{
	for (int i = 0; i < walker_count(duel->walker) && i < COMPARED; i++) {
		struct value mine;

		if (!walker_is_settled(duel->walker, i))
			continue;
		mine = walker_value(duel->walker, i);
		for (int side = 0; side < 2; side++)
			if (!same_value(duel, side, i, mine))
				return false;
	}
	return true;
}

static bool same_area(struct duel *duel, int side, enum iec_area area, int size)
{
	const uint8_t *a = image_area(&duel->side[side].resource.image, area);
	const uint8_t *b = walker_area(duel->walker, area);
	char text[32];

	for (int i = 0; i < size; i++) {
		if (a[i] == b[i])
			continue;
		snprintf(text, sizeof(text), "%%%sB%d",
			 iec_area_row(area)->letters, i);
		differ(duel, side, text, a[i], b[i]);
		return false;
	}
	return true;
}

/* Compares the cells of a POU, or of an instance of a block. */
struct body {
	const struct pou *pou;
	int number;
	const char *instance; /* NULL: of a POU                               */
};

static bool engine_power(struct duel *duel, const struct body *body, uint32_t rung,
			 uint32_t row, uint32_t col, bool *in, bool *out)
{
	const struct resource *resource = &duel->side[1].resource;

	if (!body->instance)
		return resource_power(resource, (uint32_t)body->number, rung, row, col,
				      in, out);
	return resource_power_in(resource, body->instance, strlen(body->instance), rung,
				 row, col, in, out);
}

static bool same_cell(struct duel *duel, const struct body *body, int rung, int row,
		      int col)
{
	bool in = false, out = false, my_in = false, my_out = false;
	enum walker_power known = body->instance ?
		walker_power_in(duel->walker, body->number, rung, row, col, &my_in, &my_out) :
		walker_power(duel->walker, body->number, rung, row, col, &my_in, &my_out);
	char text[160];

	if (known == POWER_UNKNOWN)
		return true;
	snprintf(text, sizeof(text), "power of %.60s rung %d (%d,%d)",
		 body->instance ? body->instance : "", rung, row, col);
	if (!engine_power(duel, body, (uint32_t)rung, (uint32_t)row, (uint32_t)col, &in,
			  &out)) {
		differ(duel, 1, text, -1, my_in);
		return false;
	}
	if (in == my_in && (known == POWER_IN_ONLY || out == my_out))
		return true;
	differ(duel, 1, text, in * 2 + out, my_in * 2 + my_out);
	return false;
}

static bool same_body(struct duel *duel, const struct body *body)
{
	for (int i = 0; i < body->pou->rung_count; i++) {
		const struct rung *rung = body->pou->rung[i];

		for (int c = 0; c < rung->rows * rung->cols; c++)
			if (!same_cell(duel, body, i + 1, c / rung->cols + 1,
				       c % rung->cols + 1))
				return false;
	}
	return true;
}

static bool same_power(struct duel *duel)
{
	const struct project *project = ladder_project(duel->ladder);
	struct body body = { NULL, 0, NULL };

	for (; body.number < project->pou_count; body.number++) {
		body.pou = &project->pou[body.number];
		if (!same_body(duel, &body))
			return false;
	}
	for (body.number = 0; (body.pou = walker_instance(duel->walker, body.number,
			       &body.instance)) != NULL; body.number++)
		if (!same_body(duel, &body))
			return false;
	return true;
}

static bool same_scan(struct duel *duel, struct random_source *source,
		      int64_t now_ns)
{
	uint8_t *inputs = walker_area(duel->walker, AREA_I);
	bool good = walker_scan(duel->walker, now_ns);

	for (int side = 0; side < 2; side++) {
		struct resource *resource = &duel->side[side].resource;

		memcpy(image_area(&resource->image, AREA_I), inputs, WINDOW);
		if (resource_scan(resource, now_ns) != good) {
			differ(duel, side, "scan ends", !good, good);
			return false;
		}
		duel->over = !good;
		if (!good)
			continue;
		if (!same_area(duel, side, AREA_Q, WINDOW) ||
		    !same_area(duel, side, AREA_M, MARKS))
			return false;
		if (resource->vm.errors != walker_errors(duel->walker)) {
			differ(duel, side, "failed operations",
			       resource->vm.errors,
			       walker_errors(duel->walker));
			return false;
		}
	}
	if (!duel->over && !same_values(duel))
		return false;
	return duel->over || duel->plan->values || !random_chance(source, 50) || same_power(duel);
}

static bool run_duel(struct duel *duel)
{
	const struct duel_plan *plan = duel->plan;
	struct random_source source;
	int scans;
	int64_t now_ns;

	random_seed(&source, plan->seed ^ 0x5ca5ca5c);
	now_ns = random_next(&source);
	scans = plan->scans + (int)random_below(&source, (uint32_t)plan->more_scans);
	for (duel->scan = 0; duel->scan < scans && !duel->over; duel->scan++) {
		plan->inputs(&source, walker_area(duel->walker, AREA_I));
		now_ns += plan->passed(&source);
		if (!same_scan(duel, &source, now_ns))
			return false;
	}
	return true;
}

/* Where they are is the same in both images. */
static bool find_values(struct duel *duel)
{
	const struct image *image = &duel->side[0].resource.image;

	for (int i = 0; i < walker_count(duel->walker) && i < COMPARED; i++) {
		const char *name = walker_name(duel->walker, i);

		duel->at[i] = image_find(image, name, strlen(name));
		if (duel->at[i].type != IEC_NONE)
			continue;
		snprintf(duel->why, sizeof(duel->why), "the image has no %s", name);
		return false;
	}
	return true;
}

static bool set_up(struct duel *duel)
{
	const struct program *program = ladder_program(duel->ladder);

	for (int i = 0; i < 2; i++) {
		struct side *side = &duel->side[i];
		size_t size = (image_memory_size(program) + 7) / 8 * 8;

		side->memory = aligned_alloc(8, size);
		if (!side->memory)
			return false;
		resource_init(&side->resource, program, side->memory);
		resource_start(&side->resource);
		side->resource.watch = i == 1;
	}
	return find_values(duel);
}

static enum verdict fight(struct duel *duel, const char *text, size_t len)
{
	struct diag_list *diags = ladder_diags(duel->ladder);
	const char *why = "";

	if (!ladder_load_text(duel->ladder, "random.rung", text, len) ||
	    !ladder_build(duel->ladder)) {
		for (int i = 0; i < diags->count; i++)
			if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR) {
				diag_print(&diags->diag[i], duel->why,
					   sizeof(duel->why));
				break;
			}
		return REFUSED;
	}
	duel->walker = walker_new(ladder_project(duel->ladder), &why);
	if (!duel->walker) {
		snprintf(duel->why, sizeof(duel->why), "walker: %s", why);
		return UNWALKED;
	}
	return set_up(duel) && run_duel(duel) ? AGREE : DISAGREE;
}

enum verdict duel_judge(const char *text, size_t len, const struct duel_plan *plan,
			char *why, size_t size)
{
	static struct duel duel;
	enum verdict verdict = UNWALKED;

	memset(&duel, 0, sizeof(duel));
	duel.plan = plan;
	duel.ladder = ladder_new();
	if (duel.ladder)
		ladder_watch(duel.ladder, true);
	if (duel.ladder) /* as a simulation does, every other time */
		ladder_watch_lists(duel.ladder, len % 2);
	if (duel.ladder)
		verdict = fight(&duel, text, len);
	snprintf(why, size, "%s", duel.why);
	free(duel.side[0].memory);
	free(duel.side[1].memory);
	walker_free(duel.walker);
	ladder_free(duel.ladder);
	return verdict;
}
