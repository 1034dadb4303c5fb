/* SPDX-License-Identifier: MIT
 *
 * types_view - the page of data types; see types_view.h.
 */
#include "editor-gtk/panels/types_view.h"

#include "editor-gtk/document/panel_cells.h"
#include "editor-gtk/document/symbols.h"
#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/drop.h"
#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/row_move.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/panels/type_cells.h"

#include "engine/xref/xref.h"

#include <string.h>

/* Columns behind the fields. */
enum {
	TYPES_USES = SYMBOL_FIELDS,
	TYPES_BASE, TYPES_LOW, TYPES_HIGH, /* of a declaration: its base type, its limits */
	TYPES_FIRST,                       /* the initial value of an enumeration */
	TYPES_NUMBER,                      /* of a value                          */
};
/* In LadderPanelRow.flags: */
#define TYPES_FIXED    1u /* of another file                                    */
#define TYPES_VALUE    2u /* a value of an enumeration, not a member             */
#define TYPES_DECLARED 4u /* the declaration of a type that is no structure      */
#define TYPES_IMPLICIT 8u /* a value whose number is not written                 */

struct _LadderTypesView {
	GtkBox parent_instance;
	GtkWidget *stack, *types, *members;
	struct panel_list list;     /* members, or values                         */
	struct panel_list declared; /* of a type that is no structure: one row    */
	struct panel_cells cells;
	GPtrArray *numbered;        /* columns that are not for all kinds: struct shown */
	GArray *order;              /* of the types in the drop-down: int          */
	struct panel_watch *watch;
	char *type;             /* name of the type that is shown; NULL: none      */
	struct panel_message message;
	bool busy;              /* the drop-down is being filled: ignore its signal */
};

G_DEFINE_FINAL_TYPE(LadderTypesView, ladder_types_view, GTK_TYPE_BOX)

static LadderDocument *document_of(LadderTypesView *view)
{
	return panel_watch_document(view->watch);
}

/* The number of the type that it shows; -1: none. */
static int type_of(LadderTypesView *view)
{
	return view->type ? type_find(document_of(view), view->type) : -1;
}

/* The kind of the type that it shows; TYPE_KINDS: none. */
static enum type_kind kind_of(LadderTypesView *view)
{
	const int type = type_of(view);

	return type < 0 ? TYPE_KINDS :
	       type_kind_of(ladder_document_project(document_of(view)), type);
}

/* @text: taken over; NULL: clears the message. */
static void tell(LadderTypesView *view, char *text)
{
	panel_message_set(&view->message, document_of(view), text);
}

/* ---- rows ---- */

static LadderPanelRow *row_of(LadderDocument *document, const struct symbol_row *symbol,
			      bool fixed)
{
	LadderPanelRow *row = ladder_panel_row_new();
	bool warning = false;

	for (int i = 0; i < SYMBOL_FIELDS; i++)
		row->text[i] = g_strdup(symbol->text[i]);
	row->text[TYPES_USES] = g_strdup_printf("%d", symbol->uses);
	row->number = symbol->uses;
	row->table = symbol->table;
	row->index = symbol->index;
	row->flags = fixed ? TYPES_FIXED :
		     type_cells_flags(document, symbol->table, symbol->index);
	row->note = symbol_error(document, symbol, &warning);
	row->tone = !row->note ? PANEL_PLAIN : warning ? PANEL_WARNING : PANEL_ERROR;
	row->spoken = g_strjoin(", ", symbol->text[FIELD_NAME], symbol->text[FIELD_TYPE],
				*symbol->text[FIELD_INITIAL] ? symbol->text[FIELD_INITIAL] :
				_("no initial value"), symbol->text[FIELD_COMMENT], NULL);
	return row;
}

static void add_members(GPtrArray *rows, LadderDocument *document, int type, bool fixed)
{
	struct symbols *symbols = symbols_new(document);

	for (int i = 0; i < symbols->count; i++)
		if (symbols->symbol[i].table == type_table(document, type))
			g_ptr_array_add(rows, row_of(document, &symbols->symbol[i], fixed));
	symbols_free(symbols);
}

