/* SPDX-License-Identifier: MIT
 *
 * sfc_bodies - the bodies below a chart; see sfc_bodies.h.
 */
#include "editor-gtk/draw/sfc_bodies.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/show/sfc_words.h"

#include <glib.h>

char *sfc_bodies_ways(const struct project *project, const struct sfc *sfc, int transition)
{
	struct sink_memory memory;
	struct sink sink;
	char *text;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	sfc_words_ways(project, sfc, transition, &sink);
	text = g_strdup(sink_memory_text(&memory));
	sink_memory_free(&memory);
	return text;
}

/* Body number @i of the chart: transitions come first, then actions. */
static char *heading_of(const struct project *project, const struct sfc *sfc, int i)
{
	const char *name;
	char *ways, *heading;

	if (i >= sfc->transition_count)
		return g_strdup_printf(_("Action %s"), project_text(project,
				       sfc->action[i - sfc->transition_count].name));
	name = project_text(project, sfc->transition[i].name);
	ways = sfc_bodies_ways(project, sfc, i);
	heading = *name ? g_strdup_printf(_("Condition %s: %s"), name, ways) :
			  g_strdup_printf(_("Condition: %s"), ways);
	g_free(ways);
	return heading;
}

struct sfc_part_body *sfc_bodies_new(const struct project *project, const struct pou *pou,
				     int *count)
{
	const struct sfc *sfc = pou->sfc;
	struct sfc_part_body *bodies = g_new0(struct sfc_part_body, sfc_bodies(sfc) + 1);

	*count = 0;
	for (int i = 0; i < sfc_bodies(sfc); i++) {
		const struct sfc_body *body = sfc_body(sfc, i);

		if (i >= sfc->transition_count || body->kind == BODY_RUNGS ||
		    body->kind == BODY_LIST)
			bodies[(*count)++] = (struct sfc_part_body){
				body, heading_of(project, sfc, i) };
	}
	return bodies;
}

void sfc_bodies_free(struct sfc_part_body *bodies, int count)
{
	for (int i = 0; i < count; i++)
		g_free(bodies[i].heading);
	g_free(bodies);
}

char *sfc_body_heading(const struct project *project, const struct pou *pou, int first,
		       int *count)
{
	const struct sfc *sfc = pou->sfc;

	*count = 0;
	for (int i = 0; sfc && i < sfc_bodies(sfc); i++) {
		const struct sfc_body *body = sfc_body(sfc, i);

		if (!sfc_body_has_rungs(body) || body->count == 0 || body->first != first)
			continue;
		*count = body->count;
		return heading_of(project, sfc, i);
	}
	return NULL;
}

char **sfc_body_lines(const struct project *project, const struct pou *pou,
		      const struct sfc_body *body)
{
	struct sink_memory memory;
	struct sink sink;
	char **lines, *text;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	sfc_words_list(project, pou, body, &sink);
	text = g_strchomp(g_strdup(sink_memory_text(&memory)));
	lines = g_strsplit(text, "\n", -1);
	g_free(text);
	sink_memory_free(&memory);
	return lines;
}
