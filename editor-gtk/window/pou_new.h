/* SPDX-License-Identifier: MIT
 *
 * pou_new - asks for the name of a new program or block, or of a copy of one, and makes it.
 *
 * A name that cannot be taken is refused at the entry.
 */
#ifndef EDITOR_POU_NEW_H
#define EDITOR_POU_NEW_H

#include "editor-gtk/window/core.h"

/** pou_new_ask - asks for name, kind and language; the last two are proposed. */
void pou_new_ask(struct core *core, enum pou_kind kind, enum pou_language language);
/** pou_duplicate_ask - asks for the name of a copy of POU @pou. */
void pou_duplicate_ask(struct core *core, int pou);

#endif
