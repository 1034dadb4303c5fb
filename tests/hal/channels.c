/* SPDX-License-Identifier: MIT
 *
 * channels - the tests of analog values: scaling, quality, substitutes and safe values in virtual time, then the
 * drivers pwm, w1 and hwmon with files in place of the kernel's, and what can go wrong with them.
 */
#define _DEFAULT_SOURCE /* setreuid() */
#include "hal/channel_cell.h"
#include "hal/group.h"
#include "hal/sysfs.h"
#include "tests/hal/field.h"

#include <math.h>
#include <pthread.h>

/* ---- scaling ---- */

static int64_t value_of(enum iec_type type, double low, double high, double at_low, double at_high, double raw)
{
	const struct io_channel channel = {
		.type = type, .scaled = true, .value_low = low, .value_high = high,
		.at_low = at_low, .at_high = at_high,
	};
	union iec_value value = { .i = 77 };

	channel_value(&channel, raw, &value);
	return value.i;
}

static void test_scaling(void)
{
	struct io_channel channel = { .type = IEC_REAL };
	union iec_value value;

	CHECK(value_of(IEC_INT, 0, 27648, 0, 10, 5) == 13824);
	CHECK(value_of(IEC_INT, 0, 27648, 0.004, 0.020, 0.012) == 13824);
	CHECK_AS(value_of(IEC_INT, 0, 27648, 0.004, 0.020, 0.002) == -3456, "below its range it goes on");
	CHECK(value_of(IEC_INT, 0, 27648, 0, 10, 20) == 32767);
	CHECK(value_of(IEC_INT, 0, 27648, 0, 10, -20) == -32768);
	CHECK(value_of(IEC_INT, 0, 27648, 0, 10, INFINITY) == 32767);
	CHECK(value_of(IEC_INT, 0, 27648, 0, 10, NAN) == 0);
	CHECK_AS(value_of(IEC_INT, 100, 0, 0, 10, 2.5) == 75, "a range upside down");
	CHECK(value_of(IEC_INT, 0, 10, 0, 10, 2.5) == 3 && value_of(IEC_INT, 0, 10, 0, 10, 2.4) == 2);
	CHECK(value_of(IEC_UINT, 0, 10, 0, 10, -1) == 0 && value_of(IEC_WORD, 0, 1e6, 0, 1, 1) == 65535);
	CHECK(value_of(IEC_ULINT, 0, 1, 0, 1, 1e30) == -1);
	CHECK(value_of(IEC_LINT, 0, 1, 0, 1, 1e30) == INT64_MAX);
	CHECK(value_of(IEC_LINT, 0, 1, 0, 1, -1e30) == INT64_MIN);
	CHECK(value_of(IEC_ULINT, 0, 1, 0, 1, 9223372036854775808.0) == INT64_MIN);
	CHECK(channel_value(&channel, 1.25, &value) && value.r == 1.25);
	CHECK(!channel_value(&channel, NAN, &value));
	channel.limited = true, channel.least = 0.004, channel.most = 0.020;
	CHECK(channel_value(&channel, 0.004, &value) && channel_value(&channel, 0.020, &value));
	CHECK(!channel_value(&channel, 0.0039, &value) && !channel_value(&channel, 0.0201, &value));
	channel = (struct io_channel){ .type = IEC_INT, .scaled = true, .value_high = 27648, .at_high = 10 };
	CHECK(channel_raw(&channel, INT(13824)) == 5 && channel_raw(&channel, INT(-13824)) == -5);
	channel = (struct io_channel){ .type = IEC_ULINT };
	CHECK(channel_raw(&channel, INT(-1)) == 18446744073709551616.0);
}

/* As round() of libm, which no program of a board needs. */
static void test_round(void)
{
	static const double some[] = { 0, 0.5, 1, 1.5, 2.5, 1e15, 4503599627370495.5, 4503599627370496.0, 9007199254740993.0, 1e300, INFINITY };
	uint64_t state = 88172645463325252u;
	bool same = true;

	for (size_t i = 0; i < sizeof(some) / sizeof(*some); i++)
		for (int k = -1; k <= 1; k++) {
			const double x = k < 0 ? nextafter(some[i], -1) : k > 0 ? nextafter(some[i], INFINITY) : some[i];

			same &= channel_round(x) == round(x) && channel_round(-x) == round(-x);
		}
	for (int i = 0; i < 100000; i++) {
		double x;

		state ^= state << 13, state ^= state >> 7, state ^= state << 17;
		memcpy(&x, &state, sizeof(x));
		same &= isnan(x) || channel_round(x) == round(x);
		x = (double)(int32_t)state / 64;
		same &= channel_round(x) == round(x);
	}
	CHECK_AS(same && isnan(channel_round(NAN)), "channel_round() is round()");
}

/* A file of the kernel that takes numbers up to 1000, as one of a converter does. */
static void test_highest_step(void)
{
	struct cell cell = { .file = open("/proc/self/oom_score_adj", O_WRONLY) };

	if (cell_write(&cell, 1000) != 0) {
		printf("ok %d # SKIP no file that refuses a number\n", ++tap_count);
		return;
	}
	CHECK_AS(cell_write(&cell, 1001) == 0, "one more than the highest step is that step");
	CHECK_AS(cell_write(&cell, 1002) == -EINVAL, "two more are refused");
	cell_write(&cell, 0);
	close(cell.file);
}

/* ---- inputs of a gateway, in virtual time ---- */

static void test_quality(void)
{
	struct field f;
	struct io_channel *level;

	field_begin(&f);
	level = field_add(&f, "%IW2", DRIVER_modbus, IEC_INT);
	level->raw = IEC_UINT;
	level->scaled = true, level->value_high = 100, level->at_high = 1000;
	level->limited = true, level->most = 1200;
	field_add(&f, "%ID8", DRIVER_modbus, IEC_DINT);
	level = field_add(&f, "%IX20.3", DRIVER_module, IEC_BOOL);
	level->substituted = true, level->substitute.i = 1;
	CHECK(field_open(&f));
	CHECK_AS(field_scan(&f, 0), "a channel without a value is no fault of the scan");
	CHECK(field_get(&f, 0).i == 0 && field_quality(&f, 0) == QUALITY_STALE);
	CHECK_AS(field_get(&f, 2).i == 1, "it has its substitute from the beginning");
	CHECK(hal_worst(&f.hal) == QUALITY_STALE && hal_quality(&f.hal) == QUALITY_GOOD);
	channels_put(f.hal.channels, 0, INT(500), true, 10 * MS);
	channels_put(f.hal.channels, 1, INT(-7), true, 10 * MS);
	channels_put(f.hal.channels, 2, INT(0), true, 10 * MS);
	field_scan(&f, 20 * MS);
	CHECK(field_get(&f, 0).i == 50 && field_get(&f, 1).i == -7 && field_get(&f, 2).i == 0);
	CHECK(hal_worst(&f.hal) == QUALITY_GOOD);
	field_scan(&f, 1010 * MS);
	CHECK_AS(hal_worst(&f.hal) == QUALITY_GOOD, "a value is good as long as stale= says");
	field_scan(&f, 1010 * MS + 1);
	CHECK_AS(field_quality(&f, 1) == QUALITY_STALE && field_get(&f, 1).i == -7,
		 "then it is stale, and keeps its value");
	CHECK_AS(field_get(&f, 2).i == 1, "… or has its substitute");
	CHECK(channels_tally(f.hal.channels).stale == 3);
	channels_put(f.hal.channels, 1, INT(8), true, 1100 * MS);
	field_scan(&f, 1100 * MS);
	CHECK(field_quality(&f, 1) == QUALITY_GOOD && field_get(&f, 1).i == 8);
	for (int i = 0; i < 2; i++)
		channels_put(f.hal.channels, 1, INT(0), false, 1110 * MS);
	field_scan(&f, 1110 * MS);
	CHECK_AS(field_quality(&f, 1) == QUALITY_GOOD, "two reads may fail");
	channels_put(f.hal.channels, 1, INT(0), false, 1120 * MS);
	field_scan(&f, 1120 * MS);
	CHECK_AS(field_quality(&f, 1) == QUALITY_FAULT && field_get(&f, 1).i == 8, "the third is a fault");
	channels_put(f.hal.channels, 1, INT(9), true, 1130 * MS);
	field_scan(&f, 1130 * MS);
	CHECK_AS(field_quality(&f, 1) == QUALITY_GOOD && field_get(&f, 1).i == 9, "a good read ends it");
	channels_put(f.hal.channels, 0, INT(1201), true, 1140 * MS);
	field_scan(&f, 1140 * MS);
	CHECK_AS(field_quality(&f, 0) == QUALITY_FAULT && field_get(&f, 0).i == 50,
		 "a value outside of its limits is a fault at once");
	channels_put(f.hal.channels, 0, INT(1200), true, 1150 * MS);
	field_scan(&f, 1150 * MS);
	CHECK(field_quality(&f, 0) == QUALITY_GOOD && field_get(&f, 0).i == 120);
	channels_alone(f.hal.channels, DRIVER_modbus);
	field_scan(&f, 1160 * MS);
	CHECK_AS(field_quality(&f, 0) == QUALITY_STALE && field_quality(&f, 1) == QUALITY_STALE,
		 "without its gateway a point is stale at once");
	CHECK(field_quality(&f, 99) == QUALITY_GOOD && field_quality(&f, -1) == QUALITY_GOOD);
	field_end(&f);
}

