/* SPDX-License-Identifier: MIT
 *
 * file_view - a text file beside the project: a scenario, an I/O map.
 *
 * It is written by ladder_file_view_save() alone: who takes the view away asks before. What
 * is done to it is undone with the rest, in the document's history. Signals: state-changed ():
 * it is saved, or no longer; undone (): a step of it was undone or done again.
 */
#ifndef EDITOR_FILE_VIEW_H
#define EDITOR_FILE_VIEW_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>
#include <stdbool.h>

#define LADDER_TYPE_FILE_VIEW (ladder_file_view_get_type())
G_DECLARE_FINAL_TYPE(LadderFileView, ladder_file_view, LADDER, FILE_VIEW, GtkBox)

/** ladder_file_view_new - NULL: it cannot be read, or is no text; @error says why. An I/O
 * map is shown as a table, too; @document: whose inputs and outputs it maps. */
GtkWidget *ladder_file_view_new(const char *path, LadderDocument *document, GError **error);
/** ladder_file_view_restore - from a draft @text of a file that had the sum @sum. It need
 * not be there any more. */
GtkWidget *ladder_file_view_restore(const char *path, const char *sum, const char *text,
				    LadderDocument *document);
/** ladder_file_view_sum - of the file as it was read or saved last. Caller frees. */
char *ladder_file_view_sum(LadderFileView *view);
/** ladder_file_view_buffer - what is typed into. Borrowed. */
GtkTextBuffer *ladder_file_view_buffer(LadderFileView *view);
/** ladder_file_view_is_text - is that shown, and no table of it? Signal "turned" when it is
 * the other. */
bool ladder_file_view_is_text(LadderFileView *view);
/** ladder_file_view_path - Borrowed. */
const char *ladder_file_view_path(LadderFileView *view);
/** ladder_file_view_save - false: it cannot be written, somebody else changed it, or it is
 * read-only, and @error says so; the text stays. Saved again, it is written over that. */
bool ladder_file_view_save(LadderFileView *view, GError **error);
/** ladder_file_view_commit - what a person is typing in a cell counts now. @file: a
 * LadderFileView */
void ladder_file_view_commit(gpointer file);
/** ladder_file_view_is_saved - with what is typed in a cell; false, too, if the file is gone. */
bool ladder_file_view_is_saved(LadderFileView *view);
/** ladder_file_view_differs - from its file; what is typed in a cell does not count yet. */
bool ladder_file_view_differs(LadderFileView *view);
/** ladder_file_view_look - is the file still there? State-changed tells. @file: a
 * LadderFileView */
void ladder_file_view_look(gpointer file);
/** ladder_file_view_put - the whole text of a draft, as a step. @sum: of what it was typed
 * into; if another text stands there now, it is asked before that is written over. */
void ladder_file_view_put(LadderFileView *view, const char *text, const char *sum);
/** ladder_file_view_name - of the file, without its folder. Caller frees. */
char *ladder_file_view_name(LadderFileView *view);
/** ladder_file_view_text - as it is typed, saved or not. Caller frees. */
char *ladder_file_view_text(LadderFileView *view);
/** ladder_file_view_append - behind what stands there, a step of its own. */
void ladder_file_view_append(LadderFileView *view, const char *text);
/** ladder_file_view_marks - what is wrong with its lines (file_marks.h). Borrowed. */
struct file_marks *ladder_file_view_marks(LadderFileView *view);
/** ladder_file_view_go - the cursor to a line, 1-based, with the focus. */
void ladder_file_view_go(LadderFileView *view, int line);

/**
 * files_beside - names of files in the folder of @path (or NULL: none), and in its folder
 * `boards`, that end in @ending, sorted
 * @own: those of this program: `NAME.io`, `NAME-2.io` beside NAME.rung, unless another
 *       program has the longer part of that name; false: all others
 *
 * Caller: g_ptr_array_unref.
 */
GPtrArray *files_beside(const char *path, const char *ending, bool own);
/** file_is_beside - is @path, by its ending, one of those: `.scn`, `.io`? */
bool file_is_beside(const char *path);
/**
 * file_project - whose scenario or I/O map @path is
 *
 * The program of its folder that has the longest part of its name, else the only one there
 * that is no plant; for a folder `boards`, also of the folder that it stands in. Caller:
 * g_free(). NULL: it is anybody's.
 */
char *file_project(const char *path);

#endif
