/* SPDX-License-Identifier: MIT
 *
 * picture_png - the list of strokes as a PNG in memory.
 */
#include "editor-gtk/kit/picture.h"

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
