/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_steps - writes the program that moves from step to step, and the program of the
 * actions.
 *
 * The order of rungs is that of a scan in docs/sfc.md: times, supervision, transitions that
 * fire, steps that begin and end, resets before sets, SET and RESET.
 */
#include "engine/exchange/classic/sfc_ladder_parts.h"
#include "engine/model/st.h"
#include "engine/text/text.h"

#include <stdlib.h>
#include <string.h>

static char *no(struct lad *e, struct lad_var *var)
{
	return lad_text(e, "NO %s", lad_use(e, var));
}

static char *nc(struct lad *e, struct lad_var *var)
{
	return lad_text(e, "NC %s", lad_use(e, var));
}

static char *coil(struct lad *e, const char *word, struct lad_var *var)
{
	return lad_text(e, "%s %s", word, lad_use(e, var));
}

static const char *text_of(const struct lad *e, uint32_t id)
{
	return project_text(e->project, id);
}

/* A rung of one or two conditions in series and one output. @also: NULL: only one. */
static void write_when(struct lad *e, char *when, char *also, char *out, const char *title)
{
	struct lad_rung *r = lad_begin(e);

	lad_head(r, when);
	if (also)
		lad_head(r, also);
	lad_out(r, out);
	lad_write(e, r, "", title);
}

/* ---- times ---- */

/* Does the chart use a time of a step or line? */
static bool has_times(const struct lad *e)
{
	for (int i = 0; i < e->sfc->step_count; i++)
		if (e->step[i][LAD_T].used)
			return true;
	for (int i = 0; i < e->sfc->use_count; i++)
		if (e->line[i][LAD_SINCE].used)
			return true;
	return false;
}

static void write_clock(struct lad *e)
{
	const char *hold = lad_words(e, text_of(e, e->sfc->control[CONTROL_HOLD]));
	const char *clock, *passed, *last;

	if (!has_times(e))
		return;
	clock = lad_use(e, &e->whole[LAD_CLOCK]);
	passed = lad_use(e, &e->whole[LAD_PASSED]);
	last = lad_use(e, &e->whole[LAD_LAST]);
	write_when(e, lad_text(e, "NO SYS_ALWAYS_ON"), NULL,
		   lad_text(e, "TON %s PT:=T#100000d", clock),
		   "Runs for ever: its time is what the steps count with");
	write_when(e, lad_text(e, "[ %s := %s.ET - %s ]", passed, clock, last), NULL,
		   lad_text(e, "[ %s := %s.ET ]", last, clock), "Time since the scan before");
	if (*hold)
		write_when(e, lad_text(e, "NO %s", hold), NULL,
			   lad_text(e, "[ %s := T#0s ]", passed), "HOLD: no time passes");
}

static void write_times(struct lad *e)
{
	for (int i = 0; i < e->sfc->step_count; i++) {
		const char *t;

		if (!e->step[i][LAD_T].used)
			continue;
		t = lad_use(e, &e->step[i][LAD_T]);
		write_when(e, no(e, &e->step[i][LAD_X]), NULL,
			   lad_text(e, "[ %s := %s + %s ]", t, t,
				    lad_use(e, &e->whole[LAD_PASSED])),
			   lad_text(e, "Time in %s", lad_name(e, i)));
	}
	for (int i = 0; i < e->sfc->step_count; i++) {
		const struct sfc_step *step = &e->sfc->step[i];

		if (step->max && step->alarm)
			write_when(e, no(e, &e->step[i][LAD_X]),
				   lad_text(e, "[ %s > %s ]", lad_use(e, &e->step[i][LAD_T]),
					    lad_words(e, text_of(e, step->max))),
				   lad_text(e, "S %s", lad_words(e, text_of(e, step->alarm))),
				   lad_text(e, "%s takes too long", lad_name(e, i)));
	}
}

/* ---- transitions ---- */

static bool share(const struct sfc_steps *a, const struct sfc_steps *b)
{
	for (int i = 0; i < a->count; i++)
		for (int k = 0; k < b->count; k++)
			if (a->step[i] == b->step[k])
				return true;
	return false;
}

/* "Fill + Stir". */
static char *lad_steps_text(struct lad *e, const struct sfc_steps *steps)
{
	char *text = (char *)"";

	for (int i = 0; i < steps->count; i++)
		if (strlen(text) < 100)
			text = lad_text(e, "%s%s%s", text, *text ? " + " : "",
					lad_name(e, steps->step[i]));
	return text;
}

static bool may_stand(enum word word)
{
	return word == ELEM_EMPTY || word == ELEM_WIRE || word == ELEM_CONTACT_NO ||
	       word == ELEM_CONTACT_NC || word == ELEM_COMPARE;
}

/* Is it a rung of rows from the rail to one bar, without gaps, and a coil? Its rows become
 * ways. */
static bool is_simple(const struct rung *rung)
{
	for (int row = 0; row < rung->rows; row++) {
		int last = rung->cols - 1;

		while (last >= 0 && rung_at(rung, row, last)->word == ELEM_EMPTY)
			last--;
		if (row == 0 && (last < 1 || rung_at(rung, 0, last)->word != ELEM_COIL))
			return false;
		if (row > 0 && last != rung->cols - 2)
			return false;
		for (int col = 0; col < rung->cols; col++) {
			const struct cell *cell = rung_at(rung, row, col);
			const bool coil_here = row == 0 && col == rung->cols - 1;
			const bool joins = row > 0 && col == rung->cols - 2;

			if (cell->link != joins || (coil_here ? cell->word != ELEM_COIL :
			    !may_stand((enum word)cell->word)))
				return false;
			if (col < rung->cols - 1 && cell->word == ELEM_EMPTY)
				return false;
		}
	}
	return true;
}

