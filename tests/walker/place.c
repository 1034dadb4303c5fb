/* SPDX-License-Identifier: MIT
 *
 * place - the walker's variables: found by name, read and written one by one.
 *
 * Direct addresses live in plain byte arrays, so whatever overlays is seen at
 * once. Linear searches: the programs it walks are small.
 */
#include "tests/walker/inside.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static struct value initial(const struct var *var)
{
	struct value value = { .type = var->type };

	if (!var->has_init)
		return value;
	if (var->type == IEC_REAL)
		value.r = (float)var->init.r;
	else
		value.i = var->init.i;
	return value;
}

static struct placed at_address(struct walker *walker, struct iec_addr addr,
				enum iec_type type)
{
	return (struct placed){
		.kind = PLACED_AREA, .type = type,
		.byte = walker->area[addr.area] + addr.byte, .bit = addr.bit,
	};
}

static struct block *new_block(struct walker *walker, enum word fb)
{
	struct block *block = arena_alloc(&walker->arena, sizeof(*block));
	const struct word_row *row = word_row(fb);

	if (!block)
		return NULL;
	block->fb = fb;
	for (int i = 0; i < row->pin_count && i < PINS_MAX; i++)
		block->pin[i].type = row->pin[i].type;
	return block;
}

static bool declare_table(struct walker *walker, const struct pou *pou,
			  const struct var_table *table)
{
	for (int i = 0; i < table->count; i++) {
		const struct var *var = &table->var[i];
		struct variable *at =
			&walker->variable[walker->variable_count++];
		struct placed there;

		at->pou = pou;
		at->var = var;
		at->value = initial(var);
		if (var->type == IEC_NONE) {
			at->block = new_block(walker, var->fb);
			if (!at->block)
				return false;
		} else if (var->at.area != AREA_NONE && var->has_init) {
			there = at_address(walker, var->at, var->type);
			placed_write(&there, at->value);
		}
	}
	return true;
}

static struct placed of_variable(struct walker *walker,
				 struct variable *variable)
{
	const struct var *var = variable->var;

	if (variable->block)
		return (struct placed){ .kind = PLACED_NOWHERE };
	if (var->at.area != AREA_NONE)
		return at_address(walker, var->at, var->type);
	return (struct placed){ .kind = PLACED_VALUE, .type = var->type,
				.value = &variable->value };
}

static void show(struct walker *walker, struct variable *variable,
		 const struct word_pin *pin, struct value *value)
{
	struct shown *out = &walker->shown[walker->shown_count++];
	const char *pou = variable->pou ? project_text(walker->project,
					variable->pou->name) : "";

	snprintf(out->name, sizeof(out->name), "%s%s%s%s%s", pou,
		 *pou ? "." : "",
		 project_text(walker->project, variable->var->name),
		 pin ? "." : "", pin ? pin->name : "");
	out->placed = pin ? (struct placed){ .kind = PLACED_VALUE,
					     .type = pin->type, .value = value } :
			    of_variable(walker, variable);
	if (pin && pin->dir == PIN_IN)
		out->block = variable->block;
}

static bool show_all(struct walker *walker)
{
	walker->shown = arena_alloc(&walker->arena,
				    (size_t)walker->variable_count * PINS_MAX *
				    sizeof(*walker->shown) + 1);
	if (!walker->shown)
		return false;
	for (int i = 0; i < walker->variable_count; i++) {
		struct variable *at = &walker->variable[i];
		const struct word_row *row =
			at->block ? word_row(at->block->fb) : NULL;

		if (!row)
			show(walker, at, NULL, NULL);
		for (int p = 0; row && p < row->pin_count; p++)
			if (row->pin[p].dir != PIN_VAR)
				show(walker, at, &row->pin[p],
				     &at->block->pin[p]);
	}
	return true;
}

bool walker_declare(struct walker *walker)
{
	struct project *project = walker->project;
	int count = project->globals.count;

	for (int i = 0; i < project->pou_count; i++)
		count += project->pou[i].vars.count;
	walker->variable = arena_alloc(&walker->arena, (size_t)count *
				       sizeof(*walker->variable) + 1);
	if (!walker->variable)
		return false;
	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++) {
		walker->area[i] = arena_alloc(&walker->arena,
			iec_area_row((enum iec_area)i)->bytes + 8);
		if (!walker->area[i])
			return false;
	}
	if (!declare_table(walker, NULL, &project->globals))
		return false;
	for (int i = 0; i < project->pou_count; i++)
		if (!declare_table(walker, &project->pou[i],
				   &project->pou[i].vars))
			return false;
	return show_all(walker);
}

static struct variable *find_in(struct walker *walker, const struct pou *pou,
				const char *text, size_t len)
{
	for (int i = 0; i < walker->variable_count; i++) {
		struct variable *at = &walker->variable[i];
		const char *name = project_text(walker->project, at->var->name);

		if (at->pou == pou && strlen(name) == len &&
		    strncasecmp(name, text, len) == 0)
			return at;
	}
	return NULL;
}

