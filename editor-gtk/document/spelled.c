/* SPDX-License-Identifier: MIT
 *
 * spelled - the spelling of addresses for the texts of a document; see spelled.h.
 */
#include "editor-gtk/document/spelled.h"

#include "engine/base/name.h"

#include <string.h>

static bool has(const struct project *project, const struct var_table *vars, const char *text, size_t len)
{
	bool is = false;

	for (int i = 0; i < vars->count && !is; i++)
		is = name_is(project_text(project, vars->var[i].name), text, len);
	return is;
}

static bool is_name(void *document, const char *text, size_t len)
{
	const struct project *project = ladder_document_project(document);
	bool is = project && has(project, &project->globals, text, len);

	for (int i = 0; project && i < project->pou_count && !is; i++)
		is = has(project, &project->pou[i].vars, text, len);
	return is;
}

struct spelling_rule spelled_rule(LadderDocument *document, enum spelling spelling)
{
	return (struct spelling_rule){ spelling, is_name, document };
}

static char *spelled(LadderDocument *document, enum spelling spelling, const char *text)
{
	const struct spelling_rule rule = spelled_rule(document, spelling);

	return spelling_text(&rule, text);
}

char *spelled_shown(LadderDocument *document, const char *text)
{
	return spelled(document, spelling_screen(), text);
}

char *spelled_canonical(LadderDocument *document, const char *line)
{
	const bool jumps = name_begins("JMP ", 4, line, strlen(line)); /* a label may look like anything */

	return jumps ? g_strdup(line) : spelled(document, SPELLING_IEC, line);
}
