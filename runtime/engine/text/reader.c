/* SPDX-License-Identifier: MIT
 *
 * reader - steps through a rung file and keeps its comments.
 *
 * It knows tokens, names, values and parameters. Parts and rungs are read in read_*.c.
 */
#include "engine/text/reader.h"
#include "engine/base/ascii.h"
#include "engine/base/name.h"

#include "engine/model/advice.h"
#include "engine/model/dialect.h"
#include "engine/text/mend.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct reader *reader_new(struct project *project, const char *file,
			  struct diag_list *diags)
{
	struct reader *r = calloc(1, sizeof(*r));

	if (!r)
		return NULL;
	r->project = project;
	r->diags = diags;
	r->place.file = file;
	return r;
}

void reader_free(struct reader *r)
{
	if (!r)
		return;
	free(r->above.text);
	free(r->note.text);
	free(r->rung_note.text);
	free(r->text.text);
	free(r->cell);
	free(r);
}

/* ---- diagnostics ---- */

/* Messages beyond this number show no mended line. */
#define MEND_MOST 20

static bool is_form(enum diag_id id)
{
	static const enum diag_id ids[] = {
		DIAG_SYNTAX, DIAG_EXPECTED, DIAG_UNKNOWN_WORD, DIAG_BAD_LITERAL, DIAG_BAD_ROW,
		DIAG_MISSING_OPERAND, DIAG_EXTRA_TEXT, DIAG_BAD_EXPRESSION, DIAG_BAD_TYPE,
		DIAG_BAD_ADDRESS, DIAG_NOT_ADDRESS, DIAG_BAD_BIT, DIAG_MISPLACED,
		DIAG_OPEN_STRING, DIAG_OPEN_COMMENT, DIAG_MISSING_INSTANCE, DIAG_BAD_BOUNDS,
		DIAG_LOOP_FORM, DIAG_NOT_A_LETTER, DIAG_TOO_MANY_VALUES,
	};

	for (size_t i = 0; i < sizeof(ids) / sizeof(*ids); i++)
		if (ids[i] == id)
			return true;
	return false;
}

/* Start of the line of @at; with @before of the last line above it that is not empty. */
static const char *line_of(const struct reader *r, const char *at, bool before, int *line)
{
	for (;;) {
		while (at > r->begin && at[-1] != '\n')
			at--;
		if (!before || at == r->begin)
			return at;
		at--;
		--*line;
		before = at == r->begin || at[-1] == '\n';
	}
}

/* Does a jump name the word under the cursor? */
static bool is_label(const struct reader *r)
{
	const struct token *token = &r->lex.token;

	for (int i = 0; token->kind == TOKEN_NAME && i < r->il->count; i++) {
		const struct il_line *line = &r->il->line[i];

		if (line->kind == IL_OP && line->op == OP_JMP &&
		    name_is(names_text(&r->project->names, line->operand), token->text,
			    token->len))
			return true;
	}
	return false;
}

static bool mend_as(struct reader *r, enum mend_kind kind, const char *text, int line,
		    struct diag place)
{
	const char *end = memchr(text, '\n', (size_t)(r->lex.end - text));
	struct mend_line in = { r->project, kind, r->var_flags, r->members,
				kind == MEND_LIST && is_label(r),
				r->pou && r->pou->language == LANGUAGE_SFC, text,
				(size_t)((end ? end : r->lex.end) - text) };
	struct mended out;

	if (!r->project->advice->mend(&in, &out))
		return false;
	place.id = out.id;
	place.line = r->mended = line;
	place.column = out.column;
	r->closed = strcmp(out.line, kind == MEND_VAR ? "END_VAR" : "END_PROGRAM") == 0;
	r->lost |= kind == MEND_HEAD && strncmp(out.line, "RUNG", 4) == 0;
	if (kind == MEND_ROW) {
		place.col = 1;
		for (int i = 1; i < out.column - 1; i++)
			place.col += text[i] == '|' && memchr(text, '|', (size_t)i);
	}
	if (out.id == DIAG_WRITE_INSTEAD || out.id == DIAG_SPECIAL_INSTEAD || out.id == DIAG_EDGE_OF_VALUE ||
	    out.id == DIAG_MISSING_INSTANCE)
		diag_add(r->diags, place, "%s" DIAG_AND "%s" DIAG_AND "%s", out.from, out.to,
			 out.line);
	else
		diag_add(r->diags, place, "%s" DIAG_AND "%s",
			 out.id == DIAG_MISSING ? out.to : out.from, out.line);
	return true;
}

