/* SPDX-License-Identifier: MIT
 *
 * lettering - the styles of type, and the width of a text in each.
 *
 * Texts are measured with Pango and remembered, because a sheet repeats the same names. A
 * text longer than its bound is cut with an ellipsis here, so that screen, SVG and PDF show
 * the same.
 */
#ifndef EDITOR_LETTERING_H
#define EDITOR_LETTERING_H

#include "editor-gtk/kit/spelling.h"

#include <pango/pango.h>
#include <stdbool.h>
#include <stddef.h>

enum letter {
	LETTER_SYMBOL,  /* name above an element                                */
	LETTER_ADDRESS, /* below it, monospace                                  */
	LETTER_TITLE,   /* of a rung                                            */
	LETTER_COMMENT,
	LETTER_NUMBER,  /* of a rung                                            */
	LETTER_TYPE,    /* TON in its box; the P of |P|                         */
	LETTER_PIN,
	LETTER_OPERAND, /* values at pins, expressions: monospace               */
	LETTER_VALUE,   /* live values: monospace, so that digits keep their places */
	LETTER_BADGE,   /* F, 2×                                                */
	LETTER_HEADING, /* of a page                                            */
	LETTERS
};

/* A text ready to be drawn: valid UTF-8, no control characters, not too wide. */
struct lettered {
	const char *text; /* lives until lettering_trim() or lettering_free()   */
	float width;      /* px                                                 */
};

struct lettering;

/**
 * lettering_new - styles for a context
 * @context: of a widget, or of lettering_context(); a reference is kept. NULL: no font at
 *           all, every character has the same width: for tests that give the same on every
 *           machine. Nothing can be painted with it.
 * @family:  fonts for all but monospace text; NULL: the usual ones
 *
 * Owns: the caller, lettering_free().
 */
struct lettering *lettering_new(PangoContext *context, const char *family);
void lettering_free(struct lettering *lettering);
/** lettering_context - a context that needs no display.
 * Owns: the caller, g_object_unref. */
PangoContext *lettering_context(void);
/** lettering_spell - addresses in names, operands and addresses are drawn by this rule from now on; without
 * it they are drawn as they are written. All texts of it end. */
void lettering_spell(struct lettering *lettering, struct spelling_rule rule);
/** lettering_trim - forgets texts if there are very many. Call it between drawings. */
void lettering_trim(struct lettering *lettering);

/**
 * lettering_fit - a text in a style
 * @len:   bytes of @text, which may be anything; -1: up to its NUL
 * @bound: px; what is wider ends in an ellipsis. 0: no bound
 */
struct lettered lettering_fit(struct lettering *lettering, enum letter letter,
			      const char *text, ptrdiff_t len, float bound);

/** lettering_wrap - the number of bytes of @text that fit on one line of @width px, broken
 * between words if possible; at least one character. */
size_t lettering_wrap(struct lettering *lettering, enum letter letter, const char *text,
		      float width);

/** lettering_lines - the number of lines of @text when it is wrapped; at least one. */
int lettering_lines(struct lettering *lettering, enum letter letter, const char *text,
		    float width);

/** lettering_line - the next line of a text, without blanks at its end.
 * @text: moves behind the line. @last: takes all that is left, with an ellipsis if it is
 *        too long */
struct lettered lettering_line(struct lettering *lettering, enum letter letter,
			       const char **text, float width, bool last);

/** lettering_layout - @text laid out, its top at 0, its baseline at @baseline px.
 * Borrowed until lettering_trim(); not to be changed. */
PangoLayout *lettering_layout(struct lettering *lettering, enum letter letter,
			      const char *text, float *baseline);

/* A style, for renderers that do not use Pango: SVG. */
struct letter_style {
	const char *name;   /* "symbol"                                        */
	float size;         /* px                                              */
	PangoWeight weight;
	bool mono;
};
/** letter_style - lives for ever. */
const struct letter_style *letter_style(enum letter letter);

#endif
