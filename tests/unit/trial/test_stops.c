/* SPDX-License-Identifier: MIT
 *
 * test_stops - breakpoints and steps: the lines before which a program stands, in every kind of
 * statement; what it called; conditions; values in mid-scan; and that nothing else changes.
 */
#include "engine/trial/stops.h"
#include "engine/trial/formula.h"
#include "tests/unit/rig.h"

#include <stdio.h>

#define PERIOD INT64_C(10000000)

struct bench {
	struct ladder *ladder;
	struct twin twin;
	struct stops *stops;
};

static void open_bench(struct bench *bench, const char *text)
{
	const struct act start = { .kind = ACT_START };

	memset(bench, 0, sizeof(*bench));
	bench->ladder = ladder_new();
	ladder_watch(bench->ladder, true);
	ladder_watch_lists(bench->ladder, true);
	if (!CHECK_AS(ladder_load_text(bench->ladder, "stops.rung", text, strlen(text)) &&
		      ladder_build(bench->ladder), "the program builds"))
		rig_say_why(bench->ladder);
	CHECK(twin_init(&bench->twin, ladder_program(bench->ladder), NULL, PERIOD));
	CHECK(twin_act(&bench->twin, &start));
	bench->stops = stops_new(ladder_program(bench->ladder));
}

static void close_bench(struct bench *bench)
{
	stops_free(bench->stops);
	twin_free(&bench->twin);
	ladder_free(bench->ladder);
}

static int64_t get(const struct bench *bench, const char *name)
{
	const struct image *image = &bench->twin.resource.image;

	return image_get(image, image_find(image, name, strlen(name))).i;
}

static bool set(struct bench *bench, const char *name, int64_t value)
{
	const struct image *image = &bench->twin.resource.image;
	const struct act act = { .kind = ACT_SET, .value.i = value,
				 .at = image_find(image, name, strlen(name)) };

	return stops_act(bench->stops, &bench->twin, &act);
}

/* The POU at its place in the image. */
static uint32_t pou_of(const struct bench *bench, const char *name)
{
	const struct program *program = ladder_program(bench->ladder);

	for (uint32_t i = 0; i < program->entry_count; i++)
		if (strcmp(program->string + program->entry[i].name, name) == 0)
			return i;
	return UINT32_MAX;
}

static bool add(struct bench *bench, const char *pou, uint32_t line)
{
	return stops_add(bench->stops, pou_of(bench, pou), line, NULL, NULL, false);
}

static uint32_t line_of(const struct bench *bench)
{
	struct stops_frame frame[LIMIT_CALLS + 1];

	return stops_stack(bench->stops, &bench->twin, frame) ? frame[0].at.line : 0;
}

/* "5 6 8" : the lines of one scan, step by step; it must not stand at its end. */
static const char *lines(struct bench *bench, enum stops_step step)
{
	static char out[400];
	size_t used = 0;

	out[0] = '\0';
	stops_scan(bench->stops, &bench->twin, step);
	while (bench->twin.resource.stopped && used < sizeof(out) - 8) {
		used += (size_t)snprintf(out + used, sizeof(out) - used, "%s%u", used ? " " : "",
					 line_of(bench));
		stops_scan(bench->stops, &bench->twin, step);
	}
	return out;
}

static bool are(const char *got, const char *wanted)
{
	if (strcmp(got, wanted) == 0)
		return true;
	printf("# %s, wanted %s\n", got, wanted);
	return false;
}

/* ---- kinds of statements ---- */

static const char kinds[] =
	"RUNGBOARD 1\n"                     /* 1 */
	"PROGRAM Main ST\n"
	"  VAR\n"
	"    i, a, n, k : INT;\n"
	"  END_VAR\n"                       /* 5 */
	"  n := n + 1;\n"
	"  IF n = 1 THEN\n"
	"    a := 1;\n"
	"  ELSIF n = 2 THEN\n"
	"    a := 2;\n"                     /* 10 */
	"  ELSE\n"
	"    a := 3;\n"
	"  END_IF;\n"
	"  CASE n OF\n"
	"    1: a := 10;\n"                 /* 15 */
	"    2, 3..5:\n"
	"      a := 20;\n"
	"    ELSE\n"
	"      a := 30;\n"
	"  END_CASE;\n"                     /* 20 */
	"  FOR i := 1 TO 5 DO\n"
	"    IF i = 2 THEN\n"
	"      CONTINUE;\n"
	"    END_IF;\n"
	"    IF i = 3 THEN\n"               /* 25 */
	"      EXIT;\n"
	"    END_IF;\n"
	"  END_FOR;\n"
	"  k := 0;\n"
	"  WHILE k < 2 DO\n"                /* 30 */
	"    k := k + 1;\n"
	"  END_WHILE;\n"
	"  REPEAT\n"
	"    k := k - 1;\n"
	"  UNTIL k = 0\n"                   /* 35 */
	"  END_REPEAT;\n"
	"  IF n = 3 THEN\n"
	"    RETURN;\n"
	"  END_IF;\n"
	"  a := a +\n"                      /* 40 */
	"       ABS(k);\n"
	"END_PROGRAM\n";

