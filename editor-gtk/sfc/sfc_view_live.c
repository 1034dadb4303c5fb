/* SPDX-License-Identifier: MIT
 *
 * sfc_view_live - states of the running program on a chart: active steps, their times,
 * transitions that wait for their conditions.
 *
 * It shows results of the program and evaluates nothing: Step.X and Step.T are variables of
 * the program, the value of a condition is the power of its rung.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include "editor-gtk/draw/diff_draw.h"

#include "engine/model/sfc_net.h"

#include <string.h>

static struct location find(LadderSfcView *view, const char *step, const char *member)
{
	char *name = g_strdup_printf("%s.%s", step, member);
	struct location at = live_map_find(view->places.map, name, strlen(name));

	g_free(name);
	return at;
}

/* The places of all steps, looked up once a program. */
static bool find_places(LadderSfcView *view)
{
	struct sfc_places *live = &view->places;
	const struct sfc *sfc = view->sheet->layout->sfc;

	if (live->active)
		return live->map;
	live->map = live_map_new(&ladder_sim_twin(view->canvas->sim)->resource,
		project_text(view->sheet->project, sfc_pou(view)->name), NULL);
	live_map_set_sim(live->map, view->canvas->sim);
	live->active = g_new0(struct location, sfc->step_count + 1);
	live->time = g_new0(struct location, sfc->step_count + 1);
	live->step = g_new0(uint8_t, sfc->step_count + 1);
	live->transition = g_new0(uint8_t, sfc->transition_count + 1);
	for (int i = 0; live->map && i < sfc->step_count; i++) {
		live->active[i] = find(view, view->sheet->name[i], "X");
		live->time[i] = find(view, view->sheet->name[i], "T");
	}
	return live->map;
}

/* The condition of an enabled transition: the power at the coil of its last rung. */
static bool was_true(LadderSfcView *view, const struct sfc_body *body)
{
	const struct resource *resource = &ladder_sim_twin(view->canvas->sim)->resource;
	const struct pou *pou = sfc_pou(view);
	const int rung = body->first + body->count - 1;
	const int unit = ladder_sim_pou(view->canvas->sim, view->canvas->document,
					view->canvas->pou);
	bool in = false, out = false;
	int number;

	if ((body->kind != BODY_EXPRESSION && body->kind != BODY_RUNGS) || rung < 0 ||
	    rung >= pou->rung_count)
		return false;
	number = ladder_sim_rung(view->canvas->sim, view->canvas->document, view->canvas->pou, rung);
	return number >= 0 && unit >= 0 && ladder_sim_has_power(view->canvas->sim,
			project_text(view->sheet->project, pou->name)) &&
	       resource_power(resource, (uint32_t)unit, (uint32_t)number + 1, 1,
			      pou->rung[rung]->cols, &in, &out) && in;
}

static void look_at_ways(LadderSfcView *view)
{
	struct sfc_places *live = &view->places;
	const struct sfc *sfc = view->sheet->layout->sfc;

	for (int t = 0; t < sfc->transition_count; t++) {
		const struct sfc_transition *transition = &sfc->transition[t];
		bool enabled = transition->from_count > 0;

		for (int i = 0; i < transition->from_count; i++) {
			const int step = sfc->ref[transition->first_from + i].step;

			enabled = enabled && step >= 0 && live->step[step] & SFC_ACTIVE;
		}
		live->transition[t] = SFC_KNOWN | (enabled ? SFC_ENABLED : 0);
		if (enabled && was_true(view, &transition->condition))
			live->transition[t] |= SFC_TRUE;
	}
}

static bool time_of(void *context, int step, char *out, size_t size)
{
	LadderSfcView *view = context;
	const struct image *image = &ladder_sim_twin(view->canvas->sim)->resource.image;
	const struct location at = view->places.time[step];

	if (!(view->places.step[step] & SFC_ACTIVE) || at.type == IEC_NONE)
		return false;
	live_value_print(at.type, image_get(image, at), out, size);
	return true;
}

bool sfc_live_look(LadderSfcView *view, struct sfc_live *out)
{
	struct sfc_places *live = &view->places;
	const struct image *image;

	if (!canvas_is_live(LADDER_CANVAS(view)) || !view->sheet || !find_places(view))
		return false;
	image = &ladder_sim_twin(view->canvas->sim)->resource.image;
	for (int i = 0; i < view->sheet->layout->sfc->step_count; i++) {
		const struct location at = live->active[i];

		live->step[i] = at.type == IEC_BOOL ? SFC_KNOWN |
			(image_get(image, at).i ? SFC_ACTIVE : 0) : 0;
	}
	look_at_ways(view);
	*out = (struct sfc_live){ live->step, live->transition, time_of, view };
	return true;
}

/* ---- what the board runs without ---- */

static void mark_whole(LadderSfcView *view)
{
	for (int i = 0; i < view->sheet->layout->shape_count; i++) {
		const struct sfc_mark mark = { i, -1, SFC_MISSING };

		g_array_append_val(view->missing, mark);
	}
}

