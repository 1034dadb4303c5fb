/* SPDX-License-Identifier: MIT
 *
 * why - why a place in a rung has no power, or by what ways it has it.
 *
 * The answer is a list of ways. A way that is off names what must change, all of it, for
 * power to come by it, and nothing that need not: whoever turns exactly these contacts
 * over has power, and whoever turns over less has none. Blocks and comparisons are named
 * with their values; what would turn them is not said. It looks at one scan, and needs a
 * program with the power of its cells.
 */
#ifndef TRIAL_WHY_H
#define TRIAL_WHY_H

#include "engine/base/arena.h"
#include "engine/model/project.h"
#include "engine/scan/resource.h"

enum why_kind {
#define WHY(id, off, on) WHY_##id,
#include "engine/trial/why.def"
#undef WHY
	WHY_COUNT
};

#define WHY_WAYS   8
#define WHY_CELLS  16  /* of one way that are named                          */
#define WHY_NAME   80
#define WHY_VALUES 160

struct why_cell {
	enum why_kind kind;
	int row, col;            /* 1-based                                   */
	bool powered;            /* off: its left end has power; so far it comes */
	char name[WHY_NAME];     /* operand, instance, expression             */
	char values[WHY_VALUES]; /* "ET=20 PT=1000"; "": none                 */
};
struct why_way {
	struct why_cell cell[WHY_CELLS]; /* from the left rail on             */
	int count;
};

/* Where. */
struct why_place {
	const struct project *project;
	const struct resource *resource; /* right after a scan, watched       */
	int pou;                 /* index                                     */
	const char *instance;    /* of a block: resource_power_in(); or NULL  */
	int rung, row, col;      /* 1-based                                   */
};

struct why {
	bool on;                 /* power at its left end                     */
	enum why_kind whole;     /* WHY_COUNT, or what holds for the rung     */
	int by_rung;             /* of WHY_SKIPPED                            */
	char name[WHY_NAME];     /* of what `whole` speaks: rung, step, action */
	struct why_way way[WHY_WAYS]; /* the shortest first                   */
	int ways;
	bool more;               /* there are more of them                    */
};

/**
 * why_ask - what holds power back from the left end of a cell, or leads it there
 * @out: caller's, about 40 KB
 *
 * Of a rung in a loop it tells of its last run. Owns: nothing; @arena is used meanwhile.
 * Scan-safe: no.   Fails: false: no such cell, or no memory.
 */
bool why_ask(const struct why_place *at, struct arena *arena, struct why *out);
/** why_text - the text of a kind, of what is off or on; lives for ever. */
const char *why_text(enum why_kind kind, bool on);
#endif
