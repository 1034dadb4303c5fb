/* SPDX-License-Identifier: MIT
 *
 * test_plan - requests of every small map, and of many large ones: each point is in one request, no
 * request is too long, writes touch nothing else, and two requests are not one that could be one.
 */
#include "modbus/plan.h"
#include "bench_map.h"
#include "tests/tap.h"

static struct bench_map it;

static int first_of(const struct plan_item *item)
{
	return item->channel->reg;
}

static int end_of(const struct plan_item *item)
{
	return item->channel->reg + item->words;
}

static int most(const struct plan_ask *ask, const struct plan_limits *limits)
{
	const bool bits = ask->table == TABLE_COIL || ask->table == TABLE_DISCRETE_INPUT;

	return ask->output ? (bits ? limits->write_bits : limits->write_words) :
			     (bits ? limits->read_bits : limits->read_words);
}

/* A coil or register that lies in the request and belongs to an item. */
static bool is_wanted(const struct plan *plan, const struct plan_ask *ask, int at)
{
	for (int i = ask->from; i < ask->to; i++)
		if (at >= first_of(&plan->item[i]) && at < end_of(&plan->item[i]))
			return true;
	return false;
}

static bool is_whole(const struct plan *plan, const struct plan_ask *ask, const struct plan_limits *limits)
{
	const bool bits = ask->table == TABLE_COIL || ask->table == TABLE_DISCRETE_INPUT;
	const int gap = ask->output ? 0 : bits ? limits->gap_bits : limits->gap_words;
	int missing = 0;

	if (ask->to <= ask->from || ask->count > most(ask, limits))
		return false;
	for (int i = ask->from; i < ask->to; i++) {
		const struct plan_item *item = &plan->item[i];

		if (first_of(item) < ask->first || end_of(item) > ask->first + ask->count ||
		    item->channel->unit_id != ask->unit || item->channel->table != ask->table ||
		    item->output != ask->output ||
		    (!ask->output && item->channel->poll_ns != ask->period_ns))
			return false;
	}
	for (int at = ask->first; at < ask->first + ask->count; at++) {
		missing = is_wanted(plan, ask, at) ? 0 : missing + 1;
		if (missing > gap)
			return false;
	}
	return missing == 0;
}

/* Whether two requests that follow each other could have been one. */
static bool could_join(const struct plan *plan, const struct plan_ask *a, const struct plan_ask *b,
		       const struct plan_limits *limits)
{
	const bool bits = a->table == TABLE_COIL || a->table == TABLE_DISCRETE_INPUT;
	const int gap = b->first - (a->first + a->count);
	const struct plan_item *last = &plan->item[a->to - 1], *next = &plan->item[b->from];

	if (a->unit != b->unit || a->table != b->table || a->output != b->output ||
	    end_of(next) - a->first > most(a, limits))
		return false;
	if (!a->output)
		return a->period_ns == b->period_ns && gap <= (bits ? limits->gap_bits : limits->gap_words);
	if (last->bit >= 0 || next->bit >= 0)
		return last->bit >= 0 && next->bit >= 0 && first_of(last) == first_of(next);
	return gap == 0;
}

static bool is_good(const struct plan *plan, const struct plan_limits *limits)
{
	int items = 0;

	for (int i = 0; i < plan->asks; i++) {
		if (plan->ask[i].from != items || !is_whole(plan, &plan->ask[i], limits))
			return false;
		items = plan->ask[i].to;
		if (i > 0 && could_join(plan, &plan->ask[i - 1], &plan->ask[i], limits))
			return false;
	}
	return items == plan->items && items == it.map.count;
}

static bool plan_is_good(const struct plan_limits *limits)
{
	struct plan plan;
	const bool good = plan_make(&plan, &it.map, 0, limits) && is_good(&plan, limits);

	plan_free(&plan);
	return good;
}

