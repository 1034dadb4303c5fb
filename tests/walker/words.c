/* SPDX-License-Identifier: MIT
 *
 * words - random contents of cells: contacts, coils, boxes, expressions.
 *
 * A pool of variables of every type, with initial values near the limits; those that a
 * program uses are declared in front of it.
 */
#include "tests/walker/words.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

struct pool_row {
	const char *name, *type, *rest; /* rest: AT … or := …                 */
	bool input;                     /* may not be written                 */
	bool direct;                    /* an address: not declared           */
};

static const struct pool_row pool[] = {
	{ "bool_a", "BOOL", "", 0, 0 }, { "bool_b", "BOOL", "", 0, 0 },
	{ "bool_c", "BOOL", ":= TRUE", 0, 0 }, { "bool_d", "BOOL", "", 0, 0 },
	{ "in_a", "BOOL", "AT %IX0.0", 1, 0 },
	{ "in_b", "BOOL", "AT %IX0.1", 1, 0 },
	{ "in_c", "BOOL", "AT %IX1.7", 1, 0 },
	{ "out_a", "BOOL", "AT %QX0.0", 0, 0 },
	{ "out_b", "BOOL", "AT %QX1.3", 0, 0 },
	{ "mark_a", "BOOL", "AT %MX0.1", 0, 0 },
	{ "mark_b", "BOOL", "AT %MX1.7", 0, 0 },
	{ "mark_c", "BOOL", "AT %MX20.0", 0, 0 },
	{ "%IX0.0", "BOOL", "", 1, 1 }, { "%IX0.5", "BOOL", "", 1, 1 },
	{ "%IX2.3", "BOOL", "", 1, 1 }, { "%QX0.0", "BOOL", "", 0, 1 },
	{ "%QX0.7", "BOOL", "", 0, 1 }, { "%MX0.1", "BOOL", "", 0, 1 },
	{ "%MX3.2", "BOOL", "", 0, 1 }, { "%MX20.1", "BOOL", "", 0, 1 },
	{ "SYS_FIRST_SCAN", "BOOL", "", 1, 1 },
	{ "SYS_ALWAYS_ON", "BOOL", "", 1, 1 },
	{ "SYS_MATH_ERROR", "BOOL", "", 1, 1 },
	{ "ton_a.Q", "BOOL", "", 1, 0 }, { "tof_a.Q", "BOOL", "", 1, 0 },
	{ "ctu_a.Q", "BOOL", "", 1, 0 }, { "sr_a.Q1", "BOOL", "", 1, 0 },
	{ "ctu_b.R", "BOOL", "", 0, 0 }, { "ft_b.Q", "BOOL", "", 1, 0 },
	{ "const_b", "BOOL", ":= TRUE", 1, 0 },
	{ "SYS_CLOCK_1S", "BOOL", "", 1, 1 },
	{ "sint_a", "SINT", ":= 126", 0, 0 }, { "sint_b", "SINT", ":= -128", 0, 0 },
	{ "int_a", "INT", ":= 32766", 0, 0 }, { "int_b", "INT", ":= 3", 0, 0 },
	{ "int_m", "INT", "AT %MW0", 0, 0 }, { "int_i", "INT", "AT %IW2", 1, 0 },
	{ "ctu_a.CV", "INT", "", 1, 0 }, { "ctud_a.CV", "INT", "", 1, 0 },
	{ "ctd_a.PV", "INT", "", 0, 0 }, { "const_i", "INT", ":= 5", 1, 0 },
	{ "dint_a", "DINT", ":= 2147483640", 0, 0 },
	{ "dint_b", "DINT", ":= -1", 0, 0 },
	{ "dint_m", "DINT", "AT %MD0", 0, 0 },
	{ "usint_a", "USINT", ":= 250", 0, 0 }, { "usint_b", "USINT", "", 0, 0 },
	{ "usint_m", "USINT", "AT %MB0", 0, 0 },
	{ "usint_i", "USINT", "AT %IB1", 1, 0 },
	{ "uint_a", "UINT", ":= 65533", 0, 0 }, { "uint_b", "UINT", ":= 2", 0, 0 },
	{ "udint_a", "UDINT", ":= 4294967290", 0, 0 },
	{ "udint_b", "UDINT", "", 0, 0 },
	{ "byte_a", "BYTE", ":= 16#A5", 0, 0 }, { "%MB1", "BYTE", "", 0, 1 },
	{ "%IB0", "BYTE", "", 1, 1 },
	{ "word_a", "WORD", "", 0, 0 }, { "word_m", "WORD", "AT %MW1", 0, 0 },
	{ "%QW0", "WORD", "", 0, 1 },
	{ "dword_a", "DWORD", "", 0, 0 }, { "%MD4", "DWORD", "", 0, 1 },
	{ "real_a", "REAL", ":= 1.5", 0, 0 },
	{ "real_b", "REAL", ":= 3.0E38", 0, 0 },
	{ "time_a", "TIME", ":= T#20ms", 0, 0 }, { "time_b", "TIME", "", 0, 0 },
	{ "ton_a.ET", "TIME", "", 1, 0 }, { "tof_b.PT", "TIME", "", 0, 0 },
	{ "lint_a", "LINT", ":= 9223372036854775800", 0, 0 },
	{ "lint_b", "LINT", ":= -3", 0, 0 },
	{ "ulint_a", "ULINT", ":= 18446744073709551610", 0, 0 },
	{ "ulint_b", "ULINT", ":= 7", 0, 0 },
	{ "lword_a", "LWORD", ":= 16#8000000000000001", 0, 0 },
	{ "lword_b", "LWORD", "", 0, 0 },
	{ "lreal_a", "LREAL", ":= 0.1", 0, 0 },
	{ "lreal_b", "LREAL", ":= 1.5E308", 0, 0 },
	{ "tod_a", "TIME_OF_DAY", ":= TOD#23:59:59.99", 0, 0 },
	{ "tod_b", "TIME_OF_DAY", "", 0, 0 },
	{ "date_a", "DATE", ":= D#2262-04-11", 0, 0 },
	{ "date_b", "DATE", ":= D#1677-09-22", 0, 0 },
	{ "dt_a", "DATE_AND_TIME", ":= DT#2262-04-11-23:47:16.85", 0, 0 },
	{ "dt_b", "DATE_AND_TIME", ":= DT#1969-12-31-23:59:59.999999999", 0, 0 },
	{ "time_c", "TIME", ":= T#106751d", 0, 0 },
	{ "str_a", "STRING[9]", ":= 'abcabc'", 0, 0 },
	{ "str_b", "STRING[9]", "", 0, 0 },
	{ "str_c", "STRING[4]", ":= 'bc'", 0, 0 },
	{ "arr_b[2]", "BOOL", "", 0, 1 }, { "arr_b[usint_b]", "BOOL", "", 0, 1 },
	{ "arr_b[int_b]", "BOOL", "", 0, 1 }, { "arr_b[ctu_a.CV]", "BOOL", "", 0, 1 },
	{ "arr_q[usint_i]", "BOOL", "", 0, 1 }, { "arr_q[-1]", "BOOL", "", 0, 1 },
	{ "arr_q[uint_b]", "BOOL", "", 0, 1 }, { "%IX0.0[usint_b]", "BOOL", "", 1, 1 },
	{ "%MX0.0[usint_i]", "BOOL", "", 0, 1 },
	{ "arr_i[4]", "INT", "", 0, 1 }, { "arr_i[int_b]", "INT", "", 0, 1 },
	{ "arr_i[uint_b]", "INT", "", 0, 1 }, { "arr_i[const_i]", "INT", "", 0, 1 },
	{ "arr_s[usint_i]", "SINT", "", 0, 1 }, { "arr_s[sint_b]", "SINT", "", 0, 1 },
	{ "arr_d[dint_b]", "DINT", "", 0, 1 }, { "arr_d[1]", "DINT", "", 0, 1 },
	{ "arr_c[usint_b]", "DINT", "", 1, 1 }, { "%MD0[usint_b]", "DWORD", "", 0, 1 },
	{ "%MB0[uint_b]", "BYTE", "", 0, 1 }, { "arr_t[int_b]", "TIME", "", 0, 1 },
	{ "arr_r[usint_b]", "REAL", "", 0, 1 }, { "arr_r[2]", "REAL", "", 0, 1 },
	{ "tp_b.ET", "TIME", "", 1, 0 }, { "tonr_a.ET", "TIME", "", 1, 0 },
	{ "pid_a.OUT", "REAL", "", 1, 0 }, { "ramp_a.OUT", "REAL", "", 1, 0 },
	{ "mean_a.OUT", "REAL", "", 1, 0 }, { "range_a.OUT", "REAL", "", 1, 0 },
	{ "pid_b.KP", "REAL", "", 0, 0 }, { "scale_a.GAIN", "REAL", "", 0, 0 },
	{ "real_c", "REAL", ":= 12.5", 0, 0 }, { "fifo_a.OUT", "DINT", "", 1, 0 },
	{ "rec_a.on", "BOOL", "", 0, 0 }, { "rec_a.n", "INT", "", 0, 0 },
	{ "rec_a.low.d", "DINT", "", 0, 0 }, { "rec_a.low.q", "BOOL", "", 0, 0 },
	{ "rec_a.t", "TIME", "", 0, 0 }, { "rec_a.list[4]", "INT", "", 0, 0 },
	{ "rec_a.list[int_b]", "INT", "", 0, 0 }, { "rec_a.name", "STRING[9]", "", 0, 0 },
	{ "recs[2].on", "BOOL", "", 0, 0 }, { "recs[usint_b].on", "BOOL", "", 0, 0 },
	{ "recs[int_b].n", "INT", "", 0, 0 }, { "recs[1].list[3]", "INT", "", 0, 0 },
	{ "recs[usint_i].low.d", "DINT", "", 0, 0 },
	{ "recs[uint_b].low.q", "BOOL", "", 0, 0 },
	{ "inner_a.out_a", "BOOL", "", 1, 0 }, { "inner_b.int_b", "INT", "", 1, 0 },
	{ "inner_a.in_b", "BOOL", "", 0, 0 }, { "outer_a.out_b", "BOOL", "", 1, 0 },
	{ "outer_a.lint_a", "LINT", "", 1, 0 },
	{ "shift_a.Q", "BOOL", "", 1, 0 }, { "fifo_a.FULL", "BOOL", "", 1, 0 },
};

