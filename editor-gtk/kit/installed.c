/* SPDX-License-Identifier: MIT
 *
 * installed - finds files and programs of this package; see installed.h.
 */
#include "editor-gtk/kit/installed.h"

/* Returns @path, or frees it and returns NULL if the test fails. */
static char *if_is(char *path, GFileTest wanted)
{
	if (g_file_test(path, wanted))
		return path;
	g_free(path);
	return NULL;
}

/* Folder of this program. */
static char *bin_folder(void)
{
	char *program = g_file_read_link("/proc/self/exe", NULL);
	char *folder = program ? g_path_get_dirname(program) : NULL;

	g_free(program);
	return folder;
}

char *installed_folder(const char *built, const char *installed)
{
	char *bin = bin_folder(), *found;

	if (!bin)
		return NULL;
	found = if_is(g_build_filename(bin, built, NULL), G_FILE_TEST_IS_DIR);
	if (!found)
		found = if_is(g_build_filename(bin, "..", "share", installed, NULL),
			      G_FILE_TEST_IS_DIR);
	g_free(bin);
	return found;
}

char *installed_program(const char *name)
{
	char *bin = bin_folder();
	char *found = bin ? if_is(g_build_filename(bin, name, NULL),
				  G_FILE_TEST_IS_EXECUTABLE) : NULL;

	g_free(bin);
	return found ? found : g_find_program_in_path(name);
}
