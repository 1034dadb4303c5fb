/* SPDX-License-Identifier: MIT
 *
 * test_read_errors - wrong, hostile and endless rung files: a diagnostic with its
 * place for each, and never a crash.
 *
 * What names mean is tested with check/; here only form.
 */
#include "engine/text/text.h"

#include "tests/tap.h"

#include <stdlib.h>

static struct diag_list diags;
static struct project *project;

static bool read_bytes(const char *text, size_t len)
{
	project_free(project);
	project = project_new("t.rung");
	diag_init(&diags);
	return project && text_read(project, "t.rung", text, len, NULL, &diags);
}

static bool read_text(const char *text)
{
	return read_bytes(text, strlen(text));
}

#define LD(body) "RUNGBOARD 1\n\nPROGRAM Main LD\n" body "END_PROGRAM\n"
#define IL(body) "RUNGBOARD 1\n\nPROGRAM Main IL\n" body "END_PROGRAM\n"

/* The first diagnostic of @text, as `LD110 5 1 (1,2) 5 FOO`. */
static void fails(const char *text, const char *want)
{
	char got[256] = "no error";

	read_text(text);
	if (diags.count > 0) {
		const struct diag *d = &diags.diag[0];

		snprintf(got, sizeof(got), "%s %d %d (%d,%d) %d %s",
			 diag_code(d->id), d->line, d->rung, d->row, d->col,
			 d->column, d->arg);
	}
	CHECK_TEXT(got, want);
}

/* ---- errors ---- */

static void test_first_line(void)
{
	fails("", "LD101 0 0 (0,0) 0 ");
	fails(" \n\n", "LD101 0 0 (0,0) 0 ");
	fails("VAR\nEND_VAR\n", "LD102 1 0 (0,0) 1 ");
	fails("RUNGBOARD\n", "LD102 1 0 (0,0) 10 ");
	fails("RUNGBOARD 0\n", "LD102 1 0 (0,0) 11 ");
	fails("RUNGBOARD 2\nnew words", "LD103 1 0 (0,0) 11 2");
	fails("RUNGBOARD 99999999999999999999\n",
	      "LD103 1 0 (0,0) 11 99999999999999999999");
	CHECK(diags.count == 1);
	fails("RUNGBOARD 1 x\n", "LD106 1 0 (0,0) 13 x");
	fails("\x7f" "ELF", "LD102 1 0 (0,0) 1 ");
}

static void test_bytes(void)
{
	fails("RUNGBOARD 1\n (* \xc3\x28 *)\n", "LD104 2 0 (0,0) 5 ");
	CHECK(diags.count == 1);
	fails("RUNGBOARD 1\nVAR\n\x01" "A : BOOL;\nEND_VAR\n",
	      "LD105 3 0 (0,0) 1 ");
	CHECK(diags.count == 1);
	CHECK(!read_bytes("RUNGBOARD 1\n\0", 13));
	CHECK(diags.diag[0].id == DIAG_BAD_BYTE);
	CHECK(diags.diag[0].line == 2 && diags.diag[0].column == 1);
	fails("RUNGBOARD 1\r\n\rVAR\r\nEND_VAR", "LD105 2 0 (0,0) 1 ");
	fails("RUNGBOARD 1\n(* open", "LD146 2 0 (0,0) 1 (* open");
	fails("RUNGBOARD 1\nPROJECT \"open\n", "LD108 2 0 (0,0) 9 open");
	fails("RUNGBOARD 1\nPROJECT \"a$x\"\n", "LD106 2 0 (0,0) 9 $x");
}

