/* SPDX-License-Identifier: MIT
 *
 * test_print_static - ladderd's own printf writes what that of the C library writes.
 */
#include "tests/tap.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

int __wrap_snprintf(char *text, size_t size, const char *format, ...)
	__attribute__((format(printf, 3, 4)));
int __wrap_fprintf(FILE *file, const char *format, ...) __attribute__((format(printf, 2, 3)));

#define SAME(room, ...) do { \
	volatile size_t size = room; /* the compiler warns of texts that it sees cut */ \
	char ours[80], theirs[80]; \
	memset(ours, '#', sizeof(ours)); \
	memset(theirs, '#', sizeof(theirs)); \
	const int len = __wrap_snprintf(ours, size, __VA_ARGS__); \
	const int want = snprintf(theirs, size, __VA_ARGS__); \
	CHECK(len == want && memcmp(ours, theirs, sizeof(ours)) == 0); \
	if (len != want || memcmp(ours, theirs, sizeof(ours)) != 0) \
		printf("# \"%.60s\" instead of \"%.60s\"\n", ours, theirs); \
} while (0)

static void test_numbers(void)
{
	SAME(80, "%d %i %d %d", 0, -7, INT32_MIN, INT32_MAX);
	SAME(80, "%u %x %X %o", 0u, 0xbeefu, 0xbeefu, 8u);
	SAME(80, "%ld %lu %zu", -5L, 5UL, (size_t)77);
	SAME(80, "%lld %lld", (long long)INT64_MIN, (long long)INT64_MAX);
	SAME(80, "%llu %llx", (unsigned long long)UINT64_MAX, (unsigned long long)UINT64_MAX);
	SAME(80, "%hu %hhu", (unsigned short)65535, (unsigned char)255);
	SAME(80, "[%5d][%-5d][%05d][%05d]", 42, 42, 42, -42);
	SAME(80, "[%*d][%-*d][%.3d][%8.3d]", 6, 1, 6, 2, 7, 8);
	SAME(80, "[%08x][%04X][%02d][%03o]", 0x1234u, 0xabu, 5, 7u);
	SAME(80, "[%040d]", 7);
}

static void test_texts(void)
{
	SAME(80, "%s|%.3s|%.*s|%.0s|%c", "rung", "rung", 2, "rung", "rung", 'x');
	SAME(80, "[%10s][%-10s][%10.2s][%-3c]", "a", "b", "cde", 'd');
	SAME(80, "100 %% %d%%", 5);
	SAME(80, "plain");
}

/* The length is that of the whole text; nothing is written beyond the room. */
static void test_room(void)
{
	SAME(5, "%s", "rungs are cut");
	SAME(1, "%d", 12345);
	SAME(4, "ab%05d", 1);
	CHECK(__wrap_snprintf(NULL, 0, "%s-%d", "four", 1) == 6);
}

static void test_file(void)
{
	FILE *file = tmpfile();
	char text[700], long_one[600];

	memset(long_one, 'y', sizeof(long_one) - 1);
	long_one[sizeof(long_one) - 1] = '\0';
	CHECK(__wrap_fprintf(file, "<%s>%d\n", long_one, 9) == 603);
	rewind(file);
	CHECK(fgets(text, sizeof(text), file) && strlen(text) == 603 && text[0] == '<' &&
	      memcmp(text + 1, long_one, 599) == 0 && strcmp(text + 600, ">9\n") == 0);
	fclose(file);
	file = fopen("/dev/full", "w");
	if (file) {
		setvbuf(file, NULL, _IONBF, 0);
		CHECK(__wrap_fprintf(file, "%d", 1) < 0);
		fclose(file);
	}
}

int main(void)
{
	test_numbers();
	test_texts();
	test_room();
	test_file();
	return tap_done();
}
