/* SPDX-License-Identifier: MIT
 *
 * fbd_graph - one network of a function block diagram as boxes, pins and wires.
 *
 * It is made from the statements of the network whenever it is needed: nothing keeps it, nothing writes
 * it back. It checks nothing: a network with errors has a graph too, with what could be read of it.
 */
#ifndef MODEL_FBD_GRAPH_H
#define MODEL_FBD_GRAPH_H

#include "engine/model/project.h"

enum fbd_box_kind {
	FBD_FUNCTION, /* of the catalogue or the project, called by its name       */
	FBD_BLOCK,    /* an instance                                               */
	FBD_OPERATOR, /* AND OR XOR NOT + > …: one box for a AND b AND c           */
	FBD_TRIGGER,  /* R_EDGE( ), F_EDGE( )                                      */
	FBD_VALUE,    /* the source of a wire that is a variable or a constant: `Low := Level` */
	FBD_STORE,    /* target := value                                           */
	FBD_SET, FBD_RESET, /* target S= value, target R= value                    */
	FBD_JUMP,     /* JMP label [IF value]                                      */
	FBD_RETURN,   /* RETURN [IF value]                                         */
	FBD_STOP,     /* STOP [IF value]                                           */
};

struct fbd_pin {
	const char *name;     /* "": that of an operator, a store …                */
	const struct word_pin *declared; /* of the catalogue or the project; NULL: none */
	const char *operand;  /* in place: what it reads, or the variable behind => ; NULL: none */
	bool output;
	bool negated;         /* NOT before the operand or the wire; of an output: what leaves it is the inverse,
			       * and who reads the output itself is negated, too    */
	bool open;            /* nothing is written at it                          */
	bool previous;        /* the value of the scan before: PREVIOUS( ), or an output that is
			       * computed further down                            */
	bool extends;         /* one of the inputs that a person can add: IN3 of AND */
	int box;
	int wire;             /* an input: what it reads; an output: the first that leaves it; -1 */
	int at, len;          /* bytes of the item's text: the value; len 0: nothing is written */
	int line, column;     /* of it in the file, from 1; of an open pin those of its box */
};

struct fbd_box {
	enum fbd_box_kind kind;
	const char *type;     /* as drawn in it: "TON", "AND", ">", "R_EDGE", "S", ">>", "STOP"; "" of a store */
	const char *instance; /* above it; NULL: none                              */
	const char *target;   /* of a store, set, reset; the label of a jump; the value of
			       * FBD_VALUE; NULL: none                            */
	const struct word_row *row; /* of a function or block; NULL: not known     */
	int item;             /* the statement, of pou->st                         */
	bool nested;          /* not the outermost box of its statement            */
	int first_pin, pins;  /* inputs, then outputs, each in the order of the catalogue */
	uint16_t made;        /* il_line.made of its result, in the statement; 0: it has none */
	int order;            /* of execution, from 1; FBD_VALUE and what ends a line have 0 */
	int at_column, at_row; /* the hint, from 1; 0: none                        */
	int at, len;          /* bytes of the item's text: all of the call or expression */
	int line, column;
};

struct fbd_wire {
	const char *name;     /* NULL: it has none                                 */
	int from_pin;
	int item;             /* the statement that gives it the name; -1: none     */
};

struct fbd_graph {
	struct fbd_box *box;
	int box_count;
	struct fbd_pin *pin;
	int pin_count;
	struct fbd_wire *wire;
	int wire_count;
	int *note;            /* items of pou->st that are comments                 */
	int note_count;
	struct arena arena;   /* of the texts                                      */
	struct word_table words; /* those of the project, and what is made by rule  */
};

/**
 * fbd_graph_make - the graph of a network
 * @pou:     a POU in FBD
 * @network: 0-based
 * @out:     caller's memory; fbd_graph_free()
 *
 * Boxes stand in the order of execution: nested ones before the box that they stand in, and a store
 * behind what it stores. Rows and declared pins are borrowed from @project. Scan-safe: no.
 * Fails: false: no memory; @out is empty.
 */
bool fbd_graph_make(const struct project *project, const struct pou *pou, int network,
		    struct fbd_graph *out);
void fbd_graph_free(struct fbd_graph *graph);

/** fbd_graph_source - the pin that gives pin @pin its value; -1: none does. Scan-safe: yes. */
int fbd_graph_source(const struct fbd_graph *graph, int pin);
/** fbd_box_title - what stands in it at the top: its type; P or N of an edge. Scan-safe: yes. */
static inline const char *fbd_box_title(const struct fbd_box *box)
{
	return box->kind != FBD_TRIGGER ? box->type : *box->type == 'R' ? "P" : "N";
}
/** fbd_pin_shows_value - an open output of a block that is no BOOL: while it runs, its value stands there.
 * Scan-safe: yes. */
static inline bool fbd_pin_shows_value(const struct fbd_pin *pin)
{
	return pin->output && pin->open && pin->declared && pin->declared->type != IEC_BOOL;
}
/** fbd_pin_number - 1-based, among the inputs or the outputs of its box. Scan-safe: yes. */
int fbd_pin_number(const struct fbd_graph *graph, int pin);

#endif
