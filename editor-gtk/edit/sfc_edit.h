/* SPDX-License-Identifier: MIT
 *
 * sfc_edit - changes a chart: steps, transitions, conditions, actions of steps.
 *
 * An edit copies the chart of a POU, changes the copy and writes it as the text of the POU.
 * The document exchanges the texts; undo exchanges them back. It knows no toolkit; of the
 * project it changes only the table of strings. Steps, transitions and lines keep the numbers
 * of the copied chart; new ones get higher numbers, deleted ones are not written.
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
	const char *why;         /* N_(): the last refusal; NULL: none          */
};

/** sfc_edit_new - of a POU that is a chart. Owns: the caller, sfc_edit_free(). NULL: no
 * memory. */
struct sfc_edit *sfc_edit_new(struct project *project, const struct pou *pou);
void sfc_edit_free(struct sfc_edit *edit);
/** sfc_edit_text - of the POU as it is now. Owns: the caller, free(). NULL: no memory. */
char *sfc_edit_text(const struct sfc_edit *edit);

/* These return the number of the new step or transition. They fail with -1 or false, and
 * edit->why says why. */

/** sfc_edit_step_below - a new transition and step behind a step; the transitions behind that
 * step now leave the new one. */
int sfc_edit_step_below(struct sfc_edit *edit, int step);
/** sfc_edit_step_after - a new step behind a transition, and behind it a new transition to the
 * steps that the old one led to. */
int sfc_edit_step_after(struct sfc_edit *edit, int transition);
/** sfc_edit_branch - one more transition behind a step, to a new step. */
int sfc_edit_branch(struct sfc_edit *edit, int step);
/** sfc_edit_parallel - one more new step behind a transition. */
int sfc_edit_parallel(struct sfc_edit *edit, int transition);
/** sfc_edit_first - a new step that no transition leads to; the first of a chart is initial. */
int sfc_edit_first(struct sfc_edit *edit, int macro);
/** sfc_edit_lead - a new transition from a step to a step. Returns the transition. */
int sfc_edit_lead(struct sfc_edit *edit, int from, int to);
/** sfc_edit_set_ways - sets the steps behind FROM (@to false) or TO: names with commas between
 * them. Unknown names are accepted. */
bool sfc_edit_set_ways(struct sfc_edit *edit, int transition, bool to, const char *names);
/** sfc_edit_wait - a transition waits for one more step. */
bool sfc_edit_wait(struct sfc_edit *edit, int transition, int step);
/** sfc_edit_delete_step - transitions that led to it lead to its only successor, if it has one. */
bool sfc_edit_delete_step(struct sfc_edit *edit, int step);
bool sfc_edit_delete_transition(struct sfc_edit *edit, int transition);
/** sfc_edit_cut_way - deletes a name behind FROM or TO: @ref of sfc.ref. A transition that
 * has no name left on that side is deleted. */
bool sfc_edit_cut_way(struct sfc_edit *edit, int transition, int ref);
/** sfc_edit_move - swaps the branch of @step or of @transition (the other is -1) with its
 * neighbour. */
bool sfc_edit_move(struct sfc_edit *edit, int step, int transition, bool right);

/* ---- names, conditions, actions, comments ---- */

/** sfc_edit_name_step - renames a step wherever the chart names it, Name.X and Name.T too. */
bool sfc_edit_name_step(struct sfc_edit *edit, int step, const char *name);
bool sfc_edit_name_transition(struct sfc_edit *edit, int transition, const char *name);
bool sfc_edit_set_priority(struct sfc_edit *edit, int transition, int priority);
/** sfc_edit_set_kind - plain or initial; not for a macro-step. */
bool sfc_edit_set_kind(struct sfc_edit *edit, int step, enum step_kind kind);
/** sfc_edit_set_times - "" for none. */
bool sfc_edit_set_times(struct sfc_edit *edit, int step, const char *min, const char *max,
			const char *alarm);
/** sfc_is_expression - can it stand behind := of a transition? */
bool sfc_is_expression(const char *text);
/** sfc_edit_set_condition - an expression; "": none. */
bool sfc_edit_set_condition(struct sfc_edit *edit, int transition, const char *text);
/** sfc_edit_as_rung - the condition becomes a rung. */
bool sfc_edit_as_rung(struct sfc_edit *edit, int transition);

/* The action of a step, as a line of text. */
struct sfc_doing {
	enum use_kind kind;
	enum qualifier qualifier;
	char time[64];           /* "": none                                   */
	char name[LIMIT_NAME + 1];
	const char *operand;     /* in the line, from the name on, with its declaration: `Horn
				    AT %QX0.5` */
	bool says;               /* @operand has a declaration                 */
	bool action;             /* it begins with ACTION: makes a new one     */
	bool statements;         /* and ends with ST: in Structured Text       */
	const char *why;         /* N_(): what is missing; NULL: nothing       */
};
/** sfc_doing_read - "Valve", "N Valve", "L T#3s Horn", "SET Lamp", "ACTION Count",
 * "ACTION Count ST", "N Horn AT %QX0.5 : BOOL". False: @out->why says what is missing. */
