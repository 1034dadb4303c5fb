/* SPDX-License-Identifier: MIT
 *
 * expr_args - arguments of a function in an expression, in order or by name.
 */
#include "engine/model/expr_args.h"

#include "engine/base/ascii.h"

#include <stdio.h>

enum word expr_function(struct word_table *words, const struct expr_node *call)
{
	enum word word = words_find(words, call->text, call->len);

	return words_row(words, word)->kind == WORD_FN ? word : WORD_COUNT;
}

bool expr_is_clock(const struct expr_node *node)
{
	return node->op == EXPR_CALL && node->left < 0 && ascii_is("TIME", node->text, node->len);
}

struct expr_node *expr_measured(struct expr *expr, const struct expr_node *call,
				enum expr_measure *what)
{
	static const struct { const char *word; enum expr_measure what; } rows[] = {
		{ "ADR", MEASURE_PLACE }, { "REF", MEASURE_PLACE }, { "SIZEOF", MEASURE_SIZE },
		{ "__ISVALIDREF", MEASURE_VALID },
	};
	struct expr_node *arg = call->left >= 0 ? &expr->node[call->left] : NULL;

	if (call->op != EXPR_CALL || !arg || arg->right >= 0 || (arg->len && !ascii_is("IN", arg->text, arg->len)))
		return NULL;
	for (size_t i = 0; i < sizeof(rows) / sizeof(*rows); i++)
		if (ascii_is(rows[i].word, call->text, call->len)) {
			*what = rows[i].what;
			return &expr->node[arg->left];
		}
	return NULL;
}

bool expr_is_bound(const struct expr_node *call)
{
	return call->op == EXPR_CALL && (ascii_is("LOWER_BOUND", call->text, call->len) ||
					 ascii_is("UPPER_BOUND", call->text, call->len));
}

bool expr_bound(struct expr *expr, const struct expr_node *call, struct expr_bound *out)
{
	const struct expr_node *arg[2] = { NULL, NULL };
	int count = 0, at = call->left;

	if (!expr_is_bound(call))
		return false;
	for (; at >= 0 && count < 2; at = expr->node[at].right)
		arg[count++] = &expr->node[at]; /* from the last one on */
	if (count != 2 || at >= 0)
		return false;
	*out = (struct expr_bound){ .upper = ascii_is("UPPER_BOUND", call->text, call->len) };
	for (int i = 0; i < 2; i++) {
		const bool array = arg[i]->len ? ascii_is("ARR", arg[i]->text, arg[i]->len) : i == 1;

		if (arg[i]->len && !array && !ascii_is("DIM", arg[i]->text, arg[i]->len))
			return false;
		if (array)
			out->array = &expr->node[arg[i]->left];
		else
			out->number = &expr->node[arg[i]->left];
	}
	return out->array && out->number;
}

int expr_pin_name(const struct word_row *row, int index, char *out, size_t size)
{
	if (index < row->pin_count)
		return snprintf(out, size, "%s", row->pin[index].name);
	return snprintf(out, size, "IN%d",
			index - (row->pin_count - 1) + word_last_number(row));
}

/* A row of a word of the project: its pins have a direction, and no input may be left
 * out. */
static bool is_own(const struct word_row *row)
{
	return row->most_inputs == 0;
}

static bool takes(const struct word_row *row, int index)
{
	return !is_own(row) || row->pin[index].dir == PIN_IN ||
	       row->pin[index].dir == PIN_IN_OUT;
}

/* GT(A, B, C) is A > B AND B > C in an expression. */
static int most_of(const struct word_row *row)
{
	if (is_own(row))
		return row->pin_count;
	return row->number == FN_GT || row->number == FN_GE || row->number == FN_EQ ||
	       row->number == FN_LE || row->number == FN_LT ? LIMIT_FN_INPUTS : row->most_inputs;
}

