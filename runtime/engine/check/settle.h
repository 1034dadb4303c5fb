/* SPDX-License-Identifier: MIT
 *
 * settle - computes the constant expressions of declarations: initial values, bounds of arrays,
 * lengths of texts.
 *
 * `Max : INT := Limit - 1;` keeps its text (struct var_written), and its struct var gets the
 * number. A constant may be declared behind its use. Functions are those of the scan
 * (check/constant.h).
 */
#ifndef CHECK_SETTLE_H
#define CHECK_SETTLE_H

#include "engine/model/init.h"
#include "engine/model/project.h"

/**
 * settle_project - computes all of them, after the project was read
 * @scratch: memory for the time of the call
 *
 * Rows of own words are made again where a size has changed (shape_make).
 * Owns: the project's arena.   Scan-safe: no.
 * Fails: false when it added an error; the values are 0 then.
 */
bool settle_project(struct project *project, struct arena *scratch, struct diag_list *diags);
/** settle_var - the same of one variable, which was added to a project; @table as in scope:
 * 0 the globals, n + 1 those of POU n, behind them the structures. */
bool settle_var(struct project *project, int table, int index, struct arena *scratch,
		struct diag_list *diags);
/**
 * settle_value - the value of an expression, or of a constant, as if it stood in a declaration
 * @table: of the declaration, as above
 * @out:   type (IEC_NONE: an integer of any type) and capacity are given; gets value, literal, and as @out->text, in the strings of
 *         the project, the constant
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false after a diagnostic.
 */
bool settle_value(struct project *project, int table, const char *text, size_t len,
		  struct init_value *out, struct arena *scratch, struct diag_list *diags);
/** init_report - adds the diagnostic of a walk that failed, of @var's initial values. */
bool init_report(const struct project *project, const struct var *var,
		 const struct init_walk *walk, struct diag_list *diags, struct diag place);
#endif
