/* SPDX-License-Identifier: MIT
 *
 * test_pins - pins change their order and kind only where all calls keep their meaning: random
 * moves leave every operand at its pin, and are refused where operands have no names.
 */
#include "editor-gtk/document/pins.h"

#include "editor-gtk/document/symbols.h"

#include "tests/tap.h"

#include <string.h>

static const char BLOCK[] =
	"FUNCTION_BLOCK Motor LD\nVAR_INPUT\n  Level : INT;\n  Start : BOOL; (* begins *)\n"
	"  Stop  : BOOL;\n  Wait  : TIME := T#500ms;\nEND_VAR\nVAR_OUTPUT\n  Run  : BOOL;\n"
	"  Late : BOOL;\n  Sum  : INT;\nEND_VAR\nVAR_IN_OUT\n  Total : DINT;\n  Other : DINT;\n"
	"END_VAR\nVAR\n  Inner : INT;\nEND_VAR\nRUNG\n  | NO Start | NC Stop | COIL Run |\n"
	"END_FUNCTION_BLOCK\n\n"
	"FUNCTION Scaled : INT IL\nVAR_INPUT\n  X : INT;\n  A : INT;\n  B : INT := 0;\nEND_VAR\n"
	"  LD    X\n  MUL   A\n  ADD   B\n  ST    Scaled\nEND_FUNCTION\n";
static const char BOX[] = "RUNG\n  | NO %IX0.0 | Motor M Level:=R Wait:=T#2s Total:=T Other:=U"
	" Sum=>R | COIL %QX0.0 |\n  | NO %IX0.1 | .Stop                                       "
	"                 |\n";

static LadderDocument *document;

static void open_with(const char *language, const char *body)
{
	char *text = g_strdup_printf("RUNGBOARD 1\n\nVAR\n  M : Motor;\n  T : DINT;\n  U : DINT;\n"
		"  R : INT;\nEND_VAR\n\nPROGRAM Main %s\n%sEND_PROGRAM\n\n%s", language, body, BLOCK);

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	CHECK(ladder_document_project(document));
	g_free(text);
}

static void open_text(const char *parts)
{
	char *text = g_strconcat("RUNGBOARD 1\n\n", parts, NULL);

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	CHECK(ladder_document_project(document));
	g_free(text);
}

static const struct pou *pou_named(const char *name)
{
	const struct project *project = ladder_document_project(document);

	return &project->pou[project_find_pou(project, name, strlen(name))];
}

static int number_of(const struct pou *pou)
{
	return (int)(pou - ladder_document_project(document)->pou);
}

/* The pins of a kind in their order: "Level Start Stop Wait". */
static char *order_of(const char *pou_name, uint16_t kind)
{
	const struct pou *pou = pou_named(pou_name);
	GString *out = g_string_new(NULL);

	for (int i = 0; i < vars_declared(&pou->vars); i++)
		if (pins_kind(pou, i) == kind)
			g_string_append_printf(out, "%s%s", out->len ? " " : "",
				project_text(ladder_document_project(document),
					     pou->vars.var[i].name));
	return g_string_free(out, FALSE);
}

static bool is_order(const char *pou, uint16_t kind, const char *order)
{
	char *is = order_of(pou, kind);
	const bool same = strcmp(is, order) == 0;

	if (!same)
		printf("# is: %s\n", is);
	g_free(is);
	return same;
}

static int pin(const char *pou_name, const char *name)
{
	const struct pou *pou = pou_named(pou_name);

	for (int i = 0; i < pou->vars.count; i++)
		if (strcmp(project_text(ladder_document_project(document),
					pou->vars.var[i].name), name) == 0)
			return i;
	return -1;
}

