/* SPDX-License-Identifier: MIT
 *
 * test_properties - title, properties and comments become text that reads the same, with all
 * other bytes as they were, and one undo each.
 */
#include "editor-gtk/document/properties.h"

#include "tests/tap.h"

#include <string.h>

static const char BODY[] =
	"\nVAR\n  Lamp AT %QX0.0 : BOOL;\nEND_VAR\n\n"
	"(* above *)\n// and below\nPROGRAM Main LD\nVAR\n  D : TON; (* delay *)\nEND_VAR\n"
	"(* seal *)\nRUNG \"Title\"\n  | NO %IX0.0 | Seal2 S | TON D PT:=T#1s | COIL Lamp |\n"
	"END_PROGRAM\n\n"
	"FUNCTION_BLOCK Seal2 LD\nVAR_INPUT\n  On : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL;\n"
	"END_VAR\nRUNG\n  | NO On | COIL Q |\nEND_FUNCTION_BLOCK\n\n"
	"VIEW\n  bookmark Main 1\nEND_VIEW\n";
static const char HEAD[] = "RUNGBOARD 1\n(* what it is for *)\nPROJECT \"Old\"\n";

static LadderDocument *document;

static char *text_now(void)
{
	return ladder_document_text(document, NULL);
}

static void open_text(const char *head)
{
	GString *text = g_string_new(head);

	g_string_append(text, BODY);
	g_string_replace(text, "  D : TON;", "  S : Seal2;\n  D : TON;", 0);
	ladder_document_open_text(document, NULL, text->str, text->len, true);
	g_string_free(text, TRUE);
}

/* A random text of words, quotes, dollars, lines and other scripts. */
static char *random_text(GRand *chance, bool lines)
{
	static const char *const pieces[] = { "a", "Door", "\"", "$", "$N", " ", "(*", "*)", "//",
					      "泵", "é", "1.2", "'" };
	GString *text = g_string_new(NULL);

	for (int n = g_rand_int_range(chance, 0, 8); n > 0; n--) {
		g_string_append(text, pieces[g_rand_int_range(chance, 0, G_N_ELEMENTS(pieces))]);
		if (lines && g_rand_int_range(chance, 0, 5) == 0)
			g_string_append_c(text, '\n');
	}
	return g_strstrip(g_string_free(text, FALSE));
}

static bool is_set(const char *title, char *const *property)
{
	const struct project *project = ladder_document_project(document);
	bool same = project && strcmp(project_text(project, project->title), title) == 0;

	for (int i = 0; same && i < PROPERTY_COUNT; i++)
		same = strcmp(project_text(project, project->property[i]), property[i]) == 0;
	return same;
}

static bool read_again_is_same(void)
{
	char *text = text_now(), *again;
	LadderDocument *other = ladder_document_new();
	bool same;

	ladder_document_open_text(other, NULL, text, strlen(text), true);
	again = ladder_document_text(other, NULL);
	same = ladder_document_project(other) && strcmp(text, again) == 0;
	g_free(again);
	g_free(text);
	g_object_unref(other);
	return same;
}

static void test_project(const char *head)
{
	GRand *chance = g_rand_new_with_seed(11);
	bool good = true;
	char *first, *rest;

	open_text(head);
	first = text_now();
	rest = g_strdup(strstr(first, "\nVAR\n"));
	for (int round = 0; good && round < 100; round++) {
		char *title = random_text(chance, false), *property[PROPERTY_COUNT + 1] = { 0 };
		char *before = text_now(), *now, *why;

		for (int i = 0; i < PROPERTY_COUNT; i++)
			property[i] = random_text(chance, i == PROPERTY_DESCRIPTION);
		why = properties_set(document, title, (const char *const *)property);
		now = text_now();
		good = !why && is_set(title, property) && g_str_has_suffix(now, rest) &&
		       (!strstr(first, "what it is") || strstr(now, "(* what it is for *)")) &&
		       read_again_is_same();
		if (good && strcmp(before, now) != 0) {
			char *undone;

			good = ladder_document_undo(document);
			undone = text_now();
			good = good && strcmp(undone, before) == 0 &&
			       ladder_document_redo(document);
			g_free(undone);
		}
		if (!good)
			printf("# %s\n%s\n", why ? why : "", now);
		for (int i = 0; i < PROPERTY_COUNT; i++)
			g_free(property[i]);
		g_free(title);
		g_free(before);
		g_free(now);
		g_free(why);
	}
	CHECK_AS(good, "random properties are read again, and nothing else changes");
	while (ladder_document_undo(document))
		;
	g_free(rest);
	rest = text_now();
	CHECK_AS(strcmp(rest, first) == 0, "undo restores the first text");
	g_free(rest);
	g_free(first);
	g_rand_free(chance);
}

