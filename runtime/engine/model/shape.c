/* SPDX-License-Identifier: MIT
 *
 * shape - rows of a project's own words, and the order of their parts in memory.
 *
 * Parts are ordered by type, so that few runs describe them; blocks and structures come
 * last. Those of a structure in a union, or at an address, lie as they are declared. A type that contains itself has no size and is an error.
 */
#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>

#define BLOCK_ALIGN 8u

enum state { STATE_OPEN, STATE_WORKING, STATE_DONE };

struct shaper {
	struct project *project;
	struct diag_list *diags;
	uint8_t *state;      /* by own word                                  */
	int *stack, *next;   /* own words in progress; the next pin of each  */
	int depth;
	bool good;
};

static struct word_row *own_row(const struct shaper *s, int index)
{
	return s->project->words.row[index];
}

static bool is_block(const struct word_row *row)
{
	return row->kind == WORD_FB || row->kind == WORD_FN;
}

/* The VAR_TEMP of a POU as a row without a name. */
static bool is_temps(const struct word_row *row)
{
	return !*row->word;
}

const struct pou *shape_pou(const struct project *project, enum word word)
{
	const struct word_row *row = words_own(&project->words, word);

	return row && is_block(row) && row->owner >= 0 ?
	       &project->pou[row->owner] : NULL;
}

const struct var_table *shape_vars(const struct project *project, enum word word)
{
	const struct word_row *row = words_own(&project->words, word);

	if (!row || row->owner < 0)
		return NULL;
	if (is_block(row) || is_temps(row))
		return &project->pou[row->owner].vars;
	return &project->structure[row->owner].vars;
}

struct extent shape_of(const struct word_table *words, const struct word_pin *pin)
{
	struct extent out = { .align = BLOCK_ALIGN };

	if (pin->type == IEC_NONE) {
		out.unit = words_row(words, pin->word)->size;
	} else {
		out.unit = iec_type_size(pin->type, pin->capacity ?
					 pin->capacity : IEC_STRING_MOST);
		out.align = iec_type_row(pin->type)->size;
	}
	out.size = out.unit;
	if (pin->elements) {
		out.unit = (out.unit + out.align - 1) / out.align * out.align;
		out.size = (uint64_t)out.unit * pin->elements;
	}
	return out;
}

struct word_pin shape_pin(const struct var *var)
{
	struct word_pin pin = {
		.type = var->type, .elements = var->array.count, .low = var->array.low,
	};

	if (var->type == IEC_NONE)
		pin.word = var->fb;
	else
		pin.capacity = var->capacity;
	return pin;
}

struct extent shape_of_var(const struct word_table *words, const struct var *var)
{
	const struct word_pin like = shape_pin(var);

	return shape_of(words, &like);
}

/* ---- diagnostics ---- */

static void report(struct shaper *s, int index, enum diag_id id, const char *arg)
{
	const struct word_row *row = own_row(s, index);
	struct diag place = { .id = id, .file = s->project->file };

	if (row->owner >= 0 && is_block(row)) {
		const struct pou *pou = &s->project->pou[row->owner];

		place.file = pou->file;
		place.line = pou->line;
		place.pou = project_text(s->project, pou->name);
	} else if (row->owner >= 0 && row->kind == WORD_STRUCT &&
		   !is_temps(row)) {
		place.file = s->project->structure[row->owner].file;
		place.line = s->project->structure[row->owner].line;
	}
	s->good = diag_add(s->diags, place, "%s", arg);
}

/* "A -> B -> A" */
static void report_circle(struct shaper *s, int again)
{
	char text[2 * LIMIT_ARG] = "";
	size_t used = 0;
	int from = 0;

	while (s->stack[from] != again)
		from++;
	for (int i = from; i < s->depth && used < LIMIT_ARG; i++)
		used += (size_t)snprintf(text + used, sizeof(text) - used,
					 "%.40s -> ",
					 own_row(s, s->stack[i])->word);
	if (used < LIMIT_ARG)
		snprintf(text + used, sizeof(text) - used, "%.40s",
			 own_row(s, again)->word);
	report(s, again, DIAG_CONTAINS_ITSELF, text);
}

/* ---- pins ---- */

/* A variable of a VAR_TEMP row, of a POU, or of a structure. */
static enum pin_dir dir_of(const struct word_row *row, uint16_t flags)
{
	bool temp = flags & VAR_TEMP && row->kind != WORD_FN;

	if (is_temps(row))
		return temp ? PIN_IN_OUT : PIN_NONE;
	if (row->kind == WORD_STRUCT)
		return PIN_IN_OUT;
	if (flags & VAR_CONSTANT || temp)
		return PIN_NONE;
	if (flags & VAR_INPUT)
		return PIN_IN;
	if (flags & VAR_OUTPUT)
		return PIN_OUT;
	return flags & VAR_IN_OUT ? PIN_IN_OUT : PIN_VAR;
}

