/* SPDX-License-Identifier: MIT
 *
 * test_link - a desk changes the program of a board with real lines: over a socket, and over two
 * terminals that stand for a serial line.
 */
#define _GNU_SOURCE /* posix_openpt(), cfmakeraw() */
#include "tests/targets/guest/panel.h"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#define LADDER "/ladder"

struct terminal {
	int master, slave;
	char path[32];
};

static bool terminal_open(struct terminal *terminal)
{
	struct termios mode;
	const char *path;

	terminal->master = posix_openpt(O_RDWR | O_NOCTTY);
	if (terminal->master < 0 || unlockpt(terminal->master) != 0)
		return false;
	path = ptsname(terminal->master);
	snprintf(terminal->path, sizeof(terminal->path), "%s", path ? path : "");
	terminal->slave = open(terminal->path, O_RDWR | O_NOCTTY);
	if (terminal->slave < 0 || tcgetattr(terminal->slave, &mode) != 0)
		return false;
	cfmakeraw(&mode);
	return tcsetattr(terminal->slave, TCSANOW, &mode) == 0;
}

static void copy(const struct terminal *from, const struct terminal *to)
{
	char bytes[512];
	const ssize_t got = read(from->master, bytes, sizeof(bytes));

	if (got > 0 && write(to->master, bytes, (size_t)got) != got)
		note("the terminal takes no more");
}

/* The wire between both terminals, while the desk runs. */
static void carry(struct child *desk, const struct terminal end[2])
{
	const int64_t until_ns = clock_now() + 5 * LIMIT_MS * MS;
	int status;

	while (clock_now() < until_ns) {
		struct pollfd both[2] = { { .fd = end[0].master, .events = POLLIN },
					  { .fd = end[1].master, .events = POLLIN } };

		if (waitpid(desk->pid, &status, WNOHANG) == desk->pid) {
			desk->ended = true;
			desk->status = WIFEXITED(status) ? WEXITSTATUS(status) : CHILD_SIGNAL;
			return;
		}
		if (poll(both, 2, 5) <= 0)
			continue;
		for (int i = 0; i < 2; i++)
			if (both[i].revents & POLLIN)
				copy(&end[i], &end[!i]);
	}
}

/* Runs `ladder board WHERE WORD…`; returns its exit status. @end: NULL: no serial line. */
static int desk(const struct terminal end[2], const char *where, const char *word,
		const char *one, const char *two, const char *three)
{
	const char *const argv[] = { LADDER, "board", where, word, one, two, three, NULL };
	struct child child;
	int status;

	child_start(&child, 1, argv);
	if (end)
		carry(&child, end);
	status = child.ended ? child.status : child_end(&child);
	if (status)
		note("ladder board %s: %s", word, child_err(&child));
	return status;
}

static void use(const struct terminal end[2], const char *where, const char *name)
{
	static char record[PATH_MOST];
	struct stat about;

	snprintf(record, sizeof(record), "%s/act.record", guest.work);
	check(desk(end, where, "status", NULL, NULL, NULL) == 0, "%s: status", name);
	check(desk(end, where, "force", "%QX0.0=1", NULL, NULL) == 0 && panel_shows(0xd),
	      "%s: a forced output has its level", name);
	check(desk(end, where, "unforce", NULL, NULL, NULL) == 0 && panel_shows(0xc),
	      "%s: released, the program drives it again", name);
	check(desk(end, where, "download", file_case("other.rung"),
		   file_text("other.io", PANEL_PLAIN), "--yes") == 0 && panel_shows(0x2),
	      "%s: another program drives the lines", name);
	check(desk(end, where, "record", "-o", record, NULL) == 0 && stat(record, &about) == 0 &&
	      about.st_size > 0, "%s: a record of it", name);
	unlink(record);
	check(desk(end, where, "download", file_case("panel.rung"),
		   file_text("again.io", PANEL_PLAIN), "--yes") == 0 && panel_shows(0xc),
	      "%s: the first program again", name);
}

static void forget(const char *folder)
{
	DIR *files = opendir(folder);
	const struct dirent *file;

	while (files && (file = readdir(files)) != NULL) {
		char path[PATH_MOST + 300];

		snprintf(path, sizeof(path), "%s/%s", folder, file->d_name);
		unlink(path);
	}
	if (files)
		closedir(files);
	rmdir(folder);
}

void test_link(void)
{
	static char socket[PATH_MOST], where[PATH_MOST + 8], slots[PATH_MOST], line[48];
	struct terminal end[2];
	struct child child;
	bool lines;

	if (!file_is_there(LADDER)) {
		skip("the command line is not on this machine", "a desk");
		return;
	}
	mkdir("/dev/pts", 0755);
	mount("devpts", "/dev/pts", "devpts", 0, "ptmxmode=0666");
	lines = terminal_open(&end[0]) && terminal_open(&end[1]);
	snprintf(socket, sizeof(socket), "%s/link", guest.work);
	snprintf(where, sizeof(where), "unix:%s", socket);
	snprintf(slots, sizeof(slots), "%s/slots", guest.work);
	mkdir(slots, 0755);
	panel_up(-1);
	ladderd_start(&child, file_case("panel.rung"), file_text("link.io", PANEL_PLAIN), "--link",
		      socket, "--slots", slots, lines ? "--serial" : NULL, end[1].path, NULL);
	if (check(child_ready() != 0 && panel_shows(0xc), "runs with a link")) {
		/* Root has no role at the socket, and it has no group here. */
		if (lines) {
			snprintf(line, sizeof(line), "serial:%s", end[0].path);
			use(end, line, "serial line");
		} else {
			skip("this kernel has no terminals", "serial line");
		}
		check(desk(NULL, where, "status", NULL, NULL, NULL) == 1,
		      "socket: root without a group is refused");
	}
	check(child_stop(&child) == 0, "ends");
	panel_down();
	forget(slots);
}
