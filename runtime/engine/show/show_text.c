/* SPDX-License-Identifier: MIT
 *
 * show_text - what stands above and below a drawing: label, title, comments.
 */
#include "engine/show/draw.h"
#include "engine/base/plain.h"

#include <string.h>

void draw_head(const struct draw *draw)
{
	const struct rung *rung = draw->rung;
	const char *label = project_text(draw->project, rung->label);
	const char *title = project_text(draw->project, rung->title);
	const char *at = project_text(draw->project, rung->comment), *line;
	size_t len;

	plain_text(draw->sink, label);
	if (*label && *title)
		sink_text(draw->sink, ": ");
	plain_text(draw->sink, title);
	if (rung->off)
		sink_text(draw->sink, *label || *title ? " [OFF]" : "[OFF]");
	if (*label || *title || rung->off)
		sink_text(draw->sink, "\n");
	while ((line = plain_comment_line(&at, &len))) {
		draw_blank(draw, draw->margin + 2);
		plain_write(draw->sink, line, len);
		sink_text(draw->sink, "\n");
	}
}

void draw_comments(const struct draw *draw)
{
	for (int row = 0; row < draw->rung->rows; row++)
		for (int col = 0; col < draw->rung->cols; col++) {
			const struct cell *cell = rung_at(draw->rung, row, col);
			const char *at = project_text(draw->project,
						      cell->comment);
			const char *line, *name = project_text(draw->project, cell->operand);
			size_t len;

			while ((line = plain_comment_line(&at, &len))) {
				draw_blank(draw, draw->margin + 1);
				sink_printf(draw->sink, "(%d,%d) ", row + 1,
					    col + 1);
				draw_text(draw, name, strlen(name), DRAW_CLIP);
				sink_text(draw->sink, *name ? ": " : "");
				plain_write(draw->sink, line, len);
				sink_text(draw->sink, "\n");
			}
		}
}
