/* SPDX-License-Identifier: MIT
 *
 * watch - status charts as lines of the VIEW part, and back.
 */
#include "editor-gtk/live/watch.h"

#include "editor-gtk/kit/i18n.h"

#include <string.h>

#define HEAD "status-chart"
#define LINE "watch"

struct watch_line *watch_line_new(enum watch_format format, const char *name,
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

/* What stands behind the first word of a line, if it is @word; NULL: it is not. */
static const char *behind(const char *line, const char *word)
{
	const gsize len = strlen(word);

	line += strspn(line, " \t");
	if (strncmp(line, word, len) != 0 || !strchr(" \t", line[len]))
		return NULL;
	line += len;
	return line + strspn(line, " \t");
}

/* "hex %QW0 lamps": NULL if it is none. */
static struct watch_line *line_of(const char *rest)
{
	const gsize word = strcspn(rest, " \t"), gap = strspn(rest + word, " \t");
	const enum watch_format format = watch_format_find(rest, word);
	const char *name = rest + word + gap;
	const gsize len = strcspn(name, " \t");
	char *text, *comment;
	struct watch_line *line;

	if (format == WATCH_FORMATS || len == 0)
		return NULL;
	text = g_strndup(name, len);
	comment = g_strstrip(g_strdup(name + len));
	line = watch_line_new(format, text, comment);
	g_free(text);
	g_free(comment);
	return line;
}

/* Is the line one of ours? It is put into @charts. */
static bool take(GPtrArray *charts, const char *text)
{
	const char *rest = behind(text, HEAD);
	struct watch *chart;
	struct watch_line *line;

	if (rest) {
		chart = watch_new(rest);
		g_strchomp(chart->name);
		g_ptr_array_add(charts, chart);
		return true;
	}
	rest = behind(text, LINE);
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

/* What a line can hold. */
static char *one_line(const char *text)
{
	char *plain = g_strdup(text);

	for (char *at = plain; *at; at++)
		if ((guchar)*at < ' ' || *at == 127)
			*at = ' ';
	return g_strstrip(plain);
}

/* A name with blanks in it would end at the first. */
static char *one_word(const char *text)
{
	GString *word = g_string_new(NULL);

	for (; *text; text++)
		if ((guchar)*text > ' ' && *text != 127)
			g_string_append_c(word, *text);
	return g_string_free(word, FALSE);
}

static void write_line(GString *out, const struct watch_line *line)
{
	char *name = one_word(line->name), *comment = one_line(line->comment);

	if (*name)
		g_string_append_printf(out, "    " LINE " %s %s%s%s\n",
				       watch_format_word(line->format), name,
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

static bool is_end(const char *line)
{
	line += strspn(line, " \t");
	return g_ascii_strncasecmp(line, "END_VIEW", 8) == 0;
}

char *watch_list_write(const char *view, GPtrArray *charts)
{
	char **lines = g_strsplit(*view ? view : "VIEW\nEND_VIEW", "\n", -1);
	GPtrArray *old = g_ptr_array_new_with_free_func(chart_free);
	GString *out = g_string_new(NULL);
	bool written = false;

	for (char **line = lines; *line; line++) {
		const bool ours = take(old, *line);

		if (!written && (ours || is_end(*line))) {
			write_charts(out, charts);
			written = true;
		}
		if (!ours)
			g_string_append_printf(out, "%s\n", *line);
	}
	g_string_truncate(out, out->len - 1);
	g_ptr_array_unref(old);
	g_strfreev(lines);
	return g_string_free(out, FALSE);
}

/* ---- of a document ---- */

GPtrArray *watch_list_of(LadderDocument *document)
{
	return watch_list_read(ladder_document_view(document));
}

bool watch_list_keep(LadderDocument *document, GPtrArray *charts, const char *name)
{
	char *view;

	if (!ladder_document_project(document))
		return false;
	view = watch_list_write(ladder_document_view(document), charts);
	ladder_document_begin(document, name, NULL);
	ladder_document_set_view(document, view);
	ladder_document_end(document);
	g_free(view);
	return true;
}
