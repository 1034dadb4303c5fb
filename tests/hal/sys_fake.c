/* SPDX-License-Identifier: MIT
 *
 * sys_fake - a folder in place of /sys, for ladderd: FAKE_SYS. A number that is written over a longer one ends with a
 * new line, so that the rest of the longer one does not count: the kernel's files have no such rest.
 */
#include "hal/iomap.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

ssize_t __real_pwrite(int fd, const void *text, size_t len, off_t at);
ssize_t __wrap_pwrite(int fd, const void *text, size_t len, off_t at);
ssize_t __wrap_pwrite64(int fd, const void *text, size_t len, off_t at) __attribute__((alias("__wrap_pwrite")));

ssize_t __wrap_pwrite(int fd, const void *text, size_t len, off_t at)
{
	char line[25];

	if (at || len >= sizeof(line))
		return __real_pwrite(fd, text, len, at);
	memcpy(line, text, len);
	line[len] = '\n';
	return __real_pwrite(fd, line, len + 1, at) == (ssize_t)len + 1 ? (ssize_t)len : -1;
}
