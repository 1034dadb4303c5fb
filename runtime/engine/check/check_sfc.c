/* SPDX-License-Identifier: MIT
 *
 * check_sfc - is a chart complete: steps, transitions, actions?
 *
 * It counts the ways into and out of each step. check_tokens finds which steps are active
 * together.
 */
#include "engine/check/check_sfc.h"

#include "engine/model/advice.h"

#include <stdio.h>
#include <string.h>

struct sfc_check {
	struct scope *scope;
	struct project *project;
	const struct pou *pou;
	const struct sfc *sfc;
	struct arena *scratch;
	struct diag_list *diags;
	int *mark;                /* by folded name: where a label stood last     */
	bool good;
};

/* The text of an id. */
static const char *sfc_name(const struct sfc_check *c, uint32_t id)
{
	return project_text(c->project, id);
}

/* A diagnostic with a line and column of the chart. False: an error. */
static bool sfc_report(struct sfc_check *c, enum diag_id id, int line, int column,
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

/* The name of a transition for a message, also when it has none. */
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

/* Counts the steps inside @macro, or of the chart itself, that are entered first. */
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

/* Requires that a macro-step has one end: a step without a transition out of it. */
static void check_exits(struct sfc_check *c, int macro, const int *out)
{
	const struct sfc_step *at = &c->sfc->step[macro];
	char text[2 * LIMIT_ARG];
	size_t used = (size_t)snprintf(text, sizeof(text), "%.30s" DIAG_AND,
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
				"%s%.30s", exits ? ", " : "",
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

/* Warns of a step that nothing leaves, unless something from outside can. */
static bool can_be_reset(const struct sfc *sfc)
{
	return sfc->control[CONTROL_RESET] || sfc->control[CONTROL_FORCE];
}

/* A transition without a step before it, allowed only IN ORDER. */
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

/* ---- the one rung of a condition ---- */

static bool is_condition(const struct sfc_check *c, uint32_t operand)
{
	enum diag_id why;
	const struct meaning *m = scope_find(c->scope, c->pou, operand, &why);

	return m && scope_is_condition(m);
}

/* Its output is COIL TRANSITION or its inverse, and there is no other. */
static bool has_one_coil(const struct sfc_check *c, const struct rung *rung)
{
	int outputs = 0, coils = 0;

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];
		const enum word word = (enum word)cell->word;

		if (words_row(&c->project->words, word)->place != PLACE_LAST)
			continue;
		outputs++;
		coils += (word == ELEM_COIL || word == ELEM_COIL_NOT) &&
			 is_condition(c, cell->operand);
	}
	return outputs == 1 && coils == 1;
}

static void check_rung_of(struct sfc_check *c, const struct sfc_transition *t)
{
	const struct sfc_body *body = &t->condition;
	const struct rung *rung = body->count ? c->pou->rung[body->first] : NULL;
	const char *name = sfc_name(c, t->name);

	if (!rung || rung->off)
		sfc_report(c, DIAG_SFC_NO_CONDITION, t->line, t->column, name);
	else if (body->count > 1 || !has_one_coil(c, rung))
		sfc_report(c, DIAG_SFC_CONDITION_RUNG, rung_line(rung, 0), 0, name);
}

/* ---- lists ---- */

static void report_line(struct sfc_check *c, enum diag_id id, const struct il_line *line)
{
	sfc_report(c, id, (int)line->line, line->col, sfc_name(c, line->operand));
}

static bool is_jump(const struct il_line *line)
{
	return line->kind == IL_OP && line->op == OP_JMP;
}

static int *mark_of(struct sfc_check *c, const struct il_line *line)
{
	const uint32_t fold = names_fold(&c->project->names, line->operand);

	return fold ? &c->mark[fold] : NULL;
}

/* @key: another for each list. */
static void check_labels(struct sfc_check *c, const struct sfc_body *body, int key)
{
	const struct il_line *line = c->pou->il.line;
	int *mark;

	for (int i = body->first; i < body->first + body->count; i++) {
		mark = line[i].kind == IL_LABEL ? mark_of(c, &line[i]) : NULL;
		if (mark && *mark == key)
			report_line(c, DIAG_DUPLICATE_LABEL, &line[i]);
		if (mark)
			*mark = key;
	}
	for (int i = body->first; i < body->first + body->count; i++) {
		mark = is_jump(&line[i]) ? mark_of(c, &line[i]) : NULL;
		if (mark && *mark != key)
			report_line(c, DIAG_NO_LABEL, &line[i]);
	}
}

static bool is_empty(const struct sfc_check *c, const struct sfc_body *body)
{
	for (int i = body->first; i < body->first + body->count; i++)
		if (c->pou->il.line[i].kind != IL_COMMENT &&
		    c->pou->il.line[i].kind != IL_LABEL)
			return false;
	return true;
}

static void sfc_check_bodies(struct sfc_check *c)
{
	const struct sfc *sfc = c->sfc;

	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		if (t->condition.kind == BODY_RUNGS)
			check_rung_of(c, t);
		if (t->condition.kind == BODY_LIST && is_empty(c, &t->condition))
			sfc_report(c, DIAG_SFC_NO_CONDITION, t->line, t->column,
				   sfc_name(c, t->name));
	}
	for (int i = 0; i < sfc_bodies(sfc); i++)
		if (sfc_body(sfc, i)->kind == BODY_LIST)
			check_labels(c, sfc_body(sfc, i), i + 1);
}

