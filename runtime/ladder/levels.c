/* SPDX-License-Identifier: MIT
 *
 * levels - reads /sys/kernel/debug/gpio, where a chip is
 *   gpiochip0: GPIOs 512-565, parent: platform/…
 * and below it a line that somebody has, with the number of the chip's first added,
 *    gpio-529 (GPIO17              |ladderd             ) in  hi ACTIVE LOW
 * A driver may have words of its own for it, and tell no level of an input. Newer
 * kernels count from 0 (`gpiochip0: 54 GPIOs, …`). Anything else is passed over.
 */
#include "ladder/levels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LEVELS_FILE "/sys/kernel/debug/gpio"

struct chip_seen {
	char name[24];
	uint32_t first;
	bool good;
};

static bool read_number(const char **at, uint32_t *out)
{
	char *end;
	unsigned long number;

	if (**at < '0' || **at > '9')
		return false;
	number = strtoul(*at, &end, 10);
	*at = end;
	*out = (uint32_t)number;
	return number <= 1000000;
}

static void read_chip(const char *line, struct chip_seen *chip)
{
	size_t len = strcspn(line, ":");
	const char *at = line + len;
	uint32_t count;

	chip->good = false;
	if (len >= sizeof(chip->name) || *at != ':')
		return;
	memcpy(chip->name, line, len);
	chip->name[len] = '\0';
	chip->first = 0;
	if (!strncmp(at, ": GPIOs ", 8)) {
		at += 8;
		chip->good = read_number(&at, &chip->first) && *at == '-';
	} else if (!strncmp(at, ": ", 2)) {
		at += 2;
		chip->good = read_number(&at, &count) &&
			     !strncmp(at, " GPIOs", 6);
	}
}

/* The level behind the last bracket: a name may have brackets of its own. */
static enum level read_level(const char *line)
{
	const char *at = strrchr(line, ')');

	if (!at)
		return LEVEL_UNKNOWN;
	at++;
	at += strspn(at, " ");
	if (!strncmp(at, "output-", 7)) /* gpio-sim says it so            */
		at += 7;
	else if (!strncmp(at, "in ", 3) || !strncmp(at, "out ", 4))
		at += strcspn(at, " ");
	else
		return LEVEL_UNKNOWN;
	at += strspn(at, " ");
	if (!strncmp(at, "hi", 2))
		return LEVEL_HIGH;
	return !strncmp(at, "lo", 2) ? LEVEL_LOW : LEVEL_UNKNOWN;
}

bool levels_read(void (*visit)(void *context, const char *chip,
			       uint32_t offset, enum level level),
		 void *context)
{
	struct chip_seen chip = { .good = false };
	FILE *file = fopen(LEVELS_FILE, "r");
	char line[512];

	if (!file)
		return false;
	while (fgets(line, sizeof(line), file)) {
		const char *at = line + strspn(line, " ");
		enum level level = read_level(line);
		uint32_t number;

		if (!strncmp(line, "gpiochip", 8)) {
			read_chip(line, &chip);
			continue;
		}
		if (!chip.good || strncmp(at, "gpio-", 5) != 0)
			continue;
		at += 5;
		if (read_number(&at, &number) && number >= chip.first &&
		    level != LEVEL_UNKNOWN)
			visit(context, chip.name, number - chip.first, level);
	}
	fclose(file);
	return true;
}
