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

/** fn_own_type - type that an untyped constant takes at a function's pin with a type of
 * its own; IEC_NONE: it fits none. Scan-safe: yes. */
enum iec_type fn_own_type(const struct word_pin *pin, const struct literal *literal);
/** fn_result - type of a function's result. @out: of the variable that gets it, or
 * IEC_NONE. Scan-safe: yes. */
enum iec_type fn_result(const struct word_row *row, enum iec_type common,
			enum iec_type out);
/** fn_overload - the function that @word is on inputs of these types: ADD of a time of
 * day and a time is ADD_TOD_TIME; most are what they are. IEC_NONE: a constant number
 * without a type. Scan-safe: yes. */
enum word fn_overload(enum word word, enum iec_type left, enum iec_type right);
/** il_stored_type - type of the variable that the line behind @at stores the result
 * into; IEC_NONE: it does not. */
enum iec_type il_stored_type(struct scope *scope, const struct pou *pou,
			     const struct il *il, int at);

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

/**
 * il_order_args - gives the parameters of CAL that were written without names the pins
 * that they go to: the inputs and what is handed over to be changed, in order
 * @il: the list of an IL POU; lines of it are changed
 *
 * One that is too many gets none. Owns: nothing.   Scan-safe: no.
 */
void il_order_args(struct scope *scope, const struct pou *pou, struct il *il);

/** il_place - where a diagnostic about a line is. Scan-safe: no. */
struct diag il_place(const struct scope *scope, const struct pou *pou,
		     const struct il_line *line, enum diag_id id);

/* A POU and the list it runs. */
struct il_pou { const struct pou *pou; const struct il *il; };

/**
 * check_calls - a circle of calls (LD350), or one too deep (LD605)
 * @list: all POUs of the project, free of errors
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false after a diagnostic, or when memory
 * is out.
 */
bool check_calls(struct scope *scope, const struct il_pou *list, int count,
		 struct arena *scratch, struct diag_list *diags);

/**
 * check_pins - warns of inputs such as PT that no program ever gives a value
 * @list: all POUs of the project, free of errors
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false when memory is out.
 */
bool check_pins(struct scope *scope, const struct il_pou *list, int count,
		struct arena *scratch, struct diag_list *diags);
#endif
