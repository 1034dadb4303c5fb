/* SPDX-License-Identifier: MIT
 *
 * channel_rows - the drivers whose points have channels.
 */
#include "hal/device.h"

#define ROW(id) const struct driver driver_##id = { .word = #id, .by_channel = true };
ROW(iio)
ROW(pwm)
ROW(w1)
ROW(hwmon)
ROW(modbus)
ROW(module)
ROW(peer)
ROW(quality)

const struct device_driver *device_driver(enum driver_id id)
{
	static const struct device_driver *const rows[DRIVER_COUNT] = {
		[DRIVER_iio] = &device_iio, [DRIVER_pwm] = &device_pwm,
		[DRIVER_w1] = &device_w1, [DRIVER_hwmon] = &device_hwmon,
	};

	return rows[id];
}
