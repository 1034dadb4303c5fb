/* SPDX-License-Identifier: MIT
 *
 * words_source - where a word comes from: the rows of words_source.def. The tables are
 * made from catalog.def, so a word without a row, or with two, does not compile.
 */
#include "ladder/words.h"

#include <string.h>

#define IEC(table) "IEC 61131-3 table " #table
#define LD_ELEMENTS "IEC 61131-3, 8.2"
#define LISTS "IEC 61131-3, edition 2, table 52"
#define OURS "beyond the standard"
#define S7_200 OURS "; a word of the S7-200"
#define ANNEX_F OURS "; an example of edition 2, annex F, has the name"
#define CLASSIC OURS "; as ClassicLadder has it"
#define LANG(section) "language.md#" section
#define BLOCKS(section) "blocks.md#" section
#define FILES(section) "rung-file.md#" section

enum source_id {
#define FROM(id, source, section) SOURCE_##id,
#include "ladder/words_source.def"
};

static const struct words_source sources[] = {
#define FROM(id, source, section) [SOURCE_##id] = { source, section },
#include "ladder/words_source.def"
};

static const struct words_source of_types = {
	IEC(10), FILES("Types")
};
static const struct words_source of_converts = {
	IEC(22), LANG("Conversions")
};

static const uint16_t of_word[WORD_COUNT] = {
#define ELEM(id, ...) [ELEM_##id] = SOURCE_ELEM_##id,
#define FB(id, ...) [FB_##id] = SOURCE_FB_##id,
#define FN(id, ...) [FN_##id] = SOURCE_FN_##id,
#include "engine/catalog.def"
};

static const uint16_t of_op[OP_COUNT] = {
#define OP(id, ...) [OP_##id] = SOURCE_OP_##id,
#include "engine/catalog.def"
};

static const uint16_t of_area[AREA_COUNT] = {
#define AREA(id, ...) [AREA_##id] = SOURCE_AREA_##id,
#include "engine/catalog.def"
};

static const uint16_t of_sys[SYS_COUNT] = {
#define SYS(id, ...) [SYS_##id] = SOURCE_SYS_##id,
#include "engine/catalog.def"
};

static const struct words_source of_nanoseconds = {
	OURS, LANG("Conversions")
};

/* The function behind conversions that count nanoseconds, if there are such. */
#ifdef RUNGBOARD_CORE_WORDS
#define NANOSECONDS WORD_COUNT
#else
#define NANOSECONDS FN_CONVERT_NS
#endif

/* INT_TO_REAL and its like have no rows; ADD_INT has that of ADD. */
static const struct words_source *made_source(const struct word_row *row)
{
	if (row->runs == NANOSECONDS)
		return &of_nanoseconds;
	return strstr(row->word, "TO_") || strstr(row->word, "TRUNC") ? &of_converts :
								       &sources[of_word[row->runs]];
}

const struct words_source *words_source(const struct words_entry *entry)
{
	enum word word;

	switch (entry->kind) {
	case WORDS_OPERATOR:
		return &sources[of_op[entry->number]];
	case WORDS_AREA:
		return &sources[of_area[entry->number]];
	case WORDS_SYSTEM:
		return &sources[of_sys[entry->number]];
	case WORDS_ELEMENT:
	case WORDS_BLOCK:
	case WORDS_FUNCTION:
		word = (enum word)entry->number;
		return word < WORD_COUNT ? &sources[of_word[word]] :
					   made_source(entry->row);
	case WORDS_TYPE:
	case WORDS_KIND_COUNT:
		break;
	}
	return &of_types;
}
