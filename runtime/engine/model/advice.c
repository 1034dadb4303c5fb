/* SPDX-License-Identifier: MIT
 *
 * advice - asks for what only people at a desk are told, if there is somebody to ask.
 *
 * It knows no words itself; check/expect.c does.
 */
#include "engine/model/advice.h"

#include "engine/model/project.h"

#include <stdio.h>

/* After so many messages nobody is told what may have been meant. */
#define SUGGEST_MOST 20

void advice_word(const struct project *project, const struct pou *pou,
		 unsigned int kinds, const struct diag_list *diags, const char *wanted,
		 char *out, size_t size)
{
	if (project->advice && diags->count < SUGGEST_MOST)
		project->advice->nearest(project, pou, kinds, wanted, out, size);
	else
		snprintf(out, size, "%s", wanted);
}
