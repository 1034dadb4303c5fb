/* SPDX-License-Identifier: MIT
 *
 * test_foreign - no text of a board makes a line of its own or speaks to the terminal.
 */
#include "ladder/foreign.h"

#include "tests/tap.h"

static void shows(const char *text, size_t len, const char *shown)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink out = sink_to_memory(&memory);

	foreign_write(&out, text, len);
	CHECK_TEXT(sink_memory_text(&memory), shown);
	sink_memory_free(&memory);
}

int main(void)
{
	shows("Pump", 4, "Pump");
	shows("", 0, "");
	shows("a\nb\tc\x7f", 6, "a?b?c?");
	shows("\x1b[2Jx", 5, "?[2Jx");
	shows("a\0b", 3, "a?b");
	shows("\xe7\x81\xaf\xc3\x9f", 5, "\xe7\x81\xaf\xc3\x9f");
	shows("\xc2\x9b" "2J", 4, "?2J");
	shows("\xc2\xa0\xc2", 3, "\xc2\xa0\xc2");
	return tap_done();
}
