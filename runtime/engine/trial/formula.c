/* SPDX-License-Identifier: MIT
 *
 * formula - expressions of scenarios. One pass over the terms in order, without
 * recursion, so that a hostile file cannot exhaust the stack. The image is not changed.
 */
#include "engine/trial/formula.h"

#include "engine/base/ascii.h"
#include "engine/model/named.h"
#include "engine/trial/value.h"

#include "engine/scan/value.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static enum formula_kind kind_of(enum iec_type type)
{
	switch ((enum iec_class)iec_type_row(type)->class) {
	case CLASS_BOOL:
		return KIND_BOOL;
	case CLASS_REAL:
		return KIND_REAL;
	case CLASS_TIME:
		return KIND_TIME;
	case CLASS_TOD:
		return KIND_TOD;
	case CLASS_DATE:
		return KIND_DATE;
	case CLASS_DT:
		return KIND_DT;
	case CLASS_STRING:
		return KIND_TEXT;
	case CLASS_BITS:
	case CLASS_SIGNED:
	case CLASS_UNSIGNED:
		break;
	}
	return KIND_INT;
}

/* A name that is not known, or not clear. */
static void complain_leaf(const struct formula *formula, struct diag_list *diags, struct diag place,
			  enum diag_id why, const char *line_start, const struct expr_node *at)
{
	char name[64], told[192];

	place.id = why;
	if (at->text)
		place.column = (int)(at->text - line_start) + 1;
	snprintf(name, sizeof(name), "%.*s", at->len < 60 ? (int)at->len : 60,
		 at->text ? at->text : "");
	snprintf(told, sizeof(told), "%s", name);
	if (formula->projects.program)
		named_tell(formula->projects.program, why, name, told, sizeof(told));
	if (why == DIAG_AMBIGUOUS_VALUE && formula->plant)
		snprintf(told + strlen(told), sizeof(told) - strlen(told), " or plant.%s", name);
	diag_add(diags, place, "%s", told);
}

static bool complain(struct diag_list *diags, struct diag place,
		     enum diag_id id, const char *line_start,
		     const struct expr_node *at)
{
	place.id = id;
	if (at->text)
		place.column = (int)(at->text - line_start) + 1;
	return diag_add(diags, place, "%.*s", at->len < 60 ? (int)at->len : 60,
			at->text ? at->text : "");
}

static bool take_text(struct formula_term *term, const struct literal *literal,
		      struct arena *arena, enum diag_id *why)
{
	struct iec_text *room = arena_alloc(arena, sizeof(*room));
	struct iec_string *s = room ? iec_text_init(room, 0) : NULL;

	*why = DIAG_NO_MEMORY;
	term->kind = KIND_TEXT;
	term->value.s = s;
	if (s)
		s->length = (uint16_t)literal_string(literal, s->text);
	return s != NULL;
}

/* A constant: any literal, or a time without T#. */
static bool take_literal(struct formula_term *term, const char *text,
			 size_t len, struct arena *arena, enum diag_id *why)
{
	struct literal literal;
	int64_t ns;
	enum literal_result result = literal_parse(text, len, &literal);

	if (result == LITERAL_OK && literal.type == IEC_STRING)
		return take_text(term, &literal, arena, why);
	if (result == LITERAL_OK) {
		term->value = literal.value;
		term->wide = literal.high || iec_is_wide(literal.type);
		if (literal.type == IEC_NONE)
			term->kind = literal.real ? KIND_REAL : KIND_INT;
		else
			term->kind = (uint8_t)kind_of(literal.type);
		return true;
	}
	*why = result == LITERAL_RANGE ? DIAG_LITERAL_RANGE : DIAG_BAD_LITERAL;
	if (value_parse_time(text, len, 0, &ns) != LITERAL_OK)
		return false;
	term->kind = KIND_TIME;
	term->value.i = ns;
	return true;
}

/* @tail: the path behind the index. */
static bool take_array(const struct image *image, const char *text, size_t len,
		       struct expr_tail tail, struct formula_term *term)
{
	struct declared_name array;

	while (len && text[len - 1] == ' ')
		len--;
	if (!(tail.len ? image_find_members(image, text, len, tail.text, tail.len,
					    &array) :
			 image_find_array(image, text, len, &array)))
		return false;
	term->op = EXPR_INDEX;
	term->kind = (uint8_t)kind_of(array.at.type);
	term->wide = iec_is_wide(array.at.type);
	term->single = array.at.type == IEC_REAL;
	term->at = array.at;
	term->low = array.array.low;
	term->count = array.array.count;
	term->stride = array.stride;
	return true;
}

