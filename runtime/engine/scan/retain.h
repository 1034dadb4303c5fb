/* SPDX-License-Identifier: MIT
 *
 * retain - retained values by name and type, as bytes and back.
 *
 * A plan knows the retained variables of one program. A copy of their values is taken
 * between scans; a payload is a copy with names and types, so that it fits an edited
 * program too; a slot is a payload with a number and a checksum, and a file is two
 * slots that are written in turn. It opens no file and starts no thread. All bytes from
 * outside are checked.
 *
 * Slot, at a multiple of RETAIN_PAGE: struct retain_slot, payload, CRC-32C of both.
 * Payload: clock (8 bytes), number of records (4), then for each record
 *   name length (2), type length (1), 0, value length (4), name, type, value
 * The inner state of an instance is retained, too, and may be damaged: no value in it
 * may make the step function of a block access memory outside the instance. All numbers
 * are little-endian. A name has its POU before it ("Main.Count"), and that of an
 * instance its pin behind ("Main.Delay.ET"; the type then "TON.TIME"). An array inside
 * an instance is one record ("Main.Parcels.value"; "FIFO.DINT[64]").
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
	uint32_t seq;       /* of this copy; the other slot has one less */
	uint32_t len;       /* of the payload                                */
	uint32_t flags;     /* enum retain_flag                              */
	uint32_t slot_size; /* where the second slot begins                  */
	uint32_t spare;
};
enum retain_flag { RETAIN_FIRST = 1 /* the other slot is still empty */ };

struct retain_var {
	struct location at;
	uint32_t elements; /* elements of an array that an instance stores; 1: a value */
	uint32_t size;   /* bytes of all of them                              */
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
	bool *taken;           /* has a value from retain_take()              */
	uint32_t met;          /* 1 + the variable that its name named; 0: none */
	uint8_t *slot;         /* struct retain_slot, payload, CRC            */
	uint32_t payload_size;
	uint32_t copy_size;    /* bytes of a copy                             */
	uint32_t bytes;        /* of the values alone                         */
};

/**
 * retain_plan - finds the retained variables of a program
 * @arena: memory of the plan
 *
 * Constants, inputs and system bits are never retained.
 * Owns: @arena. Scan-safe: no.
 * Fails: false when memory is out, or the payload is larger than LIMIT_RETAIN; then
 * payload_size says how large.
 */
bool retain_plan(struct retain *retain, const struct image *image,
		 struct arena *arena);

/** retain_copy - values of @image as they are between two scans; @copy has copy_size
 * bytes. Scan-safe: yes; a copy of copy_size bytes. */
void retain_copy(const struct retain *retain, const struct image *image,
		 uint8_t *copy);
/** retain_put - writes the values of a copy into @image.
 * Scan-safe: between scans. */
void retain_put(const struct retain *retain, struct image *image,
		const uint8_t *copy);

/**
 * retain_start - a warm resource_start(): retained values stay
 *
 * For simulation; a runtime reads its values from a file.
 * Scan-safe: no. Fails: false when memory is out; nothing has changed.
 */
bool retain_start(struct resource *resource);

/** retain_fill - writes a copy and the scan's clock to the payload in retain->slot.
 * Scan-safe: no. */
void retain_fill(struct retain *retain, const uint8_t *copy, int64_t clock_ns);
/** retain_seal - sets head and checksum of retain->slot; returns the bytes to write.
 * Scan-safe: no. */
uint32_t retain_seal(struct retain *retain, uint32_t seq, uint32_t flags,
		     uint32_t slot_size);
/** retain_room - bytes of a slot for this payload: whole pages.
 * Scan-safe: yes. */
uint32_t retain_room(uint32_t payload_size);

/* The contents of a file. */
enum retain_state { RETAIN_EMPTY, RETAIN_BAD, RETAIN_GOOD };
struct retain_found {
	enum retain_state state[2];
	int best;            /* slot with the newest good copy; -1: none      */
	bool old_copy;       /* the other slot cannot be read: it may have been newer */
	bool fits;           /* the file has two complete slots               */
	uint32_t seq, slot_size;
	const uint8_t *payload; /* in the file's bytes                        */
	uint32_t len;
};
/**
 * retain_find - the newest undamaged copy
 * @file: any bytes; aligned to 8
 *
 * The payload is well-formed: its records can be read without further checks.
 * Owns: nothing. Scan-safe: no. Fails: never; found->best may be -1.
 */
void retain_find(const uint8_t *file, size_t len, struct retain_found *found);

/** retain_is_well_formed - whether a payload can be read by retain_next() as it is. Scan-safe: no. */
bool retain_is_well_formed(const uint8_t *payload, uint32_t len);

/* One value of a payload. */
struct retain_record {
	const char *name, *type; /* not ended by NUL                         */
	const uint8_t *value;
	uint32_t name_len, type_len, size;
};
/** retain_next - the record at @at, which starts as RETAIN_HEAD and is advanced. Fails:
 * false after the last record, or if it is incomplete. Scan-safe: no. */
bool retain_next(const uint8_t *payload, uint32_t len, uint32_t *at,
		 struct retain_record *out);
/** retain_clock - the scan's clock when the payload was filled, in ns; never negative,
 * and early enough that the clock cannot overflow. Scan-safe: yes. */
int64_t retain_clock(const uint8_t *payload);

enum retain_fate {
	RETAIN_KEPT,
	RETAIN_NO_NAME, /* no retained variable has this name                */
	RETAIN_NO_TYPE, /* a variable of another type has it                 */
};
/** retain_take - writes the value of a record to @copy if name and type match and a text
 * fits. @copy comes from retain_copy(). Scan-safe: no. */
enum retain_fate retain_take(struct retain *retain,
			     const struct retain_record *record, uint8_t *copy);
/** retain_record_of - the record of a variable: its name and its type.
 * Lives with the plan. Scan-safe: no. */
struct retain_record retain_record_of(const struct retain *retain, int index);
#endif
