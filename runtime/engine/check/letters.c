/* SPDX-License-Identifier: MIT
 *
 * letters - see letters.h.
 */
#include "engine/check/letters.h"

#include "engine/base/ascii.h"

#include <string.h>

#define ROOM 12 /* nodes of the largest rewriting */

static int add_node(struct expr *expr, struct expr_node node)
{
	expr->node[expr->count] = node;
	return expr->count++;
}

static int add_text(struct expr *expr, enum expr_op op, const char *text, size_t len)
{
	return add_node(expr, (struct expr_node){ .op = op, .text = text, .len = (uint16_t)len,
						  .left = -1, .right = -1 });
}

/* An argument without a name behind @before; -1: the first. */
static int add_argument(struct expr *expr, int before, int value)
{
	return add_node(expr, (struct expr_node){ .op = EXPR_ARG, .left = (int16_t)value, .right = (int16_t)before });
}

static int add_one(struct expr *expr)
{
	return add_text(expr, EXPR_LITERAL, "1", 1);
}

static bool is_text(struct scope *scope, const struct pou *pou, uint32_t id)
{
	enum diag_id why;
	const struct meaning *m = id ? scope_find(scope, pou, id, &why) : NULL;

	return m && m->type == IEC_STRING && m->kind != MEANING_ARRAY && m->kind != MEANING_LITERAL;
}

static bool is_text_name(struct scope *scope, const struct pou *pou, const char *text, size_t len)
{
	return is_text(scope, pou, names_intern(&scope_project(scope)->names, text, len));
}

/* `Name[ i ]` as written: the bytes before the index, and the index. False: there is none. */
static bool cut(const char *text, size_t len, size_t *base, const char **index, size_t *index_len)
{
	if (len < 4 || text[len - 1] != ']')
		return false;
	*base = expr_array(text, len);
	while (*base > 0 && ascii_is(" ", text + *base - 1, 1))
		--*base;
	*index = memchr(text + *base, '[', len - *base);
	if (*base == 0 || !*index)
		return false;
	++*index;
	*index_len = (size_t)(text + len - 1 - *index);
	for (; *index_len > 0 && **index == ' '; --*index_len)
		++*index;
	while (*index_len > 0 && (*index)[*index_len - 1] == ' ')
		--*index_len;
	return *index_len > 0 && !memchr(*index, ',', *index_len);
}

static bool split(struct scope *scope, const struct pou *pou, const char *text, size_t len, size_t *base,
		  const char **index, size_t *index_len)
{
	return cut(text, len, base, index, index_len) && is_text_name(scope, pou, text, *base);
}

static int add_index(struct expr *expr, const char *text, size_t len)
{
	const bool number = (*text >= '0' && *text <= '9') || *text == '-' || *text == '+';

	return add_text(expr, number ? EXPR_LITERAL : EXPR_NAME, text, len);
}

/* The same behind a path: `Tags[i + 1].Text[3]`. */
static bool letter_behind(struct scope *scope, const struct pou *pou, struct expr *expr, struct expr_node at,
			  int *base, int *index)
{
	const char *text;
	size_t len, text_len;

	if (!cut(at.tail.text, at.tail.len, &len, &text, &text_len))
		return false;
	at.tail.len = (uint16_t)len;
	*base = add_node(expr, at);
	if (!is_text(scope, pou, scope_first_of(scope, pou, expr, &expr->node[*base])))
		return expr->count--, false;
	*index = add_index(expr, text, text_len);
	return true;
}

/* Where `Name[i + 1]` of a text is: @base and @index get nodes. False: @node is none. */
static bool letter_at(struct scope *scope, const struct pou *pou, struct expr *expr, int node, int *base, int *index)
{
	const struct expr_node at = expr->node[node];
	const char *text;
	size_t len, text_len;

	if (at.op == EXPR_NAME) {
		if (!split(scope, pou, at.text, at.len, &len, &text, &text_len))
			return false;
		*base = add_text(expr, EXPR_NAME, at.text, len);
		*index = add_index(expr, text, text_len);
		return true;
	}
	if (at.op != EXPR_INDEX || at.inner)
		return false;
	if (at.tail.len)
		return letter_behind(scope, pou, expr, at, base, index);
	if (at.right < 0 ? !is_text_name(scope, pou, at.text, at.len) :
			   !is_text(scope, pou, scope_first_of(scope, pou, expr, &expr->node[at.right])))
		return false;
	*base = at.right < 0 ? add_text(expr, EXPR_NAME, at.text, at.len) : at.right;
	expr->node[*base].inner = false;
	*index = at.left;
	return true;
}

