/* SPDX-License-Identifier: MIT
 *
 * test_sink - text into memory, cut formats, and JSON strings of any bytes.
 */
#include "engine/base/sink.h"
#include "tests/tap.h"

static struct sink_memory memory;

static const char *json(const char *text, size_t len)
{
	struct sink sink = sink_to_memory(&memory);

	sink_memory_free(&memory);
	sink_json_string(&sink, text, len);
	return sink_memory_text(&memory);
}

static void test_text(void)
{
	struct sink sink;
	static char long_text[2000];

	sink_memory_init(&memory);
	CHECK_TEXT(sink_memory_text(&memory), "");
	sink = sink_to_memory(&memory);
	sink_text(&sink, "one ");
	sink_write(&sink, "two-", 3);
	sink_repeat(&sink, "ab", 2);
	sink_repeat(&sink, "ab", -1);
	sink_printf(&sink, " %d", 5);
	CHECK_TEXT(sink_memory_text(&memory), "one twoabab 5");
	memset(long_text, 'x', sizeof(long_text) - 1);
	sink_memory_free(&memory);
	sink_printf(&sink, "%s", long_text);
	CHECK(memory.len == 499);
	for (int i = 0; i < 100; i++)
		sink_text(&sink, long_text);
	CHECK(memory.len == 499 + 100 * 1999 && !memory.failed);
	CHECK(strlen(memory.text) == memory.len);
}

static void test_json(void)
{
	CHECK_TEXT(json("", 0), "\"\"");
	CHECK_TEXT(json("a\"b\\c\n\t\r\x1b\x7f", 10),
		   "\"a\\\"b\\\\c\\n\\t\\r\\u001b\\u007f\"");
	CHECK_TEXT(json("ä中", 5), "\"ä中\"");
	CHECK_TEXT(json("a\xff\x80z", 4), "\"a\\ufffd\\ufffdz\"");
	CHECK_TEXT(json("a\0b", 3), "\"a\\u0000b\"");
	CHECK_TEXT(json("\xe4\xb8", 2), "\"\\ufffd\\ufffd\"");

	struct sink sink = sink_to_memory(&memory);
	sink_memory_free(&memory);
	sink_json_text(&sink, NULL);
	sink_json_text(&sink, "x");
	CHECK_TEXT(sink_memory_text(&memory), "null\"x\"");
}

int main(void)
{
	test_text();
	test_json();
	sink_memory_free(&memory);
	return tap_done();
}
