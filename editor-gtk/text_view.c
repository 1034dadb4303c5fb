/* SPDX-License-Identifier: MIT
 *
 * text_view - a program in IL, or a file that cannot be read, as text.
 */
#include "editor-gtk/text_view.h"

#include "editor-gtk/i18n.h"
#include "editor-gtk/text_complete.h"

#include <adwaita.h>
#include <gtksourceview/gtksource.h>
#include <string.h>

struct _LadderTextView {
	GtkBox parent;
	LadderDocument *document;
	int pou;
	GtkSourceView *view;
	GtkSourceBuffer *buffer;
	GtkTextTag *error, *warning;
	GtkLabel *told;          /* why the line of the cursor is wrong         */
	bool ours;               /* the change that is heard is our own         */
};

G_DEFINE_FINAL_TYPE(LadderTextView, ladder_text_view, GTK_TYPE_BOX)

/* ---- the text ---- */

static char *text_of_document(LadderTextView *view)
{
	return view->pou < 0 ? ladder_document_text(view->document, NULL) :
	       ladder_document_list(view->document, view->pou);
}

static char *text_of_buffer(LadderTextView *view)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	return gtk_text_buffer_get_text(buffer, &start, &end, TRUE);
}

static void show_text(LadderTextView *view)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	char *text = text_of_document(view), *now = text_of_buffer(view);
	GtkTextIter at;
	int offset;

	if (text && strcmp(text, now) != 0) {
		gtk_text_buffer_get_iter_at_mark(buffer, &at,
						 gtk_text_buffer_get_insert(buffer));
		offset = gtk_text_iter_get_offset(&at);
		view->ours = true;
		gtk_text_buffer_set_text(buffer, text, -1);
		gtk_text_buffer_get_iter_at_offset(buffer, &at, offset);
		gtk_text_buffer_place_cursor(buffer, &at);
		view->ours = false;
	}
	g_free(text);
	g_free(now);
}

static void typed(LadderTextView *view)
{
	char *text, *before;

	if (view->ours)
		return;
	text = text_of_buffer(view);
	view->ours = true;
	ladder_document_begin(view->document, _("Type text"), "text");
	if (view->pou >= 0) {
		ladder_document_put_list(view->document, view->pou, text);
	} else {
		before = ladder_document_text(view->document, NULL);
		ladder_document_replace(view->document, 0, strlen(before), text, NULL);
		g_free(before);
	}
	ladder_document_end(view->document);
	view->ours = false;
	g_free(text);
}

static void document_changed(LadderTextView *view)
{
	if (!view->ours)
		show_text(view);
}

/* ---- errors ---- */

struct first_line {
	int pou, line;
	gsize at;
};

static void take_pou(void *context, const struct text_span *span)
{
	struct first_line *first = context;

	if (span->part == TEXT_POU && span->number == first->pou)
		first->at = span->at;
}

/* Lines of the file before the text that is shown. Lists beside the project may have
 * other lengths than what they stand for. */
static int lines_before(LadderTextView *view)
{
	struct first_line first = { .pou = view->pou };
	gsize len;
	char *text, *found, *list;

	if (view->pou < 0)
		return 0;
	text = ladder_document_text(view->document, &len);
	list = ladder_document_list(view->document, view->pou);
	found = strstr(text, list);
	if (!found) {
		g_free(text);
		text = ladder_document_outline(view->document, &len, take_pou, &first);
		found = text + first.at;
	}
	for (const char *at = text; at < found; at++)
		first.line += *at == '\n';
	g_free(list);
	g_free(text);
	return first.line;
}

static void mark(LadderTextView *view, const struct diag *diag, int line)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	GtkTextIter start, end;

	if (line < 0 || line >= gtk_text_buffer_get_line_count(buffer))
		return;
	gtk_text_buffer_get_iter_at_line(buffer, &start, line);
	end = start;
	gtk_text_iter_forward_to_line_end(&end);
	if (diag->column > 1 &&
	    diag->column - 1 < gtk_text_iter_get_bytes_in_line(&start))
		gtk_text_iter_set_line_index(&start, diag->column - 1);
	gtk_text_buffer_apply_tag(buffer, diag_severity(diag->id) == SEVERITY_ERROR ?
				  view->error : view->warning, &start, &end);
}

static int cursor_line(LadderTextView *view)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	return gtk_text_iter_get_line(&at);
}

static void show_errors(LadderTextView *view)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	const struct diag_list *diags = ladder_document_diags(view->document);
	const int before = lines_before(view), line = cursor_line(view);
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	gtk_text_buffer_remove_tag(buffer, view->error, &start, &end);
	gtk_text_buffer_remove_tag(buffer, view->warning, &start, &end);
	gtk_label_set_text(view->told, "");
	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		mark(view, diag, diag->line - 1 - before);
		if (diag->line - 1 - before == line) {
			char *text = g_strdup_printf("%s %s: %s", diag_code(diag->id),
						     _(diag_text(diag->id)), diag->arg);

			gtk_label_set_text(view->told, text);
			g_free(text);
		}
	}
}

/* ---- from outside ---- */

