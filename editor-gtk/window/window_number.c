/* SPDX-License-Identifier: MIT
 *
 * window_number - asks for a rung of the sheet in front, or a line of the text, and goes there.
 */
#include "editor-gtk/window/window_inside.h"

/* Rungs by the numbers that are shown, lines of @text from 1 on; 1 to 0: there are none. */
struct numbers {
	LadderGridView *sheet;
	GtkTextBuffer *text;   /* NULL: of the sheet; neither: nothing has any */
	int first, last;
};

static struct numbers numbers_of(LadderWindow *window)
{
	struct numbers of = { tabs_seen_sheet(window), tabs_text(window), 1, 0 };
	const struct project *project;

	if (of.sheet) {
		project = ladder_document_project(ladder_grid_view_document(of.sheet));
		of.text = NULL;
		of.first = 1 + ladder_grid_view_range(of.sheet, &of.last);
		of.last = of.last < 0 ?
			project->pou[ladder_grid_view_pou(of.sheet)].rung_count :
			of.first - 1 + of.last;
	} else if (of.text) {
		of.last = gtk_text_buffer_get_line_count(of.text);
	}
	return of;
}

/* False: it is none of them. */
static bool is_number(const struct numbers *of, const char *text, int *number)
{
	guint64 read;

	if (of->first > of->last ||
	    !g_ascii_string_to_unsigned(text, 10, (guint64)of->first, (guint64)of->last, &read,
					NULL))
		return false;
	*number = (int)read;
	return true;
}

static void go_line(LadderWindow *window, GtkTextBuffer *text, int line)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line(text, &at, line - 1);
	gtk_text_buffer_place_cursor(text, &at);
	tabs_reveal_cursor(window);
}

static void go(AdwMessageDialog *dialog, const char *response, GtkEditable *number)
{
	LadderWindow *window = LADDER_WINDOW(gtk_window_get_transient_for(
		GTK_WINDOW(dialog)));
	const struct numbers of = numbers_of(window);
	int to;

	if (g_strcmp0(response, "go") != 0 ||
	    !is_number(&of, gtk_editable_get_text(number), &to))
		return;
	if (of.text)
		go_line(window, of.text, to);
	else
		ladder_grid_view_go(of.sheet, to - of.first, -1, -1);
}

/* Enter goes nowhere with a number that is none. */
static void typed(GtkEditable *number, AdwMessageDialog *dialog)
{
	const struct numbers of = numbers_of(LADDER_WINDOW(
		gtk_window_get_transient_for(GTK_WINDOW(dialog))));
	const char *text = gtk_editable_get_text(number);
	int to;
	const bool good = is_number(&of, text, &to);

	adw_message_dialog_set_response_enabled(dialog, "go", good);
	if (good || !*text)
		gtk_widget_remove_css_class(GTK_WIDGET(number), "error");
	else
		gtk_widget_add_css_class(GTK_WIDGET(number), "error");
	gtk_accessible_update_state(GTK_ACCESSIBLE(number), GTK_ACCESSIBLE_STATE_INVALID,
		good || !*text ? GTK_ACCESSIBLE_INVALID_FALSE : GTK_ACCESSIBLE_INVALID_TRUE,
		-1);
}

static GtkWidget *number_new(GtkWidget *dialog, const char *name)
{
	GtkWidget *number = gtk_entry_new();

	gtk_entry_set_input_purpose(GTK_ENTRY(number), GTK_INPUT_PURPOSE_DIGITS);
	gtk_accessible_update_property(GTK_ACCESSIBLE(number),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	gtk_entry_set_activates_default(GTK_ENTRY(number), TRUE);
	g_signal_connect_object(number, "changed", G_CALLBACK(typed), dialog, 0);
	return number;
}

void window_ask_number(LadderWindow *window)
{
	const struct numbers of = numbers_of(window);
	GtkWidget *dialog, *number;

	if (of.first > of.last) {
		ladder_window_tell(window, of.sheet ? _("no rung") :
				   _("Neither rungs nor lines stand here."));
		return;
	}
	dialog = adw_message_dialog_new(GTK_WINDOW(window),
					of.text ? _("Go to line") : _("Go to rung"), NULL);
	adw_message_dialog_format_body(ADW_MESSAGE_DIALOG(dialog), _("%d to %d"), of.first,
				       of.last);
	number = number_new(dialog, of.text ? _("Line") : _("Rung"));
	adw_message_dialog_set_extra_child(ADW_MESSAGE_DIALOG(dialog), number);
	adw_message_dialog_add_responses(ADW_MESSAGE_DIALOG(dialog), "cancel", _("Cancel"),
					 "go", _("Go"), NULL);
	adw_message_dialog_set_response_enabled(ADW_MESSAGE_DIALOG(dialog), "go", FALSE);
	adw_message_dialog_set_default_response(ADW_MESSAGE_DIALOG(dialog), "go");
	adw_message_dialog_set_close_response(ADW_MESSAGE_DIALOG(dialog), "cancel");
	g_signal_connect(dialog, "response", G_CALLBACK(go), number);
	gtk_window_present(GTK_WINDOW(dialog));
	gtk_widget_grab_focus(number);
}
