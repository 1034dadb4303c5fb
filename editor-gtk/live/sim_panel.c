/* SPDX-License-Identifier: MIT
 *
 * sim_panel - the list of the panel: which lines it has and when they are updated; keys, menu,
 * and what a person chooses for a line. sim_panel_rows.c makes the lines of a program,
 * sim_panel_view.c is the widget of one.
 */
#include "editor-gtk/live/sim_panel.h"

#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/live/sim_panel_view.h"
#include "editor-gtk/sim/live_value.h"

#include <string.h>

/* A line that is on while its own key is down. */
struct held {
	guint code;              /* of the key on the keyboard                 */
	LadderSimRow *row;
};

struct _LadderSimPanel {
	GtkWidget parent;
	LadderSim *sim;
	GPtrArray *rows;          /* all, of LadderSimRow                       */
	GListStore *store;        /* the rows that are listed, and headings     */
	GtkSingleSelection *selection;
	GPtrArray *views;         /* widgets that show a row; borrowed          */
	guint behind;             /* views still to be updated by the timer     */
	guint behind_timer;
	bool again;               /* values changed since that round began      */
	char *wanted;             /* text of the filter; never NULL             */
	GHashTable *folded;       /* folded sections, sim_row_section()         */
	GHashTable *unfolded;     /* lines that show their parts, likewise       */
	bool on;
	LadderSimRow *held;       /* by the space bar; NULL: none               */
	GPtrArray *bound;         /* of struct held                             */
	GtkEventController *root_keys; /* of `root`; borrowed                   */
	GtkRoot *root;            /* the window; NULL: none                     */
	gulong root_active;
	guint last_code;          /* of the key that is down; 0: none           */
	GtkWidget *asking;        /* for a key or a range; NULL: nothing        */
	GtkWidget *stack, *found, *search, *list;
};

G_DEFINE_FINAL_TYPE(LadderSimPanel, ladder_sim_panel, GTK_TYPE_WIDGET)

#define AT_A_TIME 12 /* hidden views that one timer call updates              */
#define BEHIND_MS 30

/* ---- the lines ---- */

/* Does the line show its parts? */
static bool is_unfolded(LadderSimPanel *panel, const LadderSimRow *row)
{
	char *section = sim_row_section(row);
	const bool is = g_hash_table_contains(panel->unfolded, section);

	g_free(section);
	return is;
}

static bool is_folded(LadderSimPanel *panel, const LadderSimRow *row)
{
	char *section = sim_row_section(row);
	const bool folded = g_hash_table_contains(panel->folded, section);

	g_free(section);
	return folded;
}

static bool is_section(const LadderSimRow *row, const LadderSimRow *other)
{
	return row->group == other->group && g_strcmp0(row->place, other->place) == 0;
}

/* Adds a line with its parts if it is unfolded, or with those that a search finds. */
static void add_line(LadderSimPanel *panel, GPtrArray *out, LadderSimRow *row)
{
	const bool wants = panel->wanted[0] != '\0';
	const bool open = row->parts && !wants && is_unfolded(panel, row);
	const guint before = out->len;

	row->folded = !open;
	g_ptr_array_add(out, g_object_ref(row));
	for (guint i = 0; row->parts && (open || wants) && i < row->parts->len; i++) {
		LadderSimRow *part = row->parts->pdata[i];

		if (open || sim_row_matches(part, panel->wanted))
			g_ptr_array_add(out, g_object_ref(part));
	}
	if (out->len > before + 1)
		row->folded = false;
	else if (wants && !sim_row_matches(row, panel->wanted))
		g_ptr_array_set_size(out, (gint)before);
}

/* Adds a heading and its lines: rows from @from to before @to, of one group and place. */
static void add_section(LadderSimPanel *panel, GPtrArray *out, guint from, guint to)
{
	const LadderSimRow *first = g_ptr_array_index(panel->rows, from);
	const bool wants = panel->wanted[0] != '\0';
	const bool folded = !wants && is_folded(panel, first);
	const guint before = out->len;

	g_ptr_array_add(out, sim_row_heading(first, folded));
	for (guint i = from; i < to && !folded; i++) {
		LadderSimRow *row = g_ptr_array_index(panel->rows, i);

		if (!row->owner)
			add_line(panel, out, row);
	}
	if (out->len == before + 1 && !folded)
		g_ptr_array_set_size(out, (gint)before);
}

static gint find_line(LadderSimPanel *panel, const LadderSimRow *like)
{
	GListModel *list = G_LIST_MODEL(panel->store);

	for (guint i = 0; like && i < g_list_model_get_n_items(list); i++) {
		LadderSimRow *row = g_list_model_get_item(list, i);

		g_object_unref(row);
		if (row->kind == SIM_HEADING ? like->kind == SIM_HEADING &&
					       is_section(row, like) :
		    like->kind != SIM_HEADING && sim_row_is(row, like))
			return (gint)i;
	}
	return -1;
}

