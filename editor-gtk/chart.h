/* SPDX-License-Identifier: MIT
 *
 * chart - what variables were, scan by scan: the numbers behind a timing chart.
 *
 * It follows the record of a simulation with a replay of its own, a little at a time and
 * over edits, so that a variable that is asked for late has its past, too. It draws nothing.
 */
#ifndef EDITOR_CHART_H
#define EDITOR_CHART_H

#include "editor-gtk/sim.h"

#define CHART_SCANS 20000u /* kept of each variable                             */
#define CHART_LINES 64

struct chart;

/** chart_new - empty. @sim: borrowed as long as it is used. Owns: chart_free(). */
struct chart *chart_new(LadderSim *sim);
void chart_free(struct chart *chart);

/** chart_add - a variable or address, behind the others. Fails: false: there is one of
 * this name already, or too many. A name that means nothing now may mean something later. */
bool chart_add(struct chart *chart, const char *name);
void chart_remove(struct chart *chart, int line);
/** chart_move - @to: its place afterwards. */
void chart_move(struct chart *chart, int line, int to);
int chart_lines(const struct chart *chart);
/** chart_name - borrowed until the line goes. */
const char *chart_name(const struct chart *chart, int line);
/** chart_at - where it is in the program whose scan is shown; type IEC_NONE: nowhere. */
struct location chart_at(const struct chart *chart, int line);

/** chart_program_changed - another program runs, or is shown, or none: what is in the chart
 * stays, unless the simulation began anew. */
void chart_program_changed(struct chart *chart);
/** chart_feed - takes scans from the record for at most @us; true: there are more. */
bool chart_feed(struct chart *chart, gint64 us);

/* Scans that it has: first … end - 1; none if they are equal. */
guint64 chart_first(const struct chart *chart);
guint64 chart_end(const struct chart *chart);
/** chart_time - ns, of a scan that it has. */
gint64 chart_time(const struct chart *chart, guint64 scan);
/** chart_scan_at - the last scan at or before that time, inside what it has. */
guint64 chart_scan_at(const struct chart *chart, gint64 ns);
/** chart_value - as a number: BOOL 0 and 1, TIME in ms; of a STRING its length. */
double chart_value(const struct chart *chart, int line, guint64 scan);
/** chart_range - the smallest and the largest from @from to @to, both included, that it
 * has. False: it has none of them. */
bool chart_range(const struct chart *chart, int line, guint64 from, guint64 to,
		 double *low, double *high);

#endif
