/* SPDX-License-Identifier: MIT
 *
 * grid_view_entry - the entry at the cursor of a sheet: an element and its operand; title,
 * label, comments, a pin.
 *
 * While a word lacks its operand the sheet shows a preview of the rung. The document gets the
 * rung when the line is taken, in one step with the variables that the line declares. A line
 * that a file cannot hold stays open and says why.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/document/entry_outcome.h"
#include "editor-gtk/document/rename.h"
#include "editor-gtk/edit/entry_names.h"
#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/kit/entry_popup.h"
#include "engine/base/catalog.h"
#include "engine/base/name.h"
#include "engine/model/args.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

#define CANDIDATES 40

/* The open question; it lives until the next one. */
struct asked {
	LadderGridView *view;
	enum word word;       /* fixed; ELEM_EMPTY: the line begins with it     */
	bool edit;            /* changes the present element, keeps its comment */
	bool parallel;
	bool before;          /* insert before the output at the cursor         */
	bool box;             /* a block is wanted                              */
	enum verb verb;       /* for a text: title, label, comment, pin         */
	struct grid_at at;    /* of the element in the preview                 */
	struct grid_cursor cursor; /* when the entry opened                    */
};

static struct entry_place place_of(const struct asked *asked)
{
	LadderGridView *view = asked->view;

	return (struct entry_place){
		.project = ladder_document_project(view->canvas->document),
		.pou = view->canvas->pou,
		.output = asked->cursor.col == view->columns - 1 && !asked->before,
		.box = asked->box,
		.xref = canvas_uses(LADDER_CANVAS(view)),
	};
}

/* A line that begins with the word that was chosen before. */
static char *whole_line(const struct asked *asked, const char *line, size_t *skipped)
{
	const struct project *project = ladder_document_project(asked->view->canvas->document);
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

/* ---- each letter ---- */

/* @head: the first @head_len bytes of the line, before the element. */
static void add_candidate(const struct asked *asked, const struct entry_candidate *one,
			  size_t skipped, const char *head, size_t head_len)
{
	char *line = g_strdup_printf("%.*s%s", (int)head_len, head,
				     one->line + MIN(skipped, strlen(one->line)));
	struct entry_popup_row row = {
		.text = (char *)one->text, .address = (char *)one->address,
		.note = (char *)one->note, .kind = _(entry_kind_text(one->kind)), .line = line,
		.marked = one->kind == ENTRY_NEW,
	};

	ladder_entry_popup_add(LADDER_ENTRY_POPUP(asked->view->canvas->entry), &row);
	g_free(line);
}

/* The outcome of an element from byte @from of the line on, and its candidates. */
static char *element_outcome(const struct asked *asked, const char *line, size_t from, int cursor,
			     bool *good)
{
	const struct entry_place place = place_of(asked);
	struct entry_candidate *found = g_new(struct entry_candidate, CANDIDATES);
	struct entry *entry = g_new0(struct entry, 1);
	const size_t at = (size_t)(g_utf8_offset_to_pointer(line, cursor) - line);
	size_t skipped;
	char *whole = whole_line(asked, line + from, &skipped), *told;
	int count;

	entry_read(&place, whole, entry);
	told = entry_outcome_tell(asked->view->canvas->document, place.pou, entry, line + from,
				  good);
	canvas_blame(LADDER_CANVAS(asked->view), entry);
	count = at < from ? 0 : entry_candidates(&place, whole, skipped + at - from, found,
						 CANDIDATES);
	for (int i = 0; i < count; i++)
		add_candidate(asked, &found[i], skipped, line, from);
	g_free(whole);
	g_free(entry);
	g_free(found);
	return told;
}

static char *element_changed(void *context, const char *line, int cursor, bool *good)
{
	return element_outcome(context, line, 0, cursor, good);
}

/* ---- Enter ---- */

static struct rung *put_element(const struct asked *asked, struct cell cell,
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
		at->row = row; /* the first row of a box, also from a pin */
		cell.comment = old->comment;
		edited = grid_set(rung, at, cell);
	}
	if (!edited && (asked->parallel || below))
		return grid_parallel(rung, at, NULL, cell);
	return edited ? edited : grid_place(rung, at, cell, GRID_REPLACE);
}

