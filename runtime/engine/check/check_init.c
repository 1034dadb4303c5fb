/* SPDX-License-Identifier: MIT
 *
 * check_init - initial values of what has parts: the walk does the work, here it is
 * said what was wrong, and where.
 */
#include "engine/check/check_init.h"

static bool report(const struct project *project, const struct var *var,
		   const struct init_walk *walk, struct diag_list *diags,
		   struct diag place)
{
	char where[LIMIT_ARG];

	place.id = walk->why;
	init_where(walk, where, sizeof(where));
	return diag_add(diags, place, "%s%s%s%.*s",
			project_text(project, var->name), where,
			walk->arg_len ? ": " : "",
			(int)(walk->arg_len < LIMIT_ARG ? walk->arg_len : LIMIT_ARG),
			walk->arg_len ? walk->arg : "");
}

bool check_init(const struct project *project, const struct var *var,
		struct init_walk **walk, struct arena *scratch,
		struct diag_list *diags, struct diag place)
{
	struct init_value value;

	if (!*walk)
		*walk = arena_alloc(scratch, sizeof(**walk));
	if (!*walk)
		return false; /* the caller tells that memory is out */
	init_begin(*walk, project, var, scratch);
	while (init_next(*walk, &value))
		continue;
	return (*walk)->why == DIAG_COUNT ||
	       report(project, var, *walk, diags, place);
}
