/* SPDX-License-Identifier: MIT
 *
 * diag_said - a diagnostic of the engine in the language of the session.
 *
 * What it speaks of is mostly a name of the user, and must not be taken for a text of
 * ours that happens to be the same: such as `index`.
 */
#include "editor-gtk/diag_said.h"

#include "editor-gtk/i18n.h"

#include <glib.h>
#include <string.h>

const char *diag_said(const struct diag *diag)
{
	return said(diag_text(diag->id));
}

const char *diag_said_arg(const struct diag *diag)
{
	return diag->id == DIAG_EXPECTED || diag->id == DIAG_TOO_MANY ||
	       strchr(diag->arg, ' ') ? said(diag->arg) : diag->arg;
}

char *diag_said_whole(const struct diag *diag)
{
	return g_strdup_printf("%s%s%s", diag_said(diag), diag->arg[0] ? ": " : "",
			       diag_said_arg(diag));
}
