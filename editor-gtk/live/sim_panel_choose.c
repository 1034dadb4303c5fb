/* SPDX-License-Identifier: MIT
 *
 * sim_panel_choose - what a person chooses for a line of the simulation panel: a push button
 * or a switch, a key of its own, the range of its slider. The project keeps it.
 */
#include "editor-gtk/live/sim_panel_inside.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/live/sim_panel_kept.h"
#include "editor-gtk/kit/gtk48/tip.h"

/* ---- kept ---- */

static void keep(LadderSimPanel *panel, const LadderSimRow *row)
{
	LadderDocument *document = ladder_sim_document(panel->sim);
	char *view = sim_kept_write(ladder_document_view(document), row);

	ladder_document_begin(document, _("Change the simulation panel"), NULL);
	ladder_document_set_view(document, view);
	ladder_document_end(document);
	g_free(view);
}

/* A line as it is to become; caller: put. */
static LadderSimRow *draft_of(const LadderSimRow *row)
{
	LadderSimRow *draft = g_object_new(LADDER_TYPE_SIM_ROW, NULL);

	g_free(draft->name);
	draft->name = g_strdup(row->name);
	draft->plant = row->plant;
	draft->push = row->push;
	draft->key = g_strdup(row->key);
	draft->key_toggles = row->key_toggles;
	draft->ranged = row->ranged;
	draft->low = row->low;
	draft->high = row->high;
	return draft;
}

static void put(LadderSimPanel *panel, LadderSimRow *draft)
{
	keep(panel, draft);
	g_object_unref(draft);
}

static void toggle_push(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(widget);
	const LadderSimRow *row = sim_panel_selected(panel);
	LadderSimRow *draft;

	(void)name;
	(void)unused;
	if (!row || row->kind != SIM_SWITCH)
		return;
	draft = draft_of(row);
	draft->push = !row->push;
	put(panel, draft);
}

/* ---- asking ---- */

void sim_panel_end_asking(LadderSimPanel *panel)
{
	g_clear_pointer(&panel->asking, popover_drop);
}

static gboolean end_later(gpointer data)
{
	LadderSimPanel *panel = data;

	sim_panel_end_asking(panel);
	g_object_unref(panel);
	return G_SOURCE_REMOVE;
}

static void closed(LadderSimPanel *panel)
{
	g_idle_add(end_later, g_object_ref(panel));
}

/* A small window of its own at the line, with @child in it. */
static void ask(LadderSimPanel *panel, GtkWidget *child)
{
	GtkWidget *at = GTK_WIDGET(sim_panel_view_of(panel, sim_panel_selected(panel)));
	graphene_rect_t box = GRAPHENE_RECT_INIT(0, 0, 1, 1);

	sim_panel_end_asking(panel);
	panel->asking = gtk_popover_new();
	gtk_popover_set_child(GTK_POPOVER(panel->asking), child);
	gtk_widget_set_parent(panel->asking, GTK_WIDGET(panel));
	if (at && gtk_widget_compute_bounds(at, GTK_WIDGET(panel), &box))
		gtk_popover_set_pointing_to(GTK_POPOVER(panel->asking), &(GdkRectangle){
			(int)box.origin.x, (int)box.origin.y, (int)box.size.width,
			(int)box.size.height });
	g_signal_connect_swapped(panel->asking, "closed", G_CALLBACK(closed), panel);
	gtk_popover_popup(GTK_POPOVER(panel->asking));
}

/* ---- a key ---- */

static void bind_key(LadderSimPanel *panel, const char *key, bool toggles)
{
	const LadderSimRow *row = sim_panel_selected(panel);
	LadderSimRow *draft;

	if (!row)
		return;
	draft = draft_of(row);
	g_free(draft->key);
	draft->key = g_strdup(key);
	draft->key_toggles = key && toggles;
	put(panel, draft);
}

static gboolean key_given(GtkEventControllerKey *keys, guint key, guint code,
			  GdkModifierType state, LadderSimPanel *panel)
{
	const bool toggles = g_object_get_data(G_OBJECT(keys), "toggles") != NULL;

	(void)code;
	if (key == GDK_KEY_Escape)
		return GDK_EVENT_PROPAGATE;
	if (!sim_panel_can_bind(key) || state & (GDK_CONTROL_MASK | GDK_ALT_MASK))
		return GDK_EVENT_STOP;
	bind_key(panel, gdk_keyval_name(gdk_keyval_to_lower(key)), toggles);
	gtk_popover_popdown(GTK_POPOVER(panel->asking));
	return GDK_EVENT_STOP;
}

static void ask_key(LadderSimPanel *panel, bool toggles)
{
	const LadderSimRow *row = sim_panel_selected(panel);
	GtkEventController *keys = gtk_event_controller_key_new();
	GtkWidget *label;
	char *text;

	if (!row || !sim_row_is_bit(row)) {
		g_object_unref(keys);
		return;
	}
	text = g_strdup_printf(toggles ? _("Press the key that toggles %s") :
			       _("Press the key that holds %s on"), row->name);
	label = gtk_label_new(NULL);
	gtk_label_set_wrap(GTK_LABEL(label), TRUE);
	gtk_label_set_max_width_chars(GTK_LABEL(label), 28);
	gtk_widget_set_focusable(label, TRUE);
	ask(panel, label);
	popover_tell(GTK_LABEL(label), text);
	gtk_widget_grab_focus(label);
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_object_set_data(G_OBJECT(keys), "toggles", toggles ? panel : NULL);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_given), panel);
	gtk_widget_add_controller(panel->asking, keys);
	g_free(text);
}