/* The places that use each value of the project, without its declaration. Caller frees. */
static int *value_uses(struct project *project)
{
	int *uses = g_new0(int, (gsize)project->enum_value_count + 1);
	struct xref xref = { 0 };

	if (!xref_make(&xref, project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++)
		if (xref.use[i].target.what == XREF_VALUE && xref.use[i].kind != XREF_DECLARED)
			uses[xref.use[i].target.index]++;
	xref_free(&xref);
	return uses;
}

static LadderPanelRow *value_row(const struct enum_value *value, const struct project *project,
				 int uses)
{
	LadderPanelRow *row = ladder_panel_row_new();

	row->text[FIELD_NAME] = g_strdup(project_text(project, value->name));
	row->text[TYPES_NUMBER] = value->text ? g_strdup(project_text(project, value->text)) :
				  g_strdup_printf("%lld", (long long)value->number);
	row->text[TYPES_USES] = g_strdup_printf("%d", uses);
	row->number = uses;
	row->flags = TYPES_VALUE | (value->text ? 0u : TYPES_IMPLICIT);
	row->spoken = g_strjoin(", ", row->text[FIELD_NAME], row->text[TYPES_NUMBER], NULL);
	return row;
}

static void add_values(GPtrArray *rows, LadderDocument *document, int type, bool fixed)
{
	struct project *project = ladder_document_project(document);
	int *uses = value_uses(project), value;

	for (int i = 0; (value = type_value(project, type, i)) >= 0; i++) {
		LadderPanelRow *row = value_row(&project->enum_value[value], project, uses[value]);

		row->table = type_table(document, type);
		row->index = i;
		row->flags |= fixed ? TYPES_FIXED : 0u;
		g_ptr_array_add(rows, row);
	}
	g_free(uses);
}

/* The declaration of a type that is no structure. */
static LadderPanelRow *declared_row(LadderDocument *document, int type, bool fixed)
{
	struct project *project = ladder_document_project(document);
	const int table = type_table(document, type);
	struct symbol_row *symbol = symbol_row_new(project, xref_table(project, table), table, 0);
	LadderPanelRow *row = row_of(document, symbol, fixed);
	const enum type_kind kind = type_kind_of(project, type);

	row->flags |= TYPES_DECLARED;
	if (kind == TYPE_ENUMERATION || kind == TYPE_SUBRANGE)
		row->text[TYPES_BASE] = type_base(project, type);
	if (kind == TYPE_SUBRANGE) {
		row->text[TYPES_LOW] = type_bound(project, type, false);
		row->text[TYPES_HIGH] = type_bound(project, type, true);
	}
	row->text[TYPES_FIRST] = g_strdup(row->text[FIELD_INITIAL]);
	symbol_row_free(symbol);
	return row;
}

/* A column of some kinds of types. */
struct shown {
	GtkColumnViewColumn *column; /* borrowed                               */
	unsigned int kinds;          /* a bit for each enum type_kind          */
};

static void show_columns(LadderTypesView *view, enum type_kind kind)
{
	for (guint i = 0; i < view->numbered->len; i++) {
		const struct shown *shown = view->numbered->pdata[i];

		list_show_column(shown->column, shown->kinds >> kind & 1);
	}
	gtk_widget_set_visible(view->members, kind == TYPE_STRUCTURE || kind == TYPE_ENUMERATION);
	gtk_widget_set_visible(gtk_widget_get_parent(GTK_WIDGET(view->declared.view)),
			       kind != TYPE_STRUCTURE && kind != TYPE_KINDS);
	for (guint i = 0; i < 4; i++) {
		static const char *const actions[] = { "types.add", "types.delete", "types.up",
						       "types.down" };

		gtk_widget_action_set_enabled(GTK_WIDGET(view), actions[i],
					      kind == TYPE_STRUCTURE || kind == TYPE_ENUMERATION);
	}
	spoken_name(GTK_WIDGET(view->list.view), kind == TYPE_ENUMERATION ? _("Values") :
						 _("Members"));
}

static void fill_rows(LadderTypesView *view)
{
	LadderDocument *document = document_of(view);
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	GPtrArray *declared = g_ptr_array_new_with_free_func(g_object_unref);
	const int type = type_of(view);
	const enum type_kind kind = kind_of(view);
	const bool fixed = type >= 0 && type_is_included(document, type);

	show_columns(view, kind);
	if (kind == TYPE_STRUCTURE)
		add_members(rows, document, type, fixed);
	else if (type >= 0)
		g_ptr_array_add(declared, declared_row(document, type, fixed));
	if (kind == TYPE_ENUMERATION)
		add_values(rows, document, type, fixed);
	panel_cells_update(&view->list, rows);
	panel_cells_update(&view->declared, declared);
	g_ptr_array_unref(declared);
	g_ptr_array_unref(rows);
}

static void fill_types(LadderTypesView *view, const struct project *project)
{
	GPtrArray *names = g_ptr_array_new();
	const int now = type_of(view);

	g_clear_pointer(&view->order, g_array_unref);
	view->order = project ? type_order(project) : g_array_new(FALSE, FALSE, sizeof(int));
	for (guint i = 0; i < view->order->len; i++)
		g_ptr_array_add(names, (gpointer)type_name(project,
							   g_array_index(view->order, int, i)));
	view->busy = true;
	drop_fill(GTK_DROP_DOWN(view->types), names);
	for (guint i = 0; i < view->order->len; i++)
		if (g_array_index(view->order, int, i) == now)
			gtk_drop_down_set_selected(GTK_DROP_DOWN(view->types), i);
	view->busy = false;
	gtk_stack_set_visible_child_name(GTK_STACK(view->stack),
					 view->order->len ? "type" : "none");
	g_ptr_array_unref(names);
}

static void set_type(LadderTypesView *view, int type)
{
	const struct project *project = ladder_document_project(document_of(view));

	g_free(view->type);
	view->type = project && type_is(project, type) ? g_strdup(type_name(project, type)) : NULL;
}

/* The number of the type at a place of the drop-down, or of the last one; -1: there is none. */
static int type_at(const struct project *project, guint at)
{
	GArray *order = type_order(project);
	const int type = order->len ? g_array_index(order, int, MIN(at, order->len - 1)) : -1;

	g_array_unref(order);
	return type;
}

static void refresh(GtkWidget *widget)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(widget);
	LadderDocument *document = document_of(view);
	const struct project *project = ladder_document_project(document);
	const guint was = gtk_drop_down_get_selected(GTK_DROP_DOWN(view->types));

	panel_message_age(&view->message, document);
	/* A renamed type keeps its place. */
	if (project && type_of(view) < 0)
		set_type(view, type_at(project, was == GTK_INVALID_LIST_POSITION ? 0 : was));
	fill_types(view, project);
	fill_rows(view);
}

