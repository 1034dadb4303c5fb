/* SPDX-License-Identifier: MIT
 *
 * fuzz_record - reads any bytes as the record of a board and plays it: once unchanged, once
 * with a corrected checksum, so that changed records get past the first check.
 */
#include "engine/base/digest.h"
#include "engine/ladder.h"
#include "engine/scan/recorder.h"
#include "engine/trial/record_file.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

#define RING (256u << 10)

static const char source[] =
	"RUNGBOARD 1\nVAR\n  A : DINT;\n  B : BOOL;\n  T : TON;\n  In AT %IX0.0 : BOOL;\n"
	"  N : STRING[5];\n  L : ARRAY[1..3] OF REAL;\n  F : FIFO;\nEND_VAR\n"
	"VAR CONSTANT\n  K : INT := 7;\nEND_VAR\n"
	"CONFIGURATION C\n  AREA M 8;\n  AREA V 8;\n  AREA I 8;\n  AREA Q 8;\n  AREA AI 8;\n"
	"  TASK Fast (INTERVAL := T#10ms, PRIORITY := 1);\n"
	"  TASK Slow (INTERVAL := T#30ms, PRIORITY := 2);\n"
	"  PROGRAM P1 WITH Fast : Main;\n  PROGRAM P2 WITH Slow : Other;\nEND_CONFIGURATION\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO In | TON T PT:=T#1s | COIL B |\nEND_PROGRAM\n"
	"PROGRAM Other LD\nRUNG\n  | NO In | FIFO F IN:=A SIZE:=4 |\n"
	"RUNG\n  | NO B | ADD IN1:=A IN2:=K OUT=>A |\nEND_PROGRAM\n";

static void act(struct recorder *recorder, struct resource *resource, const char *name,
		enum record_kind kind)
{
	const struct location at = image_find(&resource->image, name, strlen(name));
	const union iec_value value = { .i = 1 };

	recorder_change(recorder, resource, kind, at, value);
	if (kind == RECORD_FORCE)
		image_force(&resource->image, at, value);
	else if (kind == RECORD_WRITE)
		image_set(&resource->image, at, value);
	else
		image_unforce(&resource->image, at);
	recorder_changed(recorder, resource);
}

/* Every third scan another value is bad. */
static int scans;

static uint64_t quality_serial(void *context)
{
	(void)context;
	return (uint64_t)(scans / 3 % 4);
}

static void each_bad(void *context, struct recorder *recorder)
{
	const uint32_t *at = context;

	recorder_bad(recorder, 8 * at[AREA_I] + (uint32_t)scans % 8, 3, scans % 2);
	recorder_bad(recorder, 8 * at[AREA_AI], 16, false);
}

static void play(struct recorder *recorder, struct resource *resource)
{
	const struct program *program = resource->image.program;
	uint8_t identity[32];

	code_identity(program, identity);
	recorder_tell_quality(recorder, &(struct recorder_quality){ quality_serial, each_bad,
								    (void *)(uintptr_t)program->areas.at });
	resource_start(resource);
	recorder_begin(recorder, resource, identity, RECORD_START);
	for (int i = 1; i < 40; i++) {
		scans = i;
		image_area(&resource->image, AREA_I)[0] = (uint8_t)(i / 5);
		recorder_scan(recorder, resource, i * INT64_C(10000000));
		resource_scan(resource, i * INT64_C(10000000));
		recorder_scanned(recorder, resource);
		if (i == 3)
			act(recorder, resource, "A", RECORD_WRITE);
		if (i == 5)
			act(recorder, resource, "B", RECORD_FORCE);
		if (i == 7)
			recorder_begin(recorder, resource, identity, RECORD_NEXT);
		if (i == 9)
			act(recorder, resource, "B", RECORD_UNFORCE);
	}
	resource_fail(resource, FAULT_IO);
	recorder_failed(recorder, resource);
}

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	struct record_parts parts = { .board = "bench" };
	struct ladder *ladder = ladder_new();
	struct recorder recorder;
	struct resource resource;
	struct sink_memory memory;
	struct sink sink;
	size_t image_len;
	uint8_t *ring = calloc(1, RECORDER_BESIDE + RING), *file;
	void *data;

	(void)bytes, (void)len;
	fuzz_expect(ring && ladder && ladder_load_text(ladder, "r", source, sizeof(source) - 1) &&
		    ladder_build(ladder), "the program builds");
	data = calloc(1, image_memory_size(ladder_program(ladder)));
	resource_init(&resource, ladder_program(ladder), data);
	recorder_init(&recorder, ring, RING);
	play(&recorder, &resource);
	parts.log = recorder.ring;
	parts.len = (size_t)recorder.head;
	fuzz_expect(record_programs(&parts) && parts.program_count == 1, "one program is named");
	parts.program[0].image = ladder_image(ladder, &image_len);
	parts.program[0].len = (uint32_t)image_len;
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	fuzz_expect(record_write(&parts, &sink), "the file is written");
	*out_len = memory.len;
	file = malloc(memory.len);
	memcpy(file, memory.text, memory.len);
	sink_memory_free(&memory);
	free(ring);
	free(data);
	ladder_free(ladder);
	return file;
}

static void read_and_play(const uint8_t *bytes, size_t len)
{
	enum diag_id why;
	size_t where;
	struct record_file *file = record_file_open(bytes, len, &why, &where);
	struct playback playback;

	if (!file) {
		fuzz_expect(where <= len, "the place of an error is in the file");
		return;
	}
	if (playback_init(&playback, file)) {
		for (int i = 0; i < 200 && playback_next(&playback); i++)
			record_quality_of(playback.bad, playback.bad_len, playback.twin.resource.image.program,
					  image_find(&playback.twin.resource.image, "In", 2));
		playback_seek(&playback, record_file_first(file));
	}
	playback_free(&playback);
	record_file_free(file);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	uint8_t *copy;
	uint32_t crc;

	read_and_play(bytes, len);
	if (len < 4)
		return 0;
	copy = malloc(len);
	memcpy(copy, bytes, len);
	crc = digest_crc32c(0, copy, len - 4);
	for (int i = 0; i < 4; i++)
		copy[len - 4 + (size_t)i] = (uint8_t)(crc >> 8 * i);
	read_and_play(copy, len);
	free(copy);
	return 0;
}
