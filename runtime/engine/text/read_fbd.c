/* SPDX-License-Identifier: MIT
 *
 * read_fbd - a body in Function Block Diagram, up to END_PROGRAM and the like (docs/fbd.md).
 *
 * It cuts the text into networks and lines. model/st.h knows the parts of a line; check/ looks at names and
 * types, and finds the wires.
 */
#include "engine/text/reader.h"

#include "engine/base/ascii.h"
#include "engine/model/fbd.h"
#include "engine/model/dialect.h"

#include <stdio.h>
#include <string.h>

struct fbd_reader {
	struct reader *r;
	struct pou *pou;
	struct fbd_network *network; /* the present one                       */
	int lines;                   /* newlines since the last item          */
	bool comment;                /* the token is a comment or a pragma    */
	bool full;                   /* there are too many networks           */
};

/* The next token, newlines and comments too. */
static void fbd_step(struct fbd_reader *f)
{
	while (!(f->comment = reader_scan(f->r)) && f->r->lex.token.kind == TOKEN_BAD)
		reader_fail_bad(f->r);
}

static bool said_at(struct fbd_reader *f, enum diag_id id, const struct token *at)
{
	struct diag place = f->r->place;

	place.id = id;
	place.line = at->line;
	place.column = at->column;
	return diag_add(f->r->diags, place, "%.*s", at->len < LIMIT_ARG ? (int)at->len : LIMIT_ARG, at->text);
}

/* ---- headings ---- */

/* Does a network begin here? A variable may have the name. */
static bool begins_network(const struct reader *r)
{
	return lex_is(&r->lex, "NETWORK") && !reader_peek(r, ":=") && !reader_peek(r, "(") &&
	       !reader_peek(r, "[") && !reader_peek(r, ".");
}

static void read_heading(struct fbd_reader *f, struct fbd_network *network)
{
	struct reader *r = f->r;
	const bool wide = r->lex.wide;

	r->lex.wide = false; /* a title in quotes */
	reader_next(r);
	if (lex_is(&r->lex, "OFF")) {
		network->off = true;
		reader_next(r);
	}
	if (r->lex.token.kind == TOKEN_NAME) {
		if (!reader_name(r, "label", &network->label)) {
			reader_skip_line(r);
			r->lex.wide = wide;
			return;
		}
		reader_next(r);
	}
	if (r->lex.token.kind == TOKEN_STRING && reader_string(r, &network->title))
		reader_next(r);
	if (!reader_at_end(r)) {
		said_at(f, DIAG_FBD_HEADING, &r->lex.token);
		while (!reader_at_end(r))
			reader_next(r);
	}
	r->lex.wide = wide;
}

/* ---- lines ---- */

static struct st_item *add_item(struct fbd_reader *f, enum st_kind kind, const struct token *first, size_t len)
{
	struct st *st = f->pou->st;
	struct st_item *item = arena_push(&f->r->project->arena, &st->item, &st->count, sizeof(*item));

	if (!item) {
		f->r->no_memory = true;
		return NULL;
	}
	*item = (struct st_item){
		.kind = (uint8_t)kind, .gap = f->lines > 1 && f->network->count > 0,
		.text = reader_intern(f->r, first->text, len), .line = first->line, .column = first->column,
	};
	f->network->count++;
	f->lines = 0;
	return item;
}

static struct st_item *last_item(struct fbd_reader *f)
{
	return f->network->count > 0 ? &f->pou->st->item[f->pou->st->count - 1] : NULL;
}

static void add_comment(struct fbd_reader *f, const struct token *comment)
{
	struct st_item *last = last_item(f), *item;
	size_t len = comment->len;
	bool behind = f->lines == 0 && last;
	uint8_t column, row;

	if (fbd_hint(comment->text, len, &column, &row)) {
		if (!behind || last->kind == ST_COMMENT || last->at_column) {
			said_at(f, DIAG_FBD_HINT, comment);
			return;
		}
		last->at_column = column;
		last->at_row = row;
		return;
	}
	if (*comment->text == '{' && ascii_same(comment->text + 1 + strspn(comment->text + 1, " "), "at ", 3)) {
		said_at(f, DIAG_FBD_HINT, comment);
		return;
	}
	while (comment->text[1] == '/' && (comment->text[len - 1] == ' ' || comment->text[len - 1] == '\t'))
		len--;
	item = add_item(f, ST_COMMENT, comment, len);
	if (item)
		item->behind = behind;
}

