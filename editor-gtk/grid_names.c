/* SPDX-License-Identifier: MIT
 *
 * grid_names - the index of names; see grid_names.h.
 */
#include "editor-gtk/grid_names.h"

#include <glib.h>

struct grid_names {
	const struct project *project;
	const struct pou *pou;       /* or NULL                                 */
	GHashTable *by_name, *by_address; /* text: struct var                  */
};

static guint hash_any_case(gconstpointer key)
{
	guint hash = 2166136261u;

	for (const char *at = key; *at; at++)
		hash = (hash ^ (guchar)g_ascii_tolower(*at)) * 16777619u;
	return hash;
}

static gboolean equal_any_case(gconstpointer a, gconstpointer b)
{
	return g_ascii_strcasecmp(a, b) == 0;
}

/* Locals come last and hide globals; the first of two at one address is its name. */
static void add_table(struct grid_names *names, const struct var_table *table)
{
	for (int i = 0; i < table->count; i++) {
		struct var *var = &table->var[i];
		char *name = (char *)project_text(names->project, var->name);
		char *address = (char *)project_text(names->project, var->at_text);

		g_hash_table_insert(names->by_name, name, var);
		if (*address && !var->array.count &&
		    !g_hash_table_contains(names->by_address, address))
			g_hash_table_insert(names->by_address, address, var);
	}
}

struct grid_names *grid_names_new(const struct project *project, const struct pou *pou)
{
	struct grid_names *names = g_new0(struct grid_names, 1);

	names->project = project;
	names->pou = pou;
	names->by_name = g_hash_table_new(hash_any_case, equal_any_case);
	names->by_address = g_hash_table_new(hash_any_case, equal_any_case);
	add_table(names, &project->globals);
	if (pou)
		add_table(names, &pou->vars);
	return names;
}

void grid_names_free(struct grid_names *names)
{
	if (!names)
		return;
	g_hash_table_unref(names->by_name);
	g_hash_table_unref(names->by_address);
	g_free(names);
}

struct grid_name grid_names_find(const struct grid_names *names, const char *operand)
{
	const struct project *project = names->project;
	const struct var *var = g_hash_table_lookup(names->by_name, operand);
	struct grid_name found = { operand, "", "", "", false };

	if (!var && *operand == '%') {
		var = g_hash_table_lookup(names->by_address, operand);
		found.symbol = var ? project_text(project, var->name) : "";
		found.address = operand;
	} else if (var) {
		found.address = project_text(project, var->at_text);
	}
	if (var) {
		const struct var_table *own = names->pou ? &names->pou->vars : NULL;

		found.type = var->type != IEC_NONE ? iec_type_row(var->type)->word :
			     words_row(&project->words, var->fb)->word;
		found.comment = project_text(project, var->comment);
		found.local = own && own->count && var >= own->var &&
			      var < own->var + own->count;
	}
	return found;
}
