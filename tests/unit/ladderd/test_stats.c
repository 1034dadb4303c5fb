/* SPDX-License-Identifier: MIT
 *
 * test_stats - the times of scans, also of more scans than 32 bits count.
 */
#include "ladderd/stats.h"

#include "tests/tap.h"

static struct stats stats;

static void test_shares(void)
{
	for (int i = 0; i < 1000; i++)
		stats_add(&stats, i < 998 ? 10 : 1000000);
	CHECK(stats_share(&stats, 900) == 10 && stats_share(&stats, 997) == 10);
	CHECK(stats_share(&stats, 999) == 1000000 && stats_share(&stats, 1000) == 1000000);
	CHECK(stats_mean(&stats) == (998 * 10 + 2 * 1000000) / 1000);
}

/* 100 days with scans of 1 ms: one in 1,000 takes 1 ms, the others 8 ns. */
static void test_a_hundred_days(void)
{
	const uint64_t before = UINT32_MAX - 5u;

	stats = (struct stats){ .count = before + before / 1000, .bucket = { [8] = (uint32_t)before } };
	for (uint32_t i = 0; i < before / 1000; i += 4096)
		stats_add(&stats, 1000000);
	for (int i = 0; i < STATS_BUCKETS; i++)
		if (i != 8 && stats.bucket[i])
			stats.bucket[i] = (uint32_t)(before / 1000);
	CHECK(stats_share(&stats, 990) == 8 && stats_share(&stats, 1000) == 1000000);
	for (int i = 0; i < 100; i++)
		stats_add(&stats, 8);
	CHECK(stats.bucket[8] > UINT32_MAX / 2 - 10 && stats.max_ns == 1000000);
	CHECK(stats_share(&stats, 990) == 8 && stats_share(&stats, 998) == 8);
	CHECK(stats_share(&stats, 1000) == 1000000);
}

int main(void)
{
	test_shares();
	test_a_hundred_days();
	return tap_done();
}
