/* SPDX-License-Identifier: MIT
 *
 * sfc_page - the tab of a chart: its sheet, and below it the rungs of a condition or an
 * action, or the program as text, while somebody works on them.
 */
#ifndef EDITOR_SFC_PAGE_H
#define EDITOR_SFC_PAGE_H

#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/sfc/sfc_view.h"

#define LADDER_TYPE_SFC_PAGE (ladder_sfc_page_get_type())
G_DECLARE_FINAL_TYPE(LadderSfcPage, ladder_sfc_page, LADDER, SFC_PAGE, GtkBox)

/** ladder_sfc_page_new - of POU @pou. @sim: what both show; borrowed. */
GtkWidget *ladder_sfc_page_new(LadderDocument *document, int pou, LadderSim *sim);
void ladder_sfc_page_set_pou(LadderSfcPage *page, int pou);
LadderSfcView *ladder_sfc_page_chart(LadderSfcPage *page);
/** ladder_sfc_page_rungs - those below; NULL: none are shown. */
LadderGridView *ladder_sfc_page_rungs(LadderSfcPage *page);
/** ladder_sfc_page_sheet - the same while somebody works on them; NULL: on the chart. */
LadderGridView *ladder_sfc_page_sheet(LadderSfcPage *page);
/** ladder_sfc_page_show_rung - what stands in a rung of the POU: at the chart, and below
 * if it is a body of rungs. */
void ladder_sfc_page_show_rung(LadderSfcPage *page, int rung, int row, int col);

#endif
