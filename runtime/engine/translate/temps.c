/* SPDX-License-Identifier: MIT
 *
 * temps - makes names of temporaries, declares them in the scope and counts their uses.
 */
#include "engine/translate/temps.h"

#include "engine/translate/lists.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

bool is_temporary(const char *name, char letter)
{
	if (name[0] != '_' || name[1] != letter || !name[2] || name[2] == '0')
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
	       var->array.count == like->array.count &&
	       vars_same_bounds(var->dim, var->dims, like->dim, like->dims);
}

uint32_t temps_whole(struct temps *temps, const struct meaning *m)
{
	const struct var like = {
		.type = m->type, .array = m->array, .capacity = m->capacity,
		.dims = m->kind == MEANING_ARRAY ? m->dims : 0,
		.own_dims = m->kind == MEANING_ARRAY ? m->dims : 0,
		.dim = m->kind == MEANING_ARRAY ? (struct var_array *)(uintptr_t)m->dim : NULL,
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

/* How a line uses the variable that it names. */
enum use { USE_NONE, USE_READ, USE_WRITE, USE_BOTH };

static enum use use_of(const struct il_line *line)
{
	switch ((enum il_kind)line->kind) {
	case IL_OP:
		switch (op_row((enum op)line->op)->operand) {
		case OPND_ANY_R:
		case OPND_BOOL_R:
			return USE_READ;
		case OPND_ANY_W:
			return USE_WRITE;
		case OPND_BOOL_W:
			return USE_BOTH;
		case OPND_NONE:
		case OPND_LABEL:
		case OPND_ROUTINE:
		case OPND_EXECUTE:
		case OPND_INSTANCE:
		case OPND_EXPR:
		case OPND_LOOP:
		case OPND_LOOP_END:
		case OPND_ASSIGN:
		case OPND_PIN:
			return USE_NONE;
		}
		return USE_NONE;
	case IL_FN:
	case IL_ARG_IN:
		return USE_READ;
	case IL_ARG_OUT:
		return USE_WRITE;
	case IL_CLOSE:
	case IL_LABEL:
	case IL_CALL:
	case IL_COMMENT:
	case IL_EACH:
	case IL_TARGET:
	case IL_TICK:
		return USE_NONE;
	}
	return USE_NONE;
}

static int variable_count(const struct list *list)
{
	return list->pou->vars.count + list->unit->temp_count;
}

int list_temp(const struct list *list, const struct meaning *m)
{
	if (m->kind != MEANING_VARIABLE || m->pou != list->pou ||
	    !list->fleeting[m->index])
		return -1;
	return m->index;
}

static void mark_names(struct list *list)
{
	const struct names *names = &list->as->translation->project->names;
	const struct var_table *vars = &list->pou->vars;

	for (int i = 0; i < variable_count(list); i++) {
		const struct var *var = i < vars->count ? &vars->var[i] :
			list->unit->temp[i - vars->count];

		list->fleeting[i] = var->type == IEC_BOOL && !var->has_init &&
			!var->array.count &&
			var->at.area == AREA_NONE &&
			is_temporary(names_text(names, var->name), 'T');
	}
}

/* May the argument keep its old value? After CALC and CALCN, after the call of an element that there may not
 * be, and for OUT of a function whose EN may be FALSE; ENO is always written. */
static bool is_conditional(struct list *list, int at)
{
	const struct scope *scope = list->as->translation->scope;
	const char *pin = scope_text(scope, list->il->line[at].pin);
	const struct meaning *m;

	while (at > 0 && (list->il->line[at].kind == IL_ARG_IN ||
			  list->il->line[at].kind == IL_ARG_OUT))
		at--;
	if (list->il->line[at].kind == IL_CALL)
		return strcasecmp(pin, "ENO") != 0;
	m = list_meaning(list, list->il->line[at].operand);
	return list->il->line[at].modifiers & MOD_C || (m && (meaning_is_indexed(m) || m->through));
}

/* Is the argument a VAR_IN_OUT, which is also written? */
static bool is_in_out(struct list *list, int at)
{
	const struct scope *scope = list->as->translation->scope;
	const char *pin = scope_text(scope, list->il->line[at].pin);
	const struct word_row *row;
	const struct meaning *m;
	enum word word;
	int index;

	while (at > 0 && (list->il->line[at].kind == IL_ARG_IN ||
			  list->il->line[at].kind == IL_ARG_OUT))
		at--;
	word = (enum word)list->il->line[at].word;
	if (list->il->line[at].kind == IL_OP) {
		m = list_meaning(list, list->il->line[at].operand);
		word = m ? m->word : word;
	}
	if (!word_is_own(word))
		return false;
	row = list_row(list, word);
	index = word_pin_find(row, pin, strlen(pin));
	return index >= 0 && row->pin[index].dir == PIN_IN_OUT;
}

/* @stored: by variable, line + 1 of its last store in this block. */
static void count_line(struct list *list, int at, int *stored, const int *block)
{
	const struct il_line *line = &list->il->line[at];
	enum use use = use_of(line);
	const struct meaning *m;
	int var;

	if (use == USE_NONE || !line->operand)
		return;
	if (line->kind == IL_ARG_OUT && is_conditional(list, at))
		use = USE_BOTH;
	if (line->kind == IL_ARG_IN && is_in_out(list, at))
		use = USE_BOTH;
	m = list_meaning(list, line->operand);
	var = m ? list_temp(list, m) : -1;
	if (var < 0)
		return;
	if (use == USE_BOTH ||
	    (use == USE_READ && (!stored[var] || stored[var] - 1 < *block)))
		list->fleeting[var] = 0; /* treat it as an ordinary variable */
	else if (use == USE_READ)
		list->reads[stored[var] - 1]++;
	else
		stored[var] = at + 1;
}

bool list_count_reads(struct list *list)
{
	struct arena *arena = list->as->arena;
	size_t count = (size_t)variable_count(list) + 1;
	int *stored = arena_alloc(arena, count * sizeof(int));
	int block = 0;

	list->fleeting = arena_alloc(arena, count);
	list->reads = arena_alloc(arena, ((size_t)list->il->count + 1) *
				  sizeof(int));
	if (!stored || !list->fleeting || !list->reads)
		return false;
	mark_names(list);
	for (int i = 0; i < list->il->count; i++) {
		if (list->il->line[i].kind == IL_LABEL)
			block = i;
		count_line(list, i, stored, &block);
	}
	return true;
}
