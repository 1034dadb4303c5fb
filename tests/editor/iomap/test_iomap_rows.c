/* SPDX-License-Identifier: MIT
 *
 * test_iomap_rows - what the table of an I/O map offers for each field: the lines of a machine that
 * has some, or none, and the words of the language.
 */
#include "editor-gtk/iomap/iomap_rows.h"
#include "tests/tap.h"

#include <string.h>

/* "text (description)|...": all that is offered. */
static void offers(const struct io_machine *machine, enum io_field field, const char *want)
{
	const struct io_uses uses = { 0 };
	const struct io_text io = { 0 };
	GPtrArray *choices = iomap_choices(&uses, machine, &io, -1, field);
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
	return tap_done();
}
