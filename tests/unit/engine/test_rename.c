/* SPDX-License-Identifier: MIT
 *
 * test_rename - each name of each sample is replaced by a new one: the program must
 * stay the same, and renaming it back gives the same bytes. And refusals.
 */
#include "engine/ladder.h"
#include "engine/model/init.h"
#include "engine/xref/xref.h"
#include "tests/tap.h"

#include <glob.h>
#include <stdlib.h>

static struct ladder *loaded(const char *text)
{
	struct ladder *ladder = ladder_new();

	if (!ladder_load_text(ladder, "test.rung", text, strlen(text))) {
		char line[200];

		diag_print(&ladder_diags(ladder)->diag[0], line, sizeof(line));
		printf("# %s\n", line);
	}
	return ladder;
}

/* The declared thing of this name; XREF_UNKNOWN: none. */
static struct xref_target target_of(struct ladder *ladder, const char *name)
{
	struct xref_target target = { .what = XREF_UNKNOWN };
	struct xref xref;
	char text[600];

	CHECK(xref_make(&xref, ladder_project(ladder)));
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];

		xref_name(xref.project, &use->target, use, text, sizeof(text));
		if (use->kind == XREF_DECLARED && strcmp(text, name) == 0)
			target = use->target;
	}
	xref_free(&xref);
	return target;
}

/* ---- all names of all samples ---- */

static bool identity_of(const char *file, const char *text, uint8_t out[32])
{
	struct ladder *ladder = ladder_new();
	bool good = ladder_load_text(ladder, file, text, strlen(text)) &&
		    ladder_build(ladder);

	if (good)
		code_identity(ladder_program(ladder), out);
	else if (ladder_diags(ladder)->count)
		printf("# %s: %s %s\n", file, diag_text(ladder_diags(ladder)->diag[0].id),
		       ladder_diags(ladder)->diag[0].arg);
	ladder_free(ladder);
	return good;
}

/* Renames and renames back; true if the text is the same again. */
static bool renames(struct ladder *ladder, const char *file,
		    const struct xref_target *target, const char *old, const char *text,
		    const uint8_t identity[32])
{
	struct ladder_rename how;
	struct ladder *again;
	size_t len;
	uint8_t got[32];
	char *renamed = ladder_rename(ladder, target, "Zq_fresh", &len, &how), *back;
	bool good;

	if (!renamed) {
		printf("# %s: %s: refused, %d\n", file, old, how.why);
		return false;
	}
	good = strcmp(renamed, text) != 0 && strstr(renamed, "Zq_fresh") &&
	       identity_of(file, renamed, got) && memcmp(got, identity, 32) == 0;
	if (!good)
		printf("# %s: %s: another program\n", file, old);
	again = ladder_new();
	ladder_load_text(again, file, renamed, len);
	back = ladder_rename(again, target, old, &len, &how);
	if (!back || strcmp(back, text) != 0) {
		printf("# %s: %s: not back again, %d\n", file, old, how.why);
		good = false;
	}
	ladder_free(again);
	free(back);
	free(renamed);
	return good;
}

/* Renames each declared name and back. Counts what went wrong, and uses without a meaning, in @bad. */
static int rename_all(struct ladder *ladder, const char *file, const char *text, const uint8_t identity[32],
		      int *bad)
{
	struct xref xref;
	int count = 0;

	xref_make(&xref, ladder_project(ladder));
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];

		if (use->target.what == XREF_UNKNOWN)
			printf("# unknown %s\n", xref_text(&xref, use));
		*bad += use->target.what == XREF_UNKNOWN;
		if (use->kind != XREF_DECLARED)
			continue;
		count++;
		*bad += !renames(ladder, file, &use->target,
				 project_text(xref.project, *use->slot), text, identity);
	}
	xref_free(&xref);
	return count;
}

