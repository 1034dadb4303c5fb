/* SPDX-License-Identifier: MIT
 *
 * panel_cells - editable cells of a panel's list.
 */
#include "editor-gtk/document/panel_cells.h"

#include "editor-gtk/kit/cell_entry.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/left.h"
#include "engine/base/name.h"

#include <string.h>

struct column {
	int field;
	const struct panel_cells *cells;
};

static const struct column *column_of(GtkWidget *cell)
{
	return g_object_get_data(G_OBJECT(cell), "column");
}

static bool is_check(const struct column *column)
{
	return column->cells->checks >> column->field & 1;
}

static bool has_choices(const struct column *column)
{
	return column->cells->choosable >> column->field & 1;
}

static GtkListItem *item_of(GtkWidget *cell)
{
	return g_object_get_data(G_OBJECT(cell), "item");
}

static const char *refused_text(GtkWidget *cell)
{
	return g_object_get_data(G_OBJECT(cell), "refused");
}

static bool set(const struct column *column, LadderPanelRow *row, const char *text,
		char **why)
{
	return column->cells->set(column->cells->owner, row, column->field, text, why);
}

/* ---- an edit of a text ---- */

#define TYPING "typing" /* data of a new row: what was typed into the one whose place it takes */

/* It was set, or given up, or the cell has it. */
static void drop_typing(GtkWidget *cell)
{
	GtkListItem *item = item_of(cell);

	if (item && gtk_list_item_get_item(item))
		g_object_set_data(gtk_list_item_get_item(item), TYPING, NULL);
}

/* The row keeps it while its cell shows another one. */
static void keep(GtkWidget *cell, const char *refused, const char *why)
{
	GtkListItem *item = column_of(cell)->cells->keeps ? item_of(cell) : NULL;
	GObject *row = item ? gtk_list_item_get_item(item) : NULL;

	if (!row)
		return;
	g_object_set_data_full(row, "refused", g_strdup(refused), g_free);
	g_object_set_data_full(row, "why", g_strdup(why), g_free);
}

/* @refused: the refused text, taken over; NULL: the row has the text of the cell. */
static void mark(GtkWidget *cell, char *refused, char *why)
{
	const char *text = gtk_editable_get_text(GTK_EDITABLE(cell));

	drop_typing(cell);
	keep(cell, refused, why);
	if (refused) {
		cells_refused(cell, why);
	} else {
		cells_refuse(cell, NULL);
		tip_set(cell, text);
		cells_shown(cell, text);
	}
	g_object_set_data_full(G_OBJECT(cell), "refused", refused, g_free);
}

/* The new text; NULL: it is unchanged, or was refused already. Caller: g_free. */
static char *edited(GtkWidget *cell, const LadderPanelRow *row)
{
	const struct column *column = column_of(cell);
	const char *refused = refused_text(cell);
	char *text = g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(cell))));

	if (row && g_strcmp0(refused, text) != 0 &&
	    strcmp(text, panel_row_text(row, column->field)) != 0)
		return text;
	g_free(text);
	return NULL;
}

/* Keeps the text that is being typed. */
static void show_text(GtkWidget *cell, const char *text)
{
	if (cells_is_typed(cell))
		return;
	if (strcmp(gtk_editable_get_text(GTK_EDITABLE(cell)), text) != 0)
		gtk_editable_set_text(GTK_EDITABLE(cell), text);
	cells_shown(cell, text);
	tip_set(cell, text);
}

/* The owner may write it in another way: i0.3 becomes I0.3. If it has done so already, the cell has
 * ignored that, because its text was not yet set. @before: the text of the row. */
static void show_written(GtkWidget *cell, const char *before)
{
	GtkListItem *item = item_of(cell);
	const LadderPanelRow *row = item ? gtk_list_item_get_item(item) : NULL;
	const char *text = row ? panel_row_text(row, column_of(cell)->field) : before;

	if (strcmp(text, before) != 0)
		show_text(cell, text);
}

static bool apply(GtkWidget *cell, LadderPanelRow *row, const char *text)
{
	char *why = NULL, *before = g_strdup(panel_row_text(row, column_of(cell)->field));
	bool good;

	g_object_ref(row);
	g_object_ref(cell);
	good = set(column_of(cell), row, text, &why);
	mark(cell, good ? NULL : g_strdup(text), why);
	if (good)
		show_written(cell, before);
	g_object_unref(cell);
	g_object_unref(row);
	g_free(before);
	return good;
}

