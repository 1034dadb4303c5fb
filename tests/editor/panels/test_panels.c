/* SPDX-License-Identifier: MIT
 *
 * test_panels - the panels with lists, in a window: what they show, where they go, what an
 * edit in them does.
 *
 * PANEL_PICTURES=FOLDER saves pictures of them.
 */
#include "editor-gtk/panels/find_bar.h"
#include "editor-gtk/panels/import_dialog.h"
#include "editor-gtk/kit/panel_row.h"
#include "editor-gtk/panels/project_tree.h"
#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/panels/problems.h"
#include "editor-gtk/panels/symbols_view.h"
#include "editor-gtk/panels/tree_rows.h"
#include "editor-gtk/panels/uses_view.h"
#include "tests/editor/keys.h"
#include "tests/editor/saved.h"
#include "tests/editor/panel_list.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <adwaita.h>

static const char sample[] =
	"RUNGBOARD 1\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL; (* \xe5\x90\xaf\xe5\x8a\xa8\xe6\x8c\x89\xe9\x92\xae *)\n"
	"  \xe7\x94\xb5\xe6\x9c\xba AT %QX0.0 : BOOL; (* \xe4\xb8\xbb\xe7\x94\xb5\xe6\x9c\xba *)\n"
	"  Spare : INT;\n  Wide AT %QW0 : WORD;\n  Bad AT %QX9.0 : INT;\nEND_VAR\n\n"
	"VAR RETAIN\n  Hours : UDINT;\nEND_VAR\n\n"
	"PROGRAM Main LD\nVAR\n  Delay : TON;\nEND_VAR\n"
	"RUNG \"\xe7\x94\xb5\xe6\x9c\xba\"\n  | NO Start | COIL \xe7\x94\xb5\xe6\x9c\xba |\n"
	"RUNG\n  | NO \xe7\x94\xb5\xe6\x9c\xba | TON Delay PT:=T#1s | COIL %QX0.3 |\n"
	"RUNG\n  | NO Nobody | COIL %QX0.4 |\nEND_PROGRAM\n\n"
	"PROGRAM List IL\n  LD    Start\n  ST    Lost\nEND_PROGRAM\n";

static GtkWidget *window;
static LadderDocument *document;
static char gone_to[64];

/* ---- the window ---- */

static void go_to(GSimpleAction *action, GVariant *place, gpointer unused)
{
	int at[4];

	(void)action;
	(void)unused;
	g_variant_get(place, "(iiii)", &at[0], &at[1], &at[2], &at[3]);
	g_snprintf(gone_to, sizeof(gone_to), "%d %d %d %d", at[0], at[1], at[2], at[3]);
}

static void put(GtkWidget *child)
{
	gtk_window_set_child(GTK_WINDOW(window), child);
	if (child)
		screen_show(window);
	turn(0);
}

static void make_window(void)
{
	GSimpleActionGroup *group = g_simple_action_group_new();
	GSimpleAction *action = g_simple_action_new("go-to", G_VARIANT_TYPE("(iiii)"));

	g_signal_connect(action, "activate", G_CALLBACK(go_to), NULL);
	g_action_map_add_action(G_ACTION_MAP(group), G_ACTION(action));
	window = gtk_window_new();
	gtk_window_set_default_size(GTK_WINDOW(window), 1000, 340);
	gtk_widget_insert_action_group(window, "win", G_ACTION_GROUP(group));
	g_object_unref(action);
	g_object_unref(group);
}

static void reopen(const char *text)
{
	ladder_document_open_text(document, "/tmp/x/test.rung", text, strlen(text), true);
	ladder_document_check_now(document);
}

static bool has(const char *part)
{
	char *text = ladder_document_text(document, NULL);
	bool found = strstr(text, part);

	if (!found)
		printf("# %s\n", text);
	g_free(text);
	return found;
}

/* ---- lists ---- */

