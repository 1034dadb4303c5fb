/* SPDX-License-Identifier: MIT
 *
 * storing - the file of --retain, cut at each step of each system call.
 *
 * A small program stores three copies into a new file, a larger one needs a larger file
 * and stores three more. After a number of steps (64 bytes of a write, or any other
 * call) nothing reaches the disk any more, as in a power cut; then the file is read
 * again. It must contain the last copy that was reported as stored, or the next one,
 * complete.
 */
#define _DEFAULT_SOURCE /* mkdtemp() */
#include "ladderd/store_file.h"
#include "tests/unit/rig.h"

#include <errno.h>
#include <sys/types.h>
#include <unistd.h>

#define STEP_BYTES 64
#define COPIES 3

static long left = -1; /* steps to the cut; -1: none */
static long taken;

static bool is_cut(void)
{
	taken++;
	if (left < 0)
		return false;
	if (left == 0) {
		errno = EIO;
		return true;
	}
	left--;
	return false;
}

ssize_t __real_pwrite(int fd, const void *bytes, size_t len, off_t at);
ssize_t __wrap_pwrite(int fd, const void *bytes, size_t len, off_t at);
ssize_t __real_pwrite64(int fd, const void *bytes, size_t len, off_t at);
ssize_t __wrap_pwrite64(int fd, const void *bytes, size_t len, off_t at);
int __wrap_fsync(int fd);
int __wrap_fdatasync(int fd);
int __real_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to);
int __real_unlink(const char *path);
int __wrap_unlink(const char *path);

/* Returns the bytes that reach the disk, so that the rest is written again. */
ssize_t __wrap_pwrite64(int fd, const void *bytes, size_t len, off_t at)
{
	if (is_cut())
		return -1;
	return __real_pwrite64(fd, bytes, len < STEP_BYTES ? len : STEP_BYTES, at);
}

ssize_t __wrap_pwrite(int fd, const void *bytes, size_t len, off_t at)
{
	if (is_cut())
		return -1;
	return __real_pwrite(fd, bytes, len < STEP_BYTES ? len : STEP_BYTES, at);
}

int __wrap_fsync(int fd)
{
	(void)fd;
	return is_cut() ? -1 : 0; /* the disk is checked without a cut */
}

int __wrap_fdatasync(int fd)
{
	(void)fd;
	return is_cut() ? -1 : 0;
}

int __wrap_rename(const char *from, const char *to)
{
	return is_cut() ? -1 : __real_rename(from, to);
}

int __wrap_unlink(const char *path)
{
	return is_cut() ? -1 : __real_unlink(path);
}

/* @wide needs more pages. */
struct bench {
	struct rig rig;
	struct arena arena;
	struct retain retain;
	uint8_t *copy;
};

#define TEXT_MOST 30000

static char folder[] = "/tmp/storingXXXXXX", path[64], fresh[80];
static struct bench narrow, wide;

static void open_bench(struct bench *bench, int values)
{
	char *text = malloc(TEXT_MOST);
	size_t len = 0;

	if (!text)
		abort();
	len += (size_t)snprintf(text, TEXT_MOST, "VAR_GLOBAL RETAIN\n"
				"  A : DINT;\n  B : DINT;\n");
	for (int i = 0; i < values; i++)
		len += (size_t)snprintf(text + len, TEXT_MOST - len,
					"  Value_%d : DINT;\n", i);
	snprintf(text + len, TEXT_MOST - len, "END_VAR\nPROGRAM Main LD\n"
		 "RUNG\n  | [ A := B ] |\nEND_PROGRAM\n");
	rig_open(&bench->rig, text, false);
	free(text);
	arena_init(&bench->arena);
	if (!CHECK(bench->rig.good && retain_plan(&bench->retain,
			&bench->rig.resource.image, &bench->arena)))
		abort();
	bench->copy = arena_alloc(&bench->arena, bench->retain.copy_size);
}

static void close_bench(struct bench *bench)
{
	arena_free(&bench->arena);
	rig_close(&bench->rig);
}

