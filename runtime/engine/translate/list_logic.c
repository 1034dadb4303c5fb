/* SPDX-License-Identifier: MIT
 *
 * list_logic - AND OR XOR NOT and jumps. BOOLs become truth tables, bit strings the
 * functions of the same names.
 *
 * The check has found the type of each line. Nothing here fails at run time.
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

/* An untyped 0 or 1 becomes a bit here. */
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

/* The value left of a parenthesis waits; its variables may change meanwhile. */
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

static uint32_t fold(const struct list *list, uint32_t name)
{
	return names_fold(&list->as->translation->project->names, name);
}

enum { NOT_SEEN, SEEN, JUMPED_BACK };

static void find_loops(struct list *list)
{
	for (int i = 0; i < list->il->count; i++) {
		const struct il_line *line = &list->il->line[i];
		const bool label = line->kind == IL_LABEL;
		uint32_t id;

		if (!label && (line->kind != IL_OP || line->op != OP_JMP))
			continue;
		id = fold(list, line->operand);
		if (id < list->label_count && (label || list->looped[id]))
			list->looped[id] = label ? SEEN : JUMPED_BACK;
	}
}

bool list_find_labels(struct list *list)
{
	struct names *names = &list->as->translation->project->names;

	for (int i = 0; i < list->il->count; i++)
		if (list->il->line[i].kind == IL_LABEL)
			fold(list, list->il->line[i].operand);
	list->label_count = (uint32_t)names->count;
	list->label = arena_alloc(list->as->arena,
				  list->label_count * sizeof(*list->label));
	list->looped = arena_alloc(list->as->arena, list->label_count);
	if (!list->label || !list->looped)
		return false;
	find_loops(list);
	return true;
}

bool list_jumps_back(const struct list *list, const struct il_line *label)
{
	return list->looped[fold(list, label->operand)] == JUMPED_BACK;
}

void list_target(struct list *list, uint32_t name)
{
	uint32_t word = (uint32_t)list->as->text->count;

	emit(list->as, 0);
	if (!arena_push(list->as->arena, &list->fixup, &list->fixup_count,
			sizeof(*list->fixup))) {
		list->as->failed = true;
		return;
	}
	list->fixup[list->fixup_count - 1].word = word;
	list->fixup[list->fixup_count - 1].fold = name ? fold(list, name) : 0;
}

bool list_is_ahead(const struct list *list, uint32_t name)
{
	return !list->label[fold(list, name)];
}

/* Marks a step and its limit: ADD, and a comparison that ends the code, which makes the BOOL at @slot.
 * They follow each other even where a label stands between them. */
static void mark_step(struct assembler *as, uint32_t slot)
{
	uint32_t *add, *cmp, op;

	if (as->text->count < 11 || as->op_at != as->text->count - 5 || as->op_before != as->op_at - 6)
		return;
	cmp = &as->text->word[as->op_at];
	add = &as->text->word[as->op_before];
	op = *add & 0xff;
	if ((op == VM_INT || op == VM_DINT) && *add >> 8 == MATH_ADD &&
	    (*cmp & 0xff) == (op == VM_INT ? VM_CMP_INT : VM_CMP_DINT) && cmp[1] == add[3] &&
	    cmp[4] == slot && code_order_alone(*cmp >> 8))
		*add |= MATH_LOOP << 8;
}

