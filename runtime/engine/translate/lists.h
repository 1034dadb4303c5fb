/* SPDX-License-Identifier: MIT
 *
 * lists - the state of the assembler for one instruction list.
 *
 * Private to the assembler: assemble_unit.c walks the lines, temps.c counts reads of
 * temporaries, list_logic.c does AND OR XOR NOT and jumps, call.c calls.
 */
#ifndef TRANSLATE_LISTS_H
#define TRANSLATE_LISTS_H

#include "engine/translate/assembler.h"

/* A structure or array that was read; the BOOL tells whether it exists. */
struct whole_value {
	const struct meaning *m;
	uint32_t at, ok;
	bool own;                     /* a copy that nobody else writes       */
};

/* The current result of IEC 61131-3: nothing, a bit, a number in memory, a constant without a
 * type, or a structure or array. */
enum result_kind { RESULT_NONE, RESULT_BITS, RESULT_NUMBER, RESULT_LITERAL, RESULT_WHOLE };
struct il_result {
	enum result_kind kind;
	struct bits bits;
	uint32_t operand;             /* typed, of RESULT_NUMBER              */
	bool own;                     /* the number is a scratch value        */
	const struct literal *literal;
	struct whole_value whole;     /* of RESULT_WHOLE                      */
};

/* A temporary whose bit has not been stored. */
struct pending {
	int var;
	int left;                     /* reads to come                        */
	struct bits value;
};
#define PENDING_MAX 64

struct opened {
	struct il_result left;        /* a number: own                        */
	uint8_t op, modifiers;
	enum word word;               /* of a function; 0: of an operator     */
};

struct list {
	struct assembler *as;
	const struct unit *unit;
	const struct pou *pou;
	const struct il *il;
	const enum iec_type *types;
	int at;                       /* the current line                     */
	uint32_t number;              /* instructions so far, those that only keep power not
				       * counted; only while listing          */
	struct il_result now;
	struct opened opened[LIMIT_IL_DEPTH];
	int depth;
	bool straight;                /* no label or jump so far: every scan  */
	uint8_t *fleeting;            /* by variable: never kept over a label */
	struct shift {
		const struct meaning *of; /* NULL: it is none                 */
		int32_t by;
	} *shift;                     /* by variable: it is `of` + `by`; NULL: none is so far */
	int *reads;                   /* by line of a store: reads to come    */
	struct pending pending[PENDING_MAX];
	int pending_count;
	uint32_t *label;              /* by folded name: word index + 1       */
	uint8_t *looped;              /* by folded name: a jump leads back to it */
	uint32_t label_count;
	uint32_t kinds_line, kinds;   /* kinds of the statements of the line that was looked at last */
	int kinds_item;               /* the statement behind them             */
	struct fixup { uint32_t word, fold; bool jump; } *fixup; /* jump: of JMP */
	int fixup_count;
};

/* ---- temps.c ---- */
/** list_count_reads - which temporaries need no memory, and how often each value
 * of theirs is read. Fails: false when memory is out. */
bool list_count_reads(struct list *list);
/** list_temp - variable index if this operand is a temporary without memory, else -1. */
int list_temp(const struct list *list, const struct meaning *m);

/* ---- assemble_unit.c ---- */
/** list_row - the row of a word of the catalogue or the project. */
const struct word_row *list_row(const struct list *list, enum word word);
const struct meaning *list_meaning(struct list *list, uint32_t operand);
/** list_protect - before @size bytes at @offset are written: values that read
 * them are stored first. */
void list_protect(struct list *list, uint32_t offset, uint32_t size);
/** list_keep_all - stores everything that waits, before a jump. */
void list_keep_all(struct list *list);
/** list_now_bits - the current result as a bit; the result does not change. */
struct bits list_now_bits(const struct list *list);
/** list_bits - a BOOL operand as a truth table. */
struct bits list_bits(struct list *list, const struct meaning *m);
/** list_write_bits - stores a bit where @m says. */
void list_write_bits(struct list *list, const struct meaning *m,
		     const struct bits *value);
/** list_number - a number operand as a typed word; constants as @type. */
uint32_t list_number(struct list *list, const struct meaning *m,
		     enum iec_type type);
/** list_slot - offset of a BOOL that holds @value now. */
uint32_t list_slot(struct list *list, const struct bits *value);
/** list_keep - the same, in a slot that @value alone uses. */
uint32_t list_keep(struct list *list, const struct bits *value);
/** list_copy - COPY, always enabled. */
void list_copy(struct list *list, uint32_t to, uint32_t from);
/** list_load - LD. */
void list_load(struct list *list, const struct il_line *line);
/** list_place - the next instruction comes from this line's cell. */
void list_place(struct list *list);

