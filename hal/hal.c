/* SPDX-License-Identifier: MIT
 *
 * hal - moves levels between requests and the process image in each scan. hal_open.c
 * allocates and opens.
 */
#include "hal/channels.h"
#include "hal/request.h"

#include <string.h>

static void request_failed(struct hal *hal, struct hal_request *request)
{
	hal->failed++;
	request->dirty = true;
	if (request->failures < HAL_FAILURES)
		request->failures++;
}

static void request_worked(struct hal_request *request)
{
	request->failures = 0;
}

bool request_in_fault(const struct hal_request *request)
{
	return request->failures >= HAL_FAILURES;
}

uint64_t request_safe(const struct hal_request *request)
{
	return (request->safe & ~request->hold) | (request->value & request->hold);
}

static enum hal_quality quality_of(const struct hal_request *request)
{
	if (request_in_fault(request))
		return QUALITY_FAULT;
	return request->failures ? QUALITY_STALE : QUALITY_GOOD;
}

enum hal_quality hal_quality(const struct hal *hal)
{
	enum hal_quality worst = QUALITY_GOOD;

	for (uint32_t i = 0; i < hal->request_count; i++)
		if (quality_of(&hal->request[i]) > worst)
			worst = quality_of(&hal->request[i]);
	return worst;
}

/* A line changes its value when the level has differed for its debounce time. */
static uint64_t debounce(struct hal_request *request, uint64_t level,
			 int64_t now_ns)
{
	uint64_t changed = (level ^ request->value) & request->debounced;

	request->differs &= changed;
	for (uint32_t i = 0; changed >> i; i++) {
		uint64_t mask = UINT64_C(1) << i;
		int64_t wait_ns = request->ask.line[i].point->debounce_ns;

		if (changed & mask && !(request->differs & mask)) {
			request->differs |= mask;
			request->differs_ns[i] = now_ns;
		}
		if (changed & mask && now_ns - request->differs_ns[i] < wait_ns)
			level ^= mask;
		else
			request->differs &= ~mask;
		if (i == REQUEST_LINES - 1)
			break;
	}
	return level;
}

static void scatter(const struct hal_request *request, uint8_t *area)
{
	for (uint32_t i = 0; i < request->ask.count; i++) {
		const struct hal_bit *bit = &request->bit[i];

		if (request->value >> i & 1)
			area[bit->byte] |= bit->mask;
		else
			area[bit->byte] &= (uint8_t)~bit->mask;
	}
}

static uint64_t gather(const struct hal_request *request, const uint8_t *area)
{
	uint64_t value = request->kept;

	for (uint32_t i = 0; i < request->ask.count; i++) {
		const struct hal_bit *bit = &request->bit[i];

		value |= (uint64_t)!!(area[bit->byte] & bit->mask) << i;
	}
	return value;
}

static void read_request(struct hal *hal, struct hal_request *request,
			 int64_t now_ns)
{
	uint64_t level;

	if (request->ask.driver->read(&request->ask, &level) < 0) {
		request_failed(hal, request);
		return;
	}
	request_worked(request);
	level = request_levels(request, level);
	request->value = request->debounced ?
			 debounce(request, level, now_ns) : level;
}

bool ReadPhysicalInputs(struct hal *hal, struct image *image, int64_t now_ns)
{
	uint8_t *area = image_area(image, AREA_I);
	bool good = true;

	for (uint32_t i = 0; i < hal->request_count; i++) {
		struct hal_request *request = &hal->request[i];

		if (!request->ask.output) {
			if (!request_in_fault(request))
				read_request(hal, request, now_ns);
			scatter(request, area);
		}
		good = good && !request_in_fault(request);
	}
	channels_tell_lines(hal_channels(hal), hal_quality(hal));
	channels_read(hal_channels(hal), image, now_ns);
	return good;
}

static void trace_changes(const struct hal *hal,
			  const struct hal_request *request, uint64_t value)
{
	uint64_t changed = value ^ request->value;

	for (uint32_t i = 0; i < request->ask.count; i++)
		if (changed >> i & 1)
			hal->trace(hal->trace_context,
				   request->ask.line[i].point, value >> i & 1);
}

static bool write_request(struct hal *hal, struct hal_request *request,
			  uint64_t value)
{
	if (hal->holds && (value ^ request->value) & request->hold)
		hal->holds(hal, request, value);
	if (request->ask.driver->write(&request->ask,
				       request_levels(request, value)) < 0) {
		request_failed(hal, request);
		return false;
	}
	request_worked(request);
	if (hal->trace)
		trace_changes(hal, request, value);
	request->value = value;
	request->dirty = false;
	return true;
}

