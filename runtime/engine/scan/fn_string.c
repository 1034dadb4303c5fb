/* SPDX-License-Identifier: MIT
 *
 * fn_string - texts cut, joined and searched, IEC 61131-3 table 29.
 *
 * A character is a byte; the first has position 1. A position that a text does not have
 * and a negative length are errors: nothing is stored. A length beyond the end is cut
 * there. A result of more than IEC_STRING_MOST bytes is cut and marked. All of them
 * write into args->room, so that a result may go where an input came from.
 */
#include "engine/scan/vm.h"

#include <string.h>

/* Bytes of a text; borrowed. */
struct piece {
	const char *at;
	uint32_t len;
};

static struct piece whole(const struct iec_string *s)
{
	return (struct piece){ s->text, s->length };
}

/* The rest behind the first @count bytes, which exist. */
static struct piece behind(const struct iec_string *s, uint32_t count)
{
	return (struct piece){ s->text + count, s->length - count };
}

static struct piece before(const struct iec_string *s, uint32_t count)
{
	return (struct piece){ s->text, count };
}

/* Adds @piece to the result; false: cut. */
static bool add(struct fn_args *args, struct piece piece)
{
	struct iec_string *room = args->room;
	uint32_t left = IEC_STRING_MOST - room->length;
	uint32_t len = piece.len < left ? piece.len : left;

	memcpy(room->text + room->length, piece.at, len);
	room->length = (uint16_t)(room->length + len);
	return len == piece.len;
}

static enum fn_status give(struct fn_args *args, const struct piece *piece, int count)
{
	bool fits = true;

	args->room->length = 0;
	for (int i = 0; i < count; i++)
		fits = add(args, piece[i]) && fits;
	args->out.s = args->room;
	return fits ? FN_OK : FN_WRAPPED;
}

static enum fn_status give_one(struct fn_args *args, struct piece piece)
{
	return give(args, &piece, 1);
}

/* A number of bytes from a pin of any integer type, at most @most. False: negative. */
static bool take_length(const struct fn_args *args, int pin, uint32_t most, uint32_t *out)
{
	int64_t length = args->in[pin].i;
	bool wide = iec_is_wide(args->in_type[pin]);

	if (length < 0 && !wide)
		return false;
	*out = length < 0 || length > (int64_t)most ? most : (uint32_t)length;
	return true;
}

/* A position of @least to @most; false: there is no such position. */
static bool take_position(const struct fn_args *args, int pin, uint32_t least,
			  uint32_t most, uint32_t *out)
{
	int64_t position = args->in[pin].i;

	if (position < (int64_t)least || position > (int64_t)most)
		return false;
	*out = (uint32_t)position;
	return true;
}

/* L bytes from position P on, as in MID, DELETE and REPLACE. */
struct span {
	uint32_t start, len;
};

static bool take_span(const struct fn_args *args, int length, struct span *out)
{
	const struct iec_string *in = args->in[0].s;

	if (!take_position(args, length + 1, 1, in->length, &out->start))
		return false;
	out->start--;
	return take_length(args, length, in->length - out->start, &out->len);
}

enum fn_status fn_LEN(struct fn_args *args)
{
	args->out.i = args->in[0].s->length;
	return FN_OK;
}

enum fn_status fn_LEFT(struct fn_args *args)
{
	const struct iec_string *in = args->in[0].s;
	uint32_t len;

	if (!take_length(args, 1, in->length, &len))
		return FN_FAILED;
	return give_one(args, before(in, len));
}

enum fn_status fn_RIGHT(struct fn_args *args)
{
	const struct iec_string *in = args->in[0].s;
	uint32_t len;

	if (!take_length(args, 1, in->length, &len))
		return FN_FAILED;
	return give_one(args, behind(in, in->length - len));
}

enum fn_status fn_MID(struct fn_args *args)
{
	struct span span;

	if (!take_span(args, 1, &span))
		return FN_FAILED;
	return give_one(args, (struct piece){ args->in[0].s->text + span.start,
					      span.len });
}

