/* SPDX-License-Identifier: MIT
 *
 * st_compute - expressions: types from the operands, values from left to right, and what
 * happens when one of them cannot be computed (docs/st.md, Expressions).
 */
#include "tests/st/inside.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* ---- places ---- */

static struct slot *begin_of(struct frame_of *f, const struct tree *tree)
{
	return tree->global ? tree->global : &f->locals->part[tree->local];
}

struct slot *tree_first(struct frame_of *f, const struct tree *tree)
{
	struct slot *slot = begin_of(f, tree);

	for (const struct step *step = tree->step; slot && step; step = step->next)
		slot = step->through ? slot->shape : step->index ? &slot->part[0] :
		       slot_member(slot, step->name, step->len);
	return slot;
}

static bool is_beyond(const struct slot *slot, struct value index)
{
	if (index.type == IEC_ULINT || index.type == IEC_LWORD) {
		if (index.i < 0)
			return true;
	}
	return index.i < slot->low || index.i - slot->low >= slot->count;
}

/* A name or a number. */
static bool is_plain(const struct tree *index)
{
	if (index->kind != TREE_PLACE)
		return index->kind == TREE_CONSTANT;
	for (const struct step *step = index->step; step; step = step->next)
		if (step->index || step->through)
			return false;
	return !index->bits;
}

/* What the pointer leads to; @there becomes false if that is nowhere. */
static struct slot *led_by(const struct slot *pointer, bool *there)
{
	*there = *there && pointer->led;
	return *there ? pointer->led : pointer->shape;
}

static struct value index_value(struct frame_of *f, const struct tree *index, struct chain_state *chain)
{
	return tree_compute(f, index, tree_type(f, index, IEC_NONE) ? IEC_NONE : IEC_DINT, chain);
}

struct slot *tree_slot(struct frame_of *f, const struct tree *tree, struct chain_state *chain)
{
	struct slot *slot = begin_of(f, tree);
	bool there = true;

	for (const struct step *step = tree->step; step; step = step->next) {
		struct value index;

		if (step->through) {
			slot = led_by(slot, &there);
			continue;
		}
		if (!step->index) {
			slot = slot_member(slot, step->name, step->len);
			continue;
		}
		index = index_value(f, step->index, chain);
		if (!chain->on)
			return NULL;
		there = there && !is_beyond(slot, index);
		slot = &slot->part[there ? index.i - slot->low : 0];
	}
	if (there)
		return slot;
	f->world->errors++;
	chain->on = false;
	return NULL;
}

void target_begin(struct frame_of *f, const struct tree *tree, struct chain_state *chain,
		  struct value index[INDICES_MAX])
{
	int n = 0;

	for (const struct step *step = tree->step; step && n < INDICES_MAX; step = step->next)
		if (step->index && !is_plain(step->index))
			index[n++] = index_value(f, step->index, chain);
}

struct slot *target_slot(struct frame_of *f, const struct tree *tree, const struct value index[INDICES_MAX])
{
	struct chain_state chain = { .on = true };
	struct slot *slot = begin_of(f, tree);
	bool there = true;
	int n = 0;

	for (const struct step *step = tree->step; step; step = step->next) {
		struct value value;

		if (step->through) {
			slot = led_by(slot, &there);
			continue;
		}
		if (!step->index) {
			slot = slot_member(slot, step->name, step->len);
			continue;
		}
		value = is_plain(step->index) ? index_value(f, step->index, &chain) : index[n++];
		there = there && !is_beyond(slot, value);
		slot = &slot->part[there ? value.i - slot->low : 0];
	}
	return there ? slot : NULL;
}

/* ---- storing ---- */

bool slot_fits(const struct slot *slot, struct value value)
{
	const struct var_range *range = slot->var ? slot->var->range : NULL;

	return !range || (value.i >= range->low && value.i <= range->high);
}

