/* SPDX-License-Identifier: MIT
 *
 * why_values - the values of the operands in a cell, for the answers of why.h.
 *
 * Private to why.c.
 */
#ifndef TRIAL_WHY_VALUES_H
#define TRIAL_WHY_VALUES_H

#include "engine/trial/why.h"

/** why_operand - the value of a BOOL operand of a cell; false if it is not known. */
bool why_operand(const struct why_place *at, uint32_t operand);
/** why_values - `ET=20 PT=1000` of a block, `Level=3` of an expression; "": none. */
void why_values(const struct why_place *at, const struct cell *cell,
		const struct word_row *row, char *out, size_t size);
/** why_values_of - the same for the names in a text. */
void why_values_of(const struct why_place *at, const char *text, size_t len, char *out,
		   size_t size);
/** why_qualify - an expression with full names: those of the POU or instance get its
 * name in front. Returns its bytes; 0: no room. */
size_t why_qualify(const struct why_place *at, const char *text, size_t len, char *out,
		   size_t size);
#endif
