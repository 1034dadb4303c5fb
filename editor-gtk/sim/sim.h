/* SPDX-License-Identifier: MIT
 *
 * sim - the simulation of a document: the engine of the board, run in a thread of its own; or
 * the mirror of a board (sim_mirror.h), whose values come from outside.
 *
 * The thread scans, keeps time and records; it never waits for drawing. The window reads
 * copies: of the newest scan, or of a scan of the past. A program that builds after an edit
 * replaces the one that runs and takes over its values; scans before the edit are shown with
 * the program that ran them.
 *
 * Signals:
 *   state-changed ()    state, period, speed, plant, board_speed or fault_on_error changed
 *   program-gone ()     the program was freed: forget the places of values, and ask
 *                       nobody. program-changed follows
 *   program-changed ()  another program runs, or ran the scan that is shown: places of
 *                       variables have changed
 *   shown ()            ladder_sim_twin() has new values; at most once a frame
 *   told (const char *text, gboolean bad)  for the log and the status bar
 *   refused (gpointer at, const char *why)  the value at a struct location was not set, forced or
 *                       released; for the view in which a person did that. `told` comes, too
 */
#ifndef EDITOR_SIM_H
#define EDITOR_SIM_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/document/task_rows.h"
#include "editor-gtk/sim/breakpoints.h"

#include "engine/trial/record.h"
#include "engine/trial/stops.h"

#define LADDER_TYPE_SIM (ladder_sim_get_type())
G_DECLARE_FINAL_TYPE(LadderSim, ladder_sim, LADDER, SIM, GObject)

#define SIM_SCANS 100000            /* that are recorded, at most              */
#define SIM_BYTES (100u << 20)      /* of all records, at most                 */
#define SIM_PERIOD TASKS_PERIOD_NS /* if no task has one                      */

/** ladder_sim_new - off. @document: referenced. */
LadderSim *ladder_sim_new(LadderDocument *document);
/** ladder_sim_document - borrowed. */
LadderDocument *ladder_sim_document(LadderSim *sim);

/* ---- on and off ---- */

/** ladder_sim_begin - builds the program and stands in STOP. Fails: false, and @error has the
 * first error of the program (all are in the document's diagnostics), or memory is out. */
bool ladder_sim_begin(LadderSim *sim, GError **error);
/** ladder_sim_end - stops, and drops program, values and record. */
void ladder_sim_end(LadderSim *sim);
bool ladder_sim_is_on(LadderSim *sim);
/** ladder_sim_board - the board whose values are shown, for people; NULL: it is a simulation, or
 * off. Borrowed until `state-changed`. */
const char *ladder_sim_board(LadderSim *sim);
/** ladder_sim_set_plant - simulates a second program, bound crosswise (trial/twin.h); begins
 * anew if the simulation is on. @path: NULL: no plant. Fails: false, and @error says why. */
bool ladder_sim_set_plant(LadderSim *sim, const char *path, GError **error);
/** ladder_sim_plant - the path of the plant; NULL: there is none. Borrowed. */
const char *ladder_sim_plant(LadderSim *sim);

/** ladder_sim_foresee - builds a text in a thread that the document is likely to get next, so that the
 * program is ready when it has it. Does nothing while the simulation is off or builds.
 * @text: of the whole document; taken, NULL: unknown */
void ladder_sim_foresee(LadderSim *sim, char *text);
/** ladder_sim_is_building - builds a thread an edit, or a text that was foreseen? */
bool ladder_sim_is_building(LadderSim *sim);

/** ladder_sim_build - the document as a program (sim_program.h). Owns: sim_program_unref(). Fails:
 * NULL: as ladder_sim_begin(). */
struct sim_program *ladder_sim_build(LadderSim *sim, GError **error);

/** ladder_sim_late - ns that the values of the board are behind it; 0: not worth to be said, or a
 * simulation. Changes with `state-changed`. */
gint64 ladder_sim_late(LadderSim *sim);

/** ladder_sim_play_recording - shows a record of a board, made by `ladder board … record`, instead
 * of a simulation, in PAUSE. Fails: false, and @error says why: it cannot be read, the program of
 * the document is not the one that was recorded, or a board is shown. */
bool ladder_sim_play_recording(LadderSim *sim, const char *path, GError **error);
/** ladder_sim_is_recording - whether ladder_sim_board() is one whose recording is shown. */
bool ladder_sim_is_recording(LadderSim *sim);

/* ---- running; these do nothing while it is off ---- */

