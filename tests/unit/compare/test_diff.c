/* SPDX-License-Identifier: MIT
 *
 * test_diff - two programs and their differences.
 */
#include "engine/model/project.h"
#include "engine/text/text.h"
#include "engine/compare/diff_match.h"
#include "engine/compare/compare.h"
#include "tests/tap.h"

#include <stdlib.h>

static struct sink_memory memory;
static struct diag_list diags;
static int count;

static struct project *read_text(const char *body)
{
	struct project *project = project_new("test.rung");
	size_t size = strlen(body) + 40;
	char *text = malloc(size);

	snprintf(text, size, "RUNGBOARD 1\n%s", body);
	diag_init(&diags);
	CHECK_AS(text_read(project, "test.rung", text, strlen(text), NULL,
			   &diags), "the program can be read");
	free(text);
	return project;
}

static const char *compare(const char *a, const char *b, bool json)
{
	struct project *x = read_text(a), *y = read_text(b);
	struct sink sink = sink_to_memory(&memory);

	sink_memory_free(&memory);
	count = compare_projects(x, y, json, &sink);
	project_free(x);
	project_free(y);
	return sink_memory_text(&memory);
}

static const char *rungs(const char *a, const char *b)
{
	static char x[20000], y[20000];

	snprintf(x, sizeof(x), "PROGRAM Main LD\n%sEND_PROGRAM\n", a);
	snprintf(y, sizeof(y), "PROGRAM Main LD\n%sEND_PROGRAM\n", b);
	return compare(x, y, false);
}

static void test_cells(void)
{
	const char *seal = "RUNG Seal\n| NO Open | NC Stop | COIL M |\n"
			   "| NO M ^|\n";
	const char *got;

	CHECK_TEXT(rungs(seal, seal), "");
	CHECK(count == 0);
	got = rungs(seal, "RUNG Seal\n| NO Open | NC Stop | COIL M |\n"
			  "| NC M ^|\n");
	CHECK_TEXT(got, "Main rung 1 (Seal) cell (2,1): NO M -> NC M\n");
	CHECK(count == 1);
	got = rungs(seal, "RUNG Seal \"keeps on\"\n"
			  "| NO Open | NC Stop (* red *) | COIL M |\n"
			  "| NO M |\n");
	CHECK_TEXT(got,
		   "Main rung 1 (Seal): title nothing -> keeps on\n"
		   "Main rung 1 (Seal) cell (1,2): comment nothing -> "
		   "(* red *)\n"
		   "Main rung 1 (Seal) cell (2,1): link removed\n");
	CHECK(count == 3);
	got = rungs("RUNG\n| NO A | TON T PT:=T#3s ET=>E | COIL M |\n",
		    "RUNG OFF\n| NO A | TON T PT:=T#5s Q=>F |\n");
	CHECK_TEXT(got,
		   "Main rung 1: switched off\n"
		   "Main rung 1 cell (1,2) TON T: PT T#3s -> T#5s\n"
		   "Main rung 1 cell (1,2) TON T: ET => E -> nothing\n"
		   "Main rung 1 cell (1,2) TON T: Q nothing -> => F\n"
		   "Main rung 1 cell (1,3): COIL M -> nothing\n");
	CHECK(count == 5);
}

#define R(n) "RUNG\n| NO I" #n " | COIL Q" #n " |\n"
#define L(n) "RUNG L" #n "\n| NO I" #n " | COIL Q" #n " |\n"