static void test_kinds(void)
{
	struct bench bench;
	const char *loops = "21 22 25 28 22 23 28 22 25 26 29 30 31 30 31 30 34 35 34 35 37";
	char wanted[200];

	open_bench(&bench, kinds);
	snprintf(wanted, sizeof(wanted), "6 7 8 14 15 %s 40", loops);
	CHECK_AS(are(lines(&bench, STOPS_INTO), wanted), "IF, the first choice, loops");
	CHECK(get(&bench, "Main.a") == 10 && bench.twin.scan == 1);
	snprintf(wanted, sizeof(wanted), "6 7 9 10 14 17 %s 40", loops);
	CHECK_AS(are(lines(&bench, STOPS_INTO), wanted), "ELSIF, a choice with several values");
	snprintf(wanted, sizeof(wanted), "6 7 9 12 14 17 %s 38", loops);
	CHECK_AS(are(lines(&bench, STOPS_INTO), wanted), "ELSE, RETURN");
	CHECK(set(&bench, "Main.n", 8));
	snprintf(wanted, sizeof(wanted), "6 7 9 12 14 19 %s 40", loops);
	CHECK_AS(are(lines(&bench, STOPS_INTO), wanted), "ELSE of CASE");
	CHECK_AS(are(lines(&bench, STOPS_GO), ""), "nothing stands without a breakpoint");
	close_bench(&bench);
}

/* What runs at once without stops is several statements. */
static void test_joined(void)
{
	static const char text[] =
		"RUNGBOARD 1\nPROGRAM Main ST\n  VAR\n    i : INT;\n  END_VAR\n"
		"  i := 0;\n"
		"  REPEAT\n"
		"    i := i + 1;\n"           /* 8 */
		"  UNTIL i >= 3\n"
		"  END_REPEAT;\n"
		"  REPEAT\n"
		"    i := i - 1;\n"
		"    i := i + 2;\n"           /* 13 */
		"  UNTIL NOT (i <= 5)\n"
		"  END_REPEAT;\nEND_PROGRAM\n";
	struct bench bench;

	open_bench(&bench, text);
	CHECK_AS(are(lines(&bench, STOPS_INTO), "6 8 9 8 9 8 9 12 13 14 12 13 14 12 13 14"),
		 "each statement of short loops");
	CHECK(get(&bench, "Main.i") == 6);
	close_bench(&bench);
}

static void test_lines(void)
{
	struct bench bench;
	const struct program *program;

	open_bench(&bench, kinds);
	program = ladder_program(bench.ladder);
	CHECK_AS(stops_line(program, 0, 1) == 6, "a declaration has no statement");
	CHECK_AS(stops_line(program, 0, 13) == 14 && stops_line(program, 0, 18) == 19,
		 "END_IF and ELSE have none");
	CHECK_AS(stops_line(program, 0, 33) == 34 && stops_line(program, 0, 41) == 0,
		 "nor REPEAT, nor the second line of a statement");
	CHECK(!add(&bench, "Main", 13) && !add(&bench, "Main", 41));
	CHECK(add(&bench, "Main", 22) && add(&bench, "Main", 40));
	CHECK_AS(are(lines(&bench, STOPS_GO), "22 22 22 40"), "a breakpoint in a loop stands each round");
	CHECK_AS(are(lines(&bench, STOPS_LEAVE), ""), "leaving passes all of them");
	stops_clear(bench.stops);
	CHECK_AS(are(lines(&bench, STOPS_GO), ""), "they are gone");
	CHECK(stops_add(bench.stops, 0, 31, NULL, NULL, true));
	CHECK_AS(are(lines(&bench, STOPS_GO), "31"), "up to a line, once");
	close_bench(&bench);
}

/* ---- calls ---- */

