/* SPDX-License-Identifier: MIT
 *
 * pack_image - writes the result of the assembler as a code image, with its power section.
 */
#include "engine/base/digest.h"
#include "engine/check/access.h"
#include "engine/model/shape.h"
#include "engine/translate/assembler.h"
#include "engine/translate/temps.h"

#include <stdio.h>
#include <string.h>

struct maps {
	char *string;
	size_t string_used, string_size;
	uint8_t *declared;   /* by folded name: in how many tables, up to 2 */
	uint32_t *symbol;
	int symbol_count;
	struct code_group *group;
	int group_count;
	struct code_power *power;
	int power_count;
	struct code_watched *watched;
	int watched_count;
};

#define BOUNDS 32 /* bytes that "[-1000..1000]" takes at most                */
#define NAME_PART (LIMIT_NAME + BOUNDS + 1)
#define NAME_MOST ((LIMIT_NESTING + 2) * NAME_PART)

/* Appends @text to the strings; returns its offset. */
static uint32_t maps_string(struct assembler *as, struct maps *maps, const char *text,
			    size_t len)
{
	size_t used = maps->string_used, size = maps->string_size;

	if (used + len + 1 > size) {
		size = 2 * size + len + 64;
		char *more = arena_grow(as->arena, maps->string,
					maps->string_size, size);

		if (!more) {
			as->failed = true;
			return 0;
		}
		maps->string = more;
		maps->string_size = size;
	}
	memcpy(maps->string + used, text, len);
	maps->string[used + len] = '\0';
	maps->string_used = used + len + 1;
	return (uint32_t)used;
}

static uint32_t add_name(struct assembler *as, struct maps *maps, uint32_t id)
{
	const struct names *names = &as->translation->project->names;

	return maps_string(as, maps, names_text(names, id), names_len(names, id));
}

/* Variables that only conditions of a chart write are hidden from outside. */
static bool is_condition(const struct pou *pou, int index)
{
	return pou && pou->sfc && pou->sfc->block >= 0 &&
	       index == sfc_condition(pou->sfc, &pou->vars);
}

/* Type, marks and place of a symbol as its word has them. */
static uint32_t symbol_word(struct assembler *as, const struct maps *maps,
			    const struct pou *pou, const struct var *var, int index)
{
	const char *name = names_text(&as->translation->project->names, var->name);
	struct meaning m = {
		.kind = MEANING_VARIABLE, .type = var->type, .pou = pou,
		.var = var, .index = index, .addr = var->at,
	};
	uint32_t mark = var->type, offset = layout_spot(as, &m).offset;

	if (var->at.area != AREA_NONE && var->at.bits == 1) {
		mark |= SYMBOL_BIT;
		offset = areas_byte(as->areas, var->at) * 8 + var->at.bit;
	}
	if (maps->declared[var->fold] > 1)
		mark |= SYMBOL_SHARED;
	if (is_temporary(name, 'T') || is_temporary(name, 'N') ||
	    is_temporary(name, 'E') || is_condition(pou, index))
		mark |= SYMBOL_HIDDEN;
	return CODE_OPERAND(mark, offset);
}

/* The bounds of an array, behind its name. */
static size_t print_bounds(char *out, struct var_array array)
{
	return (size_t)snprintf(out, BOUNDS, "[%ld..%lld]", (long)array.low,
				(long long)array.low + array.count - 1);
}

/* Of several dimensions, the indices of element @element but the last one: "[2][1]"; of one
 * dimension nothing. */
static size_t print_row(char *out, const struct var_array *dim, int dims, uint32_t element)
{
	size_t len = 0;

	*out = '\0';
	for (int i = 0; i + 1 < dims; i++) {
		const uint32_t each = vars_flat(dim + i + 1, dims - i - 1).count;

		len += (size_t)snprintf(out + len, BOUNDS, "[%lld]",
					(long long)dim[i].low + element / each % dim[i].count);
	}
	return len;
}

/* The symbol of an array carries its bounds. */
static void add_symbol_name(struct assembler *as, struct maps *maps,
			    const struct var *var)
{
	const struct names *names = &as->translation->project->names;
	size_t len = names_len(names, var->name);
	char text[LIMIT_NAME + BOUNDS];

	if (!var->array.count) {
		add_name(as, maps, var->name);
		return;
	}
	memcpy(text, names_text(names, var->name), len);
	len += print_bounds(text + len, var->array);
	maps_string(as, maps, text, len);
}