static void test_comments(void)
{
	GRand *chance = g_rand_new_with_seed(5);
	char *first, *shown, *why;
	bool good = true;

	open_text(HEAD);
	first = text_now();
	shown = pou_comment(document, 0);
	CHECK_TEXT(shown, "above\nand below");
	CHECK(!pou_set_comment(document, 0, shown) && !ladder_document_undo_name(document));
	g_free(shown);
	for (int round = 0; good && round < 100; round++) {
		const int pou = g_rand_int_range(chance, 0, 2);
		char *text = random_text(chance, true), *before = text_now(), *now, *undone;

		why = pou_set_comment(document, pou, text);
		shown = pou_comment(document, pou);
		now = text_now();
		/* a delimiter in a comment gets a blank behind it */
		good = !why && (strstr(text, "(*") || strstr(text, "*)") ||
				strcmp(shown, text) == 0 || strstr(text, "\n ") ||
				strstr(text, " \n")) && read_again_is_same();
		if (good && strcmp(before, now) != 0) {
			good = ladder_document_undo(document);
			undone = text_now();
			good = good && strcmp(undone, before) == 0 &&
			       ladder_document_redo(document);
			g_free(undone);
		}
		if (!good)
			printf("# %s\n%s\n", why ? why : text, now);
		g_free(why);
		g_free(shown);
		g_free(now);
		g_free(before);
		g_free(text);
	}
	CHECK_AS(good, "random comments are read again");
	CHECK(!pou_set_comment(document, 0, "") && !pou_set_comment(document, 1, ""));
	shown = text_now();
	CHECK_AS(strstr(shown, "END_VAR\n\nPROGRAM Main LD\n"),
		 "an empty comment is not written");
	g_free(shown);
	while (ladder_document_undo(document))
		;
	shown = text_now();
	CHECK_AS(strcmp(shown, first) == 0, "undo restores the first text");
	g_free(shown);
	g_free(first);
	g_rand_free(chance);
}

static bool says(int pou, enum pou_fact fact, const char *text)
{
	char *is = pou_fact(document, pou, fact);
	const bool same = g_strcmp0(is, text) == 0;

	if (!same)
		printf("# is: %s\n", is);
	g_free(is);
	return same;
}

static void test_facts(void)
{
	open_text(HEAD);
	ladder_document_check_now(document);
	CHECK(says(0, POU_FACT_KIND, "Program") && says(0, POU_FACT_LANGUAGE, "Ladder (LD)"));
	CHECK(says(0, POU_FACT_LENGTH, "1 rung") && says(0, POU_FACT_CALLED, NULL));
	CHECK(says(0, POU_FACT_RUNS, "in every scan, as number 1 of 1"));
	CHECK(says(1, POU_FACT_CALLED, "Main (2)") && says(1, POU_FACT_RUNS, NULL));
	CHECK(says(1, POU_FACT_SIZE, "3 instructions"));
}

int main(void)
{
	document = ladder_document_new();
	test_project(HEAD);
	test_project("RUNGBOARD 1\n");
	test_project("RUNGBOARD 1\nAUTHOR \"Me\"\n");
	test_comments();
	test_facts();
	g_object_unref(document);
	return tap_done();
}
