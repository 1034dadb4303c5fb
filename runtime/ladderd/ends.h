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

#include <stdint.h>

#define ENDS_MOST      3  /* abnormal ends … */
#define ENDS_WITHIN_S 60  /* … within so many seconds: the next start is in STOP */

/**
 * ends_begin - ladderd begins to scan; @folder: NULL: nothing is counted
 *
 * Returns how its last end was: EVENT_END: an orderly one, EVENT_POWER, EVENT_AFTER: an abnormal one,
 * EVENT_ENDS: ENDS_MOST of these within ENDS_WITHIN_S; 0: there is no record. Scan-safe: no.
 */
uint8_t ends_begin(const char *folder);
/** ends_orderly - ladderd ends in order. Scan-safe: no. */
void ends_orderly(const char *folder);
#endif
