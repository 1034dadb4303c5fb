/* SPDX-License-Identifier: MIT
 *
 * to_classic_parts - types and functions that the files of the export to ClassicLadder share.
 *
 * Private to to_classic*.c: to_classic writes programs and settings, to_classic_out is what all of them write
 * with, to_classic_names has numbers and symbols, to_classic_expression arithmetic, to_classic_rung a rung as it is drawn,
 * to_classic_split one that must be cut, to_classic_sfc pages.
 */
#ifndef CLASSIC_TO_CLASSIC_PARTS_H
#define CLASSIC_TO_CLASSIC_PARTS_H

#include "engine/check/scope.h"
#include "engine/exchange/classic/classic_write.h"
#include "engine/model/expr.h"
#include "engine/model/network.h"
#include "engine/exchange/classic/to_classic.h"

#include <stdarg.h>

/* Codes of elements and variables in the files. */
enum {
	CL_FREE = 0, CL_NO = 1, CL_NC = 2, CL_RISING = 3, CL_FALLING = 4, CL_WIRE = 9,
	CL_OLD_TIMER = 10, CL_MONOSTABLE = 11, CL_COUNT = 12, CL_IEC = 13, CL_REGISTER_BOX = 14,
	CL_COMPARE = 20, CL_COIL = 50, CL_COIL_NOT = 51, CL_SET = 52, CL_RESET = 53,
	CL_JUMP = 54, CL_CALL = 55, CL_OPERATE = 60, CL_PART = 99,
	CL_BIT = 0, CL_STEP_BIT = 30, CL_SYSTEM_BIT = 70, CL_WORD = 200, CL_STEP_TIME = 220,
	CL_INPUT_SYSTEM_WORD = 290,
};
/* A variable or instance, and its number in ClassicLadder. */
struct out_slot {
	const struct var *var;
	const struct pou *pou;
	int type, number, count;
	int block;             /* enum classic_kind; -1: memory, a step          */
	const char *name, *comment;
	int calls;             /* boxes that call it                           */
	int extra[4];          /* bits that an instance without a block uses;
				  -1: none yet                                 */
};

/* One operand. */
struct out_operand {
	struct classic_variable variable;
	bool is_bool, is_constant;
	int32_t value;
};

/* A word or bit that a rung computes before or after an element. */
struct out_before {
	const char *text;      /* an expression                               */
	int bit;               /* %B that gets a comparison; -1: text stores   */
	struct out_before *next;
};

/* An element of a rung, with codes and numbers of ClassicLadder. */
struct out_part {
	int code, width, height;
	struct classic_variable variable; /* of blocks: number                 */
	const char *text;      /* of compare, operate                          */
	struct out_before *before, *after;
	uint32_t label;        /* of a jump: folded                            */
	bool leaves;           /* a jump to the end of the section             */
	bool dead;             /* never gives power                            */
	bool actor, invert, output;
	int edge;              /* of a coil: CL_RISING, CL_FALLING; 0: none    */
	int in, out;           /* nets                                         */
	int pin[4];            /* nets of the rows of a block; -1: none        */
	struct classic_variable given[4]; /* a variable instead of a net; type -1: none */
	bool inverse[4];       /* of given                                     */
	bool moved;            /* ClassicLadder has its inputs in other rows   */
	struct out_slot *slot;
	enum word word;
	int row, col;
	int order;             /* of evaluation; -1: never                     */
	int id;                /* 1 + its number in the rung; 0: made here     */
};

struct out_jump { struct classic_cell *cell; uint32_t label; bool leaves; };
struct out_label { uint32_t label; int number; };

struct leaving {
	struct project *project;
	enum classic_dialect dialect;
	int columns, rows;
	struct arena *arena;
	struct scope *scope;
	struct classic_report *report;
	struct diag_list *diags;
	const struct classic_lines *lines; /* of an I/O map; NULL: none        */
	struct classic_project *out;
	struct expr *expr;
	struct out_slot *slot; int slots;
	int next_bit, next_word, next_block[CLASSIC_KINDS];
	int sizes[400];        /* by type: highest number + 1                  */
	bool word_index, bit_index;
	bool has_period;       /* a task has an interval                       */
	bool divides, sums, indexes, clocks; /* in use, with other results in
				  ClassicLadder: one line of the report each   */
	uint8_t wide[2];       /* widths of %AI, %AQ in use: 1 16 bits, 2 32   */
	bool asks_first;       /* the project names SYS_FIRST_SCAN             */
	int first;             /* the bit in its place; -1: none               */
	int free_step;         /* smaller numbers of steps are taken           */
	int started, never;    /* bits: TRUE after the first scan; never TRUE; -1: not needed */
	/* the POU in work */
	const struct pou *pou;
	int *spare; int spares, helpers_used;
	int rung_index, row, col;
	bool *written;         /* by id: the export has it; NULL: no rung in work */
	struct classic_section *section;
	struct out_label *label; int labels;
	struct out_jump *jump; int jumps;
	const char *comment;   /* of the next rung; NULL: none                 */
	uint32_t rung_label;
	const struct pou **routine; int routines;
	bool good;
};

/* ---- to_classic_out.c ---- */
/** out_refuse - adds a diagnostic about the cell in work. Returns false. */
bool out_refuse(struct leaving *e, enum diag_id id, const char *format, ...)
	__attribute__((format(printf, 3, 4)));
