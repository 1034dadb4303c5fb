/* SPDX-License-Identifier: MIT
 *
 * files - opens, writes and closes each file; nothing is open while ladderd lives. The device of a file is looked for
 * at each write, so that its number may be another one than before.
 */
#define _DEFAULT_SOURCE
#include "guard/files.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static void copy(struct guard_files *to, struct place *at, const struct guard_files *from)
{
	memset(to, 0, sizeof(*to));
	memcpy(to, from, offsetof(struct guard_files, file) + from->head.count * sizeof(from->file[0]));
	for (int i = 0; i < to->head.count; i++)
		place_learn(&at[i], to->file[i].path);
}

void files_know(struct files *files, const struct guard_files *known)
{
	copy(&files->known, files->known_at, known);
	files->more.head.count = 0;
	files->told = files->written = false;
}

void files_more(struct files *files, const struct guard_files *more)
{
	copy(&files->more, files->more_at, more);
	files->told = files->written = false;
}

/* A converter's highest step is one below its reference: it refuses the number of the reference. 0 or -errno. */
static int write_one(const struct guard_file *file, const struct place *at)
{
	char path[GUARD_PATH], text[24];
	int error = place_find(at, file->path, path);
	const int fd = error ? -1 : open(path, O_WRONLY | O_CLOEXEC | O_NONBLOCK);

	if (!error)
		error = fd < 0 ? -errno : -EINVAL;

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

static bool write_all(struct files *files, const struct guard_files *all, const struct place *at)
{
	bool good = true;

	for (int i = 0; i < all->head.count; i++) {
		const int error = write_one(&all->file[i], &at[i]);

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
	known = write_all(files, &files->known, files->known_at);
	more = write_all(files, &files->more, files->more_at);
	files->written = known && more;
	return files->written;
}
