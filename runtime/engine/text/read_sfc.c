/* SPDX-License-Identifier: MIT
 *
 * read_sfc - a sequential function chart: steps, transitions, actions, CONTROL.
 *
 * It reads form only; check/ finds whether a chart makes sense.
 */
#include "engine/base/literal.h"
#include "engine/text/reader.h"

#include <string.h>

struct sfc_reader {
	struct reader *r;
	struct pou *pou;
	struct sfc *sfc;
	int macro, depth;     /* the macro-step in work; -1: none              */
	bool controlled;      /* a CONTROL was read                            */
};

/* ---- parts of pieces ---- */

static bool is_end(const struct sfc_reader *in)
{
	const struct reader *r = in->r;

	return r->lex.token.kind == TOKEN_END || r->no_memory ||
	       (read_ends_block(r) && !lex_is(&r->lex, "RUNG") && !reader_is_vars(r));
}

/* Reports a line that does not belong here and skips it; of a rung its rows, too. */
static void skip_odd(struct sfc_reader *in)
{
	struct reader *r = in->r;

	reader_skip_odd_line(r);
	reader_skip_newlines(r);
	while (reader_is(r, '|')) {
		reader_skip_line(r);
		reader_skip_newlines(r);
	}
}

/* Steps over a symbol or word; over : and ; to the end of the line at most, because comments below
 * belong to what follows. Fails: false and a diagnostic. */
static bool expect_word(struct sfc_reader *in, const char *symbol)
{
	if (!lex_is(&in->r->lex, symbol))
		return reader_fail_word(in->r, DIAG_EXPECTED, symbol);
	if (strcmp(symbol, ":") == 0 || strcmp(symbol, ";") == 0)
		reader_next(in->r);
	else
		reader_step(in->r);
	return true;
}

/* `(WORD := value, …)`; @one reads one setting, from its word to the end of its value. Fails:
 * false and a diagnostic. */
static bool read_settings(struct sfc_reader *in,
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
	r->across_lines = r->plain;
	if (good && !reader_is(r, ')'))
		good = reader_fail_word(r, DIAG_EXPECTED, ", or )");
	if (good)
		reader_step(r);
	return good;
}

/* A value, for @word; with @constant perhaps a constant. Steps behind
 * it. Fails: false and a diagnostic, also if @id has one already. */
