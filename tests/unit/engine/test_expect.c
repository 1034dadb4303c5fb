/* SPDX-License-Identifier: MIT
 *
 * completion through the facade, as the editor uses it: in lists, cells and
 * declarations, also in texts with errors; and suggestions for misspelled words.
 */
#include "engine/base/nearest.h"
#include "engine/ladder.h"

#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

static const char text[] =
	"RUNGBOARD 1\n"
	"VAR\n"
	"  Motor AT %QX0.0 : BOOL;\n"
	"  Open  AT %IX0.0 : BOOL;\n"
	"  Level : INT;\n"
	"  Delay : TON;\n"
	"  Late : \n"                                    /* 7 */
	"END_VAR\n"
	"PROGRAM Main IL\n"
	"  LD    Op\n"                                   /* 10 */
	"  S     \n"
	"  JMP   \n"
	"  CAL   Delay(IN := Open,\n"
	"              PT := \n"                         /* 14 */
	"  LD    Delay.\n"
	"Again:\n"
	"  AN\n"                                         /* 17 */
	"  CAL   \n"
	"END_PROGRAM\n"
	"SUBROUTINE Sub LD\n"
	"RUNG\n"
	"  | NO  | TON  | TON Delay  | COIL  | CALL  | [ Le | [ Level + SQ | [ NOT In | [ Level SQ |\n" /* 22 */
	"END_SUBROUTINE\n"
	"\n"
	"PROGRAM More IL\n"
	"  INT_TO_RE\n"                                  /* 26 */
	"  WORD_\n"
	"  TO_S\n"
	"  IN\n"
	"  TIME_OF\n"                                    /* 30 */
	"END_PROGRAM\n";

struct seen { char text[16384]; };

static void take(void *context, const struct ladder_word *word)
{
	struct seen *seen = context;
	size_t used = strlen(seen->text);

	snprintf(seen->text + used, sizeof(seen->text) - used, " %s ", word->text);
}

/* All words at a place, each between blanks. */
static const char *at(struct ladder *ladder, int line, int column)
{
	static struct seen seen;
	struct ladder_place place = { 0 };

	seen.text[0] = '\0';
	if (!ladder_complete(ladder, text, sizeof(text) - 1, line, column, take, &seen,
			     &place))
		return "nowhere";
	return seen.text;
}

static bool has(const char *words, const char *word)
{
	char between[64];

	snprintf(between, sizeof(between), " %s ", word);
	return strstr(words, between) != NULL;
}

/* A body of Structured Text, in which ^ is the cursor. */
static const char head_st[] =
	"RUNGBOARD 1\n"
	"TYPE\n"
	"  Phase : (Idle, Filling := 3, Draining);\n"
	"  Gear  : (Idle := 7, First);\n"
	"  Step : STRUCT\n    Level : INT;\n    Time : TIME;\n  END_STRUCT;\n"
	"END_TYPE\n"
	"VAR\n"
	"  Open  AT %IX0.0 : BOOL;\n"
	"  Level : INT;\n  Now : Phase;\n  Steps : ARRAY[2..3, 1..9] OF Step;\n"
	"  Line : ARRAY[1..4] OF TON;\n"
	"END_VAR\n"
	"FUNCTION Top : INT ST\n"
	"VAR_INPUT\n  X : INT;\n  How : Phase;\nEND_VAR\n  Top := X;\nEND_FUNCTION\n"
	"PROGRAM Main ST\n"
	"VAR\n  Wait : TON;\n  i : INT;\nEND_VAR\n";

/* The words at ^ of @body; @call: gets the call there, or NULL. */
static const char *st_at(const char *body, char **call)
{
	static struct seen seen;
	struct ladder *ladder = ladder_new();
	struct ladder_place place = { 0 };
	const char *mark = strchr(body, '^');
	size_t from = 0, to = 0, before = sizeof(head_st) - 1 + (size_t)(mark - body);
	char whole[2048], with[256];
	int line = 1, column = 1;

	snprintf(whole, sizeof(whole), "%s%.*s%s\nEND_PROGRAM\n", head_st, (int)(mark - body), body,
		 mark + 1);
	for (size_t i = 0; i < before; i++) {
		column = whole[i] == '\n' ? 1 : column + 1;
		line += whole[i] == '\n';
	}
	ladder_load_text(ladder, "st.rung", whole, strlen(whole));
	seen.text[0] = '\0';
	if (!ladder_complete(ladder, whole, strlen(whole), line, column, take, &seen, &place))
		snprintf(seen.text, sizeof(seen.text), "nowhere");
	if (call) {
		char *found = ladder_call_at(ladder, whole, strlen(whole), line, column, &from, &to);

		snprintf(with, sizeof(with), "%s|%.*s", found ? found : "", (int)(to - from),
			 found ? found + from : "");
		free(found);
		*call = strdup(with);
	}
	ladder_free(ladder);
	return seen.text;
}

