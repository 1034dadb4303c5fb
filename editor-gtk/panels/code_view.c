/* SPDX-License-Identifier: MIT
 *
 * code_view - the instruction list of the sheet in front; see code_view.h.
 */
#include "editor-gtk/panels/code_view.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/text_scroll.h"
#include "editor-gtk/kit/text_scheme.h"
#include "editor-gtk/text/line_values.h"
#include "editor-gtk/text/text_complete.h"

#include "engine/text/pou_print.h"

#include <string.h>

/* A line of the text. A simulation keeps the result after each instruction; a board that of cells
 * alone, whose power is the result after some lines. */
struct spot {
	int at;             /* its index in the list; -1: no instruction          */
	int rung, number;   /* 0-based: of which rung it is the how manieth       */
	int row, col;       /* 0-based, of a cell of that rung; -1: none          */
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
	int rung;           /* 0-based: the one with the cursor; -1: none        */
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

static void set_cell(struct spot *spot, const struct il_line *line, bool out)
{
	spot->row = line->row - 1;
	spot->col = line->col - 1;
	spot->out = out;
}

/* @next: the instruction behind it, NULL: none. Neither stands in parentheses. */
static void find_cell(struct spot *spot, const struct pou *pou, const struct il_line *line,
		      const struct il_line *next)
{
	const struct cell *cell = cell_of(pou, line);

	if (cell)
		set_cell(spot, line, is_contact(cell));
	else if (next && next->rung == line->rung && next->op != OP_LD && cell_of(pou, next))
		set_cell(spot, next, false); /* which takes the result */
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

/* The cells of a ladder without jumps: else nobody knows which of its rungs have run. */
static void find_cells(struct code_view *code, const struct pou *pou, const struct il *il, int at)
{
	int depth = 0;

	if (pou->language != LANGUAGE_LD || has_jumps(il))
		return;
	for (int i = 0; i < il->count; i = behind(il, i), at++) {
		const struct il_line *line = &il->line[i];
		const int next = behind(il, i);

		depth += (line->kind == IL_OP || line->kind == IL_FN) &&
			 line->modifiers & MOD_PAREN ? 1 : line->kind == IL_CLOSE ? -1 : 0;
		if (depth == 0)
			find_cell(&g_array_index(code->spots, struct spot, at), pou, line,
				  next < il->count ? &il->line[next] : NULL);
	}
}

/* One for each line of the text: declarations, the list, END_PROGRAM. */
static void find_spots(struct code_view *code, const struct pou *pou, const struct il *il,
		       const char *text)
{
	const struct spot none = { .at = -1, .rung = -1, .row = -1 };
	int lines = 0, rung = -1, number = 0, first;

	g_array_set_size(code->spots, 0);
	for (int i = 0; i < il->count; i = behind(il, i))
		lines++;
	for (const char *end = text; (end = strchr(end, '\n')); end++)
		g_array_append_val(code->spots, none);
	first = (int)code->spots->len - 1 - lines; /* line of the list */
	if (first < 0)
		return;
	for (int i = 0, at = first; i < il->count; i = behind(il, i), at++) {
		struct spot *spot = &g_array_index(code->spots, struct spot, at);

		if (!live_map_is_listed(&il->line[i]))
			continue;
		number = rung == (int)il->line[i].rung - 1 ? number + 1 : 0;
		rung = (int)il->line[i].rung - 1;
		*spot = (struct spot){ .at = i, .rung = rung, .number = number, .row = -1 };
	}
	find_cells(code, pou, il, first);
}

/* The line of the list that runs; -1: it has another one. Before a rung may now be others than
 * there. */
static int line_of_rung(const struct code_view *code, const struct spot *spot,
			const struct il *running)
{
	const int rung = spot->rung < 0 ? -1 :
		ladder_sim_rung(code->sim, code->document, code->pou, spot->rung);
	int number = spot->number;

	for (int i = 0; rung >= 0 && i < running->count; i++)
		if ((int)running->line[i].rung - 1 == rung && live_map_is_listed(&running->line[i]) &&
		    number-- == 0)
			return i;
	return -1;
}

static const char *words(const struct project *project, uint32_t id)
{
	return id ? project_text(project, id) : "";
}

/* The same of a chart: all of it has to be as it runs. */
static int line_of_chart(const struct spot *spot, const struct project *project,
			 const struct il *il, const struct project *other, const struct il *running)
{
	const struct il_line *a = &il->line[spot->at], *b = &running->line[spot->at];

	return running->count == il->count && a->kind == b->kind && a->op == b->op &&
	       a->modifiers == b->modifiers && a->word == b->word &&
	       strcmp(words(project, a->operand), words(other, b->operand)) == 0 ? spot->at : -1;
}

/* As a simulation keeps it. False: the program that runs keeps none, or runs another line. */
static bool find_listed(const struct code_view *code, const struct project *project,
			const struct il *il, const struct spot *spot, const struct live_map *map,
			struct live_result *out)
{
	struct ladder *ladder = ladder_sim_ladder(code->sim);
	const int pou = ladder_sim_pou(code->sim, code->document, code->pou);
	const struct il *running = ladder && pou >= 0 ? ladder_il(ladder, pou) : NULL;
	int line = -1;

	if (running && project->pou[code->pou].language == LANGUAGE_LD)
		line = line_of_rung(code, spot, running);
	else if (running)
		line = line_of_chart(spot, project, il, ladder_project(ladder), running);
	return line >= 0 && live_map_listed(map, live_map_before(running, line) + 1, out);
}

/* As a board keeps it. */
static bool find_power(const struct code_view *code, const struct project *project,
		       const struct spot *spot, const struct live_map *map,
		       struct live_result *out)
{
	const struct pou *pou = &project->pou[code->pou];
	struct live_rung *live;
	uint32_t at = LIVE_NOWHERE;

	if (spot->row < 0 || spot->rung < 0 || spot->rung >= pou->rung_count)
		return false;
	live = live_rung_new(map, project, pou->rung[spot->rung],
			     ladder_sim_rung(code->sim, code->document, code->pou, spot->rung));
	if (spot->row < live->rows && spot->col < live->cols) {
		const struct live_cell *cell = &live->cell[spot->row * live->cols + spot->col];

		at = spot->out ? cell->out : cell->in;
	}
	live_rung_free(live);
	*out = live_map_always(map);
	out->at = (struct location){ .type = IEC_BOOL, .where = at };
	return at != LIVE_NOWHERE;
}

/* Called by the text for each line that is on the screen, once a program. */
static bool find_result(void *context, const struct live_map *map, int line,
			struct live_result *out)
{
	struct code_view *code = context;
	struct ladder *ladder = ladder_document_checked(code->document);
	const struct project *project = ladder ? ladder_project(ladder) : NULL;
	const struct spot *spot = line < (int)code->spots->len ?
		&g_array_index(code->spots, struct spot, line) : NULL;
	const struct il *il = project && code->pou < project->pou_count ?
		ladder_il(ladder, code->pou) : NULL;

	if (!il || !spot || spot->at < 0 || spot->at >= il->count)
		return false;
	return find_listed(code, project, il, spot, map, out) ||
	       find_power(code, project, spot, map, out);
}

/* ---- the text ---- */

/* The line of the text where @rung begins; -1: it has none. */
static int first_line(const struct code_view *code, int rung)
{
	for (guint i = 0; rung >= 0 && i < code->spots->len; i++)
		if (g_array_index(code->spots, struct spot, i).rung == rung)
			return (int)i;
	return -1;
}

static void go_to_rung(struct code_view *code)
{
	const int line = first_line(code, code->rung);
	GtkTextIter at;

	if (line < 0)
		return;
	gtk_text_buffer_get_iter_at_line(code->buffer, &at, line);
	gtk_text_buffer_place_cursor(code->buffer, &at);
	text_scroll_to_cursor(GTK_TEXT_VIEW(code->text));
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
	go_to_rung(code);
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
	code->rung = -1;
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

void ladder_code_view_set_rung(GtkWidget *view, int rung)
{
	struct code_view *code = g_object_get_data(G_OBJECT(view), "code");

	if (code->rung == rung)
		return;
	code->rung = rung;
	if (!code->stale)
		go_to_rung(code);
}
