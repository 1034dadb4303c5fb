/* SPDX-License-Identifier: MIT
 *
 * sim_panel_view - a line of the panel: what it shows, and what is clicked in it. The field
 * for values is sim_panel_edit.c's.
 */
#include "editor-gtk/live/sim_panel_view_inside.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

#define LOOKS 20 /* a slider waits for its value so long                     */

G_DEFINE_FINAL_TYPE(LadderSimRowView, ladder_sim_row_view, GTK_TYPE_WIDGET)

LadderSimRow *ladder_sim_row_view_row(LadderSimRowView *view)
{
	return view->row;
}

/* ---- what is spoken ---- */

static const char *kind_name(const LadderSimRow *row)
{
	static const char *const name[SIM_GROUPS] = {
		[SIM_INPUTS] = N_("Input"), [SIM_OUTPUTS] = N_("Output"),
		[SIM_MEMORY] = N_("Bit"), [SIM_TIMERS] = N_("Timer"),
		[SIM_COUNTERS] = N_("Counter"), [SIM_ANALOGUE] = N_("Analogue"),
		[SIM_VALUES] = N_("Value"), [SIM_PLANT] = N_("Plant"),
	};

	return _(name[row->group]);
}

static void speak(LadderSimRowView *view)
{
	const LadderSimRow *row = view->row;
	GtkWidget *item = gtk_widget_get_parent(GTK_WIDGET(view));
	const char *state = !sim_row_is_bit(row) ? "" : view->last[0].i ? _("on") : _("off");
	char *name = g_strdup_printf("%s %s%s%s%s%s", kind_name(row), row->name,
				     row->address ? ", " : "",
				     row->address ? row->address : "",
				     row->pin ? ", " : "", row->pin ? row->pin : "");
	char *all = g_strdup_printf("%s%s%s%s%s", name, *state ? ", " : "", state,
				    view->forced ? ", " : "", view->forced ? _("forced") : "");

	gtk_accessible_update_property(GTK_ACCESSIBLE(view), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       all, -1);
	if (item)
		gtk_accessible_update_property(GTK_ACCESSIBLE(item),
					       GTK_ACCESSIBLE_PROPERTY_LABEL, all, -1);
	gtk_accessible_update_property(GTK_ACCESSIBLE(view->toggle),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	gtk_accessible_update_property(GTK_ACCESSIBLE(view->push),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	gtk_accessible_update_property(GTK_ACCESSIBLE(view->scale),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	gtk_accessible_update_property(GTK_ACCESSIBLE(view->lamp),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, all, -1);
	g_free(all);
	g_free(name);
}

/* ---- what changed ---- */

static void show_lamp(LadderSimRowView *view, bool on)
{
	if (on)
		gtk_widget_add_css_class(view->lamp, "on");
	else
		gtk_widget_remove_css_class(view->lamp, "on");
}

static void show_bit(LadderSimRowView *view, bool on)
{
	show_lamp(view, on);
	if (view->row->push)
		gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(view->push), on);
	else
		gtk_switch_set_active(GTK_SWITCH(view->toggle), on);
	speak(view);
}

static double number_of(enum iec_type type, union iec_value value)
{
	return iec_type_row(type)->class == CLASS_REAL ? value.r :
	       iec_is_wide(type) ? (double)(guint64)value.i : (double)value.i;
}

static void show_fraction(LadderSimRowView *view, double part, double whole)
{
	const double fraction = whole > 0 ? CLAMP(part / whole, 0, 1) : part > 0 ? 1 : 0;

	/* A step that cannot be seen is none. */
	if (fabs(fraction - gtk_progress_bar_get_fraction(GTK_PROGRESS_BAR(view->bar))) >
	    0.002 || fraction == 0 || fraction == 1)
		gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(view->bar), fraction);
}

static void show_preset(LadderSimRowView *view)
{
	const LadderSimRow *row = view->row;
	char *at = sim_value_text(row->at.type, view->last[0]);
	char *preset = sim_value_text(row->preset.type, view->last[1]);
	char *text = g_strdup_printf("%s / %s", at, preset);

	gtk_label_set_text(GTK_LABEL(view->value), text);
	show_fraction(view, number_of(row->at.type, view->last[0]),
		      number_of(row->preset.type, view->last[1]));
	show_lamp(view, view->last[2].i);
	g_free(text);
	g_free(preset);
	g_free(at);
}

/* A slider that is moved is ahead of what is shown: it is not pulled back. */
static void show_slider(LadderSimRowView *view, double number)
{
	if (view->waiting && number != view->sent)
		return;
	view->waiting = 0;
	gtk_range_set_value(GTK_RANGE(view->scale), number);
}

static void show_value(LadderSimRowView *view)
{
	const LadderSimRow *row = view->row;
	const double number = row->at.type == IEC_STRING ? 0 :
		number_of(row->at.type, view->last[0]);
	char *text = sim_value_text(row->at.type, view->last[0]);

	gtk_label_set_text(GTK_LABEL(view->value), text);
	g_free(text);
	if (row->kind == SIM_LEVEL)
		show_fraction(view, number - row->low, row->high - row->low);
	if (row->kind == SIM_SLIDER)
		show_slider(view, number);
}

static bool is_other_text(LadderSimRowView *view, const struct iec_string *text)
{
	if (view->text && view->text->len == text->length &&
	    memcmp(view->text->str, text->text, text->length) == 0)
		return false;
	if (!view->text)
		view->text = g_string_new(NULL);
	g_string_truncate(view->text, 0);
	g_string_append_len(view->text, text->text, text->length);
	return true;
}

static bool take_values(LadderSimRowView *view)
{
	const struct location at[] = { view->row->at, view->row->preset, view->row->done };
	bool other = false;

	for (gsize i = 0; i < G_N_ELEMENTS(at); i++) {
		union iec_value value;

		if (at[i].type == IEC_NONE)
			continue;
		value = sim_row_value(view->row, view->sim, at[i]);
		if (at[i].type == IEC_STRING ? is_other_text(view, value.s) :
					       value.i != view->last[i].i)
			other = true;
		view->last[i] = value;
	}
	return other;
}

static void show_force(LadderSimRowView *view, bool forced)
{
	view->forced = forced;
	gtk_widget_set_visible(view->badge, forced);
	speak(view);
}

void ladder_sim_row_view_update(LadderSimRowView *view)
{
	bool other, forced;

	if (!view->row || view->row->kind == SIM_HEADING || !ladder_sim_twin(view->sim))
		return;
	other = take_values(view) || !view->known ||
		(view->waiting && --view->waiting == 0);
	forced = sim_row_is_forced(view->row, view->sim);
	view->telling = true;
	if (forced != view->forced || !view->known)
		show_force(view, forced);
	view->known = true;
	if (other && sim_row_is_bit(view->row))
		show_bit(view, view->last[0].i);
	else if (other && view->row->kind == SIM_PRESET)
		show_preset(view);
	else if (other)
		show_value(view);
	view->telling = false;
}

/* ---- another line ---- */

static void show_range(LadderSimRowView *view)
{
	const LadderSimRow *row = view->row;
	const bool real = iec_type_row(row->at.type)->class == CLASS_REAL;
	const double step = real ? (row->high - row->low) / 100 : 1;

	if (row->kind != SIM_SLIDER || row->high <= row->low)
		return;
	view->telling = true;
	gtk_range_set_range(GTK_RANGE(view->scale), row->low, row->high);
	gtk_range_set_increments(GTK_RANGE(view->scale), step, (row->high - row->low) / 10);
	view->telling = false;
}

static char *tooltip_of(const LadderSimRow *row)
{
	GString *out = g_string_new(row->name);

	if (row->address)
		g_string_append_printf(out, "  %s", row->address);
	g_string_append_printf(out, "  %s", row->block ? row->block :
			       iec_type_row(row->at.type)->word);
	if (row->pin_told)
		g_string_append_printf(out, "\n%s", row->pin_told);
	if (row->comment)
		g_string_append_printf(out, "\n%s", row->comment);
	if (row->driven)
		g_string_append_printf(out, "\n%s", _("Driven by the plant"));
	if (row->key)
		g_string_append_printf(out, "\n%s %s", _("Key"), row->key);
	return g_string_free(out, FALSE);
}

static void show_heading(LadderSimRowView *view)
{
	const LadderSimRow *row = view->row;
	GtkWidget *item = gtk_widget_get_parent(GTK_WIDGET(view));
	const char *name = sim_group_name(row->group);
	char *spoken = g_strdup_printf("%s%s%s, %s", name, row->place ? " · " : "",
				       row->place ? row->place : "",
				       row->folded ? _("folded") : _("unfolded"));

	gtk_list_item_set_activatable(view->item, TRUE);
	gtk_label_set_text(GTK_LABEL(view->title), name);
	gtk_label_set_text(GTK_LABEL(view->where), row->place ? row->place : "");
	tip_set(view->where, row->place);
	gtk_image_set_from_icon_name(GTK_IMAGE(view->arrow), row->folded ?
				     "pan-end-symbolic" : "pan-down-symbolic");
	gtk_accessible_update_property(GTK_ACCESSIBLE(view), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       spoken, -1);
	if (item)
		gtk_accessible_update_property(GTK_ACCESSIBLE(item),
					       GTK_ACCESSIBLE_PROPERTY_LABEL, spoken, -1);
	g_free(spoken);
}

static void show_line(LadderSimRowView *view)
{
	const LadderSimRow *row = view->row;
	const bool bit = sim_row_is_bit(row), given = row->kind == SIM_SWITCH;
	char *tooltip = tooltip_of(row);

	gtk_label_set_text(GTK_LABEL(view->name), row->name);
	gtk_label_set_text(GTK_LABEL(view->address), row->address ? row->address : "");
	gtk_widget_set_visible(view->address, row->address != NULL);
	gtk_label_set_text(GTK_LABEL(view->pin), row->pin ? row->pin : "");
	gtk_widget_set_visible(view->pin, row->pin != NULL);
	gtk_label_set_text(GTK_LABEL(view->tag), row->driven ? _("plant") :
			   row->key ? row->key : "");
	gtk_widget_set_visible(view->tag, row->driven || row->key);
	gtk_widget_set_visible(view->lamp, bit || row->done.type != IEC_NONE);
	gtk_widget_set_visible(view->toggle, given && !row->push);
	gtk_widget_set_visible(view->push, given && row->push);
	gtk_widget_set_sensitive(view->toggle, !row->driven);
	gtk_widget_set_sensitive(view->push, !row->driven);
	gtk_widget_set_visible(view->value, !bit);
	gtk_widget_set_visible(view->bar, row->kind == SIM_PRESET || row->kind == SIM_LEVEL);
	gtk_widget_set_visible(view->scale, row->kind == SIM_SLIDER);
	gtk_widget_set_sensitive(view->scale, !row->driven);
	tip_set(view->name, tooltip);
	tip_set(view->address, tooltip);
	tip_set(view->pin, tooltip);
	g_free(tooltip);
	gtk_list_item_set_activatable(view->item, !bit);
	show_range(view);
}

void ladder_sim_row_view_bind(LadderSimRowView *view, LadderSimRow *row)
{
	const bool heading = row && row->kind == SIM_HEADING;

	sim_view_end_edit(view);
	g_set_object(&view->row, row);
	view->known = view->forced = false;
	view->waiting = 0;
	if (view->text)
		g_string_truncate(view->text, 0);
	gtk_widget_set_visible(view->heading, heading);
	gtk_widget_set_visible(view->line, row && !heading);
	gtk_widget_set_visible(view->bar, FALSE);
	gtk_widget_set_visible(view->scale, FALSE);
	if (!row)
		return;
	if (heading)
		show_heading(view);
	else
		show_line(view);
	ladder_sim_row_view_update(view);
}

char *ladder_sim_row_view_text(LadderSimRowView *view)
{
	if (!view->row || view->row->kind == SIM_HEADING)
		return NULL;
	if (!sim_row_is_bit(view->row))
		return g_strdup(gtk_label_get_text(GTK_LABEL(view->value)));
	if (view->row->kind == SIM_SWITCH)
		return g_strdup((view->row->push ?
			gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(view->push)) :
			gtk_switch_get_active(GTK_SWITCH(view->toggle))) ? "1" : "0");
	return g_strdup(gtk_widget_has_css_class(view->lamp, "on") ? "1" : "0");
}

