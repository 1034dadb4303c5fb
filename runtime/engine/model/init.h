/* SPDX-License-Identifier: MIT
 *
 * init - initial values of arrays and structures: `(Speed := 5, Times := [T#1s,
 * 2(T#2s)])`.
 *
 * IEC 61131-3 writes them as a list in brackets for an array and in parentheses with
 * the names of members for a structure; n( … ) is one value n times. The project keeps
 * the text as written; this walks it, constant by constant, with the place of each.
 * Parts that the text does not name keep the initial value of their declaration.
 */
#ifndef MODEL_INIT_H
#define MODEL_INIT_H

#include "engine/base/diag.h"
#include "engine/base/lex.h"
#include "engine/base/literal.h"
#include "engine/model/project.h"

#define INIT_DEPTH (2 * LIMIT_NESTING + 2) /* depth of nested lists and structures */

/* An open list or structure. */
struct init_level {
	const struct word_row *row; /* of a structure or block; NULL: a list   */
	enum word word;             /* of the structure or block               */
	struct word_pin item;       /* a list: its element                     */
	uint32_t base, unit;        /* offset from the start of the variable   */
	uint32_t element, count;    /* a list: next element, number of them    */
	const struct var_array *dim; /* a list: its dimensions, if there are several */
	int dims;
	bool row_of;                /* a list: of the list below, as [3, 4] in [[1, 2], [3, 4]] */
	uint32_t times;             /* repetitions left of n( … ); 0: none open */
	int pin;                    /* a structure: the present member         */
	bool bare;                  /* members without a ( of their own: 2(a := 1) */
	struct lex again;           /* where the value of n( … ) begins        */
	uint32_t *given, room, turn; /* by pin: number of the n( … ) turn that named it last */
};

struct init_value {
	uint32_t offset;            /* offset from the start of the variable  */
	enum iec_type type;
	uint32_t capacity;          /* of a STRING                            */
	struct literal literal;
	union iec_value value;      /* of its type; not of a STRING           */
	const char *text;           /* as written; borrowed from the project  */
	size_t len;
};

/* Computes constant expressions; without it they are errors. */
struct init_fold {
	/* The value, of @out->type, of @len bytes of @text; @out gets value and literal.
	 * IEC_NONE: of the n of n( … ), an integer of any type.
	 * Fails: why; DIAG_COUNT: it did not. */
	enum diag_id (*value)(void *context, const char *text, size_t len,
			      struct init_value *out);
	void *context;
	struct word_table *words;   /* tell the call of a function from n( … )  */
};

struct init_walk {
	const struct project *project;
	const struct var *var;
	struct arena *scratch;      /* NULL: the text was checked before      */
	struct init_fold fold;      /* set behind init_begin()                */
	const char *from, *behind;  /* the present value as written, in the text */
	struct lex lex;
	struct init_level level[INIT_DEPTH];
	int depth;
	bool begun;
	enum diag_id why;           /* DIAG_COUNT: no error                   */
	const char *arg;            /* argument of the error; borrowed from the text */
	size_t arg_len;
	int64_t count;              /* of a wrong n( … ): n                    */
	uint32_t left;              /* and the elements that are left for it  */
};

/** init_has_parts - whether the initial value of @var is such a text. Scan-safe: yes. */
bool init_has_parts(const struct var *var);
/**
 * init_begin - before the first constant of a variable's text, or of var_value_text()
 * @scratch: checks the text, and walks repeated values once. NULL: the text was
 *           checked; repeated values come n times
 *
 * Owns: nothing; @walk is about 5 KB, the caller's. Scan-safe: no.
 */
void init_begin(struct init_walk *walk, const struct project *project,
		const struct var *var, struct arena *scratch);
/** init_next - the next constant. Scan-safe: no. Fails: false after the last one, and
 * after an error: walk->why. */
bool init_next(struct init_walk *walk, struct init_value *out);
/**
 * init_keep - adds the constant that init_next() gave to the list of an array of constants
 * @next: the element behind the last one that was added; at first 0
 *
 * Elements between them, of n(), keep their 0.
 * Owns: nothing; the list is the project's. Scan-safe: no. Fails: false when memory is out.
 */
bool init_keep(const struct init_walk *walk, struct project *project, struct var *var,
	       const struct init_value *value, uint32_t *next);
/** init_say - the arguments of the message about walk->why, without the name of the variable; as
 * snprintf. Scan-safe: no. */
void init_say(const struct init_walk *walk, char *out, size_t size);
/** init_where - the path of the present value behind the variable's name: `[3].Speed`;
 * as snprintf. Scan-safe: no. */
void init_where(const struct init_walk *walk, char *out, size_t size);
/** init_names_pin - whether the initial values of an instance name @pin. Scan-safe: no. */
bool init_names_pin(const char *text, size_t len, const char *pin);
#endif
