/* SPDX-License-Identifier: MIT
 *
 * test_code - the verifier accepts a valid image and refuses every kind of damage, with
 * the right message and place.
 */
#include "engine/base/digest.h"
#include "tests/unit/rig.h"
#include "tests/usual.h"

static const char source[] =
	"VAR\n"
	"  Go AT %IX0.0 : BOOL;\n"
	"  Lamp AT %QX0.0 : BOOL;\n"
	"  Count : INT := 3;\n"
	"  Total : DINT;\n"
	"  Heat  : REAL := 1.5;\n"
	"  Wait  : TIME := T#1s;\n"
	"  On    : BOOL := TRUE;\n"
	"  Delay : TON;\n"
	"  More  : TON;\n"
	"END_VAR\n"
	"VAR CONSTANT\n  Seven : INT := 7;\nEND_VAR\n"
	"PROGRAM First IL\n"
	"  LD Go\n  OR M8\n  ANDN On\n  ST Lamp\n"
	"  LD %MB1\n  ST %QB4\n  LD Lamp\n  ST M9\n"
	"  LD Count\n  GT Seven\n  JMPC Past\n"
	"  ADD(EN := Go, IN1 := Count, IN2 := 1, ENO => On, OUT => Total)\n"
	"  CAL Delay(IN := Go, PT := Wait)\n  CAL More(IN := Go)\n"
	"Past:\n  LD Heat\n  ADD 1\n  ST Heat\n  JMP Out\nOut:\n"
	"  LD Go\n  ST On\n"
	"END_PROGRAM\n"
	"PROGRAM Second LD\nRUNG\n  | NO Go | TON Delay | COIL Q9 |\nEND_PROGRAM\n";

static uint8_t *good, *image; /* image: a copy to be damaged */
static size_t len;
static size_t where;

static struct code_header *header(void)
{
	return (void *)image;
}

static void *section(enum code_section_kind kind)
{
	return image + header()->section[kind].offset;
}