/* The same line stays selected. */
static void show_lines(LadderSimPanel *panel)
{
	GPtrArray *out = g_ptr_array_new_with_free_func(g_object_unref);
	LadderSimRow *selected = gtk_single_selection_get_selected_item(panel->selection);
	guint from = 0;
	gint at;

	if (selected)
		g_object_ref(selected);
	for (guint i = 1; i <= panel->rows->len; i++) {
		if (i < panel->rows->len && is_section(panel->rows->pdata[from],
						       panel->rows->pdata[i]))
			continue;
		add_section(panel, out, from, i);
		from = i;
	}
	g_list_store_splice(panel->store, 0, g_list_model_get_n_items(
			    G_LIST_MODEL(panel->store)), out->pdata, out->len);
	list_mend_focus(GTK_WIDGET(panel));
	at = find_line(panel, selected);
	gtk_single_selection_set_selected(panel->selection, at < 0 ?
					  GTK_INVALID_LIST_POSITION : (guint)at);
	gtk_stack_set_visible_child_name(GTK_STACK(panel->found), out->len ? "list" :
					 panel->rows->len ? "none" : "empty");
	g_ptr_array_unref(out);
	g_clear_object(&selected);
}

static bool are_same(GPtrArray *left, GPtrArray *right)
{
	if (left->len != right->len)
		return false;
	for (guint i = 0; i < left->len; i++)
		if (!sim_row_is(g_ptr_array_index(left, i), g_ptr_array_index(right, i)))
			return false;
	return true;
}

/* ---- the selected line ---- */

static LadderSimRow *selected_row(LadderSimPanel *panel)
{
	LadderSimRow *row = gtk_single_selection_get_selected_item(panel->selection);

	return row && row->kind != SIM_HEADING ? row : NULL;
}

static LadderSimRowView *view_of(LadderSimPanel *panel, const LadderSimRow *row)
{
	for (guint i = 0; row && i < panel->views->len; i++)
		if (ladder_sim_row_view_row(g_ptr_array_index(panel->views, i)) == row)
			return g_ptr_array_index(panel->views, i);
	return NULL;
}

/* ---- keys assigned to inputs: they act wherever the focus is, except in a text ---- */

static void held_free(gpointer data)
{
	struct held *held = data;

	g_object_unref(held->row);
	g_free(held);
}

static bool can_bind(guint key)
{
	const gunichar letter = gdk_keyval_to_unicode(key);

	return (key >= GDK_KEY_F1 && key <= GDK_KEY_F12) ||
	       (key >= GDK_KEY_KP_0 && key <= GDK_KEY_KP_9) ||
	       (letter && g_unichar_isgraph(letter));
}

static void give(LadderSimPanel *panel, const LadderSimRow *row, gint64 to)
{
	live_value_set(panel->sim, row->plant, row->at, (union iec_value){ .i = to });
}

static void let_go_bound(LadderSimPanel *panel)
{
	while (panel->bound && panel->bound->len) {
		struct held *held = g_ptr_array_index(panel->bound, panel->bound->len - 1);

		give(panel, held->row, 0);
		g_ptr_array_set_size(panel->bound, (gint)panel->bound->len - 1);
	}
}

static void let_go_held(LadderSimPanel *panel)
{
	if (panel->held)
		sim_row_unpress(panel->held, panel->sim);
	g_clear_object(&panel->held);
}

static void let_go(LadderSimPanel *panel)
{
	let_go_held(panel);
	let_go_bound(panel);
}

static bool is_down(const LadderSimPanel *panel, guint code)
{
	for (guint i = 0; i < panel->bound->len; i++)
		if (((struct held *)panel->bound->pdata[i])->code == code)
			return true;
	return false;
}

static void press_bound(LadderSimPanel *panel, LadderSimRow *row, guint code)
{
	struct held *held;

	if (row->key_toggles) {
		give(panel, row, !live_value_get(panel->sim, row->plant, row->at).i);
		return;
	}
	held = g_new(struct held, 1);
	held->code = code;
	held->row = g_object_ref(row);
	g_ptr_array_add(panel->bound, held);
	give(panel, row, 1);
}

/* True: the key is assigned to a line. A repeated key press does not act again. */
static bool act_on_key(LadderSimPanel *panel, guint key, guint code, bool repeats)
{
	const char *name = gdk_keyval_name(gdk_keyval_to_lower(key));
	bool any = false;

	for (guint i = 0; i < panel->rows->len; i++) {
		LadderSimRow *row = g_ptr_array_index(panel->rows, i);

		if (!row->key || g_strcmp0(row->key, name) != 0 || !sim_row_is_bit(row))
			continue;
		any = true;
		if (!repeats)
			press_bound(panel, row, code);
	}
	return any;
}

static bool is_writing(LadderSimPanel *panel)
{
	GtkWidget *focus = gtk_root_get_focus(panel->root);

	return focus && (GTK_IS_EDITABLE(focus) || GTK_IS_TEXT_VIEW(focus));
}

static gboolean root_key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType state, LadderSimPanel *panel)
{
	const bool repeats = panel->last_code == code || is_down(panel, code);

	(void)keys;
	if (!panel->on || panel->asking || is_writing(panel) ||
	    state & (GDK_CONTROL_MASK | GDK_ALT_MASK | GDK_SUPER_MASK))
		return GDK_EVENT_PROPAGATE;
	if (!act_on_key(panel, key, code, repeats))
		return GDK_EVENT_PROPAGATE;
	panel->last_code = code;
	return GDK_EVENT_STOP;
}

