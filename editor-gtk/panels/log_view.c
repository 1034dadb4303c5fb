/* SPDX-License-Identifier: MIT
 *
 * log_view - the log of a document; see log_view.h.
 */
#include "editor-gtk/panels/log_view.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"

#include <string.h>

#define LINES_MOST 1000

static const struct { const char *word, *label, *tip; } kinds[LOG_KINDS] = {
	[LOG_SYSTEM] = { N_("system"), N_("System"),
			 N_("What the editor, the simulation and the board did") },
	[LOG_COMPILE] = { N_("compile"), N_("Compile"), N_("Errors and warnings of the program") },
	[LOG_OPERATOR] = { N_("operator"), N_("Operator"),
			   N_("What a person did, here or at the board") },
	[LOG_COMMUNICATION] = { N_("communication"), N_("Communication"),
				N_("Connections, and what was refused") },
};

struct line {
	enum log_kind kind;
	char *text;           /* time, kind and message                        */
};

struct log {
	LadderDocument *document;
	GtkTextView *text;
	GQueue lines;         /* of struct line: all, also those that are hidden */
	GtkToggleButton *shown[LOG_KINDS];
	int errors, warnings; /* numbers in the last line; -1: no line yet     */
	bool saved;
	char *undo;           /* undo step in the last line                    */
};

static void line_free(gpointer pointer)
{
	struct line *line = pointer;

	g_free(line->text);
	g_free(line);
}

static void log_free(gpointer pointer)
{
	struct log *log = pointer;

	g_signal_handlers_disconnect_by_data(log->document, log);
	g_object_unref(log->document);
	g_queue_clear_full(&log->lines, line_free);
	g_free(log->undo);
	g_free(log);
}

/* Width of the columns in front, with the letters that the text has now. */
static int width_of(GtkWidget *text, const char *words)
{
	PangoLayout *layout = gtk_widget_create_pango_layout(text, words);
	int width;

	pango_layout_get_pixel_size(layout, &width, NULL);
	g_object_unref(layout);
	return width;
}

/* In pixels, because widths of letters differ. A long line goes on below its message. */
static void set_columns(GtkWidget *text)
{
	int time = width_of(text, "00:00:00"), kind = 0;
	const int gap = width_of(text, "00");
	PangoTabArray *tabs;

	for (int i = 0; i < LOG_KINDS; i++)
		kind = MAX(kind, width_of(text, _(kinds[i].word)));
	time += gap;
	kind += time + gap;
	tabs = pango_tab_array_new_with_positions(2, TRUE, PANGO_TAB_LEFT, time, PANGO_TAB_LEFT,
						  kind);
	gtk_text_view_set_tabs(GTK_TEXT_VIEW(text), tabs);
	gtk_text_view_set_indent(GTK_TEXT_VIEW(text), -kind);
	pango_tab_array_free(tabs);
}

/* ---- what is shown ---- */

static bool is_shown(const struct log *log, const struct line *line)
{
	return gtk_toggle_button_get_active(log->shown[line->kind]);
}

static void append(struct log *log, const struct line *line)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(log->text);
	GtkTextIter end;

	gtk_text_buffer_get_end_iter(buffer, &end);
	if (gtk_text_buffer_get_char_count(buffer))
		gtk_text_buffer_insert(buffer, &end, "\n", 1);
	gtk_text_buffer_insert(buffer, &end, line->text, -1);
}

static void to_end(struct log *log)
{
	GtkTextIter last;

	gtk_text_buffer_get_end_iter(gtk_text_view_get_buffer(log->text), &last);
	gtk_text_iter_set_line_offset(&last, 0);
	gtk_text_view_scroll_to_iter(log->text, &last, 0, FALSE, 0, 1);
}

static void show_all(struct log *log)
{
	gtk_text_buffer_set_text(gtk_text_view_get_buffer(log->text), "", 0);
	for (GList *at = log->lines.head; at; at = at->next)
		if (is_shown(log, at->data))
			append(log, at->data);
	to_end(log);
}

/* The oldest line goes, and from the text, too, if it is shown. */
static void drop_first(struct log *log)
{
	struct line *line = g_queue_pop_head(&log->lines);
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(log->text);
	GtkTextIter first, second;

	if (is_shown(log, line)) {
		gtk_text_buffer_get_start_iter(buffer, &first);
		gtk_text_buffer_get_iter_at_line(buffer, &second, 1);
		gtk_text_buffer_delete(buffer, &first, &second);
	}
	line_free(line);
}

/* ---- messages ---- */

