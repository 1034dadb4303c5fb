/* SPDX-License-Identifier: MIT
 *
 * read_sfc - a sequential function chart: its pieces, actions, CONTROL, and what they
 * are made of.
 *
 * Steps are read in read_sfc_step.c, transitions in read_sfc_transition.c. What a chart
 * means and whether it makes sense is found in check/.
 */
#include "engine/text/read_sfc.h"

#include "engine/base/literal.h"

#include <string.h>

bool reader_is_sfc_word(const struct reader *r)
{
	static const char *const words[] = {
		"STEP", "INITIAL_STEP", "MACRO_STEP", "END_STEP", "TRANSITION",
		"END_TRANSITION", "ACTION", "END_ACTION", "CONTROL",
	};

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (lex_is(&r->lex, words[i]))
			return true;
	return false;
}

/* ---- parts of pieces ---- */

bool is_end(const struct sfc_reader *in)
{
	const struct reader *r = in->r;

	return r->lex.token.kind == TOKEN_END || r->no_memory ||
	       (read_ends_block(r) && !lex_is(&r->lex, "RUNG") && !reader_is_vars(r));
}

void skip_odd(struct sfc_reader *in)
{
	struct reader *r = in->r;

	reader_skip_odd_line(r);
	reader_skip_newlines(r);
	while (reader_is(r, '|')) {
		reader_skip_line(r);
		reader_skip_newlines(r);
	}
}

bool expect_word(struct sfc_reader *in, const char *symbol)
{
	if (!lex_is(&in->r->lex, symbol))
		return reader_fail_word(in->r, DIAG_EXPECTED, symbol);
	reader_step(in->r);
	return true;
}

bool read_settings(struct sfc_reader *in,
		   bool (*one)(struct sfc_reader *in, void *out), void *out)
{
	struct reader *r = in->r;
	bool good = true, more;

	r->across_lines = true;
	reader_step(r);
	more = !reader_is(r, ')');
	while (good && more) {
		good = one(in, out);
		more = good && reader_is(r, ',');
		if (more)
			reader_step(r);
	}
	r->across_lines = false;
	if (good && !reader_is(r, ')'))
		good = reader_fail_word(r, DIAG_EXPECTED, ", or )");
	if (good)
		reader_next(r);
	return good;
}

bool read_value(struct sfc_reader *in, bool constant, const struct token *word,
		uint32_t *id)
{
	struct reader *r = in->r;

	buffer_clear(&r->text);
	if (!reader_value(r, constant, word))
		return false;
	*id = buffer_take(r, &r->text);
	reader_step(r);
	return true;
}

bool read_setting(struct sfc_reader *in, bool constant, uint32_t *id)
{
	const struct token word = in->r->lex.token;

	if (*id)
		return reader_fail_token(in->r, DIAG_DUPLICATE_ARG);
	reader_step(in->r);
	return expect_word(in, ":=") && read_value(in, constant, &word, id);
}

bool read_number(struct sfc_reader *in, int most, int *out)
{
	struct reader *r = in->r;
	const struct token *token = &r->lex.token;
	struct literal literal;

	if (*out)
		return reader_fail_token(r, DIAG_DUPLICATE_ARG);
	reader_step(r);
	if (!expect_word(in, ":="))
		return false;
	if (token->kind != TOKEN_NUMBER ||
	    literal_parse(token->text, token->len, &literal) != LITERAL_OK ||
	    literal.type != IEC_NONE || literal.real)
		return reader_fail_word(r, DIAG_EXPECTED, "number");
	if (literal.high || literal.value.i < 1 || literal.value.i > most)
		return reader_fail_token(r, DIAG_LITERAL_RANGE);
	*out = (int)literal.value.i;
	reader_step(r);
	return true;
}

/* What is left of an piece that could not be read, its END_… too. */
static void skip_piece(struct sfc_reader *in, const char *end)
{
	struct reader *r = in->r;

	for (;;) {
		reader_skip_newlines(r);
		if (lex_is(&r->lex, end)) {
			reader_next(r);
			return;
		}
		if (is_end(in))
			return;
		reader_skip_line(r);
	}
}

