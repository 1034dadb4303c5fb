/* SPDX-License-Identifier: MIT
 *
 * named - types with a name of their own that are no structures: enumerations, subranges, other
 * names of types.
 *
 * A variable of such a type is, once project_resolve() has run, a variable of the type behind the
 * name: checks and translation see an INT. Its struct var keeps the name for the file, and the
 * values that it may have. It computes no expressions: check/settle.c does.
 */
#ifndef MODEL_NAMED_H
#define MODEL_NAMED_H

#include "engine/base/diag.h"
#include "engine/model/project.h"

/** named_find - number of the type with this folded name; -1: none. Scan-safe: yes. */
int named_find(const struct project *project, uint32_t fold);
/** named_value - the value of an enumeration with this folded name; NULL: none. Scan-safe: yes. */
const struct enum_value *named_value(const struct project *project, int enumeration, uint32_t fold);
/**
 * project_resolve - makes all variables of named types variables of the types behind them
 *
 * After the project was read; a call after an edit makes them again.
 * Owns: the project's arena.   Scan-safe: no.
 * Fails: false after LD356 (a type is made of itself), LD126 or LD001.
 */
bool project_resolve(struct project *project, struct diag_list *diags);
/** named_take - gives @var type, bounds and initial value of the named type that it has, which is
 * resolved. Scan-safe: no. Fails: false when memory is out. */
bool named_take(struct project *project, struct var *var);
/** named_default - the initial value of the elements that have none: the first value of an
 * enumeration, the lowest of a subrange. Scan-safe: no. Fails: false when memory is out. */
bool named_default(struct project *project, struct var *var);
/** named_may_hold - whether a variable declared like @var may have the value @number. Scan-safe: yes. */
bool named_may_hold(const struct project *project, const struct var *var, int64_t number);
/**
 * named_number - the number of a value of an enumeration: `Red`, `Color#Red`, `Color.Red`
 *
 * For texts that are no part of the project. Nothing is interned.
 * Owns: nothing.   Scan-safe: no.
 * Fails: false; if several enumerations have `Red` with other numbers, or Color has no such value, with
 * DIAG_AMBIGUOUS_VALUE or DIAG_NO_SUCH_VALUE in @why, which is otherwise as it was.
 */
bool named_number(const struct project *project, const char *text, size_t len, int64_t *out,
		  enum diag_id *why);
/**
 * named_tell - the arguments of a message about a name that is no value: DIAG_AMBIGUOUS_VALUE,
 * DIAG_NO_SUCH_VALUE
 *
 * @out: gets @name, and how it must be written, or the values that there are; as it is for another @why
 * Owns: nothing.   Scan-safe: no.
 */
void named_tell(const struct project *project, enum diag_id why, const char *name, char *out,
		size_t size);
/** named_print - the values that it may have: "0..100", "Red, Green, …"; as snprintf. */
int named_print(const struct project *project, const struct var *var, char *out, size_t size);
/**
 * named_of_path - the variable or member that declares what @path names: Main.Line[2].Color
 *
 * NULL: nothing of the project, or an instance of the catalogue.   Scan-safe: no.
 */
const struct var *named_of_path(struct project *project, const char *path, size_t len);
/** named_word - the name of value @number of @var's enumeration; NULL: it has none. Static text of
 * the project. Scan-safe: yes. */
const char *named_word(const struct project *project, const struct var *var, int64_t number);
#endif
