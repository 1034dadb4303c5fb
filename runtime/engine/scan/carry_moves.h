/* SPDX-License-Identifier: MIT
 *
 * carry_moves - writes the moves of a plan: from typed places of two programs to copies of
 * bytes, bits and values.
 *
 * It knows no names. Moves that follow one another in both memories become one.
 */
#ifndef SCAN_CARRY_MOVES_H
#define SCAN_CARRY_MOVES_H

#include "engine/scan/carry_plan.h"

struct moves {
	struct arena *arena;      /* temporary memory; `failed` says that it is out */
	const struct image *to, *from; /* as at a cold start                   */
	struct carry_move *move;
	int count;
	struct carry_move *block; /* into data without an address: in any order */
	int block_count;
	uint8_t *begun;
	size_t begun_size, begun_room;
};

/* Of all: Owns: moves->arena. Scan-safe: no. Fails: see moves->arena->failed. */

/** moves_areas - bytes and bits of all areas, as far as both programs have them. First. */
void moves_areas(struct moves *moves);
/** moves_value - one value; both places have the same type. */
void moves_value(struct moves *moves, struct location to, struct location from);
/** moves_instance - an instance of @row, but for inputs with another constant. */
void moves_instance(struct moves *moves, const struct word_row *row, uint32_t to,
		    uint32_t from);
/** moves_seen - a BOOL of the new program from another one there. Last. */
void moves_seen(struct moves *moves, struct location to, struct location of);
/**
 * moves_finish - puts the moves into a plan, with their cost
 *
 * Owns: @arena, as the plan. Scan-safe: no. Fails: false: no memory.
 */
bool moves_finish(struct moves *moves, struct carry_plan *plan, struct arena *arena);

/** moves_sort - orders numbers, the smallest first. */
void moves_sort(uint64_t *number, size_t count);
#endif
