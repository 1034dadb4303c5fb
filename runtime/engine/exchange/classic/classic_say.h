/* SPDX-License-Identifier: MIT
 *
 * classic_say - variables and expressions as ClassicLadder shows them: %B3, %W0[%W4],
 * "%W0:=%W1+1". For drawings of the original.
 */
#ifndef CLASSIC_SAY_H
#define CLASSIC_SAY_H

#include "engine/exchange/classic/classic.h"

enum { CLASSIC_SAID = 256 };

/** classic_say_variable - "%TM0.Q"; "?300/2" of a type that has no name.
 * @out: of CLASSIC_SAID bytes. Scan-safe: yes. */
void classic_say_variable(enum classic_dialect dialect, struct classic_variable variable,
			  char *out);
/** classic_say_block - "%TM0". @element: code of the cell. @out: as above. */
void classic_say_block(int element, int number, char *out);
/** classic_say_expression - @text with names of variables; text that is no variable stays, a
 * long one is cut. @out: as above. Scan-safe: no. */
void classic_say_expression(enum classic_dialect dialect, const char *text, char *out);
/** classic_say_symbol - symbol of @variable ("%B3"); "": it has none. Lives as long as
 * @project. */
const char *classic_say_symbol(const struct classic_project *project,
			       const char *variable);
#endif
