/* SPDX-License-Identifier: MIT
 *
 * test_iomap_rows - what the table of an I/O map offers for each field: the lines of a machine that
 * has some, or none, and the words of the language.
 */
#include "editor-gtk/iomap/iomap_rows.h"
#include "tests/tap.h"

#include <string.h>

static struct io_device analog[] = {
	{ "iio", "ads1115", "voltage0", "1.5 V", false }, { "iio", "ads1115", "voltage1", "2 V", false },
	{ "w1", "28-000005e2fdc3", "", "20.5 \302\260C", false }, { "pwm", "pwmchip0", "0", "", true },
};
static const struct io_devices devices = { .device = analog, .count = 4 };

/* "FIRST SECOND WORDS behind ROW" of a line that is added to @text, or why not. */
static void adds(const char *text, enum iomap_page page, enum io_kind kind, int row, const char *want)
{
	const struct io_uses uses = { 0 };
	const struct io_machine bare = { 0 };
	struct iomap_line line;
	struct io_text io;
	const char *why = NULL;
	char *got;

	io_text_read(&io, text, strlen(text));
	got = iomap_line_make(&line, &uses, &io, NULL, &bare, &devices, page, kind, row, &why) ?
	      g_strdup_printf("%s %s %s behind %d", line.first, line.second, line.words, line.behind) :
	      g_strdup(why);
	CHECK_TEXT(got, want);
	iomap_line_clear(&line);
	g_free(got);
	io_text_free(&io);
}

static void lines_to_add(void)
{
	static const char map[] = "BUS p modbus-tcp host=h\nBUS y peer interface=eth0\n"
		"%IX0.0 sim\n%AIW0 iio device=ads1115 channel=voltage0\n%AQW0 sim\n"
		"%IW100..106 modbus bus=p unit=3 input-register=10\n%XIB0..2 module bus=p unit=1 type=DIO1000\n"
		"%IW200 peer from=x name=L\nSERVE s modbus-tcp listen=h\nWINDOW s coil=0..15 %QX0.0 read-only\n";

	adds(map, IOMAP_PINS, IO_KIND_POINT, -1, "%IX0.1 sim  behind 2");
	adds(map, IOMAP_ANALOG, IO_KIND_POINT, 3, "%AIW2 iio device=ads1115 channel=voltage1 behind 3");
	adds(map, IOMAP_ANALOG, IO_KIND_POINT, 4,
	     "%AQW2 pwm chip=pwmchip0 channel=0 period=20ms behind 4");
	adds(map, IOMAP_MODBUS, IO_KIND_POINT, 5, "%IW2 modbus bus=p unit=3 input-register=14 behind 5");
	adds(map, IOMAP_MODBUS, IO_KIND_POINT, 6, "%XIB3 module bus=p unit=2 type=DIO1000 safe=0 behind 6");
	adds(map, IOMAP_MODBUS, IO_KIND_POINT, -1, "%IW2 modbus bus=p unit=1 input-register=0 behind 6");
	adds(map, IOMAP_PEERS, IO_KIND_POINT, 7, "%IW2 peer from=x name=Level behind 7");
	adds(map, IOMAP_BUSES, IO_KIND_POINT, -1, "BUS bus modbus-tcp  host=127.0.0.1:502 behind 1");
	adds(map, IOMAP_BUSES, IO_KIND_DEVICE, -1, "DEVICE p unit=1 behind 0");
	adds("BUS p modbus-tcp host=h\nDEVICE p unit=3 gap=0\n", IOMAP_BUSES, IO_KIND_POINT, 1,
	     "DEVICE p unit=4 behind 1");
	adds("BUS y peer interface=lo\n", IOMAP_BUSES, IO_KIND_DEVICE, -1,
	     "The map has no bus for Modbus: add one on the page Buses first");
	adds(map, IOMAP_SERVED, IO_KIND_POINT, 8, "WINDOW s coil=16..23 %QX2.0 read-only behind 9");
	adds(map, IOMAP_SERVED, IO_KIND_PUBLISH, -1, "PUBLISH board Level every=100ms behind 1");
	adds("", IOMAP_MODBUS, IO_KIND_POINT, -1,
	     "The map has no bus for Modbus: add one on the page Buses first");
	adds("", IOMAP_SERVED, IO_KIND_WINDOW, -1, "The map has no server: add one first");
	adds("", IOMAP_SERVED, IO_KIND_POINT, -1, "SERVE server modbus-tcp  listen=127.0.0.1:1502 behind -2");
}

/* "text (description)|...": all that is offered. */
static void offers(const struct io_machine *machine, enum io_field field, const char *want)
{
	const struct io_uses uses = { 0 };
	const struct io_text io = { 0 };
	GPtrArray *choices = iomap_choices(&uses, machine, &devices, &io, -1, field);
	GString *got = g_string_new(NULL);

	for (guint i = 0; i + 1 < choices->len; i += 2)
		g_string_append_printf(got, "%s%s (%s)", i ? "|" : "", (char *)choices->pdata[i],
				       (char *)choices->pdata[i + 1]);
	CHECK_TEXT(got->str, want);
	g_string_free(got, TRUE);
	g_ptr_array_unref(choices);
}

int main(void)
{
	struct io_found line[] = {
		{ "gpiochip0", "pinctrl", "GPIO17", "", 17, false, false },
		{ "gpiochip0", "pinctrl", "GPIO18", "spi0", 18, true, true },
		{ "gpiochip0", "pinctrl", "", "", 19, true, false },
	};
	const struct io_machine bare = { 0 };
	const struct io_machine board = { .line = line, .count = 3 };

	offers(&bare, IO_LINE, " (no GPIO lines on this machine)");
	offers(&board, IO_LINE, "GPIO17 (gpiochip0 (pinctrl) 17, free)|"
				"GPIO18 (gpiochip0 (pinctrl) 18, spi0)|"
				"pinctrl 19 (gpiochip0 (pinctrl) 19, in use)");
	offers(&bare, IO_SAFE, " ()|0 (off while nothing runs)|1 (on while nothing runs)|"
			       "hold (keeps its last value while nothing runs)");
	offers(&bare, IO_DEVICE, "ads1115 (1.5 V)|28-000005e2fdc3 (20.5 \302\260C)|pwmchip0 ()");
	offers(&bare, IO_CHANNEL, "voltage0 (1.5 V)|voltage1 (2 V)|0 ()");
	lines_to_add();
	return tap_done();
}
