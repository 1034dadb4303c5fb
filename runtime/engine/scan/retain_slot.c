/* SPDX-License-Identifier: MIT
 *
 * retain_slot - payloads in slots, two slots in a file. It detects files that were cut,
 * damaged or forged.
 */
#include "engine/scan/retain.h"

#include "engine/base/digest.h"

#include <string.h>

#define SLOT_HEAD ((uint32_t)sizeof(struct retain_slot))
#define SLOT_TAIL 4u /* the checksum */
#define CLOCK_MOST (INT64_MAX / 2)

uint32_t retain_room(uint32_t payload_size)
{
	uint32_t size = SLOT_HEAD + payload_size + SLOT_TAIL;

	return (size + RETAIN_PAGE - 1) / RETAIN_PAGE * RETAIN_PAGE;
}

void retain_fill(struct retain *retain, const uint8_t *copy, int64_t clock_ns)
{
	uint8_t *payload = retain->slot + SLOT_HEAD;

	memcpy(payload, &clock_ns, sizeof(clock_ns));
	for (int i = 0; i < retain->count; i++) {
		const struct retain_var *var = &retain->var[i];

		memcpy(payload + var->value, copy + var->kept, var->size);
	}
}

uint32_t retain_seal(struct retain *retain, uint32_t seq, uint32_t flags,
		     uint32_t slot_size)
{
	struct retain_slot head = {
		.format = RETAIN_FORMAT, .seq = seq, .flags = flags,
		.len = retain->payload_size, .slot_size = slot_size,
	};
	uint32_t covered = SLOT_HEAD + retain->payload_size, crc;

	memcpy(head.magic, RETAIN_MAGIC, sizeof(head.magic));
	memcpy(retain->slot, &head, sizeof(head));
	crc = digest_crc32c(0, retain->slot, covered);
	memcpy(retain->slot + covered, &crc, sizeof(crc));
	return covered + SLOT_TAIL;
}

bool retain_next(const uint8_t *payload, uint32_t len, uint32_t *at,
		 struct retain_record *out)
{
	uint16_t name_len;
	uint32_t room = len - *at;
	const uint8_t *record = payload + *at;

	if (*at > len || room < RETAIN_RECORD)
		return false;
	memcpy(&name_len, record, sizeof(name_len));
	memcpy(&out->size, record + 4, sizeof(out->size));
	out->name_len = name_len;
	out->type_len = record[2];
	room -= RETAIN_RECORD;
	if (room < out->name_len + out->type_len ||
	    room - out->name_len - out->type_len < out->size)
		return false;
	out->name = (const char *)record + RETAIN_RECORD;
	out->type = out->name + out->name_len;
	out->value = (const uint8_t *)out->type + out->type_len;
	*at += RETAIN_RECORD + out->name_len + out->type_len + out->size;
	return true;
}

/* The payload has as many records as its head says, and nothing behind them. */
bool retain_is_well_formed(const uint8_t *payload, uint32_t len)
{
	struct retain_record record;
	uint32_t at = RETAIN_HEAD, count, seen = 0;

	if (len < RETAIN_HEAD)
		return false;
	memcpy(&count, payload + 8, sizeof(count));
	while (retain_next(payload, len, &at, &record))
		seen++;
	return seen == count && at == len;
}

int64_t retain_clock(const uint8_t *payload)
{
	int64_t clock_ns;

	memcpy(&clock_ns, payload, sizeof(clock_ns));
	if (clock_ns < 0)
		return 0;
	return clock_ns < CLOCK_MOST ? clock_ns : CLOCK_MOST;
}

static bool is_zero(const uint8_t *bytes, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if (bytes[i])
			return false;
	return true;
}

static enum retain_state judge(const uint8_t *file, size_t len, size_t at,
			       struct retain_slot *head)
{
	size_t room = at < len ? len - at : 0;
	uint32_t crc;

	memset(head, 0, sizeof(*head));
	if (room < SLOT_HEAD + SLOT_TAIL)
		return RETAIN_BAD;
	if (is_zero(file + at, SLOT_HEAD))
		return RETAIN_EMPTY;
	memcpy(head, file + at, sizeof(*head));
	if (memcmp(head->magic, RETAIN_MAGIC, sizeof(head->magic)) != 0 ||
	    head->format != RETAIN_FORMAT || head->len > LIMIT_RETAIN ||
	    head->len > room - SLOT_HEAD - SLOT_TAIL ||
	    head->slot_size % RETAIN_PAGE || !head->slot_size ||
	    (at && at != head->slot_size) ||
	    retain_room(head->len) > head->slot_size)
		return RETAIN_BAD;
	memcpy(&crc, file + at + SLOT_HEAD + head->len, sizeof(crc));
	if (crc != digest_crc32c(0, file + at, SLOT_HEAD + head->len) ||
	    !retain_is_well_formed(file + at + SLOT_HEAD, head->len))
		return RETAIN_BAD;
	return RETAIN_GOOD;
}

/* Numbers wrap: the newer one is less than half the range ahead. */
static bool is_newer(uint32_t seq, uint32_t than)
{
	return seq != than && seq - than < 0x80000000u;
}

void retain_find(const uint8_t *file, size_t len, struct retain_found *found)
{
	struct retain_slot head[2];
	size_t at[2] = { 0, len / 2 };
	int best;

	memset(found, 0, sizeof(*found));
	found->best = best = -1;
	found->state[0] = judge(file, len, 0, &head[0]);
	if (found->state[0] == RETAIN_GOOD)
		at[1] = head[0].slot_size;
	found->state[1] = at[1] && at[1] % RETAIN_PAGE == 0 ?
		judge(file, len, at[1], &head[1]) : RETAIN_BAD;
	for (int i = 0; i < 2; i++)
		if (found->state[i] == RETAIN_GOOD &&
		    (best < 0 || is_newer(head[i].seq, head[best].seq)))
			best = i;
	if (best < 0)
		return;
	found->best = best;
	found->old_copy = found->state[!best] == RETAIN_BAD ||
		(found->state[!best] == RETAIN_EMPTY &&
		 !(head[best].flags & RETAIN_FIRST));
	found->seq = head[best].seq;
	found->slot_size = head[best].slot_size;
	found->fits = len / 2 == found->slot_size && len % 2 == 0;
	found->payload = file + at[best] + SLOT_HEAD;
	found->len = head[best].len;
}