static char *texts_of(GListModel *list, guint at)
{
	LadderPanelRow *row = g_list_model_get_item(list, at);
	GString *out = g_string_new("");

	if (!row)
		return g_string_free(out, FALSE);
	for (int i = 0; i < PANEL_TEXTS; i++)
		if (row->text[i])
			g_string_append_printf(out, "%s|", row->text[i]);
	CHECK(row->spoken && *row->spoken);
	g_object_unref(row);
	return g_string_free(out, FALSE);
}

static void is_row(GListModel *list, guint at, const char *want)
{
	char *got = texts_of(list, at);

	CHECK_TEXT(got, want);
	g_free(got);
}

static GtkWidget *find_widget(GtkWidget *from, GType type, int *nth)
{
	if (G_TYPE_CHECK_INSTANCE_TYPE(from, type) && (*nth)-- == 0)
		return from;
	for (GtkWidget *child = gtk_widget_get_first_child(from); child;
	     child = gtk_widget_get_next_sibling(child)) {
		GtkWidget *found = find_widget(child, type, nth);

		if (found)
			return found;
	}
	return NULL;
}

static GtkWidget *nth_widget(GtkWidget *from, GType type, int nth)
{
	return find_widget(from, type, &nth);
}

/* The first one is inside the drop-down. */
static GtkWidget *search_of(GtkWidget *from)
{
	return nth_widget(from, GTK_TYPE_SEARCH_ENTRY, 1);
}

/* ---- problems ---- */

/* Errors stand before warnings, each kind by its place. */
static void check_order(GListModel *list)
{
	const guint count = g_list_model_get_n_items(list);
	LadderPanelRow *before = NULL;
	bool good = true;

	for (guint i = 0; i < count; i++) {
		LadderPanelRow *row = g_list_model_get_item(list, i);

		if (before && before->tone == row->tone)
			good = good && before->number <= row->number;
		else if (before)
			good = good && before->tone == PANEL_ERROR;
		g_clear_object(&before);
		before = row;
	}
	g_clear_object(&before);
	CHECK_AS(good, "errors stand before warnings, each kind by its place");
}

static void test_problems(void)
{
	LadderProblems *problems = LADDER_PROBLEMS(ladder_problems_new());
	GListModel *list = panel_items(problems);
	const char *title;

	ladder_problems_set_document(problems, document);
	put(GTK_WIDGET(problems));
	const guint count = g_list_model_get_n_items(list);

	for (guint i = 0; i < count; i++) {
		char *text = texts_of(list, i);

		printf("# %s\n", text);
		g_free(text);
	}
	CHECK(count >= 3 && ladder_problems_count(problems, false) == (int)count);
	CHECK(ladder_problems_count(problems, true) >= 2);
	title = ladder_problems_title(problems);
	CHECK(g_str_has_prefix(title, "Problems ") && title[9] == (char)('0' + count));
	save_pictures(GTK_WIDGET(problems), "PANEL_PICTURES", "problems");
	for (guint i = 0; i < count; i++) {
		LadderPanelRow *row = g_list_model_get_item(list, i);

		if (row->rung == 2) {
			g_signal_emit_by_name(panel_part(GTK_WIDGET(problems), "view"), "activate",
					      i);
			CHECK_TEXT(gone_to, "0 2 0 0");
			CHECK_TEXT(row->text[1], "Main, rung 3, row 1, column A");
		}
		if (strstr(row->text[0], "Hours")) {
			g_signal_emit_by_name(panel_part(GTK_WIDGET(problems), "view"), "activate",
					      i);
			CHECK_TEXT(gone_to, "-1 -1 0 5");
		}
		if (row->pou == 1) {
			g_signal_emit_by_name(panel_part(GTK_WIDGET(problems), "view"), "activate",
					      i);
			CHECK_TEXT(gone_to, "1 -1 2 8");
		}
		g_object_unref(row);
	}
	check_order(list);
	is_row(list, 2, "\"Lost\" is not declared|List, line 3|LD301|Error|");
	CHECK(ladder_problems_next(problems, false));
	CHECK(ladder_problems_next(problems, true));
	CHECK(ladder_problems_show_error(problems));
	CHECK_TEXT(gone_to, "-1 -1 0 4");
	reopen("RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO I0 | COIL Q0 |\nEND_PROGRAM\n");
	CHECK_SOON(g_list_model_get_n_items(list) == 0);
	CHECK(!ladder_problems_next(problems, false) && !ladder_problems_show_error(problems));
	CHECK_TEXT(ladder_problems_title(problems), "Problems");
	reopen("RUNGBOARD 1\nPROGRAM Main LD\nRUNG\n  | NO\n");
	CHECK_AS(ladder_problems_count(problems, true) > 0,
		 "a text that cannot be read has problems");
	is_row(list, 0, "\"PROGRAM\" is not closed before the end of the file; its END_… is "
	       "missing|line 2|LD109|Error|");
	reopen(sample);
	ladder_problems_set_document(problems, NULL);
	CHECK(ladder_problems_count(problems, false) == 0);
	put(NULL);
}

