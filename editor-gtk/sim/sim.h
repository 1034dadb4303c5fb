/* SPDX-License-Identifier: MIT
 *
 * sim - the simulation of a document: the engine of the board, run in a thread of its own.
 *
 * The thread scans, keeps time and records; it never waits for what is drawn. The window
 * sees copies: of the newest scan, or of one that was, when it is asked to show that. An
 * edit that builds takes the place of the program that runs, with its values; scans before
 * it are shown with the program that ran them.
 *
 * Signals:
 *   state-changed ()    mode, RUN or not, period, speed, record: what buttons show
 *   program-changed ()  another program runs, or is the one whose scan is shown: places of
 *                       variables are others
 *   shown ()            ladder_sim_twin() has other values; at most once a frame
 *   told (const char *text, gboolean bad)  for the log and the status bar
 */
#ifndef EDITOR_SIM_H
#define EDITOR_SIM_H

#include "editor-gtk/document/document.h"

#include "engine/trial/record.h"

#define LADDER_TYPE_SIM (ladder_sim_get_type())
G_DECLARE_FINAL_TYPE(LadderSim, ladder_sim, LADDER, SIM, GObject)

#define SIM_SCANS 100000            /* that can be looked at again             */
#define SIM_BYTES (100u << 20)      /* and what they may take                  */
#define SIM_PERIOD G_GINT64_CONSTANT(10000000)

/** ladder_sim_new - off. @document: referenced. */
LadderSim *ladder_sim_new(LadderDocument *document);
/** ladder_sim_document - what it simulates. Borrowed. */
LadderDocument *ladder_sim_document(LadderSim *sim);

/* ---- on and off ---- */

/** ladder_sim_begin - builds the program, and stands in STOP
 * Fails: false, and @error says why: the program has errors (the document's diagnostics are
 * those of this very text then), or memory is out. */
bool ladder_sim_begin(LadderSim *sim, GError **error);
/** ladder_sim_end - stops, and forgets program, values, record. */
void ladder_sim_end(LadderSim *sim);
bool ladder_sim_is_on(LadderSim *sim);
/** ladder_sim_set_plant - a program beside it, bound crosswise (trial/twin.h); the
 * simulation begins anew if it is on. @path: NULL: none. Fails: false, @error says why. */
bool ladder_sim_set_plant(LadderSim *sim, const char *path, GError **error);
/** ladder_sim_plant - its file; NULL: there is none. Borrowed. */
const char *ladder_sim_plant(LadderSim *sim);

/* ---- running; nothing of it while it is off ---- */

enum sim_state { SIM_OFF, SIM_STOP, SIM_RUN, SIM_PAUSE, SIM_FAULT };
enum sim_state ladder_sim_state(LadderSim *sim);
/** ladder_sim_run - from STOP, and a FAULT of the engine, a cold start; from PAUSE, and a
 * FAULT for an operation that failed, it goes on. */
void ladder_sim_run(LadderSim *sim);
/** ladder_sim_pause - time stands still; values stay. */
void ladder_sim_pause(LadderSim *sim);
/** ladder_sim_stop - outputs are safe. */
void ladder_sim_stop(LadderSim *sim);
/** ladder_sim_scan - pauses, and runs so many scans more; from STOP it starts first. */
void ladder_sim_scan(LadderSim *sim, int scans);
/** ladder_sim_reset - cold: values as they are declared; goes on as it was: RUN or PAUSE.
 * @warm: what is VAR RETAIN keeps its value. */
void ladder_sim_reset(LadderSim *sim, bool warm);

gint64 ladder_sim_period(LadderSim *sim);
/** ladder_sim_set_period - ns of program time from scan to scan, 100 us to 60 s. */
void ladder_sim_set_period(LadderSim *sim, gint64 ns);
double ladder_sim_speed(LadderSim *sim);
/** ladder_sim_set_speed - scans a second on the wall; 0: as the period says. */
void ladder_sim_set_speed(LadderSim *sim, double scans);
bool ladder_sim_heeds(LadderSim *sim);
/** ladder_sim_set_heeds - FAULT after the first scan of a start in which an operation failed,
 * such as a division by zero? That is told with its place; outputs read as 0 in it. It does
 * when nobody says so. On a board such an operation gives ENO FALSE, and scans go on; so do
 * they here, with outputs as the program left them, when ladder_sim_run() is called again,
 * in single scans, and in ladder_sim_play(). */
void ladder_sim_set_heeds(LadderSim *sim, bool heeds);

/** ladder_sim_act - what a person does between two scans; a copy of @act is made. Takes
 * effect at once, in STOP and PAUSE too, and ends the look at the past. What cannot be done
 * (no such place, one of a program before an edit) is told. */
void ladder_sim_act(LadderSim *sim, const struct act *act);

/** ladder_sim_release_all - of the program and of its plant, what ladder_sim_forces() counts. */
void ladder_sim_release_all(LadderSim *sim);

/* ---- from the beginning ---- */

