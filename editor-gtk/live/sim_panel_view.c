/* SPDX-License-Identifier: MIT
 *
 * sim_panel_view - the widget of a line; see sim_panel_view.h.
 */
#include "editor-gtk/live/sim_panel_view.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/left.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/live/sim_panel_line.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/kit/spelling.h"

#include "engine/trial/value.h"

#include <math.h>
#include <string.h>

#define PART_INDENT 20 /* px                                                  */
#define LOOKS 20 /* updates during which a slider waits for the value it set   */

struct _LadderSimRowView {
	GtkWidget parent;
	LadderSim *sim;          /* borrowed                                    */
	GtkListItem *item;       /* borrowed                                    */
	LadderSimRow *row;       /* NULL: none                                  */
	LadderSimRow *held;      /* pressed with the pointer; NULL: none        */
	bool by_button;          /* not by a finger                             */
	struct live_seen value_seen, preset_seen, done_seen;
	bool telling;            /* widgets are being set: ignore their signals */
	double sent;             /* the value that the slider set last          */
	int waiting;             /* updates left until the slider gives that up */
	GtkWidget *heading, *arrow, *title, *where;
	GtkWidget *line, *unfold, *lamp, *address, *name, *pin, *tag, *badge, *quality, *value, *toggle, *push;
	GtkWidget *entry;        /* NULL: none yet                              */
	enum sim_edit editing;
	GtkWidget *bar, *scale;
	GtkWidget *why;          /* why what a person did was refused; NULL: none yet */
};

G_DEFINE_FINAL_TYPE(LadderSimRowView, ladder_sim_row_view, GTK_TYPE_WIDGET)

LadderSimRow *ladder_sim_row_view_row(LadderSimRowView *view)
{
	return view->row;
}

static GtkBox *part_of(LadderSimRowView *view, enum line_part part)
{
	return ladder_sim_line_part(LADDER_SIM_LINE(view->line), part);
}

/* ---- its accessible name ---- */

static bool is_forced(const LadderSimRowView *view)
{
	return view->value_seen.forced || view->preset_seen.forced;
}

static const char *kind_name(const LadderSimRow *row)
{
	static const char *const name[SIM_GROUPS] = {
		[SIM_INPUTS] = N_("Input"), [SIM_OUTPUTS] = N_("Output"),
		[SIM_MEMORY] = N_("Bit"), [SIM_TIMERS] = N_("Timer"),
		[SIM_COUNTERS] = N_("Counter"), [SIM_BLOCKS] = N_("Block"),
		[SIM_CHARTS] = N_("Chart"), [SIM_ANALOGUE] = N_("Analogue"),
		[SIM_VALUES] = N_("Value"), [SIM_PLANT] = N_("Plant"),
	};

	return _(name[row->group]);
}

static void set_name(GtkWidget *widget, const char *name)
{
	spoken_name(widget, name);
}

/* The list item is what a screen reader stops at. */
static void name_line(LadderSimRowView *view, const char *name)
{
	GtkWidget *item = gtk_widget_get_parent(GTK_WIDGET(view));

	set_name(GTK_WIDGET(view), name);
	if (item)
		set_name(item, name);
}

static void speak(LadderSimRowView *view)
{
	const LadderSimRow *row = view->row;
	const bool step = row->kind == SIM_STEP;
	const char *state = !sim_row_is_bit(row) && !step ? "" :
		(step ? view->done_seen.value.i : view->value_seen.value.i) ? _("on") : _("off");
	char *own = spelling_shown(row->name), *address = spelling_shown(row->address ? row->address : "");
	char *name = g_strdup_printf("%s %s%s%s%s%s", kind_name(row), own, *address ? ", " : "", address,
				     row->pin ? ", " : "", row->pin ? row->pin : "");
	const char *folds = !row->parts ? "" : row->folded ? _("folded") : _("unfolded");
	const char *quality = live_quality_word(view->value_seen.quality);
	char *all = g_strdup_printf("%s%s%s%s%s%s%s%s%s", name, *state ? ", " : "", state,
				    *folds ? ", " : "", folds,
				    is_forced(view) ? ", " : "", is_forced(view) ? _("forced") : "",
				    *quality ? ", " : "", quality);

	name_line(view, all);
	set_name(view->toggle, name);
	set_name(view->push, name);
	set_name(view->scale, name);
	set_name(view->lamp, all);
	g_free(all);
	g_free(name);
	g_free(address);
	g_free(own);
}

