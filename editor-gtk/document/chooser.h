/* SPDX-License-Identifier: MIT
 *
 * chooser - where people are asked for a file: first beside the one they work on.
 */
#ifndef EDITOR_CHOOSER_H
#define EDITOR_CHOOSER_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** chooser_beside - begins in the folder of the document, if that has one. */
void chooser_beside(GtkFileChooserNative *chooser, LadderDocument *document);

#endif
