/* SPDX-License-Identifier: MIT
 *
 * keep - runs of words of eight bytes, by what the bytes of two states differ in:
 *
 *   0x00 … 0x7f        so many words and one more: they are the same
 *   0x80 … 0xbf        so many and one more: a byte for each, whose bits say which of the
 *                      eight differ, each by 1: what BOOLs do
 *   0xc0 … 0xff        likewise, and behind each such byte how those bytes differ
 *
 * The bytes of what is no word, at the end of a part, count as one with zeros behind.
 */
#include "engine/trial/keep.h"

#include <string.h>

#define SAME 0x00u
#define BITS 0x80u
#define REST 0xc0u
#define RUN_SAME 128
#define RUN_OTHER 64

#define ONES UINT64_C(0x0101010101010101)

/* The state of a resource but for the forces that it could have, and does not. */
#define FORCES_AT (offsetof(struct resource, image) + offsetof(struct image, force))
#define BEHIND_AT (FORCES_AT + sizeof(((struct image *)0)->force))

struct times { int64_t now_ns, period_ns; uint64_t scan; };

static uint64_t difference(const uint8_t *a, const uint8_t *b, size_t size)
{
	uint64_t x = 0, y = 0;

	memcpy(&x, a, size < 8 ? size : 8);
	memcpy(&y, b, size < 8 ? size : 8);
	return x ^ y;
}

static unsigned kind_of(uint64_t differs)
{
	return !differs ? SAME : differs & ~ONES ? REST : BITS;
}

static uint8_t *put_word(uint8_t *to, uint64_t differs, unsigned kind)
{
	uint8_t *mask = to++;

	*mask = 0;
	for (int i = 0; i < 8; i++) {
		const uint8_t byte = (uint8_t)(differs >> 8 * i);

		if (!byte)
			continue;
		*mask |= (uint8_t)(1u << i);
		if (kind == REST)
			*to++ = byte;
	}
	return to;
}

/* Words of a kind, from @at on. */
static uint8_t *put_run(uint8_t *to, const uint8_t *a, const uint8_t *b, size_t size,
			size_t *at)
{
	const unsigned kind = kind_of(difference(a + *at, b + *at, size - *at));
	const unsigned most = kind == SAME ? RUN_SAME : RUN_OTHER;
	uint8_t *head = to++;
	unsigned words = 0;

	while (*at < size && words < most) {
		const uint64_t differs = difference(a + *at, b + *at, size - *at);

		if (kind_of(differs) != kind)
			break;
		if (kind != SAME)
			to = put_word(to, differs, kind);
		*at += 8;
		words++;
	}
	*head = (uint8_t)(kind | (words - 1));
	return to;
}

static uint8_t *put(uint8_t *to, const void *a, const void *b, size_t size)
{
	for (size_t at = 0; at < size; )
		to = put_run(to, a, b, size, &at);
	return to;
}

static const uint8_t *get_word(const uint8_t *from, uint8_t *out, size_t size, bool bits)
{
	const uint8_t mask = *from++;

	for (size_t i = 0; i < 8; i++)
		if (mask >> i & 1) {
			const uint8_t byte = bits ? 1 : *from++;

			if (i < size)
				out[i] ^= byte;
		}
	return from;
}


static const uint8_t *get(const uint8_t *from, void *out, const void *base, size_t size)
{
	uint8_t *bytes = out;
	size_t at = 0;

	memmove(bytes, base, size);
	while (at < size) {
		const unsigned head = *from++;
		size_t words = head < BITS ? head + 1 : (head & (RUN_OTHER - 1)) + 1;

		for (; words; words--, at += 8)
			if (head >= BITS)
				from = get_word(from, bytes + at, size - at, head < REST);
	}
	return from;
}

/* ---- a resource ---- */

static const struct force no_force;

static uint8_t *put_resource(uint8_t *to, const struct resource *a,
			     const struct resource *b)
{
	const uint8_t *x = (const uint8_t *)a, *y = (const uint8_t *)b;

	to = put(to, x, y, FORCES_AT);
	to = put(to, x + BEHIND_AT, y + BEHIND_AT, sizeof(*a) - BEHIND_AT);
	for (int i = 0; i < a->image.force_count; i++)
		to = put(to, &a->image.force[i], &no_force, sizeof(no_force));
	return to;
}

static const uint8_t *get_resource(const uint8_t *from, struct resource *out,
				   const struct resource *base)
{
	uint8_t *x = (uint8_t *)out, *own = out->image.memory;
	const uint8_t *y = (const uint8_t *)base;

	from = get(from, x, y, FORCES_AT);
	from = get(from, x + BEHIND_AT, y + BEHIND_AT, sizeof(*out) - BEHIND_AT);
	for (int i = 0; i < out->image.force_count; i++)
		from = get(from, &out->image.force[i], &no_force, sizeof(no_force));
	out->image.memory = out->vm.memory = own;
	return from;
}

/* ---- a twin ---- */

/* Those of the plant lie behind those of the program. */
static size_t memory_of(const struct twin *twin)
{
	return twin->memory_size + twin->plant_size;
}

size_t keep_most(const struct twin *twin)
{
	/* Forces are in the two resources. */
	const size_t size = memory_of(twin) + 2 * sizeof(twin->resource) +
			    sizeof(struct times);

	/* A byte for a word and one for a run; words that are not whole. */
	return size + size / 4 + 4 * 8 * LIMIT_FORCES;
}

size_t keep_put(const struct twin *twin, const struct twin *base, uint8_t *to)
{
	const struct times now = { twin->now_ns, twin->period_ns, twin->scan };
	const struct times then = { base->now_ns, base->period_ns, base->scan };
	uint8_t *at = put(to, &now, &then, sizeof(now));

	at = put_resource(at, &twin->resource, &base->resource);
	if (twin->plant.image.program)
		at = put_resource(at, &twin->plant, &base->plant);
	at = put(at, twin->resource.image.memory, base->resource.image.memory,
		 memory_of(twin));
	return (size_t)(at - to);
}

void keep_get(struct twin *twin, const struct twin *base, const uint8_t *from)
{
	struct times now;
	const struct times then = { base->now_ns, base->period_ns, base->scan };

	from = get(from, &now, &then, sizeof(now));
	from = get_resource(from, &twin->resource, &base->resource);
	if (twin->plant.image.program)
		from = get_resource(from, &twin->plant, &base->plant);
	get(from, twin->resource.image.memory, base->resource.image.memory,
	    memory_of(twin));
	twin->now_ns = now.now_ns;
	twin->period_ns = now.period_ns;
	twin->scan = now.scan;
}