/* Restores the text from before the edit. */
static void give_up(GtkWidget *cell, LadderPanelRow *row)
{
	const struct panel_cells *cells = column_of(cell)->cells;
	const bool refused = refused_text(cell);

	if (!cells->given_up) {
		if (refused && row)
			apply(cell, row, gtk_editable_get_text(GTK_EDITABLE(cell)));
		return;
	}
	mark(cell, NULL, NULL);
	cells->given_up(cells->owner);
}

static bool is_as_before(GtkWidget *cell, const LadderPanelRow *row)
{
	return row && strcmp(gtk_editable_get_text(GTK_EDITABLE(cell)),
			     panel_row_text(row, column_of(cell)->field)) == 0;
}

/* False: it is refused. A text that was refused before is not tried again, and keeps a window
 * open only once. */
static bool commit(GtkWidget *cell, GtkListItem *item)
{
	LadderPanelRow *row = gtk_list_item_get_item(item);
	char *text = edited(cell, row);
	bool good = true;

	if (text)
		good = apply(cell, row, text);
	else if (refused_text(cell) && is_as_before(cell, row))
		give_up(cell, row);
	g_free(text);
	return good;
}

static void activated(GtkEntry *cell, GtkListItem *item)
{
	commit(GTK_WIDGET(cell), item);
}

/* The rest of a word stands behind the cursor, dim, until another key comes. It is not
 * selected: GTK drops a selection when X tells that an older one is lost. */
struct rest {
	int at;          /* where it begins, in characters; -1: there is none     */
	bool busy;       /* the text is being changed here                        */
};

static struct rest *rest_of(GtkWidget *cell)
{
	return g_object_get_data(G_OBJECT(cell), "rest");
}

static void show_rest(GtkWidget *cell, int at)
{
	PangoAttrList *list = at < 0 ? NULL : pango_attr_list_new();
	const char *text = gtk_editable_get_text(GTK_EDITABLE(cell));
	PangoAttribute *dim = list ? pango_attr_foreground_alpha_new(0xC000) : NULL;

	rest_of(cell)->at = at;
	if (list) {
		dim->start_index = (guint)(g_utf8_offset_to_pointer(text, at) - text);
		pango_attr_list_insert(list, dim);
	}
	gtk_entry_set_attributes(GTK_ENTRY(cell), list);
	g_clear_pointer(&list, pango_attr_list_unref);
}

/* An edit that is set when the focus has moved. The cell may show another row by then. */
struct later {
	const struct column *column;
	GtkWidget *cell;
	LadderPanelRow *row;
	char *text;
};

static bool shows(GtkWidget *cell, LadderPanelRow *row)
{
	GtkListItem *item = item_of(cell);

	return item && gtk_list_item_get_item(item) == row;
}

/* The cell still has the text: it was not bound anew, which shows the text of the row. */
static bool has_text(GtkWidget *cell, const char *text)
{
	char *now = g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(cell))));
	const bool has = !text || strcmp(now, text) == 0;

	g_free(now);
	return has;
}

static void do_later(gpointer data)
{
	struct later *later = data;
	char *why = NULL;
	bool good;

	/* An owner that makes its rows anew marks no row that is good. */
	if (!(later->text && later->column->cells->later) && shows(later->cell, later->row) &&
	    has_text(later->cell, later->text)) {
		commit(later->cell, item_of(later->cell));
		return;
	}
	if (!later->text)
		return;
	good = set(later->column, later->row, later->text, &why);
	if (!good && shows(later->cell, later->row))
		mark(later->cell, g_strdup(later->text), why);
	else
		g_free(why);
}

static void later_free(gpointer data)
{
	struct later *later = data;

	g_object_unref(later->column->cells->owner);
	g_object_unref(later->cell);
	g_object_unref(later->row);
	g_free(later->text);
	g_free(later);
}

