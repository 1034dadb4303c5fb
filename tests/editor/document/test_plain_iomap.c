/* SPDX-License-Identifier: MIT
 *
 * test_plain_iomap - edits of the text of an I/O map: they change what they should and
 * nothing else.
 */
#include "editor-gtk/document/iomap_text.h"

#include "tests/tap.h"

#include <stdlib.h>

static const char sample[] =
	"BOARD \"Desk\"\n"
	"# Inputs: to ground.\n"
	"\n"
	"%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms   # green  button\n"
	"%IX0.1  gpio  chip=1c20800.pinctrl offset=7    pull-up   # PA7\n"
	"%QX0.0  gpio  line=\"P9_14 [x]\"  safe=0\r\n"
	"%QX0.1 (* and *) sim nonsense // lamp\n"
	"%Q what";

/* The text after an edit; "(why)" if it was refused. Caller: free(). */
static char *edited(const char *text, enum io_refusal why, struct io_edit *edit)
{
	const size_t room = strlen(text) + (edit->with ? strlen(edit->with) : 0) + 16;
	char *out = malloc(room);

	if (why == IO_GOOD)
		snprintf(out, room, "%.*s%s%s", (int)edit->at, text, edit->with,
			 text + edit->at + edit->removed);
	else
		snprintf(out, room, "(%d)", (int)why);
	free(edit->with);
	return out;
}

static char *set(const char *text, int row, enum io_field field, const char *value)
{
	struct io_text io;
	struct io_edit edit = { 0, 0, NULL };
	enum io_refusal why;

	io_text_read(&io, text, strlen(text));
	why = io_text_set(&io, row, field, value, &edit);
	io_text_free(&io);
	return edited(text, why, &edit);
}

#define SET(text, row, field, value, want) do { \
	char *set_text = set(text, row, field, value); \
	CHECK_TEXT(set_text, want); \
	free(set_text); \
} while (0)

static void check_field(const struct io_text *io, int row, enum io_field field,
			const char *want)
{
	char *got = io_text_field(io, row, field);

	CHECK_TEXT(got, want);
	free(got);
}

static void fields(void)
{
	struct io_text io;
	char *board;

	CHECK(io_text_read(&io, sample, strlen(sample)) && io.count == 5);
	board = io_text_board(&io);
	CHECK_TEXT(board, "Desk");
	free(board);
	CHECK(io.board_line == 1 && io.row[0].line == 4 && io.row[4].line == 8);
	check_field(&io, 0, IO_ADDRESS, "%IX0.0");
	check_field(&io, 0, IO_DRIVER, "gpio");
	check_field(&io, 0, IO_LINE, "GPIO17");
	check_field(&io, 0, IO_PULL, "pull-up");
	check_field(&io, 0, IO_ACTIVE_LOW, "1");
	check_field(&io, 0, IO_DEBOUNCE, "5ms");
	check_field(&io, 0, IO_SAFE, "");
	check_field(&io, 0, IO_COMMENT, "green  button");
	check_field(&io, 1, IO_LINE, "1c20800.pinctrl 7");
	check_field(&io, 1, IO_ACTIVE_LOW, "");
	check_field(&io, 2, IO_LINE, "\"P9_14 [x]\"");
	check_field(&io, 2, IO_SAFE, "0");
	check_field(&io, 2, IO_COMMENT, "");
	check_field(&io, 3, IO_DRIVER, "sim");
	check_field(&io, 3, IO_COMMENT, "lamp");
	check_field(&io, 4, IO_ADDRESS, "%Q");
	check_field(&io, 4, IO_DRIVER, "what");
	io_text_free(&io);
}

