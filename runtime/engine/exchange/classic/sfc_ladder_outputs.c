/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_outputs - the program that does what active steps ask for.
 *
 * First what is stored, then what is called for, then actions and BOOLs in their order.
 */
#include "engine/exchange/classic/sfc_ladder_parts.h"

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

/* The pulse of a step in this scan. */
static struct lad_var *began(struct lad *e, int step)
{
	return &e->step[step][sfc_goes_round(e->sfc) ? LAD_STARTED : LAD_START];
}

static struct lad_var *ended(struct lad *e, int step)
{
	return &e->step[step][sfc_goes_round(e->sfc) ? LAD_ENDED : LAD_END];
}

/* Does line @use call for @called? */
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

/* ---- what is stored ---- */

/* SD, SL: the time since it was stored; HOLD stops it with the others. */
static void write_since(struct lad *e, int line)
{
	const struct sfc_use *use = &e->sfc->use[line];
	const char *since = lad_use(e, &e->line[line][LAD_SINCE]);
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, &e->line[line][LAD_STORED]));
	lad_out(r, lad_text(e, "[ %s := %s + %s ]", since, since,
			    lad_use(e, &e->whole[LAD_PASSED])));
	lad_write(e, r, "", lad_text(e, "%s: its time", title_of(e, use)));
	r = lad_begin(e);
	lad_head(r, no(e, began(e, use->step)));
	lad_head(r, nc(e, &e->line[line][LAD_STORED]));
	lad_out(r, lad_text(e, "[ %s := T#0s ]", since));
	lad_write(e, r, "", lad_text(e, "%s: it begins", title_of(e, use)));
}

/* DS: as long as its step has been active without a break, and no R. */
static void write_armed(struct lad *e, int line)
{
	const struct sfc_use *use = &e->sfc->use[line];
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, began(e, use->step)));
	lad_out(r, coil(e, "S", &e->line[line][LAD_ARMED]));
	lad_write(e, r, "", lad_text(e, "%s: it waits", title_of(e, use)));
	r = lad_begin(e);
	lad_head(r, nc(e, &e->step[use->step][LAD_X]));
	lad_out(r, coil(e, "R", &e->line[line][LAD_ARMED]));
	lad_write(e, r, "", lad_text(e, "%s: it waits no more", title_of(e, use)));
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
	struct lad_rung *r;

	write_anew(e, line);
	if (q == QUALIFIER_SD || q == QUALIFIER_SL)
		write_since(e, line);
	if (q == QUALIFIER_DS)
		write_armed(e, line);
	r = lad_begin(e);
	if (q == QUALIFIER_DS) {
		lad_head(r, no(e, &e->line[line][LAD_ARMED]));
		lad_head(r, lad_text(e, "[ %s >= %s ]",
				     lad_use(e, &e->step[use->step][LAD_T]),
				     lad_words(e, text_of(e, use->time))));
	} else {
		lad_head(r, no(e, began(e, use->step)));
	}
	lad_out(r, coil(e, "S", &e->line[line][LAD_STORED]));
	lad_write(e, r, "", title_of(e, use));
}

/* An R of @called, in any step, ends line @line. */
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

/* ---- what is called for ---- */

static char *time_cell(struct lad *e, const struct sfc_use *use, struct lad_var *var,
		       const char *sign)
{
	return lad_text(e, "[ %s %s %s ]", lad_use(e, var), sign,
			lad_words(e, text_of(e, use->time)));
}

/* One line as a way of the rung. */
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

/* While a step has it with R nothing calls for it. */
static void put_refusals(struct lad *e, struct lad_rung *r, const struct lad_called *called)
{
	for (int i = 0; i < e->sfc->use_count; i++)
		if (e->sfc->use[i].qualifier == QUALIFIER_R &&
		    is_of(e, &e->sfc->use[i], called))
			lad_head(r, nc(e, &e->step[e->sfc->use[i].step][LAD_X]));
}

/* @pulses: the lines of P0 and P1 alone, else those without them, or with @all both. */
static bool put_lines(struct lad *e, struct lad_rung *r, const struct lad_called *called,
		      bool pulses, bool all)
{
	bool any = false;

	put_refusals(e, r, called);
	for (int i = 0; i < e->sfc->use_count; i++) {
		const struct sfc_use *use = &e->sfc->use[i];

		if (!is_of(e, use, called) || use->qualifier == QUALIFIER_R ||
		    (!all && is_pulse(use->qualifier) != pulses))
			continue;
		put_line(e, r, i);
		any = true;
	}
	return any;
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

/* The bits of what is called for; of a BOOL that is nobody else's, the BOOL itself. */
static void write_called(struct lad *e, struct lad_called *called)
{
	struct lad_rung *r = lad_begin(e);
	const char *name = text_of(e, called->operand);
	const char *what = lad_words(e, name);

	if (!put_lines(e, r, called, false, true)) {
		r = lad_begin(e);
		lad_head(r, lad_text(e, "NC SYS_ALWAYS_ON"));
	}
	lad_out(r, called->alone ? lad_text(e, "COIL %s", what) :
		coil(e, "COIL", &called->var[LAD_CALLED]));
	lad_write(e, r, "", lad_text(e, called->alone ? "%s" : "%s is called for", name));
	if (called->action < 0 || !is_mixed(e, called))
		return;
	r = lad_begin(e);
	if (!put_lines(e, r, called, false, false)) {
		r = lad_begin(e);
		lad_head(r, lad_text(e, "NC SYS_ALWAYS_ON"));
	}
	lad_out(r, coil(e, "COIL", &called->var[LAD_LEVEL]));
	lad_write(e, r, "", lad_text(e, "%s is called for, not by P0 or P1 alone", name));
}

/* ---- doing it ---- */

static void write_bool(struct lad *e, struct lad_called *called)
{
	const char *name = text_of(e, called->operand), *what = lad_words(e, name);
	struct lad_rung *r = lad_begin(e);

	if (called->alone)
		return;
	lad_head(r, no(e, &called->var[LAD_CALLED]));
	lad_out(r, lad_text(e, "S %s", what));
	lad_write(e, r, "", name);
	r = lad_begin(e);
	lad_head(r, nc(e, &called->var[LAD_CALLED]));
	lad_head(r, no(e, &called->var[LAD_WAS]));
	lad_out(r, lad_text(e, "R %s", what));
	lad_write(e, r, "", lad_text(e, "%s, when it is called for no more", name));
	r = lad_begin(e);
	lad_head(r, no(e, &called->var[LAD_CALLED]));
	lad_out(r, coil(e, "COIL", &called->var[LAD_WAS]));
	lad_write(e, r, "", lad_text(e, "Was %s called for?", name));
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
	r = lad_begin(e);
	lad_head(r, no(e, level));
	lad_out(r, coil(e, "COIL", &called->var[LAD_WAS]));
	lad_write(e, r, "", lad_text(e, "Was %s called for?", name));
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
