/* SPDX-License-Identifier: MIT
 *
 * test_catalog - the rows are complete, and words, pins and operators are found.
 */
#include "engine/base/catalog.h"
#include "tests/tap.h"

static bool is_name(const char *word)
{
	return (word[0] >= 'A' && word[0] <= 'Z');
}

/* Each word and each pin with a name has an explanation. */
static void rows_are_explained(void)
{
	const struct word_row own = { .number = WORD_COUNT };
	bool good = true;

	for (int i = 0; i < WORD_COUNT; i++) {
		const struct word_row *row = word_row((enum word)i);

		good &= explain_word(row)[0] != '\0';
		for (int k = 0; k < row->pin_count; k++)
			good &= !explain_pin(row, k)[0] == (row->pin[k].dir == PIN_VAR);
		good &= !explain_pin(row, row->pin_count)[0];
	}
	CHECK(good);
	CHECK_TEXT(explain_word(word_row(FB_TON)), "on-delay timer");
	CHECK_TEXT(explain_pin(word_row(FB_TON), 2), "preset");
	CHECK_TEXT(explain_pin(word_row(FN_MUL), 1), "next");
	CHECK_TEXT(explain_pin(word_row(FB_TON), -1), "");
	CHECK_TEXT(explain_word(&own), "");
	CHECK_TEXT(explain_pin(&own, 0), "");
	CHECK_TEXT(explain_op(OP_COUNT), "");
	CHECK_TEXT(explain_area(AREA_AQ), "analog outputs");
	CHECK_TEXT(explain_area(AREA_COUNT), "");
	CHECK_TEXT(explain_sys(SYS_ALWAYS_ON), "always TRUE");
	CHECK_TEXT(explain_sys(SYS_COUNT), "");
}

static void rows_are_whole(void)
{
	bool whole = true, found = true, layout = true;

	for (int i = 0; i < WORD_COUNT; i++) {
		const struct word_row *row = word_row((enum word)i);

		whole &= explain_id(row) && row->word && explain_family(row) &&
			 row->number == (enum word)i;
		whole &= strlen(explain_glyph(row)) == (row->kind == WORD_ELEM ? 3 : 0);
		/* NOT is also an element; the reader finds the function. */
		if (i == FN_NOT)
			found &= word_find(row->word, strlen(row->word)) == ELEM_NOT;
		else if (is_name(row->word))
			found &= word_find(row->word, strlen(row->word)) ==
				 (enum word)i;
		else
			found &= word_find(row->word, strlen(row->word)) ==
				 WORD_COUNT;
		for (int k = 0; k < row->pin_count; k++) {
			const struct word_pin *pin = &row->pin[k];
			size_t size = iec_type_row(pin->type)->size;

			if (row->kind == WORD_FB)
				layout &= size && pin->offset % size == 0 &&
					  pin->offset + size <= row->size;
			else
				layout &= pin->classes != 0;
			if (pin->dir != PIN_VAR)
				found &= word_pin_find(row, pin->name,
						       strlen(pin->name)) == k;
		}
	}
	CHECK(whole);
	CHECK(found);
	CHECK(layout);
	CHECK(word_row(WORD_COUNT) == word_row(ELEM_EMPTY));
}

static void words_are_found(void)
{
	CHECK(word_find("ton", 3) == FB_TON);
	CHECK(word_find("Coil", 4) == ELEM_COIL);
	CHECK(word_find("COILNOTX", 7) == ELEM_COIL_NOT);
	CHECK(word_find("s", 1) == ELEM_COIL_SET);
	CHECK(word_find("SR", 2) == FB_SR);
	CHECK(word_find("", 0) == WORD_COUNT);
	CHECK(word_find("---", 3) == WORD_COUNT);
	CHECK(word_find("[ ]", 3) == WORD_COUNT);
	CHECK(word_find(".", 1) == WORD_COUNT);
	CHECK(word_find("CO", 2) == WORD_COUNT);
	CHECK(word_row(ELEM_CONTACT_NC)->negate);
	CHECK(word_row(ELEM_CONTACT_NC)->first == OP_LD);
	CHECK(word_row(ELEM_CONTACT_P)->edge == EDGE_RISING);
	CHECK(word_row(FB_TON)->place == PLACE_BOX);
	CHECK(word_row(FB_TON)->operand == OPND_INSTANCE);
	CHECK(word_row(FB_TON)->size == sizeof(struct fb_TON));
	CHECK(word_row(FN_GT)->result == IEC_BOOL);
	CHECK(word_row(FN_ADD)->most_inputs == LIMIT_FN_INPUTS);
}