/** ladder_sim_restart - begins anew with the program as it is now: scan 0, in STOP, nothing
 * set, nothing forced, nothing recorded. Tells program-changed. If it is off, it begins.
 * Fails: as ladder_sim_begin(); what ran goes on. */
bool ladder_sim_restart(LadderSim *sim, GError **error);

/* An act that is done again. */
struct sim_played {
	guint64 after;           /* the scan before it                          */
	struct act act;
	struct iec_text text;    /* of a STRING: what act.value.s says          */
};
/** ladder_sim_play - begins anew, does @acts (of struct sim_played, in their order) and
 * stands in PAUSE after scan @scans; all of them can be shown. What is told to it meanwhile
 * ends it there. Fails: as ladder_sim_restart(). */
bool ladder_sim_play(LadderSim *sim, gint64 period_ns, GArray *acts, guint64 scans,
		     GError **error);

/* How late scans were against the clock of the wall, while it ran. For measurements. */
struct sim_lateness { guint64 scans; double median_us, p99_us, worst_us; };
/** ladder_sim_lateness - since this was asked last. Fails: false: off, or no scan since. */
bool ladder_sim_lateness(LadderSim *sim, struct sim_lateness *out);

/* ---- what is shown ---- */

/** ladder_sim_twin - as it was after the scan that is shown. NULL: off. Borrowed until the
 * next `shown` or `program-changed`; to be read only. */
const struct twin *ladder_sim_twin(LadderSim *sim);
/** ladder_sim_ladder - what holds the project of the program whose scan is shown: the one
 * that runs, or one before an edit. NULL: off. Borrowed until `program-changed`. */
struct ladder *ladder_sim_ladder(LadderSim *sim);
/** ladder_sim_plant_ladder - likewise, of the plant; NULL: none. */
struct ladder *ladder_sim_plant_ladder(LadderSim *sim);
/** ladder_sim_rung - the rung of ladder_sim_ladder(), 0-based, that this one of @document
 * is; -1: it was changed since, or is new, or the scan that is shown is of a program before
 * an edit, and @document is not ladder_sim_older(). The POU is the same in both. */
int ladder_sim_rung(LadderSim *sim, LadderDocument *document, int pou, int rung);
/** ladder_sim_is_forced - is @at (of the program that runs) held? */
bool ladder_sim_is_forced(LadderSim *sim, struct location at);
/** ladder_sim_forces - how many places are held, those of the plant too. */
int ladder_sim_forces(LadderSim *sim);

/* ---- the past ---- */

/** ladder_sim_first, ladder_sim_last - scans that can be shown. */
guint64 ladder_sim_first(LadderSim *sim);
guint64 ladder_sim_last(LadderSim *sim);
/** ladder_sim_show - shows that very scan, while the simulation goes on (or stands) behind
 * it. False: the record does not reach there. */
bool ladder_sim_show(LadderSim *sim, guint64 scan);
/** ladder_sim_show_now - the newest again. */
void ladder_sim_show_now(LadderSim *sim);
bool ladder_sim_is_past(LadderSim *sim);
/** ladder_sim_lock_record - of the program that runs: the thread that scans waits as long as
 * it is held. NULL: off; then there is nothing to unlock. It is another one after an edit. */
const struct record *ladder_sim_lock_record(LadderSim *sim);
void ladder_sim_unlock_record(LadderSim *sim);

/* ---- programs before an edit ---- */

/* An edit while it simulated. */
struct sim_edited {
	guint64 scan;            /* the last one of the program before          */
	gint64 us;               /* when, as g_get_real_time()                 */
};
/** ladder_sim_next_edit - the first after that scan or later whose scans before are kept.
 * Fails: false: there is none. */
bool ladder_sim_next_edit(LadderSim *sim, guint64 scan, struct sim_edited *out);
/** ladder_sim_older - the program whose scan is shown, if another took its place since: a
 * fixed document, as it was; @edit gets what ended it. NULL: the one that runs is shown.
 * Borrowed until `program-changed`. */
LadderDocument *ladder_sim_older(LadderSim *sim, struct sim_edited *edit);
/** ladder_sim_life - another number whenever it begins anew, from scan 0. */
guint64 ladder_sim_life(LadderSim *sim);

/* Somebody who looks at scans, a little at a time, also over edits. */
struct sim_replay;
/** sim_replay_new - of no scan yet. Owns: sim_replay_free(). */
struct sim_replay *sim_replay_new(void);
void sim_replay_free(struct sim_replay *replay);
/** ladder_sim_replay - nearer to @scan: to where it can be had from, or one scan further.
 * Fails: false: that scan is not kept, or memory is out. */
bool ladder_sim_replay(LadderSim *sim, struct sim_replay *replay, guint64 scan);
/** sim_replay_twin - as it was after the scan where it stands; NULL: of none. Borrowed
 * until the next step. */
const struct twin *sim_replay_twin(const struct sim_replay *replay);
/** sim_replay_program - another number if places of variables are others; 0: of none. */
guint64 sim_replay_program(const struct sim_replay *replay);

#endif
