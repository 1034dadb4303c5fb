/* SPDX-License-Identifier: MIT
 *
 * grid_view_entry - what is asked for at a cell of a sheet: an element, its operand.
 *
 * The line is read by entry.c. While a word still lacks its operand, the sheet shows a
 * preview of the rung; the document learns of it when the line is taken, in one step with
 * the variables that it declares.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/document/entry_outcome.h"
#include "editor-gtk/kit/entry_popup.h"

#include "engine/model/args.h"

#include <stdlib.h>
#include <string.h>

#define CANDIDATES 40

/* Of the project as it is: made once, until that changes. A key must not wait for it. */
static struct xref *uses_of(LadderGridView *view)
{
	struct project *project = ladder_document_project(view->document);

	if (view->xref || !project)
		return view->xref;
	view->xref = g_new0(struct xref, 1);
	if (!xref_addresses(view->xref, project))
		entry_forget_uses(view);
	return view->xref;
}

void entry_forget_uses(LadderGridView *view)
{
	if (view->xref)
		xref_free(view->xref);
	g_clear_pointer(&view->xref, g_free);
}

static struct entry_place place_of(const struct sheet_asked *asked)
{
	LadderGridView *view = asked->view;

	return (struct entry_place){
		.project = ladder_document_project(view->document),
		.pou = view->pou,
		.output = asked->cursor.col == view->columns - 1 && !asked->before,
		.xref = uses_of(view),
	};
}

/* A line that begins with the word that was chosen before. */
static char *whole_line(const struct sheet_asked *asked, const char *line, size_t *skipped)
{
	const struct project *project = ladder_document_project(asked->view->document);
	const struct word_row *row;
	char *whole;

	*skipped = 0;
	if (asked->word == ELEM_EMPTY)
		return g_strdup(line);
	row = words_row(&project->words, asked->word);
	if (row->operand == OPND_EXPR || row->operand == OPND_ASSIGN)
		return g_strdup(line);
	whole = g_strdup_printf("%s %s", row->word, line);
	*skipped = strlen(row->word) + 1;
	return whole;
}

/* ---- while it is typed ---- */

static void add_candidate(const struct sheet_asked *asked, const struct entry_candidate *one,
			  size_t skipped)
{
	struct entry_popup_row row = {
		.text = (char *)one->text, .address = (char *)one->address,
		.note = (char *)one->note, .kind = _(entry_kind_text(one->kind)),
		.line = (char *)one->line + MIN(skipped, strlen(one->line)),
	};

	ladder_entry_popup_add(LADDER_ENTRY_POPUP(asked->view->entry), &row);
}

static char *element_changed(void *context, const char *line, int cursor, bool *good)
{
	struct sheet_asked *asked = context;
	struct entry_place place;
	struct entry_candidate *found;
	struct entry *entry;
	size_t skipped, at;
	char *whole, *told;
	int count;

	if (!asked->view->entry)
		return NULL; /* the popup is being made: it asks again */
	place = place_of(asked);
	found = g_new(struct entry_candidate, CANDIDATES);
	entry = g_new0(struct entry, 1);
	whole = whole_line(asked, line, &skipped);
	at = skipped + (size_t)(g_utf8_offset_to_pointer(line, cursor) - line);
	entry_read(&place, whole, entry);
	told = entry_outcome_tell(asked->view->document, place.pou, entry, line, good);
	count = entry_candidates(&place, whole, at, found, CANDIDATES);
	for (int i = 0; i < count; i++)
		add_candidate(asked, &found[i], skipped);
	g_free(whole);
	g_free(entry);
	g_free(found);
	return told;
}

/* ---- when it is taken ---- */

static struct rung *put_element(const struct sheet_asked *asked, struct cell cell,
				bool below, struct grid_at *at)
{
	LadderGridView *view = asked->view;
	const struct rung *rung = sheet_pou(view)->rung[view->first + asked->cursor.rung];
	const struct cell *old;
	struct rung *edited = NULL;
	int row;

	*at = asked->at;
	if (view->preview) {
		edited = grid_set(view->preview, at, cell);
		if (edited)
			return edited;
	}
	*at = (struct grid_at){ .columns = view->columns, .row = asked->cursor.row,
				.col = asked->cursor.col };
	old = asked->edit ? cursor_cell(view, &row, NULL) : NULL;
	if (old) {
		at->row = row; /* of a box the first, also from one of its pins */
		cell.comment = old->comment;
		edited = grid_set(rung, at, cell);
	}
	if (!edited && (asked->parallel || below))
		return grid_parallel(rung, at, NULL, cell);
	return edited ? edited : grid_place(rung, at, cell, GRID_REPLACE);
}

static void advance(LadderGridView *view, const struct grid_at *at)
{
	struct grid_cursor to = { view->cursor.rung, at->row, at->col };

	if (to.col < view->columns - 1)
		to.col++;
	cursor_set(view, to, false);
}

