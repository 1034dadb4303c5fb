/* SPDX-License-Identifier: MIT
 *
 * still - runs the stretches of a program that something has reached.
 *
 * `seen` holds data memory as it was when it was compared last. Before the program runs, inputs
 * and system words are compared with it; all of memory, if somebody wrote a value or forces are
 * held. After a stretch the blocks that it writes are compared. Each difference makes all
 * stretches pending that touch its block: those behind in this scan, the others, and the one that
 * made it, in the next.
 *
 * Where more than half would run, comparing costs more than it saves: then whole scans run, 1, 2,
 * 4 … up to LONGEST of them, until it is tried again.
 */
#include "engine/scan/still.h"
#include "engine/scan/resource.h"

#include <string.h>

#define LONGEST 128u /* scans until it is tried again                         */
#define CALM 8u      /* scans of few stretches, after which it is tried at once */

/* ---- blocks ---- */

/* Whether @n whole blocks differ. A C library for boards compares byte by byte. */
static inline bool differs(const uint8_t *a, const uint8_t *b, uint32_t n)
{
	uint64_t x[8], y[8], sum[8] = { 0 };

	for (; n; n--, a += STILL_BLOCK, b += STILL_BLOCK) {
		memcpy(x, a, sizeof(x));
		memcpy(y, b, sizeof(y));
		for (int i = 0; i < 8; i++)
			sum[i] |= x[i] ^ y[i];
	}
	return sum[0] | sum[1] | sum[2] | sum[3] | sum[4] | sum[5] | sum[6] | sum[7];
}

/* A bit for each byte that differs. */
static uint64_t bytes_that_differ(const uint8_t *a, const uint8_t *b, uint32_t size)
{
	uint64_t bits = 0;

	for (uint32_t i = 0; i < size; i++) {
		if (i % 8 == 0 && i + 8 <= size && !memcmp(a + i, b + i, 8))
			i += 7;
		else
			bits |= (uint64_t)(a[i] != b[i]) << i;
	}
	return bits;
}

static void make_pending(struct still *still, uint32_t block)
{
	const uint64_t *by = still->touched_by + (size_t)block * still->words;

	for (uint32_t i = 0; i < still->words; i++)
		still->pending[i] |= by[i];
	still->changed[block / 64] |= UINT64_C(1) << block % 64;
	still->any_changed = true;
}

static uint32_t size_of(const struct still *still, uint32_t block)
{
	return still->rest && block == still->blocks - 1 ? still->rest : STILL_BLOCK;
}

/* Compares a block. Returns the bytes that differ, touched or not. */
static inline uint64_t look(struct still *still, const uint8_t *m, uint32_t block)
{
	const uint8_t *now = m + (size_t)block * STILL_BLOCK;
	uint8_t *seen = still->seen + (size_t)block * STILL_BLOCK;
	const uint32_t size = size_of(still, block);
	uint64_t bytes;

	if (size == STILL_BLOCK ? !differs(now, seen, 1) : !memcmp(now, seen, size))
		return 0;
	bytes = bytes_that_differ(now, seen, size);
	memcpy(seen, now, size);
	if (bytes & still->mask[block])
		make_pending(still, block);
	return bytes;
}

/* Also at bits that the program does not use: they have been unpacked. */
static void look_at_all(struct still *still, const uint8_t *m)
{
	for (uint32_t i = 0; i < still->outside_count; i++)
		look(still, m, still->outside[i]);
	for (uint32_t i = 0; i < still->blocks; i++)
		if (still->mask[i])
			look(still, m, i);
}

/* ---- bits of areas ---- */

/* The first entry that ends behind @bit, counted from the first area. */
static uint32_t bits_behind(const struct program *p, uint64_t bit)
{
	uint32_t low = 0, high = p->bits_count;

	while (low < high) {
		const uint32_t middle = low + (high - low) / 2;
		const struct code_bits *bits = &p->bits[middle];

		if ((uint64_t)p->areas.at[bits->area] * 8 + bits->first + bits->count > bit)
			high = middle;
		else
			low = middle + 1;
	}
	return low;
}

/* The same by the bytes of bits. */
static uint32_t slots_behind(const struct program *p, uint32_t offset)
{
	uint32_t low = 0, high = p->bits_count;

	while (low < high) {
		const uint32_t middle = low + (high - low) / 2;

		if (p->bits[middle].slot + p->bits[middle].count > offset)
			high = middle;
		else
			low = middle + 1;
	}
	return low;
}

/* The part of @bits from @from on, up to @to. */
static struct code_bits part_of(const struct code_bits *bits, uint32_t from, uint32_t to)
{
	return (struct code_bits){ bits->area, bits->first + from, to - from, bits->slot + from };
}

