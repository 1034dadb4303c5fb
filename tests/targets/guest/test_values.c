/* SPDX-License-Identifier: MIT
 *
 * test_values - values by drivers of the kernel: temperatures of an LM75 (hwmon) and of a DS18B20 (w1_therm), pulse
 * widths of a PCA9685; with a ladderd that has libiio, a voltage of an ADS1015 and one of the kernel's dummy converter.
 *
 * The LM75 and the PCA9685 are memory on a bus of I2C (i2c-stub), so that a test writes what a chip would measure
 * and reads what it would drive. The DS18B20 is that of values/w1-sim.c. Without them the test is skipped.
 */
#include "tests/targets/guest/child.h"

#include <fcntl.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#define BUS    "/sys/bus/i2c/devices/i2c-0/"
#define SENSOR "/sys/module/w1_sim/parameters/"
#define LM75   0x4f
#define ADC    0x48
#define PWM    0x40
#define STEPS  4096
#define DUMMY  "/sys/kernel/config/iio/devices/dummy/valve"
#define WITH_LIBIIO "/ladderd-iio"
#define NEAR   6 /* of 4096 steps: two of ten thousand and two of the chip  */

static const char program[] =
	"RUNGBOARD 1\n\nVAR\n  Room AT %AIW0 : INT;\n  Pipe AT %AIW2 : INT;\n  Fan AT %AQW0 : INT;\n  Heat AT %AQW2 : INT;\n"
	"END_VAR\n\nPROGRAM Main LD\nRUNG\n  | NO SYS_ALWAYS_ON | MOVE IN:=Room OUT=>Fan |\n"
	"RUNG\n  | NO SYS_ALWAYS_ON | MOVE IN:=Pipe OUT=>Heat |\nEND_PROGRAM\n";
static const char map[] =
	"BOARD \"chips\"\n"
	"%AIW0 hwmon device=lm75 channel=temp1 poll=20ms stale=200ms substitute=1000\n"
	"%AIW2 w1 sensor=28-000005e2fdc3 stale=3s substitute=5000\n"
	"%AQW0 pwm chip=pca9685-pwm channel=0 period=20ms range=0..10000 at 0%..100% safe=7500\n"
	"%AQW2 pwm chip=pca9685-pwm channel=9 period=20ms range=0..10000 at 0%..100% safe=hold\n";

static int bus = -1;

static bool put(const char *folder, const char *name, const char *text)
{
	char path[PATH_MOST];
	int file;
	bool good;

	snprintf(path, sizeof(path), "%s%s", folder, name);
	file = open(path, O_WRONLY | O_CLOEXEC);
	good = file >= 0 && write(file, text, strlen(text)) == (ssize_t)strlen(text);
	if (file >= 0)
		close(file);
	return good;
}

/* A register of a chip; its driver has the address. */
static int access_chip(int chip, uint8_t reg, bool writes, uint32_t size, union i2c_smbus_data *data)
{
	struct i2c_smbus_ioctl_data access = {
		.read_write = writes ? I2C_SMBUS_WRITE : I2C_SMBUS_READ, .command = reg, .size = size, .data = data,
	};

	return ioctl(bus, I2C_SLAVE_FORCE, chip) == 0 ? ioctl(bus, I2C_SMBUS, &access) : -1;
}

/* What a chip measures has the higher byte first. */
static void measure_raw(int chip, unsigned raw)
{
	union i2c_smbus_data data = { .word = (uint16_t)(raw << 8 | raw >> 8) };

	access_chip(chip, 0, true, I2C_SMBUS_WORD_DATA, &data);
}

/* The LM75 has steps of 1/256 °C. */
static void measure(double celsius)
{
	measure_raw(LM75, (unsigned)(celsius * 256));
}

static unsigned byte_of(uint8_t reg)
{
	union i2c_smbus_data data = { .byte = 0 };

	return access_chip(PWM, reg, false, I2C_SMBUS_BYTE_DATA, &data) == 0 ? data.byte : 0;
}

/* How long a channel is on, in steps of a period. */
static int pulse(int channel)
{
	const uint8_t first = (uint8_t)(6 + 4 * channel);
	const unsigned on = byte_of(first) | byte_of((uint8_t)(first + 1)) << 8;
	const unsigned off = byte_of((uint8_t)(first + 2)) | byte_of((uint8_t)(first + 3)) << 8;

	if (off & 0x1000)
		return 0;
	return on & 0x1000 ? STEPS : (int)((off - on) & 0xfff);
}

/* Both channels, in hundredths of a percent. */
static bool shows(int fan, int heat)
{
	int64_t end_ns = clock_now() + LIMIT_MS * MS;

	for (;;) {
		if (abs(pulse(0) - fan * STEPS / 10000) <= NEAR && abs(pulse(9) - heat * STEPS / 10000) <= NEAR)
			return true;
		if (clock_now() > end_ns)
			break;
		sleep_ms(20);
	}
	note("pulse widths %d and %d of %d", pulse(0), pulse(9), STEPS);
	return false;
}