bool slot_put(struct st_world *world, struct slot *slot, struct value value)
{
	value = value_widen(value, slot->value->type);
	if (!slot_fits(slot, value)) {
		world->errors++;
		return false;
	}
	if (value.type == IEC_STRING) {
		value.room = slot->value->room;
		if (value.len > value.room)
			value.len = value.room;
	}
	*slot->value = value;
	return true;
}

void slot_copy(struct slot *to, const struct slot *from)
{
	if (to->kind == SLOT_VALUE)
		*to->value = *from->value;
	for (int i = 0; to->kind != SLOT_VALUE && i < to->count; i++)
		slot_copy(&to->part[i], &from->part[i]);
}

/* ---- types ---- */

static bool is_float(enum iec_type type)
{
	return type == IEC_REAL || type == IEC_LREAL;
}

/* A type that both widen to; IEC_NONE fits any. */
static enum iec_type joined(enum iec_type a, enum iec_type b)
{
	const enum iec_type types[2] = { a, b };

	return wide_type(types, 2);
}

/* Is there a number with a point in it, whose type its neighbours give? */
static bool has_point(const struct tree *tree)
{
	if (tree->kind == TREE_CONSTANT)
		return tree->literal.type == IEC_NONE && tree->literal.real;
	if (tree->kind == TREE_NEG)
		return has_point(tree->left);
	if (tree->kind == TREE_TWO && !word_is_test(word_row(tree->fn)))
		return has_point(tree->left) || has_point(tree->right);
	if (tree->kind != TREE_CALL || tree->pou || tree->fn == FN_CONVERT)
		return false;
	for (const struct tree *arg = tree->left; arg; arg = arg->next)
		if (has_point(arg))
			return true;
	return false;
}

/* Of the arguments that share it: all but the first of SEL and MUX, and the counts of texts. */
static bool shares(enum word fn, int place)
{
	if (fn == FN_SEL || fn == FN_MUX)
		return place > 0;
	if (fn == FN_SHL || fn == FN_SHR || fn == FN_ROL || fn == FN_ROR)
		return place == 0;
	return true;
}

/* A constant that does not fit the other side is a DINT or LINT. */
static enum iec_type roomy(enum iec_type type, const struct tree *side)
{
	union iec_value value;

	if (side->kind != TREE_CONSTANT || side->literal.type != IEC_NONE || side->literal.real || side->minus ||
	    !(iec_type_row(type)->class & ANY_INT) || literal_fit(&side->literal, type, &value))
		return type;
	return literal_fit(&side->literal, IEC_DINT, &value) ? IEC_DINT : IEC_LINT;
}

/* The type of an operation whose operands share one: without a type, numbers with a point
 * make it a REAL, or the LREAL that is wanted. */
static enum iec_type shared(struct frame_of *f, const struct tree *tree, enum iec_type wanted)
{
	enum iec_type type = IEC_NONE;
	int place = 0;

	if (tree->kind == TREE_TWO) {
		type = joined(tree_type(f, tree->left, wanted), tree_type(f, tree->right, wanted));
		type = roomy(roomy(type, tree->left), tree->right);
	} else {
		for (const struct tree *arg = tree->left; arg; arg = arg->next)
			if (shares(tree->fn, place++))
				type = joined(type, tree_type(f, arg, wanted));
	}
	if (type != IEC_NONE && !is_float(type) && has_point(tree))
		type = wanted == IEC_LREAL ? IEC_LREAL : IEC_REAL;
	return type;
}

static enum iec_type result_of(struct frame_of *f, const struct tree *call, enum iec_type wanted)
{
	if (call->pou)
		return call->pou->vars.var[0].type;
	if (call->fn == FN_CONVERT)
		return call->to;
	if (call->fn == FN_LEN || call->fn == FN_FIND)
		return IEC_INT;
	if (text_is_function(call->fn))
		return IEC_STRING;
	return shared(f, call, wanted);
}