/* The node becomes MID(base, 1, index). */
static void read_letter(struct expr *expr, int node, int base, int index)
{
	int last = add_argument(expr, -1, base);

	last = add_argument(expr, last, add_one(expr));
	last = add_argument(expr, last, index);
	expr->node[node] = (struct expr_node){ .op = EXPR_CALL, .text = "MID", .len = 3, .left = (int16_t)last,
					       .right = -1 };
}

/* The target is a letter: its text and index as nodes, and the target becomes the text. False: it is none. */
static bool take_target(struct scope *scope, const struct pou *pou, struct expr *expr, int *base, int *index)
{
	const char *text;
	size_t len, text_len;

	if (expr->target_bit.len || expr->target_points || expr->target_tried)
		return false;
	if (expr->target_tail.len) {
		const struct expr_node at = {
			.op = EXPR_INDEX, .text = expr->target, .len = (uint16_t)expr->target_len,
			.left = (int16_t)expr->target_index, .right = (int16_t)expr->target_base,
			.tail = expr->target_tail };

		if (!letter_behind(scope, pou, expr, at, base, index))
			return false;
		expr->target_tail = expr->node[*base].tail;
		return true;
	}
	if (expr->target_index < 0) {
		if (!split(scope, pou, expr->target, expr->target_len, &len, &text, &text_len))
			return false;
		expr->target_len = len;
		*base = add_text(expr, EXPR_NAME, expr->target, len);
		*index = add_index(expr, text, text_len);
		return true;
	}
	if (expr->target_base < 0 ? !is_text_name(scope, pou, expr->target, expr->target_len) :
				    !is_text(scope, pou, scope_first_of(scope, pou, expr, &expr->node[expr->target_base])))
		return false;
	*index = expr->target_index;
	if (expr->target_base < 0) {
		*base = add_text(expr, EXPR_NAME, expr->target, expr->target_len);
		expr->target_index = -1;
		return true;
	}
	struct expr_node *of = &expr->node[expr->target_base];

	*base = add_node(expr, *of);
	expr->node[*base].inner = false;
	expr->target_index = of->left;
	expr->target_tail = of->tail;
	expr->target_base = of->right;
	return true;
}

/* The value becomes REPLACE(base, LEFT(value, 1), 1, index). */
static void store_letter(struct expr *expr, int base, int index)
{
	int last = add_argument(expr, -1, expr->root), left;

	last = add_argument(expr, last, add_one(expr));
	left = add_node(expr, (struct expr_node){ .op = EXPR_CALL, .text = "LEFT", .len = 4, .left = (int16_t)last,
						  .right = -1 });
	last = add_argument(expr, -1, base);
	last = add_argument(expr, last, left);
	last = add_argument(expr, last, add_one(expr));
	last = add_argument(expr, last, index);
	expr->root = add_node(expr, (struct expr_node){ .op = EXPR_CALL, .text = "REPLACE", .len = 7,
							.left = (int16_t)last, .right = -1 });
}

static bool ends_with_index(const char *text, size_t len)
{
	return len && text[len - 1] == ']';
}

/* Can one of the nodes be a letter? Few statements have any. */
static bool may_have_letters(const struct expr *expr)
{
	for (int i = 0; i < expr->count; i++) {
		const struct expr_node *at = &expr->node[i];

		if (at->op == EXPR_INDEX || (at->op == EXPR_NAME && ends_with_index(at->text, at->len)))
			return true;
	}
	return expr->target && (expr->target_index >= 0 || expr->target_tail.len ||
				ends_with_index(expr->target, expr->target_len));
}

void letters_rewrite(struct scope *scope, const struct pou *pou, struct expr *expr)
{
	const int count = expr->count;
	struct word_table *words = &scope_project(scope)->words;
	int base, index;

	if (!may_have_letters(expr))
		return;
	if (word_is_own(words_find(words, "MID", 3)) || word_is_own(words_find(words, "LEFT", 4)) ||
	    word_is_own(words_find(words, "REPLACE", 7)))
		return; /* plain IEC text hides ours */

	for (int i = 0; i < count && expr->count + ROOM < LIMIT_EXPR_NODES; i++)
		if (letter_at(scope, pou, expr, i, &base, &index))
			read_letter(expr, i, base, index);
	if (expr->target && expr->count + 2 * ROOM < LIMIT_EXPR_NODES && take_target(scope, pou, expr, &base, &index))
		store_letter(expr, base, index);
}