static bool can(void)
{
	char name[64];

	if (file_take(BUS "name", name, sizeof(name)) < 0 || strncmp(name, "SMBus stub", 10) != 0 ||
	    !file_is_there(SENSOR "temperature"))
		return false;
	bus = open("/dev/i2c-0", O_RDWR | O_CLOEXEC);
	return bus >= 0;
}

static void follow(void)
{
	struct child child;

	ladderd_start(&child, file_text("values.rung", program), file_text("values.io", map), NULL);
	check(child_ready() && shows(2500, 2143), "the pulse widths are what both sensors measure");
	measure(40.5);
	put(SENSOR, "temperature", "30125");
	check(shows(4050, 3012), "they follow");
	put(SENSOR, "away", "Y");
	check(shows(4050, 5000), "a sensor of 1-wire that does not answer has its substitute");
	put(SENSOR, "away", "N");
	check(shows(4050, 3012), "and is back");
	put(BUS, "delete_device", "0x4f");
	check(shows(1000, 3012), "a sensor of hwmon whose driver has gone has its substitute");
	put(BUS, "new_device", "lm75 0x4f");
	check(shows(4050, 3012), "and is back, also with another number");
	check(strstr(child_status(&child), "state: RUN\n") != NULL, "the program has run on");
	check(child_stop(&child) == 0 && shows(7500, 3012), "SIGTERM: one has its safe value, the other holds");
}

static void end_badly(void)
{
	struct child child;

	ladderd_start(&child, file_text("values.rung", program), file_text("values.io", map), NULL);
	check(child_ready() && shows(4050, 3012), "the next one drives them");
	child_signal(&child, SIGSEGV);
	child_end(&child);
	check(shows(7500, 3012), "a crash: the same");
	ladderd_start(&child, file_text("values.rung", program), file_text("values.io", map), NULL);
	check(child_ready() && shows(4050, 3012), "the next one drives them");
	child_signal(&child, SIGKILL);
	child_end(&child);
	sleep_ms(500);
	check(shows(4050, 3012), "SIGKILL without a guard: the last values stay, as documented");
}

/* ---- converters ---- */

static const char converters_map[] =
	"BOARD \"converters\"\n"
	"%AIW0 iio device=ads1015 channel=voltage0 range=0..10000 at 0V..2V poll=20ms stale=200ms substitute=9000\n"
	"%AIW2 sim\n"
	"%AQW0 iio device=valve channel=voltage0 range=0..10000 at 0V..10V safe=1234\n"
	"%AQW2 sim safe=0\n";

/* The output of the dummy, in mV; -1: it is not there. */
static long valve(void)
{
	char path[PATH_MOST], text[64];

	for (int i = 0; i < 8; i++) {
		snprintf(path, sizeof(path), "/sys/bus/iio/devices/iio:device%d/name", i);
		if (file_take(path, text, sizeof(text)) < 0 || strncmp(text, "valve", 5) != 0)
			continue;
		snprintf(path, sizeof(path), "/sys/bus/iio/devices/iio:device%d/out_voltage0_raw", i);
		return file_take(path, text, sizeof(text)) < 0 ? -1 : strtol(text, NULL, 10);
	}
	return -1;
}

static bool valve_shows(long mv)
{
	int64_t end_ns = clock_now() + LIMIT_MS * MS;

	while (labs(valve() - mv) > 5 && clock_now() < end_ns)
		sleep_ms(20);
	if (labs(valve() - mv) > 5)
		note("the output is %ld mV", valve());
	return labs(valve() - mv) <= 5;
}

static void converters(void)
{
	const char *const usual = guest.ladderd;
	struct child child;

	if (!file_is_there(WITH_LIBIIO) || mkdir(DUMMY, 0755) != 0) {
		skip("no ladderd with libiio, or no dummy of Industrial I/O", "converters");
		return;
	}
	guest.ladderd = WITH_LIBIIO;
	measure_raw(ADC, 1000 << 4);
	check(put(BUS, "new_device", "ads1015 0x48"), "an ADS1015 is there");
	ladderd_start(&child, file_text("values.rung", program), file_text("converters.io", converters_map), NULL);
	check(child_ready() && valve_shows(5000), "a voltage comes in, another one goes out");
	measure_raw(ADC, 250 << 4);
	check(valve_shows(1250), "it follows");
	put(BUS, "delete_device", "0x48");
	check(valve_shows(9000), "a converter whose driver has gone has its substitute");
	put(BUS, "new_device", "ads1015 0x48");
	check(valve_shows(1250), "and is back");
	check(child_stop(&child) == 0 && valve_shows(1234), "SIGTERM: the safe value");
	put(BUS, "delete_device", "0x48");
	rmdir(DUMMY);
	guest.ladderd = usual;
}

void test_values(void)
{
	if (guest.small || !can()) {
		skip("no chips on I2C that are memory, or no 1-wire bus of w1-sim", "values by drivers of the kernel");
		return;
	}
	put(SENSOR, "temperature", "21437");
	measure(25);
	check(put(BUS, "new_device", "lm75 0x4f") && put(BUS, "new_device", "pca9685 0x40"), "an LM75 and a PCA9685 are there");
	follow();
	end_badly();
	if (!guest.again)
		converters();
	put(BUS, "delete_device", "0x4f");
	put(BUS, "delete_device", "0x40");
	close(bus);
}
