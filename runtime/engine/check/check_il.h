/* SPDX-License-Identifier: MIT
 *
 * check_il - operators, parentheses and types of an instruction list.
 *
 * LD becomes IL before its types are checked, so this is the one place that knows
 * what may be combined with what. It changes nothing.
 */
#ifndef CHECK_CHECK_IL_H
#define CHECK_CHECK_IL_H

#include "engine/check/scope.h"

/**
 * types_join - the narrowest type that both widen to without loss
 *
 * IEC_NONE for an untyped constant joins with anything.   Scan-safe: yes.
 * Fails: IEC_TYPE_COUNT when a conversion is needed.
 */
enum iec_type types_join(enum iec_type a, enum iec_type b);

/**
 * check_il - every error of an instruction list
 * @pou:   whose list; its name and file are used in diagnostics
 * @il:    the list; of a LD POU what it was translated to
 * @scratch: memory for the time of the call
 * @types: gets a type for each line: of a function the common type of its
 *         inputs, of other lines that of the result; caller's, il->count long
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false when it added an error.
 */
bool check_il(struct scope *scope, const struct pou *pou, const struct il *il,
	      struct arena *scratch, enum iec_type *types,
	      struct diag_list *diags);

/* A POU and the list it runs. */
struct il_pou { const struct pou *pou; const struct il *il; };

/**
 * check_pins - warns of inputs such as PT that no program ever gives a value
 * @list: all POUs of the project, free of errors
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false when memory is out.
 */
bool check_pins(struct scope *scope, const struct il_pou *list, int count,
		struct arena *scratch, struct diag_list *diags);
#endif
