/* SPDX-License-Identifier: MIT
 *
 * test_symbols - declarations as rows, edits of each field, hostile input, and import and
 * export of CSV.
 */
#include "editor-gtk/document/csv.h"
#include "editor-gtk/draw/listing.h"
#include "tests/editor/opened.h"
#include "tests/editor/texts.h"
#include "tests/tap.h"

#include <stdlib.h>

static const char sample[] =
	"RUNGBOARD 1\n\n"
	"TYPE\n  Recipe : STRUCT\n    Speed : INT := 5; (* rpm *)\n  END_STRUCT;\nEND_TYPE\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL; (* green *)\n  Motor AT %QX0.0 : BOOL;\n"
	"  Count : INT := 7; // of parts\n  Table : ARRAY[1..3] OF INT := [1, 2];\nEND_VAR\n\n"
	"VAR RETAIN\n  Hours : UDINT;\nEND_VAR\n\n"
	"PROGRAM Main LD\nVAR\n  Delay : TON;\n  Fan   : Seal;\n  \xe7\x81\xaf : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO Start | COIL Motor |\n  | NO Motor ^|\n"
	"RUNG\n  | NO Motor | TON Delay PT:=T#1s | COIL \xe7\x81\xaf |\nEND_PROGRAM\n\n"
	"FUNCTION_BLOCK Seal LD\nVAR_INPUT\n  On : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO On | COIL %MX0.0 |\n  |      ^| COIL Q7     |\nEND_FUNCTION_BLOCK\n";

/* By scope ("": the globals) and name, in any case. */
static const struct symbol_row *find_symbol(const struct symbols *symbols, const char *scope,
					    const char *name)
{
	for (int i = 0; i < symbols->count; i++) {
		const struct symbol_row *symbol = &symbols->symbol[i];

		if (g_ascii_strcasecmp(symbol->scope, scope) == 0 &&
		    g_ascii_strcasecmp(symbol->text[FIELD_NAME], name) == 0)
			return symbol;
	}
	return NULL;
}

/* Tree, table and paper list the declarations, without the result and ENO. */
static void test_function(void)
{
	LadderDocument *document = opened("RUNGBOARD 1\n\nVAR\n  Start : BOOL;\nEND_VAR\n\n"
		"FUNCTION Sum : INT LD\nVAR_INPUT\n  A : INT;\n  T : ARRAY[1..4] OF INT;\n"
		"END_VAR\nRUNG\n  | [ Sum := A + T[1] ] |\nEND_FUNCTION\n\n"
		"FUNCTION Two : INT LD\nRUNG\n  | [ Two := 2 ] |\nEND_FUNCTION\n");
	const struct project *project = ladder_document_project(document);
	struct symbols *symbols = symbols_new(document);
	char *type;

	CHECK(symbols->count == 3 && listing_symbol_count(project) == 3);
	CHECK(listing_first(&project->globals) == 0 && listing_count(&project->globals) == 1);
	CHECK(listing_first(&project->pou[0].vars) == 2);
	CHECK(listing_count(&project->pou[0].vars) == 2);
	CHECK(listing_count(&project->pou[1].vars) == 0);
	type = listing_type(project, &project->pou[0].vars.var[3]);
	CHECK_TEXT(type, "ARRAY[1..4] OF INT");
	g_free(type);
	symbols_free(symbols);
	g_object_unref(document);
}

static void test_rows(void)
{
	LadderDocument *document = opened(sample);
	struct symbols *symbols = symbols_new(document);
	const struct symbol_row *symbol = find_symbol(symbols, "", "motor");

	CHECK(symbols->count == 10);
	CHECK(symbol && symbol->uses == 3 && !symbol->included && !symbol->member);
	CHECK_TEXT(symbol->text[FIELD_ADDRESS], "%QX0.0");
	CHECK_TEXT(symbol->text[FIELD_TYPE], "BOOL");
	CHECK_TEXT(find_symbol(symbols, "", "Start")->text[FIELD_COMMENT], "green");
	CHECK_TEXT(find_symbol(symbols, "", "Count")->text[FIELD_COMMENT], "of parts");
	CHECK_TEXT(find_symbol(symbols, "", "Table")->text[FIELD_INITIAL], "[1, 2]");
	CHECK_TEXT(find_symbol(symbols, "", "Table")->text[FIELD_TYPE],
		   "ARRAY[1..3] OF INT");
	CHECK_TEXT(find_symbol(symbols, "", "Hours")->text[FIELD_RETAIN], "1");
	CHECK_TEXT(find_symbol(symbols, "main", "Fan")->text[FIELD_TYPE], "Seal");
	CHECK(find_symbol(symbols, "Recipe", "Speed")->member);
	CHECK(find_symbol(symbols, "Seal", "On")->flags == VAR_INPUT);
	CHECK(!find_symbol(symbols, "", "Delay"));
	symbols_free(symbols);
	g_object_unref(document);
}

static bool set(LadderDocument *document, const char *scope, const char *name,
		enum field field, const char *text)
{
	struct symbols *symbols = symbols_new(document);
	const struct symbol_row *symbol = find_symbol(symbols, scope, name);
	char *why = NULL;
	bool good = symbol && symbol_set(document, symbol->table, symbol->index, field,
					 text, &why);

	if (!good)
		printf("# %s: %s\n", name, why ? why : "no reason");
	CHECK_AS(good || (why && *why), "an edit succeeds or has a reason");
	g_free(why);
	symbols_free(symbols);
	return good;
}

