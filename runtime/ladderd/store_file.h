/* SPDX-License-Identifier: MIT
 *
 * store_file - the file of --retain: two slots, allocated before they are needed.
 *
 * A file whose slots are missing, damaged or too small is replaced as a whole when
 * the first copy is written; until then the old one stays. It knows no values.
 */
#ifndef LADDERD_STORE_FILE_H
#define LADDERD_STORE_FILE_H

#include "engine/base/arena.h"
#include "engine/scan/retain.h"

struct store_file {
	const char *path;
	char *fresh_path;      /* PATH.new                                   */
	int fd, fresh_fd;      /* -1: not open                               */
	uint32_t room;         /* a slot needs so much                       */
	bool fits;             /* the file at @path has two such slots       */
	bool exists;
	int next;              /* slot to write                              */
	uint32_t seq;          /* of the newest copy                         */
	uint32_t slot_size;
};

/**
 * store_file_open - opens and locks @path and reads what it holds
 * @bytes, @len: all of it, free(); NULL if it does not exist or cannot be read
 *
 * Owns: the caller, store_file_close().   Scan-safe: no.
 * Returns 0, or -errno; -EWOULDBLOCK: somebody else has it.
 */
int store_file_open(struct store_file *file, const char *path,
		    struct arena *arena, uint8_t **bytes, size_t *len);
/** store_file_adopt - what retain_find() says of those bytes; @room: bytes that a
 * slot must have. */
void store_file_adopt(struct store_file *file, const struct retain_found *found,
		      uint32_t room);
/** store_file_prepare - room on the disk for both slots, if it is not there yet.
 * Returns 0, or -errno. */
int store_file_prepare(struct store_file *file);
/**
 * store_file_write - seals retain->slot and writes it into the slot whose turn it is
 *
 * When it returns 0 the copy is on the disk; else -errno, and the one before still
 * is.
 */
int store_file_write(struct store_file *file, struct retain *retain);
void store_file_close(struct store_file *file);
#endif
