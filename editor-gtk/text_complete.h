/* SPDX-License-Identifier: MIT
 *
 * text_complete - colours of IL and rung files, and what could stand at the cursor.
 *
 * The words are the catalogue's, what could follow is what the engine says.
 */
#ifndef EDITOR_TEXT_COMPLETE_H
#define EDITOR_TEXT_COMPLETE_H

#include "editor-gtk/document.h"

#include <gtksourceview/gtksource.h>

/** text_language - of rung files; NULL: there is none on this machine. Borrowed. */
GtkSourceLanguage *text_language(void);
/** text_complete_attach - offers words while one types in @view, which shows POU @pou of
 * @document, or all of it (-1). */
void text_complete_attach(GtkSourceView *view, LadderDocument *document, int pou);

#endif
