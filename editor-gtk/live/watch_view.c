/* SPDX-License-Identifier: MIT
 *
 * watch_view - the status chart: its rows and cells, and what a person does to rows, charts
 * and values. Each change of a chart is one step of the document's history.
 *
 * For each scan that is shown, the value of each row is compared; only cells whose value
 * changed are set. A hidden view does nothing. A row knows its widgets while it is on screen.
 */
#include "editor-gtk/live/watch_view.h"

#include "editor-gtk/document/panel.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/drop.h"
#include "editor-gtk/kit/entry_popup.h"
#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/left.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/live/watch_names.h"
#include "editor-gtk/kit/spelling.h"

#include <string.h>

/* ---- the view ---- */

struct _LadderWatchView {
	GtkWidget parent_instance;
	/* Of the template: */
	GtkWidget *box, *charts, *add_button, *stack, *empty, *list;
	struct panel_message message;
	LadderDocument *document;
	LadderSim *sim;
	GListStore *store;          /* of LadderWatchRow                       */
	GtkSingleSelection *selection;
	GtkWidget *popup;           /* the entry of a line; NULL: none         */
	guint chart;                /* the chart that is shown, 0-based        */
	char *chart_name;           /* to find it again; NULL: there is none   */
	struct image checked;       /* of the checked program, for image_of()  */
	bool dirty;                 /* the rows are older than the charts      */
	bool busy;                  /* the drop-down is being filled           */
};

G_DEFINE_FINAL_TYPE(LadderWatchView, ladder_watch_view, GTK_TYPE_WIDGET)

/* ---- rows ---- */

/* Where names are found: the program that runs, else the document's as it was last checked.
 * NULL: there is none. */
static const struct image *image_of(LadderWatchView *view)
{
	const struct image *image = live_image(view->sim, false);
	struct ladder *checked = ladder_document_checked(view->document);

	view->checked.program = checked ? ladder_program(checked) : NULL;
	return image ? image : view->checked.program ? &view->checked : NULL;
}

static guint row_count(LadderWatchView *view)
{
	return g_list_model_get_n_items(G_LIST_MODEL(view->store));
}

static LadderWatchRow *row_at(LadderWatchView *view, guint at)
{
	return g_list_model_get_item(G_LIST_MODEL(view->store), at);
}

static int place_of(LadderWatchView *view, LadderWatchRow *row)
{
	guint at;

	return g_list_store_find(view->store, row, &at) ? (int)at : -1;
}

static int selected_index(LadderWatchView *view)
{
	const guint at = gtk_single_selection_get_selected(view->selection);

	return at == GTK_INVALID_LIST_POSITION ? -1 : (int)at;
}

static void select_row(LadderWatchView *view, int at)
{
	at = MIN(at, (int)row_count(view) - 1);
	gtk_single_selection_set_selected(view->selection, at < 0 ?
					  GTK_INVALID_LIST_POSITION : (guint)at);
	if (at >= 0)
		list_scroll_to(view->list, (guint)at);
}

/* ---- messages ---- */

static void tell(LadderWatchView *view, char *text)
{
	panel_message_set(&view->message, view->document, text);
}

/* ---- the charts of the project ---- */

static const char *shown_name(const struct watch *chart)
{
	return *chart->name ? chart->name : _("Status chart");
}

/* Those of the file; a line of an instance is a row for each of its pins. The file gets these
 * lines with the next edit. Caller: g_ptr_array_unref(). */
static GPtrArray *charts_of(LadderWatchView *view)
{
	GPtrArray *charts = watch_list_of(view->document);

	watch_names_unfold(image_of(view), charts);
	return charts;
}

static struct watch *chart_at(GPtrArray *charts, guint at)
{
	return at < charts->len ? charts->pdata[at] : NULL;
}

/* Finds the chart that was shown by its name, or else by its index. Returns it, or NULL. */
static struct watch *find_chart(LadderWatchView *view, GPtrArray *charts)
{
	struct watch *chart;

	if (view->chart >= charts->len)
		view->chart = charts->len ? charts->len - 1 : 0;
	chart = chart_at(charts, view->chart);
	for (guint i = 0; chart && g_strcmp0(chart->name, view->chart_name) != 0 &&
	     view->chart_name && i < charts->len; i++)
		if (strcmp(chart_at(charts, i)->name, view->chart_name) == 0) {
			view->chart = i;
			chart = chart_at(charts, i);
		}
	g_free(view->chart_name);
	view->chart_name = chart ? g_strdup(chart->name) : NULL;
	return chart;
}

static void fill_charts(LadderWatchView *view, GPtrArray *charts)
{
	GtkDropDown *drop = GTK_DROP_DOWN(view->charts);
	GPtrArray *names = g_ptr_array_new();

	for (guint i = 0; i < charts->len; i++)
		g_ptr_array_add(names, (gpointer)shown_name(charts->pdata[i]));
	view->busy = true;
	drop_fill(drop, names);
	if (charts->len)
		gtk_drop_down_set_selected(drop, view->chart);
	gtk_widget_set_visible(view->charts, charts->len > 0);
	view->busy = false;
	g_ptr_array_unref(names);
}

