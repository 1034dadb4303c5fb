/* SPDX-License-Identifier: MIT
 *
 * acts - what the body of a POU does, one act behind the other, between two languages.
 *
 * Private to convert/. A ladder becomes acts (ladder_acts.c), acts become simpler ones
 * (settle_acts.c) and then text (st_text.c, fbd_text.c). Values are terms: trees that never change, so
 * several acts may share one.
 */
#ifndef CONVERT_ACTS_H
#define CONVERT_ACTS_H

#include "engine/check/scope.h"
#include "engine/base/lex.h"
#include "engine/model/expr.h"

enum term_kind {
	TERM_TRUE,
	TERM_NAME,  /* an operand that can always be read                     */
	TERM_WORDS, /* text as it was written, or of the converter             */
	TERM_TEMP,
	TERM_NOT, TERM_AND, TERM_XOR, TERM_OR,
	TERM_CALL,  /* a function that can always be computed                  */
	TERM_EDGE,  /* of networks: R_EDGE or F_EDGE of its part, which it remembers */
};

struct term {
	enum term_kind kind;
	uint8_t level;        /* of WORDS: how strongly it binds, enum level   */
	bool lazy;            /* of AND: AND_THEN                              */
	bool rising;          /* of EDGE                                       */
	bool reads_any;       /* of WORDS: nobody knows what it reads          */
	uint32_t text;        /* string id; of CALL the function               */
	int temp;
	const struct term **part; /* of CALL the values of its pins            */
	const uint32_t *pin;  /* of CALL: string ids                          */
	int parts;
	const uint32_t *read; /* of NAME, WORDS: operands, as string ids       */
	int reads;
};

/* As in model/expr.h, the weakest first. */
enum level { LEVEL_OR, LEVEL_XOR, LEVEL_AND, LEVEL_EQUAL, LEVEL_LESS, LEVEL_ADD, LEVEL_MUL,
	     LEVEL_POWER, LEVEL_SIGN, LEVEL_NAME };

enum act_kind {
	ACT_NOTHING,   /* it was left out                                      */
	ACT_REMARK,    /* text: a comment, or lines of one                     */
	ACT_LABEL,
	ACT_STORE,     /* target or temp := value                              */
	ACT_TEST,      /* target or temp := is it TRUE? FALSE if it cannot be computed */
	ACT_CALL,      /* target or temp := text(arg, …); both may be absent   */
	ACT_JUMP, ACT_RETURN,
	ACT_STOP,      /* of networks only                                     */
	ACT_WORDS,     /* text, a statement                                   */
	ACT_LINES,     /* statements of an EXECUTE box                         */
	ACT_LOOP, ACT_LOOP_END,
};

struct act_arg {
	uint32_t pin;         /* string id                                    */
	const struct term *value; /* of an input                              */
	uint32_t place;       /* of an output: string id; 0: temp             */
	int temp;
};

/* A FOR of a ladder. */
struct act_loop {
	uint32_t variable, from, to, by; /* string ids; by 0: one further      */
	bool down, near;      /* near: by is 1 or -1, and `to` has the type of the variable */
	int next, good;       /* temporaries, if it is not near               */
};

struct act {
	enum act_kind kind;
	const struct term *when, *value; /* when NULL: always                  */
	uint32_t text;
	uint32_t target;      /* string id; 0: temp                           */
	int temp;             /* -1: none                                     */
	struct act_arg *arg;
	int args;
	const struct st_item *item; /* of LINES                               */
	int items;
	struct act_loop loop;
	const uint32_t *write; /* operands that it writes beside target        */
	int writes;
	bool writes_globals, writes_any;
	bool fails;           /* a value or the target may not exist          */
	int rung;             /* 0-based                                      */
	bool apart;           /* of REMARK: an empty line stands above it      */
};

/* A BOOL that keeps a value inside a rung, or a number for a loop. */
struct act_temp {
	const struct term *is; /* its value is written in its place; NULL: it is a variable */
	uint32_t name;        /* string id, once it is known that it stays     */
	uint32_t wish;        /* string id: the name that it should get; 0: that of its rung */
	enum iec_type type;
	int rung;             /* 0-based                                      */
	int defined;          /* how many acts store it                       */
	int uses;
};

/* An instance that keeps an edge. */
struct act_edge {
	uint32_t name;
	bool rising;
	bool other;           /* no edge: a name that is taken                */
};

