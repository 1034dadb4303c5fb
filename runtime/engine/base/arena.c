/* SPDX-License-Identifier: MIT
 *
 * arena - one growing block of memory a project, freed whole.
 *
 * The only place of the engine's loader that asks the system for memory. A size that
 * overflows is refused. Memory that was handed out never moves.
 */
#define _DEFAULT_SOURCE /* madvise(), MAP_ANONYMOUS */
#include "engine/base/arena.h"

#include "engine/base/limits.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

struct arena_chunk {
	struct arena_chunk *next; /* older                                   */
	size_t size, used;        /* bytes behind this header                */
	size_t last;              /* offset of the last allocation           */
	size_t dirty;             /* bytes from here on are zero             */
	bool mapped;              /* by mmap(); else by calloc()             */
	uint64_t bytes[];         /* of the strictest alignment              */
};

#ifndef MADV_HUGEPAGE
#define MADV_HUGEPAGE MADV_NORMAL
#endif
#if defined(RUNGBOARD_SMALL) || defined(__SANITIZE_ADDRESS__)
#define MAPS 0 /* no MMU, or nothing so large; a sanitizer follows pointers from the heap alone */
#else
#define MAPS 1
#endif
#define ALIGN     8u
#define CHUNK_MIN 4000u
#define HUGE_PAGE ((size_t)2 << 20) /* of x86-64 and arm64                  */
#define PAGE      ((size_t)64 << 10) /* the largest that a kernel has for these */
#define MAP_LEAST ((size_t)64 << 10)

void arena_init(struct arena *arena)
{
	*arena = (struct arena){ 0 };
}

static void free_chunks(struct arena_chunk *chunk)
{
	while (chunk) {
		struct arena_chunk *next = chunk->next;

		if (chunk->mapped)
			munmap(chunk, sizeof(*chunk) + chunk->size);
		else
			free(chunk);
		chunk = next;
	}
}

void arena_free(struct arena *arena)
{
	free_chunks(arena->chunk);
	arena_init(arena);
}

void arena_reset(struct arena *arena)
{
	struct arena_chunk *chunk = arena->chunk;

	if (chunk) {
		free_chunks(chunk->next);
		chunk->next = NULL;
		chunk->used = chunk->last = 0;
		arena->reserved = sizeof(*chunk) + chunk->size;
	}
	arena->used = 0;
	arena->failed = false;
}

/* Huge pages from the system, all zero: @whole bytes of them. malloc() would keep them
 * and hand them out again with old bytes in them. */
static struct arena_chunk *map_chunk(size_t whole)
{
	size_t asked = whole + HUGE_PAGE, head;
	char *memory = mmap(NULL, asked, PROT_READ | PROT_WRITE,
			    MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
	struct arena_chunk *chunk;

	if (memory == MAP_FAILED)
		return NULL;
	head = -(uintptr_t)memory & (HUGE_PAGE - 1);
	if (head)
		munmap(memory, head);
	munmap(memory + head + whole, HUGE_PAGE - head);
	chunk = (void *)(memory + head);
	madvise(chunk, whole, MADV_HUGEPAGE); /* only a hint; its failure does not matter */
	chunk->size = whole - sizeof(*chunk);
	chunk->mapped = true;
	return chunk;
}

/* Pages from the system, which are no memory until they are used. calloc() would clear them all, if the heap
 * had them before. */
static struct arena_chunk *map_pages(size_t whole)
{
	struct arena_chunk *chunk = mmap(NULL, whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);

	if (chunk == MAP_FAILED)
		return NULL;
	chunk->size = whole - sizeof(*chunk);
	chunk->mapped = true;
	return chunk;
}

/* @size bytes with a header, all zero. Large ones are huge pages: a load of 40 MB then
 * takes twenty page faults, not ten thousand. */
static struct arena_chunk *new_chunk(size_t size)
{
	size_t whole = sizeof(struct arena_chunk) + size;
	struct arena_chunk *chunk;

