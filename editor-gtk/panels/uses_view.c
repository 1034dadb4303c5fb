/* SPDX-License-Identifier: MIT
 *
 * uses_view - the cross reference as a list; see uses_view.h.
 */
#include "editor-gtk/panels/uses_view.h"

#include "editor-gtk/document/panel.h"
#include "editor-gtk/draw/place.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/spelling.h"

#include "engine/base/name.h"
#include "engine/xref/address_map.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

/* Columns of a row. */
enum { USES_NAME, USES_ADDRESS, USES_KIND, USES_PLACE, USES_TEXT };

/* The cross reference made last, reused for the same document. */
struct cache {
	struct xref xref;
	LadderDocument *document; /* only compared                               */
	const struct ladder *checked; /* source of line numbers; only compared */
	guint64 version;
};

struct maker {
	struct xref xref;
	GPtrArray *rows;
	struct place_sheet sheet;
};

static const char *kind_text(const struct xref_use *use)
{
	static const char *const text[XREF_KINDS] = {
		[XREF_DECLARED] = N_("declared"), [XREF_TYPE] = N_("type"),
		[XREF_READ] = N_("read"), [XREF_WRITTEN] = N_("written"),
		[XREF_CHANGED] = N_("changed"), [XREF_COIL] = N_("coil"),
		[XREF_SET] = N_("set"), [XREF_RESET] = N_("reset"),
		[XREF_CALLED] = N_("called"), [XREF_JUMPED] = N_("jumped to"),
		[XREF_RUN] = N_("run by a task"),
		[XREF_LEFT] = N_("left"), [XREF_ENTERED] = N_("entered"),
		[XREF_INITIAL] = N_("initial value"),
	};

	return use->target.what == XREF_UNKNOWN ? _("unknown name") : _(text[use->kind]);
}

/* ---- one row ---- */

static char *cell_text(struct maker *maker, const struct xref_use *use)
{
	char *place = place_cell(&maker->sheet, maker->xref.project, use->pou, use->rung - 1,
				 use->row - 1, use->col - 1);
	char *text = use->off ? g_strdup_printf(_("%s, off"), place) : g_strdup(place);

	g_free(place);
	return text;
}

/* Does it stand in a declaration of a global or a type? */
static bool is_in_declaration(const struct project *project, const struct xref_use *use)
{
	for (int i = 0; project->config && i < project->config->count; i++)
		if (use->slot == &project->config->entry[i].single)
			return false;
	for (int i = 0; i < project->access_count; i++)
		if (use->slot == &project->access[i].path)
			return false;
	return true;
}

static char *place_text(struct maker *maker, const struct xref_use *use)
{
	const struct project *project = maker->xref.project;
	const char *pou = use->pou < 0 ? "" :
		project_text(project, project->pou[use->pou].name);

	if (use->rung && use->row)
		return cell_text(maker, use);
	if (use->rung)
		return g_strdup_printf(_("%s, rung %d"), pou, use->rung);
	if (use->row)
		return place_line(project, use->pou, use->row - 1);
	return g_strdup(*pou ? pou : use->kind == XREF_RUN ||
			(use->kind == XREF_READ && !is_in_declaration(project, use)) ?
			_("configuration") : _("declarations"));
}

static char *address_text(struct project *project, const struct xref_target *target)
{
	const struct var *var = xref_var(project, target);
	char text[32] = "";

	if (var)
		return spelling_shown(project_text(project, var->at_text));
	if (target->what == XREF_ADDRESS)
		spelling_address(spelling_screen(), target->addr, text, sizeof(text));
	return g_strdup(text);
}

/* The table and number of a declaration that stands in one. */
static void declaration_of(const struct project *project, const struct xref_target *target,
			   int *table, int *index)
{
	const int types = project->pou_count + 1;

	if (target->what == XREF_VARIABLE) {
		*table = target->table;
		*index = target->index;
	} else if (target->what == XREF_STRUCTURE || target->what == XREF_NAMED) {
		*table = types + target->index +
			 (target->what == XREF_NAMED ? project->structure_count : 0);
		*index = 0;
	} else if (target->what == XREF_VALUE) {
		xref_value_owner(project, target->index, table, index);
	}
}

