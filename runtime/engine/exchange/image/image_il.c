/* SPDX-License-Identifier: MIT
 *
 * image_il - writes each instruction of an image as a few lines of a list.
 *
 * All variables become globals, so that each list can use them. Bits, areas, constants and
 * pins have their addresses, values and names. What the text of one instruction needs is
 * noted first: declarations stand above the lists.
 */
#include "engine/exchange/image/image_il.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/literal.h"
#include "engine/base/name.h"
#include "engine/scan/image.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ROOM 2048     /* bytes of the text of a constant                      */
#define NAME_SIZE 320 /* bytes of an operand                                   */
#define CHAIN_MOST 16 /* elements of an array that are asked one by one       */
#define CHAIN_LIMIT 1024 /* the same of arrays that have no other text        */

/* A value or instance of the image's own data, or of an area with a type. */
struct object {
	uint32_t offset;
	uint8_t type;        /* IEC_NONE: an instance                         */
	uint16_t word;       /* of an instance; capacity of a text            */
	bool used;
	const char *pou;     /* it is declared in this program; NULL: a global */
	struct var_array array; /* of the first element: its array            */
	bool inside;         /* a further element: declared with the first one */
	char *name;          /* as an operand: Speed, Table[3]                */
};

/* A name of the file. Local variables of several programs may have the same. */
struct taken {
	const char *name;
	bool global;
};

/* The list of a block, made for one instance: the copy to the frame and back is left out. */
struct special {
	uint32_t entry, frame, size, instance;
	char *name;
};

struct maker {
	const struct program *program;
	const struct sink *sink;
	struct image_il_report *report;
	struct arena arena;
	struct image image;  /* as a cold start has it: initial values        */
	struct object *object; /* by offset                                   */
	int count;
	struct object *at;   /* of areas: typed places                        */
	int at_count;
	uint8_t *target;     /* of each word of the code: 1: a jump leads here */
	const char *pou;     /* for the report                                */
	const char *within;  /* whose variables it sees, as the image writes it; NULL: only globals */
	uint32_t entry, end; /* of it: its first word, and behind its last    */
	uint32_t labels;     /* made so far                                   */
	bool writing;        /* second pass                                   */
	struct special *special;
	int special_count;
	const struct special *now; /* whose list is written; NULL: of no instance */
	char **clock;        /* timers for TICK                               */
	int clock_count;
	uint32_t clocks;     /* of them in use                                */
	bool *called;        /* by entry: as it is                            */
	char **entry_name;   /* by entry                                      */
	char *index[IEC_TYPE_COUNT]; /* variables that hold an index; NULL: none  */
	char *zero;          /* an index may fail: divides by 0; NULL: none may */
	char (*rooms)[ROOM]; /* for texts: in use up to room_used             */
	int room_used;
	struct sink_memory call; /* parameters of the call that is written     */
	struct taken *taken; /* every name of the file, by its hash           */
	uint32_t taken_size, taken_count; /* a power of 2                     */
};

#define ROOMS 64 /* texts of one instruction, or of one element of an array     */

/* A text that lives until room_used is set back. */
static char *room(struct maker *m)
{
	char *text = m->rooms[m->room_used < ROOMS - 1 ? m->room_used++ : ROOMS - 1];

	*text = '\0';
	return text;
}

/* ---- output ---- */

static void out(struct maker *m, const char *operator, const char *operand)
{
	if (!m->writing)
		return;
	sink_text(m->sink, "  ");
	sink_text(m->sink, operator);
	if (*operand) {
		sink_repeat(m->sink, " ", 6 - (int)strlen(operator));
		if (strlen(operator) >= 6)
			sink_text(m->sink, " ");
		sink_text(m->sink, operand);
	}
	sink_text(m->sink, "\n");
}

static void put_label(struct maker *m, const char *kind, uint32_t number)
{
	if (m->writing)
		sink_printf(m->sink, "%s%u:\n", kind, (unsigned)number);
}

static void jump(struct maker *m, const char *operator, const char *kind, uint32_t number)
{
	char text[32];

	snprintf(text, sizeof(text), "%s%u", kind, (unsigned)number);
	out(m, operator, text);
}

static void lose(struct maker *m, const char *what)
{
	if (!m->writing)
		return;
	m->report->count++;
	if (m->report->lost)
		m->report->lost(m->report->context, m->pou, what);
	sink_printf(m->sink, "  (* not expressed: %.200s *)\n", what);
}

/* ---- names ---- */

/* Its slot: the one of the name, or a free one. */
static struct taken *taken_slot(const struct maker *m, const char *name)
{
	uint32_t at = name_hash(name, strlen(name));

	while (m->taken[at &= m->taken_size - 1].name && !name_equal(m->taken[at].name, name))
		at++;
	return &m->taken[at];
}

static bool is_taken(const struct maker *m, const char *name)
{
	return taken_slot(m, name)->name != NULL;
}

static bool grow_taken(struct maker *m)
{
	struct taken *old = m->taken;
	const uint32_t size = m->taken_size;

	m->taken_size = size ? 2 * size : 256;
	m->taken = arena_alloc(&m->arena, m->taken_size * sizeof(*m->taken));
	if (!m->taken) {
		m->taken = old;
		m->taken_size = size;
		return false;
	}
	for (uint32_t i = 0; i < size; i++)
		if (old[i].name)
			*taken_slot(m, old[i].name) = old[i];
	return true;
}

/* Owns: nothing; @name lives as long as the maker. */
static void take_name(struct maker *m, const char *name, bool global)
{
	struct taken *slot;

	if (2 * m->taken_count >= m->taken_size && !grow_taken(m))
		return;
	slot = taken_slot(m, name);
	m->taken_count += !slot->name;
	*slot = (struct taken){ slot->name ? slot->name : name, slot->global || global };
}

/* A name like @like that was free; NULL: no memory. */
static char *free_name(struct maker *m, const char *like)
{
	char text[NAME_SIZE];
	size_t len = strlen(like) < LIMIT_NAME - 8 ? strlen(like) : LIMIT_NAME - 8;
	char *name;

	while (len < strlen(like) && ((unsigned char)like[len] & 0xc0) == 0x80)
		len--; /* no half of a character */
	snprintf(text, sizeof(text), "%.*s", (int)len, like);
	for (unsigned i = 2; is_taken(m, text); i++)
		snprintf(text, sizeof(text), "%.*s_%u", (int)len, like, i);
	name = arena_copy(&m->arena, text, strlen(text));
	if (name)
		take_name(m, name, true);
	return name;
}

/* The bytes of a character that may stand in a name; 0: it may not. */
static size_t name_letter(const char *text, size_t len)
{
	const size_t size = utf8_length(text, len);

	if (size == 1)
		return (ascii_upper(*text) >= 'A' && ascii_upper(*text) <= 'Z') || ascii_digit(*text) || *text == '_';
	return size > 1 && utf8_is_letter(text, size) ? size : 0;
}

/* A name of an image as a name of a file: each byte that cannot stand in one becomes _, and a ]
 * goes. An image may hold any bytes. */
static void flatten(char *out, size_t size, const char *name, size_t len)
{
	size_t used = 0, step;

	if (len == 0 || ascii_digit(*name))
		out[used++] = '_';
	for (size_t i = 0; i < len; i += step ? step : 1) {
		step = name_letter(name + i, len - i);
		if (used + step + 1 >= size || used + step >= LIMIT_NAME)
			break;
		if (step)
			memcpy(out + used, name + i, step);
		else if (name[i] != ']')
			out[used] = '_';
		used += step ? step : name[i] != ']';
	}
	out[used] = '\0';
}

/* ---- objects ---- */

static int by_offset(const void *left, const void *right)
{
	const struct object *a = left, *b = right;

	return (a->offset > b->offset) - (a->offset < b->offset);
}

static bool add_objects(struct maker *m)
{
	const struct program *p = m->program;
	size_t all = 0;

	for (uint32_t i = 0; i < p->run_count; i++)
		all += p->run[i].kind != RUN_CONSTANTS ? p->run[i].count : 0;
	m->object = arena_alloc(&m->arena, (all + 1) * sizeof(*m->object));
	if (!m->object)
		return false;
	for (uint32_t i = 0; i < p->run_count; i++) {
		const struct code_run *run = &p->run[i];

		for (uint32_t k = 0; run->kind != RUN_CONSTANTS && k < run->count; k++)
			m->object[m->count++] = (struct object){
				.offset = run->offset + k * code_run_size(run),
				.type = run->kind == RUN_VALUES ? run->type : IEC_NONE,
				.word = run->word,
			};
	}
	qsort(m->object, (size_t)m->count, sizeof(*m->object), by_offset);
	return true;
}

static struct object *object_at(const struct maker *m, uint32_t offset)
{
	int low = 0, high = m->count;

	while (low < high) {
		const int middle = low + (high - low) / 2;

		if (m->object[middle].offset <= offset)
			low = middle + 1;
		else
			high = middle;
	}
	return low ? &m->object[low - 1] : NULL;
}

/* The object of element @i of a symbol, if no other symbol names it. */
static struct object *unnamed(const struct maker *m, const struct declared_name *symbol, uint32_t i)
{
	const uint32_t offset = symbol->at.where + i * symbol->stride;
	struct object *o = object_at(m, offset);

	return o && !o->name && o->offset == offset && o->type == symbol->at.type ? o : NULL;
}

/* All elements are values of the image's own data that have no name yet, one behind the other. */
static bool names_all(const struct maker *m, const struct declared_name *symbol)
{
	const struct object *first = unnamed(m, symbol, 0);

	for (uint32_t i = 0; i == 0 || i < symbol->array.count; i++)
		if (!first || unnamed(m, symbol, i) != first + i)
			return false;
	return true;
}

static bool is_member(const struct declared_name *symbol)
{
	return memchr(symbol->name, '.', symbol->array.head) != NULL;
}