/* Addresses of single bits, words over them and arrays, also in programs. */
static void test_beside(void)
{
	LadderDocument *document = opened("RUNGBOARD 1\n\nVAR\n"
		"  A AT %MX4.3 : BOOL;\n  B AT %MX5.0 : BOOL;\n"
		"  T AT %MW8 : ARRAY[0..3] OF INT;\n  N : INT;\nEND_VAR\n\n"
		"PROGRAM Main LD\nVAR\n  W AT %MW4 : INT;\n  L AT %MB15 : BYTE;\n"
		"  M AT %MB16 : BYTE;\n  Q AT %QB15 : BYTE;\nEND_VAR\n"
		"RUNG\n  | NO A | COIL B |\nEND_PROGRAM\n");

	CHECK_TEXT(symbol_beside(document, 0, 0), "W");
	CHECK_TEXT(symbol_beside(document, 0, 1), "W");
	CHECK_TEXT(symbol_beside(document, 0, 2), "L");
	CHECK_TEXT(symbol_beside(document, 1, 0), "A");
	CHECK_TEXT(symbol_beside(document, 1, 1), "T");
	CHECK_AS(!symbol_beside(document, 1, 2), "the address after the array is free");
	CHECK_AS(!symbol_beside(document, 1, 3),
		 "the same address of another area is free");
	CHECK_AS(!symbol_beside(document, 0, 3), "a symbol without an address shares none");
	CHECK(!symbol_beside(document, 0, 9) && !symbol_beside(document, 9, 0));
	g_object_unref(document);
}

static void test_fields(void)
{
	LadderDocument *document = opened(sample);
	char *before = ladder_document_text(document, NULL), *after;

	CHECK(set(document, "", "Count", FIELD_TYPE, "DINT"));
	CHECK(document_has(document, "  Count : DINT := 7; (* of parts *)\n"));
	CHECK_TEXT(ladder_document_undo_name(document), "Change type");
	CHECK(set(document, "", "Count", FIELD_INITIAL, ""));
	CHECK(set(document, "", "Count", FIELD_ADDRESS, "%MD4"));
	CHECK(document_has(document, "  Count AT %MD4   : DINT;"));
	CHECK_AS(!set(document, "", "Start", FIELD_COMMENT, "a *) b") &&
		 !set(document, "", "Start", FIELD_COMMENT, "a (* b"),
		 "a comment with (* or *) is refused");
	CHECK(set(document, "", "Start", FIELD_COMMENT, "a\nd"));
	CHECK(document_has(document, "(* a d *)\n"));
	CHECK(set(document, "", "Count", FIELD_RETAIN, "1"));
	CHECK(document_has(document, "VAR RETAIN\n  Hours : UDINT;\n  Count AT %MD4 : DINT;"));
	CHECK(set(document, "", "Count", FIELD_RETAIN, ""));
	CHECK(set(document, "", "Hours", FIELD_RETAIN, ""));
	CHECK_AS(!document_has(document, "RETAIN"),
		 "the last RETAIN symbol of a block removes RETAIN");
	CHECK(set(document, "", "Hours", FIELD_INITIAL, "3"));
	CHECK(set(document, "", "Hours", FIELD_CONSTANT, "1"));
	CHECK(document_has(document, "VAR CONSTANT\n  Hours : UDINT := 3;\nEND_VAR\n"));
	CHECK(set(document, "Recipe", "Speed", FIELD_INITIAL, "9"));
	CHECK(document_has(document, "    Speed : INT := 9; (* rpm *)\n"));
	CHECK(set(document, "Main", "Delay", FIELD_TYPE, "TOF"));
	CHECK(set(document, "Main", "\xe7\x81\xaf", FIELD_RETAIN, "1"));
	CHECK(document_has(document, "END_VAR\nVAR RETAIN\n  \xe7\x81\xaf : BOOL;\nEND_VAR\nRUNG"));
	after = ladder_document_text(document, NULL);
	while (ladder_document_undo(document))
		;
	CHECK_AS(document_has(document, before), "undo restores the text");
	while (ladder_document_redo(document))
		;
	CHECK(document_has(document, after));
	g_free(before);
	g_free(after);
	g_object_unref(document);
}

static void test_names(void)
{
	LadderDocument *document = opened(sample);

	CHECK(set(document, "", "Motor", FIELD_NAME, "\xe7\x94\xb5\xe6\x9c\xba"));
	CHECK(document_has(document, "COIL \xe7\x94\xb5\xe6\x9c\xba |"));
	CHECK_TEXT(ladder_document_undo_name(document), "Rename symbol");
	CHECK(ladder_document_undo(document));
	CHECK(set(document, "", "Hours", FIELD_NAME, "Minutes"));
	CHECK(document_has(document, "  Minutes : UDINT;"));
	CHECK(set(document, "Seal", "On", FIELD_NAME, "Go") && document_has(document, "| NO Go |"));
	CHECK(!set(document, "", "Minutes", FIELD_NAME, "Motor"));
	CHECK(!set(document, "", "Minutes", FIELD_NAME, "main"));
	CHECK(!set(document, "", "Minutes", FIELD_NAME, "VAR"));
	CHECK(!set(document, "", "Minutes", FIELD_NAME, ""));
	CHECK(!set(document, "", "Motor", FIELD_NAME, "Delay"));
	CHECK(set(document, "", "Minutes", FIELD_NAME, "M1"));
	CHECK_AS(!set(document, "", "M1", FIELD_NAME, "q7"), "a name that cells use as an address is refused");
	g_object_unref(document);
}