static void root_key_released(GtkEventControllerKey *keys, guint key, guint code,
			 GdkModifierType state, LadderSimPanel *panel)
{
	(void)keys;
	(void)key;
	(void)state;
	if (panel->last_code == code)
		panel->last_code = 0;
	for (guint i = panel->bound->len; i-- > 0;) {
		struct held *held = g_ptr_array_index(panel->bound, i);

		if (held->code != code)
			continue;
		give(panel, held->row, 0);
		g_ptr_array_remove_index(panel->bound, i);
	}
}

/* Another window gets the release of the key. */
static void active_changed(LadderSimPanel *panel)
{
	if (!gtk_window_is_active(GTK_WINDOW(panel->root)))
		let_go(panel);
}

/* ---- what a person chooses for a line; the project keeps it ---- */

/* A copy of the choices of @row, to be changed and given to put_draft(). */
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

/* @draft: taken over. The rows follow when the document tells that its VIEW part changed. */
static void put_draft(LadderSimPanel *panel, LadderSimRow *draft)
{
	LadderDocument *document = ladder_sim_document(panel->sim);

	live_lines_keep(document, sim_row_write_choices(ladder_document_view(document), draft),
			_("Change the simulation panel"));
	g_object_unref(draft);
}

static void toggle_push(LadderSimPanel *panel)
{
	const LadderSimRow *row = selected_row(panel);
	LadderSimRow *draft;

	if (!row || row->kind != SIM_SWITCH)
		return;
	draft = draft_of(row);
	draft->push = !row->push;
	put_draft(panel, draft);
}

/* ---- asking ---- */

static void end_asking(LadderSimPanel *panel)
{
	g_clear_pointer(&panel->asking, popover_drop);
}

static gboolean end_later(gpointer data)
{
	LadderSimPanel *panel = data;

	end_asking(panel);
	g_object_unref(panel);
	return G_SOURCE_REMOVE;
}

static void closed(LadderSimPanel *panel)
{
	g_idle_add(end_later, g_object_ref(panel));
}

/* Opens a popover with @child at the selected line. */
static void ask(LadderSimPanel *panel, GtkWidget *child)
{
	GtkWidget *at = GTK_WIDGET(view_of(panel, selected_row(panel)));
	graphene_rect_t box = GRAPHENE_RECT_INIT(0, 0, 1, 1);

	end_asking(panel);
	panel->asking = gtk_popover_new();
	gtk_popover_set_child(GTK_POPOVER(panel->asking), child);
	gtk_widget_set_parent(panel->asking, GTK_WIDGET(panel));
	if (at && gtk_widget_compute_bounds(at, GTK_WIDGET(panel), &box))
		popover_point(panel->asking, &(GdkRectangle){
			(int)box.origin.x, (int)box.origin.y, (int)box.size.width,
			(int)box.size.height });
	g_signal_connect_swapped(panel->asking, "closed", G_CALLBACK(closed), panel);
	gtk_popover_popup(GTK_POPOVER(panel->asking));
}

/* ---- a key ---- */

static void bind_key(LadderSimPanel *panel, const char *key, bool toggles)
{
	const LadderSimRow *row = selected_row(panel);
	LadderSimRow *draft;

	if (!row)
		return;
	draft = draft_of(row);
	g_free(draft->key);
	draft->key = g_strdup(key);
	draft->key_toggles = key && toggles;
	put_draft(panel, draft);
}

static gboolean key_given(GtkEventControllerKey *keys, guint key, guint code,
			  GdkModifierType state, LadderSimPanel *panel)
{
	const bool toggles = g_object_get_data(G_OBJECT(keys), "toggles") != NULL;

	(void)code;
	if (key == GDK_KEY_Escape)
		return GDK_EVENT_PROPAGATE;
	if (!can_bind(key) || state & (GDK_CONTROL_MASK | GDK_ALT_MASK))
		return GDK_EVENT_STOP;
	bind_key(panel, gdk_keyval_name(gdk_keyval_to_lower(key)), toggles);
	gtk_popover_popdown(GTK_POPOVER(panel->asking));
	return GDK_EVENT_STOP;
}

static void ask_key(LadderSimPanel *panel, bool toggles)
{
	const LadderSimRow *row = selected_row(panel);
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

static void hold_key(LadderSimPanel *panel)
{
	ask_key(panel, false);
}

static void toggle_key(LadderSimPanel *panel)
{
	ask_key(panel, true);
}

static void no_key(LadderSimPanel *panel)
{
	bind_key(panel, NULL, false);
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
	const LadderSimRow *row = selected_row(panel);
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
		tip_set(entry, _("The lowest value must be less than the highest"));
		g_object_unref(draft);
		return;
	}
	put_draft(panel, draft);
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
	spoken_name(entry, name);
	g_signal_connect(entry, "activate", G_CALLBACK(range_given), panel);
	return entry;
}

static void ask_range(LadderSimPanel *panel)
{
	const LadderSimRow *row = selected_row(panel);
	GtkWidget *box;

	if (!row || (row->kind != SIM_SLIDER && row->kind != SIM_LEVEL))
		return;
	box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	gtk_box_append(GTK_BOX(box), number_entry(panel, _("Lowest value"), row->low));
	gtk_box_append(GTK_BOX(box), gtk_label_new("–"));
	gtk_box_append(GTK_BOX(box), number_entry(panel, _("Highest value"), row->high));
	ask(panel, box);
	gtk_widget_grab_focus(gtk_widget_get_first_child(box));
}

