/* SPDX-License-Identifier: MIT
 *
 * draft - a small code image made by hand, which a test changes word by word before the
 * verifier sees it.
 */
#ifndef TESTS_UNIT_DRAFT_H
#define TESTS_UNIT_DRAFT_H

#include "engine/base/digest.h"
#include "engine/scan/code.h"
#include "tests/tap.h"
#include "tests/usual.h"

/* The parts of the image. Offsets count from the end of the areas. */
struct draft {
	struct code_header header;
	struct code_program entry[LIMIT_CALLS + 3];
	struct code_task task[3];
	uint32_t call[2], calls;
	struct code_run run[5];
	uint32_t init[9];
	struct code_bits bits[2];
	uint32_t text[128];
	uint32_t symbol[4];
	struct code_group group[3];
	struct code_power power[1];
	struct code_place place[2];
	char string[16];
	struct code_watched watched[1];
	uint32_t text_words, entries;
};

enum {
	FLAG = 8,       /* eight BOOLs                                       */
	NUMBER = 16,    /* two DINTs                                         */
	FIXED = 24,     /* a constant DINT                                   */
	COUNTER = 32,   /* two CTUs                                          */
};

/* Where each instruction of the draft begins. */
enum {
	AT_LUT = 0, AT_BITGET = 5, AT_BITPUT = 8, AT_COPY = 11, AT_CMP = 15,
	AT_PAIR = 20, AT_MATH = 25, AT_FN = 31, AT_FB = 38, AT_JMPC = 40, AT_JMP = 43,
	AT_END = 45, WORDS = 46,
};

static inline uint32_t own(uint32_t offset)
{
	return usual_areas()->size + offset;
}

static inline uint32_t own_as(enum iec_type type, uint32_t offset)
{
	return CODE_OPERAND(type, own(offset));
}

static inline uint32_t op(enum vm_op code, uint32_t n)
{
	return (uint32_t)code | n << 8;
}

/* Areas end at a multiple of 8, so that the runs above are aligned. */
static inline void draft_layout(struct draft *d)
{
	uint32_t size = word_row(FB_CTU)->size;

	d->run[0] = (struct code_run){ own(0), RUN_CONSTANTS, IEC_BOOL, 0, 2 };
	d->run[1] = (struct code_run){ own(FLAG), RUN_VALUES, IEC_BOOL, 0, 8 };
	d->run[2] = (struct code_run){ own(NUMBER), RUN_VALUES, IEC_DINT, 0, 2 };
	d->run[3] = (struct code_run){ own(FIXED), RUN_CONSTANTS, IEC_DINT, 0, 1 };
	d->run[4] = (struct code_run){ own(COUNTER), RUN_INSTANCE, 0, FB_CTU, 2 };
	d->header.data_size = own(COUNTER) + 2 * size;
	d->header.budget = 1000;
	memcpy(d->init, (uint32_t[]){ own(FLAG), 1, 1, own(NUMBER), 4, 77,
				      own(FIXED), 4, 5 }, sizeof(d->init));
	d->bits[0] = (struct code_bits){ AREA_I, 0, 2, own(FLAG) };
	d->bits[1] = (struct code_bits){ AREA_Q, 0, 2, own(FLAG + 2) };
}

static inline void draft_text(struct draft *d)
{
	uint32_t text[WORDS] = {
		op(VM_LUT, 1), own(FLAG), own(FLAG + 1), own(1),
		own(FLAG + 2) << 8 | 0x80,
		op(VM_BITGET, 7), usual_areas()->at[AREA_M], own(FLAG + 4),
		op(VM_BITPUT, 7), own(FLAG), usual_areas()->at[AREA_M],
		op(VM_COPY, 0), own(1), own_as(IEC_DINT, NUMBER),
		own_as(IEC_DINT, FIXED),
		op(VM_CMP, 0x77), own_as(IEC_DINT, NUMBER), own_as(IEC_DINT, FIXED),
		own(0), own(FLAG + 5),
		op(VM_CMP_DINT, 0xff), own(NUMBER), own(FIXED), own(FLAG), own(FLAG + 5),
		op(VM_DINT, MATH_DIV | MATH_ENABLED), own(FLAG), own(FLAG + 6),
		own(NUMBER), own(FIXED), own(NUMBER + 4),
		op(VM_FN, IEC_DINT | 2 << 8 | IEC_DINT << 16), FN_ADD, own(1), own(FLAG + 6),
		own_as(IEC_DINT, NUMBER), own_as(IEC_DINT, NUMBER + 4),
		own_as(IEC_DINT, FIXED),
		op(VM_FB, FB_CTU), own(COUNTER),
		op(VM_JMPC, 0), AT_END, own(FLAG),
		op(VM_JMP, 0), AT_END,
		op(VM_END, 0),
	};

	memcpy(d->text, text, sizeof(text));
	d->text_words = WORDS;
	d->entry[0] = (struct code_program){ .text_words = WORDS, .name = 11 };
	d->entries = 1;
}

