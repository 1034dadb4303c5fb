/* SPDX-License-Identifier: MIT
 *
 * iomap_text - the words of an I/O map, and edits of them.
 *
 * An edited line is written in a buffer, word by word. The edit is the difference to the
 * old line.
 */
#include "editor-gtk/document/iomap_text.h"

#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"

#include <stdio.h>
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

/* Words in this file are tokens without a blank between them, as in hal/iomap.c. Comments
 * are skipped; one that ends the line is kept in @row (or NULL). */
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

/* The place of the newline, or of a carriage return before it. */
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

/* Ends a row: finds its comment and the end of its line. */
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

/* @least: the end of the row before. */
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

/* Copies a name without its quotes. */
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

/* A name with blanks keeps its quotes: without them it would read as label and offset. */
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

const char *io_field_name(enum io_field field)
{
	static const char *const name[IO_FIELDS] = {
		[IO_ADDRESS] = N_("Address"), [IO_DRIVER] = N_("Driver"),
		[IO_LINE] = N_("I/O line"), [IO_PULL] = N_("Pull"),
		[IO_ACTIVE_LOW] = N_("Active low"), [IO_DEBOUNCE] = N_("Debounce"),
		[IO_DRIVE] = N_("Drive"), [IO_SAFE] = N_("Safe"),
		[IO_COMMENT] = N_("Comment"),
	};

	return _(name[field]);
}

char *io_text_board(const struct io_text *io)
{
	char *out = malloc(io->board.len + 1);

	if (out)
		out[unquote(io->text + io->board.at, io->board.len, out)] = '\0';
	return out;
}

/* A line that is being written; spans count from the start of the text. */
struct draft {
	char *text;
	size_t len, room;
	bool failed;
};

static void splice(struct draft *draft, size_t at, size_t removed, const char *with)
{
	const size_t come = strlen(with);
	char *more;

	if (draft->failed)
		return;
	if (draft->len - removed + come >= draft->room) { /* with the NUL */
		draft->room = draft->len + come + 64;
		more = realloc(draft->text, draft->room);
		draft->failed = !more;
		if (!more)
			return;
		draft->text = more;
	}
	memmove(draft->text + at + come, draft->text + at + removed,
		draft->len - at - removed);
	memcpy(draft->text + at, with, come);
	draft->len += come - removed;
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t';
}

/* Counts the blanks at a place of the draft. */
static size_t blanks(const struct draft *draft, size_t at)
{
	size_t count = 0;

	while (at + count < draft->len && draft->text[at + count] == ' ')
		count++;
	return count;
}

static bool is_end(const struct draft *draft, size_t at)
{
	return at >= draft->len || draft->text[at] == '\r' || draft->text[at] == '\n';
}

/* Columns on the screen, not bytes. */
static int width(const char *text, size_t len)
{
	return utf8_width(text, len);
}

/* Keeps the next word in its column if there are enough blanks. */
static void keep_column(struct draft *draft, size_t end, int grown)
{
	const size_t have = blanks(draft, end);

	if (have < 2 && grown >= 0)
		return;
	if (have == 0 || is_end(draft, end + have))
		return;
	if (grown > 0)
		splice(draft, end, (size_t)grown < have ? (size_t)grown : have - 1, "");
	for (; grown < 0 && have >= 2; grown++)
		splice(draft, end, 0, " ");
}

static void replace_word(struct draft *draft, size_t at, size_t len, const char *with)
{
	const int before = width(draft->text + at, len);

	splice(draft, at, len, with);
	if (!draft->failed)
		keep_column(draft, at + strlen(with), width(with, strlen(with)) - before);
}

static void remove_word(struct draft *draft, size_t at, size_t len)
{
	size_t from = at;
	int gone;

	while (from > 0 && is_blank(draft->text[from - 1]))
		from--;
	gone = width(draft->text + from, at + len - from);
	splice(draft, from, at + len - from, "");
	keep_column(draft, from, -gone);
}

/* Inserts a word behind the word that ends at @at. */
static void insert_word(struct draft *draft, size_t at, const char *word)
{
	const int come = width(word, strlen(word)) + 1;

	splice(draft, at, 0, word);
	splice(draft, at, 0, " ");
	if (!draft->failed)
		keep_column(draft, at + strlen(word) + 1, come);
}

/* ---- edits ---- */

static bool draft_open(struct draft *draft, const struct io_text *io,
		       const struct io_row *row)
{
	draft->len = row->end - row->from;
	draft->room = draft->len + 64;
	draft->text = malloc(draft->room);
	draft->failed = !draft->text;
	if (draft->text)
		memcpy(draft->text, io->text + row->from, draft->len);
	return draft->text != NULL;
}

