/* SPDX-License-Identifier: MIT
 *
 * to_classic_initial - values that variables begin with: written in the first scan, because
 * ClassicLadder has none.
 */
#include "engine/view/to_classic_parts.h"

static void first_scan_only(struct leaving *e, const struct out_part *output)
{
	bool upstream = e->dialect == CLASSIC_UPSTREAM;

	if (!upstream && e->started < 0)
		e->started = new_bit(e);
	draw_step(e, upstream ? CL_NO : CL_NC,
		  upstream ? variable_of(CL_SYSTEM_BIT, 4) :
			     variable_of(CL_BIT, e->started), output);
}

void leave_initial(struct leaving *e)
{
	section_begin(e, "Initial", -1, false);
	for (int i = 0; i < e->slots && e->good; i++) {
		const struct out_slot *slot = &e->slot[i];
		const struct var *var = slot->var;
		struct out_part item = { .code = CL_SET, .width = 1, .height = 1,
			.variable = variable_of(slot->type, slot->number) };

		if (slot->block >= 0 || slot->type < 0 || !var->has_init ||
		    var->type == IEC_NONE || (slot->pou && pou_has_frame(slot->pou)))
			continue;
		e->pou = slot->pou;
		e->rung_index = -1;
		if (var->array.count || var->init_count) {
			out_refuse(e, DIAG_EXPORT_TYPE, "%s", slot->name);
			return;
		}
		if (!var->init.i)
			continue;
		if (var->type != IEC_BOOL) {
			item.code = CL_OPERATE;
			item.width = 3;
			item.text = out_text(e, "%s:=%d", out_encode(e, item.variable),
					     (int)var->init.i);
		}
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
