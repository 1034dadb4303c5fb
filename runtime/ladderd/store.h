/* SPDX-License-Identifier: MIT
 *
 * store - keeps retained variables over a power cut: --retain FILE.
 *
 * The scan copies its values to a thread, which writes them to the file when they have
 * changed (store_thread.c). store_none.c is for boards without threads and refuses
 * --retain. scan/retain.h defines the bytes.
 */
#ifndef LADDERD_STORE_H
#define LADDERD_STORE_H

#include "engine/base/arena.h"
#include "engine/scan/resource.h"

struct store;

/* Limits of --retain-period, the least time between writes. */
#define STORE_PERIOD_LEAST INT64_C(10000000)      /* 10 ms */
#define STORE_PERIOD_MOST  INT64_C(3600000000000) /* 1 h   */

/* The options about it. */
struct store_wish {
	const char *path;
	int64_t period_ns;
	bool cold;             /* stored values are not used                 */
	bool quiet;            /* says only what is wrong                    */
};

/**
 * store_open - reads the file and prints to stderr which values were kept and lost
 * @image: of the program; not changed
 * @arena: must live longer than the store
 * @status: gets the exit status after a failure
 *
 * A file that cannot be read or is damaged is no failure, nor is a disk that cannot be
 * written: the program sees SYS_RETAIN_LOST, the operator a message.
 * Owns: @arena, and store_close().   Scan-safe: no.
 * Fails: NULL after a message: no such folder, not a file, another ladderd uses it, an image
 * without names, memory is out.
 */
struct store *store_open(const struct store_wish *wish,
			 const struct image *image, struct arena *arena,
			 int *status);
/** store_measure - the number of values that a program retains, and their bytes.
 * Scan-safe: no. Fails: false if memory is out, or this ladderd stores no values. */
bool store_measure(const struct program *program, struct arena *arena,
		   uint32_t *values, uint32_t *bytes);
/** store_begin - starts the thread. Scan-safe: no. Fails: -errno. */
int store_begin(struct store *store);
/**
 * store_restore - sets the retained values in a resource that was just started
 *
 * At the first call with the values of the file, later with those of the last whole scan.
 * Time of function blocks goes on from the time of the copy, so the power cut does not
 * count for timers.
 * Owns: nothing.   Scan-safe: between scans.   Fails: never.
 */
void store_restore(struct store *store, struct resource *resource,
		   int64_t now_ns);
/** store_take - copies the values after a whole scan, whose timers counted from @clock_ns (ns), for the
 * thread. Never waits. Scan-safe: yes. */
void store_take(struct store *store, const struct image *image, int64_t clock_ns);
/** store_keep - the same for what desks have written since the last whole scan, if anything. @image:
 * no scan was cut off in it. Scan-safe: between scans. */
void store_keep(struct store *store, const struct image *image);
/** store_go_on - the values of a program that runs already, put there by a download, are those of this
 * store; the clock of its timers goes on. Scan-safe: between scans. */
void store_go_on(struct store *store, const struct resource *resource);
/** store_put - these values, as of the scan's clock @clock_ns, are those of the next
 * store_restore(). @copy: of a plan of the same program. Scan-safe: between scans. */
void store_put(struct store *store, const uint8_t *copy, int64_t clock_ns);
/** store_hurry - makes the thread write changed values now. Scan-safe: between scans. */
void store_hurry(struct store *store);
/** store_close - writes changed values and ends the thread. Scan-safe: no. */
void store_close(struct store *store);

struct store_status {
	uint32_t copy;         /* number of the newest copy on the disk       */
	uint32_t values, writes, failures;
};
/** store_status - figures for the status. Scan-safe: yes. */
struct store_status store_status(const struct store *store);
/** store_error - an errno: why values are not stored now, EINPROGRESS if a write takes longer than
 * 3 s; 0: they are stored. Scan-safe: yes. */
int store_error(const struct store *store);
#endif