/* Exchanges a variable with the next (@by 1) or previous (-1) one of its kind. NULL: it moved. */
static char *move_at(int pou, int index, int by)
{
	const struct var_table *vars = &ladder_document_project(document)->pou[pou].vars;
	const uint16_t kind = vars_flags(vars, index) & SYMBOL_KINDS;
	int before = index;

	for (int passed = 0; passed < (by > 0 ? 2 : 1); passed++)
		do
			before += by;
		while (before >= 0 && before < vars_declared(vars) &&
		       (vars_flags(vars, before) & SYMBOL_KINDS) != kind);
	if (before < 0)
		return g_strdup("it is the first one");
	return pin_put(document, pou, index, kind, before < vars_declared(vars) ? before : -1);
}

static char *move(const char *pou, const char *name, int by)
{
	return move_at(number_of(pou_named(pou)), pin(pou, name), by);
}

static bool is_refused(const char *pou, const char *name, int by, const char *part)
{
	char *before = ladder_document_text(document, NULL), *after;
	char *why = move(pou, name, by);
	bool good;

	after = ladder_document_text(document, NULL);
	good = why && strstr(why, part) && strcmp(before, after) == 0;
	if (!good)
		printf("# %s\n", why ? why : "the pin moved");
	g_free(why);
	g_free(before);
	g_free(after);
	return good;
}

/* The list of Main, in which each operand is stored to a pin by its name. */
static char *meaning(void)
{
	const struct il *il;
	GString *out = g_string_new(NULL);
	struct ladder *ladder;
	size_t len;
	char *text;

	ladder_document_check_now(document);
	ladder = ladder_document_checked(document);
	if (ladder_diags(ladder)->errors)
		return g_string_free(out, FALSE);
	il = ladder_il(ladder, 0);
	g_string_printf(out, "%d\n", il ? il->count : -1);
	text = ladder_document_list(document, 0);
	len = strlen(text);
	g_string_append_len(out, text, (gssize)len);
	g_free(text);
	return g_string_free(out, FALSE);
}

static void test_moves(void)
{
	GRand *chance = g_rand_new_with_seed(3);
	char *first, *mine;
	bool good = true, is;
	int moved = 0;

	open_with("LD", BOX);
	first = ladder_document_text(document, NULL);
	mine = meaning();
	CHECK_AS(*mine, "the example builds");
	for (int i = 0; good && i < 120; i++) {
		const struct pou *motor = pou_named("Motor");
		const int at = g_rand_int_range(chance, 0, vars_declared(&motor->vars));
		char *before = ladder_document_text(document, NULL), *after, *now, *why;

		if (!pins_kind(motor, at)) {
			g_free(before);
			continue;
		}
		why = move_at(number_of(motor), at, g_rand_boolean(chance) ? 1 : -1);
		after = ladder_document_text(document, NULL);
		now = meaning();
		is = strcmp(before, after) != 0;
		good = strcmp(now, mine) == 0 && strlen(before) == strlen(after) && !(is && why);
		moved += is;
		g_free(before);
		if (good && is) {
			good = ladder_document_undo(document);
			before = ladder_document_text(document, NULL);
			good = good && ladder_document_redo(document) &&
			       strcmp(before, after) != 0;
			g_free(before);
		}
		g_free(why);
		g_free(now);
		g_free(after);
	}
	CHECK_AS(good && moved > 20, "moving pins does not change the calls");
	while (ladder_document_undo(document))
		;
	g_free(mine);
	mine = ladder_document_text(document, NULL);
	CHECK_AS(strcmp(first, mine) == 0, "undo restores the first text");
	g_free(mine);
	g_free(first);
	g_rand_free(chance);
}

static void test_power(void)
{
	open_with("LD", BOX);
	CHECK(is_refused("Motor", "Start", 1, "connected to “Start”"));
	CHECK(is_refused("Motor", "Stop", -1, "connected to “Start”"));
	CHECK(is_refused("Motor", "Run", 1, "connected to “Run”"));
	CHECK(!move("Motor", "Level", 1) && is_order("Motor", VAR_INPUT, "Start Level Stop Wait"));
	open_with("LD", "RUNG\n");
	CHECK_AS(!move("Motor", "Start", 1), "without a box a pin may move anywhere");
	CHECK(is_order("Motor", VAR_INPUT, "Level Stop Start Wait"));
}

