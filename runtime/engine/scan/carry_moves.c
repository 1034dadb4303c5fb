/* SPDX-License-Identifier: MIT
 *
 * carry_moves - what to copy from where to where, so that both copies of a bit with an
 * address agree, and a value that nobody changed gets its new initial value.
 */
#include "engine/scan/carry_moves.h"

#include <string.h>

/* ---- joining ---- */

struct range { uint32_t from, end; }; /* bytes of the new memory */

static uint32_t unit_of(const struct carry_move *move)
{
	return move->kind == MOVE_CHANGED ? move->size : 1;
}

static bool apart(struct range a, struct range b)
{
	return a.end <= b.from || b.end <= a.from;
}

static struct range bits(uint32_t first, uint32_t count)
{
	return (struct range){ first / 8, (first + count + 7) / 8 };
}

static struct range writes(const struct carry_move *move)
{
	if (move->kind == MOVE_PACK || move->kind == MOVE_BITS)
		return bits(move->to, move->count);
	return (struct range){ move->to, move->to + move->count * unit_of(move) };
}

/* Whether @next goes on where @move ends, in both memories. */
static bool follows(const struct carry_move *move, const struct carry_move *next)
{
	const uint32_t size = move->count * unit_of(move);

	if (move->own || next->own || move->kind == MOVE_TEXT ||
	    move->kind != next->kind || move->size != next->size)
		return false;
	return move->from + size == next->from && move->to + size == next->to &&
	       (move->kind != MOVE_CHANGED || move->begun + 2 * size == next->begun);
}

/* Bits with an address have two copies, so moves of neighbours take turns. A move that
 * joins the last but one is done earlier, so it may not write what the last one writes. */
static bool join(struct moves *moves, const struct carry_move *next)
{
	struct carry_move *last;

	if (moves->count == 0)
		return false;
	last = &moves->move[moves->count - 1];
	if (follows(last, next)) {
		last->count += next->count;
		return true;
	}
	if (moves->count < 2 || !follows(last - 1, next) ||
	    !apart(writes(last), writes(next)))
		return false;
	last[-1].count += next->count;
	return true;
}

static void add(struct moves *moves, struct carry_move next)
{
	struct carry_move *room;

	if (next.count == 0 || join(moves, &next))
		return;
	room = arena_push(moves->arena, &moves->move, &moves->count, sizeof(*room));
	if (room)
		*room = next;
}

static void add_block(struct moves *moves, uint32_t to, uint32_t from, uint32_t count)
{
	const struct carry_move next = { .kind = MOVE_BYTES, .from = from, .to = to,
					 .count = count };
	const int used = moves->block_count;
	struct carry_move *room;

	if (used > 0 && follows(&moves->block[used - 1], &next)) {
		moves->block[used - 1].count += count;
		return;
	}
	room = arena_push(moves->arena, &moves->block, &moves->block_count, sizeof(*room));
	if (room)
		*room = next;
}

/* ---- bits ---- */

/* Where a BOOL is read: its byte, or its bit in an area. */
struct source {
	bool packed, own;
	uint32_t at;
};

static uint32_t slot_of(const struct program *program, enum iec_area area, uint32_t bit)
{
	return code_bits_find(program->bits, program->bits_count, area, bit);
}

static struct source source_of(const struct program *program, struct location at, bool own)
{
	const uint32_t slot = at.area == AREA_NONE ? at.where :
			      slot_of(program, at.area, at.where);

	if (slot)
		return (struct source){ false, own, slot };
	return (struct source){ true, own, 8 * program->areas.at[at.area] + at.where };
}

static void put_byte(struct moves *moves, uint32_t to, struct source source)
{
	add(moves, (struct carry_move){
		.kind = source.packed ? MOVE_UNPACK : MOVE_BYTES, .own = source.own,
		.from = source.at, .to = to, .count = 1 });
}

static void put_packed(struct moves *moves, enum iec_area area, uint32_t bit,
		       struct source source)
{
	add(moves, (struct carry_move){
		.kind = source.packed ? MOVE_BITS : MOVE_PACK, .own = source.own,
		.from = source.at, .to = 8 * moves->to->program->areas.at[area] + bit,
		.count = 1 });
}

static void put_bit(struct moves *moves, struct location to, struct source source)
{
	uint32_t slot;

	if (to.area == AREA_NONE) {
		put_byte(moves, to.where, source);
		return;
	}
	put_packed(moves, to.area, to.where, source);
	slot = slot_of(moves->to->program, to.area, to.where);
	if (slot)
		put_byte(moves, slot, source);
}

/* ---- areas ---- */

static uint32_t bits_of_both(const struct moves *moves, enum iec_area area)
{
	const uint32_t to = moves->to->program->areas.bytes[area];
	const uint32_t from = moves->from->program->areas.bytes[area];

	return 8 * (to < from ? to : from);
}

