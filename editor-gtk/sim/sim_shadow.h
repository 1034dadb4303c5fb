/* SPDX-License-Identifier: MIT
 *
 * sim_shadow - the source of a simulation that shows another one in the words of a converted document.
 *
 * The document of the shadow was made from that of the simulation it follows: the same program in another
 * language. Its power and results are those of trial/shadow.h. It runs nothing of its own: what a person
 * sets or forces goes to the simulation that it follows.
 */
#ifndef EDITOR_SIM_SHADOW_H
#define EDITOR_SIM_SHADOW_H

#include "editor-gtk/sim/sim_source.h"

struct sim_shadow;

/**
 * ladder_sim_follow - @sim shows what @of shows, until ladder_sim_end()
 * @sim: of a document that was made from that of @of
 * @pou: of the document of @sim: the values that its text names are asked for
 *
 * @of is referenced. Does nothing while @of is off or shows a program before an edit: call it again when that
 * changes. Fails: false: that, or the document has errors.
 */
bool ladder_sim_follow(LadderSim *sim, LadderSim *of, int pou);

/** ladder_sim_program - the program whose scan is shown; NULL: off. Borrowed until `program-changed`. */
struct sim_program *ladder_sim_program(LadderSim *sim);

/** sim_shadow_new - for sim.c. @program: of the document of @sim, referenced; @notify: as of sim_thread_new(). */
struct sim_shadow *sim_shadow_new(LadderSim *sim, LadderSim *of, struct sim_program *program, int pou,
				  GSourceFunc notify);
/** sim_shadow_begin - looks for the first time; @notify is called. */
void sim_shadow_begin(struct sim_shadow *shadow);
struct sim_source *sim_shadow_source(struct sim_shadow *shadow);

#endif
