/* SPDX-License-Identifier: MIT
 *
 * rung_page - the page of a ladder: its sheet above, and below it the statements of an EXECUTE box, or
 * the program as text, while they are edited.
 */
#ifndef EDITOR_RUNG_PAGE_H
#define EDITOR_RUNG_PAGE_H

#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/text/text_view.h"

#define LADDER_TYPE_RUNG_PAGE (ladder_rung_page_get_type())
G_DECLARE_FINAL_TYPE(LadderRungPage, ladder_rung_page, LADDER, RUNG_PAGE, GtkBox)

/** ladder_rung_page_new - around @sheet, which gets its scrolled window. @sim: referenced; NULL:
 * none. */
GtkWidget *ladder_rung_page_new(LadderDocument *document, GtkWidget *sheet, LadderSim *sim);
LadderGridView *ladder_rung_page_sheet(LadderRungPage *page);
/** ladder_rung_page_of - the page that @sheet is in; NULL: none, as below a chart. */
LadderRungPage *ladder_rung_page_of(GtkWidget *sheet);
/** ladder_rung_page_text - the text below, if it has the focus, or had it last; or NULL. */
LadderTextView *ladder_rung_page_text(LadderRungPage *page);
/** ladder_rung_page_go - opens the text below at a line of the program, counted from its heading,
 * and a column; 1-based. Of a line in a box only the box is shown. */
void ladder_rung_page_go(LadderRungPage *page, int line, int column);
/** ladder_rung_page_set_pou - the sheet shows another POU; closes the text. */
void ladder_rung_page_set_pou(LadderRungPage *page, int pou);

#endif
