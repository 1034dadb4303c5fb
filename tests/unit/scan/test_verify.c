/* SPDX-License-Identifier: MIT
 *
 * test_verify - the image of draft.h with one wrong word at a time: the verifier
 * refuses each. The name of a failed check is the accepted change.
 */
#include "tests/unit/draft.h"

#include <stdlib.h>

static void test_good(void)
{
	struct draft d;

	draft_good(&d);
	CHECK_AS(judge(&d) == DIAG_COUNT, "the unchanged image is accepted");
	d.text[AT_COPY] = op(VM_COPY, 4);
	d.text[AT_MATH] = op(VM_DINT, MATH_MUL);
	d.text[AT_MATH + 1] = own(1);
	CHECK_AS(judge(&d) == DIAG_COUNT,
		 "a COPY with a width and a DINT product without an enable are accepted");
	d.text[AT_MATH] = op(VM_DINT, MATH_MOD | MATH_LEFT);
	CHECK_AS(judge(&d) == DIAG_COUNT, "a remainder that may leave the left value is accepted");
	d.place[1].text = WORDS - 1;
	CHECK_AS(judge(&d) == DIAG_COUNT, "a place at the last word is accepted");
	d.text_words = d.entry[0].text_words = AT_END;
	d.text[AT_JMPC + 1] = d.text[AT_JMP + 1] = AT_LUT;
	d.place[1].text = AT_LUT;
	CHECK_AS(judge(&d) == DIAG_COUNT,
		 "a program that ends with a jump back is accepted");
}

static void test_layout(void)
{
	REFUSED(d.run[2].offset = own(FLAG));
	REFUSED(d.run[2].count = 3); /* over the constant */
	REFUSED(d.run[2].offset = own(NUMBER) + 2);
	REFUSED(d.run[4].offset = own(COUNTER) + 4);
	REFUSED(d.run[0].type = IEC_BYTE);
	REFUSED(d.run[0].kind = RUN_VALUES);
	REFUSED(d.run[0].count = 1);
	REFUSED(d.run[1].kind = 3);
	REFUSED(d.run[1].type = IEC_NONE);
	REFUSED(d.run[1].type = IEC_TYPE_COUNT);
	REFUSED(d.run[4].word = FN_ADD);
	REFUSED(d.run[4].word = WORD_COUNT);
	REFUSED(d.run[4].count = 3);
	REFUSED(d.run[4].count = UINT32_MAX);
	REFUSED(d.header.data_size--);
	REFUSED(d.header.data_size = own(1));
	REFUSED(d.header.data_size = LIMIT_DATA + 1);
	REFUSED(d.header.retain_offset = d.header.data_size + 1);
	REFUSED(d.header.retain_size = d.header.data_size + 1);
	REFUSED(d.header.budget = LIMIT_BUDGET + 1);
}

/* A wrong header: sizes that do not match, or impossible values. */
static void test_areas(void)
{
	uint32_t last = usual_areas()->size - 4;
	struct draft whole;

	for (int area = AREA_NONE; area < CODE_AREAS; area++) {
		REFUSED(d.header.area_bytes[area] += 8);
		REFUSED(d.header.area_bytes[area] -= 8);
		REFUSED(d.header.area_bytes[area] = LIMIT_MEMORY + 1);
		REFUSED(d.header.area_bytes[area] = UINT32_MAX);
		REFUSED(d.header.area_bytes[area] = UINT32_MAX - 7);
	}
	REFUSED(memset(d.header.area_bytes, 0, sizeof(d.header.area_bytes)));
	REFUSED(d.header.area_bytes[AREA_NONE] = 1);
	REFUSED(d.header.area_bytes[AREA_COUNT] = 1);
	REFUSED(d.header.area_bytes[AREA_SM] = 63);
	REFUSED(d.header.area_bytes[AREA_M] = d.header.area_bytes[AREA_V] = LIMIT_MEMORY);
	/* The byte after the last one is outside, even if no other data follows. */
	draft_good(&whole);
	whole.text[AT_COPY + 2] = CODE_OPERAND(IEC_DINT, last);
	CHECK_AS(judge(&whole) == DIAG_COUNT,
		 "a COPY into the last word of the last area is accepted");
	REFUSED(d.text[AT_COPY + 2] = CODE_OPERAND(IEC_DINT, last);
		d.header.area_bytes[AREA_XAQ]--);
	draft_good(&whole);
	whole.header.area_bytes[AREA_XAQ]--;
	CHECK_AS(judge(&whole) == DIAG_COUNT,
		 "a smaller last area is accepted if nothing uses the byte");
	REFUSED(d.text[AT_BITPUT + 2] = last + 3; d.header.area_bytes[AREA_XAQ]--);
	REFUSED(d.symbol[3] = CODE_OPERAND(IEC_BOOL | SYMBOL_BIT, (last + 3) * 8);
		d.header.area_bytes[AREA_XAQ]--);
	REFUSED(d.init[0] = last + 3; d.header.area_bytes[AREA_XAQ]--);
	/* Across the end of an area into the next one, both writable. */
	REFUSED(d.text[AT_COPY + 2] =
		CODE_OPERAND(IEC_DINT, usual_areas()->at[AREA_V] - 2));
	REFUSED(d.bits[1].first = 511 * 8 + 6; d.header.area_bytes[AREA_Q]--);
}

