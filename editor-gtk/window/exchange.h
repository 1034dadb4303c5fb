/* SPDX-License-Identifier: MIT
 *
 * exchange - import from and export to ClassicLadder: the report, the originals of rungs,
 * and writing a file.
 *
 * An export does not mark the document as saved.
 */
#ifndef EDITOR_EXCHANGE_H
#define EDITOR_EXCHANGE_H

#include "editor-gtk/window/export.h"

struct exchange {
	struct core *core;
	struct origin *origin;
	struct export *export;
};

/** exchange_init - adds the panel; its tab is hidden until there is a report. */
void exchange_init(struct exchange *exchange, struct core *core, struct origin *origin,
		 struct export *export);
/** exchange_show - shows and focuses the panel. */
void exchange_show(struct exchange *exchange);
/** exchange_show_original - shows the original of the rung at the cursor; it follows the
 * cursor. */
void exchange_show_original(struct exchange *exchange);
/** exchange_imported - shows a banner: the document was made from the ClassicLadder project
 * of @origin. */
void exchange_imported(struct exchange *exchange);
/** exchange_export - asks for a file and exports. */
void exchange_export(struct exchange *exchange);
/** exchange_export_to - false: writing failed, and a banner says why. */
bool exchange_export_to(struct exchange *exchange, const char *path);
/** exchange_add_others - adds filters for the files of other tools that are only read. */
void exchange_add_others(GtkFileChooser *chooser);
/** exchange_add_filter - adds a filter for ClassicLadder files. @numbers: it also has
 * rung_N.txt. @chosen: it is the one that is chosen. */
void exchange_add_filter(GtkFileChooser *chooser, bool numbers, bool chosen);

#endif