static gpointer left(GtkWidget *cell, gpointer unused)
{
	GtkListItem *item = item_of(cell);
	GtkRoot *root = gtk_widget_get_root(cell);
	LadderPanelRow *row = item ? gtk_list_item_get_item(item) : NULL;
	struct later *later;
	char *text;

	(void)unused;
	/* the window committed the edit before it closes */
	if (!row || (root ? gtk_widget_in_destruction(GTK_WIDGET(root)) :
			    !column_of(cell)->cells->later))
		return NULL;
	gtk_editable_select_region(GTK_EDITABLE(cell), 0, 0);
	drop_typing(cell);
	if (rest_of(cell))
		show_rest(cell, -1);
	text = edited(cell, row);
	if (!text && !refused_text(cell))
		return NULL;
	later = g_new(struct later, 1);
	*later = (struct later){ column_of(cell), g_object_ref(cell), g_object_ref(row), text };
	g_object_ref(later->column->cells->owner);
	return later;
}

/* Actions of the panel apply to the row whose cell has the focus. */
static void entered(GtkEventControllerFocus *focus, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(focus));
	GtkWidget *table = gtk_widget_get_ancestor(cell, GTK_TYPE_COLUMN_VIEW);
	GtkSelectionModel *rows = table ? gtk_column_view_get_model(GTK_COLUMN_VIEW(table)) : NULL;

	if (rows) /* none while the table goes */
		gtk_single_selection_set_selected(GTK_SINGLE_SELECTION(rows),
						  gtk_list_item_get_position(item));
}

bool panel_cells_commit(GtkColumnView *view)
{
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(view));
	GtkWidget *cell;

	left_now();
	cell = root ? gtk_root_get_focus(root) : NULL;
	while (cell && cell != GTK_WIDGET(view) && !column_of(cell))
		cell = gtk_widget_get_parent(cell);
	if (!cell || !gtk_widget_is_ancestor(cell, GTK_WIDGET(view)) || !GTK_IS_ENTRY(cell) ||
	    !item_of(cell))
		return true;
	return commit(cell, item_of(cell)) && !refused_text(cell);
}

bool panel_cells_focus(GtkWidget *within, int row, int field)
{
	const struct column *column = column_of(within);
	GtkListItem *item = column ? item_of(within) : NULL;
	LadderPanelRow *of = item ? gtk_list_item_get_item(item) : NULL;

	if (of && of->index == row && column->field == field) {
		if (GTK_IS_ENTRY(within))
			gtk_entry_grab_focus_without_selecting(GTK_ENTRY(within));
		else
			gtk_widget_grab_focus(within);
		return true;
	}
	for (GtkWidget *child = column ? NULL : gtk_widget_get_first_child(within); child;
	     child = gtk_widget_get_next_sibling(child))
		if (panel_cells_focus(child, row, field))
			return true;
	return false;
}

static void toggled(GtkCheckButton *check, GtkListItem *item)
{
	const struct column *column = column_of(GTK_WIDGET(check));
	LadderPanelRow *row = gtk_list_item_get_item(item);
	const bool is = row && *panel_row_text(row, column->field);
	char *why = NULL;

	if (!row || gtk_check_button_get_active(check) == is)
		return;
	/* the list has focused the first cell of the row */
	gtk_widget_grab_focus(GTK_WIDGET(check));
	g_object_ref(row);
	if (set(column, row, is ? "" : "1", &why)) {
		cells_refuse(GTK_WIDGET(check), NULL);
	} else {
		gtk_check_button_set_active(check, is);
		cells_refused(GTK_WIDGET(check), why);
	}
	g_object_unref(row);
}

/* ---- choices ---- */

#define MANY 8 /* choices; longer lists get a search entry                     */

static void popover_closed(GtkWidget *popover)
{
	/* Not before the choice has been taken. */
	popover_drop_later(popover);
}

LadderPanelRow *panel_cells_row(GtkWidget *cell)
{
	GtkListItem *item = item_of(cell);

	return item ? gtk_list_item_get_item(item) : NULL;
}

bool panel_cells_take(GtkWidget *cell, const char *text)
{
	LadderPanelRow *row = panel_cells_row(cell);

	if (!row)
		return false;
	gtk_editable_set_text(GTK_EDITABLE(cell), text);
	return apply(cell, row, text);
}

