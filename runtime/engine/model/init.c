/* SPDX-License-Identifier: MIT
 *
 * init - walks the initial values of arrays and structures without recursion.
 *
 * A constant must fit its type, a member must exist and be named once, and a list is no
 * longer than its array.
 */
#include "engine/model/init.h"
#include "engine/base/name.h"

#include "engine/model/expr.h"
#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>

bool init_has_parts(const struct var *var)
{
	return var->has_init && var->type == IEC_NONE;
}

static bool fail(struct init_walk *walk, enum diag_id why, const char *arg, size_t len)
{
	walk->why = why;
	walk->arg = arg;
	walk->arg_len = len;
	return false;
}

static bool fail_expected(struct init_walk *walk, const char *what)
{
	return fail(walk, DIAG_EXPECTED, what, strlen(what));
}

static bool fail_sign(struct init_walk *walk, const char *sign)
{
	return fail(walk, DIAG_SIGN_MISSING, sign, strlen(sign));
}

static bool fail_token(struct init_walk *walk, enum diag_id why)
{
	return fail(walk, why, walk->lex.token.text, walk->lex.token.len);
}

/* Steps over @symbol, which is required. */
static bool take(struct init_walk *walk, const char *symbol)
{
	return lex_accept(&walk->lex, symbol) || fail_sign(walk, symbol);
}

static struct init_level *top_of(struct init_walk *walk)
{
	return &walk->level[walk->depth - 1];
}

void init_begin(struct init_walk *walk, const struct project *project,
		const struct var *var, struct arena *scratch)
{
	const struct names *names = &project->names;

	memset(walk, 0, sizeof(*walk));
	walk->project = project;
	walk->var = var;
	walk->scratch = scratch;
	walk->why = DIAG_COUNT;
	walk->level[0].item = shape_pin(var);
	lex_init(&walk->lex, names_text(names, var_value_text(var)),
		 names_len(names, var_value_text(var)));
	walk->lex.wide = true;
	lex_next(&walk->lex);
}

/* ---- lists and structures ---- */

/* A new level on top; its room for member names is kept from earlier use. */
static struct init_level *push(struct init_walk *walk)
{
	struct init_level *level;

	if (walk->depth == INIT_DEPTH) {
		fail(walk, DIAG_TOO_DEEP, "", 0);
		return NULL;
	}
	level = &walk->level[walk->depth++];
	level->row = NULL;
	level->element = level->count = level->times = 0;
	level->pin = -1;
	level->bare = level->row_of = false;
	level->dims = 0;
	return level;
}

static bool open_list(struct init_walk *walk, struct word_pin item, uint32_t base)
{
	struct extent extent = shape_of(&walk->project->words, &item);
	struct init_level *level;

	if (!take(walk, "["))
		return false;
	level = push(walk);
	if (!level)
		return false;
	level->base = base;
	level->unit = extent.unit;
	level->count = item.elements;
	level->item = item;
	level->item.elements = 0;
	return true;
}

/* The list that was opened has the dimensions of @var. */
static void take_dims(struct init_walk *walk, const struct var *var)
{
	struct init_level *level = top_of(walk);

	level->dim = var->dim;
	level->dims = var->dims;
}

/* Elements of each list in the list. */
static uint32_t row_count(const struct init_level *level)
{
	return level->dims > 1 ? vars_flat(level->dim + 1, level->dims - 1).count : 0;
}

/* `[3, 4]` in a list of several dimensions. */
static bool open_row(struct init_walk *walk, struct init_level *outer, uint32_t base)
{
	struct init_level *level;

	if (!take(walk, "["))
		return false;
	level = push(walk);
	if (!level)
		return false;
	level->base = base;
	level->unit = outer->unit;
	level->count = row_count(outer);
	level->item = outer->item;
	level->dim = outer->dim + 1;
	level->dims = outer->dims - 1;
	level->row_of = true;
	return true;
}

