/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_parts - types and functions that the files of sfc_ladder share.
 *
 * Private to sfc_ladder*.c. sfc_ladder.c writes the project, sfc_ladder_names.c gives names,
 * sfc_ladder_rung.c writes one rung, sfc_ladder_steps.c the programs of steps and actions. A
 * chart is written several times, because each pass shows which bits the next one needs.
 */
#ifndef CLASSIC_SFC_LADDER_PARTS_H
#define CLASSIC_SFC_LADDER_PARTS_H

#include "engine/model/sfc_net.h"
#include "engine/exchange/classic/classic.h"
#include "engine/exchange/classic/sfc_ladder.h"
#include "engine/xref/xref.h"

/* A variable of the ladder; declared if it is used. */
struct lad_var {
	uint32_t name;
	const char *type;    /* "BOOL"                                         */
	bool used;
	const char *comment; /* NULL: none                                     */
};

/* Variables of a step: active; time in it; in this evolution: it became active, a transition
 * left it, it ended; UNTIL STABLE, in this scan: it became active, it ended; FORCE sets it. */
enum lad_step { LAD_X, LAD_T, LAD_START, LAD_LEFT, LAD_END, LAD_STARTED, LAD_ENDED,
		LAD_FORCED, LAD_STEP_VARS };
/* Variables of an arc: it fires; result of its condition; it is enabled and true. */
enum lad_arc { LAD_FIRES, LAD_RESULT, LAD_TRUE, LAD_ARC_VARS };
/* Variables of a line: stored; time since then; waiting for its time; allowed by its time. */
enum lad_line { LAD_STORED, LAD_SINCE, LAD_ARMED, LAD_ALLOWED, LAD_LINE_VARS };
/* Variables of an action or BOOL: called; called by more than a pulse; the same in the scan
 * before. */
enum lad_call { LAD_CALLED, LAD_LEVEL, LAD_WAS, LAD_CALL_VARS };
/* Variables of the chart: it runs; first scan; a TON, time of the last scan, its sum; RESET
 * rises; nothing may fire; FORCE has changed, its value, a step is forced; transitions fire
 * if true, or by hand, or once; IN ORDER: rounds, something fired in this round. */
enum lad_sfc { LAD_RUNS, LAD_FIRST, LAD_CLOCK, LAD_PASSED, LAD_LAST, LAD_ANEW,
		 LAD_STANDS, LAD_CHANGED, LAD_NUMBER, LAD_SET, LAD_GO, LAD_HAND, LAD_ONCE,
		 LAD_ROUNDS, LAD_FIRED,
		 LAD_SFC_VARS };

/* An action or BOOL that steps call. */
struct lad_called {
	int action;          /* -1: a BOOL                                     */
	uint32_t operand;    /* in its first spelling                          */
	int use;             /* of a BOOL: the first line with it              */
	bool alone;          /* nothing else writes it: a coil is enough       */
	struct lad_var var[LAD_CALL_VARS];
};

struct lad {
	struct project *project;
	struct arena *arena;
	struct diag_list *diags;
	const struct pou *pou;
	const struct sfc *sfc;
	struct sfc_net net;
	struct xref *xref;
	struct scope *scope; /* of the chart as it is; made when it is needed  */
	struct expr *expr;   /* likewise: room for an expression               */
	struct lad_var (*step)[LAD_STEP_VARS];
	struct lad_var (*arc)[LAD_ARC_VARS];
	struct lad_var (*line)[LAD_LINE_VARS]; /* by sfc.use                   */
	struct lad_var whole[LAD_SFC_VARS];
	int reach;               /* steps that the type of FORCE can number    */
	struct lad_called *called;
	int called_count;
	int *same;           /* by line: the first one with the same BOOL      */
	uint32_t *body;      /* names of subroutines: by sfc_body()            */
	uint32_t steps_name, outputs_name, again, round; /* POUs, labels      */
	uint32_t *renamed;   /* by variable of the POU: its new name; 0: unchanged */
	const char *condition; /* name in place of TRANSITION; NULL: none      */
	struct iec_addr at, last; /* of the first step and the last one        */
	int sfcs;            /* charts that have addresses                     */
	bool refers;         /* ADR or REF leads to a step, so steps have none */
	struct sink out;     /* the program in work                            */
	struct sink subs;    /* its subroutines                                */
	bool good;
};

/* A rung in work: contacts in a row, then others side by side, then outputs. */
#define LAD_COLS 48
#define LAD_ROWS 200
struct lad_way { char *cell[LAD_COLS]; int length; };
struct lad_rung {
	struct arena *arena;
	char *head[LAD_COLS];
	int heads;
	struct lad_way *way[LAD_ROWS];
	int ways;
	char *out[LAD_ROWS];
	int outs;
	bool full;
};

/* ---- sfc_ladder.c ---- */
/** lad_text - formatted text in the arena; never NULL. */
char *lad_text(struct lad *e, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** lad_use - the name of a variable, which is then declared. */
const char *lad_use(struct lad *e, struct lad_var *var);
/** lad_words - text of the chart with names of the ladder: Fill_X for Fill.X. */
char *lad_words(struct lad *e, const char *text);
/** lad_refuse - adds LD460: a ladder cannot express @what. */
void lad_refuse(struct lad *e, int line, int column, const char *what);
/** lad_name - name of a step. */
const char *lad_name(const struct lad *e, int step);

/** lad_letter - true if a name can hold @c. */
bool lad_letter(char c);

/* ---- sfc_ladder_names.c ---- */
/** lad_fresh - @base, or with a number if it is taken. */
uint32_t lad_fresh(struct lad *e, const char *base);
/** lad_names - names all variables and POUs of the chart; finds what its steps call. */
void lad_names(struct lad *e);

/* ---- sfc_ladder_rung.c: texts are borrowed ---- */
/** lad_begin - an empty rung, in the arena. */
struct lad_rung *lad_begin(struct lad *e);
void lad_head(struct lad_rung *r, char *cell);
/** lad_head - a contact in series with all ways. lad_way - begins another parallel row.
 * lad_cell - a cell in that row. lad_out - an output. */
void lad_way(struct lad_rung *r);
void lad_cell(struct lad_rung *r, char *cell);
void lad_out(struct lad_rung *r, char *cell);
/** lad_write - writes the rung; one without outputs is left out. */
void lad_write(struct lad *e, const struct lad_rung *r, const char *label,
	       const char *title);
/** lad_expression - an expression as contacts if that does the same, else as a cell. */
void lad_expression(struct lad *e, struct lad_rung *r, const char *text);
/** lad_needs_st - may only Structured Text know the expression @text of the chart, not a cell: a bit
 * string as a number, TIME()? */
bool lad_needs_st(struct lad *e, const char *text);

bool lad_is_in_order(const struct lad *e);

/* ---- the two programs ---- */
void lad_steps(struct lad *e);
void lad_outputs(struct lad *e);
#endif