static enum iec_type part_type(int bits)
{
	return bits == 1 ? IEC_BOOL : bits == 8 ? IEC_BYTE : bits == 16 ? IEC_WORD : IEC_DWORD;
}

static uint64_t part_mask(const struct tree *tree)
{
	return (UINT64_C(1) << tree->bits) - 1;
}

static struct value part_of(const struct tree *tree, struct value all)
{
	return (struct value){ .type = part_type(tree->bits),
		.i = (int64_t)((uint64_t)all.i >> tree->number * tree->bits & part_mask(tree)) };
}

struct value part_put(const struct tree *tree, struct value all, struct value part)
{
	const int shift = tree->number * tree->bits;
	const unsigned spare = 64 - 8u * iec_type_row(all.type)->size;
	const uint64_t mixed = ((uint64_t)all.i & ~(part_mask(tree) << shift)) | ((uint64_t)part.i & part_mask(tree)) << shift;

	all.i = iec_type_row(all.type)->class == CLASS_SIGNED ? (int64_t)(mixed << spare) >> spare :
		(int64_t)(mixed << spare >> spare);
	return all;
}

enum iec_type tree_type(struct frame_of *f, const struct tree *tree, enum iec_type wanted)
{
	enum iec_type left, right;
	struct slot *slot;

	switch (tree->kind) {
	case TREE_CONSTANT:
		return tree->literal.type;
	case TREE_REF:
		return IEC_LWORD;
	case TREE_BOUND:
		return IEC_NONE;
	case TREE_PLACE:
		slot = tree_first(f, tree);
		if (tree->bits)
			return part_type(tree->bits);
		return slot->kind == SLOT_VALUE ? slot->value->type : IEC_NONE;
	case TREE_NEG:
	case TREE_NOT:
		return tree_type(f, tree->left, wanted);
	case TREE_CALL:
		return result_of(f, tree, wanted);
	case TREE_TWO:
		break;
	}
	if (word_is_test(word_row(tree->fn)))
		return IEC_BOOL;
	left = tree_type(f, tree->left, wanted);
	right = tree_type(f, tree->right, wanted);
	if (value_time_type(tree->fn, left, right))
		return value_time_type(tree->fn, left, right);
	return shared(f, tree, wanted);
}

/* ---- values ---- */

static struct value constant(const struct tree *tree, enum iec_type type)
{
	struct literal literal = tree->literal;
	struct placed placed = { .kind = PLACED_LITERAL, .type = literal.type };

	if (tree->minus && literal.real)
		literal.value.r = -literal.value.r;
	else if (tree->minus)
		literal.value.i = (int64_t)(0 - (uint64_t)literal.value.i);
	if (tree->minus)
		literal.high = false;
	if (literal.type == IEC_NONE && type == IEC_NONE)
		type = literal.real ? IEC_REAL : IEC_DINT;
	placed.literal = literal;
	return placed_read(&placed, type);
}

/* A constant, as it stands there. */
static struct value bound(struct frame_of *f, const struct tree *tree, enum iec_type type)
{
	const struct slot *slot = tree_first(f, tree->left);
	struct tree number = { .kind = TREE_CONSTANT };

	for (int i = 1; i < (int)tree->right->literal.value.i; i++)
		slot = &slot->part[0];
	number.literal.value.i = slot->low + (tree->upper ? slot->count - 1 : 0);
	return constant(&number, type);
}

static struct value tell(struct frame_of *f, const struct tree *tree, enum outcome outcome,
			 struct value value, struct chain_state *chain)
{
	if (outcome == OUTCOME_GOOD)
		return value;
	f->world->errors++;
	chain->on = false;
	chain->wrapped = outcome == OUTCOME_WRAPPED ? tree : NULL;
	return value;
}

static bool is_nan(struct value value)
{
	return (value.type == IEC_REAL && isnan(value.r)) || (value.type == IEC_LREAL && isnan(value.d));
}