/* ---- what changed ---- */

static void show_lamp(LadderSimRowView *view, bool on)
{
	style_set(view->lamp, "on", on);
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

static void show_fraction(LadderSimRowView *view, double part, double whole)
{
	const double fraction = whole > 0 ? CLAMP(part / whole, 0, 1) : part > 0 ? 1 : 0;

	/* Smaller steps are not visible. */
	if (fabs(fraction - gtk_progress_bar_get_fraction(GTK_PROGRESS_BAR(view->bar))) >
	    0.002 || fraction == 0 || fraction == 1)
		gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(view->bar), fraction);
}

static void show_preset(LadderSimRowView *view)
{
	const LadderSimRow *row = view->row;
	const union iec_value now = view->value_seen.value, preset = view->preset_seen.value;
	char text[80];

	live_count_print(row->at.type, now, preset, text, sizeof(text));
	gtk_label_set_text(GTK_LABEL(view->value), text);
	show_fraction(view, live_value_number(row->at.type, now),
		      live_value_number(row->preset.type, preset));
	show_lamp(view, view->done_seen.value.i);
}

/* The simulation shows a value that the slider set some updates later: until then the slider
 * is not moved back. */
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
	const double number = live_value_number(row->at.type, view->value_seen.value);
	char text[IEC_VALUE_TEXT + 1];

	text[0] = '\0';
	if (row->at.type != IEC_NONE)
		live_named_print(row->named, row->at.type, view->value_seen.value, text,
				 sizeof(text));
	gtk_label_set_text(GTK_LABEL(view->value), text);
	show_lamp(view, view->done_seen.value.i);
	if (row->kind == SIM_STEP)
		speak(view);
	if (row->kind == SIM_LEVEL)
		show_fraction(view, number - row->low, row->high - row->low);
	if (row->kind == SIM_SLIDER)
		show_slider(view, number);
}

static bool look(LadderSimRowView *view, struct live_seen *seen, struct location at)
{
	return live_value_look_outside(seen, view->sim, view->row->plant, at);
}

static void show_quality(LadderSimRowView *view, enum sim_quality quality)
{
	gtk_label_set_text(GTK_LABEL(view->quality), live_quality_text(quality));
	gtk_widget_set_visible(view->quality, quality != SIM_GOOD);
}

/* The steps of a chart that are active. */
static void show_told(LadderSimRowView *view)
{
	char *told = sim_row_told(view->row, view->sim);

	if (told && strcmp(told, gtk_label_get_text(GTK_LABEL(view->value))) != 0)
		gtk_label_set_text(GTK_LABEL(view->value), told);
	g_free(told);
}

static void let_go(LadderSimRowView *view)
{
	if (view->held)
		sim_row_unpress(view->held, view->sim);
	g_clear_object(&view->held);
}

/* Is the button of the mouse up, whatever the events said? One may be lost when a machine is busy. */
static bool is_button_up(LadderSimRowView *view)
{
	GtkNative *native = gtk_widget_get_native(GTK_WIDGET(view));
	GdkSurface *surface = native ? gtk_native_get_surface(native) : NULL;
	GdkSeat *seat = gdk_display_get_default_seat(gtk_widget_get_display(GTK_WIDGET(view)));
	GdkDevice *pointer = seat ? gdk_seat_get_pointer(seat) : NULL;
	GdkModifierType state = 0;

	return surface && pointer && gdk_surface_get_device_position(surface, pointer, NULL, NULL, &state) &&
	       !(state & GDK_BUTTON1_MASK);
}

