/* SPDX-License-Identifier: MIT
 *
 * classic_names - what the variables, blocks and steps of a project are called here.
 *
 * A symbol becomes the name where it can; else the number is part of it, so that %B3 is
 * Bit3. Blocks and steps begin with what they were called (TM0, X3), because the original
 * names of their pins are found by that. Inputs and outputs without a symbol stay
 * addresses.
 */
#include "engine/import/classic_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/check/reserved.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct step_row { int type; const char *name, *pin; };

static const struct classic_memory_row memory_rows[] = {
#define CLASSIC_MEMORY(type, prefix, area, first, size, name) \
	{ type, prefix, area, first, size, name },
#include "engine/import/classic.def"
};
static const struct classic_pin_row pin_rows[] = {
#define CLASSIC_PIN(type, prefix, attribute, kind, pin, is_bool) \
	{ type, prefix, kind, pin, is_bool },
#include "engine/import/classic.def"
};
static const struct step_row step_rows[] = {
#define CLASSIC_STEP(type, attribute, name, pin) { type, name, pin },
#include "engine/import/classic.def"
};

enum {
	MEMORY_ROWS = sizeof(memory_rows) / sizeof(*memory_rows),
	PIN_ROWS = sizeof(pin_rows) / sizeof(*pin_rows),
	STEP_ROWS = sizeof(step_rows) / sizeof(*step_rows),
	LINUXCNC_IN = 300, LINUXCNC_INPUT = 1300, /* classic.def */
};

/* The names of blocks; a monostable is not %M0 here, which is an address. */
static const char *const instance_prefix[CLASSIC_KINDS] = {
	[CLASSIC_TIMER] = "T", [CLASSIC_MONOSTABLE] = "Mono",
	[CLASSIC_IEC_TIMER] = "TM", [CLASSIC_COUNTER] = "C", [CLASSIC_REGISTER] = "Reg",
};

const struct classic_memory_row *memory_of(int type)
{
	for (int i = 0; i < MEMORY_ROWS; i++)
		if (memory_rows[i].type == type)
			return &memory_rows[i];
	return NULL;
}

static bool is_word(int type)
{
	const struct classic_memory_row *row = memory_of(type);

	return row && row->size > 1;
}

const struct classic_pin_row *pin_of(int type)
{
	for (int i = 0; i < PIN_ROWS; i++)
		if (pin_rows[i].type == type)
			return &pin_rows[i];
	return NULL;
}

enum classic_kind kind_of(int type)
{
	const struct classic_pin_row *row = pin_of(type);

	return row ? row->kind : CLASSIC_KINDS;
}

/* The type that stands for a block in the list of names: that of its first pin. */
static int block_type(enum classic_kind kind)
{
	for (int i = 0; i < PIN_ROWS; i++)
		if (pin_rows[i].kind == kind)
			return pin_rows[i].type;
	return -1;
}

/* ---- new names ---- */

static bool is_taken(const struct conversion *c, const char *name)
{
	size_t len = strlen(name);

	for (int i = 0; i < c->taken_count; i++)
		if (strlen(c->taken[i]) == len && ascii_same(c->taken[i], name, len))
			return true;
	return false;
}

static const char *take(struct conversion *c, const char *name)
{
	const char **slot = arena_push(c->arena, &c->taken, &c->taken_count,
				       sizeof(*slot));

	if (slot)
		*slot = name;
	return name;
}

/* Bytes of the character at @text if a name may hold it, else 0. */
static size_t name_char(const char *text, size_t len)
{
	size_t step = utf8_length(text, len);
	char upper = ascii_upper(*text);

	if (step > 1)
		return step;
	return (upper >= 'A' && upper <= 'Z') || ascii_digit(upper) || upper == '_';
}

