/* SPDX-License-Identifier: MIT
 *
 * test_disk - files are read and saved whole or not at all, links and modes stay, and
 * changes by other programs are noticed. No display.
 */
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/document.h"

#include "tests/tap.h"

#include <fcntl.h>
#include <glib/gstdio.h>
#include <utime.h>
#include <sys/stat.h>
#include <unistd.h>

static const char SAMPLE[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO I0 | COIL Q0 |\nEND_PROGRAM\n";

/* A new folder and a path in it. */
struct spot {
	char *folder, *path;
};

static struct spot spot_new(void)
{
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL);

	return (struct spot){ folder, g_build_filename(folder, "a.rung", NULL) };
}

static void spot_free(struct spot *spot)
{
	g_unlink(spot->path);
	g_rmdir(spot->folder);
	g_free(spot->path);
	g_free(spot->folder);
}

static bool holds(const char *path, const char *want)
{
	char *got = NULL;
	const bool same = g_file_get_contents(path, &got, NULL, NULL) &&
		strcmp(got, want) == 0;

	g_free(got);
	return same;
}

/* Is the file refused, with its name and this reason? */
static bool refused(const char *path, gsize limit, const char *why)
{
	GError *error = NULL;
	gsize len;
	char *text = disk_read(path, limit, &len, &error);
	const bool good = !text && error && g_str_has_prefix(error->message, path) &&
		strstr(error->message, why);

	if (!good)
		printf("# %s: %s\n", path, text ? "the file was read" :
		       error ? error->message : "refused without a reason");
	g_free(text);
	g_clear_error(&error);
	return good;
}

static void test_disk_read(void)
{
	struct spot spot = spot_new();
	gsize len = 7;
	char *text;

	CHECK(refused(spot.path, 100, "No such file"));
	CHECK(refused(spot.folder, 100, "not a regular file"));
	CHECK(refused("/dev/zero", 100, "not a regular file"));
	CHECK(mkfifo(spot.path, 0600) == 0 &&
	      refused(spot.path, 100, "not a regular file"));
	g_unlink(spot.path);
	CHECK(g_file_set_contents(spot.path, "", 0, NULL));
	text = disk_read(spot.path, 100, &len, NULL);
	CHECK_AS(text && len == 0 && text[0] == '\0', "an empty file is read");
	g_free(text);
	CHECK(g_file_set_contents(spot.path, "a\0b", 3, NULL));
	text = disk_read(spot.path, 3, &len, NULL);
	CHECK_AS(text && len == 3 && memcmp(text, "a\0b", 4) == 0, "a NUL in a file is kept, and one is added");
	g_free(text);
	CHECK_AS(refused(spot.path, 2, "too large: 3 bytes, at most 2 bytes"),
		 "the message has the size and the limit");
	CHECK(!disk_read(spot.path, 2, &len, NULL));
	spot_free(&spot);
}

static void test_disk_save(void)
{
	struct spot spot = spot_new();
	char *link = g_build_filename(spot.folder, "link", NULL);
	char *beyond = g_build_filename(spot.path, "b.rung", NULL), *to;
	GError *error = NULL;
	GStatBuf about;

	CHECK(disk_save(spot.path, "one", 3, NULL) && holds(spot.path, "one"));
	CHECK(g_chmod(spot.path, 0640) == 0 && symlink("a.rung", link) == 0);
	CHECK(disk_save(link, "two", 3, NULL) && holds(spot.path, "two"));
	to = g_file_read_link(link, NULL);
	CHECK_TEXT(to, "a.rung");
	CHECK_AS(g_stat(spot.path, &about) == 0 && (about.st_mode & 0777) == 0640,
		 "a saved file keeps its permissions");
	CHECK(!disk_save(beyond, "x", 1, &error) && error);
	CHECK(error && g_str_has_prefix(error->message, beyond));
	CHECK(!disk_save(spot.folder, "x", 1, NULL) && holds(spot.path, "two"));
	g_clear_error(&error);
	g_unlink(link);
	g_free(to);
	g_free(link);
	g_free(beyond);
	spot_free(&spot);
}

/* Keeps the time of @when, so that the file looks unchanged. */
static bool write_at(const char *path, const char *text, const GStatBuf *when)
{
	const struct timespec times[] = { when->st_atim, when->st_mtim };
	FILE *file = g_fopen(path, "r+");
	bool good = file && fputs(text, file) >= 0;

	return file && fclose(file) == 0 && good && utimensat(AT_FDCWD, path, times, 0) == 0;
}

static void test_disk_changed(void)
{
	struct spot spot = spot_new();
	LadderDocument *document = ladder_document_new();
	GStatBuf about;
	char *text;

	CHECK_AS(ladder_document_disk(document) == DISK_AS_READ, "a new document has no file");
	CHECK(g_file_set_contents(spot.path, SAMPLE, -1, NULL));
	CHECK(ladder_document_open(document, spot.path, NULL));
	CHECK(ladder_document_disk(document) == DISK_AS_READ);
	CHECK(g_utime(spot.path, NULL) == 0);
	CHECK_AS(ladder_document_disk(document) == DISK_AS_READ, "a new time with the same bytes is no change");
	CHECK(g_stat(spot.path, &about) == 0 && write_at(spot.path, "rUNG", &about));
	CHECK_AS(ladder_document_disk(document) == DISK_AS_READ,
		 "a file with the same time is not read again");
	CHECK(g_utime(spot.path, NULL) == 0);
	CHECK(ladder_document_disk(document) == DISK_OTHER);
	CHECK_AS(ladder_document_disk(document) == DISK_OTHER, "a change is reported each time");
	CHECK(g_file_set_contents(spot.path, SAMPLE, -1, NULL));
	CHECK_AS(ladder_document_disk(document) == DISK_AS_READ, "a file that has its old text again is unchanged");
	g_unlink(spot.path);
	CHECK_AS(ladder_document_disk(document) == DISK_GONE, "a missing file is reported");
	CHECK(mkfifo(spot.path, 0600) == 0);
	CHECK_AS(ladder_document_disk(document) == DISK_AS_READ, "a pipe does not block");
	g_unlink(spot.path);
	CHECK(g_file_set_contents(spot.path, "other", -1, NULL));
	CHECK(ladder_document_disk(document) == DISK_OTHER);
	text = ladder_document_text(document, NULL);
	CHECK(ladder_document_save(document, NULL, NULL) && holds(spot.path, text));
	CHECK_AS(ladder_document_disk(document) == DISK_AS_READ, "a save ends the change");
	g_free(text);
	g_object_unref(document);
	spot_free(&spot);
}

int main(void)
{
	test_disk_read();
	test_disk_save();
	test_disk_changed();
	return tap_done();
}