/* ---- uses ---- */

static void test_uses(void)
{
	LadderUsesView *view = LADDER_USES_VIEW(ladder_uses_view_new());
	GListModel *list = panel_items(view);
	guint all;

	ladder_uses_view_set_document(view, document);
	put(GTK_WIDGET(view));
	CHECK(g_list_model_get_n_items(list) == 0);
	ladder_uses_view_set_symbol(view, 0, "Start");
	panel_settle();
	CHECK(g_list_model_get_n_items(list) == 3);
	is_row(list, 0, "Start|%IX0.0|declared|declarations||");
	is_row(list, 1, "Start|%IX0.0|read|Main, rung 1, row 1, column A|Start|");
	is_row(list, 2, "Start|%IX0.0|read|List, line 2|Start|");
	g_signal_emit_by_name(panel_part(GTK_WIDGET(view), "view"), "activate", 1);
	CHECK_TEXT(gone_to, "0 0 0 0");
	g_signal_emit_by_name(panel_part(GTK_WIDGET(view), "view"), "activate", 2);
	CHECK_TEXT(gone_to, "1 -1 1 8");
	g_signal_emit_by_name(panel_part(GTK_WIDGET(view), "view"), "activate", 0);
	CHECK_TEXT(gone_to, "-1 -1 0 0");
	ladder_uses_view_set_symbol(view, 0, "%QX0.4");
	panel_settle();
	is_row(list, 1, "%QX0.4|%QX0.4|coil|Main, rung 3, row 1, column F|%QX0.4|");
	ladder_uses_view_set_symbol(view, 0, "Delay.Q");
	panel_settle();
	CHECK(g_list_model_get_n_items(list) == 2);
	ladder_uses_view_set_symbol(view, -1, "Main.Delay");
	panel_settle();
	CHECK(g_list_model_get_n_items(list) == 2);
	ladder_uses_view_set_symbol(view, 0, "%QX0.0");
	panel_settle();
	CHECK_AS(g_list_model_get_n_items(list) == 4,
		 "an address lists the uses that overlap it");
	ladder_uses_view_set_symbol(view, 0, "1 +");
	panel_settle();
	CHECK(g_list_model_get_n_items(list) == 0);
	ladder_uses_view_set_mode(view, USES_ALL);
	all = g_list_model_get_n_items(list);
	CHECK(all > 12);
	save_pictures(GTK_WIDGET(view), "PANEL_PICTURES", "uses");
	gtk_editable_set_text(GTK_EDITABLE(search_of(GTK_WIDGET(view))), "\xe7\x94\xb5");
	CHECK_SOON(g_list_model_get_n_items(list) == 3);
	gtk_editable_set_text(GTK_EDITABLE(search_of(GTK_WIDGET(view))), "");
	WAIT(g_list_model_get_n_items(list) == all);
	ladder_uses_view_set_mode(view, USES_UNUSED);
	for (guint i = 0; i < g_list_model_get_n_items(list); i++) {
		char *text = texts_of(list, i);

		printf("# unused %s\n", text);
		g_free(text);
	}
	is_row(list, 0, "Spare||declared|declarations||");
	ladder_uses_view_set_mode(view, USES_DOUBLE);
	for (guint i = 0; i < g_list_model_get_n_items(list); i++) {
		char *text = texts_of(list, i);

		printf("# double %s\n", text);
		g_free(text);
	}
	CHECK(g_list_model_get_n_items(list) == 3);
	is_row(list, 0, "Wide|%QW0|declared|declarations|also used as "
	       "\xe7\x94\xb5\xe6\x9c\xba (%QX0.0)|");
	ladder_uses_view_set_mode(view, USES_ALL);
	ladder_document_put_list(document, 1,
		"PROGRAM List IL\n  LD I0\n  ST Q1\n  ST Q2\n  ST Q3\nEND_PROGRAM\n");
	WAIT(g_list_model_get_n_items(list) != all);
	CHECK_AS(g_list_model_get_n_items(list) != all,
		 "a change of the document updates the hits");
	ladder_document_undo(document);
	CHECK_SOON(g_list_model_get_n_items(list) == all);
	put(NULL);
}

