/* SPDX-License-Identifier: MIT
 *
 * lines - asks for all lines of a chip at once; if the kernel refuses, for each alone.
 */
#define _DEFAULT_SOURCE
#include "guard/lines.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

void lines_begin(struct lines *lines)
{
	memset(lines, 0, sizeof(*lines));
	for (int i = 0; i < GUARD_LINES; i++)
		lines->fd[i] = -1;
}

void lines_release(struct lines *lines)
{
	for (int i = 0; i < GUARD_LINES; i++) {
		if (lines->fd[i] >= 0)
			close(lines->fd[i]);
		lines->fd[i] = -1;
		lines->held[i] = lines->told[i] = false;
	}
	if (lines->waits)
		lines->table = lines->next;
	lines->waits = false;
}

void lines_know(struct lines *lines, const struct guard_table *table)
{
	memset(&lines->next, 0, sizeof(lines->next));
	memcpy(&lines->next, table, offsetof(struct guard_table, line) +
	       table->head.count * sizeof(table->line[0]));
	lines->waits = true;
	for (int i = 0; i < GUARD_LINES; i++)
		if (lines->held[i])
			return;
	lines_release(lines);
}

static uint64_t flags_of(const struct guard_line *line)
{
	static const uint64_t bias[] = {
		0, GPIO_V2_LINE_FLAG_BIAS_DISABLED, GPIO_V2_LINE_FLAG_BIAS_PULL_UP,
		GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN,
	};
	static const uint64_t drive[] = {
		0, 0, GPIO_V2_LINE_FLAG_OPEN_DRAIN, GPIO_V2_LINE_FLAG_OPEN_SOURCE,
	};

	return GPIO_V2_LINE_FLAG_OUTPUT | bias[line->bias] | drive[line->drive];
}

/* Requests @count lines of one chip and one set of flags. Returns 0 or -errno. */
static int request(struct lines *lines, int chip, const int *number, uint32_t count)
{
	struct gpio_v2_line_request ask;
	const uint64_t all = UINT64_MAX >> (64 - count);

	memset(&ask, 0, sizeof(ask));
	memcpy(ask.consumer, GUARD_OWNER, sizeof(GUARD_OWNER));
	ask.num_lines = count;
	ask.config.flags = flags_of(&lines->table.line[number[0]]);
	ask.config.num_attrs = 1;
	ask.config.attrs[0].attr.id = GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES;
	ask.config.attrs[0].mask = all;
	for (uint32_t i = 0; i < count; i++) {
		ask.offsets[i] = lines->table.line[number[i]].offset;
		ask.config.attrs[0].attr.values |=
			(uint64_t)lines->table.line[number[i]].level << i;
	}
	if (ioctl(chip, GPIO_V2_GET_LINE_IOCTL, &ask) < 0)
		return -errno;
	lines->fd[number[0]] = ask.fd;
	for (uint32_t i = 0; i < count; i++)
		lines->held[number[i]] = true;
	return 0;
}

static void tell(struct lines *lines, int number, int chip, int error)
{
	const struct guard_line *line = &lines->table.line[number];
	struct gpio_v2_line_info about;

	if (lines->told[number])
		return;
	lines->told[number] = true;
	memset(&about, 0, sizeof(about));
	about.offset = line->offset;
	if (error == -EBUSY && ioctl(chip, GPIO_V2_GET_LINEINFO_IOCTL, &about) == 0) {
		about.consumer[sizeof(about.consumer) - 1] = 0;
		dprintf(STDERR_FILENO, "ladder-guard: line %u of gpiochip%u is held by \"%s\": it is "
			"not safe; the guard tries again\n", (unsigned)line->offset,
			(unsigned)line->chip, about.consumer);
		return;
	}
	dprintf(STDERR_FILENO, "ladder-guard: line %u of gpiochip%u is not safe: %s; the guard tries "
		"again\n", (unsigned)line->offset, (unsigned)line->chip, strerror(-error));
}

static bool same_request(const struct guard_line *a, const struct guard_line *b)
{
	return a->chip == b->chip && flags_of(a) == flags_of(b);
}

/* The lines not tried yet that go into one request with line @first. */
static uint32_t gather(const struct lines *lines, int first, bool *tried, int *number)
{
	uint32_t count = 0;

	for (int i = first; i < lines->table.head.count && count < GPIO_V2_LINES_MAX; i++)
		if (!tried[i] &&
		    same_request(&lines->table.line[first], &lines->table.line[i])) {
			tried[i] = true;
			number[count++] = i;
		}
	return count;
}

static void take_from(struct lines *lines, int first, bool *tried)
{
	char path[GUARD_DEV + 24];
	int number[GPIO_V2_LINES_MAX];
	const uint32_t count = gather(lines, first, tried, number);
	int chip, error;

	snprintf(path, sizeof(path), "%s/gpiochip%u", lines->table.dev,
		 (unsigned)lines->table.line[first].chip);
	chip = open(path, O_RDWR | O_CLOEXEC | O_NONBLOCK);
	error = chip < 0 ? -errno : request(lines, chip, number, count);
	for (uint32_t i = 0; error && i < count; i++) {
		const int each = chip < 0 ? error : request(lines, chip, &number[i], 1);

		if (each)
			tell(lines, number[i], chip, each);
	}
	if (chip >= 0)
		close(chip);
}

bool lines_take(struct lines *lines)
{
	bool all = true, tried[GUARD_LINES];

	memcpy(tried, lines->held, sizeof(tried));
	for (int i = 0; i < lines->table.head.count; i++)
		if (!tried[i])
			take_from(lines, i, tried);
	for (int i = 0; i < lines->table.head.count; i++)
		all = all && lines->held[i];
	return all;
}
