/* SPDX-License-Identifier: MIT
 *
 * line_values - a list with its values; see line_values.h.
 */
#include "editor-gtk/text/line_values.h"

#include "editor-gtk/document/text_lines.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/theme.h"

#include "engine/base/name.h"
#include "engine/ladder.h"

#include <gtk/gtk.h>
#include <stdlib.h>
#include <string.h>

/* In characters. */
#define WIDEST   72 /* a longer line does not move the values of the others      */
#define GAP      4  /* between a line and its value                              */
#define VALUE    18 /* "-0:00 / 0:00 min"                                        */
#define RESULT   16
#define TAB      8

#define SPOKEN_US 250000 /* a screen reader does not follow each scan            */

/* A line of the list: where its operand and the value that it counts are, and its result. */
struct seen {
	GArray *parts;            /* of struct live_part; NULL: no variable      */
	struct location now, goal; /* of a call: what counts in the instance      */
	bool instruction;         /* the program that runs has one here          */
	bool missing;             /* the board runs without this line            */
	struct live_result result;
	bool ran;                 /* as last looked at                           */
	int columns;              /* of the line                                 */
	char text[64], after[48]; /* of the operand; the result                  */
};

struct _LadderLineValues {
	GtkSourceView parent;
	LadderSim *sim;           /* NULL: none                                  */
	char *pou;
	const struct text_range *part; /* NULL: all lines are shown               */
	bool st;                  /* Structured Text                             */
	struct live_map *map;     /* NULL: not made yet                          */
	char *instance;           /* of a block: the one that stands; NULL: the first one */
	int *places;              /* by line of the POU: line of the file that runs, from 1; 0: none. NULL:
				   * of no line */
	int place_count;
	bool placed;              /* they were looked for                        */
	LineResult finder;        /* NULL: the list is in the file               */
	void *context;            /* of it                                       */
	bool lacks;               /* the board could be without a line           */
	GPtrArray *lines;         /* of struct seen; NULL: not looked at yet      */
	int longest;              /* columns of a line up to WIDEST; 0: not counted yet */
	char *(*note)(void *context, int line);
	void *noting;             /* context of it                               */
	int (*hidden)(void *context, int line);
	void *hiding;             /* context of it                               */
	char *spoken;             /* the description of the view                 */
	gint64 spoken_us;         /* when it was looked at                       */
	guint telling;            /* source that describes the line of the cursor; 0: none */
};

G_DEFINE_FINAL_TYPE(LadderLineValues, ladder_line_values, GTK_SOURCE_TYPE_VIEW)

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

/* "CAL Delay (…)": the time or the count of the instance. */
static void find_count(const struct live_map *map, const char *operand, struct seen *seen)
{
	static const char *const pair[][2] = { { "ET", "PT" }, { "CV", "PV" }, { "V", "P" } };
	const char *at = operand + strspn(operand, " \t");
	char *name = g_strndup(at, strcspn(at, " \t("));

	for (gsize i = 0; *name && seen->now.type == IEC_NONE && i < G_N_ELEMENTS(pair); i++) {
		seen->now = live_map_find_pin(map, name, pair[i][0]);
		seen->goal = live_map_find_pin(map, name, pair[i][1]);
	}
	g_free(name);
}

/* Columns up to the end of the line. */
static int columns_of(const char *line)
{
	int columns = 0;

	for (; *line && *line != '\n'; line = g_utf8_next_char(line)) {
		const gunichar c = g_utf8_get_char(line);

		columns += c == '\t' ? TAB - columns % TAB : g_unichar_iszerowidth(c) ? 0 :
			   g_unichar_iswide(c) ? 2 : 1;
	}
	return columns;
}

/* ---- Structured Text ---- */

