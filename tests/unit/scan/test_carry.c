/* SPDX-License-Identifier: MIT
 *
 * test_carry - changes a running program: values that are kept and values that are
 * reset, by hand; and random programs with an added rung, which must behave as without
 * it.
 */
#include "engine/scan/carry.h"
#include "tests/unit/rig.h"
#include "tests/walker/random.h"

#define SEEDS 400
#define TEXT_MAX (128 * 1024)
#define NAMES 4096

/* Continues @to with the state of @from. */
static void change(struct rig *to, const struct rig *from)
{
	struct arena arena;

	arena_init(&arena);
	resource_init(&to->resource, ladder_program(to->ladder), to->memory);
	to->resource.watch = from->resource.watch;
	if (!carry(&to->resource, &from->resource, &arena))
		CHECK_AS(false, "carry");
	to->now = from->now;
	arena_free(&arena);
}

/* ---- edges ---- */

#define EDGES(first, other) \
	"VAR\n  Start AT %IX0.0 : BOOL;\n  Ups : INT;\n  Downs : INT;\n" \
	"  Powers : INT;\n  Inner : Counter;\nEND_VAR\n" \
	"FUNCTION_BLOCK Counter LD\nVAR_INPUT\n  In : BOOL;\nEND_VAR\n" \
	"VAR\n  N : INT;\nEND_VAR\n" \
	"RUNG\n  | P In | [ N := N + 1 ] |\nEND_FUNCTION_BLOCK\n" \
	"PROGRAM Main LD\n" first \
	"RUNG\n  | P Start | [ Ups := Ups + 1 ] |\n" \
	"RUNG\n  | N Start | [ Downs := Downs + 1 ] |\n" other \
	"RUNG\n  | NO Start | COILP %MX9.0 |\n" \
	"RUNG\n  | NO %MX9.0 | [ Powers := Powers + 1 ] |\n" \
	"RUNG\n  | NO Start | Counter Inner |\n" \
	"END_PROGRAM\n"
static const char edges[] = EDGES("", "");
/* Rungs are added before and between, with a new edge. */
static const char more_edges[] = EDGES(
	"RUNG\n  | P Start | S %MX8.0 |\n", "RUNG\n  | N %IX0.1 | R %MX8.1 |\n");

static void test_edges(void)
{
	struct rig old, new;

	rig_open(&old, edges, true);
	rig_open(&new, more_edges, true);
	rig_set(&old, "Start", 1);
	for (int i = 0; i < 5; i++)
		rig_scan(&old);
	CHECK(rig_get(&old, "Ups") == 1 && rig_get(&old, "Powers") == 1);
	change(&new, &old);
	for (int i = 0; i < 5; i++)
		rig_scan(&new);
	CHECK(rig_get(&new, "Ups") == 1);
	CHECK(rig_get(&new, "Powers") == 1);
	CHECK(rig_get(&new, "Inner.N") == 1);
	/* A new contact waits for an edge. */
	CHECK(rig_get(&new, "%MX8.0") == 0);
	rig_set(&new, "Start", 0);
	rig_scan(&new);
	CHECK(rig_get(&new, "Downs") == 1);
	rig_set(&new, "Start", 1);
	rig_scan(&new);
	CHECK(rig_get(&new, "Ups") == 2 && rig_get(&new, "Powers") == 2 &&
	      rig_get(&new, "Inner.N") == 2 && rig_get(&new, "%MX8.0") == 1);
	rig_close(&old);
	rig_close(&new);
}

/* ---- pointers ---- */

#define POINTED_TYPES \
	"TYPE\n  Pair : STRUCT\n    A : INT;\n    B : DINT;\n    Name : STRING[7];\n  END_STRUCT;\nEND_TYPE\n"
#define POINTERS \
	"  Pt : REF_TO INT;\n  Lost : REF_TO INT;\n  Whole : REF_TO Pair;\n  Part : REF_TO DINT;\n" \
	"  Element : POINTER TO INT;\n  Note : REF_TO STRING;\n  Many : ARRAY[1..3] OF REF_TO INT;\n"
