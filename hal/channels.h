/* SPDX-License-Identifier: MIT
 *
 * channels - the values of all points that have a channel (hal/channel.h): scaling, filter, quality,
 * substitutes, safe values.
 *
 * hal.c calls it in both directions of a scan. Devices are read and written by threads, one for each device;
 * a scan takes the last value and its age, leaves what is to be written, and never waits. Points of a gateway
 * (modbus, module, peer) get values by channels_put() and give them by channels_get(), from any one thread
 * beside the scan. A SMALL build has none of it.
 *
 * Quality of an input: `fault` if it is outside of its limits, or if three reads in a row failed; else `stale`
 * if it has had no new value for its time; else `good`. One that is not good has its substitute, or keeps its
 * last good value. Of an output: `stale` after a write that failed, `fault` after three in a row; it is tried
 * again. A channel is no fault of the program.
 */
#ifndef HAL_CHANNELS_H
#define HAL_CHANNELS_H

#include "hal/channel.h"
#include "hal/hal.h"

struct channels;
struct channels_count { uint32_t good, stale, fault; };
/* For channels_trace(). @value: of @type, the point's in the image. */
typedef void channels_told(void *context, const struct io_point *point, enum iec_type type, union iec_value value,
			   enum hal_quality quality);

/* One channel of a device of this machine, for channels_list(). Valid during the call only. */
struct device_seen {
	enum driver_id driver;
	const char *device;      /* as in device=, chip=, sensor=             */
	const char *label;       /* another name for it; "": none             */
	const char *channel;     /* as in channel=; "": it has only one       */
	bool output, has_value;
	double value;
	enum io_unit unit;
	const char *problem;     /* why it has no value; ""                   */
};
/* For each of them. */
typedef void device_visit(void *context, const struct device_seen *seen);

#ifndef RUNGBOARD_SMALL
/* Called by hal.c and hal_open.c only. NULL is a map without channels, for all. */
/** channels_plan - finds the devices. Scan-safe: no. Fails: false and an error for each point. */
bool channels_plan(struct channels **out, const struct iomap *map, struct diag_list *diags);
/** channels_open - opens devices, writes safe values, starts the threads, and waits for the first values, a
 * second at most. Fails: false and an error for each point; nothing is open. */
bool channels_open(struct channels *channels, struct diag_list *diags);
/** channels_close - safe values first. Frees @channels. Scan-safe: no. */
void channels_close(struct channels *channels);
/** channels_read - all inputs into the image. Scan-safe: yes. */
void channels_read(struct channels *channels, struct image *image, int64_t now_ns);
/** channels_tell_lines - the worst quality of the lines of chips, for channels_lines(). Scan-safe: yes. */
void channels_tell_lines(struct channels *channels, enum hal_quality worst);
/** channels_write - all outputs of the image that have changed or are due. Scan-safe: yes. */
void channels_write(struct channels *channels, struct image *image, int64_t now_ns);
/** channels_trace - calls @told (NULL: nothing) for each output whose value, and for each point whose quality is
 * another one than at the last call. After a scan. Scan-safe: yes, as far as @told is. */
void channels_trace(struct channels *channels, struct image *image, channels_told *told, void *context);
/**
 * channels_safe_files - calls @visit for each output that is a number in a file and does not hold its last value,
 * until it returns false
 * @fresh: only those that the other map does not have, after channels_beside()
 * Scan-safe: yes, as far as @visit is.
 */
void channels_safe_files(const struct channels *channels, bool fresh,
			 bool (*visit)(void *context, const char *path, int64_t number), void *context);
/** channels_safe - safe values to all outputs, which hold them until channels_release(). Scan-safe: yes, also
 * in a signal handler. */
void channels_safe(struct channels *channels);
/** channels_release - channels_write() writes again. Scan-safe: yes. */
void channels_release(struct channels *channels);
/** channels_supported - false: built without this driver. */
bool channels_supported(enum driver_id id);
/** channels_memory - the most bytes that one point takes. */
size_t channels_memory(void);

/**
 * channels_beside - makes ready @map beside @now; as hal_beside()
 * channels_exchange - between scans: @next goes on with the values and outputs of both maps
 *
 * Outputs that only @now has get their safe values. The same call with both exchanged goes back.
 */
enum hal_beside channels_beside(struct channels **next, struct channels *now,
				const struct iomap *map, struct diag_list *diags, char *line);
void channels_exchange(struct channels *now, struct channels *next);

