/* SPDX-License-Identifier: MIT
 *
 * iomap_text - finds the words of an I/O map. What an edit makes of them is
 * iomap_edit.c's.
 */
#include "editor-gtk/document/iomap_text.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

struct word {
	const char *text;
	size_t len;
	int line;
};

static bool at_line_end(const struct lex *lex)
{
	const enum token_kind kind = lex->token.kind;

	return kind == TOKEN_END || kind == TOKEN_NEWLINE || lex_is(lex, "#");
}

/* Tokens without a blank between them, as hal/iomap.c has them. Comments in between are
 * stepped over; one that goes to the end of the line is kept in @row, if there is one. */
static void skip_comments(struct lex *lex, const char *text, struct io_row *row)
{
	while (lex->token.kind == TOKEN_COMMENT) {
		if (row && lex->token.text[0] == '/')
			row->comment = (struct io_span){
				(size_t)(lex->token.text - text), lex->token.len };
		lex_next(lex);
	}
}

static bool next_word(struct lex *lex, const char *text, struct io_row *row,
		      struct word *out)
{
	const char *end;

	skip_comments(lex, text, row);
	if (at_line_end(lex))
		return false;
	*out = (struct word){ lex->token.text, 0, lex->token.line };
	do {
		end = lex->token.text + lex->token.len;
		lex_next(lex);
	} while (lex->token.kind != TOKEN_END && lex->token.kind != TOKEN_NEWLINE &&
		 lex->token.kind != TOKEN_COMMENT && !lex->token.space_before &&
		 lex->token.text == end);
	out->len = (size_t)(end - out->text);
	return true;
}

/* ---- what a word is ---- */

static const struct { const char *name; enum io_word word; bool has_value; } option[] = {
	{ "line", IO_WORD_LINE, true }, { "chip", IO_WORD_CHIP, true },
	{ "offset", IO_WORD_OFFSET, true }, { "debounce", IO_WORD_DEBOUNCE, true },
	{ "safe", IO_WORD_SAFE, true }, { "active-low", IO_WORD_ACTIVE_LOW, false },
	{ "pull-up", IO_WORD_PULL, false }, { "pull-down", IO_WORD_PULL, false },
	{ "no-pull", IO_WORD_PULL, false }, { "push-pull", IO_WORD_DRIVE, false },
	{ "open-drain", IO_WORD_DRIVE, false }, { "open-source", IO_WORD_DRIVE, false },
};

static enum io_word kind_of(const struct word *word)
{
	const char *equal = memchr(word->text, '=', word->len);
	const size_t name = equal ? (size_t)(equal - word->text) : word->len;

	for (size_t i = 0; i < sizeof(option) / sizeof(*option); i++)
		if (option[i].has_value == (equal != NULL) &&
		    ascii_is(option[i].name, word->text, name))
			return option[i].word;
	return IO_WORDS;
}

static void take(const struct io_text *io, struct io_row *row, enum io_word kind,
		 const struct word *word)
{
	if (kind < IO_WORDS && row->word[kind].len == 0)
		row->word[kind] = (struct io_span){ (size_t)(word->text - io->text),
						    word->len };
	row->words_end = (size_t)(word->text - io->text) + word->len;
}

/* ---- lines ---- */

/* Before the newline, and a carriage return before that. */
static size_t end_of_line(const struct io_text *io, size_t at)
{
	const char *newline = memchr(io->text + at, '\n', io->len - at);
	size_t end = newline ? (size_t)(newline - io->text) : io->len;

	while (end > at && io->text[end - 1] == '\r')
		end--;
	return end;
}

static size_t begin_of_line(const struct io_text *io, size_t at, size_t least)
{
	while (at > least && io->text[at - 1] != '\n')
		at--;
	return at;
}

/* At the end of a statement: its comment, and where its line ends. */
static void end_row(struct io_text *io, struct lex *lex, struct io_row *row)
{
	row->end = end_of_line(io, row->words_end);
	if (lex->token.kind == TOKEN_NEWLINE)
		row->end = end_of_line(io, (size_t)(lex->token.text - io->text));
	if (!lex_is(lex, "#"))
		return;
	row->comment.at = (size_t)(lex->token.text - io->text);
	row->end = end_of_line(io, row->comment.at);
	row->comment.len = row->end - row->comment.at;
}

static struct io_row *push_row(struct io_text *io)
{
	struct io_row *more;

	if ((io->count & (io->count - 1)) == 0) {
		more = realloc(io->row, (size_t)(io->count ? 2 * io->count : 1) *
			       sizeof(*more));
		if (!more)
			return NULL;
		io->row = more;
	}
	more = &io->row[io->count++];
	memset(more, 0, sizeof(*more));
	return more;
}

static void read_board(struct io_text *io, struct lex *lex, const struct word *first)
{
	struct word word;

	io->board_line = first->line;
	if (next_word(lex, io->text, NULL, &word))
		io->board = (struct io_span){ (size_t)(word.text - io->text), word.len };
	while (next_word(lex, io->text, NULL, &word))
		;
}

/* @least: behind what was read before. */
static bool read_row(struct io_text *io, struct lex *lex, const struct word *first,
		     size_t least)
{
	struct io_row *row = push_row(io);
	struct word word;

	if (!row)
		return false;
	row->line = first->line;
	row->from = begin_of_line(io, (size_t)(first->text - io->text), least);
	take(io, row, IO_WORD_ADDRESS, first);
	if (next_word(lex, io->text, row, &word))
		take(io, row, IO_WORD_DRIVER, &word);
	while (next_word(lex, io->text, row, &word))
		take(io, row, kind_of(&word), &word);
	end_row(io, lex, row);
	return true;
}

