/* SPDX-License-Identifier: MIT
 *
 * located - VAR_CONFIG; see located.h.
 *
 * A line is P1.Speed AT %QW0 : INT := 5; with the names of the configuration and its resource before
 * it or not. The file keeps the declaration of the program: at_text and init_text stay as they are.
 */
#include "engine/model/located.h"

#include "engine/base/ascii.h"
#include "engine/base/name.h"
#include "engine/base/sink.h"

#include <stdio.h>
#include <string.h>

/* The first name of a path, and what stands behind its point. */
static size_t step(const char *path, const char **rest)
{
	const char *point = strchr(path, '.');

	*rest = point ? point + 1 : NULL;
	return point ? (size_t)(point - path) : strlen(path);
}

static bool is_called(const struct project *project, uint32_t id, const char *text, size_t len)
{
	return id && name_is(project_text(project, id), text, len);
}

/* The instance of this name among the entries @from to before @to, or the program. */
static bool find_program(const struct project *project, int from, int to, const char *text, size_t len,
			 struct located *out)
{
	const struct config *config = project->config;
	const char *name;

	*out = (struct located){ .pou = project_find_pou(project, text, len) };
	for (int i = from; i < to && !out->instance; i++) {
		const struct config_entry *entry = &config->entry[i];

		if (entry->kind == CONFIG_PROGRAM &&
		    is_called(project, from && entry->own_name ? entry->own_name : entry->name, text, len))
			out->instance = entry;
	}
	if (out->instance) {
		name = project_text(project, out->instance->pou);
		out->pou = project_find_pou(project, name, strlen(name));
	}
	return out->pou >= 0 && project->pou[out->pou].kind == POU_PROGRAM;
}

int located_resource(const struct project *project, const char *text, size_t len, int *end)
{
	const struct config *config = project->config;
	int from = 0;

	*end = config ? config->count : 0;
	if (!config)
		return -1;
	while (from < config->count && !(config->entry[from].kind == CONFIG_RESOURCE &&
					 is_called(project, config->entry[from].name, text, len)))
		from++;
	if (from == config->count) {
		if (!is_called(project, config->resource, text, len))
			return -1;
		for (from = 0; from < config->count && config->entry[from].kind != CONFIG_RESOURCE;)
			from++;
		*end = from;
		return 0;
	}
	for (*end = from + 1; *end < config->count && config->entry[*end].inside &&
			      config->entry[*end].kind != CONFIG_RESOURCE;)
		++*end;
	return from;
}

bool located_find(struct project *project, const char *path, struct located *out)
{
	const struct config *config = project->config;
	const char *rest = NULL;
	size_t len = step(path, &rest);
	int from, end;

	if (rest && config && is_called(project, config->name, path, len)) {
		path = rest;
		len = step(path, &rest);
	}
	from = located_resource(project, path, len, &end);
	if (rest && from >= 0) {
		path = rest;
		len = step(path, &rest);
	} else {
		from = 0;
		end = config ? config->count : 0;
	}
	if (!rest || !find_program(project, from, end, path, len, out))
		return false;
	len = strcspn(rest, ".[");
	out->text = rest;
	out->part = rest[len];
	out->var = vars_find(&project->pou[out->pou].vars, names_fold(&project->names,
			     names_intern(&project->names, rest, len)));
	return out->var >= 0;
}

bool located_report(struct project *project, const struct var *line, enum diag_id id, const char *has,
		    const char *wants, struct diag_list *diags)
{
	const struct diag place = { .id = id, .file = project->config->file, .line = line->line };

	return diag_add(diags, place, "%.40s%s%s%s%s", project_text(project, line->name),
			*has ? DIAG_AND : "", has, *wants ? DIAG_AND : "", wants);
}