static LadderPanelRow *add_row(struct maker *maker, const struct xref_use *use)
{
	struct project *project = maker->xref.project;
	LadderPanelRow *row = ladder_panel_row_new();
	char name[3 * LIMIT_NAME + 8];

	xref_name(project, &use->target, use, name, sizeof(name));
	row->text[USES_NAME] = use->target.what == XREF_ADDRESS ? address_text(project, &use->target) :
			       g_utf8_make_valid(name, -1);
	row->text[USES_ADDRESS] = address_text(project, &use->target);
	row->text[USES_KIND] = g_strdup(kind_text(use));
	row->text[USES_PLACE] = place_text(maker, use);
	row->text[USES_TEXT] = spelling_shown(use->kind == XREF_DECLARED ? "" : xref_text(&maker->xref, use));
	row->pou = use->pou;
	row->rung = use->rung - 1;
	row->row = use->row - 1;
	row->col = use->col - 1;
	row->number = ((gint64)(row->pou + 1) << 40) + ((gint64)use->rung << 20) +
		      ((gint64)use->row << 8) + use->col;
	if (use->kind == XREF_DECLARED)
		declaration_of(project, &use->target, &row->table, &row->index);
	row->tone = use->target.what == XREF_UNKNOWN ? PANEL_ERROR : PANEL_PLAIN;
	row->spoken = g_strdup_printf("%s %s %s, %s%s%s", row->text[USES_NAME],
		row->text[USES_ADDRESS], row->text[USES_KIND], row->text[USES_PLACE],
		row->text[USES_TEXT][0] ? ". " : "", row->text[USES_TEXT]);
	g_ptr_array_add(maker->rows, row);
	return row;
}

/* ---- of one symbol ---- */

/* The use that declares "Main.Delay" or "Main:Seal"; NULL: none. */
static const struct xref_use *find_whole(struct maker *maker, const char *symbol)
{
	char name[3 * LIMIT_NAME + 8];

	for (int i = 0; i < maker->xref.count; i++) {
		const struct xref_use *use = &maker->xref.use[i];

		if (use->kind != XREF_DECLARED)
			continue;
		xref_name(maker->xref.project, &use->target, use, name, sizeof(name));
		if (name_equal(name, symbol))
			return use;
	}
	return NULL;
}

/* The use that a name in a cell means: a local before a global, also with members, as
 * Delay.Q; NULL: none. */
static const struct xref_use *find_symbol(struct maker *maker, int pou, const char *symbol)
{
	const gsize len = strcspn(symbol, ".[ ");
	const struct xref_use *found = NULL;

	for (int i = 0; i < maker->xref.count; i++) {
		const struct xref_use *use = &maker->xref.use[i];
		const bool variable = use->target.what == XREF_VARIABLE;

		if (use->kind != XREF_DECLARED || !use->slot ||
		    !name_is(project_text(maker->xref.project, *use->slot), symbol, len) ||
		    (variable && use->target.table && use->target.table != pou + 1) ||
		    (use->target.what == XREF_LABEL && use->target.table != pou + 1))
			continue;
		if (variable && use->target.table == pou + 1)
			return use;
		found = found && found->target.what == XREF_VARIABLE ? found : use;
	}
	return found;
}

static void add_symbol(struct maker *maker, int pou, const char *symbol)
{
	const struct xref_use *of = strpbrk(symbol, ".:#") ? find_whole(maker, symbol) : NULL;
	struct xref_target target = { .what = XREF_ADDRESS };

	of = of ? of : find_symbol(maker, pou, symbol);
	if (of)
		target = of->target;
	else if (iec_addr_parse(symbol, strcspn(symbol, "[ "), &target.addr) != ADDR_OK)
		return;
	for (int i = 0; i < maker->xref.count; i++)
		if (xref_touches(&maker->xref.use[i].target, &target))
			add_row(maker, &maker->xref.use[i]);
}

/* ---- symbols without uses ---- */

static guint64 key_of(const struct xref_target *target)
{
	return (guint64)target->what << 60 | (guint64)(guint32)target->table << 32 |
	       (guint32)target->index;
}

