/* SPDX-License-Identifier: MIT
 *
 * fuzz_retain - reads any bytes as a file of retained values: once unchanged, once with
 * corrected checksums, so that changed records get past the first check.
 */
#include "engine/base/digest.h"
#include "engine/ladder.h"
#include "engine/scan/retain.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

static const char source[] =
	"RUNGBOARD 1\nVAR RETAIN\n  A : DINT;\n  B : BOOL;\n  T : TON;\n"
	"  M AT %MX1.1 : BOOL;\n  W AT %MW4 : WORD;\n  N : STRING[5];\nEND_VAR\n"
	"PROGRAM Main LD\nVAR RETAIN\n  A : REAL;\nEND_VAR\n"
	"RUNG\n  | NO I0 | TON T PT:=T#1s | COIL B |\nEND_PROGRAM\n";

struct rig {
	struct image image;
	struct arena arena;
	struct retain retain;
	void *memory;
	uint8_t *copy;
};

/* Built once: a rig only reads it. */
static const struct program *its_program(void)
{
	static struct ladder *ladder;

	if (ladder)
		return ladder_program(ladder);
	ladder = ladder_new();
	fuzz_expect(ladder && ladder_load_text(ladder, "r", source, sizeof(source) - 1) && ladder_build(ladder),
		    "the program builds");
	return ladder_program(ladder);
}

static void rig_open(struct rig *rig)
{
	const struct program *program = its_program();

	memset(rig, 0, sizeof(*rig));
	rig->memory = calloc(1, image_memory_size(program));
	image_init(&rig->image, program, rig->memory);
	arena_init(&rig->arena);
	fuzz_expect(retain_plan(&rig->retain, &rig->image, &rig->arena),
		    "it is planned");
	rig->copy = arena_alloc(&rig->arena, rig->retain.copy_size);
}

static void rig_close(struct rig *rig)
{
	arena_free(&rig->arena);
	free(rig->memory);
}

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	struct rig rig;
	uint32_t room;
	uint8_t *file;

	(void)bytes, (void)len;
	rig_open(&rig);
	room = retain_room(rig.retain.payload_size);
	*out_len = 2 * (size_t)room;
	file = calloc(2, room);
	for (uint32_t i = 0; i < 2; i++) {
		retain_copy(&rig.retain, &rig.image, rig.copy);
		retain_fill(&rig.retain, rig.copy, 5);
		memcpy(file + i * room, rig.retain.slot,
		       retain_seal(&rig.retain, i + 1, 0, room));
	}
	rig_close(&rig);
	return file;
}

static void make_good(uint8_t *file, size_t len, size_t at)
{
	struct retain_slot head;
	size_t covered;
	uint32_t crc;

	if (at > len || len - at < sizeof(head) + sizeof(crc))
		return;
	memcpy(&head, file + at, sizeof(head));
	covered = sizeof(head) + head.len;
	if (covered > len - at - sizeof(crc))
		return;
	crc = digest_crc32c(0, file + at, covered);
	memcpy(file + at + covered, &crc, sizeof(crc));
}

static void look(struct rig *rig, const uint8_t *file, size_t len)
{
	struct retain_record record;
	struct retain_found found;
	uint32_t at = RETAIN_HEAD;

	retain_find(file, len, &found);
	if (found.best < 0)
		return;
	fuzz_expect(found.state[found.best] == RETAIN_GOOD, "the best is good");
	fuzz_expect(found.payload >= file &&
		    found.payload + found.len <= file + len, "it is in the file");
	fuzz_expect(retain_clock(found.payload) >= 0, "a clock goes on");
	while (retain_next(found.payload, found.len, &at, &record))
		retain_take(&rig->retain, &record, rig->copy);
	fuzz_expect(at == found.len, "records fill the payload");
	retain_put(&rig->retain, &rig->image, rig->copy);
	retain_copy(&rig->retain, &rig->image, rig->copy);
	for (int i = 0; i < rig->retain.count; i++) {
		struct location where = rig->retain.var[i].at;

		fuzz_expect(where.type != IEC_STRING ||
			    (image_get(&rig->image, where).s->capacity == 5 &&
			     image_get(&rig->image, where).s->length <= 5),
			    "a text is in its room");
		fuzz_expect(where.type != IEC_BOOL ||
			    image_get(&rig->image, where).i < 2,
			    "a BOOL is 0 or 1");
	}
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	uint8_t *file = malloc(len + 1);
	struct rig rig;

	if (!file)
		return 0;
	rig_open(&rig);
	if (len)
		memcpy(file, bytes, len);
	look(&rig, file, len);
	make_good(file, len, 0);
	make_good(file, len, RETAIN_PAGE);
	look(&rig, file, len);
	rig_close(&rig);
	free(file);
	return 0;
}
