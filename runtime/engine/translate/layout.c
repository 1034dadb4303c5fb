/* SPDX-License-Identifier: MIT
 *
 * layout - where every variable, bit, instance and constant lies.
 *
 * Retained values first, then bits of areas that live a byte each, BOOLs, numbers
 * by type, instances. A bit of an area lives a byte each unless some byte or word
 * access overlays it. Constants and scratch come last, as they are needed.
 */
#include "engine/model/located.h"
#include "engine/model/shape.h"
#include "engine/translate/assembler.h"

#include <string.h>

void words_push(struct assembler *as, struct words *words, uint32_t word)
{
	uint32_t *slot;

	if (words->count > 8 && words->count & (words->count - 1)) { /* arena_push() has room */
		words->word[words->count++] = word;
		return;
	}
	slot = arena_push(as->arena, &words->word, &words->count, sizeof(*slot));
	if (slot)
		*slot = word;
	else
		as->failed = true;
}

/* The row of a word of the catalogue or the project. */
static const struct word_row *layout_row(const struct assembler *as, enum word word)
{
	return words_row(&as->translation->project->words, word);
}

/* ---- runs ---- */

static bool layout_has_room(struct assembler *as, uint32_t offset, uint64_t size)
{
	if (size <= LIMIT_DATA && offset <= LIMIT_DATA - (uint32_t)size)
		return true;
	if (!as->failed) {
		const struct diag diag = { .id = DIAG_DATA_TOO_LARGE,
			.file = as->translation->project->file };

		diag_add(as->translation->diags, diag, "%u", (unsigned)LIMIT_DATA);
	}
	as->failed = true;
	return false;
}

/* @want: type and count, each of @size bytes. */
static uint32_t layout_place_at(struct assembler *as, struct code_run want,
				uint32_t offset, uint32_t size)
{
	struct code_run *last = as->run_count ?
		&as->run[as->run_count - 1] : NULL;

	if (!want.count)
		want.count = 1;
	if (!layout_has_room(as, offset, (uint64_t)want.count * size))
		return as->data_size - 1;
	as->data_size = offset + want.count * size;
	if (last && as->run_count > as->run_core && last->kind == want.kind &&
	    last->type == want.type && last->word == want.word &&
	    last->offset + last->count * size == offset) {
		last->count += want.count;
		return offset;
	}
	last = arena_push(as->arena, &as->run, &as->run_count, sizeof(*last));
	if (!last) {
		as->failed = true;
		return offset;
	}
	*last = want;
	last->offset = offset;
	return offset;
}

uint32_t layout_place(struct assembler *as, struct code_run want, uint32_t size,
		      uint32_t align)
{
	return layout_place_at(as, want,
			       (as->data_size + align - 1) / align * align, size);
}

static uint32_t place_run(struct assembler *as, struct code_run run, uint32_t capacity)
{
	const enum iec_type type = (enum iec_type)run.type;

	return layout_place(as, run, iec_type_size(type, capacity), iec_type_row(type)->size);
}

/* @capacity: of a STRING; all others have none. */
static uint32_t place_values(struct assembler *as, enum code_run_kind kind,
			     enum iec_type type, uint32_t capacity, uint32_t count)
{
	struct code_run run = {
		.kind = (uint8_t)kind, .type = (uint8_t)type, .count = count,
		.word = (uint16_t)(type == IEC_STRING ? capacity : 0),
	};

	return place_run(as, run, capacity);
}

static uint32_t place_pointers(struct assembler *as, uint32_t count)
{
	return place_run(as, (struct code_run){ .kind = RUN_VALUES, .type = IEC_LWORD,
						.word = RUN_POINTERS, .count = count }, 0);
}

static uint32_t place_value(struct assembler *as, enum code_run_kind kind,
			    enum iec_type type)
{
	return place_values(as, kind, type, IEC_STRING_MOST, 1);
}

/* @count of one word in a row, each aligned to @unit bytes. */
static void layout_instances(struct assembler *as, enum word word, uint32_t offset,
			     uint32_t count, uint32_t unit)
{
	const struct code_run run = { .kind = RUN_INSTANCE, .count = 1,
				      .word = (uint16_t)word };

	for (uint32_t i = 0; i < count && !as->failed; i++)
		layout_place_at(as, run, offset + i * unit, word_row(word)->size);
}

/* A structure or instance that is being placed, part by part. */
struct whole {
	const struct word_row *row;
	const struct var_table *vars;
	uint32_t base;
	int next;
	uint32_t element;   /* of the part at next                           */
};

