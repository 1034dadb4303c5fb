/* SPDX-License-Identifier: MIT
 *
 * test_code_text - texts in code images: wrong rooms and lengths are refused; an image
 * with one byte changed is refused or stays within its memory.
 */
#include "engine/base/digest.h"
#include "tests/unit/rig.h"

static const char source[] =
	"VAR\n"
	"  Name  : STRING[6] := 'pump';\n"
	"  Twice : STRING[10];\n"
	"  Part  : STRING[3];\n"
	"  Long  : STRING[255];\n"
	"  Count : INT;\n"
	"  Clock : TOD := TOD#23:00:00;\n"
	"END_VAR\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | CONCAT IN1:=Name IN2:=Name IN3:='!' OUT=>Twice | COIL Q0 |\n"
	"RUNG\n  | MID IN:=Twice L:=3 P:=2 OUT=>Part | COIL Q1 |\n"
	"RUNG\n  | [ Part = 'ump' ] | LEN IN:=Part OUT=>Count | COIL Q2 |\n"
	"RUNG\n  | INSERT IN1:=Long IN2:=Name P:=Count OUT=>Long | COIL Q3 |\n"
	"RUNG\n  | MOVE IN:=Long OUT=>Part | [ Clock := Clock + T#1h ] |\n"
	"RUNG\n  | REPLACE IN1:=Long IN2:='' L:=Count P:=1 OUT=>Name |\n"
	"END_PROGRAM\n";

static const uint8_t *good;
static uint8_t *image;
static uint8_t *memory;
static size_t len;

static struct code_header *header(void)
{
	return (void *)image;
}

static void fresh(void)
{
	memcpy(image, good, len);
}

static void seal(void)
{
	size_t covered = offsetof(struct code_header, crc) + 4;

	header()->crc = digest_crc32c(0, image + covered, len - covered);
}

static bool refused(void)
{
	enum diag_id why = DIAG_COUNT;
	struct arena scratch;
	struct program program;
	size_t where;
	bool open;

	seal();
	arena_init(&scratch);
	open = code_open(image, len, &scratch, &program, &why, &where);
	arena_free(&scratch);
	fresh();
	return !open && why == DIAG_IMAGE_REFUSED;
}

/* The run of texts with room for @capacity bytes. */
static struct code_run *run_of(uint32_t capacity)
{
	const struct code_section *at = &header()->section[CODE_LAYOUT];
	struct code_run *run = (void *)(image + at->offset);

	for (uint32_t i = 0; i < at->size / sizeof(*run); i++)
		if (run[i].type == IEC_STRING && run[i].word == capacity)
			return run + i;
	CHECK_AS(false, "the image has a run of texts of this room");
	return run;
}

/* The initial bytes of the text that begins at @offset. */
static struct iec_string *init_of(uint32_t offset)
{
	const struct code_section *at = &header()->section[CODE_INIT];
	uint32_t *word = (void *)(image + at->offset), *end = word + at->size / 4;

	for (; word < end; word += 2 + (word[1] + 3) / 4)
		if (offset >= word[0] && offset - word[0] < word[1])
			return (void *)((uint8_t *)(word + 2) + (offset - word[0]));
	CHECK_AS(false, "the image has initial bytes for this text");
	return (void *)image;
}

static void refuses_rooms(void)
{
	run_of(6)->word = 0;
	CHECK_AS(refused(), "a text without room is refused");
	run_of(6)->word = 256;
	CHECK_AS(refused(), "a text with more room than 255 is refused");
	run_of(255)->word = UINT16_MAX;
	CHECK(refused());
	run_of(6)->word = 60;
	CHECK_AS(refused(), "a text that overlaps the next run is refused");
	run_of(6)->count = 2;
	CHECK(refused());
	run_of(6)->count = UINT32_MAX;
	CHECK(refused());
	run_of(6)->offset += 2;
	CHECK_AS(refused(), "a text that is not aligned is refused");
	run_of(6)->offset -= 4;
	CHECK(refused());
	run_of(6)->type = IEC_DINT;
	CHECK_AS(refused(), "a run of numbers with room for a text is refused");
	run_of(255)->type = IEC_STRING + 1;
	CHECK(refused());
}

static void refuses_lengths(void)
{
	uint32_t offset = run_of(6)->offset;

	init_of(offset)->length = 9;
	CHECK_AS(refused(), "an initial text longer than its room is refused");
	init_of(offset)->length = UINT16_MAX;
	CHECK(refused());
}

/* No text is longer than its room. */
static bool texts_fit(const struct program *p)
{
	for (uint32_t i = 0; i < p->run_count; i++) {
		const struct code_run *run = &p->run[i];
		const struct iec_string *text = (const void *)(memory + run->offset);

		if (run->kind == RUN_INSTANCE || run->type != IEC_STRING)
			continue;
		if (run->count > 0 && (text->capacity != run->word ||
				       text->length > text->capacity))
			return false;
	}
	return true;
}

/* Runs the damaged image if it is accepted; false: a text left its room. */
static bool survives(void)
{
	enum diag_id why = DIAG_COUNT;
	struct arena scratch;
	struct program program;
	struct resource resource;
	size_t where;
	bool fits = true;

	arena_init(&scratch);
	if (header()->budget > 1000)
		header()->budget = 1000;
	seal();
	if (code_open(image, len, &scratch, &program, &why, &where) &&
	    image_memory_size(&program) <= 200000) {
		resource_init(&resource, &program, memory);
		resource_start(&resource);
		for (int i = 1; i < 4 && fits; i++) {
			resource_scan(&resource, i * RIG_PERIOD);
			fits = texts_fit(&program);
		}
	}
	arena_free(&scratch);
	fresh();
	return fits;
}

static void survives_bytes(void)
{
	static const uint8_t change[] = { 0x01, 0x04, 0x80, 0xff };
	bool fits = true;

	for (size_t at = offsetof(struct code_header, data_size); at < len && fits; at++)
		for (size_t i = 0; i < sizeof(change) && fits; i++) {
			image[at] ^= change[i];
			fits = survives();
		}
	CHECK_AS(fits,
		 "no text is longer than its room after any byte of the image changed");
}

int main(void)
{
	struct rig rig;

	if (!rig_open(&rig, source, false))
		return tap_done();
	good = ladder_image(rig.ladder, &len);
	image = malloc(len);
	memory = malloc(200008);
	if (!image || !memory)
		abort();
	fresh();
	CHECK(survives());
	refuses_rooms();
	refuses_lengths();
	survives_bytes();
	free(memory);
	free(image);
	rig_close(&rig);
	return tap_done();
}
