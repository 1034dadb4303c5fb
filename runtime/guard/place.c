/* SPDX-License-Identifier: MIT
 *
 * place - looks at the links of a class (/sys/class/pwm/pwmchip0) and at the names of the devices. It calls the kernel
 * for that, as opendir() and realpath() would allocate.
 */
#define _GNU_SOURCE
#include "guard/place.h"

#include "guard/text.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

/* ---- texts ---- */

void places_reset(struct places *places, uint16_t count, uint16_t bytes)
{
	places->count = count;
	places->bytes = bytes ? bytes : 1;
	places->text[0] = '\0';
}

/* The place of a text; PLACE_NONE: there is no room. */
static uint16_t keep(struct places *places, const char *text, size_t len)
{
	const char *end = places->text + places->bytes;
	const uint16_t at = places->bytes;

	for (const char *known = places->text; known < end; known += strlen(known) + 1)
		if (strlen(known) == len && memcmp(known, text, len) == 0)
			return (uint16_t)(known - places->text);
	if (len >= sizeof(places->text) - at)
		return PLACE_NONE;
	memcpy(places->text + at, text, len);
	places->text[at + len] = '\0';
	places->bytes = (uint16_t)(at + len + 1);
	return at;
}

static const char *text_of(const struct places *places, uint16_t at)
{
	return places->text + at;
}

/* ---- devices ---- */

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

/* Bytes of @path up to its numbered entry, and of the folder before that; 0: it has none. */
static size_t split(const char *path, size_t *folder)
{
	for (const char *at = strchr(path, '/'); at; at = strchr(at + 1, '/')) {
		const size_t len = strcspn(at + 1, "/");

		if (!head_of(at + 1, len) || len >= PLACE_NAME)
			continue;
		*folder = (size_t)(at - path);
		return *folder + 1 + len;
	}
	return 0;
}

