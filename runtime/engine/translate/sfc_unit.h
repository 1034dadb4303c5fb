/* SPDX-License-Identifier: MIT
 *
 * sfc_unit - shared by the parts of the translation of charts: the current chart.
 *
 * Private to translate/. sfc_to_il.c walks the phases of a scan, sfc_evolve.c turns
 * transitions into IL, sfc_act.c actions.
 */
#ifndef TRANSLATE_SFC_UNIT_H
#define TRANSLATE_SFC_UNIT_H

#include "engine/model/sfc_net.h"
#include "engine/translate/ladder_unit.h"

/* An action that steps call, or a BOOL. */
struct sfc_called {
	int action;           /* -1: a BOOL                                    */
	uint32_t operand;     /* of a BOOL, as it is written first             */
	const struct meaning *meaning; /* of it; NULL: it has none             */
	int *use;             /* of sfc.use, in their order                    */
	int use_count;
	bool level, pulse, off; /* has it N S L D P SD DS SL; P0 P1; R?       */
	bool unsure;          /* evaluated also when no step calls it? */
};

/* The arcs that need a step, and which step evaluates them. */
enum step_duty {
	DUTY_NONE,            /* nothing, or another step's                    */
	DUTY_OWN,             /* arcs that want this step alone                */
	DUTY_JOIN,            /* one arc that wants other steps too            */
	DUTY_GROUP,           /* arcs that want several steps, some the same   */
};
struct sfc_duty {
	enum step_duty duty;
	int *arc;             /* by priority; of a group: in its first step    */
	int arc_count;
	int group;            /* its first step                                */
};

struct sfc_il {
	struct ld ld;
	const struct sfc *sfc;
	struct sfc_net net;
	const uint8_t *skip;  /* rungs with errors                             */
	uint32_t line;        /* source line of the current piece              */
	struct sfc_duty *duty; /* by step                                      */
	int *note;            /* by first rung of a body: of unit->power, its first */
	struct sfc_called *called;
	int called_count;
	int *called_of;       /* by line of a step; -1: SET, RESET, nothing    */
	int entries;          /* labels of steps that are entered IN ORDER     */
	uint32_t next, act, leave, enter; /* labels                           */
	uint32_t cursor, dt, last, condition, fired;
};

/* ---- sfc_to_il.c ---- */
/** sfc_op - one operator; sfc_fn - a function on the result. */
void sfc_op(struct sfc_il *s, enum op op, uint8_t modifiers, uint32_t operand);
void sfc_fn(struct sfc_il *s, enum word word, uint32_t operand);
/** sfc_set - TRUE or FALSE into a BOOL. */
void sfc_set(struct sfc_il *s, uint32_t operand, bool value);
/** sfc_label - its name: "_Fire3"; @number < 0: without one. sfc_here - puts it here. */
uint32_t sfc_label(struct sfc_il *s, const char *name, int number);
void sfc_here(struct sfc_il *s, uint32_t label);
/** sfc_jump - JMP; sfc_jump_if, sfc_jump_unless - on the result. */
void sfc_jump(struct sfc_il *s, uint32_t label);
void sfc_jump_if(struct sfc_il *s, uint32_t label);
void sfc_jump_unless(struct sfc_il *s, uint32_t label);
/** sfc_var - a variable of the chart's own: "_Left3"; declared at its first use. */
uint32_t sfc_var(struct sfc_il *s, const char *name, int number, enum iec_type type);
/** sfc_x_name, sfc_t_name - the names of Step.X and Step.T. */
uint32_t sfc_x_name(const struct sfc_il *s, int step);
uint32_t sfc_t_name(const struct sfc_il *s, int step);
/** sfc_each - jumps to the label of each BOOL that is TRUE; the parts jump back to it. @label:
 * one a BOOL. */
void sfc_each(struct sfc_il *s, uint32_t back, uint32_t first, const uint32_t *label,
	      int count);
/** sfc_put_body - the rungs or instructions of a condition or action; RET leads to @end. */
void sfc_put_body(struct sfc_il *s, const struct sfc_body *body, uint32_t end);
/** sfc_darken - while watching: no power in these rungs. */
void sfc_darken(struct sfc_il *s, const struct sfc_body *body);
/** sfc_literal - the string id of a text. */
uint32_t sfc_literal(struct sfc_il *s, const char *text);
/** sfc_alloc - cleared memory of the translation; NULL: s->ld.failed. */
void *sfc_alloc(struct sfc_il *s, size_t count, size_t size);

/* ---- sfc_evolve.c ---- */
/** sfc_find_duties - which step evaluates which arc. */
void sfc_find_duties(struct sfc_il *s);
void sfc_supervise(struct sfc_il *s);
void sfc_evaluate(struct sfc_il *s);
/** sfc_fire - code for arcs that fire and for steps that are left and entered; with labels. */
void sfc_fire(struct sfc_il *s);
void sfc_leave(struct sfc_il *s);
void sfc_enter(struct sfc_il *s);

/* ---- sfc_order.c: IN ORDER ---- */
/** sfc_is_in_order - does the chart evolve so? */
bool sfc_is_in_order(const struct sfc_il *s);
/** sfc_order - all rounds of a scan; the first scan enters at label "Order". */
void sfc_order(struct sfc_il *s);

/* ---- sfc_control.c ---- */
/** sfc_control - start, supervision, RESET, FORCE and the modes. */
void sfc_control(struct sfc_il *s);
/** sfc_start - the first scan makes the initial steps active; the others go on behind it. */
void sfc_start(struct sfc_il *s);
/** sfc_stop - RESET and HOLD let nothing fire. */
void sfc_stop(struct sfc_il *s);
/** sfc_allow - changes the result, a condition, as the mode requires. */
void sfc_allow(struct sfc_il *s);
/** sfc_anew - TRUE while RESET or FORCE leaves all steps: steps then become active again
 * without a transition. sfc_may_begin_anew - has the chart RESET or FORCE? */
uint32_t sfc_anew(struct sfc_il *s);
bool sfc_may_begin_anew(const struct sfc_il *s);
/** sfc_once - no TIP counts for another round of the same scan. */
void sfc_once(struct sfc_il *s);

/* ---- sfc_act.c ---- */
/** sfc_find_called - actions and BOOLs that steps call, actions first. */
void sfc_find_called(struct sfc_il *s);
/** sfc_ask - requests of the active steps; sfc_act - the actions; both up to the end of the
 * scan. */
void sfc_ask(struct sfc_il *s);
void sfc_act(struct sfc_il *s);
/** sfc_pulse - actions that begin or end when @step becomes active or is left. */
void sfc_pulse(struct sfc_il *s, int step, bool entered);
/** sfc_forget - clears all stored actions. */
void sfc_forget(struct sfc_il *s);
#endif