static void chosen(GtkWidget *popover, GtkListBoxRow *choice)
{
	const struct column *column = column_of(popover);
	LadderPanelRow *row = g_object_get_data(G_OBJECT(popover), "row");
	GtkWidget *cell = g_object_get_data(G_OBJECT(popover), "cell");
	GtkListItem *item = item_of(cell);
	char *why = NULL;

	gtk_popover_popdown(GTK_POPOVER(popover));
	panel_cells_focus(gtk_widget_get_parent(popover), row->index, column->field);
	if (!column->cells->later && item && gtk_list_item_get_item(item) == row)
		panel_cells_take(cell, g_object_get_data(G_OBJECT(choice), "text"));
	else
		set(column, row, g_object_get_data(G_OBJECT(choice), "text"), &why);
	g_free(why);
}

static void open_form(GtkWidget *cell)
{
	const struct column *column = column_of(cell);
	LadderPanelRow *row = panel_cells_row(cell);

	if (row)
		column->cells->open_form(column->cells->owner, row, column->field, cell);
}

static gboolean form_later(gpointer cell)
{
	open_form(cell);
	return G_SOURCE_REMOVE;
}

/* Below the choices. The popover must be closed first. */
static void form_wanted(GtkWidget *popover)
{
	GtkWidget *cell = g_object_get_data(G_OBJECT(popover), "cell");

	gtk_popover_popdown(GTK_POPOVER(popover));
	g_idle_add_full(G_PRIORITY_DEFAULT_IDLE, form_later, g_object_ref(cell),
			g_object_unref);
}

/* Enter in the search takes the first choice that is left. */
static void search_activated(GtkWidget *popover)
{
	GtkWidget *list = g_object_get_data(G_OBJECT(popover), "list");

	for (GtkWidget *row = gtk_widget_get_first_child(list); row;
	     row = gtk_widget_get_next_sibling(row))
		if (GTK_IS_LIST_BOX_ROW(row) && gtk_widget_get_child_visible(row)) {
			chosen(popover, GTK_LIST_BOX_ROW(row));
			return;
		}
}

static gboolean is_wanted(GtkListBoxRow *row, gpointer search)
{
	char *wanted = g_utf8_casefold(gtk_editable_get_text(search), -1);
	char *text = g_utf8_casefold(g_object_get_data(G_OBJECT(row), "whole"), -1);
	const bool is = strstr(text, wanted) != NULL;

	g_free(wanted);
	g_free(text);
	return is;
}

static GtkWidget *choice_row(const char *text, const char *about)
{
	GtkWidget *row = gtk_list_box_row_new();
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 12);
	GtkWidget *name = gtk_label_new(*text ? text : _("(none)"));
	GtkWidget *note = gtk_label_new(about);
	char *whole = g_strdup_printf("%s %s", *text ? text : _("(none)"), about);

	gtk_label_set_xalign(GTK_LABEL(name), 0);
	gtk_widget_set_hexpand(name, TRUE);
	gtk_widget_add_css_class(note, "dim-label");
	gtk_widget_add_css_class(note, "caption");
	gtk_box_append(GTK_BOX(box), name);
	gtk_box_append(GTK_BOX(box), note);
	gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), box);
	gtk_accessible_update_property(GTK_ACCESSIBLE(row), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       whole, -1);
	g_object_set_data_full(G_OBJECT(row), "text", g_strdup(text), g_free);
	g_object_set_data_full(G_OBJECT(row), "whole", whole, g_free);
	return row;
}

static GtkWidget *choice_list(GPtrArray *choices, const char *now)
{
	GtkWidget *list = gtk_list_box_new();

	gtk_list_box_set_activate_on_single_click(GTK_LIST_BOX(list), TRUE);
	for (guint i = 0; i + 1 < choices->len; i += 2) {
		GtkWidget *row = choice_row(choices->pdata[i], choices->pdata[i + 1]);

		gtk_list_box_append(GTK_LIST_BOX(list), row);
		if (strcmp(choices->pdata[i], now) == 0)
			gtk_list_box_select_row(GTK_LIST_BOX(list), GTK_LIST_BOX_ROW(row));
	}
	return list;
}

static bool has_form(const struct column *column, const LadderPanelRow *row)
{
	return row && column->cells->has_form &&
	       column->cells->has_form(row, column->field);
}

static GtkWidget *form_button(const struct column *column, GtkWidget *popover)
{
	GtkWidget *button = gtk_button_new_with_label(column->cells->form_name(column->field));

	g_signal_connect_swapped(button, "clicked", G_CALLBACK(form_wanted), popover);
	return button;
}

