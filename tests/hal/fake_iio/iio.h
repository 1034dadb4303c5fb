/* SPDX-License-Identifier: MIT
 *
 * iio - what hal/iio_libiio.c calls of libiio 0.24; tests/hal/fake_iio.c has it.
 */
#ifndef FAKE_IIO_H
#define FAKE_IIO_H

#include <stdbool.h>

struct iio_context;
struct iio_device;
struct iio_channel;

struct iio_context *iio_create_local_context(void);
void iio_context_destroy(struct iio_context *context);
unsigned int iio_context_get_devices_count(const struct iio_context *context);
struct iio_device *iio_context_get_device(const struct iio_context *context, unsigned int index);
const char *iio_device_get_id(const struct iio_device *device);
const char *iio_device_get_name(const struct iio_device *device);
const char *iio_device_get_label(const struct iio_device *device);
unsigned int iio_device_get_channels_count(const struct iio_device *device);
struct iio_channel *iio_device_get_channel(const struct iio_device *device, unsigned int index);
const char *iio_channel_get_id(const struct iio_channel *channel);
bool iio_channel_is_output(const struct iio_channel *channel);
const char *iio_channel_attr_get_filename(const struct iio_channel *channel, const char *attribute);
#endif
