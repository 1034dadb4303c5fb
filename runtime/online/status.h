/* SPDX-License-Identifier: MIT
 *
 * status - what a board says of itself: fields of the service `status`.
 *
 * Later versions of the protocol may append fields; a desk ignores those that it does not
 * know.
 */
#ifndef ONLINE_STATUS_H
#define ONLINE_STATUS_H

#include "engine/base/limits.h"
#include "online/wire.h"

#define STATUS_TEXT 160

struct task_status {
	char name[64];
	int64_t interval_ns;           /* 0: in every cycle, or on an event    */
	uint64_t runs, overruns;
	int64_t last_ns, max_ns;
	uint64_t interrupted;          /* how often tasks of higher priority ran while it did */
	int64_t wait_ns;               /* the longest time from its deadline to its run */
};

struct board_status {
	uint8_t mode;                  /* enum resource_state: STOP, RUN, FAULT */
	uint8_t io;                    /* enum hal_quality: good, stale, fault */
	uint16_t forces;
	uint8_t program[32];           /* identity of what runs; zero bytes: the board has no program */
	uint64_t scans, late, resets;
	int64_t period_ns;
	int64_t scan_mean_ns, scan_max_ns, scan_p999_ns;
	int64_t wake_mean_ns, wake_max_ns, wake_p999_ns;
	uint32_t errors;               /* operations that failed               */
	uint32_t cpu_permille;         /* of one core, the whole daemon; since its start */
	uint64_t memory_bytes;         /* of code, data, lines                 */
	uint64_t up_ms;                /* since the daemon began               */
	uint32_t sessions;
	uint32_t lines;                /* of the I/O map                       */
	uint64_t io_failed;
	char board[64];                /* of the I/O map: BOARD                */
	char version[32];
	char fault[STATUS_TEXT];       /* "none", or what and where            */
	char error[STATUS_TEXT];       /* where the first operation failed; "" */
	char stop[STATUS_TEXT];        /* where the program executed STOP; ""  */
	uint8_t next;                  /* the event that says why the next start runs another
					* program than this one; 0: it does not */
	char next_why[STATUS_TEXT];    /* its argument                         */
	char disk[STATUS_TEXT];        /* what the disk does not take, and why; "" */
	uint32_t speed;                /* words of instructions a ms; 0: not known yet */
	uint8_t began;                 /* the event before this start, which says how it came about; 0:
					* the board does not know */
	uint16_t began_how;            /* its arguments: a signal or status; 0: none */
	uint32_t began_ends;           /* abnormal ends since ladder-guard began */
	uint8_t task_count;
	struct task_status task[LIMIT_TASKS];
};

/** status_put - its fields. Scan-safe: yes; so is status_take(). */
void status_put(struct wire_writer *out, const struct board_status *status);
/** status_take - Fails: the reader has failed. Bytes behind the known fields are ignored;
 * texts are cut and end with NUL. */
void status_take(struct wire_reader *in, struct board_status *status);
/** status_has_program - false: nothing was ever downloaded to this board. */
bool status_has_program(const struct board_status *status);
/** status_next - @text: that of the event status->next, or its translation; gets why the next
 * start runs another program than this one. As snprintf. */
int status_next(const struct board_status *status, const char *text, char *out, size_t size);
/** status_began - @text: that of the event status->began, or its translation; gets what
 * was before this start. As snprintf. */
int status_began(const struct board_status *status, const char *text, char *out, size_t size);
#endif
