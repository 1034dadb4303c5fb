/* SPDX-License-Identifier: MIT
 *
 * test_chips - the chips of the map raspberry-pi-analog.io by drivers of the kernel, on the buses of values/chips-sim.c:
 * an ADS1115, a MCP3008, a MCP4725, a MCP23017, a PCF8574, and a TMP102 in place of the processor's own sensor. A
 * PCA9685 is memory (i2c-stub), a DS18B20 that of values/w1-sim.c.
 *
 * A test sets what is at the inputs of a chip and looks at its outputs. A chip that is `away` does not answer, as one
 * whose wire has broken; one that is deleted has lost its driver, too. Without chips-sim the test is skipped.
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
#include <sys/utsname.h>
#include <unistd.h>

#define CHIPS   "/sys/module/chips_sim/parameters/"
#define SENSOR  "/sys/module/w1_sim/parameters/"
#define BUS     "/sys/bus/i2c/devices/i2c-7/"
#define MEMORY  "/sys/bus/i2c/devices/i2c-0/"
#define WITH_LIBIIO "/ladderd-iio"
#define STEPS   4096  /* of the MCP4725, and of a period of the PCA9685      */
#define FULL    27648 /* what both are for a program                         */
#define NEAR    8     /* steps: what converters of 10 and 12 bits lose       */
#define KEY     0x001 /* lines of the MCP23017                               */
#define LAMP    0x100
#define KEY2    0x01  /* lines of the PCF8574; the lamp is on when it is low */
#define LAMP2   0x10

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

static bool set(const char *name, const char *text)
{
	return put(CHIPS, name, text);
}

static int seen(const char *name)
{
	char path[PATH_MOST], text[64];

	snprintf(path, sizeof(path), CHIPS "%s", name);
	return file_take(path, text, sizeof(text)) < 0 ? -1 : (int)strtol(text, NULL, 0);
}

/* Waits until the bits @mask of a chip's pins are @want. */
static bool pins(const char *name, int mask, int want)
{
	int64_t end_ns = clock_now() + LIMIT_MS * MS;

	while ((seen(name) & mask) != want && clock_now() < end_ns)
		sleep_ms(20);
	if ((seen(name) & mask) != want)
		note("%s is %#x", name, (unsigned)seen(name));
	return (seen(name) & mask) == want;
}

/* Both lamps. */
static bool lamps(bool lamp, bool lamp2)
{
	return pins("mcp23017_pins", LAMP, lamp ? LAMP : 0) && pins("pcf8574_pins", LAMP2, lamp2 ? 0 : LAMP2);
}

/* A key at the MCP23017 is closed when its line is high, one at the PCF8574 when it is low. */
static void keys(bool key, bool key2)
{
	set("mcp23017_outside", key ? "0x0001" : "0x0000");
	set("pcf8574_outside", key2 ? "0xfe" : "0xff");
}

static bool state(struct child *child, const char *line)
{
	for (int i = 0; i < 100; i++) {
		if (strstr(child_status(child), line))
			return true;
		sleep_ms(100);
	}
	return false;
}

static bool expanders_are_there(void)
{
	return put(BUS, "new_device", "mcp23017 0x20") && put(BUS, "new_device", "pcf8574 0x24");
}

static void expanders_go(void)
{
	put(BUS, "delete_device", "0x20");
	put(BUS, "delete_device", "0x24");
}

/* ---- lines, with each driver of ladderd; the key of each chip switches the lamp of the other ---- */

static const char lines_program[] =
	"RUNGBOARD 1\n\nVAR\n  Key AT %IX20.0 : BOOL;\n  Key2 AT %IX21.0 : BOOL;\n  Lamp AT %QX20.0 : BOOL;\n"
	"  Lamp2 AT %QX21.0 : BOOL;\n  Other AT %QX20.1 : BOOL;\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n  | NO Key2 | COIL Lamp |\n"
	"RUNG\n  | NO Key | COIL Lamp2 |\nRUNG\n  | NO SYS_ALWAYS_ON | COIL Other |\nEND_PROGRAM\n";
static const char lines_map[] =
	"BOARD \"expanders\"\n"
	"%IX20.0 gpio chip=mcp23017 offset=0\n%IX20.1 gpio chip=mcp23017 offset=1 pull-up\n%QX20.0 gpio chip=mcp23017 offset=8 safe=0\n"
	"%QX20.1 gpio chip=mcp23017 offset=15 safe=0\n"
	"%IX21.0 gpio chip=pcf8574 offset=0 active-low\n%QX21.0 gpio chip=pcf8574 offset=4 active-low safe=0\n";
#define OTHER 0x8000

