/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_parts - what the parts of the export of charts share: one chart in work.
 *
 * Private to classic/. sfc_ladder.c writes the project, sfc_ladder_names.c gives names,
 * sfc_ladder_rung.c writes one rung, sfc_ladder_steps.c the programs of steps and actions.
 * A chart is written several times: only then is it known which bits it needs.
 */
#ifndef CLASSIC_SFC_LADDER_PARTS_H
#define CLASSIC_SFC_LADDER_PARTS_H

#include "engine/model/sfc_net.h"
#include "engine/exchange/classic/classic.h"
#include "engine/exchange/classic/sfc_ladder.h"
#include "engine/xref/xref.h"

/* A variable that the ladder needs. */
struct lad_var {
	uint32_t name;
	const char *type;    /* "BOOL"                                         */
	bool used;
	const char *comment; /* NULL: none                                     */
};

/* Of a step: it is active; its time; it became active, was left by a transition, was
 * left at all, in this evolution; the same in this scan, of UNTIL STABLE; FORCE. */
enum lad_step { LAD_X, LAD_T, LAD_START, LAD_LEFT, LAD_END, LAD_STARTED, LAD_ENDED,
		LAD_FORCED, LAD_STEP_VARS };
/* Of an arc: it fires; what its condition gave; it is enabled and true. */
enum lad_arc { LAD_FIRES, LAD_RESULT, LAD_TRUE, LAD_ARC_VARS };
/* Of a line: it is stored; since when; it waits for its step; its time allows it. */
enum lad_line { LAD_STORED, LAD_SINCE, LAD_ARMED, LAD_ALLOWED, LAD_LINE_VARS };
/* Of what is called: it is called for; not only by a pulse; that of the scan before. */
enum lad_call { LAD_CALLED, LAD_LEVEL, LAD_WAS, LAD_CALL_VARS };
/* Of the chart: it runs; this is its first scan; time; RESET rises; nothing fires; FORCE
 * has changed, what it was, a step is forced; transitions fire if they are true, or
 * whatever they are; IN ORDER rounds so far, one has fired in this one. */
enum lad_sfc { LAD_RUNS, LAD_FIRST, LAD_CLOCK, LAD_PASSED, LAD_LAST, LAD_ANEW,
		 LAD_STANDS, LAD_CHANGED, LAD_NUMBER, LAD_SET, LAD_GO, LAD_HAND, LAD_ONCE,
		 LAD_ROUNDS, LAD_FIRED,
		 LAD_SFC_VARS };

/* What steps call: an action, or a BOOL. */
struct lad_called {
	int action;          /* -1: a BOOL                                     */
	uint32_t operand;    /* as it is written first                         */
	int use;             /* of a BOOL: the first line with it              */
	bool alone;          /* nothing else writes it: a coil will do         */
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
	struct lad_var (*step)[LAD_STEP_VARS];
	struct lad_var (*arc)[LAD_ARC_VARS];
	struct lad_var (*line)[LAD_LINE_VARS]; /* by sfc.use                   */
	struct lad_var whole[LAD_SFC_VARS];
	int reach;               /* so many steps the type of FORCE can name   */
	struct lad_called *called;
	int called_count;
	int *same;           /* by line: the first one with the same BOOL      */
	uint32_t *body;      /* names of subroutines: by sfc_body()            */
	uint32_t steps_name, outputs_name, again, round; /* POUs, labels      */
	uint32_t *renamed;   /* by variable of the POU: its new name; 0: as it was */
	const char *condition; /* what TRANSITION is in what is written        */
	struct iec_addr at, last; /* of the first step and the last one        */
	int sfcs;          /* that have addresses                            */
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
/** lad_text - formatted text that lives as long as the export; never NULL. */
char *lad_text(struct lad *e, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** lad_use - the name of a variable, which is declared then. */
const char *lad_use(struct lad *e, struct lad_var *var);
/** lad_words - text of the chart with the names it has as a ladder: Fill_X for Fill.X. */
char *lad_words(struct lad *e, const char *text);
/** lad_refuse - this has no ladder. */
void lad_refuse(struct lad *e, int line, int column, const char *what);
/** lad_name - of a step, as it is written. */
const char *lad_name(const struct lad *e, int step);

/** lad_letter - can it stand in a name? */
bool lad_letter(char c);

/* ---- sfc_ladder_names.c ---- */
/** lad_fresh - a name like @base that nothing has yet. */
uint32_t lad_fresh(struct lad *e, const char *base);
/** lad_names - names of all variables and POUs of the chart; what its steps call. */
void lad_names(struct lad *e);

/* ---- sfc_ladder_rung.c: each text is kept, not copied ---- */
/** lad_begin - an empty rung, in the arena. */
struct lad_rung *lad_begin(struct lad *e);
void lad_head(struct lad_rung *r, char *cell);
/** lad_way - another row beside the last one; lad_cell - one more cell in it. */
void lad_way(struct lad_rung *r);
void lad_cell(struct lad_rung *r, char *cell);
void lad_out(struct lad_rung *r, char *cell);
/** lad_write - the rung with this title; one without outputs is not written. */
void lad_write(struct lad *e, const struct lad_rung *r, const char *label,
	       const char *title);
/** lad_expression - an expression as contacts where that means the same; else a cell. */
void lad_expression(struct lad *e, struct lad_rung *r, const char *text);

bool lad_is_in_order(const struct lad *e);

/* ---- the two programs ---- */
/** lad_arc - the rungs that tell whether an arc fires; @label: of the first one. */
void lad_arc(struct lad *e, int arc, const char *label);
void lad_steps(struct lad *e);
void lad_outputs(struct lad *e);
#endif
