/* SPDX-License-Identifier: MIT
 *
 * report_lines - lines of a report as rows; see report_lines.h.
 */
#include "editor-gtk/document/report_lines.h"

#include "editor-gtk/kit/i18n.h"

#include <string.h>

void left_line_free(gpointer data)
{
	struct left_line *line = data;

	g_free(line->pou);
	g_free(line->text);
	g_free(line);
}

static int pou_of(const struct project *project, const char *name)
{
	return project && name ? project_find_pou(project, name, strlen(name)) : -1;
}

static char *place_text(LadderDocument *document, const LadderPanelRow *row)
{
	const struct project *project = ladder_document_project(document);
	const char *pou = row->pou >= 0 && project ?
		project_text(project, project->pou[row->pou].name) : NULL;

	if (!pou)
		return g_strdup("");
	if (row->rung < 0)
		return g_strdup(pou);
	return g_strdup_printf(_("%s, rung %d"), pou, row->rung + 1);
}

/* Called last: completes a row that has its texts and place. */
static LadderPanelRow *finish(LadderDocument *document, LadderPanelRow *row)
{
	row->text[REPORT_HERE] = place_text(document, row);
	row->number = ((gint64)row->pou * (1 << 20) + row->rung) * (1 << 10) + row->row;
	row->note = g_strdup(row->text[REPORT_KIND]);
	row->spoken = g_strdup_printf("%s: %s. %s %s", row->text[REPORT_KIND],
				      row->text[REPORT_TEXT], row->text[REPORT_THERE],
				      row->text[REPORT_HERE]);
	return row;
}

/* ---- an import ---- */

/* The place of the rung that came from the reported one; else of the POU that is named. */
static void find_here(LadderOrigin *origin, const struct project *project,
		      const struct report_line *line, LadderPanelRow *row)
{
	const struct classic_rung *from = ladder_origin_at(origin, line->member, line->line);
	GArray *ours = ladder_origin_became(origin, from, &row->pou);

	if (row->pou >= 0)
		row->rung = g_array_index(ours, int, 0);
	else if (!from)
		row->pou = pou_of(project, line->pou);
	if (!from && row->pou >= 0 && line->rung > 0 &&
	    line->rung <= project->pou[row->pou].rung_count)
		row->rung = line->rung - 1;
	g_array_unref(ours);
}

static LadderPanelRow *import_row(LadderOrigin *origin, LadderDocument *document, int index)
{
	static const char *const kinds[REPORT_KINDS] = {
		[REPORT_TAKEN] = N_("Taken"), [REPORT_CHANGED] = N_("Changed"),
		[REPORT_LOST] = N_("Left out"),
	};
	const struct report_line *line = &ladder_origin_report(origin)->line[index];
	LadderPanelRow *row = ladder_panel_row_new();

	find_here(origin, ladder_document_project(document), line, row);
	row->flags = (unsigned int)index;
	row->tone = line->kind == REPORT_LOST ? PANEL_WARNING : PANEL_PLAIN;
	row->text[REPORT_KIND] = g_strdup(_(kinds[line->kind]));
	row->text[REPORT_TEXT] = g_strdup(line->text);
	row->text[REPORT_THERE] = !*line->member && !line->line ? g_strdup("") :
		!*line->member ? g_strdup_printf(_("line %d"), line->line) :
		line->line ? g_strdup_printf("%s:%d", line->member, line->line) :
		g_strdup(line->member);
	return finish(document, row);
}

GPtrArray *report_lines_import(LadderOrigin *origin, LadderDocument *document)
{
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	const struct classic_report *report = ladder_origin_report(origin);

	/* the most serious kind first */
	for (int kind = REPORT_KINDS - 1; kind >= 0; kind--)
		for (int i = 0; report && i < report->count; i++)
			if ((int)report->line[i].kind == kind)
				g_ptr_array_add(rows, import_row(origin, document, i));
	return rows;
}

/* ---- an export ---- */

static LadderPanelRow *export_row(LadderDocument *document, const struct left_line *line)
{
	const struct project *project = ladder_document_project(document);
	LadderPanelRow *row = ladder_panel_row_new();

	row->pou = pou_of(project, line->pou);
	if (row->pou >= 0 && line->rung <= project->pou[row->pou].rung_count) {
		row->rung = line->rung - 1;
		row->row = line->row - 1;
		row->col = line->col - 1;
	}
	row->tone = line->refused ? PANEL_ERROR : PANEL_PLAIN;
	row->text[REPORT_KIND] = g_strdup(line->refused ? _("Refused") : _("Changed"));
	row->text[REPORT_TEXT] = g_strdup(line->text);
	row->text[REPORT_THERE] = g_strdup("");
	return finish(document, row);
}

GPtrArray *report_lines_export(const GPtrArray *lines, LadderDocument *document)
{
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);

	for (guint i = 0; i < lines->len; i++)
		g_ptr_array_add(rows, export_row(document, lines->pdata[i]));
	return rows;
}

/* ---- all of it ---- */

static guint count_of(const GPtrArray *rows, const char *kind)
{
	guint count = 0;

	for (guint i = 0; i < rows->len; i++)
		count += strcmp(panel_row_text(rows->pdata[i], REPORT_KIND), kind) == 0;
	return count;
}

char *report_lines_title(const char *name, const GPtrArray *rows)
{
	const guint changed = count_of(rows, _("Changed"));
	const guint lost = count_of(rows, _("Left out"));
	const guint refused = count_of(rows, _("Refused"));

	if (refused)
		return g_strdup_printf(_("%s was not written. Refused: %u; the reasons are in the table"),
				       name, refused);
	return g_strdup_printf(_("%s: %u changed, %u left out"), name, changed, lost);
}

char *report_lines_text(const char *title, GListModel *rows)
{
	GString *text = g_string_new(title);

	g_string_append_c(text, '\n');
	for (guint i = 0; i < g_list_model_get_n_items(rows); i++) {
		LadderPanelRow *row = g_list_model_get_item(rows, i);

		g_string_append_printf(text, "%s\t%s\t%s\t%s\n",
				       panel_row_text(row, REPORT_KIND),
				       panel_row_text(row, REPORT_TEXT),
				       panel_row_text(row, REPORT_THERE),
				       panel_row_text(row, REPORT_HERE));
		g_object_unref(row);
	}
	return g_string_free(text, FALSE);
}
