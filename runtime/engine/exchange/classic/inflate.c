/* SPDX-License-Identifier: MIT
 *
 * inflate - unpacks gzip (RFC 1951, RFC 1952).
 *
 * Reads codes bit by bit, with the number of codes of each length as its only table: slow,
 * but projects are small. Every read and write is bounded.
 */
#include "engine/exchange/classic/inflate.h"

#include <string.h>

enum {
	BITS_MAX = 15,           /* of a code                                  */
	LITERALS = 288,
	DISTANCES = 30,
	HEAD = 10, TAIL = 8,     /* bytes around the packed text               */
	MOST_OF_ONE = 1032,      /* bytes that may come of one                 */
	END_OF_BLOCK = 256
};

struct code {
	uint16_t count[BITS_MAX + 1]; /* codes of each length                  */
	uint16_t symbol[LITERALS];    /* by code                               */
};

struct inflate {
	const uint8_t *at, *end;
	uint32_t bits;           /* read from @at, not used yet                */
	int left;                /* how many                                   */
	bool cut;                /* the end was reached too early              */
	uint8_t *out;
	size_t len, size;
	struct code literal, distance;
	uint8_t length[LITERALS + 32];
};

bool inflate_is(const void *bytes, size_t len)
{
	const uint8_t *byte = bytes;

	return len >= 2 && byte[0] == 0x1f && byte[1] == 0x8b;
}

uint32_t inflate_crc32(uint32_t crc, const void *bytes, size_t len)
{
	static const uint32_t table[16] = {
		0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4,
		0x4db26158, 0x5005713c, 0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
		0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c };
	const uint8_t *byte = bytes;

	crc = ~crc;
	for (size_t i = 0; i < len; i++) {
		crc ^= byte[i];
		crc = crc >> 4 ^ table[crc & 15];
		crc = crc >> 4 ^ table[crc & 15];
	}
	return ~crc;
}

/* The next @count bits, lowest first, at most 16; 0 and cut at the end. */
static uint32_t take_bits(struct inflate *inflate, int count)
{
	uint32_t bits;

	while (inflate->left < count) {
		if (inflate->at == inflate->end) {
			inflate->cut = true;
			return 0;
		}
		inflate->bits |= (uint32_t)*inflate->at++ << inflate->left;
		inflate->left += 8;
	}
	bits = inflate->bits & ((1u << count) - 1);
	inflate->bits >>= count;
	inflate->left -= count;
	return bits;
}

/* Makes a code of the lengths of its symbols. false: more codes than fit, or fewer and more
 * than one. */
static bool make_code(struct code *code, const uint8_t *length, int symbols)
{
	uint16_t next[BITS_MAX + 2] = { 0 };
	int room = 1, used = 0;

	memset(code->count, 0, sizeof(code->count));
	for (int i = 0; i < symbols; i++)
		code->count[length[i]]++;
	used = symbols - code->count[0];
	code->count[0] = 0;
	for (int bits = 1; bits <= BITS_MAX; bits++) {
		room = room * 2 - code->count[bits];
		if (room < 0)
			return false;
		next[bits + 1] = (uint16_t)(next[bits] + code->count[bits]);
	}
	for (int i = 0; i < symbols; i++)
		if (length[i])
			code->symbol[next[length[i]]++] = (uint16_t)i;
	return room == 0 || used <= 1;
}

/* The next symbol; -1: there is no such code. */
static int take_symbol(struct inflate *inflate, const struct code *code)
{
	int value = 0, first = 0, before = 0;

	for (int bits = 1; bits <= BITS_MAX; bits++) {
		value |= (int)take_bits(inflate, 1);
		if (inflate->cut)
			return -1;
		if (value - first < code->count[bits])
			return code->symbol[before + value - first];
		before += code->count[bits];
		first = (first + code->count[bits]) << 1;
		value <<= 1;
	}
	return -1;
}

static bool put_copy(struct inflate *inflate, size_t distance, size_t count)
{
	if (distance > inflate->len || count > inflate->size - inflate->len)
		return false;
	for (; count; count--, inflate->len++)
		inflate->out[inflate->len] = inflate->out[inflate->len - distance];
	return true;
}

/* A copy of earlier text: its length and distance (3.2.5). */
static bool take_copy(struct inflate *inflate, int symbol)
{
	static const uint8_t extra[] = { 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
					 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0 };
	static const uint16_t length[] = { 3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23,
					   27, 31, 35, 43, 51, 59, 67, 83, 99, 115, 131,
					   163, 195, 227, 258 };
	size_t count, distance;
	int far, more;

	symbol -= END_OF_BLOCK + 1;
	if (symbol > 28)
		return false;
	count = length[symbol] + take_bits(inflate, extra[symbol]);
	far = take_symbol(inflate, &inflate->distance);
	if (far < 0 || far >= DISTANCES)
		return false;
	more = far < 4 ? 0 : far / 2 - 1;
	distance = far < 4 ? (size_t)far + 1 : ((size_t)(2 + (far & 1)) << more) + 1;
	distance += take_bits(inflate, more);
	return !inflate->cut && put_copy(inflate, distance, count);
}

static bool take_block(struct inflate *inflate)
{
	for (;;) {
		int symbol = take_symbol(inflate, &inflate->literal);

		if (symbol == END_OF_BLOCK)
			return true;
		if (symbol < 0 || inflate->len == inflate->size)
			return false;
		if (symbol < END_OF_BLOCK)
			inflate->out[inflate->len++] = (uint8_t)symbol;
		else if (!take_copy(inflate, symbol))
			return false;
	}
}