enum sim_state { SIM_OFF, SIM_STOP, SIM_RUN, SIM_PAUSE, SIM_FAULT };
enum sim_state ladder_sim_state(LadderSim *sim);
/** ladder_sim_run - a cold start from STOP and from a FAULT of the engine; continues from PAUSE
 * and from a FAULT for a failed operation. */
void ladder_sim_run(LadderSim *sim);
/** ladder_sim_pause - time stands still; values stay. */
void ladder_sim_pause(LadderSim *sim);
/** ladder_sim_stop - outputs get their safe values. */
void ladder_sim_stop(LadderSim *sim);
/** ladder_sim_scan - pauses and runs @scans scans; from STOP with a cold start first. */
void ladder_sim_scan(LadderSim *sim, int scans);
/** ladder_sim_reset - initial values; RUN or PAUSE stays. @warm: VAR RETAIN keeps its values. */
void ladder_sim_reset(LadderSim *sim, bool warm);

/* What a person may want. A board does not do everything that a simulation does, and not for
 * everybody. */
enum sim_wish {
	SIM_WISH_RUN,            /* Run, Stop, cold and warm start               */
	SIM_WISH_TIME,           /* pause, single scans, period, speed           */
	SIM_WISH_RESTART,        /* from scan 0: restart, play; a plant          */
	SIM_WISH_SET, SIM_WISH_FORCE, /* a value; force, release                 */
};
/** ladder_sim_why_not - why a person cannot do this now; NULL: it can be tried, or the
 * simulation is off. What is done although there is a reason does nothing, and the reason is
 * told. Translated; lives for ever. */
const char *ladder_sim_why_not(LadderSim *sim, enum sim_wish wish);

gint64 ladder_sim_period(LadderSim *sim);
/** ladder_sim_set_period - ns of program time from scan to scan, 100 us to 60 s. */
void ladder_sim_set_period(LadderSim *sim, gint64 ns);
guint64 ladder_sim_board_speed(LadderSim *sim);
/** ladder_sim_set_board_speed - @words of instructions a millisecond that a board runs, see
 * trial/pace.h; 0, as at first: scans take no time. */
void ladder_sim_set_board_speed(LadderSim *sim, guint64 words);
double ladder_sim_speed(LadderSim *sim);
/** ladder_sim_set_speed - scans per second of real time; 0: as the period says. */
void ladder_sim_set_speed(LadderSim *sim, double scans);
bool ladder_sim_fault_on_error(LadderSim *sim);
/** ladder_sim_set_fault_on_error - default true: the first failed operation of a start, such as
 * a division by zero, is a FAULT. Its place is told, and outputs read as 0.
 * If false, and after the next ladder_sim_run(), and always in single scans and in
 * ladder_sim_play(): as on a board, ENO is FALSE, scans continue, outputs stay. */
void ladder_sim_set_fault_on_error(LadderSim *sim, bool fault);

/** ladder_sim_act - does @act (copied) between two scans, at once, also in STOP and PAUSE, and
 * shows the newest scan. An act that cannot be done (no such place, or a place of a program
 * before an edit) is told. */
void ladder_sim_act(LadderSim *sim, const struct act *act);
/** ladder_sim_act_all - does ACT_SETs of variables of the program (or of the plant) between the
 * same two scans; a board does all or none, and no more than 128. @count 0: nothing. */
void ladder_sim_act_all(LadderSim *sim, const struct act *acts, int count);
/** ladder_sim_release_all - all forces of the program and of the plant. */
void ladder_sim_release_all(LadderSim *sim);

/* ---- breakpoints and steps; of a simulation, not of a board ---- */

/** ladder_sim_breakpoints - those of the person, also while it is off. Borrowed. */
LadderBreakpoints *ladder_sim_breakpoints(LadderSim *sim);
/** ladder_sim_hold_stops - they do not follow the changes of the document: a sheet of text moves them;
 * false: it has done so. */
void ladder_sim_hold_stops(LadderSim *sim, bool hold);
/** ladder_sim_step - goes on from where it stands; else with the next scan, from STOP with a cold
 * start. */
void ladder_sim_step(LadderSim *sim, enum stops_step step);
/** ladder_sim_run_to - goes on up to line @line, from 0, of the text of POU @pou of the document, or
 * to a breakpoint. Fails: false, and it does nothing: no statement is there or behind it. */
bool ladder_sim_run_to(LadderSim *sim, int pou, int line);
/** ladder_sim_stack - the body that stands in the middle of a scan, then who called it; *count of
 * them. NULL: it does not stand, or another scan is shown. Borrowed until `shown`. */
const struct stops_frame *ladder_sim_stack(LadderSim *sim, int *count);
/** ladder_sim_stack_line - the line, from 0, of the text of *pou of the document where @frame is; -1:
 * of a rung, or not in the document. *pou: -1: not in the document. */
