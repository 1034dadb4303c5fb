/* SPDX-License-Identifier: MIT
 *
 * plan - sorts points and joins neighbours.
 */
#include "modbus/plan.h"

#include <stdlib.h>

const struct plan_limits plan_usual = {
	.read_bits = PDU_READ_BITS, .read_words = PDU_READ_WORDS,
	.write_bits = PDU_WRITE_BITS, .write_words = PDU_WRITE_WORDS,
	.gap_bits = 64, .gap_words = 8,
};

struct plan_limits plan_limits_of(const struct plan_limits *usual, const struct io_net *net, int bus,
				  uint8_t unit)
{
	struct plan_limits limits = *usual;

	for (int i = 0; net && i < net->takes_count; i++) {
		const struct io_takes *device = &net->takes[i];

		if (device->bus != bus || device->unit_id != unit)
			continue;
		limits.read_words = device->read_words ? device->read_words : usual->read_words;
		limits.write_words = device->write_words ? device->write_words : usual->write_words;
		limits.read_bits = device->read_bits ? device->read_bits : usual->read_bits;
		limits.write_bits = device->write_bits ? device->write_bits : usual->write_bits;
		limits.gap_words = device->gap_words >= 0 ? device->gap_words : usual->gap_words;
		limits.gap_bits = device->gap_words >= 0 ? 8 * device->gap_words : usual->gap_bits;
		limits.together = device->together;
	}
	return limits;
}

static bool is_bits(enum io_table table)
{
	return table == TABLE_COIL || table == TABLE_DISCRETE_INPUT;
}

static int order(int64_t a, int64_t b)
{
	return (a > b) - (a < b);
}

static int compare(const void *left, const void *right)
{
	const struct plan_item *a = left, *b = right;
	const int by[] = {
		order(a->channel->unit_id, b->channel->unit_id), order(a->output, b->output),
		order((int)a->channel->table, (int)b->channel->table),
		order(a->channel->ask, b->channel->ask),
		a->output ? 0 : order(a->channel->poll_ns, b->channel->poll_ns),
		order(a->channel->reg, b->channel->reg), order(a->bit, b->bit), order(a->point, b->point),
	};

	for (size_t i = 0; i < sizeof(by) / sizeof(by[0]); i++)
		if (by[i])
			return by[i];
	return 0;
}

static int first_of(const struct plan_item *item)
{
	return item->channel->reg;
}

static int end_of(const struct plan_item *item)
{
	return item->channel->reg + item->words;
}

/* Whether the next item can go into the request. */
static bool joins(const struct plan_ask *ask, const struct plan_item *last, const struct plan_item *item,
		  const struct plan_limits *limits)
{
	const bool bits = is_bits(ask->table);
	const int gap = first_of(item) - (ask->first + ask->count);
	const int most = ask->output ? (bits ? limits->write_bits : limits->write_words) :
				       (bits ? limits->read_bits : limits->read_words);

	if (item->channel->unit_id != ask->unit || item->output != ask->output || item->channel->ask - 1 != ask->by ||
	    item->channel->table != ask->table ||
	    end_of(item) - ask->first > most)
		return false;
	if (!ask->output)
		return item->channel->poll_ns == ask->period_ns &&
		       gap <= (bits ? limits->gap_bits : limits->gap_words);
	/* Bits of a register are written by their own function. */
	if (item->bit >= 0 || last->bit >= 0)
		return item->bit >= 0 && last->bit >= 0 && first_of(item) == first_of(last);
	return gap == 0;
}

static void add_items(struct plan *plan, const struct iomap *map, int bus)
{
	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];
		const struct io_channel *channel = point->channel;
		struct plan_item item = { .point = i, .channel = channel, .output = point->output,
					  .bit = -1, .words = 1 };

		if ((point->driver != DRIVER_modbus && point->driver != DRIVER_module) || channel->bus != bus || channel->table == TABLE_NONE)
			continue;
		if (!is_bits(channel->table)) {
			item.bit = channel->reg_bit;
			if (channel->reg_bit < 0)
				item.words = pdu_words_of(channel->raw);
		}
		plan->item[plan->items++] = item;
	}
}