/* One symbol for each row of an array of several dimensions: Table[2][1..3]. */
static void add_rows(struct assembler *as, struct maps *maps, const struct pou *pou,
		     const struct var *var, int index)
{
	const struct names *names = &as->translation->project->names;
	const struct var_array last = var->dim[var->dims - 1];
	const uint32_t unit = shape_of_var(&as->translation->project->words, var).unit;
	const uint32_t word = symbol_word(as, maps, pou, var, index);
	const size_t head = names_len(names, var->name);
	char text[LIMIT_NAME + (LIMIT_INDICES + 1) * BOUNDS];

	memcpy(text, names_text(names, var->name), head);
	for (uint32_t i = 0; i < var->array.count && !as->failed; i += last.count) {
		uint32_t *symbol = arena_push(as->arena, &maps->symbol, &maps->symbol_count,
					      sizeof(*symbol));
		size_t len = head;

		if (!symbol) {
			as->failed = true;
			return;
		}
		*symbol = word + i * (CODE_TYPE(word) & SYMBOL_BIT ? 1 : unit);
		len += print_row(text + len, var->dim, var->dims, i);
		len += print_bounds(text + len, last);
		maps_string(as, maps, text, len);
	}
}

static void add_symbol(struct assembler *as, struct maps *maps,
		       const struct pou *pou, const struct var *var, int index)
{
	if (var->dims > 1) {
		add_rows(as, maps, pou, var, index);
		return;
	}

	uint32_t *symbol = arena_push(as->arena, &maps->symbol,
				      &maps->symbol_count, sizeof(*symbol));

	if (!symbol) {
		as->failed = true;
		return;
	}
	*symbol = symbol_word(as, maps, pou, var, index);
	add_symbol_name(as, maps, var);
}

/* An instance without variables has nothing to name. */
static void drop_empty_group(struct maps *maps)
{
	if (maps->group_count && maps->group[maps->group_count - 1].first ==
				 (uint32_t)maps->symbol_count)
		maps->group_count--;
}

/* The following symbols belong to @pou and have the flags of their VAR block. */
static void add_group(struct assembler *as, struct maps *maps, uint32_t pou,
		      uint8_t flags)
{
	struct code_group *group;

	drop_empty_group(maps);
	group = arena_push(as->arena, &maps->group, &maps->group_count,
			   sizeof(*group));
	if (!group) {
		as->failed = true;
		return;
	}
	*group = (struct code_group){
		.first = (uint32_t)maps->symbol_count, .pou = pou,
		.flags = (flags & VAR_CONSTANT ? SYMBOL_CONSTANT : 0u) |
			 (flags & VAR_RETAIN ? SYMBOL_RETAIN : 0u),
	};
}

/* A part of a variable, which has no symbol of its own: `M1.Start`. */
static void add_part(struct assembler *as, struct maps *maps, const char *name,
		     const struct word_pin *pin, uint32_t offset, uint32_t marks)
{
	uint32_t *symbol = arena_push(as->arena, &maps->symbol,
				      &maps->symbol_count, sizeof(*symbol));

	if (!symbol) {
		as->failed = true;
		return;
	}
	*symbol = CODE_OPERAND((uint32_t)pin->type | marks, offset);
	maps_string(as, maps, name, strlen(name));
}

/* The parts of a structure or instance get symbols, also in arrays: `Recipes[3].Speed`. */
struct level {
	const struct word_row *row;
	uint32_t base;
	int next;
	uint32_t element;  /* of the pin at next                           */
	size_t len;        /* of the name so far                           */
};

/* Appends the index of an element, or the bounds of an array of values; returns the length. */
static size_t maps_join_index(char *out, const struct word_pin *pin, uint32_t element)
{
	*out = '\0';
	if (!pin->elements)
		return 0;
	if (pin->type != IEC_NONE)
		return print_bounds(out, pin_array(pin));
	return (size_t)snprintf(out, BOUNDS, "[%lld]",
				(long long)pin->low + element);
}

/* The same of a variable or member that may have several dimensions; NULL: it has one. */
static size_t join_indices(char *out, const struct word_pin *pin, const struct var *var,
			   uint32_t element)
{
	size_t len;

	if (!var || var->dims < 2)
		return maps_join_index(out, pin, element);
	len = print_row(out, var->dim, var->dims, element);
	const struct var_array last = var->dim[var->dims - 1];

	if (pin->type != IEC_NONE)
		return len + print_bounds(out + len, last);
	return len + (size_t)snprintf(out + len, BOUNDS, "[%lld]",
				      (long long)last.low + element % last.count);
}

