/* SPDX-License-Identifier: MIT
 *
 * check_operand - what the cells of a rung name: is it there, may it be
 * used so?
 *
 * A part of check_names. Types of values are left to check_il, but for contacts
 * and coils, which are BOOL by their drawing.
 */
#ifndef CHECK_CHECK_OPERAND_H
#define CHECK_CHECK_OPERAND_H

#include "engine/check/scope.h"
#include "engine/check/uses.h"
#include "engine/model/expr.h"

struct operand_check {
	struct scope *scope;
	struct project *project;
	struct uses *uses;
	struct expr *expr;        /* room for the expression of a cell */
	struct diag_list *diags;
	const struct pou *pou;
	const struct rung *rung;  /* NULL: a statement of pou->st */
	int number;               /* of the rung, 1-based */
	int network;              /* of the line, from 0; -1: it is in none    */
	const struct st_item *item; /* the statement                          */
	const char *spot;         /* the place in its text                    */
	struct diag place;        /* file and POU of statements               */
	bool condition;           /* of a transition: its coil is TRANSITION   */
	bool statement;           /* expressions are those of Structured Text  */
	bool passing;             /* to a VAR_IN_OUT: what is written is USE_PASSED */
	bool good;                /* false after an error in this rung */
};

/** check_operands - all cells of c->rung but labels; notes the uses.
 * Scan-safe: no.   Fails: false (and c->good too) when it added an error. */
bool check_operands(struct operand_check *c);
/* What becomes of a part of a statement. */
enum operand_use {
	OPERAND_READ,      /* a value                                         */
	OPERAND_WHOLE,     /* a value, or a structure or array                */
	OPERAND_WRITTEN,   /* gets a value                                    */
	OPERAND_STORED,    /* gets a value behind =>, as one or as a part of it, Word.3 */
	OPERAND_CHANGED,   /* VAR_IN_OUT: is read and written                 */
	OPERAND_CALLED,    /* an instance                                     */
};
/** operand_special - the argument of DIAG_SET_BY_OTHERS for an operand as it is written; false: no other tool
 * sets it. Owns: nothing. Scan-safe: yes. */
bool operand_special(const char *name, const struct meaning *m, char *out, size_t size);
/** check_part - the names of an expression of c->item; notes the uses. @expr: parsed; what may be
 * an array is marked in it. Scan-safe: no. Fails: as check_operands(). */
bool check_part(struct operand_check *c, struct expr *expr, enum operand_use use);
/** check_said - a message about c->spot. Scan-safe: no. Returns false for an error. */
bool check_said(struct operand_check *c, enum diag_id id, const char *arg);
#endif
