/* SPDX-License-Identifier: MIT
 *
 * classic_say - variables and expressions of a ClassicLadder project as people read them
 * there: %B3, %W0[%W4], "%W0 := %W1+1". For drawings; it knows nothing of rung files.
 */
#ifndef CLASSIC_SAY_H
#define CLASSIC_SAY_H

#include "engine/exchange/classic/classic.h"

enum { CLASSIC_SAID = 256 };

/** classic_say_variable - "%TM0.Q"; "?300/2" of a type that has no name.
 * @out: of CLASSIC_SAID bytes. Scan-safe: yes. */
void classic_say_variable(enum classic_dialect dialect, struct classic_variable variable,
			  char *out);
/** classic_say_block - "%TM0", of the element that its cell holds. @out: as above. */
void classic_say_block(int element, int number, char *out);
/** classic_say_expression - @text with its variables by name; what is none stays, what is
 * too long is cut. @out: as above. Scan-safe: no. */
void classic_say_expression(enum classic_dialect dialect, const char *text, char *out);
/** classic_say_symbol - what the project's table calls @variable ("%B3"), "" if nothing.
 * Lives as long as @project. */
const char *classic_say_symbol(const struct classic_project *project,
			       const char *variable);
#endif