static void test_positions(void)
{
	open_with("IL", "  CAL   M(1, TRUE)\n");
	CHECK(is_refused("Motor", "Wait", -1, "“Main” gives operands by position"));
	open_with("IL", "  CAL   M(Level := 1, Start := TRUE, Total := T, Other := U)\n");
	CHECK_AS(!move("Motor", "Wait", -1),
		 "a pin moves if the operands of a call have names");
	open_with("IL", "  LD    1\n  Scaled 3, 10\n  ST    R\n");
	CHECK(is_refused("Scaled", "A", 1, "by position"));
	open_with("IL", "  Scaled(X := 1, A := 3, OUT => R)\n");
	CHECK(!move("Scaled", "A", 1) && is_order("Scaled", VAR_INPUT, "X B A"));
	open_with("LD", "RUNG\n  | [ R := Scaled(1, 2, 3) ] |\n");
	CHECK(is_refused("Scaled", "A", 1, "by position"));
	open_with("LD", "RUNG\n  | [ R := Scaled(X := 1, A := (2)) ] |\n");
	CHECK(!move("Scaled", "A", 1));
	open_with("LD", "RUNG\n  | NO %IX0.0 | Scaled X:=1 A:=2 OUT=>R |\n");
	CHECK(!move("Scaled", "X", 1) && is_order("Scaled", VAR_INPUT, "A X B"));
}

/* ö is Ö, and o with U+0308. */
static void test_spellings(void)
{
	static const char *const calls[] = { "IL\n  LD    5\n  öl 3\n  ST    R\n",
		"LD\nRUNG\n  | [ R := öl(1, 2, 3) ] |\n",
		"LD\nRUNG\n  | [ R := O\u0308l(1, 2, 3) ] |\n" };
	static const char function[] =
		"FUNCTION Öl : INT IL\nVAR_INPUT\n  X : INT;\n  A : INT;\n  B : INT := 2;\n"
		"END_VAR\n  LD    X\n  MUL   A\n  ADD   B\n  ST    Öl\nEND_FUNCTION\n";

	for (gsize i = 0; i < G_N_ELEMENTS(calls); i++) {
		char *text = g_strdup_printf("VAR\n  R : INT;\nEND_VAR\n\n"
			"PROGRAM Main %sEND_PROGRAM\n\n%s", calls[i], function);

		open_text(text);
		CHECK(is_refused("Öl", "A", 1, "by position"));
		g_free(text);
	}
}

static void test_result(void)
{
	char *why;

	open_with("LD", "RUNG\n");
	why = pins_set_result(document, number_of(pou_named("Scaled")), "ARRAY");
	CHECK_AS(why, "a result of an unknown type is refused");
	g_free(why);
	CHECK(!pins_set_result(document, number_of(pou_named("Scaled")), "DINT") &&
	      pou_named("Scaled")->vars.var[0].type == IEC_DINT);
	CHECK(ladder_document_undo(document) && pou_named("Scaled")->vars.var[0].type == IEC_INT);
	CHECK(pins_count(pou_named("Motor"), VAR_IN_OUT) == 2 &&
	      pins_count(pou_named("Scaled"), VAR_INPUT) == 3 && !pins_kind(pou_named("Scaled"), 0));
}

static char *set_kind(const char *pou, const char *name, uint16_t kind)
{
	return pin_set_kind(document, number_of(pou_named(pou)), pin(pou, name), kind);
}

static bool is_kind_refused(const char *pou, const char *name, uint16_t kind, const char *part)
{
	char *before = ladder_document_text(document, NULL), *after;
	char *why = set_kind(pou, name, kind);
	bool good;

	after = ladder_document_text(document, NULL);
	good = why && strstr(why, part) && strcmp(before, after) == 0 &&
	       !ladder_document_undo_name(document);
	if (!good)
		printf("# %s\n", why ? why : "the kind changed");
	g_free(why);
	g_free(before);
	g_free(after);
	return good;
}