static void show_actions(LadderWatchView *view)
{
	GtkWidget *widget = GTK_WIDGET(view);
	const bool project = ladder_document_project(view->document) != NULL;
	const bool on = view->sim && ladder_sim_is_on(view->sim);
	const bool row = selected_index(view) >= 0;

	gtk_widget_action_set_enabled(widget, "watch.add", project);
	gtk_widget_action_set_enabled(widget, "watch.new-chart", project);
	gtk_widget_action_set_enabled(widget, "watch.rename-chart", view->chart_name != NULL);
	gtk_widget_action_set_enabled(widget, "watch.delete-chart", view->chart_name != NULL);
	gtk_widget_action_set_enabled(widget, "watch.remove", row);
	gtk_widget_action_set_enabled(widget, "watch.up", row);
	gtk_widget_action_set_enabled(widget, "watch.down", row);
	gtk_widget_action_set_enabled(widget, "watch.write-all", on);
}

/* ---- exchanging rows ---- */

/* Typed values that are not written yet stay with the name. */
static void keep_typed(LadderWatchView *view, GPtrArray *rows)
{
	const guint old = row_count(view);
	GHashTable *typed = g_hash_table_new(g_str_hash, g_str_equal);

	for (guint i = 0; i < old; i++) {
		LadderWatchRow *row = row_at(view, i);

		if (*row->typed)
			g_hash_table_insert(typed, row->line->name, row->typed);
		g_object_unref(row);
	}
	for (guint i = 0; i < rows->len && g_hash_table_size(typed); i++) {
		LadderWatchRow *row = rows->pdata[i];
		const char *text = g_hash_table_lookup(typed, row->line->name);

		if (text) {
			g_free(row->typed);
			row->typed = g_strdup(text);
		}
	}
	g_hash_table_unref(typed);
}

static bool stays(LadderWatchView *view, guint at, LadderWatchRow *row)
{
	LadderWatchRow *old = row_at(view, at);
	const bool same = watch_row_equal(old, row);

	g_object_unref(old);
	return same;
}

/* Equal rows at both ends are kept, and with them selection, focus and scroll position. */
static void exchange(LadderWatchView *view, GPtrArray *rows)
{
	const guint old = row_count(view);
	guint first = 0, last = 0;

	keep_typed(view, rows);
	while (first < MIN(old, rows->len) && stays(view, first, rows->pdata[first]))
		first++;
	while (last < MIN(old, rows->len) - first &&
	       stays(view, old - 1 - last, rows->pdata[rows->len - 1 - last]))
		last++;
	if (old - first - last || rows->len - first - last)
		g_list_store_splice(view->store, first, old - first - last,
				    rows->pdata + first, rows->len - first - last);
	list_mend_focus(view->list);
}

/* ---- cells ---- */

#define HEADING_ROOM 14 /* padding of a heading                                */

enum column { NAME, TYPE, FORMAT, VALUE, FRESH, FORCE, COMMENT, COLUMNS };

static const struct { const char *title; int width; } columns[COLUMNS] = {
	[NAME] = { N_("Name"), 170 }, [TYPE] = { N_("Type"), 84 },
	[FORMAT] = { N_("Shown as"), 125 }, [VALUE] = { N_("Value"), 120 },
	[FRESH] = { N_("New value"), 110 }, [FORCE] = { N_("Force"), 0 },
	[COMMENT] = { N_("Comment"), 0 },
};

static LadderWatchView *view_of(GtkWidget *cell)
{
	return LADDER_WATCH_VIEW(gtk_widget_get_ancestor(cell, LADDER_TYPE_WATCH_VIEW));
}

static void name_cell(GtkWidget *cell, const LadderWatchRow *row, enum column column)
{
	char *name = g_strdup_printf("%s, %s", row->line->name, _(columns[column].title));

	spoken_name(cell, name);
	g_free(name);
}

static void show_value(LadderWatchRow *row)
{
	char *value = watch_row_value(row);
	const char *quality = live_quality_text(row->seen.quality);
	char *text = g_strdup_printf("%s%s%s", value, *quality ? "  " : "", quality);

	style_set(row->value, "bad-quality", *quality);
	gtk_label_set_text(GTK_LABEL(row->value), text);
	tip_set(row->value, text);
	g_free(text);
	g_free(value);
}

static void show_force(LadderWatchRow *row)
{
	const bool can = row->seen.known && row->at.type != IEC_STRING && !row->at.constant;

	gtk_widget_set_sensitive(row->force, can);
	style_set(row->force, "forced", row->seen.forced);
	if (gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(row->force)) != row->seen.forced)
		gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(row->force), row->seen.forced);
}

static void show_cells(LadderWatchRow *row)
{
	if (row->value)
		show_value(row);
	if (row->force)
		show_force(row);
}

static void look(LadderWatchView *view)
{
	for (guint i = 0; i < row_count(view); i++) {
		LadderWatchRow *row = row_at(view, i);

		if (live_value_look(&row->seen, view->sim, false, row->at))
			show_cells(row);
		g_object_unref(row);
	}
}

