/* SPDX-License-Identifier: MIT
 *
 * store_file - opens, allocates, writes and replaces the file of --retain. fdatasync()
 * follows each write, fsync() a new file and its name, so a value reported as stored is on
 * the disk.
 */
#define _DEFAULT_SOURCE /* flock() */
#include "ladderd/store_file.h"
#include "ladderd/disk.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h> /* rename() */
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define FILE_MOST (2u * (LIMIT_RETAIN + 2 * RETAIN_PAGE))
#define TRIES     3 /* to read it: an error may be of the moment             */

static int lock(int fd)
{
	if (flock(fd, LOCK_EX | LOCK_NB) == 0)
		return 0;
	return errno == EWOULDBLOCK ? -EWOULDBLOCK : 0; /* 0: cannot be locked */
}

static int read_all(int fd, uint8_t *bytes, size_t len)
{
	size_t at = 0;

	while (at < len) {
		ssize_t got = pread(fd, bytes + at, len - at, (off_t)at);

		if (got < 0 && errno == EINTR)
			continue;
		if (got < 0)
			return -errno;
		if (got == 0)
			return -EIO;
		at += (size_t)got;
	}
	return 0;
}

static int load(int fd, uint8_t **bytes, size_t *len)
{
	struct stat about;
	int error;

	if (fstat(fd, &about) != 0)
		return -errno;
	if (!S_ISREG(about.st_mode))
		return -ENOTSUP;
	if (about.st_size > (off_t)FILE_MOST)
		return -EFBIG;
	*len = (size_t)about.st_size;
	*bytes = malloc(*len + 1);
	if (!*bytes)
		return -ENOMEM;
	error = read_all(fd, *bytes, *len);
	if (error) {
		free(*bytes);
		*bytes = NULL;
	}
	return error;
}

