/* SPDX-License-Identifier: MIT
 *
 * sfc_lines - the walker's qualifiers: the actions and BOOLs that the lines of steps
 * call, and their execution (docs/sfc.md, Qualifiers).
 */
#include "tests/walker/sfc_inside.h"

#include <string.h>

/* ---- made once ---- */

static struct target *new_target(struct played_sfc *played)
{
	return &played->target[played->target_count++];
}

/* Whether two texts mean the same bit. */
static bool is_one(const struct placed *a, const struct placed *b)
{
	if (a->kind != b->kind || a->index || b->index)
		return false;
	if (a->kind == PLACED_VALUE)
		return a->value == b->value;
	return a->kind == PLACED_AREA && a->byte == b->byte && a->bit == b->bit;
}

/* The BOOL of this name, perhaps from an earlier line. */
static int bool_named(struct walker *walker, struct played_sfc *played, uint32_t name)
{
	const char *text = project_text(walker->project, name);
	uint32_t fold = names_fold(&walker->project->names, name);
	struct target *target;

	const struct placed place = walker_place(walker, played->walked->frame, text,
						 strlen(text));

	for (int i = 0; i < played->target_count; i++)
		if (!played->target[i].action && (played->target[i].fold == fold ||
						  is_one(&played->target[i].place, &place)))
			return i;
	target = new_target(played);
	target->fold = fold;
	target->place = place;
	walker->why = text;
	return target->place.kind == PLACED_NOWHERE ? -1 : played->target_count - 1;
}

static bool make_line(struct walker *walker, struct played_sfc *played,
		      const struct sfc_use *use)
{
	struct played_line *line = &played->line[played->line_count++];
	const char *time = project_text(walker->project, use->time);

	line->use = use;
	line->target = use->action >= 0 ? use->action :
		       bool_named(walker, played, use->operand);
	if (use->time)
		line->time = walker_place(walker, played->walked->frame, time,
					  strlen(time));
	return line->target >= 0 && (!use->time || line->time.kind != PLACED_NOWHERE);
}

static bool make_once(struct walker *walker, struct played_sfc *played,
		      const struct sfc_use *use)
{
	struct once *once = &played->once[played->once_count++];
	const char *text = project_text(walker->project, use->operand);

	once->use = use;
	once->place = walker_place(walker, played->walked->frame, text, strlen(text));
	walker->why = text;
	return once->place.kind != PLACED_NOWHERE;
}

bool lines_make(struct walker *walker, struct played_sfc *played)
{
	const struct sfc *sfc = played->sfc;
	size_t lines = (size_t)sfc->use_count + 1;
	size_t targets = lines + (size_t)sfc->action_count;

	played->line = arena_alloc(&walker->arena, lines * sizeof(*played->line));
	played->once = arena_alloc(&walker->arena, lines * sizeof(*played->once));
	played->target = arena_alloc(&walker->arena, targets * sizeof(*played->target));
	if (!played->line || !played->once || !played->target)
		return false;
	for (int i = 0; i < sfc->action_count; i++)
		new_target(played)->action = &sfc->action[i];
	for (int i = 0; i < sfc->step_count; i++)
		for (int k = 0; k < sfc->step[i].use_count; k++) {
			const struct sfc_use *use = &sfc->use[sfc->step[i].first_use + k];

			if (use->kind == USE_ACTION ? !make_line(walker, played, use) :
						      !make_once(walker, played, use))
				return false;
		}
	return true;
}

/* ---- activation and deactivation ---- */

void lines_once(struct walker *walker, struct played_sfc *played, int step)
{
	for (int i = 0; i < played->once_count; i++) {
		const struct once *once = &played->once[i];
		struct placed here;

		if (once->use->step == step && placed_find(walker, &once->place, &here))
			placed_write(&here, value_bool(once->use->kind == USE_SET));
	}
}

void lines_pass_time(struct played_sfc *played, int64_t passed)
{
	for (int i = 0; i < played->line_count; i++)
		played->line[i].elapsed += passed;
}

static void forget(struct played_line *line)
{
	line->waits = false;
	line->stored = false;
}

void lines_forget(struct played_sfc *played)
{
	for (int i = 0; i < played->line_count; i++)
		forget(&played->line[i]);
}