static struct whole whole_of(const struct assembler *as, enum word word,
			     uint32_t base)
{
	return (struct whole){
		.row = layout_row(as, word), .base = base,
		.vars = shape_vars(as->translation->project, word),
	};
}

/* ---- variables ---- */

/* The literal that a text begins with; it was read before. */
static struct literal init_text(const struct assembler *as, const struct var *var)
{
	const struct names *names = &as->translation->project->names;
	struct literal literal;

	literal_parse(names_text(names, var_value_text(var)),
		      names_len(names, var_value_text(var)), &literal);
	return literal;
}

/* The initial value of a variable at an offset. */
static void layout_init_var(struct assembler *as, uint32_t offset, const struct var *var)
{
	uint32_t capacity = var->capacity ? var->capacity : IEC_STRING_MOST;
	struct pointing *pending;

	if (var->points) {
		pending = arena_push(as->arena, &as->pointing, &as->pointing_count, sizeof(*pending));
		as->failed |= !pending;
		if (pending)
			*pending = (struct pointing){ offset, var->points };
		return;
	}
	if (init_has_parts(var))
		layout_init_parts(as, offset, var);
	else if (var->array.count)
		layout_init_array(as, offset, var);
	else if (var->has_init && var->type == IEC_STRING)
		layout_init_text(as, offset, capacity, init_text(as, var));
	else if (var->has_init)
		layout_init(as, offset, var->type, var->init);
}

/* Instances of the catalogue. */
static void place_blocks(struct assembler *as, const struct word_pin *pin,
			 uint32_t offset, struct extent extent, bool init)
{
	uint32_t count = pin->elements ? pin->elements : 1;

	layout_instances(as, pin->word, offset, count, extent.unit);
	for (uint32_t i = 0; i < count && init && !as->failed; i++)
		layout_init_pins(as, offset + i * extent.unit, word_row(pin->word));
}

/* A part that is no structure, instance or array of the project. */
static void place_part(struct assembler *as, const struct whole *whole, int index,
		       bool place, bool init)
{
	const struct word_pin *pin = &whole->row->pin[index];
	struct extent extent = shape_of(&as->translation->project->words, pin);
	uint32_t offset = whole->base + pin->offset;
	struct code_run run = { .kind = RUN_VALUES, .type = (uint8_t)pin->type,
				.count = pin->elements };

	if (pin->type == IEC_STRING)
		run.word = pin->capacity;
	else if (whole->vars && index < whole->vars->count && whole->vars->var[index].target)
		run.word = RUN_POINTERS; /* behind the variables come temporaries */
	if (pin->type == IEC_NONE)
		place_blocks(as, pin, offset, extent, init);
	else if (place)
		layout_place_at(as, run, offset, extent.unit);
	if (init && pin->has_init)
		layout_init_var(as, offset, &whole->vars->var[index]);
}

/* After the last part: the initial values in the declaration of this member. */
static void end_part(struct assembler *as, const struct whole *outer)
{
	int index;
	const struct word_pin *pin;

	if (outer->element)
		return; /* of an array more elements come */
	index = outer->row->order[outer->next - 1];
	pin = &outer->row->pin[index];
	if (pin->has_init)
		layout_init_var(as, outer->base + pin->offset,
				&outer->vars->var[index]);
}

/* The next part of @top, one element at a time if it is an array of structures or instances of
 * the project; @offset: its place. */
static int next_part(const struct assembler *as, struct whole *top, uint32_t *offset)
{
	int index = top->row->order[top->next];
	const struct word_pin *pin = &top->row->pin[index];
	bool each = pin->type == IEC_NONE && word_is_own(pin->word);

	*offset = top->base + pin->offset;
	if (each)
		*offset += top->element++ * layout_row(as, pin->word)->size;
	if (!each || top->element >= pin->elements) {
		top->element = 0;
		top->next++;
	}
	return index;
}

/* All parts of what lies at @base, in the order of model/shape.h. @place: reserves runs for them. */
static void walk_whole(struct assembler *as, enum word word, uint32_t base, bool place, bool init)
{
	struct whole level[LIMIT_NESTING + 1];
	int depth = 0;

	level[0] = whole_of(as, word, base);
	while (depth >= 0 && !as->failed) {
		struct whole *top = &level[depth];
		const struct word_pin *pin;
		uint32_t offset;
		int index;

		if (top->next == top->row->ordered) {
			if (--depth >= 0 && init)
				end_part(as, &level[depth]);
			continue;
		}
		index = next_part(as, top, &offset);
		pin = &top->row->pin[index];
		if (pin->type == IEC_NONE && word_is_own(pin->word)) {
			level[++depth] = whole_of(as, pin->word, offset);
			continue;
		}
		place_part(as, top, index, place, init);
	}
}

