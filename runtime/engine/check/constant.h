/* SPDX-License-Identifier: MIT
 *
 * constant - a function on its inputs: the type that they share, and what it gives if they are
 * constants.
 *
 * Only check/ includes it. A function of constants is computed as a scan would; one that can
 * never succeed is an error. It walks no list: check_il.c does.
 */
#ifndef CHECK_CONSTANT_H
#define CHECK_CONSTANT_H

#include "engine/check/check_il.h"
#include "engine/scan/vm.h"

#define NUMBER_TEXT 32 /* bytes of an untyped number in a message */

/* The current result of a list (IEC 61131-3 3.2.2), or an input of a function: nothing, a type,
 * or a constant that has no type yet. */
struct il_result {
	bool there;
	bool known;                  /* a constant that has a type: its value  */
	enum iec_type type;
	uint32_t text;               /* the operand it was read from, or 0     */
	union iec_value value;
	const struct literal *literal;
	const struct meaning *whole; /* a structure or array; else NULL    */
};

/* Whose functions are checked, and what the last one gave. */
struct fn_check {
	struct scope *scope;
	const struct pou *pou;
	const struct il *il;
	struct diag_list *diags;
	bool has_constant;   /* the last function has a constant result, args.out */
	struct fn_args args; /* of it                                       */
};

/** il_report - adds a diagnostic at @line. Returns false unless it is a warning. */
bool il_report(struct fn_check *c, const struct il_line *line, enum diag_id id, const char *arg);
/** il_report_types - the same: there is no implicit conversion of @from to @to. */
bool il_report_types(struct fn_check *c, const struct il_line *line, enum iec_type from,
		     enum iec_type to);
/** il_report_constant - the same for an untyped constant that is no value of @to: out of range,
 * or of another kind; then with an example of the right kind. */
bool il_report_constant(struct fn_check *c, const struct il_line *line,
			const struct literal *literal, enum iec_type to);
/** il_is_made - whether translation made the name @operand. Scan-safe: yes. */
bool il_is_made(const struct fn_check *c, const char *operand);
/** il_is_unknown - whether it is what an error left: it fits every use, so that no second error
 * follows. Scan-safe: yes. */
bool il_is_unknown(struct il_result result);
/** il_function_result - the result, of @type, of the function that was checked last. */
struct il_result il_function_result(const struct fn_check *c, enum iec_type type);
/**
 * il_check_inputs - the type that inputs of a function share, and whether it takes them
 * @line:   names the function, and the place of diagnostics
 * @stored: type of the variable that gets the result, or IEC_NONE
 * @common: gets the shared type; unchanged if none is shared
 *
 * If all inputs are constants, the function is computed: il_function_result().
 * Owns: nothing.   Scan-safe: no.
 * Fails: false after a diagnostic, or where there was one before.
 */
bool il_check_inputs(struct fn_check *c, const struct il_line *line, const struct il_result *in,
		     int count, enum iec_type stored, enum iec_type *common);
#endif
