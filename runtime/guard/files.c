/* SPDX-License-Identifier: MIT
 *
 * files - opens, writes and closes each file; nothing is open while ladderd lives. The device of a file is looked for
 * at each write, so that its number may be another one than before.
 */
#define _DEFAULT_SOURCE
#include "guard/files.h"

#include "guard/text.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

/* Forgets what is behind the known files. */
static void forget(struct files *files)
{
	files->count = files->known;
	files->lack = files->known_lack;
	files->told = files->written = false;
	places_reset(&files->places, files->known_places, files->known_bytes);
}

static void add(struct files *files, const struct guard_files *from)
{
	const char *at = from->record;

	for (int i = 0; i < from->head.count; i++) {
		const char *path = at + sizeof(files->number[0]);
		const bool room = files->count < 2 * GUARD_FILES &&
			places_learn(&files->places, files->known_places, path, &files->file[files->count]);

		if (room)
			memcpy(&files->number[files->count++], at, sizeof(files->number[0]));
		else
			text_say("\"%s\" is not made safe: the guard has no room for it", path);
		files->lack = files->lack || !room;
		at = path + strlen(path) + 1;
	}
}

void files_begin(struct files *files)
{
	memset(files, 0, sizeof(*files));
	forget(files);
}

void files_know(struct files *files, const struct guard_files *known)
{
	files->known = files->known_places = files->known_bytes = 0;
	files->known_lack = false;
	forget(files);
	add(files, known);
	files->known = files->count;
	files->known_places = files->places.count;
	files->known_bytes = files->places.bytes;
	files->known_lack = files->lack;
}

void files_more(struct files *files, const struct guard_files *more)
{
	forget(files);
	add(files, more);
}

/* A converter's highest step is one below its reference: it refuses the number of the reference. 0 or -errno. */
static int write_one(const struct files *files, int number)
{
	const int64_t safe = files->number[number];
	char path[GUARD_PATH], text[24];
	int error = places_find(&files->places, &files->file[number], path);
	const int fd = error ? -1 : open(path, O_WRONLY | O_CLOEXEC | O_NONBLOCK);

	if (!error)
		error = fd < 0 ? -errno : -EINVAL;

	for (int i = 0; fd >= 0 && i < 2 && error == -EINVAL; i++) {
		const int len = text_print(text, sizeof(text), "%lld\n", (long long)safe - i);

		errno = 0;
		error = write(fd, text, (size_t)len) == len ? 0 : errno ? -errno : -EIO;
		if (safe <= 0)
			break;
	}
	if (fd >= 0)
		close(fd);
	return error;
}

bool files_write(struct files *files)
{
	bool good = !files->lack;
	char path[GUARD_PATH];

	if (files->written)
		return true;
	for (int i = 0; i < files->count; i++) {
		const int error = write_one(files, i);

		if (error && !files->told) {
			places_path(&files->places, &files->file[i], path);
			text_say("\"%s\" is not safe: %s; the guard tries again", path, strerror(-error));
		}
		files->told = files->told || error;
		good = good && !error;
	}
	files->written = good;
	return good;
}
