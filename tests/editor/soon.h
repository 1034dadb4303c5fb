/* SPDX-License-Identifier: MIT
 *
 * soon - what comes a little later: the main context turns until it is there. Tests wait
 * for conditions, never for times, but for what must be seen not to happen.
 */
#ifndef TESTS_EDITOR_SOON_H
#define TESTS_EDITOR_SOON_H

#include "tests/tap.h"

#include <glib.h>

/** turn - the main context, for so many ms; 0: what waits there now. */
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

/** WAIT - until it holds, for as long as a slow machine may take. */
#define WAIT(condition) \
	do { \
		const gint64 wait_end = g_get_monotonic_time() + 60 * G_USEC_PER_SEC; \
		while (!(condition) && g_get_monotonic_time() < wait_end) \
			if (!g_main_context_iteration(NULL, FALSE)) \
				g_usleep(300); \
	} while (0)
/** CHECK_SOON - it holds now, or then. */
#define CHECK_SOON(condition) do { WAIT(condition); CHECK_AS(condition, #condition); } while (0)

#endif
