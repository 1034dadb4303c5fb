/* SPDX-License-Identifier: MIT
 *
 * symbols_view - the table of all symbols; see symbols_view.h.
 */
#include "editor-gtk/panels/symbols_view.h"

#include "editor-gtk/document/csv.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/spelled.h"
#include "editor-gtk/document/panel_cells.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/drop.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/panels/import_dialog.h"
#include "editor-gtk/panels/type_cells.h"
#include "engine/base/name.h"

#include <string.h>

#define FILE_MOST (64 << 20) /* bytes of a table that can be imported          */

/* Columns of a row after its fields, which have their own numbers. */
enum { SYMBOLS_SCOPE = SYMBOL_FIELDS, SYMBOLS_USES, SYMBOLS_ACCESS };
/* LadderPanelRow.flags, beside SYMBOL_KINDS. */
enum { SYMBOLS_FIXED = 1, SYMBOLS_MEMBER = 2, SYMBOLS_EXPORTS = 1 << 20, SYMBOLS_ACCESS_AT = 21 };

#define CHECKS (1u << FIELD_RETAIN | 1u << FIELD_CONSTANT)

struct _LadderSymbolsView {
	GtkWidget parent_instance;
	GtkWidget *box, *scopes, *kind, *access, *search, *columns;
	struct panel_list list;
	struct panel_cells cells;
	struct panel_watch *watch;
	GtkFileChooserNative *chooser;
	int table;              /* the table that is shown; -1: all            */
	char *scope;            /* its symbol_table_name(); NULL: all           */
	GArray *found;          /* struct found_symbol                          */
	int tables;             /* of the project when it was shown             */
	struct panel_message message;
	bool busy;              /* a drop-down is being filled: ignore its signal */
	bool turning;           /* the kind of the symbol is being changed     */
};

/* A hit of a search. */
struct found_symbol {
	int table, index;
	bool now;               /* the current one                              */
	char *text;             /* what stands there                            */
};

#define FOUND_NOW (1u << 31) /* beside a bit for each field with a hit          */

G_DEFINE_FINAL_TYPE(LadderSymbolsView, ladder_symbols_view, GTK_TYPE_WIDGET)

/* ---- messages ---- */

/* @text: taken over; NULL: clears the message. */
static void tell(LadderSymbolsView *view, char *text)
{
	panel_message_set(&view->message, panel_watch_document(view->watch), text);
}

/* @table: -1: all. */
static void set_table(LadderSymbolsView *view, int table)
{
	LadderDocument *document = panel_watch_document(view->watch);

	view->table = table;
	g_free(view->scope);
	view->scope = table < 0 || !document ? NULL : symbol_table_name(document, table);
}

/* ---- rows ---- */

static char *spoken(const struct symbol_row *symbol, const char *error)
{
	GString *text = g_string_new(symbol->text[FIELD_NAME]);

	for (int i = FIELD_TYPE; i < SYMBOL_FIELDS; i++) {
		if (!*symbol->text[i])
			continue;
		g_string_append_printf(text, ", %s", i == FIELD_RETAIN ||
			i == FIELD_CONSTANT ? symbol_field_name(i) : symbol->text[i]);
	}
	g_string_append_printf(text, ", %s, ", *symbol->scope ? symbol->scope :
			       _("global"));
	if (symbol->access != SYMBOL_KEPT)
		g_string_append_printf(text, "%s, ", access_word(symbol->access == SYMBOL_WRITE));
	g_string_append_printf(text, ngettext("%d use", "%d uses", (gulong)symbol->uses),
			       symbol->uses);
	if (error)
		g_string_append_printf(text, ". %s", error);
	return g_string_free(text, FALSE);
}

/* The scope, and the kind in a block: "Motor VAR_OUTPUT". */
static char *scope_of(const struct symbol_row *symbol)
{
	const uint16_t kind = symbol->flags & SYMBOL_KINDS;

	if (!*symbol->scope)
		return g_strdup(_("global"));
	return kind ? g_strdup_printf("%s %s", symbol->scope, vars_head(kind)) :
		      g_strdup(symbol->scope);
}

