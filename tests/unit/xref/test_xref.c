/* SPDX-License-Identifier: MIT
 *
 * test_xref - uses of names and addresses: thing, kind, place; free addresses and
 * clashes.
 */
#include "engine/ladder.h"
#include "engine/xref/address_map.h"
#include "tests/tap.h"

#include <stdlib.h>

static const char text[] =
	"RUNGBOARD 1\n\n"
	"TYPE\n  Recipe : STRUCT\n    Speed : INT;\n  END_STRUCT;\nEND_TYPE\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL;\n  Motor AT %QX0.0 : BOOL;\n"
	"  Wide  AT %QB0   : BYTE;\n  Lamps AT %QX1.0 : ARRAY[0..9] OF BOOL;\n"
	"  Count : INT;\n  Delay : TON;\n  Some  : ARRAY[1..3] OF Recipe;\n"
	"  Note  : STRING[20];\nEND_VAR\n\n"
	"PROGRAM Main LD\nVAR\n  Count : INT;\nEND_VAR\n"
	"RUNG Here \"Count in a title\"\n"
	"  | NO Start | [ Count := Count + Some[Count].Speed MOD 3 ] | COIL Motor |\n"
	"  |         ^| TON Delay PT:=T#3s Q=>Motor              | S I0       |\n"
	"RUNG OFF\n  | NO Nobody | JMP Here |\n"
	"RUNG\n  | [ Note = 'Count' ] | JMP Lost |\n"
	"RUNG\n  | NO %MW60.%X9 | COIL %MX61.1 | COIL %MW60.9 |\n"
	"RUNG\n  | NO %IX0.0 | FOR Count := 1 TO %MW8[Count] |\nRUNG\n  | NEXT |\n"
	"END_PROGRAM\n\n"
	"PROGRAM List IL\n  LD    Count\n  ST    Some[2].Speed\n  CAL   Delay(IN := Start)\n"
	"  JMPC  End1\nEnd1:\n  LD    %QW0\n  R     Motor\nEND_PROGRAM\n";

static const char *const kind_words[XREF_KINDS] = {
	[XREF_DECLARED] = "declared", [XREF_TYPE] = "type", [XREF_READ] = "read",
	[XREF_WRITTEN] = "written", [XREF_CHANGED] = "changed", [XREF_COIL] = "coil",
	[XREF_SET] = "set", [XREF_RESET] = "reset", [XREF_CALLED] = "called",
	[XREF_JUMPED] = "jumped to", [XREF_RUN] = "run",
	[XREF_LEFT] = "left", [XREF_ENTERED] = "entered", [XREF_INITIAL] = "initial",
};

/* "Main 1 (1,2) written Main.Count", a line each. */
static void print_uses(struct ladder *ladder, const char *name, char *out, size_t size)
{
	struct project *project = ladder_project(ladder);
	struct xref xref;
	size_t len = 0;

	out[0] = '\0';
	CHECK(xref_make(&xref, project));
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];
		char what[600];

		xref_name(project, &use->target, use, what, sizeof(what));
		if (strcmp(what, name) != 0)
			continue;
		len += (size_t)snprintf(out + len, size - len, "%s %d (%d,%d) %s%s%s\n",
			use->pou < 0 ? "-" :
			project_text(project, project->pou[use->pou].name),
			use->rung, use->row, use->col, kind_words[use->kind],
			use->off ? " off" : "", use->open ? " open" : "");
	}
	xref_free(&xref);
}

static void is_used(struct ladder *ladder, const char *name, const char *want)
{
	static char out[4000];

	print_uses(ladder, name, out, sizeof(out));
	CHECK_TEXT(out, want);
}

