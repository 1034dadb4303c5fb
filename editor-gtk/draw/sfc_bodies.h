/* SPDX-License-Identifier: MIT
 *
 * sfc_bodies - conditions and actions of a chart that are rungs or lists, in the order in
 * which they follow the chart on paper.
 */
#ifndef EDITOR_SFC_BODIES_H
#define EDITOR_SFC_BODIES_H

#include "engine/model/project.h"

struct sfc_part_body {
	const struct sfc_body *body;   /* borrowed from the chart              */
	char *heading;                 /* "Ready: Idle → Fill", "Count"         */
};

/** sfc_bodies_new - @count gets how many. Without expressions, which are drawn beside their
 * transition. Owns: the caller, sfc_bodies_free(). */
struct sfc_part_body *sfc_bodies_new(const struct project *project, const struct pou *pou,
				     int *count);
void sfc_bodies_free(struct sfc_part_body *bodies, int count);
/** sfc_bodies_ways - "Idle → Fill": the steps before and behind a transition. Caller frees. */
char *sfc_bodies_ways(const struct project *project, const struct sfc *sfc, int transition);
/** sfc_body_heading - of the body whose first rung is @first, or of an expression; @count
 * gets its number of rungs. Caller frees; NULL: no body begins there. */
char *sfc_body_heading(const struct project *project, const struct pou *pou, int first,
		       int *count);
/** sfc_body_lines - the lines of a list. Owns: the caller, g_strfreev. */
char **sfc_body_lines(const struct project *project, const struct pou *pou,
		      const struct sfc_body *body);

#endif