/* ---- symbols ---- */

/* The cell for a field of the row at @at, as it is shown. */
static GtkWidget *cell_of(GtkWidget *view, GType type, const char *text)
{
	for (int i = 0;; i++) {
		GtkWidget *cell = nth_widget(view, type, i);

		if (!cell || strcmp(gtk_editable_get_text(GTK_EDITABLE(cell)), text) == 0)
			return cell;
	}
}

static void type_into(GtkWidget *cell, const char *text)
{
	CHECK(cell);
	if (!cell)
		return;
	gtk_widget_grab_focus(cell);
	gtk_editable_set_text(GTK_EDITABLE(cell), text);
	g_signal_emit_by_name(cell, "activate");
	panel_settle();
	CHECK_AS(keys_arrive(window), "a key right after an edit is not lost");
	CHECK_SOON(gtk_root_get_focus(GTK_ROOT(window))); /* in the table again */
}

static guint row_named(GListModel *list, const char *name)
{
	for (guint i = 0; i < g_list_model_get_n_items(list); i++) {
		LadderPanelRow *row = g_list_model_get_item(list, i);
		bool found = strcmp(row->text[0], name) == 0;

		g_object_unref(row);
		if (found)
			return i;
	}
	return GTK_INVALID_LIST_POSITION;
}