static void test_uses(struct ladder *ladder)
{
	is_used(ladder, "Start", "- 0 (0,0) declared\nMain 1 (1,1) read\nList 0 (4,21) read\n");
	is_used(ladder, "Motor", "- 0 (0,0) declared\nMain 1 (1,3) coil\n"
		"Main 1 (2,2) written\nList 0 (8,9) reset\n");
	is_used(ladder, "Count", "- 0 (0,0) declared\nList 0 (2,9) read\n");
	is_used(ladder, "Main.Count", "Main 0 (0,0) declared\nMain 1 (1,2) written\n"
		"Main 1 (1,2) read\nMain 1 (1,2) read\nMain 5 (1,2) changed\n"
		"Main 5 (1,2) read\n");
	is_used(ladder, "Some", "- 0 (0,0) declared\nMain 1 (1,2) read open\n"
		"List 0 (3,9) written open\n");
	is_used(ladder, "Recipe", "- 0 (0,0) type\n- 0 (0,0) declared\n");
	is_used(ladder, "Recipe.Speed", "- 0 (0,0) declared\nMain 1 (1,2) read\n"
		"List 0 (3,9) written\n");
	is_used(ladder, "Delay", "- 0 (0,0) declared\nMain 1 (2,2) called\n"
		"List 0 (4,9) called\n");
	is_used(ladder, "Main:Here", "Main 1 (0,0) declared\nMain 2 (1,2) jumped to off\n");
	is_used(ladder, "Main:Lost", "Main 3 (1,2) jumped to\n");
	is_used(ladder, "List:End1", "List 0 (6,0) declared\nList 0 (5,9) jumped to\n");
	is_used(ladder, "Nobody", "Main 2 (1,1) read off\n");
	is_used(ladder, "%IX0.0", "Main 1 (2,3) set\nMain 5 (1,1) read\n");
	is_used(ladder, "%MW8", "Main 5 (1,2) read open\n");
	is_used(ladder, "%MW60", ""); /* a part of it is another address */
	is_used(ladder, "%MX61.1", "Main 4 (1,1) read\nMain 4 (1,2) coil\nMain 4 (1,3) coil\n");
	is_used(ladder, "Note", "- 0 (0,0) declared\nMain 3 (1,1) read\n");
}

/* Is one of the bits of @addr used or declared? */
static bool is_taken(const struct address_map *map, struct iec_addr addr)
{
	const uint32_t at = map->areas.at[addr.area] * 8 + addr.byte * 8 + addr.bit;

	for (uint32_t i = at; areas_have(&map->areas, addr) && i < at + addr.bits; i++)
		if (map->used[i / 8] & 1u << i % 8)
			return true;
	return false;
}

static struct iec_addr address(const char *name)
{
	struct iec_addr addr = { 0 };

	iec_addr_parse(name, strlen(name), &addr);
	return addr;
}

static void is_next(const struct address_map *map, const char *like, uint32_t count,
		    const char *after, const char *want)
{
	struct iec_addr addr = address(like), from = address(after ? after : ""), out;
	char got[32] = "none";

	if (address_map_next(map, addr.area, addr.bits, count, after ? &from : NULL, &out))
		iec_addr_print(out, got, sizeof(got));
	CHECK_TEXT(got, want);
}

/* xref_addresses() gives the same map. */
static void is_same_map(struct ladder *ladder, const struct address_map *map)
{
	struct address_map quick;
	struct xref xref;

	CHECK(xref_addresses(&xref, ladder_project(ladder)));
	CHECK(address_map_make(&quick, &xref, &xref.arena));
	CHECK(memcmp(map->used, quick.used, map->areas.size) == 0);
	CHECK(memcmp(map->reached, quick.reached, map->areas.size) == 0);
	xref_free(&xref);
}