/* Arrays, declared when one of their elements is named. */
static const struct {
	const char *name, *rest;
	bool constant;
} array[] = {
	{ "arr_b", ": ARRAY[0..4] OF BOOL := [TRUE, 0, TRUE]", 0 },
	{ "arr_q", "AT %QX0.3 : ARRAY[-2..9] OF BOOL", 0 },
	{ "arr_i", ": ARRAY[1..6] OF INT := [7, 2(32767), -1]", 0 },
	{ "arr_s", ": ARRAY[-128..100] OF SINT := [200(5)]", 0 },
	{ "arr_d", "AT %MD2 : ARRAY[-1..2] OF DINT := [-7, 2147483647]", 0 },
	{ "arr_c", ": ARRAY[0..2] OF DINT := [1, 65536, -2147483648]", 1 },
	{ "arr_t", ": ARRAY[2..4] OF TIME := [T#10ms, T#30ms]", 0 },
	{ "arr_r", ": ARRAY[0..2] OF REAL := [1.5, 3.0E38, -0.5]", 0 },
};
#define ARRAYS (sizeof(array) / sizeof(*array))

/* Elements whose index is an expression: only in expressions. */
static const char *const computed[][2] = {
	{ "INT", "arr_i[int_b - 1]" }, { "INT", "arr_i[(usint_i MOD 7)]" },
	{ "INT", "arr_i[arr_s[usint_i] + 1]" }, { "DINT", "arr_d[usint_b / usint_i]" },
	{ "BOOL", "arr_b[usint_i MOD 5]" }, { "BOOL", "arr_q[sint_a + int_b]" },
	{ "BOOL", "%MX0.0[uint_b * 2]" }, { "SINT", "arr_s[-int_b]" },
	{ "REAL", "arr_r[arr_i[usint_b]]" }, { "TIME", "arr_t[uint_b + 1]" },
};