static void test_filter_and_threshold(void)
{
	struct field f;
	struct io_channel *channel;

	field_begin(&f);
	channel = field_add(&f, "%ID0", DRIVER_peer, IEC_REAL);
	channel->filter_ns = 90 * MS;
	channel = field_add(&f, "%IX8.0", DRIVER_peer, IEC_BOOL);
	channel->raw = IEC_REAL;
	channel->switches = true, channel->on_at = 8, channel->off_below = 2;
	channel = field_add(&f, "%IX8.1", DRIVER_peer, IEC_BOOL);
	f.point[2].active_low = true;
	CHECK(field_open(&f));
	channels_put(f.hal.channels, 0, REAL(10), true, 0);
	field_scan(&f, 0);
	CHECK_AS(field_get(&f, 0).r == 10, "the first value is not filtered");
	channels_put(f.hal.channels, 0, REAL(20), true, 10 * MS);
	field_scan(&f, 10 * MS);
	CHECK_AS(field_get(&f, 0).r == 11, "10 ms of 90 ms: a tenth of the way");
	field_scan(&f, 20 * MS);
	CHECK(fabs(field_get(&f, 0).r - 11.9) < 1e-6);
	for (int i = 3; i < 90; i++)
		field_scan(&f, i * 10 * MS);
	CHECK(field_get(&f, 0).r > 19.9 && field_get(&f, 0).r < 20);
	for (int i = 0; i < 9; i++) {
		static const struct { double value; int bit; } steps[] = {
			{ 7.9, 0 }, { 8, 1 }, { 5, 1 }, { 2, 1 }, { 1.9, 0 }, { 7, 0 }, { 9, 1 }, { 2.1, 1 },
			{ -5, 0 } };
		channels_put(f.hal.channels, 1, REAL(steps[i].value), true, 900 * MS);
		field_scan(&f, 900 * MS);
		CHECK_AS(field_get(&f, 1).i == steps[i].bit, "between both thresholds a bit stays");
	}
	channels_put(f.hal.channels, 2, INT(0), true, 900 * MS);
	field_scan(&f, 900 * MS);
	CHECK(field_get(&f, 2).i == 1);
	field_end(&f);
}

static void test_outputs_of_a_gateway(void)
{
	struct field f;
	struct io_channel *channel;
	uint32_t serial, before;

	field_begin(&f);
	channel = field_add(&f, "%QW0", DRIVER_modbus, IEC_INT);
	channel->safe.i = 7;
	field_add(&f, "%QW2", DRIVER_modbus, IEC_WORD);
	f.point[1].hold = true;
	channel = field_add(&f, "%QL8", DRIVER_modbus, IEC_LINT);
	channel = field_add(&f, "%QD16", DRIVER_modbus, IEC_REAL);
	channel->raw = IEC_INT, channel->scaled = true, channel->value_high = 10, channel->at_high = 1000;
	CHECK(field_open(&f));
	channels_get(f.hal.channels, 0, &serial);
	CHECK_AS(serial == 0, "before the first scan there is nothing to write");
	field_set(&f, 0, INT(-1234));
	field_set(&f, 1, INT(0xbeef));
	field_set(&f, 2, INT(INT64_MAX - 1));
	field_set(&f, 3, REAL(2.5));
	field_scan(&f, 0);
	CHECK(channels_get(f.hal.channels, 0, &serial).i == -1234 && serial == 1);
	CHECK(channels_get(f.hal.channels, 1, &serial).i == 0xbeef);
	CHECK_AS(channels_get(f.hal.channels, 2, &serial).i == INT64_MAX - 1, "64 bits are exact");
	CHECK(channels_get(f.hal.channels, 3, &serial).i == 250);
	CHECK_AS(field_quality(&f, 0) == QUALITY_STALE, "an output that nobody has written is stale");
	channels_put(f.hal.channels, 0, INT(0), true, 0);
	for (int i = 1; i < 300; i++)
		field_scan(&f, i * 10 * MS);
	CHECK_AS((channels_get(f.hal.channels, 0, &serial), serial == 1), "the serial tells changes only");
	CHECK(field_quality(&f, 0) == QUALITY_GOOD);
	before = serial;
	CHECK(hal_write_safe(&f.hal));
	CHECK(channels_get(f.hal.channels, 0, &serial).i == 7 && serial > before);
	CHECK_AS(channels_get(f.hal.channels, 1, &serial).i == 0xbeef, "with safe=hold it keeps its value");
	CHECK(channels_get(f.hal.channels, 3, &serial).i == 0);
	field_set(&f, 0, INT(5));
	field_scan(&f, 3000 * MS);
	CHECK_AS(channels_get(f.hal.channels, 0, &serial).i == 7, "held outputs do not change");
	before = serial;
	hal_release(&f.hal);
	field_scan(&f, 3010 * MS);
	CHECK(channels_get(f.hal.channels, 0, &serial).i == 5 && serial > before);
	for (int i = 0; i < 3; i++)
		channels_put(f.hal.channels, 0, INT(0), false, 0);
	CHECK_AS(field_scan(&f, 3020 * MS) && field_quality(&f, 0) == QUALITY_FAULT,
		 "an output that cannot be written is a fault of the channel, not of the program");
	field_end(&f);
}

/* Values of sim are in memory: one that nobody puts there stays as it is in the image. */
static void test_simulated(void)
{
	struct field f;

	field_begin(&f);
	field_add(&f, "%IW0", DRIVER_sim, IEC_INT);
	field_add(&f, "%QW0", DRIVER_sim, IEC_INT);
	CHECK(field_open(&f));
	field_set(&f, 0, INT(5));
	field_scan(&f, 0);
	field_scan(&f, 5000 * MS);
	CHECK(field_get(&f, 0).i == 5 && hal_worst(&f.hal) == QUALITY_GOOD);
	channels_put(f.hal.channels, 0, INT(6), true, 0);
	field_scan(&f, 9000 * MS);
	CHECK(field_get(&f, 0).i == 6 && hal_worst(&f.hal) == QUALITY_GOOD);
	field_end(&f);
}

/* An input that a block asks for has no age; it is good until an answer is not. So is such an output. */
static void test_asked(void)
{
	struct field f;

	field_begin(&f);
	field_add(&f, "%IW0", DRIVER_modbus, IEC_INT)->ask = 1;
	field_add(&f, "%QW0", DRIVER_modbus, IEC_INT)->ask = 1;
	field_add(&f, "%QX4.0", DRIVER_modbus, IEC_BOOL);
	f.point[2].active_low = true;
	CHECK(field_open(&f) && field_scan(&f, 0));
	CHECK_AS(field_quality(&f, 0) == QUALITY_GOOD && field_quality(&f, 1) == QUALITY_GOOD,
		 "nobody has asked yet: nothing is wrong");
	channels_put(f.hal.channels, 0, INT(7), true, 0);
	channels_put(f.hal.channels, 1, INT(0), true, 0);
	field_scan(&f, 100 * INT64_C(1000) * MS);
	CHECK_AS(field_quality(&f, 0) == QUALITY_GOOD && field_get(&f, 0).i == 7, "an old answer is an answer");
	channels_put(f.hal.channels, 0, INT(0), false, 0);
	channels_put(f.hal.channels, 1, INT(0), false, 0);
	field_scan(&f, 100 * INT64_C(1000) * MS);
	CHECK_AS(field_quality(&f, 0) == QUALITY_FAULT && field_quality(&f, 1) == QUALITY_FAULT, "one bad answer is a fault");
	CHECK(field_get(&f, 0).i == 7);
	CHECK_AS(channels_get(f.hal.channels, 2, &(uint32_t){ 0 }).i == 1, "a bit that is active low is sent the other way round");
	field_set(&f, 2, INT(1));
	field_scan(&f, 100 * INT64_C(1001) * MS);
	CHECK(channels_get(f.hal.channels, 2, &(uint32_t){ 0 }).i == 0);
	/* What is no point of a gateway is left alone. */
	channels_put(f.hal.channels, 99, INT(1), true, 0);
	channels_put(f.hal.channels, -1, INT(1), true, 0);
	channels_put(NULL, 0, INT(1), true, 0);
	CHECK(channels_get(f.hal.channels, 0, &(uint32_t){ 0 }).i == 0 && channels_get(f.hal.channels, 99, &(uint32_t){ 0 }).i == 0 &&
	      channels_get(NULL, 0, &(uint32_t){ 0 }).i == 0);
	channels_alone(NULL, DRIVER_modbus);
	channels_alone(f.hal.channels, DRIVER_peer);
	channels_put(f.hal.channels, 0, INT(8), true, 0);
	field_scan(&f, 100 * INT64_C(1002) * MS);
	CHECK_AS(field_get(&f, 0).i == 8 && field_quality(&f, 0) == QUALITY_GOOD, "another gateway's absence is none of its");
	field_end(&f);
}

