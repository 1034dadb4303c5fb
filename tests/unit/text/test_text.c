/* SPDX-License-Identifier: MIT
 *
 * test_text - rung files read and written: canonical form, comments, includes.
 *
 * What is wrong with a file is tested in test_read_errors.
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

/* Writes the project, reads the text and writes it again: the same bytes. */
static char *written(void)
{
	size_t len = 0, again = 0;
	char *first = text_write(project, &len);

	if (!first || !read_bytes(first, len)) {
		for (int i = 0; i < diags.count; i++) {
			char line[200];

			diag_print(&diags.diag[i], line, sizeof(line));
			printf("# %s\n", line);
		}
		CHECK_AS(0, "the written project is read again");
		return first ? first : calloc(1, 1);
	}
	char *second = text_write(project, &again);

	CHECK_AS(second && len == again && !memcmp(first, second, len),
		 "the second text has the same bytes");
	free(second);
	return first;
}

/* @from is written as @to, and @to as itself. */
static void canonical(const char *from, const char *to)
{
	bool good = read_text(from);

	for (int i = 0; !good && i < diags.count; i++) {
		char line[200];

		diag_print(&diags.diag[i], line, sizeof(line));
		printf("# %s\n", line);
	}
	CHECK_AS(good, "the project is read without an error");
	char *text = written();

	CHECK_TEXT(text, to);
	free(text);
}

#define LD(body) "RUNGBOARD 1\n\nPROGRAM Main LD\n" body "END_PROGRAM\n"
#define IL(body) "RUNGBOARD 1\n\nPROGRAM Main IL\n" body "END_PROGRAM\n"

/* ---- canonical form ---- */

static const char garage[] =
	"RUNGBOARD 1\n"
	"PROJECT \"Garage door\"\n"
	"\n"
	"VAR\n"
	"  Open   AT %IX0.0 : BOOL; (* green button *)\n"
	"  Stop   AT %IX0.1 : BOOL;\n"
	"  Motor  AT %QX0.0 : BOOL;\n"
	"  Runout : TON;\n"
	"END_VAR\n"
	"\n"
	"PROGRAM Main LD\n"
	"RUNG Seal \"The motor seals itself in until Stop\"\n"
	"  | NO Open   | NC Stop | --- | COIL Motor |\n"
	"  | NO Motor ^|\n"
	"RUNG\n"
	"  | NO Motor | TON Runout PT:=T#3s | --- | R Motor |\n"
	"END_PROGRAM\n";

static void test_garage(void)
{
	canonical(garage, garage);
	CHECK_TEXT(project_text(project, project->title), "Garage door");
	CHECK(project->globals.count == 4);
	CHECK(project->globals.var[3].fb == FB_TON);
	CHECK(project->globals.var[3].type == IEC_NONE);
	const struct rung *rung = project->pou[0].rung[0];

	CHECK(rung->rows == 2 && rung->cols == 4 && rung->line == 12);
	CHECK(rung_at(rung, 1, 0)->link == 1);
	CHECK(rung_at(rung, 0, 2)->word == ELEM_WIRE);
	const struct cell *box = rung_at(project->pou[0].rung[1], 0, 1);

	CHECK(box->word == FB_TON);
	CHECK_TEXT(project_text(project, box->operand), "Runout");
	CHECK_TEXT(project_text(project, box->args), "PT:=T#3s");
}