/* Elements of a member that one symbol names: a row of values, else one. */
static uint32_t row_of(const struct word_pin *pin, const struct var *var)
{
	return pin->type == IEC_NONE ? 1 :
	       var && var->dims > 1 ? var->dim[var->dims - 1].count : pin->elements;
}

/* The next pin to name; an array of structures gives one element at a time. */
static const struct word_pin *next_pin(struct level *top, const struct var *var, uint32_t *element)
{
	const struct word_pin *pin = &top->row->pin[top->next];

	*element = top->element;
	top->element += pin->elements ? row_of(pin, var) : 1;
	if (pin->dir == PIN_NONE || top->element >= pin->elements) {
		top->next++;
		top->element = 0;
	}
	return pin;
}

/* The edge memory at pin @index of a block; NULL: the pin is none. */
static const char *edge_key(const struct assembler *as, const struct word_row *row,
			    int index)
{
	if (row->kind != WORD_FB)
		return NULL;
	const struct unit *unit = &as->translation->unit[row->owner];

	index -= unit->pou->vars.count;
	if (row->pin[row->pin_count - 1].name[0] || index < 0 ||
	    !unit->temps || index >= unit->temps->edge_key_count)
		return NULL;
	return unit->temps->edge_key[index];
}

/* The variable that the next pin was made from; NULL: none. */
static const struct var *member_of(const struct assembler *as, const struct level *top)
{
	const struct project *project = as->translation->project;
	const struct var_table *table = NULL;

	if (top->row->owner >= 0)
		table = top->row->kind == WORD_STRUCT && *top->row->word ?
			&project->structure[top->row->owner].vars :
			&project->pou[top->row->owner].vars;
	return table && top->next < table->count ? &table->var[top->next] : NULL;
}

/* What a chart in a block remembers: it has a name that nobody writes, unlike `Fill.X`. */
static uint32_t hidden(const struct assembler *as, const struct word_row *row, const struct word_pin *pin)
{
	const struct var_table *table = row->kind == WORD_FB && row->owner >= 0 ?
		&as->translation->project->pou[row->owner].vars : NULL;
	const int index = (int)(pin - row->pin);

	return table && index < table->count && vars_flags(table, index) & VAR_SFC && !strchr(pin->name, '.') ?
	       SYMBOL_HIDDEN : 0;
}

/* BOOLs of a structure at an address, each the lowest bit of its byte. @end: of @name so far. */
static void add_bits(struct assembler *as, struct maps *maps, char *end, const char *name,
		     const struct word_pin *pin, const struct var *var, uint32_t element, uint32_t at,
		     uint32_t marks)
{
	const uint32_t count = pin->elements ? row_of(pin, var) : 1;
	struct word_pin each = *pin;

	each.type = IEC_NONE; /* one index for each name */
	for (uint32_t i = element; i < element + count && !as->failed; i++) {
		join_indices(end, &each, var, i);
		add_part(as, maps, name, pin, (at + i) * 8, marks | SYMBOL_BIT);
	}
}

/* All parts of one instance or structure of the project, at every depth; @name holds its own
 * name. */
static void add_parts(struct assembler *as, struct maps *maps, char *name,
		      enum word word, uint32_t offset, uint32_t marks)
{
	const struct word_table *words = &as->translation->project->words;
	struct level level[LIMIT_NESTING + 1];
	int depth = 0;

	level[0] = (struct level){ .row = words_row(words, word), .base = offset,
				   .len = strlen(name) };
	while (depth >= 0 && !as->failed) {
		struct level *top = &level[depth];
		const struct word_pin *pin;
		const char *part;
		size_t len = top->len;
		uint32_t element, at;

		if (top->next == top->row->pin_count) {
			depth--;
			continue;
		}
		const struct var *var = member_of(as, top);

		pin = next_pin(top, var, &element);
		if (pin->dir == PIN_NONE)
			continue;
		part = *pin->name ? pin->name :
		       edge_key(as, top->row, (int)(pin - top->row->pin));
		if (!part)
			continue;
		name[len++] = '.';
		memcpy(name + len, part, strlen(part) + 1);
		len += strlen(part);
		if (pin->type == IEC_BOOL && top->base < as->areas->size) {
			add_bits(as, maps, name + len, name, pin, var, element, top->base + pin->offset, marks);
			continue;
		}
		len += join_indices(name + len, pin, var, element);
		at = top->base + pin->offset + element * shape_of(words, pin).unit;
		if (pin->type == IEC_NONE && word_is_own(pin->word))
			level[++depth] = (struct level){
				.row = words_row(words, pin->word), .base = at,
				.len = len };
		else
			add_part(as, maps, name, pin, at,
				 *pin->name ? marks | hidden(as, top->row, pin) : SYMBOL_HIDDEN);
	}
}

