/* SPDX-License-Identifier: MIT
 *
 * test_bus - a master in virtual time, with units that are silent, late, or refuse.
 *
 * The wire is a serial line: an answer does not say what it answers, and one that is late is still on its
 * way when the next request is sent.
 */
#include "modbus/bus.h"
#include "bench_map.h"
#include "tests/tap.h"

#define MS 1000000
#define FRAMES 64

static struct bench_map it;
static struct field field;
static struct bus bus;

/* ---- the units ---- */

struct far_unit {
	int64_t delay_ns;      /* until its answer; 0: 2 ms                    */
	bool silent, crc, other; /* other: it answers with another number        */
	int missing;           /* this register it does not have; 0: all are there */
	bool no_function[32];
	int most;              /* registers in one request; 0: 125             */
	bool random;           /* a delay of 5 … 495 ms, and now and then none   */
	uint16_t reg[256];
	int asked, written, both;
};

static struct {
	int64_t now_ns;
	struct far_unit unit[32];
	struct { int64_t at_ns; uint8_t unit; struct pdu pdu; } frame[FRAMES];
	int frames;
	int timeouts;
	bool cut;
} far;
static uint32_t seed;

static int some(int below)
{
	seed = seed * 1664525 + 1013904223;
	return (int)((seed >> 8) % (uint32_t)below);
}

static void refuse(struct pdu *out, int exception)
{
	out->byte[0] |= 0x80;
	out->byte[1] = (uint8_t)exception;
	out->len = 2;
}

static void far_take(struct far_unit *unit, const struct pdu *request, int at)
{
	const int to = pdu_word(request->byte + at), words = pdu_word(request->byte + at + 2);

	for (int i = 0; i < words && to + words <= 256; i++)
		unit->reg[to + i] = pdu_word(request->byte + at + 5 + 2 * i);
}

static void far_answer(struct far_unit *unit, const struct pdu *request, struct pdu *out)
{
	const int function = request->byte[0], first = pdu_word(request->byte + 1);
	const int count = function == 3 || function == 16 || function == 23 ? pdu_word(request->byte + 3) : 1;

	*out = *request;
	out->len = function == 22 ? 7 : 5;
	if (unit->no_function[function])
		refuse(out, PDU_NO_FUNCTION);
	else if ((unit->missing && first <= unit->missing && unit->missing < first + count) ||
		 first + count > 256 || (unit->most && count > unit->most))
		refuse(out, PDU_NO_ADDRESS);
	else if (function == 3 || function == 23) {
		if (function == 23)
			far_take(unit, request, 5);
		out->byte[1] = (uint8_t)(2 * count);
		out->len = 2 + 2 * count;
		for (int i = 0; i < count; i++) {
			out->byte[2 + 2 * i] = (uint8_t)(unit->reg[first + i] >> 8);
			out->byte[3 + 2 * i] = (uint8_t)unit->reg[first + i];
		}
	} else if (function == 6) {
		unit->reg[first] = pdu_word(request->byte + 3);
	} else if (function == 16) {
		far_take(unit, request, 1);
	} else if (function == 22) {
		unit->reg[first] = (uint16_t)((unit->reg[first] & pdu_word(request->byte + 3)) |
					      pdu_word(request->byte + 5));
	}
	unit->both += function == 23 && !(out->byte[0] & 0x80);
	unit->written += function != 3 && !(out->byte[0] & 0x80);
}

static void far_send(uint8_t number, const struct pdu *request)
{
	struct far_unit *unit = &far.unit[number];
	int64_t delay_ns = unit->delay_ns ? unit->delay_ns : 2 * MS;

	unit->asked++;
	if (unit->random)
		delay_ns = some(5) ? (5 + some(some(2) ? 490 : 90)) * (int64_t)MS : 0;
	if (unit->silent || !delay_ns || far.frames == FRAMES)
		return;
	far.frame[far.frames].at_ns = far.now_ns + delay_ns;
	far.frame[far.frames].unit = unit->other ? number + 1 : number;
	far_answer(unit, request, &far.frame[far.frames].pdu);
	far.frames++;
}

