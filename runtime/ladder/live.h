/* SPDX-License-Identifier: MIT
 *
 * live - the live table of `ladder run`, and when scans are due, with or without the table.
 */
#ifndef LADDER_LIVE_H
#define LADDER_LIVE_H

#include "ladder/board.h"

/* When scans are due. Program time always advances by whole periods; on a machine that is
 * too slow it advances more slowly than real time. */
struct pace {
	int64_t period_ns;   /* in program time                              */
	double speed;        /* program time per real time                   */
	double wall_period_ns; /* in real time: period / speed               */
	int64_t wall_start_ns; /* real time of tick 0                        */
	double ticks;        /* periods since wall_start_ns                  */
	int64_t now_ns;      /* program time of the last scan                */
	uint64_t scans, most; /* most 0: no end                              */
};

/** pace_start - the next scan is one period from now. */
void pace_start(struct pace *pace, int64_t wall_ns);
/** pace_wait - ns until the next scan is due; 0 or less: now. */
int64_t pace_wait(struct pace *pace, int64_t wall_ns);
/** pace_step - counts a scan and returns its program time. */
int64_t pace_step(struct pace *pace);
/** pace_is_over - whether --scans scans have run. */
bool pace_is_over(const struct pace *pace);

/**
 * live_run - runs and shows the program until q, a signal or the last scan
 * @project: NULL for a code image
 * @rungs:   rungs to draw with their power (rungs_show()); NULL: variables instead
 */
enum status live_run(struct call *call, struct board *board, struct pace *pace,
		     const struct project *project, const char *rungs);
#endif