/* A line without comments and texts, as the colours know them. Caller frees. */
static char *code_of_line(GtkTextBuffer *buffer, int line)
{
	GtkSourceBuffer *coloured = GTK_SOURCE_BUFFER(buffer);
	GString *code = g_string_new(NULL);
	GtkTextIter at, end;

	gtk_text_buffer_get_iter_at_line(buffer, &at, line);
	end = at;
	if (!gtk_text_iter_ends_line(&end))
		gtk_text_iter_forward_to_line_end(&end);
	gtk_source_buffer_ensure_highlight(coloured, &at, &end);
	for (; gtk_text_iter_compare(&at, &end) < 0; gtk_text_iter_forward_char(&at))
		if (gtk_source_buffer_iter_has_context_class(coloured, &at, "comment") ||
		    gtk_source_buffer_iter_has_context_class(coloured, &at, "string"))
			g_string_append_c(code, ' ');
		else
			g_string_append_unichar(code, gtk_text_iter_get_char(&at));
	return g_string_free(code, FALSE);
}

static bool in_name(char c)
{
	return g_ascii_isalnum(c) || c == '_' || (guchar)c >= 0x80;
}

/* Blanks in place of what looks like a variable and is none: `PT :=` in a call, `Phase#Idle`, TRANSITION. */
static void blank_words(char *code)
{
	int open = 0;

	for (char *at = code; *at;) {
		char *end = at;

		open += (*at == '(') - (*at == ')');
		if (!in_name(*at)) {
			at++;
			continue;
		}
		while (in_name(*end))
			end++;
		if (end - at == 10 && memcmp(at, "TRANSITION", 10) == 0)
			; /* the word of a chart, and the variable that its conditions write */
		else if (*end == '#')
			while (in_name(*end) || *end == '#' || *end == '.' || *end == ':')
				end++;
		else if (!(open > 0 && (g_str_has_prefix(end + strspn(end, " "), ":=") ||
					g_str_has_prefix(end + strspn(end, " "), "=>")))) {
			while (in_name(*end) || *end == '.')
				end++;
			at = end;
			continue;
		}
		memset(at, ' ', (gsize)(end - at));
		at = end;
	}
}

static struct seen *look_up_st(LadderLineValues *values, int line, const char *text)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(values));
	struct seen *seen = g_new0(struct seen, 1);
	char *code = code_of_line(buffer, line), *name = code + strspn(code, " \t");

	seen->columns = columns_of(text);
	seen->now.type = seen->goal.type = IEC_NONE;
	if (name[strcspn(name, " (:;")] == '(')
		find_count(values->map, name, seen);
	blank_words(code);
	if (seen->now.type == IEC_NONE)
		seen->parts = live_parts(values->map, code);
	g_free(code);
	return seen;
}

/* ---- a list ---- */

static struct seen *look_up(LadderLineValues *values, const char *line)
{
	struct seen *seen = g_new0(struct seen, 1);
	const char *word = instruction_of(line);
	char *operand = operand_of(word);

	seen->columns = columns_of(line);
	seen->now.type = seen->goal.type = IEC_NONE;
	if (g_ascii_strncasecmp(word, "CAL", 3) == 0)
		find_count(values->map, operand, seen);
	if (seen->now.type == IEC_NONE)
		seen->parts = live_parts(values->map, operand);
	g_free(operand);
	return seen;
}

/* ---- values of a line ---- */

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
		live_named_print(part->named, part->at.type, image_get(image, part->at), value,
				 sizeof(value));
		if (seen->text[0])
			g_strlcat(seen->text, " · ", sizeof(seen->text));
		g_strlcat(seen->text, value, sizeof(seen->text));
	}
	/* a cut must not end within a character */
	while (!g_utf8_validate(seen->text, -1, NULL))
		seen->text[strlen(seen->text) - 1] = '\0';
}

static void print_value(struct seen *seen, const struct image *image)
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

/* Of what was stored, if the line begins with a variable of an enumeration. */
static struct live_named stored_names(const struct seen *seen)
{
	for (guint i = 0; seen->parts && seen->result.at.type != IEC_BOOL && i < seen->parts->len; i++) {
		const struct live_part *part = &g_array_index(seen->parts, struct live_part, i);

		if (part->at.type != IEC_NONE)
			return part->named;
	}
	return (struct live_named){ NULL, false, 0 };
}

