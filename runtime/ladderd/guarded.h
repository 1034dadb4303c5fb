/* SPDX-License-Identifier: MIT
 *
 * guarded - what ladderd tells ladder-guard, if that has started it; else nothing happens.
 */
#ifndef LADDERD_GUARDED_H
#define LADDERD_GUARDED_H

#include "hal/hal.h"

#include <stdbool.h>
#include <stdint.h>

#define GUARDED_PAUSE_MS 60000 /* while no monitor runs: an end, another start */

#define GUARDED_MANY "ladderd has ended abnormally three times within a minute"
/** guarded_begin - reads LADDER_GUARD. Returns why ladderd shall begin in STOP: GUARDED_MANY; NULL:
 * it need not. */
const char *guarded_begin(void);
struct guard_page;
/** guarded_page - what the guard sees of each scan (guard/say.h); without a guard nobody sees it. Static. */
struct guard_page *guarded_page(void);
/** guarded_again - once: how the ladderd before ended abnormally, as in guard/say.h, and how many did
 * since the guard began; 0: this is the first start, or there is no guard. */
int guarded_again(unsigned *count);
/**
 * guarded_beat - a sign of life; the next comes within @next_ms and the heartbeat of the guard
 *
 * Sends not more often than the guard needs, unless @now. Async-signal-safe; never waits.
 */
void guarded_beat(int64_t next_ms, bool now);
/** guarded_lines - tells the outputs of @hal and their safe levels. Fails: false and a message on
 * standard error: the guard does not make all lines safe. Scan-safe: a system call. */
bool guarded_lines(struct hal *hal);
/**
 * guarded_more - tells the outputs of another map that are about to be requested beside those of
 * guarded_lines(); NULL: none any more. Call guarded_lines() when the map has been exchanged.
 *
 * In one other thread than that of guarded_lines(). Fails: as guarded_lines().
 */
bool guarded_more(const struct hal *next);
/** guarded_take - the guard gives back the lines that it holds, and says which levels outputs with
 * safe=hold had last: @hal, which is not open yet, begins with these. Waits up to 2 s. */
void guarded_take(struct hal *hal);
/** guarded_tell - hands a text on to the service manager; never waits. */
void guarded_tell(const char *state);
#endif
