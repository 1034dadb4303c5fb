/* SPDX-License-Identifier: MIT
 *
 * expr_args - which pins the arguments of a function in an expression go to.
 *
 * `LIMIT(0, x, 10)` gives the inputs in their order, `LIMIT(MX := 10, IN := x, MN :=
 * 0)` by name. Used by the check and by the translation. Types are not checked here.
 */
#ifndef MODEL_EXPR_ARGS_H
#define MODEL_EXPR_ARGS_H

#include "engine/model/expr.h"
#include "engine/model/words.h"

enum { EXPR_EN = -1, EXPR_ENO = -2, EXPR_OUT = -3 };

struct expr_args {
	int count;
	struct { int at; int pin; } arg[LIMIT_ARGS]; /* from the left: its value,
				and the index of its pin in the row; of an extensible
				function also behind the last one         */
	int more;                /* EN and what follows =>: such arguments, likewise with the
				  * index of an output, EXPR_EN, EXPR_ENO or EXPR_OUT */
	struct { int at; int16_t pin; bool inverted; } other[LIMIT_ARGS]; /* inverted: NOT Q => place */
	int wrong;               /* the pin of the error, or -1              */
	const char *text;        /* or the name as written; borrowed          */
	int len;
	int number;              /* of the argument, from 1                   */
};

/** expr_function - the function of an EXPR_CALL; WORD_COUNT: it is none. Scan-safe: no. */
enum word expr_function(struct word_table *words, const struct expr_node *call);
/** expr_is_clock - TIME(): the time since the controller started. Scan-safe: yes. */
bool expr_is_clock(const struct expr_node *node);
/* ADR and REF; SIZEOF; __ISVALIDREF. */
enum expr_measure { MEASURE_PLACE, MEASURE_SIZE, MEASURE_VALID };
/** expr_measured - the argument of ADR, SIZEOF or __ISVALIDREF; NULL: the call is none of them
 * Scan-safe: yes. */
struct expr_node *expr_measured(struct expr *expr, const struct expr_node *call,
				enum expr_measure *what);
/* LOWER_BOUND(array, number), UPPER_BOUND: of its dimension with this number. */
struct expr_bound {
	struct expr_node *array, *number;
	bool upper;
};
/** expr_is_bound - a call of LOWER_BOUND or UPPER_BOUND. Scan-safe: yes. */
bool expr_is_bound(const struct expr_node *call);
/** expr_bound - the arguments of LOWER_BOUND or UPPER_BOUND; false: the call is none of them, or has others.
 * Scan-safe: yes. */
bool expr_bound(struct expr *expr, const struct expr_node *call, struct expr_bound *out);
/**
 * expr_match - matches the arguments of @call to the pins of @row
 *
 * Owns: nothing. Scan-safe: yes.
 * Fails: a diagnostic about out->wrong or out->text; DIAG_COUNT on success.
 * DIAG_MIXED_NAMES: one without a name behind one with a name. DIAG_NO_PIN, DIAG_DUPLICATE_ARG,
 * DIAG_MISSING_INPUT.
 */
enum diag_id expr_match(const struct expr *expr, const struct expr_node *call,
			const struct word_row *row, struct expr_args *out);
/** expr_left_out - the first input of a function of the project that has neither an argument nor an initial value in
 * its declaration, which a call with names may leave out; NULL: none. Scan-safe: yes. */
const struct word_pin *expr_left_out(const struct word_row *row, const struct expr_args *args);
/** expr_has_wrong_call - does it call a built-in function with other arguments than that has?
 * Scan-safe: no. */
bool expr_has_wrong_call(const struct expr *expr, struct word_table *words);
/** expr_pin_name - the name of pin @index, also of extensible inputs such as IN3; as
 * snprintf.
 * Scan-safe: yes. */
int expr_pin_name(const struct word_row *row, int index, char *out, size_t size);
#endif
