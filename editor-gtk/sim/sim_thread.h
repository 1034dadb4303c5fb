/* SPDX-License-Identifier: MIT
 *
 * sim_thread - the thread that scans and records, and hands out copies.
 */
#ifndef EDITOR_SIM_THREAD_H
#define EDITOR_SIM_THREAD_H

#include "editor-gtk/sim/sim_source.h"
#include "editor-gtk/sim/sim_stops.h"

struct sim_thread;
/** sim_thread_source - as the source of a simulation. Lives as long as @thread. */
struct sim_source *sim_thread_source(struct sim_thread *thread);

/**
 * sim_thread_new - in STOP, with a record
 * @program, @plant: referenced; @plant NULL: none
 * @speed: of the board, as ACT_SPEED has it
 * @notify: called in the main context when sim_thread_take() has something new; @data borrowed
 * Owns: sim_thread_free(), which waits for its end. Fails: NULL: no memory.
 */
struct sim_thread *sim_thread_new(struct sim_program *program, struct sim_program *plant,
				  gint64 period_ns, guint64 speed, GSourceFunc notify,
				  gpointer data);
void sim_thread_free(struct sim_thread *thread);

void sim_thread_run(struct sim_thread *thread, bool run);
void sim_thread_scan(struct sim_thread *thread, int scans);
void sim_thread_speed(struct sim_thread *thread, double scans);
/** sim_thread_fault_on_error - as ladder_sim_set_fault_on_error(). */
void sim_thread_fault_on_error(struct sim_thread *thread, bool fault);
/** sim_thread_play - as ladder_sim_play(); @acts: referenced. */
void sim_thread_play(struct sim_thread *thread, GArray *acts, guint64 scans);
/** sim_thread_stops - the breakpoints from now on; taken over. Those of another program than the one
 * that runs are dropped. */
void sim_thread_stops(struct sim_thread *thread, struct sim_stops *stops);
/** sim_thread_step - goes on, from where it stands in a scan or from the next scan on. */
void sim_thread_step(struct sim_thread *thread, enum stops_step step);
/** sim_thread_change - @program (referenced) replaces the one that runs. */
void sim_thread_change(struct sim_thread *thread, struct sim_program *program);

/** sim_thread_lateness - as ladder_sim_lateness(). */
void sim_thread_lateness(struct sim_thread *thread, struct sim_lateness *out);
/** sim_thread_cost - as ladder_sim_cost(). */
void sim_thread_cost(struct sim_thread *thread, struct sim_cost *out);

#endif
