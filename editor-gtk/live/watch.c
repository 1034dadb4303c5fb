/* SPDX-License-Identifier: MIT
 *
 * watch - status charts as lines of the VIEW part, and back.
 */
#include "editor-gtk/live/watch.h"

#include <string.h>

#define HEAD "status-chart"
#define LINE "watch"

struct watch_line *watch_line_new(enum live_format format, const char *name,
				  const char *comment)
{
	struct watch_line *line = g_new0(struct watch_line, 1);

	line->format = format;
	line->name = g_strdup(name);
	line->comment = g_strdup(comment ? comment : "");
	return line;
}

void watch_line_free(struct watch_line *line)
{
	g_free(line->name);
	g_free(line->comment);
	g_free(line);
}

struct watch *watch_new(const char *name)
{
	struct watch *chart = g_new0(struct watch, 1);

	chart->name = g_strdup(name);
	chart->lines = g_ptr_array_new_with_free_func((GDestroyNotify)watch_line_free);
	return chart;
}

static void chart_free(gpointer data)
{
	struct watch *chart = data;

	g_free(chart->name);
	g_ptr_array_unref(chart->lines);
	g_free(chart);
}

/* ---- reading ---- */

/* Of the text "hex %QW0 lamps"; NULL: no format and name. */
static struct watch_line *line_of(const char *rest)
{
	const gsize word = strcspn(rest, " \t"), gap = strspn(rest + word, " \t");
	const enum live_format format = live_format_find(rest, word);
	const char *name = rest + word + gap;
	const gsize len = strcspn(name, " \t");
	char *text, *comment;
	struct watch_line *line;

	if (format == FORMAT_COUNT || len == 0)
		return NULL;
	text = g_strndup(name, len);
	comment = g_strstrip(g_strdup(name + len));
	line = watch_line_new(format, text, comment);
	g_free(text);
	g_free(comment);
	return line;
}

/* Adds the chart or line that @text is to @charts. False: it is neither. */
static bool take(void *context, const char *text)
{
	GPtrArray *charts = context;
	const char *rest = live_line_after(text, HEAD);
	struct watch *chart;
	struct watch_line *line;

	if (rest) {
		chart = watch_new(rest);
		g_strchomp(chart->name);
		g_ptr_array_add(charts, chart);
		return true;
	}
	rest = live_line_after(text, LINE);
	line = rest ? line_of(rest) : NULL;
	if (!line)
		return false;
	if (charts->len == 0)
		g_ptr_array_add(charts, watch_new(""));
	chart = charts->pdata[charts->len - 1];
	g_ptr_array_add(chart->lines, line);
	return true;
}

GPtrArray *watch_list_read(const char *view)
{
	GPtrArray *charts = g_ptr_array_new_with_free_func(chart_free);
	char **lines = g_strsplit(view, "\n", -1);

	for (char **line = lines; *line; line++)
		take(charts, *line);
	g_strfreev(lines);
	return charts;
}

/* ---- writing ---- */

/* @text without control characters, so that it fits on a line. Caller frees. */
static char *one_line(const char *text)
{
	char *plain = g_strdup(text);

	for (char *at = plain; *at; at++)
		if ((guchar)*at < ' ' || *at == 127)
			*at = ' ';
	return g_strstrip(plain);
}

static void write_line(GString *out, const struct watch_line *line)
{
	char *name = live_name(line->name), *comment = one_line(line->comment);

	if (*name)
		g_string_append_printf(out, "    " LINE " %s %s%s%s\n",
				       live_format_word(line->format), name,
				       *comment ? " " : "", comment);
	g_free(name);
	g_free(comment);
}

static void write_charts(GString *out, GPtrArray *charts)
{
	for (guint i = 0; i < charts->len; i++) {
		const struct watch *chart = charts->pdata[i];
		char *name = one_line(chart->name);

		g_string_append_printf(out, "  " HEAD "%s%s\n", *name ? " " : "", name);
		for (guint k = 0; k < chart->lines->len; k++)
			write_line(out, chart->lines->pdata[k]);
		g_free(name);
	}
}

char *watch_list_write(const char *view, GPtrArray *charts)
{
	GPtrArray *old = g_ptr_array_new_with_free_func(chart_free);
	GString *own = g_string_new(NULL);
	char *text;

	write_charts(own, charts);
	text = live_lines_replace(view, take, old, own->str);
	g_string_free(own, TRUE);
	g_ptr_array_unref(old);
	return text;
}

/* ---- of a document ---- */

GPtrArray *watch_list_of(LadderDocument *document)
{
	return watch_list_read(ladder_document_view(document));
}

bool watch_list_keep(LadderDocument *document, GPtrArray *charts, const char *name)
{
	if (!ladder_document_project(document))
		return false;
	live_lines_keep(document, watch_list_write(ladder_document_view(document), charts),
			name);
	return true;
}