#define POOL (sizeof(pool) / sizeof(*pool))

/* Other types that an operation of type `type` accepts: they are widened. */
static const char *const narrower[][2] = {
	{ "INT", "SINT" }, { "INT", "USINT" }, { "DINT", "INT" },
	{ "DINT", "UINT" }, { "DINT", "SINT" }, { "UINT", "USINT" },
	{ "UDINT", "UINT" }, { "REAL", "INT" }, { "REAL", "SINT" },
	{ "LINT", "DINT" }, { "LINT", "UDINT" }, { "LINT", "USINT" },
	{ "ULINT", "UDINT" }, { "LREAL", "REAL" }, { "LREAL", "UDINT" },
	{ "LREAL", "INT" },
	{ "WORD", "BYTE" }, { "DWORD", "WORD" }, { "DWORD", "BYTE" },
	{ "LWORD", "DWORD" },
};

#define PLAIN_NARROWER 16 /* numbers first, then bits                         */

static const char *const numbers[] = {
	"SINT", "INT", "INT", "DINT", "DINT", "USINT", "UINT", "UDINT", "INT",
	"REAL", "TIME", "LINT", "ULINT", "LREAL", "LREAL", "TIME_OF_DAY", "DATE",
	"DATE_AND_TIME",
};

static const char *any_number(struct random_source *source)
{
	return numbers[random_below(source, sizeof(numbers) / sizeof(*numbers))];
}

