/* SPDX-License-Identifier: MIT
 *
 * iio - the tests of the driver iio. They run with a fake of libiio, and with the library itself where it is
 * installed; both see a folder in place of /sys.
 */
#include "tests/hal/field.h"

#include <math.h>

#define DEVICES "bus/iio/devices/"

extern int fake_iio_contexts;
extern bool fake_iio_missing;

static bool near(double a, double b)
{
	return fabs(a - b) < 1e-4;
}

static void make_devices(void)
{
	sys_remove("bus");
	sys_put(DEVICES "iio:device0/name", "ads1115\n");
	sys_put(DEVICES "iio:device0/label", "tank\n");
	sys_put(DEVICES "iio:device0/in_voltage0_raw", "20000\n");
	sys_put(DEVICES "iio:device0/in_voltage0_scale", "0.125000000\n");
	sys_put(DEVICES "iio:device0/in_voltage3_raw", "-8000\n");
	sys_put(DEVICES "iio:device0/in_voltage3_scale", "0.250000000\n");
	sys_put(DEVICES "iio:device1/name", "mcp4725\n");
	sys_put(DEVICES "iio:device1/out_voltage0_raw", "0\n");
	sys_put(DEVICES "iio:device1/out_voltage0_scale", "0.800000000\n");
	sys_put(DEVICES "iio:device1/out_voltage0_powerdown", "1\n");
	sys_put(DEVICES "iio:device2/name", "chip\n");
	sys_put(DEVICES "iio:device2/in_temp_raw", "2000\n");
	sys_put(DEVICES "iio:device2/in_temp_offset", "-700\n");
	sys_put(DEVICES "iio:device2/in_temp_scale", "20\n");
	sys_put(DEVICES "iio:device2/in_current1_raw", "400\n");
	sys_put(DEVICES "iio:device2/in_current_scale", "0.030000\n");
	sys_put(DEVICES "iio:device3/name", "chip\n");
	sys_put(DEVICES "iio:device3/in_temp_input", "21500\n");
}

static struct io_channel *add(struct field *f, const char *address, const char *device, const char *name,
			      enum io_unit unit)
{
	struct io_channel *channel = field_add(f, address, DRIVER_iio,
					       strchr(address, 'D') ? IEC_REAL : IEC_INT);

	channel->device = device, channel->name = name, channel->unit = unit;
	return channel;
}

static void test_inputs(void)
{
	struct field f;
	struct io_channel *channel;

	make_devices();
	field_begin(&f);
	add(&f, "%ID0", "ads1115", "voltage0", UNIT_VOLT);
	add(&f, "%ID4", "tank", "voltage3", UNIT_VOLT);
	channel = add(&f, "%IW8", "iio:device0", "voltage0", UNIT_VOLT);
	channel->scaled = true, channel->value_high = 27648, channel->at_high = 10;
	add(&f, "%IW10", "ads1115", "voltage3", UNIT_VOLT);
	add(&f, "%ID12", "iio:device2", "temp", UNIT_CELSIUS);
	add(&f, "%ID16", "iio:device2", "current1", UNIT_AMPERE);
	add(&f, "%ID20", "iio:device3", "temp", UNIT_CELSIUS);
	CHECK(field_open(&f) && field_scan(&f, now()));
	CHECK_AS(near(field_get(&f, 0).r, 2.5) && near(field_get(&f, 1).r, -2),
		 "the number times its scale, in V; by name and by label");
	CHECK(field_get(&f, 2).i == 6912);
	CHECK_AS(field_get(&f, 3).i == -8000, "without a range it is the number of the converter");
	CHECK_AS(near(field_get(&f, 4).r, 26) && near(field_get(&f, 5).r, 0.012), "with an offset, in °C and A");
	CHECK_AS(near(field_get(&f, 6).r, 21.5), "a channel that the kernel has scaled already");
	CHECK(UNTIL(&f, hal_worst(&f.hal) == QUALITY_GOOD, 9000));
	sys_remove(DEVICES "iio:device0");
	CHECK(UNTIL(&f, field_quality(&f, 0) == QUALITY_FAULT, 9000) && near(field_get(&f, 0).r, 2.5));
	CHECK(UNTIL(&f, field_quality(&f, 6) == QUALITY_GOOD, 9000));
	sys_put(DEVICES "iio:device7/in_voltage0_scale", "0.125\n");
	sys_put(DEVICES "iio:device7/in_voltage0_raw", "8000\n");
	sys_put(DEVICES "iio:device7/name", "ads1115\n");
	CHECK_AS(UNTIL(&f, near(field_get(&f, 0).r, 1), 9000), "it comes back with another number");
	field_end(&f);
}