/* Reserves runs for its parts. */
static uint32_t layout_whole(struct assembler *as, enum word word, bool init)
{
	uint32_t base = (as->data_size + 7) / 8 * 8;
	uint32_t size = layout_row(as, word)->size;

	if (!layout_has_room(as, base, size))
		return as->data_size - 1;
	walk_whole(as, word, base, true, init);
	as->data_size = base + size;
	return base;
}

/* An instance or structure, or an array of these; @init: with the initial values of their
 * types. */
static uint32_t place_whole(struct assembler *as, const struct var *var, bool init)
{
	struct extent extent = shape_of_var(&as->translation->project->words, var);
	uint32_t count = var->array.count ? var->array.count : 1;
	uint32_t first = (as->data_size + 7) / 8 * 8;

	if (!layout_has_room(as, first, extent.size))
		return as->data_size - 1;
	if (!word_is_own(var->fb)) {
		layout_instances(as, var->fb, first, count, extent.unit);
		for (uint32_t i = 0; i < count && !as->failed; i++)
			layout_init_pins(as, first + i * extent.unit,
					 word_row(var->fb));
		return first;
	}
	for (uint32_t i = 0; i < count && !as->failed; i++)
		layout_whole(as, var->fb, init);
	return first;
}

uint32_t layout_like(struct assembler *as, const struct meaning *m)
{
	struct var like = { .type = m->type, .fb = (enum word)m->word,
			    .array = m->array, .capacity = m->capacity };

	return m->type == IEC_NONE ? place_whole(as, &like, false) :
	       place_values(as, RUN_VALUES, m->type, m->capacity, m->array.count);
}

uint32_t layout_tail(struct assembler *as, enum code_run_kind kind,
		     enum iec_type type)
{
	return place_value(as, kind, type);
}

/* ---- tables ---- */

int layout_table(const struct assembler *as, const struct meaning *m)
{
	return m->pou ? (int)(m->pou - as->translation->project->pou) + 1 : 0;
}

const struct var_table *layout_vars(const struct assembler *as, int table)
{
	struct project *project = as->translation->project;

	return table ? &project->pou[table - 1].vars : &project->globals;
}

/* Declared variables, then temporaries. */
static int table_size(const struct assembler *as, int table)
{
	int temps = table ? as->translation->unit[table - 1].temp_count : 0;

	return layout_vars(as, table)->count + temps;
}

static const struct var *table_var(const struct assembler *as, int table,
				   int index)
{
	const struct var_table *vars = layout_vars(as, table);

	if (index < vars->count)
		return &vars->var[index];
	return as->translation->unit[table - 1].temp[index - vars->count];
}

static bool is_power(const struct assembler *as, const struct var *var)
{
	return is_temporary(names_text(&as->translation->project->names,
				       var->name), 'P');
}

/* ---- bits of areas ---- */

static void use_address(struct assembler *as, uint8_t *used,
			struct iec_addr addr)
{
	if (addr.area == AREA_NONE)
		return;
	if (addr.bits == 1)
		used[areas_byte(as->areas, addr)] |= (uint8_t)(1u << addr.bit);
	else
		memset(as->byte_packed + areas_byte(as->areas, addr), 1,
		       addr.bits / 8u);
}

/* Areas that an index may reach stay packed, bits too. */
static void use_addresses(struct assembler *as, struct iec_addr first,
			  uint32_t count)
{
	struct iec_addr last = vars_shift(first, count - 1);
	uint32_t begin = areas_byte(as->areas, first);
	uint32_t end = areas_byte(as->areas, last) + (last.bits + 7u) / 8;

	memset(as->byte_packed + begin, 1, end - begin);
}

static void use_meaning(struct assembler *as, uint8_t *used,
			const struct meaning *m)
{
	uint32_t count = meaning_reach(m).count;

	if (m->kind == MEANING_LITERAL || m->kind == MEANING_PIN)
		return;
	for (int i = 0; i < m->opens; i++)
		use_address(as, used, m->open[i].of->addr);
	if (m->addr.area != AREA_NONE && count)
		use_addresses(as, m->addr, count);
	else
		use_address(as, used, m->addr);
}

static void use_list(struct assembler *as, uint8_t *used, const struct pou *pou,
		     const struct il *il)
{
	enum diag_id why;

	for (int i = 0; i < il->count; i++) {
		const struct meaning *m;

		if (il->line[i].kind == IL_COMMENT ||
		    il->line[i].kind == IL_TARGET ||
		    il->line[i].kind == IL_LABEL || !il->line[i].operand)
			continue;
		m = scope_find(as->translation->scope, pou, il->line[i].operand,
			       &why);
		if (m)
			use_meaning(as, used, m);
	}
}