static void refresh(LadderWatchView *view)
{
	GPtrArray *charts = charts_of(view);
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	struct watch *chart = find_chart(view, charts);

	view->dirty = false;
	fill_charts(view, charts);
	for (guint i = 0; chart && i < chart->lines->len; i++)
		g_ptr_array_add(rows, watch_row_new(chart->lines->pdata[i], image_of(view),
						    view->sim));
	exchange(view, rows);
	look(view);
	gtk_stack_set_visible_child_name(GTK_STACK(view->stack), rows->len ? "list" : "none");
	show_actions(view);
	g_ptr_array_unref(rows);
	g_ptr_array_unref(charts);
}

static void changed(LadderWatchView *view)
{
	view->dirty = true;
	if (gtk_widget_get_mapped(GTK_WIDGET(view)))
		refresh(view);
}

static void shown(LadderWatchView *view)
{
	if (!gtk_widget_get_mapped(GTK_WIDGET(view)))
		return;
	if (view->dirty)
		refresh(view);
	else
		look(view);
}

static void mapped(GtkWidget *widget)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(widget);

	GTK_WIDGET_CLASS(ladder_watch_view_parent_class)->map(widget);
	shown(view);
}

/* ---- new values and forces ---- */

/* Where the person looks. @why: NULL: nothing is wrong any more. */
static void mark(GtkWidget *cell, const char *why)
{
	if (!cell)
		return;
	style_wrong(cell, why != NULL);
	tip_set(cell, why);
}

static void refuse(LadderWatchView *view, LadderWatchRow *row, char *why)
{
	mark(row->forcing ? row->force : row->fresh, why);
	tell(view, why);
}

/* The board did not do what a person did in a row: what was typed comes back. */
static void refused(LadderWatchView *view, const struct location *at, const char *why)
{
	for (guint i = 0; i < row_count(view); i++) {
		LadderWatchRow *row = row_at(view, i);

		if (row->acted && live_value_is_same(row->at, *at)) {
			row->acted = false;
			if (row->fresh && *row->sent && !*row->typed)
				gtk_editable_set_text(GTK_EDITABLE(row->fresh), row->sent);
			refuse(view, row, g_strdup(why));
		}
		g_object_unref(row);
	}
}

/* False: what is typed is no value for the row; the message says why. */
static bool take_typed(LadderWatchView *view, LadderWatchRow *row, struct iec_text *room,
		 union iec_value *value)
{
	const struct image *image = live_image(view->sim, false);
	char *why = NULL;

	if (!image) {
		tell(view, g_strdup(_("The simulation is off.")));
		return false;
	}
	if (view->dirty)
		refresh(view);
	if (watch_row_parse(row, image, room, value, &why))
		return true;
	refuse(view, row, why);
	return false;
}

static void forget_typed(LadderWatchRow *row)
{
	g_free(row->sent);
	row->sent = row->typed;
	row->typed = g_strdup("");
	if (row->fresh)
		gtk_editable_set_text(GTK_EDITABLE(row->fresh), "");
}

static void acts(LadderWatchRow *row, bool force)
{
	row->acted = true;
	row->forcing = force;
	mark(row->fresh, NULL);
	mark(row->force, NULL);
}

/* False: the board does not allow it, and the entry says why. */
static bool may(LadderWatchView *view, LadderWatchRow *row, bool force)
{
	const char *why = view->sim ?
		ladder_sim_why_not(view->sim, force ? SIM_WISH_FORCE : SIM_WISH_SET) : NULL;

	if (why)
		refuse(view, row, g_strdup(why));
	return !why;
}

/* The new value of a row becomes its value. False: there is none, or it was refused. */
static bool write_row(LadderWatchView *view, LadderWatchRow *row)
{
	union iec_value value;
	struct iec_text room;

	row->forcing = false;
	if (!*row->typed || !take_typed(view, row, &room, &value) ||
	    !may(view, row, row->seen.forced))
		return false;
	acts(row, false);
	live_value_set(view->sim, false, row->at, value);
	forget_typed(row);
	tell(view, NULL);
	return true;
}

/* Stops at the first value that is refused. Values not written stay in their entries. */
static void write_all(LadderWatchView *view)
{
	bool good = true;

	for (guint i = 0; i < row_count(view) && good; i++) {
		LadderWatchRow *row = row_at(view, i);

		good = !*row->typed || write_row(view, row);
		g_object_unref(row);
	}
}

static void toggle_force(LadderWatchView *view, LadderWatchRow *row)
{
	union iec_value value = row->seen.value;
	struct iec_text room;

	if (!row->seen.known)
		return;
	row->forcing = true;
	if (!may(view, row, true)) {
		show_force(row);
		return;
	}
	if (row->seen.forced) {
		acts(row, true);
		live_value_release(view->sim, false, row->at);
	} else {
		row->forcing = false; /* what is wrong is what was typed */
		if (*row->typed && !take_typed(view, row, &room, &value))
			return;
		forget_typed(row);
		acts(row, true);
		live_value_force(view->sim, false, row->at, value);
	}
	tell(view, NULL);
}

