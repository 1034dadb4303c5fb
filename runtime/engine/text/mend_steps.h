/* SPDX-License-Identifier: MIT
 *
 * mend_steps - an instruction whose operand is a calculation, as several instructions.
 */
#ifndef TEXT_MEND_STEPS_H
#define TEXT_MEND_STEPS_H

#include "engine/text/mend.h"

/** mend_in_steps - `LD A = B` as LD A and EQ B: @out gets DIAG_SEVERAL_STEPS, and the lines with
 * DIAG_AND between them. False: the operand is no calculation with two operands. Owns: nothing.
 * Scan-safe: no. */
bool mend_in_steps(const struct mend_line *line, struct mended *out);
#endif
