/* SPDX-License-Identifier: MIT
 *
 * why - why a cell of a rung has no power, or how power gets there.
 *
 * The answer is a list of ways. A way without power lists exactly the elements that
 * must change: if all of them change, the cell has power; if only some do, it has none.
 * Blocks and comparisons are listed with their values. It explains one scan, and needs
 * a program with the power of its cells.
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
#define WHY_CELLS  16  /* most elements in one way                           */
#define WHY_NAME   80
#define WHY_VALUES 160

struct why_cell {
	enum why_kind kind;
	int row, col;            /* 1-based                                   */
	bool powered;            /* blocked: power reaches its left end */
	char name[WHY_NAME];     /* operand, instance, expression             */
	char values[WHY_VALUES]; /* "ET=20 PT=1000"; "": none                 */
};
struct why_way {
	struct why_cell cell[WHY_CELLS]; /* from left to right                */
	int count;
};

/* The question. */
struct why_place {
	const struct project *project;
	const struct resource *resource; /* right after a scan, watched       */
	int pou;                 /* index                                     */
	const char *instance;    /* of a block: resource_power_in(); or NULL  */
	int rung, row, col;      /* 1-based                                   */
};

struct why {
	bool on;                 /* the cell has power at its left end        */
	enum why_kind whole;     /* WHY_COUNT, or a reason for the whole rung */
	int by_rung;             /* of WHY_SKIPPED                            */
	char name[WHY_NAME];     /* name for `whole`: rung, step, action */
	struct why_way way[WHY_WAYS]; /* the shortest first                   */
	int ways;
	bool more;               /* more ways exist                           */
};

/**
 * why_ask - what blocks power from the left end of a cell, or leads it there
 * @out: caller's, about 40 KB
 *
 * A rung in a loop is explained as in its last run. Owns: nothing; @arena: temporary
 * memory.
 * Scan-safe: no. Fails: false: no such cell, or no memory.
 */
bool why_ask(const struct why_place *at, struct arena *arena, struct why *out);
/** why_text - the text of a kind, blocked or conducting; static. */
const char *why_text(enum why_kind kind, bool on);
#endif