static GtkWidget *choice_popover(GPtrArray *choices, const char *now,
				 const struct column *column, const LadderPanelRow *row)
{
	GtkWidget *popover = gtk_popover_new(), *scroller = gtk_scrolled_window_new();
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
	GtkWidget *list = choice_list(choices, now);

	if (choices->len / 2 > MANY) {
		GtkWidget *search = gtk_search_entry_new();

		gtk_accessible_update_property(GTK_ACCESSIBLE(search),
			GTK_ACCESSIBLE_PROPERTY_LABEL, _("Filter"), -1);
		g_signal_connect_swapped(search, "changed",
			G_CALLBACK(gtk_list_box_invalidate_filter), list);
		gtk_list_box_set_filter_func(GTK_LIST_BOX(list), is_wanted, search, NULL);
		g_signal_connect_swapped(search, "activate", G_CALLBACK(search_activated),
					 popover);
		gtk_box_append(GTK_BOX(box), search);
	}
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(scroller), TRUE);
	gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(scroller), 280);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), list);
	gtk_box_append(GTK_BOX(box), scroller);
	if (has_form(column, row))
		gtk_box_append(GTK_BOX(box), form_button(column, popover));
	g_object_set_data(G_OBJECT(popover), "list", list);
	gtk_popover_set_child(GTK_POPOVER(popover), box);
	gtk_popover_set_position(GTK_POPOVER(popover), GTK_POS_BOTTOM);
	g_signal_connect_swapped(list, "row-activated", G_CALLBACK(chosen), popover);
	g_signal_connect(popover, "closed", G_CALLBACK(popover_closed), NULL);
	return popover;
}

static void show_choices(GtkWidget *cell, GtkListItem *item)
{
	const struct column *column = column_of(cell);
	LadderPanelRow *row = gtk_list_item_get_item(item);
	GtkWidget *scroller = gtk_widget_get_ancestor(cell, GTK_TYPE_SCROLLED_WINDOW);
	GPtrArray *choices;
	GtkWidget *popover;
	graphene_rect_t bounds;

	if (!row || !scroller)
		return;
	choices = column->cells->choices(column->cells->owner, column->field);
	popover = choice_popover(choices, panel_row_text(row, column->field), column, row);
	g_object_set_data_full(G_OBJECT(popover), "cell", g_object_ref(cell), g_object_unref);
	g_object_set_data(G_OBJECT(popover), "column", (gpointer)column);
	g_object_set_data_full(G_OBJECT(popover), "row", g_object_ref(row), g_object_unref);
	popover_put(popover, scroller);
	popover_form(popover, cell);
	if (gtk_widget_compute_bounds(cell, scroller, &bounds))
		popover_point(popover, &(GdkRectangle){
			(int)bounds.origin.x, (int)bounds.origin.y,
			(int)bounds.size.width, (int)bounds.size.height });
	gtk_popover_popup(GTK_POPOVER(popover));
	g_ptr_array_unref(choices);
}

static void icon_pressed(GtkEntry *cell, GtkEntryIconPosition position, GtkListItem *item)
{
	(void)position;
	if (has_choices(column_of(GTK_WIDGET(cell))))
		show_choices(GTK_WIDGET(cell), item);
	else if (has_form(column_of(GTK_WIDGET(cell)), gtk_list_item_get_item(item)))
		open_form(GTK_WIDGET(cell));
}

/* ---- completion ---- */

/* Bytes at the beginning of @text that spell @word, which need not be as many; 0: none do. */
static gsize spelled(const char *text, const char *word, gsize len)
{
	gsize head = 0;

	for (const char *at = text; *at; ) {
		at = g_utf8_next_char(at);
		if (name_same(word, len, text, (gsize)(at - text)))
			head = (gsize)(at - text);
	}
	return head;
}

/* The rest of the word that was begun; NULL: no word fits. */
static const char *completion(const struct column *column, const char *word, gsize len)
{
	GPtrArray *choices = column->cells->choices(column->cells->owner, column->field);
	const char *found = NULL;

	for (guint i = 0; len && i + 1 < choices->len; i += 2) {
		const char *text = choices->pdata[i];
		const gsize head = spelled(text, word, len);

		if (!head)
			continue;
		if (!text[head]) { /* it is whole */
			found = NULL;
			break;
		}
		found = found ? found : text + head;
	}
	found = found ? g_intern_string(found) : NULL;
	g_ptr_array_unref(choices);
	return found;
}

