/* SPDX-License-Identifier: MIT
 *
 * test_check_sfc - incomplete charts, made without the reader.
 */
#include "engine/check/check.h"
#include "engine/check/expect.h"
#include "tests/tap.h"
#include "tests/unit/sfc.h"

static struct test_sfc sfc;

/* "LD432:101 X LD438:12 B": code, line, argument. */
static const char *told(const struct diag_list *diags)
{
	static char text[1024];
	size_t len = 0;

	text[0] = 0;
	for (int i = 0; i < diags->count && len < sizeof(text) - 100; i++)
		len += (size_t)snprintf(text + len, sizeof(text) - len, "%s%s:%d %s",
			i ? " " : "", diag_code(diags->diag[i].id),
			diags->diag[i].line, diags->diag[i].arg);
	return text;
}

static const struct advice advice = { .nearest = expect_nearest };

static const char *check_now(void)
{
	struct diag_list diags;
	struct arena arena;
	struct scope *scope;
	const char *text;

	arena_init(&arena);
	diag_init(&diags);
	sfc.project->advice = &advice;
	scope = scope_new(sfc.project, &arena);
	CHECK(check_names(scope, NULL, &arena, &diags) == (diags.errors == 0));
	text = told(&diags);
	arena_free(&arena);
	sfc_close(&sfc);
	return text;
}

static const char *check(const char *text)
{
	sfc_open(&sfc, text);
	return check_now();
}

static void test_good(void)
{
	CHECK_TEXT(check("I A; S B; T A>B; T B>A"), "");
	CHECK_TEXT(check("I A; S B; S C; T A>B,C; T B,C>A"), "");
	CHECK_TEXT(check("I A; M B; I C; S D; T C>D; E; T A>B; T B>A"), "");
	CHECK_TEXT(check("I A; L Count N; L Q0 L T#1s; L Q1 SET; A Count; T A>A"), "");
	/* a loop of its own; names that look like addresses */
	CHECK_TEXT(check("I S0; S S1; T S0>S1; T S1>S0"), "");
}

static void test_steps(void)
{
	CHECK_TEXT(check("S A; S B; T A>B; T B>A"), "LD430:1 Main");
	CHECK_TEXT(check("I A; S B; T A>A"), "LD438:12 B LD439:12 B");
	CHECK_TEXT(check("I A; M B; S D; S F; T D>F; T F>D; E; T A>B; T B>A"),
		   "LD430:12 B LD437:12 B");
	CHECK_TEXT(check("I A; M B; E; T A>B; T B>A"), "LD430:12 B");
	CHECK_TEXT(check("I A; M B; I C; I D; S F; T C>F; T D>F; E; T A>B; T B>A"),
		   "LD431:14 D");
	CHECK_TEXT(check("I A; M B; I C; S D; S F; T C>D; T C>F; E; T A>B; T B>A"),
		   "LD437:12 B\037D, F");
	CHECK_TEXT(check("I A; S B; T A>B"), "LD439:12 B");
}

static void test_names(void)
{
	CHECK_TEXT(check("I A; S a; T A>A"),
		   "LD302:12 a\03711 LD438:12 a LD439:12 a");
	CHECK_TEXT(check("I A; L B N; A B; A b; T A>A"),
		   "LD302:202 b\037201 LD444:202 b");
	CHECK_TEXT(check("I AND; T AND>AND"), "LD317:11 AND");
	CHECK_TEXT(check("I A; L Q0 N; A Q0; T A>A"), "");
}

static void test_transitions(void)
{
	CHECK_TEXT(check("I Fill; T Fill>Fil"), "LD432:101 Fil\037Fill");
	CHECK_TEXT(check("I A; S B; T A>B,b; T B,B>A"), "LD435:101 b LD435:102 B");
	CHECK_TEXT(check("I A; T A>A="), "LD433:101 A -> A");
	CHECK_TEXT(check("I A; M B; I C; S D; T C>D; T D>A; E; T A>B; T A>D; T B>A"),
		   "LD436:102 A LD436:104 D LD437:12 B");
	CHECK_TEXT(check("I A; M B; I C; S D; T C>D; T C>B; E; T A>B; T B>A"),
		   "LD436:102 B");
}