static int sample(const char *file, int *bad)
{
	struct ladder *ladder = ladder_new();
	struct xref xref;
	size_t len;
	char *text = NULL;
	uint8_t identity[32];
	int count = 0;

	CHECK_AS(ladder_load(ladder, file) && (text = ladder_write(ladder, &len)) &&
		 identity_of(file, text, identity), file);
	xref_make(&xref, ladder_project(ladder));
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];

		if (use->kind != XREF_DECLARED)
			continue;
		*bad += !renames(ladder, file, &use->target,
				 project_text(xref.project, *use->slot), text, identity);
		count++;
	}
	free(text);
	xref_free(&xref);
	ladder_free(ladder);
	return count;
}

/* All samples; in an emulator every tenth. */
static void test_samples(void)
{
	const size_t step = 10 / (size_t)tap_rounds(10);
	glob_t found;
	int count = 0, bad = 0;

	CHECK(glob("ladders/*.rung", 0, NULL, &found) == 0);
	for (size_t i = 0; i < found.gl_pathc; i += step)
		count += sample(found.gl_pathv[i], &bad);
	globfree(&found);
	printf("# %d names\n", count);
	CHECK_AS(bad == 0 && count > tap_rounds(200),
		 "each name of the samples is renamed and renamed back");
}

/* ---- blocks, functions, structures, lists, tasks ---- */

static const char rich[] =
	"RUNGBOARD 1\n\n"
	"TYPE\n  Recipe : STRUCT\n    Speed : INT := 5;\n"
	"    Times : ARRAY[1..3] OF INT;\n  END_STRUCT;\nEND_TYPE\n\n"
	"CONFIGURATION Plant\n"
	"  TASK Fast (SINGLE := Go, PRIORITY := 0);\n"
	"  PROGRAM One WITH Fast : Main;\n  PROGRAM Two : List;\n"
	"VAR_ACCESS\n  Push : Go : BOOL READ_ONLY;\n  Also : Main.Go2 : BOOL READ_WRITE;\n"
	"  Third : Some[3].Speed : INT READ_WRITE;\n  Mixes : Some : ARRAY[1..4] OF Recipe;\n"
	"  Runs : Two.Other.Run : BOOL;\nEND_VAR\nEND_CONFIGURATION\n\n"
	"VAR\n  Go   AT %IX0.0 : BOOL;\n  Lamp AT %QX0.0 : BOOL;\n  Fan  : Seal;\n"
	"  Some : ARRAY[1..4] OF Recipe := [(Speed := 3), 2(Times := [2(7)])];\n"
	"  i    : INT := 1;\nEND_VAR\n\n"
	"FUNCTION_BLOCK Seal LD\nVAR_INPUT\n  On   : BOOL;\n  Stop : BOOL;\nEND_VAR\n"
	"VAR_OUTPUT\n  Run : BOOL;\nEND_VAR\nVAR_IN_OUT\n  Count : INT;\nEND_VAR\n"
	"RUNG\n  | NO On   | NC Stop | COIL Run |\n  | NO Run ^|\n"
	"RUNG\n  | P Run | [ Count := Count + 1 ] |\nEND_FUNCTION_BLOCK\n\n"
	"FUNCTION Twice : INT IL\nVAR_INPUT\n  X : INT;\nEND_VAR\n"
	"  LD    X\n  MUL   2\n  ST    Twice\nEND_FUNCTION\n\n"
	"SUBROUTINE Sub LD\nRUNG\n  | NO Go | COIL Lamp |\nEND_SUBROUTINE\n\n"
	"PROGRAM Main LD\nVAR\n  Go2 : BOOL;\nEND_VAR\n"
	"RUNG Here\n  | NO Go  | Seal Fan Count:=Some[i].Speed | COIL %QX0.1 |\n"
	"  | NO Go2 | .Stop                         |\n"
	"RUNG\n  | NO Fan.Run | [ Some[i + 1].Times[2] := Some[2].Speed * i ] |\n"
	"RUNG\n  | NO Go | Twice X:=i OUT=>i | CALL Sub | S Go2 |\n"
	"RUNG\n  | NO Go | FOR i := 1 TO Some[1].Speed |\n"
	"RUNG\n  | NO Go | COIL %MX0.0 |\nRUNG\n  | NEXT |\n"
	"RUNG\n  | NO Go2 | JMP Here |\nEND_PROGRAM\n\n"
	"PROGRAM List IL\nVAR\n  Other : Seal;\nEND_VAR\n"
	"  CAL   Other(On := Go, Stop := Lamp, Count := i, Run => %MX1.0)\n"
	"  LD    Other.Run\n  JMPC  There\n  LD    i\n  Twice\n  ST    i\n"
	"  Twice(X := i, OUT => i)\n  CAL   Sub\nThere:\n  LD    Go\n  ST    %QX0.5\n"
	"END_PROGRAM\n";

