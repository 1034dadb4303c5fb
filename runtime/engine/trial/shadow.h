/* SPDX-License-Identifier: MIT
 *
 * shadow - a program in another language, shown with the values of the one that runs.
 *
 * Both do the same in each scan (convert/). The shadow takes over the state before a scan, runs that scan
 * itself, and so has power and results at each of its own cells and lines. All that both programs declare
 * has the value of the one that runs. It changes nothing in that.
 */
#ifndef TRIAL_SHADOW_H
#define TRIAL_SHADOW_H

#include "engine/trial/twin.h"

struct shadow;

/**
 * shadow_new - at no scan yet
 * @shown: the program in the other language, built with its map of power   @of: the one that runs
 * @alone: a POU of the program in the other language; NULL: all is known. Else only the values that it names
 *         are, as of a board: it runs without the others, and blocks of the catalogue do not run: what
 *         they have put out is taken over
 *
 * All are borrowed. Owns: the caller, shadow_free(). Scan-safe: no. Fails: NULL: no memory.
 */
struct shadow *shadow_new(const struct program *shown, const struct program *of, const char *alone);
void shadow_free(struct shadow *shadow);

/**
 * shadow_scan - the scan between two states
 * @before: after the scan before, with the acts of a person that came then
 * @now:    after the scan. With @alone: the state that is known; @before is not used
 *
 * Values that only the shadow has, such as bits for the steps of a chart, go on from its last scan: begin at the
 * first scan, or some scans earlier. Scan-safe: no. Fails: false: the program was not in RUN, or ended in a FAULT.
 */
bool shadow_scan(struct shadow *shadow, const struct twin *before, const struct twin *now);
/** shadow_values - takes the values of @now alone: power stays as it was. Scan-safe: no. */
void shadow_values(struct shadow *shadow, const struct twin *now);
/** shadow_jump - goes on from @now, after another scan than its last one: it takes the values, what edges remember
 * and the steps of a chart; times that only the shadow measures stay. Scan-safe: no. */
void shadow_jump(struct shadow *shadow, const struct twin *now);
/** shadow_resource - its state. Borrowed. */
const struct resource *shadow_resource(const struct shadow *shadow);
/** shadow_place - where the program that runs has the variable at @at of the shadow; type IEC_NONE: it has
 * no such variable. Scan-safe: no. */
struct location shadow_place(const struct shadow *shadow, struct location at);
#endif
