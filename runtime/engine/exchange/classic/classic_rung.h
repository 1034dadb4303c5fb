/* SPDX-License-Identifier: MIT
 *
 * classic_rung - a ClassicLadder project as the text of a rung file.
 *
 * Each rung does in each scan what it did there: where columns, blocks and coils of one
 * rung see each other, it becomes several. What it was called there can be found again
 * (trial/classic_name.h). It reads no files and checks nothing: that is for the reader of
 * rung files, which reads this text like any other.
 */
#ifndef CLASSIC_RUNG_H
#define CLASSIC_RUNG_H

#include "engine/exchange/classic/classic.h"

struct classic_options {
	bool faithful;      /* faults that a project may rely on are repeated       */
	bool task;          /* a CONFIGURATION with its period: for a file of its own */
};

struct classic_text {
	char *text;         /* closed with a NUL                                    */
	size_t len;
	struct classic_place *place; /* of each line of the text, from 1 on         */
	int lines;
};

/**
 * classic_to_rung - the text, and where each line of it comes from
 * @report: gets what became of everything
 *
 * Owns: @arena.   Scan-safe: no.   Fails: false when memory is out.
 */
bool classic_to_rung(const struct classic_project *project,
		     struct classic_options options, struct arena *arena,
		     struct classic_text *out, struct classic_report *report);

/** classic_io_map - its table of inputs and outputs as the text of an I/O map; NULL: no line
 * of it has a name here. @report: gets what could not be taken. Owns: @arena. */
const char *classic_io_map(const struct classic_project *project, struct arena *arena,
			   struct classic_report *report);
#endif
