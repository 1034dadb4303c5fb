/* SPDX-License-Identifier: MIT
 *
 * sim_history - what a board has sent since the desk connected, so that it can be shown again.
 *
 * It stores states that came, and computes nothing: between two of them the values of the first
 * one stand. Bounded: the oldest states go first. One thread.
 */
#ifndef EDITOR_SIM_HISTORY_H
#define EDITOR_SIM_HISTORY_H

#include "engine/trial/twin.h"

#include <glib.h>

struct sim_history;
/** sim_history_new - empty, of twins of the size of @twin; holds at most @bytes. Owns:
 * sim_history_free(). */
struct sim_history *sim_history_new(const struct twin *twin, gsize bytes);
void sim_history_free(struct sim_history *history);
/** sim_history_add - the state of @twin, after its scan, which is not before the one added last.
 * Its plant is not stored. */
void sim_history_add(struct sim_history *history, const struct twin *twin);
/** sim_history_first, sim_history_last - scans; 0: nothing was added. */
guint64 sim_history_first(const struct sim_history *history);
guint64 sim_history_last(const struct sim_history *history);
/**
 * sim_history_seek - @twin gets the state that came last at @scan or before it
 * @at: where @twin is now: 0 at first, then as the call before left it
 *
 * Its scan is @scan then. Fails: false: @scan is not between first and last.
 */
bool sim_history_seek(const struct sim_history *history, guint64 *at, struct twin *twin,
		      guint64 scan);

#endif
