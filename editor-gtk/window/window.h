/* SPDX-License-Identifier: MIT
 *
 * window - one document's window: sheets in tabs, panels round them.
 *
 * It makes the parts, joins them, and knows which part does which verb. It draws nothing and
 * changes no rung.
 *
 * Signals for the application: "open-wanted" (path, gboolean): a file is to be opened, or a
 * copy of a sample; "new-wanted": a window with a new project. Signals among its parts:
 * "cursor-moved" in the page in front; "place-changed": what the status bar tells of the page
 * in front; "page-changed": another page is in front.
 */
#ifndef EDITOR_WINDOW_H
#define EDITOR_WINDOW_H

#include "editor-gtk/document/classic_origin.h"
#include "editor-gtk/document/document.h"
#include "editor-gtk/document/draft.h"
#include "editor-gtk/sim/sim.h"

#include <adwaita.h>

#define APP_ID "org.rungboard.Editor"

#define LADDER_TYPE_WINDOW (ladder_window_get_type())
G_DECLARE_FINAL_TYPE(LadderWindow, ladder_window, LADDER, WINDOW, AdwApplicationWindow)

/** ladder_window_new - shows @document; a reference is kept. */
LadderWindow *ladder_window_new(AdwApplication *application, LadderDocument *document);
LadderDocument *ladder_window_document(LadderWindow *window);
/** ladder_window_sim - what it simulates with; for measurements. Borrowed. */
LadderSim *ladder_window_sim(LadderWindow *window);
/** ladder_window_is_untouched - a new project in which nothing was done: a file may be
 * opened in its place. */
bool ladder_window_is_untouched(LadderWindow *window);
/** ladder_window_welcome - shows the welcome page. */
void ladder_window_welcome(LadderWindow *window);
/** ladder_window_warn - a message that stays until it is closed. */
void ladder_window_warn(LadderWindow *window, const char *text);
/** ladder_window_offer_restored - tells that this was not saved when the editor ended. */
void ladder_window_offer_restored(LadderWindow *window);
/** ladder_window_opened - its untouched document became a file: the sheets of that open. */
void ladder_window_opened(LadderWindow *window);
/** ladder_window_tell_file - a banner if saving would write over something: the file holds
 * what is no text, or is read-only. */
void ladder_window_tell_file(LadderWindow *window);
/** ladder_window_set_origin - the file that an unsaved project was made from. */
void ladder_window_set_origin(LadderWindow *window, const char *path);
/** ladder_window_set_classic - the same of ClassicLadder; that is told. */
void ladder_window_set_classic(LadderWindow *window, LadderOrigin *origin);
/** ladder_window_has_file - is that text file open there? */
bool ladder_window_has_file(LadderWindow *window, const char *path);
/** ladder_window_show_file - a text file beside the project, in front. */
void ladder_window_show_file(LadderWindow *window, const char *path);
/** ladder_window_restore_file - the draft of a text file beside the project, in front. False:
 * it could not be kept as a draft again, which is told. */
bool ladder_window_restore_file(LadderWindow *window, const struct draft *draft);
/** ladder_window_keep_drafts - of all that is not saved, at once. */
void ladder_window_keep_drafts(LadderWindow *window);

#endif