static void add_bit(struct assembler *as, int area, uint32_t bit, uint32_t slot)
{
	struct code_bits *last = as->bit_run_count ?
		&as->bit_run[as->bit_run_count - 1] : NULL;

	if (last && last->area == (uint32_t)area &&
	    last->first + last->count == bit && last->slot + last->count == slot) {
		last->count++;
		return;
	}
	last = arena_push(as->arena, &as->bit_run, &as->bit_run_count,
			  sizeof(*last));
	if (last)
		*last = (struct code_bits){ (uint32_t)area, bit, 1, slot };
	else
		as->failed = true;
}

/* The byte of one bit of an area; 0: it is packed. */
static uint32_t bit_slot(const struct assembler *as, struct iec_addr addr)
{
	return code_bits_find(as->bit_run, (uint32_t)as->bit_run_count, addr.area,
			      addr.byte * 8 + addr.bit);
}

static void place_byte(struct assembler *as, int area, uint32_t byte,
		       uint8_t used)
{
	for (uint32_t bit = 0; bit < 8; bit++)
		if (used >> bit & 1)
			add_bit(as, area, byte * 8 + bit,
				place_value(as, RUN_VALUES, IEC_BOOL));
}

static void use_located(struct assembler *as, uint8_t *used,
			const struct var *var)
{
	if (var->at.area != AREA_NONE && var->type == IEC_NONE) {
		memset(as->byte_packed + areas_byte(as->areas, var->at), 1,
		       shape_of_var(&as->translation->project->words, var).size);
		return;
	}
	if (var->at.area == AREA_NONE || var->at.bits == 1)
		return;
	if (var->array.count)
		use_addresses(as, var->at, var->array.count);
	else
		use_address(as, used, var->at);
}

static bool place_bits(struct assembler *as)
{
	struct translation *t = as->translation;
	const struct areas *areas = as->areas;
	uint8_t *used = arena_alloc(as->arena, areas->size);

	as->byte_packed = arena_alloc(as->arena, areas->size);
	if (!used || !as->byte_packed)
		return false;
	for (int table = 0; table <= t->unit_count; table++)
		for (int i = 0; i < layout_vars(as, table)->count; i++)
			use_located(as, used, table_var(as, table, i));
	for (int i = 0; i < t->unit_count; i++)
		use_list(as, used, t->unit[i].pou, &t->unit[i].il);
	for (int area = 1; area < AREA_COUNT; area++) {
		uint32_t at = areas->at[area];

		for (uint32_t byte = 0; byte < areas->bytes[area]; byte++)
			if (used[at + byte] && !as->byte_packed[at + byte])
				place_byte(as, area, byte, used[at + byte]);
	}
	return true;
}

/* A pin of this row as part of it. */
static bool is_part(const struct assembler *as, enum word word, int index)
{
	const struct word_row *row = layout_row(as, word);

	return word_is_own(word) && index < row->pin_count &&
	       row->pin[index].dir != PIN_NONE;
}

/* A block's edge memory lies in each instance, after the variables. */
static int edge_pin(const struct assembler *as, const struct pou *pou,
		    const struct var *var)
{
	const char *name = names_text(&as->translation->project->names, var->name);
	int number = 0;

	if (pou->kind != POU_BLOCK || !is_temporary(name, 'E'))
		return -1;
	for (name += 2; *name; name++)
		number = number * 10 + (*name - '0');
	return number <= pou->edges ? pou->vars.count + number - 1 : -1;
}

/* Does the variable lie in the frame of its POU, or among its VAR_TEMP? */
static bool is_framed(struct assembler *as, int table, int index)
{
	const struct pou *pou = table ? &as->translation->project->pou[table - 1]
				      : NULL;
	const struct frame *frame = pou ? &as->frame[table - 1] : NULL;
	uint32_t *offset = &as->offset[table][index];
	int pin = index;

	if (!pou)
		return false;
	if (index >= pou->vars.count)
		pin = edge_pin(as, pou, table_var(as, table, index));
	if (pin < 0)
		return false;
	if (is_part(as, pou->word, pin)) {
		*offset = frame->offset + layout_row(as, pou->word)->pin[pin].offset;
		return true;
	}
	if (pin != index || !is_part(as, pou->temp_word, pin))
		return false;
	*offset = frame->temps + layout_row(as, pou->temp_word)->pin[pin].offset;
	return true;
}