void close_head(struct sfc_reader *in, const char *end, const struct token *head)
{
	struct reader *r = in->r;

	if (lex_is(&r->lex, end)) {
		reader_next(r);
	} else if (r->lex.token.kind == TOKEN_END) {
		reader_fail_open(r, head);
	} else {
		reader_fail_word(r, DIAG_EXPECTED, end);
		skip_piece(in, end);
	}
}

void *push_room(struct sfc_reader *in, void *vector, int *count, size_t size, int most,
		const char *what)
{
	struct reader *r = in->r;
	void *slot;

	if (*count >= most) {
		reader_fail_word(r, DIAG_SFC_TOO_MANY, what);
		return NULL;
	}
	slot = arena_push(&r->project->arena, vector, count, size);
	if (!slot)
		r->no_memory = true;
	return slot;
}

void add_piece(struct sfc_reader *in, enum piece_kind kind, int index)
{
	struct sfc *sfc = in->sfc;
	struct sfc_piece *piece = arena_push(&in->r->project->arena, &sfc->piece,
					   &sfc->piece_count, sizeof(*piece));

	if (piece)
		*piece = (struct sfc_piece){ kind, index };
	else
		in->r->no_memory = true;
}

/* ---- bodies ---- */

static void read_rungs(struct sfc_reader *in, struct sfc_body *body)
{
	struct reader *r = in->r;
	struct pou *pou = in->pou;

	*body = (struct sfc_body){ BODY_RUNGS, pou->rung_count, 0 };
	while (!is_end(in)) {
		if (lex_is(&r->lex, "RUNG")) {
			r->place.rung = pou->rung_count + 1;
			reader_add_rung(r, pou);
			r->place.rung = 0;
		} else {
			skip_odd(in);
		}
		reader_skip_newlines(r);
	}
	body->count = pou->rung_count - body->first;
}

void read_body(struct sfc_reader *in, struct sfc_body *body)
{
	struct reader *r = in->r;
	struct pou *pou = in->pou;

	reader_skip_newlines(r);
	if (lex_is(&r->lex, "RUNG")) {
		read_rungs(in, body);
	} else if (!is_end(in)) {
		*body = (struct sfc_body){ BODY_LIST, pou->il.count, 0 };
		read_il(r, pou);
		body->count = pou->il.count - body->first;
	}
}

/* ---- pieces ---- */

static void read_action(struct sfc_reader *in)
{
	struct reader *r = in->r;
	const struct token head = r->lex.token;
	struct sfc_action action = { 0 }, *slot;
	struct sfc *sfc = in->sfc;

	if (in->macro >= 0)
		reader_fail_token(r, DIAG_MISPLACED);
	reader_next(r);
	action.line = r->lex.token.line;
	action.column = r->lex.token.column;
	bool good = reader_name(r, "name of the action", &action.name);

	if (good) {
		reader_next(r);
		good = expect_word(in, ":");
	}
	action.comment = buffer_take(r, &r->above);
	if (!good) {
		reader_skip_line(r);
		reader_skip_newlines(r);
	}
	read_body(in, &action.body);
	action.tail = buffer_take(r, &r->above);
	close_head(in, "END_ACTION", &head);
	slot = push_room(in, &sfc->action, &sfc->action_count, sizeof(*slot),
			 LIMIT_STEPS, "actions");
	if (!slot)
		return;
	*slot = action;
	add_piece(in, PIECE_ACTION, sfc->action_count - 1);
}

static bool read_control_part(struct sfc_reader *in, void *out)
{
	const struct token *token = &in->r->lex.token;
	enum control control = control_find(token->text, token->len);
	uint32_t *operand = out;

	if (control == CONTROL_COUNT)
		return reader_fail_token(in->r, DIAG_UNKNOWN_WORD);
	return read_setting(in, false, &operand[control]);
}

