/* SPDX-License-Identifier: MIT
 *
 * test_manual - every page of the manual is shown whole, and every place that F1 or a link
 * names exists.
 */
#include "editor-gtk/document/manual.h"
#include "editor-gtk/kit/text_lower.h"
#include "editor-gtk/window/help.h"
#include "tests/tap.h"

#include "engine/base/catalog.h"

#include <string.h>

static struct manual *manual;

static bool has_place(int page, const char *anchor)
{
	return page >= 0 && (!*anchor || manual_anchor(manual, page, anchor) >= 0);
}

/* Of a link in page @from. Files outside the manual have no anchor. */
static bool is_good(int from, const char *link)
{
	char **parts = g_strsplit(link, "#", 2);
	const int page = *parts[0] ? manual_find(manual, parts[0]) : from;
	bool good = strstr(link, "://") != NULL;

	if (!good && g_str_has_suffix(parts[0], ".md"))
		good = has_place(page, parts[1] ? parts[1] : "");
	else if (!good && *parts[0])
		good = true; /* tests/docs.t knows whether it exists            */
	else if (!good)
		good = has_place(from, parts[1] ? parts[1] : "");
	g_strfreev(parts);
	return good;
}

static int wrong_links(int page, const GArray *runs)
{
	int wrong = 0;

	for (guint i = 0; runs && i < runs->len; i++) {
		const char *link = g_array_index(runs, struct md_run, i).link;

		if (link && !is_good(page, link)) {
			printf("# %s: %s\n", manual_name(manual, page), link);
			wrong++;
		}
	}
	return wrong;
}

static void check_page(int number)
{
	const struct md_page *page = manual_page(manual, number);
	int wrong = 0, empty = 0;

	printf("# %s\n", manual_name(manual, number));
	if (!CHECK(page != NULL))
		return;
	if (page->unknown)
		printf("# it has %s\n", page->unknown);
	CHECK_AS(!page->unknown, "each construct of the page is shown");
	CHECK(*page->title && page->blocks->len > 2);
	for (guint i = 0; i < page->blocks->len; i++) {
		const struct md_block *block = page->blocks->pdata[i];

		wrong += wrong_links(number, block->runs);
		for (guint k = 0; block->cells && k < block->cells->len; k++)
			wrong += wrong_links(number, block->cells->pdata[k]);
		if (block->cells)
			wrong += block->cells->len % (guint)block->columns != 0;
		if (block->kind == MD_PICTURE) {
			char *path = g_build_filename(manual_folder(manual), block->file, NULL);

			wrong += !g_file_test(path, G_FILE_TEST_EXISTS);
			g_free(path);
		}
		empty += block->kind == MD_TEXT && !block->runs->len;
	}
	CHECK_AS(wrong == 0, "the links, tables and pictures of the page are correct");
	CHECK_AS(empty == 0, "no paragraph is empty");
}

static void check_places(void)
{
	const struct help_place *place;

	for (int i = 0; (place = help_place(i)); i++) {
		const bool good = has_place(manual_find(manual, place->page), place->anchor);

		if (!good)
			printf("# %s: %s#%s\n", place->name, place->page, place->anchor);
		CHECK_AS(good, place->name);
	}
}

/* Each word of the catalogue that stands in rungs or lists has its entry. */
static void check_words(void)
{
	int none = 0;

	for (int i = 0; i < WORD_COUNT; i++) {
		const struct word_row *row = word_row((enum word)i);

		if ((row->kind == WORD_ELEM && row->place == PLACE_NONE) || !*row->word)
			continue;
		if (manual_word(manual, row->word) < 0) {
			printf("# %s\n", row->word);
			none++;
		}
	}
	CHECK(none == 0);
}

/* In some languages a letter becomes two in lower case; here a place must stay the same. */
static void check_lower(void)
{
	char *low = text_lower("\u0130ST \u00d6l");

	CHECK_TEXT(low, "ist \u00f6l");
	g_free(low);
}

static void check_search(void)
{
	GArray *hits = manual_search(manual, "Seal-In", 100);
	int page, block;

	CHECK(hits->len > 0);
	for (guint i = 0; i < hits->len; i++) {
		char *low = g_utf8_strdown(g_array_index(hits, struct manual_hit, i).line, -1);

		CHECK(strstr(low, "seal-in"));
		g_free(low);
	}
	g_array_unref(hits);
	CHECK(manual_code(manual, "LD336", &page, &block) &&
	      strcmp(manual_name(manual, page), "language.md") == 0);
	CHECK(!manual_code(manual, "LD999", &page, &block));
}

/* A page with a construct that is not shown is refused. */
static void check_refused(void)
{
	static const char *const wrong[] = { "> said\n", "a\n\n---\n\nb\n", "a &copy; b\n",
		"<b>bold</b> is only text, <!-- this too -->\n" };

	for (gsize i = 0; i < G_N_ELEMENTS(wrong); i++) {
		struct md_page *page = markdown_read(wrong[i], strlen(wrong[i]));

		CHECK((page->unknown != NULL) == (i < 3));
		markdown_free(page);
	}
}

static void check_blocks(void)
{
	static const char text[] = "# One `two`\n\n- a\n- b [c](d.md#e)\n\n  f\n\n  ```text\n  g\n\n  h\n"
		"  ```\n\n3. i\n4. j **k**\n\n| l | m |\n|---|---|\n| `n\\|o` | p |\n\n![q](r.png) s\n";
	static const struct { enum md_kind kind; int level; const char *mark, *text; } want[] = {
		{ MD_HEADING, 1, NULL, "One two" }, { MD_TEXT, 1, "\xe2\x80\xa2", "a" },
		{ MD_TEXT, 1, "\xe2\x80\xa2", "b c" }, { MD_TEXT, 1, NULL, "f" },
		{ MD_CODE_BLOCK, 1, NULL, "g\n\nh\n" }, { MD_TEXT, 1, "3.", "i" },
		{ MD_TEXT, 1, "4.", "j k" }, { MD_TABLE, 0, NULL, "l\tm\nn|o\tp\n" },
		{ MD_PICTURE, 0, NULL, "q" }, { MD_TEXT, 0, NULL, " s" },
	};
	struct md_page *page = markdown_read(text, strlen(text));

	CHECK(!page->unknown && page->blocks->len == G_N_ELEMENTS(want));
	for (guint i = 0; i < MIN(page->blocks->len, G_N_ELEMENTS(want)); i++) {
		const struct md_block *block = page->blocks->pdata[i];
		char *got = markdown_block_text(block);

		CHECK(block->kind == want[i].kind && block->level == want[i].level &&
		      g_strcmp0(block->mark, want[i].mark) == 0);
		CHECK_TEXT(got, want[i].text);
		g_free(got);
	}
	CHECK_TEXT(page->title, "One two");
	markdown_free(page);
}

int main(void)
{
	if (!markdown_is_here()) {
		tap_skip("md4c is not installed");
		return tap_done();
	}
	g_setenv("RUNGBOARD_DOCS", "docs", TRUE);
	manual = manual_new();
	CHECK(manual && manual_count(manual) > 10);
	for (int i = 0; i < manual_count(manual); i++)
		check_page(i);
	check_places();
	check_words();
	check_lower();
	check_search();
	check_refused();
	check_blocks();
	manual_free(manual);
	return tap_done();
}
