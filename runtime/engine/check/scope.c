/* SPDX-License-Identifier: MIT
 *
 * scope - from the text of an operand to what it means.
 *
 * Two open hashes: the declared names of all tables, and the answers given so
 * far by (POU, string id). An answer never moves. It reports nothing: who asks
 * knows the place and says it.
 */
#include "engine/check/scope.h"

#include "engine/base/ascii.h"
#include "engine/model/shape.h"

#include <string.h>

/* A declaration; table 0 is the globals, POU number n has n + 1. */
struct declared {
	uint32_t table, fold; /* fold 0: a free slot */
	int index;            /* of the first declaration of this name */
	uint8_t flags;        /* of its VAR block */
};

/* An answer: what a text means in a table, or why it means nothing. */
struct answer {
	struct answer *next; /* of the same text in another table */
	uint32_t table;
	enum diag_id why : 16;
	bool known;
	struct meaning meaning;
};

struct scope {
	struct project *project;
	struct arena *arena;
	struct declared *declared;
	uint32_t declared_mask;
	struct answer **answer; /* by text: what was asked of it so far      */
	uint32_t answers;       /* texts there is room for                   */
};

#define POUS UINT32_MAX /* the table of the names of POUs */

static uint32_t mix(uint32_t table, uint32_t id)
{
	uint32_t hash = id * 2654435761u ^ table * 2246822519u;

	return hash ^ hash >> 15;
}

/* The slot of a name, or the free one where it belongs. */
static struct declared *declared_slot(const struct scope *scope, uint32_t table,
				      uint32_t fold)
{
	uint32_t at = mix(table, fold) & scope->declared_mask;
	struct declared *slot = &scope->declared[at];

	while (slot->fold && (slot->fold != fold || slot->table != table)) {
		at = (at + 1) & scope->declared_mask;
		slot = &scope->declared[at];
	}
	return slot;
}

static void declare_table(struct scope *scope, uint32_t table,
			  const struct var_table *vars)
{
	int block = 0;

	for (int i = 0; i < vars->count; i++) {
		const struct var *var = &vars->var[i];
		struct declared *slot;

		while (block + 1 < vars->block_count &&
		       vars->block[block + 1].first <= i)
			block++;
		slot = declared_slot(scope, table, var->fold);
		if (!var->fold || slot->fold)
			continue;
		*slot = (struct declared){ .table = table, .fold = var->fold,
					   .index = i };
		if (block < vars->block_count)
			slot->flags = vars->block[block].flags;
	}
}

static void declare_pous(struct scope *scope)
{
	struct project *project = scope->project;

	for (int i = 0; i < project->pou_count; i++) {
		uint32_t fold = names_fold(&project->names, project->pou[i].name);
		struct declared *slot = declared_slot(scope, POUS, fold);

		if (fold && !slot->fold)
			*slot = (struct declared){ .table = POUS, .fold = fold,
						   .index = i };
	}
}

struct scope *scope_new(struct project *project, struct arena *arena)
{
	struct scope *scope = arena_alloc(arena, sizeof(*scope));
	size_t names = (size_t)project->globals.count +
		       (size_t)project->pou_count;
	uint32_t size = 16;

	if (!scope)
		return NULL;
	for (int i = 0; i < project->pou_count; i++)
		names += (size_t)project->pou[i].vars.count;
	while (size < names * 2)
		size *= 2;
	scope->project = project;
	scope->arena = arena;
	scope->declared_mask = size - 1;
	scope->declared = arena_alloc(arena, size * sizeof(struct declared));
	if (!scope->declared)
		return NULL;
	declare_table(scope, 0, &project->globals);
	for (int i = 0; i < project->pou_count; i++)
		declare_table(scope, (uint32_t)i + 1, &project->pou[i].vars);
	declare_pous(scope);
	return scope;
}

static const struct var_table *table_of(const struct scope *scope,
					uint32_t table)
{
	return table ? &scope->project->pou[table - 1].vars :
		       &scope->project->globals;
}

static uint32_t table_number(const struct scope *scope, const struct pou *pou)
{
	return pou ? (uint32_t)(pou - scope->project->pou) + 1 : 0;
}

int scope_duplicate(struct scope *scope, const struct pou *pou, int index)
{
	uint32_t table = table_number(scope, pou);
	uint32_t fold = table_of(scope, table)->var[index].fold;
	const struct declared *slot;

	if (!fold)
		return -1;
	slot = declared_slot(scope, table, fold);
	return slot->fold && slot->index < index ? slot->index : -1;
}