static void print_result(struct seen *seen, const struct image *image)
{
	seen->after[0] = '\0';
	if (seen->missing)
		g_strlcpy(seen->after, _("not downloaded"), sizeof(seen->after));
	if (!seen->instruction)
		return;
	seen->ran = image->memory[seen->result.ran];
	if (!seen->ran)
		g_strlcpy(seen->after, _("not run"), sizeof(seen->after));
	else if (seen->result.at.type != IEC_NONE)
		live_named_print(stored_names(seen), seen->result.at.type,
				 image_get(image, seen->result.at), seen->after,
				 sizeof(seen->after));
}

/* ---- which line of the program that runs a line is ---- */

static const struct pou *find_pou(const struct project *project, const char *name)
{
	for (int i = 0; project && i < project->pou_count; i++)
		if (name_equal(project_text(project, project->pou[i].name), name))
			return &project->pou[i];
	return NULL;
}

static const char *text_from_line(const char *text, int line)
{
	for (; text && line > 1; line--) {
		text = strchr(text, '\n');
		text = text ? text + 1 : NULL;
	}
	return text;
}

static char *text_of_buffer(LadderLineValues *values)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(values));
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	return gtk_text_buffer_get_text(buffer, &start, &end, TRUE);
}

/* With what stands around the shown part. */
static char *text_of_pou(LadderLineValues *values)
{
	char *shown = text_of_buffer(values), *text;

	if (!values->part)
		return shown;
	text = text_range_whole(values->part, shown);
	g_free(shown);
	return text;
}

static void find_places(LadderLineValues *values)
{
	struct ladder *ladder = ladder_sim_ladder(values->sim);
	const struct project *project = ladder ? ladder_project(ladder) : NULL;
	const struct pou *pou = find_pou(project, values->pou);
	const char *text = pou && (pou->language != LANGUAGE_LD || pou->boxed_count > 0) && !pou->included ?
		text_from_line(ladder_sim_text(values->sim), pou->line) : NULL;
	char *shown = text ? text_of_pou(values) : NULL;

	values->place_count = 0;
	values->places = text ? text_lines_match(shown, text, &values->place_count) : NULL;
	for (int i = 0; values->places && i < values->place_count; i++)
		values->places[i] = values->places[i] < 0 ? 0 : values->places[i] + pou->line;
	values->placed = true;
	values->lacks = ladder_sim_may_miss(values->sim) && !(pou && pou->included);
	g_free(shown);
}

static void find_result(LadderLineValues *values, int line, struct seen *seen)
{
	const int at = line + (values->part ? values->part->lines : 0);
	int place;

	if (values->finder) {
		seen->instruction = values->finder(values->context, values->map, line,
						   &seen->result);
		return;
	}
	if (!values->placed)
		find_places(values);
	place = values->places && at < values->place_count ? values->places[at] : 0;
	seen->instruction = place > 0 &&
		live_map_result(values->map, (uint32_t)place, &seen->result);
	seen->missing = !place && values->lacks && seen->columns > 0;
}

/* ---- the columns ---- */

static char *text_of_line(GtkTextBuffer *buffer, int line)
{
	GtkTextIter start, end;

	gtk_text_buffer_get_iter_at_line(buffer, &start, line);
	end = start;
	if (!gtk_text_iter_ends_line(&end))
		gtk_text_iter_forward_to_line_end(&end);
	return gtk_text_iter_get_text(&start, &end);
}

/* NULL: no values are shown. */
static struct seen *seen_of(LadderLineValues *values, int line)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(values));
	const struct twin *twin = values->sim ? ladder_sim_twin(values->sim) : NULL;
	struct seen *seen;
	char *text;

	if (!twin || !values->pou[0] || line >= gtk_text_buffer_get_line_count(buffer))
		return NULL;
	if (!values->map) {
		values->map = live_map_new(&twin->resource, values->pou, values->instance);
		live_map_set_sim(values->map, values->sim);
	}
	if (values->lines->len <= (guint)line)
		g_ptr_array_set_size(values->lines, line + 1);
	seen = values->lines->pdata[line];
	if (!seen) {
		text = text_of_line(buffer, line);
		seen = values->lines->pdata[line] = values->st ? look_up_st(values, line, text) :
				      look_up(values, text);
		find_result(values, line, seen);
		g_free(text);
	}
	print_value(seen, &twin->resource.image);
	print_result(seen, &twin->resource.image);
	return seen;
}

