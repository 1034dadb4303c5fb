/* SPDX-License-Identifier: MIT
 *
 * beside - what belongs to this program, wherever it was built, installed or moved to.
 */
#ifndef EDITOR_BESIDE_H
#define EDITOR_BESIDE_H

#include <glib.h>

/**
 * beside_find - a file or folder of this program
 * @built:     as it lies beside the program in a build
 * @installed: below share/ of where the program is in bin/; NULL: nowhere
 *
 * Owns: the caller, g_free().   Fails: NULL: there is none.
 */
char *beside_find(const char *built, const char *installed);
#endif