void ladder_types_view_show(LadderTypesView *view, int type)
{
	if (type >= 0)
		set_type(view, type);
	refresh(GTK_WIDGET(view));
}

/* The list in which members or values are edited, else the declaration. */
static struct panel_list *list_of(LadderTypesView *view)
{
	const enum type_kind kind = kind_of(view);

	return kind == TYPE_STRUCTURE || kind == TYPE_ENUMERATION ? &view->list : &view->declared;
}

static int first_field(enum type_kind kind)
{
	return kind == TYPE_SUBRANGE ? TYPES_LOW : kind == TYPE_ARRAY || kind == TYPE_ALIAS ?
	       FIELD_TYPE : FIELD_NAME;
}

void ladder_types_view_enter(LadderTypesView *view)
{
	struct panel_list *list = list_of(view);

	if (!g_list_model_get_n_items(G_LIST_MODEL(list->selection)))
		return;
	panel_list_go(list, 0);
	cells_enter(list->view, panel_list_row(list), first_field(kind_of(view)));
}

void ladder_types_view_enter_value(LadderTypesView *view, const char *name)
{
	if (panel_list_select(&view->list, panel_row_is_named, name))
		cells_enter(view->list.view, panel_list_row(&view->list), FIELD_NAME);
}

static void type_changed(GtkDropDown *types, GParamSpec *spec, LadderTypesView *view)
{
	const guint at = gtk_drop_down_get_selected(types);

	(void)spec;
	if (view->busy || at >= view->order->len)
		return;
	set_type(view, g_array_index(view->order, int, at));
	fill_rows(view);
}

