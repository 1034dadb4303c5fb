/* SPDX-License-Identifier: MIT
 *
 * drop - the names that a drop-down offers.
 */
#ifndef EDITOR_DROP_H
#define EDITOR_DROP_H

#include <gtk/gtk.h>

/** drop_fill - offers @names (const char *, copied). It does nothing if they are offered
 * already: a click would be lost if the list changed between press and release. */
void drop_fill(GtkDropDown *drop, const GPtrArray *names);

#endif