/* ---- charts ---- */

/* A copy of the chart that is shown, or NULL, in *charts; to be changed and kept. */
static struct watch *edit_chart(LadderWatchView *view, GPtrArray **charts)
{
	*charts = charts_of(view);
	return chart_at(*charts, view->chart);
}

/* The same, of a row: its line, or NULL. */
static struct watch_line *edit_line(LadderWatchView *view, int at, GPtrArray **charts)
{
	struct watch *chart = edit_chart(view, charts);

	return chart && at >= 0 && at < (int)chart->lines->len ? chart->lines->pdata[at] : NULL;
}

/* @charts: taken over. */
static void keep_charts(LadderWatchView *view, GPtrArray *charts, const char *step)
{
	watch_list_keep(view->document, charts, step);
	g_ptr_array_unref(charts);
	refresh(view);
}

static bool is_taken(GPtrArray *charts, const char *name)
{
	for (guint i = 0; i < charts->len; i++)
		if (strcmp(chart_at(charts, i)->name, name) == 0)
			return true;
	return false;
}

static struct watch *add_chart(LadderWatchView *view, GPtrArray *charts)
{
	struct watch *chart;
	char *name = NULL;

	for (int number = 1; !name || is_taken(charts, name); number++) {
		g_free(name);
		name = g_strdup_printf(_("Chart %d"), number);
	}
	chart = watch_new(name);
	g_ptr_array_add(charts, chart);
	view->chart = charts->len - 1;
	g_free(view->chart_name);
	view->chart_name = name;
	return chart;
}

static void new_chart(LadderWatchView *view)
{
	GPtrArray *charts = charts_of(view);

	add_chart(view, charts);
	keep_charts(view, charts, _("New status chart"));
}

static void delete_chart(LadderWatchView *view)
{
	GPtrArray *charts;

	if (edit_chart(view, &charts))
		g_ptr_array_remove_index(charts, view->chart);
	keep_charts(view, charts, _("Delete status chart"));
}

/* ---- the entry of a line: names, or the name of a chart ---- */

enum asked { ASK_ADD, ASK_NAME, ASK_CHART };
struct ask {
	LadderWatchView *view;
	enum asked what;
	int row;             /* of ASK_NAME                                    */
};

/* Does another chart have the name? */
static bool is_of_other(LadderWatchView *view, const char *name)
{
	GPtrArray *charts = charts_of(view);
	char *plain = g_strstrip(g_strdup(name));
	const bool other = g_strcmp0(plain, view->chart_name) != 0 && is_taken(charts, plain);

	g_free(plain);
	g_ptr_array_unref(charts);
	return other;
}

static char *line_changed(void *context, const char *line, int cursor, bool *good)
{
	struct ask *ask = context;
	LadderWatchView *view = ask->view;

	if (ask->what == ASK_CHART && is_of_other(view, line)) {
		*good = false;
		return g_strdup(_("Another status chart has this name"));
	}
	if (view->popup && ask->what != ASK_CHART) /* not while the popup is made */
		watch_names_offer(view->document, image_of(view), line,
				  (gsize)(g_utf8_offset_to_pointer(line, cursor) - line),
				  LADDER_ENTRY_POPUP(view->popup));
	return NULL;
}

static void rename_row(LadderWatchView *view, int row, const char *name)
{
	GPtrArray *charts;
	struct watch_line *line = edit_line(view, row, &charts);

	if (line) {
		g_free(line->name);
		line->name = g_strdup(name);
		line->format = FORMAT_AUTO;
	}
	keep_charts(view, charts, _("Change variable in the status chart"));
}

static void rename_chart(LadderWatchView *view, const char *name)
{
	GPtrArray *charts;
	struct watch *chart = edit_chart(view, &charts);
	char *plain = g_strstrip(g_strdup(name));

	if (chart && *plain && !is_taken(charts, plain)) {
		g_free(chart->name);
		chart->name = g_strdup(plain);
		g_free(view->chart_name);
		view->chart_name = g_strdup(plain);
	}
	keep_charts(view, charts, _("Rename status chart"));
	g_free(plain);
}

static bool line_taken(void *context, const char *line)
{
	struct ask *ask = context;

	switch (ask->what) {
	case ASK_ADD: ladder_watch_view_add(ask->view, line); break;
	case ASK_NAME:
		if (*line)
			rename_row(ask->view, ask->row, line);
		break;
	case ASK_CHART:
		if (is_of_other(ask->view, line))
			return false;
		rename_chart(ask->view, line);
		break;
	}
	return true;
}

/* Called from a signal of the popup: it is freed later. */
static void line_gone(void *context)
{
	struct ask *ask = context;

	if (ask->view->popup)
		popover_drop_later(ask->view->popup);
	ask->view->popup = NULL;
	gtk_widget_grab_focus(ask->view->list);
	g_free(ask);
}

