/* SPDX-License-Identifier: MIT
 *
 * classic_write - a struct classic_project as the text that ClassicLadder, LinuxCNC or an
 * old soft PLC reads.
 *
 * Their readers fail on an empty member, a long line or name, and a comma in a name: none is
 * written. A long text is cut at a whole character; the caller keeps names different.
 */
#ifndef CLASSIC_WRITE_H
#define CLASSIC_WRITE_H

#include "engine/base/sink.h"
#include "engine/exchange/classic/classic.h"

enum classic_length { /* bytes that ClassicLadder has room for */
	CLASSIC_LABEL = 9, CLASSIC_SYMBOL = 9, CLASSIC_COMMENT = 29, CLASSIC_ABOUT = 270,
	CLASSIC_COMMENT_LONG = 99, CLASSIC_SECTION_NAME = 19, CLASSIC_EXPRESSION = 49,
	CLASSIC_NOTE = 50, CLASSIC_SYMBOL_COMMENT = 49,
};

/** classic_columns, classic_rows - size of a rung in a dialect. Scan-safe: yes. */
int classic_columns(enum classic_dialect dialect);
int classic_rows(enum classic_dialect dialect);
/** classic_cut - length of @text in whole characters, at most @most bytes. Scan-safe: yes. */
int classic_cut(const char *text, int most);
/**
 * classic_write - writes the text of @project, in its dialect
 *
 * CLASSIC_NUMERIC: only rungs and old timers.
 * Owns: nothing.   Scan-safe: no.   Fails: never; the sink keeps errors.
 */
void classic_write(const struct classic_project *project, const struct sink *sink);
#endif
