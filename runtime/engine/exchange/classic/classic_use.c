/* SPDX-License-Identifier: MIT
 *
 * classic_use - which variables, blocks and steps a project uses, and where it jumps: found
 * in one look at everything, for the parts of the conversion to ask.
 *
 * It gives no names, that is classic_names.c's.
 */
#include "engine/exchange/classic/classic_convert.h"

#include <stdlib.h>

struct classic_uses {
	/* Of each row: memory, then blocks, then bits and times of steps.     */
	bool seen[MEMORY_KINDS + CLASSIC_KINDS + 2][CLASSIC_ALL + 1];
	int most[MEMORY_KINDS];
	bool step[CLASSIC_LIMIT];
	bool jumped_to[CLASSIC_LIMIT];
	unsigned char blocks[CLASSIC_KINDS][CLASSIC_LIMIT]; /* 2: and more */
};

/* ---- what is used ---- */

static int by_type(const void *a, const void *b)
{
	const struct classic_name *x = a, *y = b;

	return x->type != y->type ? (x->type < y->type ? -1 : 1) :
	       x->number < y->number ? -1 : x->number > y->number;
}

/* A register of LinuxCNC's has another meaning: its numbers with a point. */
int known_type(const struct conversion *c, int type)
{
	if (c->project->dialect == CLASSIC_LINUXCNC && type == LINUXCNC_IN)
		return LINUXCNC_INPUT;
	return type;
}

bool has_step(const struct conversion *c, int number)
{
	return number >= 0 && number < CLASSIC_LIMIT && c->uses->step[number];
}

/* One of a kind of variables is enough: @place says which kind. */
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
	memory = memory_of(type);
	pin = pin_of(type);
	if (number < 0 || number > CLASSIC_ALL || (memory && number < CLASSIC_ALL &&
						   number >= memory_numbers(memory)))
		return;
	if (memory)
		add_once(c, memory_place(memory), type, number);
	else if (pin)
		add_once(c, MEMORY_KINDS + (int)pin->kind, block_type(pin->kind), number);
	else if (type == STEP_TYPE)
		add_once(c, MEMORY_KINDS + CLASSIC_KINDS, type, number);
	else if (type == STEP_TIME && has_step(c, number))
		add_once(c, MEMORY_KINDS + CLASSIC_KINDS + 1, type, number);
}

/* How far its area must reach. */
static void use_place(struct conversion *c, int type, int number)
{
	const struct classic_memory_row *memory = memory_of(type);
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
	/* Of words there is an array; a bit with an index is an address. */
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
	/* Whoever looks at the original itself may ask for anything that it has. */
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

/* ---- what others ask ---- */

struct classic_name *used_name(const struct conversion *c, int type, int number)
{
	struct classic_name key = { .type = type, .number = number };

	return c->names.count ? bsearch(&key, c->names.list, (size_t)c->names.count,
					sizeof(key), by_type) : NULL;
}

int used_numbers(const struct conversion *c, const struct classic_memory_row *memory)
{
	return c->uses->most[memory_place(memory)];
}

bool is_shared_block(const struct conversion *c, enum classic_kind kind, int number)
{
	return c->uses->blocks[kind][number] > 1;
}

bool is_jumped_to(const struct conversion *c, int rung)
{
	return c->uses->jumped_to[rung];
}
