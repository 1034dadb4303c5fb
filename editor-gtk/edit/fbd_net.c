/* SPDX-License-Identifier: MIT
 *
 * fbd_net - reads and writes the lines of a network; see fbd_net.h.
 */
#include "editor-gtk/edit/fbd_net.h"

#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/base/sink.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEEPEST 64 /* parentheses inside one another                             */

/* From the weakest to the strongest; those of one strength bind to the left. */
static const struct operator {
	const char *sign, *word;
	int strength;
	bool joins;        /* a AND b AND c is one box of three inputs           */
} operators[] = {
	{ "OR", "OR", 1, true }, { "OR_ELSE", NULL, 1, true },
	{ "XOR", "XOR", 2, true },
	{ "AND", "AND", 3, true }, { "&", "AND", 3, true }, { "AND_THEN", NULL, 3, true },
	{ "=", "EQ", 4, false }, { "<>", "NE", 4, false },
	{ "<", "LT", 5, false }, { ">", "GT", 5, false }, { "<=", "LE", 5, false },
	{ ">=", "GE", 5, false },
	{ "+", "ADD", 6, true }, { "-", "SUB", 6, false },
	{ "*", "MUL", 7, true }, { "/", "DIV", 7, false }, { "MOD", "MOD", 7, false },
	{ "**", "EXPT", 8, false },
};
#define STRONGEST 8
#define UNARY     9

static const struct operator *operator_of(const char *text, size_t len)
{
	for (size_t i = 0; i < sizeof(operators) / sizeof(*operators); i++)
		if (name_is(operators[i].sign, text, len))
			return &operators[i];
	return NULL;
}

const char *fbd_operator_word(const char *sign)
{
	const struct operator *row = operator_of(sign, strlen(sign));

	if (name_equal(sign, "NOT"))
		return "NOT";
	return row ? row->word : NULL;
}

const char *fbd_word_operator(const char *word)
{
	if (name_equal(word, "NOT"))
		return "NOT";
	for (size_t i = 0; i < sizeof(operators) / sizeof(*operators); i++)
		if (operators[i].word && name_equal(operators[i].word, word))
			return operators[i].sign;
	return NULL;
}

void fbd_net_init(struct fbd_net *net)
{
	*net = (struct fbd_net){ .count = 0 };
	arena_init(&net->arena);
}

void fbd_net_free(struct fbd_net *net)
{
	arena_free(&net->arena);
}

/* ---- trees ---- */

static struct fbd_node *node_new(struct fbd_net *net, enum fbd_node_kind kind, const char *text,
				 size_t len)
{
	struct fbd_node *node = arena_alloc(&net->arena, sizeof(*node));

	if (!node)
		return NULL;
	*node = (struct fbd_node){ .kind = kind, .text = arena_copy(&net->arena, text, len) };
	return node->text ? node : NULL;
}

struct fbd_node *fbd_node_new(struct fbd_net *net, enum fbd_node_kind kind, const char *text)
{
	return node_new(net, kind, text, strlen(text));
}

struct fbd_arg *fbd_node_push(struct fbd_net *net, struct fbd_node *node, const char *pin,
			      struct fbd_node *value)
{
	struct fbd_arg *arg = arena_push(&net->arena, &node->arg, &node->count, sizeof(*arg));

	if (arg)
		*arg = (struct fbd_arg){ .pin = pin, .value = value };
	return arg;
}

void fbd_node_drop(struct fbd_node *node, int arg)
{
	node->count--;
	memmove(node->arg + arg, node->arg + arg + 1,
		(size_t)(node->count - arg) * sizeof(*node->arg));
}

/* ---- reading ---- */

struct reading {
	struct fbd_net *net;
	struct lex lex;
	int depth;
	bool wrong;
};

static struct fbd_node *read_value(struct reading *r, int strength);

