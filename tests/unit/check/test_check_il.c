/* SPDX-License-Identifier: MIT
 *
 * test_check_il - every error of an instruction list, in lists and in expressions
 * of a ladder; and correct lists get none.
 */
#include "engine/check/check_il.h"
#include "tests/unit/rig.h"

static const char declared[] =
	"RUNGBOARD 1\n"
	"VAR\n"
	"  A, B : BOOL;\n  By : BYTE;\n  W : WORD;\n  Dw : DWORD;\n  Si : SINT;\n"
	"  I, K : INT;\n  D : DINT;\n  Us : USINT;\n  U : UINT;\n  Ud : UDINT;\n"
	"  Re : REAL;\n  T : TIME;\n  Delay : TON;\n  Up : CTU;\n"
	"END_VAR\n"
	"VAR CONSTANT\n  Seven : INT := 7;\n  Yes : BOOL := TRUE;\nEND_VAR\n";

/* "LD303:20" of the first error of this program, "" when it is good. */
static const char *first(const char *head, const char *body, const char *tail)
{
	static char found[256];
	static char text[20000];
	struct ladder *ladder = ladder_new();
	const struct diag_list *diags = ladder_diags(ladder);

	snprintf(text, sizeof(text), "%s%s%s%s", declared, head, body, tail);
	if (ladder_load_text(ladder, "t.rung", text, strlen(text)))
		ladder_build(ladder);
	found[0] = '\0';
	for (int i = 0; i < diags->count && !found[0]; i++)
		if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR)
			snprintf(found, sizeof(found), "%s%s%s",
				 diag_code(diags->diag[i].id),
				 diags->diag[i].arg[0] ? " " : "",
				 diags->diag[i].arg);
	if (!diags->errors != !!ladder_program(ladder))
		snprintf(found, sizeof(found), "errors and a program, or neither");
	ladder_free(ladder);
	return found;
}

/* Compares the beginning only: a message may be longer than @want. */
static void check_first(const char *got, const char *want, const char *what,
			int line)
{
	bool same = *want ? !strncmp(got, want, strlen(want)) : !*got;

	if (!tap_check(same, what, __FILE__, line))
		printf("# got:  %s\n# want: %s\n", got, want);
}
#define CHECK_FIRST(got, want) check_first((got), (want), #got, __LINE__)

static const char *il(const char *body)
{
	return first("PROGRAM Main IL\n", body, "\nEND_PROGRAM\n");
}

/* One cell in front of a coil. */
static const char *cell(const char *text)
{
	return first("PROGRAM Main LD\nRUNG\n  | NO A | ", text,
		     " | COIL B |\nEND_PROGRAM\n");
}

static void takes_good_lists(void)
{
	static const char *const good[] = {
		"", "  RET", "  LD A\n  RETC", "Here:\n  LD A\n  JMPC Here",
		"  LD 1\n  AND A\n  ST B", "  LD 0\n  ST A\n  ST I\n  ST Re",
		"  LDN 0\n  ST A", "  LD 1\n  S A\n  ST K",
		"  LD I\n  ST D\n  ST Re\n  ST K", "  LD Us\n  ST I\n  ST Ud\n  ST Re",
		"  LD By\n  ST W\n  ST Dw", "  LD INT#5\n  ST D\n  ST Re",
		"  LD I\n  ADD D\n  ST D", "  LD 5\n  ADD I\n  ST I",
		"  LD Re\n  ADD 1\n  MUL I\n  ST Re", "  LD T\n  ADD T#1s\n  ST T",
		"  LD I\n  GT 5\n  ST A", "  LD A\n  AND( I\n  GT 5\n  )\n  ST B",
		"  LD A\n  ORN(\n  LDN B\n  )\n  ST B", "  LD A\n  XOR( B\n  NOT\n  )\n  ST B",
		"  LD T\n  LT T#3s\n  ST A", "  LD A\n  EQ B\n  ST A",
		"  CAL Delay(IN := A, PT := T#1s, Q => B, ET => T)",
		"  CAL Up(CU := 1, PV := 5, CV => D)", "  LD 1\n  CALC Up",
		"  LD T#1s\n  ST Delay.PT\n  LD Delay.Q\n  ST B",
		"  MOVE(IN := 5, OUT => Si)", "  MOVE(EN := 1, IN := TRUE, OUT => A)",
		"  ADD(IN1 := I, IN2 := 1, IN3 := D, OUT => D, ENO => A)",
		"  GT(IN1 := 5, IN2 := I, OUT => A)", "  MOVE(IN := 5)",
		"  LD Seven\n  ST I\n  LD Yes\n  ST A", "  LD W\n  EQ 16#FF\n  ST A",
		"  LD A\n  JMPCN L\n  LD B\n  ST A\nL:", "  LD %MW4\n  ST %QW4",
	};

	for (size_t i = 0; i < sizeof(good) / sizeof(good[0]); i++)
		if (!CHECK_AS(!strcmp(il(good[i]), ""), "a correct list has no errors"))
			printf("# %s:\n# %s\n", il(good[i]), good[i]);
}