static const char pointing[] = POINTED_TYPES
	"VAR_GLOBAL\n  First : INT := 1;\n  Second : INT := 2;\n  Gone : INT := 3;\n  One : Pair;\n"
	"  List : ARRAY[1..4] OF INT;\n  Text : STRING[9];\n" POINTERS
	"  Begun : REF_TO INT := REF(First);\n  Set : REF_TO INT := REF(First);\nEND_VAR\n"
	"PROGRAM Main ST\n  Pt := REF(Second);\n  Lost := REF(Gone);\n  Whole := REF(One);\n  Part := REF(One.B);\n"
	"  Element := REF(List[3]);\n  Note := REF(Text);\n  Many[2] := REF(First);\n  Many[3] := REF(Gone);\n"
	"  Set := REF(List[2]);\nEND_PROGRAM\n";
/* Other places, one variable fewer; the pointers are not set again. */
static const char pointed[] = POINTED_TYPES
	"VAR_GLOBAL\n  Text : STRING[9];\n  New : INT := 5;\n  Also : LINT;\n  Second : INT := 2;\n"
	"  Fresh : REF_TO INT := REF(New);\n" POINTERS
	"  Set : REF_TO INT := REF(First);\n  Begun : REF_TO INT := REF(First);\n"
	"  List : ARRAY[1..4] OF INT;\n  More : ARRAY[1..9] OF INT;\n  One : Pair;\n  First : INT := 1;\nEND_VAR\n"
	"PROGRAM Main ST\n  Pt^ := 70;\n  Lost^ := 71;\n  Whole^.A := 72;\n  Part^ := 73;\n  Element^ := 74;\n"
	"  Note^ := 'seven';\n  Many[2]^ := 75;\n  Many[3]^ := 76;\n  Many[1]^ := 77;\n  Fresh^ := 78;\n"
	"  Begun^ := Begun^ + 1;\n  Set^ := 79;\nEND_PROGRAM\n";

/* After a change each pointer leads to its variable, wherever that is now, or nowhere. */
static void test_pointers(void)
{
	struct rig old, new;

	rig_open(&old, pointing, true);
	rig_open(&new, pointed, true);
	rig_scan(&old);
	change(&new, &old);
	rig_scan(&new);
	CHECK(rig_get(&new, "Second") == 70);
	CHECK(rig_get(&new, "One.A") == 72 && rig_get(&new, "One.B") == 73);
	CHECK(rig_get(&new, "List[1]") == 0 && rig_get(&new, "List[2]") == 79 &&
	      rig_get(&new, "List[3]") == 74 && rig_get(&new, "List[4]") == 0);
	CHECK(rig_get(&new, "First") == 76 && rig_get(&new, "New") == 78);
	CHECK(rig_get(&new, "Also") == 0);
	for (int i = 1; i <= 9; i++) {
		char name[24];

		snprintf(name, sizeof(name), "More[%d]", i);
		CHECK(rig_get(&new, name) == 0);
	}
	rig_scan(&new); /* counts those of the scan before */
	CHECK_AS(rig_get(&new, "SYS_ERRORS") == 3, "three lead nowhere");
	rig_close(&old);
	rig_close(&new);
}

/* ---- blocks in structures ---- */

#define HELD(first, last) \
	"TYPE\n  Holder : STRUCT\n" first "    Delay : TON;\n    Steps : ARRAY[1..2] OF CTU;\n    n : INT;\n" last \
	"  END_STRUCT;\nEND_TYPE\nVAR_GLOBAL\n" first "  One : Holder;\n  Many : ARRAY[1..2] OF Holder;\nEND_VAR\n" \
	"PROGRAM Main ST\n  One.Delay(IN := TRUE, PT := T#1s);\n  Many[2].Delay(IN := TRUE, PT := T#2s);\n" \
	"  Many[1].Steps[2](CU := One.n MOD 2 = 0, PV := 9);\n  One.n := One.n + 1;\nEND_PROGRAM\n"
