/* SPDX-License-Identifier: MIT
 *
 * to_classic_parts - what the parts of the way back to ClassicLadder share.
 *
 * Private to to_classic*.c: to_classic sections and programs, to_classic_names
 * numbers and symbols, to_classic_expression arithmetic, to_classic_rung one rung as it is
 * drawn, to_classic_split one that must be cut, to_classic_sfc pages.
 */
#ifndef CLASSIC_TO_CLASSIC_PARTS_H
#define CLASSIC_TO_CLASSIC_PARTS_H

#include "engine/check/scope.h"
#include "engine/exchange/classic/classic_write.h"
#include "engine/model/expr.h"
#include "engine/model/network.h"
#include "engine/exchange/classic/to_classic.h"

#include <stdarg.h>

/* Codes of elements and variables: classic.def and facts of the format. */
enum {
	CL_FREE = 0, CL_NO = 1, CL_NC = 2, CL_RISING = 3, CL_FALLING = 4, CL_WIRE = 9,
	CL_OLD_TIMER = 10, CL_MONOSTABLE = 11, CL_COUNT = 12, CL_IEC = 13, CL_REGISTER_BOX = 14,
	CL_COMPARE = 20, CL_COIL = 50, CL_COIL_NOT = 51, CL_SET = 52, CL_RESET = 53,
	CL_JUMP = 54, CL_CALL = 55, CL_OPERATE = 60, CL_PART = 99,
	CL_BIT = 0, CL_STEP_BIT = 30, CL_SYSTEM_BIT = 70, CL_WORD = 200, CL_STEP_TIME = 220,
	CL_INPUT_SYSTEM_WORD = 290,
};
enum block_kind { BLOCK_TIMER, BLOCK_MONO, BLOCK_IEC, BLOCK_COUNTER, BLOCK_REGISTER,
		  BLOCK_KINDS };

/* A variable or instance, and what it is there. */
struct out_slot {
	const struct var *var;
	const struct pou *pou;
	int type, number, count;
	int block;             /* enum block_kind; -1: memory, a step          */
	const char *name, *comment;
	int calls;             /* boxes of it                                  */
	int extra[4];          /* bits of an instance that stands for several;
				  -1: none yet                                 */
};

/* One operand. */
struct out_operand {
	struct classic_variable variable;
	bool is_bool, is_constant;
	int32_t value;
};

/* Something that must be worked out before an element: a word or a bit. */
struct out_before {
	const char *text;      /* an expression                               */
	int bit;               /* a comparison gives this %B; -1: text stores  */
	struct out_before *next;
};

/* An element of a rung in ClassicLadder's terms. */
struct out_part {
	int code, width, height;
	struct classic_variable variable; /* of blocks: number                 */
	const char *text;      /* of compare, operate                          */
	struct out_before *before, *after;
	uint32_t label;        /* of a jump: folded                            */
	bool leaves;           /* a jump to the end                            */
	bool dead;             /* never gives power                            */
	bool actor, invert, output;
	int edge;              /* of a coil: CL_RISING, CL_FALLING; 0: none    */
	int in, out;           /* nets                                         */
	int pin[4];            /* nets of the rows of a block, -1: none        */
	struct classic_variable given[4]; /* instead of a net: a variable; type -1 */
	bool inverse[4];
	bool moved;            /* its inputs stand in other rows there          */
	struct out_slot *slot;
	enum word word;
	int row, col;
	int order;             /* when it is evaluated; -1: never              */
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
	int next_bit, next_word, next_block[BLOCK_KINDS];
	int sizes[400];        /* by type: highest number + 1                  */
	bool word_index, bit_index;
	bool has_period;       /* a task says it                              */
	bool divides, sums, indexes, clocks; /* what means something else there: told
				  once for all                                */
	uint8_t wide[2];       /* widths of %AI, %AQ in use: 1 16 bits, 2 32   */
	bool asks_first;       /* a text may name SYS_FIRST_SCAN                */
	int first;             /* a bit that is it; -1: none                   */
	int free_step;         /* numbers of steps before it are given         */
	int started, never;    /* bits: a scan has been; never TRUE. -1: not needed */
	/* the POU in work */
	const struct pou *pou;
	int *spare; int spares, helpers_used;
	int rung_index, row, col;
	struct classic_section *section;
	struct out_label *label; int labels;
	struct out_jump *jump; int jumps;
	const char *comment;   /* of the next rung; NULL: none                 */
	uint32_t rung_label;
	const struct pou **routine; int routines;
	bool good;
};

/* ---- to_classic.c ---- */
/** out_refuse - a diagnostic about the cell in work. Returns false. */
bool out_refuse(struct leaving *e, enum diag_id id, const char *format, ...)
	__attribute__((format(printf, 3, 4)));