static void test_var_errors(void)
{
#define V(body) "RUNGBOARD 1\nVAR\n" body "\nEND_VAR\n"
	fails(V("A : FOO;"), "LD118 3 0 (0,0) 5 FOO");
	fails(V("A : INT := 40000;"), "LD116 3 0 (0,0) 12 40000");
	fails(V("A : INT := 1.5;"), "LD115 3 0 (0,0) 12 1.5");
	fails(V("A : TIME := 5;"), "LD115 3 0 (0,0) 13 5");
	fails(V("A : BOOL := 2;"), "LD116 3 0 (0,0) 13 2");
	fails(V("A : INT := 2#3;"), "LD115 3 0 (0,0) 12 2#3");
	fails(V("A AT %IX9999.0 : BOOL;"), "LD117 3 0 (0,0) 6 %IX9999.0");
	fails(V("A AT foo : BOOL;"), "LD107 3 0 (0,0) 6 address" DIAG_AND "foo");
	fails(V("A AT %IX0.0 : TON;"), "LD126 3 0 (0,0) 15 AT");
	fails(V("A : TON := 5;"), "LD156 3 0 (0,0) 12 (" DIAG_AND "5");
	fails(V("A BOOL;"), "LD156 3 0 (0,0) 3 :" DIAG_AND "BOOL");
	fails(V("A.B : BOOL;"), "LD107 3 0 (0,0) 1 name of a variable" DIAG_AND "A.B");
	fails("RUNGBOARD 1\nVAR\nA : BOOL;\nPROGRAM P\nEND_PROGRAM\n",
	      "LD154 4 0 (0,0) 1 END_VAR");
	CHECK(diags.count == 1);
	fails("RUNGBOARD 1\nVAR A : BOOL;", "LD109 2 0 (0,0) 1 VAR");
	read_text(V("A : FOO;\nB : FOO; C : BAR;\nD : INT"));
	CHECK(diags.count == 4);
	CHECK(read_text(V("Rung, View : BOOL;\n Program : INT;")));
	fails(LD("VAR_GLOBAL\nA : INT;\nEND_VAR\n"),
	      "LD126 4 0 (0,0) 1 VAR_GLOBAL");
	fails(LD("RUNG\nVAR\nA : INT;\nEND_VAR\n"), "LD126 5 1 (0,0) 1 VAR");
}

static void test_array_errors(void)
{
	fails(V("A : ARRAY OF INT;"), "LD156 3 0 (0,0) 11 [" DIAG_AND "OF");
	fails(V("A : ARRAY[1] OF INT;"), "LD156 3 0 (0,0) 12 .." DIAG_AND "]");
	fails(V("A : ARRAY[1..] OF INT;"), "LD140 3 0 (0,0) 14 ]");
	fails(V("A : ARRAY[1..2, 1] OF INT;"), "LD156 3 0 (0,0) 18 .." DIAG_AND "]");
	fails(V("A : ARRAY[2..1] OF INT;"), "LD140 3 0 (0,0) 15 2..1");
	fails(V("A : ARRAY[-9223372036854775808..1] OF INT;"),
	      "LD140 3 0 (0,0) 12 9223372036854775808");
	fails(V("A : ARRAY[1..2] INT;"), "LD156 3 0 (0,0) 17 OF" DIAG_AND "INT");
	fails(V("A : ARRAY[1..2] OF FOO;"), "LD118 3 0 (0,0) 20 FOO");
	fails(V("A : ARRAY[1..2] OF INT := 1];"), "LD156 3 0 (0,0) 28 ;" DIAG_AND "]");
	fails(V("A : ARRAY[1..2] OF INT := [];"), "LD107 3 0 (0,0) 28 constant" DIAG_AND "]");
	fails(V("A : ARRAY[1..2] OF INT := [1 2];"), "LD157 3 0 (0,0) 30 ," DIAG_AND "]" DIAG_AND "2");
	fails(V("A : ARRAY[1..2] OF INT := [0(1)];"), "LD362 3 0 (0,0) 28 0");
	fails(V("A : ARRAY[1..2] OF INT := [1,\n 2 (1)];"), "LD363 4 0 (0,0) 2 2" DIAG_AND "1");
	fails(V("A : ARRAY[1..2] OF INT := [- 2(1)];"), "LD362 3 0 (0,0) 28 -2");
	fails(V("A : ARRAY[1..2] OF INT := [1, 2, 3];"), "LD141 3 0 (0,0) 34 ");
	fails(V("A : ARRAY[1..2] OF INT := [2(1];"), "LD156 3 0 (0,0) 31 )" DIAG_AND "]");
	fails(V("A : ARRAY[1..2] OF INT := [T#1s];"), "LD115 3 0 (0,0) 28 T#1s");
	fails(V("A AT %MW524286 : ARRAY[1..2] OF WORD;"),
	      "LD117 3 0 (0,0) 33 %MW524286");
	fails(LD("RUNG\n| NO A[ | COIL B |\n"), "LD107 5 1 (1,1) 9 index" DIAG_AND "|");
	fails(LD("RUNG\n| NO A[i | COIL B |\n"), "LD156 5 1 (1,1) 10 ]" DIAG_AND "|");
	fails(LD("RUNG\n| NO A[i + 1] | COIL B |\n"), "LD156 5 1 (1,1) 10 ]" DIAG_AND "+");
	fails(LD("RUNG\n| NO A] | COIL B |\n"), "LD121 5 1 (1,1) 7 ]");
	fails(LD("RUNG\n| [ A[i + 1 ] | COIL B |\n"), "LD122 5 1 (1,1) 15 |");
	fails(LD("RUNG\n| [ A[(i + 1] ] | COIL B |\n"), "LD122 5 1 (1,1) 13 ]" DIAG_AND ")");
	fails(LD("RUNG\n| [ A[i + 1) ] | COIL B |\n"), "LD122 5 1 (1,1) 12 )");
	fails(LD("RUNG\n| [ A[] ] | COIL B |\n"), "LD122 5 1 (1,1) 7 ]");
	fails(LD("RUNG\n| [ 5[1] > 2 ] | COIL B |\n"), "LD122 5 1 (1,1) 6 [");
	fails(IL("LD A[1\n"), "LD156 4 0 (0,0) 7 ]");
}

