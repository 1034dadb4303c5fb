/* SPDX-License-Identifier: MIT
 *
 * task_runs - the runs of the tasks, found by comparing the state of each scan with the one
 * before.
 */
#include "editor-gtk/sim/task_runs.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_value.h"

#include "engine/trial/pace.h"

#include <string.h>

struct task_runs {
	LadderSim *sim;
	struct sim_replay *replay;
	guint64 life;        /* of the simulation that the runs are of          */
	guint64 next;        /* the scan to take                                */
	gint64 time_ns;      /* of the one before; 0: none                      */
	GArray *run;         /* of struct task_run                              */
	struct tasks before; /* after the scan `next` - 1                       */
	guint64 program;     /* that it belongs to; 0: it is not known          */
	gint64 paused_ns[LIMIT_TASKS]; /* of tasks that go on later; else 0     */
};

struct task_runs *task_runs_new(LadderSim *sim)
{
	struct task_runs *runs = g_new0(struct task_runs, 1);

	runs->sim = sim;
	runs->replay = sim_replay_new();
	runs->life = ladder_sim_life(sim);
	runs->run = g_array_new(FALSE, FALSE, sizeof(struct task_run));
	return runs;
}

void task_runs_free(struct task_runs *runs)
{
	if (!runs)
		return;
	sim_replay_free(runs->replay);
	g_array_unref(runs->run);
	g_free(runs);
}

/* ---- reading the record ---- */

static void begin_anew(struct task_runs *runs)
{
	runs->life = ladder_sim_life(runs->sim);
	sim_replay_free(runs->replay);
	runs->replay = sim_replay_new();
	g_array_set_size(runs->run, 0);
	runs->next = 0;
	runs->time_ns = 0;
	runs->program = 0;
}

/* Sets how late the run is, and how many runs were left out before it. Both are unknown for the first
 * scan of a start, and for the first one after an edit. */
static void set_lateness(const struct task_runs *runs, const struct twin *twin, guint32 task,
			 struct task_run *run)
{
	const struct code_task *of = &twin->resource.image.program->task[task];
	const struct task_state *then = &runs->before.state[task];
	const struct task_state *now = &twin->resource.tasks.state[task];

	if (twin->resource.scans <= 1 || runs->program != sim_replay_program(runs->replay))
		return;
	run->missed = (guint)(now->overruns - then->overruns);
	if (of->kind == TASK_INTERVAL)
		run->late_ns = MAX(run->at_ns - then->next_ns, 0);
	/* It waits for tasks of higher priority. */
	if (twin->resource.pace.speed && run->late_ns < twin->period_ns)
		run->late_ns = 0;
}

static bool has_run(const struct twin *twin, guint32 task)
{
	return twin->resource.tasks.state[task].ran ||
	       !tasks_declared(twin->resource.image.program);
}

/* Is this the task that failed? A program without tasks has none with a name. */
static bool has_failed(const struct twin *twin, const char *task)
{
	const char *failed = twin->resource.fault_at.task;

	return twin->resource.state == STATE_FAULT &&
	       (failed ? strcmp(failed, task) == 0 : !*task);
}

/* What ran in a period, in the order of time. */
static void take_parts(struct task_runs *runs, const struct twin *twin)
{
	const struct resource *resource = &twin->resource;
	const struct paced *pace = &resource->pace;

	for (guint32 i = 0; i < pace->parts; i++) {
		const struct pace_part *part = &pace->part[i];
		gint64 *paused_ns = &runs->paused_ns[part->task];
		struct task_run run = { .at_ns = pace_at(resource, part->from),
					.paused_ns = *paused_ns, .scan = twin->scan,
					.whole = part->whole };
		const gint64 end_ns = pace_at(resource, part->to);

		run.took_ns = end_ns - run.at_ns;
		*paused_ns = part->whole ? 0 : end_ns;
		if (part->from == part->to && !part->whole)
			continue; /* it stands before its first rung */
		run.task = g_intern_string(task_name(resource->image.program, part->task));
		run.fault = has_failed(twin, run.task) && i + 1 == pace->parts;
		if (!run.paused_ns)
			set_lateness(runs, twin, part->task, &run);
		g_array_append_val(runs->run, run);
	}
}

static void take_scan(struct task_runs *runs, const struct twin *twin)
{
	const struct program *program = twin->resource.image.program;
	guint order = 0;

	memset(runs->paused_ns, 0, sizeof(runs->paused_ns));
	for (guint32 i = 0; i < program->task_count; i++) {
		struct task_run run = { .at_ns = twin->now_ns, .scan = twin->scan,
					.whole = true };

		if (!twin->resource.scans || !has_run(twin, i))
			continue;
		run.task = g_intern_string(task_name(program, i));
		run.order = order++;
		run.fault = has_failed(twin, run.task);
		set_lateness(runs, twin, i, &run);
		g_array_append_val(runs->run, run);
	}
}

static void take(struct task_runs *runs, const struct twin *twin)
{
	if (twin->resource.pace.speed)
		take_parts(runs, twin);
	else
		take_scan(runs, twin);
	if (runs->run->len > TASK_RUNS_MOST)
		g_array_remove_range(runs->run, 0, TASK_RUNS_MOST / 4);
	runs->before = twin->resource.tasks;
	runs->program = sim_replay_program(runs->replay);
	runs->next = twin->scan + 1;
	runs->time_ns = twin->now_ns;
}

/* The oldest scan that is worth reading: the runs of older ones would be dropped. */
static guint64 first_scan(guint64 first, guint64 last)
{
	const guint64 room = last > TASK_RUNS_MOST ? last - TASK_RUNS_MOST : 0;

	return MAX(MAX(first, room), 1);
}

