/* SPDX-License-Identifier: MIT
 *
 * interface_view - what a program or block declares; see interface_view.h.
 */
#include "editor-gtk/panels/interface_view.h"

#include "editor-gtk/canvas/canvas.h"
#include "editor-gtk/document/panel_cells.h"
#include "editor-gtk/document/pins.h"
#include "editor-gtk/document/spelled.h"
#include "editor-gtk/document/symbols.h"
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/sheet.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/picture_view.h"
#include "editor-gtk/kit/row_move.h"
#include "editor-gtk/kit/settings.h"
#include "editor-gtk/panels/type_cells.h"
#include "editor-gtk/text/text_view.h"

#include "engine/base/name.h"

#include <adwaita.h>
#include <string.h>

#define LOW_SCREEN 800  /* px: on a lower one it is folded at first              */
#define TABLE_HIGH 168  /* px                                                    */
#define PIN_KIND SYMBOL_FIELDS /* field behind those of symbols                 */

#define ON_SIDE -1 /* index of a row that stands for the end of a kind          */

/* LadderPanelRow.flags, beside SYMBOL_KINDS and TYPE_CELLS_PARTS. */
enum { FIXED = 1, RESULT = 1 << 15 /* of a function                             */ };

/* Values of the settings "interface" and "variables": by the height of the screen or the kind of
 * sheet, shown, or folded. */
enum { BY_SCREEN, SHOWN, FOLDED };

struct _LadderInterfaceView {
	GtkWidget parent_instance;
	GtkWidget *sheet;        /* borrowed                                      */
	GtkWidget *box, *header, *arrow, *title, *summary, *body, *around, *picture;
	GtkWidget *table;
	GtkColumnViewColumn *address; /* of the variables of charts; borrowed     */
	GtkWidget *sides;             /* places for a dragged row, one for each kind */
	GPtrArray *side_rows;         /* what they stand for: LadderPanelRow, index ON_SIDE */
	struct panel_list list;
	struct panel_message message;
	struct panel_cells cells;
	struct panel_watch *watch;
	bool placed;             /* its first state was set                       */
	bool editable;           /* at the last look                              */
};

G_DEFINE_FINAL_TYPE(LadderInterfaceView, ladder_interface_view, GTK_TYPE_WIDGET)

static LadderDocument *document_of(LadderInterfaceView *view)
{
	return view->watch ? panel_watch_document(view->watch) : NULL;
}

static int shown_pou(LadderInterfaceView *view)
{
	return LADDER_IS_TEXT_VIEW(view->sheet) ?
	       ladder_text_view_pou(LADDER_TEXT_VIEW(view->sheet)) :
	       ladder_canvas_pou(LADDER_CANVAS(view->sheet));
}

/* The function, block or chart; NULL: the sheet shows another POU. */
static const struct pou *pou_of(LadderInterfaceView *view)
{
	const struct project *project = document_of(view) ?
		ladder_document_project(document_of(view)) : NULL;
	const int pou = shown_pou(view);

	return project && pou >= 0 && pou < project->pou_count &&
	       (pou_has_frame(&project->pou[pou]) || project->pou[pou].sfc) ?
	       &project->pou[pou] : NULL;
}

/* A chart is a program, which has variables but no pins. */
static bool has_pins(LadderInterfaceView *view)
{
	return pou_of(view) && pou_has_frame(pou_of(view));
}

static int index_of_pou(LadderInterfaceView *view)
{
	return (int)(pou_of(view) - ladder_document_project(document_of(view))->pou);
}

/* ---- the box ---- */

/* A rung with the box alone; its names are only in the text. */
static struct rung *box_alone(LadderInterfaceView *view, const struct pou *pou)
{
	struct ladder *ladder = ladder_document_ladder(document_of(view));
	const char *name = project_text(ladder_document_project(document_of(view)), pou->name);
	char *text = pou->kind == POU_FUNCTION ? g_strdup_printf("RUNG\n  | %s |\n", name) :
		     g_strdup_printf("RUNG\n  | %s %s1 |\n", name, name);
	struct diag_list *diags = g_new0(struct diag_list, 1);
	struct rung *rung = ladder_read_rung(ladder, text, strlen(text), diags);

	g_free(diags);
	g_free(text);
	return rung;
}