static void test_rich(void)
{
	struct ladder *ladder = loaded(rich);
	size_t len;
	char *text = ladder_write(ladder, &len);
	uint8_t identity[32];
	int bad = 0, count;

	CHECK(text && identity_of("rich", text, identity));
	count = rename_all(ladder, "rich", text, identity, &bad);
	CHECK_AS(bad == 0, "blocks, functions, members, labels, subroutines, tasks");
	CHECK(count == 22);
	free(text);
	ladder_free(ladder);
}

/* ---- constants and functions in expressions ---- */

static const char computed[] =
	"RUNGBOARD 1\n\n"
	"TYPE\n  Recipe : STRUCT\n    Speed : INT := Limit / 2;\n"
	"    Steps : ARRAY[1..Count] OF INT := [Limit - 1, Count - 1(Limit)];\n"
	"    Name  : STRING[Count + 4];\n  END_STRUCT;\nEND_TYPE\n\n"
	"VAR\n  Max   : INT := LIMIT(0, Limit - 1, Count);\n"
	"  Table : ARRAY[-Count..Limit * 2] OF INT := [Limit, Count(Count), MAX(Base, 2)(7), 2 * Count(8)];\n"
	"  Best  : Recipe := (Speed := Limit * 3, Steps := [Count]);\nEND_VAR\n\n"
	"VAR CONSTANT\n  Limit : INT := Base * 2;\n  Base  : INT := 5;\n"
	"  Count : INT := 3;\nEND_VAR\n\n"
	"FUNCTION Twice : STRING[Limit] LD\nVAR_INPUT\n  X : INT := Count;\nEND_VAR\n"
	"RUNG\n  | MOVE IN:='a' OUT=>Twice |\nEND_FUNCTION\n\n"
	"FUNCTION Sum : INT LD\nVAR_INPUT\n  X : INT;\n  Y : INT;\nEND_VAR\n"
	"RUNG\n  | [ Sum := X + Y ] |\nEND_FUNCTION\n\n"
	"PROGRAM Main LD\nVAR CONSTANT\n  Base : INT := Limit + 1;\nEND_VAR\n"
	"VAR\n  X : INT := Base;\nEND_VAR\n"
	"RUNG\n  | [ X := Sum(Y := X, X := LIMIT(0, Max, 10)) + Table[1] + Best.Speed ] |\n"
	"END_PROGRAM\n";

/* One more declaration: it is computed too, or not added. */
static void test_added(struct ladder *ladder)
{
	static const char good[] = "New : INT := Limit + 1;", bad[] = "Bad : INT := Lmit + 1;";
	const struct var_table *table = &ladder_project(ladder)->globals;
	const int count = table->count;
	struct init_value value = { .type = IEC_INT };
	struct diag_list diags;

	diag_init(&diags);
	CHECK(ladder_read_var(ladder, -1, 0, good, strlen(good), &diags) &&
	      table->count == count + 1 && table->var[3].init.i == 11);
	CHECK(!ladder_read_var(ladder, -1, 0, bad, strlen(bad), &diags) &&
	      diags.diag[0].id == DIAG_UNKNOWN_NAME && table->count == count + 1);
	CHECK(ladder_constant(ladder, 0, "Limit * 2", 9, &value, &diags) && value.value.i == 20 &&
	      strcmp(value.text, "20") == 0);
	vars_pop(&ladder_project(ladder)->globals, 0);
}

static void test_computed(void)
{
	struct ladder *ladder = loaded(computed);
	size_t len;
	char *text = ladder_write(ladder, &len);
	uint8_t identity[32];
	int bad = 0, count;

	CHECK_AS(text && strcmp(text, computed) == 0, "expressions are written as they are");
	CHECK(text && identity_of("computed", text, identity));
	count = rename_all(ladder, "computed", text, identity, &bad);
	CHECK_AS(bad == 0, "constants of declarations, functions and their inputs are renamed");
	CHECK(count == 18);
	test_added(ladder);
	free(text);
	ladder_free(ladder);
}

