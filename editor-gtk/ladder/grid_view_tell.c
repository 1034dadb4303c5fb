/* SPDX-License-Identifier: MIT
 *
 * grid_view_tell - what a sheet tells of an element: below the pointer, in the status bar.
 *
 * The texts are the declarations', the catalogue's and the checks'; keys are those of the
 * verbs.
 */
#include "editor-gtk/ladder/grid_view_inside.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

/* ---- below the pointer ---- */

static void add_line(GString *text, const char *line)
{
	if (!line[0])
		return;
	if (text->len)
		g_string_append_c(text, '\n');
	g_string_append(text, line);
}

/* Without the delimiters that belong to the file. */
static char *plain_comment(const char *text)
{
	const gsize len = strlen(text);

	if (len >= 4 && g_str_has_prefix(text, "(*") && g_str_has_suffix(text, "*)"))
		return g_strstrip(g_strndup(text + 2, len - 4));
	return g_strstrip(g_strdup(g_str_has_prefix(text, "//") ? text + 2 : text));
}

static void add_comment(GString *text, const char *comment)
{
	char *plain = plain_comment(comment);

	add_line(text, plain);
	g_free(plain);
}

/* "Start · %IX0.0 · BOOL". */
static void add_name(LadderGridView *view, GString *text, const struct cell *cell)
{
	const struct project *project = ladder_document_project(view->document);
	const char *operand = project_text(project, cell->operand);
	const struct grid_name name = grid_names_find(view->names, operand);
	GString *line = g_string_new(name.symbol[0] ? name.symbol : operand);

	if (name.address[0] && g_ascii_strcasecmp(name.address, line->str) != 0)
		g_string_append_printf(line, " · %s", name.address);
	if (name.type[0])
		g_string_append_printf(line, " · %s", name.type);
	if (operand[0])
		add_line(text, line->str);
	if (cell->args)
		add_line(text, project_text(project, cell->args));
	add_comment(text, name.comment);
	g_string_free(line, TRUE);
}

static void add_faults(LadderGridView *view, GString *text, int rung, int row, int col)
{
	for (guint i = 0; i < view->marks->len; i++) {
		const struct sheet_mark *mark =
			&g_array_index(view->marks, struct sheet_mark, i);
		char *line, *said;

		if (mark->rung != rung || mark->row != row || mark->col != col)
			continue;
		said = diag_said_whole(mark->diag);
		line = g_strdup_printf("%s: %s", mark->marks == MARK_ERROR ? _("Error") :
				       _("Warning"), said);
		add_line(text, line);
		g_free(said);
		g_free(line);
	}
}

char *ladder_grid_view_tip(LadderGridView *view, int rung, int row, int col)
{
	const struct project *project = ladder_document_project(view->document);
	const struct rung *shown = sheet_rung(view, rung);
	const struct cell *cell;
	const struct word_row *word;
	GString *text;

	if (!shown || !view->names || row < 0 || row >= shown->rows || col < 0 ||
	    col >= shown->cols)
		return NULL;
	cell = rung_at(shown, row, col);
	text = g_string_new(NULL);
	if (cell->word != ELEM_EMPTY && cell->word != ELEM_WIRE && cell->word != ELEM_PIN) {
		word = words_row(&project->words, (enum word)cell->word);
		add_name(view, text, cell);
		if (word->word[0] && words_explain(word)[0]) {
			char *line = g_strdup_printf("%s: %s", word->word,
						     _(words_explain(word)));

			add_line(text, line);
			g_free(line);
		}
		add_comment(text, project_text(project, cell->comment));
		act_tip(view, rung, row, col, text);
	}
	add_faults(view, text, rung, row, col);
	return g_string_free(text, text->len == 0);
}

static char *tip_of_rung(LadderGridView *view, int rung)
{
	GString *text = g_string_new(NULL);

	add_faults(view, text, rung, -1, -1);
	return g_string_free(text, text->len == 0);
}

/* What has popped up over the sheet must not be hidden by what is said of that. */
static bool is_covered(LadderGridView *view)
{
	GtkWidget *child = gtk_widget_get_first_child(GTK_WIDGET(view));

	while (child && !(GTK_IS_POPOVER(child) && gtk_widget_get_mapped(child)))
		child = gtk_widget_get_next_sibling(child);
	return child;
}

static gboolean tip_wanted(GtkWidget *widget, int x, int y, gboolean by_keys,
			   GtkTooltip *tooltip)
{
	LadderGridView *view = LADDER_GRID_VIEW(widget);
	struct rung_hit hit = { .part = RUNG_PART_CELL, .row = view->cursor.row,
				.column = view->cursor.col };
	int rung = by_keys ? view->cursor.rung : sheet_point(view, x, y, &hit);
	const struct strip *strip;
	gboolean told;
	char *text;

	if (rung < 0 || !sheet_rung(view, rung) || view->entry || is_covered(view))
		return FALSE;
	strip = strips_get(view, rung);
	text = hit.part == RUNG_PART_NUMBER || hit.part == RUNG_PART_TITLE ?
		tip_of_rung(view, rung) : hit.part == RUNG_PART_NONE ? NULL :
		ladder_grid_view_tip(view, rung, hit.row,
				     rung_layout_col(strip->layout, hit.row, hit.column));
	told = tip_show(tooltip, text);
	g_free(text);
	return told;
}

void tell_init(LadderGridView *view)
{
	gtk_widget_set_has_tooltip(GTK_WIDGET(view), TRUE);
	g_signal_connect(view, "query-tooltip", G_CALLBACK(tip_wanted), NULL);
}

/* ---- in the status bar ---- */

#define VERBS_TOLD 4

/* What is done most with what the cursor is on. */
static const enum verb *verbs_of(LadderGridView *view, const struct cell *cell)
{
	static const enum verb nothing[] = { VERB_contact, VERB_coil, VERB_block,
					     VERB_rung_below };
	static const enum verb contact[] = { VERB_enter, VERB_negate, VERB_parallel,
					     VERB_cycle };
	static const enum verb output[] = { VERB_enter, VERB_cycle, VERB_show_uses,
					    VERB_rung_below };
	static const enum verb box[] = { VERB_enter, VERB_add_pin, VERB_comment,
					 VERB_delete };
	static const enum verb other[] = { VERB_enter, VERB_parallel, VERB_comment,
					   VERB_delete };
	const struct word_row *row;

	if (!cell)
		return nothing;
	row = words_row(&ladder_document_project(view->document)->words,
			(enum word)cell->word);
	if (row->kind == WORD_FB || row->kind == WORD_FN)
		return box;
	if (row->place == PLACE_LAST)
		return output;
	return row->operand == OPND_BOOL_R ? contact : other;
}

char *ladder_grid_view_keys(LadderGridView *view)
{
	const struct cell *cell = cursor_cell(view, NULL, NULL);
	GString *text = g_string_new(NULL);
	const enum verb *verb;
	bool live;

	if (sheet_rungs(view) == 0 || ladder_document_is_fixed(view->document))
		return g_string_free(text, FALSE);
	verb = verbs_of(view, cell);
	live = act_keys(view, text);
	if (!cell)
		g_string_append(text, _("type a name or a word"));
	for (int i = 0; i < VERBS_TOLD; i++)
		/* Those mean something else now. */
		if (!live || (verb[i] != VERB_cycle && verb[i] != VERB_enter))
			verb_tell(text, verb[i]);
	return g_string_free(text, FALSE);
}
