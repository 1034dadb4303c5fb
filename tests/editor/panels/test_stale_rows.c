/* SPDX-License-Identifier: MIT
 *
 * test_stale_rows - the symbol table is updated with a delay after a change: text typed
 * into a row goes to the declaration that the row shows, or is refused; so does a type from the
 * form of an array. The form of initial values and the chosen scope keep their POU when
 * another one is new before it.
 */
#include "editor-gtk/document/symbols.h"
#include "editor-gtk/panels/init_dialog.h"
#include "editor-gtk/panels/symbols_view.h"
#include "editor-gtk/panels/type_cells.h"
#include "tests/editor/panel_list.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/editor/texts.h"
#include "tests/tap.h"

#include <adwaita.h>

static const char sample[] =
	"RUNGBOARD 1\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL;\n  Spare : INT;\nEND_VAR\n\n"
	"VAR RETAIN\n  Hours : UDINT;\nEND_VAR\n\n"
	"PROGRAM Main LD\nVAR\n  Set : ARRAY[1..2] OF INT;\nEND_VAR\nRUNG\n  | NO Start | COIL %QX0.4 |\nEND_PROGRAM\n";

static LadderDocument *document;

static GtkWidget *cell_with(GtkWidget *from, const char *text)
{
	GtkWidget *cell = NULL;

	if (GTK_IS_ENTRY(from) && !strcmp(gtk_editable_get_text(GTK_EDITABLE(from)), text))
		return from;
	for (GtkWidget *child = gtk_widget_get_first_child(from); child && !cell;
	     child = gtk_widget_get_next_sibling(child))
		cell = cell_with(child, text);
	return cell;
}

static void type_into(GtkWidget *cell, const char *name)
{
	gtk_editable_set_text(GTK_EDITABLE(cell), name);
	g_signal_emit_by_name(cell, "activate");
}

static void undo_all(void)
{
	while (ladder_document_undo(document))
		;
	panel_settle();
}

static void test_moved(GtkWidget *cell)
{
	char *why = NULL;

	CHECK(symbol_set(document, 0, 0, FIELD_RETAIN, "1", &why));
	type_into(cell, "Stock");
	CHECK_AS(document_has(document, "Stock : INT;") && !document_has(document, "Spare"),
		 "a row changes its own declaration after that moved");
	type_into(cell, "Spare");
	CHECK_AS(document_has(document, "Spare : INT;") && !document_has(document, "Stock"),
		 "a row finds its declaration by the new name");
	undo_all();
}

static void test_gone(LadderSymbolsView *view, GtkWidget *cell)
{
	char *why = NULL;

	CHECK(symbol_delete(document, 0, 1, &why) && !document_has(document, "Spare"));
	type_into(cell, "Stock");
	CHECK_AS(!document_has(document, "Stock") && gtk_widget_has_css_class(cell, "error"),
		 "a row of a deleted symbol changes no other one");
	CHECK_TEXT(panel_text(view, "message"), "Spare, Name: There is no such symbol");
	undo_all();
}

/* Opens the form of an array at the row of @name; returns the entry of its last index. */
static GtkWidget *open_array(LadderSymbolsView *view, const char *name, GtkWidget **cell)
{
	LadderPanelRow *row = ladder_panel_row_new();

	*cell = cell_with(GTK_WIDGET(view), "INT");
	row->text[FIELD_NAME] = g_strdup(name);
	row->text[FIELD_TYPE] = g_strdup("INT");
	gtk_widget_grab_focus(*cell);
	type_cells_open(document, row, FIELD_TYPE, *cell);
	g_object_unref(row);
	return cell_with(*cell, "9");
}

static bool has_focus(GtkWidget *cell)
{
	GtkWidget *focus = gtk_root_get_focus(gtk_widget_get_root(cell));

	return focus && (focus == cell || gtk_widget_is_ancestor(focus, cell));
}

static void test_array(LadderSymbolsView *view)
{
	GtkWidget *cell, *last = open_array(view, "Spare", &cell);

	CHECK(last);
	gtk_popover_popdown(GTK_POPOVER(gtk_widget_get_ancestor(last, GTK_TYPE_POPOVER)));
	/* The form of an array gives the focus back when it closes. */
	CHECK_SOON(has_focus(cell) && !cell_with(cell, "9"));
	last = open_array(view, "Other", &cell);
	g_signal_emit_by_name(last, "activate");
	CHECK_AS(!document_has(document, "Spare : ARRAY"), "the form of an array changes no row that came to its place");
	turn(0);
}

static GtkWidget *open_dialog(LadderSymbolsView *view)
{
	GListModel *windows = gtk_window_get_toplevels();
	GtkWidget *dialog = NULL;

	init_dialog_open(GTK_WIDGET(view), document, 1, "Set");
	for (guint i = 0; i < g_list_model_get_n_items(windows); i++) {
		GtkWidget *window = g_list_model_get_item(windows, i);

		dialog = gtk_window_get_modal(GTK_WINDOW(window)) ? window : dialog;
		g_object_unref(window);
	}
	return dialog;
}

