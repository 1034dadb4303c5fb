/* SPDX-License-Identifier: MIT
 *
 * reader - shared by the files that read a rung file: cursor, place for diagnostics,
 * destination of comments.
 *
 * Only text/read_*.c include it. A reader lives on the heap while one file is read; the
 * project keeps no pointer into the source.
 */
#ifndef TEXT_READER_H
#define TEXT_READER_H

#include "engine/base/diag.h"
#include "engine/base/lex.h"
#include "engine/model/expr_args.h"
#include "engine/model/init.h"
#include "engine/model/project.h"
#include "engine/model/st.h"
#include "engine/text/text.h"
#include "engine/text/writer.h"

#define PRAGMAS_MOST 16 /* kinds of pragmas that a file warns of */

/* Text that grows. It remembers a `//` comment at its end, which becomes (* … *) if more text
 * follows on the line. */
struct buffer {
	char *text;
	size_t len, size;
	const char *slash;  /* the last comment, if it was one of //          */
	size_t slash_len, slash_at;
};

/* Where the reader keeps a comment that it passes. */
enum comment_place {
	COMMENT_ABOVE, /* the next part, rung or end: one a line              */
	COMMENT_NOTE,  /* a declaration: behind it, on one line               */
	COMMENT_CELL,  /* a cell: as above, without any newline               */
	COMMENT_IL,    /* a line of the list of its own                       */
};

struct read_arg {
	size_t pin_at, pin_len, value_at, value_len; /* in reader.text        */
	bool output;
	int line, column;           /* of the value                           */
};

struct reader {
	struct lex lex;
	struct project *project;
	struct diag_list *diags;
	const struct text_source *source;
	const struct reader *outer; /* the file that includes this one        */
	size_t *total;              /* bytes read, included files too         */
	struct diag place;          /* file, POU, rung, row and column so far */
	enum comment_place comments;
	const char *begin; /* of the text                              */
	int begun;         /* line of the declaration being read       */
	int mended;        /* line that was reported with its mended text */
	bool closed;       /* the mended line is an END_…                 */
	bool plain;        /* no rung file: IEC text, in which a line has no meaning
			      outside of instruction lists                 */
	uint16_t number;   /* of the file in project.source                */
	uint32_t pragma[PRAGMAS_MOST]; /* string ids: kinds that were reported */
	int pragmas;
	bool boxed;        /* reading the statements of an EXECUTE box     */
	bool lost;         /* rows follow whose RUNG or PROGRAM is missing */
	bool across_lines;          /* reader_step passes ends of lines       */
	bool no_memory;
	struct buffer above, note, rung_note, text;
	struct read_arg arg[LIMIT_ARGS];
	int arg_count;
	struct il *il;              /* of the POU, for COMMENT_IL             */
	const struct pou *pou;      /* the current POU; NULL: none            */
	uint32_t actions_of;        /* string id: whose the actions are, by ACTIONS Name; 0: of
	                               the POU above                          */
	uint16_t var_flags;          /* of the current VAR block               */
	bool paths;                 /* reading VAR_CONFIG: names are paths    */
	int spaces;                 /* NAMESPACEs around the cursor           */
	struct diag space;          /* place of the last one                  */
	bool members;               /* reading the members of a structure     */
	int inner;                  /* structures without a name that are open */
	bool library;               /* the file was named by USES             */
	bool keep_pins;             /* pins are the project's own: as written */
	struct cell *cell;          /* of the rung being read, row by row     */
	int cell_count, cell_size;
	size_t all_cells;           /* of the file                            */
	uint8_t row_cols[LIMIT_ROWS];
	int rows;
	struct expr expr;
	struct init_walk walk;      /* of the list of an array                */
};

/** reader_new - before the first token; NULL: no memory. Owns: the caller. */
struct reader *reader_new(struct project *project, const char *file,
			  struct diag_list *diags);
void reader_free(struct reader *r);

/**
 * reader_open - puts the cursor on the first token of @text
 *
 * Returns the copy it had to make of a text with CR LF or bad bytes (LD104 and
 * LD105), which the caller frees after reading; NULL: @text itself is read.
 */
