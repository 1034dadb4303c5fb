/* SPDX-License-Identifier: MIT
 *
 * pack_power - the maps from cells to their power, in POUs and in instances of blocks.
 */
#include "engine/translate/pack.h"

#include <stdlib.h>
#include <string.h>

static uint32_t power_offset(struct assembler *as, const struct pou *pou,
			     uint32_t name)
{
	const struct meaning *m;
	enum diag_id why;

	if (!name)
		return CODE_TRUE_AT(as->areas);
	m = scope_find(as->translation->scope, pou, name, &why);
	if (!m || m->kind == MEANING_LITERAL)
		return CODE_TRUE_AT(as->areas);
	return layout_spot(as, m).offset;
}

static int by_cell(const void *left, const void *right)
{
	const struct code_power *a = left, *b = right;

	if (a->rung != b->rung)
		return a->rung < b->rung ? -1 : 1;
	if (a->row != b->row)
		return a->row < b->row ? -1 : 1;
	return (a->col > b->col) - (a->col < b->col);
}

/* By place, as one looks for them: a chart comes to its rungs in its own order. */
static void add_power(struct assembler *as, struct maps *maps)
{
	for (int i = 0; i < as->translation->unit_count; i++) {
		const struct unit *unit = &as->translation->unit[i];
		const int first = maps->power_count;

		for (int k = 0; k < unit->power_count; k++) {
			const struct power_note *note = &unit->power[k];
			struct code_power *power = arena_push(as->arena,
				&maps->power, &maps->power_count, sizeof(*power));

			if (!power) {
				as->failed = true;
				return;
			}
			*power = (struct code_power){
				.pou = (uint16_t)i, .rung = note->rung,
				.row = note->row, .col = note->col,
				.in = power_offset(as, unit->pou, note->in),
				.out = power_offset(as, unit->pou, note->out),
			};
		}
		if (unit->pou->sfc && maps->power_count > first)
			qsort(maps->power + first, (size_t)(maps->power_count - first),
			      sizeof(*maps->power), by_cell);
	}
}

/* ---- power by instance ---- */

/* An instance whose power is kept, and those inside it. */
struct kept {
	int unit;
	uint32_t base; /* of its power                                        */
	int next;      /* variable of its block to look at                    */
	uint32_t element; /* of that                                          */
	size_t len;    /* of its name                                         */
};

/* "Belt1" behind the @len bytes of @name; with a dot between. */
static size_t join_name(char *name, size_t len, const char *part)
{
	size_t size = strlen(part);

	if (len > 0)
		name[len++] = '.';
	memcpy(name + len, part, size + 1);
	return len + size;
}

static void add_watched(struct assembler *as, struct maps *maps,
			const struct kept *kept, const char *name)
{
	const struct frame *frame = &as->frame[kept->unit];
	struct code_watched *watched = arena_push(as->arena, &maps->watched,
		&maps->watched_count, sizeof(*watched));

	if (!watched) {
		as->failed = true;
		return;
	}
	*watched = (struct code_watched){
		.pou = (uint32_t)kept->unit, .from = frame->power,
		.to = kept->base, .size = frame->power_size,
		.name = maps_string(as, maps, name, kept->len),
	};
}

/* The next instance inside the one on top, an element at a time; false: no more
 * on this level. */
static bool next_kept(const struct assembler *as, struct kept *top, int *index,
		      uint32_t *element)
{
	int table = top->unit + 1;
	const struct var_table *vars = layout_vars(as, table);

	while (top->next < vars->count && !as->power[table][top->next])
		top->next++;
	if (top->next == vars->count)
		return false;
	*index = top->next;
	*element = top->element++;
	if (top->element >= vars->var[*index].array.count) {
		top->element = 0;
		top->next++;
	}
	return true;
}

/* Element @element of variable @index of table @table, and at all depths what is in
 * it. */
static void keep_instance(struct assembler *as, struct maps *maps, char *name,
			  size_t len, int table, int index, uint32_t element)
{
	const struct project *project = as->translation->project;
	struct kept level[LIMIT_NESTING + 1];
	int depth = -1;

	do {
		const struct var *var = &layout_vars(as, table)->var[index];
		struct word_pin like = { .type = IEC_NONE, .elements = var->array.count, .low = var->array.low };
		uint32_t base = as->power[table][index], unit = 0;
		struct kept *inner = &level[depth + 1];

		if (depth >= 0) { /* inside a block: beside that of its cells */
			base += level[depth].base -
				as->frame[level[depth].unit].power;
			len = level[depth].len;
		}
		base += element * layout_pou(as, var->fb, &unit)->power_size;
		*inner = (struct kept){ .unit = (int)unit, .base = base,
			.len = join_name(name, len,
					 project_text(project, var->name)) };
		inner->len += maps_join_index(name + inner->len, &like, element);
		add_watched(as, maps, inner, name);
		depth++;
		while (depth >= 0 &&
		       !next_kept(as, &level[depth], &index, &element))
			depth--;
		if (depth >= 0)
			table = level[depth].unit + 1;
	} while (depth >= 0 && !as->failed);
}

static void keep_table(struct assembler *as, struct maps *maps, char *name,
		       int table)
{
	const struct project *project = as->translation->project;
	const struct var_table *vars = layout_vars(as, table);

	for (int i = 0; i < vars->count && !as->failed; i++) {
		size_t len = 0;

		if (!as->power[table][i])
			continue;
		if (table && maps->declared[vars->var[i].fold] > 1)
			len = join_name(name, 0, project_text(project,
				project->pou[table - 1].name));
		for (uint32_t k = 0; k == 0 || k < vars->var[i].array.count; k++)
			if (!as->failed)
				keep_instance(as, maps, name, len, table, i, k);
	}
}

static void keep_powers(struct assembler *as, struct maps *maps)
{
	const struct project *project = as->translation->project;
	char *name = as->power ? arena_alloc(as->arena, NAME_MOST) : NULL;

	if (!name)
		return;
	keep_table(as, maps, name, 0);
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_PROGRAM)
			keep_table(as, maps, name, i + 1);
}

void pack_power(struct assembler *as, struct maps *maps)
{
	add_power(as, maps);
	keep_powers(as, maps);
}
