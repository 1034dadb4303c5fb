/* SPDX-License-Identifier: MIT
 *
 * tile - a tile of a palette; see tile.h.
 */
#include "editor-gtk/panels/tile.h"

#include "editor-gtk/draw/ghost.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/theme.h"

#include <gtk/gtk.h>

#define ICON_WIDTH  56
#define ICON_HEIGHT 34

/* ---- the icon: drawn, so that it follows the theme ---- */

#define LADDER_TYPE_ICON (ladder_icon_get_type())
G_DECLARE_FINAL_TYPE(LadderIcon, ladder_icon, LADDER, ICON, GtkWidget)

struct _LadderIcon {
	GtkWidget parent;
	struct tile tile;
	struct lettering *lettering;
};

G_DEFINE_FINAL_TYPE(LadderIcon, ladder_icon, GTK_TYPE_WIDGET)

static void ladder_icon_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	LadderIcon *icon = LADDER_ICON(widget);
	const struct theme *theme = theme_screen();
	struct picture picture;

	picture_init(&picture);
	icon->tile.draw(&icon->tile, theme, icon->lettering,
			(float)gtk_widget_get_width(widget),
			(float)gtk_widget_get_height(widget), &picture);
	picture_snapshot(&picture, theme, icon->lettering, snapshot);
	picture_clear(&picture);
}

static void ladder_icon_finalize(GObject *object)
{
	lettering_free(LADDER_ICON(object)->lettering);
	G_OBJECT_CLASS(ladder_icon_parent_class)->finalize(object);
}

static void ladder_icon_class_init(LadderIconClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_icon_finalize;
	GTK_WIDGET_CLASS(class)->snapshot = ladder_icon_snapshot;
}

static void ladder_icon_init(LadderIcon *icon)
{
	icon->lettering = lettering_new(
		gtk_widget_get_pango_context(GTK_WIDGET(icon)), NULL);
	gtk_widget_set_size_request(GTK_WIDGET(icon), ICON_WIDTH, ICON_HEIGHT);
	gtk_widget_set_halign(GTK_WIDGET(icon), GTK_ALIGN_CENTER);
	theme_follow(icon, G_CALLBACK(gtk_widget_queue_draw));
}

/* ---- click and drag ---- */

static GdkContentProvider *drag_prepare(GtkDragSource *source, double x, double y,
					LadderIcon *icon)
{
	(void)source;
	(void)x;
	(void)y;
	return icon->tile.drag(icon->tile.id);
}

static void drag_begin(GtkDragSource *source, GdkDrag *unused, LadderIcon *icon)
{
	struct picture picture;

	(void)unused;
	picture_init(&picture);
	icon->tile.draw(&icon->tile, theme_screen(), icon->lettering, GHOST_WIDTH, GHOST_HEIGHT,
			&picture);
	ghost_tile(source, &picture, theme_screen(), icon->lettering);
	picture_clear(&picture);
}

static void clicked(GtkButton *button, LadderIcon *icon)
{
	gtk_widget_activate_action(GTK_WIDGET(button), icon->tile.action, "i", icon->tile.id);
}

/* ---- the tile ---- */

static GtkWidget *label_new(const char *text, const char *class)
{
	GtkWidget *label = gtk_label_new(text);

	gtk_widget_add_css_class(label, class);
	gtk_label_set_wrap(GTK_LABEL(label), TRUE);
	gtk_label_set_wrap_mode(GTK_LABEL(label), PANGO_WRAP_WORD_CHAR);
	gtk_label_set_justify(GTK_LABEL(label), GTK_JUSTIFY_CENTER);
	return label;
}

/* "Umschalt+Strg+Runter" is broken behind a sign, without a hyphen. */
static GtkWidget *key_new(const char *key)
{
	char **parts = g_strsplit(key, "+", -1), *text = g_strjoinv("+\xe2\x80\x8b", parts);
	GtkWidget *label = label_new(text, "tile-key");
	PangoAttrList *attrs = pango_attr_list_new();

	pango_attr_list_insert(attrs, pango_attr_insert_hyphens_new(FALSE));
	gtk_label_set_attributes(GTK_LABEL(label), attrs);
	pango_attr_list_unref(attrs);
	g_free(text);
	g_strfreev(parts);
	return label;
}

static void can_be_dragged(GtkWidget *button, LadderIcon *icon)
{
	GtkDragSource *drag = gtk_drag_source_new();

	gtk_drag_source_set_actions(drag, GDK_ACTION_COPY);
	g_signal_connect(drag, "prepare", G_CALLBACK(drag_prepare), icon);
	g_signal_connect(drag, "drag-begin", G_CALLBACK(drag_begin), icon);
	gtk_widget_add_controller(button, GTK_EVENT_CONTROLLER(drag));
}

GtkWidget *tile_new(const struct tile *tile)
{
	GtkWidget *button = gtk_button_new();
	/* The button has the name: a screen reader needs none of its parts. */
	GtkWidget *box = g_object_new(GTK_TYPE_BOX, "orientation", GTK_ORIENTATION_VERTICAL,
				      "accessible-role", GTK_ACCESSIBLE_ROLE_NONE, NULL);
	LadderIcon *icon = g_object_new(LADDER_TYPE_ICON, NULL);
	char *tip = g_strdup_printf(_("%s: %s%s%s"), tile->name, tile->told,
				    tile->key[0] ? " · " : "", tile->key);

	icon->tile = *tile;
	icon->tile.name = icon->tile.told = icon->tile.key = NULL;
	gtk_widget_add_css_class(button, "flat");
	gtk_widget_add_css_class(button, "tile");
	gtk_box_append(GTK_BOX(box), GTK_WIDGET(icon));
	gtk_box_append(GTK_BOX(box), label_new(tile->name, "tile-name"));
	if (tile->key[0])
		gtk_box_append(GTK_BOX(box), key_new(tile->key));
	gtk_button_set_child(GTK_BUTTON(button), box);
	tip_set(button, tip);
	spoken_name(button, tip);
	gtk_widget_set_focus_on_click(button, FALSE);
	g_signal_connect(button, "clicked", G_CALLBACK(clicked), icon);
	can_be_dragged(button, icon);
	g_free(tip);
	return button;
}

GtkWidget *tile_with(GtkWidget *tile, const char *name, GMenu *menu)
{
	GtkWidget *overlay = gtk_overlay_new(), *button = gtk_menu_button_new();
	char *tip = g_strdup_printf(_("More kinds of %s"), name);

	gtk_overlay_set_child(GTK_OVERLAY(overlay), tile);
	gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(button), "pan-down-symbolic");
	gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(button), G_MENU_MODEL(menu));
	gtk_widget_add_css_class(button, "flat");
	gtk_widget_add_css_class(button, "tile-more");
	gtk_widget_set_halign(button, GTK_ALIGN_END);
	gtk_widget_set_valign(button, GTK_ALIGN_START);
	tip_set(button, tip);
	spoken_name(button, tip);
	gtk_overlay_add_overlay(GTK_OVERLAY(overlay), button);
	g_object_unref(menu);
	g_free(tip);
	return overlay;
}
