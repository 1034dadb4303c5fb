/* SPDX-License-Identifier: MIT
 *
 * st_slot - variables of the evaluator of Structured Text: a tree of values for each.
 */
#include "tests/st/inside.h"

#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static struct value value_of(enum iec_type type, union iec_value from)
{
	struct value value = { .type = type };

	if (type == IEC_REAL)
		value.r = (float)from.r;
	else if (type == IEC_LREAL)
		value.d = from.r;
	else
		value.i = from.i;
	return value;
}

/* Element @number, counted through all dimensions, as declared. */
static struct value declared(struct st_world *world, const struct var *var, uint32_t number)
{
	struct value text = { .type = IEC_STRING, .room = var->capacity };
	const char *written = project_text(world->project, var_value_text(var));
	struct literal literal;

	if (var->type == IEC_STRING) {
		if (text.room > (int)sizeof(text.text))
			text.room = sizeof(text.text);
		if (var->has_init && !var->array.count &&
		    literal_parse(written, strlen(written), &literal) == LITERAL_OK)
			placed_take_text(&text, &literal);
		return text;
	}
	if (var->has_init && !var->array.count)
		return value_of(var->type, var->init);
	for (int i = 0; i < var->init_count; i++) {
		if (number < var->init_list[i].count)
			return value_of(var->type, var->init_list[i].value);
		number -= var->init_list[i].count;
	}
	return (struct value){ .type = var->type };
}

/* Structures and instances: their own members' values. */
static bool make_parts(struct st_world *world, struct slot *slot)
{
	const struct var *var = slot->var;

	slot->kind = SLOT_PARTS;
	slot->pou = shape_pou(world->project, var->fb);
	return slot_frame(world, slot, shape_vars(world->project, var->fb));
}

static bool make_block(struct st_world *world, struct slot *slot)
{
	const struct word_row *row = word_row(slot->var->fb);

	slot->kind = SLOT_BLOCK;
	slot->block = arena_alloc(&world->arena, sizeof(*slot->block));
	slot->part = arena_alloc(&world->arena, row->pin_count * sizeof(*slot->part));
	if (!slot->block || !slot->part)
		return false;
	slot->block->fb = slot->var->fb;
	for (int i = 0; i < row->pin_count && i < PINS_MAX; i++) {
		struct value *pin = &slot->block->pin[i];

		pin->type = row->pin[i].type;
		if (pin->type == IEC_REAL)
			pin->r = (float)pin_init(&row->pin[i]).r;
		else
			pin->i = pin_init(&row->pin[i]).i;
		slot->part[slot->count++] = (struct slot){
			.kind = SLOT_VALUE, .name = row->pin[i].name, .value = pin,
			.flags = row->pin[i].dir == PIN_IN ? VAR_INPUT :
				 row->pin[i].dir == PIN_OUT ? VAR_OUTPUT : VAR_TEMP,
		};
	}
	return true;
}

static bool make_dims(struct st_world *world, struct slot *slot, int dim, uint32_t *number);

/* What a pointer may lead to. */
static bool make_shape(struct st_world *world, struct slot *slot)
{
	uint32_t number = 0;

	slot->shape = arena_alloc(&world->arena, sizeof(*slot->shape));
	if (!slot->shape)
		return false;
	*slot->shape = (struct slot){ .var = slot->var->target->like, .name = slot->name };
	return make_dims(world, slot->shape, 0, &number);
}

static bool make_one(struct st_world *world, struct slot *slot, uint32_t number)
{
	if (slot->var->target && !make_shape(world, slot))
		return false;
	if (slot->var->type == IEC_NONE)
		return word_is_own(slot->var->fb) ? make_parts(world, slot) : make_block(world, slot);
	slot->kind = SLOT_VALUE;
	slot->value = arena_alloc(&world->arena, sizeof(*slot->value));
	if (slot->value)
		*slot->value = declared(world, slot->var, number);
	return slot->value;
}

/* Dimension @dim and those behind it. */
static bool make_dims(struct st_world *world, struct slot *slot, int dim, uint32_t *number)
{
	const struct var *var = slot->var;
	const int dims = !var->array.count ? 0 : var->dims > 1 ? var->dims : 1;
	const struct var_array *bounds = var->dims > 1 ? &var->dim[dim] : &var->array;

	if (dim == dims)
		return make_one(world, slot, (*number)++);
	slot->kind = SLOT_ARRAY;
	slot->low = bounds->low;
	slot->count = (int)bounds->count;
	slot->part = arena_alloc(&world->arena, bounds->count * sizeof(*slot->part));
	for (int i = 0; slot->part && i < slot->count; i++) {
		slot->part[i] = (struct slot){ .var = var, .flags = slot->flags, .name = slot->name };
		if (!make_dims(world, &slot->part[i], dim + 1, number))
			return false;
	}
	return slot->part;
}

