/* SPDX-License-Identifier: MIT
 *
 * classic_expression - the arithmetic of ClassicLadder, "@200/0@:=@200/1@*2", as
 * expressions of a rung file.
 *
 * Whole numbers of 32 bits; precedence from high to low: ! | * / % | + - | & | ^ | or.
 * Operators that IEC 61131-3 defines otherwise (division by zero, bits of numbers, overflow)
 * become functions in the rung file. Depth is bounded; text that is no expression is
 * reported and left out.
 */
#include "engine/base/ascii.h"
#include "engine/base/limits.h"
#include "engine/exchange/classic/classic_convert.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* A part of an expression: its text and its precedence. */
struct part {
	const char *text;
	const char *a, *b; /* if it can overflow: operands of this function    */
	enum classic_function function;
	int rank;          /* 0: an operand or call; greater: weaker           */
	bool constant;
	int32_t value;     /* of a constant                                    */
	bool known;        /* its value lies between low and high              */
	int32_t low, high;
};

enum { RANK_OPERAND, RANK_SIGN, RANK_PRODUCT, RANK_SUM };

enum { DEPTH = 40, ARGUMENTS = 10 };

struct parse {
	struct conversion *c;
	const char *at;
	const char *whole;
	int depth;
	bool failed;
};

static struct part fail(struct parse *p)
{
	p->failed = true;
	return (struct part){ .text = "0", .constant = true };
}

static struct part constant(struct parse *p, int64_t value)
{
	/* Larger ones wrap in ClassicLadder. */
	int32_t number = (int32_t)(uint32_t)(uint64_t)value;

	return (struct part){ .text = text_of(p->c, "%d", number), .constant = true,
			      .value = number, .known = true, .low = number,
			      .high = number, .rank = number < 0 ? RANK_SIGN :
								   RANK_OPERAND };
}

/* ---- operators ---- */

static const char *const function_name[CLASSIC_FUNCTIONS] = {
	[CLASSIC_DIVIDE] = "Quotient", [CLASSIC_REMAINDER] = "Remainder",
	[CLASSIC_SUM] = "Sum", [CLASSIC_DIFFERENCE] = "Difference",
	[CLASSIC_PRODUCT] = "Product", [CLASSIC_POWER] = "Power", [CLASSIC_AND] = "BitAnd", [CLASSIC_XOR] = "BitXor",
	[CLASSIC_OR] = "BitOr", [CLASSIC_SHIFT_LEFT] = "ShiftLeft",
	[CLASSIC_SHIFT_RIGHT] = "ShiftRight", [CLASSIC_ROTATE_LEFT] = "RotateLeft",
	[CLASSIC_ROTATE_RIGHT] = "RotateRight",
};

static const char *function_call(struct parse *p, enum classic_function function,
				 const char *a, const char *b)
{
	if (!p->c->function_name[function])
		p->c->function_name[function] = name_new(p->c, function_name[function]);
	return text_of(p->c, "%s(%s, %s)", p->c->function_name[function], a, b);
}

/* The part as an operand. One that can overflow wraps in ClassicLadder, while here overflow
 * would end the expression: it becomes a call of a function. */
static const char *inside(struct parse *p, struct part part, int rank)
{
	if (part.a)
		return function_call(p, part.function, part.a, part.b);
	return part.rank > rank ? text_of(p->c, "(%s)", part.text) : part.text;
}

static bool accept(struct parse *p, const char *word)
{
	size_t len = strlen(word);

	if (strncmp(p->at, word, len))
		return false;
	p->at += len;
	return true;
}

/* ---- variables ---- */

/* "200/12" at @text; returns what follows, NULL: it is none. */
static const char *read_pair(const char *text, int *type, int *number)
{
	char *end;
	long value;

	if (!ascii_digit(*text))
		return NULL;
	value = strtol(text, &end, 10);
	if (*end != '/' || value > CLASSIC_LIMIT || !ascii_digit(end[1]))
		return NULL;
	*type = (int)value;
	value = strtol(end + 1, &end, 10);
	if (value > CLASSIC_LIMIT)
		return NULL;
	*number = (int)value;
	return end;
}

