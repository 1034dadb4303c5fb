/* SPDX-License-Identifier: MIT
 *
 * read_st - a body of Structured Text, up to END_PROGRAM and the like.
 *
 * It cuts the text into statements and knows which block is open. model/st.h knows the parts of a
 * statement; check/ looks at names and types.
 */
#include "engine/text/reader.h"

#include "engine/base/ascii.h"
#include "engine/base/iec.h"
#include "engine/model/dialect.h"

#include <stdio.h>
#include <stdlib.h>
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
	int first;           /* of its items: those before belong to other actions */
	struct st_block block[LIMIT_ST_DEPTH];
	int depth;
	int lines;           /* newlines since the last item                  */
	bool comment;        /* the token is a comment or a pragma            */
	bool empty;          /* a ; alone was read                            */
	enum { JUMPS_UNKNOWN, JUMPS_NO, JUMPS_YES } jumps; /* JMP stands behind the first doubt */
	struct lex body;     /* before its first token                        */
	uint32_t *target;    /* of all JMP of the body: folded names; when they were looked for */
	int targets;
	bool looked;
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

/* The name is @token's, and @more; the place is @at. */
static bool said_at(struct st_reader *s, enum diag_id id, const struct token *at,
		    const struct token *token, const char *more)
{
	char text[2 * LIMIT_ARG];
	const int len = token->len < LIMIT_ARG / 2 ? (int)token->len : LIMIT_ARG / 2;

	snprintf(text, sizeof(text), "%.*s%s%.60s", len, token->text, *more ? DIAG_AND : "", more);
	return st_said(s, id, at, text);
}