static void finds_names_and_pins(void)
{
	CHECK_FIRST(il("  LD Nobody\n  ADD 1\n"), "LD301 Nobody");
	CHECK_FIRST(il("  LD A\n  ST A.Q"), "LD301 A.Q");
	CHECK_FIRST(il("  LD 1\n  ST %IX0.0"), "LD304 %IX0.0");
	CHECK_FIRST(il("  LD A\n  S %SMX0.0"), "LD304 %SMX0.0");
	CHECK_FIRST(il("  LD 5\n  ST Seven"), "LD305 Seven");
	CHECK_FIRST(il("  LD A\n  R Yes"), "LD305 Yes");
	CHECK_FIRST(il("  LD A\n  JMPC Nowhere"), "LD306 Nowhere");
	CHECK_FIRST(il("L:\n  LD A\nL:\n  RET"), "LD307 L");
	CHECK_FIRST(il("  LD Delay\n  ST A"), "LD308 Delay");
	CHECK_FIRST(il("  LD A\n  ST Delay"), "LD308 Delay");
	CHECK_FIRST(il("  LD A\n  AND Delay\n  ST A"), "LD308 Delay");
	CHECK_FIRST(il("  LD I\n  ADD Up\n  ST I"), "LD308 Up");
	CHECK_FIRST(il("  MOVE(IN := Up, OUT => I)"), "LD308 Up");
	CHECK_FIRST(il("  CAL Delay(IN := Up)"), "LD308 Up");
	CHECK_FIRST(il("  CAL A"), "LD309 A");
	CHECK_FIRST(il("  CAL Main"), "LD353 Main");
	CHECK_FIRST(il("  CAL Delay(CU := A)"), "LD319 CU");
	CHECK_FIRST(il("  CAL Delay(start => T)"), "LD319");
	CHECK_FIRST(il("  LD Delay.CV\n  ST I"), "LD319 Delay.CV");
	CHECK_FIRST(il("  MOVE(IN1 := I, OUT => K)"), "LD319 IN1");
	CHECK_FIRST(il("  ADD(IN1 := I, IN2 := I, IN17 := I, OUT => I)"), "LD319 IN17");
	CHECK_FIRST(il("  MOVE(IN := I, RESULT => K)"), "LD319 RESULT");
	CHECK_FIRST(il("  CAL Delay(Q := A)"), "LD320 Q");
	CHECK_FIRST(il("  CAL Delay(IN => A)"), "LD357 IN");
	CHECK_FIRST(il("  LD A\n  ST Delay.Q"), "LD320 Delay.Q");
	CHECK_FIRST(il("  CAL Delay(Q => %IX0.0)"), "LD304 %IX0.0");
	CHECK_FIRST(il("  MOVE(IN := 1, OUT => Seven)"), "LD305 Seven");
	CHECK_FIRST(il("  MOVE(IN := T#1s, OUT => Delay.ET)"), "LD320 Delay.ET");
	CHECK_FIRST(il("  ADD(IN1 := I, OUT => K)"), "LD321 ADD");
	CHECK_FIRST(il("  ADD(IN1 := I, IN3 := I, OUT => K)"), "LD321 ADD");
	CHECK_FIRST(il("  MOVE(EN := A, OUT => K)"), "LD321 MOVE");
}