/* The same in an action of a chart. */
#define ACTION "END_PROGRAM\nPROGRAM Other SFC\n  INITIAL_STEP A:\n    Do(N);\n  END_STEP\n  ACTION Do:\n"

static void test_statements(void)
{
	static const struct {
		const char *body, *has, *has_not;
	} cases[] = {
		{ "  ^", " Level ", " Open " }, { "  ^", " IF ", " ELSE " },
		{ "  ^", " END_PROGRAM ", " RUNG " }, { "  W^", " Wait ", " IF " },
		{ "  Level := 1;\n  I^", " IF ", " Level " },
		{ "  IF ^", " Open ", " THEN " }, { "  IF Open ^", " THEN ", " Level " },
		{ "  IF Open THEN\n  ^", " ELSIF ", " END_FOR " },
		{ "  IF Open THEN ELSE\n  ^", " END_IF ", " ELSIF " },
		{ "  IF Open THEN\n  ^ END_IF;", " END_IF ", " END_PROGRAM " },
		{ "  IF Open THEN Level := 1; END_IF;\n  ^", " END_PROGRAM ", " END_IF " },
		{ "  FOR ^", " i ", " Open " }, { "  FOR i := 1 ^", " TO ", " BY " },
		{ "  FOR i := 1 TO 3 ^", " BY ", " TO " },
		{ "  FOR i := 1 TO 3 DO ^", " END_FOR ", " UNTIL " },
		{ "  WHILE Open ^", " DO ", " THEN " },
		{ "  REPEAT Level := 1; ^", " UNTIL ", " END_WHILE " },
		{ "  REPEAT Level := 1; UNTIL Open ^", " END_REPEAT ", " DO " },
		{ "  REPEAT UNTIL Open END_REPEAT; ^", " END_PROGRAM ", " UNTIL " },
		{ "  CASE Now ^", " OF ", " DO " },
		{ "  CASE Now OF ^", " Phase#Idle ", " First " },
		{ "  CASE Now OF Filling: Level := 2;\n  ^", " Draining ", " THEN " },
		{ "  CASE Now OF Filling, ^", " Draining ", " IF " },
		{ "  CASE Now OF Filling: Level := 2; END_CASE; ^", " IF ", " Draining " },
		{ "  Now := ^", " Filling ", " First " }, { "  IF Now = F^", " Filling ", " First " },
		{ "  IF Level > ^", " First ", " THEN " },
		{ "  Now := Phase#^", " Idle ", " Phase#Idle " },
		{ "  Now := Gear#I^", " Idle ", " Filling " },
		{ "  Now := Phase.^", " Idle ", " First " },
		{ "  Level := Steps[2, i].^", " Time ", " Level2 " },
		{ "  Level := Steps[i + 1, i].L^", " Level ", " Time " },
		{ "  IF Line[i].^", " Q ", " Open " },
		{ "  Level := Level.^", " %B1 ", " %W0 " }, { "  IF Level.^", " 15 ", " 16 " },
		{ "  Level.^", " 0 ", " Level " }, { "  Level := Level.%^", " %X9 ", " 9 " },
		{ "  Level := Steps[2, i].Level.1^", " 10 ", " 9 " },
		{ "  Wait(^", " PT :=  ", " EN " }, { "  Wait(^", " Q =>  ", " Filling " },
		{ "  Wait(P^", " PT :=  ", " IN :=  " },
		{ "  Wait(IN := ^", " Open ", " PT :=  " },
		{ "  Wait(IN := Open ^", " AND ", " THEN " },
		{ "  Wait(IN := Open,\n    PT := T#1s,\n    ^", " Q =>  ", " IF " },
		{ "  Wait(Q => ^", " Open2 ", " Open " },
		{ "  Level := Top(How := ^", " Filling ", " First " },
		{ "  Level := Top(X := 3, ^", " How :=  ", " THEN " },
		{ "  (* IF Open THEN *) ^", " END_PROGRAM ", " END_IF " },
		{ "  IF Open THEN Level := \n  IF ^", " Open ", " THEN " },
		{ "  // IF Open THEN\n  ^", " END_PROGRAM ", " END_IF " },
		{ "VAR\n  X : ^ END_VAR", " INT ", " IF " },
		{ ACTION "    Level := 1;\n    ^\n  END_ACTION", " END_ACTION ", " END_PROGRAM " },
		{ ACTION "    Level := 1;\n    I^\n  END_ACTION", " IF ", " LD " },
		{ ACTION "    IF Open ^\n  END_ACTION", " THEN ", " Level " },
		{ ACTION "    IF A.^\n  END_ACTION", " X ", " Open " },
		{ ACTION "    WHILE Open DO\n      ^\n  END_ACTION", " END_WHILE ", " END_ACTION " },
		{ ACTION "    Now := ^;\n  END_ACTION", " Filling ", " First " },
		{ ACTION "    LD Open\n    ^\n  END_ACTION", " AND ", " IF " },
	};

	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		const char *words = st_at(cases[i].body, NULL);
		const bool wanted = strcmp(cases[i].has, " Open2 ") == 0 ||
			strstr(words, cases[i].has);

		CHECK_AS(wanted && !strstr(words, cases[i].has_not),
			 strrchr(cases[i].body, '\n') ? strrchr(cases[i].body, '\n') + 1 :
			 cases[i].body);
	}
}