static void hold_key(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	ask_key(LADDER_SIM_PANEL(widget), false);
}

static void toggle_key(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	ask_key(LADDER_SIM_PANEL(widget), true);
}

static void no_key(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	bind_key(LADDER_SIM_PANEL(widget), NULL, false);
}

/* ---- a range ---- */

static double number_in(GtkWidget *entry, bool *good)
{
	const char *text = gtk_editable_get_text(GTK_EDITABLE(entry));
	char *end = NULL;
	const double number = g_ascii_strtod(text, &end);

	*good = *text && *end == '\0' && number > -1e300 && number < 1e300;
	return number;
}

static void range_given(GtkWidget *entry, LadderSimPanel *panel)
{
	GtkWidget *box = gtk_widget_get_parent(entry);
	GtkWidget *low = gtk_widget_get_first_child(box);
	GtkWidget *high = gtk_widget_get_last_child(box);
	const LadderSimRow *row = sim_panel_selected(panel);
	LadderSimRow *draft;
	bool good[2];

	if (!row)
		return;
	draft = draft_of(row);
	draft->ranged = true;
	draft->low = number_in(low, &good[0]);
	draft->high = number_in(high, &good[1]);
	if (!good[0] || !good[1] || draft->low >= draft->high) {
		gtk_widget_add_css_class(entry, "error");
		tip_set(entry, _("From a number to a larger one"));
		g_object_unref(draft);
		return;
	}
	put(panel, draft);
	gtk_popover_popdown(GTK_POPOVER(panel->asking));
}

static GtkWidget *number_entry(LadderSimPanel *panel, const char *name, double value)
{
	GtkWidget *entry = gtk_entry_new();
	char text[G_ASCII_DTOSTR_BUF_SIZE];

	gtk_editable_set_text(GTK_EDITABLE(entry), g_ascii_formatd(text, sizeof(text),
								  "%.15g", value));
	gtk_editable_set_width_chars(GTK_EDITABLE(entry), 8);
	gtk_entry_set_placeholder_text(GTK_ENTRY(entry), name);
	gtk_accessible_update_property(GTK_ACCESSIBLE(entry), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       name, -1);
	g_signal_connect(entry, "activate", G_CALLBACK(range_given), panel);
	return entry;
}

static void ask_range(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(widget);
	const LadderSimRow *row = sim_panel_selected(panel);
	GtkWidget *box;

	(void)name;
	(void)unused;
	if (!row || (row->kind != SIM_SLIDER && row->kind != SIM_LEVEL))
		return;
	box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	gtk_box_append(GTK_BOX(box), number_entry(panel, _("Lowest value"), row->low));
	gtk_box_append(GTK_BOX(box), gtk_label_new("–"));
	gtk_box_append(GTK_BOX(box), number_entry(panel, _("Highest value"), row->high));
	ask(panel, box);
	gtk_widget_grab_focus(gtk_widget_get_first_child(box));
}

static void no_range(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(widget);
	const LadderSimRow *row = sim_panel_selected(panel);
	LadderSimRow *draft;

	(void)name;
	(void)unused;
	if (!row)
		return;
	draft = draft_of(row);
	draft->ranged = false;
	put(panel, draft);
}

/* ---- the menu ---- */

GMenuModel *sim_panel_choices(LadderSimPanel *panel, const LadderSimRow *row)
{
	GMenu *menu = g_menu_new();
	const bool ranged = row->kind == SIM_SLIDER || row->kind == SIM_LEVEL;

	(void)panel;
	if (row->kind == SIM_SWITCH)
		g_menu_append(menu, row->push ? _("Is a Switch") : _("Is a Push Button"),
			      "sim-panel.push");
	if (sim_row_is_bit(row)) {
		g_menu_append(menu, _("Key That Holds It On…"), "sim-panel.hold-key");
		g_menu_append(menu, _("Key That Toggles It…"), "sim-panel.toggle-key");
	}
	if (row->key)
		g_menu_append(menu, _("No Key"), "sim-panel.no-key");
	if (ranged)
		g_menu_append(menu, _("Range…"), "sim-panel.range");
	if (ranged && row->ranged)
		g_menu_append(menu, _("Range of Its Type"), "sim-panel.no-range");
	return G_MENU_MODEL(menu);
}

void sim_panel_install_choices(GtkWidgetClass *class)
{
	gtk_widget_class_install_action(class, "sim-panel.push", NULL, toggle_push);
	gtk_widget_class_install_action(class, "sim-panel.hold-key", NULL, hold_key);
	gtk_widget_class_install_action(class, "sim-panel.toggle-key", NULL, toggle_key);
	gtk_widget_class_install_action(class, "sim-panel.no-key", NULL, no_key);
	gtk_widget_class_install_action(class, "sim-panel.range", NULL, ask_range);
	gtk_widget_class_install_action(class, "sim-panel.no-range", NULL, no_range);
}