/* The next pin after @index for an argument without a name; -1: none. */
static int next_pin(const struct word_row *row, int index)
{
	int most = most_of(row);

	while (++index < most)
		if (takes(row, index))
			return index;
	return -1;
}

static enum diag_id fail(struct expr_args *out, enum diag_id why, int pin,
			 const struct expr_node *arg)
{
	out->wrong = pin;
	out->text = arg ? arg->text : "";
	out->len = arg ? arg->len : 0;
	return why;
}

/* Arguments are linked to the call from right to left. */
static enum diag_id collect(const struct expr *expr, const struct expr_node *call,
			    struct expr_args *out)
{
	int at = call->left;

	for (out->count = 0; at >= 0 && out->count < LIMIT_ARGS;
	     at = expr->node[at].right)
		out->arg[out->count++].at = at;
	if (at >= 0)
		return fail(out, DIAG_TOO_MANY_OPERANDS, -1, call);
	for (int i = 0, k = out->count - 1; i < k; i++, k--) {
		at = out->arg[i].at;
		out->arg[i].at = out->arg[k].at;
		out->arg[k].at = at;
	}
	return DIAG_COUNT;
}

static bool is_enable(const struct word_row *row, const struct expr_node *arg)
{
	return arg->len == 2 && !arg->output && ascii_is("EN", arg->text, arg->len) &&
	       word_pin_find(row, arg->text, arg->len) < 0;
}

/* More arguments without a name than inputs: they are all of the function, in their order. */
static bool has_outputs(const struct expr *expr, const struct word_row *row, const struct expr_args *args)
{
	int inputs = 0, outputs = 0;

	for (int i = 0; i < args->count; i++)
		if (expr->node[args->arg[i].at].len)
			return false;
	for (int i = 0; i < row->pin_count && is_own(row); i++) {
		inputs += takes(row, i);
		outputs += row->pin[i].dir == PIN_OUT;
	}
	return is_own(row) && args->count > inputs && args->count <= inputs + outputs;
}

/* The next input or output behind @pin. */
static int next_any(const struct word_row *row, int pin)
{
	do
		pin++;
	while (pin < row->pin_count && !takes(row, pin) && row->pin[pin].dir != PIN_OUT);
	return pin;
}

/* Moves EN and outputs out of the list of inputs. */
static enum diag_id find_others(const struct expr *expr, const struct word_row *row,
				struct expr_args *out)
{
	const int count = out->count;
	const bool places = has_outputs(expr, row, out);
	int place = -1;

	out->more = out->count = 0;
	for (int i = 0; i < count; i++) {
		const struct expr_node *arg = &expr->node[out->arg[i].at];
		int pin = EXPR_EN;

		place = places ? next_any(row, place) : -1;
		if (place >= 0 && row->pin[place].dir == PIN_OUT) {
			out->other[out->more].at = arg->left;
			out->other[out->more].inverted = false;
			out->other[out->more++].pin = (int16_t)place;
			continue;
		}
		if (!arg->output && !is_enable(row, arg)) {
			out->arg[out->count++].at = out->arg[i].at;
			continue;
		}
		if (arg->output)
			pin = word_pin_find(row, arg->text, arg->len);
		if (arg->output && pin < 0 && ascii_is("ENO", arg->text, arg->len))
			pin = EXPR_ENO;
		else if (arg->output && pin < 0 && ascii_is("OUT", arg->text, arg->len))
			pin = EXPR_OUT;
		else if (arg->output && (pin < 0 || pin >= row->pin_count))
			return fail(out, DIAG_NO_PIN, -1, arg);
		if (pin >= 0 && row->pin[pin].dir != PIN_OUT)
			return fail(out, DIAG_INPUT_READ, pin, arg);
		for (int k = 0; k < out->more; k++)
			if (out->other[k].pin == pin)
				return fail(out, DIAG_DUPLICATE_ARG, -1, arg);
		out->other[out->more].at = arg->left;
		out->other[out->more].inverted = arg->inverted;
		out->other[out->more++].pin = (int16_t)pin;
	}
	return DIAG_COUNT;
}

