/* SPDX-License-Identifier: MIT
 *
 * reserved - names that a project cannot declare.
 */
#ifndef CHECK_RESERVED_H
#define CHECK_RESERVED_H

#include "engine/base/diag.h"

/** reserved_word - reserved word number @i, in any order; "" for an empty slot, NULL after the
 * last. Scan-safe: yes. */
const char *reserved_word(int i);
/** reserved_of_rungs - a reserved word that only rung files have. Scan-safe: yes. */
bool reserved_of_rungs(const char *name);
/** reserved_generated - `_T12`: translation makes names of this form, with one of eight letters and a number from 1
 * on. Scan-safe: yes. */
bool reserved_generated(const char *name);
/**
 * reserved_fault - why nothing can have this name, wherever it stands
 *
 * DIAG_EXPECTED: it is no name at all; DIAG_RESERVED_NAME; DIAG_SHADOWS_ADDRESS, which
 * is only a warning; DIAG_COUNT: it is well.   Scan-safe: yes.
 */
enum diag_id reserved_fault(const char *name);

#endif