static void test_forms(void)
{
	canonical("\xef\xbb\xbfrungboard 1\r\nproject \"a$\"b$$$N\"\r\n"
		  "var_global constant retain A,bee:int:=- 5;END_VAR\n"
		  "var C at i3:bool:=TRUE;D:word:=16#FF;E at\n %qx10.0 :bool;"
		  "end_var\r\n"
		  "program main\r\nvar x:ton;end_var\nvar retain y:time;"
		  "end_var\nrung off l \"x\ty\"\r\n|no A|[A>=1+  2]|\r\n"
		  "|ton x pt := T#3s  et=>y^| |\n|.pt|.^|\n"
		  "| add in1:=-5 IN2:=A out=>A|r A|jmp l|ret|||\nend_program",
		  "RUNGBOARD 1\n"
		  "PROJECT \"a$\"b$$$N\"\n"
		  "\n"
		  "VAR_GLOBAL RETAIN CONSTANT\n"
		  "  A   : INT := -5;\n"
		  "  bee : INT := -5;\n"
		  "END_VAR\n"
		  "\n"
		  "VAR\n"
		  "  C AT %IX0.3  : BOOL := TRUE;\n"
		  "  D : WORD := 16#FF;\n"
		  "  E AT %QX10.0 : BOOL;\n"
		  "END_VAR\n"
		  "\n"
		  "PROGRAM main LD\n"
		  "VAR\n"
		  "  x : TON;\n"
		  "END_VAR\n"
		  "VAR RETAIN\n"
		  "  y : TIME;\n"
		  "END_VAR\n"
		  "RUNG OFF l \"x$Ty\"\n"
		  "  | NO A                      | [ A>=1+ 2 ] |\n"
		  "  | TON x PT:=T#3s ET=>y     ^|\n"
		  "  | .PT                       | .          ^|\n"
		  "  | ADD IN1:=-5 IN2:=A OUT=>A | R A         "
		  "| JMP l | RET |\n"
		  "END_PROGRAM\n");
	CHECK(project->globals.block[0].flags ==
	      (VAR_RETAIN | VAR_CONSTANT | VAR_GLOBAL_WORD));
	CHECK(project->globals.var[1].init.i == -5);
	CHECK(project->pou[0].rung[0]->off == 1);
	CHECK(rung_at(project->pou[0].rung[0], 0, 1)->word == ELEM_COMPARE);
}

static void test_arrays(void)
{
	canonical("RUNGBOARD 1\nvar A:array [ -2 .. 5 ] of int:=[ 1,2 ( -3 ) ,\n"
		  "16#F ];B AT MW2 :ARRAY[0..1] OF WORD; (* x *)\n"
		  "C,D:ARRAY[1..1] OF STRING[5];end_var\n",
		  "RUNGBOARD 1\n\nVAR\n"
		  "  A : ARRAY[-2..5] OF INT := [1, 2(-3), 16#F];\n"
		  "  B AT %MW2 : ARRAY[0..1] OF WORD; (* x *)\n"
		  "  C : ARRAY[1..1] OF STRING[5];\n"
		  "  D : ARRAY[1..1] OF STRING[5];\nEND_VAR\n");
	CHECK(project->globals.var[0].array.low == -2 &&
	      project->globals.var[0].array.count == 8 &&
	      project->globals.var[0].init_count == 3 &&
	      project->globals.var[0].init_list[1].count == 2 &&
	      project->globals.var[0].init_list[1].value.i == -3);
	canonical(LD("RUNG\n|no A[ - 1 ]|nc a [i]|p %MX1.0[ D.CV ]|\n"
		     "|[A[ i+1 ]:=b[ 2 ]]|[a[1]>2]|ton T pt:=X [ 3 ] q=>Y[i]|\n"),
		  LD("RUNG\n"
		     "  | NO A[-1]             | NC a[i]    | P %MX1.0[D.CV]         |\n"
		     "  | [ A[ i+1 ]:=b[ 2 ] ] | [ a[1]>2 ] | TON T PT:=X[3] Q=>Y[i] |\n"));
	canonical(IL("ld A[ -1 ]\nadd B [i]\nadd(in1:=A[1],in2:=%MW0[i],out=>C[j])\n"),
		  IL("  LD    A[-1]\n  ADD   B[i]\n"
		     "  ADD(IN1 := A[1], IN2 := %MW0[i], OUT => C[j])\n"));
}

static void test_initial_parts(void)
{
	canonical("RUNGBOARD 1\ntype Pt:struct a:int:=3;b:array[1..3]of int;end_struct;end_type\n"
		  "var X,Y:Pt:=( a:=- 1 ,\n b :=[ 2( 5 ),1() ] );\n"
		  "Z:array[0..3]of Pt:=[( a:= 1 ), 2 ( b:=[ 7 ]),1( )];T:TON:=(pt:=t#1s);end_var\n",
		  "RUNGBOARD 1\n\nTYPE\n  Pt : STRUCT\n    a : INT := 3;\n"
		  "    b : ARRAY[1..3] OF INT;\n  END_STRUCT;\nEND_TYPE\n\nVAR\n"
		  "  X : Pt := (a := -1, b := [2(5), 1()]);\n"
		  "  Y : Pt := (a := -1, b := [2(5), 1()]);\n"
		  "  Z : ARRAY[0..3] OF Pt := [(a := 1), 2(b := [7]), 1()];\n"
		  "  T : TON := (pt := t#1s);\nEND_VAR\n");
}

