/* SPDX-License-Identifier: MIT
 *
 * bundle - records random programs on the machine that builds, for `replay` to repeat on
 * the target. The programs are those of the differential test, which a second evaluator
 * checks.
 */
#include "tests/targets/guest/bundle.h"

#include "engine/ladder.h"
#include "tests/targets/guest/cases/cases.h"
#include "tests/walker/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PROGRAM_TEXT (96 * 1024)

struct recorder {
	FILE *out;
	struct random_source source;
	struct resource resource;
	uint8_t record[BUNDLE_RECORD];
	size_t len;
	bool full;
	unsigned long scans, reals, timers, counters, failed;
};

static struct recorder recorder;
static _Alignas(8) uint8_t memory[BUNDLE_DATA + 64], before[BUNDLE_DATA + 64];

static void add(uint64_t value, unsigned bytes)
{
	for (unsigned i = 0; i < bytes; i++) {
		if (recorder.len == sizeof(recorder.record)) {
			recorder.full = true;
			return;
		}
		recorder.record[recorder.len++] = (uint8_t)(value >> 8 * i);
	}
}

static void add_varint(uint32_t value)
{
	for (; value > 127; value >>= 7)
		add((value & 127) | 128, 1);
	add(value, 1);
}

static void add_changes(size_t size)
{
	uint32_t count = 0;
	size_t next = 0;

	for (size_t i = 0; i < size; i++)
		count += memory[i] != before[i];
	add_varint(count);
	for (size_t i = 0; i < size; i++) {
		if (memory[i] == before[i])
			continue;
		add_varint((uint32_t)(i - next));
		add(memory[i], 1);
		next = i + 1;
	}
	memcpy(before, memory, size);
}

static void change_inputs(uint8_t *inputs)
{
	struct random_source *source = &recorder.source;

	for (int i = 0; i < BUNDLE_INPUTS; i++) {
		if (random_chance(source, 50))
			inputs[i] ^= (uint8_t)(1u << random_below(source, 8));
		if (random_chance(source, 10))
			inputs[i] = (uint8_t)random_next(source);
	}
}

static void run_program(size_t size, uint32_t scans)
{
	struct resource *resource = &recorder.resource;
	int64_t now_ns = random_next(&recorder.source);
	uint8_t *inputs = image_area(&resource->image, AREA_I);
	bool good = true;

	memset(before, 0, sizeof(before));
	add_changes(size);
	for (uint32_t i = 0; i < scans; i++) {
		if (good)
			change_inputs(inputs);
		now_ns += random_chance(&recorder.source, 50) ? 5000000 :
			  random_below(&recorder.source, 20000000);
		add((uint64_t)now_ns, 8);
		for (int k = 0; k < BUNDLE_INPUTS; k++)
			add(inputs[k], 1);
		good = resource_scan(resource, now_ns);
		add(good, 1);
		add(resource->vm.errors, 4);
		add_changes(size);
	}
	recorder.failed += !good;
	recorder.scans += scans;
}

static void put_u32(uint32_t value)
{
	for (int i = 0; i < 4; i++)
		putc((int)(value >> 8 * i & 255), recorder.out);
}

static void count_words(const char *text)
{
	recorder.reals += strstr(text, "REAL") != NULL;
	recorder.timers += strstr(text, " TON ") || strstr(text, " TOF ") ||
			   strstr(text, " TP ");
	recorder.counters += strstr(text, "CTU") || strstr(text, "CTD");
}

/* False: this seed gives no suitable program. */
static bool add_program(uint64_t seed)
{
	static struct random_program random;
	static char text[PROGRAM_TEXT];
	static _Alignas(8) uint8_t image[BUNDLE_IMAGE];
	struct ladder *ladder = ladder_new();
	size_t len, image_len, size;
	uint32_t scans;
	bool good;

	random_make(&random, seed);
	len = random_print(&random, text, sizeof(text));
	good = ladder && ladder_load_text(ladder, "random.rung", text, len) &&
	       ladder_build(ladder);
	if (good) {
		const void *whole = ladder_image(ladder, &image_len);

		image_len = code_strip(whole, NULL);
		size = ladder_program(ladder)->header->data_size;
		good = image_len <= sizeof(image) && size <= BUNDLE_DATA;
		if (good)
			code_strip(whole, image);
	}
	if (good) {
		recorder.len = 0;
		recorder.full = false;
		random_seed(&recorder.source, seed ^ 0x5ca5ca5c);
		scans = 10 + random_below(&recorder.source, 11);
		resource_init(&recorder.resource, ladder_program(ladder),
			      memory);
		resource_start(&recorder.resource);
		run_program(size, scans);
		good = !recorder.full;
	}
	if (good) {
		count_words(text);
		put_u32((uint32_t)image_len);
		put_u32(scans);
		put_u32((uint32_t)recorder.len);
		put_u32((uint32_t)size);
		fwrite(image, 1, image_len, recorder.out);
		fwrite(recorder.record, 1, recorder.len, recorder.out);
	}
	ladder_free(ladder);
	return good;
}

int make_bundle(const char *path, uint32_t count, uint64_t seed)
{
	uint32_t made = 0;
	bool good;

	recorder.out = fopen(path, "wb");
	if (!recorder.out) {
		perror(path);
		return 1;
	}
	fputs(BUNDLE_MAGIC, recorder.out);
	put_u32(1);
	put_u32(count);
	for (uint32_t tried = 0; made < count && tried < count * 2; tried++)
		made += add_program(seed + tried);
	good = !ferror(recorder.out);
	good = fclose(recorder.out) == 0 && good && made == count;
	printf("# %s: %u programs, %lu scans; %lu with REAL, %lu with timers, "
	       "%lu with counters, %lu end in a fault\n", path,
	       (unsigned)made, recorder.scans, recorder.reals, recorder.timers,
	       recorder.counters, recorder.failed);
	if (recorder.reals * 10 < made || recorder.timers * 10 < made ||
	    recorder.counters * 10 < made)
		good = false;
	if (!good) {
		fprintf(stderr, "make_cases: %s: no good bundle\n", path);
		remove(path);
	}
	return !good;
}