static void test_cell_errors(void)
{
	fails(LD("RUNG\n| NO A | FOO B |\n"), "LD110 5 1 (1,2) 10 FOO");
	fails(LD("RUNG\nRUNG\n| NO A |\n| NO | XX |\n"),
	      "LD120 7 2 (2,1) 6 NO");
	CHECK(diags.count == 2 && diags.diag[1].col == 2);
	fails(LD("RUNG\n| NO A B | RET |\n"), "LD121 5 1 (1,1) 8 B");
	fails(LD("RUNG\n| NO A | RET\n"), "LD119 5 1 (1,2) 13 ");
	CHECK(diags.count == 1);
	fails(LD("RUNG\n|\n"), "LD119 5 1 (1,0) 2 ");
	fails(LD("RUNG\n| NO A ^| RET |\n"), "LD219 5 1 (1,1) 8 ");
	fails(LD("RUNG\n| NO %IX0.9 |\n"), "LD143 5 1 (1,1) 6 %IX0.9");
	fails(LD("RUNG\n| TON PT:=T#3s |\n"), "LD127 5 1 (1,1) 7 TON" DIAG_AND "TON Delay");
	fails(LD("RUNG\n| TON T1 PT:=T#3x |\n"), "LD115 5 1 (1,1) 14 T#3x");
	fails(LD("RUNG\n| TON T1 PT:=T#3s pt:=T#4s |\n"),
	      "LD124 5 1 (1,1) 19 pt");
	fails(LD("RUNG\n| TON T1 PT T#3s |\n"), "LD121 5 1 (1,1) 13 PT");
	fails(LD("RUNG\n| ADD IN1:=99999999999999999999 |\n"),
	      "LD116 5 1 (1,1) 12 99999999999999999999");
	fails(LD("RUNG\n| -- |\n"), "LD110 5 1 (1,1) 3 -");
	fails(LD("RUNG a.b\n"), "LD107 4 1 (0,0) 6 label" DIAG_AND "a.b");
	fails(LD("| NO A |\n"), "LD154 4 0 (0,0) 1 RUNG");
	fails("RUNGBOARD 1\nRUNG\n", "LD154 2 0 (0,0) 1 PROGRAM Main LD");
	fails(LD("") "junk\n", "LD110 5 0 (0,0) 1 junk");
	fails("RUNGBOARD 1\nPROGRAM P\nEND_PROGRAM x\n",
	      "LD106 3 0 (0,0) 13 x");
	fails("RUNGBOARD 1\nPROGRAM\nEND_PROGRAM\n",
	      "LD107 2 0 (0,0) 8 name of the program");
	fails("RUNGBOARD 1\nVIEW\n x\n", "LD109 2 0 (0,0) 1 VIEW");
}