/* A bit: whether all are good; else the worst of them. */
static void test_told_quality(void)
{
	struct field f;
	struct io_channel *channel;

	field_begin(&f);
	channel = field_add(&f, "%IX30.0", DRIVER_quality, IEC_BOOL);
	iec_addr_parse("%IW0", 4, &channel->of), channel->of_bits = 16;
	channel = field_add(&f, "%IB31", DRIVER_quality, IEC_USINT);
	iec_addr_parse("%IW0", 4, &channel->of), channel->of_bits = 32;
	field_add(&f, "%IW0", DRIVER_modbus, IEC_INT);
	field_add(&f, "%IW2", DRIVER_modbus, IEC_INT);
	field_add(&f, "%IW4", DRIVER_modbus, IEC_INT);
	channel = field_add(&f, "%ID36", DRIVER_quality, IEC_REAL);
	iec_addr_parse("%IW0", 4, &channel->of), channel->of_bits = 32;
	CHECK(field_open(&f));
	channels_put(f.hal.channels, 2, INT(1), true, 0);
	channels_put(f.hal.channels, 3, INT(1), true, 0);
	field_scan(&f, 0);
	CHECK(field_get(&f, 0).i == 1 && field_get(&f, 1).i == 0 && hal_worst(&f.hal) == QUALITY_STALE);
	for (int i = 0; i < 3; i++)
		channels_put(f.hal.channels, 3, INT(1), false, 0);
	field_scan(&f, 0);
	CHECK(field_get(&f, 0).i == 1 && field_get(&f, 1).i == 2);
	CHECK_AS(field_get(&f, 5).r == 2, "as=REAL: the same number");
	field_scan(&f, 1001 * MS);
	CHECK(field_get(&f, 0).i == 0 && field_get(&f, 1).i == 2);
	field_end(&f);
}

static struct location located(const struct field *f, const char *text)
{
	struct iec_addr addr;

	iec_addr_parse(text, strlen(text), &addr);
	return image_locate(&f->image, addr);
}

/* A value that a person holds does not depend on its device, and is told as forced, also if only a part of it is held. */
static void test_told_forces(void)
{
	static const struct { const char *force, *as; int64_t bit, byte; } rows[] = {
		{ NULL, "the second one is in fault", 1, 2 },
		{ "%IW0", "a force beside a fault", 1, 2 },
		{ "%IW2", "the force takes the place of the fault", 1, 3 },
		{ "%IX3.7", "a bit of it", 1, 3 },
		{ "%IB4", "another value", 1, 2 },
		{ "%MW0", "another area", 1, 2 },
	};
	struct field f;
	struct io_channel *channel;

	field_begin(&f);
	channel = field_add(&f, "%IX30.0", DRIVER_quality, IEC_BOOL);
	iec_addr_parse("%IW0", 4, &channel->of), channel->of_bits = 16;
	channel = field_add(&f, "%IB31", DRIVER_quality, IEC_USINT);
	iec_addr_parse("%IW0", 4, &channel->of), channel->of_bits = 32;
	field_add(&f, "%IW0", DRIVER_modbus, IEC_INT);
	field_add(&f, "%IW2", DRIVER_modbus, IEC_INT);
	CHECK(field_open(&f));
	channels_put(f.hal.channels, 2, INT(1), true, 0);
	for (int i = 0; i < 3; i++)
		channels_put(f.hal.channels, 3, INT(1), false, 0);
	for (size_t i = 0; i < sizeof(rows) / sizeof(*rows); i++) {
		if (rows[i].force)
			CHECK(image_force(&f.image, located(&f, rows[i].force), (union iec_value){ .i = 1 }));
		field_scan(&f, 0);
		CHECK_AS(field_get(&f, 0).i == rows[i].bit && field_get(&f, 1).i == rows[i].byte, rows[i].as);
		if (rows[i].force)
			image_unforce(&f.image, located(&f, rows[i].force));
	}
	/* A bit is FALSE for a fault, and TRUE for a value that is held in its place. */
	for (int i = 0; i < 3; i++)
		channels_put(f.hal.channels, 2, INT(1), false, 0);
	field_scan(&f, 0);
	CHECK(field_get(&f, 0).i == 0);
	image_force(&f.image, located(&f, "%IW0"), (union iec_value){ .i = 1 });
	field_scan(&f, 0);
	CHECK(field_get(&f, 0).i == 1 && hal_worst(&f.hal) == QUALITY_FAULT);
	field_end(&f);
}

/* A gateway's thread puts and gets while scans run, outputs become safe and are released. */
static void *be_gateway(void *of)
{
	struct channels *channels = of;
	uint32_t serial, last = 0;
	intptr_t wrong = 0;

	for (int i = 1; i <= 20000; i++) {
		const int64_t value = channels_get(channels, 1, &serial).i;

		channels_put(channels, 0, INT(i % 1000), true, now());
		channels_put(channels, 1, INT(0), true, 0);
		wrong += serial < last || value < -1 || value > 999;
		last = serial;
	}
	return (void *)wrong;
}

static void test_gateway_beside(void)
{
	struct field f;
	pthread_t gateway;
	void *wrong = NULL;
	int bad = 0;
	uint32_t serial;

	field_begin(&f);
	field_add(&f, "%IW0", DRIVER_modbus, IEC_INT);
	field_add(&f, "%QW0", DRIVER_modbus, IEC_INT)->safe.i = -1;
	CHECK(field_open(&f));
	pthread_create(&gateway, NULL, be_gateway, f.hal.channels);
	for (int i = 0; i < 5000; i++) {
		field_set(&f, 1, INT(i % 1000));
		bad += !field_scan(&f, now()) || field_get(&f, 0).i < 0 || field_get(&f, 0).i > 999;
		if (i % 100 == 50)
			hal_write_safe(&f.hal);
		else if (i % 100 == 60)
			hal_release(&f.hal);
	}
	pthread_join(gateway, &wrong);
	CHECK(!bad && !wrong && channels_get(f.hal.channels, 1, &serial).i == 999);
	hal_write_safe(&f.hal);
	CHECK(channels_get(f.hal.channels, 1, &serial).i == -1);
	field_end(&f);
}

/* ---- another map ---- */

static void test_exchange(void)
{
	struct field f, g;
	char line[LIMIT_ARG];
	uint32_t serial;

	field_begin(&f);
	field_add(&f, "%IW0", DRIVER_modbus, IEC_INT)->reg = 4;
	field_add(&f, "%QW0", DRIVER_modbus, IEC_INT);
	field_add(&f, "%QW2", DRIVER_modbus, IEC_INT)->safe.i = 3;
	CHECK(field_open(&f));
	channels_put(f.hal.channels, 0, INT(11), true, 0);
	field_set(&f, 1, INT(21));
	field_set(&f, 2, INT(22));
	field_scan(&f, 0);
	field_begin(&g);
	field_add(&g, "%QW0", DRIVER_modbus, IEC_INT);
	field_add(&g, "%IW0", DRIVER_modbus, IEC_INT)->reg = 4;
	field_add(&g, "%IW2", DRIVER_modbus, IEC_INT)->reg = 5;
	CHECK(hal_beside(&g.hal, &f.hal, &g.map, &g.arena, &g.diags, line) == BESIDE_GOOD);
	CHECK(hal_open_new(&g.hal, &g.diags));
	hal_exchange(&f.hal, &g.hal);
	CHECK_AS(channels_get(f.hal.channels, 0, &serial).i == 21 && serial == 1,
		 "an output of both maps goes on without a change");
	ReadPhysicalInputs(&f.hal, &f.image, 10 * MS);
	CHECK_AS(field_get(&f, 0).i == 11 && field_quality(&f, 1) == QUALITY_GOOD,
		 "an input of both maps keeps its value");
	CHECK(field_quality(&f, 2) == QUALITY_STALE);
	hal_exchange(&f.hal, &g.hal);
	field_scan(&f, 20 * MS);
	CHECK_AS(channels_get(f.hal.channels, 1, &serial).i == 21 && field_get(&f, 0).i == 11, "and back");
	CHECK(channels_get(f.hal.channels, 2, &serial).i == 22 && serial > 1);
	hal_close_rest(&g.hal);
	arena_free(&g.arena);
	field_scan(&f, 30 * MS);
	CHECK(field_quality(&f, 0) == QUALITY_GOOD);
	field_end(&f);
}

/* A point of another map goes on with its value if it is the same in all that names its register. */
static void test_same(void)
{
	enum { SAME, AREA, BYTE, BIT, BITS, UNIT, TABLE, REGISTER, RAW, DEVICE, NAME, DRIVER, OTHERS };

	for (int other = SAME; other < OTHERS; other++) {
		struct field f, g;
		struct io_channel *channel;
		char line[LIMIT_ARG], as[40];

		field_begin(&f);
		field_begin(&g);
		for (int i = 0; i < 2; i++) {
			channel = field_add(i ? &g : &f, "%IX4.0", DRIVER_modbus, IEC_BOOL);
			channel->unit_id = 1, channel->reg = 7, channel->table = TABLE_DISCRETE_INPUT;
			channel->device = "plant", channel->name = "Level";
		}
		switch (other) {
		case AREA: g.point[0].addr.area = AREA_XI; break;
		case BYTE: g.point[0].addr.byte = 5; break;
		case BIT: g.point[0].addr.bit = 1; break;
		case BITS: g.point[0].addr.bits = 8; break;
		case UNIT: channel->unit_id = 2; break;
		case TABLE: channel->table = TABLE_COIL; break;
		case REGISTER: channel->reg = 8; break;
		case RAW: channel->raw = IEC_WORD; break;
		case DEVICE: channel->device = "yard"; break;
		case NAME: channel->name = "Flow"; break;
		case DRIVER: g.point[0].driver = DRIVER_peer; break;
		}
		CHECK(field_open(&f));
		channels_put(f.hal.channels, 0, INT(1), true, 0);
		CHECK(hal_beside(&g.hal, &f.hal, &g.map, &g.arena, &g.diags, line) == BESIDE_GOOD);
		CHECK(hal_open_new(&g.hal, &g.diags));
		hal_exchange(&f.hal, &g.hal);
		ReadPhysicalInputs(&f.hal, &f.image, 10 * MS);
		snprintf(as, sizeof(as), "point with another property %d", other);
		CHECK_AS((field_quality(&f, 0) == QUALITY_GOOD) == (other == SAME), as);
		hal_close_rest(&g.hal);
		arena_free(&g.arena);
		field_end(&f);
	}
}

