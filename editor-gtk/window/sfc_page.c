/* SPDX-License-Identifier: MIT
 *
 * sfc_page - the page of a chart; see sfc_page.h.
 */
#include "editor-gtk/window/sfc_page.h"

#include "editor-gtk/document/boxed_line.h"
#include "editor-gtk/draw/sfc_bodies.h"
#include "editor-gtk/kit/gtk48/paned.h"
#include "editor-gtk/kit/gtk48/slow_bar.h"
#include "editor-gtk/window/below_part.h"

#define RUNGS_HEIGHT 180 /* px of the part below, with its heading */

struct _LadderSfcPage {
	GtkBox parent;
	LadderDocument *document;
	LadderSim *sim;
	int pou;
	gulong handler;
	GtkWidget *paned, *chart;
	struct below_part below;     /* holds @rungs or @text                  */
	char *shown;                 /* heading of the body shown in @rungs */
	GtkWidget *rungs, *text;     /* at most one of them                    */
	bool below_active;           /* @rungs or @text has the focus, or had it last */
	int back;                    /* first of the rungs that the text stands in place of; -1: none */
	int wanted;                  /* line of an EXECUTE box in them              */
	guint opening;               /* source that opens it; 0: none               */
};

G_DEFINE_FINAL_TYPE(LadderSfcPage, ladder_sfc_page, GTK_TYPE_BOX)

LadderSfcView *ladder_sfc_page_chart(LadderSfcPage *page)
{
	return LADDER_SFC_VIEW(page->chart);
}

LadderGridView *ladder_sfc_page_rungs(LadderSfcPage *page)
{
	return page->rungs ? LADDER_GRID_VIEW(page->rungs) : NULL;
}

LadderGridView *ladder_sfc_page_sheet(LadderSfcPage *page)
{
	return page->below_active ? ladder_sfc_page_rungs(page) : NULL;
}

LadderTextView *ladder_sfc_page_text(LadderSfcPage *page)
{
	return page->below_active && page->text ? LADDER_TEXT_VIEW(page->text) : NULL;
}

/* ---- the part below the chart ---- */

static void moved(LadderSfcPage *page)
{
	g_signal_emit_by_name(page->chart, "cursor-moved");
}

static void set_active(LadderSfcPage *page, bool below)
{
	if (page->below_active == below)
		return;
	page->below_active = below;
	moved(page);
}

static void chart_entered(LadderSfcPage *page)
{
	set_active(page, false);
}

static void below_entered(LadderSfcPage *page)
{
	set_active(page, true);
}

static void close_below(LadderSfcPage *page)
{
	GtkWidget *child = gtk_widget_get_first_child(GTK_WIDGET(page->below.place));

	page->rungs = page->text = NULL;
	page->below_active = false;
	page->back = -1;
	g_clear_pointer(&page->shown, g_free);
	gtk_widget_set_visible(page->below.box, FALSE);
	if (child)
		gtk_box_remove(page->below.place, child);
}

static void show_rungs(LadderSfcPage *page, int first);

/* From the statements of a box back to its rungs. */
static void close_clicked(LadderSfcPage *page)
{
	if (page->back >= 0) {
		show_rungs(page, page->back);
		return;
	}
	close_below(page);
	gtk_widget_grab_focus(page->chart);
}

/* The heading of the body whose first rung is @first; NULL: none. Caller frees. */
static char *heading_of(LadderSfcPage *page, int first, int *count)
{
	const struct project *project = ladder_document_project(page->document);
	const struct pou *pou = project && page->pou < project->pou_count ?
		&project->pou[page->pou] : NULL;

	*count = 0;
	return pou ? sfc_body_heading(project, pou, first, count) : NULL;
}

static void told(LadderSfcPage *page, const char *text)
{
	g_signal_emit_by_name(page->chart, "told", text);
}

static void put_below(LadderSfcPage *page, GtkWidget *widget, const char *heading,
		      bool scrolls)
{
	GtkWidget *child = widget;

	if (scrolls) {
		child = gtk_scrolled_window_new();
		gtk_scrolled_window_set_overlay_scrolling(GTK_SCROLLED_WINDOW(child), FALSE);
		gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(child), widget);
		slow_bar_choose(GTK_SCROLLED_WINDOW(child));
	}
	gtk_widget_set_vexpand(child, TRUE);
	gtk_box_append(page->below.place, child);
	gtk_label_set_text(page->below.heading, heading);
	gtk_widget_set_visible(page->below.box, TRUE);
}

static void show_text(LadderSfcPage *page, int line, int column);

