/* SPDX-License-Identifier: MIT
 *
 * sfc_edit - a chart becomes another one: steps, ways, conditions, what is done.
 *
 * An edit is a copy of a chart that is changed, and then written as the text of its POU:
 * the document exchanges texts, and undo is to exchange them back. It knows no toolkit
 * and changes nothing of the project but that it may add strings to its table. Numbers of
 * steps, transitions and lines are those of the chart that was copied; what is new comes
 * behind them, what was deleted keeps its number and is not written.
 */
#ifndef EDITOR_SFC_EDIT_H
#define EDITOR_SFC_EDIT_H

#include "engine/model/project.h"

struct sfc_edit {
	struct project *project;
	struct pou pou;          /* a copy with a chart of its own             */
	struct sfc sfc;
	struct arena arena;
	int rungs;               /* of the POU that was copied: not owned       */
	const char *why;         /* N_(): what was refused last; NULL: nothing  */
};

/** sfc_edit_new - of a POU that is a chart. Owns: the caller, sfc_edit_free(). NULL: no
 * memory. */
struct sfc_edit *sfc_edit_new(struct project *project, const struct pou *pou);
void sfc_edit_free(struct sfc_edit *edit);
/** sfc_edit_text - of the POU as it is now. Owns: the caller, free(). NULL: no memory. */
char *sfc_edit_text(const struct sfc_edit *edit);

/* All of these return the number of what is new, or -1 (or false), and @why says why. */

/** sfc_edit_step_below - a step behind a step, which takes over its ways on; a transition
 * leads to it. */
int sfc_edit_step_below(struct sfc_edit *edit, int step);
/** sfc_edit_step_after - a step behind a transition, and behind it another transition to
 * where that one led. */
int sfc_edit_step_after(struct sfc_edit *edit, int transition);
/** sfc_edit_branch - another way out of a step, to a new step. */
int sfc_edit_branch(struct sfc_edit *edit, int step);
/** sfc_edit_parallel - a new step that a transition leads to as well. */
int sfc_edit_parallel(struct sfc_edit *edit, int transition);
/** sfc_edit_first - a step that nothing leads to; the first one of a chart is initial. */
int sfc_edit_first(struct sfc_edit *edit, int macro);
/** sfc_edit_lead - another way, from a step to a step. Returns the transition. */
int sfc_edit_lead(struct sfc_edit *edit, int from, int to);
/** sfc_edit_set_ways - names behind FROM (@to false) or TO, parted by commas; unknown ones
 * are taken as they are. */
bool sfc_edit_set_ways(struct sfc_edit *edit, int transition, bool to, const char *names);
/** sfc_edit_wait - a transition waits for one more step. */
bool sfc_edit_wait(struct sfc_edit *edit, int transition, int step);
/** sfc_edit_delete_step - what led to it leads to what followed, if that was one way. */
bool sfc_edit_delete_step(struct sfc_edit *edit, int step);
bool sfc_edit_delete_transition(struct sfc_edit *edit, int transition);
/** sfc_edit_cut_way - one name behind FROM or TO: @ref of sfc.ref; the last one takes its
 * transition with it. */
bool sfc_edit_cut_way(struct sfc_edit *edit, int transition, int ref);
/** sfc_edit_move - the branch in which @step stands (or of @transition; the other is -1)
 * changes places with its neighbour. */
bool sfc_edit_move(struct sfc_edit *edit, int step, int transition, bool right);

/* ---- names, conditions, what is done, comments ---- */

/** sfc_edit_free_name - Step3: one that nothing has. Lives as long as the edit. */
const char *sfc_edit_free_name(struct sfc_edit *edit, const char *base);
/** sfc_edit_name_step - wherever it is named in the chart, Name.X and Name.T too. */
bool sfc_edit_name_step(struct sfc_edit *edit, int step, const char *name);
bool sfc_edit_name_transition(struct sfc_edit *edit, int transition, const char *name);
bool sfc_edit_set_priority(struct sfc_edit *edit, int transition, int priority);
/** sfc_edit_set_kind - plain, initial; a macro-step stays one. */
bool sfc_edit_set_kind(struct sfc_edit *edit, int step, enum step_kind kind);
/** sfc_edit_set_times - "" for none. */
bool sfc_edit_set_times(struct sfc_edit *edit, int step, const char *min, const char *max,
			const char *alarm);
/** sfc_is_expression - could it stand behind := of a transition? */
bool sfc_is_expression(const char *text);
/** sfc_edit_set_condition - an expression; "": none. */
bool sfc_edit_set_condition(struct sfc_edit *edit, int transition, const char *text);
/** sfc_edit_as_rung - the condition is a rung from now on. */
bool sfc_edit_as_rung(struct sfc_edit *edit, int transition);

