/* SPDX-License-Identifier: MIT
 *
 * words - the words of a project: those of the catalogue, and its own.
 *
 * A function, function block or structure of the project has a row like any word of
 * catalog.def, so that checks, translation and drawings treat both alike. Numbers up to
 * WORD_COUNT are the catalogue's. Rows never move and are never removed.
 */
#ifndef MODEL_WORDS_H
#define MODEL_WORDS_H

#include "engine/base/arena.h"
#include "engine/base/catalog.h"

#define WORD_FIRST_OWN (WORD_COUNT + 1) /* WORD_COUNT itself is no word      */
/* Words made by rule follow all own words: INT_TO_REAL (model/convert.h). */
#define WORD_FIRST_MADE (WORD_FIRST_OWN + LIMIT_OWN_WORDS)

struct word_table {
	struct arena *arena;
	struct word_row **row; /* of word WORD_FIRST_OWN + index              */
	int count;
	struct word_row **made; /* of word WORD_FIRST_MADE + index            */
	int made_count;
	uint16_t *slot;        /* open hash of index + 1, by name, any case   */
	uint32_t mask;
	struct word_space { const char *name; size_t len; } *space; /* parts of the names of NAMESPACEs */
	int space_count;
	bool as_numbers;       /* DWORD_TO_REAL and REAL_TO_DWORD keep the number, not the bits */
	bool own_first;        /* plain IEC text: its words hide those of the catalogue */
};

/** words_init - the catalogue only. @arena owns rows that are added. */
void words_init(struct word_table *table, struct arena *arena);

/**
 * words_add - a row of the project's own
 * @row: its texts and pins must live as long as the arena; its word is its name
 *
 * Two rows may have the same name; a search finds the first. Scan-safe: no.
 * Fails: WORD_COUNT when memory is out or there are too many.
 */
enum word words_add(struct word_table *table, struct word_row row);
/** words_space - a part of the name of a NAMESPACE, which may stand before names. @name ends with NUL and lives as
 * long as the table. Scan-safe: no. Fails: false: no memory. */
bool words_space(struct word_table *table, const char *name, size_t len);
/** words_find_type - the same for the name of a type: a structure or block of the project comes before a word that
 * begins a cell or an instruction, such as R. Scan-safe: no. */
enum word words_find_type(struct word_table *table, const char *text, size_t len);
/** words_is_operator - a word of the catalogue that is no function or block: R, NO, LD. Scan-safe: yes. */
bool words_is_operator(const char *name, size_t len);
/** words_result - the pin of a function's result: OUT, or the function's name if it declares an OUT itself.
 * Scan-safe: yes. */
const char *words_result(const struct word_row *row);
/** words_strip - steps over namespaces before a name: Plant.Pumps.Start. Scan-safe: yes. False: there is none. */
bool words_strip(const struct word_table *table, const char **text, size_t *len);
/** words_own - the row of a word of the project, to fill in; NULL: none. */
struct word_row *words_own(const struct word_table *table, enum word word);
/** words_row - the row of any word; that of an empty cell if there is none. */
const struct word_row *words_row(const struct word_table *table, enum word word);
/** words_find - the project's own words, then those of word_find; a word made by rule
 * gets its row here, and a block may be named with the type it
 * works on (TON_LTIME, CTU_INT). WORD_COUNT: none. */
enum word words_find(struct word_table *table, const char *text, size_t len);

/** words_conversion - the function that makes a value of @to from one of @from; WORD_COUNT: none.
 * Scan-safe: no. */
enum word words_conversion(struct word_table *table, enum iec_type from, enum iec_type to);
/** words_find_short - the block of a name such as TON_LTIME or CTU_INT, which names the
 * only type it has; WORD_COUNT: none. Scan-safe: no. */
enum word words_find_short(const char *text, size_t len);

/** words_number - the conversion of a number, "UDINT_TO_REAL", that DWORD_TO_REAL is in the files of other
 * tools (word_table.as_numbers); NULL: another word. Lives for ever. Scan-safe: yes. */
const char *words_number(const char *text, size_t len);
/** words_explain - the explanation of a row; "" for one of the project. Static. */
const char *words_explain(const struct word_row *row);

/** words_is_taken - whether cells or lists use this word, perhaps with C or N behind it.
 * It cannot be a name in a project. Scan-safe: yes. */
bool words_is_taken(const char *name);

/** word_is_own - declared in the project. */
static inline bool word_is_own(enum word word)
{
	return word > WORD_COUNT && word < WORD_FIRST_MADE;
}

/**
 * pin_next - the pin of the next argument without a name of a call of an instance: the inputs in their order,
 * then the outputs
 * @last: of the argument before; -1: none; gets that of this one
 *
 * NULL: there is none. Scan-safe: yes.
 */
static inline const struct word_pin *pin_next(const struct word_row *row, int *last)
{
	for (++*last; *last < 2 * row->pin_count; ++*last) {
		const struct word_pin *pin = &row->pin[*last % row->pin_count];

		if (*last < row->pin_count ? pin_is_given(pin) : pin->dir == PIN_OUT)
			return pin;
	}
	return NULL;
}
#endif
