/* SPDX-License-Identifier: MIT
 *
 * stats - times of all scans, in a fixed amount of memory.
 *
 * Last, mean and maximum are exact. Percentiles come from a histogram and are at most one
 * eighth too large. It reads no clock.
 */
#ifndef LADDERD_STATS_H
#define LADDERD_STATS_H

#include <stdint.h>

#define STATS_BUCKETS 320

struct stats {
	int64_t last_ns, max_ns, sum_ns;
	uint64_t count;
	uint32_t bucket[STATS_BUCKETS];
};

/** stats_add - adds a time; negative counts as 0. Scan-safe: yes. */
void stats_add(struct stats *stats, int64_t ns);
int64_t stats_mean(const struct stats *stats);
/** stats_share - a percentile: @thousandths of 1000 times are at most so long. */
int64_t stats_share(const struct stats *stats, unsigned thousandths);
#endif
