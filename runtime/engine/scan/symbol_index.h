/* SPDX-License-Identifier: MIT
 *
 * symbol_index - finds a name among the symbols of a program.
 *
 * Displays, simulations and traces look up thousands of names. With an index a lookup
 * costs the length of the name. Without one all symbols are compared; a board does
 * that, as it looks up few names.
 */
#ifndef SCAN_SYMBOL_INDEX_H
#define SCAN_SYMBOL_INDEX_H

#include "engine/base/arena.h"
#include "engine/scan/image.h"

struct symbol_index;

/**
 * symbol_index_new - the index of the symbols of @program; store it in program->index
 *
 * Owns: @arena; it lives no longer than the program. Scan-safe: no.
 * Fails: NULL no memory; searches then compare all symbols.
 */
const struct symbol_index *symbol_index_new(const struct program *program,
					    struct arena *arena);

/* A search for symbols that @text may begin with; zero the other members. */
struct symbol_search {
	const char *text;       /* borrowed                                   */
	size_t len;
	uint32_t number;        /* of the symbol that was found, as declared  */
	struct declared_cursor all;
	size_t end;             /* bytes of `text` that are in `hash`         */
	uint32_t hash, entry;
};
/**
 * symbol_search_next - the next symbol whose name, perhaps with its program's in front,
 * `text` may begin with
 *
 * Each match comes at least once: with an index in any order, else in the order of
 * declaration. It may give symbols that do not match, so the caller compares names.
 * Owns: nothing. Scan-safe: no. Fails: false: no more.
 */
bool symbol_search_next(const struct program *program, struct symbol_search *search,
			struct declared_name *out);
#endif
