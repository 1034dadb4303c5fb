/* SPDX-License-Identifier: MIT
 *
 * disk_fake - ladderd on a disk that fails: open, mkstemp, pread, read, pwrite, write, fsync, fdatasync,
 * ftruncate and rename of the files that a board stores.
 *
 * The file DISK_FAKE of the environment is shared with the test, which may change it at any time: five
 * numbers of 32 bits. Other files, sockets and standard error always work.
 */
#define _GNU_SOURCE /* O_TMPFILE */
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define FDS 1024

enum kind { BROKEN, FULL, HALF, SIGNAL };

struct control {
	_Atomic int32_t fail_at;       /* counted from 1; 0: never             */
	_Atomic int32_t times;         /* so many calls fail                   */
	_Atomic int32_t kind;          /* enum kind                            */
	_Atomic int32_t calls;
	_Atomic int32_t failed;        /* how many failed                      */
};

static struct control *control;
static _Atomic bool stored[FDS];       /* is open on a file that the board stores */

static void attach(void) __attribute__((constructor));
int __real_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...);
int __real_open64(const char *path, int flags, ...);
int __wrap_open64(const char *path, int flags, ...);
int __real_close(int fd);
int __wrap_close(int fd);

static void attach(void)
{
	const char *path = getenv("DISK_FAKE");
	const int fd = path ? __real_open(path, O_RDWR | O_CLOEXEC) : -1;
	void *memory = fd < 0 ? MAP_FAILED :
		       mmap(NULL, sizeof(*control), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);

	if (fd >= 0)
		__real_close(fd);
	control = memory == MAP_FAILED ? NULL : memory;
}

static bool is_stored(const char *path)
{
	static const char *const name[] = { "alarms", "conf", "ends", "events", "password", "prog.",
					    "retain" };
	const char *slash = strrchr(path, '/'), *last = slash ? slash + 1 : path;

	if (strcmp(path, ".") == 0) /* the folder is synced */
		return true;
	for (size_t i = 0; i < sizeof(name) / sizeof(name[0]); i++)
		if (strncmp(last, name[i], strlen(name[i])) == 0)
			return true;
	return false;
}

/* Does this call fail? Calls of two threads are counted in some order. */
static bool is_bad(void)
{
	const int32_t call = control ? atomic_fetch_add(&control->calls, 1) + 1 : 0;
	const int32_t from = control ? atomic_load(&control->fail_at) : 0;

	if (!from || call < from || call - from >= atomic_load(&control->times))
		return false;
	atomic_fetch_add(&control->failed, 1);
	errno = control->kind == FULL ? ENOSPC : control->kind == SIGNAL ? EINTR : EIO;
	return true;
}

/* Calls that write nothing know no half and no signal; of a full disk only those fail that make something. */
static bool is_bad_otherwise(bool makes)
{
	return is_bad() && control->kind != HALF && (control->kind != FULL || makes) &&
	       control->kind != SIGNAL;
}

static bool is_ours(int fd)
{
	return fd >= 0 && fd < FDS && atomic_load(&stored[fd]);
}

static int note(int fd)
{
	if (fd >= 0 && fd < FDS)
		atomic_store(&stored[fd], true);
	return fd;
}

#define OPEN(name) \
	int __wrap_##name(const char *path, int flags, ...) \
	{ \
		va_list more; \
		int mode = 0; \
		if (flags & O_CREAT) { \
			va_start(more, flags); \
			mode = va_arg(more, int); \
			va_end(more); \
		} \
		if (!is_stored(path)) \
			return __real_##name(path, flags, mode); \
		return is_bad_otherwise(flags & O_CREAT) ? -1 : note(__real_##name(path, flags, mode)); \
	}
OPEN(open)
OPEN(open64)

int __wrap_close(int fd)
{
	if (fd >= 0 && fd < FDS)
		atomic_store(&stored[fd], false);
	return __real_close(fd);
}

#define WRAP(type, name, with, ...) \
	type __real_##name with; \
	type __wrap_##name with; \
	type __wrap_##name with { __VA_ARGS__ }
#define MAKE(name) \
	WRAP(int, name, (char *path), \
		return is_stored(path) && is_bad_otherwise(true) ? -1 : note(__real_##name(path));)
MAKE(mkstemp)
MAKE(mkstemp64)
WRAP(int, fsync, (int fd), return is_ours(fd) && is_bad_otherwise(true) ? -1 : __real_fsync(fd);)
WRAP(int, fdatasync, (int fd),
	return is_ours(fd) && is_bad_otherwise(true) ? -1 : __real_fdatasync(fd);)
WRAP(ssize_t, read, (int fd, void *out, size_t len),
	return is_ours(fd) && is_bad_otherwise(false) ? -1 : __real_read(fd, out, len);)
WRAP(int, rename, (const char *from, const char *to),
	return is_stored(to) && is_bad_otherwise(true) ? -1 : __real_rename(from, to);)
#define AT(name) \
	WRAP(ssize_t, name, (int fd, void *out, size_t len, off_t at), \
		return is_ours(fd) && is_bad_otherwise(false) ? -1 : __real_##name(fd, out, len, at);)
AT(pread)
AT(pread64)
#define TRUNCATE(name) \
	WRAP(int, name, (int fd, off_t len), \
		return is_ours(fd) && is_bad_otherwise(false) ? -1 : __real_##name(fd, len);)
TRUNCATE(ftruncate)
TRUNCATE(ftruncate64)

/* What a write that fails takes before it fails. */
static size_t taken(size_t len)
{
	return control->kind == HALF ? (len + 1) / 2 : 0;
}

WRAP(ssize_t, write, (int fd, const void *bytes, size_t len),
	if (!is_ours(fd) || !is_bad())
		return __real_write(fd, bytes, len);
	return taken(len) ? __real_write(fd, bytes, taken(len)) : -1;)
#define PUT(name) \
	WRAP(ssize_t, name, (int fd, const void *bytes, size_t len, off_t at), \
		if (!is_ours(fd) || !is_bad()) \
			return __real_##name(fd, bytes, len, at); \
		return taken(len) ? __real_##name(fd, bytes, taken(len), at) : -1;)
PUT(pwrite)
PUT(pwrite64)
