/* SPDX-License-Identifier: MIT
 *
 * test_session - a session becomes a scenario that does the same: random clicks on all
 * samples; all expectations pass when it is run, and each fails when it is inverted.
 * Run it from the root of the tree.
 */
#include "engine/base/file.h"
#include "engine/ladder.h"
#include "engine/trial/scenario.h"
#include "engine/trial/session.h"
#include "engine/trial/value.h"
#include "tests/tap.h"
#include "tests/unit/trial.h"

#include <glob.h>

#define SESSIONS 12 /* for each sample                                         */
#define SCANS    400
#define NAMES    400

static uint32_t seed;

static uint32_t chance(uint32_t of)
{
	seed = seed * 1664525 + 1013904223;
	return (seed >> 8) % of;
}

/* ---- text of a scenario ---- */

static const char *write_of(struct session *session, const char *name)
{
	static struct sink_memory memory;
	struct sink out;

	sink_memory_free(&memory);
	sink_memory_init(&memory);
	out = sink_to_memory(&memory);
	CHECK(session_write(session, name, &out));
	return sink_memory_text(&memory);
}

static struct location place(const struct image *image, const char *name)
{
	enum diag_id why;

	return value_find(image, name, strlen(name), &why);
}

static struct act setting(const struct image *image, const char *name, int64_t value)
{
	return (struct act){ .kind = ACT_SET, .at = place(image, name),
			     .value.i = value };
}

static void test_text(void)
{
	struct bed bed;
	const struct image *image = &bed.resource.image;
	struct session *session;
	struct act act = { .kind = ACT_START };

	CHECK(bed_open(&bed));
	session = session_new(image, 10000000);
	CHECK(session_act(session, 0, &act));
	act = setting(image, "Open", 1);
	CHECK(session_act(session, 0, &act));
	CHECK(session_expect(session, 1, place(image, "Motor"), (union iec_value){ .i = 1 }));
	act = setting(image, "Level", -5);
	CHECK(session_act(session, 149, &act));
	act = setting(image, "Wait", 1500000000);
	CHECK(session_act(session, 149, &act));
	act = (struct act){ .kind = ACT_SET, .at = place(image, "Heat"), .value.r = 0.25 };
	CHECK(session_act(session, 149, &act));
	CHECK(session_expect(session, 150, place(image, "%QX0.5"), (union iec_value){ .i = 0 }));
	CHECK(session_expect(session, 150, place(image, "Delay.ET"),
			     (union iec_value){ .i = 30000000 }));
	CHECK(session_acts(session) == 4 && session_expects(session) == 3);
	CHECK_TEXT(write_of(session, "two \"words\"\n"),
		   "scenario \"two 'words' \"\n"
		   "  period 10ms\n"
		   "  at 10ms       Open = 1\n"
		   "                expect Motor = 1\n"
		   "  at 1s500ms    Level = -5, Wait = T#1s500ms, Heat = 0.25\n"
		   "                expect %QX0.5 = 0, Delay.ET = T#30ms\n");
	session_free(session);
	bed_close(&bed);
}

/* Acts that a scenario cannot express. */
static void test_refused(void)
{
	static const struct act acts[] = {
		{ .kind = ACT_FORCE }, { .kind = ACT_RELEASE }, { .kind = ACT_RELEASE_ALL },
		{ .kind = ACT_WARM }, { .kind = ACT_STOP }, { .kind = ACT_START },
		{ .kind = ACT_PERIOD, .value.i = 7 }, { .kind = ACT_SET, .plant = true },
		{ .kind = ACT_SET },
	};
	struct bed bed;
	struct session *session;
	struct act act;

	CHECK(bed_open(&bed));
	session = session_new(&bed.resource.image, 10000000);
	act = setting(&bed.resource.image, "Open", 1);
	CHECK(session_act(session, 0, &act));
	for (size_t i = 0; i < sizeof(acts) / sizeof(acts[0]); i++)
		CHECK(!session_act(session, 0, &acts[i]));
	act = (struct act){ .kind = ACT_PERIOD, .value.i = 10000000 };
	CHECK(session_act(session, 5, &act));
	CHECK(!session_expect(session, 0, act.at, act.value));
	CHECK(!session_expect(session, 1, place(&bed.resource.image, "Heat"),
			      (union iec_value){ .r = 0.0 / (chance(1) + 0.0) }));
	CHECK(session_acts(session) == 1 && session_expects(session) == 0);
	session_free(session);
	bed_close(&bed);
}