/* For others. */
/** channels_quality - the worst. Scan-safe: yes. */
enum hal_quality channels_quality(const struct channels *channels);
/** channels_point - the quality of a point of the map; good if it has no channel. Scan-safe: yes. */
enum hal_quality channels_point(const struct channels *channels, int point);
/** channels_lines - the states that channels_tell_lines() gave. Scan-safe: yes. */
enum hal_quality channels_lines(const struct channels *channels);
/** channels_changes - how often the quality of a point became another one. By the thread that scans. Scan-safe:
 * yes. */
uint64_t channels_changes(const struct channels *channels);
/** channels_tally - how many have which quality. Scan-safe: yes. */
struct channels_count channels_tally(const struct channels *channels);
/**
 * channels_put - a gateway has read a point of the map, or has written an output
 * @value: of the type channel->raw; not used of an output
 * @good: false: the device does not answer, or answers with an error
 * @now_ns: monotonic
 * Scan-safe: yes; for one thread beside the scan. */
void channels_put(struct channels *channels, int point, union iec_value value, bool good,
		  int64_t now_ns);
/** channels_get - what a gateway is to write: of the type channel->raw; the safe value while outputs are
 * held. @serial: rises with each change; 0: no value yet. As channels_put(). */
union iec_value channels_get(const struct channels *channels, int point, uint32_t *serial);
/** channels_alone - no gateway is there: its points are stale at once. As channels_put(). */
void channels_alone(struct channels *channels, enum driver_id of);
/** hal_channels - those of the map that runs; NULL: it has none. Of another thread: only between exchanges. */
static inline struct channels *hal_channels(const struct hal *hal)
{
	return __atomic_load_n(&hal->channels, __ATOMIC_ACQUIRE);
}
/** hal_keep_channels - after channels_plan() or channels_beside(). */
static inline void hal_keep_channels(struct hal *hal, struct channels *of)
{
	__atomic_store_n(&hal->channels, of, __ATOMIC_RELEASE);
}
/** hal_close_channels - of hal_close() and hal_close_rest(). */
static inline void hal_close_channels(struct hal *hal)
{
	struct channels *channels = hal_channels(hal);

	hal_keep_channels(hal, NULL);
	channels_close(channels);
}
/** hal_exchange_channels - of hal_exchange(). */
static inline void hal_exchange_channels(struct hal *hal, struct hal *other)
{
	struct channels *now = hal->channels;

	channels_exchange(now, other->channels);
	__atomic_store_n(&hal->channels, other->channels, __ATOMIC_RELEASE);
	other->channels = now;
}
/** io_has_channel - whether a point is none of a request of lines. */
static inline bool io_has_channel(const struct io_point *point)
{
	return point->channel;
}
#else
#define hal_close_channels(hal)                 ((void)0)
#define hal_exchange_channels(hal, other)       ((void)0)
#define io_has_channel(point)                   false
#define channels_beside(next, now, map, diags, line) ((void)(next), BESIDE_GOOD)
#define channels_read(channels, image, now_ns)  ((void)0)
#define channels_tell_lines(channels, worst)    ((void)0)
#define channels_write(channels, image, now_ns) ((void)0)
#define channels_trace(channels, image, told, context) ((void)0)
#define channels_safe_files(channels, fresh, visit, context) ((void)(visit))
#define channels_safe(channels)                 ((void)0)
#define channels_release(channels)              ((void)0)
#define channels_quality(channels)              QUALITY_GOOD
#define channels_tally(channels)                ((struct channels_count){ 0 })
#define channels_supported(id)                  false
#define channels_memory()                       ((size_t)0)
#define channels_plan(out, map, diags)          ((void)(out), true)
#define channels_open(channels, diags)          true
#define channels_close(channels)                ((void)0)
#define hal_channels(hal)                       NULL
#define hal_keep_channels(hal, of)              ((void)0)
#endif

/** hal_worst - the worst quality of lines and channels. Scan-safe: yes. */
static inline enum hal_quality hal_worst(const struct hal *hal)
{
	const enum hal_quality lines = hal_quality(hal), channels = channels_quality(hal_channels(hal));

	return lines > channels ? lines : channels;
}

/**
 * channels_list - calls @visit for each channel of the iio, pwm, w1 and hwmon devices of this machine
 * @sys: NULL: "/sys"
 *
 * It reads the present value of each input, so it may take a second for each sensor of a 1-wire bus.
 * Scan-safe: no.
 */
void channels_list(const char *sys, device_visit *visit, void *context);
#endif
