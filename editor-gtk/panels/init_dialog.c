/* SPDX-License-Identifier: MIT
 *
 * init_dialog - initial values as a tree in a dialog; see init_dialog.h.
 */
#include "editor-gtk/panels/init_dialog.h"

#include "editor-gtk/document/init_form.h"
#include "editor-gtk/document/panel_cells.h"
#include "editor-gtk/document/symbols.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"

#include <adwaita.h>
#include <string.h>

#define OPEN_MOST 60 /* rows that are unfolded when it opens                   */

enum { INIT_NAME, INIT_TYPE, INIT_DEFAULT, INIT_VALUE };

struct dialog {
	GtkWindow *window;
	LadderDocument *document;
	struct init_form *form;
	int rows;
	char *owner, *name;       /* of the variable, and what declares it: symbol_table_name() */
	struct panel_list list;   /* only its view and selection are used       */
	struct panel_cells cells;
	GtkTreeListModel *tree;   /* belongs to the selection                   */
	GListModel *root;         /* the one row of the variable; of the tree    */
	GtkWidget *text, *why;
	GtkWidget *from;          /* a weak pointer                             */
};

/* ---- rows ---- */

static struct init_node *node_of(const LadderPanelRow *row)
{
	return g_object_get_data(G_OBJECT(row), "node");
}

static void fill(struct dialog *dialog, LadderPanelRow *row)
{
	struct init_node *node = node_of(row);
	GString *spoken = g_string_new(row->text[INIT_NAME]);

	g_free(row->text[INIT_VALUE]);
	row->text[INIT_VALUE] = init_node_text(dialog->form, node);
	g_string_append_printf(spoken, ", %s", row->text[INIT_TYPE]);
	if (!node->parts)
		g_string_append_printf(spoken, _(", default %s"), row->text[INIT_DEFAULT]);
	if (*row->text[INIT_VALUE])
		g_string_append_printf(spoken, ", %s", row->text[INIT_VALUE]);
	g_free(row->spoken);
	row->spoken = g_string_free(spoken, FALSE);
}

/* @above: the row of what contains it; it lives as long. */
static LadderPanelRow *row_new(struct dialog *dialog, struct init_node *node,
			       LadderPanelRow *above)
{
	LadderPanelRow *row = ladder_panel_row_new();

	g_object_set_data(G_OBJECT(row), "node", node);
	g_object_set_data(G_OBJECT(row), "above", above);
	row->table = 0;
	row->index = dialog->rows++;
	row->text[INIT_NAME] = g_strdup(node->name);
	row->text[INIT_TYPE] = g_strdup(node->type);
	row->text[INIT_DEFAULT] = init_node_default(dialog->form, node);
	fill(dialog, row);
	return row;
}

/* The rows below one that was unfolded; NULL: it never was. Borrowed. */
static GListModel *rows_below(gpointer row)
{
	return g_object_get_data(G_OBJECT(row), "below");
}

/* A row that is folded keeps those below it, with the texts that were refused there. */
static GListModel *parts_of(gpointer item, gpointer data)
{
	struct dialog *dialog = data;
	struct init_node *node = node_of(item);
	GListStore *store;
	GPtrArray *parts;

	if (!node->parts)
		return NULL;
	if (rows_below(item))
		return g_object_ref(rows_below(item));
	store = g_list_store_new(LADDER_TYPE_PANEL_ROW);
	parts = init_node_parts(dialog->form, node);
	for (guint i = 0; i < parts->len; i++) {
		LadderPanelRow *row = row_new(dialog, parts->pdata[i], item);

		g_list_store_append(store, row);
		g_object_unref(row);
	}
	g_object_set_data_full(G_OBJECT(item), "below", g_object_ref(store), g_object_unref);
	return G_LIST_MODEL(store);
}

