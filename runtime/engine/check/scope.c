/* SPDX-License-Identifier: MIT
 *
 * scope - from the text of an operand to its meaning.
 *
 * Two hashes: the declared names of all tables, and the answers by (POU, string id).
 * An answer never moves. It reports nothing, because only the caller knows the place.
 */
#include "engine/check/scope.h"

#include "engine/base/ascii.h"
#include "engine/base/name.h"
#include "engine/model/expr.h"
#include "engine/model/fbd.h"
#include "engine/model/named.h"
#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>

/* A declaration; table 0 is the globals, POU number n has n + 1. */
struct declared {
	uint32_t table, fold;
	int index;            /* of the first declaration of this name */
	uint16_t flags;        /* of its VAR block */
};

/* An answer: the meaning of a text in a table, or the reason why it has none. */
struct answer {
	struct answer *next; /* of the same bucket                           */
	uint32_t table;
	enum diag_id why : 16;
	bool known;
	bool made;           /* scope_add(): the same in all networks        */
	uint32_t text;
	struct meaning meaning;
};

struct scope {
	struct project *project;
	struct areas areas;
	struct arena *arena;
	struct declared *declared; /* in the order of the file; 0 is none     */
	uint32_t *slot;            /* open hash of their numbers: small, so that
				      most of it stays in a cache             */
	uint32_t count, mask;
	struct answer **answer; /* buckets, by table and text                */
	uint32_t answers, buckets; /* @buckets: 0 or a power of 2             */
	uint32_t *owner;        /* by table: that of the POU whose action it is; 0: none */
	bool actions;           /* there are some                            */
	bool several;           /* a value of several enumerations, with other numbers */
	uint32_t wired;         /* the table whose wires are seen; 0: none   */
	uint32_t network;       /* those of this network, from 1             */
#define WIRED 64
	struct answer *inside[WIRED]; /* by text: the answers in this network */
};

#define POUS UINT32_MAX         /* the table of the names of POUs */
#define VALUES (UINT32_MAX - 1) /* that of values of enumerations */

static uint32_t mix(uint32_t table, uint32_t id)
{
	uint32_t hash = id * 2654435761u ^ table * 2246822519u;

	return hash ^ hash >> 15;
}

/* The slot of a name, or the free one where it belongs. */
static uint32_t *declared_slot(const struct scope *scope, uint32_t table, uint32_t fold)
{
	uint32_t at = mix(table, fold) & scope->mask;

	for (; scope->slot[at]; at = (at + 1) & scope->mask) {
		const struct declared *declared = &scope->declared[scope->slot[at]];

		if (declared->fold == fold && declared->table == table)
			break;
	}
	return &scope->slot[at];
}

/* NULL: this table has no such name. */
static const struct declared *find_in(const struct scope *scope, uint32_t table,
				      uint32_t fold)
{
	uint32_t number = fold ? *declared_slot(scope, table, fold) : 0;

	return number ? &scope->declared[number] : NULL;
}

/* Adds a name, unless the table has it. */
static void declare(struct scope *scope, struct declared declared)
{
	uint32_t *slot;

	if (!declared.fold)
		return;
	slot = declared_slot(scope, declared.table, declared.fold);
	if (*slot)
		return;
	*slot = ++scope->count;
	scope->declared[*slot] = declared;
}

static void declare_table(struct scope *scope, uint32_t table,
			  const struct var_table *vars)
{
	int block = 0;

	for (int i = 0; i < vars->count; i++) {
		struct declared declared = { .table = table, .index = i,
					     .fold = vars->var[i].fold };

		while (block + 1 < vars->block_count &&
		       vars->block[block + 1].first <= i)
			block++;
		if (block < vars->block_count)
			declared.flags = vars->block[block].flags;
		declare(scope, declared);
	}
}

static void declare_pous(struct scope *scope)
{
	struct project *project = scope->project;

	for (int i = 0; i < project->pou_count; i++)
		declare(scope, (struct declared){
			.table = POUS, .index = i,
			.fold = names_fold(&project->names, project->pou[i].name),
		});
}

static void declare_values(struct scope *scope)
{
	const struct enum_value *value = scope->project->enum_value;

	for (int i = 0; i < scope->project->enum_value_count; i++) {
		const struct declared *first = find_in(scope, VALUES, value[i].fold);

		scope->several |= first && value[first->index].number != value[i].number;
		declare(scope, (struct declared){ .table = VALUES, .index = i, .fold = value[i].fold });
	}
}

uint32_t scope_within(struct scope *scope, const char *path)
{
	const size_t len = strlen(path);
	char *text = arena_alloc(scope->arena, len + 1);

	if (!text)
		return 0;
	text[0] = SCOPE_WITHIN;
	memcpy(text + 1, path, len);
	return names_intern(&scope->project->names, text, len + 1);
}

bool scope_has_several(const struct scope *scope)
{
	return scope->several;
}

struct scope *scope_new(struct project *project, struct arena *arena)
{
	struct scope *scope = arena_alloc(arena, sizeof(*scope));
	size_t names = (size_t)project->globals.count +
		       (size_t)project->pou_count + (size_t)project->enum_value_count;
	uint32_t size = 16;

	if (!scope)
		return NULL;
	for (int i = 0; i < project->pou_count; i++)
		names += (size_t)project->pou[i].vars.count;
	while (size < names * 2)
		size *= 2;
	scope->project = project;
	project_areas(project, &scope->areas);
	scope->arena = arena;
	scope->mask = size - 1;
	scope->slot = arena_alloc(arena, size * sizeof(*scope->slot));
	scope->declared = arena_alloc(arena, (names + 1) * sizeof(struct declared));
	scope->owner = arena_alloc(arena, ((size_t)project->pou_count + 1) * sizeof(*scope->owner));
	if (!scope->slot || !scope->declared || !scope->owner)
		return NULL;
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_ACTION)
			scope->actions = true, scope->owner[i + 1] = (uint32_t)(pou_owner(project, &project->pou[i]) + 1);
	declare_table(scope, 0, &project->globals);
	for (int i = 0; i < project->pou_count; i++)
		declare_table(scope, (uint32_t)i + 1, &project->pou[i].vars);
	declare_pous(scope);
	declare_values(scope);
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
	const struct declared *first = find_in(scope, table, fold);

	return first && first->index < index ? first->index : -1;
}

/* The local of this name, or of the POU whose action it is, else the global; NULL: neither. */
static const struct declared *find_declared(const struct scope *scope,
					    uint32_t table, uint32_t fold)
{
	const struct declared *declared = NULL;

	if (table_of(scope, table)->count)
		declared = find_in(scope, table, fold);
	if (!declared && scope->owner[table])
		declared = find_in(scope, scope->owner[table], fold);
	return declared || !table ? declared : find_in(scope, 0, fold);
}