/* The bits of a range that both programs have. */
static uint32_t count_of_both(const struct moves *moves, const struct code_bits *range)
{
	const uint32_t most = bits_of_both(moves, (enum iec_area)range->area);

	if (range->first >= most)
		return 0;
	return range->count < most - range->first ? range->count : most - range->first;
}

/* Between two scans the byte of an input is newer or older than its bit; the program
 * has seen the byte. */
static void pack_old(struct moves *moves, const struct code_bits *range)
{
	const uint32_t count = count_of_both(moves, range);

	for (uint32_t i = 0; i < count; i++)
		put_packed(moves, (enum iec_area)range->area, range->first + i,
			   (struct source){ false, false, range->slot + i });
}

static void fill_new(struct moves *moves, const struct code_bits *range)
{
	const uint32_t count = count_of_both(moves, range);
	struct location at = { .type = IEC_BOOL, .area = (enum iec_area)range->area };

	for (uint32_t i = 0; i < count; i++) {
		at.where = range->first + i;
		put_byte(moves, range->slot + i,
			 source_of(moves->from->program, at, false));
	}
}

void moves_areas(struct moves *moves)
{
	const struct program *to = moves->to->program, *from = moves->from->program;

	for (int area = AREA_NONE + 1; area < AREA_COUNT; area++)
		add(moves, (struct carry_move){
			.kind = MOVE_BYTES, .from = from->areas.at[area],
			.to = to->areas.at[area],
			.count = bits_of_both(moves, (enum iec_area)area) / 8 });
	for (uint32_t i = 0; i < from->bits_count; i++)
		pack_old(moves, &from->bits[i]);
	for (uint32_t i = 0; i < to->bits_count; i++)
		fill_new(moves, &to->bits[i]);
}

/* ---- values ---- */

static bool is_data(const struct program *program, struct location at)
{
	return at.area == AREA_NONE && at.where >= program->areas.size;
}

/* Returns the offset of @size bytes in `begun`, aligned for a text. */
static uint32_t remember(struct moves *moves, const void *bytes, size_t size)
{
	const size_t at = moves->begun_size, end = at + (size + 3) / 4 * 4;

	if (end > moves->begun_room) {
		const size_t room = 2 * end;
		uint8_t *grown = arena_grow(moves->arena, moves->begun, at, room);

		if (!grown)
			return 0;
		moves->begun = grown;
		moves->begun_room = room;
	}
	memcpy(moves->begun + at, bytes, size);
	moves->begun_size = end;
	return (uint32_t)at;
}

/* If the initial value was edited, every BOOL is the new one: the old value was either
 * that, or the old initial value. */
static void carry_bool(struct moves *moves, struct location to, struct location from)
{
	const struct program *program = moves->from->program;
	const bool begins = image_get(moves->to, to).i;
	struct source source = { .at = begins ? CODE_TRUE_AT(&program->areas) :
						CODE_FALSE_AT(&program->areas) };

	if (begins == (bool)image_get(moves->from, from).i)
		source = source_of(program, from, false);
	if (to.area == AREA_NONE && !source.packed)
		add_block(moves, to.where, source.at, 1);
	else
		put_bit(moves, to, source);
}

/* Bytes that a number of the program shares with bits are packed (translate/layout.c): the
 * bits have no second copy. */
static void carry_number(struct moves *moves, struct location to, struct location from)
{
	const uint8_t *begins = moves->to->memory + to.where;
	const uint8_t *begun = moves->from->memory + from.where;
	const uint8_t size = iec_type_row(to.type)->size;
	uint8_t both[16];

	if (memcmp(begins, begun, size) != 0) {
		memcpy(both, begun, size);
		memcpy(both + size, begins, size);
		add(moves, (struct carry_move){
			.kind = MOVE_CHANGED, .size = size, .from = from.where,
			.to = to.where, .count = 1,
			.begun = remember(moves, both, 2u * size) });
	} else if (is_data(moves->to->program, to)) {
		add_block(moves, to.where, from.where, size);
	} else {
		add(moves, (struct carry_move){ .kind = MOVE_BYTES, .from = from.where,
						.to = to.where, .count = size });
	}
}

static void carry_text(struct moves *moves, struct location to, struct location from)
{
	const struct iec_string *begins = image_get(moves->to, to).s;
	const struct iec_string *begun = image_get(moves->from, from).s;
	struct carry_move move = { .kind = MOVE_TEXT, .from = from.where, .to = to.where,
				   .count = 1 };

	if (begins->length != begun->length ||
	    memcmp(begins->text, begun->text, begun->length) != 0)
		move.begun = 1 + remember(moves, begun, sizeof(*begun) + begun->length);
	add(moves, move);
}

void moves_value(struct moves *moves, struct location to, struct location from)
{
	if (to.type == IEC_BOOL)
		carry_bool(moves, to, from);
	else if (to.type == IEC_STRING)
		carry_text(moves, to, from);
	else
		carry_number(moves, to, from);
}

/* ---- instances ---- */

