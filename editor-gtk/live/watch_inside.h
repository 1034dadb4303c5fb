/* SPDX-License-Identifier: MIT
 *
 * watch_inside - what the files of the status chart share. Only editor-gtk/watch_*.c
 * include it.
 */
#ifndef EDITOR_WATCH_INSIDE_H
#define EDITOR_WATCH_INSIDE_H

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/live/watch_row.h"
#include "editor-gtk/live/watch_view.h"

struct _LadderWatchView {
	GtkWidget parent_instance;
	/* Of the template: */
	GtkWidget *box, *charts, *add_button, *stack, *empty, *bar, *message, *list;
	LadderDocument *document;
	LadderSim *sim;
	GListStore *store;          /* of LadderWatchRow                       */
	GtkSingleSelection *selection;
	GtkWidget *popup;           /* a line that is typed; NULL: none        */
	guint chart;                /* that is shown, 0-based                  */
	char *chart_name;           /* its name, to find it again              */
	bool dirty;                 /* the rows are older than the charts      */
	bool busy;                  /* the drop-down is being filled           */
};

/* ---- watch_cells.c ---- */
/** watch_columns - puts the columns into @view->list. */
void watch_columns(LadderWatchView *view);
/** watch_cells_show - the cells of a row have what it holds now. */
void watch_cells_show(LadderWatchRow *row);

/* ---- watch_edit.c: what a person does to charts and rows ---- */
/** watch_edit - a chart of the document, to be changed: those of @charts that it is
 * one of are to be kept then. NULL: there is none. */
struct watch *watch_edit(LadderWatchView *view, GPtrArray **charts);
void watch_set_comment(LadderWatchView *view, LadderWatchRow *row, const char *text);
/** watch_install_actions - watch.add and its like. */
void watch_install_actions(GtkWidgetClass *class);
/** watch_ask_name - a line for another name of a row. */
void watch_ask_name(LadderWatchView *view, LadderWatchRow *row);

/* ---- watch_act.c: what a person does to values ---- */
/** watch_write - the new value of a row becomes the value. False: it has none, or it is
 * refused and that is told. */
bool watch_write(LadderWatchView *view, LadderWatchRow *row);
void watch_write_all(LadderWatchView *view);
/** watch_toggle_force - holds the new value, or the one there is; or lets go of it. */
void watch_toggle_force(LadderWatchView *view, LadderWatchRow *row);

/* ---- watch_view.c ---- */
void watch_refresh(LadderWatchView *view);
/** watch_tell - why something was refused; taken over. NULL: nothing. */
void watch_tell(LadderWatchView *view, char *text);
/** watch_row_at - NULL: none there. Caller: g_object_unref. */
LadderWatchRow *watch_row_at(LadderWatchView *view, guint at);
/** watch_place - of a row in the chart; -1: it is not in it any more. */
int watch_place(LadderWatchView *view, LadderWatchRow *row);
/** watch_select - a row; -1: none. */
void watch_select(LadderWatchView *view, int at);
/** watch_selected - -1: none. */
int watch_selected(LadderWatchView *view);

#endif