static void put_rung(struct lad *e, struct lad_rung *r, const struct rung *rung)
{
	char text[600];

	for (int row = 0; row < rung->rows; row++) {
		lad_way(r);
		for (int col = 0; col < rung->cols - 1; col++) {
			const struct cell *cell = rung_at(rung, row, col);

			if (cell->word == ELEM_WIRE && col)
				continue;
			if (text_write_cell(e->project, cell, text, sizeof(text)) >=
			    (int)sizeof(text))
				lad_refuse(e, rung_line(rung, row + 1), 0, "a long cell");
			lad_cell(r, lad_words(e, text));
		}
	}
}

static void write_rungs(struct lad *e, const struct sfc_body *body)
{
	for (int i = 0; i < body->count; i++) {
		char *text = text_write_rung(e->project, e->pou->rung[body->first + i]);

		e->good &= text != NULL;
		if (text)
			sink_text(&e->subs, lad_words(e, text));
		free(text);
	}
}

static void write_list(struct lad *e, const struct sfc_body *body, const char *result)
{
	const struct il il = { .line = e->pou->il.line + body->first,
			       .count = body->count };
	struct sink_memory memory;
	struct sink sink;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	text_write_il(e->project, &il, &sink);
	e->good &= !memory.failed;
	sink_text(&e->subs, lad_words(e, sink_memory_text(&memory)));
	sink_memory_free(&memory);
	if (!result)
		return;
	sink_text(&e->subs, "ST ");
	sink_text(&e->subs, result);
	sink_text(&e->subs, "\n");
}

static void write_text(struct lad *e, const struct sfc_body *body)
{
	struct st st = { .item = e->pou->st->item + body->first, .count = body->count };
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	text_write_st(e->project, &st, &sink);
	e->good &= !memory.failed;
	sink_text(&e->subs, lad_words(e, sink_memory_text(&memory)));
	sink_memory_free(&memory);
}

/* An expression that no cell can hold. */
static void write_assignment(struct lad *e, const struct sfc_body *body, const char *result)
{
	sink_text(&e->subs, "  ");
	sink_text(&e->subs, result);
	sink_text(&e->subs, " := ");
	sink_text(&e->subs, lad_words(e, text_of(e, rung_at(e->pou->rung[body->first], 0, 0)->operand)));
	sink_text(&e->subs, ";\n");
}

/* Writes a body as a subroutine. @result: variable that gets its last result; NULL: none. */
static void lad_body(struct lad *e, int number, const char *result)
{
	const struct sfc_body *body = sfc_body(e->sfc, number);

	e->condition = result;
	sink_text(&e->subs, "SUBROUTINE ");
	sink_text(&e->subs, project_text(e->project, e->body[number]));
	sink_text(&e->subs, body->kind == BODY_LIST ? " IL\n" :
		  body->kind == BODY_ST || body->kind == BODY_EXPRESSION ? " ST\n" : " LD\n");
	if (body->kind == BODY_LIST)
		write_list(e, body, result);
	else if (body->kind == BODY_ST)
		write_text(e, body);
	else if (body->kind == BODY_EXPRESSION)
		write_assignment(e, body, result);
	else
		write_rungs(e, body);
	sink_text(&e->subs, "END_SUBROUTINE\n\n");
	e->condition = NULL;
}

static void write_condition(struct lad *e, struct lad_rung *r, int arc)
{
	const int number = e->net.arc[arc].transition;
	const struct sfc_body *body = &e->sfc->transition[number].condition;
	const struct rung *rung = sfc_body_has_rungs(body) ? e->pou->rung[body->first] : NULL;
	const char *result;

	if (body->kind == BODY_EXPRESSION && !lad_needs_st(e, text_of(e, rung_at(rung, 0, 0)->operand))) {
		lad_expression(e, r, lad_words(e, text_of(e, rung_at(rung, 0, 0)->operand)));
	} else if (body->kind != BODY_EXPRESSION && rung && is_simple(rung)) {
		put_rung(e, r, rung);
	} else {
		result = lad_use(e, &e->arc[arc][LAD_RESULT]);
		lad_body(e, number, result);
		lad_cell(r, lad_text(e, "CALL %s", text_of(e, e->body[number])));
		lad_cell(r, lad_text(e, "NO %s", result));
	}
}

static bool lad_has_reset(const struct lad *e)
{
	return e->sfc->control[CONTROL_RESET];
}

static bool lad_has_force(const struct lad *e)
{
	return e->sfc->control[CONTROL_FORCE];
}

/* Is there a control that stops all transitions? */
static bool lad_has_gate(const struct lad *e)
{
	return lad_has_reset(e) || lad_has_force(e) || e->sfc->control[CONTROL_HOLD];
}

bool lad_is_in_order(const struct lad *e)
{
	return e->sfc->evolution == EVOLVE_IN_ORDER;
}

/* A cell for each condition that enables an arc. */
static void put_enabled(struct lad *e, struct lad_rung *r, int number,
			void (*put)(struct lad_rung *r, char *cell))
{
	const struct sfc_arc *arc = &e->net.arc[number];

	for (int k = 0; k < arc->from.count; k++)
		put(r, no(e, &e->step[arc->from.step[k]][LAD_X]));
	if (!arc->from.count)
		put(r, nc(e, &e->whole[LAD_FIRST]));
	if (lad_has_gate(e))
		put(r, nc(e, &e->whole[LAD_STANDS]));
	for (int k = 0; k < number && !lad_is_in_order(e); k++)
		if (share(&arc->from, &e->net.arc[k].from))
			put(r, nc(e, &e->arc[k][LAD_FIRES]));
}

