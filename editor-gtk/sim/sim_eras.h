/* SPDX-License-Identifier: MIT
 *
 * sim_eras - the records of the programs that ran one after the other, from edit to edit.
 */
#ifndef EDITOR_SIM_ERAS_H
#define EDITOR_SIM_ERAS_H

#include "editor-gtk/sim/sim_program.h"

/* The scans of one program: those after record_first() of its record, which is the last scan of
 * the program before; in the first era that scan too. */
struct sim_era {
	guint64 id;              /* from 1                                     */
	struct record *record;
	struct sim_program *program, *plant; /* references                      */
	gint64 edited_us;        /* when another program replaced it, as
				    g_get_real_time(); 0: this one runs, or was not replaced */
	gsize size;              /* bytes of record and program, once ended     */
};
struct sim_eras;
/** sim_eras_new - begins a record with @twin. @program, @plant: referenced. Not thread-safe: the
 * callers share a lock. Owns: sim_eras_free(). Fails: NULL: no memory. */
struct sim_eras *sim_eras_new(const struct twin *twin, struct sim_program *program,
			      struct sim_program *plant);
void sim_eras_free(struct sim_eras *eras);
/** sim_eras_newest - of the program that runs. Borrowed until the next change. */
const struct sim_era *sim_eras_newest(const struct sim_eras *eras);
/** sim_eras_find - the era of a scan; NULL: it is not recorded. Borrowed until the next change. */
const struct sim_era *sim_eras_find(const struct sim_eras *eras, guint64 scan);
/** sim_eras_first - the oldest scan. */
guint64 sim_eras_first(const struct sim_eras *eras);
/** sim_eras_bytes - of all records and the programs before edits. */
gsize sim_eras_bytes(const struct sim_eras *eras);
/** sim_eras_act, sim_eras_scan - as record_act(), record_scan(). If all eras take more than
 * SIM_BYTES, whole eras are dropped, the oldest first. */
void sim_eras_act(struct sim_eras *eras, const struct twin *twin, const struct act *act);
void sim_eras_scan(struct sim_eras *eras, const struct twin *twin);
/** sim_eras_break - @twin has run a scan that cannot be computed again: a person set values in the
 * middle of it. As sim_eras_change(), of the same program. */
bool sim_eras_break(struct sim_eras *eras, const struct twin *twin);
/** sim_eras_change - @program runs from now on, in @twin. An era without a scan is dropped.
 * Fails: false: no memory; nothing has changed. */
bool sim_eras_change(struct sim_eras *eras, const struct twin *twin,
		     struct sim_program *program);

#endif