static void advance(LadderGridView *view, const struct grid_at *at)
{
	struct grid_cursor to = { view->cursor.at.rung, at->row, at->col };

	if (to.col < view->columns - 1)
		to.col++;
	cursor_set(view, to, false);
}

/* Another instance of the same block keeps the arguments, an EXECUTE box its statements. */
static void keep_args(const struct asked *asked, struct cell *cell)
{
	const struct cell *old = cursor_cell(asked->view, NULL, NULL);

	if (old && old->word == cell->word)
		cell->args = old->args;
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

	if (good && (entry->proposed || cell.word == ELEM_EXECUTE) && asked->edit)
		keep_args(asked, &cell);
	if (good) {
		struct rung *edited = put_element(asked, cell, entry->below, &at);

		view->cursor.at = asked->cursor;
		ladder_document_begin(view->canvas->document,
			asked->edit ? _("Change element") : _("Add element"), NULL);
		good = sheet_put(view, edited, &at, "") &&
		       entry_outcome_declare(view->canvas->document, view->canvas->pou, entry);
		ladder_document_end(view->canvas->document);
		if (good && !asked->edit)
			advance(view, &at);
	}
	g_free(whole);
	g_free(entry);
	return good;
}

/* ---- opening ---- */

/* @asked: taken over. */
static void open_entry(struct asked *asked, struct canvas_question question)
{
	question.context = asked;
	question.free = g_free;
	canvas_ask(LADDER_CANVAS(asked->view), &question);
	strips_redraw(asked->view, asked->view->cursor.at.rung);
}

/* Closes an open entry. */
static struct asked *asked_new(LadderGridView *view)
{
	struct asked *asked = g_new0(struct asked, 1);

	canvas_close_entry(LADDER_CANVAS(view));
	asked->view = view;
	asked->cursor = view->cursor.at;
	return asked;
}

static void open_element(struct asked *asked, const char *prompt, const char *text,
			 bool typed)
{
	open_entry(asked, (struct canvas_question){
		.prompt = prompt, .text = text, .typed = typed, .spells = true,
		.proposes = !asked->edit && asked->word != ELEM_EMPTY,
		.changed = element_changed, .taken = element_taken,
	});
}

/* A program without rungs gets one. */
static bool has_rung(LadderGridView *view)
{
	struct rung *rung;
	bool good;

	if (!sheet_pou(view) || sheet_rungs(view) > 0)
		return sheet_pou(view);
	rung = rung_new(1, 1);
	ladder_document_begin(view->canvas->document, _(verb_row(VERB_rung_below)->label), NULL);
	good = sheet_splice(view, 0, 0, &rung, 1, NULL);
	ladder_document_end(view->canvas->document);
	return good;
}

void entry_begin(LadderGridView *view, const char *text)
{
	if (!canvas_is_fixed(LADDER_CANVAS(view)) && has_rung(view))
		open_element(asked_new(view), _("element and operand"), text, true);
}

void entry_begin_box(LadderGridView *view)
{
	struct asked *asked;

	if (canvas_is_fixed(LADDER_CANVAS(view)) || !has_rung(view))
		return;
	asked = asked_new(view);
	asked->box = true;
	open_element(asked, _("element and operand"), "", true);
}

/* Shows the element where it will be. */
static void show_preview(const struct asked *asked, struct rung *preview)
{
	LadderGridView *view = asked->view;

	view->preview = preview;
	strips_dirty(view, view->cursor.at.rung);
	view->cursor.at.row = asked->at.row;
	view->cursor.at.col = asked->at.col;
	cursor_reveal(view);
}