/* A free name like @flat, or like that of @pou if it is taken. */
static char *global_name(struct maker *m, const char *pou, const char *flat)
{
	char longer[NAME_SIZE];
	size_t len;

	if (!*pou || !is_taken(m, flat))
		return free_name(m, flat);
	flatten(longer, 100, pou, strlen(pou));
	len = strlen(longer);
	longer[len++] = '_';
	flatten(longer + len, LIMIT_NAME - len, flat, strlen(flat));
	return free_name(m, longer);
}

/* A plain name stays what it is, in its program. One of a member loses its dots. */
static void name_one(struct maker *m, const struct declared_name *symbol)
{
	const uint32_t count = symbol->array.count ? symbol->array.count : 1;
	char flat[NAME_SIZE], *text = room(m);
	bool local = *symbol->pou && !is_member(symbol);
	char *head;

	flatten(flat, sizeof(flat), symbol->name, symbol->array.head);
	local = local && !taken_slot(m, flat)->global; /* it would hide that one */
	head = local ? arena_copy(&m->arena, flat, strlen(flat)) :
		       global_name(m, symbol->pou, flat);
	if (head && local)
		take_name(m, head, false);
	for (uint32_t i = 0; head && i < count; i++) {
		struct object *o = unnamed(m, symbol, i);

		if (symbol->array.count)
			snprintf(text, ROOM, "%.255s[%lld]", head,
				 (long long)symbol->array.low + i);
		else
			snprintf(text, ROOM, "%.255s", head);
		o->name = arena_copy(&m->arena, text, strlen(text));
		o->pou = local ? symbol->pou : NULL;
		o->inside = i > 0;
		if (i == 0 && symbol->array.count)
			o->array = (struct var_array){ symbol->array.low, symbol->array.count };
	}
}

/* The symbols' names go to their objects; of several the first. A global name must not be that of
 * a local variable, which would hide it. */
static void name_objects(struct maker *m, bool members)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name symbol;

	while (image_next_declared(m->program, &cursor, &symbol))
		if (!(symbol.flags & SYMBOL_HIDDEN) && symbol.at.area == AREA_NONE &&
		    is_member(&symbol) == members &&
		    symbol.at.where >= m->program->areas.size && names_all(m, &symbol))
		{
			name_one(m, &symbol);
			m->room_used = 0;
		}
}

/* May the list that is written name this object? */
static bool is_seen(const struct maker *m, const struct object *o)
{
	return !o->pou || (m->within && name_equal(o->pou, m->within));
}

static const char *object_name(struct maker *m, struct object *o)
{
	char text[64];

	o->used = true;
	if (!o->name) {
		snprintf(text, sizeof(text), "At%u", (unsigned)o->offset);
		o->name = free_name(m, text);
	}
	return o->name ? o->name : "";
}

/* ---- operands ---- */

/* The bit of an area that lives at this byte. */
static bool find_bit(const struct maker *m, uint32_t offset, struct iec_addr *addr)
{
	const struct program *p = m->program;

	for (uint32_t i = 0; i < p->bits_count; i++) {
		const struct code_bits *bits = &p->bits[i];
		const uint32_t bit = bits->first + (offset - bits->slot);

		if (offset < bits->slot || offset - bits->slot >= bits->count)
			continue;
		*addr = (struct iec_addr){ .area = (enum iec_area)bits->area, .bits = 1,
					   .byte = bit / 8, .bit = bit % 8 };
		return true;
	}
	return false;
}

static void print_bit(const struct maker *m, uint32_t byte, uint32_t bit, char *text)
{
	struct iec_addr addr = { .area = areas_find(&m->program->areas, byte), .bits = 1 };

	addr.byte = byte - m->program->areas.at[addr.area];
	addr.bit = (uint8_t)bit;
	iec_addr_print(addr, text, NAME_SIZE);
}

/* @offset: bytes, or @bits of the areas. */
static void print_place(const struct maker *m, uint32_t type, bool bits, uint32_t offset,
			char *text)
{
	const uint32_t byte = bits ? offset / 8 : offset;
	struct iec_addr addr = { .area = areas_find(&m->program->areas, byte) };

	addr.byte = byte - m->program->areas.at[addr.area];
	addr.bits = bits ? 1 : (uint8_t)(8 * iec_type_row((enum iec_type)type)->size);
	addr.bit = bits ? offset % 8 : 0;
	iec_addr_print(addr, text, 40);
}

/* A typed place in an area: a variable AT it. */
static const char *area_name(struct maker *m, uint32_t type, uint32_t offset)
{
	struct object *o;
	char text[64], address[40];

	for (int i = 0; i < m->at_count; i++)
		if (m->at[i].offset == offset && m->at[i].type == type &&
		    !m->at[i].array.count && !m->at[i].inside)
			return m->at[i].name;
	print_place(m, type, false, offset, address);
	snprintf(text, sizeof(text), "%s_%s", address + 1,
		 iec_type_row((enum iec_type)type)->word);
	o = arena_push(&m->arena, &m->at, &m->at_count, sizeof(*o));
	if (!o)
		return "";
	*o = (struct object){ .offset = offset, .type = (uint8_t)type };
	o->name = free_name(m, text);
	return o->name ? o->name : "";
}

/* INT#5, T#1s, 'it$'s' */
static void print_value(enum iec_type type, union iec_value value, char *text, size_t size)
{
	size_t used = 0;

	if (type == IEC_STRING) {
		text[used++] = '\'';
		for (uint32_t i = 0; i < value.s->length && used + 8 < size; i++) {
			const unsigned char c = (unsigned char)value.s->text[i];

			if (c < ' ' || c == '$' || c == '\'' || c >= 0x7f)
				used += (size_t)snprintf(text + used, size - used, "$%02X", c);
			else
				text[used++] = (char)c;
		}
		text[used++] = '\'';
		text[used] = '\0';
		return;
	}
	if (iec_type_row(type)->class & (ANY_NUM | ANY_BIT) && type != IEC_BOOL)
		used = (size_t)snprintf(text, size, "%s#", iec_type_row(type)->word);
	literal_print(type, value, text + used, size - used);
}

static union iec_value value_at(const struct maker *m, uint32_t type, uint32_t offset)
{
	const struct location at = { .type = (enum iec_type)type, .where = offset };

	return image_get(&m->image, at);
}

/* A pin of the instance that holds @offset; false: it has no name. */
static bool print_pin(struct maker *m, struct object *o, uint32_t type, uint32_t offset,
		      char *text)
{
	const struct word_row *row = word_row((enum word)o->word);
	const struct word_pin *pin = word_pins(row);

	for (int i = 0; i < row->pin_count; i++)
		if (pin[i].dir != PIN_VAR && pin[i].dir != PIN_NONE &&
		    pin[i].offset == offset - o->offset && pin[i].type == (enum iec_type)type) {
			snprintf(text, NAME_SIZE, "%s.%s", object_name(m, o), pin[i].name);
			return true;
		}
	return false;
}

/* Where a place is: that of the frame is the instance. */
static uint32_t real(const struct maker *m, uint32_t offset)
{
	const struct special *now = m->now;

	return now && offset >= now->frame && offset - now->frame < now->size ?
	       now->instance + (offset - now->frame) : offset;
}

/* The text of an operand of a type; false: it has none. */
static bool operand(struct maker *m, uint32_t type, uint32_t place, char *text)
{
	const uint32_t offset = real(m, place);
	const struct program *p = m->program;
	const struct code_run *run;
	struct iec_addr addr;
	struct object *o;

	*text = '\0';
	if (type == IEC_BOOL && (offset == CODE_FALSE_AT(&p->areas) ||
				 offset == CODE_TRUE_AT(&p->areas))) {
		snprintf(text, NAME_SIZE, "%s", offset == CODE_TRUE_AT(&p->areas) ?
			 "TRUE" : "FALSE");
		return true;
	}
	if (offset < p->areas.size) {
		snprintf(text, NAME_SIZE, "%s", area_name(m, type, offset));
		return type != IEC_BOOL && type != IEC_STRING;
	}
	if (type == IEC_BOOL && find_bit(m, offset, &addr)) {
		iec_addr_print(addr, text, NAME_SIZE);
		return true;
	}
	run = code_run_at(p, offset);
	if (run && run->kind == RUN_CONSTANTS) {
		print_value((enum iec_type)type, value_at(m, type, offset), text, ROOM);
		return true;
	}
	o = object_at(m, offset);
	if (!o || !is_seen(m, o))
		return false;
	if (o->type == IEC_NONE)
		return print_pin(m, o, type, offset, text);
	snprintf(text, NAME_SIZE, "%s", object_name(m, o));
	return o->offset == offset && o->type == type;
}

static bool typed(struct maker *m, uint32_t word, char *text)
{
	return operand(m, CODE_TYPE(word), CODE_OFFSET(word), text);
}

/* ---- a truth table ---- */

struct term {
	const char *text;
	bool known, value;
};

static void load(struct maker *m, const struct term *term, bool negate)
{
	if (term->known)
		out(m, "LD", term->value != negate ? "TRUE" : "FALSE");
	else
		out(m, negate ? "LDN" : "LD", term->text);
}

static void combine(struct maker *m, const char *operator, const char *negated,
		    const struct term *term, bool negate)
{
	out(m, negate ? negated : operator, term->text);
}

