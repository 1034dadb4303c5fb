/* SPDX-License-Identifier: MIT
 *
 * plcopen_write_sfc - charts as steps, transitions, divergences and convergences.
 *
 * A step has one connection from above at most; each other transition that leads to it ends in a
 * jump. Steps stand in the rows in which they are first reached.
 */
#include "engine/exchange/plcopen/plcopen_out.h"

#include "engine/model/st.h"
#include "engine/text/text.h"
#include "engine/text/writer.h"

#include <stdlib.h>
#include <string.h>

enum { LEFT = 100, COLUMN = 240, ROW = 160, STEP_WIDTH = 100, STEP_HEIGHT = 30 };

struct chart {
	struct out *out;
	const struct pou *pou;
	const struct sfc *sfc;
	int macro;              /* the macro-step whose inside it is; -1: the POU  */
	int *row;               /* of each step; -1: not reached yet               */
	int *entry;             /* of each step: the transition above it; -1: none */
	int *step_id, *leaves;  /* of each step: its localId; what transitions leave from */
	int *transition_id, *enters; /* of each transition: what leads to its steps */
	int *order, orders;     /* transitions as they stand in the drawing         */
};

static bool inside(const struct chart *c, int step)
{
	return step >= 0 && c->sfc->step[step].macro == c->macro;
}

static const struct sfc_ref *from_of(const struct chart *c, const struct sfc_transition *t)
{
	return c->sfc->ref + t->first_from;
}

static const struct sfc_ref *to_of(const struct chart *c, const struct sfc_transition *t)
{
	return c->sfc->ref + t->first_to;
}

static bool leads_from(const struct chart *c, const struct sfc_transition *t, int step)
{
	for (int i = 0; i < t->from_count; i++)
		if (from_of(c, t)[i].step == step)
			return true;
	return false;
}

/* ---- rows ---- */

static int row_of_transition(const struct chart *c, const struct sfc_transition *t)
{
	int row = 0;

	for (int i = 0; i < t->from_count; i++)
		if (from_of(c, t)[i].step >= 0 && c->row[from_of(c, t)[i].step] > row)
			row = c->row[from_of(c, t)[i].step];
	return row;
}

/* Steps that are reached from those of @row get the next one; the first way to one is drawn. */
static bool reach(struct chart *c, int row)
{
	bool any = false;

	for (int i = 0; i < c->sfc->transition_count; i++) {
		const struct sfc_transition *t = &c->sfc->transition[i];
		bool ready = t->macro == c->macro && t->from_count > 0;

		for (int k = 0; k < t->from_count; k++)
			ready = ready && inside(c, from_of(c, t)[k].step) && c->row[from_of(c, t)[k].step] >= 0;
		ready = ready && row_of_transition(c, t) == row;
		for (int k = 0; ready && k < t->to_count; k++) {
			const int step = to_of(c, t)[k].step;

			if (!inside(c, step) || c->row[step] >= 0)
				continue;
			c->row[step] = row + 1;
			c->entry[step] = i;
			any = true;
		}
	}
	return any;
}

static void find_rows(struct chart *c)
{
	int last = 0;

	for (int i = 0; i < c->sfc->step_count; i++) {
		c->row[i] = inside(c, i) && c->sfc->step[i].kind == STEP_INITIAL ? 0 : -1;
		c->entry[i] = -1;
	}
	for (int i = 0; i < c->sfc->step_count; i++) {
		while (reach(c, last))
			last++;
		if (inside(c, i) && c->row[i] < 0)
			c->row[i] = ++last;
	}
	while (reach(c, last))
		last++;
}

/* Transitions as they stand: by their row, then in the order of the file. */
static void find_order(struct chart *c)
{
	for (int row = -1; row <= c->sfc->step_count; row++)
		for (int i = 0; i < c->sfc->transition_count; i++)
			if (c->sfc->transition[i].macro == c->macro &&
			    row_of_transition(c, &c->sfc->transition[i]) == row)
				c->order[c->orders++] = i;
}

/* ---- elements ---- */

static void put_position(struct out *out, int x, int y)
{
	plco_line(out, "position x=\"%d\" y=\"%d\"", x, y);
}

static void put_in(struct out *out, int id)
{
	plco_open(out, "connectionPointIn");
	plco_line(out, "connection refLocalId=\"%d\"", id);
	plco_close(out, "connectionPointIn");
}

static int y_of_row(const struct chart *c, int row)
{
	return c->out->y + row * ROW;
}

/* Beside others of its row, in the order of the file. */
static int column_of(const struct chart *c, int step)
{
	int column = 0;

	for (int i = 0; i < step; i++)
		column += inside(c, i) && c->row[i] == c->row[step];
	return column;
}

