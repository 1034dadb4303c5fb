/* SPDX-License-Identifier: MIT
 *
 * test_shadow - a converted program shown with the values of the one that runs has, in each of its cells and lines, the
 * power that it has when it runs by itself from the first scan on.
 */
#include "engine/trial/shadow.h"
#include "tests/unit/rig.h"
#include "tests/walker/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PERIOD INT64_C(10000000)
#define SCANS 40
#define TEXT_MAX (256 * 1024)

static struct ladder *build(const char *text, size_t len)
{
	struct ladder *ladder = ladder_new();

	ladder_watch(ladder, true);
	ladder_watch_lists(ladder, true);
	if (ladder_load_text(ladder, "shadow.rung", text, len) && ladder_build(ladder))
		return ladder;
	ladder_free(ladder);
	return NULL;
}

/* The same program with its POUs in another language; NULL: it is refused. */
static struct ladder *convert(struct ladder *from, enum pou_language to)
{
	static struct diag_list diags;
	const struct project *project = ladder_project(from);
	uint8_t *wanted = calloc((size_t)project->pou_count + 1, 1);
	struct ladder *out = NULL;
	char *text;
	size_t len;

	for (int i = 0; i < project->pou_count; i++)
		wanted[i] = project->pou[i].language != to;
	diag_init(&diags);
	text = ladder_export_as(from, wanted, to, &len, &diags);
	if (text)
		out = build(text, len);
	free(text);
	free(wanted);
	return out;
}

static void set_inputs(struct twin *twin, struct random_source *source)
{
	for (uint32_t bit = 0; bit < 32; bit++)
		if (random_chance(source, 20))
			image_set_bit(&twin->resource.image, AREA_I, bit, random_chance(source, 50));
}

static bool is_line(const struct code_power *at)
{
	return at->col == CODE_LINE || at->col == CODE_LISTED;
}

/* The number of the first place of power or results that differs, from 1; 0: none. */
static uint32_t differs(const struct program *program, const uint8_t *a, const uint8_t *b)
{
	for (uint32_t i = 0; i < program->power_count; i++) {
		const struct code_power *at = &program->power[i];

		/* A line that has not run keeps an old result. */
		if (a[at->in] != b[at->in] || ((a[at->in] || !is_line(at)) && a[at->out] != b[at->out]))
			return i + 1;
	}
	return 0;
}

static bool say(const struct program *program, uint32_t number, uint64_t seed, int scan)
{
	const struct code_power *at = &program->power[number - 1];

	printf("# seed %llu, scan %d: %s, rung %u (%u,%u)\n", (unsigned long long)seed, scan,
	       program->string + program->entry[at->pou].name, at->rung, at->row, at->col);
	return false;
}

/* @first: the scan that the shadow begins with. */
static bool follow(const struct program *runs, const struct program *shown, uint64_t seed, int first)
{
	struct twin twin, before, alone;
	struct shadow *shadow = shadow_new(shown, runs, NULL);
	struct random_source source, same;
	const struct act start = { .kind = ACT_START };
	bool good = true;

	good = (shadow && twin_init(&twin, runs, NULL, PERIOD) && twin_clone(&before, &twin) &&
		twin_init(&alone, shown, NULL, PERIOD));
	random_seed(&source, seed + 1);
	random_seed(&same, seed + 1);
	for (int scan = 1; scan <= SCANS && good; scan++) {
		uint32_t place;

		twin_copy(&before, &twin);
		if (scan == 1)
			good = twin_act(&twin, &start) && twin_act(&alone, &start);
		set_inputs(&twin, &source);
		set_inputs(&alone, &same);
		if (!twin_scan(&twin) || !twin_scan(&alone))
			break; /* a loop without an end, or STOP */
		if (scan < first)
			continue;
		shadow_scan(shadow, &before, &twin);
		place = differs(shown, shadow_resource(shadow)->image.memory, alone.resource.image.memory);
		/* The second scan knows what edges remember. */
		if (place && scan > (first > 1 ? first : 0))
			good = say(shown, place, seed, scan);
	}
	shadow_free(shadow);
	twin_free(&twin);
	twin_free(&before);
	twin_free(&alone);
	return good;
}

static void test_random(void)
{
	static struct random_program program;
	static char text[TEXT_MAX];
	const uint64_t programs = (uint64_t)tap_rounds(300);
	uint64_t networks = 0, ladders = 0;
	int bad = 0;

	for (uint64_t seed = 1; seed <= programs; seed++) {
		struct ladder *one, *two, *three;
		size_t len;

		random_make(&program, seed);
		len = random_print(&program, text, sizeof(text));
		one = build(text, len);
		two = one ? convert(one, LANGUAGE_FBD) : NULL;
		three = two ? convert(two, LANGUAGE_LD) : NULL;
		if (two && !follow(ladder_program(one), ladder_program(two), seed, 1))
			bad++;
		if (three && !follow(ladder_program(two), ladder_program(three), seed, 1))
			bad++;
		networks += two != NULL;
		ladders += three != NULL;
		ladder_free(one);
		ladder_free(two);
		ladder_free(three);
	}
	printf("# %d as networks, %d as ladders again\n", (int)networks, (int)ladders);
	CHECK(networks > programs / 3 && ladders > programs / 6);
	CHECK_AS(bad == 0, "each cell and line has the power that it has when the program runs by itself");
}