static void test_broken_wire(void)
{
	struct field f;
	struct io_channel *channel;

	make_devices();
	field_begin(&f);
	channel = add(&f, "%IW0", "iio:device2", "current1", UNIT_AMPERE);
	channel->scaled = true, channel->value_high = 27648;
	channel->at_low = 0.004, channel->at_high = 0.020;
	channel->limited = true, channel->least = 0.0036, channel->most = 0.021;
	channel->substituted = true, channel->substitute.i = -1;
	CHECK(field_open(&f) && field_scan(&f, now()));
	CHECK(field_get(&f, 0).i == 13824);
	sys_put(DEVICES "iio:device2/in_current1_raw", "3\n");
	CHECK_AS(UNTIL(&f, field_get(&f, 0).i == -1, 9000) && field_quality(&f, 0) == QUALITY_FAULT,
		 "4..20 mA without a current: the wire is broken");
	sys_put(DEVICES "iio:device2/in_current1_raw", "400\n");
	CHECK(UNTIL(&f, field_get(&f, 0).i == 13824, 9000) &&
	      UNTIL(&f, field_quality(&f, 0) == QUALITY_GOOD, 9000));
	field_end(&f);
}

static void test_output(void)
{
	struct field f;
	struct io_channel *channel;
	const char *raw = DEVICES "iio:device1/out_voltage0_raw";

	make_devices();
	sys_put(raw, "0000\n");
	field_begin(&f);
	channel = add(&f, "%QW0", "mcp4725", "voltage0", UNIT_VOLT);
	channel->scaled = true, channel->value_high = 27648, channel->at_high = 3.2;
	channel->safe.i = 13824;
	CHECK(field_open(&f));
	CHECK_AS(sys_get(raw) == 2000, "it begins with its safe value: 1.6 V");
	CHECK_AS(sys_get(DEVICES "iio:device1/out_voltage0_powerdown") == 0, "and is not powered down");
	field_set(&f, 0, INT(20736));
	CHECK(UNTIL(&f, sys_get(raw) == 3000, 9000));
	CHECK(hal_write_safe(&f.hal) && sys_get(raw) == 2000);
	hal_release(&f.hal);
	CHECK(UNTIL(&f, sys_get(raw) == 3000, 9000));
	field_end(&f);
	CHECK(sys_get(raw) == 2000);
}

