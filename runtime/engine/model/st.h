/* SPDX-License-Identifier: MIT
 *
 * st - a body of Structured Text (IEC 61131-3, 3.3): its statements in order, as texts.
 *
 * The beginning and the end of a block are statements of their own. A text stays as it was written. st_next() alone knows the parts of a statement: reader, check,
 * translation and cross reference walk them with it.
 */
#ifndef MODEL_ST_H
#define MODEL_ST_H

#include "engine/base/names.h"
#include "engine/model/expr.h"

enum st_kind {
	ST_ASSIGN,     /* Level := Level + 1;                                 */
	ST_CALL,       /* Delay(IN := Start, Q => Motor);                     */
	ST_IF,         /* IF condition THEN                                   */
	ST_ELSIF,
	ST_ELSE,       /* of an IF or a CASE                                  */
	ST_END_IF,
	ST_CASE,       /* CASE selector OF                                    */
	ST_CHOICE,     /* 1, 3..5:                                            */
	ST_END_CASE,
	ST_FOR,        /* FOR i := 1 TO 10 BY 2 DO                            */
	ST_END_FOR,
	ST_WHILE,      /* WHILE condition DO                                  */
	ST_END_WHILE,
	ST_REPEAT,
	ST_UNTIL,      /* UNTIL condition END_REPEAT                          */
	ST_EXIT, ST_CONTINUE, ST_RETURN,
	ST_JUMP,       /* JMP Again;                                          */
	ST_LABEL,      /* Again:                                              */
	ST_EMPTY,      /* ; alone                                             */
	ST_COMMENT,    /* a comment or a pragma between statements            */
	ST_SET,        /* Horn S= Alarm: of a network (model/fbd.h), as those below */
	ST_RESET,      /* Horn R= Seen                                        */
	ST_JUMP_IF,    /* JMP Fill IF Low, or without IF                      */
	ST_RETURN_IF,
	ST_STOP_IF,    /* STOP IF Broken                                      */
	ST_KINDS
};

struct st_item {
	uint8_t kind;      /* enum st_kind                                    */
	bool behind;       /* ST_COMMENT: on the line of the item before it   */
	bool gap;          /* an empty line stands above it                   */
	uint8_t depth;     /* blocks around it                                */
	uint8_t at_column, at_row; /* of a network: where its box stands, from 1; 0: found by layout */
	uint32_t text;     /* string id: its text, without THEN OF DO : ;     */
	int line, column;  /* of its first byte in the file, from 1           */
};

struct st {
	struct st_item *item;
	int count;
};

/* How a statement is written. */
struct st_form {
	const char *word;  /* it begins with; "": none                        */
	const char *end;   /* it ends with: THEN, OF, DO, ":", ";" or ""      */
	bool opens;        /* a block begins behind it                        */
	bool closes;       /* a block ends before it                          */
	bool tests;        /* its one part is a value                         */
};
/** st_form - of a kind. Lives for ever. Scan-safe: yes. */
const struct st_form *st_form(enum st_kind kind);

enum st_role {
	ST_NO_PART,    /* behind the last part                                */
	ST_ASSIGNED,   /* the expression, with its target; of `a := b := 1` first b := 1, then a := b */
	ST_VALUE,      /* a condition, a selector, what UNTIL tests           */
	ST_LOW,        /* of a choice: a constant                             */
	ST_HIGH,       /* of a choice: the end of the range that LOW began    */
	ST_VARIABLE,   /* of FOR; of S= and R=                                */
	ST_FROM, ST_TO, ST_BY,
	ST_OPEN,       /* `PIN :=` or `PIN =>` with nothing behind it: as if it were not there */
	ST_CALLED,     /* what is called: an instance, a subroutine, a function */
	ST_INPUT,      /* an argument                                         */
	ST_OUTPUT,     /* => variable                                         */
};

/* A part of a statement; st_next() gets its expression. */
struct st_part {
	enum st_role role;
	struct expr_tail pin; /* of ST_INPUT, ST_OUTPUT, where len 0 is: by its place; of ST_OPEN */
	bool inverted;        /* of ST_OUTPUT: NOT Q => place                 */
	const char *text;     /* its first byte                               */
};

struct st_walk {
	struct lex lex;    /* at the token behind the parts so far            */
	enum st_kind kind;
	enum st_role last; /* ST_NO_PART: none so far                         */
	bool missing;      /* a part cannot be read                           */
	struct { const char *at, *line_start; int line; } first; /* of `a := b := 1` */
	int stores;        /* likewise: how many := are not done              */
};

/** st_begin - before the first part of @item. Scan-safe: yes. */
void st_begin(struct st_walk *walk, const struct names *names, const struct st_item *item);
/**
 * st_next - the next part of a statement
 * @walk:  from st_begin(); or, while a text is read, a lexer at its first token, its kind, and 0
 * @part:  gets the part; ST_NO_PART behind the last one, the lexer on the token there
 * @expr:  gets its expression; caller's memory
 * @diags: gets a message with @place and the column
 *
 * Owns: nothing; texts are borrowed. Scan-safe: no.
 * Fails: false after one diagnostic.
 */
bool st_next(struct st_walk *walk, struct st_part *part, struct expr *expr,
	     struct diag_list *diags, struct diag place);
/** st_where - line and column of byte @at of @item's text. Scan-safe: yes. */
void st_where(const struct names *names, const struct st_item *item, const char *at, int *line,
	      int *column);
/** st_begins - is the statement at the lexer one of Structured Text, not of an instruction list? It
 * tells by its first word, and by `:=` or `;` in it. Scan-safe: yes. */
bool st_begins(struct lex lex);
/* Which item begins the statements at each depth; first { { -1 } }. */
struct st_lists {
	int of[2 * LIMIT_ST_DEPTH + 3];
};
/** st_lists_step - behind item @at. Scan-safe: yes. */
void st_lists_step(struct st_lists *lists, const struct st_item *item, int at);

/* Labels of a body, by their names. */
struct st_labels {
	struct st_label {
		uint32_t fold;     /* of the name                             */
		int item;
		int list;          /* the item that begins the statements around it; -1: the body */
	} label[LIMIT_ST_LABELS];
	int count;
	int over;          /* an item that is one label too many; -1: none    */
};
/** st_labels - the labels among @count items from @first on. Scan-safe: no. */
void st_labels(struct names *names, const struct st *st, int first, int count, struct st_labels *out);
/** st_label_name - of a ST_JUMP, ST_JUMP_IF or ST_LABEL; of others the first token; borrowed. Scan-safe: yes. */
struct token st_label_name(const struct names *names, const struct st_item *item);
/** st_label_find - index of the first label with the name of @item; -1: none. Scan-safe: no. */
int st_label_find(struct names *names, const struct st_labels *labels, const struct st_item *item);
/** st_is_choice - does a label of CASE begin at the lexer: a list of constants and a colon?
 * Scan-safe: yes. */
bool st_is_choice(struct lex lex);
#endif