/* The result becomes bit (a + 2b) of four. Neither is known. */
static void load_two(struct maker *m, unsigned table, const struct term *a,
		     const struct term *b)
{
	const unsigned low = table & 3, high = table >> 2 & 3;

	if (low == high) { /* of a alone */
		if (low == 0 || low == 3)
			out(m, "LD", low ? "TRUE" : "FALSE");
		else
			load(m, a, low == 1);
	} else if (low == 0 || low == 3 || high == 0 || high == 3) {
		/* One half is constant: AND or OR of both, either inverted. */
		const bool both = low == 0 || high == 0;
		const bool b_not = both ? high == 0 : high == 3 ? false : true;
		const unsigned other = low == 0 || low == 3 ? high : low;

		if ((low == 0 || low == 3) && (high == 0 || high == 3)) {
			load(m, b, low != 0);
			return;
		}
		load(m, a, other == 1);
		if (both)
			combine(m, "AND", "ANDN", b, b_not);
		else
			combine(m, "OR", "ORN", b, b_not);
	} else { /* low and high are a and not a */
		load(m, a, false);
		out(m, low == 2 ? "XOR" : "XORN", b->text);
	}
}

static void begin(struct maker *m, const char *operator)
{
	out(m, operator, "");
}

static void load_three(struct maker *m, unsigned table, const struct term *a,
		       const struct term *b, const struct term *c)
{
	const unsigned low = table & 15, high = table >> 4 & 15;

	if (low == high) {
		load_two(m, low, a, b);
	} else if (low == 0 || high == 0) {
		load_two(m, low | high, a, b);
		combine(m, "AND", "ANDN", c, high == 0);
	} else if (low == 15 || high == 15) {
		load_two(m, low & high, a, b);
		combine(m, "OR", "ORN", c, low == 15);
	} else {
		load(m, c, false);
		begin(m, "AND(");
		load_two(m, high, a, b);
		begin(m, ")");
		begin(m, "OR(");
		load(m, c, true);
		begin(m, "AND(");
		load_two(m, low, a, b);
		begin(m, ")");
		begin(m, ")");
	}
}

/* Drops input @at of a table of @count inputs, which has this value. */
static unsigned fold(unsigned table, int at, bool value)
{
	unsigned result = 0;

	for (unsigned i = 0; i < 8; i++) {
		const unsigned with = value ? i | 1u << at : i & ~(1u << at);

		result |= (table >> with & 1u) << i;
	}
	return result;
}

static bool term_of(struct maker *m, uint32_t offset, struct term *term)
{
	const struct areas *areas = &m->program->areas;
	char *text = room(m);

	*term = (struct term){
		.text = text, .value = offset == CODE_TRUE_AT(areas),
		.known = offset == CODE_FALSE_AT(areas) || offset == CODE_TRUE_AT(areas),
	};
	return operand(m, IEC_BOOL, offset, text);
}

static void put_lut_text(struct maker *m, const uint32_t *at)
{
	struct term term[3], *used[3];
	unsigned table = at[3] & 0xff;
	char *target = room(m);
	int count = 0, place[3];
	bool good = operand(m, IEC_BOOL, at[3] >> 8, target);

	for (int i = 0; i < 3; i++) {
		good &= term_of(m, at[i], &term[i]);
		if (term[i].known)
			table = fold(table, i, term[i].value);
		else if (fold(table, i, false) != fold(table, i, true))
			place[count] = i, used[count++] = &term[i];
	}
	if (!good) {
		lose(m, "a bit without a name");
		return;
	}
	{ /* the inputs that count become the first ones */
		unsigned small = 0;

		for (unsigned i = 0; i < 8; i++) {
			unsigned from = 0;

			for (int k = 0; k < count; k++)
				from |= (i >> k & 1u) << place[k];
			small |= (table >> from & 1u) << i;
		}
		table = small;
	}
	if (count == 0)
		out(m, "LD", table & 1 ? "TRUE" : "FALSE");
	else if (count == 1)
		load(m, used[0], (table & 3) == 1);
	else if (count == 2)
		load_two(m, table & 15, used[0], used[1]);
	else
		load_three(m, table, used[0], used[1], used[2]);
	out(m, "ST", target);
}

static void put_lut(struct maker *m, const uint32_t *at)
{
	const int used = m->room_used;

	put_lut_text(m, at);
	m->room_used = used;
}

/* ---- comparisons ---- */

static bool is_floating(uint32_t word)
{
	return CODE_TYPE(word) == IEC_REAL || CODE_TYPE(word) == IEC_LREAL;
}

/* The result becomes whether the order of two values is one of @set: bit 0: none, 1: greater,
 * 2: less, 3: equal. */
static void load_order(struct maker *m, unsigned set, bool floating, const char *left,
		       const char *right)
{
	static const struct { unsigned char set; bool negate; char operator[3]; } row[] = {
		{ 0x2, false, "GT" }, { 0xa, false, "GE" }, { 0x8, false, "EQ" },
		{ 0xc, false, "LE" }, { 0x4, false, "LT" }, { 0x7, false, "NE" },
		{ 0xd, true, "GT" }, { 0x5, true, "GE" }, { 0x3, true, "LE" }, { 0xb, true, "LT" },
	};

	if (!floating) { /* there is always an order */
		set &= 0xe;
		set |= set == 0x6 || set == 0xe ? 1 : 0;
	}
	if (set == 0 || set == 0xf) {
		out(m, "LD", set ? "TRUE" : "FALSE");
		return;
	}
	for (size_t i = 0; i < sizeof(row) / sizeof(*row); i++) {
		if (row[i].set != set)
			continue;
		out(m, "LD", left);
		out(m, row[i].operator, right);
		if (row[i].negate)
			out(m, "NOT", "");
		return;
	}
	/* 6: greater or less; e: any order; 9 and 1 the contrary */
	out(m, "LD", left);
	out(m, set == 0x6 || set == 0x9 ? "GT" : "GE", right);
	out(m, "OR(", "");
	out(m, "LD", left);
	out(m, "LT", right);
	out(m, ")", "");
	if (set == 0x9 || set == 0x1)
		out(m, "NOT", "");
}

static void put_cmp(struct maker *m, const uint32_t *at, uint32_t type, uint32_t n)
{
	const unsigned low = n & 15, high = n >> 4 & 15;
	const uint32_t own = type == IEC_NONE ? 0 : CODE_OPERAND(type, 0);
	char *left = room(m), *right = room(m), *target = room(m);
	const bool floating = is_floating(at[0] | own) || is_floating(at[1] | own);
	struct term c;
	bool good = (int)typed(m, at[0] | own, left) & (int)typed(m, at[1] | own, right) &
		    (int)term_of(m, at[2], &c) & (int)operand(m, IEC_BOOL, at[3], target);

	if (!good) {
		lose(m, "a comparison of values without names");
		return;
	}
	if (c.known || low == high) {
		load_order(m, c.known && c.value ? high : low, floating, left, right);
	} else if (low == 0 || high == 0) {
		load_order(m, low | high, floating, left, right);
		combine(m, "AND", "ANDN", &c, high == 0);
	} else if (low == 15 || high == 15) {
		load_order(m, low & high, floating, left, right);
		combine(m, "OR", "ORN", &c, low == 15);
	} else {
		load(m, &c, false);
		out(m, "AND(", "");
		load_order(m, high, floating, left, right);
		out(m, ")", "");
		out(m, "OR(", "");
		load(m, &c, true);
		out(m, "AND(", "");
		load_order(m, low, floating, left, right);
		out(m, ")", "");
		out(m, ")", "");
	}
	out(m, "ST", target);
}

/* ---- values ---- */

/* Jumps over what follows unless it is enabled; false: it is always. */
static bool begin_enabled(struct maker *m, const struct term *en)
{
	if (en->known && en->value)
		return false;
	load(m, en, false);
	jump(m, "JMPCN", "N", m->labels);
	return true;
}

static void put_copy(struct maker *m, const uint32_t *at)
{
	char *target = room(m), *source = room(m);
	struct term en;
	bool skips;

	if (!((int)typed(m, at[1], target) & (int)typed(m, at[2], source) & (int)term_of(m, at[0], &en))) {
		lose(m, "a value without a name");
		return;
	}
	skips = begin_enabled(m, &en);
	out(m, "LD", source);
	out(m, "ST", target);
	if (skips)
		put_label(m, "N", m->labels++);
}

static struct sink begin_call(struct maker *m)
{
	m->call.len = 0;
	return sink_to_memory(&m->call);
}

static void add_arg(const struct sink *call, const char *pin, const char *sign, const char *value)
{
	const struct sink_memory *memory = call->context;

	sink_text(call, memory->len ? ", " : "");
	sink_text(call, pin);
	sink_text(call, sign);
	sink_text(call, value);
}

static void put_call(struct maker *m, const char *word)
{
	if (!m->writing)
		return;
	sink_text(m->sink, "  ");
	sink_text(m->sink, word);
	sink_text(m->sink, "(");
	sink_write(m->sink, sink_memory_text(&m->call), m->call.len);
	sink_text(m->sink, ")\n");
}

/* EN and the outputs of a function. */
static bool add_ends(struct maker *m, const struct sink *call, uint32_t eno, uint32_t target)
{
	char *text = room(m);

	if (!operand(m, IEC_BOOL, eno, text))
		return false;
	if (!(eno == CODE_FALSE_AT(&m->program->areas)))
		add_arg(call, "ENO", " => ", text);
	if (!typed(m, target, text))
		return false;
	add_arg(call, "OUT", " => ", text);
	return true;
}

static bool add_enable(struct maker *m, const struct sink *call, uint32_t en)
{
	struct term term;

	if (!term_of(m, en, &term))
		return false;
	if (!term.known || !term.value)
		add_arg(call, "EN", " := ", term.text);
	return true;
}

static const char *math_word(uint32_t n)
{
	static const char *const math[MATH_COUNT] = { "ADD", "SUB", "MUL", "DIV", "MOD" };

	return math[MATH_OF(n) % MATH_COUNT];
}

/* Lines of a list leave the left operand where there is no result. Nothing reads their ENO. */
static void put_math_lines(struct maker *m, const uint32_t *at, uint32_t type, uint32_t n)
{
	char *target = room(m), *left = room(m), *right = room(m);

	if (!((int)operand(m, type, at[2], target) & (int)operand(m, type, at[3], left) &
	      (int)operand(m, type, at[4], right))) {
		lose(m, "a sum of values without names");
		return;
	}
	out(m, "LD", left);
	out(m, math_word(n), right);
	out(m, "ST", target);
}