/* ---- random sessions ---- */

struct places {
	struct { struct location at; bool input; } one[NAMES];
	int count;
};

static bool is_input(const struct image *image, struct location at)
{
	return at.area == AREA_I || (at.area == AREA_NONE && areas_find(
		&image->program->areas, at.where) == AREA_AI);
}

static void find_names(const struct image *image, struct places *names)
{
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;

	names->count = 0;
	while (names->count < NAMES && image_next_symbol(image, &cursor, &symbol)) {
		if (symbol.flags & SYMBOL_HIDDEN || symbol.at.type == IEC_NONE)
			continue;
		names->one[names->count].at = symbol.at;
		names->one[names->count++].input = is_input(image, symbol.at);
	}
}

static union iec_value any_value(struct location at, struct iec_text *room)
{
	const struct iec_type_row *row = iec_type_row(at.type);
	union iec_value value = { .i = chance(2) };

	if (row->class == CLASS_REAL)
		value.r = ((int)chance(4000) - 2000) / 16.0;
	else if (row->class & (CLASS_BITS | CLASS_UNSIGNED | CLASS_SIGNED))
		value.i = chance(row->size == 1 ? 100 : 20000);
	else if (row->class & (CLASS_TIME | CLASS_TOD))
		value.i = (int64_t)chance(3000) * 1000001;
	else if (row->class & (CLASS_DATE | CLASS_DT))
		value.i = (int64_t)chance(3000) * INT64_C(86400000000000);
	else if (at.type == IEC_STRING)
		value.s = iec_text_init(room, 0);
	return value;
}

/* Mostly inputs; sometimes any variable, also of a timer. */
static void click(struct session *session, struct twin *twin, const struct places *names)
{
	const int which = (int)chance((uint32_t)names->count);
	struct act act = { .kind = ACT_SET, .at = names->one[which].at };
	struct iec_text room;

	if (act.at.constant || (!names->one[which].input && chance(20)))
		return;
	act.value = any_value(act.at, &room);
	if (session_act(session, twin->scan, &act))
		CHECK_AS(twin_act(twin, &act), "a recorded act can be done");
}

static void expect(struct session *session, struct twin *twin, const struct places *names)
{
	const struct location at = names->one[chance((uint32_t)names->count)].at;

	session_expect(session, twin->scan, at, image_get(&twin->resource.image, at));
}

static struct session *play(struct twin *twin, const struct places *names)
{
	static const int64_t periods[] = { 10000000, 1000000, 12345678, 100000000 };
	struct session *session;
	const struct act start = { .kind = ACT_START };

	twin->period_ns = periods[chance(4)];
	session = session_new(&twin->resource.image, twin->period_ns);
	twin_act(twin, &start);
	while (twin->scan < SCANS) {
		for (uint32_t n = chance(4); n > 1; n--)
			click(session, twin, names);
		if (!twin_scan(twin))
			break;
		for (uint32_t n = chance(6); n > 4; n--)
			expect(session, twin, names);
	}
	return session;
}

/* ---- played again ---- */

struct replay_acts {
	struct twin *twin;
	int count;
};

static void do_again(void *context, uint64_t after, const struct act *act)
{
	(void)after;
	(void)act;
	((struct replay_acts *)context)->count++;
}

/* 0: it passes; else the line that fails. -1: it cannot be read. */
static int run_text(const char *text, const struct program *program, uint64_t *scan)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	void *memory = calloc(1, image_memory_size(program));
	struct resource *resource = calloc(1, sizeof(*resource));
	struct sink_memory report;
	struct sink out;
	struct scenario_file file;
	struct arena arena;
	int line = -1;

	diag_init(diags);
	arena_init(&arena);
	sink_memory_init(&report);
	out = sink_to_memory(&report);
	resource_init(resource, program, memory);
	if (scenario_read("s.scn", text, strlen(text), &resource->image, NULL,
			  (struct formula_projects){ NULL, NULL }, &arena, &file,
			  diags)) {
		const bool held = scenario_run(&file, 0, resource, NULL, &out);

		line = file.scenario[0].failed_line;
		*scan = file.scenario[0].failed_scan;
		if (held != (line == 0))
			line = -1;
	} else {
		printf("# %s:%d %s %s\n", diag_code(diags->diag[0].id), diags->diag[0].line,
		       diag_text(diags->diag[0].id), diags->diag[0].arg);
	}
	sink_memory_free(&report);
	arena_free(&arena);
	free(resource);
	free(memory);
	free(diags);
	return line;
}

