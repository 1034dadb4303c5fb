/* SPDX-License-Identifier: MIT
 *
 * gpiod_none - replaces the gpio driver in builds with HAL=none. A map that names it is
 * refused with LD516.
 */
#include "hal/drivers.h"

const char *gpio_library(void)
{
	return "libgpiod";
}

const char *gpio_version(void)
{
	return "none";
}

const struct driver driver_gpio = {
	.word = "gpio", .state_size = 1, .needs_line = true,
};
