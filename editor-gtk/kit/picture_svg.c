/* SPDX-License-Identifier: MIT
 *
 * picture_svg - the list of strokes as an SVG file.
 *
 * Written here and not by cairo, so that texts are texts: they can be searched, copied
 * and compared by line. Each says how wide it was measured, so that another font of
 * whoever looks at it takes no more room.
 */
#include "editor-gtk/kit/picture.h"

#include <math.h>

/* Numbers with a point, whatever the locale; at most two digits behind it. */
static const char *number(float value, char room[G_ASCII_DTOSTR_BUF_SIZE])
{
	return g_ascii_formatd(room, G_ASCII_DTOSTR_BUF_SIZE, "%.6g",
			       round((double)value * 100) / 100);
}

static void put(GString *out, const char *name, float value)
{
	char room[G_ASCII_DTOSTR_BUF_SIZE];

	g_string_append_printf(out, " %s=\"%s\"", name, number(value, room));
}

static void put_paint(GString *out, const struct stroke *s, bool filled)
{
	g_string_append_printf(out, " class=\"%s%s\"", filled ? "f-" : "s-",
			       token_name(s->token));
	if (s->alpha < 1)
		put(out, filled ? "fill-opacity" : "stroke-opacity", s->alpha);
	if (filled)
		return;
	put(out, "stroke-width", s->width);
	if (s->style != STROKE_SOLID)
		g_string_append_printf(out, " stroke-dasharray=\"%s\"",
				       s->style == STROKE_DASHED ? "5 3" : "1.5 3");
}

static void put_arc(GString *out, const struct stroke *s)
{
	char x[G_ASCII_DTOSTR_BUF_SIZE], y[G_ASCII_DTOSTR_BUF_SIZE],
		r[G_ASCII_DTOSTR_BUF_SIZE];

	if ((double)(s->to - s->h) >= 2 * G_PI - 0.01) {
		g_string_append(out, "<circle fill=\"none\"");
		put(out, "cx", s->x);
		put(out, "cy", s->y);
		put(out, "r", s->w);
		return;
	}
	g_string_append_printf(out, "<path fill=\"none\" d=\"M%s %s",
			       number(s->x + s->w * cosf(s->h), x),
			       number(s->y + s->w * sinf(s->h), y));
	g_string_append_printf(out, "A%s %s 0 0 1", number(s->w, r), r);
	g_string_append_printf(out, " %s %s\"", number(s->x + s->w * cosf(s->to), x),
			       number(s->y + s->w * sinf(s->to), y));
}

static void put_wave(GString *out, const struct stroke *s)
{
	char x[G_ASCII_DTOSTR_BUF_SIZE], y[G_ASCII_DTOSTR_BUF_SIZE];

	g_string_append(out, "<polyline fill=\"none\" points=\"");
	for (int i = 0; 3 * i <= (int)s->w; i++)
		g_string_append_printf(out, "%s%s,%s", i ? " " : "",
				       number(s->x + 3 * (float)i, x),
				       number(i % 2 ? s->y + 3 : s->y, y));
	g_string_append_c(out, '"');
}

static void put_text(GString *out, const struct stroke *s)
{
	char *safe = g_markup_escape_text(s->text, -1);

	g_string_append_printf(out, "<text class=\"%s f-%s\"",
			       letter_style(s->letter)->name, token_name(s->token));
	put(out, "x", s->x);
	put(out, "y", s->y);
	put(out, "textLength", s->w);
	g_string_append_printf(out, ">%s</text>\n", safe);
	g_free(safe);
}

static void put_stroke(GString *out, const struct stroke *s)
{
	float half = s->kind == STROKE_FRAME ? s->width / 2 : 0;
	bool filled = s->kind == STROKE_FILL || s->kind == STROKE_DISC;

	switch (s->kind) {
	case STROKE_TEXT:
		put_text(out, s);
		return;
	case STROKE_FILL:
	case STROKE_FRAME:
		g_string_append_printf(out, "<rect%s", filled ? "" : " fill=\"none\"");
		put(out, "x", s->x + half);
		put(out, "y", s->y + half);
		put(out, "width", fmaxf(s->w - 2 * half, 0));
		put(out, "height", fmaxf(s->h - 2 * half, 0));
		break;
	case STROKE_LINE:
		g_string_append(out, "<line");
		put(out, "x1", s->x);
		put(out, "y1", s->y);
		put(out, "x2", s->w);
		put(out, "y2", s->h);
		break;
	case STROKE_DISC:
		g_string_append(out, "<circle");
		put(out, "cx", s->x);
		put(out, "cy", s->y);
		put(out, "r", s->w);
		break;
	case STROKE_ARC:
		put_arc(out, s);
		break;
	case STROKE_WAVE:
		put_wave(out, s);
		break;
	}
	put_paint(out, s, filled);
	g_string_append(out, "/>\n");
}

static void put_styles(GString *out, const struct theme *theme)
{
	char room[G_ASCII_DTOSTR_BUF_SIZE];

	g_string_append(out, "<style>\ntext{white-space:pre}\n");
	for (int i = 0; i < TOKENS; i++) {
		const GdkRGBA *c = &theme->color[i];
		unsigned int rgb = (unsigned int)lroundf(c->red * 255) << 16 |
				   (unsigned int)lroundf(c->green * 255) << 8 |
				   (unsigned int)lroundf(c->blue * 255);

		g_string_append_printf(out, ".f-%s{fill:#%06x}.s-%s{stroke:#%06x}\n",
				       token_name(i), rgb, token_name(i), rgb);
	}
	for (int i = 0; i < LETTERS; i++) {
		const struct letter_style *style = letter_style(i);

		g_string_append_printf(out, ".%s{font:%d %spx %s}\n", style->name,
			(int)style->weight, number(style->size, room), style->mono ?
			"'DejaVu Sans Mono','Noto Sans Mono CJK SC',monospace" :
			"Cantarell,'Noto Sans','Noto Sans CJK SC',sans-serif");
	}
	g_string_append(out, "</style>\n");
}

char *picture_svg(const struct picture *picture, const struct theme *theme, float scale,
		  bool ground)
{
	GString *out = g_string_new("<svg xmlns=\"http://www.w3.org/2000/svg\"");
	char w[G_ASCII_DTOSTR_BUF_SIZE], h[G_ASCII_DTOSTR_BUF_SIZE];

	put(out, "width", picture->width * scale);
	put(out, "height", picture->height * scale);
	g_string_append_printf(out, " viewBox=\"0 0 %s %s\">\n", number(picture->width, w),
			       number(picture->height, h));
	put_styles(out, theme);
	if (ground)
		g_string_append(out, "<rect class=\"f-sheet\" width=\"100%\" "
				     "height=\"100%\"/>\n");
	for (int i = 0; i < picture->count; i++)
		put_stroke(out, &picture->stroke[i]);
	g_string_append(out, "</svg>\n");
	return g_string_free(out, FALSE);
}