static const char plain[] =
	"RUNGBOARD 1\n"
	"VAR\n  Go AT %IX0.0 : BOOL;\n  Stop AT %IX0.1 : BOOL;\n  Motor AT %QX0.0 : BOOL;\n  Late AT %QX0.1 : BOOL;\n"
	"  Seen AT %MX0.0 : BOOL;\n  Count : INT;\n  Delay : TON;\n  Turns : CTU;\nEND_VAR\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO Go | NC Stop | COIL Motor |\n  | NO Motor ^|\n"
	"RUNG\n  | NO Motor | TON Delay PT:=T#50ms | COIL Late |\n"
	"RUNG\n  | P Go | [ Count := Count + 1 ] |\n"
	"RUNG\n  | N Motor | CTU Turns PV:=3 R:=Stop | COIL Seen |\n"
	"END_PROGRAM\n";
static const char chart[] =
	"RUNGBOARD 1\n"
	"VAR\n  Go AT %IX0.0 : BOOL;\n  Lamp AT %QX0.0 : BOOL;\n  Horn AT %QX0.1 : BOOL;\nEND_VAR\n"
	"PROGRAM Way SFC\n  INITIAL_STEP Start:\n  END_STEP\n  STEP Run:\n    Lamp(N);\n    Horn(D, T#30ms);\n  END_STEP\n"
	"  TRANSITION FROM Start TO Run := Go; END_TRANSITION\n"
	"  TRANSITION FROM Run TO Start := NOT Go; END_TRANSITION\nEND_PROGRAM\n";
/* Without times, which begin anew with the shadow. */
static const char lamp[] =
	"RUNGBOARD 1\n"
	"VAR\n  Go AT %IX0.0 : BOOL;\n  Lamp AT %QX0.0 : BOOL;\nEND_VAR\n"
	"PROGRAM Way SFC\n  INITIAL_STEP Start:\n  END_STEP\n  STEP Run:\n    Lamp(N);\n  END_STEP\n"
	"  TRANSITION FROM Start TO Run := Go; END_TRANSITION\n"
	"  TRANSITION FROM Run TO Start := NOT Go; END_TRANSITION\nEND_PROGRAM\n";

static void test_samples(void)
{
	struct ladder *one = build(plain, strlen(plain)), *two = convert(one, LANGUAGE_FBD), *three = convert(two, LANGUAGE_LD);
	struct ladder *steps = build(chart, strlen(chart)), *ladders = convert(steps, LANGUAGE_LD);
	struct ladder *plain_steps = build(lamp, strlen(lamp)), *lamps = convert(plain_steps, LANGUAGE_LD);

	CHECK(two && three && ladders);
	for (uint64_t seed = 1; seed <= 20; seed++) {
		CHECK_AS(follow(ladder_program(one), ladder_program(two), seed, 1) &&
			 follow(ladder_program(two), ladder_program(three), seed, 1), "from the first scan on");
		CHECK_AS(follow(ladder_program(one), ladder_program(two), seed, 10) &&
			 follow(ladder_program(two), ladder_program(three), seed, 10), "from a later scan on");
		CHECK_AS(follow(ladder_program(steps), ladder_program(ladders), seed, 1), "steps of a chart are bits");
		CHECK_AS(follow(ladder_program(plain_steps), ladder_program(lamps), seed, 10), "also of one that runs already");
	}
	ladder_free(one);
	ladder_free(two);
	ladder_free(three);
	ladder_free(steps);
	ladder_free(ladders);
	ladder_free(plain_steps);
	ladder_free(lamps);
}

/* The chart has left its first step; then a scan before that is shown. */
static void test_jump(void)
{
	struct ladder *steps = build(lamp, strlen(lamp)), *lamps = convert(steps, LANGUAGE_LD);
	const struct act start = { .kind = ACT_START };
	struct twin at[6], before;
	struct shadow *shadow = shadow_new(ladder_program(lamps), ladder_program(steps), NULL);
	const struct image *image = &shadow_resource(shadow)->image;

	CHECK(shadow && twin_init(&at[0], ladder_program(steps), NULL, PERIOD) && twin_clone(&before, &at[0]));
	CHECK(twin_act(&at[0], &start));
	for (int i = 1; i < 6; i++) {
		CHECK(twin_clone(&at[i], &at[i - 1]));
		twin_copy(&at[i], &at[i - 1]);
		image_set_bit(&at[i].resource.image, AREA_I, 0, i >= 4);
		CHECK(twin_scan(&at[i]));
		twin_copy(&before, &at[i - 1]);
		CHECK(shadow_scan(shadow, &before, &at[i]));
	}
	CHECK(image_get(image, image_find(image, "Run_X", 5)).i == 1 && image_get(image, image_find(image, "Start_X", 7)).i == 0);
	shadow_jump(shadow, &at[2]);
	CHECK_AS(image_get(image, image_find(image, "Run_X", 5)).i == 0 && image_get(image, image_find(image, "Start_X", 7)).i == 1,
		 "after a jump, the steps are those of that scan");
	shadow_free(shadow);
	for (int i = 0; i < 6; i++)
		twin_free(&at[i]);
	twin_free(&before);
	ladder_free(steps);
	ladder_free(lamps);
}