static void test_symbols(void)
{
	LadderSymbolsView *view = LADDER_SYMBOLS_VIEW(ladder_symbols_view_new());
	GtkWidget *widget = GTK_WIDGET(view), *cell;
	GListModel *list = panel_items(view);
	LadderPanelRow *row;

	ladder_symbols_view_set_document(view, document);
	put(widget);
	CHECK(g_list_model_get_n_items(list) == 7);
	is_row(list, 1, "\xe7\x94\xb5\xe6\x9c\xba|BOOL|%QX0.0||||"
	       "\xe4\xb8\xbb\xe7\x94\xb5\xe6\x9c\xba|global|2||");
	row = g_list_model_get_item(list, row_named(list, "Bad"));
	CHECK_AS(row->note && row->tone == PANEL_ERROR,
		 "the reason of a refused field is shown");
	g_object_unref(row);
	save_pictures(widget, "PANEL_PICTURES", "symbols");
	type_into(cell_of(widget, GTK_TYPE_ENTRY, "Spare"), "Stock");
	CHECK(has("  Stock           : INT;") || has("  Stock : INT;") || has("  Stock   : INT;"));
	CHECK_TEXT(panel_text(view, "message"), "");
	type_into(cell_of(widget, GTK_TYPE_ENTRY, "Start"), "\xe5\x90\xaf\xe5\x8a\xa8");
	CHECK(has("| NO \xe5\x90\xaf\xe5\x8a\xa8 |"));
	ladder_document_check_now(document); /* an unused symbol: its row changes */
	panel_settle();
	WAIT((cell = cell_of(widget, GTK_TYPE_ENTRY, "Stock")) != NULL);
	type_into(cell, "Hours");
	CHECK_AS(gtk_widget_has_css_class(cell, "error") &&
		 strstr(panel_text(view, "message"), "Hours"),
		 "the reason of a refused name is reported");
	save_pictures(widget, "PANEL_PICTURES", "symbols-refused");
	CHECK(gtk_entry_get_icon_name(GTK_ENTRY(cell), GTK_ENTRY_ICON_SECONDARY));
	type_into(cell, "Stock");
	CHECK(!gtk_widget_has_css_class(cell, "error") &&
	      !gtk_entry_get_icon_name(GTK_ENTRY(cell), GTK_ENTRY_ICON_SECONDARY));
	cell = nth_widget(widget, GTK_TYPE_CHECK_BUTTON, 0);
	gtk_check_button_set_active(GTK_CHECK_BUTTON(cell), TRUE);
	CHECK(has("VAR RETAIN\n  Hours : UDINT;\n  \xe5\x90\xaf\xe5\x8a\xa8  AT %IX0.0 : BOOL;"));
	while (ladder_document_undo(document))
		;
	CHECK(ladder_symbols_view_show(view, 0, 2));
	gtk_widget_activate_action(widget, "symbols.add", NULL);
	CHECK(has("  Spare2 : INT;"));
	CHECK_TEXT(ladder_document_undo_name(document), "Add symbol");
	gtk_widget_activate_action(widget, "symbols.delete", NULL);
	CHECK(!has("Spare2"));
	CHECK(!ladder_symbols_view_show(view, 0, 99));
	gtk_editable_set_text(GTK_EDITABLE(search_of(widget)), "qx0");
	WAIT(g_list_model_get_n_items(list) == 1);
	CHECK_AS(g_list_model_get_n_items(list) == 1, "filtered");
	gtk_editable_set_text(GTK_EDITABLE(search_of(widget)), "");
	CHECK_SOON(g_list_model_get_n_items(list) == 7);
	while (ladder_document_undo(document))
		;
	put(NULL);
}

static void test_import(void)
{
	static const char table[] = "Name,Type,Address,Comment\r\nStart,BOOL,%IX0.5,go\r\n"
		"\xe9\x98\x80,BOOL,%QX1.0,\xe9\x98\x80\xe9\x97\xa8\r\n9,INT,,\r\n";
	LadderSymbolsView *view = LADDER_SYMBOLS_VIEW(ladder_symbols_view_new());
	GtkWidget *dialog;

	ladder_symbols_view_set_document(view, document);
	put(GTK_WIDGET(view));
	dialog = ladder_symbols_view_import(view, "table.csv", table, strlen(table));
	turn(200);
	CHECK(LADDER_IS_IMPORT_DIALOG(dialog));
	save_pictures(dialog, "PANEL_PICTURES", "import");
	gtk_widget_activate_action(dialog, "import.cancel", NULL);
	turn(50);
	CHECK(!ladder_document_undo_name(document));
	dialog = ladder_symbols_view_import(view, "table.csv", table, strlen(table));
	gtk_widget_activate_action(dialog, "import.apply", NULL);
	CHECK(has("AT %IX0.5 : BOOL; (* go *)") && has("\xe9\x98\x80    AT %QX1.0"));
	CHECK_TEXT(ladder_document_undo_name(document), "Import symbols");
	ladder_document_undo(document);
	put(NULL);
}

/* ---- find ---- */

static int told_hits, told_closed;

static void count(LadderFindBar *bar, int *told)
{
	(void)bar;
	++*told;
}

