/* SPDX-License-Identifier: MIT
 *
 * classic_origin - the ClassicLadder project that a document comes from: its report, and
 * which of its rungs each rung here came of.
 *
 * It follows the rungs of the document: through edits, moves, undo, and from one POU to
 * another. A rung that was deleted and comes back by undo or paste is known again, by its
 * text. It is not kept in the file: who opens that later has no original.
 */
#ifndef EDITOR_CLASSIC_ORIGIN_H
#define EDITOR_CLASSIC_ORIGIN_H

#include "editor-gtk/document/document.h"

#include "engine/exchange/report.h"

#define LADDER_TYPE_ORIGIN (ladder_origin_get_type())
G_DECLARE_FINAL_TYPE(LadderOrigin, ladder_origin, LADDER, ORIGIN, GObject)

/** ladder_origin_new - @document is what @path became, as it is now
 * @path:   taken over, g_free()
 * @ladder: what has loaded it (classic_import()); taken over */
LadderOrigin *ladder_origin_new(LadderDocument *document, char *path,
				struct ladder *ladder);
/** ladder_origin_path - as the person gave it. Borrowed, as the next two. */
const char *ladder_origin_path(LadderOrigin *origin);
const struct classic_project *ladder_origin_project(LadderOrigin *origin);
const struct classic_report *ladder_origin_report(LadderOrigin *origin);
/** ladder_origin_io - its table of lines as an I/O map; NULL: it has none. Borrowed. */
const char *ladder_origin_io(LadderOrigin *origin);
/** ladder_origin_of - what rung @rung of POU @pou came of, 0-based; NULL: of nothing there. */
const struct classic_rung *ladder_origin_of(LadderOrigin *origin, int pou, int rung);
/** ladder_origin_became - the rungs of @pou that came of @from, int, 0-based; @pou gets
 * the first POU that has one, -1: none has. Caller: g_array_unref(). */
GArray *ladder_origin_became(LadderOrigin *origin, const struct classic_rung *from,
			     int *pou);
/** ladder_origin_at - the rung in whose part of the files that place is; NULL: none. */
const struct classic_rung *ladder_origin_at(LadderOrigin *origin, const char *member,
					    int line);
#endif
