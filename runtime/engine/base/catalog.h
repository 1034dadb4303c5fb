/* SPDX-License-Identifier: MIT
 *
 * catalog - catalog.def expanded to enums, instance structs and const tables.
 *
 * Code that depends on what a word is reads its row. A single word is named only in the
 * function that implements it.
 */
#ifndef BASE_CATALOG_H
#define BASE_CATALOG_H

#include "engine/base/iec.h"
#include "engine/base/limits.h"

/* One range of numbers for every word that can stand in a cell. */
enum word {
#define ELEM(id, ...) ELEM_##id,
#include "engine/catalog.def"
	WORD_ELEMENTS, /* how many elements there are; blocks follow          */
	WORD_ELEMENTS_LAST = WORD_ELEMENTS - 1,
#define MORE_FB(...)
#define FB(id, ...) FB_##id,
#include "engine/catalog.def"
#define MORE_FN(...)
#define FN(id, ...) FN_##id,
#include "engine/catalog.def"
	WORD_CORE, /* from here on: words that WORDS=core leaves out          */
	WORD_CORE_LAST = WORD_CORE - 1,
#define MORE_FB(id, ...) FB_##id,
#include "engine/catalog.def"
#define MORE_FN(id, ...) FN_##id,
#include "engine/catalog.def"
	WORD_COUNT,
	WORD_MOST = 0xffff /* words of a project follow: model/words.h      */
};

/* Words that this build has rows and functions for. */
#ifdef RUNGBOARD_CORE_WORDS
#define WORD_KNOWN WORD_CORE
#else
#define WORD_KNOWN WORD_COUNT
#endif

enum op {
#define OP(id, ...) OP_##id,
#include "engine/catalog.def"
	OP_COUNT
};

enum vm_op {
#define VM(id, ...) VM_##id,
#include "engine/catalog.def"
	VM_COUNT
};

#define WORD_TEXT IEC_STRING_DEFAULT /* bytes that a text of an instance holds */
/* A STRING in an instance: a struct iec_string with its room. */
struct word_text {
	_Alignas(uint32_t) uint16_t capacity;
	uint16_t length;
	char text[WORD_TEXT];
};

/* The memory of an instance. A BOOL is a byte of 0 or 1, TIME is ns. Layouts are
 * the same on every little-endian target with natural alignment. */
#define TYPE(id, ctype, size, class, low, high) typedef ctype iec_ctype_##id;
#include "engine/catalog.def"
#define FB_IN(fb, pin, type, doc)  iec_ctype_##type pin;
#define FB_OUT(fb, pin, type, doc) iec_ctype_##type pin;
#define FB_DEF(fb, pin, type, value, doc) iec_ctype_##type pin;
#define FB_TEXT(fb, pin, doc)      struct word_text pin;
#define FB_VAR(fb, pin, type)      iec_ctype_##type pin;
#define FB_STORE(fb, pin, type, count) iec_ctype_##type pin[count];
#define FB(id, family, doc, pins)  struct fb_##id { pins };
#include "engine/catalog.def"

enum word_kind { WORD_ELEM, WORD_FB, WORD_FN, WORD_STRUCT };

enum place {
	PLACE_NONE,   /* an empty cell                                       */
	PLACE_WIRE,   /* joins its two ends                                  */
	PLACE_SERIES, /* power in, power out                                 */
	PLACE_BOX,    /* like series; may stand last, and is then an output  */
	PLACE_LAST,   /* acts after all others; a coil passes power to outputs */
	PLACE_PIN,    /* a further row of the box above                      */
};

enum operand_kind {
	OPND_NONE, OPND_BOOL_R, OPND_BOOL_W, OPND_ANY_R, OPND_ANY_W,
	OPND_LABEL, OPND_INSTANCE, OPND_EXPR, OPND_ASSIGN, OPND_PIN,
	OPND_LOOP, OPND_LOOP_END, OPND_ROUTINE, OPND_EXECUTE,
};

enum edge { EDGE_NONE, EDGE_RISING, EDGE_FALLING };

/* Modifiers of an IL operator (IEC 61131-3 table 51). */
enum op_modifier { MOD_N = 1, MOD_C = 2, MOD_PAREN = 4 };

/* PIN_VAR: inside, not to be named from outside; PIN_NONE: no part of it. */
enum pin_dir { PIN_IN, PIN_OUT, PIN_VAR, PIN_IN_OUT, PIN_NONE };

