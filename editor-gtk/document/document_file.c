/* SPDX-License-Identifier: MIT
 *
 * document_file - a document from its file and back.
 *
 * A save leaves the old file or the new one, never a mix. It asks nobody: whether a file
 * that somebody else changed may be written over is the window's question.
 */
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/document_inside.h"

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
	document->disk = DISK_AS_READ;
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
	document->repaired = 0;
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
		document->repaired = 0;
		history_mark_saved(document->history);
		document_tell_state(document);
	}
	g_free(text);
	return good;
}

/* The file is read only if it looks another than when it was looked at last. */
static bool looks_the_same(LadderDocument *document, const GStatBuf *about)
{
	const GStatBuf *seen = &document->disk_seen;
	const bool same = about->st_mtim.tv_sec == seen->st_mtim.tv_sec &&
		about->st_mtim.tv_nsec == seen->st_mtim.tv_nsec &&
		about->st_ino == seen->st_ino && about->st_size == seen->st_size;

	document->disk_seen = *about;
	return same;
}

/* A file that cannot be read is there: nobody knows what it says. */
static enum disk_state look_at_disk(LadderDocument *document)
{
	enum disk_state state = DISK_AS_READ;
	GStatBuf about = { 0 };
	char *text, *sum;
	gsize len;

	if (g_stat(document->path, &about) != 0)
		return DISK_GONE;
	if (looks_the_same(document, &about))
		return document->disk;
	text = disk_read(document->path, LIMIT_TEXT, &len, NULL);
	if (text) {
		sum = sum_of(text, len);
		state = strcmp(sum, document->disk_sum) ? DISK_OTHER : DISK_AS_READ;
		g_free(sum);
	}
	g_free(text);
	return state;
}

enum disk_state ladder_document_disk(LadderDocument *document)
{
	const enum disk_state before = document->disk;

	if (!document->path || !document->disk_sum)
		return DISK_AS_READ;
	document->disk = look_at_disk(document);
	if (document->disk == DISK_GONE) /* one that comes is looked at, whatever it is */
		memset(&document->disk_seen, 0, sizeof(document->disk_seen));
	if ((document->disk == DISK_GONE) != (before == DISK_GONE))
		document_tell_state(document);
	return document->disk;
}

const char *ladder_document_disk_sum(LadderDocument *document)
{
	return document->disk_sum;
}

void ladder_document_restore(LadderDocument *document, const char *path, const char *sum,
			     const char *text, gsize len)
{
	ladder_document_open_text(document, path, text, len, false);
	set_sum(document, g_strdup(sum));
}

bool ladder_document_is_saved(LadderDocument *document)
{
	return history_is_saved(document->history) && document->disk != DISK_GONE;
}

int ladder_document_repaired(LadderDocument *document)
{
	return document->repaired;
}