/* With SEMI or MANUAL: the arc fires if it is true and may, or by hand. */
static void write_fires(struct lad *e, int arc, const char *title)
{
	struct lad_rung *r = lad_begin(e);

	lad_cell(r, no(e, &e->arc[arc][LAD_TRUE]));
	lad_cell(r, no(e, &e->whole[LAD_GO]));
	if (e->sfc->control[CONTROL_MANUAL]) {
		lad_way(r);
		lad_cell(r, no(e, &e->whole[LAD_HAND]));
		put_enabled(e, r, arc, lad_cell);
	}
	lad_out(r, coil(e, "COIL", &e->arc[arc][LAD_FIRES]));
	lad_write(e, r, "", title);
}

/* Do controls decide when transitions fire? */
static bool lad_has_modes(const struct lad *e)
{
	return e->sfc->control[CONTROL_SEMI] || e->sfc->control[CONTROL_MANUAL];
}

/* Writes the rungs that tell if an arc fires. @label: of the first one. */
static void lad_arc(struct lad *e, int arc, const char *label)
{
	const bool modes = lad_has_modes(e);
	struct lad_rung *r = lad_begin(e);
	const char *title = lad_text(e, "%s -> %s",
				     lad_steps_text(e, &e->net.arc[arc].from),
				     lad_steps_text(e, &e->net.arc[arc].to));

	put_enabled(e, r, arc, lad_head);
	write_condition(e, r, arc);
	lad_out(r, coil(e, "COIL", &e->arc[arc][modes ? LAD_TRUE : LAD_FIRES]));
	lad_write(e, r, label, modes ? lad_text(e, "%s: is it true?", title) : title);
	if (modes)
		write_fires(e, arc, title);
}

static void write_arcs(struct lad *e)
{
	const char *again = sfc_goes_round(e->sfc) ? text_of(e, e->again) : "";

	for (int i = 0; i < e->net.arc_count; i++)
		lad_arc(e, i, i == 0 ? again : "");
}

/* Arcs that act after all conditions; IN ORDER an arc acts right after its condition. */
static int arcs_together(const struct lad *e)
{
	return lad_is_in_order(e) ? 0 : e->net.arc_count;
}

/* ---- steps that begin and end ---- */

static bool is_initial(const struct lad *e, int step)
{
	return sfc_steps_has(&e->net.initial, step);
}

static void put_forced(struct lad *e, struct lad_rung *r, int step)
{
	struct sfc_steps steps;

	for (int i = 0; lad_has_force(e) && i < e->reach; i++) {
		e->good &= sfc_forced(e->sfc, i, e->arena, &steps);
		if (!sfc_steps_has(&steps, step))
			continue;
		lad_way(r);
		lad_cell(r, no(e, &e->step[i][LAD_FORCED]));
	}
}

/* Is the pulse of this evolution read? UNTIL STABLE, actions read the sum over the scan, but
 * times and SET read each evolution. */
static bool reads_start(const struct lad *e, int step)
{
	const struct sfc_step *at = &e->sfc->step[step];
	bool sets = false;

	for (int i = 0; i < at->use_count; i++)
		sets |= e->sfc->use[at->first_use + i].kind != USE_ACTION;
	return !sfc_goes_round(e->sfc) || sets || e->step[step][LAD_T].used;
}

/* The pulse of a step that becomes active. */
static void write_start(struct lad *e, int step)
{
	struct lad_rung *r = lad_begin(e);

	for (int i = 0; i < arcs_together(e); i++) {
		if (!sfc_steps_has(&e->net.arc[i].to, step))
			continue;
		lad_way(r);
		lad_cell(r, no(e, &e->arc[i][LAD_FIRES]));
		lad_cell(r, nc(e, &e->step[step][LAD_X]));
	}
	if (is_initial(e, step)) {
		lad_way(r);
		lad_cell(r, no(e, &e->whole[LAD_FIRST]));
	}
	if (is_initial(e, step) && lad_has_reset(e)) {
		lad_way(r);
		lad_cell(r, no(e, &e->whole[LAD_ANEW]));
	}
	put_forced(e, r, step);
	if (!r || !r->ways)
		return;
	if (reads_start(e, step))
		lad_out(r, coil(e, "COIL", &e->step[step][LAD_START]));
	if (sfc_goes_round(e->sfc) && e->step[step][LAD_STARTED].used)
		lad_out(r, coil(e, "S", &e->step[step][LAD_STARTED]));
	lad_write(e, r, "", lad_text(e, "%s becomes active", lad_name(e, step)));
}

static void write_left(struct lad *e, int step)
{
	struct lad_rung *r = lad_begin(e);

	for (int i = 0; i < arcs_together(e); i++) {
		if (!sfc_steps_has(&e->net.arc[i].from, step))
			continue;
		lad_way(r);
		lad_cell(r, no(e, &e->arc[i][LAD_FIRES]));
	}
	if (!r || !r->ways) { /* never */
		lad_cell(r, nc(e, &e->step[step][LAD_LEFT]));
		lad_cell(r, no(e, &e->step[step][LAD_LEFT]));
	}
	for (int i = 0; i < arcs_together(e); i++)
		if (sfc_steps_has(&e->net.arc[i].to, step))
			lad_head(r, nc(e, &e->arc[i][LAD_FIRES]));
	lad_out(r, coil(e, "COIL", &e->step[step][LAD_LEFT]));
	lad_write(e, r, "", lad_text(e, "%s is left", lad_name(e, step)));
}

static void write_end(struct lad *e, int step)
{
	struct lad_rung *r = lad_begin(e);

	if (!lad_is_in_order(e)) {
		lad_way(r);
		lad_cell(r, no(e, &e->step[step][LAD_LEFT]));
	}
	if (lad_has_reset(e)) {
		lad_way(r);
		lad_cell(r, no(e, &e->whole[LAD_ANEW]));
		lad_cell(r, no(e, &e->step[step][LAD_X]));
	}
	if (lad_has_force(e)) {
		lad_way(r);
		lad_cell(r, no(e, &e->whole[LAD_SET]));
		lad_cell(r, no(e, &e->step[step][LAD_X]));
	}
	if (!r || !r->ways)
		return;
	if (!sfc_goes_round(e->sfc))
		lad_out(r, coil(e, "COIL", &e->step[step][LAD_END]));
	if (sfc_goes_round(e->sfc) && e->step[step][LAD_ENDED].used)
		lad_out(r, coil(e, "S", &e->step[step][LAD_ENDED]));
	lad_write(e, r, "", lad_text(e, "%s ends", lad_name(e, step)));
}

