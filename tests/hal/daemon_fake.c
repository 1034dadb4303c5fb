/* SPDX-License-Identifier: MIT
 *
 * daemon_fake - ladderd with fake chips, for faults in which a line fails or a driver
 * hangs. The environment controls the chips:
 *
 *   FAKE_DEV      folder in place of /dev
 *   FAKE_FAIL_AT  reads fail from this one on, until FAKE_HEAL_AT
 *   FAKE_DEAF_AT  writes fail from this one on, until FAKE_HEAR_AT
 *   FAKE_SLOW_AT  reads take 15 ms from this one on
 *   FAKE_SLOW_MS  takes as long as this; FAKE_SLOW_EACH: only every N-th read
 *   FAKE_HANG_AT  this read never returns
 *   FAKE_CRASH_AT this read ends in SIGSEGV
 *   FAKE_SYNC_HANGS  fdatasync() waits while there is this file
 */
#include "tests/hal/fake.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

DIR *__real_opendir(const char *path);
DIR *__wrap_opendir(const char *path);

DIR *__wrap_opendir(const char *path)
{
	const char *dev = getenv("FAKE_DEV");

	return __real_opendir(dev && strcmp(path, "/dev") == 0 ? dev : path);
}

int __real_fdatasync(int fd);
int __wrap_fdatasync(int fd);

int __wrap_fdatasync(int fd)
{
	const char *path = getenv("FAKE_SYNC_HANGS");
	const struct timespec nap = { 0, 5000000 };

	while (path && access(path, F_OK) == 0)
		nanosleep(&nap, NULL);
	return __real_fdatasync(fd);
}

static long number(const char *name)
{
	const char *text = getenv(name);

	return text ? strtol(text, NULL, 10) : 0;
}

/* Sleeps the whole time, also if signals arrive. */
static void be_slow(void)
{
	long ms = number("FAKE_SLOW_MS");
	struct timespec left = { 0, (ms ? ms : 15) * 1000000 };

	while (nanosleep(&left, &left) != 0)
		;
}

static bool is_slow(long reads)
{
	long from = number("FAKE_SLOW_AT"), each = number("FAKE_SLOW_EACH");

	return from && reads >= from && (!each || reads % each == 0);
}

static void at_write(void)
{
	long deaf = number("FAKE_DEAF_AT"), hear = number("FAKE_HEAR_AT");

	fake.write_error = deaf && fake.writes >= deaf &&
			   !(hear && fake.writes >= hear) ? EIO : 0;
}

static void at_read(void)
{
	long fail = number("FAKE_FAIL_AT"), heal = number("FAKE_HEAL_AT");
	long reads = fake.reads;

	fake.read_error = fail && reads >= fail && !(heal && reads >= heal) ?
			  EIO : 0;
	if (is_slow(reads))
		be_slow();
	if (number("FAKE_CRASH_AT") == reads)
		raise(SIGSEGV);
	while (number("FAKE_HANG_AT") && reads == number("FAKE_HANG_AT"))
		pause();
}

static void set_up(void)
{
	static const char *const names[] = { "IN0", "IN1", "OUT0", "OUT1" };

	if (fake.chip[0].present)
		return;
	fake.chip[0].label = "panel";
	fake.chip[0].lines = 4;
	fake.chip[0].present = true;
	for (int i = 0; i < 4; i++)
		fake.chip[0].line[i].name = names[i];
	fake.chip[0].line[0].level = 1;
}

__attribute__((constructor)) static void begin(void)
{
	fake_at_open = set_up;
	fake_at_read = at_read;
	fake_at_write = at_write;
}
