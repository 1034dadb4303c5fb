/* SPDX-License-Identifier: MIT
 *
 * sfc - a sequential function chart (IEC 61131-3, 6.7) as data.
 *
 * It keeps the chart as written, with errors, in the order of the file. Conditions and
 * bodies are rungs and lines in the POU's own vectors, so that code for rungs and lists
 * works on them; an expression is a rung of one cell and a coil. docs/sfc.md explains
 * how a chart runs.
 */
#ifndef MODEL_SFC_H
#define MODEL_SFC_H

#include "engine/base/arena.h"
#include "engine/base/limits.h"
#include "engine/base/names.h"
#include "engine/model/vars.h"

#include <stddef.h>

/* IEC 61131-3 table 58; in the order of the words in sfc.c. */
enum qualifier { QUALIFIER_N, QUALIFIER_S, QUALIFIER_R, QUALIFIER_L, QUALIFIER_D,
		 QUALIFIER_P, QUALIFIER_P0, QUALIFIER_P1, QUALIFIER_SD, QUALIFIER_DS,
		 QUALIFIER_SL, QUALIFIER_COUNT };

/* The language of a condition or an action. */
enum body_kind {
	BODY_NONE,       /* nothing was written                                */
	BODY_EXPRESSION, /* := … ; one rung, [ … ] and the coil                */
	BODY_RUNGS,      /* of a condition exactly one                         */
	BODY_LIST,       /* instructions                                       */
	BODY_ST,         /* Structured Text, of actions only                   */
};
struct sfc_body {
	enum body_kind kind;
	int first, count;   /* of pou->rung, pou->il.line or pou->st->item     */
};

enum step_kind { STEP_PLAIN, STEP_INITIAL, STEP_MACRO };
struct sfc_step {
	uint32_t name;      /* string id                                       */
	enum step_kind kind;
	int macro;          /* the macro-step that contains it; -1: none       */
	int end;            /* of a macro-step: piece of its end                */
	uint32_t min, max;  /* string ids: supervision times, as written; 0    */
	uint32_t alarm;     /* string id: operand; 0: none                     */
	int column;         /* hint for drawing, 1-based; 0: none              */
	int first_use, use_count;
	uint32_t comment;   /* above it                                        */
	uint32_t tail;      /* comments before its end                         */
	int line, column_at; /* line of its name in the file, 1-based          */
};

/* A line of a step: an action with its qualifier. */
enum use_kind { USE_ACTION, USE_SET, USE_RESET };
struct sfc_use {
	enum use_kind kind;
	int step;
	uint32_t operand;   /* string id: action, or a BOOL; one of SET, RESET  */
	enum qualifier qualifier; /* of USE_ACTION                             */
	uint32_t time;      /* string id: operand of L D SD DS SL; 0: none     */
	int action;         /* index of the action; -1: a BOOL, or an error for SET and
			     * RESET */
	uint8_t more;       /* 1: on the same line as the one before           */
	uint32_t comment;   /* above it                                        */
	int line, column;
};

struct sfc_transition {
	uint32_t name;      /* string id; 0: none                              */
	int priority;       /* 1 is the highest; 0: by the order in the file   */
	int macro;          /* the macro-step that contains it; -1: none       */
	int first_from, from_count; /* of sfc.ref                             */
	int first_to, to_count;
	struct sfc_body condition;
	uint32_t comment, tail;
	int line, column;
};

struct sfc_action {
	uint32_t name;      /* string id                                       */
	struct sfc_body body;
	uint32_t comment, tail;
	int line, column;
};

/* A name behind FROM or TO. */
struct sfc_ref {
	uint32_t name;      /* string id                                       */
	int step;           /* -1: no step has this name                       */
	int line, column;
};

/* Operands that control the chart from outside: CONTROL(RESET := I0.7, …); */
enum control { CONTROL_RESET, CONTROL_HOLD, CONTROL_SEMI, CONTROL_MANUAL, CONTROL_TIP,
	       CONTROL_FORCE, CONTROL_COUNT };

enum piece_kind { PIECE_STEP, PIECE_MACRO_END, PIECE_TRANSITION, PIECE_ACTION, PIECE_CONTROL };
struct sfc_piece { enum piece_kind kind; int index; };

/* How transitions fire in a scan (docs/sfc.md): all true ones together, once; the same,
 * until none fires; or one after another, each at once. */
enum sfc_evolution { EVOLVE_ONCE, EVOLVE_UNTIL_STABLE, EVOLVE_IN_ORDER };

struct sfc {
	enum sfc_evolution evolution;
	uint32_t control[CONTROL_COUNT]; /* string ids: operands; 0: none     */
	uint32_t control_comment;
	int control_line;
	struct sfc_step *step;
	int step_count;
	struct sfc_use *use;          /* by step                            */
	int use_count;
	struct sfc_transition *transition;
	int transition_count;
	struct sfc_action *action;
	int action_count;
	struct sfc_ref *ref;
	int ref_count;
	struct sfc_piece *piece;        /* order of the parts in the file     */
	int piece_count;
	int block;                      /* index of the block of variables that
					 * sfc_declare() added; -1: none */
};

