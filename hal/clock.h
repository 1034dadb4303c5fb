/* SPDX-License-Identifier: MIT
 *
 * clock - the clock of the machine, which nobody sets. A scan does not read it: it gets a time.
 */
#ifndef HAL_CLOCK_H
#define HAL_CLOCK_H

#include <stdint.h>
#include <time.h>

/** clock_now - ns since some moment before the start of the program. Async-signal-safe. Scan-safe: no. */
static inline int64_t clock_now(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return now.tv_sec * INT64_C(1000000000) + now.tv_nsec;
}

#endif
