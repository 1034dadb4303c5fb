/* SPDX-License-Identifier: MIT
 *
 * symbol_index - finds a name among the symbols of a program.
 *
 * A hash with chains: a symbol is in it by its name with the program and without. A
 * text is searched by each of its beginnings that may be a name.
 */
#include "engine/scan/symbol_index.h"
#include "engine/base/name.h"

#include <string.h>

struct entry {
	uint32_t hash;
	uint32_t symbol;        /* index of `at`                              */
	uint32_t next;          /* 1 + index of `entry`; 0: none              */
};

struct symbol_index {
	struct declared_cursor *at; /* of each symbol: just before it         */
	struct entry *entry;
	uint32_t *chain;        /* likewise, by the low bits of the hash      */
	uint32_t mask, count;
};

static uint32_t *chain_of(const struct symbol_index *index, uint32_t hash)
{
	return &index->chain[(hash ^ hash >> 15) & index->mask];
}

static void enter(struct symbol_index *index, uint32_t hash, uint32_t symbol)
{
	uint32_t *chain = chain_of(index, hash);

	index->entry[index->count++] = (struct entry){ hash, symbol, *chain };
	*chain = index->count;
}

static void enter_names(struct symbol_index *index, const struct declared_name *symbol,
			uint32_t number)
{
	uint32_t hash;

	enter(index, name_hash_more(NAME_HASH, symbol->name, symbol->array.head), number);
	if (!*symbol->pou)
		return;
	hash = name_hash_more(NAME_HASH, symbol->pou, strlen(symbol->pou));
	hash = name_hash_more(hash, ".", 1);
	enter(index, name_hash_more(hash, symbol->name, symbol->array.head), number);
}

/* A power of two, and at least as many chains as names. */
static bool make_room(struct symbol_index *index, size_t symbols, struct arena *arena)
{
	size_t chains = 16;

	while (chains < 2 * symbols)
		chains *= 2;
	index->mask = (uint32_t)chains - 1;
	index->at = arena_alloc(arena, symbols * sizeof(*index->at));
	index->entry = arena_alloc(arena, 2 * symbols * sizeof(*index->entry));
	index->chain = arena_alloc(arena, chains * sizeof(*index->chain));
	return index->at && index->entry && index->chain;
}

const struct symbol_index *symbol_index_new(const struct program *program,
					    struct arena *arena)
{
	struct symbol_index *index = arena_alloc(arena, sizeof(*index));
	struct declared_cursor cursor = { .memories = true }, before = cursor;
	struct declared_name symbol;

	if (!index || !make_room(index, program->symbol_count, arena))
		return NULL;
	for (; image_next_declared(program, &cursor, &symbol); before = cursor) {
		if (!image_as_access(&symbol) && symbol.flags & SYMBOL_HIDDEN &&
		    strchr(symbol.name, ' '))
			continue; /* nobody names the memory of an edge */
		index->at[cursor.index - 1] = before;
		enter_names(index, &symbol, cursor.index - 1);
	}
	return index;
}

/* ---- search ---- */

/* A pin, an index, or the blanks before one follow a name. */
static bool may_end(char c)
{
	return c == '.' || c == '[' || c == ' ';
}

/* The chain of the next beginning of the text; false: there is none. */
static bool next_chain(const struct symbol_index *index, struct symbol_search *search)
{
	const size_t begin = search->end;

	if (begin == search->len)
		return false;
	if (begin == 0)
		search->hash = NAME_HASH;
	do
		search->end++;
	while (search->end < search->len && !may_end(search->text[search->end]));
	search->hash = name_hash_more(search->hash, search->text + begin, search->end - begin);
	search->entry = *chain_of(index, search->hash);
	return true;
}

static bool next_entry(const struct symbol_index *index, struct symbol_search *search)
{
	do {
		while (search->entry) {
			const struct entry *entry = &index->entry[search->entry - 1];

			search->entry = entry->next;
			if (entry->hash != search->hash)
				continue;
			search->all = index->at[entry->symbol];
			return true;
		}
	} while (next_chain(index, search));
	return false;
}

bool symbol_search_next(const struct program *program, struct symbol_search *search,
			struct declared_name *out)
{
	if (program->index && !next_entry(program->index, search))
		return false;
	if (!image_next_declared(program, &search->all, out))
		return false;
	search->number = search->all.index - 1;
	return true;
}
