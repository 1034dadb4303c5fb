/* SPDX-License-Identifier: MIT
 *
 * read_sfc_transition - the transitions of a chart, and conditions that are expressions.
 *
 * An expression becomes a rung of one cell and a coil. Whether the steps are there, and
 * what the condition is made of, is judged in check/.
 */
#include "engine/text/read_sfc.h"

#include <string.h>

#define PRIORITY_MOST 65535

/* ---- FROM and TO ---- */

static bool read_ref(struct sfc_reader *in, int count)
{
	struct reader *r = in->r;
	struct sfc *sfc = in->sfc;
	struct sfc_ref ref = { .step = -1, .line = r->lex.token.line,
			       .column = r->lex.token.column }, *slot;

	if (!reader_name(r, "name of a step", &ref.name))
		return false;
	if (count == LIMIT_BRANCHES)
		return reader_fail_word(r, DIAG_SFC_TOO_MANY, "steps of a transition");
	slot = arena_push(&r->project->arena, &sfc->ref, &sfc->ref_count, sizeof(*slot));
	if (!slot) {
		r->no_memory = true;
		return false;
	}
	*slot = ref;
	reader_step(r);
	return true;
}

static bool read_some(struct sfc_reader *in, int first)
{
	struct reader *r = in->r;

	do {
		reader_step(r);
		if (!read_ref(in, in->sfc->ref_count - first))
			return false;
	} while (reader_is(r, ','));
	if (!reader_is(r, ')'))
		return reader_fail_word(r, DIAG_EXPECTED, ", or )");
	return true;
}

/* One name, or several in parentheses. */
static bool read_refs(struct sfc_reader *in, int *first, int *count)
{
	struct reader *r = in->r;
	bool good;

	*first = in->sfc->ref_count;
	if (reader_is(r, '(')) {
		r->across_lines = true;
		good = read_some(in, *first);
		r->across_lines = false;
		if (good)
			reader_next(r);
	} else {
		good = read_ref(in, 0);
	}
	*count = in->sfc->ref_count - *first;
	return good;
}

/* ---- the first line ---- */

static bool read_part(struct sfc_reader *in, void *out)
{
	struct sfc_transition *transition = out;

	if (!lex_is(&in->r->lex, "PRIORITY"))
		return reader_fail_token(in->r, DIAG_UNKNOWN_WORD);
	return read_number(in, PRIORITY_MOST, &transition->priority);
}

/* IN ORDER one of FROM and TO may be left out. */
static bool may_be_open(const struct sfc_reader *in)
{
	return in->sfc->evolution == EVOLVE_IN_ORDER;
}

static bool read_ways(struct sfc_reader *in, struct sfc_transition *transition)
{
	struct reader *r = in->r;
	const bool source = may_be_open(in) && lex_is(&r->lex, "TO");

	transition->first_from = transition->first_to = in->sfc->ref_count;
	if (!source && (!expect_word(in, "FROM") ||
			!read_refs(in, &transition->first_from,
				   &transition->from_count)))
		return false;
	if (may_be_open(in) && !source && !lex_is(&r->lex, "TO"))
		return true;
	return expect_word(in, "TO") &&
	       read_refs(in, &transition->first_to, &transition->to_count);
}

/* Up to the names behind TO. */
static bool read_head(struct sfc_reader *in, struct sfc_transition *transition)
{
	struct reader *r = in->r;

	if (r->lex.token.kind == TOKEN_NAME && !lex_is(&r->lex, "FROM") &&
	    !(may_be_open(in) && lex_is(&r->lex, "TO"))) {
		if (!reader_name(r, "name of the transition", &transition->name))
			return false;
		reader_next(r);
	}
	if (reader_is(r, '(') && !read_settings(in, read_part, transition))
		return false;
	return read_ways(in, transition);
}

/* ---- := expression; ---- */

/* Read ahead, with a cursor of its own, so that errors have the right column. */
static bool check_expression(struct reader *r)
{
	struct diag place = r->place;
	struct lex lex = r->lex;

	lex.comments = false;
	lex.newlines = false;
	lex_next(&lex);
	place.line = lex.token.line;
	place.column = lex.token.column;
	place.id = DIAG_BAD_EXPRESSION;
	if (!expr_parse_cell(&lex, &r->expr, r->diags, place))
		return false;
	if (lex_is(&lex, ";") && !r->expr.target)
		return true;
	if (!r->expr.target) {
		place.line = lex.token.line;
		place.column = lex.token.column;
	}
	return diag_add(r->diags, place, "%.*s",
			r->expr.target ? 2 : lex.token.len > LIMIT_ARG ? LIMIT_ARG :
					     (int)lex.token.len,
			r->expr.target ? ":=" : lex.token.text);
}