struct acts {
	struct project *project;
	struct scope *scope;
	const struct pou *pou;
	struct arena *arena;
	struct diag_list *diags;
	struct expr *expr;
	struct act *act;
	int count;
	struct act_temp *temp;
	int temps;
	struct act_edge *edge;
	int edges;
	int rung;             /* in work, 0-based                             */
	bool networks;        /* they become networks, not Structured Text    */
	bool failed;          /* memory is out                                */
	bool refused;
	struct term no_term;  /* given when memory is out                     */
	struct act no_act;
};

/* ---- acts.c ---- */
const struct term *term_true(struct acts *acts);
const struct term *term_name(struct acts *acts, uint32_t operand);
/** term_words - @text binds as @level says and reads nothing that a program can write. */
const struct term *term_words(struct acts *acts, enum level level, const char *text, size_t len);
const struct term *term_temp(struct acts *acts, int temp);
const struct term *term_not(struct acts *acts, const struct term *of);
/** term_both - @kind of two; TRUE before AND is left out. */
const struct term *term_both(struct acts *acts, enum term_kind kind, const struct term *a,
			     const struct term *b);
/** term_edge - TERM_EDGE of @of. */
const struct term *term_edge(struct acts *acts, const struct term *of, bool rising);
/** term_has_edge - does computing it change what an edge remembers? */
bool term_has_edge(const struct acts *acts, const struct term *term);
/** term_plain - itself, or what its temporary stands for. */
const struct term *term_plain(const struct acts *acts, const struct term *term);
bool term_equal(const struct acts *acts, const struct term *a, const struct term *b);
/** term_reads - does writing @operand change it? */
bool term_reads(struct acts *acts, const struct term *term, uint32_t operand);
/** act_touches - can @act change the value of @term? */
bool act_touches(struct acts *acts, const struct act *act, const struct term *term);
/** term_count - counts each use of a temporary. */
void term_count(struct acts *acts, const struct term *term);
int term_size(const struct acts *acts, const struct term *term);
struct act *acts_add(struct acts *acts, enum act_kind kind);
int acts_temp(struct acts *acts, enum iec_type type, int rung);
const struct meaning *acts_meaning(struct acts *acts, uint32_t operand);
uint32_t acts_intern(struct acts *acts, const char *text, size_t len);
/** text_is_pure - does a function of this name, or an operator before a parenthesis, write nothing? */
bool text_is_pure(const struct acts *acts, const struct token *token);
/** text_may_write - can the statement @text write the variable @name, perhaps by another name of its memory? Nobody knows
 * what blocks and functions of the project write, nor where pointers lead. */
bool text_may_write(struct acts *acts, const char *text, const struct token *name);
/** acts_name - a name that nothing in the POU has: @text, @text_2 and so on. */
uint32_t acts_name(struct acts *acts, const char *text);

/* ---- ladder_acts.c ---- */
/** ladder_acts - what the rungs of a POU do. Fails: false after a diagnostic, or without memory. */
bool ladder_acts(struct acts *acts);

/* ---- fbd_st.c ---- */
/** fbd_st - the declarations that networks need, and their lines as Structured Text. Fails: false after a
 * diagnostic, or without memory. */
bool fbd_st(struct acts *acts, const struct sink *sink);

/* ---- fbd_ladder.c ---- */
/** fbd_ladder - networks as rungs, with what they declare. Fails: false after a diagnostic, or without memory. */
bool fbd_ladder(struct acts *acts, const struct sink *sink);

/* ---- fbd_text.c ---- */
/** fbd_text - the acts as networks, one for each rung, with what they declare.
 * Fails: false after a diagnostic, or without memory. */
bool fbd_text(struct acts *acts, const struct sink *sink);

/* ---- settle_acts.c ---- */
/** settle_acts - temporaries that need not be give way to their values; the others get names. */
void settle_acts(struct acts *acts);
/** act_is_latch - does it store TRUE or FALSE under a condition, as S= and R= do? */
bool act_is_latch(struct acts *acts, const struct act *act);

/* ---- st_text.c ---- */
/** st_declare - the declarations that the acts need. */
void st_declare(const struct acts *acts, const struct sink *sink);
/** term_text - a value. @part: of another one, in parentheses if it needs them. */
void term_text(struct acts *acts, const struct term *term, bool part, const struct sink *sink);
/** act_text - an act without its condition, as a statement. */
void act_text(struct acts *acts, const struct act *act, const struct sink *sink);
/** st_text - the acts as Structured Text. */
void st_text(struct acts *acts, const struct sink *sink);
#endif