static void place_frame(struct assembler *as, int index)
{
	const struct pou *pou = &as->translation->project->pou[index];
	struct frame *frame = &as->frame[index];

	if (word_is_own(pou->word)) {
		frame->size = layout_row(as, pou->word)->size;
		frame->offset = layout_whole(as, pou->word, false);
		if (pou->kind == POU_FUNCTION)
			frame->model = layout_whole(as, pou->word, true);
	}
	if (word_is_own(pou->temp_word)) {
		frame->temps_size = layout_row(as, pou->temp_word)->size;
		frame->temps = layout_whole(as, pou->temp_word, false);
		frame->temps_model = layout_whole(as, pou->temp_word, true);
	}
}

/* An instance of a block with a RETAIN of its own is retained whole. */
static bool is_retained(const struct assembler *as, int table, int index)
{
	const struct var_table *vars = layout_vars(as, table);
	const struct var *var = table_var(as, table, index);

	if (index >= vars->count)
		return false;
	return vars_flags(vars, index) & VAR_RETAIN ||
	       (var->type == IEC_NONE && layout_row(as, var->fb)->retain);
}

static void place_var(struct assembler *as, int table, int index, bool retain)
{
	const struct var *var = table_var(as, table, index);
	bool declared = index < layout_vars(as, table)->count;
	bool constant = declared &&
		vars_flags(layout_vars(as, table), index) & VAR_CONSTANT;
	enum code_run_kind kind = constant ? RUN_CONSTANTS : RUN_VALUES;
	uint32_t *offset = &as->offset[table][index];
	uint32_t capacity = var->capacity ? var->capacity : IEC_STRING_MOST;
	const uint32_t count = var->array.count ? var->array.count : 1;

	if (is_framed(as, table, index) ||
	    is_retained(as, table, index) != retain)
		return;
	if (*offset || var->at.area != AREA_NONE)
		return;
	*offset = var->type == IEC_NONE ? place_whole(as, var, true) :
		  var->target && kind == RUN_VALUES ? place_pointers(as, count) :
		  place_values(as, kind, var->type, capacity, count);
	layout_init_var(as, *offset, var);
}

/* All variables of one type (IEC_NONE: instances) that have no place yet. */
static void place_type(struct assembler *as, enum iec_type type, bool retain)
{
	for (int table = 0; table <= as->translation->unit_count; table++)
		for (int i = 0; i < table_size(as, table); i++) {
			const struct var *var = table_var(as, table, i);
			bool temp = i >= layout_vars(as, table)->count;

			if (var->type == type && !(temp && is_power(as, var)))
				place_var(as, table, i, retain);
		}
}

/* The types that variables have, a bit each. */
static uint32_t types_in_use(const struct assembler *as)
{
	uint32_t types = 0;

	_Static_assert(IEC_TYPE_COUNT <= 32, "a bit for each type");
	for (int table = 0; table <= as->translation->unit_count; table++)
		for (int i = 0; i < table_size(as, table); i++)
			types |= 1u << table_var(as, table, i)->type;
	return types;
}

static void place_all(struct assembler *as, bool retain)
{
	uint32_t types = types_in_use(as);

	for (uint32_t type = IEC_BOOL; type < IEC_TYPE_COUNT; type++)
		if (types >> type & 1u)
			place_type(as, (enum iec_type)type, retain);
	place_type(as, IEC_NONE, retain);
}

/* An initial value in its area, or in the bit's own byte. */
static void init_in_area(struct assembler *as, uint8_t *area,
			 struct iec_addr addr, enum iec_type type,
			 union iec_value value)
{
	uint32_t at = areas_byte(as->areas, addr), slot;
	uint8_t bit = (uint8_t)(1u << addr.bit);

	if (addr.bits != 1) {
		iec_store(area + at, type, value);
		return;
	}
	slot = bit_slot(as, addr);
	if (slot)
		layout_init(as, slot, IEC_BOOL, value);
	else
		area[at] = (uint8_t)((area[at] & ~bit) | (value.i ? bit : 0));
}

static void init_var_in_area(struct assembler *as, uint8_t *area,
			     const struct var *var)
{
	uint32_t number = 0;

	if (!var->array.count)
		init_in_area(as, area, var->at, var->type, var->init);
	for (int i = 0; i < var->init_count; i++)
		for (uint32_t k = 0; k < var->init_list[i].count; k++)
			init_in_area(as, area, vars_shift(var->at, number++),
				     var->type, var->init_list[i].value);
}

