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
	got = edited(sample, io_text_add(&io, 1, "%IX0.2", "sim", "", &edit), &edit);
	CHECK_AS(strstr(got, "# PA7\n%IX0.2  sim\n%QX0.0") != NULL,
		 "a line is added after another one");
	free(got);
	got = edited(sample, io_text_add(&io, -1, "%QX0.2", "sim", "Horn", &edit), &edit);
	CHECK_AS(strstr(got, "%Q what\n%QX0.2  sim  safe=0   # Horn\n") != NULL,
		 "a line is added after a last line without a newline");
	free(got);
	CHECK(io_text_add(&io, 0, "%Q X", "sim", "", &edit) == IO_MANY_WORDS);
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

int main(void)
{
	fields();
	words();
	refused();
	lines();
	spread();
	storm();
	return tap_done();
}
