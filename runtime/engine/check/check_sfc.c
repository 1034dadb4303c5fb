/* SPDX-License-Identifier: MIT
 *
 * check_sfc - steps and transitions of a chart: is it whole?
 *
 * It counts ways in and out; which steps are active together is check_tokens'.
 */
#include "engine/check/sfc_check.h"

#include "engine/model/advice.h"

#include <stdio.h>
#include <string.h>

const char *sfc_name(const struct sfc_check *c, uint32_t id)
{
	return project_text(c->project, id);
}

bool sfc_report(struct sfc_check *c, enum diag_id id, int line, int column,
		const char *arg)
{
	const struct diag place = {
		.id = id, .file = c->pou->file, .line = line, .column = column,
		.pou = sfc_name(c, c->pou->name),
	};
	const bool good = diag_add(c->diags, place, "%s", arg);

	c->good &= good;
	return good;
}

int *sfc_mark(struct sfc_check *c, uint32_t name)
{
	const uint32_t fold = names_fold(&c->project->names, name);

	return fold ? &c->mark[fold] : NULL;
}

/* ---- transitions ---- */

static void report_step(struct sfc_check *c, enum diag_id id, int step)
{
	const struct sfc_step *at = &c->sfc->step[step];

	sfc_report(c, id, at->line, at->column_at, sfc_name(c, at->name));
}

static void report_ref(struct sfc_check *c, enum diag_id id, const struct sfc_ref *ref)
{
	sfc_report(c, id, ref->line, ref->column, sfc_name(c, ref->name));
}

static void report_no_step(struct sfc_check *c, const struct sfc_ref *ref)
{
	char text[LIMIT_ARG];

	advice_word(c->project, c->pou, EXPECT_STEP, c->diags, sfc_name(c, ref->name), text,
		    sizeof(text));
	sfc_report(c, DIAG_SFC_NO_STEP, ref->line, ref->column, text);
}

/* The steps behind FROM or TO; @ways counts them. */
static void check_refs(struct sfc_check *c, const struct sfc_transition *t, int first,
		       int count, int *ways, int *seen, int stamp)
{
	for (int i = first; i < first + count; i++) {
		const struct sfc_ref *ref = &c->sfc->ref[i];

		if (ref->step < 0) {
			report_no_step(c, ref);
			continue;
		}
		if (seen[ref->step] == stamp)
			report_ref(c, DIAG_SFC_STEP_TWICE, ref);
		else if (c->sfc->step[ref->step].macro != t->macro)
			report_ref(c, DIAG_SFC_BORDER, ref);
		seen[ref->step] = stamp;
		ways[ref->step]++;
	}
}

/* What a message calls a transition that may have no name. */
static void transition_text(const struct sfc_check *c, const struct sfc_transition *t,
			    char *out, size_t size)
{
	const struct sfc_ref *ref = c->sfc->ref;

	if (t->name)
		snprintf(out, size, "%s", sfc_name(c, t->name));
	else
		snprintf(out, size, "%.24s%s -> %.24s%s",
			 t->from_count ? sfc_name(c, ref[t->first_from].name) : "?",
			 t->from_count > 1 ? ", ..." : "",
			 t->to_count ? sfc_name(c, ref[t->first_to].name) : "?",
			 t->to_count > 1 ? ", ..." : "");
}

/* @in, @out: by step, how many transitions lead in and out. */
static void check_transitions(struct sfc_check *c, int *in, int *out, int *seen)
{
	for (int i = 0; i < c->sfc->transition_count; i++) {
		const struct sfc_transition *t = &c->sfc->transition[i];
		char text[LIMIT_ARG];

		transition_text(c, t, text, sizeof(text));
		check_refs(c, t, t->first_from, t->from_count, out, seen, 2 * i + 1);
		check_refs(c, t, t->first_to, t->to_count, in, seen, 2 * i + 2);
		if (t->condition.kind == BODY_NONE)
			sfc_report(c, DIAG_SFC_NO_CONDITION, t->line, t->column, text);
	}
}

/* ---- steps ---- */

