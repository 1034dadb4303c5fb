/* SPDX-License-Identifier: MIT
 *
 * bench - a map, a HAL and an image for the HAL suite. The device files are empty files in
 * a folder of the test; the chips are fake.
 */
#ifndef TESTS_HAL_BENCH_H
#define TESTS_HAL_BENCH_H

#include "hal/drivers.h"
#include "hal/hal.h"
#include "tests/hal/fake.h"
#include "tests/tap.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#define MS INT64_C(1000000)

struct bench {
	struct arena arena;
	struct diag_list diags;
	struct iomap map;
	struct hal hal;
	struct image image;
	struct program program; /* only its areas are set                     */
	char text[300];       /* of the first diagnostic                    */
	uint8_t memory[65536];
};

static char dev_folder[200];

/* Makes a folder with gpiochip0 … gpiochip3; NULL: it cannot be made. */
static inline const char *bench_dev(void)
{
	const char *root = getenv("TMPDIR");
	char path[250];

	if (dev_folder[0])
		return dev_folder;
	snprintf(dev_folder, sizeof(dev_folder), "%s/hal-XXXXXX",
		 root && strlen(root) < 150 ? root : "/tmp");
	if (!mkdtemp(dev_folder))
		return NULL;
	for (int i = 0; i < FAKE_CHIPS; i++) {
		FILE *file;

		snprintf(path, sizeof(path), "%s/gpiochip%d", dev_folder, i);
		file = fopen(path, "w");
		if (file)
			fclose(file);
	}
	return dev_folder;
}

static inline void bench_remove_dev(void)
{
	char path[250];

	for (int i = 0; i < FAKE_CHIPS; i++) {
		snprintf(path, sizeof(path), "%s/gpiochip%d", dev_folder, i);
		unlink(path);
	}
	rmdir(dev_folder);
}

/* Chip 0 "panel": IN0 … IN99, OUT0 … OUT99. Chip 1 "far": FAR0 … FAR7. */
static inline void chips(void)
{
	static char name[200][8];

	fake_reset();
	fake.chip[0].label = "panel";
	fake.chip[0].lines = 200;
	fake.chip[0].present = true;
	for (int i = 0; i < 200; i++) {
		snprintf(name[i], sizeof(name[i]), "%s%d",
			 i < 100 ? "IN" : "OUT", i % 100);
		fake.chip[0].line[i].name = name[i];
	}
	fake.chip[1].label = "far";
	fake.chip[1].lines = 8;
	fake.chip[1].present = true;
	fake.chip[1].line[0].name = "FAR0";
}

static inline int level(const char *name)
{
	for (int chip = 0; chip < FAKE_CHIPS; chip++)
		for (int i = 0; i < FAKE_LINES; i++) {
			const struct fake_line *line = &fake.chip[chip].line[i];

			if (line->name && strcmp(line->name, name) == 0)
				return line->level;
		}
	return -1;
}

/* Lets only @group open a chip, if @mode allows it. */
static inline bool bench_deny(int chip, mode_t mode, long group)
{
	char path[250];

	snprintf(path, sizeof(path), "%s/gpiochip%d", dev_folder, chip);
	fake.chip[chip].present = true;
	fake.chip[chip].open_error = EACCES;
	return (!(mode & 020) || chown(path, (uid_t)-1, (gid_t)group) == 0) &&
	       chmod(path, mode) == 0;
}

static inline void bench_begin(struct bench *b)
{
	memset(b, 0, sizeof(*b));
	arena_init(&b->arena);
	diag_init(&b->diags);
	areas_init(&b->program.areas);
	b->image.memory = b->memory;
	b->image.program = &b->program;
}

static inline bool bench_map(struct bench *b, const char *text)
{
	if (!iomap_read(&b->map, &b->arena, "test.io", text, strlen(text),
			&b->diags))
		return false;
	b->map.dev = bench_dev();
	return true;
}

static inline bool bench_open(struct bench *b, const char *text)
{
	bench_begin(b);
	if (bench_map(b, text) &&
	    hal_open(&b->hal, &b->map, &b->arena, &b->diags))
		return true;
	diag_print(&b->diags.diag[0], b->text, sizeof(b->text));
	printf("# %s\n", b->text);
	return false;
}

static inline void bench_end(struct bench *b)
{
	hal_close(&b->hal);
	arena_free(&b->arena);
}

/* Checks that a map with these lines is refused with a diagnostic that contains @want. */
static inline bool refused_like(struct bench *b, const char *lines,
				const char *want)
{
	char text[400];
	bool good;

	snprintf(text, sizeof(text), "BOARD \"x\"\n%s\n", lines);
	bench_begin(b);
	good = !(bench_map(b, text) &&
		 hal_open(&b->hal, &b->map, &b->arena, &b->diags)) &&
	       b->diags.errors == 1;
	diag_print(&b->diags.diag[0], b->text, sizeof(b->text));
	good = good && strstr(b->text, want);
	if (!good)
		printf("# got: %s\n", b->text);
	bench_end(b);
	return good;
}

static inline bool refused(struct bench *b, const char *lines, const char *want)
{
	size_t got, wanted = strlen(want);

	if (!refused_like(b, lines, want))
		return false;
	got = strlen(b->text);
	return got >= wanted && strcmp(b->text + got - wanted, want) == 0;
}

static inline bool scan(struct bench *b, int64_t now_ns)
{
	bool good = ReadPhysicalInputs(&b->hal, &b->image, now_ns);

	return WritePhysicalOutputs(&b->hal, &b->image, now_ns) && good;
}

static inline bool input(struct bench *b, int bit)
{
	return image_area(&b->image, AREA_I)[bit / 8] >> bit % 8 & 1;
}

static inline void output(struct bench *b, int bit, bool value)
{
	uint8_t *byte = &image_area(&b->image, AREA_Q)[bit / 8];
	uint8_t mask = (uint8_t)(1u << bit % 8);

	*byte = value ? *byte | mask : *byte & (uint8_t)~mask;
}
#endif
