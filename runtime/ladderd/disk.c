/* SPDX-License-Identifier: MIT
 *
 * disk - pwrite() and fsync() until they have done what was asked, or have failed.
 */
#include "ladderd/disk.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

int disk_write(int fd, const void *bytes, size_t len, off_t at)
{
	const uint8_t *from = bytes;

	while (len > 0) {
		const ssize_t done = pwrite(fd, from, len, at);

		if (done < 0 && errno == EINTR)
			continue;
		if (done <= 0)
			return done < 0 ? -errno : -EIO;
		from += done;
		at += done;
		len -= (size_t)done;
	}
	return 0;
}

static int sync_once(const char *folder)
{
	const int fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
	int error = 0;

	if (fd < 0)
		return -errno;
	if (fsync(fd) != 0 && errno != EINVAL)
		error = -errno;
	close(fd);
	return error;
}

int disk_sync_folder(const char *folder)
{
	return sync_once(folder) == 0 ? 0 : sync_once(folder);
}

const char *disk_hint(int error)
{
	switch (error < 0 ? -error : error) {
	case ENOSPC:
	case EDQUOT:
		return "make room on the disk";
	case EROFS:
		return "mount the disk for writing; if it did this by itself, it has errors: the end of `dmesg` names them";
	case EIO:
		return "the disk fails: back it up and replace it";
	case EACCES:
	case EPERM:
		return "give the file and its folder to the user of ladderd";
	case EISDIR:
		return "remove the folder that has the name of the file";
	case ENOENT:
	case ENOTDIR:
		return "make the folder";
	case ENAMETOOLONG:
		return "take a folder with a shorter name";
	default:
		return "the end of `dmesg` may say more";
	}
}
