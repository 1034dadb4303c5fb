/* SPDX-License-Identifier: MIT
 *
 * record_file - what happened on a board, from the file that `ladder board … record` writes
 * (docs/record.md).
 *
 * The file holds the programs that ran and the log of the board's recorder
 * (scan/recorder.h). A playback computes any scan again. Every byte of the file is hostile:
 * it is checked wholly when it is opened. It reads no file itself.
 */
#ifndef TRIAL_RECORD_FILE_H
#define TRIAL_RECORD_FILE_H

#include "engine/base/sink.h"
#include "engine/trial/twin.h"

#define RECORD_MAGIC   "RUNGRECD"
#define RECORD_VERSION 2u    /* that of a log without quality of values is 1   */
#define RECORD_PROGRAMS 16 /* in a file, at most                               */
#define RECORD_MOST    (256u << 20) /* bytes of a file                         */

/* ---- the file as a whole ---- */

struct record_program {
	uint8_t identity[32];
	const uint8_t *image;     /* NULL: unknown                            */
	uint32_t len;
};
struct record_parts {
	const char *board;        /* its name                                 */
	struct record_program program[RECORD_PROGRAMS];
	uint32_t program_count;
	const uint8_t *log;
	size_t len;
	bool has_quality;         /* of values; else older versions can read it */
};
/** record_programs - finds the programs that a log names, without their images, and has_quality. Scan-safe: no.
 * Fails: false: the log is damaged, or names too many. */
bool record_programs(struct record_parts *parts);
/** record_write - the file. Programs without an image are left out. Scan-safe: no. Fails:
 * false: the sink cannot take it all. */
bool record_write(const struct record_parts *parts, const struct sink *out);

/* ---- an open file ---- */

struct record_file;

/**
 * record_file_open - opens a file and checks all of it
 * @bytes: not needed any more afterwards
 *
 * Scans before the last one whose program is not in the file are left out.
 * Owns: the caller, record_file_free(). Scan-safe: no. Fails: NULL, and the reason and the byte
 * in *@why and *@where.
 */
struct record_file *record_file_open(const void *bytes, size_t len, enum diag_id *why,
				     size_t *where);
void record_file_free(struct record_file *file);
const char *record_file_board(const struct record_file *file);
/** record_file_first, record_file_last - numbers of scans, counted since ladderd began. The
 * first one is that of the state with which the record begins. */
uint64_t record_file_first(const struct record_file *file);
uint64_t record_file_last(const struct record_file *file);

/* ---- playback ---- */

struct playback {
	struct twin twin;         /* the state right after a scan. `scan` is its number, `now_ns`
				   * the time since the first state, `period_ns` that since the
				   * scan before. Its resource has the times of the board */
	const struct record_file *file;
	int64_t wall_ns;          /* date and time of the scan                */
	uint32_t changes;         /* counts when the twin gets another program: then its places
				   * and pointers are new */
	bool exact;               /* set before a seek: power of cells only where the board
				   * computed it, and keyframes are compared */
	uint64_t differs;         /* scan of the first keyframe that differs; 0: none */
	/* Which values were not good: runs of the log, for record_quality_of(). NULL: all were good. */
	const uint8_t *bad;
	size_t bad_len;
	/* Its own. */
	size_t at;                /* the next record                          */
	int64_t time_ns, step_ns;
	uint32_t program;
	/* The interruption that comes next in the scan that runs. */
	uint32_t points;          /* the safe point; UINT32_MAX: none         */
	int64_t point_ns;
	size_t inputs_at, point_end; /* 0: its inputs are the same; where it ends */
};

/** playback_init - at the first state. Owns: playback_free(). @file: borrowed. Scan-safe: no; so
 * are all of these. Fails: false: no memory. */
bool playback_init(struct playback *playback, const struct record_file *file);
void playback_free(struct playback *playback);
/** playback_next - one scan on. Fails: false: that was the last, or no memory. */
bool playback_next(struct playback *playback);
/** playback_seek - to the state right after a scan. Fails: false: it is not in the file, or no
 * memory. */
bool playback_seek(struct playback *playback, uint64_t scan);

/* ---- quality of values ---- */

enum record_quality { RECORD_GOOD, RECORD_STALE, RECORD_BROKEN };
/** record_quality_of - of the value at @at, in runs as those of struct playback: the worst of its bits.
 * Scan-safe: yes. */
enum record_quality record_quality_of(const uint8_t *bad, size_t len, const struct program *program,
				      struct location at);
#endif