/* The first index in a name that is not a number; NULL: none. */
static const char *open_index(const char *at, const char *end)
{
	while (at < end && (at = memchr(at, '[', (size_t)(end - at)))) {
		const char *open = at++;

		while (at < end && *at == ' ')
			at++;
		if (at < end && *at != '-' && !ascii_digit(*at))
			return open;
	}
	return NULL;
}

/* `Table[i]`, `Recipes[i].Speed`: the index is read at each evaluation. */
static bool take_element(const struct image *image, const struct expr_node *from,
			 struct formula_term *term, enum diag_id *why)
{
	const char *last = from->text + from->len, *at;
	const char *open = open_index(from->text, last);
	const char *end = open ? memchr(open, ']', (size_t)(last - open)) : NULL;

	if (end && open_index(end, last)) {
		*why = DIAG_ONE_INDEX;
		return false;
	}
	if (!end || !take_array(image, from->text, (size_t)(open - from->text),
				(struct expr_tail){ end + 1,
					(uint16_t)(last - end - 1) }, term))
		return false;
	for (at = open + 1; at < end && *at == ' ';)
		at++;
	while (end > at && end[-1] == ' ')
		end--;
	term->index = value_find(image, at, (size_t)(end - at), why);
	if (term->index.type != IEC_NONE)
		*why = DIAG_INDEX_TYPE;
	return term->index.type != IEC_NONE && kind_of(term->index.type) == KIND_INT;
}

static struct location find_name(const struct formula *formula,
				 const struct image *image, struct formula_term *term,
				 const struct expr_node *from, enum diag_id *why)
{
	const char *name = from->text;
	size_t len = from->len;
	const struct image *side = value_side(image, formula->plant, &name, &len);

	term->plant = side != image;
	return value_find(side, name, len, why);
}

static bool take_number(const struct project *project, const char *name, size_t len,
			int64_t *out, enum diag_id *why)
{
	return project && named_number(project, name, len, out, why);
}

/* `Red`, `Color#Red`, `plant.Open`. */
static bool take_value(const struct formula *formula, const struct image *image,
		       const struct expr_node *from, struct formula_term *term, enum diag_id *why)
{
	const struct project *plant = formula->plant ? formula->projects.plant : NULL;
	const char *name = from->text;
	size_t len = from->len;
	enum diag_id missing = *why;
	int64_t other = 0;
	bool found;

	term->kind = KIND_INT;
	if (value_side(image, formula->plant, &name, &len) != image)
		return take_number(plant, name, len, &term->value.i, why);
	found = take_number(formula->projects.program, name, len, &term->value.i, why);
	if (!take_number(plant, name, len, &other, found ? &missing : why))
		return found;
	if (found && term->value.i != other) {
		*why = DIAG_AMBIGUOUS_VALUE;
		return false;
	}
	term->value.i = other;
	return true;
}

static bool take_leaf(const struct formula *formula, const struct image *image,
		      const struct expr_node *from, struct formula_term *term,
		      struct arena *arena, enum diag_id *why)
{
	term->op = EXPR_LITERAL;
	if (from->op == EXPR_LITERAL)
		return take_literal(term, from->text, from->len, arena, why) ||
		       take_value(formula, image, from, term, why);
	enum diag_id missing;

	term->at = find_name(formula, image, term, from, &missing);
	if (term->at.type == IEC_NONE) {
		if (take_element(image, from, term, &missing))
			return true;
		term->op = EXPR_LITERAL;
		if (take_literal(term, from->text, from->len, arena, why))
			return true;
		*why = missing;
		return take_value(formula, image, from, term, why);
	}
	term->op = EXPR_NAME;
	term->kind = (uint8_t)kind_of(term->at.type);
	term->wide = iec_is_wide(term->at.type);
	term->single = term->at.type == IEC_REAL;
	term->name = arena_copy(arena, from->text, from->len);
	*why = DIAG_NO_MEMORY;
	return term->name != NULL;
}

static bool is_compare(enum word fn)
{
	return word_is_test(word_row(fn));
}

static bool is_number(uint8_t kind)
{
	return kind == KIND_BOOL || kind == KIND_INT || kind == KIND_REAL;
}

/* Result kinds of ADD and SUB with times and dates, MUL and DIV of a time and a number:
 * IEC 61131-3 table 30. */