static void test_errors(void)
{
	struct field f;
	char text[300];
	static const char *const want[] = {
		"test.io:2:1: error LD550: \"ads1015\": this machine has no such device; it has tank, mcp4725, ",
		"test.io:3:1: error LD552: \"ads1115\" has no channel voltage9; it has voltage",
		"test.io:4:1: error LD554: \"ads1115 voltage0\" can only be read",
		"test.io:5:1: error LD555: \"mcp4725 voltage0\" can only be written",
		"test.io:6:1: error LD553: \"chip\": several devices have this name; write one of iio:device2, iio:device3",
		"test.io:8:1: error LD507: \"iio:device1\" is used twice in the map, first for %QW2",
	};
	const int errors = (int)(sizeof(want) / sizeof(want[0]));

	make_devices();
	field_begin(&f);
	add(&f, "%IW0", "ads1015", "voltage0", UNIT_VOLT);
	add(&f, "%IW2", "ads1115", "voltage9", UNIT_VOLT);
	add(&f, "%QW0", "ads1115", "voltage0", UNIT_VOLT);
	add(&f, "%IW4", "mcp4725", "voltage0", UNIT_VOLT);
	add(&f, "%ID8", "chip", "temp", UNIT_CELSIUS);
	add(&f, "%QW2", "mcp4725", "voltage0", UNIT_VOLT);
	add(&f, "%QW4", "iio:device1", "voltage0", UNIT_VOLT);
	CHECK(!hal_check(&f.map, &f.arena, &f.diags));
	CHECK_AS(f.diags.errors == errors, "all lines are checked in the same run");
	for (int i = 0; i < errors && i < f.diags.count; i++) {
		diag_print(&f.diags.diag[i], text, sizeof(text));
		if (!CHECK_AS(strncmp(text, want[i], strlen(want[i])) == 0, "the message"))
			printf("# got:  %s\n# want: %s\n", text, want[i]);
	}
	CHECK_AS(sys_get(DEVICES "iio:device1/out_voltage0_powerdown") == 1, "nothing is driven");
	field_end(&f);
}

/* Converters that the kernel shows in other ways. */
static void make_odd_devices(void)
{
	sys_remove("bus");
	sys_put(DEVICES "iio:device0/in_pressure_raw", "12\n");
	sys_put(DEVICES "iio:device0/in_voltage7_raw", "500\n");
	sys_put(DEVICES "iio:device0/in_voltage7_scale", "0\n");
	sys_put(DEVICES "trigger0/name", "ads1115\n");
	sys_put(DEVICES "iio:device1/name", "dac\n");
	sys_put(DEVICES "iio:device1/out_voltage0_raw", "0\n");
	sys_put(DEVICES "iio:device2/name", "off\n");
	sys_put(DEVICES "iio:device2/out_voltage0_raw", "0\n");
}

static void test_odd_devices(void)
{
	struct field f;

	make_odd_devices();
	field_begin(&f);
	add(&f, "%ID0", "iio:device0", "pressure", UNIT_NONE);
	add(&f, "%ID4", "iio:device0", "voltage7", UNIT_VOLT);
	add(&f, "%QW0", "dac", "voltage0", UNIT_NONE);
	CHECK(field_open(&f) && field_scan(&f, now()));
	CHECK_AS(near(field_get(&f, 0).r, 12), "a device without a name, by its number; a kind without a unit");
	CHECK_AS(near(field_get(&f, 1).r, 0.5), "a scale of 0 is none");
	field_set(&f, 2, INT(5));
	CHECK_AS(UNTIL(&f, sys_get(DEVICES "iio:device1/out_voltage0_raw") == 5, 9000), "an output that is always on");
	field_end(&f);
	field_begin(&f);
	add(&f, "%ID0", "ads1115", "voltage0", UNIT_NONE);
	CHECK_AS(!hal_check(&f.map, &f.arena, &f.diags) && f.diags.diag[0].id == DIAG_IO_NO_DEVICE,
		 "a trigger is no converter");
	field_end(&f);
}

/* Each file that refuses a number of an output that begins. The library itself lists no file that is a device. */
static void test_output_refused(void)
{
	static const char *const files[] = { "out_voltage0_powerdown", "out_voltage0_raw" };
	static const char *const want[] = { "off powerdown", "No space left on device" };

	for (int i = 0; i < 2; i++) {
		struct field f;
		char name[80];

		make_odd_devices();
		snprintf(name, sizeof(name), DEVICES "iio:device2/%s", files[i]);
		unlink(sys_path(name));
		CHECK(symlink("/dev/full", sys_path(name)) == 0);
		field_begin(&f);
		add(&f, "%QW0", "off", "voltage0", UNIT_NONE);
		CHECK(!field_open(&f) && f.diags.errors == 1);
		CHECK_AS(strstr(f.text, "\"off") && (strstr(f.text, want[i]) || strstr(f.text, "LD552")),
			 "an output that is refused is told");
		arena_free(&f.arena);
	}
}

