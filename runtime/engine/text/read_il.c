/* SPDX-License-Identifier: MIT
 *
 * read_il - an instruction list as a user writes it, one instruction a line.
 *
 * It knows operators, modifiers and the two forms of a call. check/ and translate/ follow
 * parentheses and results.
 */
#include "engine/text/reader.h"

#include "engine/base/ascii.h"
#include "engine/model/advice.h"

#include <stdio.h>
#include <string.h>

static bool add_line(struct reader *r, struct il_line line)
{
	if (il_add(r->il, line))
		return true;
	r->no_memory = true;
	return false;
}

static uint16_t column_of(int column)
{
	return column > UINT16_MAX ? 0 : (uint16_t)column;
}

/* ---- operators ---- */

/* ANDN is AND with N, JMPCN is JMP with C and N. */
static enum op find_operator(const struct token *token, uint8_t *modifiers)
{
	enum op op = op_find(token->text, token->len);
	size_t len = token->len;

	*modifiers = 0;
	if (op == OP_COUNT && len > 1 &&
	    ascii_upper(token->text[len - 1]) == 'N') {
		*modifiers |= MOD_N;
		op = op_find(token->text, --len);
	}
	if (op == OP_COUNT && len > 1 &&
	    ascii_upper(token->text[len - 1]) == 'C') {
		*modifiers |= MOD_C;
		op = op_find(token->text, --len);
	}
	return op;
}

/* & and &N, other names of AND and ANDN. */
static enum op read_ampersand(struct reader *r, uint8_t *modifiers)
{
	struct lex ahead = r->lex;

	lex_next(&ahead);
	if (lex_is(&ahead, "N") && !ahead.token.space_before) {
		*modifiers |= MOD_N;
		reader_next(r);
	}
	return OP_AND;
}

/* N alone has no meaning where C may stand: JMPN. */
static bool may_have(enum op op, uint8_t modifiers)
{
	const uint8_t can = op_row(op)->modifiers;

	if (modifiers & ~can)
		return false;
	return !(can & MOD_C) || modifiers != MOD_N;
}

/* ---- calls with parameters ---- */

/* A parameter without a name. */
static bool read_value(struct reader *r, const struct token *word)
{
	struct read_arg arg = { .line = r->lex.token.line,
				.column = r->lex.token.column,
				.value_at = r->text.len };

	if (r->arg_count == LIMIT_ARGS)
		return reader_fail_many(r, DIAG_TOO_MANY, "parameters", LIMIT_ARGS);
	if (!reader_value(r, true, word))
		return false;
	arg.value_len = r->text.len - arg.value_at;
	r->arg[r->arg_count++] = arg;
	return true;
}

static bool is_formal_arg(const struct reader *r)
{
	return r->lex.token.kind == TOKEN_NAME &&
	       (reader_peek(r, ":=") || reader_peek(r, "=>"));
}

/* NOT Q => Lamp, Q => NOT Lamp: a message says what a list writes instead. */
static bool is_negated_output(const struct reader *r, struct token *pin, struct token *value)
{
	struct lex ahead = r->lex;
	const bool first = lex_accept(&ahead, "NOT");

	*pin = ahead.token;
	lex_next(&ahead);
	if (pin->kind != TOKEN_NAME || !lex_accept(&ahead, "=>") ||
	    !(first || lex_accept(&ahead, "NOT")))
		return false;
	*value = ahead.token;
	return value->kind == TOKEN_NAME || value->kind == TOKEN_ADDRESS;
}

static bool fail_negated(struct reader *r, const struct token *pin, const struct token *value)
{
	const int p = pin->len < 40 ? (int)pin->len : 40, v = value->len < 60 ? (int)value->len : 60;
	char text[LIMIT_PARTS];

	snprintf(text, sizeof(text), "NOT %.*s => %.*s" DIAG_AND "%.*s => %.*s" DIAG_AND "%.*s", p, pin->text,
		 v, value->text, p, pin->text, v, value->text, v, value->text);
	return reader_fail_word(r, DIAG_OUTPUT_NEGATED, text);
}

/* Reads parameters. @word: NULL if they have names; else the word whose inputs they are, in
 * order. */
