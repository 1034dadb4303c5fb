/* SPDX-License-Identifier: MIT
 *
 * test_first_key - the entry that a key opens on a sheet: at each kind of place each character
 * opens it and stays in it; a refusal is shown there; inputs of a box are fed by one line. And the
 * context menus, which must be short.
 */
#include "editor-gtk/kit/entry_row.h"
#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/sfc/sfc_view.h"
#include "tests/editor/nodes.h"
#include "tests/editor/sheet_window.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <string.h>

#define MENU_MOST 14 /* rows of a context menu                                      */

static const char sample[] =
	"RUNGBOARD 1\n\nVAR\n  A AT %IX0.0 : BOOL;\n  B AT %IX0.1 : BOOL;\n  C1 : CTU;\n"
	"  Q AT %QX0.0 : BOOL;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | NO A | CTU C1 PV:=10 | COIL Q |\n"
	"RUNG\n  | NO A | CTU C1 PV:=10 | COIL Q |\n  | NO B | .R |\n"
	"RUNG\nEND_PROGRAM\n\n"
	"PROGRAM Bare LD\nEND_PROGRAM\n\n"
	"PROGRAM Way SFC\n  INITIAL_STEP Start:\n    Q(N);\n  END_STEP\n"
	"  TRANSITION FROM Start TO Run := A; END_TRANSITION\n  STEP Run:\n  END_STEP\n"
	"  TRANSITION FROM Run TO Start := B; END_TRANSITION\nEND_PROGRAM\n\n"
	"PROGRAM Nothing SFC\nEND_PROGRAM\n";

static GtkWidget *window;
static LadderDocument *document;
static LadderCanvas *canvas;

/* ---- the entry ---- */

static GtkWidget *find(GtkWidget *widget, bool (*is)(GtkWidget *widget))
{
	GtkWidget *found = widget && is(widget) ? widget : NULL;

	for (GtkWidget *child = widget ? gtk_widget_get_first_child(widget) : NULL; child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = find(child, is);
	return found;
}

static bool is_entry(GtkWidget *widget)
{
	return GTK_IS_ENTRY(widget);
}

static bool is_error(GtkWidget *widget)
{
	return GTK_IS_LABEL(widget) && gtk_widget_has_css_class(widget, "error") &&
	       *gtk_label_get_text(GTK_LABEL(widget));
}

static GtkWidget *entry(void)
{
	return find(canvas_state(canvas)->entry, is_entry);
}

static bool is_refused(void)
{
	return find(canvas_state(canvas)->entry, is_error);
}

static void enter(const char *text)
{
	if (!CHECK_AS(entry() != NULL, text))
		return;
	gtk_editable_set_text(GTK_EDITABLE(entry()), text);
	turn(0);
	g_signal_emit_by_name(entry(), "activate");
}

static bool file_has(const char *part)
{
	char *text = ladder_document_text(document, NULL);
	const bool has = strstr(text, part) != NULL;

	g_free(text);
	return has;
}

static void show(GtkWidget *sheet)
{
	GtkWidget *scroller = gtk_scrolled_window_new();

	canvas = LADDER_CANVAS(sheet);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), sheet);
	gtk_window_set_child(GTK_WINDOW(window), scroller);
	WAIT(gtk_widget_get_width(sheet) > 0 && gtk_widget_grab_focus(sheet));
}

/* ---- at a place ---- */

static int rows_of(GMenuModel *menu)
{
	int rows = 0;

	for (int i = 0; i < g_menu_model_get_n_items(menu); i++) {
		GMenuModel *section = g_menu_model_get_item_link(menu, i, G_MENU_LINK_SECTION);

		rows += section ? g_menu_model_get_n_items(section) : 1;
		g_clear_object(&section);
	}
	return rows;
}