static void test_il_errors(void)
{
	fails(IL("  JMPN x\n"), "LD604 4 0 (0,0) 3 JMPN");
	fails(IL("  SN x\n"), "LD604 4 0 (0,0) 3 SN");
	fails(IL("  FOO x\n"), "LD110 4 0 (0,0) 3 FOO");
	fails(IL("  LD\n"), "LD120 4 0 (0,0) 5 LD");
	fails(IL("  LD A B\n"), "LD106 4 0 (0,0) 8 B");
	fails(IL("  CAL\n"), "LD120 4 0 (0,0) 6 CAL");
	fails(IL("  CAL D(IN:=A, IN:=B)\n"), "LD124 4 0 (0,0) 16 IN");
	fails(IL("  LD 2#3\n"), "LD115 4 0 (0,0) 6 2#3");
	fails("RUNGBOARD 1\nPROGRAM Main IL\n LD A\n",
	      "LD109 2 0 (0,0) 1 PROGRAM");
	/* A faulty call over lines is one error. */
	read_text(IL("  CAL D(5,\n Q:=B,\n PT:=C)\n LD A\n"));
	CHECK(diags.count == 1);
}

static void test_expression_errors(void)
{
	fails(LD("RUNG\n| [ a + ] |\n"), "LD122 5 1 (1,1) 9 ]");
	fails(LD("RUNG\n| NO b | [ 5 := a ] |\n"), "LD122 5 1 (1,2) 14 :=");
	fails(LD("RUNG\n| [ a > 1 | NO b |\n"), "LD122 5 1 (1,1) 11 |");
}

/* ---- large and odd files ---- */

struct text {
	char *at;
	size_t len, size;
};

static void add(struct text *text, const char *more)
{
	size_t len = strlen(more);

	if (text->len + len >= text->size) {
		text->size = 2 * (text->len + len) + 1;
		text->at = realloc(text->at, text->size);
		if (!text->at)
			exit(1);
	}
	memcpy(text->at + text->len, more, len + 1);
	text->len += len;
}

static void add_many(struct text *text, const char *more, int count)
{
	while (count-- > 0)
		add(text, more);
}

static void test_limits(void)
{
	struct text text = { 0 };

	add(&text, LD("RUNG\n"));
	text.len -= strlen("END_PROGRAM\n");
	add(&text, "|");
	add_many(&text, "NO A|", LIMIT_COLS);
	add(&text, "\n");
	add_many(&text, "|NO A|\n", LIMIT_ROWS - 1);
	add(&text, "END_PROGRAM\n");
	CHECK(read_text(text.at));
	CHECK(project->pou[0].rung[0]->rows == LIMIT_ROWS);
	CHECK(project->pou[0].rung[0]->cols == LIMIT_COLS);
	text.len -= strlen("END_PROGRAM\n");
	add(&text, "|NO A|\n|NO A|\nRUNG\n|");
	add_many(&text, "NO A|", LIMIT_COLS + 9);
	add(&text, "\nEND_PROGRAM\n");
	CHECK(!read_text(text.at));
	CHECK(diags.count == 2 && diags.diag[0].id == DIAG_TOO_MANY_ROWS);
	CHECK(diags.diag[1].id == DIAG_TOO_MANY_COLS);
	text.len = 0;
	add(&text, "RUNGBOARD 1\nVAR\n");
	add_many(&text, "n", LIMIT_NAME);
	add(&text, " : BOOL;\nx");
	add_many(&text, "n", LIMIT_NAME);
	add(&text, " : BOOL;\nEND_VAR\n");
	CHECK(!read_text(text.at));
	CHECK(diags.count == 1 && diags.diag[0].id == DIAG_NAME_TOO_LONG);
	CHECK(diags.diag[0].line == 4);
	text.len = 0;
	add(&text, "RUNGBOARD 1\nPROGRAM M\n");
	add_many(&text, "RUNG\n|NO A|COIL B|\n", 2 * LIMIT_RUNGS);
	add(&text, "END_PROGRAM\n");
	CHECK(!read_text(text.at));
	CHECK(diags.count == 1 && diags.diag[0].id == DIAG_TOO_MANY);
	CHECK(diags.diag[0].rung == LIMIT_RUNGS + 1);
	free(text.at);
}

