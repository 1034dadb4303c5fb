/* SPDX-License-Identifier: MIT
 *
 * channels - the values of all points that have a channel (hal/channel.h): scaling, filter, quality,
 * substitutes, safe values.
 *
 * hal.c calls it in both directions of a scan. Reads of slow devices are done by a thread; a scan takes
 * the last value and its age. Points of a gateway (modbus, module, peer) get values by channels_put() and
 * give them by channels_get(), from any one thread beside the scan. A SMALL build has none of it.
 */
#ifndef HAL_CHANNELS_H
#define HAL_CHANNELS_H

#include "hal/channel.h"
#include "hal/hal.h"

struct channels;

/* Called by hal.c and hal_open.c only. NULL is a map without channels, for all. */
/** channels_plan - finds the devices. Scan-safe: no. Fails: false and an error for each point. */
bool channels_plan(struct channels **out, const struct iomap *map, struct arena *arena,
		   struct diag_list *diags);
/** channels_open - opens devices, reads inputs once, writes safe values, starts the thread. */
bool channels_open(struct channels *channels, struct diag_list *diags);
/** channels_close - safe values first. Scan-safe: no. */
void channels_close(struct channels *channels);
/** channels_read - all inputs into the image. Scan-safe: yes. */
void channels_read(struct channels *channels, struct image *image, int64_t now_ns);
/** channels_write - all outputs of the image that have changed or are due. Scan-safe: yes. */
void channels_write(struct channels *channels, struct image *image, int64_t now_ns);
/** channels_safe - safe values to all outputs. Scan-safe: yes, also in a signal handler. */
bool channels_safe(struct channels *channels);
/** channels_quality - the worst. Scan-safe: yes. */
enum hal_quality channels_quality(const struct channels *channels);

/* For others. */
/** channels_point - the quality of a point of the map. Scan-safe: yes. */
enum hal_quality channels_point(const struct channels *channels, int point);
/**
 * channels_put - a gateway has read a point of the map
 * @value: of the type channel->raw; @good: false: the device does not answer, or answers with an error
 * @now_ns: monotonic
 * Scan-safe: yes; for one thread beside the scan. */
void channels_put(struct channels *channels, int point, union iec_value value, bool good,
		  int64_t now_ns);
/** channels_get - what a gateway is to write: of the type channel->raw; the safe value while outputs are
 * held. @serial: rises with each change; 0: no value yet. As channels_put(). */
union iec_value channels_get(const struct channels *channels, int point, uint32_t *serial);
/** channels_alone - no gateway is there: its inputs are stale at once. As channels_put(). */
void channels_alone(struct channels *channels, enum driver_id of);
#endif
