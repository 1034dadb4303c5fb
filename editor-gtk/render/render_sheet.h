/* SPDX-License-Identifier: MIT
 *
 * render_sheet - a project, a POU or a rung as one long picture.
 */
#ifndef EDITOR_RENDER_SHEET_H
#define EDITOR_RENDER_SHEET_H

#include "editor-gtk/kit/picture.h"
#include "editor-gtk/render/render.h"
#include "editor-gtk/draw/sheet.h"
#include "engine/ladder.h"

/** render_sheets - draws POU @pou of a project, or all (-1), and sets the size of the
 * picture. */
void render_sheets(const struct project *project, int pou,
		   const struct render_options *options, struct lettering *lettering,
		   struct picture *picture);
/** render_heading - a line above the next part; returns its height. */
float render_heading(struct lettering *lettering, const char *text, float y,
		     struct picture *picture);
/** render_remarks - lists the comments that do not fit in rungs @first … @end - 1; nothing
 * if all fit. @heading: above them; NULL: none. Returns the y below. */
float render_remarks(const struct sheet *sheet, int first, int end, const char *heading,
		     float y, struct picture *picture);
/** render_classic - original rungs of a ClassicLadder project, alone or with the imported
 * ones: of POU @pou (-1: all), or only its rung options->rung. Fails: false: @ladder has
 * loaded no such project, or no such rung has an original. */
bool render_classic(struct ladder *ladder, int pou, const struct render_options *options,
		    struct lettering *lettering, struct picture *picture);

#endif
