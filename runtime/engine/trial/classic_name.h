/* SPDX-License-Identifier: MIT
 *
 * classic_name - what a variable of ClassicLadder (%B3, %TM0.V, %X2.A) is called in a
 * program that was imported from it.
 *
 * The names that an import gives are made so that they can be found again: bits and words
 * have fixed addresses, blocks and steps begin with their old name. Other names of such a
 * program win.
 */
#ifndef TRIAL_CLASSIC_NAME_H
#define TRIAL_CLASSIC_NAME_H

#include "engine/scan/image.h"

/** classic_name_find - the variable; IEC_NONE: it is no such name, or nothing has it.
 * Scan-safe: no. */
struct location classic_name_find(const struct image *image, const char *name, size_t len);
#endif
