/* SPDX-License-Identifier: MIT
 *
 * instances - the instances of a function block; see instances.h.
 */
#include "editor-gtk/document/instances.h"

#include <glib.h>
#include <stdbool.h>

static const struct pou *block_of(const struct project *project, enum word word)
{
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_BLOCK && project->pou[i].word == word)
			return &project->pou[i];
	return NULL;
}

/* Appends the names down to the first instance of @word, "Cell.Lift". No block that can be read
 * contains itself. */
static bool find(const struct project *project, const struct var_table *vars, enum word word,
		 GString *path)
{
	const gsize before = path->len;

	for (int i = 0; i < vars->count; i++) {
		const struct var *var = &vars->var[i];
		const struct pou *block = var->type == IEC_NONE && var->array.count == 0 ?
					  block_of(project, var->fb) : NULL;

		if (!block)
			continue;
		g_string_append_printf(path, "%s%s", before ? "." : "",
				       project_text(project, var->name));
		if (var->fb == word || find(project, &block->vars, word, path))
			return true;
		g_string_truncate(path, before);
	}
	return false;
}

char *instance_first(const struct project *project, int pou)
{
	const struct pou *block = &project->pou[pou];
	GString *path = g_string_new(NULL);
	bool found = block->kind == POU_BLOCK;

	if (found && !find(project, &project->globals, block->word, path)) {
		found = false;
		for (int i = 0; !found && i < project->pou_count; i++) {
			const struct pou *from = &project->pou[i];

			if (pou_has_frame(from))
				continue;
			g_string_assign(path, project_text(project, from->name));
			found = find(project, &from->vars, block->word, path);
		}
	}
	return g_string_free(path, !found);
}
