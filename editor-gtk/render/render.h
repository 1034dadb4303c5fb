/* SPDX-License-Identifier: MIT
 *
 * render - pictures of a project from the command line, with no display.
 */
#ifndef EDITOR_RENDER_H
#define EDITOR_RENDER_H

#include "editor-gtk/draw/pages.h"
#include "editor-gtk/kit/theme.h"
#include "engine/base/diag.h"

enum render_format { RENDER_SVG, RENDER_PDF, RENDER_PNG };
/* For a project of ClassicLadder: the imported rungs, the original ones, both. */
enum render_original { ORIGINAL_NO, ORIGINAL_ALONE, ORIGINAL_BOTH };
/* As in `ladder`. */
enum render_status { RENDER_GOOD, RENDER_NO, RENDER_WRONG };

struct render_options {
	const char *file;    /* what to draw; with --diff the newer project       */
	const char *older;   /* NULL: no comparison                              */
	const char *out;
	enum render_format format;
	const char *pou;     /* NULL: all                                        */
	int rung;            /* 1-based; 0: all                                  */
	enum theme_kind theme;
	enum drafting_show show;
	float width, scale;
	struct paper paper;
	enum render_original original;
	bool check;          /* mark errors, and print them                      */
	bool help;
	const struct diag_list *diags; /* of the check; NULL: not wanted         */
};

/**
 * render_main - runs `ladder-editor --render …`; call it before GTK is started
 *
 * Returns the exit status: 0; 1: errors in the file leave nothing to draw; 2: wrong usage,
 * or a file that cannot be read or written. Messages go to stderr.
 */
int render_main(int argc, char **argv);

#endif