static void test_init(void)
{
	REFUSED(d.init[2] = 2);
	REFUSED(d.init[2] = 3);
	REFUSED(d.init[0] = own(FLAG + 7); d.init[1] = 2; d.init[2] = 0);
	REFUSED(d.init[3] = own(NUMBER) + 1);
	REFUSED(d.init[3] = own(2));
	REFUSED(d.init[4] = 3);
	REFUSED(d.init[6] = d.header.data_size);
	REFUSED(d.init[7] = 400);
	REFUSED(d.init[7] = UINT32_MAX);
	REFUSED(d.init[6] = own(COUNTER) + word_row(FB_CTU)->size - 1);
}

static void test_bits(void)
{
	REFUSED(d.bits[0].area = AREA_NONE);
	REFUSED(d.bits[1].area = AREA_COUNT);
	REFUSED(d.bits[1].area = AREA_I);
	REFUSED(d.bits[0].area = AREA_M);
	REFUSED(d.bits[1].first = usual_areas()->bytes[AREA_Q] * 8u - 1);
	REFUSED(d.bits[1].first = UINT32_MAX);
	REFUSED(d.bits[1].slot = own(0));
	REFUSED(d.bits[1].slot = own(NUMBER));
	REFUSED(d.bits[1].slot = own(FLAG + 7));
	REFUSED(d.bits[1].slot = d.header.data_size);
	REFUSED(d.bits[1].count = 7);
}

static void test_operands(void)
{
	uint32_t input = usual_areas()->at[AREA_I];

	REFUSED(d.text[AT_LUT] = op(VM_LUT, 0));
	REFUSED(d.text[AT_LUT + 1] = own(NUMBER));
	REFUSED(d.text[AT_LUT + 2] = own(2));
	REFUSED(d.text[AT_LUT + 3] = d.header.data_size);
	REFUSED(d.text[AT_LUT + 4] = own(1) << 8 | 0x80);
	REFUSED(d.text[AT_LUT + 4] = own(NUMBER) << 8 | 0x80);
	REFUSED(d.text[AT_BITGET] = op(VM_BITGET, 8));
	REFUSED(d.text[AT_BITGET + 1] = own(FLAG));
	REFUSED(d.text[AT_BITGET + 2] = own(0));
	REFUSED(d.text[AT_BITPUT] = op(VM_BITPUT, 8));
	REFUSED(d.text[AT_BITPUT + 1] = own(NUMBER));
	REFUSED(d.text[AT_BITPUT + 2] = input);
	REFUSED(d.text[AT_COPY] = op(VM_COPY, 1));
	REFUSED(d.text[AT_COPY] = op(VM_COPY, 8));
	REFUSED(d.text[AT_COPY] = op(VM_COPY, 4);
		d.text[AT_COPY + 3] = CODE_OPERAND(IEC_INT, input));
	REFUSED(d.text[AT_COPY + 1] = own(NUMBER));
	REFUSED(d.text[AT_COPY + 2] = own_as(IEC_DINT, FIXED));
	REFUSED(d.text[AT_COPY + 2] = CODE_OPERAND(IEC_DINT, input));
	REFUSED(d.text[AT_COPY + 2] = CODE_OPERAND(IEC_INT, usual_areas()->at[AREA_M]));
	REFUSED(d.text[AT_COPY + 2] = own_as(IEC_INT, NUMBER));
	REFUSED(d.text[AT_COPY + 3] = own_as(IEC_DINT, FLAG));
	REFUSED(d.text[AT_COPY + 3] = own_as(IEC_TYPE_COUNT, FIXED));
	/* Across the end of an area, and of memory. */
	REFUSED(d.text[AT_COPY + 2] = CODE_OPERAND(IEC_DINT, usual_areas()->size - 3));
	REFUSED(d.text[AT_COPY + 3] = CODE_OPERAND(IEC_DINT, d.header.data_size - 2));
}

