/* SPDX-License-Identifier: MIT
 *
 * address_map - which addresses a project uses, which one is free, which are used under
 * two names. It knows the program only: not what is wired to a board.
 */
#ifndef XREF_ADDRESS_MAP_H
#define XREF_ADDRESS_MAP_H

#include "engine/xref/xref.h"

struct address_map {
	struct areas areas; /* of the project                                 */
	uint8_t *used;     /* a bit for each one of all areas                 */
	uint8_t *reached;  /* those too that an index may lead to: %MW0[i]    */
};

/** address_map_make - Owns: @arena. Scan-safe: no. Fails: false: no memory. */
bool address_map_make(struct address_map *out, const struct xref *xref,
		      struct arena *arena);
/**
 * address_map_next - the first free address
 * @bits:  1, 8, 16, 32 or 64; @count: so many in a row, 1 for a single variable
 * @after: NULL, or the first one looked at is that behind it
 *
 * One of more than a bit stands at a multiple of its bytes. What an index may lead to is
 * given out only when there is nothing else. Inside the area as the project has it.
 * Scan-safe: no.   Fails: false: there is none.
 */
bool address_map_next(const struct address_map *map, enum iec_area area, int bits,
		      uint32_t count, const struct iec_addr *after, struct iec_addr *out);
/** address_map_is_used - has one of its bits a use or a variable? Not beyond its area. */
bool address_map_is_used(const struct address_map *map, struct iec_addr addr);

/* The same memory under two names: variables, or an address and a variable. */
struct address_clash {
	int a, b;          /* uses, of which b comes later in the file        */
};
/**
 * address_map_clashes - pairs of different things with a bit in common, each once
 * @out: gets them, at most @most; of two parts of memory in use only by address those
 *       of different width
 * Returns how many there are in all, or -1: no memory.   Scan-safe: no.
 */
int address_map_clashes(struct xref *xref, struct address_clash *out, int most);

#endif