static GtkWidget *focused_entry(void)
{
	GListModel *windows = gtk_window_get_toplevels();
	GtkWindow *window = g_list_model_get_item(windows, 0);
	GtkWidget *focus = gtk_window_get_focus(window);

	g_object_unref(window);
	return focus ? gtk_widget_get_ancestor(focus, GTK_TYPE_ENTRY) : NULL;
}

/* Half of a name is typed when another symbol comes, by an undo or a check: the cell keeps it and the keys. */
static void test_typing(LadderSymbolsView *view)
{
	GtkWidget *cell;
	char *why = NULL;
	bool good;

	CHECK(symbol_delete(document, 0, 0, &why));
	panel_settle();
	cell = cell_with(GTK_WIDGET(view), "Spare");
	gtk_widget_grab_focus(cell);
	gtk_editable_set_text(GTK_EDITABLE(cell), "Sto");
	gtk_editable_set_position(GTK_EDITABLE(cell), 2);
	CHECK(ladder_document_undo(document));
	panel_settle();
	turn(0);
	WAIT((cell = focused_entry()) && !strcmp(gtk_editable_get_text(GTK_EDITABLE(cell)), "Sto"));
	good = cell && !strcmp(gtk_editable_get_text(GTK_EDITABLE(cell)), "Sto") &&
	       gtk_editable_get_position(GTK_EDITABLE(cell)) == 2 &&
	       !gtk_editable_get_selection_bounds(GTK_EDITABLE(cell), NULL, NULL);
	CHECK_AS(good && !document_has(document, "Sto :"), "the text stands in the cell that has the keys");
	if (cell)
		type_into(cell, "Stock");
	CHECK_AS(document_has(document, "Stock : INT;") && !document_has(document, "Spare"), "it goes to its declaration");
	undo_all();
}

/* Another program adds a POU before Main, whose variable has the name, too. */
static void test_new_pou(LadderSymbolsView *view)
{
	const char *before = strstr(sample, "PROGRAM Main");
	char *with = g_strdup_printf("%.*sPROGRAM First LD\nVAR\n  Set : ARRAY[1..2] OF INT;\n"
				     "END_VAR\nRUNG\n  | NO Start | COIL %%QX0.5 |\n"
				     "END_PROGRAM\n\n%s", (int)(before - sample), sample, before);
	GtkWidget *scopes = gtk_widget_get_first_child(gtk_widget_get_first_child(
		gtk_widget_get_first_child(GTK_WIDGET(view))));
	GtkWidget *dialog, *cell = NULL;

	gtk_drop_down_set_selected(GTK_DROP_DOWN(scopes), 2); /* Main */
	dialog = open_dialog(view);
	WAIT((cell = dialog ? gtk_window_get_focus(GTK_WINDOW(dialog)) : NULL) != NULL &&
	     GTK_IS_TEXT(cell));
	CHECK(cell);
	ladder_document_open_text(document, "/tmp/x/test.rung", with, strlen(with), true);
	panel_settle();
	CHECK_AS(gtk_drop_down_get_selected(GTK_DROP_DOWN(scopes)) == 3,
		 "the scope stays that of Main");
	gtk_editable_set_text(GTK_EDITABLE(cell), "7");
	gtk_widget_activate_action(dialog, "init.apply", NULL);
	turn(0);
	CHECK_AS(document_has(document, "Set : ARRAY[1..2] OF INT := [7, 0];") || document_has(document, "Set : ARRAY[1..2] OF INT := [7];"),
		 "values are set");
	CHECK_AS(document_has(document, "PROGRAM First LD\nVAR\n  Set : ARRAY[1..2] OF INT;"),
		 "and not those of another POU");
	gtk_drop_down_set_selected(GTK_DROP_DOWN(scopes), 0);
	g_free(with);
}

int main(void)
{
	LadderSymbolsView *view;
	GtkWidget *window, *cell;
	char *text;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	document = ladder_document_new();
	ladder_document_open_text(document, "/tmp/x/test.rung", sample, strlen(sample), true);
	text = ladder_document_text(document, NULL);
	window = gtk_window_new();
	view = LADDER_SYMBOLS_VIEW(ladder_symbols_view_new());
	ladder_symbols_view_set_document(view, document);
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(view));
	screen_show(window);
	WAIT((cell = cell_with(GTK_WIDGET(view), "Spare")) != NULL);
	CHECK(cell);
	if (cell) {
		test_typing(view);
		WAIT((cell = cell_with(GTK_WIDGET(view), "Spare")) != NULL);
		test_moved(cell);
		test_gone(view, cell);
		test_array(view);
	}
	CHECK_AS(document_has(document, text), "an undo restores the text");
	test_new_pou(view);
	g_free(text);
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
