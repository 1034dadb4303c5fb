/* SPDX-License-Identifier: MIT
 *
 * draw - blanks, wires and clipped texts of a drawing.
 */
#include "engine/show/draw.h"

#include "engine/base/plain.h"

void draw_blank(const struct draw *draw, int count)
{
	sink_repeat(draw->sink, " ", count);
}

void draw_across(const struct draw *draw, int count, bool on)
{
	sink_repeat(draw->sink, on ? draw->strokes->powered : draw->strokes->across,
		    count);
}

int draw_clipped(const char *text, size_t len, int limit)
{
	int width;
	size_t fits = plain_clip(text, len, limit, &width);

	if (fits == len)
		return width;
	plain_clip(text, len, limit - 1, &width);
	return width + 1;
}

int draw_text(const struct draw *draw, const char *text, size_t len, int limit)
{
	int width;
	size_t fits = plain_clip(text, len, limit, &width);

	if (fits == len) {
		plain_write(draw->sink, text, len);
		return width;
	}
	fits = plain_clip(text, len, limit - 1, &width);
	plain_write(draw->sink, text, fits);
	sink_text(draw->sink, draw->strokes->more);
	return width + 1;
}
