/* SPDX-License-Identifier: MIT
 *
 * picture - the list of strokes; as render nodes, on cairo, as PNG and SVG; see picture.h.
 *
 * Nodes: rectangles, straight lines and texts are cheap for a renderer. Arcs become images
 * where their size on the screen is known, else borders. Only dashed and dotted strokes go
 * through cairo.
 *
 * SVG is written here and not by cairo, so that texts are texts: they can be searched,
 * copied and compared by line. Each has its measured width, so that another font takes no
 * more room.
 */
#include "editor-gtk/kit/picture.h"

#include <math.h>
#include <pango/pangocairo.h>
#include <string.h>

#define WAVE_STEP 3     /* px from crest to trough                              */
#define WAVE_HEIGHT 3

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

void picture_grow(struct picture *picture, float x, float y)
{
	picture->width = MAX(picture->width, x);
	picture->height = MAX(picture->height, y);
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

#define CAPTION 24.0f /* px; height of a caption */

float picture_caption(struct picture *picture, struct lettering *lettering, char *text, float y)
{
	const struct lettered fits = lettering_fit(lettering, LETTER_COMMENT, text, -1, 0);

	picture_move(picture, 0, y);
	picture_text(picture, TOKEN_COMMENT, LETTER_COMMENT, fits, 16, 17);
	picture_move(picture, 0, 0);
	picture->width = MAX(picture->width, fits.width + 32);
	g_free(text);
	return CAPTION;
}

/* ---- nodes and cairo ---- */

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

/* Half the angle of an arc that is symmetric above and below its centre; 0: it is not. */
static float opening_of(const struct stroke *s)
{
	return fabsf(sinf((s->h + s->to) / 2)) < 0.001f ? (s->to - s->h) / 2 : 0;
}

/* Cairo draws an image of its own for each of these: dashed and dotted strokes, waves, and
 * arcs that are not symmetric. */
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

/* Consecutive strokes from @from on as one node. Returns the first behind them. */
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

/* A ring; with a width equal to its radius it is a disc. */
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

/* The bounds of an arc. Its ends begin at radius @inner. */
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

/* A clipped ring. The ends of the arc are vertical, not across it. */
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

/* Key of an arc's image, compared as bytes: no padding. */
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

/* Rounded to a quarter of a px, which is not visible, so that there are few images. */
static struct stroke arc_placed(const struct stroke *s)
{
	struct stroke placed = *s;

	placed.x = roundf(s->x * 4) / 4;
	placed.y = roundf(s->y * 4) / 4;
	return placed;
}

/* Painting an image takes a third of the time of a path. Images are never freed: two for
 * each colour, weight and quarter of a px of coils that was drawn. */
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

/* An image is as sharp as a path if its px are those of the screen. */
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

/* ---- PNG ---- */

cairo_status_t picture_append(void *bytes, const unsigned char *data, unsigned int len)
{
	g_byte_array_append(bytes, data, len);
	return CAIRO_STATUS_SUCCESS;
}

GBytes *picture_png(const struct picture *picture, const struct theme *theme,
		    struct lettering *lettering, float scale)
{
	GByteArray *bytes = g_byte_array_new();
	cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24,
		(int)((double)picture->width * (double)scale),
		(int)((double)picture->height * (double)scale));
	cairo_t *cr = cairo_create(surface);
	bool good;

	gdk_cairo_set_source_rgba(cr, &theme->color[TOKEN_SHEET]);
	cairo_paint(cr);
	cairo_scale(cr, (double)scale, (double)scale);
	picture_cairo(picture, theme, lettering, cr);
	cairo_destroy(cr);
	good = cairo_surface_write_to_png_stream(surface, picture_append, bytes) ==
	       CAIRO_STATUS_SUCCESS;
	cairo_surface_destroy(surface);
	if (good)
		return g_byte_array_free_to_bytes(bytes);
	g_byte_array_unref(bytes);
	return NULL;
}

/* ---- SVG ---- */

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
