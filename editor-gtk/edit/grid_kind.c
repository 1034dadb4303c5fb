/* SPDX-License-Identifier: MIT
 *
 * grid_kind - changes an element into its opposite, or into the next of its family.
 *
 * The rows of the catalogue say which words belong together. Only the signs of comparisons,
 * which are not words, are listed here.
 */
#include "editor-gtk/edit/grid_spread.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

/* ---- words ---- */

static bool same_family(const struct word_row *a, const struct word_row *b)
{
	return a->kind == b->kind && a->place == b->place && a->operand == b->operand &&
	       !strcmp(explain_family(a), explain_family(b));
}

/* Can an element change from one word to the other and keep everything else? */
static bool can_cycle(const struct word_row *a, const struct word_row *b)
{
	if (!same_family(a, b))
		return false;
	return a->kind == WORD_ELEM ||
	       (a->kind == WORD_FN && word_is_test(a) && word_is_test(b) &&
		a->pin_count == b->pin_count);
}

static bool are_opposite(const struct word_row *a, const struct word_row *b)
{
	if (a->kind != WORD_ELEM || !same_family(a, b) || a->first != b->first ||
	    a->next != b->next)
		return false;
	if (a->edge != EDGE_NONE && b->edge != EDGE_NONE)
		return a->edge != b->edge;
	return a->edge == b->edge && a->negate != b->negate;
}

/* The next word after @word, cyclically, that fits; @word itself: none. */
static enum word next_word(enum word word, bool (*fits)(const struct word_row *,
							const struct word_row *))
{
	const int count = WORD_KNOWN;

	if (word == ELEM_EMPTY || (int)word >= count)
		return word;
	for (int i = 1; i < count; i++) {
		const enum word other = (enum word)(((int)word + i) % count);

		if (fits(word_row(word), word_row(other)))
			return other;
	}
	return word;
}

enum word grid_word_negated(enum word word)
{
	return next_word(word, are_opposite);
}

struct rung *grid_cycle(const struct rung *rung, struct grid_at *at)
{
	struct spread c;

	if (spread_at_element(&c, rung, at)) {
		struct cell *cell = spread_cell(&c, at->row, at->col);
		const enum word next = next_word((enum word)cell->word, can_cycle);

		if (next == cell->word)
			spread_fail(&c, GRID_NO_OTHER);
		cell->word = (uint16_t)next;
	}
	return spread_close(&c, at);
}

/* ---- comparisons ---- */

static const struct { const char *sign, *opposite; bool any; } signs[] = {
	{ "=", "<>", true }, { "<>", "=", true }, /* also for values that are not numbers */
	{ "<", ">=", false }, { ">=", "<", false },
	{ ">", "<=", false }, { "<=", ">", false },
};

static int sign_at(const struct lex *lex)
{
	for (size_t i = 0; i < sizeof(signs) / sizeof(*signs); i++)
		if (lex->token.kind == TOKEN_SYMBOL && lex_is(lex, signs[i].sign))
			return (int)i;
	return -1;
}

static const struct var *find_var(const struct var_table *table, uint32_t fold)
{
	const int i = vars_find(table, fold);

	return i >= 0 ? &table->var[i] : NULL;
}

/* Can a name be a REAL, whose value can be NaN? An unknown name can. */
static bool may_be_real(const struct project *project, const struct pou *pou,
			const struct token *token)
{
	const uint32_t fold = names_find_any(&project->names, token->text, token->len);
	const struct var *var = find_var(&pou->vars, fold);
	struct iec_addr addr;

	if (!var)
		var = find_var(&project->globals, fold);
	if (var)
		return var->type == IEC_NONE ||
		       iec_type_row(var->type)->class == CLASS_REAL;
	return iec_addr_parse(token->text, token->len, &addr) != ADDR_OK &&
	       op_find(token->text, token->len) == OP_COUNT &&
	       !ascii_prefix("SYS_", token->text, token->len);
}