static const char calls[] =
	"RUNGBOARD 1\n"                     /* 1 */
	"FUNCTION Twice : INT ST\n"
	"  VAR_INPUT\n    v : INT;\n  END_VAR\n"
	"  Twice := v * 2;\n"               /* 6 */
	"END_FUNCTION\n"
	"FUNCTION_BLOCK Fill ST\n"
	"  VAR_INPUT\n    Step : INT;\n  END_VAR\n"
	"  VAR_OUTPUT\n    Level : INT;\n  END_VAR\n" /* 14 */
	"  Level := Level + Step;\n"        /* 15 */
	"  IF Level > 100 THEN\n"
	"    Level := 0;\n"
	"  END_IF;\n"
	"END_FUNCTION_BLOCK\n"
	"FUNCTION_BLOCK Line ST\n"          /* 20 */
	"  VAR\n    Tank : ARRAY[1..2] OF Fill;\n  END_VAR\n"
	"  Tank[1](Step := 1);\n"           /* 24 */
	"  Tank[2](Step := 50);\n"
	"END_FUNCTION_BLOCK\n"
	"PROGRAM Main ST\n"
	"  VAR\n    A : Line;\n    B : Fill;\n    r : INT;\n  END_VAR\n"
	"  A();\n"                          /* 33 */
	"  r := Twice(1) + Twice(2);\n"
	"  B(Step := Twice(3));\n"          /* 35 */
	"END_PROGRAM\n";

static const char *stack(const struct bench *bench)
{
	static char out[400];
	struct stops_frame frame[LIMIT_CALLS + 1];
	const int count = stops_stack(bench->stops, &bench->twin, frame);
	size_t used = 0;

	out[0] = '\0';
	for (int i = 0; i < count; i++)
		used += (size_t)snprintf(out + used, sizeof(out) - used, "%s%s %u%s%s", i ? ", " : "",
					 frame[i].at.pou, frame[i].at.line ? frame[i].at.line :
					 frame[i].at.rung, frame[i].instance[0] ? " " : "",
					 frame[i].instance);
	return out;
}

static void step(struct bench *bench, enum stops_step step, const char *wanted)
{
	stops_scan(bench->stops, &bench->twin, step);
	CHECK_AS(are(stack(bench), wanted), wanted);
}

static void test_calls(void)
{
	struct bench bench;

	open_bench(&bench, calls);
	CHECK_AS(are(lines(&bench, STOPS_INTO), "33 24 15 16 25 15 16 34 6 6 35 6 15 16"), "into");
	CHECK_AS(are(lines(&bench, STOPS_OVER), "33 34 35"), "over");
	step(&bench, STOPS_INTO, "Main 33");
	step(&bench, STOPS_INTO, "Line 24 A, Main 33");
	step(&bench, STOPS_INTO, "Fill 15 A.Tank[1], Line 24 A, Main 33");
	step(&bench, STOPS_OVER, "Fill 16 A.Tank[1], Line 24 A, Main 33");
	step(&bench, STOPS_OVER, "Line 25 A, Main 33");
	step(&bench, STOPS_INTO, "Fill 15 A.Tank[2], Line 25 A, Main 33");
	step(&bench, STOPS_OUT, "Main 34");
	step(&bench, STOPS_INTO, "Twice 6, Main 34");
	step(&bench, STOPS_OVER, "Main 35");
	step(&bench, STOPS_OUT, "");
	CHECK_AS(bench.twin.scan == 3, "out of a program: the scan ends");
	CHECK(add(&bench, "Fill", 15));
	step(&bench, STOPS_OVER, "Main 33");
	step(&bench, STOPS_OVER, "Fill 15 A.Tank[1], Line 24 A, Main 33");
	step(&bench, STOPS_GO, "Fill 15 A.Tank[2], Line 25 A, Main 33");
	step(&bench, STOPS_GO, "Fill 15 B, Main 35");
	close_bench(&bench);
}

