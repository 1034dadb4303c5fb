/* SPDX-License-Identifier: MIT
 *
 * sfc_lines - lines of a file and parts of a chart: which one is meant by a line.
 */
#ifndef EDITOR_SFC_LINES_H
#define EDITOR_SFC_LINES_H

#include "engine/model/project.h"

enum sfc_spot_kind { SPOT_NONE, SPOT_STEP, SPOT_TRANSITION, SPOT_USE, SPOT_ACTION,
		     SPOT_CONTROL };
/* A part of a chart: step, transition, use, action @index of it. */
struct sfc_spot { enum sfc_spot_kind kind; int index; };

/** sfc_line_of - from which line of the file on (1-based) a part stands there, its comment,
 * too; 0: unknown. */
int sfc_line_of(const struct project *project, const struct sfc *sfc, struct sfc_spot spot);
/** sfc_spot_at - what the line @line of the file (1-based) is of; of several that a step does
 * in one line the first. SPOT_NONE: it stands before all of them. */
struct sfc_spot sfc_spot_at(const struct project *project, const struct sfc *sfc, int line);

#endif
