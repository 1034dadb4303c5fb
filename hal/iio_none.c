/* SPDX-License-Identifier: MIT
 *
 * iio_none - in place of the driver iio where libiio is not installed: a map that needs it gets LD516.
 */
#include "hal/device.h"

const struct device_driver device_iio = { .find = NULL };

void iio_list(struct device_search *search, device_visit *visit, void *context)
{
	(void)search, (void)visit, (void)context;
}