static int uses_of(const struct chart *c, int step)
{
	int count = 0;

	for (int i = 0; i < c->sfc->transition_count; i++)
		count += leads_from(c, &c->sfc->transition[i], step);
	return count;
}

static void put_body(struct chart *c, const struct sfc_body *body, const char *coil);

static void put_inline(struct chart *c, const struct sfc_use *use)
{
	struct out *out = c->out;

	plco_open(out, "action localId=\"%d\" qualifier=\"P1\"", ++out->ids);
	plco_line(out, "relPosition x=\"0\" y=\"0\"");
	plco_open(out, "inline");
	plco_formatted(out, "ST", plco_print(out, "%s := %s;", plco_id(out, use->operand),
					   use->kind == USE_SET ? "TRUE" : "FALSE"));
	plco_close(out, "inline");
	plco_close(out, "action");
}

static void put_use(struct chart *c, const struct sfc_use *use)
{
	struct out *out = c->out;

	if (use->kind != USE_ACTION) {
		put_inline(c, use);
		return;
	}
	if (use->time)
		plco_open(out, "action localId=\"%d\" qualifier=\"%s\" duration=\"%s\"", ++out->ids,
			 qualifier_word(use->qualifier), plco_id(out, use->time));
	else
		plco_open(out, "action localId=\"%d\" qualifier=\"%s\"", ++out->ids, qualifier_word(use->qualifier));
	plco_line(out, "relPosition x=\"0\" y=\"0\"");
	plco_named(out, "reference", "name", plco_id(out, use->operand), true);
	plco_documentation(out, plco_id(out, use->comment));
	plco_close(out, "action");
}

static void put_uses(struct chart *c, int number)
{
	const struct sfc_step *step = &c->sfc->step[number];
	struct out *out = c->out;

	if (!step->use_count)
		return;
	plco_open(out, "actionBlock localId=\"%d\" height=\"%d\" width=\"%d\"", ++out->ids, 20 * step->use_count,
		 STEP_WIDTH);
	put_position(out, LEFT + column_of(c, number) * COLUMN + STEP_WIDTH + 20, y_of_row(c, c->row[number]));
	put_in(out, c->step_id[number]);
	for (int i = 0; i < step->use_count; i++)
		put_use(c, &c->sfc->use[step->first_use + i]);
	plco_close(out, "actionBlock");
}

static void put_chart(struct out *out, const struct pou *pou, int macro);

static void report_step(struct chart *c, const struct sfc_step *step)
{
	if (step->min || step->max || step->alarm)
		plco_lost(c->out, REPORT_LOST, step->line, 0, report_said(c->out->report,
			 REPORTED("the format has no supervision: MIN, MAX and ALARM of the step %s are left out")),
			 plco_id(c->out, step->name));
}

static void put_step(struct chart *c, int number)
{
	const struct sfc_step *step = &c->sfc->step[number];
	const bool macro = step->kind == STEP_MACRO;
	const char *element = macro ? "macroStep" : "step";
	struct out *out = c->out;

	report_step(c, step);
	plco_open(out, "%s localId=\"%d\" height=\"%d\" width=\"%d\" name=\"%s\"%s", element, c->step_id[number],
		 STEP_HEIGHT, STEP_WIDTH, plco_id(out, step->name),
		 step->kind == STEP_INITIAL ? " initialStep=\"true\"" : "");
	put_position(out, LEFT + column_of(c, number) * COLUMN, y_of_row(c, c->row[number]));
	if (c->entry[number] >= 0)
		put_in(out, c->enters[c->entry[number]]);
	if (macro) {
		plco_line(out, "connectionPointOut");
		plco_open(out, "body");
		put_chart(out, c->pou, number);
		plco_close(out, "body");
	} else {
		plco_line(out, "connectionPointOut formalParameter=\"\"");
		plco_line(out, "connectionPointOutAction formalParameter=\"\"");
	}
	plco_documentation(out, plco_id(out, step->comment));
	plco_close(out, element);
	put_uses(c, number);
	if (c->leaves[number] == c->step_id[number])
		return;
	plco_open(out, "selectionDivergence localId=\"%d\" height=\"1\" width=\"%d\"", c->leaves[number], COLUMN);
	put_position(out, LEFT + column_of(c, number) * COLUMN, y_of_row(c, c->row[number]) + 40);
	put_in(out, c->step_id[number]);
	plco_line(out, "connectionPointOut formalParameter=\"\"");
	plco_close(out, "selectionDivergence");
}

/* ---- conditions ---- */

static const char *expression_of(struct chart *c, const struct sfc_body *body)
{
	const struct rung *rung = c->pou->rung[body->first];
	const struct cell *cell = rung_at(rung, 0, 0);
	const char *text = plco_id(c->out, cell->operand);

	return cell->word == ELEM_CONTACT_NC ? plco_print(c->out, "NOT %s", text) : text;
}

