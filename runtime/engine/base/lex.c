/* SPDX-License-Identifier: MIT
 *
 * lex - one scanner for every text of the engine.
 *
 * One pass, a table by byte, no memory. Any bytes give tokens; the caller refuses wrong
 * ones.
 */
#include "engine/base/lex.h"
#include "engine/base/ascii.h"

#include <string.h>

enum byte_class {
	IS_BAD, IS_BLANK, IS_NEWLINE, IS_LETTER, IS_DIGIT, IS_HIGH, IS_SYMBOL,
};

#define B IS_BAD
#define S IS_SYMBOL
#define L IS_LETTER
#define D IS_DIGIT
#define H IS_HIGH
#define EIGHT(x) x, x, x, x, x, x, x, x
static const unsigned char class_of[256] = {
	B, B, B, B, B, B, B, B, B, IS_BLANK, IS_NEWLINE, B, B, IS_BLANK, B, B,
	EIGHT(B), EIGHT(B),
	IS_BLANK, S, S, S, S, S, S, S, S, S, S, S, S, S, S, S,
	D, D, D, D, D, D, D, D, D, D, S, S, S, S, S, S,
	S, L, L, L, L, L, L, L, EIGHT(L),
	EIGHT(L), L, L, L, S, S, S, S, L,
	S, L, L, L, L, L, L, L, EIGHT(L),
	EIGHT(L), L, L, L, S, S, S, S, B,
	EIGHT(H), EIGHT(H), EIGHT(H), EIGHT(H), EIGHT(H), EIGHT(H), EIGHT(H),
	EIGHT(H), EIGHT(H), EIGHT(H), EIGHT(H), EIGHT(H), EIGHT(H), EIGHT(H),
	EIGHT(H), EIGHT(H),
};
#undef B
#undef S
#undef L
#undef D
#undef H
#undef EIGHT

static enum byte_class class_at(const char *at)
{
	return (enum byte_class)class_of[(unsigned char)*at];
}

