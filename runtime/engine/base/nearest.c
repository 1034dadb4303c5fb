/* SPDX-License-Identifier: MIT
 *
 * nearest - the edit distance of two words: letters changed, left out, added, or
 * swapped with the next. A candidate that begins with the wanted word counts as near,
 * too.
 */
#include "engine/base/nearest.h"

#include "engine/base/diag.h"

#include "engine/base/ascii.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

void nearest_init(struct nearest *nearest, const char *wanted, size_t len)
{
	*nearest = (struct nearest){ .wanted = wanted, .len = len };
}

static int least(int a, int b)
{
	return a < b ? a : b;
}

static bool same(char a, char b)
{
	return ascii_upper(a) == ascii_upper(b);
}

/* The last three rows of the table of distances; no more are needed. */
static int distance(const char *a, size_t a_len, const char *b, size_t b_len)
{
	uint8_t row[3][NEAREST_MOST + 1];

	for (size_t j = 0; j <= b_len; j++)
		row[0][j] = (uint8_t)j;
	for (size_t i = 1; i <= a_len; i++) {
		uint8_t *now = row[i % 3], *up = row[(i + 2) % 3];
		const uint8_t *above = row[(i + 1) % 3];

		now[0] = (uint8_t)i;
		for (size_t j = 1; j <= b_len; j++) {
			int cost = up[j - 1] + !same(a[i - 1], b[j - 1]);

			cost = least(cost, least(up[j], now[j - 1]) + 1);
			if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) &&
			    same(a[i - 2], b[j - 1]))
				cost = least(cost, above[j - 2] + 1);
			now[j] = (uint8_t)cost;
		}
	}
	return row[a_len % 3][b_len];
}

/* A word of three letters may have one wrong letter, a longer one more. */
static int allowed(size_t len)
{
	return len < 2 ? 0 : len < 5 ? 1 : len < 9 ? 2 : 3;
}

static int how_far(const struct nearest *nearest, const char *text, size_t len)
{
	size_t wanted = nearest->len;

	if (wanted >= 3 && len > wanted && ascii_same(text, nearest->wanted, wanted))
		return 1;
	if (len > wanted + 3 || wanted > len + 3)
		return NEAREST_MOST;
	return distance(nearest->wanted, wanted, text, len);
}

void nearest_offer(struct nearest *nearest, const char *text)
{
	size_t len = strlen(text);
	struct nearest_word word = { text, 0 };
	int at = nearest->count;

	if (len == 0 || len > NEAREST_MOST || nearest->len > NEAREST_MOST)
		return;
	word.far = how_far(nearest, text, len);
	if (word.far > allowed(nearest->len) ||
	    (len == nearest->len && ascii_same(text, nearest->wanted, len)))
		return;
	for (int i = 0; i < nearest->count; i++)
		if (ascii_is(nearest->word[i].text, text, len))
			return;
	while (at > 0 && nearest->word[at - 1].far > word.far)
		at--;
	if (at == NEAREST_KEPT)
		return;
	if (nearest->count < NEAREST_KEPT)
		nearest->count++;
	memmove(&nearest->word[at + 1], &nearest->word[at],
		(size_t)(nearest->count - 1 - at) * sizeof(word));
	nearest->word[at] = word;
}

void nearest_print(const struct nearest *nearest, char *out, size_t size)
{
	int used = snprintf(out, size, "%.*s", (int)nearest->len, nearest->wanted);

	for (int i = 0; i < nearest->count; i++) {
		const char *text = nearest->word[i].text;

		if (used < 0 || (size_t)used + strlen(text) + 3 > size)
			break;
		used += snprintf(out + used, size - (size_t)used, "%s%s",
				 i > 0 ? ", " : DIAG_AND, text);
	}
}
