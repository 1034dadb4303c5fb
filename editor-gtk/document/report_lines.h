/* SPDX-License-Identifier: MIT
 *
 * report_lines - the report of an import or export as rows of a list: result, original
 * place, place in this project. It uses no widget.
 */
#ifndef EDITOR_REPORT_LINES_H
#define EDITOR_REPORT_LINES_H

#include "editor-gtk/document/classic_origin.h"
#include "editor-gtk/kit/panel_row.h"

enum report_column { REPORT_KIND, REPORT_TEXT, REPORT_THERE, REPORT_HERE };

/* One line of the report of an export. */
struct left_line {
	bool refused;              /* it prevents the export                    */
	char *pou, *text;          /* pou NULL: no place                        */
	int rung, row, col;        /* 1-based; 0: the whole                     */
};
void left_line_free(gpointer line);

/** report_lines_import - of LadderPanelRow, with the present places; row->flags is the line
 * of the report. Caller: g_ptr_array_unref(), as for the next. */
GPtrArray *report_lines_import(LadderOrigin *origin, LadderDocument *document);
/** report_lines_export - @lines: of struct left_line. */
GPtrArray *report_lines_export(const GPtrArray *lines, LadderDocument *document);
/** report_lines_title - "pump.clprj: 3 changed, 1 left out". @name: of the file. Caller
 * frees. */
char *report_lines_title(const char *name, const GPtrArray *rows);
/** report_lines_text - the rows as lines of text, for the clipboard. Caller frees. */
char *report_lines_text(const char *title, GListModel *rows);
#endif
