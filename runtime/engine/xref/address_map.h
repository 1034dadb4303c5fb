/* SPDX-License-Identifier: MIT
 *
 * address_map - the addresses that a project uses, free ones, and those with two names.
 * I/O maps are not considered.
 */
#ifndef XREF_ADDRESS_MAP_H
#define XREF_ADDRESS_MAP_H

#include "engine/xref/xref.h"

struct address_map {
	struct areas areas; /* of the project                                 */
	uint8_t *used;     /* a bit for each bit of all areas                 */
	uint8_t *reached;  /* also those that an index may reach: %MW0[i]     */
};

/** address_map_make - Owns: @arena. Scan-safe: no. Fails: false: no memory. */
bool address_map_make(struct address_map *out, const struct xref *xref,
		      struct arena *arena);
/**
 * address_map_next - the first free address
 * @bits: 1, 8, 16, 32 or 64; @count: number of elements, 1 for a single variable
 * @after: NULL, or search from behind this address
 *
 * Values of more than a bit are aligned to their size. Addresses that an index may
 * reach are used only if no other is free. The result is inside the project's area.
 * Scan-safe: no. Fails: false: there is none.
 */
bool address_map_next(const struct address_map *map, enum iec_area area, int bits,
		      uint32_t count, const struct iec_addr *after, struct iec_addr *out);

/* The same memory under two names: variables, or an address and a variable. */
struct address_clash {
	int a, b;          /* uses; b is later in the file                    */
};
/**
 * address_map_clashes - pairs of different things with a bit in common, each once
 * @out: gets at most @most of them; two plain addresses clash only if their widths
 *       differ
 * Returns the total number, or -1: no memory. Scan-safe: no.
 */
int address_map_clashes(struct xref *xref, struct address_clash *out, int most);

/* A variable with an address, or an address without a variable. */
struct address_thing {
	int use;           /* its declaration, else its first use             */
	enum iec_area area;
	uint32_t first, end; /* its bits in the area, all elements            */
	int uses;          /* places without the declaration                  */
	int coils, writes; /* of them coils; other places that write it in a
			      scan. Rungs that are OFF do not count, nor S and R */
	bool open;         /* an index behind it leads to the end of the area */
};
/**
 * address_map_things - all things at addresses, by area and first bit
 * @out: gets them; owned by the arena of @xref
 *
 * Returns their number, or -1: no memory. Scan-safe: no.
 */
int address_map_things(struct xref *xref, struct address_thing **out);

#endif