const char *line_values_text(LadderLineValues *values, int line)
{
	const struct seen *seen = seen_of(values, line);

	return seen && seen->text[0] ? seen->text : NULL;
}

const char *line_values_result(LadderLineValues *values, int line)
{
	const struct seen *seen = seen_of(values, line);

	return seen && seen->after[0] ? seen->after : NULL;
}

/* ---- the picture ---- */

/* Where the columns of one line are, in characters from the left edge of the view. */
struct pen {
	LadderLineValues *values;
	GtkSnapshot *snapshot;
	PangoLayout *layout;
	int cell, baseline;       /* px of a character, from its top             */
	int left, limit;          /* px of the text's edge; the last place of a column */
};

static void count_longest(LadderLineValues *values)
{
	char *text = text_of_buffer(values);

	values->longest = 1;
	for (const char *at = text; at; at = strchr(at, '\n') ? strchr(at, '\n') + 1 : NULL) {
		const int columns = columns_of(at);

		if (columns <= WIDEST)
			values->longest = MAX(values->longest, columns);
	}
	g_free(text);
}

/* Returns the width in px. @weight: PANGO_WEIGHT_NORMAL or BOLD. */
static int draw(const struct pen *pen, const char *text, int x, int y, enum token token,
		PangoWeight weight)
{
	PangoAttrList *attrs = pango_attr_list_new();
	int width, height;

	pango_attr_list_insert(attrs, pango_attr_weight_new(weight));
	pango_layout_set_attributes(pen->layout, attrs);
	pango_attr_list_unref(attrs);
	pango_layout_set_text(pen->layout, text, -1);
	pango_layout_get_pixel_size(pen->layout, &width, &height);
	y += pen->baseline - PANGO_PIXELS(pango_layout_get_baseline(pen->layout));
	gtk_snapshot_save(pen->snapshot);
	gtk_snapshot_translate(pen->snapshot, &GRAPHENE_POINT_INIT((float)x, (float)y));
	gtk_snapshot_append_layout(pen->snapshot, pen->layout,
				   &theme_screen()->color[token]);
	gtk_snapshot_restore(pen->snapshot);
	return width;
}

/* Weight, too, and not colour alone, tells TRUE from FALSE. */
static void draw_result(const struct pen *pen, const struct seen *seen, int x, int y)
{
	if (!seen->after[0])
		return;
	if (seen->missing)
		draw(pen, seen->after, x, y, TOKEN_FORCE, PANGO_WEIGHT_NORMAL);
	else if (!seen->ran)
		draw(pen, seen->after, x, y, TOKEN_COMMENT, PANGO_WEIGHT_NORMAL);
	else if (seen->result.at.type != IEC_BOOL)
		draw(pen, seen->after, x, y, TOKEN_ACCENT, PANGO_WEIGHT_NORMAL);
	else if (seen->after[0] == 'T')
		draw(pen, seen->after, x, y, TOKEN_POWER, PANGO_WEIGHT_BOLD);
	else
		draw(pen, seen->after, x, y, TOKEN_INK, PANGO_WEIGHT_NORMAL);
}

static bool find_ground(LadderLineValues *values, GdkRGBA *ground)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(values));
	GtkSourceStyleScheme *scheme =
		gtk_source_buffer_get_style_scheme(GTK_SOURCE_BUFFER(buffer));
	GtkSourceStyle *style = scheme ? gtk_source_style_scheme_get_style(scheme, "text") : NULL;
	char *name = NULL;
	bool found;

	if (style)
		g_object_get(style, "background", &name, NULL);
	found = name && gdk_rgba_parse(ground, name);
	g_free(name);
	return found;
}

/* The text below a column would be read with it. */
static void draw_ground(const struct pen *pen, int x, int y, int height)
{
	GdkRGBA ground;

	if (find_ground(pen->values, &ground))
		gtk_snapshot_append_color(pen->snapshot, &ground,
			&GRAPHENE_RECT_INIT((float)(x - pen->cell), (float)y,
				(float)((VALUE + RESULT + 1) * pen->cell), (float)height));
}