static void test_pairs(void)
{
	REFUSED(d.text[AT_CMP] = op(VM_CMP, 0x100));
	REFUSED(d.text[AT_CMP] = op(VM_CMP_DINT, 0x77));
	REFUSED(d.text[AT_CMP + 1] = own_as(IEC_INT, NUMBER));
	REFUSED(d.text[AT_CMP + 2] = own_as(IEC_NONE, FIXED));
	REFUSED(d.text[AT_CMP + 2] = own_as(IEC_STRING, FIXED));
	REFUSED(d.text[AT_CMP + 3] = own(NUMBER));
	REFUSED(d.text[AT_CMP + 4] = own(1));
	REFUSED(d.text[AT_PAIR] = op(VM_CMP_DINT, 0x100));
	REFUSED(d.text[AT_PAIR] = op(VM_CMP_REAL, 0xff));
	REFUSED(d.text[AT_PAIR] = op(VM_CMP_INT, 0xff));
	REFUSED(d.text[AT_PAIR] = op(VM_CMP, 0xff));
	REFUSED(d.text[AT_PAIR + 1] = own_as(IEC_DINT, NUMBER));
	REFUSED(d.text[AT_PAIR + 2] = own(FLAG));
	REFUSED(d.text[AT_PAIR + 3] = own(NUMBER));
	REFUSED(d.text[AT_PAIR + 4] = own(1));
	REFUSED(d.text[AT_PAIR + 4] = UINT32_MAX);
	REFUSED(d.text[AT_MATH] = op(VM_DINT, MATH_ENABLED | MATH_LEFT));
	REFUSED(d.text[AT_MATH] = op(VM_DINT, MATH_ENABLED | MATH_COUNT));
	REFUSED(d.text[AT_MATH] = op(VM_DINT, MATH_DIV | MATH_LIKELY));
	REFUSED(d.text[AT_MATH] = op(VM_DINT, MATH_ENABLED | MATH_LEFT | MATH_LIKELY));
	REFUSED(d.text[AT_MATH] = op(VM_DINT, MATH_LEFT | MATH_LIKELY); d.text[AT_MATH + 1] = own(1));
	REFUSED(d.text[AT_MATH] = op(VM_DINT, MATH_DIV | MATH_LEFT));
	REFUSED(d.text[AT_MATH] = op(VM_DINT, 2 * MATH_LEFT); d.text[AT_MATH + 1] = own(1));
	REFUSED(d.text[AT_MATH] = op(VM_DINT, MATH_MOD | MATH_LEFT | 1u << 20);
		d.text[AT_MATH + 1] = own(1));
	REFUSED(d.text[AT_MATH] = op(VM_DINT, MATH_DIV));
	REFUSED(d.text[AT_MATH] = op(VM_DINT, MATH_DIV); d.text[AT_MATH + 1] = own(0));
	REFUSED(d.text[AT_MATH] = op(VM_REAL, MATH_ENABLED));
	REFUSED(d.text[AT_MATH + 1] = own(NUMBER));
	REFUSED(d.text[AT_MATH + 2] = own(0));
	REFUSED(d.text[AT_MATH + 3] = own(FIXED));
	REFUSED(d.text[AT_MATH + 4] = own(FLAG));
	REFUSED(d.text[AT_MATH + 5] = own_as(IEC_DINT, NUMBER));
	REFUSED(d.text[AT_MATH + 5] = d.header.data_size);
}

