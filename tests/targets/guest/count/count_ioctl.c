/* SPDX-License-Identifier: MIT
 *
 * count_ioctl - linked into `ladderd-count`: counts every ioctl by its purpose and prints
 * the counts at the end.
 *
 * Linked with --wrap=ioctl, which also reaches a static libgpiod, and with
 * --wrap=__ioctl_time64, the name in a libgpiod for 32 bits.
 */
#define _GNU_SOURCE /* syscall */

#include <linux/gpio.h>
#include <stdarg.h>
#include <stdio.h>
#include <sys/syscall.h>
#include <unistd.h>

/* In the C library a request is an int or a long; the number is the same. */
#define NUMBER(request) ((unsigned long)(request) & 0xffffffffUL)

int __wrap_ioctl(int fd, unsigned long request, ...);
int __wrap___ioctl_time64(int fd, unsigned long request, ...);

static unsigned long get, set, other;

static int counted(int fd, unsigned long request, void *argument)
{
	switch (NUMBER(request)) {
	case NUMBER(GPIO_V2_LINE_GET_VALUES_IOCTL):
	case NUMBER(GPIOHANDLE_GET_LINE_VALUES_IOCTL):
		get++;
		break;
	case NUMBER(GPIO_V2_LINE_SET_VALUES_IOCTL):
	case NUMBER(GPIOHANDLE_SET_LINE_VALUES_IOCTL):
		set++;
		break;
	default:
		other++;
	}
	return (int)syscall(SYS_ioctl, fd, NUMBER(request), argument);
}

int __wrap_ioctl(int fd, unsigned long request, ...)
{
	va_list more;
	void *argument;

	va_start(more, request);
	argument = va_arg(more, void *);
	va_end(more);
	return counted(fd, request, argument);
}

int __wrap___ioctl_time64(int fd, unsigned long request, ...)
{
	va_list more;
	void *argument;

	va_start(more, request);
	argument = va_arg(more, void *);
	va_end(more);
	return counted(fd, request, argument);
}

__attribute__((destructor)) static void report(void)
{
	fprintf(stderr, "ioctl get %lu\nioctl set %lu\nioctl other %lu\n", get,
		set, other);
}
