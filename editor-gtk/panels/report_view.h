/* SPDX-License-Identifier: MIT
 *
 * report_view - the panel that tells what an import or an export did; each line leads to
 * its rung, and beside them stands the original of a rung.
 *
 * Signal: close-wanted (): the person wants it away. It opens and writes nothing.
 */
#ifndef EDITOR_REPORT_VIEW_H
#define EDITOR_REPORT_VIEW_H

#include "editor-gtk/document/classic_origin.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_REPORT_VIEW (ladder_report_view_get_type())
G_DECLARE_FINAL_TYPE(LadderReportView, ladder_report_view, LADDER, REPORT_VIEW, GtkWidget)

GtkWidget *ladder_report_view_new(LadderDocument *document);
/** ladder_report_view_import - tells what @origin does, from now on. */
void ladder_report_view_import(LadderReportView *view, LadderOrigin *origin);
/** ladder_report_view_export - tells @lines (struct left_line; a reference is kept) of the
 * writing of the file @name. */
void ladder_report_view_export(LadderReportView *view, const char *name, GPtrArray *lines);
/** ladder_report_view_has - is there anything to tell? */
bool ladder_report_view_has(LadderReportView *view);
/** ladder_report_view_title - "pump.clprj: 3 changed, 1 left out". Borrowed. */
const char *ladder_report_view_title(LadderReportView *view);
/** ladder_report_view_follow - the picture is of that rung, 0-based; -1: of none.
 * @sure: also if that came of nothing, and it says so. */
void ladder_report_view_follow(LadderReportView *view, int pou, int rung, bool sure);
/** ladder_report_view_focus - to its list. */
void ladder_report_view_focus(LadderReportView *view);
/** ladder_report_view_list - its rows (LadderPanelRow). Borrowed. */
GListModel *ladder_report_view_list(LadderReportView *view);
#endif
