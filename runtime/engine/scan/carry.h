/* SPDX-License-Identifier: MIT
 *
 * carry - replaces a running program: the new one goes on with the state of the old
 * one.
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

/**
 * carry - copies the state of @from into @to, a resource of the changed program
 * @to: freshly initialised; keeps its program and memory. @from does not change
 * @arena: for temporary memory; may be freed afterwards
 *
 * Between two scans. @to has no pointer into the program of @from afterwards.
 * Owns: nothing. Scan-safe: no.
 * Fails: false: no memory; initialise @to again.
 */
bool carry(struct resource *to, const struct resource *from, struct arena *arena);
#endif