/* None of these may get into the file; each is refused with a reason. */
static void test_hostile(void)
{
	static const char *const bad[] = {
		"", "INT; END_VAR VAR X : INT", "INT := 5", "INT; (*", "INT (* x", "NOTYPE",
		"INT\nEND_VAR", "ARRAY[1..", "INT; Y : INT", "\xff", "INT //", "STRING[999]",
	};
	static const char *const initials[] = {
		"x", "5; Y : INT", "5; (*", "99999999999", "'a", "[1,2]", "5\nEND_VAR", "(",
	};
	LadderDocument *document = opened(sample);
	char *before = ladder_document_text(document, NULL);

	for (gsize i = 0; i < G_N_ELEMENTS(bad); i++)
		CHECK_AS(!set(document, "", "Count", FIELD_TYPE, bad[i]), bad[i][0] ?
			 "a bad type is refused" : "an empty type is refused");
	for (gsize i = 0; i < G_N_ELEMENTS(initials); i++)
		CHECK_AS(!set(document, "", "Count", FIELD_INITIAL, initials[i]),
			 initials[i]);
	CHECK(!set(document, "", "Count", FIELD_ADDRESS, "%ZZ9"));
	CHECK(!set(document, "", "Count", FIELD_ADDRESS, "%MW2 : INT; Y AT %MW4"));
	CHECK(!set(document, "Recipe", "Speed", FIELD_ADDRESS, "%MW2"));
	CHECK_AS(document_has(document, before) && !ladder_document_undo_name(document),
		 "a refused type, value or address changes nothing");
	g_free(before);
	g_object_unref(document);
}

static void test_add(void)
{
	static const char *const lamp[SYMBOL_FIELDS] = { "Lamp", "BOOL", "%QX0.1", "", "", "",
							 "red" };
	static const char *const free_lamp[SYMBOL_FIELDS] = { "Lamp", "BOOL", "", "", "", "", "" };
	static const char *const keep[SYMBOL_FIELDS] = { "Keep", "INT", "", "5", "1", "", "" };
	static const char *const again[SYMBOL_FIELDS] = { "lamp", "INT", "", "", "", "", "" };
	LadderDocument *document = opened(sample);
	char *before = ladder_document_text(document, NULL), *why = NULL, *name;
	struct symbols *symbols;
	const struct symbol_row *symbol;

	CHECK(symbol_add(document, 0, 0, lamp, NULL));
	CHECK(document_has(document, "  Lamp  AT %QX0.1 : BOOL; (* red *)\nEND_VAR\n\nVAR RETAIN"));
	CHECK(symbol_add(document, 0, 0, keep, NULL));
	CHECK(document_has(document, "VAR RETAIN\n  Hours : UDINT;\n  Keep  : INT := 5;"));
	CHECK(symbol_add(document, 1, 0, keep, NULL));
	CHECK(!symbol_add(document, 2, VAR_OUTPUT, lamp, NULL));
	CHECK(symbol_add(document, 2, VAR_OUTPUT, free_lamp, NULL));
	CHECK(document_has(document, "END_VAR\nVAR_OUTPUT\n  Lamp : BOOL"));
	CHECK(symbol_add(document, 3, 0, again, NULL));
	CHECK(document_has(document, "    lamp  : INT;\n  END_STRUCT"));
	CHECK(!symbol_add(document, 0, 0, again, &why) && why);
	g_free(why);
	name = symbol_free_name(document, 0, "Lamp");
	CHECK_TEXT(name, "Lamp2");
	g_free(name);
	symbols = symbols_new(document);
	symbol = find_symbol(symbols, "", "Hours");
	CHECK(symbol_delete(document, 0, symbol->index, NULL));
	CHECK(!strstr(ladder_document_undo_name(document), "Add"));
	symbols_free(symbols);
	while (ladder_document_undo(document))
		;
	CHECK(document_has(document, before));
	g_free(before);
	g_object_unref(document);

	document = opened("RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO I0 | COIL Q0 |\n"
			  "END_PROGRAM\n");
	CHECK(symbol_add(document, 0, 0, lamp, NULL) && symbol_add(document, 1, 0, keep, NULL));
	CHECK(document_has(document, "RUNGBOARD 1\n\nVAR\n  Lamp AT %QX0.1 : BOOL; (* red *)\nEND_VAR\n\n"
		  "PROGRAM Main LD\nVAR RETAIN\n  Keep : INT := 5;\nEND_VAR\nRUNG\n"));
	CHECK(symbol_delete(document, 0, 0, NULL) && symbol_delete(document, 1, 0, NULL));
	CHECK(document_has(document, "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n"));
	CHECK(!symbol_delete(document, 0, 0, NULL) && !symbol_delete(document, 9, 9, NULL));
	g_object_unref(document);
}

static void test_errors(void)
{
	LadderDocument *document = opened(sample);
	struct symbols *symbols = symbols_new(document);
	bool warning = true;
	char *text;

	CHECK(set(document, "", "Count", FIELD_ADDRESS, "%MX0.3"));
	ladder_document_check_now(document);
	text = symbol_error(document, find_symbol(symbols, "", "Count"), &warning);
	CHECK_AS(text && *text && !warning, "an address of another width is an error of its row");
	g_free(text);
	CHECK(!symbol_error(document, find_symbol(symbols, "", "Motor"), &warning));
	text = symbol_error(document, find_symbol(symbols, "", "Hours"), &warning);
	CHECK_AS(text && warning, "an unused symbol is a warning of its row");
	g_free(text);
	symbols_free(symbols);
	g_object_unref(document);
}

/* ---- tables ---- */

