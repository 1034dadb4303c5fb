/* SPDX-License-Identifier: MIT
 *
 * recorder - keeps the last scans of a resource as bytes in a ring, so that each of them can
 * be computed again.
 *
 * A scan is a function of the state before it, its inputs and its times. So the ring holds
 * inputs and times of each scan, acts between scans, and a keyframe now and then: the state
 * itself. docs/record.md has the bytes; trial/record_file.h reads them. The ring consists of
 * segments that begin with a keyframe; the oldest segment is dropped first. It allocates
 * nothing and knows no names.
 */
#ifndef SCAN_RECORDER_H
#define SCAN_RECORDER_H

#include "engine/scan/resource.h"

#define RECORDER_INPUTS 6u /* areas of inputs, at most, SYS_ZONE, SYS_DISK_FAULT */
/* Memory beside the ring. The last two together are smaller than an area. */
#define RECORDER_BESIDE ((RECORDER_INPUTS - 1) * LIMIT_AREA)

/* The kinds of records: the low 3 bits of the first byte. */
enum record_kind {
	RECORD_SCAN, RECORD_KEY, RECORD_INPUTS, RECORD_WRITE, RECORD_FORCE, RECORD_UNFORCE,
	RECORD_STATE,
};
#define RECORD_KIND 0x07u
/* The other bits of RECORD_SCAN. */
enum { RECORD_LATE = 8, RECORD_IO = 16, RECORD_WATCH = 32, RECORD_DUE = 64, RECORD_PERIOD = 128 };
/* Of RECORD_KEY and RECORD_STATE: a number from this bit on. */
#define RECORD_SUB 3
/* Why there is a keyframe. NEXT: the scans before it lead to the same state. */
enum record_why { RECORD_NEXT, RECORD_START, RECORD_SWAP, RECORD_WHY_COUNT };
enum record_state { RECORD_STOPPED, RECORD_FAILED, RECORD_TASKS, RECORD_INTERRUPTED,
		    RECORD_QUALITY, RECORD_STATE_COUNT };
/* Flags of a keyframe. */
enum {
	KEY_HALTED = 1, KEY_LATE = 2, KEY_IO = 4, KEY_WARM = 8, KEY_LOST = 16, KEY_OLD_COPY = 32,
	KEY_STOP = 64,
};
/* Flags of a task in it. */
enum { KEY_BEGAN = 1, KEY_DUE = 2, KEY_RAN = 4, KEY_WAS = 8 };
#define KEY_HEAD  145u /* bytes of a keyframe before its tasks                 */
#define KEY_TASK  37u
#define KEY_FORCE 20u

struct recorder;
/* Which values of the I/O map are not good, as their owner knows it. */
struct recorder_quality {
	/* Another number whenever a value became good or bad; 0: all are good. */
	uint64_t (*serial)(void *context);
	/* Calls recorder_bad() for each value that is not good. */
	void (*each)(void *context, struct recorder *recorder);
	void *context;
};

struct recorder {
	uint8_t *ring, *seen;         /* `seen`: inputs as they are in the record  */
	uint32_t size, at;            /* of the ring; index of the next byte       */
	uint64_t head, oldest, key;   /* bytes since the start: the next one, the oldest
				       * one in the ring, the last keyframe        */
	bool on;                      /* there is room for this program            */
	bool full;                    /* a scan had too many interruptions: on again after it */
	uint32_t key_bytes;           /* of a keyframe without forces              */
	uint32_t input_count;
	struct { uint32_t at, size; } input[RECORDER_INPUTS];
	uint8_t identity[32];
	uint64_t scan;                /* of the last one, counted for ever         */
	int64_t now_ns, step_ns, wall_ns, period_ns;
	struct recorder_quality quality; /* `each` is NULL: all are good always */
	uint64_t quality_serial;      /* of the list that is in the record         */
	uint64_t quality_end;         /* where a list must end                     */
	uint64_t key_end;             /* of the last keyframe, if no list is behind it; else 0 */
	uint32_t bad_at, bad_count;   /* the run that goes on; 0: none             */
	uint32_t rest_at, rest_end;   /* the runs that a list has no room for      */
	bool bad_fault, rest_fault;
};