static void *last_of(enum code_section_kind kind, size_t unit)
{
	const struct code_section *at = &header()->section[kind];

	return image + at->offset + at->size - unit;
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

static bool open_bytes(size_t size, enum diag_id *why)
{
	struct arena scratch;
	struct program program;
	bool open;

	arena_init(&scratch);
	open = code_open(image, size, &scratch, &program, why, &where);
	arena_free(&scratch);
	return open;
}

/* Whether the verifier refuses the damaged copy, which has a correct checksum. */
static bool refused(void)
{
	enum diag_id why = DIAG_COUNT;
	bool open;

	seal();
	open = open_bytes(len, &why);
	fresh();
	return !open && why == DIAG_IMAGE_REFUSED;
}

static bool damaged(size_t size, enum diag_id want)
{
	enum diag_id why = DIAG_COUNT;
	bool open = open_bytes(size, &why);

	fresh();
	return !open && why == want;
}

/* The first instruction with this operation of the first program. */
static uint32_t *find(enum vm_op op)
{
	const struct code_program *entry = section(CODE_PROGRAMS);
	uint32_t *text = section(CODE_TEXT);

	for (uint32_t at = 0; at < entry->text_words; at += code_words(text + at))
		if ((text[at] & 0xff) == op)
			return text + at;
	CHECK_AS(false, vm_row(op)->word);
	return text;
}

/* ---- header and sections ---- */

static void refuses_headers(void)
{
	enum diag_id why;

	CHECK(open_bytes(len, &why));
	CHECK(damaged(0, DIAG_IMAGE_MAGIC) && damaged(7, DIAG_IMAGE_MAGIC));
	CHECK(damaged(8, DIAG_IMAGE_DAMAGED));
	CHECK(damaged(sizeof(struct code_header) - 1, DIAG_IMAGE_DAMAGED));
	CHECK(damaged(sizeof(struct code_header), DIAG_IMAGE_DAMAGED));
	CHECK(damaged(len - 1, DIAG_IMAGE_DAMAGED));
	CHECK(damaged(len - 8, DIAG_IMAGE_DAMAGED));
	image[0] ^= 1;
	CHECK(damaged(len, DIAG_IMAGE_MAGIC));
	header()->version++;
	CHECK(damaged(len, DIAG_IMAGE_VERSION));
	header()->crc ^= 1;
	CHECK(damaged(len, DIAG_IMAGE_DAMAGED));
	header()->words++;
	seal();
	CHECK_AS(damaged(len, DIAG_IMAGE_VERSION),
		 "an image of another catalogue is refused");
	for (size_t at = offsetof(struct code_header, data_size); at < len; at++) {
		image[at] ^= 0x40;
		if (!damaged(len, DIAG_IMAGE_DAMAGED))
			CHECK_AS(false, "the checksum finds each flipped bit");
	}
}

static void refuses_sections(void)
{
	for (int kind = 1; kind < CODE_SECTION_COUNT; kind++) {
		header()->section[kind].offset = (uint32_t)len + 4;
		seal();
		CHECK(damaged(len, DIAG_IMAGE_DAMAGED));
		header()->section[kind].size = UINT32_MAX - 3;
		seal();
		CHECK(damaged(len, DIAG_IMAGE_DAMAGED));
		header()->section[kind].offset = 8;
		seal();
		CHECK(damaged(len, DIAG_IMAGE_DAMAGED));
		header()->section[kind].offset += 2;
		seal();
		CHECK(damaged(len, DIAG_IMAGE_DAMAGED));
	}
	header()->section[CODE_TEXT].size -= 2;
	seal();
	CHECK(damaged(len, DIAG_IMAGE_DAMAGED));
}

static void refuses_bounds(void)
{
	header()->data_size = LIMIT_DATA + 1;
	CHECK(refused() && where == offsetof(struct code_header, data_size));
	header()->data_size = UINT32_MAX;
	CHECK(refused());
	header()->data_size = usual_areas()->size + 1;
	CHECK(refused());
	header()->data_size -= 8;
	CHECK_AS(refused(), "a layout beyond the end of the data is refused");
	header()->budget = LIMIT_BUDGET + 1;
	CHECK(refused());
	header()->retain_size = UINT32_MAX;
	CHECK(refused());
	header()->retain_offset = header()->data_size + 1;
	CHECK(refused());
}

/* ---- data ---- */

static struct code_run *run_of(enum code_run_kind kind, int skip)
{
	struct code_run *run = section(CODE_LAYOUT);

	while (run->kind != kind || skip-- > 0)
		run++;
	return run;
}

static void refuses_layouts(void)
{
	run_of(RUN_INSTANCE, 0)->kind = RUN_INSTANCE + 1;
	CHECK(refused());
	run_of(RUN_VALUES, 0)->type = IEC_NONE;
	CHECK(refused());
	run_of(RUN_VALUES, 0)->type = IEC_TYPE_COUNT;
	CHECK(refused());
	run_of(RUN_VALUES, 0)->offset -= 4;
	CHECK_AS(refused(), "a run that overlaps the one before is refused");
	run_of(RUN_VALUES, 0)->offset = 0;
	CHECK_AS(refused(), "a run of values in an area is refused");
	run_of(RUN_VALUES, 0)->count = UINT32_MAX;
	CHECK(refused());
	run_of(RUN_VALUES, 0)->offset = UINT32_MAX;
	CHECK(refused());
	run_of(RUN_INSTANCE, 0)->offset += 4;
	CHECK_AS(refused(), "an instance that is not aligned is refused");
	run_of(RUN_INSTANCE, 0)->word = WORD_COUNT;
	CHECK(refused());
	run_of(RUN_INSTANCE, 0)->word = FN_ADD;
	CHECK_AS(refused(), "an instance of a function is refused");
	run_of(RUN_INSTANCE, 0)->word = FB_TOF;
	CHECK_AS(refused(), "a TOF where the code calls a TON is refused");
	run_of(RUN_INSTANCE, 0)->count--;
	CHECK_AS(refused(), "one instance less than the code calls is refused");
	run_of(RUN_CONSTANTS, 0)->kind = RUN_VALUES;
	CHECK_AS(refused(), "FALSE and TRUE as variables are refused");
	header()->section[CODE_LAYOUT].size -= sizeof(struct code_run);
	CHECK_AS(refused(), "a missing last run is refused");
}

/* Byte of an initial BOOL that is TRUE; NULL: none. */
static uint8_t *initial_true(uint32_t *init, const uint32_t *end)
{
	for (; init < end; init += 2 + (init[1] + 3) / 4)
		for (uint32_t i = 0; i < init[1]; i++) {
			const struct code_run *run = section(CODE_LAYOUT);
			uint8_t *byte = (uint8_t *)(init + 2) + i;

			while (run->offset + run->count * code_run_size(run) <=
			       init[0] + i)
				run++;
			if (run->offset <= init[0] + i && *byte == 1 &&
			    run->kind == RUN_VALUES && run->type == IEC_BOOL)
				return byte;
		}
	return NULL;
}

static void refuses_initial_values(void)
{
	uint32_t *init = section(CODE_INIT);
	const uint32_t *end = init + header()->section[CODE_INIT].size / 4;
	uint8_t *on;

	init[0] = header()->data_size;
	CHECK(refused());
	init[1] = UINT32_MAX;
	CHECK(refused());
	init[1] = header()->data_size;
	CHECK(refused());
	init[0] = usual_areas()->size + 3;
	CHECK_AS(refused(), "an initial value outside every run is refused");
	header()->section[CODE_INIT].size -= 4;
	CHECK_AS(refused(), "an initial value that is cut off is refused");
	init[1] = 1;
	init[0] = run_of(RUN_INSTANCE, 0)->offset +
		  (uint32_t)offsetof(struct fb_TON, running);
	CHECK_AS(refused(), "an initial value of inner state of an instance is refused");
	on = initial_true(init, end);
	if (CHECK_AS(on != NULL, "the image has a BOOL that begins TRUE")) {
		*on = 2;
		CHECK_AS(refused(), "an initial BOOL of 2 is refused");
	}
}

/* The byte of the initial values for this offset of the data; NULL: none. */
static uint8_t *initial(uint32_t offset)
{
	uint32_t *init = section(CODE_INIT);
	const uint32_t *end = init + header()->section[CODE_INIT].size / 4;

	for (; init < end; init += 2 + (init[1] + 3) / 4)
		if (offset >= init[0] && offset - init[0] < init[1])
			return (uint8_t *)(init + 2) + (offset - init[0]);
	return NULL;
}

/* A text has no more characters than its variable has room for. */
static void refuses_initial_texts(void)
{
	for (uint16_t length = 0; length <= 12; length++) {
		uint8_t *at = initial(run_of(RUN_VALUES, 0)->offset);

		if (!CHECK_AS(at != NULL, "the image has the first text of Name"))
			return;
		memcpy(at + offsetof(struct iec_string, length), &length, sizeof(length));
		CHECK_AS(refused() == (length > 8), "the length of a first text");
	}
}

static void refuses_bits(void)
{
	struct code_bits *bits = section(CODE_BITS);

	bits->area = AREA_NONE;
	CHECK(refused());
	bits->area = AREA_COUNT;
	CHECK(refused());
	bits->area = AREA_XAQ;
	CHECK_AS(refused(), "areas of bits in the wrong order are refused");
	bits->first = usual_areas()->bytes[AREA_I] * 8;
	CHECK(refused());
	bits->first = UINT32_MAX;
	CHECK(refused());
	bits->count = UINT32_MAX;
	CHECK(refused());
	bits->slot = header()->data_size;
	CHECK(refused());
	bits->slot = 0;
	CHECK_AS(refused(), "bits copied into an area are refused");
	bits->slot = CODE_FALSE_AT(usual_areas());
	CHECK_AS(refused(), "bits copied over a constant are refused");
	bits[1] = bits[0];
	CHECK_AS(refused(), "the same bit twice is refused");
}

/* ---- code ---- */

static void refuses_programs(void)
{
	struct code_program *entry = section(CODE_PROGRAMS);

	entry->text = UINT32_MAX;
	CHECK(refused());
	entry->text_words = UINT32_MAX;
	CHECK(refused());
	entry->text_words = 0;
	CHECK_AS(refused(), "a program without END is refused");
	entry->text_words--;
	CHECK_AS(refused(), "a program whose END is cut off is refused");
	entry->text++;
	CHECK(refused());
	entry->watch = 1;
	CHECK(refused());
	entry->watch_words = 1;
	CHECK(refused());
	entry->name = header()->section[CODE_STRINGS].size;
	CHECK(refused());
	*find(VM_END) = VM_END | 1u << 8;
	CHECK(refused());
	*find(VM_END) = VM_COUNT;
	CHECK(refused());
	*find(VM_END) = 0xff;
	CHECK(refused());
	*find(VM_END) = VM_LUT | 0xffffffu << 8;
	CHECK(refused());
	*find(VM_END) = VM_FN | 0xffffffu << 8;
	CHECK(refused());
	*find(VM_END) = VM_JMPC;
	CHECK(refused());
}

/* One word of an instruction changed: @word from its first one. */
static bool refuses(enum vm_op op, int word, uint32_t value)
{
	find(op)[word] = value;
	return refused();
}

static uint32_t spot_of(enum code_run_kind kind, enum iec_type type)
{
	const struct code_run *run = section(CODE_LAYOUT);

	while (run->kind != kind || run->type != type)
		run++;
	return run->offset;
}

static void refuses_bit_operands(void)
{
	const uint32_t outside[] = { header()->data_size, UINT32_MAX, 0x1000000, 0,
		spot_of(RUN_VALUES, IEC_INT), run_of(RUN_INSTANCE, 0)->offset + 1 };
	const uint32_t none = CODE_FALSE_AT(usual_areas());
	const uint32_t q = run_of(RUN_INSTANCE, 0)->offset +
			   (uint32_t)offsetof(struct fb_TON, Q);

	for (int i = 0; i < 5; i++)
		for (int word = 1; word <= 3; word++)
			CHECK(refuses(VM_LUT, word, outside[i]));
	CHECK(refuses(VM_LUT, 4, none << 8) && refuses(VM_LUT, 4, q << 8));
	CHECK(refuses(VM_LUT, 4, 0xffffff00) && refuses(VM_LUT, 4, 0));
	CHECK(refuses(VM_LUT, 0, VM_LUT) && refuses(VM_LUT, 0, VM_LUT | 0x7fffff00));
	CHECK(refuses(VM_BITGET, 0, VM_BITGET | 8u << 8));
	CHECK(refuses(VM_BITPUT, 0, VM_BITPUT | 8u << 8));
	CHECK(refuses(VM_BITGET, 1, outside[0]) && refuses(VM_BITGET, 2, none));
	CHECK(refuses(VM_BITGET, 1, none) && refuses(VM_BITPUT, 2, none));
	CHECK(refuses(VM_BITPUT, 1, outside[0]) && refuses(VM_BITPUT, 2, outside[1]));
	CHECK_AS(refuses(VM_BITPUT, 2, 0), "a BITPUT into an input is refused");
	CHECK(refuses(VM_JMPC, 2, outside[0]) && refuses(VM_JMPC, 2, 0));
	CHECK(refuses(VM_JMPC, 0, VM_JMPC | 2u << 8));
}

static void refuses_number_operands(void)
{
	const uint32_t real = CODE_OPERAND(IEC_REAL, spot_of(RUN_VALUES, IEC_REAL));
	const uint32_t dint = CODE_OPERAND(IEC_DINT, spot_of(RUN_VALUES, IEC_DINT));
	const uint32_t seven = CODE_OPERAND(IEC_INT,
					    spot_of(RUN_CONSTANTS, IEC_INT));
	const uint32_t input = CODE_OPERAND(IEC_BYTE, 0);

	CHECK(refuses(VM_COPY, 1, UINT32_MAX) && refuses(VM_COPY, 1, 0));
	CHECK(refuses(VM_COPY, 2, seven) && refuses(VM_COPY, 2, input));
	CHECK(refuses(VM_COPY, 2, 5) && refuses(VM_COPY, 3, 5));
	CHECK(refuses(VM_COPY, 3, CODE_OPERAND(IEC_TYPE_COUNT, 0)));
	CHECK_AS(refuses(VM_COPY, 3, real), "a COPY of a REAL to a BYTE is refused");
	CHECK_AS(refuses(VM_COPY, 3, CODE_OPERAND(IEC_INT, CODE_OFFSET(dint))),
		 "a COPY that reads a DINT as an INT is refused");
	CHECK_AS(refuses(VM_COPY, 3, CODE_OPERAND(IEC_DWORD, 510)),
		 "a COPY across the end of an area is refused");
	CHECK(refuses(VM_COPY, 0, VM_COPY | 2u << 8) &&
	      refuses(VM_COPY, 0, VM_COPY | 8u << 8));
	CHECK(refuses(VM_CMP_INT, 0, VM_CMP_INT | 256u << 8));
	CHECK(refuses(VM_CMP_INT, 1, CODE_OFFSET(dint)) &&
	      refuses(VM_CMP_INT, 2, UINT32_MAX));
	CHECK(refuses(VM_CMP_INT, 1, seven));
	CHECK(refuses(VM_CMP_INT, 3, CODE_OFFSET(real)) &&
	      refuses(VM_CMP_INT, 4, CODE_TRUE_AT(usual_areas())));
	CHECK(refuses(VM_CMP_INT, 0, VM_CMP | 0x77u << 8));
	CHECK(refuses(VM_REAL, 0, VM_REAL | 2 * MATH_LEFT << 8) && refuses(VM_REAL, 0, VM_DINT));
	CHECK(refuses(VM_REAL, 0, VM_REAL | (MATH_MOD | MATH_ENABLED) << 8));
	CHECK(refuses(VM_REAL, 1, CODE_FALSE_AT(usual_areas())));
	CHECK(refuses(VM_REAL, 2, CODE_TRUE_AT(usual_areas())));
	CHECK(refuses(VM_REAL, 3, CODE_OFFSET(dint)) && refuses(VM_REAL, 4, real) &&
	      refuses(VM_REAL, 5, UINT32_MAX));
	CHECK(refuses(VM_FN, 1, WORD_COUNT) && refuses(VM_FN, 1, FB_TON));
	CHECK(refuses(VM_FN, 1, UINT32_MAX) && refuses(VM_FN, 1, FN_MOVE));
	CHECK(refuses(VM_FN, 2, 0) && refuses(VM_FN, 3, 0));
	CHECK(refuses(VM_FN, 3, CODE_TRUE_AT(usual_areas())));
	CHECK(refuses(VM_FN, 4, seven) && refuses(VM_FN, 4, UINT32_MAX));
	CHECK(refuses(VM_FN, 5, real) && refuses(VM_FN, 6, 0));
	CHECK(refuses(VM_FN, 0, VM_FN | (IEC_BOOL | 2u << 8 | (uint32_t)IEC_BOOL << 16) << 8));
	CHECK(refuses(VM_FN, 0, VM_FN | (IEC_TYPE_COUNT | 2u << 8 | (uint32_t)IEC_TYPE_COUNT << 16) << 8));
	CHECK(refuses(VM_FN, 0, VM_FN | (IEC_DINT | 1u << 8 | (uint32_t)IEC_DINT << 16) << 8));
	CHECK(refuses(VM_FN, 0, VM_FN | (IEC_DINT | 17u << 8 | (uint32_t)IEC_DINT << 16) << 8));
	CHECK(refuses(VM_FN, 0, VM_FN | (IEC_REAL | 2u << 8 | (uint32_t)IEC_REAL << 16) << 8));
	CHECK(refuses(VM_FB, 1, 0) && refuses(VM_FB, 1, UINT32_MAX));
	CHECK(refuses(VM_FB, 1, find(VM_FB)[1] + 8));
	CHECK(refuses(VM_FB, 0, VM_FB | (uint32_t)FB_TOF << 8));
	CHECK(refuses(VM_FB, 0, VM_FB | 0xffffffu << 8));
}

/* MATH_ROW: the second box must be there, and the ENO of the first one must be its EN. */
static void refuses_rows(void)
{
	const uint32_t marks = MATH_MUL | MATH_ENABLED | MATH_ROW, alone = MATH_ADD | MATH_ENABLED;
	const uint32_t go = find(VM_REAL)[1], heat = find(VM_REAL)[3];

	CHECK_AS(*find(VM_REAL) == (VM_REAL | marks << 8) && find(VM_REAL)[6] == (VM_REAL | alone << 8),
		 "two boxes of REAL, one behind the other, are a row");
	CHECK_AS(!refuses(VM_REAL, 0, VM_REAL | (marks & ~MATH_ROW) << 8), "no mark is needed");
	CHECK(refuses(VM_REAL, 0, VM_REAL | (marks & ~MATH_ENABLED) << 8));
	CHECK(refuses(VM_REAL, 0, VM_REAL | (marks | MATH_LOOP) << 8));
	CHECK_AS(refuses(VM_REAL, 6, VM_REAL | (alone | MATH_ROW) << 8), "the last one of a row has none behind it");
	CHECK(refuses(VM_REAL, 6, VM_REAL | MATH_ADD << 8) && refuses(VM_REAL, 6, VM_FN | alone << 8));
	CHECK_AS(refuses(VM_REAL, 7, go), "the ENO of the first one is the EN of the second one");
	CHECK(refuses(VM_REAL, 2, find(VM_REAL)[8]));
	CHECK_AS(refuses(VM_INT, 0, VM_INT | marks << 8), "INT has no rows");
	CHECK_AS(!refuses(VM_REAL, 10, heat), "the second one may read anything");
}

static void refuses_jumps(void)
{
	const struct code_program *entry = section(CODE_PROGRAMS);
	uint32_t target = find(VM_JMPC)[1];

	CHECK_AS(refuses(VM_JMPC, 1, target + 1),
		 "a jump into an instruction is refused");
	CHECK(refuses(VM_JMPC, 1, UINT32_MAX) && refuses(VM_JMP, 1, target - 1));
	CHECK_AS(refuses(VM_JMP, 1, entry[1].text),
		 "a jump into another program is refused");
	CHECK(refuses(VM_JMP, 1, header()->section[CODE_TEXT].size / 4));
	find(VM_JMPC)[1] = 0;
	seal();
	enum diag_id why;
	CHECK_AS(open_bytes(len, &why), "a jump back is accepted: the budget limits it");
	fresh();
}

/* ---- maps ---- */

static void refuses_maps(void)
{
	uint32_t *symbol = section(CODE_SYMBOLS);
	struct code_group *group = section(CODE_GROUPS);
	struct code_power *power = section(CODE_POWER);
	struct code_place *place = section(CODE_PLACES);

	CHECK(header()->section[CODE_POWER].size > 0);
	CHECK(header()->section[CODE_SYMBOLS].size == 10 * sizeof(*symbol));
	CHECK(header()->section[CODE_GROUPS].size == 2 * sizeof(*group));
	group[1].flags |= SYMBOL_SHARED;
	CHECK(refused());
	group->pou = 3;
	CHECK(refused());
	group[1].first = 10;
	CHECK(refused());
	symbol[0] = CODE_OPERAND(SYMBOL_BIT | IEC_INT, 0);
	CHECK_AS(refused(), "the bit Go as an INT is refused");
	symbol[0] = CODE_OPERAND(SYMBOL_BIT | IEC_BOOL, 0xffffff);
	CHECK(refused());
	symbol[2] = CODE_OPERAND(IEC_DINT, CODE_OFFSET(symbol[2]));
	CHECK(refused());
	symbol[2] = CODE_OPERAND(SYMBOL_TYPE, CODE_OFFSET(symbol[2]));
	CHECK(refused());
	symbol[2] = CODE_OPERAND(IEC_INT, 0xffffff);
	CHECK(refused());
	symbol[2] = CODE_OPERAND(IEC_NONE, CODE_OFFSET(symbol[2]));
	CHECK_AS(refused(), "a symbol of an instance where none lies is refused");
	symbol[7] += 8;
	CHECK(refused());
	power->in = UINT32_MAX;
	CHECK(refused());
	power->out = spot_of(RUN_VALUES, IEC_INT);
	CHECK(refused());
	place->text = UINT32_MAX;
	CHECK(refused());
	place->pou = 2;
	CHECK(refused());
	*(char *)last_of(CODE_STRINGS, 1) = 'x';
	CHECK_AS(refused(), "a last string without its 0 byte is refused");
}

/* Every symbol is found by its name, at the same place as by stepping. */
static void names_symbols(void)
{
	struct arena scratch;
	struct program program;
	struct symbol_cursor cursor = { 0 };
	struct symbol out;
	struct image img = { .program = &program };
	enum diag_id why;
	int count = 0;

	arena_init(&scratch);
	CHECK(code_open(image, len, &scratch, &program, &why, &where));
	img.memory = calloc(1, image_memory_size(&program));
	image_init(&img, &program, img.memory);
	while (image_next_symbol(&img, &cursor, &out)) {
		struct location at = image_find(&img, out.name,
						strlen(out.name));

		CHECK_AS(at.type == out.at.type && at.area == out.at.area &&
			 at.where == out.at.where, out.name);
		CHECK(at.constant == (strcmp(out.name, "Seven") == 0));
		count++;
	}
	CHECK(count == 8 + 2 * 4);
	CHECK(image_find(&img, "Count", 5).type == IEC_INT);
	CHECK(image_find(&img, "Lamp", 4).area == AREA_Q);
	CHECK(image_find(&img, "Delay", 5).type == IEC_NONE);
	free(img.memory);
	arena_free(&scratch);
}

static void identity(const void *bytes, size_t size, uint8_t out[32])
{
	struct arena scratch;
	struct program program;
	enum diag_id why;

	arena_init(&scratch);
	memset(out, 0, 32);
	if (CHECK(code_open(bytes, size, &scratch, &program, &why, &where)))
		code_identity(&program, out);
	arena_free(&scratch);
}

static bool is_same_as(const struct program *other)
{
	struct arena scratch;
	struct program program;
	enum diag_id why;
	bool same;

	arena_init(&scratch);
	same = code_open(image, len, &scratch, &program, &why, &where) && code_is_same(&program, other);
	arena_free(&scratch);
	return same;
}

/* Each byte of the image in turn is another one. */
static void same_as_by_identity(void)
{
	struct program whole, changed;
	uint8_t first[32], second[32];
	int same = 0, other = 0, wrong = 0;
	struct arena scratch, again;
	enum diag_id why;

	arena_init(&scratch);
	if (!CHECK(code_open(good, len, &scratch, &whole, &why, &where)))
		return;
	code_identity(&whole, first);
	for (size_t at = offsetof(struct code_header, data_size); at < len; at++) {
		arena_init(&again);
		image[at] ^= 1;
		seal();
		if (code_open(image, len, &again, &changed, &why, &where)) {
			const bool is_same = code_is_same(&whole, &changed);

			code_identity(&changed, second);
			wrong += is_same != (memcmp(first, second, 32) == 0);
			same += is_same;
			other += !is_same;
		}
		arena_free(&again);
		fresh();
	}
	arena_free(&scratch);
	CHECK_AS(wrong == 0, "code_is_same() says what code_identity() says");
	CHECK(same > 100 && other > 100);
}

static void watching_is_no_other_program(void)
{
	uint8_t watched[32], bare[32];
	struct rig rig;

	identity(image, len, watched);
	if (rig_open(&rig, source, false)) {
		code_identity(ladder_program(rig.ladder), bare);
		CHECK(memcmp(watched, bare, 32) == 0);
		CHECK(is_same_as(ladder_program(rig.ladder)));
		CHECK(ladder_program(rig.ladder)->watch_words == 0);
	}
	rig_close(&rig);
	CHECK(header()->core_runs < header()->section[CODE_LAYOUT].size /
	      sizeof(struct code_run));
	header()->core_runs = UINT32_MAX;
	CHECK_AS(refused(), "core_runs above the number of runs is refused");
}

static void drops_maps(void)
{
	uint8_t whole[32], bare[32];
	struct code_program *entry = section(CODE_PROGRAMS);
	size_t size = code_strip(image, NULL);
	void *small = aligned_alloc(8, (size + 7) / 8 * 8);

	identity(image, len, whole);
	for (int kind = CODE_WATCH; kind < CODE_SECTION_COUNT; kind++)
		header()->section[kind].size = 0;
	for (int i = 0; i < 2; i++)
		entry[i].watch = entry[i].watch_words = 0;
	seal();
	identity(image, len, bare);
	CHECK(memcmp(whole, bare, 32) == 0);
	fresh();
	CHECK(small && code_strip(image, small) == size && size < len);
	identity(small, size, bare);
	CHECK(memcmp(whole, bare, 32) == 0);
	free(small);
	find(VM_LUT)[4] ^= 1;
	seal();
	identity(image, len, bare);
	CHECK_AS(memcmp(whole, bare, 32) != 0,
		 "a changed truth table changes the identity");
	fresh();
}

/* Calls @checks with an image of the program; refused() damages a copy of it. */
static void with_image(const char *program, void (*checks)(void))
{
	struct rig rig;

	if (rig_open(&rig, program, true)) {
		good = (void *)(uintptr_t)ladder_image(rig.ladder, &len);
		image = aligned_alloc(8, (len + 7) / 8 * 8);
		if (!image)
			abort();
		fresh();
		checks();
		free(image);
	}
	rig_close(&rig);
}

static void all_checks(void)
{
	refuses_headers();
	refuses_sections();
	refuses_bounds();
	refuses_layouts();
	refuses_initial_values();
	refuses_bits();
	refuses_programs();
	refuses_bit_operands();
	refuses_number_operands();
	refuses_jumps();
	refuses_maps();
	names_symbols();
	watching_is_no_other_program();
	same_as_by_identity();
	drops_maps();
}

int main(void)
{
	with_image(source, all_checks);
	with_image("VAR\n  Name : STRING[8] := 'xyz';\nEND_VAR\nPROGRAM Main IL\nEND_PROGRAM\n",
		   refuses_initial_texts);
	with_image("VAR\n  Go : BOOL;\n  Heat : REAL;\n  Count : INT;\nEND_VAR\nPROGRAM Main LD\nRUNG\n"
		   "  | NO Go | MUL IN1:=Heat IN2:=1.5 OUT=>Heat | ADD IN1:=Heat IN2:=0.5 OUT=>Heat |\n"
		   "RUNG\n  | NO Go | ADD IN1:=Count IN2:=1 OUT=>Count | ADD IN1:=Count IN2:=1 OUT=>Count |\n"
		   "END_PROGRAM\n", refuses_rows);
	return tap_done();
}