static bool may_write(struct iec_addr addr)
{
	return addr.area == AREA_NONE ||
	       iec_area_row(addr.area)->access == ACCESS_WRITE;
}

const struct word_row *scope_row(const struct scope *scope, enum word word)
{
	return words_row(&scope->project->words, word);
}

/* Makes @out a part or whole of @word. */
static void scope_mean_whole(const struct scope *scope, enum word word,
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

/* A value, or something with parts. */
static void mean_shape(const struct scope *scope, const struct var *var,
		       struct meaning *out)
{
	out->kind = MEANING_VARIABLE;
	if (var->array.count) {
		out->kind = MEANING_ARRAY;
		out->array = var->array;
		out->dim = var->dim;
		out->dims = var->dims;
		out->word = var->fb;
		out->capacity = var->capacity;
		out->stride = shape_of_var(&scope->project->words, var).unit;
	} else if (var->type == IEC_NONE && var->fb) {
		scope_mean_whole(scope, var->fb, out);
	}
}

bool scope_is_condition(const struct meaning *meaning)
{
	const struct pou *pou = meaning->pou;

	return pou && pou->sfc && pou->sfc->block >= 0 &&
	       meaning->kind == MEANING_VARIABLE &&
	       meaning->index == sfc_condition(pou->sfc, &pou->vars);
}

static void mean_variable(const struct scope *scope,
			  const struct declared *slot, struct meaning *out)
{
	const struct var *var =
		&table_of(scope, slot->table)->var[slot->index];

	out->pou = slot->table ? &scope->project->pou[slot->table - 1] : NULL;
	out->var = out->like = var;
	out->index = slot->index;
	out->addr = var->at;
	out->type = var->type;
	out->constant = slot->flags & VAR_CONSTANT;
	out->writable = !out->constant && may_write(var->at) &&
			!(slot->flags & VAR_INPUT && slot->flags & VAR_FIXED);
	mean_shape(scope, var, out);
	if (slot->flags & VAR_SFC)
		out->writable = slot->flags & VAR_WIRE || scope_is_condition(out);
}

/* The error of a step's name without .X or .T. */
static bool is_step(const struct scope *scope, uint32_t table, const char *text,
		    size_t len, enum diag_id *why)
{
	const struct sfc *sfc = table ? scope->project->pou[table - 1].sfc : NULL;
	const char *dot = memchr(text, '.', len);
	char x[LIMIT_NAME + 8];
	struct names *names = &scope->project->names;
	const struct declared *slot;

	if (dot)
		len = (size_t)(dot - text);
	if (!sfc || !len || len > LIMIT_NAME)
		return false;
	memcpy(x, text, len);
	memcpy(x + len, ".X", 2);
	slot = find_in(scope, table, names_fold(names, names_intern(names, x, len + 2)));
	*why = dot ? DIAG_NO_PIN : DIAG_SFC_STEP;
	return slot && slot->flags & VAR_SFC;
}

static struct answer *find_answer(const struct scope *scope, uint32_t table, uint32_t text);
static const struct declared *find_wire(const struct scope *scope, uint32_t table, const char *text, size_t len);

/* A declared name alone. Scan-safe: no. False: it is none. */
static bool scope_mean_name(const struct scope *scope, uint32_t table, const char *text,
			    size_t len, struct meaning *out)
{
	struct names *names = &scope->project->names;
	uint32_t id = names_intern(names, text, len);
	const struct declared *slot = find_declared(scope, table,
						    names_fold(names, id));
	if (!slot)
		slot = find_wire(scope, table, text, len);
	const struct answer *made = *text != '_' ? NULL : find_answer(scope, table, id);

	if (slot && !(made && made->made))
		mean_variable(scope, slot, out);
	else if (made && made->known && made->meaning.var) /* scope_add() */
		*out = made->meaning;
	else
		return false;
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

/* ---- values of enumerations ---- */

static void mean_value(const struct scope *scope, const struct enum_value *value,
		       enum iec_type type, struct meaning *out)
{
	const char *text = names_text(&scope->project->names, value->name);

	out->kind = MEANING_LITERAL;
	out->type = type;
	out->literal = (struct literal){ .type = type, .value = { .i = value->number },
					 .text = text, .len = strlen(text) };
}

/* `Red`. If several enumerations have it, they are of one type of number: the place says which is meant. */
static bool mean_plain_value(const struct scope *scope, uint32_t fold, struct meaning *out,
			     enum diag_id *why)
{
	const struct declared *declared = find_in(scope, VALUES, fold);
	const struct project *project = scope->project;
	const struct enum_value *value;
	enum iec_type type;
	bool several = false;

	if (!declared)
		return false;
	value = &project->enum_value[declared->index];
	type = project->enumeration[value->enumeration].type;
	for (int i = declared->index + 1; i < project->enum_value_count; i++) {
		const struct enum_value *other = &project->enum_value[i];

		if (other->fold != fold || other->number == value->number)
			continue;
		several = true;
		if (project->enumeration[other->enumeration].type != type) {
			*why = DIAG_AMBIGUOUS_VALUE;
			return false;
		}
	}
	mean_value(scope, value, type, out);
	out->several = several;
	return true;
}

/* The number of the enumeration of the type with this name; -1: it has none. */
static int value_list(const struct scope *scope, const char *text, size_t len)
{
	struct names *names = &scope->project->names;
	const int type = named_find(scope->project,
				    names_fold(names, names_intern(names, text, len)));
	const struct var *like = type < 0 ? NULL : scope->project->named[type].like.var;

	return like ? like->enumeration - 1 : -1;
}

/* `Color#Red`, and `Color.Red` as others write it; @at: of the sign. */
static bool mean_typed_value(const struct scope *scope, const char *text, size_t len, size_t at,
			     struct meaning *out, enum diag_id *why)
{
	struct names *names = &scope->project->names;
	const int list = value_list(scope, text, at);
	const struct enum_value *value;

	if (list < 0)
		return false;
	value = named_value(scope->project, list, names_fold(names,
			    names_intern(names, text + at + 1, len - at - 1)));
	*why = DIAG_NO_SUCH_VALUE;
	if (value)
		mean_value(scope, value, scope->project->enumeration[list].type, out);
	return value != NULL;
}

int scope_value(const struct scope *scope, const char *text, size_t len, size_t *head)
{
	struct names *names = &scope->project->names;
	struct meaning m = { .kind = MEANING_NONE };
	const struct enum_value *value;
	const char *sign = memchr(text, '#', len);
	enum diag_id why;
	uint32_t fold;
	int list;

	if (!sign)
		sign = memchr(text, '.', len);
	*head = sign ? (size_t)(sign - text) + 1 : 0;
	fold = names_fold(names, names_intern(names, text + *head, len - *head));
	if (sign) {
		list = value_list(scope, text, *head - 1);
		value = list < 0 ? NULL : named_value(scope->project, list, fold);
		return value ? (int)(value - scope->project->enum_value) : -1;
	}
	return mean_plain_value(scope, fold, &m, &why) && !m.several ? find_in(scope, VALUES, fold)->index : -1;
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

/* A direct address. Scan-safe: no. */
static bool scope_mean_address(const struct scope *scope, const char *text, size_t len,
			       struct meaning *out, enum diag_id *why)
{
	enum diag_id fault = iec_addr_fault(text, len, &out->addr);

	if (fault == DIAG_COUNT && !areas_have(&scope->areas, out->addr))
		fault = DIAG_BAD_ADDRESS;
	if (fault == DIAG_COUNT) {
		out->literal = (struct literal){ 0 }; /* of an attempt to read one */
		out->kind = MEANING_ADDRESS;
		out->type = iec_addr_type(out->addr);
		out->writable = may_write(out->addr);
		return true;
	}
	out->addr = (struct iec_addr){ .area = AREA_NONE };
	if (fault != DIAG_NOT_ADDRESS || *text == '%')
		*why = fault;
	return false;
}

/* A path that is being resolved. */
struct path {
	struct scope *scope;
	uint32_t table;
	const char *at, *end;
	struct meaning m;        /* meaning of the path so far                */
	int pin;                 /* the first part that was named; -1: none   */
	struct open_index *open; /* room for LIMIT_INDICES, and a pointer     */
	int opens;
	const struct meaning *index_of, *pointer;
	enum diag_id why;
	bool raw;                /* a REFERENCE is meant, not what it leads to */
	bool within;             /* variables within blocks have names, too    */
	bool done;               /* a part was named: nothing can follow it   */
	uint32_t count;          /* elements of the array that a pointer leads to: others may be read, too */
};

static bool refuse(struct path *path, enum diag_id why)
{
	path->why = why;
	return false;
}

static void skip_blanks(struct path *path)
{
	while (path->at < path->end && *path->at == ' ')
		path->at++;
}

/* The text up to the next @stops, without the blanks at its ends; the path goes to
 * the character that stopped it. */
static size_t take(struct path *path, const char *stops, const char **text)
{
	size_t len;

	skip_blanks(path);
	*text = path->at;
	while (path->at < path->end && !strchr(stops, *path->at))
		path->at++;
	len = (size_t)(path->at - *text);
	while (len && (*text)[len - 1] == ' ')
		len--;
	return len;
}

static bool has_parts(const struct meaning *m)
{
	return m->kind == MEANING_INSTANCE || m->kind == MEANING_STRUCT;
}

struct project *scope_project(const struct scope *scope)
{
	return scope->project;
}

/* A part that @pin declares. */
static void mean_pin(const struct scope *scope, const struct word_pin *pin,
		     struct meaning *m)
{
	m->offset += pin->offset;
	if (m->addr.area != AREA_NONE && !m->through) {
		m->addr.byte += pin->offset;
		m->addr.bit = 0;
		m->addr.bits = pin->type == IEC_BOOL ? 1 : pin->type == IEC_NONE ? 8 :
			       (uint8_t)(8 * iec_type_row(pin->type)->size);
	}
	m->type = pin->type;
	m->array = pin_array(pin);
	if (pin->elements) {
		m->kind = MEANING_ARRAY;
		m->dim = m->like ? m->like->dim : NULL;
		m->dims = m->like ? m->like->dims : 0;
		m->word = pin->type == IEC_NONE ? pin->word : 0;
		m->capacity = pin->type == IEC_NONE ? 0 : pin->capacity;
		m->stride = shape_of(&scope_project(scope)->words, pin).unit;
	} else if (pin->type == IEC_NONE) {
		scope_mean_whole(scope, pin->word, m);
	} else {
		m->kind = MEANING_PIN;
	}
}

/* The variable that pin @index of @word was made from; NULL: it is of the catalogue. */
static const struct var *declares(const struct scope *scope, uint16_t word, int index)
{
	const struct var_table *table = shape_vars(scope->project, (enum word)word);

	return table && index < table->count ? &table->var[index] : NULL;
}

static bool step_part(struct path *path, struct expr_tail tail);
static bool follow_on(struct path *path);

/* The action @name of the POU @owner; -1: it has none. */
static int action_of(struct scope *scope, const struct pou *owner, const char *name, size_t len)
{
	struct project *project = scope->project;
	char text[2 * LIMIT_NAME + 2];
	const int size = snprintf(text, sizeof(text), "%s.%.*s", project_text(project, owner->name),
				  (int)(len < LIMIT_NAME ? len : LIMIT_NAME), name);
	const struct declared *found = find_in(scope, POUS, names_fold(&project->names,
					       names_intern(&project->names, text, (size_t)size)));

	return found && project->pou[found->index].kind == POU_ACTION ? found->index : -1;
}

/* `Pump.Reset`, an action of a block. */
static bool step_action(struct path *path, const struct word_row *row, const char *name, size_t len)
{
	const struct project *project = path->scope->project;
	const int action = row->kind == WORD_FB && row->owner >= 0 && !path->m.action ?
			   action_of(path->scope, &project->pou[row->owner], name, len) : -1;

	path->m.action = (uint16_t)(action + 1);
	return action >= 0 || refuse(path, DIAG_NO_PIN);
}

/* The members of a union are looked at through a pointer to its variable: memory has one type. */
static bool step_overlapped(struct path *path)
{
	struct meaning *m = &path->m, *pointer;

	if (m->through || !m->var)
		return true;
	pointer = arena_alloc(path->scope->arena, sizeof(*pointer));
	if (!pointer)
		return refuse(path, DIAG_NO_MEMORY);
	*pointer = (struct meaning){ .kind = MEANING_PIN, .type = IEC_LWORD, .index = m->index, .pou = m->pou,
				     .var = m->var, .address_of = m->var->name };
	path->pointer = pointer;
	path->count = 0;
	m->through = true;
	return true;
}

/* A variable within a block of the project, which its outside has no name for; -1: none. */
static int find_within(const struct word_row *row, const char *name, size_t len)
{
	for (int i = 0; row->kind == WORD_FB && row->owner >= 0 && i < row->pin_count; i++)
		if (row->pin[i].dir == PIN_VAR && len && name_is(row->pin[i].name, name, len))
			return i;
	return -1;
}

/* Only plain IEC text stores into what is inside of a block. */
static bool may_store(const struct path *path, enum pin_dir dir)
{
	return path->within || ((dir == PIN_IN || dir == PIN_VAR) &&
				(!path->m.within || path->scope->project->words.own_first));
}

/* `.Speed`. Inner variables of a block of the project can be read from outside. */
static bool step_into(struct path *path)
{
	struct meaning *m = &path->m;
	const struct word_row *row;
	const char *name;
	size_t len;
	int index;

	path->at++;
	if (!follow_on(path))
		return false;
	len = take(path, ".[^", &name);
	if (len && (*name == '%' || ascii_digit(*name)))
		return step_part(path, (struct expr_tail){ name, (uint16_t)len });
	if (!has_parts(m)) /* the name itself has no dots behind it */
		return refuse(path, m->kind == MEANING_VARIABLE ?
				    DIAG_UNKNOWN_NAME : DIAG_NO_PIN);
	row = scope_row(path->scope, m->word);
	index = m->kind == MEANING_INSTANCE && m->action ? -1 : word_pin_find(row, name, len);
	if (index < 0 && !m->action && word_is_own(m->word))
		index = find_within(row, name, len);
	if (index < 0)
		return step_action(path, row, name, len);
	if (path->pin < 0)
		path->pin = index;
	m->within |= row->kind == WORD_FB && row->pin[index].dir == PIN_VAR;
	if (row->kind == WORD_FB)
		m->writable = may_store(path, row->pin[index].dir);
	if (row->overlaps && !step_overlapped(path))
		return false;
	m->like = declares(path->scope, m->word, index);
	mean_pin(path->scope, &row->pin[index], m);
	return true;
}

enum diag_id meaning_fault(const struct meaning *meaning)
{
	if (meaning->kind == MEANING_INSTANCE)
		return DIAG_INSTANCE_AS_VALUE;
	return meaning->kind == MEANING_ARRAY ? DIAG_ARRAY_AS_VALUE : DIAG_COUNT;
}

void scope_network(struct scope *scope, const struct pou *pou, int network)
{
	memset(scope->inside, 0, sizeof(scope->inside));
	scope->wired = network < 0 ? 0 : table_number(scope, pou);
	scope->network = (uint32_t)(network + 1);
}

/* The network whose wires are seen among the names of @table; 0: none. */
static uint32_t network_in(const struct scope *scope, uint32_t table)
{
	return table && scope->wired == table ? scope->network : 0;
}

/* A wire of the present network. */
static const struct declared *find_wire(const struct scope *scope, uint32_t table, const char *text, size_t len)
{
	const uint32_t network = network_in(scope, table);
	struct names *names = &scope->project->names;
	const uint32_t id = network && len <= LIMIT_NAME && !memchr(text, '.', len) ?
		fbd_wire_name(names, text, len, (int)network - 1, false) : 0;

	return id ? find_in(scope, table, names_fold(names, id)) : NULL;
}

/* The texts of a POU have numbers one after another, and so their answers lie in buckets beside each other. */
static uint32_t answer_bucket(uint32_t buckets, uint32_t table, uint32_t text)
{
	return (text + table * 2654435761u) & (buckets - 1);
}

/* The earlier answer to this question; NULL: none. */
static struct answer *find_answer(const struct scope *scope, uint32_t table,
				  uint32_t text)
{
	const uint32_t network = network_in(scope, table);
	struct answer *answer;

	if (network)
		for (struct answer *inside = scope->inside[text % WIRED]; inside; inside = inside->next)
			if (inside->text == text)
				return inside;
	answer = scope->answers ? scope->answer[answer_bucket(scope->buckets, table, text)] : NULL;
	while (answer && (answer->text != text || answer->table != table || (network && !answer->made)))
		answer = answer->next;
	return answer;
}

static void put_answer(struct answer **bucket, uint32_t buckets, struct answer *answer)
{
	struct answer **at = &bucket[answer_bucket(buckets, answer->table, answer->text)];

	answer->next = *at;
	*at = answer;
}

/* Twice as many buckets when there are as many answers. False: no memory. */
static bool more_buckets(struct scope *scope)
{
	const uint32_t buckets = scope->buckets ? 2 * scope->buckets : 64;
	struct answer **bucket;

	if (scope->answers < scope->buckets)
		return true;
	bucket = arena_alloc(scope->arena, buckets * sizeof(*bucket));
	if (!bucket)
		return false;
	for (uint32_t i = 0; i < scope->buckets; i++) {
		for (struct answer *answer = scope->answer[i], *next; answer; answer = next) {
			next = answer->next;
			put_answer(bucket, buckets, answer);
		}
	}
	scope->answer = bucket;
	scope->buckets = buckets;
	return true;
}

/* Room for a new answer; NULL: no memory. */
static struct answer *add_answer(struct scope *scope, uint32_t table,
				 uint32_t text)
{
	struct answer *answer = arena_alloc(scope->arena, sizeof(*answer));

	if (!answer)
		return NULL;
	answer->table = table;
	answer->text = text;
	if (network_in(scope, table)) {
		answer->next = scope->inside[text % WIRED];
		scope->inside[text % WIRED] = answer;
		return answer;
	}
	if (!more_buckets(scope))
		return NULL;
	put_answer(scope->answer, scope->buckets, answer);
	scope->answers++;
	return answer;
}

static bool mean(struct scope *scope, uint32_t table, uint32_t id,
		 struct meaning *out, enum diag_id *why);

/* The name behind a NAMESPACE. */
static bool mean_in_space(struct scope *scope, uint32_t table, uint32_t id, struct meaning *out, enum diag_id *why)
{
	struct names *names = &scope->project->names;
	const char *text = names_text(names, id);
	size_t len = names_len(names, id);

	return words_strip(&scope->project->words, &text, &len) &&
	       mean(scope, table, names_intern(names, text, len), out, why);
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
		answer->known = mean(scope, table, text, &answer->meaning, why) ||
				mean_in_space(scope, table, text, &answer->meaning, why);
		answer->why = *why;
	}
	*why = answer->why;
	return answer->known ? &answer->meaning : NULL;
}

/* ---- indices ---- */

/* The bounds of the next index. */
static struct var_array outer(const struct meaning *m)
{
	return m->dims > 1 ? m->dim[0] : m->array;
}

/* Elements from one of its values to the next. */
static uint32_t each(const struct meaning *m)
{
	return m->dims > 1 ? vars_flat(m->dim + 1, m->dims - 1).count : 1;
}

/* The element at a fixed index, or the first of the possible elements; of several dimensions
 * a smaller array. */
static void mean_element(struct path *path, uint32_t number)
{
	struct meaning *m = &path->m;

	number *= each(m);
	if (m->addr.area != AREA_NONE && m->var && m->var->type == IEC_NONE)
		m->addr.byte += number * m->stride; /* of a structure, where a BOOL has a byte */
	else if (m->addr.area != AREA_NONE)
		m->addr = vars_shift(m->addr, number);
	if (m->var)
		m->offset += number * m->stride;
	if (m->dims > 1) {
		m->array = vars_flat(++m->dim, --m->dims);
		return;
	}
	m->dims = 0;
	m->array.count = 0;
	m->kind = m->var ? MEANING_ELEMENT : MEANING_ADDRESS;
	if (m->var && m->type == IEC_NONE)
		scope_mean_whole(path->scope, m->word, m);
}

/* A fixed index of a type with values above INT64_MAX. */
static bool step_fixed(struct path *path, enum iec_type type, int64_t index)
{
	int64_t number = var_element(outer(&path->m), index);
	bool is_signed = type == IEC_NONE ||
			 iec_type_row(type)->class == CLASS_SIGNED;

	if (number < 0 || (!is_signed && index < 0))
		return refuse(path, DIAG_INDEX_RANGE);
	mean_element(path, (uint32_t)number);
	return true;
}

static bool step_open(struct path *path, const struct meaning *index)
{
	if (path->opens == LIMIT_INDICES)
		return refuse(path, DIAG_INDICES_MANY);
	if (!path->opens)
		path->index_of = index;
	path->open[path->opens++] = (struct open_index){
		outer(&path->m), path->m.stride * each(&path->m), index,
	};
	mean_element(path, 0);
	return true;
}

static bool is_index(enum iec_type type)
{
	return iec_type_row(type)->class & (ANY_INT | CLASS_BITS);
}

static const struct pou *pou_of(const struct scope *scope, uint32_t table)
{
	return table ? &scope_project(scope)->pou[table - 1] : NULL;
}

/* Index @text: an integer constant, or an operand that holds one. */
static bool step_index(struct path *path, const char *text, size_t len)
{
	struct names *names = &scope_project(path->scope)->names;
	const struct meaning *m = scope_find(path->scope,
		pou_of(path->scope, path->table),
		names_intern(names, text, len), &path->why);
	bool literal = m && m->kind == MEANING_LITERAL;

	if (!m)
		return false;
	if (m->several)
		return refuse(path, DIAG_AMBIGUOUS_VALUE);
	if (literal && m->literal.high)
		return refuse(path, DIAG_INDEX_RANGE);
	if (literal && (m->literal.real ||
			(m->type != IEC_NONE && !is_index(m->type))))
		return refuse(path, DIAG_INDEX_TYPE);
	if (literal)
		return step_fixed(path, m->type, m->literal.value.i);
	if (meaning_fault(m) != DIAG_COUNT || !is_index(m->type))
		return refuse(path, DIAG_INDEX_TYPE);
	if (m->kind == MEANING_VARIABLE && m->constant && m->var->has_init) {
		if (!path->opens)
			path->index_of = m;
		return step_fixed(path, m->type, m->var->init.i);
	}
	return step_open(path, m);
}

/* `[3]`, `[ i ]`, `[3, i]`. */
static bool step_element(struct path *path)
{
	const char *text;
	size_t len;
	char stop;

	if (!follow_on(path))
		return false;
	do {
		path->at++;
		len = take(path, "[],", &text);
		if (!len || path->at == path->end || *path->at == '[')
			return refuse(path, DIAG_UNKNOWN_NAME);
		stop = *path->at;
		if (path->m.kind != MEANING_ARRAY)
			return refuse(path, DIAG_NOT_ARRAY);
		if (!step_index(path, text, len))
			return false;
	} while (stop == ',');
	path->at++;
	return true;
}

const struct areas *scope_areas(const struct scope *scope)
{
	return &scope->areas;
}

/* @m has @count indices that are computed in the scan, the last of which is the pointer that leads to
 * it, if one does. Scan-safe: no. Fails: false when memory is out. */
static bool scope_keep_open(struct scope *scope, struct meaning *m,
			    const struct open_index *open, int count)
{
	struct open_index *kept = arena_alloc(scope->arena,
					      (size_t)count * sizeof(*kept));

	if (!kept)
		return false;
	memcpy(kept, open, (size_t)count * sizeof(*kept));
	m->open = kept;
	m->opens = (uint8_t)(count - m->through);
	return true;
}

static bool finish(struct path *path, struct meaning *out)
{
	struct meaning *m = &path->m;

	m->index_of = path->index_of;
	if (path->opens > 1 && m->addr.area != AREA_NONE && m->type == IEC_BOOL)
		return refuse(path, DIAG_AT_INDEX);
	if (m->through && m->kind == MEANING_ARRAY && m->array.count == LIMIT_ELEMENTS)
		m->array.count = path->count;
	if (m->through)
		path->open[path->opens++] = (struct open_index){ .of = path->pointer };
	if (path->opens) {
		if (!meaning_is_whole(m))
			m->kind = MEANING_ELEMENT;
		if (!scope_keep_open(path->scope, m, path->open, path->opens))
			return refuse(path, DIAG_NO_MEMORY);
	} else if (path->pin >= 0 && m->kind != MEANING_ARRAY) {
		m->pin = path->pin;
		if (m->kind == MEANING_ELEMENT)
			m->kind = MEANING_PIN;
	}
	*out = *m;
	return true;
}

/* What a pointer at @path leads to. */
static bool mean_target(struct path *path, const struct var_target *target)
{
	const struct var *like = target->like;
	struct meaning *pointer = arena_alloc(path->scope->arena, sizeof(*pointer));

	if (!pointer)
		return refuse(path, DIAG_NO_MEMORY);
	if (!finish(path, pointer))
		return false;
	path->pointer = pointer;
	path->opens = 0;
	path->pin = -1;
	path->index_of = NULL;
	path->m = (struct meaning){
		.kind = MEANING_ELEMENT, .type = like->type, .like = like->target ? like : NULL,
		.writable = true, .index = pointer->index, .pou = pointer->pou,
		.var = pointer->var, .through = true,
	};
	if (like->array.count) {
		path->m.kind = MEANING_ARRAY;
		path->m.stride = shape_of_var(&scope_project(path->scope)->words, like).unit;
		path->m.dim = like->dim;
		path->m.dims = like->dims;
		path->m.word = (uint16_t)like->fb;
		path->m.capacity = like->capacity;
		path->m.array = like->array;
		path->count = like->array.count;
		if (like->dims < 2 && like->type != IEC_NONE && like->type != IEC_STRING)
			path->m.array.count = LIMIT_ELEMENTS;
	} else if (like->type == IEC_NONE) {
		path->m.word = (uint16_t)like->fb;
		scope_mean_whole(path->scope, like->fb, &path->m);
	}
	return true;
}

/* A REFERENCE TO is what it leads to. */
static bool follow_on(struct path *path)
{
	const struct var_target *target = path->m.kind != MEANING_LITERAL && path->m.like ?
					  path->m.like->target : NULL;

	if (!target || target->word != REFERENCE_TO || path->m.kind == MEANING_ARRAY)
		return true;
	return mean_target(path, target);
}

/* The same at the end of a path, unless the place of the reference itself is meant. */
static bool follow(struct path *path)
{
	return path->raw || follow_on(path);
}

/* `^` behind a pointer: what it points to. Its element, if that is an array, has an index. */
static bool step_through(struct path *path)
{
	const struct var_target *target = path->m.like ? path->m.like->target : NULL;

	path->at++;
	if (target && target->word == REFERENCE_TO) /* r and r^ are the same */
		return follow_on(path);
	if (!target && path->m.through && path->pointer->like->target->word == REFERENCE_TO && !path->opens)
		return true;
	if (!target || meaning_is_whole(&path->m))
		return refuse(path, DIAG_NOT_POINTER);
	return mean_target(path, target);
}
/* ---- paths ---- */

/* An address before [ is an array that reaches to the end of its area. */
static bool begin_address(struct path *path, const char *text, size_t len)
{
	const struct areas *areas = scope_areas(path->scope);
	struct meaning *m = &path->m;
	uint32_t first;

	if (!scope_mean_address(path->scope, text, len, m, &path->why))
		return false;
	first = m->addr.byte * 8 + m->addr.bit;
	m->array.count = (areas->bytes[m->addr.area] * 8 - first) /
			 m->addr.bits;
	m->stride = iec_type_row(m->type)->size;
	m->kind = MEANING_ARRAY;
	return true;
}

/* `Other.Count`, in which Other is a program and Count one of its variables. */
static bool begin_program(struct path *path, const char *text, size_t len)
{
	struct scope *scope = path->scope;
	struct names *names = &scope->project->names;
	const struct declared *found = find_in(scope, POUS,
					       names_fold(names, names_intern(names, text, len)));

	if (!found || scope->project->pou[found->index].kind != POU_PROGRAM || *path->at != '.')
		return false;
	path->at++;
	len = take(path, ".[^", &text);
	found = find_in(scope, (uint32_t)found->index + 1,
			names_fold(names, names_intern(names, text, len)));
	if (!found || found->flags & (VAR_TEMP | VAR_SFC))
		return refuse(path, DIAG_NO_PIN);
	mean_variable(scope, found, &path->m);
	return true;
}

/* `Page.N1` of `Page.N1.Grams`: the variable that a wire is. */
static bool begin_wire(struct path *path, const char *text)
{
	struct scope *scope = path->scope;
	struct names *names = &scope->project->names;
	const char *end = path->at + 1;
	const struct declared *found;

	if (!path->table || !scope->project->pou[path->table - 1].fbd || path->at >= path->end || *path->at != '.')
		return false;
	while (end < path->end && !strchr(".[^", *end))
		end++;
	found = find_in(scope, path->table, names_fold(names, names_intern(names, text, (size_t)(end - text))));
	if (!found || !(found->flags & VAR_WIRE))
		return false;
	mean_variable(scope, found, &path->m);
	path->at = end;
	return true;
}

static bool begin(struct path *path)
{
	const char *text;
	const char *start = path->at;
	size_t len = take(path, ".[^", &text);

	if (!len || path->at == path->end)
		return false;
	if (begin_wire(path, text) || scope_mean_name(path->scope, path->table, text, len, &path->m) ||
	    begin_program(path, text, len))
		return follow(path);
	if (path->at[0] == '.' && path->end - path->at > 1 && path->at[1] == '%') /* %MW0.%X3, MW0.%X3 */
		return scope_mean_address(path->scope, text, len, &path->m, &path->why);
	if (path->why == DIAG_NO_PIN)
		return false;
	path->at = start;
	len = take(path, "[", &text); /* %MX0.0[3] */
	return path->at < path->end && begin_address(path, text, len);
}

/* ---- parts ---- */

/* @out is the number that it is a part of. Of an address it is another address. */
static void mean_part(const struct meaning *number, unsigned int bits, unsigned int first,
		      struct meaning *out)
{
	*out = *number;
	out->type = bits == 1 ? IEC_BOOL : bits == 8 ? IEC_BYTE : bits == 16 ? IEC_WORD :
		    bits == 32 ? IEC_DWORD : IEC_LWORD;
	out->offset += first / 8;
	out->like = NULL;
	out->kind = number->kind == MEANING_ADDRESS ? MEANING_ADDRESS : MEANING_ELEMENT;
	if (number->addr.area == AREA_NONE || number->opens || number->through) {
		out->part = true;
		out->first = (uint8_t)first;
		out->number = number;
		return;
	}
	out->addr.byte += first / 8;
	out->addr.bit = first % 8;
	out->addr.bits = (uint8_t)bits;
}

/* `.3`, `.%X3`, `.%B1`: which bits of the number before it. */
static bool step_part(struct path *path, struct expr_tail tail)
{
	unsigned int bits, number;
	struct meaning *of;

	if (path->done || !follow(path))
		return refuse(path, DIAG_NO_SUCH_PART);
	if (path->m.kind == MEANING_LITERAL || meaning_fault(&path->m) != DIAG_COUNT ||
	    !(iec_type_row(path->m.type)->class & (ANY_INT | CLASS_BITS)) ||
	    (path->m.like && path->m.like->target) || !expr_part(tail, &bits, &number) ||
	    bits * (number + 1) > 8u * iec_type_row(path->m.type)->size)
		return refuse(path, DIAG_NO_SUCH_PART);
	of = arena_alloc(path->scope->arena, sizeof(*of));
	if (!of)
		return refuse(path, DIAG_NO_MEMORY);
	if (!finish(path, of))
		return false;
	path->done = true;
	mean_part(of, bits, number * bits, &path->m);
	return true;
}

/* `Runout.Q`, `Table[i]`, `Line[2].Recipe.Times[i]`, `%MW0[i]`, with or without blanks inside
 * brackets. Scan-safe: no. Fails: false with @why; @out is unchanged. */
static bool scope_mean_path(struct scope *scope, uint32_t table, const char *text,
			    size_t len, char sign, struct meaning *out, enum diag_id *why)
{
	struct open_index open[LIMIT_INDICES + 1];
	struct path path = { .scope = scope, .table = table, .at = text,
			     .end = text + len, .open = open, .pin = -1, .raw = sign == '@',
			     .within = sign == SCOPE_WITHIN,
			     .why = *why };
	bool good = begin(&path);

	while (good && path.at < path.end) {
		skip_blanks(&path);
		if (path.at == path.end)
			break;
		good = *path.at == '.' ? step_into(&path) :
		       *path.at == '[' ? step_element(&path) :
		       *path.at == '^' ? step_through(&path) :
					 refuse(&path, DIAG_UNKNOWN_NAME);
	}
	if (good && path.done)
		*out = path.m;
	else
		good = good && follow(&path) && finish(&path, out);
	*why = path.why;
	return good;
}

/* A dot or bracket inside a text constant begins no path. */
static bool scope_has_index(const char *text, size_t len)
{
	return (memchr(text, '[', len) || memchr(text, '^', len)) && !memchr(text, '\'', len);
}

/* ADR of a reference is where it leads: its own value, `@Name`. False: @id is another variable. */
static bool mean_reference(struct scope *scope, uint32_t table, uint32_t id, struct meaning *out)
{
	char text[2 * LIMIT_NAME + 2];
	const int len = snprintf(text, sizeof(text), "@%s", names_text(&scope->project->names, id));
	const struct meaning *m;
	enum diag_id why;

	if (len >= (int)sizeof(text))
		return false;
	m = scope_find(scope, pou_of(scope, table), names_intern(&scope->project->names, text, (size_t)len), &why);
	if (!m || meaning_is_indexed(m) || m->kind == MEANING_LITERAL)
		return false;
	*out = *m;
	return true;
}

/* `&Name`, which ADR(Name) is for translation. */
static bool mean_address_of(struct scope *scope, uint32_t table, const char *text, size_t len,
			    struct meaning *out, enum diag_id *why)
{
	const uint32_t id = names_intern(&scope->project->names, text + 1, len - 1);
	const struct meaning *m = scope_find(scope, pou_of(scope, table), id, why);

	if (!m)
		return false;
	if (m->through && mean_reference(scope, table, id, out))
		return true;
	*why = DIAG_ADR_OF;
	if (!m->var || m->constant || m->addr.area != AREA_NONE || meaning_is_indexed(m))
		return false;
	*out = (struct meaning){ .kind = MEANING_PIN, .type = IEC_LWORD, .index = m->index,
				 .pou = m->pou, .var = m->var, .address_of = id };
	return true;
}

/* Declared names first, then system names, pins, constants and addresses. */
static bool mean(struct scope *scope, uint32_t table, uint32_t id,
		 struct meaning *out, enum diag_id *why)
{
	struct names *names = &scope->project->names;
	const char *text = names_text(names, id);
	size_t len = names_len(names, id);
	const char mark = len > 1 && (*text == '@' || *text == SCOPE_WITHIN) ? *text : '\0'; /* @: what REF= stores to */
	const struct declared *slot;

	*why = DIAG_UNKNOWN_NAME;
	if (mark) {
		text++;
		len--;
		id = names_intern(names, text, len);
	}
	slot = find_declared(scope, table, names_fold(names, id));
	if (!slot)
		slot = find_wire(scope, table, text, len);
	if (slot) {
		struct open_index open[1];
		struct path path = { .scope = scope, .raw = mark == '@', .pin = -1, .open = open };

		mean_variable(scope, slot, &path.m);
		if (!follow(&path) || !finish(&path, out)) {
			*why = path.why;
			return false;
		}
		return true;
	}
	if (len > 1 && *text == '&')
		return mean_address_of(scope, table, text, len, out, why);
	if (scope_has_index(text, len))
		return scope_mean_path(scope, table, text, len, mark, out, why);
	if (is_step(scope, table, text, len, why))
		return false;
	*why = DIAG_UNKNOWN_NAME;
	if (scope->project->enum_value_count) {
		const char *sign = memchr(text, literal_is_named(text, len) ? '#' : '.', len);

		if (mean_plain_value(scope, names_fold(names, id), out, why) ||
		    (sign && mean_typed_value(scope, text, len, (size_t)(sign - text), out, why)))
			return true;
		if (*why != DIAG_UNKNOWN_NAME)
			return false;
	}
	if (ascii_is("NULL", text, len))
		return mean_literal("LWORD#0", 7, out, why);
	if (mean_system(text, len, out) ||
	    (memchr(text, '.', len) && scope_mean_path(scope, table, text, len, mark, out, why)))
		return true;
	return *why != DIAG_NO_SUCH_PART && (mean_literal(text, len, out, why) ||
					     scope_mean_address(scope, text, len, out, why));
}

bool meaning_same(const struct meaning *a, const struct meaning *b)
{
	if (a->part || b->part)
		return a->part && b->part && a->first == b->first && a->type == b->type &&
		       meaning_same(a->number, b->number);
	if (meaning_is_indexed(a) || meaning_is_indexed(b))
		return false;
	if (a->addr.area != AREA_NONE || b->addr.area != AREA_NONE)
		return a->addr.area == b->addr.area && a->addr.byte == b->addr.byte &&
		       a->addr.bits == b->addr.bits && a->addr.bit == b->addr.bit;
	return a->var && a->var == b->var && a->offset == b->offset &&
	       a->kind == b->kind;
}

struct var_array meaning_reach(const struct meaning *meaning)
{
	return meaning->opens ? meaning->open[0].array : meaning->array;
}

/* Does a variable come first in `Pump.Start`? Then it is not the action of a block or program Pump. */
static bool begins_with_variable(struct scope *scope, const struct pou *pou, uint32_t text)
{
	struct names *names = &scope->project->names;
	const char *begin = names_text(names, text);
	const size_t len = strcspn(begin, ".");

	return len < names_len(names, text) &&
	       find_declared(scope, table_number(scope, pou), names_fold(names, names_intern(names, begin, len)));
}

const struct pou *scope_pou(struct scope *scope, const struct pou *pou, uint32_t text)
{
	struct names *names = &scope->project->names;
	const char *plain = names_text(names, text);
	size_t len = names_len(names, text);

	if (words_strip(&scope->project->words, &plain, &len))
		text = names_intern(names, plain, len);
	uint32_t fold = names_fold(&scope->project->names, text);
	const struct declared *declared;

	if (!fold || find_declared(scope, table_number(scope, pou), fold))
		return NULL;
	if (scope->actions && begins_with_variable(scope, pou, text))
		return NULL;
	declared = find_in(scope, POUS, fold);
	if (pou && scope->actions) {
		const uint32_t owner = scope->owner[table_number(scope, pou)];
		const int action = action_of(scope, owner ? &scope->project->pou[owner - 1] : pou,
					     names_text(&scope->project->names, text),
					     names_len(&scope->project->names, text));

		if (action >= 0)
			return &scope->project->pou[action];
	}
	return declared ? &scope->project->pou[declared->index] : NULL;
}

bool scope_add(struct scope *scope, const struct pou *pou,
	       const struct var *var, int index)
{
	uint32_t table = table_number(scope, pou);
	const uint32_t wired = scope->wired;
	struct answer *answer;

	scope->wired = 0; /* it is the same in all networks */
	answer = find_answer(scope, table, var->name);
	if (!answer)
		answer = add_answer(scope, table, var->name);
	scope->wired = wired;
	if (!answer)
		return false;
	answer->known = answer->made = true;
	answer->meaning = (struct meaning){
		.type = var->type, .pou = pou, .var = var, .index = index,
		.writable = may_write(var->at), .addr = var->at,
	};
	mean_shape(scope, var, &answer->meaning);
	return true;
}

uint32_t scope_size(const struct scope *scope, const struct meaning *meaning)
{
	struct word_pin like = { .type = meaning->type };

	if (meaning->type == IEC_NONE)
		like.word = (enum word)meaning->word;
	if (meaning->kind == MEANING_ARRAY)
		return meaning->stride * meaning->array.count;
	return (uint32_t)shape_of(&scope->project->words, &like).size;
}

uint32_t scope_bytes(const struct scope *scope, const struct meaning *m)
{
	const struct var *like = m->kind != MEANING_ARRAY ? m->like : NULL;

	if (like && like->target)
		return 4; /* programs with pointers know no others */
	return like && m->type == IEC_STRING ? like->capacity + 1u : scope_size(scope, m);
}

uint32_t scope_type_bytes(struct scope *scope, const char *text, size_t len)
{
	struct names *names = &scope->project->names;
	const enum iec_type type = iec_type_find(text, len);
	const int named = named_find(scope->project, names_fold(names, names_intern(names, text, len)));
	const struct var *like = named < 0 ? NULL : scope->project->named[named].like.var;
	const enum word word = words_find_type(&scope->project->words, text, len);

	if (type != IEC_NONE)
		return type == IEC_STRING ? IEC_STRING_DEFAULT + 1 : iec_type_row(type)->size;
	if (like)
		return like->type == IEC_STRING && !like->array.count ? like->capacity + 1u :
		       (uint32_t)shape_of_var(&scope->project->words, like).size;
	return word_is_own(word) && scope_row(scope, word)->kind != WORD_FN ? scope_row(scope, word)->size : 0;
}

uint32_t scope_span(const struct scope *scope, const struct meaning *meaning)
{
	uint32_t span = scope_size(scope, meaning);

	for (int i = 0; i < meaning->opens; i++)
		span += (meaning->open[i].array.count - 1) * meaning->open[i].stride;
	return span;
}

const char *scope_text(const struct scope *scope, uint32_t id)
{
	return names_text(&scope->project->names, id);
}

const char *scope_said(struct scope *scope, uint32_t id)
{
	struct names *names = &scope->project->names;
	const char *text = names_text(names, id);
	char said[LIMIT_ARG];
	int len;

	if (*text != '&' && *text != '@')
		return text;
	len = snprintf(said, sizeof(said), "REF(%.*s)", (int)utf8_cut(text + 1, sizeof(said) - sizeof("REF()")), text + 1);
	id = names_intern(names, said, (size_t)len);
	return id ? names_text(names, id) : text + 1;
}

void scope_tell(struct scope *scope, const struct pou *pou, enum diag_id why, uint32_t text,
		char *out, size_t size)
{
	const char *name = scope_text(scope, text), *dot = strrchr(name, '.');
	const struct meaning *m;

	name += *name == '&' || *name == '@'; /* of REF(Name) */
	named_tell(scope->project, why, name, out, size);
	if (why != DIAG_NO_SUCH_PART || !dot)
		return;
	m = scope_find(scope, pou, names_intern(&scope->project->names, name, (size_t)(dot - name)), &why);
	snprintf(out, size, "%.24s" DIAG_AND "%s", dot + 1, !m ? "" :
		 m->kind == MEANING_ARRAY ? "ARRAY" : m->type == IEC_NONE ?
		 scope_row(scope, (enum word)m->word)->word : iec_type_row(m->type)->word);
}

const struct meaning *scope_index(struct scope *scope, const struct pou *pou,
				  uint32_t text, size_t *at)
{
	struct project *project = scope_project(scope);
	const char *all = scope_text(scope, text);
	const char *open = strpbrk(all + *at, "[,");
	struct path path = { .scope = scope };
	const char *index;
	enum diag_id why;
	size_t len;

	if (!open)
		return NULL;
	path.at = open + 1;
	path.end = open + strlen(open);
	len = take(&path, "],", &index);
	*at = (size_t)(path.at - all);
	return scope_find(scope, pou, names_intern(&project->names, index, len),
			  &why);
}

uint32_t scope_first(struct scope *scope, const struct pou *pou, uint32_t array,
		     const char *tail, size_t len)
{
	struct names *names = &scope_project(scope)->names;
	char text[3 * LIMIT_NAME];
	enum diag_id why;
	const struct meaning *m = scope_find(scope, pou, array, &why);
	int size;

	if (!m || (m->kind != MEANING_ARRAY && m->kind != MEANING_ADDRESS))
		return 0;
	size = snprintf(text, sizeof(text), "%s[%ld]%.*s", names_text(names, array),
			(long)outer(m).low, (int)len, tail);
	return size < 0 || (size_t)size >= sizeof(text) ? 0 :
	       names_intern(names, text, (size_t)size);
}

uint32_t scope_first_of(struct scope *scope, const struct pou *pou, const struct expr *expr,
			const struct expr_node *node)
{
	int16_t chain[LIMIT_INDICES];
	int count = 0, at = (int)(node - expr->node);
	uint32_t id = 0;

	for (; node->op == EXPR_INDEX && at >= 0 && count < LIMIT_INDICES; at = expr->node[at].right)
		chain[count++] = (int16_t)at;
	if (!count)
		return names_intern(&scope_project(scope)->names, node->text, node->len);
	while (count-- > 0) {
		const struct expr_node *part = &expr->node[chain[count]];

		if (part->right < 0)
			id = names_intern(&scope_project(scope)->names, part->text, part->len);
		id = scope_first(scope, pou, id, part->tail.text, part->tail.len);
	}
	return id;
}