/* Of another instance of a block, of which nothing else is said. */
static void keep_args(const struct sheet_asked *asked, struct cell *cell)
{
	const struct cell *old = cursor_cell(asked->view, NULL, NULL);

	if (old && old->word == cell->word)
		cell->args = old->args;
}

static bool element_taken(void *context, const char *line)
{
	struct sheet_asked *asked = context;
	LadderGridView *view = asked->view;
	const struct entry_place place = place_of(asked);
	struct entry *entry = g_new0(struct entry, 1);
	struct cell cell = { 0 };
	struct grid_at at;
	size_t skipped;
	char *whole = whole_line(asked, line, &skipped);
	bool good = entry_read(&place, whole, entry) &&
		entry_cell(place.project, entry, &cell);

	if (good && entry->proposed && asked->edit)
		keep_args(asked, &cell);
	if (good) {
		struct rung *edited = put_element(asked, cell, entry->below, &at);

		view->cursor = asked->cursor;
		ladder_document_begin(view->document,
			asked->edit ? _("Change element") : _("Add element"), NULL);
		good = sheet_put(view, edited, &at, "") &&
		       entry_outcome_declare(view->document, view->pou, entry);
		ladder_document_end(view->document);
		if (good && !asked->edit)
			advance(view, &at);
	}
	g_free(whole);
	g_free(entry);
	return good;
}

void entry_line_left(void *context, const char *line)
{
	const struct sheet_asked *asked = context;
	char *told = g_strdup_printf(_("not taken: %s"), line);

	sheet_tell(asked->view, told);
	g_free(told);
}

void entry_line_gone(void *context)
{
	struct sheet_asked *asked = context;

	entry_close(asked->view);
	gtk_widget_grab_focus(GTK_WIDGET(asked->view));
}

/* ---- opening ---- */

void entry_open(struct sheet_asked *asked, const char *prompt, const char *text,
		       bool typed, const struct entry_popup_calls *calls)
{
	LadderGridView *view = asked->view;
	graphene_rect_t rect = cursor_rect(view);
	GdkRectangle cell = { (int)rect.origin.x, (int)rect.origin.y,
			      (int)rect.size.width, (int)rect.size.height };

	view->entry = ladder_entry_popup_new(GTK_WIDGET(view), prompt, text, typed, calls);
	g_object_set_data_full(G_OBJECT(view->entry), "asked", asked, g_free);
	/* Now it can be filled. */
	ladder_entry_popup_ask(LADDER_ENTRY_POPUP(view->entry));
	strips_redraw(view, view->cursor.rung);
	ladder_entry_popup_show(LADDER_ENTRY_POPUP(view->entry), &cell);
}

struct sheet_asked *entry_ask(LadderGridView *view)
{
	struct sheet_asked *asked = g_new0(struct sheet_asked, 1);

	entry_close(view);
	asked->view = view;
	asked->cursor = view->cursor;
	return asked;
}

static void open_element(struct sheet_asked *asked, const char *prompt, const char *text,
			 bool typed)
{
	const struct entry_popup_calls calls = {
		element_changed, element_taken, entry_line_gone, asked, entry_line_left,
		.proposes = !asked->edit && asked->word != ELEM_EMPTY,
	};

	entry_open(asked, prompt, text, typed, &calls);
}

void entry_begin(LadderGridView *view, const char *text)
{
	if (sheet_pou(view) && sheet_rungs(view) > 0 && !sheet_is_fixed(view))
		open_element(entry_ask(view), _("element and operand"), text, true);
}

/* Shows the element where it will be; false: it cannot stand there. */
static bool show_preview(struct sheet_asked *asked, struct rung *preview)
{
	LadderGridView *view = asked->view;

	if (!preview) {
		sheet_tell(view, _(grid_refusal_text(asked->at.refusal)));
		g_free(asked);
		return false;
	}
	view->preview = preview;
	strips_dirty(view, view->cursor.rung);
	view->cursor.row = asked->at.row;
	view->cursor.col = asked->at.col;
	cursor_reveal(view);
	return true;
}

/* What it gets if nothing else is said: an instance, parameters; else nothing. */
static char *proposal(const struct sheet_asked *asked, bool *whole)
{
	const struct entry_place place = place_of(asked);
	struct entry *entry = g_new0(struct entry, 1);
	size_t skipped;
	char *line = whole_line(asked, "", &skipped), *text = NULL;

	*whole = entry_read(&place, line, entry);
	if (*whole)
		text = g_strdup_printf("%s%s%s", entry->operand,
				       entry->operand[0] && entry->args[0] ? " " : "",
				       entry->args);
	g_free(line);
	g_free(entry);
	return text ? text : g_strdup("");
}