static void draw_box(gpointer data, struct picture *picture, struct lettering *lettering)
{
	LadderInterfaceView *view = data;
	const struct pou *pou = pou_of(view);
	struct rung *rung = has_pins(view) ? box_alone(view, pou) : NULL;
	struct pou alone = { .rung = &rung, .rung_count = 1 };
	struct sheet *sheet;

	if (!rung)
		return;
	sheet = sheet_new(ladder_document_project(document_of(view)), &alone, lettering);
	sheet_layout(sheet);
	{
		const struct rung_layout *layout = sheet->rung[0];
		const struct grid_scene scene = { .drafting = &sheet->drafting,
			.layout = layout, .theme = theme_screen(), .state = RUNG_NO_GUTTER };

		picture_move(picture, 12 - layout->column_x[0], 0);
		grid_draw(&scene, picture);
		picture_move(picture, 0, 0);
		picture_grow(picture, layout->column_width[0] + 24, layout->height);
	}
	sheet_free(sheet);
	rung_free(rung);
}

/* ---- rows ---- */

static const struct { uint16_t flag; const char *word; } kinds[] = {
	{ VAR_INPUT, N_("input") }, { VAR_IN_OUT, N_("in and out") }, { VAR_OUTPUT, N_("output") },
	{ 0, N_("local") }, { VAR_TEMP, N_("temporary") },
};

static const char *kind_word(uint16_t kind)
{
	for (gsize i = 0; i < G_N_ELEMENTS(kinds); i++)
		if (kinds[i].flag == kind)
			return _(kinds[i].word);
	return "";
}

/* The kind that a text names, translated or as the file has it: "output", "VAR_OUTPUT". False:
 * none. */
static bool find_kind(const char *text, uint16_t *kind)
{
	for (gsize i = 0; i < G_N_ELEMENTS(kinds); i++)
		if (name_equal(text, _(kinds[i].word)) ||
		    name_equal(text, vars_head(kinds[i].flag))) {
			*kind = kinds[i].flag;
			return true;
		}
	return false;
}

static LadderPanelRow *row_of(LadderDocument *document, const struct symbol_row *symbol,
			      const char *kind)
{
	LadderPanelRow *row = ladder_panel_row_new();
	bool warning = false;

	for (int i = 0; i < SYMBOL_FIELDS; i++)
		row->text[i] = i == FIELD_ADDRESS ? spelled_shown(document, symbol->text[i]) :
			       g_strdup(symbol->text[i]);
	row->text[PIN_KIND] = g_strdup(kind);
	row->number = symbol->uses;
	row->table = symbol->table;
	row->index = symbol->index;
	row->flags = (symbol->flags & SYMBOL_KINDS) | (symbol->included ? FIXED : 0u) |
		     (symbol->included ? 0u :
		      type_cells_flags(document, symbol->table, symbol->index));
	row->note = symbol_error(document, symbol, &warning);
	row->tone = !row->note ? PANEL_PLAIN : warning ? PANEL_WARNING : PANEL_ERROR;
	row->spoken = g_strdup_printf("%s, %s, %s", symbol->text[FIELD_NAME],
				      row->text[PIN_KIND], symbol->text[FIELD_TYPE]);
	return row;
}

/* A function has its result first, with its own name. */
static void add_result(GPtrArray *rows, LadderDocument *document, const struct pou *pou, int n)
{
	const struct project *project = ladder_document_project(document);
	struct symbol_row *symbol = symbol_row_new(project, &pou->vars, n + 1, 0);
	LadderPanelRow *row = row_of(document, symbol, _("result"));

	row->flags |= pou->included ? RESULT | FIXED : RESULT;
	row->index = 0;
	g_ptr_array_add(rows, row);
	symbol_row_free(symbol);
}

/* Pins first, as in the box, then variables. */
static void fill_rows(LadderInterfaceView *view, const struct pou *pou)
{
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	struct symbols *symbols = symbols_new(document_of(view));
	const int table = index_of_pou(view) + 1;

	if (pou->kind == POU_FUNCTION && pou->vars.count > 0)
		add_result(rows, document_of(view), pou, table - 1);
	for (gsize k = 0; k < G_N_ELEMENTS(kinds); k++)
		for (int i = 0; i < symbols->count; i++)
			if (symbols->symbol[i].table == table &&
			    (symbols->symbol[i].flags & SYMBOL_KINDS) == kinds[k].flag)
				g_ptr_array_add(rows, row_of(document_of(view),
					&symbols->symbol[i], _(kinds[k].word)));
	for (guint i = 0; i < rows->len && !ladder_document_is_whole(document_of(view)); i++)
		((LadderPanelRow *)rows->pdata[i])->flags |= FIXED;
	panel_cells_update(&view->list, rows);
	symbols_free(symbols);
	g_ptr_array_unref(rows);
}