static bool read_value(struct sfc_reader *in, bool constant, const struct token *word,
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

/* The same behind `WORD :=`. */
static bool read_setting(struct sfc_reader *in, bool constant, uint32_t *id)
{
	const struct token word = in->r->lex.token;

	if (*id)
		return reader_fail_token(in->r, DIAG_DUPLICATE_ARG);
	reader_step(in->r);
	return expect_word(in, ":=") && read_value(in, constant, &word, id);
}

/* `WORD := number`, from 1 to @most. */
static bool read_number(struct sfc_reader *in, int most, int *out)
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

/* Skips the rest of a piece that could not be read, its END_… too. */
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

/* Steps over END_…, which must stand here; @head: what it ends. */
static void close_head(struct sfc_reader *in, const char *end, const struct token *head)
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

/* Room for one more in a vector of the chart. NULL after a diagnostic: the vector is full or
 * memory is out. */
static void *push_room(struct sfc_reader *in, void *vector, int *count, size_t size, int most,
		       const char *what)
{
	struct reader *r = in->r;
	void *slot;

	if (*count >= most) {
		reader_fail_many(r, DIAG_SFC_TOO_MANY, what, most);
		return NULL;
	}
	slot = arena_push(&r->project->arena, vector, count, size);
	if (!slot)
		r->no_memory = true;
	return slot;
}

static void add_piece(struct sfc_reader *in, enum piece_kind kind, int index)
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

/* Is the word a name in a statement? A pin or a variable may be called Step. */
static bool is_operand(struct lex lex)
{
	static const char *const signs[] = {
		":=", "=>", ",", ")", "]", ".", "[", ";", "+", "-", "*", "/", "<", ">", "=", "<=", ">=", "<>",
	};

	lex_next(&lex);
	for (size_t i = 0; i < sizeof(signs) / sizeof(*signs); i++)
		if (lex_is(&lex, signs[i]))
			return true;
	return false;
}

/* Do statements of Structured Text follow the colon at @lex? */
static bool is_st(struct lex lex)
{
	struct lex end;

	lex.newlines = lex.comments = false;
	lex_next(&lex);
	end = lex;
	while (end.token.kind != TOKEN_END && (!reader_is_sfc_word(&end) || is_operand(end)) &&
	       !lex_is(&end, "END_PROGRAM"))
		lex_next(&end);
	if (lex_is(&lex, "RUNG") || lex.token.text == end.token.text)
		return false;
	lex.end = end.token.text;
	return st_begins(lex);
}

/* Statements, from behind the colon on. */
static void read_text(struct sfc_reader *in, struct sfc_body *body)
{
	struct pou *pou = in->pou;
	const int first = pou->st ? pou->st->count : 0;

	read_st_behind(in->r, pou);
	*body = (struct sfc_body){ BODY_ST, first, pou->st ? pou->st->count - first : 0 };
}

/* Rungs or a list, up to a word that ends them. */
static void read_body(struct sfc_reader *in, struct sfc_body *body)
{
	struct reader *r = in->r;
	struct pou *pou = in->pou;

	r->across_lines = false;
	reader_skip_newlines(r);
	if (lex_is(&r->lex, "RUNG")) {
		read_rungs(in, body);
	} else if (!is_end(in)) {
		*body = (struct sfc_body){ BODY_LIST, pou->il.count, 0 };
		read_il(r, pou);
		body->count = pou->il.count - body->first;
	}
	r->across_lines = r->plain;
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
	reader_step(r);
	action.line = r->lex.token.line;
	action.column = r->lex.token.column;
	bool good = reader_name(r, "name of the action", &action.name);

	if (good)
		reader_step(r);
	good = good && (reader_is(r, ':') || reader_fail_word(r, DIAG_EXPECTED, ":"));
	if (good && is_st(r->lex)) {
		action.comment = buffer_take(r, &r->above);
		read_text(in, &action.body);
	} else {
		if (good)
			reader_next(r);
		action.comment = buffer_take(r, &r->above);
		if (!good) {
			reader_skip_line(r);
			reader_skip_newlines(r);
		}
		read_body(in, &action.body);
	}
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
	reader_step(r);
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
	const struct sfc_word *word = reader_chart_word(&r->lex);

	return word && word->kind == SFC_WORD_STEP;
}

/* Reports a limit of the chart and skips to the end of the POU. */
static void skip_sfc(struct sfc_reader *in)
{
	struct reader *r = in->r;

	while (!is_end(in) || reader_is_sfc_word(&r->lex)) {
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

/* A name with a parenthesis, even if the name is Step or Set. */
static bool is_call(const struct reader *r)
{
	return r->lex.token.kind == TOKEN_NAME && reader_peek(r, "(") &&
	       !lex_is(&r->lex, "TRANSITION");
}

/* ---- lines ---- */

static void add_use(struct sfc_reader *in, struct sfc_use use)
{
	struct sfc *sfc = in->sfc;
	struct sfc_step *step = &sfc->step[sfc->step_count - 1];
	struct sfc_use *slot;

	use.step = sfc->step_count - 1;
	if (step->use_count == LIMIT_STEP_USES) /* reported once */
		reader_fail_many(in->r, DIAG_SFC_TOO_MANY, "lines of a step", LIMIT_STEP_USES);
	step->use_count++;
	if (step->use_count > LIMIT_STEP_USES)
		return;
	slot = arena_push(&in->r->project->arena, &sfc->use, &sfc->use_count,
			  sizeof(*slot));
	if (slot)
		*slot = use;
	else
		in->r->no_memory = true;
}

/* SET a, b; with the cursor after SET. The comments go to the first line. */
static bool read_bits(struct sfc_reader *in, struct sfc_use use, const struct token *word)
{
	struct reader *r = in->r;
	const int first = in->sfc->use_count;

	r->across_lines = true;
	for (;;) {
		use.line = r->lex.token.line;
		use.column = r->lex.token.column;
		if (!read_value(in, false, word, &use.operand))
			return false;
		add_use(in, use);
		use.more = 1;
		if (!reader_is(r, ','))
			break;
		reader_step(r);
	}
	r->across_lines = r->plain;
	if (!expect_word(in, ";"))
		return false;
	if (in->sfc->use_count > first)
		in->sfc->use[first].comment = buffer_take(r, &r->above);
	return true;
}

static bool read_qualifier(struct sfc_reader *in, void *out)
{
	struct sfc_use *use = out;
	struct reader *r = in->r;
	const struct token *token = &r->lex.token;
	const struct token word = *token;

	if (use->qualifier == QUALIFIER_COUNT) {
		use->qualifier = qualifier_find(token->text, token->len);
		if (use->qualifier == QUALIFIER_COUNT)
			return reader_fail_token(r, DIAG_UNKNOWN_WORD);
		reader_step(r);
		return true;
	}
	if (use->time)
		return reader_fail_token(r, DIAG_SYNTAX);
	return read_value(in, true, &word, &use->time);
}

/* Name(Qualifier, time); */
static bool read_call(struct sfc_reader *in, struct sfc_use use)
{
	struct reader *r = in->r;
	const struct token word = r->lex.token;

	use.qualifier = QUALIFIER_COUNT;
	if (!read_value(in, false, &word, &use.operand))
		return false;
	if (!reader_is(r, '('))
		return reader_fail_word(r, DIAG_EXPECTED, "(");
	if (!read_settings(in, read_qualifier, &use) || !expect_word(in, ";"))
		return false;
	if (use.qualifier == QUALIFIER_COUNT)
		use.qualifier = QUALIFIER_N;
	use.comment = buffer_take(r, &r->above);
	add_use(in, use);
	return true;
}

static bool read_use(struct sfc_reader *in)
{
	struct reader *r = in->r;
	const struct token word = r->lex.token;
	struct sfc_use use = { .line = word.line, .column = word.column, .action = -1 };
	bool set = lex_is(&r->lex, "SET");

	if (is_call(r) || (!set && !lex_is(&r->lex, "RESET")))
		return read_call(in, use);
	use.kind = set ? USE_SET : USE_RESET;
	reader_step(r);
	return read_bits(in, use, &word);
}

/* Skips a line that could not be read. */
static void skip_use(struct sfc_reader *in)
{
	struct reader *r = in->r;

	r->across_lines = r->plain;
	while (!reader_at_end(r) && !reader_is(r, ';') && !lex_is(&r->lex, "END_STEP"))
		reader_next(r);
	if (reader_is(r, ';'))
		reader_next(r);
}

static void read_uses(struct sfc_reader *in)
{
	struct reader *r = in->r;

	for (;;) {
		reader_skip_newlines(r);
		if (r->no_memory || (is_end(in) && !is_call(r)))
			return;
		if ((r->lex.token.kind != TOKEN_NAME &&
		     r->lex.token.kind != TOKEN_ADDRESS) ||
		    (read_ends_block(r) && !is_call(r)))
			skip_odd(in);
		else if (!read_use(in))
			skip_use(in);
	}
}

#define COLUMN_MOST 9999

/* ---- steps ---- */

static bool read_step_part(struct sfc_reader *in, void *out)
{
	struct sfc_step *step = out;
	const struct lex *lex = &in->r->lex;

	if (lex_is(lex, "MIN"))
		return read_setting(in, true, &step->min);
	if (lex_is(lex, "MAX"))
		return read_setting(in, true, &step->max);
	if (lex_is(lex, "ALARM"))
		return read_setting(in, false, &step->alarm);
	if (lex_is(lex, "COLUMN"))
		return read_number(in, COLUMN_MOST, &step->column);
	return reader_fail_token(in->r, DIAG_UNKNOWN_WORD);
}

/* From the name to the colon. */
static bool read_step_head(struct sfc_reader *in, struct sfc_step *step)
{
	struct reader *r = in->r;

	step->line = r->lex.token.line;
	step->column_at = r->lex.token.column;
	if (!reader_name(r, "name of the step", &step->name))
		return false;
	reader_step(r);
	if (reader_is(r, '(') && !read_settings(in, read_step_part, step))
		return false;
	return expect_word(in, ":");
}

static void enter_macro(struct sfc_reader *in)
{
	in->macro = in->sfc->step_count - 1;
	in->depth++;
	if (in->depth == LIMIT_MACROS + 1)
		reader_fail_word(in->r, DIAG_TOO_DEEP, "MACRO_STEP");
}

static bool push_step(struct sfc_reader *in, struct sfc_step step)
{
	struct sfc *sfc = in->sfc;
	struct sfc_step *slot = push_room(in, &sfc->step, &sfc->step_count,
					  sizeof(*slot), LIMIT_STEPS, "steps");

	if (!slot)
		return false;
	step.macro = in->macro;
	step.end = -1;
	step.first_use = sfc->use_count;
	*slot = step;
	add_piece(in, PIECE_STEP, sfc->step_count - 1);
	return true;
}

/* STEP, INITIAL_STEP or MACRO_STEP with its lines; the contents of a macro-step are read by
 * the caller. */
static void read_step(struct sfc_reader *in)
{
	struct reader *r = in->r;
	struct sfc *sfc = in->sfc;
	const struct token head = r->lex.token;
	struct sfc_step step = {
		.kind = lex_is(&r->lex, "STEP") ? STEP_PLAIN :
			lex_is(&r->lex, "MACRO_STEP") ? STEP_MACRO : STEP_INITIAL };

	reader_step(r);
	bool good = read_step_head(in, &step);

	if (!good)
		reader_skip_line(r);
	step.comment = buffer_take(r, &r->above);
	if (!push_step(in, step))
		return;
	read_uses(in);
	if (sfc->step[sfc->step_count - 1].use_count > LIMIT_STEP_USES)
		sfc->step[sfc->step_count - 1].use_count = LIMIT_STEP_USES;
	if (step.kind == STEP_MACRO) {
		enter_macro(in);
		return;
	}
	sfc->step[sfc->step_count - 1].tail = buffer_take(r, &r->above);
	close_head(in, "END_STEP", &head);
}

/* END_STEP of the macro-step in work. */
static void read_step_end(struct sfc_reader *in)
{
	struct reader *r = in->r;
	struct sfc *sfc = in->sfc;
	struct sfc_step *step = &sfc->step[in->macro];

	step->tail = buffer_take(r, &r->above);
	step->end = sfc->piece_count;
	add_piece(in, PIECE_MACRO_END, in->macro);
	in->macro = step->macro;
	in->depth--;
	reader_next(r);
}

#define PRIORITY_MOST 65535

/* ---- the first line ---- */

static bool read_transition_part(struct sfc_reader *in, void *out)
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
		return reader_fail_many(r, DIAG_SFC_TOO_MANY, "steps of a transition", LIMIT_BRANCHES);
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
		r->across_lines = r->plain;
		if (good)
			reader_step(r);
	} else {
		good = read_ref(in, 0);
	}
	*count = in->sfc->ref_count - *first;
	return good;
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
static bool read_transition_head(struct sfc_reader *in, struct sfc_transition *transition)
{
	struct reader *r = in->r;

	if (r->lex.token.kind == TOKEN_NAME && !lex_is(&r->lex, "FROM") &&
	    !(may_be_open(in) && lex_is(&r->lex, "TO"))) {
		if (!reader_name(r, "name of the transition", &transition->name))
			return false;
		reader_step(r);
	}
	if (reader_is(r, '(') && !read_settings(in, read_transition_part, transition))
		return false;
	return read_ways(in, transition);
}

/* ---- := expression; ---- */

/* Does the expression end with the line of the cursor, and @lex stand behind it? */
static bool is_next(const struct reader *r, const struct lex *lex)
{
	const char *end = memchr(r->lex.token.text, '\n',
				 (size_t)(lex->token.text - r->lex.token.text));

	while (end && (*end == ' ' || *end == '\t' || *end == '\r' || *end == '\n'))
		end++;
	return !end || end == lex->token.text;
}

/* Reads ahead with a cursor of its own, so that errors have the right column. */
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
		return reader_mend_last(r);
	if (expr_has_wrong_call(&r->expr, &r->project->words) && reader_mend(r, DIAG_BAD_LITERAL))
		return false;
	if (lex_is(&lex, ";") && !r->expr.target)
		return true;
	if (!r->expr.target) {
		if (is_next(r, &lex) && reader_mend(r, DIAG_BAD_EXPRESSION))
			return false;
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
	r->across_lines = r->plain;
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
		reader_fail_many(r, DIAG_TOO_MANY, "rungs", LIMIT_RUNGS);
		rung_free(rung);
		return;
	}
	*body = (struct sfc_body){ BODY_EXPRESSION, pou->rung_count, 1 };
	if (rung) {
		rung->line = (uint32_t)line;
		rung->gaps = 1; /* its one row is this line */
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

/* After an error: skips to END_TRANSITION, or to the next piece. */
static void skip_rest(struct sfc_reader *in)
{
	struct reader *r = in->r;

	r->across_lines = r->plain;
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

/* From TRANSITION to END_TRANSITION. */
static void read_transition(struct sfc_reader *in)
{
	struct reader *r = in->r;
	const struct token head = r->lex.token;
	struct sfc_transition transition = { .macro = in->macro, .line = head.line,
					     .column = head.column };

	reader_step(r);
	bool good = read_transition_head(in, &transition);

	if (good && lex_is(&r->lex, ":=")) {
		good = read_expression(in, &transition.condition);
		transition.comment = buffer_take(r, &r->above);
		reader_skip_newlines(r);
	} else if (good && reader_is(r, ':') && is_st(r->lex)) {
		good = reader_fail_word(r, DIAG_SFC_STATEMENTS, "");
		while (!lex_is(&r->lex, "END_TRANSITION") && !lex_is(&r->lex, "END_PROGRAM") &&
		       r->lex.token.kind != TOKEN_END)
			reader_next(r);
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
	else if (is_end(in) && !reader_is_sfc_word(&r->lex))
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
		r->across_lines = r->plain;
		reader_skip_newlines(r);
		errors = r->diags->errors;
	} while (read_piece(&in) && (errors == r->diags->errors || !is_full(sfc)));
	if (is_full(sfc) && errors != r->diags->errors)
		skip_sfc(&in);
	close_macros(&in);
	r->across_lines = false;
	if (r->no_memory || !sfc_link(sfc, &project->names) ||
	    !sfc_declare(sfc, &project->names, &pou->vars, &project->arena, pou->kind == POU_BLOCK))
		r->no_memory = true;
}