/* "@200/12[200/4]@" at @text; returns what follows, NULL: it is none. */
static const char *read_variable(const char *text, struct classic_variable *variable)
{
	variable->index_type = -1;
	variable->index_number = 0;
	if (*text != '@')
		return NULL;
	text = read_pair(text + 1, &variable->type, &variable->number);
	if (text && *text == '[') {
		text = read_pair(text + 1, &variable->index_type,
				 &variable->index_number);
		text = text && *text == ']' ? text + 1 : NULL;
	}
	return text && *text == '@' ? text + 1 : NULL;
}

void expression_uses(const char *text,
		     void (*take)(void *context, struct classic_variable variable),
		     void *context)
{
	struct classic_variable variable;

	while ((text = strchr(text, '@'))) {
		const char *end = read_variable(text, &variable);

		if (end)
			take(context, variable);
		text = end ? end : text + 1;
	}
}

static struct part parse_variable(struct parse *p)
{
	struct classic_variable variable;
	const char *end = read_variable(p->at, &variable), *text;
	bool is_bool;

	if (!end)
		return fail(p);
	p->at = end;
	text = operand_of(p->c, variable, &is_bool);
	if (!text)
		return fail(p);
	return !is_bool ? (struct part){ .text = text } :
	       (struct part){ .text = text_of(p->c, "BOOL_TO_DINT(%s)", text),
			      .known = true, .high = 1 };
}

/* ---- constants ---- */

static struct part parse_hex(struct parse *p)
{
	uint64_t value = 0;
	const char *from = ++p->at;

	for (;; p->at++) {
		char upper = ascii_upper(*p->at);
		int digit = ascii_digit(upper) ? upper - '0' :
			    upper >= 'A' && upper <= 'F' ? upper - 'A' + 10 : -1;

		if (digit < 0)
			break;
		value = (value << 4 | (uint64_t)digit) & UINT32_MAX;
	}
	return p->at == from ? fail(p) : constant(p, (int64_t)value);
}

/* 'AB': its bytes as a number, the first one highest. */
static struct part parse_character(struct parse *p)
{
	uint64_t value = 0;

	for (p->at++; *p->at && *p->at != '\''; p->at++)
		value = (value << 8 | (unsigned char)*p->at) & UINT32_MAX;
	if (!accept(p, "'"))
		return fail(p);
	return constant(p, (int64_t)value);
}

static struct part parse_decimal(struct parse *p)
{
	int64_t value = 0;

	if (!ascii_digit(*p->at))
		return fail(p);
	for (; ascii_digit(*p->at); p->at++)
		value = (value * 10 + (*p->at - '0')) & UINT32_MAX;
	return constant(p, value);
}

/* ---- functions ---- */

struct known { const char *name; const char *here; int function; };

static const struct known known_functions[] = {
	{ "ABS", "ABS", -1 }, { "MINI", "MIN", -1 }, { "MAXI", "MAX", -1 },
	{ "AVG", "", -1 }, { "MOY", "", -1 },
	{ "POW", NULL, CLASSIC_POWER }, { "SHL", NULL, CLASSIC_SHIFT_LEFT },
	{ "SHR", NULL, CLASSIC_SHIFT_RIGHT }, { "ROL", NULL, CLASSIC_ROTATE_LEFT },
	{ "ROR", NULL, CLASSIC_ROTATE_RIGHT },
};
enum { KNOWN = sizeof(known_functions) / sizeof(*known_functions) };

/* The least value it can have. */
static int32_t part_low(struct part part)
{
	return part.known ? part.low : INT32_MIN;
}

/* The greatest value it can have. */
static int32_t part_high(struct part part)
{
	return part.known ? part.high : INT32_MAX;
}

/* Sets the range of values. A range beyond 32 bits wraps: any value. */
static void part_keep(struct part *part, int64_t low, int64_t high)
{
	part->known = low >= INT32_MIN && high <= INT32_MAX;
	part->low = part->known ? (int32_t)low : 0;
	part->high = part->known ? (int32_t)high : 0;
}

static struct part add(struct parse *p, struct part a, struct part b, char op)
{
	const bool plus = op == '+';
	const char *left = inside(p, a, RANK_SUM);
	const char *right = inside(p, b, b.rank == RANK_SIGN ? RANK_OPERAND : RANK_PRODUCT);
	struct part part = { .text = text_of(p->c, "%s %c %s", left, op, right),
			     .rank = RANK_SUM };