bool reader_special(struct reader *r, const struct token *token)
{
	struct dialect_special special;
	struct diag place = r->place;
	const char *text;
	size_t len;

	if (token->len != 1 || *token->text != ':')
		return false;
	len = dialect_around(r->begin, r->lex.end, token->text, &text);
	if (!dialect_special(text, len, &special) || *special.ours)
		return false;
	place.id = DIAG_SPECIAL_NOTHING;
	place.line = r->mended = token->line;
	place.column = token->column - (int)(token->text - text);
	diag_add(r->diags, place, "%.*s", (int)len, text);
	return true;
}

bool reader_mend(struct reader *r, enum diag_id id)
{
	const struct token *token = &r->lex.token;
	const bool declares = r->comments == COMMENT_NOTE;
	int line = token->line;
	const char *text;

	if (!r->project->advice || !r->begin || r->outer)
		return false;
	if (line == r->mended)
		return true;
	if (!is_form(id) || r->diags->count >= MEND_MOST)
		return false;
	if (reader_special(r, token))
		return true;
	text = line_of(r, token->text, declares && r->across_lines && line > r->begun,
		       &line);
	if (line == r->mended)
		return true;
	if (r->place.row)
		return mend_as(r, MEND_ROW, text, line, r->place);
	if (r->il && r->comments == COMMENT_IL)
		return mend_as(r, MEND_LIST, text, line, r->place) ||
		       mend_as(r, MEND_HEAD, text, line, r->place);
	if (declares)
		return mend_as(r, MEND_VAR, text, line, r->place);
	if (r->pou && r->place.rung && r->pou->language == LANGUAGE_LD &&
	    mend_as(r, MEND_ROW, text, line, r->place))
		return true;
	return mend_as(r, MEND_HEAD, text, line, r->place);
}

bool reader_mend_last(struct reader *r)
{
	struct diag_list *diags = r->diags;

	if (diags->dropped || !diags->count ||
	    diags->diag[diags->count - 1].id != DIAG_BAD_EXPRESSION)
		return false;
	diags->count--;
	diags->errors--;
	if (!reader_mend(r, DIAG_BAD_EXPRESSION)) {
		diags->count++;
		diags->errors++;
	}
	return false;
}

/* Is it a sign such as := or a word such as END_STEP, not a description such as "number"? */
static bool is_sign(const char *text, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if (text[i] == ' ' || (text[i] >= 'a' && text[i] <= 'z') || (text[i] & 0x80))
			return false;
	return len > 0;
}

/* Where " or " stands in @len bytes, which need no NUL; NULL: nowhere. */
static const char *find_or(const char *text, size_t len)
{
	for (size_t i = 0; i + 4 <= len; i++)
		if (memcmp(text + i, " or ", 4) == 0)
			return text + i;
	return NULL;
}

/* The message about an expected thing: a missing sign, one of two, or anything else. @out gets
 * its argument, with the token that stands there instead. */