static void finds_types(void)
{
	CHECK_FIRST(il("  LD A\n  ADD 1\n  ST I"), "LD332");
	CHECK_FIRST(il("  LD D\n  ST I"), "LD322 I\037DINT\037INT");
	CHECK_FIRST(il("  LD U\n  ST I"), "LD322 I\037UINT\037INT");
	CHECK_FIRST(il("  LD I\n  ST W"), "LD322 W\037INT\037WORD");
	CHECK_FIRST(il("  LD D\n  ST Re"), "LD322 Re\037DINT\037REAL");
	CHECK_FIRST(il("  LD A\n  ST I"), "LD322 I\037BOOL\037INT");
	CHECK_FIRST(il("  LD 1\n  NOT\n  ST I"), "LD322 I\037BOOL\037INT");
	CHECK_FIRST(il("  LDN 1\n  ST I"), "LD322 I\037BOOL\037INT");
	CHECK_FIRST(il("  LD INT#5\n  ST Si"), "LD322 Si\037INT\037SINT");
	CHECK_FIRST(il("  LD T\n  ADD I\n  ST T"), "LD322 I\037TIME\037INT");
	CHECK_FIRST(il("  LD Ud\n  ADD D\n  ST D"), "LD322 D\037LINT\037DINT");
	CHECK_FIRST(il("  LD W\n  GT I\n  ST A"), "LD322 I\037WORD\037INT");
	CHECK_FIRST(il("  LD T\n  GT Re\n  ST A"), "LD322 Re\037TIME\037REAL");
	CHECK_FIRST(il("  CAL Up(PV := D)"), "LD322 D\037DINT\037INT");
	CHECK_FIRST(il("  CAL Up(CV => Si)"), "LD322 Si\037INT\037SINT");
	CHECK_FIRST(il("  GT(IN1 := I, IN2 := 5, OUT => K)"), "LD322 K\037BOOL\037INT");
	CHECK_FIRST(il("  LD 128\n  ST Si"), "LD116 128\037SINT");
	CHECK_FIRST(il("  LD -1\n  ST U"), "LD116 -1\037UINT");
	CHECK_FIRST(il("  LD 2\n  ST A"), "LD331");
	CHECK_FIRST(il("  LD I\n  ADD 40000\n  ST I"), "LD116 40000\037INT");
	CHECK_FIRST(il("  MOVE(IN := 300, OUT => Us)"), "LD116 300\037USINT");
	CHECK_FIRST(il("  LD T\n  MUL T\n  ST T"), "LD332");
	CHECK_FIRST(il("  LD Re\n  MOD Re\n  ST Re"), "LD332");
	CHECK_FIRST(il("  LD W\n  ADD W\n  ST W"), "LD332");
	CHECK_FIRST(il("  LD A\n  ADD B\n  ST A"), "LD332");
}

static void finds_what_is_not_bool(void)
{
	CHECK_FIRST(il("  LDN I\n  ST A"), "LD324 I");
	CHECK_FIRST(il("  LD A\n  AND I\n  ST A"), "LD324 I");
	CHECK_FIRST(il("  LD I\n  AND A\n  ST A"), "LD333");
	CHECK_FIRST(il("  LD A\n  AND 2\n  ST A"), "LD324 2");
	CHECK_FIRST(il("  LD I\n  NOT"), "LD333");
	CHECK_FIRST(il("  LD I\n  S A"), "LD333");
	CHECK_FIRST(il("  LD A\n  S I"), "LD324 I");
	CHECK_FIRST(il("  LD A\n  STN I"), "LD324 I");
	CHECK_FIRST(il("  LD I\n  JMPC L\nL:"), "LD333");
	CHECK_FIRST(il("  LD I\n  RETCN"), "LD333");
	CHECK_FIRST(il("  LD I\n  CALC Up"), "LD333");
	CHECK_FIRST(il("  LD A\n  OR( I\n  )\n  ST A"), "LD333");
	CHECK_FIRST(il("  MOVE(EN := I, IN := 1, OUT => K)"), "LD324 I");
	CHECK_FIRST(il("  MOVE(IN := 1, OUT => K, ENO => I)"), "LD324 I");
}

