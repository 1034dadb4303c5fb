/* SPDX-License-Identifier: MIT
 *
 * page - what a tab of the window shows; see page.h.
 */
#include "editor-gtk/window/page.h"

#include "editor-gtk/iomap/iomap_view.h"
#include "editor-gtk/kit/gtk48/slow_bar.h"
#include "editor-gtk/panels/interface_view.h"
#include "editor-gtk/text/file_view.h"
#include "editor-gtk/window/messages.h"

/* ---- kind and name ---- */

GtkWidget *page_inside(GtkWidget *child)
{
	if (GTK_IS_BOX(child) && LADDER_IS_INTERFACE_VIEW(gtk_widget_get_first_child(child)))
		child = gtk_widget_get_last_child(child);
	if (LADDER_IS_RUNG_PAGE(child))
		return GTK_WIDGET(ladder_rung_page_sheet(LADDER_RUNG_PAGE(child)));
	return GTK_IS_SCROLLED_WINDOW(child) ?
	       gtk_scrolled_window_get_child(GTK_SCROLLED_WINDOW(child)) : child;
}

GtkWidget *page_content(AdwTabPage *page)
{
	return page ? page_inside(adw_tab_page_get_child(page)) : NULL;
}

const char *page_name(AdwTabPage *page)
{
	return g_object_get_data(G_OBJECT(page), "name");
}

void page_set_name(AdwTabPage *page, const char *name, const char *title)
{
	g_object_set_data_full(G_OBJECT(page), "name", g_strdup(name), g_free);
	adw_tab_page_set_title(page, title);
}

bool page_fits(GtkWidget *content, const struct project *project, int pou)
{
	if (project->pou[pou].sfc)
		return LADDER_IS_SFC_PAGE(content);
	if (project->pou[pou].fbd)
		return LADDER_IS_FBD_VIEW(content);
	return project->pou[pou].language == LANGUAGE_LD ? LADDER_IS_GRID_VIEW(content) :
	       LADDER_IS_TEXT_VIEW(content);
}

int page_pou(GtkWidget *content)
{
	if (LADDER_IS_CANVAS(content))
		return ladder_canvas_pou(LADDER_CANVAS(content));
	if (LADDER_IS_SFC_PAGE(content))
		return ladder_canvas_pou(LADDER_CANVAS(ladder_sfc_page_chart(LADDER_SFC_PAGE(content))));
	return ladder_text_view_pou(LADDER_TEXT_VIEW(content));
}

void page_set_pou(GtkWidget *content, int pou)
{
	if (page_pou(content) == pou)
		return;
	if (LADDER_IS_TEXT_VIEW(content))
		ladder_text_view_set_pou(LADDER_TEXT_VIEW(content), pou);
	else if (LADDER_IS_FBD_VIEW(content))
		ladder_canvas_set_pou(LADDER_CANVAS(content), pou);
	else if (LADDER_IS_GRID_VIEW(content))
		ladder_rung_page_set_pou(ladder_rung_page_of(content), pou);
	else
		ladder_sfc_page_set_pou(LADDER_SFC_PAGE(content), pou);
}

LadderSideFile *page_file(AdwTabPage *page)
{
	GtkWidget *content = page_content(page);

	return LADDER_IS_FILE_VIEW(content) ?
	       ladder_file_view_file(LADDER_FILE_VIEW(content)) : NULL;
}

/* The table of an I/O map; NULL: the page has none. */
static LadderIomapView *table_of(AdwTabPage *page)
{
	GtkWidget *content = page_content(page);
	GtkWidget *table = LADDER_IS_FILE_VIEW(content) ?
		ladder_file_view_table(LADDER_FILE_VIEW(content)) : NULL;

	return table ? LADDER_IOMAP_VIEW(table) : NULL;
}

static GtkTextBuffer *buffer_of(AdwTabPage *page)
{
	GtkWidget *content = page_content(page);

	if (LADDER_IS_TEXT_VIEW(content))
		return GTK_TEXT_BUFFER(ladder_text_view_buffer(LADDER_TEXT_VIEW(content)));
	return page_file(page) ? ladder_side_file_buffer(page_file(page)) : NULL;
}