static void no_range(LadderSimPanel *panel)
{
	const LadderSimRow *row = selected_row(panel);
	LadderSimRow *draft;

	if (!row)
		return;
	draft = draft_of(row);
	draft->ranged = false;
	put_draft(panel, draft);
}

/* ---- the menu ---- */

static GMenuModel *choices_of(const LadderSimRow *row)
{
	GMenu *menu = g_menu_new();
	const bool ranged = row->kind == SIM_SLIDER || row->kind == SIM_LEVEL;

	if (row->kind == SIM_SWITCH)
		g_menu_append(menu, row->push ? _("Use as a switch") : _("Use as a push button"),
			      "sim-panel.push");
	if (sim_row_is_bit(row)) {
		g_menu_append(menu, _("Assign a key to hold it on…"), "sim-panel.hold-key");
		g_menu_append(menu, _("Assign a key to toggle it…"), "sim-panel.toggle-key");
	}
	if (row->key)
		g_menu_append(menu, _("Remove the key"), "sim-panel.no-key");
	if (ranged)
		g_menu_append(menu, _("Change range…"), "sim-panel.range");
	if (ranged && row->ranged)
		g_menu_append(menu, _("Use the range of its type"), "sim-panel.no-range");
	return G_MENU_MODEL(menu);
}

/* ---- keys ---- */

static bool is_typing(LadderSimPanel *panel)
{
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(panel));

	return root && GTK_IS_EDITABLE(gtk_root_get_focus(root));
}

/* The space bar presses the line until it is released. True: the key is used. */
static bool press(LadderSimPanel *panel)
{
	LadderSimRow *row = selected_row(panel);

	if (panel->held)
		return true; /* the key repeats itself */
	if (!row || !sim_row_is_bit(row))
		return false;
	panel->held = g_object_ref(row);
	sim_row_press(row, panel->sim);
	return true;
}

/* Right unfolds a line or a group, Left folds it; from a part, Left goes to its line. */
static gboolean fold_by_key(LadderSimPanel *panel, bool folds)
{
	LadderSimRow *row = gtk_single_selection_get_selected_item(panel->selection);

	/* a slider moves with these keys */
	if (!row || GTK_IS_RANGE(gtk_root_get_focus(gtk_widget_get_root(GTK_WIDGET(panel)))))
		return GDK_EVENT_PROPAGATE;
	if (folds && row->owner) {
		char *owner = g_strdup(row->owner);

		ladder_sim_panel_select(panel, owner);
		g_free(owner);
	} else if ((row->kind == SIM_HEADING || row->parts) && row->folded != folds) {
		ladder_sim_row_view_fold(GTK_WIDGET(panel), row);
	}
	return GDK_EVENT_STOP;
}

static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType state, LadderSimPanel *panel)
{
	const GdkModifierType held = state & gtk_accelerator_get_default_mod_mask();

	(void)keys;
	(void)code;
	if (is_typing(panel))
		return GDK_EVENT_PROPAGATE;
	if (key == GDK_KEY_space && !held && press(panel))
		return GDK_EVENT_STOP;
	if ((key == GDK_KEY_Right || key == GDK_KEY_KP_Right) && !held)
		return fold_by_key(panel, false);
	if ((key == GDK_KEY_Left || key == GDK_KEY_KP_Left) && !held)
		return fold_by_key(panel, true);
	return GDK_EVENT_PROPAGATE;
}

static void key_released(GtkEventControllerKey *keys, guint key, guint code,
			 GdkModifierType state, LadderSimPanel *panel)
{
	(void)keys;
	(void)code;
	(void)state;
	if (key == GDK_KEY_space)
		let_go(panel);
}

/* Return, or a double click. */
static void activated(GtkListView *list, guint at, LadderSimPanel *panel)
{
	LadderSimRow *row = g_list_model_get_item(G_LIST_MODEL(panel->selection), at);
	LadderSimRowView *view = view_of(panel, row);

	(void)list;
	if (row && (row->kind == SIM_HEADING || row->kind == SIM_WHOLE))
		ladder_sim_row_view_fold(GTK_WIDGET(panel), row);
	else if (view)
		ladder_sim_row_view_edit(view, row->given.type != IEC_NONE ?
					 SIM_EDIT_PRESET : SIM_EDIT_VALUE);
	g_clear_object(&row);
}

/* ---- actions ---- */

static void force_to(LadderSimPanel *panel, gint64 to)
{
	LadderSimRow *row = selected_row(panel);

	if (row && sim_row_is_bit(row))
		live_value_force(panel->sim, row->plant, row->at, (union iec_value){ .i = to });
}

static void force(LadderSimPanel *panel)
{
	LadderSimRow *row = selected_row(panel);

	if (!row)
		return;
	if (sim_row_is_forced(row, panel->sim))
		sim_row_release(row, panel->sim);
	else if (row->at.type != IEC_NONE)
		live_value_force(panel->sim, row->plant, row->at,
				 live_value_get(panel->sim, row->plant, row->at));
}

