/* SPDX-License-Identifier: MIT
 *
 * classic_open - asks the engine for the rung file that a project becomes.
 */
#include "editor-gtk/document/classic_open.h"

#include "engine/exchange/report.h"

#include <stdlib.h>

gboolean classic_is_project(const char *path)
{
	return ladder_is_classic(path);
}

static void fail(struct ladder *ladder, const char *path, GError **error)
{
	const struct diag_list *diags = ladder_diags(ladder);
	char line[400] = "";

	for (int i = 0; i < diags->count && !*line; i++)
		if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR)
			diag_print(&diags->diag[i], line, sizeof(line));
	g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_INVAL, "%s",
		    *line ? line : path);
}

char *classic_import(const char *path, gsize *len, struct ladder **from, GError **error)
{
	struct ladder *ladder = ladder_new();
	char *text = NULL, *copy;

	*from = NULL;
	if (!ladder || !ladder_take_classic(ladder, false))
		g_error("out of memory");
	ladder_classic_task(ladder, true);
	if (ladder_load(ladder, path) && ladder_import_report(ladder))
		text = ladder_write(ladder, len);
	else
		fail(ladder, path, error);
	copy = text ? g_memdup2(text, *len + 1) : NULL;
	free(text);
	if (copy)
		*from = ladder;
	else
		ladder_free(ladder);
	return copy;
}
