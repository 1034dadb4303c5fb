/* SPDX-License-Identifier: MIT
 *
 * layout_pins - which pins of instances are written by one call alone.
 *
 * A constant that only that call hands over may be the pin's initial value instead. On
 * the way it finds the functions that name their ENO.
 */
#include "engine/translate/assembler.h"

#include <string.h>

/* ---- pins that always get the same constant ---- */

static uint8_t *pin_count(const struct assembler *as, const struct meaning *m)
{
	uint32_t first = as->first_pin[layout_table(as, m)][m->index];

	return &as->pin_writes[first + (uint32_t)m->pin];
}

/* Only pins of the catalogue's blocks are counted, and in programs: others lie in
 * many instances. */
static bool is_counted(const struct meaning *m)
{
	return m->var->type == IEC_NONE && !word_is_own(m->var->fb) &&
	       !m->var->array.count &&
	       (!m->pou || m->pou->kind == POU_PROGRAM);
}

/* A parameter of a call counts one, any other use two: then it is not alone. */
static void count_use(struct assembler *as, const struct meaning *m,
		      bool parameter)
{
	uint8_t *count = pin_count(as, m);

	*count = (uint8_t)(*count + (parameter ? 1 : 2));
	if (*count > 2)
		*count = 2;
}

/* Calls of an instance are counted behind its pins. */
static struct meaning calls_of(const struct assembler *as,
			       const struct meaning *instance)
{
	struct meaning calls = *instance;

	calls.pin = layout_row(as, instance->var->fb)->pin_count;
	return calls;
}

static void count_call(struct assembler *as, const struct meaning *instance)
{
	struct meaning calls = calls_of(as, instance);

	count_use(as, &calls, true);
}

/* ENO of the function whose list it is. */
static bool is_eno(const struct pou *pou, const struct meaning *m)
{
	return pou->kind == POU_FUNCTION && pou->vars.count > 1 &&
	       m->var == &pou->vars.var[1];
}

static void count_list(struct assembler *as, const struct unit *unit)
{
	struct scope *scope = as->translation->scope;
	const struct meaning *instance = NULL;
	enum diag_id why;

	for (int i = 0; i < unit->il.count; i++) {
		const struct il_line *line = &unit->il.line[i];
		const struct meaning *m = NULL;

		if (line->operand && line->kind != IL_LABEL &&
		    line->kind != IL_TARGET && line->kind != IL_COMMENT)
			m = scope_find(scope, unit->pou, line->operand, &why);
		if (m && m->var && is_eno(unit->pou, m))
			as->frame[unit - as->translation->unit].eno = true;
		if (line->kind == IL_OP)
			instance = m && m->kind == MEANING_INSTANCE &&
				   is_counted(m) ? m : NULL;
		if (line->kind == IL_CALL)
			instance = NULL;
		if (m && m->kind == MEANING_PIN && is_counted(m))
			count_use(as, m, false);
		if (line->kind == IL_OP && instance)
			count_call(as, instance);
		if (line->kind == IL_ARG_IN && instance) {
			struct meaning pin = *instance;
			const char *name = scope_text(scope, line->pin);

			pin.pin = word_pin_find(layout_row(as, pin.var->fb), name,
						strlen(name));
			if (pin.pin >= 0)
				count_use(as, &pin, true);
		}
	}
}

bool layout_count_pins(struct assembler *as)
{
	int tables = as->translation->unit_count + 1;
	uint32_t pins = 0;

	as->first_pin = arena_alloc(as->arena,
				    (size_t)tables * sizeof(uint32_t *));
	if (!as->first_pin)
		return false;
	for (int table = 0; table < tables; table++) {
		int size = layout_vars(as, table)->count;
		uint32_t *first = arena_alloc(as->arena, ((size_t)size + 1) *
					      sizeof(*first));

		if (!first)
			return false;
		as->first_pin[table] = first;
		for (int i = 0; i < size; i++) {
			const struct var *var = &layout_vars(as, table)->var[i];

			first[i] = pins;
			if (var->type == IEC_NONE && !word_is_own(var->fb))
				pins += layout_row(as, var->fb)->pin_count + 1u;
		}
	}
	as->pin_writes = arena_alloc(as->arena, pins + 1u);
	if (!as->pin_writes)
		return false;
	for (int i = 0; i < as->translation->unit_count; i++)
		count_list(as, &as->translation->unit[i]);
	return true;
}

bool layout_only_stored(const struct assembler *as, const struct meaning *pin)
{
	const struct var_table *vars = layout_vars(as, layout_table(as, pin));
	struct meaning calls = calls_of(as, pin);

	/* What is retained comes back as it was before the program was edited: each
	 * call must give its constant anew. */
	if (!is_counted(pin) || vars_flags(vars, pin->index) & VAR_RETAIN)
		return false;
	return *pin_count(as, pin) == 1 && *pin_count(as, &calls) == 1;
}
