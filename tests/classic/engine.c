/* SPDX-License-Identifier: MIT
 *
 * engine - rungs, sections, jumps and calls of a ClassicLadder project.
 *
 * A rung is evaluated column by column from the left, a column from the top. A coil writes at
 * once. Blocks, expressions and charts have files of their own.
 */
#include "tests/classic/engine.h"
#include "tests/classic/own_read.h"

#include <stdlib.h>

enum { CALLS_MAX = 30, JUMPS_MAX = 99999 };

struct rung_run {
	const struct classic_rung *rung;
	uint8_t (*edge)[CLASSIC_COLUMNS];
	bool out[CLASSIC_ROWS][CLASSIC_COLUMNS];
	int jump;                /* -1: none                                   */
};

static bool connected(const struct classic_rung *rung, int x, int y)
{
	return y > 0 && y < CLASSIC_ROWS && rung->cell[y][x].top;
}

/* Power at the left end of a cell: any output of the column before, in the rows that links of
 * this column join. */
static bool left_of(const struct rung_run *run, int x, int y)
{
	int top = y, bottom = y;
	bool power = false;

	if (y >= CLASSIC_ROWS)
		return false;
	if (x <= 0)
		return true;
	while (connected(run->rung, x, top))
		top--;
	while (connected(run->rung, x, bottom + 1))
		bottom++;
	for (int row = top; row <= bottom; row++)
		power |= run->out[row][x - 1];
	return power;
}

static bool contact(struct engine *engine, struct rung_run *run, int x, int y)
{
	const struct classic_cell *cell = &run->rung->cell[y][x];
	bool now = engine_get(engine, cell->variable.type,
			      engine_at(engine, &cell->variable)) != 0;
	bool before = run->edge[y][x];

	run->edge[y][x] = now;
	switch (cell->element) {
	case 1:
		return now;
	case 2:
		return !now;
	case 3:
		return now && !before;
	default:
		return !now && before;
	}
}

static void block(struct engine *engine, struct rung_run *run, int x, int y)
{
	bool in[4], out[4] = { false };

	for (int row = 0; row < 4; row++)
		in[row] = left_of(run, x - 1, y + row);
	engine_block(engine, run->rung->cell[y][x].element,
		     run->rung->cell[y][x].variable.number, in, out);
	for (int row = 0; row < 4 && y + row < CLASSIC_ROWS; row++)
		if (row == 0 || run->rung->cell[y + row][x].element == 99)
			run->out[y + row][x] = out[row];
}

static void run_section(struct engine *engine, const struct classic_section *section);

static void call(struct engine *engine, int number)
{
	const struct classic_project *project = engine->project;

	for (int i = 0; i < project->sections; i++)
		if (project->section[i].subroutine == number &&
		    !project->section[i].sequential) {
			if (engine->depth < CALLS_MAX) {
				engine->depth++;
				run_section(engine, &project->section[i]);
				engine->depth--;
			}
			return;
		}
}

static void coil(struct engine *engine, struct rung_run *run, int x, int y)
{
	const struct classic_cell *cell = &run->rung->cell[y][x];
	bool power = left_of(run, x, y), set = cell->element == 52;

	if (cell->element == 54) {
		if (power)
			run->jump = cell->variable.number;
	} else if (cell->element == 55) {
		if (power)
			call(engine, cell->variable.number);
	} else if (cell->element == 50 || cell->element == 51) {
		engine_set(engine, cell->variable.type, engine_at(engine, &cell->variable),
			   power != (cell->element == 51));
	} else if (power) {
		engine_set(engine, cell->variable.type, engine_at(engine, &cell->variable),
			   set);
	}
}

static void cell_run(struct engine *engine, struct rung_run *run, int x, int y)
{
	const struct classic_cell *cell = &run->rung->cell[y][x];
	const char *text = own_expression(engine->project, cell->variable.number);
	bool result;

	switch (cell->element) {
	case 1: case 2: case 3: case 4:
		result = contact(engine, run, x, y); /* also without power       */
		run->out[y][x] = left_of(run, x, y) && result;
		break;
	case 9:
		run->out[y][x] = left_of(run, x, y);
		break;
	case 10: case 11: case 12: case 13: case 14:
		block(engine, run, x, y);
		break;
	case 20:
		result = text && engine_compare(engine, text);
		run->out[y][x] = left_of(run, x - 2, y) && result;
		break;
	case 50: case 51: case 52: case 53: case 54: case 55:
		coil(engine, run, x, y);
		break;
	case 60:
		if (left_of(run, x - 2, y) && text)
			engine_operate(engine, text);
		break;
	default:
		break;
	}
}

/* Runs a rung. Returns the target of a jump, -1: none. */
static int run_rung(struct engine *engine, const struct classic_rung *rung, int at)
{
	struct rung_run run = { .rung = rung, .edge = engine->edge[at], .jump = -1 };

	for (int x = 0; x < CLASSIC_COLUMNS; x++)
		for (int y = 0; y < CLASSIC_ROWS; y++) {
			cell_run(engine, &run, x, y);
			if (run.jump >= 0 || engine->stopped)
				return run.jump;
		}
	return -1;
}