static void test_free(struct ladder *ladder)
{
	struct address_map map;
	struct xref xref;

	CHECK(xref_make(&xref, ladder_project(ladder)));
	CHECK(address_map_make(&map, &xref, &xref.arena));
	is_same_map(ladder, &map);
	is_next(&map, "%IX0.0", 1, NULL, "%IX0.1");
	is_next(&map, "%IX0.0", 1, "%IX0.7", "%IX1.0");
	is_next(&map, "%IW0", 1, NULL, "%IW2");
	is_next(&map, "%QX0.0", 1, NULL, "%QX2.2"); /* behind the ten lamps */
	is_next(&map, "%QX0.0", 8, NULL, "%QX2.2");
	is_next(&map, "%QD0", 1, NULL, "%QD4");
	is_next(&map, "%MX0.0", 1, NULL, "%MX0.0");
	is_next(&map, "%MW0", 4, NULL, "%MW0");
	is_next(&map, "%MW0", 5, NULL, "%MW10"); /* only where an index may reach */
	is_next(&map, "%MW0", 4092, NULL, "none");
	is_next(&map, "%SW126", 1, "%SW126", "none");
	CHECK(is_taken(&map, address("%QX2.1")));
	CHECK(!is_taken(&map, address("%QX2.2")));
	CHECK(!address_map_next(&map, AREA_NONE, 1, 1, NULL, &(struct iec_addr){ 0 }));
	CHECK(!address_map_next(&map, AREA_M, 7, 1, NULL, &(struct iec_addr){ 0 }));
	xref_free(&xref);
}

/* Areas of other sizes, and addresses behind their ends, as in a program with errors. */
static void test_sizes(void)
{
	static const char sizes[] = "RUNGBOARD 1\n\nVAR\n  Far AT %VW65532 : WORD;\n"
		"  Wrong AT %QW0 : ARRAY[0..9] OF WORD;\n  Beyond AT %QB8000 : BYTE;\n"
		"  Mark AT %MB7 : BYTE;\nEND_VAR\n\nCONFIGURATION C\n  AREA Q 3;\n"
		"  AREA V 65536;\nEND_CONFIGURATION\n\nPROGRAM Main LD\nRUNG\n"
		"  | NO I0 | [ Far := 1 ] |\nEND_PROGRAM\n";
	struct ladder *ladder = ladder_new();
	struct address_clash clash[4];
	struct address_map map;
	struct xref xref;

	CHECK(ladder && ladder_load_text(ladder, "sizes.rung", sizes, strlen(sizes)));
	CHECK(xref_make(&xref, ladder_project(ladder)));
	CHECK(address_map_make(&map, &xref, &xref.arena));
	is_same_map(ladder, &map);
	is_next(&map, "%VW0", 1, "%VW65530", "%VW65534");
	is_next(&map, "%VW0", 1, "%VW65534", "none");
	is_next(&map, "%QX0.0", 1, NULL, "none");
	is_next(&map, "%MB0", 1, "%MB6", "%MB8");
	CHECK(is_taken(&map, address("%QX2.7")));
	CHECK(!is_taken(&map, address("%QX3.0")));
	CHECK(!is_taken(&map, address("%QB8000")));
	CHECK(!is_taken(&map, address("%MB0")));
	CHECK(address_map_clashes(&xref, clash, 4) == 0);
	xref_free(&xref);
	ladder_free(ladder);
}

