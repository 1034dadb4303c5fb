/* SPDX-License-Identifier: MIT
 *
 * test_twin - a program and its plant: inputs that the plant sets, the order of scans,
 * state after a start, a stop and a fault; and a change of the program.
 */
#include "engine/trial/twin.h"
#include "tests/unit/rig.h"

#define PERIOD INT64_C(10000000)

static const char program[] =
	"RUNGBOARD 1\n"
	"VAR\n  Go AT %IX0.0 : BOOL;\n  End AT %IX0.1 : BOOL;\n  Out AT %QX0.0 : BOOL;\n"
	"  Level AT %AIW2 : INT;\n  Set AT %AQW0 : INT;\n  Loop AT %IX0.7 : BOOL;\n"
	"  Seen : INT;\nEND_VAR\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO Go | NC End | COIL Out |\n"
	"RUNG\n  | NO SYS_FIRST_SCAN | NO %IX2.2 | [ Seen := Level ] |\n"
	"RUNG\n  | --- | [ Set := Level + 1 ] |\n"
	"RUNG Again\n  | NO Loop | JMP Again |\n"
	"END_PROGRAM\n";
/* Declares Q0.1, uses Q2.2 in a coil, writes AQW2 without a name and Q3 by an index. */
static const char world[] =
	"RUNGBOARD 1\n"
	"VAR\n  Motor AT %IX0.0 : BOOL;\n  End AT %QX0.1 : BOOL;\n  Way : INT;\n"
	"  Told : INT;\n  i : INT := 2;\n  Row AT %QX4.0 : ARRAY[0..3] OF BOOL;\nEND_VAR\n"
	"PROGRAM World LD\n"
	"RUNG\n  | NO Motor | [ Way := Way + 1 ] |\n"
	"RUNG\n  | [ Way >= 3 ] | COIL End |\n"
	"RUNG\n  | NO SYS_ALWAYS_ON | COIL %QX2.2 |\n"
	"RUNG\n  | --- | [ %AQW2 := INT_TO_WORD(Way + 100) ] |\n"
	"RUNG\n  | --- | [ Told := WORD_TO_INT(%AIW0) ] |\n"
	"RUNG\n  | NO SYS_ALWAYS_ON | COIL Row[i] |\n"
	"END_PROGRAM\n";

static struct ladder *build(const char *text)
{
	struct ladder *ladder = ladder_new();

	ladder_watch(ladder, true);
	if (!CHECK_AS(ladder_load_text(ladder, "twin.rung", text, strlen(text)) &&
		      ladder_build(ladder), "the program builds"))
		rig_say_why(ladder);
	return ladder;
}

static int64_t get(const struct twin *twin, bool plant, const char *name)
{
	const struct image *image = plant ? &twin->plant.image : &twin->resource.image;

	return image_get(image, image_find(image, name, strlen(name))).i;
}

static bool do_act(struct twin *twin, enum act_kind kind, bool plant, const char *name,
		   int64_t value)
{
	const struct image *image = plant ? &twin->plant.image : &twin->resource.image;
	const struct act act = { .kind = kind, .plant = plant, .value.i = value,
				 .at = image_find(image, name, strlen(name)) };

	return twin_act(twin, &act);
}

static void scan(struct twin *twin, int count)
{
	while (count--)
		twin_scan(twin);
}

