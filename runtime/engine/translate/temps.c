/* SPDX-License-Identifier: MIT
 *
 * temps - makes the names and declares them in the scope.
 */
#include "engine/translate/temps.h"

#include <stdio.h>
#include <string.h>

bool is_temporary(const char *name, char letter)
{
	if (name[0] != '_' || name[1] != letter || !name[2])
		return false;
	for (name += 2; *name; name++)
		if (*name < '0' || *name > '9')
			return false;
	return true;
}

void temps_rung(struct temps *temps)
{
	temps->bools = 0;
	for (int i = 0; i < IEC_TYPE_COUNT; i++)
		temps->numbers[i] = 0;
	for (int i = 0; i < temps->whole_count; i++)
		temps->whole[i].used = false;
}

uint32_t temps_named(struct temps *temps, const char *name, const struct var *like)
{
	struct translation *t = temps->translation;
	struct unit *unit = temps->unit;
	struct names *names = &t->project->names;
	struct var *var = arena_alloc(t->arena, sizeof(*var));
	struct var **slot;

	if (!var)
		return 0;
	*var = *like;
	var->name = names_intern(names, name, strlen(name));
	var->fold = names_fold(names, var->name);
	slot = arena_push(t->arena, &unit->temp, &unit->temp_count,
			  sizeof(*slot));
	if (!slot || !var->fold ||
	    !scope_add(t->scope, unit->pou, var,
		       unit->pou->vars.count + unit->temp_count - 1))
		return 0;
	*slot = var;
	return var->name;
}

bool temps_remember(struct temps *temps, const char *key)
{
	struct arena *arena = temps->translation->arena;
	const char *copy = arena_copy(arena, key, strlen(key));
	struct temp_memory *slot = arena_push(arena, &temps->memory, &temps->memory_count,
					      sizeof(*slot));

	if (slot)
		*slot = (struct temp_memory){
			temps->unit->temp[temps->unit->temp_count - 1], copy,
		};
	return slot && copy;
}

/* @like: its type. 0: no memory. */
static uint32_t declare_like(struct temps *temps, char letter, int number,
			     const struct var *like)
{
	char text[24];

	snprintf(text, sizeof(text), "_%c%d", letter, number);
	return temps_named(temps, text, like);
}

static uint32_t declare(struct temps *temps, char letter, int number,
			enum iec_type type)
{
	const struct var like = { .type = type };

	return declare_like(temps, letter, number, &like);
}

/* Name number @used of a list, made when it is not there yet. */
static uint32_t next(struct temps *temps, uint32_t **names, int *count,
		     int used, char letter, int number, enum iec_type type)
{
	uint32_t *slot, name;

	if (used < *count)
		return (*names)[used];
	name = declare(temps, letter, number, type);
	slot = arena_push(temps->translation->arena, names, count,
			  sizeof(*slot));
	if (!slot || !name)
		return 0;
	*slot = name;
	return name;
}

uint32_t temps_bool(struct temps *temps)
{
	int used = temps->bools++;

	return next(temps, &temps->bool_name, &temps->bool_count, used, 'T',
		    used + 1, IEC_BOOL);
}

uint32_t temps_edge(struct temps *temps, const char *key)
{
	int used = temps->edges++;

	if (used == temps->edge_key_count) {
		const char **slot = arena_push(temps->translation->arena,
					       &temps->edge_key,
					       &temps->edge_key_count, sizeof(*slot));

		if (!slot || !key)
			return 0;
		*slot = key;
	}
	return next(temps, &temps->edge_name, &temps->edge_count, used, 'E',
		    used + 1, IEC_BOOL);
}

uint32_t temps_power(struct temps *temps)
{
	int used = temps->powers++;

	return next(temps, &temps->power_name, &temps->power_count, used, 'P',
		    used + 1, IEC_BOOL);
}

uint32_t temps_number(struct temps *temps, enum iec_type type)
{
	int used = temps->numbers[type]++;
	int before = temps->number_count[type];
	uint32_t name = next(temps, &temps->number_name[type],
			     &temps->number_count[type], used, 'N',
			     temps->numbers_made + 1, type);

	temps->numbers_made += temps->number_count[type] - before;
	return name;
}

static bool is_like(const struct var *var, const struct var *like)
{
	return var->type == like->type && var->fb == like->fb &&
	       var->capacity == like->capacity &&
	       var->array.low == like->array.low &&
	       var->array.count == like->array.count;
}

uint32_t temps_whole(struct temps *temps, const struct meaning *m)
{
	const struct var like = {
		.type = m->type, .array = m->array, .capacity = m->capacity,
		.fb = m->type == IEC_NONE ? (enum word)m->word : (enum word)0,
	};
	struct temp_whole *slot;

	for (int i = 0; i < temps->whole_count; i++) {
		slot = &temps->whole[i];
		if (slot->used || !is_like(slot->var, &like))
			continue;
		slot->used = true;
		return slot->var->name;
	}
	slot = arena_push(temps->translation->arena, &temps->whole,
			  &temps->whole_count, sizeof(*slot));
	if (!slot)
		return 0;
	slot->used = true;
	if (!declare_like(temps, 'N', ++temps->numbers_made, &like)) {
		temps->whole_count--;
		return 0;
	}
	slot->var = temps->unit->temp[temps->unit->temp_count - 1];
	return slot->var->name;
}
