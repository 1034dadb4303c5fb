/* SPDX-License-Identifier: MIT
 *
 * pou_edit - adds and deletes programs and blocks.
 *
 * Each edit is one step of the history, made as a change of the text.
 */
#ifndef EDITOR_POU_EDIT_H
#define EDITOR_POU_EDIT_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** pou_add - @what: "PROGRAM LD", "FUNCTION_BLOCK LD"; gives it a new name, and shows it by
 * "win.go-to" on @widget. Returns NULL, or why it failed, translated, static. */
const char *pou_add(GtkWidget *widget, LadderDocument *document, const char *what);
/** pou_uses - the number of places outside of a POU that use it. */
int pou_uses(LadderDocument *document, int pou);
/** pou_delete - deletes a POU, but not the last one or one of another file, and with it what
 * cannot be read without it: its boxes, its instances, and lines of lists that call it.
 * Returns NULL, or why it failed, translated, static. */
const char *pou_delete(LadderDocument *document, int pou);

#endif
