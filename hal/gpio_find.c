/* SPDX-License-Identifier: MIT
 *
 * gpio_find - finds lines on the chips of this machine by name, or by chip label and
 * offset, or reports why it cannot. Chip numbers change between boots, so they are looked
 * up each time.
 */
#include "hal/gpio.h"
#include "hal/group.h"


#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define CHIP_PREFIX "gpiochip"
#define CHIP_LAST   9999
#define PATH_BYTES  256
#define DENIED_MOST 16       /* chips without permission, in one message     */
#define CHIPS_SHOWN 3        /* of one group                                 */
#define NO_GROUP    UINT_MAX /* this and UNSEEN are no group ids             */
#define UNSEEN      (UINT_MAX - 1)
#define GROUP_OPENS (S_IRGRP | S_IWGRP)

/* "/dev/gpiochip3". */
static void gpio_path(const char *dev, int chip, char *out, size_t size)
{
	snprintf(out, size, "%s/" CHIP_PREFIX "%d", dev, chip);
}

void gpio_text(char *out, const char *text)
{
	snprintf(out, GPIO_TEXT, "%s", text ? text : "");
}

/* 7 for "gpiochip7"; -1: not the name of a chip. */
static int chip_number(const char *name)
{
	size_t prefix = strlen(CHIP_PREFIX);
	int number = 0;

	if (strncmp(name, CHIP_PREFIX, prefix) != 0 || !name[prefix])
		return -1;
	for (name += prefix; *name; name++) {
		if (*name < '0' || *name > '9' || number > CHIP_LAST)
			return -1;
		number = number * 10 + (*name - '0');
	}
	return number;
}

/* The number to which a symbolic link in /dev leads (Raspberry Pi OS has such links), so
 * that no chip is found twice. -1: @number is no link. */
static int link_target(const char *dev, int number)
{
	char path[PATH_BYTES], target[PATH_BYTES];
	const char *name;
	ssize_t len;

	gpio_path(dev, number, path, sizeof(path));
	len = readlink(path, target, sizeof(target) - 1);
	if (len < 0)
		return -1;
	target[len] = 0;
	name = strrchr(target, '/');
	return chip_number(name ? name + 1 : target);
}

static bool is_link(const char *dev, int number)
{
	char path[PATH_BYTES];
	struct stat status;

	gpio_path(dev, number, path, sizeof(path));
	return lstat(path, &status) == 0 && S_ISLNK(status.st_mode);
}

/* The chip was removed, or the file is no chip. */
static bool is_gone(int error)
{
	return error == -ENOENT || error == -ENODEV || error == -ENXIO ||
	       error == -ENOTTY;
}

/* The next chip by number; -1: there is none. */
static int chip_after(const char *dev, int last)
{
	DIR *folder = opendir(dev);
	const struct dirent *entry;
	int best = -1;

	if (!folder)
		return -1;
	while ((entry = readdir(folder)) != NULL) {
		int number = chip_number(entry->d_name);

		if (number > last && (best < 0 || number < best) &&
		    !is_link(dev, number))
			best = number;
	}
	closedir(folder);
	return best;
}

/* Chips without permission, sorted by group; chips that no group may open are last. */
struct denied {
	int count;               /* also of those that are not kept        */
	struct {
		int chip;
		unsigned int group;
	} kept[DENIED_MOST];
};

static bool is_denied(int error)
{
	return error == -EACCES || error == -EPERM;
}

static void denied_add(struct denied *denied, const char *path)
{
	const char *name = strrchr(path, '/');
	unsigned int group = NO_GROUP;
	struct stat status;
	int at = denied->count++;

	if (stat(path, &status) != 0)
		group = UNSEEN;
	else if ((status.st_mode & GROUP_OPENS) == GROUP_OPENS)
		group = (unsigned)status.st_gid;
	if (at >= DENIED_MOST)
		return;
	for (; at > 0 && denied->kept[at - 1].group > group; at--)
		denied->kept[at] = denied->kept[at - 1];
	denied->kept[at].chip = chip_number(name ? name + 1 : path);
	denied->kept[at].group = group;
}

/* Prints the chips of one group: "; 0, 1, 4, ... (gpio)", for the first group "gpiochip0,
 * …". Returns the index of the next group. */
static int denied_group(const struct denied *denied, int first, char *out,
			size_t size)
{
	unsigned int group = denied->kept[first].group;
	const char *before = first > 0 ? "; " : CHIP_PREFIX;
	size_t len = 0;
	int i = first;

	for (; i < DENIED_MOST && i < denied->count &&
	       denied->kept[i].group == group; i++, before = ", ")
		if (i < first + CHIPS_SHOWN)
			len += (size_t)snprintf(out + len, size - len, "%s%d",
						before, denied->kept[i].chip);
	len += (size_t)snprintf(out + len, size - len, "%s ",
				i > first + CHIPS_SHOWN ? ", ..." : "");
	if (group >= UNSEEN)
		snprintf(out + len, size - len, "(%s)",
			 group == UNSEEN ? "?" : "no group");
	else
		group_print(group, out + len, size - len);
	return i;
}

