/* SPDX-License-Identifier: MIT
 *
 * sfc - a chart in the walker.
 */
#ifndef WALKER_SFC_H
#define WALKER_SFC_H

#include "tests/walker/grid.h"

struct played_sfc;

/** sfc_new - the chart of a POU, before its first scan; its rungs are the caller's.
 * Fails: NULL: no memory, or not supported. */
struct played_sfc *sfc_new(struct walker *walker, struct walked_pou *walked);
/** sfc_walk - one scan. False: a fault. */
bool sfc_walk(struct walker *walker, struct played_sfc *played);
/** rung_body - the condition or action that contains a rung of a chart; NULL: none. */
const struct sfc_body *rung_body(const struct sfc *sfc, int rung);

/* walker.c */
/** walk_rungs - runs @count rungs, which no jump leaves. False: too many steps. */
bool walk_rungs(struct walker *walker, struct walked_pou *walked, int first, int count);

/* list.c */
/** walk_list - runs lines of the POU's list; gives its last result. False: a fault. */
bool walk_list(struct walker *walker, struct walked_pou *walked,
	       const struct sfc_body *body, struct value *result);

/* statements.c */
/** walk_statements - runs @count statements of Structured Text. False: a fault, or not supported. */
bool walk_statements(struct walker *walker, struct walked_pou *walked, int first, int count);
#endif