static const char held[] = HELD("", "");
static const char held_elsewhere[] = HELD("    Extra : LREAL;\n", "    Last : TOF;\n");

static void test_held_blocks(void)
{
	struct rig old, new;
	int64_t one, two;

	rig_open(&old, held, true);
	rig_open(&new, held_elsewhere, true);
	for (int i = 0; i < 6; i++)
		rig_scan(&old);
	one = rig_get(&old, "One.Delay.ET");
	two = rig_get(&old, "Many[2].Delay.ET");
	CHECK(one > 0 && two > 0 && rig_get(&old, "Many[1].Steps[2].CV") == 3);
	change(&new, &old);
	CHECK(rig_get(&new, "One.Delay.ET") == one && rig_get(&new, "Many[2].Delay.ET") == two);
	CHECK(rig_get(&new, "Many[1].Steps[2].CV") == 3 && rig_get(&new, "One.n") == 6);
	rig_scan(&new);
	CHECK(rig_get(&new, "One.Delay.ET") > one && rig_get(&new, "One.n") == 7);
	rig_close(&old);
	rig_close(&new);
}

/* ---- values ---- */

static const char before[] =
	"TYPE\n  Item : STRUCT\n    Speed : INT;\n    Name : STRING[8];\n"
	"  END_STRUCT;\nEND_TYPE\n"
	"VAR_GLOBAL\n  Kept : DINT;\n  Typed : INT;\n  Gone : INT;\n"
	"  Wait : TIME := T#50ms;\n  Level : REAL := 2.0;\n  Text : STRING[10];\n"
	"  Long : STRING[10];\n  List : ARRAY[1..4] OF INT;\n"
	"  Grid : ARRAY[0..3] OF BOOL;\n  Items : ARRAY[1..2] OF Item;\n"
	"  Moved AT %MW10 : INT;\n  Stay AT %MW12 : INT;\nEND_VAR\n"
	"PROGRAM Main LD\nVAR\n  Delay : TON;\n  Other : TON;\n  Queue : FIFO;\n"
	"  Own : INT;\nEND_VAR\n"
	"RUNG\n  | NO %IX0.0 | TON Delay PT:=T#100ms | COIL %QX0.0 |\n"
	"RUNG\n  | NO %IX0.0 | TON Other PT:=T#9s | COIL %QX0.1 |\n"
	"RUNG\n  | NO %IX0.1 | FIFO Queue IN:=Own SIZE:=8 |\n"
	"RUNG\n  | NO SYS_FIRST_SCAN | [ Own := Own + 10 ] |\n"
	"RUNG\n  | [ Own := Own + 1 ] |\n"
	"END_PROGRAM\n";
/* Changes order, types, sizes, addresses, constants, and sizes of areas. */
static const char after[] =
	"TYPE\n  Item : STRUCT\n    Name : STRING[8];\n    New : INT := 3;\n"
	"    Speed : INT;\n  END_STRUCT;\nEND_TYPE\n"
	"VAR_GLOBAL\n  New : INT := 9;\n  Items : ARRAY[1..3] OF Item;\n"
	"  Grid : ARRAY[2..9] OF BOOL;\n  List : ARRAY[0..2] OF INT;\n"
	"  Long : STRING[3] := 'abc';\n  TEXT : STRING[20];\n  Level : REAL := 3.0;\n"
	"  Wait : TIME := T#70ms;\n  Typed : DINT := 5;\n  Kept : DINT;\n"
	"  Moved AT %MW20 : INT;\n  Stay AT %MW12 : INT;\nEND_VAR\n"
	"CONFIGURATION Sizes\n  AREA M 16384;\n  AREA I 4;\nEND_CONFIGURATION\n"
	"PROGRAM Main LD\nVAR\n  Own : INT;\n  Queue : FIFO;\n  Other : TOF;\n"
	"  Delay : TON;\nEND_VAR\n"
	"RUNG\n  | NO SYS_FIRST_SCAN | [ Own := Own + 1000 ] |\n"
	"RUNG\n  | NO %IX0.1 | FIFO Queue IN:=Own SIZE:=8 |\n"
	"RUNG\n  | NO %IX0.0 | TON Delay PT:=T#200ms | COIL %QX0.0 |\n"
	"RUNG\n  | NO %IX0.0 | TOF Other PT:=T#9s | COIL %QX0.1 |\n"
	"END_PROGRAM\n";