	part_keep(&part, (int64_t)part_low(a) + (plus ? part_low(b) : -(int64_t)part_high(b)),
		   (int64_t)part_high(a) + (plus ? part_high(b) : -(int64_t)part_low(b)));
	if (!part.known) {
		part.a = left;
		part.b = right;
		part.function = plus ? CLASSIC_SUM : CLASSIC_DIFFERENCE;
	}
	return part;
}

/* "(a + b + c) / 3" */
static const char *average(struct parse *p, const struct part *part, int count)
{
	struct part sum = part[0];

	for (int i = 1; i < count; i++)
		sum = add(p, sum, part[i], '+');
	return text_of(p->c, "%s / %d", inside(p, sum, RANK_PRODUCT), count);
}

static struct part call(struct parse *p, const struct known *known,
			const struct part *part, int count)
{
	const char *list = inside(p, part[0], RANK_SUM);

	if (known->function >= 0 && count == 2)
		return (struct part){ .text = function_call(
			p, (enum classic_function)known->function,
			inside(p, part[0], RANK_SUM), inside(p, part[1], RANK_SUM)) };
	if (known->function >= 0)
		return fail(p);
	if (!*known->here)
		return (struct part){ .text = average(p, part, count),
				      .rank = RANK_PRODUCT };
	if (!strcmp(known->here, "ABS") ? count != 1 : count < 2)
		return count == 1 ? part[0] : fail(p);
	for (int i = 1; i < count; i++)
		list = text_of(p->c, "%s, %s", list, inside(p, part[i], RANK_SUM));
	return (struct part){ .text = text_of(p->c, "%s(%s)", known->here, list) };
}

/* ClassicLadder takes a minus as a sign only in front of these. */
static bool is_literal(char first)
{
	return ascii_digit(first) || first == '$' || first == '\'';
}

/* -INT32_MIN wraps to itself. */
static struct part negate(struct parse *p, struct part part)
{
	const char *text = inside(p, part, RANK_OPERAND);
	struct part out = { .text = text_of(p->c, "-%s", text), .rank = RANK_SIGN };

	part_keep(&out, -(int64_t)part_high(part), -(int64_t)part_low(part));
	if (!out.known) {
		out.a = "0";
		out.b = text;
		out.function = CLASSIC_DIFFERENCE;
	}
	return out;
}

static struct part parse_term(struct parse *p);

/* A term behind a minus; in ClassicLadder that is 0. Pairs of signs cancel, which keeps the
 * recursion flat. */
static struct part negative(struct parse *p)
{
	bool odd = true;
	struct part part;

	while (p->at[0] == '-' && !is_literal(p->at[1])) {
		p->at++;
		odd = !odd;
	}
	part = parse_term(p);
	if (p->c->options.faithful)
		return constant(p, 0);
	if (part.constant)
		return constant(p, odd ? -(int64_t)part.value : part.value);
	if (!odd)
		return part;
	return negate(p, part);
}

static struct part parse_function(struct parse *p);

static struct part parse_or(struct parse *p);

static struct part parse_term(struct parse *p)
{
	struct part part;

	if (p->failed || ++p->depth > DEPTH)
		return fail(p);
	if (accept(p, "!")) {
		part = parse_term(p);
		part = (struct part){ .text = text_of(p->c, "BOOL_TO_DINT(%s = 0)",
						      inside(p, part, RANK_SUM)),
				      .known = true, .high = 1 };
	} else if (accept(p, "(")) {
		part = parse_or(p);
		if (!accept(p, ")"))
			part = fail(p);
	} else if (*p->at == '@') {
		part = parse_variable(p);
	} else if (*p->at == '$') {
		part = parse_hex(p);
	} else if (*p->at == '\'') {
		part = parse_character(p);
	} else if (*p->at == '-' && is_literal(p->at[1])) {
		p->at++;
		part = parse_term(p);
		part = constant(p, -(int64_t)part.value);
	} else if (accept(p, "-")) {
		part = negative(p);
	} else if (*p->at >= 'A' && *p->at <= 'Z') {
		part = parse_function(p);
	} else {
		part = parse_decimal(p);
	}
	p->depth--;
	return part;
}