/* Unfolds rows as long as there are few. */
static void unfold(struct dialog *dialog)
{
	GListModel *rows = G_LIST_MODEL(dialog->tree);

	for (guint i = 0; i < g_list_model_get_n_items(rows); i++) {
		GtkTreeListRow *row = gtk_tree_list_model_get_row(dialog->tree, i);

		if (i == 0 || g_list_model_get_n_items(rows) < OPEN_MOST)
			gtk_tree_list_row_set_expanded(row, TRUE);
		g_object_unref(row);
	}
}

/* ---- values ---- */

static void show_text(struct dialog *dialog)
{
	char *text = init_node_text(dialog->form, init_form_root(dialog->form));

	gtk_label_set_text(GTK_LABEL(dialog->text), *text ? text : _("All values are the defaults"));
	tip_set(dialog->text, text);
	g_free(text);
}

static void show_why(struct dialog *dialog, const char *why)
{
	gtk_label_set_text(GTK_LABEL(dialog->why), why ? why : "");
}

static bool set_value(GObject *owner, LadderPanelRow *row, int field, const char *text,
		      char **why)
{
	struct dialog *dialog = g_object_get_data(owner, "dialog");

	(void)field;
	if (!init_node_set(dialog->form, node_of(row), text, why)) {
		show_why(dialog, *why);
		return false;
	}
	show_why(dialog, NULL);
	show_text(dialog);
	for (; row; row = g_object_get_data(G_OBJECT(row), "above")) {
		fill(dialog, row);
		g_signal_emit_by_name(row, "changed");
	}
	return true;
}

static const char *field_name(int field)
{
	static const char *const name[] = {
		[INIT_NAME] = N_("Name"), [INIT_TYPE] = N_("Type"),
		[INIT_DEFAULT] = N_("Default"), [INIT_VALUE] = N_("Value"),
	};

	return _(name[field]);
}

static bool is_fixed(const LadderPanelRow *row, int field)
{
	(void)field;
	return node_of(row)->parts;
}

/* ---- the end ---- */

/* The first row in @rows, or below them, with a text that was refused; NULL: none. */
static LadderPanelRow *find_refused(GListModel *rows)
{
	LadderPanelRow *found = NULL;

	for (guint i = 0; rows && !found && i < g_list_model_get_n_items(rows); i++) {
		LadderPanelRow *row = g_list_model_get_item(rows, i);

		g_object_unref(row); /* the model has a reference */
		found = g_object_get_data(G_OBJECT(row), "refused") ? row :
			find_refused(rows_below(row));
	}
	return found;
}

/* Where a row is in the list; unfolds what it is below. */
static guint place_of(struct dialog *dialog, LadderPanelRow *row)
{
	GListModel *rows = G_LIST_MODEL(dialog->tree);
	LadderPanelRow *above = g_object_get_data(G_OBJECT(row), "above");
	GtkTreeListRow *folded;

	if (above) {
		folded = gtk_tree_list_model_get_row(dialog->tree, place_of(dialog, above));
		gtk_tree_list_row_set_expanded(folded, TRUE);
		g_object_unref(folded);
	}
	for (guint i = 0; i < g_list_model_get_n_items(rows); i++) {
		gpointer item = g_list_model_get_item(rows, i);

		g_object_unref(item); /* the model has a reference */
		if (item == row)
			return i;
	}
	g_return_val_if_reached(0);
}

/* Goes to the first value that is refused. False: none is. */
static bool enter_refused(struct dialog *dialog)
{
	LadderPanelRow *row = find_refused(dialog->root);

	if (!row)
		return false;
	show_why(dialog, g_object_get_data(G_OBJECT(row), "why"));
	gtk_single_selection_set_selected(dialog->list.selection, place_of(dialog, row));
	cells_enter(dialog->list.view, row, INIT_VALUE);
	return true;
}

