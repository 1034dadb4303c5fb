/* SPDX-License-Identifier: MIT
 *
 * write_st - a body of Structured Text in its canonical form: two blanks a block, one blank
 * around an operator, words of the language in upper case, one statement a line.
 *
 * Comments, empty lines and line ends inside a statement stay.
 */
#include "engine/text/text.h"
#include "engine/text/writer.h"

#include "engine/base/ascii.h"
#include "engine/model/st.h"

static bool is_one_of(const struct token *token, const char *signs)
{
	if (token->kind != TOKEN_SYMBOL || token->len != 1)
		return false;
	while (*signs && *signs != token->text[0])
		signs++;
	return *signs != '\0';
}

struct st_style {
	const struct sink *sink;
	enum st_kind kind;
	bool begun;          /* a word was written                            */
	struct token last;   /* written last; kind TOKEN_END: none            */
	bool operand;        /* that was an operand, or ) or ]                */
	bool sign;           /* that was a sign before an operand             */
	enum { LATCH_BEFORE, LATCH_NOW, LATCH_WRITTEN, LATCH_DONE } latch; /* S or R of S= and R= */
};

static bool is_one_word(const struct token *token, const char *word)
{
	return token->kind == TOKEN_NAME && lex_is(&(struct lex){ .token = *token }, word);
}

static const char *word_among(const struct lex *lex, const char *const *words)
{
	while (*words && !lex_is(lex, *words))
		words++;
	return *words;
}

/* The word of the language that the token is; NULL: none. `By` and `Mod` may be names, too: such words
 * stand behind an operand, names do not. */
static const char *word_of(const struct st_style *style, const struct lex *lex)
{
	static const char *const between[] = { "AND", "AND_THEN", "OR", "OR_ELSE", "XOR", "MOD", NULL };
	static const char *const of_for[] = { "TO", "BY", NULL };
	static const char *const of_jump[] = { "IF", NULL };
	static const char *const before[] = { "NOT", "TRUE", "FALSE", NULL };
	const char *first = st_form(style->kind)->word, *word = NULL;

	if (lex->token.kind != TOKEN_NAME)
		return NULL;
	if (!style->begun && *first)
		return lex_is(lex, first) ? first : NULL;
	if (style->latch == LATCH_NOW)
		return style->kind == ST_SET ? "S" : "R";
	if ((style->kind == ST_RETURN_IF || style->kind == ST_STOP_IF) && is_one_word(&style->last, first))
		return word_among(lex, of_jump);
	if (!style->operand)
		return word_among(lex, before);
	word = style->kind == ST_JUMP_IF ? word_among(lex, of_jump) : NULL;
	if (!word)
		word = word_among(lex, between);
	return !word && style->kind == ST_FOR ? word_among(lex, of_for) : word;
}

static bool wants_blank(const struct st_style *style, const struct lex *lex)
{
	const struct token *token = &lex->token, *last = &style->last;

	if (last->kind == TOKEN_END || style->sign || is_one_of(last, "([.") ||
	    is_one_of(token, ")],;.^:"))
		return is_one_of(token, ".") && style->operand && !is_one_of(last, "].");
	if (is_one_of(token, "["))
		return false;
	if (is_one_of(token, "("))
		return !style->operand || is_one_of(last, ")");
	return true;
}

static void write_token(struct st_style *style, const struct lex *lex)
{
	const struct token *token = &lex->token;

	if (style->latch == LATCH_BEFORE && (style->kind == ST_SET || style->kind == ST_RESET) && style->operand &&
	    token->kind == TOKEN_NAME)
		style->latch = LATCH_NOW;
	const char *word = word_of(style, lex);
	const bool sign = is_one_of(token, "+-") && !style->operand;

	if (wants_blank(style, lex) && !is_one_of(token, ".") && style->latch != LATCH_WRITTEN)
		sink_text(style->sink, " ");
	if (word)
		sink_text(style->sink, word);
	else
		sink_write(style->sink, token->text, token->len);
	style->sign = sign;
	style->operand = (token->kind != TOKEN_SYMBOL && !word) || is_one_of(token, ")]^") ||
			 lex_is(lex, "TRUE") || lex_is(lex, "FALSE");
	style->last = *token;
	style->begun = true;
	if (style->latch == LATCH_NOW || style->latch == LATCH_WRITTEN)
		style->latch++;
}

static void write_indent(const struct sink *sink, int blanks)
{
	while (blanks-- > 0)
		sink_text(sink, " ");
}

static void write_statement(const struct sink *sink, enum st_kind kind, const char *text, size_t len,
			    int blanks)
{
	struct st_style style = { .sink = sink, .kind = kind };
	struct lex lex;

	lex_init(&lex, text, len);
	lex.newlines = lex.comments = lex.wide = true;
	while (lex_next(&lex) != TOKEN_END) {
		if (lex.token.kind == TOKEN_COMMENT) {
			sink_text(sink, style.last.kind == TOKEN_END ? "" : " ");
			sink_write(sink, lex.token.text, lex.token.len);
		} else if (lex.token.kind == TOKEN_NEWLINE) {
			sink_text(sink, "\n");
			write_indent(sink, blanks + 4);
			style.last.kind = TOKEN_END;
			style.sign = false;
		} else {
			write_token(&style, &lex);
		}
	}
}

void write_item(const struct sink *sink, const struct project *project, const struct st_item *item)
{
	if (item->kind == ST_COMMENT)
		write_id(sink, project, item->text);
	else
		write_statement(sink, (enum st_kind)item->kind, names_text(&project->names, item->text),
				names_len(&project->names, item->text), 2);
}

static void write_end(const struct sink *sink, enum st_kind kind)
{
	const char *end = st_form(kind)->end;

	sink_text(sink, ascii_upper(end[0]) >= 'A' ? " " : "");
	sink_text(sink, end);
	sink_text(sink, kind == ST_UNTIL ? ";" : "");
}

void text_write_st(const struct project *project, const struct st *st, const struct sink *sink)
{
	const struct names *names = &project->names;

	for (int i = 0; i < st->count; i++) {
		const struct st_item *item = &st->item[i];
		const char *text = names_text(names, item->text);
		const size_t len = names_len(names, item->text);
		const int blanks = 2 + 2 * item->depth;

		if (item->kind == ST_COMMENT && item->behind) {
			sink_text(sink, "  ");
			sink_write(sink, text, len);
		} else {
			sink_text(sink, i > 0 ? "\n" : "");
			sink_text(sink, item->gap ? "\n" : "");
			write_indent(sink, blanks);
			if (item->kind == ST_COMMENT)
				sink_write(sink, text, len);
			else
				write_statement(sink, (enum st_kind)item->kind, text, len, blanks);
			write_end(sink, (enum st_kind)item->kind);
		}
	}
	if (st->count > 0)
		sink_text(sink, "\n");
}

uint32_t text_statements(struct project *project, struct st_item *item, int count)
{
	const struct st st = { .item = item, .count = count };
	struct sink_memory memory;
	uint32_t id = 0;

	if (count == 0)
		return 0;
	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	text_write_st(project, &st, &sink);
	if (!memory.failed)
		id = names_intern(&project->names, memory.text, memory.len);
	sink_memory_free(&memory);
	return id;
}
