/* SPDX-License-Identifier: MIT
 *
 * listing - lines of text for paper: POUs in IL, the symbols of a project, and the places
 * that read the operand of a coil.
 */
#ifndef EDITOR_LISTING_H
#define EDITOR_LISTING_H

#include "engine/model/project.h"

#include <glib.h>

/** listing_il - the lines of a POU in IL, with heading and variables. Owns: the caller,
 * g_strfreev. NULL: out of memory. */
char **listing_il(const struct project *project, const struct pou *pou);

enum listing_column {
	LISTING_NAME, LISTING_TYPE, LISTING_ADDRESS, LISTING_INITIAL, LISTING_COMMENT,
	LISTING_COLUMNS
};
/** listing_first - the first declared variable; the result and ENO of a function come
 * before it. */
int listing_first(const struct var_table *table);
/** listing_count - the number of declared variables. */
int listing_count(const struct var_table *table);
/** listing_type - "ARRAY[1..4] OF INT". Owns: the caller, g_free. */
char *listing_type(const struct project *project, const struct var *var);
/** listing_symbol_count - declared variables of all tables of a project. */
int listing_symbol_count(const struct project *project);
/** listing_symbol - variable @index of a table. Owns: the caller, each g_free. */
void listing_symbol(const struct project *project, const struct var_table *table,
		    int index, char *cell[LISTING_COLUMNS]);
/** listing_reads_new - an index of the places that read operands. Owns: the caller,
 * listing_reads_free(); @project must outlive it. */
struct listing_reads *listing_reads_new(const struct project *project);
void listing_reads_free(struct listing_reads *reads);
/** listing_reads_of - "read in Main 3, 5" for the operand of a cell of POU @pou; NULL:
 * never read. At most @most places and an ellipsis; 0: all. Owns: the caller, g_free. */
char *listing_reads_of(const struct listing_reads *reads, int pou, const char *operand,
		       int most);

#endif