static enum diag_id print_expected(const struct reader *r, const char *arg, size_t len,
				   char out[2 * LIMIT_ARG + 1])
{
	const struct token *token = &r->lex.token;
	const bool end = token->kind == TOKEN_NEWLINE || token->kind == TOKEN_END;
	const int found = end ? 0 : token->len < 24 ? (int)token->len : 24;
	const char *and = memchr(arg, *DIAG_AND, len);
	const size_t first = and ? (size_t)(and - arg) : len;
	const char *or = len < LIMIT_ARG ? find_or(arg, len) : NULL;
	const int behind = or ? (int)(arg + len - or) - 4 : 0;

	if (is_sign(arg, first)) {
		const char *rest = and ? memchr(and + 1, *DIAG_AND, len - first - 1) : NULL;

		snprintf(out, 2 * LIMIT_ARG + 1, "%.*s%s%.*s%.*s", (int)first, arg,
			 found || rest ? DIAG_AND : "", found, token->text, rest ? (int)(arg + len - rest) : 0, rest ? rest : "");
		return DIAG_SIGN_MISSING;
	}
	if (or && is_sign(arg, (size_t)(or - arg)) &&
	    is_sign(or + 4, (size_t)behind)) {
		snprintf(out, 2 * LIMIT_ARG + 1, "%.*s" DIAG_AND "%.*s" DIAG_AND "%.*s",
			 (int)(or - arg), arg, behind, or + 4, found, token->text);
		return DIAG_SIGNS_MISSING;
	}
	snprintf(out, 2 * LIMIT_ARG + 1, "%.*s%s%.*s", (int)len, arg,
		 and || !found ? "" : DIAG_AND, and ? 0 : found, token->text);
	return DIAG_EXPECTED;
}

static bool fail_at(struct reader *r, enum diag_id id, int line, int column,
		    const char *arg, size_t len)
{
	struct diag place = r->place;
	char text[2 * LIMIT_ARG + 1];

	/* Out of memory is reported at the end, without its consequences. */
	if (r->no_memory || reader_mend(r, id))
		return false;
	place.id = id;
	place.line = line;
	place.column = column;
	if (id == DIAG_EXPECTED) {
		place.id = print_expected(r, arg, len, text);
		return diag_add(r->diags, place, "%s", text);
	}
	return diag_add(r->diags, place, "%.*s",
			len > 2 * LIMIT_ARG ? 2 * LIMIT_ARG : (int)len, arg);
}

bool reader_fail(struct reader *r, enum diag_id id, const char *arg, size_t len)
{
	return fail_at(r, id, r->lex.token.line, r->lex.token.column, arg, len);
}

bool reader_fail_word(struct reader *r, enum diag_id id, const char *arg)
{
	return reader_fail(r, id, arg, strlen(arg));
}

bool reader_fail_many(struct reader *r, enum diag_id id, const char *what, long most)
{
	char text[LIMIT_ARG];

	snprintf(text, sizeof(text), "%s" DIAG_AND "%ld", what, most);
	return reader_fail_word(r, id, text);
}

bool reader_fail_range(struct reader *r, const char *text, size_t len)
{
	char arg[2 * LIMIT_ARG];

	if (!len || *text != '\'')
		return reader_fail(r, DIAG_LITERAL_RANGE, text, len);
	snprintf(arg, sizeof(arg), "%.*s" DIAG_AND "STRING[%u]", LIMIT_ARG - 16 < (int)len ?
		 LIMIT_ARG - 16 : (int)len, text, IEC_STRING_MOST);
	return reader_fail_word(r, DIAG_LITERAL_RANGE, arg);
}

bool reader_fail_token(struct reader *r, enum diag_id id)
{
	if (r->lex.token.kind == TOKEN_NEWLINE)
		return reader_fail_word(r, id, "end of line");
	if (r->lex.token.kind == TOKEN_END)
		return reader_fail_word(r, id, "end of file");
	return reader_fail(r, id, r->lex.token.text, r->lex.token.len);
}

void reader_fail_open(struct reader *r, const struct token *head)
{
	fail_at(r, DIAG_OPEN_BLOCK, head->line, head->column, head->text,
		head->len);
}

/* ---- text that grows ---- */

void buffer_add(struct reader *r, struct buffer *b, const char *text,
		size_t len)
{
	if (len >= b->size - b->len) {
		size_t size = b->size ? b->size : 128;

		while (size - b->len <= len)
			size *= 2;
		char *grown = realloc(b->text, size);
		if (!grown) {
			r->no_memory = true;
			return;
		}
		b->text = grown;
		b->size = size;
	}
	if (len > 0)
		memcpy(b->text + b->len, text, len);
	b->len += len;
}

void buffer_clear(struct buffer *b)
{
	b->len = 0;
	b->slash_len = 0;
}

