/* SPDX-License-Identifier: MIT
 *
 * classic_name - finds variables of an imported program by their names in ClassicLadder
 * (%B3, %TM0.V, %X2.A).
 *
 * An import gives names that allow this: bits and words have fixed addresses, names of
 * blocks and steps begin with their old name. A name that the program has itself takes
 * precedence.
 */
#ifndef TRIAL_CLASSIC_NAME_H
#define TRIAL_CLASSIC_NAME_H

#include "engine/scan/image.h"

/** classic_name_find - the variable; IEC_NONE: not such a name, or no variable for it.
 * Scan-safe: no. */
struct location classic_name_find(const struct image *image, const char *name, size_t len);
#endif