/* Blocks of an array by an index that their bodies and the loop change. */
static void test_indexed(void)
{
	static const char text[] =
		"RUNGBOARD 1\n"
		"VAR\n  i : INT;\nEND_VAR\n" /* 4 */
		"FUNCTION_BLOCK Fill ST\n"
		"  VAR_INPUT\n    Step : INT;\n  END_VAR\n"
		"  VAR_OUTPUT\n    Level : INT;\n  END_VAR\n"
		"  i := 7;\n"                 /* 12 */
		"  Level := Level + Step;\n"
		"END_FUNCTION_BLOCK\n"
		"FUNCTION_BLOCK Line ST\n"
		"  VAR\n    Tank : ARRAY[0..1, 1..3] OF Fill;\n    k : INT;\n  END_VAR\n"
		"  FOR k := 1 TO 2 DO\n"      /* 20 */
		"    i := 2 * k - 1;\n"
		"    Tank[k - 1, i](Step := k);\n"
		"  END_FOR;\n"
		"END_FUNCTION_BLOCK\n"
		"PROGRAM Main ST\n"
		"  VAR\n    A : ARRAY[3..4] OF Line;\n  END_VAR\n"
		"  A[4 - i / 99]();\n"        /* 29 */
		"END_PROGRAM\n";
	struct bench bench;
	struct twin copy;

	open_bench(&bench, text);
	CHECK(twin_clone(&copy, &bench.twin));
	step(&bench, STOPS_INTO, "Main 29");
	step(&bench, STOPS_INTO, "Line 20 A[4], Main 29");
	step(&bench, STOPS_OVER, "Line 21 A[4], Main 29");
	step(&bench, STOPS_OVER, "Line 22 A[4], Main 29");
	step(&bench, STOPS_INTO, "Fill 12 A[4].Tank[0][1], Line 22 A[4], Main 29");
	step(&bench, STOPS_OVER, "Fill 13 A[4].Tank[0][1], Line 22 A[4], Main 29");
	step(&bench, STOPS_OVER, "Line 23 A[4], Main 29");
	step(&bench, STOPS_OVER, "Line 21 A[4], Main 29");
	step(&bench, STOPS_OVER, "Line 22 A[4], Main 29");
	step(&bench, STOPS_INTO, "Fill 12 A[4].Tank[1][3], Line 22 A[4], Main 29");
	twin_copy(&copy, &bench.twin);
	stops_show(bench.stops, &bench.twin, &copy);
	CHECK(image_get(&copy.resource.image, image_find(&copy.resource.image, "A[4].Tank[1][3].Step", 20)).i == 2);
	step(&bench, STOPS_OUT, "Line 23 A[4], Main 29");
	step(&bench, STOPS_OUT, "");
	CHECK(get(&bench, "A[4].Tank[0][1].Level") == 1 && get(&bench, "A[4].Tank[1][3].Level") == 2);
	twin_free(&copy);
	close_bench(&bench);
}

/* A ladder has no statements: the next one is that of the next call. */
static void test_ladder(void)
{
	static const char text[] =
		"RUNGBOARD 1\n"
		"FUNCTION_BLOCK Count ST\n"
		"  VAR_INPUT\n    Up : BOOL;\n  END_VAR\n  VAR_OUTPUT\n    Sum : INT;\n  END_VAR\n"
		"  IF Up THEN\n    Sum := Sum + 1;\n  END_IF;\n" /* 9 */
		"END_FUNCTION_BLOCK\n"
		"PROGRAM Main LD\n"
		"  VAR\n    A, B : Count;\n  END_VAR\n"
		"RUNG\n  | NO SYS_ALWAYS_ON | Count A |\n"
		"RUNG\n  | NO SYS_FIRST_SCAN | Count B |\n"
		"END_PROGRAM\n";
	struct bench bench;

	open_bench(&bench, text);
	step(&bench, STOPS_INTO, "Count 9 A, Main 1");
	step(&bench, STOPS_OUT, "Count 9 B, Main 2");
	step(&bench, STOPS_OVER, "Count 10 B, Main 2");
	step(&bench, STOPS_OVER, "");
	CHECK(get(&bench, "Main.A.Sum") == 1 && get(&bench, "Main.B.Sum") == 1);
	close_bench(&bench);
}

/* An action of a chart. */
static void test_chart(void)
{
	static const char text[] =
		"RUNGBOARD 1\n"
		"PROGRAM Main SFC\n"
		"  VAR\n    n, k : INT;\n  END_VAR\n"
		"  INITIAL_STEP Begin:\n    Work(N);\n  END_STEP\n"
		"  ACTION Work:\n"
		"    n := n + 1;\n"           /* 10 */
		"    IF n > 1 THEN\n"
		"      k := n;\n"
		"    END_IF;\n"
		"  END_ACTION\n"
		"END_PROGRAM\n";
	struct bench bench;

	open_bench(&bench, text);
	CHECK_AS(are(lines(&bench, STOPS_INTO), "10 11"), "a branch that is not taken");
	CHECK_AS(are(lines(&bench, STOPS_OVER), "10 11 12"), "the next scan takes it");
	CHECK(add(&bench, "Main", 12));
	CHECK_AS(are(lines(&bench, STOPS_GO), "12"), "a breakpoint in an action");
	CHECK(get(&bench, "Main.k") == 3);
	close_bench(&bench);
}

