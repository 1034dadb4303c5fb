/* SPDX-License-Identifier: MIT
 *
 * scenario - runs the steps of a scenario in virtual time and reports failures. The
 * caller prints TAP.
 */
#include "engine/trial/scenario.h"

#include "engine/trial/pace.h"
#include "engine/trial/value.h"

#include <string.h>

struct run {
	const struct scenario_file *file;
	struct scenario *scenario;
	struct resource *resource;
	struct plant *plant;          /* beside this scenario; or NULL        */
	const struct sink *out;
	int64_t now_ns;
	uint64_t scan;
	int next;             /* first step whose time is still to come       */
	int first_open;       /* all steps before it are decided              */
	bool held;
};

static void print_time(const struct sink *out, int64_t ns)
{
	char text[40];

	iec_value_print(IEC_TIME, (union iec_value){ .i = ns }, text,
			sizeof(text));
	sink_text(out, text);
}

static void scan(struct run *run)
{
	if (run->plant) {
		run->plant->resource.period_ns = run->scenario->period_ns;
		plant_scan(run->plant, &run->resource->image, run->now_ns);
	}
	run->resource->period_ns = run->scenario->period_ns;
	pace_scan(run->resource, run->now_ns, run->scenario->period_ns);
}

/* An earlier scan, with the variables of @formula. */
static void print_scan(const struct run *run, const struct formula *formula,
		       uint64_t scan)
{
	const struct scenario *scenario = run->scenario;

	sink_printf(run->out, "#   %llu t=", (unsigned long long)scan);
	print_time(run->out, (int64_t)scan * scenario->period_ns);
	for (int i = 0; i < scenario->watch_count; i++) {
		const struct scenario_watch *watch = &scenario->watch[i];
		bool named = false;
		char text[IEC_VALUE_TEXT];

		for (int k = 0; k < formula->count && !named; k++)
			named = formula->term[k].op == EXPR_NAME &&
				formula->term[k].at.where == watch->at.where &&
				formula->term[k].at.area == watch->at.area &&
				formula->term[k].at.type == watch->at.type &&
				formula->term[k].plant == watch->plant;
		if (!named)
			continue;
		iec_value_print(watch->at.type,
				watch->past[scan % SCENARIO_HISTORY], text,
				sizeof(text));
		sink_text(run->out, " ");
		sink_text(run->out, watch->name);
		sink_text(run->out, "=");
		sink_text(run->out, text);
	}
	sink_text(run->out, "\n");
}

const char *scenario_failure_text(enum scenario_failure failure)
{
	static const char *const text[FAILURE_COUNT] = {
		[FAILURE_FALSE] = "not true",
		[FAILURE_UNKNOWN] = "cannot be computed",
		[FAILURE_RANGE] = "value is out of range",
		[FAILURE_PROGRAM] = "the program stopped with a fault",
		[FAILURE_PLANT] = "the plant stopped with a fault",
	};

	return text[failure];
}

/* Prints "# door.scn:7: at 50 ms: not true: ". @step: NULL: no step. */
static void fail(struct run *run, const struct scenario_step *step,
		 enum scenario_failure failure)
{
	struct scenario *scenario = run->scenario;
	const int line = step ? step->line : scenario->line;

	run->held = false;
	if (!scenario->failed_line) {
		scenario->failed_line = line;
		scenario->failed_scan = run->scan;
		scenario->failed_ns = run->now_ns;
		scenario->failure = failure;
		scenario->failed_step = step;
	}
	sink_text(run->out, "# ");
	sink_text(run->out, run->file->file);
	sink_printf(run->out, ":%d: at ", line);
	print_time(run->out, run->now_ns);
	sink_printf(run->out, " ms: %s: ", scenario_failure_text(failure));
}

static void report(struct run *run, const struct scenario_step *step,
		   enum scenario_failure failure)
{
	uint64_t first = run->scan < SCENARIO_HISTORY ?
			       1 : run->scan - SCENARIO_HISTORY + 1;

	fail(run, step, failure);
	sink_write(run->out, step->text, (size_t)step->text_len);
	sink_text(run->out, "\n");
	if (step->verb == VERB_SET)
		return;
	for (uint64_t scan = first; scan <= run->scan; scan++)
		print_scan(run, step->formula, scan);
}