void ladder_sim_row_view_update(LadderSimRowView *view)
{
	const bool known = view->value_seen.known, forced = is_forced(view);
	const enum sim_quality quality = view->value_seen.quality;
	bool changed;

	if (!view->row || view->row->kind == SIM_HEADING || !ladder_sim_twin(view->sim))
		return;
	if (view->held && view->by_button && is_button_up(view))
		let_go(view);
	changed = look(view, &view->value_seen, view->row->at);
	changed = look(view, &view->preset_seen, view->row->preset) || changed;
	changed = look(view, &view->done_seen, view->row->done) || changed;
	changed = (view->waiting && --view->waiting == 0) || changed;
	view->telling = true;
	if (!known || forced != is_forced(view) || quality != view->value_seen.quality) {
		gtk_widget_set_visible(view->badge, is_forced(view));
		show_quality(view, view->value_seen.quality);
		speak(view);
	}
	if (changed && sim_row_is_bit(view->row))
		show_bit(view, view->value_seen.value.i);
	else if (changed && view->row->kind == SIM_PRESET)
		show_preset(view);
	else if (changed)
		show_value(view);
	if (view->row->kind == SIM_WHOLE)
		show_told(view);
	view->telling = false;
}

/* ---- refusals ---- */

static void forget_refusal(LadderSimRowView *view)
{
	if (view->why)
		gtk_widget_set_visible(view->why, FALSE);
}

void ladder_sim_row_view_refuse(LadderSimRowView *view, struct location at, const char *why)
{
	const LadderSimRow *row = view->row;

	forget_refusal(view);
	if (!row || row->kind == SIM_HEADING ||
	    !(live_value_is_same(row->at, at) || live_value_is_same(row->given, at)))
		return;
	if (!view->why) {
		view->why = gtk_label_new(NULL);
		gtk_label_set_xalign(GTK_LABEL(view->why), 0);
		gtk_label_set_wrap(GTK_LABEL(view->why), TRUE);
		gtk_widget_add_css_class(view->why, "error");
		gtk_widget_add_css_class(view->why, "sim-why");
		gtk_widget_set_parent(view->why, GTK_WIDGET(view));
	}
	gtk_label_set_text(GTK_LABEL(view->why), why);
	gtk_widget_set_visible(view->why, TRUE);
}

/* ---- the entry for a value ---- */

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

static void end_edit(LadderSimRowView *view)
{
	if (!view->entry || !gtk_widget_get_visible(view->entry))
		return;
	gtk_widget_set_visible(view->entry, FALSE);
	gtk_widget_set_visible(view->value, view->row && !sim_row_is_bit(view->row));
}

/* @why: NULL: it is good. */
static void mark(LadderSimRowView *view, const char *why)
{
	style_wrong(view->entry, why != NULL);
	tip_set(view->entry, why);
}

/* Of what is edited: a preset is of no enumeration. */
static struct live_named names_here(const LadderSimRowView *view)
{
	return live_value_is_same(place_of(view), view->row->at) ? view->row->named :
								   (struct live_named){ NULL, false, 0 };
}

static void mark_bad(LadderSimRowView *view, bool bad)
{
	char *why = bad ? live_named_wrong(names_here(view)) : NULL;

	if (bad && !why)
		why = g_strdup_printf(_("Not a value of type %s"),
				      iec_type_row(place_of(view).type)->word);
	mark(view, why);
	g_free(why);
}

/* True: the board does not allow it, and the entry says why. */
static bool is_refused(LadderSimRowView *view)
{
	const bool forced = live_value_is_forced(view->sim, view->row->plant, place_of(view));
	const char *why = ladder_sim_why_not(view->sim, forced ? SIM_WISH_FORCE : SIM_WISH_SET);

	if (why) {
		mark(view, why);
		ladder_sim_row_view_refuse(view, place_of(view), why);
	}
	return why != NULL;
}

/* A STRING needs no quotes here. */
static bool parse(enum iec_type type, const char *text, struct iec_text *room,
		  union iec_value *out)
{
	char *own = g_strstrip(g_strdup(text));
	char *quoted = type == IEC_STRING && *own != '\'' ? g_strdup_printf("'%s'", own) :
		       g_strdup(own);
	enum diag_id why;
	const bool good = live_value_parse(FORMAT_AUTO, type, quoted, room, out, &why);