static bool take_row(void *context, int line, char *const *field, int count)
{
	g_string_append_printf(context, "%d", line);
	for (int i = 0; i < count; i++)
		g_string_append_printf(context, "[%s]", field[i]);
	return true;
}

static char *read_all(const char *text, gsize len)
{
	GString *out = g_string_new("");
	const char *why;
	int line = csv_read(text, len, take_row, out, &why);

	if (line)
		g_string_append_printf(out, "line %d: %s", line, why);
	return g_string_free(out, FALSE);
}

static void reads(const char *text, const char *want)
{
	char *got = read_all(text, strlen(text));

	CHECK_TEXT(got, want);
	g_free(got);
}

static void test_csv(void)
{
	char *big = g_strnfill(CSV_FIELD_MOST + 2, 'x'), *got;

	reads("a,b\r\n1,2\r\n", "1[a][b]2[1][2]");
	reads("\xef\xbb\xbf" "a;b\n\n\"x\"\"y;\n\";\n", "1[a][b]3[x\"y;\n][]");
	reads("a\tb\rc\t\"d\"", "1[a][b]2[c][d]");
	reads("", "");
	reads("a,\"b", "line 1: a quoted field does not end");
	reads("a\n\"b\n1\n2\n", "1[a]line 2: a quoted field does not end");
	reads("a\n\"b\r1\r\n2\",c\nd\n", "1[a]2[b\r1\r\n2][c]5[d]");
	reads("a\n\"b\"c\n", "1[a]line 2: text after a quoted field");
	reads("a\n\xff", "line 2: this is not UTF-8 text");
	reads(big, "line 1: a field is too long");
	got = read_all("a\0b", 3);
	CHECK_TEXT(got, "line 1: this is not UTF-8 text");
	g_free(got);
	for (int i = 0; i < CSV_FIELD_MOST + 1; i++)
		big[i] = ',';
	reads(big, "line 1: too many columns");
	g_free(big);
}

static void test_export(void)
{
	LadderDocument *document = opened(sample);
	int count;
	char *table = csv_export(document, &count), *again;
	struct csv_plan *plan = csv_plan_new(document, table, strlen(table));

	CHECK(g_str_has_prefix(table, "Scope,Block,Name,Type,Address,Initial value,Retain,"
		"Constant,Comment\r\nRecipe") ||
	      strstr(table, "\r\n,VAR,Start,BOOL,%IX0.0,,,,green\r\n"));
	CHECK(strstr(table, ",VAR,Table,ARRAY[1..3] OF INT,,\"[1, 2]\",,,\r\n"));
	CHECK(strstr(table, "Seal,VAR_INPUT,On,BOOL,,,,,\r\n"));
	CHECK(strstr(table, "Recipe,STRUCT,Speed,INT,,5,,,rpm\r\n"));
	CHECK(count == 10);
	CHECK_AS(plan->counts[CSV_SAME] == 10 && plan->entry->len == 10,
		 "an exported table changes nothing when it is imported");
	CHECK(csv_plan_apply(plan, NULL) && !ladder_document_undo_name(document));
	csv_plan_free(plan);
	again = csv_export(document, &count);
	CHECK_TEXT(again, table);
	g_free(again);
	g_free(table);
	g_object_unref(document);
}

static void test_import(void)
{
	static const char table[] =
		"Name;Scope;Type;Retain;Address;Comment;Other\r\n"
		"start;;BOOL;no;%IX0.7;green;1\r\n"
		"Lamp;;BOOL;;%QX1.0;\"big; red\"\r\n"
		"Hours;;UDINT;0;;\r\n"
		"Delay;main;TON;;;waits\r\n"
		"\xe9\x98\x80;Main;BOOL;1;;\r\n"
		"Motor;;BOOL;;%QX0.0;\r\n"
		"Motor;;BOOL;;%QX0.1;\r\n"
		"X;Nowhere;INT;;;\r\n"
		"9x;;INT;;;\r\n"
		"Y;;\"INT; END_VAR\";;;\r\n";
	LadderDocument *document = opened(sample);
	struct csv_plan *plan = csv_plan_new(document, table, strlen(table));
	char *before = ladder_document_text(document, NULL), *why = NULL;
	static const struct { enum csv_action action; int line; } want[] = {
		{ CSV_CHANGE, 2 }, { CSV_ADD, 3 }, { CSV_CHANGE, 4 }, { CSV_CHANGE, 5 },
		{ CSV_ADD, 6 }, { CSV_SAME, 7 }, { CSV_REFUSE, 8 }, { CSV_REFUSE, 9 },
		{ CSV_REFUSE, 10 }, { CSV_REFUSE, 11 },
	};

	CHECK(plan->entry->len == 10);
	for (guint i = 0; i < plan->entry->len; i++) {
		const struct csv_entry *entry = plan->entry->pdata[i];

		printf("# %d %s: %s\n", entry->line, entry->name, entry->text);
		CHECK(entry->action == want[i].action && entry->line == want[i].line);
	}
	CHECK_TEXT(((struct csv_entry *)plan->entry->pdata[0])->text,
		   "Address: %IX0.0 \xe2\x86\x92 %IX0.7");
	CHECK_AS(document_has(document, before), "a plan changes nothing");
	CHECK(csv_plan_apply(plan, NULL));
	CHECK(document_has(document, "  Start AT %IX0.7 : BOOL; (* green *)\n"));
	CHECK(document_has(document, "  Lamp  AT %QX1.0 : BOOL; (* big; red *)\n"));
	CHECK(document_has(document, "VAR\n  Hours : UDINT;\nEND_VAR\n"));
	CHECK(document_has(document, "VAR RETAIN\n  \xe9\x98\x80 : BOOL;\nEND_VAR\n"));
	CHECK_TEXT(ladder_document_undo_name(document), "Import symbols");
	CHECK(!csv_plan_apply(plan, &why) && why);
	g_free(why);
	csv_plan_free(plan);
	CHECK(ladder_document_undo(document) && document_has(document, before));
	CHECK(!ladder_document_undo_name(document));
	plan = csv_plan_new(document, "Type,Address\nINT,%MW0\n", 22);
	CHECK(plan->counts[CSV_REFUSE] == 1 && plan->entry->len == 1);
	csv_plan_free(plan);
	plan = csv_plan_new(document, "", 0);
	CHECK(plan->counts[CSV_REFUSE] == 1);
	csv_plan_free(plan);
	g_free(before);
	g_object_unref(document);
}