/* The proposed text: an instance, parameters; "": none. @whole: it needs no operand. */
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
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct word_row *row = words_row(&project->words, asked->word);
	bool whole;
	char *text = proposal(asked, &whole), *prompt;

	if (preview && whole && !text[0]) { /* no operand to ask for */
		rung_free(preview);
		if (element_taken(asked, ""))
			canvas_tell(LADDER_CANVAS(view), "");
		g_free(asked);
		g_free(text);
		return;
	}
	prompt = g_strdup_printf(_("%s: operand"), row->word);
	if (preview) {
		show_preview(asked, preview);
		open_element(asked, prompt, text, false);
	} else {
		canvas_refuse(LADDER_CANVAS(view), prompt,
			      _(grid_refusal_text(asked->at.refusal)));
		g_free(asked);
	}
	g_free(prompt);
	g_free(text);
}

void entry_begin_word(LadderGridView *view, enum word word, bool parallel)
{
	const struct cell cell = { .word = (uint16_t)word };
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);
	struct asked *asked;
	struct grid_area area;
	bool chosen;

	if (!rung || canvas_is_fixed(LADDER_CANVAS(view)))
		return;
	asked = asked_new(view);
	rung = sheet_rung(view, view->cursor.at.rung); /* not the preview, which is freed */
	asked->word = word;
	asked->parallel = parallel;
	/* An output at the cursor must not be replaced by another kind of element. */
	asked->before = view->cursor.at.col >= view->columns - 1 &&
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
	struct asked *asked;

	if (canvas_is_fixed(LADDER_CANVAS(view)))
		return;
	asked = asked_new(view);
	asked->word = word;
	asked->at = (struct grid_at){ .columns = view->columns, .row = row, .col = col };
	begin_word(asked, grid_drop(sheet_rung(view, view->cursor.at.rung), &asked->at,
				    cell));
}

/* Operand and parameters of the element at the cursor. */
static char *line_now(LadderGridView *view)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct cell *cell = cursor_cell(view, NULL, NULL);

	if (cell->word == ELEM_EXECUTE)
		return g_strdup(project_text(project, cell->operand));
	return g_strdup_printf("%s%s%s", project_text(project, cell->operand),
			       cell->operand && cell->args ? " " : "",
			       project_text(project, cell->args));
}

static void begin_edit(LadderGridView *view, const char *text)
{
	struct asked *asked = asked_new(view);

	asked->word = (enum word)cursor_cell(view, NULL, NULL)->word;
	asked->edit = true;
	open_element(asked, _("operand"), text, false);
}

void entry_begin_edit(LadderGridView *view)
{
	char *text;

	if (!sheet_pou(view) || sheet_rungs(view) == 0 || canvas_is_fixed(LADDER_CANVAS(view)))
		return;
	if (!cursor_cell(view, NULL, NULL)) {
		entry_begin(view, "");
		return;
	}
	text = line_now(view);
	begin_edit(view, text);
	g_free(text);
}

/* ---- inputs of a box ---- */

/* Why the input cannot be fed by a wire; GRID_DONE: it can. */
static enum grid_refusal feed_refusal(LadderGridView *view, const char *name, size_t len)
{
	struct project *project = ladder_document_project(view->canvas->document);
	struct grid_at at = sheet_at(view);
	const uint32_t pin = names_intern(&project->names, name, len);

	rung_free(grid_add_pin(sheet_rung(view, view->cursor.at.rung), &at, project, pin, NULL));
	return at.refusal;
}

/* Is it a refusal of the input itself? Others are of its place, where there may be room later. */
static bool is_lasting(enum grid_refusal why)
{
	return why == GRID_NO_BOX || why == GRID_BAD_PIN || why == GRID_PIN_TAKEN ||
	       why == GRID_FIRST_PIN;
}

static bool may_feed(LadderGridView *view, const char *name)
{
	return !is_lasting(feed_refusal(view, name, strlen(name)));
}

