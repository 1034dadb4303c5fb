/* SPDX-License-Identifier: MIT
 *
 * ladder_unit - shared by the parts of the LD translation: the current rung.
 *
 * Private to translate/. ld_to_il.c walks rungs and turns nets and elements into IL,
 * ld_box.c does boxes and ld_expr.c expressions.
 */
#ifndef TRANSLATE_LADDER_UNIT_H
#define TRANSLATE_LADDER_UNIT_H

#include "engine/model/expr.h"
#include "engine/model/loop.h"
#include "engine/model/network.h"
#include "engine/model/st.h"
#include "engine/translate/temps.h"

/* What an element lets through, once it has been evaluated. */
struct element_state {
	bool seen;         /* evaluated, or being so                          */
	bool negate;
	bool powered;      /* `leaf` holds its power already                  */
	uint32_t leaf;     /* operand that gives its power; 0: NOT, or an output */
	int next;          /* of those that read the same place; -1: last     */
	uint32_t power;    /* while watched: what keeps its power; 0: none    */
};

/* A FOR whose NEXT has not come yet: operands and labels, as string ids. */
struct open_loop {
	uint32_t variable, to, by, top, out;
	bool down;         /* BY is negative                                  */
};

struct net_state {
	bool seen, prepared;
	uint32_t temp;     /* variable that holds its power; 0: none          */
	uint32_t power;    /* while watched: what keeps its power; 0: none    */
};

struct ld {
	struct translation *translation;
	struct unit *unit;
	struct temps *temps;
	struct arena *scratch;
	struct il *il;
	bool watch, failed;
	bool listing;      /* translation->listing, while watched             */
	bool statement;    /* expressions are those of Structured Text (check/mixed.h) */
	uint8_t mark;      /* of the next instructions: IL_WATCHING, or 0     */
	bool begins;       /* the next instruction that is no label gets IL_BEGINS */
	const struct rung *rung;  /* NULL: a statement of the POU's text      */
	const struct st_item *item; /* that statement                         */
	int fbd;                  /* the network that it stands in, from 1; 0: in none */
	int line;                 /* of the file, of the next instruction     */
	struct network network;
	struct element_state *element;
	struct net_state *net;
	int *reader;       /* by place: last element that read it; -1         */
	uint32_t reader_mask;
	uint32_t number;   /* of the rung, 1-based                            */
	uint16_t row, col; /* place of the next instruction, 1-based          */
	bool open;         /* a parenthesis waits for its first operand       */
	uint8_t open_op;
	uint32_t true_id, in_id, en_id, eno_id, out_id;
	uint8_t *target;   /* by folded label: does a jump lead here?         */
	uint32_t target_count;
	struct open_loop loop[LIMIT_LOOPS];
	int loops;
	uint32_t labels;   /* of statements in boxes, so far                  */
	struct expr *expr;
	struct diag_list *ignored; /* texts that were parsed before           */
};

/* ---- ld_to_il.c ---- */
/** ld_begin - before the first rung of a POU: translation, unit, scratch, il and watch are
 * set.   Fails: false: no memory. */
bool ld_begin(struct ld *ld);
/** ld_edges - before the body: an input with R_EDGE or F_EDGE becomes its edge. */
void ld_edges(struct ld *ld);
/** ld_rungs - adds the instructions of @count rungs from @first on; @skip: as ld_to_il(). */
bool ld_rungs(struct ld *ld, int first, int count, const uint8_t *skip);

/* ---- st_to_il.c ---- */
/** st_put - @count statements of the POU from item @first on. No rung is in work. */
void st_put(struct ld *ld, int first, int count);
/** st_keep_read - before they run in the rung that is in work: elements that read what they may write
 * keep its value. */
void st_keep_read(struct ld *ld, int first, int count);
/** st_put_box - the same in that rung, while @en is TRUE; @en 0: always. RETURN leads behind them. */
void st_put_box(struct ld *ld, uint32_t en, int first, int count);

/* ---- instructions, nets, leaves ---- */
/** ld_emit - one operator; places it at the present cell. */
void ld_emit(struct ld *ld, enum op op, uint8_t modifiers, uint32_t operand);
void ld_emit_line(struct ld *ld, struct il_line line);
/** ld_place - following instructions come from this cell (0-based). */
void ld_place(struct ld *ld, int row, int col);
/** ld_prepare - stores each net that @net needs and that several readers share in a temporary.
 * @readers of @net itself are served now. No result may be open. */
void ld_prepare(struct ld *ld, int net, int readers);
/** ld_routine - CALL of a subroutine. */
void ld_routine(struct ld *ld, int element);
/** ld_load - instructions whose result is the power of @net. */
void ld_load(struct ld *ld, int net);
/** ld_operand - a variable or TRUE that holds the power of @net; makes one. */
uint32_t ld_operand(struct ld *ld, int net);
/** ld_store_new - stores the result in a new temporary and returns it. */
uint32_t ld_store_new(struct ld *ld);
/** ld_freeze - before @operand is written: elements that read it earlier keep their value in a
 * temporary. */
void ld_freeze(struct ld *ld, uint32_t operand);
/** ld_freeze_all - the same before statements that may write any variable. */
void ld_freeze_all(struct ld *ld);
/** ld_freeze_globals - the same before a body that may write any global or address. */
void ld_freeze_globals(struct ld *ld);
/** ld_meaning - of an operand; NULL: none. */
const struct meaning *ld_meaning(struct ld *ld, uint32_t operand);
/** ld_is_indexed - is it an element whose index is computed in the scan? */
bool ld_is_indexed(struct ld *ld, uint32_t operand);

/* ---- elements whose index is computed in the scan ---- */
/** ld_fetch - such an element as it is now, in a new temporary
 * @en:  operand that enables it
 * @eno: gets a temporary: is there such an element? */
uint32_t ld_fetch(struct ld *ld, uint32_t element, uint32_t en, uint32_t *eno);

/* ---- ld_box.c ---- */
/** ld_row - the row of a word of the catalogue or the project. */
const struct word_row *ld_row(const struct ld *ld, enum word word);
/** ld_execute - the statements of an EXECUTE box. */
void ld_execute(struct ld *ld, int element);
/** ld_box - a function or function block at its place in phase 1. */
void ld_box(struct ld *ld, int element);

/* ---- ld_expr.c ---- */
/** ld_compare - [ … ]: sets the element's leaf. */
void ld_compare(struct ld *ld, int element);
/** ld_assign - [ … := … ]: stores; sets the element's leaf to ENO. */
void ld_assign(struct ld *ld, int element);
/* The expression in ld->expr, of a statement. A part that cannot be computed (a division by 0, an
 * element that does not exist) leaves everything as it is. */
/** ld_store - target := expression. */
void ld_store(struct ld *ld);
/** ld_value - its value as an operand
 * @type: that is wanted where it goes; IEC_NONE: any. Gets its type
 * @good: gets the BOOL that tells whether it could be computed; 0: it always can */
uint32_t ld_value(struct ld *ld, enum iec_type *type, uint32_t *good);
/** ld_test - the result is its value, a BOOL: FALSE if it could not be computed. Returns its
 * type. */
enum iec_type ld_test(struct ld *ld);
/** ld_target - the operand of a variable, an element or a whole structure, array or instance. @good gets the
 * BOOL that tells whether its indices could be computed; 0: they can. */
uint32_t ld_target(struct ld *ld, uint32_t *good);
/** ld_call - begins a formal call; ld_arg adds to it. */
void ld_call(struct ld *ld, enum word function);
void ld_arg(struct ld *ld, bool output, uint32_t pin, uint32_t operand);
#endif