/* A variable of exactly this type; the pool has at least one of each. */
const char *variable(struct random_source *source, const char *type,
			    bool write)
{
	for (;;) {
		const struct pool_row *row =
			&pool[random_below(source, (uint32_t)POOL)];

		if (strcmp(row->type, type) == 0 && !(write && row->input))
			return row->name;
	}
}

/* Bits, bytes and words of numbers; not in expressions, which the walker knows without them. */
static const struct { const char *name, *type; bool input; } part[] = {
	{ "word_a.15", "BOOL", 0 }, { "word_a.%X0", "BOOL", 0 }, { "int_b.0", "BOOL", 0 },
	{ "byte_a.7", "BOOL", 0 }, { "dword_a.31", "BOOL", 0 }, { "lword_b.63", "BOOL", 0 },
	{ "sint_a.7", "BOOL", 0 }, { "word_m.3", "BOOL", 0 }, { "int_i.4", "BOOL", 1 },
	{ "%MW0.%X9", "BOOL", 0 }, { "%MB1.%X3", "BOOL", 0 }, { "arr_i[4].15", "BOOL", 0 },
	{ "arr_i[int_b].3", "BOOL", 0 }, { "recs[usint_b].n.%X2", "BOOL", 0 },
	{ "rec_a.low.d.31", "BOOL", 0 }, { "ctu_a.CV.0", "BOOL", 1 },
	{ "ctd_a.PV.2", "BOOL", 0 }, { "arr_d[dint_b].5", "BOOL", 0 },
	{ "usint_m.2", "BOOL", 0 }, { "ulint_b.1", "BOOL", 0 }, { "inner_b.int_b.2", "BOOL", 1 },
	{ "%MD0[usint_b].4", "BOOL", 0 }, { "arr_c[usint_b].1", "BOOL", 1 },
	{ "word_a.%B1", "BYTE", 0 }, { "int_b.%B0", "BYTE", 0 }, { "%MD4.%B3", "BYTE", 0 },
	{ "arr_d[dint_b].%B2", "BYTE", 0 }, { "lword_b.%B7", "BYTE", 0 },
	{ "recs[int_b].n.%B1", "BYTE", 0 }, { "dword_a.%W1", "WORD", 0 },
	{ "lint_b.%W3", "WORD", 0 }, { "dint_m.%W0", "WORD", 0 }, { "lword_a.%D1", "DWORD", 0 },
};

