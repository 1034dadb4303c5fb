/* SPDX-License-Identifier: MIT
 *
 * list_logic - AND OR XOR NOT: of BOOLs as truth tables, of bit strings as the
 * functions of the same names.
 *
 * Which it is was found by the check: the type of the line. It never fails at run time.
 */
#include "engine/translate/lists.h"

#define TABLE_AND 0x8
#define TABLE_OR  0xe
#define TABLE_XOR 0x6

static uint8_t table_of(uint8_t op)
{
	return op == OP_AND ? TABLE_AND : op == OP_OR ? TABLE_OR : TABLE_XOR;
}

static bool is_bits(enum iec_type type)
{
	return iec_type_row(type)->class & CLASS_BITS;
}

/* From now on it is a bit for good. */
static void as_bits(struct list *list)
{
	list->now = (struct il_result){
		.kind = RESULT_BITS, .bits = list_now_bits(list),
	};
}

/* A function on one or two operands; its result is the current one. */
static void operate(struct list *list, enum op op, enum iec_type type,
		    uint32_t count, const uint32_t *operand)
{
	struct fn_code fn = {
		.fn = op_function(op), .type = type, .result = type,
		.en = CODE_TRUE_AT(list->as->areas),
		.eno = list_sink(list->as, IEC_BOOL),
		.to = CODE_OPERAND(type, layout_tail(list->as, RUN_VALUES, type)),
		.count = count,
	};

	for (uint32_t i = 0; i < count; i++)
		fn.input[i] = operand[i];
	list_emit_fn(list, &fn);
	list->now = (struct il_result){
		.kind = RESULT_NUMBER, .own = true, .operand = fn.to,
	};
}

void list_invert(struct list *list, enum iec_type type)
{
	uint32_t operand = list_operand(list, &list->now, type);

	operate(list, OP_NOT, type, 1, &operand);
}

/* @left and the current result, which N inverts before. */
static void combine(struct list *list, const struct il_result *left, uint8_t op,
		    bool inverse)
{
	enum iec_type type = list->types[list->at];
	uint32_t operand[2] = { list_operand(list, left, type) };

	if (inverse)
		list_invert(list, list->now.kind == RESULT_NUMBER ?
			    (enum iec_type)CODE_TYPE(list->now.operand) : type);
	operand[1] = list_operand(list, &list->now, type);
	operate(list, (enum op)op, type, 2, operand);
}

/* What stands left of a parenthesis waits; a variable may change meanwhile. */
void list_open(struct list *list, const struct il_line *line)
{
	struct opened *open = &list->opened[list->depth++];
	struct il_line first = *line;

	*open = (struct opened){
		.left = list->now, .op = line->op, .modifiers = line->modifiers,
		.word = line->kind == IL_FN ? (enum word)line->word : 0,
	};
	if (open->left.kind == RESULT_NUMBER && !open->left.own) {
		enum iec_type type = (enum iec_type)CODE_TYPE(open->left.operand);
		uint32_t to = CODE_OPERAND(type,
			layout_tail(list->as, RUN_VALUES, type));

		list_copy(list, to, open->left.operand);
		open->left.operand = to;
	}
	list->now.kind = RESULT_NONE;
	first.modifiers = 0;
	if (line->operand)
		list_load(list, &first);
}

void list_logic(struct list *list, const struct il_line *line)
{
	struct il_result left = list->now;
	struct bits right;

	if (line->modifiers & MOD_PAREN) {
		list_open(list, line);
		return;
	}
	if (is_bits(list->types[list->at])) {
		struct il_line first = *line;

		first.modifiers = 0;
		list_load(list, &first);
		combine(list, &left, line->op, line->modifiers & MOD_N);
		return;
	}
	as_bits(list);
	right = list_bits(list, list_meaning(list, line->operand));
	if (line->modifiers & MOD_N)
		right = bits_not(right);
	list->now.bits = bits_combine(list->as, list->now.bits, right,
				      table_of(line->op));
}

void list_close(struct list *list)
{
	struct opened *open = &list->opened[--list->depth];
	struct bits right, left;

	if (open->word) {
		list_close_fn(list, open);
		return;
	}
	if (is_bits(list->types[list->at])) {
		combine(list, &open->left, open->op, open->modifiers & MOD_N);
		return;
	}
	as_bits(list);
	right = list->now.bits;
	if (open->modifiers & MOD_N)
		right = bits_not(right);
	left = open->left.kind == RESULT_LITERAL ?
	       bits_constant(open->left.literal->value.i != 0) : open->left.bits;
	list->now.bits = bits_combine(list->as, left, right, table_of(open->op));
}

void list_not(struct list *list)
{
	if (is_bits(list->types[list->at])) {
		list_invert(list, list->types[list->at]);
		return;
	}
	as_bits(list);
	list->now.bits = bits_not(list->now.bits);
}
