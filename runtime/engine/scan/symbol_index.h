/* SPDX-License-Identifier: MIT
 *
 * symbol_index - where a name may stand among the symbols of a program.
 *
 * A project that is shown, tried out or traced asks for thousands of names. With an index
 * each costs the length of the name; without one all symbols are gone through, as on a
 * board that is asked seldom.
 */
#ifndef SCAN_SYMBOL_INDEX_H
#define SCAN_SYMBOL_INDEX_H

#include "engine/base/arena.h"
#include "engine/scan/image.h"

struct symbol_index;

/**
 * symbol_index_new - of what @program declares, to be kept in program->index
 *
 * Owns: @arena; it lives no longer than the program.   Scan-safe: no.
 * Fails: NULL when memory is out: then all symbols are gone through.
 */
const struct symbol_index *symbol_index_new(const struct program *program,
					    struct arena *arena);

/* Looks for what @text may begin with; the rest is {0}. */
struct symbol_search {
	const char *text;       /* borrowed                                   */
	size_t len;
	uint32_t number;        /* of the symbol that was found, as declared  */
	struct declared_cursor all;
	size_t end;             /* bytes of `text` that are in `hash`         */
	uint32_t hash, entry;
};
/**
 * symbol_search_next - the next symbol whose name, perhaps behind that of its program, may
 * be what `text` begins with
 *
 * Each that is comes at least once; with an index in any order, else as declared. What it
 * gives may also be another: the caller compares.
 * Owns: nothing.   Scan-safe: no.   Fails: false: no more.
 */
bool symbol_search_next(const struct program *program, struct symbol_search *search,
			struct declared_name *out);
#endif
