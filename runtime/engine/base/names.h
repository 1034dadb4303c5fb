/* SPDX-License-Identifier: MIT
 *
 * names - every string of a project, stored once and known by a number.
 *
 * Rungs hold string ids instead of pointers, so that a rung is plain bytes that can be
 * copied and compared. The names of a program ignore case (name.h): `fold` gives one id
 * for all spellings. The table only grows and lives as long as its arena.
 */
#ifndef BASE_NAMES_H
#define BASE_NAMES_H

#include "engine/base/arena.h"

#include <stdint.h>

struct names_entry;

struct names {
	struct arena *arena;
	struct names_entry *entry; /* by id; entry 0 is the empty string      */
	uint32_t *slot;            /* open hash of ids                        */
	int count;
	uint32_t mask;
};

/** names_init - an empty table that allocates from @arena. Scan-safe: no. */
void names_init(struct names *names, struct arena *arena);

/**
 * names_intern - the id of a string, made at its first use
 * @len: bytes of @text; it need not end in NUL and may hold any bytes
 *
 * Owns: the table.   Scan-safe: no.
 * Fails: 0 when memory is out; the empty string is 0 too.
 */
uint32_t names_intern(struct names *names, const char *text, size_t len);

/** names_find - as names_intern, but 0 if the string is not in the table. */
uint32_t names_find(const struct names *names, const char *text, size_t len);

/** names_find_any - the id that all spellings of a text share (names_fold()), even if
 * this spelling is not in the table; 0: no spelling is. */
uint32_t names_find_any(const struct names *names, const char *text, size_t len);

/** names_text - the NUL-ended string of @id; lives with the arena. */
const char *names_text(const struct names *names, uint32_t id);

/** names_len - its length in bytes. */
size_t names_len(const struct names *names, uint32_t id);

/**
 * names_fold - the id that all spellings of a name share (name.h)
 *
 * The result is the id of the spelling that was interned first. Scan-safe: yes.
 * Fails: 0 for the empty string and ids that are none.
 */
uint32_t names_fold(const struct names *names, uint32_t id);

#endif
