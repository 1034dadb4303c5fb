/* SPDX-License-Identifier: MIT
 *
 * disk - writes in full, and syncs names: what every file of a board needs.
 */
#ifndef LADDERD_DISK_H
#define LADDERD_DISK_H

#include <stdint.h>
#include <stddef.h>
#include <sys/types.h>

/** disk_write - @len bytes at offset @at, in as many pieces as the kernel takes; a signal does
 * not end it. Owns: nothing. Scan-safe: no. Fails: -errno. */
int disk_write(int fd, const void *bytes, size_t len, off_t at);
/** disk_sync_folder - the names in @folder survive a power cut. It is tried twice: an error that
 * was of the moment is no loss, a journal that cannot be written fails again. Owns: nothing.
 * Scan-safe: no. Fails: -errno. */
int disk_sync_folder(const char *folder);
/** disk_hint - what a person can do about an error (errno, also negative) of a file that the board stores. Static. */
const char *disk_hint(int error);
#endif