/* Reduces the edit to the bytes that differ, so that undo and cursor go there. */
static enum io_refusal draft_close(struct draft *draft, const struct io_text *io,
				   const struct io_row *row, struct io_edit *edit)
{
	const char *was = io->text + row->from;
	const size_t len = row->end - row->from;
	size_t same = 0, tail = 0;

	if (draft->failed) {
		free(draft->text);
		return IO_MEMORY;
	}
	while (same < len && same < draft->len && was[same] == draft->text[same])
		same++;
	while (tail < len - same && tail < draft->len - same &&
	       was[len - 1 - tail] == draft->text[draft->len - 1 - tail])
		tail++;
	/* not in the middle of a character */
	while (same > 0 && ((unsigned char)was[same] & 0xc0) == 0x80)
		same--;
	while (tail > 0 && ((unsigned char)was[len - tail] & 0xc0) == 0x80)
		tail--;
	edit->at = row->from + same;
	edit->removed = len - same - tail;
	memmove(draft->text, draft->text + same, draft->len - same - tail);
	draft->text[draft->len - same - tail] = '\0';
	edit->with = draft->text;
	return IO_GOOD;
}

/* Where a word of @kind goes: behind the words that come before it in the usual order. */
static size_t place_of(const struct io_row *row, enum io_word kind)
{
	size_t at = row->words_end;

	for (int i = (int)kind - 1; i >= 0; i--)
		if (row->word[i].len)
			return row->word[i].at + row->word[i].len - row->from;
	return at - row->from;
}

/* @word: "pull-up", "safe=0"; "" deletes the word. */
static void set_word(struct draft *draft, const struct io_row *row, enum io_word kind,
		     const char *word)
{
	const struct io_span *span = &row->word[kind];

	if (span->len && *word)
		replace_word(draft, span->at - row->from, span->len, word);
	else if (span->len)
		remove_word(draft, span->at - row->from, span->len);
	else if (*word)
		insert_word(draft, place_of(row, kind), word);
}

/* ---- values ---- */

static bool is_one_word(const char *text)
{
	struct lex lex;
	const char *end = text + strlen(text);

	lex_init(&lex, text, strlen(text));
	lex.newlines = lex.comments = true;
	lex_next(&lex);
	if (lex.token.text != text || lex_is(&lex, "#"))
		return false;
	while (lex.token.kind != TOKEN_END) {
		if (lex.token.kind == TOKEN_NEWLINE || lex.token.kind == TOKEN_COMMENT ||
		    lex.token.kind == TOKEN_BAD ||
		    (lex.token.space_before && lex.token.text != text))
			return false;
		lex_next(&lex);
	}
	return end > text && !is_blank(end[-1]) && end[-1] != '\n' && end[-1] != '\r';
}

static bool has_control(const char *text)
{
	for (; *text; text++)
		if ((unsigned char)*text < 0x20 || *text == 0x7f)
			return true;
	return false;
}

/* Writes a name as a map needs it: in quotes unless it is one bare word. */
static bool spell_name(char *out, size_t room, const char *name, size_t len)
{
	size_t used = 0;
	bool quoted = len == 0;

	if (len + 3 > room)
		return false;
	memcpy(out, name, len);
	out[len] = '\0';
	quoted = quoted || strpbrk(out, "\"$'#") || strstr(out, "(*") || !is_one_word(out);
	if (!quoted)
		return true;
	out[used++] = '"';
	for (size_t i = 0; i < len; i++) {
		if (used + 4 > room)
			return false;
		if (name[i] == '"' || name[i] == '$')
			out[used++] = '$';
		out[used++] = name[i];
	}
	out[used++] = '"';
	out[used] = '\0';
	return true;
}

/* The same for a name that may already have quotes. */
static bool spell_typed(char *out, size_t room, const char *name, size_t len)
{
	if (len < 2 || name[0] != '"' || name[len - 1] != '"')
		return spell_name(out, room, name, len);
	if (len + 1 > room)
		return false;
	memcpy(out, name, len);
	out[len] = '\0';
	return is_one_word(out);
}

/* The start of the last word; @len: there is only one. */
static size_t last_word(const char *text, size_t len)
{
	size_t at = len;

	while (at > 0 && !is_blank(text[at - 1]))
		at--;
	return at;
}

static bool is_number(const char *text, size_t len)
{
	return len > 0 && strspn(text, "0123456789") >= len;
}

#define NAME_ROOM (2 * LIMIT_NAME + 8)

/* Splits "GPIO17", "\"P9_14 [x]\"" or "1c20800.pinctrl 7" into the words of the map;
 * @second "": one word. */
static enum io_refusal spell_line(const char *value, char *first, char *second)
{
	const size_t len = strlen(value), at = last_word(value, len);
	size_t label = at;