static void set_text(struct rig *rig, const char *name, const char *value)
{
	struct iec_text room;
	struct iec_string *text = iec_text_init(&room, (uint16_t)strlen(value));

	memcpy(text->text, value, strlen(value));
	image_set(&rig->resource.image, rig_at(rig, name),
		  (union iec_value){ .s = text });
}

static bool has_text(struct rig *rig, const char *name, const char *value)
{
	const struct iec_string *text = image_get(&rig->resource.image,
						  rig_at(rig, name)).s;

	return text->length == strlen(value) &&
	       memcmp(text->text, value, text->length) == 0;
}

static void fill(struct rig *rig)
{
	rig_set(rig, "Kept", 12345);
	rig_set(rig, "Typed", 7);
	set_text(rig, "Text", "hello");
	set_text(rig, "Long", "longer");
	for (int i = 1; i <= 4; i++) {
		char name[24];

		snprintf(name, sizeof(name), "List[%d]", i);
		rig_set(rig, name, 100 + i);
	}
	rig_set(rig, "Grid[2]", 1);
	rig_set(rig, "Grid[1]", 1);
	rig_set(rig, "Items[2].Speed", 55);
	set_text(rig, "Items[1].Name", "one");
	rig_set(rig, "Moved", 77);
	rig_set(rig, "Stay", 78);
	rig_set(rig, "%MB200", 79);
	rig_set(rig, "%IX0.0", 1);
	rig_set(rig, "%IX0.1", 1);
	rig_set(rig, "%IX2.5", 1);
	image_set(&rig->resource.image, rig_at(rig, "Level"),
		  (union iec_value){ .r = 2.5 });
}

static void test_values(void)
{
	struct rig old, new;

	rig_open(&old, before, true);
	rig_open(&new, after, true);
	fill(&old);
	for (int i = 0; i < 6; i++)
		rig_scan(&old);
	change(&new, &old);
	CHECK(rig_get(&new, "Kept") == 12345 && rig_get(&new, "New") == 9);
	CHECK(rig_get(&new, "Typed") == 5);
	CHECK(rig_real(&new, "Level") == 2.5);
	/* It had its old initial value, so it gets the new one. */
	CHECK(rig_get(&new, "Wait") == 70000000);
	CHECK(has_text(&new, "Text", "hello") && has_text(&new, "Long", "abc"));
	CHECK(rig_get(&new, "List[0]") == 0 && rig_get(&new, "List[1]") == 101 &&
	      rig_get(&new, "List[2]") == 102);
	CHECK(rig_get(&new, "Grid[2]") == 1 && rig_get(&new, "Grid[3]") == 0);
	CHECK(rig_get(&new, "Items[2].Speed") == 55 &&
	      rig_get(&new, "Items[2].New") == 3 && rig_get(&new, "Items[3].Speed") == 0);
	CHECK(has_text(&new, "Items[1].Name", "one"));
	CHECK(rig_get(&new, "Moved") == 77 && rig_get(&new, "Stay") == 78 &&
	      rig_get(&new, "%MB200") == 79);
	CHECK(rig_get(&new, "%IX0.0") == 1 && rig_get(&new, "%IX2.5") == 1 &&
	      rig_get(&new, "%IX2.4") == 0);
	CHECK(rig_get(&new, "Main.Own") == 16);
	CHECK(rig_get(&new, "Delay.ET") == 50000000);
	/* Its constant was edited; another block begins anew. */
	CHECK(rig_get(&new, "Delay.PT") == 200000000);
	CHECK(rig_get(&new, "Other.ET") == 0);
	CHECK(rig_get(&new, "Queue.COUNT") == rig_get(&old, "Queue.COUNT") &&
	      rig_get(&new, "Queue.COUNT") > 0);
	rig_scan(&new);
	CHECK(rig_get(&new, "Delay.ET") == 60000000);
	CHECK(rig_get(&new, "Main.Own") == 16); /* no first scan */
	CHECK(new.resource.scans == 7 && new.resource.start_ns == RIG_PERIOD);
	rig_close(&old);
	rig_close(&new);
}

