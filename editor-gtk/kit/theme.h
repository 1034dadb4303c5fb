/* SPDX-License-Identifier: MIT
 *
 * theme - the colours and weights of everything that is drawn, in one table.
 *
 * Drawings name a token, never a colour. Screen, pictures, print and palette icons take
 * colours from here and not from CSS, so that all of them look the same.
 *
 * Text keeps 4.5 : 1 against the sheet and graphics 3 : 1 (tests/editor/kit/test_theme.c).
 * Power is shown by weight and fill as well as by colour: light power and idle wire have
 * nearly the same luminance.
 */
#ifndef EDITOR_THEME_H
#define EDITOR_THEME_H

#include <gdk/gdk.h>
#include <stdbool.h>

enum theme_kind {
	THEME_LIGHT, THEME_DARK,
	THEME_CONTRAST, THEME_CONTRAST_DARK, /* high contrast                   */
	THEME_PRINT,                         /* black; power is double weight   */
	THEME_KINDS
};
/* The colour of power: that of most editors, or of S7-200 and GX Works. */
enum theme_power { THEME_GREEN, THEME_BLUE, THEME_POWERS };

enum token {
	TOKEN_SHEET,   /* the ground                                           */
	TOKEN_INK,     /* symbols, shapes                                      */
	TOKEN_IDLE,    /* a wire without power; rails                          */
	TOKEN_POWER,   /* a wire with power                                    */
	TOKEN_FORCE,   /* forced; written twice                                */
	TOKEN_ERROR,
	TOKEN_ACCENT,  /* cursor, selection, live numbers                      */
	TOKEN_COMMENT, /* comments, addresses                                  */
	TOKEN_BADGE,   /* text on a ground of TOKEN_FORCE or TOKEN_BLOCKS      */
	TOKEN_BLOCKS,  /* an element that blocks power                         */
	/* Backgrounds and hairlines: decoration only. */
	TOKEN_GUTTER,  /* below the rung numbers                               */
	TOKEN_LINE,    /* between rungs                                        */
	TOKEN_FOUND,   /* behind a search hit                                  */
	TOKEN_FOUND_NOW, /* behind the current one                              */
	TOKENS
};

struct theme {
	GdkRGBA color[TOKENS];
	float idle_width, power_width; /* px of a wire                        */
	float shape_width;             /* px of contacts, coils, boxes        */
	float rail_width;
	float fill;    /* opacity of TOKEN_POWER in a closed contact, lit coil  */
	float wash;    /* opacity of TOKEN_ACCENT below cursor and selection   */
	bool dark;
};

/** theme_get - one row of the table. Owns: nothing; it lives for ever. */
const struct theme *theme_get(enum theme_kind kind, enum theme_power power);
/** theme_is_high - high contrast: the desktop has it, or the preferences ask for it. */
bool theme_is_high(void);
/** theme_kind_screen - what is on the screen now: light or dark, high contrast. */
enum theme_kind theme_kind_screen(void);
/** theme_screen - the row of that kind; green power. */
const struct theme *theme_screen(void);
/** theme_follow - calls @changed (@object) whenever theme_kind_screen() may be another.
 * @object: a GObject; with it the calls end. */
void theme_follow(gpointer object, GCallback changed);
/** theme_call - the same for @data that is no GObject, until theme_leave(). */
void theme_call(gpointer data, GCallback changed);
void theme_leave(gpointer data);
/** token_name - "power"; names in SVG pictures and tests. Lives for ever. */
const char *token_name(enum token token);

#endif
