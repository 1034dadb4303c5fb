/* SPDX-License-Identifier: MIT
 *
 * random_expression - comparisons and assignments of random projects.
 *
 * At most 49 bytes each, as in ClassicLadder. Divisions by zero and overflow are included;
 * text that ClassicLadder cannot read is not, because its result is not defined.
 */
#include "tests/classic/random_inside.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST = 49 };

struct expression { char text[200]; size_t len; int parens; };

static void add(struct expression *expression, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

static void add(struct expression *expression, const char *format, ...)
{
	size_t room = sizeof(expression->text) - expression->len;
	va_list args;
	int len;

	va_start(args, format);
	len = vsnprintf(expression->text + expression->len, room, format, args);
	va_end(args);
	if (len > 0 && (size_t)len < room)
		expression->len += (size_t)len;
}

static void add_variable(struct making *making, struct expression *expression)
{
	static const int types[] = { 200, 200, 200, 200, 200, 270, 230, 231, 240, 241, 250,
				     251, 260, 261, 220, 280, 301, 302 };
	int type = types[making_below(making, making->linuxcnc ? 16 : 18)];
	int most = type == 200 ? WORDS : type == 220 ? STEPS : BLOCKS;

	if (type == 200 && making_chance(making, 12))
		add(expression, "@200/%d[200/%d]@", making_below(making, 4),
		    FIRST_INDEX + making_below(making, INDICES));
	else
		add(expression, "@%d/%d@", type, making_below(making, most));
}

static void add_constant(struct making *making, struct expression *expression)
{
	if (making_chance(making, 70))
		add(expression, "%d", making_below(making, making_chance(making, 80) ? 20 : 100000));
	else if (making_chance(making, 50))
		add(expression, "$%X", making_below(making, 300));
	else if (making_chance(making, 50))
		add(expression, "'%c'", 'A' + making_below(making, 26));
	else
		add(expression, "-%d", making_below(making, 50));
}

static void add_function(struct making *making, struct expression *expression)
{
	static const char *const many[] = { "MINI", "MAXI", "AVG", "MOY" };
	static const char *const two[] = { "SHL", "SHR", "ROL", "ROR" };

	if (making_chance(making, 25)) {
		add(expression, "ABS(");
		add_variable(making, expression);
	} else if (making_chance(making, 60)) {
		add(expression, "%s(", many[making_below(making, 4)]);
		for (int i = making_below(making, 2); i >= 0; i--) {
			add_variable(making, expression);
			add(expression, ",");
		}
		add(expression, "%d", making_below(making, 30));
	} else if (making->linuxcnc) {
		add(expression, "ABS(@200/%d@", making_below(making, WORDS));
	} else if (making_chance(making, 20)) { /* no more than 32 bits           */
		add(expression, "POW(@261/%d@,%d", making_below(making, BLOCKS),
		    making_below(making, 5));
	} else {
		add(expression, "%s(", two[making_below(making, 4)]);
		add_variable(making, expression);
		add(expression, ",%d", making_below(making, 9));
	}
	add(expression, ")");
}

static void add_term(struct making *making, struct expression *expression)
{
	if (making_chance(making, 6))
		add(expression, "!");
	if (making_chance(making, 4))
		add(expression, "%.*s", 1 + making_below(making, 4), "----");
	if (making_chance(making, 55))
		add_variable(making, expression);
	else if (making_chance(making, 80))
		add_constant(making, expression);
	else
		add_function(making, expression);
}

static void add_sum(struct making *making, struct expression *expression)
{
	static const char operators[] = "++-**/%&|^"; /* ^ is a power in LinuxCNC */
	int more = making_below(making, 4);
	bool open = false;

	while (more-- > 0) {
		bool begin = !open && making_chance(making, 15);

		if (begin)
			add(expression, "(");
		add_term(making, expression);
		if (open)
			add(expression, ")");
		open = begin;
		add(expression, "%c", operators[making_below(making, making->linuxcnc ? 9 : 10)]);
	}
	add_term(making, expression);
	if (open)
		add(expression, ")");
}

static void put_compare(struct making *making, int number)
{
	static const char *const usual[] = { "=", "<>", "<", ">", "<=", ">=" };
	static const char *const unusual[] = { "==", "!=", "=>" };
	struct expression expression;

	do {
		expression = (struct expression){ .len = 0 };
		add_sum(making, &expression);
		add(&expression, "%s", making_chance(making, 92) ? usual[making_below(making, 6)] :
					unusual[making_below(making, 3)]);
		add_sum(making, &expression);
	} while (expression.len > LONGEST);
	making_put(making, "%04d,%s\n", number, expression.text);
}

static void put_operate(struct making *making, int number)
{
	static const int targets[] = { 230, 240, 250, 251, 260, 280, 300 };
	struct expression expression;

	do {
		expression = (struct expression){ .len = 0 };
		if (making_chance(making, 10))
			add(&expression, "@200/%d@:=@200/%d@&7", FIRST_INDEX +
			    making_below(making, INDICES), making_below(making, WORDS));
		else if (making_chance(making, 70))
			add(&expression, "@200/%d@", making_below(making, WORDS));
		else if (making_chance(making, 30))
			add(&expression, "@200/%d[200/%d]@", making_below(making, 4),
			    FIRST_INDEX + making_below(making, INDICES));
		else
			add(&expression, "@%d/%d@", targets[making_below(making, making->linuxcnc ? 6 : 7)],
			    making_below(making, BLOCKS));
		if (expression.text[expression.len - 1] == '@') {
			/* Presets and counters get small numbers.                    */
			bool block = expression.text[1] == '2' && expression.text[2] > '2' &&
				     expression.text[2] < '7';

			add(&expression, "%s", making_chance(making, 85) ? ":=" : "=");
			if (block)
				add(&expression, "(");
			add_sum(making, &expression);
			if (block)
				add(&expression, ")&15");
		}
	} while (expression.len > LONGEST);
	making_put(making, "%04d,%s\n", number, expression.text);
}

void put_expressions(struct making *making)
{
	making->compares = making_below(making, 8);
	making->operates = making_below(making, 12);
	making_put(making, "_FILE-arithmetic_expressions.csv\n#VER=2.0\n");
	for (int i = 0; i < making->compares; i++)
		put_compare(making, i);
	for (int i = 0; i < making->operates; i++)
		put_operate(making, making->compares + i);
	making_put(making, "_/FILE-arithmetic_expressions.csv\n");
}
