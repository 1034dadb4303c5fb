/* SPDX-License-Identifier: MIT
 *
 * test_text - texts as snprintf() makes them, at each size; numbers; lines of the log.
 */
#define _GNU_SOURCE /* dup2() in C11 */
#include "guard/text.h"

#include "tests/tap.h"

#include <limits.h>
#include <string.h>
#include <unistd.h>

/* Compares text_print() with snprintf(), for each size from 0 on. */
#define SAME(...) do { \
	char want[200], got[200]; \
	const int len = snprintf(want, sizeof(want), __VA_ARGS__); \
	int bad = text_print(NULL, 0, __VA_ARGS__) != len; \
	for (size_t size = 1; size < (size_t)len + 3; size++) { \
		memset(want, 'w', sizeof(want)); \
		memset(got, 'w', sizeof(got)); \
		snprintf(want, size, __VA_ARGS__); \
		bad += text_print(got, size, __VA_ARGS__) != len || memcmp(got, want, sizeof(got)) != 0; \
	} \
	CHECK_AS(bad == 0, #__VA_ARGS__); \
} while (0)

static void test_print(void)
{
	SAME("nothing to fill in");
	SAME("%s", "");
	SAME("\"%s\" and %s", "/dev/gpiochip0", "more");
	SAME("%.*s!", 3, "abcdef");
	SAME("%.*s!", 9, "abcdef");
	SAME("%.*s!", 0, "abcdef");
	SAME("%d %d %d %d", 0, -1, INT_MAX, INT_MIN);
	SAME("%u %u", 0u, UINT_MAX);
	SAME("%lld %lld %lld", 0LL, LLONG_MAX, LLONG_MIN);
	SAME("%d%s%u", 12, "-", 34u);
}

static void test_number(void)
{
	static const struct { const char *text; long long value; } rows[] = {
		{ "0", 0 }, { "7", 7 }, { "0050", 50 }, { "2000000000", 2000000000 }, { "2000000001", -1 },
		{ "99999999999999999999999", -1 }, { "", -1 }, { "-1", -1 }, { "+1", -1 }, { "5x", -1 }, { "5 ", -1 }, { ":", -1 }, { "/", -1 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		CHECK_AS(text_number(rows[i].text) == rows[i].value, rows[i].text);
}

/* What text_say() writes, into @out. */
static size_t said(const char *text, char *out, size_t size)
{
	FILE *file = tmpfile();
	const int before = dup(STDERR_FILENO);
	size_t len = 0;

	if (!file)
		return 0;
	dup2(fileno(file), STDERR_FILENO);
	text_say("%s", text);
	dup2(before, STDERR_FILENO);
	close(before);
	rewind(file);
	len = fread(out, 1, size, file);
	fclose(file);
	return len;
}

static void test_say(void)
{
	char text[1000], out[1000];
	size_t len = said("it is safe", out, sizeof(out));

	CHECK(len == 25 && memcmp(out, "ladder-guard: it is safe\n", len) == 0);
	memset(text, 'x', sizeof(text));
	text[sizeof(text) - 1] = '\0';
	len = said(text, out, sizeof(out));
	CHECK_AS(len == 499 && out[len - 2] == 'x' && out[len - 1] == '\n', "a long one is clipped, and is one line");
}

int main(void)
{
	test_print();
	test_number();
	test_say();
	return tap_done();
}
