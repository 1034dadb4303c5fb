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
/* Of a project of ClassicLadder: as it becomes here, as it is there, both. */
enum render_original { ORIGINAL_NO, ORIGINAL_ALONE, ORIGINAL_BOTH };
/* As `ladder` has them. */
enum render_status { RENDER_GOOD, RENDER_NO, RENDER_WRONG };

struct render_options {
	const char *file;    /* what is drawn; with --diff the newer one          */
	const char *older;   /* NULL: nothing is compared                        */
	const char *out;
	enum render_format format;
	const char *pou;     /* NULL: all                                        */
	int rung;            /* 1-based; 0: all                                  */
	enum theme_kind theme;
	enum drafting_show show;
	float width, scale;
	struct paper paper;
	enum render_original original;
	bool check;          /* mark what is wrong, and say it                   */
	bool help;
	const struct diag_list *diags; /* of the check; NULL: none was wanted    */
};

/**
 * render_main - all of `ladder-editor --render …`; call it before GTK is started
 *
 * Returns the exit status: 0; 1 when the file has errors that leave nothing to draw;
 * 2: wrong usage, or a file that cannot be read or written. What is wrong is said on
 * stderr.
 */
int render_main(int argc, char **argv);

#endif