/* ARRAY[low..high]; count is the number of elements, 0 for a single value. */
struct var_array {
	int32_t low;
	uint32_t count;
};

/* Type of a function's result, if it is not one of its own. */
#define RESULT_SAME IEC_NONE       /* that its FN_IN pins share              */
#define RESULT_OPEN IEC_TYPE_COUNT /* that of the variable behind OUT        */
#define RESULT_GATE (IEC_TYPE_COUNT + 1) /* as RESULT_SAME; BOOL gates power */
/* RESULT_OPEN, but only of these classes. */
#define RESULT_TO(classes) (RESULT_OPEN | (classes) << 8)

#ifdef RUNGBOARD_SMALL
/* A small board runs programs that were translated elsewhere. It has only the columns
 * that the verifier needs, and no pointers: rows need no relocation. */
struct word_pin {
	union {
		uint16_t offset;  /* of an FB pin in its struct               */
		uint16_t classes; /* of a function's pin                      */
	};
	uint8_t type;        /* enum iec_type of an FB pin                     */
	uint8_t dir : 4;     /* enum pin_dir                                   */
	uint8_t own : 1;     /* of a function's pin                            */
};

struct word_row {
	uint8_t kind, result, most_inputs, pin_count;
	uint16_t first_pin;
	union {
		uint16_t size;           /* bytes of an FB instance           */
		uint16_t result_classes; /* of a function                     */
	};
};
#else
/* Small on purpose, 20 bytes where a pointer has four: a board has hundreds of them in
 * its memory. See limits.h for what the numbers can be. */
struct word_pin {
	const char *name;
	uint32_t elements : 26; /* own rows and FB_STORE: index of its array; 0: none */
	enum pin_dir dir : 4;
	bool own : 1;        /* of a function's pin: does not share the type   */
	bool has_init : 1;   /* has a value until it is given one              */
	union {
		int32_t init;         /* of has_init: pin_init()              */
		int32_t low;          /* own rows: of an array                */
	};
	uint32_t offset : 26; /* of an FB pin in its struct                    */
	enum iec_type type : 6; /* of an FB pin; of a function's the type it must
				be made, IEC_NONE if any of its classes will do */
	uint16_t classes;    /* of a function's pin: enum iec_class, or'ed     */
	union {
		uint16_t word;       /* enum word; own rows, of type IEC_NONE: an
					instance, structure                    */
		uint16_t capacity;   /* own rows, of any other type: of a STRING */
	};
};

/** pin_array - the bounds of an array pin. Scan-safe: yes. */
static inline struct var_array pin_array(const struct word_pin *pin)
{
	struct var_array array = { pin->elements ? pin->low : 0, pin->elements };

	return array;
}

/** pin_is_given - does a call of an instance give it a value, or a variable of its own? Scan-safe: yes. */
static inline bool pin_is_given(const struct word_pin *pin)
{
	return pin->dir == PIN_IN || pin->dir == PIN_IN_OUT;
}

/** pin_init - the value of a pin of the catalogue until it is given one. Scan-safe: yes. */
static inline union iec_value pin_init(const struct word_pin *pin)
{
	if (pin->type == IEC_REAL)
		return (union iec_value){ .r = pin->init };
	return (union iec_value){ .i = pin->init };
}

struct word_row {
	const char *word;    /* as the rung file spells it: "NC", "TON"        */
	enum word number : 16; /* of the catalogue; of a project: WORD_COUNT   */
	enum word_kind kind : 8;
	enum place place : 8;
	enum operand_kind operand : 8;
	enum edge edge : 8;
	enum op first : 8, next : 8; /* IL at the rail, and behind others              */
	bool negate : 1;
	bool retain : 1;     /* of a project: a part of it is RETAIN           */
	bool overlaps : 1;   /* of a project: its members share their bytes    */
	bool texts : 1;      /* of a project: it holds a text or a block       */
	bool unions : 1;     /* of a project: it is a union, or holds one      */
	bool straight : 1;   /* of a project: its members lie as they are declared */
	enum iec_type result : 8; /* of a function: a type, or RESULT_…            */
	uint16_t result_classes; /* of RESULT_OPEN: what it may become         */
	uint8_t most_inputs; /* of a function                                  */
	uint8_t depth;       /* of a project: structures and blocks inside one another */
	enum word runs : 16; /* own rows: function of the catalogue that does it */
	uint16_t pin_count;
	uint16_t ordered;    /* how many pins @order has                       */
	const struct word_pin *pin; /* of a function: inputs only              */
	uint32_t size;       /* bytes of an FB instance                        */
	/* Of words of a project: */
	int owner;           /* index of its POU or structure; -1: none        */
	const uint16_t *order; /* its pins in the order of memory              */
};
#endif

