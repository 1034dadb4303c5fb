/* SPDX-License-Identifier: MIT
 *
 * files - opens, writes and closes each file; nothing is open while ladderd lives.
 */
#define _DEFAULT_SOURCE
#include "guard/files.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static void copy(struct guard_files *to, const struct guard_files *from)
{
	memset(to, 0, sizeof(*to));
	memcpy(to, from, offsetof(struct guard_files, file) + from->head.count * sizeof(from->file[0]));
}

void files_know(struct files *files, const struct guard_files *known)
{
	copy(&files->known, known);
	files->more.head.count = 0;
	files->told = files->written = false;
}

void files_more(struct files *files, const struct guard_files *more)
{
	copy(&files->more, more);
	files->told = files->written = false;
}

/* A converter's highest step is one below its reference: it refuses the number of the reference. 0 or -errno. */
static int write_one(const struct guard_file *file)
{
	const int fd = open(file->path, O_WRONLY | O_CLOEXEC | O_NONBLOCK);
	int error = fd < 0 ? -errno : -EINVAL;
	char text[24];

	for (int i = 0; fd >= 0 && i < 2 && error == -EINVAL; i++) {
		const int len = snprintf(text, sizeof(text), "%lld\n", (long long)file->number - i);

		errno = 0;
		error = write(fd, text, (size_t)len) == len ? 0 : errno ? -errno : -EIO;
		if (file->number <= 0)
			break;
	}
	if (fd >= 0)
		close(fd);
	return error;
}

static bool write_all(struct files *files, const struct guard_files *all)
{
	bool good = true;

	for (int i = 0; i < all->head.count; i++) {
		const int error = write_one(&all->file[i]);

		if (error && !files->told)
			dprintf(STDERR_FILENO, "ladder-guard: \"%s\" is not safe: %s; the guard tries again\n",
				all->file[i].path, strerror(-error));
		files->told = files->told || error;
		good = good && !error;
	}
	return good;
}

bool files_write(struct files *files)
{
	bool known, more;

	if (files->written)
		return true;
	known = write_all(files, &files->known);
	more = write_all(files, &files->more);
	files->written = known && more;
	return files->written;
}