/* An instance or structure, or a whole array. */
static void add_whole(struct assembler *as, struct maps *maps,
		      const struct var *var, uint32_t offset)
{
	const struct project *project = as->translation->project;
	struct word_pin like = { .type = IEC_NONE, .word = var->fb,
				 .elements = var->array.count, .low = var->array.low };
	uint32_t marks = maps->declared[var->fold] > 1 ? SYMBOL_SHARED : 0;
	uint32_t count = var->array.count ? var->array.count : 1;
	uint32_t unit = shape_of_var(&project->words, var).unit;
	size_t len = names_len(&project->names, var->name);
	char *name = arena_alloc(as->arena, NAME_MOST);

	if (!name) {
		as->failed = true;
		return;
	}
	memcpy(name, project_text(project, var->name), len);
	for (uint32_t i = 0; i < count && !as->failed; i++) {
		join_indices(name + len, &like, var, i);
		if (word_is_own(var->fb))
			add_parts(as, maps, name, var->fb, offset + i * unit, marks);
		else
			add_part(as, maps, name, &like, offset + i * unit, marks);
	}
}

static void add_var(struct assembler *as, struct maps *maps,
		    const struct pou *pou, const struct var *var, int index)
{
	struct meaning m = { .kind = MEANING_INSTANCE, .pou = pou, .var = var,
			     .index = index, .addr = var->at };

	if (var->type == IEC_NONE && (word_is_own(var->fb) || var->array.count))
		add_whole(as, maps, var, layout_spot(as, &m).offset);
	else
		add_symbol(as, maps, pou, var, index);
}

static void add_table(struct assembler *as, struct maps *maps,
		      const struct pou *pou, const struct var_table *vars)
{
	const struct pou *first = as->translation->project->pou;
	uint32_t number = pou ? (uint32_t)(pou - first) + 1 : 0;
	uint8_t before = 0;

	/* Variables in a frame belong to the instances. */
	if (pou && pou_has_frame(pou))
		return;
	for (int i = 0; i < vars->count && !as->failed; i++) {
		const struct var *var = &vars->var[i];
		uint8_t flags = vars_flags(vars, i) & (VAR_CONSTANT | VAR_RETAIN);

		if (var->type == IEC_NONE &&
		    words_row(&as->translation->project->words, var->fb)->retain)
			flags |= VAR_RETAIN;
		if (i == 0 || flags != before)
			add_group(as, maps, number, flags);
		before = flags;
		add_var(as, maps, pou, var, i);
	}
}

/* Memories of edges, in a POU without a frame. */
static void add_edges(struct assembler *as, struct maps *maps, int index)
{
	const struct unit *unit = &as->translation->unit[index];
	const struct temps *temps = unit->temps;
	const struct word_pin like = { .type = IEC_BOOL };

	if (!temps || !temps->edge_key_count || pou_has_frame(unit->pou))
		return;
	add_group(as, maps, (uint32_t)index + 1, 0);
	for (int i = 0; i < temps->edge_key_count && !as->failed; i++) {
		enum diag_id why;
		const struct meaning *m = scope_find(as->translation->scope, unit->pou,
						     temps->edge_name[i], &why);

		if (m && m->kind == MEANING_VARIABLE)
			add_part(as, maps, temps->edge_key[i], &like,
				 layout_spot(as, m).offset, SYMBOL_HIDDEN);
	}
}

/* Variables that a chart keeps between scans, beside its steps. */
static void add_memories(struct assembler *as, struct maps *maps, int index)
{
	const struct unit *unit = &as->translation->unit[index];
	const struct temps *temps = unit->temps;

	if (!temps || !temps->memory_count)
		return;
	add_group(as, maps, (uint32_t)index + 1, 0);
	for (int i = 0; i < temps->memory_count && !as->failed; i++) {
		const struct temp_memory *memory = &temps->memory[i];
		const struct word_pin like = { .type = memory->var->type };
		enum diag_id why;
		const struct meaning *m = scope_find(as->translation->scope, unit->pou,
						     memory->var->name, &why);

		if (m)
			add_part(as, maps, memory->key, &like,
				 layout_spot(as, m).offset, SYMBOL_HIDDEN);
	}
}