/* ---- types and values ---- */

static const char typed[] =
	"RUNGBOARD 1\n\nTYPE\n  Color : (Red, Green := 5, Blue) := Green;\n"
	"  Mode  : UINT (Idle := 1, Slow) := Slow;\n  Part  : INT (0..Limit) := 5;\n"
	"  Row   : ARRAY[1..3] OF Color := [Color#Red, 2(Blue)];\n"
	"  Line : STRUCT\n    C : Color := Red;\n    P : ARRAY[1..2] OF Part;\n"
	"  END_STRUCT;\n  Far : Line := (C := Blue);\nEND_TYPE\n\n"
	"VAR CONSTANT\n  Limit : INT := 9;\nEND_VAR\n\n"
	"FUNCTION After : Color ST\nVAR_INPUT\n  C : Color;\nEND_VAR\n"
	"  CASE C OF\n    Color#Red:\n      After := Green;\n    Green:\n      After := Color.Blue;\n"
	"  END_CASE;\nEND_FUNCTION\n\n"
	"PROGRAM Main LD\nVAR\n  A    : (Up, Down);\n  C    : Color;\n"
	"  To   : POINTER TO Line;\n  F    : Far;\n  Rows : ARRAY[0..1] OF Row;\n"
	"  L    : Line := (C := Green);\n  D    : Mode := Idle;\nEND_VAR\n"
	"RUNG\n  | [ C = Blue ] | MOVE IN:=Green OUT=>C | [ A := Up ] | [ C := After(C) ] |\n"
	"END_PROGRAM\n\nPROGRAM List IL\nVAR\n  C : Row;\nEND_VAR\n"
	"  LD    Color#Green\n  ST    C[1]\nEND_PROGRAM\n";

/* Every name is renamed and back; those of types and values too. */
static void test_types(void)
{
	struct ladder *ladder = loaded(typed);
	size_t len;
	char *text = ladder_write(ladder, &len);
	uint8_t identity[32];
	int bad = 0, count;

	CHECK(text && identity_of("typed", text, identity));
	count = rename_all(ladder, "typed", text, identity, &bad);
	CHECK_AS(bad == 0, "types and values are renamed and renamed back");
	CHECK(count == 28);
	free(text);
	ladder_free(ladder);
}

/* Two enumerations have the value Idle: each use is of the one that it meets. */
static const char shared[] =
	"RUNGBOARD 1\n\nTYPE\n  Phase : (Idle, Run, Done);\n  Mode  : (Idle, Auto, Hand);\nEND_TYPE\n\n"
	"FUNCTION Pick : Mode ST\nVAR_INPUT\n  m : Mode;\n  p : Phase;\nEND_VAR\n"
	"  Pick := SEL(p = Idle, Idle, m);\nEND_FUNCTION\n\n"
	"FUNCTION_BLOCK Keep ST\nVAR_INPUT\n  m : Mode;\n  p : Phase;\nEND_VAR\n  m := Idle;\nEND_FUNCTION_BLOCK\n\n"
	"PROGRAM Main ST\nVAR\n  Now  : Phase := Idle;\n  How  : Mode := Idle;\n  List : ARRAY[1..2] OF Mode;\n"
	"  K    : Keep;\nEND_VAR\n"
	"  Now := Idle;\n  How := Idle;\n  How := Pick(m := Idle, p := Idle);\n  How := Pick(Idle, Idle);\n"
	"  K(m := Idle, p := Idle);\n"
	"  List[1] := SEL(Now = Idle, Idle, Auto);\n"
	"  IF Idle = How OR Idle = Now OR List[2] <> Idle AND Phase#Idle = Now THEN\n    RETURN;\n  END_IF;\n"
	"  CASE Now OF\n    Idle, Run:\n      CASE How OF\n        Idle:\n          How := Hand;\n      END_CASE;\n"
	"    Done:\n      Now := Idle;\n  END_CASE;\nEND_PROGRAM\n";