static void test_plant(void)
{
	struct ladder *ladder = build(program), *plant = build(world);
	struct twin twin;

	CHECK(twin_init(&twin, ladder_program(ladder), ladder_program(plant), PERIOD));
	CHECK(!twin_scan(&twin) && twin.scan == 0);
	CHECK(do_act(&twin, ACT_START, false, "", 0));
	CHECK(do_act(&twin, ACT_SET, false, "Go", 1));
	CHECK(do_act(&twin, ACT_SET, false, "%IX0.5", 1));
	CHECK(do_act(&twin, ACT_SET, false, "%IX4.7", 1));
	CHECK(twin_scan(&twin));
	/* The first scan sees inputs that the plant has set. */
	CHECK(get(&twin, false, "Seen") == 100 && get(&twin, false, "Out") == 1);
	CHECK(get(&twin, true, "Way") == 0);
	scan(&twin, 1);
	CHECK(get(&twin, true, "Way") == 1 && get(&twin, true, "Told") == 101);
	CHECK(get(&twin, false, "%IX4.2") == 1 && get(&twin, false, "%IX2.2") == 1);
	/* A person may set the inputs that the plant does not set. */
	CHECK(get(&twin, false, "%IX0.5") == 1 && get(&twin, false, "%IX4.7") == 1);
	CHECK(do_act(&twin, ACT_SET, false, "%IX2.2", 0));
	scan(&twin, 1);
	CHECK(get(&twin, false, "%IX2.2") == 1);
	scan(&twin, 1);
	CHECK(get(&twin, false, "Out") == 0 && get(&twin, true, "Way") == 3);
	CHECK(twin.scan == 4 && twin.now_ns == 4 * PERIOD);
	/* A force overrides the plant. */
	CHECK(do_act(&twin, ACT_FORCE, false, "End", 0));
	scan(&twin, 2);
	CHECK(get(&twin, false, "Out") == 1 && get(&twin, true, "Way") == 4);
	CHECK(do_act(&twin, ACT_FORCE, true, "Way", 1));
	CHECK(do_act(&twin, ACT_RELEASE_ALL, false, "", 0));
	scan(&twin, 5);
	CHECK(get(&twin, true, "Way") == 1 && get(&twin, false, "Out") == 1);
	twin_free(&twin);
	ladder_free(ladder);
	ladder_free(plant);
}

static void test_states(void)
{
	struct ladder *ladder = build(program), *plant = build(world);
	struct twin twin;

	CHECK(twin_init(&twin, ladder_program(ladder), ladder_program(plant), PERIOD));
	do_act(&twin, ACT_START, false, "", 0);
	do_act(&twin, ACT_SET, false, "Go", 1);
	do_act(&twin, ACT_FORCE, false, "Seen", 7);
	scan(&twin, 2);
	CHECK(do_act(&twin, ACT_STOP, false, "", 0));
	CHECK(!twin_scan(&twin) && twin.scan == 2 && get(&twin, false, "Out") == 0);
	CHECK(do_act(&twin, ACT_START, false, "", 0));
	/* A cold start keeps inputs and forces. */
	CHECK(get(&twin, false, "Go") == 1 && get(&twin, true, "Way") == 0);
	CHECK(twin_scan(&twin) && twin.scan == 3 && get(&twin, false, "Seen") == 7);
	CHECK(get(&twin, false, "Out") == 1);
	CHECK(do_act(&twin, ACT_SET, false, "Loop", 1));
	CHECK(!twin_scan(&twin) && twin.resource.state == STATE_FAULT && twin.scan == 4);
	CHECK(get(&twin, false, "Out") == 0 && get(&twin, false, "Set") == 0);
	do_act(&twin, ACT_SET, false, "Loop", 0);
	CHECK(do_act(&twin, ACT_START, false, "", 0) && twin_scan(&twin));
	CHECK(do_act(&twin, ACT_PERIOD, false, "", 3) && twin_scan(&twin) &&
	      twin.now_ns == 5 * PERIOD + 3);
	CHECK(!do_act(&twin, ACT_PERIOD, false, "", 0));
	CHECK(!do_act(&twin, ACT_SET, false, "Nobody", 0));
	CHECK(!do_act(&twin, ACT_RELEASE, false, "Go", 0));
	twin_free(&twin);
	ladder_free(ladder);
	ladder_free(plant);
}

