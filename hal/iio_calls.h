/* SPDX-License-Identifier: MIT
 *
 * iio_calls - the functions of libiio that the driver iio calls. The library is loaded when a map or a list needs it:
 * with the libraries that it brings, it has more memory than ladderd. Private to the HAL.
 */
#ifndef HAL_IIO_CALLS_H
#define HAL_IIO_CALLS_H

#include <stdbool.h>

struct iio_context;
struct iio_device;
struct iio_channel;

/* A row: the type of the result, the name without iio_, the arguments. */
#define IIO_CALLS(CALL) \
	CALL(struct iio_context *, create_local_context, void) \
	CALL(void, context_destroy, struct iio_context *) \
	CALL(unsigned int, context_get_devices_count, const struct iio_context *) \
	CALL(struct iio_device *, context_get_device, const struct iio_context *, unsigned int) \
	CALL(const char *, device_get_id, const struct iio_device *) \
	CALL(const char *, device_get_name, const struct iio_device *) \
	CALL(const char *, device_get_label, const struct iio_device *) \
	CALL(unsigned int, device_get_channels_count, const struct iio_device *) \
	CALL(struct iio_channel *, device_get_channel, const struct iio_device *, unsigned int) \
	CALL(const char *, channel_get_id, const struct iio_channel *) \
	CALL(bool, channel_is_output, const struct iio_channel *) \
	CALL(const char *, channel_attr_get_filename, const struct iio_channel *, const char *)

struct iio_calls {
#define CALL(type, name, ...) type (*name)(__VA_ARGS__);
	IIO_CALLS(CALL)
#undef CALL
};

/** iio_calls_find - loads the library and finds its functions. Owns: the library stays until the process ends.
 * Scan-safe: no. Fails: false: it is not installed, or is another version; @out is undefined. */
bool iio_calls_find(struct iio_calls *out);
#endif