/* Every kind becomes every other, in one step that undo takes back. */
static void test_kinds(void)
{
	static const uint16_t kinds[] = { VAR_INPUT, VAR_OUTPUT, VAR_IN_OUT, 0, VAR_TEMP };

	for (gsize i = 0; i < G_N_ELEMENTS(kinds); i++)
		for (gsize k = 0; k < G_N_ELEMENTS(kinds); k++) {
			char *first, *last, *why;

			open_with("LD", "RUNG\n");
			if (kinds[i] != VAR_INPUT)
				g_free(set_kind("Motor", "Level", kinds[i]));
			first = ladder_document_text(document, NULL);
			why = set_kind("Motor", "Level", kinds[k]);
			CHECK(!why && (vars_flags(&pou_named("Motor")->vars, pin("Motor", "Level")) &
				SYMBOL_KINDS) == kinds[k]);
			if (i != k)
				CHECK(ladder_document_undo(document));
			last = ladder_document_text(document, NULL);
			CHECK_TEXT(last, first);
			g_free(why);
			g_free(last);
			g_free(first);
		}
}

static bool builds(void)
{
	char *now = meaning();
	const bool good = *now;

	g_free(now);
	return good;
}

static void test_kinds_and_callers(void)
{
	open_with("LD", BOX);
	CHECK(is_kind_refused("Motor", "Start", VAR_OUTPUT, "connected to “Start”"));
	CHECK(is_kind_refused("Motor", "Run", 0, "connected to “Run”"));
	CHECK(pin_calls(document, number_of(pou_named("Motor")), pin("Motor", "Wait")) == 1 &&
	      pin_calls(document, number_of(pou_named("Motor")), pin("Motor", "Late")) == 0 &&
	      pin_calls(document, number_of(pou_named("Motor")), pin("Motor", "Inner")) == 0 &&
	      pin_calls(document, number_of(pou_named("Motor")), pin("Motor", "Start")) == 0);
	CHECK(!set_kind("Motor", "Wait", VAR_OUTPUT) &&
	      is_order("Motor", VAR_OUTPUT, "Run Late Sum Wait"));
	CHECK_AS(!builds(), "the caller that gives it an operand has an error");
	CHECK(ladder_document_undo(document) && builds());
	open_with("IL", "  CAL   M(1, TRUE)\n");
	CHECK(is_kind_refused("Motor", "Wait", VAR_OUTPUT, "“Main” gives operands by position"));
	CHECK(is_kind_refused("Motor", "Inner", VAR_INPUT, "“Main” gives operands by position"));
	CHECK_AS(!set_kind("Motor", "Inner", VAR_TEMP), "no caller sees a variable");
	open_text("VAR\n  L : Late;\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | Late L | COIL "
		  "%QX0.0 |\nEND_PROGRAM\n\nFUNCTION_BLOCK Late LD\nVAR\n  A : BOOL;\nEND_VAR\n"
		  "VAR_OUTPUT\n  Q : BOOL;\nEND_VAR\nRUNG\n  | NO A | COIL Q |\n"
		  "END_FUNCTION_BLOCK\n");
	CHECK(is_kind_refused("Late", "A", VAR_INPUT, "would be connected to “A”"));
	CHECK_AS(is_kind_refused("Late", "A", VAR_OUTPUT, "connected to “Q”"),
		 "a variable that becomes the first output");
}

/* A function of another file keeps its result. */
static void test_included(void)
{
	static const char own[] = "RUNGBOARD 1\n\nINCLUDE \"more.rung\"\n\nPROGRAM Main LD\nRUNG\n"
		"END_PROGRAM\n";
	char *folder = g_dir_make_tmp(NULL, NULL), *more = g_build_filename(folder, "more.rung", NULL);
	char *path = g_build_filename(folder, "own.rung", NULL), *text, *why;

	text = g_strconcat("RUNGBOARD 1\n\n", BLOCK, NULL);
	CHECK(g_file_set_contents(more, text, -1, NULL));
	ladder_document_open_text(document, path, own, strlen(own), true);
	CHECK(ladder_document_project(document) && pou_named("Scaled")->included);
	why = pins_set_result(document, number_of(pou_named("Scaled")), "DINT");
	CHECK_TEXT(why ? why : "", "It is declared in another file");
	CHECK(is_kind_refused("Motor", "Wait", VAR_OUTPUT, "declared in another file"));
	remove(more);
	remove(folder);
	g_free(why);
	g_free(text);
	g_free(path);
	g_free(more);
	g_free(folder);
}