static LadderPanelRow *row_of(LadderDocument *document, const struct symbol_row *symbol)
{
	LadderPanelRow *row = ladder_panel_row_new();
	bool warning = false;

	for (int i = 0; i < SYMBOL_FIELDS; i++)
		row->text[i] = i == FIELD_ADDRESS ? spelled_shown(document, symbol->text[i]) :
			       g_strdup(symbol->text[i]);
	row->text[SYMBOLS_SCOPE] = scope_of(symbol);
	row->text[SYMBOLS_USES] = g_strdup_printf("%d", symbol->uses);
	row->text[SYMBOLS_ACCESS] = symbol_access_text(document, symbol, symbol->access);
	row->number = symbol->uses;
	row->table = symbol->table;
	row->index = symbol->index;
	row->flags = (symbol->included ? SYMBOLS_FIXED : 0u) |
		     (symbol->member ? SYMBOLS_MEMBER : 0u) |
		     (symbol->exports && !symbol->foreign ? SYMBOLS_EXPORTS : 0u) |
		     (unsigned)symbol->access << SYMBOLS_ACCESS_AT |
		     (symbol->flags & SYMBOL_KINDS) | (symbol->included ? 0u :
		      type_cells_flags(document, symbol->table, symbol->index));
	row->note = symbol_error(document, symbol, &warning);
	row->tone = !row->note ? PANEL_PLAIN : warning ? PANEL_WARNING : PANEL_ERROR;
	row->spoken = spoken(symbol, row->note);
	return row;
}

/* The table has another number after a POU before it is new, and another name after a change of
 * the name alone. */
static void follow_table(LadderSymbolsView *view, const struct project *project)
{
	const int tables = project ? project->pou_count + project->structure_count : -1;
	int now = view->table;

	if (!project)
		return;
	if (view->scope) {
		now = symbol_table_find(panel_watch_document(view->watch), view->scope);
		set_table(view, now < 0 && tables == view->tables ? view->table : now);
	}
	view->tables = tables;
}

static void fill_scopes(LadderSymbolsView *view, struct project *project)
{
	GPtrArray *name = g_ptr_array_new();

	g_ptr_array_add(name, (gpointer)_("All symbols"));
	g_ptr_array_add(name, (gpointer)_("Global"));
	for (int i = 0; project && i < project->pou_count; i++)
		g_ptr_array_add(name, (gpointer)project_text(project,
							     project->pou[i].name));
	for (int i = 0; project && i < project->structure_count; i++)
		g_ptr_array_add(name, (gpointer)(project->structure[i].name ?
			project_text(project, project->structure[i].name) : "STRUCT"));
	view->busy = true;
	drop_fill(GTK_DROP_DOWN(view->scopes), name);
	gtk_drop_down_set_selected(GTK_DROP_DOWN(view->scopes), (guint)(view->table + 1));
	view->busy = false;
	g_ptr_array_unref(name);
}

/* In the order of the drop-down. */
static const uint16_t kinds[] = { 0, VAR_INPUT, VAR_OUTPUT, VAR_IN_OUT, VAR_TEMP };

/* Shows the kind of the selected symbol. Globals and members of structures have none. */
static void show_kind(LadderSymbolsView *view)
{
	const LadderPanelRow *row = panel_list_row(&view->list);
	guint at = 0;

	if (view->turning) /* hiding it now would drop the focus */
		return;
	for (guint i = 1; row && i < G_N_ELEMENTS(kinds); i++)
		at = row->flags & kinds[i] ? i : at;
	view->busy = true;
	gtk_drop_down_set_selected(GTK_DROP_DOWN(view->kind), at);
	view->busy = false;
	gtk_widget_set_visible(view->kind, row && row->table > 0 &&
			       !(row->flags & (SYMBOLS_FIXED | SYMBOLS_MEMBER)));
	view->busy = true;
	gtk_drop_down_set_selected(GTK_DROP_DOWN(view->access), row ?
				   row->flags >> SYMBOLS_ACCESS_AT & 3 : 0);
	view->busy = false;
	gtk_widget_set_visible(view->access, row && row->flags & SYMBOLS_EXPORTS &&
			       !(row->flags & SYMBOLS_FIXED));
}

/* ---- hits of a search ---- */

static unsigned int found_in(const LadderPanelRow *row)
{
	return GPOINTER_TO_UINT(g_object_get_data(G_OBJECT(row), "found"));
}

static void dress(GtkWidget *cell, const LadderPanelRow *row, int field)
{
	const bool found = found_in(row) >> field & 1;
	const bool now = found_in(row) & FOUND_NOW;

	style_set(cell, "found", found && !now);
	style_set(cell, "found-now", found && now);
}