static void put_math(struct maker *m, const uint32_t *at, uint32_t type, uint32_t n)
{
	const struct sink to_call = begin_call(m), *call = &to_call;
	char *text = room(m);
	bool good = add_enable(m, call, at[0]);

	good &= operand(m, type, at[3], text);
	add_arg(call, "IN1", " := ", text);
	good &= operand(m, type, at[4], text);
	add_arg(call, "IN2", " := ", text);
	good &= add_ends(m, call, at[1], CODE_OPERAND(type, at[2]));
	if (good)
		put_call(m, math_word(n));
	else
		lose(m, "a sum of values without names");
}

/* CONVERT.INT of REAL: REAL_TO_INT. */
static void print_function(char *word, size_t size, const struct word_row *row, uint32_t from,
			   uint32_t to)
{
	if (strcmp(row->word, "CONVERT") == 0 || strcmp(row->word, "CONVERT_NS") == 0)
		snprintf(word, size, "%s_TO_%s", iec_type_row((enum iec_type)from)->word,
			 iec_type_row((enum iec_type)to)->word);
	else
		snprintf(word, size, "%s", row->word);
}

static void put_fn(struct maker *m, const uint32_t *at, uint32_t n)
{
	const struct word_row *row = word_row((enum word)at[0]);
	const uint32_t count = n >> 8 & 0xff;
	const struct sink to_call = begin_call(m), *call = &to_call;
	char *text = room(m);
	char word[64], pin[24];
	bool good = add_enable(m, call, at[1]);

	for (uint32_t i = 0; i < count; i++) {
		const struct word_pin *input = word_input(row, i);
		const int number = word_last_number(row);

		good &= typed(m, at[4 + i] & ~CODE_OWN, text);
		if (i < row->pin_count)
			snprintf(pin, sizeof(pin), "%s", input->name);
		else
			snprintf(pin, sizeof(pin), "IN%d", number + (int)i - row->pin_count + 1);
		add_arg(call, pin, " := ", text);
	}
	good &= add_ends(m, call, at[2], at[3]);
	print_function(word, sizeof(word), row, CODE_TYPE(at[4] & ~CODE_OWN), CODE_TYPE(at[3]));
	if (good && (count || row->pin_count == 0))
		put_call(m, word);
	else
		lose(m, row->word);
}

/* ---- elements ---- */

/* An operation that always fails: SYS_ERRORS counts it, as it counts a wrong index. */
static void count_failure(struct maker *m, const struct term *en)
{
	const bool skips = begin_enabled(m, en);
	char *text = room(m);

	if (!m->zero)
		m->zero = free_name(m, "Zero_of_image");
	snprintf(text, ROOM, "DIV(IN1 := INT#1, IN2 := %.300s, OUT => %.300s)",
		 m->zero ? m->zero : "", m->zero ? m->zero : "");
	out(m, text, "");
	if (skips)
		put_label(m, "N", m->labels++);
}

/* The value of an index constant in the type of the index; false: it has no such value. */
static bool print_index(uint32_t word, int64_t value, char *text)
{
	const struct iec_type_row *row = iec_type_row((enum iec_type)CODE_TYPE(word));
	const unsigned bits = 8u * row->size;
	const bool is_signed = row->class & CLASS_SIGNED;

	if (is_signed ? bits < 64 && (value < -((int64_t)1 << (bits - 1)) ||
				      value >= (int64_t)1 << (bits - 1)) :
			value < 0 || (bits < 64 && value >= (int64_t)1 << bits))
		return false;
	snprintf(text, NAME_SIZE, "%s#%lld", row->word, (long long)value);
	return true;
}

/* The element as text: a bit of the areas, or a value at an offset. */
static bool element(struct maker *m, bool bit, uint32_t base, uint64_t where, char *text)
{
	if (!bit)
		return typed(m, CODE_OPERAND(CODE_TYPE(base), (uint32_t)where), text);
	print_bit(m, (uint32_t)where / 8, (uint32_t)where % 8, text);
	return true;
}

/* Values one after another, the same at both places. */
static bool put_values(struct maker *m, uint32_t to, uint32_t from, uint32_t size)
{
	char *target = room(m), *source = room(m);

	to = real(m, to);
	from = real(m, from);
	for (uint32_t done = 0; done < size; ) {
		const struct code_run *run = code_run_at(m->program, from + done);
		const struct object *o = object_at(m, to + done);

		if (!run) { /* filled up */
			done++;
			continue;
		}
		if (run->kind == RUN_INSTANCE || !o || o->type == IEC_NONE ||
		    !operand(m, run->type, to + done, target) ||
		    !operand(m, run->type, from + done, source))
			return false;
		out(m, "LD", source);
		out(m, "ST", target);
		done += code_run_size(run);
	}
	return true;
}

/* What an index selects: AGET, APUT, ABLOCK. */
struct chain {
	const uint32_t *at;  /* operands of the instruction                   */
	const uint32_t *dimension; /* CODE_DIMENSION words each               */
	uint32_t dimensions;
	bool bit, store, block;
	bool keep;           /* without an element the value is as it was     */
};

static uint64_t chain_count(const struct chain *chain)
{
	uint64_t count = 1;

	for (uint32_t i = 0; i < chain->dimensions && count <= CHAIN_LIMIT; i++)
		count *= chain->dimension[i * CODE_DIMENSION + 2];
	return count;
}

/* Has each index a name or a value? */
static bool has_indices(struct maker *m, const struct chain *chain)
{
	char *text = room(m);
	bool all = true;

	for (uint32_t i = 0; i < chain->dimensions; i++)
		all = typed(m, chain->dimension[i * CODE_DIMENSION], text) && all;
	return all;
}

/* The conditions under which element @number is meant, and its offset; false: never. */
static bool put_selected(struct maker *m, const struct chain *chain, uint32_t number,
			 uint64_t *where)
{
	char *index = room(m);
	char constant[NAME_SIZE];

	for (uint32_t i = chain->dimensions; i-- > 0; ) {
		const uint32_t *d = chain->dimension + i * CODE_DIMENSION;
		const uint32_t element = number % d[2];

		number /= d[2];
		*where += (uint64_t)element * d[3];
		if (!print_index(d[0], (int64_t)(int32_t)d[1] + element, constant) ||
		    !typed(m, d[0], index))
			return false;
		out(m, "LD", index);
		out(m, "NE", constant);
		jump(m, "JMPC", "N", m->labels);
	}
	return true;
}

static bool put_moved(struct maker *m, const struct chain *chain, uint64_t where)
{
	const uint32_t *at = chain->at;
	char *value = room(m), *text = room(m);

	if (chain->block)
		return chain->store ? put_values(m, (uint32_t)where, at[3], at[4]) :
				      put_values(m, at[2], (uint32_t)where, at[4]);
	if (!typed(m, at[2], value) || !element(m, chain->bit, at[3], where, text))
		return false;
	out(m, "LD", chain->store ? value : text);
	out(m, "ST", chain->store ? text : value);
	return true;
}

static void clear_value(struct maker *m, uint32_t word)
{
	static const struct iec_string none = { 0, 0 };
	const enum iec_type type = (enum iec_type)CODE_TYPE(word);
	union iec_value zero = { .i = 0 };
	char *text = room(m);

	if (type == IEC_STRING)
		zero.s = &none;
	else if (type == IEC_REAL || type == IEC_LREAL)
		zero.r = 0;
	print_value(type, zero, text, ROOM);
	out(m, "LD", text);
	typed(m, word, text);
	out(m, "ST", text);
}

/* One after another: the elements that the index may select. */
static void put_chain(struct maker *m, const struct chain *chain)
{
	const uint32_t *at = chain->at, label = m->labels++;
	const uint32_t base = CODE_OFFSET(chain->block && chain->store ? at[2] : at[3]);
	const uint64_t count = chain_count(chain);
	struct term en;
	char *ok = room(m);
	bool good = term_of(m, at[0], &en) && operand(m, IEC_BOOL, at[1], ok) && count <= CHAIN_LIMIT;

	if (!good || !has_indices(m, chain)) {
		lose(m, good ? "an array with an index without a name" :
			       "an array of many elements");
		return;
	}
	if (!(en.known && en.value)) {
		load(m, &en, false);
		jump(m, "JMPCN", "F", label);
	}
	for (uint32_t i = 0; good && i < count; i++) {
		const int used = m->room_used;
		uint64_t where = base;

		if (put_selected(m, chain, i, &where)) {
			good = put_moved(m, chain, where);
			out(m, "LD", "TRUE");
			out(m, "ST", ok);
			jump(m, "JMP", "D", label);
		}
		put_label(m, "N", m->labels++);
		m->room_used = used;
	}
	put_label(m, "F", label);
	if (!chain->store && !chain->block && !chain->keep)
		clear_value(m, at[2]);
	count_failure(m, &en);
	out(m, "LD", "FALSE");
	out(m, "ST", ok);
	put_label(m, "D", label);
	if (!good)
		lose(m, "an array of what has no name");
}

/* ---- an array by its name ---- */

/* An array in an area: a variable AT its first element. @bit: of the areas; else in bytes. */
static const char *area_array(struct maker *m, uint32_t type, bool bits, uint32_t offset,
			      struct var_array array)
{
	char like[96], address[40];
	struct object *o;

