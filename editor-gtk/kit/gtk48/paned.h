/* SPDX-License-Identifier: MIT
 *
 * paned - the handle of a paned takes no presses while one of its two children is hidden.
 *
 * Mends in GTK 4.8.3: GtkPaned does not show its handle then, but its gesture still takes each press where
 * the handle was. A strip through the whole window does not answer clicks. To see it: hide the left panel
 * (F4) and click 220 px from the left edge, without paned_mend(). Try it without on each new floor:
 * tests/editor/kit/gtk48/test_paned.c.
 */
#ifndef EDITOR_GTK48_PANED_H
#define EDITOR_GTK48_PANED_H

#include <gtk/gtk.h>

/** paned_mend - once for each paned, also for those without children yet. */
void paned_mend(GtkPaned *paned);

#endif
