/* SPDX-License-Identifier: MIT
 *
 * report_lines - what an import or an export has to tell, as rows of a list: what became
 * of it, where it stood there, where it is here. Known to no widget.
 */
#ifndef EDITOR_REPORT_LINES_H
#define EDITOR_REPORT_LINES_H

#include "editor-gtk/document/classic_origin.h"
#include "editor-gtk/kit/panel_row.h"

enum report_column { REPORT_KIND, REPORT_TEXT, REPORT_THERE, REPORT_HERE };

/* Of an export, one thing it tells. */
struct left_line {
	bool refused;              /* it keeps the project from being written   */
	char *pou, *text;          /* pou NULL: nowhere                         */
	int rung, row, col;        /* 1-based; 0: the whole                     */
};
void left_line_free(gpointer line);

/** report_lines_import - of LadderPanelRow, places as they are now; row->flags is the line
 * of the report. Caller: g_ptr_array_unref(), as of the next. */
GPtrArray *report_lines_import(LadderOrigin *origin, LadderDocument *document);
/** report_lines_export - @lines: of struct left_line. */
GPtrArray *report_lines_export(const GPtrArray *lines, LadderDocument *document);
/** report_lines_title - "pump.clprj: 3 changed, 1 left out". @name: of the file. Caller
 * frees. */
char *report_lines_title(const char *name, const GPtrArray *rows);
/** report_lines_text - all of them, a line each, for the clipboard. Caller frees. */
char *report_lines_text(const char *title, GListModel *rows);
#endif