/* The text in which the occurrences of Idle that @which has a 1 for are called @name. Caller frees. */
static char *with_some(const char *which, const char *name)
{
	struct sink_memory memory;
	const char *at = shared, *next;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	for (; *which && (next = strstr(at, "Idle")); at = next + 4, which++) {
		sink_write(&sink, at, (size_t)(next - at));
		sink_text(&sink, *which == '1' ? name : "Idle");
	}
	sink_text(&sink, at);
	return memory.text;
}

static void renamed_to(struct ladder *ladder, const char *old, const char *name, const char *which, int places)
{
	const struct xref_target target = target_of(ladder, old);
	struct ladder_rename how;
	size_t len;
	char *text = ladder_rename(ladder, &target, name, &len, &how), *want = with_some(which, name);

	CHECK_AS(text && strcmp(text, want) == 0, old);
	if (!text || strcmp(text, want) != 0)
		printf("# %d\n%s\n# wanted:\n%s\n", how.why, text ? text : "", want);
	CHECK(how.places == places);
	free(text);
	free(want);
}

static void test_shared(void)
{
	struct ladder *ladder = loaded(shared);

	/* Declared; Pick, Keep; the variables; Now, How; Pick twice; K; SEL; the IF; the CASEs. */
	renamed_to(ladder, "Phase#Idle", "Rest", "10" "10" "0" "10" "10" "01" "01" "01" "10" "0101" "101", 12);
	renamed_to(ladder, "Mode#Idle", "Still", "01" "01" "1" "01" "01" "10" "10" "10" "01" "1010" "010", 12);
	ladder_free(ladder);
}

/* ---- refusals ---- */

static void refused(struct ladder *ladder, const char *old, const char *name,
		    enum ladder_refusal want, int rung)
{
	struct xref_target target = target_of(ladder, old);
	struct ladder_rename how;
	size_t len, before_len;
	char *before = ladder_write(ladder, &before_len), *after;
	char *text = ladder_rename(ladder, &target, name, &len, &how);
	char what[600];

	snprintf(what, sizeof(what), "%s to %.60s is refused: %d in rung %d", old, name, want, rung);
	CHECK_AS(!text && how.why == want && how.rung == rung, what);
	if (text || how.why != want || how.rung != rung)
		printf("# %d rung %d %s\n", how.why, how.rung, text ? text : "");
	after = ladder_write(ladder, &len);
	CHECK_AS(strcmp(before, after) == 0,
		 "a refused rename does not change the project");
	free(text);
	free(before);
	free(after);
}

static void test_refused_types(void)
{
	struct ladder *ladder = loaded(
		"RUNGBOARD 1\n\nTYPE\n  Color : (Red, Green);\n  Signal : (Idle := 1, Low);\n"
		"END_TYPE\n\nVAR\n  Level : INT;\nEND_VAR\n\n"
		"PROGRAM Main LD\nVAR\n  C : Color;\n  Up : BOOL;\n  A, B : (In, Out);\nEND_VAR\n"
		"RUNG\n  | NO Up | [ C := Red ] | [ A := Out ] | [ Level := 1 ] |\nEND_PROGRAM\n");

	refused(ladder, "Color", "main", RENAME_TAKEN, 0);
	refused(ladder, "Color", "signal", RENAME_TAKEN, 0);
	refused(ladder, "Color", "Level", RENAME_TAKEN, 0);
	refused(ladder, "Color", "STRUCT", RENAME_RESERVED, 0);
	refused(ladder, "Color", "TON", RENAME_RESERVED, 0);
	refused(ladder, "Color#Red", "green", RENAME_TAKEN, 0);
	refused(ladder, "Color#Red", "Up", RENAME_MEANING, 1);  /* the variable has priority */
	refused(ladder, "Color#Red", "Idle", RENAME_MEANING, 1); /* two values have this name */
	refused(ladder, "Signal#Low", "Red", RENAME_MEANING, 1);
	refused(ladder, "Color#Red", "TRUE", RENAME_RESERVED, 0);
	refused(ladder, "Color#Red", "1x", RENAME_FORM, 0);
	ladder_free(ladder);
}

