/* SPDX-License-Identifier: MIT
 *
 * touch - can a write to one operand change what is read from another?
 */
#ifndef CHECK_TOUCH_H
#define CHECK_TOUCH_H

#include "engine/check/scope.h"

/** meaning_end - of an operand with an address: the byte of its area behind the last one that it
 * may cover. Scan-safe: yes. */
uint32_t meaning_end(const struct meaning *meaning);
/** meaning_touches - can a write to @a change what is read from @b? True too if nobody knows, as
 * of two elements of one array. Scan-safe: no. */
bool meaning_touches(const struct scope *scope, const struct meaning *a, const struct meaning *b);
#endif
