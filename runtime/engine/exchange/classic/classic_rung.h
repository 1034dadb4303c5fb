/* SPDX-License-Identifier: MIT
 *
 * classic_rung - a ClassicLadder project as the text of a rung file.
 *
 * Each rung does in each scan what it does in ClassicLadder. A rung whose columns depend on
 * one another becomes several. trial/classic_name.h finds variables by their old names. This
 * code reads no files and checks nothing: the reader of rung files reads its text.
 */
#ifndef CLASSIC_RUNG_H
#define CLASSIC_RUNG_H

#include "engine/exchange/classic/classic.h"

struct classic_options {
	bool faithful;      /* repeat faults of ClassicLadder                       */
	bool task;          /* write a CONFIGURATION with the period; else declare all blocks */
};

struct classic_text {
	char *text;         /* ends with a NUL                                      */
	size_t len;
	struct classic_place *place; /* of each line of the text, from 1 on         */
	int lines;
};

/**
 * classic_to_rung - the text, and the place in the project of each line of it
 * @report: gets what was taken, changed and lost
 *
 * Owns: @arena.   Scan-safe: no.   Fails: false when memory is out.
 */
bool classic_to_rung(const struct classic_project *project,
		     struct classic_options options, struct arena *arena,
		     struct classic_text *out, struct classic_report *report);

/** classic_io_map - the table of inputs and outputs as the text of an I/O map; NULL: an I/O
 * map can hold none of it. @report: gets the lines that are left out. Owns: @arena. */
const char *classic_io_map(const struct classic_project *project, struct arena *arena,
			   struct classic_report *report);
#endif