static bool take_stored(struct inflate *inflate)
{
	size_t count;

	inflate->bits = 0;
	inflate->left = 0; /* the rest of a byte                              */
	if (inflate->end - inflate->at < 4)
		return false;
	count = inflate->at[0] | (size_t)inflate->at[1] << 8;
	if ((inflate->at[2] | (size_t)inflate->at[3] << 8) != (count ^ 0xffff))
		return false;
	inflate->at += 4;
	if (count > (size_t)(inflate->end - inflate->at) ||
	    count > inflate->size - inflate->len)
		return false;
	memcpy(inflate->out + inflate->len, inflate->at, count);
	inflate->len += count;
	inflate->at += count;
	return true;
}

static bool fixed_codes(struct inflate *inflate)
{
	uint8_t *length = inflate->length;

	memset(length, 8, LITERALS);
	memset(length + 144, 9, 112);
	memset(length + 256, 7, 24);
	memset(length + LITERALS, 5, 32);
	return make_code(&inflate->literal, length, LITERALS) &&
	       make_code(&inflate->distance, length + LITERALS, 32);
}

/* Lengths of @count codes, themselves packed (3.2.7). */
static bool take_lengths(struct inflate *inflate, int count)
{
	int at = 0;

	while (at < count) {
		int symbol = take_symbol(inflate, &inflate->literal), repeat = 1;
		uint8_t value = (uint8_t)symbol;

		if (symbol < 0 || (symbol == 16 && at == 0))
			return false;
		if (symbol >= 16) {
			value = symbol == 16 ? inflate->length[at - 1] : 0;
			repeat = symbol == 16 ? 3 + (int)take_bits(inflate, 2) :
				 symbol == 17 ? 3 + (int)take_bits(inflate, 3) :
						11 + (int)take_bits(inflate, 7);
		}
		if (inflate->cut || repeat > count - at)
			return false;
		memset(inflate->length + at, value, (size_t)repeat);
		at += repeat;
	}
	return true;
}

static bool dynamic_codes(struct inflate *inflate)
{
	static const uint8_t order[] = { 16, 17, 18, 0, 8, 7, 9, 6, 10, 5,
					 11, 4, 12, 3, 13, 2, 14, 1, 15 };
	int literals = 257 + (int)take_bits(inflate, 5);
	int distances = 1 + (int)take_bits(inflate, 5);
	int lengths = 4 + (int)take_bits(inflate, 4);

	if (literals > 286 || distances > DISTANCES)
		return false;
	memset(inflate->length, 0, sizeof(inflate->length));
	for (int i = 0; i < lengths; i++)
		inflate->length[order[i]] = (uint8_t)take_bits(inflate, 3);
	if (inflate->cut || !make_code(&inflate->literal, inflate->length, 19) ||
	    !take_lengths(inflate, literals + distances))
		return false;
	return inflate->length[END_OF_BLOCK] &&
	       make_code(&inflate->distance, inflate->length + literals, distances) &&
	       make_code(&inflate->literal, inflate->length, literals);
}

static bool take_all(struct inflate *inflate)
{
	bool last = false;

	while (!last) {
		uint32_t kind;
		bool good;

		last = take_bits(inflate, 1);
		kind = take_bits(inflate, 2);
		if (inflate->cut || kind == 3)
			return false;
		if (kind == 0)
			good = take_stored(inflate);
		else
			good = (kind == 1 ? fixed_codes(inflate) : dynamic_codes(inflate)) &&
			       take_block(inflate);
		if (!good)
			return false;
	}
	return true;
}

/* Skips the header and its optional parts: extra field, name, comment, checksum. */
static bool skip_head(struct inflate *inflate)
{
	uint8_t flags;

	if (inflate->end - inflate->at < HEAD || inflate->at[2] != 8)
		return false;
	flags = inflate->at[3];
	inflate->at += HEAD;
	if (flags & 4) {
		size_t extra;

		if (inflate->end - inflate->at < 2)
			return false;
		extra = 2 + (inflate->at[0] | (size_t)inflate->at[1] << 8);
		if (extra > (size_t)(inflate->end - inflate->at))
			return false;
		inflate->at += extra;
	}
	for (int field = 0; field < !!(flags & 8) + !!(flags & 16); field++) {
		const uint8_t *nul = memchr(inflate->at, 0,
					    (size_t)(inflate->end - inflate->at));

		if (!nul)
			return false;
		inflate->at = nul + 1;
	}
	if (flags & 2) {
		if (inflate->end - inflate->at < 2)
			return false;
		inflate->at += 2;
	}
	return !(flags & 0xe0);
}

static uint32_t word_at(const uint8_t *at)
{
	return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

char *inflate_gzip(struct arena *arena, const void *bytes, size_t len, size_t limit,
		   size_t *out_len, enum diag_id *why)
{
	const uint8_t *tail = (const uint8_t *)bytes + len - TAIL;
	struct inflate *inflate;

	*why = DIAG_IMPORT_PACKED;
	if (len < HEAD + TAIL)
		return NULL;
	if (word_at(tail + 4) / MOST_OF_ONE > len)
		return NULL;
	if (word_at(tail + 4) > limit) {
		*why = DIAG_TOO_LARGE;
		return NULL;
	}
	inflate = arena_alloc(arena, sizeof(*inflate));
	if (inflate) {
		inflate->size = word_at(tail + 4);
		inflate->out = arena_alloc(arena, inflate->size + 1);
	}
	if (!inflate || !inflate->out) {
		*why = DIAG_NO_MEMORY;
		return NULL;
	}
	inflate->at = bytes;
	inflate->end = tail;
	if (!skip_head(inflate) || !take_all(inflate) || inflate->at != tail ||
	    inflate->len != inflate->size ||
	    inflate_crc32(0, inflate->out, inflate->len) != word_at(tail))
		return NULL;
	*out_len = inflate->len;
	return (char *)inflate->out;
}
