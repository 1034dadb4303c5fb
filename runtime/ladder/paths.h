/* SPDX-License-Identifier: MIT
 *
 * paths - file names with other endings or in other folders, and the files that the
 * arguments of `ladder test` and the folders of other commands name. Folders are searched at most
 * eight deep; no file is opened.
 */
#ifndef LADDER_PATHS_H
#define LADDER_PATHS_H

#include <stdbool.h>

struct paths {
	char **path;  /* sorted within each folder                            */
	int count;
};

/** path_with_ending - @path with its ending replaced, or with @ending added if it has none.
 * Owns: the caller, free(). NULL: no memory. */
char *path_with_ending(const char *path, const char *ending);

/** path_beside - the path of @name in the folder of the file @path; @name itself if it
 * begins with /.   Owns: the caller, free(). NULL: no memory. */
char *path_beside(const char *path, const char *name);

/** path_is_plain - has @path the ending of plain IEC text, or of what TwinCAT and CODESYS export? */
bool path_is_plain(const char *path);
/** path_is_folder - is it one? */
bool path_is_folder(const char *path);

/**
 * paths_project - adds the files of a project of plain IEC text
 * @path: one or more files and folders, each on a line of its own; folders are searched
 *
 * Owns: @paths, paths_free(). Fails: false after a diagnostic (no memory).
 */
bool paths_project(struct paths *paths, const char *path);

/**
 * paths_collect - adds the files that @path names
 * @ending: of the wanted files; a folder is searched for them
 * @others: a file with one of these endings means the wanted file beside it; ends with NULL
 *
 * Owns: @paths, paths_free().
 * Fails: false after a diagnostic (no such file, no memory).
 */
bool paths_collect(struct paths *paths, const char *path, const char *ending,
		   const char *const *others);
void paths_free(struct paths *paths);
#endif
