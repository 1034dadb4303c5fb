/* SPDX-License-Identifier: MIT
 *
 * sfc_to_il - a scan of a chart as an instruction list (docs/sfc.md).
 *
 * Its cost follows the active steps: EACH jumps to the part of each active step, and each
 * part jumps back.
 */
#include "engine/translate/sfc_unit.h"

#include <stdio.h>
#include <string.h>

/* ---- instructions ---- */

static void add(struct sfc_il *s, struct il_line line)
{
	line.line = s->line;
	line.mark = (uint8_t)(IL_MADE | s->ld.mark);
	if (!il_add(s->ld.il, line))
		s->ld.failed = true;
}

void sfc_op(struct sfc_il *s, enum op op, uint8_t modifiers, uint32_t operand)
{
	add(s, (struct il_line){ .kind = IL_OP, .op = (uint8_t)op,
				 .modifiers = modifiers, .operand = operand });
}

void sfc_fn(struct sfc_il *s, enum word word, uint32_t operand)
{
	add(s, (struct il_line){ .kind = IL_FN, .word = (uint16_t)word,
				 .operand = operand });
}

void sfc_set(struct sfc_il *s, uint32_t operand, bool value)
{
	sfc_op(s, OP_LD, 0, sfc_literal(s, value ? "TRUE" : "FALSE"));
	sfc_op(s, OP_ST, 0, operand);
}

uint32_t sfc_literal(struct sfc_il *s, const char *text)
{
	uint32_t id = names_intern(&s->ld.translation->project->names, text,
				   strlen(text));

	s->ld.failed |= !id;
	return id;
}

uint32_t sfc_label(struct sfc_il *s, const char *name, int number)
{
	char text[32];

	if (number < 0)
		snprintf(text, sizeof(text), "_%.16s", name);
	else
		snprintf(text, sizeof(text), "_%.16s%d", name, number + 1);
	return sfc_literal(s, text);
}

void sfc_here(struct sfc_il *s, uint32_t label)
{
	add(s, (struct il_line){ .kind = IL_LABEL, .operand = label });
}

void sfc_jump(struct sfc_il *s, uint32_t label)
{
	sfc_op(s, OP_JMP, 0, label);
}

void sfc_jump_if(struct sfc_il *s, uint32_t label)
{
	sfc_op(s, OP_JMP, MOD_C, label);
}

void sfc_jump_unless(struct sfc_il *s, uint32_t label)
{
	sfc_op(s, OP_JMP, MOD_C | MOD_N, label);
}

/* The owner of a variable that outlives a scan; the others are FALSE between scans. */
enum owner { OWNER_NONE, OWNER_SFC, OWNER_USE, OWNER_CALLED };

static enum owner owner_of(const char *name)
{
	static const struct { const char *name; enum owner owner; } kept[] = {
		{ "Runs", OWNER_SFC }, { "Last", OWNER_SFC }, { "Fired", OWNER_SFC },
		{ "ResetWas", OWNER_SFC }, { "TipWas", OWNER_SFC },
		{ "ForceWas", OWNER_SFC }, { "Kept", OWNER_USE }, { "Wait", OWNER_USE },
		{ "Since", OWNER_USE }, { "Was", OWNER_CALLED }, { "Due", OWNER_CALLED },
	};

	for (size_t i = 0; i < sizeof(kept) / sizeof(*kept); i++)
		if (strcmp(kept[i].name, name) == 0)
			return kept[i].owner;
	return OWNER_NONE;
}

/* A changed chart keeps values with the same key: "SFC Kept Fill Valve S". */
static void remember(struct sfc_il *s, const char *name, int number)
{
	const struct names *names = &s->ld.translation->project->names;
	const enum owner owner = owner_of(name);
	const struct sfc_use *use = owner == OWNER_USE ? &s->sfc->use[number] : NULL;
	const struct sfc_called *called = owner == OWNER_CALLED ? &s->called[number] : NULL;
	char key[2 * LIMIT_NAME + 32];

	if (owner == OWNER_NONE)
		return;
	snprintf(key, sizeof(key), "SFC %.8s", name);
	if (use)
		snprintf(key, sizeof(key), "SFC %.8s %.*s %.*s %s", name, LIMIT_NAME,
			 names_text(names, s->sfc->step[use->step].name), LIMIT_NAME,
			 names_text(names, use->operand), qualifier_word(use->qualifier));
	if (called)
		snprintf(key, sizeof(key), "SFC %.8s %.*s", name, LIMIT_NAME,
			 names_text(names, called->action < 0 ? called->operand :
				    s->sfc->action[called->action].name));
	s->ld.failed |= !temps_remember(s->ld.temps, key);
}

