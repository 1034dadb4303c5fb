/* SPDX-License-Identifier: MIT
 *
 * sim_mirror - the source of a simulation that shows a board: a twin whose values come from
 * outside.
 *
 * It scans nothing and knows no link. The caller (online/board_values) tells what the board has
 * published; views that need more say so, and the caller is called to ask the board for it.
 * One thread: that of the window.
 */
#ifndef EDITOR_SIM_MIRROR_H
#define EDITOR_SIM_MIRROR_H

#include "editor-gtk/sim/sim_source.h"

#include "engine/trial/record_file.h"

/* A board as its mirror knows it. */
struct sim_board {
	const char *name;              /* for people; copied                   */
	struct sim_program *program;   /* what it runs; referenced             */
	gint64 period_ns;
	/* Acts of a person: a value, a force, a release, a mode; or some values for the same
	 * moment between two scans. @acts is borrowed. */
	void (*act)(gpointer data, const struct act *acts, int count);
	/* As ladder_sim_why_not(). */
	const char *(*why_not)(gpointer data, enum sim_wish wish);
	/* A view needs a value or power that does not come: ask again for
	 * sim_mirror_places(), sim_mirror_units(). Soon after the need, once for many. */
	void (*wanted)(gpointer data);
	/* A view needs whole scans: sim_mirror_record() may be called, now or later. */
	void (*past)(gpointer data);
	gpointer data;
};

struct sim_mirror;
/** ladder_sim_mirror_begin - @sim shows the board from the first sim_mirror_moment() on; until
 * then it is off. Ends what ran before. Borrowed until ladder_sim_end(). */
struct sim_mirror *ladder_sim_mirror_begin(LadderSim *sim, const struct sim_board *board);
/** ladder_sim_mirror_refuse - tells that the board did not do an act. @at: of its value; type
 * IEC_NONE: of none. */
void ladder_sim_mirror_refuse(LadderSim *sim, struct location at, const char *why);
/** ladder_sim_mirror_forces - what ladder_sim_forces() says: how many the board has, those that it
 * does not publish included. */
void ladder_sim_mirror_forces(LadderSim *sim, int count);

/** ladder_sim_mirror_late - what ladder_sim_late() says. */
void ladder_sim_mirror_late(LadderSim *sim, gint64 ns);

/** sim_mirror_new - for sim.c. @notify: as of sim_thread_new(). */
struct sim_mirror *sim_mirror_new(const struct sim_board *board, GSourceFunc notify,
				  gpointer data);
struct sim_source *sim_mirror_source(struct sim_mirror *mirror);
const char *sim_mirror_name(const struct sim_mirror *mirror);
/** sim_mirror_forces - as the board counts them; -1: not known yet, or it is a recording. */
int sim_mirror_forces(const struct sim_mirror *mirror);
/** sim_mirror_set_forces - whether the count is another one now. */
bool sim_mirror_set_forces(struct sim_mirror *mirror, int count);

/* ---- choosing the published variables ---- */

/** sim_mirror_places - at most @most variables, of struct location: first those that views need,
 * then the others in the order of the program. *all: there are no more. Caller: g_array_unref. */
GArray *sim_mirror_places(struct sim_mirror *mirror, guint most, bool *all);
/** sim_mirror_units - names of programs and instances whose cells have power, likewise. The names
 * live with the program. Caller: g_ptr_array_unref. */
GPtrArray *sim_mirror_units(struct sim_mirror *mirror, guint most);
/** sim_mirror_cells - how many cells a unit has; 0: none, or no such unit. */
guint sim_mirror_cells(const struct sim_mirror *mirror, const char *unit);
/** sim_mirror_forget - no value is known any more: other variables will be published. Old values
 * stand until new ones come. */
void sim_mirror_forget(struct sim_mirror *mirror);
/** sim_mirror_forget_power - likewise of the cells of one unit. */
void sim_mirror_forget_power(struct sim_mirror *mirror, const char *unit);

/* ---- reading published values ---- */

/** sim_mirror_value - the value of a variable; a STRING may be too long for its room. */
void sim_mirror_value(struct sim_mirror *mirror, struct location at, bool forced, enum sim_quality quality,
		      union iec_value value);
/** sim_mirror_power - two bits a cell, as docs/online.md has them. @bits: of all its cells. */
void sim_mirror_power(struct sim_mirror *mirror, const char *unit, const guint8 *bits);
/* State of the board when these values were right. */
struct sim_moment {
	enum resource_state state;
	guint64 scan;
	gint64 now_ns;           /* of the board's clock                       */
};
/** sim_mirror_moment - ends a message: what came before it is shown. */
void sim_mirror_moment(struct sim_mirror *mirror, const struct sim_moment *moment);
/** sim_mirror_record - what the board itself recorded of this program since its last start: each
 * scan is computed again, also those before the desk connected. @file: taken over. */
void sim_mirror_record(struct sim_mirror *mirror, struct record_file *file);
/** sim_mirror_computed - the scans of that record, as they are numbered here. False: there are none. */
bool sim_mirror_computed(const struct sim_mirror *mirror, guint64 *first, guint64 *last);
/** sim_mirror_play - shows a recording alone, without a board: all of its scans, the last one
 * first. @file: taken over. Fails: false: no memory. */
bool sim_mirror_play(struct sim_mirror *mirror, struct record_file *file);
/** sim_mirror_plays - whether it does. */
bool sim_mirror_plays(const struct sim_mirror *mirror);
/** sim_mirror_period - the board scans with another period. */
void sim_mirror_period(struct sim_mirror *mirror, gint64 ns);
/** sim_mirror_task - how often task @task of the program has run, and was left out. */
void sim_mirror_task(struct sim_mirror *mirror, guint task, guint64 runs, guint64 missed);

#endif
