/* SPDX-License-Identifier: MIT
 *
 * st_formula - an expression of a body as the text of one over the whole program, for
 * formula_new(): whole names, and the numbers of enumerations.
 */
#ifndef EDITOR_ST_FORMULA_H
#define EDITOR_ST_FORMULA_H

#include "engine/base/lex.h"
#include "engine/model/project.h"
#include "engine/scan/image.h"

#include <glib.h>

/** st_formula_number - of a value of an enumeration, "Idle" or "Phase#Idle". Caller frees. NULL: it is
 * none. */
char *st_formula_number(struct project *project, const struct token *token);
/** st_formula_text - @text in the body of @scope: a program, a function, or an instance of the block @pou,
 * which has the names of its VAR_TEMP. Caller frees. */
char *st_formula_text(struct project *project, const struct program *program, const char *scope,
		      const char *pou, const char *text);
#endif
