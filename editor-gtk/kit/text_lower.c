/* SPDX-License-Identifier: MIT
 *
 * text_lower - see text_lower.h. g_utf8_strdown() may make two characters of one.
 */
#include "editor-gtk/kit/text_lower.h"

#include <glib.h>

char *text_lower(const char *text)
{
	GString *low = g_string_new(NULL);

	for (; *text; text = g_utf8_next_char(text))
		g_string_append_unichar(low, g_unichar_tolower(g_utf8_get_char(text)));
	return g_string_free(low, FALSE);
}