/* The fields of a row that have the text of its hits. */
static unsigned int fields_found(LadderSymbolsView *view, const LadderPanelRow *row)
{
	unsigned int fields = 0;

	for (guint i = 0; i < view->found->len; i++) {
		const struct found_symbol *found = &g_array_index(view->found, struct found_symbol, i);

		if (found->table != row->table || found->index != row->index)
			continue;
		fields |= found->now ? FOUND_NOW : 0u;
		for (int field = 0; field < SYMBOL_FIELDS; field++)
			if (strstr(panel_row_text(row, field), found->text))
				fields |= 1u << field;
	}
	return fields;
}

static void mark_rows(LadderSymbolsView *view)
{
	GListModel *rows = G_LIST_MODEL(view->list.store);

	for (guint i = 0; i < g_list_model_get_n_items(rows); i++) {
		LadderPanelRow *row = g_list_model_get_item(rows, i);
		const unsigned int fields = view->found->len ? fields_found(view, row) : 0;

		if (fields != found_in(row)) {
			g_object_set_data(G_OBJECT(row), "found", GUINT_TO_POINTER(fields));
			g_signal_emit_by_name(row, "changed");
		}
		g_object_unref(row);
	}
}

static void clear_found(gpointer found)
{
	g_free(((struct found_symbol *)found)->text);
}

void ladder_symbols_view_set_found(LadderSymbolsView *view, const struct find_seen *seen)
{
	const struct find_hit *hit;
	int at = 0;
	bool now;

	g_array_set_size(view->found, 0);
	for (int pou = -1; pou < view->tables; pou++, at = 0)
		while ((hit = find_seen_next(seen, pou, &at, &now)) != NULL) {
			const struct found_symbol found = { hit->table, hit->index, now,
				g_strndup(hit->text + hit->at, hit->len) };

			if (hit->where == FIND_DECLARATIONS)
				g_array_append_val(view->found, found);
			else
				g_free(found.text);
		}
	mark_rows(view);
}

static void fill_rows(LadderSymbolsView *view)
{
	LadderDocument *document = panel_watch_document(view->watch);
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	struct symbols *symbols = document ? symbols_new(document) : NULL;

	for (int i = 0; symbols && i < symbols->count; i++)
		if (view->table < 0 || symbols->symbol[i].table == view->table)
			g_ptr_array_add(rows, row_of(document, &symbols->symbol[i]));
	panel_cells_update(&view->list, rows);
	mark_rows(view);
	show_kind(view);
	symbols_free(symbols);
	g_ptr_array_unref(rows);
}

static void refresh(GtkWidget *widget)
{
	LadderSymbolsView *view = LADDER_SYMBOLS_VIEW(widget);
	LadderDocument *document = panel_watch_document(view->watch);

	panel_message_age(&view->message, document);
	follow_table(view, document ? ladder_document_project(document) : NULL);
	fill_scopes(view, document ? ladder_document_project(document) : NULL);
	fill_rows(view);
}

static bool is_symbol(const LadderPanelRow *row, gconstpointer what)
{
	const int *place = what;

	return row->table == place[0] && row->index == place[1];
}

bool ladder_symbols_view_show(LadderSymbolsView *view, int table, int index)
{
	const int place[] = { table, index };

	if (view->table >= 0 && view->table != table)
		set_table(view, -1);
	refresh(GTK_WIDGET(view));
	if (panel_list_select(&view->list, is_symbol, place))
		return true;
	gtk_editable_set_text(GTK_EDITABLE(view->search), "");
	panel_list_want(&view->list, "");
	return panel_list_select(&view->list, is_symbol, place);
}

void ladder_symbols_view_enter(LadderSymbolsView *view)
{
	LadderPanelRow *row = panel_list_row(&view->list);

	if (row)
		cells_enter(view->list.view, row, FIELD_NAME);
}

/* ---- edits ---- */

/* The current index: rows are updated with a delay, and RETAIN moves a declaration. -1:
 * deleted. */
static int index_of(LadderDocument *document, const LadderPanelRow *row)
{
	return symbol_find(document, row->table, panel_row_text(row, FIELD_NAME), row->index);
}

static const char *field_name(int field)
{
	return field == SYMBOLS_ACCESS ? _("Access") : symbol_field_name((enum field)field);
}

