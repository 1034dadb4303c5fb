/* SPDX-License-Identifier: MIT
 *
 * bank - controls gpio-sim through configfs (the chip) and sysfs (its lines). A step that
 * fails ends the suite, because then the guest is broken, not ladderd.
 */
#include "tests/targets/guest/bank.h"

#include "tests/targets/guest/guest.h"

#include <fcntl.h>
#include <linux/gpio.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#define SIM "/sys/kernel/config/gpio-sim"

static void put(const char *path, const char *text)
{
	int fd = open(path, O_WRONLY);

	if (fd < 0 || write(fd, text, strlen(text)) < 0)
		give_up(path);
	close(fd);
}

static void take(const char *path, char *text, size_t room)
{
	if (file_take(path, text, room) < 0)
		give_up(path);
	text[strcspn(text, "\n")] = 0;
}

static void make(const char *path)
{
	if (mkdir(path, 0755) != 0)
		give_up(path);
}

bool bank_can(void)
{
	return file_is_there(SIM);
}

static void open_values(struct bank *bank)
{
	char path[PATH_MOST];

	for (unsigned i = 0; i < bank->count; i++) {
		snprintf(path, sizeof(path), "%s/sim_gpio%u/value",
			 bank->lines, i);
		bank->value[i] = open(path, O_RDONLY | O_CLOEXEC);
		if (bank->value[i] < 0)
			give_up(path);
	}
}

void bank_plug(struct bank *bank)
{
	char path[PATH_MOST], device[BANK_NAME];

	snprintf(path, sizeof(path), SIM "/%s/live", bank->word);
	put(path, "1");
	snprintf(path, sizeof(path), SIM "/%s/dev_name", bank->word);
	take(path, device, sizeof(device));
	snprintf(path, sizeof(path), SIM "/%s/lines/chip_name", bank->word);
	take(path, bank->chip, sizeof(bank->chip));
	snprintf(bank->lines, sizeof(bank->lines),
		 "/sys/devices/platform/%s/%s", device, bank->chip);
	open_values(bank);
	for (int i = 0; i < 200; i++) {
		snprintf(path, sizeof(path), "/dev/%s", bank->chip);
		if (file_is_there(path))
			return;
		sleep_ms(10);
	}
	give_up(path);
}

static void name_line(const char *lines, unsigned line, const char *name,
		      bool hog)
{
	char path[PATH_MOST];

	snprintf(path, sizeof(path), "%s/line%u", lines, line);
	make(path);
	if (name) {
		snprintf(path, sizeof(path), "%s/line%u/name", lines, line);
		put(path, name);
	}
	if (!hog)
		return;
	snprintf(path, sizeof(path), "%s/line%u/hog", lines, line);
	make(path);
	snprintf(path, sizeof(path), "%s/line%u/hog/name", lines, line);
	put(path, "other");
	snprintf(path, sizeof(path), "%s/line%u/hog/direction", lines, line);
	put(path, "output-high");
}

void bank_up(struct bank *bank, const char *word, const char *const *name,
	     unsigned count, int hog)
{
	char path[PATH_MOST], lines[PATH_MOST / 2], number[16];

	memset(bank, 0, sizeof(*bank));
	bank->watch = -1;
	bank->count = count;
	snprintf(bank->word, sizeof(bank->word), "%s", word);
	snprintf(path, sizeof(path), SIM "/%s", word);
	make(path);
	snprintf(lines, sizeof(lines), SIM "/%s/lines", word);
	make(lines);
	snprintf(number, sizeof(number), "%u", count);
	snprintf(path, sizeof(path), "%s/num_lines", lines);
	put(path, number);
	snprintf(path, sizeof(path), "%s/label", lines);
	put(path, word);
	for (unsigned i = 0; i < count; i++)
		if ((name && name[i]) || (int)i == hog)
			name_line(lines, i, name ? name[i] : NULL,
				  (int)i == hog);
	bank_plug(bank);
}

static void forget(struct bank *bank)
{
	for (unsigned i = 0; i < bank->count; i++)
		close(bank->value[i]);
	if (bank->watch >= 0)
		close(bank->watch);
	bank->watch = -1;
}

void bank_unplug(struct bank *bank)
{
	char path[PATH_MOST];

	forget(bank);
	bank->chip[0] = 0;
	snprintf(path, sizeof(path), SIM "/%s/live", bank->word);
	put(path, "0");
}

/* Folders must be removed from the inside out; missing ones are ignored. */
void bank_down(struct bank *bank)
{
	char path[PATH_MOST];

	if (bank->chip[0])
		bank_unplug(bank);
	for (unsigned i = 0; i < bank->count; i++) {
		snprintf(path, sizeof(path), SIM "/%s/lines/line%u/hog",
			 bank->word, i);
		rmdir(path);
		snprintf(path, sizeof(path), SIM "/%s/lines/line%u",
			 bank->word, i);
		rmdir(path);
	}
	snprintf(path, sizeof(path), SIM "/%s/lines", bank->word);
	rmdir(path);
	snprintf(path, sizeof(path), SIM "/%s", bank->word);
	if (rmdir(path) != 0)
		give_up(path);
}

void bank_pull(struct bank *bank, unsigned line, bool up)
{
	char path[PATH_MOST];

	snprintf(path, sizeof(path), "%s/sim_gpio%u/pull", bank->lines, line);
	put(path, up ? "pull-up" : "pull-down");
}

bool bank_level(struct bank *bank, unsigned line)
{
	char level = '?';

	if (pread(bank->value[line], &level, 1, 0) != 1)
		give_up("value of a line");
	return level == '1';
}

uint32_t bank_levels(struct bank *bank, unsigned first, unsigned count)
{
	uint32_t levels = 0;

	for (unsigned i = 0; i < count; i++)
		levels |= (uint32_t)bank_level(bank, first + i) << i;
	return levels;
}

bool bank_shows(struct bank *bank, unsigned first, unsigned count,
		uint32_t want, int64_t ms)
{
	int64_t end_ns = clock_now() + ms * MS;

	while (bank_levels(bank, first, count) != want) {
		if (clock_now() >= end_ns)
			return false;
		sleep_ms(1);
	}
	return true;
}

void bank_watch(struct bank *bank)
{
	char path[PATH_MOST];

	snprintf(path, sizeof(path), "/dev/%s", bank->chip);
	bank->watch = open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
	if (bank->watch < 0)
		give_up(path);
	for (unsigned i = 0; i < bank->count; i++) {
		struct gpio_v2_line_info line = { .offset = i };

		if (ioctl(bank->watch, GPIO_V2_GET_LINEINFO_WATCH_IOCTL,
			  &line) != 0)
			give_up("GPIO_V2_GET_LINEINFO_WATCH_IOCTL");
	}
}

static bool next_event(struct bank *bank, struct gpio_v2_line_info_changed *out)
{
	return read(bank->watch, out, sizeof(*out)) == (ssize_t)sizeof(*out);
}

unsigned bank_events(struct bank *bank)
{
	struct gpio_v2_line_info_changed event;
	unsigned count = 0;

	while (next_event(bank, &event))
		count++;
	return count;
}

bool bank_was_taken(struct bank *bank, unsigned line)
{
	struct gpio_v2_line_info_changed event;
	bool taken = false;

	while (next_event(bank, &event))
		taken = taken ||
			(event.event_type == GPIO_V2_LINE_CHANGED_REQUESTED &&
			 event.info.offset == line);
	return taken;
}
