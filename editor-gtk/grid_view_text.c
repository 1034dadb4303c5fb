/* SPDX-License-Identifier: MIT
 *
 * grid_view_text - what is asked for of a rung or an element besides its operand: title,
 * label, comments, one more pin.
 *
 * A line that a file could not hold stays open and tells why.
 */
#include "editor-gtk/grid_view_inside.h"

#include "editor-gtk/comment_text.h"
#include "editor-gtk/entry_inside.h"
#include "editor-gtk/entry_popup.h"

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
		return g_strdup(_("a comment holds no (* and no *)"));
	if (verb != VERB_rung_label || !line[0])
		return NULL;
	return entry_is_name(line, strlen(line)) ? label_refusal(asked->view, line) :
	       g_strdup(_("this is no name"));
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

/* May the input have a row of its own? It has none, and is no parameter. */
static bool can_add(LadderGridView *view, const char *name)
{
	struct project *project = ladder_document_project(view->document);
	struct grid_at at = sheet_at(view);
	const uint32_t pin = names_intern(&project->names, name, strlen(name));
	struct rung *made = grid_add_pin(sheet_rung(view, view->cursor.rung), &at, project,
					 pin, NULL);

	rung_free(made);
	return at.refusal != GRID_PIN_TAKEN;
}

/* Boolean inputs of the box that nothing feeds yet. */
static char *pin_changed(void *context, const char *line, int cursor, bool *good)
{
	struct sheet_asked *asked = context;
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
		    g_ascii_strncasecmp(pin->name, line, strlen(line)) == 0 &&
		    can_add(asked->view, pin->name))
			ladder_entry_popup_add(LADDER_ENTRY_POPUP(asked->view->entry),
					       &one);
	}
	return NULL;
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
	char *text;

	if (!sheet_rung(view, view->cursor.rung))
		return;
	if ((verb == VERB_comment || verb == VERB_add_pin) &&
	    !cursor_cell(view, NULL, NULL)) {
		sheet_tell(view, _("there is no element here"));
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