/* ---- 1-wire ---- */

#define SENSOR "bus/w1/devices/28-000005e2fdc3"

static struct io_channel *add_sensor(struct field *f, const char *address, const char *sensor)
{
	struct io_channel *channel = field_add(f, address, DRIVER_w1, IEC_REAL);

	channel->device = sensor;
	channel->unit = UNIT_CELSIUS;
	channel->stale_ns = 300 * MS;
	return channel;
}

static bool near(double a, double b)
{
	return fabs(a - b) < 1e-4;
}

static void test_w1(void)
{
	struct field f;

	sys_put(SENSOR "/w1_slave", "2b 00 4b 46 ff ff 0d 10 a1 : crc=a1 YES\n"
		"2b 00 4b 46 ff ff 0d 10 a1 t=-1062\n");
	sys_put("bus/w1/devices/28-1/temperature", "21437\n");
	field_begin(&f);
	add_sensor(&f, "%ID0", "28-000005e2fdc3");
	add_sensor(&f, "%ID4", "28-1")->substituted = true;
	f.channel[1].substitute.r = -99;
	CHECK(field_open(&f));
	CHECK_AS(field_scan(&f, now()) && near(field_get(&f, 0).r, -1.062) && near(field_get(&f, 1).r, 21.437),
		 "the first scan has the values");
	CHECK(UNTIL(&f, hal_worst(&f.hal) == QUALITY_GOOD, 9000));
	sys_put(SENSOR "/w1_slave", "2b 00 4b 46 ff ff 0d 10 00 : crc=a1 NO\n2b 00 t=21000\n");
	CHECK_AS(UNTIL(&f, field_quality(&f, 0) != QUALITY_GOOD, 9000) && near(field_get(&f, 0).r, -1.062),
		 "a wrong checksum is no value");
	CHECK(UNTIL(&f, field_quality(&f, 1) == QUALITY_GOOD, 9000));
	sys_put(SENSOR "/w1_slave", "2b : crc=a1 YES\n2b t=21000\n");
	CHECK(UNTIL(&f, field_quality(&f, 0) == QUALITY_GOOD && near(field_get(&f, 0).r, 21), 9000));
	sys_put("bus/w1/devices/28-1/temperature", "85000\n");
	CHECK_AS(UNTIL(&f, field_quality(&f, 1) == QUALITY_FAULT, 9000) && near(field_get(&f, 1).r, -99),
		 "85 °C of a sensor that has lost its power is no value");
	sys_put("bus/w1/devices/28-1/temperature", "84500\n");
	CHECK(UNTIL(&f, near(field_get(&f, 1).r, 84.5), 9000));
	sys_put("bus/w1/devices/28-1/temperature", "85000\n");
	CHECK_AS(UNTIL(&f, near(field_get(&f, 1).r, 85), 9000), "85 °C near 84.5 °C is one");
	sys_put("bus/w1/devices/28-1/temperature", "");
	CHECK_AS(UNTIL(&f, field_quality(&f, 1) == QUALITY_FAULT, 9000), "an empty file");
	sys_put("bus/w1/devices/28-1/temperature", "nonsense\n");
	nap(100);
	CHECK(UNTIL(&f, field_quality(&f, 1) == QUALITY_FAULT, 9000));
	sys_remove("bus/w1/devices/28-1");
	nap(100);
	CHECK_AS(UNTIL(&f, field_quality(&f, 1) == QUALITY_FAULT, 9000), "a sensor that is removed");
	sys_put("bus/w1/devices/28-1/temperature", "20000\n");
	CHECK_AS(UNTIL(&f, near(field_get(&f, 1).r, 20), 9000), "it comes back");
	field_end(&f);
}

/* A read of the kernel that takes 3 s is a FIFO into which nobody writes. */
static void test_slow_device(void)
{
	struct field f;
	int64_t longest_ns = 0, end_ns;
	int writer, updates = 0;
	float last = 0;

	sys_remove(SENSOR);
	sys_put("bus/w1/devices/28-1/temperature", "20000\n");
	sys_put(SENSOR "/temperature", "10000\n");
	field_begin(&f);
	add_sensor(&f, "%ID0", "28-000005e2fdc3");
	add_sensor(&f, "%ID4", "28-1");
	CHECK(field_open(&f) && UNTIL(&f, field_quality(&f, 0) == QUALITY_GOOD, 9000));
	unlink(sys_path(SENSOR "/temperature"));
	mkfifo(sys_path(SENSOR "/temperature"), 0644);
	end_ns = now() + 3000 * MS;
	for (int i = 0; now() < end_ns; i++) {
		char text[20];
		int64_t began_ns = now();

		field_scan(&f, began_ns);
		longest_ns = now() - began_ns > longest_ns ? now() - began_ns : longest_ns;
		updates += (float)field_get(&f, 1).r != last;
		last = (float)field_get(&f, 1).r;
		if (i % 10 == 0) {
			snprintf(text, sizeof(text), "%d\n", 20000 + i);
			sys_put("bus/w1/devices/28-1/temperature", text);
		}
		if (end_ns - now() < 2000 * MS && field_quality(&f, 0) != QUALITY_STALE)
			break;
		nap(1);
	}
	CHECK_AS(now() >= end_ns, "a device that does not answer is stale after its time");
	CHECK_AS(longest_ns < 1000 * MS, "no scan waits for it");
	CHECK_AS(updates > 5 && UNTIL(&f, field_quality(&f, 1) == QUALITY_GOOD, 9000), "another sensor goes on");
	CHECK(near(field_get(&f, 0).r, 10));
	writer = open(sys_path(SENSOR "/temperature"), O_WRONLY);
	CHECK(writer >= 0 && write(writer, "11000\n", 6) == 6);
	unlink(sys_path(SENSOR "/temperature"));
	sys_put(SENSOR "/temperature", "11000\n");
	close(writer);
	CHECK_AS(UNTIL(&f, field_quality(&f, 0) == QUALITY_GOOD && near(field_get(&f, 0).r, 11), 9000),
		 "when it answers, it is good again");
	field_end(&f);
}

/* Each sensor has a thread, until there are too many. */
static void test_many_sensors(void)
{
	struct field f;
	bool right = true, good = true;
	static char name[70][24];
	char path[80], text[20];

	field_begin(&f);
	for (int i = 0; i < 70; i++) {
		snprintf(name[i], sizeof(name[i]), "28-%d", i);
		snprintf(path, sizeof(path), "bus/w1/devices/28-%d/temperature", i);
		snprintf(text, sizeof(text), "%d\n", 1000 * i);
		sys_put(path, text);
		snprintf(text, sizeof(text), "%%ID%d", 4 * i);
		add_sensor(&f, text, name[i])->stale_ns = IO_STALE_NS;
	}
	CHECK(field_open(&f));
	for (int i = 0; i < 70; i++)
		good = UNTIL(&f, field_quality(&f, i) == QUALITY_GOOD, 9000) && good;
	for (int i = 0; i < 70; i++)
		right = right && near(field_get(&f, i).r, i);
	CHECK_AS(good && right, "seventy sensors have seventy values");
	field_end(&f);
	sys_remove("bus/w1");
}

/* Sensors of a bus measure one after the other: a map that says no stale= gives them time for that. */
static void test_time_of_sensors(void)
{
	struct field f;
	int64_t at_ns;

	sys_put("bus/w1/devices/28-1/temperature", "20000\n");
	sys_put("bus/w1/devices/28-2/temperature", "20000\n");
	field_begin(&f);
	add_sensor(&f, "%ID0", "28-1")->stale_ns = IO_STALE_NS;
	add_sensor(&f, "%ID4", "28-2")->stale_ns = 700 * MS;
	f.channel[0].poll_ns = f.channel[1].poll_ns = 600 * 1000 * MS;
	at_ns = now();
	CHECK(field_open(&f));
	field_scan(&f, at_ns + INT64_C(3) * IO_STALE_NS);
	CHECK_AS(field_quality(&f, 0) == QUALITY_GOOD, "two sensors have four times the usual time");
	CHECK_AS(field_quality(&f, 1) == QUALITY_STALE, "stale= of the map is obeyed");
	field_scan(&f, now() + INT64_C(5) * IO_STALE_NS);
	CHECK(field_quality(&f, 0) == QUALITY_STALE);
	field_end(&f);
	sys_remove("bus/w1");
}

/* A thread that never comes back holds up no end. */
static void test_hung_device(void)
{
	struct field f;
	int64_t began_ns;
	int writer;

	sys_remove(SENSOR);
	mkdir(sys_path(SENSOR), 0755);
	mkfifo(sys_path(SENSOR "/temperature"), 0644);
	field_begin(&f);
	add_sensor(&f, "%ID0", "28-000005e2fdc3");
	began_ns = now();
	CHECK_AS(field_open(&f) && now() - began_ns < 9000 * MS, "a device that hangs does not hold up the start");
	field_scan(&f, now());
	CHECK(field_quality(&f, 0) == QUALITY_STALE);
	began_ns = now();
	field_end(&f);
	CHECK_AS(now() - began_ns < 9000 * MS, "… nor the end");
	writer = open(sys_path(SENSOR "/temperature"), O_WRONLY);
	close(writer);
	nap(500); /* its thread frees what it holds */
	sys_remove(SENSOR);
}

