/* SPDX-License-Identifier: MIT
 *
 * hal - the pins of a board: two calls in each scan.
 *
 * It turns an I/O map into requests of drivers and moves levels between them and the
 * process image. It handles inversion, debounce, failed reads and safe values for all
 * drivers. It reads no clock and starts no thread. It reports a fault of a line; the caller
 * stops the program.
 */
#ifndef HAL_HAL_H
#define HAL_HAL_H

#include "hal/iomap.h"

#include "engine/scan/image.h"

#define HAL_REFRESH_NS  1000000000 /* longest time between two writes of an output */
#define HAL_FAILURES    3          /* failed calls in a row that are a fault */

enum hal_quality {
	QUALITY_GOOD,
	QUALITY_STALE, /* the last call failed; the previous value is kept   */
	QUALITY_FAULT, /* HAL_FAILURES in a row; not read until hal_reopen() */
	QUALITY_FORCED, /* only for a person and in what tells quality: somebody holds the value */
};

struct channels;
struct hal_request;
struct line_seen;

struct hal {
	const struct iomap *map;
	struct hal_request *request;
	uint32_t request_count;
	volatile int held;      /* outputs are held at their safe values      */
	uint64_t failed;        /* calls of drivers that failed               */
	uint64_t reopened;      /* requests that hal_reopen() opened          */
	size_t bytes;           /* taken from the arena                       */
	/* Called for each change of an output, also by hal_write_safe(), so perhaps
	 * in a signal handler; or NULL. */
	void (*trace)(void *context, const struct io_point *point, bool value);
	void *trace_context;
	/* Called before an output that holds its value gets @value, in a scan; or NULL. */
	void (*holds)(const struct hal *hal, const struct hal_request *request, uint64_t value);
#ifndef RUNGBOARD_SMALL
	struct channels *channels; /* of the points that have them; NULL: none. See hal_channels() */
#endif
};

/**
 * hal_open - requests all lines of a map
 * @map:   from iomap_read(); borrowed until hal_close()
 * @arena: memory until hal_close(); nothing is allocated later, except by libgpiod in
 *         hal_reopen()
 *
 * First finds every line; requests none unless all exist, are free and named once. Then
 * requests inputs and reads them once, so that the first scan has real values; then
 * outputs, with their safe values. An output with safe=hold begins with 0, after
 * hal_reopen() with its last value.
 * Owns: the caller, hal_close().   Scan-safe: no.
 * Fails: false and an error for each line; all lines are released.
 */
bool hal_open(struct hal *hal, const struct iomap *map, struct arena *arena,
	      struct diag_list *diags);

/**
 * hal_plan - the first half of hal_open(): finds the lines; requests none
 * hal_open_planned - the second half
 */
bool hal_plan(struct hal *hal, const struct iomap *map, struct arena *arena,
	      struct diag_list *diags);
bool hal_open_planned(struct hal *hal, struct diag_list *diags);

/** hal_close - writes the safe values and releases all lines. Scan-safe: no. */
void hal_close(struct hal *hal);

/**
 * ReadPhysicalInputs - reads the levels of all inputs into the process image
 * @now_ns: time of this scan, monotonic; for debounce
 *
 * One call of a driver per request. A request that fails keeps its values.
 * Scan-safe: yes.   Fails: false while a request is in fault.
 */
bool ReadPhysicalInputs(struct hal *hal, struct image *image, int64_t now_ns);

/**
 * WritePhysicalOutputs - writes the outputs of the process image to the lines
 *
 * A request is written when a value has changed, when the previous write failed, and every
 * HAL_REFRESH_NS. Does nothing while outputs are held.
 * Scan-safe: yes.   Fails: false while a request is in fault.
 */
bool WritePhysicalOutputs(struct hal *hal, struct image *image, int64_t now_ns);

/**
 * hal_write_safe - writes all safe values and holds the outputs there; one with safe=hold keeps
 * the value that was written last
 *
 * Scan-safe: yes; also in a signal handler that interrupted a scan.
 * Fails: false if a driver failed; call it again.
 */
bool hal_write_safe(struct hal *hal);

/** hal_release - lets WritePhysicalOutputs() write again. Scan-safe: yes. */
void hal_release(struct hal *hal);

/**
 * hal_reopen - tries to request the lines in fault again
 *
 * Finds each line again, because a chip that was away may have another number. Outputs
 * begin with their safe values.
 * Scan-safe: no; call it while no program runs.   Fails: false if a line is still in fault.
 */
bool hal_reopen(struct hal *hal);

enum hal_beside {
	BESIDE_GOOD,
	BESIDE_RESTART,        /* a line that stays must be requested anew        */
	BESIDE_REFUSED,        /* an error in @diags                              */
};
/**
 * hal_beside - makes ready another map for lines that are open already; requests none
 * @next:  gets the requests of @map; those with a line that is open now take it over later
 * @now:   open; another thread may scan
 * @map:   from iomap_read(); borrowed
 * @arena: memory as long as @next is used
 * @line:  LIMIT_ARG bytes; with BESIDE_RESTART the name of the line
 *
 * The kernel changes direction, bias and drive only when a line is requested again, and a
 * request is given back only as a whole. So a line that goes stays requested, at its safe
 * value, while another line of its request is used. Scan-safe: no.
 */
enum hal_beside hal_beside(struct hal *next, struct hal *now, const struct iomap *map,
			   struct arena *arena, struct diag_list *diags, char *line);
/** hal_open_new - requests the lines of @next that are not open yet; outputs are safe.
 * Scan-safe: no. Fails: false and an error; all that it opened is released. */
bool hal_open_new(struct hal *next, struct diag_list *diags);
/**
 * hal_exchange - goes on with the requests of @other, which gets those of @hal
 *
 * Lines of both keep their levels, and no call is made for them. Outputs that only @hal has
 * get their safe values. The same call again goes back. Scan-safe: between scans; a write for
 * each request that loses an output.
 */
void hal_exchange(struct hal *hal, struct hal *other);
/** hal_close_rest - after hal_exchange(), or instead: releases the lines that are still open
 * in @other. Scan-safe: no. */
void hal_close_rest(struct hal *other);

/** hal_quality - the worst quality of all requests, without channels: hal_worst(). Scan-safe: yes. */
enum hal_quality hal_quality(const struct hal *hal);
/** hal_find - request and bit of an address, for example for sim_set(); NULL: none. */
struct request *hal_find(struct hal *hal, struct iec_addr addr, uint32_t *line);

/** hal_memory - the most bytes that hal_open() takes for @map. */
size_t hal_memory(const struct iomap *map);

/**
 * hal_supported - adds an error for each point whose driver is not built in
 * hal_check - finds every line of a map on this machine, without requesting it
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
 * struct line_seen (hal/drivers.h) is valid during the call.
 * Owns: nothing.   Scan-safe: no.
 * Fails: false and a diagnostic about chips that could not be opened; lines of the others
 * are listed.
 */
bool hal_list(const char *dev,
	      void (*visit)(void *context, const struct line_seen *line),
	      void *context, struct diag_list *diags);
#endif