/* As type_of(), also between a change of the name and the refresh that follows it. */
static int type_now(LadderTypesView *view)
{
	if (type_of(view) < 0)
		refresh(GTK_WIDGET(view));
	return type_of(view);
}

/* ---- fields ---- */

/* The index of a row now: rows are updated with a delay. -1: deleted. */
static int index_of(LadderTypesView *view, const LadderPanelRow *row)
{
	const struct project *project = ladder_document_project(document_of(view));
	const int type = type_of(view);
	int value;

	if (!(row->flags & TYPES_VALUE))
		return symbol_find(document_of(view), row->table, panel_row_text(row, FIELD_NAME),
				   row->index);
	for (int i = 0; type >= 0 && (value = type_value(project, type, i)) >= 0; i++)
		if (strcmp(project_text(project, project->enum_value[value].name),
			   panel_row_text(row, FIELD_NAME)) == 0)
			return i;
	return -1;
}

static const char *field_name(int field)
{
	switch (field) {
	case TYPES_BASE: return _("Base type");
	case TYPES_LOW: return _("Lowest value");
	case TYPES_HIGH: return _("Highest value");
	case TYPES_NUMBER: return _("Number");
	case TYPES_FIRST: return symbol_field_name(FIELD_INITIAL);
	default: return symbol_field_name((enum field)field);
	}
}

static bool set_value(LadderTypesView *view, const LadderPanelRow *row, int field,
		      const char *text, char **why)
{
	const int type = type_now(view), index = index_of(view, row);

	return field == FIELD_NAME ?
	       type_rename_value(document_of(view), type, index, text, why) :
	       type_set_number(document_of(view), type, index, text, why);
}

static bool set_declared(LadderTypesView *view, const LadderPanelRow *row, int field,
			 const char *text, char **why)
{
	LadderDocument *document = document_of(view);
	const int type = type_now(view);

	switch (field) {
	case TYPES_BASE: return type_set_base(document, type, text, why);
	case TYPES_LOW: return type_set_bound(document, type, false, text, why);
	case TYPES_HIGH: return type_set_bound(document, type, true, text, why);
	case TYPES_FIRST: return symbol_set(document, row->table, 0, FIELD_INITIAL, text, why);
	default: return symbol_set(document, row->table, 0, (enum field)field, text, why);
	}
}

static bool set_field(GObject *owner, LadderPanelRow *row, int field, const char *text,
		      char **why)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(owner);
	const bool good = row->flags & TYPES_VALUE ? set_value(view, row, field, text, why) :
		row->flags & TYPES_DECLARED ? set_declared(view, row, field, text, why) :
		symbol_set(document_of(view), row->table, index_of(view, row), (enum field)field,
			   text, why);

	tell(view, good ? NULL : g_strdup_printf(_("%s, %s: %s"), panel_row_text(row, FIELD_NAME),
		field_name(field), why && *why ? *why : ""));
	if (good) { /* found by its name again */
		g_free(row->text[field]);
		row->text[field] = g_strstrip(g_strdup(text));
		panel_watch_later(view->watch);
	}
	return good;
}

static bool is_fixed(const LadderPanelRow *row, int field)
{
	(void)field;
	return row->flags & TYPES_FIXED;
}

static void add_choice(GPtrArray *choices, const char *text, const char *about)
{
	g_ptr_array_add(choices, g_strdup(text));
	g_ptr_array_add(choices, g_strdup(about));
}

/* Whole numbers; of an enumeration also bits, and none at all. */
static GPtrArray *base_choices(enum type_kind kind)
{
	GPtrArray *choices = g_ptr_array_new_with_free_func(g_free);

	if (kind == TYPE_ENUMERATION)
		add_choice(choices, "", iec_type_row(IEC_INT)->word);
	for (int i = IEC_NONE + 1; i < IEC_TYPE_COUNT; i++) {
		const struct iec_type_row *row = iec_type_row((enum iec_type)i);

		if (row->class & ANY_INT || (kind == TYPE_ENUMERATION && row->class & CLASS_BITS &&
					     i != IEC_BOOL))
			add_choice(choices, row->word, "");
	}
	return choices;
}

