/* SPDX-License-Identifier: MIT
 *
 * expect_at - from a place in a text to what is wanted there.
 *
 * It looks at the text before the cursor only: the POU it lies in, the cell or the
 * instruction, and how far that is. What it cannot tell, it takes for a value.
 */
#include "engine/check/expect_inside.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

static struct names *names_of(struct scope *scope)
{
	return &scope_project(scope)->names;
}

static bool is_name_byte(char c)
{
	return ascii_digit(c) || c == '_' || c == '.' || (unsigned char)c >= 128 ||
	       (ascii_upper(c) >= 'A' && ascii_upper(c) <= 'Z');
}

bool expect_is(const struct token *token, const char *text)
{
	return token->len == strlen(text) && ascii_same(token->text, text, token->len);
}

struct expect_want expect_value(uint16_t classes)
{
	struct expect_want want = { .kinds = EXPECT_VARIABLE, .classes = classes,
				    .block = WORD_COUNT };

	if (!classes || classes & CLASS_BOOL)
		want.kinds |= EXPECT_CONSTANT;
	return want;
}

struct expect_want expect_write(uint16_t classes)
{
	return (struct expect_want){ .kinds = EXPECT_VARIABLE, .classes = classes,
				     .write = true, .block = WORD_COUNT };
}

static const struct meaning *meaning_of(const struct before *b, const char *text,
					size_t len)
{
	uint32_t id = names_intern(names_of(b->scope), text, len);
	enum diag_id why;

	return scope_find(b->scope, b->pou, id, &why);
}

/* The block of an instance that a token names; NULL: none. */
static const struct word_row *row_of_instance(const struct before *b,
					      const struct token *token)
{
	const struct meaning *m = meaning_of(b, token->text, token->len);

	return m && m->kind == MEANING_INSTANCE ? scope_row(b->scope, m->word) : NULL;
}

static uint16_t pin_classes(const struct word_row *row, const struct token *pin)
{
	int index = row ? word_pin_find(row, pin->text, pin->len) : -1;

	if (index < 0 || index >= row->pin_count)
		return expect_is(pin, "EN") || expect_is(pin, "ENO") ? CLASS_BOOL : 0;
	return row->pin[index].type != IEC_NONE ?
	       iec_type_row(row->pin[index].type)->class : row->pin[index].classes;
}

/* Parameters from token @at on: a pin, or a value for one. */
static struct expect_want parameter_want(const struct before *b, int at,
					 const struct word_row *row)
{
	const struct token *last = &b->token[b->count - 1];

	if (b->count - at >= 2 && expect_is(last, ":="))
		return expect_value(pin_classes(row, last - 1));
	if (b->count - at >= 2 && expect_is(last, "=>"))
		return expect_write(pin_classes(row, last - 1));
	return (struct expect_want){ .kinds = EXPECT_PIN, .row = row, .call = true,
				     .block = WORD_COUNT };
}

/* ---- an instruction ---- */

static struct expect_want operator_want(const struct before *b, int at, enum op op)
{
	const struct op_row *row = op_row(op);
	bool more = b->count - at > 1;

	if (op == OP_CAL && b->count - at >= 3)
		return parameter_want(b, at + 3,
				      row_of_instance(b, &b->token[at + 1]));
	if (row->operand == OPND_LABEL && !more)
		return (struct expect_want){ .kinds = EXPECT_LABEL,
					     .block = WORD_COUNT };
	if (row->operand == OPND_INSTANCE && !more)
		return (struct expect_want){
			.kinds = EXPECT_INSTANCE | EXPECT_SUBROUTINE,
			.block = WORD_COUNT };
	if (row->operand == OPND_BOOL_W && !more)
		return expect_write(CLASS_BOOL);
	if (row->operand == OPND_ANY_W && !more)
		return expect_write(0);
	if (row->operand == OPND_NONE || (more && !expect_is(&b->token[at + 1], "(")))
		return (struct expect_want){ .block = WORD_COUNT };
	return expect_value(word_operator(word_row(op_function(op))) == op ? ANY_BIT : 0);
}

