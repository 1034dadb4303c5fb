/* SPDX-License-Identifier: MIT
 *
 * disk - reads and saves files as the engine does, with errors for the user.
 */
#include "editor-gtk/document/disk.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/file.h"

#include <glib/gstdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

char *disk_told_size(const char *path, const struct diag *diag, gsize limit)
{
	GStatBuf about;
	char *size, *most, *told, *text;

	/* A compressed file within the limit is too large when unpacked: by how much is not
	 * known. */
	if (diag->id != DIAG_TOO_LARGE || !path || g_stat(path, &about) != 0 ||
	    about.st_size <= 0 || (guint64)about.st_size <= limit)
		return g_strdup("");
	size = g_format_size((guint64)about.st_size);
	most = g_format_size(limit);
	told = g_strdup_printf(_("%s, at most %s"), size, most);
	text = g_strdup_printf(": %s", told);
	g_free(size);
	g_free(most);
	g_free(told);
	return text;
}

/* @limit: bytes. */
static void tell(GError **error, const char *path, const struct diag_list *diags, gsize limit)
{
	char *text = diag_said_whole(&diags->diag[0]);
	char *size = disk_told_size(path, &diags->diag[0], limit);

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
		tell(error, path, &diags, limit);
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
		tell(error, path, &diags, len);
	return good;
}

/* The mode counts even for root, whom the system lets write any file. */
bool disk_is_locked(const char *path)
{
	struct stat about;

	return stat(path, &about) == 0 &&
	       (!(about.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) || access(path, W_OK) != 0);
}

bool disk_same(const char *a, const char *b)
{
	struct stat one, other;

	return strcmp(a, b) == 0 || (stat(a, &one) == 0 && stat(b, &other) == 0 &&
		one.st_dev == other.st_dev && one.st_ino == other.st_ino);
}
