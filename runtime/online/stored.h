/* SPDX-License-Identifier: MIT
 *
 * stored - what a download sends, a board stores and an upload gives back: image, I/O map and
 * sources as one run of bytes.
 *
 * A slot is such a run with a head and a checksum. It opens no file.
 */
#ifndef ONLINE_STORED_H
#define ONLINE_STORED_H

#include "online/wire.h"

#define STORED_MOST  (16u << 20) /* bytes of image, map and sources together    */
#define STORED_BLOCK 60000u      /* bytes of one block                          */
#define SLOT_HEAD    72u         /* bytes before them in a slot; 4 more behind  */

enum stored_part { STORED_IMAGE, STORED_MAP, STORED_SOURCES, STORED_PARTS };

struct stored {
	uint32_t len[STORED_PARTS];
	const uint8_t *bytes;  /* all parts, one after another; borrowed      */
};

/** stored_size - bytes of all parts; 0: too many. Scan-safe: yes; so are all functions. */
uint32_t stored_size(const struct stored *stored);
/** stored_part - the bytes of one part. */
const uint8_t *stored_part(const struct stored *stored, enum stored_part part);

/* One of the files of STORED_SOURCES, the program first; all are borrowed. */
struct stored_source {
	const char *name;
	size_t name_len;
	const uint8_t *bytes;
	uint32_t len;
};

/** stored_sources - how many there are. @in: gets what stored_take_source() reads. */
uint16_t stored_sources(const struct stored *stored, struct wire_reader *in);
/** stored_take_source - the next one. Fails: false: the bytes are damaged. */
bool stored_take_source(struct wire_reader *in, struct stored_source *out);

/**
 * slot_seal - writes head and checksum around the bytes of @stored
 * @out: SLOT_HEAD + stored_size() + 4 bytes; gets the parts, too
 * @seq: of this slot; the higher one is newer
 * @beside: SHA-256 of the program and map that the command line named at that time
 */
void slot_seal(const struct stored *stored, uint32_t seq, const uint8_t beside[32],
	       uint8_t *out);

struct slot {
	uint32_t seq;
	uint8_t beside[32];
	struct stored stored;  /* in the bytes of the slot                    */
};
/** slot_open - Fails: false: damaged, cut, or of another format. */
bool slot_open(const uint8_t *bytes, size_t len, struct slot *out);
#endif