/* A local of this name, else a global; NULL: neither. */
static const struct declared *find_declared(const struct scope *scope,
					    uint32_t table, uint32_t fold)
{
	const struct declared *slot;

	if (!fold)
		return NULL;
	slot = declared_slot(scope, table, fold);
	if (!slot->fold && table)
		slot = declared_slot(scope, 0, fold);
	return slot->fold ? slot : NULL;
}

static bool may_write(struct iec_addr addr)
{
	return addr.area == AREA_NONE ||
	       iec_area_row(addr.area)->access == ACCESS_WRITE;
}

/* Something that has parts. */
static void mean_whole(const struct scope *scope, enum word word,
		       struct meaning *out)
{
	out->word = (uint16_t)word;
	out->type = IEC_NONE;
	out->kind = MEANING_STRUCT;
	if (scope_row(scope, word)->kind == WORD_STRUCT)
		return;
	out->kind = MEANING_INSTANCE;
	out->writable = false;
}

static void mean_variable(const struct scope *scope,
			  const struct declared *slot, struct meaning *out)
{
	const struct var *var =
		&table_of(scope, slot->table)->var[slot->index];

	out->pou = slot->table ? &scope->project->pou[slot->table - 1] : NULL;
	out->var = var;
	out->index = slot->index;
	out->addr = var->at;
	out->type = var->type;
	out->constant = slot->flags & VAR_CONSTANT;
	out->writable = !out->constant && may_write(var->at) &&
			!(slot->flags & VAR_INPUT);
	out->kind = MEANING_VARIABLE;
	if (var->array.count) {
		out->kind = MEANING_ARRAY;
		out->array = var->array;
	} else if (var->type == IEC_NONE && var->fb) {
		mean_whole(scope, var->fb, out);
	}
}

/* Part @name of the instance or structure that @out is; false: it has none. What
 * is inside a block is not to be named from outside. */
static bool mean_part(const struct scope *scope, const char *name, size_t len,
		      struct meaning *out)
{
	const struct word_row *row = scope_row(scope, out->word);
	const struct word_pin *pin;
	int index = word_pin_find(row, name, len);

	if (index < 0)
		return false;
	pin = &row->pin[index];
	if (out->pin < 0)
		out->pin = index;
	out->offset += pin->offset;
	out->type = pin->type;
	if (row->kind == WORD_FB)
		out->writable = pin->dir == PIN_IN;
	if (pin->type == IEC_NONE)
		mean_whole(scope, pin->word, out);
	else
		out->kind = MEANING_PIN;
	return true;
}

static bool has_parts(const struct meaning *m)
{
	return m->kind == MEANING_INSTANCE || m->kind == MEANING_STRUCT;
}

/* `Instance.PIN`, `Recipe.Inner.Speed`; false leaves @out as it was. */
static bool mean_path(const struct scope *scope, uint32_t table,
		      const char *text, size_t len, struct meaning *out,
		      enum diag_id *why)
{
	const char *dot = memchr(text, '.', len), *end = text + len;
	struct names *names = &scope->project->names;
	const struct declared *slot;
	struct meaning part = { 0 };
	uint32_t id;

	if (!dot)
		return false;
	id = names_intern(names, text, (size_t)(dot - text));
	slot = find_declared(scope, table, names_fold(names, id));
	if (!slot)
		return false;
	mean_variable(scope, slot, &part);
	part.pin = -1;
	if (!has_parts(&part))
		return false;
	*why = DIAG_NO_PIN;
	while (dot) {
		const char *name = dot + 1;

		dot = memchr(name, '.', (size_t)(end - name));
		if (!has_parts(&part) ||
		    !mean_part(scope, name,
			       (size_t)((dot ? dot : end) - name), &part))
			return false;
	}
	*out = part;
	return true;
}

static bool mean_system(const char *text, size_t len, struct meaning *out)
{
	if (len < 4 || !ascii_same(text, "SYS_", 4))
		return false;
	for (int i = 0; i < SYS_COUNT; i++) {
		const struct sys_row *row = sys_row((enum sys_id)i);

		if (!ascii_is(row->name, text, len))
			continue;
		out->kind = MEANING_ADDRESS;
		iec_addr_parse(row->address, strlen(row->address), &out->addr);
		out->type = row->type;
		out->writable = may_write(out->addr);
		return true;
	}
	return false;
}

static bool mean_literal(const char *text, size_t len, struct meaning *out,
			 enum diag_id *why)
{
	switch (literal_parse(text, len, &out->literal)) {
	case LITERAL_OK:
		out->kind = MEANING_LITERAL;
		out->type = out->literal.type;
		return true;
	case LITERAL_BAD:
		*why = DIAG_BAD_LITERAL;
		return false;
	case LITERAL_RANGE:
		*why = DIAG_LITERAL_RANGE;
		return false;
	case LITERAL_NONE:
		return false;
	}
	return false;
}

