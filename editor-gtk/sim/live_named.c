/* SPDX-License-Identifier: MIT
 *
 * live_named - names of values of enumerations: see live_named.h.
 */
#include "editor-gtk/sim/live_named.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_value.h"

#include "engine/base/name.h"
#include "engine/model/named.h"

#include <string.h>

#define TOLD 6 /* values in a message */

static struct project *project_of(LadderSim *sim, bool plant)
{
	struct ladder *ladder = !sim ? NULL : plant ? ladder_sim_plant_ladder(sim) :
						      ladder_sim_ladder(sim);

	return ladder ? ladder_project(ladder) : NULL;
}

struct live_named live_named_find(LadderSim *sim, bool plant, const char *pou, const char *name)
{
	struct project *project = project_of(sim, plant);
	const struct var *var = NULL;
	char *local;

	if (!project || project->enumeration_count == 0)
		return (struct live_named){ NULL, false, 0 };
	if (*pou) {
		local = g_strdup_printf("%s.%s", pou, name);
		var = named_of_path(project, local, strlen(local));
		g_free(local);
	}
	if (!var)
		var = named_of_path(project, name, strlen(name));
	return (struct live_named){ sim, plant, var ? (uint32_t)var->enumeration : 0 };
}

/* The values of the enumeration, and in *@count how many. */
static const struct enum_value *values_of(struct live_named named, const struct project **project,
					  int *count)
{
	const struct enumeration *list;

	*count = 0;
	*project = named.enumeration ? project_of(named.sim, named.plant) : NULL;
	if (!*project || named.enumeration > (uint32_t)(*project)->enumeration_count)
		return NULL;
	list = &(*project)->enumeration[named.enumeration - 1];
	*count = list->count;
	return &(*project)->enum_value[list->first];
}

const char *live_named_word(struct live_named named, union iec_value value)
{
	const struct project *project;
	int count;
	const struct enum_value *own = values_of(named, &project, &count);

	for (int i = 0; i < count; i++)
		if (own[i].number == value.i)
			return project_text(project, own[i].name);
	return NULL;
}

const char *live_named_type(struct live_named named, enum iec_type type)
{
	const struct project *project;
	int count;
	const char *name = values_of(named, &project, &count) ?
		project_text(project, project->enumeration[named.enumeration - 1].name) : "";

	return *name ? name : iec_type_row(type)->word;
}

void live_named_print(struct live_named named, enum iec_type type, union iec_value value,
		      char *out, size_t size)
{
	const char *word = live_named_word(named, value);

	if (!word) {
		live_value_print(type, value, out, size);
		return;
	}
	g_strlcpy(out, word, size);
	while (!g_utf8_validate(out, -1, NULL)) /* cut within a character */
		out[strlen(out) - 1] = '\0';
}

char *live_named_literal(struct live_named named, enum iec_type type, union iec_value value)
{
	const char *word = live_named_word(named, value);

	return word ? g_strdup(word) : live_value_literal(type, value);
}

/* Is `Phase#` or `Phase.` at the head of @text the type of the enumeration? Its length; 0: no. */
static gsize type_length(struct live_named named, const struct project *project, const char *text)
{
	const gsize head = strcspn(text, "#.");
	const char *type = project_text(project, project->enumeration[named.enumeration - 1].name);

	return text[head] && name_is(type, text, head) ? head + 1 : 0;
}

bool live_named_parse(struct live_named named, const char *text, union iec_value *out)
{
	const struct project *project;
	int count;
	const struct enum_value *own = values_of(named, &project, &count);
	char *plain = g_strstrip(g_strdup(text));
	const char *name = own ? plain + type_length(named, project, plain) : plain;
	bool found = false;

	for (int i = 0; !found && i < count; i++) {
		found = name_is(project_text(project, own[i].name), name, strlen(name));
		if (found)
			out->i = own[i].number;
	}
	g_free(plain);
	return found;
}

char *live_named_wrong(struct live_named named)
{
	const struct project *project;
	int count;
	const struct enum_value *own = values_of(named, &project, &count);
	GString *values = g_string_new(NULL);
	char *what, *text = NULL;

	for (int i = 0; i < count && i <= TOLD; i++)
		g_string_append_printf(values, "%s%s", i ? ", " : "",
				       i == TOLD ? "…" : project_text(project, own[i].name));
	if (own) {
		what = g_strdup_printf(_("Not a value of type %s"), live_named_type(named, IEC_INT));
		text = g_strdup_printf(_("%s: %s"), what, values->str);
		g_free(what);
	}
	g_string_free(values, TRUE);
	return text;
}
