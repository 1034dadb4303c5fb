/* SPDX-License-Identifier: MIT
 *
 * gpiod_none - stands for the gpio driver where libgpiod was not there to build
 * with. A map that names it is refused with LD516; nothing is guessed.
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
	.word = "gpio", .doc = "not built in: libgpiod was missing",
	.state_size = 1, .needs_line = true,
};
