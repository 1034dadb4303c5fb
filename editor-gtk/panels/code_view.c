/* SPDX-License-Identifier: MIT
 *
 * code_view - the instruction list of the sheet in front; see code_view.h.
 */
#include "editor-gtk/panels/code_view.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/text_scheme.h"
#include "editor-gtk/text/line_values.h"
#include "editor-gtk/text/text_complete.h"

#include "engine/text/pou_print.h"

#include <string.h>

struct code_view {
	LadderDocument *document;
	GtkTextBuffer *buffer;
	GtkWidget *text;
	LadderLineValues *values;
	int pou;
	bool stale;         /* the list changed since it was shown             */
};

static void code_view_free(gpointer pointer)
{
	struct code_view *code = pointer;

	g_signal_handlers_disconnect_by_data(code->document, code);
	g_object_unref(code->document);
	g_free(code);
}

static void show_now(struct code_view *code)
{
	LadderDocument *document = code->document;
	struct ladder *ladder = ladder_document_checked(document);
	const struct project *project = ladder ? ladder_project(ladder) : NULL;
	const struct il *il = project && code->pou < project->pou_count ?
		ladder_il(ladder, code->pou) : NULL;
	struct sink_memory memory;
	struct var *const *temps;
	int count;

	code->stale = false;
	line_values_set_pou(code->values, il ? project_text(project, project->pou[code->pou].name) :
			    "");
	if (!il) {
		gtk_text_buffer_set_text(code->buffer,
			_("Fix the errors of the program to see its instruction list."),
			-1);
		return;
	}
	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	temps = ladder_temporaries(ladder, code->pou, &count);
	pou_print_il(project, &project->pou[code->pou], &project->pou[code->pou].vars,
		      temps, count, il, &sink);
	gtk_text_buffer_set_text(code->buffer, sink_memory_text(&memory), -1);
	sink_memory_free(&memory);
}

static void show(struct code_view *code)
{
	code->stale = true;
	if (gtk_widget_get_mapped(code->text))
		show_now(code);
}

static void seen(struct code_view *code)
{
	if (code->stale)
		show_now(code);
}

GtkWidget *ladder_code_view_new(LadderDocument *document, LadderSim *sim)
{
	GtkSourceBuffer *buffer = gtk_source_buffer_new(NULL);
	GtkWidget *scroller = gtk_scrolled_window_new();
	LadderLineValues *values = line_values_new(buffer);
	GtkWidget *text = GTK_WIDGET(values);
	struct code_view *code = g_new0(struct code_view, 1);

	code->document = g_object_ref(document);
	code->text = text;
	code->stale = true;
	code->buffer = GTK_TEXT_BUFFER(buffer);
	code->values = values;
	line_values_set_sim(values, sim);
	gtk_source_buffer_set_language(buffer, text_language());
	text_scheme_follow(buffer);
	g_object_unref(buffer);
	gtk_text_view_set_editable(GTK_TEXT_VIEW(text), FALSE);
	gtk_text_view_set_left_margin(GTK_TEXT_VIEW(text), 14);
	spoken_name(text, _("Instruction list"));
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), text);
	g_object_set_data_full(G_OBJECT(scroller), "code", code, code_view_free);
	g_signal_connect_swapped(document, "checked", G_CALLBACK(show), code);
	g_signal_connect_data(text, "map", G_CALLBACK(seen), code, NULL,
			      G_CONNECT_SWAPPED | G_CONNECT_AFTER);
	return scroller;
}

void ladder_code_view_set_pou(GtkWidget *view, int pou)
{
	struct code_view *code = g_object_get_data(G_OBJECT(view), "code");

	if (code->pou == pou)
		return;
	code->pou = pou;
	show(code);
}
