/* SPDX-License-Identifier: MIT
 *
 * words - all tables of the catalogue as one list of words. words.c prints it as text and
 * JSON, words_page.c as the page docs/words.md.
 */
#ifndef LADDER_WORDS_H
#define LADDER_WORDS_H

#include "engine/base/catalog.h"
#include "engine/base/sink.h"

/**
 * words_list - prints elements, boxes, instructions, types, areas and system names
 * @word: one word with its details, in any case; NULL: all words, a line each
 * @json: prints an array of objects; each has kind, word and doc, most have more
 *
 * Returns how many were printed; 0: there is no such word.   Scan-safe: no.
 */
int words_list(const char *word, bool json, const struct sink *sink);
/** words_markdown - prints docs/words.md. */
void words_markdown(const struct sink *sink);

enum words_kind {
	WORDS_ELEMENT, WORDS_BLOCK, WORDS_FUNCTION, WORDS_OPERATOR, WORDS_TYPE,
	WORDS_AREA, WORDS_SYSTEM, WORDS_KIND_COUNT
};

struct words_entry {
	enum words_kind kind;
	int number;                 /* in the table of its kind; WORD_COUNT: no
				       row, the name follows a rule (INT_TO_REAL) */
	const char *word;           /* as written in a program                */
	const char *family;         /* NULL: none                             */
	const char *doc;            /* "": words_note() is enough             */
	const struct word_row *row; /* of an element, block or function       */
	const struct op_row *op;
	const struct iec_type_row *type; /* of a type or system name          */
	const struct iec_area_row *area;
	const struct sys_row *sys;
};

/** words_at - entry number @index, sorted by kind; false: past the last one. */
bool words_at(int index, struct words_entry *out);
/** words_operand - what an element or operator needs as operand; "": none. */
const char *words_operand(enum operand_kind kind);
/** words_pin_type - the type of a pin, or a class such as "ANY_NUM". */
const char *words_pin_type(const struct word_pin *pin);
/** words_default - the default value of a pin, such as "T#10ms", or "".
 * @out: room for 48 bytes; returned. */
const char *words_default(const struct word_pin *pin, char *out);
/* Where a word comes from, and the section of a document about it: "page.md#Title". */
struct words_source {
	const char *source, *section;
};
/** words_source - the source of any entry; never freed. */
const struct words_source *words_source(const struct words_entry *entry);

enum words_form { WORDS_AS_FILE, WORDS_AS_PICTURE, WORDS_AS_LIST };
/** words_example - prints an example: a rung file, its picture, or a file with a list
 *
 * Fails: false if the word has no example of this form, or memory is out. */
bool words_example(const struct words_entry *entry, enum words_form form,
		   const struct sink *sink);
#define WORDS_SYMBOL 4
/** words_symbol - the strokes of an element, without blanks behind them: ">>". Returns @out. */
const char *words_symbol(const struct words_entry *entry, char out[WORDS_SYMBOL]);
/** words_note - prints the facts of a word, such as `LD LDN` or `1 byte, 0 to 1`. */
void words_note(const struct words_entry *entry, const struct sink *sink);

#endif