struct wanted { enum csv_action action; const char *text, *fault; };

/* @want: of each line behind the header; parts of the messages, NULL: none. */
static struct csv_plan *planned(LadderDocument *document, const char *table,
				const struct wanted *want, guint count)
{
	struct csv_plan *plan = csv_plan_new(document, table, strlen(table));

	CHECK(plan->entry->len == count);
	for (guint i = 0; i < MIN(count, plan->entry->len); i++) {
		const struct csv_entry *entry = plan->entry->pdata[i];

		printf("# %d %s: %s, %s\n", entry->line, entry->name, entry->text,
		       entry->fault ? entry->fault : "-");
		CHECK(entry->action == want[i].action && entry->line == (int)i + 2);
		CHECK(strstr(entry->text, want[i].text));
		CHECK(want[i].fault ? entry->fault && strstr(entry->fault, want[i].fault) :
		      !entry->fault);
	}
	return plan;
}

/* A declaration that its place does not allow is reported at its line; the others are
 * imported. */
static void test_places(void)
{
	static const char table[] =
		"Scope,Block,Name,Type,Address,Retain,Comment\n"
		",VAR_TEMP,A,BOOL,,,\n" ",VAR_INPUT,B,BOOL,,,\n" "Main,VAR_INPUT,C,BOOL,,,\n"
		"Main,VAR_TEMP,D,BOOL,,,\n" "Seal,VAR_OUTPUT,E,BOOL,,,\n"
		"Seal,VAR_IN_OUT,F,BOOL,,1,\n" "Recipe,VAR_INPUT,G,INT,,,\n"
		"Recipe,STRUCT,H,Nowhere,,,\n" "Recipe,,Weight,INT,,,\n" "Seal,VAR_INPUT,I,Nowhere,,,\n"
		",,Text,STRING,%MW4,,\n" "Seal,VAR,On,BOOL,,,\n"
		"Main,,Delay,TON,,,\n" ",,Noted,INT,,,\"a (* b *) c\r\nd\"\n";
	static const struct wanted want[] = {
		{ CSV_REFUSE, "VAR_TEMP", NULL }, { CSV_REFUSE, "VAR_INPUT", NULL },
		{ CSV_REFUSE, "VAR_INPUT", NULL }, { CSV_ADD, "Type: BOOL", NULL },
		{ CSV_ADD, "BOOL", NULL }, { CSV_REFUSE, "RETAIN", NULL },
		{ CSV_REFUSE, "VAR_INPUT", NULL }, { CSV_REFUSE, "", NULL },
		{ CSV_ADD, "INT", NULL }, { CSV_REFUSE, "", NULL }, { CSV_REFUSE, "AT", NULL },
		{ CSV_CHANGE, "Block: VAR_INPUT \xe2\x86\x92 VAR", NULL }, { CSV_SAME, "", NULL },
		{ CSV_ADD, "Comment: a ( * b * ) c d", NULL },
	};
	LadderDocument *document = opened(sample);
	struct csv_plan *plan = planned(document, table, want, G_N_ELEMENTS(want));
	int count;
	char *again;

	CHECK(csv_plan_apply(plan, NULL));
	csv_plan_free(plan);
	CHECK(document_has(document, "VAR_TEMP\n  D : BOOL;\nEND_VAR\n"));
	CHECK(document_has(document, "VAR\n  On : BOOL;\nEND_VAR\n"));
	CHECK(document_has(document, "VAR_OUTPUT\n  E : BOOL;\nEND_VAR\n"));
	CHECK(document_has(document, "    Weight : INT;\n"));
	again = csv_export(document, &count);
	CHECK_AS(strstr(again, ",VAR,Noted,INT,,,,,a ( * b * ) c d\r\n"),
		 "the imported comment is that of the plan");
	g_free(again);
	g_object_unref(document);
}

/* Errors that the import would cause are reported before it. */
static void test_faults(void)
{
	static const char table[] = "Scope,Name,Type,Address\n"
		",Count,INT,%QX0.5\n" ",Stop,BOOL,%IX0.0\n" ",Hours,UDINT,%MD8\n"
		"Main,Wide,WORD,%QW0\n" ",Free,BOOL,%IX0.1\n";
	static const struct wanted want[] = {
		{ CSV_CHANGE, "%QX0.5", "its type does not fit the width of its address" },
		{ CSV_ADD, "%IX0.0", "also used as Start" }, { CSV_CHANGE, "%MD8", NULL },
		{ CSV_ADD, "%QW0", "also used as" }, { CSV_ADD, "%IX0.1", NULL },
	};
	LadderDocument *document = opened(sample);
	struct csv_plan *plan = planned(document, table, want, G_N_ELEMENTS(want));

	CHECK(plan->faults == 3);
	CHECK(!((struct csv_entry *)plan->entry->pdata[0])->warning);
	CHECK(((struct csv_entry *)plan->entry->pdata[1])->warning);
	CHECK_AS(csv_plan_apply(plan, NULL) && document_has(document, "Stop  AT %IX0.0 : BOOL"),
		 "a table with warnings can be imported");
	csv_plan_free(plan);
	g_object_unref(document);
}

