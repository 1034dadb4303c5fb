/* SPDX-License-Identifier: MIT
 *
 * iomap_view_inside - what the files of the table of an I/O map share. Only
 * editor-gtk/iomap_view*.c include it.
 */
#ifndef EDITOR_IOMAP_VIEW_INSIDE_H
#define EDITOR_IOMAP_VIEW_INSIDE_H

#include "editor-gtk/iomap/iomap_cells.h"
#include "editor-gtk/iomap/iomap_rows.h"
#include "editor-gtk/iomap/iomap_view.h"

struct _LadderIomapView {
	GtkBox parent;
	GtkTextBuffer *buffer;
	GtkWidget *stack, *tools, *board, *lacks, *lacks_label, *message;
	struct panel_list list;
	struct panel_watch *watch;
	struct iomap_cells cells;
	struct io_machine machine;
	struct io_uses uses;
	guint64 version;        /* of the document the uses are of, + 1; 0: none */
	char *refused;          /* what was refused last; NULL: nothing        */
	char *said;             /* of the whole map; NULL: nothing             */
	char *board_shown;      /* as the text had it last                     */
	bool said_wrong, as_text;
};

/* ---- iomap_view_edit.c ---- */
/** iomap_view_text - all of the map. Caller: g_free. */
char *iomap_view_text(LadderIomapView *view);
/** iomap_view_told - what could not be done (NULL: it could) stands below; all is shown
 * anew. */
void iomap_view_told(LadderIomapView *view, const char *text);
/** iomap_view_set_field - struct iomap_cells. */
bool iomap_view_set_field(gpointer owner, const LadderPanelRow *row, enum io_field field,
			  const char *value, char **why);
/* Of the template and the actions. */
void iomap_view_board_activated(GtkEntry *entry, LadderIomapView *view);
void iomap_view_board_left(GtkEventControllerFocus *focus, LadderIomapView *view);
void iomap_view_add(GtkWidget *widget, const char *action, GVariant *unused);
void iomap_view_add_lacking(GtkWidget *widget, const char *action, GVariant *unused);
void iomap_view_delete(GtkWidget *widget, const char *action, GVariant *unused);
void iomap_view_look(GtkWidget *widget, const char *action, GVariant *unused);

#endif
