/* SPDX-License-Identifier: MIT
 *
 * plain_file - files of plain IEC text that are opened in the editor.
 *
 * One file in UTF-8 is a document like a rung file. The files of a folder, and a file of another tool,
 * become one text in a new document, which is saved under another name.
 */
#ifndef EDITOR_PLAIN_FILE_H
#define EDITOR_PLAIN_FILE_H

#include "editor-gtk/document/document.h"

/* The endings that file dialogs offer; the last is NULL. */
extern const char *const plain_file_patterns[];
/** plain_file_is - has @path such an ending? */
gboolean plain_file_is(const char *path);
/** plain_file_numbers - @text with the words that mean elsewhere what DWORD_TO_REAL and its like mean in
 * files of CODESYS and TwinCAT: the number, not the bits. Caller: g_free. */
char *plain_file_numbers(const char *text, gsize *len);
/** plain_file_join - the files of plain IEC text that @ladder has loaded without an error, as one such
 * text. Caller: g_free. Fails: NULL: no memory. */
char *plain_file_join(struct ladder *ladder, gsize *len);
/**
 * plain_file_import - the text of a folder, or of a file of another tool
 *
 * Owns: the caller, g_free(). Fails: NULL: it is none of both, or it has errors; it can be opened
 * as it is.
 */
char *plain_file_import(const char *path, gsize *len);
#endif