/* An error in the use of a changed declaration is reported at its line; errors from before
 * are not. */
static void test_uses(void)
{
	static const char program[] = "RUNGBOARD 1\n\n"
		"TYPE\n  Recipe : STRUCT\n    Full : BOOL;\n  END_STRUCT;\nEND_TYPE\n\n"
		"VAR\n  Lamp AT %QX0.0 : BOOL;\n  Horn : BOOL;\n  R : Recipe;\n  N : INT;\n"
		"  Old : INT;\n  Bell : BOOL;\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | NO Bell | COIL Old |\nRUNG\n  | NO R.Full | COIL Lamp |\n"
		"RUNG\n  | [ N := N + 1 ] |\nEND_PROGRAM\n\n"
		"PROGRAM List IL\n  LD Bell\n  ST Old\n  LD R.Full\n  ST Horn\nEND_PROGRAM\n";
	static const char table[] = "Scope,Name,Type,Address\n"
		",Lamp,INT,\n" ",Horn,TIME,\n" "Recipe,Full,INT,\n" ",N,BOOL,\n"
		",Bell,BOOL,%QX1.0\n" "Main,Bell,INT,\n" ",New,INT,\n";
	static const struct wanted want[] = {
		{ CSV_CHANGE, "%QX0.0", "\"Lamp\" must be BOOL" },
		{ CSV_CHANGE, "TIME", "" },
		{ CSV_CHANGE, "INT", "must be BOOL" }, { CSV_CHANGE, "BOOL", "" },
		{ CSV_CHANGE, "%QX1.0", NULL }, { CSV_ADD, "INT", "\"Bell\" must be BOOL" },
		{ CSV_ADD, "INT", NULL },
	};
	LadderDocument *document = opened(program);
	struct csv_plan *plan = planned(document, table, want, G_N_ELEMENTS(want));

	CHECK(!((struct csv_entry *)plan->entry->pdata[0])->warning);
	csv_plan_free(plan);
	g_object_unref(document);
}

/* More symbols than a project can have: no line causes the error, so none is imported. */
static void test_too_many(void)
{
	LadderDocument *document = opened(sample);
	GString *table = g_string_new("Name,Type\n");
	struct csv_plan *plan;

	for (int i = 0; i < LIMIT_VARS; i++)
		g_string_append_printf(table, "New%d,BOOL\n", i);
	plan = csv_plan_new(document, table->str, table->len);
	CHECK(plan->counts[CSV_REFUSE] == LIMIT_VARS && plan->counts[CSV_ADD] == 0);
	printf("# %s\n", ((struct csv_entry *)plan->entry->pdata[0])->text);
	CHECK(strstr(((struct csv_entry *)plan->entry->pdata[0])->text, "too many"));
	csv_plan_free(plan);
	g_string_free(table, TRUE);
	g_object_unref(document);
}

/* Any bytes give a plan, and applying it gives a program that can be read. */
static void test_storm(void)
{
	static const char piece[][12] = { "Name,Type\n", "\"", ",", "\n", "\r\n", "Start", "INT",
		"(*", "*)", ";", ":=", "\xe5", "x", "%QX0.0", "END_VAR", "VAR", "\t", "=1+1" };
	LadderDocument *document = opened(sample);
	guint32 seed = 7;
	int bad = 0;

	for (int round = 0; round < 400; round++) {
		GString *text = g_string_new(round % 2 ? "Name,Type,Comment\n" : "");
		struct csv_plan *plan;

		for (int i = 0; i < 30; i++) {
			seed = seed * 1664525u + 1013904223u;
			g_string_append(text, piece[(seed >> 8) % G_N_ELEMENTS(piece)]);
		}
		plan = csv_plan_new(document, text->str, text->len);
		bad += !csv_plan_apply(plan, NULL);
		csv_plan_free(plan);
		g_string_free(text, TRUE);
		bad += !ladder_document_project(document) ||
		       ladder_document_project(document)->pou_count != 2;
	}
	CHECK_AS(bad == 0, "400 random tables");
	g_object_unref(document);
}

/* A time needs no T# here, as in an entry. */
static void test_time(void)
{
	LadderDocument *document = opened(sample);

	CHECK(set(document, "", "Count", FIELD_INITIAL, ""));
	CHECK(set(document, "", "Count", FIELD_TYPE, "TIME"));
	CHECK(set(document, "", "Count", FIELD_INITIAL, "1m30s"));
	CHECK(document_has(document, "Count : TIME := T#1m30s;"));
	CHECK(!set(document, "", "Hours", FIELD_INITIAL, "5s"));
	g_object_unref(document);
}

