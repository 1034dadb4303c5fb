/* SPDX-License-Identifier: MIT
 *
 * hal_open - finds the lines of a map, groups them into requests and opens these, before the
 * first scan or while no program runs.
 */
#include "hal/channels.h"
#include "hal/ports.h"
#include "hal/request.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool hal_supported(const struct iomap *map, struct diag_list *diags)
{
	bool good = true;

	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];
		const struct driver *driver = driver_row(point->driver);

		if (driver->by_channel ? !channels_supported(point->driver) : !driver->open)
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
	bool good = hal_supported(map, diags);
	struct line_at *place = arena_alloc(arena, sizeof(*place) * (size_t)map->count);

	if (!place) {
		no_memory(map, diags);
		return NULL;
	}
	for (int i = 0; i < map->count; i++)
		if (!find_line(map, &map->point[i], &place[i], diags))
			good = false;
	return check_places(map, place, diags) && good ? place : NULL;
}

bool hal_check(const struct iomap *map, struct arena *scratch,
	       struct diag_list *diags)
{
	const bool good = find_all(map, scratch, diags) != NULL;
	struct channels *channels = NULL;

	if (!channels_plan(&channels, map, diags))
		return false;
	channels_close(channels);
	return good;
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

			if (io_has_channel(point))
				number[i] = UINT32_MAX;
			if (io_has_channel(point) || point->output != (pass == 1))
				continue;
			for (int k = i - 1; k >= 0 && found == count; k--)
				if (number[k] != UINT32_MAX &&
				    same_request(point, &place[i],
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
	if (point->hold)
		request->hold |= mask;
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

		if (io_has_channel(&map->point[i]))
			continue;
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
		bytes += io_has_channel(&map->point[i]) ? channels_memory() : driver_row(map->point[i].driver)->state_size +
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
	request->value = request_levels(request, level);
	request->differs = 0;
	return true;
}

static bool open_request(const struct hal *hal, struct hal_request *request,
			 struct diag_list *diags)
{
	struct trouble why;

	request->ask.first = request_levels(request, request_safe(request));
	if (!request->ask.driver->open(&request->ask, &why))
		return refuse(hal, request, &why, diags);
	request->is_open = true;
	if (!request->ask.output && !first_read(request, &why))
		return refuse(hal, request, &why, diags);
	if (request->ask.output)
		request->value = request_safe(request);
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

bool hal_plan(struct hal *hal, const struct iomap *map, struct arena *arena,
	      struct diag_list *diags)
{
	size_t before = arena->used;
	const struct line_at *place;

	struct channels *channels = NULL;
	bool good;

	*hal = (struct hal){ .map = map };
	place = find_all(map, arena, diags);
	good = channels_plan(&channels, map, diags);
	good = ports_check(map, NULL, diags) && good;
	if (!place || !good || !make_requests(hal, arena, place)) {
		hal->request_count = 0;
		channels_close(channels);
		return place && good && no_memory(map, diags);
	}
	hal_keep_channels(hal, channels);
	hal->bytes = arena->used - before;
	return true;
}

bool hal_open_planned(struct hal *hal, struct diag_list *diags)
{
	for (uint32_t i = 0; i < hal->request_count; i++) {
		if (!open_request(hal, &hal->request[i], diags)) {
			hal_close(hal);
			return false;
		}
	}
	if (channels_open(hal_channels(hal), diags))
		return true;
	hal_close(hal);
	return false;
}

bool hal_open(struct hal *hal, const struct iomap *map, struct arena *arena,
	      struct diag_list *diags)
{
	return hal_plan(hal, map, arena, diags) && hal_open_planned(hal, diags);
}

void hal_close(struct hal *hal)
{
	hal_write_safe(hal);
	for (uint32_t i = 0; i < hal->request_count; i++)
		close_request(&hal->request[i]);
	hal->request_count = 0;
	hal_close_channels(hal);
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

/* ---- another map beside it ---- */

/* A line that is open. */
struct open_line {
	struct hal_request *request;
	uint32_t line;
};

static bool same_text(const char *a, const char *b)
{
	return a && b ? strcmp(a, b) == 0 : a == b;
}

/* Whether two points name the same line in the same words. */
static bool same_words(const struct io_point *a, const struct io_point *b)
{
	if (a->driver != b->driver)
		return false;
	if (!driver_row(a->driver)->find)
		return a->addr.area == b->addr.area && a->addr.byte == b->addr.byte &&
		       a->addr.bit == b->addr.bit;
	return same_text(a->line, b->line) && same_text(a->chip, b->chip) &&
	       (!a->chip || a->offset == b->offset);
}

/* @at: the place of the point; NULL: compare the words. */
static struct open_line find_open(const struct hal *now, const struct io_point *point,
				  const struct line_at *at)
{
	for (uint32_t i = 0; i < now->request_count; i++) {
		struct hal_request *request = &now->request[i];

		for (uint32_t k = 0; k < request->ask.count; k++) {
			const struct request_line *line = &request->ask.line[k];

			if (at ? line->at.chip == at->chip && line->at.offset == at->offset &&
				 line->point->driver == point->driver :
				 same_words(line->point, point))
				return (struct open_line){ request, k };
		}
	}
	return (struct open_line){ NULL, 0 };
}

static bool find_beside(const struct hal *now, const struct io_point *point,
			struct line_at *place, struct open_line *open, struct trouble *why)
{
	const struct driver *driver = driver_row(point->driver);

	*open = find_open(now, point, NULL);
	*place = (struct line_at){ -1, 0 };
	if (open->request) {
		*place = open->request->ask.line[open->line].at;
		return true;
	}
	if (!driver->find || driver->find(point, now->map->dev, place, why))
		return true;
	if (why->id == DIAG_IO_BUSY)
		*open = find_open(now, point, place);
	return open->request;
}

static bool needs_request(const struct io_point *point, const struct open_line *open)
{
	const struct io_point *was = open->request->ask.line[open->line].point;

	return driver_row(point->driver)->find &&
	       (was->output != point->output || was->bias != point->bias ||
		was->drive != point->drive);
}

/* A copy for a line that no point of the new map has: the old map may go. */
static const struct io_point *keep_point(const struct io_point *point, struct arena *arena)
{
	struct io_point *copy = arena_alloc(arena, sizeof(*copy));

	if (!copy)
		return point;
	*copy = *point;
	if (copy->line)
		copy->line = arena_copy(arena, copy->line, strlen(copy->line));
	if (copy->chip)
		copy->chip = arena_copy(arena, copy->chip, strlen(copy->chip));
	return copy;
}

/* The request of the new map that takes over an open one. */
static bool make_twin(struct hal_request *twin, struct hal_request *open,
		      const struct iomap *map, const struct open_line *lines,
		      const char *dev, struct arena *arena)
{
	if (!make_request(twin, arena, open->ask.line[0].point, dev, open->ask.count))
		return false;
	for (uint32_t k = 0; k < open->ask.count; k++) {
		const struct io_point *point = NULL;

		for (int i = 0; i < map->count && !point; i++)
			if (lines[i].request == open && lines[i].line == k)
				point = &map->point[i];
		if (point) {
			add_line(twin, point, open->ask.line[k].at);
			continue;
		}
		twin->idle |= UINT64_C(1) << k;
		add_line(twin, keep_point(open->ask.line[k].point, arena), open->ask.line[k].at);
		twin->bit[k].mask = 0;
	}
	twin->debounced &= ~twin->idle;
	twin->twin = open;
	open->twin = twin;
	return !arena->failed;
}

static bool make_twins(struct hal *next, struct hal *now, const struct open_line *lines,
		       struct arena *arena)
{
	for (uint32_t r = 0; r < now->request_count; r++) {
		struct hal_request *open = &now->request[r];
		bool used = false;

		open->twin = NULL;
		for (int i = 0; i < next->map->count; i++)
			used = used || lines[i].request == open;
		if (used && !make_twin(&next->request[next->request_count++], open, next->map,
				       lines, now->map->dev, arena))
			return false;
	}
	return true;
}

/* Requests for lines that are not open; inputs first. */
static bool make_new(struct hal *next, const struct open_line *lines, const struct line_at *place,
		     const char *dev, struct arena *arena)
{
	const uint32_t first = next->request_count;
	const struct iomap *map = next->map;

	for (int i = 0; i < 2 * map->count; i++) {
		const int number = i % map->count;
		const struct io_point *point = &map->point[number];
		uint32_t r = first;

		if (io_has_channel(point) || lines[number].request || point->output != (i >= map->count))
			continue;
		while (r < next->request_count &&
		       (next->request[r].ask.count == REQUEST_LINES ||
			!same_request(point, &place[number], next->request[r].ask.line[0].point,
				      &next->request[r].ask.line[0].at)))
			r++;
		if (r == next->request_count) {
			if (!make_request(&next->request[r], arena, point, dev,
					  map->count < REQUEST_LINES ? (uint32_t)map->count :
								       REQUEST_LINES))
				return false;
			next->request_count++;
		}
		add_line(&next->request[r], point, place[number]);
	}
	return true;
}

enum hal_beside hal_beside(struct hal *next, struct hal *now, const struct iomap *map,
			   struct arena *arena, struct diag_list *diags, char *line)
{
	const size_t count = (size_t)map->count;
	struct line_at *place = arena_alloc(arena, sizeof(*place) * (count + 1));
	struct open_line *open = arena_alloc(arena, sizeof(*open) * (count + 1));
	enum hal_beside result = BESIDE_GOOD, of_channels;
	struct channels *channels = NULL;

	*next = (struct hal){ .map = map };
	if (!hal_supported(map, diags))
		return BESIDE_REFUSED;
	next->request = arena_alloc(arena, sizeof(*next->request) * (count + 1));
	if (!place || !open || !next->request)
		return no_memory(map, diags), BESIDE_REFUSED;
	for (int i = 0; i < map->count; i++) {
		struct trouble why;

		if (io_has_channel(&map->point[i])) {
			place[i].chip = -1;
			continue;
		}
		if (!find_beside(now, &map->point[i], &place[i], &open[i], &why)) {
			diag_add(diags, io_place(map, &map->point[i], why.id), "%s", why.text);
			result = BESIDE_REFUSED;
		}
		if (!open[i].request || result != BESIDE_GOOD ||
		    !needs_request(&map->point[i], &open[i]))
			continue;
		io_line_print(&map->point[i], line, LIMIT_ARG);
		result = BESIDE_RESTART;
	}
	if (!check_places(map, place, diags))
		result = BESIDE_REFUSED;
	if (!ports_check(map, now->map, diags))
		result = BESIDE_REFUSED;
	of_channels = channels_beside(&channels, hal_channels(now), map, diags, line);
	if (result == BESIDE_GOOD && of_channels == BESIDE_GOOD && make_twins(next, now, open, arena) &&
	    make_new(next, open, place, now->map->dev, arena)) {
		hal_keep_channels(next, channels);
		return BESIDE_GOOD;
	}
	channels_close(channels);
	next->request_count = 0;
	if (result == BESIDE_GOOD && of_channels == BESIDE_GOOD)
		return no_memory(map, diags), BESIDE_REFUSED;
	return result > of_channels ? result : of_channels;
}

bool hal_open_new(struct hal *next, struct diag_list *diags)
{
	for (uint32_t i = 0; i < next->request_count; i++) {
		if (next->request[i].twin || open_request(next, &next->request[i], diags))
			continue;
		hal_close_rest(next);
		return false;
	}
	if (channels_open(hal_channels(next), diags))
		return true;
	hal_close_rest(next);
	return false;
}

/* An output whose safe value could not be written in time gets it now. */
void hal_close_rest(struct hal *other)
{
	for (uint32_t i = 0; i < other->request_count; i++) {
		struct hal_request *request = &other->request[i];

		if (request->is_open && request->ask.output && request->dirty &&
		    request->ask.driver->write(&request->ask,
					       request_levels(request, request_safe(request))) == 0)
			request->dirty = false;
		close_request(request);
	}
	hal_close_channels(other);
}

bool hal_list(const char *dev,
	      void (*visit)(void *context, const struct line_seen *line),
	      void *context, struct diag_list *diags)
{
	bool good = true;

	for (int id = 0; id < DRIVER_COUNT; id++) {
		const struct driver *driver = driver_row((enum driver_id)id);
		struct trouble why;

		if (driver->by_channel)
			continue;
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
