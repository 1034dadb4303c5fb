/* SPDX-License-Identifier: MIT
 *
 * test_ladder - the facade: all kinds of loads in sequence, includes, and saves that
 * leave the old file or the new one.
 */
#define _XOPEN_SOURCE 700 /* mkdtemp, symlink, setrlimit */
#include "engine/ladder.h"
#include "engine/base/file.h"
#include "engine/xref/xref.h"
#include "tests/tap.h"

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static const char good[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO I0 | COIL Q0 |\nEND_PROGRAM\n";
static const char wrong[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO Nobody | COIL Q0 |\nEND_PROGRAM\n";
static const char broken[] = "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO | |\n";

static char folder[64];
static struct diag_list diags;

/* A path in the folder of this test; eight are valid at a time. */
static const char *in_folder(const char *name)
{
	static char path[8][160];
	static int next;
	char *out = path[next++ % 8];

	snprintf(out, sizeof(path[0]), "%s/%s", folder, name);
	return out;
}

static void put(const char *name, const char *text)
{
	diag_init(&diags);
	CHECK(file_save(in_folder(name), text, strlen(text), &diags));
}

static bool holds(const char *name, const char *text)
{
	size_t len = 0;
	char *bytes = file_read(in_folder(name), 1 << 20, &len, NULL);
	bool same = bytes && len == strlen(text) && !memcmp(bytes, text, len);

	free(bytes);
	return same;
}

static int files(void)
{
	DIR *dir = opendir(folder);
	int count = 0;

	while (dir && readdir(dir))
		count++;
	if (dir)
		closedir(dir);
	return count - 2;
}

static bool has(struct ladder *ladder, enum diag_id id)
{
	const struct diag_list *list = ladder_diags(ladder);

	for (int i = 0; i < list->count; i++)
		if (list->diag[i].id == id)
			return true;
	return false;
}

static bool load(struct ladder *ladder, const char *text)
{
	return ladder_load_text(ladder, "text.rung", text, strlen(text));
}

/* A load leaves nothing behind for the next one. */
static void loads_again_and_again(void)
{
	struct ladder *ladder = ladder_new();
	size_t len;
	int count;

	CHECK(!ladder_build(ladder) && !ladder_program(ladder));
	CHECK(!ladder_project(ladder) && !ladder_il(ladder, 0));
	CHECK(!ladder_temporaries(ladder, 0, &count) && count == 0);
	CHECK(!ladder_image(ladder, &len) && len == 0 && !ladder_write(ladder, &len));
	CHECK(load(ladder, good) && ladder_project(ladder));
	CHECK_AS(!ladder_program(ladder) && !ladder_il(ladder, 0),
		 "a loaded project has no program before it is built");
	CHECK(ladder_build(ladder) && ladder_build(ladder));
	CHECK(ladder_program(ladder) && ladder_il(ladder, 0) && !ladder_il(ladder, 1));
	CHECK(!ladder_il(ladder, -1) && ladder_memory(ladder) > 0);
	CHECK(load(ladder, wrong) && !ladder_program(ladder));
	CHECK(!ladder_build(ladder) && !ladder_build(ladder));
	CHECK(has(ladder, DIAG_UNKNOWN_NAME) && !ladder_program(ladder));
	CHECK_AS(ladder_project(ladder) != NULL,
		 "a program with errors leaves its project");
	CHECK(!load(ladder, broken) && !ladder_project(ladder));
	CHECK(!ladder_build(ladder) && !ladder_write(ladder, &len));
	CHECK(load(ladder, good) && ladder_diags(ladder)->count == 0);
	CHECK(ladder_build(ladder) && ladder_image(ladder, &len) && len > 0);
	CHECK(!load(ladder, "") && has(ladder, DIAG_EMPTY_FILE));
	CHECK(ladder_could_read(ladder) && !ladder_image(ladder, &len) && len == 0);
	ladder_free(ladder);
	ladder_free(NULL);
}

static void loads_images(void)
{
	struct ladder *ladder = ladder_new(), *other = ladder_new();
	size_t len, again;
	const void *image;

	CHECK(load(ladder, good) && ladder_build(ladder));
	image = ladder_image(ladder, &len);
	CHECK(ladder_load_text(other, "it.rungc", image, len));
	CHECK_AS(ladder_program(other) && !ladder_project(other),
		 "a loaded image has a program and no project");
	CHECK(ladder_build(other) && !ladder_il(other, 0));
	CHECK(ladder_image(other, &again) != image && again == len);
	CHECK(!ladder_write(other, &again));
	CHECK(!ladder_load_text(other, "cut", image, len - 1));
	CHECK(has(other, DIAG_IMAGE_DAMAGED) && !ladder_program(other));
	CHECK(!ladder_build(other) && !ladder_image(other, &again));
	CHECK(file_save(in_folder("p.rungc"), image, len, NULL));
	CHECK(ladder_load(other, in_folder("p.rungc")) && ladder_program(other));
	CHECK(load(other, good) && !ladder_program(other) && ladder_build(other));
	ladder_free(other);
	ladder_free(ladder);
}

static void tells_what_it_cannot_read(void)
{
	struct ladder *ladder = ladder_new();
	const char *fifo = in_folder("pipe");

	CHECK(!ladder_load(ladder, in_folder("missing.rung")));
	CHECK(has(ladder, DIAG_CANNOT_READ) && !ladder_could_read(ladder));
	CHECK(!ladder_load(ladder, folder) && has(ladder, DIAG_NOT_A_FILE));
	CHECK(!ladder_could_read(ladder));
	CHECK(mkfifo(fifo, 0600) == 0 && !ladder_load(ladder, fifo));
	CHECK_AS(has(ladder, DIAG_NOT_A_FILE),
		 "a FIFO without a writer is refused at once");
	unlink(fifo);
	put("broken.rung", broken);
	CHECK(!ladder_load(ladder, in_folder("broken.rung")));
	CHECK_AS(ladder_could_read(ladder),
		 "ladder_could_read() is true for a file with errors");
	put("good.rung", good);
	CHECK(ladder_load(ladder, in_folder("good.rung")) && ladder_could_read(ladder));
	ladder_free(ladder);
	size_t len;

	diag_init(&diags);
	CHECK(!file_read(in_folder("good.rung"), 10, &len, &diags));
	CHECK(diags.diag[0].id == DIAG_TOO_LARGE);
	CHECK(!file_read(in_folder("missing"), 10, &len, NULL));
}

static void includes_files(void)
{
	struct ladder *ladder = ladder_new();

	mkdir(in_folder("sub"), 0700);
	put("main.rung", "RUNGBOARD 1\nINCLUDE \"sub/one.rung\"\n");
	put("sub/one.rung", "RUNGBOARD 1\nINCLUDE \"two.rung\"\n"
	    "PROGRAM One LD\nRUNG\n  | NO I0 | COIL Lamp |\nEND_PROGRAM\n");
	put("sub/two.rung", "RUNGBOARD 1\nVAR\n  Lamp AT %QX0.1 : BOOL;\nEND_VAR\n");
	CHECK(ladder_load(ladder, in_folder("main.rung")) && ladder_build(ladder));
	CHECK_AS(ladder_project(ladder)->pou_count == 1,
		 "INCLUDE names a file beside the including file");
	put("sub/two.rung", "RUNGBOARD 1\nINCLUDE \"one.rung\"\n");
	CHECK(!ladder_load(ladder, in_folder("main.rung")));
	CHECK_AS(has(ladder, DIAG_INCLUDE_CIRCLE),
		 "two files that include each other are refused");
	put("main.rung", "RUNGBOARD 1\nINCLUDE \"main.rung\"\n");
	CHECK(!ladder_load(ladder, in_folder("main.rung")) &&
	      has(ladder, DIAG_INCLUDE_CIRCLE));
	put("main.rung", "RUNGBOARD 1\nINCLUDE \"nothing.rung\"\n");
	CHECK(!ladder_load(ladder, in_folder("main.rung")) &&
	      has(ladder, DIAG_BAD_INCLUDE));
	CHECK_AS(ladder_could_read(ladder),
		 "ladder_could_read() is true if only an included file is missing");
	put("main.rung", "RUNGBOARD 1\nINCLUDE \"../sub/two.rung\"\n");
	CHECK_AS(!ladder_load(ladder, in_folder("main.rung")),
		 "INCLUDE with .. is refused");
	put("main.rung", "RUNGBOARD 1\nINCLUDE \"/etc/hostname\"\n");
	CHECK_AS(!ladder_load(ladder, in_folder("main.rung")),
		 "INCLUDE with an absolute path is refused");
	put("sub/two.rung", broken);
	put("main.rung", "RUNGBOARD 1\nINCLUDE \"sub/two.rung\"\n");
	CHECK(!ladder_load(ladder, in_folder("main.rung")));
	const char *file = ladder_diags(ladder)->diag[0].file;

	CHECK_TEXT(file + strlen(folder), "/sub/two.rung");
	ladder_free(ladder);
	unlink(in_folder("sub/one.rung"));
	unlink(in_folder("sub/two.rung"));
	rmdir(in_folder("sub"));
}

static int freed;

static char *text_of(void *context, const char *path, size_t *len)
{
	const char *text = context;

	if (strcmp(path + strlen(folder), "/part.rung") != 0)
		return NULL;
	*len = strlen(text);
	return strdup(text);
}

static void count_free(void *context)
{
	(void)context;
	freed++;
}

/* Texts of the caller come before files, also when a rename reads the project again. */
static void takes_files(void)
{
	static char part[] = "RUNGBOARD 1\nPROGRAM Part LD\nRUNG\n  | NO I0 | COIL Lamp |\n"
			     "END_PROGRAM\n";
	struct ladder *ladder = ladder_new();
	const struct xref_target lamp = { .what = XREF_VARIABLE, .index = 0 };
	struct ladder_rename how;
	size_t len;

	put("part.rung", broken);
	put("main.rung", "RUNGBOARD 1\nVAR\n  Lamp : BOOL;\n  Spare : BOOL;\nEND_VAR\n"
	    "INCLUDE \"part.rung\"\n");
	CHECK(!ladder_load(ladder, in_folder("main.rung")));
	ladder_set_files(ladder, &(struct ladder_files){ text_of, part, true, count_free });
	CHECK(ladder_load(ladder, in_folder("main.rung")) && ladder_build(ladder) && !freed);
	CHECK(!ladder_rename(ladder, &lamp, "Light", &len, &how) && how.why == RENAME_OTHER_FILE);
	char *text = ladder_rename(ladder, &(struct xref_target){ .what = XREF_VARIABLE, .index = 1 },
				   "Other", &len, &how);

	CHECK(text && strstr(text, "Other"));
	free(text);
	unlink(in_folder("part.rung"));
	CHECK(ladder_load(ladder, in_folder("main.rung")));
	ladder_free(ladder);
	CHECK(freed == 1);
}

static void saves(void)
{
	struct stat status;

	put("new.rung", "one");
	CHECK(holds("new.rung", "one"));
	CHECK(chmod(in_folder("new.rung"), 0640) == 0);
	put("new.rung", "two");
	CHECK(holds("new.rung", "two") && stat(in_folder("new.rung"), &status) == 0);
	CHECK_AS((status.st_mode & 07777) == 0640, "a saved file keeps its mode");
	put("new.rung", "");
	CHECK(holds("new.rung", ""));
	CHECK(symlink("new.rung", in_folder("link.rung")) == 0);
	put("link.rung", "three");
	CHECK(holds("new.rung", "three") && lstat(in_folder("link.rung"), &status) == 0);
	CHECK_AS(S_ISLNK(status.st_mode), "a saved link stays a link");
	int before = files();

	diag_init(&diags);
	CHECK(!file_save(folder, "x", 1, &diags));
	CHECK(diags.diag[0].id == DIAG_NOT_A_FILE);
	CHECK(!file_save("/dev/null", "x", 1, NULL));
	CHECK(!file_save(in_folder("none/x.rung"), "x", 1, &diags));
	CHECK(diags.diag[1].id == DIAG_CANNOT_WRITE && files() == before);
	unlink(in_folder("link.rung"));
}

/* Saves to a disk that is full after the first bytes. */
static void keeps_the_old_file(void)
{
	static char big[100000];
	struct rlimit old, small;
	int before = files();

	put("new.rung", "old");
	memset(big, 'x', sizeof(big));
	signal(SIGXFSZ, SIG_IGN);
	CHECK(getrlimit(RLIMIT_FSIZE, &old) == 0);
	small = old;
	small.rlim_cur = 4096;
	diag_init(&diags);
	fflush(stdout); /* stdout may be a file */
	setrlimit(RLIMIT_FSIZE, &small);
	bool saved = file_save(in_folder("new.rung"), big, sizeof(big),
				      &diags);
	setrlimit(RLIMIT_FSIZE, &old);
	CHECK(!saved);
	CHECK(diags.count == 1 && diags.diag[0].id == DIAG_CANNOT_WRITE);
	CHECK(diags.diag[0].arg[0] != '\0');
	CHECK(holds("new.rung", "old"));
	CHECK_AS(files() == before, "a failed save leaves no other file");
}

/* Skipped for root, who may read and write every folder. */
static void takes_closed_folders(void)
{
	if (geteuid() == 0)
		return;
	CHECK(chmod(folder, 0500) == 0);
	CHECK(!file_save(in_folder("new.rung"), "x", 1, NULL));
	CHECK(holds("new.rung", "old") && chmod(folder, 0300) == 0);
	CHECK_AS(file_save(in_folder("new.rung"), "y", 1, NULL),
		 "a file in a folder without read permission is saved");
	CHECK(chmod(folder, 0700) == 0 && holds("new.rung", "y"));
}

static void clean(void)
{
	static const char *const name[] = { "new.rung", "main.rung", "good.rung",
		"broken.rung", "p.rungc" };

	for (size_t i = 0; i < sizeof(name) / sizeof(name[0]); i++)
		unlink(in_folder(name[i]));
	CHECK_AS(rmdir(folder) == 0, "the tests left no other file");
}

int main(void)
{
	const char *tmp = getenv("TMPDIR");

	snprintf(folder, sizeof(folder), "%.40s/ladderXXXXXX", tmp ? tmp : "/tmp");
	if (!CHECK(mkdtemp(folder) != NULL))
		return tap_done();
	loads_again_and_again();
	loads_images();
	tells_what_it_cannot_read();
	includes_files();
	takes_files();
	saves();
	keeps_the_old_file();
	takes_closed_folders();
	clean();
	return tap_done();
}