/* A variable, or a part of one. */
const char *operand(struct random_source *source, const char *type, bool write)
{
	const size_t i = random_below(source, (uint32_t)(sizeof(part) / sizeof(*part)));

	if (random_chance(source, 25) && strcmp(part[i].type, type) == 0 && !(write && part[i].input))
		return part[i].name;
	return variable(source, type, write);
}

/* The same inside an expression. */
const char *term(struct random_source *source, const char *type, bool write)
{
	size_t count = sizeof(computed) / sizeof(*computed);
	size_t i = random_below(source, (uint32_t)count);

	if (random_chance(source, 15) && strcmp(computed[i][0], type) == 0)
		return computed[i][1];
	return variable(source, type, write);
}

/* An operand that may be beside a value of @type in one operation. */
static const char *beside(struct random_source *source, const char *type)
{
	size_t count = sizeof(narrower) / sizeof(*narrower);
	size_t i = random_below(source, (uint32_t)count);

	if (random_chance(source, 40))
		return literal(source, type);
	if (random_chance(source, 40) && strcmp(narrower[i][0], type) == 0)
		return variable(source, narrower[i][1], false);
	return variable(source, type, false);
}

/* A divisor: a constant 0 would be refused, a variable may be 0. */
static const char *divisor(struct random_source *source, const char *type)
{
	const char *text;

	do
		text = beside(source, type);
	while (strcmp(text, "0") == 0 || strcmp(text, "0.0") == 0);
	return text;
}

void words_put(struct builder *builder, const char *format, ...)
{
	size_t left = builder->size - builder->used;
	va_list args;
	int n;

	va_start(args, format);
	n = vsnprintf(builder->out + builder->used, left, format, args);
	va_end(args);
	builder->used += n < 0 ? 0 : (size_t)n < left ? (size_t)n : left - 1;
}

static bool near_full(const struct builder *builder)
{
	return builder->used > RANDOM_TEXT * 2 / 5;
}

static bool is_dated(const char *type)
{
	return strcmp(type, "TIME_OF_DAY") == 0 || strcmp(type, "DATE") == 0 ||
	       strcmp(type, "DATE_AND_TIME") == 0;
}

void number(struct builder *builder, const char *type, int depth, bool tight)
{
	struct random_source *source = builder->source;
	const char *ops = strcmp(type, "TIME") == 0 ? "+-" :
			  strstr(type, "REAL") ? "+-*/" : "+-*/M";
	char op = ops[random_below(source, (uint32_t)strlen(ops))];
	bool swap = random_chance(source, 20);

	if (depth == 0 || near_full(builder)) {
		words_put(builder, "%s", term(source, type, false));
		return;
	}
	if (tight)
		words_put(builder, "(");
	if (is_dated(type) || (strcmp(type, "TIME") == 0 && random_chance(source, 30))) {
		if (is_dated(type))
			random_moment(builder, type, depth - 1);
		else
			random_timely(builder, depth - 1);
		words_put(builder, tight ? ")" : "");
		return;
	}
	if (swap)
		words_put(builder, "%s", beside(source, type));
	else
		number(builder, type, depth - 1, true);
	words_put(builder, op == 'M' ? " MOD " : " %c ", op);
	if (swap || random_chance(source, 30))
		number(builder, type, depth - 1, true);
	else
		words_put(builder, "%s", op == '/' || op == 'M' ? divisor(source, type) :
								   beside(source, type));
	if (tight)
		words_put(builder, ")");
}

