/* SPDX-License-Identifier: MIT
 *
 * pou_convert - a POU in another language, which does the same in each scan.
 *
 * The engine converts. pou_convert.c has one row for each language that it can write; what it refuses
 * is given back with its places.
 */
#ifndef EDITOR_POU_CONVERT_H
#define EDITOR_POU_CONVERT_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/kit/verbs.h"

/**
 * pou_converted - the canonical text of the project with POU @pou in language @to
 * @why: gets the reasons of a refusal, whose places are those of @document
 *
 * A chart may become several POUs with other names. Owns: the caller, free(). Fails: NULL, and at
 * least one error in @why.
 */
char *pou_converted(LadderDocument *document, int pou, enum pou_language to, struct diag_list *why);
/** pou_can_become - is there a conversion of the language of POU @pou to @to, and is the POU not of another file? */
bool pou_can_become(const struct project *project, int pou, enum pou_language to);
/** pou_convert_verb - the verb that shows a POU in language @to, or @converts it; VERB_COUNT: nothing becomes @to. */
enum verb pou_convert_verb(enum pou_language to, bool converts);
/** pou_is_made - does POU @i of @after, a project with POU @name of @before converted, come from it? */
bool pou_is_made(const struct project *before, const char *name, const struct project *after, int i);
/** pou_convert - replaces the POU by that, in one step of the history. Fails: false and @why, as
 * pou_converted(); nothing is changed. */
bool pou_convert(LadderDocument *document, int pou, enum pou_language to, struct diag_list *why);

#endif