/* ---- pwm ---- */

#define CHIP "class/pwm/pwmchip0"

static void make_chip(void)
{
	sys_remove("class/pwm");
	sys_put(CHIP "/npwm", "4\n");
	sys_put(CHIP "/export", "");
	sys_put(CHIP "/pwm1/duty_cycle", "0");
	sys_put(CHIP "/pwm1/period", "0");
	sys_put(CHIP "/pwm1/enable", "0");
	sys_put(CHIP "/pwm1/polarity", "normal\n");
}

static struct io_channel *add_pwm(struct field *f, const char *address, uint32_t number)
{
	struct io_channel *channel = field_add(f, address, DRIVER_pwm, IEC_INT);

	channel->device = "pwmchip0";
	channel->number = number;
	channel->unit = UNIT_PERCENT;
	channel->scaled = true, channel->value_high = 27648, channel->at_high = 100;
	return channel;
}

/* The file keeps the end of a longer number, because a test's file is no file of the kernel. */
static long duty(void)
{
	char text[9] = "";
	FILE *file = fopen(sys_path(CHIP "/pwm1/duty_cycle"), "r");

	if (!file)
		return -1;
	if (!fgets(text, sizeof(text), file))
		text[0] = '\0';
	fclose(file);
	return strtol(text, NULL, 10);
}

static void test_pwm(void)
{
	struct field f;

	make_chip();
	field_begin(&f);
	add_pwm(&f, "%QW0", 1)->safe.i = 13824;
	f.point[0].active_low = true;
	CHECK(field_open(&f));
	CHECK(sys_get(CHIP "/pwm1/period") == 20000000 && sys_get(CHIP "/pwm1/enable") == 1);
	CHECK_AS(duty() == 10000000, "it begins with its safe value");
	CHECK(sysfs_read(sys_path(CHIP "/pwm1/polarity"), f.text, sizeof(f.text)) == 0);
	CHECK_TEXT(f.text, "inversed");
	field_set(&f, 0, INT(27648));
	CHECK(UNTIL(&f, duty() == 20000000, 9000));
	CHECK(field_quality(&f, 0) == QUALITY_GOOD && hal_worst(&f.hal) == QUALITY_GOOD);
	field_set(&f, 0, INT(32767));
	UNTIL(&f, false, 20);
	CHECK_AS(duty() == 20000000, "never more than its period");
	sys_put(CHIP "/pwm1/duty_cycle", "7");
	CHECK_AS(UNTIL(&f, duty() == 20000000, 9000), "an output is refreshed");
	CHECK(hal_write_safe(&f.hal));
	CHECK_AS(duty() == 10000000, "the safe value is written at once");
	field_scan(&f, now());
	nap(30);
	CHECK(duty() == 10000000);
	hal_release(&f.hal);
	CHECK(UNTIL(&f, duty() == 20000000, 9000));
	hal_close(&f.hal);
	CHECK_AS(duty() == 10000000, "at the end it has its safe value");
	arena_free(&f.arena);
}

/* As of a PCA9685 on I2C. */
static void test_pwm_names(void)
{
	static const char *const names[] = { "pwmchip0", "1-0040", "pca9685", "pca9685-pwm" };

	make_chip();
	sys_put("devices/1-0040/name", "pca9685\n");
	sys_put("bus/i2c/drivers/pca9685-pwm/bind", "");
	CHECK(symlink("../../../devices/1-0040", sys_path(CHIP "/device")) == 0);
	CHECK(symlink("../../bus/i2c/drivers/pca9685-pwm", sys_path("devices/1-0040/driver")) == 0);
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
		struct field f;

		field_begin(&f);
		add_pwm(&f, "%QW0", 1)->device = names[i];
		CHECK_AS(hal_check(&f.map, &f.arena, &f.diags), names[i]);
		field_end(&f);
	}
	sys_remove("devices");
}

/* The kernel makes the folder of a channel when it is exported. */
static void *play_kernel(void *unused)
{
	(void)unused;
	for (int i = 0; i < 1000 && sys_get(CHIP "/export") != 2; i++)
		nap(2);
	sys_put(CHIP "/pwm2/period", "0");
	sys_put(CHIP "/pwm2/enable", "0");
	sys_put(CHIP "/pwm2/duty_cycle", "0");
	return NULL;
}

static void test_pwm_export(void)
{
	struct field f;
	pthread_t kernel;

	make_chip();
	field_begin(&f);
	add_pwm(&f, "%QW0", 2);
	pthread_create(&kernel, NULL, play_kernel, NULL);
	CHECK(field_open(&f));
	pthread_join(kernel, NULL);
	CHECK(sys_get(CHIP "/pwm2/period") == 20000000 && sys_get(CHIP "/pwm2/enable") == 1);
	field_end(&f);
}

static void test_pwm_goes_on(void)
{
	struct field f, g;
	char line[LIMIT_ARG] = "";

	make_chip();
	field_begin(&f);
	add_pwm(&f, "%QW0", 1)->safe.i = 13824;
	CHECK(field_open(&f));
	field_set(&f, 0, INT(27648));
	CHECK(UNTIL(&f, duty() == 20000000, 9000));
	sys_put(CHIP "/pwm1/enable", "0");
	field_begin(&g);
	add_pwm(&g, "%QW8", 1)->safe.i = 13824;
	CHECK(hal_beside(&g.hal, &f.hal, &g.map, &g.arena, &g.diags, line) == BESIDE_GOOD);
	CHECK(hal_open_new(&g.hal, &g.diags) && duty() == 20000000);
	hal_exchange(&f.hal, &g.hal);
	hal_close_rest(&g.hal);
	arena_free(&g.arena);
	CHECK_AS(duty() == 20000000, "an output of both maps keeps its level");
	CHECK_AS(sys_get(CHIP "/pwm1/enable") == 0, "nothing is set anew");
	f.point[0].addr.byte = 8;
	field_set(&f, 0, INT(0));
	f.channel[0].type = IEC_INT;
	CHECK_AS(UNTIL(&f, duty() == 0, 9000), "and has the values of the new map");
	field_begin(&g);
	add_pwm(&g, "%QW8", 1)->period_ns = 10 * MS;
	CHECK_AS(hal_beside(&g.hal, &f.hal, &g.map, &g.arena, &g.diags, line) == BESIDE_RESTART,
		 "another period needs a restart");
	CHECK_TEXT(line, "pwmchip0");
	arena_free(&g.arena);
	field_begin(&g);
	CHECK(hal_beside(&g.hal, &f.hal, &g.map, &g.arena, &g.diags, line) == BESIDE_GOOD);
	CHECK(hal_open_new(&g.hal, &g.diags));
	hal_exchange(&f.hal, &g.hal);
	hal_close_rest(&g.hal);
	arena_free(&g.arena);
	CHECK_AS(duty() == 10000000, "an output that the new map does not have is safe");
	field_end(&f);
}

/* ---- hwmon ---- */

static void test_hwmon(void)
{
	struct field f;
	struct io_channel *channel;

	sys_put("class/hwmon/hwmon0/name", "cpu_thermal\n");
	sys_put("class/hwmon/hwmon0/temp1_input", "48312\n");
	sys_put("class/hwmon/hwmon1/name", "ina219\n");
	sys_put("class/hwmon/hwmon1/in1_input", "11984\n");
	sys_put("class/hwmon/hwmon1/curr1_input", "-250\n");
	sys_put("class/hwmon/hwmon2/name", "fan\n");
	sys_put("class/hwmon/hwmon2/pwm1", "0\n");
	sys_put("class/hwmon/hwmon2/pwm1_enable", "2\n");
	field_begin(&f);
	channel = field_add(&f, "%ID0", DRIVER_hwmon, IEC_REAL);
	channel->device = "cpu_thermal", channel->name = "temp1";
	channel = field_add(&f, "%ID4", DRIVER_hwmon, IEC_REAL);
	channel->device = "hwmon1", channel->name = "in1";
	channel = field_add(&f, "%ID8", DRIVER_hwmon, IEC_REAL);
	channel->device = "ina219", channel->name = "curr1";
	channel = field_add(&f, "%QW0", DRIVER_hwmon, IEC_REAL);
	f.point[3].addr.bits = 32;
	channel->device = "fan", channel->name = "pwm1";
	channel = field_add(&f, "%IW12", DRIVER_hwmon, IEC_INT);
	channel->device = "ina219", channel->name = "in1";
	CHECK(field_open(&f) && field_scan(&f, now()));
	CHECK(near(field_get(&f, 0).r, 48.312) && near(field_get(&f, 1).r, 11.984) &&
	      near(field_get(&f, 2).r, -0.25));
	CHECK_AS(field_get(&f, 4).i == 11984, "without a range a whole number is that of the device");
	field_set(&f, 3, REAL(100));
	CHECK(UNTIL(&f, sys_get("class/hwmon/hwmon2/pwm1") == 255, 9000));
	CHECK(sys_get("class/hwmon/hwmon2/pwm1_enable") == 1);
	/* It comes back with another number. */
	sys_remove("class/hwmon/hwmon0");
	CHECK(UNTIL(&f, field_quality(&f, 0) == QUALITY_FAULT, 9000));
	sys_put("class/hwmon/hwmon7/temp1_input", "50000\n");
	sys_put("class/hwmon/hwmon7/name", "cpu_thermal\n");
	CHECK_AS(UNTIL(&f, near(field_get(&f, 0).r, 50), 9000), "a device is found again by its name");
	field_end(&f);
}

