/* SPDX-License-Identifier: MIT
 *
 * stored - the bytes of a slot: "RUNGSLOT", format, sequence number, the hash beside it, the
 * lengths of the parts, a spare word, the parts, CRC-32C of all before.
 */
#include "online/stored.h"

#include "engine/base/digest.h"

#include <string.h>

#define MAGIC  "RUNGSLOT"
#define FORMAT 1u

uint32_t stored_size(const struct stored *stored)
{
	uint64_t size = 0;

	for (int i = 0; i < STORED_PARTS; i++)
		size += stored->len[i];
	return size <= STORED_MOST ? (uint32_t)size : 0;
}

const uint8_t *stored_part(const struct stored *stored, enum stored_part part)
{
	const uint8_t *at = stored->bytes;

	for (int i = 0; i < (int)part; i++)
		at += stored->len[i];
	return at;
}

uint16_t stored_sources(const struct stored *stored, struct wire_reader *in)
{
	*in = wire_read(stored_part(stored, STORED_SOURCES), stored->len[STORED_SOURCES]);
	return stored->len[STORED_SOURCES] ? wire_u16(in) : 0;
}

bool stored_take_source(struct wire_reader *in, struct stored_source *out)
{
	out->name = wire_text(in, &out->name_len);
	out->len = wire_u32(in);
	out->bytes = wire_bytes(in, out->len);
	return !in->failed && out->bytes;
}

void slot_seal(const struct stored *stored, uint32_t seq, const uint8_t beside[32], uint8_t *out)
{
	const uint32_t size = stored_size(stored);
	struct wire_writer head = wire_write(out, SLOT_HEAD);
	struct wire_writer tail = wire_write(out + SLOT_HEAD + size, 4);

	memset(out, 0, SLOT_HEAD);
	wire_put_bytes(&head, MAGIC, 8);
	wire_put_u32(&head, FORMAT);
	wire_put_u32(&head, seq);
	wire_put_bytes(&head, beside, 32);
	for (int i = 0; i < STORED_PARTS; i++)
		wire_put_u32(&head, stored->len[i]);
	memmove(out + SLOT_HEAD, stored->bytes, size);
	wire_put_u32(&tail, digest_crc32c(0, out, SLOT_HEAD + size));
}

bool slot_open(const uint8_t *bytes, size_t len, struct slot *out)
{
	struct wire_reader in = wire_read(bytes, len), tail;
	const uint8_t *magic = wire_bytes(&in, 8), *beside;
	const uint32_t format = wire_u32(&in);
	uint32_t size;

	memset(out, 0, sizeof(*out));
	out->seq = wire_u32(&in);
	beside = wire_bytes(&in, 32);
	for (int i = 0; i < STORED_PARTS; i++)
		out->stored.len[i] = wire_u32(&in);
	if (in.failed || memcmp(magic, MAGIC, 8) != 0 || format != FORMAT)
		return false;
	memcpy(out->beside, beside, 32);
	size = stored_size(&out->stored);
	if (!size || len != (size_t)SLOT_HEAD + size + 4)
		return false;
	out->stored.bytes = bytes + SLOT_HEAD;
	tail = wire_read(bytes + SLOT_HEAD + size, 4);
	return wire_u32(&tail) == digest_crc32c(0, bytes, SLOT_HEAD + size);
}