/* Names that look like addresses, and addresses in unusual places. */
static void test_quick(void)
{
	static const char odd[] = "RUNGBOARD 1\n\nVAR\n  Delay : TON;\n  Old : COUNTED;\n"
		"  I9 : BOOL;\nEND_VAR\n\nFUNCTION_BLOCK COUNTED LD\nVAR_INPUT\n  A : BOOL;\n"
		"  Q7 : BOOL;\n  M9 : INT;\nEND_VAR\nRUNG\n  | NO Q7 | RET |\n"
		"END_FUNCTION_BLOCK\n\nCONFIGURATION C\n"
		"  TASK Fast (SINGLE := %MX40.1, PRIORITY := 1);\n"
		"  PROGRAM P WITH Fast : Main;\nEND_CONFIGURATION\n\n"
		"PROGRAM Main LD\nRUNG M50\n  | NO SYS_FIRST_SCAN | NC %MX3.1 | TON Delay "
		"PT:=%MD8 ET=>%MD12 | COIL Q6 |\nRUNG\n  | NO I3 | COUNTED Old M9:=%MW20 | "
		"COIL Q12 |\n  | NO I9 | .Q7 |\n"
		"RUNG\n  | [ %MW30 + %QW8[%MB60] > 3 ] | JMP M50 |\nRUNG OFF\n"
		"  | NO I4 | COIL %MX71.0 |\nEND_PROGRAM\n\nPROGRAM List IL\nVAR\n"
		"  Q6 : BOOL;\nEND_VAR\nM51:\n  LD    %MW80\n  GT    %MW82[%MB84]\n"
		"  JMPC  M51\n  ST    Q6\nEND_PROGRAM\n";
	struct ladder *ladder = ladder_new();
	struct address_map map;
	struct xref xref;

	CHECK(ladder != NULL);
	ladder_load_text(ladder, "odd.rung", odd, strlen(odd));
	if (!CHECK(ladder_project(ladder) != NULL))
		return;
	CHECK(xref_make(&xref, ladder_project(ladder)));
	CHECK(address_map_make(&map, &xref, &xref.arena));
	is_same_map(ladder, &map);
	CHECK(is_taken(&map, address("%MX40.1")));
	CHECK(is_taken(&map, address("%MX71.0")));
	CHECK(is_taken(&map, address("%QX0.6"))); /* used only by Main */
	CHECK(!is_taken(&map, address("%QX0.7")));
	CHECK(!is_taken(&map, address("%IX1.1")));
	xref_free(&xref);
	ladder_free(ladder);
}

static void test_clashes(struct ladder *ladder)
{
	struct address_clash clash[16];
	struct xref xref;
	char out[1000] = "", a[600], b[600];
	size_t len = 0;
	int count;

	CHECK(xref_make(&xref, ladder_project(ladder)));
	count = address_map_clashes(&xref, clash, 16);
	for (int i = 0; i < count && i < 16; i++) {
		xref_name(xref.project, &xref.use[clash[i].a].target, NULL, a, sizeof(a));
		xref_name(xref.project, &xref.use[clash[i].b].target, NULL, b, sizeof(b));
		len += (size_t)snprintf(out + len, sizeof(out) - len, "%.90s %.90s\n", a, b);
	}
	CHECK_TEXT(out, "Start %IX0.0\nMotor Wide\nMotor %QW0\nWide %QW0\nLamps %QW0\n");
	CHECK(address_map_clashes(&xref, clash, 2) == 5);
	xref_free(&xref);
}

static void test_things(struct ladder *ladder)
{
	struct address_thing *thing;
	struct xref xref;
	char out[2000] = "", name[600];
	size_t len = 0;
	int count;

	CHECK(xref_make(&xref, ladder_project(ladder)));
	count = address_map_things(&xref, &thing);
	for (int i = 0; i < count; i++) {
		xref_name(xref.project, &xref.use[thing[i].use].target, NULL, name, sizeof(name));
		len += (size_t)snprintf(out + len, sizeof(out) - len, "%.90s %u-%u %d %d %d%s\n",
			name, (unsigned)thing[i].first, (unsigned)thing[i].end, thing[i].uses,
			thing[i].coils, thing[i].writes, thing[i].open ? " open" : "");
	}
	CHECK_TEXT(out, "Start 0-1 2 0 0\n%IX0.0 0-1 2 0 0\nMotor 0-1 3 1 1\nWide 0-8 0 0 0\n"
		"%QW0 0-16 1 0 0\nLamps 8-18 0 0 0\n%MW8 64-80 1 0 0 open\n%MX61.1 489-490 3 2 0\n");
	xref_free(&xref);
}

