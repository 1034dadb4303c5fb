/* SPDX-License-Identifier: MIT
 *
 * name - which characters a name may have, and whether two spellings are one name.
 *
 * Names of ASCII alone take a short way. All others are compared code point by code point: each
 * is decomposed, marks behind a letter are put into canonical order, then each is folded.
 */
#include "engine/base/name.h"
#include "engine/base/ascii.h"
#include "engine/base/lex.h"

#include <string.h>

/* The first 64 Ki characters, then the others. */
static const uint16_t letters_low[] = {
#define LETTERS_LOW
#include "engine/base/letters.def"
#undef LETTERS_LOW
};
static const uint32_t letters_high[] = {
#define LETTERS_HIGH
#include "engine/base/letters.def"
#undef LETTERS_HIGH
};

bool utf8_is_letter(const char *text, size_t len)
{
	const uint32_t code = utf8_code(text, len);
	const bool low = code < 0x10000;
	size_t from = 0, to = low ? sizeof(letters_low) / sizeof(*letters_low) :
				    sizeof(letters_high) / sizeof(*letters_high);

	while (from < to) {
		const size_t middle = (from + to) / 2;

		if ((low ? letters_low[middle] : letters_high[middle]) <= code)
			from = middle + 1;
		else
			to = middle;
	}
	return from % 2;
}

/* Rows are packed: together they are the largest table of a board. A code point has 18 bits. */
static const struct fold {
	uint64_t first : 18, last : 18, step : 4;
	int64_t add : 24;
} folds[] = {
#define LETTER_FOLDS
#include "engine/base/letters.def"
#undef LETTER_FOLDS
};

static const struct { uint16_t code, first, second; } parts_low[] = {
#define LETTER_PARTS_LOW
#include "engine/base/letters.def"
#undef LETTER_PARTS_LOW
};

static const struct { uint64_t code : 18, first : 18, second : 18; } parts_high[] = {
#define LETTER_PARTS_HIGH
#include "engine/base/letters.def"
#undef LETTER_PARTS_HIGH
};

/* Code points that stand for one other: runs of them, and the others. */
static const struct { uint32_t code : 20, count : 12; } runs[] = {
#define LETTER_RUNS
#include "engine/base/letters.def"
#undef LETTER_RUNS
};
static const uint8_t ones[][3] = {
#define ONE(code) { (code) & 0xff, (code) >> 8 & 0xff, (code) >> 16 }
#define LETTER_ONES
#include "engine/base/letters.def"
#undef LETTER_ONES
};

static const struct mark {
	uint32_t first : 18, more : 6, class : 8;
} marks[] = {
#define LETTER_MARKS
#include "engine/base/letters.def"
#undef LETTER_MARKS
};

#define LENGTH(array) (sizeof(array) / sizeof(*(array)))

static uint32_t fold(uint32_t code)
{
	size_t from = 0, to = LENGTH(folds);

	if (code < 0x80)
		return code >= 'A' && code <= 'Z' ? code - 'A' + 'a' : code;
	while (from < to) {
		const size_t middle = (from + to) / 2;
		const struct fold *at = &folds[middle];

		if (code < at->first)
			to = middle;
		else if (code > at->last)
			from = middle + 1;
		else
			return (code - (uint32_t)at->first) % (uint32_t)at->step ? code :
			       code + (uint32_t)at->add;
	}
	return code;
}

/* The canonical combining class; 0: not a mark. */
static uint32_t class_of(uint32_t code)
{
	size_t from = 0, to = LENGTH(marks);

	while (code >= 0x300 && from < to) {
		const size_t middle = (from + to) / 2;

		if (code < marks[middle].first)
			to = middle;
		else if (code > marks[middle].first + marks[middle].more)
			from = middle + 1;
		else
			return marks[middle].class;
	}
	return 0;
}

/* The one code point that @code stands for; 0: none. */
static uint32_t other_of(uint32_t code)
{
	size_t at = 0;

	for (size_t i = 0; i < LENGTH(runs) && code >= runs[i].code; at += runs[i++].count)
		if (code - runs[i].code < runs[i].count) {
			at += code - runs[i].code;
			return ones[at][0] | (uint32_t)ones[at][1] << 8 |
			       (uint32_t)ones[at][2] << 16;
		}
	return 0;
}

