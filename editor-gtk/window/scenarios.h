/* SPDX-License-Identifier: MIT
 *
 * scenarios - scenarios in the window: recording, saving a recording, running all, going to
 * a failure.
 */
#ifndef EDITOR_SCENARIOS_H
#define EDITOR_SCENARIOS_H

#include "editor-gtk/sim/scenario_record.h"
#include "editor-gtk/window/sim_bar.h"

struct scenarios {
	struct core *core;
	struct origin *origin;
	struct sim_bar *sim_bar;
	LadderRecorder *recorder;
	GtkButton *record_button;
};

void scenarios_init(struct scenarios *scenarios, struct core *core, struct origin *origin,
		    struct sim_bar *sim_bar);
void scenarios_clear(struct scenarios *scenarios);
/** scenarios_do - does a command for scenarios; false: @verb is none. */
bool scenarios_do(struct scenarios *scenarios, enum verb verb);
/** scenarios_expect - while recording: expects the current value of that variable. */
void scenarios_expect(struct scenarios *scenarios, const char *name);

#endif
