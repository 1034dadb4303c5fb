/* SPDX-License-Identifier: MIT
 *
 * datagram - u32 magic | u8 version | u8 flags | u16 values | u64 run | u32 sequence | u32 age | board | values |
 * u32 CRC-32C of all before. A name is u8 its length and so many bytes.
 */
#include "peer/datagram.h"

#include "engine/base/digest.h"
#include "online/service.h"

#include <string.h>

#define CRC_BYTES 4u

static const char *take_name(struct wire_reader *in, uint8_t *len)
{
	const char *name;

	*len = wire_u8(in);
	name = (const char *)wire_bytes(in, *len);
	if (!*len)
		in->failed = true;
	return name;
}

bool peer_next(struct wire_reader *values, struct peer_value *out)
{
	uint8_t quality, type;

	if (values->failed || !wire_left(values))
		return false;
	out->name = take_name(values, &out->name_len);
	type = wire_u8(values);
	quality = wire_u8(values);
	if (type <= IEC_NONE || type >= IEC_TYPE_COUNT || type == IEC_STRING || quality > 1)
		values->failed = true;
	if (values->failed)
		return false;
	out->type = (enum iec_type)type;
	out->good = quality == 1;
	out->value = wire_value(values, out->type, NULL);
	return !values->failed;
}

static bool has_sum(const uint8_t *bytes, size_t len)
{
	struct wire_reader sum;

	if (len > PEER_BYTES || len < CRC_BYTES)
		return false;
	sum = wire_read(bytes + len - CRC_BYTES, CRC_BYTES);
	return wire_u32(&sum) == digest_crc32c(0, bytes, len - CRC_BYTES);
}

bool peer_read(const uint8_t *bytes, size_t len, struct peer_head *out, struct wire_reader *values)
{
	struct wire_reader in = wire_read(bytes, len < CRC_BYTES ? 0 : len - CRC_BYTES);
	const uint32_t magic = wire_u32(&in);
	const uint8_t version = wire_u8(&in);
	struct peer_value value;
	uint16_t found = 0;

	memset(out, 0, sizeof(*out));
	out->flags = wire_u8(&in);
	out->count = wire_u16(&in);
	out->run = wire_u64(&in);
	out->sequence = wire_u32(&in);
	out->age_ms = wire_u32(&in);
	out->board = take_name(&in, &out->board_len);
	if (in.failed || magic != PEER_MAGIC || version != PEER_VERSION || out->board_len > PEER_BOARD ||
	    !has_sum(bytes, len))
		return false;
	*values = in;
	while (peer_next(&in, &value))
		found++;
	return wire_done(&in) && found == out->count;
}

static void put_name(struct wire_writer *out, const char *name, uint8_t len)
{
	wire_put_u8(out, len);
	wire_put_bytes(out, name, len);
}

void peer_begin(struct peer_writer *writer, const struct peer_head *head)
{
	struct wire_writer *out = &writer->out;

	*out = wire_write(writer->bytes, sizeof(writer->bytes) - CRC_BYTES);
	wire_put_u32(out, PEER_MAGIC);
	wire_put_u8(out, PEER_VERSION);
	wire_put_u8(out, head->flags);
	writer->count_at = out->at;
	writer->count = 0;
	wire_put_u16(out, 0);
	wire_put_u64(out, head->run);
	wire_put_u32(out, head->sequence);
	wire_put_u32(out, head->age_ms);
	put_name(out, head->board, head->board_len);
}

bool peer_add(struct peer_writer *writer, const struct peer_value *value)
{
	const struct wire_writer before = writer->out;
	struct wire_writer *out = &writer->out;

	put_name(out, value->name, value->name_len);
	wire_put_u8(out, (uint8_t)value->type);
	wire_put_u8(out, value->good);
	wire_put_value(out, value->type, value->value);
	if (out->failed) {
		*out = before;
		return false;
	}
	writer->count++;
	return true;
}

size_t peer_end(struct peer_writer *writer)
{
	const size_t len = wire_len(&writer->out);

	writer->count_at[0] = (uint8_t)writer->count;
	writer->count_at[1] = (uint8_t)(writer->count >> 8);
	writer->out.end += CRC_BYTES;
	wire_put_u32(&writer->out, digest_crc32c(0, writer->bytes, len));
	return len + CRC_BYTES;
}

/* ---- types ---- */

static bool is_whole(enum iec_type type)
{
	return iec_type_row(type)->class & (ANY_INT | ANY_BIT);
}

/* The bits of a number of @size bytes, or the number that its bits are. */
static int64_t same_bits(int64_t bits, enum iec_type to)
{
	uint8_t bytes[8];

	iec_store(bytes, to, (union iec_value){ .i = bits });
	return iec_load(bytes, to).i;
}

static bool holds(enum iec_type from, int64_t value, enum iec_type to)
{
	const struct iec_type_row *row = iec_type_row(to);

	if (iec_is_wide(from) && value < 0)
		return iec_is_wide(to); /* 2^63 and more */
	return iec_is_wide(to) ? value >= 0 : value >= row->low && value <= row->high;
}

bool peer_convert(enum iec_type from, union iec_value value, enum iec_type to, union iec_value *out)
{
	const struct iec_type_row *a = iec_type_row(from), *b = iec_type_row(to);
	const bool bits = (a->class | b->class) & CLASS_BITS;

	*out = value;
	if (from == to || (a->class & b->class & CLASS_REAL))
		return true;
	if (!is_whole(from) || !is_whole(to))
		return false;
	if (bits && a->size == b->size && from != IEC_BOOL && to != IEC_BOOL)
		out->i = same_bits(value.i, to);
	else if (!holds(from, value.i, to))
		return false;
	return true;
}
