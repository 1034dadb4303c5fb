/* SPDX-License-Identifier: MIT
 *
 * disk - files as the engine reads and saves them, with errors a person can read.
 */
#include "editor-gtk/disk.h"

#include "editor-gtk/diag_said.h"

#include "engine/base/file.h"

#include <glib/gstdio.h>
#include <stdlib.h>

/* ": 1.1 TB" if that is what is wrong. Caller frees. */
static char *size_told(const char *path, const struct diag *diag)
{
	GStatBuf about;
	char *size, *text;

	if (diag->id != DIAG_TOO_LARGE || g_stat(path, &about) != 0 || about.st_size <= 0)
		return g_strdup("");
	size = g_format_size((guint64)about.st_size);
	text = g_strdup_printf(": %s", size);
	g_free(size);
	return text;
}

static void tell(GError **error, const char *path, const struct diag_list *diags)
{
	char *text = diag_said_whole(&diags->diag[0]);
	char *size = size_told(path, &diags->diag[0]);

	g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_FAILED, "%s: %s%s", path, text, size);
	g_free(text);
	g_free(size);
}

char *disk_read(const char *path, gsize limit, gsize *len, GError **error)
{
	struct diag_list diags;
	char *bytes, *copy = NULL;

	diag_init(&diags);
	bytes = file_read(path, limit, len, &diags);
	if (bytes)
		copy = g_memdup2(bytes, *len + 1);
	else
		tell(error, path, &diags);
	free(bytes);
	return copy;
}

bool disk_save(const char *path, const char *bytes, gsize len, GError **error)
{
	struct diag_list diags;
	bool good;

	diag_init(&diags);
	good = file_save(path, bytes, len, &diags);
	if (!good)
		tell(error, path, &diags);
	return good;
}
