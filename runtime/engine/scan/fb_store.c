/* SPDX-License-Identifier: MIT
 *
 * fb_store - FIFO and LIFO of DINT and REAL, and SHIFT.
 *
 * The values live in the instance, at most ROOM of them. A value that does not fit is
 * dropped, and Q is FALSE; stored values are not overwritten.
 */
#include "engine/scan/fb.h"

#include <string.h>

enum { ROOM = 64, WIDTH = 4 }; /* values; bytes of one, DINT or REAL        */

struct store {
	uint8_t *value;
	const void *in;
	void *out;
	unsigned int used, first; /* values held; place of the oldest        */
	unsigned int size;
	bool last_out;            /* LIFO                                    */
};

static uint8_t *place(const struct store *store, unsigned int index)
{
	return store->value + (store->first + index) % ROOM * WIDTH;
}

static bool push(struct store *store)
{
	if (store->used >= store->size)
		return false;
	memcpy(place(store, store->used++), store->in, WIDTH);
	return true;
}

static bool pop(struct store *store)
{
	if (store->used == 0)
		return false;
	store->used--;
	memcpy(store->out, place(store, store->last_out ? store->used : 0), WIDTH);
	if (!store->last_out)
		store->first = (store->first + 1) % ROOM;
	return true;
}

/* Both at once always succeed: a full store gives first, another takes first. True:
 * everything was done. */
static bool move(struct store *store, bool in, bool out)
{
	bool full = store->used >= store->size, good = in || out;

	if (out && full)
		good &= pop(store);
	if (in)
		good &= push(store);
	if (out && !full)
		good &= pop(store);
	return good;
}

#define STEP(id, is_lifo) \
void fb_##id##_step(struct fb_##id *fb, int64_t now_ns) \
{ \
	bool in = fb_rises(fb->PUSH, &fb->seen_push); \
	bool out = fb_rises(fb->POP, &fb->seen_pop); \
	struct store store = { \
		.value = (uint8_t *)fb->value, .in = &fb->IN, .out = &fb->OUT, \
		.used = fb->used[0] < ROOM ? fb->used[0] : ROOM, \
		.first = fb->first[0] % ROOM, \
		.size = (unsigned int)fb_bound(fb->SIZE, ROOM), \
		.last_out = is_lifo, \
	}; \
\
	(void)now_ns; \
	if (fb->R) \
		store.used = 0; \
	fb->Q = !fb->R && move(&store, in, out); \
	fb->used[0] = (uint8_t)store.used; \
	fb->first[0] = (uint8_t)store.first; \
	fb->COUNT = (int16_t)store.used; \
	fb->EMPTY = store.used == 0; \
	fb->FULL = store.used >= store.size; \
}

STEP(FIFO, false)
STEP(LIFO, true)
STEP(FIFO_REAL, false)
STEP(LIFO_REAL, true)

void fb_SHIFT_step(struct fb_SHIFT *fb, int64_t now_ns)
{
	bool edge = fb_rises(fb->CLK, &fb->seen);
	int bits = fb_bound(fb->N, 64);

	(void)now_ns;
	if (fb->R)
		fb->W = 0;
	else if (edge)
		fb->W = fb->W << 1 | (fb->D != 0);
	fb->W &= UINT64_MAX >> (64 - bits);
	fb->Q = fb->W >> (bits - 1) & 1;
}