/* Behind each insertion: @at is the end of what was inserted. */
static void inserted(GtkEditable *line, const char *added, int len, int *at, GtkWidget *cell)
{
	struct rest *rest = rest_of(cell);
	const int start = *at - (int)g_utf8_strlen(added, len);
	const char *text, *begun, *missing;
	int end = *at;

	if (rest->busy)
		return;
	rest->busy = true;
	if (rest->at == start)
		gtk_editable_delete_text(line, *at, -1);
	show_rest(cell, -1);
	text = gtk_editable_get_text(line);
	begun = strrchr(text, ' ') ? strrchr(text, ' ') + 1 : text;
	missing = *at == (int)g_utf8_strlen(text, -1) && item_of(cell) &&
	       gtk_widget_has_focus(GTK_WIDGET(line)) ?
	       completion(column_of(cell), begun, strlen(begun)) : NULL;
	if (missing) {
		gtk_editable_insert_text(line, missing, -1, &end);
		show_rest(cell, *at);
	}
	rest->busy = false;
}

/* A deletion takes the rest, too. */
static void deleted(GtkEditable *line, int from, int to, GtkWidget *cell)
{
	struct rest *rest = rest_of(cell);

	(void)to;
	if (rest->busy || rest->at < 0)
		return;
	rest->busy = true;
	if (from <= rest->at)
		gtk_editable_delete_text(line, from, -1);
	show_rest(cell, -1);
	rest->busy = false;
}

/* Keys that move the cursor keep the rest; Right goes behind it. */
static gboolean key_comes(GtkEventControllerKey *keys, guint key, guint code,
			  GdkModifierType state, GtkWidget *cell)
{
	const bool right = key == GDK_KEY_Right && rest_of(cell)->at >= 0;

	(void)keys;
	(void)code;
	(void)state;
	switch (key) {
	case GDK_KEY_Right: case GDK_KEY_Left: case GDK_KEY_Home: case GDK_KEY_End:
	case GDK_KEY_Tab: case GDK_KEY_ISO_Left_Tab: case GDK_KEY_Return:
	case GDK_KEY_KP_Enter: case GDK_KEY_Up: case GDK_KEY_Down:
		show_rest(cell, -1);
		break;
	}
	if (right)
		gtk_editable_set_position(GTK_EDITABLE(cell), -1);
	return right;
}

static void complete_words(GtkWidget *cell)
{
	GtkEventController *keys = gtk_event_controller_key_new();
	GtkEditable *line = gtk_editable_get_delegate(GTK_EDITABLE(cell));
	struct rest *rest = g_new0(struct rest, 1);

	rest->at = -1;
	g_object_set_data_full(G_OBJECT(cell), "rest", rest, g_free);
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_comes), cell);
	gtk_widget_add_controller(cell, keys);
	g_signal_connect_after(line, "insert-text", G_CALLBACK(inserted), cell);
	g_signal_connect_after(line, "delete-text", G_CALLBACK(deleted), cell);
}

/* Esc restores the text. Alt+Down and Ctrl+Space open the choices or the form. */
static gboolean pressed(GtkEventControllerKey *keys, guint key, guint code,
			GdkModifierType state, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(keys));
	const struct column *column = column_of(cell);
	LadderPanelRow *row = gtk_list_item_get_item(item);
	const char *text = row ? panel_row_text(row, column->field) : "";

	(void)code;
	if ((key == GDK_KEY_Down && state & GDK_ALT_MASK) ||
	    (key == GDK_KEY_space && state & GDK_CONTROL_MASK)) {
		if (has_choices(column))
			show_choices(cell, item);
		else if (has_form(column, row))
			open_form(cell);
		else
			return FALSE;
		return TRUE;
	}
	if (key != GDK_KEY_Escape ||
	    strcmp(text, gtk_editable_get_text(GTK_EDITABLE(cell))) == 0)
		return FALSE;
	gtk_editable_set_text(GTK_EDITABLE(cell), text);
	give_up(cell, row);
	return TRUE;
}

/* ---- the factory ---- */

