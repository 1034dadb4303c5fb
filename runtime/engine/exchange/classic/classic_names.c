/* SPDX-License-Identifier: MIT
 *
 * classic_names - names of variables, blocks and steps in the rung file.
 *
 * A symbol becomes the name if it can; without one, %B3 is Bit3. Names of blocks and steps
 * begin with the old name (TM0, X3): trial/classic_name.c finds pins by it. Inputs and
 * outputs without a symbol stay addresses.
 */
#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"
#include "engine/check/reserved.h"
#include "engine/exchange/classic/classic_convert.h"
#include "engine/exchange/foreign_text.h"

#include <stdlib.h>
#include <string.h>

struct step_row { int type; const char *name, *pin; };

static const struct step_row step_rows[] = {
#define CLASSIC_STEP(type, attribute, name, pin) { type, name, pin },
#include "engine/classic.def"
};

enum { STEP_ROWS = sizeof(step_rows) / sizeof(*step_rows) };

struct classic_uses {
	/* Of each row: memory, then blocks, then bits and times of steps.     */
	bool seen[CLASSIC_MEMORY_ROWS + CLASSIC_KINDS + 2][CLASSIC_ALL + 1];
	int most[CLASSIC_MEMORY_ROWS];
	bool step[CLASSIC_LIMIT];
	bool jumped_to[CLASSIC_LIMIT];
	unsigned char blocks[CLASSIC_KINDS][CLASSIC_LIMIT]; /* 2: and more */
};

static int memory_place(const struct classic_memory_row *row)
{
	return (int)(row - classic_memory_rows);
}

/* %S, %E and %SW share the system area, whose size is fixed. */
int memory_numbers(const struct classic_memory_row *row)
{
	switch (row->type) {
	case 70:
	case 75:
		return 256;
	case 290:
		return 16;
	}
	return row->size == 1 || row->type == 200 ? CLASSIC_LIMIT : LIMIT_AREA * 8 / row->size;
}

/* True for memory of 32 bits. */
static bool is_word(int type)
{
	const struct classic_memory_row *row = classic_memory_of(type);

	return row && row->size > 1;
}

/* In the list of names the type of its first pin stands for a block. */
static int block_type(enum classic_kind kind)
{
	for (int i = 0; i < CLASSIC_PIN_ROWS; i++)
		if (classic_pin_rows[i].kind == kind)
			return classic_pin_rows[i].type;
	return -1;
}

/* ---- symbols ---- */

/* Type and number of the variable of a symbol. false: it is none, or a pin. */
static bool parse_symbol(const char *text, int *type, int *number)
{
	size_t len = 0;
	char *end;

	if (*text == '%')
		text++;
	while (text[len] >= 'A' && text[len] <= 'Z')
		len++;
	*type = -1;
	*number = (int)strtol(text + len, &end, 10);
	if (end == text + len || *number < 0 || *number > CLASSIC_LIMIT)
		return false;
	for (int i = 0; i < CLASSIC_MEMORY_ROWS; i++)
		if (strlen(classic_memory_rows[i].prefix) == len &&
		    !strncmp(classic_memory_rows[i].prefix, text, len)) {
			*type = classic_memory_rows[i].type;
			return *end == '\0';
		}
	for (int i = 0; i < CLASSIC_PIN_ROWS; i++)
		if (strlen(classic_pin_rows[i].prefix) == len &&
		    !strncmp(classic_pin_rows[i].prefix, text, len)) {
			*type = block_type(classic_pin_rows[i].kind);
			return *end == '\0';
		}
	if (len != 1 || *text != 'X')
		return false;
	*type = !*end || !strcmp(end, ".A") ? STEP_TYPE : STEP_TIME;
	return *type == STEP_TYPE;
}

/* A symbol and the variable it names. */
struct known_symbol { int type, number, index; };

static int by_what(const void *a, const void *b)
{
	const struct known_symbol *x = a, *y = b;
	const int type = classic_by_number(&x->type, &y->type);
	const int number = classic_by_number(&x->number, &y->number);

	return type ? type : number ? number : classic_by_number(&x->index, &y->index);
}

/* ---- lookup ---- */

static int by_type(const void *a, const void *b)
{
	const struct classic_name *x = a, *y = b;
	const int type = classic_by_number(&x->type, &y->type);

	return type ? type : classic_by_number(&x->number, &y->number);
}

struct classic_name *used_name(const struct conversion *c, int type, int number)
{
	struct classic_name key = { .type = type, .number = number };

