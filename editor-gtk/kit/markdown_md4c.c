/* SPDX-License-Identifier: MIT
 *
 * markdown_md4c - turns the events of md4c into blocks; see markdown.h.
 */
#include "editor-gtk/kit/markdown.h"

#include <md4c.h>
#include <string.h>

#define LISTS_MOST 8 /* deeper lists are refused                                */

struct reading {
	struct md_page *page;
	struct md_block *block;      /* the open one; NULL: none                */
	GArray *runs;                /* where text goes; NULL: nowhere          */
	unsigned int style;
	char *link;
	int lists;                   /* open lists                              */
	int number[LISTS_MOST];      /* of the next item; 0: a list of bullets  */
	char *mark;                  /* of an item that has no text yet         */
	GHashTable *anchors;         /* how often each was met                  */
};

static void clear_run(gpointer data)
{
	struct md_run *run = data;

	g_free(run->text);
	g_free(run->link);
}

static GArray *runs_new(void)
{
	GArray *runs = g_array_new(FALSE, FALSE, sizeof(struct md_run));

	g_array_set_clear_func(runs, clear_run);
	return runs;
}

static void block_free(gpointer data)
{
	struct md_block *block = data;

	g_free(block->mark);
	g_free(block->anchor);
	g_free(block->file);
	g_clear_pointer(&block->runs, g_array_unref);
	g_clear_pointer(&block->cells, g_ptr_array_unref);
	g_free(block);
}

static int refuse(struct reading *reading, const char *construct)
{
	if (!reading->page->unknown)
		reading->page->unknown = g_strdup(construct);
	return 0;
}

/* ---- blocks ---- */

static void begin(struct reading *reading, enum md_kind kind, int level)
{
	struct md_block *block = g_new0(struct md_block, 1);

	block->kind = kind;
	block->level = level;
	block->runs = runs_new();
	block->mark = g_steal_pointer(&reading->mark);
	g_ptr_array_add(reading->page->blocks, block);
	reading->block = block;
	reading->runs = block->runs;
}

static void end(struct reading *reading)
{
	reading->block = NULL;
	reading->runs = NULL;
}

/* Ends a text without content, such as one that held only a picture. */
static void end_text(struct reading *reading)
{
	GPtrArray *blocks = reading->page->blocks;

	if (reading->block && reading->block->kind == MD_TEXT && !reading->block->runs->len) {
		g_free(reading->mark);
		reading->mark = g_steal_pointer(&reading->block->mark);
		g_ptr_array_remove(blocks, reading->block);
	}
	end(reading);
}

static void begin_list(struct reading *reading, int first)
{
	if (reading->lists < LISTS_MOST)
		reading->number[reading->lists] = first;
	else
		refuse(reading, "a list that deep");
	reading->lists++;
}

static void begin_item(struct reading *reading)
{
	int *number = &reading->number[MIN(reading->lists, LISTS_MOST) - 1];

	end_text(reading);
	g_free(reading->mark);
	reading->mark = *number ? g_strdup_printf("%d.", (*number)++) :
				  g_strdup("\xe2\x80\xa2");
}

static void begin_table(struct reading *reading, int columns)
{
	begin(reading, MD_TABLE, reading->lists);
	reading->block->columns = columns;
	reading->block->cells = g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref);
	reading->runs = NULL;
}

static int enter_block(MD_BLOCKTYPE type, void *detail, void *data)
{
	struct reading *reading = data;

	switch (type) {
	case MD_BLOCK_H:
		begin(reading, MD_HEADING, (int)((MD_BLOCK_H_DETAIL *)detail)->level);
		break;
	case MD_BLOCK_P:
		end_text(reading);
		begin(reading, MD_TEXT, reading->lists);
		break;
	case MD_BLOCK_CODE:
		end_text(reading);
		begin(reading, MD_CODE_BLOCK, reading->lists);
		break;
	case MD_BLOCK_UL:
		end_text(reading);
		begin_list(reading, 0);
		break;
	case MD_BLOCK_OL:
		end_text(reading);
		begin_list(reading, (int)((MD_BLOCK_OL_DETAIL *)detail)->start);
		break;
	case MD_BLOCK_LI:
		begin_item(reading);
		begin(reading, MD_TEXT, reading->lists); /* of a tight list     */
		break;
	case MD_BLOCK_TABLE:
		begin_table(reading, (int)((MD_BLOCK_TABLE_DETAIL *)detail)->col_count);
		break;
	case MD_BLOCK_TH:
	case MD_BLOCK_TD:
		reading->runs = runs_new();
		g_ptr_array_add(reading->block->cells, reading->runs);
		break;
	case MD_BLOCK_DOC:
	case MD_BLOCK_THEAD:
	case MD_BLOCK_TBODY:
	case MD_BLOCK_TR:
		break;
	case MD_BLOCK_QUOTE: return refuse(reading, "a quotation");
	case MD_BLOCK_HR: return refuse(reading, "a line across the page");
	case MD_BLOCK_HTML: return refuse(reading, "HTML");
	}
	return 0;
}

