/* SPDX-License-Identifier: MIT
 *
 * scenario_record - records acts of a person in the simulation, and expected values.
 *
 * It begins with a cold start and reads the acts from the simulation's record. A force, a
 * restart, a stop, another period and an edit of the program end it, because a scenario cannot
 * contain them; what was recorded before stays. It opens no dialog and writes no file.
 *
 * Signals:
 *   changed ()   it began or ended, or has more acts or expectations
 *   ended (const char *why)  why it ended by itself; NULL: ladder_recorder_end()
 */
#ifndef EDITOR_SCENARIO_RECORD_H
#define EDITOR_SCENARIO_RECORD_H

#include "editor-gtk/sim/sim.h"

#define LADDER_TYPE_RECORDER (ladder_recorder_get_type())
G_DECLARE_FINAL_TYPE(LadderRecorder, ladder_recorder, LADDER, RECORDER, GObject)

LadderRecorder *ladder_recorder_new(LadderSim *sim);

/** ladder_recorder_begin - begins the simulation anew, and records; it runs, or stands in
 * PAUSE if it stood there. Fails: as ladder_sim_restart(). */
bool ladder_recorder_begin(LadderRecorder *recorder, GError **error);
void ladder_recorder_end(LadderRecorder *recorder);
bool ladder_recorder_is_on(LadderRecorder *recorder);
/** ladder_recorder_acts, ladder_recorder_expects - how many there are, until the next
 * begin. */
int ladder_recorder_acts(LadderRecorder *recorder);
int ladder_recorder_expects(LadderRecorder *recorder);

/**
 * ladder_recorder_expect - the variable is to have the value that it is shown with, at the
 * scan that is shown
 * @name: as trial/value.h finds it; @said: gets "Motor = 1", or why it cannot be; caller
 * frees
 */
bool ladder_recorder_expect(LadderRecorder *recorder, const char *name, char **said);
/** ladder_recorder_expect_outputs - all outputs that the program declares, as they were
 * after the last scan; returns how many. */
int ladder_recorder_expect_outputs(LadderRecorder *recorder);

/** ladder_recorder_text - the scenario; NULL: nothing is expected, or out of memory. Caller
 * frees. */
char *ladder_recorder_text(LadderRecorder *recorder, const char *name);

#endif
