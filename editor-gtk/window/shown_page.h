/* SPDX-License-Identifier: MIT
 *
 * shown_page - a POU in another language, read-only, or why it cannot be written in it.
 *
 * It follows the document, which it does not change. The sheets belong to a read-only document that is made
 * from the text of the engine. While the program runs, they show its values and power, by sim/sim_shadow.h.
 */
#ifndef EDITOR_SHOWN_PAGE_H
#define EDITOR_SHOWN_PAGE_H

#include "editor-gtk/window/core.h"

#define LADDER_TYPE_SHOWN_PAGE (ladder_shown_page_get_type())
G_DECLARE_FINAL_TYPE(LadderShownPage, ladder_shown_page, LADDER, SHOWN_PAGE, GtkBox)

/** shown_page_verb - the language of a verb that shows a POU in another one, or @converts it. False: it is
 * another verb. */
bool shown_page_verb(enum verb verb, enum pou_language *to, bool *converts);
/** ladder_shown_page_new - @make: makes the page of a POU of a document, as page_new_live() does. */
GtkWidget *ladder_shown_page_new(struct core *core,
				 GtkWidget *(*make)(struct core *core, LadderDocument *document, int pou,
						    LadderSim *sim));
/** ladder_shown_page_set - shows POU @pou of the document of the window in language @to. */
void ladder_shown_page_set(LadderShownPage *page, int pou, enum pou_language to);
/** ladder_shown_page_pou - the POU of the document of the window; -1: it is gone. */
int ladder_shown_page_pou(LadderShownPage *page);
/** ladder_shown_page_is_over - is the POU gone, or in that language itself? */
bool ladder_shown_page_is_over(LadderShownPage *page);
/** ladder_shown_page_follow - after the project changed; @renamed: it has as many POUs as before. True: the POU has
 * another name, which the page has now, too. */
bool ladder_shown_page_follow(LadderShownPage *page, bool renamed);
/** ladder_shown_page_child - the page that was made; NULL: the POU cannot be written in the language. */
GtkWidget *ladder_shown_page_child(LadderShownPage *page);
/** ladder_shown_page_title - "Main as ST". Caller frees. */
char *ladder_shown_page_title(LadderShownPage *page);
/** ladder_shown_page_enter - focuses the reasons; false: there are none. */
bool ladder_shown_page_enter(LadderShownPage *page);

#endif
