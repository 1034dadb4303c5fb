/* SPDX-License-Identifier: MIT
 *
 * file_view - shows a text file beside the project.
 */
#include "editor-gtk/text/file_view.h"

#include "editor-gtk/kit/gtk48/text_scroll.h"

#include <gtksourceview/gtksource.h>

/* An error in a line. The mark follows the line. */
struct flaw {
	GtkTextMark *at;
	char *text;
};

struct _LadderFileView {
	GtkBox parent;
	LadderSideFile *file;
	GtkTextBuffer *buffer;  /* the file's                                  */
	GtkWidget *text, *table;
	GtkLabel *told;         /* the error in the line of the cursor         */
	GtkTextTag *wrong;
	GArray *flaws;          /* of struct flaw                              */
};

G_DEFINE_FINAL_TYPE(LadderFileView, ladder_file_view, GTK_TYPE_BOX)

LadderSideFile *ladder_file_view_file(LadderFileView *view)
{
	return view->file;
}

GtkWidget *ladder_file_view_table(LadderFileView *view)
{
	return view->table;
}

void ladder_file_view_go(LadderFileView *view, int line)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line(view->buffer, &at, MAX(line - 1, 0));
	gtk_text_buffer_place_cursor(view->buffer, &at);
	text_scroll_to_cursor(GTK_TEXT_VIEW(view->text));
	gtk_widget_grab_focus(view->text);
}

/* ---- errors in lines ---- */

static int line_of(LadderFileView *view, GtkTextMark *mark)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_mark(view->buffer, &at, mark);
	return gtk_text_iter_get_line(&at);
}

static void show_flaws(LadderFileView *view)
{
	const int line = line_of(view, gtk_text_buffer_get_insert(view->buffer));
	GString *text = g_string_new(NULL);

	for (guint i = 0; i < view->flaws->len; i++) {
		const struct flaw *flaw = &g_array_index(view->flaws, struct flaw, i);

		if (line_of(view, flaw->at) == line)
			g_string_append_printf(text, "%s%s", text->len ? "\n" : "",
					       flaw->text);
	}
	gtk_label_set_text(view->told, text->str);
	gtk_widget_set_visible(GTK_WIDGET(view->told), text->len > 0);
	g_string_free(text, TRUE);
}

void ladder_file_view_clear_flaws(LadderFileView *view)
{
	GtkTextIter start, end;

	for (guint i = 0; i < view->flaws->len; i++)
		gtk_text_buffer_delete_mark(view->buffer,
			g_array_index(view->flaws, struct flaw, i).at);
	g_array_set_size(view->flaws, 0);
	gtk_text_buffer_get_bounds(view->buffer, &start, &end);
	gtk_text_buffer_remove_tag(view->buffer, view->wrong, &start, &end);
	show_flaws(view);
}

void ladder_file_view_add_flaw(LadderFileView *view, int line, int column, const char *text)
{
	struct flaw flaw = { .text = g_strdup(text) };
	GtkTextIter start, end;

	gtk_text_buffer_get_iter_at_line(view->buffer, &start, MAX(line - 1, 0));
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
	gtk_text_buffer_apply_tag(view->buffer, view->wrong, &start, &end);
	flaw.at = gtk_text_buffer_create_mark(view->buffer, NULL, &start, TRUE);
	g_array_append_val(view->flaws, flaw);
	show_flaws(view);
}

/* ---- life ---- */

static void ladder_file_view_dispose(GObject *object)
{
	LadderFileView *view = LADDER_FILE_VIEW(object);

	if (view->buffer)
		g_signal_handlers_disconnect_by_data(view->buffer, view);
	g_clear_object(&view->buffer);
	g_clear_object(&view->file);
	G_OBJECT_CLASS(ladder_file_view_parent_class)->dispose(object);
}

static void ladder_file_view_finalize(GObject *object)
{
	g_array_unref(LADDER_FILE_VIEW(object)->flaws);
	G_OBJECT_CLASS(ladder_file_view_parent_class)->finalize(object);
}

static void ladder_file_view_class_init(LadderFileViewClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_file_view_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_file_view_finalize;
}

static void clear_flaw(gpointer flaw)
{
	g_free(((struct flaw *)flaw)->text);
}

static void ladder_file_view_init(LadderFileView *view)
{
	view->flaws = g_array_new(FALSE, FALSE, sizeof(struct flaw));
	g_array_set_clear_func(view->flaws, clear_flaw);
	gtk_orientable_set_orientation(GTK_ORIENTABLE(view), GTK_ORIENTATION_VERTICAL);
}

static GtkWidget *text_widget(LadderSideFile *file)
{
	GtkWidget *text = gtk_source_view_new_with_buffer(
		GTK_SOURCE_BUFFER(ladder_side_file_buffer(file)));
	char *name = ladder_side_file_name(file);

	gtk_text_view_set_monospace(GTK_TEXT_VIEW(text), TRUE);
	gtk_source_view_set_show_line_numbers(GTK_SOURCE_VIEW(text), TRUE);
	gtk_accessible_update_property(GTK_ACCESSIBLE(text), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       name, -1);
	g_free(name);
	return text;
}

static void build(LadderFileView *view,
		  GtkWidget *(*table)(LadderSideFile *file, GtkWidget *text))
{
	GtkWidget *scroller = gtk_scrolled_window_new(), *told = gtk_label_new("");

	view->text = text_widget(view->file);
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), view->text);
	view->table = table ? table(view->file, scroller) : NULL;
	gtk_label_set_xalign(GTK_LABEL(told), 0);
	gtk_label_set_wrap(GTK_LABEL(told), TRUE);
	gtk_widget_set_margin_start(told, 14);
	gtk_widget_add_css_class(told, "error");
	view->told = GTK_LABEL(told);
	gtk_box_append(GTK_BOX(view), view->table ? view->table : scroller);
	gtk_box_append(GTK_BOX(view), told);
}

GtkWidget *ladder_file_view_new(LadderSideFile *file,
				GtkWidget *(*table)(LadderSideFile *file, GtkWidget *text))
{
	LadderFileView *view = g_object_new(LADDER_TYPE_FILE_VIEW, NULL);

	view->file = g_object_ref(file);
	view->buffer = g_object_ref(ladder_side_file_buffer(file));
	view->wrong = gtk_text_buffer_create_tag(view->buffer, NULL, "underline",
						 PANGO_UNDERLINE_ERROR, NULL);
	build(view, table);
	g_signal_connect_swapped(view->buffer, "notify::cursor-position",
				 G_CALLBACK(show_flaws), view);
	show_flaws(view);
	return GTK_WIDGET(view);
}