static void words(void)
{
	static const char one[] = "%IX0.0  gpio  line=GPIO17  pull-up active-low   # x\n";

	SET(one, 0, IO_ADDRESS, "%IX0.10", "%IX0.10 gpio  line=GPIO17  pull-up active-low   # x\n");
	SET(one, 0, IO_DRIVER, "sim", "%IX0.0  sim   line=GPIO17  pull-up active-low   # x\n");
	SET(one, 0, IO_LINE, "GPIO5", "%IX0.0  gpio  line=GPIO5   pull-up active-low   # x\n");
	SET(one, 0, IO_LINE, "a b", "%IX0.0  gpio  line=\"a b\"   pull-up active-low   # x\n");
	SET(one, 0, IO_LINE, "\"a b\"", "%IX0.0  gpio  line=\"a b\"   pull-up active-low   # x\n");
	SET(one, 0, IO_LINE, "a\"$", "%IX0.0  gpio  line=\"a$\"$$\" pull-up active-low   # x\n");
	SET(one, 0, IO_LINE, "\"a b\" 7",
	    "%IX0.0  gpio  chip=\"a b\" offset=7 pull-up active-low   # x\n");
	SET(one, 0, IO_LINE, "", "%IX0.0  gpio               pull-up active-low   # x\n");
	SET(one, 0, IO_PULL, "", "%IX0.0  gpio  line=GPIO17 active-low   # x\n");
	SET(one, 0, IO_PULL, "pull-down",
	    "%IX0.0  gpio  line=GPIO17  pull-down active-low   # x\n");
	SET(one, 0, IO_ACTIVE_LOW, "", "%IX0.0  gpio  line=GPIO17  pull-up              # x\n");
	SET(one, 0, IO_DEBOUNCE, "5ms",
	    "%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms # x\n");
	SET(one, 0, IO_COMMENT, "y z", "%IX0.0  gpio  line=GPIO17  pull-up active-low   # y z\n");
	SET(one, 0, IO_COMMENT, "", "%IX0.0  gpio  line=GPIO17  pull-up active-low\n");
	SET("%QX0.0 sim", 0, IO_COMMENT, "c", "%QX0.0 sim   # c");
	SET("%QX0.0 sim", 0, IO_SAFE, "1", "%QX0.0 sim safe=1");
	SET("%QX0.0 gpio safe=1 open-drain", 0, IO_LINE, "L", "%QX0.0 gpio line=L safe=1 open-drain");
	SET("%QX0.0 gpio offset=3 safe=1 chip=c", 0, IO_LINE, "d 4",
	    "%QX0.0 gpio safe=1 chip=d offset=4");
	SET("%QX0.0 gpio chip=c offset=3", 0, IO_LINE, "L", "%QX0.0 gpio line=L");
	SET("%QX0.0 gpio chip=c offset=10   safe=0", 0, IO_LINE, "c 9",
	    "%QX0.0 gpio chip=c offset=9    safe=0");
	SET("%QX0.1 sim // lamp\n", 0, IO_COMMENT, "horn", "%QX0.1 sim // horn\n");
	SET("%QX0.1 sim // lamp\n", 0, IO_SAFE, "1", "%QX0.1 sim safe=1 // lamp\n");
	SET("%QX0.1 sim safe=0 // lamp\n", 0, IO_SAFE, "hold", "%QX0.1 sim safe=hold // lamp\n");
	SET("%QX0.1 sim #lamp\n", 0, IO_COMMENT, "horn", "%QX0.1 sim # horn\n");
}

static void refused(void)
{
	static const char one[] = "%IX0.0 gpio line=A\n";

	SET(one, 0, IO_ADDRESS, "", "(3)");
	SET(one, 0, IO_ADDRESS, "%IX0.0 sim", "(1)");
	SET(one, 0, IO_DRIVER, "# no", "(1)");
	SET(one, 0, IO_DEBOUNCE, "5 ms", "(1)");
	SET(one, 0, IO_DEBOUNCE, "5//ms", "(1)");
	SET(one, 0, IO_DEBOUNCE, "(*", "(1)");
	SET(one, 0, IO_PULL, "up", "(2)");
	SET(one, 0, IO_SAFE, "2", "(2)");
	SET(one, 0, IO_COMMENT, "two\nlines", "(6)");
	SET(one, 0, IO_LINE, "A\nB", "(6)");
	SET(one, 0, IO_LINE, "\"A\" \"", "(6)");
}

