/* SPDX-License-Identifier: MIT
 *
 * record - measures the recorder of a simulation: bytes for 100,000 scans, and the time to
 * show any of them.
 *
 *   record NAME FILE SCANS
 *
 * Inputs change from time to time. Prints a row of a table; fails if it needs more than 100
 * MB or keeps too few scans.
 */
#include "engine/ladder.h"
#include "engine/trial/record.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define ROOM  ((size_t)100 * 1000 * 1000)
#define SEEKS 400
#define KEPT  UINT64_C(100000)

static uint64_t state = 88172645463325252u;

static uint64_t random_next(void)
{
	state ^= state << 13;
	state ^= state >> 7;
	return state ^= state << 17;
}

/* Processor time of this process, so that other programs do not count. */
static double now_ms(void)
{
	struct timespec now;

	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
	return (double)now.tv_sec * 1e3 + (double)now.tv_nsec / 1e6;
}

static int by_time(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

static void change(struct twin *twin, struct record *record)
{
	struct act act = { .kind = ACT_SET, .at = { .type = IEC_BOOL, .area = AREA_I } };

	if (random_next() % 20)
		return;
	act.at.where = (uint32_t)(random_next() % 256);
	act.value.i = (int64_t)(random_next() & 1);
	if (twin_act(twin, &act))
		record_act(record, twin, &act);
}

static double run(struct twin *twin, struct record *record, uint64_t scans)
{
	const double begin = now_ms();

	while (twin->scan < scans) {
		change(twin, record);
		twin_scan(twin);
		record_scan(record, twin);
	}
	return (now_ms() - begin) * 1e6 / (double)scans;
}

static void seek(const struct record *record, double *took)
{
	const uint64_t first = record_first(record);
	const uint64_t span = record_last(record) - first + 1;
	struct replay replay;

	if (!replay_init(&replay, record))
		exit(2);
	for (int i = 0; i < SEEKS; i++) {
		const double begin = now_ms();

		if (!replay_seek(&replay, record, first + random_next() % span))
			exit(2);
		took[i] = now_ms() - begin;
	}
	replay_free(&replay);
	qsort(took, SEEKS, sizeof(*took), by_time);
}

/* Scans from one frame to the next, now. */
static uint64_t apart(const struct record *record)
{
	struct replay replay;
	uint64_t last;

	if (!replay_init(&replay, record) || !replay_jump(&replay, record, record_last(record)))
		exit(2);
	last = replay.twin.scan;
	if (last > record_first(record) && !replay_jump(&replay, record, last - 1))
		exit(2);
	last -= replay.twin.scan;
	replay_free(&replay);
	return last;
}

int main(int argc, char **argv)
{
	const uint64_t scans = argc > 3 ? strtoull(argv[3], NULL, 10) : KEPT;
	struct ladder *ladder = ladder_new();
	static double took[SEEKS];
	struct record *record;
	struct twin twin;
	double scan_ns, bare_ns;
	bool good;

	ladder_watch(ladder, true);
	if (argc < 3 || !ladder_load(ladder, argv[2]) || !ladder_build(ladder) ||
	    !twin_init(&twin, ladder_program(ladder), NULL, 10000000))
		return 2;
	twin_act(&twin, &(struct act){ .kind = ACT_START });
	record = record_new(&twin, KEPT, ROOM);
	scan_ns = run(&twin, record, scans);
	seek(record, took);
	bare_ns = now_ms();
	for (int i = 0; i < 1000; i++)
		twin_scan(&twin);
	bare_ns = (now_ms() - bare_ns) * 1e3;
	good = record_bytes(record) <= ROOM &&
	       record_last(record) - record_first(record) >= (scans < KEPT ? scans : KEPT);
	printf("| %s | %zu | %llu | %.1f | %.1f | %.1f | %.1f | %.2f | %.2f |\n", argv[1],
	       twin.memory_size, (unsigned long long)(record_last(record) - record_first(record)),
	       (double)record_bytes(record) / 1e6, (double)apart(record),
	       bare_ns / 1e3, scan_ns / 1e3, took[SEEKS / 2], took[SEEKS - 1]);
	record_free(record);
	twin_free(&twin);
	ladder_free(ladder);
	return good ? 0 : 1;
}