/* Names the other symbols at the same address. */
static char *told_of(LadderDocument *document, const LadderPanelRow *row, int field)
{
	const char *other = field == FIELD_ADDRESS ?
		symbol_beside(document, row->table, index_of(document, row)) : NULL;

	return other ? g_strdup_printf(_("%s, %s: %s has the same address"),
		panel_row_text(row, FIELD_NAME), field_name(field), other) : NULL;
}

static bool set_field(GObject *owner, LadderPanelRow *row, int field, const char *text,
		      char **why)
{
	LadderSymbolsView *view = LADDER_SYMBOLS_VIEW(owner);
	LadderDocument *document = panel_watch_document(view->watch);
	const int index = index_of(document, row);
	const bool good = field == SYMBOLS_ACCESS ?
		symbol_set_access_text(document, row->table, index, text, why) :
		symbol_set(document, row->table, index, (enum field)field, text, why);

	tell(view, good ? told_of(document, row, field) : g_strdup_printf(_("%s, %s: %s"),
		panel_row_text(row, FIELD_NAME), field_name(field), why && *why ? *why : ""));
	if (good) { /* Found by name again, also after an undo. */
		g_free(row->text[field]);
		row->text[field] = g_strstrip(g_strdup(text));
		panel_watch_later(view->watch);
	}
	return good;
}

static int last_index(LadderDocument *document, int table, const char *name)
{
	struct symbols *symbols = symbols_new(document);
	int index = -1;

	for (int i = 0; i < symbols->count; i++)
		if (symbols->symbol[i].table == table &&
		    name_equal(symbols->symbol[i].text[FIELD_NAME], name))
			index = symbols->symbol[i].index;
	symbols_free(symbols);
	return index;
}

/* The new symbol has the kind of the selected one; default BOOL. */
static void add(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderSymbolsView *view = LADDER_SYMBOLS_VIEW(widget);
	LadderDocument *document = panel_watch_document(view->watch);
	LadderPanelRow *row = panel_list_row(&view->list);
	const int table = row ? row->table : MAX(view->table, 0);
	const char *text[SYMBOL_FIELDS] = { "", "BOOL", "", "", "", "", "" };
	char *name, *why = NULL;

	(void)action;
	(void)unused;
	if (!document || !ladder_document_project(document))
		return;
	name = symbol_free_name(document, table, row ? panel_row_text(row, FIELD_NAME) :
				_("Symbol"));
	text[FIELD_NAME] = name;
	if (row)
		text[FIELD_TYPE] = panel_row_text(row, FIELD_TYPE);
	if (symbol_add(document, table, row ? row->flags & SYMBOL_KINDS : 0, text, &why) &&
	    ladder_symbols_view_show(view, table, last_index(document, table, name)))
		ladder_symbols_view_enter(view);
	tell(view, why);
	g_free(name);
}

static void kind_changed(GtkDropDown *drop, GParamSpec *spec, LadderSymbolsView *view)
{
	const guint at = gtk_drop_down_get_selected(drop);
	LadderPanelRow *row = view->watch ? panel_list_row(&view->list) : NULL;
	LadderDocument *document;
	char *name, *why = NULL;
	int table;

	(void)spec;
	if (view->busy || !row || at >= G_N_ELEMENTS(kinds) ||
	    (row->flags & SYMBOL_KINDS) == kinds[at])
		return;
	document = panel_watch_document(view->watch);
	table = row->table;
	name = g_strdup(panel_row_text(row, FIELD_NAME));
	view->turning = true;
	if (symbol_set_kind(document, table, index_of(document, row), kinds[at], &why))
		ladder_symbols_view_show(view, table, last_index(document, table, name));
	view->turning = false;
	show_kind(view);
	tell(view, why ? g_strdup_printf(_("%s: %s"), name, why) : NULL);
	g_free(name);
	g_free(why);
}