static void name_heading(struct reading *reading)
{
	struct md_block *block = reading->block;
	char *text = markdown_runs_text(block->runs), *anchor = markdown_anchor(text);
	const int before = GPOINTER_TO_INT(g_hash_table_lookup(reading->anchors, anchor));

	block->anchor = before ? g_strdup_printf("%s-%d", anchor, before) : g_strdup(anchor);
	g_hash_table_insert(reading->anchors, anchor, GINT_TO_POINTER(before + 1));
	if (!*reading->page->title) {
		g_free(reading->page->title);
		reading->page->title = g_strdup(text);
	}
	g_free(text);
}

static int leave_block(MD_BLOCKTYPE type, void *detail, void *data)
{
	struct reading *reading = data;

	(void)detail;
	switch (type) {
	case MD_BLOCK_H:
		name_heading(reading);
		end(reading);
		break;
	case MD_BLOCK_P:
	case MD_BLOCK_LI:
		end_text(reading);
		break;
	case MD_BLOCK_CODE:
	case MD_BLOCK_TABLE:
		end(reading);
		break;
	case MD_BLOCK_UL:
	case MD_BLOCK_OL:
		reading->lists--;
		break;
	case MD_BLOCK_TH:
	case MD_BLOCK_TD:
		reading->runs = NULL;
		break;
	case MD_BLOCK_DOC: case MD_BLOCK_THEAD: case MD_BLOCK_TBODY: case MD_BLOCK_TR:
	case MD_BLOCK_QUOTE: case MD_BLOCK_HR: case MD_BLOCK_HTML:
		break;
	}
	return 0;
}

/* ---- spans ---- */

static char *attribute(const MD_ATTRIBUTE *text)
{
	return g_strndup(text->text, text->size);
}

/* A picture is a block of its own. */
static void begin_picture(struct reading *reading, const MD_ATTRIBUTE *file)
{
	const int level = reading->lists;

	end_text(reading);
	begin(reading, MD_PICTURE, level);
	reading->block->file = attribute(file);
}

static int enter_span(MD_SPANTYPE type, void *detail, void *data)
{
	struct reading *reading = data;

	switch (type) {
	case MD_SPAN_EM: reading->style |= MD_EMPHASIS; break;
	case MD_SPAN_STRONG: reading->style |= MD_BOLD; break;
	case MD_SPAN_CODE: reading->style |= MD_CODE; break;
	case MD_SPAN_A:
		reading->link = attribute(&((MD_SPAN_A_DETAIL *)detail)->href);
		break;
	case MD_SPAN_IMG:
		begin_picture(reading, &((MD_SPAN_IMG_DETAIL *)detail)->src);
		break;
	case MD_SPAN_DEL: return refuse(reading, "text that is struck out");
	case MD_SPAN_U: return refuse(reading, "underlined text");
	case MD_SPAN_LATEXMATH:
	case MD_SPAN_LATEXMATH_DISPLAY: return refuse(reading, "a formula");
	case MD_SPAN_WIKILINK: return refuse(reading, "a link in [[ ]]");
	}
	return 0;
}

