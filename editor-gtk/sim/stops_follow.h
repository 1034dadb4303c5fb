/* SPDX-License-Identifier: MIT
 *
 * stops_follow - breakpoints stay at their lines while the document changes.
 *
 * A sheet of text, which knows better where its lines go, asks it to wait while it types.
 */
#ifndef EDITOR_STOPS_FOLLOW_H
#define EDITOR_STOPS_FOLLOW_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/sim/breakpoints.h"

struct stops_follow;

/** stops_follow_new - both are borrowed. Owns: stops_follow_free(), before they go. */
struct stops_follow *stops_follow_new(LadderDocument *document, LadderBreakpoints *points);
void stops_follow_free(struct stops_follow *follow);
/** stops_follow_hold - from now on a sheet moves the breakpoints; false: it has done so. */
void stops_follow_hold(struct stops_follow *follow, bool hold);

#endif
