/* SPDX-License-Identifier: MIT
 *
 * sfc_lines - which part of a chart stands in a line of the file.
 */
#ifndef EDITOR_SFC_LINES_H
#define EDITOR_SFC_LINES_H

#include "engine/model/project.h"

enum sfc_spot_kind { SPOT_NONE, SPOT_STEP, SPOT_TRANSITION, SPOT_USE, SPOT_ACTION,
		     SPOT_CONTROL };
/* A part of a chart: step, transition, use, action @index of it. */
struct sfc_spot { enum sfc_spot_kind kind; int index; };

/** sfc_line_of - the first line of a part in the file (1-based), its comment included; 0:
 * unknown. */
int sfc_line_of(const struct project *project, const struct sfc *sfc, struct sfc_spot spot);
/** sfc_spot_at - the part in line @line of the file (1-based); of several actions in one line
 * the first. SPOT_NONE: the line is before all parts. */
struct sfc_spot sfc_spot_at(const struct project *project, const struct sfc *sfc, int line);

#endif