/* ---- list_logic.c ---- */
/** list_logic - AND OR XOR with N and parentheses; list_close the other end. */
void list_logic(struct list *list, const struct il_line *line);
void list_close(struct list *list);
/** list_open - AND( or ADD( : the value left of it waits. */
void list_open(struct list *list, const struct il_line *line);
/** list_not - NOT on the result. */
void list_not(struct list *list);
/** list_invert - inverts the result, bits of @type if it is a constant. */
void list_invert(struct list *list, enum iec_type type);
/* ---- element.c ---- */
/**
 * list_fetch - an element whose index is found out in the scan, in a place of its own
 * @en: BOOL that enables it
 * @ok: gets the BOOL that tells whether there is one
 *
 * Returns a typed word; what it holds is 0 when there is none, but for a structure or
 * array: then it is as it was, and the type of the word is IEC_NONE.
 */
uint32_t list_fetch(struct list *list, const struct meaning *m, uint32_t en,
		    uint32_t *ok);
/** list_fetch_to - the same to @to, a typed word of the same type, which stays as it was if there
 * is none; returns @ok. Not for a structure, an array, or what a pointer leads to. */
uint32_t list_fetch_to(struct list *list, const struct meaning *m, uint32_t en, uint32_t to);
/** list_deposit - stores @from, a typed word, in such an element while @en. Returns the BOOL
 * that tells whether it exists. */
uint32_t list_deposit(struct list *list, const struct meaning *m, uint32_t en,
		      uint32_t from);
/** list_keep_range - stores @from at @to, if it is a value of @range; typed words. */
void list_keep_range(struct list *list, const struct var_range *range, uint32_t to,
		     uint32_t from);
/* ---- part.c: a bit, byte or word of a number ---- */
/** list_fetch_part, list_deposit_part - list_fetch() and list_deposit() of such a part. */
uint32_t list_fetch_part(struct list *list, const struct meaning *m, uint32_t en, uint32_t *ok);
uint32_t list_deposit_part(struct list *list, const struct meaning *m, uint32_t en, uint32_t from);
/** list_constant - a typed word that holds @bits. */
uint32_t list_constant(struct list *list, enum iec_type type, uint64_t bits);
/** list_run - a function that cannot fail here, into a place of its own; @right 0: it has one input. */
uint32_t list_run(struct list *list, enum word fn, enum iec_type result, uint32_t left, uint32_t right);
/** list_convert - @from as a value of @type. */
uint32_t list_convert(struct list *list, uint32_t from, enum iec_type type);
/** list_fetch_whole - a structure or array behind such an index goes to @to; returns as
 * list_deposit(). */
uint32_t list_fetch_whole(struct list *list, const struct meaning *m, uint32_t en,
			  uint32_t to);

/* Operands of the computed indices of a path, and the place of the pointer that leads to it. */
struct indices { uint32_t operand[LIMIT_INDICES], low[LIMIT_INDICES], pointer; };
/* ---- call.c: an index that differs from a variable by a constant (IL_INDEX) ---- */
/** list_shift - what @m, a temporary, differs from; NULL: from nothing. */
const struct shift *list_shift(const struct list *list, const struct meaning *m);
/** list_take_out - an output of a call is written: in the current line. */
void list_take_out(struct list *list);
/** list_unshift - @m is written. */
void list_unshift(struct list *list, const struct meaning *m);

/** list_borrow - an instance behind such an index goes to @to, where it is called; @out gets the indices in places
 * that no body writes. Returns the BOOL that tells whether there is one. */
uint32_t list_borrow(struct list *list, const struct meaning *m, uint32_t to, struct indices *out);
/** list_give_back - the instance at @from goes back to its element. */
void list_give_back(struct list *list, const struct meaning *m, uint32_t from,
		    const struct indices *indices);
/* The power of the cells of a body, @size bytes, goes to the element's part of @to; an instance
 * has @unit bytes. */
struct element_power { uint32_t to, from, size, unit; };
void list_keep_power(struct list *list, const struct meaning *m, const struct indices *indices,
		     const struct element_power *power);

/* ---- whole.c: structures and arrays as a whole ---- */
/** list_copy_whole - @size bytes, what waits for them stored before. */
void list_copy_whole(struct list *list, uint32_t to, uint32_t from, uint32_t size);
/** list_load_result, list_store_result - LD and ST of a structure or array. */
void list_load_result(struct list *list, const struct meaning *m);
void list_store_result(struct list *list, const struct meaning *m);
/** list_is_whole_move - is the line a MOVE of a structure or array? */
bool list_is_whole_move(struct list *list);
/** list_whole_move - that MOVE, while @en; returns as list_store_whole(). */
uint32_t list_whole_move(struct list *list, uint32_t en);

