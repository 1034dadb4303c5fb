/* SPDX-License-Identifier: MIT
 *
 * log_text - lines with the time of day, in a text view.
 */
#include "editor-gtk/kit/log_text.h"

#define LINES_MOST 1000

void log_text_put(GtkTextView *view, const char *gap, const char *text)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(view);
	GDateTime *now = g_date_time_new_now_local();
	char *time = g_date_time_format(now, "%H:%M:%S");
	char *line = g_strdup_printf("%s%s%s%s", gtk_text_buffer_get_char_count(buffer) ?
				     "\n" : "", time, gap, text);
	GtkTextIter end, second;

	gtk_text_buffer_get_end_iter(buffer, &end);
	gtk_text_buffer_insert(buffer, &end, line, -1);
	while (gtk_text_buffer_get_line_count(buffer) > LINES_MOST) {
		gtk_text_buffer_get_start_iter(buffer, &end);
		gtk_text_buffer_get_iter_at_line(buffer, &second, 1);
		gtk_text_buffer_delete(buffer, &end, &second);
	}
	g_free(line);
	g_free(time);
	g_date_time_unref(now);
}
