/* SPDX-License-Identifier: MIT
 *
 * io_fake - `ladder` with fake chips, for `ladder io`. The environment controls the chips:
 *
 *   FAKE_DEV     folder in place of /dev
 *   FAKE_SYS     folder in place of /sys, for a map
 *   FAKE_TAKEN   while a file of this name exists, ladderd uses three lines
 *   FAKE_LEVELS  file in place of the kernel's list of levels
 *   FAKE_DENIED  the second chip cannot be opened
 */
#include "tests/hal/fake.h"

#include "hal/iomap.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

DIR *__real_opendir(const char *path);
DIR *__wrap_opendir(const char *path);
FILE *__real_fopen(const char *path, const char *mode);
FILE *__wrap_fopen(const char *path, const char *mode);
FILE *__wrap_fopen64(const char *path, const char *mode);

DIR *__wrap_opendir(const char *path)
{
	const char *dev = getenv("FAKE_DEV");

	return __real_opendir(dev && strcmp(path, "/dev") == 0 ? dev : path);
}

FILE *__wrap_fopen(const char *path, const char *mode)
{
	const char *levels = getenv("FAKE_LEVELS");

	if (strcmp(path, "/sys/kernel/debug/gpio") == 0)
		path = levels ? levels : "";
	return __real_fopen(path, mode);
}

FILE *__wrap_fopen64(const char *path, const char *mode)
{
	return __wrap_fopen(path, mode);
}

bool __real_iomap_read(struct iomap *map, struct arena *arena, const char *file, const char *text,
		       size_t len, struct diag_list *diags);
bool __wrap_iomap_read(struct iomap *map, struct arena *arena, const char *file, const char *text,
		       size_t len, struct diag_list *diags);

bool __wrap_iomap_read(struct iomap *map, struct arena *arena, const char *file, const char *text,
		       size_t len, struct diag_list *diags)
{
	const bool good = __real_iomap_read(map, arena, file, text, len, diags);

	map->sys = getenv("FAKE_SYS");
	return good;
}

static void set_up(void)
{
	static const char *const names[] = { "IN0", "IN1", "OUT0", "OUT1" };
	const char *taken = getenv("FAKE_TAKEN");
	bool used = taken && access(taken, F_OK) == 0;

	fake.chip[0].label = "panel";
	fake.chip[0].lines = 4;
	fake.chip[0].present = true;
	for (int i = 0; i < 4; i++) {
		struct fake_line *line = &fake.chip[0].line[i];

		line->name = names[i];
		line->used = used && i < 3;
		line->owner = line->used ? "ladderd" : NULL;
		line->output = line->used && i == 2;
	}
	fake.chip[0].line[0].bias = used ? 'u' : '-';
	fake.chip[0].line[1].bias = used ? 'd' : '-';
	fake.chip[0].line[1].active_low = used;
	fake.chip[1].label = "rest";
	fake.chip[1].lines = 2;
	fake.chip[1].present = true;
	fake.chip[1].open_error = getenv("FAKE_DENIED") ? EACCES : 0;
	fake.chip[1].line[0].used = true;
}

__attribute__((constructor)) static void begin(void)
{
	fake_at_open = set_up;
}