uint32_t reader_intern(struct reader *r, const char *text, size_t len)
{
	uint32_t id = len > 0 ? names_intern(&r->project->names, text, len) : 0;

	if (len > 0 && id == 0)
		r->no_memory = true;
	return id;
}

uint32_t buffer_take(struct reader *r, struct buffer *b)
{
	uint32_t id = reader_intern(r, b->text, b->len);

	buffer_clear(b);
	return id;
}

/* ---- comments ---- */

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\n';
}

/* Does a comment begin or end at @text? These two bytes must be parted inside another. */
static bool is_mark(const char *text, size_t len)
{
	return len >= 2 && ((text[0] == '*' && text[1] == ')') ||
			    (text[0] == '(' && text[1] == '*'));
}

/* The // at the end of @b becomes (* … *), so that text may follow it. */
static void slash_close(struct reader *r, struct buffer *b)
{
	const char *text = b->slash;
	size_t len = b->slash_len;

	if (len == 0)
		return;
	text += 2;
	len -= 2;
	b->slash_len = 0;
	b->len = b->slash_at;
	buffer_add(r, b, "(*", 2);
	if (len > 0 && !is_blank(text[0]))
		buffer_add(r, b, " ", 1);
	for (size_t i = 0; i < len; i++) {
		buffer_add(r, b, text + i, 1);
		if (is_mark(text + i, len - i))
			buffer_add(r, b, " ", 1);
	}
	buffer_add(r, b, " *)", 3);
}

/* A comment in a cell has no newline: line ends and the blanks around them become one
 * blank. */
static void add_flat(struct reader *r, struct buffer *b, const char *text,
		     size_t len)
{
	size_t at = 0;

	while (at < len) {
		size_t end = at;
		bool newline = false;

		while (end < len && !is_blank(text[end]))
			end++;
		buffer_add(r, b, text + at, end - at);
		at = end;
		for (; end < len && is_blank(text[end]); end++)
			newline |= text[end] == '\n';
		if (newline)
			buffer_add(r, b, " ", 1);
		else
			buffer_add(r, b, text + at, end - at);
		at = end;
	}
}

static void comment_add(struct reader *r, struct buffer *b, const char *text,
			size_t len, enum comment_place place)
{
	bool line = place != COMMENT_ABOVE;

	if (line)
		slash_close(r, b);
	if (b->len > 0)
		buffer_add(r, b, line ? " " : "\n", 1);
	if (*text == '/') {
		while (is_blank(text[len - 1]))
			len--;
		b->slash = text;
		b->slash_len = line ? len : 0;
		b->slash_at = b->len;
	}
	if (place == COMMENT_CELL)
		add_flat(r, b, text, len);
	else
		buffer_add(r, b, text, len);
}

uint32_t buffer_take_cell(struct reader *r, struct buffer *b)
{
	slash_close(r, b);
	return buffer_take(r, b);
}

static void add_comments(struct reader *r, struct buffer *b, const char *text, size_t len,
			 enum comment_place place)
{
	struct lex lex;

	lex_init(&lex, text, len);
	lex.comments = true;
	while (comment_next(&lex))
		comment_add(r, b, lex.token.text, lex.token.len, place);
}

uint32_t comment_join(struct reader *r, uint32_t id, struct buffer *b, enum comment_place place)
{
	struct buffer all = { 0 };

	if (b->len == 0)
		return id;
	if (id == 0 && place != COMMENT_ABOVE)
		return buffer_take(r, b);
	if (id)
		add_comments(r, &all, names_text(&r->project->names, id),
			     names_len(&r->project->names, id), place);
	add_comments(r, &all, b->text, b->len, place);
	buffer_clear(b);
	id = reader_intern(r, all.text, all.len);
	free(all.text);
	return id;
}

static void comment_keep(struct reader *r)
{
	const struct token *token = &r->lex.token;
	size_t len = token->len;

	switch (r->comments) {
	case COMMENT_ABOVE:
		comment_add(r, &r->above, token->text, len, COMMENT_ABOVE);
		return;
	case COMMENT_NOTE:
	case COMMENT_CELL:
		comment_add(r, &r->note, token->text, len, r->comments);
		return;
	case COMMENT_IL:
		while (*token->text == '/' && is_blank(token->text[len - 1]))
			len--;
		if (!il_add(r->il, (struct il_line){
				.kind = IL_COMMENT,
				.operand = reader_intern(r, token->text, len),
				.line = (uint32_t)token->line }))
			r->no_memory = true;
		return;
	}
}