/* A file of @before, then @count times @more, then @behind. */
static enum diag_id repeated(const char *before, const char *more, int count,
			     const char *behind)
{
	struct text text = { 0 };
	enum diag_id out = DIAG_COUNT;

	add(&text, before);
	add_many(&text, more, count);
	add(&text, behind);
	if (!read_text(text.at))
		out = diags.diag[0].id;
	free(text.at);
	return out;
}

static void test_more_limits(void)
{
#define VARS "RUNGBOARD 1\nVAR\nA"
	CHECK(repeated(VARS, ",A", LIMIT_VARS - 1, ":BOOL;\nEND_VAR\n") ==
	      DIAG_COUNT);
	CHECK(repeated(VARS, ",A", LIMIT_VARS, ":BOOL;\nEND_VAR\n") ==
	      DIAG_TOO_MANY);
#define UNIT "PROGRAM P\nEND_PROGRAM\n"
	CHECK(repeated("RUNGBOARD 1\n", UNIT, LIMIT_POUS, "") == DIAG_COUNT);
	CHECK(repeated("RUNGBOARD 1\n", UNIT, LIMIT_POUS + 1, "") ==
	      DIAG_TOO_MANY);
#define CELL "RUNGBOARD 1\nPROGRAM P\nRUNG\n| TON T1 P"
	CHECK(repeated(CELL, "P", LIMIT_NAME - 1, ":=5 |\nEND_PROGRAM\n") ==
	      DIAG_COUNT);
	CHECK(repeated(CELL, "P", LIMIT_NAME, ":=5 |\nEND_PROGRAM\n") ==
	      DIAG_NAME_TOO_LONG);
#define PIN "RUNGBOARD 1\nPROGRAM P\nRUNG\n| NO T1.P"
	CHECK(repeated(PIN, "P", LIMIT_NAME - 1, " |\nEND_PROGRAM\n") ==
	      DIAG_COUNT);
	CHECK(repeated(PIN, "P", LIMIT_NAME, " |\nEND_PROGRAM\n") ==
	      DIAG_NAME_TOO_LONG);
}

/* A file that is too large is refused without reading it: calloc() does not even
 * allocate its pages. */
static void test_too_large(void)
{
	char *bytes = calloc(1, LIMIT_TEXT + 1u);

	if (!CHECK(bytes != NULL))
		return;
	memcpy(bytes, "RUNGBOARD 1\n", 12);
	CHECK(!read_bytes(bytes, LIMIT_TEXT + 1u));
	CHECK(diags.count == 1 && diags.diag[0].id == DIAG_TOO_LARGE);
	free(bytes);
}

/* A source whose every file is large. */
static char *load_large(void *context, const char *from, const char *name,
			size_t *len, struct diag_list *list,
			struct diag place)
{
	char *text = malloc(*(size_t *)context);

	(void)from, (void)name, (void)list, (void)place;
	*len = text ? *(size_t *)context : 0;
	if (text)
		memset(text, 'x', *len);
	return text;
}

static void test_include_total(void)
{
	size_t size = LIMIT_TEXT / 4;
	const struct text_source source = { load_large, &size };
	static const char text[] = "RUNGBOARD 1\nINCLUDE \"a\"\n"
		"INCLUDE \"b\"\nINCLUDE \"c\"\nINCLUDE \"d\"\n";
	int large = 0;

	project_free(project);
	project = project_new("t.rung");
	diag_init(&diags);
	CHECK(!text_read(project, "t.rung", text, sizeof(text) - 1, &source,
			 &diags));
	for (int i = 0; i < diags.count; i++)
		large += diags.diag[i].id == DIAG_INCLUDE_LARGE;
	CHECK_AS(large == 1 && diags.count == 4,
		 "the fourth large file is refused, the others are read");
}

