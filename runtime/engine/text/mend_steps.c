/* SPDX-License-Identifier: MIT
 *
 * mend_steps - splits a calculation that stands where an instruction takes one operand.
 *
 * Only two operands with one operator: more is a matter of a variable (mend.c, LD187). A name
 * that only the person knows is a word: Value, Label, Instance.
 */
#include "engine/text/mend_steps.h"

#include "engine/base/ascii.h"
#include "engine/model/expr.h"
#include "engine/text/mend_number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STEPS 3 /* DIAG_PARTS has no room for more                            */

struct steps {
	char line[STEPS][40];
	int count;
	bool full;
};

/* One operand of the calculation. */
struct side {
	const char *text;
	int len;
	bool inverse;
};

static void add(struct steps *steps, const char *word, const char *more, struct side side)
{
	if (steps->count == STEPS ||
	    snprintf(steps->line[steps->count], sizeof(steps->line[0]), "%s%s%s%.*s", word, more,
		     side.len ? " " : "", side.len, side.text) >= (int)sizeof(steps->line[0]))
		steps->full = true;
	else
		steps->count++;
}

/* ---- the calculation ---- */

/* With the operators of C in those of IEC. False: too long. */
static bool translate(const char *text, size_t len, char *out, size_t size)
{
	static const struct { const char *from, *to; } signs[] = {
		{ "==", "=" }, { "!=", "<>" }, { "&&", " AND " }, { "||", " OR " }, { "!", "NOT " },
	};
	size_t used = 0, i;

	for (const char *at = text; at < text + len; ) {
		for (i = 0; i < sizeof(signs) / sizeof(*signs); i++)
			if (strncmp(at, signs[i].from, strlen(signs[i].from)) == 0)
				break;
		const char *to = i < sizeof(signs) / sizeof(*signs) ? signs[i].to : NULL;
		const size_t add = to ? strlen(to) : 1;

		if (used + add >= size)
			return false;
		memcpy(out + used, to ? to : at, add);
		used += add;
		at += to ? strlen(signs[i].from) : 1;
	}
	out[used] = '\0';
	return true;
}

static bool is_side(const struct expr *expr, int i, struct side *out)
{
	const struct expr_node *node = &expr->node[i];

	out->inverse = node->op == EXPR_NOT;
	if (out->inverse)
		node = &expr->node[node->left];
	out->text = node->text;
	out->len = node->len;
	return node->op == EXPR_NAME || node->op == EXPR_LITERAL;
}

/* The two operands of @text and the instruction between them. */
static bool read_calculation(const char *text, struct side *left, const char **word,
			     struct side *right)
{
	struct expr *expr = malloc(sizeof(*expr));
	struct diag_list *diags = calloc(1, sizeof(*diags));
	bool good = expr && diags &&
		    expr_parse_text(text, strlen(text), expr, diags,
				    (struct diag){ .id = DIAG_BAD_EXPRESSION }) && !expr->target;

	if (good) {
		const struct expr_node *root = &expr->node[expr->root];
		const bool logic = root->op == EXPR_AND || root->op == EXPR_OR ||
				   root->op == EXPR_XOR;

		*word = root->op == EXPR_AND ? "AND" : root->op == EXPR_OR ? "OR" :
			root->op == EXPR_XOR ? "XOR" : root->op == EXPR_FN ?
			word_row(root->fn)->word : NULL;
		good = *word && is_side(expr, root->left, left) &&
		       is_side(expr, root->right, right) &&
		       (logic || (!left->inverse && !right->inverse));
	}
	free(diags);
	free(expr);
	return good;
}

/* ---- the instruction ---- */

/* ANDN is AND with N, JMPCN is JMP with CN. */
static enum op find_operator(const char *word, size_t len)
{
	enum op op = op_find(word, len);

	if (op == OP_COUNT && len > 1 && ascii_upper(word[len - 1]) == 'N')
		op = op_find(word, --len);
	if (op == OP_COUNT && len > 1 && ascii_upper(word[len - 1]) == 'C')
		op = op_find(word, --len);
	return op;
}

/* Behind a label, its colon and blanks. */
static const char *skip_label(const char *text)
{
	size_t len = 0;

	while (mend_is_word(text[len]))
		len++;
	if (len && text[len] == ':' && text[len + 1] != '=')
		text += len + 1;
	return text + strspn(text, " ");
}