/* The lexer on the last token of the line that begins at @first, and what ends the line. */
static struct lex line_end(const struct lex *first, struct token *stop)
{
	struct lex lex = *first, last = *first;
	int open = 0;

	lex.newlines = true;
	lex.comments = false;
	for (; lex.token.kind != TOKEN_END; lex_next(&lex)) {
		const bool fresh = last.token.line != lex.token.line;

		if (open <= 0 && (lex.token.kind == TOKEN_NEWLINE || lex_is(&lex, ";") || lex_is(&lex, "{")))
			break;
		if (lex.token.kind == TOKEN_NEWLINE)
			continue;
		if (fresh && (lex_is(&lex, "NETWORK") || (lex.token.len > 4 && ascii_same(lex.token.text, "END_", 4))))
			break;
		open += lex_is(&lex, "(") || lex_is(&lex, "[");
		open -= lex_is(&lex, ")") || lex_is(&lex, "]");
		last = lex;
	}
	*stop = lex.token;
	return last;
}

/* `STOP` alone or before IF: elsewhere it is a name. */
static bool stops(struct lex lex)
{
	if (!lex_accept(&lex, "STOP"))
		return false;
	return lex.token.kind == TOKEN_END || lex_is(&lex, "IF");
}

/* What the line is, from its signs outside of parentheses. @lex: only this line. */
static enum st_kind kind_of_line(struct lex lex)
{
	struct token before = { .kind = TOKEN_END };
	bool called = false;
	int open = 0;

	if (lex_is(&lex, "JMP"))
		return ST_JUMP_IF;
	if (lex_is(&lex, "RETURN"))
		return ST_RETURN_IF;
	if (stops(lex))
		return ST_STOP_IF;
	for (; lex.token.kind != TOKEN_END; lex_next(&lex)) {
		const bool operand = before.kind == TOKEN_NAME || before.kind == TOKEN_ADDRESS ||
				     (before.kind == TOKEN_SYMBOL && *before.text == ']');
		struct lex ahead = lex;

		lex_next(&ahead);
		if (open == 0 && lex_is(&lex, ":="))
			return ST_ASSIGN;
		if (open == 0 && operand && lex_is(&ahead, "=") && (lex_is(&lex, "S") || lex_is(&lex, "R")))
			return lex_is(&lex, "S") ? ST_SET : ST_RESET;
		called |= open == 0 && operand && lex_is(&lex, "(");
		open += lex_is(&lex, "(") || lex_is(&lex, "[");
		open -= lex_is(&lex, ")") || lex_is(&lex, "]");
		before = lex.token;
	}
	return called ? ST_CALL : ST_ASSIGN;
}

/* A statement of Structured Text that a network has not. */
static bool said_statement(struct fbd_reader *f, struct lex lex)
{
	static const struct { const char *word; enum diag_id id; } words[] = {
		{ "IF", DIAG_FBD_CHOICE }, { "ELSIF", DIAG_FBD_CHOICE }, { "ELSE", DIAG_FBD_CHOICE },
		{ "END_IF", DIAG_FBD_CHOICE }, { "CASE", DIAG_FBD_CHOICE }, { "END_CASE", DIAG_FBD_CHOICE },
		{ "FOR", DIAG_FBD_LOOP }, { "END_FOR", DIAG_FBD_LOOP }, { "WHILE", DIAG_FBD_LOOP },
		{ "END_WHILE", DIAG_FBD_LOOP }, { "REPEAT", DIAG_FBD_LOOP }, { "UNTIL", DIAG_FBD_LOOP },
		{ "END_REPEAT", DIAG_FBD_LOOP }, { "EXIT", DIAG_FBD_LOOP }, { "CONTINUE", DIAG_FBD_LOOP },
	};
	const struct token first = lex.token;

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (lex_is(&lex, words[i].word)) {
			lex_next(&lex);
			return lex_is(&lex, ":=") || lex_is(&lex, "(") ? false : !said_at(f, words[i].id, &first);
		}
	if (lex.token.kind != TOKEN_NAME || lex_next(&lex) != TOKEN_SYMBOL || !lex_is(&lex, ":"))
		return false;
	return !said_at(f, DIAG_FBD_LABEL_LINE, &first);
}