/* Initial values that make a line too long; strings may hold what else ends an item. */
static void test_tables(void)
{
	canonical("RUNGBOARD 1\nVAR\n  Words : ARRAY[1..3] OF STRING[30] := "
		  "['one, [two]; (three) of them $'now$'','a second one, which is long','$$'];\n"
		  "  T : ARRAY[1..2,1..3] OF DINT := [1000000000,2,3,-1000000000,5,1000000000];\n"
		  "  R : ARRAY[1..2,1..4] OF DINT := [[1000000000,2,3,-1000000000],[5,1000000000,7,1000000000]];\n"
		  "  L : ARRAY[1..40] OF DINT := [30(1000000000), 1000000001, 1000000002, 1000000003, 1000000004, 1000000005];(* x *)\n"
		  "END_VAR\n",
		  "RUNGBOARD 1\n\nVAR\n"
		  "  Words : ARRAY[1..3] OF STRING[30] := [\n"
		  "    'one, [two]; (three) of them $'now$'', 'a second one, which is long', '$$'\n"
		  "  ];\n"
		  "  T     : ARRAY[1..2, 1..3] OF DINT := [1000000000, 2, 3, -1000000000, 5, 1000000000];\n"
		  "  R     : ARRAY[1..2, 1..4] OF DINT := [\n"
		  "    [1000000000, 2, 3, -1000000000],\n"
		  "    [5, 1000000000, 7, 1000000000]\n"
		  "  ];\n"
		  "  L     : ARRAY[1..40] OF DINT := [\n"
		  "    30(1000000000), 1000000001, 1000000002, 1000000003, 1000000004, 1000000005\n"
		  "  ]; (* x *)\nEND_VAR\n");
	canonical("RUNGBOARD 1\nVAR\n  T : ARRAY[1..2,1..4] OF LINT := [1000000000000, 2, 3, -1000000000000, 5, 1000000000000, 7, 1000000000000];\nEND_VAR\n",
		  "RUNGBOARD 1\n\nVAR\n"
		  "  T : ARRAY[1..2, 1..4] OF LINT := [\n"
		  "     1000000000000,              2,              3, -1000000000000,\n"
		  "                 5,  1000000000000,              7,  1000000000000\n"
		  "  ];\nEND_VAR\n");
}

static void test_empty(void)
{
	canonical("RUNGBOARD 1", "RUNGBOARD 1\n");
	canonical(LD("RUNG\n"), LD("RUNG\n"));
	CHECK(project->pou[0].rung[0]->rows == 1);
	CHECK(project->pou[0].rung[0]->cols == 1);
	canonical(LD("RUNG\n|||||\n"), LD("RUNG\n"));
	canonical(LD("RUNG\n| |\n| | |\n"), LD("RUNG\n  |  |\n  |  |\n"));
	canonical(LD("RUNG\n|NO a||NO b|\n||^|^|\n"),
		  LD("RUNG\n  | NO a |  | NO b |\n  |      | ^|     ^|\n"));
	canonical("RUNGBOARD 1\nPROJECT \"\"\n", "RUNGBOARD 1\n");
}

static void test_expressions(void)
{
	canonical(LD("RUNG\n| NO a | [Total:=Total  + 1 (* x *)*2] |\n"),
		  LD("RUNG\n  | NO a | [ Total:=Total + 1 *2 ] (* x *) |\n"));
	CHECK(rung_at(project->pou[0].rung[0], 0, 1)->word == ELEM_ASSIGN);
	CHECK_TEXT(project_text(project, rung_at(project->pou[0].rung[0], 0,
						 1)->operand),
		   "Total:=Total + 1 *2");
}

/* ---- comments ---- */

