/* SPDX-License-Identifier: MIT
 *
 * live - the live table of `ladder run`, and the pace that both its forms keep.
 */
#ifndef LADDER_LIVE_H
#define LADDER_LIVE_H

#include "ladder/board.h"

/* When scans are due. Program time stands on the grid of the period, whatever
 * the clock on the wall does: when the machine cannot keep up, it goes slower. */
struct pace {
	int64_t period_ns;   /* of program time                              */
	double speed;        /* of the wall's time                           */
	double wall_period_ns; /* the same on the wall: period / speed       */
	int64_t wall_start_ns; /* of the grid below                          */
	double ticks;        /* periods since then                           */
	int64_t now_ns;      /* program time of the last scan                */
	uint64_t scans, most; /* most 0: no end                              */
};

/** pace_start - the next scan is one period from now. */
void pace_start(struct pace *pace, int64_t wall_ns);
/** pace_wait - ns until the next scan is due; 0 or less: now. */
int64_t pace_wait(struct pace *pace, int64_t wall_ns);
/** pace_step - the time of the scan that is run now. */
int64_t pace_step(struct pace *pace);
/** pace_is_over - were --scans scans run? */
bool pace_is_over(const struct pace *pace);

/**
 * live_run - until q, a signal or the last scan
 * @project: NULL: of an image
 * @rungs:   to draw with their power, as rungs_show(); NULL: variables instead
 */
enum status live_run(struct call *call, struct board *board, struct pace *pace,
		     const struct project *project, const char *rungs);
#endif
