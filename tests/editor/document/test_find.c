/* SPDX-License-Identifier: MIT
 *
 * test_find - hits by place and kind, and replacing one or all of them.
 */
#include "editor-gtk/document/find.h"
#include "tests/editor/texts.h"
#include "tests/tap.h"

static const char sample[] =
	"RUNGBOARD 1\n\n"
	"TYPE\n  Motors : STRUCT\n    Motor : INT;\n  END_STRUCT;\nEND_TYPE\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL; (* motor on *)\n  Motor AT %QX0.0 : BOOL;\n"
	"  Motor2          : BOOL;\n  \xc3\x84rger           : INT;\nEND_VAR\n\n"
	"PROGRAM Main LD\n(* The motor *)\n"
	"RUNG Motor_on \"Motor, motor\"\n  | NO Start (* MOTOR *) | NO Motor | COIL Motor |\n"
	"RUNG\n  | NO Motor2 | JMP Motor_on |\n"
	"RUNG\n  | NO Start | ADD IN1:=\xc3\x84rger IN2:=1 OUT=>\xc3\x84rger | COIL Motor2 |\n"
	"END_PROGRAM\n\n"
	"PROGRAM List IL\nVAR\n  Motor3 : BOOL;\nEND_VAR\n  LD    Motor\n"
	"  ST    Motor3 (* motor *)\nEND_PROGRAM\n";

static LadderDocument *opened(void)
{
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, NULL, sample, strlen(sample), true);
	CHECK(ladder_document_project(document));
	return document;
}

static int count(LadderDocument *document, const char *wanted, unsigned int where,
		 bool whole, bool match_case)
{
	struct find *find = find_new(document, wanted,
				     (struct find_options){ where, whole, match_case });
	int hits = (int)find->hit->len;

	for (guint i = 0; i < find->hit->len; i++) {
		const struct find_hit *hit = find->hit->pdata[i];

		if (strncmp(wanted, "motor", 5) == 0 && where == FIND_EVERYWHERE)
			printf("# %d: %d %d (%d,%d) %s\n", hit->where, hit->pou, hit->rung,
			       hit->row, hit->col, hit->text);
	}
	find_free(find);
	return hits;
}

static void test_hits(void)
{
	LadderDocument *document = opened();

	CHECK(count(document, "motor", FIND_EVERYWHERE, false, false) == 18);
	CHECK(count(document, "motor", FIND_OPERANDS, false, false) == 4);
	CHECK(count(document, "motor", FIND_OPERANDS, true, false) == 2);
	CHECK(count(document, "Motor", FIND_COMMENTS, false, true) == 0);
	CHECK(count(document, "motor", FIND_COMMENTS, false, false) == 2);
	CHECK(count(document, "Motor", FIND_TITLES, true, true) == 1);
	CHECK(count(document, "motor_on", FIND_LABELS, true, false) == 2);
	CHECK(count(document, "motor", FIND_LISTS, true, false) == 2);
	CHECK(count(document, "motor", FIND_DECLARATIONS, false, false) == 4);
	CHECK(count(document, "\xc3\xa4RGER", FIND_EVERYWHERE, true, false) == 3);
	CHECK(count(document, "\xc3\xa4RGER", FIND_EVERYWHERE, true, true) == 0);
	CHECK(count(document, "", FIND_EVERYWHERE, false, false) == 0);
	CHECK(count(document, "\xff", FIND_EVERYWHERE, false, false) == 0);
	g_object_unref(document);
}

/* The hits that a sheet of @pou marks, and the number of the current one among them. */
static int seen(const struct find_seen *of, int pou, int *current)
{
	const struct find_hit *hit;
	int at = 0, hits = 0;
	bool now;

	*current = -1;
	while ((hit = find_seen_next(of, pou, &at, &now)) != NULL) {
		CHECK_AS(hit->pou == pou && hit == of->find->hit->pdata[at - 1], "a hit of this POU");
		*current = now ? hits : *current;
		hits++;
	}
	return hits;
}

static void test_seen(void)
{
	LadderDocument *document = opened();
	struct find *find = find_new(document, "motor", (struct find_options){ FIND_EVERYWHERE, false, false });
	struct find_seen all = { find, 5, true }, one = { find, 5, false }, none = { NULL, -1, true };
	int now;

	CHECK(seen(&all, -1, &now) == 4 && now < 0);
	CHECK_AS(seen(&all, 0, &now) == 10 && now == 1, "all in the ladder, the second is the current one");
	CHECK(seen(&all, 1, &now) == 4 && now < 0);
	CHECK_AS(seen(&one, 0, &now) == 1 && now == 0, "F3 marks the current one only");
	CHECK(seen(&one, 1, &now) == 0 && seen(&none, 0, &now) == 0);
	find_free(find);
	g_object_unref(document);
}

