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

/* The instruction of a line: of rung `rung`, 0-based, the number `number`, from 0. */
struct spot {
	int rung, number;   /* rung -1: no instruction                          */
};

struct code_view {
	LadderDocument *document;
	LadderSim *sim;     /* borrowed                                         */
	GArray *spots;      /* of struct spot, by line of the text               */
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
	g_array_unref(code->spots);
	g_free(code);
}

/* ---- results ---- */

static bool is_arg(const struct il *il, int i)
{
	return i < il->count && (il->line[i].kind == IL_ARG_IN || il->line[i].kind == IL_ARG_OUT ||
				 il->line[i].kind == IL_TARGET);
}

/* The next one that has a line of the text. */
static int behind(const struct il *il, int i)
{
	do
		i++;
	while (is_arg(il, i));
	return i;
}

static bool is_instruction(const struct il_line *line)
{
	return line->kind != IL_COMMENT && line->rung > 0;
}

/* How many instructions stand before those of @rung, 0-based. */
static uint32_t count_before(const struct il *il, int rung)
{
	uint32_t count = 0;

	for (int i = 0; i < il->count && (int)il->line[i].rung <= rung; i = behind(il, i))
		count += is_instruction(&il->line[i]);
	return count;
}

/* One for each line of the text: declarations, the list, END_PROGRAM. */
static void find_spots(struct code_view *code, const struct pou *pou, const struct il *il,
		       const char *text)
{
	struct spot spot = { .rung = -1 };
	int lines = 0, rung = -1, number = 0, at;

	g_array_set_size(code->spots, 0);
	if (pou->language != LANGUAGE_LD)
		return;
	for (int i = 0; i < il->count; i = behind(il, i))
		lines++;
	for (const char *end = text; (end = strchr(end, '\n')); end++)
		g_array_append_val(code->spots, spot);
	at = (int)code->spots->len - 1 - lines; /* of the first line of the list */
	for (int i = 0; at >= 0 && i < il->count; i = behind(il, i), at++) {
		if (!is_instruction(&il->line[i]))
			continue;
		number = rung == (int)il->line[i].rung - 1 ? number + 1 : 0;
		rung = (int)il->line[i].rung - 1;
		spot = (struct spot){ rung, number };
		g_array_index(code->spots, struct spot, at) = spot;
	}
}

/* Called by the text for each line that is on the screen, once a program. The program that runs
 * may have other rungs before this one. */
static bool find_result(void *context, const struct live_map *map, int line,
			struct live_result *out)
{
	struct code_view *code = context;
	struct ladder *running = ladder_sim_ladder(code->sim);
	const int pou = ladder_sim_pou(code->sim, code->document, code->pou);
	const struct spot *spot = line < (int)code->spots->len ?
		&g_array_index(code->spots, struct spot, line) : NULL;
	const struct il *il = running && pou >= 0 ? ladder_il(running, pou) : NULL;
	const int rung = il && spot && spot->rung >= 0 ?
		ladder_sim_rung(code->sim, code->document, code->pou, spot->rung) : -1;

	return rung >= 0 && live_map_result(map, count_before(il, rung) +
					    (uint32_t)spot->number + 1, out);
}

/* ---- the text ---- */

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
	g_array_set_size(code->spots, 0);
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
	find_spots(code, &project->pou[code->pou], il, sink_memory_text(&memory));
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
	code->sim = sim;
	code->spots = g_array_new(FALSE, FALSE, sizeof(struct spot));
	line_values_set_sim(values, sim);
	line_values_set_result(values, find_result, code);
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
