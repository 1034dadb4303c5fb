/* SPDX-License-Identifier: MIT
 *
 * lines - asks for all lines of a chip at once; if the kernel refuses, for each alone.
 */
#define _DEFAULT_SOURCE
#include "guard/lines.h"

#include "guard/text.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <stddef.h>
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
	if (lines->waits) {
		lines->table = lines->next;
		lines->more = 0;
	}
	lines->waits = false;
}

static int count_of(const struct lines *lines)
{
	return lines->table.head.count + lines->more;
}

/* The line of the table at the same place; NULL: none. */
static const struct guard_line *find(const struct lines *lines, const struct guard_line *line)
{
	for (int i = 0; i < count_of(lines); i++)
		if (lines->table.line[i].chip == line->chip &&
		    lines->table.line[i].offset == line->offset)
			return &lines->table.line[i];
	return NULL;
}

void lines_know(struct lines *lines, const struct guard_table *table)
{
	memset(&lines->next, 0, sizeof(lines->next));
	memcpy(&lines->next, table, offsetof(struct guard_table, line) +
	       table->head.count * sizeof(table->line[0]));
	for (int i = 0; i < table->head.count; i++) {
		struct guard_line *line = &lines->next.line[i];
		const struct guard_line *known = find(lines, line);

		if (line->hold == GUARD_KNOWN && known)
			line->level = known->level;
	}
	lines->waits = true;
	for (int i = 0; i < GUARD_LINES; i++)
		if (lines->held[i])
			return;
	lines_release(lines);
}

void lines_more(struct lines *lines, const struct guard_table *more)
{
	lines->more = 0;
	if (lines->waits)
		return;
	for (int i = 0; i < more->head.count && count_of(lines) < GUARD_LINES; i++)
		if (!find(lines, &more->line[i]))
			lines->table.line[lines->table.head.count + lines->more++] = more->line[i];
}

void lines_levels(struct lines *lines, const struct guard_levels *levels)
{
	for (int i = 0; !lines->waits && i < lines->table.head.count; i++)
		if (lines->table.line[i].hold)
			lines->table.line[i].level = levels->bit[i / 8] >> i % 8 & 1;
}

void lines_answer(const struct lines *lines, struct guard_levels *out)
{
	memset(out, 0, sizeof(*out));
	out->head = (struct guard_head){ .magic = GUARD_MAGIC, .kind = GUARD_TAKE };
	for (int i = 0; i < lines->table.head.count; i++)
		out->bit[i / 8] |= (uint8_t)(lines->table.line[i].level << i % 8);
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
	lines->fd[number[0]] = (int16_t)ask.fd;
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
		text_say("line %u of gpiochip%u is held by \"%s\": it is "
			"not safe; the guard tries again", (unsigned)line->offset,
			(unsigned)line->chip, about.consumer);
		return;
	}
	text_say("line %u of gpiochip%u is not safe: %s; the guard tries "
		"again", (unsigned)line->offset, (unsigned)line->chip, strerror(-error));
}

static bool same_request(const struct guard_line *a, const struct guard_line *b)
{
	return a->chip == b->chip && flags_of(a) == flags_of(b);
}

/* The lines not tried yet that go into one request with line @first. */
static uint32_t gather(const struct lines *lines, int first, bool *tried, int *number)
{
	uint32_t count = 0;

	for (int i = first; i < count_of(lines) && count < GPIO_V2_LINES_MAX; i++)
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

	text_print(path, sizeof(path), "%s/gpiochip%u", lines->table.dev,
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
	for (int i = 0; i < count_of(lines); i++)
		if (!tried[i])
			take_from(lines, i, tried);
	for (int i = 0; i < count_of(lines); i++)
		all = all && lines->held[i];
	return all;
}