int ladder_sim_stack_line(LadderSim *sim, const struct stops_frame *frame, int *pou);
/** ladder_sim_reached - the line, likewise, before which it stands for a breakpoint in line @line;
 * -1: none. @line itself while no simulation is on. */
int ladder_sim_reached(LadderSim *sim, int pou, int line);
/** ladder_sim_outside - a value of the scan that is shown, as others see it: while the program stands
 * in a scan, outputs are those of the scan before. */
union iec_value ladder_sim_outside(LadderSim *sim, struct location at);

/* ---- from the beginning ---- */

/** ladder_sim_restart - begins with the program as it is now: scan 0, in STOP, no value set or
 * forced, no record. Emits program-changed. Begins if it is off. Fails: as ladder_sim_begin();
 * the program that ran continues. */
bool ladder_sim_restart(LadderSim *sim, GError **error);

/* An act to be repeated. */
struct sim_played {
	guint64 after;           /* the scan before it                          */
	struct act act;
	struct iec_text text;    /* of a STRING: replaces act.value.s           */
};
/** ladder_sim_play - begins anew, does @acts (of struct sim_played, in order) and pauses after
 * scan @scans; all these scans can be shown. Any order given meanwhile ends it. Fails: as
 * ladder_sim_restart(). */
bool ladder_sim_play(LadderSim *sim, gint64 period_ns, guint64 speed, GArray *acts,
		     guint64 scans, GError **error);

#define SIM_LATE_STEPS 320 /* up to hours */
/* How many scans began how late in real time, in steps of 6 %. */
struct sim_lateness { guint count[SIM_LATE_STEPS]; };
/** ladder_sim_lateness - of all scans in RUN since the program was started. Fails: false: it is off. */
bool ladder_sim_lateness(LadderSim *sim, struct sim_lateness *out);
/** sim_lateness_scans - how many scans that were. */
guint64 sim_lateness_scans(const struct sim_lateness *late);
/** sim_lateness_us - the lateness that @part of the scans, up to 1, do not exceed; 0: there are none. */
double sim_lateness_us(const struct sim_lateness *late, double part);
/* What a scan takes on this machine, of the same scans, to 6 %. */
struct sim_cost {
	guint64 scans;
	gint64 usual_ns, most_ns; /* half of them take no longer; none does */
};
/** ladder_sim_cost - fails: false: the simulation is off, or no scan was in RUN. */
bool ladder_sim_cost(LadderSim *sim, struct sim_cost *out);

/* ---- the scan that is shown ---- */

/** ladder_sim_twin - the state after the scan that is shown. NULL: off. Read only; borrowed
 * until the next `shown` or `program-changed`. */
const struct twin *ladder_sim_twin(LadderSim *sim);
/** ladder_sim_ladder - has the project of the program whose scan is shown: the one that runs, or
 * one before an edit. NULL: off. Borrowed until `program-changed`. */
struct ladder *ladder_sim_ladder(LadderSim *sim);
/** ladder_sim_text - the text of that program: the lines of its project count in it. NULL: off.
 * Borrowed as ladder_sim_ladder(). */
const char *ladder_sim_text(LadderSim *sim);
/** ladder_sim_plant_ladder - the same, of the plant; NULL: none. */
struct ladder *ladder_sim_plant_ladder(LadderSim *sim);
/** ladder_sim_rung - which rung of that POU of ladder_sim_ladder() (ladder_sim_pou()) rung
 * @rung of POU @pou of @document is; all 0-based. -1: it is new or was changed since, or @document is not the one of the scan that is
 * shown. */
int ladder_sim_rung(LadderSim *sim, LadderDocument *document, int pou, int rung);
/** ladder_sim_pou - which POU of ladder_sim_ladder() POU @pou of @document is; -1: none. */
int ladder_sim_pou(LadderSim *sim, LadderDocument *document, int pou);
/* Parts of a project that are no POU. */
enum sim_part { SIM_SYMBOLS = -1, SIM_TYPES = -2, SIM_TASKS = -3 };
/** ladder_sim_is_missing - whether the board runs without rung @rung of POU @pou of the document:
 * it is new, or was changed since the download. False in a simulation: it takes each edit.
 * @rung: -1: without any part of the POU as it is, or of enum sim_part @pou. Of rungs it is known
 * at once, of all else after the next check. Changes with `program-changed`. */
bool ladder_sim_is_missing(LadderSim *sim, LadderDocument *document, int pou, int rung);
/** ladder_sim_runs_all_of - whether POU @pou of the document, and all that it may use, run as they are: types, functions and
 * blocks. */
