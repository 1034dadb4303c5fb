/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_control - the rungs that look at what a chart is operated with, before all
 * others; in the first scan it begins.
 */
#include "engine/exchange/classic/sfc_ladder_parts.h"

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

bool lad_has_reset(const struct lad *e)
{
	return e->sfc->control[CONTROL_RESET];
}

bool lad_has_force(const struct lad *e)
{
	return e->sfc->control[CONTROL_FORCE];
}

bool lad_has_gate(const struct lad *e)
{
	return lad_has_reset(e) || lad_has_force(e) || e->sfc->control[CONTROL_HOLD];
}

bool lad_has_modes(const struct lad *e)
{
	return e->sfc->control[CONTROL_SEMI] || e->sfc->control[CONTROL_MANUAL];
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
	for (int i = 0; i < e->reach; i++) {
		r = lad_begin(e);
		lad_head(r, no(e, &e->whole[LAD_CHANGED]));
		lad_head(r, lad_text(e, "[ %s = %d ]", number, i + 1));
		lad_out(r, coil(e, "COIL", &e->step[i][LAD_FORCED]));
		lad_write(e, r, "", lad_text(e, "%s is forced", lad_name(e, i)));
	}
	r = lad_begin(e);
	lad_head(r, no(e, &e->whole[LAD_CHANGED]));
	lad_head(r, lad_text(e, "[ %s >= 1 ]", number));
	lad_head(r, lad_text(e, "[ %s <= %d ]", number, e->reach));
	lad_out(r, coil(e, "COIL", &e->whole[LAD_SET]));
	lad_write(e, r, "", "A step is forced");
}

/* SEMI: only when TIP rises. MANUAL: then all that are enabled, and it wins. */
static void write_modes(struct lad *e)
{
	const char *semi = lad_words(e, text_of(e, e->sfc->control[CONTROL_SEMI]));
	const char *manual = lad_words(e, text_of(e, e->sfc->control[CONTROL_MANUAL]));
	const char *tip = lad_words(e, text_of(e, e->sfc->control[CONTROL_TIP]));
	struct lad_rung *r = lad_begin(e);

	lad_head(r, *tip ? lad_text(e, "P %s", tip) : lad_text(e, "NC SYS_ALWAYS_ON"));
	lad_out(r, coil(e, "COIL", &e->whole[LAD_HAND]));
	lad_write(e, r, "", "TIP rises");
	r = lad_begin(e);
	if (*manual)
		lad_head(r, lad_text(e, "NC %s", manual));
	if (*semi) {
		lad_cell(r, lad_text(e, "NC %s", semi));
		lad_way(r);
		lad_cell(r, no(e, &e->whole[LAD_HAND]));
	}
	lad_out(r, coil(e, "COIL", &e->whole[LAD_GO]));
	lad_write(e, r, "", "Transitions fire when they are true");
	if (*semi && sfc_goes_round(e->sfc)) {
		r = lad_begin(e);
		lad_head(r, lad_text(e, "NO %s", semi));
		lad_out(r, coil(e, "COIL", &e->whole[LAD_ONCE]));
		lad_write(e, r, "", "SEMI, whatever the chart makes of it in this scan");
	}
	r = lad_begin(e);
	if (*manual)
		lad_head(r, lad_text(e, "NC %s", manual));
	else
		lad_head(r, lad_text(e, "NO SYS_ALWAYS_ON"));
	lad_out(r, coil(e, "R", &e->whole[LAD_HAND]));
	lad_write(e, r, "", "Whatever they are, in MANUAL alone");
}

void lad_control(struct lad *e)
{
	const char *reset = lad_words(e, text_of(e, e->sfc->control[CONTROL_RESET]));
	const char *hold = lad_words(e, text_of(e, e->sfc->control[CONTROL_HOLD]));
	struct lad_rung *r = lad_begin(e);

	if (lad_has_reset(e)) {
		lad_head(r, lad_text(e, "P %s", reset));
		lad_head(r, no(e, &e->whole[LAD_RUNS]));
		lad_out(r, coil(e, "COIL", &e->whole[LAD_ANEW]));
		lad_write(e, r, "", "RESET: all begins anew");
	}
	if (lad_has_force(e))
		write_force(e, reset);
	if (lad_has_modes(e))
		write_modes(e);
	r = lad_begin(e);
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
	r = lad_begin(e);
	lad_head(r, nc(e, &e->whole[LAD_RUNS]));
	lad_out(r, coil(e, "COIL", &e->whole[LAD_FIRST]));
	lad_write(e, r, "", "The first scan");
}
