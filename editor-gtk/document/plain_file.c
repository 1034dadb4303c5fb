/* SPDX-License-Identifier: MIT
 *
 * plain_file - see plain_file.h. Folders are searched at most eight deep.
 */
#include "editor-gtk/document/plain_file.h"

#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

#define DEPTH_MOST 8

const char *const plain_file_patterns[] = {
	"*.st", "*.iec", "*.il", "*.txt", "*.exp", "*.EXP", "*.TcPOU", "*.TcDUT", "*.TcGVL", NULL,
};

gboolean plain_file_is(const char *path)
{
	static const char *const endings[] = { ".st", ".iec", ".il", ".txt", ".exp", ".tcpou",
					       ".tcdut", ".tcgvl", NULL };
	const char *dot = strrchr(path, '.');
	char *lower = g_ascii_strdown(dot ? dot : "", -1);
	const gboolean is = g_strv_contains(endings, lower);

	g_free(lower);
	return is;
}

static void collect(GPtrArray *paths, const char *path, int depth)
{
	GDir *folder = g_dir_open(path, 0, NULL);
	const char *name;

	if (!folder) {
		if (!depth || plain_file_is(path))
			g_ptr_array_add(paths, g_strdup(path));
		return;
	}
	while (depth < DEPTH_MOST && (name = g_dir_read_name(folder))) {
		char *inner = g_build_filename(path, name, NULL);

		if (*name != '.')
			collect(paths, inner, depth + 1);
		g_free(inner);
	}
	g_dir_close(folder);
}

static int by_name(gconstpointer a, gconstpointer b)
{
	return strcmp(*(char *const *)a, *(char *const *)b);
}

char *plain_file_numbers(const char *text, gsize *len)
{
	GString *out = g_string_new(NULL);
	const char *from = text;
	struct lex lex;

	lex_init(&lex, text, *len);
	while (lex_next(&lex) != TOKEN_END) {
		const char *word = lex.token.kind != TOKEN_NAME ? NULL :
				   words_number(lex.token.text, lex.token.len);

		if (!word)
			continue;
		g_string_append_len(out, from, lex.token.text - from);
		g_string_append(out, word);
		from = lex.token.text + lex.token.len;
	}
	g_string_append_len(out, from, text + *len - from);
	*len = out->len;
	return g_string_free(out, FALSE);
}

char *plain_file_join(struct ladder *ladder, gsize *len)
{
	const struct project *project = ladder_project(ladder);
	GString *all = g_string_new(NULL);
	char *joined;

	for (int i = 0; i < project->source_count; i++) {
		size_t size;
		char *text = ladder_write_source(ladder, i, &size);

		if (!text) {
			g_string_free(all, TRUE);
			return NULL;
		}
		g_string_append_printf(all, "%s%.*s", i ? "\n" : "", (int)size, text);
		free(text);
	}
	*len = all->len;
	if (!project->words.as_numbers)
		return g_string_free(all, FALSE);
	joined = plain_file_numbers(all->str, len);
	g_string_free(all, TRUE);
	return joined;
}

/* The text of a project that no single file holds as it is. */
static char *text_of(struct ladder *ladder, const GPtrArray *paths, bool folder, gsize *len)
{
	const struct project *project;

	if (!ladder_load_files(ladder, (const char *const *)paths->pdata, (int)paths->len))
		return NULL;
	project = ladder_project(ladder);
	return project && (folder || project->source[0].foreign) ? plain_file_join(ladder, len) : NULL;
}

char *plain_file_import(const char *path, gsize *len)
{
	GPtrArray *paths = g_ptr_array_new_with_free_func(g_free);
	const bool folder = g_file_test(path, G_FILE_TEST_IS_DIR);
	struct ladder *ladder = ladder_new();
	char *text = NULL;

	collect(paths, path, 0);
	g_ptr_array_sort(paths, by_name);
	if (ladder && paths->len)
		text = text_of(ladder, paths, folder, len);
	ladder_free(ladder);
	g_ptr_array_unref(paths);
	return text;
}