/* ---- stepping ---- */

static void fail_character(struct reader *r, const struct token *token)
{
	char text[32];

	snprintf(text, sizeof(text), "%.*s" DIAG_AND "U+%04X", (int)token->len, token->text,
		 (unsigned int)utf8_code(token->text, token->len));
	reader_fail_word(r, DIAG_NOT_A_LETTER, text);
}

/* A comment that is not closed reaches the end of the file: the diagnostic names its first
 * line. */
void reader_fail_bad(struct reader *r)
{
	const struct token *token = &r->lex.token;
	const char first = token->text[0];
	size_t len = 0;

	while (len < token->len && token->text[len] != '\n' && token->text[len] != '\r')
		len++;
	if (first == '"')
		reader_fail(r, DIAG_OPEN_STRING, token->text + 1, len - 1);
	else if (first == '(')
		reader_fail(r, DIAG_OPEN_COMMENT, token->text, len);
	else if (utf8_length(token->text, token->len) > 1)
		fail_character(r, token);
	else
		reader_fail_word(r, DIAG_BAD_BYTE, "");
}

/* The first word of a pragma is its kind. A file warns once of each. */
static void tell_pragma(struct reader *r)
{
	const char *from = r->lex.token.text + 1, *end = r->lex.at - 1;
	const char *to;
	uint32_t kind;

	while (from < end && is_blank(*from))
		from++;
	for (to = from; to < end && (*to == '_' || (ascii_upper(*to) >= 'A' && ascii_upper(*to) <= 'Z'));)
		to++;
	if (from == to) { /* no word: its brackets, such as {{ */
		from = r->lex.token.text;
		to = from + strspn(from, "{");
	}
	if (r->pou && r->pou->fbd && to - from == 2 && ascii_same(from, "at", 2))
		return; /* read_fbd() reads it */
	kind = reader_intern(r, from, (size_t)(to - from));
	for (int i = 0; i < r->pragmas; i++)
		if (r->pragma[i] == kind)
			return;
	if (r->pragmas == PRAGMAS_MOST)
		return;
	r->pragma[r->pragmas++] = kind;
	reader_fail(r, DIAG_PRAGMA, from, (size_t)(to - from));
}

bool reader_scan(struct reader *r)
{
	const bool comment = comment_next(&r->lex);

	if (comment && *r->lex.token.text == '{')
		tell_pragma(r);
	return comment;
}

void reader_next(struct reader *r)
{
	for (;;) {
		if (reader_scan(r))
			comment_keep(r);
		else if (r->lex.token.kind == TOKEN_BAD)
			reader_fail_bad(r);
		else
			return;
	}
}

void reader_step(struct reader *r)
{
	reader_next(r);
	if (r->across_lines)
		reader_skip_newlines(r);
}

bool reader_is(const struct reader *r, char symbol)
{
	return r->lex.token.kind == TOKEN_SYMBOL && r->lex.token.len == 1 &&
	       r->lex.token.text[0] == symbol;
}

bool reader_peek(const struct reader *r, const char *symbol)
{
	struct lex ahead = r->lex;

	ahead.comments = false;
	lex_next(&ahead);
	return lex_is(&ahead, symbol);
}

bool reader_at_end(const struct reader *r)
{
	return r->lex.token.kind == TOKEN_NEWLINE ||
	       r->lex.token.kind == TOKEN_END;
}

void reader_skip_line(struct reader *r)
{
	while (!reader_at_end(r))
		reader_next(r);
}

void reader_skip_newlines(struct reader *r)
{
	while (r->lex.token.kind == TOKEN_NEWLINE)
		reader_next(r);
}

void reader_end_head(struct reader *r)
{
	if (!r->plain)
		reader_end_line(r);
	else if (reader_is(r, ';'))
		reader_next(r);
}

