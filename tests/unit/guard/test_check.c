/* SPDX-License-Identifier: MIT
 *
 * test_check - a packet of each kind is taken; with another length or a field that is out of range it is not.
 */
#include "guard/check.h"

#include "tests/tap.h"

#include <string.h>

#define HEAD sizeof(struct guard_head)

static union guard_packet packet(unsigned kind, unsigned count)
{
	union guard_packet out;

	memset(&out, 0, sizeof(out));
	out.head = (struct guard_head){ .magic = GUARD_MAGIC, .kind = (uint16_t)kind, .count = (uint16_t)count };
	return out;
}

/* Only this length is taken. */
static bool takes_only(const union guard_packet *it, size_t len)
{
	bool good = guard_check(it, len);

	for (size_t i = 0; i <= sizeof(*it); i++)
		good = good && (i == len || !guard_check(it, i));
	return good;
}

static void test_heads(void)
{
	union guard_packet it = packet(GUARD_BEAT, 0);

	CHECK_AS(!guard_check(&it, HEAD), "a beat without a time");
	it.head.within_ms = 1;
	CHECK(takes_only(&it, HEAD));
	it.head.within_ms = GUARD_LONGEST;
	CHECK(guard_check(&it, HEAD));
	it.head.within_ms = GUARD_LONGEST + 1;
	CHECK(!guard_check(&it, HEAD));
	it = packet(GUARD_TAKE, 0);
	CHECK(takes_only(&it, HEAD));
	it.head.magic++;
	CHECK(!guard_check(&it, HEAD));
	for (unsigned kind = 0; kind < 20; kind++) {
		it = packet(kind, 0);
		if (kind < GUARD_BEAT || kind > GUARD_VALUES_MORE)
			CHECK_AS(!guard_check(&it, HEAD), "a kind that there is not");
	}
	it = packet(GUARD_LEVELS, 0);
	CHECK(takes_only(&it, sizeof(it.levels)));
	it = packet(GUARD_TELL, 0);
	CHECK(takes_only(&it, sizeof(it.tell)));
	memset(it.tell.text, 'x', sizeof(it.tell.text));
	CHECK_AS(!guard_check(&it, sizeof(it.tell)), "a text without an end");
}

static size_t table_len(unsigned count)
{
	return offsetof(struct guard_table, line) + count * sizeof(struct guard_line);
}

static void test_tables(void)
{
	static const struct guard_line bad[] = {
		{ .offset = 3, .level = 2 }, { .offset = 3, .bias = GUARD_THIRD + 1 }, { .offset = 3, .drive = GUARD_THIRD + 1 },
		{ .offset = 3, .hold = GUARD_KNOWN + 1 }, { .offset = 1 }, { .chip = 1, .offset = 0, .level = 255 },
	};

	for (unsigned kind = GUARD_TABLE; kind <= GUARD_MORE; kind += GUARD_MORE - GUARD_TABLE) {
		union guard_packet it = packet(kind, 3);

		it.table.dev[0] = '/';
		it.table.line[1] = (struct guard_line){ .offset = 1, .level = 1, .bias = GUARD_THIRD, .drive = GUARD_THIRD, .hold = GUARD_KNOWN };
		it.table.line[2] = (struct guard_line){ .chip = 1, .offset = 1 };
		CHECK_AS(takes_only(&it, table_len(3)), "one offset of two chips are two lines");
		for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
			it.table.line[2] = bad[i];
			if (!CHECK(!guard_check(&it, table_len(3))))
				printf("# row %zu\n", i);
		}
		it = packet(kind, GUARD_LINES);
		it.table.dev[0] = '/';
		for (int i = 0; i < GUARD_LINES; i++)
			it.table.line[i].offset = (uint16_t)i;
		CHECK(takes_only(&it, table_len(GUARD_LINES)));
		it.head.count = GUARD_LINES + 1;
		CHECK(!guard_check(&it, table_len(GUARD_LINES)) && !guard_check(&it, sizeof(it.table)));
		it.head.count = GUARD_LINES;
		it.table.dev[0] = 'd';
		CHECK_AS(!guard_check(&it, table_len(GUARD_LINES)), "no path");
		memset(it.table.dev, '/', sizeof(it.table.dev));
		CHECK_AS(!guard_check(&it, table_len(GUARD_LINES)), "a path without an end");
		it = packet(kind, 0);
		it.table.dev[0] = '/';
		CHECK(takes_only(&it, table_len(0)));
	}
}

static size_t add_file(union guard_packet *it, size_t len, size_t path)
{
	char *at = (char *)it + len;

	memset(at, 0, sizeof(int64_t));
	memset(at + sizeof(int64_t), 'x', path);
	at[sizeof(int64_t)] = '/';
	at[sizeof(int64_t) + path] = '\0';
	it->files.head.count++;
	return len + sizeof(int64_t) + path + 1;
}

static void test_files(void)
{
	for (unsigned kind = GUARD_VALUES; kind <= GUARD_VALUES_MORE; kind++) {
		union guard_packet it = packet(kind, 0);
		size_t len = offsetof(struct guard_files, record), first;

		CHECK(takes_only(&it, len));
		len = first = add_file(&it, len, GUARD_PATH - 1);
		CHECK_AS(takes_only(&it, len), "the longest path");
		len = add_file(&it, len, 1);
		CHECK(takes_only(&it, len));
		((char *)&it)[first - 1] = 'x';
		CHECK_AS(!guard_check(&it, len), "no end, but that of the next one");
		it = packet(kind, 0);
		len = add_file(&it, offsetof(struct guard_files, record), GUARD_PATH);
		CHECK_AS(!guard_check(&it, len), "too long a path");
		it = packet(kind, 0);
		len = add_file(&it, offsetof(struct guard_files, record), 5);
		it.files.record[sizeof(int64_t)] = 'x';
		CHECK_AS(!guard_check(&it, len), "no path");
		it = packet(kind, 0);
		len = offsetof(struct guard_files, record);
		for (int i = 0; i < GUARD_FILES; i++)
			len = add_file(&it, len, 3);
		CHECK(takes_only(&it, len));
		len = add_file(&it, len, 3);
		CHECK_AS(!guard_check(&it, len), "too many files");
	}
}

int main(void)
{
	test_heads();
	test_tables();
	test_files();
	return tap_done();
}
