/* SPDX-License-Identifier: MIT
 *
 * exhaustion - memory runs out at the 1st, 2nd, 3rd … allocation, until loading,
 * building and writing succeed.
 *
 *   exhaustion [FILE…]
 *
 * Linked with --wrap, so that every allocation of the engine comes by here. Each
 * failure must be told as LD001, and nothing may be left behind.
 */
#include "engine/ladder.h"
#include "engine/base/file.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <sys/mman.h>

#define ATTEMPTS_MAX 100000

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t align, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t align, size_t size);
void __wrap_free(void *block);
/* By the name that mmap() has where offsets are of 64 bits. */
void *__real_mmap64(void *at, size_t size, int prot, int flags, int fd, off_t offset);
void *__wrap_mmap64(void *at, size_t size, int prot, int flags, int fd, off_t offset);
int __real_munmap(void *at, size_t size);
int __wrap_munmap(void *at, size_t size);

static long live;         /* blocks given and not taken back                  */
static long mapped;       /* bytes, likewise                                  */
static long left = -1;    /* allocations that still succeed; -1: all          */
static long refused;

static bool may_allocate(void)
{
	if (left == 0) {
		refused++;
		return false;
	}
	if (left > 0)
		left--;
	return true;
}

static void *counted(void *block)
{
	live += block != NULL;
	return block;
}

void *__wrap_malloc(size_t size)
{
	return may_allocate() ? counted(__real_malloc(size)) : NULL;
}

void *__wrap_calloc(size_t count, size_t size)
{
	return may_allocate() ? counted(__real_calloc(count, size)) : NULL;
}

void *__wrap_realloc(void *old, size_t size)
{
	void *block;

	if (!may_allocate())
		return NULL;
	block = __real_realloc(old, size);
	live += block && !old;
	return block;
}

void *__wrap_aligned_alloc(size_t align, size_t size)
{
	return may_allocate() ? counted(__real_aligned_alloc(align, size)) :
				NULL;
}

void __wrap_free(void *block)
{
	live -= block != NULL;
	__real_free(block);
}

void *__wrap_mmap64(void *at, size_t size, int prot, int flags, int fd, off_t offset)
{
	void *memory = MAP_FAILED;

	if (may_allocate())
		memory = __real_mmap64(at, size, prot, flags, fd, offset);
	mapped += memory != MAP_FAILED ? (long)size : 0;
	return memory;
}

int __wrap_munmap(void *at, size_t size)
{
	mapped -= (long)size;
	return __real_munmap(at, size);
}

enum stage { STAGE_NEW, STAGE_LOAD, STAGE_BUILD, STAGE_WRITE, STAGE_DONE };

static bool has_no_memory(struct ladder *ladder)
{
	const struct diag_list *diags = ladder_diags(ladder);

	for (int i = 0; i < diags->count; i++)
		if (diags->diag[i].id == DIAG_NO_MEMORY)
			return true;
	return false;
}

/* How far it comes, and whether it says why it came no further. */
static enum stage try_all(const char *file, const char *text, size_t len,
			  bool *told)
{
	struct ladder *ladder = ladder_new();
	enum stage stage = STAGE_LOAD;
	char *written;
	size_t written_len;

	*told = true;
	if (!ladder)
		return STAGE_NEW;
	if (ladder_load_text(ladder, file, text, len)) {
		stage = STAGE_BUILD;
		if (ladder_build(ladder))
			stage = STAGE_WRITE;
	}
	if (stage != STAGE_WRITE)
		*told = has_no_memory(ladder);
	written = stage == STAGE_WRITE ? ladder_write(ladder, &written_len) :
					 NULL;
	if (written)
		stage = STAGE_DONE;
	free(written);
	ladder_free(ladder);
	return stage;
}

static void starve(const char *file, const char *text, size_t len)
{
	long before = live + mapped, untold = 0, leaks = 0, lies = 0, n;
	enum stage stage = STAGE_NEW;
	char what[256];

	for (n = 0; n < ATTEMPTS_MAX && stage != STAGE_DONE; n++) {
		bool told;

		refused = 0;
		left = n;
		stage = try_all(file, text, len, &told);
		left = -1;
		untold += !told;
		leaks += live + mapped - before;
		/* Refused, and yet all went well: somebody ignored a NULL. */
		lies += refused && stage == STAGE_DONE;
	}
	printf("# %s: %ld allocations\n", file, n - 1);
	snprintf(what, sizeof(what), "%.200s succeeds in the end", file);
	CHECK_AS(stage == STAGE_DONE && n > 2, what);
	snprintf(what, sizeof(what), "%.200s: each failure is LD001", file);
	CHECK_AS(untold == 0, what);
	snprintf(what, sizeof(what), "%.200s: nothing leaks", file);
	CHECK_AS(leaks == 0, what);
	snprintf(what, sizeof(what), "%.200s: no NULL is overlooked", file);
	CHECK_AS(lies == 0, what);
}

static void starve_file(const char *path)
{
	struct diag_list diags;
	size_t len;
	char *text;

	diag_init(&diags);
	text = file_read(path, LIMIT_TEXT, &len, &diags);
	if (CHECK_AS(text, path))
		starve(path, text, len);
	free(text);
}

int main(int argc, char **argv)
{
	for (int i = 1; i < argc; i++)
		starve_file(argv[i]);
	if (argc == 1) {
		starve_file("ladders/garage-door.rung");
		starve_file("tests/fuzz/corpus/code/random-100.rung");
		starve_file("tests/fuzz/corpus/code/il.rung");
		starve_file("tests/fuzz/corpus/code/tasks.rung");
		starve_file("tests/fuzz/corpus/code/arrays-in-blocks.rung");
	}
	return tap_done();
}