char *reader_open(struct reader *r, const char *text, size_t len);

/** reader_fail_bad - reports the invalid token at the cursor. */
void reader_fail_bad(struct reader *r);
/** reader_scan - the next token, whatever it is. True: a comment or a pragma. */
bool reader_scan(struct reader *r);
/** reader_next - the next token that is no comment. */
void reader_next(struct reader *r);
/** reader_step - the same, past ends of lines where they have no meaning. */
void reader_step(struct reader *r);
bool reader_is(const struct reader *r, char symbol);
/** reader_peek - does @symbol follow the token under the cursor? */
bool reader_peek(const struct reader *r, const char *symbol);
/** reader_at_end - at the end of the line or of the file? */
bool reader_at_end(const struct reader *r);
void reader_skip_line(struct reader *r);
void reader_skip_newlines(struct reader *r);
/** reader_end_head - the same behind a heading or an END_…; plain IEC text may go on in this line. */
void reader_end_head(struct reader *r);
/** reader_end_line - reports anything before the end of the line. */
void reader_end_line(struct reader *r);

/** reader_fail - a diagnostic at the cursor. Returns false. */
bool reader_fail(struct reader *r, enum diag_id id, const char *arg,
		 size_t len);
/** reader_fail_word - the same with a NUL-ended argument. */
bool reader_fail_word(struct reader *r, enum diag_id id, const char *arg);
/** reader_fail_many - the same: more of @what than @most. */
bool reader_fail_many(struct reader *r, enum diag_id id, const char *what, long most);
/** reader_fail_range - the same: no type holds the constant @text; of a text, the longest type is named. */
bool reader_fail_range(struct reader *r, const char *text, size_t len);
/** reader_fail_token - the same about the token under the cursor. */
bool reader_fail_token(struct reader *r, enum diag_id id);

/** reader_mend - reports the line of an error of form as it should be written. False: nobody
 * can mend it, or its message needs no such line. */
bool reader_mend(struct reader *r, enum diag_id id);
/** reader_special - tells that S:Z, at its colon @token, is set by other controllers alone. False: it is no such
 * name, or one that has a word here. */
bool reader_special(struct reader *r, const struct token *token);
/** reader_mend_last - the same in place of the last message, if that is about an expression.
 * False always. */
bool reader_mend_last(struct reader *r);
/** reader_fail_open - the block that began at @head is not closed. */
void reader_fail_open(struct reader *r, const struct token *head);

void buffer_add(struct reader *r, struct buffer *b, const char *text,
		size_t len);
void buffer_clear(struct buffer *b);
/** buffer_take - string id of the text; the buffer is empty afterwards. */
uint32_t buffer_take(struct reader *r, struct buffer *b);
/** buffer_take_cell - the same for comments of a cell: none of them is a //. */
uint32_t buffer_take_cell(struct reader *r, struct buffer *b);
/** comment_join - string id of the comments of @id followed by those of @b, as @place has
 * them: COMMENT_ABOVE one a line, COMMENT_NOTE on one line. */
uint32_t comment_join(struct reader *r, uint32_t id, struct buffer *b,
		      enum comment_place place);
uint32_t reader_intern(struct reader *r, const char *text, size_t len);

/* These functions check the token under the cursor and stay on it, because stepping would take
 * a comment that follows. */
/** reader_name - a plain name. Fails: false and a diagnostic. */
bool reader_name(struct reader *r, const char *wanted, uint32_t *id);
/** reader_take_space - adds NAMESPACE Name, END_NAMESPACE or USING Name, Other; at the cursor to @line. False
 * after a diagnostic. Scan-safe: no. */
bool reader_take_space(struct reader *r, struct buffer *line);
/** reader_instance - the name of an instance, or of one of an array: `Motor[i, 3]`; it
 * leaves the cursor on its last token, and clears r->text. */
