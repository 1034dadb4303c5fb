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
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/row_move.h"
#include "editor-gtk/panels/type_cells.h"

#include <string.h>

/* A column behind the fields. */
enum { TYPES_USES = SYMBOL_FIELDS };
#define TYPES_FIXED 1u /* in LadderPanelRow.flags: of another file              */

struct _LadderTypesView {
	GtkBox parent_instance;
	GtkWidget *stack, *types;
	struct panel_list list;
	struct panel_cells cells;
	struct panel_watch *watch;
	char *type;             /* name of the structure that is shown; NULL: none */
	struct panel_message message;
	bool busy;              /* the drop-down is being filled: ignore its signal */
};

G_DEFINE_FINAL_TYPE(LadderTypesView, ladder_types_view, GTK_TYPE_BOX)

static LadderDocument *document_of(LadderTypesView *view)
{
	return panel_watch_document(view->watch);
}

/* The number of the structure that it shows; -1: none. */
static int type_of(LadderTypesView *view)
{
	return view->type ? type_find(document_of(view), view->type) : -1;
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

static void fill_rows(LadderTypesView *view)
{
	LadderDocument *document = document_of(view);
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	const int type = type_of(view);
	struct symbols *symbols = type >= 0 ? symbols_new(document) : NULL;
	const bool fixed = type >= 0 && type_is_included(document, type);

	for (int i = 0; symbols && i < symbols->count; i++)
		if (symbols->symbol[i].table == type_table(document, type))
			g_ptr_array_add(rows, row_of(document, &symbols->symbol[i], fixed));
	panel_cells_update(&view->list, rows);
	symbols_free(symbols);
	g_ptr_array_unref(rows);
}

static void fill_types(LadderTypesView *view, const struct project *project)
{
	GPtrArray *names = g_ptr_array_new();
	const int count = project ? project->structure_count : 0;
	const int now = type_of(view);

	for (int i = 0; i < count; i++)
		g_ptr_array_add(names, (gpointer)project_text(project,
							      project->structure[i].name));
	view->busy = true;
	drop_fill(GTK_DROP_DOWN(view->types), names);
	if (now >= 0)
		gtk_drop_down_set_selected(GTK_DROP_DOWN(view->types), (guint)now);
	view->busy = false;
	gtk_stack_set_visible_child_name(GTK_STACK(view->stack), count ? "type" : "none");
	g_ptr_array_unref(names);
}

static void set_type(LadderTypesView *view, int structure)
{
	const struct project *project = ladder_document_project(document_of(view));

	g_free(view->type);
	view->type = project && structure >= 0 && structure < project->structure_count ?
		g_strdup(project_text(project, project->structure[structure].name)) : NULL;
}

static void refresh(GtkWidget *widget)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(widget);
	LadderDocument *document = document_of(view);
	const struct project *project = ladder_document_project(document);
	const guint was = gtk_drop_down_get_selected(GTK_DROP_DOWN(view->types));

	panel_message_age(&view->message, document);
	/* A renamed structure keeps its number. */
	if (project && type_of(view) < 0)
		set_type(view, was == GTK_INVALID_LIST_POSITION ? 0 :
			 MIN((int)was, project->structure_count - 1));
	fill_types(view, project);
	fill_rows(view);
}

void ladder_types_view_show(LadderTypesView *view, int structure)
{
	if (structure >= 0)
		set_type(view, structure);
	refresh(GTK_WIDGET(view));
}

void ladder_types_view_enter(LadderTypesView *view)
{
	if (!g_list_model_get_n_items(G_LIST_MODEL(view->list.selection)))
		return;
	panel_list_go(&view->list, 0);
	cells_enter(view->list.view, panel_list_row(&view->list), FIELD_NAME);
}

static void type_changed(GtkDropDown *types, GParamSpec *spec, LadderTypesView *view)
{
	const guint at = gtk_drop_down_get_selected(types);

	(void)spec;
	if (view->busy || at == GTK_INVALID_LIST_POSITION)
		return;
	set_type(view, (int)at);
	fill_rows(view);
}

/* ---- fields ---- */

/* The index of a row now: rows are updated with a delay. -1: deleted. */
static int index_of(LadderTypesView *view, const LadderPanelRow *row)
{
	return symbol_find(document_of(view), row->table, panel_row_text(row, FIELD_NAME),
			   row->index);
}

