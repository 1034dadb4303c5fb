/* SPDX-License-Identifier: MIT
 *
 * session - converts a session to the text of a scenario.
 *
 * Acts and expectations are added with the number of their scan, counted from a cold
 * start; the scenario (trial/scenario.h) does the same before the same scans. Acts that
 * a scenario cannot express are refused: forces, restarts, another period, acts of the
 * plant.
 */
#ifndef TRIAL_SESSION_H
#define TRIAL_SESSION_H

#include "engine/base/sink.h"
#include "engine/trial/twin.h"

#define SESSION_NAME (2 * LIMIT_NAME + 64) /* bytes of a variable's name, with NUL */

struct session;

/** session_new - @image: of the program, borrowed as long as the session; @period_ns: from
 * scan to scan. Owns: session_free().   Scan-safe: no.   Fails: NULL: no memory. */
struct session *session_new(const struct image *image, int64_t period_ns);
void session_free(struct session *session);

/** session_plant - names the plant of the session; @name: its file, relative to the
 * scenario file; borrowed as long as the session. */
void session_plant(struct session *session, const char *name);
/** session_speed - the board's speed in the session, as ACT_SPEED has it; 0 at first. */
void session_speed(struct session *session, uint64_t speed);
/** session_act - adds @act, done after scan @after, which is not before that of an
 * earlier call. Fails: false: session_can_hold() is false, the variable has no name, no
 * memory. */
bool session_act(struct session *session, uint64_t after, const struct act *act);
/** session_expect - expects the variable to have @value right after scan @scan (1 or
 * more). Fails: false: it has no name, the value cannot be written (NaN), no memory. */
bool session_expect(struct session *session, uint64_t scan, struct location at,
		    union iec_value value);
int session_acts(const struct session *session);
int session_expects(const struct session *session);

/** session_write - the scenario, from the line with its @name on. A quote or control
 * character in the name becomes ' or a blank. Scan-safe: no. Fails: false: no memory. */
bool session_write(const struct session *session, const char *name,
		   const struct sink *out);

#endif