static void apply(GtkWidget *window, const char *action, GVariant *unused)
{
	struct dialog *dialog = g_object_get_data(G_OBJECT(window), "dialog");
	const int table = symbol_table_find(dialog->document, dialog->owner);
	char *text, *why = NULL;
	bool good = true;

	(void)action;
	(void)unused;
	if (!cells_take(GTK_WINDOW(window)) || enter_refused(dialog))
		return;
	text = init_node_text(dialog->form, init_form_root(dialog->form));
	if (init_form_is_changed(dialog->form))
		good = symbol_set(dialog->document, table,
				  symbol_find(dialog->document, table, dialog->name, -1),
				  FIELD_INITIAL, text, &why);
	if (good)
		gtk_window_close(GTK_WINDOW(window));
	else
		show_why(dialog, why);
	g_free(why);
	g_free(text);
}

static void cancel(GtkWidget *window, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	gtk_window_close(GTK_WINDOW(window));
}

static void dialog_free(gpointer data)
{
	struct dialog *dialog = data;

	g_clear_weak_pointer(&dialog->from);
	init_form_free(dialog->form);
	g_object_unref(dialog->document);
	g_free(dialog->owner);
	g_free(dialog->name);
	g_free(dialog);
}

/* ---- the window ---- */

struct _LadderInitDialog {
	GtkWindow parent_instance;
};

#define LADDER_TYPE_INIT_DIALOG (ladder_init_dialog_get_type())
G_DECLARE_FINAL_TYPE(LadderInitDialog, ladder_init_dialog, LADDER, INIT_DIALOG, GtkWindow)
G_DEFINE_FINAL_TYPE(LadderInitDialog, ladder_init_dialog, GTK_TYPE_WINDOW)

static void ladder_init_dialog_dispose(GObject *object)
{
	struct dialog *dialog = g_object_get_data(object, "dialog");

	if (dialog && dialog->from)
		gtk_widget_grab_focus(dialog->from);
	gtk_window_set_child(GTK_WINDOW(object), NULL); /* its rows point to the form */
	G_OBJECT_CLASS(ladder_init_dialog_parent_class)->dispose(object);
}

static void ladder_init_dialog_class_init(LadderInitDialogClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_init_dialog_dispose;
	gtk_widget_class_install_action(widget, "init.apply", NULL, apply);
	gtk_widget_class_install_action(widget, "init.cancel", NULL, cancel);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_Escape, 0, "init.cancel", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_Return, GDK_CONTROL_MASK,
					    "init.apply", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_KP_Enter, GDK_CONTROL_MASK,
					    "init.apply", NULL);
}

static void ladder_init_dialog_init(LadderInitDialog *dialog)
{
	(void)dialog;
}

/* ---- the column of names ---- */

static void setup_name(GtkSignalListItemFactory *factory, GtkListItem *item)
{
	GtkWidget *expander = gtk_tree_expander_new(), *label = gtk_label_new(NULL);

	(void)factory;
	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	gtk_tree_expander_set_child(GTK_TREE_EXPANDER(expander), label);
	gtk_list_item_set_child(item, expander);
}

static void bind_name(GtkSignalListItemFactory *factory, GtkListItem *item,
		      struct dialog *dialog)
{
	GtkTreeExpander *expander = GTK_TREE_EXPANDER(gtk_list_item_get_child(item));
	GtkTreeListRow *row = gtk_tree_list_model_get_row(dialog->tree,
							  gtk_list_item_get_position(item));
	const LadderPanelRow *of = gtk_list_item_get_item(item);

	(void)factory;
	gtk_tree_expander_set_list_row(expander, row);
	gtk_label_set_text(GTK_LABEL(gtk_tree_expander_get_child(expander)),
			   panel_row_text(of, INIT_NAME));
	tip_set(GTK_WIDGET(expander), panel_row_text(of, INIT_NAME));
	spoken_name(expander, panel_row_text(of, INIT_NAME));
	g_clear_object(&row);
}

static void unbind_name(GtkSignalListItemFactory *factory, GtkListItem *item)
{
	(void)factory;
	list_drop_row(GTK_TREE_EXPANDER(gtk_list_item_get_child(item)));
}