static bool said_of(struct st_reader *s, enum diag_id id, const struct token *at, const char *more)
{
	return said_at(s, id, at, at, more);
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
		.kind = (uint8_t)kind, .gap = s->lines > 1 && st->count > s->first + 1,
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

/* From a [ to the ] that closes it, or to the end of the statement. */
static void to_bracket(struct lex *lex)
{
	int open = 0;

	for (; !lex_is(lex, ";") && lex->token.kind != TOKEN_END; lex_next(lex)) {
		open += lex_is(lex, "[");
		open -= lex_is(lex, "]");
		if (open == 0)
			return;
	}
}

/* Is `name[…]^.name (` or a name alone with ; here? */
static bool is_call(struct lex lex)
{
	if (lex.token.kind != TOKEN_NAME)
		return false;
	lex_next(&lex);
	while (lex_is(&lex, "[") || lex_is(&lex, "^")) {
		if (lex_is(&lex, "["))
			to_bracket(&lex);
		if (lex_next(&lex) == TOKEN_SYMBOL && lex_is(&lex, ".") && lex_next(&lex) == TOKEN_NAME)
			lex_next(&lex);
	}
	return lex_is(&lex, "(") || lex_is(&lex, ";");
}

/* Does `:=` come before the next ;? */
static bool stores(struct lex lex)
{
	while (!lex_is(&lex, ";") && lex.token.kind != TOKEN_END)
		if (lex_is(&lex, ":="))
			return true;
		else
			lex_next(&lex);
	return false;
}

static bool begins_word(const struct lex *lex)
{
	for (int i = 0; i < ST_SET; i++)
		if (*st_form((enum st_kind)i)->word && lex_is(lex, st_form((enum st_kind)i)->word))
			return true;
	return false;
}

/* Does the rest of the body have a JMP? It is looked for once. */
static bool has_jumps(struct st_reader *s, struct lex lex)
{
	if (s->jumps == JUMPS_UNKNOWN)
		s->jumps = JUMPS_NO;
	else
		return s->jumps == JUMPS_YES;
	for (; lex.token.kind != TOKEN_END && !lex_is(&lex, "END_PROGRAM") &&
	       !lex_is(&lex, "END_FUNCTION") && !lex_is(&lex, "END_FUNCTION_BLOCK"); lex_next(&lex))
		if (lex_is(&lex, "JMP"))
			s->jumps = JUMPS_YES;
	return s->jumps == JUMPS_YES;
}

/* The labels to which JMP leads, from the whole body. They are looked for once. */
static void find_targets(struct st_reader *s)
{
	struct names *names = &s->r->project->names;
	struct lex lex = s->body;
	uint32_t *target;

	s->looked = true;
	lex.newlines = lex.comments = false;
	for (; lex.token.kind != TOKEN_END && !lex_is(&lex, "END_PROGRAM") && !lex_is(&lex, "END_FUNCTION") &&
	       !lex_is(&lex, "END_FUNCTION_BLOCK") && !lex_is(&lex, "END_ACTION") &&
	       !lex_is(&lex, "END_EXECUTE"); lex_next(&lex)) {
		if (!lex_is(&lex, "JMP"))
			continue;
		lex_next(&lex);
		target = arena_push(&s->r->project->arena, &s->target, &s->targets, sizeof(*target));
		if (!target) {
			s->r->no_memory = true;
			return;
		}
		*target = names_fold(names, reader_intern(s->r, lex.token.text, lex.token.len));
	}
}

/* `Name:` in a CASE: a label, not a value, as a JMP leads to it. */
static bool is_case_label(struct st_reader *s, struct lex lex)
{
	const struct token name = lex.token;
	uint32_t fold;

	if (name.kind != TOKEN_NAME || lex_next(&lex) != TOKEN_SYMBOL || !lex_is(&lex, ":"))
		return false;
	if (!s->looked)
		find_targets(s);
	fold = s->targets ? names_fold(&s->r->project->names, reader_intern(s->r, name.text, name.len)) : 0;
	for (int i = 0; i < s->targets; i++)
		if (s->target[i] == fold)
			return true;
	return false;
}

/* `Label:` before a statement; `Name : value` is one with a wrong sign. */
static bool is_label(struct st_reader *s, struct lex lex)
{
	const int line = lex.token.line;

	if (lex.token.kind != TOKEN_NAME)
		return false;
	lex_next(&lex);
	if (!lex_is(&lex, ":") || (lex.at < lex.end && *lex.at == ':'))
		return false;
	lex_next(&lex);
	return lex_is(&lex, ";") || lex.token.line > line || lex.token.kind == TOKEN_END || begins_word(&lex) ||
	       (lex.token.kind == TOKEN_NAME && (stores(lex) || has_jumps(s, lex)));
}

/* @lex: without newlines and comments. */
static enum st_kind kind_at(struct st_reader *s, const struct lex *lex)
{
	const struct st_block *block = s->depth > 0 ? &s->block[s->depth - 1] : NULL;

	const char first = lex->token.len ? ascii_upper(*lex->token.text) : '\0';

	for (int i = 0; i < ST_SET && lex->token.kind == TOKEN_NAME; i++) {
		const char *word = st_form((enum st_kind)i)->word;

		if (*word == first && lex_is(lex, word))
			return (enum st_kind)i;
	}
	if (lex_is(lex, ";"))
		return ST_EMPTY;
	if (block && block->kind == ST_CASE && block->choice && !block->other && is_case_label(s, *lex))
		return ST_LABEL;
	if (block && block->kind == ST_CASE && !block->other &&
	    (st_is_choice(*lex) || lex->token.kind == TOKEN_NUMBER))
		return ST_CHOICE;
	if (is_label(s, *lex))
		return ST_LABEL;
	return is_call(*lex) ? ST_CALL : ST_ASSIGN;
}

/* Does a statement or the end of the POU begin here, by its word? */
static bool begins_statement(const struct st_reader *s)
{
	for (int i = 0; i < ST_SET; i++)
		if (*st_form((enum st_kind)i)->word &&
		    lex_is(&s->r->lex, st_form((enum st_kind)i)->word))
			return true;
	return read_ends_block(s->r);
}

/* Does `name :=` or `name(` begin here, as a statement does? */
static bool begins_plain(struct lex lex)
{
	if (lex.token.kind != TOKEN_NAME)
		return false;
	lex.newlines = lex.comments = false;
	lex_next(&lex);
	return lex_is(&lex, ":=") || lex_is(&lex, "(");
}

/* After an error: behind the next ;, behind @end on the line of the error, or before a line that begins
 * a statement. */
static void st_skip(struct st_reader *s, const char *end)
{
	const int line = s->r->lex.token.line;
	bool fresh = false;
	int open = 0;

	for (; s->r->lex.token.kind != TOKEN_END; st_step(s)) {
		const struct lex *lex = &s->r->lex;

		if (fresh && (begins_statement(s) || (open <= 0 && begins_plain(*lex))))
			return;
		fresh = lex->token.kind == TOKEN_NEWLINE;
		open += lex_is(lex, "(");
		open -= lex_is(lex, ")");
		if ((lex_is(lex, ";") && !(*end && lex->token.line == line)) ||
		    (*end && lex->token.line == line && lex_is(lex, end))) {
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

/* The ; behind @last is missing; or a quote, which would come before it. */
static void said_semicolon(struct st_reader *s, const struct token *last)
{
	char text[LIMIT_ARG];
	struct token behind = *last;

	if (*last->text == '\'' && (last->len < 2 || last->text[last->len - 1] != '\'')) {
		said_of(s, DIAG_OPEN_STRING, last, "");
		return;
	}

	snprintf(text, sizeof(text), "%.*s", last->len < LIMIT_ARG ? (int)last->len : LIMIT_ARG - 1,
		 last->text);
	behind.column += (int)last->len;
	st_said(s, DIAG_ST_SEMICOLON, &behind, text);
}

/* THEN, DO, OF, the colon of a choice behind @last. */
static void said_missing(struct st_reader *s, const struct token *last, const char *word)
{
	struct token behind = *last;

	if (strlen(word) == last->len && ascii_same(last->text, word, last->len)) { /* IF A > THEN */
		said_of(s, DIAG_BAD_EXPRESSION, last, "");
		return;
	}
	behind.column += (int)last->len;
	said_at(s, DIAG_ST_MISSING, &behind, last, word);
}

static bool said_expected(struct st_reader *s, const char *word, const struct token *stop)
{
	char text[2 * LIMIT_ARG];

	snprintf(text, sizeof(text), "%s" DIAG_AND "%.*s", word, stop->len < LIMIT_ARG / 2 ? (int)stop->len :
		 LIMIT_ARG / 2, stop->text);
	return st_said(s, DIAG_EXPECTED, stop, text);
}

/* Is it clear that only the end of the statement's head is missing? */
static bool is_missing(enum st_kind kind, const struct token *last, const struct token *stop)
{
	if (stop->line > last->line || stop->kind == TOKEN_END)
		return true;
	if (kind == ST_CHOICE)
		return stop->kind == TOKEN_NAME;
	for (int i = 0; i < ST_SET; i++)
		if (*st_form((enum st_kind)i)->word && lex_is(&(struct lex){ .token = *stop },
							      st_form((enum st_kind)i)->word))
			return true;
	return false;
}

/* The statement is from @first to the token before @lex, where its end should stand. Leaves
 * the reader behind it. */
static bool take_statement(struct st_reader *s, enum st_kind kind, const struct lex *first,
			   struct lex *lex)
{
	const char *end = st_form(kind)->end;
	const struct token stop = lex->token;

	if (kind == ST_EMPTY) {
		s->empty = true;
		go_behind(s, lex);
		return true;
	}
	const struct lex last = last_token(first, stop.text);
	const bool closed = *end && lex_is(lex, end);

	if (*end && !closed && strcmp(end, ";") != 0) {
		if (!is_missing(kind, &last.token, &stop))
			return said_expected(s, end, &stop);
		said_missing(s, &last.token, end);
	} else if (*end && !closed && !st_form(kind)->closes && stop.kind != TOKEN_END &&
		   stop.kind != TOKEN_NAME && stop.line == last.token.line) {
		return said_of(s, DIAG_SYNTAX, &stop, "");
	}
	if (strcmp(end, ";") == 0 && !closed && !st_form(kind)->closes) /* it is clear what was meant */
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

		if (lex_next(&ahead) == TOKEN_SYMBOL && lex_is(&ahead, ";")) {
			struct lex closing = *lex;

			closing.comments = true;
			add_inner_comments(s, closing, ahead.token.text);
			*lex = ahead;
		}
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

/* ---- what people know from other languages ---- */

static const struct { const char *word, *right; enum st_kind kind; bool parens; } foreign[] = {
	{ "ELSEIF", "ELSIF", ST_ELSIF, true }, { "ELIF", "ELSIF", ST_ELSIF, true },
	{ "ELSE_IF", "ELSIF", ST_ELSIF, true },
	{ "ENDIF", "END_IF", ST_END_IF, false }, { "ENDCASE", "END_CASE", ST_END_CASE, false },
	{ "ENDFOR", "END_FOR", ST_END_FOR, false }, { "NEXT", "END_FOR", ST_END_FOR, false },
	{ "ENDWHILE", "END_WHILE", ST_END_WHILE, false }, { "WEND", "END_WHILE", ST_END_WHILE, false },
	{ "BREAK", "EXIT", ST_EXIT, false }, { "GOTO", "JMP", ST_JUMP, false },
	{ "SWITCH", "CASE … OF", ST_KINDS, true },
};

static bool said_foreign(struct st_reader *s, const struct token *at, const char *text, int len,
			 const char *right)
{
	const struct token wrong = { .text = text, .len = (size_t)len };

	return said_at(s, DIAG_ST_FOREIGN, at, &wrong, right);
}

/* The word at the lexer is taken for @word; st_next() reads on behind it. */
static void take_as(struct lex *lex, const char *word)
{
	lex->token.kind = TOKEN_NAME;
	lex->token.text = word;
	lex->token.len = strlen(word);
}

/* `END IF`, and END or } alone for the innermost block, as its right word. */
static enum st_kind split_end(struct st_reader *s, struct lex *lex)
{
	const struct token first = lex->token;
	const struct st_block *block = innermost(s);
	const bool brace = lex_is(lex, "}");
	struct lex ahead = *lex;

	if (!lex_is(lex, "END") && !brace)
		return ST_KINDS;
	lex_next(&ahead);
	for (size_t i = 0; i < PAIRS; i++) {
		const bool named = !brace && lex_is(&ahead, st_form(pairs[i].begin)->word);

		if (pairs[i].begin == ST_REPEAT ||
		    (!named && !(block && block->kind == pairs[i].begin && (brace || lex_is(&ahead, ";")))))
			continue;
		if (named)
			*lex = ahead;
		said_foreign(s, &first, first.text,
			     (int)(lex->token.text + lex->token.len - first.text), pairs[i].word);
		take_as(lex, pairs[i].word);
		return pairs[i].end;
	}
	return ST_KINDS;
}

/* Reports a word of another language, and reads it as the right one. ST_KINDS: it is no such word, or @told. */
static enum st_kind foreign_word(struct st_reader *s, struct lex *lex, bool *told)
{
	const struct st_block *block = innermost(s);
	struct lex ahead = *lex;
	const enum st_kind kind = split_end(s, lex);

	lex_next(&ahead);
	if (kind != ST_KINDS || lex->token.kind != TOKEN_NAME || lex_is(&ahead, ":=") ||
	    lex_is(&ahead, "[") || lex_is(&ahead, "."))
		return kind;
	if (block && block->kind == ST_CASE && lex_is(lex, "Default") && lex_is(&ahead, ":")) {
		take_as(lex, "ELSE"); /* the colon was reported */
		return ST_ELSE;
	}
	if (lex_is(lex, "END_REPEAT") && block && block->kind == ST_REPEAT) {
		drop_block(s);
		*told = true;
		return ST_KINDS;
	}
	if (lex_is(lex, "END_VAR")) {
		*told = true;
		said_of(s, DIAG_ST_NO_BEGIN, &lex->token, "VAR");
		return ST_KINDS;
	}
	for (size_t i = 0; i < sizeof(foreign) / sizeof(*foreign); i++) {
		if (!lex_is(lex, foreign[i].word) || (lex_is(&ahead, "(") && !foreign[i].parens) ||
		    lex_is(&ahead, ":"))
			continue;
		said_of(s, DIAG_ST_FOREIGN, &lex->token, foreign[i].right);
		*told = foreign[i].kind == ST_KINDS;
		if (!*told)
			take_as(lex, foreign[i].right);
		return foreign[i].kind;
	}
	return ST_KINDS;
}

/* Signs of other languages, from the first byte on. */
static const struct { const char *sign, *right; } signs[] = {
	{ "==", "=" }, { "!=", "<>" }, { "><", "<>" }, { "=<", "<=" }, { "=>", ">=" }, { "&&", "AND" },
	{ "||", "OR" }, { "!", "NOT" }, { "%", "MOD" }, { "+=", ":= … +" }, { "-=", ":= … -" },
	{ "*=", ":= … *" }, { "/=", ":= … /" }, { "++", ":= … + 1" }, { "--", ":= … - 1" },
	{ "::", ":=" }, { "=:", ":=" }, { ": =", ":=" }, { "#", "//" }, { "?", "IF … THEN … ELSE … END_IF" },
	{ "^", "EXPT(base, exponent)" },
};

/* A text in quotes of another kind, at @token. */
static bool said_quotes(struct st_reader *s, const struct token *token)
{
	const unsigned char *byte = (const unsigned char *)token->text;
	char right[LIMIT_ARG / 2];

	if (token->kind == TOKEN_STRING && *byte == '"' && token->len < sizeof(right)) {
		snprintf(right, sizeof(right), "'%.*s'", (int)token->len - 2, token->text + 1);
		said_of(s, DIAG_ST_FOREIGN, token, right);
		return true;
	}
	if (token->len < 3 || byte[0] != 0xe2 || byte[1] != 0x80 || byte[2] < 0x98 || byte[2] > 0x9f)
		return false;
	said_foreign(s, token, token->text, 3, "'");
	return true;
}

/* `Name += 1`: the sign is @at, its text @sign; `Name := Name +` is how @right says it. False: another sign. */
static bool said_changed(struct st_reader *s, const struct lex *first, const struct token *at, const char *sign,
			 const char *right)
{
	const char *name = first->token.text, *op = strncmp(right, ":= … ", 7) == 0 ? right + 7 : NULL;
	char text[LIMIT_ARG];
	int len = (int)(sign - name);

	while (len > 0 && (name[len - 1] == ' ' || name[len - 1] == '\t'))
		len--;
	if (!op || len <= 0 || len > 20 || memchr(name, '\n', (size_t)len))
		return false;
	snprintf(text, sizeof(text), "%.*s := %.*s %s%s", len, name, len, name, op, sign[1] == '=' ? " …" : "");
	said_foreign(s, at, sign, 2, text);
	return true;
}

/* S:FS, I:1/3: an address of another tool, at its colon. */
static bool said_elsewhere(struct st_reader *s, const struct lex *first, const struct token *token)
{
	struct token at = *token;
	struct dialect_special special = { "", "" };
	struct dialect found;
	char address[40];

	if (token->len != 1 || *token->text != ':')
		return false;
	at.len = dialect_around(first->token.text, first->end, token->text, &at.text);
	at.column -= (int)(token->text - at.text);
	if (dialect_special(at.text, at.len, &special) && !*special.ours) {
		said_of(s, DIAG_SPECIAL_NOTHING, &at, "");
	} else if (*special.ours) {
		said_of(s, DIAG_ST_FOREIGN, &at, special.ours);
	} else if (dialect_find(at.text, at.len, 0, &found) && found.kind == DIALECT_ADDRESS) {
		iec_addr_print(found.addr, address, sizeof(address));
		said_of(s, DIAG_ST_FOREIGN, &at, address);
	} else {
		return false;
	}
	return true;
}

/* Does a type stand behind the colon at @lex? */
static bool is_type(struct lex lex)
{
	lex_next(&lex);
	return iec_type_find(lex.token.text, lex.token.len) != IEC_NONE || lex_is(&lex, "ARRAY") ||
	       lex_is(&lex, "POINTER") || lex_is(&lex, "REF_TO");
}

/* Why the statement from @first on cannot be read at @lex, if something of another language is the reason. */
static bool said_sign(struct st_reader *s, enum st_kind kind, const struct lex *first, const struct lex *lex)
{
	const struct token *token = &lex->token;
	const bool tests = st_form(kind)->tests;
	struct token at = *token;

	if (said_quotes(s, token) || said_elsewhere(s, first, token))
		return true;
	if (lex_is(first, "-") && first->token.text[1] == '-') {
		said_foreign(s, &first->token, first->token.text, 2, "//");
		return true;
	}
	if (tests && lex_is(lex, ":=")) {
		said_of(s, DIAG_ST_FOREIGN, token, "=");
		return true;
	}
	if (tests && lex_is(lex, "{")) {
		said_of(s, DIAG_ST_FOREIGN, token, st_form(kind)->end);
		return true;
	}
	for (int back = 0; back < 3; back++)
		for (size_t i = 0; i < sizeof(signs) / sizeof(*signs); i++) {
			const size_t len = strlen(signs[i].sign);
			const char *text = token->text - back;

			if (text < first->token.text || len > (size_t)(lex->end - text) ||
			    (len <= (size_t)back && back < 2) || memcmp(text, signs[i].sign, len) != 0 ||
			    (lex_is(lex, "=>") && kind == ST_CALL))
				continue;
			at.column -= back;
			if (!said_changed(s, first, &at, text, signs[i].right))
				said_foreign(s, &at, text, (int)len, signs[i].right);
			return true;
		}
	if (kind != ST_ASSIGN || !lex_is(lex, ":") || stores(*lex))
		return false;
	if (is_type(*lex)) {
		said_of(s, DIAG_ST_DECLARES, &first->token, "");
		return true;
	}
	said_of(s, DIAG_ST_FOREIGN, token, ":=");
	return true;
}

/* `FOR i = 1`: @lex is behind it. */
static bool said_for(struct st_reader *s, const struct lex *first)
{
	struct lex lex = *first, open;

	lex.newlines = lex.comments = false;
	lex_next(&lex);
	open = lex;
	lex_next(&lex);
	if (lex_is(&lex, "="))
		said_of(s, DIAG_ST_FOREIGN, &lex.token, ":=");
	else if (lex_is(&open, "("))
		said_of(s, DIAG_ST_FOREIGN, &open.token, "FOR i := 1 TO 10 DO");
	else
		return false;
	return true;
}

static bool is_digit(char byte)
{
	return byte >= '0' && byte <= '9';
}

/* `1,5` and `.5` at @lex. */
static bool said_number(struct st_reader *s, const struct lex *first, const struct lex *lex)
{
	const char *sign = lex->token.text, *from = sign, *to = sign + 1;
	char right[40];
	struct token at = lex->token;

	if (to >= lex->end || (*sign != ',' && *sign != '.') || !is_digit(*to))
		return false;
	while (from > first->token.text && is_digit(from[-1]))
		from--;
	while (to < lex->end && is_digit(*to))
		to++;
	if (to - from > 30 || (*sign == ',' && from == sign))
		return false;
	at.column -= (int)(sign - from);
	snprintf(right, sizeof(right), "%.*s.%.*s", from == sign ? 1 : (int)(sign - from),
		 from == sign ? "0" : from, (int)(to - sign - 1), sign + 1);
	return !said_foreign(s, &at, from, (int)(to - from), right);
}

/* Removes the messages since @count and @errors: there is a better one. */
static void said_better(struct st_reader *s, enum st_kind kind, const struct lex *first,
			const struct lex *lex, int count, int errors)
{
	struct diag_list *diags = s->r->diags;
	const struct diag kept = count < diags->count ? diags->diag[count] : (struct diag){ .line = 0 };
	const int now = diags->count, now_errors = diags->errors;

	if (now != count + 1 || diags->dropped > 0)
		return;
	diags->count = count;
	diags->errors = errors;
	if ((kind == ST_FOR && said_for(s, first)) || said_sign(s, kind, first, lex))
		return;
	if (kind == ST_ASSIGN && iec_type_find(first->token.text, first->token.len) && lex->token.kind == TOKEN_NAME) {
		said_of(s, DIAG_ST_DECLARES, &first->token, "");
		return;
	}
	if (said_number(s, first, lex))
		return;
	if (lex_is(lex, "STEP") && kind == ST_FOR) {
		said_of(s, DIAG_ST_FOREIGN, &lex->token, "BY");
		return;
	}
	diags->diag[count] = kept;
	diags->count = now;
	diags->errors = now_errors;
}

/* VAR … END_VAR between statements: reports it, and skips it. */
static bool skip_declarations(struct st_reader *s)
{
	static const char *const heads[] = { "VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP" };
	struct lex *lex = &s->r->lex;
	bool here = false;

	for (size_t i = 0; i < sizeof(heads) / sizeof(*heads); i++)
		here |= lex_is(lex, heads[i]);
	if (!here)
		return false;
	said_of(s, DIAG_ST_DECLARES, &lex->token, "");
	while (lex->token.kind != TOKEN_END && !lex_is(lex, "END_VAR"))
		st_step(s);
	if (lex_is(lex, "END_VAR"))
		st_step(s);
	return true;
}

static void read_statement(struct st_reader *s)
{
	struct reader *r = s->r;
	struct lex lex = r->lex;
	const struct lex first = lex;
	const int said = r->diags->count, errors = r->diags->errors;
	enum st_kind kind;
	bool good, told = false;

	lex.newlines = lex.comments = false;
	kind = foreign_word(s, &lex, &told);
	if (told) {
		st_skip(s, "");
		return;
	}
	if (kind == ST_KINDS)
		kind = kind_at(s, &lex);
	good = may_stand(s, kind);
	const int depth = depth_of(s, kind);
	const int count = s->st->count;

	if (good && is_begin(kind))
		good = open_block(s, kind);
	if (!read_parts(s, kind, &lex))
		good = false;
	if (kind == ST_ELSE && lex_is(&lex, ":")) {
		said_foreign(s, &first.token, first.token.text,
			     (int)(lex.token.text + 1 - first.token.text), "ELSE");
		lex_next(&lex);
	}
	if (kind == ST_RETURN && !lex_is(&lex, ";") && lex.token.line == first.token.line)
		good = said_foreign(s, &first.token, first.token.text,
				    (int)(lex.token.text + lex.token.len - first.token.text),
				    "Name := …; RETURN; with the name of the function");
	if (good)
		good = take_statement(s, kind, &first, &lex);
	for (int i = count; good && i < s->st->count; i++)
		s->st->item[i].depth = (uint8_t)depth;
	if (good)
		return;
	said_better(s, kind, &first, &lex, said, errors);
	r->lex = lex;
	r->lex.newlines = r->lex.comments = true;
	st_skip(s, st_form(kind)->opens ? st_form(kind)->end : "");
}

/* A body of ; alone keeps one: without it, comments would stand behind no statement. */
static void keep_empty(struct st_reader *s)
{
	for (int i = s->first; i < s->st->count; i++)
		if (s->st->item[i].kind != ST_COMMENT)
			return;
	s->lines = 0;
	if (s->empty)
		add_item(s, ST_EMPTY, &s->r->lex.token, 0);
}

/* Owns: the caller, free(). NULL: no memory. */
static struct st_reader *new_st(struct reader *r, struct pou *pou)
{
	struct st_reader *s = malloc(sizeof(*s));

	if (!pou->st)
		pou->st = arena_alloc(&r->project->arena, sizeof(*pou->st));
	if (!s || !pou->st) {
		r->no_memory = true;
		free(s);
		return NULL;
	}
	*s = (struct st_reader){ .r = r, .st = pou->st, .first = pou->st->count };
	return s;
}

static void read_statements(struct st_reader *s)
{
	struct reader *r = s->r;

	s->body = r->lex;
	while (r->lex.token.kind != TOKEN_END && !r->no_memory && (skip_declarations(s) || !read_ends_block(r))) {
		if (r->lex.token.kind == TOKEN_NEWLINE) {
			s->lines++;
			st_step(s);
		} else if (s->comment) {
			add_comment(s, &r->lex.token, s->lines == 0 && s->st->count > s->first);
			if (!r->no_memory)
				s->st->item[s->st->count - 1].depth = (uint8_t)depth_of(s, ST_ASSIGN);
			st_step(s);
		} else {
			read_statement(s);
		}
	}
	while (s->depth > 0)
		drop_block(s);
	keep_empty(s);
}

/* Comments above the body become its first ones. */
static void take_above(struct st_reader *s)
{
	const uint32_t above = buffer_take(s->r, &s->r->above);
	struct lex lex;

	lex_init(&lex, names_text(&s->r->project->names, above), names_len(&s->r->project->names, above));
	lex.comments = true;
	while (comment_next(&lex)) {
		struct token comment = lex.token;

		comment.line = s->r->lex.token.line;
		comment.column = s->r->lex.token.column;
		s->lines = 1;
		add_comment(s, &comment, false);
	}
}

void read_st_behind(struct reader *r, struct pou *pou)
{
	struct st_reader *s = new_st(r, pou);

	if (!s)
		return;
	take_above(s);
	st_step(s);
	read_statements(s);
	free(s);
}

void read_st(struct reader *r, struct pou *pou)
{
	struct st_reader *s = new_st(r, pou);

	if (!s)
		return;
	if (r->above.len > 0) {
		struct st_item *item = add_item(s, ST_COMMENT, &r->lex.token, 0);

		if (item)
			item->text = buffer_take(r, &r->above);
	}
	read_statements(s);
	free(s);
}
