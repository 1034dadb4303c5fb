/* SPDX-License-Identifier: MIT
 *
 * text_scheme - the colours of a source view, light or dark.
 */
#ifndef EDITOR_TEXT_SCHEME_H
#define EDITOR_TEXT_SCHEME_H

#include <gtksourceview/gtksource.h>

/** text_scheme_follow - @buffer follows the light or dark style of the desktop. */
void text_scheme_follow(GtkSourceBuffer *buffer);

#endif