	if (MAPS && size >= HUGE_PAGE - 64)
		return whole > SIZE_MAX - 2 * HUGE_PAGE ? NULL :
		       map_chunk((whole + HUGE_PAGE - 1) & ~(HUGE_PAGE - 1));
	if (MAPS && size >= MAP_LEAST)
		return map_pages((whole + PAGE - 1) & ~(PAGE - 1));
	chunk = calloc(1, whole);
	if (chunk)
		chunk->size = size;
	return chunk;
}

static bool add_chunk(struct arena *arena, size_t wanted)
{
	struct arena_chunk *chunk;
	size_t size = CHUNK_MIN;

	if (arena->chunk)
		size = arena->chunk->size * 4;
	if (size > LIMIT_CHUNK)
		size = LIMIT_CHUNK;
	if (size < wanted)
		size = wanted;
	if (size > SIZE_MAX - sizeof(*chunk))
		return false;
	chunk = new_chunk(size);
	if (!chunk)
		return false;
	chunk->next = arena->chunk;
	arena->chunk = chunk;
	arena->reserved += sizeof(*chunk) + chunk->size;
	return true;
}

/* Zeroes @memory, which lies in the newest chunk, up to @size bytes. Bytes fresh from
 * the system are zero already and are not touched, so a large table costs little until
 * it is filled. */
static void zero(struct arena *arena, void *memory, size_t size)
{
	struct arena_chunk *chunk = arena->chunk;
	size_t from = (size_t)((char *)memory - (char *)chunk->bytes);
	size_t to = from + size < chunk->dirty ? from + size : chunk->dirty;

	if (from < to)
		memset(memory, 0, to - from);
	if (from + size > chunk->dirty)
		chunk->dirty = from + size;
}

/* Bytes that are not zeroed yet; @align is a power of two up to ALIGN. */
static void *take(struct arena *arena, size_t size, size_t align)
{
	struct arena_chunk *chunk = arena->chunk;
	size_t at = chunk ? (chunk->used + align - 1) & ~(align - 1) : 0;

	if (arena->failed)
		return NULL;
	if (!chunk || at > chunk->size || size > chunk->size - at) {
		if (!add_chunk(arena, size)) {
			arena->failed = true;
			return NULL;
		}
		chunk = arena->chunk;
		at = 0;
	}
	chunk->last = at;
	chunk->used = at + size;
	arena->used += size;
	return (char *)chunk->bytes + at;
}

void *arena_alloc(struct arena *arena, size_t size)
{
	void *memory = take(arena, size, ALIGN);

	if (memory)
		zero(arena, memory, size);
	return memory;
}

/* Is there room to make @old, the last allocation, @size bytes long? */
static bool extends(const struct arena *arena, const void *old, size_t size)
{
	const struct arena_chunk *chunk = arena->chunk;

	return chunk && old == (const char *)chunk->bytes + chunk->last &&
	       size <= chunk->size - chunk->last;
}

void *arena_grow(struct arena *arena, void *old, size_t old_size,
		 size_t new_size)
{
	size_t keep = old_size < new_size ? old_size : new_size;
	char *memory;

	if (!old)
		return arena_alloc(arena, new_size);
	if (arena->failed)
		return NULL;
	if (extends(arena, old, new_size)) {
		struct arena_chunk *chunk = arena->chunk;
		size_t end = chunk->last + new_size;

		if (end > chunk->used) {
			arena->used += end - chunk->used;
			chunk->used = end;
		}
		memory = old;
	} else {
		memory = take(arena, new_size, ALIGN);
		if (!memory)
			return NULL;
		if (keep)
			memcpy(memory, old, keep);
	}
	zero(arena, memory + keep, new_size - keep);
	return memory;
}

char *arena_copy(struct arena *arena, const char *text, size_t len)
{
	char *copy;

	if (len == SIZE_MAX)
		arena->failed = true;
	copy = take(arena, len + 1, 1);
	if (!copy)
		return NULL;
	zero(arena, copy + len, 1);
	if (len)
		memcpy(copy, text, len);
	return copy;
}

/* Doubles the capacity at 0, 8, 16, 32 …: the count alone says when it is used up. */
static bool is_full(size_t count)
{
	return count == 0 || (count >= 8 && (count & (count - 1)) == 0);
}

void *arena_push(struct arena *arena, void *vector, int *count, size_t size)
{
	size_t used = (size_t)*count;
	char *first;

	/* @vector is any T **: read and written as bytes, so that no aliasing
	 * rule is broken. */
	memcpy(&first, vector, sizeof(first));
	if (is_full(used)) {
		size_t room = used ? used * 2 : 8;

		if (room > (size_t)INT32_MAX || size > SIZE_MAX / room) {
			arena->failed = true;
			return NULL;
		}
		first = arena_grow(arena, first, used * size, room * size);
		if (!first)
			return NULL;
		memcpy(vector, &first, sizeof(first));
	}
	*count += 1;
	return first + used * size;
}