static void begin_line(struct played_line *line, const struct played_step *step)
{
	enum qualifier qualifier = line->use->qualifier;

	if (qualifier == QUALIFIER_S)
		line->stored |= step->entered;
	if (qualifier == QUALIFIER_SD || qualifier == QUALIFIER_SL) {
		if (step->entered && !line->waits)
			line->elapsed = 0;
		line->waits |= step->entered;
	}
	if (qualifier == QUALIFIER_DS) {
		line->waits = value_is_true(*step->x) && (line->waits || step->entered);
		if (line->waits && step->t->i >= sfc_time(&line->time))
			line->stored = true;
	}
}

/* Whether an R of this target is active. */
static void end_lines(struct played_sfc *played, int target)
{
	for (int i = 0; i < played->line_count; i++)
		if (played->line[i].target == target)
			forget(&played->line[i]);
}

static void begin_and_end(struct played_sfc *played)
{
	for (int i = 0; i < played->line_count; i++)
		begin_line(&played->line[i], &played->step[played->line[i].use->step]);
	for (int i = 0; i < played->line_count; i++) {
		const struct played_line *line = &played->line[i];
		const struct played_step *step = &played->step[line->use->step];

		if (line->use->qualifier == QUALIFIER_R &&
		    (value_is_true(*step->x) || step->entered))
			end_lines(played, line->target);
	}
}

/* ---- calls ---- */

static bool calls(const struct played_sfc *played, const struct played_line *line)
{
	const struct played_step *step = &played->step[line->use->step];
	bool x = value_is_true(*step->x);

	switch (line->use->qualifier) {
	case QUALIFIER_N:
		return x;
	case QUALIFIER_S:
	case QUALIFIER_DS:
		return line->stored;
	case QUALIFIER_L:
		return x && step->t->i < sfc_time(&line->time);
	case QUALIFIER_D:
		return x && step->t->i >= sfc_time(&line->time);
	case QUALIFIER_P:
	case QUALIFIER_P1:
		return step->entered;
	case QUALIFIER_P0:
		return step->left;
	case QUALIFIER_SD:
		return line->waits && line->elapsed >= sfc_time(&line->time);
	case QUALIFIER_SL:
		return line->waits && line->elapsed < sfc_time(&line->time);
	case QUALIFIER_R:
	case QUALIFIER_COUNT:
		break;
	}
	return false;
}

static bool reads_late(const struct played_line *line)
{
	return line->use->qualifier == QUALIFIER_SD || line->use->qualifier == QUALIFIER_SL;
}

/* Whether the target is called; *@in_passing: only by P0 and P1. */
static bool is_called(const struct played_sfc *played, int target, bool *in_passing)
{
	bool called = false;

	*in_passing = true;
	for (int i = 0; i < played->line_count; i++) {
		const struct played_line *line = &played->line[i];
		const struct played_step *step = &played->step[line->use->step];
		enum qualifier qualifier = line->use->qualifier;

		if (line->target != target)
			continue;
		if (qualifier == QUALIFIER_R && value_is_true(*step->x))
			return false;
		if (!(reads_late(line) ? calls(played, line) : line->calls))
			continue;
		called = true;
		if (qualifier != QUALIFIER_P0 && qualifier != QUALIFIER_P1)
			*in_passing = false;
	}
	return called;
}

static bool run_body(struct walker *walker, struct played_sfc *played,
		     const struct sfc_body *body)
{
	struct value result;

	if (body->kind == BODY_LIST)
		return walk_list(walker, played->walked, body, &result);
	if (body->kind == BODY_ST)
		return walk_statements(walker, played->walked, body->first, body->count);
	return walk_rungs(walker, played->walked, body->first, body->count);
}

/* One target: it runs once more in the scan after its last call. */
static bool act(struct walker *walker, struct played_sfc *played, struct target *target)
{
	bool last = target->was_called && !target->called, good = true;
	struct placed here;

	if (!target->action) {
		if ((target->called || last) &&
		    placed_find(walker, &target->place, &here))
			placed_write(&here, value_bool(target->called));
	} else if (target->called || (last && !target->was_in_passing)) {
		good = run_body(walker, played, &target->action->body);
	}
	target->was_called = target->called;
	target->was_in_passing = target->in_passing;
	return good;
}

/* The calls are determined before any action runs, except for the times of SD and SL,
 * which are read as late as possible. */
bool lines_act(struct walker *walker, struct played_sfc *played)
{
	begin_and_end(played);
	for (int i = 0; i < played->line_count; i++)
		if (!reads_late(&played->line[i]))
			played->line[i].calls = calls(played, &played->line[i]);
	for (int i = 0; i < played->target_count; i++) {
		struct target *target = &played->target[i];

		target->called = is_called(played, i, &target->in_passing);
		if (!act(walker, played, target))
			return false;
	}
	return true;
}
