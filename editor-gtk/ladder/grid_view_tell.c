/* SPDX-License-Identifier: MIT
 *
 * grid_view_tell - texts about an element of a sheet: accessible name, tooltip, place, keys.
 *
 * They come from the declarations, the catalogue, the checks and the table of verbs.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/draw/place.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/base/name.h"

#include <string.h>

/* ---- accessible names ---- */

/* "Rung 3, contact, closed while TRUE: Start, %IX0.0". */
/* Arguments, or statements in one line. */
static void say_args(const struct project *project, const struct cell *cell, GString *text)
{
	const char *args = project_text(project, cell->args);
	char **word = g_strsplit_set(args, " \n", -1);

	g_string_append(text, ",");
	for (int i = 0; word[i]; i++)
		if (word[i][0])
			g_string_append_printf(text, " %s", word[i]);
	g_strfreev(word);
}

static void say_element(LadderGridView *view, int rung, const struct cell *cell,
			GString *text)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct word_row *word = words_row(&project->words, (enum word)cell->word);
	const char *operand = project_text(project, cell->operand);
	const struct grid_name name = grid_names_find(view->names, operand);

	g_string_printf(text, _("Rung %d, %s"), view->first + rung + 1,
			word->word[0] ? word->word : explain_id(word));
	if (words_explain(word)[0])
		g_string_append_printf(text, ", %s", _(words_explain(word)));
	if (operand[0])
		g_string_append_printf(text, ": %s", operand);
	if (name.symbol[0] && !name_equal(name.symbol, operand))
		g_string_append_printf(text, ", %s", name.symbol);
	if (name.address[0] && !name_equal(name.address, operand))
		g_string_append_printf(text, ", %s", name.address);
	if (cell->args)
		say_args(project, cell, text);
}

char *tell_cell(LadderGridView *view, int rung, int row, int col, const struct cell *cell)
{
	GString *text = g_string_new(NULL);

	say_element(view, rung, cell, text);
	act_said(view, rung, row, col, text);
	if (canvas_is_live(LADDER_CANVAS(view)) &&
	    ladder_sim_is_missing(view->canvas->sim, view->canvas->document, view->canvas->pou,
				  view->first + rung))
		g_string_append_printf(text, ", %s", _("not downloaded"));
	return g_string_free(text, FALSE);
}

static bool is_wire(LadderGridView *view, const struct grid_cursor *at)
{
	struct grid_place place;

	return grid_display_find(sheet_rung(view, at->rung), view->columns, at->row,
				 at->col, &place) != GRID_SEEN_EMPTY;
}

/* "Rung 3, empty cell, row 1, column B"; the place tells elements of the same name
 * apart. */
char *tell_cursor(LadderGridView *view, bool values)
{
	const struct grid_cursor *at = &view->cursor.at;
	GString *text = g_string_new(NULL);
	char column[PLACE_LETTERS];
	const struct cell *cell;
	int row, col;

	if (sheet_rungs(view) == 0) {
		g_string_append(text, _("no rung"));
		return g_string_free(text, FALSE);
	}
	cell = cursor_cell(view, &row, &col);
	if (cell)
		say_element(view, at->rung, cell, text);
	else
		g_string_printf(text, _("Rung %d, %s"), view->first + at->rung + 1,
				is_wire(view, at) ? _("wire") : _("empty cell"));
	if (cell && values)
		act_said(view, at->rung, row, col, text);
	g_string_append(text, ", ");
	g_string_append_printf(text, _("row %d, column %s"), at->row + 1,
			       place_column(at->col, column));
	return g_string_free(text, FALSE);
}

/* ---- the tooltip ---- */

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
	const struct project *project = ladder_document_project(view->canvas->document);
	const char *operand = project_text(project, cell->operand);
	const struct grid_name name = grid_names_find(view->names, operand);
	GString *line = g_string_new(name.symbol[0] ? name.symbol : operand);

	if (name.address[0] && !name_equal(name.address, line->str))
		g_string_append_printf(line, " · %s", name.address);
	if (name.type[0])
		g_string_append_printf(line, " · %s", name.type);
	if (operand[0])
		add_line(text, line->str);
	if (cell->args) {
		char *args = g_strchomp(g_strdup(project_text(project, cell->args)));

		add_line(text, args);
		g_free(args);
	}
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
		line = g_strdup_printf(_("%s: %s"), mark->marks == MARK_ERROR ? _("Error") :
				       _("Warning"), said);
		add_line(text, line);
		g_free(said);
		g_free(line);
	}
}