static char *count_pins(const struct pou *pou)
{
	const int in = pins_count(pou, VAR_INPUT), out = pins_count(pou, VAR_OUTPUT);
	const int both = pins_count(pou, VAR_IN_OUT);
	char *inputs = g_strdup_printf(ngettext("%d input", "%d inputs", (gulong)in), in);
	char *outputs = g_strdup_printf(ngettext("%d output", "%d outputs", (gulong)out), out);
	char *text = both ? g_strdup_printf("%s, %s, VAR_IN_OUT: %d", inputs, outputs, both) :
		     g_strdup_printf("%s, %s", inputs, outputs);

	g_free(outputs);
	g_free(inputs);
	return text;
}

static void show_summary(LadderInterfaceView *view, const struct pou *pou)
{
	const int count = vars_declared(&pou->vars);
	char *text = has_pins(view) ? count_pins(pou) : g_strdup_printf(
		ngettext("%d variable", "%d variables", (gulong)count), count);
	const char *name = has_pins(view) ? _("Interface") : _("Variables");

	gtk_label_set_text(GTK_LABEL(view->summary), text);
	gtk_label_set_text(GTK_LABEL(view->title), name);
	spoken_name(view->header, name);
	spoken_name(view->table, has_pins(view) ? _("Pins") : _("Variables"));
	gtk_widget_set_visible(view->around, has_pins(view));
	list_show_column(view->address, !has_pins(view));
	g_free(text);
}

/* A list that cannot be read has declarations that the project does not have. */
static bool may_edit(LadderInterfaceView *view)
{
	return pou_of(view) && ladder_document_is_whole(document_of(view));
}

/* @text: taken over; NULL: clears the message. */
static void tell(LadderInterfaceView *view, char *text, bool error)
{
	GtkWidget *label = GTK_WIDGET(view->message.label);

	panel_message_set(&view->message, document_of(view), text);
	gtk_widget_remove_css_class(label, error ? "dim-label" : "error");
	gtk_widget_add_css_class(label, error ? "error" : "dim-label");
}

/* Tells why nothing can be edited, while that is so. */
static void show_state(LadderInterfaceView *view)
{
	const bool may = may_edit(view);

	if (!may)
		tell(view, g_strdup(_("Nothing can be changed until the whole project can be read. "
				      "Correct its errors first")), false);
	else if (!view->editable)
		tell(view, NULL, false);
	view->editable = may;
}

static void refresh(GtkWidget *widget)
{
	LadderInterfaceView *view = LADDER_INTERFACE_VIEW(widget);
	const struct pou *pou = pou_of(view);

	gtk_widget_set_visible(view->box, pou != NULL);
	panel_message_age(&view->message, document_of(view));
	if (!pou)
		return;
	show_summary(view, pou);
	gtk_widget_action_set_enabled(widget, "interface.add-input", has_pins(view));
	gtk_widget_action_set_enabled(widget, "interface.add-output", has_pins(view));
	gtk_widget_action_set_enabled(widget, "interface.add-in-out", has_pins(view));
	if (!gtk_widget_get_visible(view->body))
		return;
	show_state(view);
	fill_rows(view, pou);
	ladder_picture_view_again(LADDER_PICTURE_VIEW(view->picture));
}

/* ---- folding ---- */

static void set_shown(LadderInterfaceView *view, bool shown)
{
	gtk_widget_set_visible(view->body, shown);
	gtk_image_set_from_icon_name(GTK_IMAGE(view->arrow), shown ? "pan-down-symbolic" :
				     "pan-end-symbolic");
	gtk_accessible_update_state(GTK_ACCESSIBLE(view->header), GTK_ACCESSIBLE_STATE_EXPANDED,
				    shown, -1);
	if (shown)
		refresh(GTK_WIDGET(view));
}

/* Charts need their room: their variables are folded until somebody unfolds them. */
static const char *key_of(LadderInterfaceView *view)
{
	return has_pins(view) ? "interface" : "variables";
}

static void fold(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderInterfaceView *view = LADDER_INTERFACE_VIEW(widget);
	const bool shown = !gtk_widget_get_visible(view->body);

	(void)action;
	(void)unused;
	if (!shown && gtk_widget_get_focus_child(view->box) == view->body)
		gtk_widget_grab_focus(view->sheet);
	set_shown(view, shown);
	if (settings_get())
		g_settings_set_int(settings_get(), key_of(view), shown ? SHOWN : FOLDED);
}

static bool is_low(GtkWidget *widget)
{
	GdkSurface *surface = gtk_native_get_surface(gtk_widget_get_native(widget));
	GdkMonitor *monitor = surface ? gdk_display_get_monitor_at_surface(
		gtk_widget_get_display(widget), surface) : NULL;
	GdkRectangle box = { 0, 0, 0, LOW_SCREEN };

	if (monitor)
		gdk_monitor_get_geometry(monitor, &box);
	return box.height < LOW_SCREEN;
}

