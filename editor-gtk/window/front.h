/* SPDX-License-Identifier: MIT
 *
 * front - what is seen of the program: the page in front of the tabs, or the program as it
 * was before an edit.
 *
 * While a scan is shown that ran before an edit, that program stands in the place of the
 * tabs, with a bar that says so: its POUs are sheets of a document that nobody can change.
 */
#ifndef EDITOR_FRONT_H
#define EDITOR_FRONT_H

#include "editor-gtk/window/page.h"

struct front {
	struct core *core;
	AdwTabBar *tab_bar;
	GtkWidget *now;           /* the program as it is: the tabs              */
	AdwTabView *tabs;
	GtkLabel *nothing_label;
	LadderDocument *older;    /* the program before an edit; NULL: not seen  */
	GtkWidget *box, *page;    /* of that: all of it; the POU that is shown   */
	GtkLabel *label;
	GtkDropDown *pous;
	bool filling;             /* @pous is being filled                       */
};

void front_init(struct front *front, struct core *core);
void front_clear(struct front *front);
/** front_is_older - is a program before an edit seen? */
bool front_is_older(const struct front *front);
/** front_older_by - shows the POU so many further on of that program. False: none is seen. */
bool front_older_by(struct front *front, int by);
/** front_tab - the page in front of the tabs; NULL: there is none. Borrowed, as all below. */
AdwTabPage *front_tab(struct front *front);
/** front_seen_sheet, front_seen_chart - that is seen, also of a program before an edit.
 * Of a chart, the rungs below it are the sheet while somebody works on them. NULL: none. */
LadderGridView *front_seen_sheet(struct front *front);
LadderSfcView *front_seen_chart(struct front *front);
/** front_sheet, front_chart - the same of the window's document only. */
LadderGridView *front_sheet(struct front *front);
LadderSfcView *front_chart(struct front *front);
/** front_rungs - the sheet; else the rungs that stand below a chart, whoever has the keys. */
LadderGridView *front_rungs(struct front *front);
/** front_list - the text of a program. front_file - a file beside the project. */
LadderTextView *front_list(struct front *front);
LadderSideFile *front_file(struct front *front);
/** front_enter_program - gives the keys to the sheet, the chart or the text that is seen.
 * False: none is seen. */
bool front_enter_program(struct front *front);
/** front_enter - gives the keys to the page in front, unless something in it has them. */
void front_enter(struct front *front);
/** front_take_typed - what was just typed into a text or a cell goes into the document.
 * False: it was refused, which is told where it stands. */
bool front_take_typed(struct front *front);
/** front_ask_number - asks for a rung or a line of what is seen, and goes there. */
void front_ask_number(struct front *front);

#endif
