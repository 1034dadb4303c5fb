/* SPDX-License-Identifier: MIT
 *
 * tab_title - an ellipsis at the end of a long title; see tab_title.h.
 *
 * A fading label gives its label all the width that this wishes. A label with an ellipsis wishes no
 * more than its width in characters, so that is set to what the tab has room for.
 */
#include "editor-gtk/kit/gtk48/tab_title.h"

#include <string.h>

static int text_width(GtkLabel *label)
{
	PangoLayout *layout = gtk_widget_create_pango_layout(GTK_WIDGET(label), gtk_label_get_text(label));
	int width;

	pango_layout_get_pixel_size(layout, &width, NULL);
	g_object_unref(layout);
	return width;
}

/* The mean width of a character, as GtkLabel counts them. */
static int character_width(GtkLabel *label)
{
	PangoContext *context = gtk_widget_get_pango_context(GTK_WIDGET(label));
	PangoFontMetrics *metrics = pango_context_get_metrics(context, NULL, NULL);
	const int width = MAX(pango_font_metrics_get_approximate_char_width(metrics),
			      pango_font_metrics_get_approximate_digit_width(metrics));

	pango_font_metrics_unref(metrics);
	return MAX(width, PANGO_SCALE);
}

#define FITTED "fitted" /* data of a label with an ellipsis: the text and the tab that it is for */

static char *fitted_for(GtkLabel *label)
{
	GtkWidget *tab = GTK_WIDGET(label);

	while (tab && strcmp(G_OBJECT_TYPE_NAME(tab), "AdwTab") != 0)
		tab = gtk_widget_get_parent(tab);
	return g_strdup_printf("%d %d %s", tab ? gtk_widget_get_width(tab) : 0,
			       tab && gtk_widget_get_state_flags(tab) & GTK_STATE_FLAG_SELECTED ? 1 : 0,
			       gtk_label_get_text(label));
}

static void limit(GtkLabel *label, int characters)
{
	gtk_label_set_ellipsize(label, characters > 0 ? PANGO_ELLIPSIZE_END : PANGO_ELLIPSIZE_NONE);
	gtk_label_set_max_width_chars(label, characters);
}

/* A label with an ellipsis never gets more room than it wishes. When its tab has changed, it wishes all again, and
 * the next layout says how much there is. */
static void fit(GtkLabel *label, int room)
{
	const char *fitted = g_object_get_data(G_OBJECT(label), FITTED);
	char *now = fitted_for(label);

	if (room <= 0 || (fitted && strcmp(fitted, now) == 0 && gtk_widget_get_width(GTK_WIDGET(label)) <= room)) {
		g_free(now);
		return;
	}
	if (fitted && strcmp(fitted, now) != 0) {
		g_object_set_data(G_OBJECT(label), FITTED, NULL);
		limit(label, -1);
	} else if (text_width(label) > room) {
		g_object_set_data_full(G_OBJECT(label), FITTED, g_steal_pointer(&now), g_free);
		limit(label, MAX(room * PANGO_SCALE / character_width(label), 1));
	}
	g_free(now);
}

static void fit_all(GtkWidget *widget)
{
	GtkWidget *child = gtk_widget_get_first_child(widget);

	if (strcmp(G_OBJECT_TYPE_NAME(widget), "AdwFadingLabel") == 0 && GTK_IS_LABEL(child)) {
		fit(GTK_LABEL(child), gtk_widget_get_width(widget));
		return;
	}
	for (; child; child = gtk_widget_get_next_sibling(child))
		fit_all(child);
}

/* The tabs of the bar have their widths. */
static void laid_out(GdkSurface *surface, int width, int height, GtkWidget *bar)
{
	(void)surface;
	(void)width;
	(void)height;
	if (gtk_widget_get_mapped(bar))
		fit_all(bar);
}

static void realized(GtkWidget *bar)
{
	g_signal_connect_object(gtk_native_get_surface(gtk_widget_get_native(bar)), "layout",
				G_CALLBACK(laid_out), bar, G_CONNECT_AFTER);
}

void tab_titles_mend(AdwTabBar *bar)
{
	if (gtk_widget_get_realized(GTK_WIDGET(bar)))
		realized(GTK_WIDGET(bar));
	g_signal_connect(bar, "realize", G_CALLBACK(realized), NULL);
}
