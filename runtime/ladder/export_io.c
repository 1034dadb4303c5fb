/* SPDX-License-Identifier: MIT
 *
 * export_io - an I/O map as lines of ioconf.csv. They know pins of a Raspberry Pi by their
 * GPIO numbers, inputs that are always pulled up, and one sampling for all of them.
 */
#include "ladder/export_io.h"

#include "hal/iomap.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RASPBERRY = 2, SAMPLES = 3, PINS = 1000 };

struct leaving_map {
	const struct iomap *map;
	struct arena *arena;
	struct classic_lines *lines;
	struct classic_io *io; /* of @lines; it grows                          */
};

static __attribute__((format(printf, 3, 4)))
void tell(const struct leaving_map *m, const struct io_point *point, const char *text, ...)
{
	char address[24];
	va_list args;

	iec_addr_print(point->addr, address, sizeof(address));
	fprintf(stderr, "%s:%d: changed: %s: ", m->map->file, point->text_line, address);
	va_start(args, text);
	vfprintf(stderr, text, args);
	va_end(args);
	fprintf(stderr, "\n");
}

/* GPIO17, or line 17 of the chip that has these; -1: it is none of them. */
static int pin_of(const struct io_point *point)
{
	char *end;
	long pin = -1;

	if (point->line && !strncmp(point->line, "GPIO", 4)) {
		pin = strtol(point->line + 4, &end, 10);
		if (end == point->line + 4 || *end)
			return -1;
	} else if (point->chip && !strncmp(point->chip, "pinctrl-bcm", 11)) {
		pin = (long)point->offset;
	}
	return pin >= 0 && pin < PINS ? (int)pin : -1;
}

/* Of all inputs alike there. */
static void note_debounce(struct leaving_map *m, const struct io_point *point)
{
	int ms = (int)((point->debounce_ns + 999999) / 1000000);
	int sample = (ms + SAMPLES - 1) / SAMPLES;

	if (!m->lines->sample_ms && sample)
		m->lines->sample_ms = sample;
	if (ms != SAMPLES * (m->lines->sample_ms ? m->lines->sample_ms : 10))
		tell(m, point, "must be steady for %d ms in ClassicLadder, as all inputs",
		     SAMPLES * (m->lines->sample_ms ? m->lines->sample_ms : 10));
}

static void tell_rest(struct leaving_map *m, const struct io_point *point)
{
	if (!point->output && point->bias != BIAS_UP)
		tell(m, point, "has a pull-up in ClassicLadder");
	if (point->output && point->bias != BIAS_AS_IS)
		tell(m, point, "an output has no pull in ClassicLadder");
	if (point->output && point->drive != DRIVE_AS_IS && point->drive != DRIVE_PUSH_PULL)
		tell(m, point, "is driven to both levels in ClassicLadder");
	if (point->safe)
		tell(m, point, "has no safe value in ClassicLadder: it stays as it is");
}

static bool goes_on(const struct classic_io *last, const struct io_point *point, int bit,
		    int pin)
{
	return last && last->output == point->output && last->inverted == point->active_low &&
	       last->first + last->count == bit && last->channel + last->count == pin;
}

static void add_point(struct leaving_map *m, const struct io_point *point)
{
	const int bit = (int)point->addr.byte * 8 + point->addr.bit, pin = pin_of(point);
	struct classic_lines *lines = m->lines;
	struct classic_io *last = lines->count ? &m->io[lines->count - 1] : NULL;

	if (point->driver != DRIVER_gpio || pin < 0) {
		tell(m, point, "is no pin of a Raspberry Pi (line=GPIO17) and is not exported");
		return;
	}
	tell_rest(m, point);
	if (!point->output)
		note_debounce(m, point);
	if (goes_on(last, point, bit, pin)) {
		last->count++;
		return;
	}
	last = arena_push(m->arena, &m->io, &lines->count, sizeof(*last));
	if (last)
		*last = (struct classic_io){ .output = point->output, .first = bit,
			.device = RASPBERRY, .channel = pin, .count = 1,
			.inverted = point->active_low };
}

bool export_lines(const char *path, const char *text, size_t len, struct arena *arena,
		  struct classic_lines *lines)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	struct iomap map = { .file = path };
	struct leaving_map m = { &map, arena, lines, NULL };
	bool good;

	*lines = (struct classic_lines){ 0 };
	if (!diags)
		return report_no_memory(path) == STATUS_GOOD;
	diag_init(diags);
	good = iomap_read(&map, arena, path, text, len, diags);
	report_diags(diags);
	free(diags);
	for (int i = 0; good && i < map.count; i++)
		add_point(&m, &map.point[i]);
	lines->io = m.io;
	return good && !arena->failed;
}