/* Bits of exactly @type. */
static void bits(struct builder *builder, const char *type, int depth)
{
	static const char *const op[] = { "AND", "OR", "XOR" };
	struct random_source *source = builder->source;

	if (depth == 0 || near_full(builder)) {
		words_put(builder, "%s", variable(source, type, false));
	} else if (random_chance(source, 25)) {
		words_put(builder, "(NOT ");
		bits(builder, type, depth - 1);
		words_put(builder, ")");
	} else {
		words_put(builder, "(");
		bits(builder, type, depth - 1);
		words_put(builder, " %s ", op[random_below(source, 3)]);
		if (random_chance(source, 50))
			bits(builder, type, depth - 1);
		else
			words_put(builder, "%s", beside(source, type));
		words_put(builder, ")");
	}
}

static void relation(struct builder *builder, int depth)
{
	static const char *const rel[] = { "<", ">", "<=", ">=", "=", "<>" };
	static const char *const sort[] = { "BYTE", "WORD", "DWORD", "BOOL", "LWORD" };
	struct random_source *source = builder->source;
	bool plain = random_chance(source, 20);
	const char *type = plain ? sort[random_below(source, 5)] :
				   any_number(source);

	if (plain && strcmp(type, "BOOL") != 0)
		bits(builder, type, depth);
	else
		number(builder, type, plain ? 0 : depth, false);
	words_put(builder, " %s ", rel[random_below(source, 6)]);
	words_put(builder, "%s", beside(source, type));
}

static void truth(struct builder *builder, int depth)
{
	static const char *const op[] = { "AND", "OR", "XOR", "&" };
	struct random_source *source = builder->source;

	if (depth == 0 || near_full(builder)) {
		words_put(builder, "%s", term(source, "BOOL", false));
	} else if (random_chance(source, 45)) {
		words_put(builder, "(");
		relation(builder, depth - 1);
		words_put(builder, ")");
	} else if (random_chance(source, 25)) {
		words_put(builder, "NOT (");
		truth(builder, depth - 1);
		words_put(builder, ")");
	} else {
		words_put(builder, "(");
		truth(builder, depth - 1);
		words_put(builder, " %s ", op[random_below(source, 4)]);
		truth(builder, depth - 1);
		words_put(builder, ")");
	}
}

void random_series(struct random_source *source, char *out, size_t size)
{
	static const char *const contact[] = { "NO", "NO", "NC", "P", "N" };
	struct builder builder = { source, out, size, 0 };

	if (random_chance(source, 12)) {
		words_put(&builder, "NOT");
	} else if (random_chance(source, 25)) {
		words_put(&builder, "[ ");
		if (random_chance(source, 60))
			relation(&builder, 2);
		else
			truth(&builder, 3);
		words_put(&builder, " ]");
	} else {
		words_put(&builder, "%s %s", contact[random_below(source, 5)],
		    operand(source, "BOOL", false));
	}
}

static void assignment(struct builder *builder)
{
	struct random_source *source = builder->source;
	const char *type = any_number(source);
	size_t count = sizeof(narrower) / sizeof(*narrower);
	size_t i = random_below(source, (uint32_t)count);

	if (random_chance(source, 20)) {
		words_put(builder, "[ %s := ", term(source, "BOOL", true));
		truth(builder, 2);
	} else if (random_chance(source, 20)) {
		i = PLAIN_NARROWER + random_below(source, 3);
		words_put(builder, "[ %s := ", variable(source, narrower[i][0], true));
		bits(builder, narrower[i][random_below(source, 2)], 2);
	} else if (random_chance(source, 15)) {
		words_put(builder, "[ %s := ",
		    variable(source, narrower[i][0], true));
		words_put(builder, "%s", variable(source, narrower[i][1], false));
	} else if (random_chance(source, 15) && i < PLAIN_NARROWER) {
		words_put(builder, "[ %s := ",
		    variable(source, narrower[i][0], true));
		number(builder, narrower[i][1], 2, false);
	} else if (random_chance(source, 10)) {
		words_put(builder, "[ %s := %s", term(source, type, true),
		    literal(source, type));
	} else {
		words_put(builder, "[ %s := ", term(source, type, true));
		number(builder, type, 2, false);
	}
	words_put(builder, " ]");
}

