/* SPDX-License-Identifier: MIT
 *
 * panel - what the panels with lists share: columns over LadderPanelRow, sorting and
 * filtering, going to a place, and looking again when the document changed.
 */
#ifndef EDITOR_PANEL_H
#define EDITOR_PANEL_H

#include <gtk/gtk.h>

#include "editor-gtk/document/document.h"
#include "editor-gtk/kit/panel_row.h"

/* ---- lists ---- */

struct panel_list {
	GtkColumnView *view;   /* borrowed                                     */
	GListStore *store;     /* of LadderPanelRow                            */
	GtkFilterListModel *filtered;
	GtkCustomFilter *filter;
	GtkSingleSelection *selection;
	char *wanted;          /* text that rows must have; never NULL         */
};

enum panel_column_flag {
	PANEL_EXPAND = 1, PANEL_NUMBER = 2, /* sorts by row->number            */
	PANEL_ICON = 4,                     /* of the row's tone, no text      */
	PANEL_DIM = 8,
	PANEL_MIDDLE = 16,                  /* too long, it keeps its end, too */
};

/** panel_list_init - an empty list in @view; its rows can be filtered and sorted.
 * Owns: panel_list_clear(). */
void panel_list_init(struct panel_list *list, GtkColumnView *view);
void panel_list_clear(struct panel_list *list);
/** panel_list_column - another column of labels.
 * @name: translated; @width: px, 0: as it needs; Returns it, borrowed. */
GtkColumnViewColumn *panel_list_column(struct panel_list *list, const char *name,
				       int text, unsigned int flags, int width);
/** panel_list_add - a column with cells of one's own; it can be sorted by @text. */
GtkColumnViewColumn *panel_list_add(struct panel_list *list, const char *name, int text,
				    unsigned int flags, int width,
				    GtkListItemFactory *factory);
/** panel_heading_width - of the heading of a column of @view, in px, with nothing round it: a
 * column that has a width must have that of its heading in any language. */
int panel_heading_width(GtkWidget *view, const char *name);
/** panel_list_want - shows only rows that have this text in them. */
void panel_list_want(struct panel_list *list, const char *wanted);
/** panel_list_update - the list becomes @rows, as panel_rows_update(); keys are not lost. */
void panel_list_update(struct panel_list *list, GPtrArray *rows);
/** panel_list_row - the selected one; NULL: none. Borrowed. */
LadderPanelRow *panel_list_row(struct panel_list *list);
/** panel_list_go - selects row @at of those that are shown, and scrolls to it. */
void panel_list_go(struct panel_list *list, guint at);
/** panel_list_select - the first row for which @is holds, scrolled to. */
bool panel_list_select(struct panel_list *list,
		       bool (*is)(const LadderPanelRow *row, gconstpointer what),
		       gconstpointer what);
/**
 * panel_go_to - the window's action for the place of a row, win.go-to (iiii): POU, rung,
 * row, column, 0-based, -1: the whole
 *
 * Of a list: its POU, -1, line of its text, byte in it. Of a file that cannot be read: -1,
 * line, -1, byte. Of a declaration (row->table): -1, -1, table, index of xref/xref.h.
 */
void panel_go_to(GtkWidget *from, const LadderPanelRow *row);
/** panel_speak - names the row that a cell of the list stands in, for a screen reader. */
void panel_speak(GtkWidget *cell, const LadderPanelRow *row);

/** panel_choose_beside - a file chooser begins in the folder of @document, if it has one. */
void panel_choose_beside(GtkFileChooserNative *chooser, LadderDocument *document);

/* ---- the document ---- */

struct panel_watch;

/**
 * panel_watch_new - calls @refresh(@owner) when the document changed, at most ten times a
 * second, and only while @owner can be seen; else when it can be again
 * @checks: also when checks are done
 * Owns: the caller, panel_watch_free().
 */
struct panel_watch *panel_watch_new(GtkWidget *owner, bool checks,
				    void (*refresh)(GtkWidget *owner));
void panel_watch_free(struct panel_watch *watch);
/** panel_watch_set - @document: NULL: none. False: it is that already. */
bool panel_watch_set(struct panel_watch *watch, LadderDocument *document);
LadderDocument *panel_watch_document(struct panel_watch *watch);
/** panel_watch_later - as if the document had changed. */
void panel_watch_later(struct panel_watch *watch);
/** panel_watch_now - refreshes at once if something changed, seen or not: for tests. */
void panel_watch_now(struct panel_watch *watch);

#endif