static void force_on(LadderSimPanel *panel)
{
	force_to(panel, 1);
}

static void force_off(LadderSimPanel *panel)
{
	force_to(panel, 0);
}

static void release_all(LadderSimPanel *panel)
{
	ladder_sim_release_all(panel->sim);
}

static void edit(LadderSimPanel *panel, enum sim_edit what)
{
	LadderSimRowView *view = view_of(panel, selected_row(panel));

	if (view)
		ladder_sim_row_view_edit(view, what);
}

static void edit_value(LadderSimPanel *panel)
{
	edit(panel, SIM_EDIT_VALUE);
}

static void edit_preset(LadderSimPanel *panel)
{
	edit(panel, SIM_EDIT_PRESET);
}

/* ---- the menu ---- */

static void add_named(GMenu *menu, const char *text, const char *action, const char *name)
{
	GMenuItem *item = g_menu_item_new(text, NULL);

	g_menu_item_set_action_and_target(item, action, "s", name);
	g_menu_append_item(menu, item);
	g_object_unref(item);
}

/* The expected value: for a timer or counter that of its pin Q, for a step Step.X. */
static void add_window(GMenu *menu, const LadderSimRow *row)
{
	char *name = row->kind == SIM_PRESET ? g_strconcat(row->name, ".Q", NULL) :
		     row->kind == SIM_STEP ? g_strconcat(row->name, ".X", NULL) :
		     g_strdup(row->name);

	if (row->kind != SIM_WHOLE)
		add_named(menu, _("Expect this value"), "win.expect-value", name);
	if (row->group != SIM_CHARTS)
		add_named(menu, _("Add to the status chart"), "win.watch-value", row->name);
	g_free(name);
}

static GMenu *menu_of(LadderSimPanel *panel, const LadderSimRow *row)
{
	GMenu *menu = g_menu_new(), *values = g_menu_new(), *forces = g_menu_new();
	GMenuModel *choices = choices_of(row);
	GMenu *others = g_menu_new();

	if (row->kind == SIM_PRESET) {
		if (row->given.type != IEC_NONE)
			g_menu_append(values, _("Change preset…"), "sim-panel.edit-preset");
		g_menu_append(values, row->at.type != IEC_TIME ? _("Change count…") :
		    _("Change elapsed time…"), "sim-panel.edit-value");
	} else if (!sim_row_is_bit(row) && !row->at.constant && row->kind < SIM_STEP) {
		g_menu_append(values, _("Change value…"), "sim-panel.edit-value");
	}
	if (sim_row_is_forced(row, panel->sim))
		g_menu_append(forces, _("Release force"), "sim-panel.force");
	if (sim_row_is_bit(row)) {
		g_menu_append(forces, _("Force on"), "sim-panel.force-on");
		g_menu_append(forces, _("Force off"), "sim-panel.force-off");
	} else if (row->at.type != IEC_STRING && row->kind < SIM_STEP &&
		   !sim_row_is_forced(row, panel->sim)) {
		g_menu_append(forces, _("Force at this value"), "sim-panel.force");
	}
	if (ladder_sim_forces(panel->sim))
		g_menu_append(forces, _("Release all forces"), "sim-panel.release-all");
	if (!row->plant)
		add_window(others, row);
	g_menu_append_section(menu, NULL, G_MENU_MODEL(values));
	g_menu_append_section(menu, NULL, G_MENU_MODEL(forces));
	g_menu_append_section(menu, NULL, choices);
	g_menu_append_section(menu, NULL, G_MENU_MODEL(others));
	g_object_unref(others);
	g_object_unref(values);
	g_object_unref(forces);
	g_object_unref(choices);
	return menu;
}

static void show_menu(LadderSimPanel *panel, const GdkRectangle *at)
{
	LadderSimRow *row = selected_row(panel);

	if (row)
		popover_menu(GTK_WIDGET(panel), menu_of(panel, row), at, panel->list);
}

static void menu_at_line(LadderSimPanel *panel)
{
	LadderSimRowView *view = view_of(panel, selected_row(panel));
	graphene_rect_t box;

	if (view && gtk_widget_compute_bounds(GTK_WIDGET(view), GTK_WIDGET(panel), &box))
		show_menu(panel, &(GdkRectangle){ (int)box.origin.x + 20,
			(int)box.origin.y, 1, (int)box.size.height });
}

static void right_clicked(GtkGestureClick *gesture, int times, double x, double y,
			  LadderSimPanel *panel)
{
	GtkWidget *at = gtk_widget_pick(GTK_WIDGET(panel), x, y, GTK_PICK_DEFAULT);
	LadderSimRow *row = NULL;

	(void)times;
	at = at && !LADDER_IS_SIM_ROW_VIEW(at) ?
		gtk_widget_get_ancestor(at, LADDER_TYPE_SIM_ROW_VIEW) : at;
	if (at)
		row = ladder_sim_row_view_row(LADDER_SIM_ROW_VIEW(at));
	if (!row)
		return;
	gtk_gesture_set_state(GTK_GESTURE(gesture), GTK_EVENT_SEQUENCE_CLAIMED);
	ladder_sim_panel_select(panel, row->name);
	show_menu(panel, &(GdkRectangle){ (int)x, (int)y, 1, 1 });
}