static void lines(void)
{
	struct io_text io;
	struct io_edit edit;
	char *got;

	io_text_read(&io, sample, strlen(sample));
	got = edited(sample, io_text_delete(&io, 2, &edit), &edit);
	CHECK_AS(!strstr(got, "%QX0.0") && strstr(got, "# PA7\n%QX0.1"), "a line is deleted");
	free(got);
	got = edited(sample, io_text_delete(&io, 4, &edit), &edit);
	CHECK_AS(strstr(got, "// lamp\n") + 8 == got + strlen(got), "the last line is deleted");
	free(got);
	got = edited(sample, io_text_add(&io, 1, "%IX0.2", "sim", "", "", &edit), &edit);
	CHECK_AS(strstr(got, "# PA7\n%IX0.2  sim\n%QX0.0") != NULL,
		 "a line is added after another one");
	free(got);
	got = edited(sample, io_text_add(&io, -1, "%QX0.2", "sim", "", "Horn", &edit), &edit);
	CHECK_AS(strstr(got, "%Q what\n%QX0.2  sim  safe=0   # Horn\n") != NULL,
		 "a line is added after a last line without a newline");
	free(got);
	CHECK(io_text_add(&io, 0, "%Q X", "sim", "", "", &edit) == IO_MANY_WORDS);
	got = edited(sample, io_text_set_board(&io, "A \"$\"", &edit), &edit);
	CHECK_AS(strncmp(got, "BOARD \"A $\"$$$\"\"\n#", 18) == 0,
		 "the name of the board is replaced");
	free(got);
	io_text_free(&io);
	io_text_read(&io, "%IX0.0 sim\n", 11);
	got = edited("%IX0.0 sim\n", io_text_set_board(&io, "B", &edit), &edit);
	CHECK_TEXT(got, "BOARD \"B\"\n%IX0.0 sim\n");
	free(got);
	io_text_free(&io);
}

/* Comments with several lines before, inside and behind a statement. */
static void spread(void)
{
	static const char odd[] = "BOARD \"x\" (* a\n b *)\n(* c\n d *) %IX0.0 (* e\n f *) sim (* g\n"
				  " h *) debounce=1s\n%QX0.0 sim";
	struct io_text io;
	struct io_edit edit;
	char *got;

	io_text_read(&io, odd, strlen(odd));
	CHECK(io.count == 2 && io.row[0].line == 4 && io.row[1].line == 7);
	check_field(&io, 0, IO_DEBOUNCE, "1s");
	got = edited(odd, io_text_delete(&io, 0, &edit), &edit);
	CHECK_TEXT(got, "BOARD \"x\" (* a\n b *)\n(* c\n d *)\n%QX0.0 sim");
	free(got);
	io_text_free(&io);
	SET(odd, 0, IO_DRIVER, "gpio", "BOARD \"x\" (* a\n b *)\n(* c\n d *) %IX0.0 (* e\n f *) gpio (* g\n"
	    " h *) debounce=1s\n%QX0.0 sim");
}