static inline void draft_tasks(struct draft *d)
{
	d->task[0] = (struct code_task){
		.kind = TASK_INTERVAL, .interval = { 1000000 }, .count = 1,
		.watchdog = { 5000000 },
	};
	d->task[1] = (struct code_task){
		.kind = TASK_EVENT, .single = own(FLAG), .priority = 3,
		.first = 1,
	};
	d->task[2] = (struct code_task){ .kind = TASK_CYCLE, .priority = 3,
					 .first = 1 };
	d->calls = 1;
}

static inline void draft_maps(struct draft *d)
{
	uint32_t bit = (usual_areas()->at[AREA_M] * 8) + 3;

	memcpy(d->string, "Flag\0N\0C\0B\0Main", 16);
	d->symbol[0] = own_as(IEC_BOOL, FLAG);
	d->symbol[1] = own_as(IEC_DINT, NUMBER);
	d->symbol[2] = own_as(IEC_NONE, COUNTER);
	d->symbol[3] = CODE_OPERAND(IEC_BOOL | SYMBOL_BIT, bit);
	d->group[0] = (struct code_group){ 0, 0, 0 };
	d->group[1] = (struct code_group){ 1, 1, SYMBOL_CONSTANT };
	d->group[2] = (struct code_group){ 2, 0, SYMBOL_RETAIN };
	d->power[0] = (struct code_power){ 0, 1, 1, 0, 1, own(1), own(FLAG) };
	d->place[0] = (struct code_place){ AT_LUT, 0, 1, 1, 1 };
	d->place[1] = (struct code_place){ AT_FN, 0, 2, 1, 1 };
	d->watched[0] = (struct code_watched){ 0, 7, own(FLAG), own(FLAG + 4), 4 };
}

static inline void draft_good(struct draft *d)
{
	memset(d, 0, sizeof(*d));
	memcpy(d->header.magic, CODE_MAGIC, sizeof(d->header.magic));
	d->header.version = CODE_VERSION;
	d->header.words = WORD_COUNT;
	memcpy(d->header.area_bytes, usual_areas()->bytes,
	       sizeof(usual_areas()->bytes));
	draft_layout(d);
	draft_text(d);
	draft_tasks(d);
	draft_maps(d);
}

static inline void add(uint8_t *bytes, uint32_t *len, int kind, const void *from,
		uint32_t size)
{
	struct code_header *header = (void *)bytes;

	header->section[kind] = (struct code_section){ *len, size };
	memcpy(bytes + *len, from, size);
	*len += (size + 3) / 4 * 4;
}

static inline void seal(uint8_t *bytes, uint32_t len)
{
	struct code_header *header = (void *)bytes;
	size_t covered = offsetof(struct code_header, crc) + 4;

	header->size = len;
	header->crc = digest_crc32c(0, bytes + covered, len - covered);
}

static inline uint32_t pack(const struct draft *d, uint8_t *bytes)
{
	uint32_t len = sizeof(d->header);

	memcpy(bytes, &d->header, sizeof(d->header));
	add(bytes, &len, CODE_PROGRAMS, d->entry,
	    d->entries * (uint32_t)sizeof(d->entry[0]));
	add(bytes, &len, CODE_TASKS, d->task, sizeof(d->task));
	add(bytes, &len, CODE_CALLS, d->call, d->calls * 4);
	add(bytes, &len, CODE_LAYOUT, d->run, sizeof(d->run));
	add(bytes, &len, CODE_INIT, d->init, sizeof(d->init));
	add(bytes, &len, CODE_BITS, d->bits, sizeof(d->bits));
	add(bytes, &len, CODE_TEXT, d->text, d->text_words * 4);
	add(bytes, &len, CODE_WATCH, d->text, 0);
	add(bytes, &len, CODE_SYMBOLS, d->symbol, sizeof(d->symbol));
	add(bytes, &len, CODE_GROUPS, d->group, sizeof(d->group));
	add(bytes, &len, CODE_POWER, d->power, sizeof(d->power));
	add(bytes, &len, CODE_PLACES, d->place, sizeof(d->place));
	add(bytes, &len, CODE_STRINGS, d->string, sizeof(d->string));
	add(bytes, &len, CODE_WATCHED, d->watched, sizeof(d->watched));
	seal(bytes, len);
	return len;
}

static inline enum diag_id judge_bytes(const void *bytes, uint32_t len)
{
	struct program program;
	struct arena scratch;
	enum diag_id why = DIAG_COUNT;
	size_t where;
	bool good;

	arena_init(&scratch);
	good = code_open(bytes, len, &scratch, &program, &why, &where);
	arena_free(&scratch);
	return good ? DIAG_COUNT : why;
}

static inline enum diag_id judge(const struct draft *d)
{
	uint64_t room[512];

	return judge_bytes(room, pack(d, (uint8_t *)room));
}

/* The good draft with @change made to it. */
#define REFUSED(change) do { \
	struct draft d; \
	draft_good(&d); \
	change; \
	CHECK_AS(judge(&d) == DIAG_IMAGE_REFUSED, #change); \
} while (0)

#endif
