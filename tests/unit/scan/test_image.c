/* SPDX-License-Identifier: MIT
 *
 * test_image - areas packed and unpacked, names to places, forces and their release.
 */
#include "tests/unit/rig.h"

static const char bits[] =
	"VAR\n"
	"  Go     AT %IX0.0 : BOOL;\n"
	"  Motor  AT %QX0.0 : BOOL;\n"
	"  Speed  AT %QW4   : INT := -5;\n"
	"  Lit    AT %QX1.0 : BOOL := TRUE;\n"
	"  Unused AT %QX9.1 : BOOL := TRUE;\n"
	"  Kept   : BOOL := TRUE;\n"
	"  Heat   : REAL := 1.5;\n"
	"  Count  : INT;\n"
	"  Delay  : TON;\n"
	"END_VAR\n"
	"VAR CONSTANT\n  Seven : INT := 7;\nEND_VAR\n"
	"PROGRAM Main LD\n"
	"VAR\n  Count : DINT := 3;\n  Local : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO Go | COIL Motor |\n"
	"RUNG\n  | NO M0 | NO M1 | NO M7 | COIL Q7 |\n"
	"RUNG\n  | NO I8 | NO I9 | NO I10 | NO I11 | NO I12 | NO I13 | NO I14 "
	"| NO I15 | COIL Local |\n"
	"RUNG\n  | NO Lit | TON Delay PT:=T#1s | COIL Q2 |\n"
	"RUNG\n  | NO M40 | S M41 |\n"
	"RUNG\n  | [ %MW5 > 3 ] | COIL Q3 |\n"
	"END_PROGRAM\n";

static struct rig rig;

static uint8_t *bytes(enum iec_area area)
{
	return image_area(&rig.resource.image, area);
}

static void starts_cold(void)
{
	CHECK(rig_get(&rig, "Speed") == -5 && rig_get(&rig, "Kept") == 1);
	CHECK(rig_get(&rig, "Lit") == 1 && bytes(AREA_Q)[1] == 1);
	CHECK(rig_get(&rig, "Unused") == 1 && bytes(AREA_Q)[9] == 2);
	CHECK(bytes(AREA_Q)[4] == 0xfb && bytes(AREA_Q)[5] == 0xff);
	CHECK(rig_real(&rig, "Heat") == 1.5);
	CHECK(rig_get(&rig, "Motor") == 0);
}

/* The program sees writes of a driver, and the driver those of the program. */
static void moves_bits_at_the_edges(void)
{
	bytes(AREA_I)[0] = 1;
	CHECK(rig_scan(&rig) && bytes(AREA_Q)[0] == 1);
	CHECK(rig_get(&rig, "Motor") == 1 && rig_get(&rig, "%QB0") == 1);
	bytes(AREA_I)[0] = 0xfe;
	CHECK(rig_scan(&rig) && bytes(AREA_Q)[0] == 0);
	for (unsigned missing = 0; missing < 8; missing++) {
		bytes(AREA_I)[1] = (uint8_t)~(1u << missing);
		rig_scan(&rig);
		CHECK(rig_get(&rig, "Main.Local") == 0);
	}
	bytes(AREA_I)[1] = 0xff;
	CHECK(rig_scan(&rig) && rig_get(&rig, "Main.Local") == 1);
	CHECK(rig_set(&rig, "M0", 1) && rig_set(&rig, "M1", 1) &&
	      rig_set(&rig, "M7", 1));
	CHECK(rig_scan(&rig) && bytes(AREA_Q)[0] == 0x80);
	CHECK(bytes(AREA_M)[0] == 0x83);
	CHECK(rig_set(&rig, "M0", 5));
	CHECK_AS(rig_get(&rig, "M0") == 1, "a BOOL set to 5 is 1");
}

/* A byte or word written from outside changes its bits. */
static void writes_wide(void)
{
	CHECK(rig_set(&rig, "%MB0", 0x82) && rig_get(&rig, "M0") == 0);
	CHECK(rig_scan(&rig) && rig_get(&rig, "Q7") == 0);
	CHECK_AS(rig_get(&rig, "%MB0") == 0x82, "a scan does not change %MB0");
	CHECK(rig_set(&rig, "%MD0", 0x83) && rig_scan(&rig));
	CHECK(rig_get(&rig, "Q7") == 1);
	CHECK(rig_set(&rig, "%IB0", 1) && rig_scan(&rig));
	CHECK(rig_get(&rig, "Motor") == 1);
	/* %MX5.0 is overlaid by %MW5: packed. */
	CHECK(rig_set(&rig, "%MW5", 1) && rig_scan(&rig));
	CHECK(rig_get(&rig, "%MW5") == 3 && rig_get(&rig, "Q3") == 0);
	CHECK(rig_set(&rig, "M42", 1) && rig_scan(&rig));
	CHECK(rig_get(&rig, "%MW5") == 7 && rig_get(&rig, "Q3") == 1);
}