static void mapped(GtkWidget *widget)
{
	LadderInterfaceView *view = LADDER_INTERFACE_VIEW(widget);
	const int kept = settings_int(key_of(view), BY_SCREEN);

	if (view->placed)
		return;
	view->placed = true;
	set_shown(view, kept == SHOWN || (kept == BY_SCREEN && has_pins(view) &&
					  !is_low(widget)));
}

/* ---- edits ---- */

/* The index of a pin now: rows are updated with a delay. -1: deleted. */
static int index_of(LadderInterfaceView *view, const LadderPanelRow *row)
{
	return symbol_find(document_of(view), row->table, panel_row_text(row, FIELD_NAME),
			   row->index);
}

/* That @calls callers have operands at a pin, which has another kind now; NULL: none has. */
static char *told_calls(const LadderPanelRow *row, int calls)
{
	return calls == 0 ? NULL : g_strdup_printf(ngettext(
		"%s: %d caller has an operand there, which may not fit any more. See the problems.",
		"%s: %d callers have an operand there, which may not fit any more. See the "
		"problems.", (gulong)calls), panel_row_text(row, FIELD_NAME), calls);
}

static bool set_kind(LadderInterfaceView *view, LadderPanelRow *row, const char *text, char **why)
{
	const int pou = row->table - 1, index = index_of(view, row);
	uint16_t kind = 0;
	int calls;

	if (!find_kind(text, &kind)) {
		*why = g_strdup_printf(_("“%s” is no kind. Ctrl+Space lists them."), text);
		return false;
	}
	if (kind == (row->flags & SYMBOL_KINDS))
		return true;
	calls = pin_calls(document_of(view), pou, index);
	*why = pin_set_kind(document_of(view), pou, index, kind);
	if (!*why)
		tell(view, told_calls(row, calls), false);
	return !*why;
}

static bool set_field(GObject *owner, LadderPanelRow *row, int number, const char *text,
		      char **why)
{
	LadderInterfaceView *view = LADDER_INTERFACE_VIEW(owner);
	uint16_t kind;
	bool good;

	tell(view, NULL, false);
	if (number == PIN_KIND) {
		good = set_kind(view, row, text, why);
	} else if (row->flags & RESULT) {
		*why = pins_set_result(document_of(view), row->table - 1, text);
		good = !*why;
	} else {
		good = symbol_set(document_of(view), row->table, index_of(view, row),
				  (enum field)number, text, why);
	}
	if (!good && *why)
		tell(view, g_strdup_printf(_("%s: %s"), panel_row_text(row, FIELD_NAME),
					   *why), true);
	if (good) { /* for an undo before the next refresh */
		g_free(row->text[number]);
		row->text[number] = number == PIN_KIND && find_kind(text, &kind) ?
			g_strdup(kind_word(kind)) : g_strstrip(g_strdup(text));
		panel_watch_later(view->watch);
	}
	return good;
}

static bool is_fixed(const LadderPanelRow *row, int field)
{
	return row->flags & FIXED || (row->flags & RESULT && field != FIELD_TYPE) ||
	       (field == FIELD_INITIAL && row->flags & VAR_IN_OUT);
}

static const char *field_name(int field)
{
	return field == PIN_KIND ? _("Kind") : symbol_field_name((enum field)field);
}

static GPtrArray *kind_choices(LadderInterfaceView *view)
{
	GPtrArray *choices = g_ptr_array_new_with_free_func(g_free);

	for (gsize i = 0; i < G_N_ELEMENTS(kinds); i++) {
		if (!has_pins(view) && kinds[i].flag && kinds[i].flag != VAR_TEMP)
			continue;
		g_ptr_array_add(choices, g_strdup(_(kinds[i].word)));
		g_ptr_array_add(choices, g_strdup(vars_head(kinds[i].flag)));
	}
	return choices;
}

static GPtrArray *choices_of(GObject *owner, int field)
{
	LadderInterfaceView *view = LADDER_INTERFACE_VIEW(owner);

	return field == PIN_KIND ? kind_choices(view) :
	       type_cells_choices(document_of(view), false);
}

static void open_form(GObject *owner, LadderPanelRow *row, int field, GtkWidget *cell)
{
	type_cells_open(document_of(LADDER_INTERFACE_VIEW(owner)), row, field, cell);
}

/* The selected pin; NULL: none, or the result. */
static LadderPanelRow *selected(LadderInterfaceView *view)
{
	LadderPanelRow *row = panel_list_row(&view->list);

	return row && !(row->flags & RESULT) ? row : NULL;
}

