/* SPDX-License-Identifier: MIT
 *
 * list_flow - JMP, RET and labels of an instruction list.
 *
 * Targets are filled in when the list ends.
 */
#include "engine/translate/lists.h"

static uint32_t fold(struct list *list, uint32_t name)
{
	return names_fold(&list->as->translation->project->names, name);
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
	return list->label != NULL;
}

static void add_fixup(struct list *list, uint32_t name)
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

/* JMP and RET; the fold 0 stands for the end of the list. */
void list_flow(struct list *list, const struct il_line *line)
{
	uint32_t target = line->op == OP_JMP ? line->operand : 0;
	struct bits condition;
	uint32_t slot = 0;

	if (line->modifiers & MOD_C) {
		condition = list_now_bits(list);
		slot = list_slot(list, &condition);
		list->now.bits = bits_leaf(list->as, slot);
	}
	list_place(list);
	list->straight = false;
	if (line->op == OP_RET && !(line->modifiers & MOD_C)) {
		emit_op(list->as, VM_END, 0);
		return;
	}
	emit_op(list->as, line->modifiers & MOD_C ? VM_JMPC : VM_JMP,
		line->modifiers & MOD_C && line->modifiers & MOD_N);
	add_fixup(list, target);
	if (line->modifiers & MOD_C)
		emit(list->as, slot);
}

/* The result stays what it is. */
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

/* Where a variable that has an address of its own lies. */
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
		add_fixup(list, line[i].operand);
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

void list_patch(struct list *list, uint32_t end)
{
	for (int i = 0; i < list->fixup_count; i++) {
		uint32_t at = list->fixup[i].fold ?
			list->label[list->fixup[i].fold] - 1 : end;

		list->as->text->word[list->fixup[i].word] = at;
	}
}
