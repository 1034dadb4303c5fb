/* SPDX-License-Identifier: MIT
 *
 * text_range - a part of the text of a POU that has a sheet of its own: the lines between EXECUTE and
 * END_EXECUTE of a box, or between ACTION and END_ACTION.
 *
 * It finds its lines again when the text around them changes. No GTK.
 */
#ifndef EDITOR_TEXT_RANGE_H
#define EDITOR_TEXT_RANGE_H

#include <glib.h>
#include <stdbool.h>

enum range_kind {
	RANGE_WHOLE,    /* no part: the text of the POU                           */
	RANGE_BOX,      /* of an EXECUTE box                                      */
	RANGE_ACTION,
};

struct text_range {
	enum range_kind kind;
	char *name;    /* of the box or the action; "": it has none              */
	int number;    /* among the parts of this kind, from 0                   */
	int count;     /* how many of this kind there are                        */
	char *before, *after; /* the text around it; whole lines                 */
	int lines;     /* of @before                                             */
};

/** text_range_init - the whole text. Owns: text_range_clear(). */
void text_range_init(struct text_range *part);
void text_range_clear(struct text_range *part);
/**
 * text_range_take - becomes the innermost part of @text that line @line is in
 * @line: from 0; the line of EXECUTE or ACTION and that of its end belong to it
 *
 * Fails: false: there is none; @part stays as it is.
 */
bool text_range_take(struct text_range *part, const char *text, int line);
/**
 * text_range_find - the lines of the part in another text of its POU: those between the same text, else
 * those of the same name or of the same text as @shown, else those with the same number if there are
 * as many parts as before
 *
 * Returns its text, without the end of its last line. Owns: the caller, g_free(). Fails: NULL: the part has gone; @part stays as it is.
 */
char *text_range_find(struct text_range *part, const char *text, const char *shown);
/** text_range_heading - the line of the first word of a text, from 0, behind comments. */
int text_range_heading(const char *text);
/** text_range_whole - the text of the POU if the part is @shown. Owns: the caller, g_free(). */
char *text_range_whole(const struct text_range *part, const char *shown);

#endif
