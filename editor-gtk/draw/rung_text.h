/* SPDX-License-Identifier: MIT
 *
 * rung_text - the texts at an element and above a rung.
 *
 * They are measured and cut to their bounds, so that layout and drawing have the same
 * texts.
 */
#ifndef EDITOR_RUNG_TEXT_H
#define EDITOR_RUNG_TEXT_H

#include "editor-gtk/draw/rung_layout.h"

#define LABEL_BOUND  230   /* px of a name                                      */
#define FRAMED_BOUND 420   /* px of a line of an expression                     */
#define FRAMED_LINES 4     /* lines that fit into a row of usual height, with a mark */
#define FRAMED_LINE  15    /* px from line to line                              */
#define TITLE_AIR    10    /* px behind a label or a title                      */
#define TITLE_STEP   18    /* px from a line of a title to the next             */
#define FRAMED_SIDE  12    /* px between its text and the outside of a bracket    */

/* Texts above a contact, coil or box. "" and 0: none. */
struct rung_label { struct lettered symbol, address; };
struct rung_label rung_label(const struct drafting *drafting, const struct cell *cell);
/** rung_element_comment - the text below it; "": none. @room: px. */
struct lettered rung_element_comment(const struct drafting *drafting,
				     const struct cell *cell, float room);

/** rung_is_framed - is it drawn as text between strokes: [ a > b ], >> Label? */
bool rung_is_framed(const struct word_row *word);
/** rung_framed - that text in lines; a longer one ends in an ellipsis. */
struct rung_framed {
	struct lettered line[FRAMED_LINES];
	int lines;
	float width;         /* of the widest line                              */
	bool left;           /* its lines begin below each other                */
	float up;            /* from the wire to the upper end of its strokes    */
};
struct rung_framed rung_framed(const struct drafting *drafting, const struct cell *cell);

/* Texts above a rung. */
struct rung_heading {
	struct lettered label, title;
	float indent;        /* px from the rail to the title: width of the label */
	float width;         /* of both in one line, with air; 0: neither         */
	char *comment;       /* one line, without delimiters; owned: g_free      */
	float comment_width;
};
struct rung_heading rung_heading(const struct drafting *drafting, const struct rung *rung);
/**
 * rung_lines - breaks a comment or a title into lines of @width px
 * @take: gets each line; NULL: only counts
 *
 * Returns how many; if there are more than @most, the last one ends in an ellipsis.
 */
int rung_lines(const struct drafting *drafting, enum letter letter, const char *text,
	       float width, int most,
	       void (*take)(void *context, int line, struct lettered text),
	       void *context);

#endif
