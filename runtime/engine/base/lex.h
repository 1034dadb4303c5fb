/* SPDX-License-Identifier: MIT
 *
 * lex - one scanner for every text of the engine.
 *
 * Rung files, IL, expressions, I/O maps, scripts and scenarios are read with it. It has
 * no keywords and allocates nothing. Any bytes give tokens; invalid ones are TOKEN_BAD.
 * The text needs no NUL.
 */
#ifndef BASE_LEX_H
#define BASE_LEX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum token_kind {
	TOKEN_END,        /* end of the text                                   */
	TOKEN_NEWLINE,    /* only when lex->newlines                           */
	TOKEN_NAME,       /* letters, digits, _, UTF-8; not a digit first.
			     Dots inside belong to it: Runout.Q               */
	TOKEN_NUMBER,     /* any literal but a string: 12, 16#FF, T#1s, 1.5E3,
			     also a time such as 10ms, 2.5s                   */
	TOKEN_ADDRESS,    /* %IX0.3                                           */
	TOKEN_STRING,     /* "…" with $" $$ $N $L $R $T inside                */
	TOKEN_COMMENT,    /* (* … *) nested or // …; only when lex->comments,
			     else skipped                                     */
	TOKEN_SYMBOL,     /* := => <= >= <> ** or one character               */
	TOKEN_BAD,        /* control or invalid UTF-8 byte, another character
			     beyond ASCII that is no letter, open string or
			     comment; goes on behind it                       */
};

struct token {
	enum token_kind kind;
	const char *text;  /* borrowed from the source                         */
	size_t len;        /* bytes; string and comment with their delimiters  */
	int line, column;  /* 1-based; column in bytes                         */
	bool space_before; /* blanks or a comment stand before it              */
};

struct lex {
	const char *at, *end, *line_start;
	int line;
	bool newlines, comments; /* set after lex_init if they are wanted      */
	bool wide;               /* the same: "…" is a TOKEN_NUMBER, as '…' is */
	struct token token;      /* the current token                          */
};

/** lex_init - before the first token of @len bytes; skips a UTF-8 BOM. */
void lex_init(struct lex *lex, const char *text, size_t len);
/** lex_next - steps to the next token and returns its kind. Any text ends after finitely
 * many steps. */
enum token_kind lex_next(struct lex *lex);
/** lex_is - whether the token is this word (any case) or symbol. */
bool lex_is(const struct lex *lex, const char *word);
/** lex_accept - steps over the token if lex_is; returns lex_is. */
bool lex_accept(struct lex *lex, const char *word);
/** lex_skip_line - steps to the first token of the next line. */
void lex_skip_line(struct lex *lex);

/** utf8_length - bytes of the first character, 1 to 4; 0 when @text is empty or
 * does not begin with a valid one. Scan-safe: yes. So are both below. */
size_t utf8_length(const char *text, size_t len);
/** utf8_valid - whether all @len bytes are valid UTF-8 without NUL. @bad (may be NULL)
 * gets the offset of the first bad byte. */
bool utf8_valid(const char *text, size_t len, size_t *bad);
/** utf8_code - the code point of a valid character of @len bytes, 1 to 4. */
uint32_t utf8_code(const char *text, size_t len);
/** utf8_is_letter - may this valid character beyond ASCII stand in a name? */
bool utf8_is_letter(const char *text, size_t len);
/** utf16_text - does @text begin as UTF-16 does: with its mark, or every other byte 0? */
bool utf16_text(const char *text, size_t len);
/** utf8_width - columns a terminal needs: 2 for East Asian wide, 0 for
 * combining, 1 else, also for a byte that is not valid. */
int utf8_width(const char *text, size_t len);
#endif