enum fn_status fn_CONCAT(struct fn_args *args)
{
	struct piece piece[LIMIT_FN_ARGS];

	for (uint32_t i = 0; i < args->count; i++)
		piece[i] = whole(args->in[i].s);
	return give(args, piece, (int)args->count);
}

enum fn_status fn_INSERT(struct fn_args *args)
{
	const struct iec_string *in = args->in[0].s;
	uint32_t at;

	if (!take_position(args, 2, 0, in->length, &at))
		return FN_FAILED;
	return give(args, (struct piece[]){ before(in, at), whole(args->in[1].s),
					    behind(in, at) }, 3);
}

enum fn_status fn_DELETE(struct fn_args *args)
{
	const struct iec_string *in = args->in[0].s;
	struct span span;

	if (!take_span(args, 1, &span))
		return FN_FAILED;
	return give(args, (struct piece[]){ before(in, span.start),
					    behind(in, span.start + span.len) }, 2);
}

enum fn_status fn_REPLACE(struct fn_args *args)
{
	const struct iec_string *in = args->in[0].s;
	struct span span;

	if (!take_span(args, 2, &span))
		return FN_FAILED;
	return give(args, (struct piece[]){ before(in, span.start),
					    whole(args->in[1].s),
					    behind(in, span.start + span.len) }, 3);
}

/* At most 255 places with a comparison of at most 255 bytes each. */
enum fn_status fn_FIND(struct fn_args *args)
{
	const struct iec_string *in = args->in[0].s, *what = args->in[1].s;

	args->out.i = 0;
	if (what->length == 0)
		return FN_OK;
	for (int i = 0; i + what->length <= in->length; i++)
		if (memcmp(in->text + i, what->text, what->length) == 0) {
			args->out.i = i + 1;
			break;
		}
	return FN_OK;
}

/* ---- letters and their numbers: UTF-8; a byte that is none of it is a letter, too ---- */

/* Bytes of the first letter. */
static uint32_t letter_length(const struct iec_string *s)
{
	const uint8_t first = (uint8_t)s->text[0];
	const uint32_t len = first < 0xc0 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;

	return s->length < len ? s->length : len;
}

/* @number as UTF-8 in the room; @high are the marks of the first byte. */
static void put_letter(struct fn_args *args, uint32_t number, uint32_t len, uint32_t high)
{
	args->room->length = (uint16_t)len;
	for (uint32_t i = len - 1; i > 0; i--, number >>= 6)
		args->room->text[i] = (char)(0x80 | (number & 0x3f));
	args->room->text[0] = (char)(high | number);
	args->out.s = args->room;
}

enum fn_status fn_LETTER_OF(struct fn_args *args)
{
	const uint64_t number = (uint64_t)args->in[0].i;

	if (args->type == IEC_STRING)
		return give_one(args, before(args->in[0].s, letter_length(args->in[0].s)));
	if (number > 0x10ffff || (number >= 0xd800 && number < 0xe000))
		return FN_FAILED;
	if (number == 0)
		return give_one(args, (struct piece){ "", 0 });
	if (number < 0x80)
		put_letter(args, (uint32_t)number, 1, 0);
	else if (number < 0x800)
		put_letter(args, (uint32_t)number, 2, 0xc0);
	else if (number < 0x10000)
		put_letter(args, (uint32_t)number, 3, 0xe0);
	else
		put_letter(args, (uint32_t)number, 4, 0xf0);
	return FN_OK;
}

enum fn_status fn_LETTER_NUMBER(struct fn_args *args)
{
	const struct iec_string *s = args->in[0].s;
	const uint32_t len = s->length ? letter_length(s) : 0;
	uint32_t number = len ? (uint8_t)s->text[0] : 0;

	if (len > 1)
		number &= 0x7fu >> len;
	for (uint32_t i = 1; i < len; i++)
		number = number << 6 | ((uint8_t)s->text[i] & 0x3f);
	args->out.i = number;
	return (uint64_t)number >> (8 * iec_type_row(args->result)->size - 1) > 1 ? FN_FAILED : FN_OK;
}
