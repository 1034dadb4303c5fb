/* SPDX-License-Identifier: MIT
 *
 * fake_uapi - the GPIO uAPI v2 of the kernel, as far as hal/gpio_uapi.c calls it, with the
 * fake chips. Linked with --wrap for open, close and ioctl; files that are no chip or
 * request of the test go to the real calls.
 */
#include "tests/hal/fake.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>

#define FAKE_FD   1000 /* smaller numbers are real files                 */
#define FAKE_OPEN 64

int __real_open(const char *path, int flags, ...);
int __real_close(int fd);
int __wrap_open(const char *path, int flags, ...);
int __wrap_open64(const char *path, int flags, ...)
	__attribute__((alias("__wrap_open"))); /* its name with 64-bit offsets */
int __wrap_close(int fd);
int __wrap_ioctl(int fd, unsigned long what, ...);
int __real_ioctl(int fd, unsigned long what, ...);

/* The object of a file number: a chip, or a request of its lines. */
static struct opened {
	struct fake_chip *chip;
	struct fake_request *request;
} opened[FAKE_OPEN];

static int take_number(struct opened what)
{
	for (int i = 0; i < FAKE_OPEN; i++)
		if (!opened[i].chip && !opened[i].request) {
			opened[i] = what;
			return FAKE_FD + i;
		}
	errno = EMFILE;
	return -1;
}

int __wrap_open(const char *path, int flags, ...)
{
	struct opened what = { 0 };
	va_list args;
	int mode;

	va_start(args, flags);
	mode = flags & O_CREAT ? va_arg(args, int) : 0;
	va_end(args);
	if (!strstr(path, "/gpiochip"))
		return __real_open(path, flags, mode);
	what.chip = fake_open(path);
	return what.chip ? take_number(what) : -1;
}

int __wrap_close(int fd)
{
	struct opened *what = fd >= FAKE_FD ? &opened[fd - FAKE_FD] : NULL;

	if (!what)
		return __real_close(fd);
	if (what->request) {
		fake_release(what->request);
		free(what->request);
	} else {
		fake_close();
	}
	memset(what, 0, sizeof(*what));
	return 0;
}

static void copy_text(char *out, const char *text)
{
	size_t len = text ? strlen(text) : 0;

	/* As in the kernel: clipped, and ended with a NUL. */
	if (len >= GPIO_MAX_NAME_SIZE)
		len = GPIO_MAX_NAME_SIZE - 1;
	if (len)
		memcpy(out, text, len);
	out[len] = 0;
}

static int chip_about(const struct fake_chip *chip, struct gpiochip_info *out)
{
	if (fake_fails())
		return -1;
	copy_text(out->label, chip->label);
	out->lines = chip->lines;
	return 0;
}

static int line_about(const struct fake_chip *chip, struct gpio_v2_line_info *out)
{
	struct fake_line line;

	if (fake_fails())
		return -1;
	if (out->offset >= chip->lines) {
		errno = EINVAL;
		return -1;
	}
	line = fake_line(chip, out->offset);
	copy_text(out->name, line.name);
	copy_text(out->consumer, line.owner);
	out->flags = (line.used ? GPIO_V2_LINE_FLAG_USED : 0) |
		     (line.output ? GPIO_V2_LINE_FLAG_OUTPUT :
				     GPIO_V2_LINE_FLAG_INPUT) |
		     (line.active_low ? GPIO_V2_LINE_FLAG_ACTIVE_LOW : 0) |
		     (line.bias == 'u' ? GPIO_V2_LINE_FLAG_BIAS_PULL_UP :
		      line.bias == 'd' ? GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN :
		      line.bias == 'n' ? GPIO_V2_LINE_FLAG_BIAS_DISABLED : 0);
	return 0;
}

/* The flags of line @i: those of the last attribute that names it, else those of the
 * request. */