/* ---- to any place of any kind ---- */

static const uint16_t every_kind[] = { VAR_INPUT, VAR_IN_OUT, VAR_OUTPUT, 0, VAR_TEMP };

/* All variables by kind, in their order: "Level Start|Total|…". */
static char *layout_of(const char *pou_name)
{
	const struct pou *pou = pou_named(pou_name);
	GString *out = g_string_new(NULL);

	for (gsize k = 0; k < G_N_ELEMENTS(every_kind); k++) {
		for (int i = 0; i < vars_declared(&pou->vars); i++)
			if ((vars_flags(&pou->vars, i) & SYMBOL_KINDS) == every_kind[k])
				g_string_append_printf(out, "%s ", project_text(
					ladder_document_project(document), pou->vars.var[i].name));
		g_string_append_c(out, '|');
	}
	return g_string_free(out, FALSE);
}

/* The same after a move: @name is taken out and stands before @before, "": at the end of kind
 * number @kind. */
static char *moved_layout(const char *layout, const char *name, gsize kind, const char *before)
{
	char **side = g_strsplit(layout, "|", -1);
	GString *out = g_string_new(NULL);

	for (gsize k = 0; k < G_N_ELEMENTS(every_kind); k++) {
		char **names = g_strsplit(*side[k] ? side[k] : " ", " ", -1);

		for (char **at = *side[k] ? names : names + 1; *at; at++) {
			if (k == kind && strcmp(*at, before) == 0)
				g_string_append_printf(out, "%s ", name);
			if (**at && strcmp(*at, name) != 0)
				g_string_append_printf(out, "%s ", *at);
		}
		g_string_append_c(out, '|');
		g_strfreev(names);
	}
	g_strfreev(side);
	return g_string_free(out, FALSE);
}

static void check_put(const char *name, gsize kind, const char *before)
{
	const int pou = number_of(pou_named("Motor"));
	char *first = ladder_document_text(document, NULL), *last;
	char *was = layout_of("Motor"), *want = moved_layout(was, name, kind, before), *is;
	char *why = pin_put(document, pou, pin("Motor", name), every_kind[kind],
			    *before ? pin("Motor", before) : -1);

	is = layout_of("Motor");
	if (!CHECK_AS(!why && strcmp(is, want) == 0, name))
		printf("# kind %d before %s: %s\n# is: %s\n", (int)kind, before, why ? why : want, is);
	if (strcmp(was, want) != 0)
		CHECK(ladder_document_undo(document));
	last = ladder_document_text(document, NULL);
	CHECK_AS(strcmp(first, last) == 0, "one step takes it back");
	g_free(why);
	g_free(want);
	g_free(was);
	g_free(is);
	g_free(first);
	g_free(last);
}

static void test_put(void)
{
	static const char *const names[] = { "Level", "Stop", "Late", "Total", "Inner" };
	static const char *const places[][5] = { { "Level", "Stop", "Wait", "" },
		{ "Total", "Other", "" }, { "Run", "Sum", "" }, { "Inner", "" }, { "" } };

	open_with("LD", "RUNG\n");
	for (gsize i = 0; i < G_N_ELEMENTS(names); i++)
		for (gsize k = 0; k < G_N_ELEMENTS(places); k++)
			for (gsize n = 0; n < G_N_ELEMENTS(places[k]) && places[k][n]; n++)
				if (strcmp(places[k][n], names[i]) != 0)
					check_put(names[i], k, places[k][n]);
}