static const char *field_name(int field)
{
	return symbol_field_name((enum field)field);
}

static bool set_field(GObject *owner, LadderPanelRow *row, int field, const char *text,
		      char **why)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(owner);
	const bool good = symbol_set(document_of(view), row->table, index_of(view, row),
				     (enum field)field, text, why);

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

static GPtrArray *choices_of(GObject *owner, int field)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(owner);
	GPtrArray *choices = type_cells_choices(document_of(view), true);

	(void)field;
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

/* ---- members ---- */

static LadderPanelRow *row_here(LadderTypesView *view)
{
	int field;
	LadderPanelRow *row = cells_focused(view->list.view, &field);

	return row ? row : panel_list_row(&view->list);
}

static void add(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(widget);
	const int type = type_of(view);
	const LadderPanelRow *row = row_here(view);
	char *name, *why;

	(void)action;
	(void)unused;
	if (type < 0)
		return;
	if (type_add_member(document_of(view), type, row ? index_of(view, row) :
			    (int)g_list_model_get_n_items(G_LIST_MODEL(view->list.store)) - 1,
			    &name, &why)) {
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
	LadderPanelRow *row = row_here(view);
	char *why = NULL, *name;
	int uses;

	(void)action;
	(void)unused;
	if (!row)
		return;
	name = g_strdup(panel_row_text(row, FIELD_NAME));
	uses = (int)row->number;
	if (symbol_delete(document_of(view), row->table, index_of(view, row), &why)) {
		refresh(widget);
		if (uses)
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
	if (type_move_member(document_of(view), type, from, to, &why)) {
		refresh(GTK_WIDGET(view));
		panel_list_select(&view->list, panel_row_is_named, panel_row_text(row, FIELD_NAME));
	}
	tell(view, why);
	g_object_unref(row);
}

static void move_by(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(widget);
	LadderPanelRow *row = row_here(view);

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

/* ---- the structure ---- */

static void act_on_type(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(widget);
	const int type = type_of(view);
	const char *verb = strchr(action, '.') + 1;
	char *name;

	(void)unused;
	if (type < 0)
		return;
	if (strcmp(verb, "uses") == 0) {
		gtk_widget_activate_action(widget, "win.show-uses", "s", view->type);
		return;
	}
	name = g_strdup_printf("win.%s", verb);
	gtk_widget_activate_action(widget, name, "s", view->type);
	g_free(name);
}

/* ---- the widget ---- */

static void add_columns(LadderTypesView *view)
{
	static const struct { enum field field; int width; } column[] = {
		{ FIELD_NAME, 150 }, { FIELD_TYPE, 210 }, { FIELD_INITIAL, 150 },
		{ FIELD_COMMENT, 120 },
	};

	view->cells = (struct panel_cells){ .owner = G_OBJECT(view), .name = field_name,
		.set = set_field, .is_fixed = is_fixed, .choices = choices_of,
		.open_form = open_form };
	type_cells_join(&view->cells);
	panel_list_column(&view->list, "", TYPES_USES, PANEL_ICON, 0);
	for (gsize i = 0; i < G_N_ELEMENTS(column); i++)
		panel_cells_add(&view->list, &view->cells, (int)column[i].field,
				column[i].field == FIELD_COMMENT ? PANEL_EXPAND :
				column[i].field == FIELD_INITIAL ? PANEL_BUTTON : 0,
				column[i].width);
	panel_list_column(&view->list, _("Uses"), TYPES_USES, PANEL_NUMBER, 60);
	panel_list_unsort(&view->list);
	row_move_add(GTK_WIDGET(view->list.view), &moving, view);
}

static void dispose(GObject *object)
{
	LadderTypesView *view = LADDER_TYPES_VIEW(object);

	g_clear_pointer(&view->watch, panel_watch_free);
	g_clear_pointer(&view->type, g_free);
	G_OBJECT_CLASS(ladder_types_view_parent_class)->dispose(object);
	panel_list_clear(&view->list);
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
	panel_bind_list(widget, LadderTypesView);
	panel_bind_message(widget, LadderTypesView);
	gtk_widget_class_bind_template_callback(widget, type_changed);
}

static void ladder_types_view_init(LadderTypesView *view)
{
	gtk_widget_init_template(GTK_WIDGET(view));
	panel_list_init(&view->list, view->list.view);
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