void lex_init(struct lex *lex, const char *text, size_t len)
{
	*lex = (struct lex){ .at = text, .end = text + len,
			     .line_start = text, .line = 1 };
	if (len >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
		lex->at = lex->line_start = text + 3;
	lex->token.text = lex->at;
	lex->token.line = lex->token.column = 1;
}

/* Bytes of the character beyond ASCII at @at that may stand in a name, else 0. */
static size_t high_length(const char *at, const char *end)
{
	size_t len = utf8_length(at, (size_t)(end - at));

	return len && utf8_is_letter(at, len) ? len : 0;
}

/* Skips letters, digits and _ at @at. */
static const char *skip_alnum(const char *at, const char *end)
{
	while (at != end &&
	       (class_at(at) == IS_LETTER || class_at(at) == IS_DIGIT))
		at++;
	return at;
}

static bool is_digit_at(const char *at, const char *end)
{
	return at < end && ascii_digit(*at);
}

/* Skips a name with its dots. */
static const char *skip_name(const char *at, const char *end)
{
	for (;;) {
		size_t high;

		at = skip_alnum(at, end);
		if (at == end)
			return at;
		high = class_at(at) == IS_HIGH ? high_length(at, end) : 0;
		at += high;
		if (high)
			continue;
		if (*at != '.' || end - at < 2)
			return at;
		switch (class_at(at + 1)) {
		case IS_HIGH:
			if (!high_length(at + 1, end))
				return at;
			at++;
			break;
		case IS_LETTER:
		case IS_DIGIT:
			at++;
			break;
		case IS_BAD:
		case IS_BLANK:
		case IS_NEWLINE:
		case IS_SYMBOL:
			return at;
		}
	}
}

/* The end behind the closing quote; NULL: the line ends first. */
static const char *skip_string(const char *at, const char *end)
{
	const char quote = *at;

	for (at++; at != end && *at != '\n'; at++) {
		if (*at == quote)
			return at + 1;
		if (*at == '$' && end - at >= 2 && at[1] != '\n')
			at++;
	}
	return NULL;
}

/* Whether constants of the type before the # contain - and :. */
static bool is_dated(const char *type, size_t len)
{
	static const char *const word[] = {
		"D", "DATE", "DT", "DATE_AND_TIME", "TOD", "TIME_OF_DAY", "LD",
		"LDATE", "LDT", "LDATE_AND_TIME", "LTOD", "LTIME_OF_DAY",
	};

	for (size_t i = 0; i < sizeof(word) / sizeof(*word); i++)
		if (ascii_is(word[i], type, len))
			return true;
	return false;
}

/* The end of a date or a time of day: 2026-11-21-08:30:00.5 */
static const char *skip_date(const char *at, const char *end)
{
	for (;;) {
		at = skip_alnum(at, end);
		if (at == end || (*at != '-' && *at != ':' && *at != '.') ||
		    !is_digit_at(at + 1, end))
			return at;
		at++;
	}
}

/* Whether the decimal number from @start to @at ends with E, so that a sign may follow. */
static bool ends_with_exponent(const char *start, const char *at)
{
	if (at - start < 2 || ascii_upper(at[-1]) != 'E')
		return false;
	for (at--; start != at; start++)
		if (!ascii_digit(*start) && *start != '.' && *start != '_')
			return false;
	return true;
}

static const char *line_end(const char *at, const char *end)
{
	const char *newline = memchr(at, '\n', (size_t)(end - at));

	if (!newline)
		return end;
	return newline != at && newline[-1] == '\r' ? newline - 1 : newline;
}

/* The end of a quoted constant. Its quote twice is one of its letters. An open one reaches to the
 * end of the line and is invalid. */
static const char *skip_quoted(const char *at, const char *end)
{
	const char *close = at;

	do
		close = skip_string(close, end);
	while (close && close != end && *close == *at);
	return close ? close : line_end(at, end);
}

/* The end of the number that begins at @start; @at is inside it. A sign and digits may
 * follow each #: INT#16#7F, T#-5ms. */
static const char *skip_number(const char *start, const char *at,
			       const char *end)
{
	bool based = false;

	for (;;) {
		at = skip_alnum(at, end);
		if (at == end)
			return at;
		if (*at == '.' && is_digit_at(at + 1, end)) {
			at++;
		} else if (*at == '#') {
			bool dated = is_dated(start, (size_t)(at - start));

			based = ascii_digit(*start);
			at++;
			if (dated)
				return skip_date(at, end);
			if (at != end && (*at == '\'' || *at == '"'))
				return skip_quoted(at, end);
			if (end - at >= 2 && (*at == '-' || *at == '+') &&
			    ascii_digit(at[1]))
				at++;
			start = at;
		} else if ((*at == '+' || *at == '-') && !based &&
			   is_digit_at(at + 1, end) &&
			   ends_with_exponent(start, at)) {
			at++;
		} else {
			return at;
		}
	}
}

/* The end of a nested comment; NULL: the text ends first. Counts lines. */
static const char *skip_comment(struct lex *lex, const char *at)
{
	const char *end = lex->end, open = *at, close = open == '(' ? ')' : open;
	unsigned int depth = 0;

	while (end - at >= 2) {
		if (at[0] == open && at[1] == '*') {
			depth++;
			at += 2;
		} else if (at[0] == '*' && at[1] == close) {
			at += 2;
			if (--depth == 0)
				return at;
		} else {
			if (*at == '\n') {
				lex->line++;
				lex->line_start = at + 1;
			}
			at++;
		}
	}
	if (at != end && *at == '\n') {
		lex->line++;
		lex->line_start = end;
	}
	return NULL;
}

static size_t symbol_length(const char *at, const char *end)
{
	static const char pairs[][3] = { ":=", "=>", "<=", ">=", "<>", "**", "?=" };

	if (end - at >= 2 && (at[1] == '=' || at[1] == '>' || at[1] == '*'))
		for (size_t i = 0; i < sizeof(pairs) / sizeof(*pairs); i++)
			if (at[0] == pairs[i][0] && at[1] == pairs[i][1])
				return 2;
	return 1;
}

/* Comments, strings, addresses and symbols; returns the kind and moves lex->at. */
static enum token_kind scan_symbol(struct lex *lex)
{
	const char *at = lex->at, *end = lex->end, *close;
	size_t left = (size_t)(end - at);

	if (left >= 2 && (at[0] == '(' || at[0] == '/') && at[1] == '*') {
		/* OpenPLC Editor 4 adds lines of C to a program, each one comment, whatever it contains. */
		close = left > 6 && memcmp(at + 2, "DBG:", 4) == 0 ? line_end(at, end) : skip_comment(lex, at);
		lex->at = close ? close : end;
		return close ? TOKEN_COMMENT : TOKEN_BAD;
	}
	if (left >= 2 && at[0] == '/' && at[1] == '/') {
		lex->at = line_end(at, end);
		return TOKEN_COMMENT;
	}
	if (*at == '"' && !lex->wide) {
		close = skip_string(at, end);
		lex->at = close ? close : line_end(at, end);
		return close ? TOKEN_STRING : TOKEN_BAD;
	}
	if (*at == '\'' || *at == '"') {
		lex->at = skip_quoted(at, end);
		return TOKEN_NUMBER;
	}
	if (*at == '%' && left >= 2 && class_at(at + 1) == IS_LETTER) {
		at = skip_alnum(at + 1, end);
		/* %QX0.1, and %TM0.V of ClassicLadder. */
		while (end - at > 1 && *at == '.' && (is_digit_at(at + 1, end) ||
						      class_at(at + 1) == IS_LETTER))
			at = skip_alnum(at + 1, end);
		lex->at = at;
		return TOKEN_ADDRESS;
	}
	lex->at = at + symbol_length(at, end);
	return TOKEN_SYMBOL;
}

/* A name, or a number with its type before it: T#1s. */
static enum token_kind scan_name(struct lex *lex)
{
	const char *start = lex->at;
	const char *at = skip_name(start, lex->end);

	if (at != lex->end && *at == '#' && at != start) {
		lex->at = skip_number(start, at, lex->end);
		return TOKEN_NUMBER;
	}
	lex->at = at;
	return TOKEN_NAME;
}

static enum token_kind scan(struct lex *lex)
{
	const char *at = lex->at;
	size_t high;

	switch (class_at(at)) {
	case IS_LETTER:
		return scan_name(lex);
	case IS_HIGH:
		if (high_length(at, lex->end))
			return scan_name(lex);
		break;
	case IS_DIGIT:
		lex->at = skip_number(at, at, lex->end);
		return TOKEN_NUMBER;
	case IS_SYMBOL:
		return scan_symbol(lex);
	case IS_NEWLINE:
		lex->at++;
		lex->line++;
		lex->line_start = lex->at;
		return TOKEN_NEWLINE;
	case IS_BLANK:
	case IS_BAD:
		break;
	}
	high = utf8_length(at, (size_t)(lex->end - at));
	lex->at += high ? high : 1;
	return TOKEN_BAD;
}

enum token_kind lex_next(struct lex *lex)
{
	struct token *token = &lex->token;
	bool space = false;

	for (;;) {
		const char *at = lex->at;

		while (at < lex->end && class_at(at) == IS_BLANK)
			at++;
		space |= at != lex->at;
		lex->at = at;
		token->text = at;
		token->line = lex->line;
		token->column = (int)(at - lex->line_start) + 1;
		if (at >= lex->end) { /* @end may have been set to before the present place */
			token->kind = TOKEN_END;
			break;
		}
		token->kind = scan(lex);
		if (!(token->kind == TOKEN_NEWLINE && !lex->newlines) &&
		    !(token->kind == TOKEN_COMMENT && !lex->comments))
			break;
		space = true;
	}
	token->len = (size_t)(lex->at - token->text);
	token->space_before = space;
	return token->kind;
}

bool lex_is(const struct lex *lex, const char *word)
{
	const struct token *token = &lex->token;

	if (token->len == 0 || ascii_upper(token->text[0]) !=
			       ascii_upper(word[0]))
		return false;
	switch (token->kind) {
	case TOKEN_NAME:
	case TOKEN_NUMBER:
	case TOKEN_ADDRESS:
	case TOKEN_SYMBOL:
		return ascii_is(word, token->text, token->len);
	case TOKEN_END:
	case TOKEN_NEWLINE:
	case TOKEN_STRING:
	case TOKEN_COMMENT:
	case TOKEN_BAD:
		break;
	}
	return false;
}

bool lex_accept(struct lex *lex, const char *word)
{
	if (!lex_is(lex, word))
		return false;
	lex_next(lex);
	return true;
}

void lex_skip_line(struct lex *lex)
{
	const char *newline;

	if (lex->token.kind != TOKEN_NEWLINE) {
		newline = memchr(lex->at, '\n', (size_t)(lex->end - lex->at));
		lex->at = newline ? newline + 1 : lex->end;
		if (newline) {
			lex->line++;
			lex->line_start = lex->at;
		}
	}
	lex_next(lex);
}