/* The frame that comes next, at @until_ns at the latest: its place, or -1. */
static int far_next(int64_t until_ns)
{
	int best = -1;

	for (int i = 0; i < far.frames; i++)
		if (far.frame[i].at_ns <= until_ns && (best < 0 || far.frame[i].at_ns < far.frame[best].at_ns))
			best = i;
	return best;
}

static void far_drop(int frame)
{
	far.frame[frame] = far.frame[--far.frames];
}

static enum heard ask(void *context, uint8_t number, const struct pdu *request, struct pdu *answer,
		      struct unit_counts *counts)
{
	const int64_t until_ns = far.now_ns + 100 * MS;
	bool strays = false;
	int next;

	(void)context;
	if (far.cut)
		return HEARD_NO_LINE;
	while ((next = far_next(far.now_ns)) >= 0)
		far_drop(next);
	far_send(number, request);
	while ((next = far_next(until_ns)) >= 0) {
		const bool ours = far.frame[next].unit == number;

		far.now_ns = far.frame[next].at_ns;
		*answer = far.frame[next].pdu;
		far_drop(next);
		if (ours)
			return far.unit[number].crc ? HEARD_CRC : HEARD_ANSWER;
		counts->wrong++;
		strays = true;
	}
	far.now_ns = until_ns;
	far.timeouts++;
	return strays ? HEARD_WRONG : HEARD_NOTHING;
}

static int64_t now(void *context)
{
	(void)context;
	return far.now_ns;
}

/* ---- the bench ---- */

static void begin(void)
{
	memset(&far, 0, sizeof(far));
	far.now_ns = 1000 * (int64_t)MS;
	seed = 3;
	for (int u = 0; u < 32; u++)
		for (int r = 0; r < 256; r++)
			far.unit[u].reg[r] = (uint16_t)(u * 1000 + r);
	bench_map_init(&it);
}

static void start(void)
{
	CHECK(field_open(&field, it.map.count));
	CHECK(bus_open(&bus, &it.map, 0, &field, (struct wire){ .ask = ask, .now = now }));
}

static void end(void)
{
	bus_close(&bus);
	field_close(&field);
}

static bool step(int64_t end_ns)
{
	const int64_t next_ns = bus_step(&bus);

	if (next_ns > far.now_ns)
		far.now_ns = next_ns < end_ns ? next_ns : end_ns;
	return far.now_ns < end_ns;
}

static void run(int64_t ms)
{
	const int64_t end_ns = far.now_ns + ms * MS;

	while (step(end_ns))
		;
}

static void output(int point, int64_t value)
{
	field_output(&field, point, (union iec_value){ .i = value });
	bus_changed(&bus);
}

static int good, bad, mixed;
static bool last_good[BENCH_POINTS];

static void take(void)
{
	static struct field_fresh fresh[BENCH_POINTS];
	const int count = field_take(&field, fresh);

	good = bad = mixed = 0;
	for (int i = 0; i < count; i++) {
		const struct io_channel *channel = &it.channel[fresh[i].point];

		good += fresh[i].good;
		bad += !fresh[i].good;
		last_good[fresh[i].point] = fresh[i].good;
		mixed += fresh[i].good && !it.point[fresh[i].point].output &&
			 fresh[i].value.i != channel->unit_id * 1000 + channel->reg;
	}
}

/* ---- tests ---- */

static void test_reads_come_by_period(void)
{
	begin();
	for (int i = 0; i < 10; i++)
		bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, i, IEC_UINT, false);
	bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, 20, IEC_UINT, false)->poll_ns = 1000 * MS;
	start();
	run(10000);
	take();
	CHECK(good == 11 && bad == 0 && mixed == 0);
	CHECK(far.unit[1].asked >= 108 && far.unit[1].asked <= 112);
	CHECK(bus.unit[1].counts.requests == (uint32_t)far.unit[1].asked &&
	      bus.unit[1].counts.answers == bus.unit[1].counts.requests);
	end();
}

/* Two requests of the same form to one unit whose answers come at any time, or never, beside a good unit:
 * no value is ever that of another register. */
