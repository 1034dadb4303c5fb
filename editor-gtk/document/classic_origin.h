/* SPDX-License-Identifier: MIT
 *
 * classic_origin - the ClassicLadder project that a document comes from: its report, and
 * which original rung each rung comes from.
 *
 * It follows the rungs through edits, moves, undo, and from one POU to another. A deleted
 * rung that undo or paste brings back is recognised by its text. This is not saved in the
 * file: a file that is opened later has no original.
 */
#ifndef EDITOR_CLASSIC_ORIGIN_H
#define EDITOR_CLASSIC_ORIGIN_H

#include "editor-gtk/document/document.h"

#include "engine/exchange/drawing.h"
#include "engine/exchange/report.h"

#define LADDER_TYPE_ORIGIN (ladder_origin_get_type())
G_DECLARE_FINAL_TYPE(LadderOrigin, ladder_origin, LADDER, ORIGIN, GObject)

/** ladder_origin_new - @document is the import of @path, not yet edited
 * @path:   taken over, g_free()
 * @ladder: the engine that loaded it (classic_import()); taken over */
LadderOrigin *ladder_origin_new(LadderDocument *document, char *path,
				struct ladder *ladder);
/** ladder_origin_path - as the user gave it. Borrowed, as are the next two. */
const char *ladder_origin_path(LadderOrigin *origin);
const struct classic_project *ladder_origin_project(LadderOrigin *origin);
const struct classic_report *ladder_origin_report(LadderOrigin *origin);
/** ladder_origin_io - its table of lines as an I/O map; NULL: it has none. Borrowed. */
const char *ladder_origin_io(LadderOrigin *origin);
/** ladder_origin_of - the original of rung @rung of POU @pou, 0-based; NULL: it has none. */
const struct classic_rung *ladder_origin_of(LadderOrigin *origin, int pou, int rung);
/** ladder_origin_drawing - how another tool has drawn rung or network @number, 0-based, of POU @pou; NULL: it
 * has not. Borrowed. */
const struct drawing *ladder_origin_drawing(LadderOrigin *origin, int pou, int number);
/** ladder_origin_became - the rungs of @pou that come from @from, int, 0-based. @pou gets
 * the first POU with such a rung; -1: there is none. Caller: g_array_unref(). */
GArray *ladder_origin_became(LadderOrigin *origin, const struct classic_rung *from,
			     int *pou);
/** ladder_origin_at - the rung whose lines include this place of the files; NULL: none. */
const struct classic_rung *ladder_origin_at(LadderOrigin *origin, const char *member,
					    int line);
#endif
