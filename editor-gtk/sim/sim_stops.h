/* SPDX-License-Identifier: MIT
 *
 * sim_stops - the breakpoints of a person in one program: lines, and conditions as formulas.
 */
#ifndef EDITOR_SIM_STOPS_H
#define EDITOR_SIM_STOPS_H

#include "editor-gtk/sim/breakpoints.h"
#include "editor-gtk/sim/sim_program.h"

#include "engine/trial/stops.h"

/* Lives in the thread of the simulation; the window makes it. */
struct sim_stops {
	struct sim_program *program;
	GArray *stop;            /* of struct sim_stop                         */
	struct arena arena;      /* of formulas                                */
};
struct sim_stop {
	guint32 pou, line;       /* as of stops_add()                          */
	struct formula *condition;
	const char *instance;    /* in the program                             */
	bool once;
};

/** sim_stops_new - @points in @program, whose text need not be that of @document. Owns:
 * sim_stops_free(). */
struct sim_stops *sim_stops_new(struct sim_program *program, LadderDocument *document,
				LadderBreakpoints *points);
void sim_stops_free(struct sim_stops *stops);
/** sim_stops_add - up to line @line, from 0, of the text of POU @pou; it is gone when it stands. False:
 * no statement is there or behind it. */
bool sim_stops_add(struct sim_stops *stops, LadderDocument *document, int pou, int line);
/** sim_stops_give - all of them to @to, which must not live longer. */
void sim_stops_give(const struct sim_stops *stops, struct stops *to);

/** sim_stops_line - the line, from 0, of the text of POU @pou of @document before which the program
 * stands for a breakpoint in line @line; -1: none is at or behind it. */
int sim_stops_line(struct sim_program *program, LadderDocument *document, int pou, int line);
/** sim_stops_shown - the line, from 0, of that text that line @line of the text of the program is;
 * -1: none. */
int sim_stops_shown(struct sim_program *program, LadderDocument *document, int pou, guint line);

/**
 * sim_stops_check - what is wrong with a condition in POU @pou of @document
 * @column: gets the byte of it, from 0; -1: none
 *
 * The checks of the program read it as the condition of an IF in the body. Caller frees. NULL:
 * nothing.
 */
char *sim_stops_check(LadderDocument *document, int pou, const char *condition, int *column);
#endif
