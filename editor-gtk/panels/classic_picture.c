/* SPDX-License-Identifier: MIT
 *
 * classic_picture - before and after, as a widget; the strokes are grid_classic.h's.
 */
#include "editor-gtk/panels/classic_picture.h"

#include "editor-gtk/draw/grid_classic.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/settings.h"

#include <adwaita.h>
#include <math.h>

struct _LadderClassicPicture {
	GtkWidget parent_instance;
	LadderOrigin *origin;
	LadderDocument *document;
	const struct classic_rung *rung; /* of @origin                          */
	struct lettering *lettering;
	struct picture strokes;
};

G_DEFINE_FINAL_TYPE(LadderClassicPicture, ladder_classic_picture, GTK_TYPE_WIDGET)

static const struct theme *theme_now(void)
{
	AdwStyleManager *manager = adw_style_manager_get_default();
	const bool dark = adw_style_manager_get_dark(manager);

	return theme_get(adw_style_manager_get_high_contrast(manager) ?
			 dark ? THEME_CONTRAST_DARK : THEME_CONTRAST :
			 dark ? THEME_DARK : THEME_LIGHT, THEME_GREEN);
}

/* ---- strokes ---- */

static void put_nothing(LadderClassicPicture *picture)
{
	const char *text = _("Nothing of ClassicLadder became this rung.");
	const struct lettered fits = lettering_fit(picture->lettering, LETTER_COMMENT, text,
						   -1, 0);

	picture_text(&picture->strokes, TOKEN_COMMENT, LETTER_COMMENT, fits, 16, 24);
	picture->strokes.width = fits.width + 32;
	picture->strokes.height = 40;
}

static void put_pair(LadderClassicPicture *picture)
{
	const struct classic_rung *rung = picture->rung;
	const char *member = rung->place.member;
	char *name = *member ? g_strdup(member) :
		g_path_get_basename(ladder_origin_path(picture->origin));
	struct classic_pair pair = {
		.there = { ladder_origin_project(picture->origin), rung, picture->lettering,
			   theme_now() },
		.there_name = name,
		.project = ladder_document_project(picture->document),
		.show = (enum drafting_show)settings_enum("show", SHOW_BOTH),
		.lost = _("Nothing of it is here any more."),
	};
	GArray *ours = ladder_origin_became(picture->origin, rung, &pair.pou);

	pair.rung = (const int *)(const void *)ours->data;
	pair.rungs = pair.project ? (int)ours->len : 0;
	grid_classic_pair(&pair, 0, &picture->strokes);
	g_array_unref(ours);
	g_free(name);
}

static void name_it(LadderClassicPicture *picture)
{
	char *text = picture->rung ?
		g_strdup_printf(_("Original of the rung: %s"), *picture->rung->comment ?
				picture->rung->comment : picture->rung->place.member) :
		g_strdup(_("Nothing of ClassicLadder became this rung."));

	gtk_accessible_update_property(GTK_ACCESSIBLE(picture),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, text, -1);
	g_free(text);
}

static void draw_again(LadderClassicPicture *picture)
{
	picture_clear(&picture->strokes);
	picture_init(&picture->strokes);
	if (!picture->lettering)
		picture->lettering = lettering_new(gtk_widget_get_pango_context(
			GTK_WIDGET(picture)), NULL);
	lettering_trim(picture->lettering);
	if (picture->rung && picture->origin)
		put_pair(picture);
	else
		put_nothing(picture);
	gtk_widget_queue_resize(GTK_WIDGET(picture));
	gtk_widget_queue_draw(GTK_WIDGET(picture));
}

void ladder_classic_picture_show(LadderClassicPicture *picture, LadderOrigin *origin,
				 LadderDocument *document, const struct classic_rung *rung)
{
	g_set_object(&picture->origin, origin);
	g_set_object(&picture->document, document);
	picture->rung = origin ? rung : NULL;
	name_it(picture);
	draw_again(picture);
}

/* ---- the widget ---- */

#define SCALE_LEAST 0.55f /* names can be read; what is wider scrolls           */

/* As wide as there is room, never larger than natural. */
static float scale_for(LadderClassicPicture *picture, int width)
{
	return width > 0 && picture->strokes.width > 0 ?
	       CLAMP((float)width / picture->strokes.width, SCALE_LEAST, 1) : 1;
}

static GtkSizeRequestMode request_mode(GtkWidget *widget)
{
	(void)widget;
	return GTK_SIZE_REQUEST_HEIGHT_FOR_WIDTH;
}

static void measure(GtkWidget *widget, GtkOrientation orientation, int for_size,
		    int *minimum, int *natural, int *minimum_baseline,
		    int *natural_baseline)
{
	LadderClassicPicture *picture = LADDER_CLASSIC_PICTURE(widget);

	*minimum_baseline = *natural_baseline = -1;
	if (orientation == GTK_ORIENTATION_HORIZONTAL) {
		*minimum = (int)ceilf(picture->strokes.width * SCALE_LEAST);
		*natural = (int)ceilf(picture->strokes.width);
		return;
	}
	*minimum = *natural = (int)ceilf(picture->strokes.height *
					 scale_for(picture, for_size));
}

static void snapshot(GtkWidget *widget, GtkSnapshot *shot)
{
	LadderClassicPicture *picture = LADDER_CLASSIC_PICTURE(widget);
	const float width = (float)gtk_widget_get_width(widget);
	const float height = (float)gtk_widget_get_height(widget);
	const float scale = scale_for(picture, (int)width);
	const struct theme *theme = theme_now();

	gtk_snapshot_append_color(shot, &theme->color[TOKEN_SHEET],
				  &GRAPHENE_RECT_INIT(0, 0, width, height));
	gtk_snapshot_scale(shot, scale, scale);
	if (picture->lettering)
		picture_snapshot(&picture->strokes, theme, picture->lettering, shot);
}

static void dispose(GObject *object)
{
	LadderClassicPicture *picture = LADDER_CLASSIC_PICTURE(object);

	g_clear_object(&picture->origin);
	g_clear_object(&picture->document);
	picture_clear(&picture->strokes);
	g_clear_pointer(&picture->lettering, lettering_free);
	G_OBJECT_CLASS(ladder_classic_picture_parent_class)->dispose(object);
}

static void ladder_classic_picture_class_init(LadderClassicPictureClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	widget->get_request_mode = request_mode;
	widget->measure = measure;
	widget->snapshot = snapshot;
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_IMG);
}

static void ladder_classic_picture_init(LadderClassicPicture *picture)
{
	picture_init(&picture->strokes);
	g_signal_connect_object(adw_style_manager_get_default(), "notify::dark",
				G_CALLBACK(draw_again), picture, G_CONNECT_SWAPPED);
	g_signal_connect_object(adw_style_manager_get_default(), "notify::high-contrast",
				G_CALLBACK(draw_again), picture, G_CONNECT_SWAPPED);
}

GtkWidget *ladder_classic_picture_new(void)
{
	return g_object_new(LADDER_TYPE_CLASSIC_PICTURE, NULL);
}
