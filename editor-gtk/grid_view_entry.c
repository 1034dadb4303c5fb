/* SPDX-License-Identifier: MIT
 *
 * grid_view_entry - what is asked for at a cell of a sheet: an element, its operand, a title.
 *
 * The line is read by entry.c. While a word still lacks its operand, the sheet shows a
 * preview of the rung; the document learns of it when the line is taken, in one step with
 * the variables that it declares.
 */
#include "editor-gtk/grid_view_inside.h"

#include "editor-gtk/comment_text.h"
#include "editor-gtk/entry_inside.h"
#include "editor-gtk/entry_outcome.h"
#include "editor-gtk/entry_popup.h"

#include "engine/base/explain.h"

#include <stdlib.h>
#include <string.h>

#define CANDIDATES 40

/* What the popup that is open is for. It lives until that is asked for something else. */
struct asked {
	LadderGridView *view;
	enum word word;       /* fixed; ELEM_EMPTY: the line begins with it     */
	bool edit;            /* of what stands there; its comment is kept      */
	bool parallel;
	enum verb verb;       /* of a text: title, label, comment, pin          */
	struct grid_at at;    /* of the element in the preview                 */
	struct grid_cursor cursor; /* when it began                            */
};

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

static struct entry_place place_of(const struct asked *asked)
{
	LadderGridView *view = asked->view;

	return (struct entry_place){
		.project = ladder_document_project(view->document),
		.pou = view->pou,
		.output = asked->cursor.col == view->columns - 1,
		.xref = uses_of(view),
	};
}

/* A line that begins with the word that was chosen before. */
static char *whole_line(const struct asked *asked, const char *line, size_t *skipped)
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