static bool is_name(const struct reading *r)
{
	return r->lex.token.kind == TOKEN_NAME && !lex_is(&r->lex, "NOT") &&
	       !operator_of(r->lex.token.text, r->lex.token.len);
}

static void read_args(struct reading *r, struct fbd_node *call)
{
	while (!r->wrong && !lex_is(&r->lex, ")")) {
		struct lex ahead = r->lex;
		struct fbd_arg *arg = fbd_node_push(r->net, call, NULL, NULL);
		bool negated;

		if (!arg) {
			r->wrong = true;
			return;
		}
		negated = lex_accept(&ahead, "NOT");
		if (ahead.token.kind == TOKEN_NAME) {
			const struct token pin = ahead.token;

			lex_next(&ahead);
			if ((!negated && lex_is(&ahead, ":=")) || lex_is(&ahead, "=>")) {
				arg->output = lex_is(&ahead, "=>");
				arg->negated = negated;
				arg->pin = arena_copy(&r->net->arena, pin.text, pin.len);
				lex_next(&ahead);
				r->lex = ahead;
			}
		}
		if (!arg->pin || (!lex_is(&r->lex, ",") && !lex_is(&r->lex, ")")))
			arg->value = read_value(r, 1);
		if (!lex_accept(&r->lex, ",") && !lex_is(&r->lex, ")"))
			r->wrong = true;
	}
	lex_accept(&r->lex, ")");
}

/* A name with what belongs to it: an index, a dot, ^. */
static struct fbd_node *read_path(struct reading *r)
{
	const char *from = r->lex.token.text, *to = from + r->lex.token.len;
	int open = 0;

	lex_next(&r->lex);
	while (open > 0 || lex_is(&r->lex, "[") || lex_is(&r->lex, ".") || lex_is(&r->lex, "^") ||
	       lex_is(&r->lex, "#")) {
		if (lex_is(&r->lex, ".") || lex_is(&r->lex, "#"))
			lex_next(&r->lex);
		if (r->lex.token.kind == TOKEN_END) {
			r->wrong = true;
			break;
		}
		open += lex_is(&r->lex, "[") - lex_is(&r->lex, "]");
		to = r->lex.token.text + r->lex.token.len;
		lex_next(&r->lex);
	}
	return node_new(r->net, FBD_NODE_OPERAND, from, (size_t)(to - from));
}

static struct fbd_node *read_operand(struct reading *r);

/* The operand behind a sign or NOT, which has been read. */
static struct fbd_node *read_behind(struct reading *r, const char *sign, size_t len)
{
	struct fbd_node *node = node_new(r->net, FBD_NODE_INFIX, sign, len);

	if (++r->depth > DEEPEST)
		r->wrong = true;
	if (node && !r->wrong && !fbd_node_push(r->net, node, NULL, read_operand(r)))
		r->wrong = true;
	r->depth--;
	return node;
}

static struct fbd_node *read_operand(struct reading *r)
{
	struct fbd_node *node;

	if (lex_accept(&r->lex, "(")) {
		if (++r->depth > DEEPEST)
			r->wrong = true;
		node = r->wrong ? NULL : read_value(r, 1);
		r->depth--;
		r->wrong |= !lex_accept(&r->lex, ")");
		return node;
	}
	if (lex_is(&r->lex, "-") || lex_is(&r->lex, "+")) {
		const char *from = r->lex.token.text;

		lex_next(&r->lex);
		if (r->lex.token.kind == TOKEN_NUMBER) {
			node = node_new(r->net, FBD_NODE_OPERAND, from,
					(size_t)(r->lex.token.text - from) + r->lex.token.len);
			lex_next(&r->lex);
			return node;
		}
		return read_behind(r, from, 1);
	}
	if (lex_accept(&r->lex, "NOT"))
		return read_behind(r, "NOT", 3);
	if (r->lex.token.kind == TOKEN_NAME) {
		const bool known = is_name(r);
		const struct token name = r->lex.token;

		node = known || operator_of(name.text, name.len) ? read_path(r) : NULL;
		if (node && lex_is(&r->lex, "(") && strchr(node->text, '#') == NULL) {
			if (++r->depth > DEEPEST)
				r->wrong = true;
			node->kind = FBD_NODE_CALL;
			lex_next(&r->lex);
			if (!r->wrong)
				read_args(r, node);
			r->depth--;
		} else if (!known) {
			r->wrong = true;
		}
		r->wrong |= !node;
		return node;
	}
	if (r->lex.token.kind == TOKEN_NUMBER || r->lex.token.kind == TOKEN_STRING ||
	    r->lex.token.kind == TOKEN_ADDRESS)
		return read_path(r);
	r->wrong = true;
	return NULL;
}