static GtkWidget *entry_new(const struct column *column)
{
	GtkWidget *cell = cell_entry_new();

	g_object_set_data(G_OBJECT(cell), "focus", left_connect(cell, left, do_later, later_free, NULL));
	cells_add(cell, "keys", gtk_event_controller_key_new());
	gtk_editable_set_width_chars(GTK_EDITABLE(cell), 4);
	if (has_choices(column)) {
		gtk_entry_set_icon_tooltip_text(GTK_ENTRY(cell), GTK_ENTRY_ICON_SECONDARY,
						_("Choices (Ctrl+Space)"));
	}
	if (column->cells->completing >> column->field & 1)
		complete_words(cell);
	return cell;
}

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	const struct column *column = data;
	GtkWidget *cell = is_check(column) ? gtk_check_button_new() : entry_new(column);

	(void)factory;
	g_object_set_data(G_OBJECT(cell), "column", data);
	if (is_check(column))
		gtk_widget_set_halign(cell, GTK_ALIGN_CENTER);
	gtk_list_item_set_child(item, cell);
}

static void connect_entry(GtkWidget *cell, GtkListItem *item)
{
	GObject *focus = g_object_get_data(G_OBJECT(cell), "focus");

	g_signal_connect(cell, "activate", G_CALLBACK(activated), item);
	g_signal_connect(cell, "icon-press", G_CALLBACK(icon_pressed), item);
	g_signal_connect(focus, "enter", G_CALLBACK(entered), item);
	g_signal_connect(g_object_get_data(G_OBJECT(cell), "keys"), "key-pressed",
			 G_CALLBACK(pressed), item);
	if (!column_of(cell)->cells->later)
		cells_on_take(cell, commit, item);
}

/* The icon of a cell without choices opens its form. A refused cell has another icon. */
static void show_form_icon(GtkWidget *cell, const struct column *column,
			   const LadderPanelRow *row)
{
	const bool has = has_form(column, row);

	if (!column->cells->has_form || has_choices(column) || refused_text(cell))
		return;
	cells_icon(GTK_ENTRY(cell), has ? "view-list-symbolic" : NULL,
		   has ? column->cells->form_name(column->field) : NULL);
}

static void show(LadderPanelRow *row, GtkListItem *item)
{
	GtkWidget *cell = gtk_list_item_get_child(item);
	const struct column *column = column_of(cell);
	const struct panel_cells *cells = column->cells;
	const char *text = panel_row_text(row, column->field);
	char *name = g_strdup_printf("%s, %s", panel_row_text(row, 0),
				     cells->name(column->field));
	const bool fixed = cells->is_fixed && cells->is_fixed(row, column->field);

	gtk_widget_set_sensitive(cell, !fixed);
	if (has_choices(column))
		gtk_entry_set_icon_from_icon_name(GTK_ENTRY(cell), GTK_ENTRY_ICON_SECONDARY,
						  fixed ? NULL : "pan-down-symbolic");
	if (cells->dress)
		cells->dress(cell, row, column->field);
	if (is_check(column))
		gtk_check_button_set_active(GTK_CHECK_BUTTON(cell), *text);
	else
		show_text(cell, text);
	if (!is_check(column))
		show_form_icon(cell, column, row);
	gtk_accessible_update_property(GTK_ACCESSIBLE(cell),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	panel_speak(cell, row);
	g_free(name);
}

/* The text that the row keeps is shown again, as refused. */
static void show_kept(GtkWidget *cell, LadderPanelRow *row)
{
	const char *text = g_object_get_data(G_OBJECT(row), "refused");
	char *why = g_strdup(g_object_get_data(G_OBJECT(row), "why"));

	if (!text) {
		g_free(why);
		return;
	}
	gtk_editable_set_text(GTK_EDITABLE(cell), text);
	cells_refused(cell, why);
	g_object_set_data_full(G_OBJECT(cell), "refused", g_strdup(text), g_free);
}

/* ---- a row is made anew while somebody types ---- */

struct typing {
	int field, cursor;
	char *text;
};

static void typing_free(gpointer data)
{
	struct typing *typing = data;

	g_free(typing->text);
	g_free(typing);
}

/* What is typed into the cell with the focus, and not yet set; NULL: nothing. */
static struct typing *typing_in(GtkColumnView *view, int field)
{
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(view));
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;
	GtkWidget *cell = focus ? gtk_widget_get_ancestor(focus, GTK_TYPE_ENTRY) : NULL;
	struct typing *typing;

	if (!cell || !column_of(cell) || !cells_is_typed(cell))
		return NULL;
	typing = g_new(struct typing, 1);
	*typing = (struct typing){ field, gtk_editable_get_position(GTK_EDITABLE(cell)),
				   g_strdup(gtk_editable_get_text(GTK_EDITABLE(cell))) };
	return typing;
}