static void ask_line(LadderWatchView *view, enum asked what, int row, const char *prompt,
		     const char *text, GtkWidget *at)
{
	struct ask *ask = g_new0(struct ask, 1);
	const struct entry_popup_calls calls = {
		.changed = line_changed, .taken = line_taken, .gone = line_gone,
		.context = ask,
	};
	GdkRectangle place = { 0, 0, 1, 1 };
	double x = 0, y = 0;

	*ask = (struct ask){ .view = view, .what = what, .row = row };
	if (view->popup) {
		g_free(ask);
		return;
	}
	if (at && gtk_widget_translate_coordinates(at, GTK_WIDGET(view), 0, 0, &x, &y))
		place = (GdkRectangle){ (int)x, (int)y, gtk_widget_get_width(at),
					gtk_widget_get_height(at) };
	view->popup = ladder_entry_popup_new(GTK_WIDGET(view), prompt, text, false, &calls);
	ladder_entry_popup_ask(LADDER_ENTRY_POPUP(view->popup));
	ladder_entry_popup_show(LADDER_ENTRY_POPUP(view->popup), &place);
}

static void ask_add(LadderWatchView *view)
{
	ask_line(view, ASK_ADD, 0, _("Names and addresses, such as Motor %IW0 %Q0..7"), "",
		 view->add_button);
}

static void ask_name(LadderWatchView *view, LadderWatchRow *row)
{
	ask_line(view, ASK_NAME, place_of(view, row), _("Name or address"),
		 row->line->name, row->value ? row->value : view->list);
}

static void ask_chart(LadderWatchView *view)
{
	ask_line(view, ASK_CHART, 0, _("Name of the chart"),
		 view->chart_name ? view->chart_name : "", view->charts);
}

/* ---- rows ---- */

bool ladder_watch_view_add(LadderWatchView *view, const char *line)
{
	GPtrArray *names = watch_names_expand(image_of(view), line);
	const int selected = selected_index(view);
	GPtrArray *charts;
	struct watch *chart = edit_chart(view, &charts);
	const bool good = names->len > 0 && ladder_document_project(view->document);
	const int listed = good && chart ? watch_names_drop_listed(image_of(view), names,
		chart->lines, FORMAT_AUTO) : -1;
	int at;

	if (good && names->len == 0) {
		select_row(view, listed);
	} else if (good) {
		chart = chart ? chart : add_chart(view, charts);
		at = selected < 0 ? (int)chart->lines->len : selected + 1;
		for (guint i = 0; i < names->len; i++)
			g_ptr_array_insert(chart->lines, at + (int)i,
				watch_line_new(FORMAT_AUTO, names->pdata[i], NULL));
		watch_list_keep(view->document, charts, _("Add to the status chart"));
		refresh(view);
		select_row(view, at + (int)names->len - 1);
	}
	g_ptr_array_unref(charts);
	g_ptr_array_unref(names);
	return good;
}

static void remove_row(LadderWatchView *view)
{
	const int at = selected_index(view);
	GPtrArray *charts;

	if (edit_line(view, at, &charts))
		g_ptr_array_remove_index(chart_at(charts, view->chart)->lines, (guint)at);
	keep_charts(view, charts, _("Remove from the status chart"));
	select_row(view, at);
}

static void move_row(LadderWatchView *view, int by)
{
	const int at = selected_index(view), to = at + by;
	GPtrArray *charts;
	struct watch *chart = edit_chart(view, &charts);

	if (!chart || at < 0 || to < 0 || to >= (int)chart->lines->len) {
		g_ptr_array_unref(charts);
		return;
	}
	g_ptr_array_insert(chart->lines, to, g_ptr_array_steal_index(chart->lines,
								     (guint)at));
	keep_charts(view, charts, _("Move in the status chart"));
	select_row(view, to);
}

static void row_up(LadderWatchView *view)
{
	move_row(view, -1);
}

static void row_down(LadderWatchView *view)
{
	move_row(view, 1);
}

static void set_format(GtkWidget *widget, const char *action, GVariant *to)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(widget);
	struct watch_line *line;
	GPtrArray *charts;
	int row, format;

	(void)action;
	g_variant_get(to, "(ii)", &row, &format);
	line = edit_line(view, row, &charts);
	if (line && format >= 0 && format < FORMAT_COUNT)
		line->format = (enum live_format)format;
	keep_charts(view, charts, _("Change format in the status chart"));
}

static void set_comment(LadderWatchView *view, LadderWatchRow *row, const char *text)
{
	const int at = place_of(view, row);
	struct watch_line *line;
	GPtrArray *charts;

	if (at < 0 || strcmp(text, row->line->comment) == 0)
		return;
	line = edit_line(view, at, &charts);
	if (line) {
		g_free(line->comment);
		line->comment = g_strdup(text);
	}
	keep_charts(view, charts, _("Change comment in the status chart"));
}

static const struct {
	const char *name;
	void (*act)(LadderWatchView *view);
} actions[] = {
	{ "watch.add", ask_add },
	{ "watch.remove", remove_row },
	{ "watch.up", row_up },
	{ "watch.down", row_down },
	{ "watch.new-chart", new_chart },
	{ "watch.rename-chart", ask_chart },
	{ "watch.delete-chart", delete_chart },
	{ "watch.write-all", write_all },
};