/* "": the first one. */
static GPtrArray *value_choices(LadderTypesView *view)
{
	const struct project *project = ladder_document_project(document_of(view));
	GPtrArray *choices = g_ptr_array_new_with_free_func(g_free);
	const int type = type_of(view);
	int value;

	for (int i = 0; type >= 0 && (value = type_value(project, type, i)) >= 0; i++) {
		const char *name = project_text(project, project->enum_value[value].name);

		if (!i)
			add_choice(choices, "", name);
		add_choice(choices, name, "");
	}
	return choices;
}

static GPtrArray *choices_of(GObject *owner, int field)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(owner);
	GPtrArray *choices;

	if (field == TYPES_BASE || field == TYPES_FIRST)
		return field == TYPES_BASE ? base_choices(kind_of(view)) : value_choices(view);
	choices = type_cells_choices(document_of(view), true);
	for (guint i = 0; view->type && i + 1 < choices->len; i += 2)
		if (strcmp(choices->pdata[i], view->type) == 0) { /* not in itself */
			g_ptr_array_remove_range(choices, i, 2);
			break;
		}
	return choices;
}

static void open_form(GObject *owner, LadderPanelRow *row, int field, GtkWidget *cell)
{
	type_cells_open(document_of(LADDER_TYPES_VIEW(owner)), row, field, cell);
}

/* A number that follows from the value before is dim. */
static void dress(GtkWidget *cell, const LadderPanelRow *row, int field)
{
	if (field != TYPES_NUMBER)
		return;
	style_set(cell, "dim-label", (row->flags & TYPES_IMPLICIT) != 0);
}

/* ---- members and values ---- */

static LadderPanelRow *row_here(LadderTypesView *view)
{
	int field;
	LadderPanelRow *row = cells_focused(view->list.view, &field);

	return row ? row : panel_list_row(&view->list);
}

static void add(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(widget);
	const int type = type_now(view);
	const LadderPanelRow *row = row_here(view);
	const int behind = row ? index_of(view, row) :
		(int)g_list_model_get_n_items(G_LIST_MODEL(view->list.store)) - 1;
	char *name, *why;

	(void)action;
	(void)unused;
	if (type < 0)
		return;
	if (kind_of(view) == TYPE_ENUMERATION ?
	    type_add_value(document_of(view), type, behind, &name, &why) :
	    type_add_member(document_of(view), type, behind, &name, &why)) {
		refresh(widget);
		if (panel_list_select(&view->list, panel_row_is_named, name))
			cells_enter(view->list.view, panel_list_row(&view->list), FIELD_NAME);
	}
	tell(view, why);
	g_free(name);
}

static void delete(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(widget);
	LadderPanelRow *row = type_now(view) < 0 ? NULL : row_here(view);
	char *why = NULL, *name;
	int uses;

	(void)action;
	(void)unused;
	if (!row)
		return;
	name = g_strdup(panel_row_text(row, FIELD_NAME));
	uses = (int)row->number;
	if (row->flags & TYPES_VALUE ?
	    type_delete_value(document_of(view), type_of(view), index_of(view, row), &why) :
	    symbol_delete(document_of(view), row->table, index_of(view, row), &why)) {
		refresh(widget);
	} else if (!(row->flags & TYPES_VALUE) || row->flags & TYPES_FIXED) {
		uses = 0;
	}
	if (uses) {
		g_free(why);
		why = g_strdup_printf(ngettext("“%s” is still used in %d place",
				"“%s” is still used in %d places", (gulong)uses), name, uses);
	}
	tell(view, why);
	g_free(name);
}

static void move(LadderTypesView *view, LadderPanelRow *row, int to)
{
	const int type = type_of(view), from = index_of(view, row);
	const int count = (int)g_list_model_get_n_items(G_LIST_MODEL(view->list.store));
	char *why = NULL;

	if (type < 0 || from < 0 || to < 0 || to >= count || to == from)
		return;
	if (!panel_cells_commit(view->list.view))
		return;
	g_object_ref(row);
	if (row->flags & TYPES_VALUE ? type_move_value(document_of(view), type, from, to, &why) :
				       type_move_member(document_of(view), type, from, to, &why)) {
		refresh(GTK_WIDGET(view));
		panel_list_select(&view->list, panel_row_is_named, panel_row_text(row, FIELD_NAME));
	}
	tell(view, why);
	g_object_unref(row);
}

