/* SPDX-License-Identifier: MIT
 *
 * layout_whole - places what has parts: instances of the project's own blocks, frames
 * and structures, part by part.
 */
#include "engine/translate/assembler.h"

#include "engine/model/shape.h"

/* One that is being placed, part by part. */
struct whole {
	const struct word_row *row;
	const struct var_table *vars;
	uint32_t base;
	int next;
};

static struct whole whole_of(const struct assembler *as, enum word word,
			     uint32_t base)
{
	return (struct whole){
		.row = layout_row(as, word), .base = base,
		.vars = shape_vars(as->translation->project, word),
	};
}

/* A part without parts of its own. */
static void place_part(struct assembler *as, const struct whole *whole, int index,
		       bool init)
{
	const struct word_pin *pin = &whole->row->pin[index];
	uint32_t size = shape_of(&as->translation->project->words, pin).size;
	struct code_run run = { .kind = RUN_VALUES, .type = (uint8_t)pin->type };

	if (pin->type == IEC_NONE) {
		run.kind = RUN_INSTANCE;
		run.word = (uint16_t)pin->word;
	} else if (pin->type == IEC_STRING) {
		run.word = pin->capacity;
	}
	layout_place_at(as, run, whole->base + pin->offset, size);
	if (init && pin->type == IEC_NONE)
		layout_init_pins(as, whole->base + pin->offset, word_row(pin->word));
	else if (init && pin->has_init)
		layout_init_var(as, whole->base + pin->offset,
				&whole->vars->var[index]);
}

/* Runs for its parts, in the order of model/shape.h. */
uint32_t layout_whole(struct assembler *as, enum word word, bool init)
{
	struct whole level[LIMIT_NESTING + 1];
	uint32_t base = (as->data_size + 7) / 8 * 8;
	uint32_t size = layout_row(as, word)->size;
	int depth = 0;

	if (!layout_has_room(as, base, size))
		return as->data_size - 1;
	level[0] = whole_of(as, word, base);
	while (depth >= 0 && !as->failed) {
		struct whole *top = &level[depth];
		const struct word_pin *pin;
		int index;

		if (top->next == top->row->ordered) {
			depth--;
			continue;
		}
		index = top->row->order[top->next++];
		pin = &top->row->pin[index];
		if (pin->type == IEC_NONE && word_is_own(pin->word)) {
			level[++depth] = whole_of(as, pin->word,
						  top->base + pin->offset);
			continue;
		}
		place_part(as, top, index, init);
	}
	as->data_size = base + size;
	return base;
}

const struct frame *layout_pou(const struct assembler *as, enum word word,
			       uint32_t *index)
{
	const struct pou *pou = shape_pou(as->translation->project, word);

	*index = (uint32_t)(pou - as->translation->project->pou);
	return &as->frame[*index];
}
