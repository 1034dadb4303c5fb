/* SPDX-License-Identifier: MIT
 *
 * line_values - the column of values beside a list; see line_values.h.
 */
#include "editor-gtk/text/line_values.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_map.h"

#include "engine/base/name.h"

#include <string.h>

#define WIDE "-0:00:00 / 0:00:00 h" /* the column has room for it                */

/* A line of the list: where its operand and the value that it counts are. */
struct seen {
	GArray *parts;            /* of struct live_part; NULL: no variable      */
	struct location now, goal; /* of a call: what counts in the instance      */
	char text[64];
};

struct _LadderLineValues {
	GtkSourceGutterRendererText parent;
	LadderSim *sim;
	char *pou;
	struct live_map *map;     /* NULL: not made yet                          */
	GPtrArray *lines;         /* of struct seen; NULL: not looked at yet      */
};

G_DEFINE_FINAL_TYPE(LadderLineValues, ladder_line_values, GTK_SOURCE_TYPE_GUTTER_RENDERER_TEXT)

static void seen_free(gpointer data)
{
	struct seen *seen = data;

	if (seen && seen->parts)
		g_array_unref(seen->parts);
	g_free(seen);
}

/* ---- the variables of a line ---- */

/* Where the instruction begins, behind labels. */
static const char *instruction_of(const char *line)
{
	const char *at = line + strspn(line, " \t");
	gsize label;

	while ((label = strcspn(at, " \t(:")) && at[label] == ':')
		at += label + 1 + strspn(at + label + 1, " \t");
	return at;
}

/* Behind the instruction, without a comment. Caller frees. */
static char *operand_of(const char *instruction)
{
	const char *at = instruction + strcspn(instruction, " \t(");
	const char *comment = strstr(at, "(*");

	return g_strndup(at, comment ? (gsize)(comment - at) : strlen(at));
}

static struct location pin_of(const struct live_map *map, const char *instance,
			      const char *pin)
{
	char *name = g_strdup_printf("%s.%s", instance, pin);
	struct location at = live_map_find(map, name, strlen(name));

	g_free(name);
	return at;
}

/* "CAL Delay (…)": the time or the count of the instance. */
static void find_count(const struct live_map *map, const char *operand, struct seen *seen)
{
	static const char *const pair[][2] = { { "ET", "PT" }, { "CV", "PV" }, { "V", "P" } };
	const char *at = operand + strspn(operand, " \t");
	char *name = g_strndup(at, strcspn(at, " \t("));

	for (gsize i = 0; *name && seen->now.type == IEC_NONE && i < G_N_ELEMENTS(pair); i++) {
		seen->now = pin_of(map, name, pair[i][0]);
		seen->goal = pin_of(map, name, pair[i][1]);
	}
	g_free(name);
}

static struct seen *look_up(LadderLineValues *values, const char *line)
{
	struct seen *seen = g_new0(struct seen, 1);
	const char *word = instruction_of(line);
	char *operand = operand_of(word);

	seen->now.type = seen->goal.type = IEC_NONE;
	if (g_ascii_strncasecmp(word, "CAL", 3) == 0)
		find_count(values->map, operand, seen);
	if (seen->now.type == IEC_NONE)
		seen->parts = live_parts(values->map, operand);
	g_free(operand);
	return seen;
}

/* ---- what is shown ---- */

/* The same variable once. */
static bool was_before(GArray *parts, guint index)
{
	const char *name = g_array_index(parts, struct live_part, index).text;

	for (guint i = 0; i < index; i++)
		if (name_equal(g_array_index(parts, struct live_part, i).text, name))
			return true;
	return false;
}

static void print_parts(struct seen *seen, const struct image *image)
{
	char value[48];

	for (guint i = 0; i < seen->parts->len; i++) {
		const struct live_part *part = &g_array_index(seen->parts, struct live_part, i);

		if (part->at.type == IEC_NONE || was_before(seen->parts, i))
			continue;
		live_value_print(part->at.type, image_get(image, part->at), value,
				 sizeof(value));
		if (seen->text[0])
			g_strlcat(seen->text, " · ", sizeof(seen->text));
		g_strlcat(seen->text, value, sizeof(seen->text));
	}
	/* a cut must not end within a character */
	while (!g_utf8_validate(seen->text, -1, NULL))
		seen->text[strlen(seen->text) - 1] = '\0';
}

static void print(struct seen *seen, const struct image *image)
{
	seen->text[0] = '\0';
	if (seen->now.type != IEC_NONE && seen->goal.type == seen->now.type)
		live_count_print(seen->now.type, image_get(image, seen->now),
				 image_get(image, seen->goal), seen->text, sizeof(seen->text));
	else if (seen->now.type != IEC_NONE)
		live_value_print(seen->now.type, image_get(image, seen->now), seen->text,
				 sizeof(seen->text));
	else if (seen->parts)
		print_parts(seen, image);
}

