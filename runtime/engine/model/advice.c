/* SPDX-License-Identifier: MIT
 *
 * advice - suggestions in messages, if the program that loads has set an adviser.
 *
 * It knows no words itself; check/expect.c does.
 */
#include "engine/model/advice.h"

#include "engine/model/project.h"

#include <stdio.h>

/* Messages beyond this number have no suggestions. */
#define SUGGEST_MOST 20

enum diag_id advice_word(const struct project *project, const struct pou *pou,
			 unsigned int kinds, const struct diag_list *diags, const char *wanted,
			 char *out, size_t size)
{
	if (project->advice && diags->errors < SUGGEST_MOST)
		return project->advice->nearest(project, pou, kinds, wanted, out, size);
	snprintf(out, size, "%s", wanted);
	return DIAG_COUNT;
}