static void do_action(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)unused;
	for (gsize i = 0; i < G_N_ELEMENTS(actions); i++)
		if (g_str_equal(actions[i].name, name))
			actions[i].act(LADDER_WATCH_VIEW(widget));
}

static void install_actions(GtkWidgetClass *class)
{
	for (gsize i = 0; i < G_N_ELEMENTS(actions); i++)
		gtk_widget_class_install_action(class, actions[i].name, NULL, do_action);
	gtk_widget_class_install_action(class, "watch.format", "(ii)", set_format);
	gtk_widget_class_add_binding_action(class, GDK_KEY_Insert, 0, "watch.add", NULL);
	gtk_widget_class_add_binding_action(class, GDK_KEY_Delete, 0, "watch.remove", NULL);
	gtk_widget_class_add_binding_action(class, GDK_KEY_Up, GDK_ALT_MASK, "watch.up",
					    NULL);
	gtk_widget_class_add_binding_action(class, GDK_KEY_Down, GDK_ALT_MASK, "watch.down",
					    NULL);
}

/* ---- what a person did in a cell ---- */

static void typed(GtkEditable *entry, GtkListItem *item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);

	if (!row)
		return;
	g_free(row->typed);
	row->typed = g_strdup(gtk_editable_get_text(entry));
	if (gtk_widget_has_css_class(GTK_WIDGET(entry), "error"))
		tell(view_of(GTK_WIDGET(entry)), NULL); /* it was about the text before */
	mark(GTK_WIDGET(entry), NULL);
}

static void typed_through(GtkEntry *entry, GtkListItem *item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);

	if (row)
		write_row(view_of(GTK_WIDGET(entry)), row);
}

static bool comment_left(GtkWidget *entry, GtkListItem *item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);
	LadderWatchView *view = view_of(entry);

	if (row && view)
		set_comment(view, row, gtk_editable_get_text(GTK_EDITABLE(entry)));
	return true;
}

/* A comment that the focus has left; its row may have another cell by then. */
struct comment {
	LadderWatchView *view;
	LadderWatchRow *row;
	char *text;
};

static gpointer note_comment(GtkWidget *entry, gpointer item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);
	const char *text = gtk_editable_get_text(GTK_EDITABLE(entry));
	LadderWatchView *view = view_of(entry);
	struct comment *comment;

	if (!row || !view || strcmp(text, row->line->comment) == 0)
		return NULL;
	comment = g_new(struct comment, 1);
	*comment = (struct comment){ g_object_ref(view), g_object_ref(row), g_strdup(text) };
	return comment;
}

static void take_comment(gpointer data)
{
	struct comment *comment = data;

	if (gtk_widget_get_root(GTK_WIDGET(comment->view)))
		set_comment(comment->view, comment->row, comment->text);
}

static void comment_free(gpointer data)
{
	struct comment *comment = data;

	g_object_unref(comment->view);
	g_object_unref(comment->row);
	g_free(comment->text);
	g_free(comment);
}

static void force_clicked(GtkButton *button, GtkListItem *item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);

	if (!row)
		return;
	show_force(row); /* the button follows the simulation, not the click */
	toggle_force(view_of(GTK_WIDGET(button)), row);
}

static void make_formats(GtkMenuButton *button, gpointer data)
{
	LadderWatchRow *row = gtk_list_item_get_item(data);
	GMenu *menu = g_menu_new();

	for (int i = 0; row && i < FORMAT_COUNT; i++) {
		GMenuItem *item;

		if (!live_format_fits((enum live_format)i, row->at.type))
			continue;
		item = g_menu_item_new(_(live_format_label((enum live_format)i)), NULL);
		g_menu_item_set_action_and_target(item, "watch.format", "(ii)",
			place_of(view_of(GTK_WIDGET(button)), row), i);
		g_menu_append_item(menu, item);
		g_object_unref(item);
	}
	gtk_menu_button_set_menu_model(button, G_MENU_MODEL(menu));
	g_object_unref(menu);
}

/* ---- widgets of cells ---- */

static GtkWidget *label_cell(const char *class)
{
	GtkWidget *label = gtk_label_new(NULL);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	if (class)
		gtk_widget_add_css_class(label, class);
	return label;
}

static GtkWidget *entry_cell(void)
{
	GtkWidget *entry = gtk_entry_new();

	gtk_entry_set_has_frame(GTK_ENTRY(entry), FALSE);
	gtk_editable_set_width_chars(GTK_EDITABLE(entry), 4);
	gtk_widget_add_css_class(entry, "field");
	return entry;
}

static GtkWidget *format_cell(GtkListItem *item)
{
	GtkWidget *button = gtk_menu_button_new();

	gtk_widget_add_css_class(button, "flat");
	gtk_widget_add_css_class(button, "watch-format");
	gtk_menu_button_set_create_popup_func(GTK_MENU_BUTTON(button), make_formats, item,
					      NULL);
	return button;
}

