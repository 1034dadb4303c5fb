/* SPDX-License-Identifier: MIT
 *
 * tip - tooltips with lines of a good width; see tip.h.
 */
#include "editor-gtk/kit/gtk48/tip.h"

#include "editor-gtk/kit/gtk48/popover.h"

#include <pango/pango.h>
#include <string.h>

#define COLUMNS 60          /* columns of a line                               */
#define TIP     "tip"       /* of a widget                                     */
#define UNSEEN  0x2060      /* WORD JOINER: a character without width          */

static int columns_of(gunichar c)
{
	return g_unichar_iszerowidth(c) ? 0 : g_unichar_iswide(c) ? 2 : 1;
}

/* Where a line that begins at @at ends: at a line break, or at the last place where it may be
 * broken before it is full. A longer word is cut. */
static int line_end(const gunichar *text, const PangoLogAttr *attrs, int at, int count)
{
	int width = 0, last = at;

	for (int i = at; i < count; i++) {
		if (text[i] == '\n')
			return i;
		if (i > at && attrs[i].is_line_break)
			last = i;
		width += columns_of(text[i]);
		if (width > COLUMNS && !attrs[i].is_white)
			return last > at ? last : MAX(i, at + 1);
	}
	return count;
}

static char *broken(const char *text)
{
	glong count;
	gunichar *wide = g_utf8_to_ucs4_fast(text, -1, &count);
	PangoLogAttr *attrs = g_new0(PangoLogAttr, (gsize)count + 1);
	GString *lines = g_string_new(NULL);

	pango_get_log_attrs(text, -1, -1, pango_language_get_default(), attrs,
			    (int)count + 1);
	for (int at = 0; at < count;) {
		const int end = line_end(wide, attrs, at, (int)count);

		for (int i = at; i < end; i++)
			g_string_append_unichar(lines, wide[i]);
		while (end < count && lines->len && lines->str[lines->len - 1] == ' ')
			g_string_truncate(lines, lines->len - 1);
		if (end < count)
			g_string_append_c(lines, '\n');
		at = end < count && wide[end] == '\n' ? end + 1 : end;
	}
	g_free(attrs);
	g_free(wide);
	return g_string_free(lines, FALSE);
}

char *tip_text(const char *text)
{
	char *lines = broken(text);
	GString *tip;
	int unseen = 0;

	if (strchr(lines, '\n'))
		return lines;
	for (const char *at = lines; *at; at = g_utf8_next_char(at))
		unseen += columns_of(g_utf8_get_char(at)) - 1;
	tip = g_string_new(lines);
	g_free(lines);
	while (unseen-- > 0)
		g_string_append_unichar(tip, UNSEEN);
	return g_string_free(tip, FALSE);
}

gboolean tip_show(GtkTooltip *tooltip, const char *text)
{
	char *tip = text && *text && !popover_is_above(NULL) ? tip_text(text) : NULL;

	gtk_tooltip_set_text(tooltip, tip);
	g_free(tip);
	return tip != NULL;
}

static gboolean query_tooltip(GtkWidget *widget, int x, int y, gboolean by_keys,
			      GtkTooltip *tooltip)
{
	const char *markup = gtk_widget_get_tooltip_markup(widget);
	const char *text = g_object_get_data(G_OBJECT(widget), TIP);

	(void)x;
	(void)y;
	(void)by_keys;
	if (popover_is_above(widget))
		return FALSE;
	if (text || (text = gtk_widget_get_tooltip_text(widget)) != NULL) {
		char *tip = tip_text(text);

		gtk_tooltip_set_text(tooltip, tip);
		g_free(tip);
		return TRUE;
	}
	gtk_tooltip_set_markup(tooltip, markup);
	return markup != NULL;
}

void tip_set(GtkWidget *widget, const char *text)
{
	if (text && !*text)
		text = NULL;
	if (g_strcmp0(g_object_get_data(G_OBJECT(widget), TIP), text) == 0)
		return;
	g_object_set_data_full(G_OBJECT(widget), TIP, g_strdup(text), g_free);
	if (!text)
		text = gtk_widget_get_tooltip_text(widget);
	gtk_widget_set_has_tooltip(widget, text != NULL);
	gtk_accessible_update_property(GTK_ACCESSIBLE(widget),
				       GTK_ACCESSIBLE_PROPERTY_DESCRIPTION,
				       text ? text : "", -1);
	if (gtk_widget_get_state_flags(widget) & GTK_STATE_FLAG_PRELIGHT)
		gtk_widget_trigger_tooltip_query(widget);
}

void tip_init(void)
{
	GtkWidgetClass *class = g_type_class_ref(GTK_TYPE_WIDGET);

	class->query_tooltip = query_tooltip; /* inherited by all subclasses */
	g_type_class_unref(class);
}
