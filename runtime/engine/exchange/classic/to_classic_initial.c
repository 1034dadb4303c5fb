/* SPDX-License-Identifier: MIT
 *
 * to_classic_initial - values that variables begin with: written in the first scan, because
 * ClassicLadder has none.
 */
#include "engine/exchange/classic/to_classic_parts.h"

static void first_scan_only(struct leaving *e, const struct out_part *output)
{
	bool upstream = e->dialect == CLASSIC_UPSTREAM;

	if (!upstream && e->started < 0)
		e->started = new_bit(e);
	draw_step(e, upstream ? CL_NO : CL_NC,
		  upstream ? variable_of(CL_SYSTEM_BIT, 4) :
			     variable_of(CL_BIT, e->started), output);
}

/* `%B3` set or reset, or `%W3:=5`. */
static struct out_part value_item(struct leaving *e, const struct out_slot *slot, int element,
				  int64_t value)
{
	struct classic_variable variable = variable_of(slot->type, slot->number + element);
	struct out_part item = { .code = value ? CL_SET : CL_RESET, .width = 1, .height = 1,
				 .variable = variable };

	if (slot->var->type == IEC_BOOL)
		return item;
	item.code = CL_OPERATE;
	item.width = 3;
	item.text = out_text(e, "%s:=%d", out_encode(e, variable), (int)value);
	return item;
}

/* Of an array: what each element begins with, as far as its list goes. */
static void initial_list(struct leaving *e, const struct out_slot *slot)
{
	const struct var *var = slot->var;
	int element = 0;

	for (int i = 0; i < var->init_count && e->good; i++)
		for (uint32_t k = 0; k < var->init_list[i].count && e->good; k++) {
			int64_t value = var->init_list[i].value.i;
			struct out_part item = value_item(e, slot, element++, value);

			if (value)
				first_scan_only(e, &item);
		}
}

void leave_temporaries(struct leaving *e, const struct pou *pou)
{
	for (int i = 0; i < pou->vars.count && e->good; i++) {
		const struct var *var = &pou->vars.var[i];
		const struct out_slot *slot = slot_find(e, var);
		struct out_part item;

		if (!(vars_flags(&pou->vars, i) & VAR_TEMP) || !slot || slot->type < 0)
			continue;
		if (var->array.count || slot->block >= 0) {
			out_refuse(e, DIAG_EXPORT_TYPE, "%s", slot->name);
			return;
		}
		item = value_item(e, slot, 0, var->has_init ? var->init.i : 0);
		draw_step(e, CL_WIRE, variable_of(0, 0), &item);
	}
}

static bool is_temporary(const struct out_slot *slot)
{
	return slot->pou && slot->var >= slot->pou->vars.var &&
	       slot->var < slot->pou->vars.var + slot->pou->vars.count &&
	       vars_flags(&slot->pou->vars, (int)(slot->var - slot->pou->vars.var)) & VAR_TEMP;
}

void leave_initial(struct leaving *e)
{
	section_begin(e, "Initial", -1, false);
	if (e->first >= 0) {
		const struct out_part first = { .code = CL_COIL, .width = 1, .height = 1,
			.variable = variable_of(CL_BIT, e->first) };

		first_scan_only(e, &first);
	}
	for (int i = 0; i < e->slots && e->good; i++) {
		const struct out_slot *slot = &e->slot[i];
		const struct var *var = slot->var;
		struct out_part item;

		/* A page tells itself what its steps are. */
		if (slot->block >= 0 || slot->type < 0 || slot->type == CL_STEP_BIT ||
		    !var->has_init || var->type == IEC_NONE || (slot->pou && pou_has_frame(slot->pou)))
			continue;
		e->pou = slot->pou;
		e->rung_index = -1;
		if (is_temporary(slot))
			continue;
		if (var->array.count) {
			initial_list(e, slot);
			continue;
		}
		item = value_item(e, slot, 0, var->init.i);
		if (var->init.i)
			first_scan_only(e, &item);
	}
	section_end(e, true);
}

/* The bit that says that a scan has been is set behind all of them. */
void leave_started(struct leaving *e)
{
	struct out_part item = { .code = CL_SET, .width = 1, .height = 1 };

	if (e->started < 0)
		return;
	item.variable = variable_of(CL_BIT, e->started);
	section_begin(e, "Started", -1, false);
	draw_step(e, CL_WIRE, variable_of(0, 0), &item);
	section_end(e, false);
}
