/* SPDX-License-Identifier: MIT
 *
 * test_beside - which scenarios and I/O maps of a folder belong to a program.
 */
#include "editor-gtk/file_view.h"
#include "tests/tap.h"

#include <glib/gstdio.h>
#include <string.h>

static char *folder;

static void make(const char *name)
{
	char *path = g_build_filename(folder, name, NULL);
	char *parent = g_path_get_dirname(path);

	g_mkdir_with_parents(parent, 0700);
	CHECK(g_file_set_contents(path, "", 0, NULL));
	g_free(parent);
	g_free(path);
}

/* Their names, one behind the other. */
static bool are(const char *program, const char *ending, bool own, const char *wanted)
{
	char *path = g_build_filename(folder, program, NULL);
	GPtrArray *files = files_beside(path, ending, own);
	GString *got = g_string_new(NULL);
	bool same;

	for (guint i = 0; i < files->len; i++)
		g_string_append_printf(got, "%s%s", i ? " " : "",
				       (char *)files->pdata[i] + strlen(folder) + 1);
	same = strcmp(got->str, wanted) == 0;
	if (!same)
		printf("# %s, not %s\n", got->str, wanted);
	g_string_free(got, TRUE);
	g_ptr_array_unref(files);
	g_free(path);
	return same;
}

int main(void)
{
	static const char *const names[] = {
		"pump.rung", "pump-two.rung", "pump.io", "pump-lab.io", "pump-two.io",
		"pump-two-lab.io", "pumps.io", "other.io", "boards/pi.io", "pump.scn",
		"pumps.scn", "pump-two.scn",
	};
	GPtrArray *none;

	folder = g_dir_make_tmp("rungboard-beside-XXXXXX", NULL);
	for (gsize i = 0; i < G_N_ELEMENTS(names); i++)
		make(names[i]);
	CHECK(are("pump.rung", ".io", true, "pump-lab.io pump.io"));
	CHECK(are("pump.rung", ".io", false,
		  "boards/pi.io other.io pump-two-lab.io pump-two.io pumps.io"));
	CHECK(are("pump-two.rung", ".io", true, "pump-two-lab.io pump-two.io"));
	CHECK(are("pump.rung", ".scn", true, "pump.scn"));
	CHECK(are("pump-two.rung", ".scn", true, "pump-two.scn"));
	CHECK(are("new.rung", ".io", true, ""));
	none = files_beside(NULL, ".io", true);
	CHECK(none->len == 0);
	g_ptr_array_unref(none);
	for (gsize i = G_N_ELEMENTS(names); i-- > 0;) {
		char *path = g_build_filename(folder, names[i], NULL);

		g_remove(path);
		g_free(path);
	}
	char *boards = g_build_filename(folder, "boards", NULL);
	g_rmdir(boards);
	g_rmdir(folder);
	g_free(boards);
	g_free(folder);
	return tap_done();
}