static bool read_args(struct reader *r, const struct token *word)
{
	buffer_clear(&r->text);
	r->arg_count = 0;
	reader_step(r);
	while (!reader_is(r, ')') || (word && r->arg_count)) {
		struct token pin, value;

		if (is_negated_output(r, &pin, &value))
			return fail_negated(r, &pin, &value);
		if (!word && !is_formal_arg(r))
			return reader_fail_token(r, DIAG_MIXED_NAMES);
		if (!(word ? read_value(r, word) : reader_arg(r)))
			return false;
		reader_step(r);
		if (reader_is(r, ')'))
			break;
		if (!reader_is(r, ','))
			return reader_fail_word(r, DIAG_EXPECTED, ", or )");
		reader_step(r);
	}
	return true;
}

static bool add_args(struct reader *r, const struct il_line *call)
{
	if (!add_line(r, *call))
		return false;
	for (int i = 0; i < r->arg_count; i++) {
		const struct read_arg *arg = &r->arg[i];
		const char *text = r->text.text;

		if (!add_line(r, (struct il_line){
				.kind = arg->output ? IL_ARG_OUT : IL_ARG_IN,
				.mark = arg->pin_len ? 0 : IL_IN_ORDER,
				.pin = reader_intern(r, text + arg->pin_at,
						     arg->pin_len),
				.operand = reader_intern(r,
							 text + arg->value_at,
							 arg->value_len),
				.line = (uint32_t)arg->line,
				.col = column_of(arg->column) }))
			return false;
	}
	return true;
}

/* May the pins of a call be those of the project, which keep their spelling? Yes too for an
 * instance that is declared further down. */
static bool has_own_pins(const struct reader *r, const struct il_line *call)
{
	struct project *project = r->project;
	const struct var_table *table = r->pou ? &r->pou->vars : NULL;
	const char *name = names_text(&project->names, call->operand);
	uint32_t fold = names_fold(&project->names, names_intern(&project->names,
						name, strcspn(name, "[")));
	int index;

	if (call->kind != IL_OP)
		return word_is_own((enum word)call->word);
	if (!table || project->words.count == 0)
		return false;
	index = vars_find(table, fold);
	if (index < 0) {
		table = &project->globals;
		index = vars_find(table, fold);
	}
	return index < 0 || word_is_own(table->var[index].fb);
}

/* The cursor stands on `(`. Comments between the parameters move above. @word: as of
 * read_args(). */
static bool read_call(struct reader *r, const struct token *word,
		      const struct il_line *call)
{
	r->across_lines = true;
	r->keep_pins = has_own_pins(r, call);
	bool good = read_args(r, word) && add_args(r, call);

	r->across_lines = false;
	if (good)
		reader_next(r);
	return good;
}

/* ---- instructions ---- */

/* Operands follow their instruction without a gap: comments between them go behind. */
static void put_before_comments(struct il *il)
{
	struct il_line *at = &il->line[il->count - 1];
	const struct il_line line = *at;

	for (; at[-1].kind == IL_COMMENT; at--)
		*at = at[-1];
	*at = line;
}

static bool read_operand(struct reader *r, const struct token *word,
			 struct il_line *line)
{
	buffer_clear(&r->text);
	line->col = column_of(r->lex.token.column);
	if (!reader_value(r, true, word))
		return false;
	line->operand = buffer_take(r, &r->text);
	if (!add_line(r, *line))
		return false;
	if (line->kind == IL_ARG_IN)
		put_before_comments(r->il);
	reader_next(r);
	return true;
}

/* `MAX Low, High`: the second operand and those behind it. */
static bool read_more_operands(struct reader *r, const struct token *word,
			       const struct il_line *fn)
{
	while (reader_is(r, ',')) {
		struct il_line line = { .kind = IL_ARG_IN, .line = fn->line };

		reader_next(r);
		if (!read_operand(r, word, &line))
			return false;
	}
	return true;
}

/* `AND(`, or `AND( A` with the first operand inside. A comment before the operand stands
 * before the line, one behind `AND(` behind it. */
static bool read_open(struct reader *r, const struct token *word,
		      struct il_line line)
{
	struct lex ahead;

	line.modifiers |= MOD_PAREN;
	reader_next(r);
	ahead = r->lex;
	ahead.comments = false;
	lex_next(&ahead);
	if (ahead.token.kind == TOKEN_NEWLINE || ahead.token.kind == TOKEN_END) {
		if (!add_line(r, line))
			return false;
		reader_next(r);
		return true;
	}
	reader_next(r);
	return read_operand(r, word, &line);
}