/* Variables that a chart adds to the declared ones. */
#define SFC_CONDITION "TRANSITION" /* BOOL: written by a condition's coil   */

/** qualifier_word - "N", "SD". Static. Scan-safe: yes. */
const char *qualifier_word(enum qualifier qualifier);
/** qualifier_find - QUALIFIER_COUNT: none. Scan-safe: yes. */
enum qualifier qualifier_find(const char *text, size_t len);
/** qualifier_has_time - L D SD DS SL. Scan-safe: yes. */
bool qualifier_has_time(enum qualifier qualifier);
/** control_word - "RESET". Static. Scan-safe: yes. */
const char *control_word(enum control control);
/** control_find - CONTROL_COUNT: none. Scan-safe: yes. */
enum control control_find(const char *text, size_t len);

/** sfc_x, sfc_t - of step @step: Name.X, Name.T; sfc_condition - SFC_CONDITION: the
 * number of the variable in @table. After sfc_declare(). Scan-safe: yes. */
int sfc_x(const struct sfc *sfc, const struct var_table *table, int step);
int sfc_t(const struct sfc *sfc, const struct var_table *table, int step);
int sfc_condition(const struct sfc *sfc, const struct var_table *table);
/* What begins with a word of charts. */
enum sfc_word_kind {
	SFC_WORD_STEP, SFC_WORD_TRANSITION, SFC_WORD_ACTION, SFC_WORD_CONTROL,
	SFC_WORD_END,           /* END_STEP and the like                      */
	SFC_WORD_SETTING,       /* a line of CONTROL: SET, RESET              */
};
struct sfc_word {
	const char *word;
	enum sfc_word_kind kind;
};
/** sfc_word - word number @i that a line of a chart begins with, END_ words included; NULL
 * after the last. Static. Scan-safe: yes. */
const struct sfc_word *sfc_word(int i);
/** sfc_reserved - whether @word cannot be a name in a chart. Scan-safe: yes. */
bool sfc_reserved(const char *name);
/** sfc_bodies, sfc_body - the conditions of all transitions, then the bodies of all
 * actions; @body: 0-based. Scan-safe: yes. */
int sfc_bodies(const struct sfc *sfc);
const struct sfc_body *sfc_body(const struct sfc *sfc, int body);
/** sfc_body_has_rungs - is the body made of rungs of the POU, or an expression? Scan-safe: yes. */
bool sfc_body_has_rungs(const struct sfc_body *body);
/** sfc_find_step - by name, case does not count; -1: none. Linear. Scan-safe: yes. */
int sfc_find_step(const struct sfc *sfc, const struct names *names, uint32_t name);

/**
 * sfc_link - resolves the names of a chart after it was read
 *
 * Sets ref.step, use.action and use_count of steps; names that do not exist get -1.
 * Scan-safe: no. Fails: false: no memory.
 */
bool sfc_link(struct sfc *sfc, struct names *names);

/** sfc_use_name, sfc_called_name - the hidden variable of a FUNCTION_BLOCK in which its chart remembers @what of a use,
 * or of the action or BOOL @name. It is the same in a chart that was changed elsewhere. Scan-safe: no. Fails: 0: no memory. */
uint32_t sfc_use_name(const struct sfc *sfc, struct names *names, const char *what, int number);
uint32_t sfc_called_name(struct names *names, const char *what, uint32_t name);
/** sfc_starts_itself - does the first scan act as if transitions had fired? Then only code that
 * leaves steps tests whether the chart runs. Scan-safe: yes. */
bool sfc_starts_itself(const struct sfc *sfc);
/**
 * sfc_declare - declares Name.X and Name.T of every step, and SFC_CONDITION
 * @table: of the POU; gets a block with VAR_SFC behind its blocks
 * @kept:  also what the chart remembers, as it lies in each instance of a FUNCTION_BLOCK
 *
 * All Name.X one after another, in the order of the steps, then all Name.T.
 * Scan-safe: no. Fails: false: no memory.
 */
bool sfc_declare(struct sfc *sfc, struct names *names, struct var_table *table, struct arena *arena, bool kept);
/** sfc_evolution_words - the words behind SFC: "UNTIL STABLE", "IN ORDER", "". Static.
 * Scan-safe: yes. */
const char *sfc_evolution_words(enum sfc_evolution evolution);
/** sfc_goes_round - whether transitions may fire more than once in a scan. Scan-safe:
 * yes. */
bool sfc_goes_round(const struct sfc *sfc);
/** sfc_rests_at_once - whether transitions fire in the first scan, too, until the chart
 * is stable. Scan-safe: yes. */
bool sfc_rests_at_once(const struct sfc *sfc);
#endif
