/* SPDX-License-Identifier: MIT
 *
 * send - finds the blocks of the board in the new program with a window that moves byte by
 * byte, and packs copies and bytes into frames.
 */
#include "online/send.h"

#include "engine/base/digest.h"
#include "online/sums.h"

#include <stdlib.h>
#include <string.h>

#define EMPTY UINT32_MAX

/* What the board has: block i begins at i * size. */
struct blocks {
	uint32_t size, count, room;
	uint32_t *weak;
	uint8_t (*strong)[SUMS_STRONG];
	uint32_t *first, mask; /* the first block in each slot of a hash table   */
	uint32_t *next;        /* of the same slot                             */
};

/* A run of the new program: it is at @from of the old one, or EMPTY. */
struct run {
	uint32_t from, len;
};

struct runs {
	struct run *run;
	uint32_t count, room;
	bool failed;
};

/* ---- sums of the board ---- */

/* About as many bytes of sums as one changed block costs. */
static uint32_t block_size(uint32_t size)
{
	uint32_t block = 256;

	while (block < 4096 && block * block < size * 3)
		block *= 2;
	return block;
}

static void blocks_free(struct blocks *blocks)
{
	free(blocks->weak);
	free(blocks->strong);
	free(blocks->first);
	free(blocks->next);
}

static bool blocks_room(struct blocks *blocks, uint32_t more)
{
	const uint32_t room = blocks->count + more;
	uint32_t *weak = realloc(blocks->weak, room * sizeof(*weak));
	void *strong;

	if (!weak)
		return false;
	blocks->weak = weak;
	strong = realloc(blocks->strong, room * (size_t)SUMS_STRONG);
	if (!strong)
		return false;
	blocks->strong = strong;
	return true;
}

static enum desk_end ask_page(struct desk *desk, struct blocks *blocks, uint32_t *all)
{
	struct wire_writer out = desk_ask(desk, SERVICE_SUMS);
	struct wire_reader in;
	enum desk_end end;
	uint32_t size, count;

	wire_put_u32(&out, blocks->count);
	wire_put_u16(&out, (uint16_t)blocks->size);
	end = desk_call(desk, &out, &in);
	if (end != DESK_GOOD)
		return end;
	size = wire_u32(&in);
	count = (uint32_t)(wire_left(&in) / SUMS_BYTES);
	*all = size / blocks->size;
	if (in.failed || size > STORED_MOST || count > *all - blocks->count ||
	    (!count && blocks->count < *all))
		return DESK_NONSENSE;
	if (count && !blocks_room(blocks, count))
		return DESK_NO_ROOM;
	for (uint32_t i = 0; i < count; i++, blocks->count++) {
		blocks->weak[blocks->count] = wire_u32(&in);
		memcpy(blocks->strong[blocks->count], wire_bytes(&in, SUMS_STRONG), SUMS_STRONG);
	}
	return wire_done(&in) ? DESK_GOOD : DESK_NONSENSE;
}

static uint32_t slot_of(const struct blocks *blocks, uint32_t weak)
{
	return (weak * 2654435761u >> 7) & blocks->mask;
}

/* Blocks in the order of the program within each slot. */
static bool index_blocks(struct blocks *blocks)
{
	uint32_t room = 64;

	while (room < 2 * blocks->count)
		room *= 2;
	blocks->mask = room - 1;
	blocks->first = malloc(room * sizeof(*blocks->first));
	blocks->next = malloc((blocks->count + 1u) * sizeof(*blocks->next));
	if (!blocks->first || !blocks->next)
		return false;
	memset(blocks->first, 0xff, room * sizeof(*blocks->first));
	for (uint32_t i = blocks->count; i-- > 0;) {
		uint32_t *first = &blocks->first[slot_of(blocks, blocks->weak[i])];

		blocks->next[i] = *first;
		*first = i;
	}
	return true;
}

/* A board without this service has no blocks. */
static enum desk_end ask_blocks(struct desk *desk, struct blocks *blocks)
{
	uint32_t all;
	enum desk_end end;

