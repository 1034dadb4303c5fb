/* SPDX-License-Identifier: MIT
 *
 * iio_sys - shows FAKE_SYS to the real libiio in place of /sys. The library's calls of libc come here, because
 * the program that loads it exports functions with these names.
 */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The test asks for it; only the fake counts. */
extern int fake_iio_contexts;
int fake_iio_contexts;
/* By the test: the library is not installed. */
extern bool fake_iio_missing;
bool fake_iio_missing;

static const char *elsewhere(const char *path, char room[400])
{
	const char *sys = getenv("FAKE_SYS");

	if (!sys || strncmp(path, "/sys/", 5) != 0)
		return path;
	snprintf(room, 400, "%s/%s", sys, path + 5);
	return room;
}

/* dlsym() gives an object pointer; ISO C has no cast from it to a function. */
static void find_real(const char *name, void *out)
{
	void *found = dlsym(RTLD_NEXT, name);

	memcpy(out, &found, sizeof(found));
}

/* Both names of each, whichever the library was built with. */
#define IN_PLACE_OF(name, type, ...) type in_place_of_##name(__VA_ARGS__) __asm__(#name); \
	type in_place_of_##name(__VA_ARGS__)

IN_PLACE_OF(dlopen, void *, const char *name, int flags)
{
	void *(*real)(const char *, int);

	find_real("dlopen", &real);
	return fake_iio_missing ? NULL : real(name, flags);
}

#define OPENDIR(name) \
IN_PLACE_OF(name, void *, const char *path) \
{ \
	void *(*real)(const char *); \
	char room[400]; \
	find_real(#name, &real); \
	return real(elsewhere(path, room)); \
}
OPENDIR(opendir)

#define FOPEN(name) \
IN_PLACE_OF(name, void *, const char *path, const char *mode) \
{ \
	void *(*real)(const char *, const char *); \
	char room[400]; \
	find_real(#name, &real); \
	return real(elsewhere(path, room), mode); \
}
FOPEN(fopen)
FOPEN(fopen64)

#define OPEN(name) \
IN_PLACE_OF(name, int, const char *path, int flags, ...) \
{ \
	int (*real)(const char *, int, ...); \
	char room[400]; \
	va_list more; \
	int mode; \
	va_start(more, flags); \
	mode = flags & 0100 ? va_arg(more, int) : 0; \
	va_end(more); \
	find_real(#name, &real); \
	return real(elsewhere(path, room), flags, mode); \
}
OPEN(open)
OPEN(open64)

#define STAT(name) \
IN_PLACE_OF(name, int, const char *path, void *out) \
{ \
	int (*real)(const char *, void *); \
	char room[400]; \
	find_real(#name, &real); \
	return real(elsewhere(path, room), out); \
}
STAT(stat)
STAT(stat64)