static void test_rungs(void)
{
	CHECK_TEXT(rungs(R(1) R(2) R(3), R(1) R(9) R(2) R(3)),
		   "Main rung 2: added\n");
	CHECK_TEXT(rungs(R(1) R(2) R(3), R(1) R(3)), "Main rung 2: removed\n");
	CHECK_TEXT(rungs(R(1) R(2) R(3) R(4), R(2) R(3) R(4) R(1)),
		   "Main rung 1: moved to rung 4\n");
	CHECK_TEXT(rungs(L(1) R(2) R(3) R(4),
			 R(2) R(3) R(4) "RUNG L1\n| NO X | COIL Y |\n"),
		   "Main rung 1 (L1): moved to rung 4\n"
		   "Main rung 1 (L1) cell (1,1): NO I1 -> NO X\n"
		   "Main rung 1 (L1) cell (1,2): COIL Q1 -> COIL Y\n");
	/* In one gap: one changed, one added, one removed. */
	CHECK_TEXT(rungs(R(1) R(2) R(3),
			 R(1) R(7) "RUNG\n| NC I2 | COIL Q2 |\n"),
		   "Main rung 2: added\n"
		   "Main rung 2 cell (1,1): NO I2 -> NC I2\n"
		   "Main rung 3: removed\n");
	CHECK(count == 3);
	CHECK_TEXT(rungs("", R(1) R(2)),
		   "Main rung 1: added\nMain rung 2: added\n");
	CHECK_TEXT(rungs(R(1) R(1) R(1), R(1)),
		   "Main rung 2: removed\nMain rung 3: removed\n");
}

static void test_variables(void)
{
	const char *got = compare(
		"PROJECT \"one\"\nVAR\nMotor AT %QX0.0 : BOOL;\nSpare : INT;\n"
		"Level : INT := 5;\nD : TON;\nEND_VAR\n",
		"PROJECT \"two\"\nVAR\nMOTOR AT %QX0.1 : BOOL; (* pump *)\n"
		"Level : DINT := 6;\nLamp : BOOL;\nD : TOF;\nEND_VAR\n", false);

	CHECK_TEXT(got,
		   "project: title one -> two\n"
		   "variable Motor: name Motor -> MOTOR\n"
		   "variable Motor: address %QX0.0 -> %QX0.1\n"
		   "variable Motor: comment nothing -> (* pump *)\n"
		   "variable Spare: removed\n"
		   "variable Level: type INT -> DINT\n"
		   "variable Level: initial value 5 -> 6\n"
		   "variable D: type TON -> TOF\n"
		   "variable Lamp: added\n");
	CHECK(count == 9);
	CHECK_TEXT(compare("VAR RETAIN\nA : BOOL;\nEND_VAR\n",
			   "VAR\nA : BOOL;\nEND_VAR\n", false),
		   "variable A: block RETAIN -> nothing\n");
	CHECK_TEXT(compare("VAR\nA : STRING[8];\nB : STRING;\nEND_VAR\n",
			   "VAR\nA : STRING[9];\nB : STRING[80];\nEND_VAR\n", false),
		   "variable A: type STRING[8] -> STRING[9]\n");
	/* Only the order differs. */
	CHECK_TEXT(compare("VAR\nA : BOOL;\nB : BOOL;\nEND_VAR\n",
			   "VAR\nB : BOOL;\nA : BOOL;\nEND_VAR\n", false),
		   "order, layout or comments: changed\n");
	CHECK(count == 1);
}

static void test_pous(void)
{
	CHECK_TEXT(compare("PROGRAM A LD\nEND_PROGRAM\nPROGRAM B LD\nVAR\n"
			   "X : BOOL;\nEND_VAR\nEND_PROGRAM\n",
			   "PROGRAM C LD\nEND_PROGRAM\nPROGRAM B LD\n"
			   "END_PROGRAM\n", false),
		   "program A: removed\nB variable X: removed\n"
		   "program C: added\n");
	CHECK_TEXT(compare("PROGRAM A IL\nLD X\nAND Y\nST Z\nLD V\n"
			   "END_PROGRAM\n",
			   "PROGRAM A IL\nLD X\nANDN Y\nST Z\nEND_PROGRAM\n",
			   false),
		   "A line 2: AND Y -> ANDN Y\nA line 4 LD V: removed\n");
	CHECK(count == 2);
	CHECK_TEXT(compare("VIEW\nx\nEND_VIEW\n", "VIEW\ny\nEND_VIEW\n", false),
		   "VIEW section: changed\n");
}

static void test_json(void)
{
	CHECK_TEXT(compare("PROGRAM M LD\n" L(1) "END_PROGRAM\n",
			   "PROGRAM M LD\n" "RUNG L1\n| NC I1 | COIL Q1 |\n"
			   "END_PROGRAM\n", true),
		   "[\n {\"pou\": \"M\", \"rung\": 1, \"label\": \"L1\", "
		   "\"row\": 1, \"col\": 1, \"change\": \"changed\", "
		   "\"from\": \"NO I1\", \"to\": \"NC I1\"}\n]\n");
	CHECK_TEXT(compare("", "", true), "[]\n");
}