/* ---- function.c ---- */
/** list_table - the comparison, as a table for bits_compare(). */
uint32_t list_table(enum word word);
/** list_is_compare - GT to NE? */
bool list_is_compare(enum word word);
/** list_compare - the result becomes that of a comparison of two typed words. */
void list_compare(struct list *list, enum word word, uint32_t left, uint32_t right);
/* A function of the image and its typed operands, CODE_OWN where each input has its own
 * type. */
struct fn_code {
	uint32_t fn;
	enum iec_type type, result;
	uint32_t en, eno, to, count, input[LIMIT_FN_ARGS];
	bool left; /* without a result `to` gets the first input, if list_stores_left() */
};
/** list_emit_fn - the instruction that runs it. */
void list_emit_fn(struct list *list, const struct fn_code *fn);
/** list_stores_left - does the instruction store something for all operands, if @fn->left? */
bool list_stores_left(const struct fn_code *fn);
/** list_copy_if - COPY while the BOOL at @en is TRUE. */
void list_copy_if(struct list *list, uint32_t en, uint32_t to, uint32_t from);

/* ---- jumps ---- */
/** list_find_labels - before the first line. Fails: false when memory is out. */
bool list_find_labels(struct list *list);
/** list_jumps_back - whether a jump behind this label leads to it: it begins a loop. */
bool list_jumps_back(const struct list *list, const struct il_line *label);
/** list_target - a word for the place of a label; 0: for the end of the list. */
void list_target(struct list *list, uint32_t name);
/** list_is_ahead - does a label stand further down? */
bool list_is_ahead(const struct list *list, uint32_t name);
/** list_flow - JMP and RET. */
void list_flow(struct list *list, const struct il_line *line);
/** list_stop - STP. */
void list_stop(struct list *list, const struct il_line *line);
/** list_label - a label: all waiting values are stored before it. */
void list_label(struct list *list, const struct il_line *line);
/** list_choices - how many lines from here on compare one number with constants and jump; they become
 * one SWITCH, if they are many and their constants lie close together. 0: none. @list->now becomes
 * what it is behind them. */
int list_choices(struct list *list);
/** list_each - IL_EACH with its labels; list_tick - IL_TICK. */
void list_each(struct list *list);
void list_tick(struct list *list);
/** list_patch - fills in the targets; @end: where RET goes. */
void list_patch(struct list *list, uint32_t end);

/* ---- call.c ---- */
/** list_sink - an offset for a value that nobody reads. */
uint32_t list_sink(struct assembler *as, enum iec_type type);
/** list_operand - a result as an operand; a constant as @type. */
uint32_t list_operand(struct list *list, const struct il_result *result,
		      enum iec_type type);
/** list_fn - a function on the result: ADD 5. */
void list_fn(struct list *list, const struct il_line *line);
/** list_close_fn - the function before a parenthesis that ends here. */
void list_close_fn(struct list *list, const struct opened *open);
/** list_call - a function with formal parameters; the lines behind it too. */
void list_call(struct list *list);
/** list_cal - a call of an instance; the lines behind it too. */
void list_cal(struct list *list);
/** list_skip_missing - looks up inputs that are elements, and jumps over the call if one is
 * missing. @kept: nothing waits any more. @fetched: by number of the parameter; 0: no element.
 * Returns as list_skip_call(); -1: no jump. */
int list_skip_missing(struct list *list, bool kept, uint32_t fetched[LIMIT_ARGS]);
/** list_fetch_args - the same for a function, its OUT too: @en is FALSE if an element is
 * missing. */
void list_fetch_args(struct list *list, struct bits *en,
		     uint32_t fetched[LIMIT_ARGS]);
/** list_skip_call - a jump over the following code unless the result is TRUE (N: FALSE); stores
 * everything that waits before it. list_end_skip() ends it; < 0: none. */
int list_skip_call(struct list *list, const struct il_line *line);
/** list_skip_kept - the same where all values have been kept: a jump that leads over this place must
 * not lead over stores of them. */
int list_skip_kept(struct list *list, const struct il_line *line);
/** list_skip_unborrowed - a jump over the call of an instance that list_borrow() did not find; all values have
 * been kept. */
int list_skip_unborrowed(struct list *list, uint32_t ok);
void list_end_skip(struct list *list, int skip);

/* ---- call_own.c: functions and blocks of the project ---- */
void list_own_fn(struct list *list);
/** list_own_call - a formal call, or a MOVE of a structure. */
void list_own_call(struct list *list);
void list_own_cal(struct list *list);
/** list_routine - CAL of a SUBROUTINE. */
void list_routine(struct list *list, const struct pou *routine);
#endif
