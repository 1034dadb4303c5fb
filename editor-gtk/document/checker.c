/* SPDX-License-Identifier: MIT
 *
 * checker - checks a copy of a text in a thread; see checker.h.
 */
#include "editor-gtk/document/checker.h"

#include "editor-gtk/kit/memory.h"
#include "engine/model/st.h"

#define DELAY_MS 120 /* after the last change                                 */

struct checker {
	GObject *owner;
	const struct checker_how *how;
	struct ladder *ladder;
	struct diag_list diags;
	guint64 version;     /* of `ladder`                                    */
	guint timer;
	bool busy;           /* a thread is at work                            */
	bool again;          /* the text has changed since                     */
};

struct check {
	struct checker *checker;
	struct checker_text of;
	struct ladder *ladder;
	bool read;           /* the whole project could be read                */
};

static void check_free(gpointer pointer)
{
	struct check *check = pointer;

	ladder_free(check->ladder);
	ladder_free(check->of.reader);
	g_free(check->of.text);
	g_free(check);
}

static struct check *check_new(struct checker *checker)
{
	struct check *check = g_new0(struct check, 1);

	check->checker = checker;
	checker->how->copy(checker->owner, &check->of);
	return check;
}

static void check_run(struct check *check)
{
	check->ladder = g_steal_pointer(&check->of.reader);
	check->read = ladder_load_text(check->ladder, check->of.file, check->of.text,
				       check->of.len);
	if (check->read)
		ladder_build(check->ladder);
}

static void take(struct checker *checker, struct check *check)
{
	ladder_free(checker->ladder);
	checker->ladder = g_steal_pointer(&check->ladder);
	checker->version = check->of.version;
	checker->diags = *ladder_diags(checker->ladder);
	checker->how->done(checker->owner, check->read);
	memory_give_back(); /* the freed copy of a large project had tens of megabytes */
}

static void check_thread(GTask *task, gpointer source, gpointer data,
			 GCancellable *cancellable)
{
	(void)source;
	(void)cancellable;
	check_run(data);
	g_task_return_boolean(task, TRUE);
}

static void check_done(GObject *owner, GAsyncResult *result, gpointer unused)
{
	struct check *check = g_task_get_task_data(G_TASK(result));
	struct checker *checker = check->checker;

	(void)owner;
	(void)unused;
	checker->busy = false;
	if (check->of.version >= checker->version)
		take(checker, check);
	if (checker->again)
		checker_later(checker);
}

static gboolean begin(gpointer data)
{
	struct checker *checker = data;
	GTask *task;

	checker->timer = 0;
	checker->again = checker->busy;
	if (checker->busy)
		return G_SOURCE_REMOVE; /* check_done() asks again */
	checker->busy = true;
	task = g_task_new(checker->owner, NULL, check_done, NULL);
	g_task_set_task_data(task, check_new(checker), check_free);
	g_task_run_in_thread(task, check_thread);
	g_object_unref(task);
	return G_SOURCE_REMOVE;
}

void checker_later(struct checker *checker)
{
	checker_stop(checker);
	checker->timer = g_timeout_add(DELAY_MS, begin, checker);
}

void checker_stop(struct checker *checker)
{
	g_clear_handle_id(&checker->timer, g_source_remove);
	checker->again = false;
}

void checker_now(struct checker *checker)
{
	struct check *check = check_new(checker);

	checker_stop(checker);
	check_run(check);
	take(checker, check);
	check_free(check);
}

/* ---- the last one ---- */

struct ladder *checker_ladder(struct checker *checker)
{
	return checker->ladder;
}

struct diag_list *checker_diags(struct checker *checker)
{
	return &checker->diags;
}

guint64 checker_version(const struct checker *checker)
{
	return checker->version;
}

static void copy_place(int *line, int *column, int to_line, int to_column)
{
	*line = to_line;
	*column = to_column;
}

/* @is: the same chart as @was, just read. */
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

static bool is_same_chart(const struct sfc *was, const struct sfc *is)
{
	return was->step_count == is->step_count && was->use_count == is->use_count &&
	       was->transition_count == is->transition_count &&
	       was->action_count == is->action_count && was->ref_count == is->ref_count;
}

static int statements(const struct pou *pou)
{
	return pou->st ? pou->st->count : 0;
}

static bool is_same_body(const struct pou *was, const struct pou *is)
{
	if (!was->sfc != !is->sfc || (was->sfc && !is_same_chart(was->sfc, is->sfc)))
		return false;
	return was->boxed_count == is->boxed_count && was->il.count == is->il.count &&
	       statements(was) == statements(is);
}

/* An edited rung moves the lines below it, and a file may be written in another form: the
 * checked copy knows the lines of the canonical text. */
void checker_place(struct checker *checker, struct project *project)
{
	const struct project *read = ladder_project(checker->ladder);

	if (!read || project->pou_count != read->pou_count)
		return;
	for (int i = 0; i < project->pou_count; i++) {
		struct pou *was = &project->pou[i];
		const struct pou *is = &read->pou[i];

		if (!is_same_body(was, is))
			continue;
		if (was->sfc)
			take_chart_lines(was->sfc, is->sfc);
		for (int k = 0; k < was->boxed_count && k < is->boxed_count; k++)
			was->boxed[k].line = is->boxed[k].line;
		for (int k = 0; k < was->il.count; k++)
			was->il.line[k].line = is->il.line[k].line;
		for (int k = 0; k < statements(was); k++)
			copy_place(&was->st->item[k].line, &was->st->item[k].column,
				   is->st->item[k].line, is->st->item[k].column);
		was->line = is->line;
	}
}

/* ---- life ---- */

struct checker *checker_new(GObject *owner, const struct checker_how *how)
{
	struct checker *checker = g_new0(struct checker, 1);

	checker->owner = owner;
	checker->how = how;
	diag_init(&checker->diags);
	return checker;
}

void checker_free(struct checker *checker)
{
	checker_stop(checker);
	ladder_free(checker->ladder);
	g_free(checker);
}