static GtkWidget *force_cell(void)
{
	GtkWidget *button = gtk_toggle_button_new_with_label("F");

	gtk_widget_add_css_class(button, "watch-force");
	gtk_widget_set_halign(button, GTK_ALIGN_CENTER);
	gtk_widget_set_valign(button, GTK_ALIGN_CENTER);
	return button;
}

static void setup(gpointer column, GtkListItem *item)
{
	GtkWidget *cell = NULL;

	switch ((enum column)GPOINTER_TO_INT(column)) {
	case NAME: cell = label_cell(NULL); break;
	case TYPE: cell = label_cell("dim-label"); break;
	case FORMAT: cell = format_cell(item); break;
	case VALUE: cell = label_cell("live-value"); break;
	case FRESH:
		cell = entry_cell();
		gtk_widget_add_css_class(cell, "watch-fresh");
		break;
	case COMMENT: cell = entry_cell(); break;
	case FORCE: cell = force_cell(); break;
	case COLUMNS: return;
	}
	gtk_list_item_set_child(item, cell);
}

static void bind_name(GtkWidget *cell, LadderWatchRow *row)
{
	const bool unknown = watch_row_is_unknown(row);
	char *shown = spelling_shown(row->line->name);
	char *tip = unknown ? g_strdup_printf(_("\"%s\" is not declared in the program"), shown) : NULL;

	gtk_label_set_text(GTK_LABEL(cell), shown);
	style_set(cell, "error", unknown);
	style_set(cell, "watch-unknown", unknown);
	tip_set(cell, tip ? tip : shown);
	spoken_name(cell, tip ? tip : shown);
	g_free(tip);
	g_free(shown);
}

static void bind_type(GtkWidget *cell, LadderWatchRow *row)
{
	gtk_label_set_text(GTK_LABEL(cell), row->at.type != IEC_NONE ?
			   live_named_type(row->named, row->at.type) :
			   watch_row_is_unknown(row) ? _("unknown") : "");
}

static void bind_format(GtkWidget *cell, LadderWatchRow *row)
{
	gtk_menu_button_set_label(GTK_MENU_BUTTON(cell),
				  _(live_format_label(row->line->format)));
	gtk_widget_set_visible(cell, live_format_fits(FORMAT_HEX, row->at.type) ||
			       row->line->format != FORMAT_AUTO);
	name_cell(cell, row, FORMAT);
}

static void bind_fresh(GtkWidget *cell, LadderWatchRow *row, GtkListItem *item)
{
	row->fresh = cell;
	gtk_editable_set_text(GTK_EDITABLE(cell), row->typed);
	gtk_widget_set_sensitive(cell, !row->at.constant);
	mark(cell, NULL);
	name_cell(cell, row, FRESH);
	g_signal_connect(cell, "changed", G_CALLBACK(typed), item);
	g_signal_connect(cell, "activate", G_CALLBACK(typed_through), item);
}

static void bind_comment(GtkWidget *cell, LadderWatchRow *row, GtkListItem *item)
{
	gtk_editable_set_text(GTK_EDITABLE(cell), row->line->comment);
	tip_set(cell, row->line->comment);
	name_cell(cell, row, COMMENT);
	g_signal_connect(cell, "activate", G_CALLBACK(comment_left), item);
	g_object_set_data(G_OBJECT(cell), "focus", left_connect(cell, note_comment, take_comment,
								comment_free, item));
	cells_on_take(cell, comment_left, item);
}

static void bind(gpointer column, GtkListItem *item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);
	GtkWidget *cell = gtk_list_item_get_child(item);

	switch ((enum column)GPOINTER_TO_INT(column)) {
	case NAME: bind_name(cell, row); break;
	case TYPE: bind_type(cell, row); break;
	case FORMAT: bind_format(cell, row); break;
	case VALUE:
		row->value = cell;
		show_value(row);
		break;
	case FRESH: bind_fresh(cell, row, item); break;
	case FORCE:
		row->force = cell;
		mark(cell, NULL);
		show_force(row);
		name_cell(cell, row, FORCE);
		g_signal_connect(cell, "clicked", G_CALLBACK(force_clicked), item);
		break;
	case COMMENT: bind_comment(cell, row, item); break;
	case COLUMNS: break;
	}
}

static void unbind(gpointer column, GtkListItem *item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);
	GtkWidget *cell = gtk_list_item_get_child(item);

	g_signal_handlers_disconnect_by_data(cell, item);
	if (cell == row->value)
		row->value = NULL;
	if (cell == row->fresh)
		row->fresh = NULL;
	if (cell == row->force)
		row->force = NULL;
	if (GPOINTER_TO_INT(column) == COMMENT) {
		cells_on_take(cell, NULL, NULL);
		gtk_widget_remove_controller(cell, g_object_get_data(G_OBJECT(cell),
								     "focus"));
	}
}

