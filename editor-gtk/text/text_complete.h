/* SPDX-License-Identifier: MIT
 *
 * text_complete - syntax colours of IL, ST and rung files, and completion.
 *
 * The words come from the catalogue (packaging/rung_language.c), the candidates from the
 * engine.
 */
#ifndef EDITOR_TEXT_COMPLETE_H
#define EDITOR_TEXT_COMPLETE_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/document/text_range.h"

#include <gtksourceview/gtksource.h>

/** text_language - the language of rung files; NULL: not installed. Borrowed. */
GtkSourceLanguage *text_language(void);
/** text_is_st - is the text of the POU Structured Text, or a chart that has some? */
bool text_is_st(const struct pou *pou);
/** text_language_st - that of Structured Text, or of rung files. Borrowed. */
GtkSourceLanguage *text_language_st(bool st);
/** text_language_of - of the text of POU @pou of @document, -1: of the whole file: that of rung
 * files, or that of Structured Text. Borrowed. */
GtkSourceLanguage *text_language_of(LadderDocument *document, int pou);
/** text_complete_attach - offers words while one types in @view
 * @pou: whose number of a POU of @document the text is, -1: all of it
 * @part: which lines of it
 * Both are read each time, for as long as @view lives. */
void text_complete_attach(GtkSourceView *view, LadderDocument *document, const int *pou,
			  const struct text_range *part);

/** text_complete_words - what could stand there, as GtkSourceCompletionProposals
 * @text: of the POU, or of the file; @line: 0-based; @column: bytes before the cursor
 * @prefix_len: gets how many of these are of the word. Owns: the caller. */
GListStore *text_complete_words(LadderDocument *document, int pou, const char *text,
				int line, int column, gsize *prefix_len);

/** text_complete_call - the call of Structured Text around the cursor, as markup, the argument that
 * is written bold; otherwise as text_complete_words(). NULL: none. Caller frees. */
char *text_complete_call(LadderDocument *document, int pou, const char *text, int line,
			 int column);

#endif