static void apply(struct run *run, const struct scenario_step *step)
{
	struct image *image = &run->resource->image;
	struct image *target = step->plant && run->plant ? &run->plant->resource.image
							 : image;
	union iec_value value;

	if (formula_value(step->formula, image, &value) &&
	    formula_fit(step->formula, value, step->target.type, &value) &&
	    value_has_room(target, step->target, value))
		image_set(target, step->target, value);
	else
		report(run, step, FAILURE_RANGE);
}

/* Executes settings that are due; expectations that are due are open from now on. */
static void begin_scan(struct run *run)
{
	struct scenario *scenario = run->scenario;

	while (run->next < scenario->step_count) {
		struct scenario_step *step = &scenario->step[run->next];

		if (step->verb == VERB_ALWAYS || step->verb == VERB_NEVER) {
			run->next++;
			continue;
		}
		if (step->at_ns > run->now_ns)
			break;
		if (step->verb == VERB_SET)
			apply(run, step);
		else
			step->open = true;
		run->next++;
	}
}

static void remember(struct run *run)
{
	struct scenario *scenario = run->scenario;

	for (int i = 0; i < scenario->watch_count; i++) {
		struct scenario_watch *watch = &scenario->watch[i];

		union iec_value *past = &watch->past[run->scan % SCENARIO_HISTORY];
		union iec_value value = image_get(watch->plant ? run->file->plant :
						  &run->resource->image, watch->at);

		if (watch->at.type == IEC_STRING)
			iec_store((void *)past->s, IEC_STRING, value);
		else
			*past = value;
	}
}

static void judge(struct run *run, struct scenario_step *step)
{
	int64_t left_ns = step->at_ns + step->span_ns - run->now_ns;
	const struct image *image = &run->resource->image;
	union iec_value value;
	bool known = formula_value(step->formula, image, &value);
	bool good = known && (value.i != 0) != (step->verb == VERB_NEVER);
	bool more = false;

	switch (step->verb) {
	case VERB_SET:
		return;
	case VERB_EXPECT:
		break;
	case VERB_WITHIN:
		more = !good && left_ns >= run->scenario->period_ns;
		break;
	case VERB_FOR:
		more = good && left_ns > run->scenario->period_ns;
		break;
	case VERB_ALWAYS:
	case VERB_NEVER:
		more = good;
		break;
	}
	if (more)
		return;
	step->open = false;
	if (!good)
		report(run, step, known ? FAILURE_FALSE : FAILURE_UNKNOWN);
}

static void judge_all(struct run *run)
{
	struct scenario *scenario = run->scenario;
	int last_open = run->first_open;
	bool first = true;

	for (int i = run->first_open; i < scenario->step_count; i++) {
		struct scenario_step *step = &scenario->step[i];

		if (step->open)
			judge(run, step);
		if (!step->open && first && i < run->next)
			last_open = i + 1;
		else
			first = false;
	}
	run->first_open = last_open;
}

static bool is_done(const struct run *run)
{
	const struct scenario *scenario = run->scenario;

	if (run->next < scenario->step_count)
		return false;
	for (int i = run->first_open; i < scenario->step_count; i++) {
		const struct scenario_step *step = &scenario->step[i];

		if (step->open && step->verb != VERB_ALWAYS &&
		    step->verb != VERB_NEVER)
			return false;
	}
	return true;
}

static void open_steps(struct scenario *scenario)
{
	for (int i = 0; i < scenario->step_count; i++) {
		struct scenario_step *step = &scenario->step[i];

		step->open = step->verb == VERB_ALWAYS ||
			     step->verb == VERB_NEVER;
	}
}

static bool has_fault(const struct run *run)
{
	return run->resource->state == STATE_FAULT ||
	       (run->plant && run->plant->resource.state == STATE_FAULT);
}

static void report_fault(struct run *run)
{
	const bool plant = run->resource->state != STATE_FAULT;
	const struct resource *resource = plant ? &run->plant->resource : run->resource;
	const struct fault_place *at = &resource->fault_at;
	char text[96];

	fail(run, NULL, plant ? FAILURE_PLANT : FAILURE_PROGRAM);
	resource_fault_print(resource, text, sizeof(text));
	sink_text(run->out, text);
	if (at->pou && *at->pou && at->rung) {
		sink_text(run->out, ": ");
		sink_text(run->out, at->pou);
		sink_printf(run->out, " rung %u", at->rung);
	}
	sink_text(run->out, "\n");
}