/* What one part of a move may not do undoes all of it. */
static void test_put_refused(void)
{
	char *first, *last, *why;

	open_with("LD", BOX);
	first = ladder_document_text(document, NULL);
	why = pin_put(document, number_of(pou_named("Motor")), pin("Motor", "Late"), VAR_INPUT,
		      pin("Motor", "Level"));
	CHECK_AS(why && strstr(why, "connected to “Start”"), why ? why : "it moved");
	last = ladder_document_text(document, NULL);
	CHECK_TEXT(last, first);
	CHECK(!ladder_document_undo_name(document));
	g_free(why);
	g_free(last);
	g_free(first);
}

/* Blocks of the same kind are one list. */
static void test_two_blocks(void)
{
	open_text("PROGRAM Main LD\nRUNG\nEND_PROGRAM\n\nFUNCTION_BLOCK Two LD\nVAR_INPUT\n  A : INT; (* a *)\n"
		  "END_VAR\nVAR_OUTPUT\n  Q : BOOL;\nEND_VAR\nVAR_INPUT\n  B : INT;\n  C : INT;\nEND_VAR\n"
		  "RUNG\nEND_FUNCTION_BLOCK\n");
	CHECK(!pin_put(document, 1, pin("Two", "C"), VAR_INPUT, pin("Two", "A")) &&
	      is_order("Two", VAR_INPUT, "C A B"));
	CHECK(!pin_put(document, 1, pin("Two", "C"), VAR_INPUT, -1) &&
	      is_order("Two", VAR_INPUT, "A B C"));
	CHECK(ladder_document_undo(document) && is_order("Two", VAR_INPUT, "C A B"));
}

/* A name of the program Main among its variables, which are in the file's order. */
static void check_order(const char *name, const char *before, const char *order)
{
	char *text = ladder_document_text(document, NULL), *last;
	char *why = pin_put(document, 0, pin("Main", name), 0, *before ? pin("Main", before) : -1);

	CHECK_AS(!why && is_order("Main", 0, order), name);
	if (ladder_document_undo(document)) {
		last = ladder_document_text(document, NULL);
		CHECK_TEXT(last, text);
		CHECK(ladder_document_redo(document));
		g_free(last);
	}
	g_free(why);
	g_free(text);
}

static bool retains(const char *name)
{
	return vars_flags(&pou_named("Main")->vars, pin("Main", name)) & VAR_RETAIN;
}

/* Variables keep their qualifiers, and pass no other one than is meant. */
static void test_qualifiers(void)
{
	open_text("PROGRAM Main LD\nVAR\n  A : INT; (* a *)\nEND_VAR\nVAR RETAIN\n  C : INT;\nEND_VAR\n"
		  "VAR\n  B : INT;\nEND_VAR\nRUNG\nEND_PROGRAM\n");
	check_order("A", "B", "C A B");
	check_order("A", "C", "A C B");
	check_order("B", "C", "A B C");
	check_order("B", "", "A C B");
	check_order("A", "", "C B A");
	check_order("C", "A", "B A C");
	check_order("C", "B", "C B A");
	CHECK(retains("C") && !retains("A") && !retains("B"));
	/* what is between two of other qualifiers is no place: the next one is */
	open_text("PROGRAM Main LD\nVAR\n  A : INT;\nEND_VAR\nVAR RETAIN\n  C : INT;\n  D : INT;\nEND_VAR\n"
		  "VAR\n  (* about B *)\n  B : INT;\nEND_VAR\nRUNG\nEND_PROGRAM\n");
	check_order("A", "D", "C D A B");
	check_order("B", "D", "B C D A");
	check_order("A", "D", "B A C D");
	CHECK(retains("C") && retains("D") && !retains("A") && !retains("B"));
}

int main(void)
{
	document = ladder_document_new();
	test_included();
	test_moves();
	test_power();
	test_positions();
	test_spellings();
	test_result();
	test_kinds();
	test_kinds_and_callers();
	test_put();
	test_put_refused();
	test_two_blocks();
	test_qualifiers();
	g_object_unref(document);
	return tap_done();
}
