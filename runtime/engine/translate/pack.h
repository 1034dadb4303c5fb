/* SPDX-License-Identifier: MIT
 *
 * pack - what the parts of the packing share: the maps of an image, as they grow.
 *
 * Private to translate/.
 */
#ifndef TRANSLATE_PACK_H
#define TRANSLATE_PACK_H

#include "engine/translate/assembler.h"

struct maps {
	char *string;
	size_t string_used, string_size;
	uint8_t *declared;   /* by folded name: in how many tables, up to 2 */
	uint32_t *symbol;
	int symbol_count;
	struct code_group *group;
	int group_count;
	struct code_power *power;
	int power_count;
	struct code_watched *watched;
	int watched_count;
};

#define BOUNDS 32 /* bytes that "[-1000..1000]" takes at most                */
#define NAME_PART (LIMIT_NAME + BOUNDS + 1)
#define NAME_MOST ((LIMIT_NESTING + 2) * NAME_PART)

/** maps_string - @text behind the strings so far; its offset. */
uint32_t maps_string(struct assembler *as, struct maps *maps, const char *text,
		     size_t len);
/** maps_join_index - the index of an element behind the name of what it is one of; or the
 * bounds of all, if they are values. Its length. */
size_t maps_join_index(char *out, const struct word_pin *pin, uint32_t element);
/** pack_power - places of the power of cells, and of instances. */
void pack_power(struct assembler *as, struct maps *maps);
#endif