/* Members and inputs that initial values name; the type of a function's result. */
static void test_initial(void)
{
	static const char initial[] =
		"RUNGBOARD 1\n\nTYPE\n  Bounds : STRUCT\n    Low : INT;\n    High : INT;\n"
		"  END_STRUCT;\n  Recipe : STRUCT\n    Speed : INT;\n"
		"    Limit : Bounds := (High := 9);\n  END_STRUCT;\nEND_TYPE\n\n"
		"VAR\n  One : Recipe := (Speed := 1, Limit := (Low := 2, High := 3));\n"
		"  All : ARRAY[1..9] OF Recipe := [(Limit := (Low := 1)), 2(Speed := 3), "
		"2((Limit := (High := 2), Speed := 4)), 3()];\n  Fan : Seal := (Low := TRUE);\n"
		"  Delay : TON := (PT := T#1s);\nEND_VAR\n\n"
		"FUNCTION_BLOCK Seal LD\nVAR_INPUT\n  Low : BOOL;\nEND_VAR\n"
		"RUNG\n  | NO Low | COIL Q0 |\nEND_FUNCTION_BLOCK\n\n"
		"FUNCTION Least : Bounds LD\nVAR_INPUT\n  X : Bounds;\nEND_VAR\n"
		"RUNG\n  | MOVE IN:=X OUT=>Least |\nEND_FUNCTION\n";
	struct ladder *ladder = ladder_new();

	CHECK(ladder_load_text(ladder, "initial.rung", initial, strlen(initial)));
	is_used(ladder, "Bounds.Low", "- 0 (0,0) initial\n- 0 (0,0) initial\n"
		"- 0 (0,0) declared\n");
	is_used(ladder, "Bounds.High", "- 0 (0,0) initial\n- 0 (0,0) initial\n"
		"- 0 (0,0) declared\n- 0 (0,0) initial\n");
	is_used(ladder, "Recipe.Speed", "- 0 (0,0) initial\n- 0 (0,0) initial\n"
		"- 0 (0,0) initial\n- 0 (0,0) declared\n");
	is_used(ladder, "Seal.Low", "- 0 (0,0) initial\nSeal 0 (0,0) declared\n"
		"Seal 1 (1,1) read\n");
	is_used(ladder, "Bounds", "- 0 (0,0) declared\n- 0 (0,0) type\n"
		"Least 0 (0,0) type\nLeast 0 (0,0) type\n");
	ladder_free(ladder);
}

/* A constant in a count of repetitions is used; a function with a ( behind it is none. */
static void test_counts(void)
{
	static const char counts[] =
		"RUNGBOARD 1\n\nTYPE\n  Recipe : STRUCT\n    Speed : INT;\n"
		"    Steps : ARRAY[1..4] OF INT := [Motors(8)];\n  END_STRUCT;\nEND_TYPE\n\n"
		"VAR CONSTANT\n  Motors : INT := 2;\nEND_VAR\n\n"
		"VAR\n  A : ARRAY[1..9] OF INT := [2 * Motors(7), MAX(1, 2), Motors()];\n"
		"  B : ARRAY[1..9] OF Recipe := [Motors((Speed := 1, Steps := [(Motors)(5)])), "
		"Motors + 1(Speed := ABS(-3))];\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | [ A[1] > B[1].Speed ] | COIL Q0 |\nEND_PROGRAM\n";
	struct ladder *ladder = ladder_new();

	CHECK(ladder_load_text(ladder, "counts.rung", counts, strlen(counts)));
	is_used(ladder, "Motors", "- 0 (0,0) declared\n- 0 (0,0) read\n- 0 (0,0) read\n"
		"- 0 (0,0) read\n- 0 (0,0) read\n- 0 (0,0) read\n- 0 (0,0) read\n");
	is_used(ladder, "Recipe.Speed", "- 0 (0,0) initial\n- 0 (0,0) initial\n"
		"- 0 (0,0) declared\nMain 1 (1,1) read\n");
	ladder_free(ladder);
}