/* `A := B := 1`: @lex is at A. */
static bool said_chain(struct fbd_reader *f, struct lex lex)
{
	int open = 0, stores = 0;

	for (; lex.token.kind != TOKEN_END; lex_next(&lex)) {
		open += lex_is(&lex, "(") || lex_is(&lex, "[");
		open -= lex_is(&lex, ")") || lex_is(&lex, "]");
		stores += open == 0 && lex_is(&lex, ":=");
		if (stores > 1)
			return !said_at(f, DIAG_FBD_CHAIN, &lex.token);
	}
	return false;
}

/* The line has errors. If it only ends too early, that is the only message. */
static bool said_end(struct fbd_reader *f, const struct lex *lex, int count, int errors)
{
	struct diag_list *diags = f->r->diags;
	struct token end = lex->token;

	if (end.kind != TOKEN_END || diags->count != count + 1 || diags->dropped > 0 ||
	    (diags->diag[count].id != DIAG_BAD_EXPRESSION && diags->diag[count].id != DIAG_EXPECTED))
		return false;
	diags->count = count;
	diags->errors = errors;
	end.text = "";
	end.len = 0;
	return said_at(f, DIAG_FBD_LINE_ENDS, &end);
}

/* S:FS, I:1/3: an address of another tool gets its own message, not one about the colon. */
static bool said_elsewhere(struct fbd_reader *f, const struct lex *line, const struct token *token, int count, int errors)
{
	struct diag_list *diags = f->r->diags;
	struct diag place = f->r->place;
	struct dialect_special special = { "", "" };
	struct dialect found;
	const char *text;
	char right[40] = "";
	size_t len;

	if (token->len != 1 || *token->text != ':' || diags->dropped > 0)
		return false;
	len = dialect_around(line->token.text, line->end, token->text, &text);
	if (dialect_special(text, len, &special))
		snprintf(right, sizeof(right), "%s", special.ours);
	else if (dialect_find(text, len, 0, &found) && found.kind == DIALECT_ADDRESS)
		iec_addr_print(found.addr, right, sizeof(right));
	else
		return false;
	diags->count = count;
	diags->errors = errors;
	place.id = *right ? DIAG_ST_FOREIGN : DIAG_SPECIAL_NOTHING;
	place.line = token->line;
	place.column = token->column - (int)(token->text - text);
	diag_add(diags, place, "%.*s%s%s", (int)(len < 40 ? len : 40), text, *right ? DIAG_AND : "", right);
	return true;
}

/* Reads the parts; @lex: only this line. */
static bool read_parts(struct fbd_reader *f, enum st_kind kind, const struct lex *lex)
{
	const int count = f->r->diags->count, errors = f->r->diags->errors;
	struct st_walk walk = { .lex = *lex, .kind = kind };
	struct st_part part;

	if (kind == ST_ASSIGN && said_chain(f, *lex))
		return false;
	do {
		if (!st_next(&walk, &part, &f->r->expr, f->r->diags, f->r->place))
			return !said_elsewhere(f, lex, &walk.lex.token, count, errors) &&
			       said_end(f, &walk.lex, count, errors);
	} while (part.role != ST_NO_PART);
	if (walk.lex.token.kind == TOKEN_END)
		return true;
	return !said_elsewhere(f, lex, &walk.lex.token, f->r->diags->count, f->r->diags->errors) &&
	       said_at(f, DIAG_FBD_REST, &walk.lex.token);
}