static void access_changed(GtkDropDown *drop, GParamSpec *spec, LadderSymbolsView *view)
{
	const guint at = gtk_drop_down_get_selected(drop);
	LadderPanelRow *row = view->watch ? panel_list_row(&view->list) : NULL;
	char *name, *why = NULL;
	int table;

	(void)spec;
	if (view->busy || !row || at > SYMBOL_WRITE ||
	    (row->flags >> SYMBOLS_ACCESS_AT & 3) == at)
		return;
	table = row->table;
	name = g_strdup(panel_row_text(row, FIELD_NAME));
	view->turning = true;
	if (symbol_set_access(panel_watch_document(view->watch), table,
			      index_of(panel_watch_document(view->watch), row),
			      (enum symbol_access)at, &why))
		ladder_symbols_view_show(view, table,
			last_index(panel_watch_document(view->watch), table, name));
	view->turning = false;
	show_kind(view);
	tell(view, why ? g_strdup_printf(_("%s: %s"), name, why) : NULL);
	g_free(name);
	g_free(why);
}

static void delete(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderSymbolsView *view = LADDER_SYMBOLS_VIEW(widget);
	LadderDocument *document = panel_watch_document(view->watch);
	LadderPanelRow *row = panel_list_row(&view->list);
	char *why = NULL;

	(void)action;
	(void)unused;
	if (!row)
		return;
	if (symbol_delete(document, row->table, index_of(document, row), &why))
		refresh(widget);
	tell(view, why);
}

static void show_uses(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderPanelRow *row = panel_list_row(&LADDER_SYMBOLS_VIEW(widget)->list);
	const char *scope;
	char *name;

	(void)action;
	(void)unused;
	if (!row)
		return;
	scope = panel_row_text(row, SYMBOLS_SCOPE);
	name = row->table ? g_strdup_printf("%.*s.%s", (int)strcspn(scope, " "), scope,
					    panel_row_text(row, FIELD_NAME)) :
	       g_strdup(panel_row_text(row, FIELD_NAME));
	gtk_widget_activate_action(widget, "win.show-uses", "s", name);
	g_free(name);
}

/* ---- tables ---- */

GtkWidget *ladder_symbols_view_import(LadderSymbolsView *view, const char *from,
				      const char *text, gsize len)
{
	LadderDocument *document = panel_watch_document(view->watch);
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(view));
	GtkWidget *dialog;

	if (!document)
		return NULL;
	dialog = ladder_import_dialog_new(csv_plan_new(document, text, len), from);
	if (GTK_IS_WINDOW(root))
		gtk_window_set_transient_for(GTK_WINDOW(dialog), GTK_WINDOW(root));
	gtk_window_present(GTK_WINDOW(dialog));
	return dialog;
}

static void import_file(LadderSymbolsView *view, const char *path)
{
	GError *error = NULL;
	gsize len;
	char *text = disk_read(path, FILE_MOST, &len, &error);
	char *name = g_path_get_basename(path);

	if (text)
		ladder_symbols_view_import(view, name, text, len);
	else
		tell(view, g_strdup(error->message));
	g_clear_error(&error);
	g_free(text);
	g_free(name);
}

static void chosen(GtkNativeDialog *dialog, int response, LadderSymbolsView *view)
{
	GFile *file = response == GTK_RESPONSE_ACCEPT ?
		gtk_file_chooser_get_file(GTK_FILE_CHOOSER(dialog)) : NULL;
	char *path = file ? g_file_get_path(file) : NULL;

	if (path)
		import_file(view, path);
	g_free(path);
	g_clear_object(&file);
	g_clear_object(&view->chooser);
}

static void import(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderSymbolsView *view = LADDER_SYMBOLS_VIEW(widget);
	GtkRoot *root = gtk_widget_get_root(widget);
	GtkFileFilter *filter;

	(void)action;
	(void)unused;
	if (view->chooser || !panel_watch_document(view->watch))
		return;
	view->chooser = gtk_file_chooser_native_new(_("Import symbols"),
		GTK_IS_WINDOW(root) ? GTK_WINDOW(root) : NULL, GTK_FILE_CHOOSER_ACTION_OPEN,
		_("_Open"), NULL);
	filter = gtk_file_filter_new();
	gtk_file_filter_set_name(filter, _("Tables (CSV)"));
	gtk_file_filter_add_suffix(filter, "csv");
	gtk_file_filter_add_suffix(filter, "txt");
	gtk_file_chooser_add_filter(GTK_FILE_CHOOSER(view->chooser), filter);
	g_object_unref(filter);
	panel_choose_beside(view->chooser, panel_watch_document(view->watch));
	g_signal_connect(view->chooser, "response", G_CALLBACK(chosen), view);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(view->chooser));
}