/* Many rungs: a few changes are found; a completely different program does not hang. */
static void test_large(void)
{
	enum { RUNGS = 5000, SIZE = RUNGS * 60 };
	char *a = calloc(SIZE, 1), *b = calloc(SIZE, 1);
	size_t x = 0, y = 0;

	x += (size_t)snprintf(a, SIZE, "PROGRAM M LD\n");
	y += (size_t)snprintf(b, SIZE, "PROGRAM M LD\n");
	for (int i = 0; i < RUNGS; i++) {
		x += (size_t)snprintf(a + x, SIZE - x,
				      "RUNG\n| NO A%d | COIL B%d |\n", i, i);
		if (i != 100)
			y += (size_t)snprintf(b + y, SIZE - y,
				"RUNG\n| N%c A%d | COIL B%d |\n",
				i == 4000 ? 'C' : 'O', i, i);
	}
	snprintf(a + x, SIZE - x, "END_PROGRAM\n");
	snprintf(b + y, SIZE - y, "END_PROGRAM\n");
	CHECK_TEXT(compare(a, b, false),
		   "M rung 101: removed\n"
		   "M rung 4001 cell (1,1): NO A4000 -> NC A4000\n");
	y = (size_t)snprintf(b, SIZE, "PROGRAM M LD\n");
	for (int i = 0; i < RUNGS; i++)
		y += (size_t)snprintf(b + y, SIZE - y,
				      "RUNG\n| NO C%d | COIL D%d |\n", i, i);
	snprintf(b + y, SIZE - y, "END_PROGRAM\n");
	compare(a, b, false);
	CHECK(count == 2 * RUNGS);
	free(a);
	free(b);
}

static void test_match(void)
{
	static uint32_t a[4000], b[3000];
	static int match[4000];
	uint32_t seed = 7;
	struct arena arena;
	bool rising = true, equal = true;
	int last = -1, found = 0;

	for (int i = 0; i < 4000; i++) {
		seed = seed * 1664525u + 1013904223u;
		a[i] = seed >> 24;
	}
	for (int i = 0; i < 3000; i++) {
		seed = seed * 1664525u + 1013904223u;
		b[i] = (seed >> 20) % 8 ? a[i + 3] : seed >> 24;
	}
	arena_init(&arena);
	CHECK(diff_match(&arena, a, 3000, b, 3000, match));
	for (int i = 0; i < 3000; i++) {
		if (match[i] < 0)
			continue;
		rising = rising && match[i] > last;
		equal = equal && a[i] == b[match[i]];
		last = match[i];
		found++;
	}
	CHECK(rising && equal && found > 2500);
	CHECK(diff_match(&arena, a, 0, b, 5, match));
	arena_free(&arena);
}

static void test_config(void)
{
	const char *a = "CONFIGURATION Plant\n  AREA V 100;\n  RESOURCE Cpu\n"
			"  TASK Fast (INTERVAL := T#1ms, PRIORITY := 1);\n"
			"  TASK Slow (INTERVAL := T#1s, PRIORITY := 2);\n"
			"  PROGRAM A WITH Fast : Main;\n"
			"  END_RESOURCE\nEND_CONFIGURATION\n";

	CHECK_TEXT(compare(a, a, false), "");
	CHECK_TEXT(compare(a,
		"CONFIGURATION Plant\n  AREA V 200;\n"
		"  TASK FAST (INTERVAL := T#2ms, PRIORITY := 0, "
		"WATCHDOG := T#9ms); (* quick *)\n"
		"  TASK Other (SINGLE := I0);\n"
		"  PROGRAM A WITH Other : Mine;\nEND_CONFIGURATION\n", false),
		"configuration: resource Cpu -> nothing\n"
		"area V: bytes 100 -> 200\n"
		"task Fast: INTERVAL T#1ms -> T#2ms\n"
		"task Fast: PRIORITY 1 -> 0\n"
		"task Fast: WATCHDOG nothing -> T#9ms\n"
		"task Fast: comment nothing -> (* quick *)\n"
		"task Slow: removed\n"
		"instance A: task Fast -> Other\n"
		"instance A: program Main -> Mine\n"
		"task Other: added\n");
	CHECK_TEXT(compare(a, "", false),
		"configuration: name Plant -> nothing\n"
		"configuration: resource Cpu -> nothing\n"
		"area V: removed\ntask Fast: removed\ntask Slow: removed\n"
		"instance A: removed\n");
}