static struct variable *find(struct walker *walker, const struct pou *pou,
			     const char *text, size_t len)
{
	struct variable *local = pou ? find_in(walker, pou, text, len) : NULL;

	return local ? local : find_in(walker, NULL, text, len);
}

static struct placed of_pin(struct walker *walker, const struct pou *pou,
			    const char *text, size_t len)
{
	const char *dot = memchr(text, '.', len);
	struct placed placed = { .kind = PLACED_NOWHERE };
	struct variable *variable;
	char name[32] = "";
	size_t n;
	int pin;

	variable = dot ? find(walker, pou, text, (size_t)(dot - text)) : NULL;
	if (!variable || !variable->block)
		return placed;
	n = len - (size_t)(dot + 1 - text);
	if (n >= sizeof(name))
		return placed;
	memcpy(name, dot + 1, n);
	pin = block_pin(variable->block, name);
	if (pin < 0)
		return placed;
	placed.kind = PLACED_VALUE;
	placed.value = &variable->block->pin[pin];
	placed.type = placed.value->type;
	return placed;
}

static struct placed of_system(struct walker *walker, const char *text,
			       size_t len)
{
	struct iec_addr addr;

	for (int i = 0; i < SYS_COUNT; i++) {
		const struct sys_row *row = sys_row((enum sys_id)i);

		if (strlen(row->name) == len &&
		    strncasecmp(row->name, text, len) == 0 &&
		    iec_addr_parse(row->address, strlen(row->address),
				   &addr) == ADDR_OK)
			return at_address(walker, addr, row->type);
	}
	return (struct placed){ .kind = PLACED_NOWHERE };
}

struct placed walker_place(struct walker *walker, const struct pou *pou,
			   const char *text, size_t len)
{
	struct variable *variable = find(walker, pou, text, len);
	struct placed placed;
	struct iec_addr addr;

	if (variable)
		return of_variable(walker, variable);
	placed = of_system(walker, text, len);
	if (placed.kind != PLACED_NOWHERE)
		return placed;
	placed = of_pin(walker, pou, text, len);
	if (placed.kind != PLACED_NOWHERE)
		return placed;
	if (literal_parse(text, len, &placed.literal) == LITERAL_OK) {
		placed.kind = PLACED_LITERAL;
		placed.type = placed.literal.type;
	} else if (iec_addr_parse(text, len, &addr) == ADDR_OK) {
		return at_address(walker, addr, iec_addr_type(addr));
	}
	return placed;
}

static struct value read_area(const struct placed *placed)
{
	const struct iec_type_row *row = iec_type_row(placed->type);
	struct value value = { .type = placed->type };
	uint64_t bits = 0;
	uint32_t word;

	if (placed->type == IEC_BOOL)
		return value_bool(*placed->byte >> placed->bit & 1);
	for (int i = 0; i < row->size; i++)
		bits |= (uint64_t)placed->byte[i] << 8 * i;
	if (placed->type == IEC_REAL) {
		word = (uint32_t)bits;
		memcpy(&value.r, &word, sizeof(word));
		return value;
	}
	if (row->low < 0 && row->size < 8 && bits >> (8 * row->size - 1))
		bits |= ~(uint64_t)0 << 8 * row->size;
	value.i = (int64_t)bits;
	return value;
}

static void write_area(const struct placed *placed, struct value value)
{
	uint64_t bits = (uint64_t)value.i;
	uint32_t word;

	if (placed->type == IEC_BOOL) {
		*placed->byte &= (uint8_t)~(1u << placed->bit);
		*placed->byte |= (uint8_t)(value_is_true(value) << placed->bit);
		return;
	}
	if (placed->type == IEC_REAL) {
		memcpy(&word, &value.r, sizeof(word));
		bits = word;
	}
	for (int i = 0; i < iec_type_row(placed->type)->size; i++)
		placed->byte[i] = (uint8_t)(bits >> 8 * i);
}

static struct value read_literal(const struct placed *placed,
				 enum iec_type type)
{
	struct value value = { .type = placed->type };
	union iec_value literal = { 0 };

	if (value.type == IEC_NONE)
		value.type = type;
	literal_fit(&placed->literal, value.type, &literal);
	if (value.type == IEC_REAL)
		value.r = (float)literal.r;
	else
		value.i = literal.i;
	return value;
}

struct value placed_read(const struct placed *placed, enum iec_type type)
{
	struct value value = { .type = type };

	switch (placed->kind) {
	case PLACED_VALUE:
		value = *placed->value;
		break;
	case PLACED_AREA:
		value = read_area(placed);
		break;
	case PLACED_LITERAL:
		value = read_literal(placed, type);
		break;
	case PLACED_NOWHERE:
		break;
	}
	return type == IEC_NONE ? value : value_widen(value, type);
}

void placed_write(const struct placed *placed, struct value value)
{
	value = value_widen(value, placed->type);
	if (placed->kind == PLACED_VALUE)
		*placed->value = value;
	else if (placed->kind == PLACED_AREA)
		write_area(placed, value);
}