/* Each set of 13 coils or registers, read or written, with values of one and of two registers. */
static void test_every_small_map(void)
{
	static const struct plan_limits few = { .read_bits = 5, .read_words = 6, .write_bits = 4,
						.write_words = 5, .gap_bits = 2, .gap_words = 2 };
	static const struct { enum io_table table; enum iec_type type; bool output; } kind[] = {
		{ TABLE_COIL, IEC_BOOL, true }, { TABLE_COIL, IEC_BOOL, false },
		{ TABLE_DISCRETE_INPUT, IEC_BOOL, false }, { TABLE_HOLDING_REGISTER, IEC_INT, true },
		{ TABLE_HOLDING_REGISTER, IEC_INT, false }, { TABLE_INPUT_REGISTER, IEC_REAL, false },
		{ TABLE_HOLDING_REGISTER, IEC_DINT, true }, { TABLE_HOLDING_REGISTER, IEC_BOOL, true },
	};
	int good = 0, tried = 0;

	for (size_t k = 0; k < sizeof(kind) / sizeof(kind[0]); k++) {
		for (int set = 0; set < 1 << 13; set++, tried++) {
			bench_map_init(&it);
			for (int i = 12; i >= 0; i--)
				if (set >> i & 1)
					bench_map_add(&it, 1, kind[k].table, i * pdu_words_of(kind[k].type) +
						      (pdu_words_of(kind[k].type) ? 0 : i), kind[k].type,
						      kind[k].output);
			good += plan_is_good(&few);
		}
	}
	CHECK(good == tried && tried == 8 << 13);
}

static uint32_t seed = 1;

static int some(int below)
{
	seed = seed * 1664525 + 1013904223;
	return (int)((seed >> 8) % (uint32_t)below);
}

static void test_mixed_maps(void)
{
	static const enum iec_type types[] = { IEC_BOOL, IEC_INT, IEC_UINT, IEC_REAL, IEC_LREAL, IEC_DINT };
	int good = 0;

	for (int round = 0; round < 2000; round++) {
		bench_map_init(&it);
		for (int left = some(300); left > 0; left--) {
			const enum io_table table = (enum io_table)(1 + some(4));
			const bool bits = table == TABLE_COIL || table == TABLE_DISCRETE_INPUT;
			struct io_channel *channel = bench_map_add(
				&it, 1 + some(3), table, some(400), bits ? IEC_BOOL : types[some(6)],
				(table == TABLE_COIL || table == TABLE_HOLDING_REGISTER) && some(2));

			channel->poll_ns = 100 * (1 + some(2));
			if (channel->reg_bit >= 0)
				channel->reg_bit = (int8_t)some(16);
		}
		good += plan_is_good(&plan_usual);
	}
	CHECK(good == 2000);
}

static void test_limits_of_the_protocol(void)
{
	struct plan plan;

	bench_map_init(&it);
	for (int i = 0; i < 126; i++)
		bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, i, IEC_INT, false);
	for (int i = 0; i < 124; i++)
		bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, i, IEC_INT, true);
	CHECK(plan_make(&plan, &it.map, 0, &plan_usual) && plan.asks == 4);
	CHECK(plan.ask[0].count == 125 && plan.ask[1].count == 1 && plan.ask[2].count == 123 &&
	      plan.ask[3].count == 1);
	plan_free(&plan);
	/* A unit that takes less. */
	it.net.takes = &(struct io_takes){ .unit_id = 1, .read_words = 50, .write_words = 40, .gap_words = -1 };
	it.net.takes_count = 1;
	CHECK(plan_make(&plan, &it.map, 0, &plan_usual) && plan.asks == 3 + 4);
	CHECK(plan.ask[0].count == 50 && plan.ask[2].count == 26 && plan.ask[3].count == 40 &&
	      plan.ask[6].count == 4);
	plan_free(&plan);
	it.net.takes->unit_id = 2;
	CHECK(plan_make(&plan, &it.map, 0, &plan_usual) && plan.asks == 4);
	plan_free(&plan);
	/* Another bus, and a point of another driver. */
	it.channel[0].bus = 1;
	it.point[1].driver = DRIVER_sim;
	CHECK(plan_make(&plan, &it.map, 0, &plan_usual) && plan.items == 248);
	plan_free(&plan);
}

