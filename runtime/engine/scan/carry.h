/* SPDX-License-Identifier: MIT
 *
 * carry - replaces a running program: the new one goes on with the state of the old
 * one.
 *
 * A plan is made before, in any thread; it matches names and types and knows no value. The
 * scan thread applies it between two scans. A simulation does both at once: carry().
 *
 * A variable of the same name and type keeps its value: globals, locals by their POU,
 * instances with their inner state, arrays element by element as far as both have it,
 * edges by their element. Areas keep their bytes by address. Time, scan numbers and
 * forces go on; SYS_FIRST_SCAN stays FALSE.
 *
 * Initial values go to: new variables; variables with another type; texts that no
 * longer fit; instances of another block; edge coils that are new or have another kind
 * or operand. A new edge contact takes the present value of its operand and waits for
 * an edge. A variable that still has its old initial value gets the new one; so does an
 * input of an instance whose constant was edited. Power of cells is unknown until the
 * next scan. No program runs.
 */
#ifndef SCAN_CARRY_H
#define SCAN_CARRY_H

#include "engine/base/arena.h"
#include "engine/scan/resource.h"

struct carry_plan;

/**
 * carry_plan_new - matches two programs
 * @to, @from: borrowed as long as the plan is used
 * @arena: memory of the plan; a few bytes for each variable that moves
 *
 * Owns: @arena. Scan-safe: no (slow, but any thread may call it).
 * Fails: NULL: no memory, or an image with more values than memory has room for.
 */
const struct carry_plan *carry_plan_new(const struct program *to,
					const struct program *from,
					struct arena *arena);

/**
 * carry_apply - copies the state of @from into @to as the plan says
 * @to: just initialised by resource_init() with the new program; keeps its memory, and
 *      what its caller has set: `watch`, clock, tick, period, patience
 * @from: does not change
 *
 * Between two scans. @to has no pointer into the program of @from afterwards.
 * Owns: nothing. Scan-safe: yes; carry_cost() says how long.
 * Fails: false: the plan is not for these programs; nothing has changed.
 */
bool carry_apply(const struct carry_plan *plan, struct resource *to,
		 const struct resource *from);

/* The most that carry_apply() does, whatever the values are. */
struct carry_cost {
	uint64_t bytes;         /* copied in blocks                           */
	uint32_t operations;    /* blocks, texts, forces; values and bits one by one */
};
/** carry_cost - for the time budget of the scan. Scan-safe: yes. */
struct carry_cost carry_cost(const struct carry_plan *plan);

/* Why a value or force does not go on. */
enum carry_reason {
	CARRY_GONE,             /* the new program has no such variable       */
	CARRY_NEW,              /* starts with its initial value              */
	CARRY_TYPE,             /* of another type: likewise                  */
	CARRY_BLOCK,            /* an instance of another block: likewise     */
	CARRY_TEXT,             /* longer than its new room: likewise         */
	CARRY_FORCE,            /* the force ends                             */
};
struct carry_loss {
	enum carry_reason reason;
	const char *name;       /* with its POU: "Main.Delay", "List[3]", "List[7..9]"; for a
				 * force also "%MX3.1"; "": a place without a name */
	struct location at;     /* of the first one: in the new program, but for GONE and
				 * FORCE in the old one                       */
};
/**
 * carry_plan_losses - what will not go on, for a person who decides
 * @now: forces and values of the old program, a copy; NULL: unknown. `program` is that of
 *       the plan; `memory` NULL: only forces are known
 * @take: gets each loss once; its name lives during the call
 *
 * Without values, every text with less room is reported. Without forces, none is. Constants,
 * temporaries and edges are not reported. A variable with an address keeps what is at the
 * address, so it is reported only if its area has become too small. Images without names
 * give no losses.
 * Owns: nothing. Scan-safe: no. Fails: never.
 */
void carry_plan_losses(const struct carry_plan *plan, const struct image *now,
		       void (*take)(void *context, const struct carry_loss *loss),
		       void *context);

/**
 * carry - plan and apply at once
 * @to, @from: as in carry_apply()
 * @arena: for temporary memory; may be freed afterwards
 *
 * Owns: nothing. Scan-safe: no. Fails: false: no memory; nothing has changed.
 */
bool carry(struct resource *to, const struct resource *from, struct arena *arena);
#endif
