/* SPDX-License-Identifier: MIT
 *
 * fbd - networks of a body in Function Block Diagram; see fbd.h.
 */
#include "engine/model/fbd.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <string.h>

int fbd_network_of(const struct fbd *fbd, int item)
{
	for (int i = 0; i < fbd->count; i++)
		if (item >= fbd->network[i].first && item < fbd->network[i].first + fbd->network[i].count)
			return i;
	return -1;
}

int fbd_find_label(struct names *names, const struct fbd *fbd, uint32_t fold)
{
	for (int i = 0; i < fbd->count && fold; i++)
		if (fbd->network[i].label && names_fold(names, fbd->network[i].label) == fold)
			return i;
	return -1;
}

uint32_t fbd_wire_name(struct names *names, const char *name, size_t len, int network, bool before)
{
	char text[LIMIT_NAME + 24];
	const int size = snprintf(text, sizeof(text), "%.*s.%c%d", len < LIMIT_NAME ? (int)len : LIMIT_NAME, name,
				  before ? 'P' : 'N', network + 1);

	return names_intern(names, text, (size_t)size);
}

int fbd_variable(struct names *names, const struct pou *pou, int network, uint32_t id)
{
	const struct fbd_network *of = &pou->fbd->network[network];
	const uint32_t fold = id ? names_fold(names, id) : 0;

	for (int i = of->wire; fold && i < of->wire + of->wires; i++)
		if (pou->vars.var[i].fold == fold)
			return i;
	return -1;
}

int fbd_wire(struct names *names, const struct pou *pou, int network, const char *name, size_t len)
{
	const struct fbd_network *of = &pou->fbd->network[network];

	return of->wires ? fbd_variable(names, pou, network, fbd_wire_name(names, name, len, network, false)) : -1;
}

static const char *take_number(const char *at, const char *end, uint8_t *out)
{
	unsigned int number = 0;
	const char *begin;

	while (at < end && *at == ' ')
		at++;
	for (begin = at; at < end && at - begin < 3 && *at >= '0' && *at <= '9'; at++)
		number = 10 * number + (unsigned int)(*at - '0');
	while (at < end && *at == ' ')
		at++;
	*out = (uint8_t)number;
	return number >= 1 && number <= UINT8_MAX ? at : NULL;
}

bool fbd_hint(const char *text, size_t len, uint8_t *column, uint8_t *row)
{
	const char *end = text + len, *at = text + 1;

	if (len < 2 || *text != '{' || end[-1] != '}')
		return false;
	while (at < end && *at == ' ')
		at++;
	if (end - at < 3 || !ascii_same(at, "at", 2) || at[2] != ' ')
		return false;
	at = take_number(at + 2, end - 1, column);
	if (!at || *at != ',')
		return false;
	return take_number(at + 1, end - 1, row) == end - 1;
}

enum fbd_word fbd_word(struct expr *expr, const struct expr_node *call, struct expr_node **arg)
{
	static const struct { const char *word; enum fbd_word is; } rows[] = {
		{ "PREVIOUS", FBD_PREVIOUS }, { "R_EDGE", FBD_RISING }, { "F_EDGE", FBD_FALLING },
	};
	const struct expr_node *first = call->op == EXPR_CALL && call->left >= 0 ? &expr->node[call->left] : NULL;

	if (!first || first->right >= 0 || first->len)
		return FBD_NO_WORD;
	for (size_t i = 0; i < sizeof(rows) / sizeof(*rows); i++)
		if (ascii_is(rows[i].word, call->text, call->len)) {
			*arg = &expr->node[first->left];
			return rows[i].is;
		}
	return FBD_NO_WORD;
}

/* ---- names of a line ---- */

void fbd_names_begin(struct fbd_names *walk, const struct names *names, const struct st_item *item)
{
	*walk = (struct fbd_names){ .kind = (enum st_kind)item->kind, .first = true };
	lex_init(&walk->lex, names_text(names, item->text), names_len(names, item->text));
	walk->lex.wide = true;
	walk->lex.line = item->line;
	walk->lex.line_start = walk->lex.at - (item->column - 1);
	if (item->kind == ST_COMMENT)
		walk->lex.end = walk->lex.at;
	lex_next(&walk->lex);
	if (item->kind == ST_JUMP_IF) { /* the label */
		lex_next(&walk->lex);
		lex_next(&walk->lex);
	}
	if (item->kind == ST_RETURN_IF || item->kind == ST_STOP_IF)
		lex_next(&walk->lex);
	if (item->kind == ST_JUMP_IF || item->kind == ST_RETURN_IF || item->kind == ST_STOP_IF)
		walk->stored = true;
}

