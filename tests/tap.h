/* SPDX-License-Identifier: MIT
 *
 * tap - TAP output of a unit test.
 *
 * Include it in one file of a program. CHECK does not stop the test; tap_done() prints
 * the plan; a program without checks fails.
 */
#ifndef TESTS_TAP_H
#define TESTS_TAP_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int tap_count, tap_failed;

static inline int tap_check(int good, const char *what, const char *file, int line)
{
	tap_count++;
	printf("%sok %d - %s\n", good ? "" : "not ", tap_count, what);
	if (!good) {
		tap_failed++;
		printf("# %s:%d\n", file, line);
	}
	return good;
}
#define CHECK(condition) tap_check(!!(condition), #condition, __FILE__, __LINE__)
#define CHECK_AS(condition, what) tap_check(!!(condition), what, __FILE__, __LINE__)
#define CHECK_TEXT(got, want) do { \
	if (!tap_check(strcmp((got), (want)) == 0, #got, __FILE__, __LINE__)) \
		printf("# got:  %s\n# want: %s\n", (got), (want)); \
} while (0)

/* How many random cases to try: n, or a tenth in an emulator (EMULATED is set), which is slow
 * and looks for faults of the processor, not for rare cases. */
static inline int tap_rounds(int n)
{
	return getenv("EMULATED") ? (n + 9) / 10 : n;
}

/* What cannot be seen here is said. */
static inline void tap_skip(const char *why)
{
	printf("ok %d # SKIP %s\n", ++tap_count, why);
}

static inline int tap_done(void)
{
	printf("1..%d\n", tap_count);
	return tap_count == 0 || tap_failed;
}
#endif