/* The word at the cursor; a row of pins is a part of the box above it. */
static const struct word_row *word_here(LadderGridView *view)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	int row, col;
	const struct cell *cell = cursor_cell(view, &row, &col);

	while (cell->word == ELEM_PIN && row > 0)
		cell = rung_at(sheet_rung(view, view->cursor.at.rung), --row, col);
	return words_row(&project->words, (enum word)cell->word);
}

static void offer(GtkWidget *popup, const struct word_row *row, int index, const char *name)
{
	struct entry_popup_row one = { (char *)name, "", (char *)said(explain_pin(row, index)),
				       _("input"), (char *)name, false };

	ladder_entry_popup_add(LADDER_ENTRY_POPUP(popup), &one);
}

/* The next input of a function with any number of inputs; NULL: it has a fixed
 * number. */
static const char *further_input(LadderGridView *view, const struct word_row *row, char *name,
				 size_t size)
{
	if (row->kind != WORD_FN)
		return NULL;
	for (int i = word_last_number(row) + 1; ; i++) {
		snprintf(name, size, "IN%d", i);
		if (word_pin_find(row, name, strlen(name)) < 0)
			return NULL;
		if (may_feed(view, name))
			return name;
	}
}

/* Number of inputs that can be fed and begin with @text; @popup, if not NULL, gets them. */
static int offer_inputs(LadderGridView *view, GtkWidget *popup, const char *text, gsize len)
{
	const struct word_row *row = word_here(view);
	char further[LIMIT_NAME + 1];
	int count = 0;

	for (int i = 0; i <= row->pin_count; i++) {
		const char *name = i < row->pin_count ? row->pin[i].name :
				   further_input(view, row, further, sizeof(further));

		if (!name || !name_begins(text, len, name, strlen(name)) || !may_feed(view, name))
			continue;
		count++;
		if (popup)
			offer(popup, row, MIN(i, row->pin_count - 1), name);
	}
	return count;
}

/* The first input that can be fed; NULL: none. */
static const char *free_input(LadderGridView *view, char *further, size_t size)
{
	const struct word_row *row = word_here(view);

	for (int i = 0; i < row->pin_count; i++)
		if (may_feed(view, row->pin[i].name))
			return row->pin[i].name;
	return further_input(view, row, further, size);
}

/* A line `R ResetCount`: an input, and what feeds it. */
struct pin_line {
	const char *name, *feed; /* feed: "": nothing                          */
	gsize len;               /* of the name                                */
};

static struct pin_line read_pin(const char *line)
{
	struct pin_line pin = { .name = line + strspn(line, " ") };

	pin.len = strcspn(pin.name, " :");
	pin.feed = pin.name + pin.len;
	pin.feed += strspn(pin.feed, " ");
	pin.feed += g_str_has_prefix(pin.feed, ":=") ? 2 : 0;
	pin.feed += strspn(pin.feed, " ");
	return pin;
}

/* Is it an input that gets its value as a parameter, not by a wire? */
static bool takes_value(LadderGridView *view, const struct pin_line *pin)
{
	const struct word_row *row = word_here(view);
	const int index = word_pin_find(row, pin->name, pin->len);

	return index >= 0 && index < row->pin_count && row->pin[index].dir == PIN_IN &&
	       feed_refusal(view, pin->name, pin->len) == GRID_BAD_PIN;
}

/* The line of the box with @value at a pin instead of its present one, or more. @from, @to: its
 * bytes. Caller: g_free. */
