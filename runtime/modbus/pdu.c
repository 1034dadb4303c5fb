/* SPDX-License-Identifier: MIT
 *
 * pdu - bytes of requests and answers, by the specification of the application protocol (V1.1b3).
 */
#include "modbus/pdu.h"

#include <string.h>

static void put_word(struct pdu *out, uint16_t word)
{
	out->byte[out->len++] = (uint8_t)(word >> 8);
	out->byte[out->len++] = (uint8_t)word;
}

static void begin(struct pdu *out, enum pdu_function function, uint16_t first)
{
	out->len = 0;
	memset(out->byte, 0, 8); /* what struct unit_owed keeps is never left over */
	out->byte[out->len++] = (uint8_t)function;
	put_word(out, first);
}

void pdu_read(struct pdu *out, enum io_table table, uint16_t first, int count)
{
	static const enum pdu_function of[] = {
		[TABLE_COIL] = PDU_COILS, [TABLE_DISCRETE_INPUT] = PDU_DISCRETE_INPUTS,
		[TABLE_INPUT_REGISTER] = PDU_INPUT_REGISTERS,
		[TABLE_HOLDING_REGISTER] = PDU_HOLDING_REGISTERS,
	};

	begin(out, of[table], first);
	put_word(out, (uint16_t)count);
}

void pdu_set_bits(struct pdu *out, uint16_t first, const bool *bit, int count, bool many)
{
	const int bytes = (count + 7) / 8;

	many = many || count > 1;
	begin(out, many ? PDU_SET_COILS : PDU_SET_COIL, first);
	if (!many) {
		put_word(out, bit[0] ? 0xff00 : 0);
		return;
	}
	put_word(out, (uint16_t)count);
	out->byte[out->len++] = (uint8_t)bytes;
	memset(out->byte + out->len, 0, (size_t)bytes);
	for (int i = 0; i < count; i++)
		if (bit[i])
			out->byte[out->len + i / 8] |= (uint8_t)(1 << i % 8);
	out->len += bytes;
}

void pdu_set_words(struct pdu *out, uint16_t first, const uint16_t *word, int count, bool many)
{
	many = many || count > 1;
	begin(out, many ? PDU_SET_REGISTERS : PDU_SET_REGISTER, first);
	if (many) {
		put_word(out, (uint16_t)count);
		out->byte[out->len++] = (uint8_t)(2 * count);
	}
	for (int i = 0; i < count; i++)
		put_word(out, word[i]);
}

void pdu_both(struct pdu *out, uint16_t first, int count, uint16_t to, const uint16_t *word, int words)
{
	begin(out, PDU_BOTH, first);
	put_word(out, (uint16_t)count);
	put_word(out, to);
	put_word(out, (uint16_t)words);
	out->byte[out->len++] = (uint8_t)(2 * words);
	for (int i = 0; i < words; i++)
		put_word(out, word[i]);
}

void pdu_mask(struct pdu *out, uint16_t reg, uint16_t mask, uint16_t bits)
{
	begin(out, PDU_MASK, reg);
	put_word(out, (uint16_t)~mask);
	put_word(out, bits & mask);
}

/* Bytes of values in the answer to a read; 0: no read. */
static int read_bytes(const struct pdu *request)
{
	const int count = pdu_word(request->byte + 3);

	switch (request->byte[0]) {
	case PDU_COILS:
	case PDU_DISCRETE_INPUTS:
		return (count + 7) / 8;
	case PDU_HOLDING_REGISTERS:
	case PDU_INPUT_REGISTERS:
	case PDU_BOTH:
		return 2 * count;
	default:
		return 0;
	}
}

enum pdu_fit pdu_check(const struct pdu *request, const struct pdu *answer, int *exception)
{
	const int bytes = read_bytes(request);

	*exception = 0;
	if (answer->len == 2 && answer->byte[0] == (request->byte[0] | 0x80)) {
		*exception = answer->byte[1];
		return PDU_EXCEPTION;
	}
	if (answer->len < 2 || answer->byte[0] != request->byte[0])
		return PDU_WRONG;
	if (bytes)
		return answer->byte[1] == bytes && answer->len == bytes + 2 ? PDU_FITS : PDU_WRONG;
	/* A write is repeated: one coil or register and a mask whole, several without their values. */
	if (answer->len != (request->byte[0] == PDU_MASK ? 7 : 5))
		return PDU_WRONG;
	return memcmp(request->byte, answer->byte, (size_t)answer->len) == 0 ? PDU_FITS : PDU_WRONG;
}

bool pdu_bit(const struct pdu *answer, int i)
{
	return answer->byte[2 + i / 8] >> i % 8 & 1;
}

uint16_t pdu_at(const struct pdu *answer, int i)
{
	return pdu_word(answer->byte + 2 + 2 * i);
}

int pdu_words_of(enum iec_type type)
{
	const struct iec_type_row *row = iec_type_row(type);

	if (type == IEC_BOOL || !(row->class & (ANY_NUM | CLASS_BITS)))
		return 0;
	return row->size <= 2 ? 1 : row->size / 2;
}

static uint16_t ordered(const struct io_channel *channel, uint16_t word)
{
	return channel->byte_swapped ? (uint16_t)(word << 8 | word >> 8) : word;
}

union iec_value pdu_value(const struct io_channel *channel, const uint16_t *word)
{
	const struct iec_type_row *row = iec_type_row(channel->raw);
	const int words = pdu_words_of(channel->raw);
	union iec_value value = { .i = 0 };
	uint64_t bits = 0;

	for (int i = 0; i < words; i++)
		bits = bits << 16 | ordered(channel, word[channel->word_swapped ? words - 1 - i : i]);
	if (channel->raw == IEC_REAL) {
		const uint32_t low = (uint32_t)bits;
		float real;

		memcpy(&real, &low, sizeof(real));
		value.r = (double)real;
	} else if (channel->raw == IEC_LREAL) {
		memcpy(&value.r, &bits, sizeof(value.r));
	} else {
		const int above = 64 - 8 * row->size;

		value.i = row->class & CLASS_SIGNED ? (int64_t)(bits << above) >> above :
						      (int64_t)(bits << above >> above);
	}
	return value;
}

void pdu_words(const struct io_channel *channel, union iec_value value, uint16_t *word)
{
	const int words = pdu_words_of(channel->raw);
	uint64_t bits = (uint64_t)value.i;

	if (channel->raw == IEC_REAL) {
		const float real = (float)value.r;
		uint32_t low;

		memcpy(&low, &real, sizeof(low));
		bits = low;
	} else if (channel->raw == IEC_LREAL) {
		memcpy(&bits, &value.r, sizeof(bits));
	} else if (iec_type_row(channel->raw)->size == 1 &&
		   !(iec_type_row(channel->raw)->class & CLASS_SIGNED)) {
		bits &= 0xff;
	}
	for (int i = words - 1; i >= 0; i--) {
		word[channel->word_swapped ? words - 1 - i : i] = ordered(channel, (uint16_t)bits);
		bits >>= 16;
	}
}

uint16_t pdu_crc(const uint8_t *byte, int len)
{
	uint16_t crc = 0xffff;

	for (int i = 0; i < len; i++) {
		crc ^= byte[i];
		for (int bit = 0; bit < 8; bit++)
			crc = (uint16_t)(crc & 1 ? crc >> 1 ^ 0xa001 : crc >> 1);
	}
	return crc;
}
