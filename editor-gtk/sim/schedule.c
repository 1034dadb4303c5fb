/* SPDX-License-Identifier: MIT
 *
 * schedule - which task runs when: the loop of a scan without its programs.
 */
#include "editor-gtk/sim/schedule.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_value.h"

#define ROUNDS 2

/* ---- the span ---- */

static gint64 common_divisor(gint64 a, gint64 b)
{
	return b ? common_divisor(b, a % b) : a;
}

/* The least common multiple of all periods, at most @most. */
static gint64 round_of(const struct program *program, gint64 tick, gint64 most)
{
	gint64 round = tick;

	for (guint32 i = 0; i < program->task_count && round < most; i++) {
		const gint64 interval = task_interval(&program->task[i]);

		if (program->task[i].kind != TASK_INTERVAL)
			continue;
		round /= common_divisor(round, interval);
		if (round > most / interval)
			return most;
		round *= interval;
	}
	return round;
}

static void set_span(struct schedule *schedule, const struct program *program)
{
	const gint64 most = SCHEDULE_CYCLES * schedule->tick_ns;
	const gint64 round = round_of(program, schedule->tick_ns, most);

	schedule->whole = ROUNDS * round <= most;
	schedule->span_ns = schedule->whole ? ROUNDS * round : most;
	/* one bar would not show a period */
	if (schedule->span_ns < 4 * schedule->tick_ns)
		schedule->span_ns = 4 * schedule->tick_ns;
}

/* ---- the runs ---- */

static void run_cycle(struct schedule *schedule, const struct program *program,
		      struct tasks *tasks, const guint8 *data, gint64 now)
{
	guint32 i;

	tasks_begin(tasks, program, data, now);
	for (int order = 0; (i = tasks_next(tasks, program)) < program->task_count; order++) {
		const struct schedule_run run = { now, (int)i, order };

		g_array_append_val(schedule->run, run);
		tasks_take(tasks, program, i, now);
		tasks_look(tasks, program, data);
	}
}

struct schedule *schedule_new(const struct program *program, gint64 period_ns)
{
	struct schedule *schedule = g_new0(struct schedule, 1);
	struct tasks *tasks = g_new0(struct tasks, 1);
	guint8 *data = g_malloc0(program->header->data_size + 1); /* no event comes */

	schedule->run = g_array_new(FALSE, FALSE, sizeof(struct schedule_run));
	schedule->lane_count = (int)program->task_count;
	schedule->lane = g_new0(struct schedule_lane, program->task_count);
	for (int i = 0; i < schedule->lane_count; i++)
		schedule->lane[i] = (struct schedule_lane){
			g_strdup(task_name(program, (guint32)i)),
			(enum task_kind)program->task[i].kind,
			task_interval(&program->task[i]), program->task[i].priority };
	schedule->tick_ns = tasks_tick(program, 0, period_ns);
	set_span(schedule, program);
	tasks_start(tasks, program, 0);
	for (gint64 now = 0; now < schedule->span_ns; now += schedule->tick_ns)
		run_cycle(schedule, program, tasks, data, now);
	g_free(data);
	g_free(tasks);
	return schedule;
}

void schedule_free(struct schedule *schedule)
{
	if (!schedule)
		return;
	for (int i = 0; i < schedule->lane_count; i++)
		g_free(schedule->lane[i].name);
	g_free(schedule->lane);
	g_array_unref(schedule->run);
	g_free(schedule);
}

/* ---- texts ---- */

const char *schedule_lane_name(const struct schedule_lane *lane)
{
	return *lane->name ? lane->name : _("Each scan");
}

/* "0 s, 1 ms, 2 ms …" */
static char *times_of(const struct schedule *schedule, int lane)
{
	GString *text = g_string_new(NULL);
	int count = 0;

	for (guint i = 0; i < schedule->run->len && count < 3; i++) {
		const struct schedule_run *run = &g_array_index(schedule->run,
								struct schedule_run, i);
		char time[32];

		if (run->lane != lane)
			continue;
		live_time_print(run->at_ns, time, sizeof(time));
		g_string_append_printf(text, "%s%s", count++ ? ", " : "", time);
	}
	g_string_append(text, " …");
	return g_string_free(text, FALSE);
}

char *schedule_lane_text(const struct schedule *schedule, int number)
{
	const struct schedule_lane *lane = &schedule->lane[number];
	char period[32], *times, *text;

	if (lane->kind == TASK_EVENT)
		return g_strdup_printf(_("%s: priority %u, when its variable becomes TRUE"),
				       lane->name, lane->priority);
	live_time_print(lane->kind == TASK_INTERVAL ? lane->interval_ns : schedule->tick_ns,
			period, sizeof(period));
	times = times_of(schedule, number);
	text = lane->kind == TASK_INTERVAL ?
		g_strdup_printf(_("%s: priority %u, every %s, at %s"), lane->name,
				lane->priority, period, times) :
		g_strdup_printf(_("%s: behind all tasks, every %s, at %s"),
				schedule_lane_name(lane), period, times);
	g_free(times);
	return text;
}

char *schedule_at_text(const struct schedule *schedule, gint64 ns)
{
	const gint64 at = CLAMP(ns, 0, schedule->span_ns - 1) / schedule->tick_ns *
			  schedule->tick_ns;
	GString *names = g_string_new(NULL);
	char time[32], *text;

	for (guint i = 0; i < schedule->run->len; i++) {
		const struct schedule_run *run = &g_array_index(schedule->run,
								struct schedule_run, i);

		if (run->at_ns != at)
			continue;
		if (names->len)
			g_string_append(names, _(", then "));
		g_string_append(names, schedule_lane_name(&schedule->lane[run->lane]));
	}
	live_time_print(at, time, sizeof(time));
	text = g_strdup_printf(_("At %s: %s"), time, names->len ? names->str : _("nothing runs"));
	g_string_free(names, TRUE);
	return text;
}