bool reader_instance(struct reader *r, uint32_t *id);
/** reader_string - the text inside a string, escapes resolved. */
bool reader_string(struct reader *r, uint32_t *id);
/** reader_value - appends a name, an address (both perhaps with an index) or (if
 * @constant) a constant to r->text, and leaves the cursor on its last token. @word needs it. */
bool reader_value(struct reader *r, bool constant, const struct token *word);
/** reader_fail_operand - @word lacks its operand: the cell ends, or something else stands there. */
bool reader_fail_operand(struct reader *r, const struct token *word);
/** reader_pin - the name of a pin, in upper case. */
bool reader_pin(struct reader *r, uint32_t *id);
/** reader_arg - appends `PIN:=value` to r->text and to r->arg, likewise. */
bool reader_arg(struct reader *r);

/** reader_skip_objects - steps over a METHOD, PROPERTY, CLASS or INTERFACE at the cursor, with a
 * message. False: there is none. */
bool reader_skip_objects(struct reader *r);
/** reader_sign - appends a sign under the cursor and steps past it; true if there is one. */
bool reader_sign(struct reader *r);
/** reader_written - the record of a declaration with constant expressions; one of them, at
 * @where in it, is at the cursor. Owns: the project's arena. Fails: NULL: no memory. */
struct var_written *reader_written(struct reader *r, struct var *var, enum written_place where);
/**
 * reader_begins_expression - does a constant expression stand here, not a constant alone?
 * @type: the type of the value; ON and OFF are mistakes for a BOOL, unless they are declared
 */
bool reader_begins_expression(const struct reader *r, enum iec_type type);
/**
 * reader_expression - appends a constant expression to r->text, with single blanks, and steps
 * behind it
 * @var: of the declaration; @where: the place of the expression in it, for diagnostics
 */
bool reader_expression(struct reader *r, struct var *var, enum written_place where);
/** reader_expression_text - the same without a record of it. */
bool reader_expression_text(struct reader *r);
/** read_constant - appends a constant of @type to r->text and steps behind it. */
bool read_constant(struct reader *r, enum iec_type type, union iec_value *out);
/** read_array - `ARRAY[low..high] OF`, if it stands here. Clears r->text. */
bool read_array(struct reader *r, struct var *var);
/** read_init_list - `[1, 2, 3(7)]`, the initial values of an array. */
bool read_init_list(struct reader *r, struct var *var);
/** reader_init_text - the initial values in the brackets at the cursor, or without brackets up to
 * the ;, as text. */
bool reader_init_text(struct reader *r, struct var *var);
/** read_init_parts - `(Speed := 5)`, `[(a := 1), 2(a := 3)]`, initial values of structures and
 * instances. It only counts brackets; model/init.h checks the rest. */
bool read_init_parts(struct reader *r, struct var *var);
/** reader_type - `: type` of a declaration or function; steps behind it. */
bool reader_type(struct reader *r, struct var *var);
/** reader_type_of - the same without the colon; @name: of the type that is declared so, or 0. */
bool reader_type_of(struct reader *r, struct var *var, uint32_t name);
/** reader_own_type - the enumeration or subrange at the cursor, if one stands here: `(Red, Green)`,
 * behind an integer type `(0..100)`. @var has that type; @name: as above. */
bool reader_own_type(struct reader *r, struct var *var, uint32_t name);
/** reader_init - `:= value` behind a type, if it stands here. */
bool reader_init(struct reader *r, struct var *var);
/** reader_dots - `..`; steps behind it. */
bool reader_dots(struct reader *r);
/** reader_add_named - a new type of this name, whose declaration follows. Fails: NULL. */
struct named_type *reader_add_named(struct reader *r, uint32_t name);
/** reader_unescape - string id of a string token; errors go to @diags. */
bool reader_unescape(struct reader *r, const struct token *token,
		     struct diag_list *diags, uint32_t *id);
/** reader_path - @name as seen from the folder of @from; NULL: no memory. */
const char *reader_path(struct reader *r, const char *from, const char *name);
/** reader_view_end - behind the line whose first word is END_VIEW; NULL: none. */
const char *reader_view_end(struct lex *lex);
/** reader_take_word - the row that read_words() made, unless another part of the file has this
 * name; that of @owner from now on. */