/* Allocates marks for members that were named. */
static bool make_room(struct init_walk *walk, struct init_level *level)
{
	if (!walk->scratch || level->room >= level->row->pin_count)
		return true;
	level->room = level->row->pin_count;
	level->turn = 0;
	level->given = arena_alloc(walk->scratch,
				   level->room * sizeof(*level->given));
	return level->given || fail(walk, DIAG_NO_MEMORY, "", 0);
}

static bool open_members(struct init_walk *walk, enum word word, uint32_t base,
			 bool bare)
{
	struct init_level *level;

	if (!bare && !take(walk, "("))
		return false;
	level = push(walk);
	if (!level)
		return false;
	level->row = words_row(&walk->project->words, word);
	level->word = word;
	level->base = base;
	level->bare = bare;
	if (!make_room(walk, level))
		return false;
	level->turn++;
	return true;
}

/* ---- values ---- */

/* Whether a smaller value would fit: then the kind is right. */
static bool is_kind(const struct literal *literal, enum iec_type type)
{
	if (literal->type != IEC_NONE)
		return literal->type == type;
	return !literal->real && !(iec_type_row(type)->class &
				   (CLASS_TIME | ANY_DATE | CLASS_STRING));
}

/* From the first token of an expression to the one behind it. */
static bool take_expression(struct init_walk *walk, struct init_value *out)
{
	const char *text = walk->lex.token.text, *end = text;
	enum diag_id why = DIAG_BAD_LITERAL;

	expr_skip(&walk->lex, &end);
	out->text = text;
	out->len = (size_t)(end - text);
	walk->from = text;
	walk->behind = end;
	if (walk->fold.value)
		why = walk->fold.value(walk->fold.context, text, out->len, out);
	return why == DIAG_COUNT || fail(walk, why, text, out->len);
}

static bool take_constant(struct init_walk *walk, const struct word_pin *pin,
			  struct init_value *out)
{
	struct lex *lex = &walk->lex;
	const char *text = lex->token.text;
	enum diag_id why = DIAG_BAD_LITERAL;
	enum literal_result result;
	size_t len;

	out->type = pin->type;
	out->capacity = pin->capacity;
	if (expr_begins(*lex))
		return take_expression(walk, out);
	if (lex_is(lex, "-") || lex_is(lex, "+"))
		lex_next(lex);
	if (lex->token.kind != TOKEN_NUMBER && lex->token.kind != TOKEN_NAME)
		return fail_expected(walk, "constant");
	len = (size_t)(lex->token.text + lex->token.len - text);
	result = literal_parse(text, len, &out->literal);
	if (result == LITERAL_RANGE ||
	    (result == LITERAL_OK && is_kind(&out->literal, pin->type)))
		why = DIAG_LITERAL_RANGE;
	if (result != LITERAL_OK ||
	    !literal_fit(&out->literal, pin->type, &out->value))
		return fail(walk, why, text, len);
	out->text = walk->from = text;
	out->len = len;
	walk->behind = text + len;
	lex_next(lex);
	return true;
}

/* The value of @pin at @base. True with @out->type set: a constant. True with IEC_NONE:
 * a list or structure was opened. */
static bool take_value(struct init_walk *walk, const struct word_pin *pin,
		       uint32_t base, struct init_value *out)
{
	out->type = IEC_NONE;
	out->offset = base;
	if (pin->elements)
		return open_list(walk, *pin, base);
	if (pin->type == IEC_NONE)
		return open_members(walk, pin->word, base, false);
	return take_constant(walk, pin, out);
}

/* ---- repeated values ---- */

/* Does an operand end with @token, so that a ( behind it begins no operand and no call? */
static bool ends_operand(const struct init_walk *walk, const struct token *token)
{
	static const char *const operators[] = { "AND", "OR", "XOR", "NOT", "MOD" };
	struct word_table *words = walk->fold.words;

	if (token->kind == TOKEN_NUMBER)
		return true;
	if (token->kind == TOKEN_SYMBOL)
		return *token->text == ')' || *token->text == ']';
	if (token->kind != TOKEN_NAME || !words)
		return false;
	for (size_t i = 0; i < sizeof(operators) / sizeof(*operators); i++)
		if (name_is(operators[i], token->text, token->len))
			return false;
	return words_row(words, words_find(words, token->text, token->len))->kind != WORD_FN;
}