	g_free(quoted);
	g_free(own);
	return good;
}

static void entered(GtkEntry *entry, LadderSimRowView *view)
{
	const struct location at = place_of(view);
	struct iec_text room;
	union iec_value value;

	if (!live_named_parse(names_here(view), gtk_editable_get_text(GTK_EDITABLE(entry)), &value) &&
	    !parse(at.type, gtk_editable_get_text(GTK_EDITABLE(entry)), &room, &value)) {
		mark_bad(view, true);
		return;
	}
	if (is_refused(view))
		return;
	if (view->row->kind == SIM_PRESET && view->editing == SIM_EDIT_VALUE)
		sim_row_set_elapsed(view->row, view->sim, value);
	else
		live_value_set(view->sim, view->row->plant, at, value);
	give_back_focus(view);
	end_edit(view);
}

static void text_changed(LadderSimRowView *view)
{
	if (gtk_widget_has_css_class(view->entry, "error"))
		mark_bad(view, false);
	forget_refusal(view);
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
	end_edit(view);
	return GDK_EVENT_STOP;
}

static gpointer note_entry(GtkWidget *entry, gpointer view)
{
	(void)entry;
	return g_object_ref(view);
}

/* Another value of the row may be edited by now. */
static void entry_left(gpointer data)
{
	LadderSimRowView *view = data;

	if (gtk_widget_get_root(GTK_WIDGET(view)) &&
	    !(gtk_widget_get_state_flags(view->entry) & GTK_STATE_FLAG_FOCUS_WITHIN))
		end_edit(view);
}

static void add_entry(LadderSimRowView *view)
{
	GtkEventController *keys = gtk_event_controller_key_new();

	view->entry = gtk_entry_new();
	gtk_widget_add_css_class(view->entry, "field");
	gtk_editable_set_width_chars(GTK_EDITABLE(view->entry), 10);
	gtk_editable_set_alignment(GTK_EDITABLE(view->entry), 1);
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), view);
	g_signal_connect(view->entry, "activate", G_CALLBACK(entered), view);
	g_signal_connect_swapped(view->entry, "changed", G_CALLBACK(text_changed), view);
	gtk_widget_add_controller(view->entry, keys);
	left_connect(view->entry, note_entry, entry_left, g_object_unref, view);
	gtk_box_insert_child_after(part_of(view, LINE_END), view->entry, view->value);
}

static char *field_name(const LadderSimRowView *view)
{
	return view->row->kind != SIM_PRESET ? g_strdup(view->row->name) :
	       g_strdup_printf(view->editing == SIM_EDIT_PRESET ? _("%s, preset") :
			       view->row->at.type != IEC_TIME ? _("%s, count") :
			       _("%s, elapsed"), view->row->name);
}

void ladder_sim_row_view_edit(LadderSimRowView *view, enum sim_edit what)
{
	struct location at;
	char *text, *name;

	if (!view->row || view->row->kind == SIM_HEADING || view->row->kind >= SIM_STEP ||
	    sim_row_is_bit(view->row))
		return;
	view->editing = what;
	at = place_of(view);
	if (at.type == IEC_NONE || at.constant)
		return;
	if (!view->entry)
		add_entry(view);
	text = live_named_literal(names_here(view), at.type,
				  live_value_get(view->sim, view->row->plant, at));
	name = field_name(view);
	gtk_editable_set_text(GTK_EDITABLE(view->entry), text);
	set_name(view->entry, name);
	mark_bad(view, false);
	gtk_widget_set_visible(view->value, FALSE);
	gtk_widget_set_visible(view->entry, TRUE);
	gtk_widget_grab_focus(view->entry);
	g_free(name);
	g_free(text);
}

/* The click still moves the focus to the list item: the entry is opened later. */
static gboolean edit_later(gpointer data)
{
	LadderSimRowView *view = data;
	const bool preset = view->row && view->row->given.type != IEC_NONE;

	ladder_sim_row_view_edit(view, preset ? SIM_EDIT_PRESET : SIM_EDIT_VALUE);
	g_object_unref(view);
	return G_SOURCE_REMOVE;
}

