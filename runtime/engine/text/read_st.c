/* SPDX-License-Identifier: MIT
 *
 * read_st - a body of Structured Text, up to END_PROGRAM and the like.
 *
 * It cuts the text into statements and knows which block is open. model/st.h knows the parts of a
 * statement; check/ looks at names and types.
 */
#include "engine/text/reader.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <string.h>

/* A block that is not closed yet. */
struct st_block {
	enum st_kind kind;   /* ST_IF, ST_CASE, ST_FOR, ST_WHILE, ST_REPEAT   */
	struct token head;
	struct token second; /* the IF of `ELSE IF` in it; kind TOKEN_END: none */
	bool other;          /* ELSE was read                                 */
	bool choice;         /* of CASE: a value was read                     */
};

struct st_reader {
	struct reader *r;
	struct st *st;
	struct st_block block[LIMIT_ST_DEPTH];
	int depth;
	int lines;           /* newlines since the last item                  */
	bool comment;        /* the token is a comment or a pragma            */
};

/* The next token, newlines and comments too. */
static void st_step(struct st_reader *s)
{
	while (!(s->comment = reader_scan(s->r)) && s->r->lex.token.kind == TOKEN_BAD)
		reader_fail_bad(s->r);
}

static bool st_said(struct st_reader *s, enum diag_id id, const struct token *at, const char *arg)
{
	struct diag place = s->r->place;

	place.id = id;
	place.line = at->line;
	place.column = at->column;
	return diag_add(s->r->diags, place, "%s", arg);
}

static bool said_of(struct st_reader *s, enum diag_id id, const struct token *at, const char *more)
{
	char text[2 * LIMIT_ARG];
	const int len = at->len < LIMIT_ARG / 2 ? (int)at->len : LIMIT_ARG / 2;

	snprintf(text, sizeof(text), "%.*s%s%.40s", len, at->text, *more ? DIAG_AND : "", more);
	return st_said(s, id, at, text);
}

static struct st_item *add_item(struct st_reader *s, enum st_kind kind, const struct token *first,
				size_t len)
{
	struct arena *arena = &s->r->project->arena;
	struct st *st = s->st;
	struct st_item *item = arena_push(arena, &st->item, &st->count, sizeof(*item));

	if (!item) {
		s->r->no_memory = true;
		return NULL;
	}
	*item = (struct st_item){
		.kind = (uint8_t)kind, .gap = s->lines > 1 && st->count > 1,
		.depth = (uint8_t)s->depth, .text = reader_intern(s->r, first->text, len),
		.line = first->line, .column = first->column,
	};
	s->lines = 0;
	return item;
}

static void add_comment(struct st_reader *s, const struct token *comment, bool behind)
{
	size_t len = comment->len;

	while (comment->text[1] == '/' && (comment->text[len - 1] == ' ' || comment->text[len - 1] == '\t'))
		len--;
	struct st_item *item = add_item(s, ST_COMMENT, comment, len);

	if (item)
		item->behind = behind;
}

/* ---- blocks ---- */

static const struct { enum st_kind begin, end; const char *word; } pairs[] = {
	{ ST_IF, ST_END_IF, "END_IF" }, { ST_CASE, ST_END_CASE, "END_CASE" },
	{ ST_FOR, ST_END_FOR, "END_FOR" }, { ST_WHILE, ST_END_WHILE, "END_WHILE" },
	{ ST_REPEAT, ST_UNTIL, "UNTIL" },
};
#define PAIRS (sizeof(pairs) / sizeof(*pairs))

static struct st_block *innermost(struct st_reader *s)
{
	return s->depth > 0 ? &s->block[s->depth - 1] : NULL;
}

