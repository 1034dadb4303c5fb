/* SPDX-License-Identifier: MIT
 *
 * sim_thread - the thread that scans and records, and hands out copies.
 */
#ifndef EDITOR_SIM_THREAD_H
#define EDITOR_SIM_THREAD_H

#include "editor-gtk/sim/sim_eras.h"

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

#endif