static void test_late_answers_are_never_mixed_up(void)
{
	int all = 0, wrong = 0, others = 0;

	begin();
	for (int i = 0; i < 3; i++)
		bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, 50 * i, IEC_UINT, false);
	bench_map_add(&it, 2, TABLE_HOLDING_REGISTER, 0, IEC_UINT, false);
	far.unit[1].random = true;
	start();
	for (int i = 0; i < 20000; i++) {
		run(50);
		take();
		all += good;
		wrong += mixed;
		others += last_good[3];
	}
	CHECK(wrong == 0 && all > 3000);
	CHECK(others > 19000);
	CHECK(bus.unit[1].counts.timeouts > 1000);
	/* The same with each constant delay: a unit that is always late is never believed wrongly. */
	for (int delay = 5; delay < 500; delay += 5) {
		far.unit[1].random = false;
		far.unit[1].delay_ns = delay * (int64_t)MS;
		run(3000);
		take();
		wrong += mixed;
	}
	CHECK(wrong == 0);
	end();
}

static void test_a_silent_unit_costs_one_timeout_a_round(void)
{
	int64_t longest_ns = 0, last_ns = 0, began_ns;
	int rounds, silent;

	begin();
	for (int u = 1; u <= 16; u++)
		bench_map_add(&it, u, TABLE_HOLDING_REGISTER, 0, IEC_UINT, false)->poll_ns = 50 * MS;
	for (int u = 5; u <= 16; u++)
		far.unit[u].silent = true;
	start();
	began_ns = last_ns = far.now_ns;
	for (int asked = 0; far.now_ns < began_ns + 60000 * (int64_t)MS;) {
		step(INT64_MAX);
		if (far.unit[1].asked == asked)
			continue;
		asked = far.unit[1].asked;
		/* In the first round nobody knows yet who is silent. */
		if (asked > 2 && far.now_ns - last_ns > longest_ns)
			longest_ns = far.now_ns - last_ns;
		last_ns = far.now_ns;
	}
	rounds = far.unit[1].asked;
	silent = far.timeouts;
	CHECK(longest_ns <= (50 + 100 + 4 * 2 + 1) * MS);
	CHECK(silent <= rounds + 12);
	/* With back-off up to 10 s: far fewer than rounds. */
	CHECK(rounds > 900 && silent < 170);
	take();
	CHECK(last_good[0] && last_good[3] && !last_good[4] && !last_good[15]);
	for (int u = 5; u <= 16; u++)
		far.unit[u].silent = false;
	run(10100);
	take();
	CHECK(last_good[4] && last_good[15] && mixed == 0);
	end();
}

/* The whole line cut, for a short time and a long one: bad within three polls, good within 2 s. */
static void test_a_cable_is_out_and_back(void)
{
	for (int kind = 0; kind < 2; kind++) {
		for (int ms = 1000; ms <= 64000; ms *= 4) {
			begin();
			for (int u = 1; u <= 2; u++)
				bench_map_add(&it, u, TABLE_HOLDING_REGISTER, 0, IEC_UINT, false);
			start();
			run(1000);
			take();
			far.unit[1].silent = far.unit[2].silent = kind == 0;
			far.cut = kind == 1;
			run(510);
			take();
			CHECK(bad == 2 && !last_good[0] && !last_good[1]);
			run(ms);
			far.unit[1].silent = far.unit[2].silent = far.cut = false;
			run(2000);
			take();
			CHECK(last_good[0] && last_good[1] && mixed == 0);
			end();
		}
	}
}

static void test_a_register_that_is_missing_spoils_no_other(void)
{
	begin();
	for (int i = 1; i <= 40; i++)
		bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, i, IEC_UINT, false);
	bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, 46, IEC_UINT, false);
	far.unit[1].missing = 17;
	start();
	run(1000);
	take();
	CHECK(good == 40 && bad == 1 && !last_good[16] && mixed == 0);
	CHECK(bus.unit[1].counts.exceptions[2] > 0 && bus.unit[1].counts.timeouts == 0);
	far.unit[1].missing = 0;
	run(2000);
	take();
	CHECK(good == 41 && bad == 0);
	end();
	/* A gap that cannot be read, and a device that takes only few registers at a time. */
	begin();
	bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, 1, IEC_UINT, false);
	bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, 5, IEC_UINT, false);
	for (int i = 0; i < 60; i++)
		bench_map_add(&it, 2, TABLE_HOLDING_REGISTER, i, IEC_UINT, false);
	far.unit[1].missing = 3;
	far.unit[2].most = 8;
	start();
	run(1000);
	take();
	CHECK(good == 62 && bad == 0 && mixed == 0);
	end();
}

