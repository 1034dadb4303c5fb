/* SPDX-License-Identifier: MIT
 *
 * test_place - a place word names exactly what the layout of the program has.
 */
#include "engine/scan/place.h"
#include "tests/unit/rig.h"

static const char source[] =
	"VAR\n"
	"  On AT %QX1.2 : BOOL;\n"
	"  Wide AT %MW6 : WORD;\n"
	"  Flag : BOOL;\n"
	"  Number : INT;\n"
	"  Table : ARRAY[1..4] OF DINT;\n"
	"  Text : STRING[7];\n"
	"  Delay : TON;\n"
	"END_VAR\n"
	"VAR CONSTANT\n  Fix : REAL := 2.5;\nEND_VAR\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO Flag | TON Delay PT:=T#1s | COIL On |\n"
	"END_PROGRAM\n";

static bool same(struct location a, struct location b)
{
	return a.type == b.type && a.area == b.area && a.where == b.where &&
	       a.constant == b.constant;
}

/* Every symbol has a word, and the word leads back to it. */
static void test_symbols(struct rig *rig)
{
	const struct program *program = rig->resource.image.program;
	struct symbol_cursor cursor = { .whole = false };
	struct symbol symbol;
	int count = 0;

	while (image_next_symbol(&rig->resource.image, &cursor, &symbol)) {
		CHECK_AS(same(place_locate(program, place_word(program, symbol.at)), symbol.at),
			 symbol.name);
		count++;
	}
	CHECK(count > 10);
}

/* Any other word is refused, or it names a value of that type that lies in memory. */
static void test_all_words(struct rig *rig)
{
	const struct program *program = rig->resource.image.program;
	const uint32_t size = program->header->data_size;
	int good = 0, wrong = 0;

	for (uint32_t type = 0; type < 256; type++)
		for (uint32_t offset = 0; offset < 8 * program->areas.size + 64;
		     offset += offset < size ? 1 : 61) {
			const struct location at =
				place_locate(program, CODE_OPERAND(type, offset));

			if (at.type == IEC_NONE)
				continue;
			good++;
			wrong += (uint32_t)at.type != (type & SYMBOL_TYPE) ||
				 place_byte(program, at) >= size ||
				 place_size(program, at) > size - place_byte(program, at) ||
				 (type & ~(uint32_t)(SYMBOL_TYPE | SYMBOL_BIT)) != 0;
		}
	CHECK(good > 0);
	CHECK(wrong == 0);
}

static void test_wrong_types(struct rig *rig)
{
	const struct image *image = &rig->resource.image;
	const struct program *program = image->program;
	const struct location number = image_find(image, "Number", 6);
	const struct location et = image_find(image, "Delay.ET", 8);
	const struct location table = image_find(image, "Table[2]", 8);
	const struct location text = image_find(image, "Text", 4);

	CHECK(place_locate(program, CODE_OPERAND(IEC_INT, number.where)).type == IEC_INT);
	CHECK(place_locate(program, CODE_OPERAND(IEC_DINT, number.where)).type == IEC_NONE);
	CHECK(place_locate(program, CODE_OPERAND(IEC_INT, number.where + 1)).type == IEC_NONE);
	CHECK(place_locate(program, CODE_OPERAND(IEC_TIME, et.where)).type == IEC_TIME);
	CHECK(place_locate(program, CODE_OPERAND(IEC_LINT, et.where)).type == IEC_NONE);
	CHECK(place_locate(program, CODE_OPERAND(IEC_TIME, et.where + 4)).type == IEC_NONE);
	CHECK(place_locate(program, CODE_OPERAND(IEC_DINT, table.where)).type == IEC_DINT);
	CHECK(place_locate(program, CODE_OPERAND(IEC_DINT, table.where + 2)).type == IEC_NONE);
	CHECK(place_locate(program, CODE_OPERAND(IEC_STRING, text.where)).type == IEC_STRING);
	CHECK(place_locate(program, CODE_OPERAND(IEC_STRING, text.where + 4)).type == IEC_NONE);
	CHECK(place_locate(program, CODE_OPERAND(IEC_STRING, 0)).type == IEC_NONE);
	CHECK(place_locate(program, CODE_OPERAND(IEC_WORD, program->areas.size - 1)).type ==
	      IEC_NONE);
	CHECK(place_locate(program, CODE_OPERAND(IEC_BOOL, 0)).type == IEC_NONE);
	CHECK(place_size(program, text) == 4 + 8);
}

int main(void)
{
	struct rig rig;

	if (rig_open(&rig, source, true)) {
		test_symbols(&rig);
		test_all_words(&rig);
		test_wrong_types(&rig);
	}
	rig_close(&rig);
	return tap_done();
}
