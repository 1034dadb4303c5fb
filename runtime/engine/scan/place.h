/* SPDX-License-Identifier: MIT
 *
 * place - a variable of a program as one word, for peers that have the same program.
 *
 * The word is that of CODE_SYMBOLS (scan/code.h): type and SYMBOL_BIT in the top 8 bits,
 * offset below. It comes from outside, so place_locate() compares it with the data layout.
 */
#ifndef SCAN_PLACE_H
#define SCAN_PLACE_H

#include "engine/scan/image.h"

/** place_word - the word of a location of @program; of a part that of its number. Scan-safe: yes. */
static inline uint32_t place_word(const struct program *program, struct location at)
{
	at = location_whole(at);
	if (at.area == AREA_NONE)
		return CODE_OPERAND(at.type, at.where);
	return CODE_OPERAND((uint32_t)at.type | SYMBOL_BIT,
			    program->areas.at[at.area] * 8 + at.where);
}
/** place_locate - the location that a word of any origin names. Scan-safe: yes. Fails: type
 * IEC_NONE: @program has no value of that type there. */
struct location place_locate(const struct program *program, uint32_t word);
/** place_size - bytes of memory of a location, from `where` on; of a bit of an area 1.
 * Scan-safe: yes. */
uint32_t place_size(const struct program *program, struct location at);
/** place_byte - offset of the byte in memory that holds a location. Scan-safe: yes. */
uint32_t place_byte(const struct program *program, struct location at);
/** place_address - the address of a location as a text of at most @size bytes, such as "%QX0.1";
 * "": it lies outside of the areas. Scan-safe: yes. */
void place_address(const struct program *program, struct location at, char *out, size_t size);
#endif