/* ---- conditions, values ---- */

/* A breakpoint. */
static void add_at(struct bench *bench, struct arena *arena, const char *pou, uint32_t line,
		   const char *instance, const char *text)
{
	struct expr *expr = arena_alloc(arena, sizeof(*expr));
	struct diag_list *diags = arena_alloc(arena, sizeof(*diags));
	struct formula *formula;

	diag_init(diags);
	CHECK(expr_parse_text(text, strlen(text), expr, diags, (struct diag){ .line = 1 }));
	formula = formula_new(&bench->twin.resource.image, NULL, (struct formula_projects){ NULL, NULL }, expr, arena, text, diags,
			      (struct diag){ .line = 1 });
	CHECK_AS(formula && stops_add(bench->stops, pou_of(bench, pou), line, formula, instance, false), text);
}

/* In the first line of Fill. */
static void add_if(struct bench *bench, struct arena *arena, const char *instance, const char *text)
{
	add_at(bench, arena, "Fill", 15, instance, text);
}

static const char frames[] =
	"RUNGBOARD 1\n"                     /* 1 */
	"TYPE\n  Pair : STRUCT\n    Low, High : INT;\n  END_STRUCT;\nEND_TYPE\n"
	"FUNCTION Sum : INT ST\n"           /* 7 */
	"  VAR_INPUT\n    v : INT;\n  END_VAR\n"
	"  VAR CONSTANT\n    Most : INT := 4;\n  END_VAR\n"
	"  VAR\n    i, t : INT;\n    Row : ARRAY[1..3] OF INT;\n    Both : Pair;\n  END_VAR\n" /* 18 */
	"  Both.High := v * 10;\n"          /* 19 */
	"  FOR i := 1 TO 3 DO\n"
	"    Row[i] := v + i;\n"
	"    t := t + Row[i];\n"            /* 22 */
	"  END_FOR;\n"
	"  Sum := t;\n"                     /* 24 */
	"END_FUNCTION\n"
	"FUNCTION_BLOCK Grow ST\n"           /* 26 */
	"  VAR_IN_OUT\n    Total : INT;\n  END_VAR\n"
	"  VAR_TEMP\n    Now : INT;\n  END_VAR\n"
	"  Now := Total * 2;\n"             /* 33 */
	"  Total := Total + 1;\n"           /* 34 */
	"END_FUNCTION_BLOCK\n"
	"PROGRAM Main ST\n"                 /* 36 */
	"  VAR\n    n, all : INT;\n    A : Grow;\n  END_VAR\n"
	"  A(Total := n);\n"                /* 41 */
	"  all := Sum(v := n);\n"
	"END_PROGRAM\n";

/* Where it stands first with that condition, of @line: n, and what the name is then. */
static void stands_if(const char *pou, uint32_t line, const char *text, int64_t n, const char *name, int64_t value)
{
	struct stops_frame frame[LIMIT_CALLS + 1] = { { 0 } };
	struct bench bench;
	struct arena arena;

	open_bench(&bench, frames);
	arena_init(&arena);
	add_at(&bench, &arena, pou, line, NULL, text);
	for (int i = 0; i < 20 && !bench.twin.resource.stopped; i++)
		stops_scan(bench.stops, &bench.twin, STOPS_GO);
	CHECK_AS(stops_stack(bench.stops, &bench.twin, frame) && frame[0].at.line == line &&
		 get(&bench, "Main.n") == n, text);
	CHECK_AS(get(&bench, name) == value, name);
	arena_free(&arena);
	close_bench(&bench);
}

/* Conditions read what a function has, and what a block has only while it runs. */
static void test_frames(void)
{
	struct ladder *ladder = ladder_new();
	const struct program *program;
	struct symbol_cursor cursor = { .whole = true };
	struct image image = { 0 };
	struct symbol symbol;

	stands_if("Sum", 24, "Sum.v = 3", 3, "Sum.t", 15);
	stands_if("Sum", 22, "Sum.i = 2 AND Sum.v > 4", 5, "Sum.Row[2]", 7);
	stands_if("Sum", 22, "Sum.Row[Sum.i] = 6", 3, "Sum.i", 3);
	stands_if("Sum", 21, "Sum.Both.High > 30", 4, "Sum.Both.High", 40);
	stands_if("Sum", 21, "Sum.v > Sum.Most", 5, "Sum.Most", 4);
	stands_if("Grow", 34, "Grow.Now >= 6", 3, "Grow.Now", 6);
	CHECK(ladder_load_text(ladder, "stops.rung", frames, strlen(frames)) && ladder_build(ladder));
	program = ladder_program(ladder);
	image.program = program;
	while (image_next_symbol(&image, &cursor, &symbol))
		if (!CHECK(strncmp(symbol.name, "Sum.", 4) != 0 && strncmp(symbol.name, "Grow.", 5) != 0))
			printf("# %s is in the image of a board\n", symbol.name);
	ladder_free(ladder);
}

