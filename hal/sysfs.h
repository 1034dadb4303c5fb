/* SPDX-License-Identifier: MIT
 *
 * sysfs - small files of the kernel: one value each. Private to the HAL.
 */
#ifndef HAL_SYSFS_H
#define HAL_SYSFS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define SYSFS_TEXT 160 /* bytes of a value, with its NUL */

/** sysfs_read - the text of a file without the newline at its end
 * Scan-safe: no: a read of a slow device waits. Returns 0 or -errno; -EMSGSIZE: it is longer. */
int sysfs_read(const char *path, char *out, size_t size);
/** sysfs_write - 0 or -errno. Scan-safe: no. */
int sysfs_write(const char *path, const char *text);
/** sysfs_number - a decimal number, whatever the locale; anything else after it is an error, but for blanks
 * and newlines. Scan-safe: yes. */
bool sysfs_number(const char *text, double *out);
/** sysfs_read_number - both. */
bool sysfs_read_number(const char *path, double *out);
/** sysfs_print - a number as decimal text; how many bytes. Scan-safe: yes, also in a signal handler. */
size_t sysfs_print(int64_t number, char out[24]);
/** sysfs_path - joins "folder/name" and the end; false: it is too long. */
bool sysfs_path(char *out, size_t size, const char *folder, const char *name, const char *end);
/** sysfs_each - calls @visit for each name in a folder, in the order of their text, until it returns false.
 * Returns 0 or -errno. Scan-safe: no. */
int sysfs_each(const char *folder, bool (*visit)(void *context, const char *name), void *context);
#endif