/* Stores @first, @first + 1, …; returns the last one that was reported as stored. */
static int store_copies(struct bench *bench, int first, int stored)
{
	struct store_file file;
	struct retain_found found;
	struct arena arena;
	uint8_t *bytes;
	size_t len;

	arena_init(&arena);
	if (store_file_open(&file, path, &arena, &bytes, &len) == 0) {
		retain_find(bytes ? bytes : (const uint8_t *)"", len, &found);
		store_file_adopt(&file, &found,
				 retain_room(bench->retain.payload_size));
		for (int i = first; i < first + COPIES; i++) {
			rig_set(&bench->rig, "A", i);
			rig_set(&bench->rig, "B", i);
			retain_copy(&bench->retain, &bench->rig.resource.image,
				    bench->copy);
			retain_fill(&bench->retain, bench->copy, i);
			if (store_file_write(&file, &bench->retain) == 0)
				stored = i;
		}
	}
	free(bytes);
	store_file_close(&file);
	arena_free(&arena);
	return stored;
}

/* The A in the file, if its B is equal; 0: no copy; -1: a mix. */
static int read_again(struct retain_found *found, bool *exists)
{
	struct store_file file;
	struct retain_record record;
	struct arena arena;
	uint32_t at = RETAIN_HEAD;
	int32_t value[2] = { 0, 0 };
	uint8_t *bytes;
	size_t len;

	arena_init(&arena);
	store_file_open(&file, path, &arena, &bytes, &len);
	*exists = file.exists;
	retain_find(bytes ? bytes : (const uint8_t *)"", len, found);
	for (int i = 0; found->best >= 0 && i < 2; i++)
		if (retain_next(found->payload, found->len, &at, &record))
			memcpy(&value[i], record.value, sizeof(value[i]));
	free(bytes);
	store_file_close(&file);
	arena_free(&arena);
	return value[0] == value[1] ? value[0] : -1;
}

static int run_until(long steps)
{
	int stored;

	unlink(path);
	unlink(fresh);
	left = steps;
	taken = 0;
	stored = store_copies(&narrow, 1, 0);
	stored = store_copies(&wide, 1 + COPIES, stored);
	left = -1;
	return stored;
}

static void cut_everywhere(void)
{
	struct retain_found found;
	int wrong = 0, unsaid = 0, none = 0, behind = 0, after;
	bool exists;
	long all;

	CHECK(run_until(-1) == 2 * COPIES);
	CHECK(read_again(&found, &exists) == 2 * COPIES && !found.old_copy);
	all = taken;
	for (long cut = 0; cut < all; cut++) {
		int stored = run_until(cut);
		int got = read_again(&found, &exists);

		wrong += got != stored && got != stored + 1;
		none += exists && found.best < 0;
		behind += got == stored + 1;
		/* An incomplete copy beside the complete one is reported. */
		unsaid += got == stored && stored && found.best >= 0 &&
			  found.state[!found.best] == RETAIN_BAD &&
			  !found.old_copy;
		/* Storing goes on after the cut. */
		after = store_copies(&wide, 100, 0);
		wrong += after != 100 + COPIES - 1 ||
			 read_again(&found, &exists) != after;
	}
	printf("# cut at each of %ld steps; %d times what was not told to be "
	       "stored was\n", all, behind);
	CHECK_AS(!wrong, "a cut leaves the last stored copy or the next one complete");
	CHECK_AS(!none, "no cut leaves a file without a copy");
	CHECK_AS(!unsaid, "an incomplete copy beside the complete one is reported");
}

int main(void)
{
	if (!mkdtemp(folder))
		abort();
	snprintf(path, sizeof(path), "%s/keep", folder);
	snprintf(fresh, sizeof(fresh), "%s.new", path);
	open_bench(&narrow, 1);
	open_bench(&wide, 500);
	cut_everywhere();
	close_bench(&narrow);
	close_bench(&wide);
	unlink(path);
	unlink(fresh);
	rmdir(folder);
	return tap_done();
}
