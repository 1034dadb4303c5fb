/* SPDX-License-Identifier: MIT
 *
 * retain - what outlives a power cut: values by name and type, as bytes and back.
 *
 * A plan knows the retained variables of one program. A copy of their values is
 * taken between scans; a payload is a copy with names and types, so that it fits
 * an edited program too; a slot is a payload with a number and a checksum, and a
 * file is two slots that are written in turn. It opens no file, starts no thread
 * and believes no byte that it is given.
 *
 * Slot, at a multiple of RETAIN_PAGE: struct retain_slot, payload, CRC-32C of both.
 * Payload: clock (8 bytes), number of records (4), then for each record
 *   name length (2), type length (1), 0, value length (4), name, type, value
 * What an instance keeps to itself comes back, too, and is as little to be believed:
 * no step function of a block may read or write past its own on account of it.
 * All numbers little-endian. A name has its POU before it ("Main.Count"), and that
 * of an instance its pin behind ("Main.Delay.ET"; the type then "TON.TIME"). What an
 * instance stores is one record ("Main.Parcels.value"; "FIFO.DINT[64]").
 */
#ifndef SCAN_RETAIN_H
#define SCAN_RETAIN_H

#include "engine/base/arena.h"
#include "engine/scan/resource.h"

#define RETAIN_PAGE   4096u
#define RETAIN_MAGIC  "RUNGKEEP"
#define RETAIN_FORMAT 1u
#define RETAIN_HEAD   12u /* bytes of a payload before its records        */
#define RETAIN_RECORD 8u  /* bytes of a record before its name            */

struct retain_slot {
	char magic[8];
	uint32_t format;
	uint32_t seq;       /* of this copy; one more than that of the other */
	uint32_t len;       /* of the payload                                */
	uint32_t flags;     /* enum retain_flag                              */
	uint32_t slot_size; /* where the second slot begins                  */
	uint32_t spare;
};
enum retain_flag { RETAIN_FIRST = 1 /* the other slot is still empty */ };

struct retain_var {
	struct location at;
	uint32_t elements; /* one after another: what a FIFO holds; 1: a value */
	uint32_t size;   /* of all of them                                    */
	uint32_t kept;   /* its place in a copy                               */
	uint32_t record; /* its record's place in the payload                 */
	uint32_t value;  /* its value's place there                           */
};

struct retain {
	const struct program *program;
	struct retain_var *var;
	int count;
	uint32_t *loose;       /* those outside the block of retained data    */
	int loose_count;
	uint32_t *hashed;      /* 1 + index of a variable, by its name; or 0  */
	uint32_t hash_mask;
	bool *taken;           /* got a value by retain_take()                */
	uint8_t *slot;         /* struct retain_slot, payload, CRC            */
	uint32_t payload_size;
	uint32_t copy_size;    /* bytes of a copy                             */
	uint32_t bytes;        /* of the values alone                         */
};

/**
 * retain_plan - finds the retained variables of a program
 * @arena: all of it lives there
 *
 * A constant, an input and a system bit are never among them.
 * Owns: @arena.   Scan-safe: no.
 * Fails: false when memory is out, or they are more than LIMIT_RETAIN; then
 * payload_size is above it.
 */
bool retain_plan(struct retain *retain, const struct image *image,
		 struct arena *arena);

/** retain_copy - values of @image as they are between two scans; @copy has
 * copy_size bytes. Scan-safe: yes, as long as it takes to copy them. */
void retain_copy(const struct retain *retain, const struct image *image,
		 uint8_t *copy);
/** retain_put - the values of a copy into @image, the other way.
 * Scan-safe: between scans. */
void retain_put(const struct retain *retain, struct image *image,
		const uint8_t *copy);

/**
 * retain_start - resource_start(), but a warm one: what is retained stays
 *
 * For simulation; a runtime has its values from a file. What it allocates is free
 * again.
 * Scan-safe: no.   Fails: false when memory is out; nothing has changed.
 */
bool retain_start(struct resource *resource);

/** retain_fill - a copy and the scan's clock into the payload in retain->slot.
 * Scan-safe: no. */
void retain_fill(struct retain *retain, const uint8_t *copy, int64_t clock_ns);
/** retain_seal - head and checksum of retain->slot; gives the bytes to write.
 * Scan-safe: no. */
uint32_t retain_seal(struct retain *retain, uint32_t seq, uint32_t flags,
		     uint32_t slot_size);
/** retain_room - bytes of a slot for this payload: whole pages.
 * Scan-safe: yes. */
uint32_t retain_room(uint32_t payload_size);

/* What a file holds. */
enum retain_state { RETAIN_EMPTY, RETAIN_BAD, RETAIN_GOOD };
struct retain_found {
	enum retain_state state[2];
	int best;            /* slot with the newest good copy; -1: none      */
	bool old_copy;       /* the other one cannot be read: it may have been
				newer                                         */
	bool fits;           /* the file has its two slots, whole             */
	uint32_t seq, slot_size;
	const uint8_t *payload; /* in the file's bytes                        */
	uint32_t len;
};
/**
 * retain_find - the newest copy whose every byte is as it was written
 * @file: any bytes; aligned to 8
 *
 * A payload it gives is well-formed: records can be read without a check.
 * Owns: nothing.   Scan-safe: no.   Fails: never; found->best may be -1.
 */
void retain_find(const uint8_t *file, size_t len, struct retain_found *found);

/* One value of a payload. */
struct retain_record {
	const char *name, *type; /* not ended by NUL                         */
	const uint8_t *value;
	uint32_t name_len, type_len, size;
};
/** retain_next - the record at @at, which begins with RETAIN_HEAD and is moved
 * on. Fails: false behind the last one, or where it does not fit. Scan-safe: no. */
bool retain_next(const uint8_t *payload, uint32_t len, uint32_t *at,
		 struct retain_record *out);
/** retain_clock - the scan's clock when the payload was filled, in ns; never
 * negative, and never so late that a clock could not go on. Scan-safe: yes. */
int64_t retain_clock(const uint8_t *payload);

enum retain_fate {
	RETAIN_KEPT,
	RETAIN_NO_NAME, /* no retained variable has this name                */
	RETAIN_NO_TYPE, /* one has, of another type                          */
};
/** retain_take - the value of a record into @copy, if name and type fit, and a text
 * has room. @copy is one that retain_copy() made. Scan-safe: no. */
enum retain_fate retain_take(struct retain *retain,
			     const struct retain_record *record, uint8_t *copy);
/** retain_record_of - the record of a variable: its name and its type.
 * Lives with the plan. Scan-safe: no. */
struct retain_record retain_record_of(const struct retain *retain, int index);
#endif