static void test_calls(void)
{
	static const struct {
		const char *body, *call;
	} cases[] = {
		{ "  Wait(^", "Wait(IN : BOOL, PT : TIME, Q => BOOL, ET => TIME)|IN : BOOL" },
		{ "  Wait(Open, ^", "Wait(IN : BOOL, PT : TIME, Q => BOOL, ET => TIME)|PT : TIME" },
		{ "  Wait(IN := Open, Q => ^",
		  "Wait(IN : BOOL, PT : TIME, Q => BOOL, ET => TIME)|Q => BOOL" },
		{ "  Level := 1 + Top(How := ^", "Top(X : INT, How : Phase)|How : Phase" },
		{ "  Level := Top((1 + 2), ^", "Top(X : INT, How : Phase)|How : Phase" },
		{ "  Level := Top((1 + ^", "|" }, { "  Level := Top(1); ^", "|" },
		{ "  Level := Nothing(^", "|" }, { "  Level := ^", "|" },
		{ ACTION "    Level := Top(3, ^);\n  END_ACTION", "Top(X : INT, How : Phase)|How : Phase" },
		{ ACTION "    LD Top(^\n  END_ACTION", "|" }, { ACTION "    ^\n  END_ACTION", "|" },
		{ ACTION "^END_ACTION", "|" },
	};
	char *call;

	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		st_at(cases[i].body, &call);
		CHECK_TEXT(call, cases[i].call);
		free(call);
	}
}

static void nobody(void *context, const struct ladder_word *word)
{
	(void)word;
	++*(int *)context;
}

/* @text after one more key, at each place: what is read is never beyond its end, which an allocation of its size
 * lets a sanitizer see. @gone: bytes that the key deletes. */
static int look_everywhere(struct ladder *ladder, const char *whole, size_t len, size_t gone)
{
	int seen = 0, line = 1, column = 1;

	for (size_t i = 0; i + gone <= len; i++) {
		const size_t left = len - gone;
		char *now = malloc(left + 1);
		struct ladder_place place = { 0 };
		size_t from = 0, to = 0;

		memcpy(now, whole, i);
		memcpy(now + i, whole + i + gone, left - i);
		now[left] = '\0';
		ladder_complete(ladder, now, left, line, column, nobody, &seen, &place);
		free(ladder_call_at(ladder, now, left, line, column, &from, &to));
		column = whole[i] == '\n' ? 1 : column + 1;
		line += whole[i] == '\n';
		free(now);
	}
	return seen;
}