/* The first line of a small file; "": it cannot be read. */
static void read_line(const char *folder, const char *entry, const char *file, char *out, size_t size)
{
	char path[GUARD_PATH + PLACE_NAME + 16];
	int fd;
	ssize_t got;

	out[0] = '\0';
	text_print(path, sizeof(path), "%s/%s/%s", folder, entry, file);
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
static void read_where(const char *folder, const char *entry, char out[PLACE_WHERE])
{
	char path[GUARD_PATH + PLACE_NAME + 16], real[PLACE_WHERE + PLACE_NAME];
	ssize_t len;
	char *slash;
	int fd;

	out[0] = '\0';
	text_print(path, sizeof(path), "%s/%s", folder, entry);
	if (readlink(path, real, sizeof(real)) < 0)
		return;
	fd = open(path, O_PATH | O_CLOEXEC);
	if (fd < 0)
		return;
	text_print(path, sizeof(path), "/proc/self/fd/%d", fd);
	len = readlink(path, real, sizeof(real));
	close(fd);
	if (len <= 0 || len == (ssize_t)sizeof(real))
		return;
	real[len] = '\0';
	slash = strrchr(real, '/');
	if (slash && slash - real < PLACE_WHERE) {
		memcpy(out, real, (size_t)(slash - real));
		out[slash - real] = '\0';
	}
}

/* Whether an entry of the folder is numbered as the old one is: "pwmchip3" as "pwmchip0". */
static bool is_kin(const char *entry, const char *old)
{
	const size_t head = head_of(old, strlen(old));

	return strlen(entry) < PLACE_NAME - 4 && head_of(entry, strlen(entry)) == head && strncmp(entry, old, head) == 0;
}

/* The kernel's entry of a folder. */
struct entry {
	uint64_t inode;
	int64_t next;
	uint16_t len;
	uint8_t type;
	char name[];
};

/* Calls for each entry of the folder that is numbered as the old one is, until a call returns false. 0 or -errno. */
static int each_kin(const char *folder, const char *old, bool (*call)(void *context, const char *entry), void *context)
{
	_Alignas(8) char bytes[512];
	const int fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
	bool more = true;
	long got = 0;

	if (fd < 0)
		return -errno;
	while (more && (got = syscall(SYS_getdents64, fd, bytes, sizeof(bytes))) > 0) {
		const struct entry *entry;

		for (long at = 0; more && at < got; at += entry->len) {
			entry = (const struct entry *)(bytes + at);
			more = !is_kin(entry->name, old) || call(context, entry->name);
		}
	}
	close(fd);
	return got < 0 ? -errno : 0;
}

struct twin {
	const char *folder, *old, *wanted;
	bool found;
};

static bool look_for_twin(void *context, const char *entry)
{
	struct twin *twin = context;
	char name[PLACE_NAME];

	if (strcmp(entry, twin->old) == 0)
		return true;
	read_name(twin->folder, entry, name, sizeof(name));
	twin->found = strcmp(name, twin->wanted) == 0;
	return !twin->found;
}

/* Whether another entry has the same name. A folder that cannot be read may hold one. */
static bool has_twin(const char *folder, const char *old, const char *wanted)
{
	struct twin twin = { .folder = folder, .old = old, .wanted = wanted };

	return each_kin(folder, old, look_for_twin, &twin) != 0 || twin.found;
}

/* Looks at the device while it is there. */
static bool learn(struct places *places, struct place *place, const char *path, size_t len)
{
	char folder[GUARD_PATH], where[PLACE_WHERE], name[PLACE_NAME], entry[PLACE_NAME];

	text_print(folder, sizeof(folder), "%.*s", (int)place->folder, path);
	text_print(entry, sizeof(entry), "%.*s", (int)(len - place->folder - 1), path + place->folder + 1);
	read_where(folder, entry, where);
	read_name(folder, entry, name, sizeof(name));
	place->several = name[0] && has_twin(folder, entry, name);
	place->path = keep(places, path, len);
	place->where = keep(places, where, strlen(where));
	place->name = keep(places, name, strlen(name));
	return place->path != PLACE_NONE && place->where != PLACE_NONE && place->name != PLACE_NONE;
}

static bool is_of(const struct places *places, uint16_t i, const char *path, size_t len)
{
	const char *known = text_of(places, places->place[i].path);

	return strlen(known) == len && memcmp(known, path, len) == 0;
}

bool places_learn(struct places *places, uint16_t from, const char *path, struct place_file *out)
{
	size_t folder = 0;
	const size_t len = split(path, &folder);
	uint16_t i = from;

	out->place = PLACE_NONE;
	out->rest = keep(places, path + len, strlen(path + len));
	if (!len || out->rest == PLACE_NONE)
		return out->rest != PLACE_NONE;
	while (i < places->count && !is_of(places, i, path, len))
		i++;
	if (i == PLACES)
		return false;
	if (i == places->count) {
		places->place[i] = (struct place){ .folder = (uint16_t)folder };
		if (!learn(places, &places->place[i], path, len))
			return false;
		places->count++;
	}
	out->place = i;
	return true;
}

void places_path(const struct places *places, const struct place_file *file, char out[GUARD_PATH])
{
	text_print(out, GUARD_PATH, "%s%s",
		   file->place == PLACE_NONE ? "" : text_of(places, places->place[file->place].path),
		   text_of(places, file->rest));
}

/* ---- the same device ---- */

/* What a look into the folder has found. */
struct found {
	const struct places *places;
	const struct place *place;
	const char *folder, *old;
	int best, count;        /* entries that fit so well                    */
	char entry[PLACE_NAME];
};

/* How well an entry fits: 2: the place and the name are the same, 1: the name that no other one had,
 * 0: it is another device. */
static int fits(const struct found *found, const char *entry)
{
	const char *known = text_of(found->places, found->place->where);
	char where[PLACE_WHERE], name[PLACE_NAME];

	read_where(found->folder, entry, where);
	read_name(found->folder, entry, name, sizeof(name));
	if (strcmp(name, text_of(found->places, found->place->name)) != 0)
		return 0;
	if (*known && strcmp(where, known) == 0)
		return 2;
	return name[0] && !found->place->several ? 1 : 0;
}

/* Of several that fit as well, the one with the old number is it; else none is. */
static bool look(void *context, const char *entry)
{
	struct found *found = context;
	const int fit = fits(found, entry);
	const bool same = strcmp(entry, found->old) == 0;

	if (!fit || fit < found->best)
		return true;
	if (fit > found->best || same)
		found->count = 0;
	else if (found->count && strcmp(found->entry, found->old) == 0)
		return true;
	found->best = fit;
	found->count++;
	text_print(found->entry, sizeof(found->entry), "%s", entry);
	return true;
}

int places_find(const struct places *places, const struct place_file *file, char out[GUARD_PATH])
{
	const struct place *place = file->place == PLACE_NONE ? NULL : &places->place[file->place];
	char folder[GUARD_PATH];
	struct found found = { .places = places, .place = place, .folder = folder };
	int error;

	places_path(places, file, out);
	if (!place || (place->where == 0 && place->name == 0))
		return 0;
	found.old = text_of(places, place->path) + place->folder + 1;
	text_print(folder, sizeof(folder), "%.*s", (int)place->folder, out);
	error = each_kin(folder, found.old, look, &found);
	if (error || found.count != 1)
		return error ? error : -ENODEV;
	return text_print(out, GUARD_PATH, "%s/%s%s", folder, found.entry, text_of(places, file->rest)) < GUARD_PATH ?
	       0 : -ENAMETOOLONG;
}