static int open_and_load(struct store_file *file, uint8_t **bytes, size_t *len)
{
	int fd, error;

	/* O_NONBLOCK: a pipe must not block the start. */
	file->fd = fd = open(file->path, O_RDWR | O_CLOEXEC | O_NONBLOCK);
	if (fd < 0 && errno == ENOENT)
		return 0;
	file->exists = true;
	if (fd < 0)
		fd = open(file->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
	if (fd < 0)
		return -errno;
	error = lock(fd);
	if (!error)
		error = load(fd, bytes, len);
	if (fd != file->fd)
		close(fd);
	return error;
}

int store_file_open(struct store_file *file, const char *path,
		    struct arena *arena, uint8_t **bytes, size_t *len)
{
	size_t size = strlen(path);
	int error = 0;

	memset(file, 0, sizeof(*file));
	file->fd = file->fresh_fd = -1;
	file->path = path;
	*bytes = NULL;
	*len = 0;
	file->fresh_path = arena_alloc(arena, size + 5);
	if (!file->fresh_path)
		return -ENOMEM;
	memcpy(file->fresh_path, path, size);
	memcpy(file->fresh_path + size, ".new", 5);
	for (int i = 0; i < TRIES; i++) {
		error = open_and_load(file, bytes, len);
		if (error != -EIO && error != -EINTR)
			break;
		if (file->fd >= 0)
			close(file->fd);
		file->fd = -1;
	}
	file->unread = error && error != -EFBIG;
	file->nameless = true; /* whoever made it may have failed to sync its name */
	return error;
}

void store_file_adopt(struct store_file *file, const struct retain_found *found,
		      uint32_t room)
{
	file->room = room;
	file->seq = found->best >= 0 ? found->seq : 0;
	file->fits = found->best >= 0 && found->fits &&
		     found->slot_size >= room;
	file->slot_size = file->fits ? found->slot_size : room;
	file->next = file->fits ? !found->best : 0;
}

/* Writes zeros instead of a hole, so that a full disk fails now. */
static int allocate(int fd, size_t size)
{
	static const uint8_t zeros[512];

	for (size_t at = 0; at < size; at += sizeof(zeros)) {
		int error = disk_write(fd, zeros, sizeof(zeros), (off_t)at);

		if (error)
			return error;
	}
	return fsync(fd) == 0 ? 0 : -errno;
}

static int make_fresh(struct store_file *file)
{
	int fd = open(file->fresh_path,
		      O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK,
		      0600);
	int error;

	if (fd < 0)
		return -errno;
	error = lock(fd);
	if (error) {
		close(fd);
		return error;
	}
	if (ftruncate(fd, 0) != 0)
		error = -errno;
	if (!error)
		error = allocate(fd, (size_t)file->room * 2);
	if (error) {
		unlink(file->fresh_path);
		close(fd);
		return error;
	}
	file->slot_size = file->room;
	file->next = 0;
	file->fresh_fd = fd;
	return 0;
}

int store_file_prepare(struct store_file *file)
{
	if (file->fresh_fd >= 0)
		return 0;
	if (file->exists && file->fd < 0) {
		int error;

		file->fd = open(file->path, O_RDWR | O_CLOEXEC | O_NONBLOCK);
		if (file->fd < 0)
			return -errno;
		error = lock(file->fd);
		if (error) {
			close(file->fd);
			file->fd = -1;
			return error;
		}
	}
	return file->fits ? 0 : make_fresh(file);
}

/* The name of the new file survives a power cut. */
static int sync_name(struct store_file *file)
{
	char *slash = strrchr(file->fresh_path, '/');
	const char first = slash ? slash[1] : 0;
	int error;

	if (slash)
		slash[1] = 0;
	error = disk_sync_folder(slash ? file->fresh_path : ".");
	if (slash)
		slash[1] = first;
	file->nameless = error != 0;
	return error;
}

/* Nobody knows what is in a file that cannot be read: it becomes PATH.old. */
static int put_aside(struct store_file *file)
{
	const size_t len = strlen(file->path);
	int error;

	memcpy(file->fresh_path + len, ".old", 5);
	error = rename(file->path, file->fresh_path) == 0 || errno == ENOENT ? 0 : -errno;
	memcpy(file->fresh_path + len, ".new", 5);
	file->unread = error != 0;
	return error;
}

/* Renames the new file to the old one's name and syncs the folder. After the rename its
 * first slot is the newest copy, also if a later step fails. */
static int take_over(struct store_file *file)
{
	int error = file->unread ? put_aside(file) : 0;

	if (error)
		return error;
	if (rename(file->fresh_path, file->path) != 0)
		return -errno;
	error = sync_name(file);
	if (file->fd >= 0)
		close(file->fd);
	file->fd = file->fresh_fd;
	file->fresh_fd = -1;
	file->exists = file->fits = true;
	file->seq++;
	file->next = 1;
	return error;
}

int store_file_write(struct store_file *file, struct retain *retain)
{
	int error = store_file_prepare(file), fd;
	bool fresh;
	uint32_t size;

	if (error)
		return error;
	fresh = file->fresh_fd >= 0;
	fd = fresh ? file->fresh_fd : file->fd;
	size = retain_seal(retain, file->seq + 1, fresh ? RETAIN_FIRST : 0u,
			   file->slot_size);
	error = disk_write(fd, retain->slot, size,
			  file->next ? (off_t)file->slot_size : 0);
	if (!error && fdatasync(fd) != 0)
		error = -errno;
	if (!error && file->nameless && !fresh)
		error = sync_name(file);
	if (error)
		return error;
	if (fresh)
		return take_over(file);
	file->seq++;
	file->next = !file->next;
	return 0;
}

void store_file_close(struct store_file *file)
{
	if (file->fresh_fd >= 0) {
		unlink(file->fresh_path);
		close(file->fresh_fd);
	}
	if (file->fd >= 0)
		close(file->fd);
	file->fd = file->fresh_fd = -1;
}
