/* SPDX-License-Identifier: MIT
 *
 * sim_inside - what the files of the simulation share. Only editor-gtk/sim*.c include it.
 */
#ifndef EDITOR_SIM_INSIDE_H
#define EDITOR_SIM_INSIDE_H

#include "editor-gtk/sim.h"

/* ---- sim_program.c: a project that was built to be watched ---- */

/* Counted, since the thread and the window let go of it at different times. */
struct sim_program {
	gatomicrefcount count;
	struct ladder *ladder;
	const struct program *program;
	char *text;              /* that it was built from                     */
};
/** sim_program_new - @file: interned, for diagnostics. Owns: sim_program_unref(). Any
 * thread. Fails: NULL, and @error is the first thing that is wrong with it. */
struct sim_program *sim_program_new(const char *file, const char *text, gsize len,
				    GError **error);
struct sim_program *sim_program_ref(struct sim_program *program);
void sim_program_unref(struct sim_program *program);
/** sim_program_is_same - do they run the same, and show the same? Texts may differ in what
 * an editor keeps for itself, such as bookmarks. */
bool sim_program_is_same(const struct sim_program *a, const struct sim_program *b);

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

/* What the window sees of the thread. */
struct sim_view {
	struct twin twin;        /* a clone: of `program`                      */
	struct sim_program *program, *plant;
	bool running;            /* not paused                                 */
	struct sim_refusal refusal;
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
/** sim_thread_lock - the record, which changes only with a program. */
const struct record *sim_thread_lock(struct sim_thread *thread);
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
/** sim_failed_words - which operation was the first to fail. Caller frees. */
char *sim_failed_words(const struct resource *resource);

#endif