/* Reports the innermost block as open, and closes it. */
static void drop_block(struct st_reader *s)
{
	const struct st_block *block = &s->block[--s->depth];

	for (size_t i = 0; i < PAIRS; i++)
		if (pairs[i].begin == block->kind && block->second.kind != TOKEN_END)
			st_said(s, DIAG_ST_ELSE_IF, &block->second, "");
		else if (pairs[i].begin == block->kind)
			said_of(s, DIAG_ST_OPEN, &block->head, pairs[i].begin == ST_REPEAT ?
				"UNTIL … END_REPEAT" : pairs[i].word);
}

static bool has_block(const struct st_reader *s, enum st_kind kind)
{
	for (int i = 0; i < s->depth; i++)
		if (s->block[i].kind == kind)
			return true;
	return false;
}

/* Reports blocks that are open inside the innermost one of @kind. False: there is none. */
static bool back_to(struct st_reader *s, enum st_kind kind, const char *begin)
{
	if (!has_block(s, kind))
		return said_of(s, DIAG_ST_NO_BEGIN, &s->r->lex.token, begin);
	while (s->block[s->depth - 1].kind != kind)
		drop_block(s);
	return true;
}

static bool open_block(struct st_reader *s, enum st_kind kind)
{
	if (s->depth == LIMIT_ST_DEPTH)
		return said_of(s, DIAG_TOO_DEEP, &s->r->lex.token, "");
	const struct st_item *last = s->st->count > 0 ? &s->st->item[s->st->count - 1] : NULL;

	if (kind == ST_IF && s->depth > 0 && last && last->kind == ST_ELSE &&
	    last->line == s->r->lex.token.line)
		s->block[s->depth - 1].second = s->r->lex.token;
	s->block[s->depth++] = (struct st_block){ .kind = kind, .head = s->r->lex.token };
	return true;
}

/* ELSE, ELSIF, a choice and the ends: are they inside their block? Leaves it at its end. */
static bool in_block(struct st_reader *s, enum st_kind kind)
{
	for (size_t i = 0; i < PAIRS; i++)
		if (pairs[i].end == kind) {
			bool there = back_to(s, pairs[i].begin, st_form(pairs[i].begin)->word);

			s->depth -= there;
			return there;
		}
	if (kind == ST_ELSIF && !back_to(s, ST_IF, "IF"))
		return false;
	if (kind == ST_ELSE && !has_block(s, ST_IF) && !has_block(s, ST_CASE))
		return said_of(s, DIAG_ST_NO_BEGIN, &s->r->lex.token, "IF");
	while (kind == ST_ELSE && innermost(s)->kind != ST_IF && innermost(s)->kind != ST_CASE)
		drop_block(s);
	struct st_block *block = innermost(s);

	if ((kind == ST_ELSE || kind == ST_ELSIF) && block->other)
		return said_of(s, DIAG_ST_NO_BEGIN, &s->r->lex.token, st_form(block->kind)->word);
	block->other |= kind == ST_ELSE;
	block->choice = true;
	return true;
}

/* ---- statements ---- */

/* Is `name[…].name (` or a name alone with ; here? */
static bool is_call(struct lex lex)
{
	if (lex.token.kind != TOKEN_NAME)
		return false;
	lex_next(&lex);
	while (lex_is(&lex, "[")) {
		while (!lex_is(&lex, "]") && !lex_is(&lex, ";") && lex.token.kind != TOKEN_END)
			lex_next(&lex);
		if (lex_next(&lex) == TOKEN_SYMBOL && lex_is(&lex, ".") && lex_next(&lex) == TOKEN_NAME)
			lex_next(&lex);
	}
	return lex_is(&lex, "(") || lex_is(&lex, ";");
}

/* @lex: without newlines and comments. */
static enum st_kind kind_at(const struct st_reader *s, const struct lex *lex)
{
	const struct st_block *block = s->depth > 0 ? &s->block[s->depth - 1] : NULL;

	for (int i = 0; i < ST_KINDS && lex->token.kind == TOKEN_NAME; i++)
		if (*st_form((enum st_kind)i)->word && lex_is(lex, st_form((enum st_kind)i)->word))
			return (enum st_kind)i;
	if (lex_is(lex, ";"))
		return ST_EMPTY;
	if (block && block->kind == ST_CASE && !block->other && st_is_choice(*lex))
		return ST_CHOICE;
	return is_call(*lex) ? ST_CALL : ST_ASSIGN;
}