/* A sheet of text is marked by the rule of the search. */
static void test_match(void)
{
	LadderDocument *document = opened();
	struct find *find = find_new(document, "\xc3\xa4r", (struct find_options){ FIND_LISTS, true, false });
	const char *text = "\xc3\x84r \xc3\xa4rger _\xc3\xa4r (\xc3\xa4R)";
	gsize from = 0;

	CHECK(find_match(find, text, &from) == 0 && from == 3);
	CHECK_AS(find_match(find, text, &from) == (gssize)strlen(text) - 4 && from == strlen(text) - 1,
		 "a whole word, in any case");
	CHECK(find_match(find, text, &from) < 0);
	find_free(find);
	find = find_new(document, "", (struct find_options){ FIND_LISTS, false, false });
	from = 0;
	CHECK_AS(find_match(find, text, &from) < 0, "nothing is searched, nothing is found");
	find_free(find);
	g_object_unref(document);
}

/* Motor lies at %QX0.0: two elements show that address, and its declaration contains it. */
static void test_address(void)
{
	LadderDocument *document = opened();
	const struct find_options everywhere = { FIND_EVERYWHERE, true, true };
	struct find *find = find_new(document, "%qx0.0",
				     (struct find_options){ FIND_EVERYWHERE, false, false });
	const struct find_hit *hit = find->hit->pdata[1];
	char *text;

	CHECK(find->hit->len == 3);
	CHECK(hit->by_symbol && hit->pou == 0 && hit->rung == 0 && hit->col == 1);
	CHECK_TEXT(hit->text, "Motor");
	CHECK(!find_replace(document, find, 1, "%QX0.5", NULL));
	CHECK(!ladder_document_undo_name(document));
	CHECK_AS(find_replace_all(document, find, "%QX0.5", NULL) == 1,
		 "replacing an address changes the declaration only");
	find_free(find);
	text = ladder_document_text(document, NULL);
	CHECK(strstr(text, "%QX0.5") && strstr(text, "COIL Motor"));
	g_free(text);
	CHECK_AS(count(document, "%QX0.0", FIND_EVERYWHERE, false, false) == 0,
		 "the old address is not found any more");
	CHECK_AS(count(document, "%QX0.5", FIND_OPERANDS, true, true) == 2,
		 "the new address is found at both elements");
	CHECK_AS(count(document, "%QX0.", FIND_OPERANDS, false, false) == 0,
		 "an incomplete address is not found at operands");
	CHECK_AS(count(document, "QX0.5", FIND_EVERYWHERE, false, false) == 1,
		 "a part of the address is found in the declaration");
	find = find_new(document, "%QB0", everywhere);
	CHECK_AS(find->hit->len == 0, "a byte address does not find a bit in it");
	CHECK(find_replace_all(document, find, "x", NULL) == 0);
	find_free(find);
	g_object_unref(document);
}

static void test_order(void)
{
	LadderDocument *document = opened();
	struct find *find = find_new(document, "Motor",
				     (struct find_options){ FIND_OPERANDS, false, false });
	const struct find_hit *hit = find->hit->pdata[2];

	CHECK(hit->pou == 0 && hit->rung == 1 && hit->row == 0 && hit->col == 0);
	CHECK_TEXT(hit->text, "Motor2");
	CHECK(find_next(find, 0, 0, -1, -1, false) == 0);
	CHECK(find_next(find, 0, 0, 0, 1, false) == 1);
	CHECK(find_next(find, 0, 0, 0, 2, false) == 2);
	CHECK(find_next(find, 1, 0, 0, 0, false) == 0);
	CHECK(find_next(find, 0, 0, 0, 1, true) == 3);
	CHECK(find_next(find, 0, 0, 0, 2, true) == 0);
	find_free(find);
	find = find_new(document, "nothing", (struct find_options){ 63, false, false });
	CHECK(find_next(find, 0, 0, 0, 0, false) == -1);
	find_free(find);
	g_object_unref(document);
}

/* Returns the number of replacements. */
static int replace_all(LadderDocument *document, const char *wanted, const char *with,
		       unsigned int where, bool whole)
{
	struct find *find = find_new(document, wanted,
				     (struct find_options){ where, whole, true });
	char *why = NULL;
	int done = find_replace_all(document, find, with, &why);

	CHECK((done < 0) == (why && *why));
	if (why)
		printf("# %s\n", why);
	g_free(why);
	find_free(find);
	return done;
}