/* The alarm of a step that is left before its least time. @left: the bit that leaves it. */
static void write_minimum(struct lad *e, int step, struct lad_var *left)
{
	const struct sfc_step *at = &e->sfc->step[step];

	if (at->min && at->alarm)
		write_when(e, no(e, left),
			   lad_text(e, "[ %s < %s ]", lad_use(e, &e->step[step][LAD_T]),
				    lad_words(e, text_of(e, at->min))),
			   lad_text(e, "S %s", lad_words(e, text_of(e, at->alarm))),
			   lad_text(e, "%s was too short", lad_name(e, step)));
}

static void write_pulses(struct lad *e)
{
	for (int i = 0; i < e->sfc->step_count; i++) {
		const struct sfc_step *step = &e->sfc->step[i];

		if (e->step[i][LAD_START].used || e->step[i][LAD_STARTED].used)
			write_start(e, i);
		if (step->min && step->alarm && !lad_is_in_order(e))
			lad_use(e, &e->step[i][LAD_LEFT]);
		if (e->step[i][LAD_LEFT].used)
			write_left(e, i);
		if (e->step[i][LAD_END].used || e->step[i][LAD_ENDED].used)
			write_end(e, i);
	}
	for (int i = 0; i < e->sfc->step_count && !lad_is_in_order(e); i++)
		write_minimum(e, i, &e->step[i][LAD_LEFT]);
}

/* ---- firing ---- */

static void write_leaving(struct lad *e, struct lad_var *when, const char *title)
{
	for (int i = 0; i < e->sfc->step_count; i++) {
		struct lad_rung *r = lad_begin(e);

		lad_head(r, no(e, when));
		for (; i < e->sfc->step_count; i++) {
			lad_out(r, coil(e, "R", &e->step[i][LAD_X]));
			if (i % 100 == 99)
				break;
		}
		lad_write(e, r, "", title);
	}
}

/* @word: R or S, for the bit of each of @steps. */
static void write_bits(struct lad *e, struct lad_var *when, const char *word,
		       const struct sfc_steps *steps, const char *title)
{
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, when));
	for (int i = 0; i < steps->count; i++)
		lad_out(r, coil(e, word, &e->step[steps->step[i]][LAD_X]));
	lad_write(e, r, "", title);
}

static void write_resets(struct lad *e)
{
	for (int i = 0; i < arcs_together(e); i++)
		write_bits(e, &e->arc[i][LAD_FIRES], "R", &e->net.arc[i].from,
			   lad_text(e, "Leave %s", lad_steps_text(e, &e->net.arc[i].from)));
	if (lad_has_reset(e))
		write_leaving(e, &e->whole[LAD_ANEW], "RESET leaves all steps");
	if (lad_has_force(e))
		write_leaving(e, &e->whole[LAD_SET], "FORCE leaves all steps");
}

static void write_sets(struct lad *e)
{
	struct lad_rung *r = lad_begin(e);

	for (int i = 0; i < arcs_together(e); i++)
		write_bits(e, &e->arc[i][LAD_FIRES], "S", &e->net.arc[i].to,
			   lad_text(e, "Enter %s", lad_steps_text(e, &e->net.arc[i].to)));
	lad_cell(r, no(e, &e->whole[LAD_FIRST]));
	if (lad_has_reset(e)) {
		lad_way(r);
		lad_cell(r, no(e, &e->whole[LAD_ANEW]));
	}
	for (int i = 0; i < e->net.initial.count; i++)
		lad_out(r, coil(e, "S", &e->step[e->net.initial.step[i]][LAD_X]));
	lad_write(e, r, "", "Begin");
	for (int i = 0; lad_has_force(e) && i < e->reach; i++) {
		struct sfc_steps steps;

		e->good &= sfc_forced(e->sfc, i, e->arena, &steps);
		write_bits(e, &e->step[i][LAD_FORCED], "S", &steps,
			   lad_text(e, "FORCE enters %s", lad_name(e, i)));
	}
}

/* Outputs for SET and RESET of a step. */
static void lad_once(struct lad *e, struct lad_rung *r, int step)
{
	const struct sfc_step *at = &e->sfc->step[step];

	for (int k = 0; k < at->use_count; k++) {
		const struct sfc_use *use = &e->sfc->use[at->first_use + k];

		if (use->kind == USE_ACTION)
			continue;
		lad_out(r, lad_text(e, "%s %s", use->kind == USE_SET ? "S" : "R",
				    lad_words(e, text_of(e, use->operand))));
	}
}

static void write_begins(struct lad *e)
{
	for (int i = 0; i < e->sfc->step_count; i++) {
		struct lad_rung *r = lad_begin(e);

		if (e->step[i][LAD_T].used)
			write_when(e, no(e, &e->step[i][LAD_START]), NULL,
				   lad_text(e, "[ %s := T#0s ]",
					    lad_use(e, &e->step[i][LAD_T])),
				   lad_text(e, "The time in %s begins", lad_name(e, i)));
		lad_once(e, r, i);
		if (!r || !r->outs)
			continue;
		lad_head(r, no(e, &e->step[i][LAD_START]));
		lad_write(e, r, "", lad_text(e, "Once in %s", lad_name(e, i)));
	}
}