/* -1: it is hidden itself. */
static int hidden_behind(LadderLineValues *values, int line)
{
	return values->hidden ? values->hidden(values->hiding, line) : 0;
}

/* At the end of a line behind which some are hidden. Caller frees. */
static char *hidden_words(int hidden)
{
	return g_strdup_printf(ngettext("… %d line", "… %d lines", (gulong)hidden), hidden);
}

static void draw_hidden(const struct pen *pen, GtkTextIter at, int hidden, int y)
{
	char *words = hidden_words(hidden);
	GdkRectangle end;

	if (!gtk_text_iter_ends_line(&at))
		gtk_text_iter_forward_to_line_end(&at);
	gtk_text_view_get_iter_location(GTK_TEXT_VIEW(pen->values), &at, &end);
	draw(pen, words, end.x + pen->cell, y, TOKEN_COMMENT, PANGO_WEIGHT_NORMAL);
	g_free(words);
}

static int hidden_columns(int hidden)
{
	char *words = hidden ? hidden_words(hidden) : NULL;
	const int columns = words ? columns_of(words) + 1 : 0;

	g_free(words);
	return columns;
}

static void draw_line(const struct pen *pen, int line, int hidden, int y, int height)
{
	const struct seen *seen = seen_of(pen->values, line);
	const int columns = seen ? seen->columns + hidden_columns(hidden) : 0;
	const int wanted = MAX(columns, pen->values->longest) + GAP;
	int x = pen->left + wanted * pen->cell, width = 0;

	if (!seen || (!seen->text[0] && !seen->after[0]))
		return;
	if (x > pen->limit) {
		x = pen->limit;
		if (columns * pen->cell + pen->left > x)
			draw_ground(pen, x, y, height);
	}
	if (seen->text[0])
		width = draw(pen, seen->text, x, y, TOKEN_ACCENT, PANGO_WEIGHT_NORMAL);
	draw_result(pen, seen, x + MAX(VALUE * pen->cell, width + 2 * pen->cell), y);
}

/* The first line of a list has no value, as a rule: it has room for the names of the columns. */
static void draw_head(const struct pen *pen, int y)
{
	const int wanted = pen->values->longest + GAP;
	const int x = MIN(pen->left + wanted * pen->cell, pen->limit);

	draw(pen, _("Value"), x, y, TOKEN_COMMENT, PANGO_WEIGHT_NORMAL);
	if (pen->values->places || pen->values->finder)
		draw(pen, _("Result"), x + VALUE * pen->cell, y, TOKEN_COMMENT,
		     PANGO_WEIGHT_NORMAL);
}

static void draw_lines(const struct pen *pen, const GdkRectangle *seen, bool on)
{
	GtkTextView *view = GTK_TEXT_VIEW(pen->values);
	const int count = gtk_text_buffer_get_line_count(gtk_text_view_get_buffer(view));
	GtkTextIter at;
	int y, height, hidden;

	gtk_text_view_get_line_at_y(view, &at, seen->y, &y);
	for (int line = gtk_text_iter_get_line(&at); line < count; line += 1 + MAX(hidden, 0)) {
		hidden = hidden_behind(pen->values, line);
		gtk_text_iter_set_line(&at, line);
		gtk_text_view_get_line_yrange(view, &at, &y, &height);
		if (y > seen->y + seen->height)
			break;
		if (hidden < 0)
			continue;
		if (on)
			draw_line(pen, line, hidden, y, height);
		if (hidden > 0)
			draw_hidden(pen, at, hidden, y);
		if (on && line == 0 && !line_values_text(pen->values, 0) &&
		    !line_values_result(pen->values, 0))
			draw_head(pen, y);
	}
}

static int cell_width(LadderLineValues *values)
{
	PangoContext *context = gtk_widget_get_pango_context(GTK_WIDGET(values));
	PangoFontMetrics *metrics = pango_context_get_metrics(context, NULL, NULL);
	const int width = pango_font_metrics_get_approximate_digit_width(metrics);

	pango_font_metrics_unref(metrics);
	return MAX(PANGO_PIXELS_CEIL(width), 1);
}

