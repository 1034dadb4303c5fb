/* SPDX-License-Identifier: MIT
 *
 * online_bar - the connected board in the window: the mode Online, the bar below the heading with
 * the state of the board and whether it runs this program, and the orders Run, Stop, Reset.
 *
 * Values are shown by the views of the simulation. Moving programs is in online_move.c.
 */
#ifndef EDITOR_ONLINE_BAR_H
#define EDITOR_ONLINE_BAR_H

#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/window/online_move.h"

struct online_bar {
	struct core *core;
	struct online_move move;
	GtkToggleButton *mode, *edit_mode;
	GtkBox *place;                  /* of the bar                          */
	GtkWidget *bar, *state, *same, *reason;
	GtkWidget *buttons, *again;
	guint8 identity[32];            /* of the document as it was checked last */
	bool has_identity;
	bool was_same;                  /* the board ran this document once    */
	AdwMessageDialog *question;     /* of ssh; NULL: none                  */
	char *said;                     /* the state that was logged last      */
	bool chosen;                    /* the dialog gave a board             */
};

void online_bar_init(struct online_bar *bar, struct core *core, struct compare *compare);
void online_bar_clear(struct online_bar *bar);
/** online_bar_choose - connects to the board at @where, unless it is connected. What would end a simulation or
 * another connection is asked first. A failure is a message. */
void online_bar_choose(struct online_bar *bar, const char *where);
/** online_bar_share - connects another window to the board of this one, as ladder_window_share_board()
 * says; without a board it does nothing. */
void online_bar_share(struct online_bar *bar, struct online_bar *with);
/** online_bar_do - does a command for the board; false: @verb is none, or no board is connected
 * and the command is one of the simulation, too. */
bool online_bar_do(struct online_bar *bar, enum verb verb);

#endif