/* A block of inputs has changed: so do the bytes of its bits. */
static void unpack_block(struct still *still, struct image *image, uint32_t block)
{
	const struct program *p = still->program;
	const uint64_t begin = (uint64_t)block * STILL_BLOCK * 8, end = begin + STILL_BLOCK * 8;

	for (uint32_t i = bits_behind(p, begin); i < p->bits_count; i++) {
		const struct code_bits *bits = &p->bits[i];
		const uint64_t at = (uint64_t)p->areas.at[bits->area] * 8 + bits->first;
		const uint64_t last = at + bits->count < end ? at + bits->count : end;
		struct code_bits part;

		if (at >= end)
			break;
		if (!image_reads(bits))
			continue;
		part = part_of(bits, (uint32_t)(at < begin ? begin - at : 0), (uint32_t)(last - at));
		image_unpack(image, &part);
		for (uint32_t k = part.slot / STILL_BLOCK;
		     k <= (part.slot + part.count - 1) / STILL_BLOCK; k++)
			look(still, image->memory, k);
	}
}

/* A block of bits that live a byte each has changed: so does their area. */
static void pack_block(struct still *still, struct image *image, uint32_t block)
{
	const struct program *p = still->program;
	const uint32_t begin = block * STILL_BLOCK, end = begin + STILL_BLOCK;

	for (uint32_t i = slots_behind(p, begin); i < p->bits_count; i++) {
		const struct code_bits *bits = &p->bits[i];
		const uint32_t last = bits->slot + bits->count < end ? bits->slot + bits->count :
								       end;
		struct code_bits part;

		if (bits->slot >= end)
			break;
		if (image_reads(bits))
			continue;
		part = part_of(bits, bits->slot < begin ? begin - bits->slot : 0,
			       last - bits->slot);
		image_pack(image, &part);
	}
}

static void pack_changed(struct still *still, struct image *image)
{
	for (uint32_t i = 0; i <= still->blocks / 64; i++)
		for (uint64_t left = still->changed[i]; left; left &= left - 1)
			pack_block(still, image, i * 64 + (uint32_t)__builtin_ctzll(left));
}

/* ---- which scans ---- */

void still_reset(struct still *still)
{
	if (still) {
		still->stale = true;
		still->wait = 0;
	}
}

static void make_all_pending(struct still *still)
{
	for (uint32_t i = 0; i < still->words; i++)
		still->pending[i] = UINT64_MAX;
	if (still->count % 64)
		still->pending[still->words - 1] = (UINT64_C(1) << still->count % 64) - 1;
}

static uint32_t count_pending(const struct still *still)
{
	uint32_t count = 0;

	for (uint32_t i = 0; i < still->words; i++)
		count += (uint32_t)__builtin_popcountll(still->pending[i]);
	return count;
}

/* More than half would run. */
static bool give_up(struct still *still)
{
	still->pause = still->pause < LONGEST / 2 ? 2 * still->pause + 1 : LONGEST;
	still->wait = still->pause;
	still->calm = 0;
	still->stale = true;
	return false;
}

static void look_outside(struct still *still, struct image *image)
{
	uint32_t end;

	for (uint32_t i = 0; i < still->outside_count; i = end) {
		const size_t at = (size_t)still->outside[i] * STILL_BLOCK;

		end = still->row_end[i];
		if (size_of(still, still->outside[end - 1]) == STILL_BLOCK &&
		    !differs(image->memory + at, still->seen + at, end - i))
			continue;
		for (; i < end; i++)
			if (look(still, image->memory, still->outside[i]) & still->unpacked[i])
				unpack_block(still, image, still->outside[i]);
	}
}

static void begin_anew(struct still *still, struct image *image)
{
	image_begin(image);
	memcpy(still->seen, image->memory, still->program->header->data_size);
	make_all_pending(still);
	still->stale = image->changed = false;
}

bool still_begin(struct still *still, struct image *image, int64_t now_ns, bool may)
{
	still->later = now_ns > still->now_ns;
	still->now_ns = now_ns;
	still->on = false;
	if (!may || still->wait) {
		still->wait -= still->wait != 0;
		still->stale = true;
		return false;
	}
	if (still->any_changed) {
		memset(still->changed, 0, (still->blocks / 64 + 1) * sizeof(*still->changed));
		still->any_changed = false;
	}
	if (still->stale) {
		begin_anew(still, image);
		still->on = true;
		return true;
	}
	for (uint32_t i = 0; i < still->words; i++)
		still->pending[i] |= still->always[i];
	if (image->changed || image->force_count) {
		image_begin(image);
		image->changed = false;
		look_at_all(still, image->memory);
		still->any_changed = true;
	} else {
		look_outside(still, image);
	}
	if (count_pending(still) > still->count / 2)
		return give_up(still);
	if (still->calm < CALM && ++still->calm == CALM)
		still->pause = 0;
	still->on = true;
	return true;
}

/* Where forces are held or values were written, all of it, as their bits may not be in a block
 * that a stretch touches. */
bool still_end(struct still *still, struct image *image)
{
	if (!still->on || still->stale || image->force_count || image->changed)
		return false;
	if (still->any_changed && !still->in_order)
		return false;
	if (still->any_changed)
		pack_changed(still, image);
	return true;
}