/* Any bytes give rows inside the text, fields, and edits that stay inside it. */
static void storm(void)
{
	static const char *const piece[] = { "%IX0.0", " ", "gpio", "\n", "#", "(*", "*)", "\"",
		"line=", "chip=a", " offset=3", "//", "\r\n", "pull-up", "\xff", "$", "BOARD",
		"\xe7\x94\xb5", "safe=0", "=", "'", "  ", "debounce=5ms" };
	unsigned int seed = 1;
	int bad = 0, rows = 0, edits = 0;

	for (int round = 0; round < 20000; round++) {
		char text[256] = "";
		struct io_text io;
		size_t used = 0;

		for (int i = 0; i < 14; i++) {
			seed = seed * 1103515245u + 12345u;
			used += (size_t)snprintf(text + used, sizeof(text) - used, "%s",
				piece[(seed >> 16) % (sizeof(piece) / sizeof(*piece))]);
		}
		io_text_read(&io, text, strlen(text));
		for (int i = 0; i < io.count; i++)
			for (int f = 0; f < IO_FIELDS; f++) {
				static const char *const value[] = { "", "1", "x 7", "pull-up" };
				char *was = io_text_field(&io, i, (enum io_field)f), *now;
				struct io_edit edit;
				struct io_text after;
				enum io_refusal why;

				rows++;
				bad += io.row[i].from > io.row[i].end || io.row[i].end > io.len ||
				       io.row[i].words_end > io.row[i].end;
				why = io_text_set(&io, i, (enum io_field)f,
						  value[(seed + (unsigned)f) % 4], &edit);
				if (why == IO_GOOD) {
					edits++;
					bad += edit.at < io.row[i].from ||
					       edit.at + edit.removed > io.row[i].end;
					now = edited(text, why, &edit);
					io_text_read(&after, now, strlen(now));
					bad += after.count != io.count;
					if (after.count != io.count)
						printf("# %s\n# %s\n", text, now);
					io_text_free(&after);
					free(now);
				}
				/* setting the present value changes nothing, unless the map
				 * spells it differently */
				if (f != IO_LINE && f != IO_COMMENT && *was &&
				    io_text_set(&io, i, (enum io_field)f, was, &edit) == IO_GOOD) {
					bad += f != IO_ACTIVE_LOW && (edit.removed || *edit.with);
					free(edit.with);
				}
				free(was);
			}
		io_text_free(&io);
	}
	CHECK_AS(bad == 0 && rows > 10000 && edits > 5000,
		 "random texts give rows and edits inside the text");
	printf("# %d fields, %d edits, %d bad\n", rows, edits, bad);
}

/* ---- lines that are more than a pin ---- */

static const char field[] =
	"BOARD \"Plant\"\n"
	"BUS   rs485  modbus-rtu  port=/dev/ttyS1 baud=19200 (* slow *) parity=even\n"
	"BUS   plant  modbus-tcp  host=10.0.0.20:502 timeout=300ms   # the hall\n"
	"MODULE Card  di=16 dq=8  discrete-input=100\n"
	"%AIW0       iio     device=ads1115 channel=voltage0  range=0..27648 at 0V..10V  filter=50ms\n"
	"%AIW2       w1      sensor=28-000005e2fdc3 // outside\n"
	"%AQW0       pwm     chip=pwmchip0 channel=0 period=20ms\n"
	"%XIB0..2    module  bus=rs485 unit=1 type=DIO1000 safe=0\n"
	"%IW100..106 modbus  bus=plant unit=1 input-register=0 poll=100ms\n"
	"%QX40.0     modbus  bus=plant unit=1 coil=16 on-change\n"
	"%IW120      peer    from=\"pump house\" name=Level\n"
	"SERVE   plc  modbus-tcp  listen=127.0.0.1:502\n"
	"WINDOW  plc  coil=0..15 %QX0.0 read-only\n"
	"PUBLISH pump-house Level, Running every=100ms\n";

