/* SPDX-License-Identifier: MIT
 *
 * session - what a person did to a program, and saw, as the text of a scenario.
 *
 * Acts and expectations go in with the scans they belong to, counted from a cold start; a
 * scenario (trial/scenario.h) comes out that does the same before the same scans. It runs
 * nothing. What a scenario cannot say is refused when it comes: forces, restarts, another
 * period, acts of the plant.
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

/** session_plant - a plant stood beside it; @name: its file, from the folder of the scenario
 * file, borrowed as long as the session. */
void session_plant(struct session *session, const char *name);
/** session_act - @act was done after scan @after. Not before an earlier one. Fails: false:
 * session_can_hold() says no, its variable has no name, no memory. */
bool session_act(struct session *session, uint64_t after, const struct act *act);
/** session_expect - right after scan @scan (1 or more) the variable holds @value. Fails:
 * false: it has no name, the value cannot be written (no number), no memory. */
bool session_expect(struct session *session, uint64_t scan, struct location at,
		    union iec_value value);
int session_acts(const struct session *session);
int session_expects(const struct session *session);

/** session_write - the scenario, from the line with its @name on. What of the name cannot
 * stand in quotes becomes ' or a blank. Scan-safe: no. Fails: false: no memory. */
bool session_write(const struct session *session, const char *name,
		   const struct sink *out);

#endif