/* ---- what is clicked ---- */

static void select_line(LadderSimRowView *view)
{
	GtkWidget *item = gtk_widget_get_parent(GTK_WIDGET(view));

	gtk_widget_activate_action(GTK_WIDGET(view), "list.select-item", "(ubb)",
				   gtk_list_item_get_position(view->item), FALSE, FALSE);
	if (item)
		gtk_widget_grab_focus(item);
}

/* Not claimed here or below: the item of the list would wait for its release for ever. */
static void pressed(GtkGestureClick *gesture, int times, double x, double y,
		    LadderSimRowView *view)
{
	(void)gesture;
	(void)times;
	(void)x;
	(void)y;
	select_line(view);
	g_set_object(&view->held, view->row);
	if (view->held)
		sim_row_press(view->held, view->sim);
}

static void let_go(LadderSimRowView *view)
{
	if (view->held)
		sim_row_unpress(view->held, view->sim);
	g_clear_object(&view->held);
}

static void released(GtkGestureClick *gesture, int times, double x, double y,
		     LadderSimRowView *view)
{
	(void)gesture;
	(void)times;
	(void)x;
	(void)y;
	let_go(view);
}

static void ended(GtkGesture *gesture, GdkEventSequence *sequence, LadderSimRowView *view)
{
	(void)gesture;
	(void)sequence;
	let_go(view);
}