static int pin(enum word word, const char *name)
{
	return word_pin_find(word_row(word), name, strlen(name));
}

static void pins_are_found(void)
{
	const struct word_row *ton = word_row(FB_TON);

	CHECK(pin(FB_TON, "pt") >= 0);
	CHECK_TEXT(ton->pin[pin(FB_TON, "pt")].name, "PT");
	CHECK(ton->pin[pin(FB_TON, "ET")].type == IEC_TIME);
	CHECK(pin(FB_TON, "running") == -1);
	CHECK(pin(FB_TON, "P") == -1);
	CHECK(pin(FB_TON, "PTX") == -1);
	CHECK(pin(FB_TON, "IN1") == -1);
	CHECK(pin(FN_ADD, "IN1") == 0);
	CHECK(pin(FN_ADD, "in2") == 1);
	CHECK(pin(FN_ADD, "IN3") == 2);
	CHECK(pin(FN_ADD, "in8") == 7);
	CHECK(pin(FN_ADD, "IN17") == -1);
	CHECK(pin(FN_ADD, "IN03") == -1);
	CHECK(pin(FN_ADD, "IN") == -1);
	CHECK(pin(FN_ADD, "IN3x") == -1);
	CHECK(pin(FN_ADD, "IN33") == -1);
	CHECK(pin(FN_SUB, "IN3") == -1);
	CHECK(pin(ELEM_COIL, "IN1") == -1);
	CHECK(word_first_bool(ton, PIN_IN) == pin(FB_TON, "IN"));
	CHECK(word_first_bool(ton, PIN_OUT) == pin(FB_TON, "Q"));
	CHECK(word_first_bool(word_row(FB_CTUD), PIN_OUT) ==
	      pin(FB_CTUD, "QU"));
	CHECK(word_first_bool(word_row(FN_ADD), PIN_IN) == -1);
	CHECK(word_first_bool(word_row(ELEM_COIL), PIN_IN) == -1);
}

static void other_rows(void)
{
	struct iec_addr addr;
	bool good = true;

	CHECK(op_find("andn", 4) == OP_COUNT);
	CHECK(op_find("and", 3) == OP_AND);
	CHECK(op_find("", 0) == OP_COUNT);
	for (int i = 0; i < OP_COUNT; i++) {
		const char *word = op_row((enum op)i)->word;

		good &= op_find(word, strlen(word)) == (enum op)i;
	}
	for (int i = 0; i < VM_COUNT; i++)
		good &= vm_row((enum vm_op)i)->word[0] != '\0';
	for (int i = 0; i < SYS_COUNT; i++) {
		const struct sys_row *row = sys_row((enum sys_id)i);

		good &= strncmp(row->name, "SYS_", 4) == 0 &&
			iec_addr_parse(row->address, strlen(row->address),
				       &addr) == ADDR_OK &&
			addr.area == AREA_SM &&
			addr.bits == (row->type == IEC_BOOL ? 1 :
				      iec_type_row(row->type)->size * 8);
	}
	CHECK_AS(good,
		 "each operator, instruction and system variable has all its texts");
	CHECK_TEXT(op_row(OP_COUNT)->word, "");
	CHECK_TEXT(vm_row(VM_COUNT)->word, "");
	CHECK_TEXT(sys_row(SYS_COUNT)->name, "");
}

int main(void)
{
	rows_are_whole();
	rows_are_explained();
	words_are_found();
	pins_are_found();
	other_rows();
	return tap_done();
}
