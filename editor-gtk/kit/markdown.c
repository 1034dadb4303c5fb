/* SPDX-License-Identifier: MIT
 *
 * markdown - texts and anchors of a page; see markdown.h.
 */
#include "editor-gtk/kit/markdown.h"

char *markdown_runs_text(const GArray *runs)
{
	GString *text = g_string_new(NULL);

	for (guint i = 0; runs && i < runs->len; i++)
		g_string_append(text, g_array_index(runs, struct md_run, i).text);
	return g_string_free(text, FALSE);
}

char *markdown_block_text(const struct md_block *block)
{
	GString *text;

	if (block->kind != MD_TABLE)
		return markdown_runs_text(block->runs);
	text = g_string_new(NULL);
	for (guint i = 0; i < block->cells->len; i++) {
		char *cell = markdown_runs_text(block->cells->pdata[i]);

		g_string_append_printf(text, "%s%c", cell,
				       (int)(i + 1) % block->columns ? '\t' : '\n');
		g_free(cell);
	}
	return g_string_free(text, FALSE);
}

char *markdown_anchor(const char *heading)
{
	GString *anchor = g_string_new(NULL);

	for (const char *at = heading; *at; at = g_utf8_next_char(at)) {
		const gunichar c = g_unichar_tolower(g_utf8_get_char(at));

		if (c == ' ' || c == '-')
			g_string_append_c(anchor, '-');
		else if (g_unichar_isalnum(c) || c == '_')
			g_string_append_unichar(anchor, c);
	}
	return g_string_free(anchor, FALSE);
}

void markdown_free(struct md_page *page)
{
	if (!page)
		return;
	g_ptr_array_unref(page->blocks);
	g_free(page->title);
	g_free(page->unknown);
	g_free(page);
}