static void test_lines(void)
{
	CHECK_TEXT(check("I A; L Q0 D; L Q1 N T#1s; L Q2 L 5; L Q3 SL Later; T A>A"),
		   "LD303:303 5" DIAG_AND "TIME LD301:304 Later LD440:301 D LD441:302 N");
	CHECK_TEXT(check("I A; L I0 N; L MW0 N; L TRUE SET; L None S; T A>A"),
		   "LD304:301 I0 LD324:302 MW0 LD305:303 TRUE LD301:304 None");
	CHECK_TEXT(check("I A; L Count SET; L Count N; A Count; A Stand; T A>A"),
		   "LD445:301 Count LD444:202 Stand");
	CHECK_TEXT(check("I A; L A.X N; L A.T N; T A>A"), "LD304:301 A.X LD304:302 A.T");
}

static uint32_t id(const char *text)
{
	return sfc_id(&sfc, text, strlen(text));
}

static const char *supervise(const char *min, const char *max, const char *alarm)
{
	sfc_open(&sfc, "I A; T A>A");
	sfc.sfc->step[0].min = id(min);
	sfc.sfc->step[0].max = id(max);
	sfc.sfc->step[0].alarm = id(alarm);
	return check_now();
}

static void test_supervision(void)
{
	CHECK_TEXT(supervise("T#1s", "T#2s", "M0"), "");
	CHECK_TEXT(supervise("T#1s", "T#1s", "Q0"), "");
	CHECK_TEXT(supervise("T#2s", "T#1999ms", "M0"), "LD442:11 A");
	CHECK_TEXT(supervise("3", "TRUE", "M0"), "LD303:11 3" DIAG_AND "TIME LD303:11 TRUE" DIAG_AND "TIME");
	CHECK_TEXT(supervise("", "T#1s", ""), "LD443:11 A");
	CHECK_TEXT(supervise("", "", "M0"), "LD448:11 A");
	CHECK_TEXT(supervise("", "A.T", "I0"), "LD304:11 I0");
}

static const char *operate(enum control control, const char *operand, bool tip)
{
	sfc_open(&sfc, "I A; T A>A");
	sfc.sfc->control[control] = id(operand);
	if (tip)
		sfc.sfc->control[CONTROL_TIP] = id("I9");
	sfc.sfc->control_line = 7;
	return check_now();
}

static void test_control(void)
{
	CHECK_TEXT(operate(CONTROL_RESET, "I0", false), "");
	CHECK_TEXT(operate(CONTROL_HOLD, "MW0", false), "LD324:7 MW0");
	CHECK_TEXT(operate(CONTROL_FORCE, "A.T", false), "LD303:7 A.T" DIAG_AND "INT");
	CHECK_TEXT(operate(CONTROL_SEMI, "I0", true), "");
	CHECK_TEXT(operate(CONTROL_MANUAL, "I0", false), "LD447:7 ");
	CHECK_TEXT(operate(CONTROL_RESET, "Nobody", false), "LD301:7 Nobody");
	/* a last step waits for RESET */
	sfc_open(&sfc, "I A; S B; T A>B");
	sfc.sfc->control[CONTROL_RESET] = id("I0");
	CHECK_TEXT(check_now(), "");
}

/* ---- bodies ---- */

static void set_cell(struct rung *rung, int row, int col, enum word word,
		     const char *operand)
{
	rung_cell(rung, row, col)->word = (uint16_t)word;
	rung_cell(rung, row, col)->operand = id(operand);
}

static struct rung *push_rung(int rows, enum word word, const char *coil)
{
	struct rung *rung = rung_new(rows, 2);

	if (!rung || !project_add_rung(sfc.pou, sfc.pou->rung_count, rung))
		abort();
	rung->line = 50;
	for (int row = 0; row < rows; row++) {
		set_cell(rung, row, 0, ELEM_CONTACT_NO, "I1");
		set_cell(rung, row, 1, word, coil);
	}
	return rung;
}

static const char *condition(int rows, enum word word, const char *coil, int rungs)
{
	sfc_open(&sfc, "I A; T A>A=");
	for (int i = 0; i < rungs; i++)
		push_rung(rows, word, coil);
	sfc.sfc->transition[0].condition = (struct sfc_body){ BODY_RUNGS, 0, rungs };
	return check_now();
}

