/* SPDX-License-Identifier: MIT
 *
 * picture - the list of strokes, and its form as lines of text; see picture.h.
 */
#include "editor-gtk/kit/picture.h"

void picture_init(struct picture *picture)
{
	*picture = (struct picture){ .texts = g_string_chunk_new(1024) };
}

void picture_clear(struct picture *picture)
{
	g_free(picture->stroke);
	if (picture->texts)
		g_string_chunk_free(picture->texts);
	*picture = (struct picture){ 0 };
}

void picture_move(struct picture *picture, float dx, float dy)
{
	picture->dx = dx;
	picture->dy = dy;
}

static void add(struct picture *picture, struct stroke stroke)
{
	if (picture->count == picture->size) {
		picture->size = picture->size ? 2 * picture->size : 64;
		picture->stroke = g_renew(struct stroke, picture->stroke,
					  picture->size);
	}
	stroke.x += picture->dx;
	stroke.y += picture->dy;
	if (stroke.kind == STROKE_LINE) {
		stroke.w += picture->dx;
		stroke.h += picture->dy;
	}
	picture->stroke[picture->count++] = stroke;
}

void picture_fill(struct picture *picture, enum token token, float alpha,
		  float x, float y, float w, float h)
{
	add(picture, (struct stroke){ .kind = STROKE_FILL, .token = token, .x = x, .y = y,
				      .w = w, .h = h, .alpha = alpha });
}

void picture_frame(struct picture *picture, enum token token, enum stroke_style style,
		   float width, float x, float y, float w, float h)
{
	add(picture, (struct stroke){ .kind = STROKE_FRAME, .token = token, .x = x,
				      .y = y, .w = w, .h = h, .alpha = 1,
				      .style = style, .width = width });
}

void picture_line(struct picture *picture, enum token token, enum stroke_style style,
		  float width, float x1, float y1, float x2, float y2)
{
	add(picture, (struct stroke){ .kind = STROKE_LINE, .token = token, .x = x1,
				      .y = y1, .w = x2, .h = y2, .alpha = 1,
				      .style = style, .width = width });
}

void picture_arc(struct picture *picture, enum token token, float width,
		 float x, float y, float radius, float from, float to)
{
	add(picture, (struct stroke){ .kind = STROKE_ARC, .token = token, .x = x, .y = y,
				      .w = radius, .h = from, .to = to, .alpha = 1,
				      .width = width });
}

void picture_disc(struct picture *picture, enum token token, float alpha,
		  float x, float y, float radius)
{
	add(picture, (struct stroke){ .kind = STROKE_DISC, .token = token, .x = x, .y = y,
				      .w = radius, .alpha = alpha });
}

void picture_wave(struct picture *picture, enum token token, float x, float y, float w)
{
	add(picture, (struct stroke){ .kind = STROKE_WAVE, .token = token, .x = x, .y = y,
				      .w = w, .alpha = 1, .width = 1.25f });
}

void picture_text(struct picture *picture, enum token token, enum letter letter,
		  struct lettered text, float x, float baseline)
{
	if (*text.text)
		add(picture, (struct stroke){
			.kind = STROKE_TEXT, .token = token, .letter = letter, .x = x,
			.y = baseline, .w = text.width, .alpha = 1,
			.text = g_string_chunk_insert(picture->texts, text.text),
		});
}

char *picture_lines(const struct picture *picture)
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
		g_string_append_c(out, '\n');
	}
	return g_string_free(out, FALSE);
}