static void value_released(LadderSimRowView *view)
{
	g_idle_add(edit_later, g_object_ref(view));
}

static void can_edit(LadderSimRowView *view)
{
	GtkGesture *click = gtk_gesture_click_new();

	gtk_widget_set_cursor_from_name(view->value, "text");
	g_signal_connect_swapped(click, "released", G_CALLBACK(value_released), view);
	gtk_widget_add_controller(view->value, GTK_EVENT_CONTROLLER(click));
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
	char *name = spelling_shown(row->name), *address = spelling_shown(row->address ? row->address : "");
	GString *out = g_string_new(name);

	if (row->address)
		g_string_append_printf(out, "  %s", address);
	g_free(address);
	g_free(name);
	if (row->block || row->at.type != IEC_NONE)
		g_string_append_printf(out, "  %s", row->block ? row->block :
				       live_named_type(row->named, row->at.type));
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
	name_line(view, spoken);
	g_free(spoken);
}

static void set_spelled(GtkWidget *label, const char *text)
{
	char *shown = spelling_shown(text);

	gtk_label_set_text(GTK_LABEL(label), shown);
	g_free(shown);
}

static void show_line(LadderSimRowView *view)
{
	const LadderSimRow *row = view->row;
	const bool bit = sim_row_is_bit(row), given = row->kind == SIM_SWITCH;
	char *tooltip = tooltip_of(row);

	set_spelled(view->name, sim_row_label(row));
	gtk_widget_set_margin_start(view->line, row->owner ? PART_INDENT : 0);
	gtk_widget_set_visible(view->unfold, row->parts != NULL);
	gtk_image_set_from_icon_name(GTK_IMAGE(view->unfold), row->folded ?
				     "pan-end-symbolic" : "pan-down-symbolic");
	set_spelled(view->address, row->address ? row->address : "");
	gtk_widget_set_visible(view->address, row->address != NULL);
	gtk_label_set_text(GTK_LABEL(view->pin), row->pin ? row->pin : "");
	gtk_widget_set_visible(view->pin, row->pin && !row->driven); /* the plant drives it; the tip has both */
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

	ladder_sim_line_begin(LADDER_SIM_LINE(view->line));
	end_edit(view);
	forget_refusal(view);
	g_set_object(&view->row, row);
	memset(&view->value_seen, 0, sizeof(view->value_seen));
	memset(&view->preset_seen, 0, sizeof(view->preset_seen));
	memset(&view->done_seen, 0, sizeof(view->done_seen));
	view->waiting = 0;
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

/* ---- clicks ---- */

static void select_line(LadderSimRowView *view)
{
	GtkWidget *item = gtk_widget_get_parent(GTK_WIDGET(view));

	gtk_widget_activate_action(GTK_WIDGET(view), "list.select-item", "(ubb)",
				   gtk_list_item_get_position(view->item), FALSE, FALSE);
	if (item)
		gtk_widget_grab_focus(item);
}

/* The gesture is not claimed: the list item would wait for its release forever. */
static void press(GtkGestureClick *click, int count, double x, double y, LadderSimRowView *view)
{
	(void)count, (void)x, (void)y;
	select_line(view);
	view->by_button = !gtk_gesture_single_get_current_sequence(GTK_GESTURE_SINGLE(click));
	g_set_object(&view->held, view->row);
	if (view->held)
		sim_row_press(view->held, view->sim);
}

static void can_be_pressed(LadderSimRowView *view, GtkWidget *widget)
{
	GtkGesture *click = gtk_gesture_click_new();

	g_signal_connect(click, "pressed", G_CALLBACK(press), view);
	g_signal_connect_swapped(click, "released", G_CALLBACK(let_go), view);
	g_signal_connect_swapped(click, "end", G_CALLBACK(let_go), view);
	g_signal_connect_swapped(click, "cancel", G_CALLBACK(let_go), view);
	gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(click));
}