static void test_replace(void)
{
	LadderDocument *document = opened();
	char *before = ladder_document_text(document, NULL);
	struct find *find = find_new(document, "Motor",
				     (struct find_options){ FIND_OPERANDS, true, true });

	CHECK(find_replace(document, find, 1, "\xe7\x94\xb5\xe6\x9c\xba", NULL));
	CHECK(document_has(document, "| NO Motor | COIL \xe7\x94\xb5\xe6\x9c\xba |"));
	CHECK_TEXT(ladder_document_undo_name(document), "Replace");
	CHECK(ladder_document_undo(document));
	find_free(find);

	CHECK(replace_all(document, "Motor", "Pump", FIND_EVERYWHERE, false) == 13);
	CHECK(!strstr(ladder_document_undo_name(document), "Motor"));
	CHECK(document_has(document, "  Pump AT %QX0.0 : BOOL;\n") || document_has(document, "  Pump  AT"));
	CHECK(document_has(document, "RUNG Pump_on \"Pump, motor\""));
	CHECK(document_has(document, "JMP Pump_on"));
	CHECK(document_has(document, "  ST    Pump3 (* motor *)\n"));
	CHECK(document_has(document, "    Pump : INT;"));
	CHECK(!document_has(document, "Motor3"));
	CHECK(ladder_document_undo(document) && document_has(document, before));
	CHECK_AS(!ladder_document_undo_name(document), "all replacements are one step");

	CHECK(replace_all(document, "Motor", "a | b", FIND_OPERANDS, true) == -1);
	CHECK(replace_all(document, "Start", "x\ny", FIND_OPERANDS, true) == -1);
	CHECK(replace_all(document, "Motor2", "A : INT; B", FIND_DECLARATIONS, true) == -1);
	CHECK(replace_all(document, "BOOL", "((", FIND_DECLARATIONS, true) == -1);
	CHECK(replace_all(document, "motor", "*) x", FIND_COMMENTS, true) == -1);
	CHECK_AS(document_has(document, before) && !ladder_document_undo_name(document),
		 "a replacement that cannot be read changes nothing");
	CHECK(replace_all(document, "1", "2", FIND_OPERANDS, true) == 1);
	CHECK(document_has(document, "IN2:=2 OUT"));
	CHECK(replace_all(document, "Motor", "Motor", FIND_EVERYWHERE, false) == 13);
	CHECK(ladder_document_undo(document) && document_has(document, before));
	g_free(before);
	g_object_unref(document);
}

/* The reason names the place, and nothing changes. */
static void refuses(const char *wanted, const char *with, unsigned int where,
		    const char *want)
{
	LadderDocument *document = opened();
	struct find *find = find_new(document, wanted,
				     (struct find_options){ where, true, true });
	char *why = NULL, *before = ladder_document_text(document, NULL);

	CHECK(find_replace_all(document, find, with, &why) == -1);
	CHECK_TEXT(why, want);
	CHECK(!ladder_document_undo_name(document) && document_has(document, before));
	g_free(before);
	g_free(why);
	find_free(find);
	g_object_unref(document);
}

static void test_reasons(void)
{
	refuses("Motor", "Start", FIND_EVERYWHERE, "\xe2\x80\x9cStart\xe2\x80\x9d is declared already");
	refuses("Motor", "motor2", FIND_DECLARATIONS,
		"\xe2\x80\x9cMotor2\xe2\x80\x9d is declared already");
	refuses("Motor", "", FIND_DECLARATIONS,
		"\xe2\x80\x9c: INT;\xe2\x80\x9d: expected: name of a variable, not \":\"");
	refuses("Start", "x | y", FIND_OPERANDS, "Main, rung 1: \"NO\" is missing here; "
		"write: | NO x | NO y (* MOTOR *) | NO Motor | COIL Motor |");
}

/* ---- charts ---- */

static const char chart[] =
	"RUNGBOARD 1\n\nPROGRAM Main SFC\n  VAR\n    Full : BOOL;\n  END_VAR\n\n"
	"  INITIAL_STEP Fill:\n    (* full? *)\n    Full(N);\n    Do(P1);\n  END_STEP\n\n"
	"  TRANSITION FROM Fill TO Fill := Full AND Fill.X; END_TRANSITION\n\n"
	"  TRANSITION FROM Fill TO Fill:\n    RUNG\n      | NO Full | COIL TRANSITION |\n"
	"  END_TRANSITION\n\n  ACTION Do:\n    LD    Full\n    ST    %MX0.0\n"
	"  END_ACTION\nEND_PROGRAM\n";

