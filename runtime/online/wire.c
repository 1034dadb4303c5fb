/* SPDX-License-Identifier: MIT
 *
 * wire - fields and frames. Every read goes through take(), every write through room().
 */
#include "online/wire.h"

#include <string.h>

struct wire_reader wire_read(const void *bytes, size_t len)
{
	const uint8_t *at = bytes;

	return (struct wire_reader){ .at = at, .end = at + len };
}

/* The only place where the position of a reader moves. */
static const uint8_t *take(struct wire_reader *in, size_t len)
{
	const uint8_t *at = in->at;

	if (in->failed || len > (size_t)(in->end - at)) {
		in->failed = true;
		return NULL;
	}
	in->at += len;
	return at;
}

static uint64_t number(struct wire_reader *in, size_t len)
{
	const uint8_t *at = take(in, len);
	uint64_t value = 0;

	for (size_t i = 0; at && i < len; i++)
		value |= (uint64_t)at[i] << 8 * i;
	return value;
}

uint8_t wire_u8(struct wire_reader *in)
{
	return (uint8_t)number(in, 1);
}

uint16_t wire_u16(struct wire_reader *in)
{
	return (uint16_t)number(in, 2);
}

uint32_t wire_u32(struct wire_reader *in)
{
	return (uint32_t)number(in, 4);
}

uint64_t wire_u64(struct wire_reader *in)
{
	return number(in, 8);
}

int64_t wire_i64(struct wire_reader *in)
{
	return (int64_t)number(in, 8);
}

const uint8_t *wire_bytes(struct wire_reader *in, size_t len)
{
	return take(in, len);
}

const char *wire_text(struct wire_reader *in, size_t *len)
{
	const uint16_t count = wire_u16(in);
	const uint8_t *at;

	if (count > WIRE_TEXT_MOST)
		in->failed = true;
	at = take(in, count);
	*len = at ? count : 0;
	return at ? (const char *)at : "";
}

void wire_copy_text(struct wire_reader *in, char *out, size_t size)
{
	size_t len;
	const char *text = wire_text(in, &len);

	if (len >= size)
		for (len = size - 1; len > 0 && ((unsigned char)text[len] & 0xc0) == 0x80;)
			len--;
	memcpy(out, text, len);
	out[len] = '\0';
}

size_t wire_left(const struct wire_reader *in)
{
	return in->failed ? 0 : (size_t)(in->end - in->at);
}

bool wire_done(const struct wire_reader *in)
{
	return !in->failed && in->at == in->end;
}

struct wire_writer wire_write(void *bytes, size_t size)
{
	uint8_t *at = bytes;

	return (struct wire_writer){ .start = at, .at = at, .end = at + size };
}

/* The only place where the position of a writer moves. */
static uint8_t *room(struct wire_writer *out, size_t len)
{
	uint8_t *at = out->at;

	if (out->failed || len > (size_t)(out->end - at)) {
		out->failed = true;
		return NULL;
	}
	out->at += len;
	return at;
}

static void put(struct wire_writer *out, uint64_t value, size_t len)
{
	uint8_t *at = room(out, len);

	for (size_t i = 0; at && i < len; i++)
		at[i] = (uint8_t)(value >> 8 * i);
}

void wire_put_u8(struct wire_writer *out, uint8_t value)
{
	put(out, value, 1);
}

void wire_put_u16(struct wire_writer *out, uint16_t value)
{
	put(out, value, 2);
}

void wire_put_u32(struct wire_writer *out, uint32_t value)
{
	put(out, value, 4);
}

void wire_put_u64(struct wire_writer *out, uint64_t value)
{
	put(out, value, 8);
}

void wire_put_i64(struct wire_writer *out, int64_t value)
{
	put(out, (uint64_t)value, 8);
}

void wire_put_bytes(struct wire_writer *out, const void *bytes, size_t len)
{
	uint8_t *at = room(out, len);

	if (at && len)
		memcpy(at, bytes, len);
}

/* Whole characters of UTF-8. */
static size_t cut(const char *text, size_t len, size_t most)
{
	if (len > most)
		for (len = most; len && ((unsigned char)text[len] & 0xc0) == 0x80; len--)
			;
	return len;
}

void wire_cut(char *out, size_t size, const char *text, size_t len)
{
	len = cut(text, len, size - 1);
	memcpy(out, text, len);
	out[len] = '\0';
}

void wire_put_text(struct wire_writer *out, const char *text, size_t len)
{
	len = cut(text, len, WIRE_TEXT_MOST);
	wire_put_u16(out, (uint16_t)len);
	wire_put_bytes(out, text, len);
}

void wire_put_string(struct wire_writer *out, const char *text)
{
	wire_put_text(out, text, strlen(text));
}

size_t wire_len(const struct wire_writer *out)
{
	return (size_t)(out->at - out->start);
}

/* The length on the wire counts what follows it. */
enum frame_state frame_next(const uint8_t *bytes, size_t len, struct frame *out, size_t *used)
{
	struct wire_reader in = wire_read(bytes, len);
	uint32_t length = wire_u32(&in);

	if (in.failed)
		return FRAME_PART;
	if (length < WIRE_HEAD - 4 || length > WIRE_FRAME_MOST - 4)
		return FRAME_BAD;
	if (length > wire_left(&in))
		return FRAME_PART;
	in.end = in.at + length;
	out->service = wire_u8(&in);
	out->flags = wire_u8(&in);
	out->request = wire_u16(&in);
	out->body = in;
	*used = length + 4;
	return FRAME_GOOD;
}

void frame_begin(struct wire_writer *out, uint8_t service, uint8_t flags, uint16_t request)
{
	wire_put_u32(out, 0);
	wire_put_u8(out, service);
	wire_put_u8(out, flags);
	wire_put_u16(out, request);
}

size_t frame_end(struct wire_writer *out)
{
	const size_t len = wire_len(out);
	struct wire_writer head = wire_write(out->start, 4);

	if (out->failed || len > WIRE_FRAME_MOST)
		return 0;
	wire_put_u32(&head, (uint32_t)len - 4);
	return len;
}
