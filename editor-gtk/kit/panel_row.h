/* SPDX-License-Identifier: MIT
 *
 * panel_row - a row of a panel's list: texts, and the place they are about. The lists of
 * problems, uses and symbols have such rows. Signal: changed (): the same declaration has
 * other texts now.
 */
#ifndef EDITOR_PANEL_ROW_H
#define EDITOR_PANEL_ROW_H

#include <gio/gio.h>
#include <stdbool.h>

#define PANEL_TEXTS 34

enum panel_tone { PANEL_PLAIN, PANEL_WARNING, PANEL_ERROR };

#define LADDER_TYPE_PANEL_ROW (ladder_panel_row_get_type())
G_DECLARE_FINAL_TYPE(LadderPanelRow, ladder_panel_row, LADDER, PANEL_ROW, GObject)

struct _LadderPanelRow {
	GObject parent_instance;
	char *text[PANEL_TEXTS];   /* one for each column; NULL: ""            */
	char *spoken;              /* of the whole row, for a screen reader    */
	char *note;                /* its problem; NULL: none                  */
	gint64 number;             /* sort key of its place                    */
	enum panel_tone tone;
	int pou, rung, row, col;   /* 0-based; -1: the whole                   */
	int table, index;          /* of a declaration; -1: none               */
	unsigned int flags;        /* for use by the panel                     */
};

/** ladder_panel_row_new - without texts and place. */
LadderPanelRow *ladder_panel_row_new(void);
/** panel_row_text - never NULL. Borrowed. */
const char *panel_row_text(const LadderPanelRow *row, int column);
/** panel_row_matches - does one of its texts contain @wanted, in any case? */
bool panel_row_matches(const LadderPanelRow *row, const char *wanted);
/** panel_row_is_like - is @row of the same table, with the same first text, as row @other? */
bool panel_row_is_like(const LadderPanelRow *row, gconstpointer other);
/** panel_row_is_named - is @name its first text? */
bool panel_row_is_named(const LadderPanelRow *row, gconstpointer name);
/** panel_rows_update - replaces the rows of a list by @rows. Equal rows at both ends stay,
 * with selection and scrolling. Rows of the same declarations are changed, not replaced, so
 * that an open edit stays and sorting waits. @rows: their contents may be moved. */
void panel_rows_update(GListStore *store, GPtrArray *rows);

#endif
