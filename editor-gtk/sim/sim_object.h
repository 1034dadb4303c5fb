/* SPDX-License-Identifier: MIT
 *
 * sim_object - what the files of LadderSim share: sim.c runs it, sim_past.c shows it.
 *
 * Private to them.
 */
#ifndef EDITOR_SIM_OBJECT_H
#define EDITOR_SIM_OBJECT_H

#include "editor-gtk/sim/sim_inside.h"

struct _LadderSim {
	GObject parent;
	LadderDocument *document;
	struct sim_rungs *rungs;
	struct sim_thread *thread;  /* NULL: off                               */
	struct sim_view view;       /* the newest                              */
	struct sim_replay *replay;  /* the past                                */
	bool past;
	LadderDocument *older;      /* of a program before an edit; NULL: none yet */
	guint64 older_era;          /* whose it is                             */
	guint64 life;               /* how often it began                      */
	guint refused;              /* of the view's refusal, that were told of */
	struct sim_events known;    /* of the view's, that were told of         */
	enum sim_state told;        /* the last state that signals told of     */
	gint64 told_period;         /* and period, ns                          */
	gint64 period_ns;
	double speed;
	bool heeds;                 /* FAULT when an operation fails           */
	char *plant_path;
	struct sim_program *plant;
	/* Another program is built: */
	struct sim_program *newest; /* that the thread was given last          */
	guint64 version;            /* of the document that the last one was of */
	bool building;
};

/** sim_forget_replay - now is shown, and nothing of the past is kept. */
void sim_forget_replay(LadderSim *sim);
/** sim_shown_program - whose scan is shown; NULL: off. Borrowed. */
struct sim_program *sim_shown_program(LadderSim *sim);
#endif