static void add_columns(struct dialog *dialog)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	GListModel *columns;

	g_signal_connect(factory, "setup", G_CALLBACK(setup_name), NULL);
	g_signal_connect(factory, "bind", G_CALLBACK(bind_name), dialog);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind_name), NULL);
	panel_list_add(&dialog->list, field_name(INIT_NAME), INIT_NAME, PANEL_EXPAND, 0, factory);
	panel_list_column(&dialog->list, field_name(INIT_TYPE), INIT_TYPE, 0, 150);
	panel_list_column(&dialog->list, field_name(INIT_DEFAULT), INIT_DEFAULT, 0, 110);
	panel_cells_add(&dialog->list, &dialog->cells, INIT_VALUE, PANEL_EXPAND, 0);
	columns = gtk_column_view_get_columns(dialog->list.view);
	for (guint i = 0; i < g_list_model_get_n_items(columns); i++) {
		GtkColumnViewColumn *column = g_list_model_get_item(columns, i);

		gtk_column_view_column_set_sorter(column, NULL); /* a tree has its order */
		g_object_unref(column);
	}
}

/* ---- keys ---- */

/* Up and Down go to the value above and below. */
static gboolean key_pressed(struct dialog *dialog, guint key, guint code,
			    GdkModifierType state)
{
	const int by = key == GDK_KEY_Up ? -1 : key == GDK_KEY_Down ? 1 : 0;
	GListModel *rows = G_LIST_MODEL(dialog->list.selection);
	int field, at = (int)gtk_single_selection_get_selected(dialog->list.selection);

	(void)code;
	if (!by || state & gtk_accelerator_get_default_mod_mask() ||
	    !cells_focused(dialog->list.view, &field) || field != INIT_VALUE)
		return FALSE;
	/* before another row is selected, which would show the old text again */
	if (!cells_take(dialog->window))
		return TRUE;
	for (at += by; at >= 0 && at < (int)g_list_model_get_n_items(rows); at += by) {
		LadderPanelRow *row = g_list_model_get_item(rows, (guint)at);
		const bool parts = node_of(row)->parts;

		g_object_unref(row);
		if (parts)
			continue;
		gtk_single_selection_set_selected(dialog->list.selection, (guint)at);
		cells_enter(dialog->list.view, row, INIT_VALUE);
		break;
	}
	return TRUE;
}

/* The first value gets the keys. */
static void enter_first(struct dialog *dialog)
{
	GListModel *rows = G_LIST_MODEL(dialog->list.selection);

	for (guint i = 0; i < g_list_model_get_n_items(rows); i++) {
		LadderPanelRow *row = g_list_model_get_item(rows, i);
		const bool parts = node_of(row)->parts;

		g_object_unref(row);
		if (parts)
			continue;
		gtk_single_selection_set_selected(dialog->list.selection, i);
		cells_enter(dialog->list.view, row, INIT_VALUE);
		return;
	}
}

/* ---- making it ---- */

static GtkWidget *button_new(const char *label, const char *action, const char *class)
{
	GtkWidget *button = gtk_button_new_with_mnemonic(label);

	gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
	if (class)
		gtk_widget_add_css_class(button, class);
	return button;
}

static GtkWidget *label_new(const char *class)
{
	GtkWidget *label = gtk_label_new("");

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_wrap(GTK_LABEL(label), TRUE);
	gtk_label_set_wrap_mode(GTK_LABEL(label), PANGO_WRAP_WORD_CHAR);
	gtk_label_set_lines(GTK_LABEL(label), 2);
	gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	gtk_widget_add_css_class(label, class);
	return label;
}