/* UNTIL STABLE: another evolution if something fired. */
static void write_again(struct lad *e)
{
	struct lad_rung *r = lad_begin(e);

	if (!sfc_goes_round(e->sfc) || !e->net.arc_count)
		return;
	if (e->sfc->control[CONTROL_SEMI] && !lad_is_in_order(e))
		write_when(e, no(e, &e->whole[LAD_ONCE]), NULL,
			   coil(e, "R", &e->whole[LAD_GO]), "SEMI: one TIP is one evolution");
	if (sfc_rests_at_once(e->sfc)) {
		lad_head(r, no(e, &e->whole[LAD_FIRST]));
		lad_out(r, coil(e, "R", &e->whole[LAD_FIRST]));
		lad_out(r, coil(e, "S", &e->whole[LAD_RUNS]));
		lad_out(r, lad_text(e, "JMP %s", text_of(e, e->again)));
		lad_write(e, r, "", "In the first scan, too");
		r = lad_begin(e);
	}
	if (lad_is_in_order(e))
		return;
	for (int i = 0; i < e->net.arc_count; i++) {
		lad_way(r);
		lad_cell(r, no(e, &e->arc[i][LAD_FIRES]));
	}
	/* One TIP is one evolution. */
	if (lad_has_modes(e))
		lad_out(r, coil(e, "R", &e->whole[LAD_HAND]));
	lad_out(r, lad_text(e, "JMP %s", text_of(e, e->again)));
	lad_write(e, r, "", "Until nothing fires");
}

/* UNTIL STABLE: resets the pulses of the scan. */
static void write_gathered(struct lad *e)
{
	for (int i = 0; sfc_goes_round(e->sfc) && i < e->sfc->step_count; i++)
		for (int k = LAD_STARTED; k <= LAD_ENDED; k++)
			if (e->step[i][k].used)
				write_when(e, lad_text(e, "NO SYS_ALWAYS_ON"), NULL,
					   coil(e, "R", &e->step[i][k]), lad_name(e, i));
}

static void write_force(struct lad *e, const char *reset)
{
	const char *force = lad_words(e, text_of(e, e->sfc->control[CONTROL_FORCE]));
	const char *number = lad_use(e, &e->whole[LAD_NUMBER]);
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, &e->whole[LAD_RUNS]));
	if (*reset)
		lad_head(r, lad_text(e, "NC %s", reset));
	lad_head(r, lad_text(e, "[ %s <> %s ]", force, number));
	lad_out(r, coil(e, "COIL", &e->whole[LAD_CHANGED]));
	lad_write(e, r, "", "FORCE has changed");
	r = lad_begin(e);
	lad_out(r, lad_text(e, "[ %s := %s ]", number, force));
	lad_write(e, r, "", "What it is now");
	for (int i = 0; i < e->reach; i++)
		write_when(e, no(e, &e->whole[LAD_CHANGED]),
			   lad_text(e, "[ %s = %d ]", number, i + 1),
			   coil(e, "COIL", &e->step[i][LAD_FORCED]),
			   lad_text(e, "%s is forced", lad_name(e, i)));
	r = lad_begin(e);
	lad_head(r, no(e, &e->whole[LAD_CHANGED]));
	lad_head(r, lad_text(e, "[ %s >= 1 ]", number));
	lad_head(r, lad_text(e, "[ %s <= %d ]", number, e->reach));
	lad_out(r, coil(e, "COIL", &e->whole[LAD_SET]));
	lad_write(e, r, "", "A step is forced");
}

/* SEMI: transitions fire only when TIP rises. MANUAL: then all enabled ones fire. MANUAL wins
 * over SEMI. */
static void write_modes(struct lad *e)
{
	const char *semi = lad_words(e, text_of(e, e->sfc->control[CONTROL_SEMI]));
	const char *manual = lad_words(e, text_of(e, e->sfc->control[CONTROL_MANUAL]));
	const char *tip = lad_words(e, text_of(e, e->sfc->control[CONTROL_TIP]));
	struct lad_rung *r = lad_begin(e);

	write_when(e, *tip ? lad_text(e, "P %s", tip) : lad_text(e, "NC SYS_ALWAYS_ON"), NULL,
		   coil(e, "COIL", &e->whole[LAD_HAND]), "TIP rises");
	if (*manual)
		lad_head(r, lad_text(e, "NC %s", manual));
	if (*semi) {
		lad_cell(r, lad_text(e, "NC %s", semi));
		lad_way(r);
		lad_cell(r, no(e, &e->whole[LAD_HAND]));
	}
	lad_out(r, coil(e, "COIL", &e->whole[LAD_GO]));
	lad_write(e, r, "", "Transitions fire when they are true");
	if (*semi && sfc_goes_round(e->sfc))
		write_when(e, lad_text(e, "NO %s", semi), NULL,
			   coil(e, "COIL", &e->whole[LAD_ONCE]),
			   "SEMI, whatever the chart makes of it in this scan");
	write_when(e, *manual ? lad_text(e, "NC %s", manual) : lad_text(e, "NO SYS_ALWAYS_ON"),
		   NULL, coil(e, "R", &e->whole[LAD_HAND]),
		   "Whatever they are, in MANUAL alone");
}

static void lad_control(struct lad *e)
{
	const char *reset = lad_words(e, text_of(e, e->sfc->control[CONTROL_RESET]));
	const char *hold = lad_words(e, text_of(e, e->sfc->control[CONTROL_HOLD]));
	struct lad_rung *r = lad_begin(e);

	if (lad_has_reset(e))
		write_when(e, lad_text(e, "P %s", reset), no(e, &e->whole[LAD_RUNS]),
			   coil(e, "COIL", &e->whole[LAD_ANEW]), "RESET: all begins anew");
	if (lad_has_force(e))
		write_force(e, reset);
	if (lad_has_modes(e))
		write_modes(e);
	if (lad_has_reset(e)) {
		lad_way(r);
		lad_cell(r, lad_text(e, "NO %s", reset));
	}
	if (*hold) {
		lad_way(r);
		lad_cell(r, lad_text(e, "NO %s", hold));
	}
	if (lad_has_force(e)) {
		lad_way(r);
		lad_cell(r, no(e, &e->whole[LAD_SET]));
	}
	if (lad_has_gate(e)) {
		lad_out(r, coil(e, "COIL", &e->whole[LAD_STANDS]));
		lad_write(e, r, "", "While this is TRUE nothing fires");
	}
	write_when(e, nc(e, &e->whole[LAD_RUNS]), NULL, coil(e, "COIL", &e->whole[LAD_FIRST]),
		   "The first scan");
}

