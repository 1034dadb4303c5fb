/* SPDX-License-Identifier: MIT
 *
 * text_scheme - the colours of a source view; see text_scheme.h.
 */
#include "editor-gtk/kit/text_scheme.h"

#include "editor-gtk/kit/theme.h"

#include <adwaita.h>

static void follow(GtkSourceBuffer *buffer)
{
	AdwStyleManager *style = adw_style_manager_get_default();
	GtkSourceStyleScheme *scheme = gtk_source_style_scheme_manager_get_scheme(
		gtk_source_style_scheme_manager_get_default(),
		adw_style_manager_get_dark(style) ? "Adwaita-dark" : "Adwaita");

	if (scheme)
		gtk_source_buffer_set_style_scheme(buffer, scheme);
}

void text_scheme_follow(GtkSourceBuffer *buffer)
{
	theme_follow(buffer, G_CALLBACK(follow));
	follow(buffer);
}
