/* SPDX-License-Identifier: MIT
 *
 * expr - infix expressions with the operators and precedence of IEC 61131-3 table 55,
 * as a tree.
 *
 * Used by [ … ] cells and by scenarios. It parses and prints; types and functions are
 * resolved later: `LIMIT(0, x + 1, 10)`, `F(A := 1)`. Precedence, strongest first: ( ),
 * - NOT, **, * / MOD, + -, < > <= >=, = <>, AND & AND_THEN, XOR, OR OR_ELSE. All binary operators bind
 * to the left.
 */
#ifndef MODEL_EXPR_H
#define MODEL_EXPR_H

#include "engine/base/catalog.h"
#include "engine/base/diag.h"
#include "engine/base/lex.h"

enum expr_op {
	EXPR_NAME,      /* text: a name, a pin, a direct address, an element
			   with a simple index: Table[ i ].X (may hold blanks) */
	EXPR_INDEX,     /* text: an array, or right: an element that leads to
			   one; left: its index, an expression; tail: the
			   path from there to a member or another array       */
	EXPR_BIT,       /* left: a place; tail: its bit 3, %X3, or part %B1   */
	EXPR_LITERAL,   /* text: a constant                                   */
	EXPR_NEG, EXPR_NOT,
	EXPR_FN,        /* fn: ADD SUB MUL DIV MOD EXPT GT GE EQ LE LT NE     */
	EXPR_AND, EXPR_XOR, EXPR_OR,
	EXPR_CALL,      /* text: a function; left: its last argument, or -1   */
	EXPR_ARG,       /* left: its value; right: the one before it, or -1;
			   text: its pin, if it is named: MN := 0, ENO => ok  */
};

/* The path behind an index that is an expression: `.Speed`; len 0: none. */
struct expr_tail {
	const char *text;      /* borrowed from the source                    */
	uint16_t len;
};

struct expr_node {
	enum expr_op op;
	enum word fn;          /* of EXPR_FN                                  */
	const char *text;      /* borrowed from the source                    */
	uint16_t len;
	struct expr_tail tail; /* of EXPR_INDEX, EXPR_BIT                     */
	int16_t left, right;   /* nodes; -1: none. Children come before       */
	bool inner;            /* of EXPR_INDEX: the path goes on from here   */
	bool lazy;             /* AND_THEN, OR_ELSE: right is not always computed */
	bool output;           /* of EXPR_ARG: OUT => place                   */
	bool inverted;         /* of such a one: NOT OUT => place             */
	bool written;          /* set by the check: a place that gets a value */
	bool whole;            /* set by the check: it may be an array        */
};

struct expr {
	struct expr_node node[LIMIT_EXPR_NODES];
	int count;
	int root;
	const char *target;    /* of `target := expression`; NULL: none       */
	size_t target_len;
	int target_index;      /* node of the target's index; -1: it has none,
				  or a simple one within `target`             */
	struct expr_tail target_tail; /* behind that index                    */
	struct expr_tail target_bit;  /* of which this part is assigned: 3, %B1 */
	bool target_points;    /* target REF= place: the reference itself     */
	bool target_tried;     /* target ?= reference: NULL if it has another type */
	int target_base;       /* EXPR_INDEX that leads to the array of that
				  index; -1: `target` is the array            */
	struct expr_open { const char *text; uint16_t len; int16_t base; }
		open[LIMIT_EXPR_DEPTH]; /* the parser's: arrays before an open [ */
	struct expr_call { struct expr_tail name, pin; int16_t last; bool output, inverted; }
		call[LIMIT_EXPR_DEPTH]; /* and functions before an open (     */
};

/**
 * expr_parse - parses the expression at the lexer
 * @lex: at its first token; afterwards at the first token behind it
 * @out: caller's memory (about 32 KB: not on a small stack)
 *
 * Owns: nothing; texts are borrowed from the source. Scan-safe: no.
 * Fails: false and one diagnostic with @place and the column.
 */
bool expr_parse(struct lex *lex, struct expr *out, struct diag_list *diags,
		struct diag place);
/** expr_mark - a number for an operation or call of an expression that no other one within @text has, from the
 * place where it stands: the list that it becomes and its drawing call it so. 0: it has none, or stands too far
 * behind. Scan-safe: yes. */
uint16_t expr_mark(const struct expr *expr, int index, const char *text);
/** expr_first - the first byte of an operand within @text: of its name, constant or sign. Scan-safe: yes. */
const char *expr_first(const struct expr *expr, int index, const char *text);
/** expr_parse_cell - `expression` or `target := expression` at the lexer. */
bool expr_parse_cell(struct lex *lex, struct expr *out, struct diag_list *diags,
		     struct diag place);
/** expr_parse_place - the path at the lexer, `Delay[i + 1]`: an EXPR_NAME or EXPR_INDEX, unless it names a
 * bit. A parenthesis may follow. As expr_parse(). */
bool expr_parse_place(struct lex *lex, struct expr *out, struct diag_list *diags,
		      struct diag place);
/**
 * expr_begins - whether an expression begins at the lexer, not a constant alone: a name, a sign
 * before a parenthesis, a constant with an operator behind it
 *
 * It looks at one or two tokens; the rest may be wrong. Scan-safe: yes.
 */
bool expr_begins(struct lex lex);
/** expr_inverts - does `NOT Q =>` begin at the lexer? Scan-safe: yes. */
bool expr_inverts(const struct lex *lex);
/** expr_skip - steps over an expression, well formed or not, to the first `,` `;` `:` `]`, dot or
 * parenthesis outside of its own; @end gets where it ends. Scan-safe: yes. */
void expr_skip(struct lex *lex, const char **end);
/** expr_array - the bytes of the path before its last index, `Table` of `Table[i]`; @text ends with ].
 * Scan-safe: yes. */
size_t expr_array(const char *text, size_t len);
/** expr_part - which bits an EXPR_BIT names: @number parts of @bits each lie below them.
 * Scan-safe: yes. Fails: false: it is no such part. */
bool expr_part(struct expr_tail tail, unsigned int *bits, unsigned int *number);
/** expr_part_print - the name of part @index of a number of @of bits: `3`, or with @percent `%X3`, for its
 * bits, then `%B1` and the greater ones. Returns bits of the part; 0: there are not so many.
 * Scan-safe: yes. */
unsigned int expr_part_print(unsigned int of, bool percent, int index, char *out, size_t size);
/** expr_parse_text - the same of a whole text. */
bool expr_parse_text(const char *text, size_t len, struct expr *out,
		     struct diag_list *diags, struct diag place);
#endif