	return c->names.count ? bsearch(&key, c->names.list, (size_t)c->names.count,
					sizeof(key), by_type) : NULL;
}

/* LinuxCNC gives every variable a symbol that is its own name: _B4_ of %B4, %B4 or B4. */
bool symbol_is_none(const struct classic_symbol *symbol)
{
	const char *name = symbol->name, *variable = symbol->variable;
	const bool line = *name == '_';
	size_t len;

	name += line || *name == '%';
	variable += *variable == '%';
	len = strlen(variable);
	return !*symbol->name || (!strncmp(name, variable, len) &&
				  (!name[len] || (line && !strcmp(name + len, "_"))));
}

/* A symbol of a pin, or of nothing that ClassicLadder has. */
static void report_symbol(struct conversion *c, const struct classic_symbol *symbol, int type,
			  int number)
{
	c->at = symbol->place;
	if (symbol_is_none(symbol) || (type >= 0 && !used_name(c, type, number)))
		return;
	tell(c, REPORT_LOST, type >= 0 ?
	     REPORTED("symbol \"%s\" of %s: pins and times of steps have no names of their own") :
	     REPORTED("symbol \"%s\" of %s: there is no such variable"),
	     symbol->name, symbol->variable);
}

/* If one variable has several symbols, the first one counts. */
static void find_symbols(struct conversion *c)
{
	const struct classic_project *project = c->project;
	struct known_symbol *list = NULL, *added, what;
	int count = 0;

	for (int i = 0; i < project->symbols; i++) {
		what = (struct known_symbol){ -1, 0, i };
		if (!parse_symbol(project->symbol[i].variable, &what.type, &what.number)) {
			report_symbol(c, &project->symbol[i], what.type, what.number);
			continue;
		}
		added = arena_push(c->arena, &list, &count, sizeof(what));
		if (added)
			*added = what;
	}
	if (count)
		qsort(list, (size_t)count, sizeof(*list), by_what);
	for (int i = count - 1; i >= 0; i--) {
		struct classic_name *name = used_name(c, list[i].type, list[i].number);
		const struct classic_symbol *symbol = &project->symbol[list[i].index];

		if (!name)
			continue;
		if (name->symbol && !symbol_is_none(name->symbol) &&
		    strcmp(name->symbol->name, symbol->name)) {
			c->at = name->symbol->place;
			tell(c, REPORT_LOST, "symbol \"%s\" of %s is left out: \"%s\" names it",
			     name->symbol->name, name->symbol->variable, symbol->name);
		}
		name->symbol = symbol;
	}
}

static void tell_symbol(struct conversion *c, const struct classic_symbol *symbol,
			const char *name)
{
	c->at = symbol->place;
	if (strcmp(name, symbol->name))
		tell(c, REPORT_TAKEN, "symbol \"%s\" of %s becomes %s", symbol->name,
		     symbol->variable, name);
}

/* X3 is reserved for steps, which are found by that name. */
static bool looks_like_step(const char *name)
{
	return ascii_upper(name[0]) == 'X' && ascii_digit(name[1]);
}

/* Takes @name. false: it is taken, in any spelling. */
static bool claim(struct conversion *c, const char *name)
{
	int before = c->taken.count;
	uint32_t id = names_intern(&c->taken, name, strlen(name));

	return !id || (c->taken.count > before && names_fold(&c->taken, id) == id);
}

/* The number to try next behind @base. */
static int number_behind(struct conversion *c, const char *base)
{
	uint32_t id = names_find_any(&c->taken, base, strlen(base));

	while (c->tried_count <= (int)id)
		if (!arena_push(c->arena, &c->tried, &c->tried_count, sizeof(*c->tried)))
			return 0;
	return ++c->tried[id] + 1;
}

const char *name_new(struct conversion *c, const char *wish)
{
	const char *base = foreign_name(c->arena, wish, LIMIT_NAME - 8), *name = base;

	if (reserved_fault(base) != DIAG_COUNT)
		base = name = text_of(c, "%s_", base);
	if (reserved_fault(base) != DIAG_COUNT) /* SYS_… */
		base = name = text_of(c, "N%s", base);
	while (!claim(c, name) && !c->arena->failed)
		name = text_of(c, "%s_%d", base, number_behind(c, base));
	return name;
}