/* ANDN is AND, JMPCN is JMP. */
static enum op find_op(const struct token *token)
{
	size_t len = token->len;
	enum op op = op_find(token->text, len);

	if (op == OP_COUNT && len > 1 && ascii_upper(token->text[len - 1]) == 'N')
		op = op_find(token->text, --len);
	if (op == OP_COUNT && len > 1 && ascii_upper(token->text[len - 1]) == 'C')
		op = op_find(token->text, --len);
	return op;
}

static bool has_parameters(const struct before *b, int at)
{
	for (int i = at; i < b->count; i++)
		if (expect_is(&b->token[i], ":=") || expect_is(&b->token[i], "=>"))
			return true;
	return false;
}

struct expect_want expect_list(const struct before *b)
{
	struct word_table *words = &scope_project(b->scope)->words;
	const struct word_row *row;
	struct expect_want want = expect_value(0);
	int at = b->count >= 2 && expect_is(&b->token[1], ":") ? 2 : 0;
	enum op op;

	if (b->count == at)
		return (struct expect_want){
			.kinds = EXPECT_OPERATOR | EXPECT_FUNCTION |
				 (at ? 0u : (unsigned)EXPECT_KEYWORD),
			.block = WORD_COUNT };
	op = find_op(&b->token[at]);
	if (op != OP_COUNT && !(op_function(op) != WORD_COUNT &&
				has_parameters(b, at)))
		return operator_want(b, at, op);
	row = words_row(words, words_find(words, b->token[at].text, b->token[at].len));
	if (row->kind != WORD_FN)
		return (struct expect_want){ .block = WORD_COUNT };
	if (b->count - at >= 2 && expect_is(&b->token[at + 1], "(")) {
		struct expect_want pins = parameter_want(b, at + 2, row);

		if (b->count - at == 2 && word_opens(row))
			pins.kinds |= EXPECT_VARIABLE;
		return pins;
	}
	if (row->pin_count > 1)
		want.classes = row->pin[1].classes;
	return want;
}

/* ---- a cell ---- */

static struct expect_want element_want(const struct before *b,
				       const struct word_row *row)
{
	bool more = b->count > 1;
	struct expect_want none = { .block = WORD_COUNT };

	switch (row->operand) {
	case OPND_BOOL_R:
		return more ? none : expect_value(CLASS_BOOL);
	case OPND_BOOL_W:
		return more ? none : expect_write(CLASS_BOOL);
	case OPND_LABEL:
		none.kinds = more ? 0 : EXPECT_LABEL;
		return none;
	case OPND_ROUTINE:
		none.kinds = more ? 0 : EXPECT_SUBROUTINE;
		return none;
	case OPND_LOOP:
		return b->count == 1 ? expect_write(ANY_INT) : expect_value(ANY_INT);
	case OPND_ANY_R:
	case OPND_ANY_W:
	case OPND_INSTANCE:
	case OPND_EXPR:
	case OPND_ASSIGN:
	case OPND_PIN:
	case OPND_LOOP_END:
	case OPND_NONE:
		return none;
	}
	return none;
}

/* Does a value end there, so that an operator must come? */
bool expect_ends_value(const struct token *token)
{
	static const char *const words[] = { "AND", "OR", "XOR", "MOD", "NOT" };

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (expect_is(token, words[i]))
			return false;
	return token->kind != TOKEN_SYMBOL || expect_is(token, ")") ||
	       expect_is(token, "]");
}

/* In brackets: values, and functions that make some. */
static struct expect_want expression_want(const struct before *b)
{
	struct expect_want want = expect_value(0);

	if (b->count > 1 && expect_ends_value(&b->token[b->count - 1]))
		return (struct expect_want){ .block = WORD_COUNT };
	want.kinds |= EXPECT_FUNCTION;
	want.boxes = true;
	return want;
}

struct expect_want expect_cell(const struct before *b)
{
	struct word_table *words = &scope_project(b->scope)->words;
	struct expect_want want = { .block = WORD_COUNT };
	const struct word_row *row;
	enum word word;

