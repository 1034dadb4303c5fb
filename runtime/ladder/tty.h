/* SPDX-License-Identifier: MIT
 *
 * tty - a terminal in raw mode.
 *
 * Keys come one by one without echo, and the second screen is used. Both are restored when
 * the program ends, also by a signal other than SIGKILL. It draws nothing itself.
 */
#ifndef LADDER_TTY_H
#define LADDER_TTY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** tty_is - whether standard input and output are a terminal that can be drawn on. */
bool tty_is(void);
/** tty_utf8 - whether the locale uses UTF-8. */
bool tty_utf8(void);
/** tty_watch_signals - makes tty_stopped() true after SIGINT, SIGTERM, SIGHUP or SIGQUIT. */
void tty_watch_signals(void);
bool tty_stopped(void);

/** tty_open - switches to raw mode. Fails: false; nothing has changed. */
bool tty_open(void);
void tty_close(void);
/** tty_size - the present number of columns and rows. */
void tty_size(int *width, int *height);
/** tty_draw - writes all bytes. Fails: false. */
bool tty_draw(const char *bytes, size_t len);
/** tty_key - waits at most @wait_ns for a key. Returns its byte, -1: none, -2: input is
 * closed. Sequences of function keys are dropped. */
int tty_key(int64_t wait_ns);
/** tty_sleep - waits @wait_ns, or until a signal arrives. */
void tty_sleep(int64_t wait_ns);
#endif