	for (int i = 0; i < m->at_count; i++) {
		o = &m->at[i];
		if (o->array.count == array.count && o->array.low == array.low &&
		    o->offset == offset && o->type == type && o->inside == bits)
			return o->name;
	}
	print_place(m, type, bits, offset, address);
	snprintf(like, sizeof(like), "%s_%s_%u", address + 1,
		 iec_type_row((enum iec_type)type)->word, (unsigned)array.count);
	flatten(like, sizeof(like), like, strlen(like));
	o = arena_push(&m->arena, &m->at, &m->at_count, sizeof(*o));
	if (!o)
		return "";
	*o = (struct object){ .offset = offset, .type = (uint8_t)type,
			      .array = array, .inside = bits };
	o->name = free_name(m, like);
	return o->name ? o->name : "";
}

/* Has the type of the index at @at all indices of an array, and what is added to it? */
static bool holds_all(const uint32_t *at, const struct var_array *array, int64_t shift)
{
	const struct iec_type_row *row = iec_type_row((enum iec_type)CODE_TYPE(at[4]));

	return row->class == CLASS_SIGNED && array->low >= row->low &&
	       (int64_t)array->low + array->count - 1 <= row->high && shift >= row->low &&
	       shift <= row->high;
}

/* The name of the array that AGET or APUT accesses as a whole; false: it has none. @shift: what is
 * to be added to the index. */
static bool find_array(struct maker *m, const uint32_t *at, bool bits, char *text, int64_t *shift)
{
	const uint32_t type = bits ? IEC_BOOL : CODE_TYPE(at[3]), base = CODE_OFFSET(at[3]);
	const struct var_array array = { (int32_t)at[5], at[6] };
	const struct object *o;

	if (bits || real(m, base) < m->program->areas.size) {
		if (at[7] != (bits ? 1u : iec_type_row((enum iec_type)type)->size))
			return false;
		snprintf(text, NAME_SIZE, "%.255s", area_array(m, type, bits, base, array));
		return true;
	}
	o = object_at(m, real(m, base));
	if (!o || o->offset != real(m, base) || o->type != type || !o->name || !is_seen(m, o) ||
	    o->array.count != array.count)
		return false;
	*shift = (int64_t)o->array.low - array.low;
	if (*shift && !holds_all(at, &o->array, *shift))
		return false;
	snprintf(text, NAME_SIZE, "%.*s", (int)strcspn(o->name, "["), o->name);
	return array.count < 2 || o[1].offset - o->offset == at[7];
}

/* Jumps to F unless the index is inside, and leaves it in a variable; false: it never is. */
static bool put_range(struct maker *m, const uint32_t *at, uint32_t label, char *index)
{
	const struct iec_type_row *row = iec_type_row((enum iec_type)CODE_TYPE(at[4]));
	const int64_t low = (int32_t)at[5], high = low + at[6] - 1;
	char *text = room(m);

	if (!typed(m, at[4], text))
		return false;
	if (!m->index[CODE_TYPE(at[4])]) {
		snprintf(index, NAME_SIZE, "Index_of_image_%s", row->word);
		m->index[CODE_TYPE(at[4])] = free_name(m, index);
	}
	snprintf(index, NAME_SIZE, "%.300s", m->index[CODE_TYPE(at[4])] ?
		 m->index[CODE_TYPE(at[4])] : "");
	out(m, "LD", text);
	out(m, "ST", index);
	if (print_index(at[4], low, text)) {
		out(m, "LD", index);
		out(m, "LT", text);
		jump(m, "JMPC", "F", label);
	} else if (low > 0) {
		return false;
	}
	if (print_index(at[4], high, text)) {
		out(m, "LD", index);
		out(m, "GT", text);
		jump(m, "JMPC", "F", label);
	} else if (high < 0) {
		return false;
	}
	return true;
}

/* Like put_chain(), with an index behind the name. False: it has no name. */
static bool put_indexed(struct maker *m, const struct chain *chain)
{
	const uint32_t *at = chain->at, label = m->labels;
	char *ok = room(m), *value = room(m);
	char *array = room(m), *index = room(m), *text = room(m);
	struct term en;
	int64_t shift = 0;

	if (!find_array(m, at, chain->bit, array, &shift) || !term_of(m, at[0], &en) ||
	    !operand(m, IEC_BOOL, at[1], ok) || !typed(m, at[2], value) ||
	    !typed(m, at[4], text))
		return false;
	m->labels++;
	if (!(en.known && en.value)) {
		load(m, &en, false);
		jump(m, "JMPCN", "F", label);
	}
	if (put_range(m, at, label, index)) {
		if (shift) {
			snprintf(text, ROOM, "%s#%" PRId64,
				 iec_type_row((enum iec_type)CODE_TYPE(at[4]))->word, shift);
			out(m, "LD", index);
			out(m, "ADD", text);
			out(m, "ST", index);
		}
		snprintf(text, ROOM, "%.300s[%.300s]", array, index);
		out(m, "LD", chain->store ? value : text);
		out(m, "ST", chain->store ? text : value);
		out(m, "LD", "TRUE");
		out(m, "ST", ok);
		jump(m, "JMP", "D", label);
	}
	put_label(m, "F", label);
	if (!chain->store && !chain->keep)
		clear_value(m, at[2]);
	count_failure(m, &en);
	out(m, "LD", "FALSE");
	out(m, "ST", ok);
	put_label(m, "D", label);
	return true;
}

static void put_element(struct maker *m, const uint32_t *at, uint32_t n, bool store);

/* A store into a subrange: its last index is the value, and moves nothing. */
static bool put_ranged(struct maker *m, const uint32_t *at, uint32_t n)
{
	const uint32_t dims = 1 + (n >> 1), label = m->labels;
	const uint32_t *last = at + 4 + (dims - 1) * CODE_DIMENSION;
	char *ok = room(m), *value = room(m), *to = room(m), *index = room(m);
	struct term en;

	if (last[3] || !term_of(m, at[0], &en) || !operand(m, IEC_BOOL, at[1], ok) ||
	    !typed(m, at[2], value) || (dims == 1 && !typed(m, at[3], to)))
		return false;
	m->labels++;
	if (!(en.known && en.value)) {
		load(m, &en, false);
		jump(m, "JMPCN", "F", label);
	}
	if (put_range(m, last - 4, label, index)) {
		if (dims > 1) {
			put_element(m, at, n - 2, true);
		} else {
			out(m, "LD", value);
			out(m, "ST", to);
			out(m, "LD", "TRUE");
			out(m, "ST", ok);
		}
		jump(m, "JMP", "D", label);
	}
	put_label(m, "F", label);
	count_failure(m, &en);
	out(m, "LD", "FALSE");
	out(m, "ST", ok);
	put_label(m, "D", label);
	return true;
}

static void put_element(struct maker *m, const uint32_t *at, uint32_t n, bool store)
{
	const bool keep = !store && n & CODE_KEEP;

	n &= CODE_ACCESS;
	if (store && put_ranged(m, at, n))
		return;
	const struct chain chain = { .at = at, .dimension = at + 4, .dimensions = 1 + (n >> 1),
				     .bit = n & 1, .store = store, .keep = keep };

	if (chain.dimensions > 1 || chain_count(&chain) <= CHAIN_MOST || !put_indexed(m, &chain))
		put_chain(m, &chain);
}

static void put_element_block(struct maker *m, const uint32_t *at, uint32_t n)
{
	const struct chain chain = { .at = at, .dimension = at + 5, .dimensions = 1 + (n >> 1),
				     .block = true, .store = n & 1 };

	put_chain(m, &chain);
}

static void put_block(struct maker *m, const uint32_t *at)
{
	if (!put_values(m, at[0], at[1], at[2]))
		lose(m, "a copy of a function block");
}

/* ---- blocks of the project ---- */

/* What the image calls an entry; "": it has no names. */
static const char *entry_text(const struct maker *m, uint32_t entry)
{
	return m->program->string_bytes ?
	       m->program->string + m->program->entry[entry].name : "";
}

/* Entries have their names first. */
static bool name_entries(struct maker *m)
{
	const struct program *p = m->program;
	char text[NAME_SIZE];
	bool good = true;

	for (uint32_t i = 0; i < p->entry_count; i++) {
		snprintf(text, sizeof(text), "P%u", (unsigned)i);
		if (*entry_text(m, i))
			flatten(text, sizeof(text), entry_text(m, i), strlen(entry_text(m, i)));
		m->entry_name[i] = free_name(m, text);
		good = good && m->entry_name[i];
	}
	return good;
}

/* The list of a block for one instance; NULL: no memory. */
static const struct special *special_of(struct maker *m, const struct special *like)
{
	char text[2 * NAME_SIZE];
	struct special *s;

	for (int i = 0; i < m->special_count; i++) {
		s = &m->special[i];
		if (s->entry == like->entry && s->frame == like->frame &&
		    s->size == like->size && s->instance == like->instance)
			return s;
	}
	snprintf(text, sizeof(text), "%s_%u", m->entry_name[like->entry], (unsigned)like->instance);
	s = arena_push(&m->arena, &m->special, &m->special_count, sizeof(*s));
	if (!s)
		return NULL;
	*s = *like;
	s->name = NULL;
	s->name = free_name(m, text);
	return s;
}

/* Copy to the frame, call, copy back: words of the three instructions; 0: something else. */
static uint32_t put_instance_call(struct maker *m, uint32_t i, uint32_t end)
{
	const uint32_t *code = m->program->text + i, *call = code + 4, *back = code + 6;
	const struct special *s;

	if (end - i < 10 || (code[0] & 0xff) != VM_BLOCK || (call[0] & 0xff) != VM_CALL ||
	    (back[0] & 0xff) != VM_BLOCK || m->target[i + 4] || m->target[i + 6] ||
	    code[1] != back[2] || code[2] != back[1] || code[3] != back[3])
		return 0;
	s = special_of(m, &(struct special){ .entry = call[1], .frame = code[1],
		.size = code[3], .instance = real(m, code[2]) });
	if (s && s->name)
		out(m, "CAL", s->name);
	return 10;
}

/* ---- charts ---- */

