/* SPDX-License-Identifier: MIT
 *
 * exchange - a project that came from ClassicLadder, or goes there: what changed on the way,
 * the originals of its rungs, and writing it. An export does not save the document.
 */
#ifndef EDITOR_EXCHANGE_H
#define EDITOR_EXCHANGE_H

#include "editor-gtk/window/export.h"

struct exchange {
	struct core *core;
	struct origin *origin;
	struct export *export;
};

/** exchange_init - adds the panel, which is offered when there is a report. */
void exchange_init(struct exchange *exchange, struct core *core, struct origin *origin,
		 struct export *export);
/** exchange_show - the panel, with the keys. */
void exchange_show(struct exchange *exchange);
/** exchange_show_original - of the rung at the cursor, which it follows from then on. */
void exchange_show_original(struct exchange *exchange);
/** exchange_imported - the document was made from the origin's ClassicLadder project; a banner
 * tells that. */
void exchange_imported(struct exchange *exchange);
/** exchange_export - asks for a file of ClassicLadder. */
void exchange_export(struct exchange *exchange);
/** exchange_export_to - false: it could not be written, which is told. */
bool exchange_export_to(struct exchange *exchange, const char *path);
/** exchange_add_filter - files of ClassicLadder. @numbers: bare rung files too, and it is the
 * filter that is chosen. */
void exchange_add_filter(GtkFileChooser *chooser, bool numbers);

#endif
