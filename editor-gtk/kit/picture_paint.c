/* SPDX-License-Identifier: MIT
 *
 * picture_paint - the list of strokes as render nodes, and upon a cairo surface.
 *
 * Rectangles and straight lines become colour nodes and text becomes text nodes: they
 * cost a renderer next to nothing. Arcs become images where it is known how large they
 * are shown, else borders. Only what is broken goes through cairo.
 */
#include "editor-gtk/kit/picture.h"

#include <math.h>
#include <string.h>
#include <pango/pangocairo.h>

#define WAVE_STEP 3     /* px from crest to trough                              */
#define WAVE_HEIGHT 3

static GdkRGBA color_of(const struct stroke *stroke, const struct theme *theme)
{
	GdkRGBA color = theme->color[stroke->token];

	color.alpha = stroke->alpha;
	return color;
}

static void set_dash(cairo_t *cr, enum stroke_style style)
{
	static const double dashed[] = { 5, 3 }, dotted[] = { 1.5, 3 };

	cairo_set_dash(cr, style == STROKE_DASHED ? dashed : dotted,
		       style == STROKE_SOLID ? 0 : 2, 0);
}

static void wave_path(cairo_t *cr, const struct stroke *s)
{
	double x = (double)s->x, end = x + (double)s->w, y = (double)s->y;

	cairo_move_to(cr, x, y);
	for (int i = 1; x < end; i++) {
		x = fmin(x + WAVE_STEP, end);
		cairo_line_to(cr, x, i % 2 ? y + WAVE_HEIGHT : y);
	}
}

/* Everything but text. */
static void draw_shape(cairo_t *cr, const struct stroke *s)
{
	double half = (double)s->width / 2;

	cairo_set_line_width(cr, (double)s->width);
	set_dash(cr, s->style);
	switch (s->kind) {
	case STROKE_FILL:
		cairo_rectangle(cr, (double)s->x, (double)s->y, (double)s->w, (double)s->h);
		cairo_fill(cr);
		return;
	case STROKE_DISC:
		cairo_new_path(cr);
		cairo_arc(cr, (double)s->x, (double)s->y, (double)s->w, 0, 2 * G_PI);
		cairo_fill(cr);
		return;
	case STROKE_FRAME:
		cairo_rectangle(cr, (double)s->x + half, (double)s->y + half,
				(double)s->w - 2 * half, (double)s->h - 2 * half);
		break;
	case STROKE_LINE:
		cairo_move_to(cr, (double)s->x, (double)s->y);
		cairo_line_to(cr, (double)s->w, (double)s->h);
		break;
	case STROKE_ARC:
		cairo_new_path(cr);
		cairo_arc(cr, (double)s->x, (double)s->y, (double)s->w, (double)s->h,
			  (double)s->to);
		break;
	case STROKE_WAVE:
		wave_path(cr, s);
		break;
	case STROKE_TEXT:
		return;
	}
	cairo_stroke(cr);
}

static void text_on_cairo(cairo_t *cr, const struct stroke *s,
			  struct lettering *lettering)
{
	float baseline;
	PangoLayout *layout = lettering_layout(lettering, s->letter, s->text, &baseline);

	cairo_move_to(cr, (double)s->x, (double)(s->y - baseline));
	pango_cairo_show_layout(cr, layout);
}

void picture_cairo(const struct picture *picture, const struct theme *theme,
		   struct lettering *lettering, cairo_t *cr)
{
	for (int i = 0; i < picture->count; i++) {
		const struct stroke *s = &picture->stroke[i];
		GdkRGBA color = color_of(s, theme);

		gdk_cairo_set_source_rgba(cr, &color);
		if (s->kind == STROKE_TEXT)
			text_on_cairo(cr, s, lettering);
		else
			draw_shape(cr, s);
	}
}