static GtkWidget *list_new(struct dialog *dialog)
{
	GtkWidget *view = gtk_column_view_new(NULL), *scroller = gtk_scrolled_window_new();
	GListStore *root = g_list_store_new(LADDER_TYPE_PANEL_ROW);
	LadderPanelRow *row = row_new(dialog, init_form_root(dialog->form), NULL);
	GtkEventController *keys = gtk_event_controller_key_new();

	g_list_store_append(root, row);
	g_object_unref(row);
	dialog->root = G_LIST_MODEL(root);
	dialog->tree = gtk_tree_list_model_new(G_LIST_MODEL(root), TRUE, FALSE, parts_of, dialog,
					       NULL);
	unfold(dialog);
	dialog->list.view = GTK_COLUMN_VIEW(view);
	dialog->list.selection = gtk_single_selection_new(G_LIST_MODEL(dialog->tree));
	add_columns(dialog);
	gtk_column_view_set_model(dialog->list.view, GTK_SELECTION_MODEL(dialog->list.selection));
	g_object_unref(dialog->list.selection);
	gtk_widget_add_css_class(view, "data-table");
	spoken_name(view, _("Initial values"));
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect_swapped(keys, "key-pressed", G_CALLBACK(key_pressed), dialog);
	gtk_widget_add_controller(view, keys);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), view);
	gtk_widget_set_vexpand(scroller, TRUE);
	return scroller;
}

static void add_header(struct dialog *dialog)
{
	struct init_node *root = init_form_root(dialog->form);
	char *title = g_strdup_printf(_("Initial values of %s"), root->name);
	GtkWidget *bar = gtk_header_bar_new();

	gtk_header_bar_set_show_title_buttons(GTK_HEADER_BAR(bar), FALSE);
	gtk_header_bar_set_title_widget(GTK_HEADER_BAR(bar),
					adw_window_title_new(title, root->type));
	gtk_header_bar_pack_start(GTK_HEADER_BAR(bar),
				  button_new(_("_Cancel"), "init.cancel", NULL));
	gtk_header_bar_pack_end(GTK_HEADER_BAR(bar),
				button_new(_("_Set values"), "init.apply", "suggested-action"));
	gtk_window_set_title(dialog->window, title);
	gtk_window_set_titlebar(dialog->window, bar);
	g_free(title);
}

static void add_content(struct dialog *dialog)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	GtkWidget *foot = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);

	dialog->text = label_new("monospace");
	dialog->why = label_new("error");
	spoken_text(GTK_LABEL(dialog->why));
	gtk_widget_set_margin_start(foot, 12);
	gtk_widget_set_margin_end(foot, 12);
	gtk_widget_set_margin_top(foot, 9);
	gtk_widget_set_margin_bottom(foot, 9);
	gtk_box_append(GTK_BOX(foot), dialog->text);
	gtk_box_append(GTK_BOX(foot), dialog->why);
	gtk_box_append(GTK_BOX(box), list_new(dialog));
	gtk_box_append(GTK_BOX(box), foot);
	gtk_window_set_child(dialog->window, box);
	show_text(dialog);
}

void init_dialog_open(GtkWidget *from, LadderDocument *document, int table, const char *name)
{
	struct dialog *dialog = g_new0(struct dialog, 1);
	GtkRoot *root = gtk_widget_get_root(from);
	char *why = NULL;

	dialog->document = g_object_ref(document);
	dialog->owner = symbol_table_name(document, table);
	dialog->name = g_strdup(name);
	dialog->form = init_form_new(document, table, symbol_find(document, table, name, -1), &why);
	if (!dialog->form) {
		gtk_widget_activate_action(from, "win.tell", "s", why);
		g_free(why);
		dialog_free(dialog);
		return;
	}
	g_set_weak_pointer(&dialog->from, from);
	dialog->window = g_object_new(LADDER_TYPE_INIT_DIALOG, "modal", TRUE, "default-width", 720,
		"default-height", 520, "transient-for", root, NULL);
	g_object_set_data_full(G_OBJECT(dialog->window), "dialog", dialog, dialog_free);
	dialog->cells = (struct panel_cells){ .owner = G_OBJECT(dialog->window),
		.name = field_name, .set = set_value, .is_fixed = is_fixed, .keeps = true };
	add_header(dialog);
	add_content(dialog);
	spoken_parts(GTK_WIDGET(dialog->window));
	gtk_window_present(dialog->window);
	enter_first(dialog);
}