/* Takes one scan, or moves the replay nearer to it. False: there is none to take. */
static bool step(struct task_runs *runs)
{
	const struct twin *twin;
	guint64 first, last;

	if (!ladder_sim_computed(runs->sim, &first, &last))
		return false;
	first = first_scan(first, last);
	if (runs->next > last + 1) /* a board was started again: its scans count anew */
		begin_anew(runs);
	if (runs->next < first) {
		runs->next = first;
		runs->program = 0;
	}
	if (runs->next > last || !ladder_sim_replay(runs->sim, runs->replay, runs->next))
		return false;
	twin = sim_replay_twin(runs->replay);
	if (twin->scan == runs->next)
		take(runs, twin);
	return true;
}

bool task_runs_feed(struct task_runs *runs, gint64 us)
{
	const gint64 until = g_get_monotonic_time() + us;
	bool more = true;

	if (runs->life != ladder_sim_life(runs->sim))
		begin_anew(runs);
	while (more && g_get_monotonic_time() < until)
		more = step(runs);
	return more;
}

/* ---- what is there ---- */

guint task_runs_count(const struct task_runs *runs)
{
	return runs->run->len;
}

const struct task_run *task_runs_get(const struct task_runs *runs, guint number)
{
	return &g_array_index(runs->run, struct task_run, number);
}

gint64 task_runs_time(const struct task_runs *runs)
{
	return runs->time_ns;
}

guint task_runs_from(const struct task_runs *runs, gint64 ns)
{
	guint low = 0, high = runs->run->len;

	while (low < high) {
		const guint middle = low + (high - low) / 2;

		if (task_runs_get(runs, middle)->at_ns < ns)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

/* ---- texts ---- */

/* ", 5 ms late, 2 periods left out" without the first comma. Caller frees. */
static char *trouble_text(const struct task_run *run)
{
	GString *text = g_string_new(NULL);
	char late[32], took[32];

	live_time_print(run->late_ns, late, sizeof(late));
	live_time_print((run->took_ns + 500) / 1000 * 1000, took, sizeof(took));
	if (run->took_ns)
		g_string_append(text, took);
	if (!run->whole)
		g_string_append_printf(text, "%s%s", text->len ? ", " : "", _("interrupted"));
	if (run->late_ns)
		g_string_append_printf(text, "%s", text->len ? ", " : "");
	if (run->late_ns)
		g_string_append_printf(text, _("%s late"), late);
	if (run->missed)
		g_string_append_printf(text, "%s", text->len ? ", " : "");
	if (run->missed)
		g_string_append_printf(text, ngettext("%u run left out", "%u runs left out",
						      run->missed), run->missed);
	if (run->fault)
		g_string_append_printf(text, "%s%s", text->len ? ", " : "", _("FAULT"));
	return g_string_free(text, FALSE);
}

/* Whether runs take time in [@from, @to). */
static bool is_paced(const struct task_runs *runs, gint64 from, gint64 to)
{
	const guint first = task_runs_from(runs, from);

	return first < task_runs_count(runs) && task_runs_get(runs, first)->at_ns < to &&
	       task_runs_get(runs, first)->took_ns;
}

char *task_runs_at_text(const struct task_runs *runs, gint64 ns, gint64 period_ns)
{
	GString *names = g_string_new(NULL);
	gint64 at = MAX(ns, 0) / period_ns * period_ns;
	const bool paced = is_paced(runs, at, at + period_ns);
	char time[32], *text;

	for (guint i = task_runs_from(runs, paced ? at : ns - period_ns + 1);
	     i < task_runs_count(runs); i++) {
		const struct task_run *run = task_runs_get(runs, i);
		char *trouble;

		if (run->at_ns > ns && (!paced || run->at_ns >= at + period_ns))
			break;
		trouble = trouble_text(run);
		if (!paced)
			at = run->at_ns;
		g_string_append_printf(names, "%s%s", names->len ? _(", then ") : "",
				       *run->task ? run->task : _("Each scan"));
		if (*trouble)
			g_string_append_printf(names, " (%s)", trouble);
		g_free(trouble);
	}
	live_time_print(at, time, sizeof(time));
	text = g_strdup_printf(_("At %s: %s"), time, names->len ? names->str : _("nothing ran"));
	g_string_free(names, TRUE);
	return text;
}

/* Takes @text; the caller frees what it returns. */
static char *with_interruptions(char *text, guint64 count)
{
	char *more;

	if (!count)
		return text;
	more = g_strdup_printf(ngettext("%s, interrupted %llu time", "%s, interrupted %llu times",
					(gulong)count), text, (unsigned long long)count);
	g_free(text);
	return more;
}

char *task_runs_sum_text(const struct twin *twin, const char *task)
{
	const struct program *program = twin->resource.image.program;

	for (guint32 i = 0; i < program->task_count; i++) {
		const struct task_state *state = &twin->resource.tasks.state[i];
		const guint64 runs = tasks_declared(program) ? state->runs : twin->resource.scans;
		char *ran, *text;

		if (strcmp(task_name(program, i), task) != 0)
			continue;
		ran = g_strdup_printf(ngettext("%llu run", "%llu runs", (gulong)runs),
				      (unsigned long long)runs);
		text = state->overruns ? g_strdup_printf(ngettext("%s, %llu left out",
			"%s, %llu left out", (gulong)state->overruns), ran,
			(unsigned long long)state->overruns) : g_strdup(ran);
		g_free(ran);
		return with_interruptions(text, state->interrupted);
	}
	return NULL;
}