static struct value compute_two(struct frame_of *f, const struct tree *tree, enum iec_type wanted,
				struct chain_state *chain)
{
	const enum iec_type left = tree_type(f, tree->left, IEC_NONE);
	const enum iec_type right = tree_type(f, tree->right, IEC_NONE);
	const bool timely = value_time_type(tree->fn, left, right) != IEC_NONE;
	const bool test = word_is_test(word_row(tree->fn));
	enum iec_type type = shared(f, tree, test ? IEC_NONE : wanted);
	struct value in[2], out = { 0 };
	enum outcome outcome;

	if (type == IEC_NONE)
		type = test || wanted == IEC_NONE ? has_point(tree) ? IEC_REAL : IEC_DINT : wanted;
	in[0] = tree_compute(f, tree->left, timely ? IEC_NONE : type, chain);
	if (tree->lazy && chain->on && value_is_true(in[0]) == (tree->fn == FN_OR))
		return value_bool(tree->fn == FN_OR);
	in[1] = tree_compute(f, tree->right, timely ? IEC_NONE : type, chain);
	out.type = test ? IEC_BOOL : timely ? value_time_type(tree->fn, left, right) : type;
	if (!chain->on)
		return out;
	if (test && (is_nan(in[0]) || is_nan(in[1])))
		return value_bool(tree->fn == FN_NE);
	outcome = timely ? value_compute_time(tree->fn, in[0], in[1], &out) :
			   value_compute(tree->fn, in, 2, &out);
	return tell(f, tree, outcome, out, chain);
}

static struct value compute_one(struct frame_of *f, const struct tree *tree, enum iec_type wanted,
				struct chain_state *chain)
{
	struct value in[2], out;

	in[1] = tree_compute(f, tree->left, tree_type(f, tree->left, wanted) ? IEC_NONE : wanted, chain);
	in[0] = value_widen((struct value){ .type = IEC_DINT }, in[1].type);
	out = in[0];
	if (!chain->on)
		return out;
	return tell(f, tree, tree->kind == TREE_NOT ? value_compute(FN_NOT, &in[1], 1, &out) :
		    value_compute(FN_SUB, in, 2, &out), out, chain);
}

/* REAL and LREAL to the nearest, halfway to the even one; whole numbers wrap. */
static enum outcome convert(struct value from, enum iec_type to, struct value *out)
{
	const double real = from.type == IEC_REAL ? (double)from.r : from.d;
	const struct iec_type_row *row = iec_type_row(to);
	const int bits = 8 * row->size;
	struct value result = { .type = to };
	double near;

	if (to == IEC_BOOL) {
		*out = value_bool(is_float(from.type) ? real < 0 || real > 0 : from.i != 0);
		return OUTCOME_GOOD;
	}
	if (is_float(from.type) && is_float(to)) {
		result.r = (float)real;
		result.d = real;
		if (to == IEC_REAL && !isfinite(result.r))
			return OUTCOME_FAILED;
		*out = result;
		return OUTCOME_GOOD;
	}
	if (is_float(to)) {
		const double wide = from.type == IEC_ULINT ? (double)(uint64_t)from.i : (double)from.i;

		result.r = from.type == IEC_ULINT ? (float)(uint64_t)from.i : (float)from.i;
		result.d = wide;
		*out = result;
		return OUTCOME_GOOD;
	}
	if (is_float(from.type)) {
		near = nearbyint(real);
		if (!(near >= -ldexp(row->low < 0 ? 1 : 0, bits - 1)) ||
		    !(near < ldexp(1, row->low < 0 ? bits - 1 : bits)))
			return OUTCOME_FAILED;
		result.i = near < 9223372036854775808.0 ? (int64_t)near : (int64_t)(uint64_t)near;
		*out = result;
		return OUTCOME_GOOD;
	}
	result.i = from.i;
	if (bits < 64) {
		result.i &= (int64_t)(((uint64_t)1 << bits) - 1);
		if (row->low < 0 && result.i >> (bits - 1))
			result.i -= (int64_t)1 << bits;
	}
	*out = result;
	if (row->class & CLASS_BITS || iec_type_row(from.type)->class & (CLASS_BITS | CLASS_BOOL))
		return OUTCOME_GOOD;
	if (bits == 64)
		return (to == IEC_ULINT) != (from.type == IEC_ULINT) && result.i < 0 ?
		       OUTCOME_WRAPPED : OUTCOME_GOOD;
	return result.i == from.i && (from.type != IEC_ULINT || from.i >= 0) ? OUTCOME_GOOD : OUTCOME_WRAPPED;
}