static const char *condition_name(struct chart *c, int number)
{
	const struct sfc_transition *t = &c->sfc->transition[number];

	return t->name ? plco_id(c->out, t->name) : plco_print(c->out, "Condition%d", number + 1);
}

static void put_condition(struct chart *c, int number)
{
	const struct sfc_body *body = &c->sfc->transition[number].condition;
	struct out *out = c->out;

	plco_open(out, "condition");
	if (body->kind == BODY_EXPRESSION) {
		plco_named(out, "inline", "name", "", false);
		plco_formatted(out, "ST", plco_words(out, expression_of(c, body)));
		plco_close(out, "inline");
	} else {
		plco_named(out, "reference", "name", condition_name(c, number), true);
	}
	plco_close(out, "condition");
}

static int x_of_transition(const struct chart *c, int number)
{
	int column = 0;

	for (int i = 0; i < number; i++)
		column += c->sfc->transition[i].macro == c->macro &&
			  row_of_transition(c, &c->sfc->transition[i]) ==
			  row_of_transition(c, &c->sfc->transition[number]);
	return LEFT + column * COLUMN;
}

static int y_of_transition(const struct chart *c, int number)
{
	return y_of_row(c, row_of_transition(c, &c->sfc->transition[number])) + 90;
}

/* What the transition comes from: a step, a choice, or the end of simultaneous steps. */
static int put_join(struct chart *c, int number)
{
	const struct sfc_transition *t = &c->sfc->transition[number];
	struct out *out = c->out;
	int id;

	if (t->from_count < 2)
		return t->from_count && from_of(c, t)[0].step >= 0 ? c->leaves[from_of(c, t)[0].step] : 0;
	id = ++out->ids;
	plco_open(out, "simultaneousConvergence localId=\"%d\" height=\"3\" width=\"%d\"", id, COLUMN);
	put_position(out, x_of_transition(c, number), y_of_transition(c, number) - 20);
	for (int i = 0; i < t->from_count; i++)
		if (from_of(c, t)[i].step >= 0)
			put_in(out, c->leaves[from_of(c, t)[i].step]);
	plco_line(out, "connectionPointOut");
	plco_close(out, "simultaneousConvergence");
	return id;
}

static void put_targets(struct chart *c, int number)
{
	const struct sfc_transition *t = &c->sfc->transition[number];
	struct out *out = c->out;

	if (t->to_count > 1) {
		plco_open(out, "simultaneousDivergence localId=\"%d\" height=\"3\" width=\"%d\"", c->enters[number],
			 COLUMN);
		put_position(out, x_of_transition(c, number), y_of_transition(c, number) + 20);
		put_in(out, c->transition_id[number]);
		plco_line(out, "connectionPointOut formalParameter=\"\"");
		plco_close(out, "simultaneousDivergence");
	}
	for (int i = 0; i < t->to_count; i++) {
		const int step = to_of(c, t)[i].step;

		if (step >= 0 && c->entry[step] == number)
			continue;
		plco_open(out, "jumpStep localId=\"%d\" height=\"20\" width=\"20\" targetName=\"%s\"", ++out->ids,
			 plco_id(out, to_of(c, t)[i].name));
		put_position(out, x_of_transition(c, number), y_of_transition(c, number) + 40);
		put_in(out, c->enters[number]);
		plco_close(out, "jumpStep");
	}
}

static void put_transition(struct chart *c, int number)
{
	const struct sfc_transition *t = &c->sfc->transition[number];
	const int from = put_join(c, number);
	struct out *out = c->out;

	if (t->priority)
		plco_open(out, "transition localId=\"%d\" height=\"10\" width=\"20\" priority=\"%d\"",
			 c->transition_id[number], t->priority);
	else
		plco_open(out, "transition localId=\"%d\" height=\"10\" width=\"20\"", c->transition_id[number]);
	put_position(out, x_of_transition(c, number), y_of_transition(c, number));
	if (from)
		put_in(out, from);
	plco_line(out, "connectionPointOut");
	put_condition(c, number);
	plco_documentation(out, plco_id(out, t->comment));
	plco_close(out, "transition");
	put_targets(c, number);
}

/* ---- the chart ---- */

