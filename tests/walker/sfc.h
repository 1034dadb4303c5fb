/* SPDX-License-Identifier: MIT
 *
 * sfc - a chart as the walker plays it.
 */
#ifndef WALKER_SFC_H
#define WALKER_SFC_H

#include "tests/walker/grid.h"

struct played_sfc;

/** sfc_new - the chart of a POU, before its first scan; its rungs are the caller's.
 * Fails: NULL: no memory, or it cannot be walked. */
struct played_sfc *sfc_new(struct walker *walker, struct walked_pou *walked);
/** sfc_walk - one scan. False: a fault. */
bool sfc_walk(struct walker *walker, struct played_sfc *played);
/** rung_body - the condition or action that a rung of a chart stands in; NULL: none. */
const struct sfc_body *rung_body(const struct sfc *sfc, int rung);

/* walker.c */
/** walk_rungs - so many rungs, which no jump leaves. False: too many steps. */
bool walk_rungs(struct walker *walker, struct walked_pou *walked, int first, int count);

/* list.c */
/** walk_list - lines of the POU's list; its last result. False: a fault. */
bool walk_list(struct walker *walker, struct walked_pou *walked,
	       const struct sfc_body *body, struct value *result);
#endif
