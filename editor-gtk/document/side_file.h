/* SPDX-License-Identifier: MIT
 *
 * side_file - a text file beside the project while a person works on it: a scenario, an I/O map.
 *
 * It holds the text, the path, and the text of the file when it was read or saved last. Its
 * edits are steps of the document's history. It shows nothing: views edit its buffer.
 *
 * Signals:
 *   state-changed ()  it is saved, or no longer; its file is gone, or there again
 *   undone ()         one of its steps was undone or redone
 *   commit ()         a view with an open cell must write its text into the buffer now
 */
#ifndef EDITOR_SIDE_FILE_H
#define EDITOR_SIDE_FILE_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>
#include <stdbool.h>

#define LADDER_TYPE_SIDE_FILE (ladder_side_file_get_type())
G_DECLARE_FINAL_TYPE(LadderSideFile, ladder_side_file, LADDER, SIDE_FILE, GObject)

/** ladder_side_file_open - @document: whose history takes the edits. Caller unrefs.
 * Fails: NULL, and @error says why: it cannot be read, or is no text. */
LadderSideFile *ladder_side_file_open(const char *path, LadderDocument *document,
				      GError **error);
/** ladder_side_file_make - an empty one, which is not on the disk yet. A save with an empty text
 * deletes the file again. Caller unrefs. */
LadderSideFile *ladder_side_file_make(const char *path, LadderDocument *document);
/** ladder_side_file_is_nothing - is it empty, and not on the disk? */
bool ladder_side_file_is_nothing(LadderSideFile *file);
/** ladder_side_file_is_part - can the project include it? Such a file is saved with it. */
bool ladder_side_file_is_part(LadderSideFile *file);
/** ladder_side_file_restore - from a draft @text of a file that had the sum @sum. The file
 * itself may be gone. Caller unrefs. */
LadderSideFile *ladder_side_file_restore(const char *path, const char *sum, const char *text,
					 LadderDocument *document);
/** ladder_side_file_put - replaces the whole text by that of a draft, as a step. @sum: of the
 * file that the draft was made from; if the file differs, a save asks before it overwrites. */
void ladder_side_file_put(LadderSideFile *file, const char *text, const char *sum);

/** ladder_side_file_path, _document, _buffer - Borrowed. */
const char *ladder_side_file_path(LadderSideFile *file);
LadderDocument *ladder_side_file_document(LadderSideFile *file);
GtkTextBuffer *ladder_side_file_buffer(LadderSideFile *file);
/** ladder_side_file_name - without its folder. Caller frees. */
char *ladder_side_file_name(LadderSideFile *file);
/** ladder_side_file_text - as it is typed, saved or not. Caller frees. */
char *ladder_side_file_text(LadderSideFile *file);
/** ladder_side_file_sum - of the file when it was read or saved last. Caller frees. */
char *ladder_side_file_sum(LadderSideFile *file);
/** ladder_side_file_set - replaces the whole text, as a step. */
void ladder_side_file_set(LadderSideFile *file, const char *text);
/** ladder_side_file_append - adds @text at the end, as a step. */
void ladder_side_file_append(LadderSideFile *file, const char *text);

/**
 * ladder_side_file_save - commits, and writes the file if it differs
 *
 * Fails: false, and @error says why: it cannot be written, another program changed it, or it
 * is read-only. In the last two cases the next save overwrites it.
 */
bool ladder_side_file_save(LadderSideFile *file, GError **error);
/** ladder_side_file_commit - emits "commit". @file: a LadderSideFile */
void ladder_side_file_commit(gpointer file);
/** ladder_side_file_is_saved - commits first. */
bool ladder_side_file_is_saved(LadderSideFile *file);
/** ladder_side_file_differs - is the text another than in the file, or the file gone? An open
 * cell does not count. */
bool ladder_side_file_differs(LadderSideFile *file);
/** ladder_side_file_look - checks whether the file is there. @file: a LadderSideFile */
void ladder_side_file_look(gpointer file);

/** side_file_find - the open file at @path, of this document; NULL: not open. Borrowed. */
LadderSideFile *side_file_find(LadderDocument *document, const char *path);

/* ---- which files belong to a project ---- */

/**
 * side_file_list - paths of files in the folder of @path (or NULL: none), and in its folder
 * `boards`, that end in @ending, sorted
 * @own: those of this program: `NAME.io`, `NAME-2.io` beside NAME.rung, unless another
 *       program has the longer part of that name; false: all others
 *
 * Caller: g_ptr_array_unref. Any thread.
 */
GPtrArray *side_file_list(const char *path, const char *ending, bool own);
/** side_file_is - has @path the ending of one: `.scn`, `.io`? */
bool side_file_is(const char *path);
/**
 * side_file_project - the project that the scenario or I/O map @path belongs to
 *
 * A folder or file of plain IEC text with its name, if there is no rung file with it. Else the program of its folder that has the longest part of its name, else the only one there
 * that is no plant; for a folder `boards`, also of the folder above. Caller: g_free(). NULL:
 * it belongs to no project.
 */
char *side_file_project(const char *path);

#endif