static bool join_times(struct formula_term *term, uint8_t left, uint8_t right)
{
	bool dated = left == KIND_TOD || left == KIND_DATE || left == KIND_DT;

	term->kind = KIND_TIME;
	if (left == KIND_TIME && (right == KIND_INT || right == KIND_REAL))
		return term->fn == FN_MUL || term->fn == FN_DIV;
	if (left == KIND_TIME && right == KIND_TIME)
		return term->fn == FN_ADD || term->fn == FN_SUB;
	if (dated && left == right)
		return term->fn == FN_SUB;
	term->kind = left;
	return (left == KIND_TOD || left == KIND_DT) && right == KIND_TIME &&
	       (term->fn == FN_ADD || term->fn == FN_SUB);
}

/* The kind of an operation on two kinds; false: not allowed. */
static bool join_kinds(struct formula_term *term, uint8_t left, uint8_t right)
{
	bool real = left == KIND_REAL || right == KIND_REAL;
	bool numbers = is_number(left) && is_number(right);

	if (is_compare(term->fn)) {
		term->kind = KIND_BOOL;
		return numbers || left == right;
	}
	if (!numbers)
		return join_times(term, left, right);
	term->kind = real ? KIND_REAL : KIND_INT;
	return !real || term->fn != FN_MOD;
}

static bool take_operation(const struct formula *formula,
			   struct formula_term *term, enum diag_id *why)
{
	const struct formula_term *left = &formula->term[term->left];
	const struct formula_term *right =
		term->right < 0 ? left : &formula->term[term->right];

	if (term->op == EXPR_INDEX) {
		*why = DIAG_INDEX_TYPE;
		return left->kind == KIND_INT;
	}
	term->single = left->single || right->single;
	*why = DIAG_WRONG_TYPE;
	if (term->op == EXPR_FN)
		return join_kinds(term, left->kind, right->kind);
	if (term->op == EXPR_NEG) {
		term->kind = left->kind;
		return left->kind == KIND_INT || left->kind == KIND_REAL ||
		       left->kind == KIND_TIME;
	}
	*why = DIAG_NOT_BOOL;
	term->kind = KIND_BOOL;
	return left->kind == KIND_BOOL && right->kind == KIND_BOOL;
}

/* The text for an error in an operation: its first operand, or the second if only that
 * is not a required BOOL. */
static const struct expr_node *blame(const struct formula *formula,
				     const struct expr *expr, int at,
				     enum diag_id why)
{
	const struct expr_node *from = &expr->node[at];
	int steps = 0;

	if (why == DIAG_NOT_BOOL && from->right >= 0 &&
	    formula->term[from->left].kind == KIND_BOOL)
		at = from->right;
	while (!expr->node[at].text && expr->node[at].left >= 0 &&
	       steps++ < LIMIT_EXPR_NODES)
		at = expr->node[at].left;
	return &expr->node[at];
}

/* The call that an argument belongs to. */
static const struct expr_node *function_of(const struct expr *expr, int at)
{
	while (expr->node[at].op != EXPR_CALL && at + 1 < expr->count)
		at++;
	return &expr->node[at];
}

/* The index of an array that is there; else the whole name. */
static struct expr_node blame_leaf(const struct expr_node *from, const struct formula_term *term)
{
	const char *last = from->text + from->len;
	const char *open = term->count > 0 ? open_index(from->text, last) : NULL;
	const char *end = open ? memchr(open, ']', (size_t)(last - open)) : NULL;
	struct expr_node at = *from;

	if (end) {
		at.text = open + 1;
		at.len = (uint16_t)(end - open - 1);
	}
	return at;
}

/* `Word.3` as one name. */
static struct expr_node part_name(const struct expr *expr, const struct expr_node *from)
{
	const struct expr_node *of = &expr->node[from->left];
	const char *text = of->text;

	return (struct expr_node){ .op = EXPR_NAME, .text = text, .left = -1, .right = -1,
		.len = (uint16_t)(text ? from->tail.text + from->tail.len - text : 0) };
}

struct formula *formula_new(const struct image *image, const struct image *plant,
			    struct formula_projects projects, const struct expr *expr,
			    struct arena *arena, const char *line_start,
			    struct diag_list *diags, struct diag place)
{
	struct formula *formula = arena_alloc(arena, sizeof(*formula));
	size_t size = sizeof(*formula->term) * (size_t)expr->count;

