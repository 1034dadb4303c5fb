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

static struct value valued(enum iec_type type, union iec_value from)
{
	struct value value = { .type = type };

	if (type == IEC_REAL)
		value.r = (float)from.r;
	else if (type == IEC_LREAL)
		value.d = from.r;
	else
		value.i = from.i;
	return value;
}

/* The bytes between the quotes. */
static void take_text(struct value *value, const struct literal *literal)
{
	char bytes[IEC_STRING_MOST];
	int len = (int)literal_string(literal, bytes);

	value->len = len < value->room ? len : value->room;
	memcpy(value->text, bytes, (size_t)value->len);
}

static uint32_t count_of(const struct var *var)
{
	return var->array.count ? var->array.count : 1;
}

/* Element @number as its declaration has it. */
static struct value initial(const struct var *var, uint32_t number)
{
	if (var->has_init && !var->array.count)
		return valued(var->type, var->init);
	for (int i = 0; i < var->init_count; i++) {
		if (number < var->init_list[i].count)
			return valued(var->type, var->init_list[i].value);
		number -= var->init_list[i].count;
	}
	return (struct value){ .type = var->type };
}

static struct placed at_address(struct walker *walker, struct iec_addr addr,
				enum iec_type type)
{
	uint32_t bits = walker->areas.bytes[addr.area] * 8;

	return (struct placed){
		.kind = PLACED_AREA, .type = type,
		.byte = walker->area[addr.area] + addr.byte, .bit = addr.bit,
		.rest = (bits - addr.byte * 8 - addr.bit) / addr.bits,
	};
}

static struct block *new_block(struct walker *walker, enum word fb)
{
	struct block *block = arena_alloc(&walker->arena, sizeof(*block));
	const struct word_row *row = word_row(fb);

	if (!block)
		return NULL;
	block->fb = fb;
	for (int i = 0; i < row->pin_count && i < PINS_MAX; i++) {
		block->pin[i].type = row->pin[i].type;
		if (row->pin[i].type == IEC_REAL)
			block->pin[i].r = (float)row->pin[i].init.r;
		else
			block->pin[i].i = row->pin[i].init.i;
	}
	return block;
}

static struct value initial_text(struct walker *walker, const struct var *var)
{
	const char *text = project_text(walker->project, var->init_text);
	struct value value = { .type = IEC_STRING, .room = var->capacity };
	struct literal literal;

	if (value.room > (int)sizeof(value.text))
		value.room = sizeof(value.text);
	if (var->has_init &&
	    literal_parse(text, strlen(text), &literal) == LITERAL_OK)
		take_text(&value, &literal);
	return value;
}

static void fill(struct walker *walker, struct variable *variable)
{
	const struct var *var = variable->var;

	for (uint32_t i = 0; i < count_of(var); i++) {
		struct placed all, there;

		if (var->type == IEC_STRING)
			variable->value[i] = initial_text(walker, var);
		else
			variable->value[i] = initial(var, i);
		if (var->at.area == AREA_NONE || !var->has_init)
			continue;
		all = at_address(walker, var->at, var->type);
		all.count = count_of(var);
		if (placed_element(&all, i, &there))
			placed_write(&there, variable->value[i]);
	}
}

static bool declare_table(struct walker *walker, const struct pou *pou,
			  const struct var_table *table)
{
	for (int i = 0; i < table->count; i++) {
		const struct var *var = &table->var[i];
		struct variable *at =
			&walker->variable[walker->variable_count++];

		at->pou = pou;
		at->var = var;
		at->value = arena_alloc(&walker->arena, count_of(var) *
					sizeof(*at->value));
		if (!at->value)
			return false;
		if (var->type == IEC_NONE) {
			at->block = new_block(walker, var->fb);
			if (!at->block)
				return false;
		} else {
			fill(walker, at);
		}
	}
	return true;
}

static struct placed of_variable(struct walker *walker,
				 struct variable *variable)
{
	const struct var *var = variable->var;
	struct placed placed = { .kind = PLACED_VALUE, .type = var->type,
				 .value = variable->value };

	if (variable->block)
		return (struct placed){ .kind = PLACED_NOWHERE };
	if (var->at.area != AREA_NONE)
		placed = at_address(walker, var->at, var->type);
	placed.count = var->array.count;
	placed.low = var->array.low;
	return placed;
}

