/* SPDX-License-Identifier: MIT
 *
 * inside - data of the evaluator of Structured Text, for its own files only.
 */
#ifndef ST_INSIDE_H
#define ST_INSIDE_H

#include "engine/model/st.h"
#include "tests/st/st_walk.h"
#include "tests/walker/inside.h"

#define STEPS_MAX 20000u /* statements of one scan                           */
#define SHOWN_ST 2000
#define INPUTS_MAX 16

/* A variable, or a part of one. */
enum slot_kind { SLOT_VALUE, SLOT_ARRAY, SLOT_PARTS, SLOT_BLOCK };
struct slot {
	enum slot_kind kind;
	const char *name;
	const struct var *var;      /* its declaration; NULL: a pin           */
	uint16_t flags;             /* enum var_flag                          */
	struct value *value;        /* of SLOT_VALUE                          */
	int32_t low;                /* of SLOT_ARRAY                          */
	int count;
	struct slot *part;          /* elements, members, pins                */
	struct block *block;        /* of SLOT_BLOCK                          */
	const struct pou *pou;      /* of SLOT_PARTS: a block of the project  */
	struct slot *led;           /* of a pointer: what it leads to; NULL: nowhere */
	struct slot *shape;         /* one of its type                        */
};

/* An expression. */
enum tree_kind { TREE_CONSTANT, TREE_PLACE, TREE_NEG, TREE_NOT, TREE_TWO, TREE_CALL, TREE_REF, TREE_BOUND };
struct tree {
	enum tree_kind kind;
	enum word fn;               /* of TREE_TWO, TREE_CALL                 */
	bool lazy;                  /* AND_THEN, OR_ELSE                      */
	struct tree *left, *right;
	struct tree *next;          /* the next argument or index             */
	struct literal literal;
	bool minus;                 /* of TREE_CONSTANT                       */
	struct slot *global;        /* of TREE_PLACE: where it begins;        */
	int local;                  /* NULL: number of a local                */
	struct step *step;          /* from there on                          */
	int bits, number;           /* the part of the place; bits 0: all of it */
	const char *pin;            /* of an argument; NULL: in order         */
	int pin_len;
	bool out;                   /* an argument with =>                    */
	const struct pou *pou;      /* of TREE_CALL: a function of the project */
	enum iec_type to;           /* of TREE_CALL: what a conversion gives  */
	bool letter;                /* of TREE_CALL: MID that `Name[3]` is     */
	bool upper;                 /* of TREE_BOUND: of left, dimension right */
};

/* `[a]` or `.name` in a place. */
struct step {
	struct tree *index;
	const char *name;
	int len;
	bool through;               /* ^ */
	struct step *next;
};

struct choice {
	struct tree *low, *high;    /* high NULL: one value                   */
	struct choice *next;
};

struct stmt {
	enum st_kind kind;
	struct tree *place, *value; /* target, callee, variable of FOR; condition */
	struct tree *to, *by, *from;
	struct tree *args;
	const struct pou *called;   /* a subroutine, a program                */
	bool tried;                 /* ?=                                     */
	struct token label;         /* of ST_JUMP, ST_LABEL                   */
	int parts;                  /* of SPLIT_DT: which functions it is; 0: another call */
	struct choice *choice;
	struct stmt *body;          /* of a branch, a loop, a choice; of `a := b := 1` b := 1 */
	struct stmt *other;         /* the next branch; ELSE has no value     */
	struct stmt *next;
};

/* The body of a POU, parsed once. */
struct body {
	const struct pou *pou;
	struct slot frame;          /* of a program, function, subroutine     */
	bool called;                /* a program that another one calls       */
	struct stmt *first;
};

struct shown_slot {
	char name[128];
	struct value *value;
	const struct block *block;
};

struct st_world {
	struct project *project;
	struct arena arena;
	struct slot globals;
	struct body *body;          /* by POU                                 */
	struct shown_slot *shown;
	int shown_count;
	int64_t now_ns;
	uint32_t errors, steps;
	bool lost;
	const char *why;
};

/* What a statement works on. */
struct frame_of { struct st_world *world; struct slot *locals; const struct stmt *jump; };

/* st_slot.c */
bool slot_frame(struct st_world *world, struct slot *out, const struct var_table *table);
/** slot_reset - initial values again; @temporary: only of VAR_TEMP. */
void slot_reset(struct st_world *world, struct slot *slot, bool temporary);
/** slot_clone - a slot with the same values; NULL: no memory. */
struct slot *slot_clone(struct st_world *world, const struct slot *from);
struct slot *slot_member(struct slot *slot, const char *name, int len);
void slot_show(struct st_world *world, struct slot *slot, const char *before);

/* st_parse.c */
bool parse_body(struct st_world *world, struct body *body);

/* st_compute.c */
/* A chain of operations; what fails ends it. */
struct chain_state {
	bool on;
	const struct stmt *nowhere; /* its value is a call, which needs its target */
	const struct value *index;  /* of that target                         */
	const struct tree *wrapped; /* the operation that overflowed           */
};
/** type_of - of the value where @wanted is wanted; IEC_NONE: constants alone. */
enum iec_type tree_type(struct frame_of *f, const struct tree *tree, enum iec_type wanted);
/** tree_compute - as @type; IEC_NONE: in its own. */
struct value tree_compute(struct frame_of *f, const struct tree *tree, enum iec_type type,
			  struct chain_state *chain);
/** tree_slot - the place; NULL, and an error is counted: it has no such element. */
struct slot *tree_slot(struct frame_of *f, const struct tree *tree, struct chain_state *chain);
#define INDICES_MAX 16
/** target_begin - computes the indices of a target that are expressions; target_slot - the target, with
 * its other indices as they are now. NULL: it has no such element. */
void target_begin(struct frame_of *f, const struct tree *tree, struct chain_state *chain,
		  struct value index[INDICES_MAX]);
struct slot *target_slot(struct frame_of *f, const struct tree *tree,
			 const struct value index[INDICES_MAX]);
/** tree_first - the same with the first element of each array. */
struct slot *tree_first(struct frame_of *f, const struct tree *tree);
/** slot_put - stores; false, and an error is counted, if it may not hold the value. */
bool slot_put(struct st_world *world, struct slot *slot, struct value value);
/** part_put - @all with @part as its bits that the place names. */
struct value part_put(const struct tree *tree, struct value all, struct value part);
void slot_copy(struct slot *to, const struct slot *from);
/** slot_fits - whether a subrange has the value. */
bool slot_fits(const struct slot *slot, struct value value);

/* st_run.c */
bool run_body(struct st_world *world, const struct body *body, struct slot *locals);
/** run_function - false: its ENO is FALSE. */
bool run_function(struct frame_of *f, const struct tree *call, struct chain_state *chain,
		  struct value *out);
#endif