bool scenario_run(const struct scenario_file *file, int index,
		  struct resource *resource, struct plant *plant,
		  const struct sink *out)
{
	struct run run = { .file = file, .scenario = &file->scenario[index],
			   .resource = resource, .out = out, .held = true };

	open_steps(run.scenario);
	run.scenario->failed_line = 0;
	pace_set(resource, run.scenario->speed);
	resource_start(resource);
	if (run.scenario->with_plant && plant) {
		run.plant = plant;
		resource_start(&plant->resource);
	}
	do {
		run.scan++;
		run.now_ns += run.scenario->period_ns;
		begin_scan(&run);
		scan(&run);
		if (has_fault(&run)) {
			report_fault(&run);
			return false;
		}
		remember(&run);
		judge_all(&run);
		if (file->stop && *file->stop)
			return false;
	} while (!is_done(&run));
	return run.held;
}

/* A setting that fails is left out, as in a run. */
static void act(const struct scenario_step *step, struct twin *twin,
		void (*take)(void *context, uint64_t after, const struct act *act),
		void *context)
{
	const struct image *image = &twin->resource.image;
	const struct image *target = step->plant ? &twin->plant.image : image;
	struct act act = { .kind = ACT_SET, .plant = step->plant, .at = step->target };

	if (!formula_value(step->formula, image, &act.value) ||
	    !formula_fit(step->formula, act.value, step->target.type, &act.value) ||
	    !value_has_room(target, step->target, act.value))
		return;
	take(context, twin->scan, &act);
	twin_act(twin, &act);
}

bool scenario_each_act(const struct scenario_file *file, int index, struct twin *twin,
		       uint64_t scans,
		       void (*take)(void *context, uint64_t after, const struct act *act),
		       void *context)
{
	const struct scenario *scenario = &file->scenario[index];
	const struct act period = { .kind = ACT_PERIOD, .value.i = scenario->period_ns };
	const struct act speed = { .kind = ACT_SPEED, .value.i = (int64_t)scenario->speed };
	const struct act start = { .kind = ACT_START };
	int next = 0;

	if (!twin_act(twin, &period) || !twin_act(twin, &speed) || !twin_act(twin, &start))
		return false;
	while (twin->scan < scans) {
		const uint64_t before = twin->scan;

		for (; next < scenario->step_count; next++) {
			const struct scenario_step *step = &scenario->step[next];
			const bool always = step->verb == VERB_ALWAYS ||
					    step->verb == VERB_NEVER;

			if (!always && step->at_ns > twin->now_ns + twin->period_ns)
				break;
			if (step->verb == VERB_SET)
				act(step, twin, take, context);
		}
		twin_scan(twin);
		if (twin->scan == before || (file->stop && *file->stop))
			return false;
	}
	return true;
}

bool scenario_is_plant(const struct lex *lex)
{
	struct lex ahead = *lex;

	if (!lex_is(&ahead, "plant"))
		return false;
	lex_next(&ahead);
	return ahead.token.kind == TOKEN_STRING;
}

bool scenario_plant_token(const char *text, size_t len, struct token *out)
{
	bool first = true; /* offset in its line */
	struct lex lex;

	lex_init(&lex, text, len);
	lex.newlines = true;
	for (lex_next(&lex); lex.token.kind != TOKEN_END; lex_next(&lex)) {
		if (first && scenario_is_plant(&lex)) {
			lex_next(&lex);
			*out = lex.token;
			return true;
		}
		if (lex.token.kind == TOKEN_SYMBOL && lex_is(&lex, "#"))
			while (lex.at < lex.end && *lex.at != '\n')
				lex.at++; /* a comment */
		first = lex.token.kind == TOKEN_NEWLINE;
	}
	return false;
}

const char *scenario_find_plant(const char *file, const char *text, size_t len,
				struct arena *arena, struct diag *place)
{
	struct token token;
	size_t bad;

	if (!utf8_valid(text, len, &bad) || !scenario_plant_token(text, len, &token))
		return NULL;
	*place = (struct diag){ .file = file, .line = token.line,
				.column = token.column };
	return arena_copy(arena, token.text + 1, token.len - 2);
}