static graphene_rect_t bounds_of(const struct stroke *s)
{
	float r = s->w + s->width;

	switch (s->kind) {
	case STROKE_ARC:
	case STROKE_DISC:
		return GRAPHENE_RECT_INIT(s->x - r, s->y - r, 2 * r, 2 * r);
	case STROKE_WAVE:
		return GRAPHENE_RECT_INIT(s->x - 1, s->y - 1, s->w + 2, WAVE_HEIGHT + 2);
	case STROKE_LINE:
		return GRAPHENE_RECT_INIT(fminf(s->x, s->w) - s->width,
					  fminf(s->y, s->h) - s->width,
					  fabsf(s->w - s->x) + 2 * s->width,
					  fabsf(s->h - s->y) + 2 * s->width);
	case STROKE_FILL:
	case STROKE_FRAME:
	case STROKE_TEXT:
		break;
	}
	return GRAPHENE_RECT_INIT(s->x, s->y, s->w, s->h);
}

/* Half the angle of an arc that is the same above and below its centre; 0: it is not. */
static float opening_of(const struct stroke *s)
{
	return fabsf(sinf((s->h + s->to) / 2)) < 0.001f ? (s->to - s->h) / 2 : 0;
}

/* Only these go through cairo, which draws them into an image of their own first: what is
 * broken, and arcs that stand askew. */
static bool wants_cairo(const struct stroke *s)
{
	switch (s->kind) {
	case STROKE_TEXT:
	case STROKE_FILL:
	case STROKE_DISC:
		return false;
	case STROKE_FRAME:
	case STROKE_LINE:
		return s->style != STROKE_SOLID;
	case STROKE_ARC:
		return opening_of(s) == 0;
	case STROKE_WAVE:
		return true;
	}
	return true;
}

/* Strokes from @from on that follow one another, as one node. Returns the first behind them. */
static int by_cairo(GtkSnapshot *snapshot, const struct picture *picture, int from,
		    const struct theme *theme)
{
	graphene_rect_t bounds = bounds_of(&picture->stroke[from]);
	int end = from + 1;

	for (; end < picture->count && wants_cairo(&picture->stroke[end]); end++) {
		graphene_rect_t next = bounds_of(&picture->stroke[end]);

		graphene_rect_union(&bounds, &next, &bounds);
	}
	cairo_t *cr = gtk_snapshot_append_cairo(snapshot, &bounds);
	for (int i = from; i < end; i++) {
		GdkRGBA color = color_of(&picture->stroke[i], theme);

		gdk_cairo_set_source_rgba(cr, &color);
		draw_shape(cr, &picture->stroke[i]);
	}
	cairo_destroy(cr);
	return end;
}

static void straight(GtkSnapshot *snapshot, const struct stroke *s, const GdkRGBA *color)
{
	float half = s->width / 2;
	bool level = s->y == s->h;
	graphene_rect_t rect = level ?
		GRAPHENE_RECT_INIT(fminf(s->x, s->w), s->y - half, fabsf(s->w - s->x),
				   s->width) :
		GRAPHENE_RECT_INIT(s->x - half, fminf(s->y, s->h), s->width,
				   fabsf(s->h - s->y));

	gtk_snapshot_append_color(snapshot, color, &rect);
}

static void slanting(GtkSnapshot *snapshot, const struct stroke *s, const GdkRGBA *color)
{
	const float dx = s->w - s->x, dy = s->h - s->y;

	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(s->x, s->y));
	gtk_snapshot_rotate(snapshot, atan2f(dy, dx) * 180 / (float)G_PI);
	gtk_snapshot_append_color(snapshot, color, &GRAPHENE_RECT_INIT(0, -s->width / 2,
		hypotf(dx, dy), s->width));
	gtk_snapshot_restore(snapshot);
}

static void line_on_snapshot(GtkSnapshot *snapshot, const struct stroke *s,
			     const GdkRGBA *color)
{
	if (s->x == s->w || s->y == s->h)
		straight(snapshot, s, color);
	else
		slanting(snapshot, s, color);
}