	do
		end = ask_page(desk, blocks, &all);
	while (end == DESK_GOOD && blocks->count < all);
	if (end == DESK_REFUSED)
		blocks->count = 0;
	else if (end != DESK_GOOD)
		return end;
	return index_blocks(blocks) ? DESK_GOOD : DESK_NO_ROOM;
}

/* ---- what the board has of the new program ---- */

static void add_run(struct runs *runs, uint32_t from, uint32_t len)
{
	struct run *last = runs->count ? &runs->run[runs->count - 1] : NULL;

	if (!len || runs->failed)
		return;
	if (last && (from == EMPTY ? last->from == EMPTY :
		     last->from != EMPTY && last->from + last->len == from)) {
		last->len += len;
		return;
	}
	if (runs->count == runs->room) {
		const uint32_t room = 2 * runs->room + 64;
		struct run *grown = realloc(runs->run, room * sizeof(*grown));

		runs->failed = !grown;
		if (!grown)
			return;
		runs->run = grown;
		runs->room = room;
	}
	runs->run[runs->count++] = (struct run){ from, len };
}

/* The block that has these bytes; of several, the one that goes on with the last copy. EMPTY:
 * none. */
static uint32_t find_block(const struct blocks *blocks, uint32_t weak, const uint8_t *bytes,
			   uint32_t wanted)
{
	uint32_t block = blocks->first[slot_of(blocks, weak)], found = EMPTY;
	uint8_t strong[SUMS_STRONG];
	bool summed = false;

	for (; block != EMPTY; block = blocks->next[block]) {
		if (blocks->weak[block] != weak)
			continue;
		if (!summed)
			sums_strong(bytes, blocks->size, strong);
		summed = true;
		if (memcmp(blocks->strong[block], strong, SUMS_STRONG) != 0)
			continue;
		if (found == EMPTY || block == wanted)
			found = block;
		if (block >= wanted)
			break;
	}
	return found;
}

static void find_runs(const struct blocks *blocks, const uint8_t *bytes, uint32_t len,
		      struct runs *runs)
{
	const uint32_t size = blocks->size;
	uint32_t at = 0, sent = 0, wanted = 0, weak = 0;
	bool fresh = true;

	while (blocks->count && at + size <= len) {
		uint32_t block;

		if (fresh)
			weak = sums_weak(bytes + at, size);
		fresh = false;
		block = find_block(blocks, weak, bytes + at, wanted);
		if (block == EMPTY) {
			if (at + size == len)
				break;
			weak = sums_roll(weak, size, bytes[at], bytes[at + size]);
			at++;
			continue;
		}
		add_run(runs, EMPTY, at - sent);
		add_run(runs, block * size, size);
		wanted = block + 1;
		at = sent = at + size;
		fresh = true;
	}
	add_run(runs, EMPTY, len - sent);
}

/* ---- sending ---- */

static enum desk_end begin(struct desk *desk, const struct stored *stored, uint32_t *received)
{
	struct wire_writer out = desk_ask(desk, SERVICE_DOWNLOAD);
	struct digest_sha256 sha;
	struct wire_reader in;
	enum desk_end end;
	uint8_t hash[32];

	digest_sha256_init(&sha);
	digest_sha256_add(&sha, stored->bytes, stored_size(stored));
	digest_sha256_end(&sha, hash);
	for (int i = 0; i < STORED_PARTS; i++)
		wire_put_u32(&out, stored->len[i]);
	wire_put_bytes(&out, hash, sizeof(hash));
	end = desk_call(desk, &out, &in);
	*received = end == DESK_GOOD ? wire_u32(&in) : 0;
	return end == DESK_GOOD && in.failed ? DESK_NONSENSE : end;
}

