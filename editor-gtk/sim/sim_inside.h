/* SPDX-License-Identifier: MIT
 *
 * sim_inside - what the files of the simulation share. Only editor-gtk/sim*.c include it.
 */
#ifndef EDITOR_SIM_INSIDE_H
#define EDITOR_SIM_INSIDE_H

#include "editor-gtk/sim/sim.h"

/* ---- sim_program.c: a project that was built to be watched ---- */

/* Counted, since the thread and the window let go of it at different times. */
struct sim_program {
	gatomicrefcount count;
	struct ladder *ladder;
	const struct program *program;
	char *text;              /* that it was built from                     */
	guint8 *safe;            /* for twin_set_safe(): of the I/O map beside it */
};
/** sim_program_say_why - the first error, with its place. */
void sim_program_say_why(const struct diag_list *diags, GError **error);
/** sim_program_new - @file: interned, for diagnostics, and the I/O map is beside it; "-": it
 * has none. Owns: sim_program_unref(). Any thread. Fails: NULL, and @error is the first thing
 * that is wrong with it. */
struct sim_program *sim_program_new(const char *file, const char *text, gsize len,
				    GError **error);
struct sim_program *sim_program_ref(struct sim_program *program);
void sim_program_unref(struct sim_program *program);
/** sim_program_is_same - do they run the same, stop the same, and show the same? Texts may
 * differ in what an editor keeps for itself, such as bookmarks. */
bool sim_program_is_same(const struct sim_program *a, const struct sim_program *b);

/* ---- sim_eras.c: the record, from edit to edit ---- */

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

/* ---- sim_thread.c: it scans, and hands out copies ---- */

struct sim_thread;

/* What was not done, last, and how many were not. */
enum sim_refused {
	SIM_REFUSED_PLACE, /* it cannot be set or forced, or too many are held  */
	SIM_REFUSED_STALE, /* it is a place of a program that runs no more      */
};
struct sim_refusal {
	enum sim_refused why;
	guint count;
};

/* What came of scans by themselves; each counted, since copies of values leave some out. */
struct sim_events {
	guint ends;              /* in FAULT, or because the program said STOP  */
	guint failures;          /* starts in which an operation failed        */
	bool faulted;            /* for the last failure                       */
};

/* What the window sees of the thread. */
struct sim_view {
	struct twin twin;        /* a clone: of `program`                      */
	struct sim_program *program, *plant;
	bool running;            /* not paused                                 */
	bool fault;              /* an operation failed: outputs are safe      */
	struct sim_refusal refusal;
	struct sim_events events;
};

/**
 * sim_thread_new - in STOP, with a record
 * @program, @plant: it takes references; @plant NULL: none
 * @notify: called in the main context when there is something new to take; @data borrowed
 * Owns: sim_thread_free(), which waits until it has ended. Fails: NULL: no memory.
 */
struct sim_thread *sim_thread_new(struct sim_program *program, struct sim_program *plant,
				  gint64 period_ns, GSourceFunc notify, gpointer data);
void sim_thread_free(struct sim_thread *thread);

void sim_thread_run(struct sim_thread *thread, bool run);
void sim_thread_scan(struct sim_thread *thread, int scans);
void sim_thread_speed(struct sim_thread *thread, double scans);
/** sim_thread_heed - as ladder_sim_set_heeds(). */
void sim_thread_heed(struct sim_thread *thread, bool heed);
/** sim_thread_act - @of: the program or plant whose place it means, NULL: none; if that runs
 * no more, it is refused: what stands there now is another variable. */
void sim_thread_act(struct sim_thread *thread, struct sim_program *of,
		    const struct act *act);
/** sim_thread_play - as ladder_sim_play(); it takes a reference of @acts. */
void sim_thread_play(struct sim_thread *thread, GArray *acts, guint64 scans);
/** sim_thread_change - another program takes the place of the one that runs. It takes a
 * reference. */
void sim_thread_change(struct sim_thread *thread, struct sim_program *program);

/** sim_thread_take - brings @view to what is newest; @other gets whether it is of another
 * program than it was. Fails: false: no memory, @view is as it was. */
bool sim_thread_take(struct sim_thread *thread, struct sim_view *view, bool *other);
void sim_view_clear(struct sim_view *view);
/** sim_thread_lateness - as ladder_sim_lateness(). */
bool sim_thread_lateness(struct sim_thread *thread, struct sim_lateness *out);
/** sim_thread_lock - the records of all programs; the thread waits as long. */
const struct sim_eras *sim_thread_lock(struct sim_thread *thread);
void sim_thread_unlock(struct sim_thread *thread);

/* ---- sim_rungs.c: which rung of the document is which of the program that runs ---- */

struct sim_rungs;

/** sim_rungs_new - follows @document; all rungs are unknown at first. */
struct sim_rungs *sim_rungs_new(LadderDocument *document);
void sim_rungs_free(struct sim_rungs *rungs);
/** sim_rungs_same - the program is what the document is now. */
void sim_rungs_same(struct sim_rungs *rungs);
int sim_rungs_find(const struct sim_rungs *rungs, int pou, int rung);

/* ---- sim_words.c ---- */

/** sim_place_words - "Main, rung 2 (1,3)", "Main, line 7". Caller frees. */
char *sim_place_words(const struct fault_place *at);
/** sim_fault_words - "instruction budget exceeded: Main, rung 2 (1,3)". Caller frees. */
char *sim_fault_words(const struct resource *resource);
/** sim_halt_words - that the program asked for STOP, and where. Caller frees. */
char *sim_halt_words(const struct resource *resource);
/** sim_failed_words - which operation was the first to fail; @faulted: and that time stands
 * still for it. Caller frees. */
char *sim_failed_words(const struct resource *resource, bool faulted);

#endif