/* ---- the widget ---- */

static void scope_changed(GtkDropDown *scopes, GParamSpec *spec, LadderSymbolsView *view)
{
	(void)spec;
	if (view->busy || !view->watch)
		return;
	set_table(view, (int)gtk_drop_down_get_selected(scopes) - 1);
	fill_rows(view); /* changing the scopes within their own signal would recurse */
}

static void search_changed(GtkSearchEntry *entry, LadderSymbolsView *view)
{
	panel_list_want(&view->list, gtk_editable_get_text(GTK_EDITABLE(entry)));
}

void ladder_symbols_view_set_document(LadderSymbolsView *view, LadderDocument *document)
{
	if (!panel_watch_set(view->watch, document))
		return;
	set_table(view, -1);
	refresh(GTK_WIDGET(view));
}

static void dispose(GObject *object)
{
	LadderSymbolsView *view = LADDER_SYMBOLS_VIEW(object);

	g_clear_pointer(&view->watch, panel_watch_free);
	if (view->chooser)
		gtk_native_dialog_destroy(GTK_NATIVE_DIALOG(view->chooser));
	g_clear_object(&view->chooser);
	g_clear_pointer(&view->box, gtk_widget_unparent);
	panel_list_clear(&view->list);
	g_clear_pointer(&view->scope, g_free);
	g_clear_pointer(&view->found, g_array_unref);
	G_OBJECT_CLASS(ladder_symbols_view_parent_class)->dispose(object);
}