/* ---- one program ---- */

/* If the budget cannot last, those behind @from run, so that it ends where it would. */
static void need_all(struct still *still, const struct still_program *part, uint32_t from)
{
	for (uint32_t i = from; i < part->first + part->count; i++)
		if (still->stretch[i].pays)
			still->pending[i / 64] |= UINT64_C(1) << i % 64;
}

/* The instructions of a stretch. */
static enum fault run_code(struct still *still, struct vm *vm, uint32_t i, uint32_t entry)
{
	const struct stretch *at = &still->stretch[i];
	const uint32_t *text = still->program->text;
	enum fault fault = FAULT_NONE;

	if (at->head_parts)
		vm_look_up(vm->memory, text + at->head, at->head_parts);
	if (at->from != STILL_NONE) {
		vm->resume = at->from;
		vm->until = at->stop;
		fault = vm_run(vm, entry, false);
	}
	if (fault == FAULT_NONE && at->tail_parts)
		vm_look_up(vm->memory, text + at->stop + 1, at->tail_parts);
	return fault;
}

/* The same of one that takes from the budget: what is left of @budget after those before. */
static enum fault run_paying(struct still *still, struct vm *vm, uint32_t i, uint32_t entry,
			     uint32_t budget)
{
	struct still_program *part = &still->part[entry];
	const uint32_t called = vm->called;
	uint64_t before = 0;
	uint32_t given;
	enum fault fault;

	for (uint32_t k = part->first; k < i; k++)
		before += still->spent[k];
	given = vm->budget = before < budget ? budget - (uint32_t)before : 0;
	part->spent -= still->spent[i];
	part->called -= still->called[i];
	fault = run_code(still, vm, i, entry);
	part->spent += still->spent[i] = given - vm->budget;
	part->called += still->called[i] = vm->called - called;
	vm->called = called;
	if (part->spent > budget)
		need_all(still, part, i + 1);
	return fault;
}

static enum fault run_stretch(struct still *still, struct vm *vm, uint32_t i, uint32_t entry,
			      uint32_t budget)
{
	const struct stretch *at = &still->stretch[i];
	const uint32_t errors = vm->errors;
	enum fault fault;

	still->pending[i / 64] &= ~(UINT64_C(1) << i % 64);
	fault = at->pays ? run_paying(still, vm, i, entry, budget) : run_code(still, vm, i, entry);
	if (fault != FAULT_NONE) {
		still->stale = true;
		return fault;
	}
	for (uint32_t k = 0; k < at->written_count; k++)
		look(still, vm->memory, still->written[at->written + k]);
	/* A failed operation is counted in every scan; a timer that has just begun changes
	 * nothing before time has passed. */
	if (vm->errors != errors || !still->later)
		still->pending[i / 64] |= UINT64_C(1) << i % 64;
	still->ran++;
	return FAULT_NONE;
}

/* The next pending stretch from @from on; @end: none. */
static uint32_t next_pending(const struct still *still, uint32_t from, uint32_t end)
{
	while (from < end) {
		const uint64_t left = still->pending[from / 64] >> from % 64;

		if (left) {
			from += (uint32_t)__builtin_ctzll(left);
			return from < end ? from : end;
		}
		from = (from / 64 + 1) * 64;
	}
	return end;
}

/* SYS_CYCLE is written for each task. Its block stays different until the next scan. */
static void look_at_cycle(struct still *still, const uint8_t *m)
{
	const struct areas *areas = &still->program->areas;
	const uint32_t at = areas->at[AREA_SM] + RESOURCE_CYCLE;

	if (!memcmp(m + at, still->seen + at, sizeof(int64_t)))
		return;
	for (uint32_t i = at / STILL_BLOCK; i <= (at + sizeof(int64_t) - 1) / STILL_BLOCK; i++)
		if (bytes_that_differ(m + (size_t)i * STILL_BLOCK,
				      still->seen + (size_t)i * STILL_BLOCK,
				      size_of(still, i)) & still->mask[i])
			make_pending(still, i);
}

enum fault still_run(struct still *still, struct vm *vm, uint32_t entry)
{
	const struct still_program *part = &still->part[entry];
	const uint32_t budget = vm->budget, end = part->first + part->count;
	enum fault fault;

	if (!still->on)
		return vm_run(vm, entry, false);
	look_at_cycle(still, vm->memory);
	still->all += part->count;
	if (part->spent > budget)
		need_all(still, part, part->first);
	for (uint32_t i = next_pending(still, part->first, end); i < end;
	     i = next_pending(still, i + 1, end)) {
		fault = run_stretch(still, vm, i, entry, budget);
		if (fault != FAULT_NONE)
			return fault;
	}
	vm->budget = budget - (uint32_t)part->spent;
	vm->called += (uint32_t)part->called;
	return FAULT_NONE;
}
