/* SPDX-License-Identifier: MIT
 *
 * watch_names - the variables that a typed line means, and completion of a name in it.
 */
#ifndef EDITOR_WATCH_NAMES_H
#define EDITOR_WATCH_NAMES_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/kit/entry_popup.h"
#include "editor-gtk/live/watch.h"

#include "engine/scan/image.h"

#define WATCH_NAMES_MOST 512 /* variables that one line may mean                */

/**
 * watch_names_expand - the variables that a line means, of char *
 * @image: of the program; NULL: there is none, and the line is taken as it is
 *
 * The line has names separated by blanks: `Motor`, a range as in scripts (`%Q0..7`,
 * `Table[1..4]`), an instance, which means all its pins. Unknown names are kept. Caller:
 * g_ptr_array_unref().
 */
GPtrArray *watch_names_expand(const struct image *image, const char *line);

/** watch_names_unfold - replaces each line of @charts, struct watch *, that names an instance or
 * a range by lines of its variables, but those that the chart lists in this format. They get its
 * format, the first one its comment, too. @image: as above. */
void watch_names_unfold(const struct image *image, GPtrArray *charts);

/** watch_names_drop_listed - removes those @names that a line of @lines, struct watch_line *,
 * with @format shows, in any form of the name: `Delay.Q` and `Main.Delay.Q` are one. Returns the
 * last line that does; -1: none does. @image: as above. */
int watch_names_drop_listed(const struct image *image, GPtrArray *names, GPtrArray *lines,
			    enum live_format format);

/** watch_names_offer - adds rows to @popup that complete the word before @cursor (in bytes).
 * @image: as above. */
void watch_names_offer(LadderDocument *document, const struct image *image,
		       const char *line, gsize cursor, LadderEntryPopup *popup);

#endif
