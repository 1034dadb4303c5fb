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
	uint32_t element;   /* of the part at next                           */
};

static struct whole whole_of(const struct assembler *as, enum word word,
			     uint32_t base)
{
	return (struct whole){
		.row = layout_row(as, word), .base = base,
		.vars = shape_vars(as->translation->project, word),
	};
}

/* Instances of the catalogue. */
static void place_blocks(struct assembler *as, const struct word_pin *pin,
			 uint32_t offset, struct extent extent, bool init)
{
	uint32_t count = pin->elements ? pin->elements : 1;

	layout_instances(as, pin->word, offset, count, extent.unit);
	for (uint32_t i = 0; i < count && init && !as->failed; i++)
		layout_init_pins(as, offset + i * extent.unit, word_row(pin->word));
}

/* A part without parts of the project's own. */
static void place_part(struct assembler *as, const struct whole *whole, int index,
		       bool init)
{
	const struct word_pin *pin = &whole->row->pin[index];
	struct extent extent = shape_of(&as->translation->project->words, pin);
	uint32_t offset = whole->base + pin->offset;
	struct code_run run = { .kind = RUN_VALUES, .type = (uint8_t)pin->type,
				.count = pin->elements };

	if (pin->type == IEC_STRING)
		run.word = pin->capacity;
	if (pin->type == IEC_NONE)
		place_blocks(as, pin, offset, extent, init);
	else
		layout_place_at(as, run, offset, extent.unit);
	if (init && pin->has_init)
		layout_init_var(as, offset, &whole->vars->var[index]);
}

/* Behind the last part of what has parts of the project's own: what the declaration of
 * that member itself says. */
static void end_part(struct assembler *as, const struct whole *outer)
{
	int index;
	const struct word_pin *pin;

	if (outer->element)
		return; /* of an array more elements come */
	index = outer->row->order[outer->next - 1];
	pin = &outer->row->pin[index];
	if (pin->has_init)
		layout_init_var(as, outer->base + pin->offset,
				&outer->vars->var[index]);
}

/* The next part of @top, an element at a time if it is an array of what has parts of
 * the project's own; @offset: where it lies. */
static int next_part(const struct assembler *as, struct whole *top, uint32_t *offset)
{
	int index = top->row->order[top->next];
	const struct word_pin *pin = &top->row->pin[index];
	bool each = pin->type == IEC_NONE && word_is_own(pin->word);

	*offset = top->base + pin->offset;
	if (each)
		*offset += top->element++ * layout_row(as, pin->word)->size;
	if (!each || top->element >= pin->elements) {
		top->element = 0;
		top->next++;
	}
	return index;
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
		uint32_t offset;
		int index;

		if (top->next == top->row->ordered) {
			if (--depth >= 0 && init)
				end_part(as, &level[depth]);
			continue;
		}
		index = next_part(as, top, &offset);
		pin = &top->row->pin[index];
		if (pin->type == IEC_NONE && word_is_own(pin->word)) {
			level[++depth] = whole_of(as, pin->word, offset);
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
