/* SPDX-License-Identifier: MIT
 *
 * code_view - the instruction list that the sheet in front becomes. It cannot be edited.
 *
 * The list is made when somebody looks at it: that of a large program takes long, and a text
 * widget holds it in many times its size.
 */
#ifndef EDITOR_CODE_VIEW_H
#define EDITOR_CODE_VIEW_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** ladder_code_view_new - of the first program. */
GtkWidget *ladder_code_view_new(LadderDocument *document);
void ladder_code_view_set_pou(GtkWidget *view, int pou);

#endif