/* Does a statement or the end of the POU begin here, by its word? */
static bool begins_statement(const struct st_reader *s)
{
	for (int i = 0; i < ST_KINDS; i++)
		if (*st_form((enum st_kind)i)->word &&
		    lex_is(&s->r->lex, st_form((enum st_kind)i)->word))
			return true;
	return read_ends_block(s->r);
}

/* After an error: behind the next ; or before a word that begins a statement on a line of its
 * own. */
static void st_skip(struct st_reader *s)
{
	bool fresh = false;

	for (; s->r->lex.token.kind != TOKEN_END; st_step(s)) {
		if (fresh && begins_statement(s))
			return;
		fresh = s->r->lex.token.kind == TOKEN_NEWLINE;
		if (lex_is(&s->r->lex, ";")) {
			st_step(s);
			return;
		}
	}
}

/* The lexer on the last token before @stop that is no comment; @first: on the first one. */
static struct lex last_token(const struct lex *first, const char *stop)
{
	struct lex lex = *first, last = *first;

	lex.newlines = lex.comments = false;
	lex.end = stop;
	while (lex_next(&lex) != TOKEN_END)
		last = lex;
	last.end = first->end;
	last.newlines = last.comments = true;
	return last;
}

static void go_behind(struct st_reader *s, const struct lex *token)
{
	s->r->lex = *token;
	s->r->lex.newlines = s->r->lex.comments = true;
	st_step(s);
}

/* Comments between the statement and its ; stand behind it. */
static void add_inner_comments(struct st_reader *s, struct lex last, const char *stop)
{
	last.newlines = false;
	last.end = stop;
	while (lex_next(&last) == TOKEN_COMMENT)
		add_comment(s, &last.token, true);
}

/* The ; behind @last is missing. */
static void said_semicolon(struct st_reader *s, const struct token *last)
{
	char text[LIMIT_ARG];
	struct token behind = *last;

	snprintf(text, sizeof(text), "%.*s", last->len < LIMIT_ARG ? (int)last->len : LIMIT_ARG - 1,
		 last->text);
	behind.column += (int)last->len;
	st_said(s, DIAG_ST_SEMICOLON, &behind, text);
}

/* The statement is from @first to the token before @lex, where its end should stand. Leaves
 * the reader behind it. */
static bool take_statement(struct st_reader *s, enum st_kind kind, const struct lex *first,
			   struct lex *lex)
{
	const char *end = st_form(kind)->end;
	const struct token stop = lex->token;

	if (kind == ST_EMPTY) {
		go_behind(s, lex);
		return true;
	}
	const struct lex last = last_token(first, stop.text);
	const bool closed = *end && lex_is(lex, end);

	if (*end && !closed && strcmp(end, ";") != 0)
		return said_of(s, DIAG_EXPECTED, &stop, end);
	if (*end && !closed && !st_form(kind)->closes && stop.kind != TOKEN_END &&
	    stop.kind != TOKEN_NAME)
		return said_of(s, DIAG_SYNTAX, &stop, "");
	if (*end && !closed && !st_form(kind)->closes) /* it is clear what was meant */
		said_semicolon(s, &last.token);
	add_item(s, kind, &first->token, (size_t)(last.token.text + last.token.len -
						  first->token.text));
	if (!closed) {
		go_behind(s, &last);
		return true;
	}
	add_inner_comments(s, last, stop.text);
	if (kind == ST_UNTIL) { /* END_REPEAT; */
		struct lex ahead = *lex;

		if (lex_next(&ahead) == TOKEN_SYMBOL && lex_is(&ahead, ";"))
			*lex = ahead;
	}
	go_behind(s, lex);
	return true;
}