/* `a AND b` with another AND behind it: one box. */
static bool is_chain(const struct fbd_node *left, const struct operator *row)
{
	const struct operator *own = left && left->kind == FBD_NODE_INFIX && left->count > 1 ?
				     operator_of(left->text, strlen(left->text)) : NULL;

	return own && row->joins && (own == row || (own->word && row->word && strcmp(own->word, row->word) == 0));
}

static struct fbd_node *read_value(struct reading *r, int strength)
{
	struct fbd_node *left, *node;
	const struct operator *row;

	left = strength > STRONGEST ? read_operand(r) : read_value(r, strength + 1);
	while (!r->wrong && strength <= STRONGEST) {
		row = r->lex.token.kind == TOKEN_END ? NULL :
		      operator_of(r->lex.token.text, r->lex.token.len);
		if (!row || row->strength != strength)
			break;
		lex_next(&r->lex);
		node = left;
		if (!is_chain(left, row)) {
			node = node_new(r->net, FBD_NODE_INFIX, row->sign, strlen(row->sign));
			r->wrong |= !node || !fbd_node_push(r->net, node, NULL, left);
		}
		r->wrong |= r->wrong || !fbd_node_push(r->net, node, NULL, read_value(r, strength + 1));
		left = node;
	}
	r->wrong |= !left;
	return left;
}

static void reading_init(struct reading *r, struct fbd_net *net, const char *text, size_t len)
{
	*r = (struct reading){ .net = net };
	lex_init(&r->lex, text, len);
	r->lex.wide = true;
	lex_next(&r->lex);
}

struct fbd_node *fbd_net_value(struct fbd_net *net, const char *text, size_t len)
{
	struct reading r;
	struct fbd_node *node;

	reading_init(&r, net, text, len);
	node = read_value(&r, 1);
	return r.wrong || r.lex.token.kind != TOKEN_END || net->arena.failed ? NULL : node;
}

/* The text between two tokens, copied. */
static const char *copy(struct fbd_net *net, const char *from, const char *to)
{
	return arena_copy(&net->arena, from, (size_t)(to - from));
}

/* `target :=`, `target S=`: true if it is one, with the lexer behind it. */
static bool read_target(struct reading *r, struct fbd_line *line)
{
	struct reading at = *r;
	const struct fbd_node *target;

	if (r->lex.token.kind != TOKEN_NAME && r->lex.token.kind != TOKEN_ADDRESS)
		return false;
	target = read_path(&at);
	if (at.wrong || !target)
		return false;
	line->kind = FBD_LINE_ASSIGN;
	if (lex_is(&at.lex, "S") || lex_is(&at.lex, "R")) {
		line->kind = lex_is(&at.lex, "S") ? FBD_LINE_SET : FBD_LINE_RESET;
		lex_next(&at.lex);
		if (!lex_accept(&at.lex, "="))
			return false;
	} else if (!lex_accept(&at.lex, ":=")) {
		return false;
	}
	line->target = target->text;
	*r = at;
	return true;
}