static void make_pin(const struct shaper *s, struct word_row *row,
		     struct word_pin *pin, const struct var_table *table,
		     int index)
{
	const struct var *var = &table->var[index];
	uint16_t flags = vars_flags(table, index);

	*pin = shape_pin(var);
	pin->name = project_text(s->project, var->name);
	pin->dir = row->kind == WORD_FB && var->at.area != AREA_NONE ? PIN_NONE : dir_of(row, flags);
	pin->classes = iec_type_row(var->type)->class;
	pin->has_init = var->has_init;
	row->retain |= pin->dir != PIN_NONE && flags & VAR_RETAIN;
}

static int count_edges(const struct pou *pou)
{
	int count = 0;

	for (int i = 0; i < pou->rung_count; i++) {
		const struct rung *rung = pou->rung[i];
		int cells = rung->off ? 0 : rung->rows * rung->cols;

		for (int k = 0; k < cells; k++)
			count += word_row((enum word)rung->cell[k].word)->edge !=
				 EDGE_NONE;
	}
	return count;
}

static bool is_union(const struct shaper *s, const struct word_row *row)
{
	return row->kind == WORD_STRUCT && !is_temps(row) && row->owner >= 0 &&
	       s->project->structure[row->owner].overlap != OVERLAP_NONE;
}

static bool make_pins(struct shaper *s, int index)
{
	struct word_row *row = own_row(s, index);
	enum word word = (enum word)(WORD_FIRST_OWN + index);
	const struct var_table *table = shape_vars(s->project, word);
	struct word_pin *pin;
	int count, edges = 0;

	row->size = BLOCK_ALIGN;
	row->pin_count = row->ordered = 0;
	row->retain = row->texts = row->straight = row->unions = false;
	row->overlaps = is_union(s, row);
	if (!table)
		return true;
	if (row->kind == WORD_FB) {
		edges = count_edges(&s->project->pou[row->owner]);
		s->project->pou[row->owner].edges = edges;
	}
	if (row->overlaps)
		edges = 1; /* the bytes that all members share */
	count = table->count + edges;
	if (count > LIMIT_MEMBERS) {
		report(s, index, DIAG_TOO_MANY, "members");
		return true;
	}
	pin = arena_alloc(&s->project->arena, ((size_t)count + 1) * sizeof(*pin));
	if (!pin)
		return false;
	for (int i = 0; i < table->count; i++)
		make_pin(s, row, &pin[i], table, i);
	for (int i = table->count; i < count; i++)
		pin[i] = (struct word_pin){
			.name = "", .dir = PIN_VAR, .type = IEC_BOOL };
	row->pin = pin;
	row->pin_count = (uint16_t)count;
	return true;
}

/* ---- places ---- */

/* All members begin at the first byte; a pin without a name has the bytes of the longest one. */
static bool place_union(struct shaper *s, int index)
{
	struct word_row *row = own_row(s, index);
	struct word_pin *pin = (struct word_pin *)row->pin;
	struct word_pin *bytes = &pin[row->pin_count - 1];
	uint16_t *order = arena_alloc(&s->project->arena, sizeof(*order));
	uint64_t most = 1;
	int depth = 0;

	if (!order)
		return false;
	for (int i = 0; i < row->pin_count - 1; i++) {
		const struct extent extent = shape_of(&s->project->words, &pin[i]);
		const struct word_row *inner = pin[i].type == IEC_NONE ?
			words_row(&s->project->words, pin[i].word) : NULL;

		pin[i].offset = 0;
		most = extent.size > most ? extent.size : most;
		row->texts |= pin[i].type == IEC_STRING || (inner && (inner->kind == WORD_FB || inner->texts));
		depth = inner && inner->depth > depth ? inner->depth : depth;
	}
	if (most > LIMIT_DATA)
		report(s, index, DIAG_TYPE_TOO_LARGE, row->word);
	else if (row->texts)
		report(s, index, DIAG_UNION, row->word);
	most = most > LIMIT_DATA ? 1 : most;
	*bytes = (struct word_pin){ .name = "", .dir = PIN_VAR, .type = IEC_LWORD,
				    .elements = (uint32_t)(most + 7) / 8 };
	*order = (uint16_t)(row->pin_count - 1);
	row->unions = true;
	row->order = order;
	row->ordered = 1;
	row->size = bytes->elements * 8;
	row->depth = (uint8_t)(depth + 1);
	if (row->depth > LIMIT_NESTING) {
		row->depth = LIMIT_NESTING;
		report(s, index, DIAG_TOO_DEEP, row->word);
	}
	return true;
}

static void mark_table(struct shaper *s, const struct var_table *table)
{
	for (int i = 0; i < table->count; i++) {
		const struct var *var = &table->var[i];
		struct word_row *row = var->at.area == AREA_NONE || var->type != IEC_NONE ? NULL :
				       words_own(&s->project->words, var->fb);

		if (row)
			row->straight = true;
	}
}