static void begin_word(struct sheet_asked *asked, struct rung *preview)
{
	LadderGridView *view = asked->view;
	const struct project *project = ladder_document_project(view->document);
	const struct word_row *row = words_row(&project->words, asked->word);
	bool whole;
	char *text = proposal(asked, &whole), *prompt;

	if (whole && !text[0]) { /* nothing to ask for */
		rung_free(preview);
		if (element_taken(asked, ""))
			sheet_tell(view, "");
		g_free(asked);
		g_free(text);
		return;
	}
	prompt = g_strdup_printf(_("%s: operand"), row->word);
	if (show_preview(asked, preview))
		open_element(asked, prompt, text, false);
	g_free(prompt);
	g_free(text);
}

void entry_begin_word(LadderGridView *view, enum word word, bool parallel)
{
	const struct cell cell = { .word = (uint16_t)word };
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	struct sheet_asked *asked;
	struct grid_area area;
	bool chosen;

	if (!rung || sheet_is_fixed(view))
		return;
	asked = entry_ask(view);
	rung = sheet_rung(view, view->cursor.rung); /* the preview is gone */
	asked->word = word;
	asked->parallel = parallel;
	/* An output at the cursor is not lost for something else. */
	asked->before = view->cursor.col >= view->columns - 1 &&
			word_row(word)->place != PLACE_LAST;
	asked->at = sheet_at(view);
	chosen = cursor_area(view, &area);
	begin_word(asked, parallel ?
		   grid_parallel(rung, &asked->at, chosen ? &area : NULL, cell) :
		   grid_place(rung, &asked->at, cell, asked->before ? GRID_INSERT :
			      GRID_REPLACE));
}

void entry_begin_drop(LadderGridView *view, enum word word, int row, int col)
{
	const struct cell cell = { .word = (uint16_t)word };
	struct sheet_asked *asked;

	if (sheet_is_fixed(view))
		return;
	asked = entry_ask(view);
	asked->word = word;
	asked->at = (struct grid_at){ .columns = view->columns, .row = row, .col = col };
	begin_word(asked, grid_drop(sheet_rung(view, view->cursor.rung), &asked->at,
				    cell));
}

/* As it stands in the cell at the cursor. */
static char *line_now(LadderGridView *view)
{
	const struct project *project = ladder_document_project(view->document);
	const struct cell *cell = cursor_cell(view, NULL, NULL);

	return g_strdup_printf("%s%s%s", project_text(project, cell->operand),
			       cell->operand && cell->args ? " " : "",
			       project_text(project, cell->args));
}

static void begin_edit(LadderGridView *view, const char *text)
{
	struct sheet_asked *asked = entry_ask(view);

	asked->word = (enum word)cursor_cell(view, NULL, NULL)->word;
	asked->edit = true;
	open_element(asked, _("operand"), text, false);
}

void entry_begin_edit(LadderGridView *view)
{
	char *text;

	if (!sheet_pou(view) || sheet_rungs(view) == 0 || sheet_is_fixed(view))
		return;
	if (!cursor_cell(view, NULL, NULL)) {
		entry_begin(view, "");
		return;
	}
	text = line_now(view);
	begin_edit(view, text);
	g_free(text);
}

void entry_begin_pin(LadderGridView *view, const char *pin, gsize len, bool output)
{
	struct arg arg;
	char *text, *line;
	const char *args;

	if (sheet_is_fixed(view) || !cursor_cell(view, NULL, NULL))
		return;
	text = line_now(view);
	args = project_text(ladder_document_project(view->document),
			    cursor_cell(view, NULL, NULL)->args);
	if (args_find(args, pin, len, &arg)) {
		const gsize from = strlen(text) - strlen(args) + (gsize)(arg.value - args) -
				   arg.inverse;

		begin_edit(view, text);
		ladder_entry_popup_select(LADDER_ENTRY_POPUP(view->entry), from,
					  from + arg.value_len + arg.inverse);
	} else {
		line = g_strdup_printf("%s%s%.*s%s", text, *text ? " " : "", (int)len, pin,
				       output ? "=>" : ":=");
		begin_edit(view, line);
		ladder_entry_popup_select(LADDER_ENTRY_POPUP(view->entry), strlen(line),
					  strlen(line));
		g_free(line);
	}
	g_free(text);
}

/* ---- closing ---- */

void entry_close(LadderGridView *view)
{
	GtkWidget *entry = view->entry;

	view->entry = NULL;
	view->entry_sets = false;
	if (view->preview) {
		g_clear_pointer(&view->preview, rung_free);
		strips_dirty(view, view->cursor.rung);
		cursor_fit(view);
	}
	if (!entry)
		return;
	ladder_entry_popup_keep(LADDER_ENTRY_POPUP(entry));
	strips_redraw(view, view->cursor.rung);
}

void entry_allocate(LadderGridView *view)
{
	GtkWidget *child = gtk_widget_get_first_child(GTK_WIDGET(view));

	for (; child; child = gtk_widget_get_next_sibling(child))
		if (GTK_IS_POPOVER(child)) /* the menu, too */
			gtk_popover_present(GTK_POPOVER(child));
}