static void put_each(struct maker *m, const uint32_t *at, uint32_t n)
{
	char *cursor = room(m), *bit = room(m);
	char number[40];

	if (!operand(m, IEC_UDINT, at[0], cursor)) {
		lose(m, "the steps of a chart");
		return;
	}
	for (uint32_t i = 0; i < n; i++) {
		if (!operand(m, IEC_BOOL, at[1] + i, bit)) {
			lose(m, "a step of a chart");
			continue;
		}
		snprintf(number, sizeof(number), "UDINT#%u", (unsigned)i);
		out(m, "LD", cursor);
		out(m, "LE", number);
		out(m, "AND", bit);
		jump(m, "JMPCN", "N", m->labels);
		snprintf(number, sizeof(number), "UDINT#%u", (unsigned)i + 1);
		out(m, "LD", number);
		out(m, "ST", cursor);
		jump(m, "JMP", "L", at[2 + i]);
		put_label(m, "N", m->labels++);
	}
	out(m, "LD", "UDINT#0");
	out(m, "ST", cursor);
}

static const char *next_clock(struct maker *m)
{
	char text[32];
	char **slot;

	if ((int)m->clocks == m->clock_count) {
		slot = arena_push(&m->arena, &m->clock, &m->clock_count, sizeof(*slot));
		if (!slot)
			return "";
		snprintf(text, sizeof(text), "Clock_of_image_%u", (unsigned)m->clocks);
		*slot = free_name(m, text);
	}
	slot = &m->clock[m->clocks++];
	return *slot ? *slot : "";
}

/* A timer that runs for ever tells the time that has passed. */
static void put_tick(struct maker *m, const uint32_t *at, uint32_t n)
{
	char *last = room(m), *dt = room(m), *bit = room(m), *time = room(m);
	const char *clock;
	char text[NAME_SIZE + 40];
	struct term hold;
	bool good = term_of(m, at[0], &hold) && operand(m, IEC_TIME, at[1], last) &&
		    operand(m, IEC_TIME, at[2], dt);

	for (uint32_t i = 0; i < n; i++)
		good = good && operand(m, IEC_BOOL, at[3] + i, bit) &&
		       operand(m, IEC_TIME, at[4] + 8 * i, time);
	if (!good) {
		lose(m, "the time of steps");
		return;
	}
	clock = next_clock(m);
	snprintf(text, sizeof(text), "%s(IN := TRUE, PT := T#106751d)", clock);
	out(m, "CAL", text);
	snprintf(text, sizeof(text), "%s.ET", clock);
	out(m, "LD", text);
	out(m, "SUB", last);
	out(m, "ST", dt);
	out(m, "LD", text);
	out(m, "ST", last);
	load(m, &hold, false);
	jump(m, "JMPCN", "N", m->labels);
	out(m, "LD", "T#0s");
	out(m, "ST", dt);
	put_label(m, "N", m->labels++);
	for (uint32_t i = 0; i < n; i++) {
		operand(m, IEC_BOOL, at[3] + i, bit);
		operand(m, IEC_TIME, at[4] + 8 * i, time);
		out(m, "LD", bit);
		jump(m, "JMPCN", "N", m->labels);
		out(m, "LD", time);
		out(m, "ADD", dt);
		out(m, "ST", time);
		put_label(m, "N", m->labels++);
	}
}

/* ---- one instruction ---- */

static void put_conditional(struct maker *m, const char *operator, uint32_t offset)
{
	struct term term;

	if (!term_of(m, offset, &term)) {
		lose(m, "a condition without a name");
		return;
	}
	load(m, &term, false);
	out(m, operator, "");
}

static void put_jump(struct maker *m, const uint32_t *at, bool if_false)
{
	struct term term;

	if (!term_of(m, at[1], &term)) {
		lose(m, "a condition without a name");
		return;
	}
	load(m, &term, false);
	jump(m, if_false ? "JMPCN" : "JMPC", "L", at[0]);
}

static void put_bit(struct maker *m, const uint32_t *at, uint32_t bit, bool get)
{
	const uint32_t byte = get ? at[0] : at[1];
	char *other = room(m);
	char address[NAME_SIZE];

	if (byte >= m->program->areas.size ||
	    !operand(m, IEC_BOOL, get ? at[1] : at[0], other)) {
		lose(m, "a bit of a value");
		return;
	}
	print_bit(m, byte, bit, address);
	out(m, "LD", get ? address : other);
	out(m, "ST", get ? other : address);
}

/* Comparisons, which translation finds again. Numbers without a branch lead behind the targets. */
static void put_switch(struct maker *m, const uint32_t *at, uint32_t n)
{
	const uint32_t behind = (uint32_t)(at + 2 + n - m->program->text);
	char *index = room(m);
	char constant[NAME_SIZE];

	if (!typed(m, at[0], index)) {
		lose(m, "a choice without a name");
		return;
	}
	for (uint32_t i = 0; i < n; i++) {
		if (at[2 + i] == behind || !print_index(at[0], (int64_t)(int32_t)at[1] + i, constant))
			continue;
		out(m, "LD", index);
		out(m, "EQ", constant);
		jump(m, "JMPC", "L", at[2 + i]);
	}
}

static void put_code_text(struct maker *m, const uint32_t *code)
{
	const uint32_t n = *code >> 8, *at = code + 1;
	const enum vm_op op = (enum vm_op)(*code & 0xff);
	struct object *o;

	switch (op) {
	case VM_LUT:
		for (uint32_t i = 0; i < n; i++)
			put_lut(m, at + 4 * i);
		break;
	case VM_BITGET:
	case VM_BITPUT:
		put_bit(m, at, n, op == VM_BITGET);
		break;
	case VM_COPY:
		put_copy(m, at);
		break;
	case VM_CMP:
	case VM_CMP_REAL:
	case VM_CMP_DINT:
	case VM_CMP_INT:
		put_cmp(m, at, code_type(op), n);
		break;
	case VM_REAL:
	case VM_DINT:
	case VM_INT:
		if (n & MATH_LEFT)
			put_math_lines(m, at, code_type(op), n);
		else
			put_math(m, at, code_type(op), n);
		break;
	case VM_FN:
		put_fn(m, at, n);
		break;
	case VM_FB:
		o = object_at(m, real(m, at[0]));
		if (o && o->offset == real(m, at[0]) && o->type == IEC_NONE && is_seen(m, o))
			out(m, "CAL", object_name(m, o));
		else
			lose(m, "a call of an unknown function block");
		break;
	case VM_BLOCK:
		put_block(m, at);
		break;
	case VM_CALL:
		m->called[at[0]] = true;
		out(m, "CAL", m->entry_name[at[0]]);
		break;
	case VM_STOP:
		put_conditional(m, "STPC", at[0]);
		break;
	case VM_JMP:
		jump(m, "JMP", "L", at[0]);
		break;
	case VM_JMPC:
		put_jump(m, at, n);
		break;
	case VM_AGET:
	case VM_APUT:
		put_element(m, at, n, op == VM_APUT);
		break;
	case VM_EACH:
		put_each(m, at, n);
		break;
	case VM_SWITCH: put_switch(m, at, n); break;
	case VM_ABLOCK:
		put_element_block(m, at, n);
		break;
	case VM_TICK:
		put_tick(m, at, n);
		break;
	case VM_END:
		out(m, "RET", "");
		break;
	case VM_PEEK: case VM_POKE:
		out(m, "(*", "a pointer: lists have none *)");
		break;
	case VM_POINT: /* translation finds it again */
	case VM_COUNT:
		break;
	}
}

static void put_code(struct maker *m, const uint32_t *code)
{
	const int used = m->room_used;

	put_code_text(m, code);
	m->room_used = used;
}

/* ---- lists ---- */

static void note_targets(struct maker *m, const uint32_t *code)
{
	const uint32_t n = *code >> 8, *at = code + 1;

	switch ((enum vm_op)(*code & 0xff)) {
	case VM_JMP:
	case VM_JMPC:
		m->target[at[0]] = 1;
		break;
	case VM_EACH:
	case VM_SWITCH:
		for (uint32_t i = 0; i < n; i++)
			m->target[at[2 + i]] = 1;
		break;
	case VM_END: case VM_LUT: case VM_BITGET: case VM_BITPUT: case VM_COPY: case VM_CMP:
	case VM_CMP_REAL: case VM_CMP_DINT: case VM_CMP_INT: case VM_REAL: case VM_DINT:
	case VM_INT: case VM_FN: case VM_FB: case VM_BLOCK: case VM_CALL: case VM_STOP:
	case VM_AGET: case VM_APUT: case VM_TICK: case VM_ABLOCK: case VM_POINT:
	case VM_PEEK: case VM_POKE: case VM_COUNT:
		break;
	}
}

/* Is this entry run by a task? Others are called. */
static bool is_program(const struct maker *m, uint32_t entry)
{
	for (uint32_t i = 0; i < m->program->call_count; i++)
		if (m->program->call[i] == entry)
			return true;
	return false;
}

static void put_locals(struct maker *m, const char *pou);

static void put_body(struct maker *m, uint32_t entry)
{
	const struct code_program *at = &m->program->entry[entry];
	const uint32_t *text = m->program->text, end = at->text + at->text_words;
	uint32_t words, before = VM_COUNT;

	for (uint32_t i = at->text; i < end; i += code_words(text + i))
		note_targets(m, text + i);
	for (uint32_t i = at->text; i < end; before = text[i] & 0xff, i += words) {
		if (m->target[i])
			put_label(m, "L", i);
		words = put_instance_call(m, i, end);
		if (words)
			continue;
		words = code_words(text + i);
		/* A RET at the end or behind another says nothing, unless something jumps there. */
		if ((text[i] & 0xff) != VM_END || m->target[i] || i == at->text ||
		    (i + 1 < end && before != VM_END))
			put_code(m, text + i);
	}
}

