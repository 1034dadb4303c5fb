/* SPDX-License-Identifier: MIT
 *
 * ghost - the picture at the pointer of a drag; see ghost.h.
 */
#include "editor-gtk/draw/ghost.h"

#include <math.h>

#define RUNG_WIDTH     480 /* px, largest size                                  */
#define RUNG_HEIGHT    160
#define OPACITY        0.7

/* Without a compositor transparent areas are black. */
static double opacity_of(GtkDragSource *source)
{
	GtkWidget *widget = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(source));

	return gdk_display_is_composited(gtk_widget_get_display(widget)) ? OPACITY : 1;
}

/* Takes @drawing; NULL: only the background. */
static void show(GtkDragSource *source, GskRenderNode *drawing, const struct theme *theme,
		 float scale, float width, float height, int hot_x, int hot_y)
{
	const graphene_rect_t all = GRAPHENE_RECT_INIT(0, 0, width, height);
	const GdkRGBA *line = &theme->color[TOKEN_IDLE];
	GtkSnapshot *snapshot = gtk_snapshot_new();
	GdkPaintable *paintable;
	GskRoundedRect edge;

	gsk_rounded_rect_init_from_rect(&edge, &all, 0);
	gtk_snapshot_push_opacity(snapshot, opacity_of(source));
	gtk_snapshot_push_clip(snapshot, &all);
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_SHEET], &all);
	gtk_snapshot_save(snapshot);
	gtk_snapshot_scale(snapshot, scale, scale);
	if (drawing) {
		gtk_snapshot_append_node(snapshot, drawing);
		gsk_render_node_unref(drawing);
	}
	gtk_snapshot_restore(snapshot);
	gtk_snapshot_append_border(snapshot, &edge, (float[]){ 1, 1, 1, 1 },
				   (GdkRGBA[]){ *line, *line, *line, *line });
	gtk_snapshot_pop(snapshot);
	gtk_snapshot_pop(snapshot);
	paintable = gtk_snapshot_free_to_paintable(snapshot, &all.size);
	gtk_drag_source_set_icon(source, paintable, hot_x, hot_y);
	g_object_unref(paintable);
}

void ghost_tile(GtkDragSource *source, const struct picture *picture,
		const struct theme *theme, struct lettering *lettering)
{
	show(source, picture_node(picture, theme, lettering), theme, 1, GHOST_WIDTH,
	     GHOST_HEIGHT, GHOST_WIDTH / 2, GHOST_HEIGHT / 2);
}

void ghost_element(GtkDragSource *source, const struct word_row *word,
		   const struct theme *theme, struct lettering *lettering)
{
	struct picture picture;

	picture_init(&picture);
	grid_draw_icon(word, theme, lettering, GHOST_WIDTH, GHOST_HEIGHT, &picture);
	ghost_tile(source, &picture, theme, lettering);
	picture_clear(&picture);
}

void ghost_rung(GtkDragSource *source, const struct drafting *drafting,
		const struct rung_layout *layout, const struct theme *theme, float scale,
		float hot_x, float hot_y)
{
	const struct grid_scene scene = { .drafting = drafting, .layout = layout,
					  .theme = theme };
	const float wide = rung_layout_width(layout);
	float width, height;

	scale = MIN(scale, RUNG_WIDTH / wide);
	width = ceilf(wide * scale);
	height = ceilf(MIN(layout->height * scale, RUNG_HEIGHT));
	show(source, grid_draw_node(&scene), theme, scale, width, height,
	     (int)(hot_x * scale), (int)MIN(hot_y * scale, height));
}
