/* SPDX-License-Identifier: MIT
 *
 * sim_thread - the thread that scans and records, and hands out copies.
 */
#ifndef EDITOR_SIM_THREAD_H
#define EDITOR_SIM_THREAD_H

#include "editor-gtk/sim/sim_eras.h"

struct sim_thread;

/* The last refusal, and how many there were. */
enum sim_refused {
	SIM_REFUSED_PLACE, /* cannot be set or forced, or too many are forced   */
	SIM_REFUSED_STALE, /* a place of a program that does not run any more    */
};
struct sim_refusal {
	enum sim_refused why;
	guint count;
};

/* What scans caused. Counted, because not every scan is copied to the window. */
struct sim_events {
	guint ends;              /* FAULT, or STOP by the program               */
	guint failures;          /* starts in which an operation failed        */
	bool faulted;            /* the last failure was a FAULT               */
};

/* The window's copy of the thread's state. */
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
 * @program, @plant: referenced; @plant NULL: none
 * @notify: called in the main context when sim_thread_take() has something new; @data borrowed
 * Owns: sim_thread_free(), which waits for its end. Fails: NULL: no memory.
 */
struct sim_thread *sim_thread_new(struct sim_program *program, struct sim_program *plant,
				  gint64 period_ns, GSourceFunc notify, gpointer data);
void sim_thread_free(struct sim_thread *thread);

void sim_thread_run(struct sim_thread *thread, bool run);
void sim_thread_scan(struct sim_thread *thread, int scans);
void sim_thread_speed(struct sim_thread *thread, double scans);
/** sim_thread_fault_on_error - as ladder_sim_set_fault_on_error(). */
void sim_thread_fault_on_error(struct sim_thread *thread, bool fault);
/** sim_thread_act - @of: the program or plant that has the place; NULL: the act has no place. If
 * it does not run any more, the act is refused: another variable may be at that place. */
void sim_thread_act(struct sim_thread *thread, struct sim_program *of,
		    const struct act *act);
/** sim_thread_play - as ladder_sim_play(); @acts: referenced. */
void sim_thread_play(struct sim_thread *thread, GArray *acts, guint64 scans);
/** sim_thread_change - @program (referenced) replaces the one that runs. */
void sim_thread_change(struct sim_thread *thread, struct sim_program *program);

/** sim_thread_take - copies the newest state to @view; *other: it is of another program than
 * before. Fails: false: no memory, @view is unchanged. */
bool sim_thread_take(struct sim_thread *thread, struct sim_view *view, bool *other);
void sim_view_clear(struct sim_view *view);
/** sim_thread_lateness - as ladder_sim_lateness(). */
bool sim_thread_lateness(struct sim_thread *thread, struct sim_lateness *out);
/** sim_thread_lock - the records of all programs; the thread waits until
 * sim_thread_unlock(). */
const struct sim_eras *sim_thread_lock(struct sim_thread *thread);
void sim_thread_unlock(struct sim_thread *thread);

#endif