/** tell_change - a line of the report about it. */
void tell_change(struct leaving *e, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** tell_line - about the project, with a line of its file; 0: none. */
void tell_line(struct leaving *e, int line, const char *format, ...)
	__attribute__((format(printf, 3, 4)));
const char *out_text(struct leaving *e, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** rung_begin - one more rung behind the last of the section. NULL: no memory, or there
 * are too many. */
struct classic_rung *rung_begin(struct leaving *e);
/** section_begin, section_end - one more; @drop: not if it has no rung. */
void section_begin(struct leaving *e, const char *name, int subroutine, bool sequential);
void section_end(struct leaving *e, bool drop);
/** add_expression - its number. */
int add_expression(struct leaving *e, const char *text);
/** blocks_end - the highest number + 1. Scan-safe: yes. */
int blocks_end(const struct classic_blocks *blocks);
/** routine_number - of a subroutine; -1: it is none. */
int routine_number(struct leaving *e, uint32_t name);

/* ---- to_classic_kept.c ---- */
/** leave_kept - what an import kept goes back. */
void leave_kept(struct leaving *e);

/** is_shared - has anything else a part of its memory? Scan-safe: no. */
bool is_shared(struct leaving *e, const struct var *var);

/* ---- to_classic_names.c ---- */
bool names_prepare(struct leaving *e);
void names_symbols(struct leaving *e);
/** there_find - what a text means there; false after telling. */
bool there_find(struct leaving *e, uint32_t text, struct out_operand *out);
bool there_text(struct leaving *e, const char *text, size_t len, struct out_operand *out);
/** slot_find - of an instance; NULL: none. */
struct out_slot *slot_find(struct leaving *e, const struct var *var);
int new_bit(struct leaving *e);
int new_word(struct leaving *e);
/** spare_bit - one that lasts for a rung. */
int spare_bit(struct leaving *e);
int never_bit(struct leaving *e);
void size_note(struct leaving *e, int type, int number);
struct classic_variable variable_of(int type, int number);
/** extra_bit - bit @index of an instance that is none of ClassicLadder's blocks. */
int extra_bit(struct leaving *e, struct out_slot *slot, int index);

/* ---- to_classic_expression.c ---- */
/** cell_expression - of a [ … ] cell; false after telling. */
bool cell_expression(struct leaving *e, const char *text, struct out_part *item);
/** out_encode - @200/3@. */
const char *out_encode(struct leaving *e, struct classic_variable variable);

/** pou_is_imported - one of the functions that an import brings along? Scan-safe: yes. */
bool pou_is_imported(const struct project *project, const struct pou *pou);

/* ---- to_classic_told.c ---- */
/** leave_told - what has been written nowhere. */
void leave_told(struct leaving *e);

/* ---- to_classic_box.c ---- */
/** box_part - an instance in a rung. */
bool box_part(struct leaving *e, const struct network *network,
	      const struct network_element *at, const struct cell *cell,
	      struct out_part *item);

/** runs_often - may the rung in work run more than once in a scan? Scan-safe: no. */
bool runs_often(struct leaving *e);
/** may_rest - may a scan pass it over? Scan-safe: yes. */
bool may_rest(struct leaving *e);
/** blocks_prepare - presets and modes of all blocks. */
void blocks_prepare(struct leaving *e);
/** box_is_plain - can it be drawn as it stands? Scan-safe: yes. */
bool box_is_plain(const struct out_part *item);

/* ---- to_classic_rung.c, to_classic_draw.c, to_classic_split.c ---- */
struct out_rung {
	struct network network;
	const struct rung *rung;
	struct out_part *item; /* by element of the network                    */
	int count, order;
	bool plain;            /* nothing in it must be worked out before     */
	bool boxes;            /* something in its middle does more than read  */
	bool *net_seen;
};
void leave_rung(struct leaving *e, const struct rung *rung);
/** out_put - an element whose left top cell is at (y, x). */
void out_put(struct leaving *e, struct classic_rung *rung, int y, int x,
	      const struct out_part *item);
/** note_jump - a jump at that cell: its rung is found when all are there. */
void note_jump(struct leaving *e, struct classic_cell *cell, const struct out_part *item);
/** part_touches - does @item read what @box writes, or is it the same block? */
bool part_touches(const struct out_part *item, const struct out_part *box);
/** is_block - one of ClassicLadder's own. Scan-safe: yes. */
static inline bool is_block(const struct out_part *item)
{
	return item->code >= CL_OLD_TIMER && item->code <= CL_REGISTER_BOX;
}
void split_rung(struct leaving *e, struct out_rung *r);
/** draw_step - a rung of a contact, or the rail (@code CL_WIRE), and an output. */
void draw_step(struct leaving *e, int code, struct classic_variable variable,
	       const struct out_part *output);
/** pin_kind - of which kind of block is this type a pin? -1: of none. */
int pin_kind(int type);

/* ---- initial values ---- */
/** leave_initial - what variables begin with; leave_started - that the first scan has been. */
void leave_initial(struct leaving *e);
void leave_started(struct leaving *e);
/** leave_temporaries - VAR_TEMP of the POU begin anew each time it runs. */
void leave_temporaries(struct leaving *e, const struct pou *pou);

/** sfc_prepare - numbers of steps, before anything is named. */
void sfc_prepare(struct leaving *e, const struct pou *pou, int page);
void leave_sfc(struct leaving *e, const struct pou *pou, int page);
#endif