/* Each instance of a block remembers for itself: model/sfc.c has declared it. */
static uint32_t kept_in_block(struct sfc_il *s, const char *name, int number)
{
	struct names *names = &s->ld.translation->project->names;
	const enum owner owner = owner_of(name);
	const struct sfc_called *called;

	if (owner == OWNER_USE)
		return sfc_use_name(s->sfc, names, name, number);
	if (owner != OWNER_CALLED || strcmp(name, "Due") == 0)
		return sfc_label(s, name, number);
	called = &s->called[number];
	return sfc_called_name(names, name, called->action < 0 ? called->operand :
					    s->sfc->action[called->action].name);
}

/* The list that is watched comes second, with the variables of the first. */
static uint32_t declare(struct sfc_il *s, const char *name, int number,
			struct var like)
{
	const uint32_t id = s->ld.unit->pou->kind == POU_BLOCK ? kept_in_block(s, name, number) :
								 sfc_label(s, name, number);
	enum diag_id why;

	if (!id || scope_find(s->ld.translation->scope, s->ld.unit->pou, id, &why))
		return id;
	s->ld.failed |= !temps_named(s->ld.temps,
				     names_text(&s->ld.translation->project->names, id),
				     &like);
	if (!s->ld.failed)
		remember(s, name, number);
	return id;
}

uint32_t sfc_var(struct sfc_il *s, const char *name, int number, enum iec_type type)
{
	return declare(s, name, number, (struct var){ .type = type });
}

/* A BOOL with the value that it has before the first scan. */
static uint32_t declare_bool(struct sfc_il *s, const char *name, int number, bool value)
{
	return declare(s, name, number, (struct var){ .type = IEC_BOOL,
		.has_init = value, .init = { .i = value } });
}

uint32_t sfc_x_name(const struct sfc_il *s, int step)
{
	const struct var_table *vars = &s->ld.unit->pou->vars;

	return vars->var[sfc_x(s->sfc, vars, step)].name;
}

uint32_t sfc_t_name(const struct sfc_il *s, int step)
{
	const struct var_table *vars = &s->ld.unit->pou->vars;

	return vars->var[sfc_t(s->sfc, vars, step)].name;
}

void *sfc_alloc(struct sfc_il *s, size_t count, size_t size)
{
	void *memory = arena_alloc(s->ld.translation->arena, (count + 1) * size);

	s->ld.failed |= !memory;
	return memory;
}

void sfc_each(struct sfc_il *s, uint32_t back, uint32_t first, const uint32_t *label,
	      int count)
{
	sfc_here(s, back);
	add(s, (struct il_line){ .kind = IL_EACH, .operand = first, .pin = s->cursor });
	for (int i = 0; i < count; i++)
		add(s, (struct il_line){ .kind = IL_TARGET, .operand = label[i] });
}

/* ---- conditions and bodies ---- */

static void copy_list(struct sfc_il *s, const struct sfc_body *body)
{
	const struct il *il = &s->ld.unit->pou->il;

	for (int i = body->first; i < body->first + body->count; i++)
		if (!il_add(s->ld.il, il->line[i]))
			s->ld.failed = true;
}

/* A label is local to its body. */
static void own_label(struct sfc_il *s, struct il_line *line, int body)
{
	const struct names *names = &s->ld.translation->project->names;
	char text[LIMIT_NAME + 16];

	snprintf(text, sizeof(text), "%.*s@%d", LIMIT_NAME,
		 names_text(names, line->operand), body);
	line->operand = sfc_literal(s, text);
}

void sfc_put_body(struct sfc_il *s, const struct sfc_body *body, uint32_t end)
{
	const int first = s->ld.il->count;

	if (s->ld.watch && sfc_body_has_rungs(body))
		s->note[body->first] = s->ld.unit->power_count;
	s->ld.statement = body->kind == BODY_EXPRESSION;
	if (body->kind == BODY_LIST)
		copy_list(s, body);
	else if (body->kind == BODY_ST)
		st_put(&s->ld, body->first, body->count);
	else if (body->kind != BODY_NONE &&
		 !ld_rungs(&s->ld, body->first, body->count, s->skip))
		s->ld.failed = true;
	for (int i = first; i < s->ld.il->count; i++) {
		struct il_line *line = &s->ld.il->line[i];

		if (line->kind == IL_LABEL ||
		    (line->kind == IL_OP && line->op == OP_JMP))
			own_label(s, line, first);
		if (line->kind != IL_OP || line->op != OP_RET)
			continue;
		line->op = OP_JMP;
		line->operand = end;
	}
}

