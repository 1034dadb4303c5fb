/* SPDX-License-Identifier: MIT
 *
 * text_scheme - the colours of a text, which are others in the dark.
 */
#ifndef EDITOR_TEXT_SCHEME_H
#define EDITOR_TEXT_SCHEME_H

#include <gtksourceview/gtksource.h>

/** text_scheme_follow - @buffer has the colours of the style that the desktop has, now and
 * whenever that changes, as long as it lives. */
void text_scheme_follow(GtkSourceBuffer *buffer);

#endif
