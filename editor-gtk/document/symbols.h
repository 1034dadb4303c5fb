/* SPDX-License-Identifier: MIT
 *
 * symbols - all declarations of a document as rows, and edits of their fields.
 *
 * Each edit changes the document's text as one step of its history. It is refused, with the
 * reason, if the declaration could not be read again. It shows nothing.
 */
#ifndef EDITOR_SYMBOLS_H
#define EDITOR_SYMBOLS_H

#include "editor-gtk/document/document.h"

enum field {
	FIELD_NAME, FIELD_TYPE, FIELD_ADDRESS, FIELD_INITIAL, FIELD_RETAIN,
	FIELD_CONSTANT, FIELD_COMMENT,
	SYMBOL_FIELDS
};

/* What operators and gateways may do with a symbol: VAR_ACCESS. */
enum symbol_access { SYMBOL_KEPT, SYMBOL_READ, SYMBOL_WRITE };

struct symbol_row {
	int table, index;    /* as in struct xref_target                      */
	char *scope;         /* POU or structure; "": the globals             */
	char *text[SYMBOL_FIELDS]; /* RETAIN and CONSTANT: "1" or ""; a comment has no
				      delimiters */
	uint16_t flags;       /* enum var_flag of its block                    */
	int uses;            /* places but the declaration                    */
	bool included;       /* declared in another file: read-only           */
	bool member;         /* member of a structure: no address, no RETAIN  */
	bool exports;        /* a value that VAR_ACCESS may have a line for    */
	enum symbol_access access;
	int line;            /* of VAR_ACCESS for the whole symbol, in project.access; -1:
				none                                          */
	bool foreign;        /* that line stands in another file              */
};

struct symbols {
	struct symbol_row *symbol;
	int count;
};

/** symbols_new - of the document as it is; empty for a document of text. Owns: the caller. */
struct symbols *symbols_new(LadderDocument *document);
void symbols_free(struct symbols *symbols);

/** symbol_row_new - variable @index of a table alone, without counting its uses. Owns: the
 * caller. */
struct symbol_row *symbol_row_new(const struct project *project,
				  const struct var_table *vars, int table, int index);
void symbol_row_free(struct symbol_row *symbol);

/** symbol_initial - the initial value as text; "": none. Owns: the caller. */
char *symbol_initial(const struct project *project, const struct var *var);
/** symbol_field_name - "Address", translated. Lives for ever. */
const char *symbol_field_name(enum field field);

/**
 * symbol_set - changes one field
 * @text: of RETAIN and CONSTANT "" is no, all else yes
 * @why:  gets a translated reason, which the caller frees; may be NULL
 *
 * A name is changed wherever it is used. One step of the history.
 * Fails: false, nothing changed.
 */
bool symbol_set(LadderDocument *document, int table, int index, enum field field,
		const char *text, char **why);
/** SYMBOL_KINDS - the flags for the kind of block that a symbol is declared in; none: VAR. */
#define SYMBOL_KINDS (VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT | VAR_TEMP)
/** symbol_block - the number of the block of variable @index; -1: none. */
int symbol_block(const struct var_table *vars, int index);
/** symbol_set_kind - moves it to the block with this one of SYMBOL_KINDS, or 0; it stays
 * RETAIN or CONSTANT. One step of the history. Fails: false, nothing changed. */
bool symbol_set_kind(LadderDocument *document, int table, int index, uint16_t kind,
		     char **why);
/** symbol_set_access - adds, changes or deletes its line of VAR_ACCESS. A new line has the name of
 * the symbol, or a free one like it. One step of the history. Fails: false, nothing changed. */
bool symbol_set_access(LadderDocument *document, int table, int index,
		       enum symbol_access access, char **why);
/**
 * symbol_set_access_text - the same, and its name for operators, as a person types both
 * @text: "READ_WRITE: Oven"; "READ_ONLY" gives it its own name, "Oven" leaves what operators may
 *        do, or lets them read; "" deletes the line
 *
 * Fails: false, nothing changed: such as a name that another line or variable has.
 */
bool symbol_set_access_text(LadderDocument *document, int table, int index, const char *text,
			    char **why);
/** symbol_access_text - such a text of a symbol as it would be with @access; without a name if
 * that is its own. Owns: the caller. */
char *symbol_access_text(LadderDocument *document, const struct symbol_row *symbol,
			 enum symbol_access access);
/** symbol_add - adds a declaration behind those of its kind.
 * @flags: of its block, apart from RETAIN and CONSTANT, which @text has: 0: VAR */
bool symbol_add(LadderDocument *document, int table, uint16_t flags,
		const char *const text[SYMBOL_FIELDS], char **why);
/** symbol_delete - deletes it, used or not. */
bool symbol_delete(LadderDocument *document, int table, int index, char **why);
/** symbol_table_name - the name of the POU or structure whose table of xref/xref.h this is; "": the
 * globals. The number is another one after a POU was added before it. Owns: the caller. */
char *symbol_table_name(LadderDocument *document, int table);
/** symbol_table_find - the table of that name; -1: there is none. */
int symbol_table_find(LadderDocument *document, const char *name);
/** symbol_find - the index of a declaration of a table of xref/xref.h; -1: none. @index: where it was
 * last; rows of a list are older than the document after an edit. -1: unknown. */
int symbol_find(LadderDocument *document, int table, const char *name, int index);
/** symbol_free_name - a name made of @like that no declaration of the table has: Start2.
 * Owns: the caller. */
char *symbol_free_name(LadderDocument *document, int table, const char *like);
/** symbol_beside - the first other variable at the same address; NULL: none. Borrowed until
 * the document changes. */
const char *symbol_beside(LadderDocument *document, int table, int index);
/** symbol_error - the error of the last check in a declaration; NULL: none. @warning: gets
 * whether it is only a warning. Owns: the caller. */
char *symbol_error(LadderDocument *document, const struct symbol_row *symbol,
		   bool *warning);

/* ---- a declaration as text ---- */

/** symbol_text_line - "  Name AT %IX0.0 : BOOL := 1; (* … *)\n". Owns: the caller. */
char *symbol_text_line(const char *const text[SYMBOL_FIELDS]);
/** symbol_text_block - "VAR RETAIN\n" of enum var_flag. Owns: the caller. */
char *symbol_text_block(uint16_t flags);

/* ---- several changes as one ---- */

struct symbol_batch;

/** symbol_batch_new - of the document as it is, which must not change meanwhile. */
struct symbol_batch *symbol_batch_new(LadderDocument *document);
void symbol_batch_free(struct symbol_batch *batch);
/** symbol_batch_put - replaces declaration @index of a table by @text; -1: adds one. Uses of
 * a changed name stay.
 * @flags: of its block, as in symbol_add; another kind moves it. Fails: false, and why. */
bool symbol_batch_put(struct symbol_batch *batch, int table, int index, uint16_t flags,
		      const char *const text[SYMBOL_FIELDS], char **why);
/** symbol_batch_try - the changed program, checked, in memory; the document stays as it is.
 * Owns: the caller, ladder_free(). Fails: NULL, and why: it cannot be read. */
struct ladder *symbol_batch_try(struct symbol_batch *batch, char **why);
/** symbol_batch_apply - applies the batch as one step. Fails: false, and why; nothing
 * changed. */
bool symbol_batch_apply(struct symbol_batch *batch, const char *step, char **why);

#endif