/* Letters, digits and _ of @wish; anything else becomes _. */
static const char *as_name(struct conversion *c, const char *wish)
{
	size_t len = strlen(wish), at = 0, out = 0;
	char *name = arena_alloc(c->arena, len + 3);

	if (!name)
		return "_";
	if (len > LIMIT_NAME - 8)
		len = LIMIT_NAME - 8;
	if (!len || ascii_digit(wish[0]))
		name[out++] = 'N';
	while (at < len) {
		size_t step = name_char(wish + at, len - at);

		if (step)
			memcpy(name + out, wish + at, step);
		else
			name[out] = '_';
		out += step ? step : 1;
		at += step ? step : 1;
	}
	return name;
}

const char *name_new(struct conversion *c, const char *wish)
{
	const char *base = as_name(c, wish), *name = base;
	enum diag_id fault = reserved_fault(name);

	if (fault != DIAG_COUNT)
		base = name = text_of(c, "%s_", base);
	for (int i = 2; is_taken(c, name) && !c->arena->failed; i++)
		name = text_of(c, "%s_%d", base, i);
	return take(c, name);
}

/* ---- what is used ---- */

static struct classic_name *entry(struct conversion *c, int type, int number)
{
	struct classic_name *name;

	for (int i = 0; i < c->names.count; i++)
		if (c->names.list[i].type == type && c->names.list[i].number == number)
			return &c->names.list[i];
	name = arena_push(c->arena, &c->names.list, &c->names.count, sizeof(*name));
	if (name) {
		name->type = type;
		name->number = number;
		name->comment = "";
	}
	return name;
}

/* A register of LinuxCNC's has another meaning: its numbers with a point. */
static int known_type(const struct conversion *c, int type)
{
	if (c->project->dialect == CLASSIC_LINUXCNC && type == LINUXCNC_IN)
		return LINUXCNC_INPUT;
	return type;
}

static bool has_step(const struct conversion *c, int number)
{
	for (int i = 0; i < c->project->steps; i++)
		if (c->project->step[i].number == number)
			return true;
	return false;
}

static void use(struct conversion *c, int type, int number)
{
	const struct classic_pin_row *pin;
	struct classic_name *name;

	type = known_type(c, type);
	pin = pin_of(type);
	if (type < 0 || number < 0 || (type == STEP_TIME && !has_step(c, number)))
		return;
	name = entry(c, pin ? block_type(pin->kind) : type, number);
	if (name)
		name->used = true;
}

static void use_variable(void *context, struct classic_variable variable)
{
	struct conversion *c = context;

	if (variable.index_type < 0) {
		use(c, variable.type, variable.number);
		return;
	}
	use(c, variable.index_type, variable.index_number);
	/* Of words there is an array; a bit with an index is an address. */
	if (is_word(known_type(c, variable.type)))
		use(c, known_type(c, variable.type), CLASSIC_ALL);
}

static enum classic_kind kind_of_element(int element)
{
	switch (element) {
	case 10: return CLASSIC_TIMER;
	case 11: return CLASSIC_MONOSTABLE;
	case 12: return CLASSIC_COUNTER;
	case 13: return CLASSIC_IEC_TIMER;
	case 14: return CLASSIC_REGISTER;
	}
	return CLASSIC_KINDS;
}

static void use_cell(struct conversion *c, const struct classic_cell *cell)
{
	enum classic_kind kind = kind_of_element(cell->element);
	const char *text;

	if (kind != CLASSIC_KINDS) {
		use(c, block_type(kind), cell->variable.number);
	} else if (cell->element == 20 || cell->element == 60) {
		text = classic_expression(c->project, cell->variable.number);
		if (text)
			expression_uses(text, use_variable, c);
	} else if ((cell->element >= 1 && cell->element <= 4) ||
		   (cell->element >= 50 && cell->element <= 53)) {
		use_variable(c, cell->variable);
	}
}

static void use_blocks(struct conversion *c, const struct classic_blocks *blocks,
		       enum classic_kind kind)
{
	for (int i = 0; i < blocks->count; i++)
		use(c, block_type(kind), blocks->block[i].number);
}

static void use_more(struct conversion *c)
{
	const struct classic_project *project = c->project;

	for (int i = 0; i < project->steps; i++)
		use(c, STEP_TIME, project->step[i].number);
	use_blocks(c, &project->timer, CLASSIC_TIMER);
	use_blocks(c, &project->monostable, CLASSIC_MONOSTABLE);
	use_blocks(c, &project->counter, CLASSIC_COUNTER);
	use_blocks(c, &project->iec_timer, CLASSIC_IEC_TIMER);
	use_blocks(c, &project->reg, CLASSIC_REGISTER);
}