/* Expressions of constants in types and initial values are shown, taken and refused. */
static void test_expressions(void)
{
	LadderDocument *document = opened("RUNGBOARD 1\n\nVAR CONSTANT\n  Limit : INT := 5 * 2;\n"
		"END_VAR\n\nVAR\n  Max   : INT := Limit - 1;\n  Table : ARRAY[0..Limit] OF INT;\n"
		"  Text  : STRING[Limit + 2];\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n"
		"  | [ Table[1] := Max ] | [ Text <> '' ] | COIL %QX0.0 |\nEND_PROGRAM\n");
	struct symbols *symbols = symbols_new(document);
	char *why = NULL;

	CHECK_TEXT(find_symbol(symbols, "", "Max")->text[FIELD_INITIAL], "Limit - 1");
	CHECK_TEXT(find_symbol(symbols, "", "Table")->text[FIELD_TYPE], "ARRAY[0..Limit] OF INT");
	CHECK_TEXT(find_symbol(symbols, "", "Text")->text[FIELD_TYPE], "STRING[Limit + 2]");
	CHECK_AS(find_symbol(symbols, "", "Limit")->uses == 3, "its uses are counted");
	symbols_free(symbols);
	CHECK(set(document, "", "Max", FIELD_INITIAL, "(Limit + 2) * 3"));
	CHECK(document_has(document, "Max   : INT := (Limit + 2) * 3;"));
	CHECK(set(document, "", "Table", FIELD_TYPE, "ARRAY[1..Limit * 2] OF INT"));
	CHECK(!set(document, "", "Max", FIELD_INITIAL, "Limit / 0"));
	CHECK(!set(document, "", "Max", FIELD_INITIAL, "Lmit"));
	CHECK(!set(document, "", "Limit", FIELD_INITIAL, "Limit + 1"));
	CHECK(!symbol_set(document, 0, 1, FIELD_INITIAL, "Limit / 0", &why));
	CHECK_AS(why && strstr(why, "divides by 0"), "the reason is told");
	g_free(why);
	CHECK(set(document, "", "Limit", FIELD_NAME, "Most"));
	CHECK_AS(document_has(document, "Max   : INT := (Most + 2) * 3;") &&
		 document_has(document, "ARRAY[1..Most * 2] OF INT") && document_has(document, "STRING[Most + 2]"),
		 "a renamed constant is renamed in declarations");
	g_object_unref(document);
}

/* ---- access for operators ---- */

static bool give(LadderDocument *document, const char *scope, const char *name,
		 enum symbol_access access)
{
	struct symbols *symbols = symbols_new(document);
	const struct symbol_row *symbol = find_symbol(symbols, scope, name);
	char *why = NULL;
	bool good = symbol && symbol_set_access(document, symbol->table, symbol->index, access,
						&why);

	CHECK_AS(good || (why && *why), "access is given, or there is a reason");
	g_free(why);
	symbols_free(symbols);
	return good;
}

static enum symbol_access given(LadderDocument *document, const char *scope, const char *name)
{
	struct symbols *symbols = symbols_new(document);
	const struct symbol_row *symbol = find_symbol(symbols, scope, name);
	const enum symbol_access access = symbol ? symbol->access : SYMBOL_KEPT;

	symbols_free(symbols);
	return access;
}

static void test_access(void)
{
	LadderDocument *document = opened(sample);
	char *after;

	CHECK(given(document, "", "Count") == SYMBOL_KEPT);
	CHECK(give(document, "", "Count", SYMBOL_WRITE));
	CHECK(document_has(document, "VAR_ACCESS\n  Count : Count : INT READ_WRITE;\nEND_VAR\n\nPROGRAM"));
	CHECK(given(document, "", "Count") == SYMBOL_WRITE);
	CHECK(give(document, "", "Table", SYMBOL_READ));
	CHECK(give(document, "Main", "\xe7\x81\xaf", SYMBOL_WRITE));
	CHECK_AS(document_has(document, "  Table : Table   : ARRAY[1..3] OF INT READ_ONLY;\n") &&
		 document_has(document, " : Main.\xe7\x81\xaf : BOOL READ_WRITE;\nEND_VAR"),
		 "a local is given behind the name of its program, in the same block");
	CHECK(give(document, "", "Count", SYMBOL_READ));
	CHECK(document_has(document, "  Count : Count   : INT READ_ONLY;\n"));
	CHECK_AS(!give(document, "Main", "Delay", SYMBOL_READ) &&
		 !give(document, "Recipe", "Speed", SYMBOL_READ) &&
		 !give(document, "Seal", "On", SYMBOL_READ),
		 "no instances, no members, nothing of blocks");
	CHECK(set(document, "", "Count", FIELD_NAME, "Parts"));
	CHECK_AS(document_has(document, "  Count : Parts   : INT READ_ONLY;\n") &&
		 given(document, "", "Parts") == SYMBOL_READ,
		 "a renamed symbol keeps its name for operators");
	CHECK(give(document, "", "Parts", SYMBOL_KEPT));
	CHECK(give(document, "", "Table", SYMBOL_KEPT));
	CHECK(give(document, "Main", "\xe7\x81\xaf", SYMBOL_KEPT));
	CHECK(set(document, "", "Parts", FIELD_NAME, "Count"));
	after = ladder_document_text(document, NULL);
	CHECK_AS(!strstr(after, "VAR_ACCESS"), "the last line goes with its block");
	g_free(after);
	g_object_unref(document);
}

static void deleted(LadderDocument *document, const char *scope, const char *name)
{
	struct symbols *symbols = symbols_new(document);
	const struct symbol_row *symbol = find_symbol(symbols, scope, name);
	char *why = NULL;

	CHECK_AS(symbol && symbol_delete(document, symbol->table, symbol->index, &why),
		 "the symbol is deleted");
	symbols_free(symbols);
	g_free(why);
}