/* Expressions are found as lines, rungs as rungs, declarations as declarations. */
static void test_chart(void)
{
	LadderDocument *document = ladder_document_new();
	struct find *find;
	int rungs = 0, lines = 0, declared = 0;
	char *why = NULL;

	ladder_document_open_text(document, NULL, chart, strlen(chart), true);
	find = find_new(document, "Full", (struct find_options){ FIND_EVERYWHERE, true,
								 true });
	for (guint i = 0; i < find->hit->len; i++) {
		const struct find_hit *hit = find->hit->pdata[i];

		rungs += hit->rung >= 0;
		declared += hit->where == FIND_DECLARATIONS;
		lines += hit->where == FIND_LISTS;
		if (hit->where == FIND_LISTS)
			CHECK(strstr(hit->text, "Full") == hit->text + hit->at);
	}
	CHECK(rungs == 1 && declared == 1 && lines == 3);
	CHECK(find_replace_all(document, find, "Empty", NULL) == 5);
	CHECK(document_has(document, "    Empty(N);\n") && document_has(document, "| NO Empty | COIL TR") &&
	      document_has(document, ":= Empty AND Fill.X;") && document_has(document, "    Empty : BOOL;"));
	CHECK(ladder_document_undo(document));
	CHECK(document_has(document, "    Full(N);\n") && !ladder_document_undo_name(document));
	find_free(find);
	/* A result that cannot be read is refused, and nothing changes. */
	find = find_new(document, "INITIAL_STEP", (struct find_options){ FIND_EVERYWHERE,
									 true, true });
	CHECK(find_replace_all(document, find, "STEP STEP", &why) == -1 && why && *why);
	CHECK(document_has(document, "  INITIAL_STEP Fill:"));
	g_free(why);
	find_free(find);
	g_object_unref(document);
}

/* Structured Text: statements, comments and the declarations of its program. */
static const char statements[] =
	"RUNGBOARD 1\n\nVAR\n  Level : INT;\nEND_VAR\n\n"
	"FUNCTION_BLOCK Pump ST\nVAR_INPUT\n  Start : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Runs : BOOL;\nEND_VAR\n"
	"  Runs := Start;  // not by level\nEND_FUNCTION_BLOCK\n\n"
	"PROGRAM Main ST\nVAR\n  Levels : ARRAY[1..2] OF INT;\n  Feed   : Pump;\nEND_VAR\n"
	"  IF Level > Levels[1] AND\n      Level < 90 THEN\n    Feed(Start := Level > 3);\n  END_IF;\n"
	"  (* the level\n     and its limits *)\n  Level := Level + 1;\nEND_PROGRAM\n";

static void test_statements(void)
{
	LadderDocument *document = ladder_document_new();
	const struct find_hit *hit;
	struct find *find;
	char *text;

	ladder_document_open_text(document, NULL, statements, strlen(statements), true);
	CHECK(count(document, "level", FIND_EVERYWHERE, false, false) == 10);
	CHECK(count(document, "level", FIND_EVERYWHERE, true, false) == 8);
	CHECK(count(document, "Level", FIND_LISTS, true, true) == 5);
	CHECK(count(document, "start", FIND_LISTS, true, false) == 3);
	CHECK(count(document, "level", FIND_DECLARATIONS, true, false) == 1);
	CHECK(count(document, "level", FIND_OPERANDS | FIND_COMMENTS | FIND_TITLES, false, false) == 0);
	find = find_new(document, "Level", (struct find_options){ FIND_LISTS, true, true });
	hit = find->hit->pdata[2];
	CHECK(hit->pou == 1 && hit->row >= 0 && hit->col == 18);
	CHECK_TEXT(hit->text, "    Feed(Start := Level > 3);");
	CHECK_AS(find_next(find, hit->pou, -1, hit->row, hit->col, false) == 3, "the hit behind it is the next one");
	CHECK_AS(find_next(find, hit->pou, -1, hit->row, hit->col, true) == 1, "and the one before it");
	CHECK(find_replace(document, find, 2, "Levels[2]", NULL));
	find_free(find);
	find = find_new(document, "Level", (struct find_options){ FIND_LISTS, true, true });
	CHECK(find->hit->len == 4 && find_replace_all(document, find, "Levels[1]", NULL) == 4);
	find_free(find);
	text = ladder_document_text(document, NULL);
	CHECK(strstr(text, "    Feed(Start := Levels[2] > 3);\n") && strstr(text, "  Levels[1] := Levels[1] + 1;\n"));
	CHECK_AS(strstr(text, "// not by level\n") && strstr(text, "(* the level\n"), "comments keep their words");
	g_free(text);
	ladder_document_undo(document);
	ladder_document_undo(document);
	text = ladder_document_text(document, NULL);
	CHECK_TEXT(text, statements);
	g_free(text);
	g_object_unref(document);
}

int main(void)
{
	test_statements();
	test_hits();
	test_seen();
	test_match();
	test_address();
	test_order();
	test_replace();
	test_reasons();
	test_chart();
	return tap_done();
}