/* A ring; of the same width as its radius it is a disc. */
static void ring(GtkSnapshot *snapshot, const struct stroke *s, float radius, float thick,
		 const GdkRGBA *color)
{
	const float width[4] = { thick, thick, thick, thick };
	const GdkRGBA colors[4] = { *color, *color, *color, *color };
	GskRoundedRect circle;

	gsk_rounded_rect_init_from_rect(&circle, &GRAPHENE_RECT_INIT(s->x - radius,
		s->y - radius, 2 * radius, 2 * radius), radius);
	gtk_snapshot_append_border(snapshot, &circle, width, colors);
}

/* What an arc takes from the radius @inner on, where it ends. */
static graphene_rect_t arc_bounds(const struct stroke *s, float inner)
{
	const float opening = opening_of(s), outer = s->w + s->width / 2;
	const bool wide = opening > (float)G_PI_2;
	const float half = wide ? outer : outer * sinf(opening);
	const float end = (wide ? outer : inner) * cosf(opening);
	const bool left = cosf((s->h + s->to) / 2) < 0;

	return GRAPHENE_RECT_INIT(left ? s->x - outer : s->x + end, s->y - half,
				  outer - end, 2 * half);
}

/* What is seen of its ring. The ends of an arc are upright so, not across it. */
static void arc_as_ring(GtkSnapshot *snapshot, const struct stroke *s,
			const GdkRGBA *color)
{
	const graphene_rect_t seen = arc_bounds(s, s->w);
	const bool whole = opening_of(s) >= (float)G_PI;

	if (!whole)
		gtk_snapshot_push_clip(snapshot, &seen);
	ring(snapshot, s, s->w + s->width / 2, s->width, color);
	if (!whole)
		gtk_snapshot_pop(snapshot);
}

/* All that an image of an arc depends on: of as many bytes as its members. */
struct arc_key {
	struct { float x, y, radius, from, to, width; } at; /* px of the image  */
	GdkRGBA color;
	float scale;
};
G_STATIC_ASSERT(sizeof(struct arc_key) == 11 * sizeof(float));

static guint arc_hash(gconstpointer key)
{
	const guchar *byte = key;
	guint hash = 5381;

	for (gsize i = 0; i < sizeof(struct arc_key); i++)
		hash = hash * 33 + byte[i];
	return hash;
}

static gboolean arc_equal(gconstpointer a, gconstpointer b)
{
	return memcmp(a, b, sizeof(struct arc_key)) == 0;
}

static GdkTexture *arc_draw(const struct arc_key *key, int width, int height)
{
	const struct stroke arc = { .kind = STROKE_ARC, .x = key->at.x, .y = key->at.y,
		.w = key->at.radius, .h = key->at.from, .to = key->at.to,
		.width = key->at.width };
	cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
	cairo_t *cr = cairo_create(image);
	GBytes *bytes;
	GdkTexture *texture;

	cairo_scale(cr, (double)key->scale, (double)key->scale);
	gdk_cairo_set_source_rgba(cr, &key->color);
	draw_shape(cr, &arc);
	cairo_destroy(cr);
	cairo_surface_flush(image);
	bytes = g_bytes_new_with_free_func(cairo_image_surface_get_data(image),
		(gsize)(cairo_image_surface_get_stride(image) * height),
		(GDestroyNotify)cairo_surface_destroy, image);
	texture = gdk_memory_texture_new(width, height, GDK_MEMORY_DEFAULT, bytes,
		(gsize)cairo_image_surface_get_stride(image));
	g_bytes_unref(bytes);
	return texture;
}

/* To a quarter of a px: nobody sees less, and there are few images. */
static struct stroke arc_placed(const struct stroke *s)
{
	struct stroke placed = *s;

	placed.x = roundf(s->x * 4) / 4;
	placed.y = roundf(s->y * 4) / 4;
	return placed;
}

/* Painted in a third of the time that a path takes. Images are kept for as long as the
 * program runs: two for each colour, weight and quarter of a px of coils that was seen. */
