/* SPDX-License-Identifier: MIT
 *
 * asks - MB_READ and MB_WRITE have the same pins at the same places.
 */
#include "ladderd/asks.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(struct fb_MB_READ) == sizeof(struct fb_MB_WRITE) &&
	       offsetof(struct fb_MB_READ, asked) == offsetof(struct fb_MB_WRITE, asked) &&
	       offsetof(struct fb_MB_READ, answer) == offsetof(struct fb_MB_WRITE, answer) &&
	       offsetof(struct fb_MB_READ, BUSY) == offsetof(struct fb_MB_WRITE, BUSY), "one look for both");

struct asks *asks_new(const struct program *program, const struct iomap *map)
{
	struct image *image = calloc(1, sizeof(*image));
	const int count = map && map->net ? map->net->ask_count : 0;
	struct asks *asks = image ? calloc(1, sizeof(*asks) + (size_t)count * sizeof(asks->ask[0])) : NULL;

	if (!asks) {
		free(image);
		return NULL;
	}
	image->program = program;
	asks->program = program;
	asks->count = count;
	for (int i = 0; i < count; i++)
		if (!io_ask_find(image, &map->net->ask[i], &asks->ask[i].at))
			asks->ask[i].at = ASK_NOWHERE;
	free(image);
	return asks;
}

static void look_at(struct ask *ask, struct image *image)
{
	const uint8_t *block = image->memory + ask->at;
	const struct location place = { .type = IEC_UDINT,
					.where = ask->at + (uint32_t)offsetof(struct fb_MB_READ, answer) };
	const uint32_t answer = atomic_load_explicit(&ask->answer, memory_order_acquire);
	uint32_t asked, before;

	memcpy(&asked, block + offsetof(struct fb_MB_READ, asked), sizeof(asked));
	memcpy(&before, block + offsetof(struct fb_MB_READ, answer), sizeof(before));
	if (!block[offsetof(struct fb_MB_READ, BUSY)])
		asked = 0;
	atomic_store_explicit(&ask->asked, asked, memory_order_release);
	if (answer && answer != before)
		image_set(image, place, (union iec_value){ .i = answer });
}

void asks_look(struct asks *asks, struct image *image)
{
	if (!asks || asks->program != image->program)
		return;
	for (int i = 0; i < asks->count; i++)
		if (asks->ask[i].at != ASK_NOWHERE)
			look_at(&asks->ask[i], image);
}
