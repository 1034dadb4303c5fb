/* SPDX-License-Identifier: MIT
 *
 * inside - data of the walker, for its own files only.
 */
#ifndef WALKER_INSIDE_H
#define WALKER_INSIDE_H

#include "engine/base/arena.h"
#include "engine/base/literal.h"
#include "engine/model/expr.h"
#include "tests/walker/walker.h"

#define PINS_MAX 32 /* of one word                                         */

/* An instance of a function block. */
struct block {
	enum word fb;
	struct value pin[PINS_MAX]; /* by pin number of its row              */
	int64_t start_ns;
	bool busy, spent;           /* timing; pulse over, IN still TRUE     */
	bool was, was_too;          /* levels of the previous call           */
	bool called;                /* since the start                       */
	struct value held[64];      /* of a store or an average              */
	int count;                  /* of them                               */
	double exact, smooth;       /* the part that a REAL cannot hold      */
};

/* A declared variable: one of three. */
struct variable {
	const struct var *var;
	uint16_t flags;             /* enum var_flag                         */
	struct value *value;        /* of each element                       */
	struct block *block;        /* an instance of a block of the catalogue */
	struct frame *inner;        /* of each element: an instance of a block
				       of the project, a structure           */
};

/* Variables of one scope, and the body that works on them. */
struct frame {
	const struct pou *pou;      /* NULL: globals, a structure            */
	struct variable *variable;
	int count;
	struct walked_pou *body;
	struct frame *next;         /* of all instances of blocks            */
	char name[128];             /* of an instance: "Line.Belt"           */
};
#define SHOWN_MAX 1500

/* Where an operand is read and written. */
enum place_kind { PLACED_NOWHERE, PLACED_VALUE, PLACED_AREA, PLACED_LITERAL, PLACED_PART };
struct placed {
	enum place_kind kind;
	enum iec_type type;         /* IEC_NONE: an untyped literal          */
	struct value *value;
	uint8_t *byte;
	uint8_t bit;                /* of a BOOL in an area                  */
	struct literal literal;
	/* For an array, and for an element with a computed index: the members above are
	 * those of the first element. */
	uint32_t count;
	uint32_t rest;              /* of an address: elements up to the end */
	int32_t low;
	struct placed *index;       /* NULL: the array itself                */
	struct placed *choice;      /* its elements, if they are not in a row */
	/* For bits of a number, Word.3: the number as it is named, and as it was found last. */
	struct placed *number, *found;
	unsigned int first, width;  /* lowest bit, how many                   */
};

/* A value to compare, and its name. */
struct shown {
	char name[128];
	struct placed placed;
	const struct block *block;  /* the block whose input pin it is; else NULL */
};

struct walker {
	struct project *project;
	struct arena arena;
	struct frame globals;
	struct frame *frame;        /* of each POU but blocks                */
	struct frame *instances;    /* of blocks, by their next              */
	struct shown *shown;
	int shown_count;
	struct areas areas;
	uint8_t *area[AREA_COUNT];
	int64_t now_ns, start_ns;
	uint64_t scans;
	uint32_t errors, errors_before;
	uint32_t steps;
	bool lost;                  /* more steps than allowed               */
	bool halted;                /* a STOP was executed                   */
	struct walked_pou *pou;
	const struct sfc_body *body; /* whose rungs are made; NULL: of the POU */
	const char *why;            /* why the program cannot be walked      */
};

/* value.c */
enum outcome { OUTCOME_GOOD, OUTCOME_WRAPPED, OUTCOME_FAILED };
/** wide_type - the widest of the types; IEC_NONE: none. */
enum iec_type wide_type(const enum iec_type *type, int count);
struct value value_widen(struct value value, enum iec_type type);
bool value_is_true(struct value value);
struct value value_bool(bool level);
/** value_is_logic - AND OR XOR NOT. */
bool value_is_logic(enum word fn);
/** value_compute - one function on inputs of one type. */
enum outcome value_compute(enum word fn, const struct value *in, int count,
			   struct value *out);

/** value_time_type - the result type of an operation on times and dates (table 30 of the
 * standard); IEC_NONE: not allowed. @right IEC_NONE: a number without a type. */
enum iec_type value_time_type(enum word fn, enum iec_type left, enum iec_type right);
/** value_compute_time - the same, computed. */
enum outcome value_compute_time(enum word fn, struct value left, struct value right,
				struct value *out);

/* text.c */
int text_order(struct value a, struct value b);
bool text_is_function(enum word fn);
/** text_compute - LEN, LEFT … FIND; the result may be longer than its variable. */
enum outcome text_compute(enum word fn, const struct value *in, int count,
			  struct value *out);

/* frame.c */
bool walker_declare(struct walker *walker);
/** frame_make - the variables of a table, at their initial values. */
bool frame_make(struct walker *walker, struct frame *frame, const struct pou *pou,
		const struct var_table *table);
/** frame_reset - initial values again; @temporary: only of VAR_TEMP. */
void frame_reset(struct walker *walker, struct frame *frame, bool temporary);
/** frame_find - index of one of its own variables; -1: none. */
int frame_find(const struct walker *walker, const struct frame *frame, const char *text,
	       size_t len);
/** frame_variable - one of its own variables, or a global; NULL: none. */
struct variable *frame_variable(struct walker *walker, const struct frame *frame,
				const char *text, size_t len);
/** frame_place - the place of a name with members, pins and indices. */
struct placed frame_place(struct walker *walker, const struct frame *frame,
			  const char *text, size_t len);

/* place.c */
/** walker_place - the place of an operand; PLACED_NOWHERE: the walker does not support
 * it. */
struct placed walker_place(struct walker *walker, const struct frame *frame,
			   const char *text, size_t len);
struct placed placed_at(struct walker *walker, struct iec_addr addr,
			enum iec_type type);
/** placed_index - an array with the index between @at and @end. */
struct placed placed_index(struct walker *walker, const struct frame *frame,
			   struct placed array, const char *at, const char *end);
/** placed_take_text - the bytes between the quotes, as many as there is room. */
void placed_take_text(struct value *value, const struct literal *literal);
/** placed_read - as @type: a literal gets it, other values are widened. IEC_NONE:
 * unchanged. */
struct value placed_read(const struct placed *placed, enum iec_type type);
void placed_write(const struct placed *placed, struct value value);
/** placed_find - the element that @placed means now; a plain variable is itself. False,
 * and an error is counted: no such element. */
bool placed_find(struct walker *walker, const struct placed *placed,
		 struct placed *out);
/** placed_element - element @index of an array; false: there is none. */
bool placed_element(const struct placed *array, int64_t index, struct placed *out);

/* blocks.c */
int block_pin(const struct block *block, const char *name);
void block_call(struct block *block, int64_t now_ns);
int64_t block_get(const struct block *block, const char *name);
void block_set(struct block *block, const char *name, int64_t value);
/** block_rises - whether the level was FALSE in the previous call. */
bool block_rises(bool now, bool *was);

/* blocks_more.c */
/** block_call_more - the blocks of docs/blocks.md. */
void block_call_more(struct block *block, int64_t now_ns);

/* expression.c */
struct expression;
/** expression_new - an expression ready to be computed; NULL: not supported. */
struct expression *expression_new(struct walker *walker, const struct frame *frame,
			    const char *text);
bool expression_assigns(const struct expression *expression);
/** expression_run - evaluates it with @power at its first EN; stores its target. Returns
 * its ENO. */
bool expression_run(struct walker *walker, struct expression *expression, bool power);
#endif
