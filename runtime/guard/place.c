/* SPDX-License-Identifier: MIT
 *
 * place - looks at the links of a class (/sys/class/pwm/pwmchip0) and at the names of the devices.
 */
#define _DEFAULT_SOURCE
#include "guard/place.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Bytes of the head of a numbered name, "pwmchip" of "pwmchip0"; 0: it is none. */
static size_t head_of(const char *name, size_t len)
{
	static const char *const heads[] = { "iio:device", "pwmchip", "hwmon" };

	for (size_t i = 0; i < sizeof(heads) / sizeof(*heads); i++) {
		const size_t head = strlen(heads[i]);

		if (len > head && strncmp(name, heads[i], head) == 0 &&
		    strspn(name + head, "0123456789") >= len - head)
			return head;
	}
	return 0;
}

/* Finds the numbered part of a path. */
static void split(struct place *place, const char *path)
{
	for (const char *at = strchr(path, '/'); at; at = strchr(at + 1, '/')) {
		const size_t len = strcspn(at + 1, "/");

		if (!head_of(at + 1, len))
			continue;
		place->folder = (uint32_t)(at - path);
		place->entry = (uint16_t)len;
		return;
	}
}

/* The first line of a small file; "": it cannot be read. */
static void read_line(const char *folder, const char *entry, const char *file, char *out, size_t size)
{
	char path[GUARD_PATH + PLACE_NAME + 16];
	int fd;
	ssize_t got;

	out[0] = '\0';
	snprintf(path, sizeof(path), "%s/%.60s/%s", folder, entry, file);
	fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
	got = fd < 0 ? -1 : read(fd, out, size - 1);
	if (fd >= 0)
		close(fd);
	out[got > 0 ? got : 0] = '\0';
	out[strcspn(out, "\n")] = '\0';
}

/* A pulse width chip has no name; its device may have one. */
static void read_name(const char *folder, const char *entry, char *out, size_t size)
{
	read_line(folder, entry, "name", out, size);
	if (!*out)
		read_line(folder, entry, "device/name", out, size);
}

/* The folder that the link of an entry leads to, without the entry; "": it is no link, or it is too long. */
static void read_where(const char *folder, const char *entry, char *out, size_t size)
{
	char path[GUARD_PATH + PLACE_NAME + 16], link[4];
	char *real, *slash;

	out[0] = '\0';
	snprintf(path, sizeof(path), "%s/%.60s", folder, entry);
	if (readlink(path, link, sizeof(link)) < 0)
		return;
	real = realpath(path, NULL);
	slash = real ? strrchr(real, '/') : NULL;
	if (slash && (size_t)(slash - real) < size) {
		memcpy(out, real, (size_t)(slash - real));
		out[slash - real] = '\0';
	}
	free(real);
}

/* Whether an entry of the folder is numbered as the old one is: "pwmchip3" as "pwmchip0". */
static bool is_kin(const char *entry, const char *old)
{
	const size_t head = head_of(old, strlen(old));

	return strlen(entry) < PLACE_NAME - 4 && head_of(entry, strlen(entry)) == head && strncmp(entry, old, head) == 0;
}

/* Whether another entry has the same name. A folder that cannot be read may hold one. */
static bool has_twin(const char *folder, const char *old, const char *wanted)
{
	char name[PLACE_NAME];
	const struct dirent *entry;
	bool twin = false;
	DIR *all = opendir(folder);

	if (!all)
		return true;
	while (!twin && (entry = readdir(all)) != NULL) {
		if (!is_kin(entry->d_name, old) || strcmp(entry->d_name, old) == 0)
			continue;
		read_name(folder, entry->d_name, name, sizeof(name));
		twin = strcmp(name, wanted) == 0;
	}
	closedir(all);
	return twin;
}

void place_learn(struct place *place, const char *path)
{
	char folder[GUARD_PATH], entry[PLACE_NAME];

	*place = (struct place){ .folder = 0 };
	split(place, path);
	if (!place->entry || place->entry >= sizeof(entry))
		return;
	snprintf(folder, sizeof(folder), "%.*s", (int)place->folder, path);
	snprintf(entry, sizeof(entry), "%.*s", (int)place->entry, path + place->folder + 1);
	read_where(folder, entry, place->where, sizeof(place->where));
	read_name(folder, entry, place->name, sizeof(place->name));
	place->several = place->name[0] && has_twin(folder, entry, place->name);
}

/* How well an entry fits: 2: the place and the name are the same, 1: the name that no other one had,
 * 0: it is another device. */
static int fits(const struct place *place, const char *folder, const char *entry)
{
	char where[PLACE_WHERE], name[PLACE_NAME];

	read_where(folder, entry, where, sizeof(where));
	read_name(folder, entry, name, sizeof(name));
	if (strcmp(name, place->name) != 0)
		return 0;
	if (place->where[0] && strcmp(where, place->where) == 0)
		return 2;
	return place->name[0] && !place->several ? 1 : 0;
}

/* What a look into the folder has found. */
struct found {
	int best, count;        /* entries that fit so well                    */
	char entry[PLACE_NAME];
};

/* Of several that fit as well, the one with the old number is it; else none is. */
static void look(const struct place *place, const char *folder, const char *old, const char *entry, struct found *found)
{
	const int fit = fits(place, folder, entry);
	const bool same = strcmp(entry, old) == 0;

	if (!fit || fit < found->best)
		return;
	if (fit > found->best || same)
		found->count = 0;
	else if (found->count && strcmp(found->entry, old) == 0)
		return;
	found->best = fit;
	found->count++;
	snprintf(found->entry, sizeof(found->entry), "%.60s", entry);
}

int place_find(const struct place *place, const char *path, char out[GUARD_PATH])
{
	char folder[GUARD_PATH], old[PLACE_NAME];
	struct found found = { .best = 0 };
	const struct dirent *entry;
	size_t len;
	DIR *all;

	snprintf(out, GUARD_PATH, "%s", path);
	if (!place->where[0] && !place->name[0])
		return 0;
	snprintf(folder, sizeof(folder), "%.*s", (int)place->folder, path);
	snprintf(old, sizeof(old), "%.*s", (int)place->entry, path + place->folder + 1);
	all = opendir(folder);
	if (!all)
		return -errno;
	while ((entry = readdir(all)) != NULL)
		if (is_kin(entry->d_name, old))
			look(place, folder, old, entry->d_name, &found);
	closedir(all);
	if (found.count != 1)
		return -ENODEV;
	len = (size_t)snprintf(out, GUARD_PATH, "%s/%s%s", folder, found.entry, path + place->folder + 1 + place->entry);
	return len < GUARD_PATH ? 0 : -ENAMETOOLONG;
}