/* May @var have the address of @line? An open one, as %I*, says only the area and perhaps the width. */
static bool may_lie(const struct project *project, const struct var *var, const struct var *line)
{
	const char *open = project_text(project, var->at_text);
	const char *at = project_text(project, line->at_text);
	const size_t len = strlen(open);

	if (line->at.area == AREA_NONE || !len)
		return true;
	return open[len - 1] == '*' && strlen(at) > len - 1 &&
	       ascii_same(open, at, len - 1);
}

static bool compare(struct project *project, const struct var *var, const struct var *line,
		    struct diag_list *diags)
{
	char has[41], wants[41]; /* both fit into one message */

	project_print_type(project, var, has, sizeof(has));
	project_print_type(project, line, wants, sizeof(wants));
	if (strcmp(has, wants) != 0)
		return located_report(project, line, DIAG_LOCATED_TYPE, has, wants, diags);
	if (!may_lie(project, var, line))
		return located_report(project, line, DIAG_LOCATED_AT, project_text(project, var->at_text),
			      project_text(project, line->at_text), diags);
	return true;
}

bool located_is_whole(const struct var *line)
{
	return line->has_init && !line->inherits && !line->at_text && !line->target && !line->written &&
	       (line->type == IEC_NONE || line->type == IEC_STRING || line->array.count);
}

/* Its address is a whole one, and its value a plain constant. */
static bool is_plain(const struct var *line)
{
	if (line->at_text && line->at.area == AREA_NONE)
		return false;
	return !line->has_init || line->inherits ||
	       (line->type != IEC_NONE && line->type != IEC_STRING && !line->array.count &&
		!line->written && !line->target);
}

static void place(struct var *var, const struct var *line)
{
	if (line->at.area != AREA_NONE)
		var->at = line->at;
	if (!line->has_init || line->inherits || located_is_whole(line))
		return;
	var->inherits |= !var->has_init;
	var->has_init = true;
	var->init = line->init;
}

bool located_place(struct project *project, struct diag_list *diags)
{
	bool good = true;

	if (!project->located.count)
		return true;
	project->unlocated = arena_alloc(&project->arena, (size_t)project->located.count *
							  sizeof(*project->unlocated));
	if (!project->unlocated)
		return false;
	for (int i = 0; i < project->located.count; i++) {
		const struct var *line = &project->located.var[i];
		struct located to;
		struct var *var;

		if (!located_find(project, project_text(project, line->name), &to) ||
		    (!is_plain(line) && (to.part || !located_is_whole(line))) ||
		    (to.part && !line->at_text && (!line->has_init || line->inherits))) {
			good = located_report(project, line, DIAG_NO_LOCATED, "", "", diags) && good;
			continue;
		}
		if (to.part)
			continue;
		var = &project->pou[to.pou].vars.var[to.var];
		project->unlocated[i] = *var;
		if (!compare(project, var, line, diags))
			good = false;
		else if (!to.instance || !project_is_further(project, to.instance))
			place(var, line);
	}
	return good;
}

/* Does line @i mean a variable of the program that @pou is an instance of? */
static bool means(struct project *project, int i, const struct pou *pou, struct located *to)
{
	return located_find(project, project_text(project, project->located.var[i].name), to) && !to->part &&
	       project->pou[to->pou].line == pou->line && project->pou[to->pou].file == pou->file;
}

bool located_further(struct project *project, struct pou *pou)
{
	const size_t size = (size_t)pou->vars.count * sizeof(*pou->vars.var);
	struct var *copy = project->located.count ? arena_alloc(&project->arena, size) : NULL;
	struct located to;

	if (!project->located.count)
		return true;
	if (!copy)
		return false;
	memcpy(copy, pou->vars.var, size);
	pou->vars.var = copy;
	for (int i = project->located.count - 1; i >= 0; i--)
		if (means(project, i, pou, &to))
			copy[to.var] = project->unlocated[i];
	for (int i = 0; i < project->located.count; i++)
		if (means(project, i, pou, &to) && to.instance && to.instance->name == pou->name)
			place(&copy[to.var], &project->located.var[i]);
	return true;
}