static void test_refusals(void)
{
	struct ladder *ladder = loaded(
		"RUNGBOARD 1\n\nVAR\n  A : BOOL;\n  B : BOOL;\nEND_VAR\n\n"
		"PROGRAM Main LD\nVAR\n  C : BOOL;\nEND_VAR\n"
		"RUNG One\n  | NO A | COIL C |\nRUNG Two\n  | NO B | COIL %QX0.0 |\n"
		"RUNG\n  | NO Lost | COIL %QX0.1 |\n"
		"RUNG\n  | NO %IX0.0 | COIL q5 |\nEND_PROGRAM\n\n"
		"PROGRAM Other LD\nVAR\n  A : BOOL;\nEND_VAR\n"
		"RUNG\n  | NO A | COIL B |\nEND_PROGRAM\n");
	char longest[300];

	memset(longest, 'a', sizeof(longest));
	longest[LIMIT_NAME + 1] = '\0';
	refused(ladder, "A", "B", RENAME_TAKEN, 0);
	refused(ladder, "A", "main", RENAME_TAKEN, 0);
	refused(ladder, "Main", "other", RENAME_TAKEN, 0);
	refused(ladder, "Main:One", "two", RENAME_TAKEN, 2);
	refused(ladder, "A", "C", RENAME_MEANING, 1);      /* Main's C captures it  */
	refused(ladder, "Main.C", "A", RENAME_MEANING, 1); /* the global is captured */
	refused(ladder, "B", "Lost", RENAME_MEANING, 3);   /* an unknown name gets a meaning */
	refused(ladder, "B", "A", RENAME_TAKEN, 0);
	refused(ladder, "A", "", RENAME_FORM, 0);
	refused(ladder, "A", "1x", RENAME_FORM, 0);
	refused(ladder, "A", "a b", RENAME_FORM, 0);
	refused(ladder, "A", "a.b", RENAME_FORM, 0);
	refused(ladder, "A", "(*", RENAME_FORM, 0);
	refused(ladder, "A", "a\xff", RENAME_FORM, 0);
	refused(ladder, "A", longest, RENAME_FORM, 0);
	refused(ladder, "A", "end_var", RENAME_RESERVED, 0);
	refused(ladder, "A", "SYS_new", RENAME_RESERVED, 0);
	refused(ladder, "A", "_T12", RENAME_RESERVED, 0);
	refused(ladder, "A", "Q5", RENAME_MEANING, 4);     /* an address is captured */
	refused(ladder, "Nobody", "X", RENAME_NOTHING, 0);
	ladder_free(ladder);
}

static void test_good(void)
{
	struct ladder *ladder = loaded(rich);
	struct xref_target target = target_of(ladder, "Go");
	struct ladder_rename how;
	size_t len;
	char *text = ladder_rename(ladder, &target, "\xe5\x90\xaf\xe5\x8a\xa8", &len, &how);

	CHECK(text && strstr(text, "SINGLE := \xe5\x90\xaf\xe5\x8a\xa8,"));
	CHECK_AS(how.why == RENAME_GOOD && how.places == 10,
		 "a rename counts all its places");
	free(text);
	text = ladder_rename(ladder, &target, "GO", &len, &how);
	CHECK_AS(text && strstr(text, "GO   AT %IX0.0"),
		 "a rename may change only the case");
	free(text);
	text = ladder_rename(ladder, &target, "M1", &len, &how);
	CHECK_AS(text, "a name may be an address that the project does not use");
	free(text);
	target = target_of(ladder, "Seal");
	text = ladder_rename(ladder, &target, "TON", &len, &how);
	CHECK_AS(!text && how.why == RENAME_RESERVED,
		 "a function block may not have the name of a built-in one");
	ladder_free(ladder);
}

/* ---- wires ---- */