/* The acts of the scenario lead to the same state as the session. */
static bool same_end(const char *text, const struct twin *there)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	struct scenario_file file;
	struct replay_acts acts = { 0 };
	struct arena arena;
	struct twin twin;
	bool same = false;

	diag_init(diags);
	arena_init(&arena);
	twin_init(&twin, there->resource.image.program, NULL, 1);
	if (scenario_read("s.scn", text, strlen(text), &twin.resource.image, NULL,
			  (struct formula_projects){ NULL, NULL }, &arena, &file,
			  diags)) {
		scenario_each_act(&file, 0, &twin, there->scan, do_again, &acts);
		same = twin.scan == there->scan && twin.now_ns == there->now_ns &&
		       memcmp(twin.resource.image.memory, there->resource.image.memory,
			      twin.memory_size) == 0;
	}
	twin_free(&twin);
	arena_free(&arena);
	free(diags);
	return same;
}

/* Inverts one expectation of a BOOL. @line: gets its line. */
static char *falsified(const char *text, int *line)
{
	char *wrong = malloc(strlen(text) + 1), *at = wrong, *found = NULL;

	memcpy(wrong, text, strlen(text) + 1);
	*line = 1;
	for (int count = 1; (at = strstr(at, "expect ")); at++) {
		char *end = at + strcspn(at, ",\n");

		if ((end[-1] == '0' || end[-1] == '1') && end[-2] == ' ' &&
		    chance((uint32_t)count++) == 0)
			found = end - 1;
	}
	for (char *c = wrong; found && c < found; c++)
		*line += *c == '\n';
	if (found)
		*found = *found == '0' ? '1' : '0';
	if (!found) {
		free(wrong);
		wrong = NULL;
	}
	return wrong;
}

static void one_session(const char *path, const struct program *program,
			const struct places *names, int *falses)
{
	struct session *session;
	struct twin twin;
	uint64_t scan;
	const char *text;
	char *wrong;
	int line, found;

	twin_init(&twin, program, NULL, 1);
	session = play(&twin, names);
	text = write_of(session, path);
	if (session_expects(session)) {
		found = run_text(text, program, &scan);
		if (!CHECK_AS(found == 0, path))
			printf("# %s\n", text);
		CHECK_AS(twin.resource.state != STATE_RUN || same_end(text, &twin),
			 "the acts of the scenario lead to the same memory");
		wrong = falsified(text, &line);
		if (wrong) {
			found = run_text(wrong, program, &scan);
			CHECK_AS(found == line, "a wrong expectation fails");
			*falses += found == line;
		}
		free(wrong);
	}
	session_free(session);
	twin_free(&twin);
}

static void test_sample(const char *path, int *falses)
{
	struct ladder *ladder = ladder_new();
	struct places *names = calloc(1, sizeof(*names));
	void *memory;
	struct image *image = calloc(1, sizeof(*image));

	if (CHECK_AS(ladder_load(ladder, path) && ladder_build(ladder), path)) {
		memory = calloc(1, image_memory_size(ladder_program(ladder)));
		image_init(image, ladder_program(ladder), memory);
		find_names(image, names);
		for (int i = 0; i < tap_rounds(SESSIONS); i++)
			one_session(path, ladder_program(ladder), names, falses);
		free(memory);
	}
	free(image);
	free(names);
	ladder_free(ladder);
}

int main(void)
{
	glob_t found;
	int falses = 0;

	test_text();
	test_refused();
	if (CHECK(glob("ladders/*.rung", 0, NULL, &found) == 0)) {
		for (size_t i = 0; i < found.gl_pathc; i++)
			test_sample(found.gl_pathv[i], &falses);
		globfree(&found);
	}
	CHECK(falses > 20);
	return tap_done();
}
