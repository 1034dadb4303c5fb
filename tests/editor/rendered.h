/* SPDX-License-Identifier: MIT
 *
 * rendered - for tests of pictures and paper: runs `ladder-editor --render` in this
 * process, without a display, into a scratch folder.
 */
#ifndef TESTS_EDITOR_RENDERED_H
#define TESTS_EDITOR_RENDERED_H

#include "editor-gtk/render/render.h"
#include "tests/tap.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define SHAPES "tests/editor/drawing/shapes.rung"

static char *folder;
static char *said; /* stderr of the last call                                   */

static inline char *in_folder(const char *name)
{
	return g_build_filename(folder, name, NULL);
}

static inline char *content(const char *name, size_t *len)
{
	char *path = in_folder(name), *text = NULL;

	if (!g_file_get_contents(path, &text, len, NULL))
		text = g_strdup("");
	g_free(path);
	return text;
}

/* @words: arguments, separated by blanks; OUT/ is the scratch folder. */
static inline int render(const char *words)
{
	char *place = g_strdup_printf("%s/", folder), *log = in_folder("said");
	char **parts = g_strsplit(words, "OUT/", -1), *all = g_strjoinv(place, parts);
	char *line = g_strdup_printf("ladder-editor --render %s", all);
	char **argv = g_strsplit(line, " ", -1);
	int keep = dup(2), status;

	fflush(stderr);
	if (!freopen(log, "w", stderr))
		return -1;
	status = render_main((int)g_strv_length(argv), argv);
	fflush(stderr);
	dup2(keep, 2);
	close(keep);
	g_free(said);
	said = content("said", NULL);
	g_strfreev(argv);
	g_strfreev(parts);
	g_free(line);
	g_free(all);
	g_free(log);
	g_free(place);
	return status;
}

static inline bool has(const char *file, const char *text)
{
	char *all = content(file, NULL);
	bool found = strstr(all, text) != NULL;

	g_free(all);
	return found;
}

static inline bool same(const char *a, const char *b)
{
	size_t a_len = 0, b_len = 0;
	char *x = content(a, &a_len), *y = content(b, &b_len);
	bool equal = a_len > 0 && a_len == b_len && memcmp(x, y, a_len) == 0;

	g_free(x);
	g_free(y);
	return equal;
}

static inline void write_text(const char *name, const char *text)
{
	char *path = in_folder(name), *all = g_strdup_printf("RUNGBOARD 1\n%s", text);

	CHECK(g_file_set_contents(path, all, -1, NULL));
	g_free(all);
	g_free(path);
}

/* Writes a rung file with these rows. */
static inline void write_rung(const char *name, const char *rows)
{
	char *text = g_strdup_printf("\nPROGRAM Main LD\nRUNG\n%sEND_PROGRAM\n", rows);

	write_text(name, text);
	g_free(text);
}

static inline void clear_folder(void)
{
	GDir *dir = g_dir_open(folder, 0, NULL);

	for (const char *name; dir && (name = g_dir_read_name(dir));) {
		char *path = in_folder(name);

		g_unlink(path);
		g_free(path);
	}
	if (dir)
		g_dir_close(dir);
	g_rmdir(folder);
}

#endif