static void can_be_pressed(LadderSimRowView *view, GtkWidget *widget)
{
	GtkGesture *click = gtk_gesture_click_new();

	g_signal_connect(click, "pressed", G_CALLBACK(pressed), view);
	g_signal_connect(click, "released", G_CALLBACK(released), view);
	g_signal_connect(click, "end", G_CALLBACK(ended), view);
	g_signal_connect(click, "cancel", G_CALLBACK(ended), view);
	gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(click));
}

void ladder_sim_row_view_fold(GtkWidget *from, const LadderSimRow *heading)
{
	char *section = sim_row_section(heading);

	gtk_widget_activate_action(from, "sim-panel.fold", "s", section);
	g_free(section);
}

/* Later: the item that was clicked goes with it. */
static gboolean fold_later(gpointer data)
{
	LadderSimRowView *view = data;

	if (view->row && view->row->kind == SIM_HEADING)
		ladder_sim_row_view_fold(GTK_WIDGET(view), view->row);
	g_object_unref(view);
	return G_SOURCE_REMOVE;
}

static void heading_released(GtkGestureClick *gesture, int times, double x, double y,
			     LadderSimRowView *view)
{
	(void)gesture;
	(void)times;
	(void)x;
	(void)y;
	g_idle_add(fold_later, g_object_ref(view));
}

