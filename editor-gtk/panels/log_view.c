/* SPDX-License-Identifier: MIT
 *
 * log_view - the log of a document; see log_view.h.
 */
#include "editor-gtk/panels/log_view.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/log_text.h"

#include <string.h>

struct log {
	LadderDocument *document;
	GtkTextView *text;
	int errors, warnings; /* numbers in the last line; -1: no line yet     */
	bool saved;
	char *undo;           /* undo step in the last line                    */
};

static void log_free(gpointer pointer)
{
	struct log *log = pointer;

	g_signal_handlers_disconnect_by_data(log->document, log);
	g_object_unref(log->document);
	g_free(log->undo);
	g_free(log);
}

/* In pixels, because widths of letters differ. */
static void set_tabs(GtkTextView *text)
{
	PangoTabArray *tabs = pango_tab_array_new_with_positions(2, TRUE,
		PANGO_TAB_LEFT, 84, PANGO_TAB_LEFT, 206);

	gtk_text_view_set_tabs(text, tabs);
	pango_tab_array_free(tabs);
}

static void put(struct log *log, const char *kind, const char *what)
{
	char *text = g_strdup_printf("%s\t%s", kind, what);
	GtkTextIter last;

	log_text_put(log->text, "\t", text);
	gtk_text_buffer_get_end_iter(gtk_text_view_get_buffer(log->text), &last);
	gtk_text_iter_set_line_offset(&last, 0);
	gtk_text_view_scroll_to_iter(log->text, &last, 0, FALSE, 0, 1);
	g_free(text);
}

static void checked(LadderDocument *document, struct log *log)
{
	const struct diag_list *diags = ladder_document_diags(document);
	const int warnings = diags->count + diags->dropped - diags->errors;
	char *text;

	if (diags->errors == log->errors && warnings == log->warnings)
		return;
	log->errors = diags->errors;
	log->warnings = warnings;
	text = g_strdup_printf(_("%d errors, %d warnings"), log->errors, log->warnings);
	put(log, _("compile"), text);
	g_free(text);
}

static void state_changed(LadderDocument *document, struct log *log)
{
	const bool saved = ladder_document_is_saved(document);
	const char *undo = ladder_document_undo_name(document);
	const char *path = ladder_document_path(document);

	if (saved && !log->saved && path)
		put(log, _("system"), path);
	else if (undo && g_strcmp0(undo, log->undo) != 0)
		put(log, _("operator"), undo);
	log->saved = saved;
	g_free(log->undo);
	log->undo = g_strdup(undo);
}

GtkWidget *ladder_log_view_new(LadderDocument *document)
{
	GtkWidget *scroller = gtk_scrolled_window_new(), *text = gtk_text_view_new();
	struct log *log = g_new0(struct log, 1);
	const char *path = ladder_document_path(document);

	*log = (struct log){ g_object_ref(document), GTK_TEXT_VIEW(text), -1, -1, true, NULL };
	gtk_text_view_set_editable(log->text, FALSE);
	gtk_text_view_set_monospace(log->text, TRUE);
	set_tabs(log->text);
	gtk_text_view_set_left_margin(log->text, 14);
	spoken_name(text, _("Log"));
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), text);
	g_object_set_data_full(G_OBJECT(scroller), "log", log, log_free);
	g_signal_connect(document, "checked", G_CALLBACK(checked), log);
	g_signal_connect(document, "state-changed", G_CALLBACK(state_changed), log);
	put(log, _("system"), path ? path : _("new project"));
	return scroller;
}

void ladder_log_view_put(GtkWidget *view, const char *kind, const char *what)
{
	put(g_object_get_data(G_OBJECT(view), "log"), kind, what);
}
