/* SPDX-License-Identifier: MIT
 *
 * test_args - parameters of a box are split; malformed ones end the list.
 */
#include "engine/model/args.h"
#include "tests/tap.h"

static bool is(const char *text, size_t len, const char *want)
{
	return strlen(want) == len && memcmp(text, want, len) == 0;
}

static void takes_apart(void)
{
	const char *text = "PT:=T#3s CV=>Count IN:=-5", *at = text;
	struct arg arg;

	CHECK(args_next(&at, &arg));
	CHECK(is(arg.pin, arg.pin_len, "PT"));
	CHECK(is(arg.value, arg.value_len, "T#3s"));
	CHECK(!arg.output);
	CHECK(args_next(&at, &arg));
	CHECK(is(arg.pin, arg.pin_len, "CV"));
	CHECK(is(arg.value, arg.value_len, "Count"));
	CHECK(arg.output);
	CHECK(args_next(&at, &arg));
	CHECK(is(arg.value, arg.value_len, "-5"));
	CHECK(!args_next(&at, &arg));
	CHECK(!args_next(&at, &arg));
	CHECK(args_find(text, "cv", 2, &arg));
	CHECK(is(arg.value, arg.value_len, "Count"));
	CHECK(!args_find(text, "C", 1, &arg));
	CHECK(!args_find("", "CV", 2, &arg));
	CHECK(args_find("PT := T#3s", "PT", 2, &arg));
	CHECK(is(arg.value, arg.value_len, "T#3s"));
}

static void stops_at_nonsense(void)
{
	static const char *const bad[] = {
		"", " ", "PT", "PT:", "PT:=", "PT=", "PT=>", ":=5", "=>x",
		"PT=5", "PT:5", ":", "=",
	};
	struct arg arg;

	for (size_t i = 0; i < sizeof(bad) / sizeof(*bad); i++) {
		const char *at = bad[i];

		CHECK_AS(!args_next(&at, &arg), bad[i]);
	}
}

int main(void)
{
	takes_apart();
	stops_at_nonsense();
	return tap_done();
}