static char *line_with(LadderGridView *view, const char *pin, gsize len, const char *sign,
		       const char *value, gsize *from, gsize *to)
{
	char *text = line_now(view), *line;
	const char *args = project_text(ladder_document_project(view->canvas->document),
					cursor_cell(view, NULL, NULL)->args);
	struct arg arg;

	if (args_find(args, pin, len, &arg)) {
		*from = strlen(text) - strlen(args) + (gsize)(arg.value - args) - arg.inverse;
		*to = *from + arg.value_len + arg.inverse;
		line = value ? g_strdup_printf("%.*s%s%s", (int)*from, text, value, text + *to) :
			       g_strdup(text);
	} else {
		line = g_strdup_printf("%s%s%.*s%s%s", text, *text ? " " : "", (int)len, pin, sign,
				       value ? value : "");
		*from = *to = strlen(line);
	}
	g_free(text);
	return line;
}

/* The box as it would be changed by `PV 20`; @line gets its line. Caller: both g_free. */
static struct asked *value_at(const struct asked *asked, const struct pin_line *pin, char **line)
{
	struct asked *box = g_memdup2(asked, sizeof(*asked));
	gsize from, to;

	box->word = (enum word)cursor_cell(asked->view, NULL, NULL)->word;
	box->edit = true;
	*line = line_with(asked->view, pin->name, pin->len, ":=", pin->feed, &from, &to);
	return box;
}

static char *value_outcome(const struct asked *asked, const struct pin_line *pin, bool *good)
{
	const struct entry_place place = place_of(asked);
	struct entry *entry = g_new0(struct entry, 1);
	char *line, *whole, *told;
	struct asked *box = value_at(asked, pin, &line);
	size_t skipped;

	whole = whole_line(box, line, &skipped);
	entry_read(&place, whole, entry);
	told = entry_outcome_tell(asked->view->canvas->document, place.pou, entry, line, good);
	canvas_blame(LADDER_CANVAS(asked->view), entry);
	g_free(whole);
	g_free(line);
	g_free(entry);
	g_free(box);
	return told;
}

static bool value_taken(const struct asked *asked, const struct pin_line *pin)
{
	char *line;
	struct asked *box = value_at(asked, pin, &line);
	const bool good = element_taken(box, line);

	g_free(line);
	g_free(box);
	return good;
}

/* For an operand without an input: the line with the input before it. */
static char *refused(LadderGridView *view, const struct pin_line *pin, enum grid_refusal why)
{
	char further[LIMIT_NAME + 1], *typed, *text;
	const char *input = why == GRID_BAD_PIN ?
		free_input(view, further, sizeof(further)) : NULL;

	if (!input)
		return g_strdup(_(grid_refusal_text(why)));
	typed = g_strndup(pin->name, pin->len);
	text = g_strdup_printf(_("“%s” is not a Boolean input of %s; write the input first, such as %s %s"),
			       typed, word_here(view)->word, input, *pin->feed ? pin->feed : typed);
	g_free(typed);
	return text;
}

static char *pin_changed(void *context, const char *line, int cursor, bool *good)
{
	struct asked *asked = context;
	LadderGridView *view = asked->view;
	const struct pin_line pin = read_pin(line);
	enum grid_refusal why;

	if (!cursor_cell(view, NULL, NULL) ||
	    (!*pin.feed && offer_inputs(view, view->canvas->entry, pin.name, pin.len) > 0))
		return NULL;
	if (takes_value(view, &pin))
		return *pin.feed ? value_outcome(asked, &pin, good) : NULL;
	why = feed_refusal(view, pin.name, pin.len);
	if (!is_lasting(why))
		return element_outcome(asked, line, (size_t)(pin.feed - line), cursor, good);
	*good = false;
	return refused(view, &pin, why);
}