static void check_menu(const char *place)
{
	GMenu *menu = LADDER_CANVAS_GET_CLASS(canvas)->menu(canvas);
	const int rows = rows_of(G_MENU_MODEL(menu));

	if (!CHECK_AS(rows > 1 && rows <= MENU_MOST, place))
		printf("# %d rows in the menu\n", rows);
	g_object_unref(menu);
}

static void check_place(const char *place)
{
	check_menu(place);
	for (char c = '!'; c <= '~'; c++) {
		const char text[] = { c, '\0' };

		LADDER_CANVAS_GET_CLASS(canvas)->type(canvas, text);
		if (!CHECK_AS(entry() && strcmp(gtk_editable_get_text(GTK_EDITABLE(entry())),
						text) == 0, place)) {
			printf("# lost: %s\n", text);
			return;
		}
		canvas_close_entry(canvas);
	}
}

static void test_ladder(void)
{
	static const struct { int rung, row, col; const char *place; } places[] = {
		{ 0, 0, 0, "a contact" }, { 0, 0, 1, "a box" }, { 0, 0, 2, "a coil" },
		{ 1, 1, 0, "a contact before a pin" }, { 1, 1, 1, "a row of pins" },
		{ 2, 0, 0, "an empty cell" }, { 2, 0, 5, "an empty last cell" },
	};

	show(ladder_grid_view_new(document, 0));
	for (gsize i = 0; i < G_N_ELEMENTS(places); i++) {
		ladder_grid_view_go(LADDER_GRID_VIEW(canvas), places[i].rung, places[i].row,
				    places[i].col);
		check_place(places[i].place);
	}
}

/* ---- charts ---- */

static void test_chart(void)
{
	struct canvas_spot spot = { 0, -1, 0 };
	char *name;

	show(ladder_sfc_view_new(document, 2));
	for (; (name = LADDER_CANVAS_GET_CLASS(canvas)->cell_name(canvas, spot)); spot.number++) {
		LADDER_CANVAS_GET_CLASS(canvas)->go_to_cell(canvas, spot);
		check_place(name);
		g_free(name);
	}
	CHECK(spot.number == 5);
	spot = (struct canvas_spot){ 0, 0, 0 };
	LADDER_CANVAS_GET_CLASS(canvas)->go_to_cell(canvas, spot);
	check_place("a line of a step");
}

static void test_condition(const char *line, const char *kept)
{
	LADDER_CANVAS_GET_CLASS(canvas)->go_to_cell(canvas, (struct canvas_spot){ 2, -1, 0 });
	LADDER_CANVAS_GET_CLASS(canvas)->type(canvas, "x");
	enter(line);
	CHECK_AS(entry() == NULL && file_has(kept), line);
}

static void test_conditions(void)
{
	test_condition("!B", "TO Run := NOT B;");
	test_condition("A", "TO Run := A;");
	test_condition("/ B", "TO Run := NOT B;");
	test_condition("Start.T > 5s", "TO Run := Start.T > T#5s;");
	LADDER_CANVAS_GET_CLASS(canvas)->type(canvas, "=");
	enter("= 7");
	CHECK_AS(entry() && is_refused() && file_has("TO Run := Start.T > T#5s;"), "= 7");
	canvas_close_entry(canvas);
	ladder_canvas_do(canvas, VERB_step_times);
	CHECK_AS(entry() && is_refused(), "step times of a transition are refused");
	enter("5s");
	CHECK_AS(entry() && is_refused(), "Enter after a refusal is refused too");
	canvas_close_entry(canvas);
}

/* A candidate that would be made is marked: by a word in a frame. */
static bool is_marked(GtkWidget *widget)
{
	return LADDER_IS_ENTRY_ROW(widget) && gtk_widget_get_mapped(widget) &&
	       widget_has(widget, "border {");
}