static void show_elements(struct walker *walker, struct variable *variable)
{
	struct placed all = of_variable(walker, variable);
	const char *pou = variable->pou ? project_text(walker->project,
					variable->pou->name) : "";

	for (uint32_t i = 0; i < all.count; i++) {
		struct shown *out = &walker->shown[walker->shown_count++];

		snprintf(out->name, sizeof(out->name), "%s%s%s[%d]", pou,
			 *pou ? "." : "",
			 project_text(walker->project, variable->var->name),
			 (int)(all.low + (int64_t)i));
		placed_element(&all, all.low + (int64_t)i, &out->placed);
	}
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
	size_t count = 1;

	for (int i = 0; i < walker->variable_count; i++)
		count += PINS_MAX + walker->variable[i].var->array.count;
	walker->shown = arena_alloc(&walker->arena,
				    count * sizeof(*walker->shown));
	if (!walker->shown)
		return false;
	for (int i = 0; i < walker->variable_count; i++) {
		struct variable *at = &walker->variable[i];
		const struct word_row *row =
			at->block ? word_row(at->block->fb) : NULL;

		if (at->var->array.count)
			show_elements(walker, at);
		else if (!row)
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
	if (!project_areas(project, &walker->areas))
		return false;
	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++) {
		walker->area[i] = arena_alloc(&walker->arena,
			walker->areas.bytes[i] + 8);
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

/* `Table[i]`: whatever stands before the brackets, and its index. */
static struct placed of_element(struct walker *walker, const struct pou *pou,
				const char *text, size_t len)
{
	const char *open = memchr(text, '[', len);
	struct placed array = walker_place(walker, pou, text,
					   (size_t)(open - text));
	struct placed none = { .kind = PLACED_NOWHERE }, index, out;
	const char *at = open + 1, *end = text + len - 1;

	while (*at == ' ')
		at++;
	while (end > at && end[-1] == ' ')
		end--;
	index = walker_place(walker, pou, at, (size_t)(end - at));
	if (index.kind == PLACED_NOWHERE || array.kind == PLACED_NOWHERE)
		return none;
	if (!array.count)
		array.count = array.rest;
	if (index.kind == PLACED_LITERAL)
		return placed_element(&array, placed_read(&index, IEC_LINT).i,
				      &out) ? out : none;
	array.index = arena_alloc(&walker->arena, sizeof(index));
	if (!array.index)
		return none;
	*array.index = index;
	return array;
}

struct placed walker_place(struct walker *walker, const struct pou *pou,
			   const char *text, size_t len)
{
	struct variable *variable = find(walker, pou, text, len);
	struct placed placed;
	struct iec_addr addr;

	if (len && text[len - 1] == ']')
		return of_element(walker, pou, text, len);
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
	} else if (iec_addr_parse(text, len, &addr) == ADDR_OK &&
		   areas_have(&walker->areas, addr)) {
		return at_address(walker, addr, iec_addr_type(addr));
	}
	return placed;
}

bool placed_element(const struct placed *array, int64_t index, struct placed *out)
{
	uint32_t number = (uint32_t)(index - array->low);
	uint32_t bit = array->bit + number;

	*out = *array;
	out->count = 0;
	out->index = NULL;
	if (index < array->low || index - array->low >= array->count)
		return false;
	if (array->kind == PLACED_VALUE)
		out->value += number;
	else if (array->type != IEC_BOOL)
		out->byte += number * iec_type_row(array->type)->size;
	else {
		out->byte += bit / 8;
		out->bit = bit % 8;
	}
	return true;
}

bool placed_find(struct walker *walker, const struct placed *placed,
		 struct placed *out)
{
	struct value index;

	*out = *placed;
	if (!placed->index)
		return true;
	index = placed_read(placed->index, IEC_NONE);
	if (placed_element(placed, index.i, out))
		return true;
	walker->errors++;
	return false;
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
	if (placed->type == IEC_LREAL)
		memcpy(&value.d, &bits, sizeof(bits));
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
	if (placed->type == IEC_LREAL)
		memcpy(&bits, &value.d, sizeof(bits));
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
	if (value.type == IEC_STRING) {
		value.room = sizeof(value.text);
		take_text(&value, &placed->literal);
		return value;
	}
	literal_fit(&placed->literal, value.type, &literal);
	if (value.type == IEC_REAL)
		value.r = (float)literal.r;
	else if (value.type == IEC_LREAL)
		value.d = literal.r;
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
	if (value.type == IEC_STRING && placed->kind == PLACED_VALUE) {
		value.room = placed->value->room;
		if (value.len > value.room)
			value.len = value.room;
	}
	if (placed->kind == PLACED_VALUE)
		*placed->value = value;
	else if (placed->kind == PLACED_AREA)
		write_area(placed, value);
}