static bool mean_address(const struct scope *scope, const char *text, size_t len,
			 struct meaning *out, enum diag_id *why)
{
	enum iec_addr_result result = iec_addr_parse(text, len, &out->addr);

	if (result == ADDR_OK && !project_has(scope->project, out->addr))
		result = ADDR_RANGE;
	if (result == ADDR_OK) {
		out->kind = MEANING_ADDRESS;
		out->type = iec_addr_type(out->addr);
		out->writable = may_write(out->addr);
		return true;
	}
	out->addr = (struct iec_addr){ .area = AREA_NONE };
	if (result == ADDR_RANGE || *text == '%')
		*why = DIAG_BAD_ADDRESS;
	return false;
}

/* What stands before [: an array, or an address, which is one up to the end of its
 * area. */
static bool mean_array(const struct scope *scope, uint32_t table,
		       const char *text, size_t len, struct meaning *out,
		       enum diag_id *why)
{
	struct names *names = &scope->project->names;
	uint32_t id = names_intern(names, text, len), first;
	const struct declared *slot = find_declared(scope, table,
						    names_fold(names, id));

	if (slot) {
		mean_variable(scope, slot, out);
		*why = DIAG_NOT_ARRAY;
		return out->kind == MEANING_ARRAY;
	}
	if (!mean_address(scope, text, len, out, why))
		return false;
	first = out->addr.byte * 8 + out->addr.bit;
	out->array.count = (project_area_bytes(scope->project, out->addr.area) *
			    8 - first) / out->addr.bits;
	return true;
}

/* The one element of a fixed index, whose type may have values above INT64_MAX. */
static bool mean_fixed(enum iec_type type, int64_t index, struct meaning *out,
		       enum diag_id *why)
{
	int64_t element = var_element(out->array, index);
	bool is_signed = type == IEC_NONE ||
			 iec_type_row(type)->class == CLASS_SIGNED;

	*why = DIAG_INDEX_RANGE;
	if (element < 0 || (!is_signed && index < 0))
		return false;
	if (out->addr.area != AREA_NONE)
		out->addr = vars_shift(out->addr, (uint32_t)element);
	if (out->var)
		out->offset = (uint32_t)element * var_unit(out->var);
	out->array.count = 0;
	return true;
}

static bool is_index(enum iec_type type)
{
	return iec_type_row(type)->class & (ANY_INT | CLASS_BITS);
}

/* Index @text: an integer constant, or an operand that holds one. */
static bool mean_index(struct scope *scope, uint32_t table, const char *text,
		       size_t len, struct meaning *out, enum diag_id *why)
{
	const struct pou *pou = table ? &scope->project->pou[table - 1] : NULL;
	const struct meaning *m = scope_find(scope, pou,
		names_intern(&scope->project->names, text, len), why);
	bool literal = m && m->kind == MEANING_LITERAL;

	if (!m)
		return false;
	*why = DIAG_INDEX_TYPE;
	if (literal && m->literal.high) {
		*why = DIAG_INDEX_RANGE;
		return false;
	}
	if (literal)
		return !m->literal.real &&
		       (m->type == IEC_NONE || is_index(m->type)) &&
		       mean_fixed(m->type, m->literal.value.i, out, why);
	if (meaning_fault(m) != DIAG_COUNT || !is_index(m->type))
		return false;
	out->index_of = m;
	if (m->kind == MEANING_VARIABLE && m->constant && m->var->has_init)
		return mean_fixed(m->type, m->var->init.i, out, why);
	return true;
}

/* `Table[3]`, `Table[i]`, `%MW0[i]`; there may be blanks inside. */
static bool mean_element(struct scope *scope, uint32_t table, const char *text,
			 size_t len, struct meaning *out, enum diag_id *why)
{
	const char *open = memchr(text, '[', len), *at = open + 1;
	const char *end = text + len - 1;
	size_t head = (size_t)(open - text);

	while (head && text[head - 1] == ' ')
		head--;
	while (at < end && *at == ' ')
		at++;
	while (at < end && end[-1] == ' ')
		end--;
	if (*text == '[' || at == end || memchr(at, '[', (size_t)(end - at)))
		return false;
	if (!mean_array(scope, table, text, head, out, why) ||
	    !mean_index(scope, table, at, (size_t)(end - at), out, why))
		return false;
	out->kind = out->var || out->array.count ? MEANING_ELEMENT
						 : MEANING_ADDRESS;
	return true;
}

