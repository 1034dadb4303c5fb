/* SPDX-License-Identifier: MIT
 *
 * sim_eras - the records of the programs that ran one after the other, from edit to edit.
 */
#ifndef EDITOR_SIM_ERAS_H
#define EDITOR_SIM_ERAS_H

#include "editor-gtk/sim/sim_program.h"

/* The scans that one program ran: those after `record_first()` of its record, which is the
 * last one of the program before; of the first era, from there on. */
struct sim_era {
	guint64 id;              /* from 1                                     */
	struct record *record;
	struct sim_program *program, *plant; /* references                      */
	gint64 edited_us;        /* when another program took its place, of the
				    clock; 0: this one runs                    */
	gsize size;              /* of what ended, with its program            */
};
struct sim_eras;
/** sim_eras_new - of a twin as it is. @program, @plant: it takes references. Whoever uses
 * them in two threads holds a lock. Owns: sim_eras_free(). Fails: NULL: no memory. */
struct sim_eras *sim_eras_new(const struct twin *twin, struct sim_program *program,
			      struct sim_program *plant);
void sim_eras_free(struct sim_eras *eras);
/** sim_eras_newest - of the program that runs. Borrowed until the next change. */
const struct sim_era *sim_eras_newest(const struct sim_eras *eras);
/** sim_eras_find - whose scan it is; NULL: it is not kept. Borrowed likewise. */
const struct sim_era *sim_eras_find(const struct sim_eras *eras, guint64 scan);
/** sim_eras_first - of the oldest. */
guint64 sim_eras_first(const struct sim_eras *eras);
/** sim_eras_bytes - what all of them take; of the program that runs its record alone. */
gsize sim_eras_bytes(const struct sim_eras *eras);
/** sim_eras_act, sim_eras_scan - as record_act(), record_scan(); all of them together take
 * SIM_BYTES, and the oldest go first, whole. */
void sim_eras_act(struct sim_eras *eras, const struct twin *twin, const struct act *act);
void sim_eras_scan(struct sim_eras *eras, const struct twin *twin);
/** sim_eras_change - @program runs from here on, in @twin. One that ran no scan leaves
 * nothing. Fails: false: no memory; nothing has changed. */
bool sim_eras_change(struct sim_eras *eras, const struct twin *twin,
		     struct sim_program *program);

#endif