/* JMP and RET; label 0 is the end of the list. */
void list_flow(struct list *list, const struct il_line *line)
{
	uint32_t target = line->op == OP_JMP ? line->operand : 0;
	struct bits condition;
	uint32_t slot = 0;

	if (line->modifiers & MOD_C) {
		const enum result_kind kind = list->now.kind;

		condition = list_now_bits(list);
		list->now.kind = RESULT_NONE; /* nothing else reads what the last instruction makes */
		slot = list_keep(list, &condition);
		list->now.kind = kind;
		list->now.bits = bits_leaf(list->as, slot);
	}
	list_place(list);
	list->straight = false;
	if (line->op == OP_RET && !(line->modifiers & MOD_C)) {
		emit_op(list->as, VM_END, 0);
		return;
	}
	if (line->modifiers & MOD_C)
		mark_step(list->as, slot);
	emit_op(list->as, line->modifiers & MOD_C ? VM_JMPC : VM_JMP,
		line->modifiers & MOD_C && line->modifiers & MOD_N);
	list_target(list, target);
	if (line->modifiers & MOD_C)
		emit(list->as, slot);
	else if (!list->as->failed)
		list->fixup[list->fixup_count - 1].jump = true;
}

/* The result does not change. */
void list_stop(struct list *list, const struct il_line *line)
{
	struct bits condition = bits_constant(true);
	uint32_t slot;

	if (line->modifiers & MOD_C)
		condition = list_now_bits(list);
	if (line->modifiers & MOD_N)
		condition = bits_not(condition);
	slot = list_slot(list, &condition);
	list_place(list);
	emit_op(list->as, VM_STOP, 0);
	emit(list->as, slot);
}

void list_label(struct list *list, const struct il_line *line)
{
	uint32_t id = fold(list, line->operand);

	bits_end(list->as);
	list->straight = false;
	list->now.kind = RESULT_NONE;
	list->pending_count = 0;
	if (id < list->label_count)
		list->label[id] = (uint32_t)list->as->text->count + 1;
}

/* Where a variable with an address lies. */
static uint32_t offset_of(struct list *list, uint32_t operand)
{
	return layout_spot(list->as, list_meaning(list, operand)).offset;
}

static int count_behind(const struct list *list, enum il_kind kind)
{
	int count = 0;

	while (list->at + 1 + count < list->il->count &&
	       list->il->line[list->at + 1 + count].kind == kind)
		count++;
	return count;
}

void list_each(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at];
	const int targets = count_behind(list, IL_TARGET);

	list_place(list);
	bits_end(list->as);
	list->straight = false;
	list->now.kind = RESULT_NONE;
	emit_op(list->as, VM_EACH, (uint32_t)targets);
	emit(list->as, offset_of(list, line->pin));
	emit(list->as, offset_of(list, line->operand));
	for (int i = 1; i <= targets; i++)
		list_target(list, line[i].operand);
}

void list_tick(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at];
	struct bits hold = list_bits(list, list_meaning(list, line[1].operand));
	const uint32_t slot = list_slot(list, &hold);

	list_place(list);
	bits_end(list->as);
	list->now.kind = RESULT_NONE;
	emit_op(list->as, VM_TICK, line->word);
	emit(list->as, slot);
	emit(list->as, offset_of(list, line->pin));
	emit(list->as, offset_of(list, line->operand));
	emit(list->as, offset_of(list, line[2].operand));
	emit(list->as, offset_of(list, line[3].operand));
}

/* Where a jump to @at really leads: not to another jump further down. While listing, the simulation can
 * stand at that one. */
static uint32_t leads_to(const struct assembler *as, uint32_t at)
{
	const uint32_t *code = as->text->word;

	while (!(as->listing && as->text == &as->watch) && at < (uint32_t)as->text->count &&
	       code[at] == VM_JMP && code[at + 1] > at)
		at = code[at + 1];
	return at;
}

/* From behind, so that what a jump leads to is known. One to the end of the list ends it itself. */
void list_patch(struct list *list, uint32_t end)
{
	const struct assembler *as = list->as;
	uint32_t *code = as->text->word;

	for (int i = list->fixup_count; i-- > 0;) {
		const struct fixup *fixup = &list->fixup[i];
		const uint32_t at = leads_to(as, fixup->fold ? list->label[fixup->fold] - 1 : end);

		code[fixup->word] = at;
		if (fixup->jump && code[at] == VM_END && !(as->listing && as->text == &as->watch))
			code[fixup->word - 1] = code[fixup->word] = VM_END;
	}
}