static gboolean open_statements(gpointer data)
{
	LadderSfcPage *page = data;
	int count, back;

	page->opening = 0;
	back = page->rungs ? ladder_grid_view_range(LADDER_GRID_VIEW(page->rungs), &count) : -1;
	show_text(page, page->wanted, 5);
	page->back = back;
	return G_SOURCE_REMOVE;
}

/* The sheet that asks goes. */
static void statements_wanted(LadderSfcPage *page, int rung, int row, int col)
{
	const struct project *project = ladder_document_project(page->document);
	char *text = ladder_document_list(page->document, page->pou);

	page->wanted = text ? boxed_line(text, &project->pou[page->pou], rung, row, col) : 0;
	g_free(text);
	if (page->wanted > 0 && !page->opening)
		page->opening = g_idle_add_full(G_PRIORITY_HIGH_IDLE, open_statements, page, NULL);
}

static void show_rungs(LadderSfcPage *page, int first)
{
	int count;
	char *heading = heading_of(page, first, &count);

	close_below(page);
	if (!heading)
		return;
	page->rungs = ladder_grid_view_new(page->document, page->pou);
	ladder_grid_view_set_range(LADDER_GRID_VIEW(page->rungs), first, count);
	ladder_canvas_set_sim(LADDER_CANVAS(page->rungs), page->sim);
	g_signal_connect_swapped(page->rungs, "statements-wanted", G_CALLBACK(statements_wanted), page);
	g_signal_connect_swapped(page->rungs, "told", G_CALLBACK(told), page);
	g_signal_connect_swapped(page->rungs, "cursor-moved", G_CALLBACK(moved), page);
	below_part_follow(page->rungs, G_CALLBACK(below_entered), page);
	put_below(page, page->rungs, heading, true);
	gtk_widget_grab_focus(page->rungs);
	set_active(page, true);
	page->shown = heading;
}

/* Another name, or the action has gone. */
static void part_changed(LadderSfcPage *page)
{
	char *part = ladder_text_view_part(LADDER_TEXT_VIEW(page->text));
	const bool had_focus = page->below_active && gtk_widget_get_focus_child(GTK_WIDGET(page->below.place));

	if (part) {
		gtk_label_set_text(page->below.heading, part);
	} else {
		close_below(page);
		if (had_focus)
			gtk_widget_grab_focus(page->chart);
	}
	g_free(part);
}

static void open_text(LadderSfcPage *page)
{
	close_below(page);
	page->text = ladder_text_view_new(page->document, page->pou);
	ladder_text_view_set_sim(LADDER_TEXT_VIEW(page->text), page->sim);
	below_part_follow(page->text, G_CALLBACK(below_entered), page);
	g_signal_connect_swapped(page->text, "part-changed", G_CALLBACK(part_changed), page);
	put_below(page, page->text, "", false);
}

/* @line: of the program, from 1. Of a line in an action only the action is shown. */
static void show_text(LadderSfcPage *page, int line, int column)
{
	const bool opens = !page->text;
	LadderTextView *text;

	if (opens)
		open_text(page);
	text = LADDER_TEXT_VIEW(page->text);
	if (opens || !ladder_text_view_has(text, line))
		ladder_text_view_set_part(text, line);
	part_changed(page);
	ladder_text_view_go_here(text, line, column);
	set_active(page, true);
}

void ladder_sfc_page_show_line(LadderSfcPage *page, int line)
{
	show_text(page, line + 1, 1);
}

/* @line: of the file. */
static void show_body(LadderSfcPage *page, int line)
{
	line -= ladder_document_lines_before(page->document, page->pou);
	if (page->text)
		ladder_text_view_set_part(LADDER_TEXT_VIEW(page->text), line);
	show_text(page, line, 5);
}

static void body_wanted(LadderSfcPage *page, int first, int count)
{
	if (count > 0)
		show_rungs(page, first);
	else
		show_body(page, first);
}

/* The first rung of the body that was shown: the nearest body with its heading, else one
 * that begins at @first (it may have been renamed). The result may be no body. */
static int find_shown(LadderSfcPage *page, int first)
{
	const struct project *project = ladder_document_project(page->document);
	const struct sfc *sfc = project && page->pou < project->pou_count ?
		project->pou[page->pou].sfc : NULL;
	int best = -1, count;

	for (int i = 0; sfc && i < sfc_bodies(sfc); i++) {
		const int at = sfc_body(sfc, i)->first;
		char *heading = !sfc_body_has_rungs(sfc_body(sfc, i)) ? NULL :
				heading_of(page, at, &count);

		if (g_strcmp0(heading, page->shown) == 0 &&
		    (best < 0 || ABS(at - first) < ABS(best - first)))
			best = at;
		g_free(heading);
	}
	return best < 0 ? first : best;
}

