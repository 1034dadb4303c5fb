/* SPDX-License-Identifier: MIT
 *
 * render_options - the command line of `ladder-editor --render`.
 *
 * It reads and judges the words; it opens no file.
 */
#ifndef EDITOR_RENDER_OPTIONS_H
#define EDITOR_RENDER_OPTIONS_H

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

/** render_options_parse - @argv[0] is the program. What is wrong is said on stderr.
 * Fails: false; exit with RENDER_WRONG. */
bool render_options_parse(int argc, char **argv, struct render_options *out);
/** render_options_help - the options, on stdout. */
void render_options_help(void);

#endif
