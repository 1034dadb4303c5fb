/* SPDX-License-Identifier: MIT
 *
 * timing_kept - the variables of the timing chart that a project keeps.
 *
 * They are lines of the file's VIEW part, from top to bottom of the chart:
 *
 *   timing Start
 *   timing Main.Delay.ET
 *
 * A name need not be one of the program. It draws nothing.
 */
#ifndef EDITOR_TIMING_KEPT_H
#define EDITOR_TIMING_KEPT_H

#include "editor-gtk/document/document.h"

/** timing_kept_read - the names in a VIEW part, in its order; none: nobody chose any. Caller:
 * g_strfreev(). */
char **timing_kept_read(const char *view);
/** timing_kept_write - @view with these names in the place of those that it had; its other
 * lines stay. Caller frees. */
char *timing_kept_write(const char *view, const char *const *names);
/** timing_kept_put - the same in a document, as a step of its history. Nothing happens if it
 * has these very names, or is one of text. */
void timing_kept_put(LadderDocument *document, const char *const *names);

#endif