void ladder_sim_row_view_fold(GtkWidget *from, const LadderSimRow *heading)
{
	char *section = sim_row_section(heading);

	gtk_widget_activate_action(from, "sim-panel.fold", "s", section);
	g_free(section);
}

/* Folding removes the list item that the click still uses: it is done later. */
static gboolean fold_later(gpointer data)
{
	LadderSimRowView *view = data;

	if (view->row && (view->row->kind == SIM_HEADING || view->row->parts))
		ladder_sim_row_view_fold(GTK_WIDGET(view), view->row);
	g_object_unref(view);
	return G_SOURCE_REMOVE;
}

static void heading_released(LadderSimRowView *view)
{
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
	live_value_set(view->sim, view->row->plant, view->row->at, value);
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

static GtkWidget *add_label(GtkBox *to, const char *class, PangoEllipsizeMode cut)
{
	GtkWidget *label = gtk_label_new(NULL);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_widget_set_hexpand(label, cut != PANGO_ELLIPSIZE_NONE);
	gtk_label_set_ellipsize(GTK_LABEL(label), cut);
	gtk_widget_add_css_class(label, class);
	gtk_box_append(to, label);
	return label;
}

/* The gesture of the row acts, because it needs both press and release. */
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
	view->title = add_label(GTK_BOX(view->heading), "sim-heading", PANGO_ELLIPSIZE_NONE);
	view->where = add_label(GTK_BOX(view->heading), "sim-place", PANGO_ELLIPSIZE_END);
	g_signal_connect_swapped(click, "released", G_CALLBACK(heading_released), view);
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
	gtk_box_append(part_of(view, LINE_END), place);
	can_be_pressed(view, place);
}

static void add_lead(LadderSimRowView *view)
{
	GtkGesture *click = gtk_gesture_click_new();
	GtkBox *lead = part_of(view, LINE_LEAD);

	view->unfold = gtk_image_new();
	gtk_box_append(lead, view->unfold);
	g_signal_connect_swapped(click, "released", G_CALLBACK(heading_released), view);
	gtk_widget_add_controller(view->unfold, GTK_EVENT_CONTROLLER(click));
	view->lamp = g_object_new(GTK_TYPE_BOX, "css-name", "lamp", "accessible-role",
				  GTK_ACCESSIBLE_ROLE_IMG, NULL);
	gtk_widget_set_valign(view->lamp, GTK_ALIGN_CENTER);
	gtk_box_append(lead, view->lamp);
	can_be_pressed(view, view->lamp);
}

static GtkWidget *add_mark(LadderSimRowView *view, enum line_part part, const char *class)
{
	GtkWidget *mark = add_label(part_of(view, part), class, PANGO_ELLIPSIZE_NONE);

	gtk_widget_set_valign(mark, GTK_ALIGN_CENTER);
	return mark;
}

static void add_end(LadderSimRowView *view)
{
	view->badge = add_mark(view, LINE_END, "sim-forced");
	gtk_label_set_text(GTK_LABEL(view->badge), "F");
	tip_set(view->badge, _("Forced"));
	view->quality = add_mark(view, LINE_END, "sim-quality");
	gtk_widget_set_visible(view->quality, FALSE);
	view->value = add_label(part_of(view, LINE_END), "sim-value", PANGO_ELLIPSIZE_END);
	gtk_label_set_xalign(GTK_LABEL(view->value), 1);
	can_edit(view);
	add_controls(view);
}

static void add_line(LadderSimRowView *view)
{
	view->line = ladder_sim_line_new();
	add_lead(view);
	view->address = add_label(part_of(view, LINE_ADDRESS), "sim-address", PANGO_ELLIPSIZE_NONE);
	/* Names differ at their ends: GateOpenButton, GateCloseButton. */
	view->name = add_label(part_of(view, LINE_NAME), "sim-name", PANGO_ELLIPSIZE_MIDDLE);
	view->pin = add_label(part_of(view, LINE_ABOUT), "sim-pin", PANGO_ELLIPSIZE_END);
	gtk_label_set_max_width_chars(GTK_LABEL(view->pin), 10);
	view->tag = add_mark(view, LINE_ABOUT, "sim-tag");
	add_end(view);
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