static void finds_names(void)
{
	struct image *image = &rig.resource.image;
	struct location at;

	CHECK(rig_at(&rig, "motor").area == AREA_Q);
	CHECK(rig_at(&rig, "Q0").where == 0 && rig_at(&rig, "%QX9.1").where == 73);
	CHECK(rig_at(&rig, "Count").type == IEC_INT);
	CHECK(rig_at(&rig, "main.count").type == IEC_DINT);
	CHECK(rig_get(&rig, "Main.Count") == 3 && rig_get(&rig, "Count") == 0);
	CHECK(rig_at(&rig, "Delay.PT").type == IEC_TIME);
	CHECK(rig_at(&rig, "delay.q").type == IEC_BOOL);
	CHECK(rig_at(&rig, "SYS_FIRST_SCAN").area == AREA_SM);
	CHECK(rig_at(&rig, "SYS_ERRORS").type == IEC_DWORD);
	for (int i = 0; i < 10; i++) {
		static const char *const unknown[] = {
			"", "Mot", "Motors", "Delay", "Delay.", "Delay.start",
			"Delay.XX", "Main.", "Other.Count", "%QX512.0",
		};

		at = image_find(image, unknown[i], strlen(unknown[i]));
		CHECK_AS(at.type == IEC_NONE, unknown[i]);
	}
	at = image_find(image, "Motorbike", 5);
	CHECK_AS(at.area == AREA_Q,
		 "image_find() reads only the given length of the name");
}

static void lists_symbols(void)
{
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;
	int count = 0, pins = 0, shared = 0, constants = 0;

	while (image_next_symbol(&rig.resource.image, &cursor, &symbol)) {
		count++;
		pins += strncmp(symbol.name, "Delay.", 6) == 0;
		shared += strcmp(symbol.name, "Main.Count") == 0;
		constants += symbol.at.constant;
		if (!strcmp(symbol.name, "Delay.PT"))
			CHECK(symbol.is_input);
		if (!strcmp(symbol.name, "Delay.ET"))
			CHECK(!symbol.is_input);
	}
	CHECK(pins == 4 && shared == 1 && constants == 1 && count == 15);
}

static void keeps_limits(void)
{
	struct image *image = &rig.resource.image;
	struct location none = { .type = IEC_NONE };
	union iec_value one = { .i = 1 };

	CHECK(!image_set(image, none, one) && image_get(image, none).i == 0);
	CHECK(!rig_set(&rig, "Seven", 1) && rig_get(&rig, "Seven") == 7);
	CHECK(!rig_force(&rig, "Seven", 1) && !image_force(image, none, one));
	CHECK(!image_set_bit(image, AREA_Q, 512 * 8, true));
	CHECK(image_set_bit(image, AREA_Q, 512 * 8 - 1, true));
	CHECK(image_get_bit(image, AREA_Q, 512 * 8 - 1));
	CHECK(!image_get_bit(image, AREA_Q, 512 * 8));
	CHECK(!image_set_bit(image, AREA_NONE, 0, true));
	CHECK(!image_set_bit(image, AREA_COUNT, 0, true));
	CHECK(!rig_release(&rig, "Motor"));
	for (uint32_t i = 0; i < LIMIT_FORCES; i++) {
		struct location at = { .type = IEC_BOOL, .area = AREA_V, .where = i };

		if (!image_force(image, at, one))
			CHECK_AS(false, "LIMIT_FORCES variables can be forced");
	}
	CHECK_AS(!rig_force(&rig, "Motor", 1),
		 "no more than LIMIT_FORCES variables can be forced");
	CHECK_AS(rig_set(&rig, "V0", 0) && rig_force(&rig, "V0", 0),
		 "a forced variable takes a new value when all forces are used");
	for (uint32_t i = 0; i < LIMIT_FORCES; i++) {
		struct location at = { .type = IEC_BOOL, .area = AREA_V, .where = i };

		if (!image_unforce(image, at))
			CHECK_AS(false, "each force can be removed");
	}
	CHECK(image->force_count == 0);
}

