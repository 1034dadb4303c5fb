/* SPDX-License-Identifier: MIT
 *
 * entry_address - which part of a wrong address is wrong, and what may stand there.
 */
#ifndef EDITOR_ENTRY_ADDRESS_H
#define EDITOR_ENTRY_ADDRESS_H

#include "editor-gtk/edit/entry.h"

/** entry_blame_address - if what @entry is wrong about is a wrong address, its reason and its wrong
 * part become those of the address. */
void entry_blame_address(const struct entry_place *place, struct entry *entry);

#endif
