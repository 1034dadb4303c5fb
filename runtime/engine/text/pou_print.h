/* SPDX-License-Identifier: MIT
 *
 * pou_print - one POU as a text that reads again.
 */
#ifndef TEXT_POU_PRINT_H
#define TEXT_POU_PRINT_H

#include "engine/base/sink.h"
#include "engine/model/project.h"

/**
 * pou_print - the canonical text of one POU, from PROGRAM to its END_PROGRAM
 * @pou: one of the project's, or a changed copy of one
 *
 * Owns: the caller, free(); NUL-ended.   Scan-safe: no.   Fails: NULL: no memory.
 */
char *pou_print(const struct project *project, const struct pou *pou);

/** pou_temps_used - which of @temps, @count of them, the list names, or a part of: @used gets 1 for them. Scan-safe: no.
 * Fails: false: no memory. */
bool pou_temps_used(const struct names *names, const struct il *il, struct var *const *temps, int count, uint8_t *used);
/**
 * pou_print_il - a POU as `PROGRAM Name IL … END_PROGRAM`
 * @pou:   of @project: its kind and name are used
 * @vars:  its own variables
 * @temps: variables that translation added, @temp_count of them; those that @il
 *         does not use are left out
 * @il:    the list; it reads again to the same list
 *
 * Scan-safe: no.   Fails: false: no memory; nothing was printed.
 */
bool pou_print_il(const struct project *project, const struct pou *pou,
		  const struct var_table *vars, struct var *const *temps,
		  int temp_count, const struct il *il,
		  const struct sink *sink);

#endif
