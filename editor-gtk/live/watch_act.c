/* SPDX-License-Identifier: MIT
 *
 * watch_act - new values and forces of a status chart, as acts of the simulation.
 */
#include "editor-gtk/live/watch_inside.h"

static void refuse(LadderWatchView *view, LadderWatchRow *row, char *why)
{
	if (row->fresh) {
		gtk_widget_add_css_class(row->fresh, "error");
		gtk_accessible_update_state(GTK_ACCESSIBLE(row->fresh),
			GTK_ACCESSIBLE_STATE_INVALID, GTK_ACCESSIBLE_INVALID_TRUE, -1);
	}
	watch_tell(view, why);
}

/* The value that is typed; false: there is none, or it is refused and that is told. */
static bool take(LadderWatchView *view, LadderWatchRow *row, struct iec_text *room,
		 union iec_value *value)
{
	const struct twin *twin = ladder_sim_twin(view->sim);
	char *why = NULL;

	if (!twin) {
		watch_tell(view, g_strdup(_("The simulation is off.")));
		return false;
	}
	if (view->dirty)
		watch_refresh(view);
	if (watch_row_take(row, &twin->resource.image, room, value, &why))
		return true;
	refuse(view, row, why);
	return false;
}

static void forget_typed(LadderWatchRow *row)
{
	g_free(row->typed);
	row->typed = g_strdup("");
	if (row->fresh)
		gtk_editable_set_text(GTK_EDITABLE(row->fresh), "");
}

bool watch_write(LadderWatchView *view, LadderWatchRow *row)
{
	struct act act = { .kind = ACT_SET };
	struct iec_text room;

	if (!*row->typed || !take(view, row, &room, &act.value))
		return false;
	act.at = row->at;
	ladder_sim_act(view->sim, &act);
	forget_typed(row);
	watch_tell(view, NULL);
	return true;
}

/* All or, if one is refused, those before it: what is still typed was not written. */
void watch_write_all(LadderWatchView *view)
{
	const guint count = g_list_model_get_n_items(G_LIST_MODEL(view->store));
	bool good = true;

	for (guint i = 0; i < count && good; i++) {
		LadderWatchRow *row = watch_row_at(view, i);

		good = !*row->typed || watch_write(view, row);
		g_object_unref(row);
	}
}

void watch_toggle_force(LadderWatchView *view, LadderWatchRow *row)
{
	struct act act = { .kind = row->forced ? ACT_RELEASE : ACT_FORCE, .at = row->at,
			   .value = row->last };
	struct iec_text room;

	if (!row->live)
		return;
	if (!row->forced && *row->typed) {
		if (!take(view, row, &room, &act.value))
			return;
		forget_typed(row);
	}
	ladder_sim_act(view->sim, &act);
	watch_tell(view, NULL);
}
