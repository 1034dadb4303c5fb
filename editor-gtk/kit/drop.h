/* SPDX-License-Identifier: MIT
 *
 * drop - the names that a drop-down offers.
 */
#ifndef EDITOR_DROP_H
#define EDITOR_DROP_H

#include <gtk/gtk.h>

/** drop_fill - offers these @names (of const char *, copied). One that offers them already is
 * left as it is: a click would be lost whose press was before and whose release is after. */
void drop_fill(GtkDropDown *drop, const GPtrArray *names);

#endif