/* Types with a name and values of enumerations, wherever they stand. */
static void test_types(void)
{
	static const char types[] =
		"RUNGBOARD 1\n\nTYPE\n  Color : (Red, Green, Blue) := Green;\n"
		"  Signal : (Off, Red);\n  Part : INT (0..Limit) := 5;\n"
		"  Row : ARRAY[1..3] OF Color := [Color#Red, 2(Blue)];\n  Line : STRUCT\n"
		"    C : Color := Red;\n    P : Part;\n  END_STRUCT;\n"
		"  Far : Line := (C := Color#Red);\nEND_TYPE\n\nVAR CONSTANT\n  Limit : INT := 9;\n"
		"END_VAR\n\nFUNCTION After : Color ST\nVAR_INPUT\n  C : Color;\nEND_VAR\n"
		"  CASE C OF\n    Color#Red: After := Green;\n    Green: After := Color.Blue;\n"
		"  END_CASE;\nEND_FUNCTION\n\nPROGRAM Main LD\nVAR\n  A, B : (Up, Down);\n"
		"  C : Color;\n  S : Signal := Red;\n  To : POINTER TO Line;\n  F : Far;\n"
		"END_VAR\nVAR_EXTERNAL\n  Limit : INT;\nEND_VAR\n"
		"RUNG\n  | [ C = Blue ] | MOVE IN:=Green OUT=>C | [ A := Up ] | [ S := Off ] |\n"
		"END_PROGRAM\n\nPROGRAM List IL\nVAR\n  C : ARRAY[0..1] OF Row;\n"
		"  Up : INT;\nEND_VAR\n  LD Color#Green\n  ST C[0][1]\n  LD Up\n  ST Up\nEND_PROGRAM\n";
	struct ladder *ladder = ladder_new();

	CHECK(ladder_load_text(ladder, "types.rung", types, strlen(types)));
	is_used(ladder, "Color", "- 0 (0,0) type\n- 0 (0,0) declared\n- 0 (0,0) type\n"
		"- 0 (0,0) read\n- 0 (0,0) read\nAfter 0 (0,0) type\nAfter 0 (0,0) type\nMain 0 (0,0) type\n"
		"After 0 (6,5) read\nAfter 0 (7,21) read\nList 0 (6,6) read\n");
	is_used(ladder, "Color#Red", "- 0 (0,0) read\n- 0 (0,0) declared\n- 0 (0,0) read\n"
		"- 0 (0,0) read\nAfter 0 (6,11) read\n");
	is_used(ladder, "Signal#Red", "- 0 (0,0) declared\nMain 0 (0,0) read\n");
	is_used(ladder, "Color#Blue", "- 0 (0,0) declared\n- 0 (0,0) read\n"
		"After 0 (7,27) read\nMain 1 (1,1) read\n");
	is_used(ladder, "Main.A#Up", "Main 0 (0,0) declared\nMain 1 (1,3) read\n");
	is_used(ladder, "Part", "- 0 (0,0) type\n- 0 (0,0) declared\n");
	is_used(ladder, "Limit", "- 0 (0,0) declared\n- 0 (0,0) read\n");
	is_used(ladder, "Row", "- 0 (0,0) declared\nList 0 (0,0) type\n");
	is_used(ladder, "Line", "- 0 (0,0) declared\n- 0 (0,0) type\nMain 0 (0,0) type\n");
	is_used(ladder, "Far", "- 0 (0,0) declared\nMain 0 (0,0) type\n");
	is_used(ladder, "Line.C", "- 0 (0,0) declared\n- 0 (0,0) initial\n");
	ladder_free(ladder);
}

int main(void)
{
	struct ladder *ladder = ladder_new();
	size_t len = strlen(text);

	CHECK(ladder_load_text(ladder, "test.rung", text, len));
	CHECK_AS(!ladder_build(ladder), "a program with errors is not built");
	test_uses(ladder);
	test_free(ladder);
	test_sizes();
	test_quick();
	test_clashes(ladder);
	test_things(ladder);
	test_initial();
	test_counts();
	test_types();
	ladder_free(ladder);
	return tap_done();
}
