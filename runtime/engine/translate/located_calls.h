/* SPDX-License-Identifier: MIT
 *
 * located_calls - structures and arrays at an address, as a whole, in the lists of all languages.
 */
#ifndef TRANSLATE_LOCATED_CALLS_H
#define TRANSLATE_LOCATED_CALLS_H

#include "engine/translate/translate.h"

/** located_calls - rewrites @il, the list of @unit that runs or is watched, before its types are found: copies part by
 * part in place of what takes a structure or an array at an address as a whole. Scan-safe: no. Fails: false: no memory. */
bool located_calls(struct translation *translation, struct unit *unit, struct il *il);
#endif