void reader_end_line(struct reader *r)
{
	if (!reader_at_end(r))
		reader_fail_token(r, DIAG_SYNTAX);
	reader_skip_line(r);
}

/* ---- bytes ---- */

static bool is_control(const char *text, size_t at, size_t len)
{
	unsigned char byte = (unsigned char)text[at];

	if (byte >= 0x20)
		return byte == 0x7f;
	if (byte == '\r')
		return at + 1 >= len || text[at + 1] != '\n';
	return byte != '\n' && byte != '\t';
}

static bool is_clean(const char *text, size_t len)
{
	for (size_t i = 0; i < len; i++) {
		unsigned char byte = (unsigned char)text[i];

		if ((byte < 0x20 && byte != '\n' && byte != '\t') ||
		    byte == 0x7f)
			return false;
	}
	return utf8_valid(text, len, NULL);
}

/* Copies without CR. A control character becomes a blank; the first of a line is reported. */
static size_t copy_clean(struct reader *r, char *copy, const char *text,
			 size_t len)
{
	size_t out = 0, start = 0;
	int line = 1, told = 0;

	for (size_t i = 0; i < len; i++) {
		copy[out] = text[i];
		if (is_control(text, i, len)) {
			copy[out] = ' ';
			if (told != line)
				fail_at(r, DIAG_BAD_BYTE, line,
					(int)(i - start) + 1, "", 0);
			told = line;
		} else if (text[i] == '\r') {
			continue;
		} else if (text[i] == '\n') {
			line++;
			start = i + 1;
		}
		out++;
	}
	return out;
}

static void blank_bad_utf8(struct reader *r, char *text, size_t len)
{
	size_t at = 0, start = 0, bad = 0, from = 0;
	int line = 1, told = 0;

	while (from < len && !utf8_valid(text + from, len - from, &bad)) {
		bad += from;
		for (; at < bad; at++) {
			if (text[at] != '\n')
				continue;
			line++;
			start = at + 1;
		}
		if (told != line)
			fail_at(r, DIAG_BAD_UTF8, line, (int)(bad - start) + 1,
				"", 0);
		told = line;
		text[bad] = ' ';
		from = bad + 1;
	}
}

char *reader_open(struct reader *r, const char *text, size_t len)
{
	char *copy = NULL;

	if (!is_clean(text, len)) {
		copy = malloc(len + 1);
		if (!copy) {
			r->no_memory = true;
			len = 0;
		} else {
			len = copy_clean(r, copy, text, len);
			blank_bad_utf8(r, copy, len);
			text = copy;
		}
	}
	lex_init(&r->lex, text, len);
	r->begin = r->lex.at;
	r->lex.newlines = true;
	r->lex.comments = true;
	r->lex.wide = r->plain;
	reader_next(r);
	return copy;
}

/* ---- parts of a project ---- */

void reader_add_part(struct reader *r, struct part part)
{
	struct project *project = r->project;
	struct part *slot = arena_push(&project->arena, &project->part,
				       &project->part_count, sizeof(part));

	part.included = r->outer != NULL;
	part.source = r->number;
	if (slot)
		*slot = part;
	else
		r->no_memory = true;
}

/* The line after the one whose first word is END_VIEW; NULL: there is none. */
const char *reader_view_end(struct lex *lex)
{
	static const char word[] = "END_VIEW";
	const size_t len = sizeof(word) - 1;
	const char *at = lex->at;

	while ((at = memchr(at, '\n', (size_t)(lex->end - at)))) {
		at++;
		lex->line++;
		lex->line_start = at;
		while (at < lex->end && (*at == ' ' || *at == '\t'))
			at++;
		if ((size_t)(lex->end - at) >= len &&
		    ascii_same(at, word, len)) {
			at += len;
			if (at == lex->end || *at == '\n' || *at == ' ' ||
			    *at == '\t' || *at == '/' || *at == '(')
				return at;
		}
	}
	return NULL;
}