static void kinds(void)
{
	struct io_text io;

	CHECK(io_text_read(&io, field, strlen(field)) && io.count == 13);
	CHECK(io.row[0].kind == IO_KIND_BUS && io.row[2].kind == IO_KIND_MODULE &&
	      io.row[3].kind == IO_KIND_POINT && io.row[10].kind == IO_KIND_SERVE &&
	      io.row[11].kind == IO_KIND_WINDOW && io.row[12].kind == IO_KIND_PUBLISH);
	check_field(&io, 0, IO_ADDRESS, "rs485");
	check_field(&io, 0, IO_DRIVER, "modbus-rtu");
	check_field(&io, 0, IO_PARITY, "even");
	check_field(&io, 1, IO_HOST, "10.0.0.20:502");
	check_field(&io, 2, IO_DI, "16");
	check_field(&io, 2, IO_FIRST_DI, "100");
	check_field(&io, 2, IO_TABLE, "");
	check_field(&io, 3, IO_DEVICE, "ads1115");
	check_field(&io, 3, IO_RANGE, "0..27648 at 0V..10V");
	check_field(&io, 4, IO_DEVICE, "28-000005e2fdc3");
	check_field(&io, 5, IO_DEVICE, "pwmchip0");
	check_field(&io, 5, IO_LINE, "");
	check_field(&io, 6, IO_TYPE, "DIO1000");
	check_field(&io, 7, IO_TABLE, "input-register");
	check_field(&io, 7, IO_NUMBER, "0");
	check_field(&io, 7, IO_FIRST_AI, "");
	check_field(&io, 8, IO_ON_CHANGE, "1");
	check_field(&io, 9, IO_DEVICE, "\"pump house\"");
	check_field(&io, 9, IO_CHANNEL, "Level");
	check_field(&io, 10, IO_LISTEN, "127.0.0.1:502");
	check_field(&io, 11, IO_ADDRESS, "%QX0.0");
	check_field(&io, 11, IO_BUS, "plc");
	check_field(&io, 11, IO_NUMBER, "0..15");
	check_field(&io, 11, IO_ACCESS, "read-only");
	check_field(&io, 12, IO_NAMES, "Level, Running");
	check_field(&io, 12, IO_EVERY, "100ms");
	CHECK(io_text_has(&io, 0, IO_BAUD) && !io_text_has(&io, 0, IO_HOST) &&
	      io_text_has(&io, 3, IO_FILTER) && !io_text_has(&io, 3, IO_SAFE) &&
	      io_text_has(&io, 5, IO_SAFE) && !io_text_has(&io, 5, IO_STALE));
	io_text_free(&io);
}