static void test_condition(void)
{
	struct bench bench;
	struct arena arena;

	open_bench(&bench, calls);
	arena_init(&arena);
	add_if(&bench, &arena, "A.Tank[1]", "A.Tank[1].Level >= 3");
	add_if(&bench, &arena, "A.Tank[2]", "A.Tank[2].Level = 50");
	step(&bench, STOPS_GO, "");
	step(&bench, STOPS_GO, "Fill 15 A.Tank[2], Line 25 A, Main 33");
	CHECK_AS(set(&bench, "A.Tank[2].Level", 40), "a value of the body that stands");
	step(&bench, STOPS_GO, "");
	CHECK(get(&bench, "A.Tank[2].Level") == 90);
	step(&bench, STOPS_GO, "");
	step(&bench, STOPS_GO, "Fill 15 A.Tank[1], Line 24 A, Main 33");
	stops_clear(bench.stops);
	step(&bench, STOPS_LEAVE, "");
	add_if(&bench, &arena, NULL, "10 / B.Level > 100");
	step(&bench, STOPS_GO, "");
	CHECK(set(&bench, "B.Level", 0));
	step(&bench, STOPS_GO, "Fill 15 A.Tank[1], Line 24 A, Main 33");
	arena_free(&arena);
	close_bench(&bench);
}

/* An action of a block has the instance of the block that calls it, or in front of its name. */
static void test_actions(void)
{
	static const char text[] =
		"RUNGBOARD 1\n"
		"FUNCTION_BLOCK Fill ST\n"
		"  VAR_INPUT\n    Step : INT;\n  END_VAR\n"
		"  VAR_OUTPUT\n    Level : INT;\n  END_VAR\n"
		"  Add();\n"                       /* 9 */
		"END_FUNCTION_BLOCK\n"
		"ACTION Fill.Add:\n"
		"  Level := Level + Step;\n"       /* 12 */
		"  Level := MIN(Level, 90);\n"     /* 13 */
		"END_ACTION\n"
		"PROGRAM Main ST\n"
		"  VAR\n    A, B : Fill;\n  END_VAR\n"
		"  A(Step := 1);\n"                /* 19 */
		"  B(Step := 30);\n"
		"  B.Add();\n"                     /* 21 */
		"END_PROGRAM\n";
	struct bench bench;
	struct arena arena;

	open_bench(&bench, text);
	arena_init(&arena);
	add_at(&bench, &arena, "Fill.Add", 13, "A", "A.Level = 2");
	add_at(&bench, &arena, "Fill.Add", 13, "B", "B.Level = 60");
	step(&bench, STOPS_GO, "Fill.Add 13 B, Main 21");
	step(&bench, STOPS_GO, "");
	step(&bench, STOPS_GO, "Fill.Add 13 A, Fill 9 A, Main 19");
	CHECK(set(&bench, "A.Level", 40));
	step(&bench, STOPS_OVER, "Main 20");
	CHECK_AS(get(&bench, "A.Level") == 40, "a value of the block that waits for its action");
	step(&bench, STOPS_GO, "");
	arena_free(&arena);
	close_bench(&bench);
}

