/* SPDX-License-Identifier: MIT
 *
 * text - the walker's own functions of texts: docs/language.md, "Texts".
 *
 * Byte by byte into a new text; results stay short because the pool's texts are.
 */
#include "tests/walker/inside.h"

#include <string.h>

static void append(struct value *out, const struct value *from, int first, int last)
{
	for (int i = first; i < last && out->len < (int)sizeof(out->text); i++)
		out->text[out->len++] = from->text[i];
}

/* A number; perhaps an unsigned one that is very large. */
static bool is_below_0(struct value number)
{
	return number.type != IEC_ULINT && number.i < 0;
}

static bool is_beyond(struct value number, int most)
{
	return !is_below_0(number) && (number.i < 0 || number.i > most);
}

int text_order(struct value a, struct value b)
{
	for (int i = 0; i < a.len && i < b.len; i++)
		if (a.text[i] != b.text[i])
			return (unsigned char)a.text[i] < (unsigned char)b.text[i] ? -1 : 1;
	return a.len < b.len ? -1 : a.len > b.len;
}

static int64_t find(const struct value *in)
{
	for (int at = 0; in[1].len > 0 && at + in[1].len <= in[0].len; at++) {
		int same = 0;

		while (same < in[1].len && in[0].text[at + same] == in[1].text[same])
			same++;
		if (same == in[1].len)
			return at + 1;
	}
	return 0;
}

bool text_is_function(enum word fn)
{
	return fn == FN_LEN || fn == FN_FIND || fn == FN_LEFT || fn == FN_RIGHT ||
	       fn == FN_MID || fn == FN_CONCAT || fn == FN_INSERT ||
	       fn == FN_DELETE || fn == FN_REPLACE;
}

/* MID, DELETE, REPLACE: the bytes from one place to another. */
static enum outcome around(enum word fn, const struct value *in, struct value *out)
{
	int pin = fn == FN_REPLACE ? 2 : 1, first, last;
	struct value length = in[pin], place = in[pin + 1];

	if (is_below_0(length) || is_below_0(place) || place.i == 0 ||
	    is_beyond(place, in[0].len))
		return OUTCOME_FAILED;
	first = (int)place.i - 1;
	last = is_beyond(length, in[0].len - first) ? in[0].len :
						      first + (int)length.i;
	if (fn == FN_MID) {
		append(out, in, first, last);
		return OUTCOME_GOOD;
	}
	append(out, in, 0, first);
	if (fn == FN_REPLACE)
		append(out, &in[1], 0, in[1].len);
	append(out, in, last, in[0].len);
	return OUTCOME_GOOD;
}

enum outcome text_compute(enum word fn, const struct value *in, int count,
			  struct value *out)
{
	*out = (struct value){ .type = IEC_STRING };
	if (fn == FN_LEN || fn == FN_FIND) {
		out->type = IEC_INT;
		out->i = fn == FN_LEN ? in[0].len : find(in);
		return OUTCOME_GOOD;
	}
	if (fn == FN_MID || fn == FN_DELETE || fn == FN_REPLACE)
		return around(fn, in, out);
	if (fn == FN_CONCAT) {
		for (int i = 0; i < count; i++)
			append(out, &in[i], 0, in[i].len);
	} else if (fn == FN_INSERT) {
		if (is_below_0(in[2]) || is_beyond(in[2], in[0].len))
			return OUTCOME_FAILED;
		append(out, in, 0, (int)in[2].i);
		append(out, &in[1], 0, in[1].len);
		append(out, in, (int)in[2].i, in[0].len);
	} else {
		int len = is_beyond(in[1], in[0].len) ? in[0].len : (int)in[1].i;

		if (is_below_0(in[1]))
			return OUTCOME_FAILED;
		append(out, in, fn == FN_LEFT ? 0 : in[0].len - len,
		       fn == FN_LEFT ? len : in[0].len);
	}
	return OUTCOME_GOOD;
}
