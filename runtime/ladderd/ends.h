/* SPDX-License-Identifier: MIT
 *
 * ends - counts how often ladderd has ended without an orderly stop: the file `ends` in the
 * folder of slots.
 *
 * A program that brings ladderd down again and again must not drive its outputs at each new
 * start. Times are those since the machine began, so a clock that is set does not matter. Ends
 * before that are forgotten: a machine that is switched off by its main switch starts as ever.
 */
#ifndef LADDERD_ENDS_H
#define LADDERD_ENDS_H

#include <stdbool.h>

#define ENDS_MOST      3  /* abnormal ends … */
#define ENDS_WITHIN_S 60  /* … within so many seconds: the next start is in STOP */

/** ends_begin - ladderd begins to scan; @folder: NULL: nothing is counted. Returns whether it
 * has ended abnormally ENDS_MOST times within ENDS_WITHIN_S. Scan-safe: no. */
bool ends_begin(const char *folder);
/** ends_orderly - ladderd ends as it was told to. Scan-safe: no. */
void ends_orderly(const char *folder);
#endif
