/* SPDX-License-Identifier: MIT
 *
 * test_arena - memory is zeroed, aligned, kept and grown in place; impossible sizes are
 * refused.
 */
#include "engine/base/arena.h"
#include "tests/tap.h"

#include <stdint.h>

static void gives_zeroed_memory(void)
{
	struct arena arena;
	bool zero = true, aligned = true;
	size_t sum = 0;

	arena_init(&arena);
	CHECK(arena.reserved == 0);
	for (size_t size = 0; size < 3000; size += 7) {
		unsigned char *memory = arena_alloc(&arena, size);

		sum += size;
		aligned &= memory && (uintptr_t)memory % 8 == 0;
		for (size_t i = 0; memory && i < size; i++) {
			zero &= memory[i] == 0;
			memory[i] = 0xaa;
		}
	}
	CHECK(zero);
	CHECK(aligned);
	CHECK(arena.used == sum);
	CHECK(arena.reserved >= sum);
	CHECK(arena_alloc(&arena, 0) != NULL);
	arena_free(&arena);
	CHECK(arena.chunk == NULL && arena.reserved == 0 && arena.used == 0);
}

static void reset_keeps_a_chunk(void)
{
	struct arena arena;
	unsigned char *memory;
	size_t reserved;
	bool zero = true;

	arena_init(&arena);
	for (int i = 0; i < 100; i++)
		memset(arena_alloc(&arena, 1000), 0x55, 1000);
	arena_reset(&arena);
	CHECK(arena.used == 0);
	CHECK(arena.chunk != NULL);
	reserved = arena.reserved;
	memory = arena_alloc(&arena, 1000);
	for (int i = 0; i < 1000; i++)
		zero &= memory[i] == 0;
	CHECK(zero);
	CHECK(arena.reserved == reserved);
	arena_free(&arena);
	arena_reset(&arena);
	CHECK(arena.chunk == NULL);
}

static void grows(void)
{
	struct arena arena;
	char *a, *b, *c;

	arena_init(&arena);
	a = arena_grow(&arena, NULL, 0, 10);
	memcpy(a, "123456789", 10);
	b = arena_grow(&arena, a, 10, 20);
	CHECK_AS(a == b, "the last allocation grows in place");
	CHECK_TEXT(b, "123456789");
	CHECK(b[10] == 0 && b[19] == 0);
	CHECK(arena.used == 20);
	arena_alloc(&arena, 8);
	c = arena_grow(&arena, b, 20, 40);
	CHECK_AS(c != b, "an older allocation moves when it grows");
	CHECK_TEXT(c, "123456789");
	CHECK_TEXT(b, "123456789");
	c = arena_grow(&arena, c, 40, 300000);
	CHECK_AS(c && c[299999] == 0, "an allocation larger than a chunk is zeroed");
	CHECK_TEXT(c, "123456789");
	arena_free(&arena);
}

static void pushes(void)
{
	struct arena arena;
	int *vector = NULL, count = 0;
	bool same = true;

	arena_init(&arena);
	for (int i = 0; i < 1000; i++) {
		int *added = arena_push(&arena, &vector, &count, sizeof(int));

		same &= added == vector + i && *added == 0;
		*added = i * 3;
		if (i % 100 == 0)
			arena_alloc(&arena, 1);
	}
	CHECK(count == 1000);
	CHECK(same);
	for (int i = 0; i < 1000; i++)
		same &= vector[i] == i * 3;
	CHECK_AS(same, "a vector keeps its elements when it moves");
	arena_free(&arena);
}

static void copies_text(void)
{
	struct arena arena;

	arena_init(&arena);
	CHECK_TEXT(arena_copy(&arena, "motor and more", 5), "motor");
	CHECK_TEXT(arena_copy(&arena, NULL, 0), "");
	CHECK((uintptr_t)arena_alloc(&arena, 8) % 8 == 0);
	arena_free(&arena);
}

static void refuses(void)
{
	struct arena arena;
	int *vector = NULL, count = 0;
	char *kept;

	arena_init(&arena);
	kept = arena_copy(&arena, "kept", 4);
	CHECK(arena_grow(&arena, kept, 5, SIZE_MAX - 3) == NULL);
	CHECK(arena.failed);
	CHECK_TEXT(kept, "kept");
	CHECK_AS(arena_alloc(&arena, 1) == NULL, "a failed arena gives no more memory");
	CHECK(arena_grow(&arena, kept, 5, 6) == NULL);
	CHECK(arena_copy(&arena, "x", 1) == NULL);
	CHECK(arena_push(&arena, &vector, &count, 4) == NULL);
	CHECK(vector == NULL && count == 0);
	arena_free(&arena);
	CHECK(!arena.failed);
	CHECK(arena_copy(&arena, "x", SIZE_MAX) == NULL);
	arena_free(&arena);
	CHECK(arena_alloc(&arena, SIZE_MAX) == NULL);
	arena_free(&arena);
	CHECK(arena_push(&arena, &vector, &count, SIZE_MAX / 4) == NULL);
	CHECK(vector == NULL && count == 0);
	arena_free(&arena);
}

int main(void)
{
	gives_zeroed_memory();
	reset_keeps_a_chunk();
	grows();
	pushes();
	copies_text();
	refuses();
	return tap_done();
}
