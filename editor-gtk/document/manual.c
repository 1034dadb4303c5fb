/* SPDX-License-Identifier: MIT
 *
 * manual - see manual.h.
 */
#include "editor-gtk/document/manual.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/kit/installed.h"
#include "editor-gtk/kit/text_lower.h"

#include <string.h>

#define PAGE_MOST (4 << 20) /* bytes of a page                                  */

/* Beginners first; other pages follow by name. */
static const char *const order[] = {
	"tutorial.md", "editor.md", "quick-entry.md", "symbols.md", "sfc.md", "flow-chart-to-st.md",
	"st.md", "fbd.md", "boards.md", "scenarios.md", "rung-file.md", "declarations.md", "language.md",
	"blocks.md", "words.md",
};

struct manual {
	char *folder;
	GPtrArray *names;
	struct md_page **page;  /* NULL: not read yet                            */
};

static int place_of(const char *name)
{
	for (int i = 0; i < (int)G_N_ELEMENTS(order); i++)
		if (strcmp(order[i], name) == 0)
			return i;
	return G_N_ELEMENTS(order);
}

static int by_place(gconstpointer a, gconstpointer b)
{
	const char *x = *(char *const *)a, *y = *(char *const *)b;

	return place_of(x) != place_of(y) ? place_of(x) - place_of(y) : strcmp(x, y);
}

struct manual *manual_new(void)
{
	const char *told = g_getenv("RUNGBOARD_DOCS");
	char *folder = told ? g_strdup(told) : installed_folder("docs", "rungboard/docs");
	GDir *dir = folder ? g_dir_open(folder, 0, NULL) : NULL;
	struct manual *manual;
	const char *name;

	if (!dir) {
		g_free(folder);
		return NULL;
	}
	manual = g_new0(struct manual, 1);
	manual->folder = folder;
	manual->names = g_ptr_array_new_with_free_func(g_free);
	while ((name = g_dir_read_name(dir)))
		if (g_str_has_suffix(name, ".md"))
			g_ptr_array_add(manual->names, g_strdup(name));
	g_dir_close(dir);
	g_ptr_array_sort(manual->names, by_place);
	manual->page = g_new0(struct md_page *, manual->names->len + 1);
	return manual;
}

void manual_free(struct manual *manual)
{
	if (!manual)
		return;
	for (guint i = 0; i < manual->names->len; i++)
		markdown_free(manual->page[i]);
	g_ptr_array_unref(manual->names);
	g_free(manual->page);
	g_free(manual->folder);
	g_free(manual);
}

const char *manual_folder(const struct manual *manual)
{
	return manual->folder;
}

int manual_count(const struct manual *manual)
{
	return (int)manual->names->len;
}

const char *manual_name(const struct manual *manual, int page)
{
	return manual->names->pdata[page];
}

int manual_find(const struct manual *manual, const char *name)
{
	for (int i = 0; i < manual_count(manual); i++)
		if (strcmp(manual_name(manual, i), name) == 0)
			return i;
	return -1;
}

const struct md_page *manual_page(struct manual *manual, int page)
{
	char *path, *text;
	gsize len;

	if (page < 0 || page >= manual_count(manual))
		return NULL;
	if (manual->page[page])
		return manual->page[page];
	path = g_build_filename(manual->folder, manual_name(manual, page), NULL);
	text = disk_read(path, PAGE_MOST, &len, NULL);
	if (text && g_utf8_validate(text, (gssize)len, NULL))
		manual->page[page] = markdown_read(text, len);
	g_free(text);
	g_free(path);
	return manual->page[page];
}

/* ---- places ---- */

int manual_anchor(struct manual *manual, int page, const char *anchor)
{
	const struct md_page *of = manual_page(manual, page);

	for (int i = 0; of && i < (int)of->blocks->len; i++) {
		const struct md_block *block = of->blocks->pdata[i];

		if (block->kind == MD_HEADING && strcmp(block->anchor, anchor) == 0)
			return i;
	}
	return -1;
}

/* Is it the heading "TON: on-delay timer" of the word? */
static bool is_of_word(const struct md_block *block, const char *word)
{
	char *text = block->kind == MD_HEADING ? markdown_runs_text(block->runs) : NULL;
	const gsize len = strlen(word);
	const bool is = text && strncmp(text, word, len) == 0 && text[len] == ':';

	g_free(text);
	return is;
}

/* Is it a table whose rows begin with words, one of which is this? */
static bool has_row(const struct md_block *block, const char *word)
{
	bool has = false;

	for (guint i = 0; block->kind == MD_TABLE && !has && i < block->cells->len;
	     i += (guint)block->columns) {
		char *cell = markdown_runs_text(block->cells->pdata[i]);

		has = strcmp(cell, word) == 0;
		g_free(cell);
	}
	return has;
}

int manual_word(struct manual *manual, const char *word)
{
	const struct md_page *of = manual_page(manual, manual_find(manual, "words.md"));

	for (int i = 0; of && i < (int)of->blocks->len; i++)
		if (is_of_word(of->blocks->pdata[i], word))
			return i;
	for (int i = 0; of && i < (int)of->blocks->len; i++)
		if (has_row(of->blocks->pdata[i], word))
			return i;
	return -1;
}

bool manual_code(struct manual *manual, const char *code, int *page, int *block)
{
	for (*page = 0; *page < manual_count(manual); ++*page) {
		const struct md_page *of = manual_page(manual, *page);

		for (*block = 0; of && *block < (int)of->blocks->len; ++*block) {
			const struct md_block *at = of->blocks->pdata[*block];
			char *text = at->kind == MD_CODE_BLOCK ? NULL :
				     markdown_block_text(at);
			const bool has = text && strstr(text, code);

			g_free(text);
			if (has)
				return true;
		}
	}
	return false;
}

/* ---- search ---- */

static void clear_hit(gpointer hit)
{
	g_free(((struct manual_hit *)hit)->line);
}

/* The line of @text that has byte @at, without blanks around it. */
static char *line_at(const char *text, gsize at)
{
	gsize from = at, to = at;

	while (from > 0 && text[from - 1] != '\n')
		from--;
	while (text[to] && text[to] != '\n')
		to++;
	return g_strstrip(g_strdelimit(g_strndup(text + from, to - from), "\t", ' '));
}

static void search_page(struct manual *manual, int page, const char *wanted, guint most,
			GArray *hits)
{
	const struct md_page *of = manual_page(manual, page);

	for (int i = 0; of && i < (int)of->blocks->len && hits->len < most; i++) {
		char *text = markdown_block_text(of->blocks->pdata[i]);
		char *folded = text_lower(text);
		const char *found = strstr(folded, wanted);
		struct manual_hit hit = { page, i, NULL };

		if (found) {
			/* as many characters, perhaps not as many bytes */
			const char *same = g_utf8_offset_to_pointer(text,
				g_utf8_pointer_to_offset(folded, found));

			hit.line = line_at(text, (gsize)(same - text));
			g_array_append_val(hits, hit);
		}
		g_free(folded);
		g_free(text);
	}
}

GArray *manual_search(struct manual *manual, const char *text, guint most)
{
	GArray *hits = g_array_new(FALSE, FALSE, sizeof(struct manual_hit));
	char *wanted = text_lower(text);

	g_array_set_clear_func(hits, clear_hit);
	for (int i = 0; *wanted && i < manual_count(manual) && hits->len < most; i++)
		search_page(manual, i, wanted, most, hits);
	g_free(wanted);
	return hits;
}
