/* SPDX-License-Identifier: MIT
 *
 * classic_open - asks the engine for the rung file that a project becomes.
 */
#include "editor-gtk/classic_open.h"

#include "editor-gtk/i18n.h"

#include "engine/import/report.h"
#include "engine/ladder.h"

#include <stdlib.h>

gboolean classic_is_project(const char *path)
{
	return ladder_is_classic(path);
}

#define SHOWN 6 /* lines: the rest is counted */

static char *tell(const struct classic_report *report)
{
	GString *text = g_string_new(NULL);
	int count = 0;

	for (int i = 0; i < report->count; i++) {
		const struct report_line *line = &report->line[i];

		if (line->kind == REPORT_TAKEN || ++count > SHOWN)
			continue;
		g_string_append_printf(text, "%s%s", text->len ? "\n" : "",
				       line->kind == REPORT_LOST ? _("Lost: ") :
								   _("Changed: "));
		if (line->pou)
			g_string_append_printf(text, line->rung ? "%s %d: " : "%s: ",
					       line->pou, line->rung);
		g_string_append(text, line->text);
	}
	if (count > SHOWN)
		g_string_append_printf(text, _("\n%d more: ladder import tells them"),
				       count - SHOWN);
	return g_string_free(text, FALSE);
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

char *classic_import(const char *path, gsize *len, char **told, GError **error)
{
	struct ladder *ladder = ladder_new();
	char *text = NULL, *copy;

	if (!ladder || !ladder_take_classic(ladder, false))
		g_error("out of memory");
	ladder_classic_task(ladder, true);
	if (ladder_load(ladder, path) && ladder_import_report(ladder)) {
		text = ladder_write(ladder, len);
		*told = tell(ladder_import_report(ladder));
	} else {
		fail(ladder, path, error);
	}
	copy = text ? g_memdup2(text, *len + 1) : NULL;
	free(text);
	ladder_free(ladder);
	return copy;
}