char *ladder_grid_view_tip(LadderGridView *view, int rung, int row, int col)
{
	const struct project *project = ladder_document_project(view->canvas->document);
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
			char *line = g_strdup_printf(_("%s: %s"), word->word,
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

char *tell_tip(LadderCanvas *canvas, int x, int y, bool by_keys)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	struct rung_hit hit = { .part = RUNG_PART_CELL, .row = view->cursor.at.row,
				.column = view->cursor.at.col };
	const int rung = by_keys ? view->cursor.at.rung : sheet_point(view, x, y, &hit);

	if (rung < 0 || !sheet_rung(view, rung) || hit.part == RUNG_PART_NONE)
		return NULL;
	if (hit.part == RUNG_PART_NUMBER || hit.part == RUNG_PART_TITLE)
		return tip_of_rung(view, rung);
	return ladder_grid_view_tip(view, rung, hit.row,
				    rung_layout_col(strips_get(view, rung)->layout, hit.row,
						    hit.column));
}

/* ---- in the status bar ---- */

#define VERBS_TOLD 4

/* The most used verbs for the thing at the cursor. */
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
	row = words_row(&ladder_document_project(view->canvas->document)->words,
			(enum word)cell->word);
	if (row->kind == WORD_FB || row->kind == WORD_FN)
		return box;
	if (row->place == PLACE_LAST)
		return output;
	return row->operand == OPND_BOOL_R ? contact : other;
}

static void tell_key(GString *text, enum verb verb, const char *does)
{
	char *keys = verb_keys_label(verb);

	g_string_append_printf(text, _("%s%s: %s"), text->len ? " · " : "", keys, does);
	g_free(keys);
}

/* An EXECUTE box has no operand. */
static void tell_box(GString *text, bool live)
{
	tell_key(text, VERB_enter, _("Edit statements"));
	if (!live)
		tell_key(text, VERB_rename, _("Rename…"));
	verb_tell(text, VERB_comment);
	verb_tell(text, VERB_delete);
}

char *tell_keys(LadderCanvas *canvas)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const struct cell *cell = cursor_cell(view, NULL, NULL);
	GString *text = g_string_new(NULL);
	const enum verb *verb;
	bool live;

	if (sheet_rungs(view) == 0 || ladder_document_is_fixed(view->canvas->document))
		return g_string_free(text, FALSE);
	verb = verbs_of(view, cell);
	live = act_keys(view, text);
	if (cell && cell->word == ELEM_EXECUTE) {
		tell_box(text, live);
		return g_string_free(text, FALSE);
	}
	if (!cell)
		g_string_append(text, _("type a name or a word"));
	for (int i = 0; i < VERBS_TOLD; i++)
		/* act_keys() has named these two. */
		if (!live || (verb[i] != VERB_cycle && verb[i] != VERB_enter))
			verb_tell(text, verb[i]);
	return g_string_free(text, FALSE);
}

static char *place_of(LadderGridView *view)
{
	const int rung = view->first + view->cursor.at.rung + 1, row = view->cursor.at.row + 1;
	char column[PLACE_LETTERS];

	if (sheet_rungs(view) == 0)
		return g_strdup(_("no rung"));
	place_column(view->cursor.at.col, column);
	return row > 1 ? g_strdup_printf(_("Rung %d · row %d · column %s"), rung, row, column) :
	       g_strdup_printf(_("Rung %d · column %s"), rung, column);
}

/* In a function block with the shown instance. */
char *tell_place(LadderCanvas *canvas)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const char *instance = ladder_grid_view_instance(view);
	char *place = place_of(view), *whole;

	if (!instance)
		return place;
	whole = g_strdup_printf("%s · %s", place, instance);
	g_free(place);
	return whole;
}
