/* SPDX-License-Identifier: MIT
 *
 * grid_view_text - what is asked for of a rung or an element besides its operand: title,
 * label, comments, one more pin.
 *
 * A line that a file could not hold stays open and tells why.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/edit/entry_names.h"
#include "editor-gtk/kit/entry_popup.h"

#include "engine/base/explain.h"

#include <string.h>

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
static char *refusal(const struct sheet_asked *asked, const char *line)
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

static bool is_refused(const struct sheet_asked *asked, const char *line)
{
	char *why = refusal(asked, line);
	const bool is = why != NULL;

	g_free(why);
	return is;
}

static bool is_as_before(const struct sheet_asked *asked, const char *line)
{
	char *before = text_now(asked->view, asked->verb);
	const bool same = strcmp(before, line) == 0;

	g_free(before);
	return same;
}

static bool text_taken(void *context, const char *line)
{
	struct sheet_asked *asked = context;
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

/* Is it a Boolean input that nothing feeds? That there is no room is told when it is taken. */
static bool may_feed(LadderGridView *view, const char *name)
{
	struct project *project = ladder_document_project(view->document);
	struct grid_at at = sheet_at(view);
	const uint32_t pin = names_intern(&project->names, name, strlen(name));

	rung_free(grid_add_pin(sheet_rung(view, view->cursor.rung), &at, project, pin, NULL));
	return at.refusal != GRID_NO_BOX && at.refusal != GRID_BAD_PIN &&
	       at.refusal != GRID_PIN_TAKEN && at.refusal != GRID_FIRST_PIN;
}

/* The word at the cursor; a row of pins is a part of the box above it. */
static const struct word_row *word_here(LadderGridView *view)
{
	const struct project *project = ladder_document_project(view->document);
	int row, col;
	const struct cell *cell = cursor_cell(view, &row, &col);

	while (cell->word == ELEM_PIN && row > 0)
		cell = rung_at(sheet_rung(view, view->cursor.rung), --row, col);
	return words_row(&project->words, (enum word)cell->word);
}

static void offer(GtkWidget *popup, const struct word_row *row, int index, const char *name)
{
	struct entry_popup_row one = { (char *)name, "", (char *)said(explain_pin(row, index)),
				       _("input"), (char *)name };

	ladder_entry_popup_add(LADDER_ENTRY_POPUP(popup), &one);
}

/* The next input of a function that takes as many as one likes; NULL: of none. */
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

/* How many inputs can be fed; @popup, if not NULL, offers those that begin as @line. */
static int offer_inputs(LadderGridView *view, GtkWidget *popup, const char *line)
{
	const struct word_row *row = word_here(view);
	char further[LIMIT_NAME + 1];
	int count = 0;

	for (int i = 0; i <= row->pin_count; i++) {
		const char *name = i < row->pin_count ? row->pin[i].name :
				   further_input(view, row, further, sizeof(further));

		if (!name || !may_feed(view, name))
			continue;
		count++;
		if (popup && g_ascii_strncasecmp(name, line, strlen(line)) == 0)
			offer(popup, row, MIN(i, row->pin_count - 1), name);
	}
	return count;
}

static char *pin_changed(void *context, const char *line, int cursor, bool *good)
{
	struct sheet_asked *asked = context;

	(void)cursor;
	*good = true;
	if (cursor_cell(asked->view, NULL, NULL))
		offer_inputs(asked->view, asked->view->entry, line);
	return NULL;
}

/* Why nothing is asked for at the cursor; NULL: it can be. */
static const char *nothing_to_ask(LadderGridView *view, enum verb verb)
{
	if (verb != VERB_comment && verb != VERB_add_pin)
		return NULL;
	if (!cursor_cell(view, NULL, NULL))
		return _("there is no element here");
	if (verb == VERB_comment || offer_inputs(view, NULL, "") > 0)
		return NULL;
	return word_here(view)->place == PLACE_BOX ?
		_("nothing is left to be fed: the box has no further Boolean input") :
		_(grid_refusal_text(GRID_NO_BOX));
}

static char *text_changed(void *context, const char *line, int cursor, bool *good)
{
	const struct sheet_asked *asked = context;
	char *why = refusal(asked, line);

	(void)cursor;
	*good = !why;
	return why;
}

void entry_begin_text(LadderGridView *view, enum verb verb)
{
	struct entry_popup_calls calls = { .changed = text_changed, .taken = text_taken,
					   .gone = entry_line_gone, .left = entry_line_left };
	struct sheet_asked *asked;
	const char *why;
	char *text;

	if (!sheet_rung(view, view->cursor.rung))
		return;
	why = nothing_to_ask(view, verb);
	if (why) {
		sheet_tell(view, why);
		return;
	}
	asked = entry_ask(view);
	asked->verb = verb;
	calls.context = asked;
	text = verb == VERB_add_pin ? g_strdup("") : text_now(view, verb);
	if (verb == VERB_add_pin)
		calls.changed = pin_changed;
	entry_open(asked, _(verb_row(verb)->label), text, false, &calls);
	g_free(text);
}
