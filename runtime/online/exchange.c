/* SPDX-License-Identifier: MIT
 *
 * exchange - the scan thread's part is at the top, and only that part may touch the resource.
 */
#include "online/exchange.h"

#include <string.h>

#define FRESH 4u /* the link has not seen the buffer in `middle` yet */

void exchange_init(struct exchange *exchange, const struct exchange_host *host,
		   uint8_t *memory, size_t size)
{
	memset(exchange, 0, sizeof(*exchange));
	exchange->host = host;
	for (size_t i = 0; i < 3; i++)
		exchange->view[i].memory = memory + i * size;
	exchange->back = 1;
	atomic_init(&exchange->middle, 2);
	atomic_init(&exchange->order, NULL);
}

/* The scan thread touches no view while nothing is watched. */
void exchange_renew(struct exchange *exchange, uint8_t *memory, size_t size)
{
	for (size_t i = 0; i < 3; i++)
		exchange->view[i].memory = memory + i * size;
}

/* ---- the scan thread ---- */

static void copy_ranges(const struct watch *watch, struct view *view,
			const struct resource *resource)
{
	for (uint32_t i = 0; i < watch->count; i++)
		memcpy(view->memory + watch->range[i].at,
		       resource->image.memory + watch->range[i].at,
		       watch->range[i].size);
	view->scan = resource->scans;
	view->now_ns = resource->vm.now_ns;
	view->state = resource->state;
	view->io_bad = resource->io_fault;
	view->forces = resource->image.force_count;
	view->serial = watch->serial;
}

/* Nothing is written unless all of it can be. */
static enum refusal check_items(const struct image *image, struct order *order)
{
	for (order->wrong = 0; order->wrong < order->count; order->wrong++) {
		const struct location at = order->item[order->wrong].at;

		if (at.constant)
			return REFUSAL_CONSTANT;
		if (order->kind == ORDER_FORCE && at.type == IEC_STRING)
			return REFUSAL_NO_FORCE;
		if (order->kind == ORDER_UNFORCE && !image_is_forced(image, at))
			return REFUSAL_NOT_FORCED;
	}
	return REFUSAL_NONE;
}

static void record(const struct exchange *exchange, const struct resource *resource,
		   enum record_kind kind, struct location at, union iec_value value)
{
	if (exchange->recorder)
		recorder_change(exchange->recorder, resource, kind, at, value);
}

static void write_items(const struct exchange *exchange, struct resource *resource,
			const struct order *order)
{
	for (uint32_t i = 0; i < order->count; i++) {
		const struct order_item *item = &order->item[i];

		record(exchange, resource, RECORD_WRITE, item->at, item->value);
		image_set(&resource->image, item->at, item->value);
	}
}

static uint32_t new_forces(const struct image *image, const struct order *order)
{
	uint32_t count = 0;

	for (uint32_t i = 0; i < order->count; i++)
		count += !image_is_forced(image, order->item[i].at);
	return count;
}

static enum refusal force_items(const struct exchange *exchange, struct resource *resource,
				const struct order *order)
{
	struct image *image = &resource->image;

	if (new_forces(image, order) > LIMIT_FORCES - (uint32_t)image->force_count)
		return REFUSAL_TOO_MANY;
	for (uint32_t i = 0; i < order->count; i++) {
		const struct order_item *item = &order->item[i];

		record(exchange, resource, RECORD_FORCE, item->at, item->value);
		image_force(image, item->at, item->value);
	}
	return REFUSAL_NONE;
}

static void release(const struct exchange *exchange, struct resource *resource, struct location at)
{
	record(exchange, resource, RECORD_UNFORCE, at, (union iec_value){ .i = 0 });
	image_unforce(&resource->image, at);
}

static void unforce_items(const struct exchange *exchange, struct resource *resource,
			  const struct order *order)
{
	const struct image *image = &resource->image;

	for (uint32_t i = 0; i < order->count; i++)
		release(exchange, resource, order->item[i].at);
	while (!order->count && image->force_count)
		release(exchange, resource, image->force[image->force_count - 1].at);
}

static enum refusal change_items(const struct exchange *exchange, struct resource *resource,
				 struct order *order)
{
	enum refusal refusal = check_items(&resource->image, order);

	if (refusal != REFUSAL_NONE)
		return refusal;
	if (order->kind == ORDER_WRITE)
		write_items(exchange, resource, order);
	else if (order->kind == ORDER_FORCE)
		refusal = force_items(exchange, resource, order);
	else
		unforce_items(exchange, resource, order);
	if (exchange->recorder)
		recorder_changed(exchange->recorder, resource);
	return refusal;
}