/* The one or two code points that @code is composed of; false: it is not composed. */
static bool take_apart(uint32_t code, uint32_t *first, uint32_t *second)
{
	*first = other_of(code);
	*second = 0;
	if (*first)
		return true;
	/* Some below 0x10000 have parts beyond it and stand in the other table. */
	for (int wide = code >= 0x10000; wide < 2; wide++) {
		size_t from = 0, to = wide ? LENGTH(parts_high) : LENGTH(parts_low);

		while (from < to) {
			const size_t at = (from + to) / 2;
			const uint32_t found = wide ? (uint32_t)parts_high[at].code : parts_low[at].code;

			if (found == code) {
				*first = wide ? (uint32_t)parts_high[at].first : parts_low[at].first;
				*second = wide ? (uint32_t)parts_high[at].second : parts_low[at].second;
				return true;
			}
			if (found < code)
				from = at + 1;
			else
				to = at;
		}
	}
	return false;
}

#define PARTS_MOST 4 /* of one code point */

/* Syllables of Hangul are composed by a rule (Unicode 3.12). */
static int hangul_parts(uint32_t code, uint32_t out[PARTS_MOST])
{
	const uint32_t index = code - 0xac00;

	out[0] = 0x1100 + index / 588;
	out[1] = 0x1161 + index % 588 / 28;
	out[2] = 0x11a7 + index % 28;
	return index % 28 ? 3 : 2;
}

static int parts_of(uint32_t code, uint32_t out[PARTS_MOST])
{
	uint32_t behind[PARTS_MOST], first, second;
	int count = 0, n = 0;

	if (code >= 0xac00 && code < 0xac00 + 11172)
		return hangul_parts(code, out);
	while (code >= 0xc0 && !(code >= 0x3400 && code < 0xa000) && count < PARTS_MOST - 1 &&
	       take_apart(code, &first, &second)) {
		code = first;
		if (second)
			behind[count++] = second;
	}
	out[n++] = code;
	while (count > 0)
		out[n++] = behind[--count];
	return n;
}

#define RUN_MOST 32 /* a letter with more marks is compared in pieces */

/* A letter with its marks, in canonical order, and what follows. */
struct spelling {
	const char *at, *end;
	int next, count;
	uint32_t code[RUN_MOST + PARTS_MOST];
	uint8_t class[RUN_MOST + PARTS_MOST];
};

static void begin(struct spelling *s, const char *text, size_t len)
{
	s->at = text;
	s->end = text + len;
	s->next = s->count = 0;
}

static void add(struct spelling *s, uint32_t code, uint32_t class)
{
	int at = s->count++;

	for (; class && at > 0 && s->class[at - 1] > class; at--) {
		s->code[at] = s->code[at - 1];
		s->class[at] = s->class[at - 1];
	}
	s->code[at] = code;
	s->class[at] = (uint8_t)class;
}

static void fill(struct spelling *s)
{
	s->next = s->count = 0;
	while (s->at < s->end && s->count < RUN_MOST) {
		const size_t len = utf8_length(s->at, (size_t)(s->end - s->at));
		const uint32_t code = len ? utf8_code(s->at, len) :
					    0x110000u + (unsigned char)*s->at;
		uint32_t part[PARTS_MOST];
		const int count = parts_of(code, part);

		if (s->count && class_of(part[0]) == 0)
			return;
		for (int i = 0; i < count; i++)
			add(s, part[i], class_of(part[i]));
		s->at += len ? len : 1;
	}
}

/* The next code point, folded; false: the end. */
static bool next(struct spelling *s, uint32_t *code)
{
	if (s->next == s->count)
		fill(s);
	if (s->next == s->count)
		return false;
	*code = fold(s->code[s->next++]);
	return true;
}

/* Compares from a place on where the texts before are the same. @whole: both end together;
 * else @b may go on. */
static bool same_rest(const char *a, size_t a_len, const char *b, size_t b_len, bool whole)
{
	struct spelling left, right;
	uint32_t x = 0, y = 0;

	begin(&left, a, a_len);
	begin(&right, b, b_len);
	for (;;) {
		const bool more = next(&left, &x), other = next(&right, &y);

		if (!more)
			return !whole || !other;
		if (!other || x != y)
			return false;
	}
}

