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

/** render_sheets - POU @pou of a project, or all (-1); its size too is set. */
void render_sheets(const struct project *project, int pou,
		   const struct render_options *options, struct lettering *lettering,
		   struct picture *picture);
/** render_heading - a line above what follows; returns its height. */
float render_heading(struct lettering *lettering, const char *text, float y,
		     struct picture *picture);
/** render_remarks - what rungs @first … @end - 1 have no room for, in lines; nothing if there
 * is none. @heading: above them; NULL: none. Returns the y below. */
float render_remarks(const struct sheet *sheet, int first, int end, const char *heading,
		     float y, struct picture *picture);
/** render_grow - the picture reaches at least to (@x, @y). */
void render_grow(struct picture *picture, float x, float y);
/** render_classic - rungs of a ClassicLadder project as they stand in its files, alone or
 * with what becomes of them here: of POU @pou (-1: all), or of its rung options->rung alone.
 * Fails: false: @ladder has loaded no such project, or no such rung came from one. */
bool render_classic(struct ladder *ladder, int pou, const struct render_options *options,
		    struct lettering *lettering, struct picture *picture);

#endif