static void values(void)
{
	static const char range[] = "%AIW0 iio device=a channel=b range=0..9 at 0V..10V  filter=5ms\n";
	static const char coil[] = "%QX1.0 modbus bus=p unit=1 coil=16 safe=0\n";
	struct io_values got;
	struct iec_addr at;

	SET(range, 0, IO_RANGE, "0..9 at 4mA..20mA",
	    "%AIW0 iio device=a channel=b range=0..9 at 4mA..20mA filter=5ms\n");
	SET(range, 0, IO_RANGE, "0..9", "%AIW0 iio device=a channel=b range=0..9             filter=5ms\n");
	SET(range, 0, IO_RANGE, "", "%AIW0 iio device=a channel=b                        filter=5ms\n");
	SET("%AIW0 iio device=a\n", 0, IO_RANGE, "0..9 at 0V..10V",
	    "%AIW0 iio device=a range=0..9 at 0V..10V\n");
	SET(range, 0, IO_RANGE, "0..9 to 10V", "(1)");
	SET("%AIW0 w1\n", 0, IO_DEVICE, "28-1", "%AIW0 w1 sensor=28-1\n");
	SET("%AQW0 pwm\n", 0, IO_DEVICE, "pwmchip1", "%AQW0 pwm chip=pwmchip1\n");
	SET("%IW0 peer\n", 0, IO_DEVICE, "pump house", "%IW0 peer from=\"pump house\"\n");
	SET("%AIW0 w1 device=x\n", 0, IO_DEVICE, "28-1", "%AIW0 w1 sensor=28-1\n");
	SET(coil, 0, IO_TABLE, "holding-register", "%QX1.0 modbus bus=p unit=1 holding-register=16 safe=0\n");
	SET(coil, 0, IO_NUMBER, "17", "%QX1.0 modbus bus=p unit=1 coil=17 safe=0\n");
	SET(coil, 0, IO_TABLE, "what", "(2)");
	SET(coil, 0, IO_SAFE, "hold", "%QX1.0 modbus bus=p unit=1 coil=16 safe=hold\n");
	SET(coil, 0, IO_PULL, "pull-up", "(7)");
	SET("%IW0 modbus bus=p unit=1\n", 0, IO_NUMBER, "5", "%IW0 modbus bus=p unit=1 input-register=5\n");
	SET("%IW0 modbus bus=p unit=1\n", 0, IO_ASK, "Meter", "%IW0 modbus bus=p unit=1 ask=Meter\n");
	SET("%IW0 sim\n", 0, IO_ASK, "Meter", "(7)");
	SET("DEVICE p unit=1\n", 0, IO_GAP, "0", "DEVICE p unit=1 gap=0\n");
	SET("DEVICE p unit=1 gap=4\n", 0, IO_TOGETHER, "1", "DEVICE p unit=1 gap=4 together\n");
	SET("DEVICE p unit=1\n", 0, IO_UNIT, "7", "DEVICE p unit=7\n");
	SET("DEVICE p unit=1\n", 0, IO_HOST, "h", "(7)");
	SET("BUS\n", 0, IO_ADDRESS, "plant", "BUS plant\n");
	SET("BUS\n", 0, IO_DRIVER, "peer", "(3)");
	SET("BUS a b\n", 0, IO_ADDRESS, "", "(3)");
	SET("WINDOW plc coil=0 %QX0.0 read-only\n", 0, IO_BUS, "", "(3)");
	SET("WINDOW plc coil=0 %QX0.0 read-only\n", 0, IO_ADDRESS, "%QX1.0",
	    "WINDOW plc coil=0 %QX1.0 read-only\n");
	SET("PUBLISH a B, C every=1s D\n", 0, IO_NAMES, "E, F,G", "PUBLISH a E, F,G every=1s D\n");
	SET("PUBLISH a B\n", 0, IO_NAMES, "E every=1s", "(6)");
	CHECK(io_values_read("%IW100..106", 11, &got) && got.count == 4 && got.first.byte == 100);
	CHECK(iec_addr_parse("%IX106.7", 8, &at) == ADDR_OK && io_values_have(&got, at));
	CHECK(iec_addr_parse("%IX107.7", 8, &at) == ADDR_OK && io_values_have(&got, at));
	CHECK(iec_addr_parse("%IB108", 6, &at) == ADDR_OK && !io_values_have(&got, at));
	CHECK(io_values_read("%QX40.6..41.1", 13, &got) && got.count == 4);
	CHECK(io_values_read("%QX40.6..7", 10, &got) && got.count == 2);
	CHECK(!io_values_read("%QX40.6..5", 10, &got) && !io_values_read("%IW0..", 6, &got) &&
	      !io_values_read("%IW0..x", 7, &got) && !io_values_read("BUS", 3, &got));
}

static void moved(void)
{
	static const char three[] = "a b # 1\n# own\nc d\ne f";
	static const struct { int row, target; bool behind; const char *want; } move[] = {
		{ 0, 1, true, "# own\nc d\na b # 1\ne f" }, { 0, 2, true, "# own\nc d\ne f\na b # 1" },
		{ 2, 0, false, "e f\na b # 1\n# own\nc d" }, { 1, 0, false, "c d\na b # 1\n# own\ne f" },
		{ 1, 1, true, "a b # 1\n# own\nc d\ne f" },
	};
	struct io_text io;
	struct io_edit edit;

	io_text_read(&io, three, strlen(three));
	for (size_t i = 0; i < sizeof(move) / sizeof(*move); i++) {
		char *got = edited(three, io_text_move(&io, move[i].row, move[i].target, move[i].behind,
						       &edit), &edit);

		CHECK_TEXT(got, move[i].want);
		free(got);
	}
	io_text_free(&io);
	io_text_read(&io, "(* a\n *) b c\nd e\n", 18);
	CHECK(io_text_move(&io, 0, 1, true, &edit) == IO_SHARED_LINE);
	io_text_free(&io);
}