/* Registers 0, 2 and 11, coils 0, 9 and 75: which gaps are read along. */
static void test_gaps(void)
{
	static const struct { int16_t gap; int asks; } kind[] = { { -1, 1 + 2 }, { 0, 3 + 3 }, { 1, 2 + 2 },
								  { 8, 1 + 2 }, { 9, 1 + 1 } };
	struct plan plan;

	bench_map_init(&it);
	for (int i = 0; i < 3; i++) {
		bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, i == 2 ? 11 : 2 * i, IEC_INT, false);
		bench_map_add(&it, 1, TABLE_COIL, i == 2 ? 75 : 9 * i, IEC_BOOL, false);
	}
	it.net.takes = &(struct io_takes){ .unit_id = 1 };
	it.net.takes_count = 1;
	for (size_t i = 0; i < sizeof(kind) / sizeof(kind[0]); i++) {
		it.net.takes->gap_words = kind[i].gap;
		CHECK(plan_make(&plan, &it.map, 0, &plan_usual) && plan.asks == kind[i].asks);
		plan_free(&plan);
	}
}

/* A request is divided until each has one item; no item is lost. */
static void test_splits_end(void)
{
	struct plan plan;
	int good = 0;

	for (int set = 1; set < 1 << 10; set++) {
		bench_map_init(&it);
		for (int i = 0; i < 10; i++)
			if (set >> i & 1)
				bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, 3 * i, IEC_INT, false);
		plan_make(&plan, &it.map, 0, &plan_usual);
		for (int i = 0; i < plan.asks;)
			if (!plan_split(&plan, i))
				i++;
		good += plan.asks == plan.items;
		for (int i = 0; i < plan.asks; i++)
			good += plan.ask[i].to - plan.ask[i].from == 1 && plan.ask[i].count == 1 &&
				plan.ask[i].first == first_of(&plan.item[plan.ask[i].from]);
		good -= plan.asks;
		plan_free(&plan);
	}
	CHECK(good == (1 << 10) - 1);
	bench_map_init(&it);
	for (int i = 0; i < 4; i++)
		bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, 7, IEC_BOOL, false)->reg_bit = (int8_t)i;
	CHECK(plan_make(&plan, &it.map, 0, &plan_usual) && plan.asks == 1 && !plan_split(&plan, 0));
	plan_free(&plan);
}

static bool in_set(void *context, int item)
{
	return *(const int *)context >> item & 1;
}

/* Rows of due items: for each set they are the runs of ones, no longer than the limit. */
static void test_rows_are_the_runs_of_what_is_due(void)
{
	static const struct plan_limits four = { .read_words = 99, .write_words = 4 };
	struct plan plan;
	int good = 0;

	bench_map_init(&it);
	for (int i = 0; i < 10; i++)
		bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, i, IEC_INT, true);
	plan_make(&plan, &it.map, 0, &(struct plan_limits){ .write_words = 99 });
	for (int set = 0; set < 1 << 10; set++) {
		int from = 0, seen = 0, to;
		bool right = true;

		while ((to = plan_run(&plan, &plan.ask[0], &from, in_set, &set, &four)) > from) {
			right = right && to - from <= 4;
			for (; from < to; from++)
				seen |= 1 << from;
		}
		good += right && from == 10 && seen == set;
	}
	CHECK(good == 1 << 10);
	plan_free(&plan);
}

int main(void)
{
	test_every_small_map();
	test_mixed_maps();
	test_limits_of_the_protocol();
	test_gaps();
	test_splits_end();
	test_rows_are_the_runs_of_what_is_due();
	return tap_done();
}
