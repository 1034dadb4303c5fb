/* SPDX-License-Identifier: MIT
 *
 * hal - the pins of a board, behind two calls a scan.
 *
 * It turns an I/O map into requests of drivers and moves levels between them
 * and the process image. Inversion, debounce, failed reads and safe values are
 * here, once for all drivers. It reads no clock, starts no thread and decides
 * nothing: it reports a fault of a line to the caller, which stops the program.
 */
#ifndef HAL_HAL_H
#define HAL_HAL_H

#include "hal/iomap.h"

#include "engine/scan/image.h"

#define HAL_REFRESH_NS  1000000000 /* outputs are written at least so often */
#define HAL_FAILURES    3          /* in a row are a fault                  */

enum hal_quality {
	QUALITY_GOOD,
	QUALITY_STALE, /* the last call failed; the value before is kept     */
	QUALITY_FAULT, /* three in a row; not asked again until hal_reopen   */
};

struct hal_request;
struct line_seen;

struct hal {
	const struct iomap *map;
	struct hal_request *request;
	uint32_t request_count;
	volatile int held;      /* outputs are held at their safe values      */
	uint64_t failed;        /* calls of drivers that failed               */
	uint64_t reopened;      /* requests that were taken again             */
	size_t bytes;           /* taken from the arena                       */
	/* Told of each change of an output that a driver took, also from
	 * hal_write_safe(), so perhaps in a signal handler; may be NULL. */
	void (*trace)(void *context, const struct io_point *point, bool value);
	void *trace_context;
};

/**
 * hal_open - takes all lines of a map
 * @map:   from iomap_read(); borrowed until hal_close()
 * @arena: lends memory until hal_close(); nothing is allocated later by us
 *         (a libgpiod may, while hal_reopen() runs)
 *
 * First finds every line, and touches nothing unless all are there, free, and
 * named once. Takes inputs first and reads them once, so that the first scan
 * sees real values; then outputs, which begin with their safe values.
 * Owns: the caller, hal_close().   Scan-safe: no.
 * Fails: false and an error for each line; all lines are given back.
 */
bool hal_open(struct hal *hal, const struct iomap *map, struct arena *arena,
	      struct diag_list *diags);

/** hal_close - safe values, then gives all lines back. Scan-safe: no. */
void hal_close(struct hal *hal);

/**
 * ReadPhysicalInputs - levels of all inputs into the process image
 * @now_ns: time of this scan, monotonic; debounce counts with it
 *
 * One call of a driver a request. A request that fails keeps its values.
 * Scan-safe: yes.   Fails: false while a request is in fault.
 */
bool ReadPhysicalInputs(struct hal *hal, struct image *image, int64_t now_ns);

/**
 * WritePhysicalOutputs - outputs of the process image to the lines
 *
 * A request is written when one of its values changed, when the write before
 * failed, and every HAL_REFRESH_NS. Does nothing while outputs are held.
 * Scan-safe: yes.   Fails: false while a request is in fault.
 */
bool WritePhysicalOutputs(struct hal *hal, struct image *image, int64_t now_ns);

/**
 * hal_write_safe - drives all outputs to their safe values and holds them there
 *
 * Scan-safe: yes; also in a signal handler that interrupted a scan.
 * Fails: false if a driver refused; call it again.
 */
bool hal_write_safe(struct hal *hal);

/** hal_release - lets WritePhysicalOutputs() write again. Scan-safe: yes. */
void hal_release(struct hal *hal);

/**
 * hal_reopen - tries to take the requests in fault again
 *
 * Looks for each line anew (a chip that came back may have another number);
 * outputs begin with their safe values.
 * Scan-safe: no; call it while nothing runs.   Fails: false: not all answer.
 */
bool hal_reopen(struct hal *hal);

/** hal_quality - the worst of all points. Scan-safe: yes. */
enum hal_quality hal_quality(const struct hal *hal);
/** hal_point_quality - of point @index of the map. Scan-safe: yes (a
 * search). */
enum hal_quality hal_point_quality(const struct hal *hal, int index);
/** hal_find - request and bit of an address, e.g. for sim_set(); NULL: none. */
struct request *hal_find(struct hal *hal, struct iec_addr addr, uint32_t *line);

/** hal_memory - bytes that hal_open() takes at most for @map. */
size_t hal_memory(const struct iomap *map);

/**
 * hal_supported - an error for each point whose driver was not built in
 * hal_check - finds every line of a map on this machine and takes none
 * @scratch: may be freed afterwards
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false and an error for each line.
 */
bool hal_supported(const struct iomap *map, struct diag_list *diags);
bool hal_check(const struct iomap *map, struct arena *scratch,
	       struct diag_list *diags);

/**
 * hal_list - calls @visit for each line of each chip under @dev (NULL: "/dev")
 *
 * struct line_seen is in hal/drivers.h and lives during the call.
 * Owns: nothing.   Scan-safe: no.
 * Fails: false and a diagnostic for what could not be opened; the rest is
 * given.
 */
bool hal_list(const char *dev,
	      void (*visit)(void *context, const struct line_seen *line),
	      void *context, struct diag_list *diags);
#endif
