/* SPDX-License-Identifier: MIT
 *
 * catalog_small - the rows of catalog.def as a small board has them.
 *
 * Replaces catalog.c. It has no names, drawings or IL words.
 */
#include "engine/base/catalog.h"

static const struct word_pin pins[] = {
#define FB_PIN(fb, pin, way, kind) \
	{ .offset = offsetof(struct fb_##fb, pin), .type = IEC_##kind, .dir = way },
#define FB_DEF(fb, pin, type, value, doc) FB_PIN(fb, pin, PIN_IN, type)
#define FB_IN(fb, pin, type, doc)  FB_PIN(fb, pin, PIN_IN, type)
#define FB_OUT(fb, pin, type, doc) FB_PIN(fb, pin, PIN_OUT, type)
#define FB_TEXT(fb, pin, doc)      FB_PIN(fb, pin, PIN_IN, STRING)
#define FB_VAR(fb, pin, type)      FB_PIN(fb, pin, PIN_VAR, type)
#define FB_STORE(fb, pin, type, count) /* no pin */
#define FB(id, family, doc, pins)  pins
#define FN_IN(pin, what, doc)      { .classes = what, .dir = PIN_IN },
#define FN_OWN(pin, what, doc)     { .classes = what, .dir = PIN_IN, .own = true },
#define FN(id, family, doc, result, most, pins) pins
#include "engine/catalog.def"
};

/* Where the pins of each word begin, and how many there are. */
enum pin_place {
#define PLACE(id, pins) FIRST_##id, LAST_##id = FIRST_##id - 1 pins,
#define FB_DEF(fb, pin, type, value, doc) + 1
#define FB_IN(fb, pin, type, doc)  + 1
#define FB_OUT(fb, pin, type, doc) + 1
#define FB_TEXT(fb, pin, doc)      + 1
#define FB_VAR(fb, pin, type)      + 1
#define FB_STORE(fb, pin, type, count)
#define FB(id, family, doc, pins)  PLACE(id, pins)
#define FN_IN(pin, what, doc)      + 1
#define FN_OWN(pin, what, doc)     + 1
#define FN(id, family, doc, result, most, pins) PLACE(id, pins)
#include "engine/catalog.def"
	PINS_ALL
};
_Static_assert(sizeof(pins) / sizeof(*pins) == PINS_ALL, "a pin is not counted");

#define PINS(id) .first_pin = FIRST_##id, .pin_count = LAST_##id - FIRST_##id + 1
/* All elements share the first row. */
#define ROW(word) ((word) < WORD_ELEMENTS ? 0 : (word) - WORD_ELEMENTS + 1)
static const struct word_row words[ROW(WORD_KNOWN)] = {
	[0] = { .kind = WORD_ELEM },
#define FB(id, family, doc, pins) \
	[ROW(FB_##id)] = { .kind = WORD_FB, PINS(id), .size = sizeof(struct fb_##id) },
#define FN(id, family, doc, result_, most, pins) \
	[ROW(FN_##id)] = { .kind = WORD_FN, PINS(id), .result = (result_) & 0xff, \
		.result_classes = (result_) >> 8 ? (result_) >> 8 : ANY_NUM, \
		.most_inputs = most },
#include "engine/catalog.def"
};

const struct word_row *word_row(enum word word)
{
	return &words[word < WORD_KNOWN ? ROW(word) : 0];
}

const struct word_pin *word_pins(const struct word_row *row)
{
	return &pins[row->first_pin];
}
