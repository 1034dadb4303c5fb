/* SPDX-License-Identifier: MIT
 *
 * catalog - the rows of catalog.def as const tables.
 *
 * The functions behind the words are in scan/. A small board links catalog_small.c
 * instead.
 */
#include "engine/base/catalog.h"
#include "engine/base/name.h"
#include "engine/base/ascii.h"

#define FB_PIN(fb, pin, way, kind) \
	.name = #pin, .type = IEC_##kind, .dir = way, \
	.offset = offsetof(struct fb_##fb, pin)
#define FB_DEF(fb, pin, type, value, text) \
	{ FB_PIN(fb, pin, PIN_IN, type), \
	  .has_init = true, .init = (int32_t)(value) }, /* a whole number, also of a REAL */
#define FB_IN(fb, pin, type, text)  { FB_PIN(fb, pin, PIN_IN, type) },
#define FB_OUT(fb, pin, type, text) { FB_PIN(fb, pin, PIN_OUT, type) },
#define FB_TEXT(fb, pin, doc)       { FB_PIN(fb, pin, PIN_IN, STRING), .capacity = WORD_TEXT },
#define FB_VAR(fb, pin, type)       { FB_PIN(fb, pin, PIN_VAR, type) },
#define FB_STORE(fb, pin, type, count) \
	{ FB_PIN(fb, pin, PIN_VAR, type), .elements = (count) > 1 ? (count) : 0 },
#define FB(id, family, doc, pins) \
	static const struct word_pin pins_##id[] = { pins };
#define FN_PIN(pin, what) \
	.name = #pin, .dir = PIN_IN, .classes = what
#define FN_IN(pin, classes, doc)  { FN_PIN(pin, classes) },
#define FN_OWN(pin, classes, doc) { FN_PIN(pin, classes), .own = true },
#define FN(id, family, doc, result, most, pins) \
	static const struct word_pin pins_##id[] = { pins };
#include "engine/catalog.def"

#define PINS(id) .pin = pins_##id, \
	.pin_count = sizeof(pins_##id) / sizeof(pins_##id[0])

/* The IL columns of an FB are those of its call, of an FN those of its result. */
static const struct word_row words[WORD_KNOWN] = {
#define ELEM(id_, word_, glyph_, family_, place_, operand_, edge_, first_, next_, \
	     negate_, doc_) \
	[ELEM_##id_] = { .word = word_, .number = ELEM_##id_, .kind = WORD_ELEM, \
		.place = place_, .operand = operand_, .edge = edge_, \
		.first = OP_##first_, .next = OP_##next_, .negate = negate_ },
#define FB(id_, family_, doc_, pins) \
	[FB_##id_] = { .word = #id_, .number = FB_##id_, .kind = WORD_FB, \
		.place = PLACE_BOX, .operand = OPND_INSTANCE, \
		.first = OP_CAL, .next = OP_CAL, PINS(id_), \
		.size = sizeof(struct fb_##id_) },
#define FN(id_, family_, doc_, result_, most_, pins) \
	[FN_##id_] = { .word = #id_, .number = FN_##id_, .kind = WORD_FN, \
		.place = PLACE_BOX, .operand = OPND_NONE, \
		.first = OP_LD, .next = OP_AND, .result = (result_) & 0xff, \
		.result_classes = (result_) >> 8 ? (result_) >> 8 : ANY_NUM, \
		.most_inputs = most_, PINS(id_) },
#include "engine/catalog.def"
};

/* Words that begin with another character cannot be written by name. */
static const uint8_t word_length[WORD_KNOWN] = {
#define ELEM(id, word, ...) [ELEM_##id] = sizeof(word) - 1,
#define FB(id, ...) [FB_##id] = sizeof(#id) - 1,
#define FN(id, ...) [FN_##id] = sizeof(#id) - 1,
#include "engine/catalog.def"
};

static const struct op_row ops[OP_COUNT] = {
#define OP(id, operand, modifiers, doc) \
	[OP_##id] = { #id, operand, modifiers },
#include "engine/catalog.def"
};

static const struct vm_row vm_rows[VM_COUNT] = {
#define VM(id, word, doc) [VM_##id] = { word },
#include "engine/catalog.def"
};

static const struct sys_row sys_rows[SYS_COUNT] = {
#define SYS(id, address, type, doc) \
	[SYS_##id] = { "SYS_" #id, address, IEC_##type },
#include "engine/catalog.def"
};

/* Reads the parts of a project's word that do not need the project. */
static const struct word_row own_word = {
	.word = "", .number = WORD_COUNT, .kind = WORD_FB, .place = PLACE_BOX, .operand = OPND_INSTANCE,
	.first = OP_CAL, .next = OP_CAL,
};

const struct word_row *word_row(enum word word)
{
	if (word > WORD_COUNT)
		return &own_word;
	return &words[word < WORD_KNOWN ? word : ELEM_EMPTY];
}

enum word word_find(const char *text, size_t len)
{
	char first = len ? ascii_upper(text[0]) : '\0';

	if (first < 'A' || first > 'Z')
		return WORD_COUNT;
	for (int i = 0; i < WORD_KNOWN; i++)
		if (word_length[i] == len && words[i].word[0] == first &&
		    ascii_same(words[i].word, text, len))
			return (enum word)i;
	return WORD_COUNT;
}

/* The number of a pin such as IN12; -1: it is none, or has a leading zero. */
static int number_behind(const char *name, size_t len)
{
	const size_t letters = 2;
	int number = 0;

	if (len <= letters || len > letters + 2 ||
	    (name[letters] == '0' && len > letters + 1))
		return -1;
	for (size_t i = letters; i < len; i++) {
		if (name[i] < '0' || name[i] > '9')
			return -1;
		number = number * 10 + (name[i] - '0');
	}
	return number;
}

int word_last_number(const struct word_row *row)
{
	const char *at = row->pin[row->pin_count - 1].name;
	int number = 0;

	while (*at && !ascii_digit(*at))
		at++;
	for (; ascii_digit(*at); at++)
		number = number * 10 + (*at - '0');
	return number;
}

/* Index of pin INn of an extensible function behind its named pins, or -1. */
static int find_further_input(const struct word_row *row, const char *name,
			      size_t len)
{
	int last = row->pin_count - 1, number, known;

	if (row->most_inputs <= row->pin_count || len < 3 ||
	    !ascii_same("IN", name, 2))
		return -1;
	number = number_behind(name, len);
	known = word_last_number(row);
	if (number <= known || last + number - known >= row->most_inputs)
		return -1;
	return last + number - known;
}

/* Index of the input of SR or RS that CODESYS and TwinCAT name in their own way, or -1. */
static int find_latch_input(const struct word_row *row, const char *name, size_t len)
{
	static const struct { enum word word; const char *input[2]; } latch[] = {
		{ FB_SR, { "SET1", "RESET" } }, { FB_RS, { "SET", "RESET1" } },
	};

	for (int i = 0; i < 4; i++)
		if (row == word_row(latch[i / 2].word) && name_is(latch[i / 2].input[i % 2], name, len))
			return i % 2;
	return -1;
}

int word_pin_find(const struct word_row *row, const char *name, size_t len)
{
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];

		if (pin->dir != PIN_VAR && pin->dir != PIN_NONE &&
		    name_is(pin->name, name, len))
			return i;
	}
	if (row->kind == WORD_FB)
		return find_latch_input(row, name, len);
	return find_further_input(row, name, len);
}

const struct word_pin *word_pins(const struct word_row *row)
{
	return row->pin;
}

bool word_is_test(const struct word_row *row)
{
	return row->kind == WORD_FN && row->result == IEC_BOOL;
}

bool word_opens(const struct word_row *row)
{
	return row->kind == WORD_FN && row->pin_count == 2 && !row->pin[0].own &&
	       !row->pin[1].own && (row->result == IEC_BOOL || word_shares(row));
}

/* Rows spell both in upper case. */
static bool same_text(const char *a, const char *b)
{
	while (*a && *a == *b) {
		a++;
		b++;
	}
	return *a == *b;
}

enum op word_operator(const struct word_row *row)
{
	for (int i = 0; i < OP_COUNT && row->kind == WORD_FN; i++)
		if (same_text(ops[i].word, row->word))
			return (enum op)i;
	return OP_COUNT;
}

/* Only operators that are functions, too. */
static const uint16_t functions[OP_COUNT] = {
	[OP_AND] = FN_AND, [OP_OR] = FN_OR, [OP_XOR] = FN_XOR, [OP_NOT] = FN_NOT,
};

enum word op_function(enum op op)
{
	return op < OP_COUNT && functions[op] ? (enum word)functions[op] : WORD_COUNT;
}

int word_first_bool(const struct word_row *row, enum pin_dir dir)
{
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].dir == dir && row->pin[i].type == IEC_BOOL)
			return i;
	return -1;
}

const struct op_row *op_row(enum op op)
{
	static const struct op_row none = { "", OPND_NONE, 0 };

	return op < OP_COUNT ? &ops[op] : &none;
}

enum op op_find(const char *text, size_t len)
{
	for (int i = 0; i < OP_COUNT; i++)
		if (ascii_is(ops[i].word, text, len))
			return (enum op)i;
	return OP_COUNT;
}

const struct vm_row *vm_row(enum vm_op op)
{
	static const struct vm_row none = { "" };

	return op < VM_COUNT ? &vm_rows[op] : &none;
}

const struct sys_row *sys_row(enum sys_id id)
{
	static const struct sys_row none = { "", "", IEC_NONE };

	return id < SYS_COUNT ? &sys_rows[id] : &none;
}