/* Actions that add, and the names that they propose. */
static const struct { const char *action; uint16_t kind; const char *name; } adds[] = {
	{ "interface.add-input", VAR_INPUT, "In" }, { "interface.add-output", VAR_OUTPUT, "Out" },
	{ "interface.add-in-out", VAR_IN_OUT, "Both" }, { "interface.add-local", 0, "Local" },
	{ "interface.add-temp", VAR_TEMP, "Temp" },
};

static void add(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderInterfaceView *view = LADDER_INTERFACE_VIEW(widget);
	const char *text[SYMBOL_FIELDS] = { "", "BOOL", "", "", "", "", "" };
	char *name, *why = NULL;
	gsize at = 0;
	int table;

	(void)unused;
	if (!may_edit(view))
		return;
	while (strcmp(adds[at].action, action) != 0)
		at++;
	table = index_of_pou(view) + 1;
	name = symbol_free_name(document_of(view), table, adds[at].name);
	text[FIELD_NAME] = name;
	if (symbol_add(document_of(view), table, adds[at].kind, text, &why)) {
		refresh(widget);
		if (panel_list_select(&view->list, panel_row_is_named, name))
			cells_enter(view->list.view, panel_list_row(&view->list), FIELD_NAME);
	}
	tell(view, why, true);
	g_free(name);
}

/* ---- moving: within a kind, or to another one ---- */

/* Programs have no pins. */
static bool has_kind(LadderInterfaceView *view, uint16_t kind)
{
	return has_pins(view) || !kind || kind == VAR_TEMP;
}

/* The variable of a kind that follows @index, or the first (-1). -1: there is none. */
static int next_of(LadderInterfaceView *view, uint16_t kind, int index)
{
	const struct var_table *vars = &pou_of(view)->vars;
	const int result = pou_of(view)->kind == POU_FUNCTION; /* the first one is no row */

	for (int i = MAX(index + 1, result); i < vars_declared(vars); i++)
		if ((vars_flags(vars, i) & SYMBOL_KINDS) == kind)
			return i;
	return -1;
}

static int last_before(LadderInterfaceView *view, uint16_t kind, int index)
{
	int last = -1;

	for (int i = next_of(view, kind, -1); i >= 0 && i < index; i = next_of(view, kind, i))
		last = i;
	return last;
}

/* Of the list of kinds; as rows are listed. */
static int place_of_kind(uint16_t kind)
{
	int at = 0;

	while (kinds[at].flag != kind)
		at++;
	return at;
}

/* The edit; the row stays selected, and the keys in its field. @before: as for pin_put(). */
static void put(LadderInterfaceView *view, LadderPanelRow *row, uint16_t kind, int before)
{
	const int pou = row->table - 1, index = index_of(view, row);
	const bool other = index >= 0 && kind != (row->flags & SYMBOL_KINDS);
	const int calls = other ? pin_calls(document_of(view), pou, index) : 0;
	char *name = g_strdup(panel_row_text(row, FIELD_NAME));
	char *why = index < 0 ? g_strdup(_("There is no such symbol")) :
		    pin_put(document_of(view), pou, index, kind, before);
	int field = -1;

	cells_focused(view->list.view, &field);
	if (why) {
		tell(view, g_strdup_printf(_("%s: %s"), name, why), true);
	} else {
		tell(view, told_calls(row, calls), false);
		refresh(GTK_WIDGET(view));
		if (panel_list_select(&view->list, panel_row_is_named, name) && field >= 0)
			cells_enter(view->list.view, panel_list_row(&view->list), field);
	}
	g_free(why);
	g_free(name);
}

/* Beyond the last one of its kind it becomes the first one of the next kind, and back. */
static void move(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderInterfaceView *view = LADDER_INTERFACE_VIEW(widget);
	LadderPanelRow *row = selected(view);
	const bool up = strcmp(action, "interface.up") == 0;
	uint16_t kind;
	int index, before, at;

	(void)unused;
	if (!row || row->flags & FIXED || !may_edit(view) ||
	    !panel_cells_commit(view->list.view))
		return;
	kind = row->flags & SYMBOL_KINDS;
	index = index_of(view, row);
	before = up ? last_before(view, kind, index) : next_of(view, kind, index);
	if (before < 0) {
		for (at = place_of_kind(kind) + (up ? -1 : 1); at >= 0 &&
		     at < (int)G_N_ELEMENTS(kinds) && !has_kind(view, kinds[at].flag);)
			at += up ? -1 : 1;
		if (at < 0 || at >= (int)G_N_ELEMENTS(kinds)) {
			tell(view, g_strdup(up ? _("It is the first one already") :
					    _("It is the last one already")), true);
			return;
		}
		kind = kinds[at].flag;
		before = up ? -1 : next_of(view, kind, -1);
	} else if (!up) {
		before = next_of(view, kind, before);
	}
	put(view, row, kind, before);
}

