/* SPDX-License-Identifier: MIT
 *
 * grid_view_label - a rung gets another label, and the jumps to it follow.
 *
 * It is the engine that renames. A label that no jump leads to is a text like any other,
 * and one that goes leaves its jumps to the checks.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/document/symbols.h"

#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

/* The label of the cursor's rung, and how many jumps lead to it. */
static int jumps_here(LadderGridView *view, struct xref_target *label)
{
	const int rung = view->first + view->cursor.rung;
	struct xref xref;
	int jumps = 0;

	*label = (struct xref_target){ XREF_LABEL, view->pou + 1, rung, { 0 } };
	if (!xref_make(&xref, ladder_document_project(view->document)))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++)
		jumps += xref.use[i].kind == XREF_JUMPED &&
			 xref_same(&xref.use[i].target, label);
	xref_free(&xref);
	return jumps;
}

/* Of the label that it has now; @name is another, and no empty one. */
static bool is_led_to(LadderGridView *view, const char *name, struct xref_target *label,
		      int *jumps)
{
	const struct project *project = ladder_document_project(view->document);
	const struct rung *rung = sheet_rung(view, view->cursor.rung);

	if (!rung->label || !*name || strcmp(project_text(project, rung->label), name) == 0)
		return false;
	*jumps = jumps_here(view, label);
	return *jumps > 0;
}

/* The program as it would be; NULL: that cannot be, or no jump is to follow. free(). */
static char *renamed(LadderGridView *view, const char *name, size_t *len, int *jumps,
		     struct ladder_rename *how)
{
	struct xref_target label;

	*how = (struct ladder_rename){ .why = RENAME_GOOD };
	if (!is_led_to(view, name, &label, jumps))
		return NULL;
	return ladder_rename(ladder_document_ladder(view->document), &label, name, len, how);
}

char *label_refusal(LadderGridView *view, const char *name)
{
	struct ladder_rename how;
	size_t len;
	int jumps;

	free(renamed(view, name, &len, &jumps, &how));
	return how.why == RENAME_GOOD ? NULL : rename_reason(view->document, &how, name);
}

bool label_set(LadderGridView *view, const char *name)
{
	struct ladder_rename how;
	size_t len, old_len;
	int jumps;
	char *text = renamed(view, name, &len, &jumps, &how), *told;
	bool good;

	if (!text)
		return false;
	g_free(ladder_document_outline(view->document, &old_len, NULL, NULL));
	ladder_document_begin(view->document, _(verb_row(VERB_rung_label)->label), NULL);
	good = ladder_document_replace(view->document, 0, old_len, text, NULL);
	ladder_document_end(view->document);
	told = g_strdup_printf(ngettext("%d jump follows", "%d jumps follow",
					(unsigned long)jumps), jumps);
	if (good)
		sheet_tell(view, told);
	g_free(told);
	free(text);
	return good;
}