bool sfc_doing_read(const char *line, struct sfc_doing *out);
/** sfc_doing_print - the line for an action that the step has. */
void sfc_doing_print(const struct project *project, const struct sfc *sfc, int use,
		     char *out, size_t size);
/** sfc_edit_set_use - changes an action of a step, or adds one (@use -1). */
bool sfc_edit_set_use(struct sfc_edit *edit, int step, int use,
		      const struct sfc_doing *doing);
bool sfc_edit_delete_use(struct sfc_edit *edit, int use);

/** sfc_edit_set_comment - of PIECE_STEP, PIECE_TRANSITION; "": none. */
bool sfc_edit_set_comment(struct sfc_edit *edit, enum piece_kind kind, int index,
			  const char *text);
/** sfc_edit_set_use_comment - of an action of a step. */
bool sfc_edit_set_use_comment(struct sfc_edit *edit, int use, const char *text);

/* ---- sfc_edit_macro.c: macro-steps ---- */

/** sfc_edit_macro_make - moves the steps of @chosen (by step) into a new macro-step. They must
 * be entered at one step and left at one step. Returns the macro-step. */
int sfc_edit_macro_make(struct sfc_edit *edit, const bool *chosen);
/** sfc_edit_macro_open - replaces a macro-step by the steps inside it. Returns the first of
 * them. */
int sfc_edit_macro_open(struct sfc_edit *edit, int macro);
/* ---- sfc_edit_insert.c: inserting a pasted part ---- */

/**
 * sfc_edit_insert - moves a part at the end of the chart into its sequence
 * @step, @way:       the first step and transition of the part; all later numbers belong to
 * it. Transitions that leave it name other steps, or unknown ones
 * @at_step, @at_way: the step or transition to insert it behind, the other is -1; both -1:
 * the part stays where it is
 *
 * Where two steps or two transitions would meet, an empty transition or step is put between
 * them. A part without exactly one beginning and one end stays where it is, and edit->why
 * says so. Returns a step for the cursor, which may not exist. Fails: -1.
 */
int sfc_edit_insert(struct sfc_edit *edit, int step, int way, int at_step, int at_way);

/* ---- shared by the files ---- */
/** sfc_edit_push_step - in a macro-step or -1, without a piece: it is not in the file yet. */
int sfc_edit_push_step(struct sfc_edit *edit, enum step_kind kind, int macro);
/** sfc_edit_new_step - in a macro-step or -1, behind piece @behind. */
int sfc_edit_new_step(struct sfc_edit *edit, int macro, int behind);
/** sfc_edit_new_transition - from @from to @to (-1: none yet). */
int sfc_edit_new_transition(struct sfc_edit *edit, int macro, int from, int to, int behind);
/** sfc_edit_find_piece - its place in the file; -1: it was deleted. */
int sfc_edit_find_piece(const struct sfc_edit *edit, enum piece_kind kind, int index);
/** sfc_edit_step_end - its last piece: of a macro-step that of its END_STEP. */
int sfc_edit_step_end(const struct sfc_edit *edit, int step);
/** sfc_edit_copy_refs - copies the names behind FROM (@to false) or TO to the end of sfc.ref,
 * without @skip (-1: all of them), so that they can be changed. */
bool sfc_edit_copy_refs(struct sfc_edit *edit, int transition, bool to, int skip);
/** sfc_edit_names_step - is @step one of the names behind FROM (@to false) or TO? */
bool sfc_edit_names_step(const struct sfc_edit *edit, int transition, bool to, int step);
/** sfc_edit_hand_over - moves the first @ways transitions that leave @step to @other. */
bool sfc_edit_hand_over(struct sfc_edit *edit, int step, int other, int ways);
/** sfc_edit_drop_piece - removes piece @at from the file; -1: nothing. */
void sfc_edit_drop_piece(struct sfc_edit *edit, int at);
/** sfc_edit_asks_for - does anything in the chart name @step.X or @step.T? */
bool sfc_edit_asks_for(const struct sfc_edit *edit, int step);
/** sfc_edit_put_piece - behind piece @at (-1: at the beginning). */
bool sfc_edit_put_piece(struct sfc_edit *edit, int at, enum piece_kind kind, int index);
/** sfc_edit_refuse - false, with a reason. */
bool sfc_edit_refuse(struct sfc_edit *edit, const char *why);

#endif
