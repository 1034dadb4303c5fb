/* SPDX-License-Identifier: MIT
 *
 * symbols - all declarations of a document as rows, and edits of their fields.
 *
 * Each edit is a change of the document's text, one step of its history, and refused
 * with the reason if the declaration could not be read again. It shows nothing.
 */
#ifndef EDITOR_SYMBOLS_H
#define EDITOR_SYMBOLS_H

#include "editor-gtk/document/document.h"

enum field {
	FIELD_NAME, FIELD_TYPE, FIELD_ADDRESS, FIELD_INITIAL, FIELD_RETAIN,
	FIELD_CONSTANT, FIELD_COMMENT,
	SYMBOL_FIELDS
};

struct symbol_row {
	int table, index;    /* as in struct xref_target                      */
	char *scope;         /* POU or structure; "": the globals             */
	char *text[SYMBOL_FIELDS]; /* of RETAIN and CONSTANT "1" or ""; a comment
				without its delimiters                        */
	uint16_t flags;       /* enum var_flag of its block                    */
	int uses;            /* places but the declaration                    */
	bool included;       /* declared in another file: not to be changed   */
	bool member;         /* of a structure: no address, no RETAIN         */
};

struct symbols {
	struct symbol_row *symbol;
	int count;
};

/** symbols_new - of the document as it is; of one of text none. Owns: the caller. */
struct symbols *symbols_new(LadderDocument *document);
void symbols_free(struct symbols *symbols);
/** symbols_at - by table and index; NULL: none. */
const struct symbol_row *symbols_at(const struct symbols *symbols, int table, int index);

/** symbol_row_new - of variable @index of a table alone, its uses not counted. Owns: the
 * caller. */
struct symbol_row *symbol_row_new(const struct project *project,
				  const struct var_table *vars, int table, int index);
void symbol_row_free(struct symbol_row *symbol);

/** symbol_field_name - "Address", translated. Lives for ever. */
const char *symbol_field_name(enum field field);

/**
 * symbol_set - one field becomes another
 * @text: of RETAIN and CONSTANT "" is no, all else yes
 * @why:  gets a translated reason, which the caller frees; may be NULL
 *
 * A name changes wherever it is used. One step of the history.
 * Fails: false, nothing changed.
 */
bool symbol_set(LadderDocument *document, int table, int index, enum field field,
		const char *text, char **why);
/** SYMBOL_KINDS - the flags that say as what of its block a symbol is declared; none: as
 * its own. */
#define SYMBOL_KINDS (VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT | VAR_TEMP)
/** symbol_set_kind - it moves to the block with this one of SYMBOL_KINDS, or 0, and stays
 * RETAIN or CONSTANT if it is. One step of the history. Fails: false, nothing changed. */
bool symbol_set_kind(LadderDocument *document, int table, int index, uint16_t kind,
		     char **why);
/** symbol_add - another declaration, behind those of its kind.
 * @flags: of its block, apart from RETAIN and CONSTANT, which @text says: 0: VAR */
bool symbol_add(LadderDocument *document, int table, uint16_t flags,
		const char *const text[SYMBOL_FIELDS], char **why);
/** symbol_delete - used or not. */
bool symbol_delete(LadderDocument *document, int table, int index, char **why);
/** symbol_free_name - a name that @like would become, which no declaration of the table
 * has: Start2. Owns: the caller. */
char *symbol_free_name(LadderDocument *document, int table, const char *like);
/** symbol_beside - the first other variable that lies at its address, too; NULL: none.
 * Borrowed until the document changes. */
const char *symbol_beside(LadderDocument *document, int table, int index);
/** symbol_error - what the last check found wrong with a declaration; NULL: nothing.
 * @warning: gets whether it is only that. Owns: the caller. */
char *symbol_error(LadderDocument *document, const struct symbol_row *symbol,
		   bool *warning);

/* ---- a declaration as text ---- */

/** symbol_text_comment - as it can stand behind a declaration: one line, single blanks, no
 * sign in it that begins or ends a comment. Owns: the caller. */
char *symbol_text_comment(const char *text);
/** symbol_text_line - "  Name AT %IX0.0 : BOOL := 1; (* … *)\n". Owns: the caller. */
char *symbol_text_line(const char *const text[SYMBOL_FIELDS]);
/** symbol_text_block - "VAR RETAIN\n" of enum var_flag. Owns: the caller. */
char *symbol_text_block(uint16_t flags);

/* ---- several changes as one ---- */

struct symbol_batch;

/** symbol_batch_new - of the document as it is: it must not change meanwhile. */
struct symbol_batch *symbol_batch_new(LadderDocument *document);
void symbol_batch_free(struct symbol_batch *batch);
/** symbol_batch_put - declaration @index of a table becomes @text; -1: a new one. The
 * name is not followed to where it is used.
 * @flags: of its block, as in symbol_add; another kind moves it. Fails: false, and why. */
bool symbol_batch_put(struct symbol_batch *batch, int table, int index, uint16_t flags,
		      const char *const text[SYMBOL_FIELDS], char **why);
/** symbol_batch_try - the program as it would be, checked, in memory; the document stays
 * as it is. Owns: the caller, ladder_free(). Fails: NULL, and why: it cannot be read. */
struct ladder *symbol_batch_try(struct symbol_batch *batch, char **why);
/** symbol_batch_apply - all of it as one step. Fails: false, and why; nothing changed. */
bool symbol_batch_apply(struct symbol_batch *batch, const char *step, char **why);

/** rename_reason - why something cannot be renamed, translated. Owns: the caller. */
char *rename_reason(LadderDocument *document, const struct ladder_rename *how,
		    const char *name);

#endif
