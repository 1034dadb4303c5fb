/* SPDX-License-Identifier: MIT
 *
 * why_values - the values of what stands in a cell, for people who ask why.
 *
 * Private to why.c.
 */
#ifndef TRIAL_WHY_VALUES_H
#define TRIAL_WHY_VALUES_H

#include "engine/trial/why.h"

/** why_operand - the value of a BOOL that stands in a cell; false if it is not known. */
bool why_operand(const struct why_place *at, uint32_t operand);
/** why_values - `ET=20 PT=1000` of a block, `Level=3` of an expression; "": none. */
void why_values(const struct why_place *at, const struct cell *cell,
		const struct word_row *row, char *out, size_t size);
#endif
