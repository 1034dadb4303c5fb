/* SPDX-License-Identifier: MIT
 *
 * render_diff_lines - what differs and is no rung: lists, charts, declarations.
 *
 * Each takes @y, where it begins, and returns where it ends. What was and what is are told
 * by − and +, as beside rungs.
 */
#ifndef EDITOR_RENDER_DIFF_LINES_H
#define EDITOR_RENDER_DIFF_LINES_H

#include "editor-gtk/kit/picture.h"
#include "editor-gtk/render/render_options.h"
#include "engine/model/project.h"

/** render_diff_lines - of two lists or charts (-1: there is none) the lines that differ,
 * and some around them. */
float render_diff_lines(const struct project *a, int pou_a, const struct project *b,
			int pou_b, struct lettering *lettering, float y,
			struct picture *picture);
/** render_diff_charts - a chart as it was and as it is (-1: there is none), with marks at
 * what differs in them. */
float render_diff_charts(const struct project *a, int pou_a, const struct project *b,
			 int pou_b, const struct render_options *options,
			 struct lettering *lettering, float y, struct picture *picture);
/** render_diff_besides - declarations and all else, as `ladder diff` says it; of one POU
 * if the options want one. Nothing: @y. */
float render_diff_besides(const struct project *a, const struct project *b,
			  const struct render_options *options,
			  struct lettering *lettering, float y, struct picture *picture);

#endif
