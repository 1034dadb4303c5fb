/* SPDX-License-Identifier: MIT
 *
 * soon - runs the main context until a condition holds. Tests wait for a time only to see that
 * something does not happen.
 */
#ifndef TESTS_EDITOR_SOON_H
#define TESTS_EDITOR_SOON_H

#include "tests/tap.h"

#include <glib.h>

/** turn - runs the main context for so many ms; 0: only what is pending. */
static inline void turn(int ms)
{
	const gint64 end = g_get_monotonic_time() + ms * 1000;

	do {
		while (g_main_context_iteration(NULL, FALSE))
			if (g_get_monotonic_time() >= end && ms)
				return;
		if (ms)
			g_usleep(300);
	} while (g_get_monotonic_time() < end);
}

/** WAIT - until the condition holds, or a slow machine's time limit. */
#define WAIT(condition) \
	do { \
		const gint64 wait_end = g_get_monotonic_time() + 60 * G_USEC_PER_SEC; \
		while (!(condition) && g_get_monotonic_time() < wait_end) \
			if (!g_main_context_iteration(NULL, FALSE)) \
				g_usleep(300); \
	} while (0)
/** CHECK_SOON - checks that the condition holds after WAIT. */
#define CHECK_SOON(condition) do { WAIT(condition); CHECK_AS(condition, #condition); } while (0)

#endif
