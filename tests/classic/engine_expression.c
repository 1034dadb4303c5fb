/* SPDX-License-Identifier: MIT
 *
 * engine_expression - comparisons and assignments of ClassicLadder, from their text.
 *
 * Text that cannot be read ends the expression; its value is the part before it. With
 * engine->faithful also ClassicLadder's faults: F4 `!=` is `=`, F7 rotations insert one bit
 * and a shift to the right clears one, F8 a variable is not negated, F9 a power squares.
 */
#include "tests/classic/engine.h"

#include <string.h>

enum { DEPTH = 60, ARGS = 16 };

struct text {
	struct engine *engine;
	const char *at;
	int depth;
};

static int32_t disjunction(struct text *text);

static void blanks(struct text *text)
{
	while (*text->at == ' ')
		text->at++;
}

static bool accept(struct text *text, char c)
{
	blanks(text);
	if (*text->at != c)
		return false;
	text->at++;
	return true;
}

static int32_t wrap(int64_t value)
{
	return (int32_t)(uint32_t)value;
}

static bool is_digit(char c)
{
	return c >= '0' && c <= '9';
}

static int32_t number(struct text *text)
{
	uint32_t value = 0;

	for (; is_digit(*text->at); text->at++)
		value = value * 10 + (uint32_t)(*text->at - '0');
	return (int32_t)value;
}

static int32_t hex(struct text *text)
{
	static const char digits[] = "0123456789ABCDEF";
	uint32_t value = 0;
	const char *found;

	for (; *text->at; text->at++) {
		char c = *text->at;

		if (c >= 'a' && c <= 'f')
			c = (char)(c - 'a' + 'A');
		found = strchr(digits, c);
		if (!found)
			break;
		value = value * 16 + (uint32_t)(found - digits);
	}
	return (int32_t)value;
}

static int32_t letters(struct text *text)
{
	uint32_t value = 0;

	for (; *text->at && *text->at != '\''; text->at++)
		value = value * 256 + (unsigned char)*text->at;
	if (*text->at)
		text->at++;
	return (int32_t)value;
}

/* "TYPE/NUMBER[TYPE/NUMBER]@". false: it is no variable. */
static bool variable(struct text *text, int *type, int64_t *at)
{
	struct classic_variable read = { .index_type = -1 };

	read.type = number(text);
	if (!accept(text, '/'))
		return false;
	read.number = number(text);
	if (accept(text, '[')) {
		read.index_type = number(text);
		if (!accept(text, '/'))
			return false;
		read.index_number = number(text);
		if (!accept(text, ']'))
			return false;
	}
	*type = read.type;
	*at = engine_at(text->engine, &read);
	return accept(text, '@');
}

/* One variable or constant. */
static int32_t value(struct text *text)
{
	int type;
	int64_t at;

	if (accept(text, '@'))
		return variable(text, &type, &at) ? engine_get(text->engine, type, at) : 0;
	if (accept(text, '$'))
		return hex(text);
	if (accept(text, '\''))
		return letters(text);
	return number(text);
}

static void shifted_out(struct engine *engine, bool bit)
{
	engine->system[8] = bit;
}

/* A number of bits: more than 32 act as 32. */
static int32_t shift(struct engine *engine, bool left, uint32_t a, int32_t n)
{
	uint32_t result;

	if (n <= 0)
		return (int32_t)a;
	shifted_out(engine, n <= 32 && (left ? a >> (32 - n) : a >> (n - 1)) & 1);
	if (n >= 32)
		return !left && engine->faithful && a >> 31 ? INT32_MAX : 0;
	if (left)
		return (int32_t)(a << n);
	result = a >> n;
	if (engine->faithful && a >> 31)
		result = (result | ~(UINT32_MAX >> n)) & INT32_MAX;
	return (int32_t)result;
}

static int32_t rotate(struct engine *engine, bool left, uint32_t a, int32_t n)
{
	uint32_t bit;

	if (engine->faithful) {
		if (n <= 0 || n >= 32)
			return (int32_t)a;
		bit = (left ? a >> (32 - n) : a >> (n - 1)) & 1;
		shifted_out(engine, bit);
		if (left)
			return (int32_t)(a << n | bit);
		return (int32_t)(((uint32_t)((int32_t)a >> n) & INT32_MAX) | bit << 31);
	}
	n &= 31;
	if (n == 0)
		return (int32_t)a;
	shifted_out(engine, (left ? a >> (32 - n) : a >> (n - 1)) & 1);
	return (int32_t)(left ? a << n | a >> (32 - n) : a >> n | a << (32 - n));
}

static int32_t power(int32_t a, int32_t b)
{
	uint32_t result = 1;

	/* By squaring, because the exponent can be large.                      */
	for (uint32_t base = (uint32_t)a; b > 0; b >>= 1, base *= base)
		if (b & 1)
			result *= base;
	return (int32_t)result;
}

/* ^ of LinuxCNC: squares b times (F9). */
static int32_t squares(int32_t a, int32_t b)
{
	uint32_t result = (uint32_t)a;

	for (int32_t i = 0; i < b && i < 64; i++)
		result *= result;
	return (int32_t)result;
}

static const char *const words[] = { "ABS", "MINI", "MAXI", "AVG", "MOY", "POW",
				     "SHL", "SHR", "ROL", "ROR" };