static void slid(GtkRange *range, LadderSimRowView *view)
{
	const double number = gtk_range_get_value(range);
	union iec_value value;

	if (view->telling || !view->row)
		return;
	if (iec_type_row(view->row->at.type)->class == CLASS_REAL)
		value.r = number;
	else
		value.i = (gint64)round(CLAMP(number, -9e18, 9e18));
	view->sent = iec_type_row(view->row->at.type)->class == CLASS_REAL ? number :
		     round(number);
	view->waiting = LOOKS;
	sim_row_set(view->row, view->sim, view->row->at, value);
}

/* ---- the widget ---- */

static void dispose(GObject *object)
{
	LadderSimRowView *view = LADDER_SIM_ROW_VIEW(object);
	GtkWidget *child;

	let_go(view);
	while ((child = gtk_widget_get_first_child(GTK_WIDGET(view))) != NULL)
		gtk_widget_unparent(child);
	g_clear_object(&view->row);
	if (view->text)
		g_string_free(view->text, TRUE);
	view->text = NULL;
	G_OBJECT_CLASS(ladder_sim_row_view_parent_class)->dispose(object);
}

static void ladder_sim_row_view_class_init(LadderSimRowViewClass *class)
{
	G_OBJECT_CLASS(class)->dispose = dispose;
	gtk_widget_class_set_layout_manager_type(GTK_WIDGET_CLASS(class), GTK_TYPE_BOX_LAYOUT);
	gtk_widget_class_set_css_name(GTK_WIDGET_CLASS(class), "sim-row");
	gtk_widget_class_set_accessible_role(GTK_WIDGET_CLASS(class),
					     GTK_ACCESSIBLE_ROLE_GROUP);
}

static GtkWidget *add_label(GtkWidget *to, const char *class, bool expand)
{
	GtkWidget *label = gtk_label_new(NULL);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_widget_set_hexpand(label, expand);
	if (expand)
		gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	gtk_widget_add_css_class(label, class);
	gtk_box_append(GTK_BOX(to), label);
	return label;
}