/* The body may have other rungs now, or be deleted. */
static void project_changed(LadderSfcPage *page)
{
	int first, count, now, was;
	char *heading;

	if (!page->rungs)
		return;
	was = ladder_grid_view_range(LADDER_GRID_VIEW(page->rungs), &count);
	first = find_shown(page, was);
	heading = heading_of(page, first, &now);
	if (!heading) {
		close_below(page);
		return;
	}
	if (now != count || first != was)
		ladder_grid_view_set_range(LADDER_GRID_VIEW(page->rungs), first, now);
	gtk_label_set_text(page->below.heading, heading);
	g_free(page->shown);
	page->shown = heading;
}

void ladder_sfc_page_show_rung(LadderSfcPage *page, int rung, int row, int col)
{
	const struct project *project = ladder_document_project(page->document);
	const struct sfc *sfc = project && page->pou < project->pou_count ?
		project->pou[page->pou].sfc : NULL;

	ladder_sfc_view_go(LADDER_SFC_VIEW(page->chart), rung);
	for (int i = 0; sfc && i < sfc_bodies(sfc); i++) {
		const struct sfc_body *body = sfc_body(sfc, i);

		if (body->kind != BODY_RUNGS || rung < body->first ||
		    rung >= body->first + body->count)
			continue;
		show_rungs(page, body->first);
		if (page->rungs)
			ladder_grid_view_go(LADDER_GRID_VIEW(page->rungs),
					    rung - body->first, row, col);
		return;
	}
}

void ladder_sfc_page_set_pou(LadderSfcPage *page, int pou)
{
	if (pou == page->pou)
		return;
	page->pou = pou;
	close_below(page);
	ladder_canvas_set_pou(LADDER_CANVAS(page->chart), pou);
}

/* ---- life ---- */

static void ladder_sfc_page_dispose(GObject *object)
{
	LadderSfcPage *page = LADDER_SFC_PAGE(object);

	g_clear_handle_id(&page->opening, g_source_remove);
	if (page->document)
		g_signal_handler_disconnect(page->document, page->handler);
	g_clear_object(&page->document);
	g_clear_object(&page->sim);
	g_clear_pointer(&page->shown, g_free);
	G_OBJECT_CLASS(ladder_sfc_page_parent_class)->dispose(object);
}

static void ladder_sfc_page_class_init(LadderSfcPageClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_sfc_page_dispose;
}

static void ladder_sfc_page_init(LadderSfcPage *page)
{
	page->back = -1;
	page->paned = gtk_paned_new(GTK_ORIENTATION_VERTICAL);
	paned_mend(GTK_PANED(page->paned));
	below_part_init(&page->below, RUNGS_HEIGHT, G_CALLBACK(close_clicked), page);
	gtk_paned_set_end_child(GTK_PANED(page->paned), page->below.box);
	gtk_paned_set_resize_end_child(GTK_PANED(page->paned), FALSE);
	gtk_paned_set_shrink_end_child(GTK_PANED(page->paned), FALSE);
	gtk_widget_set_hexpand(page->paned, TRUE);
	gtk_widget_set_vexpand(page->paned, TRUE);
	gtk_box_append(GTK_BOX(page), page->paned);
}

GtkWidget *ladder_sfc_page_new(LadderDocument *document, int pou, LadderSim *sim)
{
	LadderSfcPage *page = g_object_new(LADDER_TYPE_SFC_PAGE, NULL);
	GtkWidget *scroller = gtk_scrolled_window_new();

	page->document = g_object_ref(document);
	page->sim = sim ? g_object_ref(sim) : NULL;
	page->pou = pou;
	page->chart = ladder_sfc_view_new(document, pou);
	ladder_canvas_set_sim(LADDER_CANVAS(page->chart), sim);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), page->chart);
	slow_bar_choose(GTK_SCROLLED_WINDOW(scroller));
	gtk_scrolled_window_set_overlay_scrolling(GTK_SCROLLED_WINDOW(scroller), FALSE);
	gtk_paned_set_start_child(GTK_PANED(page->paned), scroller);
	below_part_follow(page->chart, G_CALLBACK(chart_entered), page);
	g_signal_connect_swapped(page->chart, "body-wanted", G_CALLBACK(body_wanted), page);
	page->handler = g_signal_connect_swapped(document, "project-changed",
						 G_CALLBACK(project_changed), page);
	return GTK_WIDGET(page);
}
