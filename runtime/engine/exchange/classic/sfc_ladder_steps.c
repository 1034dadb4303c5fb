/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_steps - the program that moves from step to step.
 *
 * Its rungs stand in the order of what a scan does (docs/sfc.md): times, supervision,
 * which transitions fire, which steps begin and end, resets before sets, SET and RESET.
 */
#include "engine/exchange/classic/sfc_ladder_parts.h"

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

/* ---- times ---- */

/* Is a time counted anywhere? */
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
	struct lad_rung *r = lad_begin(e);

	if (!has_times(e))
		return;
	clock = lad_use(e, &e->whole[LAD_CLOCK]);
	passed = lad_use(e, &e->whole[LAD_PASSED]);
	last = lad_use(e, &e->whole[LAD_LAST]);
	lad_head(r, lad_text(e, "NO SYS_ALWAYS_ON"));
	lad_out(r, lad_text(e, "TON %s PT:=T#100000d", clock));
	lad_write(e, r, "", "Runs for ever: its time is what the steps count with");
	r = lad_begin(e);
	lad_head(r, lad_text(e, "[ %s := %s.ET - %s ]", passed, clock, last));
	lad_out(r, lad_text(e, "[ %s := %s.ET ]", last, clock));
	lad_write(e, r, "", "Time since the scan before");
	if (!*hold)
		return;
	r = lad_begin(e);
	lad_head(r, lad_text(e, "NO %s", hold));
	lad_out(r, lad_text(e, "[ %s := T#0s ]", passed));
	lad_write(e, r, "", "HOLD: no time passes");
}