/* The row acts for it, so that a press is told from a release. */
static void show_only(GtkWidget *widget)
{
	gtk_widget_set_can_target(widget, FALSE);
	gtk_widget_set_focusable(widget, FALSE);
	gtk_widget_set_valign(widget, GTK_ALIGN_CENTER);
}

static void add_heading(LadderSimRowView *view)
{
	GtkGesture *click = gtk_gesture_click_new();

	view->heading = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
	gtk_widget_set_vexpand(view->heading, TRUE);
	gtk_widget_add_css_class(view->heading, "heading-line");
	view->arrow = gtk_image_new();
	gtk_box_append(GTK_BOX(view->heading), view->arrow);
	view->title = add_label(view->heading, "sim-heading", false);
	view->where = add_label(view->heading, "sim-place", true);
	g_signal_connect(click, "released", G_CALLBACK(heading_released), view);
	gtk_widget_add_controller(view->heading, GTK_EVENT_CONTROLLER(click));
	gtk_widget_set_parent(view->heading, GTK_WIDGET(view));
}

static void add_controls(LadderSimRowView *view)
{
	GtkWidget *place = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);

	view->toggle = gtk_switch_new();
	view->push = gtk_toggle_button_new();
	gtk_widget_add_css_class(view->push, "sim-push");
	gtk_widget_add_css_class(view->push, "circular");
	show_only(view->toggle);
	show_only(view->push);
	gtk_box_append(GTK_BOX(place), view->toggle);
	gtk_box_append(GTK_BOX(place), view->push);
	gtk_box_append(GTK_BOX(view->line), place);
	can_be_pressed(view, place);
}

static void add_line(LadderSimRowView *view)
{
	view->line = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	view->lamp = g_object_new(GTK_TYPE_BOX, "css-name", "lamp", "accessible-role",
				  GTK_ACCESSIBLE_ROLE_IMG, NULL);
	gtk_widget_set_valign(view->lamp, GTK_ALIGN_CENTER);
	gtk_box_append(GTK_BOX(view->line), view->lamp);
	can_be_pressed(view, view->lamp);
	view->address = add_label(view->line, "sim-address", false);
	view->name = add_label(view->line, "sim-name", true);
	view->pin = add_label(view->line, "sim-pin", false);
	gtk_label_set_max_width_chars(GTK_LABEL(view->pin), 10);
	gtk_label_set_ellipsize(GTK_LABEL(view->pin), PANGO_ELLIPSIZE_END);
	view->tag = add_label(view->line, "sim-tag", false);
	gtk_widget_set_valign(view->tag, GTK_ALIGN_CENTER);
	view->badge = add_label(view->line, "sim-forced", false);
	gtk_label_set_text(GTK_LABEL(view->badge), "F");
	tip_set(view->badge, _("Forced"));
	gtk_widget_set_valign(view->badge, GTK_ALIGN_CENTER);
	view->value = add_label(view->line, "sim-value", false);
	gtk_label_set_xalign(GTK_LABEL(view->value), 1);
	gtk_label_set_ellipsize(GTK_LABEL(view->value), PANGO_ELLIPSIZE_END);
	sim_view_can_edit(view);
	add_controls(view);
	gtk_widget_set_parent(view->line, GTK_WIDGET(view));
}

static void ladder_sim_row_view_init(LadderSimRowView *view)
{
	gtk_orientable_set_orientation(GTK_ORIENTABLE(gtk_widget_get_layout_manager(
		GTK_WIDGET(view))), GTK_ORIENTATION_VERTICAL);
	add_heading(view);
	add_line(view);
	view->bar = gtk_progress_bar_new();
	gtk_widget_set_parent(view->bar, GTK_WIDGET(view));
	view->scale = gtk_scale_new_with_range(GTK_ORIENTATION_HORIZONTAL, 0, 1, 1);
	gtk_scale_set_draw_value(GTK_SCALE(view->scale), FALSE);
	g_signal_connect(view->scale, "value-changed", G_CALLBACK(slid), view);
	gtk_widget_set_parent(view->scale, GTK_WIDGET(view));
	ladder_sim_row_view_bind(view, NULL);
}

GtkWidget *ladder_sim_row_view_new(LadderSim *sim, GtkListItem *item)
{
	LadderSimRowView *view = g_object_new(LADDER_TYPE_SIM_ROW_VIEW, NULL);

	view->sim = sim;
	view->item = item;
	return GTK_WIDGET(view);
}
