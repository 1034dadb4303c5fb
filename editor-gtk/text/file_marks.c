/* SPDX-License-Identifier: MIT
 *
 * file_marks - what is wrong with lines of a text.
 */
#include "editor-gtk/text/file_marks.h"

struct flaw {
	GtkTextMark *at;
	char *text;
};
struct file_marks {
	GtkTextBuffer *buffer;
	GtkTextTag *tag;
	GtkLabel *told;
	GArray *flaws;      /* of struct flaw                                  */
};

static int line_of(struct file_marks *marks, GtkTextMark *mark)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_mark(marks->buffer, &at, mark);
	return gtk_text_iter_get_line(&at) + 1;
}

char *file_marks_of(struct file_marks *marks, int line)
{
	GString *text = NULL;

	for (guint i = 0; i < marks->flaws->len; i++) {
		const struct flaw *flaw = &g_array_index(marks->flaws, struct flaw, i);

		if (line_of(marks, flaw->at) != line)
			continue;
		if (!text)
			text = g_string_new(flaw->text);
		else
			g_string_append_printf(text, "\n%s", flaw->text);
	}
	return text ? g_string_free(text, FALSE) : NULL;
}

static void tell(struct file_marks *marks)
{
	char *text = file_marks_of(marks, line_of(marks,
		gtk_text_buffer_get_insert(marks->buffer)));

	gtk_label_set_text(marks->told, text ? text : "");
	gtk_widget_set_visible(GTK_WIDGET(marks->told), text != NULL);
	g_free(text);
}

void file_marks_clear(struct file_marks *marks)
{
	GtkTextIter start, end;

	for (guint i = 0; i < marks->flaws->len; i++) {
		const struct flaw *flaw = &g_array_index(marks->flaws, struct flaw, i);

		gtk_text_buffer_delete_mark(marks->buffer, flaw->at);
		g_free(flaw->text);
	}
	g_array_set_size(marks->flaws, 0);
	gtk_text_buffer_get_bounds(marks->buffer, &start, &end);
	gtk_text_buffer_remove_tag(marks->buffer, marks->tag, &start, &end);
	tell(marks);
}

void file_marks_add(struct file_marks *marks, int line, int column, const char *text)
{
	struct flaw flaw = { .text = g_strdup(text) };
	GtkTextIter start, end;

	gtk_text_buffer_get_iter_at_line(marks->buffer, &start, MAX(line - 1, 0));
	if (column > 1 && column <= gtk_text_iter_get_bytes_in_line(&start))
		gtk_text_iter_set_line_index(&start, column - 1);
	else
		while (g_unichar_isspace(gtk_text_iter_get_char(&start)) &&
		       !gtk_text_iter_ends_line(&start) &&
		       gtk_text_iter_forward_char(&start))
			;
	end = start;
	if (!gtk_text_iter_ends_line(&end))
		gtk_text_iter_forward_to_line_end(&end);
	gtk_text_buffer_apply_tag(marks->buffer, marks->tag, &start, &end);
	flaw.at = gtk_text_buffer_create_mark(marks->buffer, NULL, &start, TRUE);
	g_array_append_val(marks->flaws, flaw);
	tell(marks);
}

struct file_marks *file_marks_new(GtkTextBuffer *buffer, GtkLabel *told)
{
	struct file_marks *marks = g_new0(struct file_marks, 1);

	marks->buffer = g_object_ref(buffer);
	marks->told = told;
	marks->flaws = g_array_new(FALSE, FALSE, sizeof(struct flaw));
	marks->tag = gtk_text_buffer_create_tag(buffer, NULL, "underline",
						PANGO_UNDERLINE_ERROR, NULL);
	g_signal_connect_swapped(buffer, "notify::cursor-position", G_CALLBACK(tell), marks);
	tell(marks);
	return marks;
}

void file_marks_free(struct file_marks *marks)
{
	if (!marks)
		return;
	g_signal_handlers_disconnect_by_data(marks->buffer, marks);
	for (guint i = 0; i < marks->flaws->len; i++)
		g_free(g_array_index(marks->flaws, struct flaw, i).text);
	g_array_unref(marks->flaws);
	g_object_unref(marks->buffer);
	g_free(marks);
}