/* The chip at @address has gone; the lines of the other one, @there, are safe. */
static void gone(struct child *child, const char *what, const char *there, int mask, int want)
{
	check(child_says(child, "FAULT, outputs are safe"), "%s: FAULT", what);
	check(pins(there, mask, want), "%s: the other chip has its safe values", what);
}

/* A FAULT stays until somebody resets it. */
static void back(struct child *child, const char *what)
{
	check(state(child, "io: good"), "%s: it is back, and its lines are taken again", what);
	keys(true, true);
	sleep_ms(200);
	check(lamps(false, false) && pins("mcp23017_pins", OTHER, 0), "%s: the FAULT stays, and both have their safe values", what);
	child_signal(child, SIGHUP);
	check(lamps(true, true) && pins("mcp23017_pins", OTHER, OTHER), "%s: SIGHUP resets it", what);
}

static struct child lines_begin(void)
{
	struct child child;

	keys(true, true);
	ladderd_start(&child, file_text("lines.rung", lines_program), file_text("lines.io", lines_map), NULL);
	check(child_ready() && lamps(true, true) && pins("mcp23017_pins", OTHER, OTHER), "a MCP23017 and a PCF8574: lamps are on as keys are");
	return child;
}

/* The driver of the MCP23017 takes an output that it could not write for written, also when it should be safe. */
static void keeps_its_outputs(struct child *child)
{
	check(state(child, "io: good"), "it is back, and its lines are taken again");
	check(pins("mcp23017_pins", LAMP | OTHER, LAMP | OTHER), "its outputs have the values of before");
	child_signal(child, SIGHUP);
	check(lamps(true, true) && pins("mcp23017_pins", OTHER, OTHER), "SIGHUP resets the FAULT");
}

/* Debian 12's kernel, 6.1, makes zeros of what it cannot read. */
static void reads_zeros(struct child *child)
{
	keys(true, false);
	check(lamps(false, true), "one key is closed");
	set("away", "0x20");
	check(pins("pcf8574_pins", LAMP2, LAMP2), "a MCP23017 that does not answer: its inputs are low");
	keys(true, true);
	sleep_ms(200);
	set("away", "0");
	check(pins("pcf8574_pins", LAMP2, 0), "its inputs are back");
	sleep_ms(200);
	check(pins("mcp23017_pins", LAMP, 0), "its output has the value of before");
	keys(true, false);
	sleep_ms(200);
	keys(true, true);
	check(pins("mcp23017_pins", LAMP, LAMP), "until the value changes again");
	check(state(child, "state: RUN\n"), "the program has run on");
}

/*
 * What docs/field.md says of the MCP23017. When its driver begins, it takes each output for low, which is true only if
 * the chip has lost its supply.
 */
static void mcp23017_fails(void)
{
	struct child child = lines_begin();
	struct utsname kernel = { .release = "" };

	check(seen("mcp23017_pull_up") == 0, "the driver of the MCP23017 sets no pull-up");
	uname(&kernel);
	if (strncmp(kernel.release, "6.1.", 4) == 0) {
		reads_zeros(&child);
	} else {
		set("away", "0x20");
		gone(&child, "a MCP23017 that does not answer", "pcf8574_pins", LAMP2, LAMP2);
		set("away", "0");
		keeps_its_outputs(&child);
	}
	check(child_stop(&child) == 0 && lamps(false, false), "SIGTERM: safe values");
	child = lines_begin();
	put(BUS, "delete_device", "0x20");
	gone(&child, "a MCP23017 whose driver has gone", "pcf8574_pins", LAMP2, LAMP2);
	put(BUS, "new_device", "mcp23017 0x20");
	keeps_its_outputs(&child);
	check(child_stop(&child) == 0 && lamps(false, false), "SIGTERM: safe values");
}

static void lines(void)
{
	struct child child;

	check(expanders_are_there(), "a MCP23017 and a PCF8574 are there");
	child = lines_begin();
	keys(false, true);
	check(lamps(true, false), "one follows");
	keys(true, false);
	check(lamps(false, true), "the other one follows");
	keys(true, true);
	check(lamps(true, true), "both");

	set("away", "0x24");
	gone(&child, "a PCF8574 that does not answer", "mcp23017_pins", LAMP | OTHER, 0);
	set("away", "0");
	back(&child, "a PCF8574 that does not answer");
	check(child_stop(&child) == 0 && lamps(false, false), "SIGTERM: safe values");

	child = lines_begin();
	put(BUS, "delete_device", "0x24");
	gone(&child, "a PCF8574 whose driver has gone", "mcp23017_pins", LAMP | OTHER, 0);
	put(BUS, "new_device", "pcf8574 0x24");
	back(&child, "a PCF8574 whose driver has gone");
	check(child_stop(&child) == 0 && lamps(false, false), "SIGTERM: safe values");
	mcp23017_fails();
	expanders_go();
}

