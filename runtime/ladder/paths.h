/* SPDX-License-Identifier: MIT
 *
 * paths - the scenario files that a command line means: files, programs,
 * folders.
 *
 * It looks into folders, at most eight deep, and opens no file.
 */
#ifndef LADDER_PATHS_H
#define LADDER_PATHS_H

#include <stdbool.h>

struct paths {
	char **path;  /* sorted within each folder                            */
	int count;
};

/** path_with_ending - @path with another ending (or one more, if it has none).
 * Owns: the caller, free(). NULL: no memory. */
char *path_with_ending(const char *path, const char *ending);

/** path_beside - @name as a path from the folder of the file @path; as it is if it begins
 * with /.   Owns: the caller, free(). NULL: no memory. */
char *path_beside(const char *path, const char *name);

/**
 * paths_collect - adds what @path means
 * @ending: of files that are wanted; a folder is searched for them
 * @others: a file of one of these endings stands for the one beside it; NULL behind them
 *
 * Owns: @paths, paths_free().
 * Fails: false after a diagnostic (nothing there, no memory).
 */
bool paths_collect(struct paths *paths, const char *path, const char *ending,
		   const char *const *others);
void paths_free(struct paths *paths);
#endif