/* ---- what a body has while it runs ---- */

/* "Belt1" behind the @len bytes of @name; with a dot between. */
static size_t join_name(char *name, size_t len, const char *part)
{
	size_t size = strlen(part);

	if (len > 0)
		name[len++] = '.';
	memcpy(name + len, part, size + 1);
	return len + size;
}

/* A constant of a function or a block: `Scaled.Most`. */
static void add_frame_constant(struct assembler *as, struct maps *maps, char *name, size_t len,
			       const struct pou *pou, int index)
{
	const struct var *var = &pou->vars.var[index];
	const struct word_pin like = shape_pin(var);
	const struct meaning m = { .kind = MEANING_VARIABLE, .type = var->type, .pou = pou,
				   .var = var, .index = index, .addr = var->at };

	if (var->type == IEC_NONE || var->dims > 1 || !(vars_flags(&pou->vars, index) & VAR_CONSTANT))
		return;
	len = join_name(name, len, project_text(as->translation->project, var->name));
	maps_join_index(name + len, &like, 0);
	add_part(as, maps, name, &like, layout_spot(as, &m).offset, SYMBOL_HIDDEN);
}

static void add_frame_constants(struct assembler *as, struct maps *maps, char *name,
				const struct pou *pou)
{
	const size_t len = strlen(name);

	add_group(as, maps, 0, VAR_CONSTANT);
	for (int k = 0; k < pou->vars.count && !as->failed; k++)
		add_frame_constant(as, maps, name, len, pou, k);
	name[len] = '\0';
	add_group(as, maps, 0, 0);
}

/* Variables of functions, and VAR_TEMP of blocks: `Scaled.X`. Only for a simulation, where a person may
 * stand in the body, and conditions of breakpoints read them. */
static void add_frames(struct assembler *as, struct maps *maps)
{
	const struct project *project = as->translation->project;
	char *name = as->listing ? arena_alloc(as->arena, NAME_MOST) : NULL;

	for (int i = 0; name && i < as->translation->unit_count && !as->failed; i++) {
		const struct pou *pou = &project->pou[i];
		const struct frame *frame = &as->frame[i];

		if (!pou_has_frame(pou))
			continue;
		const size_t len = join_name(name, 0, project_text(project, pou->name));

		add_frame_constants(as, maps, name, pou);
		if (pou->kind == POU_FUNCTION && word_is_own(pou->word))
			add_parts(as, maps, name, pou->word, frame->offset, SYMBOL_HIDDEN);
		name[len] = '\0';
		if (word_is_own(pou->temp_word))
			add_parts(as, maps, name, pou->temp_word, frame->temps, SYMBOL_HIDDEN);
	}
}

/* ---- VAR_ACCESS ---- */

/* Hidden symbols behind all others: a board without names has none of them, and a board that
 * does not know them lets nobody write. */
static void add_access(struct assembler *as, struct maps *maps, const struct access *access)
{
	const struct project *project = as->translation->project;
	const size_t len = names_len(&project->names, access->var.name);
	struct word_pin like = { .type = access->var.type, .word = access->var.fb,
				 .elements = access->var.array.count,
				 .low = access->var.array.low };
	uint32_t count = like.type == IEC_NONE && like.elements ? like.elements : 1, at;
	uint32_t unit = shape_of_var(&project->words, &access->var).unit, marks = SYMBOL_HIDDEN;
	enum diag_id why;
	const struct meaning *m = access_find(as->translation->scope, access, &why);
	char *name = arena_alloc(as->arena, NAME_MOST);
	size_t used;

	if (!m || !name) {
		as->failed = true;
		return;
	}
	at = layout_spot(as, m).offset;
	if (m->addr.area != AREA_NONE && m->addr.bits == 1) {
		at = areas_byte(as->areas, m->addr) * 8 + m->addr.bit;
		marks |= SYMBOL_BIT;
	}
	used = (size_t)snprintf(name, NAME_MOST, "%s ", access_word(access->writes));
	memcpy(name + used, project_text(project, access->var.name), len + 1);
	used += len;
	for (uint32_t i = 0; i < count && !as->failed; i++) {
		maps_join_index(name + used, &like, i);
		if (like.type == IEC_NONE)
			add_parts(as, maps, name, access->var.fb, at + i * unit, marks);
		else
			add_part(as, maps, name, &like, at, marks);
	}
}

