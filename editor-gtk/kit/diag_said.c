/* SPDX-License-Identifier: MIT
 *
 * diag_said - a diagnostic of the engine in the language of the session.
 *
 * The text is translated. Its parts are mostly names of the user and are not. A part is
 * translated only if it is a text of ours: several words, or an expected token.
 */
#include "editor-gtk/kit/diag_said.h"

#include "editor-gtk/kit/i18n.h"

#include <glib.h>
#include <string.h>

/* Single words are not translated: `index` could also be a name. The first part of some messages
 * is always ours. */
static bool is_ours(enum diag_id id, int index, const char *part)
{
	return (index == 0 && (id == DIAG_EXPECTED || id == DIAG_TOO_MANY ||
			       id == DIAG_SFC_TOO_MANY)) || strchr(part, ' ');
}

char *diag_said_of(enum diag_id id, const char *arg)
{
	char **part = g_strsplit(arg, DIAG_AND, -1);
	char *joined, *whole;
	int len;

	for (int i = 0; part[i]; i++) {
		char *of_user = part[i];

		if (*of_user && is_ours(id, i, of_user)) {
			part[i] = g_strdup(said(of_user));
			g_free(of_user);
		}
	}
	joined = g_strjoinv(DIAG_AND, part);
	len = diag_fill(said(diag_text(id)), joined, NULL, 0) + 1;
	whole = g_malloc((gsize)len);
	diag_fill(said(diag_text(id)), joined, whole, (size_t)len);
	g_free(joined);
	g_strfreev(part);
	return whole;
}

char *diag_said_whole(const struct diag *diag)
{
	return diag_said_of(diag->id, diag->arg);
}

/* "pump.rung:14:3: ". */
static void add_file(GString *line, const struct diag *diag)
{
	if (!diag->file)
		return;
	g_string_append_printf(line, "%s:", diag->file);
	if (diag->line > 0)
		g_string_append_printf(line, "%d:", diag->line);
	if (diag->line > 0 && diag->column > 0)
		g_string_append_printf(line, "%d:", diag->column);
	g_string_append_c(line, ' ');
}

static void add_rung(GString *line, const struct diag *diag)
{
	if (diag->line <= 0 && diag->pou)
		g_string_append_printf(line, "%s: ", diag->pou);
	if (diag->rung > 0 && diag->row > 0)
		g_string_append_printf(line, _("rung %d (%d,%d): "), diag->rung, diag->row,
				       diag->col);
	else if (diag->rung > 0)
		g_string_append_printf(line, _("rung %d: "), diag->rung);
}

char *diag_said_line(const struct diag *diag)
{
	GString *line = g_string_new(NULL);
	char *whole = diag_said_whole(diag);

	add_file(line, diag);
	add_rung(line, diag);
	g_string_append_printf(line, _("%s %s: %s"), diag_severity(diag->id) == SEVERITY_ERROR ?
			       _("error") : _("warning"), diag_code(diag->id), whole);
	g_free(whole);
	return g_string_free(line, FALSE);
}

const struct diag *diag_first_error(const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++)
		if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR)
			return &diags->diag[i];
	return NULL;
}