static void begin_keys(LadderSimPanel *panel)
{
	GtkEventController *keys = gtk_event_controller_key_new();
	GtkEventController *focus = gtk_event_controller_focus_new();
	GtkGesture *click = gtk_gesture_click_new();

	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), panel);
	g_signal_connect(keys, "key-released", G_CALLBACK(key_released), panel);
	g_signal_connect_swapped(focus, "leave", G_CALLBACK(let_go_held), panel);
	g_signal_connect(panel->list, "activate", G_CALLBACK(activated), panel);
	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(click), GDK_BUTTON_SECONDARY);
	g_signal_connect(click, "pressed", G_CALLBACK(right_clicked), panel);
	gtk_widget_add_controller(panel->list, keys);
	gtk_widget_add_controller(panel->list, focus);
	gtk_widget_add_controller(GTK_WIDGET(panel), GTK_EVENT_CONTROLLER(click));
}

/* ---- the program and its values ---- */

static gboolean free_rows(gpointer rows)
{
	g_ptr_array_unref(rows);
	return G_SOURCE_REMOVE;
}

/* The lines of another program. If they are the same, their widgets stay. The window is idle when the other rows, which
 * may be thousands, are freed. */
static void look_at_program(LadderSimPanel *panel)
{
	GPtrArray *rows = sim_rows_new(panel->sim);

	if (are_same(panel->rows, rows)) {
		for (guint i = 0; i < rows->len; i++)
			sim_row_become(g_ptr_array_index(panel->rows, i),
				       g_ptr_array_index(rows, i));
		g_idle_add_full(G_PRIORITY_LOW, free_rows, rows, NULL);
		return;
	}
	let_go(panel);
	g_ptr_array_unref(panel->rows);
	panel->rows = rows;
	sim_row_read_choices(ladder_document_view(ladder_sim_document(panel->sim)), rows);
	show_lines(panel);
}

/* Arrows of lines that stayed in the list. */
static void show_again(LadderSimPanel *panel)
{
	for (guint i = 0; i < panel->views->len; i++) {
		LadderSimRowView *view = g_ptr_array_index(panel->views, i);

		ladder_sim_row_view_bind(view, ladder_sim_row_view_row(view));
	}
}

static void read_choices(LadderSimPanel *panel)
{
	LadderDocument *document = ladder_sim_document(panel->sim);

	if (sim_row_read_choices(ladder_document_view(document), panel->rows))
		show_again(panel);
}

/* ---- updates ---- */

static bool is_seen(LadderSimPanel *panel, GtkWidget *view)
{
	const float height = (float)gtk_widget_get_height(panel->list);
	graphene_rect_t box;

	return gtk_widget_compute_bounds(view, panel->list, &box) &&
	       box.origin.y + box.size.height > 0 && box.origin.y < height;
}

/* Some two hundred widgets of the list are outside the visible part. Assistive technology reads
 * them too, so they are updated a few at a time, and at once when they are scrolled into view. */
static gboolean look_at_some(gpointer data)
{
	LadderSimPanel *panel = data;

	for (guint i = 0; i < AT_A_TIME && panel->behind > 0; i++) {
		if (--panel->behind < panel->views->len)
			ladder_sim_row_view_update(g_ptr_array_index(panel->views,
								     panel->behind));
	}
	if (panel->behind == 0 && panel->again) {
		panel->again = false;
		panel->behind = panel->views->len;
	}
	if (panel->behind > 0)
		return G_SOURCE_CONTINUE;
	panel->behind_timer = 0;
	return G_SOURCE_REMOVE;
}

/* Beside what a person used in the panel, not beside what was used elsewhere. */
static void refused(LadderSimPanel *panel, const struct location *at, const char *why)
{
	if (!gtk_widget_get_focus_child(GTK_WIDGET(panel)))
		return;
	for (guint i = 0; i < panel->views->len; i++)
		ladder_sim_row_view_refuse(g_ptr_array_index(panel->views, i), *at, why);
}

static void look(LadderSimPanel *panel)
{
	guint seen = 0;

	for (guint i = 0; i < panel->views->len; i++) {
		GtkWidget *view = g_ptr_array_index(panel->views, i);

		if (!is_seen(panel, view))
			continue;
		ladder_sim_row_view_update(LADDER_SIM_ROW_VIEW(view));
		seen++;
	}
	if (seen == panel->views->len)
		return;
	/* A round under way is not restarted: it would never reach the last views. */
	if (panel->behind_timer) {
		panel->again = true;
		return;
	}
	panel->behind = panel->views->len;
	panel->behind_timer = g_timeout_add(BEHIND_MS, look_at_some, panel);
}

static void shown(LadderSimPanel *panel)
{
	if (gtk_widget_get_mapped(GTK_WIDGET(panel)))
		look(panel);
}

static void program_changed(LadderSimPanel *panel)
{
	look_at_program(panel);
	look(panel);
}

static void state_changed(LadderSimPanel *panel)
{
	const bool on = ladder_sim_is_on(panel->sim);

	if (on != panel->on)
		look_at_program(panel);
	panel->on = on;
	gtk_stack_set_visible_child_name(GTK_STACK(panel->stack), on ? "on" : "off");
	if (on)
		return;
	let_go(panel);
	end_asking(panel);
}