/* A structure: a BOOL is the lowest bit of its byte. */
static void init_whole_in_area(struct assembler *as, const struct var *var)
{
	const uint32_t count = var->array.count ? var->array.count : 1;
	uint32_t at;

	if (var->at.area == AREA_NONE || var->type != IEC_NONE)
		return;
	at = areas_byte(as->areas, var->at);
	for (uint32_t i = 0; i < count; i++)
		walk_whole(as, var->fb, at + i * layout_row(as, var->fb)->size, false, true);
	layout_init_var(as, at, var);
}

/* Variables with AT may lie over each other: the later one wins, bit by bit. */
static bool init_located(struct assembler *as)
{
	uint8_t *area = arena_alloc(as->arena, as->areas->size);

	if (!area)
		return false;
	for (int table = 0; table <= as->translation->unit_count; table++)
		for (int i = 0; i < layout_vars(as, table)->count; i++) {
			const struct var *var = table_var(as, table, i);

			if (var->has_init && var->at.area != AREA_NONE && var->type != IEC_NONE)
				init_var_in_area(as, area, var);
		}
	for (uint32_t i = 0; i < as->areas->size; i++)
		if (area[i])
			layout_init(as, i, IEC_BYTE,
				    (union iec_value){ .i = area[i] });
	for (int table = 0; table <= as->translation->unit_count; table++)
		for (int i = 0; i < layout_vars(as, table)->count; i++)
			init_whole_in_area(as, table_var(as, table, i));
	return true;
}

/* Another value takes the place of each element, also a 0. */
static void init_over(struct assembler *as, uint32_t offset, const struct var *var)
{
	const uint32_t size = var->array.count && var->type != IEC_NONE ? iec_type_row(var->type)->size : 0;
	uint32_t at = 0;

	if (!size || var->type == IEC_STRING || init_has_parts(var)) {
		layout_init_var(as, offset, var);
		return;
	}
	for (int i = 0; i < var->init_count; i++)
		for (uint32_t k = 0; k < var->init_list[i].count; k++)
			layout_init_over(as, offset + size * at++, var->type, var->init_list[i].value);
	while (at < var->array.count)
		layout_init_over(as, offset + size * at++, var->type, (union iec_value){ .i = 0 });
}

/* The values that VAR_CONFIG gives to parts of variables, and to structures, blocks, arrays and texts. */
static void init_parts(struct assembler *as)
{
	struct project *project = as->translation->project;

	for (int i = 0; i < project->located.count; i++) {
		const struct var *line = &project->located.var[i];
		struct located to;
		const struct meaning *m = NULL;
		const char *name;
		enum diag_id why;

		if (!located_find(project, project_text(project, line->name), &to) ||
		    (to.part ? !line->has_init || line->inherits : !located_is_whole(line)))
			continue;
		if (to.instance && project_is_further(project, to.instance)) {
			name = project_text(project, to.instance->name);
			to.pou = project_find_pou(project, name, strlen(name));
		}
		if (to.pou >= 0)
			m = scope_find(as->translation->scope, &project->pou[to.pou],
				       scope_within(as->translation->scope, to.text), &why);
		if (m && to.part)
			layout_init_over(as, layout_spot(as, m).offset, m->type, line->init);
		else if (m && m->addr.area == AREA_NONE)
			init_over(as, layout_spot(as, m).offset, line);
	}
}

static bool make_tables(struct assembler *as)
{
	int tables = as->translation->unit_count + 1;

	as->offset = arena_alloc(as->arena, (size_t)tables * sizeof(uint32_t *));
	as->frame = arena_alloc(as->arena, (size_t)tables * sizeof(*as->frame));
	if (!as->offset || !as->frame)
		return false;
	for (int table = 0; table < tables; table++) {
		size_t size = (size_t)table_size(as, table) + 1;

		as->offset[table] = arena_alloc(as->arena,
						size * sizeof(uint32_t));
		if (!as->offset[table])
			return false;
	}
	return true;
}

/* Counts only pins of blocks of the catalogue, in programs: other pins exist in many
 * instances. */
static bool is_counted(const struct meaning *m)
{
	return m->var->type == IEC_NONE && !word_is_own(m->var->fb) &&
	       !m->var->array.count &&
	       (!m->pou || m->pou->kind == POU_PROGRAM);
}

/* ---- pins that always get the same constant ---- */

static uint8_t *pin_count(const struct assembler *as, const struct meaning *m)
{
	uint32_t first = as->first_pin[layout_table(as, m)][m->index];

	return &as->pin_writes[first + (uint32_t)m->pin];
}

