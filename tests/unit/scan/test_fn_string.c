/* SPDX-License-Identifier: MIT
 *
 * test_fn_string - text functions at the limits: 255 bytes, positions of any size and
 * sign, bytes of every value, results that overwrite an input.
 */
#include "engine/scan/vm.h"
#include "tests/tap.h"

#include <string.h>

static struct iec_text texts[LIMIT_FN_INPUTS], room;
static struct fn_args args;

static struct iec_string *text(int pin)
{
	return (void *)texts[pin].word;
}

/* Texts at the first pins, then numbers of LINT. */
static void ready(const char *a, const char *b, int64_t first, int64_t second)
{
	const char *from[] = { a, b };
	int pin = 0;

	args = (struct fn_args){ .type = IEC_STRING, .result = IEC_STRING,
				 .room = iec_text_init(&room, 0) };
	for (int i = 0; i < 2 && from[i]; i++, pin++) {
		memcpy(iec_text_init(&texts[pin], (uint16_t)strlen(from[i]))->text,
		       from[i], strlen(from[i]));
		args.in_type[pin] = IEC_STRING;
		args.in[pin].s = text(pin);
	}
	for (int i = 0; i < 2; i++, pin++) {
		args.in_type[pin] = IEC_LINT;
		args.in[pin].i = i ? second : first;
	}
	args.count = (uint32_t)pin;
}

typedef enum fn_status (*fn)(struct fn_args *);

static bool gives(fn f, const char *want)
{
	return f(&args) == FN_OK && args.out.s->length == strlen(want) &&
	       memcmp(args.out.s->text, want, strlen(want)) == 0;
}

static bool fails(fn f)
{
	return f(&args) == FN_FAILED;
}

static void lengths(void)
{
	ready("abc", NULL, INT64_MAX, 0);
	CHECK(gives(fn_LEFT, "abc") && gives(fn_RIGHT, "abc"));
	ready("abc", NULL, INT64_MIN, 0);
	CHECK(fails(fn_LEFT) && fails(fn_RIGHT));
	args.in_type[1] = IEC_ULINT; /* 2^63 */
	CHECK(gives(fn_LEFT, "abc") && gives(fn_RIGHT, "abc"));
	ready("abc", NULL, 0, 0);
	CHECK(gives(fn_LEFT, "") && gives(fn_RIGHT, ""));
	ready("", NULL, 5, 0);
	CHECK(gives(fn_LEFT, "") && gives(fn_RIGHT, ""));
}

static void positions(void)
{
	ready("abc", NULL, 1, 3);
	CHECK(gives(fn_MID, "c") && gives(fn_DELETE, "ab"));
	ready("abc", NULL, INT64_MAX, 2);
	CHECK(gives(fn_MID, "bc") && gives(fn_DELETE, "a"));
	ready("abc", NULL, 1, 4);
	CHECK(fails(fn_MID) && fails(fn_DELETE));
	ready("abc", NULL, 1, 0);
	CHECK(fails(fn_MID) && fails(fn_DELETE));
	ready("abc", NULL, 1, INT64_MIN);
	CHECK(fails(fn_MID) && fails(fn_DELETE));
	args.in_type[2] = IEC_ULINT;
	CHECK(fails(fn_MID));
	ready("abc", NULL, -1, 1);
	CHECK(fails(fn_MID) && fails(fn_DELETE));
	ready("abc", "xy", 4, 0);
	CHECK(fails(fn_INSERT));
	ready("abc", "xy", -1, 0);
	CHECK(fails(fn_INSERT));
	ready("abc", "xy", 3, 0);
	CHECK(gives(fn_INSERT, "abcxy"));
	ready("", "xy", 0, 0);
	CHECK(gives(fn_INSERT, "xy"));
	ready("abc", "", 3, 1);
	CHECK(gives(fn_REPLACE, ""));
	ready("abc", "xyz", 0, 3);
	CHECK(gives(fn_REPLACE, "abxyzc"));
}

static void cuts(void)
{
	char long_text[256];

	memset(long_text, 'x', 255);
	long_text[255] = '\0';
	ready(long_text, "ab", 255, 0);
	CHECK(fn_INSERT(&args) == FN_WRAPPED && args.out.s->length == 255);
	args.count = 2;
	CHECK(fn_CONCAT(&args) == FN_WRAPPED && args.out.s->length == 255);
	ready(long_text, "ab", 2, 254);
	CHECK(fn_REPLACE(&args) == FN_OK && args.out.s->length == 255 &&
	      memcmp(args.out.s->text + 253, "ab", 2) == 0);
	ready(long_text, "", 0, 0);
	args.count = 2;
	CHECK(fn_CONCAT(&args) == FN_OK && args.out.s->length == 255);
	for (int i = 0; i < LIMIT_FN_INPUTS; i++)
		args.in[i].s = text(0);
	args.count = LIMIT_FN_INPUTS;
	CHECK_AS(fn_CONCAT(&args) == FN_WRAPPED && args.out.s->length == 255,
		 "sixteen texts of 255 bytes are cut to 255");
	CHECK(fn_LEN(&args) == FN_OK && args.out.i == 255);
}

static void finds(void)
{
	ready("abcabc", "bc", 0, 0);
	CHECK(fn_FIND(&args) == FN_OK && args.out.i == 2);
	ready("abc", "abcd", 0, 0);
	CHECK(fn_FIND(&args) == FN_OK && args.out.i == 0);
	ready("abc", "abc", 0, 0);
	CHECK(fn_FIND(&args) == FN_OK && args.out.i == 1);
	ready("abc", "", 0, 0);
	CHECK(fn_FIND(&args) == FN_OK && args.out.i == 0);
	ready("", "", 0, 0);
	CHECK(fn_FIND(&args) == FN_OK && args.out.i == 0);
	ready("aXb", "X", 0, 0);
	((struct iec_string *)args.in[0].s)->text[1] = '\0';
	((struct iec_string *)args.in[1].s)->text[0] = '\0';
	CHECK_AS(fn_FIND(&args) == FN_OK && args.out.i == 2, "FIND finds a byte of 0");
}

int main(void)
{
	lengths();
	positions();
	cuts();
	finds();
	return tap_done();
}