/* The structures in unions and at addresses, at every depth. */
static void mark_straight(struct shaper *s)
{
	bool more = true;

	mark_table(s, &s->project->globals);
	for (int i = 0; i < s->project->pou_count; i++)
		mark_table(s, &s->project->pou[i].vars);
	while (more) {
		more = false;
		for (int i = 0; i < s->project->words.count; i++) {
			const struct word_row *row = own_row(s, i);

			for (int k = 0; k < row->pin_count && (row->overlaps || row->straight); k++) {
				struct word_row *inner = row->pin[k].type != IEC_NONE ? NULL :
					words_own(&s->project->words, row->pin[k].word);

				if (!inner || inner->kind != WORD_STRUCT || inner->straight)
					continue;
				inner->straight = more = true;
			}
		}
	}
}

static bool place_pins(struct shaper *s, int index)
{
	struct word_row *row = own_row(s, index);
	struct word_pin *pin = (struct word_pin *)row->pin;
	uint16_t *order = arena_alloc(&s->project->arena,
				      (row->pin_count + 1u) * sizeof(*order));
	uint64_t at = 0;
	int depth = 0;

	if (!order)
		return false;
	for (int type = row->straight ? IEC_TYPE_COUNT : 1; type <= IEC_TYPE_COUNT; type++)
		for (int i = 0; i < row->pin_count; i++) {
			enum iec_type own = row->straight ? pin[i].type : (enum iec_type)(type % IEC_TYPE_COUNT);
			struct extent extent;

			if (pin[i].type != own || pin[i].dir == PIN_NONE)
				continue;
			extent = shape_of(&s->project->words, &pin[i]);
			at = (at + extent.align - 1) / extent.align * extent.align;
			pin[i].offset = (uint32_t)at;
			at += extent.size;
			order[row->ordered++] = (uint16_t)i;
			if (at > LIMIT_DATA) {
				report(s, index, DIAG_TYPE_TOO_LARGE, row->word);
				return true;
			}
			row->texts |= own == IEC_STRING || (own == IEC_NONE && !word_is_own(pin[i].word));
			if (own == IEC_NONE && word_is_own(pin[i].word)) {
				const struct word_row *inner = words_row(
					&s->project->words, pin[i].word);

				depth = inner->depth > depth ? inner->depth : depth;
				row->retain |= inner->retain;
				row->texts |= inner->texts || inner->kind == WORD_FB;
				row->unions |= inner->unions;
			}
		}
	row->order = order;
	row->size = at ? (uint32_t)((at + BLOCK_ALIGN - 1) / BLOCK_ALIGN *
				    BLOCK_ALIGN) : BLOCK_ALIGN;
	row->depth = (uint8_t)(depth + 1);
	if (row->depth > LIMIT_NESTING) {
		row->depth = LIMIT_NESTING;
		report(s, index, DIAG_TOO_DEEP, row->word);
	}
	return true;
}

/* The next own word that must be laid out before this one; -1: none. */
static int wanted(struct shaper *s)
{
	const struct word_row *row = own_row(s, s->stack[s->depth - 1]);
	int *next = &s->next[s->depth - 1];

	while (*next < row->pin_count) {
		const struct word_pin *pin = &row->pin[(*next)++];
		int index = (int)pin->word - (int)WORD_FIRST_OWN;

		if (pin->type != IEC_NONE || pin->dir == PIN_NONE || index < 0 ||
		    index >= s->project->words.count)
			continue;
		if (s->state[index] == STATE_WORKING)
			report_circle(s, index);
		if (s->state[index] == STATE_OPEN)
			return index;
	}
	return -1;
}

static void begin(struct shaper *s, int index)
{
	s->state[index] = STATE_WORKING;
	s->stack[s->depth] = index;
	s->next[s->depth++] = 0;
}

static bool place_all(struct shaper *s)
{
	for (int i = 0; i < s->project->words.count; i++) {
		if (s->state[i] == STATE_OPEN)
			begin(s, i);
		while (s->depth > 0) {
			int inner = wanted(s);

			if (inner >= 0) {
				begin(s, inner);
				continue;
			}
			inner = s->stack[--s->depth];
			s->state[inner] = STATE_DONE;
			if (own_row(s, inner)->overlaps ? !place_union(s, inner) : !place_pins(s, inner))
				return false;
		}
	}
	return true;
}

bool shape_make(struct project *project, struct diag_list *diags)
{
	struct shaper s = { .project = project, .diags = diags, .good = true };
	size_t count = (size_t)project->words.count + 1;

	if (project->words.count == 0)
		return true;
	s.state = arena_alloc(&project->arena, count);
	s.stack = arena_alloc(&project->arena, count * sizeof(int));
	s.next = arena_alloc(&project->arena, count * sizeof(int));
	bool memory = s.state && s.stack && s.next;

	for (int i = 0; i < project->words.count && memory; i++)
		memory = make_pins(&s, i);
	if (memory)
		mark_straight(&s);
	if (memory && place_all(&s))
		return s.good;
	return diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY,
					      .file = project->file }, "%s", "");
}