/** word_row - the row of a word. Lives for ever. Scan-safe: yes. Words of a
 * project share a row that only says that they are boxes (model/words.h). */
const struct word_row *word_row(enum word word);
/** word_pins - its pins, pin_count of them. Scan-safe: yes. */
const struct word_pin *word_pins(const struct word_row *row);
/** word_last_number - the number in the name of a function's last named pin: 2 for IN2.
 * Scan-safe: yes. */
int word_last_number(const struct word_row *row);
/** word_input - the pin of input @index of a function; inputs past the last pin have the
 * last pin. Scan-safe: yes. */
static inline const struct word_pin *word_input(const struct word_row *row,
						uint32_t index)
{
	return &word_pins(row)[index < row->pin_count ? index : row->pin_count - 1u];
}
/** word_find - the word a file spells so (any case); WORD_COUNT: none. */
enum word word_find(const char *text, size_t len);
/** word_pin_find - index of a pin (any case) in the row; a function's INn past
 * its named pins too, up to most_inputs; -1: none. PIN_VAR is never found. */
int word_pin_find(const struct word_row *row, const char *name, size_t len);
/** word_is_test - whether the result is always BOOL. The power behind it is EN AND the
 * result. */
bool word_is_test(const struct word_row *row);
/** word_opens - whether it may stand before a parenthesis in IL, as ADD( does: a
 * function of two values of one type. */
bool word_opens(const struct word_row *row);
/** word_shares - whether the result has the type that the inputs share. */
static inline bool word_shares(const struct word_row *row)
{
	return row->result == RESULT_SAME || row->result == (int)RESULT_GATE;
}
/** word_operator - the IL operator of a function's name; OP_COUNT: none. */
enum op word_operator(const struct word_row *row);
/** word_first_bool - index of its first Boolean pin of @dir, -1: none. */
int word_first_bool(const struct word_row *row, enum pin_dir dir);

struct op_row {
	const char *word;
	enum operand_kind operand : 8;
	uint8_t modifiers;   /* enum op_modifier, or'ed                        */
};
const struct op_row *op_row(enum op op);
/** op_find - OP_COUNT: none. */
enum op op_find(const char *text, size_t len);
/** op_function - the function of an operator's name; WORD_COUNT: none. */
enum word op_function(enum op op);

struct vm_row {
	const char *word;
};
const struct vm_row *vm_row(enum vm_op op);

struct sys_row {
	const char *name;    /* "SYS_FIRST_SCAN"                               */
	const char *address; /* "%SMX0.1"                                      */
	enum iec_type type;
};
enum sys_id {
#define SYS(id, ...) SYS_##id,
#include "engine/catalog.def"
	SYS_COUNT
};
const struct sys_row *sys_row(enum sys_id id);

/* Explanations for people, in explain.c, so that a runtime does not link them. Static,
 * without line breaks. */

/** explain_id - "CONTACT_NC"; of a box its word. */
const char *explain_id(const struct word_row *row);
/** explain_family - of the palette: "Contacts"; "Own" of a word of a project; "": none. */
const char *explain_family(const struct word_row *row);
/** explain_inside - what is drawn between the strokes of an element without an operand: "RETURN", "NOT"; of
 * the others their word. */
const char *explain_inside(const struct word_row *row);
/** explain_glyph - three characters, its strokes; "" of a box. */
const char *explain_glyph(const struct word_row *row);
/** explain_word - what a word does; "" of a word of a project. */
const char *explain_word(const struct word_row *row);
/** explain_pin - the purpose of pin @index of the row; "" for an inner pin and for a
 * word of a project. */
const char *explain_pin(const struct word_row *row, int index);
const char *explain_op(enum op op);
const char *explain_area(enum iec_area area);
const char *explain_sys(enum sys_id id);
#endif