/* ---- forces, faults, tasks ---- */

/* A text that an input of an instance is given: the new one, whole, also of another length. */
static void test_texts_of_inputs(void)
{
#define HOT(text) "VAR\n  In : BOOL;\n  Hot : ALARM;\nEND_VAR\nPROGRAM Main LD\nRUNG\n" \
		  "  | NO In | ALARM Hot MSG:='" text "' |\nEND_PROGRAM\n"
	static const char *const edited[] = { HOT("hot"), HOT("HOT"), HOT("hotter"), HOT("h"), HOT("") };
	static const char *const given[] = { "hot", "HOT", "hotter", "h", "" };

	for (size_t i = 0; i < sizeof(edited) / sizeof(edited[0]); i++) {
		struct rig old, new;

		if (rig_open(&old, edited[0], false) && rig_open(&new, edited[i], false)) {
			rig_set(&old, "In", 1);
			rig_scan(&old);
			change(&new, &old);
			CHECK(has_text(&new, "Hot.MSG", given[i]) && rig_get(&new, "Hot.COUNT") == 1);
			rig_close(&new);
		}
		rig_close(&old);
	}
}

static void test_forces(void)
{
	struct rig old, new;

	rig_open(&old, before, true);
	rig_open(&new, after, true);
	rig_scan(&old);
	rig_set(&old, "Kept", 4);
	CHECK(rig_force(&old, "Kept", 5) && rig_force(&old, "%QX0.0", 1) &&
	      rig_force(&old, "Gone", 6) && rig_force(&old, "Delay.ET", 7) &&
	      rig_force(&old, "List[2]", 8) && rig_force(&old, "List[4]", 9) &&
	      rig_force(&old, "%IX5.0", 1) && rig_force(&old, "Typed", 3) &&
	      rig_force(&old, "%MD8", 3));
	rig_scan(&old);
	change(&new, &old);
	/* Forces of removed variables, changed types and lost addresses are gone. */
	CHECK(new.resource.image.force_count == 5);
	CHECK(image_is_forced(&new.resource.image, rig_at(&new, "%QX0.0")));
	CHECK(image_is_forced(&new.resource.image, rig_at(&new, "Delay.ET")));
	CHECK(rig_get(&new, "Kept") == 5 && rig_get(&new, "List[2]") == 8 &&
	      rig_get(&new, "%MD8") == 3);
	rig_scan(&new);
	CHECK(rig_get(&new, "%QX0.0") == 1);
	CHECK(rig_release(&new, "Kept") && rig_get(&new, "Kept") == 4);
	rig_close(&old);
	rig_close(&new);
}

#define TASKS(fast, more) \
	"VAR_GLOBAL\n  A : INT;\n  B : INT;\n  C : INT;\nEND_VAR\n" \
	"CONFIGURATION All\n" more "  TASK Fast (INTERVAL := " fast ", PRIORITY := 1);\n" \
	"  TASK Slow (INTERVAL := T#100ms, PRIORITY := 2);\n" \
	"  TASK Event (SINGLE := %MX3.3, PRIORITY := 3);\n" \
	"  PROGRAM P1 WITH Fast : One;\n  PROGRAM P2 WITH Slow : Two;\n" \
	"  PROGRAM P3 WITH Event : Three;\nEND_CONFIGURATION\n" \
	"PROGRAM One LD\nRUNG\n  | [ A := A + 1 ] |\nEND_PROGRAM\n" \
	"PROGRAM Two LD\nRUNG\n  | [ B := B + 1 ] |\nEND_PROGRAM\n" \
	"PROGRAM Three LD\nRUNG\n  | [ C := C + 1 ] |\nEND_PROGRAM\n"