static void test_calls(void)
{
	uint32_t size = word_row(FB_CTU)->size;

	REFUSED(d.text[AT_FN] = op(VM_FN, IEC_DINT | 1 << 8 | IEC_DINT << 16));
	REFUSED(d.text[AT_FN] = op(VM_FN, IEC_BOOL | 2 << 8 | IEC_BOOL << 16));
	REFUSED(d.text[AT_FN] = op(VM_FN, IEC_INT | 2 << 8 | IEC_INT << 16));
	REFUSED(d.text[AT_FN] = op(VM_FN, IEC_DINT | 2 << 8 | IEC_INT << 16));
	REFUSED(d.text[AT_FN] = op(VM_FN, IEC_DINT | 2 << 8));
	REFUSED(d.text[AT_FN] = op(VM_FN, IEC_TYPE_COUNT | 2 << 8 | IEC_TYPE_COUNT << 16));
	REFUSED(d.text[AT_FN + 1] = FB_CTU);
	REFUSED(d.text[AT_FN + 1] = WORD_COUNT);
	REFUSED(d.text[AT_FN + 1] = FN_MOVE);
	REFUSED(d.text[AT_FN + 2] = own(NUMBER));
	REFUSED(d.text[AT_FN + 3] = own(1));
	REFUSED(d.text[AT_FN + 4] = own_as(IEC_DINT, FIXED));
	REFUSED(d.text[AT_FN + 5] = own_as(IEC_BOOL, FLAG));
	REFUSED(d.text[AT_FB] = op(VM_FB, FB_CTD));
	REFUSED(d.text[AT_FB] = op(VM_FB, WORD_COUNT));
	REFUSED(d.text[AT_FB + 1] = own(COUNTER) + 1);
	REFUSED(d.text[AT_FB + 1] = own(COUNTER) - size);
	REFUSED(d.run[4].count = 1; d.text[AT_FB + 1] = own(COUNTER) + size);
	REFUSED(d.text[AT_FB + 1] = own(COUNTER) + 2 * size);
	REFUSED(d.text[AT_FB + 1] = own(FLAG));
}

/* SWITCH with two targets in place of the two jumps at the end. */
static void choose(struct draft *d, uint32_t n, uint32_t first, uint32_t second)
{
	const uint32_t code[] = { op(VM_SWITCH, n), own_as(IEC_DINT, NUMBER), (uint32_t)-1, first, second };

	memcpy(d->text + AT_JMPC, code, sizeof(code));
}

static void test_choices(void)
{
	struct draft with;

	draft_good(&with);
	choose(&with, 2, AT_END, AT_END);
	CHECK_AS(judge(&with) == DIAG_COUNT, "a SWITCH with targets further down is accepted");
	with.text[AT_JMPC + 2] = 0x80000000;
	CHECK_AS(judge(&with) == DIAG_COUNT, "its first number may be any");
	REFUSED(choose(&d, 2, AT_END, AT_FB));
	REFUSED(choose(&d, 2, AT_JMPC, AT_END));
	REFUSED(choose(&d, 2, AT_END - 1, AT_END));
	REFUSED(choose(&d, 2, AT_END, WORDS));
	REFUSED(choose(&d, 2, UINT32_MAX, AT_END));
	REFUSED(choose(&d, 1, AT_END, AT_END));
	REFUSED(choose(&d, 3, AT_END, AT_END));
	REFUSED(choose(&d, 0xffffff, AT_END, AT_END));
	REFUSED(choose(&d, 2, AT_END, AT_END); d.text[AT_JMPC + 1] = own(NUMBER));
	REFUSED(choose(&d, 2, AT_END, AT_END); d.text[AT_JMPC + 1] = own_as(IEC_REAL, NUMBER));
	REFUSED(choose(&d, 2, AT_END, AT_END); d.text[AT_JMPC + 1] = own_as(IEC_BOOL, FLAG));
	REFUSED(choose(&d, 2, AT_END, AT_END); d.text[AT_JMPC + 1] = own_as(IEC_DINT, NUMBER + 2));
	REFUSED(choose(&d, 2, AT_END, AT_END); d.text[AT_JMPC + 1] = CODE_OPERAND(IEC_DINT, 0xffff00));
}