static void test_find(void)
{
	LadderFindBar *bar = LADDER_FIND_BAR(ladder_find_bar_new());
	GtkWidget *widget = GTK_WIDGET(bar);
	GtkEditable *with;

	ladder_find_bar_set_document(bar, document);
	g_signal_connect(bar, "hits-changed", G_CALLBACK(count), &told_hits);
	g_signal_connect(bar, "closed", G_CALLBACK(count), &told_closed);
	put(widget);
	CHECK(!ladder_find_bar_is_open(bar) && !ladder_find_bar_next(bar, false));
	ladder_find_bar_open(bar, true, "\xe7\x94\xb5\xe6\x9c\xba");
	CHECK_AS(gtk_widget_get_mapped(nth_widget(widget, GTK_TYPE_TEXT, 0)),
		 "a letter right after the click is not lost");
	CHECK(told_hits > 0 && ladder_find_bar_find(bar)->hit->len == 5);
	CHECK_TEXT(panel_text(bar, "message"), "5 hits");
	ladder_find_bar_set_place(bar, 0, 0, 0, 0);
	CHECK(ladder_find_bar_next(bar, false));
	CHECK_TEXT(gone_to, "0 0 0 1");
	CHECK_TEXT(panel_text(bar, "message"), "4 of 5");
	gtk_widget_activate_action(widget, "find.previous", NULL);
	CHECK_TEXT(gone_to, "0 0 -1 -1");
	save_pictures(widget, "PANEL_PICTURES", "find");
	with = GTK_EDITABLE(nth_widget(widget, GTK_TYPE_ENTRY, 1));
	gtk_editable_set_text(with, "\xe6\xb3\xb5");
	gtk_widget_activate_action(widget, "find.replace", NULL);
	CHECK(has("RUNG \"\xe6\xb3\xb5\""));
	CHECK_TEXT(gone_to, "0 0 0 1");
	gtk_widget_activate_action(widget, "find.replace-all", NULL);
	CHECK_TEXT(panel_text(bar, "message"), "4 replaced");
	CHECK(!strstr(gtk_editable_get_text(with), "\xe7\x94\xb5"));
	ladder_document_undo(document);
	ladder_document_undo(document);
	WAIT(ladder_find_bar_find(bar)->hit->len == 5);
	gtk_editable_set_text(with, "a | b");
	gtk_widget_activate_action(widget, "find.replace-all", NULL);
	CHECK_AS(strstr(panel_text(bar, "message"), ":") && !ladder_document_undo_name(document),
		 "the reason of a refused replacement is reported");
	ladder_find_bar_open(bar, false, "Start");
	ladder_find_bar_close(bar);
	ladder_find_bar_set_place(bar, 0, 0, 0, 0);
	CHECK_AS(ladder_find_bar_next(bar, false), "F3 works while the bar is closed");
	CHECK_TEXT(gone_to, "1 -1 1 8");
	told_closed = 0;
	ladder_find_bar_open(bar, false, "nothing at all");
	CHECK_TEXT(panel_text(bar, "message"), "Nothing found");
	gtk_widget_activate_action(widget, "find.close", NULL);
	CHECK(told_closed == 1 && !ladder_find_bar_is_open(bar) && !ladder_find_bar_find(bar));
	WAIT(G_OBJECT(bar)->ref_count == 1); /* after the window has released the focus */
	put(NULL);
}

/* ---- the tree ---- */

static guint rows_of(GtkWidget *list)
{
	return g_list_model_get_n_items(G_LIST_MODEL(
		gtk_list_view_get_model(GTK_LIST_VIEW(list))));
}

static bool has_focus(GtkWidget *widget)
{
	GtkWidget *focus = gtk_root_get_focus(GTK_ROOT(window));

	return focus && gtk_widget_is_ancestor(focus, widget);
}

static GtkTreeListRow *tree_row(GtkWidget *list, guint at)
{
	GtkTreeListRow *row = g_list_model_get_item(G_LIST_MODEL(
		gtk_list_view_get_model(GTK_LIST_VIEW(list))), at);

	g_object_unref(row); /* the list has a reference */
	return row;
}