static bool is_sign(const struct token *token, const char *sign)
{
	return token->kind == TOKEN_SYMBOL && token->len == strlen(sign) && memcmp(token->text, sign, token->len) == 0;
}

static bool is_word(const struct lex *lex)
{
	static const char *const words[] = { "AND", "AND_THEN", "OR", "OR_ELSE", "XOR", "MOD", "NOT", "TRUE", "FALSE" };

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (lex_is(lex, words[i]))
			return true;
	return false;
}

/* What the name at the lexer is, if it counts; @ahead: behind it. */
static bool is_name(struct fbd_names *walk, const struct lex *ahead, enum fbd_use *use)
{
	const struct lex *lex = &walk->lex;
	const bool begins = walk->first && !walk->stored && walk->open == 0;
	const bool latch = walk->kind == ST_SET || walk->kind == ST_RESET;

	if (is_sign(&walk->before, ".") || is_word(lex))
		return false;
	if (lex_is(ahead, "(") && (lex_is(lex, "R_EDGE") || lex_is(lex, "F_EDGE"))) {
		*use = FBD_EDGE;
		return true;
	}
	if (walk->open > 0 && (lex_is(ahead, ":=") || lex_is(ahead, "=>")))
		return false; /* a pin */
	if (latch && !walk->stored && !begins && lex_is(ahead, "=")) {
		walk->stored = true; /* S, R */
		return false;
	}
	*use = begins && latch ? FBD_LATCHED : begins && walk->kind == ST_ASSIGN ? FBD_WRITTEN :
	       begins && walk->kind == ST_CALL ? FBD_CALLED : is_sign(&walk->before, "=>") ? FBD_OUTPUT :
	       is_sign(&walk->before, "(") && lex_is(&(struct lex){ .token = walk->earlier }, "PREVIOUS") ?
	       FBD_BEFORE : FBD_READ;
	walk->first = false;
	return !lex_is(ahead, "(") || *use == FBD_CALLED;
}

bool fbd_names_next(struct fbd_names *walk, struct token *name, enum fbd_use *use, bool *whole)
{
	struct lex *lex = &walk->lex, ahead;
	bool found = false;

	while (!found && lex->token.kind != TOKEN_END) {
		const char *dot;

		ahead = *lex;
		lex_next(&ahead);
		found = lex->token.kind == TOKEN_NAME && is_name(walk, &ahead, use);
		if (found) {
			*name = lex->token;
			dot = memchr(name->text, '.', name->len);
			*whole = !dot && !lex_is(&ahead, "[") && !lex_is(&ahead, ".") && !lex_is(&ahead, "^");
			name->len = dot ? (size_t)(dot - name->text) : name->len;
		}
		walk->open += lex_is(lex, "(") || lex_is(lex, "[");
		walk->open -= lex_is(lex, ")") || lex_is(lex, "]");
		walk->stored |= walk->open == 0 && lex_is(lex, ":=");
		walk->first &= lex->token.kind == TOKEN_NAME || !walk->stored;
		walk->earlier = walk->before;
		walk->before = lex->token;
		*lex = ahead;
	}
	return found;
}

/* ---- edges ---- */

int fbd_edge_number(const struct names *names, const struct pou *pou, int network, int item, const char *at)
{
	int number = 0;

	for (int i = pou->fbd->network[network].first; i <= item; i++) {
		struct fbd_names walk;
		struct token name;
		enum fbd_use use;
		bool whole;

		fbd_names_begin(&walk, names, &pou->st->item[i]);
		while (fbd_names_next(&walk, &name, &use, &whole))
			number += use == FBD_EDGE && (i < item || name.text <= at);
	}
	return number;
}

uint32_t fbd_edge_name(struct names *names, int network, int number)
{
	char text[32];
	const int len = snprintf(text, sizeof(text), "EDGE%d.E%d", number, network + 1);

	return names_intern(names, text, (size_t)len);
}