static void test_tasks(void)
{
	struct rig old, new;

	rig_open(&old, TASKS("T#20ms", ""), false);
	rig_open(&new, TASKS("T#10ms", "  TASK Idle (INTERVAL := T#50ms, PRIORITY := 0);\n"),
		 false);
	rig_set(&old, "%MX3.3", 1);
	for (int i = 0; i < 15; i++)
		rig_scan(&old); /* at 10 … 150 ms */
	CHECK(rig_get(&old, "A") == 8 && rig_get(&old, "B") == 2 &&
	      rig_get(&old, "C") == 1);
	change(&new, &old);
	for (int i = 0; i < 6; i++)
		rig_scan(&new);
	CHECK(rig_get(&new, "A") == 14); /* every scan now */
	CHECK(rig_get(&new, "B") == 3);  /* its deadline, 210 ms, stays */
	CHECK(rig_get(&new, "C") == 1);  /* no new event */
	CHECK(new.resource.tasks.state[2].overruns == 0);
	rig_close(&old);
	rig_close(&new);
}

static void test_fault(void)
{
	struct rig old, new;

	rig_open(&old, "PROGRAM Main LD\nRUNG Again\n  | NO %IX0.0 | JMP Again |\n"
		 "END_PROGRAM\n", false);
	rig_open(&new, "PROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
		 "END_PROGRAM\n", false);
	rig_set(&old, "%IX0.0", 1);
	CHECK(!rig_scan(&old));
	change(&new, &old);
	CHECK(new.resource.state == STATE_FAULT && new.resource.fault == FAULT_BUDGET);
	/* The name comes from the new program: the old one may be freed. */
	CHECK_TEXT(new.resource.fault_at.pou, "Main");
	rig_close(&old);
	CHECK_TEXT(new.resource.fault_at.pou, "Main");
	rig_close(&new);
}

/* ---- random programs ---- */

static struct random_source source;

static bool build(struct rig *rig, const struct random_program *program)
{
	static char text[TEXT_MAX];
	size_t len = random_print(program, text, sizeof(text));

	memset(rig, 0, sizeof(*rig));
	rig->ladder = ladder_new();
	ladder_watch(rig->ladder, true);
	if (!ladder_load_text(rig->ladder, "random.rung", text, len) ||
	    !ladder_build(rig->ladder))
		return false;
	rig->good = true;
	rig->memory = calloc(1, image_memory_size(ladder_program(rig->ladder)));
	resource_init(&rig->resource, ladder_program(rig->ladder), rig->memory);
	rig->resource.watch = true;
	resource_start(&rig->resource);
	return true;
}

/* Adds a rung before the others, with its own edges, so that all offsets change. It
 * writes a variable that no other rung uses. */
static void add_rung(struct random_program *program)
{
	static const char *const text[] = { "P %IX7.7", "NC %IX7.6",
					    "COILN %QX15.7" };
	struct random_rung *rung = &program->rung[0];

	memmove(rung + 1, rung, (size_t)program->rungs * sizeof(*rung));
	program->rungs++;
	memset(rung, 0, sizeof(*rung));
	rung->pou = RANDOM_MAIN;
	rung->rows = 1;
	rung->cols = 3;
	for (int i = 0; i < 3; i++) {
		rung->cell[0][i].kind = i == 2 ? RANDOM_LAST : RANDOM_SERIES;
		snprintf(rung->cell[0][i].text, RANDOM_TEXT, "%s", text[i]);
	}
}