/* A bit of memory as a key. */
static gpointer bit_key(struct iec_addr addr, guint bit)
{
	return GUINT_TO_POINTER((guint)addr.area << 27 | (addr.byte * 8 + addr.bit + bit));
}

/* The bits that are used by address. */
static GHashTable *used_bits(const struct maker *maker)
{
	GHashTable *bits = g_hash_table_new(NULL, NULL);

	for (int i = 0; i < maker->xref.count; i++) {
		const struct xref_target *target = &maker->xref.use[i].target;

		for (guint k = 0; target->what == XREF_ADDRESS && k < target->addr.bits; k++)
			g_hash_table_add(bits, bit_key(target->addr, k));
	}
	return bits;
}

/* A symbol is also used if its address is used. */
static bool is_used_by_address(GHashTable *bits, const struct xref_target *target)
{
	for (guint k = 0; target->addr.area != AREA_NONE && k < target->addr.bits; k++)
		if (g_hash_table_contains(bits, bit_key(target->addr, k)))
			return true;
	return false;
}

static void add_unused(struct maker *maker)
{
	GHashTable *used = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
	GHashTable *bits = used_bits(maker);

	for (int i = 0; i < maker->xref.count; i++) {
		const struct xref_use *use = &maker->xref.use[i];
		const guint64 key = key_of(&use->target);

		if (use->kind != XREF_DECLARED && use->target.index >= 0)
			g_hash_table_add(used, g_memdup2(&key, sizeof(key)));
	}
	for (int i = 0; i < maker->xref.count; i++) {
		const struct xref_use *use = &maker->xref.use[i];
		const guint64 key = key_of(&use->target);

		if (use->kind == XREF_DECLARED && (use->target.what == XREF_VARIABLE ||
						   use->target.what == XREF_LABEL) &&
		    !g_hash_table_contains(used, &key) &&
		    !is_used_by_address(bits, &use->target))
			add_row(maker, use);
	}
	g_hash_table_unref(bits);
	g_hash_table_unref(used);
}

/* ---- what has two names ---- */

#define CLASHES_MOST 5000

static void add_double(struct maker *maker)
{
	struct address_clash *clash = g_new(struct address_clash, CLASHES_MOST);
	int count = address_map_clashes(&maker->xref, clash, CLASHES_MOST);

	for (int i = 0; i < MIN(count, CLASHES_MOST); i++) {
		const struct xref_use *a = &maker->xref.use[clash[i].a];
		const struct xref_use *b = &maker->xref.use[clash[i].b];
		char other[3 * LIMIT_NAME + 8];
		LadderPanelRow *row = add_row(maker, b);
		char *address = address_text(maker->xref.project, &a->target);

		xref_name(maker->xref.project, &a->target, a, other, sizeof(other));
		g_free(row->text[USES_TEXT]);
		row->text[USES_TEXT] = a->target.what == XREF_ADDRESS ?
			g_strdup_printf(_("also used as %s"), other) :
			g_strdup_printf(_("also used as %s (%s)"), other, address);
		row->tone = PANEL_WARNING;
		g_free(row->spoken);
		row->spoken = g_strdup_printf("%s %s. %s", row->text[USES_NAME],
			row->text[USES_ADDRESS], row->text[USES_TEXT]);
		g_free(address);
	}
	g_free(clash);
}

/* ---- all ---- */

static int by_rank(gconstpointer left, gconstpointer right)
{
	const struct xref_use *a = left, *b = right;
	const int64_t x = xref_rank(&a->target), y = xref_rank(&b->target);

	if (x != y)
		return x < y ? -1 : 1;
	if (a->pou != b->pou)
		return a->pou - b->pou;
	if (a->rung != b->rung)
		return a->rung - b->rung;
	return a->row != b->row ? a->row - b->row : a->col - b->col;
}

/* All uses, grouped by target. */
static void add_all(struct maker *maker)
{
	const gsize size = sizeof(*maker->xref.use) * (gsize)maker->xref.count;
	struct xref_use *sorted = g_memdup2(maker->xref.use, size);

	if (sorted)
		qsort(sorted, (size_t)maker->xref.count, sizeof(*sorted), by_rank);
	for (int i = 0; i < maker->xref.count; i++)
		add_row(maker, &sorted[i]);
	g_free(sorted);
}

