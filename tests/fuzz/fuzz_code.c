/* SPDX-License-Identifier: MIT
 *
 * fuzz_code - reads any bytes as a code image, and runs it if the verifier accepts it.
 *
 * The checksum is corrected and the budget is small, so that changed images get past the
 * first checks. Seeds are rung files that are translated here, so they stay valid when the
 * format changes.
 */
#include "engine/base/digest.h"
#include "engine/exchange/image/image_il.h"
#include "engine/ladder.h"
#include "engine/text/text.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

#define BUDGET_MAX 2000u
#define DATA_MAX (2u << 20)

static bool is_text(const uint8_t *bytes, size_t len)
{
	return len >= 10 && memcmp(bytes, "RUNGBOARD ", 10) == 0;
}

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	struct ladder *ladder = ladder_new();
	const void *image;
	uint8_t *copy = NULL;

	*out_len = len;
	if (ladder && is_text(bytes, len) &&
	    ladder_load_text(ladder, "seed.rung", bytes, len) &&
	    ladder_build(ladder)) {
		image = ladder_image(ladder, out_len);
		copy = malloc(*out_len);
		if (copy)
			memcpy(copy, image, *out_len);
	}
	ladder_free(ladder);
	return copy;
}

static void make_good(uint8_t *bytes, size_t len)
{
	struct code_header header;
	size_t behind = offsetof(struct code_header, crc) + sizeof(header.crc);

	if (len < sizeof(header))
		return;
	memcpy(&header, bytes, sizeof(header));
	header.size = (uint32_t)len;
	if (header.budget > BUDGET_MAX)
		header.budget = BUDGET_MAX;
	memcpy(bytes, &header, sizeof(header));
	header.crc = digest_crc32c(0, bytes + behind, len - behind);
	memcpy(bytes, &header, sizeof(header));
}

static void look_around(struct resource *resource)
{
	const struct program *program = resource->image.program;
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;
	char text[256];
	bool in, out;

	for (int i = 0; i < 200 && image_next_symbol(&resource->image, &cursor,
						     &symbol); i++) {
		image_get(&resource->image, symbol.at);
		image_find(&resource->image, symbol.name, strlen(symbol.name));
	}
	for (uint32_t i = 0; i < 8; i++) {
		resource_power(resource, i & 1, i, 1, i + 1, &in, &out);
		resource_place(program, i * 37);
	}
	for (uint32_t at = 0; at < program->text_words;
	     at += code_words(program->text + at))
		code_print(program->text + at, 0, text, sizeof(text));
}

/* Time advances while tasks run, by the same amounts in each run. */
static int64_t clock_now;

static int64_t clock_ns(const struct resource *resource)
{
	(void)resource;
	return clock_now += 3000000;
}

static void run(const struct program *program)
{
	size_t size = (image_memory_size(program) + 7) / 8 * 8;
	struct resource resource;
	void *memory;

	if (size > DATA_MAX)
		return;
	memory = aligned_alloc(8, size ? size : 8);
	if (!memory)
		return;
	memset(memory, 0xa5, size);
	resource_init(&resource, program, memory);
	resource_start(&resource);
	for (int i = 0; i < 6; i++) {
		uint8_t *inputs = image_area(&resource.image, AREA_I);

		resource.watch = i & 1;
		resource.clock_ns = i & 2 ? clock_ns : NULL;
		resource.patience = (uint32_t)i;
		clock_now = i * (int64_t)7000000;
		memset(inputs, i * 0x35, program->areas.bytes[AREA_I]);
		if (!resource_scan(&resource, i * (int64_t)7000000))
			break;
	}
	look_around(&resource);
	free(memory);
}

/* Its lists are read as a rung file, whatever it says; names may be refused as names. */
static void list(const struct program *program)
{
	struct diag_list *diags;
	struct project *project;
	size_t len;
	char *lost, *text;

	if (image_memory_size(program) > DATA_MAX)
		return;
	text = image_il_text(program, &len, &lost);
	project = project_new("list.rung");
	diags = malloc(sizeof(*diags));
	if (text && project && diags) {
		diag_init(diags);
		text_read(project, "list.rung", text, len, NULL, diags);
		for (int i = 0; i < diags->count; i++)
			fuzz_expect(diags->diag[i].id != DIAG_BAD_BYTE &&
				    diags->diag[i].id != DIAG_BAD_UTF8 &&
				    diags->diag[i].id != DIAG_SYNTAX, "the list is read");
	}
	free(diags);
	project_free(project);
	free(text);
	free(lost);
}

static void open_image(const uint8_t *bytes, size_t len, bool repair)
{
	size_t room = (len + 8) / 8 * 8;
	uint8_t *copy = aligned_alloc(8, room);
	struct program program;
	struct arena scratch;
	enum diag_id why = DIAG_COUNT;
	size_t where = 0;

	if (!copy)
		return;
	memcpy(copy, bytes, len);
	if (repair)
		make_good(copy, len);
	arena_init(&scratch);
	if (code_open(copy, len, &scratch, &program, &why, &where))
	{
		list(&program);
		run(&program);
	}
	else
		fuzz_expect(why < DIAG_COUNT, "a refused image has a reason");
	arena_free(&scratch);
	free(copy);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	size_t seed_len;
	uint8_t *seed = fuzz_seed(bytes, len, &seed_len);

	open_image(seed ? seed : bytes, seed_len, true);
	if (!seed)
		open_image(bytes, len, false);
	free(seed);
	return 0;
}
