/* SPDX-License-Identifier: MIT
 *
 * temps - makes the names and declares them in the scope.
 */
#include "engine/translate/temps.h"

#include <stdio.h>

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
}

static uint32_t declare(struct temps *temps, char letter, int number,
			enum iec_type type)
{
	struct translation *t = temps->translation;
	struct unit *unit = temps->unit;
	struct names *names = &t->project->names;
	struct var *var = arena_alloc(t->arena, sizeof(*var));
	struct var **slot;
	char text[24];
	int len = snprintf(text, sizeof(text), "_%c%d", letter, number);

	if (!var)
		return 0;
	var->name = names_intern(names, text, (size_t)len);
	var->fold = names_fold(names, var->name);
	var->type = type;
	slot = arena_push(t->arena, &unit->temp, &unit->temp_count,
			  sizeof(*slot));
	if (!slot || !var->fold ||
	    !scope_add(t->scope, unit->pou, var,
		       unit->pou->vars.count + unit->temp_count - 1))
		return 0;
	*slot = var;
	return var->name;
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

uint32_t temps_edge(struct temps *temps)
{
	int used = temps->edges++;

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
