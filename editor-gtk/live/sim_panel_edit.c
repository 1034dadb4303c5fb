/* SPDX-License-Identifier: MIT
 *
 * sim_panel_edit - the field in which a person types a value, in the place of the value.
 *
 * Return makes it hold at once; Escape, or going elsewhere, leaves it as it was. What is no
 * value of the type stays in the field, marked.
 */
#include "editor-gtk/live/sim_panel_view_inside.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/tip.h"

static struct location place_of(const LadderSimRowView *view)
{
	const LadderSimRow *row = view->row;

	return view->editing == SIM_EDIT_PRESET ? row->given : row->at;
}

static void give_back_focus(LadderSimRowView *view)
{
	GtkWidget *item = gtk_widget_get_parent(GTK_WIDGET(view));

	if (item)
		gtk_widget_grab_focus(item);
}

void sim_view_end_edit(LadderSimRowView *view)
{
	if (!view->entry || !gtk_widget_get_visible(view->entry))
		return;
	gtk_widget_set_visible(view->entry, FALSE);
	gtk_widget_set_visible(view->value, view->row && !sim_row_is_bit(view->row));
}

static void mark_bad(LadderSimRowView *view, bool bad)
{
	const char *type = iec_type_row(place_of(view).type)->word;
	char *why = bad ? g_strdup_printf(_("Not a value of type %s"), type) : NULL;

	if (bad)
		gtk_widget_add_css_class(view->entry, "error");
	else
		gtk_widget_remove_css_class(view->entry, "error");
	tip_set(view->entry, why);
	gtk_accessible_update_state(GTK_ACCESSIBLE(view->entry), GTK_ACCESSIBLE_STATE_INVALID,
				    bad ? GTK_ACCESSIBLE_INVALID_TRUE :
					  GTK_ACCESSIBLE_INVALID_FALSE, -1);
	g_free(why);
}

static void entered(GtkEntry *entry, LadderSimRowView *view)
{
	const struct location at = place_of(view);
	struct iec_text room;
	union iec_value value;

	if (!sim_value_read(at.type, gtk_editable_get_text(GTK_EDITABLE(entry)), &room,
			    &value)) {
		mark_bad(view, true);
		return;
	}
	if (view->row->kind == SIM_PRESET && view->editing == SIM_EDIT_VALUE)
		sim_row_set_elapsed(view->row, view->sim, value);
	else
		sim_row_set(view->row, view->sim, at, value);
	give_back_focus(view);
	sim_view_end_edit(view);
}

static void text_changed(GtkEditable *editable, LadderSimRowView *view)
{
	(void)editable;
	if (gtk_widget_has_css_class(view->entry, "error"))
		mark_bad(view, false);
}

static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType state, LadderSimRowView *view)
{
	(void)keys;
	(void)code;
	(void)state;
	if (key != GDK_KEY_Escape)
		return GDK_EVENT_PROPAGATE;
	give_back_focus(view);
	sim_view_end_edit(view);
	return GDK_EVENT_STOP;
}

static void left(GtkEventControllerFocus *focus, LadderSimRowView *view)
{
	(void)focus;
	sim_view_end_edit(view);
}

static void add_entry(LadderSimRowView *view)
{
	GtkEventController *keys = gtk_event_controller_key_new();
	GtkEventController *focus = gtk_event_controller_focus_new();

	view->entry = gtk_entry_new();
	gtk_widget_add_css_class(view->entry, "field");
	gtk_editable_set_width_chars(GTK_EDITABLE(view->entry), 10);
	gtk_editable_set_alignment(GTK_EDITABLE(view->entry), 1);
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), view);
	g_signal_connect(focus, "leave", G_CALLBACK(left), view);
	g_signal_connect(view->entry, "activate", G_CALLBACK(entered), view);
	g_signal_connect(view->entry, "changed", G_CALLBACK(text_changed), view);
	gtk_widget_add_controller(view->entry, keys);
	gtk_widget_add_controller(view->entry, focus);
	gtk_box_insert_child_after(GTK_BOX(view->line), view->entry, view->value);
}

static char *field_name(const LadderSimRowView *view)
{
	return view->row->kind != SIM_PRESET ? g_strdup(view->row->name) :
	       g_strdup_printf(view->editing == SIM_EDIT_PRESET ? _("%s, preset") :
			       view->row->group == SIM_COUNTERS ? _("%s, count") :
			       _("%s, elapsed"), view->row->name);
}

void ladder_sim_row_view_edit(LadderSimRowView *view, enum sim_edit what)
{
	struct location at;
	char *text, *name;

	if (!view->row || view->row->kind == SIM_HEADING || sim_row_is_bit(view->row))
		return;
	view->editing = what;
	at = place_of(view);
	if (at.type == IEC_NONE || at.constant)
		return;
	if (!view->entry)
		add_entry(view);
	text = sim_value_text(at.type, sim_row_value(view->row, view->sim, at));
	name = field_name(view);
	gtk_editable_set_text(GTK_EDITABLE(view->entry), text);
	gtk_accessible_update_property(GTK_ACCESSIBLE(view->entry),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	mark_bad(view, false);
	gtk_widget_set_visible(view->value, FALSE);
	gtk_widget_set_visible(view->entry, TRUE);
	gtk_widget_grab_focus(view->entry);
	g_free(name);
	g_free(text);
}

/* Later: the item of the list takes the focus when it is clicked. */
static gboolean edit_later(gpointer data)
{
	LadderSimRowView *view = data;
	const bool preset = view->row && view->row->given.type != IEC_NONE;

	ladder_sim_row_view_edit(view, preset ? SIM_EDIT_PRESET : SIM_EDIT_VALUE);
	g_object_unref(view);
	return G_SOURCE_REMOVE;
}

static void value_released(GtkGestureClick *gesture, int times, double x, double y,
			   LadderSimRowView *view)
{
	(void)gesture;
	(void)times;
	(void)x;
	(void)y;
	g_idle_add(edit_later, g_object_ref(view));
}

void sim_view_can_edit(LadderSimRowView *view)
{
	GtkGesture *click = gtk_gesture_click_new();

	gtk_widget_set_cursor_from_name(view->value, "text");
	g_signal_connect(click, "released", G_CALLBACK(value_released), view);
	gtk_widget_add_controller(view->value, GTK_EVENT_CONTROLLER(click));
}
