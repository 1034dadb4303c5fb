/* SPDX-License-Identifier: MIT
 *
 * guest - the common parts of the guest suite: options, TAP, time, files.
 *
 * The suite runs as root in a Linux guest with gpio-sim and tests a ladderd through real
 * lines. It also runs without an MMU: no fork, no thread, no shell, static buffers. Time is
 * CLOCK_MONOTONIC, so that in a guest with virtual time minutes cost nothing.
 */
#ifndef GUEST_GUEST_H
#define GUEST_GUEST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define MS INT64_C(1000000)
#define TEXT_BYTES 16384 /* limit of a file; the rest is cut                 */
#define PATH_MOST  256

struct guest {
	const char *self;      /* this program, for --as-user and the like    */
	const char *cases;     /* folder of `make cases`                      */
	const char *work;      /* folder for files of a run                   */
	const char *ladderd;   /* the ladderd under test                      */
	const char *word;      /* "uapi" of "ladderd-uapi"                    */
	bool again;            /* not the first ladderd                       */
	bool small;            /* tier small: images only, no users, no limits */
	int64_t longest_ns;    /* of a scenario; longer ones are skipped      */
	unsigned flips;        /* damaged images at most; 0: every byte       */
	int only;              /* only this test; 0: all                      */
	int kills, stops;      /* how often ladderd dies and freezes under a guard */
	int starts;            /* how often its outputs are looked at while it starts */
};
extern struct guest guest;

/* Prints a result line, `ok N - WORD: TEXT`. After a failure, also the output of
 * ladderd. */
bool check(bool good, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
void skip(const char *why, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
void note(const char *format, ...) __attribute__((format(printf, 1, 2)));
/** give_up - prints `Bail out!` and ends: the guest itself is broken. */
void give_up(const char *what) __attribute__((noreturn));

int64_t clock_now(void);
void sleep_until(int64_t at_ns);
void sleep_ms(int64_t ms);
/** file_put - writes a file to the work folder. The path is valid until four more were
 * written. */
const char *file_put(const char *name, const void *bytes, size_t len);
const char *file_text(const char *name, const char *text);
/** file_take - reads at most @room - 1 bytes and adds a NUL. Returns -1 if it cannot. */
long file_take(const char *path, char *out, size_t room);
/** file_case - the path of a file in the folder of cases; valid as that of file_put(). */
const char *file_case(const char *name);
bool file_is_there(const char *path);

/* The tests, in the order of their numbers. */
void test_lines(void);
void test_samples(void);
void test_options(void);
void test_ways_out(void);
void test_faults(void);
void test_calls(void);
void test_steady(void);
void test_bad_input(void);
void test_memory(void);
void test_picture(void);
void test_link(void);
void test_serial(void);
void test_guard(void);
void test_starts(void);
void test_values(void);
void test_chips(void);
#endif