/* The name as seen from where this file stands. */
const char *reader_path(struct reader *r, const char *from, const char *name)
{
	const char *slash = strrchr(from, '/');
	size_t head = slash && name[0] != '/' ? (size_t)(slash - from) + 1 : 0;

	buffer_clear(&r->text);
	buffer_add(r, &r->text, from, head);
	buffer_add(r, &r->text, name, strlen(name));
	char *path = arena_copy(&r->project->arena, r->text.text, r->text.len);

	buffer_clear(&r->text);
	return path;
}

/* The name at the cursor, of which a NAMESPACE may be named before other names. */
static bool add_space(struct reader *r)
{
	const struct token name = r->lex.token;
	const char *at = name.text, *end = at + name.len;

	if (name.kind != TOKEN_NAME || name.len > 2 * LIMIT_NAME)
		return reader_fail_word(r, DIAG_EXPECTED, "name of a namespace");
	while (at < end) {
		const char *dot = memchr(at, '.', (size_t)(end - at));
		const size_t len = (size_t)((dot ? dot : end) - at);

		if (!words_space(&r->project->words, names_text(&r->project->names, reader_intern(r, at, len)), len))
			return r->no_memory = true, false;
		at += len + 1;
	}
	return true;
}

/* Takes the token at the cursor into the text of the line; comments go above it. */
static void take_token(struct reader *r, struct buffer *line)
{
	if (line->len && line->text[line->len - 1] != '\n' && !reader_is(r, ',') && !reader_is(r, ';'))
		buffer_add(r, line, " ", 1);
	buffer_add(r, line, r->lex.token.text, r->lex.token.len);
	reader_step(r);
}

bool reader_take_space(struct reader *r, struct buffer *line)
{
	const bool begins = lex_is(&r->lex, "NAMESPACE"), uses = lex_is(&r->lex, "USING");

	do {
		take_token(r, line);
		if (begins && lex_is(&r->lex, "INTERNAL"))
			take_token(r, line);
		if ((begins || uses) && !add_space(r))
			return false;
		if (begins || uses)
			take_token(r, line);
	} while (uses && reader_is(r, ','));
	if (reader_is(r, ';'))
		take_token(r, line);
	return true;
}

/* ---- words that begin a part ---- */

const struct sfc_word *reader_chart_word(const struct lex *lex)
{
	const struct sfc_word *word;

	for (int i = 0; (word = sfc_word(i)); i++)
		if (lex_is(lex, word->word))
			return word;
	return NULL;
}

bool reader_is_sfc_word(const struct lex *lex)
{
	const struct sfc_word *word = reader_chart_word(lex);

	return word && word->kind != SFC_WORD_SETTING;
}

bool read_begins_action(const struct reader *r)
{
	struct lex lex = r->lex;

	if (!lex_is(&lex, "ACTION"))
		return false;
	lex.newlines = lex.comments = false;
	return lex_next(&lex) == TOKEN_NAME;
}

/* Does a part of a POU that is no chart begin or end here, as others have it: ACTION Name? */
static bool begins_member(const struct reader *r)
{
	static const char *const words[] = { "ACTION", "END_ACTION", "ACTIONS", "END_ACTIONS", "METHOD",
					     "PROPERTY" };
	bool found = false;

	if (r->pou && r->pou->sfc)
		return false;
	for (size_t i = 0; !found && i < (r->plain ? sizeof(words) / sizeof(*words) : 2); i++)
		found = lex_is(&r->lex, words[i]);
	if (!r->plain && found && lex_is(&r->lex, "ACTION"))
		return read_begins_action(r);
	return found && !reader_peek(r, "(") && !reader_peek(r, ";");
}