static void test_flow(void)
{
	REFUSED(d.text[AT_JMPC + 1] = AT_LUT + 1);
	REFUSED(d.text[AT_JMPC + 1] = WORDS);
	REFUSED(d.text[AT_JMPC + 2] = own(NUMBER));
	REFUSED(d.text[AT_JMP + 1] = AT_END - 1);
	REFUSED(d.text[AT_JMP + 1] = UINT32_MAX);
	REFUSED(d.text[AT_JMP] = op(VM_JMP, 1));
	REFUSED(d.text[AT_END] = op(VM_END, 1));
	REFUSED(d.text[AT_END] = op(VM_COUNT, 0));
	REFUSED(d.text[AT_END] = op(VM_FB, FB_CTU));
	REFUSED(d.text[AT_END] = op(VM_LUT, 1));
	REFUSED(d.text[AT_LUT] = op(VM_LUT, 0xffffff));
	/* A jump without a target operand; the word behind it could be one. */
	REFUSED(d.text[AT_END] = op(VM_JMP, 0); d.symbol[0] = AT_BITPUT);
	/* Programs that run out of their end: after a block, a copy, a conditional
	 * jump. */
	REFUSED(d.entry[0].text_words = AT_FN;
		d.place[1].text = 0);
	REFUSED(d.text_words = d.entry[0].text_words = AT_JMPC;
		d.place[1].text = 0);
	REFUSED(d.text_words = d.entry[0].text_words = AT_JMP;
		d.text[AT_JMPC + 1] = 0; d.place[1].text = 0);
	REFUSED(d.entry[0].text_words = 0);
	REFUSED(d.entry[0].text_words = WORDS + 1);
	REFUSED(d.entry[0].text = WORDS + 1);
	REFUSED(d.entry[0].watch_words = 1);
	REFUSED(d.entry[0].name = sizeof(d.string));
}

static void test_maps(void)
{
	REFUSED(d.string[sizeof(d.string) - 1] = 'x');
	REFUSED(memcpy(d.string, "Flag-N-C-B-Main", 15));
	REFUSED(d.symbol[0] = own_as(IEC_BOOL, NUMBER));
	REFUSED(d.symbol[1] = own_as(IEC_TYPE_COUNT, NUMBER));
	REFUSED(d.symbol[1] = own_as(IEC_DINT, FLAG));
	REFUSED(d.symbol[2] = own_as(IEC_NONE, NUMBER));
	REFUSED(d.symbol[2]++);
	REFUSED(d.symbol[3] = CODE_OPERAND(IEC_DINT | SYMBOL_BIT, 3));
	REFUSED(d.symbol[3] = CODE_OPERAND(IEC_BOOL | SYMBOL_BIT,
					   usual_areas()->size * 8));
	REFUSED(d.group[0].first = 1);
	REFUSED(d.group[1].first = 0);
	REFUSED(d.group[2].first = 1);
	REFUSED(d.group[2].first = 4);
	REFUSED(d.group[1].pou = 2);
	REFUSED(d.group[1].flags = SYMBOL_HIDDEN);
	REFUSED(d.power[0].in = own(NUMBER));
	REFUSED(d.power[0].out = d.header.data_size);
	REFUSED(d.place[1].text = WORDS);
	REFUSED(d.place[1].pou = 1);
	REFUSED(d.watched[0].pou = 1);
	REFUSED(d.watched[0].name = sizeof(d.string));
	REFUSED(d.watched[0].to = d.header.data_size);
	REFUSED(d.watched[0].size = UINT32_MAX);
}