/* JMP Fill IF value, RETURN IF value, STOP IF value: the lexer is behind the first word. */
static void read_leave(struct reading *r, struct fbd_line *line)
{
	if (line->kind == FBD_LINE_JUMP) {
		r->wrong |= r->lex.token.kind != TOKEN_NAME;
		line->target = arena_copy(&r->net->arena, r->lex.token.text, r->lex.token.len);
		lex_next(&r->lex);
	}
	if (lex_accept(&r->lex, "IF"))
		line->value = read_value(r, 1);
}

/* `STOP` alone or before IF: elsewhere it is a name. */
static bool stops(struct lex lex)
{
	if (!lex_accept(&lex, "STOP"))
		return false;
	return lex.token.kind == TOKEN_END || lex_is(&lex, "IF");
}

static void read_line(struct fbd_net *net, struct fbd_line *line, const char *text, size_t len)
{
	struct reading r;

	reading_init(&r, net, text, len);
	if (lex_is(&r.lex, "JMP") || lex_is(&r.lex, "RETURN") || stops(r.lex)) {
		line->kind = lex_is(&r.lex, "JMP") ? FBD_LINE_JUMP : lex_is(&r.lex, "STOP") ? FBD_LINE_STOP : FBD_LINE_RETURN;
		lex_next(&r.lex);
		read_leave(&r, line);
	} else if (read_target(&r, line)) {
		if (r.lex.token.kind != TOKEN_END)
			line->value = read_value(&r, 1);
	} else {
		line->kind = FBD_LINE_CALL;
		line->value = read_value(&r, 1);
		r.wrong |= !line->value || line->value->kind != FBD_NODE_CALL;
	}
	if (r.wrong || r.lex.token.kind != TOKEN_END) {
		line->kind = FBD_LINE_OTHER;
		line->value = NULL;
		line->target = NULL;
	}
}

/* `{ at 3,1 }` at the lexer, which steps to the last of its tokens. */
static bool read_hint(struct lex *lex, int *column, int *row)
{
	int *const number[] = { column, row };

	lex_next(lex);
	if (!lex_accept(lex, "at"))
		return false;
	for (int i = 0; i < 2; i++) {
		if (lex->token.kind != TOKEN_NUMBER)
			return false;
		*number[i] = 0;
		for (size_t k = 0; k < lex->token.len && k < 4; k++)
			*number[i] = *number[i] * 10 + (lex->token.text[k] - '0');
		lex_next(lex);
		if (i == 0 && !lex_accept(lex, ","))
			return false;
	}
	return lex_is(lex, "}");
}

/* A line of the text while its end is looked for. */
struct piece {
	const char *from, *to;    /* of the statement, without what is behind it  */
	const char *all;          /* the end of all of it                        */
	struct sink_memory notes;
	int open;                 /* parentheses                                 */
	int column, row;
	bool gap, closed;         /* closed: a `;` ends it                        */
};

static void piece_begin(struct piece *piece, bool gap)
{
	sink_memory_free(&piece->notes);
	*piece = (struct piece){ .gap = gap };
	sink_memory_init(&piece->notes);
}

static void piece_note(struct piece *piece, const struct token *token)
{
	const struct sink sink = sink_to_memory(&piece->notes);

	sink_text(&sink, "  ");
	sink_write(&sink, token->text, token->len);
	piece->all = token->text + token->len;
}

/* The piece becomes a line; the next one begins. */
static bool piece_end(struct fbd_net *net, struct piece *piece)
{
	const bool empty = !piece->from && !piece->notes.len;
	struct fbd_line *line;
	bool good = true;

	if (!empty) {
		line = fbd_net_insert(net, net->count, FBD_LINE_NOTE);
		if (!line)
			return false;
		line->changed = false;
		line->gap = piece->gap;
		line->column = piece->column;
		line->row = piece->row;
		line->notes = arena_copy(&net->arena, sink_memory_text(&piece->notes), piece->notes.len);
		line->text = piece->from ? copy(net, piece->from, piece->all) : line->notes + 2;
		if (piece->from)
			read_line(net, line, piece->from, (size_t)(piece->to - piece->from));
		good = !piece->notes.failed && line->text && line->notes;
	}
	piece_begin(piece, empty);
	return good;
}

