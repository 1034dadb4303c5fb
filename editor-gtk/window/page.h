/* SPDX-License-Identifier: MIT
 *
 * page - what a tab of the window holds: a sheet, a chart, a list, a file beside the project,
 * symbols or the welcome page.
 *
 * A page knows its POU by name, since numbers change when a POU comes or goes.
 */
#ifndef EDITOR_PAGE_H
#define EDITOR_PAGE_H

#include "editor-gtk/document/side_file.h"
#include "editor-gtk/text/text_view.h"
#include "editor-gtk/window/core.h"
#include "editor-gtk/window/sfc_page.h"

/** page_new - a sheet, a chart or a list of POU @pou of @document, in what scrolls it. Its
 * messages and the moves of its cursor go to the window. */
GtkWidget *page_new(struct core *core, LadderDocument *document, int pou);
/** page_inside - the widget that @child scrolls; else @child. */
GtkWidget *page_inside(GtkWidget *child);
/** page_content - what a page shows, inside of scrolling; NULL of NULL. */
GtkWidget *page_content(AdwTabPage *page);
/** page_name - the POU's name; a blank and a word for a page that is of no POU. Borrowed. */
const char *page_name(AdwTabPage *page);
void page_set_name(AdwTabPage *page, const char *name, const char *title);
/** page_fits - can @content show that POU? */
bool page_fits(GtkWidget *content, const struct project *project, int pou);
/** page_pou - the number of the POU that @content shows. */
int page_pou(GtkWidget *content);
void page_set_pou(GtkWidget *content, int pou);
/** page_file - the file beside the project that it shows; NULL: it shows none. Borrowed. */
LadderSideFile *page_file(AdwTabPage *page);
/** page_text - what the text in it holds, of a program or a file; NULL: it has no text that
 * can be seen. Borrowed. */
GtkTextBuffer *page_text(AdwTabPage *page);
/** page_follow - the window is told when the cursor of its text moves. */
void page_follow(struct core *core, AdwTabPage *page);

#endif
