/* SPDX-License-Identifier: MIT
 *
 * sim_program - a project that was built to be simulated, counted; places and faults of such
 * a program in words.
 */
#ifndef EDITOR_SIM_PROGRAM_H
#define EDITOR_SIM_PROGRAM_H

#include "editor-gtk/sim/sim.h"

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

/** sim_place_words - "Main, rung 2 (1,3)", "Main, line 7". Caller frees. */
char *sim_place_words(const struct fault_place *at);
/** sim_fault_words - "instruction budget exceeded: Main, rung 2 (1,3)". Caller frees. */
char *sim_fault_words(const struct resource *resource);

#endif
