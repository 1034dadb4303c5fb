/* SPDX-License-Identifier: MIT
 *
 * ld_loop - FOR … NEXT of a ladder as IL: labels, comparisons and jumps.
 *
 *   FOR I := 1 TO 10:  JMPCN out | I := 1 | top: I > 10? JMPC out
 *   NEXT:              I = 10? JMPC out | n := I + 1, failed? JMPC out
 *                      n > 10? JMPC out | I := n | JMP top | out:
 *
 * So I keeps the last value that was used, and a loop up to the largest number of
 * its type ends. Going back costs instructions of the scan's budget.
 */
#include "engine/translate/ladder_unit.h"

#include <stdio.h>

static struct names *names_of(struct ld *ld)
{
	return &ld->translation->project->names;
}

static uint32_t intern(struct ld *ld, const char *text, size_t len)
{
	uint32_t id = names_intern(names_of(ld), text, len);

	if (!id)
		ld->failed = true;
	return id;
}

static uint32_t label(struct ld *ld, char letter, uint32_t number)
{
	char text[24];
	int len = snprintf(text, sizeof(text), "_%c%u", letter, (unsigned)number);

	return intern(ld, text, (size_t)len);
}

static void emit_label(struct ld *ld, uint32_t name)
{
	ld_emit_line(ld, (struct il_line){ .kind = IL_LABEL, .operand = name });
}

static uint32_t part(struct ld *ld, const struct loop_part *part)
{
	return part->text ? intern(ld, part->text, part->len) : intern(ld, "1", 1);
}

static void emit_fn(struct ld *ld, enum word fn, uint32_t operand)
{
	ld_emit_line(ld, (struct il_line){ .kind = IL_FN, .word = (uint16_t)fn,
					   .operand = operand });
}

/* Leaves the loop when @value is past its end. */
static void leave_past(struct ld *ld, const struct open_loop *loop, uint32_t value)
{
	ld_emit(ld, OP_LD, 0, value);
	emit_fn(ld, loop->down ? FN_LT : FN_GT, loop->to);
	ld_emit(ld, OP_JMP, MOD_C, loop->out);
}

static enum iec_type type_of(struct ld *ld, uint32_t operand)
{
	enum diag_id why;
	const struct meaning *m = scope_find(ld->translation->scope, ld->unit->pou,
					     operand, &why);

	return m ? m->type : IEC_DINT;
}

void ld_loop_begin(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	uint32_t id = rung_at(ld->rung, at->row, at->col)->operand;
	struct open_loop *loop;
	struct loop text;

	if (ld->loops == LIMIT_LOOPS ||
	    !loop_parse(names_text(names_of(ld), id), names_len(names_of(ld), id),
			&text))
		return;
	loop = &ld->loop[ld->loops++];
	*loop = (struct open_loop){
		.variable = part(ld, &text.variable), .to = part(ld, &text.to),
		.by = part(ld, &text.by), .down = text.step < 0,
		.top = label(ld, 'L', ld->number), .out = label(ld, 'X', ld->number),
	};
	if (at->in != NET_RAIL) {
		ld_prepare(ld, at->in, 1);
		ld_load(ld, at->in);
		ld_place(ld, at->row, at->col);
		ld_emit(ld, OP_JMP, MOD_C | MOD_N, loop->out);
	}
	ld_emit(ld, OP_LD, 0, part(ld, &text.from));
	ld_emit(ld, OP_ST, 0, loop->variable);
	emit_label(ld, loop->top);
	leave_past(ld, loop, loop->variable);
}

void ld_loop_end(struct ld *ld)
{
	const struct open_loop *loop;
	uint32_t next, eno;

	if (ld->loops == 0)
		return;
	loop = &ld->loop[--ld->loops];
	next = temps_number(ld->temps, type_of(ld, loop->variable));
	eno = temps_bool(ld->temps);
	ld_emit(ld, OP_LD, 0, loop->variable);
	emit_fn(ld, FN_EQ, loop->to);
	ld_emit(ld, OP_JMP, MOD_C, loop->out);
	ld_call(ld, FN_ADD);
	ld_arg(ld, false, intern(ld, "IN1", 3), loop->variable);
	ld_arg(ld, false, intern(ld, "IN2", 3), loop->by);
	ld_arg(ld, true, ld->eno_id, eno);
	ld_arg(ld, true, ld->out_id, next);
	ld_emit(ld, OP_LD, 0, eno);
	ld_emit(ld, OP_JMP, MOD_C | MOD_N, loop->out);
	leave_past(ld, loop, next);
	ld_emit(ld, OP_LD, 0, next);
	ld_emit(ld, OP_ST, 0, loop->variable);
	ld_emit(ld, OP_JMP, 0, loop->top);
	emit_label(ld, loop->out);
}
