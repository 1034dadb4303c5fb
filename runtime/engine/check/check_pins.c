/* SPDX-License-Identifier: MIT
 *
 * check_pins - inputs of called blocks that never get a value.
 *
 * A timer without PT elapses at once, a counter without PV is full from the start:
 * legal, and nearly always forgotten. BOOL inputs may stay open; they are not
 * looked at. Also texts that are too long for their input. It only warns.
 */
#include "engine/check/check_il.h"
#include "engine/model/init.h"

#include <stdio.h>
#include <string.h>

struct pins {
	struct scope *scope;
	uint64_t *given;      /* open hash of variable and pin; 0: free        */
	uint32_t mask;
	struct diag_list *diags;
};

static uint64_t key_of(const struct meaning *instance, int pin)
{
	return (uint64_t)(uintptr_t)instance->var * 65536 + (uint64_t)pin + 1;
}

static uint64_t *slot_of(const struct pins *pins, uint64_t key)
{
	uint32_t at = (uint32_t)((key * 0x9e3779b97f4a7c15u) >> 32) & pins->mask;

	while (pins->given[at] && pins->given[at] != key)
		at = (at + 1) & pins->mask;
	return &pins->given[at];
}

static const struct meaning *find(struct pins *pins, const struct pou *pou,
				  uint32_t operand)
{
	enum diag_id why;

	return operand ? scope_find(pins->scope, pou, operand, &why) : NULL;
}

static bool is_call(const struct il_line *line)
{
	return line->kind == IL_OP && line->op == OP_CAL;
}

/* A constant text for a pin that has less room: its end is cut. */
static void check_room(struct pins *pins, const struct il_pou *list,
		       const struct il_line *line, const struct word_pin *pin)
{
	const struct meaning *m = pin->type == IEC_STRING && line->operand ?
		find(pins, list->pou, line->operand) : NULL;
	char text[IEC_STRING_MOST];
	struct diag place = {
		.id = DIAG_PIN_TEXT_CUT, .file = list->pou->file, .line = (int)line->line,
		.pou = scope_text(pins->scope, list->pou->name),
		.rung = (int)line->rung, .row = line->row, .col = line->col,
	};

	if (m && m->kind == MEANING_LITERAL && m->literal.type == IEC_STRING &&
	    literal_string(&m->literal, text) > pin->capacity)
		diag_add(pins->diags, place, "%s" DIAG_AND "%u", pin->name, pin->capacity);
}

/* Notes parameters of calls, and stores into pins. */
static void note_list(struct pins *pins, const struct il_pou *list)
{
	const struct meaning *instance = NULL;

	for (int i = 0; i < list->il->count; i++) {
		const struct il_line *line = &list->il->line[i];
		const struct meaning *m = NULL;
		uint64_t key = 0;

		if (line->kind == IL_OP || line->kind == IL_ARG_OUT)
			m = find(pins, list->pou, line->operand);
		if (line->kind == IL_OP || line->kind == IL_CALL)
			instance = is_call(line) ? m : NULL;
		if (m && m->kind == MEANING_PIN &&
		    (line->kind == IL_ARG_OUT || line->op == OP_ST))
			key = key_of(m, m->pin);
		if (line->kind == IL_ARG_IN && instance &&
		    instance->kind == MEANING_INSTANCE) {
			const char *name = scope_text(pins->scope, line->pin);
			const struct word_row *row = scope_row(pins->scope, instance->word);
			int pin = word_pin_find(row, name, strlen(name));

			key = key_of(instance, pin);
			if (pin >= 0)
				check_room(pins, list, line, &row->pin[pin]);
		}
		if (key)
			*slot_of(pins, key) = key;
	}
}

static void warn(struct pins *pins, const struct pou *pou,
		 const struct il_line *line, const char *pin)
{
	struct diag place = {
		.id = DIAG_NO_PRESET, .file = pou->file, .line = (int)line->line,
		.pou = scope_text(pins->scope, pou->name),
		.rung = (int)line->rung, .row = line->row, .col = line->col,
	};

	diag_add(pins->diags, place, "%s.%s",
		 scope_text(pins->scope, line->operand), pin);
}

/* Does the declaration give the pin a value? */
static bool is_declared(const struct pins *pins, const struct meaning *m, const char *pin)
{
	const struct names *names = &scope_project(pins->scope)->names;

	return init_has_parts(m->var) &&
	       init_names_pin(names_text(names, m->var->init_text),
			      names_len(names, m->var->init_text), pin);
}

static void check_list(struct pins *pins, const struct il_pou *list)
{
	for (int i = 0; i < list->il->count; i++) {
		const struct il_line *line = &list->il->line[i];
		const struct meaning *m;
		const struct word_row *row;

		if (!is_call(line))
			continue;
		m = find(pins, list->pou, line->operand);
		if (!m || m->kind != MEANING_INSTANCE)
			continue;
		row = scope_row(pins->scope, m->word);
		for (int pin = 0; pin < row->pin_count; pin++)
			if (row->pin[pin].dir == PIN_IN &&
			    row->pin[pin].type != IEC_BOOL &&
			    row->pin[pin].type != IEC_NONE &&
			    !row->pin[pin].has_init &&
			    !*slot_of(pins, key_of(m, pin)) &&
			    !is_declared(pins, m, row->pin[pin].name))
				warn(pins, list->pou, line, row->pin[pin].name);
	}
}

bool check_pins(struct scope *scope, const struct il_pou *list, int count,
		struct arena *scratch, struct diag_list *diags)
{
	struct pins pins = { .scope = scope, .diags = diags };
	size_t lines = 0, size = 16;

	for (int i = 0; i < count; i++)
		lines += (size_t)list[i].il->count;
	while (size < lines * 2)
		size *= 2;
	pins.mask = (uint32_t)size - 1;
	pins.given = arena_alloc(scratch, size * sizeof(*pins.given));
	if (!pins.given)
		return false;
	for (int i = 0; i < count; i++)
		note_list(&pins, &list[i]);
	for (int i = 0; i < count; i++)
		check_list(&pins, &list[i]);
	return true;
}