/* Does `( PIN :=` or `( PIN =>` follow? */
static bool is_formal(const struct reader *r)
{
	struct lex ahead = r->lex;

	ahead.comments = false;
	ahead.newlines = false;
	lex_next(&ahead);
	if (!lex_is(&ahead, "(") || lex_next(&ahead) != TOKEN_NAME)
		return false;
	if (lex_is(&ahead, "NOT"))
		lex_next(&ahead);
	lex_next(&ahead);
	return lex_is(&ahead, ":=") || lex_is(&ahead, "=>");
}

/* Does `()` follow, a call without parameters? */
static bool is_empty(const struct reader *r)
{
	struct lex ahead = r->lex;

	ahead.comments = false;
	ahead.newlines = true;
	lex_next(&ahead);
	return lex_is(&ahead, "(") && lex_next(&ahead) != TOKEN_END &&
	       lex_is(&ahead, ")");
}

static bool read_function(struct reader *r, const struct token *word,
			  struct il_line line)
{
	const struct word_row *row = words_row(&r->project->words, (enum word)line.word);
	bool own = word_is_own((enum word)line.word);

	if (!own && word_opens(row) && reader_peek(r, "(") && !is_formal(r) &&
	    !is_empty(r))
		return read_open(r, word, line);
	reader_next(r);
	if (reader_is(r, '(')) {
		line.kind = IL_CALL;
		return read_call(r, NULL, &line);
	}
	if (reader_at_end(r) && (row->pin_count == 1 || own)) /* SQRT: of the result alone */
		return add_line(r, line);
	if (!read_operand(r, word, &line))
		return false;
	if (row->pin_count > 1 && reader_is(r, ',') && row->most_inputs <= 2 &&
	    reader_mend(r, DIAG_BAD_EXPRESSION)) /* GT 2,5 */
		return false;
	return read_more_operands(r, word, &line);
}

/* What CAL calls: an instance, also one in a structure, or a subroutine. */
static bool read_called(struct reader *r, const struct token *word, uint32_t *id)
{
	if (!memchr(r->lex.token.text, '.', r->lex.token.len))
		return reader_instance(r, id);
	buffer_clear(&r->text);
	if (!reader_value(r, false, word))
		return false;
	*id = buffer_take(r, &r->text);
	return true;
}

static bool read_label_operand(struct reader *r, const struct token *word,
			       struct il_line line)
{
	reader_next(r);
	if (r->lex.token.kind != TOKEN_NAME)
		return reader_fail(r, DIAG_MISSING_OPERAND, word->text,
				   word->len);
	line.col = column_of(r->lex.token.column);
	if (!(line.op == OP_CAL ? read_called(r, word, &line.operand) :
				  reader_name(r, "name", &line.operand)))
		return false;
	if (line.op == OP_CAL && reader_peek(r, "(")) {
		bool formal = is_formal(r) || is_empty(r);

		reader_next(r);
		return read_call(r, formal ? NULL : word, &line);
	}
	if (!add_line(r, line))
		return false;
	reader_next(r);
	return true;
}

/* `LD NOT Door`, `AND /Door`, `ST !Lamp`: N at the operator inverts. */
static bool refuse_negated(struct reader *r, const struct op_row *row, uint8_t modifiers)
{
	const bool inverts = row->modifiers & MOD_N;
	const char *name;
	char text[LIMIT_ARG + 1];
	int len = 0;

	reader_next(r);
	name = r->lex.token.text;
	while (len < 20 && name + len < r->lex.end && !strchr(" \t\r\n", name[len]))
		len++;
	snprintf(text, sizeof(text), "NOT %.*s" DIAG_AND "%s%s%s%.*s", len, name,
		 inverts ? row->word : "", inverts && !(modifiers & MOD_N) ? "N" : "",
		 inverts ? " " : "", inverts ? len : 0, name);
	return reader_fail_word(r, DIAG_NEGATED, text);
}