static bool give_ids(struct chart *c)
{
	const size_t steps = sizeof(int) * ((size_t)c->sfc->step_count + 1);
	const size_t transitions = sizeof(int) * ((size_t)c->sfc->transition_count + 1);

	c->row = arena_alloc(c->out->arena, steps);
	c->entry = arena_alloc(c->out->arena, steps);
	c->step_id = arena_alloc(c->out->arena, steps);
	c->leaves = arena_alloc(c->out->arena, steps);
	c->transition_id = arena_alloc(c->out->arena, transitions);
	c->enters = arena_alloc(c->out->arena, transitions);
	c->order = arena_alloc(c->out->arena, transitions);
	if (!c->row || !c->entry || !c->step_id || !c->leaves || !c->transition_id || !c->enters || !c->order)
		return false;
	find_rows(c);
	find_order(c);
	for (int i = 0; i < c->sfc->step_count; i++) {
		c->step_id[i] = inside(c, i) ? ++c->out->ids : 0;
		c->leaves[i] = inside(c, i) && uses_of(c, i) > 1 ? ++c->out->ids : c->step_id[i];
	}
	for (int i = 0; i < c->orders; i++) {
		const int t = c->order[i];

		c->transition_id[t] = ++c->out->ids;
		c->enters[t] = c->sfc->transition[t].to_count > 1 ? ++c->out->ids : c->transition_id[t];
	}
	return true;
}

static void put_chart(struct out *out, const struct pou *pou, int macro)
{
	struct chart c = { .out = out, .pou = pou, .sfc = pou->sfc, .macro = macro };

	if (!give_ids(&c))
		return;
	plco_open(out, "SFC");
	for (int i = 0; i < c.sfc->step_count; i++)
		if (inside(&c, i))
			put_step(&c, i);
	for (int i = 0; i < c.orders; i++)
		put_transition(&c, c.order[i]);
	plco_close(out, "SFC");
}

void plco_chart(struct out *out, const struct pou *pou)
{
	out->y = 40;
	if (pou->sfc->evolution != EVOLVE_ONCE)
		plco_lost(out, REPORT_LOST, pou->line, 0, report_said(out->report,
			 REPORTED("the format does not say how a chart moves on: %s is left out")),
			 sfc_evolution_words(pou->sfc->evolution));
	for (int i = 0; i < CONTROL_COUNT; i++)
		if (pou->sfc->control[i])
			plco_lost(out, REPORT_LOST, pou->sfc->control_line, 0, report_said(out->report,
				 REPORTED("the format has no CONTROL: %s is left out")), control_word((enum control)i));
	put_chart(out, pou, -1);
}

/* ---- bodies with a name ---- */

static void put_text(struct chart *c, const struct sfc_body *body)
{
	const struct sink before = c->out->sink;
	struct sink_memory memory;

	sink_memory_init(&memory);
	c->out->sink = sink_to_memory(&memory);
	if (body->kind == BODY_LIST)
		text_write_il(c->out->project, &(struct il){ .line = c->pou->il.line + body->first,
							     .count = body->count }, &c->out->sink);
	else if (body->kind == BODY_ST)
		text_write_st(c->out->project, &(struct st){ .item = c->pou->st->item + body->first,
							     .count = body->count }, &c->out->sink);
	c->out->sink = before;
	plco_formatted(c->out, body->kind == BODY_LIST ? "IL" : "ST", plco_words(c->out, sink_memory_text(&memory)));
	sink_memory_free(&memory);
}

/* @coil: replaces TRANSITION, which the coil of a condition has; NULL: of an action. */
static void put_body(struct chart *c, const struct sfc_body *body, const char *coil)
{
	plco_open(c->out, "body");
	c->out->ids = c->out->y = 0;
	if (body->kind == BODY_RUNGS) {
		c->out->coil = coil;
		plco_open(c->out, "LD");
		plco_rungs(c->out, c->pou, body->first, body->count);
		plco_close(c->out, "LD");
		c->out->coil = NULL;
	} else {
		put_text(c, body);
	}
	plco_close(c->out, "body");
}

void plco_chart_actions(struct out *out, const struct pou *pou)
{
	struct chart c = { .out = out, .pou = pou, .sfc = pou->sfc, .macro = -1 };

	for (int i = 0; i < c.sfc->action_count; i++) {
		plco_named(out, "action", "name", plco_id(out, c.sfc->action[i].name), false);
		put_body(&c, &c.sfc->action[i].body, NULL);
		plco_documentation(out, plco_id(out, c.sfc->action[i].comment));
		plco_close(out, "action");
	}
}

void plco_chart_transitions(struct out *out, const struct pou *pou)
{
	struct chart c = { .out = out, .pou = pou, .sfc = pou->sfc, .macro = -1 };
	bool any = false;

	for (int i = 0; i < c.sfc->transition_count; i++) {
		if (c.sfc->transition[i].condition.kind == BODY_EXPRESSION)
			continue;
		if (!any)
			plco_open(out, "transitions");
		any = true;
		plco_named(out, "transition", "name", condition_name(&c, i), false);
		put_body(&c, &c.sfc->transition[i].condition, condition_name(&c, i));
		plco_close(out, "transition");
	}
	if (any)
		plco_close(out, "transitions");
}