/* A constant that is not 0 and not -1 needs no function. */
static struct part divide(struct parse *p, struct part a, struct part b, bool rest)
{
	if (b.constant && b.value != 0 && b.value != -1) {
		const int64_t by = b.value < 0 ? -(int64_t)b.value : b.value;
		const int64_t most = rest ? by - 1 : -(int64_t)INT32_MIN / by;
		struct part part = { .text = text_of(p->c, "%s %s %s",
			inside(p, a, RANK_PRODUCT), rest ? "MOD" : "/",
			inside(p, b, RANK_OPERAND)), .rank = RANK_PRODUCT };

		part_keep(&part, -most, most);
		return part;
	}
	return (struct part){ .text = function_call(
		p, rest ? CLASSIC_REMAINDER : CLASSIC_DIVIDE, inside(p, a, RANK_SUM),
		inside(p, b, RANK_SUM)) };
}

/* Range of the product of @a and @b. */
static void part_keep_product(struct part *part, struct part a, struct part b)
{
	const int64_t corner[] = {
		(int64_t)part_low(a) * part_low(b), (int64_t)part_low(a) * part_high(b),
		(int64_t)part_high(a) * part_low(b), (int64_t)part_high(a) * part_high(b),
	};
	int64_t low = corner[0], high = corner[0];

	for (int i = 1; i < 4; i++) {
		low = corner[i] < low ? corner[i] : low;
		high = corner[i] > high ? corner[i] : high;
	}
	part_keep(part, low, high);
}

static struct part multiply(struct parse *p, struct part a, struct part b)
{
	const char *left = inside(p, a, RANK_PRODUCT), *right = inside(p, b, RANK_OPERAND);
	struct part part = { .text = text_of(p->c, "%s * %s", left, right),
			     .rank = RANK_PRODUCT };
	int64_t product = (int64_t)a.value * b.value;

	if (a.constant && b.constant && product != (int32_t)product)
		return constant(p, product);
	part_keep_product(&part, a, b);
	if (!part.known) {
		part.a = left;
		part.b = right;
		part.function = CLASSIC_PRODUCT;
	}
	return part;
}

static struct part parse_product(struct parse *p)
{
	struct part part = parse_term(p), other;

	while (!p->failed && (*p->at == '*' || *p->at == '/' || *p->at == '%')) {
		char op = *p->at++;

		other = parse_term(p);
		part = op == '*' ? multiply(p, part, other) :
				   divide(p, part, other, op == '%');
	}
	return part;
}

static struct part parse_sum(struct parse *p)
{
	struct part part = parse_product(p), other;

	while (!p->failed && (*p->at == '+' || *p->at == '-')) {
		char op = *p->at++;

		other = parse_product(p);
		part = add(p, part, other, op);
	}
	return part;
}

static struct part parse_and(struct parse *p)
{
	struct part part = parse_sum(p), other;

	while (!p->failed && accept(p, "&")) {
		other = parse_sum(p);
		part = (struct part){ .text = function_call(p, CLASSIC_AND,
			inside(p, part, RANK_SUM), inside(p, other, RANK_SUM)),
			.known = other.constant && other.value >= 0,
			.high = other.value };
	}
	return part;
}

/* For LinuxCNC, ^ is a power. */
static struct part parse_xor(struct parse *p)
{
	struct part part = parse_and(p), other;
	bool power = p->c->project->dialect == CLASSIC_LINUXCNC;

	while (!p->failed && accept(p, "^")) {
		other = parse_and(p);
		part = (struct part){ .text = function_call(
			p, power ? CLASSIC_POWER : CLASSIC_XOR, inside(p, part, RANK_SUM),
			inside(p, other, RANK_SUM)) };
	}
	return part;
}

static struct part parse_or(struct parse *p)
{
	struct part part, other;

	if (++p->depth > DEPTH)
		return fail(p);
	part = parse_xor(p);
	while (!p->failed && accept(p, "|")) {
		other = parse_xor(p);
		part = (struct part){ .text = function_call(p, CLASSIC_OR,
			inside(p, part, RANK_SUM), inside(p, other, RANK_SUM)) };
	}
	p->depth--;
	return part;
}

static struct part parse_function(struct parse *p)
{
	struct part part[ARGUMENTS];
	const struct known *known = NULL;
	int count = 0;