static const char *movable(gpointer owner, gpointer of)
{
	const LadderPanelRow *row = of;

	return may_edit(owner) && !(row->flags & (FIXED | RESULT)) ?
	       panel_row_text(row, FIELD_NAME) : NULL;
}

static bool fits(gpointer owner, gpointer row, gpointer target, bool *below)
{
	const LadderPanelRow *at = target;

	if (at->flags & RESULT)
		*below = true; /* the result of a function is the first row */
	return movable(owner, row) && (at->flags & RESULT ||
				       has_kind(owner, at->flags & SYMBOL_KINDS));
}

static void move_to(gpointer owner, gpointer row, gpointer target, bool below)
{
	LadderInterfaceView *view = owner;
	const LadderPanelRow *at = target;
	const bool result = at->flags & RESULT;
	const uint16_t kind = result ? VAR_INPUT : at->flags & SYMBOL_KINDS;
	int before = -1;

	if (!panel_cells_commit(view->list.view))
		return;
	if (result)
		before = next_of(view, kind, -1);
	else if (at->index != ON_SIDE)
		before = below ? next_of(view, kind, index_of(view, at)) : index_of(view, at);
	if (before < 0 || before != index_of(view, row))
		put(view, row, kind, before);
}

static void dragging(gpointer owner, bool is)
{
	LadderInterfaceView *view = owner;
	GtkWidget *side = gtk_widget_get_first_child(view->sides);

	for (guint i = 0; i < view->side_rows->len; i++) {
		const LadderPanelRow *row = view->side_rows->pdata[i];

		side = gtk_widget_get_next_sibling(side); /* the first one is the label */
		gtk_widget_set_visible(side, has_kind(view, row->flags & SYMBOL_KINDS));
	}
	gtk_widget_set_visible(view->sides, is);
}

static const struct row_move moving = {
	.up = "interface.up", .down = "interface.down", .before_cells = true, .name = movable,
	.fits = fits, .move = move_to, .dragging = dragging,
};

/* ---- deleting: a pin that is used is deleted after a question ---- */

static void delete_now(LadderInterfaceView *view, int table, const char *name)
{
	const int index = symbol_find(document_of(view), table, name, -1);
	char *why = NULL;

	if (index >= 0)
		symbol_delete(document_of(view), table, index, &why);
	refresh(GTK_WIDGET(view));
	tell(view, why, true);
}

static void answered(AdwMessageDialog *dialog, const char *answer, LadderInterfaceView *view)
{
	const char *name = g_object_get_data(G_OBJECT(dialog), "pin");
	char *scope;

	if (strcmp(answer, "delete") == 0 && pou_of(view)) {
		delete_now(view, index_of_pou(view) + 1, name);
	} else if (strcmp(answer, "uses") == 0 && pou_of(view)) {
		scope = g_strdup_printf("%s.%s", project_text(ladder_document_project(
			document_of(view)), pou_of(view)->name), name);
		gtk_widget_activate_action(GTK_WIDGET(view), "win.show-uses", "s", scope);
		g_free(scope);
	}
}

