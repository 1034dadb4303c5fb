/* SPDX-License-Identifier: MIT
 *
 * mend - proposes a line of a rung file as it should be written.
 *
 * For people who type a file by hand and know another tool. A proposal is made only if the
 * reader takes the mended line. Attached by `advice`; `ladderd` is linked without it.
 */
#ifndef TEXT_MEND_H
#define TEXT_MEND_H

#include "engine/base/diag.h"
#include "engine/model/project.h"

enum mend_kind {
	MEND_HEAD, /* PROGRAM, RUNG, VAR, END_…                               */
	MEND_ROW,  /* a row of a rung                                         */
	MEND_VAR,  /* a declaration                                           */
	MEND_LIST, /* an instruction                                          */
};

struct mend_line {
	struct project *project;
	enum mend_kind kind;
	uint16_t var_flags;  /* of the VAR block                              */
	bool members;        /* of a structure                                */
	bool label;          /* a jump names the first word                   */
	bool chart;          /* in a POU in SFC                               */
	const char *text;
	size_t len;
};

/* The first of the changes, and the line after all of them. */
struct mended {
	enum diag_id id; /* DIAG_WRITE_INSTEAD, _MISSING, _SURPLUS, _COMPUTED, _SEVERAL_STEPS, _SPECIAL_INSTEAD,
			    _EDGE_OF_VALUE, _DRAWN, _DRAWN_NAMELESS, _VALUE_MISSING, _MISSING_INSTANCE */
	int column;      /* 1-based byte of the change in the line            */
	char from[24], to[24], line[112];
};

/** mend_line - false: the line cannot be mended. Owns: nothing. Scan-safe: no. */
bool mend_line(const struct mend_line *line, struct mended *out);
#endif