static void take_pair(void *context, struct compare_pair pair)
{
	const struct sink *sink = context;

	sink_printf(sink, "%d.%d>%d.%d%s%s ", pair.pou_a, pair.rung_a, pair.pou_b,
		    pair.rung_b, pair.moved ? " moved" : "",
		    pair.changed ? " changed" : "");
}

static const char *pairs(const char *a, const char *b)
{
	struct project *x = read_text(a), *y = read_text(b);
	struct sink sink = sink_to_memory(&memory);

	sink_memory_free(&memory);
	CHECK(compare_rungs(x, y, take_pair, &sink));
	project_free(x);
	project_free(y);
	return sink_memory_text(&memory);
}

/* Pairs name each rung once; -1: no match. */
static void test_pairs(void)
{
	static const char one[] = "PROGRAM Main LD\n"
		"RUNG A\n| NO X | COIL Y |\nRUNG B\n| NO Y | COIL Z |\n"
		"RUNG C\n| NC Z | COIL W |\nEND_PROGRAM\n";

	CHECK_TEXT(pairs(one, one), "0.0>0.0 0.1>0.1 0.2>0.2 ");
	CHECK_TEXT(pairs(one, "PROGRAM main LD\nRUNG A\n| NC X | COIL Y |\n"
		   "RUNG N\n| NO Q1 | COIL Q2 |\nRUNG C\n| NC Z | COIL W |\nEND_PROGRAM\n"),
		   "0.0>0.0 changed 0.1>0.-1 changed 0.-1>0.1 changed 0.2>0.2 ");
	CHECK_TEXT(pairs(one, "PROGRAM Main LD\nRUNG C\n| NC Z | COIL W |\n"
		   "RUNG A\n| NO X | COIL Y |\nRUNG B\n| NO Y | COIL Z |\nEND_PROGRAM\n"),
		   "0.0>0.1 0.1>0.2 0.2>0.0 moved ");
	CHECK_TEXT(pairs(one, ""), "0.0>-1.-1 changed 0.1>-1.-1 changed 0.2>-1.-1 changed ");
	CHECK_TEXT(pairs("", one), "-1.-1>0.0 changed -1.-1>0.1 changed -1.-1>0.2 changed ");
	CHECK_TEXT(pairs("PROGRAM P IL\nLD X\nEND_PROGRAM\n",
			 "PROGRAM P IL\nLD X\nEND_PROGRAM\n"), "0.-1>0.-1 ");
	CHECK_TEXT(pairs("PROGRAM P IL\nLD X\nEND_PROGRAM\n",
			 "PROGRAM P IL\nLDN X\nEND_PROGRAM\n"), "0.-1>0.-1 changed ");
	CHECK_TEXT(pairs("PROGRAM Main IL\nLD X\nEND_PROGRAM\n", one),
		   "0.-1>0.-1 changed ");
}

static void take_line(void *context, struct compare_line line)
{
	const struct sink *sink = context;

	sink_printf(sink, "%d>%d [%d] %s\n", line.line_a, line.line_b, line.indent,
		    line.text);
}

static const char *lines(const char *a, const char *b)
{
	struct project *x = read_text(a), *y = read_text(b);
	struct sink sink = sink_to_memory(&memory);

	sink_memory_free(&memory);
	CHECK(compare_lines(x, x->pou_count - 1, y, y->pou_count - 1, take_line, &sink));
	project_free(x);
	project_free(y);
	return sink_memory_text(&memory);
}