static void use_all(struct conversion *c)
{
	const struct classic_project *project = c->project;

	for (int i = 0; i < project->rungs; i++)
		for (int y = 0; y < CLASSIC_ROWS; y++)
			for (int x = 0; x < CLASSIC_COLUMNS; x++)
				use_cell(c, &project->rung[i]->cell[y][x]);
	for (int i = 0; i < project->transitions; i++)
		use_variable(c, project->transition[i].condition);
	for (int i = 0; i < project->steps; i++)
		use(c, STEP_TYPE, project->step[i].number);
	/* Whoever looks at the original itself may ask for anything that it has. */
	if (!c->options.task)
		use_more(c);
}

/* ---- symbols ---- */

/* "%TM0" and "%TM0.Q": type and number; false: it is none. */
static bool parse_symbol(const char *text, int *type, int *number)
{
	size_t len = 0;
	char *end;

	if (*text == '%')
		text++;
	while (text[len] >= 'A' && text[len] <= 'Z')
		len++;
	*number = (int)strtol(text + len, &end, 10);
	if (end == text + len || *number < 0 || *number > CLASSIC_LIMIT)
		return false;
	for (int i = 0; i < MEMORY_ROWS; i++)
		if (strlen(memory_rows[i].prefix) == len &&
		    !strncmp(memory_rows[i].prefix, text, len)) {
			*type = memory_rows[i].type;
			return *end == '\0';
		}
	for (int i = 0; i < PIN_ROWS; i++)
		if (strlen(pin_rows[i].prefix) == len &&
		    !strncmp(pin_rows[i].prefix, text, len)) {
			*type = block_type(pin_rows[i].kind);
			return *end == '\0';
		}
	*type = STEP_TYPE;
	return len == 1 && *text == 'X' && (!*end || !strcmp(end, ".A"));
}

static const struct classic_symbol *symbol_of(const struct conversion *c, int type,
					      int number)
{
	int of, index;

	for (int i = 0; i < c->project->symbols; i++)
		if (parse_symbol(c->project->symbol[i].variable, &of, &index) &&
		    of == type && index == number)
			return &c->project->symbol[i];
	return NULL;
}

static void tell_symbol(struct conversion *c, const struct classic_symbol *symbol,
			const char *name)
{
	c->at = symbol->place;
	if (strcmp(name, symbol->name))
		tell(c, REPORT_CHANGED, "symbol \"%s\" of %s is %s here", symbol->name,
		     symbol->variable, name);
}

/* LinuxCNC gives every variable a symbol, %B4 is _B4_: nobody chose it. */
static bool says_nothing(const struct classic_symbol *symbol)
{
	const char *name = symbol->name, *variable = symbol->variable;

	if (!*name)
		return true;
	if (*name++ != '_' || *variable++ != '%')
		return false;
	while (*variable && *name == *variable)
		name++, variable++;
	return !*variable && (!*name || !strcmp(name, "_"));
}

static void give_name(struct conversion *c, struct classic_name *name)
{
	const struct classic_symbol *symbol = symbol_of(c, name->type, name->number);
	const struct classic_memory_row *memory = memory_of(name->type);
	const struct classic_pin_row *pin = pin_of(name->type);
	const char *own = pin ? instance_prefix[pin->kind] :
			  memory ? memory->name : "X";
	const char *wish;

	if (symbol && says_nothing(symbol))
		symbol = NULL;
	if (symbol)
		name->comment = symbol->comment;
	if (!memory && !pin && name->type != STEP_TYPE)
		return; /* the time of a step has an instance of its own */
	if (name->number == CLASSIC_ALL)
		wish = text_of(c, "%ss", own);
	else if (memory && symbol)
		wish = symbol->name;
	else if (memory && !own)
		return; /* %IX0.3 */
	else if (symbol)
		wish = text_of(c, "%s%d_%s", own, name->number, symbol->name);
	else
		wish = text_of(c, "%s%d", own, name->number);
	name->name = name_new(c, wish);
	if (symbol)
		tell_symbol(c, symbol, name->name);
}