/* @count lines more. */
static void add(char *list, size_t size, const char *line, int count)
{
	size_t len = strlen(list);

	while (count-- > 0 && len < size)
		len += (size_t)snprintf(list + len, size - len, "%s", line);
}

static void finds_structure(void)
{
	char deep[2000] = "  LD A\n";

	CHECK_FIRST(il("  LD A\n  AND( B\n  ST A"), "LD601 (");
	CHECK_FIRST(il("  LD A\n  AND( B\n  JMP L\nL:"), "LD601 JMP");
	CHECK_FIRST(il("  LD A\n  AND( B\n  RETC"), "LD601 RET");
	CHECK_FIRST(il("  LD A\n  AND( B\nL:\n  LD A\n  ST B"), "LD601 L");
	CHECK_FIRST(il("  LD A\n  )\n  ST B"), "LD602 )");
	CHECK_FIRST(il("  LD A\n  AND( B\n  )\n  )\n  ST B"), "LD602 )");
	CHECK_FIRST(il("  ST A"), "LD603 A");
	CHECK_FIRST(il("  AND A"), "LD603 A");
	CHECK_FIRST(il("  NOT"), "LD603");
	CHECK_FIRST(il("  ADD 5"), "LD603 5");
	CHECK_FIRST(il("  JMPC L\nL:"), "LD603 L");
	CHECK_FIRST(il("  RETC"), "LD603");
	CHECK_FIRST(il("  CALC Up"), "LD603 Up");
	CHECK_FIRST(il("  LD A\n  AND(\n  )\n  ST B"), "LD603");
	CHECK_FIRST(il("  LD A\nL:\n  ST B"), "LD609 B" DIAG_AND "L");
	CHECK_FIRST(il("  LD A\n  JMP L\n  ST B\nL:"), "LD603 B");
	CHECK_FIRST(il("  LD A\n  CAL Up\n  ST B"), "LD603 B");
	CHECK_FIRST(il("  AND( A\n  OR B\n  )\n"), "LD603 A");
	CHECK_FIRST(il("  LD A\n  JMPN L\nL:"), "LD604 JMPN");
	CHECK_FIRST(il("  LD A\n  RETN"), "LD604 RETN");
	CHECK_FIRST(il("  CALN Up"), "LD604 CALN");
	CHECK_FIRST(il("  LD A\n  SN B"), "LD604 SN");
	CHECK_FIRST(il("  LDC A"), "LD604 LDC");
	add(deep, sizeof(deep), "  OR( B\n", LIMIT_IL_DEPTH + 1);
	CHECK_FIRST(il(deep), "LD605 (");
}

static void counts_one_error_once(void)
{
	struct ladder *ladder = ladder_new();
	static const char text[] = "RUNGBOARD 1\nVAR\n  A : BOOL;\nEND_VAR\n"
		"PROGRAM Main IL\n  AND( A\n  OR A\n  )\n  ST A\nEND_PROGRAM\n";

	CHECK(ladder_load_text(ladder, "t.rung", text, strlen(text)));
	CHECK(!ladder_build(ladder) && ladder_diags(ladder)->errors == 1);
	CHECK(ladder_diags(ladder)->diag[0].line == 6);
	CHECK_TEXT(ladder_diags(ladder)->diag[0].pou, "Main");
	ladder_free(ladder);
}

static void takes_limits(void)
{
	char deep[3000] = "  LD A\n";

	add(deep, sizeof(deep), "  OR(\n  LD B\n", LIMIT_IL_DEPTH);
	add(deep, sizeof(deep), "  )\n", LIMIT_IL_DEPTH);
	add(deep, sizeof(deep), "  ST A\n", 1);
	CHECK_FIRST(il(deep), "");
}