static bool is_on(LadderLineValues *values)
{
	return values->sim && ladder_sim_is_on(values->sim) && values->pou[0];
}

static void ladder_line_values_snapshot_layer(GtkTextView *view, GtkTextViewLayer layer,
					      GtkSnapshot *snapshot)
{
	LadderLineValues *values = LADDER_LINE_VALUES(view);
	struct pen pen = { .values = values, .snapshot = snapshot };
	GdkRectangle seen;

	GTK_TEXT_VIEW_CLASS(ladder_line_values_parent_class)->snapshot_layer(view, layer,
									    snapshot);
	if (layer != GTK_TEXT_VIEW_LAYER_ABOVE_TEXT || !(is_on(values) || values->hidden))
		return;
	if (is_on(values) && !values->longest)
		count_longest(values);
	gtk_text_view_get_visible_rect(view, &seen);
	pen.cell = cell_width(values);
	pen.left = gtk_text_view_get_left_margin(view);
	pen.limit = MAX(seen.x + seen.width - (VALUE + RESULT) * pen.cell, pen.left);
	pen.layout = gtk_widget_create_pango_layout(GTK_WIDGET(view), "0");
	pen.baseline = PANGO_PIXELS(pango_layout_get_baseline(pen.layout));
	draw_lines(&pen, &seen, is_on(values));
	g_object_unref(pen.layout);
}

/* ---- what changes ---- */

static char *values_said(LadderLineValues *values, int line)
{
	const struct seen *seen = seen_of(values, line);

	return !seen || !(seen->text[0] || seen->after[0]) ? g_strdup("") :
	       seen->missing ? g_strdup(seen->after) :
	       !seen->after[0] ? g_strdup_printf(_("value %s"), seen->text) :
	       !seen->text[0] ? g_strdup_printf(_("result %s"), seen->after) :
	       g_strdup_printf(_("value %s, result %s"), seen->text, seen->after);
}

/* A screen reader reads the values of the line of the cursor. */
static void tell_line(LadderLineValues *values)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(values));
	char *text, *note, *said;
	GtkTextIter at;
	int line;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	line = gtk_text_iter_get_line(&at);
	said = values_said(values, line);
	note = values->note ? values->note(values->noting, line) : NULL;
	text = note && *said ? g_strdup_printf("%s · %s", note, said) : g_strdup(note ? note : said);
	g_free(note);
	g_free(said);
	if (g_strcmp0(text, values->spoken) == 0) {
		g_free(text);
		return;
	}
	g_free(values->spoken);
	values->spoken = text;
	gtk_accessible_update_property(GTK_ACCESSIBLE(values),
				       GTK_ACCESSIBLE_PROPERTY_DESCRIPTION, text, -1);
}

static gboolean tell_now(gpointer data)
{
	LadderLineValues *values = data;

	values->telling = 0;
	tell_line(values);
	return G_SOURCE_REMOVE;
}

/* The cursor also moves while text goes, before the colours know of it: whoever asks for colours then
 * breaks their tree. */
static void tell_soon(LadderLineValues *values)
{
	if (!values->telling)
		values->telling = g_idle_add_full(G_PRIORITY_HIGH_IDLE, tell_now, values, NULL);
}

void line_values_set_note(LadderLineValues *values, char *(*note)(void *context, int line),
			  void *context)
{
	values->note = note;
	values->noting = context;
}

void line_values_set_hidden(LadderLineValues *values, int (*hidden)(void *context, int line),
			    void *context)
{
	values->hidden = hidden;
	values->hiding = context;
}

void line_values_tell(LadderLineValues *values)
{
	tell_soon(values);
}

static void forget_lines(LadderLineValues *values)
{
	g_ptr_array_set_size(values->lines, 0);
	g_clear_pointer(&values->places, free);
	values->placed = false;
	values->longest = 0;
	gtk_widget_queue_draw(GTK_WIDGET(values));
}

static void forget(LadderLineValues *values)
{
	g_clear_pointer(&values->map, live_map_free);
	forget_lines(values);
}