/* Up to the semicolon, on one line, one blank where there were some. */
static uint32_t take_expression(struct reader *r)
{
	const struct token *token = &r->lex.token;
	size_t note = r->above.len;

	buffer_clear(&r->text);
	r->across_lines = true;
	reader_step(r);
	for (int line = token->line; !reader_is(r, ';') &&
	     token->kind != TOKEN_END; line = token->line) {
		buffer_add(r, &r->text, token->text, token->len);
		reader_step(r);
		if (!reader_is(r, ';') && (token->space_before || token->line != line ||
					   note != r->above.len))
			buffer_add(r, &r->text, " ", 1);
		note = r->above.len;
	}
	r->across_lines = false;
	reader_next(r);
	return buffer_take(r, &r->text);
}

/* [ expression ] and a coil. */
static void add_expression(struct sfc_reader *in, struct sfc_body *body, uint32_t text,
			   int line)
{
	struct reader *r = in->r;
	struct pou *pou = in->pou;
	struct rung *rung = r->no_memory ? NULL : rung_new(1, 2);

	if (rung && pou->rung_count >= LIMIT_RUNGS) {
		reader_fail_word(r, DIAG_TOO_MANY, "rungs");
		rung_free(rung);
		return;
	}
	*body = (struct sfc_body){ BODY_EXPRESSION, pou->rung_count, 1 };
	if (rung) {
		rung->line = (uint32_t)line;
		rung->gaps = 1; /* its one row stands in this line */
		rung->cell[0] = (struct cell){ .word = ELEM_COMPARE, .operand = text };
		rung->cell[1] = (struct cell){ .word = ELEM_COIL, .operand =
			reader_intern(r, SFC_CONDITION, strlen(SFC_CONDITION)) };
	}
	if (rung && project_add_rung(pou, pou->rung_count, rung))
		return;
	r->no_memory = true;
	body->count = 0;
	rung_free(rung);
}

static bool read_expression(struct sfc_reader *in, struct sfc_body *body)
{
	struct reader *r = in->r;
	const int line = r->lex.token.line;

	r->place.rung = in->pou->rung_count + 1;
	bool good = check_expression(r);

	if (good)
		add_expression(in, body, take_expression(r), line);
	r->place.rung = 0;
	return good;
}

/* ---- transitions ---- */

static void push(struct sfc_reader *in, struct sfc_transition transition)
{
	struct sfc *sfc = in->sfc;
	struct sfc_transition *slot = push_room(in, &sfc->transition,
		&sfc->transition_count, sizeof(*slot), 2 * LIMIT_STEPS, "transitions");

	if (!slot)
		return;
	*slot = transition;
	add_piece(in, PIECE_TRANSITION, sfc->transition_count - 1);
}

/* What could not be read goes on up to END_TRANSITION, or the next piece. */
static void skip_rest(struct sfc_reader *in)
{
	struct reader *r = in->r;

	r->across_lines = false;
	for (;;) {
		while (!reader_at_end(r) && !lex_is(&r->lex, "END_TRANSITION"))
			reader_next(r);
		reader_skip_newlines(r);
		if (lex_is(&r->lex, "END_TRANSITION")) {
			reader_next(r);
			return;
		}
		if (is_end(in))
			return;
	}
}

void read_transition(struct sfc_reader *in)
{
	struct reader *r = in->r;
	const struct token head = r->lex.token;
	struct sfc_transition transition = { .macro = in->macro, .line = head.line,
					     .column = head.column };

	reader_next(r);
	bool good = read_head(in, &transition);

	if (good && lex_is(&r->lex, ":=")) {
		good = read_expression(in, &transition.condition);
		transition.comment = buffer_take(r, &r->above);
		reader_skip_newlines(r);
	} else if (good && reader_is(r, ':')) {
		reader_next(r);
		transition.comment = buffer_take(r, &r->above);
		read_body(in, &transition.condition);
	} else if (good) {
		good = reader_fail_word(r, DIAG_EXPECTED, ": or :=");
	}
	if (good) {
		transition.tail = buffer_take(r, &r->above);
		close_head(in, "END_TRANSITION", &head);
	} else {
		skip_rest(in);
	}
	push(in, transition);
}