/* Is it `(Speed :=`, of a structure? */
static bool begins_members(struct lex lex)
{
	return lex_is(&lex, "(") && lex_next(&lex) == TOKEN_NAME &&
	       (lex_next(&lex), lex_is(&lex, ":="));
}

/* Steps to the ( of `2 * N(7)`; @end gets the end of its count. False: no count stands here. */
static bool skip_count(const struct init_walk *walk, struct lex *lex, const char **end)
{
	struct token before = { .kind = TOKEN_END };
	int open = 0;

	if (begins_members(*lex))
		return false;
	for (; lex->token.kind != TOKEN_END; lex_next(lex)) {
		const bool opens = lex_is(lex, "(") || lex_is(lex, "[");
		const bool closes = lex_is(lex, ")") || lex_is(lex, "]");

		if (!open && lex_is(lex, "(") && ends_operand(walk, &before))
			return true;
		if (!open && (closes || lex_is(lex, ",") || lex_is(lex, ":=")))
			return false;
		open += opens;
		open -= closes;
		before = lex->token;
		*end = before.text + before.len;
	}
	return false;
}

/* The number of a count. */
static bool compute_count(struct init_walk *walk, const char *text, size_t len, int64_t *out)
{
	struct init_value value = { .type = IEC_NONE };
	struct literal literal;
	enum literal_result result;
	enum diag_id why;
	const bool negative = *text == '-';
	struct lex lex = walk->lex;

	if (negative || *text == '+')
		lex_next(&lex);
	result = lex.token.kind == TOKEN_NUMBER && lex.token.text + lex.token.len == text + len ?
		 literal_parse(lex.token.text, lex.token.len, &literal) : LITERAL_NONE;
	if (result == LITERAL_OK && literal.type == IEC_NONE && !literal.real && !literal.high) {
		*out = negative ? -literal.value.i : literal.value.i;
		return true;
	}
	if (result != LITERAL_NONE || !walk->fold.value)
		return fail(walk, result == LITERAL_RANGE ? DIAG_LITERAL_RANGE : DIAG_REPEAT_KIND, text, len);
	why = walk->fold.value(walk->fold.context, text, len, &value);
	*out = value.value.i;
	return why == DIAG_COUNT || fail(walk, why, text, len);
}

/* `3(` or `2 * N(`: a repeated value. */
static bool take_times(struct init_walk *walk, struct init_level *level)
{
	const char *text = walk->lex.token.text, *end = text;
	struct lex ahead = walk->lex;

	level->times = 0;
	if (!skip_count(walk, &ahead, &end))
		return true;
	if (!compute_count(walk, text, (size_t)(end - text), &walk->count))
		return false;
	walk->left = level->count - level->element;
	if (lex_next(&ahead) == TOKEN_SYMBOL && lex_is(&ahead, "[") && row_count(level))
		walk->left /= row_count(level);
	if (walk->count < 1 || walk->count > walk->left) {
		level->element++; /* init_where() names the one before it */
		return fail(walk, walk->count < 1 ? DIAG_REPEAT_NONE : DIAG_REPEAT_MANY, text,
			    (size_t)(end - text));
	}
	walk->lex = ahead;
	level->times = (uint32_t)walk->count;
	level->again = ahead;
	return true;
}

/* Whether members follow without a ( of their own. */
static bool is_bare(const struct init_walk *walk, const struct word_pin *item)
{
	struct lex ahead = walk->lex;

	if (item->type != IEC_NONE || ahead.token.kind != TOKEN_NAME)
		return false;
	lex_next(&ahead);
	return lex_is(&ahead, ":=");
}

/* The next element of a list. */
static bool take_element(struct init_walk *walk, struct init_level *level,
			 struct init_value *out)
{
	uint32_t base = level->base + level->element * level->unit, left, step = 1;

