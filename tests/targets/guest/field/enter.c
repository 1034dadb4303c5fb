/* SPDX-License-Identifier: MIT
 *
 * enter - in a guest of User Mode Linux, runs a command with the programs of the machine outside: their
 * disk is mounted read-only, and the guest's own /dev, /proc, /sys and /run are mounted over it.
 *
 *   enter FOLDER COMMAND [ARGUMENT...]
 *
 * It knows nothing of what it runs.
 */
#define _GNU_SOURCE /* chroot */

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#define OUTSIDE "/outside"

static void attach(const char *type, const char *folder, unsigned long flags, const char *options)
{
	mkdir(folder, 0755);
	if (mount(type, folder, type, flags, options) == 0)
		return;
	fprintf(stderr, "# enter: mount %s on %s: %s\n", type, folder, strerror(errno));
	exit(1);
}

int main(int argc, char **argv)
{
	static char *const environment[] = {
		"PATH=/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin", "HOME=/run", "TMPDIR=/run", "LC_ALL=C.UTF-8",
		"PYTHONDONTWRITEBYTECODE=1", NULL,
	};

	if (argc < 3) {
		fprintf(stderr, "usage: enter FOLDER COMMAND [ARGUMENT...]\n");
		return 2;
	}
	attach("hostfs", OUTSIDE, MS_RDONLY, "/");
	attach("devtmpfs", OUTSIDE "/dev", 0, NULL);
	attach("devpts", OUTSIDE "/dev/pts", 0, "ptmxmode=0666");
	attach("tmpfs", OUTSIDE "/dev/shm", 0, NULL);
	attach("proc", OUTSIDE "/proc", 0, NULL);
	attach("sysfs", OUTSIDE "/sys", 0, NULL);
	attach("configfs", OUTSIDE "/sys/kernel/config", 0, NULL);
	attach("tmpfs", OUTSIDE "/run", 0, NULL);
	if (chroot(OUTSIDE) != 0 || chdir(argv[1]) != 0) {
		fprintf(stderr, "# enter: %s: %s\n", argv[1], strerror(errno));
		return 1;
	}
	execve(argv[2], argv + 2, environment);
	fprintf(stderr, "# enter: %s: %s\n", argv[2], strerror(errno));
	return 127;
}