static void arc_as_image(GtkSnapshot *snapshot, const struct stroke *stroke,
			 const GdkRGBA *color, float scale)
{
	static GHashTable *images;
	const struct stroke s = arc_placed(stroke);
	graphene_rect_t box = arc_bounds(&s, s.w - s.width / 2);
	GdkTexture *image;

	graphene_rect_round_extents(&box, &box);
	const struct arc_key key = {
		{ s.x - box.origin.x, s.y - box.origin.y, s.w, s.h, s.to, s.width },
		*color, scale };
	if (!images)
		images = g_hash_table_new_full(arc_hash, arc_equal, g_free, g_object_unref);
	image = g_hash_table_lookup(images, &key);
	if (!image) {
		image = arc_draw(&key, (int)(box.size.width * scale),
				 (int)(box.size.height * scale));
		g_hash_table_insert(images, g_memdup2(&key, sizeof(key)), image);
	}
	gtk_snapshot_append_texture(snapshot, image, &box);
}

/* An image looks as sharp as a path where its px are those of the screen. */
static void arc_on_snapshot(GtkSnapshot *snapshot, const struct stroke *s,
			    const GdkRGBA *color, float scale)
{
	if (scale >= 1 && scale == floorf(scale))
		arc_as_image(snapshot, s, color, scale);
	else
		arc_as_ring(snapshot, s, color);
}

static void text_on_snapshot(GtkSnapshot *snapshot, const struct stroke *s,
			     const GdkRGBA *color, struct lettering *lettering)
{
	float baseline;
	PangoLayout *layout = lettering_layout(lettering, s->letter, s->text, &baseline);

	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot,
			       &GRAPHENE_POINT_INIT(s->x, s->y - baseline));
	gtk_snapshot_append_layout(snapshot, layout, color);
	gtk_snapshot_restore(snapshot);
}

static void frame_on_snapshot(GtkSnapshot *snapshot, const struct stroke *s,
			      const GdkRGBA *color)
{
	GskRoundedRect rect;
	const float width[4] = { s->width, s->width, s->width, s->width };
	const GdkRGBA colors[4] = { *color, *color, *color, *color };

	gsk_rounded_rect_init_from_rect(&rect, &GRAPHENE_RECT_INIT(s->x, s->y, s->w, s->h),
					0);
	gtk_snapshot_append_border(snapshot, &rect, width, colors);
}

static void stroke_on_snapshot(GtkSnapshot *snapshot, const struct stroke *s, float scale,
			       const struct theme *theme, struct lettering *lettering)
{
	const GdkRGBA color = color_of(s, theme);

	switch (s->kind) {
	case STROKE_TEXT:
		text_on_snapshot(snapshot, s, &color, lettering);
		return;
	case STROKE_FILL:
		gtk_snapshot_append_color(snapshot, &color,
			&GRAPHENE_RECT_INIT(s->x, s->y, s->w, s->h));
		return;
	case STROKE_FRAME:
		frame_on_snapshot(snapshot, s, &color);
		return;
	case STROKE_LINE:
		line_on_snapshot(snapshot, s, &color);
		return;
	case STROKE_ARC:
		arc_on_snapshot(snapshot, s, &color, scale);
		return;
	case STROKE_DISC:
		ring(snapshot, s, s->w, s->w, &color);
		return;
	case STROKE_WAVE:
		return;
	}
}

void picture_snapshot(const struct picture *picture, const struct theme *theme,
		      struct lettering *lettering, GtkSnapshot *snapshot)
{
	for (int i = 0; i < picture->count; i++) {
		const struct stroke *s = &picture->stroke[i];

		if (wants_cairo(s))
			i = by_cairo(snapshot, picture, i, theme) - 1;
		else
			stroke_on_snapshot(snapshot, s, picture->scale, theme, lettering);
	}
}

GskRenderNode *picture_node(const struct picture *picture, const struct theme *theme,
			    struct lettering *lettering)
{
	GtkSnapshot *snapshot = gtk_snapshot_new();

	picture_snapshot(picture, theme, lettering, snapshot);
	return gtk_snapshot_free_to_node(snapshot);
}
