/* SPDX-License-Identifier: MIT
 *
 * keep - the state of a twin in few bytes: what differs from that of another one.
 *
 * Both are twins of the same programs. Most of a memory never changes, and most of what
 * changes are bits; the rest is kept as it is. It knows nothing of scans and acts.
 */
#ifndef TRIAL_KEEP_H
#define TRIAL_KEEP_H

#include "engine/trial/twin.h"

/** keep_most - bytes that a state takes at most.   Scan-safe: yes. */
size_t keep_most(const struct twin *twin);
/** keep_put - the state of @twin at @to, as it differs from @base
 * @to: keep_most() bytes   Returns how many it took.   Scan-safe: as twin_copy(). */
size_t keep_put(const struct twin *twin, const struct twin *base, uint8_t *to);
/** keep_get - the state at @from into @twin. @base: as it was when it was put.
 * Scan-safe: as twin_copy(). */
void keep_get(struct twin *twin, const struct twin *base, const uint8_t *from);
#endif