/* @new: a name that the project does not have; @old: one that it has. */
static void check_mark(const char *place, const char *new, const char *old)
{
	LADDER_CANVAS_GET_CLASS(canvas)->type(canvas, "x");
	gtk_editable_set_text(GTK_EDITABLE(entry()), new);
	gtk_editable_set_position(GTK_EDITABLE(entry()), -1);
	WAIT(find(canvas_state(canvas)->entry, is_marked));
	CHECK_AS(find(canvas_state(canvas)->entry, is_marked), place);
	gtk_editable_set_text(GTK_EDITABLE(entry()), old);
	gtk_editable_set_position(GTK_EDITABLE(entry()), -1);
	WAIT(!find(canvas_state(canvas)->entry, is_marked));
	CHECK_AS(!find(canvas_state(canvas)->entry, is_marked), place);
	canvas_close_entry(canvas);
}

static void test_marks(void)
{
	show(ladder_grid_view_new(document, 0));
	ladder_grid_view_go(LADDER_GRID_VIEW(canvas), 2, 0, 0);
	check_mark("a new contact is marked", "Spark", "A");
	show(ladder_sfc_view_new(document, 2));
	LADDER_CANVAS_GET_CLASS(canvas)->go_to_cell(canvas, (struct canvas_spot){ 2, -1, 0 });
	check_mark("a new name of a condition is marked", "Spark", "A");
	LADDER_CANVAS_GET_CLASS(canvas)->go_to_cell(canvas, (struct canvas_spot){ 0, 0, 0 });
	check_mark("a new name in a line of a step is marked", "N Spark", "N Q");
}

static void test_empty(void)
{
	show(ladder_sfc_view_new(document, 3));
	check_place("an empty chart");
	LADDER_CANVAS_GET_CLASS(canvas)->type(canvas, "F");
	enter("First");
	CHECK(entry() == NULL && file_has("INITIAL_STEP First:"));
	show(ladder_grid_view_new(document, 1));
	LADDER_CANVAS_GET_CLASS(canvas)->type(canvas, "A");
	enter("A");
	CHECK(entry() == NULL && file_has("PROGRAM Bare LD\nRUNG\n  | NO A |"));
}

/* ---- inputs of a box ---- */

static void feed(const char *line)
{
	ladder_grid_view_go(LADDER_GRID_VIEW(canvas), 0, 0, 1);
	ladder_canvas_do(canvas, VERB_add_pin);
	enter(line);
}

static void test_feed(void)
{
	show(ladder_grid_view_new(document, 0));
	feed("Z B");
	CHECK_AS(entry() && is_refused(),
		 "an input that the box does not have is refused");
	feed("CV B");
	CHECK_AS(entry() && is_refused(), "an output of the box is refused");
	feed("R B C");
	CHECK_AS(entry() && is_refused() && file_has("COIL Q |\nRUNG\n"),
		 "two operands are refused");
	feed("PV 20");
	CHECK_AS(!entry() && file_has("CTU C1 PV:=20 |"), "a value is written at PV");
	feed("R !B");
	CHECK_AS(!entry() && file_has("PV:=20 | COIL Q |\n  | NC B | .R "),
		 "an inverted contact is connected to R");
	feed("R B");
	CHECK_AS(entry() && is_refused(),
		 "an input that is connected already is refused");
	ladder_grid_view_go(LADDER_GRID_VIEW(canvas), 0, 0, 0);
	ladder_canvas_do(canvas, VERB_add_pin);
	CHECK_AS(entry() && is_refused(), "a cell without a box is refused");
	enter("R B");
	CHECK_AS(entry() && is_refused() && !file_has("NO B ^"),
		 "a refused input changes nothing");
	canvas_close_entry(canvas);
	ladder_canvas_do(canvas, VERB_set_value);
	CHECK_AS(entry() && is_refused(),
		 "Set value at an element without a value is refused");
	canvas_close_entry(canvas);
}

int main(void)
{
	document = sheet_window(sample, 900, 500, &window);
	if (!document)
		return 0;
	test_ladder();
	test_chart();
	test_conditions();
	test_marks();
	test_empty();
	test_feed();
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
	g_object_unref(document);
	return tap_done();
}
