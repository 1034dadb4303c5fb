/* SPDX-License-Identifier: MIT
 *
 * arena - one growing block of memory a project, freed whole.
 *
 * A load allocates from one arena only: a failed load leaks nothing, and a finished one
 * knows how much memory it uses. Single allocations cannot be freed. Not for use inside
 * a scan.
 */
#ifndef BASE_ARENA_H
#define BASE_ARENA_H

#include <stdbool.h>
#include <stddef.h>

struct arena_chunk;

struct arena {
	struct arena_chunk *chunk; /* newest first                           */
	size_t used;               /* bytes handed out                       */
	size_t reserved;           /* bytes taken from the system            */
	bool failed;               /* sticky: an allocation did not succeed  */
};

/** arena_init - an empty arena. Owns: nothing yet. Scan-safe: yes. */
void arena_init(struct arena *arena);

/** arena_free - gives everything back; @arena is empty again. Scan-safe: no. */
void arena_free(struct arena *arena);

/** arena_reset - empties it but keeps its first chunk, for scratch memory that is used
 * again and again. Pointers into it are invalid afterwards. Scan-safe: yes. */
void arena_reset(struct arena *arena);

/**
 * arena_alloc - zeroed memory that lives as long as the arena
 * @size: bytes; 0 gives a valid pointer to nothing
 *
 * Owns: the arena.   Scan-safe: no.
 * Fails: NULL when memory is out, and ever after; @arena->failed stays set.
 */
void *arena_alloc(struct arena *arena, size_t size);

/**
 * arena_grow - a larger copy of a vector
 * @old:      what arena_alloc or arena_grow gave, or NULL
 * @old_size: bytes to keep
 * @new_size: bytes wanted, zeroed past @old_size
 *
 * Extends in place when @old was the last allocation.
 * Owns: the arena.   Scan-safe: no.   Fails: NULL; @old stays valid.
 */
void *arena_grow(struct arena *arena, void *old, size_t old_size,
		 size_t new_size);

/** arena_copy - @len bytes of @text and a closing NUL. As arena_alloc. */
char *arena_copy(struct arena *arena, const char *text, size_t len);

/**
 * arena_push - room for one more element of a vector
 * @vector: pointer to the vector's pointer (NULL at first); doubled when full
 * @count:  elements in use; the new one is at that index, and it is counted
 * @size:   bytes of an element
 *
 * The capacity is the next power of two, at least 8, and is not stored.
 * Owns: the arena. Scan-safe: no.
 * Fails: NULL when memory is out; the vector is as before.
 */
void *arena_push(struct arena *arena, void *vector, int *count, size_t size);

#endif
