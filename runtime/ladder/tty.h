/* SPDX-License-Identifier: MIT
 *
 * tty - a terminal in raw mode, which is always given back as it was.
 *
 * Keys come one by one without echo, and the screen is a second one. Whatever
 * ends the program, signals too, restores both. It draws nothing.
 */
#ifndef LADDER_TTY_H
#define LADDER_TTY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** tty_is - are standard input and output a terminal that can be drawn on? */
bool tty_is(void);
/** tty_utf8 - does the locale write UTF-8? */
bool tty_utf8(void);
/** tty_watch_signals - SIGINT, SIGTERM, SIGHUP, SIGQUIT ask to stop. */
void tty_watch_signals(void);
/** tty_stopped - has one of them come? */
bool tty_stopped(void);

/** tty_open - raw mode. Fails: false; nothing has changed. */
bool tty_open(void);
void tty_close(void);
/** tty_size - columns and rows now. */
void tty_size(int *width, int *height);
/** tty_draw - all bytes. Fails: false. */
bool tty_draw(const char *bytes, size_t len);
/** tty_key - waits at most @wait_ns for a key: its byte, -1: none, -2: closed.
 * Sequences of function keys are swallowed. */
int tty_key(int64_t wait_ns);
/** tty_sleep - waits @wait_ns, or until a signal comes. */
void tty_sleep(int64_t wait_ns);
/** tty_now - CLOCK_MONOTONIC in ns. */
int64_t tty_now(void);
#endif
