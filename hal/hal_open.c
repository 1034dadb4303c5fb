/* SPDX-License-Identifier: MIT
 *
 * hal_open - finds the lines of a map, groups them into requests and opens these, before the
 * first scan or while no program runs.
 */
#include "hal/request.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const struct driver *driver_row(enum driver_id id)
{
	static const struct driver *const rows[DRIVER_COUNT] = {
#define DRIVER(id) &driver_##id,
#include "hal/drivers.def"
	};

	return rows[id];
}

bool trouble_set(struct trouble *why, enum diag_id id, const char *format, ...)
{
	va_list args;

	why->id = id;
	why->line = 0;
	va_start(args, format);
	vsnprintf(why->text, sizeof(why->text), format, args);
	va_end(args);
	return false;
}

bool hal_supported(const struct iomap *map, struct diag_list *diags)
{
	bool good = true;

	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];
		const struct driver *driver = driver_row(point->driver);

		if (!driver->open)
			good = diag_add(diags, io_place(map, point,
				DIAG_IO_NO_DRIVER), "%s", driver->word);
	}
	return good;
}

static bool find_line(const struct iomap *map, const struct io_point *point,
		      struct line_at *place, struct diag_list *diags)
{
	const struct driver *driver = driver_row(point->driver);
	struct trouble why;

	*place = (struct line_at){ -1, 0 };
	if (!driver->find || driver->find(point, map->dev, place, &why))
		return true;
	place->chip = -1;
	return diag_add(diags, io_place(map, point, why.id), "%s", why.text);
}

/* Finds lines that the map names twice in different ways. */
static bool check_places(const struct iomap *map, const struct line_at *place,
			 struct diag_list *diags)
{
	bool good = true;
	char name[LIMIT_ARG], first[24];

	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];

		for (int k = 0; k < i && place[i].chip >= 0; k++) {
			if (place[i].chip != place[k].chip ||
			    place[i].offset != place[k].offset ||
			    map->point[k].driver != point->driver)
				continue;
			io_line_print(point, name, sizeof(name));
			iec_addr_print(map->point[k].addr, first, sizeof(first));
			good = diag_add(diags, io_place(map, point,
				map->point[k].output == point->output ?
				DIAG_IO_LINE_TWICE : DIAG_IO_BOTH_WAYS),
				"%s" DIAG_AND "%s", name, first);
			break;
		}
	}
	return good;
}

static bool no_memory(const struct iomap *map, struct diag_list *diags)
{
	return diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY,
					      .file = map->file }, "%s", "");
}

/* The places of all points; NULL and errors if one is missing. */
static struct line_at *find_all(const struct iomap *map, struct arena *arena,
			      struct diag_list *diags)
{
	struct line_at *place;
	bool good;

	if (!hal_supported(map, diags))
		return NULL;
	place = arena_alloc(arena, sizeof(*place) * (size_t)map->count);
	if (!place) {
		no_memory(map, diags);
		return NULL;
	}
	good = true;
	for (int i = 0; i < map->count; i++)
		if (!find_line(map, &map->point[i], &place[i], diags))
			good = false;
	return check_places(map, place, diags) && good ? place : NULL;
}

bool hal_check(const struct iomap *map, struct arena *scratch,
	       struct diag_list *diags)
{
	return find_all(map, scratch, diags) != NULL;
}

static bool same_request(const struct io_point *a, const struct line_at *at_a,
			 const struct io_point *b, const struct line_at *at_b)
{
	return a->driver == b->driver && a->output == b->output &&
	       at_a->chip == at_b->chip &&
	       (!driver_row(a->driver)->same_flags ||
		(a->bias == b->bias && a->drive == b->drive));
}

/* Sets the request number of each point, inputs first. Returns the number of requests. */
static uint32_t group(const struct iomap *map, const struct line_at *place,
		      uint32_t *number)
{
	uint32_t count = 0;

	for (int pass = 0; pass < 2; pass++) {
		for (int i = 0; i < map->count; i++) {
			const struct io_point *point = &map->point[i];
			uint32_t found = count, lines = 0;

			if (point->output != (pass == 1))
				continue;
			for (int k = i - 1; k >= 0 && found == count; k--)
				if (same_request(point, &place[i],
						 &map->point[k], &place[k]))
					found = number[k];
			for (int k = 0; k < i && found < count; k++)
				lines += map->point[k].output ==
					 point->output && number[k] == found;
			if (lines >= REQUEST_LINES)
				found = count;
			number[i] = found;
			if (found == count)
				count++;
		}
	}
	return count;
}

static void add_line(struct hal_request *request, const struct io_point *point,
		     struct line_at place)
{
	uint32_t i = request->ask.count++;
	uint64_t mask = UINT64_C(1) << i;

	request->ask.line[i] = (struct request_line){ point, place };
	request->bit[i].byte = (uint16_t)point->addr.byte;
	request->bit[i].mask = (uint8_t)(1u << point->addr.bit);
	if (point->active_low)
		request->invert |= mask;
	if (point->safe)
		request->safe |= mask;
	if (point->debounce_ns > 0)
		request->debounced |= mask;
}

static bool make_request(struct hal_request *request, struct arena *arena,
			 const struct io_point *point, const char *dev,
			 uint32_t lines)
{
	const struct driver *driver = driver_row(point->driver);
	struct request *ask = &request->ask;

	ask->driver = driver;
	ask->dev = dev;
	ask->output = point->output;
	ask->state = arena_alloc(arena, driver->state_size);
	ask->line = arena_alloc(arena, sizeof(*ask->line) * lines);
	request->bit = arena_alloc(arena, sizeof(*request->bit) * lines);
	request->differs_ns = arena_alloc(arena, sizeof(int64_t) * lines);
	return !arena->failed;
}