static void read_control(struct sfc_reader *in)
{
	struct reader *r = in->r;
	struct sfc *sfc = in->sfc;
	const int line = r->lex.token.line;
	uint32_t control[CONTROL_COUNT] = { 0 };
	bool second = in->controlled;

	if (second)
		reader_fail_word(r, DIAG_SFC_TWICE, "CONTROL");
	else if (in->macro >= 0)
		reader_fail_token(r, DIAG_MISPLACED);
	in->controlled = true;
	reader_next(r);
	bool good = reader_is(r, '(') ?
		    read_settings(in, read_control_part, control) :
		    reader_fail_word(r, DIAG_EXPECTED, "(");

	if (!good || !expect_word(in, ";"))
		reader_skip_line(r);
	if (second)
		return;
	memcpy(sfc->control, control, sizeof(control));
	sfc->control_line = line;
	sfc->control_comment = buffer_take(r, &r->above);
	add_piece(in, PIECE_CONTROL, 0);
}

static void read_block(struct sfc_reader *in)
{
	if (in->sfc->piece_count)
		reader_fail_token(in->r, DIAG_MISPLACED);
	read_vars(in->r, &in->pou->vars, false);
}

static bool is_step(const struct reader *r)
{
	return lex_is(&r->lex, "STEP") || lex_is(&r->lex, "INITIAL_STEP") ||
	       lex_is(&r->lex, "MACRO_STEP");
}

/* Too much of something: what follows is not read any more, up to the end of the POU. */
static void skip_sfc(struct sfc_reader *in)
{
	struct reader *r = in->r;

	while (!is_end(in) || reader_is_sfc_word(r)) {
		if (r->no_memory)
			return;
		reader_skip_line(r);
		reader_skip_newlines(r);
	}
	in->macro = -1;
}

static bool is_full(const struct sfc *sfc)
{
	return sfc->step_count >= LIMIT_STEPS ||
	       sfc->transition_count >= 2 * LIMIT_STEPS ||
	       sfc->action_count >= LIMIT_STEPS;
}

static bool read_piece(struct sfc_reader *in)
{
	struct reader *r = in->r;

	if (is_step(r))
		read_step(in);
	else if (lex_is(&r->lex, "TRANSITION"))
		read_transition(in);
	else if (lex_is(&r->lex, "ACTION"))
		read_action(in);
	else if (lex_is(&r->lex, "CONTROL"))
		read_control(in);
	else if (lex_is(&r->lex, "END_STEP") && in->macro >= 0)
		read_step_end(in);
	else if (reader_is_vars(r))
		read_block(in);
	else if (is_end(in) && !reader_is_sfc_word(r))
		return false;
	else
		skip_odd(in);
	return true;
}

static void close_macros(struct sfc_reader *in)
{
	const struct sfc_step *step = in->macro < 0 ? NULL :
				      &in->sfc->step[in->macro];
	const char *name = step ? project_text(in->r->project, step->name) : "";
	const struct token head = { .text = name, .len = strlen(name),
				    .line = step ? step->line : 0,
				    .column = step ? step->column_at : 0 };

	if (step)
		reader_fail_open(in->r, &head);
}

void read_sfc(struct reader *r, struct pou *pou)
{
	struct sfc_reader in = { .r = r, .pou = pou, .sfc = pou->sfc, .macro = -1 };
	struct project *project = r->project;
	struct sfc *sfc = pou->sfc;
	int errors;

	do {
		reader_skip_newlines(r);
		errors = r->diags->errors;
	} while (read_piece(&in) && (errors == r->diags->errors || !is_full(sfc)));
	if (is_full(sfc) && errors != r->diags->errors)
		skip_sfc(&in);
	close_macros(&in);
	if (r->no_memory || !sfc_link(sfc, &project->names) ||
	    !sfc_declare(sfc, &project->names, &pou->vars, &project->arena))
		r->no_memory = true;
}
