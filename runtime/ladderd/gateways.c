/* SPDX-License-Identifier: MIT
 *
 * gateways - a point belongs to the gateway of its driver; a module is a device of Modbus.
 */
#include "ladderd/gateways.h"

#include "engine/base/name.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

static bool serves(enum gateway_id gateway, const struct io_point *point)
{
	return gateway == GATEWAY_PEER ? point->driver == DRIVER_peer :
					 point->driver == DRIVER_modbus || point->driver == DRIVER_module;
}

/* Bits of a point, from the start of its area. */
static uint32_t first_bit(const struct io_point *point)
{
	return 8 * point->addr.byte + (point->addr.bits == 1 ? point->addr.bit : 0);
}

static void forget(struct gateways *gateways)
{
	free(gateways->order);
	for (int i = 0; i < GATEWAY_COUNT; i++) {
		free(gateways->outputs[i].point);
		free(gateways->outputs[i].given);
	}
	memset(gateways, 0, sizeof(*gateways));
}

static bool find_outputs(struct gateway_outputs *outputs, const struct iomap *map, int asks,
			 enum gateway_id gateway)
{
	const size_t room = (size_t)map->count + (size_t)asks + 1;

	outputs->point = calloc(room, sizeof(*outputs->point));
	outputs->given = calloc(room, sizeof(*outputs->given));
	if (!outputs->point || !outputs->given)
		return false;
	for (int i = 0; i < map->count; i++)
		if (map->point[i].output && serves(gateway, &map->point[i]))
			outputs->point[outputs->count++] = (uint32_t)i;
	/* Behind all values that a request may write. */
	for (int i = 0; i < asks && gateway == GATEWAY_MODBUS; i++)
		outputs->point[outputs->count++] = (uint32_t)(map->count + i);
	return true;
}

static bool is_before(const struct io_point *a, const struct io_point *b)
{
	return a->addr.area < b->addr.area || (a->addr.area == b->addr.area && first_bit(a) < first_bit(b));
}

static void sift(const struct iomap *map, uint32_t *order, uint32_t top, uint32_t count)
{
	for (uint32_t child = 2 * top + 1; child < count; child = 2 * top + 1) {
		const uint32_t here = order[top];

		if (child + 1 < count && is_before(&map->point[order[child]], &map->point[order[child + 1]]))
			child++;
		if (!is_before(&map->point[here], &map->point[order[child]]))
			return;
		order[top] = order[child];
		order[child] = here;
		top = child;
	}
}

/* A heap: the comparison of qsort() has no argument for the map. */
static bool find_order(struct gateways *gateways, const struct iomap *map)
{
	const uint32_t count = (uint32_t)map->count;
	uint32_t *order = calloc(count + 1, sizeof(*order));

	gateways->order = order;
	if (!order)
		return false;
	for (uint32_t i = 0; i < count; i++)
		order[i] = i;
	for (uint32_t i = count / 2; i-- > 0;)
		sift(map, order, i, count);
	for (uint32_t left = count; left-- > 1;) {
		const uint32_t last = order[left];

		order[left] = order[0];
		order[0] = last;
		sift(map, order, 0, left);
	}
	return true;
}

void gateways_use(struct gateways *gateways, const struct iomap *map, struct channels *channels,
		  struct asks *asks)
{
	forget(gateways);
	if (!find_order(gateways, map)) {
		forget(gateways);
		return;
	}
	for (int i = 0; i < GATEWAY_COUNT; i++)
		if (!find_outputs(&gateways->outputs[i], map, asks ? asks->count : 0, (enum gateway_id)i)) {
			forget(gateways);
			return;
		}
	gateways->map = map;
	gateways->channels = channels;
	gateways->asks = asks;
	for (int i = 0; i < map->count; i++)
		for (int k = 0; k < GATEWAY_COUNT; k++)
			gateways->points[k] += serves((enum gateway_id)k, &map->point[i]);
}

void gateways_free(struct gateways *gateways)
{
	forget(gateways);
}

/* ---- as in struct server_io ---- */

static uint32_t count_points(void *context, enum gateway_id gateway)
{
	return ((struct gateways *)context)->points[gateway];
}

/* The request with the number of a point; NULL: it is a point of the map, or none. */
static struct ask *find_ask(const struct gateways *gateways, uint32_t point)
{
	const uint32_t first = (uint32_t)gateways->map->count;

	return gateways->asks && point >= first && point - first < (uint32_t)gateways->asks->count ?
	       &gateways->asks->ask[point - first] : NULL;
}

static bool find_point(void *context, enum gateway_id gateway, uint32_t point, struct server_point *out)
{
	const struct iomap *map = ((struct gateways *)context)->map;
	const struct io_point *found;

	if (map && gateway == GATEWAY_MODBUS && find_ask(context, point)) {
		*out = (struct server_point){ .output = false, .raw = IEC_UDINT };
		return true;
	}
	if (!map || point >= (uint32_t)map->count)
		return false;
	found = &map->point[point];
	if (!serves(gateway, found) || !found->channel)
		return false;
	*out = (struct server_point){ .output = found->output, .raw = found->channel->raw };
	return true;
}

