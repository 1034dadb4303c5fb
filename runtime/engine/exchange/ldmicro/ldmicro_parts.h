/* SPDX-License-Identifier: MIT
 *
 * ldmicro_parts - what the files of this room share. Only they include it.
 */
#ifndef LDMICRO_PARTS_H
#define LDMICRO_PARTS_H

#include "engine/exchange/ldmicro/ldmicro.h"

/* A bit or a number. Both may have one name: LDmicro tells them apart by their use. */
struct ldmicro_var {
	const char *name;        /* in the file                                    */
	const char *ours;        /* here                                           */
	bool bit, retain;
	bool is_block;           /* a TON or TOF has the name: no number of its own */
	int bytes;               /* of a number: 1, 2 or 4                         */
	const char *at;          /* "%IX0.0"; NULL: no address                     */
	const char *comment;     /* NULL: none                                     */
	long long init;
	int uses;                /* elements that name it                          */
	int line;
};

/* The blocks that a text brings with it. */
enum ldmicro_block {
	BLOCK_TON, BLOCK_TOF, BLOCK_RTO, BLOCK_RTL, BLOCK_TCY, BLOCK_THI, BLOCK_TLO,
	BLOCK_CTU, BLOCK_CTD, BLOCK_CTC, BLOCK_CTR, BLOCK_OSC, BLOCK_ODF, BLOCK_NOTHING,
	BLOCKS
};

enum piece_kind {
	PIECE_WIRE,              /* power goes through                             */
	PIECE_TEST,              /* a contact or a comparison                      */
	PIECE_BOX,               /* a block: power comes out of it                 */
	PIECE_LINES,             /* an Execute box, or a cell with an assignment   */
	PIECE_COIL,              /* ends its branch; further coils may follow      */
	PIECE_EDGE,              /* an edge, and what it does: ends its branch     */
	PIECE_JUMP,              /* ends its branch, and perhaps the rung          */
	PIECE_MASTER             /* stands in a rung of its own                    */
};

struct name_list { const char **name; int count; };

/* What an element becomes. */
struct ldmicro_piece {
	enum piece_kind kind;
	const char *cell;        /* in a row                                       */
	const char *edge;        /* of PIECE_EDGE: the cell before it              */
	const char *last;        /* in place of @cell at the end of a branch; NULL */
	const char *lines;       /* of an Execute box; NULL: it is none            */
	bool all;                /* it may read and write anything                 */
	struct name_list reads, writes;
};

struct ldmicro_conversion {
	struct import *import;
	struct ldmicro_program *program;
	struct writing w;        /* the rungs                                      */
	struct names spelled;    /* names of the file, which mind the case         */
	int *of[2], of_count[2]; /* by their id: a number or a bit, 1-based in @var */
	struct ldmicro_var **var; int vars;
	struct { const char *type, *name; } *instance; int instances;
	bool needs[BLOCKS][3];   /* by the type of its count: SINT, INT, DINT       */
	const char **block_name[BLOCKS];
	bool jumps;              /* rungs may be left out in a scan                */
	const char *master;      /* the bit of the master relay; NULL: none yet    */
	bool *target;            /* of each rung: something jumps to it            */
	const char **label;      /* of each rung; NULL: none                       */
	int *owner;              /* of each rung: the rung of its SUBPROG; -1: none */
	const char **subprogram; /* of each rung that begins one: its name         */
	const char *nowhere;     /* a coil that ends branches; NULL: not needed    */
	int inputs, outputs, words_in, words_out; /* addresses given               */
	int rung;                /* in work, 0-based                               */
	const char *pending_label;
	struct name_list pending_comment;
	struct grid *grid;
	struct ldmicro_var nothing; /* without memory: a variable that is in no list */
};

/* ---- names and declarations: ldmicro_names.c ---- */
bool names_find_all(struct ldmicro_conversion *c);
/** var_of - the bit or number of a name of the file; made at its first use. */
struct ldmicro_var *var_of(struct ldmicro_conversion *c, const char *name, bool bit);
/** word_address - an address for an input or output of 16 bits, given once all bits are known; NULL: none
 * is left. */
const char *word_address(struct ldmicro_conversion *c, bool output);
/** type_of - SINT, INT or DINT by bytes. */
const char *type_of(int bytes);
/** instance_new - declares a block; returns its name. */
const char *instance_new(struct ldmicro_conversion *c, const char *type, const char *wish);
/** block_of - the name of one of the text's own blocks, which will be written. */
const char *block_of(struct ldmicro_conversion *c, enum ldmicro_block block, int bytes);
/** bit_new - a bit that LDmicro does not show. */
const char *bit_new(struct ldmicro_conversion *c, const char *wish);
/** cut_new - a number for a step of an expression. */
const char *cut_new(struct ldmicro_conversion *c, int bytes);
/** period_of - a timer's delay in cycles; 0: the delay is a variable. */
long long period_of(const struct ldmicro_conversion *c, const struct ldmicro_node *node);
void write_blocks(struct ldmicro_conversion *c, struct writing *w);
void write_declarations_of(struct ldmicro_conversion *c, struct writing *w);
/** name_add - one more name of a list. */
void name_add(struct ldmicro_conversion *c, struct name_list *list, const char *name);

/* ---- elements: ldmicro_piece.c ---- */
/** piece_of - what a leaf becomes, made once. NULL: no memory. */
struct ldmicro_piece *piece_of(struct ldmicro_conversion *c, struct ldmicro_node *node);

/* ---- rungs: ldmicro_rung.c ---- */
void convert_ldmicro_rung(struct ldmicro_conversion *c, int index);
/** write_filler - a rung without an effect, for a label or a comment that waits for one. */
void write_filler(struct ldmicro_conversion *c);
#endif
