/* SPDX-License-Identifier: MIT
 *
 * symbols_text - a declaration as a line of text, and whether it reads where it is to
 * stand. It changes no document.
 */
#ifndef EDITOR_SYMBOLS_TEXT_H
#define EDITOR_SYMBOLS_TEXT_H

#include "editor-gtk/document/symbols.h"

/** symbol_text_comment - as it can stand behind a declaration: one line, single blanks, no
 * sign in it that begins or ends a comment. Owns: the caller. */
char *symbol_text_comment(const char *text);
/** symbol_text_line - "  Name AT %IX0.0 : BOOL := 1; (* … *)\n". Owns: the caller. */
char *symbol_text_line(const char *const text[SYMBOL_FIELDS]);
/** symbol_text_block - "VAR RETAIN\n" of enum var_flag. Owns: the caller. */
char *symbol_text_block(uint16_t flags);
/** symbol_text_reason - the first error, translated. Owns: the caller. */
char *symbol_text_reason(const struct diag_list *diags);
/**
 * symbol_text_reads - is @line one declaration of this name and nothing else, in a block of
 *                     these flags of this table (as in struct xref_target)?
 * @why: gets a translated reason, which the caller frees; may be NULL
 */
bool symbol_text_reads(const struct project *project, int table, uint16_t flags,
		       const char *line, const char *name, char **why);

#endif