/* Names each group, so that the user knows which to join; "others" if there is no room. */
static bool denied_say(const struct denied *denied, struct trouble *why)
{
	static const char others[] = "; others";
	char text[3 * LIMIT_ARG], part[2 * LIMIT_ARG];
	int said = 0, next;
	size_t len = 0;

	while (said < denied->count && said < DENIED_MOST) {
		size_t room = LIMIT_ARG - 1;

		next = denied_group(denied, said, part, sizeof(part));
		if (next < denied->count)
			room -= strlen(others);
		if (said > 0 && len + strlen(part) > room)
			break;
		len += (size_t)snprintf(text + len, sizeof(text) - len, "%s",
					part);
		said = next;
	}
	return trouble_set(why, DIAG_IO_PERMISSION, "%s%s", text,
			   said < denied->count ? others : "");
}

/* The error of a chip or request, from -errno. */
static bool refused(struct trouble *why, const char *path, int error)
{
	struct denied denied = { .count = 0 };
	const char *name = strrchr(path, '/');

	if (is_denied(error)) {
		denied_add(&denied, path);
		return denied_say(&denied, why);
	}
	return trouble_set(why, DIAG_IO_REQUEST, "%s" DIAG_AND "%s",
			   name ? name + 1 : path, strerror(-error));
}

static bool busy(struct trouble *why, const struct io_point *point,
		 const struct gpio_line *line)
{
	char name[LIMIT_ARG];

	io_line_print(point, name, sizeof(name));
	return trouble_set(why, DIAG_IO_BUSY, "%.26s" DIAG_AND "%.16s", name,
			   line->owner[0] ? line->owner : "the kernel");
}

/* The same for a request; for EBUSY, names the line that is in use. */
static void blame(struct trouble *why, const struct request *request,
		  struct gpio_chip *chip, const char *path, int error)
{
	struct gpio_line line;

	refused(why, path, error);
	for (uint32_t i = 0; error == -EBUSY && i < request->count; i++) {
		if (gpio_chip_line(chip, request->line[i].at.offset, &line) ||
		    !line.used)
			continue;
		trouble_set(why, DIAG_IO_BUSY, "%.40s",
			    line.owner[0] ? line.owner : "the kernel");
		why->line = i;
		break;
	}
}

bool gpio_take(struct request *request, struct trouble *why,
	       int (*take)(struct request *request, const struct gpio_chip *chip),
	       struct gpio_chip *kept)
{
	struct gpio_chip chip;
	char path[PATH_BYTES];
	int error;

	gpio_path(request->dev, request->line[0].at.chip, path, sizeof(path));
	error = gpio_chip_open(path, &chip);
	if (error)
		return refused(why, path, error);
	error = take(request, &chip);
	if (error)
		blame(why, request, &chip, path, error);
	if (error || !kept)
		gpio_chip_close(&chip);
	else
		*kept = chip;
	return !error;
}

/* A search and its result so far. */
struct search {
	const struct io_point *point;
	const char *dev;
	int hits;
	struct line_at at;       /* the first hit                          */
	int second;              /* chip of the second hit                 */
	struct gpio_line line;   /* at the first hit                       */
	struct denied denied;
	int failed, error;       /* the first chip with another error; -1: none */
	uint32_t lines;          /* of the wanted chip                     */
};

static void hit(struct search *search, int chip, uint32_t offset,
		const struct gpio_line *line)
{
	if (search->hits++ == 0) {
		search->at = (struct line_at){ chip, offset };
		search->line = *line;
	} else if (search->hits == 2) {
		search->second = chip;
	}
}

static void search_names(struct search *search, struct gpio_chip *chip,
			 int number)
{
	struct gpio_line line;

	for (uint32_t i = 0; i < chip->lines; i++)
		if (gpio_chip_line(chip, i, &line) == 0 &&
		    strcmp(line.name, search->point->line) == 0)
			hit(search, number, i, &line);
}

static void search_offset(struct search *search, struct gpio_chip *chip,
			  int number)
{
	const struct io_point *point = search->point;
	struct gpio_line line = { .used = false };

	search->lines = chip->lines;
	if (point->offset < chip->lines &&
	    gpio_chip_line(chip, point->offset, &line) != 0)
		return;
	hit(search, number, point->offset, &line);
}