static void test_comments(void)
{
	static const char text[] =
		"RUNGBOARD 1\n"
		"// first\n"
		"(* second (* nested *)\n   goes on *)\n"
		"PROJECT \"p\"\n"
		"\n"
		"(* above VAR *)\n"
		"VAR\n"
		"  A : BOOL; // one | bar\n"
		"  B : INT; (* two\n lines *)\n"
		"END_VAR\n"
		"\n"
		"(* above POU *)\n"
		"PROGRAM Main LD\n"
		"// of the rung\n"
		"(* and more *)\n"
		"RUNG\n"
		"  | NO A (* a | b ^| *) | COIL B  |\n"
		"  |                    ^| (* x *) |\n"
		"// at its end\n"
		"END_PROGRAM\n"
		"\n"
		"(* of the view *)\n"
		"VIEW\n  anything | \" (* at all\nEND_VIEW\n"
		"\n"
		"// the end\n";
	char *got;

	canonical(text, text);
	CHECK_TEXT(project_text(project, project->tail), "// the end");
	CHECK_TEXT(project_text(project, project->pou[0].tail),
		   "// at its end");
	/* Comments in unusual places are moved, not lost. */
	read_text("// c01\nRUNGBOARD 1 // c02\n(* c03 *)VAR (* c04 *)\n// c05\n(* c06 *)\n"
		  "A (* c07 *) : (* c08 *) BOOL // c09\n; (* c10 *) // c11\n"
		  "// c12 *) (* x\n END_VAR // c13\n"
		  "PROGRAM (* c14 *) M // c15\n// c16\nRUNG // c17\n"
		  "// c18\n|NO (* c19 *) A (* c20\n x*)| (* c21*)|RET (* c22 *)| // c23\n"
		  "// c24\n|RET (* c25 *) (* c26 *)|(* c27*)|// c28\n// c29\n"
		  "END_PROGRAM // c30\n INCLUDE (* c31 *) \"x\" // c32\n");
	CHECK(diags.count == 0);
	got = written();
	for (int i = 1; i <= 32; i++) {
		char number[16];

		snprintf(number, sizeof(number), "c%02d", i);
		CHECK_AS(strstr(got, number), number);
	}
	free(got);
}

static void test_moved_comments(void)
{
	canonical("RUNGBOARD 1\nVAR\n// in *) x\nA : BOOL; // behind\n"
		  "// last\nEND_VAR\n",
		  "RUNGBOARD 1\n\nVAR\n  A : BOOL; (* in * ) x *) "
		  "(* behind *) // last\nEND_VAR\n");
	canonical(LD("RUNG\n| NO A | RET (* a *) | // b\n"),
		  LD("RUNG\n  | NO A | RET (* a *) (* b *) |\n"));
	canonical(LD("RUNG\n| NO A | RET |\n// c\n| RET (* x\n   y *) |\n"),
		  LD("// c\nRUNG\n  | NO A          | RET |\n"
		     "  | RET (* x y *) |\n"));
}

/* ---- instruction lists ---- */

static const char list[] = IL(
	"(* first *)\n"
	"VAR\n"
	"  Delay : TON;\n"
	"END_VAR\n"
	"(* lone *)\n"
	"  LD    A (* behind *)\n"
	"  ANDN  B // too\n"
	"  OR(\n"
	"  LD    %IX0.1\n"
	"  XORN( // open\n"
	"  LDN   C\n"
	"  )\n"
	"  ) (* closed *)\n"
	"  NOT\n"
	"  ST    Motor\n"
	"  LD    -5\n"
	"  ADD   16#FF\n"
	"  GT    Level\n"
	"  JMPCN Again\n"
	"  ADD(EN := a, IN1 := -1, ENO => c, OUT => d)\n"
	"  CAL   Delay(IN := Go, PT := T#3s, Q => Done) // run\n"
	"  CALC  Delay\n"
	"Again:\n"
	"  RETC\n"
	"(* end *)\n");

