/* SPDX-License-Identifier: MIT
 *
 * watch_names - names for a status chart: what could be meant, and which variables one
 * typed line means. It shows nothing.
 */
#ifndef EDITOR_WATCH_NAMES_H
#define EDITOR_WATCH_NAMES_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/kit/entry_popup.h"

#include "engine/scan/image.h"

#define WATCH_NAMES_MOST 512 /* variables that one line may mean                */

/**
 * watch_names_expand - the variables that a line means, of char *
 * @image: of the program; NULL: there is none, and the line is taken as it is
 *
 * `Motor`, several parted by blanks, ranges as in scripts (`%Q0..7`, `Table[1..4]`), an
 * instance as a whole: its pins. What the program does not know stays. Caller:
 * g_ptr_array_unref().
 */
GPtrArray *watch_names_expand(const struct image *image, const char *line);

/** watch_names_offer - rows for what the word before @cursor (bytes) could become, put into
 * @popup. @image as above. */
void watch_names_offer(LadderDocument *document, const struct image *image,
		       const char *line, gsize cursor, LadderEntryPopup *popup);

#endif