static uint64_t flags_of(const struct gpio_v2_line_config *config, uint32_t i)
{
	uint64_t flags = config->flags;

	for (uint32_t k = 0; k < config->num_attrs; k++)
		if (config->attrs[k].attr.id == GPIO_V2_LINE_ATTR_ID_FLAGS &&
		    config->attrs[k].mask >> i & 1)
			flags = config->attrs[k].attr.flags;
	return flags;
}

static int value_of(const struct gpio_v2_line_config *config, uint32_t i)
{
	for (uint32_t k = 0; k < config->num_attrs; k++)
		if (config->attrs[k].attr.id ==
		    GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES &&
		    config->attrs[k].mask >> i & 1)
			return (int)(config->attrs[k].attr.values >> i & 1);
	return 0;
}

static int take(struct fake_chip *chip, struct gpio_v2_line_request *ask)
{
	static char owner[GPIO_MAX_NAME_SIZE];
	struct fake_request *request = fake_new(sizeof(*request));
	struct opened what = { .request = request };
	char bias[FAKE_MOST], drive[FAKE_MOST];
	int values[FAKE_MOST];

	memcpy(owner, ask->consumer, sizeof(owner));
	request->count = ask->num_lines;
	for (uint32_t i = 0; i < ask->num_lines; i++) {
		uint64_t flags = flags_of(&ask->config, i);

		request->offset[i] = ask->offsets[i];
		request->output = flags & GPIO_V2_LINE_FLAG_OUTPUT;
		values[i] = value_of(&ask->config, i);
		bias[i] = flags & GPIO_V2_LINE_FLAG_BIAS_PULL_UP ? 'u' :
			  flags & GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN ? 'd' :
			  flags & GPIO_V2_LINE_FLAG_BIAS_DISABLED ? 'n' : '-';
		drive[i] = flags & GPIO_V2_LINE_FLAG_OPEN_DRAIN ? 'o' :
			   flags & GPIO_V2_LINE_FLAG_OPEN_SOURCE ? 's' : '-';
	}
	if (fake_take(request, chip, owner, values, bias, drive)) {
		free(request);
		return -1;
	}
	ask->fd = take_number(what);
	return 0;
}

static int get_values(const struct fake_request *request,
		      struct gpio_v2_line_values *out)
{
	int values[FAKE_MOST];

	if (fake_read(request, values))
		return -1;
	out->bits = 0;
	for (size_t i = 0; i < request->count; i++)
		if (out->mask >> i & 1 && values[i])
			out->bits |= UINT64_C(1) << i;
	return 0;
}

static int set_values(const struct fake_request *request,
		      const struct gpio_v2_line_values *in)
{
	int values[FAKE_MOST];

	for (size_t i = 0; i < request->count; i++)
		values[i] = in->mask >> i & 1 ? (int)(in->bits >> i & 1) :
			    request->chip->line[request->offset[i]].level;
	return fake_write(request, values);
}

int __wrap_ioctl(int fd, unsigned long what, ...)
{
	static const struct opened nothing;
	const struct opened *at = fd >= FAKE_FD ? &opened[fd - FAKE_FD] : &nothing;
	va_list args;
	void *about;

	va_start(args, what);
	about = va_arg(args, void *);
	va_end(args);
	if (what == GPIO_GET_CHIPINFO_IOCTL && at->chip)
		return chip_about(at->chip, about);
	if (what == GPIO_V2_GET_LINEINFO_IOCTL && at->chip)
		return line_about(at->chip, about);
	if (what == GPIO_V2_GET_LINE_IOCTL && at->chip)
		return take(at->chip, about);
	if (what == GPIO_V2_LINE_GET_VALUES_IOCTL && at->request)
		return get_values(at->request, about);
	if (what == GPIO_V2_LINE_SET_VALUES_IOCTL && at->request)
		return set_values(at->request, about);
	if (fd < FAKE_FD)
		return __real_ioctl(fd, what, about); /* as for a terminal */
	errno = ENOTTY;
	return -1;
}