static void move_by(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(widget);
	LadderPanelRow *row = type_now(view) < 0 ? NULL : row_here(view);

	(void)unused;
	if (row)
		move(view, row, index_of(view, row) + (strcmp(action, "types.up") == 0 ? -1 : 1));
}

static const char *name_of(gpointer view, gpointer row)
{
	(void)view;
	return is_fixed(row, FIELD_NAME) ? NULL : panel_row_text(row, FIELD_NAME);
}

static bool fits(gpointer view, gpointer row, gpointer target, bool *below)
{
	const int from = index_of(view, row), to = index_of(view, target);

	*below = to > from;
	return from >= 0 && to >= 0 && from != to;
}

static void move_to(gpointer view, gpointer row, gpointer target, bool below)
{
	(void)below;
	move(view, row, index_of(view, target));
}

static const struct row_move moving = {
	.up = "types.up", .down = "types.down", .before_cells = true,
	.name = name_of, .fits = fits, .move = move_to,
};

/* ---- the type ---- */

/* Where the value at the cursor is used, else the type. */
static void show_uses(LadderTypesView *view)
{
	int field;
	const LadderPanelRow *row = cells_focused(view->list.view, &field);
	char *name = row && row->flags & TYPES_VALUE ? g_strdup_printf("%s#%s", view->type,
		panel_row_text(row, FIELD_NAME)) : g_strdup(view->type);

	gtk_widget_activate_action(GTK_WIDGET(view), "win.show-uses", "s", name);
	g_free(name);
}

static void act_on_type(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(widget);
	const int type = type_now(view);
	const char *verb = strchr(action, '.') + 1;
	char *name;

	(void)unused;
	if (type < 0)
		return;
	if (strcmp(verb, "uses") == 0) {
		show_uses(view);
		return;
	}
	name = g_strdup_printf("win.%s", verb);
	gtk_widget_activate_action(widget, name, "s", view->type);
	g_free(name);
}

/* ---- the widget ---- */

enum {
	STRUCTURES = 1 << TYPE_STRUCTURE, ENUMERATIONS = 1 << TYPE_ENUMERATION,
	SUBRANGES = 1 << TYPE_SUBRANGE, OTHERS = 1 << TYPE_ARRAY | 1 << TYPE_ALIAS,
	EVERY = (1 << TYPE_KINDS) - 1,
};

/* A column of the rows of members and values, or of declarations. */
struct column_row { int field; unsigned int flags; int width; unsigned int kinds; };

static void add_column(LadderTypesView *view, struct panel_list *list,
		       const struct column_row *row)
{
	const GListModel *columns = gtk_column_view_get_columns(list->view);
	const guint at = g_list_model_get_n_items((GListModel *)columns);
	struct shown *shown = g_new(struct shown, 1);

	panel_cells_add(list, &view->cells, row->field, row->flags, row->width);
	shown->column = g_list_model_get_item((GListModel *)columns, at);
	shown->kinds = row->kinds;
	g_ptr_array_add(view->numbered, shown);
	g_object_unref(shown->column); /* the list has a reference */
}