/* The first call after opening only starts the refresh time: the line has its safe value. */
static bool must_write(struct hal_request *request, uint64_t value,
		       int64_t now_ns)
{
	if (!request->written) {
		request->written = true;
		request->written_ns = now_ns;
	}
	return request->dirty || value != request->value ||
	       now_ns - request->written_ns >= HAL_REFRESH_NS;
}

bool WritePhysicalOutputs(struct hal *hal, struct image *image, int64_t now_ns)
{
	const uint8_t *area = image_area(image, AREA_Q);
	bool good = true;

	for (uint32_t i = 0; i < hal->request_count; i++) {
		struct hal_request *request = &hal->request[i];

		if (request->ask.output && !request_in_fault(request) &&
		    !hal->held) {
			uint64_t value = gather(request, area);

			if (must_write(request, value, now_ns) &&
			    write_request(hal, request, value))
				request->written_ns = now_ns;
		}
		good = good && !request_in_fault(request);
	}
	if (!hal->held)
		channels_write(hal_channels(hal), image, now_ns);
	return good;
}

/* Also writes requests in fault. They stay in fault until hal_reopen(), so that a line
 * with a loose contact does not come back by itself. */
bool hal_write_safe(struct hal *hal)
{
	bool good = true;

	hal->held = 1;
	for (uint32_t i = 0; i < hal->request_count; i++) {
		struct hal_request *request = &hal->request[i];
		bool fault = request_in_fault(request);

		if (!request->ask.output || !request->is_open)
			continue;
		if (!write_request(hal, request, request_safe(request)))
			good = false;
		if (fault)
			request->failures = HAL_FAILURES;
	}
	channels_safe(hal_channels(hal));
	return good;
}

/* The twin has the same lines in the same order. */
static void take_over(struct hal_request *to, struct hal_request *from)
{
	memcpy(to->ask.state, from->ask.state, from->ask.driver->state_size);
	memcpy(to->differs_ns, from->differs_ns, sizeof(int64_t) * from->ask.count);
	to->differs = from->differs;
	to->value = from->value ^ from->invert ^ to->invert;
	to->kept = request_safe(to) & to->idle;
	to->written_ns = from->written_ns;
	to->written = from->written;
	to->dirty = from->dirty;
	to->failures = from->failures;
	to->is_open = from->is_open;
	from->is_open = false;
}

/* Lines that the other map does not have get their safe values; the others keep their levels. */
static void leave(struct hal *hal, struct hal_request *request)
{
	const struct hal_request *twin = request->twin;
	const uint64_t goes = twin ? twin->idle & ~request->idle : UINT64_MAX;
	const uint64_t value = (request->value & ~goes) | (request_safe(request) & goes);
	const uint8_t failures = request->failures;

	if (!request->ask.output || !request->is_open || !goes)
		return;
	if (value != request->value || request->dirty)
		write_request(hal, request, value);
	if (failures >= HAL_FAILURES)
		request->failures = failures;
}

void hal_exchange(struct hal *hal, struct hal *other)
{
	const struct hal before = *hal;

	for (uint32_t i = 0; i < hal->request_count; i++) {
		struct hal_request *request = &hal->request[i];

		leave(hal, request);
		if (request->twin)
			take_over(request->twin, request);
	}
	/* A handler that stops a crash finds no request, or those of one map. */
	*(volatile uint32_t *)&hal->request_count = 0;
	hal->map = other->map;
	*(struct hal_request *volatile *)&hal->request = other->request;
	*(volatile uint32_t *)&hal->request_count = other->request_count;
	other->map = before.map;
	other->request = before.request;
	other->request_count = before.request_count;
	hal_exchange_channels(hal, other);
	if (hal->held)
		hal_write_safe(hal);
}

void hal_release(struct hal *hal)
{
	channels_release(hal_channels(hal));
	hal->held = 0;
}

struct request *hal_find(struct hal *hal, struct iec_addr addr, uint32_t *line)
{
	for (uint32_t i = 0; i < hal->request_count; i++) {
		struct request *ask = &hal->request[i].ask;

		for (uint32_t k = 0; k < ask->count; k++) {
			struct iec_addr at = ask->line[k].point->addr;

			if (hal->request[i].bit[k].mask &&
			    at.area == addr.area && at.byte == addr.byte &&
			    at.bit == addr.bit) {
				*line = k;
				return ask;
			}
		}
	}
	return NULL;
}