static bool pin_taken(void *context, const char *line)
{
	struct asked *asked = context;
	LadderGridView *view = asked->view;
	struct project *project = ladder_document_project(view->canvas->document);
	const struct entry_place place = place_of(asked);
	const struct pin_line pin = read_pin(line);
	struct grid_at at = sheet_at(view);
	struct entry *entry;
	struct cell feed;
	char *told;
	bool good;

	if (*pin.feed && takes_value(view, &pin))
		return value_taken(asked, &pin);
	if (feed_refusal(view, pin.name, pin.len) == GRID_BAD_PIN) {
		told = refused(view, &pin, GRID_BAD_PIN);
		canvas_tell(LADDER_CANVAS(view), told);
		g_free(told);
		return false;
	}
	entry = g_new0(struct entry, 1);
	good = !*pin.feed || (entry_read(&place, pin.feed, entry) &&
			      entry_cell(project, entry, &feed));
	if (good) {
		ladder_document_begin(view->canvas->document, _(verb_row(VERB_add_pin)->label),
				      NULL);
		good = sheet_put(view, grid_add_pin(sheet_rung(view, view->cursor.at.rung), &at,
				 project, names_intern(&project->names, pin.name, pin.len),
				 *pin.feed ? &feed : NULL), &at, "") &&
		       entry_outcome_declare(view->canvas->document, view->canvas->pou, entry);
		ladder_document_end(view->canvas->document);
	}
	g_free(entry);
	return good;
}

static void ask_pin(LadderGridView *view, const char *text)
{
	struct asked *asked = asked_new(view);

	asked->before = true; /* an output cannot feed it */
	open_entry(asked, (struct canvas_question){
		.prompt = _("input and operand, such as R ResetCount"), .text = text,
		.spells = true, .changed = pin_changed, .taken = pin_taken,
	});
	ladder_entry_popup_select(LADDER_ENTRY_POPUP(view->canvas->entry), strlen(text),
				  strlen(text));
}

void entry_begin_pin(LadderGridView *view, const char *pin, gsize len, bool output)
{
	char *line;
	gsize from, to;

	if (canvas_is_fixed(LADDER_CANVAS(view)) || !cursor_cell(view, NULL, NULL))
		return;
	if (!output && !is_lasting(feed_refusal(view, pin, len))) {
		line = g_strdup_printf("%.*s ", (int)len, pin);
		ask_pin(view, line);
	} else {
		line = line_with(view, pin, len, output ? "=>" : ":=", NULL, &from, &to);
		begin_edit(view, line);
		ladder_entry_popup_select(LADDER_ENTRY_POPUP(view->canvas->entry), from, to);
	}
	g_free(line);
}

/* ---- a label, and the jumps to it ---- */

/* The label of the cursor's rung, and how many jumps lead to it. */
static int jumps_here(LadderGridView *view, struct xref_target *label)
{
	const int rung = view->first + view->cursor.at.rung;
	struct xref xref;
	int jumps = 0;

	*label = (struct xref_target){ XREF_LABEL, view->canvas->pou + 1, rung, { 0 } };
	if (!xref_make(&xref, ladder_document_project(view->canvas->document)))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++)
		jumps += xref.use[i].kind == XREF_JUMPED &&
			 xref_same(&xref.use[i].target, label);
	xref_free(&xref);
	return jumps;
}

/* Do jumps lead to the present label, and is @name a new one? */
static bool is_led_to(LadderGridView *view, const char *name, struct xref_target *label,
		      int *jumps)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);

	if (!rung->label || !*name || strcmp(project_text(project, rung->label), name) == 0)
		return false;
	*jumps = jumps_here(view, label);
	return *jumps > 0;
}

/* The text of the program with the new label; NULL: impossible, or no jump leads
 * there. free(). */
static char *label_renamed(LadderGridView *view, const char *name, size_t *len, int *jumps,
		     struct ladder_rename *how)
{
	struct xref_target label;

	*how = (struct ladder_rename){ .why = RENAME_GOOD };
	if (!is_led_to(view, name, &label, jumps))
		return NULL;
	return ladder_rename(ladder_document_ladder(view->canvas->document), &label, name, len, how);
}

/* Why the jumps that lead to the label of the cursor's rung cannot follow it to @name; NULL:
 * they can, or there are none. Caller frees. */