/* A parameter of a call counts one, any other use two: then the call is not the only use. */
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
		if (m && m->part)
			m = m->number;
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

/* Counts the uses of every instance pin. */
static bool layout_count_pins(struct assembler *as)
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

bool layout_make(struct assembler *as)
{
	as->data_size = as->areas->size;
	place_value(as, RUN_CONSTANTS, IEC_BOOL); /* CODE_FALSE */
	place_value(as, RUN_CONSTANTS, IEC_BOOL); /* CODE_TRUE  */
	if (!make_tables(as))
		return false;
	as->data_size = (as->data_size + 7) / 8 * 8;
	as->retain_offset = as->data_size;
	place_all(as, true);
	as->retain_size = as->data_size - as->retain_offset;
	if (!place_bits(as))
		return false;
	for (int i = 0; i < as->translation->unit_count; i++)
		place_frame(as, i);
	place_all(as, false);
	if (!init_located(as))
		return false;
	init_parts(as);
	return layout_count_pins(as) && !as->failed;
}

void layout_core(struct assembler *as)
{
	as->run_core = as->run_count;
}

/* Of the cells of one table's POU. */
static bool layout_place_powers(struct assembler *as, int table)
{
	int count = table_size(as, table);

	for (int i = layout_vars(as, table)->count; i < count; i++)
		if (is_power(as, table_var(as, table, i)))
			place_var(as, table, i, false);
	return !as->failed;
}

/* The value of ADR: the place, its bytes, and a position in it (code.h). */
static union iec_value address_of(struct assembler *as, const struct pou *pou, uint32_t text)
{
	struct scope *scope = as->translation->scope;
	enum diag_id why;
	const struct meaning *of = scope_find(scope, pou, text, &why);
	union iec_value value = { .i = 0 };

	if (!of)
		return value;
	/* A pointer has more bytes than SIZEOF tells. */
	const uint32_t bytes = of->type == IEC_LWORD ? scope_size(scope, of) : scope_bytes(scope, of);

	value.i = (int64_t)((uint64_t)layout_spot(as, of).offset << CODE_POINTER_PLACE |
			    (uint64_t)(bytes < CODE_POINTER_MOST ? bytes : CODE_POINTER_MOST)
				    << CODE_POINTER_BYTES);
	return value;
}

bool layout_pointers(struct assembler *as)
{
	const struct project *project = as->translation->project;
	enum diag_id why;

	for (int i = 0; i < as->pointing_count; i++) {
		const struct var_points *points = as->pointing[i].points;
		const struct pou *pou = points->pou < 0 ? NULL : &project->pou[points->pou];
		const struct meaning *m = scope_find(as->translation->scope, pou, points->text, &why);

		if (m)
			layout_init(as, as->pointing[i].offset, IEC_LWORD,
				    address_of(as, pou, m->address_of));
	}
	return !as->failed;
}

struct spot layout_spot(struct assembler *as, const struct meaning *m)
{
	struct spot spot = { .type = m->type };

	if (m->address_of) {
		spot.offset = layout_constant(as, IEC_LWORD, address_of(as, m->pou, m->address_of));
		return spot;
	}
	if (m->addr.area == AREA_NONE) {
		spot.offset = as->offset[layout_table(as, m)][m->index] +
			      m->offset;
	} else if (m->addr.bits != 1) {
		spot.offset = areas_byte(as->areas, m->addr);
	} else {
		spot.offset = bit_slot(as, m->addr);
		if (!spot.offset) {
			spot.packed = true;
			spot.offset = areas_byte(as->areas, m->addr);
			spot.bit = m->addr.bit;
		}
	}
	return spot;
}

bool layout_only_stored(const struct assembler *as, const struct meaning *pin)
{
	const struct var_table *vars = layout_vars(as, layout_table(as, pin));
	struct meaning calls = calls_of(as, pin);

	/* After a change of the program, retained pins keep their old values: each call must
	 * store its constant again. */
	if (!is_counted(pin) || vars_flags(vars, pin->index) & VAR_RETAIN)
		return false;
	return *pin_count(as, pin) == 1 && *pin_count(as, &calls) == 1;
}

/* The unit whose cells an instance has; -1: a block of the catalogue, or a structure. */
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

/* First a byte for each line, so that one BLOCK clears all of them. */
static void place_results(struct assembler *as, struct result *result, int count, bool always)
{
	for (int i = 0; i < count; i++)
		result[i].ran = always ? CODE_TRUE_AT(as->areas) :
				layout_tail(as, RUN_VALUES, IEC_BOOL);
	for (int i = 0; i < count; i++)
		if (result[i].kept)
			result[i].at = result[i - 1].at;
		else if (result[i].type != IEC_NONE)
			result[i].at = place_values(as, RUN_VALUES, result[i].type,
						    RESULT_TEXT, 1);
}