static bool has_index(const char *text, size_t len)
{
	return len > 0 && text[len - 1] == ']' && memchr(text, '[', len);
}

/* Declared names first, then system names, pins, constants and addresses. */
static bool mean(struct scope *scope, uint32_t table, uint32_t id,
		 struct meaning *out, enum diag_id *why)
{
	struct names *names = &scope->project->names;
	const char *text = names_text(names, id);
	size_t len = names_len(names, id);
	const struct declared *slot;

	*why = DIAG_UNKNOWN_NAME;
	slot = find_declared(scope, table, names_fold(names, id));
	if (slot) {
		mean_variable(scope, slot, out);
		return true;
	}
	if (has_index(text, len))
		return mean_element(scope, table, text, len, out, why);
	return mean_system(text, len, out) ||
	       mean_path(scope, table, text, len, out, why) ||
	       mean_literal(text, len, out, why) ||
	       mean_address(scope, text, len, out, why);
}

enum diag_id meaning_fault(const struct meaning *meaning)
{
	if (meaning->kind == MEANING_INSTANCE)
		return DIAG_INSTANCE_AS_VALUE;
	return meaning->kind == MEANING_ARRAY ? DIAG_ARRAY_AS_VALUE : DIAG_COUNT;
}

/* The answer that was given to this question; NULL: none so far. */
static struct answer *find_answer(const struct scope *scope, uint32_t table,
				  uint32_t text)
{
	struct answer *answer = text < scope->answers ? scope->answer[text] : NULL;

	while (answer && answer->table != table)
		answer = answer->next;
	return answer;
}

/* Room for the answer to a question that was not asked yet; NULL: no memory. */
static struct answer *add_answer(struct scope *scope, uint32_t table,
				 uint32_t text)
{
	struct answer *answer = arena_alloc(scope->arena, sizeof(*answer));
	uint32_t size = (uint32_t)scope->project->names.count + 64;

	if (text >= scope->answers) {
		size += size / 4;
		scope->answer = arena_grow(scope->arena, scope->answer,
					   scope->answers * sizeof(*scope->answer),
					   size * sizeof(*scope->answer));
		scope->answers = scope->answer ? size : 0;
	}
	if (!answer || !scope->answer)
		return NULL;
	answer->table = table;
	answer->next = scope->answer[text];
	scope->answer[text] = answer;
	return answer;
}

const struct meaning *scope_find(struct scope *scope, const struct pou *pou,
				 uint32_t text, enum diag_id *why)
{
	uint32_t table = table_number(scope, pou);
	struct answer *answer;

	*why = DIAG_UNKNOWN_NAME;
	if (!text)
		return NULL;
	answer = find_answer(scope, table, text);
	if (!answer) {
		*why = DIAG_NO_MEMORY;
		answer = add_answer(scope, table, text);
		if (!answer)
			return NULL;
		answer->known = mean(scope, table, text, &answer->meaning, why);
		answer->why = *why;
	}
	*why = answer->why;
	return answer->known ? &answer->meaning : NULL;
}

const struct pou *scope_pou(struct scope *scope, const struct pou *pou, uint32_t text)
{
	uint32_t fold = names_fold(&scope->project->names, text);
	const struct declared *slot;

	if (!fold || find_declared(scope, table_number(scope, pou), fold))
		return NULL;
	slot = declared_slot(scope, POUS, fold);
	return slot->fold ? &scope->project->pou[slot->index] : NULL;
}

bool scope_add(struct scope *scope, const struct pou *pou,
	       const struct var *var, int index)
{
	uint32_t table = table_number(scope, pou);
	struct answer *answer = find_answer(scope, table, var->name);

	if (!answer)
		answer = add_answer(scope, table, var->name);
	if (!answer)
		return false;
	answer->known = true;
	answer->meaning = (struct meaning){
		.kind = MEANING_VARIABLE, .type = var->type, .pou = pou,
		.var = var, .index = index, .writable = true,
	};
	return true;
}

uint32_t scope_size(const struct scope *scope, const struct meaning *meaning)
{
	struct word_pin like = { .type = meaning->type, .word = meaning->word };

	return shape_of(&scope->project->words, &like).size;
}

struct project *scope_project(const struct scope *scope)
{
	return scope->project;
}

const struct word_row *scope_row(const struct scope *scope, enum word word)
{
	return words_row(&scope->project->words, word);
}

const char *scope_text(const struct scope *scope, uint32_t id)
{
	return names_text(&scope->project->names, id);
}
