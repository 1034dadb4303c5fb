/* SPDX-License-Identifier: MIT
 *
 * power - a board whose power is cut: mounts its disk, tells what is on it, starts ladderd,
 * changes programs, and tells what it was told to be stored. It never ends by itself.
 *
 *   power TYPE          the disk is /dev/vda, with a file system of this type
 *   power overlay TYPE  the root is /dev/vdb, read-only, and /dev/vda an overlay above it
 *
 * A line for whoever holds the switch, each whole before the next one:
 *   ON DISK retain SEQ VALUE | slot SEQ BAD | event SEQ GAPS     at the start
 *   STORED retain SEQ | slot SEQ | event SEQ                     what must be there from now on
 */
#define _GNU_SOURCE
#include "engine/scan/retain.h"
#include "online/event.h"
#include "online/stored.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define FILE_MOST   (1u << 20)
#define SYNCED_NS   INT64_C(2500000000) /* an event is on the disk by then, twice over */
#define MS          1000000
#define SLOTS       "/data/var"

static uint8_t bytes[FILE_MOST];

static void say(const char *format, ...) __attribute__((format(printf, 1, 2)));
static void say(const char *format, ...)
{
	char line[200];
	va_list args;
	int len;

	va_start(args, format);
	len = vsnprintf(line, sizeof(line), format, args);
	va_end(args);
	if (write(1, line, (size_t)len) != len)
		exit(1);
}

static void must(int result, const char *what)
{
	if (result == 0)
		return;
	say("BROKEN %s: %s\n", what, strerror(errno));
	for (;;)
		pause();
}

static int64_t now_ns(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return now.tv_sec * INT64_C(1000000000) + now.tv_nsec;
}

static void rest(long ms)
{
	const struct timespec time = { ms / 1000, ms % 1000 * MS };

	nanosleep(&time, NULL);
}

static size_t get(const char *path)
{
	const int fd = open(path, O_RDONLY | O_CLOEXEC);
	ssize_t got = 0;
	size_t len = 0;

	while (fd >= 0 && (got = read(fd, bytes + len, sizeof(bytes) - len)) > 0)
		len += (size_t)got;
	if (fd >= 0)
		close(fd);
	return len;
}

/* A and B were equal after each scan. VALUE -1: a mix; 0: no copy. */
static void look_at_retain(void)
{
	struct retain_found found;
	struct retain_record record;
	uint32_t at = RETAIN_HEAD;
	int32_t value[2] = { 0, 0 };
	const size_t len = get(SLOTS "/keep");

	retain_find(bytes, len, &found);
	for (int i = 0; found.best >= 0 && i < 2; i++)
		if (retain_next(found.payload, found.len, &at, &record))
			memcpy(&value[i], record.value, sizeof(value[i]));
	say("ON DISK retain %u %d\n", found.best >= 0 ? (unsigned)found.seq : 0u,
	    value[0] == value[1] ? value[0] : -1);
}

static unsigned newest_slot(int *bad)
{
	struct slot slot;
	unsigned seq = 0;

	*bad = 0;
	for (int i = 0; i < 2; i++) {
		const size_t len = get(i ? SLOTS "/prog.B" : SLOTS "/prog.A");

		if (!len)
			continue;
		if (!slot_open(bytes, len, &slot))
			++*bad;
		else if (slot.seq > seq)
			seq = slot.seq;
	}
	return seq;
}

/* @gaps: numbers that are missing before the newest one. */
static unsigned newest_event(int *gaps)
{
	const size_t len = get(SLOTS "/events");
	struct event event;
	unsigned last = 0, count = 0;

	for (size_t at = 0; at + EVENT_BYTES <= len; at += EVENT_BYTES)
		if (event_open(bytes + at, &event)) {
			count++;
			last = event.seq > last ? event.seq : last;
		}
	*gaps = (int)((last < EVENT_RING ? last : EVENT_RING) - count);
	return last;
}

static void mount_disk(int count, char **argv)
{
	const char *type = argv[count - 1];

	mkdir("/data", 0755);
	if (count == 2) {
		must(mount("/dev/vda", "/data", type, 0, NULL), "mount");
	} else {
		mkdir("/lower", 0755);
		mkdir("/upper", 0755);
		must(mount("/dev/vdb", "/lower", "ext4", MS_RDONLY, NULL), "mount the root");
		must(mount("/dev/vda", "/upper", type, 0, NULL), "mount");
		mkdir("/upper/over", 0755);
		mkdir("/upper/work", 0755);
		must(mount("overlay", "/data", "overlay", 0,
			   "lowerdir=/lower,upperdir=/upper/over,workdir=/upper/work"), "overlay");
	}
	mkdir(SLOTS, 0755);
}

static pid_t start(const char *const *argv)
{
	static char *envp[] = { "PATH=/", "HOME=/", "TMPDIR=/tmp", NULL };
	pid_t child;

	must(posix_spawn(&child, argv[0], NULL, NULL, (char *const *)argv, envp), argv[0]);
	return child;
}

/* Replaces the program. Returns whether the board took it. */
static bool download(int turn)
{
	const char *const argv[] = { "/ladder", "board", "unix:/tmp/link", "download",
				     turn % 2 ? "/one.rung" : "/two.rung", "/board.io", "--yes", NULL };
	int status = 0;

	waitpid(start(argv), &status, 0);
	return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int main(int count, char **argv)
{
	static const char *ladderd[] = { "/ladderd", "/one.rung", "--io", "/board.io",
					       "--slots", SLOTS, "--retain", SLOTS "/keep", "--retain-period",
					       "10ms", "--period", "10ms", "--watchdog", "1000", "--link",
					       "/tmp/link", "--groups", "/group", NULL };
	unsigned seen = 0, event;
	int64_t since_ns = now_ns();
	int wrong;
	pid_t child;

	mount_disk(count, argv);
	say("MOUNTED\n");
	look_at_retain();
	event = newest_slot(&wrong);
	say("ON DISK slot %u %d\n", event, wrong);
	seen = newest_event(&wrong);
	say("ON DISK event %u %d\n", seen, wrong);
	if (count > 2)
		ladderd[0] = "/data/ladderd";
	child = start(ladderd);
	while (access("/tmp/link", F_OK) != 0 && waitpid(child, &wrong, WNOHANG) == 0)
		rest(10);
	for (int turn = 0;; turn++) {
		kill(child, SIGUSR1); /* "retain: copy N": it is stored */
		rest(30);
		if (turn % 2 == 1 && download(turn / 2))
			say("STORED slot %u\n", newest_slot(&wrong));
		if (waitpid(child, &wrong, WNOHANG) == child)
			say("BROKEN ladderd ended: %d\n", wrong);
		if (now_ns() - since_ns < SYNCED_NS)
			continue;
		if (seen)
			say("STORED event %u\n", seen);
		seen = newest_event(&wrong);
		since_ns = now_ns();
	}
}