static void checks_cells(void)
{
	CHECK_FIRST(cell("[ I > 5 ]"), "");
	CHECK_FIRST(cell("[ I := -32768 ]"), "");
	CHECK_FIRST(cell("[ T := -T#1s ]"), "");
	CHECK_FIRST(cell("[ -T#1s < T ]"), "");
	CHECK_FIRST(cell("[ Re := 2 * 3.5 ]"), "");
	CHECK_FIRST(cell("[ I + 1 ]"), "LD333");
	CHECK_FIRST(cell("[ I AND A ]"), "LD333");
	CHECK_FIRST(cell("[ I > A ]"), "LD322 A\037INT\037BOOL");
	CHECK_FIRST(cell("[ I := D ]"), "LD322 I\037DINT\037INT");
	CHECK_FIRST(cell("[ I := I + D ]"), "LD322 I\037DINT\037INT");
	CHECK_FIRST(cell("[ I := 32768 ]"), "LD116");
	CHECK_FIRST(cell("[ U := -5 ]"), "LD116");
	CHECK_FIRST(cell("[ Seven := 5 ]"), "LD305 Seven");
	CHECK_FIRST(cell("[ I0 := TRUE ]"), "LD304 I0");
	CHECK_FIRST(cell("[ Delay.Q := TRUE ]"), "LD320 Delay.Q");
	CHECK_FIRST(cell("[ Delay > 5 ]"), "LD308 Delay");
	CHECK_FIRST(cell("[ Re MOD 2.0 > 1.0 ]"), "LD332");
	CHECK_FIRST(cell("[ T * T > T ]"), "LD332");
	CHECK_FIRST(cell("ADD IN1:=I OUT=>I"), "LD321");
	CHECK_FIRST(cell("ADD IN1:=I IN2:=D OUT=>I"), "LD322 I\037DINT\037INT");
	CHECK_FIRST(cell("TON Delay PT:=I"), "LD322 I\037INT\037TIME");
	CHECK_FIRST(cell("TON Delay PT:=5"), "LD328");
	CHECK_FIRST(cell("TON Up PT:=T#5s"), "LD309 Up");
	CHECK_FIRST(cell("TON Delay PV:=5"), "LD319");
}

/* The type that both types widen to: symmetric, and never narrower. */
static void joins_types(void)
{
	for (int a = 0; a < IEC_TYPE_COUNT; a++)
		for (int b = 0; b < IEC_TYPE_COUNT; b++) {
			enum iec_type x = (enum iec_type)a, y = (enum iec_type)b;
			enum iec_type join = types_join(x, y);

			if (join != types_join(y, x) ||
			    (a == b && join != x) ||
			    (a == IEC_NONE && join != y) ||
			    (a && b && join != IEC_TYPE_COUNT &&
			     !(iec_can_widen(x, join) && iec_can_widen(y, join))))
				CHECK_AS(false, "both types widen to their join");
		}
	CHECK(types_join(IEC_SINT, IEC_INT) == IEC_INT);
	CHECK(types_join(IEC_USINT, IEC_SINT) == IEC_INT);
	CHECK(types_join(IEC_UINT, IEC_INT) == IEC_DINT);
	CHECK(types_join(IEC_UINT, IEC_SINT) == IEC_DINT);
	CHECK(types_join(IEC_UDINT, IEC_SINT) == IEC_LINT);
	CHECK(types_join(IEC_INT, IEC_REAL) == IEC_REAL);
	CHECK(types_join(IEC_DINT, IEC_REAL) == IEC_LREAL);
	CHECK(types_join(IEC_ULINT, IEC_SINT) == IEC_TYPE_COUNT);
	CHECK(types_join(IEC_LINT, IEC_REAL) == IEC_TYPE_COUNT);
	CHECK(types_join(IEC_BYTE, IEC_DWORD) == IEC_DWORD);
	CHECK(types_join(IEC_BYTE, IEC_USINT) == IEC_TYPE_COUNT);
	CHECK(types_join(IEC_BOOL, IEC_BYTE) == IEC_TYPE_COUNT);
	CHECK(types_join(IEC_TIME, IEC_DINT) == IEC_TYPE_COUNT);
	CHECK(types_join(IEC_NONE, IEC_NONE) == IEC_NONE);
}

int main(void)
{
	takes_good_lists();
	finds_names_and_pins();
	finds_types();
	finds_what_is_not_bool();
	finds_structure();
	counts_one_error_once();
	takes_limits();
	checks_cells();
	joins_types();
	return tap_done();
}