bool read_ends_block(const struct reader *r)
{
	static const char *const words[] = {
		"PROGRAM", "END_PROGRAM", "RUNG", "VAR", "VAR_GLOBAL",
		"INCLUDE", "VIEW", "PROJECT", "CONFIGURATION",
		"END_CONFIGURATION", "FUNCTION", "END_FUNCTION",
		"FUNCTION_BLOCK", "END_FUNCTION_BLOCK", "TYPE", "END_TYPE",
		"SUBROUTINE", "END_SUBROUTINE",
		"USES", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP", "VAR_EXTERNAL",
		"VAR_ACCESS", "NAMESPACE", "END_NAMESPACE",
	};
	bool found = r->boxed && lex_is(&r->lex, "END_EXECUTE");

	found |= r->pou && r->pou->language == LANGUAGE_SFC && reader_is_sfc_word(&r->lex);
	if (r->lex.token.kind != TOKEN_NAME)
		return false;
	for (size_t i = 0; !found && i < sizeof(words) / sizeof(*words); i++)
		found = *words[i] == ascii_upper(*r->lex.token.text) && lex_is(&r->lex, words[i]);
	found |= begins_member(r);
	if (r->plain && !ascii_same(r->lex.token.text, "END_", 4) &&
	    (reader_peek(r, "(") || reader_peek(r, "[") || reader_peek(r, ".")))
		return false;
	return found && !reader_peek(r, ":") && !reader_peek(r, ":=") && !reader_peek(r, ",") &&
	       !reader_peek(r, "AT");
}

/* PROPERTY_COUNT: the line begins with no word of a property. */
enum property reader_property(const struct reader *r)
{
	enum property at = 0;

	while (at < PROPERTY_COUNT && !lex_is(&r->lex, property_row(at)->word))
		at++;
	return at;
}

/* Reports a word or sign that begins no part, rung or declaration. */
void reader_skip_odd_line(struct reader *r)
{
	const bool row = reader_is(r, '|'), rung = lex_is(&r->lex, "RUNG");

	const bool ladder = !r->pou || r->pou->language == LANGUAGE_LD;

	if (r->lost && ladder && (row || rung || lex_is(&r->lex, "END_PROGRAM"))) {
		r->lost = row || rung;
		reader_skip_line(r);
		return;
	}
	r->lost = ladder && (row || rung);
	if (!r->pou && rung)
		reader_fail_word(r, DIAG_MISSING_ABOVE, "PROGRAM Main LD");
	else if (r->lex.token.kind == TOKEN_NAME)
		reader_fail_token(r, read_ends_block(r) ||
				  lex_is(&r->lex, "END_VAR") ||
				  lex_is(&r->lex, "END_VIEW") ||
				  (!r->pou && reader_property(r) < PROPERTY_COUNT) ?
				  DIAG_MISPLACED : DIAG_UNKNOWN_WORD);
	else if (row && ladder)
		reader_fail_word(r, DIAG_MISSING_ABOVE, r->pou ? "RUNG" : "PROGRAM Main LD");
	else
		reader_fail_token(r, row ? DIAG_MISPLACED : DIAG_SYNTAX);
	reader_skip_line(r);
}

/* VAR … END_VAR above a program, as some tools have it. A rung file without its first line names a language. */
static bool is_plain_behind_vars(struct lex lex)
{
	static const char *const heads[] = { "PROGRAM", "FUNCTION", "FUNCTION_BLOCK" };
	static const char *const languages[] = { "LD", "IL", "ST", "SFC", "FBD" };
	bool head = false;

	while (lex_is(&lex, "VAR")) {
		while (lex.token.kind != TOKEN_END && !lex_is(&lex, "END_VAR"))
			lex_next(&lex);
		lex_next(&lex);
		lex_accept(&lex, ";");
	}
	for (size_t i = 0; i < sizeof(heads) / sizeof(*heads); i++)
		head |= lex_is(&lex, heads[i]);
	if (!head || lex_next(&lex) != TOKEN_NAME)
		return false;
	lex_next(&lex);
	for (size_t i = 0; i < sizeof(languages) / sizeof(*languages); i++)
		if (lex_is(&lex, languages[i]))
			return false;
	return true;
}

bool text_is_plain(const char *text, size_t len)
{
	static const char *const words[] = {
		"PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "FUNCTIONBLOCK", "TYPE", "CONFIGURATION", "VAR_GLOBAL",
		"NAMESPACE", "USING", "CLASS", "INTERFACE", /* the message names them */
	};
	struct lex lex;

	lex_init(&lex, text, len);
	lex.comments = true;
	while (comment_next(&lex))
		;
	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (lex_is(&lex, words[i]))
			return true;
	lex.comments = lex.newlines = false;
	return is_plain_behind_vars(lex);
}