/* Bytes of the operand at @text, without a comment and blanks behind it. */
static size_t operand_len(const char *text)
{
	const char *line = strstr(text, "//"), *block = strstr(text, "(*");
	size_t len = strlen(text);

	if (line)
		len = (size_t)(line - text);
	if (block && (size_t)(block - text) < len)
		len = (size_t)(block - text);
	while (len && text[len - 1] == ' ')
		len--;
	return len;
}

/* A condition with a jump, a call or a return needs their C. */
static const char *condition_of(const char *word, size_t len, enum op op)
{
	return op_row(op)->modifiers & MOD_C && len == strlen(op_row(op)->word) &&
	       ascii_is(op_row(op)->word, word, len) ? "C" : "";
}

static void split(struct steps *steps, const char *name, enum op op, bool open, const char *more,
		  const struct side side[2], const char *word)
{
	static const struct side none = { "", 0, false }, value = { "Value", 5, false },
				 label = { "Label", 5, false }, instance = { "Instance", 8, false };
	const enum operand_kind kind = op != OP_COUNT ? op_row(op)->operand : OPND_ANY_R;
	const bool inside = op != OP_LD && kind == OPND_ANY_R;

	if (inside) {
		steps->full |= side[0].inverse;
		add(steps, name, "(", side[0]);
	} else {
		add(steps, "LD", side[0].inverse ? "N" : "", side[0]);
	}
	add(steps, word, side[1].inverse ? "N" : "", side[1]);
	if (inside && !open)
		add(steps, ")", "", none);
	else if (op == OP_LD && ascii_upper(name[strlen(name) - 1]) == 'N')
		add(steps, "NOT", "", none);
	else if (kind == OPND_ANY_W || kind == OPND_BOOL_W)
		add(steps, name, more, value);
	else if (kind == OPND_LABEL || kind == OPND_INSTANCE)
		add(steps, name, more, kind == OPND_LABEL ? label : instance);
	else if (kind == OPND_NONE)
		add(steps, name, more, none);
}

static void put(struct steps *steps, const char *operand, size_t len, struct mended *out)
{
	const size_t most = sizeof(out->from) - sizeof("…");
	size_t used = 0, at = 0;

	while (used < len && used + utf8_length(operand + used, len - used) <= most)
		used += utf8_length(operand + used, len - used);
	snprintf(out->from, sizeof(out->from), "%.*s%s", (int)used, operand, used < len ? "…" : "");
	for (int i = 0; i < steps->count; i++)
		at += (size_t)snprintf(out->line + at, sizeof(out->line) - at, "%s%s",
				       i ? DIAG_AND : "", steps->line[i]);
	out->id = DIAG_SEVERAL_STEPS;
	steps->full |= at >= sizeof(out->line);
}

bool mend_in_steps(const struct mend_line *line, struct mended *out)
{
	char text[160], name[16], calculation[160];
	struct steps steps = { .count = 0 };
	struct side side[2];
	const char *word, *at, *between;
	size_t len = 0, operand;
	enum op op;
	bool open;

	if (line->len >= sizeof(text) - 32)
		return false;
	snprintf(text, sizeof(text), "%.*s", (int)line->len, line->text);
	for (char *c = text; *c; c++)
		*c = *c == '\t' || *c == '\r' ? ' ' : *c;
	at = skip_label(text + strspn(text, " "));
	while (mend_is_word(at[len]))
		len++;
	if (len == 0 || len >= sizeof(name))
		return false;
	snprintf(name, sizeof(name), "%.*s", (int)len, at);
	op = find_operator(at, len);
	word = at;
	if (op == OP_COUNT) {
		const enum word fn = words_find(&line->project->words, at, len);

		if (fn == WORD_COUNT || words_row(&line->project->words, fn)->kind != WORD_FN ||
		    !word_opens(words_row(&line->project->words, fn)))
			return false;
	}
	at += len;
	open = *at == '(';
	if (open && op != OP_COUNT && !(op_row(op)->modifiers & MOD_PAREN))
		return false;
	at += open;
	at += strspn(at, " ");
	operand = operand_len(at);
	if (!translate(at, operand, calculation, sizeof(calculation)) ||
	    !read_calculation(calculation, &side[0], &between, &side[1]))
		return false;
	split(&steps, name, op, open, op != OP_COUNT ? condition_of(word, len, op) : "", side,
	      between);
	out->column = (int)(at - text) + 1;
	put(&steps, at, operand, out);
	return !steps.full;
}