	if (formula)
		formula->term = arena_alloc(arena, size);
	if (!formula || !formula->term) {
		complain(diags, place, DIAG_NO_MEMORY, line_start,
			 &(struct expr_node){ .text = NULL });
		return NULL;
	}
	formula->constant = true;
	formula->plant = plant;
	formula->projects = projects;
	formula->count = expr->count;
	formula->root = expr->root;
	for (int i = 0; i < expr->count; i++) {
		const struct expr_node *from = &expr->node[i];
		struct formula_term *term = &formula->term[i];
		enum diag_id why = DIAG_SYNTAX;
		bool leaf = from->op == EXPR_NAME || from->op == EXPR_LITERAL;

		term->op = (uint8_t)from->op;
		term->fn = (uint16_t)from->fn;
		term->left = from->left;
		term->right = from->right;
		if (from->op == EXPR_INDEX &&
		    (from->inner || from->right >= 0 ||
		     open_index(from->text, from->text + from->len) ||
		     open_index(from->tail.text, from->tail.text + from->tail.len))) {
			complain(diags, place, DIAG_ONE_INDEX, line_start, from);
			return NULL;
		}
		if (from->op == EXPR_BIT) {
			const struct expr_node part = part_name(expr, from);

			if (take_leaf(formula, image, &part, term, arena, &why)) {
				formula->constant = false;
				continue;
			}
			complain_leaf(formula, diags, place, why, line_start, &part);
			return NULL;
		}
		if (from->op == EXPR_CALL || from->op == EXPR_ARG) {
			complain(diags, place, DIAG_NO_CALLS_HERE, line_start,
				 function_of(expr, i));
			return NULL;
		}
		if (from->op == EXPR_INDEX &&
		    !take_array(image, from->text, from->len, from->tail, term)) {
			complain(diags, place, DIAG_NOT_ARRAY, line_start, from);
			return NULL;
		}
		if (leaf ? !take_leaf(formula, image, from, term, arena, &why) :
			   !take_operation(formula, term, &why)) {
			const struct expr_node at = blame_leaf(from, term);

			if (leaf)
				complain_leaf(formula, diags, place, why, line_start, &at);
			else
				complain(diags, place, why, line_start,
					 blame(formula, expr, i, why));
			return NULL;
		}
		formula->constant &= term->op != EXPR_NAME &&
				     term->op != EXPR_INDEX;
	}
	return formula;
}

static double as_real(const struct formula_term *term)
{
	if (term->kind == KIND_REAL)
		return term->value.r;
	return term->wide ? (double)(uint64_t)term->value.i : (double)term->value.i;
}

/* <0, 0, >0; unsigned values with the top bit set are above INT64_MAX. */
static int order_of(const struct formula_term *left, const struct formula_term *right)
{
	int64_t a = left->value.i, b = right->value.i;
	bool high = left->wide && a < 0, other = right->wide && b < 0;

	if (left->kind == KIND_TEXT)
		return value_order(left->value.s, right->value.s);
	if (high != other)
		return high ? 1 : -1;
	return (a > b) - (a < b);
}

static bool compare(struct formula_term *term, const struct formula_term *left,
		    const struct formula_term *right)
{
	bool less, equal;

	if (left->kind == KIND_REAL || right->kind == KIND_REAL) {
		double a = as_real(left), b = as_real(right);

		if (term->single) {
			a = (double)(float)a;
			b = (double)(float)b;
		}
		less = a < b;
		equal = a >= b && a <= b;
	} else {
		less = order_of(left, right) < 0;
		equal = order_of(left, right) == 0;
	}
	if (term->fn == FN_LT)
		term->value.i = less;
	else if (term->fn == FN_LE)
		term->value.i = less || equal;
	else if (term->fn == FN_EQ)
		term->value.i = equal;
	else if (term->fn == FN_NE)
		term->value.i = !equal;
	else if (term->fn == FN_GE)
		term->value.i = !less;
	else
		term->value.i = !less && !equal;
	return true;
}

static bool divide(struct formula_term *term, int64_t a, int64_t b)
{
	if (b == 0 || (a == INT64_MIN && b == -1))
		return false;
	term->value.i = term->fn == FN_DIV ? a / b : a % b;
	return true;
}

static bool calculate_real(struct formula_term *term, double a, double b)
{
	if (term->fn == FN_ADD)
		term->value.r = a + b;
	else if (term->fn == FN_SUB)
		term->value.r = a - b;
	else if (term->fn == FN_MUL)
		term->value.r = a * b;
	else
		term->value.r = a / b;
	return isfinite(term->value.r);
}

