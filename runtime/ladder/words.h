/* SPDX-License-Identifier: MIT
 *
 * words - one row of the catalogue, of whatever kind, as the word list sees it.
 *
 * words.c lists them as text and JSON, words_page.c as the page docs/words.md.
 */
#ifndef LADDER_WORDS_H
#define LADDER_WORDS_H

#include "engine/base/catalog.h"
#include "engine/base/sink.h"

/**
 * words_list - elements, boxes, instructions, types, areas and system names
 * @word: one of them, any case, with its details; NULL: all, a line each
 * @json: an array of objects; each has kind, word and doc, most have more
 *
 * Returns how many were listed; 0: there is no such word.   Scan-safe: no.
 */
int words_list(const char *word, bool json, const struct sink *sink);
/** words_markdown - the whole of docs/words.md. */
void words_markdown(const struct sink *sink);

enum words_kind {
	WORDS_ELEMENT, WORDS_BLOCK, WORDS_FUNCTION, WORDS_OPERATOR, WORDS_TYPE,
	WORDS_AREA, WORDS_SYSTEM, WORDS_KIND_COUNT
};

struct words_entry {
	enum words_kind kind;
	int number;                 /* in the table of its kind; WORD_COUNT: made
				       by rule, as INT_TO_REAL is             */
	const char *word;           /* as one writes it                       */
	const char *family;         /* NULL: none                             */
	const char *doc;            /* "": words_note says it all             */
	const struct word_row *row; /* of an element, block or function       */
	const struct op_row *op;
	const struct iec_type_row *type; /* of a type or system name          */
	const struct iec_area_row *area;
	const struct sys_row *sys;
};

/** words_at - entry number @index, by kinds; false: past the last one. */
bool words_at(int index, struct words_entry *out);
/** words_kind - "function block". */
const char *words_kind(enum words_kind kind);
/** words_operand - what stands behind an element or operator; "": nothing. */
const char *words_operand(enum operand_kind kind);
/** words_classes - "ANY_NUM" of the classes of a function's pin. */
const char *words_classes(uint16_t classes);
/** words_default - "T#10ms" of a pin with a value until it is given one, else "";
 * @out: room for 48 bytes, borrowed. */
const char *words_default(const struct word_pin *pin, char *out);
/* Where a word comes from, and the section that tells more: "page.md#Title". */
struct words_source {
	const char *source, *section;
};
/** words_source - of any entry; lives for ever. */
const struct words_source *words_source(const struct words_entry *entry);

enum words_form { WORDS_AS_FILE, WORDS_AS_PICTURE, WORDS_AS_LIST };
/** words_example - a whole rung file, its picture, or a file with the same as a list
 *
 * Fails: false if the word has none of the form, or memory is out. */
bool words_example(const struct words_entry *entry, enum words_form form,
		   const struct sink *sink);
/* An example by hand: variables, the body of Main, what stands behind it. */
struct words_hand {
	const char *vars, *body, *behind;
};
/** words_hand - NULL: the rule will do. @list: as a list. */
const struct words_hand *words_hand(const struct words_entry *entry, bool list);
/** words_note - a short line of facts, such as `LD LDN` or `1 byte, 0 to 1`. */
void words_note(const struct words_entry *entry, const struct sink *sink);

#endif
