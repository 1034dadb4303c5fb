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

/* The cell whose power is the result after a line. */
struct spot {
	int rung, row, col; /* 0-based; rung -1: none                             */
	bool out;           /* the power that it lets through, not what comes to it */
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

static bool is_contact(const struct cell *cell)
{
	return cell->word == ELEM_CONTACT_NO || cell->word == ELEM_CONTACT_NC;
}

static bool is_coil(const struct cell *cell)
{
	return cell->word == ELEM_COIL || cell->word == ELEM_COIL_NOT ||
	       cell->word == ELEM_COIL_SET || cell->word == ELEM_COIL_RESET;
}

/* Does the line read the contact, or write the coil, of its own cell? NULL: no. */
static const struct cell *cell_of(const struct pou *pou, const struct il_line *line)
{
	const struct cell *cell;

	if (line->kind != IL_OP || !line->rung || !line->row || !line->col ||
	    line->modifiers & ~MOD_N || (int)line->rung > pou->rung_count)
		return NULL;
	cell = rung_at(pou->rung[line->rung - 1], line->row - 1, line->col - 1);
	if (cell->operand != line->operand)
		return NULL;
	if (line->op == OP_LD || line->op == OP_AND)
		return is_contact(cell) ? cell : NULL;
	return (line->op == OP_ST || line->op == OP_S || line->op == OP_R) && is_coil(cell) ?
	       cell : NULL;
}

static struct spot spot_at(const struct il_line *line, bool out)
{
	return (struct spot){ (int)line->rung - 1, line->row - 1, line->col - 1, out };
}

/* @next: the instruction behind it, NULL: none. Neither stands in parentheses. */
static struct spot spot_of(const struct pou *pou, const struct il_line *line,
			   const struct il_line *next)
{
	const struct cell *cell = cell_of(pou, line);

	if (cell)
		return spot_at(line, is_contact(cell));
	if (next && next->rung == line->rung && next->op != OP_LD && cell_of(pou, next))
		return spot_at(next, false); /* which takes the result */
	return (struct spot){ .rung = -1 };
}

static bool has_jumps(const struct il *il)
{
	for (int i = 0; i < il->count; i++)
		if (il->line[i].kind == IL_LABEL ||
		    (il->line[i].kind == IL_OP && (il->line[i].op == OP_JMP ||
						   il->line[i].op == OP_RET)))
			return true;
	return false;
}

static bool is_arg(const struct il *il, int i)
{
	return i < il->count && (il->line[i].kind == IL_ARG_IN || il->line[i].kind == IL_ARG_OUT ||
				 il->line[i].kind == IL_TARGET);
}

static int behind(const struct il *il, int i)
{
	do
		i++;
	while (is_arg(il, i));
	return i;
}

/* One for each line of the text: declarations, the list, END_PROGRAM. */
static void find_spots(struct code_view *code, const struct pou *pou, const struct il *il,
		       const char *text)
{
	const struct spot none = { .rung = -1 };
	int depth = 0, lines = 0, at;

	g_array_set_size(code->spots, 0);
	if (pou->language != LANGUAGE_LD || has_jumps(il))
		return;
	for (int i = 0; i < il->count; i = behind(il, i))
		lines++;
	for (const char *end = text; (end = strchr(end, '\n')); end++)
		g_array_append_val(code->spots, none);
	at = (int)code->spots->len - 1 - lines; /* of the first line of the list */
	for (int i = 0; at >= 0 && i < il->count; i = behind(il, i), at++) {
		const struct il_line *line = &il->line[i];
		const int next = behind(il, i);

		depth += (line->kind == IL_OP || line->kind == IL_FN) &&
			 line->modifiers & MOD_PAREN ? 1 : line->kind == IL_CLOSE ? -1 : 0;
		if (depth == 0)
			g_array_index(code->spots, struct spot, at) =
				spot_of(pou, line, next < il->count ? &il->line[next] : NULL);
	}
}

/* Called by the text for each line that is on the screen, once a program. */
static bool find_result(void *context, const struct live_map *map, int line, uint32_t *at)
{
	struct code_view *code = context;
	struct ladder *ladder = ladder_document_checked(code->document);
	const struct project *project = ladder ? ladder_project(ladder) : NULL;
	const struct spot *spot = line < (int)code->spots->len ?
		&g_array_index(code->spots, struct spot, line) : NULL;
	const struct pou *pou = project && code->pou < project->pou_count ?
		&project->pou[code->pou] : NULL;
	struct live_rung *live;

	if (!pou || !spot || spot->rung < 0 || spot->rung >= pou->rung_count)
		return false;
	live = live_rung_new(map, project, pou->rung[spot->rung],
			     ladder_sim_rung(code->sim, code->document, code->pou, spot->rung));
	*at = LIVE_NOWHERE;
	if (spot->row < live->rows && spot->col < live->cols) {
		const struct live_cell *cell = &live->cell[spot->row * live->cols + spot->col];

		*at = spot->out ? cell->out : cell->in;
	}
	live_rung_free(live);
	return *at != LIVE_NOWHERE;
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