	if (b->count == 0) {
		want.kinds = EXPECT_ELEMENT | EXPECT_FUNCTION | EXPECT_BLOCK;
		want.boxes = true;
		return want;
	}
	if (expect_is(&b->token[0], "["))
		return expression_want(b);
	word = words_find(words, b->token[0].text, b->token[0].len);
	row = words_row(words, word);
	if (word == WORD_COUNT)
		return want;
	if (row->kind == WORD_FB && b->count == 1) {
		want.kinds = EXPECT_INSTANCE;
		want.block = word;
		return want;
	}
	if (row->kind == WORD_ELEM)
		return element_want(b, row);
	return parameter_want(b, row->kind == WORD_FB ? 2 : 1, row);
}

/* ---- the text before the cursor ---- */

/* Bytes [*from, to) are what the cursor's instruction, cell or declaration has so
 * far; an instruction may have begun on an earlier line. */
size_t expect_line(const char *text, size_t at)
{
	while (at > 0 && text[at - 1] != '\n')
		at--;
	return at;
}

static size_t last_byte(const char *text, size_t from, size_t to)
{
	while (to > from && (text[to - 1] == ' ' || text[to - 1] == '\t' ||
			     text[to - 1] == '\n' || text[to - 1] == '\r'))
		to--;
	return to;
}

size_t expect_statement(const char *text, size_t line)
{
	for (int lines = 0; line > 0 && lines < 64; lines++) {
		size_t to = last_byte(text, 0, line);

		if (to == 0 || (text[to - 1] != ',' && text[to - 1] != '('))
			break;
		line = expect_line(text, to - 1);
	}
	return line;
}

void expect_tokens(struct before *b, const char *text, size_t from, size_t to)
{
	struct lex lex;

	lex_init(&lex, text + from, to - from);
	while (lex_next(&lex) != TOKEN_END && b->count < TOKENS_MOST)
		b->token[b->count++] = lex.token;
}

/* The last POU that begins at or before the line, unless it has ended. */
static const struct pou *pou_at(const struct project *project, const char *text,
				size_t at, int line)
{
	const struct pou *found = NULL;
	size_t from = at;

	for (int i = 0; i < project->pou_count; i++)
		if (!project->pou[i].included && project->pou[i].line < line &&
		    (!found || project->pou[i].line > found->line))
			found = &project->pou[i];
	while (found && from > 0) { /* an END_… since then? */
		size_t begin = expect_line(text, from - 1), word = begin;

		while (word < at && (text[word] == ' ' || text[word] == '\t'))
			word++;
		if (at - word > 12 && (ascii_same(text + word, "END_PROGRAM", 11) ||
				       ascii_same(text + word, "END_FUNCTION", 12) ||
				       ascii_same(text + word, "END_SUBROUTI", 12)))
			return NULL;
		if (--line <= found->line)
			break;
		from = begin;
	}
	return found;
}

/* In a VAR block: behind its colon a type is wanted. */
static bool in_vars(const char *text, size_t line)
{
	while (line > 0) {
		size_t begin = expect_line(text, line - 1), word = begin;

		while (word < line && (text[word] == ' ' || text[word] == '\t'))
			word++;
		if (line - word >= 7 && ascii_same(text + word, "END_VAR", 7))
			return false;
		if (line - word >= 4 && ascii_same(text + word, "VAR", 3) &&
		    !(is_name_byte(text[word + 3]) && text[word + 3] != '_'))
			return true;
		if (line - word >= 4 && (ascii_same(text + word, "RUNG", 4) ||
					 ascii_same(text + word, "END_", 4) ||
					 ascii_same(text + word, "PROG", 4)))
			return false;
		line = begin;
	}
	return false;
}

static struct expect_want declaration_want(const struct before *b)
{
	struct expect_want want = { .block = WORD_COUNT };

	if (b->count > 0 && expect_is(&b->token[b->count - 1], ":"))
		want.kinds = EXPECT_TYPE | EXPECT_BLOCK;
	return want;
}