	while (label > 0 && is_blank(value[label - 1]))
		label--;
	second[0] = '\0';
	if (label > 0 && value[len - 1] != '"' && is_number(value + at, len - at)) {
		memcpy(first, "chip=", 5);
		memcpy(second, "offset=", 7);
		if (len - at >= 16)
			return IO_BAD_OFFSET;
		memcpy(second + 7, value + at, len - at + 1);
		return spell_typed(first + 5, NAME_ROOM - 5, value, label) ? IO_GOOD :
		       IO_BAD_NAME;
	}
	memcpy(first, "line=", 5);
	return spell_typed(first + 5, NAME_ROOM - 5, value, len) ? IO_GOOD : IO_BAD_NAME;
}

/* Replaces the words of a line's place. Backwards, so that the places of earlier words stay
 * valid. */
static void set_place(struct draft *draft, const struct io_row *row, const char *first,
		      const char *second)
{
	const struct io_span *chip = &row->word[IO_WORD_CHIP];
	const struct io_span *offset = &row->word[IO_WORD_OFFSET];
	const bool both = *second && chip->len && offset->len && chip->at < offset->at &&
			  !row->word[IO_WORD_LINE].len;
	enum io_word order[] = { IO_WORD_LINE, IO_WORD_CHIP, IO_WORD_OFFSET };
	char whole[2 * NAME_ROOM];
	enum io_word target = IO_WORD_LINE;

	while (target < IO_WORD_OFFSET && !row->word[target].len)
		target++;
	if (!row->word[target].len)
		target = IO_WORD_LINE;
	snprintf(whole, sizeof(whole), "%s%s%s", first, *second && !both ? " " : "",
		 both ? "" : second);
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 2; k++)
			if (row->word[order[k]].at < row->word[order[k + 1]].at) {
				const enum io_word other = order[k];

				order[k] = order[k + 1];
				order[k + 1] = other;
			}
	for (int i = 0; i < 3; i++)
		set_word(draft, row, order[i], order[i] == target ? whole :
			 both && order[i] == IO_WORD_OFFSET ? second : "");
}

static enum io_refusal set_line(struct draft *draft, const struct io_row *row,
				const char *value)
{
	char first[NAME_ROOM] = "", second[32] = "";
	const enum io_refusal why = *value ? spell_line(value, first, second) : IO_GOOD;

	if (why == IO_GOOD)
		set_place(draft, row, first, second);
	return why;
}

static void set_comment(struct draft *draft, const struct io_row *row, const char *value)
{
	const struct io_span *span = &row->comment;
	size_t at = span->len ? span->at - row->from : draft->len, keep = at;

	if (span->len)
		while (keep < span->at - row->from + span->len &&
		       (draft->text[keep] == '#' || draft->text[keep] == '/' ||
			is_blank(draft->text[keep])))
			keep++;
	if (!*value) {
		while (at > 0 && is_blank(draft->text[at - 1]))
			at--;
		splice(draft, at, draft->len - at, "");
	} else if (span->len) {
		splice(draft, keep, draft->len - keep, value);
		if (keep == at + 1)
			splice(draft, keep, 0, " ");
	} else {
		while (at > 0 && is_blank(draft->text[at - 1]))
			at--;
		splice(draft, at, draft->len - at, value);
		splice(draft, at, 0, "   # ");
	}
}

const char *const *io_text_choices(enum io_field field)
{
	static const char *const pull[] = { "pull-up", "pull-down", "no-pull", NULL };
	static const char *const drive[] = { "push-pull", "open-drain", "open-source",
					     NULL };
	static const char *const safe[] = { "0", "1", "hold", NULL };
	static const char *const yes[] = { "1", NULL };

	switch (field) {
	case IO_PULL: return pull;
	case IO_DRIVE: return drive;
	case IO_SAFE: return safe;
	case IO_ACTIVE_LOW: return yes;
	case IO_ADDRESS: case IO_DRIVER: case IO_LINE: case IO_DEBOUNCE: case IO_COMMENT:
	case IO_FIELDS:
		break;
	}
	return NULL;
}

static bool is_choice(const char *const *choices, const char *value)
{
	for (; choices && *choices; choices++)
		if (strcmp(*choices, value) == 0)
			return true;
	return !choices || !*value;
}

static enum io_refusal set_option(struct draft *draft, const struct io_row *row,
				  enum io_field field, const char *value)
{
	static const struct { enum io_word kind; const char *before; } words[IO_FIELDS] = {
		[IO_ADDRESS] = { IO_WORD_ADDRESS, "" }, [IO_DRIVER] = { IO_WORD_DRIVER, "" },
		[IO_PULL] = { IO_WORD_PULL, "" }, [IO_DRIVE] = { IO_WORD_DRIVE, "" },
		[IO_DEBOUNCE] = { IO_WORD_DEBOUNCE, "debounce=" },
		[IO_SAFE] = { IO_WORD_SAFE, "safe=" },
	};
	char word[LIMIT_NAME + 16] = "";