/* Q0.1 is 1 in STOP; so are two outputs that the program does not use. */
static void test_safe(void)
{
	static const uint8_t safe[1024] = { 0x02, 0x81 };
	static char more[sizeof(program) + 128];
	struct ladder *ladder, *plant = build(world);
	struct twin twin, other;

	snprintf(more, sizeof(more), "%.*sVAR RETAIN\n  Kept AT %%QX1.0 : BOOL;\nEND_VAR\n"
		 "PROGRAM Main LD\nRUNG\n  | NO Out | COIL %%QX0.1 |\n%s",
		 (int)(strstr(program, "PROGRAM") - program), program,
		 strstr(program, "RUNG\n"));
	ladder = build(more);
	CHECK(ladder_program(ladder)->areas.bytes[AREA_Q] <= sizeof(safe) / 2);
	CHECK(twin_init(&twin, ladder_program(ladder), ladder_program(plant), PERIOD));
	CHECK(get(&twin, false, "%QX0.1") == 0);
	twin_set_safe(&twin, safe);
	CHECK(get(&twin, false, "Out") == 0 && get(&twin, false, "%QX0.1") == 1 &&
	      get(&twin, false, "%QX1.0") == 1 && get(&twin, false, "%QX1.7") == 1 &&
	      get(&twin, false, "%QX1.1") == 0);
	CHECK(do_act(&twin, ACT_START, false, "", 0) && twin_scan(&twin));
	CHECK_AS(get(&twin, false, "%QX0.1") == 0 && get(&twin, false, "%QX1.0") == 0,
		 "the first scan after a start has the outputs of the program");
	do_act(&twin, ACT_SET, false, "Go", 1);
	CHECK(do_act(&twin, ACT_FORCE, false, "%QX1.7", 0));
	scan(&twin, 2);
	CHECK(get(&twin, false, "Out") == 1 && get(&twin, false, "%QX0.1") == 1);
	CHECK(twin_clone(&other, &twin));
	CHECK(do_act(&twin, ACT_STOP, false, "", 0));
	CHECK(get(&twin, false, "Out") == 0 && get(&twin, false, "%QX0.1") == 1 &&
	      get(&twin, false, "Set") == 0);
	CHECK_AS(get(&twin, false, "%QX1.7") == 1, "a force has no effect in STOP");
	do_act(&other, ACT_SET, false, "Loop", 1);
	CHECK(!twin_scan(&other) && other.resource.state == STATE_FAULT);
	CHECK_AS(get(&other, false, "Out") == 0 && get(&other, false, "%QX1.0") == 1,
		 "a clone has the same safe outputs");
	CHECK(do_act(&other, ACT_SET, false, "Loop", 0));
	CHECK(do_act(&other, ACT_WARM, false, "", 0) && get(&other, false, "Kept") == 0);
	CHECK(twin_scan(&other) && do_act(&other, ACT_STOP, false, "", 0));
	twin_set_safe(&other, NULL);
	CHECK(get(&other, false, "%QX0.1") == 0 && get(&other, false, "%QX1.0") == 0);
	twin_free(&other);
	twin_free(&twin);
	ladder_free(ladder);
	ladder_free(plant);
}

/* Out holds its value in STOP and in FAULT. */
static void test_holds(void)
{
	struct ladder *ladder = build(program);
	const uint32_t bytes = ladder_program(ladder)->areas.bytes[AREA_Q];
	static uint8_t safe[1024];
	struct twin twin;

	CHECK(2 * bytes <= sizeof(safe));
	safe[0] = 0x02;
	safe[bytes] = 0x01;
	CHECK(twin_init(&twin, ladder_program(ladder), NULL, PERIOD));
	twin_set_safe(&twin, safe);
	CHECK(get(&twin, false, "Out") == 0 && get(&twin, false, "%QX0.1") == 1);
	CHECK(do_act(&twin, ACT_START, false, "", 0) && do_act(&twin, ACT_SET, false, "Go", 1));
	CHECK(twin_scan(&twin) && do_act(&twin, ACT_STOP, false, "", 0));
	CHECK_AS(get(&twin, false, "Out") == 1 && get(&twin, false, "%QX0.1") == 1,
		 "in STOP an output that holds has its last value");
	CHECK(do_act(&twin, ACT_START, false, "", 0) && do_act(&twin, ACT_SET, false, "Go", 1) &&
	      twin_scan(&twin) && do_act(&twin, ACT_SET, false, "Loop", 1) && !twin_scan(&twin));
	CHECK_AS(get(&twin, false, "Out") == 1, "and in FAULT");
	twin_free(&twin);
	ladder_free(ladder);
}