/* Reads the parts of the statement at @lex; leaves it at its end. */
static bool read_parts(struct st_reader *s, enum st_kind kind, struct lex *lex)
{
	struct st_walk walk = { .lex = *lex, .kind = kind };
	struct st_part part;

	do {
		if (!st_next(&walk, &part, &s->r->expr, s->r->diags, s->r->place)) {
			*lex = walk.lex;
			return false;
		}
	} while (part.role != ST_NO_PART);
	*lex = walk.lex;
	return true;
}

static bool is_begin(enum st_kind kind)
{
	for (size_t i = 0; i < PAIRS; i++)
		if (pairs[i].begin == kind)
			return true;
	return false;
}

static bool may_stand(struct st_reader *s, enum st_kind kind)
{
	const struct st_block *block = innermost(s);

	if (st_form(kind)->closes)
		return in_block(s, kind);
	if ((kind == ST_EXIT || kind == ST_CONTINUE) && !has_block(s, ST_FOR) &&
	    !has_block(s, ST_WHILE) && !has_block(s, ST_REPEAT))
		return said_of(s, DIAG_ST_NO_LOOP, &s->r->lex.token, "");
	if (block && block->kind == ST_CASE && !block->choice && kind != ST_EMPTY)
		return said_of(s, DIAG_ST_NO_CHOICE, &s->r->lex.token, "");
	return true;
}

/* How deep the item of a statement stands: a choice inside its CASE, ELSE beside its IF. */
static int depth_of(const struct st_reader *s, enum st_kind kind)
{
	int depth = 0;

	for (int i = 0; i < s->depth; i++)
		depth += 1 + (s->block[i].kind == ST_CASE);
	if (s->depth > 0 && (kind == ST_ELSE || kind == ST_ELSIF))
		depth -= 1 + (s->block[s->depth - 1].kind == ST_CASE);
	else if (kind == ST_CHOICE)
		depth--;
	return depth < UINT8_MAX ? depth : UINT8_MAX;
}

static void read_statement(struct st_reader *s)
{
	struct reader *r = s->r;
	struct lex lex = r->lex;
	const struct lex first = lex;
	enum st_kind kind;
	bool good;

	lex.newlines = lex.comments = false;
	kind = kind_at(s, &lex);
	good = may_stand(s, kind);
	const int depth = depth_of(s, kind);
	const int count = s->st->count;

	if (good && is_begin(kind))
		good = open_block(s, kind);
	if (!read_parts(s, kind, &lex))
		good = false;
	if (good)
		good = take_statement(s, kind, &first, &lex);
	for (int i = count; good && i < s->st->count; i++)
		s->st->item[i].depth = (uint8_t)depth;
	if (good)
		return;
	r->lex = lex;
	r->lex.newlines = r->lex.comments = true;
	st_skip(s);
}

void read_st(struct reader *r, struct pou *pou)
{
	struct st_reader *s = arena_alloc(&r->project->arena, sizeof(*s));

	pou->st = arena_alloc(&r->project->arena, sizeof(*pou->st));
	if (!s || !pou->st) {
		r->no_memory = true;
		return;
	}
	*s = (struct st_reader){ .r = r, .st = pou->st };
	if (r->above.len > 0) {
		struct st_item *item = add_item(s, ST_COMMENT, &r->lex.token, 0);

		if (item)
			item->text = buffer_take(r, &r->above);
	}
	while (r->lex.token.kind != TOKEN_END && !r->no_memory && !read_ends_block(r)) {
		if (r->lex.token.kind == TOKEN_NEWLINE) {
			s->lines++;
			st_step(s);
		} else if (s->comment) {
			add_comment(s, &r->lex.token, s->lines == 0 && s->st->count > 0);
			s->st->item[s->st->count - 1].depth = (uint8_t)depth_of(s, ST_ASSIGN);
			st_step(s);
		} else {
			read_statement(s);
		}
	}
	while (s->depth > 0)
		drop_block(s);
}