void random_last(struct random_source *source, int later, char *out, size_t size)
{
	static const char *const coil[] = {
		"COIL", "COIL", "COIL", "COILNOT", "S", "R", "COILP", "COILN",
	};
	struct builder builder = { source, out, size, 0 };

	if (later && random_chance(source, 15))
		words_put(&builder, "JMP L%d", later);
	else if (random_chance(source, 3))
		words_put(&builder, "RET");
	else if (random_chance(source, 20))
		assignment(&builder);
	else
		words_put(&builder, "%s %s", coil[random_below(source, 8)],
		    operand(source, "BOOL", true));
}

/* AND OR XOR NOT as boxes: the last input of BOOLs may be inverted. */
static void logic(struct builder *builder)
{
	static const char *const word[] = { "AND", "OR", "XOR", "NOT" };
	static const char *const type[] = { "BOOL", "BOOL", "BYTE", "WORD", "DWORD" };
	struct random_source *source = builder->source;
	const char *fn = word[random_below(source, 4)];
	const char *of = type[random_below(source, 5)];
	bool is_bool = strcmp(of, "BOOL") == 0;
	int count = 2 + (int)random_below(source, 3);

	if (*fn == 'N') {
		words_put(builder, "NOT IN:=%s%s", is_bool && random_chance(source, 30) ? "/" :
		    "", operand(source, of, false));
	} else {
		words_put(builder, "%s IN1:=%s", fn, operand(source, of, false));
		for (int i = 2; i <= count; i++)
			if (is_bool && random_chance(source, 40))
				words_put(builder, " IN%d:=/%s", i, operand(source, of, false));
			else
				words_put(builder, " IN%d:=%s", i, beside(source, of));
	}
	if (!is_bool || random_chance(source, 50))
		words_put(builder, " OUT=>%s", operand(source, of, true));
}

/* MIN and MAX. */
static void choice(struct builder *builder)
{
	struct random_source *source = builder->source;
	const char *type = any_number(source);
	int count = 2 + (int)random_below(source, 3);

	words_put(builder, "%s IN1:=%s", random_chance(source, 50) ? "MIN" : "MAX",
	    variable(source, type, false));
	for (int i = 2; i <= count; i++)
		words_put(builder, " IN%d:=%s", i, beside(source, type));
	words_put(builder, " OUT=>%s", operand(source, type, true));
}

static void function(struct builder *builder)
{
	static const char *const word[] = {
		"ADD", "ADD", "SUB", "MUL", "DIV", "MOD", "MOVE", "GT", "LE",
		"EQ", "NE",
	};
	struct random_source *source = builder->source;
	const char *fn = word[random_below(source, 11)];
	const char *type = any_number(source);
	bool many = strcmp(fn, "ADD") == 0 || strcmp(fn, "MUL") == 0;
	bool compare = strchr("GLEN", *fn);
	int count = many ? 2 + (int)random_below(source, 3) : 2;
	uint32_t wide = random_below(source, PLAIN_NARROWER);

	if (strcmp(type, "TIME") == 0 && strchr("MD", *fn))
		type = "INT";
	if (strstr(type, "REAL") && strcmp(fn, "MOD") == 0)
		type = "DINT";
	if (is_dated(type) && !compare && strcmp(fn, "MOVE") != 0)
		type = "LINT"; /* dates can be added in expressions */
	if (strcmp(fn, "MOVE") == 0 && random_chance(source, 30))
		type = random_chance(source, 40) ? "WORD" :
		       random_chance(source, 50) ? "LWORD" : "BOOL";
	if (strcmp(fn, "MOVE") == 0) {
		words_put(builder, "MOVE IN:=%s", operand(source, type, false));
	} else {
		words_put(builder, "%s IN1:=%s", fn, variable(source, type, false));
		for (int i = 2; i <= count; i++)
			words_put(builder, " IN%d:=%s", i, *fn == 'D' || strcmp(fn, "MOD") == 0 ?
				  divisor(source, type) : beside(source, type));
	}
	if (!compare && random_chance(source, 15) &&
	    strcmp(type, narrower[wide][1]) == 0)
		type = narrower[wide][0];
	if (!compare)
		words_put(builder, " OUT=>%s", operand(source, type, true));
	else if (random_chance(source, 30))
		words_put(builder, " OUT=>%s", operand(source, "BOOL", true));
}