/* Pairs name each line once, removed lines before added ones. */
static void test_lines(void)
{
	static const char one[] = "PROGRAM P IL\nLD X\nST Y\nLD Z\nST W\nEND_PROGRAM\n";

	CHECK_TEXT(lines(one, "PROGRAM P IL\nLD X\nST Y\nLDN Z\nST W\nST V\n"
			 "END_PROGRAM\n"),
		   "1>1 [2] LD X\n2>2 [2] ST Y\n3>0 [2] LD Z\n0>3 [2] LDN Z\n"
		   "4>4 [2] ST W\n0>5 [2] ST V\n");
	CHECK_TEXT(lines("PROGRAM P IL\nLD X\nEND_PROGRAM\n", ""), "1>0 [2] LD X\n");
	CHECK_TEXT(lines("", "PROGRAM P IL\nLD X\nEND_PROGRAM\n"), "0>1 [2] LD X\n");
}

static const char *besides(const char *a, const char *b, const char *pou)
{
	struct project *x = read_text(a), *y = read_text(b);
	struct sink sink = sink_to_memory(&memory);

	sink_memory_free(&memory);
	count = compare_besides(x, y, pou, &sink);
	project_free(x);
	project_free(y);
	return sink_memory_text(&memory);
}

static void test_besides(void)
{
#define BODY "RUNG\n| NO A | COIL B |\nEND_PROGRAM\nPROGRAM L IL\nLD A\nEND_PROGRAM\n"
	static const char one[] = "VAR\n A AT %IX0.1 : BOOL;\nEND_VAR\nPROGRAM Main LD\n"
		"VAR\n B : BOOL;\nEND_VAR\n" BODY;
	static const char other[] = "VAR\n A AT %IX0.7 : BOOL;\nEND_VAR\n"
		"PROGRAM Main LD\nVAR\n B : BOOL := TRUE;\nEND_VAR\n"
		"RUNG\n| NC A | COIL B |\nEND_PROGRAM\n"
		"PROGRAM L IL\nLDN A\nEND_PROGRAM\n";

	CHECK_TEXT(besides(one, other, NULL),
		   "variable A: address %IX0.1 -> %IX0.7\n"
		   "Main variable B: initial value nothing -> TRUE\n");
	CHECK(count == 2);
	CHECK_TEXT(besides(one, other, "main"),
		   "Main variable B: initial value nothing -> TRUE\n");
	CHECK_TEXT(besides(one, other, "L"), "");
	CHECK_TEXT(besides(one, one, NULL), "");
	CHECK(count == 0);
	CHECK_TEXT(besides("PROGRAM Main LD\n" BODY, "PROGRAM Main LD\n" BODY
			   "PROGRAM New LD\nEND_PROGRAM\n", NULL), "program New: added\n");
#undef BODY
}

static void test_access(void)
{
#define REST "VAR\nA : INT;\nB : INT;\nEND_VAR\nPROGRAM Main LD\nEND_PROGRAM\n"
	CHECK_TEXT(compare("VAR_ACCESS\nOne : A : INT READ_ONLY;\nTwo : B : INT;\n"
			   "Old : A : INT;\nEND_VAR\n" REST,
			   "VAR_ACCESS\none : A : UINT READ_WRITE;\nTwo : A : INT; // x\n"
			   "New : B : INT READ_WRITE;\nEND_VAR\n" REST, false),
		   "access One: type INT -> UINT\n"
		   "access One: direction READ_ONLY -> READ_WRITE\n"
		   "access Two: path B -> A\n"
		   "access Two: comment nothing -> // x\n"
		   "access Old: removed\n"
		   "access New: added\n");
	CHECK(count == 6);
	/* In a configuration or beside it: the same. */
	CHECK_TEXT(compare("VAR_ACCESS\nOne : A : INT;\nEND_VAR\n" REST,
			   "VAR_ACCESS\nOne : A : INT READ_ONLY;\nEND_VAR\n" REST, false), "");
#undef REST
}

/* ---- every comment of a file ---- */