static void cache_clear(struct cache *cache)
{
	xref_free(&cache->xref);
	cache->document = NULL;
}

static void fill_cache(struct cache *cache, LadderDocument *document)
{
	const guint64 version = ladder_document_version(document);
	const struct ladder *checked = ladder_document_checked(document);

	if (cache->document == document && cache->version == version &&
	    cache->checked == checked)
		return;
	cache_clear(cache);
	if (!xref_make(&cache->xref, ladder_document_project(document)))
		g_error("out of memory");
	cache->document = document;
	cache->checked = checked;
	cache->version = version;
}

/* Rows (LadderPanelRow) in the order of the file, names in the order of their declarations.
 * @symbol: for USES_SYMBOL, in POU @pou, else among the globals. Caller:
 * g_ptr_array_unref(). */
static GPtrArray *make_rows(struct cache *cache, LadderDocument *document, enum uses_mode mode,
			    int pou, const char *symbol)
{
	struct maker maker = { .rows = g_ptr_array_new_with_free_func(g_object_unref) };

	if (!document || !ladder_document_project(document) ||
	    (mode == USES_SYMBOL && (!symbol || !*symbol)))
		return maker.rows;
	fill_cache(cache, document);
	maker.xref = cache->xref;
	if (mode == USES_SYMBOL)
		add_symbol(&maker, pou, symbol);
	else if (mode == USES_UNUSED)
		add_unused(&maker);
	else if (mode == USES_DOUBLE)
		add_double(&maker);
	else
		add_all(&maker);
	cache->xref = maker.xref; /* its arena may have grown */
	return maker.rows;
}

/* ---- the view ---- */

enum { LOST, SIGNALS };
static guint signals[SIGNALS];

struct _LadderUsesView {
	GtkWidget parent_instance;
	GtkWidget *box, *modes, *search, *empty, *stack;
	struct panel_list list;
	struct panel_watch *watch;
	struct cache cache;
	char *symbol;
	int pou;
	bool lost;      /* the symbol was not found                            */
};

G_DEFINE_FINAL_TYPE(LadderUsesView, ladder_uses_view, GTK_TYPE_WIDGET)

static enum uses_mode mode_of(LadderUsesView *view)
{
	return (enum uses_mode)gtk_drop_down_get_selected(GTK_DROP_DOWN(view->modes));
}

/* ---- the list ---- */

static void show_empty(LadderUsesView *view)
{
	static const char *const nothing[] = {
		[USES_SYMBOL] = N_("Place the cursor on an element to see where its name is "
				   "used."),
		[USES_ALL] = N_("No symbols yet"),
		[USES_UNUSED] = N_("Every symbol is used"),
		[USES_DOUBLE] = N_("No address has two names"),
	};
	const bool rows = g_list_model_get_n_items(G_LIST_MODEL(view->list.selection));

	gtk_label_set_label(GTK_LABEL(view->empty), *view->list.wanted ?
			    _("Nothing found") : _(nothing[mode_of(view)]));
	gtk_stack_set_visible_child_name(GTK_STACK(view->stack), rows ? "list" : "none");
}

static void refresh(GtkWidget *widget)
{
	LadderUsesView *view = LADDER_USES_VIEW(widget);
	LadderDocument *document = panel_watch_document(view->watch);
	GPtrArray *rows = make_rows(&view->cache, document, mode_of(view), view->pou,
				    view->symbol);

	panel_list_update(&view->list, rows);
	view->lost = mode_of(view) == USES_SYMBOL && rows->len == 0;
	g_ptr_array_unref(rows);
	show_empty(view);
	if (view->lost)
		g_signal_emit(view, signals[LOST], 0);
}

bool ladder_uses_view_is_lost(LadderUsesView *view)
{
	return view->lost;
}

/* ---- queries ---- */

void ladder_uses_view_set_mode(LadderUsesView *view, enum uses_mode mode)
{
	gtk_drop_down_set_selected(GTK_DROP_DOWN(view->modes), mode);
}

