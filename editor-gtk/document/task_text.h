/* SPDX-License-Identifier: MIT
 *
 * task_text - the CONFIGURATION of a document as lines: those of tasks and programs with their
 * fields, everything else as it stands. It judges no edit and changes no document.
 */
#ifndef EDITOR_TASK_TEXT_H
#define EDITOR_TASK_TEXT_H

#include "editor-gtk/document/document.h"

enum task_line_kind { LINE_FIXED, LINE_TASK, LINE_PROGRAM };

struct task_line {
	enum task_line_kind kind;
	char *text;          /* as it stands, with its newline; of a changed line: its comments */
	char *name;
	char *task, *pou;    /* of a program; task "": none                    */
	char *values;        /* likewise, ` (In := 5)`; "": none               */
	char *single, *interval, *priority, *watchdog; /* of a task; "": none  */
	bool changed;        /* its text is made of its fields                 */
	bool closes;         /* LINE_FIXED: END_RESOURCE or END_CONFIGURATION  */
};

/* Lines in place of @removed bytes at @at of the canonical text. */
struct task_text {
	LadderDocument *document;
	struct project *project;
	char *whole;
	gsize len, at, removed;
	GPtrArray *line;     /* of struct task_line                                 */
	GArray *of;          /* of each row of task_rows.h: its line, borrowed; NULL: none */
};

/** task_text_new - the lines of the document as it is. A project without a CONFIGURATION, or
 * without a PROGRAM line in it, gets lines for all its programs; @written is false then. Owns:
 * the caller. */
struct task_text *task_text_new(LadderDocument *document, bool *written);
void task_text_free(struct task_text *t);
/** task_text_is_included - is the CONFIGURATION in another file? */
bool task_text_is_included(const struct project *project);
/** task_text_joined - the lines as one text. Caller frees. */
char *task_text_joined(const struct task_text *t);

struct task_line *task_line_at(const struct task_text *t, guint index);
guint task_text_index(const struct task_text *t, const struct task_line *line);
/** task_text_number - the number of a line in the file, from 1. */
int task_text_number(const struct task_text *t, guint index);
bool task_text_has(const struct task_text *t, enum task_line_kind kind);
/** task_text_of_pou - the first PROGRAM line of a POU; NULL: none. */
const struct task_line *task_text_of_pou(const struct task_text *t, const char *pou);
/** task_text_closing - the line before which new ones are added. */
struct task_line *task_text_closing(const struct task_text *t);
bool task_text_is_taken(const struct task_text *t, const char *name);
/** task_text_free_name - @like with a number, "Task1"; without @number, @like itself if it is
 * free. Caller frees. */
char *task_text_free_name(const struct task_text *t, const char *like, bool number);
/** task_text_add_program - inserts a PROGRAM line before line @at. @task: "": none. */
struct task_line *task_text_add_program(struct task_text *t, guint at, int pou,
					const char *task);

/** task_line_new - @text: taken over. The caller adds it to the lines. */
struct task_line *task_line_new(enum task_line_kind kind, char *text);
/** task_line_text - the line as the file has it. Caller frees. */
char *task_line_text(const struct task_line *line);
/** task_line_set - sets a field. */
void task_line_set(char **text, const char *now);

#endif
