/* SPDX-License-Identifier: MIT
 *
 * replay - runs a fuzz target on its saved corpus, without libFuzzer.
 *
 *   fuzz_X [--rounds N] [--seed S] [--write FOLDER] [FOLDER…]
 *
 * Without a folder it reads tests/fuzz/corpus/X and the samples; the target for
 * ClassicLadder also reads the folder in SAMPLES. FUZZ_ROUNDS sets N. Each file is one TAP
 * line; then N mutations follow with a fixed seed, so that each `make check` fuzzes a
 * little. --write writes the seeds to a folder, as inputs for libFuzzer. After a crash, the
 * input is in fuzz_X.crash beside the program.
 */
#include "tests/fuzz/fuzz.h"
#include "tests/tap.h"
#include "tests/walker/random.h"

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#define INPUT_MAX (1u << 20)
#define SEEDS_MAX 512
#define ROUNDS 20000   /* default number of mutations                         */
#define STUCK_S 60    /* guard against hanging, of one input                 */

struct seed {
	char name[256];
	uint8_t *bytes;
	size_t len;
};

struct corpus {
	struct seed seed[SEEDS_MAX];
	int count;
};

/* The input under test, for the signal handler. */
static const uint8_t *current;
static size_t current_len;
static char crash_path[1024];

static void on_crash(int number)
{
	FILE *file = fopen(crash_path, "wb");

	if (file) {
		fwrite(current, 1, current_len, file);
		fclose(file);
	}
	signal(number, SIG_DFL);
	raise(number);
}

static void try_input(const uint8_t *bytes, size_t len)
{
	/* A copy of the exact size, so that a sanitizer finds reads past its end. */
	uint8_t *copy = malloc(len ? len : 1);

	if (!copy)
		return;
	if (len)
		memcpy(copy, bytes, len);
	current = copy;
	current_len = len;
	alarm(STUCK_S);
	LLVMFuzzerTestOneInput(copy, len);
	alarm(0);
	free(copy);
}

static uint8_t *read_file(const char *path, size_t *len)
{
	FILE *file = fopen(path, "rb");
	uint8_t *bytes = malloc(INPUT_MAX);

	*len = 0;
	if (file && bytes)
		*len = fread(bytes, 1, INPUT_MAX, file);
	if (file)
		fclose(file);
	return bytes;
}

static int by_name(const struct dirent **a, const struct dirent **b)
{
	return strcmp((*a)->d_name, (*b)->d_name);
}

static void read_folder(struct corpus *corpus, const char *folder)
{
	struct dirent **entry = NULL;
	int count = scandir(folder, &entry, NULL, by_name);
	char path[1024];

	for (int i = 0; i < count; i++) {
		struct seed *seed = &corpus->seed[corpus->count];
		const char *name = entry[i]->d_name;
		size_t len;
		uint8_t *bytes;

		if (*name != '.' && corpus->count < SEEDS_MAX) {
			snprintf(path, sizeof(path), "%s/%s", folder, name);
			bytes = read_file(path, &len);
			try_input(bytes, len);
			seed->bytes = fuzz_seed(bytes, len, &seed->len);
			if (seed->bytes)
				free(bytes);
			else
				seed->bytes = bytes;
			snprintf(seed->name, sizeof(seed->name), "%.250s", name);
			CHECK_AS(seed->bytes, seed->name);
			corpus->count++;
		}
		free(entry[i]);
	}
	free(entry);
}

/* Makes one change: a byte, a number, or a range that is doubled, deleted or copied. */
static size_t mutate_once(struct random_source *source,
			  const struct corpus *corpus, uint8_t *bytes, size_t len)
{
	static const uint8_t odd[] = { 0, 1, 0x7f, 0x80, 0xff, '|', '^', '(',
				       '"', '\n', ':', '#', '%', '.', '9' };
	size_t at = random_below(source, (uint32_t)len + 1);
	size_t run = 1 + random_below(source, random_chance(source, 80) ? 8 : 64);
	const struct seed *other =
		&corpus->seed[random_below(source, (uint32_t)corpus->count)];
	size_t from = random_below(source, (uint32_t)other->len + 1);

	if (at + run > len)
		run = len - at;
	switch (random_below(source, 6)) {
	case 0:
		if (at < len)
			bytes[at] ^= (uint8_t)(1u << random_below(source, 8));
		return len;
	case 1:
		if (at < len)
			bytes[at] = odd[random_below(source, sizeof(odd))];
		return len;
	case 2:
		memmove(bytes + at, bytes + at + run, len - at - run);
		return len - run;
	case 3:
		if (len + run > INPUT_MAX)
			return len;
		memmove(bytes + at + run, bytes + at, len - at);
		return len + run;
	case 4:
		for (size_t i = 0; i < 4 && at + i < len; i++)
			bytes[at + i] = (uint8_t)random_next(source);
		return len;
	default:
		for (size_t i = 0; i < run && from + i < other->len; i++)
			bytes[at + i] = other->bytes[from + i];
		return len;
	}
}