int ladder_text_view_pou(LadderTextView *view)
{
	return view->pou;
}

void ladder_text_view_set_pou(LadderTextView *view, int pou)
{
	view->pou = pou;
	show_text(view);
}

void ladder_text_view_go_here(LadderTextView *view, int line, int column)
{
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(view->buffer);
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line(buffer, &at, MAX(line - 1, 0));
	if (column > 1 && column - 1 < gtk_text_iter_get_bytes_in_line(&at))
		gtk_text_iter_set_line_index(&at, column - 1);
	gtk_text_buffer_place_cursor(buffer, &at);
	gtk_text_view_scroll_to_iter(GTK_TEXT_VIEW(view->view), &at, 0.1, FALSE, 0, 0);
	gtk_widget_grab_focus(GTK_WIDGET(view->view));
}

void ladder_text_view_go(LadderTextView *view, int line, int column)
{
	ladder_text_view_go_here(view, line - lines_before(view), column);
}

/* ---- life ---- */

static void follow_dark(LadderTextView *view)
{
	GtkSourceStyleSchemeManager *schemes = gtk_source_style_scheme_manager_get_default();
	const bool dark = adw_style_manager_get_dark(adw_style_manager_get_default());
	GtkSourceStyleScheme *scheme = gtk_source_style_scheme_manager_get_scheme(schemes,
		dark ? "Adwaita-dark" : "Adwaita");

	if (scheme)
		gtk_source_buffer_set_style_scheme(view->buffer, scheme);
}

static void ladder_text_view_dispose(GObject *object)
{
	LadderTextView *view = LADDER_TEXT_VIEW(object);

	if (view->document)
		g_signal_handlers_disconnect_by_data(view->document, view);
	g_clear_object(&view->document);
	G_OBJECT_CLASS(ladder_text_view_parent_class)->dispose(object);
}

static void ladder_text_view_class_init(LadderTextViewClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_text_view_dispose;
}

static void make_buffer(LadderTextView *view)
{
	GtkTextBuffer *buffer;

	view->buffer = gtk_source_buffer_new(NULL);
	buffer = GTK_TEXT_BUFFER(view->buffer);
	gtk_source_buffer_set_language(view->buffer, text_language());
	/* There is one history, the document's. */
	gtk_text_buffer_set_enable_undo(buffer, FALSE);
	view->error = gtk_text_buffer_create_tag(buffer, NULL, "underline",
						 PANGO_UNDERLINE_ERROR, NULL);
	view->warning = gtk_text_buffer_create_tag(buffer, NULL, "underline",
						   PANGO_UNDERLINE_SINGLE, NULL);
	g_signal_connect_swapped(buffer, "changed", G_CALLBACK(typed), view);
	g_signal_connect_swapped(buffer, "notify::cursor-position",
				 G_CALLBACK(show_errors), view);
}

static void ladder_text_view_init(LadderTextView *view)
{
	gtk_orientable_set_orientation(GTK_ORIENTABLE(view), GTK_ORIENTATION_VERTICAL);
}

static void build(LadderTextView *view)
{
	GtkWidget *scroller = gtk_scrolled_window_new();

	make_buffer(view);
	view->view = GTK_SOURCE_VIEW(gtk_source_view_new_with_buffer(view->buffer));
	view->told = GTK_LABEL(gtk_label_new(""));
	gtk_text_view_set_monospace(GTK_TEXT_VIEW(view->view), TRUE);
	gtk_source_view_set_show_line_numbers(view->view, TRUE);
	gtk_source_view_set_highlight_current_line(view->view, TRUE);
	gtk_source_view_set_auto_indent(view->view, TRUE);
	gtk_accessible_update_property(GTK_ACCESSIBLE(view->view),
				       GTK_ACCESSIBLE_PROPERTY_LABEL,
				       _("Text of the program"), -1);
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller),
				      GTK_WIDGET(view->view));
	gtk_label_set_xalign(view->told, 0);
	gtk_widget_set_margin_start(GTK_WIDGET(view->told), 14);
	gtk_widget_add_css_class(GTK_WIDGET(view->told), "error");
	gtk_box_append(GTK_BOX(view), scroller);
	gtk_box_append(GTK_BOX(view), GTK_WIDGET(view->told));
	text_complete_attach(view->view, view->document, view->pou);
	g_object_unref(view->buffer);
}

GtkWidget *ladder_text_view_new(LadderDocument *document, int pou)
{
	LadderTextView *view = g_object_new(LADDER_TYPE_TEXT_VIEW, NULL);

	view->document = g_object_ref(document);
	view->pou = pou;
	build(view);
	g_signal_connect_swapped(document, "project-changed", G_CALLBACK(document_changed),
				 view);
	g_signal_connect_swapped(document, "list-changed", G_CALLBACK(document_changed),
				 view);
	g_signal_connect_swapped(document, "checked", G_CALLBACK(show_errors), view);
	g_signal_connect_object(adw_style_manager_get_default(), "notify::dark",
				G_CALLBACK(follow_dark), view, G_CONNECT_SWAPPED);
	follow_dark(view);
	show_text(view);
	return GTK_WIDGET(view);
}
