/* SPDX-License-Identifier: MIT
 *
 * properties - title and properties of a project, comment of a program or block, and what
 * can be said about it.
 *
 * Each edit is one step of the history. Names are changed by rename.h.
 */
#ifndef EDITOR_PROPERTIES_H
#define EDITOR_PROPERTIES_H

#include "editor-gtk/document/document.h"

/** property_label - "Author", translated. Static. */
const char *property_label(enum property property);
/**
 * properties_set - replaces title and properties
 * @title, @property: plain texts, which may have several lines; "": none
 *
 * Comments stay. Returns NULL, or why it failed, translated, which the caller frees.
 */
char *properties_set(LadderDocument *document, const char *title,
		     const char *const property[PROPERTY_COUNT]);

/** pou_comment - the comments above a POU, without delimiters. Owns: the caller. */
char *pou_comment(LadderDocument *document, int pou);
/** pou_set_comment - replaces them by one comment; "": none. The same text changes nothing.
 * Returns as properties_set(). */
char *pou_set_comment(LadderDocument *document, int pou, const char *text);

/* The facts in the properties of a POU: kind, language, length and so on. */
enum pou_fact { POU_FACT_KIND, POU_FACT_LANGUAGE, POU_FACT_LENGTH, POU_FACT_CALLED,
		POU_FACT_RUNS, POU_FACT_SIZE, POU_FACTS };
/** pou_fact_label - "Kind". Static. */
const char *pou_fact_label(enum pou_fact fact);
/** pou_fact - its value for POU @pou. Owns: the caller. NULL: this POU has none. */
char *pou_fact(LadderDocument *document, int pou, enum pou_fact fact);

#endif
