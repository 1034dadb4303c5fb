/* SPDX-License-Identifier: MIT
 *
 * channel_rows - the drivers whose points have channels.
 */
#include "hal/drivers.h"

#define ROW(id) const struct driver driver_##id = { .word = #id, .by_channel = true };
ROW(iio)
ROW(pwm)
ROW(w1)
ROW(hwmon)
ROW(modbus)
ROW(module)
ROW(peer)
ROW(quality)
