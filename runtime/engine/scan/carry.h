/* SPDX-License-Identifier: MIT
 *
 * carry - a program is changed while it runs: the new one goes on where the old one was.
 *
 * What has the same name and the same type keeps its value: globals, locals by their POU,
 * instances with all that they keep to themselves, arrays element by element as far as
 * both have them, edges by their element. Areas keep their bytes by address. Time, scan
 * numbers and forces go on; it is no start, so SYS_FIRST_SCAN stays FALSE.
 *
 * What begins anew, with its initial value: what is new; what has another type; a text
 * that has no room any more; an instance that is of another block now; a coil of edges
 * that is new, or is of another kind or operand now. Such a contact takes its operand as
 * it is: it waits for an edge. A value that still was its initial
 * one takes the new initial one, and so does an input of an instance whose constant was
 * edited. Power of cells is unknown until the next scan. It runs nothing.
 */
#ifndef SCAN_CARRY_H
#define SCAN_CARRY_H

#include "engine/base/arena.h"
#include "engine/scan/resource.h"

/**
 * carry - the state of @from into @to, a resource of the changed program
 * @to: freshly initialised; its program and memory stay its own. @from stays as it is
 * @arena: what it needs meanwhile; may be freed afterwards
 *
 * Between two scans. Nothing in @to leads to the program of @from afterwards.
 * Owns: nothing.   Scan-safe: no.
 * Fails: false: no memory; @to is to be initialised again.
 */
bool carry(struct resource *to, const struct resource *from, struct arena *arena);
#endif