/* A shift by more than all bits gives 0. */
static enum outcome shift(enum word fn, struct value in, struct value by, struct value *out)
{
	const int bits = 8 * iec_type_row(in.type)->size;
	uint64_t value = (uint64_t)in.i, count = (uint64_t)by.i;

	if (by.i < 0 && by.type != IEC_ULINT)
		return OUTCOME_FAILED;
	*out = in;
	if (fn == FN_ROL || fn == FN_ROR)
		count %= (uint64_t)bits;
	else if (count > (uint64_t)bits)
		count = (uint64_t)bits;
	for (uint64_t i = 0; i < count; i++) {
		const uint64_t top = value >> (bits - 1) & 1, low = value & 1;

		if (fn == FN_SHL || fn == FN_ROL)
			value = value << 1 | (fn == FN_ROL ? top : 0);
		else
			value = value >> 1 | (fn == FN_ROR ? low << (bits - 1) : 0);
	}
	out->i = (int64_t)(bits == 64 ? value : value & (((uint64_t)1 << bits) - 1));
	return OUTCOME_GOOD;
}

static enum outcome known(enum word fn, struct value *in, int count, enum iec_type to,
			  struct value *out)
{
	struct value pair[2];

	if (fn == FN_CONVERT)
		return convert(in[0], to, out);
	if (fn == FN_SEL) {
		*out = in[value_is_true(in[0]) ? 2 : 1];
		return OUTCOME_GOOD;
	}
	if (fn == FN_MUX) {
		if (in[0].i < 0 || in[0].i >= count - 1)
			return OUTCOME_FAILED;
		*out = in[1 + in[0].i];
		return OUTCOME_GOOD;
	}
	for (int i = 0; i < count && (fn == FN_LIMIT || fn == FN_MIN || fn == FN_MAX); i++)
		if (is_nan(in[i]))
			return OUTCOME_FAILED;
	if (fn == FN_LIMIT) {
		value_compute(FN_MAX, (struct value[]){ in[1], in[0] }, 2, &pair[0]);
		pair[1] = in[2];
		return value_compute(FN_MIN, pair, 2, out);
	}
	if (fn == FN_ABS && is_nan(in[0]))
		return OUTCOME_FAILED;
	if (fn == FN_ABS && is_float(in[0].type)) {
		*out = in[0];
		out->r = fabsf(in[0].r);
		out->d = fabs(in[0].d);
		return OUTCOME_GOOD;
	}
	if (fn == FN_ABS) {
		pair[0] = (struct value){ .type = in[0].type };
		pair[1] = in[0];
		*out = in[0];
		return in[0].i >= 0 || in[0].type == IEC_ULINT ? OUTCOME_GOOD :
		       value_compute(FN_SUB, pair, 2, out);
	}
	if (fn == FN_SHL || fn == FN_SHR || fn == FN_ROL || fn == FN_ROR)
		return shift(fn, in[0], in[1], out);
	return value_compute(fn, in, count, out);
}

