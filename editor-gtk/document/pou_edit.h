/* SPDX-License-Identifier: MIT
 *
 * pou_edit - programs and blocks come and go.
 *
 * Each is one step of the history, made as a change of the text.
 */
#ifndef EDITOR_POU_EDIT_H
#define EDITOR_POU_EDIT_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** pou_add - @what: "PROGRAM LD", "FUNCTION_BLOCK LD"; named anew, and shown from
 * @widget by "win.go-to". Returns NULL; else why none comes, translated, static. */
const char *pou_add(GtkWidget *widget, LadderDocument *document, const char *what);
/** pou_delete - with all that is in it; the last one stays, and one of another file.
 * Returns NULL; else why it stays, translated, static. */
const char *pou_delete(LadderDocument *document, int pou);

#endif