/* A chart with actions of each language, also empty ones, and a program of each. */
static void test_everywhere(void)
{
	static const char *const action[] = { "", "    ;\n", "    Level := Top(3, Now);\n", "    LD Open\n    ST Open2\n",
					      "    RUNG\n      | NO Open | COIL Open2 |\n" };

	for (size_t i = 0; i < sizeof(action) / sizeof(*action); i++) {
		char whole[3000];
		struct ladder *ladder = ladder_new();
		const int len = snprintf(whole, sizeof(whole), "%s  Level := 1;\n" ACTION "%s  END_ACTION\n  TRANSITION FROM A TO A := Open;\nEND_PROGRAM\n"
					 "PROGRAM Rungs LD\nRUNG\n  | NO Open | COIL Open2 |\nEND_PROGRAM\n"
					 "PROGRAM List IL\n  LD Open\nEND_PROGRAM\n"
					 "PROGRAM Nets FBD\nNETWORK\n  Open2 := AND(Open, Open)\nEND_PROGRAM\n", head_st, action[i]);

		CHECK((size_t)len < sizeof(whole));
		ladder_load_text(ladder, "st.rung", whole, (size_t)len);
		CHECK(look_everywhere(ladder, whole, (size_t)len, 0) > 0);
		CHECK(look_everywhere(ladder, whole, (size_t)len, 1) > 0);
		CHECK(look_everywhere(ladder, whole, (size_t)len, 9) > 0);
		ladder_free(ladder);
	}
}

static void test_lists(struct ladder *ladder)
{
	const char *words = at(ladder, 10, 11);

	CHECK_AS(has(words, "Open") && !has(words, "Motor"), "LD Op");
	words = at(ladder, 11, 9);
	CHECK_AS(has(words, "Motor") && !has(words, "Open") && !has(words, "Level"),
		 "S takes a BOOL that can be written");
	CHECK_AS(strcmp(at(ladder, 12, 9), " Again ") == 0, "JMP takes labels");
	words = at(ladder, 14, 15);
	CHECK_AS(has(words, "PT") && has(words, "ET") && !has(words, "Open"),
		 "a call offers pins, also on its second line");
	words = at(ladder, 15, 15);
	CHECK_AS(has(words, "Q") && has(words, "ET") && !has(words, "Motor"),
		 "a dot offers the parts of the instance");
	words = at(ladder, 17, 5);
	CHECK_AS(has(words, "AND") && has(words, "ANDN(") && !has(words, "LD"),
		 "the beginning of an operator offers it with its modifiers");
	words = at(ladder, 17, 3);
	CHECK_AS(has(words, "STPCN") && has(words, "SQRT") && has(words, "END_PROGRAM"),
		 "the beginning of a line offers operators, functions and END_PROGRAM");
	words = at(ladder, 18, 9);
	CHECK_AS(has(words, "Delay") && has(words, "Sub") && !has(words, "Motor"),
		 "CAL offers instances and subroutines");
}

static void test_cells(struct ladder *ladder)
{
	const char *words = at(ladder, 22, 8);

	CHECK_AS(has(words, "Motor") && has(words, "Open") && !has(words, "Level"),
		 "a contact takes a BOOL");
	CHECK_AS(strcmp(at(ladder, 22, 15), " Delay ") == 0, "TON takes a TON");
	CHECK_AS(has(at(ladder, 22, 28), "PT"), "an instance is followed by its pins");
	words = at(ladder, 22, 36);
	CHECK_AS(has(words, "Motor") && !has(words, "Open"),
		 "a coil takes a BOOL that can be written");
	CHECK_AS(strcmp(at(ladder, 22, 44), " Sub ") == 0, "CALL takes subroutines");
	words = at(ladder, 22, 51);
	CHECK_AS(has(words, "Level") && !has(words, "Open"),
		 "an expression takes variables");
	CHECK_AS(has(words, "LEN") && has(words, "LEFT"),
		 "an expression takes functions");
	CHECK_AS(has(at(ladder, 22, 66), "SQRT"), "an operator is followed by functions");
	words = at(ladder, 22, 77);
	CHECK_AS(has(words, "INSERT") && !has(words, "INT_TO_REAL"),
		 "NOT is followed by functions");
	CHECK_AS(at(ladder, 22, 90)[0] == '\0', "a value is not followed by a word");
	words = at(ladder, 22, 4);
	CHECK_AS(has(words, "STOP") && has(words, "CTU") && has(words, "ADD"),
		 "an empty cell offers elements, blocks and functions");
}