/* ---- one transition ---- */

static void write_leave(struct lad *e, int arc)
{
	const struct sfc_steps *from = &e->net.arc[arc].from;
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, &e->arc[arc][LAD_FIRES]));
	for (int i = 0; i < from->count; i++) {
		const int step = from->step[i];

		write_minimum(e, step, &e->arc[arc][LAD_FIRES]);
		if (e->step[step][LAD_ENDED].used)
			lad_out(r, coil(e, "S", &e->step[step][LAD_ENDED]));
		lad_out(r, coil(e, "R", &e->step[step][LAD_X]));
	}
	lad_write(e, r, "", lad_text(e, "Leave %s", lad_steps_text(e, from)));
}

static void write_enter(struct lad *e, int arc, int step)
{
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, &e->arc[arc][LAD_FIRES]));
	lad_head(r, lad_text(e, "NC %s", lad_use(e, &e->step[step][LAD_X])));
	if (e->step[step][LAD_T].used)
		lad_out(r, lad_text(e, "[ %s := T#0s ]",
				    lad_use(e, &e->step[step][LAD_T])));
	if (e->step[step][LAD_STARTED].used)
		lad_out(r, coil(e, "S", &e->step[step][LAD_STARTED]));
	lad_once(e, r, step);
	lad_out(r, coil(e, "S", &e->step[step][LAD_X]));
	lad_write(e, r, "", lad_text(e, "Enter %s", lad_name(e, step)));
}

/* Steps in the order of the file, because SET and RESET run in that order. */
static void write_enters(struct lad *e, int arc)
{
	const struct sfc_steps *to = &e->net.arc[arc].to;
	int last = -1;

	for (int i = 0; i < to->count; i++) {
		int next = -1;

		for (int k = 0; k < to->count; k++)
			if (to->step[k] > last && (next < 0 || to->step[k] < next))
				next = to->step[k];
		write_enter(e, arc, next);
		last = next;
	}
}

static void write_fired(struct lad *e, int arc)
{
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, &e->arc[arc][LAD_FIRES]));
	lad_out(r, coil(e, "S", &e->whole[LAD_FIRED]));
	if (lad_has_modes(e))
		lad_out(r, coil(e, "R", &e->whole[LAD_HAND]));
	lad_write(e, r, "", "Something has fired in this round");
	if (e->sfc->control[CONTROL_SEMI])
		write_when(e, no(e, &e->arc[arc][LAD_FIRES]), no(e, &e->whole[LAD_ONCE]),
			   coil(e, "R", &e->whole[LAD_GO]), "SEMI: one TIP is one transition");
}

/* ---- rounds ---- */

static void lad_order(struct lad *e)
{
	const char *rounds = lad_use(e, &e->whole[LAD_ROUNDS]);
	struct lad_rung *r = lad_begin(e);

	if (!e->net.arc_count)
		return;
	lad_head(r, lad_text(e, "NO SYS_ALWAYS_ON"));
	lad_out(r, lad_text(e, "[ %s := 0 ]", rounds));
	lad_write(e, r, text_of(e, e->again), "No round yet");
	r = lad_begin(e);
	lad_head(r, lad_text(e, "[ %s := %s + 1 ]", rounds, rounds));
	lad_out(r, coil(e, "R", &e->whole[LAD_FIRED]));
	lad_write(e, r, text_of(e, e->round), "A round");
	for (int i = 0; i < e->net.arc_count; i++) {
		lad_arc(e, i, "");
		write_leave(e, i);
		write_enters(e, i);
		write_fired(e, i);
	}
	write_when(e, no(e, &e->whole[LAD_FIRED]),
		   lad_text(e, "[ %s < %d ]", rounds, LIMIT_ROUNDS),
		   lad_text(e, "JMP %s", text_of(e, e->round)), "Until nothing fires");
}

void lad_steps(struct lad *e)
{
	lad_control(e);
	write_clock(e);
	write_times(e);
	write_gathered(e);
	if (lad_is_in_order(e))
		lad_order(e);
	else
		write_arcs(e);
	write_pulses(e);
	write_resets(e);
	write_sets(e);
	write_begins(e);
	write_again(e);
	write_when(e, no(e, &e->whole[LAD_FIRST]), NULL, coil(e, "S", &e->whole[LAD_RUNS]),
		   "From now on it runs");
}

/* The pulse of a step that became active in this scan. */
static struct lad_var *began(struct lad *e, int step)
{
	return &e->step[step][sfc_goes_round(e->sfc) ? LAD_STARTED : LAD_START];
}

static struct lad_var *ended(struct lad *e, int step)
{
	return &e->step[step][sfc_goes_round(e->sfc) ? LAD_ENDED : LAD_END];
}

/* Is line @use one that calls @called? */
static bool is_of(const struct lad *e, const struct sfc_use *use,
		  const struct lad_called *called)
{
	if (use->kind != USE_ACTION)
		return false;
	return called->action >= 0 ? use->action == called->action :
	       use->action < 0 && e->same[use - e->sfc->use] == called->use;
}

static char *title_of(struct lad *e, const struct sfc_use *use)
{
	return lad_text(e, "%s: %s(%s)", lad_name(e, use->step),
			text_of(e, use->operand), qualifier_word(use->qualifier));
}