static bool is_high(char c)
{
	return (unsigned char)c > 0x7f;
}

/* Bytes of ASCII at the beginning in which both are the same. A mark may belong to the last. */
static size_t same_ascii(const char *a, size_t a_len, const char *b, size_t b_len)
{
	const size_t least = a_len < b_len ? a_len : b_len;
	size_t at = 0;

	while (at < least && !is_high(a[at]) && !is_high(b[at]) &&
	       ascii_upper(a[at]) == ascii_upper(b[at]))
		at++;
	return at;
}

bool name_same(const char *a, size_t a_len, const char *b, size_t b_len)
{
	const size_t at = same_ascii(a, a_len, b, b_len);

	if (at == a_len || at == b_len)
		return a_len == b_len;
	if (!is_high(a[at]) && !is_high(b[at]))
		return false;
	return same_rest(a + at - (at > 0), a_len - at + (at > 0), b + at - (at > 0),
			 b_len - at + (at > 0), true);
}

bool name_is(const char *word, const char *text, size_t len)
{
	return name_same(word, strlen(word), text, len);
}

bool name_equal(const char *a, const char *b)
{
	return name_same(a, strlen(a), b, strlen(b));
}

bool name_begins(const char *first, size_t first_len, const char *text, size_t len)
{
	const size_t at = same_ascii(first, first_len, text, len);

	if (at == first_len)
		return true;
	return same_rest(first, first_len, text, len, false);
}

static bool ends_name(char c)
{
	return c == '.' || c == '[' || c == ' ';
}

size_t name_head(const char *word, size_t word_len, const char *text, size_t len)
{
	for (size_t at = 1; at <= len; at++)
		if ((at == len || ends_name(text[at])) &&
		    name_same(word, word_len, text, at))
			return at;
	return 0;
}

/* ---- hashes ---- */

static uint32_t hash_byte(uint32_t hash, uint32_t byte)
{
	return (hash ^ byte) * 16777619u;
}

/* As name_hash_more(), of a text with characters beyond ASCII. */
static uint32_t hash_letters(uint32_t hash, const char *text, size_t len)
{
	struct spelling s;
	uint32_t code;

	begin(&s, text, len);
	while (next(&s, &code)) {
		hash = hash_byte(hash, code < 0x80 ? code & 0xdf : code & 0xff);
		if (code >= 0x80)
			hash = hash_byte(hash_byte(hash, code >> 8 & 0xff), code >> 16);
	}
	return hash;
}

/* FNV-1a, of ASCII over the bytes without the bit that differs between a and A. */
uint32_t name_hash_more(uint32_t hash, const char *text, size_t len)
{
	const uint32_t before = hash;

	for (size_t i = 0; i < len; i++) {
		if (is_high(text[i]))
			return hash_letters(before, text, len);
		hash = hash_byte(hash, (uint8_t)text[i] & 0xdfu);
	}
	return hash;
}

uint32_t name_hash(const char *text, size_t len)
{
	const uint32_t hash = name_hash_more(NAME_HASH, text, len);

	return hash ^ hash >> 15;
}

/* ---- keys ---- */

/* UTF-8 of a code point, or the byte that was none. */
static size_t encode(uint32_t code, char out[4])
{
	const size_t len = code < 0x80 || code >= 0x110000 ? 1 : code < 0x800 ? 2 :
			   code < 0x10000 ? 3 : 4;
	static const uint32_t lead[] = { 0, 0, 0xc0, 0xe0, 0xf0 };

	if (len == 1) {
		out[0] = (char)(code & 0xff);
		return 1;
	}
	for (size_t i = len - 1; i > 0; i--, code >>= 6)
		out[i] = (char)(0x80 | (code & 0x3f));
	out[0] = (char)(lead[len] | code);
	return len;
}

size_t name_key(const char *text, size_t len, char *out, size_t size)
{
	struct spelling s;
	size_t used = 0;
	uint32_t code;

	begin(&s, text, len);
	while (next(&s, &code)) {
		char bytes[4];
		const size_t count = encode(code, bytes);

		if (used + count < size)
			memcpy(out + used, bytes, count);
		else if (used < size)
			size = used + 1; /* no half characters */
		used += count;
	}
	if (size)
		out[used < size ? used : size - 1] = '\0';
	return used;
}