	if (!level->times && !take_times(walk, level))
		return false;
	left = level->count - level->element;
	if (lex_is(&walk->lex, "[") && row_count(level)) {
		if (left < row_count(level))
			return fail(walk, DIAG_TOO_MANY_VALUES, "", 0);
		level->element += row_count(level);
		out->type = IEC_NONE;
		return open_row(walk, level, base);
	}
	if ((level->times ? level->times : 1) > left)
		return fail(walk, DIAG_TOO_MANY_VALUES, "", 0);
	if (level->times && (walk->scratch || lex_is(&walk->lex, ")"))) {
		step = level->times; /* all repetitions at once */
		level->times = 1;
	}
	level->element += step;
	out->type = IEC_NONE;
	if (level->times && lex_is(&walk->lex, ")"))
		return true;         /* n(): the declared value, n times */
	if (level->times && is_bare(walk, &level->item))
		return open_members(walk, level->item.word, base, true);
	return take_value(walk, &level->item, base, out);
}

static bool may_be_given(const struct word_row *row, const struct word_pin *pin)
{
	return row->kind == WORD_STRUCT || pin->dir == PIN_IN;
}

/* `Speed := 5` of a structure. */
static bool take_member(struct init_walk *walk, struct init_level *level,
			struct init_value *out)
{
	const struct token name = walk->lex.token;
	const struct var_table *table;
	const struct word_pin *pin;
	int index;

	if (name.kind != TOKEN_NAME)
		return fail_expected(walk, "name of a member");
	index = word_pin_find(level->row, name.text, name.len);
	if (index < 0 || index >= level->row->pin_count)
		return fail_token(walk, DIAG_NO_PIN);
	pin = &level->row->pin[index];
	level->pin = index;
	if (!may_be_given(level->row, pin))
		return fail_token(walk, DIAG_PIN_DIRECTION);
	if (walk->scratch && level->given[index] == level->turn)
		return fail_token(walk, DIAG_DUPLICATE_ARG);
	if (walk->scratch)
		level->given[index] = level->turn;
	lex_next(&walk->lex);
	table = shape_vars(walk->project, level->word);
	if (!take(walk, ":=") || !take_value(walk, pin, level->base + pin->offset, out))
		return false;
	if (pin->elements && table && index < table->count)
		take_dims(walk, &table->var[index]);
	return true;
}

/* ---- the end of a value ---- */

/* Behind the value of n( … ). False: the value is repeated, or the ) is missing. */
static bool end_times(struct init_walk *walk, struct init_level *level)
{
	if (!lex_is(&walk->lex, ")"))
		return fail_sign(walk, ")");
	if (--level->times) {
		walk->lex = level->again;
		return false;
	}
	lex_next(&walk->lex);
	return true;
}

/* Steps to the next value of the innermost list or structure with more values. False:
 * no more, or an error. */
static bool step_on(struct init_walk *walk)
{
	while (walk->depth > 0) {
		struct init_level *level = top_of(walk);

		if (level->times && !end_times(walk, level))
			return walk->why == DIAG_COUNT;
		if (lex_accept(&walk->lex, ","))
			return true;
		if (level->row && level->bare) {
			walk->depth--; /* the ) closes n( … ) */
			continue;
		}
		if (!take(walk, level->row ? ")" : "]"))
			return false;
		walk->depth--;
	}
	if (walk->lex.token.kind != TOKEN_END)
		fail_token(walk, DIAG_SYNTAX);
	return false;
}

/* Takes the value at the token; an inner list or structure may be open afterwards. */
static bool take_next(struct init_walk *walk, struct init_value *out)
{
	const struct word_pin first = walk->level[0].item;
	struct init_level *level;

	if (!walk->begun) {
		walk->begun = true;
		if (!take_value(walk, &first, 0, out))
			return false;
		if (first.elements)
			take_dims(walk, walk->var);
		return true;
	}
	level = top_of(walk);
	return level->row ? take_member(walk, level, out) :
			    take_element(walk, level, out);
}

