/* SPDX-License-Identifier: MIT
 *
 * type_new - asks for the name and the kind of a new data type, or for that of a copy, makes it, and shows
 * it on the page of data types.
 */
#ifndef EDITOR_TYPE_NEW_H
#define EDITOR_TYPE_NEW_H

#include "editor-gtk/window/core.h"

/** type_new_ask - @original: the type that is copied; NULL: a new one. */
void type_new_ask(struct core *core, const char *original);

#endif