static void scan_both(struct rig *a, struct rig *b)
{
	uint8_t *inputs = image_area(&a->resource.image, AREA_I);

	for (int i = 0; i < 7; i++)
		if (random_chance(&source, 40))
			inputs[i] ^= (uint8_t)(1u << random_below(&source, 8));
	if (b)
		memcpy(image_area(&b->resource.image, AREA_I), inputs, 16);
	rig_scan(a);
	if (b)
		rig_scan(b);
}

struct pair { struct location a, b; char name[80]; };
static struct pair pairs[NAMES];
static int pair_count;

/* Compares everything that both declare, in the same order. */
static bool find_pairs(const struct rig *a, const struct rig *b)
{
	static struct symbol_cursor one, other;
	struct symbol x, y;

	one = other = (struct symbol_cursor){ .whole = true };
	pair_count = 0;
	while (pair_count < NAMES && image_next_symbol(&a->resource.image, &one, &x)) {
		struct pair *pair = &pairs[pair_count++];

		if (!image_next_symbol(&b->resource.image, &other, &y) ||
		    strcmp(x.name, y.name) != 0)
			return false;
		*pair = (struct pair){ .a = x.at, .b = y.at };
		snprintf(pair->name, sizeof(pair->name), "%.79s", x.name);
	}
	return true;
}

static bool same_pairs(const struct rig *a, const struct rig *b)
{
	for (int i = 0; i < pair_count; i++) {
		const struct pair *pair = &pairs[i];
		const union iec_value x = image_get(&a->resource.image, pair->a);
		const union iec_value y = image_get(&b->resource.image, pair->b);
		const bool text = pair->a.type == IEC_STRING;

		if (pair->b.type == pair->a.type && (text ?
		    x.s->length == y.s->length &&
		    memcmp(x.s->text, y.s->text, x.s->length) == 0 : x.i == y.i))
			continue;
		printf("# %s differs\n", pair->name);
		return false;
	}
	return memcmp(image_area((struct image *)&a->resource.image, AREA_M),
		      image_area((struct image *)&b->resource.image, AREA_M), 24) == 0 &&
	       memcmp(image_area((struct image *)&a->resource.image, AREA_Q),
		      image_area((struct image *)&b->resource.image, AREA_Q), 15) == 0 &&
	       a->resource.vm.errors == b->resource.vm.errors &&
	       a->resource.state == b->resource.state;
}

/* The old program runs on beside the new one: both give the same. */
static bool go_on(struct rig *old, struct rig *new)
{
	if (!find_pairs(old, new))
		return false;
	for (int i = 0; i < 30; i++) {
		if (!same_pairs(old, new))
			return false;
		if (old->resource.state != STATE_RUN)
			return true;
		scan_both(old, new);
	}
	return same_pairs(old, new);
}

static int changed;

static bool test_seed(uint64_t seed)
{
	static struct random_program program;
	struct rig old, new, same;
	bool good = true;

	random_make(&program, seed);
	random_seed(&source, seed);
	if (program.rungs < RANDOM_RUNGS && build(&old, &program)) {
		bool built = build(&same, &program);

		for (int i = 0; i < 25 && old.resource.state == STATE_RUN; i++)
			scan_both(&old, NULL);
		change(&same, &old);
		good = built && memcmp(same.memory, old.memory, image_memory_size(
				       ladder_program(old.ladder))) == 0;
		rig_close(&same);
		add_rung(&program);
		built = build(&new, &program);
		if (built) {
			change(&new, &old);
			good = good && go_on(&old, &new);
			changed++;
		}
		rig_close(&new);
	}
	rig_close(&old);
	if (!good)
		printf("# seed %llu\n", (unsigned long long)seed);
	return good;
}

static void test_random(void)
{
	const int seeds = tap_rounds(SEEDS);
	int good = 0;

	for (int seed = 1; seed <= seeds; seed++)
		good += test_seed((uint64_t)seed);
	printf("# %d programs were changed\n", changed);
	CHECK(good == seeds);
	CHECK(changed > seeds / 2);
}