static bool read_operator(struct reader *r, struct il_line line)
{
	const struct token word = r->lex.token;
	const struct op_row *row = op_row((enum op)line.op);
	const enum word function = op_function((enum op)line.op);

	if (function != WORD_COUNT && !line.modifiers && is_formal(r)) {
		line.kind = IL_CALL;
		line.op = 0;
		line.word = (uint16_t)function;
		reader_next(r);
		return read_call(r, NULL, &line);
	}
	if (!may_have((enum op)line.op, line.modifiers))
		return reader_fail_token(r, DIAG_IL_MODIFIER);
	if ((row->modifiers & MOD_PAREN) && reader_peek(r, "("))
		return read_open(r, &word, line);
	if (row->operand == OPND_LABEL || row->operand == OPND_INSTANCE)
		return read_label_operand(r, &word, line);
	if (row->operand == OPND_NONE && !add_line(r, line))
		return false;
	reader_next(r);
	if (row->operand == OPND_NONE)
		return true;
	if (lex_is(&r->lex, "NOT") || reader_is(r, '/') || reader_is(r, '!'))
		return refuse_negated(r, row, line.modifiers);
	return read_operand(r, &word, &line);
}

/* Neither an operator nor a function: suggests one. */
static bool fail_word(struct reader *r)
{
	char word[LIMIT_ARG], text[LIMIT_ARG];

	snprintf(word, sizeof(word), "%.*s", (int)r->lex.token.len, r->lex.token.text);
	advice_word(r->project, NULL, EXPECT_OPERATOR | EXPECT_FUNCTION, r->diags, word,
		    text, sizeof(text));
	return reader_fail_word(r, DIAG_UNKNOWN_WORD, text);
}

static bool read_instruction(struct reader *r)
{
	const struct token token = r->lex.token;
	struct il_line line = { .line = (uint32_t)token.line,
				.row = column_of(token.column) };
	enum op op;

	if (reader_is(r, ')')) {
		line.kind = IL_CLOSE;
		if (!add_line(r, line))
			return false;
		reader_next(r);
		return true;
	}
	if (token.kind != TOKEN_NAME && !reader_is(r, '&'))
		return reader_fail_token(r, DIAG_SYNTAX);
	op = reader_is(r, '&') ? read_ampersand(r, &line.modifiers) :
				 find_operator(&token, &line.modifiers);
	if (op != OP_COUNT) {
		line.kind = IL_OP;
		line.op = (uint8_t)op;
		return read_operator(r, line);
	}
	const enum word word = words_find(&r->project->words, token.text, token.len);

	if (word == WORD_COUNT ||
	    words_row(&r->project->words, word)->kind != WORD_FN)
		return fail_word(r);
	line.kind = IL_FN;
	line.word = (uint16_t)word;
	line.modifiers = 0;
	return read_function(r, &token, line);
}

static bool read_label(struct reader *r)
{
	struct il_line line = { .kind = IL_LABEL,
				.line = (uint32_t)r->lex.token.line,
				.row = column_of(r->lex.token.column) };

	if (!reader_name(r, "label", &line.operand))
		return false;
	reader_next(r);
	if (!add_line(r, line))
		return false;
	reader_next(r);
	return true;
}

/* Skips a faulty call, whose lines end with a comma. */
static void skip_instruction(struct reader *r)
{
	bool more = true;

	while (more && r->lex.token.kind != TOKEN_END) {
		more = false;
		while (!reader_at_end(r)) {
			more = reader_is(r, ',');
			reader_next(r);
		}
		if (more)
			reader_next(r);
	}
}

static void read_line(struct reader *r)
{
	bool good = true;

	if (r->lex.token.kind == TOKEN_NAME && reader_peek(r, ":"))
		good = read_label(r);
	if (good && !reader_at_end(r))
		good = read_instruction(r);
	if (good)
		reader_end_line(r);
	else
		skip_instruction(r);
}

/* Comments that stood before the first line, or before VAR blocks. */
static void keep_first_comments(struct reader *r)
{
	uint32_t comment = buffer_take(r, &r->above);

	if (comment)
		add_line(r, (struct il_line){ .kind = IL_COMMENT,
					      .operand = comment });
}

void read_il(struct reader *r, struct pou *pou)
{
	r->il = &pou->il;
	keep_first_comments(r);
	r->comments = COMMENT_IL;
	for (;;) {
		reader_skip_newlines(r);
		if (r->lex.token.kind == TOKEN_END || read_ends_block(r) ||
		    r->no_memory)
			break;
		/* A list beyond the budget of a scan cannot run. */
		if (pou->il.count >= LIMIT_BUDGET) {
			reader_fail_many(r, DIAG_TOO_MANY, "instructions", LIMIT_BUDGET);
			r->lex.at = r->lex.end;
			reader_next(r);
			break;
		}
		read_line(r);
		if (r->closed)
			break;
	}
	r->comments = COMMENT_ABOVE;
	r->il = NULL;
}