static void test_il(void)
{
	canonical(list, list);
	const struct il *il = &project->pou[0].il;

	CHECK(project->pou[0].language == LANGUAGE_IL);
	CHECK(il->line[0].kind == IL_COMMENT && il->line[1].kind == IL_OP);
	CHECK(il->line[1].op == OP_LD && il->line[1].line == 9);
	CHECK(il->line[3].op == OP_AND && il->line[3].modifiers == MOD_N);
	CHECK(il->line[5].op == OP_OR && il->line[5].modifiers == MOD_PAREN);
	canonical(IL("Loop: ld A (* x *)\n and( B\n )\n jmpc Loop\n"
		     "cal Delay ( in:=Go, (* y *)\n pt:=T#3s, // z\n q=>Done )\n"
		     "CAL D()\nadd( 5\n) (* w *)\n"),
		  IL("Loop:\n  LD    A (* x *)\n  AND( B\n  )\n"
		     "  JMPC  Loop\n(* y *)\n// z\n"
		     "  CAL   Delay(IN := Go, PT := T#3s, Q => Done)\n"
		     "  CAL   D\n  ADD( 5\n  ) (* w *)\n"));
}

/* ---- INCLUDE ---- */

static char *load(void *context, const char *from, const char *name,
		  size_t *len, struct diag_list *list_of, struct diag place)
{
	const char *text = "RUNGBOARD 1\nVAR\nI : FOO;\nEND_VAR\n";
	char *copy;

	(void)context;
	(void)from;
	if (!strcmp(name, "missing")) {
		diag_add(list_of, place, "%s", name);
		return NULL;
	}
	if (!strcmp(name, "self"))
		text = "RUNGBOARD 1\nINCLUDE \"self\"\n";
	if (!strcmp(name, "good"))
		text = "RUNGBOARD 1\nPROJECT \"other\"\n// x\nVAR\nI : INT;\n"
		       "END_VAR\nPROGRAM P\nEND_PROGRAM\n// y\n";
	if (!strcmp(name, "lib"))
		text = "RUNGBOARD 1\nUSES \"ring\"\nFUNCTION F : INT\nEND_FUNCTION\n"
		       "VAR_GLOBAL CONSTANT\nC : INT := 5;\nEND_VAR\n";
	if (!strcmp(name, "ring"))
		text = "RUNGBOARD 1\nUSES \"lib\"\nUSES \"t.rung\"\n"
		       "TYPE\nPair : STRUCT a : INT; END_STRUCT;\nEND_TYPE\n";
	if (!strcmp(name, "odd"))
		text = "RUNGBOARD 1\nVAR\nv : INT;\nEND_VAR\nPROGRAM P\n"
		       "END_PROGRAM\nINCLUDE \"good\"\n";
	if (!strcmp(name, "deep") || !strcmp(name, "x/deep"))
		text = "RUNGBOARD 1\nINCLUDE \"x/deep\"\n";
	*len = strlen(text);
	copy = malloc(*len + 1);
	if (copy)
		memcpy(copy, text, *len + 1);
	return copy;
}

static bool read_with(const char *text)
{
	const struct text_source source = { load, NULL };

	project_free(project);
	project = project_new("dir/t.rung");
	diag_init(&diags);
	return text_read(project, "dir/t.rung", text, strlen(text), &source,
			 &diags);
}

static void test_include(void)
{
	static const char good[] = "RUNGBOARD 1\nPROJECT \"mine\"\n\n"
				   "// why\nINCLUDE \"good\"\n";

	canonical(good, good);
	CHECK(project->part_count == 1 && project->globals.count == 0);
	CHECK(read_with(good));
	CHECK(project->part_count == 3 && project->globals.count == 1);
	CHECK(project->pou[0].included == 1);
	CHECK_TEXT(project->pou[0].file, "dir/good");
	CHECK_TEXT(project_text(project, project->title), "mine");
	char *text = written();

	CHECK_TEXT(text, good);
	free(text);
	CHECK(!read_with("RUNGBOARD 1\nINCLUDE \"bad\"\n"));
	CHECK(diags.count == 1 && diags.diag[0].id == DIAG_BAD_TYPE);
	CHECK_TEXT(diags.diag[0].file, "dir/bad");
	CHECK(!read_with("RUNGBOARD 1\nINCLUDE \"self\"\n"));
	CHECK(diags.count == 1 && diags.diag[0].id == DIAG_INCLUDE_CIRCLE);
	CHECK(!read_with("RUNGBOARD 1\nINCLUDE \"deep\"\n"));
	CHECK(diags.count == 1 && diags.diag[0].id == DIAG_INCLUDE_DEEP);
	CHECK(!read_with("RUNGBOARD 1\nINCLUDE \"missing\"\nINCLUDE 5\n"));
	CHECK(diags.count == 2 && diags.diag[1].id == DIAG_EXPECTED);
}