/* ---- the whole map ---- */

static const char program[] =
	"RUNGBOARD 1\n\nVAR\n  A0 AT %AIW0 : INT;\n  A1 AT %AIW2 : INT;\n  A2 AT %AIW4 : INT;\n  A3 AT %AIW6 : INT;\n"
	"  Loop AT %AIW8 : INT;\n  Volts AT %AIW10 : INT;\n  Contact AT %IX10.0 : BOOL;\n  Pipe AT %AIW20 : INT;\n"
	"  Room AT %AIW22 : INT;\n  RoomGood AT %IX200.0 : BOOL;\n  LoopGood AT %IX200.1 : BOOL;\n  Key AT %IX20.0 : BOOL;\n"
	"  Key2 AT %IX21.0 : BOOL;\n  Lamp AT %QX20.0 : BOOL;\n  Lamp2 AT %QX21.0 : BOOL;\n  Dac AT %AQW0 : INT;\n"
	"  Dim AT %AQW2 : INT;\n  Wide AT %AQW4 : INT;\nEND_VAR\n\nPROGRAM Main ST\n"
	"  Lamp := Key;\n  Lamp2 := Key2;\n"
	"  IF Key AND Key2 THEN\n    Dac := 20736;\n    Dim := SEL(RoomGood, 0, 27648);\n    Wide := SEL(LoopGood, 0, 13824);\n"
	"  ELSIF Key THEN\n    Dac := A3;\n    Dim := Loop;\n    Wide := Volts;\n"
	"  ELSIF Key2 THEN\n    Dac := Pipe;\n    Dim := Room;\n    Wide := SEL(Contact, 0, 27648);\n"
	"  ELSE\n    Dac := A0;\n    Dim := A1;\n    Wide := A2;\n  END_IF\nEND_PROGRAM\n";

/* The map as it is shipped, but for the processor's sensor, which no emulated machine has; and with two qualities. */
static const char *shipped_map(void)
{
	static char text[TEXT_BYTES], map[TEXT_BYTES + 128];
	char *cpu;

	if (file_take(file_case("raspberry-pi-analog.io"), text, sizeof(text)) < 0)
		give_up("raspberry-pi-analog.io");
	cpu = strstr(text, "device=cpu_thermal");
	if (!cpu)
		give_up("cpu_thermal in raspberry-pi-analog.io");
	*cpu = 0;
	snprintf(map, sizeof(map), "%sdevice=tmp102%s\n%%IX200.0 quality of=%%AIW22\n%%IX200.1 quality of=%%AIW8\n", text,
		 cpu + strlen("device=cpu_thermal"));
	return file_text("shipped.io", map);
}

static int pca9685(int fd, int reg)
{
	union i2c_smbus_data data = { .byte = 0 };
	struct i2c_smbus_ioctl_data access = {
		.read_write = I2C_SMBUS_READ, .command = (uint8_t)reg, .size = I2C_SMBUS_BYTE_DATA, .data = &data,
	};

	return ioctl(fd, I2C_SLAVE_FORCE, 0x40) == 0 && ioctl(fd, I2C_SMBUS, &access) == 0 ? data.byte : 0;
}

/* How long a channel of the PCA9685 is on, in steps. */
static int pulse(int channel)
{
	const int fd = open("/dev/i2c-0", O_RDWR | O_CLOEXEC), first = 6 + 4 * channel;
	const int on = pca9685(fd, first) | pca9685(fd, first + 1) << 8;
	const int off = pca9685(fd, first + 2) | pca9685(fd, first + 3) << 8;

	close(fd);
	if (off & 0x1000)
		return 0;
	return on & 0x1000 ? STEPS : (off - on) & 0xfff;
}

static bool is_near(int steps, int value)
{
	return abs(steps - (int)((long)value * STEPS / FULL)) <= NEAR;
}

/* The outputs of the MCP4725 and of two channels of the PCA9685, as numbers of the program. */
static bool gives(int dac, int dim, int wide)
{
	int64_t end_ns = clock_now() + LIMIT_MS * MS;

	for (;;) {
		if (is_near(seen("mcp4725_step"), dac) && is_near(pulse(0), dim) && is_near(pulse(1), wide))
			return true;
		if (clock_now() > end_ns)
			break;
		sleep_ms(20);
	}
	note("the MCP4725 gives %d, the PCA9685 %d and %d of %d", seen("mcp4725_step"), pulse(0), pulse(1), STEPS);
	return false;
}

