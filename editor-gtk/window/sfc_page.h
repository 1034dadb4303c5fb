/* SPDX-License-Identifier: MIT
 *
 * sfc_page - the page of a chart: its sheet above, and below it the rungs of a condition or
 * action, or the program as text, while they are edited.
 */
#ifndef EDITOR_SFC_PAGE_H
#define EDITOR_SFC_PAGE_H

#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/sfc/sfc_view.h"
#include "editor-gtk/text/text_view.h"

#define LADDER_TYPE_SFC_PAGE (ladder_sfc_page_get_type())
G_DECLARE_FINAL_TYPE(LadderSfcPage, ladder_sfc_page, LADDER, SFC_PAGE, GtkBox)

/** ladder_sfc_page_new - for POU @pou. @sim: referenced; NULL: none. */
GtkWidget *ladder_sfc_page_new(LadderDocument *document, int pou, LadderSim *sim);
void ladder_sfc_page_set_pou(LadderSfcPage *page, int pou);
LadderSfcView *ladder_sfc_page_chart(LadderSfcPage *page);
/** ladder_sfc_page_rungs - the rungs below; NULL: none are shown. */
LadderGridView *ladder_sfc_page_rungs(LadderSfcPage *page);
/** ladder_sfc_page_sheet - the rungs below if they are active; NULL: the chart is. */
LadderGridView *ladder_sfc_page_sheet(LadderSfcPage *page);
/** ladder_sfc_page_text - the text below, if it has the focus, or had it last; or NULL. */
LadderTextView *ladder_sfc_page_text(LadderSfcPage *page);
/** ladder_sfc_page_show_line - shows the text of the chart below it, with the cursor in line @line,
 * from 0, of it. */
void ladder_sfc_page_show_line(LadderSfcPage *page, int line);
/** ladder_sfc_page_show_rung - goes to a rung of the POU in the chart, and opens it below
 * if it belongs to a body of rungs. */
void ladder_sfc_page_show_rung(LadderSfcPage *page, int rung, int row, int col);

#endif