static int leave_span(MD_SPANTYPE type, void *detail, void *data)
{
	struct reading *reading = data;

	(void)detail;
	switch (type) {
	case MD_SPAN_EM: reading->style &= ~(unsigned int)MD_EMPHASIS; break;
	case MD_SPAN_STRONG: reading->style &= ~(unsigned int)MD_BOLD; break;
	case MD_SPAN_CODE: reading->style &= ~(unsigned int)MD_CODE; break;
	case MD_SPAN_A: g_clear_pointer(&reading->link, g_free); break;
	case MD_SPAN_IMG:
		begin(reading, MD_TEXT, reading->lists); /* what follows in the paragraph */
		break;
	case MD_SPAN_DEL: case MD_SPAN_U: case MD_SPAN_LATEXMATH:
	case MD_SPAN_LATEXMATH_DISPLAY: case MD_SPAN_WIKILINK:
		break;
	}
	return 0;
}

/* ---- text ---- */

static void put(struct reading *reading, const char *text, gsize len)
{
	struct md_run *last = reading->runs->len ? &g_array_index(reading->runs,
		struct md_run, reading->runs->len - 1) : NULL;
	struct md_run run = { .style = reading->style, .link = reading->link };

	if (last && last->style == run.style && g_strcmp0(last->link, run.link) == 0) {
		char *joined = g_strdup_printf("%s%.*s", last->text, (int)len, text);

		g_free(last->text);
		last->text = joined;
		return;
	}
	run.text = g_strndup(text, len);
	run.link = g_strdup(run.link);
	g_array_append_val(reading->runs, run);
}

/* The few entities of XML; others are refused. */
static void put_entity(struct reading *reading, const char *text, gsize len)
{
	static const char *const known[][2] = { { "&lt;", "<" }, { "&gt;", ">" },
		{ "&amp;", "&" }, { "&quot;", "\"" }, { "&nbsp;", "\xc2\xa0" } };

	for (gsize i = 0; i < G_N_ELEMENTS(known); i++)
		if (strlen(known[i][0]) == len && strncmp(known[i][0], text, len) == 0) {
			put(reading, known[i][1], strlen(known[i][1]));
			return;
		}
	refuse(reading, "an entity");
}

/* In a table a bar in code is written \|, of which md4c 0.4 leaves the backslash. */
static void put_code(struct reading *reading, const char *text, gsize len)
{
	char *code = g_strndup(text, len);
	char **parts = g_strsplit(code, "\\|", -1);
	char *bars = g_strjoinv("|", parts);
	const char *put_as = reading->block->kind == MD_TABLE ? bars : code;

	put(reading, put_as, strlen(put_as));
	g_free(bars);
	g_strfreev(parts);
	g_free(code);
}

static int text(MD_TEXTTYPE type, const MD_CHAR *chars, MD_SIZE size, void *data)
{
	struct reading *reading = data;

	if (!reading->runs)
		return type == MD_TEXT_HTML ? refuse(reading, "HTML") : 0;
	switch (type) {
	case MD_TEXT_CODE:
		put_code(reading, chars, size);
		break;
	case MD_TEXT_NORMAL: put(reading, chars, size); break;
	case MD_TEXT_SOFTBR: put(reading, " ", 1); break;
	case MD_TEXT_BR: put(reading, "\n", 1); break;
	case MD_TEXT_ENTITY: put_entity(reading, chars, size); break;
	case MD_TEXT_HTML: return refuse(reading, "HTML");
	case MD_TEXT_NULLCHAR: return refuse(reading, "a NUL");
	case MD_TEXT_LATEXMATH: return refuse(reading, "a formula");
	}
	return 0;
}

bool markdown_is_here(void)
{
	return true;
}

struct md_page *markdown_read(const char *bytes, gsize len)
{
	const MD_PARSER parser = { .flags = MD_FLAG_TABLES | MD_FLAG_NOHTML |
		MD_FLAG_NOINDENTEDCODEBLOCKS, .enter_block = enter_block,
		.leave_block = leave_block, .enter_span = enter_span,
		.leave_span = leave_span, .text = text };
	struct reading reading = { .page = g_new0(struct md_page, 1),
		.anchors = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL) };

	reading.page->title = g_strdup("");
	reading.page->blocks = g_ptr_array_new_with_free_func(block_free);
	if (md_parse(bytes, (MD_SIZE)len, &parser, &reading) != 0)
		refuse(&reading, "a text of this size");
	g_hash_table_unref(reading.anchors);
	g_free(reading.mark);
	g_free(reading.link);
	return reading.page;
}
