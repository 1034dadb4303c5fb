/* SPDX-License-Identifier: MIT
 *
 * front - the visible part of the program: the page in front, or the program before an
 * edit.
 *
 * While the scan that is shown ran before an edit, sheets of that older program replace the
 * tabs, below a bar that says so. They belong to a read-only document.
 */
#ifndef EDITOR_FRONT_H
#define EDITOR_FRONT_H

#include "editor-gtk/window/page.h"

struct front {
	struct core *core;
	AdwTabBar *tab_bar;
	GtkWidget *now;           /* the tabs: the current program               */
	AdwTabView *tabs;
	GtkLabel *nothing_label;
	LadderDocument *older;    /* the program before an edit; NULL: not shown */
	GtkWidget *box, *page;    /* everything of that program; its current POU */
	GtkLabel *label;
	GtkDropDown *pous;
	bool filling;             /* @pous is being filled: ignore its signal    */
};

void front_init(struct front *front, struct core *core);
void front_clear(struct front *front);
/** front_is_older - is a program before an edit shown? */
bool front_is_older(const struct front *front);
/** front_older_by - shows the POU of that program @by further on. False: no such program is
 * shown. */
bool front_older_by(struct front *front, int by);
/** front_tab - the page in front; NULL: none. Borrowed, as all below. */
AdwTabPage *front_tab(struct front *front);
/** front_pou - the POU of the page in front, also of one that shows it in another language; -1: none. */
int front_pou(struct front *front);
/** front_seen_sheet, front_seen_chart - the visible one, also of a program before an edit.
 * On the page of a chart, the rungs below it are the sheet while they have the focus.
 * NULL: none. */
LadderGridView *front_seen_sheet(struct front *front);
LadderSfcView *front_seen_chart(struct front *front);
/** front_seen_networks - the visible function block diagram; NULL: none. */
LadderFbdView *front_seen_networks(struct front *front);
/** front_seen_canvas - the visible sheet, chart or networks; NULL: none. */
LadderCanvas *front_seen_canvas(struct front *front);
/** front_sheet, front_chart, front_networks - the same, of the document of the window only: of no older
 * program, and in no other language. */
LadderGridView *front_sheet(struct front *front);
LadderSfcView *front_chart(struct front *front);
LadderFbdView *front_networks(struct front *front);
/** front_rungs - the sheet, else the rungs below a chart, with or without the focus. */
LadderGridView *front_rungs(struct front *front);
/** front_list - the text of a POU, also below a chart while it is used. front_file - a file beside the project. */
LadderTextView *front_list(struct front *front);
LadderSideFile *front_file(struct front *front);
/** front_enter_program - focuses the visible sheet, chart or text. False: none is visible. */
bool front_enter_program(struct front *front);
/** front_enter - focuses the page in front, unless the focus is in it. */
void front_enter(struct front *front);
/** front_take_typed - takes over what is being typed in a text or a cell. False: it was
 * refused, and the cell shows why. */
bool front_take_typed(struct front *front);
/** front_has_numbers - are there rungs or lines to go to by a number? */
bool front_has_numbers(struct front *front);
/** front_ask_number - asks for the number of a rung or line, and goes there. */
void front_ask_number(struct front *front);

#endif