static void write_times(struct lad *e)
{
	for (int i = 0; i < e->sfc->step_count; i++) {
		struct lad_rung *r = lad_begin(e);
		const char *t;

		if (!e->step[i][LAD_T].used)
			continue;
		t = lad_use(e, &e->step[i][LAD_T]);
		lad_head(r, no(e, &e->step[i][LAD_X]));
		lad_out(r, lad_text(e, "[ %s := %s + %s ]", t, t,
				    lad_use(e, &e->whole[LAD_PASSED])));
		lad_write(e, r, "", lad_text(e, "Time in %s", lad_name(e, i)));
	}
	for (int i = 0; i < e->sfc->step_count; i++) {
		const struct sfc_step *step = &e->sfc->step[i];
		struct lad_rung *r = lad_begin(e);

		if (!step->max || !step->alarm)
			continue;
		lad_head(r, no(e, &e->step[i][LAD_X]));
		lad_head(r, lad_text(e, "[ %s > %s ]", lad_use(e, &e->step[i][LAD_T]),
				     lad_words(e, text_of(e, step->max))));
		lad_out(r, lad_text(e, "S %s", lad_words(e, text_of(e, step->alarm))));
		lad_write(e, r, "", lad_text(e, "%s takes too long", lad_name(e, i)));
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

static bool has(const struct sfc_steps *steps, int step)
{
	for (int i = 0; i < steps->count; i++)
		if (steps->step[i] == step)
			return true;
	return false;
}

char *lad_steps_text(struct lad *e, const struct sfc_steps *steps)
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

/* Rows that begin at the rail one below the other, each with its contacts, joined at one
 * bar: these become ways. False: something else. */
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

static void write_condition(struct lad *e, struct lad_rung *r, int arc)
{
	const int number = e->net.arc[arc].transition;
	const struct sfc_body *body = &e->sfc->transition[number].condition;
	const struct rung *rung = body->kind == BODY_LIST ? NULL :
				  e->pou->rung[body->first];
	const char *result;

	if (body->kind == BODY_EXPRESSION) {
		lad_expression(e, r, lad_words(e, text_of(e, rung_at(rung, 0, 0)->operand)));
	} else if (rung && is_simple(rung)) {
		put_rung(e, r, rung);
	} else {
		result = lad_use(e, &e->arc[arc][LAD_RESULT]);
		lad_body(e, number, result);
		lad_cell(r, lad_text(e, "CALL %s", text_of(e, e->body[number])));
		lad_cell(r, lad_text(e, "NO %s", result));
	}
}

/* What has to be before a condition is asked: a cell each. */
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

/* By modes: it fires if it is true and may, or by hand. */
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

void lad_arc(struct lad *e, int arc, const char *label)
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

/* Those that act together, behind all of their conditions; IN ORDER each has acted. */
static int arcs_together(const struct lad *e)
{
	return lad_is_in_order(e) ? 0 : e->net.arc_count;
}

/* ---- which steps begin and end ---- */

static bool is_initial(const struct lad *e, int step)
{
	return has(&e->net.initial, step);
}

static void put_forced(struct lad *e, struct lad_rung *r, int step)
{
	struct sfc_steps steps;

	for (int i = 0; lad_has_force(e) && i < e->reach; i++) {
		e->good &= sfc_forced(e->sfc, i, e->arena, &steps);
		if (!has(&steps, step))
			continue;
		lad_way(r);
		lad_cell(r, no(e, &e->step[i][LAD_FORCED]));
	}
}

/* With UNTIL STABLE actions ask what was gathered; times and SET ask in each round. */
static bool reads_start(const struct lad *e, int step)
{
	const struct sfc_step *at = &e->sfc->step[step];
	bool sets = false;

	for (int i = 0; i < at->use_count; i++)
		sets |= e->sfc->use[at->first_use + i].kind != USE_ACTION;
	return !sfc_goes_round(e->sfc) || sets || e->step[step][LAD_T].used;
}

/* Pulses of a step that anything asks for. */
static void write_start(struct lad *e, int step)
{
	struct lad_rung *r = lad_begin(e);

	for (int i = 0; i < arcs_together(e); i++) {
		if (!has(&e->net.arc[i].to, step))
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
		if (!has(&e->net.arc[i].from, step))
			continue;
		lad_way(r);
		lad_cell(r, no(e, &e->arc[i][LAD_FIRES]));
	}
	if (!r || !r->ways)
		lad_cell(r, nc(e, &e->step[step][LAD_LEFT])), lad_cell(r,
			 no(e, &e->step[step][LAD_LEFT])); /* never */
	for (int i = 0; i < arcs_together(e); i++)
		if (has(&e->net.arc[i].to, step))
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

static void write_minimum(struct lad *e, int step)
{
	const struct sfc_step *at = &e->sfc->step[step];
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, &e->step[step][LAD_LEFT]));
	lad_head(r, lad_text(e, "[ %s < %s ]", lad_use(e, &e->step[step][LAD_T]),
			     lad_words(e, text_of(e, at->min))));
	lad_out(r, lad_text(e, "S %s", lad_words(e, text_of(e, at->alarm))));
	lad_write(e, r, "", lad_text(e, "%s was too short", lad_name(e, step)));
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
	for (int i = 0; i < e->sfc->step_count; i++)
		if (e->sfc->step[i].min && e->sfc->step[i].alarm && !lad_is_in_order(e))
			write_minimum(e, i);
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

static void write_resets(struct lad *e)
{
	for (int i = 0; i < arcs_together(e); i++) {
		const struct sfc_arc *arc = &e->net.arc[i];
		struct lad_rung *r = lad_begin(e);

		lad_head(r, no(e, &e->arc[i][LAD_FIRES]));
		for (int k = 0; k < arc->from.count; k++)
			lad_out(r, coil(e, "R", &e->step[arc->from.step[k]][LAD_X]));
		lad_write(e, r, "", lad_text(e, "Leave %s", lad_steps_text(e, &arc->from)));
	}
	if (lad_has_reset(e))
		write_leaving(e, &e->whole[LAD_ANEW], "RESET leaves all steps");
	if (lad_has_force(e))
		write_leaving(e, &e->whole[LAD_SET], "FORCE leaves all steps");
}

static void write_sets(struct lad *e)
{
	struct lad_rung *r;

	for (int i = 0; i < arcs_together(e); i++) {
		const struct sfc_arc *arc = &e->net.arc[i];

		r = lad_begin(e);
		lad_head(r, no(e, &e->arc[i][LAD_FIRES]));
		for (int k = 0; k < arc->to.count; k++)
			lad_out(r, coil(e, "S", &e->step[arc->to.step[k]][LAD_X]));
		lad_write(e, r, "", lad_text(e, "Enter %s", lad_steps_text(e, &arc->to)));
	}
	r = lad_begin(e);
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
		r = lad_begin(e);
		lad_head(r, no(e, &e->step[i][LAD_FORCED]));
		for (int k = 0; k < steps.count; k++)
			lad_out(r, coil(e, "S", &e->step[steps.step[k]][LAD_X]));
		lad_write(e, r, "", lad_text(e, "FORCE enters %s", lad_name(e, i)));
	}
}

void lad_once(struct lad *e, struct lad_rung *r, int step)
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

		if (e->step[i][LAD_T].used) {
			lad_head(r, no(e, &e->step[i][LAD_START]));
			lad_out(r, lad_text(e, "[ %s := T#0s ]",
					    lad_use(e, &e->step[i][LAD_T])));
			lad_write(e, r, "", lad_text(e, "The time in %s begins",
						     lad_name(e, i)));
		}
		r = lad_begin(e);
		lad_once(e, r, i);
		if (!r || !r->outs)
			continue;
		lad_head(r, no(e, &e->step[i][LAD_START]));
		lad_write(e, r, "", lad_text(e, "Once in %s", lad_name(e, i)));
	}
}

/* UNTIL STABLE: once more if anything fired. */
static void write_again(struct lad *e)
{
	struct lad_rung *r = lad_begin(e);

	if (!sfc_goes_round(e->sfc) || !e->net.arc_count)
		return;
	if (e->sfc->control[CONTROL_SEMI] && !lad_is_in_order(e)) {
		lad_head(r, no(e, &e->whole[LAD_ONCE]));
		lad_out(r, coil(e, "R", &e->whole[LAD_GO]));
		lad_write(e, r, "", "SEMI: one TIP is one evolution");
		r = lad_begin(e);
	}
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

/* What UNTIL STABLE gathers begins FALSE in each scan. */
static void write_gathered(struct lad *e)
{
	for (int i = 0; sfc_goes_round(e->sfc) && i < e->sfc->step_count; i++)
		for (int k = LAD_STARTED; k <= LAD_ENDED; k++) {
			struct lad_rung *r = lad_begin(e);

			if (!e->step[i][k].used)
				continue;
			lad_head(r, lad_text(e, "NO SYS_ALWAYS_ON"));
			lad_out(r, coil(e, "R", &e->step[i][k]));
			lad_write(e, r, "", lad_name(e, i));
		}
}

void lad_steps(struct lad *e)
{
	struct lad_rung *r;

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
	r = lad_begin(e);
	lad_head(r, no(e, &e->whole[LAD_FIRST]));
	lad_out(r, coil(e, "S", &e->whole[LAD_RUNS]));
	lad_write(e, r, "", "From now on it runs");
}