static uint32_t count_lines(const struct iomap *map, const uint32_t *number,
			    uint32_t request)
{
	uint32_t lines = 0;

	for (int i = 0; i < map->count; i++)
		lines += number[i] == request;
	return lines;
}

static bool make_requests(struct hal *hal, struct arena *arena,
			  const struct line_at *place)
{
	const struct iomap *map = hal->map;
	uint32_t *number = arena_alloc(arena,
				       sizeof(*number) * (size_t)map->count);

	if (!number)
		return false;
	hal->request_count = group(map, place, number);
	hal->request = arena_alloc(arena, sizeof(*hal->request) *
				   hal->request_count);
	for (int i = 0; i < map->count && !arena->failed; i++) {
		struct hal_request *request = &hal->request[number[i]];

		if (!request->ask.driver &&
		    !make_request(request, arena, &map->point[i], map->dev,
				  count_lines(map, number, number[i])))
			break;
		add_line(request, &map->point[i], place[i]);
	}
	return !arena->failed;
}

size_t hal_memory(const struct iomap *map)
{
	size_t bytes = 0;

	for (int i = 0; i < map->count; i++)
		bytes += driver_row(map->point[i].driver)->state_size +
			 sizeof(struct line_at) + sizeof(uint32_t) +
			 sizeof(struct hal_request) +
			 sizeof(struct request_line) +
			 sizeof(struct hal_bit) + sizeof(int64_t) +
			 8 * sizeof(void *); /* seven roundings */
	return bytes;
}

static bool refuse(const struct hal *hal, const struct hal_request *request,
		   const struct trouble *why, struct diag_list *diags)
{
	const struct io_point *point = request->ask.line[why->line].point;
	char name[LIMIT_ARG];

	if (!diags)
		return false;
	io_line_print(point, name, sizeof(name));
	return diag_add(diags, io_place(hal->map, point, why->id), "%s" DIAG_AND "%s",
			name, why->text);
}

/* The first value of an input has no debounce. */
static bool first_read(struct hal_request *request, struct trouble *why)
{
	uint64_t level;
	int result = request->ask.driver->read(&request->ask, &level);

	if (result < 0)
		return trouble_set(why, DIAG_IO_SILENT, "%s",
				   strerror(-result));
	request->value = level ^ request->invert;
	request->differs = 0;
	return true;
}

static bool open_request(const struct hal *hal, struct hal_request *request,
			 struct diag_list *diags)
{
	struct trouble why;

	request->ask.first = request->safe ^ request->invert;
	if (!request->ask.driver->open(&request->ask, &why))
		return refuse(hal, request, &why, diags);
	request->is_open = true;
	if (!request->ask.output && !first_read(request, &why))
		return refuse(hal, request, &why, diags);
	if (request->ask.output)
		request->value = request->safe;
	request->written = false;
	request->dirty = false;
	request->failures = 0;
	return true;
}

static void close_request(struct hal_request *request)
{
	if (request->is_open)
		request->ask.driver->close(&request->ask);
	request->is_open = false;
}

bool hal_open(struct hal *hal, const struct iomap *map, struct arena *arena,
	      struct diag_list *diags)
{
	size_t before = arena->used;
	const struct line_at *place;

	*hal = (struct hal){ .map = map };
	place = find_all(map, arena, diags);
	if (!place)
		return false;
	if (!make_requests(hal, arena, place)) {
		hal->request_count = 0;
		return no_memory(map, diags);
	}
	for (uint32_t i = 0; i < hal->request_count; i++) {
		if (!open_request(hal, &hal->request[i], diags)) {
			hal_close(hal);
			return false;
		}
	}
	hal->bytes = arena->used - before;
	return true;
}

void hal_close(struct hal *hal)
{
	hal_write_safe(hal);
	for (uint32_t i = 0; i < hal->request_count; i++)
		close_request(&hal->request[i]);
	hal->request_count = 0;
}

/* Finds the lines of a request again; they must be on one chip. */
static bool find_again(const struct hal *hal, struct hal_request *request)
{
	struct request *ask = &request->ask;
	struct trouble why;

	for (uint32_t i = 0; ask->driver->find && i < ask->count; i++)
		if (!ask->driver->find(ask->line[i].point, hal->map->dev,
				       &ask->line[i].at, &why) ||
		    ask->line[i].at.chip != ask->line[0].at.chip)
			return false;
	return true;
}

bool hal_reopen(struct hal *hal)
{
	bool good = true;

	for (uint32_t i = 0; i < hal->request_count; i++) {
		struct hal_request *request = &hal->request[i];

		if (!request_in_fault(request))
			continue;
		close_request(request);
		if (find_again(hal, request) &&
		    open_request(hal, request, NULL)) {
			hal->reopened++;
		} else {
			close_request(request);
			request->failures = HAL_FAILURES;
			good = false;
		}
	}
	return good;
}

bool hal_list(const char *dev,
	      void (*visit)(void *context, const struct line_seen *line),
	      void *context, struct diag_list *diags)
{
	bool good = true;

	for (int id = 0; id < DRIVER_COUNT; id++) {
		const struct driver *driver = driver_row((enum driver_id)id);
		struct trouble why;

		if (!driver->open)
			good = diag_add(diags, (struct diag){
				.id = DIAG_IO_NO_DRIVER, .file = driver->word },
				"%s", driver->word);
		else if (driver->list &&
			 !driver->list(dev ? dev : "/dev", visit, context,
				       &why))
			good = diag_add(diags, (struct diag){
				.id = why.id, .file = dev ? dev : "/dev" },
				"%s", why.text);
	}
	return good;
}