/* What a line that a person types says of what a step does. */
struct sfc_doing {
	enum use_kind kind;
	enum qualifier qualifier;
	char time[64];           /* "": none                                   */
	char name[LIMIT_NAME + 1];
	const char *operand;     /* in the line: from the name on, with what the
				    line says of it, `Horn AT %QX0.5`          */
	bool says;               /* it does say something of it                */
	bool action;             /* it began with ACTION: one is to be made    */
	const char *why;         /* N_(): what is missing; NULL: nothing       */
};
/** sfc_doing_read - "Valve", "N Valve", "L T#3s Horn", "SET Lamp", "ACTION Count",
 * "N Horn AT %QX0.5 : BOOL". False: @out->why says what is missing. */
bool sfc_doing_read(const char *line, struct sfc_doing *out);
/** sfc_doing_print - the line again. */
void sfc_doing_print(const struct project *project, const struct sfc *sfc, int use,
		     char *out, size_t size);
/** sfc_edit_set_use - a line of a step, or a new one (@use -1). */
bool sfc_edit_set_use(struct sfc_edit *edit, int step, int use,
		      const struct sfc_doing *doing);
bool sfc_edit_delete_use(struct sfc_edit *edit, int use);

/** sfc_edit_set_comment - of PIECE_STEP, PIECE_TRANSITION; "": none. */
bool sfc_edit_set_comment(struct sfc_edit *edit, enum piece_kind kind, int index,
			  const char *text);
/** sfc_edit_set_use_comment - of a line of what a step does. */
bool sfc_edit_set_use_comment(struct sfc_edit *edit, int use, const char *text);

/* ---- sfc_edit_macro.c: charts in steps ---- */

/** sfc_edit_macro_make - the steps of @chosen (by step) become the inside of a new
 * macro-step; one of them must be where it is entered, one where it is left. Returns the
 * macro-step. */
int sfc_edit_macro_make(struct sfc_edit *edit, const bool *chosen);
/** sfc_edit_macro_open - the inside of a macro-step stands in its place. Returns the step
 * that is entered. */
int sfc_edit_macro_open(struct sfc_edit *edit, int macro);
/* ---- sfc_edit_insert.c: a part comes into the sequence ---- */

/**
 * sfc_edit_insert - what stands behind the chart comes into its sequence
 * @step, @way:       the first step and transition of it, which are the last ones of all;
 *                    ways that lead out of it name others, or none there is
 * @at_step, @at_way: behind which of them, the other -1; both -1: it stays where it is
 *
 * A step and what follows it in a sequence come between the transition there and what that
 * led to; where steps or transitions would meet, an empty one is made between them. What has
 * not one beginning and one end stays where it is, and @why says so.
 * Returns a step to go to, maybe none of those there are. Fails: -1.
 */
int sfc_edit_insert(struct sfc_edit *edit, int step, int way, int at_step, int at_way);

/* ---- shared by the files ---- */
/** sfc_edit_new_step - in a macro-step or -1, behind piece @behind. */
int sfc_edit_new_step(struct sfc_edit *edit, int macro, int behind);
/** sfc_edit_new_transition - from @from to @to (-1: none yet). */
int sfc_edit_new_transition(struct sfc_edit *edit, int macro, int from, int to, int behind);
/** sfc_edit_find_piece - -1: it is not written any more. */
int sfc_edit_find_piece(const struct sfc_edit *edit, enum piece_kind kind, int index);
/** sfc_edit_step_end - its last piece: of a macro-step that of its END_STEP. */
int sfc_edit_step_end(const struct sfc_edit *edit, int step);
/** sfc_edit_copy_refs - the names behind FROM (@to false) or TO become the transition's own,
 * behind all others; without @skip (-1: all of them). */
bool sfc_edit_copy_refs(struct sfc_edit *edit, int transition, bool to, int skip);
/** sfc_edit_names_step - is @step one of the names behind FROM (@to false) or TO? */
bool sfc_edit_names_step(const struct sfc_edit *edit, int transition, bool to, int step);
/** sfc_edit_hand_over - the first @ways transitions that leave @step leave @other instead. */
bool sfc_edit_hand_over(struct sfc_edit *edit, int step, int other, int ways);
/** sfc_edit_drop_piece - number @at is written no more; -1: nothing. */
void sfc_edit_drop_piece(struct sfc_edit *edit, int at);
/** sfc_edit_asks_for - does anything in the chart name @step.X or @step.T? */
bool sfc_edit_asks_for(const struct sfc_edit *edit, int step);
uint32_t sfc_edit_id(struct sfc_edit *edit, const char *text);
/** sfc_edit_put_piece - behind piece @at (-1: at the beginning). */
bool sfc_edit_put_piece(struct sfc_edit *edit, int at, enum piece_kind kind, int index);
/** sfc_edit_refuse - false, with a reason. */
bool sfc_edit_refuse(struct sfc_edit *edit, const char *why);

#endif
