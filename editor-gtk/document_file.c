/* SPDX-License-Identifier: MIT
 *
 * document_file - a document from its file and back.
 *
 * A save leaves the old file or the new one, never a mix. It asks nobody: whether a file
 * that somebody else changed may be written over is the window's question.
 */
#include "editor-gtk/disk.h"
#include "editor-gtk/document_inside.h"

#include "engine/scan/code.h"

#include <glib/gstdio.h>
#include <string.h>

static char *sum_of(const char *text, gsize len)
{
	return g_compute_checksum_for_data(G_CHECKSUM_SHA256, (const guchar *)text, len);
}

/* What stands in the file; NULL: nobody knows. */
static void set_sum(LadderDocument *document, char *sum)
{
	g_free(document->disk_sum);
	document->disk_sum = sum;
	document->disk_differs = false;
	memset(&document->disk_seen, 0, sizeof(document->disk_seen));
}

static void set_path(LadderDocument *document, const char *path)
{
	char *copy = path ? g_canonicalize_filename(path, NULL) : NULL;

	g_free(document->path);
	document->path = copy;
}

static bool fail(GError **error, GFileError code, const char *text, const char *path)
{
	g_set_error(error, G_FILE_ERROR, code, "%s: %s", path, text);
	return false;
}

/* Bytes that are no text cannot be shown: what stands for them is not what the file
 * holds, so the document differs from it. */
static void open_bytes(LadderDocument *document, const char *path, const char *text,
		       gsize len)
{
	const char *bad = text;
	char *valid;

	document->repaired = 0;
	if (g_utf8_validate_len(text, len, &bad)) {
		ladder_document_open_text(document, path, text, len, true);
		return;
	}
	valid = g_utf8_make_valid(text, (gssize)len);
	ladder_document_open_text(document, path, valid, strlen(valid), false);
	set_sum(document, sum_of(text, len));
	document->repaired = 1;
	for (const char *at = text; at < bad; at++)
		document->repaired += *at == '\n';
	g_free(valid);
}

bool ladder_document_open(LadderDocument *document, const char *path, GError **error)
{
	gsize len;
	char *text = disk_read(path, LIMIT_TEXT, &len, error);

	if (!text)
		return false;
	if (len >= strlen(CODE_MAGIC) && !memcmp(text, CODE_MAGIC, strlen(CODE_MAGIC))) {
		g_free(text);
		return fail(error, G_FILE_ERROR_INVAL,
			    _("is a code image; the program it was made of can be "
			      "opened"), path);
	}
	open_bytes(document, path, text, len);
	g_free(text);
	return true;
}

void ladder_document_open_text(LadderDocument *document, const char *path,
			       const char *text, gsize len, bool saved)
{
	set_path(document, path);
	set_sum(document, saved ? sum_of(text, len) : NULL);
	document_take(document, text, len);
	if (!saved) {
		history_never_saved(document->history);
		document_tell_state(document);
	}
}

bool ladder_document_save(LadderDocument *document, const char *path, GError **error)
{
	gsize len;
	char *text;
	bool good;

	path = path ? path : document->path;
	g_return_val_if_fail(path != NULL, false);
	text = ladder_document_text(document, &len);
	good = disk_save(path, text, len, error);
	if (good) {
		set_path(document, path);
		set_sum(document, sum_of(text, len));
		history_mark_saved(document->history);
		document_tell_state(document);
	}
	g_free(text);
	return good;
}

/* The file is read only if it looks another than when it was looked at last. */
static bool looks_the_same(LadderDocument *document)
{
	GStatBuf about = { 0 };
	const bool same = g_stat(document->path, &about) == 0 &&
		about.st_mtim.tv_sec == document->disk_seen.st_mtim.tv_sec &&
		about.st_mtim.tv_nsec == document->disk_seen.st_mtim.tv_nsec &&
		about.st_ino == document->disk_seen.st_ino &&
		about.st_size == document->disk_seen.st_size;

	document->disk_seen = about;
	return same;
}

bool ladder_document_disk_changed(LadderDocument *document)
{
	char *text, *sum;
	gsize len;

	if (!document->path || !document->disk_sum)
		return false;
	if (looks_the_same(document))
		return document->disk_differs;
	text = disk_read(document->path, LIMIT_TEXT, &len, NULL);
	document->disk_differs = false;
	if (text) {
		sum = sum_of(text, len);
		document->disk_differs = strcmp(sum, document->disk_sum) != 0;
		g_free(sum);
	}
	g_free(text);
	return document->disk_differs;
}

bool ladder_document_is_saved(LadderDocument *document)
{
	return history_is_saved(document->history);
}

int ladder_document_repaired(LadderDocument *document)
{
	return document->repaired;
}
