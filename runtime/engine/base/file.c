/* SPDX-License-Identifier: MIT
 *
 * file - whole files in, whole files out.
 *
 * A save is complete or the old file stays as it was: a temporary file beside it,
 * fsync, rename, fsync of the folder. It never writes into a file in place.
 */
#define _XOPEN_SOURCE 700 /* mkstemp */
#include "engine/base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define LINKS_MOST 40 /* as the kernel follows                               */

static char *fail(struct diag_list *diags, enum diag_id id, const char *path,
		  int error)
{
	struct diag place = { .id = id, .file = path };

	if (diags)
		diag_add(diags, place, "%s", error ? strerror(error) : "");
	return NULL;
}

/* Reads until the end or one byte beyond @limit. @room: the file's size, or a guess
 * (files of /proc say 0), so that one allocation is usually enough. */
static char *read_all(int fd, size_t limit, size_t room, size_t *len)
{
	size_t used = 0;
	char *bytes = malloc(room + 1);

	while (bytes) {
		ssize_t got = read(fd, bytes + used, room - used);
		char *more;

		if (got < 0 && errno == EINTR)
			continue;
		if (got < 0) {
			free(bytes);
			return NULL;
		}
		used += (size_t)got;
		if (got == 0 || used > limit)
			break;
		if (used < room)
			continue;
		room *= 2;
		more = realloc(bytes, room + 1);
		if (!more)
			free(bytes);
		bytes = more;
	}
	if (!bytes) {
		errno = ENOMEM;
		return NULL;
	}
	bytes[used] = '\0';
	*len = used;
	return bytes;
}

static bool is_over(const struct stat *status, size_t limit)
{
	return status->st_size > 0 && (uintmax_t)status->st_size > limit;
}

char *file_read(const char *path, size_t limit, size_t *len,
		struct diag_list *diags)
{
	int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
	struct stat status;
	char *bytes;
	int error;

	if (fd < 0)
		return fail(diags, DIAG_CANNOT_READ, path, errno);
	if (fstat(fd, &status) < 0 || !S_ISREG(status.st_mode)) {
		close(fd);
		return fail(diags, DIAG_NOT_A_FILE, path, 0);
	}
	if (is_over(&status, limit)) { /* fails before memory is allocated */
		close(fd);
		return fail(diags, DIAG_TOO_LARGE, path, 0);
	}
	/* One byte more than the file has, so that its end is seen without another
	 * allocation. */
	bytes = read_all(fd, limit, status.st_size > 0 ?
			 (size_t)status.st_size + 1 : 4096, len);
	error = errno;
	close(fd);
	if (!bytes)
		return fail(diags, error == ENOMEM ? DIAG_NO_MEMORY :
			    DIAG_CANNOT_READ, path, error);
	if (*len > limit) {
		free(bytes);
		return fail(diags, DIAG_TOO_LARGE, path, 0);
	}
	return bytes;
}

static int write_all(int fd, const char *bytes, size_t len)
{
	while (len > 0) {
		ssize_t put = write(fd, bytes, len);

		if (put < 0 && errno == EINTR)
			continue;
		if (put <= 0)
			return put < 0 ? -errno : -EIO;
		bytes += put;
		len -= (size_t)put;
	}
	return 0;
}

/* Makes the new name survive a power cut. A folder that cannot be opened for reading
 * cannot be synced; that is no error. */
static int sync_folder(const char *path)
{
	const char *slash = strrchr(path, '/');
	size_t len = slash ? (size_t)(slash - path) + 1 : 0;
	char *folder = malloc(len + 2);
	int fd, result = 0;

	if (!folder)
		return -ENOMEM;
	memcpy(folder, len ? path : ".", len ? len : 1);
	folder[len ? len : 1] = '\0';
	fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
	free(folder);
	if (fd < 0)
		return errno == EACCES ? 0 : -errno;
	if (fsync(fd) < 0 && errno != EINVAL)
		result = -errno;
	close(fd);
	return result;
}

/* @temporary: its last six letters are X, and get others. */
static int replace(const char *path, char *temporary, const void *bytes, size_t len)
{
	struct stat old;
	mode_t mode = 0644;
	int result, fd;

	memset(temporary + strlen(temporary) - 6, 'X', 6);
	fd = mkstemp(temporary);
	if (fd < 0)
		return -errno;
	if (stat(path, &old) == 0)
		mode = old.st_mode & 0777;
	result = write_all(fd, bytes, len);
	if (result == 0 && (fchmod(fd, mode) < 0 || fsync(fd) < 0))
		result = -errno;
	if (close(fd) < 0 && result == 0)
		result = -errno;
	if (result == 0 && rename(temporary, path) < 0)
		result = -errno;
	if (result < 0)
		unlink(temporary);
	return result;
}

/* Where the symbolic link @path leads to; NULL: it is none. Caller frees. */
static char *link_target(const char *path)
{
	const char *slash = strrchr(path, '/');
	const size_t folder = slash ? (size_t)(slash - path) + 1 : 0;
	char *to = malloc(folder + PATH_MAX + 1);
	const ssize_t len = to ? readlink(path, to + folder, PATH_MAX) : -1;

	if (len <= 0) {
		free(to);
		return NULL;
	}
	to[folder + (size_t)len] = '\0';
	if (to[folder] == '/')
		memmove(to, to + folder, (size_t)len + 1);
	else
		memcpy(to, path, folder);
	return to;
}

/* The file that @path leads to through links; NULL: none of them, or it is not there. Caller frees.
 * realpath() is a kilobyte more on a board, and does more. */
static char *real_path(const char *path)
{
	struct stat status;
	char *real = link_target(path);

	for (int i = 0; real && i < LINKS_MOST; i++) {
		char *next = link_target(real);

		if (!next)
			break;
		free(real);
		real = next;
	}
	if (!real || stat(real, &status) == 0)
		return real;
	free(real);
	return NULL;
}

bool file_save(const char *path, const void *bytes, size_t len,
	       struct diag_list *diags)
{
	static const char suffix[] = ".XXXXXX";
	char *real = real_path(path); /* through a link: the file itself */
	const char *target = real ? real : path;
	size_t size = strlen(target);
	char *temporary = malloc(size + sizeof(suffix));
	struct stat old;
	int result;

	if (stat(target, &old) == 0 && !S_ISREG(old.st_mode)) {
		free(real);
		free(temporary);
		fail(diags, DIAG_NOT_A_FILE, path, 0);
		return false;
	}
	if (!temporary) {
		free(real);
		fail(diags, DIAG_NO_MEMORY, path, 0);
		return false;
	}
	memcpy(temporary, target, size);
	memcpy(temporary + size, suffix, sizeof(suffix));
	result = replace(target, temporary, bytes, len);
	if (result < 0) /* a disk may fail once */
		result = replace(target, temporary, bytes, len);
	if (result < 0)
		fail(diags, DIAG_CANNOT_WRITE, path, -result);
	else if (sync_folder(target) < 0 && sync_folder(target) < 0) /* the file is saved by then */
		fail(diags, DIAG_NOT_SYNCED, path, 0);
	free(temporary);
	free(real);
	return result == 0;
}
