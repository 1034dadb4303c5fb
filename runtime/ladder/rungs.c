/* SPDX-License-Identifier: MIT
 *
 * rungs - finds rungs by name and draws them with the power of the last scan.
 */
#include "ladder/rungs.h"
#include "ladder/pins.h"

#include "engine/base/name.h"
#include "engine/model/fbd.h"
#include "engine/trial/value.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 1-based number of the rung or network with this label or number in @pou; 0: none. */
static int find_rung(const struct project *project, const struct pou *pou,
		     const char *name)
{
	char *end;
	long number = strtol(name, &end, 10);

	if (!*end && end != name)
		return number >= 1 && number <= (pou->fbd ? pou->fbd->count : pou->rung_count) ?
		       (int)number : 0;
	for (int i = 0; pou->fbd && i < pou->fbd->count; i++)
		if (pou->fbd->network[i].label &&
		    !strcmp(project_text(project, pou->fbd->network[i].label), name))
			return i + 1;
	for (int i = 0; i < pou->rung_count; i++)
		if (pou->rung[i]->label &&
		    !strcmp(project_text(project, pou->rung[i]->label), name))
			return i + 1;
	return 0;
}

static int show_named(const struct project *project, const char *name,
		      const struct show_options *options,
		      const struct sink *out)
{
	const char *colon = strchr(name, ':');
	size_t len = colon ? (size_t)(colon - name) : strlen(name);
	int only = project_find_pou(project, name, len), shown = 0;

	if (colon && only < 0)
		return 0;
	if (!colon && only >= 0)
		return show_rungs(project, only, 0, options, out);
	for (int i = 0; i < project->pou_count; i++) {
		int rung = 0;

		if (only < 0 || i == only)
			rung = find_rung(project, &project->pou[i],
					 colon ? colon + 1 : name);
		if (rung)
			shown += show_rungs(project, i, rung, options, out);
	}
	return shown;
}

/* ---- power ---- */

struct powered {
	const struct project *project;
	const struct resource *resource;
	const struct ladder *ladder; /* NULL: without results of networks     */
	const char *instance; /* NULL: the one that was called last           */
};

static bool power_of(void *context, int pou, int rung, int row, int col, bool *in,
		     bool *out)
{
	const struct powered *powered = context;

	if (powered->instance)
		return resource_power_in(powered->resource, powered->instance,
					 strlen(powered->instance), (uint32_t)rung,
					 (uint32_t)row, (uint32_t)col, in, out);
	return resource_power(powered->resource, (uint32_t)pou, (uint32_t)rung,
			      (uint32_t)row, (uint32_t)col, in, out);
}

static bool pin_of(void *context, int pou, int network, const struct fbd_graph *graph, int pin, char *text,
		   size_t size, bool *on)
{
	const struct powered *powered = context;
	const struct pins pins = {
		.project = powered->project, .resource = powered->resource, .pou = pou, .instance = powered->instance,
		.il = powered->ladder ? ladder_il(powered->ladder, pou) : NULL,
	};

	return pins_value(&pins, network, graph, pin, text, size, on);
}

/* Finds `Main.Fill.X`, or `Fill.X` if the project has only one program. */
static bool value_of(const struct powered *powered, int pou, int step, char member,
		     struct location *at)
{
	const struct project *project = powered->project;
	const char *name = project_text(project, project->pou[pou].sfc->step[step].name);
	char text[2 * LIMIT_NAME + 8];

	snprintf(text, sizeof(text), "%s.%s.%c", project_text(project,
		 project->pou[pou].name), name, member);
	*at = image_find(&powered->resource->image, text, strlen(text));
	if (at->type != IEC_NONE)
		return true;
	snprintf(text, sizeof(text), "%s.%c", name, member);
	*at = image_find(&powered->resource->image, text, strlen(text));
	return at->type != IEC_NONE;
}

static bool step_of(void *context, int pou, int step, char *time, size_t size)
{
	const struct powered *powered = context;
	const struct image *image = &powered->resource->image;
	struct location at;

	if (!value_of(powered, pou, step, 'X', &at) || !image_get(image, at).i)
		return false;
	if (value_of(powered, pou, step, 'T', &at))
		snprintf(time, size, "%lld ms", (long long)image_get(image, at).i /
			 VALUE_MS);
	return true;
}

/* NULL: there is no watched instance of that name. */
static const struct code_watched *find_instance(const struct program *program,
						const char *name, size_t len)
{
	for (uint32_t i = 0; i < program->watched_count; i++)
		if (name_is(program->string + program->watched[i].name, name, len))
			return &program->watched[i];
	return NULL;
}

/* Skips the name of a program before an instance: `Main.Fan` is the instance `Fan`. */
static const char *behind_program(const struct project *project, const char *name)
{
	const char *dot = strchr(name, '.');
	int pou = dot ? project_find_pou(project, name, (size_t)(dot - name)) : -1;

	return pou >= 0 && project->pou[pou].kind == POU_PROGRAM ? dot + 1 : name;
}

static int show_instance(const struct project *project, const char *full,
			 struct show_options *options, const struct sink *out)
{
	const char *name = behind_program(project, full);
	struct powered *powered = options->context;
	const struct program *program = powered->resource->image.program;
	const char *colon = strchr(name, ':');
	const struct code_watched *found = find_instance(program, name,
			colon ? (size_t)(colon - name) : strlen(name));
	int rung;

	if (!found || (int)found->pou >= project->pou_count)
		return 0;
	rung = colon ? find_rung(project, &project->pou[found->pou], colon + 1) : 0;
	if (colon && !rung)
		return 0;
	options->instance = powered->instance = program->string + found->name;
	return show_rungs(project, (int)found->pou, rung, options, out);
}

int rungs_show(const struct project *project, const char *name,
	       const struct resource *resource, const struct ladder *ladder,
	       struct show_options options, const struct sink *out)
{
	struct powered powered = { .project = project, .resource = resource, .ladder = ladder };
	int shown;

	if (resource) {
		options.power = power_of;
		options.step = step_of;
		options.pin = pin_of;
		options.context = &powered;
	}
	if (!name)
		return show_rungs(project, -1, 0, &options, out);
	shown = show_named(project, name, &options, out);
	return shown || !resource ? shown :
				    show_instance(project, name, &options, out);
}