static void forces_inputs(void)
{
	bytes(AREA_I)[0] = 0;
	CHECK(rig_force(&rig, "Go", 1) && rig_scan(&rig));
	CHECK(rig_get(&rig, "Motor") == 1 && rig_get(&rig, "SYS_FORCED_ANY"));
	CHECK(image_is_forced(&rig.resource.image, rig_at(&rig, "I0")));
	bytes(AREA_I)[0] = 0; /* the pin changes meanwhile */
	CHECK(rig_scan(&rig) && rig_get(&rig, "Motor") == 1);
	CHECK(rig_release(&rig, "Go") && rig_scan(&rig));
	CHECK(rig_get(&rig, "Motor") == 0 && !rig_get(&rig, "SYS_FORCED_ANY"));
	/* The value of the pin at the release, not at the force. */
	CHECK(rig_force(&rig, "Go", 0));
	bytes(AREA_I)[0] = 1;
	CHECK(rig_scan(&rig) && rig_get(&rig, "Motor") == 0);
	CHECK(rig_release(&rig, "Go") && rig_scan(&rig));
	CHECK(rig_get(&rig, "Motor") == 1);
	/* Eight at once. */
	bytes(AREA_I)[0] = 0;
	CHECK(rig_force(&rig, "%IB0", 1) && rig_scan(&rig));
	CHECK(rig_get(&rig, "Motor") == 1 && rig_release(&rig, "%IB0"));
	CHECK(rig_scan(&rig) && rig_get(&rig, "Motor") == 0);
}

static void forces_outputs(void)
{
	bytes(AREA_I)[0] = 0;
	CHECK(rig_force(&rig, "Motor", 1) && rig_scan(&rig));
	CHECK_AS(bytes(AREA_Q)[0] & 1, "the driver gets the forced value");
	bytes(AREA_I)[0] = 1;
	CHECK(rig_scan(&rig) && rig_force(&rig, "Motor", 0) && rig_scan(&rig));
	CHECK(!(bytes(AREA_Q)[0] & 1));
	CHECK_AS(rig_release(&rig, "Motor") && rig_get(&rig, "Motor") == 1,
		 "a released output has the value that the program wrote");
	CHECK(rig_force(&rig, "%QB0", 0x40) && rig_scan(&rig));
	CHECK_AS(bytes(AREA_Q)[0] == 0x40, "a forced byte of outputs reaches the driver");
	CHECK(rig_release(&rig, "%QB0") && rig_scan(&rig));
	CHECK(bytes(AREA_Q)[0] & 1);
}

static void forces_numbers(void)
{
	struct location heat = rig_at(&rig, "Heat");
	struct image *image = &rig.resource.image;

	CHECK(image_force(image, heat, (union iec_value){ .r = 0.1 }));
	CHECK(rig_scan(&rig) && rig_scan(&rig));
	CHECK(rig_real(&rig, "Heat") == (double)0.1f);
	CHECK(image_unforce(image, heat));
	CHECK_AS(rig_real(&rig, "Heat") == 1.5,
		 "a REAL forced to 0.1 has its own value after the release");
	CHECK(rig_set(&rig, "Count", 9) && rig_force(&rig, "Count", 70000));
	CHECK(rig_scan(&rig) && rig_get(&rig, "Count") == 4464);
	CHECK(rig_release(&rig, "Count") && rig_get(&rig, "Count") == 9);
	CHECK(rig_force(&rig, "Kept", 0) && rig_force(&rig, "Kept", 1));
	CHECK(rig_scan(&rig) && rig_force(&rig, "Kept", 0) && rig_scan(&rig));
	CHECK(rig_release(&rig, "Kept"));
	CHECK_AS(rig_get(&rig, "Kept") == 1,
		 "a release after two forces gives the value before the first");
	CHECK(rig_set(&rig, "M40", 0) && rig_set(&rig, "M41", 0));
	CHECK(rig_force(&rig, "%MX5.1", 1) && rig_scan(&rig));
	CHECK_AS(rig_get(&rig, "%MB5") & 2,
		 "a forced bit of a word of markers is seen in its byte");
	CHECK(rig_release(&rig, "M41") && !(rig_get(&rig, "%MB5") & 2));
}

int main(void)
{
	if (rig_open(&rig, bits, false)) {
		starts_cold();
		moves_bits_at_the_edges();
		writes_wide();
		finds_names();
		lists_symbols();
		keeps_limits();
		forces_inputs();
		forces_outputs();
		forces_numbers();
		resource_start(&rig.resource);
		CHECK_AS(rig.resource.image.force_count == 0 &&
			 rig_get(&rig, "Count") == 0, "a start removes all forces");
	}
	rig_close(&rig);
	return tap_done();
}