static char *text_of_line(GtkTextBuffer *buffer, int line)
{
	GtkTextIter start, end;

	gtk_text_buffer_get_iter_at_line(buffer, &start, line);
	end = start;
	if (!gtk_text_iter_ends_line(&end))
		gtk_text_iter_forward_to_line_end(&end);
	return gtk_text_iter_get_text(&start, &end);
}

const char *line_values_text(LadderLineValues *values, int line)
{
	GtkSourceGutterRenderer *renderer = GTK_SOURCE_GUTTER_RENDERER(values);
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(gtk_source_gutter_renderer_get_buffer(renderer));
	const struct twin *twin = ladder_sim_twin(values->sim);
	struct seen *seen;
	char *text;

	if (!twin || !values->pou[0] || line >= gtk_text_buffer_get_line_count(buffer))
		return NULL;
	if (!values->map)
		values->map = live_map_new(&twin->resource, values->pou, NULL);
	if (values->lines->len <= (guint)line)
		g_ptr_array_set_size(values->lines, line + 1);
	seen = values->lines->pdata[line];
	if (!seen) {
		text = text_of_line(buffer, line);
		seen = values->lines->pdata[line] = look_up(values, text);
		g_free(text);
	}
	print(seen, &twin->resource.image);
	return seen->text[0] ? seen->text : NULL;
}

static void query_data(GtkSourceGutterRenderer *renderer, GtkSourceGutterLines *lines,
		       guint line)
{
	const char *text = line_values_text(LADDER_LINE_VALUES(renderer), (int)line);

	(void)lines;
	gtk_source_gutter_renderer_text_set_text(GTK_SOURCE_GUTTER_RENDERER_TEXT(renderer),
						 text ? text : "", -1);
}

/* ---- what changes ---- */

static void forget_lines(LadderLineValues *values)
{
	g_ptr_array_set_size(values->lines, 0);
	gtk_widget_queue_draw(GTK_WIDGET(values));
}

static void forget(LadderLineValues *values)
{
	g_clear_pointer(&values->map, live_map_free);
	forget_lines(values);
}

static void shown(LadderLineValues *values)
{
	if (gtk_widget_get_mapped(GTK_WIDGET(values)))
		gtk_widget_queue_draw(GTK_WIDGET(values));
}

static void state_changed(LadderLineValues *values)
{
	const bool on = ladder_sim_is_on(values->sim) && values->pou[0];

	if (!ladder_sim_is_on(values->sim))
		forget(values);
	gtk_widget_set_visible(GTK_WIDGET(values), on);
}

void line_values_set_pou(LadderLineValues *values, const char *pou)
{
	if (strcmp(values->pou, pou) == 0)
		return;
	g_free(values->pou);
	values->pou = g_strdup(pou);
	forget(values);
	state_changed(values);
}

/* ---- life ---- */

static void ladder_line_values_finalize(GObject *object)
{
	LadderLineValues *values = LADDER_LINE_VALUES(object);

	live_map_free(values->map);
	g_ptr_array_unref(values->lines);
	g_clear_object(&values->sim);
	g_free(values->pou);
	G_OBJECT_CLASS(ladder_line_values_parent_class)->finalize(object);
}

static void ladder_line_values_class_init(LadderLineValuesClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_line_values_finalize;
	GTK_SOURCE_GUTTER_RENDERER_CLASS(class)->query_data = query_data;
}

static void ladder_line_values_init(LadderLineValues *values)
{
	values->pou = g_strdup("");
	values->lines = g_ptr_array_new_with_free_func(seen_free);
}

static void make_room(LadderLineValues *values)
{
	int width;

	gtk_source_gutter_renderer_text_measure(GTK_SOURCE_GUTTER_RENDERER_TEXT(values), WIDE,
						&width, NULL);
	gtk_widget_set_size_request(GTK_WIDGET(values), width, -1);
}

LadderLineValues *line_values_add(GtkSourceView *view, LadderSim *sim)
{
	LadderLineValues *values = g_object_new(LADDER_TYPE_LINE_VALUES, "xalign", 1.0, "xpad", 10,
						NULL);
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(view));

	values->sim = g_object_ref(sim);
	gtk_widget_add_css_class(GTK_WIDGET(values), "live-value");
	spoken_name(values, _("Values of the lines"));
	gtk_source_gutter_insert(gtk_source_view_get_gutter(view, GTK_TEXT_WINDOW_RIGHT),
				 GTK_SOURCE_GUTTER_RENDERER(values), 0);
	make_room(values);
	g_signal_connect_object(sim, "shown", G_CALLBACK(shown), values, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "program-changed", G_CALLBACK(forget), values,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "state-changed", G_CALLBACK(state_changed), values,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(buffer, "changed", G_CALLBACK(forget_lines), values,
				G_CONNECT_SWAPPED);
	state_changed(values);
	return values;
}
