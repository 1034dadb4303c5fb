/* SPDX-License-Identifier: MIT
 *
 * panel_row - a row of a panel's list: texts, and the place they speak of. It is what the
 * lists of problems, uses and symbols hold. Signal: changed (): it tells something else of
 * the same declaration.
 */
#ifndef EDITOR_PANEL_ROW_H
#define EDITOR_PANEL_ROW_H

#include <gio/gio.h>
#include <stdbool.h>

#define PANEL_TEXTS 12

enum panel_tone { PANEL_PLAIN, PANEL_WARNING, PANEL_ERROR };

#define LADDER_TYPE_PANEL_ROW (ladder_panel_row_get_type())
G_DECLARE_FINAL_TYPE(LadderPanelRow, ladder_panel_row, LADDER, PANEL_ROW, GObject)

struct _LadderPanelRow {
	GObject parent_instance;
	char *text[PANEL_TEXTS];   /* a column each; NULL: ""                  */
	char *spoken;              /* of the whole row, for a screen reader    */
	char *note;                /* what is wrong with it; NULL: nothing     */
	gint64 number;             /* how its place sorts                      */
	enum panel_tone tone;
	int pou, rung, row, col;   /* 0-based; -1: the whole                   */
	int table, index;          /* of a declaration; -1: it is none         */
	unsigned int flags;        /* the panel's own                          */
};

/** ladder_panel_row_new - of nothing, with no place. */
LadderPanelRow *ladder_panel_row_new(void);
/** panel_row_text - never NULL. Borrowed. */
const char *panel_row_text(const LadderPanelRow *row, int column);
/** panel_row_equal - would a reader see no difference? */
bool panel_row_equal(const LadderPanelRow *a, const LadderPanelRow *b);
/** panel_row_matches - has one of its texts what is wanted in it? In any case. */
bool panel_row_matches(const LadderPanelRow *row, const char *wanted);
/** panel_rows_update - a list becomes @rows; what is the same at both ends stays, so that
 * selection and scrolling do. Declarations that only say something else are not replaced but
 * changed: who types into one goes on, and sorting waits. @rows: their content may go. */
void panel_rows_update(GListStore *store, GPtrArray *rows);

#endif