/* "14:03:11", with the date in front if that is not today. Caller frees. */
static char *time_text(gint64 us)
{
	GDateTime *now = g_date_time_new_now_local(), *then;
	GDateTime *utc = us ? g_date_time_new_from_unix_utc(us / G_USEC_PER_SEC) : NULL;
	char *text;

	then = utc ? g_date_time_to_local(utc) : g_date_time_ref(now);
	text = g_date_time_format(then, g_date_time_get_year(then) == g_date_time_get_year(now) &&
		g_date_time_get_day_of_year(then) == g_date_time_get_day_of_year(now) ?
		"%H:%M:%S" : "%Y-%m-%d %H:%M:%S");
	g_clear_pointer(&utc, g_date_time_unref);
	g_date_time_unref(then);
	g_date_time_unref(now);
	return text;
}

static void put(struct log *log, enum log_kind kind, gint64 us, const char *what)
{
	struct line *line = g_new0(struct line, 1);
	char *time = time_text(us);

	line->kind = kind;
	line->text = g_strdup_printf("%s\t%s\t%s", time, _(kinds[kind].word), what);
	g_strdelimit(line->text, "\n\r", ' ');
	g_free(time);
	g_queue_push_tail(&log->lines, line);
	if (is_shown(log, line)) {
		append(log, line);
		to_end(log);
	}
	if (log->lines.length > LINES_MOST)
		drop_first(log);
}

static void checked(LadderDocument *document, struct log *log)
{
	const struct diag_list *diags = ladder_document_diags(document);
	const int warnings = diags->count + diags->dropped - diags->errors;
	char *errors, *warned, *text;

	if (diags->errors == log->errors && warnings == log->warnings)
		return;
	log->errors = diags->errors;
	log->warnings = warnings;
	errors = g_strdup_printf(ngettext("%d error", "%d errors", (unsigned long)log->errors), log->errors);
	warned = g_strdup_printf(ngettext("%d warning", "%d warnings", (unsigned long)warnings), warnings);
	text = g_strdup_printf("%s, %s", errors, warned);
	put(log, LOG_COMPILE, 0, text);
	g_free(errors);
	g_free(warned);
	g_free(text);
}

static void state_changed(LadderDocument *document, struct log *log)
{
	const bool saved = ladder_document_is_saved(document);
	const char *undo = ladder_document_undo_name(document);
	const char *path = ladder_document_path(document);

	if (saved && !log->saved && path)
		put(log, LOG_SYSTEM, 0, path);
	else if (undo && g_strcmp0(undo, log->undo) != 0)
		put(log, LOG_OPERATOR, 0, undo);
	log->saved = saved;
	g_free(log->undo);
	log->undo = g_strdup(undo);
}

static GtkWidget *make_filter(struct log *log)
{
	GtkWidget *filter = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);

	gtk_widget_add_css_class(filter, "log-filter");
	for (int i = 0; i < LOG_KINDS; i++) {
		GtkWidget *button = gtk_toggle_button_new_with_label(_(kinds[i].label));

		log->shown[i] = GTK_TOGGLE_BUTTON(button);
		gtk_widget_add_css_class(button, "flat");
		gtk_toggle_button_set_active(log->shown[i], TRUE);
		tip_set(button, _(kinds[i].tip));
		g_signal_connect_swapped(button, "toggled", G_CALLBACK(show_all), log);
		gtk_box_append(GTK_BOX(filter), button);
	}
	return filter;
}

GtkWidget *ladder_log_view_new(LadderDocument *document)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	GtkWidget *scroller = gtk_scrolled_window_new(), *text = gtk_text_view_new();
	struct log *log = g_new0(struct log, 1);
	const char *path = ladder_document_path(document);

	log->document = g_object_ref(document);
	log->text = GTK_TEXT_VIEW(text);
	log->errors = log->warnings = -1;
	log->saved = true;
	g_queue_init(&log->lines);
	gtk_text_view_set_editable(log->text, FALSE);
	gtk_text_view_set_monospace(log->text, TRUE);
	gtk_text_view_set_wrap_mode(log->text, GTK_WRAP_WORD_CHAR);
	g_signal_connect(text, "map", G_CALLBACK(set_columns), NULL);
	gtk_text_view_set_left_margin(log->text, 14);
	spoken_name(text, _("Log"));
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), text);
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_box_append(GTK_BOX(box), make_filter(log));
	gtk_box_append(GTK_BOX(box), scroller);
	g_object_set_data_full(G_OBJECT(box), "log", log, log_free);
	g_signal_connect(document, "checked", G_CALLBACK(checked), log);
	g_signal_connect(document, "state-changed", G_CALLBACK(state_changed), log);
	put(log, LOG_SYSTEM, 0, path ? path : _("new project"));
	return box;
}

void ladder_log_view_put(GtkWidget *view, enum log_kind kind, gint64 us, const char *what)
{
	put(g_object_get_data(G_OBJECT(view), "log"), kind, us, what);
}