/* A text has its room in the instance. */
static uint32_t input_size(const struct word_pin *pin)
{
	return pin->type == IEC_STRING ? (uint32_t)sizeof(struct word_text) :
					 iec_type_row(pin->type)->size;
}

static uint32_t input_end(const struct word_pin *pin)
{
	return pin->offset + input_size(pin);
}

static bool is_edited(const struct moves *moves, const struct word_pin *pin, uint32_t to,
		      uint32_t from)
{
	return pin->dir == PIN_IN &&
	       memcmp(moves->to->memory + to + pin->offset,
		      moves->from->memory + from + pin->offset, input_size(pin)) != 0;
}

/* The first edited input that begins at @at or later. */
static const struct word_pin *next_edited(const struct moves *moves,
					  const struct word_row *row, uint32_t to,
					  uint32_t from, uint32_t at)
{
	const struct word_pin *next = NULL;

	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];

		if (pin->offset >= at && (!next || pin->offset < next->offset) &&
		    is_edited(moves, pin, to, from))
			next = pin;
	}
	return next;
}

void moves_instance(struct moves *moves, const struct word_row *row, uint32_t to,
		    uint32_t from)
{
	const struct word_pin *pin;
	uint32_t at = 0;

	while ((pin = next_edited(moves, row, to, from, at)) != NULL) {
		add_block(moves, to + at, from + at, pin->offset - at);
		at = input_end(pin);
	}
	add_block(moves, to + at, from + at, row->size - at);
}

void moves_seen(struct moves *moves, struct location to, struct location of)
{
	put_bit(moves, to, LOCATION_IS_PART(of) ? (struct source){ true, true, 8 * of.where + of.first } :
		source_of(moves->to->program, of, true));
}

/* ---- the plan ---- */

/* Heapsort: no recursion, no further memory. */
static void sink(uint64_t *number, size_t at, size_t count)
{
	for (size_t child; (child = 2 * at + 1) < count; at = child) {
		const uint64_t moved = number[at];

		if (child + 1 < count && number[child + 1] > number[child])
			child++;
		if (number[child] <= moved)
			return;
		number[at] = number[child];
		number[child] = moved;
	}
}

void moves_sort(uint64_t *number, size_t count)
{
	for (size_t i = count / 2; i > 0; i--)
		sink(number, i - 1, count);
	for (size_t end = count; end > 1; end--) {
		const uint64_t largest = number[0];

		number[0] = number[end - 1];
		number[end - 1] = largest;
		sink(number, 0, end - 1);
	}
}

/* Blocks in the order of the new memory; those that meet become one. Returns how many
 * are left. */
static uint32_t order_blocks(struct moves *moves, struct carry_move *out)
{
	const size_t count = (size_t)moves->block_count;
	uint64_t *key = arena_alloc(moves->arena, count * sizeof(*key));
	uint32_t used = 0;

	if (!key)
		return 0;
	for (size_t i = 0; i < count; i++)
		key[i] = (uint64_t)moves->block[i].to << 32 | i;
	moves_sort(key, count);
	for (size_t i = 0; i < count; i++) {
		const struct carry_move *next = &moves->block[(uint32_t)key[i]];

		if (used && follows(&out[used - 1], next))
			out[used - 1].count += next->count;
		else if (next->count)
			out[used++] = *next;
	}
	return used;
}

static void add_cost(struct carry_cost *cost, const struct program *to,
		     const struct carry_move *move)
{
	switch ((enum move)move->kind) {
	case MOVE_BYTES:
		cost->bytes += move->count;
		cost->operations++;
		return;
	case MOVE_TEXT:
		cost->bytes += code_run_size(code_run_at(to, move->to));
		cost->operations++;
		return;
	case MOVE_PACK:
	case MOVE_UNPACK:
	case MOVE_BITS:
	case MOVE_CHANGED:
		cost->operations += move->count;
		return;
	}
}

static void *copy(struct arena *arena, const void *bytes, size_t size)
{
	void *memory = arena_alloc(arena, size);

	if (memory && size)
		memcpy(memory, bytes, size);
	return memory;
}

bool moves_finish(struct moves *moves, struct carry_plan *plan, struct arena *arena)
{
	const size_t most = (size_t)moves->block_count + (size_t)moves->count;
	struct carry_move *all = arena_alloc(moves->arena, most * sizeof(*all));
	uint32_t count;

	if (!all)
		return false;
	count = order_blocks(moves, all);
	if (moves->arena->failed)
		return false;
	if (moves->count)
		memcpy(all + count, moves->move, (size_t)moves->count * sizeof(*all));
	count += (uint32_t)moves->count;
	for (uint32_t i = 0; i < count; i++)
		add_cost(&plan->cost, plan->to, &all[i]);
	plan->move_count = count;
	plan->move = copy(arena, all, count * sizeof(*all));
	plan->begun = copy(arena, moves->begun, moves->begun_size);
	return plan->move && plan->begun;
}
