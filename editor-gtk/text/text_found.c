/* SPDX-License-Identifier: MIT
 *
 * text_found - marks the hits of a search in a text; see text_found.h.
 */
#include "editor-gtk/text/text_found.h"

#include "editor-gtk/kit/theme.h"

struct text_found {
	GtkTextBuffer *buffer;
	GtkTextTag *other, *now;
	bool marked;             /* something has a tag                          */
};

/* Ink on them, whatever colour the syntax has: it was chosen for the sheet. */
static void restyle(struct text_found *found)
{
	const GdkRGBA *color = theme_screen()->color;

	g_object_set(found->other, "background-rgba", &color[TOKEN_FOUND], "foreground-rgba",
		     &color[TOKEN_INK], NULL);
	g_object_set(found->now, "background-rgba", &color[TOKEN_FOUND_NOW], "foreground-rgba",
		     &color[TOKEN_INK], NULL);
}

struct text_found *text_found_new(GtkTextBuffer *buffer)
{
	struct text_found *found = g_new0(struct text_found, 1);

	found->buffer = buffer;
	found->other = gtk_text_buffer_create_tag(buffer, "found", NULL);
	found->now = gtk_text_buffer_create_tag(buffer, "found-now", "weight", PANGO_WEIGHT_BOLD, NULL);
	restyle(found);
	theme_call(found, G_CALLBACK(restyle));
	return found;
}

void text_found_free(struct text_found *found)
{
	if (!found)
		return;
	theme_leave(found);
	g_free(found);
}

/* Tags of the syntax are made later than these two. */
static void put_above(struct text_found *found)
{
	const int last = gtk_text_tag_table_get_size(gtk_text_buffer_get_tag_table(found->buffer)) - 1;

	gtk_text_tag_set_priority(found->other, last);
	gtk_text_tag_set_priority(found->now, last);
}

static void clear(struct text_found *found)
{
	GtkTextIter start, end;

	if (!found->marked)
		return;
	gtk_text_buffer_get_bounds(found->buffer, &start, &end);
	gtk_text_buffer_remove_tag(found->buffer, found->other, &start, &end);
	gtk_text_buffer_remove_tag(found->buffer, found->now, &start, &end);
	found->marked = false;
}

static char *text_of(GtkTextBuffer *buffer, GtkTextIter *start)
{
	GtkTextIter end;

	gtk_text_buffer_get_bounds(buffer, start, &end);
	return gtk_text_buffer_get_text(buffer, start, &end, TRUE);
}

void text_found_show(struct text_found *found, const struct find *find, int line, int column, bool all)
{
	gsize end = 0, before = 0;
	GtkTextIter start, to;
	gssize at;
	char *text;

	clear(found);
	if (!find)
		return;
	put_above(found);
	text = text_of(found->buffer, &start);
	while ((at = find_match(find, text, &end)) >= 0) {
		bool now;

		gtk_text_iter_forward_chars(&start, (int)g_utf8_strlen(text + before, at - (gssize)before));
		to = start;
		gtk_text_iter_forward_chars(&to, (int)g_utf8_strlen(text + at, (gssize)end - at));
		now = gtk_text_iter_get_line(&start) == line && gtk_text_iter_get_line_index(&start) == column;
		if (now || all)
			gtk_text_buffer_apply_tag(found->buffer, now ? found->now : found->other, &start, &to);
		found->marked = found->marked || now || all;
		start = to;
		before = end;
	}
	g_free(text);
}