/* A name that another variable has; a configuration; a symbol that is deleted. */
static void test_access_places(void)
{
	LadderDocument *document = opened("RUNGBOARD 1\n\nVAR CONSTANT\n  Most : INT := 4;\n"
		"END_VAR\n\nCONFIGURATION Plant\n  PROGRAM One : A;\nEND_CONFIGURATION\n\n"
		"PROGRAM A LD\nVAR\n  X : ARRAY[1..Most] OF INT;\nEND_VAR\nEND_PROGRAM\n\n"
		"PROGRAM B LD\nVAR\n  X : INT;\nEND_VAR\nEND_PROGRAM\n");

	CHECK(give(document, "A", "X", SYMBOL_WRITE) && give(document, "B", "X", SYMBOL_READ));
	CHECK(document_has(document, "  PROGRAM One : A;\nVAR_ACCESS\n"
			    "  A_X : A.X : ARRAY[1..4] OF INT READ_WRITE;\n"
			    "  B_X : B.X : INT READ_ONLY;\nEND_VAR\nEND_CONFIGURATION\n"));
	deleted(document, "A", "X");
	CHECK_AS(document_has(document, "VAR_ACCESS\n  B_X : B.X : INT READ_ONLY;\nEND_VAR"),
		 "the access goes with the symbol");
	g_object_unref(document);
}

/* Several names for one symbol, or for parts of it; another symbol has it as an index. */
static void test_access_deleted(void)
{
	LadderDocument *document = opened("RUNGBOARD 1\n\nVAR CONSTANT\n  Most : INT := 2;\n"
		"END_VAR\n\nVAR\n  A : ARRAY[1..4] OF INT;\n  B : ARRAY[1..4] OF INT;\nEND_VAR\n\n"
		"VAR_ACCESS\n  One : A : ARRAY[1..4] OF INT READ_WRITE;\n"
		"  Two : A : ARRAY[1..4] OF INT READ_ONLY;\n  Three : B[2] : INT READ_ONLY;\n"
		"  Four : A[3] : INT READ_ONLY;\n  Five : B[Most] : INT READ_ONLY;\nEND_VAR\n\n"
		"VAR_ACCESS\n  Six : A[1] : INT READ_ONLY;\nEND_VAR\n\nPROGRAM M LD\nEND_PROGRAM\n");

	deleted(document, "", "A");
	CHECK_AS(document_has(document, "END_VAR\n\nVAR_ACCESS\n  Three : B[2]    : INT READ_ONLY;\n"
			       "  Five  : B[Most] : INT READ_ONLY;\nEND_VAR\n\nPROGRAM"),
		 "every access to the symbol goes with it, and the block of the last one");
	deleted(document, "", "Most");
	CHECK_AS(document_has(document, "  Five  : B[Most] :"), "an access that has it as an index stays");
	g_object_unref(document);
}

/* What a person types in the column Access; NULL: it is refused. Caller frees. */
static char *typed(LadderDocument *document, const char *name, const char *text)
{
	struct symbols *symbols = symbols_new(document);
	const struct symbol_row *symbol = find_symbol(symbols, "", name);
	char *why = NULL, *shown = NULL;
	const bool good = symbol_set_access_text(document, symbol->table, symbol->index, text, &why);

	CHECK_AS(good == !why, "a refusal has a reason");
	symbols_free(symbols);
	symbols = symbols_new(document);
	symbol = find_symbol(symbols, "", name);
	if (good)
		shown = symbol_access_text(document, symbol, symbol->access);
	symbols_free(symbols);
	g_free(why);
	return shown;
}

static void test_access_names(void)
{
	static const struct { const char *text, *shown, *line; } typing[] = {
		{ "Pieces", "READ_ONLY: Pieces", "  Pieces : Count : INT READ_ONLY;\n" },
		{ "read_write: Parts", "READ_WRITE: Parts", "  Parts : Count : INT READ_WRITE;\n" },
		{ " Done ", "READ_WRITE: Done", "  Done : Count : INT READ_WRITE;\n" },
		{ "READ_ONLY:Done", "READ_ONLY: Done", "  Done : Count : INT READ_ONLY;\n" },
		{ "READ_ONLY", "READ_ONLY", "  Count : Count : INT READ_ONLY;\n" },
		{ "count", "READ_ONLY", "  count : Count : INT READ_ONLY;\n" },
	};
	static const char *const bad[] = {
		"Table", "Main", "READ_WRITE: two words", "READ: Done", "1st",
	};
	LadderDocument *document = opened(sample);
	char *shown;

	for (gsize i = 0; i < G_N_ELEMENTS(typing); i++) {
		shown = typed(document, "Count", typing[i].text);
		CHECK_TEXT(shown ? shown : "(refused)", typing[i].shown);
		CHECK_AS(document_has(document, typing[i].line), typing[i].line);
		g_free(shown);
	}
	for (gsize i = 0; i < G_N_ELEMENTS(bad); i++) {
		shown = typed(document, "Count", bad[i]);
		CHECK_AS(!shown && document_has(document, "  count : Count : INT READ_ONLY;\n"), bad[i]);
		g_free(shown);
	}
	shown = typed(document, "Count", "");
	CHECK_TEXT(shown, "");
	CHECK(!document_has(document, "VAR_ACCESS"));
	g_free(shown);
	g_object_unref(document);
}

int main(void)
{
	test_access();
	test_access_places();
	test_access_deleted();
	test_access_names();
	test_expressions();
	test_csv();
	test_export();
	test_import();
	test_places();
	test_faults();
	test_uses();
	test_too_many();
	test_storm();
	test_rows();
	test_function();
	test_beside();
	test_fields();
	test_time();
	test_names();
	test_hostile();
	test_add();
	test_errors();
	return tap_done();
}