/** recorder_core - bytes of memory that a keyframe holds: without the power of cells.
 * Scan-safe: yes. */
uint32_t recorder_core(const struct program *program);
/** recorder_input - the bytes of input area number @i in memory, as a record has them. Fails:
 * false: there are no more. Scan-safe: yes. */
bool recorder_input(const struct program *program, uint32_t i, uint32_t *at, uint32_t *size);

/** recorder_init - an empty ring. @memory: @size + RECORDER_BESIDE bytes, borrowed. Scan-safe:
 * yes. */
void recorder_init(struct recorder *recorder, uint8_t *memory, uint32_t size);

/** recorder_tell_quality - from now on the record has the quality of values, too. Scan-safe: yes. */
void recorder_tell_quality(struct recorder *recorder, const struct recorder_quality *quality);
/** recorder_bad - called by `each`: @count bits of the process image from @bit on are a value, or some,
 * that is stale, or in fault. Scan-safe: yes. */
void recorder_bad(struct recorder *recorder, uint32_t bit, uint32_t count, bool fault);

/* All of these between two scans, by the thread that scans. */

/** recorder_begin - records the state of a program that has just started, or replaced another
 * @identity: SHA-256 of the program
 *
 * If the program is too large for the ring, nothing is recorded until the next call.
 * Scan-safe: yes; a copy of its data. */
void recorder_begin(struct recorder *recorder, const struct resource *resource,
		    const uint8_t identity[32], enum record_why why);
/** recorder_scan - just before a scan: its inputs are read, `late` and the like are set.
 * recorder_scanned() follows. Scan-safe: yes; bounded by the bytes of the inputs. */
void recorder_scan(struct recorder *recorder, const struct resource *resource, int64_t now_ns);
/** recorder_interrupting - before inputs are read for tasks that interrupt another. Scan-safe:
 * yes. */
void recorder_interrupting(struct recorder *recorder, const struct resource *resource);
/** recorder_interrupt - when they are read. A scan that fills half of the ring with them is not
 * in the record, nor are those before it. Scan-safe: yes. */
void recorder_interrupt(struct recorder *recorder, const struct resource *resource, int64_t now_ns);
/** recorder_scanned - just after it. Scan-safe: yes; now and then it copies the data of the
 * program. */
void recorder_scanned(struct recorder *recorder, const struct resource *resource);
/** recorder_change - before a value is written, forced or released
 * @kind: RECORD_WRITE, RECORD_FORCE, RECORD_UNFORCE
 *
 * Scan-safe: yes; as recorder_scanned(). */
void recorder_change(struct recorder *recorder, const struct resource *resource,
		     enum record_kind kind, struct location at, union iec_value value);
/** recorder_changed - after the last of such changes. Scan-safe: yes. */
void recorder_changed(struct recorder *recorder, const struct resource *resource);
/** recorder_stopped - the program is in STOP, ordered from outside. Scan-safe: yes. */
void recorder_stopped(struct recorder *recorder);
/** recorder_failed - the program is in FAULT. Scan-safe: yes. */
void recorder_failed(struct recorder *recorder, const struct resource *resource);

/* A part of the ring. */
struct recorder_part {
	uint64_t from;                /* the first byte wanted                     */
	uint8_t *out;
	uint32_t room;
	/* The result. */
	uint64_t oldest, end, at;     /* `at`: of the first byte in `out`          */
	uint32_t len;
};
/** recorder_take - copies bytes from `from` on; if they are gone, from the oldest ones on.
 * Scan-safe: yes; a copy of `room` bytes. */
void recorder_take(const struct recorder *recorder, struct recorder_part *part);
#endif