static void test_header(void)
{
	struct draft d;
	uint64_t room[512];
	struct code_header *header = (void *)room;
	uint32_t len;

	draft_good(&d);
	len = pack(&d, (uint8_t *)room);
	CHECK(judge_bytes(room, len) == DIAG_COUNT);
	CHECK(judge_bytes(room, len - 4) == DIAG_IMAGE_DAMAGED);
	CHECK(judge_bytes(room, sizeof(*header) - 1) == DIAG_IMAGE_DAMAGED);
	CHECK(judge_bytes(room, 7) == DIAG_IMAGE_MAGIC);
	header->version++;
	CHECK(judge_bytes(room, len) == DIAG_IMAGE_VERSION);
	header->version--;
	((uint8_t *)room)[len - 1] ^= 1;
	CHECK_AS(judge_bytes(room, len) == DIAG_IMAGE_DAMAGED,
		 "the checksum finds one changed bit in the last byte");
	for (int kind = 1; kind < CODE_SECTION_COUNT; kind++) {
		len = pack(&d, (uint8_t *)room);
		header->section[kind].offset = len + 4;
		seal((uint8_t *)room, len);
		CHECK_AS(judge_bytes(room, len) == DIAG_IMAGE_DAMAGED,
			 "a section beyond the end is found");
		len = pack(&d, (uint8_t *)room);
		header->section[kind].size = len;
		seal((uint8_t *)room, len);
		CHECK_AS(judge_bytes(room, len) == DIAG_IMAGE_DAMAGED,
			 "a section that is too long is found");
		len = pack(&d, (uint8_t *)room);
		header->section[kind].offset = 0;
		seal((uint8_t *)room, len);
		CHECK_AS(judge_bytes(room, len) == DIAG_IMAGE_DAMAGED,
			 "a section that overlaps the header is found");
	}
}

static void test_tasks(void)
{
	struct draft good;

	draft_good(&good);
	good.task[1].single = CODE_OPERAND(7, usual_areas()->at[AREA_I]);
	CHECK_AS(judge(&good) == DIAG_COUNT,
		 "a task with a bit of an area as its event is accepted");
	REFUSED(d.task[0].kind = 3);
	REFUSED(d.task[0].interval[0] = 99999);
	REFUSED(d.task[0].interval[0] = 0);
	REFUSED(d.task[0].interval[1] = 20117); /* longer than a day */
	REFUSED(d.task[0].interval[1] = UINT32_MAX);
	REFUSED(d.task[1].interval[0] = 1000000);
	REFUSED(d.task[2].interval[1] = 1);
	REFUSED(d.task[0].watchdog[0] = 1);
	REFUSED(d.task[2].watchdog[1] = UINT32_MAX);
	REFUSED(d.task[0].first = 3);
	REFUSED(d.task[0].count = 3);
	REFUSED(d.task[1].count = UINT32_MAX);
	REFUSED(d.task[0].name = 16);
	REFUSED(d.task[1].single = own(NUMBER));
	REFUSED(d.task[1].single = CODE_OPERAND(1, own(FLAG)));
	REFUSED(d.task[1].single = CODE_OPERAND(8, 0));
	REFUSED(d.task[1].single = CODE_OFFSET(d.header.data_size));
	REFUSED(d.task[0].priority = 4);
	REFUSED(d.calls = 2);
	REFUSED(d.call[0] = 1);
	REFUSED(d.call[0] = UINT32_MAX);
}

/* ---- BLOCK and CALL ---- */

/* Adds a program that is called, with these words and END. */
static void append(struct draft *d, const uint32_t *words, uint32_t count)
{
	struct code_program *entry = &d->entry[d->entries++];

	*entry = (struct code_program){ .text = d->text_words,
					.text_words = count + 1, .name = 11 };
	for (uint32_t i = 0; i < count; i++)
		d->text[d->text_words++] = words[i];
	d->text[d->text_words++] = op(VM_END, 0);
}

static void append_block(struct draft *d, uint32_t to, uint32_t from, uint32_t size)
{
	append(d, (uint32_t[]){ op(VM_BLOCK, 0), to, from, size }, 4);
}

static void append_call(struct draft *d, uint32_t entry)
{
	append(d, (uint32_t[]){ op(VM_CALL, 0), entry }, 2);
}

#define ALLOWED(change) do { \
	struct draft d; \
	draft_good(&d); \
	change; \
	CHECK_AS(judge(&d) == DIAG_COUNT, #change); \
} while (0)

