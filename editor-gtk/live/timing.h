/* SPDX-License-Identifier: MIT
 *
 * timing - the values of variables, scan by scan: the numbers of a timing chart.
 *
 * It reads the record of the simulation with a replay of its own, a little at a time and
 * across edits, so that a variable added later has its past too. It draws nothing.
 */
#ifndef EDITOR_TIMING_H
#define EDITOR_TIMING_H

#include "editor-gtk/sim/sim.h"

#define TIMING_SCANS 20000u /* kept for each variable                            */
#define TIMING_LINES 64

struct timing;

/** timing_new - empty. @sim: lives longer. Owns: timing_free(). */
struct timing *timing_new(LadderSim *sim);
void timing_free(struct timing *timing);

/** timing_has - is there a line of this variable, by this name or another form of it? */
bool timing_has(const struct timing *timing, const char *name);
/** timing_add - adds a variable or address as the last line; the program need not have it.
 * Fails: false: timing_has(), or there are TIMING_LINES. */
bool timing_add(struct timing *timing, const char *name);
void timing_remove(struct timing *timing, int line);
/** timing_move - @to: its index afterwards. */
void timing_move(struct timing *timing, int line, int to);
int timing_lines(const struct timing *timing);
/** timing_name - borrowed until the line goes. */
const char *timing_name(const struct timing *timing, int line);
/** timing_at - its place in the program whose scan is shown; type IEC_NONE: unknown name. */
struct location timing_at(const struct timing *timing, int line);

/** timing_program_changed - to be called when the simulation emits program-changed. Samples
 * stay, unless the simulation began anew. */
void timing_program_changed(struct timing *timing);
/** timing_feed - takes scans from the record for at most @us; true: there are more. */
bool timing_feed(struct timing *timing, gint64 us);

/* It has the scans from first to end - 1; none if both are equal. */
guint64 timing_first(const struct timing *timing);
guint64 timing_end(const struct timing *timing);
/** timing_time - in ns, of a scan that it has. */
gint64 timing_time(const struct timing *timing, guint64 scan);
/** timing_scan_at - the last scan that it has at or before that time. */
guint64 timing_scan_at(const struct timing *timing, gint64 ns);
/** timing_value - as live_value_number(). */
double timing_value(const struct timing *timing, int line, guint64 scan);
/** timing_quality - how good it was, as ladder_sim_quality(); SIM_FORCED while a person held it. */
enum sim_quality timing_quality(const struct timing *timing, int line, guint64 scan);
/** timing_range - the smallest and the largest value of scans @from to @to, both included.
 * False: it has none of these scans. */
bool timing_range(const struct timing *timing, int line, guint64 from, guint64 to,
		 double *low, double *high);

/* ---- the variables that a project keeps ----
 * Lines `timing NAME` of the VIEW part, from top to bottom of the chart. The program need not
 * have the name. */

/** timing_kept_read - the names in a VIEW part, in its order. Caller: g_strfreev(). */
char **timing_kept_read(const char *view);
/** timing_kept_write - @view with its names replaced by @names; other lines stay. Caller
 * frees. */
char *timing_kept_write(const char *view, const char *const *names);
/** timing_kept_put - the same in a document, as a step of its history. Does nothing if it has
 * these names already, or is text only. */
void timing_kept_put(LadderDocument *document, const char *const *names);

#endif
