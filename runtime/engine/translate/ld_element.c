/* SPDX-License-Identifier: MIT
 *
 * ld_element - elements of arrays whose index is found out in the scan, as IL.
 *
 * They are read when their cell is evaluated, by a MOVE that gives ENO: what follows
 * reads temporaries. Elements with a fixed index are operands like any other.
 */
#include "engine/translate/ladder_unit.h"

static void add(struct ld *ld, bool output, uint32_t pin, uint32_t operand)
{
	if (!pin || !operand)
		ld->failed = true;
	ld_arg(ld, output, pin, operand);
}

uint32_t ld_fetch(struct ld *ld, uint32_t element, uint32_t en, uint32_t *eno)
{
	const struct meaning *m = ld_meaning(ld, element);
	uint32_t value = m && meaning_is_whole(m) ? temps_whole(ld->temps, m) :
			 temps_number(ld->temps, m ? m->type : IEC_BOOL);

	*eno = temps_bool(ld->temps);
	ld_call(ld, FN_MOVE);
	add(ld, false, ld->en_id, en);
	add(ld, false, ld->in_id, element);
	add(ld, true, ld->eno_id, *eno);
	add(ld, true, ld->out_id, value);
	return value;
}

static const struct word_row *row_of(const struct ld *ld, int element)
{
	return word_row((enum word)ld->network.element[element].word);
}

void ld_contact(struct ld *ld, int element, uint32_t operand)
{
	const struct network_element *at = &ld->network.element[element];
	struct element_state *state = &ld->element[element];
	uint32_t en = ld_operand(ld, at->in), eno, value;

	ld_place(ld, at->row, at->col);
	value = ld_fetch(ld, operand, en, &eno);
	ld_emit(ld, OP_LD, 0, eno);
	ld_emit(ld, OP_AND, row_of(ld, element)->negate ? MOD_N : 0, value);
	state->leaf = ld_store_new(ld);
	state->powered = true;
}

void ld_edge(struct ld *ld, int element, uint32_t operand)
{
	bool rising = row_of(ld, element)->edge == EDGE_RISING;
	uint32_t memory = ld_memory(ld, element), eno, value;

	value = ld_fetch(ld, operand, ld->true_id, &eno);
	ld_emit(ld, OP_LD, 0, eno);
	ld_emit(ld, OP_AND, 0, rising ? value : memory);
	ld_emit(ld, OP_AND, MOD_N, rising ? memory : value);
	ld->element[element].leaf = ld_store_new(ld);
	ld_call(ld, FN_MOVE);
	add(ld, false, ld->en_id, eno);
	add(ld, false, ld->in_id, value);
	add(ld, true, ld->out_id, memory);
}