bool io_text_read(struct io_text *out, const char *text, size_t len)
{
	struct lex lex;
	struct word word;
	bool first = true;
	size_t least = 0;

	*out = (struct io_text){ .text = text, .len = len };
	lex_init(&lex, text, len);
	lex.newlines = lex.comments = true;
	lex_next(&lex);
	while (lex.token.kind != TOKEN_END) {
		if (lex.token.kind == TOKEN_COMMENT) {
			least = (size_t)(lex.token.text - text) + lex.token.len;
			lex_next(&lex);
		} else if (lex.token.kind == TOKEN_NEWLINE) {
			lex_next(&lex);
		} else if (!next_word(&lex, text, NULL, &word)) {
			lex_skip_line(&lex); /* # */
		} else {
			if (first && ascii_is("BOARD", word.text, word.len))
				read_board(out, &lex, &word);
			else if (!read_row(out, &lex, &word, least))
				return false;
			first = false;
		}
	}
	return true;
}

void io_text_free(struct io_text *io)
{
	free(io->row);
	*io = (struct io_text){ .text = NULL };
}

/* ---- what cells show ---- */

/* The characters of a name, without quotes. */
static size_t unquote(const char *value, size_t len, char *out)
{
	size_t used = 0;

	if (len < 2 || value[0] != '"' || value[len - 1] != '"') {
		memcpy(out, value, len);
		return len;
	}
	for (size_t i = 1; i + 1 < len; i++) {
		if (value[i] == '$' && i + 2 < len)
			i++;
		out[used++] = value[i];
	}
	return used;
}

static struct io_span value_of(const struct io_text *io, const struct io_span *word)
{
	const char *equal = memchr(io->text + word->at, '=', word->len);
	const size_t skip = equal ? (size_t)(equal - io->text) + 1 - word->at : 0;

	return (struct io_span){ word->at + skip, word->len - skip };
}

static bool has_blank(const char *text, size_t len)
{
	return memchr(text, ' ', len) || memchr(text, '\t', len);
}

/* A name with blanks keeps its quotes, so that label and offset are told from it. */
static size_t put_name(const struct io_text *io, const struct io_span *word, char *out)
{
	const struct io_span value = value_of(io, word);

	if (!word->len)
		return 0;
	if (has_blank(io->text + value.at, value.len)) {
		memcpy(out, io->text + value.at, value.len);
		return value.len;
	}
	return unquote(io->text + value.at, value.len, out);
}

static size_t put_line(const struct io_text *io, const struct io_row *row, char *out)
{
	const struct io_span offset = value_of(io, &row->word[IO_WORD_OFFSET]);
	size_t len;

	if (row->word[IO_WORD_LINE].len)
		return put_name(io, &row->word[IO_WORD_LINE], out);
	len = put_name(io, &row->word[IO_WORD_CHIP], out);
	if (!offset.len)
		return len;
	if (len)
		out[len++] = ' ';
	memcpy(out + len, io->text + offset.at, offset.len);
	return len + offset.len;
}

static size_t put_comment(const struct io_text *io, const struct io_span *comment,
			  char *out)
{
	const char *at = io->text + comment->at, *end = at + comment->len;

	while (at < end && (*at == '#' || *at == '/'))
		at++;
	while (at < end && (*at == ' ' || *at == '\t'))
		at++;
	while (end > at && (end[-1] == ' ' || end[-1] == '\t' || end[-1] == '\r'))
		end--;
	memcpy(out, at, (size_t)(end - at));
	return (size_t)(end - at);
}

static const enum io_word word_of[IO_FIELDS] = {
	[IO_ADDRESS] = IO_WORD_ADDRESS, [IO_DRIVER] = IO_WORD_DRIVER,
	[IO_LINE] = IO_WORD_LINE, [IO_PULL] = IO_WORD_PULL,
	[IO_ACTIVE_LOW] = IO_WORD_ACTIVE_LOW, [IO_DEBOUNCE] = IO_WORD_DEBOUNCE,
	[IO_DRIVE] = IO_WORD_DRIVE, [IO_SAFE] = IO_WORD_SAFE, [IO_COMMENT] = IO_WORDS,
};

char *io_text_field(const struct io_text *io, int number, enum io_field field)
{
	const struct io_row *row = &io->row[number];
	const struct io_span value = field == IO_COMMENT ? row->comment :
		field == IO_LINE ? (struct io_span){ row->from, row->end - row->from } :
		field == IO_ADDRESS || field == IO_DRIVER ? row->word[word_of[field]] :
		value_of(io, &row->word[word_of[field]]);
	char *out = malloc(value.len + 2);
	size_t len = value.len;

	if (!out)
		return NULL;
	if (field == IO_COMMENT) {
		len = put_comment(io, &row->comment, out);
	} else if (field == IO_LINE) {
		len = put_line(io, row, out);
	} else if (field == IO_ACTIVE_LOW) {
		len = row->word[IO_WORD_ACTIVE_LOW].len > 0;
		out[0] = '1';
	} else {
		memcpy(out, io->text + value.at, len);
	}
	out[len] = '\0';
	return out;
}

char *io_text_board(const struct io_text *io)
{
	char *out = malloc(io->board.len + 1);

	if (out)
		out[unquote(io->text + io->board.at, io->board.len, out)] = '\0';
	return out;
}
