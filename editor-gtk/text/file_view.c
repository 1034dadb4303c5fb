/* SPDX-License-Identifier: MIT
 *
 * file_view - shows a text file beside the project.
 */
#include "editor-gtk/text/file_view.h"

#include <gtksourceview/gtksource.h>

struct _LadderFileView {
	GtkBox parent;
	LadderSideFile *file;
	GtkWidget *text, *table;
	struct file_marks *marks;
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

struct file_marks *ladder_file_view_marks(LadderFileView *view)
{
	return view->marks;
}

void ladder_file_view_go(LadderFileView *view, int line)
{
	GtkTextBuffer *buffer = ladder_side_file_buffer(view->file);
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line(buffer, &at, MAX(line - 1, 0));
	gtk_text_buffer_place_cursor(buffer, &at);
	gtk_text_view_scroll_to_mark(GTK_TEXT_VIEW(view->text),
				     gtk_text_buffer_get_insert(buffer), 0.1, FALSE, 0, 0);
	gtk_widget_grab_focus(view->text);
}

static void ladder_file_view_dispose(GObject *object)
{
	LadderFileView *view = LADDER_FILE_VIEW(object);

	g_clear_pointer(&view->marks, file_marks_free);
	g_clear_object(&view->file);
	G_OBJECT_CLASS(ladder_file_view_parent_class)->dispose(object);
}

static void ladder_file_view_class_init(LadderFileViewClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_file_view_dispose;
}

static void ladder_file_view_init(LadderFileView *view)
{
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

static GtkWidget *told_label(void)
{
	GtkWidget *told = gtk_label_new("");

	gtk_label_set_xalign(GTK_LABEL(told), 0);
	gtk_label_set_wrap(GTK_LABEL(told), TRUE);
	gtk_widget_set_margin_start(told, 14);
	gtk_widget_add_css_class(told, "error");
	return told;
}

GtkWidget *ladder_file_view_new(LadderSideFile *file,
				GtkWidget *(*table)(LadderSideFile *file, GtkWidget *text))
{
	LadderFileView *view = g_object_new(LADDER_TYPE_FILE_VIEW, NULL);
	GtkWidget *scroller = gtk_scrolled_window_new(), *told = told_label();

	view->file = g_object_ref(file);
	view->text = text_widget(file);
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), view->text);
	view->table = table ? table(file, scroller) : NULL;
	gtk_box_append(GTK_BOX(view), view->table ? view->table : scroller);
	gtk_box_append(GTK_BOX(view), told);
	view->marks = file_marks_new(ladder_side_file_buffer(file), GTK_LABEL(told));
	return GTK_WIDGET(view);
}