static void add_columns(LadderTypesView *view)
{
	static const struct column_row members[] = {
		{ FIELD_NAME, 0, 150, EVERY }, { TYPES_NUMBER, PANEL_EXPAND, 150, ENUMERATIONS },
		{ FIELD_TYPE, 0, 210, STRUCTURES },
		{ FIELD_INITIAL, PANEL_BUTTON, 150, STRUCTURES },
		{ FIELD_COMMENT, PANEL_EXPAND, 120, STRUCTURES },
	};
	static const struct column_row declared[] = {
		{ FIELD_TYPE, 0, 270, OTHERS },
		{ TYPES_BASE, PANEL_BUTTON, 120, ENUMERATIONS | SUBRANGES },
		{ TYPES_LOW, 0, 130, SUBRANGES }, { TYPES_HIGH, 0, 130, SUBRANGES },
		{ TYPES_FIRST, PANEL_BUTTON, 150, ENUMERATIONS },
		{ FIELD_INITIAL, PANEL_BUTTON, 150, SUBRANGES | OTHERS },
		{ FIELD_COMMENT, PANEL_EXPAND, 120, EVERY },
	};

	view->cells = (struct panel_cells){ .owner = G_OBJECT(view), .name = field_name,
		.set = set_field, .is_fixed = is_fixed, .choices = choices_of,
		.open_form = open_form, .dress = dress,
		.choosable = 1u << TYPES_BASE | 1u << TYPES_FIRST,
		.completing = 1u << TYPES_BASE | 1u << TYPES_FIRST };
	type_cells_join(&view->cells);
	panel_list_column(&view->list, "", TYPES_USES, PANEL_ICON, 0);
	for (gsize i = 0; i < G_N_ELEMENTS(members); i++)
		add_column(view, &view->list, &members[i]);
	panel_list_column(&view->list, _("Uses"), TYPES_USES, PANEL_NUMBER, 60);
	panel_list_unsort(&view->list);
	panel_list_column(&view->declared, "", TYPES_USES, PANEL_ICON, 0);
	for (gsize i = 0; i < G_N_ELEMENTS(declared); i++)
		add_column(view, &view->declared, &declared[i]);
	panel_list_unsort(&view->declared);
	row_move_add(GTK_WIDGET(view->list.view), &moving, view);
}

static void dispose(GObject *object)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(object);

	g_clear_pointer(&view->watch, panel_watch_free);
	g_clear_pointer(&view->type, g_free);
	g_clear_pointer(&view->order, g_array_unref);
	g_clear_pointer(&view->numbered, g_ptr_array_unref);
	G_OBJECT_CLASS(ladder_types_view_parent_class)->dispose(object);
	panel_list_clear(&view->list);
	panel_list_clear(&view->declared);
}

static void ladder_types_view_class_init(LadderTypesViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	gtk_widget_class_install_action(widget, "types.add", NULL, add);
	gtk_widget_class_install_action(widget, "types.delete", NULL, delete);
	gtk_widget_class_install_action(widget, "types.up", NULL, move_by);
	gtk_widget_class_install_action(widget, "types.down", NULL, move_by);
	gtk_widget_class_install_action(widget, "types.rename-type", NULL, act_on_type);
	gtk_widget_class_install_action(widget, "types.duplicate-type", NULL, act_on_type);
	gtk_widget_class_install_action(widget, "types.delete-type", NULL, act_on_type);
	gtk_widget_class_install_action(widget, "types.uses", NULL, act_on_type);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/types_view.ui");
	gtk_widget_class_bind_template_child(widget, LadderTypesView, stack);
	gtk_widget_class_bind_template_child(widget, LadderTypesView, types);
	gtk_widget_class_bind_template_child(widget, LadderTypesView, members);
	gtk_widget_class_bind_template_child_full(widget, "declared", FALSE,
		G_STRUCT_OFFSET(LadderTypesView, declared.view));
	panel_bind_list(widget, LadderTypesView);
	panel_bind_message(widget, LadderTypesView);
	gtk_widget_class_bind_template_callback(widget, type_changed);
}

static void ladder_types_view_init(LadderTypesView *view)
{
	gtk_widget_init_template(GTK_WIDGET(view));
	view->numbered = g_ptr_array_new_with_free_func(g_free);
	view->order = g_array_new(FALSE, FALSE, sizeof(int));
	panel_list_init(&view->list, view->list.view);
	panel_list_init(&view->declared, view->declared.view);
	panel_message_init(&view->message, view->message.label);
	add_columns(view);
	view->watch = panel_watch_new(GTK_WIDGET(view), true, refresh);
}

GtkWidget *ladder_types_view_new(LadderDocument *document)
{
	LadderTypesView *view = g_object_new(LADDER_TYPE_TYPES_VIEW, NULL);

	panel_watch_set(view->watch, document);
	refresh(GTK_WIDGET(view));
	return GTK_WIDGET(view);
}