/* A library that is used twice, or uses itself, is read once; it holds only own words. */
static void test_uses(void)
{
	static const char good[] = "RUNGBOARD 1\n\nUSES \"lib\"\n\nVAR\n"
		"  P : INT;\nEND_VAR\n\n(* again *)\nUSES \"lib\"\n";

	CHECK(read_with(good));
	CHECK(project->pou_count == 1 && project->structure_count == 1);
	CHECK(project->globals.count == 2 && project->words.count == 2);
	CHECK_TEXT(project->structure[0].file, "dir/ring");
	char *text = written();

	CHECK_TEXT(text, good);
	free(text);
	CHECK(!read_with("RUNGBOARD 1\nUSES \"odd\"\n"));
	CHECK(diags.errors >= 3 && diags.diag[0].id == DIAG_LIBRARY_VARS &&
	      diags.diag[1].id == DIAG_MISPLACED &&
	      diags.diag[2].id == DIAG_MISPLACED);
	CHECK(read_with("RUNGBOARD 1\nVAR\nP : Pair;\nEND_VAR\nUSES \"lib\"\n"));
	CHECK(!read_with("RUNGBOARD 1\nUSES \"missing\"\nUSES 5\n"));
	CHECK(diags.count == 2 && diags.diag[1].id == DIAG_EXPECTED);
}

/* ---- one rung, one cell ---- */

static void test_config(void)
{
	canonical("RUNGBOARD 1\nconfiguration c\nend_configuration\n",
		  "RUNGBOARD 1\n\nCONFIGURATION c\nEND_CONFIGURATION\n");
	canonical("RUNGBOARD 1\n"
		  "(* above *)\n"
		  "CONFIGURATION Plant // what it is\n"
		  "(* of V *) area v 0100 ; // less\n"
		  "// of the block\n"
		  "var_global a:bool;end_var\n"
		  "// of Cpu\n"
		  "resource Cpu on arm64 (* board *)\n"
		  "// above\n"
		  "task Fast(watchdog:=t#5ms,\n"
		  "  // between\n"
		  "  interval:=t#1ms);task Once(single:=Main.x);//twice\n"
		  "program P with Fast:Main; program Q:R; (* last *)\n"
		  "(* end *)\n"
		  "END_RESOURCE\n"
		  "(* very end *)\n"
		  "END_CONFIGURATION // gone above\n",
		  "RUNGBOARD 1\n\n"
		  "(* above *)\n"
		  "CONFIGURATION Plant // what it is\n"
		  "  AREA V 100; (* of V *) // less\n"
		  "// of the block\n"
		  "VAR_GLOBAL\n  a : BOOL;\nEND_VAR\n"
		  "  RESOURCE Cpu ON arm64 (* of Cpu *) (* board *)\n"
		  "    TASK Fast (INTERVAL := t#1ms, PRIORITY := 0, "
		  "WATCHDOG := t#5ms); (* above *) // between\n"
		  "    TASK Once (SINGLE := Main.x, PRIORITY := 0); //twice\n"
		  "    PROGRAM P WITH Fast : Main;\n"
		  "    PROGRAM Q : R; (* last *) (* end *)\n"
		  "  END_RESOURCE (* very end *)\n"
		  "END_CONFIGURATION\n\n// gone above\n");
	canonical("RUNGBOARD 1\nCONFIGURATION C\nRESOURCE R ON PC (* head *)\n(* in *)\n"
		  "END_RESOURCE (* behind *)\n(* below *)\nVAR_ACCESS\n  X : M.a : BOOL;\nEND_VAR\n"
		  "END_CONFIGURATION\n",
		  "RUNGBOARD 1\n\nCONFIGURATION C\n  RESOURCE R ON PC (* head *)\n    (* in *)\n"
		  "  END_RESOURCE (* behind *)\n(* below *)\nVAR_ACCESS\n"
		  "  X : M.a : BOOL READ_ONLY;\nEND_VAR\nEND_CONFIGURATION\n");
	/* Words of a configuration are names elsewhere. */
	canonical("RUNGBOARD 1\nVAR\n  Task, Resource, With, Interval, On : BOOL;\n"
		  "END_VAR\n",
		  "RUNGBOARD 1\n\nVAR\n  Task     : BOOL;\n  Resource : BOOL;\n"
		  "  With     : BOOL;\n  Interval : BOOL;\n  On       : BOOL;\n"
		  "END_VAR\n");
}

