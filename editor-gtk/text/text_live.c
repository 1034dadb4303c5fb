/* SPDX-License-Identifier: MIT
 *
 * text_live - see text_live.h. Names are looked up anew each time: a person points at one
 * line after the other, seldom.
 */
#include "editor-gtk/text/text_live.h"

#include "editor-gtk/sim/live_map.h"

#include <string.h>

static bool was_before(GArray *parts, guint index)
{
	const char *name = g_array_index(parts, struct live_part, index).text;

	for (guint i = 0; i < index; i++) {
		const struct live_part *part = &g_array_index(parts, struct live_part, i);

		if (part->at.type != IEC_NONE && g_ascii_strcasecmp(part->text, name) == 0)
			return true;
	}
	return false;
}

static char *values_of(GArray *parts, const struct image *image)
{
	GString *text = g_string_new(NULL);
	char value[48];

	for (guint i = 0; i < parts->len; i++) {
		const struct live_part *part = &g_array_index(parts, struct live_part, i);

		if (part->at.type == IEC_NONE || was_before(parts, i))
			continue;
		live_value_print(part->at.type, image_get(image, part->at), value,
				 sizeof(value));
		g_string_append_printf(text, "%s%s = %s", text->len ? " · " : "",
				       part->text, value);
	}
	return g_string_free(text, FALSE);
}

char *text_live_line(LadderSim *sim, const char *pou, const char *line)
{
	const struct twin *twin = sim ? ladder_sim_twin(sim) : NULL;
	const char *comment = strstr(line, "(*");
	struct live_map *map;
	GArray *parts;
	char *code, *text;

	if (!twin)
		return NULL;
	code = g_strndup(line, comment ? (gsize)(comment - line) : strlen(line));
	map = live_map_new(&twin->resource, pou, NULL);
	parts = live_parts(map, code);
	text = parts ? values_of(parts, &twin->resource.image) : NULL;
	if (parts)
		g_array_unref(parts);
	live_map_free(map);
	g_free(code);
	return text;
}