bool init_next(struct init_walk *walk, struct init_value *out)
{
	bool inside = !walk->begun; /* two values without a comma */
	int depth;

	memset(out, 0, sizeof(*out));
	do {
		if (!inside && !step_on(walk))
			return false;
		depth = walk->depth;
		if (!take_next(walk, out))
			return false;
		inside = walk->depth > depth;
	} while (out->type == IEC_NONE);
	return true;
}

/* ---- what a walk found ---- */

static bool push_values(struct project *project, struct var *var, struct var_init values)
{
	struct var_init *slot;

	if (!values.count)
		return true;
	slot = arena_push(&project->arena, &var->init_list, &var->init_count, sizeof(*slot));
	if (slot)
		*slot = values;
	return slot;
}

bool init_keep(const struct init_walk *walk, struct project *project, struct var *var,
	       const struct init_value *value, uint32_t *next)
{
	const struct word_pin like = shape_pin(var);
	const struct init_level *top = &walk->level[walk->depth - 1];
	const uint32_t unit = shape_of(&project->words, &like).unit, at = value->offset / unit;
	struct var_init values;

	if (!push_values(project, var, (struct var_init){ .count = at - *next }))
		return false;
	*next = top->base / unit + top->element;
	values = (struct var_init){ .count = *next - at, .value = value->value };
	if (value->type == IEC_STRING)
		values.text = names_intern(&project->names, value->text, value->len);
	return push_values(project, var, values);
}

#define SAY_MOST 30 /* bytes of the faulty value, so that its column is known */

void init_say(const struct init_walk *walk, char *out, size_t size)
{
	const int len = walk->arg_len < SAY_MOST ? (int)walk->arg_len : SAY_MOST;
	const bool count = walk->why == DIAG_REPEAT_NONE || walk->why == DIAG_REPEAT_MANY;
	const char *text = walk->arg_len ? walk->arg : "";
	char number[24], left[24] = "";

	snprintf(number, sizeof(number), "%lld", (long long)walk->count);
	if (walk->why == DIAG_REPEAT_MANY)
		snprintf(left, sizeof(left), DIAG_AND "%u", (unsigned int)walk->left);
	if (!count || (strlen(number) == walk->arg_len && !memcmp(number, text, walk->arg_len)))
		snprintf(out, size, "%.*s%s", len, text, left);
	else
		snprintf(out, size, "%.*s = %s%s", len, text, number, left);
}

/* Elements in the rows before the list @at of the walk. */
static long long row_begin(const struct init_walk *walk, int at)
{
	int first = at;

	while (first > 0 && walk->level[first].row_of)
		first--;
	return (walk->level[at].base - walk->level[first].base) / walk->level[at].unit;
}

void init_where(const struct init_walk *walk, char *out, size_t size)
{
	size_t used = 0;

	*out = '\0';
	for (int i = 0; i < walk->depth && used < size; i++) {
		const struct init_level *level = &walk->level[i];
		int len = 0;

		if (level->row && level->pin >= 0)
			len = snprintf(out + used, size - used, ".%s",
				       level->row->pin[level->pin].name);
		else if (!level->row && level->element &&
			 !(i + 1 < walk->depth && walk->level[i + 1].row_of))
			len = snprintf(out + used, size - used, "[%lld]",
				       (long long)level->item.low + level->element - 1 +
				       (level->row_of ? row_begin(walk, i) : 0));
		used += len > 0 ? (size_t)len : 0;
	}
}

bool init_names_pin(const char *text, size_t len, const char *pin)
{
	struct lex lex;

	lex_init(&lex, text, len);
	lex.wide = true;
	while (lex_next(&lex) != TOKEN_END) {
		struct lex ahead = lex;

		if (lex.token.kind == TOKEN_NAME &&
		    name_is(pin, lex.token.text, lex.token.len) &&
		    (lex_next(&ahead), lex_is(&ahead, ":=")))
			return true;
	}
	return false;
}