static void add_accesses(struct assembler *as, struct maps *maps)
{
	const struct project *project = as->translation->project;

	if (project->access_count)
		add_group(as, maps, 0, 0);
	for (int i = 0; i < project->access_count && !as->failed; i++)
		add_access(as, maps, &project->access[i]);
}

static void count_names(struct maps *maps, const struct var_table *vars)
{
	for (int i = 0; i < vars->count; i++)
		if (maps->declared[vars->var[i].fold] < 2)
			maps->declared[vars->var[i].fold]++;
}

static uint32_t power_offset(struct assembler *as, const struct pou *pou,
			     uint32_t name)
{
	const struct meaning *m;
	enum diag_id why;

	if (!name)
		return CODE_TRUE_AT(as->areas);
	m = scope_find(as->translation->scope, pou, name, &why);
	if (!m || m->kind == MEANING_LITERAL)
		return CODE_TRUE_AT(as->areas);
	return layout_spot(as, m).offset;
}

static bool is_behind(const struct code_power *a, const struct code_power *b)
{
	if (a->rung != b->rung)
		return a->rung > b->rung;
	if (a->row != b->row)
		return a->row > b->row;
	return a->col > b->col;
}

/* How many from the first on are in order. */
static size_t in_order(const struct code_power *power, size_t count)
{
	size_t i = 1;

	while (i < count && !is_behind(&power[i - 1], &power[i]))
		i++;
	return i < count ? i : count;
}

/* The first @half and the others are in order each. @first: room for the first ones. */
static void merge_cells(struct code_power *power, size_t half, size_t count, struct code_power *first)
{
	size_t left = 0, right = half;

	memcpy(first, power, half * sizeof(*power));
	for (size_t at = 0; left < half; at++)
		power[at] = right < count && is_behind(&first[left], &power[right]) ?
			    power[right++] : first[left++];
}

/* By rung, row and column. The sort of the C library is a kilobyte more on a board. */
static void sort_cells(struct code_power *power, size_t count)
{
	for (size_t gap = count / 2; gap; gap /= 2)
		for (size_t i = gap; i < count; i++) {
			const struct code_power moved = power[i];
			size_t k = i;

			for (; k >= gap && is_behind(&power[k - gap], &moved); k -= gap)
				power[k] = power[k - gap];
			power[k] = moved;
		}
}

/* Structured Text has the results of its lines, then those of its list, each in order. */
static void order_cells(struct assembler *as, struct code_power *power, size_t count)
{
	const size_t half = in_order(power, count);
	struct code_power *first;

	if (half == count)
		return;
	first = in_order(power + half, count - half) == count - half ?
		arena_alloc(as->arena, half * sizeof(*first)) : NULL;
	if (first)
		merge_cells(power, half, count, first);
	else
		sort_cells(power, count);
}

/* The lines of a list have no cells. */
static void add_results(struct assembler *as, struct maps *maps, int unit,
			const struct result *result, int count, uint16_t col)
{
	for (int i = 0; i < count && !as->failed; i++, result++) {
		struct code_power *power = arena_push(as->arena, &maps->power,
			&maps->power_count, sizeof(*power));

		if (!power) {
			as->failed = true;
			return;
		}
		*power = (struct code_power){
			.pou = (uint16_t)unit, .col = col, .rung = result->line,
			.in = result->ran, .type = (uint16_t)result->type,
			.out = result->type == IEC_NONE ? result->ran : result->at,
		};
	}
}

/* Sorts by place for lookups: a chart comes to its rungs in its own order. */
static void add_power(struct assembler *as, struct maps *maps)
{
	for (int i = 0; i < as->translation->unit_count; i++) {
		const struct unit *unit = &as->translation->unit[i];
		const struct frame *frame = &as->frame[i];
		const int first = maps->power_count;

		for (int k = 0; k < unit->power_count; k++) {
			const struct power_note *note = &unit->power[k];
			struct code_power *power = arena_push(as->arena,
				&maps->power, &maps->power_count, sizeof(*power));

			if (!power) {
				as->failed = true;
				return;
			}
			*power = (struct code_power){
				.pou = (uint16_t)i, .rung = note->rung,
				.row = note->row, .col = note->col,
				.in = power_offset(as, unit->pou, note->in),
				.out = power_offset(as, unit->pou, note->out),
			};
		}
		add_results(as, maps, i, frame->result, frame->result_count, CODE_LINE);
		add_results(as, maps, i, frame->listed, frame->listed_count, CODE_LISTED);
		if ((unit->pou->sfc || frame->listed_count) && maps->power_count > first)
			order_cells(as, maps->power + first, (size_t)(maps->power_count - first));
	}
}