static int position(const struct classic_project *project, int number)
{
	for (int i = 0; i < project->rungs; i++)
		if (project->rung[i]->number == number)
			return i;
	return -1;
}

static void run_section(struct engine *engine, const struct classic_section *section)
{
	const struct classic_project *project = engine->project;
	int at = position(project, section->first), jumps = 0;

	while (at >= 0 && !engine->stopped) {
		const struct classic_rung *rung = project->rung[at];
		int jump = run_rung(engine, rung, at);

		if (jump >= 0) {
			at = position(project, jump);
			engine->stopped |= ++jumps > JUMPS_MAX;
		} else if (rung->number == section->last) {
			return;
		} else {
			at = position(project, rung->next);
		}
	}
}

/* ---- system variables: virtual time ---- */

static void system_bits(struct engine *engine)
{
	int64_t ms = engine->now + engine->period; /* the end of the scan         */

	if (engine->project->dialect == CLASSIC_LINUXCNC)
		return;
	engine->system[0] = ms % 1000 < 500;
	engine->system[1] = !engine->system[0];
	engine->system[2] = ms % 60000 < 30000;
	engine->system[3] = !engine->system[2];
	engine->system[4] = engine->system[5] = engine->scans == 0;
}

void engine_scan(struct engine *engine, int ms)
{
	const struct classic_project *project = engine->project;

	engine->period = ms;
	if (engine->stopped) {
		engine->now += ms;
		return;
	}
	system_bits(engine);
	for (int i = 0; i < project->sections; i++) {
		const struct classic_section *section = &project->section[i];

		if (section->subroutine >= 0 || engine->stopped)
			continue;
		if (section->sequential)
			engine_sfc(engine, section->page);
		else
			run_section(engine, section);
	}
	engine->now += ms;
	engine->scans++;
}

/* ---- memory ---- */

static bool zeroed(void *pointer, size_t count, size_t size)
{
	void *memory = calloc(count ? count : 1, size);

	*(void **)pointer = memory;
	return memory;
}

static size_t size_of(const struct engine *engine, const char *key, long usual)
{
	const char *value = own_setting(engine->project, key);
	long size = value ? strtol(value, NULL, 10) : usual;

	if (!engine->faithful || size < 0 || size > CLASSIC_LIMIT)
		return CLASSIC_LIMIT;
	return (size_t)size;
}

static void place_bits(struct engine *engine)
{
	engine->bit = engine->bits;
	engine->input = engine->bit + size_of(engine, "SIZE_NBR_BITS", 500);
	engine->output = engine->input + size_of(engine, "SIZE_NBR_PHYS_INPUTS", 50);
	engine->system = engine->output + size_of(engine, "SIZE_NBR_PHYS_OUTPUTS", 50);
	engine->led = engine->bits + 4 * (size_t)CLASSIC_LIMIT;
	engine->error = engine->led + CLASSIC_LIMIT;
	engine->step_a = engine->error + CLASSIC_LIMIT;
}

struct engine *engine_new(const struct classic_project *project, bool faithful)
{
	struct engine *engine = calloc(1, sizeof(*engine));
	size_t all = CLASSIC_LIMIT;
	bool good;

	if (!engine)
		return NULL;
	engine->project = project;
	engine->faithful = faithful;
	for (int i = 0; i < project->reg.count; i++)
		if (project->reg.block[i].number >= engine->fifos)
			engine->fifos = project->reg.block[i].number + 1;
	good = zeroed(&engine->bits, 8 * all, 1) && zeroed(&engine->word, all, 4) &&
	       zeroed(&engine->input_word, all, 4) && zeroed(&engine->input_number, all, 4) &&
	       zeroed(&engine->output_word, all, 4) &&
	       zeroed(&engine->system_word, all, 4) && zeroed(&engine->step_v, all, 4) &&
	       zeroed(&engine->timer, all, sizeof(*engine->timer)) &&
	       zeroed(&engine->mono, all, sizeof(*engine->mono)) &&
	       zeroed(&engine->iec, all, sizeof(*engine->iec)) &&
	       zeroed(&engine->counter, all, sizeof(*engine->counter)) &&
	       zeroed(&engine->fifo, all, sizeof(*engine->fifo)) &&
	       zeroed(&engine->list, (size_t)engine->fifos *
		      (size_t)project->register_list + 1, 4) &&
	       zeroed(&engine->active, (size_t)project->steps, sizeof(bool)) &&
	       zeroed(&engine->active_ms, (size_t)project->steps, sizeof(int64_t)) &&
	       zeroed(&engine->edge, (size_t)project->rungs, sizeof(*engine->edge));
	if (!good) {
		engine_free(engine);
		return NULL;
	}
	place_bits(engine);
	engine_reset(engine);
	return engine;
}

void engine_free(struct engine *engine)
{
	if (!engine)
		return;
	free(engine->bits);
	free(engine->word);
	free(engine->input_word);
	free(engine->input_number);
	free(engine->output_word);
	free(engine->system_word);
	free(engine->step_v);
	free(engine->timer);
	free(engine->mono);
	free(engine->iec);
	free(engine->counter);
	free(engine->fifo);
	free(engine->list);
	free(engine->active);
	free(engine->active_ms);
	free(engine->edge);
	free(engine);
}