static struct location find(const struct resource *resource, const char *name)
{
	return image_find(&resource->image, name, strlen(name));
}

static int64_t get(const struct resource *resource, const char *name)
{
	return image_get(&resource->image, find(resource, name)).i;
}

/* Power at both ends of a cell of Main. */
static int power(const struct shadow *shadow, uint32_t rung, uint32_t row, uint32_t col)
{
	bool in = false, out = false;

	resource_power(shadow_resource(shadow), 0, rung, row, col, &in, &out);
	return 2 * in + out;
}

/* What a block remembers is not known: a board does not send it. */
static void test_still(void)
{
	struct ladder *one = build(plain, strlen(plain)), *two = convert(one, LANGUAGE_FBD), *three = convert(two, LANGUAGE_LD);
	const struct act start = { .kind = ACT_START };
	struct twin twin;
	struct shadow *shadow = shadow_new(ladder_program(three), ladder_program(two), "Main");

	CHECK(shadow && twin_init(&twin, ladder_program(two), NULL, PERIOD) && twin_act(&twin, &start));
	image_set_bit(&twin.resource.image, AREA_I, 0, true);
	for (int i = 0; i < 10; i++)
		twin_scan(&twin);
	CHECK(get(&twin.resource, "Late") == 1 && get(&twin.resource, "Count") == 1);
	/* Only values are known: the inner state of the instance is not. */
	twin.resource.vm.now_ns = twin.now_ns;
	CHECK(shadow_scan(shadow, NULL, &twin));
	CHECK(power(shadow, 1, 1, 1) == 3 && power(shadow, 1, 1, 2) == 3 && power(shadow, 1, 2, 1) == 3);
	CHECK(power(shadow, 2, 1, 2) == 3);
	CHECK(power(shadow, 3, 1, 1) == 2);
	CHECK(get(shadow_resource(shadow), "Count") == 1 && get(shadow_resource(shadow), "Late") == 1);
	CHECK(get(shadow_resource(shadow), "Delay.ET") == get(&twin.resource, "Delay.ET"));
	image_set_bit(&twin.resource.image, AREA_I, 1, true);
	twin_scan(&twin);
	shadow_values(shadow, &twin);
	CHECK(power(shadow, 1, 1, 2) == 3 && get(shadow_resource(shadow), "Motor") == 0);
	CHECK(shadow_scan(shadow, NULL, &twin));
	CHECK(power(shadow, 1, 1, 2) == 2 && power(shadow, 2, 1, 2) == 0);
	shadow_free(shadow);
	twin_free(&twin);
	ladder_free(one);
	ladder_free(two);
	ladder_free(three);
}

static void test_places(void)
{
	static const char text[] =
		"RUNGBOARD 1\nVAR\n  Go AT %IX0.0 : BOOL;\n  Level AT %IW2 : INT;\n  List : ARRAY[1..3] OF INT;\n"
		"  Delay : TON;\nEND_VAR\n"
		"PROGRAM Main LD\nVAR\n  Inner : BOOL;\nEND_VAR\nRUNG\n  | NO Go | TON Delay PT:=T#1s | COIL Inner |\n"
		"RUNG\n  | [ Level > 5 ] | NO Inner | NOT | [ List[2] := Level ] |\n  | NO Go        ^|\nEND_PROGRAM\n";
	static const char *const names[] = { "Go", "Level", "List[1]", "List[3]", "Delay.Q", "Delay.ET", "Main.Inner", "%MX3.1" };
	struct ladder *one = build(text, strlen(text)), *two = convert(one, LANGUAGE_FBD);
	struct shadow *shadow = shadow_new(ladder_program(two), ladder_program(one), NULL);
	struct twin twin;

	CHECK(shadow && twin_init(&twin, ladder_program(one), NULL, PERIOD));
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
		const struct location at = shadow_place(shadow, find(shadow_resource(shadow), names[i]));
		const struct location of = find(&twin.resource, names[i]);

		CHECK_AS(at.type == of.type && at.area == of.area && at.where == of.where, names[i]);
	}
	CHECK(shadow_place(shadow, (struct location){ .type = IEC_NONE }).type == IEC_NONE);
	shadow_free(shadow);
	twin_free(&twin);
	ladder_free(one);
	ladder_free(two);
}

int main(void)
{
	test_samples();
	test_jump();
	test_still();
	test_places();
	test_random();
	return tap_done();
}
