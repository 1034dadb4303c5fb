/* SPDX-License-Identifier: MIT
 *
 * child - runs a ladderd: starts it, reads its status, sends signals, waits for its end.
 *
 * Its output goes to files in the work folder. Every wait has a long limit that only a hang
 * reaches.
 */
#ifndef GUEST_CHILD_H
#define GUEST_CHILD_H

#include "tests/targets/guest/guest.h"

#include <sys/types.h>

#define CHILD_HANGS  1000 /* did not end in time and was killed               */
#define NO_PTRACE    77   /* exit status of `guest --held`                    */
#define CHILD_SIGNAL 256  /* added to the signal that ended it                */
#define LIMIT_MS     20000

struct child {
	int slot;              /* 0 or 1; part of the names of its files      */
	pid_t pid;
	bool ended;
	int status;
	int pipe;              /* read end of its stderr; -1: a file          */
	bool traced;           /* held by ptrace                              */
};

/** child_start - runs @argv[0]. child_ready() reports the readiness of slot 0. */
void child_start(struct child *child, int slot, const char *const *argv);
/** child_start_pipe - the same with stderr in a pipe for the caller. */
void child_start_pipe(struct child *child, const char *const *argv);
/** ladderd_start - runs ladderd FILE --io MAP with up to six more arguments. */
void ladderd_start(struct child *child, const char *file, const char *map, ...)
	__attribute__((sentinel));
/** ladderd_run - the same, and waits for its end. Returns the exit status. */
int ladderd_run(const char *file, const char *map, ...)
	__attribute__((sentinel));
/** child_ready - the time at which ladderd reported its first scan; 0: it did not. */
int64_t child_ready(void);
/** child_is_ready - whether it has reported already. Does not wait. */
bool child_is_ready(void);
/** child_end - waits. Returns the exit status, CHILD_SIGNAL + N, or CHILD_HANGS. */
int child_end(struct child *child);
void child_signal(struct child *child, int signal_number);
/** child_stop - sends SIGTERM, then calls child_end(). */
int child_stop(struct child *child);
/** child_out, child_err - the output so far; valid until the next call. */
const char *child_out(const struct child *child);
const char *child_err(const struct child *child);
/**
 * child_hold - steps it from system call to system call until @there says that
 * it has come far enough, and holds it there until child_let_go()
 *
 * A child that was not started by child_start_held() runs on until this call.
 * Fails: false: it ended, or there is no ptrace here; it is not held.
 */
bool child_hold(struct child *child, bool (*there)(void *context),
		void *context);
void child_let_go(struct child *child);
/** child_start_held - child_start() with the child stopped at its start. Call
 * child_hold() next. False: there is no ptrace. */
bool child_start_held(struct child *child, const char *const *argv);
/** child_line - whether the pipe had a line with @text so far. Does not wait. */
bool child_line(struct child *child, const char *text);
/** child_says - waits until stderr contains @text. */
bool child_says(struct child *child, const char *text);
/** child_status - a new status block; "": none. */
const char *child_status(struct child *child);
/** child_number - N of a line `WORD N` in a text; -1: no such line. */
long child_number(const char *text, const char *word);
#endif
