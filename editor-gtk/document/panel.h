/* SPDX-License-Identifier: MIT
 *
 * panel - what the panels with lists share: columns over LadderPanelRow, sorting and
 * filtering, going to a place, and refreshing when the document changed.
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
	char *wanted;          /* filter: the text that rows must have; never NULL */
	GArray *columns;       /* their widths; panel.c                        */
	GtkColumnView *fitted; /* @view, weak                                  */
	GtkAdjustment *across; /* of it                                        */
	int page;              /* px that it shows; 0: unknown                 */
	bool low;              /* headings have two lines                      */
	GSimpleActionGroup *actions; /* of the columns that may leave; NULL: none do */
	GtkWidget *button;     /* of their menu, weak                          */
	guint fit;             /* sets the widths when it elapses              */
	gulong followed;       /* panel_list_follow(); 0: not                  */
};

enum panel_column_flag {
	PANEL_EXPAND = 1, PANEL_NUMBER = 2, /* sorts by row->number            */
	PANEL_ICON = 4,                     /* an icon of the row's tone, no text */
	PANEL_DIM = 8,
	PANEL_MIDDLE = 16,                  /* an ellipsis in the middle, so that the end stays
					       visible */
	PANEL_LABEL = 32,                   /* of panel_list_column(): not edited */
	PANEL_BUTTON = 64,                  /* with an arrow or a button beside the text */
	PANEL_BOLD = 128,                   /* its texts may be bold: they need more room */
	PANEL_LIVE = 256,                   /* its cells show what no row knows: it keeps its width */
};

/* Binds the child "view" of a template to the member "list" of @type. */
#define panel_bind_list(class, type) \
	gtk_widget_class_bind_template_child_full(class, "view", FALSE, \
						  G_STRUCT_OFFSET(type, list.view))
/* Binds the child "message" to the member of that name. */
#define panel_bind_message(class, type) \
	gtk_widget_class_bind_template_child_full(class, "message", FALSE, \
						  G_STRUCT_OFFSET(type, message.label))

/** panel_list_init - an empty list in @view, with filter and sorter. Owns:
 * panel_list_clear(). */
void panel_list_init(struct panel_list *list, GtkColumnView *view);
void panel_list_clear(struct panel_list *list);
/** panel_list_follow - calls @changed(@owner, …) when another row is selected, once for each list,
 * until panel_list_clear(): the view may live a little longer than its owner and select rows. */
void panel_list_follow(struct panel_list *list, GCallback changed, gpointer owner);
/** panel_list_column - adds a column of labels.
 * @name: translated; @width: px, 0: natural. More for longer texts; less in a narrow list, but
 * not less than its texts need. Returns it, borrowed. */
GtkColumnViewColumn *panel_list_column(struct panel_list *list, const char *name,
				       int text, unsigned int flags, int width);
/** panel_list_add - adds a column with its own cells, sorted by @text. */
GtkColumnViewColumn *panel_list_add(struct panel_list *list, const char *name, int text,
				    unsigned int flags, int width,
				    GtkListItemFactory *factory);
/** panel_list_may_leave - the columns of these texts leave a list that is too narrow for all texts,
 * the first one first, those without any text before the others. The menu of each
 * heading and of @button, which is visible while one is away, shows and hides them. Once, after
 * the last column was added. */
void panel_list_may_leave(struct panel_list *list, const int *texts, int count,
			  GtkMenuButton *button);
/** panel_heading_width - px that the heading of a column of @view needs; a column with a
 * fixed width must not be narrower, in any language. */
int panel_heading_width(GtkWidget *view, const char *name);
/** panel_list_unsort - the order of the rows means something: no column sorts them. */
void panel_list_unsort(struct panel_list *list);
/** panel_list_want - shows only rows that contain this text. */
void panel_list_want(struct panel_list *list, const char *wanted);
/** panel_list_update - the list becomes @rows, as panel_rows_update(); keeps the focus. */
void panel_list_update(struct panel_list *list, GPtrArray *rows);
/** panel_list_row - the selected row; NULL: none. Borrowed. */
LadderPanelRow *panel_list_row(struct panel_list *list);
/** panel_list_go - selects visible row @at and scrolls to it. */
void panel_list_go(struct panel_list *list, guint at);
/** panel_list_select - selects the first row for which @is returns true, and scrolls to it. */
bool panel_list_select(struct panel_list *list,
		       bool (*is)(const LadderPanelRow *row, gconstpointer what),
		       gconstpointer what);
/**
 * panel_go_to - activates win.go-to (iiii) for the place of a row: POU, rung, row, column,
 * 0-based, -1: the whole
 *
 * In a list: its POU, -1, line of its text, byte in it. In a file that cannot be read: -1,
 * line, -1, byte. For a declaration (row->table): -1, -1, table, index of xref/xref.h.
 */
void panel_go_to(GtkWidget *from, const LadderPanelRow *row);
/** panel_speak - sets the accessible name of the row that a cell is in. */
void panel_speak(GtkWidget *cell, const LadderPanelRow *row);

/** panel_button_new - a flat button with an icon; @name, translated, is its tooltip and
 * accessible name. */
GtkWidget *panel_button_new(const char *icon, const char *name, const char *action);
/** panel_choose_beside - starts a file chooser in the folder of @document, if it has one. */
void panel_choose_beside(GtkFileChooserNative *chooser, LadderDocument *document);

/* ---- messages ---- */

/* A line for the reason of a refusal. It is visible while it has a text. */
struct panel_message {
	GtkLabel *label;        /* borrowed                                       */
	guint64 told_of;        /* version of the document when it was set        */
};

void panel_message_init(struct panel_message *message, GtkLabel *label);
/** panel_message_set - @text: taken over; NULL: none. @document: NULL: none yet. */
void panel_message_set(struct panel_message *message, LadderDocument *document, char *text);
/** panel_message_age - clears a message about an older version of @document. */
void panel_message_age(struct panel_message *message, LadderDocument *document);

/* ---- the document ---- */

struct panel_watch;

/**
 * panel_watch_new - calls @refresh(@owner) after changes of the document, at most ten times
 * a second, and only while @owner is visible; if it is not, when it becomes visible
 * @checks: also when a check has ended
 * Owns: the caller, panel_watch_free().
 */
struct panel_watch *panel_watch_new(GtkWidget *owner, bool checks,
				    void (*refresh)(GtkWidget *owner));
void panel_watch_free(struct panel_watch *watch);
/** panel_watch_set - @document: NULL: none. False: it is the same as before. */
bool panel_watch_set(struct panel_watch *watch, LadderDocument *document);
LadderDocument *panel_watch_document(struct panel_watch *watch);
/** panel_watch_later - as if the document had changed. */
void panel_watch_later(struct panel_watch *watch);
/** panel_watch_now - refreshes at once if something changed, visible or not: for tests. */
void panel_watch_now(struct panel_watch *watch);

#endif
