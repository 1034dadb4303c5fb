/* SPDX-License-Identifier: MIT
 *
 * drop - the entries of a drop-down.
 */
#ifndef EDITOR_DROP_H
#define EDITOR_DROP_H

#include <gtk/gtk.h>

/** drop_fill - sets the entries (const char *, copied), unless they are the same already: a
 * click is lost if the list changes between press and release. */
void drop_fill(GtkDropDown *drop, const GPtrArray *names);

#endif