bool slot_frame(struct st_world *world, struct slot *out, const struct var_table *table)
{
	out->kind = SLOT_PARTS;
	out->part = arena_alloc(&world->arena, (size_t)table->count * sizeof(*out->part) + 1);
	out->count = 0;
	for (int i = 0; out->part && i < table->count; i++) {
		struct slot *slot = &out->part[out->count++];
		uint32_t number = 0;

		*slot = (struct slot){ .var = &table->var[i], .flags = vars_flags(table, i),
				       .name = project_text(world->project, table->var[i].name) };
		if (!make_dims(world, slot, 0, &number))
			return false;
	}
	return out->part;
}

static void reset_from(struct st_world *world, struct slot *slot, uint32_t *number)
{
	if (slot->kind == SLOT_VALUE && slot->var)
		*slot->value = declared(world, slot->var, (*number)++);
	else if (slot->kind == SLOT_ARRAY)
		for (int i = 0; i < slot->count; i++)
			reset_from(world, &slot->part[i], number);
	else if (slot->kind == SLOT_PARTS)
		slot_reset(world, slot, false);
}

void slot_reset(struct st_world *world, struct slot *slot, bool temporary)
{
	for (int i = 0; i < slot->count; i++) {
		uint32_t number = 0;

		if (!temporary || slot->part[i].flags & VAR_TEMP)
			reset_from(world, &slot->part[i], &number);
	}
}

static bool clone_into(struct st_world *world, struct slot *to, const struct slot *from)
{
	*to = *from;
	if (from->kind == SLOT_VALUE) {
		to->value = arena_alloc(&world->arena, sizeof(*to->value));
		if (to->value)
			*to->value = *from->value;
		return to->value;
	}
	to->part = arena_alloc(&world->arena, (size_t)from->count * sizeof(*to->part));
	for (int i = 0; to->part && i < from->count; i++)
		if (!clone_into(world, &to->part[i], &from->part[i]))
			return false;
	return to->part;
}

struct slot *slot_clone(struct st_world *world, const struct slot *from)
{
	struct slot *slot = arena_alloc(&world->arena, sizeof(*slot));

	return slot && clone_into(world, slot, from) ? slot : NULL;
}

struct slot *slot_member(struct slot *slot, const char *name, int len)
{
	for (int i = 0; slot && slot->kind != SLOT_ARRAY && i < slot->count; i++)
		if (strncasecmp(slot->part[i].name, name, (size_t)len) == 0 &&
		    !slot->part[i].name[len])
			return &slot->part[i];
	return NULL;
}

/* ---- what is compared ---- */

static void show_one(struct st_world *world, struct slot *slot, const char *name,
		     const struct block *block)
{
	struct shown_slot *out;

	if (world->shown_count == SHOWN_ST)
		return;
	out = arena_push(&world->arena, &world->shown, &world->shown_count, sizeof(*out));
	if (!out)
		return;
	snprintf(out->name, sizeof(out->name), "%s", name);
	out->value = slot->value;
	out->block = block;
}

static void show_from(struct st_world *world, struct slot *slot, const char *name)
{
	char more[128];

	if (slot->kind == SLOT_VALUE) {
		show_one(world, slot, name, NULL);
	} else if (slot->kind == SLOT_ARRAY) {
		for (int i = 0; i < slot->count; i++) {
			snprintf(more, sizeof(more), "%.100s[%d]", name, (int)slot->low + i);
			show_from(world, &slot->part[i], more);
		}
	} else {
		for (int i = 0; i < slot->count; i++) {
			snprintf(more, sizeof(more), "%.80s.%.40s", name, slot->part[i].name);
			if (slot->part[i].flags & (VAR_TEMP | VAR_IN_OUT))
				continue;
			if (slot->kind == SLOT_BLOCK)
				show_one(world, &slot->part[i], more,
					 slot->part[i].flags & VAR_INPUT ? slot->block : NULL);
			else
				show_from(world, &slot->part[i], more);
		}
	}
}

void slot_show(struct st_world *world, struct slot *slot, const char *before)
{
	char name[128];

	for (int i = 0; i < slot->count; i++) {
		if (slot->part[i].flags & (VAR_TEMP | VAR_IN_OUT | VAR_SFC) || slot->part[i].shape)
			continue;
		snprintf(name, sizeof(name), "%.60s%s%.60s", before, *before ? "." : "",
			 slot->part[i].name);
		show_from(world, &slot->part[i], name);
	}
}