/* ---- power by instance ---- */

/* An instance whose power is kept, and those inside it. */
struct kept {
	int unit;
	uint32_t base; /* of its power                                        */
	int next;      /* variable of its block to look at                    */
	uint32_t element; /* its block's variable to look at next             */
	size_t len;    /* of that variable                                    */
};

static void add_watched(struct assembler *as, struct maps *maps,
			const struct kept *kept, const char *name)
{
	const struct frame *frame = &as->frame[kept->unit];
	struct code_watched *watched = arena_push(as->arena, &maps->watched,
		&maps->watched_count, sizeof(*watched));

	if (!watched) {
		as->failed = true;
		return;
	}
	*watched = (struct code_watched){
		.pou = (uint32_t)kept->unit, .from = frame->power,
		.to = kept->base, .size = frame->power_size,
		.name = maps_string(as, maps, name, kept->len),
	};
}

/* The next instance inside the one on top, one element at a time; false: no more at this
 * level. */
static bool next_kept(const struct assembler *as, struct kept *top, int *index,
		      uint32_t *element)
{
	int table = top->unit + 1;
	const struct var_table *vars = layout_vars(as, table);

	while (top->next < vars->count && !as->power[table][top->next])
		top->next++;
	if (top->next == vars->count)
		return false;
	*index = top->next;
	*element = top->element++;
	if (top->element >= vars->var[*index].array.count) {
		top->element = 0;
		top->next++;
	}
	return true;
}

/* Element @element of variable @index of table @table, and everything inside it. */
static void keep_instance(struct assembler *as, struct maps *maps, char *name,
			  size_t len, int table, int index, uint32_t element)
{
	const struct project *project = as->translation->project;
	struct kept level[LIMIT_NESTING + 1];
	int depth = -1;

	do {
		const struct var *var = &layout_vars(as, table)->var[index];
		struct word_pin like = { .type = IEC_NONE, .elements = var->array.count, .low = var->array.low };
		uint32_t base = as->power[table][index], unit = 0;
		struct kept *inner = &level[depth + 1];

		if (depth >= 0) { /* inside a block: relative to the power of its cells */
			base += level[depth].base -
				as->frame[level[depth].unit].power;
			len = level[depth].len;
		}
		base += element * layout_pou(as, var->fb, &unit)->power_size;
		*inner = (struct kept){ .unit = (int)unit, .base = base,
			.len = join_name(name, len,
					 project_text(project, var->name)) };
		inner->len += join_indices(name + inner->len, &like, var, element);
		add_watched(as, maps, inner, name);
		depth++;
		while (depth >= 0 &&
		       !next_kept(as, &level[depth], &index, &element))
			depth--;
		if (depth >= 0)
			table = level[depth].unit + 1;
	} while (depth >= 0 && !as->failed);
}

static void keep_table(struct assembler *as, struct maps *maps, char *name,
		       int table)
{
	const struct project *project = as->translation->project;
	const struct var_table *vars = layout_vars(as, table);

	for (int i = 0; i < vars->count && !as->failed; i++) {
		size_t len = 0;

		if (!as->power[table][i])
			continue;
		if (table && maps->declared[vars->var[i].fold] > 1)
			len = join_name(name, 0, project_text(project,
				project->pou[table - 1].name));
		for (uint32_t k = 0; k == 0 || k < vars->var[i].array.count; k++)
			if (!as->failed)
				keep_instance(as, maps, name, len, table, i, k);
	}
}

static void keep_powers(struct assembler *as, struct maps *maps)
{
	const struct project *project = as->translation->project;
	char *name = as->power ? arena_alloc(as->arena, NAME_MOST) : NULL;

	if (!name)
		return;
	keep_table(as, maps, name, 0);
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_PROGRAM)
			keep_table(as, maps, name, i + 1);
}

/* Places of the power of cells, and of instances. */
static void pack_power(struct assembler *as, struct maps *maps)
{
	add_power(as, maps);
	keep_powers(as, maps);
}