/* The structure of an expression, for its negation. */
struct shape {
	int comparisons, logic; /* outside of all parentheses                   */
	int sign;
	struct token at;        /* of the sign                                  */
	bool real;
	bool negated;           /* NOT ( … ) as a whole                         */
	const char *inside;
	size_t inside_len;
};

static bool is_logic(const struct lex *lex)
{
	return lex_is(lex, "AND") || lex_is(lex, "OR") || lex_is(lex, "XOR") ||
	       lex_is(lex, "&");
}

static void look_at(const char *text, const struct project *project,
		    const struct pou *pou, struct shape *out)
{
	struct lex lex;
	int depth = 0, number = 0, closed = -1;
	bool begins = false;

	memset(out, 0, sizeof(*out));
	lex_init(&lex, text, strlen(text));
	for (; lex_next(&lex) != TOKEN_END; number++) {
		const int sign = depth == 0 ? sign_at(&lex) : -1;

		if (number == 0)
			begins = lex_is(&lex, "NOT");
		if (number == 1 && lex_is(&lex, "("))
			out->inside = lex.token.text + 1;
		if (sign >= 0) {
			out->comparisons++;
			out->sign = sign;
			out->at = lex.token;
		}
		out->logic += depth == 0 && is_logic(&lex);
		if (lex.token.kind == TOKEN_NAME)
			out->real |= may_be_real(project, pou, &lex.token);
		depth += lex_is(&lex, "(") || lex_is(&lex, "[");
		depth -= lex_is(&lex, ")") || lex_is(&lex, "]");
		if (depth == 0 && lex_is(&lex, ")") && closed < 0) {
			closed = number;
			if (out->inside)
				out->inside_len = (size_t)(lex.token.text - out->inside);
		}
	}
	out->negated = begins && out->inside && closed == number - 1;
}

static void trim(const char **text, size_t *len)
{
	for (; *len > 0 && **text == ' '; ++*text)
		--*len;
	while (*len > 0 && (*text)[*len - 1] == ' ')
		--*len;
}

/* The text with @cut bytes at @at replaced by @middle, as a string of the project. */
static uint32_t joined(struct project *project, const char *text, size_t at, size_t cut,
		       const char *middle, const char *tail)
{
	const size_t len = strlen(text), mid = strlen(middle), end = strlen(tail);
	char *made = malloc(len - cut + mid + end + 1);
	uint32_t id = 0;

	if (made) {
		memcpy(made, text, at);
		memcpy(made + at, middle, mid);
		memcpy(made + at + mid, text + at + cut, len - at - cut);
		memcpy(made + len - cut + mid, tail, end);
		id = names_intern(&project->names, made, len - cut + mid + end);
	}
	free(made);
	return id;
}

static uint32_t opposite(struct project *project, const struct pou *pou, uint32_t id)
{
	const char *text = project_text(project, id);
	struct shape shape;

	look_at(text, project, pou, &shape);
	if (shape.negated) {
		trim(&shape.inside, &shape.inside_len);
		return names_intern(&project->names, shape.inside, shape.inside_len);
	}
	if (shape.comparisons == 1 && shape.logic == 0 &&
	    (signs[shape.sign].any || !shape.real))
		return joined(project, text, (size_t)(shape.at.text - text),
			      shape.at.len, signs[shape.sign].opposite, "");
	return joined(project, text, 0, 0, "NOT (", ")");
}

struct rung *grid_negate(const struct rung *rung, struct grid_at *at,
			 struct project *project, const struct pou *pou)
{
	struct spread c;

	if (spread_at_element(&c, rung, at)) {
		struct cell *cell = spread_cell(&c, at->row, at->col);
		const enum word word = grid_word_negated((enum word)cell->word);

		if (word_row((enum word)cell->word)->operand == OPND_EXPR) {
			cell->operand = opposite(project, pou, cell->operand);
			if (!cell->operand)
				spread_fail(&c, GRID_NO_MEMORY);
		} else if (word == cell->word) {
			spread_fail(&c, GRID_NO_OPPOSITE);
		}
		cell->word = (uint16_t)word;
	}
	return spread_close(&c, at);
}
