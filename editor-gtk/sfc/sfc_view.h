/* SPDX-License-Identifier: MIT
 *
 * sfc_view - a chart as a person works on it, with a cursor.
 *
 * It shows what sfc_sheet and sfc_draw make, turns keys and gestures into the edits of
 * sfc_edit, and hands their texts to the document. It stands in a GtkScrolledWindow.
 *
 * Signals:
 *   cursor-moved ()
 *   told (const char *text)   why something was not done
 *   zoom-changed ()
 *   body-wanted (int first, int count)  rungs of the POU that shall be shown and edited;
 *                             count 0: those of a list, or none
 */
#ifndef EDITOR_SFC_VIEW_H
#define EDITOR_SFC_VIEW_H

#include "editor-gtk/sim/sim.h"
#include "editor-gtk/kit/verbs.h"
#include "engine/xref/xref.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_SFC_VIEW (ladder_sfc_view_get_type())
G_DECLARE_FINAL_TYPE(LadderSfcView, ladder_sfc_view, LADDER, SFC_VIEW, GtkWidget)

/** ladder_sfc_view_new - shows POU @pou of @document, a chart. */
GtkWidget *ladder_sfc_view_new(LadderDocument *document, int pou);
int ladder_sfc_view_pou(LadderSfcView *view);
void ladder_sfc_view_set_pou(LadderSfcView *view, int pou);
/** ladder_sfc_view_set_sim - what it shows while that runs; a reference is kept. */
void ladder_sfc_view_set_sim(LadderSfcView *view, LadderSim *sim);

/** ladder_sfc_view_do - a CHART verb, or one of BOTH. */
void ladder_sfc_view_do(LadderSfcView *view, enum verb verb);
/** ladder_sfc_view_why - the condition of the transition at the cursor shall be seen as
 * rungs, with their power; false: the cursor is on none. */
bool ladder_sfc_view_why(LadderSfcView *view);
/** ladder_sfc_view_go - the cursor goes to what stands in @rung (0-based). */
void ladder_sfc_view_go(LadderSfcView *view, int rung);
/** ladder_sfc_view_go_row - to what stands in a line of the POU's text, counted from its
 * heading, 0-based; to nothing, if that is no step, transition or action. */
void ladder_sfc_view_go_row(LadderSfcView *view, int row);
/** ladder_sfc_view_row - the line of the cursor, counted so; -1: it has none. */
int ladder_sfc_view_row(LadderSfcView *view);
/** ladder_sfc_view_is_at - is the cursor where ladder_sfc_view_go_row() would go? */
bool ladder_sfc_view_is_at(LadderSfcView *view, int row);
/** ladder_sfc_view_set_found - marks what stands in a line; -1: nothing. */
void ladder_sfc_view_set_found(LadderSfcView *view, int row);
/** ladder_sfc_view_use - of the name at the cursor: a step, what a line does, the first
 * name of a condition, a transition; NULL: there is none. Borrowed from @xref. */
const struct xref_use *ladder_sfc_view_use(LadderSfcView *view, const struct xref *xref);
/** ladder_sfc_view_place - "Step Fill": where the cursor is. Caller frees. */
char *ladder_sfc_view_place(LadderSfcView *view);
/** ladder_sfc_view_keys - what the next key could do. Caller frees. */
char *ladder_sfc_view_keys(LadderSfcView *view);
/** ladder_sfc_view_tip - comment of a shape, and what is wrong with it (sfc_layout.h), and what its line @use
 * (-1: none) means; NULL: nothing. Caller frees. */
char *ladder_sfc_view_tip(LadderSfcView *view, int shape, int use);

double ladder_sfc_view_zoom(LadderSfcView *view);
/** ladder_sfc_view_set_zoom - 0.3 to 3. */
void ladder_sfc_view_set_zoom(LadderSfcView *view, double zoom);

#endif