/* A time and a REAL: to the nearest nanosecond. */
static bool scale_time(struct formula_term *term, double time, double by)
{
	double ns;

	if (!calculate_real(term, time, by))
		return false;
	ns = rint(term->value.r);
	if (fabs(ns) >= 9223372036854775808.0)
		return false;
	term->value.i = (int64_t)ns;
	return true;
}

static bool calculate(struct formula_term *term,
		      const struct formula_term *left,
		      const struct formula_term *right)
{
	if (term->kind == KIND_TIME && right->kind == KIND_REAL)
		return scale_time(term, (double)left->value.i, right->value.r);
	if (term->kind != KIND_REAL) {
		int64_t a = left->value.i, b = right->value.i;

		if (term->fn == FN_ADD)
			return !__builtin_add_overflow(a, b, &term->value.i);
		if (term->fn == FN_SUB)
			return !__builtin_sub_overflow(a, b, &term->value.i);
		if (term->fn == FN_MUL)
			return !__builtin_mul_overflow(a, b, &term->value.i);
		return divide(term, a, b);
	}
	return calculate_real(term, as_real(left), as_real(right));
}

static bool negate(struct formula_term *term, const struct formula_term *left)
{
	if (term->kind == KIND_REAL) {
		term->value.r = -left->value.r;
		return true;
	}
	return !__builtin_sub_overflow(INT64_C(0), left->value.i,
				       &term->value.i);
}

static bool read_element(struct formula_term *term, const struct image *image,
			 int64_t index)
{
	struct location at = term->at;

	if (index < term->low || index - term->low >= term->count)
		return false;
	at.where += (uint32_t)(index - term->low) * term->stride;
	term->value = image_get(image, at);
	return true;
}

static bool evaluate(struct formula *formula, struct formula_term *term,
		     const struct image *image)
{
	const struct formula_term *left = &formula->term[
		term->left < 0 ? 0 : term->left];
	const struct formula_term *right = &formula->term[
		term->right < 0 ? 0 : term->right];

	switch ((enum expr_op)term->op) {
	case EXPR_NAME:
		term->value = image_get(term->plant ? formula->plant : image, term->at);
		return true;
	case EXPR_LITERAL:
	case EXPR_CALL: /* used by no operator */
	case EXPR_ARG:
	case EXPR_BIT:
		return true;
	case EXPR_INDEX:
		return read_element(term, image, term->left < 0 ?
				    image_get(image, term->index).i :
				    left->value.i);
	case EXPR_NEG:
		return negate(term, left);
	case EXPR_NOT:
		term->value.i = !left->value.i;
		return true;
	case EXPR_FN:
		return is_compare(term->fn) ? compare(term, left, right) :
					      calculate(term, left, right);
	case EXPR_AND:
		term->value.i = left->value.i && right->value.i;
		return true;
	case EXPR_XOR:
		term->value.i = !left->value.i != !right->value.i;
		return true;
	case EXPR_OR:
		term->value.i = left->value.i || right->value.i;
		return true;
	}
	return false;
}

bool formula_value(struct formula *formula, const struct image *image,
		   union iec_value *out)
{
	for (int i = 0; i < formula->count; i++)
		if (!evaluate(formula, &formula->term[i], image))
			return false;
	*out = formula->term[formula->root].value;
	return true;
}

enum formula_kind formula_kind(const struct formula *formula)
{
	return (enum formula_kind)formula->term[formula->root].kind;
}

bool formula_can_set(const struct formula *formula, enum iec_type type)
{
	enum formula_kind from = formula_kind(formula), to = kind_of(type);

	if (from == to)
		return true;
	return is_number(to) && (from == KIND_INT || (from == KIND_BOOL &&
						      to == KIND_INT));
}

bool formula_fit(const struct formula *formula, union iec_value value,
		 enum iec_type type, union iec_value *out)
{
	const struct iec_type_row *row = iec_type_row(type);
	const struct formula_term *term = &formula->term[formula->root];

	*out = value;
	if (row->class == CLASS_STRING)
		return true;
	if (row->class == CLASS_REAL) {
		out->r = term->kind == KIND_REAL ? value.r :
			 term->wide ? (double)(uint64_t)value.i : (double)value.i;
		if (type == IEC_REAL)
			out->r = (double)(float)out->r;
		return isfinite(out->r);
	}
	if (term->wide && value.i < 0)
		return iec_is_wide(type);
	return value.i >= row->low && value.i <= row->high;
}