/* @within: whose variables it sees; NULL: only globals. */
static void put_pou(struct maker *m, const char *word, const char *name, uint32_t entry,
		    const char *within)
{
	m->pou = name;
	m->within = within;
	if (m->writing) {
		sink_printf(m->sink, "\n%s ", word);
		sink_text(m->sink, name);
		sink_text(m->sink, " IL\n");
		if (within)
			put_locals(m, within);
	}
	put_body(m, entry);
	if (m->writing)
		sink_printf(m->sink, "END_%s\n", word);
	m->pou = m->within = NULL;
}

/* ---- declarations ---- */

static bool is_retained(const struct maker *m, const struct object *o)
{
	const struct code_header *h = m->program->header;

	return o->offset >= h->retain_offset && o->offset - h->retain_offset < h->retain_size;
}

static void put_instance(struct maker *m, const struct object *o)
{
	const struct word_row *row = word_row((enum word)o->word);
	const struct word_pin *pin = word_pins(row);
	char *text = room(m);
	bool any = false;

	sink_printf(m->sink, " : %s", row->word);
	for (int i = 0; i < row->pin_count; i++) {
		const struct location at = { .type = pin[i].type,
					     .where = o->offset + pin[i].offset };
		union iec_value value;

		if (pin[i].dir != PIN_IN || pin[i].type == IEC_NONE || pin[i].type == IEC_STRING ||
		    pin[i].elements)
			continue;
		value = image_get(&m->image, at);
		if (value.i == (pin[i].has_init ? pin_init(&pin[i]).i : 0))
			continue;
		print_value(pin[i].type, value, text, ROOM);
		sink_printf(m->sink, "%s%s := %s", any ? ", " : " := (", pin[i].name, text);
		any = true;
	}
	sink_text(m->sink, any ? ");\n" : ";\n");
}

static bool is_initial(const struct object *o, union iec_value value)
{
	return o->type == IEC_STRING ? value.s->length == 0 : value.i == 0;
}

static void put_declaration(struct maker *m, const struct object *o)
{
	union iec_value value;
	char *text = room(m);
	bool any = false;

	sink_text(m->sink, "  ");
	sink_write(m->sink, o->name, strcspn(o->name, "["));
	if (o->type == IEC_NONE) {
		put_instance(m, o);
		return;
	}
	sink_text(m->sink, " : ");
	if (o->array.count)
		sink_printf(m->sink, "ARRAY[%d..%lld] OF ", (int)o->array.low,
			    (long long)o->array.low + o->array.count - 1);
	sink_text(m->sink, iec_type_row((enum iec_type)o->type)->word);
	if (o->type == IEC_STRING)
		sink_printf(m->sink, "[%u]", (unsigned)o->word);
	for (uint32_t i = 0; i == 0 || i < o->array.count; i++) {
		value = value_at(m, o->type, o[i].offset);
		any |= !is_initial(o, value);
	}
	for (uint32_t i = 0; any && (i == 0 || i < o->array.count); i++) {
		print_value((enum iec_type)o->type, value_at(m, o->type, o[i].offset), text,
			    ROOM);
		sink_text(m->sink, i ? ", " : o->array.count ? " := [" : " := ");
		sink_text(m->sink, text);
	}
	sink_text(m->sink, any && o->array.count ? "];\n" : ";\n");
}

/* The variables of a program or, with NULL, the globals. */
static void put_vars(struct maker *m, const char *pou, bool retained)
{
	bool any = false;

	for (int i = 0; i < m->count; i++) {
		const struct object *o = &m->object[i];

		if (!o->name || o->inside || is_retained(m, o) != retained ||
		    (pou ? !o->pou || !name_equal(o->pou, pou) : o->pou != NULL))
			continue;
		if (!any)
			sink_printf(m->sink, "%sVAR%s\n", pou ? "" : "\n", retained ? " RETAIN" : "");
		any = true;
		put_declaration(m, o);
		m->room_used = 0;
	}
	if (any)
		sink_text(m->sink, "END_VAR\n");
}

static void put_locals(struct maker *m, const char *pou)
{
	put_vars(m, pou, true);
	put_vars(m, pou, false);
}

/* Offset of a place in the areas: bits, or bytes. */
static uint32_t place_of(const struct maker *m, struct location at)
{
	return at.area == AREA_NONE ? at.where : m->program->areas.at[at.area] * 8 + at.where;
}

/* Variables with an address get the names of the image. */
static void name_places(struct maker *m)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name symbol;
	char flat[NAME_SIZE];
	struct object *o;

	while (image_next_declared(m->program, &cursor, &symbol)) {
		if (symbol.at.type == IEC_NONE ||
		    (symbol.at.area == AREA_NONE && symbol.at.where >= m->program->areas.size))
			continue;
		o = arena_push(&m->arena, &m->at, &m->at_count, sizeof(*o));
		if (!o)
			return;
		flatten(flat, sizeof(flat), symbol.name, symbol.array.head);
		*o = (struct object){
			.name = global_name(m, symbol.pou, flat),
			.type = (uint8_t)symbol.at.type, .offset = place_of(m, symbol.at),
			.inside = symbol.at.area != AREA_NONE,
			.array = { symbol.array.low, symbol.array.count },
		};
	}
}

/* The byte at a place in the areas, as a cold start has it, if a program may write it. */
static uint8_t first_byte(struct maker *m, uint32_t offset)
{
	const enum iec_area area = areas_find(&m->program->areas, offset);

	return iec_area_row(area)->access == ACCESS_READ ? 0 :
	       image_area(&m->image, area)[offset - m->program->areas.at[area]];
}

static void put_place(struct maker *m, const struct object *o)
{
	char address[40];
	uint8_t byte = 0;

	print_place(m, o->type, o->inside, o->offset, address);
	sink_printf(m->sink, "  %.255s AT %s : ", o->name ? o->name : "", address);
	if (o->array.count)
		sink_printf(m->sink, "ARRAY[%d..%lld] OF ", (int)o->array.low,
			    (long long)o->array.low + o->array.count - 1);
	sink_text(m->sink, iec_type_row((enum iec_type)o->type)->word);
	if (o->type == IEC_BYTE && !o->array.count && !o->inside)
		byte = first_byte(m, o->offset);
	if (byte)
		sink_printf(m->sink, " := 16#%02X", byte);
	sink_text(m->sink, ";\n");
}

static bool has_byte(const struct maker *m, uint32_t offset)
{
	for (int i = 0; i < m->at_count; i++)
		if (m->at[i].type == IEC_BYTE && m->at[i].offset == offset &&
		    !m->at[i].array.count && !m->at[i].inside)
			return true;
	return false;
}

/* Initial values in areas, byte by byte: several variables may lie on one. */
static void put_area_values(struct maker *m)
{
	char address[40], name[64];

	for (int area = AREA_NONE + 1; area < AREA_COUNT; area++) {
		const uint32_t at = m->program->areas.at[area];

		for (uint32_t i = 0; i < m->program->areas.bytes[area]; i++) {
			struct iec_addr addr = { .area = (enum iec_area)area, .bits = 8, .byte = i };
			const uint8_t byte = first_byte(m, at + i);

			if (!byte || has_byte(m, at + i))
				continue;
			iec_addr_print(addr, address, sizeof(address));
			snprintf(name, sizeof(name), "Initial_%s", address + 1);
			const char *made = free_name(m, name);

			sink_printf(m->sink, "  %s AT %s : BYTE := 16#%02X;\n",
				    made ? made : "", address, byte);
		}
	}
}

/* Variables with an address, and what the lists need besides those of the image. */
static void put_addresses(struct maker *m)
{
	sink_text(m->sink, "\nVAR\n");
	for (int i = 0; i < m->at_count; i++)
		put_place(m, &m->at[i]);
	for (int i = 0; i < IEC_TYPE_COUNT; i++)
		if (m->index[i])
			sink_printf(m->sink, "  %s : %s;\n", m->index[i],
				    iec_type_row((enum iec_type)i)->word);
	put_area_values(m);
	for (int i = 0; i < m->clock_count && m->clock[i]; i++)
		sink_printf(m->sink, "  %s : TON;\n", m->clock[i]);
	if (m->zero)
		sink_printf(m->sink, "  %s : INT;\n", m->zero);
	sink_text(m->sink, "END_VAR\n");
}

/* ---- VAR_ACCESS ---- */

/* As the list calls the program that the image calls @pou; NULL: it has none. */
static const char *name_of_program(const struct maker *m, const char *pou)
{
	for (uint32_t i = 0; i < m->program->entry_count; i++) {
		const char *text = entry_text(m, i);

		if (text && m->entry_name[i] && name_equal(text, pou))
			return m->entry_name[i];
	}
	return NULL;
}

/* The path of what operators may read and write; false: it has none. */
static bool print_path(struct maker *m, const struct declared_name *access, char *text)
{
	const struct location at = access->at;
	const char *pou = NULL;
	struct object *o;
	char *name = room(m);
	bool good;

	if (at.area != AREA_NONE || at.where < m->program->areas.size) {
		for (int i = 0; i < m->at_count; i++)
			if (m->at[i].name && m->at[i].type == at.type &&
			    m->at[i].offset == place_of(m, at) &&
			    m->at[i].inside == (at.area != AREA_NONE) &&
			    m->at[i].array.count == access->array.count) {
				snprintf(text, ROOM, "%s", m->at[i].name);
				return !access->array.count || m->at[i].array.low == access->array.low;
			}
		print_place(m, at.type, at.area != AREA_NONE, place_of(m, at), text);
		return !access->array.count;
	}
	o = object_at(m, at.where);
	if (!o || code_run_at(m->program, at.where) == NULL ||
	    code_run_at(m->program, at.where)->kind == RUN_CONSTANTS)
		return false;
	m->within = o->pou;
	good = operand(m, at.type, at.where, name);
	m->within = NULL;
	if (o->pou)
		pou = name_of_program(m, o->pou);
	if (!good || (o->pou && !pou))
		return false;
	if (access->array.count && (o->array.count != access->array.count ||
				    o->array.low != access->array.low))
		return false;
	if (access->array.count)
		name[strcspn(name, "[")] = '\0';
	snprintf(text, ROOM, "%s%s%.1000s", pou ? pou : "", pou ? "." : "", name);
	return true;
}