static bool is_step(const struct before *b, const char *word, size_t len)
{
	const struct names *names = names_of(b->scope);

	return b->pou && b->pou->sfc &&
	       sfc_find_step(b->pou->sfc, names, names_find(names, word, len)) >= 0;
}

/* `Delay.` - what follows is a part of what stands before the dot. */
static bool part_want(const struct before *b, const char *word, size_t *len,
		      struct expect_want *want, const char **prefix)
{
	const char *dot = NULL;
	const struct meaning *m;
	bool write = want->write;

	for (size_t i = 0; i < *len; i++)
		if (word[i] == '.')
			dot = word + i;
	if (!dot)
		return true;
	m = meaning_of(b, word, (size_t)(dot - word));
	*len -= (size_t)(dot + 1 - word);
	*prefix = dot + 1;
	if (!m && is_step(b, word, (size_t)(dot - word))) {
		*want = (struct expect_want){ .kinds = write ? 0 : EXPECT_STEP_PART,
					      .block = WORD_COUNT };
		return true;
	}
	if (!m || (m->kind != MEANING_INSTANCE && m->kind != MEANING_STRUCT))
		return false;
	*want = (struct expect_want){ .kinds = EXPECT_PIN, .classes = want->classes,
				      .row = scope_row(b->scope, m->word),
				      .block = WORD_COUNT };
	if (write && m->kind == MEANING_INSTANCE)
		want->dirs = 1u << PIN_IN;
	return true;
}

static bool offset_of(const char *text, size_t len, int line, int column, size_t *out)
{
	size_t at = 0, end;

	for (int i = 1; i < line; i++) {
		const char *newline = memchr(text + at, '\n', len - at);

		if (!newline)
			return false;
		at = (size_t)(newline - text) + 1;
	}
	for (end = at; end < len && text[end] != '\n'; end++)
		;
	if (line < 1 || column < 1 || (size_t)column - 1 > end - at)
		return false;
	*out = at + (size_t)column - 1;
	return true;
}

static struct expect_want want_at(struct before *b, const char *text, size_t line,
				  size_t to)
{
	size_t bar = to;

	while (bar > line && text[bar - 1] != '|')
		bar--;
	if (in_vars(text, line)) {
		expect_tokens(b, text, line, to);
		return declaration_want(b);
	}
	if (b->pou && b->pou->language == LANGUAGE_SFC)
		return expect_sfc(b, text, line, bar, to);
	if (b->pou && b->pou->language == LANGUAGE_LD && bar > line) {
		expect_tokens(b, text, bar, to);
		return expect_cell(b);
	}
	if (b->pou && b->pou->language == LANGUAGE_IL) {
		expect_tokens(b, text, expect_statement(text, line), to);
		return expect_list(b);
	}
	expect_tokens(b, text, line, to);
	return (struct expect_want){ .kinds = b->count ? 0 : EXPECT_KEYWORD,
				     .block = WORD_COUNT };
}

static void find_want(struct before *b, const char *text, size_t at, int line,
		      struct expect_place *out)
{
	size_t word = at;

	while (word > 0 && is_name_byte(text[word - 1]))
		word--;
	b->pou = out->pou = pou_at(scope_project(b->scope), text,
				   expect_line(text, at), line);
	out->want = want_at(b, text, expect_line(text, at), word);
	out->prefix = text + word;
	out->prefix_len = at - word;
	if (!part_want(b, text + word, &out->prefix_len, &out->want, &out->prefix))
		out->want.kinds = 0;
}

bool expect_at(struct scope *scope, const char *text, size_t len, int line,
	       int column, struct expect_place *out)
{
	struct before *before;
	size_t at;

	*out = (struct expect_place){ .want = { .block = WORD_COUNT } };
	if (!offset_of(text, len, line, column, &at))
		return false;
	before = calloc(1, sizeof(*before));
	if (!before)
		return false;
	before->scope = scope;
	find_want(before, text, at, line, out);
	out->want.begun = out->prefix;
	out->want.begun_len = out->prefix_len;
	free(before);
	return true;
}
