/* SPDX-License-Identifier: MIT
 *
 * classic_write - a struct classic_project as the text that ClassicLadder, LinuxCNC or an
 * old soft PLC reads.
 *
 * The mirror of classic_read(). It avoids what those readers cannot read: a member without
 * a line, lines and names that are too long, a comma in a name. A text that is too long is
 * cut at a whole character; the caller keeps names different.
 */
#ifndef CLASSIC_WRITE_H
#define CLASSIC_WRITE_H

#include "engine/base/sink.h"
#include "engine/exchange/classic/classic.h"

enum classic_length { /* bytes at most, as their programs keep them */
	CLASSIC_LABEL = 9, CLASSIC_SYMBOL = 9, CLASSIC_COMMENT = 29,
	CLASSIC_COMMENT_LONG = 99, CLASSIC_SECTION_NAME = 19, CLASSIC_EXPRESSION = 49,
	CLASSIC_NOTE = 50, CLASSIC_SYMBOL_COMMENT = 49,
};

/** classic_columns, classic_rows - of a rung of a dialect. Scan-safe: yes. */
int classic_columns(enum classic_dialect dialect);
int classic_rows(enum classic_dialect dialect);
/** classic_cut - how many of @len bytes @most hold, in whole characters. Scan-safe: yes. */
int classic_cut(const char *text, int most);
/**
 * classic_write - the text of @project, in its dialect
 *
 * Of CLASSIC_NUMERIC: rungs and old timers, nothing else.
 * Owns: nothing.   Scan-safe: no.   Fails: never; the sink tells.
 */
void classic_write(const struct classic_project *project, const struct sink *sink);
#endif