static const char networks[] =
	"RUNGBOARD 1\n\nVAR\n  T : ARRAY[0..9] OF INT;\n  I AT %IW2 : INT;\n  Q AT %QW2 : INT;\nEND_VAR\n\n"
	"PROGRAM Main FBD\nVAR\n  Count : CTU;\nEND_VAR\nNETWORK\n  Low := I + 1\n  T[Low] := 5\n"
	"  Q := T[Low] + Low\n  T[LIMIT(0, Low, PREVIOUS(Low))] := T[T[Low]]\n  Count(PV := Low, CV => Sum)\n"
	"  Q := T[Sum]\nNETWORK\n  Low := I\n  Q := T[Low]\nEND_PROGRAM\n";

/* The variable of a wire has the number of its network in its name. */
static struct xref_target wire(struct ladder *ladder, const char *name)
{
	struct project *project = ladder_project(ladder);
	const int index = vars_find(&project->pou[0].vars, names_fold(&project->names,
		names_intern(&project->names, name, strlen(name))));

	return (struct xref_target){ .what = XREF_VARIABLE, .table = 1, .index = index };
}

static void wire_refused(struct ladder *ladder, const char *to, enum ladder_refusal why)
{
	const struct xref_target target = wire(ladder, "Low.N1");
	struct ladder_rename how;
	size_t len;
	char *text = ladder_rename(ladder, &target, to, &len, &how);

	CHECK_AS(!text && how.why == why, to);
	free(text);
}

static void test_wires(void)
{
	struct ladder *ladder = loaded(networks);
	struct xref_target target = wire(ladder, "Low.N1");
	struct ladder_rename how;
	size_t len;
	char *text = ladder_rename(ladder, &target, "High", &len, &how);

	CHECK_AS(text && how.places == 8 && strstr(text, "  High := I + 1\n  T[High] := 5\n  Q := T[High] + High\n"
		 "  T[LIMIT(0, High, PREVIOUS(High))] := T[T[High]]\n  Count(PV := High, CV => Sum)\n"),
		 "a wire is renamed wherever its network reads it, also in an index");
	CHECK_AS(text && strstr(text, "NETWORK\n  Low := I\n  Q := T[Low]\n"),
		 "the wire of another network keeps the same name");
	free(text);
	target = wire(ladder, "Sum.N1");
	text = ladder_rename(ladder, &target, "Total", &len, &how);
	CHECK_AS(text && how.places == 2 && strstr(text, "CV => Total)\n  Q := T[Total]\n"),
		 "an output that is a wire is renamed");
	free(text);
	wire_refused(ladder, "Sum", RENAME_TAKEN);
	wire_refused(ladder, "Count", RENAME_TAKEN);
	wire_refused(ladder, "Q", RENAME_MEANING);
	wire_refused(ladder, "a b", RENAME_FORM);
	ladder_free(ladder);
}

static const char spaces[] = "RUNGBOARD 1\nNAMESPACE Plant\nVAR_GLOBAL\n  Level : INT;\nEND_VAR\nTYPE\n  Part : STRUCT\n    Size : INT;\n"
	"  END_STRUCT;\nEND_TYPE\nVAR_GLOBAL\n  One : Plant.Part;\nEND_VAR\nEND_NAMESPACE\nPROGRAM Main ST\nVAR\n  I : INT;\nEND_VAR\n"
	"  Plant.Level := Plant.Level + I;\n  I := Level + Plant.One.Size;\nEND_PROGRAM\n";

static void test_spaces(void)
{
	struct ladder *ladder = loaded(spaces);
	struct xref_target target = target_of(ladder, "Level");
	struct ladder_rename how;
	size_t len;
	char *text = ladder_rename(ladder, &target, "Height", &len, &how);

	CHECK_AS(text && how.places == 4 && strstr(text, "  Plant.Height := Plant.Height + I;\n  I := Height + Plant.One.Size;\n"),
		 "a name behind its namespace is renamed");
	free(text);
	target = target_of(ladder, "One");
	text = ladder_rename(ladder, &target, "First", &len, &how);
	CHECK_AS(text && how.places == 2 && strstr(text, "Plant.First.Size;\n"), "also where a member follows");
	free(text);
	ladder_free(ladder);
}

int main(void)
{
	test_spaces();
	test_wires();
	test_rich();
	test_computed();
	test_types();
	test_shared();
	test_refused_types();
	test_refusals();
	test_good();
	test_samples();
	return tap_done();
}