/* The new row of the same declaration gets it. */
static void pass_typing(GPtrArray *rows, const LadderPanelRow *old, struct typing *typing)
{
	for (guint i = 0; i < rows->len; i++)
		if (panel_row_is_like(rows->pdata[i], old)) {
			g_object_set_data_full(rows->pdata[i], TYPING, typing, typing_free);
			return;
		}
	typing_free(typing);
}

/* The cell shows it again; cells_enter() puts the cursor where it was. */
static void show_typing(GtkWidget *cell, LadderPanelRow *row)
{
	const struct typing *typing = g_object_get_data(G_OBJECT(row), TYPING);

	if (!typing || typing->field != column_of(cell)->field || is_check(column_of(cell)))
		return;
	gtk_editable_set_text(GTK_EDITABLE(cell), typing->text);
	gtk_editable_set_position(GTK_EDITABLE(cell), typing->cursor);
	cells_keep_cursor(GTK_ENTRY(cell), typing->cursor);
}

static void bind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	const struct column *column = data;
	LadderPanelRow *row = gtk_list_item_get_item(item);
	GtkWidget *cell = gtk_list_item_get_child(item);

	(void)factory;
	cells_refuse(cell, NULL);
	cells_stand(cell, item, column->field);
	g_object_set_data(G_OBJECT(cell), "refused", NULL);
	cells_shown(cell, NULL);
	show(row, item);
	if (column->cells->keeps)
		show_kept(cell, row);
	show_typing(cell, row);
	g_signal_connect(row, "changed", G_CALLBACK(show), item);
	if (is_check(column))
		g_signal_connect(cell, "toggled", G_CALLBACK(toggled), item);
	else
		connect_entry(cell, item);
}

static void unbind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	GtkWidget *cell = gtk_list_item_get_child(item);

	(void)factory;
	(void)data;
	g_signal_handlers_disconnect_by_data(gtk_list_item_get_item(item), item);
	g_signal_handlers_disconnect_by_data(cell, item);
	cells_stand(cell, NULL, 0);
	if (!GTK_IS_ENTRY(cell))
		return;
	cells_on_take(cell, NULL, NULL);
	g_signal_handlers_disconnect_by_data(g_object_get_data(G_OBJECT(cell), "focus"), item);
	g_signal_handlers_disconnect_by_data(g_object_get_data(G_OBJECT(cell), "keys"), item);
}

static void free_column(gpointer column, GClosure *closure)
{
	(void)closure;
	g_free(column);
}

void panel_cells_add(struct panel_list *list, const struct panel_cells *cells, int field,
		     unsigned int flags, int width)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	struct column *column = g_new(struct column, 1);

	*column = (struct column){ field, cells };
	g_signal_connect_data(factory, "setup", G_CALLBACK(setup), column, free_column, 0);
	g_signal_connect(factory, "bind", G_CALLBACK(bind), column);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind), column);
	panel_list_add(list, cells->name(field), field, flags | (cells->choosable >> field & 1 ?
		       PANEL_BUTTON : 0), width, factory);
}

void panel_cells_update(struct panel_list *list, GPtrArray *rows)
{
	int field, now;
	LadderPanelRow *row = cells_focused(list->view, &field);
	LadderPanelRow *chosen = panel_list_row(list);
	struct typing *typing = row ? typing_in(list->view, field) : NULL;

	if (row)
		g_object_ref(row);
	if (typing)
		pass_typing(rows, row, typing);
	if (chosen)
		g_object_ref(chosen);
	panel_list_update(list, rows);
	if (row && cells_focused(list->view, &now) != row &&
	    panel_list_select(list, panel_row_is_like, row))
		cells_enter(list->view, panel_list_row(list), field);
	else if (chosen && !panel_list_row(list))
		panel_list_select(list, panel_row_is_like, chosen);
	g_clear_object(&row);
	g_clear_object(&chosen);
}