static void ask_delete(LadderInterfaceView *view, const char *name, int uses)
{
	char *heading = g_strdup_printf(_("Delete “%s”?"), name);
	char *body = g_strdup_printf(ngettext(
		"It is used in %d place, which then has an error.",
		"It is used in %d places, which then have errors.", (gulong)uses), uses);
	GtkWidget *dialog = adw_message_dialog_new(GTK_WINDOW(gtk_widget_get_root(
		GTK_WIDGET(view))), heading, body);

	adw_message_dialog_add_responses(ADW_MESSAGE_DIALOG(dialog), "cancel", _("Cancel"),
					 "uses", _("Show uses"), "delete", _("Delete anyway"),
					 NULL);
	adw_message_dialog_set_response_appearance(ADW_MESSAGE_DIALOG(dialog), "delete",
						   ADW_RESPONSE_DESTRUCTIVE);
	adw_message_dialog_set_default_response(ADW_MESSAGE_DIALOG(dialog), "uses");
	adw_message_dialog_set_close_response(ADW_MESSAGE_DIALOG(dialog), "cancel");
	g_object_set_data_full(G_OBJECT(dialog), "pin", g_strdup(name), g_free);
	g_signal_connect_object(dialog, "response", G_CALLBACK(answered), view, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	g_free(body);
	g_free(heading);
}

static void delete(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderInterfaceView *view = LADDER_INTERFACE_VIEW(widget);
	LadderPanelRow *row = selected(view);

	(void)action;
	(void)unused;
	if (!row || !may_edit(view))
		return;
	if (row->number > 0)
		ask_delete(view, panel_row_text(row, FIELD_NAME), (int)row->number);
	else
		delete_now(view, row->table, panel_row_text(row, FIELD_NAME));
}

static void to_sheet(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	gtk_widget_grab_focus(LADDER_INTERFACE_VIEW(widget)->sheet);
}

/* ---- the widget ---- */

/* Actions that are not enabled are hidden. */
static void add_entry(GMenu *menu, const char *label, const char *action)
{
	GMenuItem *item = g_menu_item_new(label, action);

	g_menu_item_set_attribute(item, "hidden-when", "s", "action-disabled");
	g_menu_append_item(menu, item);
	g_object_unref(item);
}

static GMenu *add_menu(void)
{
	GMenu *menu = g_menu_new();

	add_entry(menu, _("Input"), "interface.add-input");
	add_entry(menu, _("Output"), "interface.add-output");
	add_entry(menu, _("In and out"), "interface.add-in-out");
	add_entry(menu, _("Local variable"), "interface.add-local");
	add_entry(menu, _("Temporary variable"), "interface.add-temp");
	return menu;
}

static GtkWidget *tools_new(void)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	GtkWidget *more = gtk_menu_button_new();

	gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(more), "list-add-symbolic");
	gtk_widget_add_css_class(more, "flat");
	popover_menu_of(GTK_MENU_BUTTON(more), add_menu);
	tip_set(more, _("Add a pin or variable"));
	spoken_name(more, _("Add a pin or variable"));
	gtk_box_append(GTK_BOX(box), more);
	gtk_box_append(GTK_BOX(box), panel_button_new("list-remove-symbolic",
		_("Delete the selected row"), "interface.delete"));
	gtk_box_append(GTK_BOX(box), panel_button_new("go-up-symbolic",
		_("Move the selected row up"), "interface.up"));
	gtk_box_append(GTK_BOX(box), panel_button_new("go-down-symbolic",
		_("Move the selected row down"), "interface.down"));
	return box;
}

/* One for each kind, also for those that have no row yet. */
static void add_sides(LadderInterfaceView *view)
{
	view->sides = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	view->side_rows = g_ptr_array_new_with_free_func(g_object_unref);
	gtk_widget_set_visible(view->sides, FALSE);
	gtk_widget_set_margin_end(view->sides, 6);
	gtk_box_append(GTK_BOX(view->sides), gtk_label_new(_("Move to:")));
	for (gsize i = 0; i < G_N_ELEMENTS(kinds); i++) {
		LadderPanelRow *row = ladder_panel_row_new();
		GtkWidget *side = gtk_label_new(_(kinds[i].word));

		row->flags = kinds[i].flag;
		row->index = ON_SIDE;
		g_ptr_array_add(view->side_rows, row);
		gtk_widget_add_css_class(side, "drop-side");
		gtk_label_set_ellipsize(GTK_LABEL(side), PANGO_ELLIPSIZE_END);
		gtk_box_append(GTK_BOX(view->sides), side);
		row_move_add_place(view->table, side, row);
	}
}

static GtkWidget *header_new(LadderInterfaceView *view)
{
	GtkWidget *button = gtk_button_new();
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);

	view->arrow = gtk_image_new_from_icon_name("pan-end-symbolic");
	view->title = gtk_label_new(_("Interface"));
	view->summary = gtk_label_new("");
	gtk_widget_add_css_class(view->summary, "dim-label");
	gtk_label_set_ellipsize(GTK_LABEL(view->summary), PANGO_ELLIPSIZE_END);
	gtk_box_append(GTK_BOX(box), view->arrow);
	gtk_box_append(GTK_BOX(box), view->title);
	gtk_box_append(GTK_BOX(box), view->summary);
	gtk_button_set_child(GTK_BUTTON(button), box);
	gtk_widget_add_css_class(button, "flat");
	gtk_widget_add_css_class(button, "interface-header");
	gtk_actionable_set_action_name(GTK_ACTIONABLE(button), "interface.fold");
	gtk_widget_set_focus_on_click(button, FALSE);
	view->header = button;
	return button;
}

static void add_columns(LadderInterfaceView *view)
{
	static const struct { int field; int width; } column[] = {
		{ PIN_KIND, 118 }, { FIELD_NAME, 140 }, { FIELD_TYPE, 130 },
		{ FIELD_ADDRESS, 100 }, { FIELD_INITIAL, 110 }, { FIELD_COMMENT, 160 },
	};

	view->cells = (struct panel_cells){ .owner = G_OBJECT(view), .name = field_name,
		.choosable = 1u << PIN_KIND, .completing = 1u << PIN_KIND, .set = set_field,
		.is_fixed = is_fixed, .choices = choices_of, .open_form = open_form };
	type_cells_join(&view->cells);
	for (gsize i = 0; i < G_N_ELEMENTS(column); i++)
		panel_cells_add(&view->list, &view->cells, column[i].field,
				column[i].field == FIELD_COMMENT ? PANEL_EXPAND : 0,
				column[i].width);
	view->address = g_list_model_get_item(gtk_column_view_get_columns(view->list.view), 3);
	g_object_unref(view->address); /* the list has a reference */
}

