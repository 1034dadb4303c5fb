/* SPDX-License-Identifier: MIT
 *
 * rung_page - the page of a ladder; see rung_page.h.
 */
#include "editor-gtk/window/rung_page.h"

#include "editor-gtk/document/boxed_line.h"
#include "editor-gtk/kit/gtk48/slow_bar.h"
#include "editor-gtk/window/below_part.h"

#define TEXT_HEIGHT 220 /* px of the text below, with its heading           */

struct _LadderRungPage {
	GtkBox parent;
	LadderDocument *document;
	LadderSim *sim;
	GtkWidget *sheet;
	struct below_part below;
	GtkWidget *text;      /* NULL: closed                                  */
	bool below_active;    /* the part that had the focus last              */
};

G_DEFINE_FINAL_TYPE(LadderRungPage, ladder_rung_page, GTK_TYPE_BOX)

LadderGridView *ladder_rung_page_sheet(LadderRungPage *page)
{
	return LADDER_GRID_VIEW(page->sheet);
}

LadderRungPage *ladder_rung_page_of(GtkWidget *sheet)
{
	GtkWidget *page = gtk_widget_get_ancestor(sheet, LADDER_TYPE_RUNG_PAGE);

	return page ? LADDER_RUNG_PAGE(page) : NULL;
}

LadderTextView *ladder_rung_page_text(LadderRungPage *page)
{
	return page->below_active && page->text ? LADDER_TEXT_VIEW(page->text) : NULL;
}

static void set_active(LadderRungPage *page, bool below)
{
	if (page->below_active == below)
		return;
	page->below_active = below;
	g_signal_emit_by_name(page->sheet, "cursor-moved");
}

static void sheet_entered(LadderRungPage *page)
{
	set_active(page, false);
}

static void below_entered(LadderRungPage *page)
{
	set_active(page, true);
}

static void close_below(LadderRungPage *page)
{
	gtk_widget_set_visible(page->below.box, FALSE);
	if (page->text)
		gtk_box_remove(page->below.place, page->text);
	page->text = NULL;
	set_active(page, false);
}

static void close_clicked(LadderRungPage *page)
{
	close_below(page);
	gtk_widget_grab_focus(page->sheet);
}

/* Another name, or the box has gone. */
static void part_changed(LadderRungPage *page)
{
	char *part = ladder_text_view_part(LADDER_TEXT_VIEW(page->text));
	const bool had_focus = page->below_active && gtk_widget_get_focus_child(GTK_WIDGET(page->below.place));

	if (part) {
		gtk_label_set_text(page->below.heading, part);
	} else {
		close_below(page);
		if (had_focus)
			gtk_widget_grab_focus(page->sheet);
	}
	g_free(part);
}

static void open_text(LadderRungPage *page)
{
	page->text = ladder_text_view_new(page->document,
					  ladder_canvas_pou(LADDER_CANVAS(page->sheet)));
	ladder_text_view_set_sim(LADDER_TEXT_VIEW(page->text), page->sim);
	below_part_follow(page->text, G_CALLBACK(below_entered), page);
	g_signal_connect_swapped(page->text, "part-changed", G_CALLBACK(part_changed), page);
	gtk_widget_set_vexpand(page->text, TRUE);
	gtk_box_append(page->below.place, page->text);
	gtk_widget_set_visible(page->below.box, TRUE);
}

void ladder_rung_page_go(LadderRungPage *page, int line, int column)
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

static void statements_wanted(LadderRungPage *page, int rung, int row, int col)
{
	const struct project *project = ladder_document_project(page->document);
	const int pou = ladder_canvas_pou(LADDER_CANVAS(page->sheet));
	char *text = ladder_document_list(page->document, pou);
	const int line = text ? boxed_line(text, &project->pou[pou], rung, row, col) : 0;

	g_free(text);
	if (page->text && line > 0)
		ladder_text_view_set_part(LADDER_TEXT_VIEW(page->text), line);
	ladder_rung_page_go(page, line > 0 ? line : 1, 5);
}

void ladder_rung_page_set_pou(LadderRungPage *page, int pou)
{
	close_below(page);
	ladder_canvas_set_pou(LADDER_CANVAS(page->sheet), pou);
}

static void ladder_rung_page_dispose(GObject *object)
{
	LadderRungPage *page = LADDER_RUNG_PAGE(object);

	g_clear_object(&page->document);
	g_clear_object(&page->sim);
	G_OBJECT_CLASS(ladder_rung_page_parent_class)->dispose(object);
}

static void ladder_rung_page_class_init(LadderRungPageClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_rung_page_dispose;
}

static void ladder_rung_page_init(LadderRungPage *page)
{
	gtk_orientable_set_orientation(GTK_ORIENTABLE(page), GTK_ORIENTATION_VERTICAL);
	below_part_init(&page->below, TEXT_HEIGHT, G_CALLBACK(close_clicked), page);
	gtk_box_prepend(GTK_BOX(page->below.box), gtk_separator_new(GTK_ORIENTATION_HORIZONTAL));
	gtk_widget_set_vexpand(page->below.box, FALSE);
}

GtkWidget *ladder_rung_page_new(LadderDocument *document, GtkWidget *sheet, LadderSim *sim)
{
	LadderRungPage *page = g_object_new(LADDER_TYPE_RUNG_PAGE, NULL);
	GtkWidget *scroller = gtk_scrolled_window_new();

	page->document = g_object_ref(document);
	page->sim = sim ? g_object_ref(sim) : NULL;
	page->sheet = sheet;
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), sheet);
	slow_bar_make(GTK_SCROLLED_WINDOW(scroller));
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_box_append(GTK_BOX(page), scroller);
	gtk_box_append(GTK_BOX(page), page->below.box);
	below_part_follow(sheet, G_CALLBACK(sheet_entered), page);
	g_signal_connect_swapped(sheet, "statements-wanted", G_CALLBACK(statements_wanted), page);
	return GTK_WIDGET(page);
}