	for (int i = 0; i < KNOWN && !known; i++)
		if (accept(p, known_functions[i].name))
			known = &known_functions[i];
	if (!known || !accept(p, "("))
		return fail(p);
	do {
		if (count == ARGUMENTS)
			return fail(p);
		part[count++] = parse_or(p);
	} while (!p->failed && accept(p, ","));
	if (p->failed || !accept(p, ")"))
		return fail(p);
	return call(p, known, part, count);
}

/* ---- whole expressions ---- */

static const char *not_understood(struct parse *p)
{
	tell(p->c, REPORT_LOST, "expression \"%.60s\" is not understood at \"%.20s\"",
	     p->whole, p->at);
	return NULL;
}

/* NULL, after a line of the report, if the text is longer or deeper than the reader accepts. */
static const char *if_fits(struct parse *p, const char *text)
{
	int depth = 0, deepest = 0, words = 0;
	bool inside = false;

	for (const char *at = text; *at; at++) {
		bool word = *at != ' ' && *at != '(' && *at != ')' && *at != ',' && *at != '[';

		depth += *at == '(' || *at == '[';
		depth -= *at == ')' || *at == ']';
		deepest = depth > deepest ? depth : deepest;
		words += word && !inside;
		inside = word;
	}
	if (deepest < LIMIT_EXPR_DEPTH - 4 && words < LIMIT_EXPR_NODES - 4)
		return text;
	tell(p->c, REPORT_LOST, "expression \"%.60s\" is too large", p->whole);
	return NULL;
}

/* Removes blanks: old files have them anywhere. */
static struct parse begin(struct conversion *c, const char *text)
{
	char *copy = arena_copy(c->arena, text, strlen(text)), *to = copy;

	for (const char *at = copy; at && *at; at++)
		if (*at != ' ' && *at != '\t')
			*to++ = *at;
	if (copy)
		*to = '\0';
	return (struct parse){ .c = c, .at = copy ? copy : "", .whole = text };
}

/* The operator of a comparison; NULL: there is none. */
static const char *comparison(struct parse *p)
{
	static const struct { const char *there, *here; } op[] = {
		{ "==", "=" }, { "=>", "=" }, { "<>", "<>" }, { "<=", "<=" },
		{ ">=", ">=" }, { "!=", "<>" }, { "=", "=" }, { "<", "<" }, { ">", ">" },
	};

	for (size_t i = 0; i < sizeof(op) / sizeof(*op); i++)
		if (accept(p, op[i].there)) {
			if (!strcmp(op[i].there, "!=") && p->c->options.faithful)
				return "=";
			if (!strcmp(op[i].there, "!="))
				tell(p->c, REPORT_CHANGED, "\"!=\" means unequal here; "
				     "ClassicLadder reads it as equal");
			return op[i].here;
		}
	return NULL;
}

const char *comparison_of(struct conversion *c, const char *text)
{
	struct parse p = begin(c, text);
	struct part left = parse_or(&p), right;
	const char *op;

	if (p.failed || !(op = comparison(&p)))
		return not_understood(&p);
	right = parse_or(&p);
	if (p.failed)
		return not_understood(&p);
	if (*p.at)
		tell(c, REPORT_TAKEN, "what stands behind the first comparison of \"%.40s\" "
		     "does not count, as in ClassicLadder", text);
	return if_fits(&p, text_of(c, "%s %s %s", inside(&p, left, RANK_SUM), op,
				   inside(&p, right, RANK_SUM)));
}

static const char *stored(struct parse *p, const char *target, bool is_bool)
{
	struct part value = parse_or(p);

	if (p->failed)
		return not_understood(p);
	if (*p->at)
		tell(p->c, REPORT_TAKEN, "\"%.20s\" at the end of an expression does not "
		     "count, as in ClassicLadder", p->at);
	if (is_bool)
		return if_fits(p, text_of(p->c, "%s := %s <> 0", target,
					  inside(p, value, RANK_SUM)));
	return if_fits(p, text_of(p->c, "%s := %s", target, value.text));
}

const char *assignment_of(struct conversion *c, const char *text)
{
	struct parse p = begin(c, text);
	struct classic_variable variable;
	const char *end = read_variable(p.at, &variable), *target;
	bool is_bool;

	if (!end)
		return not_understood(&p);
	p.at = end;
	if (!accept(&p, ":=") && !accept(&p, "="))
		return not_understood(&p);
	target = target_of(c, variable, &is_bool);
	return target ? stored(&p, target, is_bool) : NULL;
}