/* What a name of VAR_ACCESS becomes; false: nothing. @path: gets the variable's. It may be the
 * variable's own name. */
static bool name_access(struct maker *m, const struct declared_name *access, char *path,
			char *name)
{
	char flat[NAME_SIZE];
	const char *own, *made;

	if (!print_path(m, access, path))
		return false;
	flatten(flat, sizeof(flat), access->name, access->array.head);
	own = strrchr(path, '.') ? strrchr(path, '.') + 1 : path;
	made = name_equal(own, flat) ? flat : free_name(m, flat);
	snprintf(name, NAME_SIZE, "%s", made ? made : "");
	return true;
}

static void put_access_line(struct maker *m, const struct declared_name *access)
{
	const struct object *o = object_at(m, access->at.where);
	char *path = room(m), *name = room(m), *text = room(m);
	const int len = (int)access->array.head;

	m->pou = "VAR_ACCESS";
	if (!name_access(m, access, path, name)) {
		flatten(name, NAME_SIZE, access->name, access->array.head);
		snprintf(text, ROOM, "access to %.255s", name);
		lose(m, text);
		return;
	}
	if ((int)strlen(name) != len || memcmp(name, access->name, strlen(name))) {
		snprintf(text, ROOM, "an access as it was named; it is now %.255s", name);
		lose(m, text);
	}
	sink_printf(m->sink, "  %.255s : ", name);
	sink_text(m->sink, path);
	sink_text(m->sink, " : ");
	if (access->array.count)
		sink_printf(m->sink, "ARRAY[%d..%lld] OF ", (int)access->array.low,
			    (long long)access->array.low + access->array.count - 1);
	sink_text(m->sink, iec_type_row(access->at.type)->word);
	if (access->at.type == IEC_STRING && o)
		sink_printf(m->sink, "[%u]", (unsigned)o->word);
	sink_printf(m->sink, " %s;\n", access->flags & SYMBOL_WRITABLE ? "READ_WRITE" : "READ_ONLY");
}

/* Variables that only operators use get their names before declarations are written. */
static void find_accessed(struct maker *m)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name access;

	while (image_next_access(m->program, &cursor, &access)) {
		print_path(m, &access, room(m));
		m->room_used = 0;
	}
}

static void put_access(struct maker *m)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name access;
	bool any = false;

	m->writing = true;
	while (image_next_access(m->program, &cursor, &access)) {
		if (!any)
			sink_text(m->sink, "\nVAR_ACCESS\n");
		any = true;
		put_access_line(m, &access);
		m->room_used = 0;
	}
	m->pou = NULL;
	if (any)
		sink_text(m->sink, "END_VAR\n");
}

/* ---- tasks ---- */

static const char *task_name(const struct maker *m, uint32_t task, char *text)
{
	const struct code_task *at = &m->program->task[task];

	const char *name = m->program->string_bytes ? m->program->string + at->name : "";

	if (*name)
		flatten(text, NAME_SIZE, name, strlen(name));
	else
		snprintf(text, NAME_SIZE, "Task%u", (unsigned)task);
	return text;
}

static int64_t wide(const uint32_t *words)
{
	return (int64_t)((uint64_t)words[1] << 32 | words[0]);
}

static void put_task(struct maker *m, uint32_t task)
{
	const struct code_task *at = &m->program->task[task];
	char *text = room(m);
	char name[NAME_SIZE];
	bool good = true;

	if (at->kind == TASK_CYCLE)
		return;
	sink_printf(m->sink, "  TASK %s (", task_name(m, task, name));
	if (at->kind == TASK_INTERVAL) {
		literal_print_time(wide(at->interval), text, ROOM);
		sink_printf(m->sink, "INTERVAL := %s", text);
	} else {
		if (CODE_OFFSET(at->single) < m->program->areas.size)
			print_bit(m, CODE_OFFSET(at->single), at->single >> CODE_OFFSET_BITS, text);
		else
			good = operand(m, IEC_BOOL, CODE_OFFSET(at->single), text);
		sink_printf(m->sink, "SINGLE := %s", text);
	}
	sink_printf(m->sink, ", PRIORITY := %u", (unsigned)at->priority);
	if (wide(at->watchdog)) {
		literal_print_time(wide(at->watchdog), text, ROOM);
		sink_printf(m->sink, ", WATCHDOG := %s", text);
	}
	sink_text(m->sink, ");\n");
	if (!good)
		lose(m, "a task that starts with a bit without a name");
}

static void put_tasks(struct maker *m)
{
	const struct program *p = m->program;
	struct areas usual;
	char name[NAME_SIZE];

	m->writing = true;
	areas_init(&usual);
	sink_text(m->sink, "\nCONFIGURATION Image\n");
	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++)
		if (p->areas.bytes[i] != usual.bytes[i])
			sink_printf(m->sink, "  AREA %s %u;\n",
				    iec_area_row((enum iec_area)i)->letters,
				    (unsigned)p->areas.bytes[i]);
	for (uint32_t i = 0; i < p->task_count; i++) {
		put_task(m, i);
		m->room_used = 0;
	}
	for (uint32_t i = 0; i < p->task_count; i++)
		for (uint32_t k = 0; k < p->task[i].count; k++) {
			const uint32_t entry = p->call[p->task[i].first + k];

			sink_printf(m->sink, "  PROGRAM Run%u", (unsigned)(p->task[i].first + k));
			if (p->task[i].kind != TASK_CYCLE)
				sink_printf(m->sink, " WITH %s", task_name(m, i, name));
			sink_printf(m->sink, " : %s;\n", m->entry_name[entry]);
		}
	sink_text(m->sink, "END_CONFIGURATION\n");
}

/* ---- all of it ---- */

/* The lists of instances come up while others are written. */
static void put_lists(struct maker *m, bool writing)
{
	m->writing = writing;
	m->labels = m->clocks = 0;
	for (uint32_t i = 0; i < m->program->entry_count; i++) {
		if (is_program(m, i) || m->called[i])
			put_pou(m, is_program(m, i) ? "PROGRAM" : "SUBROUTINE",
				m->entry_name[i], i, entry_text(m, i));
	}
	for (int i = 0; i < m->special_count; i++) {
		struct special now = m->special[i];

		m->now = &now;
		put_pou(m, "SUBROUTINE", now.name, now.entry, NULL);
		m->now = NULL;
	}
}

static int count_lists(const struct maker *m)
{
	int count = m->special_count;

	for (uint32_t i = 0; i < m->program->entry_count; i++)
		count += m->called[i];
	return count;
}

/* Entries that are called as they are: a call may come up in any list. */
static void find_called(struct maker *m)
{
	int before;

	do {
		before = count_lists(m);
		put_lists(m, false);
	} while (count_lists(m) > before);
}

static void put_file(struct maker *m)
{
	find_called(m); /* and which names are needed */
	find_accessed(m);
	sink_text(m->sink, "RUNGBOARD 1\n(* Made from a code image. *)\nPROJECT \"Image\"\n");
	put_tasks(m);
	put_vars(m, NULL, true);
	put_vars(m, NULL, false);
	put_addresses(m);
	put_access(m);
	put_lists(m, true);
}

/* Writes a rung file
 * @program: verified
 * @report:  `lost` is called for each instruction that has no list; its place has a comment
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false: no memory.
 */
static bool image_il_write(const struct program *program, const struct sink *sink,
			   struct image_il_report *report)
{
	struct maker *m = calloc(1, sizeof(*m));
	bool good = false;
	void *memory;

	if (!m)
		return false;
	*m = (struct maker){ .program = program, .sink = sink, .report = report };
	arena_init(&m->arena);
	memory = arena_alloc(&m->arena, image_memory_size(program));
	m->target = arena_alloc(&m->arena, program->text_words + 1u);
	m->rooms = arena_alloc(&m->arena, ROOMS * sizeof(*m->rooms));
	m->called = arena_alloc(&m->arena, program->entry_count + 1u);
	m->entry_name = arena_alloc(&m->arena, (program->entry_count + 1u) * sizeof(*m->entry_name));
	sink_memory_init(&m->call);
	if (memory && m->target && m->called && m->rooms && m->entry_name && grow_taken(m) &&
	    add_objects(m) && name_entries(m)) {
		image_init(&m->image, program, memory);
		name_objects(m, false);
		name_objects(m, true);
		name_places(m);
		put_file(m);
		good = !m->arena.failed && !m->call.failed;
	}
	sink_memory_free(&m->call);
	arena_free(&m->arena);
	free(m);
	return good;
}

/* ---- as text ---- */

static void take_lost(void *context, const char *pou, const char *text)
{
	const struct sink *sink = context;

	if (pou) {
		sink_text(sink, pou);
		sink_text(sink, ": ");
	}
	sink_text(sink, text);
	sink_text(sink, "\n");
}

char *image_il_text(const struct program *program, size_t *len, char **lost)
{
	struct sink_memory text, said;
	struct sink to_text, to_said;
	struct image_il_report report = { .lost = take_lost };

	*lost = NULL;
	sink_memory_init(&text);
	sink_memory_init(&said);
	to_text = sink_to_memory(&text);
	to_said = sink_to_memory(&said);
	report.context = &to_said;
	if (image_il_write(program, &to_text, &report) && !text.failed && !said.failed) {
		*len = text.len;
		*lost = said.text;
		return text.text;
	}
	sink_memory_free(&text);
	sink_memory_free(&said);
	return NULL;
}
