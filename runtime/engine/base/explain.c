/* SPDX-License-Identifier: MIT
 *
 * explain - the columns of catalog.def that are for people.
 */
#include "engine/base/catalog.h"

static const char *const words[WORD_COUNT] = {
#define ELEM(id, word, glyph, family, place, operand, edge, first, next, negate, doc) \
	[ELEM_##id] = doc,
#define FB(id, family, doc, pins) [FB_##id] = doc,
#define FN(id, family, doc, result, most, pins) [FN_##id] = doc,
#include "engine/catalog.def"
};

static const char *const ids[WORD_COUNT] = {
#define ELEM(id, ...) [ELEM_##id] = #id,
#include "engine/catalog.def"
};

static const char *const families[WORD_COUNT] = {
#define ELEM(id, word, glyph, family, ...) [ELEM_##id] = family,
#define FB(id, family, ...) [FB_##id] = family,
#define FN(id, family, ...) [FN_##id] = family,
#include "engine/catalog.def"
};

static const char glyphs[WORD_COUNT][4] = {
#define ELEM(id, word, glyph, ...) [ELEM_##id] = glyph,
#include "engine/catalog.def"
};

/* The explanations of all words, one after another, and where each word's begin. */
static const char *const pins[] = {
#define FB_DEF(fb, pin, type, value, doc) doc,
#define FB_IN(fb, pin, type, doc)  doc,
#define FB_OUT(fb, pin, type, doc) doc,
#define FB_TEXT(fb, pin, doc)      doc,
#define FB_VAR(fb, pin, type)      "",
#define FB_STORE(fb, pin, type, count) "",
#define FB(id, family, doc, pins)  pins
#define FN_IN(pin, classes, doc)   doc,
#define FN_OWN(pin, classes, doc)  doc,
#define FN(id, family, doc, result, most, pins) pins
#include "engine/catalog.def"
};

enum pin_start {
#define FB_DEF(fb, pin, type, value, doc) + 1
#define FB_IN(fb, pin, type, doc)  + 1
#define FB_OUT(fb, pin, type, doc) + 1
#define FB_TEXT(fb, pin, doc)      + 1
#define FB_VAR(fb, pin, type)      + 1
#define FB_STORE(fb, pin, type, count) + 1
#define FB(id, family, doc, pins)  START_##id, LAST_##id = START_##id - 1 pins,
#define FN_IN(pin, classes, doc)   + 1
#define FN_OWN(pin, classes, doc)  + 1
#define FN(id, family, doc, result, most, pins) \
	START_##id, LAST_##id = START_##id - 1 pins,
#include "engine/catalog.def"
	PIN_ALL
};
_Static_assert(sizeof(pins) / sizeof(*pins) == PIN_ALL, "a pin is not counted");

static const uint16_t first_pin[WORD_COUNT] = {
#define FB(id, family, doc, pins) [FB_##id] = START_##id,
#define FN(id, family, doc, result, most, pins) [FN_##id] = START_##id,
#include "engine/catalog.def"
};

static const char *const ops[OP_COUNT] = {
#define OP(id, operand, modifiers, doc) [OP_##id] = doc,
#include "engine/catalog.def"
};

static const char *const areas[AREA_COUNT] = {
	[AREA_NONE] = "",
#define AREA(id, letters, least, usual, most, access, doc) [AREA_##id] = doc,
#include "engine/catalog.def"
};

static const char *const sys[SYS_COUNT] = {
#define SYS(id, address, type, doc) [SYS_##id] = doc,
#include "engine/catalog.def"
};

const char *explain_id(const struct word_row *row)
{
	return row->kind == WORD_ELEM ? ids[row->number] : row->word;
}

const char *explain_family(const struct word_row *row)
{
	return row->number < WORD_COUNT ? families[row->number] : row->word[0] ? "Own" : "";
}

const char *explain_glyph(const struct word_row *row)
{
	return row->kind == WORD_ELEM ? glyphs[row->number] : "";
}

const char *explain_inside(const struct word_row *row)
{
	const bool alone = row->operand == OPND_NONE || row->operand == OPND_LOOP_END;

	return row->kind == WORD_ELEM && alone ? ids[row->number] : row->word;
}

const char *explain_word(const struct word_row *row)
{
	return row->number < WORD_COUNT ? words[row->number] : "";
}

const char *explain_pin(const struct word_row *row, int index)
{
	if (row->number >= WORD_COUNT || index < 0 || index >= row->pin_count)
		return "";
	return pins[first_pin[row->number] + index];
}

const char *explain_op(enum op op)
{
	return op < OP_COUNT ? ops[op] : "";
}

const char *explain_area(enum iec_area area)
{
	return area < AREA_COUNT ? areas[area] : "";
}

const char *explain_sys(enum sys_id id)
{
	return id < SYS_COUNT ? sys[id] : "";
}