static void test_errors_are_counted(void)
{
	begin();
	for (int u = 1; u <= 3; u++)
		bench_map_add(&it, u, TABLE_HOLDING_REGISTER, 0, IEC_UINT, false);
	far.unit[1].crc = true;
	far.unit[2].other = true;
	far.unit[3].no_function[3] = true;
	start();
	run(3000);
	take();
	CHECK(good == 0 && bad == 3);
	CHECK(bus.unit[1].counts.crc >= 3 && bus.unit[1].counts.answers == 0);
	CHECK(bus.unit[2].counts.wrong >= 3 && bus.unit[2].counts.answers == 0);
	CHECK(bus.unit[3].counts.exceptions[1] >= 3);
	far.unit[1].crc = far.unit[2].other = far.unit[3].no_function[3] = false;
	run(4000);
	take();
	CHECK(good == 3 && bad == 0 && mixed == 0);
	end();
}

/* A value that was not written is never written later, if there is a newer one. */
static void test_writes_are_never_old(void)
{
	begin();
	for (int i = 0; i < 4; i++)
		bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, i, IEC_UINT, true);
	start();
	run(500);
	CHECK(far.unit[1].written == 0 && far.unit[1].asked == 0); /* no value yet */
	output(0, 11);
	output(1, 12);
	run(50);
	CHECK(far.unit[1].written == 1 && far.unit[1].reg[0] == 11 && far.unit[1].reg[1] == 12 &&
	      far.unit[1].reg[2] == 1002);
	run(5000);
	CHECK(far.unit[1].written >= 5 && far.unit[1].written <= 7); /* each second, together */
	far.unit[1].silent = true;
	for (int i = 0; i < 50; i++) {
		output(0, 100 + i);
		run(50);
	}
	far.unit[1].silent = false;
	far.unit[1].written = 0;
	run(2100);
	CHECK(far.unit[1].reg[0] == 149 && far.unit[1].reg[1] == 12);
	CHECK(far.unit[1].written <= 3);
	/* An output that changes at once is written at once. */
	output(3, 7);
	run(5);
	CHECK(far.unit[1].reg[3] == 7 && far.unit[1].reg[2] == 1002);
	end();
}

static void test_bits_of_a_register(void)
{
	for (int mask = 0; mask < 2; mask++) {
		begin();
		for (int i = 0; i < 3; i++)
			bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, 9, IEC_BOOL, true)->reg_bit =
				(int8_t)(4 + 2 * i);
		far.unit[1].reg[9] = 0xf00f;
		far.unit[1].no_function[22] = mask;
		start();
		output(0, 1);
		output(2, 1);
		run(100);
		CHECK(far.unit[1].reg[9] == 0xf11f);
		output(0, 0);
		output(1, 1);
		far.unit[1].reg[9] |= 0x0800; /* another one's */
		run(100);
		CHECK(far.unit[1].reg[9] == 0xf94f);
		end();
	}
}

/* Devices that have only one of the functions for one and for several registers. */
static void test_functions_that_a_device_lacks(void)
{
	for (int lacks = 0; lacks < 2; lacks++) {
		begin();
		for (int i = 0; i < 5; i++)
			bench_map_add(&it, 1, TABLE_HOLDING_REGISTER, i + (i == 4 ? 10 : 0), IEC_UINT, true);
		far.unit[1].no_function[lacks ? 6 : 16] = true;
		start();
		for (int i = 0; i < 5; i++)
			output(i, 70 + i);
		run(1000);
		CHECK(far.unit[1].reg[0] == 70 && far.unit[1].reg[3] == 73 && far.unit[1].reg[14] == 74);
		end();
	}
}