/* Copies have the values of instances as they are now, and which lines ran. */
static void test_show(void)
{
	struct bench bench;
	struct twin copy;
	const struct image *image = &copy.resource.image;
	const struct act force = { .kind = ACT_FORCE, .value.i = 5 };
	struct act held;

	open_bench(&bench, calls);
	CHECK(twin_clone(&copy, &bench.twin));
	CHECK(add(&bench, "Fill", 16));
	step(&bench, STOPS_GO, "Fill 16 A.Tank[1], Line 24 A, Main 33");
	twin_copy(&copy, &bench.twin);
	CHECK(image_get(image, image_find(image, "A.Tank[1].Level", 15)).i == 0);
	stops_show(bench.stops, &bench.twin, &copy);
	CHECK(image_get(image, image_find(image, "A.Tank[1].Level", 15)).i == 1);
	CHECK(image_get(image, image_find(image, "A.Tank[1].Step", 14)).i == 1);
	held = force;
	held.at = image_find(image, "A.Tank[1].Step", 14);
	CHECK(stops_act(bench.stops, &bench.twin, &held));
	twin_copy(&copy, &bench.twin);
	stops_show(bench.stops, &bench.twin, &copy);
	CHECK(image_get(image, held.at).i == 5);
	step(&bench, STOPS_LEAVE, "");
	CHECK(get(&bench, "A.Tank[1].Step") == 5);
	twin_free(&copy);
	close_bench(&bench);
}

static const char outputs[] =
	"RUNGBOARD 1\n"
	"VAR\n  Go AT %IX0.0 : BOOL;\n  Out AT %QX0.0 : BOOL;\n  Height AT %AQW0 : INT;\nEND_VAR\n"
	"PROGRAM Main ST\n"
	"  VAR\n    seen : INT;\n  END_VAR\n"
	"  Out := NOT Out;\n"               /* 11 */
	"  Height := Height + 1;\n"
	"  IF Go THEN\n"
	"    seen := seen + 1;\n"
	"  END_IF;\n"
	"END_PROGRAM\n";

static void test_values(void)
{
	struct bench bench;
	int64_t now_ns;

	open_bench(&bench, outputs);
	CHECK(add(&bench, "Main", 13));
	step(&bench, STOPS_GO, "Main 13");
	now_ns = bench.twin.now_ns;
	CHECK_AS(get(&bench, "Out") == 1 && get(&bench, "Height") == 1, "values are those of now");
	CHECK_AS(!(image_area(&bench.twin.resource.image, AREA_Q)[0] & 1),
		 "nobody else sees the output yet");
	CHECK(bench.twin.resource.scans == 0);
	CHECK(set(&bench, "Height", 41) && set(&bench, "Go", 1));
	CHECK(twin_act(&bench.twin, &(struct act){ .kind = ACT_FORCE, .value.i = 7,
		.at = image_find(&bench.twin.resource.image, "Main.seen", 9) }));
	step(&bench, STOPS_OVER, "Main 14");
	CHECK_AS(bench.twin.now_ns == now_ns, "time stands");
	step(&bench, STOPS_OVER, "");
	CHECK(get(&bench, "Height") == 41 && get(&bench, "Main.seen") == 7);
	CHECK(image_area(&bench.twin.resource.image, AREA_Q)[0] & 1);
	CHECK(bench.twin.resource.scans == 1 && bench.twin.scan == 1);
	close_bench(&bench);
}

/* ---- the same as without ---- */

static bool same(const struct twin *a, const struct twin *b)
{
	return memcmp(a->resource.image.memory, b->resource.image.memory,
		      image_memory_size(a->resource.image.program)) == 0 &&
	       a->now_ns == b->now_ns && a->scan == b->scan &&
	       a->resource.vm.errors == b->resource.vm.errors &&
	       a->resource.scan_us == b->resource.scan_us &&
	       a->resource.tasks.state[0].runs == b->resource.tasks.state[0].runs &&
	       a->resource.tasks.state[1].interrupted == b->resource.tasks.state[1].interrupted;
}

/* Tasks that interrupt each other, on a slow board: scans that stand at safe points stand at
 * statements, too. */
