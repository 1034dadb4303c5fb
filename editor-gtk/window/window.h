/* SPDX-License-Identifier: MIT
 *
 * window - the window of one document: sheets in tabs, panels around them.
 *
 * It makes the parts, connects them, and knows which part does which command. It draws
 * nothing and edits no rung.
 *
 * Signals for the application: "open-wanted" (path, gboolean): open a file, or a copy of a
 * sample; "open-on-board-wanted" (path): open a file that was read from the board of this window,
 * and connect its window to that board; "new-wanted": open a window with a new project. Signals
 * among its parts: "cursor-moved" in the page in front; "place-changed": the status bar shows the
 * place again; "page-changed": another page is in front;
 * "facts-changed": other commands can work now (core.h).
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

/** ladder_window_new - shows @document; keeps a reference. */
LadderWindow *ladder_window_new(AdwApplication *application, LadderDocument *document);
LadderDocument *ladder_window_document(LadderWindow *window);
/** ladder_window_is_untouched - a new project without changes: a file may be opened in its
 * place. */
bool ladder_window_is_untouched(LadderWindow *window);
/** ladder_window_welcome - shows the welcome page. */
void ladder_window_welcome(LadderWindow *window);
/** ladder_window_warn - shows a banner. */
void ladder_window_warn(LadderWindow *window, const char *text);
/** ladder_window_offer_restored - says that unsaved changes were restored. */
void ladder_window_offer_restored(LadderWindow *window);
/** ladder_window_opened - shows the file that replaced the untouched document. */
void ladder_window_opened(LadderWindow *window);
/** ladder_window_tell_file - warns if saving would overwrite bytes that are not text, or a
 * read-only file. */
void ladder_window_tell_file(LadderWindow *window);
/** ladder_window_set_origin - the file that the unsaved project was made from. */
void ladder_window_set_origin(LadderWindow *window, const char *path);
/** ladder_window_set_classic - the same for ClassicLadder; shows a banner. */
void ladder_window_set_classic(LadderWindow *window, LadderOrigin *origin);
/** ladder_window_share_board - connects @window to the board of @from, which stays connected. A
 * serial line has one session: then @from is disconnected. */
void ladder_window_share_board(LadderWindow *window, LadderWindow *from);
/** ladder_window_compare - shows the page that compares two files. */
void ladder_window_compare(LadderWindow *window, const char *older, const char *newer);
/** ladder_window_has_file - is that text file open in the window? */
bool ladder_window_has_file(LadderWindow *window, const char *path);
/** ladder_window_show_file - opens a text file beside the project. */
void ladder_window_show_file(LadderWindow *window, const char *path);
/** ladder_window_restore_file - opens the draft of a text file beside the project. False:
 * no new draft could be written, which is reported. */
bool ladder_window_restore_file(LadderWindow *window, const struct draft *draft);
/** ladder_window_keep_drafts - writes drafts of all unsaved files now. */
void ladder_window_keep_drafts(LadderWindow *window);

#endif