/* Reads texts of 300,000 equal bytes in several places. */
static void test_monotonous(void)
{
	const int bytes = tap_rounds(300000);
	static const char *const heads[] = {
		"", "RUNGBOARD 1\n", "RUNGBOARD 1\nVAR\n",
		"RUNGBOARD 1\nPROGRAM M\nRUNG\n|",
		"RUNGBOARD 1\nPROGRAM M IL\n",
		"RUNGBOARD 1\nPROGRAM M\nRUNG\n|[",
		"RUNGBOARD 1\nPROGRAM M IL\nCAL D(",
	};
	static const char *const pieces[] = {
		"x", "\"", "(*", "(**)", "//\n", "|", "|\n", "\n", "^|", "[",
		"(", "\xff", "\r", "a:=b ", "RUNG\n", "VAR ", "CAL ", "-",
		"\"$\"", "A,", "9", "%I",
	};
	struct text text = { 0 };

	for (size_t h = 0; h < sizeof(heads) / sizeof(*heads); h++) {
		for (size_t p = 0; p < sizeof(pieces) / sizeof(*pieces); p++) {
			text.len = 0;
			add(&text, heads[h]);
			add_many(&text, pieces[p], bytes / (int)strlen(pieces[p]));
			read_text(text.at);
		}
	}
	CHECK_AS(1, "reading a text of one repeated piece ends");
	free(text.at);
}

static const char ladder[] = LD(
	"VAR\n  A AT %IX0.0 : BOOL := TRUE; (* x *)\n  T : TON;\n"
	"  B : ARRAY[-1..3] OF INT := [1, 2(-5), 3];\nEND_VAR\n"
	"// why\nRUNG Seal \"title\"\n"
	"  | NO A (* c *)  | NC B | --- | COIL M |\n"
	"  | TON T PT:=T#3s ET=>X ^| [ A > 1 ] |\n  | .R |\n"
	"RUNG\n  | NO B[-1] | [ B[i + 1] := C[ 2 ] ] |\n");
static const char list[] = IL(
	"(* first *)\nVAR\n  D : TON;\nEND_VAR\n  LD    A (* behind *)\n"
	"  OR(\n  LD    %IX0.1\n  ) // x\n  ADD   16#FF\n"
	"Again:\n  CAL   D(IN := Go, PT := T#3s, Q => Done) // run\n");

/* Reads every beginning of a good file, and the file with each byte changed; in an emulator every tenth. */
static void test_cut_and_changed(void)
{
	const size_t step = 10 / (size_t)tap_rounds(10);
	static const char *const files[] = { ladder, list };
	static const char bytes[] = "\n|^\"(*;:[]= \xff" "A%";
	static char copy[2000];

	for (int f = 0; f < 2; f++) {
		size_t len = strlen(files[f]);

		for (size_t i = 0; i < len; i += step) {
			read_bytes(files[f], i);
			for (size_t b = 0; b < sizeof(bytes); b++) {
				memcpy(copy, files[f], len);
				copy[i] = bytes[b];
				if (!read_bytes(copy, len))
					continue;
				size_t one = 0, two = 0;
				char *first = text_write(project, &one);

				if (!read_bytes(first, one))
					CHECK_AS(0, "a written file is read again");
				char *second = text_write(project, &two);

				if (one != two || memcmp(first, second, one))
					CHECK_TEXT(second, first);
				free(first);
				free(second);
			}
		}
	}
	CHECK_AS(1, "reading each cut or changed file ends");
}

int main(void)
{
	test_first_line();
	test_bytes();
	test_var_errors();
	test_array_errors();
	test_cell_errors();
	test_il_errors();
	test_expression_errors();
	test_limits();
	test_more_limits();
	test_too_large();
	test_include_total();
	test_monotonous();
	test_cut_and_changed();
	project_free(project);
	return tap_done();
}