static void put_value(void *context, uint32_t point, union iec_value value, bool good)
{
	struct ask *ask = find_ask(context, point);
	struct timespec now;

	if (ask) {
		atomic_store_explicit(&ask->answer, (uint32_t)value.i, memory_order_release);
		return;
	}
	clock_gettime(CLOCK_MONOTONIC, &now);
	channels_put(((struct gateways *)context)->channels, (int)point, value, good,
		     now.tv_sec * INT64_C(1000000000) + now.tv_nsec);
}

static void get_output(const struct gateways *gateways, uint32_t point, struct server_output *out)
{
	struct ask *ask = find_ask(gateways, point);

	out->point = point;
	if (ask) {
		out->raw = IEC_UDINT;
		out->value.i = atomic_load_explicit(&ask->asked, memory_order_acquire);
		out->serial = (uint32_t)out->value.i + 1; /* a number is 0 only if none waits */
		return;
	}
	out->raw = gateways->map->point[point].channel->raw;
	out->value = channels_get(gateways->channels, (int)point, &out->serial);
}

static bool next_output(void *context, enum gateway_id gateway, struct server_output *out)
{
	struct gateways *gateways = context;
	struct gateway_outputs *outputs = &gateways->outputs[gateway];

	while (outputs->next < outputs->count) {
		const uint32_t i = outputs->next++, point = outputs->point[i];

		get_output(gateways, point, out);
		if (!out->serial || out->serial == outputs->given[i])
			continue;
		outputs->given[i] = out->serial;
		return true;
	}
	outputs->next = 0;
	return false;
}

static uint32_t count_outputs(void *context, enum gateway_id gateway)
{
	return ((struct gateways *)context)->outputs[gateway].count;
}

static void give_again(void *context, enum gateway_id gateway)
{
	struct gateway_outputs *outputs = &((struct gateways *)context)->outputs[gateway];

	outputs->next = 0;
	if (outputs->count)
		memset(outputs->given, 0, outputs->count * sizeof(*outputs->given));
}

static void leave_alone(void *context, enum gateway_id gateway)
{
	struct channels *channels = ((struct gateways *)context)->channels;

	if (gateway == GATEWAY_PEER) {
		channels_alone(channels, DRIVER_peer);
		return;
	}
	channels_alone(channels, DRIVER_modbus);
	channels_alone(channels, DRIVER_module);
}

static bool find_window(void *context, uint32_t number, struct server_window *out)
{
	const struct iomap *map = ((struct gateways *)context)->map;
	const struct io_net *net = map ? map->net : NULL;

	if (!net || number >= (uint32_t)net->window_count)
		return false;
	*out = (struct server_window){
		.addr = net->window[number].addr, .count = net->window[number].count,
		.writable = net->window[number].writable,
	};
	return true;
}

static uint8_t flags_of(enum hal_quality quality)
{
	return quality == QUALITY_GOOD ? 0 : quality == QUALITY_STALE ? VALUE_STALE : VALUE_STALE | VALUE_FAULT;
}

static bool lines_bad(const struct gateways *gateways, bool io_bad)
{
	return io_bad && (!gateways->channels || channels_lines(gateways->channels) != QUALITY_GOOD);
}

static uint8_t point_flags(const struct gateways *gateways, uint32_t point, bool io_bad)
{
	return gateways->map->point[point].channel ? flags_of(channels_point(gateways->channels, (int)point)) :
	       lines_bad(gateways, io_bad) ? VALUE_STALE : 0;
}

/* Points of a map do not overlap. */
static uint8_t find_quality(void *context, enum iec_area area, uint32_t bit, uint32_t count, bool io_bad)
{
	const struct gateways *gateways = context;
	const struct iomap *map = gateways->map;
	uint32_t low = 0, high = map ? (uint32_t)map->count : 0;
	uint8_t flags = 0;

	while (low < high) {
		const uint32_t middle = (low + high) / 2;
		const struct io_point *point = &map->point[gateways->order[middle]];

		if (point->addr.area < area || (point->addr.area == area && first_bit(point) + point->addr.bits <= bit))
			low = middle + 1;
		else
			high = middle;
	}
	for (; map && low < (uint32_t)map->count; low++) {
		const struct io_point *point = &map->point[gateways->order[low]];

		if (point->addr.area != area || first_bit(point) >= bit + count)
			break;
		flags |= point_flags(gateways, gateways->order[low], io_bad);
	}
	return flags;
}

static bool find_value(void *context, uint32_t point, struct server_value *out)
{
	const struct gateways *gateways = context;
	const struct iomap *map = gateways->map;

	if (!map || point >= (uint32_t)map->count)
		return false;
	*out = (struct server_value){
		.addr = map->point[point].addr, .counts = map->point[point].channel != NULL,
		.flags = point_flags(gateways, point, false),
	};
	return true;
}

static bool is_published(void *context, const char *name, size_t len)
{
	const struct iomap *map = ((struct gateways *)context)->map;
	const struct io_net *net = map ? map->net : NULL;

	for (int i = 0; net && i < net->publish_count; i++)
		for (int k = 0; k < net->publish[i].count; k++)
			if (name_is(net->publish[i].name[k], name, len))
				return true;
	return false;
}

struct server_io gateways_io(struct gateways *gateways)
{
	return (struct server_io){
		.context = gateways, .points = count_points, .point = find_point, .put = put_value,
		.output = next_output, .outputs = count_outputs, .again = give_again, .alone = leave_alone, .window = find_window,
		.quality = find_quality, .value = find_value,
		.publishes = is_published,
	};
}