static bool make_maps(struct assembler *as, struct maps *maps)
{
	struct project *project = as->translation->project;

	maps->declared = arena_alloc(as->arena, (size_t)project->names.count + 1);
	if (!maps->declared)
		return false;
	count_names(maps, &project->globals);
	for (int i = 0; i < as->translation->unit_count; i++)
		if (!pou_has_frame(&project->pou[i]))
			count_names(maps, &project->pou[i].vars);
	add_table(as, maps, NULL, &project->globals);
	for (int i = 0; i < as->translation->unit_count; i++)
		add_table(as, maps, &project->pou[i], &project->pou[i].vars);
	for (int i = 0; i < as->translation->unit_count; i++) {
		add_edges(as, maps, i);
		add_memories(as, maps, i);
	}
	add_frames(as, maps);
	add_accesses(as, maps);
	drop_empty_group(maps);
	for (int i = 0; i < as->translation->unit_count; i++)
		as->entry[i].name = add_name(as, maps, project->pou[i].name);
	for (int i = 0; i < as->task_count; i++)
		as->task[i].name = add_name(as, maps, as->task[i].name);
	pack_power(as, maps);
	return !as->failed;
}

/* The contents of each section. */
struct piece { const void *bytes; size_t size; };

static void *write_pieces(struct assembler *as, const struct piece *piece,
			  size_t *len)
{
	struct code_header *header;
	size_t size = sizeof(*header), covered;
	uint8_t *image;

	for (int i = 1; i < CODE_SECTION_COUNT; i++)
		size += (piece[i].size + 7) / 8 * 8;
	if (size > LIMIT_IMAGE) {
		struct diag place = { .id = DIAG_CODE_TOO_LARGE,
			.file = as->translation->project->file };

		diag_add(as->translation->diags, place, "%zu", size);
		return NULL;
	}
	image = arena_alloc(as->arena, size);
	if (!image)
		return NULL;
	header = (void *)image;
	memcpy(header->magic, CODE_MAGIC, sizeof(header->magic));
	header->version = CODE_VERSION;
	header->size = (uint32_t)size;
	header->data_size = as->data_size;
	header->retain_offset = as->retain_offset;
	header->retain_size = as->retain_size;
	header->budget = LIMIT_BUDGET;
	header->words = WORD_COUNT;
	header->core_runs = (uint32_t)as->run_core;
	memcpy(header->area_bytes, as->areas->bytes, sizeof(as->areas->bytes));
	*len = size;
	size = sizeof(*header);
	for (int i = 1; i < CODE_SECTION_COUNT; i++) {
		header->section[i].offset = (uint32_t)size;
		header->section[i].size = (uint32_t)piece[i].size;
		if (piece[i].size)
			memcpy(image + size, piece[i].bytes, piece[i].size);
		size += (piece[i].size + 7) / 8 * 8;
	}
	covered = offsetof(struct code_header, crc) + 4;
	header->crc = digest_crc32c(0, image + covered, size - covered);
	return image;
}

#define PIECE(pointer, count) \
	{ (pointer), (size_t)(count) * sizeof(*(pointer)) }

void *pack_image(struct assembler *as, size_t *len)
{
	struct maps *maps = arena_alloc(as->arena, sizeof(*maps));

	if (!maps || !make_maps(as, maps))
		return NULL;
	const struct piece piece[CODE_SECTION_COUNT] = {
		[CODE_PROGRAMS] = PIECE(as->entry, as->translation->unit_count),
		[CODE_TASKS] = PIECE(as->task, as->task_count),
		[CODE_CALLS] = PIECE(as->call.word, as->call.count),
		[CODE_LAYOUT] = PIECE(as->run, as->run_count),
		[CODE_INIT] = PIECE(as->init.word, as->init.count),
		[CODE_BITS] = PIECE(as->bit_run, as->bit_run_count),
		[CODE_TEXT] = PIECE(as->code.word, as->code.count),
		[CODE_WATCH] = PIECE(as->watch.word, as->watch.count),
		[CODE_SYMBOLS] = PIECE(maps->symbol, maps->symbol_count),
		[CODE_GROUPS] = PIECE(maps->group, maps->group_count),
		[CODE_POWER] = PIECE(maps->power, maps->power_count),
		[CODE_PLACES] = PIECE(as->place, as->place_count),
		[CODE_STRINGS] = PIECE(maps->string, maps->string_used),
		[CODE_WATCHED] = PIECE(maps->watched, maps->watched_count),
	};

	return write_pieces(as, piece, len);
}