/* Registers that are read and written in one request, by units that can and units that cannot. */
static void test_reads_and_writes_together(void)
{
	for (int kind = 0; kind < 3; kind++) {
		int alone;

		begin();
		it.net.takes = &(struct io_takes){ .unit_id = 1, .together = true, .gap_words = -1 };
		it.net.takes_count = 1;
		for (int u = 1; u <= 2; u++)
			for (int i = 0; i < 10; i++)
				bench_map_add(&it, u, TABLE_HOLDING_REGISTER, i, IEC_UINT, false);
		for (int u = 1; u <= 2; u++)
			for (int i = 0; i < 3; i++)
				bench_map_add(&it, u, TABLE_HOLDING_REGISTER, 20 + i, IEC_UINT, true);
		far.unit[1].no_function[23] = kind == 1;
		far.unit[1].missing = kind == 2 ? 5 : 0;
		start();
		for (int round = 0; round < 50; round++) {
			for (int i = 0; i < 6; i++)
				output(20 + i, round * 10 + i);
			run(100);
			for (int i = 0; i < 3; i++)
				CHECK(far.unit[1].reg[20 + i] == round * 10 + i &&
				      far.unit[2].reg[20 + i] == round * 10 + 3 + i);
		}
		take();
		for (int i = 0; i < 20; i++)
			CHECK(last_good[i] == (kind != 2 || i != 5));
		CHECK(mixed == 0);
		/* One request instead of two; the other unit has no such line. */
		alone = far.unit[2].asked;
		CHECK(far.unit[2].both == 0 && alone >= 98 && alone <= 102);
		CHECK(kind != 0 || (far.unit[1].both >= 48 && far.unit[1].asked <= 55));
		CHECK(kind == 0 || (far.unit[1].both == 0 && far.unit[1].written >= 48));
		end();
	}
}

/* More outputs than the line can refresh in time: a new value comes to its unit within one turn of all, whatever
 * the others want. */
static void test_no_output_waits_for_ever(void)
{
	int late = 0;

	for (int round = 0; round < 60; round++) {
		int count, turn_ms = 0;

		begin();
		seed = (uint32_t)round * 7919 + 1;
		count = 2 + some(10);
		for (int i = 0; i < count; i++) {
			const int unit = 1 + some(3);

			/* Neighbours go in one request; others do not. */
			bench_map_add(&it, unit, TABLE_HOLDING_REGISTER, i * (some(2) ? 1 : 15), IEC_INT, true)->refresh_ns =
				(20 + some(100)) * (int64_t)MS;
			for (int k = 0; k < i; k++)
				if (it.channel[k].unit_id == unit && it.channel[k].reg == it.channel[i].reg)
					it.channel[i].reg = (uint16_t)(200 + i);
		}
		for (int u = 1; u <= 3; u++)
			far.unit[u].delay_ns = (30 + some(60)) * (int64_t)MS;
		start();
		for (int i = 0; i < count; i++)
			turn_ms += (int)(far.unit[it.channel[i].unit_id].delay_ns / MS);
		for (int i = 0; i < count; i++)
			output(i, 1);
		run(4 * turn_ms);
		for (int i = 0; i < count; i++)
			output(i, 1000 + i);
		run(turn_ms + 100);
		for (int i = 0; i < count; i++)
			late += far.unit[it.channel[i].unit_id].reg[it.channel[i].reg] != 1000 + i;
		end();
	}
	if (!CHECK(late == 0))
		printf("# %d outputs had an old value\n", late);
}

int main(void)
{
	test_reads_come_by_period();
	test_late_answers_are_never_mixed_up();
	test_a_silent_unit_costs_one_timeout_a_round();
	test_a_cable_is_out_and_back();
	test_a_register_that_is_missing_spoils_no_other();
	test_errors_are_counted();
	test_writes_are_never_old();
	test_bits_of_a_register();
	test_functions_that_a_device_lacks();
	test_reads_and_writes_together();
	test_no_output_waits_for_ever();
	return tap_done();
}