static bool is_stored(enum qualifier q)
{
	return q == QUALIFIER_S || q == QUALIFIER_SD || q == QUALIFIER_DS ||
	       q == QUALIFIER_SL;
}

/* ---- stored lines ---- */

/* SD, SL: the time since the line was stored. HOLD stops it. */
static void write_since(struct lad *e, int line)
{
	const struct sfc_use *use = &e->sfc->use[line];
	const char *since = lad_use(e, &e->line[line][LAD_SINCE]);

	write_when(e, no(e, &e->line[line][LAD_STORED]), NULL,
		   lad_text(e, "[ %s := %s + %s ]", since, since,
			    lad_use(e, &e->whole[LAD_PASSED])),
		   lad_text(e, "%s: its time", title_of(e, use)));
	write_when(e, no(e, began(e, use->step)), nc(e, &e->line[line][LAD_STORED]),
		   lad_text(e, "[ %s := T#0s ]", since),
		   lad_text(e, "%s: it begins", title_of(e, use)));
}

/* DS: the line waits while its step stays active and no R ends it. */
static void write_armed(struct lad *e, int line)
{
	const struct sfc_use *use = &e->sfc->use[line];

	write_when(e, no(e, began(e, use->step)), NULL,
		   coil(e, "S", &e->line[line][LAD_ARMED]),
		   lad_text(e, "%s: it waits", title_of(e, use)));
	write_when(e, nc(e, &e->step[use->step][LAD_X]), NULL,
		   coil(e, "R", &e->line[line][LAD_ARMED]),
		   lad_text(e, "%s: it waits no more", title_of(e, use)));
}

static void write_anew(struct lad *e, int line)
{
	struct lad_rung *r = lad_begin(e);

	if (!e->sfc->control[CONTROL_RESET])
		return;
	lad_head(r, no(e, &e->whole[LAD_ANEW]));
	lad_out(r, coil(e, "R", &e->line[line][LAD_STORED]));
	if (e->sfc->use[line].qualifier == QUALIFIER_DS)
		lad_out(r, coil(e, "R", &e->line[line][LAD_ARMED]));
	lad_write(e, r, "", lad_text(e, "%s: RESET", title_of(e, &e->sfc->use[line])));
}

static void write_stored(struct lad *e, int line)
{
	const struct sfc_use *use = &e->sfc->use[line];
	const enum qualifier q = use->qualifier;
	const bool delayed = q == QUALIFIER_DS;

	write_anew(e, line);
	if (q == QUALIFIER_SD || q == QUALIFIER_SL)
		write_since(e, line);
	if (delayed)
		write_armed(e, line);
	write_when(e, no(e, delayed ? &e->line[line][LAD_ARMED] : began(e, use->step)),
		   delayed ? lad_text(e, "[ %s >= %s ]",
				      lad_use(e, &e->step[use->step][LAD_T]),
				      lad_words(e, text_of(e, use->time))) : NULL,
		   coil(e, "S", &e->line[line][LAD_STORED]), title_of(e, use));
}

/* R of @called in any step ends line @line. */
static void write_ended(struct lad *e, int line, const struct lad_called *called)
{
	struct lad_rung *r = lad_begin(e);
	bool any = false;

	for (int i = 0; i < e->sfc->use_count; i++) {
		const struct sfc_use *use = &e->sfc->use[i];

		if (use->qualifier != QUALIFIER_R || !is_of(e, use, called))
			continue;
		lad_way(r);
		lad_cell(r, no(e, &e->step[use->step][LAD_X]));
		if (sfc_goes_round(e->sfc)) {
			lad_way(r);
			lad_cell(r, no(e, began(e, use->step)));
		}
		any = true;
	}
	if (!any)
		return;
	lad_out(r, coil(e, "R", &e->line[line][LAD_STORED]));
	if (e->sfc->use[line].qualifier == QUALIFIER_DS)
		lad_out(r, coil(e, "R", &e->line[line][LAD_ARMED]));
	lad_write(e, r, "", lad_text(e, "%s ends", title_of(e, &e->sfc->use[line])));
}

/* ---- calls ---- */

static char *time_cell(struct lad *e, const struct sfc_use *use, struct lad_var *var,
		       const char *sign)
{
	return lad_text(e, "[ %s %s %s ]", lad_use(e, var), sign,
			lad_words(e, text_of(e, use->time)));
}

/* A line of a step as a way of the rung. */
static void put_line(struct lad *e, struct lad_rung *r, int line)
{
	const struct sfc_use *use = &e->sfc->use[line];
	struct lad_var *x = &e->step[use->step][LAD_X], *t = &e->step[use->step][LAD_T];

	lad_way(r);
	switch (use->qualifier) {
	case QUALIFIER_N:
		lad_cell(r, no(e, x));
		break;
	case QUALIFIER_L:
	case QUALIFIER_D:
		lad_cell(r, no(e, x));
		lad_cell(r, time_cell(e, use, t,
				      use->qualifier == QUALIFIER_L ? "<" : ">="));
		break;
	case QUALIFIER_P:
	case QUALIFIER_P1:
		lad_cell(r, no(e, began(e, use->step)));
		break;
	case QUALIFIER_P0:
		lad_cell(r, no(e, ended(e, use->step)));
		break;
	case QUALIFIER_S:
	case QUALIFIER_DS:
		lad_cell(r, no(e, &e->line[line][LAD_STORED]));
		break;
	case QUALIFIER_SD:
	case QUALIFIER_SL:
		lad_cell(r, no(e, &e->line[line][LAD_STORED]));
		lad_cell(r, time_cell(e, use, &e->line[line][LAD_SINCE],
				      use->qualifier == QUALIFIER_SL ? "<" : ">="));
		break;
	case QUALIFIER_R:
	case QUALIFIER_COUNT:
		break;
	}
}

