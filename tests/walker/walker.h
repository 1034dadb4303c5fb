/* SPDX-License-Identifier: MIT
 *
 * walker - a second, independent evaluator of ladder.
 *
 * It evaluates the grid of a project as docs/language.md defines it, slowly and simply:
 * with its own nets, timers, arithmetic and variables. It shares parsers and the
 * catalogue with the engine, but no evaluation. Only projects that ladder_build()
 * accepted may be walked.
 */
#ifndef WALKER_WALKER_H
#define WALKER_WALKER_H

#include "engine/model/project.h"

struct walker;

/* A value as the walker keeps it: r of REAL, d of LREAL, text
 * of STRING, i of all others. */
struct value {
	enum iec_type type;
	int64_t i;
	float r;
	double d;
	int len, room;       /* of a STRING: its bytes and capacity */
	char text[64];
};

/**
 * walker_new - all variables at their initial values
 * @project: borrowed; must have passed ladder_build(). Its names may grow.
 *
 * Owns: the caller, walker_free().
 * Fails: NULL when memory is out or the project has something it does not support; @why
 * gets a text.
 */
struct walker *walker_new(struct project *project, const char **why);
void walker_free(struct walker *walker);

/** walker_scan - one scan; false: it took more steps than allowed. */
bool walker_scan(struct walker *walker, int64_t now_ns);

/** walker_area - the bytes of an area; inputs are set here before a scan. */
uint8_t *walker_area(struct walker *walker, enum iec_area area);

/** walker_errors - number of operations that failed. */
uint32_t walker_errors(const struct walker *walker);

/* Declared variables, each pin of an instance as one of its own, in order of
 * declaration: "Motor", "Main.Motor", "Runout.Q". */
int walker_count(const struct walker *walker);
const char *walker_name(const struct walker *walker, int index);
struct value walker_value(const struct walker *walker, int index);
/** walker_is_settled - false for the input pin of a block that was never called: its
 * value is undefined. */
bool walker_is_settled(const struct walker *walker, int index);

enum walker_power { POWER_UNKNOWN, POWER_IN_ONLY, POWER_BOTH };
/**
 * walker_power - power of a cell, 1-based rung, row and column as drawn
 *
 * POWER_UNKNOWN when its rung did not run in the last scan or the cell carries none;
 * POWER_IN_ONLY for a cell that has no output by its kind, or did not act because a
 * jump came first.
 */
enum walker_power walker_power(const struct walker *walker, int pou, int rung,
			       int row, int col, bool *in, bool *out);
/** walker_instance - the block of which number @index is an instance, and its name, such
 * as "Line.Belt"; NULL: there are fewer. */
const struct pou *walker_instance(const struct walker *walker, int index,
				  const char **name);
/** walker_power_in - as walker_power, of a rung in the body of such an instance. */
enum walker_power walker_power_in(const struct walker *walker, int index, int rung,
				  int row, int col, bool *in, bool *out);
#endif
