/* SPDX-License-Identifier: MIT
 *
 * page - what a tab of the window shows: a sheet, a chart, a list, a file beside the
 * project, the symbols or the welcome page.
 *
 * A page knows its POU by name, because indices change when a POU is added or deleted.
 */
#ifndef EDITOR_PAGE_H
#define EDITOR_PAGE_H

#include "editor-gtk/fbd/fbd_view.h"
#include "editor-gtk/document/side_file.h"
#include "editor-gtk/text/text_view.h"
#include "editor-gtk/window/core.h"
#include "editor-gtk/window/rung_page.h"
#include "editor-gtk/window/sfc_page.h"
#include "editor-gtk/window/shown_page.h"

/** page_new - a sheet, a chart or a list for POU @pou of @document, in a scrolled window if
 * it needs one. Its messages and cursor moves go to the window. */
GtkWidget *page_new(struct core *core, LadderDocument *document, int pou);
/** page_new_live - the same with the values of @sim instead of those of the window. */
GtkWidget *page_new_live(struct core *core, LadderDocument *document, int pou, LadderSim *sim);
/** page_inside - the sheet, chart … in @child, without the scrolled window around it and the
 * interface above it. */
GtkWidget *page_inside(GtkWidget *child);
/** page_content - the widget that a page shows, without its scrolled window; NULL of NULL. */
GtkWidget *page_content(AdwTabPage *page);
/** page_name - the name of the POU; " " and a word for other pages. Borrowed. */
const char *page_name(AdwTabPage *page);
void page_set_name(AdwTabPage *page, const char *name, const char *title);
/** page_fits - is @content of the kind that shows this POU? */
bool page_fits(GtkWidget *content, const struct project *project, int pou);
/** page_pou - the index of the POU that @content shows. */
int page_pou(GtkWidget *content);
void page_set_pou(GtkWidget *content, int pou);
/** page_file - the file beside the project that the page shows; NULL: none. Borrowed. */
LadderSideFile *page_file(AdwTabPage *page);
/** page_text - the visible text of a program or a file; NULL: none. Borrowed. */
GtkTextBuffer *page_text(AdwTabPage *page);
/** page_follow - the window gets a signal when the text cursor of the page moves. */
void page_follow(struct core *core, AdwTabPage *page);

#endif