static void piece_token(struct piece *piece, struct lex *lex)
{
	piece->open += lex_is(lex, "(") - lex_is(lex, ")");
	if (lex_is(lex, ";")) {
		piece->closed = true;
	} else if (lex_is(lex, "{") && piece->from) {
		read_hint(lex, &piece->column, &piece->row);
		piece->all = lex->token.text + lex->token.len;
	} else {
		piece->from = piece->from ? piece->from : lex->token.text;
		piece->to = piece->all = lex->token.text + lex->token.len;
	}
}

bool fbd_net_read(struct fbd_net *net, const char *text, size_t len)
{
	struct piece piece = { .from = NULL };
	struct lex lex;
	bool good = true;

	sink_memory_init(&piece.notes);
	lex_init(&lex, text, len);
	lex.newlines = lex.comments = lex.wide = true;
	while (good && lex_next(&lex) != TOKEN_END) {
		const enum token_kind kind = lex.token.kind;

		if (kind == TOKEN_NEWLINE ? piece.open <= 0 : piece.closed && kind != TOKEN_COMMENT)
			good = piece_end(net, &piece);
		if (kind == TOKEN_COMMENT)
			piece_note(&piece, &lex.token);
		else if (kind != TOKEN_NEWLINE)
			piece_token(&piece, &lex);
	}
	good = good && piece_end(net, &piece);
	sink_memory_free(&piece.notes);
	return good && !net->arena.failed;
}

/* ---- lines ---- */

struct fbd_line *fbd_net_insert(struct fbd_net *net, int at, enum fbd_line_kind kind)
{
	struct fbd_line *line = arena_alloc(&net->arena, sizeof(*line));
	struct fbd_line **place = arena_push(&net->arena, &net->line, &net->count, sizeof(*place));

	if (!line || !place)
		return NULL;
	place = net->line + at;
	memmove(place + 1, place, (size_t)(net->count - 1 - at) * sizeof(*place));
	*place = line;
	*line = (struct fbd_line){ .kind = kind, .changed = true, .notes = "" };
	return line;
}

void fbd_net_remove(struct fbd_net *net, int at)
{
	net->count--;
	memmove(net->line + at, net->line + at + 1, (size_t)(net->count - at) * sizeof(*net->line));
}

/* ---- writing ---- */

static void write_node(const struct sink *sink, const struct fbd_node *node, int strength);

/* Does its only input need a value to be readable? */
static bool needs_value(const struct fbd_node *node)
{
	return node->count == 1 && (node->kind == FBD_NODE_INFIX ||
				    name_equal(node->text, "R_EDGE") || name_equal(node->text, "F_EDGE"));
}

static void write_input(const struct sink *sink, const struct fbd_node *node, int index, int strength)
{
	if (node->arg[index].value)
		write_node(sink, node->arg[index].value, strength);
	else
		sink_text(sink, "MOVE(IN :=)"); /* a box with an open input */
}

static void write_call(const struct sink *sink, const char *name, const struct fbd_node *node, bool pins)
{
	sink_text(sink, name);
	sink_text(sink, "(");
	for (int i = 0; i < node->count; i++) {
		const struct fbd_arg *arg = &node->arg[i];

		sink_text(sink, i ? ", " : "");
		if (needs_value(node)) {
			write_input(sink, node, i, 0);
			continue;
		}
		if (arg->pin) {
			sink_text(sink, arg->negated ? "NOT " : "");
			sink_text(sink, arg->pin);
			sink_text(sink, arg->output ? " =>" : " :=");
			sink_text(sink, arg->value ? " " : "");
		} else if (pins || !arg->value) {
			sink_printf(sink, "IN%d :=%s", i + 1, arg->value ? " " : "");
		}
		if (arg->value)
			write_node(sink, arg->value, 0);
	}
	sink_text(sink, ")");
}