static void search_changed(GtkSearchEntry *entry, LadderSimPanel *panel)
{
	g_free(panel->wanted);
	panel->wanted = g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(entry))));
	show_lines(panel);
	show_again(panel);
}

static void fold(GtkWidget *widget, const char *name, GVariant *section)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(widget);
	const char *key = g_variant_get_string(section, NULL);

	(void)name;
	/* the key of a group begins with a number */
	GHashTable *set = g_ascii_isdigit(key[0]) ? panel->folded : panel->unfolded;

	if (!g_hash_table_remove(set, key))
		g_hash_table_add(set, g_strdup(key));
	show_lines(panel);
	show_again(panel);
}

/* The window's action also reports why a program cannot be built. */
static void simulate(LadderSimPanel *panel)
{
	if (!gtk_widget_activate_action(GTK_WIDGET(panel), "win.sim_mode", NULL))
		ladder_sim_begin(panel->sim, NULL);
}

/* Unfolds the line whose part has that name. */
static void unfold_owner(LadderSimPanel *panel, const char *name)
{
	for (guint i = 0; i < panel->rows->len; i++) {
		const LadderSimRow *row = panel->rows->pdata[i];

		if (!row->owner || strcmp(row->name, name) != 0)
			continue;
		if (g_hash_table_add(panel->unfolded, g_strdup_printf("%s%s", row->plant ? "@" : "",
								      row->owner)))
			show_lines(panel);
		return;
	}
}

bool ladder_sim_panel_select(LadderSimPanel *panel, const char *name)
{
	if (!panel->wanted[0])
		unfold_owner(panel, name);
	GListModel *list = G_LIST_MODEL(panel->store);
	for (guint i = 0; i < g_list_model_get_n_items(list); i++) {
		LadderSimRow *row = g_list_model_get_item(list, i);
		const bool is = row->kind != SIM_HEADING && strcmp(row->name, name) == 0;

		g_object_unref(row);
		if (!is)
			continue;
		gtk_single_selection_set_selected(panel->selection, i);
		list_scroll_to(panel->list, i);
		return true;
	}
	return false;
}

/* ---- widgets of lines ---- */

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item,
		  LadderSimPanel *panel)
{
	(void)factory;
	gtk_list_item_set_activatable(item, TRUE);
	gtk_list_item_set_child(item, ladder_sim_row_view_new(panel->sim, item));
}

static void bind(GtkSignalListItemFactory *factory, GtkListItem *item,
		 LadderSimPanel *panel)
{
	GtkWidget *view = gtk_list_item_get_child(item);

	(void)factory;
	ladder_sim_row_view_bind(LADDER_SIM_ROW_VIEW(view), gtk_list_item_get_item(item));
	g_ptr_array_add(panel->views, view);
}

static void unbind(GtkSignalListItemFactory *factory, GtkListItem *item,
		   LadderSimPanel *panel)
{
	GtkWidget *view = gtk_list_item_get_child(item);

	(void)factory;
	if (panel->views)
		g_ptr_array_remove_fast(panel->views, view);
	if (view)
		ladder_sim_row_view_bind(LADDER_SIM_ROW_VIEW(view), NULL);
}

static void make_list(LadderSimPanel *panel, GtkWidget *list)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();

	g_signal_connect(factory, "setup", G_CALLBACK(setup), panel);
	g_signal_connect(factory, "bind", G_CALLBACK(bind), panel);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind), panel);
	panel->store = g_list_store_new(LADDER_TYPE_SIM_ROW);
	panel->selection = gtk_single_selection_new(G_LIST_MODEL(g_object_ref(panel->store)));
	gtk_single_selection_set_autoselect(panel->selection, FALSE);
	gtk_single_selection_set_can_unselect(panel->selection, TRUE);
	gtk_list_view_set_factory(GTK_LIST_VIEW(list), factory);
	gtk_list_view_set_model(GTK_LIST_VIEW(list), GTK_SELECTION_MODEL(panel->selection));
	g_signal_connect_object(gtk_scrollable_get_vadjustment(GTK_SCROLLABLE(list)),
				"value-changed", G_CALLBACK(look), panel, G_CONNECT_SWAPPED);
	g_object_unref(factory);
}

/* ---- the widget ---- */

static const struct {
	const char *name;
	void (*act)(LadderSimPanel *panel);
} actions[] = {
	{ "sim-panel.simulate", simulate },
	{ "sim-panel.force", force },
	{ "sim-panel.force-on", force_on },
	{ "sim-panel.force-off", force_off },
	{ "sim-panel.release-all", release_all },
	{ "sim-panel.edit-value", edit_value },
	{ "sim-panel.edit-preset", edit_preset },
	{ "sim-panel.menu", menu_at_line },
	{ "sim-panel.push", toggle_push },
	{ "sim-panel.hold-key", hold_key },
	{ "sim-panel.toggle-key", toggle_key },
	{ "sim-panel.no-key", no_key },
	{ "sim-panel.range", ask_range },
	{ "sim-panel.no-range", no_range },
};