/* Conversions are offered once their first type and its _ are typed. */
static void test_made(struct ladder *ladder)
{
	const char *words = at(ladder, 26, 12);

	CHECK_AS(strcmp(words, " INT_TO_REAL ") == 0, "INT_TO_RE");
	words = at(ladder, 26, 7);
	CHECK_AS(has(words, "INT_TO_REAL") && has(words, "INT_TO_BCD_WORD") &&
		 has(words, "INT_TO_STRING") && !has(words, "INT_TO_INT_TO_INT") &&
		 !has(words, "INT_TRUNC_DINT"), "INT_");
	words = at(ladder, 27, 8);
	CHECK_AS(has(words, "WORD_BCD_TO_UINT") && has(words, "WORD_TO_INT") &&
		 !has(words, "DWORD_TO_INT"), "WORD_");
	words = at(ladder, 28, 7);
	CHECK_AS(has(words, "TO_SINT") && has(words, "TO_STRING") && !has(words, "TO_INT"),
		 "TO_S");
	words = at(ladder, 29, 5);
	CHECK_AS(has(words, "INC") || has(words, "INSERT"), "IN");
	CHECK_AS(!strstr(words, "INT_"), "the letters IN offer no conversions");
	CHECK_AS(!strstr(at(ladder, 29, 3), "_TO_"),
		 "an empty place offers no conversions");
	CHECK_AS(has(at(ladder, 30, 10), "TIME_OF_DAY_TO_DINT"), "TIME_OF");
}

static void test_places(struct ladder *ladder)
{
	CHECK_AS(has(at(ladder, 7, 10), "LREAL") && has(at(ladder, 7, 10), "TON"),
		 "a colon offers types");
	CHECK_AS(has(at(ladder, 24, 1), "SUBROUTINE"),
		 "a line outside of programs offers the words that begin a part");
	CHECK(strcmp(at(ladder, 99, 1), "nowhere") == 0);
	CHECK(strcmp(at(ladder, 10, 99), "nowhere") == 0);
	CHECK(strcmp(at(ladder, 0, 0), "nowhere") == 0);
	for (int line = 1; line <= 31; line++) /* none is out of bounds */
		for (int column = 1; column < 60; column++)
			at(ladder, line, column);
	CHECK(true);
}

static bool nearest_is(const char *wanted, const char *printed)
{
	static const char *const words[] = { "Motor", "Rotor", "Level", "LevelLow",
					     "MOTOR", "I", "J" };
	struct nearest nearest;
	char out[64];

	nearest_init(&nearest, wanted, strlen(wanted));
	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		nearest_offer(&nearest, words[i]);
	nearest_print(&nearest, out, sizeof(out));
	if (strcmp(out, printed) == 0)
		return true;
	printf("# %s\n", out);
	return false;
}

static void test_nearest(void)
{
	CHECK_AS(nearest_is("Mootr", "Mootr" DIAG_AND "Motor, Rotor"),
		 "names with two swapped letters are near");
	CHECK_AS(nearest_is("levle", "levle" DIAG_AND "Level"),
		 "the case of letters does not matter");
	CHECK_AS(nearest_is("Lev", "Lev" DIAG_AND "Level, LevelLow"), "beginnings");
	CHECK_AS(nearest_is("X", "X"), "one letter is not near another one");
	CHECK_AS(nearest_is("Something_else", "Something_else"),
		 "a different name has no near names");
	CHECK(nearest_is("", ""));
}

int main(void)
{
	struct ladder *ladder = ladder_new();

	CHECK(ladder && !ladder_load_text(ladder, "x.rung", text, sizeof(text) - 1));
	test_lists(ladder);
	test_statements();
	test_calls();
	test_everywhere();
	test_cells(ladder);
	test_made(ladder);
	test_places(ladder);
	test_nearest();
	ladder_free(ladder);
	return tap_done();
}