static void test_tasks(void)
{
	static const char text[] =
		"RUNGBOARD 1\n"
		"CONFIGURATION Two\n"
		"  TASK Quick(INTERVAL := T#10ms, PRIORITY := 0);\n"
		"  TASK Slow(INTERVAL := T#40ms, PRIORITY := 1);\n"
		"  PROGRAM P WITH Quick : Fast;\n"
		"  PROGRAM Q WITH Slow : Long;\n"
		"END_CONFIGURATION\n"
		"VAR\n  Sum : DINT;\n  Row : DINT;\nEND_VAR\n"
		"PROGRAM Fast ST\n  Sum := Sum + 1;\n  Row := Row + Sum;\nEND_PROGRAM\n"
		"PROGRAM Long ST\n  VAR\n    i : INT;\n  END_VAR\n"
		"  FOR i := 1 TO 60 DO\n    Row := Row * 3 + i;\n"
		"    Row := Row MOD 7919 + Row MOD 31 + Row MOD 29;\n"
		"    Row := Row MOD 7907 + Row MOD 23 + Row MOD 19;\n"
		"    Row := Row MOD 7901 + Row MOD 17 + Row MOD 13;\n    IF Row > 4000 THEN\n"
		"      Row := Row MOD 1000;\n    END_IF;\n  END_FOR;\n"
		"  Sum := Sum + Row;\nEND_PROGRAM\n";
	struct bench plain, stepped;
	const struct act speed = { .kind = ACT_SPEED, .value.i = 300 };
	uint64_t stood = 0, standing = 0;
	bool good = true;

	open_bench(&plain, text);
	open_bench(&stepped, text);
	CHECK(twin_act(&plain.twin, &speed) && twin_act(&stepped.twin, &speed));
	for (int i = 0; i < 60; i++) {
		twin_scan(&plain.twin);
		do {
			stops_scan(stepped.stops, &stepped.twin, i % 3 ? STOPS_INTO : STOPS_GO);
			stood += stepped.twin.resource.stopped;
			standing += stepped.twin.resource.stopped && stepped.twin.resource.level > 0;
		} while (stepped.twin.resource.stopped);
		good = good && same(&plain.twin, &stepped.twin);
	}
	CHECK_AS(good, "each period gives the same");
	CHECK(plain.twin.resource.state == STATE_RUN);
	CHECK_AS(stood > 100, "it stood at statements");
	CHECK_AS(plain.twin.resource.tasks.state[1].interrupted > 0 && standing > 0,
		 "also while another task was interrupted");
	close_bench(&plain);
	close_bench(&stepped);
}

/* The budget of the scan counts instructions, not the time that it stands. */
static void test_budget(void)
{
	static const char text[] =
		"RUNGBOARD 1\nPROGRAM Main ST\n  VAR\n    i : DINT;\n  END_VAR\n"
		"  WHILE i < 3 DO\n    i := i + 1;\n  END_WHILE;\n"
		"  WHILE TRUE DO\n    i := i + 1;\n  END_WHILE;\nEND_PROGRAM\n";
	struct bench plain, stepped;

	open_bench(&plain, text);
	open_bench(&stepped, text);
	twin_scan(&plain.twin);
	CHECK(add(&stepped, "Main", 7) && add(&stepped, "Main", 9));
	step(&stepped, STOPS_GO, "Main 7");
	step(&stepped, STOPS_GO, "Main 7");
	step(&stepped, STOPS_GO, "Main 7");
	step(&stepped, STOPS_GO, "Main 9");
	step(&stepped, STOPS_LEAVE, "");
	CHECK(plain.twin.resource.fault == FAULT_BUDGET && stepped.twin.resource.fault == FAULT_BUDGET);
	CHECK_AS(get(&plain, "Main.i") == get(&stepped, "Main.i"), "the budget is the same");
	close_bench(&plain);
	close_bench(&stepped);
}

/* A copy of a twin that stands shows it; a program without the places never stands. */
static void test_copies(void)
{
	struct bench bench;
	struct twin copy;
	struct ladder *ladder = ladder_new();

	open_bench(&bench, outputs);
	CHECK(twin_clone(&copy, &bench.twin));
	step(&bench, STOPS_INTO, "Main 11");
	twin_copy(&copy, &bench.twin);
	CHECK(copy.resource.stopped && !copy.resource.vm.stand && !copy.resource.vm.run);
	twin_free(&copy);
	close_bench(&bench);
	memset(&bench, 0, sizeof(bench));
	ladder_watch(ladder, true);
	CHECK(ladder_load_text(ladder, "stops.rung", outputs, strlen(outputs)) && ladder_build(ladder));
	bench.ladder = ladder;
	CHECK(twin_init(&bench.twin, ladder_program(ladder), NULL, PERIOD));
	CHECK(twin_act(&bench.twin, &(struct act){ .kind = ACT_START }));
	bench.stops = stops_new(ladder_program(ladder));
	CHECK(stops_line(ladder_program(ladder), 0, 1) == 0 && !add(&bench, "Main", 11));
	step(&bench, STOPS_INTO, "");
	CHECK(bench.twin.scan == 1);
	close_bench(&bench);
}

int main(void)
{
	test_kinds();
	test_joined();
	test_lines();
	test_calls();
	test_indexed();
	test_ladder();
	test_chart();
	test_condition();
	test_frames();
	test_actions();
	test_show();
	test_values();
	test_tasks();
	test_budget();
	test_copies();
	return tap_done();
}