static enum refusal take_record(const struct exchange *exchange, struct recorder_part *part)
{
	if (!exchange->recorder)
		return REFUSAL_NO_RECORD;
	recorder_take(exchange->recorder, part);
	return part->end ? REFUSAL_NONE : REFUSAL_RECORD_SMALL;
}

static bool is_expected(const struct exchange *exchange, const struct order *order,
			const struct resource *resource)
{
	const struct exchange_host *host = exchange->host;

	if (!order->expects)
		return true;
	if (order->expect.mode != EXPECT_ANY && order->expect.mode != resource->state)
		return false;
	return memcmp(order->expect.program, host->identity(host->context), 32) == 0;
}

void exchange_forget(struct exchange *exchange)
{
	exchange->watch = (struct watch){ .serial = exchange->watch.serial };
}

static enum refusal do_order(struct exchange *exchange, struct order *order)
{
	const struct exchange_host *host = exchange->host;
	struct resource *resource = host->resource(host->context);
	const struct image *image = &resource->image;

	order->scan = resource->scans;
	order->state = resource->state;
	if (!is_expected(exchange, order, resource))
		return REFUSAL_CONFLICT;
	/* It went back by itself, and the link does not know that yet. */
	if (order->program && order->program != image->program)
		return REFUSAL_BUSY;
	switch (order->kind) {
	case ORDER_LOOK:
		copy_ranges(order->watch, order->view, resource);
		break;
	case ORDER_WATCH:
		exchange->watch = *order->watch;
		resource->watch = order->watch->power;
		break;
	case ORDER_WRITE: case ORDER_FORCE: case ORDER_UNFORCE:
		return change_items(exchange, resource, order);
	case ORDER_FORCES:
		order->forces->force_count = image->force_count;
		memcpy(order->forces->force, image->force, sizeof(image->force));
		break;
	case ORDER_MODE:
		return host->mode(host->context, order->mode);
	case ORDER_STATUS:
		host->status(host->context, order->status);
		break;
	case ORDER_SWAP:
		exchange_forget(exchange);
		return host->swap(host->context, order->other, order->back);
	case ORDER_RESTART:
		host->restart(host->context, order->mode == MODE_STOP);
		break;
	case ORDER_RETAIN:
		retain_copy(order->retain.plan, image, order->retain.copy);
		order->retain.clock_ns = resource->vm.now_ns;
		break;
	case ORDER_RESTORE:
		return resource->state == STATE_STOP ?
			       host->restore(host->context, &order->retain) : REFUSAL_NOT_NOW;
	case ORDER_ACT:
		order->act(host->context, order->other);
		break;
	case ORDER_RECORD:
		return take_record(exchange, order->part);
	case ORDER_COUNT:
		break;
	}
	return REFUSAL_NONE;
}

static void show_state(struct exchange *exchange)
{
	const struct exchange_host *host = exchange->host;

	atomic_store_explicit(&exchange->state, (int)host->resource(host->context)->state,
			      memory_order_relaxed);
}

void exchange_serve(struct exchange *exchange)
{
	struct order *order;

	if (exchange->done >= EXCHANGE_ORDERS)
		return;
	order = atomic_load_explicit(&exchange->order, memory_order_acquire);
	if (!order)
		return;
	exchange->done++;
	order->refusal = do_order(exchange, order);
	show_state(exchange);
	atomic_store_explicit(&exchange->order, NULL, memory_order_release);
}

void exchange_show(struct exchange *exchange, int64_t now_ns)
{
	const struct exchange_host *host = exchange->host;
	struct view *view = &exchange->view[exchange->back];

	exchange->done = 0;
	show_state(exchange);
	if (!exchange->watch.count)
		return;
	copy_ranges(&exchange->watch, view, host->resource(host->context));
	view->now_ns = now_ns;
	exchange->back = atomic_exchange(&exchange->middle, exchange->back | FRESH) & ~FRESH;
}

/* ---- the link thread ---- */

void exchange_post(struct exchange *exchange, struct order *order)
{
	atomic_store_explicit(&exchange->order, order, memory_order_release);
}

bool exchange_is_done(const struct exchange *exchange)
{
	return !atomic_load_explicit(&exchange->order, memory_order_acquire);
}

const struct view *exchange_newest(struct exchange *exchange)
{
	if (atomic_load(&exchange->middle) & FRESH)
		exchange->front = atomic_exchange(&exchange->middle, exchange->front) & ~FRESH;
	return &exchange->view[exchange->front];
}
