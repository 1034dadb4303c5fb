/* SPDX-License-Identifier: MIT
 *
 * gl - starts without GL when the cairo renderer draws; see gl.h.
 */
#include "editor-gtk/kit/gtk48/gl.h"

#include <glib.h>

#define NO_GL "gl-disable"

void gl_spare(void)
{
	if (g_strcmp0(g_getenv("GSK_RENDERER"), "cairo") == 0)
		g_setenv("GDK_DEBUG", NO_GL, FALSE);
}

void gl_forget(void)
{
	if (g_strcmp0(g_getenv("GDK_DEBUG"), NO_GL) == 0)
		g_unsetenv("GDK_DEBUG");
}