	if (strlen(value) > LIMIT_NAME)
		return IO_BAD_NAME;
	if (!*value && (field == IO_ADDRESS || field == IO_DRIVER))
		return IO_EMPTY;
	if (*value)
		snprintf(word, sizeof(word), "%s%s", words[field].before, value);
	if (*word && !is_one_word(word))
		return IO_MANY_WORDS;
	set_word(draft, row, words[field].kind, word);
	return IO_GOOD;
}

enum io_refusal io_text_set(const struct io_text *io, int number, enum io_field field,
			    const char *value, struct io_edit *edit)
{
	const struct io_row *row = &io->row[number];
	enum io_refusal why = IO_GOOD;
	struct draft draft;

	*edit = (struct io_edit){ 0, 0, NULL };
	if (has_control(value))
		return IO_BAD_NAME;
	if (!is_choice(io_text_choices(field), value))
		return IO_NO_WORD;
	if (!draft_open(&draft, io, row))
		return IO_MEMORY;
	if (field == IO_LINE)
		why = set_line(&draft, row, value);
	else if (field == IO_COMMENT)
		set_comment(&draft, row, value);
	else if (field == IO_ACTIVE_LOW)
		set_word(&draft, row, IO_WORD_ACTIVE_LOW, *value ? "active-low" : "");
	else
		why = set_option(&draft, row, field, value);
	if (why == IO_GOOD)
		return draft_close(&draft, io, row, edit);
	free(draft.text);
	return why;
}

/* ---- whole lines ---- */

static enum io_refusal put(struct io_edit *edit, size_t at, size_t removed,
			   const char *const *part, int count)
{
	size_t len = 1;

	for (int i = 0; i < count; i++)
		len += strlen(part[i]);
	*edit = (struct io_edit){ at, removed, malloc(len) };
	if (!edit->with)
		return IO_MEMORY;
	len = 0;
	for (int i = 0; i < count; i++) {
		const size_t more = strlen(part[i]);

		memcpy(edit->with + len, part[i], more + 1);
		len += more;
	}
	return IO_GOOD;
}

enum io_refusal io_text_set_board(const struct io_text *io, const char *name,
				  struct io_edit *edit)
{
	char quoted[NAME_ROOM] = "\"";
	const bool bom = io->len >= 3 && memcmp(io->text, "\xef\xbb\xbf", 3) == 0;
	size_t used = 1;

	*edit = (struct io_edit){ 0, 0, NULL };
	if (has_control(name) || strlen(name) > LIMIT_NAME)
		return IO_BAD_NAME;
	for (; *name; name++) {
		if (*name == '"' || *name == '$')
			quoted[used++] = '$';
		quoted[used++] = *name;
	}
	quoted[used] = '"';
	if (io->board.len)
		return put(edit, io->board.at, io->board.len,
			   (const char *[]){ quoted }, 1);
	if (io->board_line)
		return IO_NO_BOARD;
	return put(edit, bom ? 3 : 0, 0, (const char *[]){ "BOARD ", quoted, "\n" }, 3);
}

enum io_refusal io_text_delete(const struct io_text *io, int number, struct io_edit *edit)
{
	const struct io_row *row = &io->row[number];
	const bool whole = row->from == 0 || io->text[row->from - 1] == '\n';
	size_t end = row->end;

	while (whole && end < io->len && io->text[end] == '\r')
		end++;
	if (whole && end < io->len)
		end++; /* the newline */
	return put(edit, row->from, end - row->from, (const char *[]){ "" }, 1);
}

/* The start of the next line. */
static size_t behind_line(const struct io_text *io, size_t at)
{
	while (at < io->len && io->text[at] != '\n')
		at++;
	return at < io->len ? at + 1 : at;
}

enum io_refusal io_text_add(const struct io_text *io, int number, const char *address,
			    const char *driver, const char *comment,
			    struct io_edit *edit)
{
	const size_t at = number < 0 ? io->len : behind_line(io, io->row[number].end);
	const bool open = at > 0 && io->text[at - 1] != '\n';
	const bool output = strncmp(address, "%Q", 2) == 0;

	*edit = (struct io_edit){ 0, 0, NULL };
	if (!is_one_word(address) || !is_one_word(driver))
		return IO_MANY_WORDS;
	if (has_control(comment))
		return IO_BAD_NAME;
	return put(edit, at, 0, (const char *[]){ open ? "\n" : "", address, "  ", driver,
		output ? "  safe=0" : "", *comment ? "   # " : "", comment, "\n" }, 8);
}
