/* SPDX-License-Identifier: MIT
 *
 * child - a ladderd at work: started, asked, signalled, waited for.
 *
 * What it prints goes to files of the work folder. Every wait has a limit that
 * is generous and only a hang reaches.
 */
#ifndef GUEST_CHILD_H
#define GUEST_CHILD_H

#include "tests/targets/guest/guest.h"

#include <sys/types.h>

#define CHILD_HANGS  1000 /* not ended in time; it was killed                 */
#define NO_PTRACE    77   /* what `guest --held` then gives                   */
#define CHILD_SIGNAL 256  /* added to the number of a signal that ended it    */
#define LIMIT_MS     20000

struct child {
	int slot;              /* 0 or 1: names its files                     */
	pid_t pid;
	bool ended;
	int status;
	int pipe;              /* read end of its stderr; -1: a file          */
	bool traced;           /* by this program                             */
};

/** child_start - runs @argv[0]; readiness of slot 0 goes to child_ready(). */
void child_start(struct child *child, int slot, const char *const *argv);
/** child_start_pipe - the same with stderr in a pipe that the caller reads. */
void child_start_pipe(struct child *child, const char *const *argv);
/** ladderd_start - ladderd FILE --io MAP and up to six more arguments. */
void ladderd_start(struct child *child, const char *file, const char *map, ...)
	__attribute__((sentinel));
/** ladderd_run - the same to its end; gives the exit status. */
int ladderd_run(const char *file, const char *map, ...)
	__attribute__((sentinel));
/** child_ready - time at which ladderd said that its first scan is done; 0: it
 * did not. */
int64_t child_ready(void);
/** child_is_ready - has it said so already? Does not wait. */
bool child_is_ready(void);
/** child_end - exit status, CHILD_SIGNAL + N, or CHILD_HANGS. */
int child_end(struct child *child);
void child_signal(struct child *child, int signal_number);
/** child_stop - SIGTERM, then child_end(). */
int child_stop(struct child *child);
/** child_out, child_err - what it printed so far; lives until the next call. */
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
/** child_start_held - as child_start(), but nothing of it has run yet; false: there
 * is no ptrace here. Use child_hold() next. */
bool child_start_held(struct child *child, const char *const *argv);
/** child_line - has the pipe had a line with @text by now? Does not wait. */
bool child_line(struct child *child, const char *text);
/** child_says - waits until stderr has @text. */
bool child_says(struct child *child, const char *text);
/** child_status - a fresh status block; "" if there is none. */
const char *child_status(struct child *child);
/** child_number - N of a line `WORD N` of a text; -1: no such line. */
long child_number(const char *text, const char *word);
#endif
