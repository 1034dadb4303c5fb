/* SPDX-License-Identifier: MIT
 *
 * beside - what belongs to this program, wherever it was built, installed or moved to.
 */
#include "editor-gtk/beside.h"

static char *if_there(char *path)
{
	if (g_file_test(path, G_FILE_TEST_EXISTS))
		return path;
	g_free(path);
	return NULL;
}

char *beside_find(const char *built, const char *installed)
{
	char *program = g_file_read_link("/proc/self/exe", NULL), *folder, *found;

	if (!program)
		return NULL;
	folder = g_path_get_dirname(program);
	found = if_there(g_build_filename(folder, built, NULL));
	if (!found && installed)
		found = if_there(g_build_filename(folder, "..", "share", installed, NULL));
	g_free(folder);
	g_free(program);
	return found;
}