static char *label_refusal(LadderGridView *view, const char *name)
{
	struct ladder_rename how;
	size_t len;
	int jumps;

	free(label_renamed(view, name, &len, &jumps, &how));
	return how.why == RENAME_GOOD ? NULL : rename_reason(view->canvas->document, &how, name);
}

/* Renames the label with the jumps that lead to it, as one step; false: there are none. */
static bool label_set(LadderGridView *view, const char *name)
{
	struct ladder_rename how;
	size_t len, old_len;
	int jumps;
	char *text = label_renamed(view, name, &len, &jumps, &how), *told;
	bool good;

	if (!text)
		return false;
	g_free(ladder_document_outline(view->canvas->document, &old_len, NULL, NULL));
	ladder_document_begin(view->canvas->document, _(verb_row(VERB_rung_label)->label), NULL);
	good = ladder_document_replace(view->canvas->document, 0, old_len, text, NULL);
	ladder_document_end(view->canvas->document);
	told = g_strdup_printf(ngettext("%d jump follows", "%d jumps follow",
					(unsigned long)jumps), jumps);
	if (good)
		canvas_tell(LADDER_CANVAS(view), told);
	g_free(told);
	free(text);
	return good;
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
	struct project *project = ladder_document_project(view->canvas->document);
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

/* The present text. */
static char *text_now(LadderGridView *view, enum verb verb)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);
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

/* Why the line cannot be taken: no file could hold it, or jumps could not follow the
 * label. NULL: it can. Caller frees. */
static char *refusal(const struct asked *asked, const char *line)
{
	const enum verb verb = asked->verb;
	const bool comment = verb == VERB_rung_comment || verb == VERB_comment;

	if (comment && (strstr(line, "(*") || strstr(line, "*)")))
		return g_strdup(_("a comment is one line without (* and *)"));
	if (verb != VERB_rung_label || !line[0])
		return NULL;
	return entry_is_name(line, strlen(line)) ? label_refusal(asked->view, line) :
	       g_strdup(_("this is not a name"));
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
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);
	struct grid_at at = sheet_at(view);
	struct rung *copy;
	int row, col;

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

/* Why the cursor's place has no such text; NULL: it has. */
static const char *nothing_to_ask(LadderGridView *view, enum verb verb)
{
	if (verb != VERB_comment && verb != VERB_add_pin)
		return NULL;
	if (!cursor_cell(view, NULL, NULL))
		return _("there is no element here");
	if (verb == VERB_comment || offer_inputs(view, NULL, "", 0) > 0)
		return NULL;
	return word_here(view)->place == PLACE_BOX ?
		_("The box has no further Boolean input.") :
		_(grid_refusal_text(GRID_NO_BOX));
}

static char *text_changed(void *context, const char *line, int cursor, bool *good)
{
	const struct asked *asked = context;
	char *why = refusal(asked, line);

	(void)cursor;
	*good = !why;
	return why;
}

void entry_begin_text(LadderGridView *view, enum verb verb)
{
	struct asked *asked;
	const char *why;
	char *text;

	if (!sheet_rung(view, view->cursor.at.rung))
		return;
	why = nothing_to_ask(view, verb);
	if (why) {
		canvas_refuse(LADDER_CANVAS(view), _(verb_row(verb)->label), why);
		return;
	}
	if (verb == VERB_add_pin) {
		ask_pin(view, "");
		return;
	}
	asked = asked_new(view);
	asked->verb = verb;
	text = text_now(view, verb);
	open_entry(asked, (struct canvas_question){
		.prompt = _(verb_row(verb)->label), .text = text,
		.changed = text_changed, .taken = text_taken,
	});
	g_free(text);
}

/* ---- the end ---- */

void entry_closed(LadderCanvas *canvas, bool was_open)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);

	view->asks_value = false;
	if (view->preview) {
		g_clear_pointer(&view->preview, rung_free);
		strips_dirty(view, view->cursor.at.rung);
		cursor_fit(view);
	}
	if (was_open)
		strips_redraw(view, view->cursor.at.rung);
}
