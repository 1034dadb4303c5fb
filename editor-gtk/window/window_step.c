/* SPDX-License-Identifier: MIT
 *
 * window_step - undo and redo: what was done is told, and what it changed is seen.
 */
#include "editor-gtk/window/window_inside.h"

/* What a step changed first; @pou -1: no rung and no list alone. */
struct changed {
	int pou, rung; /* of a list: rung -1                                   */
};

static void rungs_changed(LadderDocument *document, int pou, int at, int removed, int added,
			  struct changed *changed)
{
	(void)document;
	(void)removed;
	(void)added;
	if (changed->pou < 0)
		*changed = (struct changed){ pou, at };
}

static void list_changed(LadderDocument *document, int pou, struct changed *changed)
{
	(void)document;
	if (changed->pou < 0)
		*changed = (struct changed){ pou, -1 };
}

/* Is it at the cursor of what is in front? */
static bool is_here(LadderWindow *window, const struct changed *changed)
{
	LadderGridView *sheet = tabs_sheet(window);
	LadderTextView *list = tabs_list(window);

	if (sheet)
		return ladder_grid_view_pou(sheet) == changed->pou &&
		       ladder_grid_view_first(sheet) + ladder_grid_view_cursor(sheet).rung ==
		       changed->rung;
	return list && ladder_text_view_pou(list) == changed->pou;
}

static void show(LadderWindow *window, const struct changed *changed)
{
	const struct project *project = ladder_document_project(window->document);
	const int count = project && changed->pou >= 0 && changed->pou < project->pou_count ?
			  project->pou[changed->pou].rung_count : -1;

	if (count < 0 || is_here(window, changed))
		return;
	tabs_go(window, changed->pou, MIN(changed->rung, count - 1), -1, -1);
}

void window_step(LadderWindow *window, bool redo)
{
	LadderDocument *document = window->document;
	struct changed changed = { -1, -1 };
	gulong rungs, list;
	char *name, *text;
	bool done;

	tabs_each_file(window, ladder_side_file_commit);
	name = g_strdup(redo ? ladder_document_redo_name(document) :
			ladder_document_undo_name(document));
	rungs = g_signal_connect(document, "rungs-changed", G_CALLBACK(rungs_changed),
				 &changed);
	list = g_signal_connect(document, "list-changed", G_CALLBACK(list_changed), &changed);
	done = redo ? ladder_document_redo(document) : ladder_document_undo(document);
	g_signal_handler_disconnect(document, rungs);
	g_signal_handler_disconnect(document, list);
	if (done) {
		show(window, &changed);
		text = g_strdup_printf(redo ? _("Done again: %s") : _("Undone: %s"), name);
		ladder_window_tell(window, text);
		g_free(text);
	}
	g_free(name);
	tabs_enter_program(window);
}