static const char *note_of(GtkWidget *list, guint at)
{
	LadderTreeRow *row = gtk_tree_list_row_get_item(tree_row(list, at));

	g_object_unref(row); /* the list has a reference */
	return row->note;
}

/* Rows stay expanded or collapsed when one of their children changes. */
static void test_tree_stays(GtkWidget *list)
{
	const guint rows = rows_of(list);
	GtkTreeListRow *main = tree_row(list, 1);

	CHECK_TEXT(note_of(list, 1), "3 rungs");
	gtk_tree_list_row_set_expanded(main, TRUE);
	CHECK(rows_of(list) == rows + 1);
	CHECK(ladder_document_splice(document, 0, 0, 1, NULL, 0, NULL));
	CHECK_SOON(strcmp(note_of(list, 1), "2 rungs") == 0);
	CHECK(tree_row(list, 1) == main && gtk_tree_list_row_get_expanded(main));
	CHECK(ladder_document_declare(document, 0, "Later", "TON", "", NULL));
	CHECK_SOON(rows_of(list) == rows + 2);
	CHECK(tree_row(list, 1) == main);
	gtk_tree_list_row_set_expanded(tree_row(list, 0), FALSE);
	WAIT(rows_of(list) == rows - 2);
	CHECK(ladder_document_undo(document) && ladder_document_undo(document));
	CHECK(rows_of(list) == rows - 2);
	gtk_tree_list_row_set_expanded(tree_row(list, 0), TRUE);
	CHECK(rows_of(list) == rows);
	CHECK_SOON(strcmp(note_of(list, 1), "3 rungs") == 0);
}

/* A tooltip, which a screen reader says too, does not repeat the label that it is of. */
static void test_no_repeat(GtkWidget *list)
{
	GtkWidget *label;
	int labels = 0, repeated = 0;

	for (; (label = nth_widget(list, GTK_TYPE_LABEL, labels)); labels++) {
		const char *text = gtk_label_get_text(GTK_LABEL(label));
		char *differs = gtk_test_accessible_check_property(
			GTK_ACCESSIBLE(label), GTK_ACCESSIBLE_PROPERTY_DESCRIPTION, text,
			NULL);

		repeated += *text && !differs; /* tip_set() makes it the description */
		g_free(differs);
	}
	CHECK(labels > 3 && repeated == 0);
}

/* When a program is deleted, the rows of all others change. */
static void test_tree(void)
{
	GtkWidget *tree = ladder_project_tree_new(document);
	GtkWidget *list;
	guint rows;

	put(tree);
	list = nth_widget(tree, GTK_TYPE_LIST_VIEW, 0);
	rows = rows_of(list);
	test_tree_stays(list);
	test_no_repeat(list);
	CHECK(rows > 3 && gtk_widget_grab_focus(list) && keys_arrive(window));
	CHECK(!pou_delete(document, 1));
	WAIT(rows_of(list) != rows);
	CHECK_AS(keys_arrive(window), "a key right after an edit is not lost");
	CHECK(rows_of(list) == rows - 1);
	CHECK_SOON(has_focus(list));
	CHECK(ladder_document_undo(document));
	CHECK_SOON(rows_of(list) == rows);
	CHECK(gtk_widget_grab_focus(list));
	reopen("RUNGBOARD 9\n");
	WAIT(rows_of(list) == 0);
	CHECK_AS(rows_of(list) == 0 && keys_arrive(window),
		 "a key is not lost when all rows are removed");
	reopen(sample);
	CHECK_SOON(rows_of(list) == rows);
	put(NULL);
}

int main(void)
{
	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	make_window();
	document = ladder_document_new();
	reopen(sample);
	test_problems();
	test_uses();
	test_symbols();
	test_import();
	test_find();
	test_tree();
	gtk_window_destroy(GTK_WINDOW(window));
	WAIT(G_OBJECT(document)->ref_count == 1);
	g_assert_finalize_object(document);
	return tap_done();
}
