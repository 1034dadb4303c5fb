/* SPDX-License-Identifier: MIT
 *
 * ends - a record of fixed size: whether ladderd runs, since which start of the machine, when
 * it was found to have ended abnormally, CRC-32C. A damaged record counts as none.
 */
#define _GNU_SOURCE /* CLOCK_BOOTTIME */
#include "ladderd/ends.h"
#include "ladderd/disk.h"

#include "engine/base/digest.h"
#include "online/event.h"
#include "online/wire.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define MAGIC  "RUNGENDS"
#define BOOT   36 /* characters of boot_id */
#define RECORD (8 + 1 + BOOT + 8 * ENDS_MOST + 4)

struct ends {
	bool runs;
	uint8_t boot[BOOT];        /* the kernel's name of this start of the machine */
	int64_t time_s[ENDS_MOST]; /* the newest first; -1: none              */
};

static void tell(int error)
{
	fprintf(stderr, "ladderd: abnormal ends are not counted: %s; %s\n", strerror(error), disk_hint(error));
}

static int open_file(const char *folder)
{
	char path[512];
	int fd = -1;

	errno = ENAMETOOLONG;
	if (snprintf(path, sizeof(path), "%s/ends", folder) < (int)sizeof(path))
		for (int i = 0; fd < 0 && i < 2; i++) /* an error may be of the moment */
			fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0640);
	if (fd < 0)
		tell(errno);
	return fd;
}

/* Without boot_id all starts of the machine count as one. */
static void ask_boot(uint8_t boot[BOOT])
{
	ssize_t got = -1;

	for (int i = 0; got < 0 && i < 2; i++) { /* an error may be of the moment */
		const int fd = open("/proc/sys/kernel/random/boot_id", O_RDONLY | O_CLOEXEC);

		got = fd >= 0 ? read(fd, boot, BOOT) : -1;
		if (fd >= 0)
			close(fd);
	}
	if (got != BOOT)
		memset(boot, 0, BOOT);
}

/* false: there is none, or it is damaged. */
static bool load(int fd, struct ends *ends)
{
	uint8_t bytes[RECORD] = { 0 };
	struct wire_reader in = wire_read(bytes, RECORD - 4);
	struct wire_reader sum = wire_read(bytes + RECORD - 4, 4);
	ssize_t got;

	*ends = (struct ends){ .runs = false };
	for (int i = 0; i < ENDS_MOST; i++)
		ends->time_s[i] = -1;
	got = pread(fd, bytes, RECORD, 0);
	if (got < 0) /* it may be of the moment */
		got = pread(fd, bytes, RECORD, 0);
	if (got != RECORD || memcmp(wire_bytes(&in, 8), MAGIC, 8) != 0 ||
	    wire_u32(&sum) != digest_crc32c(0, bytes, RECORD - 4)) {
		if (got) /* 0: a new file */
			fputs("ladderd: the file `ends` is damaged: earlier abnormal ends are "
			      "forgotten\n", stderr);
		return false;
	}
	ends->runs = wire_u8(&in);
	memcpy(ends->boot, wire_bytes(&in, BOOT), BOOT);
	for (int i = 0; i < ENDS_MOST; i++)
		ends->time_s[i] = wire_i64(&in);
	return true;
}

static void save(int fd, const struct ends *ends)
{
	uint8_t bytes[RECORD];
	struct wire_writer out = wire_write(bytes, RECORD);
	int error = 0;

	wire_put_bytes(&out, MAGIC, 8);
	wire_put_u8(&out, ends->runs);
	wire_put_bytes(&out, ends->boot, BOOT);
	for (int i = 0; i < ENDS_MOST; i++)
		wire_put_i64(&out, ends->time_s[i]);
	wire_put_u32(&out, digest_crc32c(0, bytes, RECORD - 4));
	for (int i = 0; i < 2; i++) {
		error = disk_write(fd, bytes, RECORD, 0);
		if (!error && fdatasync(fd) != 0)
			error = -errno;
		if (!error)
			return;
	}
	tell(-error);
}

static int64_t seconds_up(void)
{
	struct timespec now;

	return clock_gettime(CLOCK_BOOTTIME, &now) == 0 ? now.tv_sec : 0;
}

/* Times after now are those of a machine that has begun anew since, without a boot_id. */
static bool are_many(const struct ends *ends, int64_t now_s)
{
	for (int i = 0; i < ENDS_MOST; i++)
		if (ends->time_s[i] < 0 || ends->time_s[i] > now_s ||
		    now_s - ends->time_s[i] > ENDS_WITHIN_S)
			return false;
	return true;
}

/* A shutdown of the machine ends ladderd, too: that is no fault of a program. Returns whether
 * the record is of another start of the machine. */
static bool forget_other_boot(struct ends *ends)
{
	uint8_t boot[BOOT];

	ask_boot(boot);
	if (memcmp(boot, ends->boot, BOOT) == 0)
		return false;
	memcpy(ends->boot, boot, BOOT);
	for (int i = 0; i < ENDS_MOST; i++)
		ends->time_s[i] = -1;
	return true;
}

uint8_t ends_begin(const char *folder)
{
	const int fd = folder ? open_file(folder) : -1;
	const int64_t now_s = seconds_up();
	struct ends ends;
	uint8_t last;

	if (fd < 0)
		return 0;
	last = load(fd, &ends) ? EVENT_END : 0;
	if (forget_other_boot(&ends)) {
		last = ends.runs ? EVENT_POWER : last;
	} else if (ends.runs) {
		memmove(ends.time_s + 1, ends.time_s, sizeof(ends.time_s) - sizeof(ends.time_s[0]));
		ends.time_s[0] = now_s;
		last = are_many(&ends, now_s) ? EVENT_ENDS : EVENT_AFTER;
	}
	ends.runs = true;
	save(fd, &ends);
	close(fd);
	return last;
}

void ends_orderly(const char *folder)
{
	const int fd = folder ? open_file(folder) : -1;
	struct ends ends;

	if (fd < 0)
		return;
	load(fd, &ends);
	ends.runs = false;
	save(fd, &ends);
	close(fd);
}
