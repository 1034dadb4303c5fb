/* SPDX-License-Identifier: MIT
 *
 * sim_rungs - which rung of the document is which of the program that runs.
 *
 * A rung that was edited is another one until a program with it runs; those above and
 * below it keep their power.
 */
#include "editor-gtk/sim/sim_inside.h"

struct sim_rungs {
	LadderDocument *document;
	GPtrArray *pou;   /* of GArray of int, in the order of the POUs        */
	gulong rungs_handler, project_handler;
};

static GArray *numbers(int count)
{
	GArray *rungs = g_array_sized_new(FALSE, FALSE, sizeof(int), (guint)count);

	for (int i = 0; i < count; i++)
		g_array_append_val(rungs, i);
	return rungs;
}

static void rungs_changed(LadderDocument *document, int pou, int at, int removed,
			  int inserted, struct sim_rungs *rungs)
{
	const int unknown = -1;
	GArray *of;

	(void)document;
	if (pou < 0 || (guint)pou >= rungs->pou->len)
		return;
	of = rungs->pou->pdata[pou];
	if (at < 0 || (guint)(at + removed) > of->len)
		return;
	if (removed)
		g_array_remove_range(of, (guint)at, (guint)removed);
	for (int i = 0; i < inserted; i++)
		g_array_insert_val(of, (guint)(at + i), unknown);
}

static void project_changed(struct sim_rungs *rungs)
{
	g_ptr_array_set_size(rungs->pou, 0);
}

struct sim_rungs *sim_rungs_new(LadderDocument *document)
{
	struct sim_rungs *rungs = g_new0(struct sim_rungs, 1);

	rungs->document = g_object_ref(document);
	rungs->pou = g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref);
	rungs->rungs_handler = g_signal_connect(document, "rungs-changed",
						G_CALLBACK(rungs_changed), rungs);
	rungs->project_handler = g_signal_connect_swapped(document, "project-changed",
		G_CALLBACK(project_changed), rungs);
	return rungs;
}

void sim_rungs_free(struct sim_rungs *rungs)
{
	if (!rungs)
		return;
	g_clear_signal_handler(&rungs->rungs_handler, rungs->document);
	g_clear_signal_handler(&rungs->project_handler, rungs->document);
	g_object_unref(rungs->document);
	g_ptr_array_unref(rungs->pou);
	g_free(rungs);
}

void sim_rungs_same(struct sim_rungs *rungs)
{
	const struct project *project = ladder_document_project(rungs->document);

	g_ptr_array_set_size(rungs->pou, 0);
	for (int i = 0; project && i < project->pou_count; i++)
		g_ptr_array_add(rungs->pou, numbers(project->pou[i].rung_count));
}

int sim_rungs_find(const struct sim_rungs *rungs, int pou, int rung)
{
	const GArray *of;

	if (pou < 0 || (guint)pou >= rungs->pou->len)
		return -1;
	of = rungs->pou->pdata[pou];
	return rung >= 0 && (guint)rung < of->len ? g_array_index(of, int, rung) : -1;
}