GtkTextBuffer *page_text(AdwTabPage *page)
{
	/* the table hides the text */
	return table_of(page) && !ladder_iomap_view_is_text(table_of(page)) ? NULL :
	       buffer_of(page);
}

/* ---- signals for the window ---- */

static void moved(struct core *core)
{
	g_signal_emit_by_name(core->window, "cursor-moved");
}

static void changed(struct core *core)
{
	g_signal_emit_by_name(core->window, "place-changed");
}

static void told(struct core *core, const char *text)
{
	messages_tell(core->messages, text);
}

void page_follow(struct core *core, AdwTabPage *page)
{
	GtkTextBuffer *buffer = buffer_of(page);

	if (table_of(page))
		ladder_iomap_view_follow(table_of(page), core->sim);
	if (table_of(page))
		ladder_iomap_view_connect(table_of(page), core->link);
	if (table_of(page))
		core_connect(core, table_of(page), "turned", G_CALLBACK(changed), core,
			     G_CONNECT_SWAPPED);
	if (buffer)
		core_connect(core, buffer, "notify::cursor-position", G_CALLBACK(changed), core,
			     G_CONNECT_SWAPPED);
}

/* @view: a sheet, a chart or networks. */
static void listen(struct core *core, gpointer view)
{
	core_connect(core, view, "cursor-moved", G_CALLBACK(moved), core, G_CONNECT_SWAPPED);
	core_connect(core, view, "zoom-changed", G_CALLBACK(changed), core,
		     G_CONNECT_SWAPPED);
	core_connect(core, view, "told", G_CALLBACK(told), core, G_CONNECT_SWAPPED);
}

/* ---- making one ---- */

/* Puts what the POU declares above @child, in which @sheet is. */
static GtkWidget *with_interface(LadderDocument *document, GtkWidget *sheet, GtkWidget *child)
{
	GtkWidget *box;

	if (ladder_document_is_fixed(document))
		return child;
	box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	gtk_widget_set_vexpand(child, TRUE);
	gtk_box_append(GTK_BOX(box), ladder_interface_view_new(document, sheet));
	gtk_box_append(GTK_BOX(box), child);
	return box;
}

static GtkWidget *new_sheet(struct core *core, LadderDocument *document, int pou, LadderSim *sim)
{
	GtkWidget *sheet = ladder_grid_view_new(document, pou);

	ladder_canvas_set_sim(LADDER_CANVAS(sheet), sim);
	listen(core, sheet);
	return with_interface(document, sheet, ladder_rung_page_new(document, sheet, sim));
}

static GtkWidget *new_chart(struct core *core, LadderDocument *document, int pou, LadderSim *sim)
{
	GtkWidget *page = ladder_sfc_page_new(document, pou, sim);
	GtkWidget *chart = GTK_WIDGET(ladder_sfc_page_chart(LADDER_SFC_PAGE(page)));

	listen(core, chart);
	return with_interface(document, chart, page);
}

static GtkWidget *new_networks(struct core *core, LadderDocument *document, int pou, LadderSim *sim)
{
	GtkWidget *networks = ladder_fbd_view_new(document, pou), *scroller = gtk_scrolled_window_new();

	ladder_canvas_set_sim(LADDER_CANVAS(networks), sim);
	listen(core, networks);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), networks);
	slow_bar_make(GTK_SCROLLED_WINDOW(scroller));
	return with_interface(document, networks, scroller);
}

GtkWidget *page_new_live(struct core *core, LadderDocument *document, int pou, LadderSim *sim)
{
	const struct project *project = ladder_document_project(document);
	GtkWidget *page;

	if (project->pou[pou].language == LANGUAGE_LD)
		return new_sheet(core, document, pou, sim);
	if (project->pou[pou].fbd)
		return new_networks(core, document, pou, sim);
	if (project->pou[pou].sfc)
		return new_chart(core, document, pou, sim);
	page = ladder_text_view_new(document, pou);
	ladder_text_view_set_sim(LADDER_TEXT_VIEW(page), sim);
	return with_interface(document, page, page);
}

GtkWidget *page_new(struct core *core, LadderDocument *document, int pou)
{
	return page_new_live(core, document, pou, core->sim);
}