/** tell_change - adds a line to the report about the cell in work. */
void tell_change(struct leaving *e, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** tell_lost - the same: an element is left out. */
void tell_lost(struct leaving *e, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** tell_line - adds a line to the report about the project. @line: of its file; 0: none. */
void tell_line(struct leaving *e, int line, const char *format, ...)
	__attribute__((format(printf, 3, 4)));
const char *out_text(struct leaving *e, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** rung_begin - adds an empty rung to the section. NULL: no memory, or too many. */
struct classic_rung *rung_begin(struct leaving *e);
/** section_begin, section_end - adds a section. @drop: removes it if it has no rung. */
void section_begin(struct leaving *e, const char *name, int subroutine, bool sequential);
void section_end(struct leaving *e, bool drop);
/** blocks_end - the highest number + 1; 0: no block. Scan-safe: yes. */
int blocks_end(const struct classic_blocks *blocks);
/** routine_number - number of subroutine @name; -1: it is none. */
int routine_number(struct leaving *e, uint32_t name);

struct classic_variable variable_of(int type, int number);
/** out_put - puts an element with its upper left cell at (y, x). */
void out_put(struct leaving *e, struct classic_rung *rung, int y, int x,
	      const struct out_part *item);
/** note_jump - notes a jump; section_end() sets its target. */
void note_jump(struct leaving *e, struct classic_cell *cell, const struct out_part *item);
/** plain_title - the text of a title without its quotes and `$`. */
const char *plain_title(struct leaving *e, const char *text);

/* ---- to_classic_kept.c ---- */
/** leave_kept - writes what an import kept in VIEW. */
void leave_kept(struct leaving *e);

/* ---- to_classic_names.c ---- */
bool names_prepare(struct leaving *e);
void names_symbols(struct leaving *e);
/** there_find, there_text - the variable or constant that a text means. false: refused. */
bool there_find(struct leaving *e, uint32_t text, struct out_operand *out);
bool there_text(struct leaving *e, const char *text, size_t len, struct out_operand *out);
/** slot_find - slot of a variable or instance; NULL: it has none. */
struct out_slot *slot_find(struct leaving *e, const struct var *var);
int new_bit(struct leaving *e);
int new_word(struct leaving *e);
/** new_bit, new_word - a number that nothing else has. spare_bit - the same until the end of
 * the rung. never_bit - a bit that is never TRUE. */
int spare_bit(struct leaving *e);
int never_bit(struct leaving *e);
void size_note(struct leaving *e, int type, int number);
/** extra_bit - bit @index of an instance that ClassicLadder has no block for. */
int extra_bit(struct leaving *e, struct out_slot *slot, int index);

/* ---- to_classic_expression.c ---- */
/** cell_expression - the expression of a `[ … ]` cell. false: refused. */
bool cell_expression(struct leaving *e, const char *text, struct out_part *item);
/** out_encode - "@200/3@", as expressions name a variable. */
const char *out_encode(struct leaving *e, struct classic_variable variable);

/** pou_is_imported - true for a function that an import writes. Scan-safe: yes. */
bool pou_is_imported(const struct project *project, const struct pou *pou);

/* ---- to_classic_told.c ---- */
/** leave_told - adds to the report what is not exported. */
void leave_told(struct leaving *e);

/* ---- to_classic_box.c ---- */
/** box_part - makes an element of a block. false: refused. */
bool box_part(struct leaving *e, const struct network *network,
	      const struct network_element *at, const struct cell *cell,
	      struct out_part *item);

/** blocks_prepare - sets presets and modes of all blocks. */
void blocks_prepare(struct leaving *e);
/** box_is_plain - true if it needs no rungs before or behind it. Scan-safe: yes. */
bool box_is_plain(const struct out_part *item);
/** part_touches - true if @item reads what @box writes, or calls the same block. */
bool part_touches(const struct out_part *item, const struct out_part *box);

/* ---- to_classic_rung.c, to_classic_split.c ---- */
struct out_rung {
	struct network network;
	const struct rung *rung;
	struct out_part *item; /* by element of the network                    */
	int count, order;
	bool plain;            /* needs no rungs before it                     */
	bool boxes;            /* has blocks, or elements in its middle that write */
	bool *net_seen;
};
void leave_rung(struct leaving *e, const struct rung *rung);
/** out_mark - notes that the export has this element. */
static inline void out_mark(struct leaving *e, const struct out_part *item)
{
	if (e->written)
		e->written[item->id] = true;
}
/** is_block - true for a block that ClassicLadder has. */
static inline bool is_block(const struct out_part *item)
{
	return item->code >= CL_OLD_TIMER && item->code <= CL_REGISTER_BOX;
}
void split_rung(struct leaving *e, struct out_rung *r);
/** draw_step - adds a rung of one contact (@code CL_WIRE: none) and an output. */
void draw_step(struct leaving *e, int code, struct classic_variable variable,
	       const struct out_part *output);

/* ---- initial values ---- */
/** leave_initial - adds rungs that set initial values. leave_started - adds the rung that ends
 * the first scan. */
void leave_initial(struct leaving *e);
void leave_started(struct leaving *e);
/** leave_temporaries - adds rungs that reset VAR_TEMP of the POU. */
void leave_temporaries(struct leaving *e, const struct pou *pou);

/** sfc_prepare - numbers the steps of a chart; before names_prepare(). */
void sfc_prepare(struct leaving *e, const struct pou *pou, int page);
void leave_sfc(struct leaving *e, const struct pou *pou, int page);
#endif
