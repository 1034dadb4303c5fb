/* SPDX-License-Identifier: MIT
 *
 * markdown_none - in place of markdown_md4c.c where md4c is not installed.
 */
#include "editor-gtk/kit/markdown.h"

bool markdown_is_here(void)
{
	return false;
}

struct md_page *markdown_read(const char *text, gsize len)
{
	(void)text;
	(void)len;
	return NULL;
}