/* Voltages of the ADS1115 are 0 to 4 V; the MCP3008 has 0.6 to 3 V at its input 0, and 0 to 3.3 V. */
static void values(void)
{
	keys(false, false);
	check(child_ready() && gives(2765, 5530, 8294), "three inputs of the ADS1115 are at the MCP4725 and the PCA9685");
	check(lamps(false, false), "both lamps are off");
	set("ads1115_mv", "2000,100,0,1600");
	check(gives(13824, 691, 0), "they follow");
	keys(true, false);
	check(gives(11059, 13824, 13851), "the fourth one, and two inputs of the MCP3008");
	check(lamps(true, false), "a lamp is on");
	keys(false, true);
	check(gives(2143, 3125, 0), "the DS18B20, the TMP102 and a contact at the MCP3008");
	set("mcp3008_step", "558,513,700,0,0,0,0,0");
	put(SENSOR, "temperature", "99000");
	set("tmp102_mc", "99500");
	check(gives(9900, 9950, FULL), "they follow");
	set("tmp102_mc", "-10000");
	check(gives(9900, 0, FULL), "ten degrees below zero: a pulse width has no less than 0");
	set("tmp102_mc", "31250");
	check(gives(9900, 3125, FULL), "and up again");
	keys(true, true);
	check(gives(20736, FULL, 13824), "all are good");
}

static void broken_wires(struct child *child)
{
	set("away", "0x49");
	check(gives(20736, 0, 13824), "a TMP102 that does not answer is not good");
	keys(false, true);
	check(gives(9900, 3125, FULL), "it keeps its last value, as the map says");
	set("away", "0");
	set("tmp102_mc", "40000");
	check(gives(9900, 4000, FULL), "and is back");
	keys(true, true);
	set("spi_away", "Y");
	check(gives(20736, FULL, 0), "a MCP3008 whose wire is broken measures 3.3 V, which the limits of a current loop find");
	keys(true, false);
	check(gives(11059, 0, FULL), "that input has its substitute, and one without limits shows it");
	set("spi_away", "N");
	check(gives(11059, 13824, 13851), "and is back");
	set("away", "0x48");
	set("ads1115_mv", "2000,100,0,400");
	sleep_ms(1500);
	check(gives(11059, 13824, 13851), "an ADS1115 that does not answer keeps its last values");
	set("away", "0x60");
	check(gives(11059, 13824, 13851) && seen("away") == 0x60, "the MCP4725 does not answer, the ADS1115 does again");
	sleep_ms(1500);
	check(gives(11059, 13824, 13851), "a MCP4725 that does not answer gives what it gave");
	set("away", "0");
	check(gives(2765, 13824, 13851), "and is back: it gets the value of now");
	put(BUS, "delete_device", "0x60");
	keys(true, true);
	check(pins("mcp23017_pins", LAMP, LAMP) && state(child, "state: RUN\n"), "a MCP4725 whose driver has gone: the program runs on");
	put(BUS, "new_device", "mcp4725 0x60");
	check(gives(20736, FULL, 13824), "and is back");
	check(state(child, "state: RUN\n"), "the program has run on all the time");
}

static void shipped(void)
{
	const char *const usual = guest.ladderd;
	struct child child;

	if (!file_is_there(WITH_LIBIIO)) {
		skip("no ladderd with libiio", "the map with converters and expanders");
		return;
	}
	guest.ladderd = WITH_LIBIIO;
	set("ads1115_mv", "400,800,1200,1600");
	set("mcp3008_step", "558,513,300,0,0,0,0,0");
	set("tmp102_mc", "31250");
	put(SENSOR, "temperature", "21437");
	check(expanders_are_there() && put(BUS, "new_device", "ads1115 0x48") && put(BUS, "new_device", "tmp102 0x49") &&
	      put(BUS, "new_device", "mcp4725 0x60") && put(MEMORY, "new_device", "pca9685 0x40"),
	      "all chips of raspberry-pi-analog.io are there");
	ladderd_start(&child, file_text("shipped.rung", program), shipped_map(), NULL);
	values();
	broken_wires(&child);
	check(child_stop(&child) == 0 && gives(0, 0, 0) && lamps(false, false), "SIGTERM: safe values");
	expanders_go();
	put(BUS, "delete_device", "0x48");
	put(BUS, "delete_device", "0x49");
	put(BUS, "delete_device", "0x60");
	put(MEMORY, "delete_device", "0x40");
	guest.ladderd = usual;
}

void test_chips(void)
{
	if (guest.small || !file_is_there(CHIPS "away")) {
		skip("no buses of chips-sim", "chips by drivers of the kernel");
		return;
	}
	set("away", "0");
	lines();
	if (!guest.again)
		shipped();
}