/* ---- outputs whose device fails or goes ---- */

#define FAN "class/hwmon/hwmon2/"

static void make_fan(struct field *f)
{
	struct io_channel *channel;

	sys_remove("class/hwmon");
	sys_put(FAN "name", "fan\n");
	sys_put(FAN "pwm1", "0\n");
	sys_put(FAN "pwm1_enable", "2\n");
	field_begin(f);
	channel = field_add(f, "%QW0", DRIVER_hwmon, IEC_INT);
	channel->device = "fan", channel->name = "pwm1";
}

/* A file that refuses all that is written, in place of one of the kernel. */
static void refuse_writes(const char *name)
{
	sys_remove(name);
	CHECK(symlink("/dev/full", sys_path(name)) == 0);
}

static void test_output_goes(void)
{
	struct field f;
	int full;

	make_fan(&f);
	CHECK(field_open(&f));
	field_set(&f, 0, INT(100));
	CHECK(UNTIL(&f, field_quality(&f, 0) == QUALITY_GOOD && sys_get(FAN "pwm1") == 100, 9000));
	/* Its file is still open, but takes nothing. */
	full = open("/dev/full", O_WRONLY);
	sys_remove("class/hwmon");
	CHECK(full >= 0 && dup2(full, f.hal.channels->cell[0].file) >= 0);
	close(full);
	field_set(&f, 0, INT(120));
	CHECK_AS(UNTIL(&f, field_quality(&f, 0) == QUALITY_FAULT, 9000), "an output that cannot be written is in fault");
	CHECK_AS(field_scan(&f, now()), "the program goes on");
	/* It comes back with another number, but the chip keeps its control. */
	mkdir(sys_path("class/hwmon"), 0755);
	mkdir(sys_path("class/hwmon/hwmon5"), 0755);
	mkdir(sys_path("class/hwmon/hwmon5/pwm1_enable"), 0755);
	sys_put("class/hwmon/hwmon5/pwm1", "0\n");
	sys_put("class/hwmon/hwmon5/name", "fan\n");
	UNTIL(&f, false, 1200);
	CHECK_AS(field_quality(&f, 0) == QUALITY_FAULT && sys_get("class/hwmon/hwmon5/pwm1") == 0,
		 "an output that is refused stays in fault");
	sys_remove("class/hwmon/hwmon5/pwm1_enable");
	sys_put("class/hwmon/hwmon5/pwm1_enable", "2\n");
	CHECK_AS(UNTIL(&f, sys_get("class/hwmon/hwmon5/pwm1") == 120, 9000), "it is found again, and has the program's value");
	CHECK(UNTIL(&f, field_quality(&f, 0) == QUALITY_GOOD, 9000) && sys_get("class/hwmon/hwmon5/pwm1_enable") == 1);
	CHECK(hal_write_safe(&f.hal) && sys_get("class/hwmon/hwmon5/pwm1") % 10 == 0);
	field_end(&f);
	sys_remove("class/hwmon");
}

static void test_output_refused(void)
{
	struct field f;

	make_fan(&f);
	refuse_writes(FAN "pwm1");
	CHECK(!field_open(&f));
	CHECK_AS(strstr(f.text, "\"fan\"") && strstr(f.text, "No space left on device"),
		 "an output that takes no number is told at the start");
	arena_free(&f.arena);
	make_fan(&f);
	CHECK(hal_plan(&f.hal, &f.map, &f.arena, &f.diags));
	sys_remove(FAN "pwm1");
	CHECK(!hal_open_planned(&f.hal, &f.diags) && f.diags.errors == 1);
	diag_print(&f.diags.diag[0], f.text, sizeof(f.text));
	CHECK_AS(strstr(f.text, "\"fan\"") && strstr(f.text, "No such file"), "an output that goes before it is opened is told");
	arena_free(&f.arena);
	make_chip();
	sys_remove(CHIP "/pwm1/enable");
	field_begin(&f);
	add_pwm(&f, "%QW0", 1);
	CHECK_AS(!field_open(&f) && strstr(f.text, "pwmchip0 enable"), "an output that is not made ready is told");
	arena_free(&f.arena);
	sys_remove("class");
}

/* The new map has an output that does not open: the old one goes on. */
static void test_new_output_refused(void)
{
	struct field f, g;
	char line[LIMIT_ARG];
	struct io_channel *channel;

	make_fan(&f);
	sys_put("class/hwmon/hwmon3/name", "pump\n");
	sys_put("class/hwmon/hwmon3/pwm1", "0\n");
	refuse_writes("class/hwmon/hwmon3/pwm1");
	CHECK(field_open(&f));
	field_begin(&g);
	channel = field_add(&g, "%QW0", DRIVER_hwmon, IEC_INT);
	channel->device = "fan", channel->name = "pwm1";
	channel = field_add(&g, "%QW2", DRIVER_hwmon, IEC_INT);
	channel->device = "pump", channel->name = "pwm1";
	CHECK(hal_beside(&g.hal, &f.hal, &g.map, &g.arena, &g.diags, line) == BESIDE_GOOD);
	CHECK(!hal_open_new(&g.hal, &g.diags) && g.diags.errors == 1);
	field_set(&f, 0, INT(77));
	CHECK_AS(UNTIL(&f, sys_get(FAN "pwm1") == 77, 9000), "a map whose output is refused leaves the one that runs");
	arena_free(&g.arena);
	field_begin(&g);
	channel = field_add(&g, "%QW0", DRIVER_hwmon, IEC_INT);
	channel->device = "none", channel->name = "pwm1";
	CHECK(hal_beside(&g.hal, &f.hal, &g.map, &g.arena, &g.diags, line) == BESIDE_REFUSED && g.diags.errors == 1);
	arena_free(&g.arena);
	field_end(&f);
	sys_remove("class/hwmon");
}

/* ---- what is wrong ---- */

static void test_errors(void)
{
	struct field f;
	char text[300];
	static const char *const want[] = {
		"test.io:2:1: error LD550: \"28-9\": this machine has no such device; it has 28-1",
		"test.io:3:1: error LD554: \"28-1\" can only be read",
		"test.io:4:1: error LD552: \"ina219\" has no channel in9",
		"test.io:5:1: error LD553: \"twin\": several devices have this name; write one of hwmon3, hwmon4",
		"test.io:6:1: error LD552: \"pwmchip0\" has no channel 9; it has 4",
		"test.io:8:1: error LD507: \"pwmchip0\" is used twice in the map, first for %QW6",
		"test.io:9:1: error LD555: \"pwmchip0 1\" can only be written",
		"test.io:10:1: error LD550: \"ads1115\": this machine has no such device",
	};
	const int errors = (int)(sizeof(want) / sizeof(want[0]));

	make_chip();
	sys_put("bus/w1/devices/28-1/temperature", "20000\n");
	sys_put("class/hwmon/hwmon1/name", "ina219\n");
	sys_put("class/hwmon/hwmon3/name", "twin\n");
	sys_put("class/hwmon/hwmon4/name", "twin\n");
	field_begin(&f);
	add_sensor(&f, "%ID0", "28-9");
	add_sensor(&f, "%QD4", "28-1");
	f.point[1].output = true;
	field_add(&f, "%ID8", DRIVER_hwmon, IEC_REAL)->device = "ina219";
	f.channel[2].name = "in9";
	field_add(&f, "%ID12", DRIVER_hwmon, IEC_REAL)->device = "twin";
	f.channel[3].name = "temp1";
	add_pwm(&f, "%QW4", 9);
	add_pwm(&f, "%QW6", 1);
	add_pwm(&f, "%QW8", 1);
	add_pwm(&f, "%IW8", 1);
	field_add(&f, "%IW10", DRIVER_pwm, IEC_INT)->device = "ads1115";
	CHECK(!hal_check(&f.map, &f.arena, &f.diags));
	CHECK_AS(f.diags.errors == errors, "all lines are checked in the same run");
	for (int i = 0; i < errors && i < f.diags.count; i++) {
		diag_print(&f.diags.diag[i], text, sizeof(text));
		if (!CHECK_AS(strncmp(text, want[i], strlen(want[i])) == 0, "the message"))
			printf("# got:  %s\n# want: %s\n", text, want[i]);
	}
	CHECK_AS(sys_get(CHIP "/pwm1/enable") == 0, "nothing is driven");
	field_end(&f);
}

/* access() asks for the real user: a test of root is nobody for a while. */
static bool become_nobody(void)
{
	if (geteuid() != 0)
		return true;
	chmod(field_sys, 0755);
	return setreuid(65534, (uid_t)-1) == 0 && access(field_sys, X_OK) == 0;
}

static void become_oneself(void)
{
	if (geteuid() == 0 && setreuid(0, (uid_t)-1) != 0)
		printf("# the test stays nobody\n");
}

