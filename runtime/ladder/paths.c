/* SPDX-License-Identifier: MIT
 *
 * paths - finds files by their ending. It follows links, so the depth is limited.
 */
#include "ladder/paths.h"
#include "ladder/report.h"

#include "engine/base/ascii.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define DEPTH_MAX 8

static bool complain(const char *path, enum diag_id id, const char *why)
{
	report_diag((struct diag){ .id = id, .file = path }, "%s", why);
	return false;
}

static bool has_ending(const char *path, const char *ending)
{
	size_t len = strlen(path), tail = strlen(ending);

	return len > tail && !strcmp(path + len - tail, ending);
}

/* @len bytes of @path, then @slash and @name. NULL: no memory. */
static char *join(const char *path, size_t len, const char *slash, const char *name)
{
	size_t size = len + strlen(slash) + strlen(name) + 1;
	char *out = malloc(size);

	if (out)
		snprintf(out, size, "%.*s%s%s", (int)len, path, slash, name);
	return out;
}

char *path_with_ending(const char *path, const char *ending)
{
	const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');

	return join(path, dot && (!slash || dot > slash + 1) && dot > path ?
		    (size_t)(dot - path) : strlen(path), "", ending);
}

char *path_beside(const char *path, const char *name)
{
	const char *slash = *name == '/' ? NULL : strrchr(path, '/');

	return join(path, slash ? (size_t)(slash + 1 - path) : 0, "", name);
}

/* Takes over @copy. */
static bool add(struct paths *paths, char *copy)
{
	char **grown = NULL;

	if (copy)
		grown = realloc(paths->path, sizeof(*grown) *
				(size_t)(paths->count + 1));
	if (!grown) {
		free(copy);
		return complain("ladder", DIAG_NO_MEMORY, "");
	}
	paths->path = grown;
	paths->path[paths->count++] = copy;
	return true;
}

static int order(const void *a, const void *b)
{
	return strcmp(*(char *const *)a, *(char *const *)b);
}

bool path_is_plain(const char *path)
{
	static const char *const ending[] = { ".st", ".iec", ".il", ".txt", ".exp", ".TcPOU",
					      ".TcDUT", ".TcGVL" };
	const size_t len = strlen(path);

	for (size_t i = 0; i < sizeof(ending) / sizeof(*ending); i++) {
		const size_t tail = strlen(ending[i]);

		if (len > tail && ascii_same(path + len - tail, ending[i], tail))
			return true;
	}
	return false;
}

bool path_is_folder(const char *path)
{
	struct stat status;

	return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* Does a search for @ending take this file? NULL: plain IEC text; what a .txt is shows its content. */
static bool is_wanted(const char *name, const char *ending)
{
	return ending ? has_ending(name, ending) : path_is_plain(name);
}

static bool search(struct paths *paths, const char *folder, const char *ending,
		   int depth);

static bool search_name(struct paths *paths, const char *folder,
			const char *name, const char *ending, int depth)
{
	size_t len = strlen(folder);
	char *path = join(folder, len, len && folder[len - 1] == '/' ? "" : "/", name);
	bool good = true;

	if (!path)
		return complain(folder, DIAG_NO_MEMORY, "");
	if (path_is_folder(path)) {
		good = depth >= DEPTH_MAX ||
		       search(paths, path, ending, depth + 1);
	} else if (is_wanted(name, ending)) {
		return add(paths, path);
	}
	free(path);
	return good;
}

static bool search(struct paths *paths, const char *folder, const char *ending,
		   int depth)
{
	DIR *dir = opendir(folder);
	const struct dirent *entry;
	int first = paths->count;
	bool good = true;

	if (!dir)
		return complain(folder, DIAG_CANNOT_READ, strerror(errno));
	while (good && (entry = readdir(dir)))
		if (entry->d_name[0] != '.')
			good = search_name(paths, folder, entry->d_name, ending,
					   depth);
	closedir(dir);
	if (paths->count > first)
		qsort(paths->path + first, (size_t)(paths->count - first),
		      sizeof(*paths->path), order);
	return good;
}

bool paths_project(struct paths *paths, const char *path)
{
	bool good = true;

	while (good && *path) {
		const size_t len = strcspn(path, "\n");
		char *one = join(path, len, "", "");

		if (!one || !path_is_folder(one)) {
			good = add(paths, one);
		} else {
			good = search(paths, one, NULL, 1);
			free(one);
		}
		path += len + (path[len] == '\n');
	}
	return good;
}

bool paths_collect(struct paths *paths, const char *path, const char *ending,
		   const char *const *others)
{
	struct stat status;

	if (stat(path, &status) != 0)
		return complain(path, DIAG_CANNOT_READ, strerror(errno));
	if (S_ISDIR(status.st_mode))
		return search(paths, path, ending, 1);
	while (*others && !has_ending(path, *others))
		others++;
	if (*others) {
		char *beside = path_with_ending(path, ending);
		bool there = beside && stat(beside, &status) == 0;

		if (!there)
			complain(beside ? beside : path, DIAG_CANNOT_READ,
				 strerror(errno));
		else
			return add(paths, beside);
		free(beside);
		return false;
	}
	if (!has_ending(path, ending))
		return complain(path, DIAG_WRONG_KIND, "");
	return add(paths, join(path, strlen(path), "", ""));
}

void paths_free(struct paths *paths)
{
	for (int i = 0; i < paths->count; i++)
		free(paths->path[i]);
	free(paths->path);
	paths->path = NULL;
	paths->count = 0;
}
