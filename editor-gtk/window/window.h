/* SPDX-License-Identifier: MIT
 *
 * window - one document's window: sheets in tabs, panels round them.
 *
 * It joins the parts and knows what each verb does to which part. It draws nothing and
 * changes no rung.
 */
#ifndef EDITOR_WINDOW_H
#define EDITOR_WINDOW_H

#include "editor-gtk/document/classic_origin.h"
#include "editor-gtk/document/document.h"
#include "editor-gtk/document/draft.h"
#include "editor-gtk/sim/sim.h"
#include "editor-gtk/kit/verbs.h"

#include <adwaita.h>

#define LADDER_TYPE_WINDOW (ladder_window_get_type())
G_DECLARE_FINAL_TYPE(LadderWindow, ladder_window, LADDER, WINDOW, AdwApplicationWindow)

/** ladder_window_new - shows @document; a reference is kept. */
LadderWindow *ladder_window_new(AdwApplication *application, LadderDocument *document);
LadderDocument *ladder_window_document(LadderWindow *window);
/** ladder_window_is_untouched - a new project in which nothing was done: a file may be
 * opened in its place. */
bool ladder_window_is_untouched(LadderWindow *window);
/** ladder_window_tell - a short message below; "" for none. */
void ladder_window_tell(LadderWindow *window, const char *text);
/** ladder_window_welcome - shows the welcome page. */
void ladder_window_welcome(LadderWindow *window);
/** ladder_window_warn - a message that stays until it is closed. */
void ladder_window_warn(LadderWindow *window, const char *text);
/** ladder_window_offer_restored - says that this was not saved when the editor died. */
void ladder_window_offer_restored(LadderWindow *window);
/** ladder_window_restore_file - a text file beside the project, in front. Fails: false,
 * it has no draft again, and that is told. */
bool ladder_window_restore_file(LadderWindow *window, const struct draft *draft);
/** ladder_window_keep_drafts - of all that is not saved, at once. */
void ladder_window_keep_drafts(LadderWindow *window);
/** ladder_window_has_file - is that text file open there? */
bool ladder_window_has_file(LadderWindow *window, const char *path);
/** ladder_window_show_file - a text file beside the project, in front of its sheets. */
void ladder_window_show_file(LadderWindow *window, const char *path);
/** ladder_window_set_origin - the file that an unsaved project is a copy of: a plant may
 * stand beside it. */
void ladder_window_set_origin(LadderWindow *window, const char *path);
/** ladder_window_tell_file - a banner, if its file holds what is no text, or is read-only:
 * saving would write over that, and asks once more. */
void ladder_window_tell_file(LadderWindow *window);
/** ladder_window_opened - its untouched document became a file: the sheets of that open. */
void ladder_window_opened(LadderWindow *window);
/** ladder_window_set_classic - what its document was taken from; that is told. */
void ladder_window_set_classic(LadderWindow *window, LadderOrigin *origin);
/** ladder_window_sim - what it simulates with; for measurements. Borrowed. */
LadderSim *ladder_window_sim(LadderWindow *window);
/** ladder_window_do - as if its key was pressed. */
void ladder_window_do(LadderWindow *window, enum verb verb);

#endif