/* For images: changes a word a little, or to the value of another word. */
static void change_word(struct random_source *source, uint8_t *bytes, size_t len)
{
	uint32_t words = (uint32_t)(len / 4), word, other;
	size_t at = random_below(source, words) * 4u;

	memcpy(&word, bytes + at, 4);
	memcpy(&other, bytes + random_below(source, words) * 4u, 4);
	switch (random_below(source, 5)) {
	case 0:
		word = other;
		break;
	case 1:
		word += random_below(source, 9) - 4;
		break;
	case 2:
		word ^= 1u << random_below(source, 32);
		break;
	case 3:
		word = (word & 0xff000000u) | (other & 0xffffffu);
		break;
	default:
		word = (word & 0xffffffu) | (other & 0xff000000u);
		break;
	}
	memcpy(bytes + at, &word, 4);
}

static void mutate(const struct corpus *corpus, long rounds, uint64_t start)
{
	static uint8_t bytes[INPUT_MAX + 64];
	struct random_source source;

	random_seed(&source, start);
	for (long i = 0; i < rounds && corpus->count > 0; i++) {
		const struct seed *seed = &corpus->seed[
			random_below(&source, (uint32_t)corpus->count)];
		uint32_t changes = 1 + random_below(&source, 6);
		bool words = random_chance(&source, 50);
		size_t len = seed->len;

		if (len > 64 * 1024)
			continue;
		memcpy(bytes, seed->bytes, len);
		while (changes--) {
			if (words && len >= 4)
				change_word(&source, bytes, len);
			else
				len = mutate_once(&source, corpus, bytes, len);
		}
		try_input(bytes, len);
	}
	CHECK_AS(1, "mutations");
}

static void write_seeds(const struct corpus *corpus, const char *folder)
{
	char path[1024];

	for (int i = 0; i < corpus->count; i++) {
		FILE *file;

		snprintf(path, sizeof(path), "%s/%s", folder,
			 corpus->seed[i].name);
		file = fopen(path, "wb");
		if (!file)
			continue;
		fwrite(corpus->seed[i].bytes, 1, corpus->seed[i].len, file);
		fclose(file);
	}
}

/* The corpus folder of the target. */
static void read_own(struct corpus *corpus, const char *program)
{
	const char *name = strrchr(program, '_'), *more = getenv("SAMPLES");
	char path[256];

	snprintf(path, sizeof(path), "tests/fuzz/corpus/%s",
		 name ? name + 1 : "");
	read_folder(corpus, path);
	if (strcmp(path, "tests/fuzz/corpus/classic") == 0) {
		read_folder(corpus, "tests/classic/projects");
		snprintf(path, sizeof(path), "%.200s/classicladder", more ? more : "");
		read_folder(corpus, path);
		return;
	}
	read_folder(corpus, strcmp(path, "tests/fuzz/corpus/iomap") == 0 ?
			    "ladders/boards" : "ladders");
}

int main(int argc, char **argv)
{
	static struct corpus corpus;
	const char *folder = NULL, *wish = getenv("FUZZ_ROUNDS");
	uint64_t seed = 1;
	long rounds = wish ? strtol(wish, NULL, 10) : ROUNDS;

	snprintf(crash_path, sizeof(crash_path), "%.1000s.crash", argv[0]);
	signal(SIGABRT, on_crash);
	signal(SIGSEGV, on_crash);
	signal(SIGALRM, on_crash);
	for (int i = 1; i < argc; i++) {
		bool more = i + 1 < argc;

		if (more && strcmp(argv[i], "--rounds") == 0)
			rounds = strtol(argv[++i], NULL, 10);
		else if (more && strcmp(argv[i], "--seed") == 0)
			seed = strtoull(argv[++i], NULL, 10);
		else if (more && strcmp(argv[i], "--write") == 0)
			folder = argv[++i];
		else
			read_folder(&corpus, argv[i]);
	}
	if (corpus.count == 0)
		read_own(&corpus, argv[0]);
	if (folder)
		write_seeds(&corpus, folder);
	else
		mutate(&corpus, rounds, seed);
	for (int i = 0; i < corpus.count; i++)
		free(corpus.seed[i].bytes);
	return tap_done();
}