static GtkWidget *table_new(LadderInterfaceView *view)
{
	GtkWidget *scroller = gtk_scrolled_window_new();
	GtkWidget *table = gtk_column_view_new(NULL);

	gtk_widget_add_css_class(table, "data-table");
	view->table = table;
	panel_list_init(&view->list, GTK_COLUMN_VIEW(table));
	add_columns(view);
	row_move_add(table, &moving, view);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), table);
	gtk_scrolled_window_set_min_content_height(GTK_SCROLLED_WINDOW(scroller), TABLE_HIGH);
	gtk_widget_set_hexpand(scroller, TRUE);
	return scroller;
}

static GtkWidget *body_new(LadderInterfaceView *view)
{
	GtkWidget *body = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
	GtkWidget *around = gtk_scrolled_window_new();

	view->around = around;
	view->picture = ladder_picture_view_new(draw_box, view);
	gtk_widget_set_valign(view->picture, GTK_ALIGN_START);
	gtk_widget_set_halign(view->picture, GTK_ALIGN_START);
	gtk_widget_set_overflow(view->picture, GTK_OVERFLOW_HIDDEN);
	spoken_name(view->picture, _("The box as callers see it"));
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(around), view->picture);
	gtk_scrolled_window_set_propagate_natural_width(GTK_SCROLLED_WINDOW(around), TRUE);
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(around), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	panel_message_init(&view->message, GTK_LABEL(gtk_label_new(NULL)));
	gtk_box_append(GTK_BOX(row), around);
	gtk_box_append(GTK_BOX(row), tools_new());
	gtk_box_append(GTK_BOX(row), table_new(view));
	gtk_box_append(GTK_BOX(body), row);
	gtk_box_append(GTK_BOX(body), GTK_WIDGET(view->message.label));
	return body;
}

static void dispose(GObject *object)
{
	LadderInterfaceView *view = LADDER_INTERFACE_VIEW(object);

	g_clear_pointer(&view->watch, panel_watch_free);
	if (view->box) {
		g_clear_pointer(&view->box, gtk_widget_unparent);
		panel_list_clear(&view->list);
		g_ptr_array_unref(view->side_rows);
	}
	G_OBJECT_CLASS(ladder_interface_view_parent_class)->dispose(object);
}

static void ladder_interface_view_class_init(LadderInterfaceViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	for (gsize i = 0; i < G_N_ELEMENTS(adds); i++)
		gtk_widget_class_install_action(widget, adds[i].action, NULL, add);
	gtk_widget_class_install_action(widget, "interface.fold", NULL, fold);
	gtk_widget_class_install_action(widget, "interface.delete", NULL, delete);
	gtk_widget_class_install_action(widget, "interface.up", NULL, move);
	gtk_widget_class_install_action(widget, "interface.down", NULL, move);
	gtk_widget_class_install_action(widget, "interface.to-sheet", NULL, to_sheet);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_F6, 0, "interface.to-sheet", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_Up, GDK_ALT_MASK, "interface.up",
					    NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_Down, GDK_ALT_MASK,
					    "interface.down", NULL);
}

static void ladder_interface_view_init(LadderInterfaceView *view)
{
	GtkWidget *head = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);

	view->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	gtk_widget_add_css_class(view->box, "interface");
	view->body = body_new(view);
	gtk_widget_set_visible(view->body, FALSE);
	add_sides(view);
	gtk_widget_set_hexpand(header_new(view), TRUE);
	gtk_box_append(GTK_BOX(head), view->header);
	gtk_box_append(GTK_BOX(head), view->sides);
	gtk_box_append(GTK_BOX(view->box), head);
	gtk_box_append(GTK_BOX(view->box), view->body);
	gtk_widget_set_parent(view->box, GTK_WIDGET(view));
	g_signal_connect(view, "map", G_CALLBACK(mapped), NULL);
}

GtkWidget *ladder_interface_view_new(LadderDocument *document, GtkWidget *sheet)
{
	LadderInterfaceView *view = g_object_new(LADDER_TYPE_INTERFACE_VIEW, NULL);

	view->sheet = sheet;
	view->watch = panel_watch_new(GTK_WIDGET(view), true, refresh);
	panel_watch_set(view->watch, document);
	refresh(GTK_WIDGET(view));
	return GTK_WIDGET(view);
}
