/* SPDX-License-Identifier: MIT
 *
 * temps_use - how often the value of a temporary is read.
 *
 * A variable named _Tn is a temporary in any POU: a value that is always stored
 * before it is read, with no label between, needs no memory when it is read once.
 */
#include "engine/translate/lists.h"

#include <string.h>
#include <strings.h>

/* What a line does with the variable it names. */
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

/* May the argument stay as it was? Behind CALC and CALCN, and OUT of a function,
 * whose EN may be FALSE; ENO is always written. */
static bool is_conditional(const struct list *list, int at)
{
	const struct scope *scope = list->as->translation->scope;
	const char *pin = scope_text(scope, list->il->line[at].pin);

	while (at > 0 && (list->il->line[at].kind == IL_ARG_IN ||
			  list->il->line[at].kind == IL_ARG_OUT))
		at--;
	if (list->il->line[at].kind == IL_CALL)
		return strcasecmp(pin, "ENO") != 0;
	return list->il->line[at].modifiers & MOD_C;
}

/* Is the argument handed over to a VAR_IN_OUT, and so written too? */
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
		list->fleeting[var] = 0; /* an ordinary variable after all */
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