/* What a file can hold; a line each. */
static const char *const everything[] = {
	"PROJECT \"one\"", "AUTHOR \"a\"", "INCLUDE \"more.rung\"", "USES \"lib.rung\"",
	"INCLUDE \"last.rung\"", "VAR", "  G : INT;", "END_VAR", "VAR RETAIN", "END_VAR",
	"VAR CONSTANT", "  K : INT := 1;", "END_VAR", "VAR", "  H : INT;", "END_VAR",
	"TYPE", "  Pair : STRUCT", "    A : INT;", "  END_STRUCT;", "END_TYPE", "TYPE", "END_TYPE",
	"CONFIGURATION C", "VAR_GLOBAL", "  V : INT;", "END_VAR", "AREA V 100;", "RESOURCE R ON PC",
	"TASK T (INTERVAL := T#1s, PRIORITY := 1);", "PROGRAM P WITH T : Main;", "END_RESOURCE",
	"VAR_ACCESS", "  X : G : INT READ_ONLY;", "END_VAR", "END_CONFIGURATION",
	"FUNCTION F : INT IL", "VAR_INPUT", "  I : INT;", "END_VAR", "VAR_TEMP", "END_VAR", "LD I",
	"ST F", "END_FUNCTION", "FUNCTION_BLOCK B LD", "VAR_INPUT", "  I : BOOL;", "END_VAR",
	"VAR_OUTPUT", "  O : BOOL;", "END_VAR", "VAR", "END_VAR", "RUNG", "| NO I | COIL O |",
	"END_FUNCTION_BLOCK", "PROGRAM Main LD", "VAR", "  L : BOOL;", "END_VAR", "RUNG Here \"r\"",
	"| NO L | COIL L |", "| NC L ^|", "RUNG OFF", "| NO L | COIL L |", "END_PROGRAM",
	"PROGRAM Chart SFC", "VAR", "  S : BOOL;", "END_VAR", "INITIAL_STEP First:", "  Act(N);",
	"END_STEP", "STEP Second:", "END_STEP", "TRANSITION FROM First TO Second := S;",
	"END_TRANSITION", "TRANSITION FROM Second TO First:", "RUNG", "| NO S | COIL TRANSITION |",
	"END_TRANSITION", "ACTION Act:", "RUNG", "| NO S | COIL S |", "END_ACTION", "END_PROGRAM",
	"VIEW\nzoom 100\nEND_VIEW",
};
static const char *const bare[] = {
	"PROJECT \"one\"", "CONFIGURATION C", "RESOURCE R ON PC", "END_RESOURCE", "VAR_ACCESS",
	"END_VAR", "END_CONFIGURATION", "PROGRAM Main LD", "END_PROGRAM",
};

/* The canonical text of @lines with comments above and behind each. Owns: the caller. */
static char *commented(const char *const *lines, size_t line_count)
{
	static char text[20000];
	struct project *project;
	size_t used = 0;
	char *written;

	for (size_t i = 0; i < line_count; i++)
		used += (size_t)snprintf(text + used, sizeof(text) - used, "(* a%zu *)\n%s (* b%zu *)\n",
					 i, lines[i], i);
	project = read_text(text);
	written = text_write(project, &used);
	project_free(project);
	return written;
}

/* Changes each comment in turn, beside another title. */
static void try_comments(const char *const *lines, size_t line_count, int least)
{
	char *text = commented(lines, line_count), *other = strdup(text);
	const char *first = strchr(text, '\n') + 1; /* compare() writes RUNGBOARD 1 */
	char changed[16];
	int tried = 0;

	memcpy(strstr(other, "one"), "two", 3);
	for (char *at = strstr(other, "(* "); at; at = strstr(at + 1, "(* "), tried++) {
		const char kind = at[3];

		at[3] = 'x';
		snprintf(changed, sizeof(changed), "%.*s", (int)(strstr(at, "*)") - at) + 2, at);
		if (!CHECK_AS(strstr(compare(first, other + (first - text), false), changed),
			      "a changed comment is a difference"))
			printf("# %c%s in %s", kind, changed + 4, sink_memory_text(&memory));
		at[3] = kind;
	}
	CHECK(tried >= least);
	free(text);
	free(other);
}

static void test_comments(void)
{
	try_comments(everything, sizeof(everything) / sizeof(*everything), 128);
	try_comments(bare, sizeof(bare) / sizeof(*bare), 12);
}

int main(void)
{
	test_comments();
	test_cells();
	test_rungs();
	test_variables();
	test_pous();
	test_config();
	test_access();
	test_json();
	test_large();
	test_match();
	test_pairs();
	test_lines();
	test_besides();
	sink_memory_free(&memory);
	return tap_done();
}
