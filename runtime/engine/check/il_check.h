/* SPDX-License-Identifier: MIT
 *
 * il_check - what the parts of the check of an instruction list share.
 *
 * Private to check/. check_il walks the list, check_fn looks at inputs of functions,
 * check_logic at AND OR XOR NOT, check_own at calls of the project's own functions and
 * blocks.
 */
#ifndef CHECK_IL_CHECK_H
#define CHECK_IL_CHECK_H

#include "engine/check/check_il.h"

/* The current result (IEC 61131-3 3.2.2): nothing, a type, or a constant that
 * has no type yet. */
struct result {
	bool there;
	enum iec_type type;
	const struct literal *literal;
	const struct meaning *whole; /* a structure or array; else NULL    */
};

struct il_check {
	struct scope *scope;
	const struct pou *pou;
	const struct il *il;
	enum iec_type *types;
	struct diag_list *diags;
	uint8_t *label;        /* by folded name: is it a label?            */
	uint32_t label_count;
	struct result now;
	int depth;           /* of open parentheses                         */
	struct il_opened {
		struct result left;
		uint8_t op;          /* of AND OR XOR                       */
		enum word word;      /* of a function; 0: of an operator    */
	} *opened;           /* LIMIT_IL_DEPTH of them                      */
};

/* Each adds a diagnostic at @line; false unless it is a warning. */
bool il_report(struct il_check *c, const struct il_line *line, enum diag_id id,
	       const char *arg);
bool il_report_types(struct il_check *c, const struct il_line *line,
		     enum iec_type from, enum iec_type to);
/** il_report_constant - an untyped constant that is no value of @to. */
bool il_report_constant(struct il_check *c, const struct il_line *line,
			const struct literal *literal, enum iec_type to);
struct expect_want;
/** il_report_near - the same with the words of @kinds that may have been meant. */
bool il_report_near(struct il_check *c, const struct il_line *line, enum diag_id id,
		    unsigned int kinds);
/** il_is_unknown - after an error was told: a result that fits everywhere. */
bool il_is_unknown(struct result result);
/** il_find - what an operand means; NULL after a diagnostic. */
const struct meaning *il_find(struct il_check *c, const struct il_line *line);
/* May it be stored there, written? False after a diagnostic. */
bool il_can_store(struct il_check *c, const struct il_line *line,
		  struct result from, enum iec_type to);
bool il_can_write(struct il_check *c, const struct il_line *line,
		  const struct meaning *m);
/** il_value_of - the operand as a value to read; NULL after a diagnostic. */
const struct meaning *il_value_of(struct il_check *c, const struct il_line *line);
struct result il_result_of(const struct meaning *m);
const char *il_operand_text(struct il_check *c, const struct il_line *line);
bool il_need_result(struct il_check *c, const struct il_line *line);
/** il_need_bool - @what names the value in the message. */
bool il_need_bool(struct il_check *c, const struct il_line *line,
		  struct result result, const char *what);
/** il_check_logic - AND OR XOR, with N and parentheses; il_check_close the other end;
 * il_check_not NOT. On BOOL or on bits. */
bool il_check_logic(struct il_check *c, const struct il_line *line);
bool il_check_close(struct il_check *c, int at, enum iec_type *common);
/** il_open_paren - AND( or ADD( : the result waits. @good: so far. */
bool il_open_paren(struct il_check *c, const struct il_line *line, bool good);
bool il_check_not(struct il_check *c, const struct il_line *line);
/** il_is_bits - BYTE to LWORD? */
bool il_is_bits(struct result result);

/**
 * il_check_inputs - the type that inputs of a function share, and whether it takes them
 * @hint:   what constants alone should be, or IEC_NONE
 * @common: gets that type; unchanged if none is shared
 *
 * Fails: false after a diagnostic, or where one was told before.
 */
bool il_check_inputs(struct il_check *c, const struct il_line *line,
		     const struct result *in, int count, enum iec_type hint,
		     enum iec_type *common);

/* ---- check_flow.c ---- */
/** il_check_flow - JMP, RET, STP. */
bool il_check_flow(struct il_check *c, const struct il_line *line);
/** il_check_cal - CAL of an instance or a subroutine; the lines behind @at too. */
bool il_check_cal(struct il_check *c, int at);

/* ---- check_own.c ---- */
/** il_check_pin - one parameter against the pin of @row that it names. */
bool il_check_pin(struct il_check *c, const struct word_row *row,
		  const struct il_line *arg);
/** il_check_in_outs - is there a parameter for each VAR_IN_OUT of @row? */
bool il_check_in_outs(struct il_check *c, int at, const struct word_row *row);
/** il_check_own_fn - a function of the project on the result; sets the result. */
bool il_check_own_fn(struct il_check *c, int at);
/** il_check_own_call - one with formal parameters. */
bool il_check_own_call(struct il_check *c, int at);

/* ---- check_whole.c ---- */
/** il_check_shape - is @m a structure, array or instance of the type that @pin declares? */
bool il_check_shape(struct il_check *c, const struct il_line *arg,
		    const struct meaning *m, const struct word_pin *pin);
/** il_check_same - is @m of the same type as @like? Both are wholes that a program may
 * copy, or it is told. */
bool il_check_same(struct il_check *c, const struct il_line *arg,
		   const struct meaning *m, const struct meaning *like);
/** il_is_whole_move - is the line at @at a MOVE of a structure or array? */
bool il_is_whole_move(struct il_check *c, int at);
bool il_check_whole_move(struct il_check *c, int at);
/** il_loads_whole - is @m a structure or array that LD at @at loads and the lines behind
 * it only store? */
bool il_loads_whole(struct il_check *c, int at, const struct meaning *m);
/** il_check_store_whole - ST of one. */
bool il_check_store_whole(struct il_check *c, int at);
/** il_check_power - EN := or ENO => at @arg. */
bool il_check_power(struct il_check *c, const struct il_line *arg, bool write);
#endif
