/* SPDX-License-Identifier: MIT
 *
 * sfc_view_live - what a chart shows of the program that runs: steps that are active, how
 * long, and which transitions wait for their conditions.
 *
 * It shows what the program computed and evaluates nothing: Step.X and Step.T are
 * variables of the program, and what a condition was is the power of its rung.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include "engine/model/sfc_net.h"

#include <string.h>

bool chart_live_is_on(LadderSfcView *view)
{
	return view->live.sim && ladder_sim_is_on(view->live.sim);
}

void chart_live_forget(LadderSfcView *view)
{
	struct chart_live *live = &view->live;

	g_clear_pointer(&live->map, live_map_free);
	g_clear_pointer(&live->active, g_free);
	g_clear_pointer(&live->time, g_free);
	g_clear_pointer(&live->step, g_free);
	g_clear_pointer(&live->transition, g_free);
}

void chart_live_clear(LadderSfcView *view)
{
	struct chart_live *live = &view->live;

	chart_live_forget(view);
	for (int i = 0; live->sim && i < (int)G_N_ELEMENTS(live->handler); i++)
		g_signal_handler_disconnect(live->sim, live->handler[i]);
	g_clear_object(&live->sim);
}

static struct location find(LadderSfcView *view, const char *step, const char *member)
{
	char *name = g_strdup_printf("%s.%s", step, member);
	struct location at = live_map_find(view->live.map, name, strlen(name));

	g_free(name);
	return at;
}

/* Places of all steps, once a program. */
static bool find_places(LadderSfcView *view)
{
	struct chart_live *live = &view->live;
	const struct sfc *sfc = view->sheet->layout->sfc;

	if (live->active)
		return live->map;
	live->map = live_map_new(&ladder_sim_twin(live->sim)->resource,
		project_text(view->sheet->project, chart_pou(view)->name), NULL);
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

/* Was the condition of an enabled transition true? That of its last rung's coil. */
static bool was_true(LadderSfcView *view, const struct sfc_body *body)
{
	const struct resource *resource = &ladder_sim_twin(view->live.sim)->resource;
	const struct pou *pou = chart_pou(view);
	const int rung = body->first + body->count - 1;
	bool in = false, out = false;
	int number;

	if ((body->kind != BODY_EXPRESSION && body->kind != BODY_RUNGS) || rung < 0 ||
	    rung >= pou->rung_count)
		return false;
	number = ladder_sim_rung(view->live.sim, view->document, view->pou, rung);
	return number >= 0 &&
	       resource_power(resource, (uint32_t)view->pou, (uint32_t)number + 1, 1,
			      pou->rung[rung]->cols, &in, &out) && in;
}

static void look_at_ways(LadderSfcView *view)
{
	struct chart_live *live = &view->live;
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
	const struct image *image = &ladder_sim_twin(view->live.sim)->resource.image;
	const struct location at = view->live.time[step];

	if (!(view->live.step[step] & SFC_ACTIVE) || at.type == IEC_NONE)
		return false;
	live_value_print(at.type, image_get(image, at), out, size);
	return true;
}

bool chart_live_look(LadderSfcView *view, struct sfc_live *out)
{
	struct chart_live *live = &view->live;
	const struct image *image;

	if (!chart_live_is_on(view) || !view->sheet || !find_places(view))
		return false;
	image = &ladder_sim_twin(live->sim)->resource.image;
	for (int i = 0; i < view->sheet->layout->sfc->step_count; i++) {
		const struct location at = live->active[i];

		live->step[i] = at.type == IEC_BOOL ? SFC_KNOWN |
			(image_get(image, at).i ? SFC_ACTIVE : 0) : 0;
	}
	look_at_ways(view);
	*out = (struct sfc_live){ live->step, live->transition, time_of, view };
	return true;
}

/* ---- from outside ---- */

static void shown(LadderSfcView *view)
{
	gtk_widget_queue_draw(GTK_WIDGET(view));
	chart_cells_later(view);
}

static void program_changed(LadderSfcView *view)
{
	chart_live_forget(view);
	shown(view);
}

void ladder_sfc_view_set_sim(LadderSfcView *view, LadderSim *sim)
{
	struct chart_live *live = &view->live;

	chart_live_clear(view);
	if (!sim)
		return;
	live->sim = g_object_ref(sim);
	live->handler[0] = g_signal_connect_swapped(sim, "state-changed", G_CALLBACK(shown),
						    view);
	live->handler[1] = g_signal_connect_swapped(sim, "program-changed",
						    G_CALLBACK(program_changed), view);
	live->handler[2] = g_signal_connect_swapped(sim, "shown", G_CALLBACK(shown), view);
}

static void act_set(LadderSfcView *view, struct location at, int64_t value)
{
	const struct act act = { .kind = ACT_SET, .at = at, .value.i = value };

	if (at.type != IEC_NONE)
		ladder_sim_act(view->live.sim, &act);
}

/* What a step that becomes active does once. */
static void set_once(LadderSfcView *view, const struct sfc_step *step)
{
	for (int i = step->first_use; i < step->first_use + step->use_count; i++) {
		const struct sfc_use *use = &view->sheet->layout->sfc->use[i];
		const char *name = project_text(view->sheet->project, use->operand);

		if (use->kind != USE_ACTION)
			act_set(view, live_map_find(view->live.map, name, strlen(name)),
				use->kind == USE_SET);
	}
}

static bool is_among(const struct sfc_steps *steps, int step)
{
	for (int i = 0; i < steps->count; i++)
		if (steps->step[i] == step)
			return true;
	return false;
}

/* Between two scans: all steps are left, and those that belong to @index are active, as
 * FORCE has it; only what pulses and what is stored needs a scan to begin. */
static void force_between(LadderSfcView *view, int index)
{
	const struct sfc *sfc = view->sheet->layout->sfc;
	const struct chart_live *live = &view->live;
	struct sfc_steps steps;
	struct arena arena;

	arena_init(&arena);
	if (!sfc_forced(sfc, index, &arena, &steps))
		g_error("out of memory");
	for (int i = 0; i < sfc->step_count; i++) {
		const bool active = is_among(&steps, i);

		if (active != ((live->step[i] & SFC_ACTIVE) != 0))
			act_set(view, live->active[i], active);
		if (active)
			act_set(view, live->time[i], 0);
		if (active)
			set_once(view, &sfc->step[i]);
	}
	arena_free(&arena);
	chart_tell(view, _("The step is active. What begins with P, S, SD, DS or SL does so "
			   "by CONTROL(FORCE := …) alone."));
}

/* By the number that CONTROL has for it; else by hand. */
void chart_live_force(LadderSfcView *view)
{
	const struct pou *pou = chart_pou(view);
	const char *name = pou ? project_text(view->sheet->project,
					      pou->sfc->control[CONTROL_FORCE]) : "";
	struct act act = { .kind = ACT_SET };
	struct sfc_live now;
	int index;

	if (!chart_live_look(view, &now)) {
		chart_tell(view, _("nothing is simulated"));
		return;
	}
	if (chart_part(view, &index) != SFC_STEP) {
		chart_tell(view, _("the cursor is not on a step"));
		return;
	}
	act.at = live_map_find(view->live.map, name, strlen(name));
	if (!*name || act.at.type == IEC_NONE) {
		force_between(view, index);
		return;
	}
	act.value.i = index + 1;
	ladder_sim_act(view->live.sim, &act);
}
