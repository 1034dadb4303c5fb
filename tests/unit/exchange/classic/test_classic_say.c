/* SPDX-License-Identifier: MIT
 *
 * test_classic_say - variables, blocks, expressions and symbols as ClassicLadder shows them.
 */
#include "engine/exchange/classic/classic_say.h"
#include "tests/tap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *variable(enum classic_dialect dialect, int type, int number,
			    int index_type, int index_number)
{
	static char out[CLASSIC_SAID];

	classic_say_variable(dialect, (struct classic_variable){ type, number, index_type,
								 index_number }, out);
	return out;
}

static const char *expression(const char *text)
{
	static char out[CLASSIC_SAID];

	classic_say_expression(CLASSIC_UPSTREAM, text, out);
	return out;
}

static void test_variables(void)
{
	CHECK_TEXT(variable(CLASSIC_UPSTREAM, 0, 3, -1, 0), "%B3");
	CHECK_TEXT(variable(CLASSIC_UPSTREAM, 15, 1, -1, 0), "%TM1.Q");
	CHECK_TEXT(variable(CLASSIC_UPSTREAM, 30, 7, -1, 0), "%X7.A");
	CHECK_TEXT(variable(CLASSIC_UPSTREAM, 220, 7, -1, 0), "%X7.V");
	CHECK_TEXT(variable(CLASSIC_UPSTREAM, 200, 0, 200, 4), "%W0[%W4]");
	/* Type 300 has another meaning in LinuxCNC. */
	CHECK_TEXT(variable(CLASSIC_UPSTREAM, 300, 2, -1, 0), "%R2.I");
	CHECK_TEXT(variable(CLASSIC_LINUXCNC, 300, 2, -1, 0), "%IF2");
	CHECK_TEXT(variable(CLASSIC_UPSTREAM, 999, -5, -1, 0), "?999/-5");
	CHECK_TEXT(variable(CLASSIC_UPSTREAM, 1, 2147483647, 77, 1), "?1/2147483647[?77/1]");
}

static void test_expressions(void)
{
	char *many = malloc(4000);

	CHECK_TEXT(expression("@200/0@:=@200/1@*2"), "%W0:=%W1*2");
	CHECK_TEXT(expression("@200/0[200/4]@>$1F"), "%W0[%W4]>$1F");
	CHECK_TEXT(expression(""), "");
	/* Text that is no variable stays. */
	CHECK_TEXT(expression("@"), "@");
	CHECK_TEXT(expression("@@"), "@@");
	CHECK_TEXT(expression("@200/@+@200/1@"), "@200/@+%W1");
	CHECK_TEXT(expression("@200/1"), "@200/1");
	if (!CHECK(many))
		return;
	memset(many, '1', 3999);
	many[3999] = '\0';
	CHECK(strlen(expression(many)) == CLASSIC_SAID - 1);
	many[0] = many[3998] = '@';
	CHECK(strlen(expression(many)) == CLASSIC_SAID - 1);
	free(many);
}

static void test_blocks(void)
{
	char out[CLASSIC_SAID];

	classic_say_block(10, 0, out);
	CHECK_TEXT(out, "%T0");
	classic_say_block(13, 4, out);
	CHECK_TEXT(out, "%TM4");
	classic_say_block(99, 1, out);
	CHECK_TEXT(out, "%?1");
}

static void test_symbols(void)
{
	struct classic_symbol symbol[] = { { .variable = "%I0", .name = "Start" },
					   { .variable = "%TM0", .name = "" } };
	struct classic_project project = { .symbol = symbol, .symbols = 2 };

	CHECK_TEXT(classic_say_symbol(&project, "%I0"), "Start");
	CHECK_TEXT(classic_say_symbol(&project, "%TM0"), "");
	CHECK_TEXT(classic_say_symbol(&project, "%I01"), "");
}

int main(void)
{
	test_variables();
	test_expressions();
	test_blocks();
	test_symbols();
	return tap_done();
}
