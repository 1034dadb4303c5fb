/* SPDX-License-Identifier: MIT
 *
 * fbd_net - the lines of a network of a function block diagram as trees, and as lines again.
 *
 * A line that is not changed is written as it was read; a changed one in canonical form, with the comments
 * that stood in it behind it. It judges nothing: a line that it cannot read is kept as it is.
 */
#ifndef EDITOR_FBD_NET_H
#define EDITOR_FBD_NET_H

#include "engine/model/project.h"

#include <stddef.h>

enum fbd_node_kind {
	FBD_NODE_OPERAND,   /* a variable, a constant, anything in place               */
	FBD_NODE_INFIX,     /* an operator with its operands                           */
	FBD_NODE_CALL,      /* name( … ): a function, or an instance                   */
};

struct fbd_node;

struct fbd_arg {
	const char *pin;          /* NULL: by its place                         */
	bool output;              /* pin => variable                            */
	bool negated;             /* NOT pin => variable                        */
	struct fbd_node *value;   /* NULL: open                                 */
};

struct fbd_node {
	enum fbd_node_kind kind;
	const char *text;         /* the operand, the operator, what is called  */
	struct fbd_arg *arg;
	int count;
};

enum fbd_line_kind {
	FBD_LINE_NOTE,   /* a comment                                           */
	FBD_LINE_ASSIGN, /* target := value                                     */
	FBD_LINE_SET,    /* target S= value                                     */
	FBD_LINE_RESET,  /* target R= value                                     */
	FBD_LINE_CALL,   /* Delay( … )                                          */
	FBD_LINE_JUMP,   /* JMP target IF value                                 */
	FBD_LINE_RETURN, /* RETURN IF value                                     */
	FBD_LINE_STOP,   /* STOP IF value                                       */
	FBD_LINE_OTHER,  /* not readable                                        */
};

struct fbd_line {
	enum fbd_line_kind kind;
	const char *target;       /* of a jump its label; NULL: none            */
	struct fbd_node *value;   /* NULL: none                                 */
	const char *text;         /* as read; of a new line NULL                */
	const char *notes;        /* comments inside and behind it; "": none    */
	int column, row;          /* the hint, from 1; 0: none                  */
	bool changed;
	bool gap;                 /* an empty line stands above it              */
};

struct fbd_net {
	struct arena arena;
	struct fbd_line **line;   /* they stay where they are when others come     */
	int count;
};

void fbd_net_init(struct fbd_net *net);
void fbd_net_free(struct fbd_net *net);
/** fbd_net_read - appends the lines of a text: those below the heading of a network. Fails: false: no memory. */
bool fbd_net_read(struct fbd_net *net, const char *text, size_t len);
/** fbd_net_write - all lines, two blanks before each. Owns: the caller, free(). NULL: no memory. */
char *fbd_net_write(const struct fbd_net *net);
/** fbd_net_insert - an empty line of this kind before line @at, @at up to count. NULL: no memory. */
struct fbd_line *fbd_net_insert(struct fbd_net *net, int at, enum fbd_line_kind kind);
void fbd_net_remove(struct fbd_net *net, int at);
/** fbd_net_value - reads a value, `NOT Stop AND Level > 3`. NULL: it is none, or has something behind it. */
struct fbd_node *fbd_net_value(struct fbd_net *net, const char *text, size_t len);
struct fbd_node *fbd_node_new(struct fbd_net *net, enum fbd_node_kind kind, const char *text);
/** fbd_node_push - a further argument at its end. NULL: no memory. */
struct fbd_arg *fbd_node_push(struct fbd_net *net, struct fbd_node *node, const char *pin,
			      struct fbd_node *value);
void fbd_node_drop(struct fbd_node *node, int arg);
/** fbd_node_text - as it is written. Lives as long as the net; NULL: no memory. */
const char *fbd_node_text(struct fbd_net *net, const struct fbd_node *node);
/** fbd_operator_word - AND of `AND` and `&`, ADD of `+`: the function that an operator is. NULL: none. */
const char *fbd_operator_word(const char *sign);
/** fbd_word_operator - the sign for a function, `+` of ADD; NULL: none. */
const char *fbd_word_operator(const char *word);

#endif