static int by_type(const void *a, const void *b)
{
	const struct classic_name *x = a, *y = b;

	return x->type != y->type ? (x->type < y->type ? -1 : 1) :
	       x->number < y->number ? -1 : x->number > y->number;
}

void find_names(struct conversion *c)
{
	use_all(c);
	if (c->names.count)
		qsort(c->names.list, (size_t)c->names.count, sizeof(*c->names.list),
		      by_type);
	for (int i = 0; i < c->names.count; i++)
		give_name(c, &c->names.list[i]);
}

/* ---- operands ---- */

const char *name_of(struct conversion *c, int type, int number)
{
	for (int i = 0; i < c->names.count; i++)
		if (c->names.list[i].type == type && c->names.list[i].number == number)
			return c->names.list[i].name;
	return NULL;
}

const char *instance_of(struct conversion *c, enum classic_kind kind, int number)
{
	return name_of(c, block_type(kind), number);
}

const char *step_of(struct conversion *c, int number)
{
	return name_of(c, STEP_TYPE, number);
}

/* "%IX0.3", "%VD4" */
const char *address_of(struct conversion *c, const struct classic_memory_row *row,
			      int number)
{
	long bit = row->first + (long)number * row->size;

	if (row->size == 1)
		return text_of(c, "%%%sX%ld.%ld", row->area, bit / 8, bit % 8);
	return text_of(c, "%%%sD%ld", row->area, bit / 8);
}

static const char *plain_operand(struct conversion *c, int type, int number,
				 bool *is_bool)
{
	const struct classic_memory_row *memory = memory_of(type);
	const struct classic_pin_row *pin = pin_of(type);
	const char *name;

	*is_bool = memory ? memory->size == 1 : pin ? pin->is_bool : type == STEP_TYPE;
	if (number < 0)
		return NULL;
	if (type == STEP_TIME && !has_step(c, number))
		return "0";
	if (pin) {
		name = instance_of(c, pin->kind, number);
		return name ? text_of(c, "%s.%s", name, pin->pin) : NULL;
	}
	for (int i = 0; i < STEP_ROWS; i++)
		if (step_rows[i].type == type) {
			name = type == STEP_TYPE ? step_of(c, number) :
				text_of(c, "%s%d", step_rows[i].name, number);
			return !name || !*step_rows[i].pin ? name :
			       text_of(c, "%s.%s", name, step_rows[i].pin);
		}
	if (!memory)
		return NULL;
	name = name_of(c, type, number);
	return name ? name : address_of(c, memory, number);
}

static const char *indexed(struct conversion *c, const struct classic_memory_row *memory,
			   int number, const char *index)
{
	if (memory->size == 1)
		return text_of(c, "%s[%s]", address_of(c, memory, number), index);
	if (!number)
		return text_of(c, "%s[%s]", name_of(c, memory->type, CLASSIC_ALL), index);
	return text_of(c, "%s[%s + %d]", name_of(c, memory->type, CLASSIC_ALL), index, number);
}

const char *operand_of(struct conversion *c, struct classic_variable variable,
		       bool *is_bool)
{
	int type = known_type(c, variable.type);
	const struct classic_memory_row *memory = memory_of(type);
	const char *text, *index;
	bool index_bool;

	*is_bool = true;
	if (variable.index_type < 0) {
		text = plain_operand(c, type, variable.number, is_bool);
	} else {
		index = plain_operand(c, known_type(c, variable.index_type),
				      variable.index_number, &index_bool);
		*is_bool = memory && memory->size == 1;
		text = memory && index && !index_bool ?
		       indexed(c, memory, variable.number, index) : NULL;
	}
	if (!text)
		tell(c, REPORT_LOST, "variable of type %d, number %d%s, has no meaning here",
		     variable.type, variable.number,
		     variable.index_type < 0 ? "" : ", with an index");
	return text;
}