static void do_action(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)unused;
	for (gsize i = 0; i < G_N_ELEMENTS(actions); i++)
		if (g_str_equal(actions[i].name, name))
			actions[i].act(LADDER_SIM_PANEL(widget));
}

static void dispose(GObject *object)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(object);

	if (panel->stack) /* its rows and its scrolling ask the panel */
		gtk_list_view_set_model(GTK_LIST_VIEW(panel->list), NULL);
	g_clear_handle_id(&panel->behind_timer, g_source_remove);
	let_go(panel);
	end_asking(panel);
	if (panel->sim) {
		g_signal_handlers_disconnect_by_data(panel->sim, panel);
		g_signal_handlers_disconnect_by_data(ladder_sim_document(panel->sim), panel);
	}
	g_clear_pointer(&panel->views, g_ptr_array_unref);
	g_clear_pointer(&panel->stack, gtk_widget_unparent);
	g_clear_object(&panel->selection);
	g_clear_object(&panel->store);
	g_clear_pointer(&panel->rows, g_ptr_array_unref);
	g_clear_object(&panel->sim);
	g_clear_pointer(&panel->wanted, g_free);
	g_clear_pointer(&panel->folded, g_hash_table_unref);
	g_clear_pointer(&panel->unfolded, g_hash_table_unref);
	G_OBJECT_CLASS(ladder_sim_panel_parent_class)->dispose(object);
}

static void root(GtkWidget *widget)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(widget);
	GtkRoot *window = gtk_widget_get_root(widget);

	GTK_WIDGET_CLASS(ladder_sim_panel_parent_class)->root(widget);
	if (!GTK_IS_WINDOW(window))
		return;
	panel->root = window;
	panel->bound = g_ptr_array_new_with_free_func(held_free);
	panel->root_keys = gtk_event_controller_key_new();
	gtk_event_controller_set_propagation_phase(panel->root_keys, GTK_PHASE_CAPTURE);
	g_signal_connect(panel->root_keys, "key-pressed", G_CALLBACK(root_key_pressed), panel);
	g_signal_connect(panel->root_keys, "key-released", G_CALLBACK(root_key_released), panel);
	gtk_widget_add_controller(GTK_WIDGET(window), panel->root_keys);
	panel->root_active = g_signal_connect_swapped(window, "notify::is-active",
						      G_CALLBACK(active_changed), panel);
}

static void unroot(GtkWidget *widget)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(widget);

	if (panel->root) {
		let_go_bound(panel);
		g_signal_handler_disconnect(panel->root, panel->root_active);
		gtk_widget_remove_controller(GTK_WIDGET(panel->root), panel->root_keys);
		g_clear_pointer(&panel->bound, g_ptr_array_unref);
		panel->root_keys = NULL;
		panel->root = NULL;
	}
	GTK_WIDGET_CLASS(ladder_sim_panel_parent_class)->unroot(widget);
}

static void ladder_sim_panel_class_init(LadderSimPanelClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	widget->root = root;
	widget->unroot = unroot;
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_css_name(widget, "sim-panel");
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/sim_panel.ui");
	gtk_widget_class_bind_template_child(widget, LadderSimPanel, stack);
	gtk_widget_class_bind_template_child(widget, LadderSimPanel, found);
	gtk_widget_class_bind_template_child(widget, LadderSimPanel, search);
	gtk_widget_class_bind_template_child(widget, LadderSimPanel, list);
	gtk_widget_class_bind_template_callback(widget, search_changed);
	gtk_widget_class_install_action(widget, "sim-panel.fold", "s", fold);
	for (gsize i = 0; i < G_N_ELEMENTS(actions); i++)
		gtk_widget_class_install_action(widget, actions[i].name, NULL, do_action);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_F, GDK_CONTROL_MASK |
					    GDK_SHIFT_MASK, "sim-panel.force", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_Menu, 0, "sim-panel.menu", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_F10, GDK_SHIFT_MASK,
					    "sim-panel.menu", NULL);
}

static void ladder_sim_panel_init(LadderSimPanel *panel)
{
	gtk_widget_init_template(GTK_WIDGET(panel));
	panel->wanted = g_strdup("");
	panel->folded = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	panel->unfolded = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	panel->views = g_ptr_array_new();
	panel->rows = g_ptr_array_new_with_free_func(g_object_unref);
	make_list(panel, panel->list);
	begin_keys(panel);
	g_signal_connect(panel, "map", G_CALLBACK(look), NULL);
}

GtkWidget *ladder_sim_panel_new(LadderSim *sim)
{
	LadderSimPanel *panel = g_object_new(LADDER_TYPE_SIM_PANEL, NULL);

	panel->sim = g_object_ref(sim);
	g_signal_connect_swapped(sim, "shown", G_CALLBACK(shown), panel);
	g_signal_connect_swapped(sim, "refused", G_CALLBACK(refused), panel);
	g_signal_connect_swapped(sim, "program-changed", G_CALLBACK(program_changed), panel);
	g_signal_connect_swapped(sim, "state-changed", G_CALLBACK(state_changed), panel);
	g_signal_connect_swapped(ladder_sim_document(sim), "bookmarks-changed",
				 G_CALLBACK(read_choices), panel);
	state_changed(panel);
	return GTK_WIDGET(panel);
}