/* The instance of this block in which the program stands, or which waits; NULL: in none. */
static const char *standing_instance(LadderLineValues *values)
{
	const struct stops_frame *frame;
	int count;

	frame = ladder_sim_stack(values->sim, &count);
	for (int i = 0; frame && i < count; i++)
		if (frame[i].instance[0] && name_equal(frame[i].at.pou, values->pou))
			return frame[i].instance;
	return NULL;
}

static void follow_instance(LadderLineValues *values)
{
	const char *instance = standing_instance(values);

	if (g_strcmp0(instance, values->instance) == 0)
		return;
	g_free(values->instance);
	values->instance = g_strdup(instance);
	forget(values);
}

const char *line_values_instance(LadderLineValues *values)
{
	return values->instance;
}

static void shown(LadderLineValues *values)
{
	const gint64 now = g_get_monotonic_time();

	follow_instance(values);
	if (!values->pou[0] || !gtk_widget_get_mapped(GTK_WIDGET(values)))
		return;
	gtk_widget_queue_draw(GTK_WIDGET(values));
	if (now - values->spoken_us < SPOKEN_US)
		return;
	values->spoken_us = now;
	tell_line(values);
}

/* The end of a long line can be scrolled out from below the columns. */
static void state_changed(LadderLineValues *values)
{
	const bool on = is_on(values);

	if (!on)
		forget(values);
	gtk_text_view_set_right_margin(GTK_TEXT_VIEW(values), on ?
				       (GAP + VALUE + RESULT) * cell_width(values) : 0);
	gtk_widget_queue_draw(GTK_WIDGET(values));
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

void line_values_set_part(LadderLineValues *values, const struct text_range *part)
{
	values->part = part;
	forget(values);
}

void line_values_set_st(LadderLineValues *values, bool st)
{
	if (values->st == st)
		return;
	values->st = st;
	forget(values);
}

void line_values_set_result(LadderLineValues *values, LineResult result, void *context)
{
	values->finder = result;
	values->context = context;
	forget(values);
}

void line_values_set_sim(LadderLineValues *values, LadderSim *sim)
{
	if (values->sim)
		g_signal_handlers_disconnect_by_data(values->sim, values);
	g_set_object(&values->sim, sim);
	forget(values);
	state_changed(values);
	if (!sim)
		return;
	g_signal_connect_object(sim, "shown", G_CALLBACK(shown), values, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "program-gone", G_CALLBACK(forget), values,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "state-changed", G_CALLBACK(state_changed), values,
				G_CONNECT_SWAPPED);
}

/* ---- life ---- */

static void ladder_line_values_finalize(GObject *object)
{
	LadderLineValues *values = LADDER_LINE_VALUES(object);

	g_clear_handle_id(&values->telling, g_source_remove);
	live_map_free(values->map);
	g_clear_pointer(&values->places, free);
	g_ptr_array_unref(values->lines);
	g_clear_object(&values->sim);
	g_free(values->pou);
	g_free(values->spoken);
	g_free(values->instance);
	G_OBJECT_CLASS(ladder_line_values_parent_class)->finalize(object);
}

static void ladder_line_values_class_init(LadderLineValuesClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_line_values_finalize;
	GTK_TEXT_VIEW_CLASS(class)->snapshot_layer = ladder_line_values_snapshot_layer;
}

static void ladder_line_values_init(LadderLineValues *values)
{
	values->pou = g_strdup("");
	values->lines = g_ptr_array_new_with_free_func(seen_free);
}

LadderLineValues *line_values_new(GtkSourceBuffer *buffer)
{
	LadderLineValues *values = g_object_new(LADDER_TYPE_LINE_VALUES, "buffer", buffer,
						"monospace", TRUE, NULL);

	theme_follow(values, G_CALLBACK(gtk_widget_queue_draw));
	g_signal_connect_object(buffer, "changed", G_CALLBACK(forget_lines), values,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(buffer, "notify::cursor-position", G_CALLBACK(tell_soon),
				values, G_CONNECT_SWAPPED);
	return values;
}
