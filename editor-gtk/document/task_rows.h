/* SPDX-License-Identifier: MIT
 *
 * task_rows - the tasks of a document as rows, each with its programs, and edits of them.
 *
 * Rows come from the CONFIGURATION. A project without one, or without a PROGRAM line in it,
 * runs all its programs in each scan; its first edit writes the PROGRAM lines. An edit changes
 * the text of its own lines and nothing else, as one step of the history. It is refused, with
 * the reason, if its lines could not be read or would have an error. It shows nothing.
 */
#ifndef EDITOR_TASK_ROWS_H
#define EDITOR_TASK_ROWS_H

#include "editor-gtk/document/document.h"

#define TASKS_PERIOD_NS G_GINT64_CONSTANT(10000000) /* of a scan, if no task has a period */

enum task_field {
	TASKS_NAME,     /* of a program: of its instance                       */
	TASKS_PROGRAM,
	TASKS_KIND,     /* translated: "Cyclic"                                */
	TASKS_WHEN,     /* the period or the variable                          */
	TASKS_PRIORITY, TASKS_WATCHDOG, TASKS_COMMENT,
	TASKS_FIELDS
};

enum task_what {
	TASKS_TASK,      /* a TASK line                                        */
	TASKS_EACH_SCAN, /* the heading of programs without a task             */
	TASKS_IDLE,      /* the heading of programs that do not run            */
	TASKS_INSTANCE,  /* a program, below one of these                      */
};

struct task_row {
	enum task_what what;
	int head;                  /* row of its heading; its own number: it is one */
	int pou;                   /* of an instance; -1: unknown, or no instance */
	int line;                  /* in the whole text, from 1; 0: not written */
	bool event;                /* a task that a variable starts            */
	char *text[TASKS_FIELDS];  /* a comment has no delimiters              */
};

struct task_rows {
	struct task_row *row;
	int count;
	bool written;  /* the file says which programs run                     */
	bool fixed;    /* the CONFIGURATION is in another file                 */
	struct task_text *inside;
};

/** task_rows_new - of the document as it is; empty for a document of text. Owns: the caller. */
struct task_rows *task_rows_new(LadderDocument *document);
void task_rows_free(struct task_rows *tasks);
/** task_rows_find - the row of this kind and name; -1: none. A heading without a line of its own is
 * the only one of its kind: its name does not matter. */
int task_rows_find(const struct task_rows *tasks, enum task_what what, const char *name);
/** task_rows_programs - how many programs are below a heading. */
int task_rows_programs(const struct task_rows *tasks, int head);
/** task_rows_has - whether a row of this kind has a field that can be edited. */
bool task_rows_has(enum task_what what, enum task_field field);
/** task_rows_field_name - "Priority", translated. Lives for ever. */
const char *task_rows_field_name(enum task_field field);
/** task_rows_kind_name - "Cyclic", "Event", translated. Lives for ever. */
const char *task_rows_kind_name(bool event);
/** task_rows_error - the error of the last check in a row; NULL: none. @warning: gets whether it is
 * only a warning. Owns: the caller. */
char *task_rows_error(LadderDocument *document, const struct task_row *row, bool *warning);

/* Each edit is one step of the history. It fails with false, nothing changed; @why (or NULL) gets
 * a translated reason, which the caller frees. Rows are numbers in task_rows_new() of the document as
 * it is. */

/** task_rows_set - changes one field. A period may be written as 10ms. A period in place of a
 * variable makes a cyclic task, a variable in place of a period one with an event. A field of
 * programs without a task makes a task of them. */
bool task_rows_set(LadderDocument *document, int row, enum task_field field, const char *text,
	       char **why);
/** task_rows_name_refusal - why a task cannot have this name, translated; NULL: it can, as far as
 * names go. Caller frees. */
char *task_rows_name_refusal(LadderDocument *document, int row, const char *name);
/** task_rows_add - a task without programs, behind the others. @name: gets its name, which the caller
 * frees. */
bool task_rows_add(LadderDocument *document, char **name, char **why);
/** task_rows_delete - deletes a task; its programs then run in each scan. Deletes an instance; its
 * program then does not run. */
bool task_rows_delete(LadderDocument *document, int row, char **why);
/** task_rows_add_program - adds an instance of POU @pou behind the programs of a heading; moves it if
 * the program has one. @name: gets the name of the instance. */
bool task_rows_add_program(LadderDocument *document, int head, int pou, char **name, char **why);
/** task_rows_move - moves an instance, or a task within the order of the file
 * @head: the heading of the instance afterwards; of a task ignored
 * @before: it stands before this row, a program of @head or a task; -1: behind all
 */
bool task_rows_move(LadderDocument *document, int row, int head, int before, char **why);
/** task_rows_drop - moves a row as it is dropped above or @below row @target: a task stands before or
 * behind the whole task of @target. */
bool task_rows_drop(LadderDocument *document, int row, int target, bool below, char **why);
/** task_rows_can_step - whether task_rows_step() moves it. */
bool task_rows_can_step(const struct task_rows *tasks, int row, int by);
/** task_rows_step - moves a program or a task up (-1) or down (1): over its neighbour, or a program
 * at the edge of its task into the next one. */
bool task_rows_step(LadderDocument *document, int row, int by, char **why);

#endif
