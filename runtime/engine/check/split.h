/* SPDX-License-Identifier: MIT
 *
 * split - SPLIT_DATE, SPLIT_TOD and SPLIT_DT of IEC 61131-3 table 36, as statements.
 *
 * They have several outputs, which no function of the catalogue has. A call is the functions of
 * one part each, YEAR_OF and so on, on a value that is computed once. A word of the project with
 * such a name hides them.
 */
#ifndef CHECK_SPLIT_H
#define CHECK_SPLIT_H

#include "engine/check/scope.h"
#include "engine/model/st.h"

struct split {
	const char *word;
	uint16_t takes;  /* enum iec_class of IN                               */
	uint8_t count;   /* parts                                              */
	struct split_part { const char *pin; enum word fn; } part[7];
};

/** split_find - what the statement calls; NULL: something else. Scan-safe: no. */
const struct split *split_find(struct scope *scope, const struct pou *pou, const struct expr_node *callee);
/** split_pin - which pin an argument goes to: 0 is IN, others the parts from 1 on; -1: there is none
 * @last: the one of the argument before, if that has no name; -1 before the first
 * Scan-safe: yes. */
int split_pin(const struct split *split, const struct st_part *part, int *last);
#endif
