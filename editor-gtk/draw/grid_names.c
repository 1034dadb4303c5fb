/* SPDX-License-Identifier: MIT
 *
 * grid_names - the index of names; see grid_names.h.
 */
#include "editor-gtk/draw/grid_names.h"

#include <glib.h>
#include <string.h>

/* Tables are indexed by the id that all spellings of a name share. They hold numbers, not
 * pointers, because a table of variables may move when it grows. */
struct grid_names {
	const struct project *project;
	const struct pou *pou;       /* or NULL                                 */
	int *by_name, *by_address;   /* 1 + the number of a variable; 0: none   */
	uint32_t count;              /* of ids                                  */
};

/* Globals come first, then locals. */
static const struct var *var_of(const struct grid_names *names, int number)
{
	const struct var_table *globals = &names->project->globals;

	return number < globals->count ? &globals->var[number] :
	       &names->pou->vars.var[number - globals->count];
}

/* Added last, locals hide globals. At one address the first variable gives the name. */
static void add_table(struct grid_names *names, const struct var_table *table, int before)
{
	const struct names *ids = &names->project->names;

	for (int i = 0; i < table->count; i++) {
		const struct var *var = &table->var[i];
		const uint32_t address = names_fold(ids, var->at_text);

		names->by_name[var->fold] = before + i + 1;
		if (!var->array.count && !names->by_address[address])
			names->by_address[address] = before + i + 1;
	}
}

struct grid_names *grid_names_new(const struct project *project, const struct pou *pou)
{
	struct grid_names *names = g_new0(struct grid_names, 1);

	names->project = project;
	names->pou = pou;
	names->count = (uint32_t)MAX(project->names.count, 1);
	names->by_name = g_new0(int, names->count);
	names->by_address = g_new0(int, names->count);
	add_table(names, &project->globals, 0);
	if (pou)
		add_table(names, &pou->vars, project->globals.count);
	return names;
}

void grid_names_free(struct grid_names *names)
{
	if (!names)
		return;
	g_free(names->by_name);
	g_free(names->by_address);
	g_free(names);
}

/* Id 0 is the empty name; ids from names->count on are newer than the index. */
static const struct var *look_up(const struct grid_names *names, const int *table, uint32_t id)
{
	return id > 0 && id < names->count && table[id] ? var_of(names, table[id] - 1) : NULL;
}

struct grid_name grid_names_find(const struct grid_names *names, const char *operand)
{
	const struct project *project = names->project;
	const uint32_t id = names_find_any(&project->names, operand, strlen(operand));
	const struct var *var = look_up(names, names->by_name, id);
	struct grid_name found = { operand, "", "", "", "", false };

	if (!var && *operand == '%') {
		var = look_up(names, names->by_address, id);
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
		found.init = var->type == IEC_NONE && var->has_init && !var->array.count ?
			     project_text(project, var->init_text) : "";
		found.local = own && own->count && var >= own->var &&
			      var < own->var + own->count;
	}
	return found;
}