static void denies(const struct device_driver *driver, const char *device, const char *name, bool output,
		   const char *file, const char *want)
{
	struct device_search search = { .sys = field_sys };
	const struct io_channel channel = { .device = device, .name = name, .number = 1, .period_ns = 20000000 };
	const struct io_point point = { .channel = &channel, .output = output };
	struct device found = { .scale = 1 };
	struct trouble why = { .id = DIAG_COUNT };
	bool good;

	chmod(sys_path(file), 0);
	if (!become_nobody()) {
		printf("ok %d # SKIP no other user may be here\n", ++tap_count);
		become_oneself();
		return;
	}
	good = driver->find(&search, &point, &found, &why);
	become_oneself();
	chmod(sys_path(file), 0644);
	CHECK(!good && why.id == DIAG_IO_DEVICE_DENIED);
	if (!CHECK_AS(strstr(why.text, want), "the file that is denied is named, with its group"))
		printf("# %s\n", why.text);
}

static void test_denied(void)
{
	char group[40], want[80];

	make_chip();
	sys_put("class/hwmon/hwmon2/name", "fan\n");
	sys_put("class/hwmon/hwmon2/pwm1", "0\n");
	sys_put("class/hwmon/hwmon2/temp1_input", "0\n");
	sys_put("bus/w1/devices/28-1/temperature", "20000\n");
	group_print(getegid(), group, sizeof(group));
	snprintf(want, sizeof(want), "pwm1/duty_cycle" DIAG_AND "%s", group);
	denies(&device_pwm, "pwmchip0", "", true, CHIP "/pwm1/duty_cycle", want);
	sys_remove(CHIP "/pwm1");
	denies(&device_pwm, "pwmchip0", "", true, CHIP "/export", "pwmchip0/export");
	denies(&device_hwmon, "fan", "pwm1", true, "class/hwmon/hwmon2/pwm1", "hwmon2/pwm1");
	denies(&device_hwmon, "fan", "temp1", false, "class/hwmon/hwmon2/temp1_input", "hwmon2/temp1_input");
	denies(&device_w1, "28-1", "", false, "bus/w1/devices/28-1/temperature", "28-1/temperature");
	sys_remove("class");
	sys_remove("bus");
}

/* Lines of /etc/group, also of one that was damaged. */
static void test_group_lines(void)
{
	static const struct { const char *line; unsigned int id; bool is; } rows[] = {
		{ "gpio:x:993:user", 993, true }, { "gpio:x:993:", 993, true }, { "gpio:x:993", 993, true },
		{ "gpio:x:993:user", 99, false }, { "gpio:x:993:user", 9930, false }, { "gpio:x:0:", 0, true },
		{ "gpio", 0, false }, { "gpio:x", 0, false }, { "gpio:", 0, false }, { "gpio:x:", 0, false },
		{ "gpio:x:user", 0, false }, { "", 0, false }, { ":::", 0, false },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		char line[40];

		snprintf(line, sizeof(line), "%s", rows[i].line);
		CHECK_AS(group_is(line, rows[i].id) == rows[i].is, rows[i].line);
		if (rows[i].is)
			CHECK_TEXT(line, "gpio");
	}
}

/* ---- files that are not as they should be ---- */

static bool stop(void *context, const char *name)
{
	(void)name;
	++*(int *)context;
	return false;
}

static void test_files(void)
{
	static const struct { const char *text; bool good; double number; } numbers[] = {
		{ "1", true, 1 }, { "-0.5", true, -0.5 }, { "+3 \t\n", true, 3 }, { ".5", true, 0.5 }, { "7.", true, 7 },
		{ "", false, 0 }, { "-", false, 0 }, { ".", false, 0 }, { "1.2.3", false, 0 }, { "12x", false, 0 },
		{ "x12", false, 0 }, { "123456789012345678", true, 123456789012345678.0 },
		{ "1234567890123456789", false, 0 }, { "0.12345678901234567890", true, 0.123456789012345678 },
	};
	char text[SYSFS_TEXT], longest[2 * SYSFS_TEXT], known[40] = "", group[40];
	double number;
	int visits = 0;

	memset(longest, '7', sizeof(longest) - 1);
	longest[sizeof(longest) - 1] = '\0';
	sys_put("odd/long", longest);
	sys_put("odd/empty", "");
	CHECK(sysfs_read(sys_path("odd/none"), text, sizeof(text)) == -ENOENT && !*text);
	CHECK(sysfs_read(sys_path("odd"), text, sizeof(text)) == -EISDIR && !*text);
	CHECK(sysfs_read(sys_path("odd/long"), text, sizeof(text)) == -EMSGSIZE && strlen(text) < sizeof(text));
	CHECK(sysfs_read(sys_path("odd/empty"), text, sizeof(text)) == 0 && !*text);
	CHECK(sysfs_write(sys_path("odd/none"), "1") == -ENOENT && sysfs_write("/dev/full", "1") == -ENOSPC);
	CHECK(sysfs_each(sys_path("none"), stop, &visits) == -ENOENT && visits == 0);
	CHECK_AS(sysfs_each(sys_path("odd"), stop, &visits) == 0 && visits == 1, "a visit may end a search");
	CHECK(!sysfs_path(text, 8, "folder", "name", "") && sysfs_path(text, sizeof(text), "a", "", "/b"));
	CHECK_TEXT(text, "a/b");
	for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++)
		CHECK_AS(sysfs_number(numbers[i].text, &number) == numbers[i].good &&
			 (!numbers[i].good || near(number, numbers[i].number)), numbers[i].text);
	CHECK(!sysfs_read_number(sys_path("odd/empty"), &number) && !sysfs_read_number(sys_path("odd/none"), &number));
	CHECK(sysfs_print(INT64_MIN, text) == 20 && !strcmp(text, "-9223372036854775808"));
	for (int i = 0; i < 9; i++)
		device_known(known, sizeof(known), "28-000001");
	CHECK_TEXT(known, "28-000001, 28-000001, 28-000001, ...");
	group_print(0, group, sizeof(group));
	CHECK_TEXT(group, "(root)");
	group_print(4000000000u, group, sizeof(group));
	CHECK_TEXT(group, "(4000000000)");
	sys_remove("odd");
}

/* What a driver says about a point. */
static void finds(const struct device_driver *driver, const char *device, const char *name, uint32_t number,
		  bool output, enum diag_id want)
{
	struct device_search search = { .sys = field_sys };
	const struct io_channel channel = { .device = device, .name = name, .number = number, .period_ns = 20000000 };
	const struct io_point point = { .channel = &channel, .output = output };
	struct device found = { .scale = 1 };
	struct trouble why = { .id = DIAG_COUNT };
	char as[100];

	snprintf(as, sizeof(as), "%s %s %u", device, name, number);
	if (!CHECK_AS(driver->find(&search, &point, &found, &why) == (want == DIAG_COUNT) && why.id == want, as))
		printf("# %s: %s\n", diag_code(why.id), why.text);
}

static void test_find(void)
{
	char longest[2 * SYSFS_TEXT];

	memset(longest, 'n', sizeof(longest) - 1);
	longest[sizeof(longest) - 1] = '\0';
	sys_remove("class");
	sys_remove("bus");
	finds(&device_hwmon, "fan", "pwm1", 0, true, DIAG_IO_NO_DEVICE);
	finds(&device_pwm, "pwmchip0", "", 0, true, DIAG_IO_NO_DEVICE);
	finds(&device_w1, "28-1", "", 0, false, DIAG_IO_NO_DEVICE);
	sys_put("class/hwmon/hwmon0/temp1_input", "1");
	sys_put("class/hwmon/hwmon1/name", longest);
	finds(&device_hwmon, "hwmon0", "temp1", 0, false, DIAG_IO_NO_DEVICE);
	finds(&device_hwmon, "hwmon1", "temp1", 0, false, DIAG_IO_NO_DEVICE);
	sys_put("class/hwmon/hwmon2/name", "chip\n");
	sys_put("class/hwmon/hwmon2/temp1_input", "1");
	finds(&device_hwmon, "chip", "temp1", 0, false, DIAG_COUNT);
	finds(&device_hwmon, "chip", "temp1", 0, true, DIAG_IO_ONLY_INPUT);
	finds(&device_hwmon, "chip", "temp2", 0, false, DIAG_IO_NO_CHANNEL);
	finds(&device_hwmon, "chip", "temp", 0, false, DIAG_IO_NO_CHANNEL);
	finds(&device_hwmon, "chip", "temp1x", 0, false, DIAG_IO_NO_CHANNEL);
	finds(&device_hwmon, "chip", "heat1", 0, false, DIAG_IO_NO_CHANNEL);
	sys_put("class/pwm/other/npwm", "2");
	sys_put("class/pwm/pwmchip1/export", "");
	finds(&device_pwm, "other", "", 0, true, DIAG_IO_NO_DEVICE);
	finds(&device_pwm, "pwmchip1", "", 0, true, DIAG_IO_NO_CHANNEL);
	sys_put("class/pwm/pwmchip1/npwm", "2");
	finds(&device_pwm, "pwmchip1", "", 1, true, DIAG_COUNT);
	finds(&device_pwm, "pwmchip1", "", 2, true, DIAG_IO_NO_CHANNEL);
	finds(&device_pwm, "pwmchip1", "", 1, false, DIAG_IO_ONLY_OUTPUT);
	sys_remove("class/pwm/pwmchip1/export");
	finds(&device_pwm, "pwmchip1", "", 1, true, DIAG_IO_DEVICE_DENIED);
	sys_put("class/pwm/pwmchip1/device/name", "pca9685");
	sys_put("class/pwm/pwmchip2/device/name", "pca9685");
	finds(&device_pwm, "pca9685", "", 1, true, DIAG_IO_DEVICE_TWICE);
	mkdir(sys_path("bus"), 0755);
	sys_put("bus/w1/devices/28-1/id", "x");
	finds(&device_w1, "28-1", "", 0, false, DIAG_IO_NO_CHANNEL);
	finds(&device_w1, "28-1", "", 0, true, DIAG_IO_ONLY_INPUT);
	finds(&device_w1, "../devices/28-1", "", 0, false, DIAG_IO_NO_DEVICE);
	sys_put("bus/w1/devices/28-1/w1_slave", "x");
	finds(&device_w1, "28-1", "", 0, false, DIAG_COUNT);
}