static void add_asks(struct plan *plan, const struct iomap *map, int bus,
		     const struct plan_limits *usual)
{
	struct plan_limits limits = *usual;
	struct plan_ask *ask = NULL;

	for (int i = 0; i < plan->items; i++) {
		const struct plan_item *item = &plan->item[i];

		if (!ask || ask->unit != item->channel->unit_id)
			limits = plan_limits_of(usual, map->net, bus, item->channel->unit_id);
		if (!ask || !joins(ask, item - 1, item, &limits)) {
			ask = &plan->ask[plan->asks++];
			*ask = (struct plan_ask){ .unit = item->channel->unit_id, .table = item->channel->table,
						  .output = item->output, .first = item->channel->reg,
						  .from = i, .period_ns = item->channel->poll_ns,
						  .by = item->channel->ask - 1 };
		}
		if (end_of(item) - ask->first > ask->count)
			ask->count = end_of(item) - ask->first;
		ask->to = i + 1;
	}
}

bool plan_make(struct plan *out, const struct iomap *map, int bus, const struct plan_limits *limits)
{
	const size_t most = map->count ? (size_t)map->count : 1;

	*out = (struct plan){ .item = calloc(most, sizeof(*out->item)),
			      .ask = calloc(most, sizeof(*out->ask)) };
	if (!out->item || !out->ask) {
		plan_free(out);
		return false;
	}
	add_items(out, map, bus);
	qsort(out->item, (size_t)out->items, sizeof(*out->item), compare);
	add_asks(out, map, bus, limits);
	return true;
}

void plan_free(struct plan *plan)
{
	free(plan->item);
	free(plan->ask);
	*plan = (struct plan){ .items = 0 };
}

/* First and count of a request, from its items. */
static void fit(const struct plan *plan, struct plan_ask *ask)
{
	ask->first = plan->item[ask->from].channel->reg;
	ask->count = 0;
	for (int i = ask->from; i < ask->to; i++)
		if (end_of(&plan->item[i]) - ask->first > ask->count)
			ask->count = end_of(&plan->item[i]) - ask->first;
}

/* Where to divide: at the widest gap; without one, at the middle. */
static int divide(const struct plan *plan, const struct plan_ask *ask)
{
	const int middle = (ask->from + ask->to) / 2;
	int best = -1, widest = 0, end = 0;

	for (int i = ask->from; i < ask->to; i++) {
		const int gap = first_of(&plan->item[i]) - end;

		if (i > ask->from && first_of(&plan->item[i]) > first_of(&plan->item[i - 1]) &&
		    (best < 0 || gap > widest ||
		     (gap == widest && abs(i - middle) < abs(best - middle)))) {
			best = i;
			widest = gap;
		}
		if (end_of(&plan->item[i]) > end)
			end = end_of(&plan->item[i]);
	}
	return best;
}

bool plan_split(struct plan *plan, int ask)
{
	const int at = divide(plan, &plan->ask[ask]);
	struct plan_ask *first = &plan->ask[ask], *second = &plan->ask[plan->asks];

	if (at < 0)
		return false;
	*second = *first;
	second->from = first->to = at;
	fit(plan, first);
	fit(plan, second);
	plan->asks++;
	return true;
}

int plan_run(const struct plan *plan, const struct plan_ask *ask, int *from,
	     bool (*due)(void *context, int item), void *context, const struct plan_limits *limits)
{
	const int most = is_bits(ask->table) ? limits->write_bits : limits->write_words;
	int end;

	while (*from < ask->to && !due(context, *from))
		(*from)++;
	for (end = *from; end < ask->to && due(context, end); end++)
		if (end_of(&plan->item[end]) - first_of(&plan->item[*from]) > most)
			break;
	/* Several bits of one register go together, also with others between them. */
	if (*from < ask->to && plan->item[*from].bit >= 0)
		end = ask->to;
	return end;
}
