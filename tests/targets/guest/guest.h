/* SPDX-License-Identifier: MIT
 *
 * guest - what the tests of the guest suite share: options, TAP, time, files.
 *
 * The suite runs as root in a Linux guest with gpio-sim and drives a ladderd
 * through real lines, from outside. It runs without an MMU too: no fork, no
 * thread, no shell, buffers are static. Time is CLOCK_MONOTONIC, so that in a
 * guest with virtual time minutes cost nothing.
 */
#ifndef GUEST_GUEST_H
#define GUEST_GUEST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define MS INT64_C(1000000)
#define TEXT_BYTES 16384 /* of a file that is looked at; the rest is cut off */
#define PATH_MOST  256

struct guest {
	const char *self;      /* this program, for its helper modes          */
	const char *cases;     /* folder that `make cases` made               */
	const char *work;      /* folder for files of a run                   */
	const char *ladderd;   /* the one that is driven now                  */
	const char *word;      /* "uapi" of "ladderd-uapi"                    */
	bool small;            /* tier: images only, no users, no limits      */
	int64_t longest_ns;    /* of a scenario; longer ones are skipped      */
	unsigned flips;        /* damaged images at most; 0: every byte       */
	int only;              /* this test alone; 0: all                     */
};
extern struct guest guest;

/* One result line, `ok N - WORD: TEXT`. A failure shows what ladderd said. */
bool check(bool good, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
void skip(const char *why, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
void note(const char *format, ...) __attribute__((format(printf, 1, 2)));
/** give_up - the guest itself is broken: `Bail out!` and the end. */
void give_up(const char *what) __attribute__((noreturn));

int64_t clock_now(void);
void sleep_until(int64_t at_ns);
void sleep_ms(int64_t ms);
/** file_put - writes a file of the work folder; its path lives until four more
 * were written. */
const char *file_put(const char *name, const void *bytes, size_t len);
const char *file_text(const char *name, const char *text);
/** file_take - at most @room - 1 bytes and a NUL; -1: cannot be read. */
long file_take(const char *path, char *out, size_t room);
/** file_case - path of a file in the folder of cases; as file_put. */
const char *file_case(const char *name);
bool file_is_there(const char *path);

/* The tests, by their numbers in the suite. */
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
#endif