/* The number of gpiochip7 or /dev/gpiochip7; -1: @text is a label. */
static int wanted_number(const char *text, const char *dev)
{
	size_t prefix = strlen(dev);
	int number, target;

	if (strncmp(text, dev, prefix) == 0 && text[prefix] == '/')
		text += prefix + 1;
	else if (strncmp(text, "/dev/", 5) == 0)
		text += 5;
	number = chip_number(text);
	target = number >= 0 ? link_target(dev, number) : -1;
	return target >= 0 ? target : number;
}

static void search_chip(struct search *search, int number, int wanted)
{
	const struct io_point *point = search->point;
	struct gpio_chip chip;
	char path[PATH_BYTES];
	int error;

	if (wanted >= 0 && wanted != number)
		return;
	gpio_path(search->dev, number, path, sizeof(path));
	error = gpio_chip_open(path, &chip);
	if (is_denied(error)) {
		denied_add(&search->denied, path);
	} else if (error && search->failed < 0 && !is_gone(error)) {
		search->failed = number;
		search->error = error;
	}
	if (error)
		return;
	if (point->line)
		search_names(search, &chip, number);
	else if (wanted >= 0 || strcmp(chip.label, point->chip) == 0)
		search_offset(search, &chip, number);
	gpio_chip_close(&chip);
}

static bool not_found(const struct search *search, struct trouble *why)
{
	char path[PATH_BYTES];

	if (search->denied.count > 0)
		return denied_say(&search->denied, why);
	if (search->failed >= 0) {
		gpio_path(search->dev, search->failed, path, sizeof(path));
		return refused(why, path, search->error);
	}
	if (search->point->line)
		return trouble_set(why, DIAG_IO_NO_LINE, "%s",
				   search->point->line);
	return trouble_set(why, DIAG_IO_NO_CHIP, "%s", search->point->chip);
}

bool gpio_find(const struct io_point *point, const char *dev,
	       struct line_at *out, struct trouble *why)
{
	struct search search = { .point = point, .dev = dev, .failed = -1 };
	int wanted = point->chip ? wanted_number(point->chip, dev) : -1;

	for (int number = chip_after(dev, -1); number >= 0;
	     number = chip_after(dev, number))
		search_chip(&search, number, wanted);
	if (search.hits == 0)
		return not_found(&search, why);
	if (search.hits > 1 && point->chip)
		return trouble_set(why, DIAG_IO_CHIP_AMBIGUOUS, "%s",
				   point->chip);
	if (search.hits > 1)
		return trouble_set(why, DIAG_IO_LINE_AMBIGUOUS,
				   "%.20s" DIAG_AND "gpiochip%d, %d", point->line,
				   search.at.chip, search.second);
	if (point->chip && point->offset >= search.lines)
		return trouble_set(why, DIAG_IO_NO_OFFSET,
				   "%.20s" DIAG_AND "%u" DIAG_AND "%u",
				   point->chip, (unsigned)point->offset,
				   (unsigned)search.lines);
	*out = search.at;
	return !search.line.used || strcmp(search.line.owner, GPIO_GUARD) == 0 ||
	       busy(why, point, &search.line);
}

static void list_chip(struct gpio_chip *chip, int number,
		      void (*visit)(void *context,
				    const struct line_seen *line),
		      void *context)
{
	char name[sizeof(CHIP_PREFIX) + 12];
	struct gpio_line line;

	snprintf(name, sizeof(name), CHIP_PREFIX "%d", number);
	for (uint32_t i = 0; i < chip->lines; i++) {
		struct line_seen seen = {
			.chip = name, .label = chip->label, .offset = i,
			.name = line.name, .owner = line.owner,
		};

		if (gpio_chip_line(chip, i, &line) != 0)
			continue;
		seen.used = line.used;
		seen.output = line.output;
		seen.active_low = line.active_low;
		seen.bias = line.bias;
		visit(context, &seen);
	}
}

bool gpio_list(const char *dev,
	       void (*visit)(void *context, const struct line_seen *line),
	       void *context, struct trouble *why)
{
	struct denied denied = { .count = 0 };
	bool good = true;

	for (int number = chip_after(dev, -1); number >= 0;
	     number = chip_after(dev, number)) {
		struct gpio_chip chip;
		char path[PATH_BYTES];
		int error;

		gpio_path(dev, number, path, sizeof(path));
		error = gpio_chip_open(path, &chip);
		if (is_denied(error))
			denied_add(&denied, path);
		else if (error && !is_gone(error))
			good = refused(why, path, error);
		if (error)
			continue;
		list_chip(&chip, number, visit, context);
		gpio_chip_close(&chip);
	}
	return denied.count > 0 ? denied_say(&denied, why) : good;
}