static void read_line(struct fbd_reader *f)
{
	struct reader *r = f->r;
	struct token stop;
	struct lex line = r->lex;
	const struct token first = line.token;
	const struct lex last = line_end(&r->lex, &stop);
	enum st_kind kind;

	line.end = last.token.text + last.token.len;
	line.newlines = line.comments = false;
	if (!said_statement(f, line)) {
		kind = kind_of_line(line);
		if (read_parts(f, kind, &line))
			add_item(f, kind, &first, (size_t)(line.end - first.text));
	}
	r->lex = last;
	r->lex.newlines = r->lex.comments = true;
	fbd_step(f);
}

/* ---- networks ---- */

/* Comments at the end stand above what follows: the next network, or the end of the POU. */
static void give_comments(struct fbd_reader *f)
{
	struct st *st = f->pou->st;
	int first = st->count;

	while (first > f->network->first && st->item[first - 1].kind == ST_COMMENT && !st->item[first - 1].behind)
		first--;
	for (int i = first; i < st->count; i++) {
		const char *text = project_text(f->r->project, st->item[i].text);

		if (f->r->above.len > 0)
			buffer_add(f->r, &f->r->above, "\n", 1);
		buffer_add(f->r, &f->r->above, text, strlen(text));
	}
	f->network->count -= st->count - first;
	st->count = first;
}

static void read_lines(struct fbd_reader *f)
{
	struct reader *r = f->r;

	r->lex.comments = true;
	f->lines = 0;
	f->comment = false;
	while (r->lex.token.kind != TOKEN_END && !r->no_memory && !begins_network(r) && !read_ends_block(r) &&
	       !lex_is(&r->lex, "END_NETWORK")) {
		if (r->lex.token.kind == TOKEN_NEWLINE) {
			f->lines++;
			fbd_step(f);
		} else if (f->comment) {
			add_comment(f, &r->lex.token);
			fbd_step(f);
		} else if (lex_is(&r->lex, ";")) {
			fbd_step(f);
		} else {
			read_line(f);
		}
	}
	give_comments(f);
	if (lex_is(&r->lex, "END_NETWORK")) {
		reader_next(r);
		reader_end_line(r);
	}
}

static void read_network(struct fbd_reader *f)
{
	struct reader *r = f->r;
	struct fbd *fbd = f->pou->fbd;
	struct fbd_network *network;

	if (fbd->count == LIMIT_RUNGS && !f->full)
		reader_fail_many(r, DIAG_TOO_MANY, "networks", LIMIT_RUNGS);
	f->full = fbd->count == LIMIT_RUNGS;
	network = f->full ? &fbd->network[fbd->count - 1] :
		  arena_push(&r->project->arena, &fbd->network, &fbd->count, sizeof(*network));
	if (!network) {
		r->no_memory = true;
		return;
	}
	*network = (struct fbd_network){ .first = f->pou->st->count, .line = r->lex.token.line };
	f->network = network;
	network->comment = buffer_take(r, &r->above);
	read_heading(f, network);
	network->comment = comment_join(r, network->comment, &r->above, COMMENT_ABOVE);
	buffer_clear(&r->above);
	read_lines(f);
}

void read_fbd(struct reader *r, struct pou *pou)
{
	struct fbd_reader f = { .r = r, .pou = pou };

	pou->fbd = arena_alloc(&r->project->arena, sizeof(*pou->fbd));
	pou->st = arena_alloc(&r->project->arena, sizeof(*pou->st));
	if (!pou->fbd || !pou->st) {
		r->no_memory = true;
		return;
	}
	for (;;) {
		reader_skip_newlines(r);
		if (r->lex.token.kind == TOKEN_END || r->no_memory)
			return;
		if (begins_network(r)) {
			read_network(&f);
		} else if (reader_is_vars(r)) {
			if (f.network)
				said_at(&f, DIAG_ST_DECLARES, &r->lex.token);
			read_vars(r, &pou->vars, false);
		} else if (lex_is(&r->lex, "RUNG")) {
			said_at(&f, DIAG_FBD_RUNG, &r->lex.token);
			do {
				reader_skip_line(r);
				reader_skip_newlines(r);
			} while (reader_is(r, '|'));
		} else if (read_ends_block(r)) {
			return;
		} else {
			reader_fail_token(r, DIAG_FBD_NO_NETWORK);
			reader_skip_line(r);
		}
	}
}