/* Only the controller lost power: the plant goes on. */
static void test_warm(void)
{
	struct ladder *ladder = build(program), *plant = build(world);
	struct twin twin;

	CHECK(twin_init(&twin, ladder_program(ladder), ladder_program(plant), PERIOD));
	CHECK(do_act(&twin, ACT_WARM, false, "", 0));
	CHECK_AS(twin.plant.state == STATE_RUN,
		 "a warm start also starts a plant that never ran");
	do_act(&twin, ACT_SET, false, "Go", 1);
	scan(&twin, 3);
	CHECK(get(&twin, true, "Way") == 2);
	CHECK(do_act(&twin, ACT_WARM, false, "", 0));
	CHECK(get(&twin, true, "Way") == 2 && get(&twin, false, "Seen") == 0);
	scan(&twin, 1);
	CHECK(get(&twin, false, "Seen") == 102);
	CHECK(do_act(&twin, ACT_STOP, false, "", 0) && twin.plant.state == STATE_STOP);
	CHECK(do_act(&twin, ACT_WARM, false, "", 0) && twin_scan(&twin));
	CHECK(twin.plant.state == STATE_RUN && get(&twin, true, "Way") == 2);
	scan(&twin, 1);
	CHECK(get(&twin, true, "Way") == 3);
	CHECK(do_act(&twin, ACT_START, false, "", 0) && get(&twin, true, "Way") == 0);
	twin_free(&twin);
	ladder_free(ladder);
	ladder_free(plant);
}

/* The program gets another rung; the plant keeps its state. */
static void test_change(void)
{
	static char more[sizeof(program) + 64];
	struct ladder *ladder = build(program), *plant = build(world), *edited;
	struct twin twin, next;

	snprintf(more, sizeof(more), "%.*sRUNG\n  | NO Out | COIL %%QX9.0 |\n%s",
		 (int)(strstr(program, "RUNG\n") - program), program,
		 strstr(program, "RUNG\n"));
	edited = build(more);
	CHECK(twin_init(&twin, ladder_program(ladder), ladder_program(plant), PERIOD));
	do_act(&twin, ACT_START, false, "", 0);
	do_act(&twin, ACT_SET, false, "Go", 1);
	scan(&twin, 3);
	CHECK(twin_init(&next, ladder_program(edited), ladder_program(plant), 1));
	CHECK(twin_change(&next, &twin));
	twin_free(&twin);
	ladder_free(ladder);
	CHECK(next.scan == 3 && next.period_ns == PERIOD && get(&next, true, "Way") == 2);
	scan(&next, 1);
	CHECK(get(&next, true, "Way") == 3 && get(&next, false, "%QX9.0") == 1 &&
	      get(&next, false, "Seen") == 100 && next.resource.scans == 4);
	twin_free(&next);
	ladder_free(edited);
	ladder_free(plant);
}

/* An edit in STOP: outputs follow the map for the new program. */
static void test_safe_change(void)
{
	static const uint8_t before[1024] = { 0x02 }, after[1024] = { 0x04 };
	struct ladder *ladder = build(program);
	struct twin twin, next;

	CHECK(twin_init(&twin, ladder_program(ladder), NULL, PERIOD));
	twin_set_safe(&twin, before);
	CHECK(twin_init(&next, ladder_program(ladder), NULL, PERIOD));
	CHECK(twin_change(&next, &twin));
	twin_set_safe(&next, after);
	CHECK(get(&next, false, "%QX0.1") == 0 && get(&next, false, "%QX0.2") == 1);
	CHECK(do_act(&next, ACT_START, false, "", 0) && twin_scan(&next));
	twin_set_safe(&next, before);
	CHECK_AS(get(&next, false, "%QX0.1") == 0, "safe outputs have no effect in RUN");
	twin_free(&twin);
	twin_free(&next);
	ladder_free(ladder);
}

int main(void)
{
	test_safe_change();
	test_plant();
	test_states();
	test_holds();
	test_safe();
	test_warm();
	test_change();
	return tap_done();
}
