/* SPDX-License-Identifier: MIT
 *
 * store - retained variables over a power cut: --retain FILE.
 *
 * The scan hands its values over and goes on; a thread writes them to the file when
 * they have changed. store_thread.c does so; store_none.c is for boards without
 * threads and refuses. What the bytes mean is scan/retain.h's.
 */
#ifndef LADDERD_STORE_H
#define LADDERD_STORE_H

#include "engine/base/arena.h"
#include "engine/scan/resource.h"

struct store;

/* From one write to the next, at least; --retain-period. */
#define STORE_PERIOD_LEAST INT64_C(10000000)      /* 10 ms */
#define STORE_PERIOD_MOST  INT64_C(3600000000000) /* 1 h   */

/* What of it the options say. */
struct store_wish {
	const char *path;
	int64_t period_ns;
	bool cold;             /* stored values are left alone               */
};

/**
 * store_open - reads the file and says on stderr what was kept and lost
 * @image: of the program; is not changed
 * @arena: lives longer than the store
 * @status: the exit status when it fails
 *
 * A file that cannot be read or is broken is no failure, nor a disk that cannot be
 * written: the program sees SYS_RETAIN_LOST, the operator a message.
 * Owns: @arena, and store_close().   Scan-safe: no.
 * Fails: NULL, with a message: no such folder, not a file, another ladderd has it,
 * an image without names, memory is out.
 */
struct store *store_open(const struct store_wish *wish,
			 const struct image *image, struct arena *arena,
			 int *status);
/** store_measure - how many values a program retains, and their bytes.
 * Scan-safe: no. Fails: false if memory is out, or this ladderd keeps none. */
bool store_measure(const struct program *program, struct arena *arena,
		   uint32_t *values, uint32_t *bytes);
/** store_begin - starts the thread. Scan-safe: no. Fails: -errno. */
int store_begin(struct store *store);
/**
 * store_restore - a warm start: the values into a resource that was just started
 *
 * Those of the file, later those of the last scan that ended. Function blocks' time
 * goes on where the copy was taken, so that timers do not see the power cut.
 * Owns: nothing.   Scan-safe: between scans.   Fails: never.
 */
void store_restore(struct store *store, struct resource *resource,
		   int64_t now_ns);
/** store_take - the values after a whole scan at @now_ns, for the thread. Never waits.
 * Scan-safe: yes. */
void store_take(struct store *store, const struct image *image, int64_t now_ns);
/** store_hurry - has the thread write now what has changed. Scan-safe: between
 * scans. */
void store_hurry(struct store *store);
/** store_close - writes what has changed, ends the thread. Scan-safe: no. */
void store_close(struct store *store);

struct store_status {
	uint32_t copy;         /* number of the last one that is on the disk  */
	uint32_t values, writes, failures;
};
/** store_status - Scan-safe: yes. */
struct store_status store_status(const struct store *store);
#endif