static void test_blocks(void)
{
	uint32_t size = word_row(FB_CTU)->size;

	ALLOWED(append_block(&d, own(NUMBER), own(NUMBER) + 4, 4));
	ALLOWED(append_block(&d, own(FLAG), own(FLAG) + 4, 4));
	ALLOWED(append_block(&d, own(COUNTER), own(COUNTER) + size, size));
	/* Size 0, overlap, out of range. */
	REFUSED(append_block(&d, own(NUMBER), own(NUMBER) + 4, 0));
	REFUSED(append_block(&d, own(FLAG), own(FLAG) + 3, 4));
	REFUSED(append_block(&d, own(FLAG), own(FLAG) + 4, UINT32_MAX));
	REFUSED(append_block(&d, UINT32_MAX, own(FLAG), 4));
	REFUSED(append_block(&d, own(COUNTER), own(COUNTER) + size, size + 1));
	/* Parts of values, other types, a constant, TRUE and FALSE, areas. */
	REFUSED(append_block(&d, own(NUMBER), own(NUMBER) + 4, 2));
	REFUSED(append_block(&d, own(NUMBER) + 2, own(NUMBER) + 6, 2));
	REFUSED(append_block(&d, own(FLAG), own(NUMBER), 4));
	REFUSED(append_block(&d, own(NUMBER), own(FIXED), 4));
	REFUSED(append_block(&d, own(0), own(1), 1));
	REFUSED(append_block(&d, usual_areas()->at[AREA_M],
			     usual_areas()->at[AREA_M] + 8, 4));
	/* Half an instance, another block, no instance at the other side. */
	REFUSED(append_block(&d, own(COUNTER), own(COUNTER) + size, 4));
	REFUSED(append_block(&d, own(COUNTER) + 1, own(COUNTER) + size + 1,
			     size - 1));
	REFUSED(append_block(&d, own(NUMBER), own(NUMBER) + 4, 4);
		d.text[WORDS] = op(VM_BLOCK, 1));
}

/* TON, TOF and TP have the same marks but other contents. */
static void test_other_blocks(void)
{
	uint32_t size = word_row(FB_TON)->size, at = own(COUNTER);
	enum word second[] = { FB_TON, FB_TP };

	for (int i = 0; i < 2; i++) {
		struct draft d;

		draft_good(&d);
		d.run[3] = (struct code_run){ at, RUN_INSTANCE, 0, FB_TON, 1 };
		d.run[4] = (struct code_run){ at + size, RUN_INSTANCE, 0,
					      (uint16_t)second[i], 1 };
		d.header.data_size = at + 2 * size;
		d.text[AT_FB] = op(VM_FB, FB_TON);
		d.text[AT_COPY + 3] = d.text[AT_CMP + 2] = d.text[AT_FN + 6] =
			own_as(IEC_DINT, NUMBER + 4);
		d.text[AT_PAIR + 2] = d.text[AT_MATH + 4] = own(NUMBER + 4);
		d.init[6] = own(NUMBER) + 4;
		append_block(&d, at, at + size, size);
		CHECK_AS(judge(&d) == (i ? DIAG_IMAGE_REFUSED : DIAG_COUNT),
			 i ? "a copy of a TP to a TON is refused"
			   : "a copy of a TON to a TON is accepted");
	}
}

static void test_call_graph(void)
{
	ALLOWED(append_call(&d, 0));
	REFUSED(append_call(&d, 2));
	REFUSED(append_call(&d, UINT32_MAX));
	REFUSED(append_call(&d, 0); d.text[WORDS] = op(VM_CALL, 1));
	REFUSED(append_call(&d, 1));                          /* itself */
	REFUSED(append_call(&d, 2); append_call(&d, 1));      /* each other */
	REFUSED(append_call(&d, 2); append_call(&d, 3); append_call(&d, 1));
	REFUSED(append_call(&d, 0); d.entry[1].text = 0); /* into the middle of another one */
}

static void test_deep_calls(void)
{
	struct draft d;

	/* The deepest nesting that the VM allows, and one more. */
	draft_good(&d);
	append(&d, NULL, 0);
	for (uint32_t i = 1; i <= LIMIT_CALLS; i++)
		append_call(&d, i);
	CHECK_AS(judge(&d) == DIAG_COUNT, "LIMIT_CALLS nested calls are accepted");
	append_call(&d, LIMIT_CALLS + 1);
	CHECK_AS(judge(&d) == DIAG_IMAGE_REFUSED, "one nested call more is refused");
}

int main(void)
{
	test_blocks();
	test_other_blocks();
	test_call_graph();
	test_deep_calls();
	test_good();
	test_header();
	test_layout();
	test_areas();
	test_init();
	test_bits();
	test_operands();
	test_pairs();
	test_calls();
	test_choices();
	test_flow();
	test_maps();
	test_tasks();
	return tap_done();
}