static void test_conditions(void)
{
	CHECK_TEXT(condition(1, ELEM_COIL, "TRANSITION", 1), "");
	CHECK_TEXT(condition(1, ELEM_COIL_NOT, "transition", 1), "");
	CHECK_TEXT(condition(1, ELEM_COIL_SET, "TRANSITION", 1), "LD446:50 ");
	CHECK_TEXT(condition(1, ELEM_COIL, "Q0", 1), "LD446:50 ");
	CHECK_TEXT(condition(2, ELEM_COIL, "TRANSITION", 1), "LD446:50 ");
	CHECK_TEXT(condition(1, ELEM_COIL, "TRANSITION", 2), "LD446:50 ");
	CHECK_TEXT(condition(1, ELEM_COIL, "TRANSITION", 0), "LD433:101 ");
}

/* Two actions of one rung each. */
static void push_actions(enum word word, const char *first, const char *second)
{
	sfc_open(&sfc, "I A; L B N; L C N; A B; A C; T A>A");
	push_rung(1, word, first);
	push_rung(1, word, second);
	for (int i = 0; i < 2; i++)
		sfc.sfc->action[i].body = (struct sfc_body){ BODY_RUNGS, 1 + i, 1 };
}

static void test_bodies(void)
{
	push_actions(ELEM_COIL, "Q0", "Q0"); /* each in steps of its own */
	CHECK_TEXT(check_now(), "");
	push_actions(ELEM_COIL, "TRANSITION", "Q0");
	CHECK_TEXT(check_now(), "LD403:51 TRANSITION");
	push_actions(ELEM_JUMP, "Here", "There");
	sfc.pou->rung[2]->label = id("Here");
	CHECK_TEXT(check_now(), "LD306:51 Here LD306:51 There");
	push_actions(ELEM_JUMP, "Here", "Here");
	sfc.pou->rung[1]->label = sfc.pou->rung[2]->label = id("Here");
	CHECK_TEXT(check_now(), "");
	push_actions(ELEM_END, "", "");
	CHECK_TEXT(check_now(), "LD355:51 PROGRAM LD355:51 PROGRAM");
	push_actions(ELEM_NEXT, "", "");
	set_cell(sfc.pou->rung[1], 0, 1, ELEM_FOR, "MW0 := 1 TO 2");
	rung_clear_cell(sfc.pou->rung[2], 0, 0);
	CHECK_TEXT(check_now(), "LD215:51 FOR LD215:51 NEXT");
}

static void push_line(enum il_kind kind, enum op op, const char *operand, uint32_t line)
{
	il_add(&sfc.pou->il, (struct il_line){ .kind = (uint8_t)kind, .op = (uint8_t)op,
		.operand = id(operand), .line = line });
}

static void test_lists(void)
{
	sfc_open(&sfc, "I A; L B N; L C N; A B; A C; T A>A=");
	push_line(IL_COMMENT, OP_LD, "(* nothing *)", 30);
	push_line(IL_LABEL, OP_LD, "Top", 31);
	push_line(IL_OP, OP_JMP, "Top", 32);
	push_line(IL_OP, OP_JMP, "Below", 33);
	push_line(IL_LABEL, OP_LD, "Below", 34);
	push_line(IL_LABEL, OP_LD, "BELOW", 35);
	push_line(IL_OP, OP_S, "TRANSITION", 36);
	sfc.sfc->transition[0].condition = (struct sfc_body){ BODY_LIST, 0, 1 };
	sfc.sfc->action[0].body = (struct sfc_body){ BODY_LIST, 1, 3 };
	sfc.sfc->action[1].body = (struct sfc_body){ BODY_LIST, 4, 3 };
	CHECK_TEXT(check_now(), "LD403:36 TRANSITION LD433:101  LD306:33 Below "
		   "LD307:35 BELOW");
}

int main(void)
{
	test_good();
	test_steps();
	test_names();
	test_transitions();
	test_lines();
	test_supervision();
	test_control();
	test_conditions();
	test_bodies();
	test_lists();
	return tap_done();
}
