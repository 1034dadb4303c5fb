/* SPDX-License-Identifier: MIT
 *
 * lines - a picture as text, a line for each stroke, to be compared with a file.
 */
#ifndef TESTS_EDITOR_LINES_H
#define TESTS_EDITOR_LINES_H

#include "editor-gtk/kit/picture.h"

/* The caller frees it with g_free(). */
static inline char *picture_lines(const struct picture *picture)
{
	static const char *const kind[] = { "fill", "frame", "line", "arc", "disc",
					    "wave", "text" };
	static const char *const style[] = { "", " dashed", " dotted" };
	GString *out = g_string_new(NULL);

	for (int i = 0; i < picture->count; i++) {
		const struct stroke *s = &picture->stroke[i];

		g_string_append_printf(out, "%s %s%s %.0f %.0f", kind[s->kind],
				       token_name(s->token), style[s->style],
				       (double)s->x, (double)s->y);
		if (s->kind == STROKE_TEXT)
			g_string_append_printf(out, " %s %s",
					       letter_style(s->letter)->name, s->text);
		else if (s->kind == STROKE_DISC || s->kind == STROKE_WAVE)
			g_string_append_printf(out, " %.0f", (double)s->w);
		else
			g_string_append_printf(out, " %.0f %.*f", (double)s->w,
					       s->kind == STROKE_ARC ? 2 : 0,
					       (double)s->h);
		if (s->width > 0)
			g_string_append_printf(out, " by %.4g", (double)s->width);
		if (s->alpha < 1 && s->kind != STROKE_FILL && s->kind != STROKE_DISC)
			g_string_append_printf(out, " at %.2g", (double)s->alpha);
		g_string_append_c(out, '\n');
	}
	return g_string_free(out, FALSE);
}

#endif
