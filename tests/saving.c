/* SPDX-License-Identifier: MIT
 *
 * saving - a save is cut off at its 1st, 2nd, 3rd … call of the system, by an error and
 * by a kill: the result is the complete old file or the complete new one.
 *
 * Linked with --wrap, so that the calls of file_save() come through here. A power cut
 * cannot be tested directly; the order of calls shows that the file is on the disk
 * before it gets its name, and the name before the save succeeds.
 */
#include "engine/ladder.h"
#include "engine/base/file.h"
#include "tests/tap.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#define STEPS_MAX 40
#define SHORT_MOST 3

ssize_t __real_write(int fd, const void *bytes, size_t len);
int __real_fsync(int fd);
int __real_rename(const char *from, const char *to);
ssize_t __wrap_write(int fd, const void *bytes, size_t len);
int __wrap_fsync(int fd);
int __wrap_rename(const char *from, const char *to);

static char calls[STEPS_MAX + 1];
static int step, fail_at, kill_at; /* counted from 1; 0: never                */
static bool is_short, is_interrupted, for_ever; /* `for_ever`: all calls from there on fail */

static const char old_text[] = "the old file\n";
static const char new_text[] = "the new file, which is longer\n";
static char folder[200], path[250];

/* One call of the system: false if it must fail. */
static bool pass(char name)
{
	if (step < STEPS_MAX)
		calls[step] = name;
	step++;
	if (step == kill_at)
		_exit(0);
	errno = EIO;
	return for_ever ? step < fail_at : step != fail_at;
}

ssize_t __wrap_write(int fd, const void *bytes, size_t len)
{
	if (!pass('w'))
		return -1;
	if (is_interrupted && step == 1) {
		errno = EINTR;
		return -1;
	}
	return __real_write(fd, bytes,
			    is_short && len > SHORT_MOST ? SHORT_MOST : len);
}

int __wrap_fsync(int fd)
{
	return pass('s') ? __real_fsync(fd) : -1;
}

int __wrap_rename(const char *from, const char *to)
{
	return pass('n') ? __real_rename(from, to) : -1;
}

static void put_old(void)
{
	FILE *file = fopen(path, "w");

	if (!file)
		return;
	fputs(old_text, file);
	fclose(file);
}

/* The content: 'o', 'n', or '?' for anything else. */
static char look(void)
{
	char text[100] = "";
	FILE *file = fopen(path, "r");
	size_t len;

	if (!file)
		return '?';
	len = fread(text, 1, sizeof(text) - 1, file);
	text[len] = '\0';
	fclose(file);
	return strcmp(text, old_text) == 0 ? 'o' :
	       strcmp(text, new_text) == 0 ? 'n' : '?';
}

/* Number of files in the folder; @clear: removes all but one. */
static int count_files(bool clear)
{
	DIR *dir = opendir(folder);
	struct dirent *entry;
	char name[600];
	int count = 0;

	while (dir && (entry = readdir(dir)) != NULL) {
		if (entry->d_name[0] == '.')
			continue;
		count++;
		snprintf(name, sizeof(name), "%s/%s", folder, entry->d_name);
		if (clear && strcmp(name, path) != 0)
			unlink(name);
	}
	if (dir)
		closedir(dir);
	return count;
}

static struct diag_list diags;

static bool save(int failing, int killing)
{
	memset(calls, 0, sizeof(calls));
	step = 0;
	fail_at = failing;
	kill_at = killing;
	diag_init(&diags);
	return file_save(path, new_text, strlen(new_text), &diags);
}

static void test_order(void)
{
	put_old();
	CHECK(save(0, 0) && look() == 'n');
	CHECK_AS(strcmp(calls, "wsns") == 0,
		 "a save writes, syncs the file, renames it and syncs the folder");
	CHECK(count_files(false) == 1);
	unlink(path);
	CHECK_AS(save(0, 0) && look() == 'n', "a new file is saved");
	put_old();
	is_short = true;
	CHECK_AS(save(0, 0) && look() == 'n',
		 "a file that is written in small pieces is saved");
	is_short = false;
	is_interrupted = true;
	CHECK_AS(save(0, 0) && look() == 'n',
		 "a write that a signal interrupts is repeated");
	is_interrupted = false;
}

static mode_t mode(void)
{
	struct stat status;

	return stat(path, &status) == 0 ? status.st_mode & 0777 : 0;
}

static void test_mode(void)
{
	unlink(path);
	CHECK_AS(save(0, 0) && mode() == 0644, "all may read a new file, its owner may write it");
	CHECK_AS(chmod(path, 0640) == 0 && save(0, 0) && mode() == 0640,
		 "a file keeps who may read and write it");
}

/* Each call fails once, then each and all behind it. The last one syncs the folder. */
static void test_errors(void)
{
	int count;

	is_short = true;
	put_old();
	CHECK(save(0, 0));
	count = step;
	CHECK(count > 10 && count < STEPS_MAX / 2);
	for (int failing = 1; failing <= count; failing++) {
		put_old();
		CHECK_AS(save(failing, 0) && look() == 'n' && diags.count == 0,
			 "after one failed call it is tried again, and the new file is saved");
		CHECK_AS(count_files(false) == 1, "no other file is left");
	}
	for_ever = true;
	for (int failing = 1; failing < count; failing++) {
		put_old();
		CHECK_AS(!save(failing, 0) && look() == 'o' && diags.errors == 1,
			 "when calls go on to fail the old file is complete, and it is told");
		CHECK_AS(count_files(false) == 1, "no other file is left then");
	}
	put_old();
	CHECK_AS(save(count, 0) && look() == 'n',
		 "a folder that cannot be synced does not prevent the save");
	for_ever = false;
	CHECK_AS(diags.count == 1 && diags.errors == 0 &&
		 diags.diag[0].id == DIAG_NOT_SYNCED,
		 "a folder that cannot be synced gives a warning");
	is_short = false;
}

static void test_kills(void)
{
	int old = 0, new = 0;

	is_short = true;
	for (int killing = 1; killing <= 20; killing++) {
		pid_t child;
		char there;

		put_old();
		fflush(stdout);
		child = fork();
		if (child == 0) {
			save(0, killing);
			_exit(0);
		}
		waitpid(child, NULL, 0);
		there = look();
		old += there == 'o';
		new += there == 'n';
		count_files(true);
	}
	CHECK_AS(old + new == 20, "after a kill the old or the new file is complete");
	CHECK(old > 10 && new > 0);
	is_short = false;
}

int main(void)
{
	const char *root = getenv("TMPDIR");

	snprintf(folder, sizeof(folder), "%s/saving-XXXXXX",
		 root && strlen(root) < 150 ? root : "/tmp");
	if (!mkdtemp(folder)) {
		printf("Bail out! no folder for the test\n");
		return 1;
	}
	snprintf(path, sizeof(path), "%s/file", folder);
	test_order();
	test_mode();
	test_errors();
	test_kills();
	count_files(true);
	unlink(path);
	rmdir(folder);
	return tap_done();
}
