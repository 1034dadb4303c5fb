/* SPDX-License-Identifier: MIT
 *
 * room - one program for the tests of a folder: it runs the test whose name it was
 * started with.
 *
 * The Makefile gives main() of each test its own name and lists the tests in TESTS:
 * TEST(test_fb) TEST(test_fn) … For each test it makes a link to the program.
 */
#include <stdio.h>
#include <string.h>

#define TEST(name) int main_##name(int argc, char **argv);
TESTS
#undef TEST

static const struct {
	const char *name;
	int (*run)(int argc, char **argv);
} tests[] = {
#define TEST(name) { #name, main_##name },
	TESTS
#undef TEST
};

int main(int argc, char **argv)
{
	const char *slash = strrchr(argv[0], '/'), *name = slash ? slash + 1 : argv[0];

	for (size_t i = 0; i < sizeof(tests) / sizeof(tests[0]); i++)
		if (strcmp(tests[i].name, name) == 0)
			return tests[i].run(argc, argv);
	fprintf(stderr, "%s: no test of that name; use one of the links beside it\n", argv[0]);
	return 2;
}
