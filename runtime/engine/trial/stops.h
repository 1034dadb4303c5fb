/* SPDX-License-Identifier: MIT
 *
 * stops - breakpoints and single steps of a simulation: it stands before a statement of Structured
 * Text, in the middle of a scan.
 *
 * Only programs that keep results of lists (ladder_watch_lists()) have places for it. While it
 * stands, time stands and nobody else sees outputs; variables may be read and set. A scan that stood
 * gives what it would have given without. A board has none of this.
 */
#ifndef TRIAL_STOPS_H
#define TRIAL_STOPS_H

#include "engine/trial/twin.h"

struct formula;

enum stops_step {
	STOPS_GO,              /* up to the next breakpoint                   */
	STOPS_INTO,            /* up to the next statement, also of what is called */
	STOPS_OVER,            /* likewise, not of what is called             */
	STOPS_OUT,             /* up to the next one behind the call of this body */
	STOPS_LEAVE,           /* to the end of the scan, past all breakpoints */
};

struct stops;

/** stops_new - without breakpoints. @program: borrowed. Owns: stops_free(). Scan-safe: no. Fails:
 * NULL: no memory. */
struct stops *stops_new(const struct program *program);
void stops_free(struct stops *stops);

/** stops_line - the line of the file of the first statement at or behind line @line before which a
 * body can stand; 0: none.
 * @pou: index in CODE_PROGRAMS   Scan-safe: no. */
uint32_t stops_line(const struct program *program, uint32_t pou, uint32_t line);

/** stops_clear - no breakpoints. Scan-safe: yes. */
void stops_clear(struct stops *stops);
/**
 * stops_add - a breakpoint before the first statement of a line
 * @line: as stops_line() gives it
 * @condition: a BOOL; borrowed. It stands only while that is TRUE, or cannot be computed. NULL: always
 * @instance: of a function block, whose variables @condition reads; borrowed. NULL: any
 * @once: it is gone as soon as it stands anywhere
 * Scan-safe: no. Fails: false: no statement begins in that line, or no memory.
 */
bool stops_add(struct stops *stops, uint32_t pou, uint32_t line, struct formula *condition,
	       const char *instance, bool once);

/**
 * stops_scan - as twin_scan(), or goes on with a scan of @twin that stands
 * @twin: of the same program
 *
 * If it stands afterwards, resource.stopped is set: then only this function and twin_act() of values
 * may change the twin. Scan-safe: as twin_scan().
 * Fails: false: likewise.
 */
bool stops_scan(struct stops *stops, struct twin *twin, enum stops_step step);

/* Where a body stands, or waits for what it called. */
struct stops_frame {
	uint32_t pou;          /* index in CODE_PROGRAMS                      */
	struct fault_place at; /* its line, or its rung; at.col: also of a statement in a line */
	char instance[80];     /* of a function block: "Line.Belt1"; "": none */
	uint32_t kept, frame, size; /* its bytes in m, which are at `frame` while it runs */
};
/** stops_stack - the body that stands first, then who called it. @out: LIMIT_CALLS + 1. Returns how
 * many; 0: @twin does not stand. Scan-safe: no. */
int stops_stack(struct stops *stops, const struct twin *twin, struct stops_frame *out);
/** stops_act - twin_act() of a value, which a body that runs sees at once. As twin_act(). */
bool stops_act(struct stops *stops, struct twin *twin, const struct act *act);
/** stops_show - @copy of @twin gets the values that instances have now. Scan-safe: no. */
void stops_show(struct stops *stops, const struct twin *twin, struct twin *copy);
#endif