/* Fields that show the words of another one. */
static bool is_of(enum io_field a, enum io_field b)
{
	return (a == IO_TABLE || a == IO_NUMBER) && (b == IO_TABLE || b == IO_NUMBER);
}

/* A name with blanks has quotes. */
static bool is_shown(const char *text, const char *value)
{
	const size_t len = strlen(value);

	return strcmp(text, value) == 0 ||
	       (text[0] == '"' && strncmp(text + 1, value, len) == 0 && strcmp(text + 1 + len, "\"") == 0);
}

/* Whether the value that was set is shown, and everything else is as before. */
static bool changed_only(const struct io_text *was, const struct io_text *now, int row,
			 enum io_field set_one, const char *value)
{
	bool good = now->count == was->count;

	for (int i = 0; good && i < was->count; i++)
		for (int f = 0; good && f < IO_FIELDS; f++) {
			char *before = io_text_field(was, i, (enum io_field)f);
			char *after = io_text_field(now, i, (enum io_field)f);

			if (i == row && f == (int)set_one)
				good = is_shown(after, value);
			else if (i != row || !is_of((enum io_field)f, set_one))
				good = strcmp(before, after) == 0;
			free(before);
			free(after);
		}
	return good;
}

/* Random maps of lines of all kinds, and random edits. */
static void edits(void)
{
	static const char *const value[] = { "", "7", "50ms", "0..5 at 0V..1V", "little", "even", "1",
		"coil", "read-write", "x", "Level, Flow", "10.0.0.1:502", "hold" };
	const char *line[32];
	unsigned int seed = 7;
	int lines = 0, bad = 0, good = 0;

	for (const char *at = field; *at; at = strchr(at, '\n') + 1)
		line[lines++] = at;
	for (int round = 0; round < 6000; round++) {
		char text[1024] = "", *now;
		struct io_text io, after;
		struct io_edit edit;
		enum io_refusal why;
		size_t used = 0;
		int row, f;
		const char *with;

		for (int i = 0; i < 6; i++) {
			const char *from;

			seed = seed * 1103515245u + 12345u;
			from = line[1 + (seed >> 16) % (unsigned)(lines - 1)];
			used += (size_t)snprintf(text + used, sizeof(text) - used, "%.*s\n",
						 (int)strcspn(from, "\n"), from);
		}
		io_text_read(&io, text, strlen(text));
		seed = seed * 1103515245u + 12345u;
		row = (int)((seed >> 16) % (unsigned)io.count);
		seed = seed * 1103515245u + 12345u;
		f = IO_DRIVER + 1 + (int)((seed >> 16) % (unsigned)(IO_FIELDS - IO_DRIVER - 1));
		seed = seed * 1103515245u + 12345u;
		with = value[(seed >> 16) % (sizeof(value) / sizeof(*value))];
		why = io_text_set(&io, row, (enum io_field)f, with, &edit);
		if (why == IO_GOOD) {
			now = edited(text, why, &edit);
			io_text_read(&after, now, strlen(now));
			good++;
			/* a line without a table has no number */
			if (!changed_only(&io, &after, row, (enum io_field)f, with)) {
				bad++;
				printf("# %s: \"%s\"\n# %s# %s", io_field_name((enum io_field)f), with,
				       text, now);
			}
			io_text_free(&after);
			free(now);
		}
		io_text_free(&io);
	}
	CHECK_AS(bad == 0 && good > 500, "an edit of a random map changes one field");
	printf("# %d edits, %d bad\n", good, bad);
}

int main(void)
{
	kinds();
	values();
	moved();
	edits();
	fields();
	words();
	refused();
	lines();
	spread();
	storm();
	return tap_done();
}