static void place_lists(struct assembler *as, struct frame *frame)
{
	place_results(as, frame->result, frame->result_count, false);
	place_results(as, frame->listed, frame->listed_count, frame->always);
}

/* A copy of what a block keeps; the same types at the same distances. */
static uint32_t place_like(struct assembler *as, const struct frame *frame)
{
	const uint32_t from = frame->power, end = from + frame->power_size;
	const uint32_t to = as->data_size;

	for (int i = frame->power_run; i < as->run_count && !as->failed && as->run[i].offset < end;
	     i++) {
		struct code_run run = as->run[i];
		const uint32_t unit = code_run_size(&run);
		const uint32_t first = run.offset < from ? from : run.offset;
		const uint32_t behind = run.offset + run.count * unit;

		run.count = ((behind > end ? end : behind) - first) / unit;
		if (behind > from)
			layout_place_at(as, run, to + (first - from), unit);
	}
	as->data_size = to + frame->power_size;
	return to;
}

/* The runs lie where an 8 byte value may: copies have the same gaps. */
static void align_power(struct assembler *as)
{
	as->data_size = (as->data_size + 7) / 8 * 8;
}

/* Of all instances of one variable. */
static uint32_t place_kept(struct assembler *as, const struct var_table *vars, int index)
{
	const int unit = unit_of(as, vars, index);
	uint32_t count = vars->var[index].array.count, first = 0;

	if (unit < 0 || !as->frame[unit].power_size)
		return 0;
	align_power(as);
	first = as->data_size;
	for (count = count ? count : 1; count > 0 && !as->failed; count--)
		place_like(as, &as->frame[unit]);
	return first;
}

static bool place_table(struct assembler *as, int table)
{
	const struct var_table *vars = layout_vars(as, table);

	as->power[table] = arena_alloc(as->arena, ((size_t)vars->count + 1) *
				       sizeof(uint32_t));
	if (!as->power[table] || !layout_place_powers(as, table))
		return false;
	if (table > 0)
		place_lists(as, &as->frame[table - 1]);
	for (int i = 0; i < vars->count && !as->failed; i++)
		as->power[table][i] = place_kept(as, vars, i);
	return !as->failed;
}

static bool place_block(struct assembler *as, int unit)
{
	struct frame *frame = &as->frame[unit];

	align_power(as);
	frame->power = as->data_size;
	frame->power_run = as->run_count; /* or the one before, which may go on */
	if (frame->power_run > as->run_core)
		frame->power_run--;
	if (!place_table(as, unit + 1))
		return false;
	if (as->data_size > frame->power)
		align_power(as);
	frame->power_size = as->data_size - frame->power;
	return true;
}

/* Inner blocks have less depth: they are placed before those that hold them. */
static bool place_depth(struct assembler *as, int depth)
{
	for (int i = 0; i < as->translation->unit_count; i++) {
		const struct pou *pou = as->translation->unit[i].pou;

		if (pou->kind == POU_BLOCK && layout_row(as, pou->word)->depth == depth &&
		    !place_block(as, i))
			return false;
	}
	return true;
}

static void place_not_run(struct assembler *as)
{
	int most = 0;

	for (int i = 0; i < as->translation->unit_count; i++) {
		const struct frame *frame = &as->frame[i];

		most = frame->result_count > most ? frame->result_count : most;
		if (!frame->always && frame->listed_count > most)
			most = frame->listed_count;
	}
	if (most)
		as->not_run = place_values(as, RUN_VALUES, IEC_BOOL, 0, (uint32_t)most);
}

void layout_power(struct assembler *as)
{
	int tables = as->translation->unit_count + 1;

	as->power = arena_alloc(as->arena, (size_t)tables * sizeof(*as->power));
	if (!as->power) {
		as->failed = true;
		return;
	}
	place_not_run(as);
	for (int depth = 1; depth <= LIMIT_NESTING; depth++)
		if (!place_depth(as, depth))
			as->failed = true;
	for (int table = 0; table < tables; table++)
		if (!as->power[table] && !place_table(as, table))
			as->failed = true;
}

const struct frame *layout_pou(const struct assembler *as, enum word word,
			       uint32_t *index)
{
	const struct pou *pou = shape_pou(as->translation->project, word);

	*index = (uint32_t)(pou - as->translation->project->pou);
	return &as->frame[*index];
}
