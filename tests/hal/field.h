/* SPDX-License-Identifier: MIT
 *
 * field - points with channels that are made by hand, and a folder in place of /sys, for tests of channels.
 */
#ifndef TESTS_HAL_FIELD_H
#define TESTS_HAL_FIELD_H

#include "hal/channels.h"
#include "tests/tap.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define MS INT64_C(1000000)
#define FIELD_POINTS 80

struct field {
	struct arena arena;
	struct diag_list diags;
	struct iomap map;
	struct io_point point[FIELD_POINTS];
	struct io_channel channel[FIELD_POINTS];
	struct hal hal;
	struct image image;
	struct program program; /* only its areas are set                     */
	char text[300];         /* of a diagnostic                            */
	uint64_t memory[8192];
};

static char field_sys[200];

static inline const char *sys_path(const char *name)
{
	static char path[400];

	snprintf(path, sizeof(path), "%s/%s", field_sys, name);
	return path;
}

/* Makes the folders of a file, and the file. */
static inline void sys_put(const char *name, const char *text)
{
	char path[400];
	FILE *file;

	snprintf(path, sizeof(path), "%s", sys_path(name));
	for (char *at = path + strlen(field_sys) + 1; *at; at++)
		if (*at == '/') {
			*at = '\0';
			mkdir(path, 0755);
			*at = '/';
		}
	file = fopen(path, "w");
	if (file) {
		fputs(text, file);
		fclose(file);
	}
}

/* What a file has now; a shorter value over a longer one leaves the rest of it, as in the memory of a test only:
 * up to the first newline. */
static inline long sys_get(const char *name)
{
	char text[100] = "";
	FILE *file = fopen(sys_path(name), "r");

	if (!file)
		return -1;
	if (!fgets(text, sizeof(text), file))
		text[0] = '\0';
	fclose(file);
	return *text ? strtol(text, NULL, 10) : -2;
}

static inline void sys_remove(const char *name)
{
	char command[500];

	snprintf(command, sizeof(command), "rm -rf '%s'", sys_path(name));
	if (system(command) != 0)
		printf("# %s\n", command);
}

static inline bool sys_begin(void)
{
	const char *root = getenv("TMPDIR");

	snprintf(field_sys, sizeof(field_sys), "%s/sys-XXXXXX",
		 root && strlen(root) < 150 ? root : "/tmp");
	return mkdtemp(field_sys);
}

static inline int64_t now(void)
{
	struct timespec time;

	clock_gettime(CLOCK_MONOTONIC, &time);
	return time.tv_sec * INT64_C(1000000000) + time.tv_nsec;
}

static inline void nap(int ms)
{
	const struct timespec time = { ms / 1000, ms % 1000 * 1000000 };

	nanosleep(&time, NULL);
}

static inline void field_begin(struct field *f)
{
	memset(f, 0, sizeof(*f));
	arena_init(&f->arena);
	diag_init(&f->diags);
	areas_init(&f->program.areas);
	f->image.memory = (uint8_t *)f->memory;
	f->image.program = &f->program;
	f->map = (struct iomap){ .file = "test.io", .board = "x", .dev = "/nowhere", .sys = field_sys,
				 .point = f->point };
}

/* One more point, in the line of its number; a channel as the reader of maps makes it. */
static inline struct io_channel *field_add(struct field *f, const char *address, enum driver_id driver,
					   enum iec_type type)
{
	const int i = f->map.count++;
	struct io_point *point = &f->point[i];
	struct io_channel *channel = &f->channel[i];

	iec_addr_parse(address, strlen(address), &point->addr);
	point->driver = driver;
	point->output = iec_area_row(point->addr.area)->access == ACCESS_WRITE;
	point->text_line = i + 2;
	point->text_column = 1;
	point->channel = channel;
	*channel = (struct io_channel){
		.type = type, .raw = type, .stale_ns = IO_STALE_NS, .poll_ns = 20 * MS,
		.refresh_ns = IO_REFRESH_NS, .bus = -1, .module = -1, .reg_bit = -1, .device = "", .name = "",
		.period_ns = 20 * MS,
	};
	if (driver == DRIVER_iio || driver == DRIVER_pwm || driver == DRIVER_w1 || driver == DRIVER_hwmon)
		channel->raw = IEC_LREAL;
	return channel;
}

static inline bool field_open(struct field *f)
{
	if (hal_open(&f->hal, &f->map, &f->arena, &f->diags))
		return true;
	diag_print(&f->diags.diag[0], f->text, sizeof(f->text));
	printf("# %s\n", f->text);
	return false;
}

static inline void field_end(struct field *f)
{
	hal_close(&f->hal);
	arena_free(&f->arena);
}

static inline bool field_scan(struct field *f, int64_t at_ns)
{
	const bool good = ReadPhysicalInputs(&f->hal, &f->image, at_ns);

	return WritePhysicalOutputs(&f->hal, &f->image, at_ns) && good;
}

static inline union iec_value field_get(struct field *f, int i)
{
	const struct iec_addr addr = f->point[i].addr;
	const uint8_t *byte = image_area(&f->image, addr.area) + addr.byte;

	if (addr.bits == 1)
		return (union iec_value){ .i = *byte >> addr.bit & 1 };
	return iec_load(byte, f->channel[i].type);
}

static inline void field_set(struct field *f, int i, union iec_value value)
{
	const struct iec_addr addr = f->point[i].addr;
	uint8_t *byte = image_area(&f->image, addr.area) + addr.byte;

	if (addr.bits == 1)
		*byte = (uint8_t)((*byte & ~(1u << addr.bit)) | (unsigned)value.i << addr.bit);
	else
		iec_store(byte, f->channel[i].type, value);
}

static inline enum hal_quality field_quality(struct field *f, int i)
{
	return channels_point(f->hal.channels, i);
}

#define INT(x)  ((union iec_value){ .i = (x) })
#define REAL(x) ((union iec_value){ .r = (x) })

/* Scans until it is so, or for that time. */
#define UNTIL(f, condition, ms) \
	({ const int64_t end_ = now() + (ms) * MS; \
	   do { field_scan(f, now()); if (condition) break; nap(2); } while (now() < end_); \
	   (condition); })
#endif
