/* SPDX-License-Identifier: MIT
 *
 * stats - counts times in buckets: one per ns below 16 ns, above that eight per doubling,
 * up to about 18 minutes.
 */
#include "ladderd/stats.h"

#define EXACT   16
#define OCTAVE0 4 /* log2 of EXACT */

static unsigned bucket_of(uint64_t ns)
{
	unsigned octave, bucket;

	if (ns < EXACT)
		return (unsigned)ns;
	octave = 63u - (unsigned)__builtin_clzll(ns);
	bucket = EXACT + (octave - OCTAVE0) * 8 +
		 (unsigned)(ns >> (octave - 3) & 7);
	return bucket < STATS_BUCKETS ? bucket : STATS_BUCKETS - 1;
}

/* The largest time of a bucket. */
static int64_t bucket_end(unsigned bucket)
{
	unsigned octave;

	if (bucket < EXACT)
		return bucket;
	octave = OCTAVE0 + (bucket - EXACT) / 8;
	return ((int64_t)(8 + (bucket - EXACT) % 8 + 1) << (octave - 3)) - 1;
}

/* A bucket is full: scans of 1 ms need 50 days for that. The shares stay. */
static void halve(struct stats *stats)
{
	for (unsigned i = 0; i < STATS_BUCKETS; i++)
		stats->bucket[i] /= 2;
}

void stats_add(struct stats *stats, int64_t ns)
{
	uint32_t *bucket;

	if (ns < 0)
		ns = 0;
	stats->last_ns = ns;
	stats->sum_ns += ns;
	stats->count++;
	if (ns > stats->max_ns)
		stats->max_ns = ns;
	bucket = &stats->bucket[bucket_of((uint64_t)ns)];
	if (*bucket == UINT32_MAX)
		halve(stats);
	++*bucket;
}

int64_t stats_mean(const struct stats *stats)
{
	return stats->count ? stats->sum_ns / (int64_t)stats->count : 0;
}

int64_t stats_share(const struct stats *stats, unsigned thousandths)
{
	uint64_t count = 0, above, seen = 0;

	for (unsigned i = 0; i < STATS_BUCKETS; i++)
		count += stats->bucket[i];
	/* Number of times that may be longer. */
	above = count / 1000 * (1000 - thousandths) + count % 1000 * (1000 - thousandths) / 1000;
	for (unsigned i = STATS_BUCKETS; i-- > 0;) {
		seen += stats->bucket[i];
		if (seen > above)
			return bucket_end(i) < stats->max_ns ? bucket_end(i) :
							       stats->max_ns;
	}
	return 0;
}
