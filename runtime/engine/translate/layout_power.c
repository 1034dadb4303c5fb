/* SPDX-License-Identifier: MIT
 *
 * layout_power - places for what is watched: power of the cells of each POU, and of a
 * function block's cells once more for each instance.
 *
 * Behind the power of a block's own cells lies that of the instances inside it, so that one
 * copy takes all along. Those of an array lie one behind the other.
 */
#include "engine/translate/assembler.h"

#include "engine/model/shape.h"

/* The unit whose cells an instance has; -1: none of the project's, or not its own. */
static int unit_of(const struct assembler *as, const struct var_table *vars,
		   int index)
{
	const struct project *project = as->translation->project;
	const struct var *var = &vars->var[index];
	const struct pou *pou = var->type == IEC_NONE ?
		shape_pou(project, var->fb) : NULL;

	return pou && pou->kind == POU_BLOCK &&
	       !(vars_flags(vars, index) & VAR_IN_OUT) ?
	       (int)(pou - project->pou) : -1;
}

/* Of all instances of one variable, whose block is @unit. */
static uint64_t power_of(const struct assembler *as, const struct var *var, int unit)
{
	uint32_t count = var->array.count ? var->array.count : 1;

	return (uint64_t)as->frame[unit].power_size * count;
}

static uint32_t own_cells(const struct assembler *as, int unit)
{
	const struct unit *u = &as->translation->unit[unit];
	const struct names *names = &as->translation->project->names;
	uint32_t count = 0;

	for (int i = 0; i < u->temp_count; i++)
		count += is_temporary(names_text(names, u->temp[i]->name), 'P');
	return count;
}

/* Blocks inside have less depth, so that their sizes are known. */
static void measure(struct assembler *as, int unit)
{
	const struct var_table *vars = layout_vars(as, unit + 1);
	uint64_t size = own_cells(as, unit);

	for (int i = 0; i < vars->count && size <= LIMIT_DATA; i++) {
		int inner = unit_of(as, vars, i);

		if (inner >= 0)
			size += power_of(as, &vars->var[i], inner);
	}
	as->frame[unit].power_size = size <= LIMIT_DATA ? (uint32_t)size
							: LIMIT_DATA;
}

static void measure_all(struct assembler *as)
{
	for (int depth = 1; depth <= LIMIT_NESTING; depth++)
		for (int i = 0; i < as->translation->unit_count; i++) {
			const struct pou *pou = as->translation->unit[i].pou;

			if (pou->kind == POU_BLOCK &&
			    layout_row(as, pou->word)->depth == depth)
				measure(as, i);
		}
}

static bool place_table(struct assembler *as, int table)
{
	const struct var_table *vars = layout_vars(as, table);

	as->power[table] = arena_alloc(as->arena, ((size_t)vars->count + 1) *
				       sizeof(uint32_t));
	if (!as->power[table])
		return false;
	if (table > 0)
		as->frame[table - 1].power = as->data_size;
	if (!layout_place_powers(as, table))
		return false;
	for (int i = 0; i < vars->count; i++) {
		int unit = unit_of(as, vars, i);
		uint64_t size = unit < 0 ? 0 : power_of(as, &vars->var[i], unit);

		as->power[table][i] = size ? as->data_size : 0;
		for (; size > 0 && !as->failed; size--)
			layout_tail(as, RUN_VALUES, IEC_BOOL);
	}
	return !as->failed;
}

void layout_power(struct assembler *as)
{
	int tables = as->translation->unit_count + 1;

	as->power = arena_alloc(as->arena, (size_t)tables * sizeof(*as->power));
	if (!as->power) {
		as->failed = true;
		return;
	}
	measure_all(as);
	for (int table = 0; table < tables; table++)
		if (!place_table(as, table))
			as->failed = true;
}