/* An output whose files are not as the kernel makes them: which of them is named. @without: removed; @folder: there
 * is a folder in its place. */
static void takes(const struct device_driver *driver, const char *device, const char *path, const char *name,
		  const char *without, const char *folder, const char *want)
{
	const struct io_channel channel = { .device = device, .name = name, .number = 1, .period_ns = 20000000,
					    .type = IEC_INT };
	const struct io_point point = { .channel = &channel, .output = true, .active_low = true };
	struct device out = { .scale = 1, .home = (uint32_t)strlen(sys_path(CHIP)) };
	struct trouble why = { .id = DIAG_COUNT };

	make_chip();
	if (*without)
		sys_remove(without);
	if (*folder) {
		sys_remove(folder);
		mkdir(sys_path(folder), 0755);
	}
	snprintf(out.path, sizeof(out.path), "%.*s", (int)sizeof(out.path) - 1, sys_path(path));
	if (!CHECK_AS(driver->take(&out, &point, 5, &why) == !*want && (!*want || strstr(why.text, want)), *want ? want : path))
		printf("# %s\n", why.text);
}

static void test_take(void)
{
	static const char duty_cycle[] = CHIP "/pwm1/duty_cycle";

	takes(&device_pwm, "pwmchip0", duty_cycle, "", "", "", "");
	takes(&device_pwm, "pwmchip0", duty_cycle, "", CHIP "/pwm1", CHIP "/export", "pwmchip0 export");
	takes(&device_pwm, "pwmchip0", duty_cycle, "", CHIP "/pwm1", "", "pwm1/duty_cycle"); /* nothing is made */
	takes(&device_pwm, "pwmchip0", duty_cycle, "", "", CHIP "/pwm1/polarity", "pwmchip0 polarity");
	takes(&device_pwm, "pwmchip0", duty_cycle, "", CHIP "/pwm1/period", "", "pwmchip0 period");
	takes(&device_pwm, "pwmchip0", duty_cycle, "", "", duty_cycle, "pwmchip0 duty_cycle");
	takes(&device_pwm, "pwmchip0", duty_cycle, "", CHIP "/pwm1/enable", "", "pwmchip0 enable");
	sys_put("class/hwmon/hwmon2/pwm1", "0");
	takes(&device_hwmon, "fan", "class/hwmon/hwmon2/pwm1", "pwm1", "", "", "");
	takes(&device_hwmon, "fan", "class/hwmon/hwmon2/pwm1", "pwm1", "", "class/hwmon/hwmon2/pwm1_enable", "fan pwm1_enable");
}

static void test_w1_texts(void)
{
	static const struct { const char *text; double last; bool has_last, good; } rows[] = {
		{ "21437", 0, false, true }, { "2b : crc=a1 YES\n2b t=21437", 0, false, true },
		{ "2b : crc=a1 NO\n2b t=21437", 0, false, false }, { "2b : crc=a1 YES\n", 0, false, false },
		{ "2b : crc=a1 YES\n2b t=x", 0, false, false }, { "", 0, false, false }, { "85000", 0, false, false },
		{ "85000", 84500, true, true }, { "85000", 86900, true, true }, { "85000", 10000, true, false },
		{ "85000", 90000, true, false }, { "84999", 0, false, true },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		const struct device device = { .last = rows[i].last, .has_last = rows[i].has_last };
		double number;

		CHECK_AS(device_w1.parse(&device, rows[i].text, &number) == rows[i].good, rows[i].text);
	}
}

/* ---- the list ---- */

static char seen[2000];

static void see(void *context, const struct device_seen *at)
{
	const size_t used = strlen(seen);

	(void)context;
	snprintf(seen + used, sizeof(seen) - used, "%s %s/%s %s %s %d\n", driver_row(at->driver)->word, at->device,
		 at->label, at->channel, at->output ? "out" : "in",
		 at->has_value ? (int)lround(at->value * 1000) : -1);
}

static void test_list(void)
{
	sys_remove("class");
	sys_remove("bus");
	make_chip();
	sys_put(CHIP "/npwm", "2\n");
	sys_put(CHIP "/pwm1/duty_cycle", "5");
	sys_put(CHIP "/pwm1/period", "10");
	sys_put("bus/w1/devices/28-1/temperature", "20000\n");
	sys_put("bus/w1/devices/28-2/w1_slave", "x crc=0 NO\nt=1\n");
	mkdir(sys_path("bus/w1/devices/w1_bus_master1"), 0755);
	sys_put("class/hwmon/hwmon1/name", "ina219\n");
	sys_put("class/hwmon/hwmon1/in1_input", "11984\n");
	sys_put("class/hwmon/hwmon1/in1_label", "VIN\n");
	/* what is no device, and devices without a value */
	sys_put("class/hwmon/hwmon3/in1_input", "1\n");
	sys_put("class/hwmon/hwmon1/in2_input", "nonsense\n");
	sys_put("class/pwm/other/npwm", "1\n");
	sys_put("class/pwm/pwmchip1/pwm0/period", "0\n");
	sys_put("class/pwm/pwmchip2345678901234567890123456789012345678/npwm", "1\n");
	sys_put("bus/w1/devices/28-3/id", "x");
	channels_list(field_sys, see, NULL);
	CHECK_TEXT(seen, "pwm pwmchip0/ 0 out -1\npwm pwmchip0/ 1 out 50000\n"
		   "w1 28-1/  in 20000\nw1 28-2/  in -1\n"
		   "hwmon ina219/hwmon1 in1 in 11984\nhwmon ina219/hwmon1 in2 in -1\n");
}

static int seen_values;

static void see_value(void *context, const struct device_seen *at)
{
	(void)context;
	seen_values += at->has_value;
}

/* A folder of devices whose name is as long as there is room, and longer: each device is found and shown, or it is
 * not there. */
static void test_long_folders(void)
{
	static const struct { const struct device_driver *driver; const char *device, *name; bool output; } rows[] = {
		{ &device_w1, "28-1", "", false }, { &device_w1, "28-2", "", false },
		{ &device_hwmon, "fan", "temp1", false }, { &device_hwmon, "fan", "pwm1", true },
		{ &device_pwm, "pwmchip0", "", true },
	};
	enum { ROWS = sizeof(rows) / sizeof(rows[0]) };
	int wrong = 0, all = 0, none = 0, lost = ROWS;
	char sys[2 * DEVICE_PATH + 400];

	sys_remove("class");
	sys_remove("bus");
	make_chip();
	sys_put(CHIP "/pwm1/period", "10");
	sys_put("class/hwmon/hwmon2/name", "fan\n");
	sys_put("class/hwmon/hwmon2/pwm1", "0\n");
	sys_put("class/hwmon/hwmon2/temp1_input", "0\n");
	sys_put("bus/w1/devices/28-1/temperature", "20000\n");
	sys_put("bus/w1/devices/28-2/w1_slave", "20000\n");
	snprintf(sys, sizeof(sys), "%s", field_sys);
	for (int n = 0; n < DEVICE_PATH; n++) {
		struct device_search search = { .sys = sys };
		int found = 0;

		for (int i = 0; i < ROWS; i++) {
			const struct io_channel channel = { .device = rows[i].device, .name = rows[i].name,
							    .number = 1, .period_ns = 20000000 };
			const struct io_point point = { .channel = &channel, .output = rows[i].output };
			struct device at = { .scale = 1 };
			struct trouble why = { .id = DIAG_COUNT };

			if (rows[i].driver->find(&search, &point, &at, &why))
				wrong += access(at.path, F_OK) != 0 || strlen(at.path) <= at.home, found++;
			else
				wrong += why.id != DIAG_IO_NO_DEVICE && why.id != DIAG_IO_NO_CHANNEL;
		}
		seen_values = 0;
		channels_list(sys, see_value, NULL);
		wrong += seen_values != found || found > lost;
		lost = found;
		all += found == ROWS;
		none += !found;
		snprintf(sys + strlen(sys), 2, "%s", n % 2 ? "." : "/");
	}
	CHECK_AS(wrong == 0, "what is found in a long folder is shown, the rest is not there");
	CHECK(all > 0 && none > 0);
	sys_remove("class");
	sys_remove("bus");
}

int main(void)
{
	if (!sys_begin())
		return 1;
	test_scaling();
	test_round();
	test_highest_step();
	test_quality();
	test_filter_and_threshold();
	test_outputs_of_a_gateway();
	test_simulated();
	test_asked();
	test_told_quality();
	test_told_forces();
	test_gateway_beside();
	test_exchange();
	test_same();
	test_w1();
	test_slow_device();
	test_hung_device();
	test_many_sensors();
	test_time_of_sensors();
	test_pwm();
	test_pwm_names();
	test_pwm_export();
	test_pwm_goes_on();
	test_hwmon();
	test_output_goes();
	test_output_refused();
	test_new_output_refused();
	test_errors();
	test_denied();
	test_group_lines();
	test_files();
	test_find();
	test_take();
	test_w1_texts();
	test_list();
	test_long_folders();
	sys_remove("");
	return tap_done();
}
