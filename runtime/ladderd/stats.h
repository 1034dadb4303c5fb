/* SPDX-License-Identifier: MIT
 *
 * stats - how long something took, over all scans, in a fixed amount of memory.
 *
 * Exact for last, mean and maximum; percentiles come from a histogram
 * whose steps are an eighth of their value. It keeps no list and reads no
 * clock.
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

/** stats_add - one more; negative counts as 0. Scan-safe: yes. */
void stats_add(struct stats *stats, int64_t ns);
int64_t stats_mean(const struct stats *stats);
/** stats_share - @thousandths of 1000 took at most so long, or an eighth less. */
int64_t stats_share(const struct stats *stats, unsigned thousandths);
#endif