static void add_candidate(const struct asked *asked, const struct entry_candidate *one,
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
	struct asked *asked = context;
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

static struct rung *put_element(const struct asked *asked, struct cell cell,
				bool below, struct grid_at *at)
{
	LadderGridView *view = asked->view;
	const struct rung *rung = sheet_pou(view)->rung[view->first + asked->cursor.rung];
	const struct cell *old;
	struct rung *edited = NULL;

	*at = asked->at;
	if (view->preview) {
		edited = grid_set(view->preview, at, cell);
		if (edited)
			return edited;
	}
	*at = (struct grid_at){ .columns = view->columns, .row = asked->cursor.row,
				.col = asked->cursor.col };
	old = asked->edit ? cursor_cell(view, NULL, NULL) : NULL;
	if (old) {
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

static bool element_taken(void *context, const char *line)
{
	struct asked *asked = context;
	LadderGridView *view = asked->view;
	const struct entry_place place = place_of(asked);
	struct entry *entry = g_new0(struct entry, 1);
	struct cell cell = { 0 };
	struct grid_at at;
	size_t skipped;
	char *whole = whole_line(asked, line, &skipped);
	bool good = entry_read(&place, whole, entry) &&
		entry_cell(place.project, entry, &cell);

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

static void line_left(void *context, const char *line)
{
	const struct asked *asked = context;
	char *told = g_strdup_printf(_("not taken: %s"), line);

	sheet_tell(asked->view, told);
	g_free(told);
}

static void element_gone(void *context)
{
	struct asked *asked = context;

	entry_close(asked->view);
	gtk_widget_grab_focus(GTK_WIDGET(asked->view));
}

/* ---- texts ---- */

static uint32_t intern_comment(struct project *project, const char *text)
{
	char *whole = g_strdup_printf("(* %s *)", text);
	uint32_t id = text[0] ? names_intern(&project->names, whole, strlen(whole)) : 0;

	g_free(whole);
	return id;
}

static bool set_text(LadderGridView *view, enum verb verb, const char *text,
		     struct rung *rung, struct cell *cell)
{
	struct project *project = ladder_document_project(view->document);
	const uint32_t id = names_intern(&project->names, text, strlen(text));

	switch ((int)verb) {
	case VERB_rung_title:
		rung->title = id;
		return true;
	case VERB_rung_label:
		rung->label = id;
		return true;
	case VERB_rung_comment:
		rung->comment = intern_comment(project, text);
		return true;
	default:
		if (cell)
			cell->comment = intern_comment(project, text);
		return cell != NULL;
	}
}

static bool add_pin(LadderGridView *view, const char *name)
{
	struct project *project = ladder_document_project(view->document);
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	struct grid_at at = sheet_at(view);
	const uint32_t pin = names_intern(&project->names, name, strlen(name));

	return sheet_put(view, grid_add_pin(rung, &at, project, pin, NULL), &at,
			 _(verb_row(VERB_add_pin)->label));
}

/* As it stands in the file now. */
static char *text_now(LadderGridView *view, enum verb verb)
{
	const struct project *project = ladder_document_project(view->document);
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	const struct cell *cell = cursor_cell(view, NULL, NULL);

	switch ((int)verb) {
	case VERB_rung_title:
		return g_strdup(project_text(project, rung->title));
	case VERB_rung_label:
		return g_strdup(project_text(project, rung->label));
	case VERB_rung_comment:
		return comment_text(project_text(project, rung->comment));
	default:
		return comment_text(cell ? project_text(project, cell->comment) : "");
	}
}

/* Why a file could not hold it, or its jumps not follow; NULL: it could. Caller frees. */
static char *refusal(const struct asked *asked, const char *line)
{
	const enum verb verb = asked->verb;
	const bool comment = verb == VERB_rung_comment || verb == VERB_comment;

	if (comment && (strstr(line, "(*") || strstr(line, "*)")))
		return g_strdup(_("a comment holds no (* and no *)"));
	if (verb != VERB_rung_label || !line[0])
		return NULL;
	return entry_is_name(line, strlen(line)) ? label_refusal(asked->view, line) :
	       g_strdup(_("this is no name"));
}

static bool is_refused(const struct asked *asked, const char *line)
{
	char *why = refusal(asked, line);
	const bool is = why != NULL;

	g_free(why);
	return is;
}

static bool is_as_before(const struct asked *asked, const char *line)
{
	char *before = text_now(asked->view, asked->verb);
	const bool same = strcmp(before, line) == 0;

	g_free(before);
	return same;
}

static bool text_taken(void *context, const char *line)
{
	struct asked *asked = context;
	LadderGridView *view = asked->view;
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	struct grid_at at = sheet_at(view);
	struct rung *copy;
	int row, col;

	if (asked->verb == VERB_add_pin)
		return add_pin(view, line);
	if (is_as_before(asked, line))
		return true;
	if (is_refused(asked, line))
		return false;
	if (asked->verb == VERB_rung_label && label_set(view, line))
		return true;
	copy = rung_copy(rung);
	if (!set_text(view, asked->verb, line, copy,
		      cursor_cell(view, &row, &col) ? rung_cell(copy, row, col) : NULL)) {
		rung_free(copy);
		return true;
	}
	return sheet_put(view, copy, &at, _(verb_row(asked->verb)->label));
}

/* Boolean inputs of the box that nothing feeds yet. */
static char *pin_changed(void *context, const char *line, int cursor, bool *good)
{
	struct asked *asked = context;
	const struct project *project = ladder_document_project(asked->view->document);
	const struct cell *cell = cursor_cell(asked->view, NULL, NULL);
	const struct word_row *row = cell ?
		words_row(&project->words, (enum word)cell->word) : NULL;

	(void)cursor;
	*good = true;
	for (int i = 0; asked->view->entry && row && row->kind == WORD_FB &&
	     i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		struct entry_popup_row one = { (char *)pin->name, "",
			(char *)said(explain_pin(row, i)), _("input"),
			(char *)pin->name };

		if (pin->dir == PIN_IN && pin->type == IEC_BOOL &&
		    i != word_first_bool(row, PIN_IN) &&
		    g_ascii_strncasecmp(pin->name, line, strlen(line)) == 0)
			ladder_entry_popup_add(LADDER_ENTRY_POPUP(asked->view->entry),
					       &one);
	}
	return NULL;
}

static char *text_changed(void *context, const char *line, int cursor, bool *good)
{
	const struct asked *asked = context;
	char *why = refusal(asked, line);

	(void)cursor;
	*good = !why;
	return why;
}

/* ---- opening ---- */

static void open_popup(struct asked *asked, const char *prompt, const char *text,
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

static struct asked *ask(LadderGridView *view)
{
	struct asked *asked = g_new0(struct asked, 1);

	entry_close(view);
	asked->view = view;
	asked->cursor = view->cursor;
	return asked;
}

static void open_element(struct asked *asked, const char *prompt, const char *text,
			 bool typed)
{
	const struct entry_popup_calls calls = {
		element_changed, element_taken, element_gone, asked, line_left,
		.proposes = !asked->edit && asked->word != ELEM_EMPTY,
	};

	open_popup(asked, prompt, text, typed, &calls);
}

void entry_begin(LadderGridView *view, const char *text)
{
	if (sheet_pou(view) && sheet_rungs(view) > 0 && !sheet_is_fixed(view))
		open_element(ask(view), _("element and operand"), text, true);
}

/* Shows the element where it will be; false: it cannot stand there. */
static bool show_preview(struct asked *asked, struct rung *preview)
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
static char *proposal(const struct asked *asked, bool *whole)
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

static void begin_word(struct asked *asked, struct rung *preview)
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
	struct asked *asked;
	struct grid_area area;
	bool chosen;

	if (!rung || sheet_is_fixed(view))
		return;
	asked = ask(view);
	rung = sheet_rung(view, view->cursor.rung); /* the preview is gone */
	asked->word = word;
	asked->parallel = parallel;
	asked->at = sheet_at(view);
	chosen = cursor_area(view, &area);
	begin_word(asked, parallel ?
		   grid_parallel(rung, &asked->at, chosen ? &area : NULL, cell) :
		   grid_place(rung, &asked->at, cell, GRID_REPLACE));
}

void entry_begin_drop(LadderGridView *view, enum word word, int row, int col)
{
	const struct cell cell = { .word = (uint16_t)word };
	struct asked *asked;

	if (sheet_is_fixed(view))
		return;
	asked = ask(view);
	asked->word = word;
	asked->at = (struct grid_at){ .columns = view->columns, .row = row, .col = col };
	begin_word(asked, grid_drop(sheet_rung(view, view->cursor.rung), &asked->at,
				    cell));
}

void entry_begin_edit(LadderGridView *view)
{
	const struct project *project = ladder_document_project(view->document);
	const struct cell *cell = cursor_cell(view, NULL, NULL);
	struct asked *asked;
	char *text;

	if (!sheet_pou(view) || sheet_rungs(view) == 0 || sheet_is_fixed(view))
		return;
	if (!cell) {
		entry_begin(view, "");
		return;
	}
	text = g_strdup_printf("%s%s%s", project_text(project, cell->operand),
			       cell->operand && cell->args ? " " : "",
			       project_text(project, cell->args));
	asked = ask(view);
	cell = cursor_cell(view, NULL, NULL);
	asked->word = (enum word)cell->word;
	asked->edit = true;
	open_element(asked, _("operand"), text, false);
	g_free(text);
}

void entry_begin_text(LadderGridView *view, enum verb verb)
{
	struct entry_popup_calls calls = { .changed = text_changed, .taken = text_taken,
					   .gone = element_gone, .left = line_left };
	struct asked *asked;
	char *text;

	if (!sheet_rung(view, view->cursor.rung))
		return;
	if ((verb == VERB_comment || verb == VERB_add_pin) &&
	    !cursor_cell(view, NULL, NULL)) {
		sheet_tell(view, _("there is no element here"));
		return;
	}
	asked = ask(view);
	asked->verb = verb;
	calls.context = asked;
	text = verb == VERB_add_pin ? g_strdup("") : text_now(view, verb);
	if (verb == VERB_add_pin)
		calls.changed = pin_changed;
	open_popup(asked, _(verb_row(verb)->label), text, false, &calls);
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
