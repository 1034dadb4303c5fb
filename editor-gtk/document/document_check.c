/* SPDX-License-Identifier: MIT
 *
 * document_check - the engine's checks on a copy of the document, in a thread.
 *
 * The engine has no globals, so a copy can be read, checked and built beside the live
 * project. One thread at a time; a change meanwhile asks for another round.
 */
#include "editor-gtk/document/document_inside.h"
#include "editor-gtk/kit/gtk48/memory.h"

#include <string.h>

#define CHECK_DELAY_MS 120 /* after the last change                            */

struct check {
	char *text;
	gsize len;
	const char *file;  /* interned                                         */
	guint64 version;
	struct ladder *ladder;
	bool read;         /* all of it                                        */
};

static void check_free(gpointer pointer)
{
	struct check *check = pointer;

	ladder_free(check->ladder);
	g_free(check->text);
	g_free(check);
}

static struct check *check_new(LadderDocument *document)
{
	struct check *check = g_new0(struct check, 1);

	check->text = ladder_document_text(document, &check->len);
	check->file = g_intern_string(document_file(document));
	check->version = document->version;
	return check;
}

static void check_run(struct check *check)
{
	check->ladder = ladder_new();
	if (!check->ladder)
		g_error("out of memory");
	check->read = ladder_load_text(check->ladder, check->file, check->text, check->len);
	if (check->read)
		ladder_build(check->ladder);
}

/* ---- lines of charts ---- */

static void copy_place(int *line, int *column, int to_line, int to_column)
{
	*line = to_line;
	*column = to_column;
}

/* @is, just read, is the same chart as @was. */
static void take_chart_lines(struct sfc *was, const struct sfc *is)
{
	for (int i = 0; i < was->step_count; i++)
		copy_place(&was->step[i].line, &was->step[i].column_at, is->step[i].line,
			   is->step[i].column_at);
	for (int i = 0; i < was->use_count; i++)
		copy_place(&was->use[i].line, &was->use[i].column, is->use[i].line,
			   is->use[i].column);
	for (int i = 0; i < was->transition_count; i++)
		copy_place(&was->transition[i].line, &was->transition[i].column,
			   is->transition[i].line, is->transition[i].column);
	for (int i = 0; i < was->action_count; i++)
		copy_place(&was->action[i].line, &was->action[i].column,
			   is->action[i].line, is->action[i].column);
	for (int i = 0; i < was->ref_count; i++)
		copy_place(&was->ref[i].line, &was->ref[i].column, is->ref[i].line,
			   is->ref[i].column);
	was->control_line = is->control_line;
}

static bool is_same_chart(const struct pou *was, const struct pou *is)
{
	return was->sfc && is->sfc && was->sfc->step_count == is->sfc->step_count &&
	       was->sfc->use_count == is->sfc->use_count &&
	       was->sfc->transition_count == is->sfc->transition_count &&
	       was->sfc->action_count == is->sfc->action_count &&
	       was->sfc->ref_count == is->sfc->ref_count &&
	       was->il.count == is->il.count;
}

/* A rung that was edited moves what stands below it, and a file need not be written as it
 * is read: where things are in the canonical text is known when that was read. */
static void take_lines(LadderDocument *document)
{
	struct project *project = ladder_document_project(document);
	const struct project *read = ladder_project(document->checked);

	if (!project || !read || document->checked_version != document->version ||
	    project->pou_count != read->pou_count)
		return;
	for (int i = 0; i < project->pou_count; i++) {
		struct pou *was = &project->pou[i];
		const struct pou *is = &read->pou[i];

		if (!is_same_chart(was, is))
			continue;
		take_chart_lines(was->sfc, is->sfc);
		for (int k = 0; k < was->il.count; k++)
			was->il.line[k].line = is->il.line[k].line;
		was->line = is->line;
	}
}

static void check_take(LadderDocument *document, struct check *check)
{
	ladder_free(document->checked);
	document->checked = g_steal_pointer(&check->ladder);
	document->checked_version = check->version;
	document->diags = *ladder_diags(document->checked);
	if (check->read && check->version == document->version)
		document_check_lists(document, ladder_project(document->checked),
				     &document->diags);
	take_lines(document);
	document_tell_checked(document);
	memory_give_back(); /* the copy before it was tens of megabytes of a large one */
}

static void check_thread(GTask *task, gpointer source, gpointer data,
			 GCancellable *cancellable)
{
	(void)source;
	(void)cancellable;
	check_run(data);
	g_task_return_boolean(task, TRUE);
}

static void check_done(GObject *object, GAsyncResult *result, gpointer unused)
{
	LadderDocument *document = LADDER_DOCUMENT(object);
	struct check *check = g_task_get_task_data(G_TASK(result));

	(void)unused;
	document->checking = false;
	if (check->version >= document->checked_version)
		check_take(document, check);
	if (document->version != document->checked_version)
		document_check_later(document);
}

static gboolean check_begin(gpointer data)
{
	LadderDocument *document = data;
	GTask *task;

	document->check_timer = 0;
	if (document->checking)
		return G_SOURCE_REMOVE; /* check_done() asks again */
	document->checking = true;
	task = g_task_new(document, NULL, check_done, NULL);
	g_task_set_task_data(task, check_new(document), check_free);
	g_task_run_in_thread(task, check_thread);
	g_object_unref(task);
	return G_SOURCE_REMOVE;
}

void document_check_later(LadderDocument *document)
{
	document_stop_checks(document);
	if (document->fixed)
		return;
	document->check_timer = g_timeout_add(CHECK_DELAY_MS, check_begin, document);
}

void document_stop_checks(LadderDocument *document)
{
	if (document->check_timer)
		g_source_remove(document->check_timer);
	document->check_timer = 0;
}

void ladder_document_check_now(LadderDocument *document)
{
	struct check *check = check_new(document);

	document_stop_checks(document);
	check_run(check);
	check_take(document, check);
	check_free(check);
}

const struct diag_list *ladder_document_diags(LadderDocument *document)
{
	return &document->diags;
}

struct ladder *ladder_document_checked(LadderDocument *document)
{
	return document->checked;
}