static void give_name(struct conversion *c, struct classic_name *name)
{
	const struct classic_symbol *symbol = name->symbol;
	const struct classic_memory_row *memory = classic_memory_of(name->type);
	const struct classic_pin_row *pin = classic_pin_of(name->type);
	const char *own = pin ? classic_kind_names[pin->kind] :
			  memory ? memory->name : "X";
	const char *wish;

	if (symbol)
		name->comment = symbol->comment;
	if (symbol && symbol_is_none(symbol))
		symbol = NULL;
	if (!memory && !pin && name->type != STEP_TYPE)
		return; /* the time of a step has an instance of its own */
	if (name->number == CLASSIC_ALL)
		wish = text_of(c, "%ss", own);
	else if (memory && symbol)
		wish = looks_like_step(symbol->name) ? text_of(c, "N%s", symbol->name) :
						       symbol->name;
	else if (memory && !own) {
		if (*name->comment) {
			c->at = name->symbol->place;
			tell(c, REPORT_LOST, "comment \"%s\" of %s is left out: it has no symbol",
			     name->comment, name->symbol->variable);
		}
		return; /* %IX0.3 */
	}
	else if (symbol)
		wish = text_of(c, "%s%d_%s", own, name->number, symbol->name);
	else
		wish = text_of(c, "%s%d", own, name->number);
	name->name = name_new(c, wish);
	if (symbol)
		tell_symbol(c, symbol, name->name);
}

/* Names of steps, their actions, and the blocks that have their seconds. */
static void reserve_steps(struct conversion *c)
{
	static const char *const prefix[] = { "Step", "Seconds", "XTime", "Tell", "Anew" };

	for (int i = 0; i < c->project->steps; i++)
		for (size_t k = 0; k < sizeof(prefix) / sizeof(*prefix); k++)
			claim(c, text_of(c, "%s%d", prefix[k], c->project->step[i].number));
}

void find_names(struct conversion *c)
{
	names_init(&c->taken, c->arena);
	reserve_steps(c);
	find_symbols(c);
	/* Blocks and steps first: they are found by their names. */
	for (int i = 0; i < c->names.count; i++)
		if (!classic_memory_of(c->names.list[i].type))
			give_name(c, &c->names.list[i]);
	for (int i = 0; i < c->names.count; i++)
		if (classic_memory_of(c->names.list[i].type))
			give_name(c, &c->names.list[i]);
}

/* ---- operands ---- */

