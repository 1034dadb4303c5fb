/* SPDX-License-Identifier: MIT
 *
 * il - an instruction list (IEC 61131-3 chapter 3.2) as data.
 *
 * Lists that users write and lists made from LD have the same form. check/check_il.h
 * resolves the operands.
 */
#ifndef MODEL_IL_H
#define MODEL_IL_H

#include "engine/base/catalog.h"
#include "engine/base/names.h"

enum il_kind {
	IL_OP,       /* an operator of the catalogue: op, modifiers, operand   */
	IL_FN,       /* a function as operator on the result: ADD 5            */
	IL_CLOSE,    /* )                                                      */
	IL_LABEL,    /* Name:                                                  */
	IL_CALL,     /* a function with formal parameters; arguments follow    */
	IL_ARG_IN,   /* PIN := operand                                         */
	IL_ARG_OUT,  /* PIN => operand                                         */
	IL_COMMENT,  /* (* … *)                                                */
	/* Lines that only translation makes, for charts. */
	IL_EACH,     /* operand: the first of the BOOLs; pin: its cursor, a UDINT; as
			many IL_TARGET follow, each with a label               */
	IL_TARGET,
	IL_TICK,     /* operand: TIME that gets the step time; pin: the last time; word: how */
};

enum il_mark {
	IL_NAMED = 1,    /* IL_CALL: one of several in a cell, messages name it */
	IL_IN_ORDER = 2, /* IL_ARG_IN of CAL: written without its pin; the check finds the
			  * pin by the order of the inputs */
	IL_MADE = 4,     /* made by the translation of a chart or a loop: it may write steps,
			  * and a comparison that never changes is no news */
	IL_BEGINS = 16,  /* a statement of Structured Text begins here        */
	IL_INDEX = 32,   /* IL_CALL: a variable plus or minus a constant, which is only the index of
			  * elements, before the variable changes; its type holds all their indices */
	IL_ENTERS = 64,  /* before the body: an input with R_EDGE or F_EDGE becomes its edge */
	IL_WATCHING = 8, /* keeps power while it is watched; the other lines of that list are
			  * those of the list that runs unwatched */
};

struct il_line {
	uint8_t kind;        /* enum il_kind                                   */
	uint8_t op;          /* enum op of IL_OP                               */
	uint8_t modifiers;   /* enum op_modifier                               */
	uint8_t mark;        /* enum il_mark                                   */
	uint16_t word;       /* enum word: the function of IL_FN, IL_CALL      */
	uint16_t row, col;   /* 1-based cell it comes from. In a list that was written
				(rung 0): column of its operator, of its operand.
				0: none                                    */
	uint16_t made;       /* of a network: the operation whose result the line leaves, expr_mark(); 0: none */
	uint32_t rung;       /* 1-based; 0: none                               */
	uint32_t operand;    /* string id; label name; comment text            */
	uint32_t pin;        /* string id of IL_ARG_*                          */
	uint32_t line;       /* in the source; 0: none                         */
};

struct il {
	struct arena *arena;
	struct il_line *line;
	int count;
};

/** il_add - appends a copy. Fails: NULL when memory is out. Scan-safe: no. */
struct il_line *il_add(struct il *il, struct il_line line);
#endif