/* ---- supervision ---- */

/* Is the time a constant? */
static bool is_fixed(struct sfc_check *c, uint32_t text, int64_t *ns)
{
	enum diag_id why;
	const struct meaning *m = text ? scope_find(c->scope, c->pou, text, &why) : NULL;

	if (!m || m->type != IEC_TIME)
		return false;
	if (m->kind == MEANING_LITERAL)
		*ns = m->literal.value.i;
	else if (m->kind == MEANING_VARIABLE && m->constant && m->var->has_init)
		*ns = m->var->init.i;
	else
		return false;
	return true;
}

static void check_supervision(struct sfc_check *c, const struct sfc_step *step)
{
	const bool times = step->min || step->max;
	const char *name = sfc_name(c, step->name);
	int64_t least, most;

	if (is_fixed(c, step->min, &least) && is_fixed(c, step->max, &most) &&
	    most < least)
		sfc_report(c, DIAG_SFC_TIMES_CROSS, step->line, step->column_at, name);
	if (times != (step->alarm != 0))
		sfc_report(c, times ? DIAG_SFC_NO_ALARM : DIAG_SFC_ALARM_ALONE,
			   step->line, step->column_at, name);
}

/* ---- lines ---- */

static void check_line(struct sfc_check *c, const struct sfc_use *use, uint8_t *called)
{
	const bool wanted = qualifier_has_time(use->qualifier);

	if (use->kind != USE_ACTION) {
		if (use->action >= 0)
			sfc_report(c, DIAG_SFC_SET_ACTION, use->line, use->column,
				   sfc_name(c, use->operand));
		return;
	}
	if (wanted != (use->time != 0))
		sfc_report(c, wanted ? DIAG_SFC_NEEDS_TIME : DIAG_SFC_NO_TIME,
			   use->line, use->column, qualifier_word(use->qualifier));
	if (use->action >= 0)
		called[use->action] = 1;
}

static void check_control(struct sfc_check *c)
{
	const uint32_t *control = c->sfc->control;

	if ((control[CONTROL_SEMI] || control[CONTROL_MANUAL]) && !control[CONTROL_TIP])
		sfc_report(c, DIAG_SFC_NO_TIP, c->sfc->control_line, 0, "");
}

static void sfc_check_lines(struct sfc_check *c)
{
	const struct sfc *sfc = c->sfc;
	uint8_t *called = arena_alloc(c->scratch, (size_t)sfc->action_count + 1);

	for (int i = 0; i < sfc->step_count; i++)
		check_supervision(c, &sfc->step[i]);
	for (int i = 0; called && i < sfc->use_count; i++)
		check_line(c, &sfc->use[i], called);
	for (int i = 0; called && i < sfc->action_count; i++)
		if (!called[i])
			sfc_report(c, DIAG_SFC_NOT_CALLED, sfc->action[i].line,
				   sfc->action[i].column,
				   sfc_name(c, sfc->action[i].name));
	check_control(c);
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
