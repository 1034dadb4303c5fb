/* SPDX-License-Identifier: MIT
 *
 * spelled - the spelling of addresses (kit/spelling.h) for the texts of a document, whose names have
 * priority. It reads no file.
 */
#ifndef EDITOR_SPELLED_H
#define EDITOR_SPELLED_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/kit/spelling.h"

/** spelled_rule - for a document, which must outlive it. */
struct spelling_rule spelled_rule(LadderDocument *document, enum spelling spelling);
/** spelled_shown - a text as the preferences ask for. Owns: the caller, g_free(). */
char *spelled_shown(LadderDocument *document, const char *text);
/** spelled_canonical - a line that a person has typed, as files have it. Owns: the caller, g_free(). */
char *spelled_canonical(LadderDocument *document, const char *line);

#endif