/* ---- charts ---- */

#define CHART(evolution, first, other) \
	"VAR\n  Go AT %IX0.0 : BOOL;\n  Valve : BOOL;\n  Late : BOOL;\n" \
	"  Once : INT;\nEND_VAR\n" \
	"PROGRAM Main SFC" evolution "\n" first \
	"INITIAL_STEP Idle:\nEND_STEP\n" \
	"STEP Fill:\n  Valve(S);\n  Late(SD, T#100ms);\n  Count(P1);\nEND_STEP\n" \
	"STEP Hold:\nEND_STEP\nSTEP Empty:\n  Valve(R);\n  Late(R);\nEND_STEP\n" \
	other \
	"TRANSITION FROM Idle TO Fill := Go; END_TRANSITION\n" \
	"TRANSITION FROM Fill TO Hold := Fill.T >= T#30ms; END_TRANSITION\n" \
	"TRANSITION FROM Hold TO Empty := Hold.T >= T#90ms; END_TRANSITION\n" \
	"TRANSITION FROM Empty TO Idle := NOT Go; END_TRANSITION\n" \
	"ACTION Count:\n  LD Once\n  ADD 1\n  ST Once\nEND_ACTION\n" \
	"END_PROGRAM\n"
static const char sfc[] = CHART("", "", "");
static const char sfc_in_order[] = CHART(" IN ORDER", "", "");
/* Adds steps before and behind, one of them initial, and CONTROL. */
#define MORE(evolution) CHART(evolution, \
	"CONTROL(HOLD := %MX7.0);\nINITIAL_STEP Other:\n  %MX8.0(N);\nEND_STEP\n", \
	"STEP Else:\nEND_STEP\n" \
	"TRANSITION FROM Other TO Else := %IX0.7; END_TRANSITION\n" \
	"TRANSITION FROM Else TO Other := %IX0.6; END_TRANSITION\n")
static const char more_sfc[] = MORE("");
static const char more_in_order[] = MORE(" IN ORDER");

static bool same_sfc(struct rig *a, struct rig *b)
{
	static const char *const names[] = {
		"Valve", "Late", "Once", "Main.Idle.X", "Main.Fill.X", "Main.Hold.X",
		"Main.Empty.X", "Main.Fill.T", "Main.Hold.T", "Main.Empty.T",
	};
	bool same = true;

	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++)
		same &= rig_get(a, names[i]) == rig_get(b, names[i]);
	return same;
}

/* The chart goes on in the same way, whatever its state at the change. */
static void test_sfc(const char *from, const char *to)
{
	bool same = true, alone = true;

	for (int at = 1; at < 30; at++) {
		struct rig old, new;

		rig_open(&old, from, true);
		rig_open(&new, to, true);
		for (int i = 0; i < at; i++) {
			rig_set(&old, "Go", i > 1 && i < 25);
			rig_scan(&old);
		}
		change(&new, &old);
		for (int i = at; i < 40; i++) {
			rig_set(&old, "Go", i > 1 && i < 25);
			rig_set(&new, "Go", i > 1 && i < 25);
			rig_scan(&old);
			rig_scan(&new);
			same &= same_sfc(&old, &new);
			alone &= !rig_get(&new, "Main.Other.X");
		}
		CHECK(rig_get(&old, "Once") == 1 && !rig_get(&old, "Valve"));
		rig_close(&old);
		rig_close(&new);
	}
	CHECK(same);
	CHECK(alone); /* a change is not a start */
}

int main(void)
{
	test_sfc(sfc, more_sfc);
	test_sfc(sfc_in_order, more_in_order);
	test_sfc(sfc, more_in_order);
	test_sfc(sfc_in_order, more_sfc);
	test_random();
	test_values();
	test_texts_of_inputs();
	test_forces();
	test_tasks();
	test_fault();
	test_edges();
	test_pointers();
	test_held_blocks();
	return tap_done();
}