/* The steps inside @macro, or of the chart itself, that are entered first. */
static int count_initial(const struct sfc *sfc, int macro, int *last)
{
	int count = 0;

	for (int i = 0; i < sfc->step_count; i++) {
		if (sfc->step[i].macro != macro || sfc->step[i].kind != STEP_INITIAL)
			continue;
		*last = i;
		count++;
	}
	return count;
}

/* A step that nothing leaves is the end of a macro-step; one of them must be. */
static void check_exits(struct sfc_check *c, int macro, const int *out)
{
	const struct sfc_step *at = &c->sfc->step[macro];
	char text[2 * LIMIT_ARG];
	size_t used = (size_t)snprintf(text, sizeof(text), "%.40s:",
				       sfc_name(c, at->name));
	int steps = 0, exits = 0;

	for (int i = 0; i < c->sfc->step_count; i++) {
		if (c->sfc->step[i].macro != macro)
			continue;
		steps++;
		if (out[i])
			continue;
		if (used < LIMIT_ARG)
			used += (size_t)snprintf(text + used, sizeof(text) - used,
				"%s %.40s", exits ? "," : "",
				sfc_name(c, c->sfc->step[i].name));
		exits++;
	}
	if (steps && exits != 1)
		sfc_report(c, DIAG_SFC_MACRO_EXIT, at->line, at->column_at,
			   exits ? text : sfc_name(c, at->name));
}

static void check_macro(struct sfc_check *c, int macro, const int *out)
{
	int last = macro;
	const int initial = count_initial(c->sfc, macro, &last);

	if (initial == 0)
		report_step(c, DIAG_SFC_NO_INITIAL, macro);
	else if (initial > 1)
		report_step(c, DIAG_SFC_TWO_INITIAL, last);
	check_exits(c, macro, out);
}

/* A step that nothing leaves may wait for what comes from outside. */
static bool can_be_reset(const struct sfc *sfc)
{
	return sfc->control[CONTROL_RESET] || sfc->control[CONTROL_FORCE];
}

/* A transition out of nothing, which only a chart IN ORDER can have. */
static bool has_source(const struct sfc *sfc)
{
	for (int i = 0; i < sfc->transition_count; i++)
		if (!sfc->transition[i].from_count)
			return sfc->evolution == EVOLVE_IN_ORDER;
	return false;
}

static void check_steps(struct sfc_check *c, const int *in, const int *out)
{
	const struct sfc *sfc = c->sfc;
	int last;

	if (count_initial(sfc, -1, &last) == 0 && !has_source(sfc))
		sfc_report(c, DIAG_SFC_NO_INITIAL, c->pou->line, 0,
			   sfc_name(c, c->pou->name));
	for (int i = 0; i < sfc->step_count; i++) {
		const struct sfc_step *step = &sfc->step[i];

		if (step->kind == STEP_MACRO)
			check_macro(c, i, out);
		if (!in[i] && step->kind != STEP_INITIAL)
			report_step(c, DIAG_SFC_NO_WAY_IN, i);
		if (!out[i] && step->macro < 0 && !can_be_reset(sfc))
			report_step(c, DIAG_SFC_NO_WAY_OUT, i);
	}
}

static int *numbers(struct sfc_check *c, int count)
{
	return arena_alloc(c->scratch, ((size_t)count + 1) * sizeof(int));
}

bool check_sfc(struct scope *scope, const struct pou *pou, struct arena *scratch,
	       struct diag_list *diags)
{
	struct sfc_check c = {
		.scope = scope, .project = scope_project(scope), .pou = pou,
		.sfc = pou->sfc, .scratch = scratch, .diags = diags,
		.good = true,
	};
	int *in = numbers(&c, c.sfc->step_count);
	int *out = numbers(&c, c.sfc->step_count);
	int *seen = numbers(&c, c.sfc->step_count);

	c.mark = numbers(&c, c.project->names.count);
	if (!in || !out || !seen || !c.mark)
		return false; /* the arena tells */
	check_transitions(&c, in, out, seen);
	check_steps(&c, in, out);
	sfc_check_lines(&c);
	sfc_check_bodies(&c);
	return c.good;
}