int random_box(struct random_source *source, char *out, size_t size,
	       const char *pin[3])
{
	struct builder builder = { source, out, size, 0 };

	if (random_chance(source, 15)) {
		assignment(&builder);
		return 0;
	}
	if (random_chance(source, 5)) {
		words_put(&builder, "EQ OUT=>%s", operand(source, "BOOL", true));
		pin[0] = "IN1";
		pin[1] = "IN2";
		return 2;
	}
	if (random_chance(source, 15)) {
		logic(&builder);
		return 0;
	}
	if (random_chance(source, 5)) {
		choice(&builder);
		return 0;
	}
	if (random_chance(source, 8)) {
		random_text(&builder);
		return 0;
	}
	if (random_chance(source, 45)) {
		function(&builder);
		return 0;
	}
	return random_block(&builder, pin);
}

/* Whether @name is in @body as a word of its own. */
bool is_used(const char *body, const char *name)
{
	size_t len = strcspn(name, ".");

	for (const char *at = body; (at = strstr(at, name)) != NULL; at += len)
		if (at > body && strchr(" (=>[-/", at[-1]) &&
		    strchr(" .)[]", at[len]))
			return true;
	return false;
}

static bool is_constant(const struct pool_row *row)
{
	return strncmp(row->name, "const_", 6) == 0;
}

size_t random_declare(const char *body, char *out, size_t size)
{
	struct builder builder = { NULL, out, size, 0 };

	words_put(&builder, "VAR\n");
	if (is_used(body, "loop_a"))
		words_put(&builder, "  loop_a : INT;\n");
	for (size_t i = 0; i < POOL; i++) {
		const struct pool_row *row = &pool[i];
		bool at = *row->rest == 'A';

		if (row->direct || strchr(row->name, '.') ||
		    is_constant(row) ||
		    !is_used(body, row->name))
			continue;
		words_put(&builder, "  %s %s : %s %s;\n", row->name,
		    at ? row->rest : "", row->type, at ? "" : row->rest);
	}
	random_declare_blocks(&builder, body);
	random_declare_own(&builder, body);
	for (size_t i = 0; i < ARRAYS; i++)
		if (!array[i].constant && is_used(body, array[i].name))
			words_put(&builder, "  %s %s;\n", array[i].name, array[i].rest);
	words_put(&builder, "END_VAR\n");
	for (size_t i = 0; i < ARRAYS; i++)
		if (array[i].constant && is_used(body, array[i].name))
			words_put(&builder, "VAR CONSTANT\n  %s %s;\nEND_VAR\n",
			    array[i].name, array[i].rest);
	for (size_t i = 0; i < POOL; i++)
		if (is_constant(&pool[i]) && is_used(body, pool[i].name))
			words_put(&builder, "VAR CONSTANT\n  %s : %s %s;\nEND_VAR\n",
			    pool[i].name, pool[i].type, pool[i].rest);
	return builder.used;
}