/* An operator with an open input is written as a call: AND(IN1 := A, IN2 :=). */
static bool is_called(const struct fbd_node *node)
{
	const struct operator *row = operator_of(node->text, strlen(node->text));

	if (node->count > 2 && row && !row->joins)
		return true;
	for (int i = 0; node->count > 1 && i < node->count; i++)
		if (!node->arg[i].value)
			return true;
	return false;
}

static void write_infix(const struct sink *sink, const struct fbd_node *node, int strength)
{
	const struct operator *row = operator_of(node->text, strlen(node->text));
	const bool unary = node->count == 1;
	const int own = unary || !row ? UNARY : row->strength;

	sink_text(sink, own < strength ? "(" : "");
	if (unary) {
		sink_text(sink, name_equal(node->text, "NOT") ? "NOT " : node->text);
		write_input(sink, node, 0, UNARY + 1);
	}
	for (int i = 0; !unary && i < node->count; i++) {
		if (i)
			sink_printf(sink, " %s ", node->text);
		write_node(sink, node->arg[i].value, i ? own + 1 : own);
	}
	sink_text(sink, own < strength ? ")" : "");
}

static void write_node(const struct sink *sink, const struct fbd_node *node, int strength)
{
	switch (node->kind) {
	case FBD_NODE_OPERAND:
		sink_text(sink, node->text);
		break;
	case FBD_NODE_CALL:
		write_call(sink, node->text, node, false);
		break;
	case FBD_NODE_INFIX:
		if (is_called(node))
			write_call(sink, fbd_operator_word(node->text), node, true);
		else
			write_infix(sink, node, strength);
		break;
	}
}

const char *fbd_node_text(struct fbd_net *net, const struct fbd_node *node)
{
	struct sink_memory memory;
	const char *text;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	write_node(&sink, node, 0);
	text = memory.failed ? NULL : arena_copy(&net->arena, sink_memory_text(&memory), memory.len);
	sink_memory_free(&memory);
	return text;
}

static void write_value(const struct sink *sink, const struct fbd_line *line)
{
	if (line->value)
		write_node(sink, line->value, 0);
}

static void write_line(const struct sink *sink, const struct fbd_line *line)
{
	switch (line->kind) {
	case FBD_LINE_ASSIGN: case FBD_LINE_SET: case FBD_LINE_RESET:
		sink_printf(sink, "%s %s ", line->target, line->kind == FBD_LINE_SET ? "S=" :
			    line->kind == FBD_LINE_RESET ? "R=" : ":=");
		break;
	case FBD_LINE_JUMP:
		sink_printf(sink, "JMP %s%s", line->target, line->value ? " IF " : "");
		break;
	case FBD_LINE_RETURN: case FBD_LINE_STOP:
		sink_printf(sink, "%s%s", line->kind == FBD_LINE_STOP ? "STOP" : "RETURN", line->value ? " IF " : "");
		break;
	case FBD_LINE_CALL: case FBD_LINE_NOTE: case FBD_LINE_OTHER:
		break;
	}
	write_value(sink, line);
	if (line->column > 0)
		sink_printf(sink, "  { at %d,%d }", line->column, line->row);
	sink_text(sink, line->notes);
}

char *fbd_net_write(const struct fbd_net *net)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	sink_text(&sink, "");
	for (int i = 0; i < net->count; i++) {
		const struct fbd_line *line = net->line[i];

		sink_text(&sink, line->gap && i > 0 ? "\n" : "");
		sink_text(&sink, "  ");
		if (line->text && !line->changed)
			sink_text(&sink, line->text);
		else
			write_line(&sink, line);
		sink_text(&sink, "\n");
	}
	if (memory.failed || net->arena.failed) {
		sink_memory_free(&memory);
		return NULL;
	}
	return memory.text ? memory.text : strdup("");
}