enum { ABS, MINI, MAXI, AVG, MOY, POW, SHL, SHR, ROL, ROR, WORDS };

static int32_t call(struct engine *engine, int word, const int32_t *arg, int count)
{
	int32_t result = arg[0];
	int64_t sum = 0;

	switch (word) {
	case ABS:
		return result < 0 ? wrap(-(int64_t)result) : result;
	case MINI:
		for (int i = 1; i < count; i++)
			result = arg[i] < result ? arg[i] : result;
		return result;
	case MAXI:
		for (int i = 1; i < count; i++)
			result = arg[i] > result ? arg[i] : result;
		return result;
	case AVG:
	case MOY:
		for (int i = 0; i < count; i++)
			sum = wrap(sum + arg[i]);
		return (int32_t)(sum / count);
	case POW:
		return power(arg[0], arg[1]);
	case SHL:
	case SHR:
		return shift(engine, word == SHL, (uint32_t)arg[0], arg[1]);
	default:
		return rotate(engine, word == ROL, (uint32_t)arg[0], arg[1]);
	}
}

/* The function at the cursor with its arguments; -1 in @word: there is none. */
static int32_t function(struct text *text, int *word)
{
	int32_t arg[ARGS] = { 0 };
	int count = 0;

	for (*word = 0; *word < WORDS; ++*word) {
		size_t len = strlen(words[*word]);

		if (strncmp(text->at, words[*word], len) == 0 && text->at[len] == '(') {
			text->at += len + 1;
			break;
		}
	}
	if (*word == WORDS) {
		*word = -1;
		return 0;
	}
	do {
		bool minus = accept(text, '-');
		int32_t read = value(text);

		if (count < ARGS)
			arg[count++] = minus ? wrap(-(int64_t)read) : read;
	} while (accept(text, ','));
	accept(text, ')');
	return call(text->engine, *word, arg, count);
}

static int32_t term(struct text *text)
{
	int32_t result = 0;
	int word;

	blanks(text);
	if (text->depth >= DEPTH)
		return 0;
	text->depth++;
	if (accept(text, '!')) {
		result = term(text) == 0;
	} else if (*text->at == '-') {
		if (is_digit(text->at[1]) || text->at[1] == '$' || text->at[1] == '\'' ||
		    !text->engine->faithful) { /* F8 */
			text->at++;
			result = wrap(-(int64_t)term(text));
		} else {
			text->at++;
			term(text);
		}
	} else if (accept(text, '(')) {
		result = disjunction(text);
		accept(text, ')');
	} else {
		result = function(text, &word);
		if (word < 0)
			result = value(text);
	}
	text->depth--;
	return result;
}

static int32_t product(struct text *text)
{
	int32_t result = term(text);

	for (;;) {
		bool times = accept(text, '*'), over = !times && accept(text, '/');
		int32_t by;

		if (!times && !over && !accept(text, '%'))
			return result;
		by = term(text);
		if (times) {
			result = wrap((int64_t)result * by);
		} else if (by == 0) {
			text->engine->system[7] = 1;
			result = 0;
		} else {
			result = over ? wrap((int64_t)result / by) :
					(int32_t)((int64_t)result % by);
		}
	}
}

static int32_t sum(struct text *text)
{
	int32_t result = product(text);

	for (;;) {
		if (accept(text, '+'))
			result = wrap((int64_t)result + product(text));
		else if (accept(text, '-'))
			result = wrap((int64_t)result - product(text));
		else
			return result;
	}
}

static int32_t conjunction(struct text *text)
{
	int32_t result = sum(text);

	while (accept(text, '&'))
		result &= sum(text);
	return result;
}

static int32_t exclusive(struct text *text)
{
	const struct engine *engine = text->engine;
	int32_t result = conjunction(text), by;

	while (accept(text, '^')) {
		by = conjunction(text);
		if (engine->project->dialect != CLASSIC_LINUXCNC)
			result ^= by;
		else
			result = engine->faithful ? squares(result, by) : power(result, by);
	}
	return result;
}

static int32_t disjunction(struct text *text)
{
	int32_t result = exclusive(text);

	while (accept(text, '|'))
		result |= exclusive(text);
	return result;
}

bool engine_compare(struct engine *engine, const char *from)
{
	struct text text = { engine, from, 0 };
	int32_t left = disjunction(&text), right;
	char first, second;

	blanks(&text);
	first = *text.at;
	if (first != '=' && first != '<' && first != '>' && first != '!')
		return false;
	second = *++text.at;
	if (second == '=' || second == '>' || (second == '<' && first == '='))
		text.at++;
	else
		second = 0;
	right = disjunction(&text);
	if (first == '<')
		return second == '=' ? left <= right :
		       second == '>' ? left != right : left < right;
	if (first == '>')
		return second == '=' ? left >= right : left > right;
	if (first == '!' && !engine->faithful) /* F4 */
		return left != right;
	return left == right;
}

void engine_operate(struct engine *engine, const char *from)
{
	struct text text = { engine, from, 0 };
	int64_t at;
	int type;

	if (!accept(&text, '@') || !variable(&text, &type, &at))
		return;
	accept(&text, ':');
	if (!accept(&text, '='))
		return;
	engine_set(engine, type, at, disjunction(&text));
}