void ladder_uses_view_set_symbol(LadderUsesView *view, int pou, const char *symbol)
{
	if (g_strcmp0(view->symbol, symbol) == 0 && view->pou == pou)
		return;
	g_free(view->symbol);
	view->symbol = g_strdup(symbol);
	view->pou = pou;
	/* at once: the cursor may move on */
	if (mode_of(view) == USES_SYMBOL)
		panel_watch_later(view->watch);
}

const char *ladder_uses_view_symbol(LadderUsesView *view)
{
	return view->symbol;
}

void ladder_uses_view_set_document(LadderUsesView *view, LadderDocument *document)
{
	if (!panel_watch_set(view->watch, document))
		return;
	cache_clear(&view->cache);
	refresh(GTK_WIDGET(view));
}

static void mode_changed(GtkDropDown *modes, GParamSpec *spec, LadderUsesView *view)
{
	(void)modes;
	(void)spec;
	if (view->watch)
		refresh(GTK_WIDGET(view));
}

static void search_changed(GtkSearchEntry *entry, LadderUsesView *view)
{
	panel_list_want(&view->list, gtk_editable_get_text(GTK_EDITABLE(entry)));
	show_empty(view);
}

static void activated(GtkColumnView *list, guint at, LadderUsesView *view)
{
	LadderPanelRow *row = g_list_model_get_item(G_LIST_MODEL(view->list.selection), at);

	(void)list;
	panel_go_to(GTK_WIDGET(view), row);
	g_clear_object(&row);
}

/* ---- the widget ---- */

static void dispose(GObject *object)
{
	LadderUsesView *view = LADDER_USES_VIEW(object);

	g_clear_pointer(&view->watch, panel_watch_free);
	g_clear_pointer(&view->box, gtk_widget_unparent);
	panel_list_clear(&view->list);
	cache_clear(&view->cache);
	g_clear_pointer(&view->symbol, g_free);
	G_OBJECT_CLASS(ladder_uses_view_parent_class)->dispose(object);
}

static void bind_children(GtkWidgetClass *class)
{
	gtk_widget_class_set_layout_manager_type(class, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(class,
		"/org/rungboard/Editor/ui/uses_view.ui");
	gtk_widget_class_bind_template_child(class, LadderUsesView, box);
	gtk_widget_class_bind_template_child(class, LadderUsesView, modes);
	gtk_widget_class_bind_template_child(class, LadderUsesView, search);
	gtk_widget_class_bind_template_child(class, LadderUsesView, empty);
	gtk_widget_class_bind_template_child(class, LadderUsesView, stack);
	panel_bind_list(class, LadderUsesView);
	gtk_widget_class_bind_template_callback(class, activated);
	gtk_widget_class_bind_template_callback(class, mode_changed);
	gtk_widget_class_bind_template_callback(class, search_changed);
}

static void ladder_uses_view_class_init(LadderUsesViewClass *class)
{
	G_OBJECT_CLASS(class)->dispose = dispose;
	signals[LOST] = g_signal_new("lost", LADDER_TYPE_USES_VIEW, G_SIGNAL_RUN_LAST, 0, NULL,
				     NULL, NULL, G_TYPE_NONE, 0);
	bind_children(GTK_WIDGET_CLASS(class));
}

static void ladder_uses_view_init(LadderUsesView *view)
{
	GtkWidget *widget = GTK_WIDGET(view);

	view->pou = -1;
	gtk_widget_init_template(widget);
	panel_list_init(&view->list, view->list.view);
	panel_list_column(&view->list, _("Symbol"), USES_NAME, 0, 180);
	panel_list_column(&view->list, _("Address"), USES_ADDRESS, 0, 90);
	panel_list_column(&view->list, _("Use"), USES_KIND, 0, 110);
	panel_list_column(&view->list, _("Place"), USES_PLACE, PANEL_NUMBER, 260);
	panel_list_column(&view->list, _("Context"), USES_TEXT, PANEL_EXPAND, 0);
	view->watch = panel_watch_new(widget, false, refresh);
	show_empty(view);
}

GtkWidget *ladder_uses_view_new(void)
{
	return g_object_new(LADDER_TYPE_USES_VIEW, NULL);
}