/* A folder of devices whose name is as long as there is room, and longer. */
static int seen_values;
static void see_value(void *context, const struct device_seen *at)
{
	(void)context;
	seen_values += at->has_value;
}

static void test_long_folders(void)
{
	char sys[600];
	int wrong = 0, found = 0, none = 0, last = 4;

	make_odd_devices();
	snprintf(sys, sizeof(sys), "%s", field_sys);
	for (int n = 0; n < 170; n++) {
		struct field f;
		bool good;

		field_begin(&f);
		f.map.sys = sys;
		add(&f, "%ID0", "iio:device0", "pressure", UNIT_NONE);
		good = hal_check(&f.map, &f.arena, &f.diags);
		wrong += !good && f.diags.diag[0].id != DIAG_IO_NO_DEVICE && f.diags.diag[0].id != DIAG_IO_NO_CHANNEL;
		field_end(&f);
		seen_values = 0;
		channels_list(sys, see_value, NULL);
		wrong += seen_values > last || (!good && seen_values == 4);
		last = seen_values;
		found += good && seen_values == 4;
		none += !good && !seen_values;
		snprintf(sys + strlen(sys), 2, "%s", n % 2 ? "." : "/");
	}
	CHECK_AS(wrong == 0, "what is found in a long folder is shown, the rest is not there");
	CHECK(found > 0 && none > 0);
}

/* The machine has no libiio. */
static void test_missing(void)
{
	struct field f;
	char text[300] = "";

	make_devices();
	field_begin(&f);
	add(&f, "%ID0", "ads1115", "voltage0", UNIT_VOLT);
	fake_iio_missing = true;
	CHECK(!hal_check(&f.map, &f.arena, &f.diags));
	fake_iio_missing = false;
	if (f.diags.count == 1)
		diag_print(&f.diags.diag[0], text, sizeof(text));
	CHECK(strcmp(text, "test.io:2:1: error LD569: \"ads1115\": the driver iio needs the library libiio 0.x; "
			   "install its package, libiio0") == 0);
	field_end(&f);
	field_begin(&f);
	add(&f, "%ID0", "ads1115", "voltage0", UNIT_VOLT);
	CHECK_AS(hal_check(&f.map, &f.arena, &f.diags), "when it is installed, it is found");
	field_end(&f);
}

static int seen;

static void see(void *context, const struct device_seen *at)
{
	(void)context;
	seen++;
	if (strcmp(at->device, "ads1115") == 0 && strcmp(at->channel, "voltage3") == 0)
		CHECK(at->driver == DRIVER_iio && strcmp(at->label, "tank") == 0 && !at->output &&
		      at->has_value && near(at->value, -2) && at->unit == UNIT_VOLT);
	if (strcmp(at->device, "mcp4725") == 0)
		CHECK(at->output && at->unit == UNIT_VOLT);
}

int main(void)
{
	if (!sys_begin() || setenv("FAKE_SYS", field_sys, 1) != 0)
		return 1;
	test_inputs();
	test_broken_wire();
	test_output();
	test_errors();
	test_odd_devices();
	test_output_refused();
	test_long_folders();
	test_missing();
	make_devices();
	channels_list(field_sys, see, NULL);
	CHECK(seen == 6);
	fake_iio_missing = true;
	channels_list(field_sys, see, NULL);
	CHECK_AS(seen == 6, "a list without the library is one without its devices");
	CHECK_AS(fake_iio_contexts == 0, "all contexts of the library are freed");
	sys_remove("");
	return tap_done();
}
