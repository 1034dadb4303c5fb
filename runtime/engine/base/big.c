/* SPDX-License-Identifier: MIT
 *
 * big - unsigned integers of up to 1984 bits, word by word.
 */
#include "engine/base/big.h"

#include <string.h>

/* The top word is never 0. */
static void trim(struct big *big)
{
	while (big->count > 0 && big->word[big->count - 1] == 0)
		big->count--;
}

static void push(struct big *big, uint32_t word)
{
	if (big->count < BIG_WORDS)
		big->word[big->count++] = word;
}

void big_set(struct big *big, uint64_t value)
{
	big->word[0] = (uint32_t)value;
	big->word[1] = (uint32_t)(value >> 32);
	big->count = 2;
	trim(big);
}

void big_scale(struct big *big, uint32_t by, uint32_t add)
{
	uint64_t carry = add;

	for (int i = 0; i < big->count; i++) {
		carry += (uint64_t)big->word[i] * by;
		big->word[i] = (uint32_t)carry;
		carry >>= 32;
	}
	if (carry)
		push(big, (uint32_t)carry);
}

void big_power(struct big *big, int tens)
{
	for (; tens >= 9; tens -= 9)
		big_scale(big, 1000000000u, 0);
	for (; tens > 0; tens--)
		big_scale(big, 10, 0);
}

void big_shift(struct big *big, int bits)
{
	int words = bits / 32;

	if (big->count == 0)
		return;
	if (bits % 32)
		big_scale(big, (uint32_t)1 << bits % 32, 0);
	if (words > BIG_WORDS - big->count)
		words = BIG_WORDS - big->count;
	memmove(big->word + words, big->word, (size_t)big->count * sizeof(*big->word));
	memset(big->word, 0, (size_t)words * sizeof(*big->word));
	big->count += words;
}

int big_bits(const struct big *big)
{
	if (big->count == 0)
		return 0;
	return big->count * 32 - __builtin_clz(big->word[big->count - 1]);
}

static uint32_t word_at(const struct big *big, int at)
{
	return at < big->count ? big->word[at] : 0;
}

/* From the top word down; what remains below one word is less than 4 of that word. */
int big_order(const struct big *a, int times, const struct big *b, const struct big *c)
{
	int at = a->count > c->count ? a->count : c->count;
	int64_t sum = 0;

	if (b->count > at)
		at = b->count;
	while (at-- > 0) {
		sum = sum * ((int64_t)1 << 32) + word_at(a, at) +
		      (int64_t)word_at(b, at) * times - word_at(c, at);
		if (sum > 4 || sum < -4)
			break;
	}
	return (sum > 0) - (sum < 0);
}

void big_subtract(struct big *a, const struct big *b)
{
	int64_t borrow = 0;

	for (int i = 0; i < a->count; i++) {
		borrow += (int64_t)a->word[i] - word_at(b, i);
		a->word[i] = (uint32_t)borrow;
		borrow = borrow < 0 ? -1 : 0;
	}
	trim(a);
}
