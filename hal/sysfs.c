/* SPDX-License-Identifier: MIT
 *
 * sysfs - small files of the kernel: one value each.
 */
#define _GNU_SOURCE /* scandir */
#include "hal/sysfs.h"

#include "hal/device.h"
#include "hal/group.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int sysfs_read(const char *path, char *out, size_t size)
{
	const int file = open(path, O_RDONLY | O_CLOEXEC);
	size_t used = 0;
	ssize_t got = 1;
	int error = 0;

	out[0] = '\0';
	if (file < 0)
		return -errno;
	while (got > 0 && used < size) {
		got = read(file, out + used, size - used);
		if (got < 0)
			error = -errno;
		else
			used += (size_t)got;
	}
	close(file);
	if (!error && used == size)
		error = -EMSGSIZE;
	while (used > 0 && (used == size || out[used - 1] == '\n'))
		used--;
	out[used] = '\0';
	return error;
}

int sysfs_write(const char *path, const char *text)
{
	const int file = open(path, O_WRONLY | O_CLOEXEC);
	const size_t len = strlen(text);
	int error = 0;

	if (file < 0)
		return -errno;
	if (write(file, text, len) != (ssize_t)len)
		error = errno ? -errno : -EIO;
	close(file);
	return error;
}

/* At most 18 digits count; a value of the kernel has fewer. */
bool sysfs_number(const char *text, double *out)
{
	static const double ten[] = { 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12,
				      1e13, 1e14, 1e15, 1e16, 1e17, 1e18 };
	const bool minus = *text == '-';
	const char *at = text + (minus || *text == '+');
	bool point = false;
	int digits = 0, behind = 0;
	int64_t sum = 0;

	for (; (*at >= '0' && *at <= '9') || (*at == '.' && !point); at++) {
		if (*at == '.') {
			point = true;
			continue;
		}
		if (digits == 18 && !point)
			return false;
		if (digits == 18)
			continue;
		sum = sum * 10 + (*at - '0');
		digits++;
		behind += point;
	}
	while (*at == ' ' || *at == '\n' || *at == '\t')
		at++;
	if (!digits || *at)
		return false;
	*out = (double)(minus ? -sum : sum) / ten[behind];
	return true;
}

bool sysfs_read_number(const char *path, double *out)
{
	char text[SYSFS_TEXT];

	return sysfs_read(path, text, sizeof(text)) == 0 && sysfs_number(text, out);
}

size_t sysfs_print(int64_t number, char out[24])
{
	uint64_t rest = number < 0 ? 0 - (uint64_t)number : (uint64_t)number;
	char back[24];
	size_t count = 0, len = 0;

	do {
		back[count++] = (char)('0' + rest % 10);
		rest /= 10;
	} while (rest);
	if (number < 0)
		out[len++] = '-';
	while (count)
		out[len++] = back[--count];
	out[len] = '\0';
	return len;
}

bool sysfs_path(char *out, size_t size, const char *folder, const char *name, const char *end)
{
	const int len = snprintf(out, size, "%s%s%s%s", folder, *name ? "/" : "", name, end);

	return len >= 0 && (size_t)len < size;
}

static int no_dots(const struct dirent *entry)
{
	return entry->d_name[0] != '.';
}

int sysfs_each(const char *folder, bool (*visit)(void *context, const char *name), void *context)
{
	struct dirent **entry;
	const int count = scandir(folder, &entry, no_dots, versionsort);
	bool more = true;

	if (count < 0)
		return -errno;
	for (int i = 0; i < count; i++) {
		more = more && visit(context, entry[i]->d_name);
		free(entry[i]);
	}
	free(entry);
	return 0;
}

bool device_denied(struct trouble *why, const char *name, const char *path)
{
	struct stat about;
	char group[40] = "";
	const char *end = path + strlen(path);

	/* A message has no room for more than file and folder. */
	for (int slashes = 0; end > path; end--) {
		slashes += end[-1] == '/';
		if (slashes == 2)
			break;
	}
	if (stat(path, &about) == 0)
		group_print(about.st_gid, group, sizeof(group));
	return trouble_set(why, DIAG_IO_DEVICE_DENIED, "%.20s" DIAG_AND "%.28s" DIAG_AND "%s", name, end,
			   group);
}

void device_known(char *out, size_t size, const char *name)
{
	const size_t used = strlen(out);

	if (used + strlen(name) + 8 < size)
		snprintf(out + used, size - used, "%s%s", used ? ", " : "", name);
	else if (used + 6 < size && (used < 3 || strcmp(out + used - 3, "...") != 0))
		snprintf(out + used, size - used, ", ...");
}