static void test_rung(void)
{
	static const char text[] = "// why\nRUNG a \"b\"\n"
				   "  | NO A | TON T PT:=T#1s | COIL B |\n";
	char cell[16];

	read_text("RUNGBOARD 1\n");
	struct rung *rung = text_read_rung(project, text, strlen(text), &diags);

	CHECK(rung && rung->cols == 3);
	if (!rung)
		return;
	char *got = text_write_rung(project, rung);

	CHECK_TEXT(got, text);
	free(got);
	CHECK(text_write_cell(project, rung_at(rung, 0, 0), cell,
			      sizeof(cell)) == 4);
	CHECK_TEXT(cell, "NO A");
	CHECK(text_write_cell(project, rung_at(rung, 0, 1), cell, 6) == 14);
	CHECK_TEXT(cell, "TON T");
	CHECK(text_write_cell(project, rung_at(rung, 0, 1), NULL, 0) == 14);
	rung_free(rung);
	CHECK(!text_read_rung(project, "RUNG\n| FOO |", 12, &diags));
	CHECK(!text_read_rung(project, "", 0, &diags));
	CHECK(!text_read_rung(project, "RUNG\nRUNG\n", 10, &diags));
}

/* ---- outline ---- */

static struct text_span outlined[32];
static int outlined_count;

static void note_span(void *context, const struct text_span *span)
{
	(void)context;
	if (outlined_count < 32)
		outlined[outlined_count++] = *span;
}

/* The text of outlined part @index. */
static const char *part_text(const char *text, int index)
{
	static char part[500];

	snprintf(part, sizeof(part), "%.*s", (int)outlined[index].len,
		 text + outlined[index].at);
	return part;
}

static void test_outline(void)
{
	size_t len = 0, plain_len = 0;

	CHECK(read_text("RUNGBOARD 1\nPROJECT \"P\"\n"
			"TYPE\n  Pair : STRUCT\n    a : INT;\n  END_STRUCT;\nEND_TYPE\n"
			"VAR\n  A AT %IX0.0 : BOOL; (* one *)\n  B : INT;\nEND_VAR\n"
			"PROGRAM Main LD\nVAR\n  T : TON;\nEND_VAR\n"
			"(* above *)\nRUNG \"x\"\n  | NO A | COIL Q0 |\nRUNG\nEND_PROGRAM\n"));
	char *text = text_outline(project, &len, note_span, NULL);
	char *plain = text_write(project, &plain_len);

	CHECK_AS(text && plain && !strcmp(text, plain),
		 "text_outline() gives the text of text_write()");
	CHECK_TEXT(part_text(text, 0), "PROJECT \"P\"\n");
	CHECK_TEXT(part_text(text, 1), "    a : INT;\n");
	CHECK_AS(outlined[1].part == TEXT_VAR && outlined[1].structure == 0,
		 "a member has the index of its structure");
	CHECK_TEXT(part_text(text, 2), "  Pair : STRUCT\n    a : INT;\n  END_STRUCT;\n");
	CHECK_TEXT(part_text(text, 4), "  A AT %IX0.0 : BOOL; (* one *)\n");
	CHECK_TEXT(part_text(text, 8), "  T : TON;\n");
	CHECK_TEXT(part_text(text, 10),
		   "(* above *)\nRUNG \"x\"\n  | NO A | COIL Q0 |\n");
	CHECK_AS(outlined[11].part == TEXT_RUNG && outlined[11].number == 1 &&
		 outlined[11].pou == 0, "a rung has the index of its POU");
	free(text);
	free(plain);
}

int main(void)
{
	test_garage();
	test_forms();
	test_arrays();
	test_initial_parts();
	test_tables();
	test_empty();
	test_expressions();
	test_comments();
	test_moved_comments();
	test_il();
	test_include();
	test_uses();
	test_config();
	test_rung();
	test_outline();
	project_free(project);
	return tap_done();
}
