/* SPDX-License-Identifier: MIT
 *
 * say - what ladderd tells ladder-guard: packets on a socket pair that ladderd inherits. Each has
 * one of these forms. Both programs are of one machine and one build, so numbers are those of the
 * machine; the guard checks each packet all the same (guard/check.h).
 */
#ifndef GUARD_SAY_H
#define GUARD_SAY_H

#include <stdint.h>

/* Environment of ladderd: "FD MS STOPPED COUNT HOW PAGE": the descriptor, the heartbeat in ms, 1 if ladderd
 * shall begin in STOP, else 0, how many ladderd have ended abnormally since the guard began, how
 * the last one did: its signal, GUARD_FROZEN, GUARD_HUNG, or GUARD_STATUS and its exit status; and the
 * descriptor of a struct guard_page, or -1. */
#define GUARD_FROZEN   128
#define GUARD_HUNG     129
#define GUARD_STATUS   256
#define GUARD_VARIABLE "LADDER_GUARD"
#define GUARD_OWNER    "ladder-guard" /* consumer of the lines that the guard holds */
#define GUARD_LINES    256            /* outputs that it can hold             */
#define GUARD_FILES    64             /* outputs in files that it can make safe */
#define GUARD_PATH     168            /* bytes of the name of such a file     */
#define GUARD_RECORDS  4080           /* bytes of all files of a packet       */
#define GUARD_DEV      64             /* bytes of the folder of device files  */
#define GUARD_TEXT     120
#define GUARD_MAGIC    UINT32_C(0x31475552)
#define GUARD_LONGEST  120000         /* ms between two heartbeats            */

enum guard_kind {
	GUARD_BEAT = 1, /* it lives; the next comes within within_ms        */
	GUARD_TABLE,    /* its outputs, before it requests them             */
	GUARD_TAKE,     /* it is about to request them; answered with guard_levels */
	GUARD_TELL,     /* a text for the service manager                   */
	GUARD_LEVELS,   /* levels of its outputs that hold, before it writes them */
	GUARD_MORE,     /* further outputs that it will request; none: no longer */
	GUARD_VALUES,   /* outputs that are numbers in files, behind GUARD_TABLE */
	GUARD_VALUES_MORE, /* further ones, behind GUARD_MORE                  */
};

struct guard_head {
	uint32_t magic;
	uint16_t kind;      /* enum guard_kind                                */
	uint16_t count;     /* GUARD_TABLE, GUARD_MORE: lines; GUARD_VALUES…: files */
	uint32_t within_ms; /* GUARD_BEAT: 1 … GUARD_LONGEST                  */
};

enum { GUARD_AS_IS, GUARD_FIRST, GUARD_SECOND, GUARD_THIRD };
/* GUARD_KNOWN: ladderd does not know the level; it is the one that the guard got last for this
 * line, or else the given one. */
enum guard_hold { GUARD_SAFE, GUARD_HOLD, GUARD_KNOWN };
/* An output: the level at the pin, not the value, so inversion is done. */
struct guard_line {
	uint16_t chip;      /* N of gpiochipN                                 */
	uint16_t offset;
	uint8_t level;      /* 0, 1: the safe level; of one that holds: the present one */
	uint8_t bias;       /* GUARD_AS_IS; 1 none, 2 up, 3 down              */
	uint8_t drive;      /* GUARD_AS_IS; 1 push-pull, 2 open drain, 3 open source */
	uint8_t hold;       /* enum guard_hold                                */
};

/* As long as its lines. */
struct guard_table {
	struct guard_head head;
	char dev[GUARD_DEV]; /* ends with a NUL                               */
	struct guard_line line[GUARD_LINES];
};

/* Outputs that are numbers in files; none that holds its last value: the kernel does that by itself. As long as its
 * records: for each file an int64_t, the safe number, and the path, which ends with a NUL. */
struct guard_files {
	struct guard_head head;
	char record[GUARD_RECORDS];
};

/* A bit for each line of the last table, in its order. */
struct guard_levels {
	struct guard_head head;
	uint8_t bit[GUARD_LINES / 8];
};

/*
 * Memory that both programs map, so that the guard sees a scan that hangs where no signal reaches it, and
 * no scan needs a system call for that. ladderd writes it. Times are in GUARD_TICK ns of CLOCK_MONOTONIC,
 * modulo 2^32.
 */
#define GUARD_TICK  1024
#define GUARD_GRACE 20    /* ms after the limit in which ladderd makes the outputs safe itself */
struct guard_page {
	_Atomic uint32_t scan;  /* odd while a scan runs; each has another number */
	_Atomic uint32_t began; /* it, or the one before                      */
	_Atomic uint32_t limit; /* of a scan; 0: none is watched              */
	_Atomic uint32_t safe;  /* the scan in which ladderd has made the outputs safe */
};

struct guard_tell {
	struct guard_head head;
	char text[GUARD_TEXT]; /* ends with a NUL                             */
};
#endif
