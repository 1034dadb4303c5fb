/* SPDX-License-Identifier: MIT
 *
 * report_view - the report of an import from or export to ClassicLadder. A line leads to
 * its rung; beside the list is the original of a rung.
 *
 * Signal: close-wanted (): close the panel. It opens and writes no file.
 */
#ifndef EDITOR_REPORT_VIEW_H
#define EDITOR_REPORT_VIEW_H

#include "editor-gtk/document/classic_origin.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_REPORT_VIEW (ladder_report_view_get_type())
G_DECLARE_FINAL_TYPE(LadderReportView, ladder_report_view, LADDER, REPORT_VIEW, GtkWidget)

GtkWidget *ladder_report_view_new(LadderDocument *document);
/** ladder_report_view_import - shows the import of @origin. */
void ladder_report_view_import(LadderReportView *view, LadderOrigin *origin);
/** ladder_report_view_export - shows @lines (struct left_line; a reference is kept) of the
 * export to the file @name. */
void ladder_report_view_export(LadderReportView *view, const char *name, GPtrArray *lines);
/** ladder_report_view_has - is there a report? */
bool ladder_report_view_has(LadderReportView *view);
/** ladder_report_view_title - "pump.clprj: 3 changed, 1 left out". Borrowed. */
const char *ladder_report_view_title(LadderReportView *view);
/** ladder_report_view_follow - shows the original of that rung, 0-based, or that it has none;
 * -1: shows nothing. */
void ladder_report_view_follow(LadderReportView *view, int pou, int rung);
/** ladder_report_view_focus - focuses the list. */
void ladder_report_view_focus(LadderReportView *view);
#endif