static void mark_others(LadderSfcView *view, const struct project *board, const struct pou *pou)
{
	struct sfc_sheet *before = sfc_sheet_new(board, pou, view->canvas->lettering);
	GArray *gone = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));

	diff_mark_charts(before, view->sheet, gone, view->missing);
	for (guint i = 0; i < view->missing->len; i++)
		g_array_index(view->missing, struct sfc_mark, i).signs = SFC_MISSING;
	g_array_unref(gone);
	sfc_sheet_free(before);
}

const GArray *sfc_missing(LadderSfcView *view)
{
	LadderSim *sim = view->canvas->sim;
	const struct project *board;
	int pou;

	if (view->missing)
		return view->missing;
	view->missing = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));
	if (!sim || !view->sheet || !ladder_sim_may_miss(sim) ||
	    !ladder_sim_is_missing(sim, view->canvas->document, view->canvas->pou, -1))
		return view->missing;
	board = ladder_project(ladder_sim_ladder(sim));
	pou = ladder_sim_pou(sim, view->canvas->document, view->canvas->pou);
	if (pou >= 0 && board->pou[pou].sfc)
		mark_others(view, board, &board->pou[pou]);
	else
		mark_whole(view);
	return view->missing;
}

/* ---- acts ---- */

/* Adds setting a variable to @acts, which are done together. */
static void add_set(LadderSfcView *view, GArray *acts, struct location at, int64_t value)
{
	const struct act act = { .kind = ACT_SET, .at = at, .value.i = value };

	if (at.type == IEC_NONE)
		return;
	canvas_acts(LADDER_CANVAS(view), at, _(verb_row(VERB_force)->label));
	g_array_append_val(acts, act);
}

static GArray *acts_new(void)
{
	return g_array_new(FALSE, FALSE, sizeof(struct act));
}

static void do_acts(LadderSfcView *view, GArray *acts)
{
	ladder_sim_act_all(view->canvas->sim, (const struct act *)(gpointer)acts->data, (int)acts->len);
	g_array_free(acts, TRUE);
}

/* Sets and resets of a step that becomes active. */
static void set_once(LadderSfcView *view, const struct sfc_step *step, GArray *acts)
{
	for (int i = step->first_use; i < step->first_use + step->use_count; i++) {
		const struct sfc_use *use = &view->sheet->layout->sfc->use[i];
		const char *name = project_text(view->sheet->project, use->operand);

		if (use->kind != USE_ACTION)
			add_set(view, acts, live_map_find(view->places.map, name, strlen(name)),
				use->kind == USE_SET);
	}
}

/* Activates only the steps of @index, between two scans, as FORCE does. Pulses and stored
 * actions begin only in a scan. */
static void force_between(LadderSfcView *view, int index)
{
	const struct sfc *sfc = view->sheet->layout->sfc;
	const struct sfc_places *live = &view->places;
	GArray *acts = acts_new();
	struct sfc_steps steps;
	struct arena arena;

	arena_init(&arena);
	if (!sfc_forced(sfc, index, &arena, &steps))
		g_error("out of memory");
	for (int i = 0; i < sfc->step_count; i++) {
		const bool active = sfc_steps_has(&steps, i);

		if (active != ((live->step[i] & SFC_ACTIVE) != 0))
			add_set(view, acts, live->active[i], active);
		if (active)
			add_set(view, acts, live->time[i], 0);
		if (active)
			set_once(view, &sfc->step[i], acts);
	}
	do_acts(view, acts);
	arena_free(&arena);
	canvas_tell(LADDER_CANVAS(view),
		    _("The step is active. Actions with P, S, SD, DS or "
			  "SL start only with CONTROL(FORCE := …)."));
}

/* Uses the variable of CONTROL(FORCE); without one sets the steps itself. */
void sfc_live_force(LadderSfcView *view)
{
	const struct pou *pou = sfc_pou(view);
	const char *name = pou ? project_text(view->sheet->project,
					      pou->sfc->control[CONTROL_FORCE]) : "";
	const char *why = view->canvas->sim ? ladder_sim_why_not(view->canvas->sim, SIM_WISH_SET) :
			  NULL;
	struct location at;
	struct sfc_live now;
	GArray *acts;
	int index;

	if (!sfc_live_look(view, &now)) {
		canvas_tell(LADDER_CANVAS(view), _("The simulation is not running."));
		return;
	}
	if (sfc_part_at_cursor(view, &index) != SFC_STEP) {
		canvas_tell(LADDER_CANVAS(view), _("Select a step first."));
		return;
	}
	if (why) {
		canvas_refuse(LADDER_CANVAS(view), _(verb_row(VERB_force)->label), why);
		return;
	}
	at = live_map_find(view->places.map, name, strlen(name));
	if (!*name || at.type == IEC_NONE) {
		force_between(view, index);
		return;
	}
	acts = acts_new();
	add_set(view, acts, at, index + 1);
	do_acts(view, acts);
}