bool ladder_sim_runs_all_of(LadderSim *sim, LadderDocument *document, int pou);
/** ladder_sim_may_miss - whether there is a board that could be without something. */
bool ladder_sim_may_miss(LadderSim *sim);
/** ladder_sim_knows - whether the value at @at is that of the scan; false: the board does not send
 * it yet, and is asked to. Then `program-changed` comes with it. */
bool ladder_sim_knows(LadderSim *sim, struct location at);
/* How good the value of an input or output is, as the board says. STALE: it has had no new one for the time of
 * the I/O map; FAULT: its device is gone, answers with errors, or measures what cannot be. */
/* SIM_FORCED: of the timing chart only, which has no other mark for it. */
enum sim_quality { SIM_GOOD, SIM_STALE, SIM_VALUE_FAULT, SIM_FORCED };
/** ladder_sim_quality - at the scan that is shown: as the board says or has recorded it; in a simulation as the
 * inputs of the driver `quality` of the I/O map say. */
enum sim_quality ladder_sim_quality(LadderSim *sim, struct location at);
/** ladder_sim_has_power - the same of the power of the cells of a program or of an instance. */
bool ladder_sim_has_power(LadderSim *sim, const char *unit);
/** ladder_sim_forces - how many variables are forced, those of the plant included. */
int ladder_sim_forces(LadderSim *sim);

/* ---- the past ---- */

/** ladder_sim_first, ladder_sim_last - the scans that can be shown. */
guint64 ladder_sim_first(LadderSim *sim);
guint64 ladder_sim_last(LadderSim *sim);
/** ladder_sim_computed - those of which all is known, also which tasks ran: of a simulation all, of
 * a board those that it recorded and ladder_sim_fetch() has got. False: there are none. */
bool ladder_sim_computed(LadderSim *sim, guint64 *first, guint64 *last);
/** ladder_sim_fetch - gets what a board recorded, if it is a board; `shown` comes later. */
void ladder_sim_fetch(LadderSim *sim);
/** ladder_sim_show - shows that scan; the simulation is not stopped. False: it is not recorded. */
bool ladder_sim_show(LadderSim *sim, guint64 scan);
/** ladder_sim_show_now - shows the newest scan again. */
void ladder_sim_show_now(LadderSim *sim);
bool ladder_sim_is_past(LadderSim *sim);
/** ladder_sim_lock_record - of the program that runs; the thread waits until
 * ladder_sim_unlock_record(). An edit begins another record. NULL: off, nothing to unlock. */
const struct record *ladder_sim_lock_record(LadderSim *sim);
void ladder_sim_unlock_record(LadderSim *sim);

/* ---- programs before an edit ---- */

/* An edit during the simulation. */
struct sim_edited {
	guint64 scan;            /* the last one of the program before it       */
	gint64 us;               /* when, as g_get_real_time()                 */
};
/** ladder_sim_next_edit - the first edit at that scan or later, if scans before it are recorded.
 * Fails: false: there is none. */
bool ladder_sim_next_edit(LadderSim *sim, guint64 scan, struct sim_edited *out);
/** ladder_sim_older - a read-only document of the program whose scan is shown, if an edit
 * replaced that program; @edit gets the edit. NULL: it is the program that runs. Borrowed until
 * `program-changed`. */
LadderDocument *ladder_sim_older(LadderSim *sim, struct sim_edited *edit);
/** ladder_sim_life - changes whenever the simulation begins anew, from scan 0. */
guint64 ladder_sim_life(LadderSim *sim);

/* Reads recorded scans one after the other, across edits, beside the one that is shown. */
struct sim_replay;
/** sim_replay_new - of no scan yet. Owns: sim_replay_free(). */
struct sim_replay *sim_replay_new(void);
void sim_replay_free(struct sim_replay *replay);
/** ladder_sim_replay - moves @replay nearer to @scan: to the nearest state that is recorded, or
 * one scan further. Fails: false: that scan is not recorded, or memory is out. */
bool ladder_sim_replay(LadderSim *sim, struct sim_replay *replay, guint64 scan);
/** sim_replay_twin - the state after its scan; NULL: of none. Borrowed until the next step. */
const struct twin *sim_replay_twin(const struct sim_replay *replay);
/** ladder_sim_replay_quality - of a place in the twin of @replay, as ladder_sim_quality(). */
enum sim_quality ladder_sim_replay_quality(LadderSim *sim, const struct sim_replay *replay, struct location at);
/** sim_replay_program - changes with the places of variables; 0: of no program. */
guint64 sim_replay_program(const struct sim_replay *replay);

#endif