const char *name_of(const struct conversion *c, int type, int number)
{
	const struct classic_name *name = used_name(c, type, number);

	return name ? name->name : NULL;
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

/* True if a step has this number. */
static bool has_step(const struct conversion *c, int number)
{
	return number >= 0 && number < CLASSIC_LIMIT && c->uses->step[number];
}

static const char *plain_operand(struct conversion *c, int type, int number,
				 bool *is_bool)
{
	const struct classic_memory_row *memory = classic_memory_of(type);
	const struct classic_pin_row *pin = classic_pin_of(type);
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
	if (!memory || number >= memory_numbers(memory))
		return NULL;
	name = name_of(c, type, number);
	return name ? name : address_of(c, memory, number);
}

static const char *indexed(struct conversion *c, const struct classic_memory_row *memory,
			   int number, const char *index)
{
	if (number >= memory_numbers(memory))
		return NULL;
	if (memory->size == 1)
		return text_of(c, "%s[%s]", address_of(c, memory, number), index);
	if (!number)
		return text_of(c, "%s[%s]", name_of(c, memory->type, CLASSIC_ALL), index);
	return text_of(c, "%s[%s + %d]", name_of(c, memory->type, CLASSIC_ALL), index, number);
}

/* Type 300 of LinuxCNC is %IF. */
static int known_type(const struct conversion *c, int type)
{
	if (c->project->dialect == CLASSIC_LINUXCNC && type == LINUXCNC_IN)
		return LINUXCNC_INPUT;
	return type;
}

const char *operand_of(struct conversion *c, struct classic_variable variable,
		       bool *is_bool)
{
	int type = known_type(c, variable.type);
	const struct classic_memory_row *memory = classic_memory_of(type);
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
		tell(c, REPORT_LOST, variable.index_type < 0 ?
		     REPORTED("variable of type %d, number %d, is not supported") :
		     REPORTED("variable of type %d, number %d, with an index, is not supported"),
		     variable.type, variable.number);
	return text;
}

/* Types that a program of ClassicLadder may write. */
static bool is_writable(int type)
{
	static const int row[] = { 0, 60, 65, 70, 75, 200, 230, 231, 240, 250, 251, 260,
				   280, 290, 300, 310 };

	for (size_t i = 0; i < sizeof(row) / sizeof(*row); i++)
		if (row[i] == type)
			return true;
	return false;
}

const char *target_of(struct conversion *c, struct classic_variable variable, bool *is_bool)
{
	const char *text = operand_of(c, variable, is_bool);

	if (!text || is_writable(known_type(c, variable.type)))
		return text;
	tell(c, REPORT_LOST, "%s cannot be written by a program; the write was left out", text);
	return NULL;
}

/* Adds a variable to the list of names once. @place: its row of uses->seen. */
static void add_once(struct conversion *c, int place, int type, int number)
{
	struct classic_name *name;

	if (c->uses->seen[place][number])
		return;
	c->uses->seen[place][number] = true;
	name = arena_push(c->arena, &c->names.list, &c->names.count, sizeof(*name));
	if (name)
		*name = (struct classic_name){ .type = type, .number = number,
					       .comment = "" };
}

static void use(struct conversion *c, int type, int number)
{
	const struct classic_memory_row *memory;
	const struct classic_pin_row *pin;

	type = known_type(c, type);
	memory = classic_memory_of(type);
	pin = classic_pin_of(type);
	if (number < 0 || number > CLASSIC_ALL || (memory && number < CLASSIC_ALL &&
						   number >= memory_numbers(memory)))
		return;
	if (memory)
		add_once(c, memory_place(memory), type, number);
	else if (pin)
		add_once(c, CLASSIC_MEMORY_ROWS + (int)pin->kind, block_type(pin->kind), number);
	else if (type == STEP_TYPE)
		add_once(c, CLASSIC_MEMORY_ROWS + CLASSIC_KINDS, type, number);
	else if (type == STEP_TIME && has_step(c, number))
		add_once(c, CLASSIC_MEMORY_ROWS + CLASSIC_KINDS + 1, type, number);
}

/* Notes how far the area of a variable must reach. */
static void use_place(struct conversion *c, int type, int number)
{
	const struct classic_memory_row *memory = classic_memory_of(type);
	int *most;

	if (!memory || number < 0 || number >= memory_numbers(memory))
		return;
	most = &c->uses->most[memory_place(memory)];
	if (number >= *most)
		*most = number + 1;
}

static void use_variable(void *context, struct classic_variable variable)
{
	struct conversion *c = context;
	int type = known_type(c, variable.type);

	use_place(c, type, variable.number);
	if (variable.index_type < 0) {
		use(c, type, variable.number);
		return;
	}
	use_place(c, known_type(c, variable.index_type), variable.index_number);
	use(c, variable.index_type, variable.index_number);
	/* A word with an index is an element of an array, a bit an address with an index. */
	if (is_word(type))
		use(c, type, CLASSIC_ALL);
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

static void count_block(struct conversion *c, enum classic_kind kind, int number)
{
	if (number < CLASSIC_LIMIT && c->uses->blocks[kind][number] < 2)
		c->uses->blocks[kind][number]++;
}

static void use_cell(struct conversion *c, const struct classic_cell *cell)
{
	enum classic_kind kind = kind_of_element(cell->element);
	const char *text;

	if (cell->element == 54 && cell->variable.number < CLASSIC_LIMIT)
		c->uses->jumped_to[cell->variable.number] = true;
	if (kind != CLASSIC_KINDS) {
		use(c, block_type(kind), cell->variable.number);
		count_block(c, kind, cell->variable.number);
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

	for (int i = 0; i < project->steps; i++)
		c->uses->step[project->step[i].number] = true;
	for (int i = 0; i < project->rungs; i++)
		for (int y = 0; y < CLASSIC_ROWS; y++)
			for (int x = 0; x < CLASSIC_COLUMNS; x++)
				use_cell(c, &project->rung[i]->cell[y][x]);
	for (int i = 0; i < project->transitions; i++)
		use_variable(c, project->transition[i].condition);
	for (int i = 0; i < project->steps; i++)
		use(c, STEP_TYPE, project->step[i].number);
	/* A script for the original itself can name every block and step. */
	if (!c->options.task)
		use_more(c);
}

bool find_uses(struct conversion *c)
{
	c->uses = arena_alloc(c->arena, sizeof(*c->uses));
	if (!c->uses)
		return false;
	use_all(c);
	if (c->names.count)
		qsort(c->names.list, (size_t)c->names.count, sizeof(*c->names.list),
		      by_type);
	return true;
}

int used_numbers(const struct conversion *c, const struct classic_memory_row *memory)
{
	return c->uses->most[memory_place(memory)];
}

int block_cells(const struct conversion *c, enum classic_kind kind, int number)
{
	return c->uses->blocks[kind][number];
}

bool is_jumped_to(const struct conversion *c, int rung)
{
	return c->uses->jumped_to[rung];
}