static void darken(struct sfc_il *s, uint32_t power, bool *any)
{
	const struct names *names = &s->ld.translation->project->names;

	if (!power || !is_temporary(names_text(names, power), 'P'))
		return;
	if (!*any)
		sfc_op(s, OP_LD, 0, sfc_literal(s, "FALSE"));
	*any = true;
	sfc_op(s, OP_ST, 0, power);
}

void sfc_darken(struct sfc_il *s, const struct sfc_body *body)
{
	const struct unit *unit = s->ld.unit;
	const uint32_t first = (uint32_t)body->first + 1;
	bool any = false;

	if (!s->ld.watch || !sfc_body_has_rungs(body))
		return;
	s->ld.mark = IL_WATCHING;
	for (int i = s->note[body->first]; i < unit->power_count &&
	     unit->power[i].rung - first < (uint32_t)body->count; i++) {
		darken(s, unit->power[i].in, &any);
		darken(s, unit->power[i].out, &any);
	}
	s->ld.mark = 0;
}

/* ---- a scan ---- */

static void add_tick(struct sfc_il *s)
{
	const uint32_t hold = s->sfc->control[CONTROL_HOLD];
	const struct { const char *pin; uint32_t operand; } arg[] = {
		{ "HOLD", hold ? hold : sfc_literal(s, "FALSE") },
		{ "X", sfc_x_name(s, 0) }, { "T", sfc_t_name(s, 0) },
	};

	add(s, (struct il_line){ .kind = IL_TICK, .operand = s->dt, .pin = s->last,
				 .word = (uint16_t)s->sfc->step_count });
	for (size_t i = 0; i < sizeof(arg) / sizeof(*arg); i++)
		add(s, (struct il_line){ .kind = IL_ARG_IN, .operand = arg[i].operand,
					 .pin = sfc_literal(s, arg[i].pin) });
}

static bool begin(struct sfc_il *s)
{
	const struct pou *pou = s->ld.unit->pou;

	if (!ld_begin(&s->ld) ||
	    !sfc_net_make(s->sfc, s->ld.translation->arena, &s->net))
		return false;
	s->line = (uint32_t)pou->line;
	s->note = sfc_alloc(s, (size_t)pou->rung_count, sizeof(*s->note));
	s->next = sfc_label(s, "Next", -1);
	s->act = sfc_label(s, "Act", -1);
	s->leave = sfc_label(s, "Leave", -1);
	s->enter = sfc_label(s, "Enter", -1);
	s->condition = pou->vars.var[sfc_condition(s->sfc, &pou->vars)].name;
	s->cursor = sfc_var(s, "Step", -1, IEC_UDINT);
	s->dt = sfc_var(s, "Dt", -1, IEC_TIME);
	s->last = sfc_var(s, "Last", -1, IEC_TIME);
	s->fired = declare_bool(s, "Fired", -1, sfc_starts_itself(s->sfc));
	/* Places BOOLs of one kind one after the other, because EACH goes through them. */
	for (int i = 0; i < s->sfc->step_count; i++)
		sfc_var(s, "Left", i, IEC_BOOL);
	for (int i = 0; i < s->sfc->step_count; i++)
		sfc_var(s, "Entered", i, IEC_BOOL);
	if (!sfc_is_in_order(s))
		sfc_find_duties(s);
	sfc_find_called(s);
	return !s->ld.failed;
}

bool sfc_to_il(struct translation *translation, struct unit *unit, const uint8_t *skip,
	       bool watch, struct arena *scratch)
{
	struct sfc_il s = {
		.ld = { .translation = translation, .unit = unit, .scratch = scratch,
			.il = watch ? &unit->watch : &unit->il, .watch = watch },
		.sfc = unit->pou->sfc, .skip = skip,
	};

	const bool in_order = sfc_is_in_order(&s);

	if (!begin(&s))
		return false;
	if (s.sfc->step_count == 0)
		return true;
	add_tick(&s);
	sfc_control(&s);
	sfc_stop(&s);
	if (in_order)
		sfc_order(&s);
	else
		sfc_evaluate(&s);
	sfc_ask(&s);
	sfc_op(&s, OP_RET, 0, 0);
	if (!in_order)
		sfc_fire(&s);
	if (!in_order || sfc_may_begin_anew(&s))
		sfc_leave(&s);
	sfc_enter(&s);
	sfc_act(&s);
	return !s.ld.failed;
}
