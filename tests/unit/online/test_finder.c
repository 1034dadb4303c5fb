/* SPDX-License-Identifier: MIT
 *
 * test_finder - texts from the network, and serial ports of a folder.
 */
#include "online/finder.h"
#include "tests/tap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void test_texts_lose_control_characters(void)
{
	char out[8];

	finder_text(out, sizeof(out), "a\033[1m", 5);
	CHECK(strcmp(out, "a?[1m") == 0);
	finder_text(out, sizeof(out), "a\0b\177", 4);
	CHECK(strcmp(out, "a?b?") == 0);
	finder_text(out, sizeof(out), "", 0);
	CHECK(!*out);
}

static void test_long_texts_end_with_a_whole_character(void)
{
	char out[8];

	finder_text(out, sizeof(out), "abcdefgh", 8);
	CHECK(strcmp(out, "abcdefg") == 0);
	finder_text(out, sizeof(out), "abcdef\303\274", 8);
	CHECK(strcmp(out, "abcdef") == 0);
	finder_text(out, sizeof(out), "\200\200\200\200\200\200\200\200\200", 9);
	CHECK(strlen(out) < sizeof(out));
}

static void test_ports_are_sorted(void)
{
	static const char *const names[] = { "ttyUSB1", "ttyACM0", "ttyS0", "null", "ttyUSB0" };
	char folder[] = "portsXXXXXX", path[64], out[3][64];
	int count;

	CHECK(mkdtemp(folder) != NULL);
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
		snprintf(path, sizeof(path), "%s/%s", folder, names[i]);
		fclose(fopen(path, "w"));
	}
	count = finder_ports(folder, out, 3);
	CHECK(count == 3);
	snprintf(path, sizeof(path), "%s/ttyACM0", folder);
	CHECK(count == 3 && strcmp(out[0], path) == 0);
	CHECK(finder_ports(folder, out, 1) == 1);
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
		snprintf(path, sizeof(path), "%s/%s", folder, names[i]);
		unlink(path);
	}
	rmdir(folder);
	CHECK(finder_ports(folder, out, 3) == 0);
}

int main(void)
{
	test_texts_lose_control_characters();
	test_long_texts_end_with_a_whole_character();
	test_ports_are_sorted();
	return tap_done();
}