static void bind_children(GtkWidgetClass *class)
{
	gtk_widget_class_set_layout_manager_type(class, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(class,
		"/org/rungboard/Editor/ui/symbols_view.ui");
	gtk_widget_class_bind_template_child(class, LadderSymbolsView, box);
	gtk_widget_class_bind_template_child(class, LadderSymbolsView, scopes);
	gtk_widget_class_bind_template_child(class, LadderSymbolsView, kind);
	gtk_widget_class_bind_template_child(class, LadderSymbolsView, access);
	gtk_widget_class_bind_template_child(class, LadderSymbolsView, search);
	gtk_widget_class_bind_template_child(class, LadderSymbolsView, columns);
	panel_bind_list(class, LadderSymbolsView);
	panel_bind_message(class, LadderSymbolsView);
	gtk_widget_class_bind_template_callback(class, scope_changed);
	gtk_widget_class_bind_template_callback(class, kind_changed);
	gtk_widget_class_bind_template_callback(class, access_changed);
	gtk_widget_class_bind_template_callback(class, search_changed);
}

static void ladder_symbols_view_class_init(LadderSymbolsViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	gtk_widget_class_install_action(widget, "symbols.add", NULL, add);
	gtk_widget_class_install_action(widget, "symbols.delete", NULL, delete);
	gtk_widget_class_install_action(widget, "symbols.import", NULL, import);
	gtk_widget_class_install_action(widget, "symbols.uses", NULL, show_uses);
	bind_children(widget);
}

/* With the name that operators have for it already. */
static GPtrArray *access_choices(LadderSymbolsView *view, const LadderPanelRow *row)
{
	static const char *const about[] = {
		[SYMBOL_KEPT] = N_("No access for operators"),
		[SYMBOL_READ] = N_("A name for operators"),
		[SYMBOL_WRITE] = N_("Operators may write it"),
	};
	GPtrArray *choices = g_ptr_array_new_with_free_func(g_free);
	LadderDocument *document = panel_watch_document(view->watch);
	struct symbols *symbols = symbols_new(document);
	const int index = row ? index_of(document, row) : -1;

	for (int i = 0; i < symbols->count; i++) {
		const struct symbol_row *symbol = &symbols->symbol[i];

		if (index < 0 || symbol->table != row->table || symbol->index != index)
			continue;
		for (int access = SYMBOL_KEPT; access <= SYMBOL_WRITE; access++) {
			g_ptr_array_add(choices, symbol_access_text(document, symbol,
						(enum symbol_access)access));
			g_ptr_array_add(choices, g_strdup(_(about[access])));
		}
	}
	symbols_free(symbols);
	return choices;
}

static GPtrArray *choices_of(GObject *owner, int field)
{
	LadderSymbolsView *view = LADDER_SYMBOLS_VIEW(owner);
	const LadderPanelRow *row = panel_list_row(&view->list);

	return field == SYMBOLS_ACCESS ? access_choices(view, row) :
	       type_cells_choices(panel_watch_document(view->watch),
				  row && row->flags & SYMBOLS_MEMBER);
}

static void open_form(GObject *owner, LadderPanelRow *row, int field, GtkWidget *cell)
{
	type_cells_open(panel_watch_document(LADDER_SYMBOLS_VIEW(owner)->watch), row, field,
			cell);
}

static bool is_fixed(const LadderPanelRow *row, int field)
{
	if (row->flags & SYMBOLS_FIXED)
		return true;
	if (field == SYMBOLS_ACCESS)
		return !(row->flags & SYMBOLS_EXPORTS);
	return row->flags & SYMBOLS_MEMBER &&
	       ((CHECKS >> field & 1) || field == FIELD_ADDRESS);
}

static void add_columns(LadderSymbolsView *view)
{
	static const struct { enum field field; int width; } column[] = {
		{ FIELD_NAME, 150 }, { FIELD_TYPE, 110 }, { FIELD_ADDRESS, 90 },
		{ FIELD_INITIAL, 120 }, { FIELD_RETAIN, 0 }, { FIELD_CONSTANT, 0 },
		{ FIELD_COMMENT, 180 },
	};
	static const int leaving[] = { SYMBOLS_USES, SYMBOLS_ACCESS, FIELD_CONSTANT, FIELD_RETAIN,
				       SYMBOLS_SCOPE, FIELD_INITIAL };

	view->cells = (struct panel_cells){ .owner = G_OBJECT(view), .checks = CHECKS,
		.name = field_name, .set = set_field, .is_fixed = is_fixed,
		.choices = choices_of, .open_form = open_form, .dress = dress };
	type_cells_join(&view->cells);
	view->cells.choosable |= 1u << SYMBOLS_ACCESS;
	panel_list_column(&view->list, "", SYMBOLS_USES, PANEL_ICON, 0);
	for (gsize i = 0; i < G_N_ELEMENTS(column); i++)
		panel_cells_add(&view->list, &view->cells, (int)column[i].field,
				column[i].field == FIELD_COMMENT ? PANEL_EXPAND :
				column[i].field == FIELD_INITIAL ? PANEL_BUTTON : 0,
				column[i].width);
	panel_list_column(&view->list, _("Scope"), SYMBOLS_SCOPE, 0, 150);
	panel_cells_add(&view->list, &view->cells, SYMBOLS_ACCESS, 0, 150);
	panel_list_column(&view->list, _("Uses"), SYMBOLS_USES, PANEL_NUMBER, 60);
	panel_list_may_leave(&view->list, leaving, G_N_ELEMENTS(leaving),
			     GTK_MENU_BUTTON(view->columns));
}

/* The labels are translated. */
static void fill_kinds(LadderSymbolsView *view)
{
	GPtrArray *name = g_ptr_array_new();

	for (guint i = 0; i < G_N_ELEMENTS(kinds); i++)
		g_ptr_array_add(name, (gpointer)vars_head(kinds[i]));
	view->busy = true;
	drop_fill(GTK_DROP_DOWN(view->kind), name);
	g_ptr_array_set_size(name, 0);
	g_ptr_array_add(name, (gpointer)_("No access for operators"));
	g_ptr_array_add(name, (gpointer)access_word(false));
	g_ptr_array_add(name, (gpointer)access_word(true));
	drop_fill(GTK_DROP_DOWN(view->access), name);
	view->busy = false;
	g_ptr_array_unref(name);
}

static void ladder_symbols_view_init(LadderSymbolsView *view)
{
	GtkWidget *widget = GTK_WIDGET(view);

	view->table = -1;
	gtk_widget_init_template(widget);
	view->found = g_array_new(FALSE, FALSE, sizeof(struct found_symbol));
	g_array_set_clear_func(view->found, clear_found);
	panel_list_init(&view->list, view->list.view);
	panel_message_init(&view->message, view->message.label);
	add_columns(view);
	fill_kinds(view);
	panel_list_follow(&view->list, G_CALLBACK(show_kind), view);
	show_kind(view);
	view->watch = panel_watch_new(widget, true, refresh);
}

GtkWidget *ladder_symbols_view_new(void)
{
	return g_object_new(LADDER_TYPE_SYMBOLS_VIEW, NULL);
}