/* IN3 of a comparison of several is its third pin. */
static int named_pin(const struct word_row *row, const struct expr_node *arg)
{
	const int pin = word_pin_find(row, arg->text, arg->len);
	int number = 0;

	if (pin >= 0 || most_of(row) == row->most_inputs || arg->len < 3 || arg->len > 4 ||
	    !ascii_same(arg->text, "IN", 2) || arg->text[2] == '0')
		return pin;
	for (int i = 2; i < arg->len; i++) {
		if (!ascii_digit(arg->text[i]))
			return pin;
		number = number * 10 + arg->text[i] - '0';
	}
	return number <= most_of(row) ? number - 1 : pin;
}

static enum diag_id find_pins(const struct expr *expr, const struct word_row *row,
			      struct expr_args *out)
{
	int pin = -1;

	for (int i = 0; i < out->count; i++) {
		const struct expr_node *arg = &expr->node[out->arg[i].at];

		out->number = i + 1;

		if (i > 0 && !arg->len && expr->node[out->arg[i - 1].at].len)
			return fail(out, DIAG_MIXED_NAMES, -1, arg);
		pin = arg->len ? named_pin(row, arg) : next_pin(row, pin);
		if (pin < 0 || (pin < row->pin_count && !takes(row, pin)))
			return fail(out, DIAG_NO_PIN, -1, arg);
		for (int k = 0; k < i; k++)
			if (out->arg[k].pin == pin)
				return fail(out, DIAG_DUPLICATE_ARG, pin, arg);
		out->arg[i].pin = pin;
	}
	return DIAG_COUNT;
}

static bool is_given(const struct expr_args *args, int pin)
{
	for (int i = 0; i < args->count; i++)
		if (args->arg[i].pin == pin)
			return true;
	return false;
}

static bool is_needed(const struct word_row *row, const struct expr_args *args, int pin, bool named)
{
	if (is_own(row))
		return takes(row, pin) && !row->pin[pin].has_init && (!named || row->pin[pin].dir == PIN_IN_OUT);
	return pin < row->pin_count || args->count > pin;
}

const struct word_pin *expr_left_out(const struct word_row *row, const struct expr_args *args)
{
	for (int pin = 0; is_own(row) && pin < row->pin_count; pin++)
		if (takes(row, pin) && !row->pin[pin].has_init && !is_given(args, pin))
			return &row->pin[pin];
	return NULL;
}

enum diag_id expr_match(const struct expr *expr, const struct expr_node *call,
			const struct word_row *row, struct expr_args *out)
{
	enum diag_id why = collect(expr, call, out);
	int most = most_of(row);
	bool named = false;

	if (why == DIAG_COUNT)
		why = find_others(expr, row, out);
	if (why == DIAG_COUNT)
		why = find_pins(expr, row, out);
	for (int i = 0; i < out->count && why == DIAG_COUNT; i++)
		named |= expr->node[out->arg[i].at].len > 0;
	for (int pin = 0; pin < most && why == DIAG_COUNT; pin++)
		if (is_needed(row, out, pin, named) && !is_given(out, pin))
			return fail(out, DIAG_MISSING_INPUT, pin, NULL);
	for (int i = 0; i < out->count && why == DIAG_COUNT; i++)
		out->arg[i].at = expr->node[out->arg[i].at].left;
	return why;
}

bool expr_has_wrong_call(const struct expr *expr, struct word_table *words)
{
	for (int i = 0; i < expr->count; i++) {
		const struct expr_node *node = &expr->node[i];
		struct expr_args args = { .wrong = -1, .text = "" };
		enum word word;

		if (node->op != EXPR_CALL)
			continue;
		word = expr_function(words, node);
		if (word != WORD_COUNT && !word_is_own(word) &&
		    expr_match(expr, node, words_row(words, word), &args) != DIAG_COUNT)
			return true;
	}
	return false;
}