/* Sends a frame and learns how much the board has then. */
static enum desk_end finish(struct desk *desk, struct wire_writer *out, uint32_t size,
			    uint32_t *received, struct sent *sent)
{
	struct wire_reader in;
	const enum desk_end end = desk_call(desk, out, &in);
	uint32_t now;

	if (end != DESK_GOOD)
		return end;
	now = wire_u32(&in);
	if (in.failed || now <= *received || now > size)
		return DESK_NONSENSE;
	*received = now;
	if (sent->go_on && !sent->go_on(sent->context, now))
		*received = size;
	return DESK_GOOD;
}

static enum desk_end send_blocks(struct desk *desk, const struct stored *stored,
				 uint32_t received, struct sent *sent)
{
	const uint32_t size = stored_size(stored);
	enum desk_end end = DESK_GOOD;

	while (received < size && end == DESK_GOOD) {
		struct wire_writer out = desk_ask(desk, SERVICE_BLOCK);
		const uint32_t len = size - received < STORED_BLOCK ? size - received :
								      STORED_BLOCK;

		wire_put_u32(&out, received);
		wire_put_bytes(&out, stored->bytes + received, len);
		sent->bytes += len;
		end = finish(desk, &out, size, &received, sent);
	}
	return end;
}

/* The part of a run from @at of the new program on; the run begins at @begin. Returns the bytes
 * that are in the frame now; 0: it is full. */
static uint32_t put_piece(struct wire_writer *out, const struct stored *stored,
			  const struct run *run, uint32_t begin, uint32_t at, struct sent *sent)
{
	const uint32_t used = (uint32_t)wire_len(out), left = begin + run->len - at;
	const uint32_t room = STORED_BLOCK > used + 16 ? STORED_BLOCK - used - 16 : 0;
	const uint32_t len = run->from != EMPTY || left < room ? left : room;

	if (!room)
		return 0;
	wire_put_u8(out, run->from == EMPTY ? PIECE_BYTES : PIECE_COPY);
	if (run->from == EMPTY) {
		wire_put_u16(out, (uint16_t)len);
		wire_put_bytes(out, stored->bytes + at, len);
		sent->bytes += len;
	} else {
		wire_put_u32(out, run->from + (at - begin));
		wire_put_u32(out, len);
		sent->copied += len;
	}
	return len;
}

static enum desk_end send_pieces(struct desk *desk, const struct stored *stored,
				 const struct runs *runs, uint32_t received, struct sent *sent)
{
	const uint32_t size = stored_size(stored);
	enum desk_end end = DESK_GOOD;

	while (received < size && end == DESK_GOOD) {
		struct wire_writer out = desk_ask(desk, SERVICE_PIECES);
		uint32_t begin = 0, at = received;

		wire_put_u32(&out, received);
		for (uint32_t i = 0; i < runs->count; begin += runs->run[i++].len) {
			const struct run *run = &runs->run[i];

			if (begin + run->len <= at)
				continue;
			const uint32_t len = put_piece(&out, stored, run, begin, at, sent);

			at += len;
			if (at < begin + run->len)
				break;
		}
		end = finish(desk, &out, size, &received, sent);
	}
	return end;
}

enum desk_end send_program(struct desk *desk, const struct stored *stored, bool all,
			   struct sent *sent)
{
	const uint32_t size = stored_size(stored);
	struct blocks blocks = { .size = block_size(size) };
	struct runs runs = { .run = NULL };
	uint32_t received;
	enum desk_end end = begin(desk, stored, &received);

	sent->bytes = sent->copied = 0;
	if (end != DESK_GOOD || received >= size)
		return end;
	if (!all)
		end = ask_blocks(desk, &blocks);
	if (end == DESK_GOOD && blocks.count)
		find_runs(&blocks, stored->bytes, size, &runs);
	if (end == DESK_GOOD && runs.failed)
		end = DESK_NO_ROOM;
	if (end == DESK_GOOD)
		end = blocks.count ? send_pieces(desk, stored, &runs, received, sent) :
				     send_blocks(desk, stored, received, sent);
	free(runs.run);
	blocks_free(&blocks);
	return end;
}