static bool is_pulse(enum qualifier q)
{
	return q == QUALIFIER_P0 || q == QUALIFIER_P1;
}

/* A step with R of @called stops all calls. */
static void put_refusals(struct lad *e, struct lad_rung *r, const struct lad_called *called)
{
	for (int i = 0; i < e->sfc->use_count; i++)
		if (e->sfc->use[i].qualifier == QUALIFIER_R &&
		    is_of(e, &e->sfc->use[i], called))
			lad_head(r, nc(e, &e->step[e->sfc->use[i].step][LAD_X]));
}

/* The lines of @called as ways; without any, a contact that is never closed.
 * @pulses: also those of P0 and P1. */
static void put_lines(struct lad *e, struct lad_rung *r, const struct lad_called *called,
		      bool pulses)
{
	bool any = false;

	for (int i = 0; i < e->sfc->use_count; i++) {
		const struct sfc_use *use = &e->sfc->use[i];

		if (!is_of(e, use, called) || use->qualifier == QUALIFIER_R ||
		    (!pulses && is_pulse(use->qualifier)))
			continue;
		put_line(e, r, i);
		any = true;
	}
	if (any)
		put_refusals(e, r, called);
	else
		lad_head(r, lad_text(e, "NC SYS_ALWAYS_ON"));
}

static bool is_variable(struct lad *e, const struct lad_called *called)
{
	for (int i = 0; i < e->sfc->use_count; i++) {
		const struct sfc_use *use = &e->sfc->use[i];

		if (is_of(e, use, called) && (use->qualifier == QUALIFIER_SD ||
		    use->qualifier == QUALIFIER_SL) && !strchr(text_of(e, use->time), '#'))
			return true;
	}
	return false;
}

static bool is_mixed(const struct lad *e, const struct lad_called *called)
{
	bool pulse = false;

	for (int i = 0; i < e->sfc->use_count; i++)
		pulse |= is_of(e, &e->sfc->use[i], called) &&
			 is_pulse(e->sfc->use[i].qualifier);
	return pulse;
}

/* The bits that say what is called; a BOOL that nothing else writes is its own bit. */
static void write_called(struct lad *e, struct lad_called *called)
{
	struct lad_rung *r = lad_begin(e);
	const char *name = text_of(e, called->operand);
	const char *what = lad_words(e, name);

	put_lines(e, r, called, true);
	lad_out(r, called->alone ? lad_text(e, "COIL %s", what) :
		coil(e, "COIL", &called->var[LAD_CALLED]));
	lad_write(e, r, "", lad_text(e, called->alone ? "%s" : "%s is called for", name));
	if (called->action < 0 || !is_mixed(e, called))
		return;
	r = lad_begin(e);
	put_lines(e, r, called, false);
	lad_out(r, coil(e, "COIL", &called->var[LAD_LEVEL]));
	lad_write(e, r, "", lad_text(e, "%s is called for, not by P0 or P1 alone", name));
}

/* ---- actions ---- */

static void write_bool(struct lad *e, struct lad_called *called)
{
	const char *name = text_of(e, called->operand), *what = lad_words(e, name);

	if (called->alone)
		return;
	write_when(e, no(e, &called->var[LAD_CALLED]), NULL, lad_text(e, "S %s", what), name);
	write_when(e, nc(e, &called->var[LAD_CALLED]), no(e, &called->var[LAD_WAS]),
		   lad_text(e, "R %s", what),
		   lad_text(e, "%s, when it is called for no more", name));
	write_when(e, no(e, &called->var[LAD_CALLED]), NULL,
		   coil(e, "COIL", &called->var[LAD_WAS]),
		   lad_text(e, "Was %s called for?", name));
}

static void write_body(struct lad *e, struct lad_called *called)
{
	struct lad_var *level = &called->var[is_mixed(e, called) ? LAD_LEVEL : LAD_CALLED];
	const int body = e->sfc->transition_count + called->action;
	const char *name = text_of(e, called->operand);
	struct lad_rung *r = lad_begin(e);

	if (sfc_body(e->sfc, body)->kind == BODY_NONE || !sfc_body(e->sfc, body)->count)
		return;
	lad_body(e, body, NULL);
	lad_cell(r, no(e, &called->var[LAD_CALLED]));
	lad_way(r);
	lad_cell(r, no(e, &called->var[LAD_WAS]));
	lad_out(r, lad_text(e, "CALL %s", text_of(e, e->body[body])));
	lad_write(e, r, "", lad_text(e, "%s, and once more when it ends", name));
	write_when(e, no(e, level), NULL, coil(e, "COIL", &called->var[LAD_WAS]),
		   lad_text(e, "Was %s called for?", name));
}

void lad_outputs(struct lad *e)
{
	for (int i = 0; i < e->sfc->use_count; i++)
		if (e->sfc->use[i].kind == USE_ACTION &&
		    is_stored(e->sfc->use[i].qualifier))
			write_stored(e, i);
	for (int i = 0; i < e->called_count; i++)
		for (int k = 0; k < e->sfc->use_count; k++)
			if (is_of(e, &e->sfc->use[k], &e->called[i]) &&
			    is_stored(e->sfc->use[k].qualifier))
				write_ended(e, k, &e->called[i]);
	for (int i = 0; i < e->called_count; i++)
		if (!is_variable(e, &e->called[i]) &&
		    !(e->called[i].action < 0 && e->called[i].alone))
			write_called(e, &e->called[i]);
	for (int i = 0; i < e->called_count; i++) {
		struct lad_called *called = &e->called[i];

		if (is_variable(e, called) || (called->action < 0 && called->alone))
			write_called(e, called);
		if (called->action < 0)
			write_bool(e, called);
		else
			write_body(e, called);
	}
}
