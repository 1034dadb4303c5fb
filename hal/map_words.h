/* SPDX-License-Identifier: MIT
 *
 * map_words - what the columns of map_words.def mean.
 */
#ifndef HAL_MAP_WORDS_H
#define HAL_MAP_WORDS_H

#include "hal/iomap.h"

/* What an option is for. Those of a module are for its inputs and its outputs. */
enum option_for { FOR_BOTH, FOR_INPUT, FOR_OUTPUT };

#ifndef RUNGBOARD_SMALL
/* Drivers as bits. */
enum {
	ON_SIM = 1 << DRIVER_sim, ON_GPIO = 1 << DRIVER_gpio, ON_IIO = 1 << DRIVER_iio, ON_PWM = 1 << DRIVER_pwm,
	ON_W1 = 1 << DRIVER_w1, ON_HWMON = 1 << DRIVER_hwmon, ON_MODBUS = 1 << DRIVER_modbus,
	ON_MODULE = 1 << DRIVER_module, ON_PEER = 1 << DRIVER_peer, ON_QUALITY = 1 << DRIVER_quality,
	ON_DEVICE = ON_IIO | ON_W1 | ON_HWMON,
	ON_ALL = ON_SIM | ON_DEVICE | ON_PWM | ON_MODBUS | ON_MODULE | ON_PEER, /* whose values have options */
};

/* Kinds of buses as bits: 1 << enum io_bus_kind. */
enum { OF_RTU = 1, OF_TCP = 2, OF_PEER = 4 };
#endif
#endif
