/* SPDX-License-Identifier: MIT
 *
 * said - reads the inputs that tell quality, as the program would.
 */
#include "hal/said.h"

#include "hal/channel.h"
#include "hal/iomap.h"

int io_said_list(const struct iomap *map, const struct areas *areas, struct io_said *out, int most)
{
	int count = 0;

	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];
		const struct io_channel *channel = point->channel;

		if (point->driver != DRIVER_quality)
			continue;
		if (count < most)
			out[count] = (struct io_said){
				.first = 8 * areas_byte(areas, channel->of) + channel->of.bit,
				.count = channel->of_bits, .addr = point->addr, .type = channel->type,
			};
		count++;
	}
	return count;
}

/* A bit says no more than that the value is not good. */
static enum hal_quality said_by(const struct io_said *said, const struct image *image)
{
	struct location at = image_locate(image, said->addr);
	union iec_value value;

	if (at.type == IEC_BOOL)
		return image_get(image, at).i ? QUALITY_GOOD : QUALITY_STALE;
	at.type = said->type;
	value = image_get(image, at);
	return value.i >= QUALITY_GOOD && value.i <= QUALITY_FORCED ? (enum hal_quality)value.i :
	       value.i < QUALITY_GOOD ? QUALITY_GOOD : QUALITY_FAULT;
}

enum hal_quality io_said_quality(const struct io_said *said, int count, const struct image *image,
				 struct location at)
{
	enum hal_quality worst = QUALITY_GOOD;
	uint32_t first, bits;

	if (!count || !image_bits(image->program, at, &first, &bits))
		return QUALITY_GOOD;
	for (int i = 0; i < count; i++) {
		const bool about = said[i].first < first + bits && first < said[i].first + said[i].count;
		const enum hal_quality quality = about ? said_by(&said[i], image) : QUALITY_GOOD;

		if (worst == QUALITY_GOOD || quality == QUALITY_FAULT || (quality == QUALITY_STALE && worst == QUALITY_FORCED))
			worst = quality;
	}
	return worst;
}