enum word reader_take_word(struct reader *r, uint32_t name, enum word_kind kind, int owner);
/** reader_own_word - a new row of the project's words; WORD_COUNT: an error. */
enum word reader_own_word(struct reader *r, uint32_t name, enum word_kind kind);
void reader_add_part(struct reader *r, struct part part);
/** reader_is_vars - does a VAR block begin here, of any kind? */
bool reader_is_vars(const struct reader *r);
/** reader_skip_odd_line - reports a line that does not belong here, and skips it. */
void reader_skip_odd_line(struct reader *r);

/* The next functions are each in a file of its own. */
/** read_words - the names of functions, blocks and structures of a whole file. */
void read_words(struct reader *r, const char *text, size_t len);
/** read_pou_kind - does a POU begin here? */
bool read_pou_kind(const struct reader *r, enum pou_kind *kind);
void read_pou(struct reader *r, enum pou_kind kind);
void read_types(struct reader *r);
/** reader_ends_struct - END_STRUCT or END_UNION? */
bool reader_ends_struct(const struct reader *r);
/** reader_inner_struct - STRUCT … END_STRUCT as the type of a variable, or UNION … END_UNION; the cursor stands on its word. */
bool reader_inner_struct(struct reader *r, struct var *var);
/** read_members - declarations of a structure, up to END_STRUCT. */
void read_members(struct reader *r, struct var_table *table);
void read_vars(struct reader *r, struct var_table *table, bool global);
/** read_access - VAR_ACCESS … END_VAR; its number in the project, or -1: no memory. */
int read_access(struct reader *r);
/** read_located - VAR_CONFIG … END_VAR; the index of its block. */
int read_located(struct reader *r);
/** reader_misplaced_access - reports one that does not belong here, and drops it. */
void reader_misplaced_access(struct reader *r);
/** reader_close_vars - END_VAR of the block that began at @head. */
void reader_close_vars(struct reader *r, const struct token *head);
/** reader_skip_declaration - skips to the next declaration, which may be on this line. */
void reader_skip_declaration(struct reader *r);
/** read_var - one declaration for a block with these flags, and its comment. */
bool read_var(struct reader *r, uint16_t flags, struct var *out);
/** read_rung - RUNG, its rows, and the statements of its EXECUTE boxes, which @pou gets; their
 * number of the rung is still -1. */
struct rung *read_rung(struct reader *r, struct pou *pou);
/** reader_add_rung - the same as the last rung of a POU. */
void reader_add_rung(struct reader *r, struct pou *pou);
void read_il(struct reader *r, struct pou *pou);
/** read_st - Structured Text up to the end of the POU; the cursor is on its first token, comments
 * and newlines too. */
void read_st(struct reader *r, struct pou *pou);
/** read_fbd - networks up to the end of the POU. */
void read_fbd(struct reader *r, struct pou *pou);
/** read_st_behind - the same up to the end of an action or of the statements of a box; the cursor is
 * on the token before it. */
void read_st_behind(struct reader *r, struct pou *pou);
/** read_sfc - the items of a chart, up to END_PROGRAM; pou->sfc is there. */
void read_sfc(struct reader *r, struct pou *pou);
/** reader_chart_word - the word of a chart at the cursor; NULL: it is none. */
const struct sfc_word *reader_chart_word(const struct lex *lex);
/** reader_is_sfc_word - does this word begin or end an item of a chart? */
bool reader_is_sfc_word(const struct lex *lex);
/** reader_property - the property of a project that the word at the cursor names; PROPERTY_COUNT: none. */
enum property reader_property(const struct reader *r);
void read_config(struct reader *r, struct config *config);
/** read_ends_block - does a line begin here that cannot stand inside VAR or an instruction
 * list? A name or label of the same spelling can. */
bool read_ends_block(const struct reader *r);
/** read_begins_action - does `ACTION Name` begin here, an action of a POU that is no chart? */
bool read_begins_action(const struct reader *r);
#endif