static void add_columns(LadderWatchView *view)
{
	for (int i = 0; i < COLUMNS; i++) {
		GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
		GtkColumnViewColumn *column;

		g_signal_connect_swapped(factory, "setup", G_CALLBACK(setup),
					 GINT_TO_POINTER(i));
		g_signal_connect_swapped(factory, "bind", G_CALLBACK(bind),
					 GINT_TO_POINTER(i));
		g_signal_connect_swapped(factory, "unbind", G_CALLBACK(unbind),
					 GINT_TO_POINTER(i));
		column = gtk_column_view_column_new(_(columns[i].title), factory);
		gtk_column_view_column_set_resizable(column, TRUE);
		gtk_column_view_column_set_expand(column, i == COMMENT);
		if (columns[i].width)
			gtk_column_view_column_set_fixed_width(column, MAX(columns[i].width,
				panel_heading_width(view->list, _(columns[i].title)) +
				HEADING_ROOM));
		gtk_column_view_append_column(GTK_COLUMN_VIEW(view->list), column);
		g_object_unref(column);
	}
}

void ladder_watch_view_show(LadderWatchView *view, const char *name)
{
	g_free(view->chart_name);
	view->chart_name = g_strdup(name);
	refresh(view);
}

/* ---- the widget ---- */

static void chart_chosen(GtkDropDown *drop, GParamSpec *spec, LadderWatchView *view)
{
	const guint at = gtk_drop_down_get_selected(drop);

	(void)spec;
	if (view->busy || !view->document || at == GTK_INVALID_LIST_POSITION)
		return;
	view->chart = at;
	g_clear_pointer(&view->chart_name, g_free);
	refresh(view);
}

static void activated(GtkColumnView *list, guint at, LadderWatchView *view)
{
	LadderWatchRow *row = row_at(view, at);

	(void)list;
	if (row)
		ask_name(view, row);
	g_clear_object(&row);
}

static gboolean dropped(LadderWatchView *view, const GValue *value)
{
	return ladder_watch_view_add(view, g_value_get_string(value));
}

static void dispose(GObject *object)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(object);

	if (view->document)
		g_signal_handlers_disconnect_by_data(view->document, view);
	if (view->sim)
		g_signal_handlers_disconnect_by_data(view->sim, view);
	if (view->selection) /* the list may live a little longer and select rows */
		g_signal_handlers_disconnect_by_data(view->selection, view);
	g_clear_pointer(&view->popup, gtk_widget_unparent);
	g_clear_pointer(&view->box, gtk_widget_unparent);
	g_clear_object(&view->selection);
	g_clear_object(&view->store);
	g_clear_object(&view->sim);
	g_clear_object(&view->document);
	g_clear_pointer(&view->chart_name, g_free);
	G_OBJECT_CLASS(ladder_watch_view_parent_class)->dispose(object);
}

static void ladder_watch_view_class_init(LadderWatchViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	widget->map = mapped;
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/watch_view.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderWatchView, name)
	CHILD(box); CHILD(charts); CHILD(add_button); CHILD(stack); CHILD(empty);
	CHILD(list);
#undef CHILD
	panel_bind_message(widget, LadderWatchView);
	gtk_widget_class_bind_template_callback(widget, chart_chosen);
	gtk_widget_class_bind_template_callback(widget, activated);
	install_actions(widget);
}

static void ladder_watch_view_init(LadderWatchView *view)
{
	GtkDropTarget *drop = gtk_drop_target_new(G_TYPE_STRING, GDK_ACTION_COPY);

	gtk_widget_init_template(GTK_WIDGET(view));
	panel_message_init(&view->message, view->message.label);
	view->store = g_list_store_new(LADDER_TYPE_WATCH_ROW);
	view->selection = gtk_single_selection_new(g_object_ref(G_LIST_MODEL(view->store)));
	gtk_single_selection_set_autoselect(view->selection, FALSE);
	gtk_single_selection_set_can_unselect(view->selection, TRUE);
	gtk_column_view_set_model(GTK_COLUMN_VIEW(view->list),
				  GTK_SELECTION_MODEL(view->selection));
	add_columns(view);
	g_signal_connect_swapped(drop, "drop", G_CALLBACK(dropped), view);
	gtk_widget_add_controller(view->stack, GTK_EVENT_CONTROLLER(drop));
}

GtkWidget *ladder_watch_view_new(LadderDocument *document, LadderSim *sim)
{
	LadderWatchView *view = g_object_new(LADDER_TYPE_WATCH_VIEW, NULL);
	static const char *const document_signals[] = {
		"project-changed", "bookmarks-changed", "checked",
	};

	view->document = g_object_ref(document);
	view->sim = g_object_ref(sim);
	for (gsize i = 0; i < G_N_ELEMENTS(document_signals); i++)
		g_signal_connect_swapped(document, document_signals[i], G_CALLBACK(changed),
					 view);
	g_signal_connect_swapped(view->selection, "notify::selected",
				 G_CALLBACK(show_actions), view);
	g_signal_connect_swapped(sim, "program-changed", G_CALLBACK(changed), view);
	g_signal_connect_swapped(sim, "state-changed", G_CALLBACK(show_actions), view);
	g_signal_connect_swapped(sim, "shown", G_CALLBACK(shown), view);
	g_signal_connect_swapped(sim, "refused", G_CALLBACK(refused), view);
	refresh(view);
	return GTK_WIDGET(view);
}