static struct value compute_known(struct frame_of *f, const struct tree *call, enum iec_type wanted,
				  struct chain_state *chain)
{
	const bool own = call->fn == FN_CONVERT || text_is_function(call->fn);
	enum iec_type type = own ? IEC_NONE : shared(f, call, wanted);
	struct value in[8] = { { 0 } }, out = { .type = result_of(f, call, wanted) };
	int count = 0;

	if (!own && type == IEC_NONE)
		type = wanted ? wanted : has_point(call) ? IEC_REAL : IEC_DINT;
	for (const struct tree *arg = call->left; arg && count < 8; arg = arg->next, count++)
		in[count] = tree_compute(f, arg, !own && shares(call->fn, count) ? type : IEC_NONE,
					 chain);
	if (out.type == IEC_NONE)
		out.type = type;
	if (!chain->on)
		return out;
	return tell(f, call, known(call->fn, in, count, call->to, &out), out, chain);
}

static struct value read_place(struct frame_of *f, const struct tree *tree, struct chain_state *chain)
{
	struct slot *first = tree_first(f, tree), *slot = NULL;
	struct value none = { .type = first->kind == SLOT_VALUE ? first->value->type : IEC_NONE };

	if (chain->on)
		slot = tree_slot(f, tree, chain);
	return slot && slot->kind == SLOT_VALUE ? *slot->value : none;
}

/* What whole constants alone give, as in 2 * 60 - 1. */
static bool whole_number(const struct tree *tree, int64_t *out)
{
	int64_t a, b;

	if (tree->kind == TREE_CONSTANT) {
		*out = tree->minus ? -tree->literal.value.i : tree->literal.value.i;
		return tree->literal.type == IEC_NONE && !tree->literal.real && !tree->literal.high;
	}
	if (tree->kind == TREE_NEG)
		return whole_number(tree->left, &a) && !__builtin_sub_overflow(0, a, out);
	if (tree->kind != TREE_TWO || !whole_number(tree->left, &a) || !whole_number(tree->right, &b))
		return false;
	if (tree->fn == FN_ADD)
		return !__builtin_add_overflow(a, b, out);
	if (tree->fn == FN_SUB)
		return !__builtin_sub_overflow(a, b, out);
	if (tree->fn == FN_MUL)
		return !__builtin_mul_overflow(a, b, out);
	if ((tree->fn != FN_DIV && tree->fn != FN_MOD) || b == 0)
		return false;
	*out = tree->fn == FN_DIV ? a / b : a % b;
	return true;
}

/* The same, where a number or bits of @type are wanted. */
static bool exact(const struct tree *tree, enum iec_type type, struct value *out)
{
	const struct iec_type_row *row = iec_type_row(type);
	int64_t number;

	if (tree->kind == TREE_CONSTANT || type == IEC_BOOL || !(row->class & (ANY_INT | CLASS_BITS)) ||
	    !whole_number(tree, &number) || number < row->low ||
	    (row->size < 8 && number > row->high))
		return false;
	*out = (struct value){ .type = type, .i = number };
	return true;
}

struct value tree_compute(struct frame_of *f, const struct tree *tree, enum iec_type type,
			  struct chain_state *chain)
{
	struct value value = { 0 };

	if (exact(tree, type, &value))
		return value;
	switch (tree->kind) {
	case TREE_CONSTANT: value = constant(tree, type); break;
	case TREE_REF: break; /* an assignment stores it */
	case TREE_BOUND: value = bound(f, tree, type); break;
	case TREE_PLACE:
		value = read_place(f, tree, chain);
		value = tree->bits ? part_of(tree, value) : value;
		break;
	case TREE_NEG:
	case TREE_NOT: value = compute_one(f, tree, type, chain); break;
	case TREE_TWO: value = compute_two(f, tree, type, chain); break;
	case TREE_CALL:
		if (!tree->pou)
			value = compute_known(f, tree, type, chain);
		else
			run_function(f, tree, chain, &value);
		break;
	}
	return type == IEC_NONE ? value : value_widen(value, type);
}
