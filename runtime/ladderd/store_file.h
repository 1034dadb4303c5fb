/* SPDX-License-Identifier: MIT
 *
 * store_file - the file of --retain: two slots, allocated in advance.
 *
 * A file whose slots are missing, damaged or too small is replaced when the first copy is
 * written; until then the old file stays.
 */
#ifndef LADDERD_STORE_FILE_H
#define LADDERD_STORE_FILE_H

#include "engine/base/arena.h"
#include "engine/scan/retain.h"

struct store_file {
	const char *path;
	char *fresh_path;      /* PATH.new                                   */
	int fd, fresh_fd;      /* -1: not open                               */
	uint32_t room;         /* bytes that a slot needs                    */
	bool fits;             /* the file at @path has two such slots       */
	bool exists;
	bool unread;           /* nobody knows what is in it: it is put aside, as PATH.old */
	bool nameless;         /* its name may not be on the disk yet        */
	int next;              /* slot to write                              */
	uint32_t seq;          /* of the newest copy                         */
	uint32_t slot_size;
};

/**
 * store_file_open - opens, locks and reads @path
 * @bytes, @len: its content, free(); NULL if it does not exist or cannot be read
 *
 * Owns: the caller, store_file_close().   Scan-safe: no.
 * Returns 0, or -errno; -EWOULDBLOCK: another process has locked it.
 */
int store_file_open(struct store_file *file, const char *path,
		    struct arena *arena, uint8_t **bytes, size_t *len);
/** store_file_adopt - sets the slots from the result of retain_find(); @room: bytes that a
 * slot needs. */
void store_file_adopt(struct store_file *file, const struct retain_found *found,
		      uint32_t room);
/** store_file_prepare - allocates both slots on the disk, if necessary.
 * Returns 0, or -errno. */
int store_file_prepare(struct store_file *file);
/**
 * store_file_write - seals retain->slot and writes it to the older slot
 *
 * Returns 0 when the copy is on the disk, or -errno; the previous copy is then unchanged.
 */
int store_file_write(struct store_file *file, struct retain *retain);
void store_file_close(struct store_file *file);
#endif
