/* SPDX-License-Identifier: MIT
 *
 * chart_page - the tab of a chart: its sheet, and below it the rungs of a condition or an
 * action, or the program as text, while somebody works on them.
 */
#ifndef EDITOR_CHART_PAGE_H
#define EDITOR_CHART_PAGE_H

#include "editor-gtk/grid_view_live.h"
#include "editor-gtk/sfc_view.h"

#define LADDER_TYPE_CHART_PAGE (ladder_chart_page_get_type())
G_DECLARE_FINAL_TYPE(LadderChartPage, ladder_chart_page, LADDER, CHART_PAGE, GtkBox)

/** ladder_chart_page_new - of POU @pou. @sim: what both show; borrowed. */
GtkWidget *ladder_chart_page_new(LadderDocument *document, int pou, LadderSim *sim);
void ladder_chart_page_set_pou(LadderChartPage *page, int pou);
LadderSfcView *ladder_chart_page_chart(LadderChartPage *page);
/** ladder_chart_page_rungs - those below; NULL: none are shown. */
LadderGridView *ladder_chart_page_rungs(LadderChartPage *page);
/** ladder_chart_page_show_rung - what stands in a rung of the POU: at the chart, and below
 * if it is a body of rungs. */
void ladder_chart_page_show_rung(LadderChartPage *page, int rung, int row, int col);

#endif
